--- Outlines of Lottie as lists of numbers, six for each vertex, all absolute:
--
--   { x, y, in x, in y, out x, out y, ..., closed = true }
--
--       in o---*---o out        a vertex and its handles
--
-- Lists of one length can be mixed number by number. They are never changed.
local values = require "celspan.lottie_values"

local contours = {}

local ROUND = 0.5519150244935106 -- of a quarter of a circle, in radii
local MOST_POINTS = 1000 -- of a star

--- Adds a vertex and its handles.
local function add(list, x, y, ix, iy, ox, oy)
  local k = #list
  list[k + 1], list[k + 2], list[k + 3], list[k + 4], list[k + 5], list[k + 6] = x, y, ix, iy, ox,
    oy
end

--- Two numbers of a file.
local function pair(given)
  if type(given) ~= "table" then return values.number(given, 0), 0 end
  return values.number(given[1], 0), values.number(given[2], 0)
end

--- An outline of a file. closed: what is written beside it, in old files.
function contours.read(given, closed)
  local list = { closed = closed and true or false }
  if not values.table(given) then return list end
  if given.c ~= nil then list.closed = values.flag(given.c) end
  local into, out = values.table(given.i) or {}, values.table(given.o) or {}
  for n, point in ipairs(values.table(given.v) or {}) do
    if values.table(point) then
      local x, y = pair(point)
      local ix, iy = pair(into[n])
      local ox, oy = pair(out[n])
      add(list, x, y, x + ix, y + iy, x + ox, y + oy)
    end
  end
  return list
end

--- The same outline in the other direction, from the same vertex.
function contours.reverse(list)
  local turned, count = { closed = list.closed }, #list // 6
  for n = 0, count - 1 do
    local from = list.closed and (count - n) % count or count - 1 - n
    local a, b = 6 * n, 6 * from
    turned[a + 1], turned[a + 2] = list[b + 1], list[b + 2]
    turned[a + 3], turned[a + 4] = list[b + 5], list[b + 6]
    turned[a + 5], turned[a + 6] = list[b + 3], list[b + 4]
  end
  return turned
end

--- map: as of celspan.affine.
function contours.transform(list, map)
  local a, b, c, d, e, f = map[1], map[2], map[3], map[4], map[5], map[6]
  local moved = { closed = list.closed }
  for i = 1, #list, 2 do
    local x, y = list[i], list[i + 1]
    moved[i], moved[i + 1] = a * x + b * y + c, d * x + e * y + f
  end
  return moved
end

--- The numbers of the cubic from vertex n to the next one.
function contours.piece(list, n)
  local a = 6 * (n - 1)
  local b = a + 6 < #list and a + 6 or 0
  return list[a + 1], list[a + 2], list[a + 5], list[a + 6], list[b + 3], list[b + 4], list[b + 1],
    list[b + 2]
end

--- How many cubics there are.
function contours.count(list)
  local vertices = #list // 6
  return list.closed and vertices or math.max(0, vertices - 1)
end

local format = string.format

