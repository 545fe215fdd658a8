--- Round numbers along an axis.
local fields = require "celspan.fields"

local ticks = {}

local STEPS = { 1, 2, 5 } -- times a power of ten
local LEAST, SHARE = 1e-9, 1e-12 -- of a range, and of its numbers: one that is smaller is widened

--- The smallest step of whole tenths with at most `most` multiples between two numbers: its digit
--- and its power of ten.
local function step_of(low, high, most, is_whole, is_tight)
  local power = math.floor(math.log((high - low) / most, 10)) - 1
  if is_whole then power = math.max(0, power) end
  while true do
    for _, digit in ipairs(STEPS) do
      local step = digit * 10.0 ^ power
      local count = is_tight and math.floor(high / step) - math.ceil(low / step)
        or math.ceil(high / step) - math.floor(low / step)
      if count < most then return digit, power end
    end
    power = power + 1
  end
end

--- i steps as one division or product, so that 3 steps of 0.1 are 0.3.
local function times(i, digit, power)
  if power < 0 then return i * digit / 10.0 ^ -power end
  return i * digit * 10.0 ^ power
end

--- At most `most` round numbers from low to high, and their decimals. The range is made larger
--- until it begins and ends with one, unless `is_tight`.
---@param low number At least -1e12
---@param high number At most 1e12
---@param most integer At least 3: a range around 0 has a step on each side
---@param is_whole? boolean No fractions
---@param is_tight? boolean
---@return number[] list, integer decimals, number low, number high
function ticks.between(low, high, most, is_whole, is_tight)
  local least = math.max(LEAST, SHARE * math.max(math.abs(low), math.abs(high)))
  if high - low < least then high = low + 1 end
  local digit, power = step_of(low, high, most, is_whole, is_tight)
  local step, list = digit * 10.0 ^ power, {}
  local first, last = math.floor(low / step), math.ceil(high / step)
  if is_tight then first, last = math.ceil(low / step), math.floor(high / step) end
  for i = first, last do list[#list + 1] = times(i, digit, power) end
  if is_tight then return list, math.max(0, -power), low, high end
  return list, math.max(0, -power), list[1], list[#list]
end

return fields.seal("ticks", ticks)
