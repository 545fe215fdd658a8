--- Curves measured by their length: where a place along path data is, and which way it goes there.
--
-- The length of a piece is integrated by Gauss's rule of five points over each of its SHARES parts;
-- the place at a length is found by Newton's steps from the chord of the part, so that it is a
-- smooth function of the length, as far as the curve is.
local core = require "celspan.core"
local fields = require "celspan.fields"
local ordered = require "celspan.ordered"
local pathdata = require "celspan.pathdata"

local curves = {}

local SHARES = 16 -- parts of a curve; a straight line has one part
local STEPS = 6 -- steps of Newton's method; each doubles the number of right digits
local nodes = { { 0, 128 / 225 }, { 0.5384693101056831, 0.47862867049936647 },
                { -0.5384693101056831, 0.47862867049936647 },
                { 0.9061798459386640, 0.23692688505618908 },
                { -0.9061798459386640, 0.23692688505618908 } }

local Curve = {}
Curve.__index = Curve

--- The length between two parameters of a piece, which are close to each other.
local function length_between(at, from, to)
  local sum, half, middle = 0, (to - from) / 2, (to + from) / 2
  for _, node in ipairs(nodes) do
    local _, _, dx, dy = at(middle + half * node[1])
    sum = sum + node[2] * math.sqrt(dx * dx + dy * dy)
  end
  return half * sum
end

--- Appends a piece. at: a function of 0..1 that returns a point and its derivative.
local function append(curve, at, shares)
  for i = 1, shares or SHARES do
    local from, to = (i - 1) / (shares or SHARES), i / (shares or SHARES)
    local length = length_between(at, from, to)
    if length > 0 then
      curve[#curve + 1] = { at = at, from = from, to = to, start = curve.length, length = length }
      curve.length = curve.length + length
    end
  end
end

--- The pen that pathdata.walk moves along the pieces; each piece is a function of 0..1.
local Pen = {}
Pen.__index = Pen

function Pen:move(x, y)
  local way = self.way
  if not way.x then way.x, way.y = x, y end
end

local function append_line(way, x0, y0, x, y)
  local dx, dy = x - x0, y - y0
  append(way, function(t) return x0 + t * dx, y0 + t * dy, dx, dy end, 1)
end

function Pen:line(x, y) append_line(self.way, self.x, self.y, x, y) end

function Pen:curve(x1, y1, x2, y2, x3, y3)
  local x0, y0 = self.x, self.y
  append(self.way, function(t)
    local s = 1 - t
    local a, b, c, d = s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t
    local e, f, g = 3 * s * s, 6 * s * t, 3 * t * t
    return a * x0 + b * x1 + c * x2 + d * x3, a * y0 + b * y1 + c * y2 + d * y3,
      e * (x1 - x0) + f * (x2 - x1) + g * (x3 - x2), e * (y1 - y0) + f * (y2 - y1) + g * (y3 - y2)
  end)
end

function Pen:arc(point, from, to)
  local turn = to - from
  append(self.way, function(t)
    local x, y, dx, dy = point(from + t * turn)
    return x, y, dx * turn, dy * turn
  end)
end

--- The path data of a path, or the text itself; nil for another value.
local function data_of(outline)
  if type(outline) == "string" then return outline end
  local good, data = pcall(function() return outline.d end)
  return good and type(data) == "string" and data or nil
end

--- The curve through points that are connected by lines; x, y: the first point.
function curves.of_points(points)
  local way = setmetatable({ length = 0, x = points[1][1], y = points[1][2] }, Curve)
  for i = 2, #points do
    append_line(way, points[i - 1][1], points[i - 1][2], points[i][1], points[i][2])
  end
  return way
end

--- The curve of path data; nil and a message if the data are damaged.
function curves.of_data(data)
  local way = setmetatable({ length = 0 }, Curve)
  local done, message = pathdata.walk(data, setmetatable({ way = way }, Pen))
  if not done then return nil, message end
  way.is_closed = data:find "[zZ]%s*$" ~= nil
  return way
end

--- The curve of path data or of a path (without its transforms); its length must not be 0. noun:
--- for messages.
function curves.read(noun, outline, field)
  field = field or "along"
  local data = data_of(outline)
  if not data then
    core.refuse(("%s: %s must be path data or a path, got %s"):format(noun, field,
      fields.kind(outline)))
  end
  local way, message = curves.of_data(data)
  if not way then core.refuse(("%s: %s: %s"):format(noun, field, message)) end
  if #way == 0 then core.refuse(("%s: %s: the path has no length"):format(noun, field)) end
  return way
end

--- The point at a length, and the direction there as a unit vector. Before the beginning and after
--- the end, the curve continues straight. A curve without a length is one point.
function Curve:at(length)
  if #self == 0 then return self.x, self.y, 1, 0 end
  local held = math.max(0, math.min(self.length, length))
  local part = self[ordered.last(self, held, "start")]
  local rest = held - part.start
  local t = part.from + (part.to - part.from) * rest / part.length
  for _ = 1, STEPS do
    local _, _, dx, dy = part.at(t)
    local speed = math.sqrt(dx * dx + dy * dy)
    local error = length_between(part.at, part.from, t) - rest
    if speed == 0 or error == 0 then break end
    t = math.max(part.from, math.min(part.to, t - error / speed))
  end
  local x, y, dx, dy = part.at(t)
  local speed = math.sqrt(dx * dx + dy * dy)
  if speed > 0 then dx, dy = dx / speed, dy / speed end
  return x + (length - held) * dx, y + (length - held) * dy, dx, dy
end

return fields.seal("curves", curves)
