-- Three frames of scripts/relight.lua side by side, with the time of each. An argument names the
-- folder with the frames, relight.N.png.

local folder = ...
local WIDTH, HEIGHT, GAP = 320, 480, 12

local tiles = {}
for i, words in ipairs { "noon", "six", "nine" } do
  local x = (WIDTH + GAP) * i - WIDTH
  tiles[i] = image { file = ("%s/relight.%d.png"):format(folder, i), x = x, y = GAP, w = WIDTH,
    h = HEIGHT }
    | text { words, x + WIDTH / 2, HEIGHT + 36, font = "../../scripts/type/poster.ttf", size = 20,
      align = "centre", fill = "#33180f" }
end

return film { size = { 3 * WIDTH + 4 * GAP, HEIGHT + 50 }, frames = 1, background = "#f6ead2",
  frame = function() return cel(tiles) end }
