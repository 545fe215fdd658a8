--- celspan test [SPEC ...]: busted in this program's own interpreter, several spec files at a time.
--
--   list of files --> a process each (spec.lua), as many as workers --> one summary
--
-- What is printed is in the order of the list, whichever process ends first.
local program, request = ...

local OUTPUT, MEMORY, DIFFERENT = 5, 33, 1 -- exit codes
local OWN = { ["--junit"] = true, ["--only"] = true, ["--workers"] = true }
local ENDING, FOLDERS_DEEP, PATH_MOST = "_spec.lua", 32, 4095

-- ---------------------------------------------------------------- which

--- Adds the specs below a folder. entries: of this folder.
local function add_folder(list, folder, entries, depth)
  for _, name in ipairs(entries) do
    local path = folder .. "/" .. name
    if name:sub(1, 1) ~= "." and #path <= PATH_MOST then
      local inner, message, how = program.entries(path)
      if inner and depth + 1 < FOLDERS_DEEP then
        add_folder(list, path, inner, depth + 1)
      elseif inner == nil and how ~= "missing" then
        program.fail("input", "%s: cannot be read: %s", path, message)
      elseif not inner and #name > #ENDING and name:sub(-#ENDING) == ENDING then
        list[#list + 1] = path
      end
    end
  end
end

--- The spec files of an operand, a file or a folder.
local function specs_of(path)
  local entries, message = program.entries(path)
  if entries == nil then program.fail("input", "%s: cannot be opened: %s", path, message) end
  if not entries then return { path } end
  local list = {}
  add_folder(list, path, entries, 0)
  if #list == 0 then program.fail("input", "%s: no file in it ends in %s", path, ENDING) end
  table.sort(list)
  return list
end

local function all_specs()
  local runs = {}
  for _, operand in ipairs(request[1] and request or { "spec" }) do
    for _, path in ipairs(specs_of(operand)) do
      runs[#runs + 1] = { path = path, tests = {}, passed = 0, failed = 0, skipped = 0 }
    end
  end
  return runs
end

-- ---------------------------------------------------------------- one spec file

--- Starts the process; nil: it could not be started, and this was reported.
local function start(run)
  local message, other
  run.records, message = io.tmpfile()
  run.printed, other = io.tmpfile()
  if run.records and run.printed then
    local words = program.pass_on({ "spec" }, request, OWN, {})
    table.move({ "--", run.path, request.only }, 1, 3, #words + 1, words)
    run.process, message = program.start(words, run.printed, run.records)
  end
  if not run.process then
    program.error("%s: cannot be run: no process could be started: %s", run.path, message or other)
  end
  return run.process
end

local COUNTS = { pass = "passed", skip = "skipped", fail = "failed" }

--- Counts a result, and prints it for a skipped or failed test.
local function add_test(run, test)
  local counted = COUNTS[test.kind]
  run[counted] = run[counted] + 1
  run.tests[#run.tests + 1] = test
  if test.kind ~= "pass" then print(counted .. ": " .. test.message) end
end

--- Adds the results that the process recorded (spec.lua). Returns whether it ran all tests.
local function read_records(run)
  run.records:seek "set"
  for line in run.records:lines() do
    local kind, seconds, name, text = line:match "^(%l+) (%S+) (%d+) (%d+)$"
    if kind == "done" then return true end
    add_test(run, { kind = kind, seconds = tonumber(seconds),
                    name = run.records:read(math.tointeger(name)) or "",
                    message = run.records:read(math.tointeger(text)) or "" })
  end
  return false
end

local function report_death(run, code, signal, name)
  local how = code and ("ended before its tests did, with exit code %d"):format(code)
    or ("was ended by signal %d (%s)"):format(signal, name)
  add_test(run, { kind = "fail", seconds = 0, name = run.path, message = run.path .. " " .. how })
end

local function print_run(run, ...)
  if not read_records(run) then report_death(run, ...) end
  run.printed:seek "set"
  local printed = run.printed:read "a"
  if printed ~= "" then io.write("printed by ", run.path, ":\n", printed) end
  print(("%s: %d passed, %d failed, %d skipped"):format(run.path, run.passed, run.failed,
    run.skipped))
  io.stdout:flush()
  run.records:close()
  run.printed:close()
end

-- ---------------------------------------------------------------- all of them

local function sum_up(runs, count, is_well, begun)
  local passed, failed, skipped = 0, 0, 0
  for i = 1, count do
    passed, failed = passed + runs[i].passed, failed + runs[i].failed
    skipped = skipped + runs[i].skipped
  end
  print(("%d passed, %d failed, %d skipped in %d spec file%s, %.1f seconds"):format(passed, failed,
    skipped, count, count == 1 and "" or "s", program.clock() - begun))
  if not is_well then return MEMORY end
  if passed + failed + skipped == 0 and not program.is_stopped() then
    program.error("%s", request.only and "no test has a name that matches --only"
      or "the spec files contain no tests")
    return DIFFERENT
  end
  return failed > 0 and DIFFERENT or 0
end

if not package.searchpath("busted.runner", package.path) then
  program.error("busted is not installed: it runs the specs. Install the Debian package "
    .. "lua-busted, or `luarocks --lua-version 5.4 install busted`")
  return OUTPUT
end
local runs, begun = all_specs(), program.clock()
local workers = math.tointeger(request.workers) or program.processors()
local place = 0
local count, is_well = program.run_all(function()
  place = place + 1
  return runs[place]
end, workers, start, print_run)
if request.junit then
  program.save(request.junit, program.part("junit.lua", program).report(runs, count))
end
return sum_up(runs, count, is_well, begun)
