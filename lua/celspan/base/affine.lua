--- Affine maps of the plane as lists { a, b, c, d, e, f }: x' = a x + b y + c, y' = d x + e y + f.
local fields = require "celspan.fields"

local affine = {}

function affine.translation(x, y) return { 1, 0, x, 0, 1, y } end

--- The map with this linear part that does not move the given point.
local function about(a, b, d, e, x, y)
  return { a, b, x - a * x - b * y, d, e, y - d * x - e * y }
end

--- degrees: clockwise on the screen, as for object:rotate.
function affine.turn(degrees, x, y)
  local angle = math.rad(degrees % 360)
  local c, s = math.cos(angle), math.sin(angle)
  return about(c, -s, s, c, x, y)
end

--- Scales about x, y: by `along` in the direction ux, uy (a unit vector), by `across` across it.
function affine.stretch(along, across, ux, uy, x, y)
  local xy = (along - across) * ux * uy
  return about(along * ux * ux + across * uy * uy, xy, xy,
               along * uy * uy + across * ux * ux, x, y)
end

--- First `inner`, then `outer`.
function affine.compose(outer, inner)
  local a, b, c, d, e, f = table.unpack(outer)
  local g, h, i, j, k, l = table.unpack(inner)
  return { a * g + b * j, a * h + b * k, a * i + b * l + c,
           d * g + e * j, d * h + e * k, d * i + e * l + f }
end

--- The map back; the determinant must not be 0.
function affine.inverse(map)
  local a, b, c, d, e, f = table.unpack(map)
  local size = a * e - b * d
  return { e / size, -b / size, (b * f - e * c) / size,
           -d / size, a / size, (d * c - a * f) / size }
end

function affine.apply(map, x, y)
  return map[1] * x + map[2] * y + map[3], map[4] * x + map[5] * y + map[6]
end

--- A contour of celspan.path, moved.
function affine.move(map, contour)
  local a, b, c, d, e, f = table.unpack(map)
  local moved = { closed = contour.closed }
  for i = 1, #contour, 2 do
    local x, y = contour[i], contour[i + 1]
    moved[i], moved[i + 1] = a * x + b * y + c, d * x + e * y + f
  end
  return moved
end

--- The nine numbers that object:transform takes.
function affine.matrix(map)
  return { map[1], map[2], map[3], map[4], map[5], map[6], 0, 0, 1 }
end

return fields.seal("affine", affine)
