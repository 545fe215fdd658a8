-- The cinema: on the screen the lamplighter lights a lamp and tips his hat, and in the third row a
-- hat answers. An iris closes the picture and opens it again.
local window = require "town.window"
local geometry = require "town.geometry"
local neon = require("stage.moods").neon

local CYAN, PINK, WINE, INK = neon.light, neon.accent, "#8a1458", neon.ink
local PAPER, TEAL, NAVY, SKIN = "#fff1dc", "#149aa6", neon.sky[2], "#f4c7a4"
local LEFT, TOP, WIDE, HIGH = 186, 92, 588, 322

-- ---------------------------------------------------------------- the hall

local function curtain(x, count)
  local parts = {}
  for i = 0, count - 1 do
    parts[#parts + 1] = rect { x + 40 * i, 0, 40, 470, fill = i % 2 == 0 and WINE or "#5c0d45" }
  end
  return union(parts)
end

local hall = union { rect { 0, 0, 960, 540, fill = neon.sky[1] }, curtain(0, 4), curtain(800, 4),
  rect { 160, 60, 640, 376, fill = neon.ground } }
for i = 0, 11 do hall = hall | geometry.sector(80 * i + 40, 76, 40, 90, 270, PINK) end

--- People from behind: x of the first, y, the radius of their heads, the head that is left out.
local function row(first, y, r, between, fill, without)
  local parts = {}
  for i = 0, 12 do
    local x = first + between * i
    parts[#parts + 1] = geometry.sector(x, y + 2.4 * r, 1.45 * r, -90, 90, fill)
    if i ~= without then parts[#parts + 1] = circle { x, y, r, fill = fill } end
    if i % 3 == 1 then
      parts[#parts + 1] = circle { x + 0.4 * r, y - 1.1 * r, 0.5 * r, fill = fill }
    end
  end
  return union(parts)
end

local seats = row(46, 408, 24, 76, "#4a2f9a") | row(84, 450, 33, 112, INK, 5)
  | rect { 0, 478, 960, 40, fill = INK }

--- Who sits under the hat, which is lifted by a number of units.
local function hatted(lift)
  local x, y = 84 + 5 * 112, 450
  local parts = { circle { x, y, 33, fill = INK } }
  for side = -1, 1, 2 do
    parts[#parts + 1] = polygon { { x + side * 2, y - 26 }, { x + side * 33, y - 6 },
      { x + side * 31, y - 62 }, fill = INK }
  end
  if lift > 0 then
    parts[#parts + 1] = geometry.limb({ { x + 44, y + 40 }, { x + 84, y - 10 },
      { x + 40, y - 34 - lift } }, 22, INK)
  end
  local hat = rect { x - 54, y - 26, 108, 12, radius = 6, fill = INK }
    | rect { x - 36, y - 96, 72, 76, radius = 6, fill = INK }
    | rect { x - 36, y - 44, 72, 13, fill = PINK }
  parts[#parts + 1] = hat:rotate(0.3 * lift, x, y):translate(0.25 * lift, -lift)
  return union(parts)
end

-- ---------------------------------------------------------------- the picture on the screen

local street = { rect { LEFT, TOP, WIDE, HIGH, fill = CYAN },
  circle { 624, 196, 74, fill = PAPER } }
local houses = { { 194, 112, 90 }, { 306, 84, 150 }, { 534, 100, 70 }, { 634, 132, 120 } }
for _, house in ipairs(houses) do
  local x, w, h = table.unpack(house)
  street[#street + 1] = rect { x, 390 - h, w, h, fill = TEAL }
  street[#street + 1] = polygon { { x - 6, 390 - h }, { x + w + 6, 390 - h },
    { x + w / 2, 352 - h }, fill = NAVY }
end
street[#street + 1] = rect { LEFT, 384, WIDE, 30, fill = PAPER }
street = union(street)

--- The lamp at the left, with its light of a radius.
local function lamp(light)
  local parts = {}
  if light > 0 then parts[1] = circle { 292, 186, light, fill = "#ffe7a0" } end
  return union(parts) | rect { 287, 210, 10, 184, fill = NAVY }
    | geometry.sector(292, 162, 26, -90, 90, NAVY)
    | polygon { { 268, 164 }, { 316, 164 }, { 306, 212 }, { 278, 212 },
      fill = light > 0 and PAPER or TEAL }
end

--- The lamplighter, his feet at 0, 0: where his hands are, how far he bows, how high his hat is.
local function man(pose)
  local hat = geometry.limb({ { -40, -218 }, { 40, -218 } }, 11, NAVY)
    | rect { -25, -270, 50, 50, fill = NAVY } | rect { -25, -232, 50, 10, fill = PINK }
  hat = hat:rotate(pose.hat[3], 0, -218):translate(pose.hat[1], pose.hat[2])
  local head = circle { 0, -196, 27, fill = SKIN }
    | geometry.sector(-14, -196, 16, 90, 250, PAPER)
    | geometry.sector(14, -196, 16, 110, 270, PAPER)
  for side = -1, 1, 2 do
    head = head | circle { 9 * side + pose.look, -203, 3.4, fill = INK }
  end
  local coat = path { fill = NAVY,
    d = "M-26 -172 C-46 -120 -56 -70 -62 -24 H62 C56 -70 46 -120 26 -172 Z" }
    | rect { -40, -24, 32, 24, radius = 6, fill = INK }
    | rect { 8, -24, 32, 24, radius = 6, fill = INK }
  local scarf = geometry.limb({ { -24, -168 }, { 24, -168 } }, 20, PINK)
    | geometry.limb({ { 14, -164 }, { 26, -130 }, { 20 + pose.look, -104 } }, 17, PINK)
  local pole = geometry.limb({ { pose.pole[1], pose.pole[2] + 60 }, pose.tip }, 7, WINE)
  local arms = geometry.limb({ { -30, -150 }, { -62, -122 }, pose.pole }, 24, "#26257a")
    | geometry.limb({ { 30, -150 }, { 72, -130 }, pose.hand }, 24, "#26257a")
    | circle { pose.pole[1], pose.pole[2], 14, fill = SKIN }
    | circle { pose.hand[1], pose.hand[2], 14, fill = SKIN }
  local upper = head | scarf | hat
  return pole | (coat | upper:translate(0, 0.2 * pose.bow) | arms)
    :skew(-0.4 * pose.bow, 0, 0, 0):scale(1, 1 - pose.bow / 320)
end

local still = { pole = { -70, -96 }, tip = { -78, -250 }, hand = { 62, -92 }, hat = { 0, 0, 0 },
  bow = 0, look = 0 }

--- A pose that differs from standing still in some fields.
local function posed(changes) return setmetatable(changes, { __index = still }) end
local stand = posed {}
local reach = posed { pole = { -74, -150 }, tip = { -134, -206 }, bow = -6, look = -7 }
local touch = posed { hand = { 40, -214 }, bow = 8 }
local swing = posed { hand = { 64, -262 }, hat = { 26, -44, 14 }, bow = -4, look = 3 }
local tipped = posed { hand = { 108, -226 }, hat = { 80, -12, 34 }, bow = 20, look = 5 }

-- For how many drawings, the man, the light of the lamp, the iris, and the hat of the third row.
local sheet = {
  { 4, { stand, 0 } },
  { 2, { reach, 0 } }, { 1, { reach, 96 } }, { 4, { reach, 78 } },
  { 3, { stand, 78 } }, { 2, { touch, 78 } }, { 1, { swing, 78 } }, { 6, { tipped, 78 } },
  { 1, { tipped, 78, nil, 18 } }, { 1, { tipped, 78, nil, 62 } }, { 6, { tipped, 78, nil, 50 } },
  { 1, { touch, 78, nil, 50 } }, { 6, { stand, 78 } },
  { 1, { stand, 78, 130 } }, { 3, { stand, 78, 40 } },
  { 4, { stand, 0, 0 } }, { 1, { stand, 0, 40 } }, { 1, { stand, 0, 130 } },
}

--- All that the screen shows; the iris is round the face of the man.
local function screen(who, light, iris)
  local frame = rect { LEFT, TOP, WIDE, HIGH }
  if iris == 0 then return frame:paint(INK) end
  local shown = street | lamp(light) | man(who):translate(432, 400)
  if iris then shown = shown | (frame - circle { 432, 200, iris }):paint(INK) end
  return shown
end

return window.film { title = "The cinema", by = "ge", seconds = 4, size = { 960, 540 },
  pane = "shop", drawing = function(_, number)
    local who, light, iris, lift = table.unpack(geometry.held(sheet, number), 1, 4)
    return { hall, screen(who, light, iris), seats, hatted(lift or 0) }
  end }
