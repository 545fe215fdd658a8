-- Reproducible random numbers: a stream of numbers from a name.
local dice = {}
dice.__index = dice

--- A separate stream for each label.
function dice.new(label)
  local state = 88172645463325252
  for i = 1, #label do state = (state ~ label:byte(i)) * 0x5851F42D4C957F2D + 1 end
  return setmetatable({ state = state }, dice)
end

--- A number from a to b, or 0 to 1.
function dice:between(a, b)
  local s = self.state
  s = s ~ (s << 13)
  s = s ~ (s >> 7)
  s = s ~ (s << 17)
  self.state = s
  local u = (s >> 11) / 9007199254740992
  return a and a + (b - a) * u or u
end

--- A whole number from 1 to n, or one of a list.
function dice:one(of)
  if type(of) == "number" then return 1 + math.floor(self:between() * of) end
  return of[self:one(#of)]
end

--- true once in n times.
function dice:once(n) return self:one(n) == 1 end

return dice
