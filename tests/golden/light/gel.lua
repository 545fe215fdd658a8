-- Gels filter the cels behind them and one another; a paint with pigment and medium does both.
local celspan = require "celspan"
return celspan.film { size = { 16, 8 }, frame = function()
  return celspan.rostrum { antialias = "none", back = "#fff",
    celspan.cel { celspan.rect { 1, 1, 8, 5, texture = celspan.gel(1, 0.5, 0) },
                  celspan.rect { 4, 2, 8, 5, texture = celspan.gel(0, 0.5, 1) } },
    celspan.cel {
      celspan.rect { 7, 3, 8, 2,
        texture = celspan.paint { pigment = { 1, 0, 0 }, medium = { 0, 1, 0 },
                                                                       beta = 0.5 } } } }
end }
