-- A wall is painted: the horse walks ahead of the brush; when the wall is yellow again, it is back.
local pencil, window = require "town.pencil", require "town.window"

local YELLOW, WHITE, CLOTHES = "#ecc877", "#fbf4e2", "#5f7f8c"
local still = pencil.hand()

local floor = union { rect { 0, 510, 450, 16, fill = "#b89766" },
  rect { 0, 526, 450, 80, fill = "#8d7350" }, still.line({ 10, 510, 220, 513, 440, 509 }, 5) }

--- The horse of one line and four legs, its feet at 0, 0; it walks to the right.
local function horse(n)
  local s = n % 2 * 2 - 1
  local function line(p) return still.line(p, 7, pencil.red, true) end
  return union { line { 60, -100, 84, -140, 102, -196, 110, -218, 110, -218, 118, -194, 138, -170,
    156, -150, 148, -136, 124, -140, 106, -120, 96, -84, 88, -66, 30, -70, -40, -70, -70, -76, -82,
      -104, -64, -128, -20, -130, 30, -124, 70, -128 }, line { -78, -118, -100, -96, -96, -52 },
    line { 84, -70, 84 + 14 * s, -36, 84 + 10 * s, 0, 84 + 18 * s, 0 },
    line { 60, -70, 60 - 14 * s, -36, 60 - 22 * s, -4, 60 - 12 * s, -4 },
    line { -68, -78, -64 - 14 * s, -36, -70 - 22 * s, 0, -60 - 22 * s, 0 },
    line { -42, -70, -42 + 14 * s, -36, -46 + 20 * s, -4, -34 + 20 * s, -4 },
    circle { 118, -170, 5, fill = pencil.red } }
end

--- The painter, who rolls from the left to the right, his feet at 0, 560.
local function painter(n, colour)
  local s = n % 2 * 2 - 1
  local arm, hx, hy = still.limb(20, 330, { 92, 300 - 50 * s }, 74, 1, { 42, 28 }, "#fffdf4")
  return union { still.line({ -10, 440, -10 - 18 * s, 510, -14 - 34 * s, 566 }, 42, CLOTHES, true),
    still.line({ 12, 440, 12 + 18 * s, 510, 8 + 34 * s, 566 }, 42, CLOTHES, true),
    still.form({ -46, 460, -44, 380, -40, 320, -10, 296, 26, 302, 42, 340, 38, 460 }, CLOTHES, 6),
    still.form({ -20, 300, -32, 260, -22, 228, 10, 218, 36, 230, 40, 250, 54, 262, 42, 268, 36, 290,
      10, 302 }, pencil.skin, 5),
    still.form({ -40, 238, -40, 238, -24, 204, 4, 190, 40, 204, 48, 232, 48, 232 }, "#fffdf4", 5),
    still.dot(30, 252, 4), still.line({ 22, 282, 31, 284, 38, 280 }, 3.5),
    still.line({ hx, hy, hx + 24, hy - 6, hx + 40, hy - 14 }, 6),
    rect { hx + 34, hy - 50, 20, 72, radius = 8, fill = colour }, arm,
    circle { hx, hy, 15, fill = pencil.skin } }
end

return window.film { title = "White", by = "pw", seconds = 4, drawing = function(_, number)
  local drawing = (number // 3 + 4) % 16
  local n, white = drawing % 8, drawing < 8
  local x = 84.375 * (n - 1.5)
  local ahead = white and math.max(x + 225, 300) or math.min(x - 225, 300)
  local step = (ahead == 300) and 0 or n
  return { rect { 0, 0, 450, 600, fill = white and YELLOW or WHITE },
    rect { -10, 0, math.max(1, x + 132), 512, fill = white and WHITE or YELLOW }, floor,
    horse(step):translate(ahead, 506), painter(n, white and WHITE or YELLOW):translate(x, 0) }
end }
