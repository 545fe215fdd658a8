--- Paths to move along, and small movements that never repeat.
--
--   local way = motion.along("M0 0 C 100 0 100 200 300 200")   -- or a list of points {x, y}
--   local x, y, degrees = way:at(f.progress)                   -- by arc length, 0..1
--
--   local shake = motion.wiggle("camera", { frequency = 3, amplitude = 5 })
--   local dx = shake:at(f.time)                                -- smooth, -5..5
local fields = require "celspan.fields"
local pathdata = require "celspan.pathdata"

local motion = {}

---@class celspan.motion.way
---@field length number
local Way = {}
Way.__index = fields.reads("a way", Way)
Way.__name = "celspan.motion.way"

local function points_of(outline)
  if type(outline) == "string" then
    local points, message = pathdata.points(outline)
    if not points then error("motion: " .. message, 3) end
    return points
  end
  if type(outline) ~= "table" then
    error("motion: along takes path data or a list of points {x, y}, got "
      .. fields.kind(outline), 3)
  end
  local points = {}
  for i = 1, rawlen(outline) do
    fields.numbers("motion", ("point %d: its value %%d"):format(i), outline[i], 2, "{x, y}", 3)
    points[i] = outline[i]
  end
  return points
end

--- A path along path data or points, measured by arc length.
---@param outline string|number[][]
---@return celspan.motion.way
function motion.along(outline)
  local points = points_of(outline)
  if #points == 0 then error("motion: along needs at least one point", 2) end
  local way = { { points[1][1], points[1][2], 0 } }
  local length = 0
  for i = 2, #points do
    local dx, dy = points[i][1] - points[i - 1][1], points[i][2] - points[i - 1][2]
    local step = math.sqrt(dx * dx + dy * dy)
    if step > 0 then
      length = length + step
      way[#way + 1] = { points[i][1], points[i][2], length }
    end
  end
  return setmetatable({ points = way, length = length }, Way)
end

--- The last point at or before a given length along the path.
local function place(points, length)
  local low, high = 1, #points
  while low < high do
    local middle = (low + high + 1) // 2
    if points[middle][3] <= length then low = middle else high = middle - 1 end
  end
  return low
end

--- The position at u (limited to 0..1), and the direction: degrees, clockwise, 0 to the right.
---@param u number
---@return number x, number y, number degrees
function Way:at(u)
  fields.check_at("motion", Way, self, u, "a fraction of the length")
  local points = self.points
  if #points == 1 then return points[1][1], points[1][2], 0 end
  local length = math.max(0, math.min(1, u)) * self.length
  local i = math.min(place(points, length), #points - 1)
  local a, b = points[i], points[i + 1]
  local t = (length - a[3]) / (b[3] - a[3])
  local dx, dy = b[1] - a[1], b[2] - a[2]
  return a[1] + t * dx, a[2] + t * dy, math.deg(math.atan(dy, dx))
end

---@class celspan.motion.wiggle
local Wiggle = {}
Wiggle.__index = fields.reads("a wiggle", Wiggle)
Wiggle.__name = "celspan.motion.wiggle"

--- FNV-1a, 64 bits.
local function hash_text(text)
  local hash = 0xcbf29ce484222325
  for i = 1, #text do hash = (hash ~ text:byte(i)) * 0x100000001b3 end
  return hash
end

--- A value in -1..1 for a whole number: SplitMix64's finaliser.
local function value_at(seed, n)
  local x = (seed ~ n) + 0x9e3779b97f4a7c15
  x = (x ~ x >> 30) * 0xbf58476d1ce4e5b9
  x = (x ~ x >> 27) * 0x94d049bb133111eb
  x = x ~ x >> 31
  return (x >> 11) * 2.0 ^ -52 - 1
end

--- A smooth random movement: the same for the same seed, on every machine.
---@param seed string|integer
---@param settings? {frequency?: number, amplitude?: number} Changes per second (1); largest value (1)
---@return celspan.motion.wiggle
function motion.wiggle(seed, settings)
  if type(seed) ~= "string" and not fields.is_finite(seed) then
    error("motion: wiggle takes a seed, a string or a finite number, got " .. fields.shown(seed), 2)
  end
  settings = settings or {}
  fields.check("motion", settings, { frequency = "number", amplitude = "number" })
  return setmetatable({ seed = hash_text(tostring(seed)), frequency = settings.frequency or 1,
                        amplitude = settings.amplitude or 1 }, Wiggle)
end

---@param time number Seconds
---@return number
function Wiggle:at(time)
  fields.check_at("motion", Wiggle, self, time, "a time")
  local at = time * self.frequency
  -- Beyond 2^53 a number has no fraction: the movement starts again from 0; infinity is 0.
  if math.abs(at) >= 2 ^ 53 then at = fields.is_finite(at) and math.fmod(at, 2 ^ 53) or 0 end
  local n = math.floor(at)
  local t = at - n
  local a, b = value_at(self.seed, n), value_at(self.seed, n + 1)
  return self.amplitude * (a + (b - a) * t * t * t * (t * (6 * t - 15) + 10))
end

return fields.seal("motion", motion)
