-- The lamplighter: the parts of lamplighter.svg, posed about their joints.
--
-- Parts that change from drawing to drawing (steps, eyes, mouths, mittens) are selected by name, as
-- in an exposure sheet; parts that move in between (lean, head, arms, scarf, pole) are given as
-- numbers. A pose is in the units of the drawing, where he stands on y = 560 with x = 235 between
-- his boots; the result is moved so that this point is the origin.

local lamplighter = {}

local art = assert(svg.read "lamplighter.svg")

local GROUND = { 235, 560 }
local HIP, NECK, HAT = { 235, 500 }, { 250, 262 }, { 246, 120 }
local SHOULDERS = { near = { 186, 322 }, far = { 296, 322 } }
local NAPE = { 166, 282 }
local POLE = { below = 150, above = 440 } -- from the hand
local BONE = 80

local SLEEVE = linear { from = { 150, 300 }, to = { 330, 460 }, { 0, "#6272bc" },
  { 0.6, "#7080cc" }, { 1, "#4b569c" } }
local FAR_SLEEVE, SHADE, WOOD = "#3b4585", rgb("#1d1f4a", 0.4), "#8a5f4c"
local WOOL = linear { from = { 170, 0 }, to = { -60, 0 }, { 0, "#c8433c" },
  { 1, "#ee6a45" } }
local IRON = "#372c56"

local nothing = union {}

-- ---------------------------------------------------------------- steps

--- The positions of the boots on drawing k of 8 of the walk: on the ground a boot moves back by 36
--- units per drawing, and it returns through the air. { x, y, turn } each; the body is lowest when
--- it takes the weight and highest when it passes over the leg.
local function boot_at(k)
  k = k % 8
  if k < 4 then return { 72 - 36 * k, 0, k == 0 and -14 or 0 } end
  local u = (k - 4) / 4
  return { -72 + 144 * u, -44 * math.sin(math.pi * (u * 0.85 + 0.12)), 34 * (1 - u) ^ 2 - 16 * u }
end

local bobs = { [0] = 5, 11, 0, -8 }

--- The drawings of the layer "step", by name: both boots, the body's rise, the distance walked.
local steps = {
  stand = { near = { 0, 0, 0 }, far = { 0, 0, 0 }, bob = 0, swing = 0, advance = 0 },
  halt = { near = { 18, 0, 0 }, far = { -4, 0, 0 }, bob = 5, swing = 0, advance = 14 },
}
for k = 0, 7 do
  local near, far = boot_at(k), boot_at(k + 4)
  near[1], far[1] = near[1] + 24, far[1] - 52 -- both under the middle of the coat
  steps[tostring(k + 1)] = { near = near, far = far, bob = bobs[k % 4], advance = 36,
    swing = math.cos(k * math.pi / 4) }
end

--- The distance that he has walked by each frame of the sheet, in his units.
function lamplighter.way(sheet, layer)
  local way, sum, before = {}, 0, nil
  for frame = 1, sheet.frames do
    local name = sheet:at(layer, frame)
    if name ~= before and steps[name] then sum = sum + steps[name].advance end
    way[frame], before = sum, name
  end
  return way
end

function lamplighter.step(name) return steps[name] end

-- ---------------------------------------------------------------- what is drawn here

--- A point of the upper body after the body's lean about the hip and its rise.
local function on_body(pose, point)
  local a = math.rad(pose.lean)
  local x, y = point[1] - HIP[1], point[2] - HIP[2]
  return { HIP[1] + x * math.cos(a) - y * math.sin(a),
           HIP[2] + pose.rise + x * math.sin(a) + y * math.cos(a) }
end

--- The elbow between two points, bent to the side; a hand out of reach stretches the arm.
local function elbow(from, to, side)
  local dx, dy = to[1] - from[1], to[2] - from[2]
  local reach = math.sqrt(dx * dx + dy * dy)
  local bend = side * math.sqrt(math.max(0, BONE * BONE - reach * reach / 4)) * 1.5
  reach = math.max(reach, 1)
  return { (from[1] + to[1]) / 2 - dy / reach * bend, (from[2] + to[2]) / 2 + dx / reach * bend }
end

local function sleeve(from, to, side, texture, dx, dy)
  local bend = elbow(from, to, side)
  return stroke { degree = 2, cap = "round", fill = texture, points = {
    { from[1] + dx, from[2] + dy, 62 }, { bend[1] + dx, bend[2] + dy, 60 },
    { to[1] + dx, to[2] + dy, 46 } } }
end

--- One end of the scarf: it hangs, or streams out behind him, and waves run down it.
local function tail(pose, phase, length)
  local from = on_body(pose, NAPE)
  local points = {}
  for i = 0, 6 do
    local u = i / 6
    local turn = math.rad(96 + 74 * pose.stream - 16 * phase + 10 * u)
    local wave = math.sin(pose.time * (3 + 5 * pose.stream) + phase * 1.9 - u * 4.6)
      * (7 + 17 * pose.stream) * u
    points[i + 1] = { from[1] + length * u * math.cos(turn) - wave * math.sin(turn),
                      from[2] + length * u * math.sin(turn) * 0.9 + wave * math.cos(turn),
                        34 + 14 * u }
  end
  return stroke { points = points, degree = 3, fill = WOOL }
end

