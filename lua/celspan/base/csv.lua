--- Tables as comma-separated values (RFC 4180) or with another separator.
--
--   local rows = assert(csv.read("cast.csv", { types = { age = "number" } }))
--   rows[1].name, rows[1].age, rows[1][2]
--
-- Fields may be in quotes, where "" is a quote and a line may end. Lines end with CR LF or LF;
-- empty lines are skipped. Every row has as many fields as the first.
local native = require "celspan.native"
local fields = require "celspan.fields"
local files = require "celspan.files"
local values = require "celspan.values"

local csv = {}

--- Longer texts are refused.
csv.most_bytes = 256 * 1024 * 1024

local function fail(line, format, ...)
  values.fail("line %d: %s", line, format:format(...))
end

local function trim(text) return text:match "^%s*(.-)%s*$" end

-- ---------------------------------------------------------------- records

--- A field in quotes. at: the first quote. Returns the field and the place after the last quote.
local function read_quoted(text, at, line)
  local stop = at
  repeat
    stop = text:find('"', stop + 1, true)
    if not stop then fail(line, "a quote is not closed") end
    local is_double = text:byte(stop + 1) == 34
    if is_double then stop = stop + 1 end
  until not is_double
  return text:sub(at + 1, stop - 1):gsub('""', '"'), stop + 1
end

--- Reads the record at `at`: returns its fields, the place of the next record, and its line. Raises
--- { message = }. is_loose: white space around fields is removed.
function csv.record(text, at, line, separator, is_loose)
  local record, count, lines = {}, 0, 0
  local ends = "[\n" .. separator:gsub("%W", "%%%0") .. "]"
  while true do
    local start = is_loose and text:find("[^ \t]", at) or at
    local field, stop
    if text:byte(start) == 34 then
      field, stop = read_quoted(text, start, line + lines)
      lines = lines + select(2, field:gsub("\n", ""))
      if is_loose then stop = text:find("[^ \t]", stop) or #text + 1 end
      if text:sub(stop, stop + 1) == "\r\n" then stop = stop + 1 end
      if stop <= #text and text:find(ends, stop) ~= stop then
        fail(line + lines, "a separator (%s) is missing after a quote",
          separator == "\t" and "tab" or separator)
      end
    else
      stop = text:find(ends, at) or #text + 1
      field = text:sub(at, stop - 1)
      if text:byte(stop) ~= separator:byte() and field:byte(-1) == 13 then
        field = field:sub(1, -2)
      end
      if is_loose then field = trim(field) end
    end
    count = count + 1
    record[count] = field
    at = stop + 1
    if text:byte(stop) ~= separator:byte() then return record, at, line + lines + 1 end
  end
end

-- ---------------------------------------------------------------- tables

--- An empty field has no value, unless it is text.
local readers = {
  string = function(text) return text end,
  number = fields.read_number,
  boolean = fields.read_boolean,
}
local described = { number = "a number", boolean = fields.booleans }

--- Which of comma, semicolon and tab comes first in the first line, outside of quotes.
local function find_separator(text)
  local line = text:match "^[^\r\n]*":gsub('"[^"]*"', "")
  return line:match "[,;\t]" or ","
end

--- The indices of the columns by their names. Raises { message = } if two have the same name.
function csv.columns(header)
  local columns = {}
  for i, name in ipairs(header) do
    if name ~= "" and columns[name] then
      fail(1, "columns %d and %d are both named '%s'", columns[name], i, name)
    end
    columns[name] = i
  end
  return columns
end

local function check_types(types, header)
  local columns = csv.columns(header)
  for name in pairs(types) do
    if type(name) == "string" and not columns[name] then
      fail(1, "there is no column '%s', for which a type is given; there are %s", name,
        table.concat(header, ", "))
    end
  end
end

local function typed(text, kind, column, line, decimal)
  if kind == "string" then return text end
  if text:find "^%s*$" then return nil end
  local plain = trim(text)
  if kind == "number" and decimal == "," then plain = plain:gsub("%.", "x"):gsub(",", ".", 1) end
  local value = readers[kind](plain)
  if value == nil then
    fail(line, "column '%s' is '%s'; it must be %s", column, text, described[kind])
  end
  return value
end

