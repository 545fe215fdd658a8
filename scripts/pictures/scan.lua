-- Makes scan.png in place of a scan: an ink drawing on paper that is not quite white.
--
--   LUA_CPATH=build/?.so lua5.4 scripts/pictures/scan.lua scripts/pictures/scan.png

local paper, ink = rgb(0.86, 0.85, 0.81), rgb(0.016, 0.016, 0.022)
local w, h = 560, 380

local function line(points, closed)
  return stroke { points = points, closed = closed or false, degree = 3, cap = "round",
    join = "round", fill = ink }
end

--- A closed line of changing width, and the paper inside of it.
local function shape(points)
  local outline = {}
  for i, point in ipairs(points) do outline[i] = { point[1], point[2] } end
  return nurbs { points = outline, fill = paper } | line(points, true)
end

local body = shape { { 60, 205, 3 }, { 105, 110, 5 }, { 215, 72, 7 }, { 330, 105, 6 },
  { 420, 180, 4 },
  { 420, 222, 4 }, { 330, 290, 6 }, { 210, 318, 8 }, { 105, 280, 6 } }
local tail = shape { { 432, 200, 4 }, { 478, 172, 5 }, { 540, 92, 7 }, { 530, 190, 4 },
  { 545, 300, 7 },
  { 480, 232, 5 } }
local top = shape { { 170, 100, 4 }, { 205, 38, 6 }, { 275, 22, 7 }, { 312, 60, 4 },
  { 305, 118, 4 },
  { 245, 112, 4 } }
local fin = shape { { 235, 205, 3 }, { 290, 196, 6 }, { 322, 232, 6 }, { 300, 262, 5 },
  { 250, 244, 4 } }
local marks = { line { { 174, 92, 4 }, { 215, 160, 7 }, { 210, 245, 7 }, { 170, 300, 4 } },
  line { { 328, 112, 3 }, { 352, 160, 6 }, { 350, 240, 6 }, { 324, 286, 3 } },
  line { { 86, 238, 3 }, { 100, 256, 5 }, { 128, 244, 2 } } }
local eye = circle { 132, 172, 25, fill = paper }
  | circle { 132, 172, 25 }:stroke { width = 5, fill = ink }
  | circle { 126, 174, 11, fill = ink }

local drawing = union { rect { 0, 0, w, h, fill = paper }, top, body, tail,
  marks[1], marks[2], marks[3], fin, eye }

--- A little noise of the sensor and grain of the paper, the same each time.
local image = pixels(rostrum { cel { drawing } }, { size = { w, h } })
local random, bytes = celspan.random(7), {}
for y = 0, h - 1 do
  for x = 0, w - 1 do
    local r, g, b = image:get(x, y)
    local noise = 1 + 0.02 * (random(x .. "," .. y, 1, 3) - random(x .. ";" .. y, 1, 3))
    bytes[#bytes + 1] = string.pack("<ffff", r * noise + 0.008, g * noise + 0.008,
      b * noise + 0.007, 1)
  end
end
local scan = celspan.image { pixels = table.concat(bytes), size = { w, h }, format = "rgbaf", x = 0,
  y = 0 }
assert(render(rostrum { cel { scan } }, arg[1], { size = { w, h } }))