--- The pole through the hand, leaning by `turn` from upright, with the wire cage at its tip.
local function pole(x, y, turn)
  local up = POLE.above
  local cage = {}
  for side = -1, 1, 2 do
    cage[#cage + 1] = stroke { degree = 2, width = 5, cap = "round", fill = IRON,
      points = {
      { 0, -up }, { 20 * side, -up - 14 }, { 13 * side, -up - 40 } } }
  end
  local shaft = stroke { fill = WOOD, cap = "round", points = {
    { 0, POLE.below, 15 }, { 0, -up, 10 } } }
  local ring = rect { -8, -up - 4, 16, 24, radius = 4, fill = IRON }
  return union { shaft, ring, table.unpack(cage) }:rotate(turn):translate(x, y)
end

local function tip_of(hand, turn)
  local a, reach = math.rad(turn), POLE.above + 24
  return { hand[1] + reach * math.sin(a), hand[2] - reach * math.cos(a) }
end

-- ---------------------------------------------------------------- the whole figure

local eyes = { "eyes-open", "lids", "eyes-shut", "eyes-happy" }
local shown_eyes = {
  open = { ["eyes-open"] = true }, half = { ["eyes-open"] = true, lids = true },
  shut = { ["eyes-shut"] = true }, happy = { ["eyes-happy"] = true },
}
local mouths = { "A", "B", "C", "D", "E", "F", "G", "H", "X", "sad", "smile" }

--- How far the moustache moves for the mouth below it.
local lifts = { C = -3, D = -6, E = -3, H = -4, smile = -5, sad = 3 }

local function put(object)
  return function() return object end
end

local function moved(dx, dy)
  return function(object) return object:translate(dx, dy) end
end

--- Adds the parts of the face for the pose to `parts`.
local function face(parts, pose)
  for _, name in ipairs(eyes) do
    if not shown_eyes[pose.eyes][name] then parts[name] = put(nothing) end
  end
  for _, name in ipairs(mouths) do
    if name ~= pose.mouth then parts["mouth-" .. name] = put(nothing) end
  end
  local lift, tilt = table.unpack(pose.brows)
  parts["near-pupil"] = moved(table.unpack(pose.gaze))
  parts["far-pupil"] = parts["near-pupil"]
  parts["moustache"] = moved(0, lifts[pose.mouth] or 0)
  parts["near-brow"] = function(brow) return brow:rotate(-tilt, 258, 142):translate(0, lift) end
  parts["far-brow"] = function(brow) return brow:rotate(tilt, 316, 142):translate(0, lift) end
  parts["hat"] = function(hat) return hat:skew(pose.hat, 0, HAT[1], HAT[2]) end
end

local function hand(name, at, turn)
  return art.parts["mitten-" .. name]:rotate(turn):translate(at[1], at[2])
end

local function limbs(parts, pose, step)
  local near, far = on_body(pose, SHOULDERS.near), on_body(pose, SHOULDERS.far)
  local staff = pole(pose.far[1], pose.far[2], pose.pole)
  local held = hand("grip", pose.far, pose.far_turn)
  local far_sleeve = sleeve(far, pose.far, 1, FAR_SLEEVE, 0, 0)
  parts["far-sleeve"] = put(pose.pole_behind and union { staff, far_sleeve } or far_sleeve)
  parts["pole"] = put(pose.pole_behind and held or union { staff, held })
  parts["near-sleeve"] = put(union {
    clip(sleeve(near, pose.near, 1, SHADE, -5, 9),
      art.parts.coat:rotate(pose.lean, HIP[1], HIP[2]):translate(0, pose.rise)),
    hand(pose.mitten, pose.near, pose.near_turn), sleeve(near, pose.near, 1, SLEEVE, 0, 0) })
  parts["mitten-grip"], parts["mitten-open"] = put(nothing), put(nothing)
  parts["near-boot"] = function(boot)
    return boot:rotate(step.near[3], 206, 540):translate(step.near[1], step.near[2])
  end
  parts["far-boot"] = function(boot)
    return boot:rotate(step.far[3], 292, 540):translate(step.far[1], step.far[2])
  end
end

local rest = { lean = 0, rise = 0, squash = 1, head = 0, hat = 0, gaze = { 0, 0 }, brows = { 0, 0 },
  near = { 172, 440 }, near_turn = 84, far = { 362, 392 }, far_turn = -8, pole = 6, stream = 0,
  eyes = "open", mouth = "X", mitten = "grip", step = "stand", time = 0 }

--- Returns the figure, the position of the cage at the pole's tip, and that of the near palm.
function lamplighter.draw(fields)
  local pose = setmetatable(fields, { __index = rest })
  local parts, step = {}, steps[pose.step]
  local function upper(object)
    return object:rotate(pose.lean, HIP[1], HIP[2]):translate(0, pose.rise)
  end
  face(parts, pose)
  limbs(parts, pose, step)
  parts["scarf-tails"] = put(union { tail(pose, 0, 176), tail(pose, 1, 140) })
  parts.coat, parts.scarf = upper, upper
  parts.head = function(head) return upper(head:rotate(pose.head, NECK[1], NECK[2])) end
  local squash = pose.squash
  local function place(x, y)
    return { (x - GROUND[1]) * (2 - squash), (y - GROUND[2]) * squash }
  end
  local figure = art:with(parts).object:translate(-GROUND[1], -GROUND[2]):scale(2 - squash, squash)
  local tip = tip_of(pose.far, pose.pole)
  local a = math.rad(pose.near_turn)
  return figure, place(tip[1], tip[2]), place(pose.near[1] + 36 * math.cos(a) + 20 * math.sin(a),
    pose.near[2] + 36 * math.sin(a) - 20 * math.cos(a))
end

return lamplighter
