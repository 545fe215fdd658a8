--- Copies of an object, each moved further than the one before it: celspan.repeater.
--
--   offset 0       copy 0   copy 1   copy 2      Copy i is moved, turned and scaled i + offset
--                    o        o        o         times. Lengths of the movement are those of the
--                                                first step: scaling acts about the centre alone.
local celspan = require "celspan"
local affine = require "celspan.affine"
local native = require "celspan.native"
local fields = require "celspan.fields"

local repeater = {}

local COUNT_MOST = 10000
local LARGEST = 1e12 -- of the numbers of a transform

local known = { count = "number", offset = "number", translate = "table", rotate = "number",
                scale = "any", centre = "table", opacity = "table", order = "string",
                each = "function" }

local function refuse(text, ...) native.refuse("repeater: " .. text:format(...)) end

--- A list of two numbers, or its default.
local function read_pair(options, name, first, second)
  local pair = options[name]
  if not pair then return first, second end
  fields.numbers("repeater", name .. "[%d]", pair, 2, "{" .. (name == "opacity" and "from, to"
    or "x, y") .. "}")
  return pair[1], pair[2]
end

local function read_scale(scale, offset)
  if scale == nil then return 1, 1 end
  local list = fields.is_finite(scale) and { scale, scale } or scale
  fields.numbers("repeater", "scale[%d]", list, 2, "a number or {x, y}")
  for i = 1, 2 do
    if list[i] < 0 and offset ~= math.floor(offset) then
      refuse("a scale below 0 goes with a whole offset alone: %s to the power of %s is no number",
        fields.shown(list[i]), fields.shown(offset))
    end
    fields.expect(list[i] ~= 0 or offset >= 0, offset,
      "repeater: a scale of 0 goes with an offset of 0 or more")
  end
  return list[1], list[2]
end

local function check_opacity(options)
  local from, to = read_pair(options, "opacity", 1, 1)
  for _, value in ipairs { from, to } do
    fields.must(value >= 0 and value <= 1, "repeater: opacity", "from 0 to 1", value)
  end
  return from, to
end

local function is_moderate(map)
  for i = 1, 6 do
    local is_small = math.abs(map[i]) <= LARGEST -- false for NaN
    if not is_small then return false end
  end
  return true
end

--- How a copy is transformed: a function of the number of steps.
local function mover(options, offset)
  local dx, dy = read_pair(options, "translate", 0, 0)
  local cx, cy = read_pair(options, "centre", 0, 0)
  local sx, sy = read_scale(options.scale, offset)
  local turn = options.rotate or 0
  return function(k)
    local map = affine.compose(affine.turn(k * turn, cx, cy),
      affine.stretch(sx ^ k, sy ^ k, 1, 0, cx, cy))
    map[3], map[6] = map[3] + k * dx, map[6] + k * dy
    return is_moderate(map) and affine.matrix(map)
  end
end

local function check_order(order)
  if order ~= nil and order ~= "above" and order ~= "below" then
    refuse("field 'order' must be \"above\" or \"below\", got %q", order)
  end
end

--- Copy i, transformed, faded and given to the function `each`; nil: nothing.
local function copy_of(object, matrix, opacity, each, i)
  local copy = object:transform(matrix)
  if opacity < 1 then copy = copy:fade(opacity) end
  if not each then return copy end
  copy = each(copy, i)
  if copy ~= nil and not fields.is_object(copy) then
    refuse("the function must return an object or nil, got %s for copy %d", fields.kind(copy), i)
  end
  return copy
end

--- Copies of an object, each moved, turned, scaled and faded further.
---@param object celspan.shape
---@param options { count: integer, offset?: number, translate?: celspan.point, rotate?: number, scale?: number|number[], centre?: celspan.point, opacity?: number[], order?: "above"|"below", each?: fun(copy: celspan.object, i: integer): celspan.object? }
---@return celspan.object
function repeater.copies(object, options)
  fields.object("repeater", object)
  options = fields.check("repeater", options, known)
  local count = fields.whole("repeater: field 'count'", options.count, 0, COUNT_MOST)
  local offset = options.offset or 0
  local matrix_at, copies = mover(options, offset), {}
  local from, to = check_opacity(options)
  check_order(options.order)
  for i = 0, count - 1 do
    local matrix = matrix_at(i + offset)
    if not matrix then refuse("copy %d would be moved or scaled by more than 1e12", i) end
    local opacity = count > 1 and from + (to - from) * i / (count - 1) or from
    copies[#copies + 1] = copy_of(object, matrix, opacity, options.each, i)
  end
  if options.order ~= "below" then return celspan.union(copies) end
  local backwards = {}
  for i = #copies, 1, -1 do backwards[#backwards + 1] = copies[i] end
  return celspan.union(backwards)
end

return fields.seal("repeater", repeater)
