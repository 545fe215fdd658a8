-- A rocking chair, a candle, nobody; it rocks a little less, and a little more again.
local pencil, window = require "town.pencil", require "town.window"

local WOOD = "#7a4c33"
local still = pencil.hand()

local room = union { rect { 0, 0, 450, 600, fill = "#c3ad82" },
  path { fill = "#efdfb4", d = "M360 250C250 190 90 260 70 420L60 540L450 560L450 240Z" },
  still.wash({ -10, 528, -10, 528, 470, 524, 470, 524, 470, 620, 470, 620, -10, 620, -10, 620 },
    "#8d7350"), still.line({ 10, 528, 220, 524, 440, 528 }, 5),
  still.form({ 318, 392, 318, 392, 430, 390, 430, 390, 430, 404, 430, 404, 318, 404, 318, 404 },
    WOOD,
    5), still.line({ 336, 406, 340, 470, 326, 530 }, 8), still.line({ 420, 406, 416, 470, 430,
      530 }, 8),
  still.form({ 362, 390, 362, 390, 362, 310, 362, 310, 388, 310, 388, 310, 388, 390, 388, 390 },
    "#fffaf0", 4.5), still.form({ 342, 388, 350, 378, 400, 378, 408, 388 }, "#b98a4c", 4) }

--- The flame, that leans with the air of the chair.
local function flame(lean)
  return still.wash({ 374 + lean, 254, 374 + lean, 254, 388, 288, 384, 304, 370, 306, 362, 294, 366,
    280 },
    "#f2b23c") | still.wash({ 374 + lean / 2, 276, 374 + lean / 2, 276, 380, 292, 374, 302, 368,
      294 },
    "#fff3cf")
end

--- The chair, upright; it rocks about 190, 300, with a red blanket.
local chair = union { still.line({ 70, 506, 130, 534, 200, 542, 270, 534, 330, 500 }, 13, WOOD),
  still.line({ 104, 524, 118, 440, 130, 402 }, 11, WOOD),
  still.line({ 282, 528, 268, 460, 262, 402 }, 11, WOOD),
  still.form({ 118, 398, 118, 398, 280, 392, 280, 392, 282, 412, 282, 412, 120, 416, 120, 416 },
    WOOD, 6),
  still.line({ 128, 402, 106, 300, 92, 196, 80, 168 }, 13, WOOD),
  still.line({ 100, 334, 180, 330, 252, 338, 264, 352, 262, 396 }, 10, WOOD),
  still.form({ 76, 206, 76, 206, 86, 160, 104, 158, 124, 206, 152, 320, 160, 400, 134, 388, 108,
    402, 104, 330 }, pencil.red, 5.5) }

--- How far it leans, in drawings that are two frames long: less, and more again.
local swing = { [0] = 0, 3, 6, 6, 3, 0, -3, -6, -6, -3, 0, 3, 3, 3, 0, -3, -3, -3, 0, 0, 3, 3, 0, 0,
  0, 0, 0, 3, 3, 0, 0, -3, -3, -3, 0, 3, 6, 6, 3, 0, -3, -6, -6, -3, 0, 3, 3, 0 }

return window.film { title = "Nobody", by = "pw", seconds = 8, drawing = function(_, number)
  local angle = swing[number // 2]
  return { room, flame(-4 * angle), chair:rotate(2 * angle, 200, 330):translate(1.5 * angle, 0) }
end }
