-- Forty flat discs that move over a flat ground: what frames cost where there is little to draw.
-- 1280 x 720, 150 frames.
local celspan = require "celspan"

local colours = { "#e4572e", "#f3a712", "#2e86ab", "#3f8f5b" }
local discs = {}
for i = 0, 39 do
  discs[i] = celspan.circle { centre = { 0, 0 }, radius = 20 + 2 * i,
    texture = colours[i % 4 + 1] }
end

return celspan.film { size = { 1280, 720 }, fps = 25, frames = 150, frame = function(f)
  local u, moving = f.index / 149, {}
  for i = 0, 39 do
    moving[i + 1] = discs[i]:translate((1 - u) * (173 * i % 1280) + u * (311 * i % 1280),
      (1 - u) * (97 * i % 720) + u * ((59 * i + 300) % 720))
  end
  return celspan.rostrum { back = "#f1e3c6", celspan.cel(moving) }
end }
