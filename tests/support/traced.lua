-- Random drawings, rasterised, traced and drawn again: the error of their edges.
local celspan = require "celspan"
local trace = require "celspan.trace"
local prng = require "tests.support.prng"

local traced = {}

local FINE = 4 -- samples per source pixel along each axis

local colours = { "#ffffff", "#1a1a24", "#d94f30", "#2f6fb0", "#f2c14e", "#4c9f70" }

-- ---------------------------------------------------------------- random drawings

--- A circle of radius 1 that is mapped to an ellipse: its centre, and the ends of both radii.
local function round(points)
  local c, u, v = points[1], points[2], points[3]
  return celspan.circle { centre = { 0, 0 }, radius = 1, texture = points.texture }:transform {
    u[1] - c[1], v[1] - c[1], c[1], u[2] - c[2], v[2] - c[2], c[2], 0, 0, 1 }
end

--- Two radii at right angles, the first one rotated by `turn` degrees.
local function radii(x, y, r, s, turn, texture)
  local cos, sin = math.cos(math.rad(turn)), math.sin(math.rad(turn))
  return { { x, y }, { x + r * cos, y + r * sin }, { x - s * sin, y + s * cos }, texture = texture }
end

--- A shape around (x, y), no part of which is farther from this point than r; no corner is sharper
--- than 60 degrees, and no bend narrower than a few pixels. Then the points that define it, and a
--- function that makes a similar one from other points.
local function shape(random, x, y, r, texture)
  local turn = random:between(0, 360)
  local kind = random:whole(1, 5)
  if kind == 1 then
    return celspan.circle { centre = { x, y }, radius = r, texture = texture },
      radii(x, y, r, r, 0, texture), round
  end
  if kind == 2 then
    local s = r * random:between(0.4, 1)
    local ellipse = celspan.ellipse { centre = { x, y }, radii = { r, s }, texture = texture }
    return ellipse:rotate(turn, x, y), radii(x, y, r, s, turn, texture), round
  end
  if kind == 3 then
    local w = r * random:between(0.8, 1.3)
    local ends = radii(x, y, w / 2, r / 2, turn, texture)
    local ux, uy, vx, vy = ends[2][1] - x, ends[2][2] - y, ends[3][1] - x, ends[3][2] - y
    return celspan.rect { x - w / 2, y - r / 2, w, r, texture = texture }:rotate(turn, x, y),
      { { x - ux - vx, y - uy - vy }, { x + ux - vx, y + uy - vy }, { x + ux + vx, y + uy + vy },
        { x - ux + vx, y - uy + vy }, texture = texture }, celspan.polygon
  end
  local points = { texture = texture }
  if kind == 4 then
    local count = random:whole(3, 6)
    for i = 1, count do
      local angle = math.rad(turn + 360 * i / count)
      points[i] = { x + r * math.cos(angle), y + r * math.sin(angle) }
    end
    return celspan.polygon(points), points, celspan.polygon
  end
  for i = 1, 7 do
    local angle, far = math.rad(turn + 360 * i / 7), r * random:between(0.7, 1)
    points[i] = { x + far * math.cos(angle), y + far * math.sin(angle) }
  end
  local function smooth(list) return celspan.nurbs { points = list, texture = texture } end
  return smooth(points), points, smooth
end

--- Shapes that do not touch, on a ground, with a circle in some: a list, the ground first, its
--- size, and for each but the ground the points that define it and a function that makes one from
--- such points.
local function shapes_of(random)
  local cell, columns, rows = random:whole(28, 50), random:whole(1, 3), random:whole(1, 2)
  local w, h = cell * columns + random:whole(0, 9), cell * rows + random:whole(0, 9)
  local list, points, make = { celspan.rect { 0, 0, w, h, texture = colours[1] } }, {}, {}
  for column = 0, columns - 1 do
    for row = 0, rows - 1 do
      local r = random:between(0.25, 0.45) * cell
      local x = (column + 0.5) * cell + random:between(-0.04, 0.04) * cell
      local y = (row + 0.5) * cell + random:between(-0.04, 0.04) * cell
      local n = random:whole(2, 6)
      local at = #list + 1
      list[at], points[at], make[at] = shape(random, x, y, r, colours[n])
      if random:once(2) then
        local texture = colours[n == 6 and 2 or n + 1]
        at = at + 1
        list[at] = celspan.circle { centre = { x, y }, radius = r * 0.3, texture = texture }
        points[at], make[at] = radii(x, y, r * 0.3, r * 0.3, 0, texture), round
      end
    end
  end
  return list, w, h, points, make
