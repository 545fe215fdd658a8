--- A script: red on the left half, a quarter of blue on the right; frame n moves the edge by n - 1
--- pixels.
return [[
local celspan = require "celspan"
return celspan.film{ size = {8, 4}, frames = 12, fps = 12, title = "plain", frame = function(f)
  return celspan.rostrum{ celspan.cel{
    celspan.rect{ 0, 0, 8, 4, texture = celspan.rgb(0, 0, 1, 0.25) },
    celspan.rect{ 0, 0, 4 + f.index, 4, texture = celspan.rgb(1, 0, 0) } } }
end }
]]
