local floor = polygon { { 0, 360 }, { 0, 262 }, { 640, 262 }, { 640, 360 },
  fill = "#a8836a" }
local wall = rect { 0, 0, 640, 262, fill = "#7d8a9c" }
local pane = rect { 0, 0, 34, 44, radius = 3, fill = "#cfe2ff" }
local window = union {
  pane,
  pane:translate(42, 0),
  pane:translate(0, 52),
  pane:translate(42, 52) }

local function bottle(x, colour)
  return path {
    fill = colour,
    d = "M-11 0 C-14 -40 -26 -52 -26 -88 L-26 -150 Q-26 -160 -16 -160 L16 -160"
      .. " Q26 -160 26 -150 L26 -88 C26 -52 14 -40 11 0 Z" }
    :scale(1, -1)
    :translate(x, 150)
end

return { floor = floor, wall = wall, window = window, bottle = bottle }