--- Adds one outline to a list of texts.
local function write(list, parts)
  if #list < 6 then return end
  parts[#parts + 1] = format("M%.9g %.9g", list[1], list[2])
  for n = 1, contours.count(list) do
    local x0, y0, x1, y1, x2, y2, x3, y3 = contours.piece(list, n)
    if x0 == x1 and y0 == y1 and x2 == x3 and y2 == y3 then
      parts[#parts + 1] = format("L%.9g %.9g", x3, y3)
    else
      parts[#parts + 1] = format("C%.9g %.9g %.9g %.9g %.9g %.9g", x1, y1, x2, y2, x3, y3)
    end
  end
  if list.closed then parts[#parts + 1] = "Z" end
end

--- Path data of several outlines; "" if there is nothing.
function contours.data(lists)
  local parts = {}
  for _, list in ipairs(lists) do write(list, parts) end
  return table.concat(parts)
end

--- Whether a cubic, six numbers before and after place k, is a straight line in even steps.
local function is_side(c, k)
  local size = math.abs(c[k + 7] - c[k + 1]) + math.abs(c[k + 8] - c[k + 2])
  local function is_third(x, a, b) return math.abs(3 * x - 2 * a - b) <= 1e-6 * size end
  return is_third(c[k + 3], c[k + 1], c[k + 7]) and is_third(c[k + 4], c[k + 2], c[k + 8])
    and is_third(c[k + 5], c[k + 7], c[k + 1]) and is_third(c[k + 6], c[k + 8], c[k + 2])
end

--- The outline of a contour as core.anatomy gives it: a point, and six numbers for each cubic. Its
--- straight sides get no handles.
function contours.of_cubics(c)
  local list, count = { closed = not c.open }, (#c - 2) // 6
  for n = 0, count do
    local k = 6 * n
    for i = 1, 5, 2 do list[k + i], list[k + i + 1] = c[k + 1], c[k + 2] end
  end
  for k = 0, 6 * (count - 1), 6 do
    if not is_side(c, k) then
      list[k + 5], list[k + 6], list[k + 9], list[k + 10] = c[k + 3], c[k + 4], c[k + 5], c[k + 6]
    end
  end
  local last = 6 * count
  if list.closed and count > 0 and list[1] == list[last + 1] and list[2] == list[last + 2] then
    list[3], list[4] = list[last + 3], list[last + 4]
    for i = last + 6, last + 1, -1 do list[i] = nil end
  end
  return list
end

-- ---------------------------------------------------------------- forms

--- An ellipse, clockwise from its top.
function contours.ellipse(x, y, rx, ry)
  local list, kx, ky = { closed = true }, ROUND * rx, ROUND * ry
  add(list, x, y - ry, x - kx, y - ry, x + kx, y - ry)
  add(list, x + rx, y, x + rx, y - ky, x + rx, y + ky)
  add(list, x, y + ry, x + kx, y + ry, x - kx, y + ry)
  add(list, x - rx, y, x - rx, y + ky, x - rx, y - ky)
  return list
end

--- A rectangle about x, y, clockwise from its top right corner.
function contours.rectangle(x, y, w, h, radius)
  local list, l, r, t, b = { closed = true }, x - w / 2, x + w / 2, y - h / 2, y + h / 2
  radius = math.max(0, math.min(radius, math.abs(w) / 2, math.abs(h) / 2))
  if radius == 0 then
    for _, p in ipairs { { r, t }, { r, b }, { l, b }, { l, t } } do
      add(list, p[1], p[2], p[1], p[2], p[1], p[2])
    end
    return list
  end
  local k, q = radius * (1 - ROUND), radius
  add(list, r, t + q, r, t + k, r, t + q)
  add(list, r, b - q, r, b - q, r, b - k)
  add(list, r - q, b, r - k, b, r - q, b)
  add(list, l + q, b, l + q, b, l + k, b)
  add(list, l, b - q, l, b - k, l, b - q)
  add(list, l, t + q, l, t + q, l, t + k)
  add(list, l + q, t, l + k, t, l + q, t)
  add(list, r - q, t, r - q, t, r - k, t)
  return list
end

--- A star, or a regular polygon without `inner`: points on two circles. outer, inner: { radius,
--- roundness 0..1 }.
function contours.star(x, y, points, turn, outer, inner)
  local list = { closed = true }
  points = math.max(0, math.min(MOST_POINTS, math.floor(points)))
  local count = inner and 2 * points or points
  for n = 0, count - 1 do
    local ring = inner and n % 2 == 1 and inner or outer
    local angle = math.rad(turn - 90) + 2 * math.pi * n / count
    local c, s = math.cos(angle), math.sin(angle)
    local reach = 2 * math.pi * ring[1] / (count * (inner and 2 or 4)) * ring[2]
    local px, py = x + ring[1] * c, y + ring[1] * s
    add(list, px, py, px + reach * s, py - reach * c, px - reach * s, py + reach * c)
  end
  return list
end

-- ---------------------------------------------------------------- corners

--- Cuts a corner: adds the two vertices that replace it.
local function round_corner(list, corner, before, after, radius)
  local function toward(x, y)
    local dx, dy = x - corner[1], y - corner[2]
    local length = math.sqrt(dx * dx + dy * dy)
    local share = length > 0 and math.min(length / 2, radius) / length or 0
    return corner[1] + share * dx, corner[2] + share * dy
  end
  local ax, ay = toward(before[1], before[2])
  local bx, by = toward(after[1], after[2])
  local function handle(x, y)
    return x + ROUND * (corner[1] - x), y + ROUND * (corner[2] - y)
  end
  local aox, aoy = handle(ax, ay)
  local bix, biy = handle(bx, by)
  add(list, ax, ay, ax, ay, aox, aoy)
  add(list, bx, by, bix, biy, bx, by)
end

--- Rounds the vertices that have no handles.
function contours.round(list, radius)
  local rounded, count = { closed = list.closed }, #list // 6
  if radius <= 0 then return list end
  for n = 1, count do
    local a = 6 * (n - 1)
    local is_end = not list.closed and (n == 1 or n == count)
    local is_sharp = list[a + 1] == list[a + 3] and list[a + 2] == list[a + 4]
      and list[a + 1] == list[a + 5] and list[a + 2] == list[a + 6]
    if is_end or not is_sharp then
      add(rounded, list[a + 1], list[a + 2], list[a + 3], list[a + 4], list[a + 5], list[a + 6])
    else
      local before, after = 6 * ((n - 2) % count), 6 * (n % count)
      round_corner(rounded, { list[a + 1], list[a + 2] }, { list[before + 1], list[before + 2] },
        { list[after + 1], list[after + 2] }, radius)
    end
  end
  return rounded
end

--- Moves vertices toward the middle of all, and handles away from it, by a share; below 0 the other
--- way.
function contours.pucker(list, share)
  local x, y, count = 0, 0, #list // 6
  for n = 0, count - 1 do x, y = x + list[6 * n + 1] / count, y + list[6 * n + 2] / count end
  local changed = { closed = list.closed }
  for i = 1, #list, 2 do
    local k = i % 6 == 1 and share or -share
    changed[i], changed[i + 1] = list[i] + (x - list[i]) * k, list[i + 1] + (y - list[i + 1]) * k
  end
  return changed
end

return require "celspan.fields".seal("lottie_contour", contours)
