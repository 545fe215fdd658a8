-- The few marks from which everything here is made. Many marks of one colour are one path.

local draw = {}

function draw.rect(x, y, w, h, texture, radius)
  return rect { x, y, w, h, fill = texture, radius = radius or 0 }
end

function draw.disc(x, y, radius, texture)
  return circle { x, y, radius, fill = texture }
end

function draw.oval(x, y, rx, ry, texture)
  return ellipse { x, y, rx, ry, fill = texture }
end

function draw.path(texture, d, ...)
  return path { d = select("#", ...) > 0 and d:format(...) or d, fill = texture }
end

--- Rectangles {x, y, w, h} as one path.
function draw.rects(texture, list)
  local d = {}
  for i, r in ipairs(list) do
    d[i] = ("M%.4f %.4fh%.4fv%.4fh%.4fZ"):format(r[1], r[2], r[3], r[4], -r[3])
  end
  return path { d = table.concat(d), fill = texture }
end

--- Rings of light in the air: paint too thin to hide anything, for a cel that is strongly lit.
function draw.halo(x, y, radius, r, g, b, strength)
  local rings = {}
  for i = 1, 4 do
    rings[i] = draw.disc(x, y, radius * (1.15 - i * 0.22), rgb(r, g, b, strength))
  end
  return union(rings)
end

return draw
