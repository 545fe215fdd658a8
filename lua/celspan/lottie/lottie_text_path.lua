--- Texts of Lottie along a mask of their layer.
--
--        first margin       last margin, below 0 inside
--   *----|--- t e x t ---|----*          perpendicular: letters turn with the way
local affine = require "celspan.affine"
local contours = require "celspan.lottie_contour"
local paint = require "celspan.lottie_paint"
local property = require "celspan.lottie_property"
local values = require "celspan.lottie_values"

local text_path = {}

local SAMPLES = 32 -- of the length of a cubic
local MOST_PIECES = 10000

-- ---------------------------------------------------------------- ways

--- The point of a cubic, and its direction.
local function cubic(p, u)
  local v = 1 - u
  local a, b, c, d = v * v * v, 3 * v * v * u, 3 * v * u * u, u * u * u
  local e, f, g = v * v, 2 * v * u, u * u
  return a * p[1] + b * p[3] + c * p[5] + d * p[7], a * p[2] + b * p[4] + c * p[6] + d * p[8],
    e * (p[3] - p[1]) + f * (p[5] - p[3]) + g * (p[7] - p[5]),
    e * (p[4] - p[2]) + f * (p[6] - p[4]) + g * (p[8] - p[6])
end

--- An outline as { at =, piece =, u = } at even parameters, `at` being the length so far.
local function measure(list)
  local way, length, x, y = { closed = list.closed }, 0, nil, nil
  for n = 1, math.min(contours.count(list), MOST_PIECES) do
    local piece = { contours.piece(list, n) }
    for i = n == 1 and 0 or 1, SAMPLES do
      local nx, ny = cubic(piece, i / SAMPLES)
      length = length + (x and math.sqrt((nx - x) ^ 2 + (ny - y) ^ 2) or 0)
      way[#way + 1] = { at = length, piece = piece, u = i / SAMPLES }
      x, y = nx, ny
    end
  end
  way.length = length
  return length > 0 and way or nil
end

--- The place of a length between two samples: a cubic and its parameter.
local function find(way, length)
  local low, high = 1, #way - 1
  while low < high do
    local middle = (low + high + 1) // 2
    if way[middle].at <= length then low = middle else high = middle - 1 end
  end
  local a, b = way[low], way[low + 1]
  local from = a.piece == b.piece and a.u or 0
  local share = b.at > a.at and (length - a.at) / (b.at - a.at) or 0
  return b.piece, from + share * (b.u - from)
end

--- The point and the angle at a length. A closed way has no end; an open one continues straight.
local function along(way, length)
  if way.closed then length = length % way.length end
  local on = math.max(0, math.min(way.length, length))
  local piece, u = find(way, on)
  local x, y, dx, dy = cubic(piece, u)
  if dx == 0 and dy == 0 then
    local _
    _, _, dx, dy = cubic(piece, u < 0.5 and u + 1e-4 or u - 1e-4)
  end
  local angle = math.atan(dy, dx)
  local beyond = length - on
  return x + beyond * math.cos(angle), y + beyond * math.sin(angle), angle
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
    return measure(reversed(t) ~= 0 and contours.reverse(list) or list) or false
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
