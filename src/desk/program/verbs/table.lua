--- celspan render|sound|contact|check SCRIPT --table FILE: the same with each row of a table.
--
--   table --> every row is checked --> a process a row, with --set, as many as workers --> summary
--
-- With --task I/N, only the I-th of N parts of the rows are made; all of them are checked.
-- --keep-going is about rows, and the process of a row does not get it. It gets --resume: it keeps
-- what would come out the same, which its events report.
local program, request = ...
local json = require "celspan.json"

local is_check = request.verb == "check" -- no files are written
local has_events = not is_check
local is_json = request.progress == "json"
local NAMED_MOST = 20 -- the most failed rows that the summary names

--- The options that are not passed to a row's process, because it has its own values for them, or
--- no use.
local own = { ["-o"] = true, ["--table"] = true, ["--workers"] = true, ["--progress"] = true,
              ["--keep-going"] = true, ["--task"] = true, ["--log"] = true }

local function words_of(item, threads)
  local words = { request.verb, request[1] }
  local function add(name, value) table.move({ name, value }, 1, 2, #words + 1, words) end
  if not is_check then add("-o", item.output) end
  if request.verb ~= "sound" and not is_check then
    add("--workers", tostring(threads))
  end
  if has_events then add("--progress", "json") end
  if item.log then add("--log", item.log) end
  return program.pass_on(words, request, own, item.settings)
end

-- ---------------------------------------------------------------- the processes

--- Starts the process of an item; nil and an exit code: it needs none; nil: it could not be
--- started, and this was reported.
local function start(item)
  if item.fault then return nil, 2 end
  local process, message
  item.printed, message = io.tmpfile()
  if item.printed then process, message = program.start(item.words, item.printed) end
  if not process then program.error("%s: no process for it: %s", item.output, message) end
  return process
end

--- An event that a process printed as a line; nil: the line is something else.
local function event_of(line)
  local event = has_events and line:sub(1, 1) == "{" and json.decode(line)
  return type(event) == "table" and event.event and event or nil
end

--- Writes an event as a line of JSON, if the request asks for this.
local function tell(event)
  if is_json then io.stderr:write((program.json(event):gsub("\n *", "")), "\n") end
end

--- How a message of a process is shown in words.
local SHOWN = {
  error = function(text) program.error("%s", text) end,
  note = function(text) program.note("%s", text) end,
  print = function(text) program.show(text .. "\n") end,
}

--- Shows the output of a process; its exit code says what went wrong. Returns its last event.
local function show(item)
  local last
  item.printed:seek "set"
  for line in item.printed:lines "L" do
    local event = event_of(line)
    last = event or last
    if not event then
      program.show(line)
    elseif SHOWN[event.event] and is_json then
      event.line, event.output = item.line, item.output
      tell(event)
    elseif SHOWN[event.event] then
      SHOWN[event.event](event.message)
    end
  end
  item.printed:close()
  return last
end

-- ---------------------------------------------------------------- reports

--- Counts what was done with the rows; updated when they end.
local function new_tally(count)
  return { count = count, made = 0, kept = 0, failed = {}, outcome = 0, began = program.clock() }
end

local function place_of(item)
  return is_check and item.output or ("line %d (%s)"):format(item.line, item.output)
end

--- How many rows have ended: those that are whole, and those that failed.
local function ended_of(tally) return tally.made + tally.kept + #tally.failed end

--- Reports a row that has ended. code: its exit code if it failed.
local function tell_row(tally, item, how, code)
  tell { event = "row", line = item.line, output = item.output, how = how, exit = code,
         done = tally.made + tally.kept, failures = #tally.failed, count = tally.count }
  if request.progress == "openjd" then
    print(("openjd_progress: %.1f"):format(100 * ended_of(tally) / tally.count))
  end
end

--- Counts a row that is finished; last: the last event of its process.
local function count_row(tally, item, last)
  local is_kept = last and last.event == "end" and last.kept == last.count
  local how = is_kept and "kept" or "made"
  tally[how] = tally[how] + 1
  tell_row(tally, item, how)
  if not is_json and request.progress ~= "none" then
    program.note("%d/%d %s%s", ended_of(tally), tally.count, item.output,
      is_kept and ": kept" or "")
  end
end

local function count_failure(tally, item, code, signal, name)
  table.insert(tally.failed, item)
  if tally.outcome == 0 then tally.outcome = code or 128 + signal end
  program.row(item.line, item.output)
  program.error("--table %s: %s: %s", request.table, place_of(item), item.fault or code
    and "exit code " .. code or "ended by signal " .. signal .. " (" .. name .. ")")
  program.row()
  tell_row(tally, item, "failed", code or 128 + signal)
end

--- "39 made, 1 failed: line 18 (r17.mp4)".
local function summary_of(tally)
  local parts, names = {}, {}
  local function add(number, how)
    if number > 0 then parts[#parts + 1] = number .. " " .. how end
  end
  add(tally.made, is_check and "without a fault" or "made")
  add(tally.kept, "kept")
  add(#tally.failed, "failed")
  add(tally.count - ended_of(tally), "not begun or not finished")
  for i = 1, math.min(NAMED_MOST, #tally.failed) do names[i] = place_of(tally.failed[i]) end
  if #tally.failed > NAMED_MOST then names[#names + 1] = "and others" end
  return table.concat(parts, ", ") .. (names[1] and ": " .. table.concat(names, ", ") or "")
end

local function sum_up(tally, code)
  local stopped_by = program.is_stopped()
  local lines, outputs = { list = {} }, { list = {} }
  for i, item in ipairs(tally.failed) do
    lines.list[i], outputs.list[i] = item.line, item.output
  end
  tell { event = "end", done = tally.made + tally.kept, count = tally.count, kept = tally.kept,
         failures = #tally.failed, failed = lines, outputs = outputs,
         exit = stopped_by and 128 + stopped_by or code,
         seconds = math.floor((program.clock() - tally.began) * 1000) / 1000 }
  if is_json then return end
  if #tally.failed > 0 then
    program.error("--table %s: %s", request.table, summary_of(tally))
  elseif request.progress ~= "none" then
    program.note("--table %s: %s", request.table, summary_of(tally))
  end
end

-- ---------------------------------------------------------------- the run

--- The first and the last row of this task; of all rows if there are no tasks.
local function share_of(count)
  local number, of = program.task()
  if not number then return 1, count end
  return count * (number - 1) // of + 1, count * number // of
end

--- Makes rows; returns the exit code.
local function make_rows(tally, rows, first)
  local workers = math.tointeger(request.workers) or 0
  if workers == 0 then workers = program.processors() end
  local threads = math.max(1, workers // tally.count)
  local taken = 0
  for _ = 2, first do rows.next() end
  local function next_item()
    if taken == tally.count then return nil end
    taken = taken + 1
    local item = rows.next()
    item.words = words_of(item, threads)
    return item
  end
  local function finish(item, code, ...)
    local last = not item.fault and show(item)
    item.words = nil
    if code == 0 then
      count_row(tally, item, last)
      return true
    end
    -- A row that the same signal stopped has not failed.
    if program.is_stopped() and (code or 128) >= 128 then return false end
    count_failure(tally, item, code, ...)
    return request.keep_going ~= nil or is_check
  end
  local _, is_well = program.run_all(next_item, math.min(workers, tally.count), start, finish)
  if not is_well then return 33 end
  return #tally.failed > 0 and request.keep_going and 1 or tally.outcome
end

if request.hash then program.usage("--table renders several films: leave --hash out") end
if request.report then program.usage("--report is of one film: leave it or --table out") end
if request.files then program.usage "--table checks several films: leave --files out" end
if request.json then program.usage("--table checks several films: leave --json out") end
local rows = program.part("rows.lua", program, request, program.script())
local first, last = share_of(rows.count)
local tally = new_tally(last - first + 1)
if tally.count == 0 then return program.note("task %d of %d has no rows", program.task()) end
tell { event = "start", count = tally.count }
local code = make_rows(tally, rows, first)
sum_up(tally, code)
return code
