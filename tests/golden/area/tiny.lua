-- Many shapes inside single pixels, and crossings inside one.
local celspan = require "celspan"
return celspan.film { size = { 6, 3 }, frame = function()
  local dots = {}
  for i = 0, 7 do
    dots[i + 1] = celspan.rect { 1 + i / 8, 1 + i / 16, 1 / 16, 1 / 8, texture = "#fff" }
  end
  dots[#dots + 1] = celspan.polygon { { 3, 1 }, { 4, 2 }, { 4, 1 }, { 3, 2 }, texture = "#f00" }
  dots[#dots + 1] = celspan.triangle { { 5, 1 }, { 5.5, 1.5 }, { 5.25, 1.25 } }
  return celspan.rostrum { celspan.cel { celspan.union(dots) } }
end }