--- The metatable of rows: a name that is not in the header is an error.
local function row_class(header)
  local names, is_named = {}, {}
  for _, name in ipairs(header) do
    if name ~= "" then names[#names + 1], is_named[name] = name, true end
  end
  return { __index = function(_, name)
    if type(name) ~= "string" or is_named[name] then return nil end
    local hint = native.nearest(name, names)
    native.refuse(("csv: there is no column '%s'; %s"):format(name, hint
      and ("did you mean '%s'?"):format(hint) or "there are " .. table.concat(names, ", ")))
  end }
end

local function make_row(record, header, types, line, decimal)
  local row = {}
  for i, text in ipairs(record) do
    local name = header and header[i]
    local value = typed(text, types[name] or types[i] or "string", name or i, line, decimal)
    row[i] = value
    if name and name ~= "" then row[name] = value end
  end
  return row
end

--- The first row of a text, and a function that returns the next row and its line, and nil after
--- the last row. Both raise { message = }.
function csv.rows(text, separator)
  local at, line, width = text:find "^\239\187\191" and 4 or 1, 1, nil -- after a byte order mark
  separator = separator or find_separator(text:sub(at, at + 65535))
  local function next_row()
    while at <= #text do
      local first, record = line
      record, at, line = csv.record(text, at, line, separator)
      if #record > 1 or record[1] ~= "" then
        width = width or #record
        if #record ~= width then
          fail(first, "the row has %d field%s; the first has %d", #record,
            #record == 1 and "" or "s", width)
        end
        return record, first
      end
    end
  end
  return next_row() or {}, next_row
end

--- Raises { message = } unless a text is short enough, and UTF-8.
local function check_text(text)
  if #text > csv.most_bytes then
    values.fail("the text has %d bytes; at most %d are read", #text, csv.most_bytes)
  end
  local length, at = utf8.len(text)
  if length then return end
  local _, lines = text:sub(1, at - 1):gsub("\n", "")
  values.fail("line %d is not UTF-8 (byte %d): export the table as UTF-8", lines + 1,
    text:byte(at))
end

local function decode(text, options)
  check_text(text)
  local first, next_row = csv.rows(text, options.separator)
  local types, rows = options.types or {}, {}
  local header = options.header ~= false and first or nil
  local class = header and row_class(header)
  if header then check_types(types, header) end
  if not header and #first > 0 then rows[1] = make_row(first, nil, types, 1, options.decimal) end
  for row, line in next_row do
    rows[#rows + 1] = setmetatable(make_row(row, header, types, line, options.decimal), class)
  end
  return rows
end

local known = { header = "boolean", separator = "string", types = "table", decimal = "string" }

local function check_options(options)
  fields.check("csv", options, known)
  local separator = options.separator
  if separator and (#separator ~= 1 or separator:find '["\r\n]') then
    native.refuse("csv: field 'separator' must be one character, and no quote or end of a line")
  end
  local decimal = options.decimal
  if decimal and decimal ~= "." and decimal ~= "," then
    native.refuse(("csv: field 'decimal' must be \".\" or \",\", got %q"):format(decimal))
  end
  for column, kind in pairs(options.types or {}) do
    if not readers[kind] then
      native.refuse(("csv: the type of column '%s' must be \"number\", \"boolean\" or \"string\"")
        :format(fields.key(column)))
    end
  end
end

---@class celspan.csv.options
---@field header? boolean Whether the first row has the names of the columns; default true
---@field separator? string One character; default the first comma, semicolon or tab of the first line
---@field decimal? "."|"," The decimal sign of numbers; default a point
---@field types? table<string|integer, "number"|"boolean"|"string"> By column; without a type a value is its text

--- Reads a table from a text. An empty field with the type "number" or "boolean" is nil.
---@param text string
---@param options? celspan.csv.options
---@return table[]? rows rows[i][j], and rows[i].name with a header
---@return string? message
function csv.decode(text, options)
  fields.takes("csv: decode", "string", "a string", text)
  options = options or {}
  check_options(options)
  return fields.caught(decode, text, options)
end

--- Reads a table from a file.
---@param path string Relative to the caller's file, else to the script
---@param options? celspan.csv.options
---@return table[]? rows rows[i][j], and rows[i].name with a header
---@return string? message
function csv.read(path, options)
  fields.takes("csv: read", "string", "a file name", path)
  options = options or {}
  check_options(options)
  local text, message = files.read_found(path, csv.most_bytes)
  if not text then return nil, message end
  return fields.caught_in(path, decode, text, options)
end

return fields.publish("csv", csv)
