-- What the last run of `meson test` in a build folder found:
--
--   lua5.4 tests/support/report.lua BUILD [TIMES]
--
-- Prints what was skipped, the ends of the tests that failed, and the tests that took most
-- processor time; its last line is the numbers of checks that passed, failed and were skipped. A
-- check is one of a program's, which ends with a line such as "12 checks passed", a test of busted,
-- or else a whole program. Appends the processor time of each test to the file TIMES, which
-- tests/support/choose.lua reads.
package.path = "./?.lua;" .. package.path
local catalogue = require "tests.support.catalogue"
local system = require "tests.support.system"

local MOST_LINES, LONGEST = 60, 12

--- The tests of meson's log: name, status (0 if it ended well), lines.
local function read_tests(path)
  local tests, test = {}, nil
  for line in io.lines(path) do
    local name = line:match "^test: .* / (.*)"
    if name then
      test = { name = catalogue.name(name), lines = {} }
      tests[#tests + 1] = test
    elseif test and line:find "^result: " then
      test.ended_well = line:find "exit status 0$" ~= nil
    elseif line:find "^=====" then
      test = nil
    elseif test and not line:find "^%a+ ?%a*:  +" and not line:find "^%-%-%-%-%-.*%-%-%-%-%-$" then
      test.lines[#test.lines + 1] = line
    end
  end
  return tests
end

--- Counts the tests of busted, whose plan is the last line; false if the plan is missing.
local function count_tap(test)
  local is_whole = false
  for _, line in ipairs(test.lines) do
    if line:find "^ok %d+ %- # SKIP" then test.skipped = test.skipped + 1
    elseif line:find "^ok %d" then test.passed = test.passed + 1
    elseif line:find "^not ok %d" then test.failed = test.failed + 1
    elseif line:find "^1%.%.%d" then is_whole = true end
  end
  return is_whole
end

--- Counts the checks of a program; false if it does not print their number.
local function count_checks(test)
  local says_it = false
  for _, line in ipairs(test.lines) do
    local good = line:match "^(%d+) checks passed$"
    local bad, all = line:match "^(%d+) of (%d+) checks failed$"
    local skipped = line:match "^(%d+) checks skipped$"
    if good then
      test.passed = test.passed + good
      if good == "0" then test.skipped = test.skipped + 1 end
    elseif bad then
      test.passed, test.failed = test.passed + all - bad, test.failed + bad
    elseif skipped then
      test.skipped = test.skipped + skipped
    end
    says_it = says_it or good or bad or skipped
  end
  return says_it
end

local function count(test)
  test.passed, test.failed, test.skipped, test.seconds = 0, 0, 0, 0
  for _, line in ipairs(test.lines) do
    local user, kernel = line:match "^([%d.]+) %+ ([%d.]+) seconds of processor time$"
    if user then test.seconds = user + kernel end
  end
  local is_counted = count_tap(test) or count_checks(test)
  if test.ended_well and not is_counted then test.passed = test.passed + 1 end
  if not test.ended_well and test.failed == 0 then test.failed = 1 end
end

--- Prints the lines of a test that explain its failure: for busted, those after "not ok"; otherwise
--- the last ones.
local function print_failure(test)
  local lines, is_bad = {}, false
  for _, line in ipairs(test.lines) do
    if line:find "^not ok" then is_bad = true elseif line:find "^ok" then is_bad = false end
    if is_bad then lines[#lines + 1] = line end
  end
  if #lines == 0 then lines = test.lines end
  print(test.name .. " failed:")
  for i = math.max(1, #lines - MOST_LINES + 1), #lines do print("   " .. lines[i]:sub(1, 300)) end
end

local function print_skips(test)
  for _, line in ipairs(test.lines) do
    local what = line:match "^ok %d+ %- # SKIP(.*)" or line:match "^skipped: (.*)"
    if what then print(("skipped: %s: %s"):format(test.name, what)) end
  end
end

local function print_longest(tests)
  local words, sum = {}, 0
  table.sort(tests, function(a, b) return a.seconds > b.seconds end)
  for i, test in ipairs(tests) do
    sum = sum + test.seconds
    if i <= LONGEST then words[i] = ("%s %.0f s"):format(test.name, test.seconds) end
  end
  print(("   %.0f s of processor time in %d tests; longest: %s"):format(sum, #tests,
    table.concat(words, ", ")))
end

local function append_times(path, tests)
  local file = assert(io.open(path, "a"))
  for _, test in ipairs(tests) do
    if test.seconds > 0 then file:write(test.name, (" %.2f\n"):format(test.seconds)) end
  end
  assert(file:close())
end

local log = system.lines(("ls -t %s/meson-logs/testlog*.txt"):format(system.quote(arg[1])))[1]
local tests = log and read_tests(log) or {}
local passed, failed, skipped = 0, #tests == 0 and 1 or 0, 0
for _, test in ipairs(tests) do
  count(test)
  passed, failed = passed + test.passed, failed + test.failed
  skipped = skipped + test.skipped
  print_skips(test)
  if test.failed > 0 then print_failure(test) end
end
if #tests > 0 then print_longest(tests) else print "no test was run" end
if arg[2] then append_times(arg[2], tests) end
print(passed, failed, skipped)
