-- Noise of every kind, flat, tilted and fine; grain over all of it.
local celspan = require "celspan"

local KINDS = { "perlin", "value", "fractal", "turbulence", "cells" }

return celspan.film { size = { 50, 24 }, grain = { amount = 0.02 }, frame = function()
  local objects = {}
  for i, kind in ipairs(KINDS) do
    for row = 0, 1 do
      objects[#objects + 1] = celspan.rect { 0, 0, 9, 11, texture = celspan.noise { kind = kind,
        size = row == 0 and 14 or 5, seed = 10 * i + row, at = row * 0.3,
        colours = { "#123", "#e4572e80", "#fff" },
        matrix = row == 1 and { 1, 0.2, 3, -0.1, 1, 0, 0.01, 0, 1 } or nil } }
        :translate(10 * (i - 1), 12 * row)
    end
  end
  return celspan.rostrum { celspan.cel(objects) }
end }
