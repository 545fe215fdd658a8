--- The rows of --table FILE: films that differ by their parameters, each with an output of its own.
--
-- Rows are read from the text one by one, twice, so that only the names of the outputs are kept.
--
--   rows.count    how many there are, all of which were checked
--   rows.next()   the next row: { line =, output =, settings = { { name, value }, ... } } | nil
local program, request, film = ...
local csv = require "celspan.csv"
local json = require "celspan.json"

local is_check = request.verb == "check" -- no files are written
local PIECE = 65536 -- bytes of the table that are read at a time

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

--- Whether {name} in OUT is the place for the names of sounds, and not for a column.
local function is_for_stems(name) return request.stems and name == "name" end

--- The output of a row: each {name} in OUT is replaced by the text in that column. For `check`, the
--- line of the row.
local function output_of(row, line, columns)
  if is_check then return "line " .. line end
  local output = request.output:gsub("{([%w_]+)}", function(name)
    if is_for_stems(name) then return nil end
    local text = row[columns[name]]
    if text == "" or text:find "/" or text:find("..", 1, true) or text:find "%c" then
      program.usage("--table %s: line %d: column '%s' is '%s': in the name of a file it must not "
        .. "be empty nor have / or .. in it", request.table, line, name, text)
    end
    return text
  end)
  if #output > program.path_most then
    program.usage("--table %s: line %d: the name of the output has more than %d bytes",
      request.table, line, program.path_most)
  end
  return output
end

-- ---------------------------------------------------------------- checks

--- The names of the script's parameters, as keys.
local function parameters()
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
    local has_place = request.output:find("{" .. name .. "}", 1, true) and not is_for_stems(name)
    if not is_parameter[name] and is_for_stems(name) then
      program.usage("--table %s: {name} in OUT is the name of a sound with --stems: call the "
        .. "column 'name' otherwise", request.table)
    elseif not is_parameter[name] and not has_place then
      program.usage("--table %s: column '%s' is neither a parameter of the script nor {%s} in OUT",
        request.table, name, name)
    end
  end
  for name in request.output:gmatch "{([%w_]+)}" do
    if not columns[name] and not is_for_stems(name) then
      program.usage("--table %s: there is no column '%s' for {%s} in OUT; there are %s",
        request.table, name, name, table.concat(header, ", "))
    end
  end
  return columns
end

--- Checks the values of every row, and that no two rows have the same output. Returns the number of
--- rows.
local function check_rows(text, columns, is_parameter)
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

if not is_check and (not request.output or request.output == "-") then
  program.usage("--table writes files: name them by its columns, as -o {NAME}.%s",
    ({ render = "mp4", sound = "wav" })[request.verb] or "png")
end
local text, is_parameter = read_text(request.table), parameters()
local header, next_row = reader(text)
local columns = check_header(header, is_parameter)
local rows = { count = check_rows(text, columns, is_parameter) }

function rows.next()
  local row, line = next_row()
  if not row then return nil end
  local settings = {}
  for i, name in ipairs(header) do
    if is_parameter[name] then settings[#settings + 1] = { name, row[i] } end
  end
  return { line = line, output = output_of(row, line, columns), settings = settings }
end

return rows
