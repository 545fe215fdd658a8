-- Chooses among the tests of build-test. From the top of the tree:
--
--   lua5.4 tests/support/choose.lua --near FILE...    those nearest to files; and the golden
--                                                     tests, if the files may change pixels
--   lua5.4 tests/support/choose.lua --named NAME...   the tests of these names or folders
--   lua5.4 tests/support/choose.lua --check           checks that each folder has nearest tests
--
-- A test is a line: its name, the seconds of processor time of its last run, the targets that ninja
-- builds for it, and its command, with tabs between them; the golden ones first, then the quickest.
-- Times are those of out/check-times, where the last line of a test counts; without one the time is
-- UNKNOWN.
package.path = "./?.lua;" .. package.path
local catalogue = require "tests.support.catalogue"
local near = require "tests.support.near"
local nearest = require "tests.mutate.nearest"
local system = require "tests.support.system"

local UNKNOWN = 5
local ALWAYS = "golden/golden" -- begun first, however long it took

local function fail(format, ...)
  io.stderr:write("run: ", format:format(...), "\n")
  os.exit(1)
end

-- ---------------------------------------------------------------- choosing

local function times()
  local list = {}
  local text = system.read "out/check-times" or ""
  for name, user, kernel in text:gmatch "(%S+) (%S+) (%S+)\n" do list[name] = user + kernel end
  return list
end

--- The tests of a list of names, in the order in which they are run. A name without a test belongs
--- to something that was not built.
local function chosen(all, names)
  local known, by_name, list = times(), {}, {}
  for _, test in ipairs(all) do by_name[test.name] = test end
  for i, name in ipairs(names) do
    local test = by_name[name]
    if test and not test.place then
      test.seconds, test.place = name == ALWAYS and 0 or known[name] or UNKNOWN, i
      list[#list + 1] = test
    end
  end
  table.sort(list, function(a, b)
    if a.seconds ~= b.seconds then return a.seconds < b.seconds end
    return a.place < b.place
  end)
  return list
end

local function print_tests(list)
  for _, test in ipairs(list) do
    local targets = table.concat(test.targets, " ")
    print(("%s\t%.1f\t%s\t%s"):format(test.name, test.seconds, targets, test.command))
  end
end

--- Appends a list to another.
local function append(list, more) table.move(more, 1, #more, #list + 1, list) end

--- Whether a change of a file may change pixels: one of pages and of verbs in Lua does not.
local function may_change_pixels(path)
  return not path:find "%.md$" and not path:find "^src/program/verbs/"
end

local function near_tests(paths)
  local units, names = near.units ".", {}
  for _, path in ipairs(paths) do
    if may_change_pixels(path) then names[1] = ALWAYS end
  end
  for _, path in ipairs(paths) do append(names, near.tests(path, units)) end
  return names
end

-- ---------------------------------------------------------------- names

--- How many letters must be added, dropped or replaced to turn one word into another.
local function distance(a, b)
  local row = {}
  for j = 0, #b do row[j] = j end
  for i = 1, #a do
    local corner = row[0]
    row[0] = i
    for j = 1, #b do
      local other = corner + (a:byte(i) == b:byte(j) and 0 or 1)
      corner, row[j] = row[j], math.min(row[j] + 1, row[j - 1] + 1, other)
    end
  end
  return row[#b]
end

--- Up to three names of a list, the most similar to a word.
local function suggestions(word, names)
  table.sort(names, function(a, b)
    local to_a, to_b = distance(word, a), distance(word, b)
    return to_a < to_b or to_a == to_b and a < b
  end)
  return table.concat(names, ", ", 1, math.min(3, #names))
end

--- The meaning of each name that may be given: a test, the tests of a folder of tests/, or those
--- near a folder of src/.
local function meanings(all)
  local meaning, units = {}, near.units "."
  local function add(name, test)
    meaning[name] = meaning[name] or {}
    table.insert(meaning[name], test)
  end
  for _, test in ipairs(all) do
    add(test.name, test.name)
    add(test.name:match "^[^/]*", test.name)
  end
  for key in pairs(nearest) do
    meaning[key] = near.tests(key:find "/" and key or "src/" .. key, units)
  end
  for name in pairs(units) do -- without its kind, if no folder has that name
    local short = name:match "/(.*)"
    if not meaning[short] then add(short, name) end
  end
  return meaning
end

local function named_tests(all, words)
  local meaning, found, names = meanings(all), {}, {}
  for name in pairs(meaning) do names[#names + 1] = name end
  for _, word in ipairs(words) do
    local key = word:gsub("/+$", ""):gsub("_spec%.lua$", ""):gsub("^tests/", "")
    local tests = meaning[key] or meaning[near.key(word) or ""]
    if not tests then
      fail("test: '%s' is neither a test nor a folder; near it: %s", word, suggestions(word, names))
    end
    append(found, tests)
  end
  return found
end

-- ---------------------------------------------------------------- checks

--- Every folder of src/ with sources, every module of celspan and every script has an entry in
--- nearest.lua, and every entry names a folder or file.
local function check()
  local faults, count, has_place = {}, 0, {}
  local function expect(is_good, format, ...)
    count = count + 1
    if not is_good then faults[#faults + 1] = format:format(...) end
  end
  local find = "find src lua/celspan scripts subprojects "
    .. "-name '*.[ch]' -o -name '*.cpp' -o -name '*.lua'"
  for _, path in ipairs(system.lines(find)) do
    local key, place = near.key(path), path:match "^(src/.*)/" or path
    if not has_place[place] then
      expect(key, "%s has no entry in tests/mutate/nearest.lua", place)
    end
    has_place[place] = true
    if key then has_place[key] = true end
  end
  for key in pairs(nearest) do
    local is_path = key:find "[/.]" or key == "docs" or key == "examples"
    expect(has_place[key] or is_path and system.exists(key),
      "tests/mutate/nearest.lua: %s is neither a folder of src/ nor a path", key)
  end
  table.sort(faults)
  for _, sentence in ipairs(faults) do io.stderr:write(sentence, "\n") end
  if #faults > 0 then
    print(("%d of %d checks failed"):format(#faults, count))
    os.exit(1)
  end
  print(("%d checks passed"):format(count))
end

-- ---------------------------------------------------------------- the program

local how, words = arg[1], { table.unpack(arg, 2) }
if how == "--check" then return check() end
local all = catalogue.of(".", "build-test")
print_tests(chosen(all, how == "--near" and near_tests(words) or named_tests(all, words)))
