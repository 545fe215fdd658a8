--- Lines measured by their length (src/kit/lua/nouns/ruler.c): where a place along a path is, and
--- which way it goes there.
local native = require "celspan.native"
local fields = require "celspan.fields"
local pathdata = require "celspan.pathdata"

local curves = {}

local Curve = {}
Curve.__index = Curve

--- The contour through points that are connected by lines.
function curves.through(points)
  local contour = { points[1][1], points[1][2] }
  for i = 2, #points do
    local a, b, n = points[i - 1], points[i], #contour
    contour[n + 1], contour[n + 2] = a[1], a[2]
    contour[n + 3], contour[n + 4], contour[n + 5], contour[n + 6] = b[1], b[2], b[1], b[2]
  end
  return contour
end

--- A contour in the other direction; a closed one from the same point.
function curves.reversed(contour)
  local back = { closed = contour.closed }
  for i = #contour - 1, 1, -2 do
    back[#back + 1], back[#back + 2] = contour[i], contour[i + 1]
  end
  return back
end

--- The curve of path data or of contours; nil and a message if path data are damaged. noun: for
--- messages.
function curves.of(noun, line)
  local ruler, length, is_closed, x, y = native.ruler(noun, line)
  if not ruler then return nil, length end
  if not x then
    local first = type(line) == "string" and pathdata.commands(line)[1] or line[1]
    if first then x, y = first[1], first[2] end
  end
  return setmetatable({ ruler = ruler, length = length, is_closed = is_closed, x = x, y = y },
    Curve)
end

--- The path data or the contours of a path; what are path data or may be contours, as it is.
local function line_of(outline)
  if type(outline) == "string" or type(outline) == "table" then return outline end
  local good, line = pcall(function() return outline.d or outline.contours end)
  return good and line or nil
end

--- The curve of path data, of contours or of a path (without its transforms); its length must not
--- be 0. noun: for messages.
function curves.read(noun, outline, field)
  field = field or "along"
  local line = line_of(outline)
  fields.expect_kind(line, outline, "%s: %s must be path data, contours or a path", noun, field)
  local curve, message = curves.of(noun, line)
  if not curve then native.refuse(("%s: %s: %s"):format(noun, field, message)) end
  if curve.length == 0 then
    native.refuse(("%s: %s: the path has no length"):format(noun, field))
  end
  return curve
end

--- The point at a length, and the direction there as a unit vector. Before the beginning and after
--- the end, the curve continues straight. A curve without a length is one point.
function Curve:at(length)
  if self.length == 0 then return self.x, self.y, 1, 0 end
  return native.ruler_at(self.ruler, length)
end

return fields.seal("curves", curves)
