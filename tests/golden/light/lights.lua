-- Front and back lights, a matte below 1, brightness; lights beyond 1.
local celspan = require "celspan"
return celspan.film { size = { 16, 6 }, frame = function()
  return celspan.rostrum { antialias = "none", brightness = 0.5, front = { 1, 1, 0.5 },
    back = { 0.25, 0.5, 1, 0.5 },
    celspan.cel { celspan.rect { 1, 1, 8, 4, texture = "#ffffff80" } },
    celspan.cel { celspan.rect { 5, 2, 8, 3, texture = celspan.rgb(1, 0.5, 0.25, 0.75) },
      front = { 2, 0, 4 },
                  back = { 0.125, 0, 0, 0 } } }
end }
