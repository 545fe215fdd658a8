--- Transforms of Lottie: functions of the frame that return an affine map, as of celspan.affine.
--
--   position * rotation * skew * scale * -anchor
local affine = require "celspan.affine"
local ordered = require "celspan.ordered"
local paint = require "celspan.lottie_paint"
local property = require "celspan.lottie_property"
local values = require "celspan.lottie_values"

local transform = {}

local MOST_SKEW = 85 -- degrees; as in After Effects
local STEP = 0.01 -- frames, between the places that give the direction of a way
local MOST_TRIES = 20 -- keys at which a layer that stands still may have moved

--- First the skew, then the rotation.
local function turned(degrees, skew, axis)
  local turn = affine.turn(degrees, 0, 0)
  if skew == 0 then return turn end
  local k = math.tan(math.rad(-math.max(-MOST_SKEW, math.min(MOST_SKEW, skew))))
  local slanted = affine.compose(affine.turn(axis, 0, 0),
    affine.compose({ 1, k, 0, 0, 1, 0 }, affine.turn(-axis, 0, 0)))
  return affine.compose(turn, slanted)
end

--- The map of plain numbers: lists of two, and degrees.
function transform.map(position, anchor, scale, degrees, skew, axis)
  local m = turned(degrees, skew, axis)
  local sx, sy = scale[1] / 100, scale[2] / 100
  local a, b, d, e = m[1] * sx, m[2] * sy, m[4] * sx, m[5] * sy
  return { a, b, position[1] - a * anchor[1] - b * anchor[2],
           d, e, position[2] - d * anchor[1] - e * anchor[2] }
end

--- Whether a property has a value other than 0 somewhere.
local function is_used(given)
  local k = values.table(given) and given.k
  if type(k) == "number" then return k ~= 0 end
  if not values.table(k) then return false end
  for i = 1, #k do
    if values.table(k[i]) or k[i] ~= 0 then return true end
  end
  return false
end

--- Notes what a flattened layer loses.
local function note_depth(scope, given)
  for _, name in ipairs { "rx", "ry", "or" } do
    if is_used(given[name]) then
      scope.note "it is turned in 3D, which is shown flat, without perspective"
      return
    end
  end
end

--- Adds the times of the keys of a property.
local function add_times(given, times)
  local keys = values.items(values.table(given) and given.k)
  for _, one in ipairs(keys) do
    if type(one[2].t) == "number" then times[#times + 1] = values.number(one[2].t, 0) end
  end
end

--- The times of all keys of a position, which may have a property for each axis.
local function times_of(given)
  local times = {}
  add_times(given, times)
  if values.table(given) then
    add_times(given.x, times)
    add_times(given.y, times)
  end
  table.sort(times)
  return times
end

--- The angle of the way of a position at a frame, degrees; nil: it stands still.
local function angle_at(position, t)
  local before, after = position(t - STEP), position(t + STEP)
  local x, y = after[1] - before[1], after[2] - before[2]
  return (x ~= 0 or y ~= 0) and math.deg(math.atan(y, x)) or nil
end

--- The same; where it stands still, that of the way before, or else of the way after.
local function heading(position, times, t)
  local angle = angle_at(position, t)
  local last = ordered.last(times, t)
  for i = last, math.max(1, last - MOST_TRIES), -1 do
    angle = angle or angle_at(position, times[i] - STEP)
  end
  for i = last + 1, math.min(#times, last + MOST_TRIES) do
    angle = angle or angle_at(position, times[i] + STEP)
  end
  return angle or 0
end

--- given: the fields a, p, s, r or rz, sk, sa. follows: whether it turns with its way.
---@return fun(t: number): number[] map
---@return boolean moves
function transform.read(scope, given, follows)
  given = values.table(given) or {}
  local read, moves = property.reader(scope)
  note_depth(scope, given)
  local anchor = read(property.list, given.a, "the anchor", { 0, 0 })
  local position = read(property.point, given.p, "the position")
  local times = follows and moves() and times_of(values.table(given.p))
  local scale = read(property.list, given.s, "the scale", { 100, 100 })
  local degrees = read(property.number, given.rz or given.r, "the rotation", 0)
  local skew = read(property.number, given.sk, "the skew", 0)
  local axis = read(property.number, given.sa, "the axis of the skew", 0)
  local made = paint.keep(transform.map)
  return paint.memo(moves(), function(t)
    local turn = degrees(t) + (times and heading(position, times, t) or 0)
    return made(position(t), anchor(t), scale(t), turn, skew(t), axis(t))
  end), moves()
end

--- Whether a map leaves everything where it is.
function transform.is_identity(map)
  return map[1] == 1 and map[2] == 0 and map[3] == 0 and map[4] == 0 and map[5] == 1 and map[6] == 0
end

--- An object moved by a map.
function transform.apply(object, map)
  if transform.is_identity(map) then return object end
  return object:transform(affine.matrix(map))
end

return require "celspan.fields".seal("lottie_transform", transform)
