-- Figure 15(d): the square of figure 15(c), rendered again eight times as large. The outline of the
-- clover stays sharp; the pictures show their pixels. Takes the same files as 15(c).
local scene = require "scene15c"

local frame, view = ...
local cels = scene.cels(frame, view, "nearest")
local x, y, w, h = table.unpack(scene.close_up)

return film { title = "Figure 15(d)", size = { 960, 720 }, frames = 1, frame = function()
  cels.camera = { centre = { x + w / 2, y + h / 2 }, width = w }
  return rostrum(cels)
end }
