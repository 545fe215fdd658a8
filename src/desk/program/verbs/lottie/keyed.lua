--- Keys of what moves: the fewest that stay as near to the frames as is asked.
--
-- Times are frames from 0. A key is linear to the next one; the last one has no handles, which some
-- players misread. Between keys a line through both is within the tolerance of every frame:
--
--     v |        . o          lines from a key through the ranges of the frames after it; the next
--       |    .-'|             key is the last frame whose line lies between all of them
--       | o--'--'
--       +------------ frame
local affine = require "celspan.affine"

local text = ...

local NEAR = 1 / 20 -- units of the film: how far a point may be from where it is in the frame
local SKEWED = 1e-4 -- how far axes may be from a right angle, as a share of their lengths
local MIRRORED = 45 -- degrees that are better than a scale that becomes negative

local keys = {}

--- A map that scales both axes.
function keys.zoom(scale) return affine.stretch(scale, scale, 1, 0, 0, 0) end

--- Extends [low, high], the slopes that are left, by a value `over` frames after the key; nil if
--- none is left or the line to the value itself is not among them.
local function narrow(low, high, value, from, over, tolerance)
  local slope = (value - from) / over
  if slope < low or slope > high then return nil end
  return math.max(low, slope - tolerance / over), math.min(high, slope + tolerance / over)
end

--- The index of the next key after the one at `at`.
local function next_key(values, at, tolerance)
  local size, low, high = #values[at], {}, {}
  for k = 1, size do low[k], high[k] = -math.huge, math.huge end
  for i = at + 1, #values do
    for k = 1, size do
      local a, b = narrow(low[k], high[k], values[i][k], values[at][k], i - at, tolerance[k])
      if not a then return math.max(i - 1, at + 1) end
      low[k], high[k] = a, b
    end
  end
  return #values
end

local function is_still(values, tolerance)
  for i = 2, #values do
    for k, value in ipairs(values[i]) do
      if math.abs(value - values[1][k]) > tolerance[k] then return false end
    end
  end
  return true
end

local function varies(values) return not is_still(values, { 1e-9, 1e-9 }) end

local STRAIGHT = { i = { raw = '{"x":[1],"y":[1]}' }, o = { raw = '{"x":[0],"y":[0]}' } }

