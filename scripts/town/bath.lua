-- A bathroom in pencil and wash: tiles, a tub with feet, its tap and water, steam, and a duck.
local pencil = require "town.pencil"
local fog = require("stage.moods").fog

local bath = {}
local still = pencil.hand()

--- Wall, tap, and the far rim with the water behind which nothing is hidden.
bath.room = union { rect { 0, 0, 450, 600, fill = fog.sky[2] },
  rect { 0, 410, 450, 190, fill = fog.sky[1] }, rect { 0, 404, 450, 8, fill = fog.near },
  still.line({ 60, 440, 62, 520 }, 2.5, fog.near), still.line({ 400, 430, 402, 520 }, 2.5,
    fog.near),
  still.wash({ -10, 548, -10, 548, 470, 548, 470, 548, 470, 620, 470, 620, -10, 620, -10, 620 },
    "#8fa3a1"),
  still.wash({ 34, 342, 90, 326, 230, 322, 370, 326, 416, 342, 370, 358, 230, 362, 90, 358 },
    "#b9d3d6"), still.line({ 30, 340, 90, 325, 230, 320, 370, 324, 420, 340 }, 5) }

bath.tap = still.form({ 440, 226, 400, 222, 376, 232, 368, 262, 368, 262, 388, 266, 388, 266, 394,
  250, 440, 250 }, "#7c8c8a", 5) | still.line({ 412, 222, 412, 204 }, 7)
  | still.line({ 396, 202, 428, 200 }, 8)

--- The near side of the tub, its feet, and foam on it.
bath.tub = union { still.form({ 30, 342, 30, 342, 34, 420, 70, 486, 130, 504, 230, 508, 330, 504,
  384, 484, 412, 420, 420, 342, 420, 342, 370, 358, 230, 364, 90, 358 }, fog.light, 7),
  still.line({ 30, 343, 90, 360, 230, 366, 370, 360, 420, 342 }, 8),
  still.line({ 356, 400, 350, 450, 320, 478 }, 4, fog.near),
  still.form({ 92, 500, 78, 530, 96, 552, 118, 546, 120, 504 }, "#b98a4c", 5),
  still.form({ 336, 504, 334, 546, 360, 552, 374, 530, 358, 498 }, "#b98a4c", 5) }

--- Foam: bubbles at x, y, radius.
function bath.foam(list)
  local all = {}
  for i = 1, #list, 3 do
    all[#all + 1] = circle { list[i], list[i + 1], list[i + 2], fill = "#fffdf6" }
    all[#all + 1] = still.line({ list[i] - list[i + 2] * 0.6, list[i + 1] - list[i + 2] * 0.5,
      list[i], list[i + 1] - list[i + 2] * 0.8, list[i] + list[i + 2] * 0.6,
      list[i + 1] - list[i + 2] * 0.5 }, 3, fog.near)
  end
  return union(all)
end

--- Three curls of steam, in one of two places.
function bath.steam(n)
  local list = {}
  for i = 0, 2 do
    local x, y, s = 200 + 62 * i, 236 - 26 * ((i + n) % 2), (i + n) % 2 * 2 - 1
    list[i + 1] = still.line({ x, y, x + 14 * s, y - 30, x - 12 * s, y - 62, x + 8 * s, y - 96 }, 9,
      fog.light)
  end
  return union(list)
end

--- The duck, its foot at 0, 0; it looks to the left.
bath.duck = union { still.form({ -26, -22, -12, -26, 10, -24, 34, -38, 32, -10, 18, 2, -14, 2, -28,
    -8 }, "#f2c23e", 4.5), still.form({ -28, -22, -36, -40, -24, -58, -4, -56, 4, -40, -4, -24 },
    "#f2c23e", 4.5), still.form({ -34, -42, -34, -42, -50, -36, -34, -32, -34, -32 }, "#c8553d",
      3.5),
  circle { -19, -44, 3.5 }, still.line({ 2, -16, 14, -10, 26, -20 }, 3.5) }

return bath
