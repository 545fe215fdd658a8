--- The random drawings of the benchmark, in the text form that drawing.h describes.
local prng = require "tests.support.prng"

local shapes = {}

--- A closed uniform cubic B-spline on four random points of the unit square, of random colour.
local function random_shape(random)
  local shape = { rgba = {}, points = {} }
  for i = 1, 3 do shape.rgba[i] = random:whole(0, 255) end
  shape.rgba[4] = random:whole(51, 255)
  for i = 1, 8 do shape.points[i] = random:between(0, 1) end
  return shape
end

function shapes.random(count)
  local random, list = prng.new(20), {}
  for i = 1, count do list[i] = random_shape(random) end
  return list
end

--- The shapes of a file of the material, or nil.
function shapes.read(path)
  local file = io.open(path)
  if not file then return nil end
  local list = {}
  for line in file:lines() do
    local numbers = {}
    for number in line:gmatch "[%d.]+" do numbers[#numbers + 1] = tonumber(number) end
    if #numbers == 12 then
      list[#list + 1] = { rgba = table.move(numbers, 1, 4, 1, {}),
                          points = table.move(numbers, 5, 12, 1, {}) }
    end
  end
  file:close()
  return list
end

--- The same shapes with another alpha each: a function of the shape's number.
function shapes.with_alpha(list, alpha)
  local out = {}
  for i, shape in ipairs(list) do
    local r, g, b = table.unpack(shape.rgba)
    out[i] = { rgba = { r, g, b, alpha(i) }, points = shape.points }
  end
  return out
end

-- ---------------------------------------------------------------- boxes

--- Adds where a cubic turns back between its ends: the roots of its slope.
local function add_turns(list, a, b, c, d)
  local function at(t)
    local s = 1 - t
    return s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d
  end
  local u, v, w = b - a, c - b, d - c -- the slope is u s^2 + 2 v s t + w t^2
  local square, linear = u - 2 * v + w, v - u
  local root = linear * linear - square * u
  if root < 0 then return end
  for sign = -1, 1, 2 do
    local t = square == 0 and -u / (2 * linear) or (-linear + sign * math.sqrt(root)) / square
    if t > 0 and t < 1 then list[#list + 1] = at(t) end
  end
end

--- The first and the last column of a shape, exactly: of its Bezier pieces' ends and turns.
local function columns(shape)
  local p, list = shape.points, {}
  local function x(i) return p[2 * (i % 4) + 1] end
  for i = 0, 3 do
    local a, b, c, d = x(i), x(i + 1), x(i + 2), x(i + 3)
    local from, to = (a + 4 * b + c) / 6, (b + 4 * c + d) / 6
    list[#list + 1] = from
    add_turns(list, from, (2 * b + c) / 3, (b + 2 * c) / 3, to)
  end
  return math.min(table.unpack(list)), math.max(table.unpack(list))
end

--- The same shapes, each with a gradient across its box to another colour of the same alpha.
function shapes.with_gradients(list)
  local random, out = prng.new(23), {}
  for i, shape in ipairs(list) do
    local far = { random:whole(0, 255), random:whole(0, 255), random:whole(0, 255), shape.rgba[4] }
    out[i] = { rgba = shape.rgba, far_rgba = far, columns = { columns(shape) },
               points = shape.points }
  end
  return out
end

--- Shapes by the same rule, each in a square of its own of the side `size`, anywhere.
function shapes.small(count, size)
  local random, list = prng.new(21), {}
  for i = 1, count do
    local shape = random_shape(random)
    local x, y = random:between(0, 1 - size), random:between(0, 1 - size)
    for k = 1, 8, 2 do
      shape.points[k] = x + size * shape.points[k]
      shape.points[k + 1] = y + size * shape.points[k + 1]
    end
    list[i] = shape
  end
  return list
end

local function paint(shape)
  local near = ("%d %d %d %d "):format(table.unpack(shape.rgba))
  if not shape.far_rgba then return near end
  local far = ("%d %d %d %d "):format(table.unpack(shape.far_rgba))
  return ("across %.9f %.9f "):format(table.unpack(shape.columns)) .. near .. far
end

function shapes.write(list, path)
  local file = assert(io.open(path, "w"))
  file:write("drawing ", #list, "\n")
  for _, shape in ipairs(list) do
    file:write("spline evenodd ", paint(shape))
    for _, number in ipairs(shape.points) do file:write((" %.9f"):format(number)) end
    file:write "\n"
  end
  assert(file:close())
end

return shapes
