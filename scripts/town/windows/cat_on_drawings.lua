-- The animator's other room: her cat sleeps on the drawings, the pencil rolls to the edge and back.
local pencil, window = require "town.pencil", require "town.window"

local FUR, STRIPE = "#d98f4a", "#a9642c"
local still = pencil.hand()

local function page(x, y, turn)
  return (still.form({ -110, -70, -110, -70, 110, -70, 110, -70, 110, 70, 110, 70, -110, 70, -110,
    70 },
    "#fffaf0", 3.5) | still.line({ -84, -20, -60, -46, -36, -22, -36, 10 }, 3)
    | still.line({ 30, 30, 56, 0, 80, 28, 80, 52 }, 3)):rotate(turn):translate(x, y)
end

local room = union { rect { 0, 0, 450, 600, fill = "#cdb98d" },
  path { fill = "#f1dfb3", d = "M260 196L150 420H450V196Z" },
  still.line({ 430, 330, 440, 250, 380, 180, 320, 176 }, 7),
  still.form({ 262, 200, 262, 200, 276, 160, 310, 150, 344, 164, 356, 200, 356, 200 }, "#4f7f80",
    6),
  rect { 0, 400, 450, 210, fill = "#8d6548" }, still.line({ 10, 400, 220, 396, 440, 401 }, 6),
  page(130, 470, -7), page(300, 486, 5), page(214, 466, -1) }

--- The cat, curled up; breath: how high its back is; ear: whether it turns; eye: whether one is
--- open.
local function cat(p, breath, ear, eye)
  local b = 6 * breath
  return union { p.form({ 92, 476, 76, 420, 100, 350 - b, 176, 318 - b, 262, 326 - b, 322, 372, 336,
    440, 310, 482, 220, 498, 130, 494 }, FUR, 7),
    p.line({ 168, 322 - b, 180, 352, 176, 378 }, 9, STRIPE),
    p.line({ 214, 318 - b, 224, 350, 220, 380 }, 9, STRIPE),
    p.line({ 258, 326 - b, 266, 354, 262, 384 }, 9, STRIPE),
    p.line({ 320, 470, 250, 500, 180, 496, 150, 478 }, 30), p.line({ 320, 470, 250, 500, 180, 496,
      152, 479 }, 22, FUR),
    p.form({ 76, 460, 58, 432, 68, 398, 66, 364, 66, 364, 88, 384, 112, 384, 112, 384,
      ear and 142 or 136,
      ear and 378 or 362, ear and 142 or 136, ear and 378 or 362, 140, 398, 150, 430, 130, 462, 104,
      472 }, FUR, 6),
    p.line({ 82, 426, 90, 432, 98, 426 }, 4.5), eye and p.dot(126, 424, 5) or
      p.line({ 118, 426, 126, 432, 134, 426 }, 4.5),
    p.line({ 102, 442, 108, 447, 114, 442 }, 4), p.line({ 72, 440, 52, 436 }, 2.5),
    p.line({ 72, 446, 54, 450 }, 2.5) }
end

--- Where the pencil is, drawing by drawing: to the edge of the table, and back.
local roll = { 0, 1, 2, 3, 4, 5, 6, 6, 6, 5, 4, 3, 2, 1, 0, 0 }

return window.film { title = "Asleep", by = "pw", seconds = 4, drawing = function(_, number)
  local n = number // 3
  local at, p = roll[n + 1], pencil.hand()
  local rolling = rect { 60, -5, 120, 11, radius = 3, fill = pencil.red } | rect { 60,
    at % 2 * 3 - 4, 120, 3,
    fill = "#8d281f" } | polygon { { 60, -5 }, { 60, 6 }, { 42, 0.5 }, fill = "#f0c39c" }
  local breath = ({ 0, 0.5, 1, 1, 0.5, 0, 0, 0 })[n % 8 + 1]
  return { room, cat(p, breath, at > 4, at == 6),
    rolling:translate(18.75 * at + 70, 520 + 4.6875 * at) }
end }
