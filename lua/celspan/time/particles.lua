--- Particles: snow, sparks, leaves, rain, as a function of time.
--
--   local snow = particles{ seed = "snow", rate = 40, life = 6, at = { 640, -10, 660, 0 },
--                           velocity = { 10, 90, 30, 20 } }
--   for _, p in ipairs(snow:at(f.time)) do
--     cels[#cels + 1] = flake:translate(p.x, p.y):fade(1 - p.age)
--   end
--
-- `at` is the middle of where they are born, and how far from it, to each side: from x - across to
-- x + across for { x, y, across, down }, which is no box { x, y, w, h }. `velocity` is a middle and
-- how far from it in the same way.
--
-- Particle n is born at n / rate seconds. Everything about a particle follows from its number and
-- the time, so every frame can be made by itself. Its path is a parabola under gravity, slowed by
-- drag in closed form. If `field` is given, it turns a place on this path into another place.
local chance = require "celspan.chance"
local native = require "celspan.native"
local fields = require "celspan.fields"

local exp = math.exp
local random = chance.between

local MOST = 1000000 -- particles at one time
local LAST = 2 ^ 48  -- later births have no exact numbers

---@class celspan.particle
---@field x number
---@field y number
---@field age number 0..1 of its life
---@field seconds number Since its birth
---@field life number Seconds
---@field id integer The same in all frames, from 0
---@field spin number -1..1, random
---@field size number 0..1, random
---@field dx number Velocity, units per second
---@field dy number

---@class celspan.particles.source
local Source = fields.class("celspan.particles", "particles")

local known = { seed = "any", rate = "number", life = "any", at = "table", velocity = "table",
                gravity = "table", drag = "number", field = "function", from = "number",
                to = "number" }

local function refuse(text, ...) native.refuse("particles: " .. text:format(...)) end

--- Two or four numbers: x and y, and how far random values may differ from them.
local function read_spread(name, value, default)
  if value == nil then return default end
  local count = rawlen(value)
  if count ~= 2 and count ~= 4 then
    refuse("field '%s' must be {x, y} or {x, y, across, down}, got %d numbers", name, count)
  end
  fields.numbers("particles", ("%s[%%d]"):format(name), value, count, "a list of numbers")
  return { value[1], value[2], value[3] or 0, value[4] or 0 }
end

local function read_life(life)
  if type(life) == "table" then
    fields.numbers("particles", "life[%d]", life, 2, "{seconds, variation}")
    life = { life[1], life[2] }
  else
    life = { life, 0 }
  end
  if not fields.is_finite(life[1]) or life[1] <= 0 or life[2] < 0 or life[2] >= life[1] then
    refuse("field 'life' must be seconds above 0, or {seconds, variation} with a variation below "
      .. "them, got %s", fields.shown(life[1]))
  end
  return life
end

local function new(_, given)
  fields.check("particles", given, known)
  local rate = given.rate
  fields.must(rate and rate > 0, "particles: field 'rate'", "particles per second, above 0", rate)
  local life = read_life(given.life)
  if rate * (life[1] + life[2]) > MOST then
    refuse("%.14g a second that live %.14g seconds are more than %d at one time, which is the "
      .. "limit", rate, life[1] + life[2], MOST)
  end
  local drag = given.drag or 0
  fields.must(drag >= 0, "particles: field 'drag'", "0 or more", drag)
  return setmetatable({ seed = chance.seed(given.seed or "particles"), rate = rate,
    life = life, place = read_spread("at", given.at, { 0, 0, 0, 0 }),
    velocity = read_spread("velocity", given.velocity, { 0, 0, 0, 0 }),
    gravity = read_spread("gravity", given.gravity, { 0, 0, 0, 0 }), drag = drag,
    field = given.field or false, from = given.from or -math.huge, to = given.to or math.huge },
    Source)
end

--- The distances after t seconds for an initial velocity of 1 and for an acceleration of 1, then
--- the velocities for both.
local function travel(drag, t)
  if drag * t < 1e-6 then return t, t * t / 2, 1, t end
  local left = exp(-drag * t)
  local way = (1 - left) / drag
  return way, (t - way) / drag, left, way
end

local PURPOSES = 8 -- random numbers for each particle

--- The particle in its closed form. base: the first of its random numbers.
local function particle(source, id, seconds, life, base)
  local seed, place, velocity = source.seed, source.place, source.velocity
  local way, fall, left, speed = travel(source.drag, seconds)
  local vx = velocity[1] + velocity[3] * random(seed, base + 3)
  local vy = velocity[2] + velocity[4] * random(seed, base + 4)
  return { id = id, seconds = seconds, life = life, age = seconds / life,
           x = place[1] + place[3] * random(seed, base + 1) + vx * way + source.gravity[1] * fall,
           y = place[2] + place[4] * random(seed, base + 2) + vy * way + source.gravity[2] * fall,
           dx = vx * left + source.gravity[1] * speed, dy = vy * left + source.gravity[2] * speed,
           spin = random(seed, base + 5), size = (random(seed, base + 6) + 1) / 2 }
end

--- Moves a particle to the place that the field returns for it.
local function through_field(source, p, time)
  if not source.field then return end
  local x, y = source.field(p, time)
  if not fields.is_finite(x) or not fields.is_finite(y) then
    refuse("field must return x and y, two finite numbers, got %s and %s", fields.shown(x),
      fields.shown(y))
  end
  p.x, p.y = x, y
end

--- The particles that exist at a time, the oldest first. Births begin at `from` and end at `to`, in
--- seconds; without `from`, there are particles before the film begins.
---@param time number Seconds
---@return celspan.particle[]
function Source:at(time)
  fields.check_at("particles", Source, self, time, "a time")
  local list, most = {}, self.life[1] + self.life[2]
  if math.abs(time) * self.rate > LAST then return list end
  local first = math.ceil(math.max(time - most, self.from) * self.rate)
  local last = math.floor(math.min(time, self.to) * self.rate)
  for id = first, last do
    local life = self.life[1] + self.life[2] * random(self.seed, id * PURPOSES)
    local seconds = time - id / self.rate
    if seconds >= 0 and seconds < life then
      local p = particle(self, id, seconds, life, id * PURPOSES)
      through_field(self, p, time)
      list[#list + 1] = p
    end
  end
  return list
end

---@class celspan.particles
---@overload fun(settings: { seed?: string|number, rate: number, life: number|number[], at?: number[], velocity?: number[], gravity?: number[], drag?: number, field?: (fun(p: celspan.particle, time: number): number, number), from?: number, to?: number }): celspan.particles.source
return fields.publish("particles", setmetatable({}, { __call = native.entry(new) }), Source)
