-- A picture as the whole film, pixel by pixel. Argument: its file.
local celspan = require "celspan"

local file = ...
local image = celspan.image { file = file }
local _, _, width, height = image:bounds()

return celspan.film { size = { math.floor(width), math.floor(height) }, frames = 1,
  frame = function() return celspan.rostrum { celspan.cel { image } } end }
