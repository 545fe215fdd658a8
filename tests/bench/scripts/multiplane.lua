-- A frame of twelve painted planes under a multiplane camera: nothing but pictures, enlarged,
-- turned and one over the other. Argument: the folder of pictures.
local celspan = require "celspan"
local multiplane = require "celspan.multiplane"

local folder = ...
local names = { "village.png", "canal.png", "wood.png" }
local width, height = 1920, 1080

local function plane(i)
  local image = celspan.image { file = folder .. "/" .. names[i % 3 + 1], w = 1.6 * width,
    h = 1.6 * height, sampling = "bilinear" }
  local window = celspan.ellipse { centre = { 0.3 * width * (i % 4), height * (0.2 + i % 3 * 0.4) },
    radii = { 0.4 * width, 0.5 * height } }
  if i == 0 then return image end
  return celspan.clip(image:rotate(3 * i):translate(-0.3 * width, -0.2 * height), window)
end

return celspan.film { size = { width, height }, frames = 24, frame = function(f)
  local set = { film = { width, height }, camera = { x = 200 * f.progress } }
  for i = 0, 11 do set[i + 1] = { celspan.cel { plane(i), opacity = 0.9 }, z = 1100 - 100 * i } end
  return multiplane(set)
end }
