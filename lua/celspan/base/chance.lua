--- Random numbers that are functions: the same for the same seed and number, on every machine.
local fields = require "celspan.fields"

local chance = {}

--- The seed for a text or a number: FNV-1a, 64 bits.
---@param value string|number
---@return integer
function chance.seed(value)
  local text, hash = tostring(value), 0xcbf29ce484222325
  for i = 1, #text do hash = (hash ~ text:byte(i)) * 0x100000001b3 end
  return hash
end

--- A number in -1..1 for a seed and a whole number: SplitMix64's finaliser.
---@param seed integer
---@param n integer
---@return number
function chance.between(seed, n)
  local x = (seed ~ n) + 0x9e3779b97f4a7c15
  x = (x ~ x >> 30) * 0xbf58476d1ce4e5b9
  x = (x ~ x >> 27) * 0x94d049bb133111eb
  x = x ~ x >> 31
  return (x >> 11) * 2.0 ^ -52 - 1
end

return fields.seal("chance", chance)
