--- Paths to move along, and small movements that never repeat.
--
--   local way = motion.along("M0 0 C 100 0 100 200 300 200")   -- or a list of points {x, y}
--   local x, y, degrees = way:at(f.progress)                   -- by arc length, 0..1
--
--   local shake = motion.wiggle("camera", { frequency = 3, amplitude = 5 })
--   local dx = shake:at(f.time)                                -- smooth, -5..5
--
--   local hair = motion.spring(function(time) return head:at(time) end, { frequency = 2 })
--   local angle = hair:at(f.time)                              -- follows the head, and swings
--
--   local wind = motion.noise "wind"                           -- wind(x, y, z), -1..1
--
--   local x = 300 * motion.span(f.time, 0.5, 2, "outBack")      -- from 0.5 s on, for 2 s
--   local t = motion.times { { "rise", 1 }, { 0.3 }, { "turn", 0.5 } }
--   local angle = 90 * t.turn:at(f.time)                       -- after the pause of 0.3 s
local chance = require "celspan.chance"
local native = require "celspan.native"
local curves = require "celspan.curves"
local fields = require "celspan.fields"
local springs = require "celspan.springs"

local motion = {}

---@class celspan.motion.way
---@field length number
local Way = fields.class("celspan.motion.way", "a way")

--- A list of points, which have two numbers each, as contours; contours have more numbers.
local function contours_of(given)
  local list = table.move(given, 1, rawlen(given), 1, {})
  if #list == 0 then native.refuse("motion: along needs at least one point") end
  if type(list[1]) == "table" and rawlen(list[1]) > 3 then return list end
  for i, point in ipairs(list) do
    fields.numbers("motion", ("point %d: its value %%d"):format(i), point, 2, "{x, y}")
  end
  return { curves.through(list) }
end

local function curve_of(outline)
  fields.expect_kind(type(outline) == "string" or type(outline) == "table", outline,
    "motion: along takes path data, contours or a list of points {x, y}")
  local line = type(outline) == "string" and outline or contours_of(outline)
  local curve, message = curves.of("motion", line)
  return curve or native.refuse("motion: " .. message)
end

--- A path along path data, contours or points, measured by arc length.
---@param outline string|celspan.contour[]|number[][]
---@return celspan.motion.way
function motion.along(outline)
  local curve = curve_of(outline)
  return setmetatable({ curve = curve, length = curve.length }, Way)
end

--- The position at u (limited to 0..1), and the direction: degrees, clockwise, 0 to the right.
---@param u number
---@return number x, number y, number degrees
function Way:at(u)
  fields.check_at("motion", Way, self, u, "a fraction of the length")
  local x, y, dx, dy = self.curve:at(math.max(0, math.min(1, u)) * self.length)
  return x, y, math.deg(math.atan(dy, dx))
end

---@class celspan.motion.wiggle
local Wiggle = fields.class("celspan.motion.wiggle", "a wiggle")

local function check_seed(name, seed)
  fields.expect(type(seed) == "string" or fields.is_finite(seed), seed,
    "motion: %s takes a seed, a string or a finite number", name)
end

--- A smooth random movement: the same for the same seed, on every machine.
---@param seed string|integer
---@param settings? {frequency?: number, amplitude?: number} Changes per second (1); largest value (1)
---@return celspan.motion.wiggle
function motion.wiggle(seed, settings)
  check_seed("wiggle", seed)
  settings = settings or {}
  fields.check("motion", settings, { frequency = "number", amplitude = "number" })
  return setmetatable({ seed = chance.seed(seed), frequency = settings.frequency or 1,
                        amplitude = settings.amplitude or 1 }, Wiggle)
end

---@param time number Seconds
---@return number
function Wiggle:at(time)
  fields.check_at("motion", Wiggle, self, time, "a time")
  local at = time * self.frequency
  -- Beyond 2^53 a number has no fraction: the movement starts again at 0; infinity counts as 0.
  if math.abs(at) >= 2 ^ 53 then at = fields.is_finite(at) and math.fmod(at, 2 ^ 53) or 0 end
  local n = math.floor(at)
  local t = at - n
  local a, b = chance.between(self.seed, n), chance.between(self.seed, n + 1)
  return self.amplitude * (a + (b - a) * t * t * t * (t * (6 * t - 15) + 10))
end

-- ---------------------------------------------------------------- noise

--- A hash of a point of the grid: -1..1.
local function grid_value(seed, x, y, z)
  return chance.between(seed ~ x * 0x2545f4914f6cdd1d ~ y * 0x27d4eb2f165667c5, z)
end

local function fade(t) return t * t * t * (t * (6 * t - 15) + 10) end

