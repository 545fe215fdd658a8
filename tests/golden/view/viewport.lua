-- A viewport pans and zooms one cel; the other does not move.
local celspan = require "celspan"
local function cross(texture)
  return celspan.rect { 6, 2, 4, 8, texture = texture }
    | celspan.rect { 3, 5, 10, 2, texture = texture }
end
return celspan.film { size = { 16, 12 }, frame = function()
  return celspan.rostrum { antialias = "none", celspan.cel { cross "#888" },
    celspan.cel { cross "#f00", viewport = { 5, 4, 8, 6 }, opacity = 0.5 } }
end }
