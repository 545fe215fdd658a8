-- The camera turns by a quarter and zooms; all cels with it.
local celspan = require "celspan"
return celspan.film { size = { 16, 12 }, frame = function()
  return celspan.rostrum { antialias = "none",
    camera = { centre = { 8, 6 }, width = 20, rotate = 90 },
    celspan.cel { celspan.rect { 4, 4, 8, 2, texture = "#f00" } },
    celspan.cel { celspan.triangle { { 5, 3.1 }, { 11, 6.2 }, { 5, 9.3 },
      texture = "#0000ff88" } } }
end }