end

local function drawing(random)
  local list, w, h = shapes_of(random)
  return celspan.union(list), w, h
end

-- ---------------------------------------------------------------- how far edges are off

--- The paint at n x n places of every pixel, as numbers in a list.
local function sampled(object, w, h, n)
  local image = celspan.pixels(celspan.rostrum { antialias = "none", celspan.cel { object } },
    { film = { w, h }, size = { w * n, h * n } })
  local bytes, list = image:bytes { depth = 8 }, {}
  for i = 1, #bytes // 4 do list[i] = string.unpack("<I4", bytes, 4 * i - 3) end
  return list
end

--- Offsets in the order of their distance, up to two source pixels of n samples.
local function rings_of(n)
  local rings = {}
  for dy = -2 * n, 2 * n do
    for dx = -2 * n, 2 * n do rings[#rings + 1] = { dx, dy, dx * dx + dy * dy } end
  end
  table.sort(rings, function(a, b)
    if a[3] ~= b[3] then return a[3] < b[3] end
    if a[2] ~= b[2] then return a[2] < b[2] end
    return a[1] < b[1]
  end)
  return rings
end
local rings = { [FINE] = rings_of(FINE) }

--- The distance of the nearest sample with that paint, in source pixels.
local function nearest(list, w, h, x, y, paint, n)
  for _, place in ipairs(rings[n]) do
    local px, py = x + place[1], y + place[2]
    if px >= 0 and py >= 0 and px < w and py < h and list[py * w + px + 1] == paint then
      return math.sqrt(place[3]) / n
    end
  end
  return 3
end

--- The largest distance of a paint of one drawing from the same paint in another, in both
--- directions, in source pixels, with n x n samples each: at most 1.5 / n too large.
function traced.apart(one, other, w, h, n)
  local a, b, most = sampled(one, w, h, n), sampled(other, w, h, n), 0
  rings[n] = rings[n] or rings_of(n)
  for i = 1, #a do
    if a[i] ~= b[i] then
      local x, y = (i - 1) % (w * n), (i - 1) // (w * n)
      most = math.max(most, nearest(a, w * n, h * n, x, y, b[i], n),
        nearest(b, w * n, h * n, x, y, a[i], n))
    end
  end
  return most
end

--- The number of pixels that differ when both are rasterised without antialiasing.
function traced.changed(one, other, w, h)
  local a, b, count = sampled(one, w, h, 1), sampled(other, w, h, 1), 0
  for i = 1, #a do count = count + (a[i] ~= b[i] and 1 or 0) end
  return count
end

--- Traces the rasterised picture of an object: each in a file of its own, because a picture is read
--- once.
local function trace_rasterised(object, w, h, antialias)
  local name = os.tmpname()
  local path = name .. ".png"
  assert(celspan.render(celspan.rostrum { antialias = antialias, celspan.cel { object } }, path,
    { size = { w, h } }))
  local art = assert(trace.picture(path, { colours = colours }))
  os.remove(path)
  os.remove(name)
  return art
end

--- Traces the rasterised random drawing number `case`; returns the error of its edges, in source
--- pixels, the traced object, its size, and the drawing. antialias: "area", or "none" for whole
--- pixels.
function traced.retrace(case, antialias)
  local object, w, h = drawing(prng.new(case))
  local art = trace_rasterised(object, w, h, antialias)
  return traced.apart(object, art.object, w, h, FINE), art.object, w, h, object
end

--- The shapes of a random drawing, the ground first, its size, and for each of the others the
--- points that define it and a function that makes one from such points.
function traced.shapes(case) return shapes_of(prng.new(case)) end

return traced