--- A property of Lottie with these values, lists of numbers, a frame each; start: the first frame.
--- tolerance: of each number.
function keys.property(values, start, tolerance, digits)
  if is_still(values, tolerance) then
    local value = values[1]
    return text.still(value[2] and value or value[1], digits)
  end
  local list, at = {}, 1
  while true do
    local key = { t = start + at - 1, s = text.list(values[at], digits) }
    list[#list + 1] = key
    if at == #values then break end
    key.i, key.o = STRAIGHT.i, STRAIGHT.o
    at = next_key(values, at, tolerance)
  end
  return { a = 1, k = list }
end

--- A property that holds each value until it changes.
function keys.held(values, start)
  local list = {}
  for i, value in ipairs(values) do
    if i == 1 or value ~= values[i - 1] then
      list[#list + 1] = { t = start + i - 1, s = text.list { value }, h = 1 }
    end
  end
  if not list[2] then return text.still(values[1]) end
  return { a = 1, k = list }
end

--- Whether the axes of a map are at right angles, so that it turns, scales and mirrors only.
function keys.is_upright(map)
  local a, b, _, d, e = table.unpack(map)
  return math.abs(a * b + d * e) <= SKEWED * (a * a + b * b + d * d + e * e) / 2
end

local SLOPE = 8 -- how far an axis may lean: players limit a skew to 85 degrees

--- How far the axis down leans, before the turn, for each unit along it.
local function slope(map)
  local a, b, _, d, e = table.unpack(map)
  local size = a * e - b * d
  return size ~= 0 and (a * b + d * e) / size or 0
end

--- Whether a skew, a turn and scales can say all of these maps.
function keys.can_lean(maps)
  for _, map in ipairs(maps) do
    if math.abs(slope(map)) > SLOPE then return false end
  end
  return true
end

--- The turn in degrees and the scales of a map, as near as possible to the frame before.
local function split(map, before)
  local a, b, _, d, e = table.unpack(map)
  local across, down = math.sqrt(a * a + d * d), math.sqrt(b * b + e * e)
  if not keys.is_upright(map) then down = math.abs(a * e - b * d) / across end
  local mirror = a * e - b * d < 0 and -1 or 1
  if across + down < 1e-12 then return before and before[1] or 0, 0, 0 end
  local turn = math.deg(across > 0 and math.atan(d, a) or math.atan(-b * mirror, e * mirror))
  down = down * mirror
  if not before then return turn, across, down end
  local best, least
  for flip = 0, 1 do -- half a turn further, both scales are mirrored
    local sign = 1 - 2 * flip
    local way = (turn + 180 * flip - before[1] + 180) % 360 - 180
    local cost = math.abs(way) + (sign * across * before[2] < 0 and MIRRORED or 0)
      + (sign * down * before[3] < 0 and MIRRORED or 0)
    if not least or cost < least then
      best, least = { before[1] + way, sign * across, sign * down }, cost
    end
  end
  return table.unpack(best)
end

--- The transform of a map. digits: of its place.
function keys.placed(map, digits)
  local turn, across, down = split(map)
  return { a = text.still { 0, 0 }, p = text.still({ map[3], map[6] }, digits),
           r = text.still(turn, 6), s = text.still({ 100 * across, 100 * down }, 6),
           o = text.still(100) }
end

--- Values of the frames: turns, scales in hundredths, where the anchor is, and skews.
local function values_of(maps, anchor)
  local turns, scales, places, skews, before = {}, {}, {}, {}, nil
  for i, map in ipairs(maps) do
    local turn, across, down = split(map, before)
    before = { turn, across, down }
    turns[i], scales[i] = { turn }, { 100 * across, 100 * down }
    skews[i] = { keys.is_upright(map) and 0 or -math.deg(math.atan(slope(map))) }
    places[i] = { affine.apply(map, anchor[1], anchor[2]) }
  end
  return turns, scales, places, skews
end

--- The point that stays while the map turns from one frame to another; nil: there is none.
local function pivot(first, second)
  local change = {}
  for k = 1, 6 do change[k] = second[k] - first[k] end
  local size = change[1] * change[5] - change[2] * change[4]
  if math.abs(size) < 1e-9 then return nil end
  return { (change[2] * change[6] - change[5] * change[3]) / size,
           (change[4] * change[3] - change[1] * change[6]) / size }
end

--- The greatest scale of maps.
function keys.scale(maps)
  local most = 0
  for _, map in ipairs(maps) do
    most = math.max(most, map[1] ^ 2 + map[4] ^ 2, map[2] ^ 2 + map[5] ^ 2)
  end
  return math.sqrt(most)
end

local function count(property) return property.a == 1 and #property.k or 0 end

--- The transform of a layer about an anchor.
local function about(maps, start, box, anchor)
  local turns, scales, places, skews = values_of(maps, anchor)
  local reach = 0 -- how far the art extends from the anchor
  for _, x in ipairs { box[1], box[3] } do
    for _, y in ipairs { box[2], box[4] } do
      reach = math.max(reach, math.sqrt((x - anchor[1]) ^ 2 + (y - anchor[2]) ^ 2))
    end
  end
  reach = math.max(reach, 1e-6)
  local changing, lean = 0, 0
  for _, values in ipairs { turns, scales, places, skews } do
    if varies(values) then changing = changing + 1 end
  end
  for _, skew in ipairs(skews) do lean = math.max(lean, math.abs(math.tan(math.rad(skew[1])))) end
  local part = NEAR / math.sqrt(2) / math.max(changing, 1) / (1 + lean) -- of each number
  local turn = math.deg(part / math.max(reach * keys.scale(maps), 1e-6))
  local scale = 100 * part / reach
  local made = { a = text.still(anchor),
                 p = keys.property(places, start, { part, part }),
                 r = keys.property(turns, start, { turn }, text.digits(turn)),
                 s = keys.property(scales, start, { scale, scale }, text.digits(scale)) }
  if lean > 0 then -- an axis that leans is shorter than what it moves, as `part` allows for
    made.sk, made.sa = keys.property(skews, start, { turn }, text.digits(turn)), text.still(0)
  end
  return made
end

local function rounded(value) return math.floor(value * 1000 + 0.5) / 1000 end

--- The transform of a layer: maps of the frames, and the box { left, top, right, bottom } of the
--- art before them. The anchor is the one that needs fewest keys.
function keys.transform(maps, start, box)
  local anchors = { { 0, 0 }, { (box[1] + box[3]) / 2, (box[2] + box[4]) / 2 } }
  local first
  for i = 2, #maps do
    first = pivot(maps[1], maps[i])
    if first then break end
  end
  anchors[3] = first
  local best, least
  for _, anchor in ipairs(anchors) do
    if math.max(math.abs(anchor[1]), math.abs(anchor[2])) < 1e6 then
      local made = about(maps, start, box, { rounded(anchor[1]), rounded(anchor[2]) })
      local total = count(made.p) + count(made.r) + count(made.s)
      if not least or total < least then best, least = made, total end
    end
  end
  return best
end

return keys
