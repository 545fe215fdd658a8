--- Parts of outlines by their length: trim paths.
--
--   cut(outlines, 0.2, 0.7)     the part between two shares of the length of all, one after another
local contours = require "celspan.lottie_contour"

local trim = {}

local STEPS = 5 -- of Newton's method; each doubles the number of right digits
local PARTS = 4 -- of a piece, in which Gauss's rule is used

--- Places 0..1 and weights of Gauss's rule with five nodes in each part.
local places, weights = {}, {}
for part = 0, PARTS - 1 do
  for _, node in ipairs { { 0, 128 / 225 }, { 0.5384693101056831, 0.47862867049936647 },
                          { -0.5384693101056831, 0.47862867049936647 },
                          { 0.9061798459386640, 0.23692688505618908 },
                          { -0.9061798459386640, 0.23692688505618908 } } do
    places[#places + 1] = (2 * part + 1 + node[1]) / (2 * PARTS)
    weights[#weights + 1] = node[2] / (2 * PARTS)
  end
end

--- The derivative of a cubic as polynomials: ax u^2 + bx u + cx, and likewise in y.
local function slopes(p)
  local x1, x2, x3 = 3 * (p[3] - p[1]), 3 * (p[5] - p[3]), 3 * (p[7] - p[5])
  local y1, y2, y3 = 3 * (p[4] - p[2]), 3 * (p[6] - p[4]), 3 * (p[8] - p[6])
  return x3 - 2 * x2 + x1, 2 * (x2 - x1), x1, y3 - 2 * y2 + y1, 2 * (y2 - y1), y1
end

local function speed(p, u)
  local ax, bx, cx, ay, by, cy = slopes(p)
  local dx, dy = (ax * u + bx) * u + cx, (ay * u + by) * u + cy
  return math.sqrt(dx * dx + dy * dy)
end

--- The length from the start to u.
local function length_to(p, u)
  local ax, bx, cx, ay, by, cy = slopes(p)
  local sum, sqrt = 0, math.sqrt
  for i = 1, #places do
    local v = u * places[i]
    local dx, dy = (ax * v + bx) * v + cx, (ay * v + by) * v + cy
    sum = sum + weights[i] * sqrt(dx * dx + dy * dy)
  end
  return sum * u
end

local function is_straight(p)
  return p[1] == p[3] and p[2] == p[4] and p[5] == p[7] and p[6] == p[8]
end

--- The length of a piece.
local function length_of_piece(p)
  if not is_straight(p) then return length_to(p, 1) end
  return math.sqrt((p[7] - p[1]) ^ 2 + (p[8] - p[2]) ^ 2)
end

--- The parameter at a length of a piece.
local function parameter(piece, length)
  local p, u = piece.points, length / piece.length
  if u <= 0 then return 0 end
  if u >= 1 then return 1 end
  for _ = 1, is_straight(p) and 2 * STEPS or STEPS do
    local slope = speed(p, u)
    if slope < 1e-9 * piece.length then break end
    u = math.max(0, math.min(1, u - (length_to(p, u) - length) / slope))
  end
  return u
end

--- What is known of outlines: their pieces and lengths, kept as long as the outlines are.
local known = setmetatable({}, { __mode = "k" })

local function measure(list)
  if known[list] then return known[list] end
  local way = { length = 0 }
  for n = 1, contours.count(list) do
    local piece = { points = { contours.piece(list, n) } }
    piece.start, piece.length = way.length, length_of_piece(piece.points)
    way[n], way.length = piece, way.length + piece.length
  end
  known[list] = way
  return way
end

--- The part of a cubic between two parameters.
local function part_of(p, u, v)
  local function point(a, b, c) -- the blossom
    local function axis(k)
      local x = (1 - a) * p[k] + a * p[k + 2]
      local y = (1 - a) * p[k + 2] + a * p[k + 4]
      local z = (1 - a) * p[k + 4] + a * p[k + 6]
      x, y = (1 - b) * x + b * y, (1 - b) * y + b * z
      return (1 - c) * x + c * y
    end
    return axis(1), axis(2)
  end
  local x0, y0 = point(u, u, u)
  local x1, y1 = point(u, u, v)
  local x2, y2 = point(u, v, v)
  local x3, y3 = point(v, v, v)
  return { x0, y0, x1, y1, x2, y2, x3, y3 }
end

--- Appends a cubic to an open outline.
local function append(list, p)
  local k = #list
  if k == 0 then
    list[1], list[2], list[3], list[4] = p[1], p[2], p[1], p[2]
    list[5], list[6] = p[3], p[4]
    k = 6
  else
    list[k - 1], list[k] = p[3], p[4]
  end
  list[k + 1], list[k + 2], list[k + 3], list[k + 4] = p[7], p[8], p[5], p[6]
  list[k + 5], list[k + 6] = p[7], p[8]
end

--- Appends the part of an outline between two lengths.
local function add_part(way, from, to, out)
  for _, piece in ipairs(way) do
    local a, b = from - piece.start, to - piece.start
    if b > 0 and a < piece.length and piece.length > 0 then
      if a <= 0 and b >= piece.length then
        append(out, piece.points)
      else
        append(out, part_of(piece.points, parameter(piece, a), parameter(piece, b)))
      end
    end
  end
end

--- The part of several outlines between two lengths, as new outlines.
local function add_parts(lists, from, to, out)
  local start = 0
  for _, list in ipairs(lists) do
    local way = measure(list)
    local a, b = math.max(0, from - start), math.min(way.length, to - start)
    if a <= 0 and b >= way.length and way.length > 0 then
      out[#out + 1] = list
    elseif a < b then
      local part = { closed = false }
      add_part(way, a, b, part)
      if #part > 0 then out[#out + 1] = part end
    end
    start = start + way.length
  end
end

local function length_of(lists)
  local length = 0
  for _, list in ipairs(lists) do length = length + measure(list).length end
  return length
end

--- The parts on both sides of a gap; of one closed outline they are one part.
local function around(lists, length, from, to)
  local out = {}
  if #lists == 1 and lists[1].closed then
    local part = { closed = false }
    add_part(measure(lists[1]), to * length, length, part)
    add_part(measure(lists[1]), 0, from * length, part)
    return #part > 0 and { part } or {}
  end
  add_parts(lists, to * length, length, out)
  add_parts(lists, 0, from * length, out)
  return out
end

--- The outlines between two shares of their length, moved by a share. from and to may change
--- places.
function trim.cut(lists, from, to, offset)
  from = math.max(0, math.min(1, from))
  to = math.max(0, math.min(1, to))
  local a, b = math.min(from, to) + offset, math.max(from, to) + offset
  if b - a >= 1 then return lists end
  if b <= a then return {} end
  a, b = a - math.floor(a), b - math.floor(b)
  local length = length_of(lists)
  if a > b then return around(lists, length, b, a) end
  local out = {}
  add_parts(lists, a * length, b * length, out)
  return out
end

return require "celspan.fields".seal("lottie_trim", trim)
