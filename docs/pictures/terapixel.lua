-- One frame of a million pixels a side at three depths, for the gallery: the town, a window in it,
-- and a note on the wall behind the window. An argument names the folder with the three crops,
-- terapixel.1.png to terapixel.3.png.
local folder = ...
local WIDTH, HEIGHT, GAP = 208, 360, 8
local LIGHT = "#fff1cf"

--- Where each crop lies in the one before it: x, y, w, h.
local inside = { { 58.2, 234, 6, 10.5 }, { 106.7, 164.7, 6.5, 11.3 } }

local function strip(i)
  return image { file = ("%s/terapixel.%d.png"):format(folder, i), w = WIDTH, h = HEIGHT }
    :translate((i - 1) * (WIDTH + GAP), 0)
end

--- A frame around the next crop, and lines from it to the corners of that one.
local function wedge(i)
  local x, y, w, h = table.unpack(inside[i])
  local left = (i - 1) * (WIDTH + GAP)
  local right = left + WIDTH + GAP
  x = x + left
  local function line(from_y, to_y)
    return stroke { points = { { x + w, from_y }, { right, to_y } }, width = 1, fill = LIGHT }
  end
  local frame = rect { x - 3, y - 3, w + 6, h + 6 } - rect { x - 1.5, y - 1.5, w + 3, h + 3 }
  return union { line(y - 2, 0), line(y + h + 2, HEIGHT) }:fade(0.6) | frame:paint(LIGHT)
end

return film { size = { 3 * WIDTH + 2 * GAP, HEIGHT }, frames = 1, frame = function()
  return { cel { strip(1), strip(2), strip(3), wedge(1), wedge(2) }, back = "#2b1b2c" }
end }
