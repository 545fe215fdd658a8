-- Random drawings, rasterised, traced and drawn again: how far edges are from where they were.
local celspan = require "celspan"
local trace = require "celspan.trace"
local prng = require "tests.support.prng"

local traced = {}

local FINE = 4 -- places a source pixel is looked at along each axis

local colours = { "#ffffff", "#1a1a24", "#d94f30", "#2f6fb0", "#f2c14e", "#4c9f70" }

-- ---------------------------------------------------------------- random drawings

--- A shape about (x, y), of which no part is farther from there than r; no corner is sharper than 60
--- degrees, and no bend narrower than a few pixels.
local function shape(random, x, y, r, texture)
  local turn = random:between(0, 360)
  local kind = random:whole(1, 5)
  if kind == 1 then return celspan.circle { centre = { x, y }, radius = r, texture = texture } end
  if kind == 2 then
    return celspan.ellipse { centre = { x, y }, radii = { r, r * random:between(0.4, 1) },
      texture = texture }:rotate(turn, x, y)
  end
  if kind == 3 then
    local w = r * random:between(0.8, 1.3)
    return celspan.rect { x - w / 2, y - r / 2, w, r, texture = texture }:rotate(turn, x, y)
  end
  if kind == 4 then
    local points, count = {}, random:whole(3, 6)
    for i = 1, count do
      local angle = math.rad(turn + 360 * i / count)
      points[i] = { x + r * math.cos(angle), y + r * math.sin(angle) }
    end
    points.texture = texture
    return celspan.polygon(points)
  end
  local points = {}
  for i = 1, 7 do
    local angle, far = math.rad(turn + 360 * i / 7), r * random:between(0.7, 1)
    points[i] = { x + far * math.cos(angle), y + far * math.sin(angle) }
  end
  return celspan.nurbs { points = points, texture = texture }
end

--- Shapes that do not touch, on a ground that is cut in two by a smooth line which they may cover.
local function drawing(random)
  local cell, columns, rows = random:whole(28, 50), random:whole(1, 3), random:whole(1, 2)
  local w, h = cell * columns + random:whole(0, 9), cell * rows + random:whole(0, 9)
  local list = { celspan.rect { 0, 0, w, h, texture = colours[1] } }
  for column = 0, columns - 1 do
    for row = 0, rows - 1 do
      local r = random:between(0.25, 0.45) * cell
      local x = (column + 0.5) * cell + random:between(-0.04, 0.04) * cell
      local y = (row + 0.5) * cell + random:between(-0.04, 0.04) * cell
      local n = random:whole(2, 6)
      list[#list + 1] = shape(random, x, y, r, colours[n])
      if random:once(2) then
        list[#list + 1] = celspan.circle { centre = { x, y }, radius = r * 0.3,
          texture = colours[n == 6 and 2 or n + 1] }
      end
    end
  end
  return celspan.union(list), w, h
end

-- ---------------------------------------------------------------- how far edges are off

--- The paint at FINE x FINE places of every pixel, as numbers in a list.
local function fine(object, w, h)
  local image = celspan.pixels(celspan.rostrum { antialias = "none", celspan.cel { object } },
    { film = { w, h }, size = { w * FINE, h * FINE } })
  local bytes, list = image:bytes { depth = 8 }, {}
  for i = 1, #bytes // 4 do list[i] = string.unpack("<I4", bytes, 4 * i - 3) end
  return list
end

--- Places by their distance, as far as two source pixels.
local rings = {}
for dy = -2 * FINE, 2 * FINE do
  for dx = -2 * FINE, 2 * FINE do rings[#rings + 1] = { dx, dy, dx * dx + dy * dy } end
end
table.sort(rings, function(a, b)
  if a[3] ~= b[3] then return a[3] < b[3] end
  if a[2] ~= b[2] then return a[2] < b[2] end
  return a[1] < b[1]
end)

--- How far the nearest place with that paint is, in source pixels.
local function nearest(list, w, h, x, y, paint)
  for _, place in ipairs(rings) do
    local px, py = x + place[1], y + place[2]
    if px >= 0 and py >= 0 and px < w and py < h and list[py * w + px + 1] == paint then
      return math.sqrt(place[3]) / FINE
    end
  end
  return 3
end

--- The farthest that a paint is from where it should be, either way.
local function farthest_off(a, b, w, h)
  local most = 0
  for y = 0, h - 1 do
    for x = 0, w - 1 do
      local i = y * w + x + 1
      if a[i] ~= b[i] then
        most = math.max(most, nearest(a, w, h, x, y, b[i]), nearest(b, w, h, x, y, a[i]))
      end
    end
  end
  return most
end

--- Traces what an object is rasterised to: each in a file of its own, for a picture is read once.
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

--- Traces what random drawing number `case` is rasterised to; how far its edges are off, in source
--- pixels, what was traced, and its size. antialias: "area", or "none" for whole pixels.
function traced.retrace(case, antialias)
  local object, w, h = drawing(prng.new(case))
  local art = trace_rasterised(object, w, h, antialias)
  local off = farthest_off(fine(object, w, h), fine(art.object, w, h), w * FINE, h * FINE)
  return off, art.object, w, h
end

return traced
