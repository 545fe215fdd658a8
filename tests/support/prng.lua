-- Numbered random cases: the same numbers for the same seed everywhere (splitmix64, as random.h).
local prng = {}
prng.__index = prng

function prng.new(seed)
  return setmetatable({ state = seed * 0x9e3779b97f4a7c15 ~ 0x5851f42d4c957f2d }, prng)
end

--- 64 random bits.
function prng:bits()
  self.state = self.state + 0x9e3779b97f4a7c15
  local z = self.state
  z = (z ~ (z >> 30)) * 0xbf58476d1ce4e5b9
  z = (z ~ (z >> 27)) * 0x94d049bb133111eb
  return z ~ (z >> 31)
end

--- A number in [low, high).
function prng:between(low, high)
  return low + (high - low) * ((self:bits() >> 11) * 0x1p-53)
end

--- A whole number in first..last.
function prng:whole(first, last)
  return first + (self:bits() >> 1) % (last - first + 1)
end

--- True with a probability of 1 in `count`.
function prng:once(count) return self:whole(1, count) == 1 end

--- A random item of a list.
function prng:pick(list) return list[self:whole(1, #list)] end

return prng
