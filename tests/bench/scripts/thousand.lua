-- A thousand translucent blobs that drift over a ground: what ./run bench player plays.
-- 1280 x 720, 60 frames a second.
local celspan = require "celspan"

local seed = 20
local function random() -- the minimal standard generator
  seed = seed * 48271 % 2147483647
  return seed / 2147483647
end

local blobs = {}
for i = 1, 1000 do
  local x, y, size = 1280 * random(), 720 * random(), 10 + 60 * random()
  local d = ("M%f %f Q%f %f %f %f T%f %f Z"):format(x, y, x + size * random(),
    y - size * random(), x + size, y, x + size * random(), y + size)
  local texture = celspan.rgb(random(), random(), random(), 0.75)
  blobs[i] = { shape = celspan.path { d = d, texture = texture },
               x = 200 * random() - 100, y = 100 * random() - 50 }
end

return celspan.film { size = { 1280, 720 }, fps = 60, frames = 60, frame = function(f)
  local moved = {}
  for i, blob in ipairs(blobs) do
    moved[i] = blob.shape:translate(blob.x * f.progress, blob.y * f.progress)
  end
  return celspan.rostrum { back = "#f1e3c6", celspan.cel(moved) }
end }
