--- Path operators: celspan.trim, round_corners, zigzag, pucker, twist and offset. The core changes
--- the contours (celspan/operators.h); here the arguments are checked.
local native = require "celspan.native"
local fields = require "celspan.fields"

local operators = {}

local function check_number(what, number)
  fields.must(fields.is_finite(number), what, "a finite number", number)
end

local trims = { offset = "number", together = "boolean" }

--- The part of every contour between two shares of its length.
---@param object celspan.shape
---@param from number
---@param to number
---@param options? { offset?: number, together?: boolean }
---@return celspan.object
function operators.trim(object, from, to, options)
  fields.object("trim", object)
  check_number("trim: the second argument, from,", from)
  check_number("trim: the third argument, to,", to)
  if options == nil then return native.trim(object, from, to, 0, false) end
  fields.check("trim", options, trims)
  return native.trim(object, from, to, options.offset or 0, options.together or false)
end

--- Arcs in place of the corners between straight sides.
---@param object celspan.shape
---@param radius number Of an arc in a right angle
---@return celspan.object
function operators.round_corners(object, radius)
  fields.object("round_corners", object)
  check_number("round_corners: the radius", radius)
  return native.round_corners(object, radius)
end

local zigzags = { size = "number", ridges = "number", smooth = "boolean" }
local RIDGES_MOST = 10000

--- Points at a distance from every piece of a contour, on its two sides in turn.
---@param object celspan.shape
---@param options { size: number, ridges: integer, smooth?: boolean } ridges: of each piece
---@return celspan.object
function operators.zigzag(object, options)
  fields.object("zigzag", object)
  fields.check("zigzag", options, zigzags)
  for _, name in ipairs { "size", "ridges" } do
    if options[name] == nil then
      native.refuse(("zigzag: needs the field '%s', a number"):format(name))
    end
  end
  local ridges = fields.whole("zigzag: field 'ridges'", options.ridges, 0, RIDGES_MOST)
  return native.zigzag(object, options.size, ridges, options.smooth or false)
end

--- Bloats (above 0) or puckers (below 0): joints move towards their middle, control points away.
---@param object celspan.shape
---@param amount number -1..1
---@return celspan.object
function operators.pucker(object, amount)
  fields.object("pucker", object)
  check_number("pucker: the amount", amount)
  return native.pucker(object, amount)
end

--- Points turn about a centre, the less the farther they are from it.
---@param object celspan.shape
---@param degrees number At the centre
---@param options? { centre?: celspan.point } Default: the middle of the bounds
---@return celspan.object
function operators.twist(object, degrees, options)
  fields.object("twist", object)
  check_number("twist: the angle", degrees)
  fields.must(math.abs(degrees) <= 360000, "twist: the angle", "from -360000 to 360000 degrees",
    degrees) -- a thousand turns
  local centre = fields.check("twist", options or {}, { centre = "table" }).centre
  if not centre then return native.twist(object, degrees) end
  fields.numbers("twist", "centre[%d]", centre, 2, "{x, y}")
  return native.twist(object, degrees, centre[1], centre[2])
end

local joins = { round = true, miter = true, bevel = true }
local LIMIT = 4 -- of miters, as of strokes

--- The object grown, or with a distance below 0 shrunk.
---@param object celspan.shape
---@param distance number
---@param options? { join?: "round"|"miter"|"bevel", limit?: number } Default "round", 4
---@return celspan.object
function operators.offset(object, distance, options)
  fields.object("offset", object)
  fields.must(fields.is_finite(distance) and math.abs(distance) <= 1e12, "offset: the distance",
    "a number from -1e12 to 1e12", distance)
  fields.check("offset", options or {}, { join = "string", limit = "number" })
  local join, limit = options and options.join or "round", options and options.limit or LIMIT
  if not joins[join] then
    native.refuse(("offset: field 'join' must be \"round\", \"miter\" or \"bevel\", got %q"):format(
      join))
  end
  fields.must(limit >= 1 and limit <= 1e6, "offset: field 'limit'", "from 1 to 1000000", limit)
  return native.offset(object, distance, join, limit)
end

return fields.seal("operators", operators)
