-- The few marks from which everything here is made. Many marks of one colour are one path.
local celspan = require "celspan"

local draw = {}

function draw.rect(x, y, w, h, texture, radius)
  return celspan.rect { x, y, w, h, texture = texture, radius = radius or 0 }
end

function draw.disc(x, y, radius, texture)
  return celspan.circle { centre = { x, y }, radius = radius, texture = texture }
end

function draw.oval(x, y, rx, ry, texture)
  return celspan.ellipse { centre = { x, y }, radii = { rx, ry }, texture = texture }
end

function draw.path(texture, d, ...)
  return celspan.path { d = select("#", ...) > 0 and d:format(...) or d, texture = texture }
end

--- Rectangles {x, y, w, h} as one path.
function draw.rects(texture, list)
  local d = {}
  for i, r in ipairs(list) do
    d[i] = ("M%.4f %.4fh%.4fv%.4fh%.4fZ"):format(r[1], r[2], r[3], r[4], -r[3])
  end
  return celspan.path { d = table.concat(d), texture = texture }
end

--- Rings of light in the air: paint too thin to hide anything, for a cel that is strongly lit.
function draw.halo(x, y, radius, r, g, b, strength)
  local rings = {}
  for i = 1, 4 do
    rings[i] = draw.disc(x, y, radius * (1.15 - i * 0.22), celspan.rgb(r, g, b, strength))
  end
  return celspan.union(rings)
end

return draw
