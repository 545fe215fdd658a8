-- Measures the structure of src/: its rooms, which are its folders, their circles, functions, types
-- and names, and the way of one row.
--
--   lua5.4 tests/support/rooms.lua [ROOT] [FUNCTION]     FUNCTION makes a row: the way begins there
--   lua5.4 tests/support/rooms.lua --names WORD [ROOT]   names that hold a house word out of place
--   lua5.4 tests/support/rooms.lua --check [ROOT]        the limits below, as checks
--
-- The order of the rooms is that of src/meson.build; house words are those of rooms/words.lua.
package.path = "./?.lua;" .. package.path
local measures = require "tests.support.rooms.measures"
local report = require "tests.support.rooms.report"
local trees = require "tests.support.rooms.tree"

local MOST_LINES, MOST_PARAMETERS = 40, 7
-- Functions that a library calls with parameters of its choosing.
local CALLED_BY_LIBRARIES = {
  ["art/xml.c"] = { on_entity = true }, ["art/type.c"] = { on_conic = true, on_cubic = true },
}

-- ---------------------------------------------------------------- checks

local function check_functions(tree, fault)
  local list = measures.functions(tree)
  for _, one in ipairs(list) do
    local place = ("src/%s:%d: %s"):format(one.file.path, one.fn.line, one.fn.name)
    if one.lines > MOST_LINES then
      fault("%s has %d lines, more than %d", place, one.lines, MOST_LINES)
    end
    local given = CALLED_BY_LIBRARIES[one.file.path]
    if one.fn.parameters > MOST_PARAMETERS and not (given and given[one.fn.name]) then
      fault("%s has %d parameters, more than %d", place, one.fn.parameters, MOST_PARAMETERS)
    end
  end
  return 2 * #list
end

local function check_circles(tree, fault)
  for _, circle in ipairs(measures.circles(tree, "top")) do
    fault("folders include each other in a circle: %s", table.concat(circle, ", "))
  end
  for _, circle in ipairs(measures.circles(tree, "unit")) do
    fault("units include each other in a circle: %s", table.concat(circle, ", "))
  end
  return #tree.files
end

local function check_includes(tree, fault)
  local climbs, count = measures.climbs(tree)
  for _, climb in ipairs(climbs) do
    fault("src/%s:%d: %s is above it in the list of folders", climb.file.path, climb.line,
      climb.to.path)
  end
  return count
end

local function check_words(tree, fault)
  local list, count = measures.misplaced(tree)
  for _, one in ipairs(list) do
    local entry = one.entry
    local why = entry.say and ": say " .. entry.say
      or (", which means %s (%s)"):format(entry.means, table.concat(entry.places, " "))
    fault('src/%s:%d: %s holds "%s"%s', one.file.path, one.name.line, one.name.name, entry.word,
      why)
  end
  return count
end

local function check(tree)
  local faults = {}
  local function fault(format, ...) faults[#faults + 1] = format:format(...) end
  local count = check_functions(tree, fault) + check_circles(tree, fault)
    + check_includes(tree, fault) + check_words(tree, fault)
  for _, sentence in ipairs(faults) do io.stderr:write(sentence, "\n") end
  if #faults > 0 then
    print(("%d of %d checks failed"):format(#faults, count))
    return false
  end
  print(("%d checks passed"):format(count))
  return true
end

-- ---------------------------------------------------------------- the program

local what, rest = "report", { ... }
if rest[1] == "--check" then
  what = table.remove(rest, 1)
elseif rest[1] == "--names" then
  what = table.remove(rest, 1)
  rest.word = assert(table.remove(rest, 1), "--names WORD [ROOT]")
end
local tree = trees.read(rest[1] or ".")
if what == "--check" then os.exit(check(tree) and 0 or 1) end
if what == "--names" then
  report.names(tree, rest.word)
else
  report.all(tree, { most_lines = MOST_LINES, most_parameters = MOST_PARAMETERS, maker = rest[2] })
end
