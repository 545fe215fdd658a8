-- The lamplighter: coat, scarf in the wind, one arm to tell the story and one to hold the lantern.
-- She comes along the hill, speaks, and leaps. Drawn around the point between the boots, negative y
-- is up, about 640 units tall.
local face = require "demo.face"
local palette = require "demo.palette"
local shapes = require "demo.shapes"

local character = {}

local function disc(x, y, r, texture)
  return circle { x, y, r, fill = texture }
end

local STEP = 112

--- The steps that are still to go, at a time: at 0 she has arrived.
local steps = keys { { 0, -5 }, { 1.6, -0.85 }, { 2.2, 0, "outSine" } }

-- The leap: how tall she is, and how high.
local tall = keys { { 6.3, 1 }, { 6.8, 0.84, "inOutSine" }, { 6.95, 1.1, "outQuad" },
                    { 7.25, 1.02, "inOutSine" }, { 7.5, 1.06 }, { 7.62, 0.84, "outQuad" },
                    { 7.95, 1.04, "inOutSine" }, { 8.2, 1, "inOutSine" } }
local UP, DOWN, HEIGHT = 6.9, 7.52, 150

local function height(time)
  local u = (time - UP) / (DOWN - UP)
  return 4 * HEIGHT * math.max(0, u * (1 - u))
end

--- Where her feet are on the ground of the valley.
function character.place(time)
  local to_go = -steps:at(time) * STEP
  return 1500 + to_go, 946 + 0.07 * to_go
end

--- Where a point of the figure is in the pose of that time, and how to carry a drawing there.
local function posed(time)
  local u, stretch = steps:at(time), tall:at(time)
  local stride = math.sin(math.pi * u)
  local lean = 2.2 * stride + (u < 0 and 2 * u / (1 - u) or 0)
  local lift = -height(time) - 16 * math.abs(stride)
  local sin, cos = math.sin(math.rad(lean)), math.cos(math.rad(lean))
  local function point(x, y)
    x, y = x * (2 - stretch), y * stretch
    return x * cos - y * sin, x * sin + y * cos + lift
  end
  return point, function(art)
    return art:scale(2 - stretch, stretch):rotate(lean):translate(0, lift)
  end
end

local cloth = shapes.across(-110, 140, palette.coat)
local trim = shapes.across(-130, 140, palette.trim)

