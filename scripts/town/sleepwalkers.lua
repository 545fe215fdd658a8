-- Who walks asleep: a man, a cat and a mouse, with their feet at y = 0 and their eyes shut. All
-- look to the right and hold out both arms, at whose end a candle may be.
local ink = require "town.silhouette"

local sleepwalkers = {}

--- Two legs from a hip. walked: how many double steps; long, lift: of a step; widths of the legs.
local function legs(hip_x, hip_y, walked, long, lift, thick)
  local parts = {}
  for i = 0, 1 do
    local share = (walked + 0.5 * i) % 1
    local u = 2 * share - 1
    local x, y = long * (0.5 - 2 * share), 0
    if share >= 0.5 then
      x, y = long * (u * u * (3 - 2 * u) - 0.5), -lift * math.sin(math.pi * u)
    end
    parts[2 * i + 1] = ink.limb({ hip_x, hip_y, thick },
      { hip_x + x / 2 + 0.3 * long, hip_y / 2 + y, thick * 0.8 }, { x, y - thick / 2, thick * 0.7 })
    parts[2 * i + 2] = ellipse { x + thick * 0.6, y - thick * 0.3, thick, thick * 0.36 }
  end
  return union(parts)
end

local function shut(x, y, wide)
  return path { d = ("M%g %g q%g %g %g 0 q%g %g %g 0 Z"):format(x - wide, y, wide, 1.4 * wide,
    2 * wide, -wide, 0.6 * wide, -2 * wide) }
end

--- The point of a candle's flame above the hand at (x, y), its stick, and its flame.
local function candle(x, y, size)
  local stick = rect { x - 0.18 * size, y - size, 0.36 * size, 1.1 * size }
    | ellipse { x, y + 0.1 * size, 0.6 * size, 0.16 * size }
  local flame = path { d = "M0 0 C-14 -6 -12 -24 2 -40 C14 -22 14 -6 0 0 Z" }
    :scale(size / 44):translate(x, y - size - 2)
  return stick, flame, { x, y - 1.4 * size }
end

--- Each returns a shape, the flame, and the place of its light; `sway` is -1..1. The man has a
--- candle unless he is `empty`-handed, the cat if it `holds` one.
function sleepwalkers.man(walked, sway, empty)
  local bob = 6 * math.cos(4 * math.pi * walked)
  local shirt = path { d = ("M-34 -322 C-52 -240 -70 -120 %g -66 Q%g -50 0 -62 Q%g -50 %g -66 "
    .. "C62 -140 48 -250 28 -322 Z"):format(-78 - 8 * sway, -40, 36, 66 - 6 * sway) }
  local head = path { d = "M-30 -318 C-46 -360 -34 -400 4 -402 C30 -402 40 -390 40 -378 L66 -352 "
    .. "C62 -344 50 -344 42 -344 L44 -330 C38 -316 24 -314 12 -316 L12 -300 L-28 -300 Z" }
  local cap = path { d = "M-42 -366 C-42 -420 -6 -444 24 -428 C38 -418 44 -398 48 -380 Z" }
  local tail = ink.limb({ -4, -416, 40 }, { -84, -440, 24 },
    { -92 - 14 * sway, -340 - 8 * sway, 8 })
  local arms = ink.limb({ 4, -294, 36 }, { 70, -286, 26 }, { 146, -292, 18 })
    | ink.limb({ 0, -280, 32 }, { 60, -262, 24 }, { 132, -262, 18 })
  local stick, flame, light = candle(150, -300, 40)
  local body = shirt | (head - shut(24, -362, 9)) | cap | tail
    | circle { -92 - 14 * sway, -332 - 8 * sway, 15 } | arms
  if not empty then body = body | stick end
  return legs(-6, -90, walked, 96, 34, 26) | body:translate(0, bob), flame:translate(0, bob),
    { light[1], light[2] + bob }
end

function sleepwalkers.cat(walked, sway, holds)
  local bob = 5 * math.cos(4 * math.pi * walked)
  local body = path { d = "M-20 -150 C-48 -110 -58 -56 -40 -34 C-20 -18 18 -20 30 -40 "
    .. "C38 -80 34 -124 20 -150 Z" }
  local head = path { d = "M-40 -150 C-46 -172 -40 -190 -36 -200 L-34 -232 L-8 -212 L22 -214 "
    .. "L44 -236 L46 -198 C56 -176 48 -150 24 -142 C2 -136 -26 -138 -40 -150 Z" }
  local tail = ink.limb({ -34, -46, 20 }, { -110, -24, 20 }, { -92 - 8 * sway, -120, 12 })
  local arms = ink.limb({ 4, -128, 24 }, { 50, -122, 20 }, { 92, -128, 18 })
    | ink.limb({ 0, -116, 24 }, { 44, -100, 20 }, { 84, -104, 18 })
  local eyes = shut(2, -178, 9) | shut(32, -178, 9)
  local stick, flame, light = candle(96, -136, 32)
  local shape = body | (head - eyes) | tail | arms
  if holds then shape = shape | stick end
  return legs(-8, -48, walked, 96, 22, 22) | shape:translate(0, bob), flame:translate(0, bob),
    { light[1], light[2] + bob }
end

function sleepwalkers.mouse(walked, sway)
  local bob = -5 * math.abs(math.sin(4 * math.pi * walked))
  local shape = path { d = "M-12 -4 C-24 -26 -12 -52 0 -56 C8 -64 20 -62 24 -54 L36 -48 "
    .. "C30 -40 20 -38 14 -38 C20 -24 18 -8 12 -4 Z" } | circle { -4, -62, 10 }
    | circle { 10, -66, 9 } | ink.limb({ 8, -32, 7 }, { 20, -30, 6 }, { 36, -30, 5 })
    | ink.limb({ -14, -8, 5 }, { -40, 2, 4 }, { -48, -26 - 6 * sway, 2 })
  local stick, flame, light = candle(38, -32, 14)
  return (shape - shut(18, -50, 3) | stick):scale(1.5):translate(0, bob),
    flame:scale(1.5):translate(0, bob), { 1.5 * light[1], 1.5 * light[2] + bob }
end

return sleepwalkers
