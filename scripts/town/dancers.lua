-- Who dances on the blinds of the town, and the mouse below them.
local ink = require "town.silhouette"
local mood = require("stage.moods").candle

local dancers = {}

local function between(from, to, share) return from + (to - from) * share end

local SKIRT = path { d = "M-22 -24 C-60 -34 -132 -12 -150 10 C-96 6 -120 26 -70 18 "
  .. "C-60 34 -30 20 0 26 C30 34 50 22 74 16 C120 24 100 4 150 4 C126 -18 50 -34 22 -24 Z" }

--- A dancer on the toe at (0, 58). turn: degrees; low: how far she bends her knee; out: her leg, 0
--- with its toe at the knee, to 1, an arabesque; raised: her arms, 0 to 1; tilt: of her skirt.
function dancers.girl(turn, low, out, raised, tilt)
  local c, s = math.cos(math.rad(turn)), math.sin(math.rad(turn))
  local hip, lean = -196 + low, 14 * out
  local chest = { 10 * out + lean, hip - 96, 40 }
  local knee = { between(86 * c, -70, out), between(hip + 60, hip + 6, out), 24 }
  local toe = { between(16 * c, -176, out), between(hip + 96, hip - 34, out), 9 }
  local parts = {
    ink.limb({ 0, hip, 36 }, { low * 1.2, hip / 2 + 20, 34 }, { 0, 34, 13 }),
    path { d = "M-9 26 C-8 44 -4 60 0 60 C4 60 8 44 9 26 Z" },
    ink.limb({ 0, hip, 34 }, { (knee[1]) / 2, (hip + knee[2]) / 2, 32 }, knee),
    ink.limb(knee, { (knee[1] + toe[1]) / 2, (knee[2] + toe[2]) / 2 + 4, 20 }, toe),
    ink.limb({ 0, hip, 40 }, { -4 + lean / 2, hip - 50, 26 }, chest),
    ink.limb({ chest[1], chest[2] - 4, 20 }, { chest[1], chest[2] - 24, 16 },
      { chest[1] + 4, chest[2] - 44, 16 }) }
  for _, hand in ipairs { -1, 1 } do
    local wide = hand * (math.abs(c) * 0.75 + 0.25) * between(1, 0.86, raised)
    local x = between(between(96, 128, out) * hand, 12 * wide, raised)
    local y = between(between(46, hand * -34, out), -156, raised)
    parts[#parts + 1] = ink.limb({ chest[1] + 12 * wide, chest[2] + 4, 17 },
      { chest[1] + 90 * wide, chest[2] + between(26, -60, raised), 16 },
      { chest[1] + x, chest[2] + y, 10 })
  end
  local head = ellipse { 0, -24, 25, 30 }
    | path { d = "M10 -30 C30 -30 34 -18 24 -10 Z" }:scale(c < 0 and -1 or 1, 1)
    | circle { -22 * c, -52, 17 }
  parts[#parts + 1] = head:rotate(10 * out):translate(chest[1] + 4, chest[2] - 44)
  parts[#parts + 1] = SKIRT:scale(between(1, 0.86, math.abs(s)), 1):rotate(tilt):translate(0, hip)
  return union(parts)
end

--- Who turns on one toe at (0, 0) below the blind, as she does.
function dancers.mouse(turn, low, out, raised)
  local c = math.cos(math.rad(turn))
  local wide = math.abs(c) < 0.3 and 0.3 or c
  local function arm(side)
    return ink.limb({ 3 * side, -30, 5 }, { 26 * side, -34 - 12 * raised, 4 },
      { (22 - 14 * raised) * side, -38 - 34 * raised, 3 })
  end
  local head = path { d = "M-10 -42 C-12 -56 6 -56 11 -49 L23 -42 C14 -34 -8 -32 -10 -42 Z" }
    | circle { -9, -53, 6.5 } | circle { 4, -56, 6.5 }
  local body = path { d = "M0 0 L-4 -12 C-20 -18 -10 -40 2 -42 C14 -38 14 -16 3 -12 Z" }
  local tail = ink.limb({ -8, -16, 5 }, { -24, -4, 4 }, { -46, -18 - 16 * out, 2 })
  return ((body | head | tail | arm(-1) | arm(1)):rotate(16 * out, 0, -20)):scale(wide, 1)
    :translate(0, low / 6)
end

--- A bear, as the dancer.
function dancers.bear(turn, low, out, raised, tilt)
  local c = math.cos(math.rad(turn))
  local hip, lean = -136 + low, 16 * out
  local knee = { between(92 * c, -84, out), between(hip + 50, hip + 22, out), 54 }
  local toe = { between(20 * c, -168, out), between(hip + 110, hip - 10, out), 42 }
  local parts = { ink.limb({ 0, hip, 74 }, { low * 0.9, hip / 2 + 20, 66 }, { 0, 26, 46 }),
    ellipse { 6, 44, 34, 15 },
    ink.limb({ 0, hip, 70 }, { knee[1] / 2, (hip + knee[2]) / 2, 66 }, knee),
    ink.limb(knee, { (knee[1] + toe[1]) / 2, (knee[2] + toe[2]) / 2, 50 }, toe),
    ellipse { 0, -62, 84, 112 }:rotate(lean):translate(0, hip) }
  local x, y = 3.2 * lean, hip - 142
  for _, hand in ipairs { -1, 1 } do
    local wide = hand * (math.abs(c) * 0.6 + 0.4)
    parts[#parts + 1] = ink.limb({ x + 40 * wide, y + 20, 46 },
      { x + 132 * wide, y + between(20, -60, raised), 44 },
      { x + between(134, 40, raised) * wide, y + between(-16 * hand - 20, -146, raised), 36 })
  end
  local head = circle { 0, -34, 56 } | circle { -42, -74, 21 } | circle { 42, -74, 21 }
    | ellipse { 34 * c, -20, 38, 26 }
  parts[#parts + 1] = head:rotate(12 * out + tilt / 3):translate(x, y)
  parts[#parts + 1] = SKIRT:scale(1.24, 1.5):rotate(tilt):translate(0, hip + 10)
  return union(parts)
end

--- A room behind a drawn blind: the light from its lamp, and what is seen below.
function dancers.room()
  local lamp = radial { centre = { 225, 280 }, radius = 330, { 0, "#fff4d8" },
    { 0.45, mood.light }, { 1, "#e0862b" } }
  return rect { 0, 0, 450, 600, fill = "#d06a24" } | rect { 30, 17, 390, 480, fill = lamp }
    | (rect { 17, 17, 416, 18 } | rect { 24, 490, 402, 9 }):paint(mood.ink)
end

return dancers
