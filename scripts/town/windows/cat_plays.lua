-- The pianist sleeps on the keys, and the cat plays.
local pencil, window, piano = require "town.pencil", require "town.window", require "town.piano"

local COAT, HAIR, FUR = "#4d6c78", "#3a2c27", pencil.ink

local function sleeper(p, breath)
  return union { p.form({ 60, 620, 66, 500, 70, 430, 104, 386, 160, 372, 220, 386, 252, 440, 256,
    520, 262, 620 }, COAT, 6.5), p.line({ 152, 392, 158, 460, 156, 540 }, 4) }
    :translate(0, 4.6875 * breath)
    | p.form({ 76, 396, 58, 366, 66, 328, 100, 308, 142, 312, 168, 336, 172, 372, 150, 398, 110,
      404 },
      HAIR, 6) | circle { 160, 376, 11, fill = pencil.skin }
    | p.form({ 166, 350, 186, 350, 196, 362, 206, 374, 194, 380, 184, 392, 166, 394 }, pencil.skin,
      4)
    | p.line({ 180, 366, 185, 370, 191, 367 }, 4)
end

--- The cat that sits on the keys; paws: how high its two paws are.
local function cat(p, n)
  local one, two = n % 2 * 26, (n + 1) % 2 * 26
  return union { p.wash({ 400, 384, 410, 330, 392, 290, 356, 282, 330, 300, 330, 350, 344, 384 },
    FUR),
    p.line({ 398, 372, 430, 380, 428, 430, 414, 460, 424, 482 }, 16, FUR),
    p.line({ 344, 312, 316, 330, 300, 374 - one }, 17, FUR, true),
    p.line({ 352, 320, 338, 344, 334, 374 - two }, 17, FUR, true),
    union { p.wash({ 318, 296, 292, 284, 284, 258, 292, 236, 290, 210, 290, 210, 310, 226, 330, 226,
      330, 226, 350, 212, 350, 212, 352, 240, 356, 270, 344, 292 }, FUR),
      p.line({ 300, 256, 306, 262, 313, 256 }, 4, "#f2c84b"),
      p.line({ 328, 256, 334, 262, 341, 256 }, 4, "#f2c84b"),
      p.line({ 308, 298, 326, 306, 346, 296 }, 8, pencil.red) }
      :translate(n % 4 < 2 and 0 or -7.03125, n % 2 * 4.6875) }
end

local function snore(p, n)
  local list = {}
  for i = 0, 2 do
    local s, x, y = 10 + 6 * i, 90 - 14 * i, 280 - 34 * i - 9.375 * (n % 3)
    list[i + 1] = p.line({ x, y, x, y, x + s, y - 1, x + s, y - 1, x, y + s, x, y + s, x + s,
      y + s }, 5)
  end
  return union(list)
end

return window.film { title = "The cat plays", by = "pw", seconds = 2, drawing = function(_, number)
  local n, p = number // 3, pencil.hand()
  return { piano.room, snore(p, n // 2), cat(p, n), sleeper(p, n // 4) }
end }
