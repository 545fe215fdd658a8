-- A violin maker planes; the shaving curls into a scroll as large as his head, and drops.
local pencil, window = require "town.pencil", require "town.window"

local SHAVING, APRON = "#e3b25e", "#7c5a41"
local still = pencil.hand()

local function violin(x, y, size)
  return union { still.wash({ 0, -70, 22, -62, 26, -38, 14, -18, 34, 10, 30, 40, 0, 52, -30, 40,
    -34, 10, -14, -18, -26, -38, -22, -62 }, "#a9602f"), still.line({ -22, -62, -27, -38, -14, -18,
      -35, 10, -30, 40, 0, 52, 20, 46 }, 5), rect { -4, -130, 10, 130, fill = "#4b3020" },
    still.line({ 4, -126, -8, -140, 4, -150, 12, -142, 5, -137 }, 5),
    still.line({ -16, -8, -11, 6, -16, 20 }, 3.5), still.line({ 20, -8, 15, 6, 20, 20 }, 3.5) }
    :scale(size):translate(x, y)
end

--- A shaving that leaves its place at 0, 0, with a number of turns.
local function curl(turns)
  local points, count = {}, math.ceil(8 * turns) + 2
  local radius = 12 + 20 * turns
  for i = 0, count - 1 do
    local u = i / (count - 1)
    local a = math.pi / 2 - 2 * math.pi * turns * u
    local r = radius * (1 - 0.82 * u)
    points[2 * i + 1], points[2 * i + 2] = r * math.cos(a), -radius + r * math.sin(a)
  end
  return still.line(points, 14) | still.line(points, 8.5, SHAVING)
end

local room = union { rect { 0, 0, 450, 600, fill = "#dcc591" },
  path { fill = "#f3e3b6", d = "M-10 130L120 120L330 420L-10 420Z" },
  still.line({ 232, 138, 340, 134, 440, 138 }, 7), still.line({ 290, 138, 290, 152 }, 3),
  still.line({ 376, 136, 376, 156 }, 3), violin(290, 246, 0.72), violin(376, 274, 0.86) }

local bench = union { still.wash({ -10, 402, -10, 402, 470, 402, 470, 402, 470, 440, 470, 440, -10,
  440, -10, 440 }, "#8d6548"), still.line({ 20, 403, 200, 400, 440, 404 }, 7),
  rect { 0, 440, 450, 160, fill = "#6b4a35" },
  still.form({ 160, 402, 160, 402, 160, 384, 160, 384, 430, 382, 430, 382, 430, 402, 430, 402 },
    "#e6bf7c", 4), curl(1.5):scale(0.7):translate(330, 580), curl(1.2):scale(0.8):translate(388,
      584),
  curl(1.7):scale(0.62):translate(262, 584), curl(1.1):scale(0.6):translate(300, 540),
  curl(1.3):scale(0.7):translate(360, 546) }

local function man(p, x)
  local lean = math.floor((x - 200) / 40)
  local near, nx, ny = p.limb(120 + 10 * lean, 300 + 3 * lean, { x - 26, 364 }, 98, 1, { 50, 32 },
    "#8fa3a1")
  local far, fx, fy = p.limb(176 + 10 * lean, 300 + 3 * lean, { x + 30, 362 }, 84, -1, { 42, 28 },
    "#7d9190")
  local body = union { p.form({ 40, 470, 46, 370, 72, 300, 118, 268, 170, 274, 204, 310, 212, 400,
    206, 470 }, "#8fa3a1", 6.5),
    p.wash({ 110, 470, 124, 330, 132, 290, 132, 290, 186, 296, 186, 296, 206, 350, 206, 470 },
      APRON),
    p.line({ 132, 290, 124, 276, 118, 266 }, 5), p.line({ 128, 296, 118, 380, 108, 440 }, 4),
    p.form({ 138, 272, 118, 236, 118, 190, 150, 160, 188, 164, 206, 188, 210, 204, 230, 222, 218,
      230, 212, 250, 180, 268 }, pencil.skin, 5),
    p.form({ 134, 214, 140, 236, 158, 240, 180, 232, 208, 236, 216, 252, 208, 288, 190, 312, 170,
      296, 146, 276, 132, 244 }, "#a7693a", 5), p.line({ 178, 250, 184, 272, 190, 292 }, 3),
    p.wash({ 112, 222, 104, 196, 118, 170, 130, 180, 128, 214 }, "#a7693a"),
    p.line({ 184, 206, 193, 211, 203, 206 }, 4.5), p.line({ 180, 192, 192, 186, 204, 192 }, 5),
    p.line({ 186, 238, 200, 240, 214, 238 }, 3.5), p.line({ 144, 200, 152, 194, 158, 204, 150,
      216 }, 4),
    circle { 186, 222, 8, fill = pencil.blush } }
    :translate(9.375 / 600 * 450 * 1.5 * lean, 4.6875 * lean)
  local hands = circle { nx, ny, 15, fill = pencil.skin } | circle { fx, fy, 13,
    fill = pencil.skin }
  return far | body, near | hands
end

local function plane(x)
  return (still.form({ -52, 384, -52, 384, -54, 366, -54, 366, 54, 366, 54, 366, 58, 384, 58, 384 },
    "#5f4330", 4) | rect { -8, 352, 12, 18, fill = pencil.ink }):translate(x, 0)
end

--- Where the plane is; turns of the shaving; where it is, if it has gone.
local poses = { { 200, 0.3 }, { 212, 0.4 }, { 234, 0.7 }, { 262, 1 }, { 290, 1.3 }, { 314, 1.6 },
  { 334, 1.9 }, { 346, 2.1 }, { 350, 2.2, 352, 318 }, { 300, 2.2, 380, 330 },
  { 236, 2.2, 392, 470 }, { 204, 2.2, 392, 610 } }

return window.film { title = "The shaving", by = "pw", seconds = 2, drawing = function(_, number)
  local n = number // 2
  local at = poses[(n + 6) % 12 + 1]
  local body, hands = man(pencil.hand(n % 4 > 1), at[1])
  local shaving = at[2] and curl(at[2]):translate(at[3] or at[1], at[4] or 352)
  return { room, body, bench, plane(at[1]), hands, shaving }
end }
