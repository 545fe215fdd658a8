--- Two scripts whose frames have single colours, gradients and edges: one with
--- alpha, and one without.
local scenes = {}

scenes.clear = [[
local celspan = require "celspan"
return celspan.film{ size = {300, 200}, frames = 1, frame = function(f)
  return celspan.rostrum{ celspan.cel{
    celspan.rect{ 20, 20, 200, 120, texture = celspan.rgb(0, 0, 1, 0.25) },
    celspan.rect{ 0, 160, 300, 40, texture = celspan.linear{ from = {0, 160}, to = {300, 160},
      {0, celspan.rgb(0, 0, 0)}, {1, celspan.rgb(1, 0.5, 0.2)} } },
    celspan.circle{ centre = {150, 90}, radius = 70.3, texture = celspan.rgb(1, 0, 0) } } }
end }
]]

scenes.opaque = [[
local celspan = require "celspan"
return celspan.film{ size = {120, 90}, frames = 1, frame = function(f)
  return celspan.rostrum{ back = "#fff", celspan.cel{
    celspan.circle{ centre = {60, 45}, radius = 40.3, texture = celspan.rgb(1, 0, 0, 0.5) } } }
end }
]]

return scenes
