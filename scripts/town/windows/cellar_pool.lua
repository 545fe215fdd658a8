-- The cellar pool, from above: a swimmer goes there and back, and turns at each wall with an arrow
-- of foam. On the edge a cat watches, and cannot understand it.
local window = require "town.window"
local geometry = require "town.geometry"
local noon = require("stage.moods").noon

local WATER, PALE, DEEP = noon.sky[2], "#9bd8ea", noon.sky[1]
local PAPER, RED, SKIN, INK, SAND = noon.light, noon.accent, "#f0b98d", noon.ink, noon.ground
local FUR = "#2c6277"
local limb, sector = geometry.limb, geometry.sector
local Y, LEFT, RIGHT = 236, 190, 610

local pool = { rect { 0, 0, 800, 400, fill = SAND } }
for i = 1, 6 do pool[#pool + 1] = rect { 112 * i, 17, 4, 58, fill = PAPER } end
pool[#pool + 1] = rect { 60, 86, 680, 330, radius = 18, fill = PAPER }
pool[#pool + 1] = rect { 72, 98, 656, 330, radius = 12, fill = WATER }
pool[#pool + 1] = rect { 150, Y - 10, 500, 20, fill = DEEP }
pool[#pool + 1] = rect { 150, Y - 46, 16, 92, fill = DEEP }
pool[#pool + 1] = rect { 634, Y - 46, 16, 92, fill = DEEP }
for _, y in ipairs { 116, 342 } do
  pool[#pool + 1] = rect { 72, y, 656, 12, fill = PAPER }
  for i = 0, 7 do pool[#pool + 1] = rect { 92 + 82 * i, y, 41, 12, fill = RED } end
end

--- The swimmer, to the right, the middle of the back at 0, 0: one of four drawings of a stroke.
local function swimmer(stroke)
  local near, far = stroke % 4, (stroke + 2) % 4
  local arms = { [0] = { 26, 128 }, { 92, 60 }, { 78, -4 }, { 40, -66 } }
  local parts = {}
  for side, k in pairs { [-1] = near, [1] = far } do
    local out, along = arms[k][1], arms[k][2]
    parts[#parts + 1] = limb({ { 34, 34 * side }, { 34 + 0.5 * (along - 34) + (k == 0 and 4 or 14),
      side * (0.6 * out + 26) }, { along, side * out } }, 24, SKIN)
  end
  local kick = stroke % 2 * 8 - 4
  for side = -1, 1, 2 do
    parts[#parts + 1] = limb({ { -50, 18 * side }, { -146, (16 - kick * side) * side } }, 23, SKIN)
  end
  parts[#parts + 1] = path { fill = SKIN,
    d = "M60 -38 C30 -54 -20 -32 -60 -30 V30 C-20 32 30 54 60 38 Z" }
  parts[#parts + 1] = path { fill = RED, d = "M-8 -33 L-66 -30 V30 L-8 33 Z" }
  parts[#parts + 1] = circle { 78, 0, 30, fill = PAPER } | sector(78, 0, 30, 0, 180, RED)
  return union(parts)
end

--- The swimmer rolled up at the right wall.
local function ball(angle)
  return (circle { 0, 0, 50, fill = SKIN } | sector(0, 0, 50, 120, 250, RED)
    | circle { 26, -18, 29, fill = PAPER } | sector(26, -18, 29, 0, 180, RED)):rotate(angle)
end

--- Foam: an arrow whose point is at 0, 0 and whose two arms go to the left, so long and so wide.
local function arrow(long, width)
  return stroke { points = { { -long, -0.8 * long }, { 0, 0 }, { -long, 0.8 * long } },
    width = width, cap = "round", join = "round", fill = PAPER }
end

--- Where the feet were.
local wake = circle { -160, 0, 16, fill = PALE }

--- The cat on the edge, its head turned by an angle.
local function cat(turn, tail)
  local head = circle { 0, 0, 32, fill = INK } | circle { -12, 14, 6, fill = SAND }
    | circle { 12, 14, 6, fill = SAND }
  for side = -1, 1, 2 do
    head = head | polygon { { 8 * side, -22 }, { 31 * side, -34 }, { 31 * side, -4 }, fill = INK }
  end
  return limb({ { 34, -20 }, { 78, -26 }, { 92, -26 + tail } }, 13, FUR)
    | ellipse { 0, -26, 46, 30, fill = FUR } | limb({ { -22, 0 }, { -22, 36 } }, 17, FUR)
    | limb({ { 22, 0 }, { 22, 36 } }, 17, FUR) | head:rotate(turn, 0, 0)
end
local cats = {}
for look = -1, 1 do cats[look] = cat(-40 * look, 30 * look):scale(1.25):translate(400, 74) end

-- A length of the pool in twelve drawings: nine of the way, and three of the turn.
local function length(k)
  local parts = {}
  if k < 9 then
    local x = LEFT + (RIGHT - LEFT) * (1 - (1 - (k + 1) / 9) ^ 1.3) // 1
    if k < 2 then parts[1] = arrow(116 - 6 * k, 24 - 12 * k):translate(226 + 30 * k, Y) end
    parts[#parts + 1] = (wake | swimmer(k)):translate(x, Y)
    return union(parts), x
  end
  local t = k - 9
  if t == 0 then return ball(20):translate(655, Y), 655 end
  if t == 1 then
    return arrow(80, 34):scale(-1, 1):translate(604, Y) | ball(190):translate(664, Y), 664
  end
  return arrow(108, 30):scale(-1, 1):translate(580, Y)
    | swimmer(0):scale(-1.08, 0.86):translate(562, Y), 562
end

return window.film { title = "The cellar pool", by = "ge", seconds = 4, size = { 800, 400 },
  pane = "plain", drawing = function(_, number)
    local k, is_back = number // 2 % 12, number >= 24
    local swims, x = length(k)
    if is_back then swims, x = swims:scale(-1, 1):translate(800, 0), 800 - x end
    local look = x < 340 and -1 or x > 460 and 1 or 0
    local shown = { table.unpack(pool) }
    shown[#shown + 1] = cats[look]
    shown[#shown + 1] = swims
    return shown
  end }