--- Whole part and faded fraction of a coordinate. Beyond 2^53 a number has no fraction.
local function cell_of(at)
  if not fields.is_finite(at) then at = 0 end
  if math.abs(at) >= 2 ^ 53 then at = math.fmod(at, 2 ^ 53) end
  local n = math.floor(at)
  return n, fade(at - n)
end

local function blend(a, b, t) return a + (b - a) * t end

--- Smooth noise in one to three dimensions: -1..1, the same for the same seed on every machine, and
--- the same forwards and backwards in time. It is random at whole numbers, and changes smoothly
--- between them.
---@param seed string|integer
---@return fun(x: number, y?: number, z?: number): number
function motion.noise(seed)
  check_seed("noise", seed)
  local hash = chance.seed(seed)
  return function(x, y, z)
    for i, value in ipairs { x or 0 / 0, y or 0, z or 0 } do
      fields.expect_kind(type(value) == "number", value,
        "motion: noise: coordinate %d must be a number", i)
    end
    if x == nil then native.refuse "motion: noise takes one to three numbers, got none" end
    local i, u = cell_of(x)
    local j, v = cell_of(y or 0)
    local k, w = cell_of(z or 0)
    local function row(dj, dk)
      return blend(grid_value(hash, i, j + dj, k + dk), grid_value(hash, i + 1, j + dj, k + dk), u)
    end
    local near = v == 0 and row(0, 0) or blend(row(0, 0), row(1, 0), v)
    if w == 0 then return near end
    return blend(near, blend(row(0, 1), row(1, 1), v), w)
  end
end

-- ---------------------------------------------------------------- values that follow others

---@class celspan.motion.follower
local Follower = fields.class("celspan.motion.follower", "a motion that follows")

--- A weighted sum of values: numbers, and tables of them, such as poses. Values that are not
--- numbers are those of the first.
local function weighted(values, weights)
  local first = values[1]
  if type(first) == "number" then
    local sum = 0
    for i, value in ipairs(values) do
      sum = sum + (type(value) == "number" and value or first) * weights[i]
    end
    return sum
  end
  if type(first) ~= "table" then return first end
  local sum = {}
  for key in next, first do
    local inner = {}
    for i, value in ipairs(values) do
      local part = type(value) == "table" and value[key]
      inner[i] = part == nil and first[key] or part
    end
    sum[key] = weighted(inner, weights)
  end
  return sum
end

local FEWEST, PER_SWING = 64, 24 -- samples of the time window
local LEFT = 1e-3  -- the share of a movement that remains: older movements have less influence

--- response: the share of its way that the follower has gone; window: the length of the time window
--- in seconds; swings: how many swings it contains.
local function follow(source, response, window, swings)
  local count = math.max(FEWEST, math.ceil(swings * PER_SWING))
  return setmetatable({ source = source, weights = springs.weights(response, window, count),
                        window = window }, Follower)
end

local function check_source(name, source)
  fields.expect_kind(type(source) == "function", source,
    "motion: %s takes a function of the time", name)
end

--- A value that follows another value like a mass on a spring: it is late, and swings beyond the
--- other value. It depends only on the time: it examines the time window in which a swing dies
--- down.
---@param source fun(time: number): any Numbers, or tables of numbers, such as poses
---@param settings? {frequency?: number, damping?: number} Swings per second (2); 0.05 to 1, at which nothing swings beyond (0.3)
---@return celspan.motion.follower
function motion.spring(source, settings)
  check_source("spring", source)
  settings = settings or {}
  fields.check("motion: spring", settings, { frequency = "number", damping = "number" })
  local frequency, damping = settings.frequency or 2, settings.damping or 0.3
  springs.check("motion: spring", "frequency", frequency, damping)
  local window = springs.window(frequency, damping, LEFT)
  return follow(source, springs.response(frequency, damping), window, window * frequency)
end

--- A value that follows another value and never overtakes it: after `seconds` it has gone 63 % of
--- the way.
---@param source fun(time: number): any Numbers, or tables of numbers, such as poses
---@param seconds number More than 0
---@return celspan.motion.follower
function motion.lag(source, seconds)
  check_source("lag", source)
  fields.expect(fields.is_finite(seconds) and seconds > 0, seconds,
    "motion: lag takes seconds, a number above 0")
  return follow(source, function(time) return 1 - math.exp(-time / seconds) end,
                -math.log(LEFT) * seconds, 0)
end

---@param time number Seconds
---@return any value As the source returns it
function Follower:at(time)
  fields.check_at("motion", Follower, self, time, "a time")
  local values, count = {}, #self.weights
  for i = 1, count do values[i] = self.source(time - self.window * (i - 0.5) / count) end
  return weighted(values, self.weights)
end

-- ---------------------------------------------------------------- one after another

