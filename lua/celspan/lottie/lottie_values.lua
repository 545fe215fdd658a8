--- Numbers, lists and texts out of a Lottie file, made safe: for any input, the result is finite
--- and of the right kind.
local json = require "celspan.json"

local values = {}

local MOST = 1e7 -- units, frames and degrees; a file with more is damaged

--- A finite number, or the default.
---@param given any
---@param default number
---@return number
function values.number(given, default)
  if type(given) == "table" and given ~= json.null then given = given[1] end
  if type(given) ~= "number" or given ~= given then return default end
  return given > MOST and MOST or given < -MOST and -MOST or given
end

--- A frame. Programs write 15.0000006 and mean 15, which would be another frame.
---@param given any
---@param default number
---@return number
function values.frame(given, default)
  return math.floor(values.number(given, default) * 1e3 + 0.5) / 1e3
end

--- A list of `count` numbers; a single number stands for its first one.
---@param given any
---@param default number[]
---@param count integer
---@return number[]
function values.list(given, default, count)
  local list = {}
  if type(given) ~= "table" then given = { given } end
  for i = 1, count do list[i] = values.number(given[i], default[i]) end
  return list
end

--- All numbers of a list whose length is not known.
---@param given any
---@return number[]
function values.numbers(given)
  local list = {}
  if type(given) ~= "table" then return list end
  for i = 1, #given do list[i] = values.number(given[i], 0) end
  return list
end

--- A table that is no null; nil for all else.
---@param given any
---@return table?
function values.table(given)
  return type(given) == "table" and given ~= json.null and given or nil
end

--- The tables of a list, with their places.
---@param given any
---@return { [1]: integer, [2]: table }[]
function values.items(given)
  local list = {}
  if not values.table(given) then return list end
  for i = 1, #given do
    if values.table(given[i]) then list[#list + 1] = { i, given[i] } end
  end
  return list
end

--- A text, or the default.
---@param given any
---@param default? string
---@return string?
function values.text(given, default) return type(given) == "string" and given or default end

--- Whether a flag is set, which is written as 1 or as true.
---@param given any
---@return boolean
function values.flag(given) return given == true or given == 1 end

--- A text that may be the name of an object: short, valid and without control characters.
---@param text any
---@param default string
---@return string
function values.name(text, default)
  text = type(text) == "string" and utf8.len(text) and text:gsub("%c", " ") or ""
  text = text:sub(1, utf8.offset(text, 60) and utf8.offset(text, 60) - 1 or #text)
  return text ~= "" and text or default
end

return require "celspan.fields".seal("lottie_values", values)
