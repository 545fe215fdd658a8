--- The rows of a chart as columns: { name =, xs =, series = { { name =, values = }, ... } }.
--
--   name     name(i) is what is written at row i
--   xs       where each row lies along a line, ascending; nil: rows are evenly apart
--   values   of a series: a number or false for each row
--
-- Rows are tables, such as those of csv.read, or plain numbers.
local native = require "celspan.native"
local count = require "celspan.count"
local fields = require "celspan.fields"

local data = {}

local MOST = 1e12 -- as everywhere in celspan

local function refuse(text, ...) native.refuse("chart: " .. text:format(...)) end

--- Refuses a field that no row has. Rows that are no tables are refused by their number.
local function check_field(rows, field)
  local names = {}
  for i = 1, rawlen(rows) do
    if type(rows[i]) ~= "table" or rows[i][field] ~= nil then return end
    for name in pairs(i <= 100 and rows[i] or {}) do
      names[#names + 1] = type(name) == "string" and name or nil
    end
  end
  table.sort(names)
  refuse("no row of 'data' has a field '%s'%s", field, fields.hint(field, names) or "")
end

--- The value of a row in a field; without a field, the row itself.
local function value_of(row, i, field)
  fields.expect_kind(not field or type(row) == "table", row,
    "chart: data[%d] must be a row with the field '%s'", i, field)
  local value = row
  if field then value = row[field] end
  if value == nil then return false end
  if not fields.is_finite(value) or math.abs(value) > MOST then
    refuse("data[%d]%s must be a finite number, at most 1e12, got %s%s", i,
      field and "." .. field or "", fields.shown(value),
      type(value) == "string" and ("; csv.read reads numbers with types = { %s = \"number\" }")
        :format(field or "name") or "")
  end
  return value
end

--- The names of the fields that are drawn, or { false } for rows that are numbers.
local function fields_of(y)
  if y == nil then return { false } end
  if type(y) == "string" then return { y } end
  local names = {}
  for i = 1, type(y) == "table" and rawlen(y) or 0 do
    fields.expect_kind(type(y[i]) == "string", y[i], "chart: y[%d] must be the name of a field", i)
    names[i] = y[i]
  end
  if #names == 0 then
    refuse("field 'y' must be the name of a field of the rows, or a list of names")
  end
  return names
end

--- A number of the x axis as text: years have no separators.
function data.written(x, language, decimals)
  return count.written(x, { language = language, decimals = decimals, group = false })
end

--- The decimals that a number needs, at most 3.
function data.decimals(x)
  for decimals = 0, 2 do
    local scaled = x * 10 ^ decimals
    if math.abs(scaled - math.floor(scaled + 0.5)) < 1e-9 * math.max(1, math.abs(scaled)) then
      return decimals
    end
  end
  return 3
end

--- The text or number that names each row, and the numbers if all are numbers that ascend.
local function read_names(rows, x)
  local names, xs, last = {}, {}, -math.huge
  for i = 1, rawlen(rows) do
    local value = i
    fields.expect_kind(not x or type(rows[i]) == "table", rows[i],
      "chart: data[%d] must be a row with the field '%s'", i, x)
    if x then value = rows[i][x] end
    names[i] = value
    if type(value) == "string" then
      xs = nil
    elseif fields.is_finite(value) and math.abs(value) <= MOST then
      if xs and value > last then xs[i], last = value, value else xs = nil end
    else
      refuse("data[%d].%s must be a text or a finite number, at most 1e12, got %s", i, x,
        fields.shown(value))
    end
  end
  return names, x and xs
end

--- Reads the rows of a chart's settings. most: rows that the kind of chart can show.
function data.read(given, most)
  local rows, series = given.data, {}
  local total = rawlen(rows)
  if total == 0 then refuse("field 'data' must have at least one row") end
  if total > most then
    refuse("a chart of the kind %q shows at most %d rows, got %d", given.kind, most, total)
  end
  if given.x then check_field(rows, given.x) end
  for k, field in ipairs(fields_of(given.y)) do
    local values = {}
    if field then check_field(rows, field) end
    for i = 1, total do values[i] = value_of(rows[i], i, field) end
    series[k] = { name = field or "", values = values }
  end
  local names, xs = read_names(rows, given.x)
  local function name(i)
    if type(names[i]) == "string" then return names[i] end
    return data.written(names[i], given.language, data.decimals(names[i]))
  end
  return { name = name, xs = xs, series = series, count = total }
end

--- The row of a name, or with "max" the one with the greatest value.
function data.row_of(columns, word)
  local best, names = nil, {}
  for i = 1, columns.count do
    names[i] = columns.name(i)
    local value = columns.series[1].values[i]
    if word == names[i] then return i end
    if value and (not best or value > columns.series[1].values[best]) then best = i end
  end
  return word == "max" and best or refuse("field 'highlight' must be \"max\" or a name, got '%s'%s",
    fields.key(word), fields.hint(word, names) or "")
end

--- The least and the greatest value, and whether all are whole numbers; 0, 0 where there are none.
function data.range(columns)
  local low, high, is_whole = math.huge, -math.huge, true
  for _, one in ipairs(columns.series) do
    for _, value in ipairs(one.values) do
      if value then
        low, high = math.min(low, value), math.max(high, value)
        is_whole = is_whole and value == math.floor(value)
      end
    end
  end
  if low > high then return 0, 0, true end
  return low, high, is_whole
end

return fields.seal("chart_data", data)
