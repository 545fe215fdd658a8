-- Rectangles at fractional places, a slope, a circle: exact means over the pixels.
local celspan = require "celspan"
return celspan.film { size = { 24, 6 }, frame = function()
  return celspan.rostrum { celspan.cel {
    celspan.rect { 0.5, 0.25, 5.25, 4.5, texture = "#fff" },
    celspan.triangle { { 7, 0.5 }, { 14, 2 }, { 8.5, 5.75 }, texture = "#f00" },
    celspan.circle { centre = { 19, 3 }, radius = 2.5, texture = "#00ff0080" },
  } }
end }
