-- The paper's random NURBS shapes: four control points anywhere in the square and random knots,
-- each with its colour and its transparency (section 6.1).

local shapes = {}

--- One closed cubic in a square of side 1000: shape `i` of a drawing.
local function shape(random, i)
  local function draw(what, m, n) return random(("%s %d"):format(what, i), m, n) end
  local points, knots = {}, { 0 }
  for k = 1, 4 do
    points[k] = { 1000 * draw("x" .. k), 1000 * draw("y" .. k) }
    knots[k + 1] = knots[k] + 0.1 + draw("knot" .. k)
  end
  local colour = rgb(draw "red", draw "green", draw "blue", 0.1 + 0.9 * draw "alpha")
  return nurbs { points = points, closed = "periodic", knots = knots, fill = colour }
end

--- A film of `count` shapes in one cel, under a white light from the front and one from behind.
function shapes.film(title, count, seed)
  local random, list = celspan.random(seed), {}
  for i = 1, count do list[i] = shape(random, i) end
  local rostrum = celspan.rostrum { cel { union(list),
    front = { 1, 1, 1 }, back = { 1, 1, 1, 1 } } }
  return film { title = title, size = { 1000, 1000 }, frames = 1,
    frame = function() return rostrum end }
end

return shapes
