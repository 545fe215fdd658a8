-- Which lines and branches of src/ were run, for a build with -Db_coverage=true: file by file, the
-- least covered first, and the total.
--
--   build/tests/lua_host tests/support/coverage.lua BUILD [PLACE...]
--
-- with LUA_CPATH as for specs: celspan.json comes with the module.
--
--      lines        branches         error paths
--     1180  95.1%    642  91.3%    55/ 60  91.7%   src/...
--
-- Branches are those of conditions in C; those that C++ generates for exceptions are left out.
-- Branches of a line with CS_TRY are error paths, most of which need memory to run out at one
-- place: they are counted among the others, and also separately.
--
-- For files whose name contains a PLACE, the lines are shown that did not run (-) or ran with
-- branches that were not taken (2/4: two of four):
--
--      src/core/model/scene/value.c:27: -     return false;
--      src/core/model/scene/value.c:31: 2/4   if (a && b)
--
-- A file that is compiled several times, for several kinds of processors, counts once: a line
-- counts as run if it ran in any of them. Threads count without locks, so a count may be below 0;
-- the line was run then. Programs that run only while building are left out.
local json = require "celspan.json"
local system = require "tests.support.system"

local build = assert(arg[1], "coverage.lua BUILD")
local LEFT_OUT = { ["src/core/base/embed.c"] = true, ["src/kit/lua/bind/compile.c"] = true,
  ["src/core/model/colour/make_transfer_tables.c"] = true }

-- by name: { lines = { [number] = count }, branches = { [number] = { count, ... } } }
local files = {}

local function lines_of(command)
  local lines, ended_well = system.lines(command)
  assert(ended_well, command)
  return lines
end

local function add(file, line)
  local number = line.line_number
  file.lines[number] = (file.lines[number] or 0) + math.abs(line.count)
  local sums = file.branches[number] or {}
  local k = 0
  for _, branch in ipairs(line.branches) do
    if not branch.throw then
      k = k + 1
      sums[k] = (sums[k] or 0) + math.abs(branch.count)
    end
  end
  file.branches[number] = sums
end

--- The name of a source below src/ as in the tree; nil for generated files and those outside.
local function name_of(path) return path:match "^%.%./(src/.*)" end

for _, data in ipairs(lines_of(("cd '%s' && find . -name '*.gcda' | sort"):format(build))) do
  local report = lines_of(("cd '%s' && gcov --json-format --stdout --branch-probabilities '%s'")
    :format(build, data))
  for _, found in ipairs(assert(json.decode(report[1])).files) do
    local name = name_of(found.file)
    if name and not LEFT_OUT[name] then
      local file = files[name] or { lines = {}, branches = {} }
      files[name] = file
      for _, line in ipairs(found.lines) do add(file, line) end
    end
  end
end

--- Totals and how many of them were run: lines, branches, and branches of error paths.
local function new_tally() return { lines = { 0, 0 }, branches = { 0, 0 }, handing = { 0, 0 } } end

local function count(pair, is_run)
  pair[1], pair[2] = pair[1] + 1, pair[2] + (is_run and 1 or 0)
end

local function tally_of(name, file)
  local tally, text = new_tally(), {}
  for line in assert(io.open(name)):lines() do text[#text + 1] = line end
  for number, times in pairs(file.lines) do
    count(tally.lines, times > 0)
    local hands_on = (text[number] or ""):find("CS_TRY(", 1, true)
    for _, taken in ipairs(file.branches[number]) do
      count(tally.branches, taken > 0)
      if hands_on then count(tally.handing, taken > 0) end
    end
  end
  return tally
end

local function percent(pair) return pair[1] == 0 and 100 or 100 * pair[2] / pair[1] end

local function show(tally, name)
  local l, b, h = tally.lines, tally.branches, tally.handing
  print(("%6d %5.1f%%  %6d %5.1f%%  %5d/%5d %5.1f%%   %s"):format(
    l[1], percent(l), b[1], percent(b), h[2], h[1], percent(h), name))
end

local function is_asked_for(name)
  for i = 2, #arg do
    if name:find(arg[i], 1, true) then return true end
  end
  return false
end

--- The parts of a line that did not run: "-", "2/4" branches, or nil.
local function what_lacks(times, branches)
  local taken = 0
  for _, sum in ipairs(branches) do taken = taken + (sum > 0 and 1 or 0) end
  if times == 0 then return "-" end
  return taken < #branches and ("%d/%d"):format(taken, #branches) or nil
end

local function show_lacking(name, file)
  local number = 0
  for text in assert(io.open(name)):lines() do
    number = number + 1
    local lacks = file.lines[number] and what_lacks(file.lines[number], file.branches[number])
    if lacks then print(("%s:%d: %-5s %s"):format(name, number, lacks, text)) end
  end
end

local total, list = new_tally(), {}
for name, file in pairs(files) do
  local tally = tally_of(name, file)
  list[#list + 1] = { name, tally }
  for what, pair in pairs(tally) do
    for i = 1, 2 do total[what][i] = total[what][i] + pair[i] end
  end
end
table.sort(list, function(a, b)
  local p, q = percent(a[2].lines), percent(b[2].lines)
  if p ~= q then return p < q end
  return a[1] < b[1]
end)
for _, entry in ipairs(list) do
  if is_asked_for(entry[1]) then show_lacking(entry[1], files[entry[1]]) end
end
print "      lines        branches     error paths"
for _, entry in ipairs(list) do show(entry[2], entry[1]) end
show(total, "all of src/")
