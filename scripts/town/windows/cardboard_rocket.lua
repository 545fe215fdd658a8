-- Cardboard rocket: three, two, one, it shakes, and its nose takes off, on the head of a jack.
local window = require "town.window"
local geometry = require "town.geometry"
local rocket = require "town.rocket"
local neon = require("stage.moods").neon

local KRAFT, BROWN, PAPER = "#cf9a62", "#83503f", "#fff1dc"
local CYAN, PINK, WINE, INK = neon.light, neon.accent, "#a01c66", neon.ink

local room = {
  rect { 0, 0, 600, 600, fill = neon.sky[2] },
  circle { 300, 300, 262, fill = neon.sky[3] },
  geometry.face({ { -90, -90 }, { 240, -90 }, { 240, 240 }, { -90, 240 } }, neon.ground)
    :translate(170, 470),
}

--- Three planets on strings, swung by a number of degrees.
local function mobile(swing)
  local parts = {}
  local planets = { { 106, 160, 30, CYAN }, { 420, 106, 22, PAPER }, { 496, 204, 34, PINK } }
  for i, planet in ipairs(planets) do
    local x, y, r, fill = table.unpack(planet)
    local hung = rect { x - 1.5, 0, 3, y, fill = PAPER } | circle { x, y, r, fill = fill }
      | geometry.sector(x, y, r, 90, 180, neon.far)
    if i == 3 then hung = hung | ellipse { x, y, 54, 9, fill = PAPER }:rotate(-18, x, y) end
    parts[i] = hung:rotate(i == 2 and -swing or swing, x, 0)
  end
  return union(parts)
end

local nose = rocket.nose(PINK, WINE)

--- The box with a number, the hand of its clock at an angle, and eyes at the porthole.
local function body(number, angle, look)
  local digit = text { number, 0, 40, font = "../../type/poster.ttf", size = 118, align = "centre",
    fill = INK }
  local dial = circle { 0, 0, 60, fill = PAPER } | geometry.sector(0, 0, 60, 0, angle, PINK) | digit
  local hole = circle { 0, 0, 46, fill = BROWN } | circle { 0, 0, 38, fill = look and CYAN or INK }
  for side = -1, look and 1 or -2, 2 do
    hole = hole | ellipse { look[1] + 14 * side, look[2], 7, look.tall or 9, fill = INK }
  end
  return rocket.box { tones = { INK, KRAFT, BROWN }, fins = { PINK, WINE }, left = dial,
    right = hole }
end

--- The jack, risen by a number of units out of the box, under the nose; and where it looks.
local function jack(up, look)
  local parts = {}
  for i = 0, 8 do
    local y = 300 - (up - 40) * i / 8
    parts[#parts + 1] = ellipse { 300, y, 46, 20, fill = i % 2 == 0 and CYAN or neon.sky[2] }
  end
  local y = 288 - up
  for side = -1, 1, 2 do
    local hand = { 300 + side * 150, y + 10 - 0.25 * up }
    parts[#parts + 1] = geometry.limb({ { 300 + side * 40, y + 60 },
      { 300 + side * 130, y + 90 }, hand }, 22, CYAN)
      | circle { hand[1], hand[2], 22, fill = PAPER }
  end
  parts[#parts + 1] = circle { 300, y, 70, fill = PAPER }
    | ellipse { 300, y + 12, 54, 40, fill = INK }
  for side = -1, 1, 2 do
    parts[#parts + 1] = circle { 300 + side * 20 + look, y + 10, 11, fill = CYAN }
  end
  return union(parts) | nose:scale(0.62):translate(300, y - 62)
end

local function puffs(size)
  local parts = {}
  for i, x in ipairs { 96, 150, 205, 395, 450, 504 } do
    parts[i] = circle { x + (x - 300) * 0.1 * size, 505 + 30 * (1 - math.abs(x - 300) / 200),
      size * (i % 3 == 2 and 34 or 24), fill = PAPER }
  end
  return union(parts)
end

local poses = {}
for i, digit in ipairs { "3", "2", "1" } do
  for quarter = 1, 4 do
    local look = { ({ 9, -9, 0 })[i], 0, tall = digit == "1" and quarter > 2 and 2 or 9 }
    poses[#poses + 1] = { 2, { digit = digit, angle = 90 * quarter, look = look } }
  end
end
for i = 1, 4 do
  local look = { 0, 0, tall = 2 }
  poses[#poses + 1] = { 2, { digit = "0", angle = 0, look = look, shaken = i % 2 * 2 - 1,
    smoke = 0.3 + 0.2 * i } }
end
for _, jump in ipairs { { 1, -14, 0, 1.2 }, { 1, 84, 0, 1.25, 0.5 }, { 2, 142, 0, 1.2, 10 },
  { 2, 90, 0, 1, -8 }, { 2, 118, -12, 0.8, 6 }, { 3, 108, -12, 0.5, -3 }, { 2, 108, 12, 0.25, 2 },
  { 1, 116, 0, 0, -1 }, { 1, 40, 0, 0 } } do
  poses[#poses + 1] = { jump[1], { digit = "0", angle = 0, up = jump[2], gaze = jump[3],
    smoke = jump[4], swing = jump[5] or 0 } }
end
poses[#poses + 1] = { 1, { digit = "0", angle = 0, look = { 0, 0 }, up = -16 } }

return window.film { title = "Cardboard rocket", by = "ge", seconds = 4, size = { 600, 600 },
  pane = "round", drawing = function(_, number)
    local pose = geometry.held(poses, number)
    local up, smoke = pose.up or 0, pose.smoke or 0
    local sunk = up < 0 and -up or 0
    local box = body(pose.digit, pose.angle, pose.look):translate(170, 470)
    box = box | (up > 0 and jack(up, pose.gaze) or nose:translate(300, 290))
    if sunk > 0 then box = box:scale(1 + sunk / 200, 1 - sunk / 150, 300, 540) end
    if pose.shaken then box = box:rotate(1.6 * pose.shaken, 300, 540):translate(0, -4) end
    local shown = { room[1], room[2], room[3], mobile(pose.swing or 0), box }
    if smoke > 0 then shown[#shown + 1] = puffs(smoke) end
    return shown
  end }
