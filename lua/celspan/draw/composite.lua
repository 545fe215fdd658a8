--- Two objects by the operators of Porter and Duff: celspan.composite.
--
--            over        in         out        atop        xor
--   a only   a           -          a          -           a
--   both     a over b    a          -          a           -
--   b only   b           -          -          b           b
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"

local composite = {}

local function without(art, by) return celspan.matte(art, by, { invert = true }) end

--- The sum of two premultiplied paints that together are never more than whole.
local function sum(rear, front)
  return celspan.group { rear, front:blend "add", isolate = true }
end

local operators = {
  over = function(a, b) return celspan.group { b, a } end,
  ["in"] = function(a, b) return celspan.matte(a, b) end,
  out = without,
  atop = function(a, b) return sum(without(b, a), celspan.matte(a, b)) end,
  xor = function(a, b) return sum(without(b, a), without(a, b)) end,
}

--- What to write for nodes of other compositors. The modes of a source over a backdrop take the
--- source from the backdrop and divide the backdrop by it.
local nodes = {
  erode = "celspan.matte(art, by, { grow = -1 })", choke = "celspan.matte(art, by, { grow = -1 })",
  dilate = "celspan.matte(art, by, { grow = 1 })",
  feather = "celspan.matte(art, by, { feather = 4 })",
  keyer = "celspan.key { art, luma = true, from = 0, to = 1 }",
  chromakey = 'celspan.key { art, colour = "#0b0" }',
  keylight = 'celspan.key { art, colour = "#0b0" }',
  premult = 'celspan.picture { file = name, alpha = "straight" }',
  unpremult = 'celspan.picture { file = name, alpha = "premultiplied" }',
  over = 'celspan.composite(a, b, "over")', atop = 'celspan.composite(a, b, "atop")',
  under = 'celspan.composite(b, a, "over")', stencil = 'celspan.composite(b, a, "out")',
  keymix = "celspan.group { b, celspan.matte(a, mask) }",
  holdout = 'celspan.composite(a, b, "out")',
  plus = 'a:blend "add"', minus = 'b:blend "subtract"', max = 'a:blend "lighten"',
  min = 'a:blend "darken"', multiply = 'a:blend "multiply"', screen = 'a:blend "screen"',
  difference = 'a:blend "difference"', divide = 'b:blend "divide"',
  exclusion = 'a:blend "exclusion"',
  wiggle = "motion.wiggle(seed):at(f.time)", time = "f.time, in the frame function",
}

--- The same for ways to merge whose names are words of their own elsewhere.
local ways = {
  mask = 'celspan.composite(b, a, "in")', copy = "a", matte = 'celspan.composite(a, b, "over")',
  ["hold-out"] = 'celspan.composite(a, b, "out")', from = 'a:blend "subtract"',
}

--- What to write for the name of a node, or nil.
function composite.instead(name) return nodes[name] end

local function refuse(operator)
  local advice = ways[operator or false] or nodes[operator or false]
  local got = type(operator) == "string" and ("%q"):format(operator) or fields.kind(operator)
  native.refuse(("composite: the operator must be \"over\", \"in\", \"out\", \"atop\" or \"xor\", "
    .. "got %s%s"):format(got, advice and "; write " .. advice or ""))
end

--- Two objects by an operator of Porter and Duff.
---@param a celspan.shape The source, in front
---@param b celspan.shape The backdrop
---@param operator "over"|"in"|"out"|"atop"|"xor"
---@return celspan.object
function composite.of(a, b, operator)
  for i, object in pairs { a or false, b or false } do
    fields.expect_kind(fields.is_object(object), object or nil,
      "composite: argument %d must be an object", i)
  end
  local combine = operators[operator]
  if not combine then refuse(operator) end
  return combine(a, b)
end

return fields.seal("composite", composite)
