-- The paper's figure 14: drawn shapes before a picture. Arguments: what, the folder of the
-- pictures, the sampling.
--   background   the picture alone, to be kept as background.png of 1000 x 1000
--   foreground   the shapes alone, to be kept as foreground.png of 1000 x 1000
--   pictures     both as those pictures
--   geometry     the shapes as shapes before background.png
local celspan = require "celspan"

local what, folder, sampling = ...
local side = 1000

--- A picture from the folder over the whole film.
local function picture(name)
  return celspan.image { file = folder .. "/" .. name, w = side, h = side, sampling = sampling }
end

--- A leaf of a clover on its stem's end, and the clover of four.
local function leaf(turn)
  return celspan.nurbs { points = { { 0, 0 }, { 240, -330 }, { 0, -270 }, { -240, -330 } },
    texture = celspan.rgb(0.55, 0.03, 0.05, 0.8) }:rotate(turn)
end

local function clover(x, y, size)
  return celspan.union { leaf(0), leaf(90), leaf(180), leaf(270) }:rotate(20):scale(size)
    :translate(x, y)
end

local shapes = celspan.union { clover(430, 420, 1.5), clover(760, 700, 0.8), clover(230, 780, 0.6) }

local parts = {
  background = function() return { picture "photo.png" } end,
  foreground = function() return { shapes } end,
  pictures = function() return { picture "background.png", picture "foreground.png" } end,
  geometry = function() return { picture "background.png", shapes } end,
}

return celspan.film { size = { side, side }, frames = 1,
  frame = function() return celspan.rostrum { celspan.cel(parts[what]()) } end }