--- The progress of one of several things that begin one after another: 0 before it begins, 1 at its
--- end.
---@param u number 0..1, the progress of all
---@param i integer Which one, from 1
---@param count integer How many there are
---@param overlap? number 0: each begins when the one before it ends; 1: all at once (0.5)
---@return number
function motion.stagger(u, i, count, overlap)
  for name, value in pairs { u = u, i = i, count = count, overlap = overlap or 0 } do
    fields.expect(fields.is_finite(value), value,
      "motion: stagger: %s must be a finite number", name)
  end
  overlap = math.max(0, math.min(1, overlap or 0.5))
  local length = 1 / (1 + (count - 1) * (1 - overlap))
  local start = (i - 1) * (1 - overlap) * length
  return math.max(0, math.min(1, (u - start) / length))
end

--- How much of something is over: 0 before it begins, 1 after its end, and between them the share
--- of its length, eased if a curve is given.
---@param time number Seconds
---@param from number When it begins
---@param length number Seconds, at least 0
---@param curve? string|fun(u: number): number As celspan.ease takes it
---@return number
function motion.span(time, from, length, curve)
  for i, name in ipairs { "time", "from", "length" } do
    local value = (select(i, time, from, length))
    fields.expect(fields.is_finite(value), value, "motion: span: %s must be a finite number", name)
  end
  fields.must(length >= 0, "motion: span: the length", "at least 0", length)
  local u = length > 0 and (time - from) / length or time >= from and 1 or 0
  u = math.max(0, math.min(1, u))
  return curve and require "celspan.ease"(curve)(u) or u
end

---@class celspan.motion.part
---@field from number Seconds
---@field to number
local Part = fields.class("celspan.motion.part", "a part of the times")

--- How much of the part is over, as motion.span says it.
---@param time number Seconds
---@param curve? string|fun(u: number): number
---@return number
function Part:at(time, curve)
  fields.check_at("motion: times", Part, self, time, "a time")
  return motion.span(time, self.from, self.to - self.from, curve)
end

---@class celspan.motion.times
---@field length number Seconds, to the end of the last item
---@field [string] celspan.motion.part
local Times = fields.class("celspan.motion.times", "the list of times")

--- The name and the seconds of an item; the name of a pause is nil.
local function read_item(item, i)
  fields.expect_kind(type(item) == "table", item,
    "motion: times: item %d must be { name, seconds }, or a pause { seconds }", i)
  local name, seconds = item[1], item[2]
  if type(name) == "number" and seconds == nil then name, seconds = nil, name end
  fields.expect_kind(name == nil or type(name) == "string", name,
    "motion: times: item %d must begin with its name, or be a pause { seconds }", i)
  fields.expect(fields.is_finite(seconds) and seconds >= 0, seconds,
    "motion: times: item %d needs its seconds, a finite number of at least 0", i)
  return name, seconds
end

--- Parts of a movement one after another: { "rise", 1 } has a name and a length in seconds, { 0.3 }
--- is a pause. A part begins `overlap` seconds before the end of the one before it; after a pause
--- it begins at the end of the pause.
---@param given table { { name, seconds }, { seconds }, ..., overlap = 0 }
---@return celspan.motion.times
function motion.times(given)
  fields.check("motion: times", given, { {}, overlap = "number" })
  local times, at, overlap = { length = 0 }, 0, given.overlap or 0
  for i = 1, rawlen(given) do
    local name, seconds = read_item(given[i], i)
    if name and (times[name] or Times[name]) then
      native.refuse(("motion: times: item %d cannot have the name '%s', which %s"):format(i, name,
        getmetatable(times[name]) == Part and "another has" or "the list of times needs itself"))
    end
    local is_joined = name and i > 1 and type(given[i - 1][1]) == "string"
    local from = math.max(0, at - (is_joined and overlap or 0))
    at = from + seconds
    times.length = math.max(times.length, at)
    if name then times[name] = setmetatable({ from = from, to = at }, Part) end
  end
  return setmetatable(times, Times)
end

--- The parts as marks of a film: { name = { first, last } }.
---@param fps number Frames per second
---@param first? integer The number of the film's first frame (1)
---@return table<string, integer[]>
function Times:marks(fps, first)
  fields.self("motion: times", Times, self, "marks")
  fields.expect(fields.is_finite(fps) and fps > 0, fps,
    "motion: times: marks takes frames per second, a number above 0")
  local marks, number = {}, fields.whole("motion: times: the first frame", first or 1, -1e9)
  for name, part in next, self do
    if getmetatable(part) == Part then
      local begins, ends = (part.from * fps + 0.5) // 1 | 0, (part.to * fps + 0.5) // 1 | 0
      marks[name] = { number + begins, number + math.max(begins, ends - 1) }
    end
  end
  return marks
end

return fields.publish("motion", motion, Way, Wiggle, Follower, Part, Times)
