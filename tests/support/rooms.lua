-- Measures the structure of src/: its rooms, which are its folders, their cycles, functions, types
-- and names, and the path of one row.
--
--   lua5.4 tests/support/rooms.lua [ROOT] [FUNCTION]     FUNCTION makes a row: the path's first
--   lua5.4 tests/support/rooms.lua --names WORD [ROOT]   names with a house word out of place
--   lua5.4 tests/support/rooms.lua --check [ROOT]        the limits below, as checks
--   lua5.4 tests/support/rooms.lua --house [ROOT]        files, lines, headers with one user, ...
--   lua5.4 tests/support/rooms.lua --map [FOLDER...]     the folders, or the units of some, with a
--                                                        sentence each
--   lua5.4 tests/support/rooms.lua --prose [PLACE...]    phrases of rooms/phrases.lua in comments,
--                                                        messages and pages, from the root
--   lua5.4 tests/support/rooms.lua --columns [PLACE]     lines of more than 100 columns
--
-- The order of the rooms is that of src/meson.build; house words are those of rooms/words.lua.
package.path = "./?.lua;" .. package.path
local columns = require "tests.support.rooms.columns"
local house = require "tests.support.rooms.house"
local map = require "tests.support.rooms.map"
local measures = require "tests.support.rooms.measures"
local modules = require "tests.support.rooms.modules"
local prose = require "tests.support.rooms.prose"
local report = require "tests.support.rooms.report"
local trees = require "tests.support.rooms.tree"

local MOST_LINES, MOST_PARAMETERS = 40, 7
-- Functions that a library calls with parameters of its choosing.
local CALLED_BY_LIBRARIES = {
  ["kit/plugins/web/web.c"] = { handle = true },
  ["kit/plugins/type/xml.c"] = { on_entity = true },
  ["kit/plugins/type/type.c"] = { on_conic = true, on_cubic = true },
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
  for _, kind in ipairs { { "wing", "wings" }, { "top", "folders" }, { "unit", "units" } } do
    for _, circle in ipairs(measures.circles(tree, kind[1])) do
      fault("%s include each other in a circle: %s", kind[2], table.concat(circle, ", "))
    end
  end
  return #tree.files
end

local function check_types(tree, fault)
  for _, text in ipairs(house.doubled_types(tree)) do
    fault("two types have one name: %s", text)
  end
  return #tree.files
end

local function check_calls(tree, fault)
  for _, circle in ipairs(house.circles(tree)) do
    fault("units call each other in a circle: %s", table.concat(circle, ", "))
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

local function check_roundings(tree, fault)
  for _, one in ipairs(house.roundings(tree)) do
    fault("src/%s: (double)(float), which a compiler may take away: call cs_number_single", one)
  end
  return #tree.files
end

local function check_tree(tree, root, fault)
  return check_functions(tree, fault) + check_circles(tree, fault)
    + check_types(tree, fault) + check_calls(tree, fault)
    + check_roundings(tree, fault)
    + check_includes(tree, fault) + check_words(tree, fault) + map.check(tree, root, fault)
    + modules.check(root, fault)
end

--- Prints the faults that check(fault) finds; returns whether it found none.
local function report_faults(check)
  local faults = {}
  local count = check(function(format, ...) faults[#faults + 1] = format:format(...) end)
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
if rest[1] == "--prose" then
  table.remove(rest, 1)
  os.exit(report_faults(function(fault) return prose.check(rest, fault) end))
elseif ("--check --columns --map --house"):find(rest[1] or "none", 1, true) then
  what = table.remove(rest, 1)
elseif rest[1] == "--names" then
  what = table.remove(rest, 1)
  rest.word = assert(table.remove(rest, 1), "--names WORD [ROOT]")
end
local folders = {}
if what == "--map" then folders, rest = rest, {} end
local root = rest[1] or "."
if what == "--columns" then
  os.exit(report_faults(function(fault) return columns.check(root, fault) end))
end
local tree = trees.read(root)
if what == "--check" then
  os.exit(report_faults(function(fault) return check_tree(tree, root, fault) end))
end
if what == "--map" then
  if not folders[1] then map.put(tree, root)
  elseif not map.put_units(tree, root, folders) then os.exit(2) end
elseif what == "--house" then
  house.put(tree, root)
elseif what == "--names" then
  report.names(tree, rest.word)
else
  report.all(tree, { most_lines = MOST_LINES, most_parameters = MOST_PARAMETERS, maker = rest[2] })
end
