-- A weaver: the shuttle flies, her eyes follow it, and the cloth shows the town.
local pencil, window = require "town.pencil", require "town.window"

local WOOD, NIGHT, SNOW, PANE = "#a9743c", "#3d5560", "#f3f0e6", "#f2b84a"
local still = pencil.hand()

local wall = union { rect { 0, 0, 450, 600, fill = "#dcc798" },
  path { fill = "#f3e5bf", d = "M60 130Q225 60 390 130L420 400H30Z" } }

--- The cloth: rows of houses with snow on their roofs, 60 high; it moves down with each beat.
local function cloth(down)
  local list = { rect { 66, 390, 318, 220, fill = "#93aeb8" } }
  for row = -1, 3 do
    for i = 0, 3 do
      local x, y = 72 + 79 * i, 400 + 60 * row + down
      local high = ({ 0, 9, 3, 12 })[i + 1]
      list[#list + 1] = polygon { { x, y + 54 }, { x, y + 24 - high }, { x + 34, y + 4 - high },
        { x + 68, y + 24 - high }, { x + 68, y + 54 }, fill = NIGHT }
      list[#list + 1] = polygon { { x - 4, y + 24 - high }, { x + 34, y - 2 - high }, { x + 72,
        y + 24 - high }, { x + 34, y + 11 - high }, fill = SNOW }
      list[#list + 1] = rect { x + 12, y + 28, 14, 15, fill = PANE }
      list[#list + 1] = rect { x + 42, y + 28, 14, 15, fill = PANE }
    end
  end
  return clip(union(list), rect { 66, 392, 318, 210 })
end
local cloths = { cloth(0), cloth(30) }

local loom = { still.form({ 34, 620, 34, 620, 36, 140, 36, 140, 62, 140, 62, 140, 64, 620, 64,
  620 }, WOOD, 5),
  still.form({ 386, 620, 386, 620, 388, 140, 388, 140, 414, 140, 414, 140, 416, 620, 416, 620 },
    WOOD, 5),
  still.form({ 24, 176, 24, 176, 24, 152, 24, 152, 424, 150, 424, 150, 426, 174, 426, 174 }, WOOD,
    5) }
for i = 0, 13 do loom[#loom + 1] = rect { 80 + 22 * i, 178, 2.5, 214, fill = "#fffaf0" } end
loom = union(loom)

--- The weaver behind her loom; look: where her eyes are, -1 to 1.
local function weaver(p, look)
  local e = 9 * look
  return union { p.wash({ 120, 400, 126, 330, 160, 300, 225, 292, 290, 300, 324, 330, 330, 400 },
    pencil.red),
    p.line({ 118, 396, 126, 330, 160, 302 }, 6),
    p.form({ 196, 310, 172, 276, 170, 236, 196, 206, 225, 200, 256, 208, 280, 238, 276, 280, 252,
      310 },
      pencil.skin, 5),
    p.form({ 166, 262, 158, 214, 190, 184, 225, 180, 262, 186, 292, 216, 284, 262, 268, 226, 225,
      214, 184, 228 }, "#4b3a36", 5.5), p.dot(204 + e, 254, 5), p.dot(246 + e, 254, 5),
    p.line({ 225 + e / 2, 258, 230 + e / 2, 270, 223 + e / 2, 273 }, 3.5),
    p.line({ 208, 288, 225, 294, 242, 287 }, 4.5), circle { 190, 276, 9, fill = pencil.blush },
    circle { 262, 276, 9, fill = pencil.blush } }
end

local comb = still.form({ 56, 378, 56, 378, 56, 366, 56, 366, 394, 364, 394, 364, 394, 378, 394,
  378 },
  "#7d5230", 4.5)
local shuttle = still.form({ -44, 0, -44, 0, -14, -13, 14, -13, 44, 0, 44, 0, 14, 11, -14, 11 },
  "#e0a844", 4.5)

--- Where the shuttle is: it flies to the right, a beat, to the left, a beat.
local way = { 82, 130, 225, 320, 368, 368, 368, 320, 225, 130, 82, 82 }

return window.film { title = "The weaver", by = "pw", seconds = 2, drawing = function(_, number)
  local n = number // 2
  local x = way[n + 1]
  local beat = n == 5 or n == 11
  return { wall, weaver(pencil.hand(), x < 120 and -1 or x > 330 and 1 or 0), loom,
    cloths[n > 5 and 2 or 1], shuttle:translate(x, 388), comb:translate(0, beat and 18.75 or 0) }
end }
