--- Outlines of Lottie as contours of celspan.path, made of vertices:
--
--       in o---*---o out        a vertex and its handles, all absolute
--
-- Lists of one length can be mixed number by number. They are never changed.
local values = require "celspan.lottie_values"

local contours = {}

local ROUND = 0.5519150244935106 -- of a quarter of a circle, in radii
local MOST_POINTS = 1000 -- of a star

--- Adds a vertex and its handles; `finish` then makes the list a contour.
local function add(list, x, y, ix, iy, ox, oy)
  local k = #list
  if k == 0 then
    list[1], list[2], list.ix, list.iy = x, y, ix, iy
  else
    list[k + 1], list[k + 2], list[k + 3], list[k + 4] = list.ox, list.oy, ix, iy
    list[k + 5], list[k + 6] = x, y
  end
  list.ox, list.oy = ox, oy
end

--- The last piece of a closed contour leads to its first vertex.
local function finish(list, closed)
  if closed and list[1] then add(list, list[1], list[2], list.ix, list.iy) end
  list.ix, list.iy, list.ox, list.oy, list.closed = nil, nil, nil, nil, closed
  return list
end

--- Two numbers of a file.
local function pair(given)
  if type(given) ~= "table" then return values.number(given, 0), 0 end
  return values.number(given[1], 0), values.number(given[2], 0)
end

--- An outline of a file. closed: what is written beside it, in old files. is_sure: whatever the
--- outline itself says of it.
function contours.read(given, closed, is_sure)
  local list = {}
  if not values.table(given) then return { closed = closed } end
  if given.c ~= nil and not is_sure then closed = values.flag(given.c) end
  local into, out = values.table(given.i) or {}, values.table(given.o) or {}
  for n, point in ipairs(values.table(given.v) or {}) do
    if values.table(point) then
      local x, y = pair(point)
      local ix, iy = pair(into[n])
      local ox, oy = pair(out[n])
      add(list, x, y, x + ix, y + iy, x + ox, y + oy)
    end
  end
  return finish(list, closed)
end

-- ---------------------------------------------------------------- forms

--- An ellipse, clockwise from its top.
function contours.ellipse(x, y, rx, ry)
  local list, kx, ky = {}, ROUND * rx, ROUND * ry
  add(list, x, y - ry, x - kx, y - ry, x + kx, y - ry)
  add(list, x + rx, y, x + rx, y - ky, x + rx, y + ky)
  add(list, x, y + ry, x + kx, y + ry, x - kx, y + ry)
  add(list, x - rx, y, x - rx, y + ky, x - rx, y - ky)
  return finish(list, true)
end

--- A rectangle about x, y, clockwise from its top right corner.
function contours.rectangle(x, y, w, h, radius)
  local list, l, r, t, b = {}, x - w / 2, x + w / 2, y - h / 2, y + h / 2
  radius = math.max(0, math.min(radius, math.abs(w) / 2, math.abs(h) / 2))
  if radius == 0 then
    for _, p in ipairs { { r, t }, { r, b }, { l, b }, { l, t } } do
      add(list, p[1], p[2], p[1], p[2], p[1], p[2])
    end
    return finish(list, true)
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
  return finish(list, true)
end

--- A star, or a regular polygon without `inner`: points on two circles. outer, inner: { radius,
--- roundness 0..1 }.
function contours.star(x, y, points, turn, outer, inner)
  local list = {}
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
  return finish(list, true)
end

-- ---------------------------------------------------------------- corners

--- Cuts the corner x, y between two vertices: adds the two vertices that replace it.
local function round_corner(list, x, y, before_x, before_y, after_x, after_y, radius)
  local function toward(to_x, to_y)
    local dx, dy = to_x - x, to_y - y
    local length = math.sqrt(dx * dx + dy * dy)
    local share = length > 0 and math.min(length / 2, radius) / length or 0
    return x + share * dx, y + share * dy
  end
  local ax, ay = toward(before_x, before_y)
  local bx, by = toward(after_x, after_y)
  add(list, ax, ay, ax, ay, ax + ROUND * (x - ax), ay + ROUND * (y - ay))
  add(list, bx, by, bx + ROUND * (x - bx), by + ROUND * (y - by), bx, by)
end

--- Rounds the vertices that have no handles.
function contours.round(list, radius)
  local rounded, last, closed = {}, #list - 1, list.closed
  if radius <= 0 then return list end
  for a = 1, closed and last - 6 or last, 6 do
    local x, y, is_end = list[a], list[a + 1], not closed and (a == 1 or a == last)
    local into, out = a > 1 and a - 2 or closed and last - 2 or a, a < last and a + 2 or a
    local is_sharp = x == list[into] and y == list[into + 1] and x == list[out]
      and y == list[out + 1]
    if is_end or not is_sharp then
      add(rounded, x, y, list[into], list[into + 1], list[out], list[out + 1])
    else
      local before, after = a > 1 and a - 6 or last - 6, a + 6
      round_corner(rounded, x, y, list[before], list[before + 1], list[after], list[after + 1],
        radius)
    end
  end
  return finish(rounded, closed)
end

return require "celspan.fields".seal("lottie_contour", contours)
