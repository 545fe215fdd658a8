-- Edges on pixel centres: left and top are in, right and bottom out; neighbours tile.
local celspan = require "celspan"
return celspan.film { size = { 8, 6 }, frame = function()
  return celspan.rostrum { antialias = "none", celspan.cel {
    celspan.rect { 0.5, 0.5, 3, 2, texture = "#f00" },
    celspan.rect { 3.5, 0.5, 3, 2, texture = "#0f0" },
    celspan.triangle { { 0.5, 2.5 }, { 6.5, 2.5 }, { 0.5, 5.5 }, texture = "#00f" },
    celspan.triangle { { 6.5, 2.5 }, { 6.5, 5.5 }, { 0.5, 5.5 }, texture = "#ff0" },
  } }
end }
