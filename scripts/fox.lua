-- A painted fox that trots through an autumn wood: a puppet of the layers of an OpenRaster file.
local layers = require "celspan.layers"
local wood = require "fox.wood"

local fox = puppet.animal { art = assert(layers.read "paintings/fox.ora") }
local gait = { stride = 236, pace = 2 / 0.72, bounce = 4, gait = "trot" }

return film { size = { 960, 540 }, frames = 96, frame = function(f)
  local way, pose = fox:walked(f.time, gait), puppet.trot(fox, f.time, gait)
  return wood(f.time, way, fox:pose(pose):translate(130 + way, 67))
end }
