-- The "filmed" leap of docs/cookbook.md: eight pictures that are used in place of those of a
-- camera.
--
--   CELSPAN_PATH='scripts/?.lua' celspan render scripts/pictures/leap.lua --size 320x180 \
--     -o scripts/pictures/leap.####.jpg
local dance = require "stage.dance"

local wall = linear { from = { 0, 0 }, to = { 480, 220 }, { 0, "#a3a098" }, { 0.5, "#8f8d86" },
  { 1, "#5d5d5b" } }
local room = cel { rect { 0, 0, 480, 270, fill = wall }, rect { 0, 216, 480, 4, fill = "#6a6864" },
  rect { 0, 220, 480, 50, fill = linear { from = { 0, 220 }, to = { 0, 270 }, { 0, "#77746d" },
    { 1, "#565450" } } },
  rect { 60, 130, 420, 5, fill = "#5c5a55" }, rect { 96, 130, 5, 88, fill = "#5c5a55" },
  rect { 372, 130, 5, 88, fill = "#5c5a55" } }
local heights = { 0, 0, 6, 40, 62, 38, 0, 0 }

return film { size = { 480, 270 }, frames = 8, fps = 12, frame = function(f)
  local wide = 62 - 0.5 * heights[f.number]
  return { room,
    cel { ellipse { 240, 244, wide, 6, fill = "#2c2a28" }, defocus = 4, opacity = 0.6 },
    cel { dance.filmed[f.number]:translate(240, 0), defocus = 1.4 } }
end }
