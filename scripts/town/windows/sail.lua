-- A sailor sews a yellow sail that fills the room; a gust lifts it, and him.
local pencil, window = require "town.pencil", require "town.window"
local mood = require("stage.moods").noon

local SAIL, SHADE, IRON = "#f2c23e", "#d89f2c", "#2b3338"
local still = pencil.hand()

local room = union { rect { 0, 0, 450, 600, fill = mood.sky[3] },
  rect { 0, 520, 450, 90, fill = mood.far }, still.line({ 10, 521, 220, 518, 440, 522 }, 5),
  circle { 276, 214, 46, fill = mood.sky[1] }, circle { 276, 214, 35, fill = mood.sky[2] },
  still.line({ 244, 224, 262, 216, 284, 228, 308, 218 }, 5, "#fffbe8") }

local bench = union { still.wash({ 214, 436, 214, 436, 330, 436, 330, 436, 330, 454, 330, 454, 214,
  454, 214, 454 }, "#a9743c"), still.line({ 208, 437, 270, 434, 336, 437 }, 6),
  still.line({ 230, 456, 232, 500, 220, 566 }, 9, IRON), still.line({ 316, 456, 314, 500, 326,
    566 }, 9, IRON),
  still.form({ 222, 434, 222, 434, 222, 424, 300, 422, 304, 400, 304, 372, 290, 362, 258, 364, 254,
    384, 244, 384, 240, 352, 254, 342, 304, 340, 326, 354, 328, 384, 328, 434, 328, 434 }, IRON,
      4) }

--- The sail in four shapes: on the floor, raised, full, and up at the ceiling.
local sails = {
  { 250, 436, 290, 424, 350, 430, 400, 400, 450, 396, 470, 460, 470, 620, 220, 620, 230, 540, 300,
    500 },
  { 250, 432, 284, 400, 320, 340, 390, 300, 460, 310, 480, 420, 470, 620, 240, 620, 250, 560, 290,
    500 },
  { 250, 430, 262, 330, 300, 230, 380, 170, 460, 176, 490, 360, 470, 620, 270, 620, 280, 560, 290,
    500 },
  { 240, 420, 236, 290, 274, 170, 370, 110, 470, 120, 500, 320, 470, 610, 300, 620, 290, 560, 284,
    490 } }
local folds = { { 270, 440, 340, 460, 380, 540, 370, 590 }, { 280, 420, 340, 400, 400, 440, 400,
  560 },
  { 274, 400, 320, 320, 390, 340, 420, 500 }, { 256, 390, 296, 270, 380, 250, 430, 420 } }

local function sail(p, n)
  return p.form(sails[n], SAIL, 7) | p.line(folds[n], 6, SHADE)
end

local function sailor(p, hand, up, cap)
  local arm, hx, hy = p.limb(118, 326, hand, 92, 1, { 48, 30 }, "#f5f1e4")
  local list = { p.wash({ 58, 520, 62, 606, 62, 606, 128, 606, 128, 606, 124, 560, 138, 606, 138,
    606, 212, 606, 212, 606, 196, 510 }, mood.ink), p.form({ 44, 540, 44, 480, 52, 370, 80, 306,
      120, 284, 162, 292, 190, 336, 198, 430, 206, 540 }, "#f5f1e4", 6.5) }
  for i = 0, 3 do
    local y = 346 + 48 * i
    list[#list + 1] = p.line({ 56 - 3 * i, y + 8, 120, y + 14, 188 + 4 * i, y + 4 }, 13,
      mood.sky[1])
  end
  list[#list + 1] = union { p.form({ 118, 292, 104, 250, 110, 196, 150, 178, 184, 188, 192, 212,
    210, 230, 198, 238, 194, 260, 170, 278, 148, 290 }, pencil.skin, 5),
    p.form({ 130, 236, 138, 262, 160, 268, 184, 262, 192, 262, 184, 284, 158, 300, 134, 282, 122,
      256 },
      "#b8612c", 5),
    up > 0 and circle { 178, 218, 8, fill = "#fffdf6" } | circle { 180, 218, 4.5 } or
      p.line({ 170, 218, 178, 223, 187, 218 }, 4.5), p.line({ 130, 222, 138, 214, 144, 226, 136,
        236 }, 4) }
  list[#list + 1] = p.form({ 100, 204, 96, 180, 106, 158, 150, 148, 190, 160, 200, 184, 196, 200,
    150, 190 },
    "#fffdf6", 5.5):translate(0, -28.125 * cap)
  list[#list + 1] = arm
  list[#list + 1] = circle { hx, hy, 15, fill = pencil.skin }
  return union(list):translate(0, -37.5 * up)
end

--- The shape of the sail, the hand, how high he is, and his cap.
local poses = { a = { 1, { 238, 420 }, 0, 0 }, b = { 1, { 246, 428 }, 0, 0 }, c = { 2, { 244, 414 },
  0, 0 },
  d = { 3, { 252, 420 }, 0.5, 0.5 }, e = { 4, { 246, 390 }, 1.5, 1.5 }, f = { 4, { 246, 390 }, 2,
    2 },
  g = { 3, { 252, 420 }, 0.5, 2 }, h = { 2, { 244, 414 }, 0, 1 }, i = { 1, { 238, 420 }, 0, 0.25 } }

return window.film { title = "The sail", by = "pw", seconds = 4, drawing = function(_, number)
  local pose, p = pencil.exposed(poses, "deefefefgghhiabAbAbaBccd", 2, number)
  return { room, sail(p, pose[1]), bench, sailor(p, pose[2], pose[3], pose[4]) }
end }
