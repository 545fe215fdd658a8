--- celspan render|sound|contact|check SCRIPT --table FILE: the same with each row of a table.
--
--   table --> every row is checked --> a process a row, with --set, as many as workers --> summary
--
-- Rows are read from the text one by one, twice, so that only the names of the outputs are kept.
-- --keep-going is about rows, and the process of a row does not get it. It gets --resume: it keeps
-- what would come out the same, which its events report.
local program, request = ...
local csv = require "celspan.csv"
local json = require "celspan.json"

local is_check = request.verb == "check" -- no files are written
local has_events = request.verb == "render" or request.verb == "sound"
local is_json = request.progress == "json"
local NAMED_MOST = 20 -- the most failed rows that the summary names
local OUTPUT_MOST = 4095 -- the most bytes of a name
local PIECE = 65536      -- bytes of the table that are read at a time

-- ---------------------------------------------------------------- the table

--- The text of the table, which may come through a pipe.
local function read_text(path)
  local pieces, size = {}, 0
  local file, message = io.open(path, "rb")
  while file and size <= csv.most_bytes do
    local piece, problem = file:read(PIECE)
    if problem then program.fail("input", "--table %s: %s", path, problem) end
    if not piece then break end
    pieces[#pieces + 1], size = piece, size + #piece
  end
  if not file then program.fail("input", "--table %s", message) end
  file:close()
  if size > csv.most_bytes then
    program.fail("input", "--table %s: it has more than %d bytes, which is the limit", path,
      csv.most_bytes)
  end
  return table.concat(pieces)
end

--- Returns the results of a call that reads the table.
local function try(call, ...)
  local good, one, other = pcall(call, ...)
  if good then return one, other end
  program.fail("input", "--table %s: %s", request.table, type(one) == "table" and one.message
    or one)
end

--- Returns the names of the columns, and a function that returns each row of texts with its line,
--- and nil after the last row.
local function reader(text)
  local header, next_row = try(csv.rows, text)
  return header, function() return try(next_row) end
end

-- ---------------------------------------------------------------- a row

--- The output of a row: each {name} in OUT is replaced by the text in that column. For `check`, the
--- line of the row.
local function output_of(row, line, columns)
  if is_check then return "line " .. line end
  local output = request.output:gsub("{([%w_]+)}", function(name)
    local text = row[columns[name]]
    if text == "" or text:find "/" or text:find("..", 1, true) or text:find "%c" then
      program.usage("--table %s: line %d: column '%s' is '%s': in the name of a file it must not "
        .. "be empty nor have / or .. in it", request.table, line, name, text)
    end
    return text
  end)
  if #output > OUTPUT_MOST then
    program.usage("--table %s: line %d: the name of the output has more than %d bytes",
      request.table, line, OUTPUT_MOST)
  end
  return output
end

--- The options that are not passed to a row's process, because it has its own values for them, or
--- no use.
local own = { ["-o"] = true, ["--table"] = true, ["--workers"] = true, ["--progress"] = true,
              ["--keep-going"] = true }

local function words_of(row, output, header, is_parameter, threads)
  local settings = {}
  for i, name in ipairs(header) do
    if is_parameter[name] then settings[#settings + 1] = { name, row[i] } end
  end
  local words = { request.verb, request[1] }
  local function add(name, value) table.move({ name, value }, 1, 2, #words + 1, words) end
  if not is_check then add("-o", output) end
  if request.verb == "render" or request.verb == "contact" then
    add("--workers", tostring(threads))
  end
  if has_events then add("--progress", "json") end
  return program.pass_on(words, request, own, settings)
end

-- ---------------------------------------------------------------- checks

--- The names of the script's parameters, as keys.
local function parameters_of(film)
  local names = {}
  for name in pairs(assert(json.decode(film:ask("celspan.parameters", "schema", ""))).properties) do
    names[name] = true
  end
  return names
end

--- The places of the columns by their names.
local function check_header(header, is_parameter)
  if #header == 0 then
    program.usage("--table %s: it is empty: its first line names the columns", request.table)
  end
  local columns = try(csv.columns, header)
  if is_check then return columns end
  for _, name in ipairs(header) do
    if not is_parameter[name] and not request.output:find("{" .. name .. "}", 1, true) then
      program.usage("--table %s: column '%s' is neither a parameter of the script nor {%s} in OUT",
        request.table, name, name)
    end
  end
  for name in request.output:gmatch "{([%w_]+)}" do
    if not columns[name] then
      program.usage("--table %s: there is no column '%s' for {%s} in OUT; there are %s",
        request.table, name, name, table.concat(header, ", "))
    end
  end
  return columns
end

--- Checks the values of every row, and that no two rows have the same output. Returns the number of
--- rows.
local function check_rows(text, film, columns, is_parameter)
  local header, next_row = reader(text)
  local lines, count = {}, 0
  for row, line in next_row do
    for i, name in ipairs(header) do
      local fault = is_parameter[name]
        and film:ask("celspan.parameters", "fault", name .. "=" .. row[i]) or ""
      if fault ~= "" then
        program.usage("--table %s: line %d: %s", request.table, line, fault)
      end
    end
    local output = output_of(row, line, columns)
    if lines[output] then
      program.usage("--table %s: lines %d and %d would both make %s: put a column in OUT, as "
        .. "{NAME}", request.table, lines[output], line, output)
    end
    lines[output], count = line, count + 1
  end
  if count == 0 then program.usage("--table %s: it has no rows", request.table) end
  return count
end

-- ---------------------------------------------------------------- the processes

--- Starts the process of an item; nil: it could not be started, and this was reported.
local function start(item)
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

--- Shows the output of a process; its exit code says what went wrong. Returns its last event.
local function show(item)
  local last
  item.printed:seek "set"
  for line in item.printed:lines "L" do
    local event = event_of(line)
    last = event or last
    if not event then
      io.stderr:write(line)
    elseif event.event == "error" and not is_json then
      program.error("%s", event.message)
    elseif event.event == "note" and not is_json then
      program.note("%s", event.message)
    elseif event.event == "error" or event.event == "note" then
      io.stderr:write(line)
    end
  end
  item.printed:close()
  return last
end

-- ---------------------------------------------------------------- reports

--- Writes an event as a line of JSON, if the request asks for this.
local function tell(event)
  if is_json then io.stderr:write((program.json(event):gsub("\n *", "")), "\n") end
end

--- Counts what was done with the rows; updated when they end.
local function new_tally(count)
  return { count = count, ended = 0, made = 0, kept = 0, failed = {}, outcome = 0,
           began = program.clock() }
end

local function place_of(item)
  return is_check and item.output or ("line %d (%s)"):format(item.line, item.output)
end

--- Counts a row that is finished; last: the last event of its process.
local function count_row(tally, item, last)
  local is_kept = last and last.event == "end" and last.kept == last.count
  local how = is_kept and "kept" or "made"
  tally[how] = tally[how] + 1
  tell { event = "row", line = item.line, output = item.output, how = how, done = tally.ended,
         count = tally.count }
  if not is_json and request.progress ~= "none" then
    program.note("%d/%d %s%s", tally.ended, tally.count, item.output, is_kept and ": kept" or "")
  end
end

local function count_failure(tally, item, code, signal, name)
  table.insert(tally.failed, item)
  if tally.outcome == 0 then tally.outcome = code or 128 + signal end
  program.error("--table %s: %s: %s", request.table, place_of(item),
    code and "exit code " .. code or "ended by signal " .. signal .. " (" .. name .. ")")
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
  add(tally.count - tally.ended, "not begun or not finished")
  for i = 1, math.min(NAMED_MOST, #tally.failed) do names[i] = place_of(tally.failed[i]) end
  if #tally.failed > NAMED_MOST then names[#names + 1] = "and others" end
  return table.concat(parts, ", ") .. (names[1] and ": " .. table.concat(names, ", ") or "")
end

local function sum_up(tally, code)
  local lines, outputs = { list = {} }, { list = {} }
  for i, item in ipairs(tally.failed) do
    lines.list[i], outputs.list[i] = item.line, item.output
  end
  tell { event = "end", done = tally.made + tally.kept, count = tally.count, kept = tally.kept,
         failures = #tally.failed, failed = lines, outputs = outputs, exit = code,
         seconds = math.floor((program.clock() - tally.began) * 1000) / 1000 }
  if is_json then return end
  if #tally.failed > 0 then
    program.error("--table %s: %s", request.table, summary_of(tally))
  elseif request.progress ~= "none" then
    program.note("--table %s: %s", request.table, summary_of(tally))
  end
end

-- ---------------------------------------------------------------- the run

--- Makes the rows of a table; returns the exit code.
local function make_rows(tally, text, columns, is_parameter)
  local workers = math.tointeger(request.workers) or 0
  if workers == 0 then workers = program.processors() end
  local threads = math.max(1, workers // tally.count)
  local header, next_row = reader(text)
  local function next_item()
    local row, line = next_row()
    if not row then return nil end
    local output = output_of(row, line, columns)
    return { line = line, output = output,
             words = words_of(row, output, header, is_parameter, threads) }
  end
  local function finish(item, code, ...)
    local last = show(item)
    item.words = nil
    tally.ended = tally.ended + 1
    if code == 0 then
      count_row(tally, item, last)
      return true
    end
    count_failure(tally, item, code, ...)
    return request.keep_going ~= nil or is_check
  end
  local _, is_well = program.run_all(next_item, math.min(workers, tally.count), start, finish)
  if not is_well then return 33 end
  return #tally.failed > 0 and request.keep_going and 1 or tally.outcome
end

local function run(text, count, columns, is_parameter)
  local tally = new_tally(count)
  tell { event = "start", count = count }
  local code = make_rows(tally, text, columns, is_parameter)
  sum_up(tally, code)
  return code
end

if request.hash then program.usage("--table renders several films: leave --hash out") end
if request.json then program.usage("--table checks several films: leave --json out") end
if not is_check and (not request.output or request.output == "-") then
  program.usage("--table writes files: name them by its columns, as -o {NAME}.%s",
    ({ render = "mp4", sound = "wav" })[request.verb] or "png")
end
local text, film = read_text(request.table), program.film()
local is_parameter, header = parameters_of(film), reader(text)
local columns = check_header(header, is_parameter)
return run(text, check_rows(text, film, columns, is_parameter), columns, is_parameter)
