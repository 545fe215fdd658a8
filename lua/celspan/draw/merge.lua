--- Shapes as one shape: celspan.merge.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"

local merge = {}

local function refuse(text, ...) native.refuse("merge: " .. text:format(...)) end

--- The texture of a node.
local function texture_of(node) return node.paint and celspan.paint(node.paint) or node.texture end

--- The outlines below a node. A shape that a pattern fills has no texture of its own.
local function collect(node, list)
  if node.kind == "outline" then
    list[#list + 1] = node
  elseif node.kind == "other" then
    refuse "a rostrum, a scan-line procedure and what is blurred have no outline"
  end
  for i, child in ipairs(node) do
    if i > 1 or not node.filled then
      collect(child, list)
      child.filled = node.filled
    end
  end
  return list
end

local function join(nodes, texture)
  local contours = {}
  for _, node in ipairs(nodes) do
    table.move(node.contours, 1, #node.contours, #contours + 1, contours)
  end
  return celspan.path { contours = contours, texture = texture }
end

local operators = { add = celspan.union, subtract = celspan.difference,
                    intersect = celspan.intersection, exclude = celspan.xor }

local function read(objects, options)
  options = fields.check("merge", options, { mode = "string", texture = "any" })
  local mode = options.mode or "merge"
  if mode ~= "merge" and not operators[mode] then
    refuse("field 'mode' must be \"merge\", \"add\", \"subtract\", \"intersect\" or \"exclude\", "
      .. "got %q", mode)
  end
  fields.expect_kind(type(objects) == "table", objects,
    "merge: the first argument must be a list of objects")
  local nodes = {}
  for i = 1, rawlen(objects) do
    fields.expect_kind(fields.is_object(objects[i]), objects[i],
      "merge: item %d must be an object", i)
    nodes[i] = collect(native.anatomy(objects[i], true), {})
  end
  return mode, nodes, options.texture
end

--- Objects as one shape, with the texture of the first unless another is given.
---@param objects celspan.shape[]
---@param options? { mode?: "merge"|"add"|"subtract"|"intersect"|"exclude", fill?: celspan.surface }
---@return celspan.object
function merge.merged(objects, options)
  local mode, nodes, texture = read(objects, options or {})
  local first, all = nil, {}
  for _, list in ipairs(nodes) do
    first = first or list[1]
    table.move(list, 1, #list, #all + 1, all)
  end
  if not first then return celspan.union {} end
  if not texture and first.filled then
    refuse "the first object is filled with a pattern; give the field 'fill'"
  end
  texture = texture or texture_of(first)
  if mode == "merge" then return join(all, texture) end
  return operators[mode](table.move(objects, 1, #objects, 1, {})):paint(texture)
end

return fields.seal("merge", merge)
