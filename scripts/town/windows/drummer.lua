-- The drummer: four limbs, a colour for each side, and a bar of four beats. A stick that hits is a
-- sector of a disc: all the places where it was.
local window = require "town.window"
local geometry = require "town.geometry"
local neon = require("stage.moods").neon

local CYAN, PINK, PAPER, INK = neon.light, neon.accent, "#fff1dc", neon.ink
local SKIN, WINE, TEAL = "#f4c7a4", "#8a1458", "#149aa6"
local limb, sector = geometry.limb, geometry.sector

--- An arm of a side, -1 or 1, from its shoulder to a hand, with a stick at an angle; the stick
--- leaves a fan behind it where it hits.
local function arm(side, hand, angle, fan)
  local shoulder = { 225 + 52 * side, 262 }
  local elbow = { (shoulder[1] + hand[1]) / 2 + 44 * side, (shoulder[2] + hand[2]) / 2 + 46 }
  local fill = side < 0 and CYAN or PINK
  local parts = { limb({ shoulder, elbow, hand }, 32, fill) }
  if fan then
    parts[#parts + 1] = sector(hand[1], hand[2], 112, math.min(angle, fan), math.max(angle, fan),
      fill)
  end
  if angle then
    local a = math.rad(angle)
    parts[#parts + 1] = limb({ hand, { hand[1] + 112 * math.sin(a), hand[2] - 112 * math.cos(a) } },
      10, PAPER)
  end
  parts[#parts + 1] = circle { hand[1], hand[2], 20, fill = SKIN }
  return union(parts)
end

--- A stick that turns in the air.
local function tossed(y, angle)
  return rect { 344, y - 56, 10, 112, radius = 5, fill = PAPER }:rotate(angle, 349, y)
end

-- The left hand in the three drawings of each eighth: it hits, is low, is up.
local eighth = { { { 128, 282 }, -102, -20 }, { { 130, 290 }, -96 }, { { 124, 246 }, -28 } }

-- The right hand in the bar: for how many drawings, where; cymbal, drum, cymbal, drum, and a toss.
local CRASH, LOW, HIGH = { 322, 244 }, { 300, 306 }, { 322, 210 }
local bar = {
  { 1, { CRASH, 62, -20 } }, { 2, { CRASH, 54 } }, { 1, { HIGH, 10 } }, { 2, { HIGH, -14 } },
  { 1, { LOW, 140, 0 } }, { 2, { LOW, 128 } }, { 3, { LOW, 100 } }, { 3, { HIGH, 10 } },
  { 3, { HIGH, -14 } }, { 1, { LOW, 140, 0 } }, { 1, { HIGH, nil, nil, { 120, 30 } } },
  { 1, { HIGH, nil, nil, { 66, 130 } } }, { 1, { HIGH, nil, nil, { 60, 220 } } },
  { 1, { HIGH, nil, nil, { 110, 320 } } }, { 1, { HIGH, 10 } } }

--- A part that swings after a blow at one of some numbers, most at once and less later.
local function struck(number, hits, most)
  for _, hit in ipairs(hits) do
    local late = (number - hit) % 24
    if late < 6 then return most * ({ 1, -0.7, 0.45, -0.25, 0.12, 0 })[late + 1] end
  end
  return 0
end

local function cymbal(x, y, rx, fill, turn)
  return rect { x - 3, y, 6, 560 - y, fill = TEAL }
    | (ellipse { x, y, rx, 11, fill = fill } | sector(x, y - 4, 14, -90, 90, fill))
      :rotate(turn, x, y)
end

local function drum(x, y, rx, high, sunk)
  return rect { x - rx, y, 2 * rx, high, fill = PINK }
    | rect { x - 4, y + high, 8, 200, fill = TEAL }
    | ellipse { x, y + high, rx, 15, fill = PINK }
    | rect { x - rx, y + 20, 2 * rx, 12, fill = WINE }
    | ellipse { x, y, rx, 15 + sunk, fill = PAPER }
end

--- The big drum; its skin comes out at a blow.
local function bass(blow)
  local parts = {}
  local rings = { { 122, CYAN }, { 106, INK }, { 98, PAPER }, { 60, PINK }, { 34, PAPER } }
  for i, ring in ipairs(rings) do
    parts[i] = circle { 225, 458, ring[1] + (i > 3 and 1.4 * blow or 0), fill = ring[2] }
  end
  return union(parts)
end

local bobs = { 6, 16, 9, 0, -5, -3 } -- the head, one drawing late

local function head(number)
  local bob, late = bobs[number % 6 + 1], bobs[(number - 1) % 6 + 1]
  local y = 178 + bob
  local hair = circle { 225, y - 26 + 1.2 * (late - bob), 74, fill = PINK }
    | sector(225, y - 26 + 1.2 * (late - bob), 74, 180, 360, CYAN)
  return hair | limb({ { 225, y + 30 }, { 225, 250 } }, 34, SKIN)
    | circle { 225, y, 48, fill = SKIN }
    | sector(203, y - 6, 20, 90, 270, INK) | sector(247, y - 6, 20, 90, 270, INK)
    | rect { 183, y - 9, 84, 7, fill = INK }
end

local function leg(side, lift)
  return limb({ { 225 + 30 * side, 400 }, { 225 + 150 * side, 380 - 2 * lift },
    { 225 + 138 * side, 552 - lift } }, 42, side < 0 and TEAL or WINE)
    | sector(225 + 146 * side, 574 - lift, 30, -90, 90, INK)
end

local body = path { fill = PINK, d = "M225 240 H262 Q296 244 292 290 L280 420 H225 Z" }
  | path { fill = CYAN, d = "M225 240 H188 Q154 244 158 290 L170 420 H225 Z" }
local wall = rect { 0, 0, 450, 600, fill = neon.sky[2] }

return window.film { title = "The drummer", by = "ge", seconds = 2,
  drawing = function(_, number)
    local kick = math.max(0, struck(number, { 0, 9, 12 }, 9))
    local right = geometry.held(bar, number)
    local toss, left = right[4], eighth[number % 3 + 1]
    local beat = number % 6
    local lifted = number == 8 or number == 11 or number == 23
    return { wall, circle { 225, 300, beat < 2 and 215 or 196, fill = neon.sky[3] },
      leg(-1, beat == 5 and 12 or 0), leg(1, lifted and 14 or 0),
      body, head(number),
      cymbal(386, 226, 64, CYAN, 14 + struck(number, { 0 }, 16)),
      cymbal(78, 322 + (beat == 0 and 4 or 0), 60, PINK, -4), cymbal(78, 334, 60, CYAN, -4),
      drum(344, 372, 66, 56, struck(number, { 6, 18 }, 5)), bass(kick),
      arm(-1, left[1], left[2], left[3]), arm(1, right[1], right[2], right[3]),
      toss and tossed(toss[1], toss[2]) or nil }
  end }
