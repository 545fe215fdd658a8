-- The newspaper: a passenger of the tram reads it upside down, and so does the man in its picture,
-- who looks up, too, and once when he is not looked at.
local window = require "town.window"
local geometry = require "town.geometry"
local neon = require("stage.moods").neon

local CYAN, PINK, PAPER, INK = neon.light, neon.accent, "#fff1dc", neon.ink
local SKIN, WINE, TEAL = "#f4c7a4", "#8a1458", "#149aa6"
local limb, sector = geometry.limb, geometry.sector

--- A reader, the middle of the paper at 0, 0: how far it is lowered, where he looks, and inner,
--- the same two for the man in the picture, if there is one.
local function reader(down, look, coat, hat, inner)
  local head = circle { 0, -112, 66, fill = SKIN }
    | circle { -22 + look, -120, 7, fill = INK } | circle { 22 + look, -120, 7, fill = INK }
    | sector(0, -146, 62, -90, 90, hat) | rect { -88, -152, 176, 16, radius = 8, fill = hat }
    | rect { -60, -170, 120, 18, fill = WINE }
  local page = rect { -165, -112, 330, 226, fill = PAPER }
  if inner then
    for i = 0, 4 do
      page = page | rect { 30, -86 + 26 * i, i % 2 == 0 and 112 or 92, 9, fill = "#b8a2c8" }
    end
    page = page | rect { 30, 58, 112, 30, fill = INK }
      | rect { -150, -98, 150, 170, fill = "#c9b4dc" }
      | rect { -150, 84, 150, 14, fill = INK }
      | reader(inner[1], inner[2], "#5a2a8c", INK):scale(-0.35, -0.35):translate(-75, -25)
  else
    page = page | rect { -130, -80, 110, 120, fill = INK }
    for i = 0, 3 do page = page | rect { 20, -76 + 46 * i, 110, 22, fill = "#8a70a8" } end
  end
  local hands = union {}
  for side = -1, 1, 2 do
    hands = hands | limb({ { 96 * side, 40 }, { 210 * side, 110 }, { 172 * side, 22 } }, 40, coat)
      | circle { 168 * side, 14, 23, fill = SKIN }
  end
  return rect { -100, -60, 200, 260, radius = 50, fill = coat } | head:translate(0, 26)
    | (page | hands):translate(0, down)
end

local seat = rect { 90, 240, 420, 360, radius = 60, fill = WINE }
  | rect { 60, 500, 480, 100, fill = "#5c0d45" }
local legs = limb({ { 250, 480 }, { 252, 596 } }, 54, TEAL) | limb({ { 350, 480 }, { 348, 596 } },
  54, TEAL)
local wall = rect { 0, 0, 600, 600, fill = neon.sky[3] }
  | rect { 44, 60, 512, 260, radius = 40, fill = neon.ground }
local strap = rect { 0, 36, 600, 12, fill = TEAL }
for _, x in ipairs { 176, 424 } do
  strap = strap | rect { x - 4, 44, 8, 44, fill = TEAL }
    | circle { x, 104, 22 }:stroke { width = 9, fill = PAPER }
end

--- Lamps of the street, which go by.
local function lamps(step)
  local parts = {}
  for i = 0, 3 do
    local x = 76 + 128 * i + 32 * step
    parts[#parts + 1] = circle { x, 190, 13, fill = "#ffe7a0" } | rect { x - 3, 203, 6, 117,
      fill = neon.far }
  end
  return union(parts)
end

-- For how many drawings: how low his paper is, his eyes, and both for the man in the picture.
local sheet = {
  { 5, { 0, 0, 0, 0 } }, { 1, { 40, 0, 40, 0 } }, { 9, { 62, -12, 62, -12 } },
  { 7, { 62, 12, 62, 12 } }, { 1, { 40, 0, 40, 0 } }, { 11, { 0, 0, 0, 0 } },
  { 7, { 0, 0, 62, 0 } }, { 1, { 40, 0, 0, 0 } }, { 5, { 62, 0, 0, 0 } }, { 1, { 0, 0, 0, 0 } } }

return window.film { title = "The newspaper", by = "ge", seconds = 4, size = { 600, 600 },
  pane = "round", drawing = function(_, number)
    local down, look, low, glance = table.unpack(geometry.held(sheet, number), 1, 4)
    return { wall, lamps(number // 4 % 4), strap, seat, legs,
      reader(down, look, PINK, CYAN, { low, glance }):translate(300, 340) }
  end }