local function coat()
  local outline = path { fill = cloth, d =
    "M-58 -300C-104 -280 -128 -150 -150 -76Q0 -32 150 -76C128 -150 104 -280 58 -300Z" }
  local hem = shapes.ribbon({ { -156, -86, 26 }, { -80, -66, 26 }, { 0, -59, 26 }, { 80, -66, 26 },
                              { 156, -86, 26 } }, trim)
  local front = shapes.ribbon({ { -6, -300, 5 }, { -12, -180, 5 }, { -16, -60, 5 } },
                              palette.coat[2])
  local parts = { outline, clip(union { hem, front }, outline) }
  for i = 0, 2 do parts[#parts + 1] = disc(-34, -240 + i * 56, 9, palette.button) end
  return union(parts)
end

local body = coat()
local collar = shapes.ribbon({ { -86, -306, 30 }, { -40, -284, 46 }, { 10, -278, 50 },
                               { 56, -286, 44 }, { 88, -308, 28 } },
                             shapes.across(-80, 110, palette.scarf))

local boot = path { fill = palette.boot, d =
    "M-22 -52H22L25 -4Q25 5 16 5H-44Q-54 5 -52 -8Q-48 -24 -22 -28Z" }
  | shapes.ribbon({ { -25, -50, 15 }, { 0, -48, 17 }, { 25, -50, 15 } }, trim)

--- A leg under the coat: its boot's place along the way, above the ground, and its turn.
local function leg(hip, x, y, turn)
  local ankle = y - 40
  return union {
    shapes.ribbon({ { hip, -110, 40 }, { (hip + x) / 2 - 5, (ankle - 110) / 2, 36 },
                    { x, ankle, 32 } }, palette.tights),
    boot:rotate(turn, 0, -40):translate(x, y) }
end

--- Both legs: one stays where it was put, the other passes it. In the air the toes point down.
local function legs(time)
  local u = steps:at(time)
  local part, is_even = u % 1, math.floor(u) % 2 == 0
  local passed = part * part * (3 - 2 * part)
  local air = math.min(1, height(time) / 60)
  local tuck = 1 - 0.4 * air
  local standing = { (part - 0.5) * STEP * tuck, 0, -24 * air }
  local swinging = { (0.5 + part - 2 * passed) * STEP * tuck, -34 * math.sin(math.pi * part),
                     -30 * math.sin(2 * math.pi * part) - 24 * air }
  local left, right = standing, swinging
  if not is_even then left, right = swinging, standing end
  return leg(30, table.unpack(right)) | leg(-30, table.unpack(left))
end

--- One end of the scarf: a wave that runs along the cloth and grows. It flies up in the leap.
local function tail(time, phase, length, drop)
  local points = {}
  local fall = 80 * math.sin(math.pi * math.max(0, math.min(1, (time - UP) / 0.9)))
  for i = 0, 6 do
    local u = i / 6
    local wave = math.sin(time * 4.2 + phase - u * 4.4) * 26 * u
    points[i + 1] = { 40 + length * u, -290 + (drop - fall) * u + wave, 40 + 8 * u }
  end
  return shapes.ribbon(points, shapes.across(40, 60 + length, palette.scarf))
end

--- Two bones from the shoulder: elbow, hand, and the sine and cosine of the lower one. Angles in
--- degrees from straight down, outwards positive.
local function joints(side, upper, lower)
  local x, y = side * 74, -264
  local a, b = math.rad(upper), math.rad(upper + lower)
  local sin, cos = side * math.sin(b), math.cos(b)
  local ex, ey = x + side * 100 * math.sin(a), y + 100 * math.cos(a)
  return x, y, ex, ey, ex + 92 * sin, ey + 92 * cos, sin, cos
end

local GRIP = 24 -- from the wrist to the middle of the hand

local function arm(side, upper, lower)
  local x, y, ex, ey, hx, hy, sin, cos = joints(side, upper, lower)
  local gx, gy = hx + GRIP * sin, hy + GRIP * cos
  local wool = shapes.across(x - 60 + side * 30, x + 90 + side * 30, palette.coat)
  local sleeve = disc(x, y, 25, wool) | disc(ex, ey, 23, wool)
    | shapes.ribbon({ { x, y, 50 }, { ex, ey, 47 }, { hx, hy, 56 } }, wool)
  local cuff = shapes.ribbon({ { hx - 10 * sin, hy - 10 * cos, 60 },
                               { hx + 8 * sin, hy + 8 * cos, 62 } }, trim)
  local thumb = stroke { cap = "round", fill = palette.skin, width = 19, points = {
    { gx, gy }, { gx + 12 * sin - 20 * cos, gy + 12 * cos + 20 * sin } } }
  local hand = union { thumb, disc(gx, gy, 25, palette.skin),
    disc(gx + 9 * sin, gy + 9 * cos, 22, palette.skin) }
  return union { hand, sleeve, cuff }
end

--- upper and lower arm: swing with the steps, offer the hills, the houses, and reach for the stars.
local telling = keys {
  { 0.9, { 16, 12 } }, { 1.5, { 30, 66 }, "outBack" }, { 2.6, { 28, 62 }, "inOutSine" },
  { 3.3, { 72, 30 }, "outBack" }, { 4.2, { 66, 24 }, "inOutSine" },
  { 4.9, { 50, 18 }, "inOutQuad" }, { 5.6, { 46, 26 }, "inOutSine" },
  { 6.3, { 30, 60 }, "inOutSine" }, { 6.8, { -8, 24 }, "inOutSine" },
  { 7.15, { 124, 16 }, "outBack" }, { 7.6, { 112, 34 }, "inOutSine" },
  { 8.2, { 134, 24 }, "outBack" }, { 8.7, { 128, 2 }, "inOutSine" },
  { 9.2, { 134, 26 }, "inOutSine" }, { 9.7, { 130, 4 }, "inOutSine" },
}
local carrying = keys {
  { 6.3, { 30, 44 } }, { 6.8, { 4, 30 }, "inOutSine" }, { 7.1, { 120, 10 }, "outBack" },
  { 7.7, { 110, 18 }, "inOutSine" }, { 8.6, { 34, 46 }, "inOutSine" }, { 9.6, { 30, 44 } },
}

--- The angles of the arm that carries the lantern, and of the lantern at its hand.
local function carried(time)
  local sway, stride = math.sin(time * 1.7), math.sin(math.pi * steps:at(time))
  local upper, lower = table.unpack(carrying:at(time))
  local behind = carrying:at(time - 0.12)[1] -- the lantern follows the arm
  return upper + sway * 1.5 + 7 * stride, lower + sway * 2,
    5 * math.sin(time * 2.6) + 9 * stride + 0.35 * (upper - behind)
end

local function lantern(x, y, swing)
  local glass = path { d = "M-24 34L24 34L30 94L-30 94Z", fill = "#ffdf9c" }
  local frame = union {
    shapes.ribbon({ { -20, 30, 5 }, { 0, -2, 5 }, { 20, 30, 5 } }, palette.brass),
    polygon { { -34, 36 }, { 0, 16 }, { 34, 36 }, fill = palette.brass },
    rect { -36, 92, 72, 12, radius = 5, fill = palette.brass },
    rect { -3, 34, 6, 60, fill = palette.brass },
  }
  local function place(v) return v:rotate(swing):translate(x, y) end
  return place(glass), place(frame)
end

--- Where the hand with the lantern is, and the lantern's flame.
local function grip(time)
  local upper, lower, swing = carried(time)
  local _, _, _, _, hx, hy, sin, cos = joints(1, upper, lower)
  local x, y, turn = hx + GRIP * sin, hy + GRIP * cos, math.rad(swing)
  return x, y, swing, x - 66 * math.sin(turn), y + 66 * math.cos(turn)
end

--- The flame of the lantern, in the units of the valley.
function character.flame(time)
  local _, _, _, fx, fy = grip(time)
  local x, y = character.place(time)
  fx, fy = posed(time)(fx, fy)
  return x + fx, y + fy
end

--- Figure, lantern's glass, lantern's frame: in the units of the valley.
function character.draw(time, shape)
  local sway, stride = math.sin(time * 1.7), math.sin(math.pi * steps:at(time))
  local upper, lower = table.unpack(telling:at(time))
  local story = arm(-1, upper - 16 * stride, lower)
  upper, lower = carried(time)
  local head = face.draw(time, shape)
    :rotate(2.4 * math.sin(time * 2.3) - 2 - 2 * stride):translate(sway * 2, -392 + sway)
    :named "head"
  local upright = union {
    tail(time, 0, 250, 40), tail(time, 1.3, 200, 96), arm(1, upper, lower):named "lantern arm",
    body:skew(3 * stride, 0, 0, -300), story:named "telling arm", head, collar }
  local x, y = character.place(time)
  local _, carry = posed(time)
  local function stand(art) return carry(art):translate(x, y) end
  local high = height(time)
  local shadow = ellipse { 0, 2, 132 - 0.3 * high, 15 - 0.04 * high, fill = "#101a1c70" }
    :translate(x, y)
  local hx, hy, swing = grip(time)
  local glass, frame = lantern(hx, hy, swing)
  local walking = legs(time):translate(x, y - high)
  return shadow | walking | stand(upright), stand(glass), stand(frame)
end

return character
