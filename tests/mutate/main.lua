-- Makes small faults in src/, one at a time, and reports which of them no test detects. From the
-- top of the tree:
--
--   lua5.4 tests/mutate/main.lua [PLACE...] [--sample N] [--seed S] [--near]
--
-- A PLACE is a folder of src/, a file, or FILE:LINE; without one, the folders that determine the
-- pixels. N mutants of a folder are tried (20; 0: all), selected by S (1). --near runs only the
-- nearest tests. The exit status is 0 if every mutant was detected, 1 if one survived, and 2 if
-- tests fail without a mutant or the build fails.
package.path = "./?.lua;" .. package.path
local equal = require "tests.mutate.equal"
local mutants = require "tests.mutate.mutants"
local near_to = require "tests.support.near"
local workshop = require "tests.mutate.workshop"

local DEFAULT = { "src/core/engine/sweep", "src/core/engine/compose", "src/core/engine/paint",
  "src/core/engine/kernel", "src/core/engine/area", "src/core/engine/row",
  "src/core/engine/defocus" }
local BATCH = 6 -- tests that are linked together

local function fail(format, ...)
  io.stderr:write("mutate: ", format:format(...), "\n")
  os.exit(2)
end

-- ---------------------------------------------------------------- what is asked

local function number_after(words, i)
  local value = math.tointeger(tonumber(words[i + 1] or ""))
  if not value or value < 0 then fail("%s needs a whole number", words[i]) end
  return value
end

