-- Outlines that the drawings share: everything here is a path made from a few points.

local shapes = {}

--- Colours evenly spaced from one point to another.
local function between(from, to, colours)
  local stops = { from = from, to = to }
  for i, colour in ipairs(colours) do stops[i] = { (i - 1) / (#colours - 1), colour } end
  return linear(stops)
end

--- A gradient from top to bottom, and one from left to right.
function shapes.down(y0, y1, colours) return between({ 0, y0 }, { 0, y1 }, colours) end
function shapes.across(x0, x1, colours) return between({ x0, 0 }, { x1, 0 }, colours) end

local number = "%.2f %.2f "

--- Cubic pieces through points {x, y}, Catmull-Rom; the ends are straight.
local function through(points)
  local d = {}
  for i = 1, #points - 1 do
    local before, a = points[i - 1] or points[i], points[i]
    local b, after = points[i + 1], points[i + 2] or points[i + 1]
    d[#d + 1] = ("C" .. number:rep(3)):format(
      a[1] + (b[1] - before[1]) / 6, a[2] + (b[2] - before[2]) / 6,
      b[1] - (after[1] - a[1]) / 6, b[2] - (after[2] - a[2]) / 6, b[1], b[2])
  end
  return table.concat(d)
end

--- Land: a crest through the points, closed along `bottom`.
function shapes.ridge(points, bottom, texture)
  local first, last = points[1], points[#points]
  local d = ("M" .. number .. "L" .. number):format(first[1], bottom, first[1], first[2])
    .. through(points) .. ("L" .. number .. "Z"):format(last[1], bottom)
  return path { d = d, fill = texture }
end

--- A soft closed outline with the points as its control cage.
function shapes.blob(points, texture)
  return nurbs { points = points, fill = texture }
end

--- A ribbon along a line of points {x, y, width}.
function shapes.ribbon(points, texture)
  local there, back = {}, {}
  for i, p in ipairs(points) do
    local a, b = points[i - 1] or p, points[i + 1] or p
    local dx, dy = b[1] - a[1], b[2] - a[2]
    local k = p[3] / 2 / math.sqrt(dx * dx + dy * dy)
    there[i] = { p[1] - dy * k, p[2] + dx * k }
    back[#points + 1 - i] = { p[1] + dy * k, p[2] - dx * k }
  end
  local d = ("M" .. number):format(there[1][1], there[1][2]) .. through(there)
    .. ("L" .. number):format(back[1][1], back[1][2]) .. through(back) .. "Z"
  return path { d = d, fill = texture }
end

-- Steep at the lamp and level at the rim, where a step would be visible as a ring.
local falloff = { { 0, 1 }, { 0.15, 0.66 }, { 0.3, 0.4 }, { 0.45, 0.22 }, { 0.6, 0.1 },
                  { 0.75, 0.032 }, { 0.88, 0.006 }, { 1, 0 } }

--- A glow: paint far too thin to hide anything, visible only under a strong front light.
function shapes.glow(x, y, radius, r, g, b, strength)
  local stops = { centre = { x, y }, radius = radius }
  for i, stop in ipairs(falloff) do
    stops[i] = { stop[1], rgb(r, g, b, strength * stop[2]) }
  end
  local texture = radial(stops)
  return circle { x, y, radius, fill = texture }
end

return shapes
