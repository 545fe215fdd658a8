--- The random drawings of the benchmark, in the text form that drawing.h tells.
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

function shapes.write(list, path)
  local file = assert(io.open(path, "w"))
  file:write("drawing ", #list, "\n")
  for _, shape in ipairs(list) do
    file:write(("spline evenodd %d %d %d %d "):format(table.unpack(shape.rgba)))
    for _, number in ipairs(shape.points) do file:write((" %.9f"):format(number)) end
    file:write "\n"
  end
  assert(file:close())
end

return shapes
