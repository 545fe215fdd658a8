--- Stars and regular polygons with round points: celspan.star.
--
--            o outer        points = 5; without `inner` the corners of a regular polygon.
--           / \             A round point is a joint of two cubics whose arms go along the circle
--    o-----o   o-----o      of the point. With a roundness of 1 they are as long as a quarter of
--      \    inner  /        the way along that circle to the next joint of the same circle.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"

local star = {}

local POINTS_MOST = 10000

local known = { centre = "table", points = "number", outer = "number", inner = "number",
                rotate = "number", outer_round = "number", inner_round = "number",
                texture = "any" }

local function check_radius(name, radius)
  fields.must(not radius or radius >= 0 and radius <= 1e12, ("star: field '%s'"):format(name),
    "from 0 to 1e12", radius)
  return radius
end

local function check_round(name, round)
  fields.must(not round or math.abs(round) <= 100, ("star: field '%s'"):format(name),
    "from -100 to 100", round)
  return round or 0
end

--- { x, y, outer, inner } with its values as named fields.
local function named(options)
  local count = type(options) == "table" and rawlen(options) or 0
  if count == 0 then return options end
  if count < 3 or count > 4 then
    native.refuse(("star: takes {x, y, outer [, inner]} by place, got %d values"):format(count))
  end
  local copy = { centre = { options[1], options[2] }, outer = options[3], inner = options[4] }
  for name, value in next, options do
    if copy[name] then
      native.refuse(("star: field '%s' is given by its place, too: give it once"):format(name))
    end
    if type(name) == "string" then copy[name] = value end
  end
  return copy
end

local function read(options)
  options = fields.check("star", named(options), known)
  fields.numbers("star", "centre[%d]", options.centre or { 0, 0 }, 2, "{x, y}")
  if options.outer == nil then native.refuse "star: needs the field 'outer', a radius" end
  local points = fields.whole("star: field 'points'", options.points or 5, 2, POINTS_MOST)
  local inner = check_radius("inner", options.inner)
  return { x = options.centre and options.centre[1] or 0,
           y = options.centre and options.centre[2] or 0,
           count = inner and 2 * points or points, points = points,
           turn = (options.rotate or 0) % 360, texture = options.texture,
           radii = { [0] = check_radius("outer", options.outer), [1] = inner },
           rounds = { [0] = check_round("outer_round", options.outer_round),
                      [1] = check_round("inner_round", options.inner_round) } }
end

--- The joint number i, from 0: its place, and the vector to its control point ahead.
local function joint(s, i)
  local ring = s.radii[1] and i % 2 or 0
  local angle = math.rad(s.turn + 360 * i / s.count - 90)
  local c, d = math.cos(angle), math.sin(angle)
  local radius = s.radii[ring]
  local arm = s.rounds[ring] * math.pi * radius / (2 * s.points)
  return s.x + radius * c, s.y + radius * d, -arm * d, arm * c
end

--- The corners as a polygon.
local function straight(s, texture)
  local corners = { texture = texture }
  for i = 0, s.count - 1 do
    local x, y = joint(s, i)
    corners[i + 1] = { x, y }
  end
  return celspan.polygon(corners)
end

local function curved(s, texture)
  local x, y, ax, ay = joint(s, 0)
  local contour = { x, y, closed = true }
  for i = 1, s.count do
    local nx, ny, bx, by = joint(s, i % s.count)
    table.move({ x + ax, y + ay, nx - bx, ny - by, nx, ny }, 1, 6, #contour + 1, contour)
    x, y, ax, ay = nx, ny, bx, by
  end
  return celspan.path { contours = { contour }, texture = texture }
end

--- A star, or without `inner` a regular polygon.
---@param options { [integer]: number, centre?: celspan.point, points?: integer, outer?: number, inner?: number, rotate?: number, outer_round?: number, inner_round?: number, fill?: celspan.surface } Also { x, y, outer, inner }
---@return celspan.object
function star.outline(options)
  local s = read(options)
  local is_round = s.rounds[0] ~= 0 or s.radii[1] and s.rounds[1] ~= 0
  return (is_round and curved or straight)(s, s.texture)
end

return fields.seal("star", star)
