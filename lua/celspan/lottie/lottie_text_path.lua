--- Texts of Lottie along a mask of their layer.
--
--        first margin       last margin, below 0 inside
--   *----|--- t e x t ---|----*          perpendicular: letters turn with the way
local affine = require "celspan.affine"
local curves = require "celspan.curves"
local paint = require "celspan.lottie_paint"
local property = require "celspan.lottie_property"
local values = require "celspan.lottie_values"

local text_path = {}

--- The point and the angle at a length. A closed way has no end; an open one continues straight.
local function along(way, length)
  if way.is_closed then length = length % way.length end
  local x, y, dx, dy = way:at(length)
  return x, y, math.atan(dy, dx)
end

-- ---------------------------------------------------------------- places

--- Where the middles of the letters of all lines lie, as lengths of the way.
local function middles_of(list, justify, from, to, is_forced)
  local start = ({ [0] = from, to, (from + to) / 2 })[justify] or from
  local last, place, places = {}, {}, {}
  for i, letter in ipairs(list) do
    last[letter.line] = (last[letter.line] or 0) + 1
    place[i] = last[letter.line] - 1
  end
  local first = {}
  for i, letter in ipairs(list) do
    first[letter.line] = first[letter.line] or letter
    local half = first[letter.line].advance / 2
    local count = last[letter.line]
    if is_forced and count > 1 then
      local ends = list[i - place[i] + count - 1].advance / 2
      places[i] = from + half + (to - from - half - ends) * place[i] / (count - 1)
    else
      places[i] = start + letter.x + letter.advance / 2
    end
  end
  return places
end

--- A function of the letters, the justification and the frame, that returns a function: the map of
--- the letter i, moved by a length, from its middle on the baseline. nil: the text has no path.
---@return (fun(list: table[], justify: number, t: number): function)?
---@return boolean moves
function text_path.compile(scope, item)
  local given = values.table(values.table(item.t) and item.t.p)
  if not given or type(given.m) ~= "number" then return nil, false end
  local masks = values.table(item.masksProperties)
  local mask = masks and values.table(masks[given.m + 1])
  if not mask then
    scope.note(("the text's path, the mask %g, is not in the file"):format(given.m))
    return nil, false
  end
  local read, moves = property.reader(scope)
  local outline = read(property.outline, mask.pt, "the text's path", mask.cl == true)
  local first = read(property.number, given.f, "the text's first margin", 0)
  local last = read(property.number, given.l, "the text's last margin", 0)
  local upright = read(property.number, given.p, "the text's perpendicularity", 1)
  local forced = read(property.number, given.a, "the text's alignment", 0)
  local reversed = read(property.number, given.r, "the text's direction", 0)
  local way = paint.memo(moves(), function(t)
    local list = outline(t)
    if #list == 0 then return false end
    local curve = curves.of("lottie", { reversed(t) ~= 0 and curves.reversed(list) or list })
    return curve and curve.length > 0 and curve or false
  end)
  return function(list, justify, t)
    local on = way(t)
    if not on then return nil end
    local places = middles_of(list, justify, first(t), on.length + last(t), forced(t) ~= 0)
    local turns = upright(t) ~= 0
    return function(i, by)
      local x, y, angle = along(on, places[i] + by)
      return affine.compose({ 1, 0, x, 0, 1, y }, affine.turn(turns and math.deg(angle) or 0, 0, 0))
    end
  end, moves()
end

return require "celspan.fields".seal("lottie_text_path", text_path)
