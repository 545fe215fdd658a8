-- Chooses among the tests of build-test; prints the names by which meson knows them, one a line.
-- From the top of the tree:
--
--   lua5.4 tests/support/choose.lua --near SECONDS FILE...    those nearest to files, as many as
--                                                             fit into a time; and the golden
--                                                             tests, if the files may change pixels
--   lua5.4 tests/support/choose.lua --named NAME...           the tests of these names, or near
--                                                             these folders or files
--   lua5.4 tests/support/choose.lua --check                   checks that each folder has nearest
--                                                             tests, and that each test is run
--
-- Times are those of out/check-times, where the last line of a test counts; without one the time is
-- UNKNOWN. The golden tests come first, then the quickest. Those for which no time is left are
-- named on standard error.
package.path = "./?.lua;" .. package.path
local catalogue = require "tests.support.catalogue"
local near = require "tests.support.near"
local nearest = require "tests.mutate.nearest"
local system = require "tests.support.system"

local UNKNOWN = 5
local ALWAYS = "golden/golden" -- started first, even if it took little time
-- Tests that meson makes of other sources than test_NAME.c and NAME_spec.lua.
local MADE = { ["unit/faults"] = true, ["unit/planefile"] = true, ["unit/spanfile"] = true }

local function fail(format, ...)
  io.stderr:write("run: ", format:format(...), "\n")
  os.exit(1)
end

-- ---------------------------------------------------------------- choosing

local function times()
  local list = {}
  local text = system.read "out/check-times" or ""
  for name, seconds in text:gmatch "(%S+) (%S+)\n" do list[name] = tonumber(seconds) end
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

--- Prints the tests that need SECONDS of processor time in all.
local function print_tests(list, seconds)
  local left_out, sum = {}, 0
  for _, test in ipairs(list) do
    sum = sum + test.seconds
    if sum > seconds then left_out[#left_out + 1] = test.name else print(test.called) end
  end
  if #left_out > 0 then
    io.stderr:write("   no time is left for: ./run test ", table.concat(left_out, " "), "\n")
  end
end

--- Appends a list to another.
local function append(list, more) table.move(more, 1, #more, #list + 1, list) end

--- Whether a change of a file may change pixels: changes of pages and of verbs in Lua do not.
local function may_change_pixels(path)
  return not path:find "%.md$" and not path:find "^src/desk/program/verbs/"
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

--- At most three names of a list, those that are most similar to a word.
local function suggestions(word, names)
  table.sort(names, function(a, b)
    local to_a, to_b = distance(word, a), distance(word, b)
    return to_a < to_b or to_a == to_b and a < b
  end)
  return table.concat(names, ", ", 1, math.min(3, #names))
end

--- The meaning of each possible name: a test, the tests of a folder of tests/, or those near a
--- folder of src/.
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
  local meaning, found, names, units = meanings(all), {}, {}, near.units "."
  for name in pairs(meaning) do names[#names + 1] = name end
  for _, word in ipairs(words) do
    local key = word:gsub("/+$", ""):gsub("_spec%.lua$", ""):gsub("^tests/", "")
    local tests = meaning[key] or system.exists(word) and near.tests(word, units)
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
local function check_nearest(expect)
  local has_place = {}
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
end

--- Every source of a test is named in a meson.build of tests/, and every test in nearest.lua has a
--- source.
local function check_listed(expect)
  local listed = system.output "cat tests/meson.build tests/*/meson.build"
  local has_source = {}
  for _, path in ipairs(system.lines "find tests -name '*_spec.lua' -o -name 'test_*.c'") do
    local test = near.test_of(path)
    has_source[test] = true
    expect(listed:find("['/]" .. test:match "[^/]*$" .. "'"), "no meson.build names %s", path)
  end
  for key, tests in pairs(nearest) do
    for _, test in ipairs(tests) do
      expect(has_source[test] or MADE[test] or test:find "^example/" or test:find "%-",
        "tests/mutate/nearest.lua: %s names %s, which has no source", key, test)
    end
  end
end

local function check()
  local faults, count = {}, 0
  local function expect(is_good, format, ...)
    count = count + 1
    if not is_good then faults[#faults + 1] = format:format(...) end
  end
  check_nearest(expect)
  check_listed(expect)
  table.sort(faults)
  for _, sentence in ipairs(faults) do io.stderr:write(sentence, "\n") end
  if #faults > 0 then
    print(("%d of %d checks failed"):format(#faults, count))
    os.exit(1)
  end
  print(("%d checks passed"):format(count))
end

-- ---------------------------------------------------------------- the program

if arg[1] == "--check" then return check() end
local all = catalogue.of(".", "build-test")
if arg[1] == "--named" then
  print_tests(chosen(all, named_tests(all, { table.unpack(arg, 2) })), math.huge)
else
  print_tests(chosen(all, near_tests { table.unpack(arg, 3) }), tonumber(arg[2]))
end
