--- Shapes that are grown or shrunk by a distance: celspan.offset.
--
--     grown: the shape and a stroke of twice the distance along its outline;
--     shrunk: the shape without that stroke.        +-----------+
--                                                   | +-------+ |
--   A line is grown like the shape inside it: the   | |shrunk | |  the stroke, from d outside
--   ring between two regions, half a width to       | +-------+ |  to d inside
--   either side of the distance.                    +-----------+
local celspan = require "celspan"
local core = require "celspan.core"
local fields = require "celspan.fields"
local merge = require "celspan.merge"

local offset = {}

local function refuse(text, ...) core.refuse("offset: " .. text:format(...)) end

local known = { join = "string", limit = "number" }
local joins = { round = true, miter = true, bevel = true }

local function check(object, distance, options)
  if not fields.is_object(object) then
    refuse("the first argument must be an object, got %s", fields.kind(object))
  end
  if not fields.is_finite(distance) or math.abs(distance) > 1e12 then
    refuse("the distance must be a number from -1e12 to 1e12, got %s", fields.shown(distance))
  end
  fields.check("offset", options, known)
  if options.join and not joins[options.join] then
    refuse("field 'join' must be \"round\", \"miter\" or \"bevel\", got %q", options.join)
  end
  local limit = options.limit or 4
  if limit < 1 or limit > 1e6 then
    refuse("field 'limit' must be from 1 to 1000000, got %s", fields.shown(limit))
  end
  return { join = options.join or "round", limit = limit }
end

local function stroke(d, distance, style, texture)
  return celspan.stroke { d = d, width = 2 * distance, join = style.join, miter = style.limit,
                          cap = style.join == "round" and "round" or "square", texture = texture }
end

--- The region inside path data, grown or shrunk; nil: there is none.
local function region(d, rule, distance, style, texture)
  if d == "" then return nil end
  local shape = celspan.path { d = d, rule = rule, texture = texture }
  if distance == 0 then return shape end
  local around = stroke(d, math.abs(distance), style, texture)
  return distance > 0 and celspan.union { shape, around } or celspan.difference { shape, around }
end

local function without(outer, inner)
  return outer and inner and celspan.difference { outer, inner } or outer
end

--- The parts of a line that are closed, and those that are open, as path data.
local function divide(contours)
  local closed, open = {}, {}
  for _, contour in ipairs(contours) do
    table.insert(contour.open and open or closed, contour)
  end
  return merge.data(closed), merge.data(open)
end

local function grow_line(node, distance, style, texture)
  local closed, open = divide(node.contours)
  local half, parts = node.line.width / 2, {}
  parts[1] = without(region(closed, "nonzero", distance + half, style, texture),
    region(closed, "nonzero", distance - half, style, texture))
  local far, near = math.abs(distance) + half, math.abs(distance) - half
  if open ~= "" then
    parts[#parts + 1] = without(stroke(open, far, style, texture),
      near > 0 and stroke(open, near, style, texture))
  end
  return celspan.union(parts)
end

local function finish(object, node)
  if node.fade ~= 1 then object = object:fade(node.fade) end
  return node.name ~= "" and object:named(node.name) or object
end

local function grow(node, distance, style)
  if node.kind == "other" then
    refuse "a rostrum, a scan-line procedure and what is blurred have no outline"
  end
  if node.kind == "boolean" then
    local operands = {}
    for i, child in ipairs(node) do
      operands[i] = node.filled and i == 1 and child.object or grow(child, distance, style)
    end
    return finish(core.rebuild(node.object, operands), node)
  end
  local texture = merge.texture(node)
  local made = node.line and grow_line(node, distance, style, texture)
    or region(merge.data(node.contours), node.rule, distance, style, texture)
    or celspan.union {}
  return finish(made:bounds() and merge.painted(made, node) or made, node)
end

--- An object whose outlines are moved outwards (above 0) or inwards.
---@param object celspan.shape
---@param distance number
---@param options? { join?: "round"|"miter"|"bevel", limit?: number }
---@return celspan.object
function offset.grown(object, distance, options)
  local style = check(object, distance, options or {})
  if distance == 0 then return object end
  return grow(core.anatomy(object), distance, style)
end

return fields.seal("offset", offset)
