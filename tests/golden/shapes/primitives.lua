-- One of each, under pixel centres; the union keeps all of them visible.
local celspan = require "celspan"
return celspan.film { size = { 32, 12 }, frame = function()
  return celspan.rostrum { antialias = "none", celspan.cel {
    celspan.rect { 1, 1, 6, 4, radius = 1.5, texture = "#f00" },
    celspan.triangle { { 9, 1 }, { 15, 2 }, { 10, 6 }, texture = "#0f0" },
    celspan.circle { centre = { 19, 4 }, radius = 3, texture = "#00f" },
    celspan.ellipse { centre = { 27, 4 }, radii = { 4, 2 }, texture = "#ff0" },
    celspan.path { d = "M2 7 h6 a2 2 0 0 1 0 4 h-6 z M4 8 v2 h2 v-2 z", texture = "#0ff" },
    celspan.nurbs { points = { { 12, 6 }, { 18, 7, 3 }, { 17, 12 }, { 11, 12 } },
      texture = "#f0f" },
    celspan.nurbs { points = { { 22, 11 }, { 23, 5 }, { 29, 6 }, { 30, 11 } }, closed = "clamped",
                    knots = { 0, 0, 0, 0, 1, 1, 1, 1 }, texture = "#888" },
  } }
end }