local function read_words(words)
  local asked, i = { places = {}, sample = 20, seed = 1, near = false }, 1
  while i <= #words do
    local word = words[i]
    if word == "--sample" or word == "--seed" then
      asked[word:sub(3)], i = number_after(words, i), i + 1
    elseif word == "--near" then
      asked.near = true
    elseif word:sub(1, 1) == "-" then
      fail("unknown option '%s' (--sample N, --seed S, --near)", word)
    else
      asked.places[#asked.places + 1] = word:gsub("/$", "")
    end
    i = i + 1
  end
  if #asked.places == 0 then asked.places = DEFAULT end
  return asked
end

--- The sources of a place, and the line if it names one.
local function files_of(place)
  local path, line = place:match "^(.-):(%d+)$"
  path = path or place
  local find = "find '%s' -name '*.[ch]' 2>/dev/null | LC_ALL=C sort"
  local list, pipe = {}, assert(io.popen(find:format(path)))
  for found in pipe:lines() do
    if not found:find "_check%.c$" then list[#list + 1] = found end
  end
  pipe:close()
  if #list == 0 or not path:find "^src/%w" then
    fail("'%s' is neither a folder nor a source of src/", place)
  end
  return list, tonumber(line)
end

--- The mutants of a place in the order in which they are tried.
local function mutants_of(place, seed)
  local list = {}
  local files, line = files_of(place)
  for _, path in ipairs(files) do
    for _, mutant in ipairs(mutants.of(workshop.source(path))) do
      mutant.path = path
      if not line or mutant.line == line then list[#list + 1] = mutant end
    end
  end
  if not line then
    math.randomseed(seed)
    for i = #list, 2, -1 do
      local k = math.random(i)
      list[i], list[k] = list[k], list[i]
    end
  end
  return list
end

-- ---------------------------------------------------------------- which tests

--- The tests near a folder, and the others.
local function split_tests(all, folder)
  local by_name, is_near, near, rest = {}, {}, {}, {}
  for _, test in ipairs(all) do by_name[test.name] = test end
  local function add(test)
    if not is_near[test.name] then near[#near + 1] = test end
    is_near[test.name] = true
  end
  local units = near_to.units "."
  for name, room in pairs(units) do
    if by_name[name] then by_name[name].room = room end
  end
  for _, name in ipairs(near_to.tests("src/" .. folder, units)) do
    if by_name[name] then add(by_name[name]) end
  end
  for _, test in ipairs(all) do
    local place = test.name == "golden/golden" and 1 or #rest + 1 -- pictures of everything
    if not is_near[test.name] then table.insert(rest, place, test) end
  end
  return near, rest
end

--- How much is built for a test: a program of a folder and those below it, a larger program, or all
--- of celspan. No batch mixes two kinds.
local function kind_of(test, folder)
  return #test.targets > 1 and "all" or test.room == folder and "own" or "more"
end

local function batches_of(list, folder)
  local batches, batch = {}, {}
  for i, test in ipairs(list) do
    local is_other = i > 1 and kind_of(test, folder) ~= kind_of(list[i - 1], folder)
    if #batch == BATCH or is_other then batch = {} end
    if #batch == 0 then batches[#batches + 1] = batch end
    batch[#batch + 1] = test
  end
  return batches
end

--- A test that killed a mutant comes first for the next.
local function favour(list, test)
  for i, other in ipairs(list) do
    if other == test then return table.insert(list, 1, table.remove(list, i)) end
  end
end

-- ---------------------------------------------------------------- one mutant

local Trial = {}
Trial.__index = Trial

--- The text around a mutant, and its position.
local function place_of(mutant)
  return ("%s:%d:%d"):format(mutant.path, mutant.line, mutant.column)
end

--- Whether a mutant is known to change nothing.
local function is_explained(mutant, text)
  local line, told = mutants.line_of(text, mutant), mutants.tell(mutant)
  for _, entry in ipairs(equal[mutant.path] or {}) do
    if entry[1] == line and entry[2] == told and (entry[4] or 1) == mutant.nth then return true end
  end
  return false
end

--- Runs a batch without the mutant, leaving out tests that fail.
function Trial:learn(batch, mutant, text)
  if self.shop:knows(batch) then return end
  workshop.set(mutant.path, text)
  for _, test in ipairs(batch) do
    local is_good, message = self.shop:learn { test }
    if not is_good then
      io.stderr:write("mutate: left out: ", message, "\n")
      self.is_left_out[test.name] = true
      self.shop.times[test.name] = 0
    end
  end
  workshop.set(mutant.path, mutants.apply(text, mutant))
end

--- Runs a batch of tests on the current mutant: how it ended and in which test, or nil.
function Trial:run_batch(batch)
  if not workshop.prepare(batch) then return "broken" end
  for _, test in ipairs(batch) do
    if not self.is_left_out[test.name] then
      local how = workshop.run(test, 5 + 4 * self.shop.times[test.name])
      if how ~= "passed" then return how == "late" and "late" or "killed", test end
    end
  end
end

--- Sets a mutant and tries it: "broken", "equal", "killed", "late" or "lived", and the test.
function Trial:try(mutant, text)
  workshop.set(mutant.path, mutants.apply(text, mutant))
  local compiled = self.shop:compile(mutant.path)
  if compiled ~= "different" then return compiled end
  for _, list in ipairs { self.near, self.rest } do
    for _, batch in ipairs(batches_of(list, self.folder)) do
      self:learn(batch, mutant, text)
      local how, test = self:run_batch(batch)
      if how then
        favour(list, test)
        return how, test
      end
    end
  end
  return "lived"
end

-- ---------------------------------------------------------------- a place

local WORDS = { killed = "killed", late = "timed out", lived = "LIVED", equal = "equal",
  broken = "no C", explained = "explained" }

--- Tries mutants of a place until `asked` were run; returns the counts, and those that survived.
local function try_place(trial, place, asked)
  local counts = setmetatable({}, { __index = function() return 0 end })
  local folder = near_to.key((place:gsub(":%d+$", ""))) or place:match "[^/]*$"
  trial.folder = folder
  trial.near, trial.rest = split_tests(trial.shop.tests, folder)
  if asked.near then trial.rest = {} end
  local is_noted, is_line = {}, place:find ":%d+$"
  for _, mutant in ipairs(mutants_of(place, asked.seed)) do
    local text = workshop.source(mutant.path)
    local began, how, test = os.time(), "explained", nil
    if not is_explained(mutant, text) then
      if not is_noted[mutant.path] then trial.shop:note(mutant.path) end
      is_noted[mutant.path] = true
      how, test = trial:try(mutant, text)
      workshop.set(mutant.path, text)
    end
    counts[how] = counts[how] + 1
    print(("%-9s  %s %s%s  [%d s]"):format(WORDS[how], place_of(mutant), mutants.tell(mutant),
      test and " by " .. test.name or "", os.time() - began))
    if how == "lived" then
      table.insert(trial.living, place_of(mutant) .. " " .. mutants.tell(mutant))
    end
    if how == "killed" or how == "late" or how == "lived" then counts.run = counts.run + 1 end
    if not is_line and asked.sample > 0 and counts.run >= asked.sample then break end
  end
  return counts
end

local function report(rows, living)
  print(("\n%-28s %6s %6s %9s %6s %7s %10s %6s"):format("place", "run", "killed", "timed out",
    "lived", "share", "the same", "no C"))
  for _, row in ipairs(rows) do
    local place, c = row[1], row[2]
    local share = c.run > 0 and ("%.0f %%"):format(100 * (c.killed + c.late) / c.run) or "-"
    print(("%-28s %6d %6d %9d %6d %7s %10d %6d"):format(place, c.run, c.killed, c.late, c.lived,
      share, c.equal + c.explained, c.broken))
  end
  if #living > 0 then print("\nNo test saw:\n  " .. table.concat(living, "\n  ")) end
end

-- ---------------------------------------------------------------- the program

local asked = read_words(arg)
for _, place in ipairs(asked.places) do files_of(place) end
io.stdout:setvbuf "line"
local shop, message = workshop.open()
if not shop then fail("%s", message) end
local trial = setmetatable({ shop = shop, living = {}, is_left_out = {} }, Trial)
local rows = {}
for i, place in ipairs(asked.places) do rows[i] = { place, try_place(trial, place, asked) } end
report(rows, trial.living)
os.exit(next(trial.is_left_out) and 2 or #trial.living > 0 and 1 or 0)
