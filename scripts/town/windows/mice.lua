-- A mouse hole: two mice at a thimble; one drinks, the other waits, and then the other way round.
local pencil, window = require "town.pencil", require "town.window"

local FUR, EAR = "#a08c7c", "#e3a48e"
local still = pencil.hand()

local room = union { rect { 0, 0, 600, 600, fill = "#5a3420" },
  path { fill = "#f5d59a", d = "M40 620V330C40 150 160 60 300 60S560 150 560 330V620Z" },
  path { fill = "#fbe9c2", d = "M150 470A150 150 0 0 1 450 470Z" },
  still.line({ 44, 560, 40, 330, 90, 140, 300, 62, 510, 140, 560, 330, 556, 560 }, 10),
  rect { 0, 520, 600, 90, fill = "#8d5a38" },
  still.form({ 236, 530, 236, 530, 252, 430, 252, 430, 348, 430, 348, 430, 364, 530, 364, 530 },
    "#b9c3c4",
    6), still.line({ 246, 474, 300, 480, 354, 474 }, 4), still.line({ 242, 500, 300, 506, 358,
      500 }, 4),
  rect { 294, 396, 14, 34, fill = "#fffaf0" },
  still.wash({ 297, 350, 297, 350, 310, 376, 304, 392, 292, 392, 286, 378 }, "#f2a93c") }

--- A mouse at the left that looks to the right; up: whether it drinks; cup: whether it has one.
local function mouse(p, up)
  local y = up and -9.375 or 0
  return union { p.line({ 90, 520, 40, 500, 30, 440, 60, 420 }, 9),
    p.form({ 84, 540, 76, 460, 96, 390, 140, 370, 184, 400, 196, 470, 188, 540 }, FUR, 6),
    union { p.form({ 128, 280, 96, 268, 84, 300, 98, 330, 130, 334 }, EAR, 5.5),
      p.form({ 112, 384, 106, 336, 130, 300, 170, 296, 202, 320, 240, 352, 240, 352, 222, 372, 180,
        392, 140, 396 }, FUR, 6),
      p.form({ 166, 288, 142, 268, 122, 284, 128, 318, 156, 326, 172, 308 }, EAR, 5.5),
      circle { 240, 350, 8, fill = pencil.ink }, up and p.line({ 186, 338, 194, 344, 204, 338 },
        5) or
        p.dot(194, 338, 6), p.line({ 212, 364, 190, 384, 180, 384 }, 3) }:translate(0, y),
    p.form({ 214, up and 360 or 408, 214, up and 360 or 408, 218, up and 390 or 438, 246,
      up and 386 or 438, 250,
      up and 350 or 408, 250, up and 350 or 408 }, pencil.red, 5),
    p.line({ 150, 430, 186, 450, 218, up and 384 or 430 }, 17, FUR),
    p.line({ 146, 446, 186, 462, 220, up and 388 or 434 }, 4) }
end

return window.film { title = "The thimble", by = "pw", seconds = 8, size = { 600, 600 },
  pane = "round",
  drawing = function(_, number)
    local n = number // 8
    local one, other = n == 1 or n == 2 or n == 9, n == 5 or n == 6 or n == 9
    local p = pencil.hand(number // 4 % 2 == 1 and n % 4 == 0)
    return { room, mouse(p, one), mouse(p, other):scale(-1, 1):translate(600, 0) }
  end }
