--- A walk along the pieces of SVG path data.
local pathdata = require "tests.support.own" "celspan.pathdata"

local function go(pen, x, y) pen.x, pen.y = x, y end

local function line(pen, x, y)
  pen:line(x, y)
  go(pen, x, y)
end

--- Draws a cubic with the inner control points 1 and 2.
local function cubic(pen, x1, y1, x2, y2, x, y)
  pen:curve(x1, y1, x2, y2, x, y)
  go(pen, x, y)
  pen.control_x, pen.control_y = x2, y2
end

local function quadratic(pen, x1, y1, x, y)
  local x0, y0 = pen.x, pen.y
  cubic(pen, x0 + 2 / 3 * (x1 - x0), y0 + 2 / 3 * (y1 - y0), x + 2 / 3 * (x1 - x),
    y + 2 / 3 * (y1 - y), x, y)
  pen.control_x, pen.control_y = x1, y1
end

--- An elliptical arc, from end points to centre as in SVG's appendix on arcs.
local function arc(pen, rx, ry, degrees, is_large, is_sweep, x, y)
  rx, ry = math.abs(rx), math.abs(ry)
  local x0, y0 = pen.x, pen.y
  if rx == 0 or ry == 0 or (x0 == x and y0 == y) then return line(pen, x, y) end
  local cos, sin = math.cos(math.rad(degrees)), math.sin(math.rad(degrees))
  local dx, dy = (x0 - x) / 2, (y0 - y) / 2
  local px, py = (cos * dx + sin * dy) / rx, (cos * dy - sin * dx) / ry
  local reach = px * px + py * py
  if reach > 1 then
    local grown = math.sqrt(reach)
    rx, ry, px, py, reach = rx * grown, ry * grown, px / grown, py / grown, 1
  end
  local k = math.sqrt(math.max(0, 1 / reach - 1))
  if is_large == is_sweep then k = -k end
  local cx, cy = k * py, -k * px -- the centre, in the plane in which the ellipse is a unit circle
  local from, to = math.atan(py - cy, px - cx), math.atan(-py - cy, -px - cx)
  if is_sweep == 1 and to < from then to = to + 2 * math.pi end
  if is_sweep == 0 and to > from then to = to - 2 * math.pi end
  local mx, my = (x0 + x) / 2, (y0 + y) / 2
  --- The point at an angle, and the derivative of the point by the angle.
  local function point(angle)
    local ux, uy = rx * (math.cos(angle) + cx), ry * (math.sin(angle) + cy)
    local vx, vy = -rx * math.sin(angle), ry * math.cos(angle)
    return mx + cos * ux - sin * uy, my + sin * ux + cos * uy, cos * vx - sin * vy,
      sin * vx + cos * vy
  end
  pen:arc(point, from, to, x, y)
  go(pen, x, y)
end

local draw = {}

function draw.M(pen, x, y)
  pen:move(x, y)
  go(pen, x, y)
  pen.start_x, pen.start_y = x, y
end

function draw.L(pen, x, y) line(pen, x, y) end
function draw.H(pen, x) line(pen, x, pen.y) end
function draw.V(pen, y) line(pen, pen.x, y) end
function draw.Z(pen) line(pen, pen.start_x, pen.start_y) end
draw.C, draw.Q, draw.A = cubic, quadratic, arc

--- The control point mirrored at the pen, if the previous command was of the same family.
local function mirrored(pen, family)
  if not family:find(pen.last, 1, true) then return pen.x, pen.y end
  return 2 * pen.x - pen.control_x, 2 * pen.y - pen.control_y
end

function draw.S(pen, x2, y2, x, y)
  local x1, y1 = mirrored(pen, "CS")
  cubic(pen, x1, y1, x2, y2, x, y)
end

function draw.T(pen, x, y)
  local x1, y1 = mirrored(pen, "QT")
  quadratic(pen, x1, y1, x, y)
end

--- Adds the position of the pen to relative numbers.
local function make_absolute(pen, command, n)
  if command == "H" then n[1] = n[1] + pen.x
  elseif command == "V" then n[1] = n[1] + pen.y
  elseif command == "A" then n[6], n[7] = n[6] + pen.x, n[7] + pen.y
  else
    for i = 1, #n, 2 do n[i], n[i + 1] = n[i] + pen.x, n[i + 1] + pen.y end
  end
end

--- Walks a pen along path data: pen:move(x, y), pen:line(x, y), pen:curve(x1, y1, x2, y2, x, y) and
--- pen:arc(point, from, to, x, y), where point(angle) returns a point of the arc and its
--- derivative. pen.x, pen.y is its position before each call. Returns true, or nil and a message.
return function(text, pen)
  local commands, message = pathdata.commands(text)
  if not commands then return nil, message end
  pen.x, pen.y, pen.start_x, pen.start_y, pen.last = 0, 0, 0, 0, "M"
  for _, n in ipairs(commands) do
    local command = n.command:upper()
    if n.command ~= command then make_absolute(pen, command, n) end
    draw[command](pen, table.unpack(n))
    pen.last = command
  end
  return true
end
