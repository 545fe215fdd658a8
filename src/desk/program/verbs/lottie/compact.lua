--- Tables as JSON without spaces: numbers with few digits, and names in alphabetical order, except
--- for those that rlottie needs before others.
local json = require "celspan.json"

local DIGITS = 3 -- after the point, unless a number has digits of its own

local early = { ty = 1, ddd = 2, p = 3 }

local function is_before(a, b)
  local first, second = early[a] or 9, early[b] or 9
  return first < second or first == second and a < b
end

local text = {}

--- A number with at most this many digits after the point.
function text.number(value, digits)
  local written = ("%." .. (digits or DIGITS) .. "f"):format(value)
  if written:find(".", 1, true) then written = written:gsub("%.?0+$", "") end
  return written == "-0" and "0" or written
end

local MOST = 15 -- digits: more say nothing of a number of 64 bits

--- How many digits a number needs to be within a tenth of a tolerance.
function text.digits(tolerance)
  return math.max(0, math.min(math.ceil(1 - math.log(tolerance, 10)), MOST))
end

--- A list of numbers as a text that is written as it is.
function text.list(values, digits)
  local parts = {}
  for i, value in ipairs(values) do parts[i] = text.number(value, digits) end
  return { raw = "[" .. table.concat(parts, ",") .. "]" }
end

--- A property that does not change: a number, a list of numbers, or a shape.
function text.still(value, digits)
  if type(value) == "number" then
    value = { raw = text.number(value, digits) }
  elseif value[1] then
    value = text.list(value, digits)
  end
  return { a = 0, k = value }
end

--- What is written in a way of its own: numbers, texts that are ready, and tables without items,
--- which are lists.
local function own(value)
  if type(value) == "number" then return text.number(value) end
  return type(value) == "table" and (value.raw or next(value) == nil and "[]") or nil
end

local OPTIONS = { plain = true, compact = true, is_before = is_before, value = own }

--- The whole value.
function text.encode(value) return json.encode(value, OPTIONS) end

return text
