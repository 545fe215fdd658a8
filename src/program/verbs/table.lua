--- celspan render|contact|check SCRIPT --table FILE: the same with each row of a table.
--
--   table --> every row is checked --> a process a row, with --set, as many as workers
--
-- Rows are read from the text one by one, twice, so that only the names of the outputs are kept.
local program, request = ...
local csv = require "celspan.csv"
local json = require "celspan.json"

local is_check = request.verb == "check" -- no files are written
local OUTPUT_MOST = 4095 -- bytes of a name
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

--- What a call that reads the table returns.
local function try(call, ...)
  local good, one, other = pcall(call, ...)
  if good then return one, other end
  program.fail("input", "--table %s: %s", request.table, type(one) == "table" and one.message
    or one)
end

--- The names of the columns, and a function that returns a row of texts and its line, and nil after
--- the last.
local function reader(text)
  local header, next_row = try(csv.rows, text)
  return header, function() return try(next_row) end
end

-- ---------------------------------------------------------------- a row

--- The output of a row: each {name} in OUT is the text in that column. Of `check`: its line.
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

--- The options that a row's process has values of its own for, or no use.
local own = { ["-o"] = true, ["--table"] = true, ["--workers"] = true, ["--progress"] = true }

local function words_of(row, output, header, is_parameter, threads)
  local settings = {}
  for i, name in ipairs(header) do
    if is_parameter[name] then settings[#settings + 1] = { name, row[i] } end
  end
  local words = { request.verb, request[1] }
  local function add(name, value) table.move({ name, value }, 1, 2, #words + 1, words) end
  if not is_check then
    add("-o", output)
    add("--workers", tostring(threads))
  end
  if request.verb == "render" then add("--progress", "none") end
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

--- Checks the values of every row, and that no two have the same output. Returns how many there
--- are.
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

--- Starts the process of an item; nil: reported.
local function start(item)
  local process, message
  item.printed, message = io.tmpfile()
  if item.printed then process, message = program.start(item.words, item.printed) end
  if not process then program.error("%s: no process for it: %s", item.output, message) end
  return process
end

--- Shows what a process printed; what went wrong is known by its exit code.
local function show(item)
  item.printed:seek "set"
  io.stderr:write((item.printed:read "a"))
  item.printed:close()
end

local function run(text, count, columns, is_parameter)
  local workers = math.tointeger(request.workers) or 0
  if workers == 0 then workers = program.processors() end
  local threads = math.max(1, workers // count)
  local header, next_row = reader(text)
  local place, failed, outcome = 0, 0, 0
  local function next_item()
    local row, line = next_row()
    if not row then return nil end
    local output = output_of(row, line, columns)
    return { line = line, output = output,
             words = words_of(row, output, header, is_parameter, threads) }
  end
  local function finish(item, code, signal, name)
    show(item)
    place = place + 1
    if code == 0 then
      if request.progress ~= "none" then program.note("%d/%d %s", place, count, item.output) end
      return true
    end
    failed = failed + 1
    if outcome == 0 then outcome = code or 128 + signal end
    local where = is_check and item.output or ("line %d (%s)"):format(item.line, item.output)
    program.error("--table %s: %s: %s", request.table, where,
      code and "exit code " .. code or "ended by signal " .. signal .. " (" .. name .. ")")
    return request.keep_going ~= nil or is_check
  end
  local _, is_well = program.run_all(next_item, math.min(workers, count), start, finish)
  if not is_well then return 33 end
  return failed > 0 and request.keep_going and 1 or outcome
end

if request.hash then program.usage("--table renders several films: leave --hash out") end
if request.json then program.usage("--table checks several films: leave --json out") end
if not is_check and (not request.output or request.output == "-") then
  program.usage("--table writes files: name them by its columns, as -o {NAME}.%s",
    request.verb == "render" and "mp4" or "png")
end
local text, film = read_text(request.table), program.film()
local is_parameter, header = parameters_of(film), reader(text)
local columns = check_header(header, is_parameter)
return run(text, check_rows(text, film, columns, is_parameter), columns, is_parameter)
