-- Figure 15(c): pictures of two sources and geometry, each lit so that they match. The square is
-- the area of figure 15(d).
--   celspan render scripts/paper/figure15c.lua --allow scripts -o c.png -- frame.dpx view.jpg
local scene = require "scene15c"

local frame, view = ...
local cels = scene.cels(frame, view)
cels[#cels + 1] = cel {
  rect { table.unpack(scene.close_up) }:stroke { width = 2.5, fill = "#000000" } }

return film { title = "Figure 15(c)", size = { 960, 720 }, frames = 1,
  frame = function() return rostrum(cels) end }
