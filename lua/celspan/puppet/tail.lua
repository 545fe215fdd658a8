--- Tails: scarfs, plaits, ropes and tails that hang on a joint of a puppet and follow it.
-- celspan.puppet has them as rig:tail.
--
--     joint o             A link points where the tail hangs, blown by the wind, but late: like a
--            \            mass on a spring, the softer the farther it is from the joint. It also
--             o           points back to where the joint was, by how far such a mass is behind it.
--              `o--o
--
-- INVARIANT: the points are a function of the time alone, and every link keeps its length. All
-- links use the same samples of the joint, because placing a puppet is what costs time.
local native = require "celspan.native"
local fields = require "celspan.fields"
local springs = require "celspan.springs"

local MOST_LINKS = 100
local PER_SWING = 12 -- samples in a swing of the first link
local LEFT = 1e-2    -- of a movement: what is older has less influence
local PULL = 3       -- how strongly a tail that is behind by its length points back

---@class celspan.puppet.tail
local Tail = { __name = "celspan.puppet.tail" }
local methods = {}
Tail.__index = fields.reads("a tail", methods)

local function refuse(text, ...) native.refuse("puppet: tail: " .. text:format(...)) end

local known = { joint = "string", pose = "function", links = "number", length = "number",
                angle = "any", stiffness = "number", damping = "number", wind = "any" }

--- A value that a script gives as it is or as a function of the time, as such a function. check:
--- refuses what is no such value.
local function over_time(given, check)
  if type(given) == "function" then
    return function(time)
      local x, y = given(time)
      check(x, y)
      return x, y
    end
  end
  local x, y = given, nil
  if type(given) == "table" then x, y = given[1], given[2] end
  check(x, y)
  return function() return x, y end
end

local function check_angle(degrees)
  fields.must(fields.is_finite(degrees), "puppet: tail: field 'angle'",
    "degrees, or a function of the time that returns them", degrees)
end

local function check_wind(x, y)
  if not (fields.is_finite(x) and fields.is_finite(y)) then
    refuse("field 'wind' must be {x, y}, or a function of the time that returns x, y, got %s, %s",
      fields.shown(x), fields.shown(y))
  end
end

local function check_numbers(given)
  for _, name in ipairs { "joint", "pose", "length" } do
    if given[name] == nil then refuse("needs the field '%s'", name) end
  end
  local links = given.links or 6
  fields.must(given.length > 0, "puppet: tail: field 'length'", "more than 0", given.length)
  return fields.whole("puppet: tail: field 'links'", links, 1, MOST_LINKS)
end

--- The weights of each link over the same moments. Of a pendulum that is four times as long a swing
--- takes twice the time: so it is with a link that is four times as far from the joint.
local function weights_of(links, stiffness, damping)
  local window = springs.window(stiffness / math.sqrt(links), damping, LEFT)
  local count, list = math.ceil(window * stiffness * PER_SWING), {}
  for k = 1, links do
    list[k] = springs.weights(springs.response(stiffness / math.sqrt(k), damping), window, count)
  end
  return list, window, count
end

--- A tail of a rig, which has the method `joint`.
local function new(rig, given)
  fields.check("puppet: tail", given, known)
  local links, stiffness, damping = check_numbers(given), given.stiffness or 2, given.damping or 0.3
  springs.check("puppet: tail", "stiffness", stiffness, damping)
  local weights, window, count = weights_of(links, stiffness, damping)
  return setmetatable({ rig = rig, joint = given.joint, pose = given.pose, length = given.length,
    links = links, weights = weights, window = window, count = count,
    angle = over_time(given.angle or 90, check_angle),
    wind = over_time(given.wind or { 0, 0 }, check_wind) }, Tail)
end

--- The joint, and the way in which the tail would hang at that time.
local function sample(tail, time)
  local x, y = tail.rig:joint(tail.pose(time), tail.joint)
  local angle, wind_x, wind_y = math.rad(tail.angle(time)), tail.wind(time)
  return { x, y, math.cos(angle) + wind_x, math.sin(angle) + wind_y }
end

--- The sum of the samples with the weights of a link.
local function sum_of(samples, weights)
  local x, y, dx, dy = 0, 0, 0, 0
  for i, one in ipairs(samples) do
    local weight = weights[i]
    x, y = x + weight * one[1], y + weight * one[2]
    dx, dy = dx + weight * one[3], dy + weight * one[4]
  end
  return x, y, dx, dy
end

--- Where the tail is: its joint, and the end of each link.
---@param time number Seconds
---@return number[][] points {x, y} each, one more than it has links
function methods:points(time)
  fields.self("puppet: tail", Tail, self, "points")
  fields.expect(fields.is_finite(time), time, "puppet: tail: points takes a time, a finite number")
  local samples = {}
  for i = 1, self.count do
    samples[i] = sample(self, time - self.window * (i - 0.5) / self.count)
  end
  local now = sample(self, time)
  local x, y, points, step = now[1], now[2], { { now[1], now[2] } }, self.length / self.links
  local ux, uy = 0, 1
  for k, weights in ipairs(self.weights) do
    local late_x, late_y, dx, dy = sum_of(samples, weights)
    dx = dx + (late_x - now[1]) * PULL / self.length
    dy = dy + (late_y - now[2]) * PULL / self.length
    local size = math.sqrt(dx * dx + dy * dy)
    if size > 0 then ux, uy = dx / size, dy / size end
    x, y = x + ux * step, y + uy * step
    points[k + 1] = { x, y }
  end
  return points
end

return new
