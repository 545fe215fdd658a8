--- Steps: feet that walk without sliding, as functions of time. celspan.puppet has them as `steps`.
--
--            swing                 share of the period      what a foot does
--            .--.                  0 .. share               stays where it is
--     ______/    \______           share .. 1               swings to its next place
--      on the ground
local native = require "celspan.native"
local fields = require "celspan.fields"

local function refuse(text, ...) native.refuse("puppet: " .. text:format(...)) end

---@class celspan.puppet.steps
local Steps = fields.class("celspan.puppet.steps", "steps")

local known_steps = { stride = "number", period = "number", lift = "number", ground = "number",
                      x = "number", share = "number" }

local function steps(settings)
  fields.check("puppet: steps", settings, known_steps)
  for _, name in ipairs { "stride", "period", "ground" } do
    if not settings[name] then refuse("steps needs the field '%s', a number", name) end
  end
  local share = settings.share or 0.6
  fields.must(settings.period > 0, "puppet: steps: field 'period'", "more than 0", settings.period)
  fields.must(share > 0 and share < 1, "puppet: steps: field 'share'", "between 0 and 1", share)
  return setmetatable({ stride = settings.stride, period = settings.period, share = share,
    lift = settings.lift or math.abs(settings.stride) / 8, ground = settings.ground,
    start = settings.x or 0 }, Steps)
end

--- The distance that the body has gone.
---@param time number Seconds
---@return number x
function Steps:body(time)
  fields.self("puppet: steps", Steps, self, "body")
  return self.stride * time / self.period
end

--- The place of a foot. On the ground it does not move; in the air it swings to its next place.
---@param time number Seconds
---@param phase? number 0..1: the share of the period by which it is ahead; 0.5 for the other foot
---@return number x, number y
---@return number swing 0 on the ground, 0..1 in the air
function Steps:foot(time, phase)
  fields.self("puppet: steps", Steps, self, "foot")
  phase = phase or 0
  local cycle = time / self.period + phase
  local step = math.floor(cycle)
  local x = self.start + self.stride * (step + self.share / 2 - phase)
  local swing = (cycle - step - self.share) / (1 - self.share)
  if swing <= 0 then return x, self.ground, 0 end
  local eased = swing * swing * (3 - 2 * swing)
  return x + self.stride * eased, self.ground - self.lift * math.sin(math.pi * swing), swing
end

return steps
