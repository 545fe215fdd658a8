-- The lift: it goes past a diver, a bride, a tuba, nobody, and two who kiss. The bride's flowers go
-- up faster than the lift: out of the tuba, through the empty floor, to those who are surprised.
local window = require "town.window"
local geometry = require "town.geometry"
local neon = require("stage.moods").neon

local CYAN, PINK, GOLD, PAPER = neon.light, neon.accent, "#ffc94d", "#fff1dc"
local SKIN, TEAL, NAVY, INK = "#f4c7a4", "#149aa6", neon.sky[2], neon.ink
local limb, sector = geometry.limb, geometry.sector
local PITCH = 470

local function eyes(x, y, apart, r)
  return circle { x - apart, y, r, fill = INK } | circle { x + apart, y, r, fill = INK }
end

local function flowers(x, y, turn)
  local parts = { polygon { { -16, 10 }, { 16, 10 }, { 0, 62 }, fill = CYAN } }
  for i, at in ipairs { { -22, 4 }, { 22, 4 }, { 0, 8 }, { -12, -16 }, { 13, -16 } } do
    parts[#parts + 1] = circle { at[1], at[2], 17, fill = i % 2 == 0 and PAPER or PINK }
  end
  return union(parts):rotate(turn):translate(x, y)
end

local function legs(x, apart, high, fill)
  return limb({ { x - apart, -high }, { x - apart, -14 } }, 26, fill)
    | limb({ { x + apart, -high }, { x + apart, -14 } }, 26, fill)
    | sector(x - apart - 6, 0, 26, -90, 90, INK) | sector(x + apart + 6, 0, 26, -90, 90, INK)
end

-- Who is on a floor, the feet at 0, 0, by the number of the pose.
local people = {}

--- A diver, and a fish that is in the helmet, too.
function people.diver(pose)
  local wave = pose == 2 and { 112, -236 } or { 96, -86 }
  local fish = union {}
  if pose == 2 then
    fish = ellipse { 12, -262, 22, 13, fill = PINK }
      | polygon { { -6, -262 }, { -26, -276 }, { -26, -248 }, fill = PINK }
  end
  return limb({ { -70, -260 }, { -150, -300 }, { -130, -460 } }, 14, TEAL)
    | legs(0, 38, 90, CYAN) | rect { -72, -200, 144, 140, radius = 52, fill = CYAN }
    | limb({ { -62, -168 }, { -104, -130 }, { -92, -84 } }, 38, CYAN)
    | limb({ { 62, -168 }, { 112, -150 }, wave }, 38, CYAN)
    | circle { -92, -78, 22, fill = PINK } | circle { wave[1], wave[2], 22, fill = PINK }
    | rect { -72, -204, 144, 26, radius = 13, fill = GOLD } | circle { 0, -262, 78, fill = GOLD }
    | circle { 0, -262, 54, fill = NAVY } | circle { 0, -262, 46, fill = PAPER }
    | eyes(0, -266, 17, 6) | fish | rect { -30, -128, 60, 34, radius = 8, fill = NAVY }
end

--- A bride, who throws her flowers.
function people.bride(pose)
  local hand = ({ { 52, -150 }, { 70, -112 }, { 84, -312 } })[pose]
  return path { fill = PAPER,
    d = "M-34 -226 C-60 -120 -120 -60 -132 0 H132 C120 -60 60 -120 34 -226 Z" }
    | path { fill = "#cbb8e6",
      d = "M-20 -300 C-110 -260 -130 -120 -150 0 H-96 C-92 -90 -60 -170 -20 -226 Z" }
    | circle { 0, -272, 44, fill = SKIN } | sector(-8, -276, 46, 180, 390, INK)
    | sector(0, -306, 34, -90, 90, PAPER) | eyes(16, -266, 13, 5)
    | limb({ { -30, -212 }, { -66, -176 }, pose == 3 and { -88, -132 } or { 26, -140 } }, 25, SKIN)
    | limb({ { 30, -212 }, { 74, -190 }, hand }, 25, SKIN)
    | (pose < 3 and flowers(hand[1], hand[2] - 20, pose == 2 and 24 or 8) or union {})
end

--- A tuba that is more than the man behind it.
function people.tuba(pose)
  local big = pose == 2 and 1.12 or 1
  local rings = union {}
  for i, r in ipairs { 108, 82, 66, 40, 24 } do
    rings = rings | circle { 0, -150, r, fill = i % 2 == 1 and GOLD or "#8a1458" }
  end
  local bell = (polygon { { 28, -170 }, { 84, -170 }, { 126, -330 }, { -10, -330 }, fill = GOLD }
    | ellipse { 58, -330, 70, 24, fill = "#8a1458" }):scale(big, big, 58, -170)
  return legs(0, 40, 100, CYAN) | circle { -70, -270, 42, fill = SKIN }
    | sector(-70, -280, 46, -90, 90, PINK) | eyes(-70, -268, 15, pose == 2 and 8 or 5)
    | (pose == 1 and flowers(58, -374, 6) or union {}) | bell | rings
    | circle { -96, -150, 24, fill = SKIN } | circle { 92, -130, 24, fill = SKIN }
end

--- Nobody; in the second pose the flowers fly past.
function people.nobody(pose)
  local lamp = rect { -4, -330, 8, 330, fill = TEAL } | sector(0, -300, 70, -90, 90, CYAN)
    | rect { -46, -12, 92, 12, fill = TEAL }
  if pose == 2 then lamp = lamp | flowers(112, -250, -20) end
  return lamp
end

--- Two who kiss, and are surprised.
function people.pair(pose)
  local lean = pose == 1 and 24 or -14
  local up = pose == 2 and 10 or 0
  local left = legs(-76, 22, 110, NAVY) | (
    rect { -126, -210, 100, 130, radius = 40, fill = CYAN }
    | circle { -76, -258, 48, fill = SKIN }
    | sector(-76, -262, 51, -100, 80, NAVY)):skew(-0.3 * lean, 0)
  local right = legs(76, 14, 60, SKIN) | (path { fill = PINK,
    d = "M52 -212 C44 -150 16 -90 4 -42 H148 C136 -90 108 -150 100 -212 Z" }
    | circle { 76, -248, 46, fill = SKIN } | sector(76, -252, 50, -80, 130, GOLD)
    | circle { 116, -300, 26, fill = GOLD }):skew(0.3 * lean, 0)
  if pose == 1 then
    return left | right | limb({ { -70, -186 }, { 0, -140 }, { 56, -170 } }, 28, CYAN)
  end
  local x = pose == 2 and 0 or 6
  return left:translate(0, -up) | right:translate(0, -up)
    | eyes(-92 + x, -262, 16, 7) | eyes(86 + x, -250, 16, 7)
    | limb({ { -120, -190 }, { -164, -200 }, { -160, -278 } }, 26, CYAN)
    | limb({ { 112, -186 }, { 162, -196 }, { 160, -270 } }, 24, SKIN)
    | flowers(-6, pose == 2 and -300 or -40, pose == 2 and 0 or 150)
end

-- ---------------------------------------------------------------- the house

local names = { "diver", "bride", "tuba", "nobody", "pair" }
local walls = { neon.far, "#5a1a6e", neon.sky[3], neon.near, "#1d2a78" }

--- Floor n with somebody in a pose, moved down by a number of floors.
local function floor(n, pose, down)
  local hall = rect { 0, 70, 450, PITCH, fill = walls[n] }
    | circle { 225, 330, 168, fill = walls[n % 5 + 1] }
    | rect { 0, 540, 450, 46, fill = TEAL } | rect { 0, 540, 450, 9, fill = CYAN }
    | people[names[n]](pose):translate(225, 540)
  return hall:translate(0, down * PITCH)
end

local cage = rect { 0, 0, 450, 122, fill = INK } | rect { 17, 100, 34, 500, fill = INK }
  | rect { 399, 100, 34, 500, fill = INK } | rect { 17, 116, 416, 6, fill = PINK }
  | sector(225, 108, 80, -90, 90, PAPER)
for n = 1, 5 do
  local a = math.rad(36 * n - 108)
  cage = cage | circle { 225 + 62 * math.sin(a), 108 - 62 * math.cos(a), 7, fill = PINK }
end

--- The hand of the dial, at floor n, which need not be whole.
local function hand(n)
  return (polygon { { -7, 0 }, { 7, 0 }, { 0, -56 }, fill = INK } | circle { 0, 0, 12, fill = INK })
    :rotate(36 * n - 108):translate(225, 108)
end

-- What follows on each floor: for how many drawings, which pose.
local acts = {
  { { 5, 1 }, { 6, 2 }, { 5, 1 } }, { { 6, 1 }, { 2, 2 }, { 7, 3 } }, { { 8, 1 }, { 7, 2 } },
  { { 6, 1 }, { 1, 2 }, { 8, 1 } }, { { 8, 1 }, { 2, 2 }, { 6, 3 } } }
local travel = { 0.08, 0.5, 0.94 }

return window.film { title = "The lift", by = "ge", seconds = 8, pane = "plain",
  drawing = function(_, number)
    local n = math.min(number // 19, 4)
    local late = number - 19 * n
    local pose = geometry.held(acts[n + 1], late)
    local moved = travel[late - (n == 4 and 16 or 15)] or 0
    local after = (n + 1) % 5
    return { floor(n + 1, pose, moved), floor(after + 1, 1, moved - 1), cage,
      hand(n + 1 + (n == 4 and -4 or 1) * moved) }
  end }
