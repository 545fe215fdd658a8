-- A deep tree, faded, with a hole that shows the cel behind.
local celspan = require "celspan"
local ring = celspan.circle { centre = { 10, 8 }, radius = 7, texture = "#0a0" }
  - celspan.circle { centre = { 10, 8 }, radius = 3 }
local bars = celspan.rect { 0, 6, 20, 2, texture = "#a00" }
  ~ celspan.rect { 9, 0, 2, 16, texture = "#00a" }
return celspan.film { size = { 20, 16 }, frame = function()
  return celspan.rostrum { antialias = "none", back = "#fff",
    celspan.cel { celspan.rect { 4, 4, 12, 8, texture = "#fc0" } },
    celspan.cel { ((ring | bars) & celspan.rect { 1, 1, 18, 13 }):fade(0.5) } }
end }
