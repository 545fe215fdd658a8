-- Nine painted layers under a pan, four of them out of focus: opencv.cpp makes the same frames.
-- Arguments: the folder of the layers, 1.png (the farthest) to 9.png; the space of the film.
local celspan = require "celspan"

local folder, space = ...

--- { how far a layer moves, of the whole pan; the radius of its blur, in film units }
local layers = { { 0, 0 }, { 0.05, 12 }, { 0.1, 10 }, { 0.2, 6 }, { 0.3, 0 }, { 0.42, 0 },
                 { 0.65, 0 }, { 0.8, 0 }, { 1, 8 } }
local images = {}
for i = 1, #layers do
  local image = celspan.image { file = ("%s/%d.png"):format(folder, i) }
  local _, _, width = image:bounds()
  images[i] = image:scale(1760 / width)
end

return celspan.film { size = { 1280, 720 }, frames = 48, space = space, frame = function(f)
  local cels = {}
  for i, layer in ipairs(layers) do
    local travel = 40 + 400 * layer[1] * f.index / 48
    cels[i] = celspan.cel { images[i]:translate(-travel, -135), defocus = layer[2] }
  end
  return celspan.rostrum(cels)
end }
