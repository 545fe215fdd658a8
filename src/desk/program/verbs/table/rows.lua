--- The rows of --table FILE: films that differ by their parameters, each with an output of its own.
--
-- Rows are read from the text one by one, twice, so that only the names of the outputs are kept.
--
--   rows.count    how many there are, all of which were checked
--   rows.next()   the next row: { line =, output =, settings = { { name, value }, ... }, log =,
--                 fault = } | nil
--
--   log     of --log, if it is given
--   fault   a sentence about a value that the script does not allow: only of `check`, and with
--           --keep-going; otherwise the whole table is refused for it
local program, request, script = ...
local csv = require "celspan.csv"
local fields = require "celspan.fields"
local json = require "celspan.json"
local ordered = require "celspan.ordered"

local is_check = request.verb == "check" -- no files are written
local is_lenient = is_check or request.keep_going -- a row that is wrong fails alone
local PIECE = 65536 -- bytes of the table that are read at a time

-- ---------------------------------------------------------------- the table

--- The text of the table, which may come through a pipe.
local function read_text(path)
  local pieces, size = {}, 0
  local file, message = io.open(path == "-" and "/dev/stdin" or path, "rb")
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
  local text = table.concat(pieces)
  if text:find "^%s*[{[]" then
    program.fail("input", "--table %s: this is JSON, and a table is CSV: its first line has the "
      .. "names of the columns, and each other line is a row", path)
  end
  return text
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

--- A name of a file in which each {name} is replaced by the text in that column of a row.
local function filled(pattern, row, line, columns)
  local path = pattern:gsub("{([%w_]+)}", function(name)
    if is_for_stems(name) then return nil end
    local text = row[columns[name]]
    if text == "" or text:find "/" or text:find("..", 1, true) or text:find "%c" then
      program.usage("--table %s: line %d: column '%s' is '%s': in the name of a file it must not "
        .. "be empty nor have / or .. in it", request.table, line, name, text)
    end
    return text
  end)
  if #path > program.path_most then
    program.usage("--table %s: line %d: the name of the output has more than %d bytes",
      request.table, line, program.path_most)
  end
  return path
end

--- The output of a row; for `check`, its line.
local function output_of(row, line, columns)
  return is_check and "line " .. line or filled(request.output, row, line, columns)
end

--- A sentence about the first value of a row that the script does not allow; nil: it allows all.
local function fault_of(row, header, is_parameter)
  for i, name in ipairs(header) do
    local fault = is_parameter[name]
      and script:ask("celspan.parameters", "fault", name .. "=" .. row[i]) or ""
    if fault ~= "" then return fault end
  end
end

-- ---------------------------------------------------------------- checks

--- The names of the script's parameters, as keys.
local function parameters()
  local names = {}
  local schema = json.decode(script:ask("celspan.parameters", "schema", ""))
  for name in pairs(assert(schema).properties) do names[name] = true end
  return names
end

--- The end of a message about a column that nothing uses: what was probably meant.
local function meant_by(name, is_parameter)
  local names = ordered.names(is_parameter)
  for known in (request.output or ""):gmatch "{([%w_]+)}" do names[#names + 1] = known end
  return fields.hint(name, names) or ""
end

--- Warns of columns that are probably meant as parameters: of misspelled ones, and of all, if none
--- is one. The others may be for names of files.
local function warn_of(header, is_parameter)
  local is_any = false
  for _, name in ipairs(header) do
    local hint = is_parameter[name] and "" or meant_by(name, is_parameter)
    is_any = is_any or is_parameter[name] or hint ~= ""
    if hint ~= "" then
      program.note("warning: --table %s: column '%s' is no parameter of the script%s",
        request.table, name, hint)
    end
  end
  if not is_any then
    local names = table.concat(ordered.names(is_parameter), ", ")
    program.note("warning: --table %s: no column is a parameter of the script; %s", request.table,
      names == "" and "it declares none" or "there are " .. names)
  end
end

--- The places of the columns by their names.
local function check_header(header, is_parameter)
  if #header == 0 then
    program.usage("--table %s: it is empty: its first line names the columns", request.table)
  end
  local columns = try(csv.columns, header)
  if is_check then
    warn_of(header, is_parameter)
    return columns
  end
  local places = request.output .. (request.log or "")
  for _, name in ipairs(header) do
    local has_place = places:find("{" .. name .. "}", 1, true) and not is_for_stems(name)
    if not is_parameter[name] and is_for_stems(name) then
      program.usage("--table %s: {name} in OUT is the name of a sound with --stems: call the "
        .. "column 'name' otherwise", request.table)
    elseif not is_parameter[name] and not has_place then
      program.usage("--table %s: column '%s' is neither a parameter of the script nor {%s} in "
        .. "OUT%s", request.table, name, name, meant_by(name, is_parameter))
    end
  end
  for name in places:gmatch "{([%w_]+)}" do
    if not columns[name] and not is_for_stems(name) then
      program.usage("--table %s: there is no column '%s' for {%s} in %s; there are %s",
        request.table, name, name, request.output:find("{" .. name .. "}", 1, true) and "OUT"
        or "--log", table.concat(header, ", "))
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
    local fault = not is_lenient and fault_of(row, header, is_parameter)
    if fault then program.usage("--table %s: line %d: %s", request.table, line, fault) end
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
  return { line = line, output = output_of(row, line, columns), settings = settings,
           log = request.log and filled(request.log, row, line, columns),
           fault = is_lenient and fault_of(row, header, is_parameter) or nil }
end

return rows
