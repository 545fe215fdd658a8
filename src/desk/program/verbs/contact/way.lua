--- celspan contact --camera: the way of the camera over the background.
--
--   +------------------------------+   what the first frame shows, as far as any frame of the way
--   | #====#                       |   sees; a rectangle for each second, the first and the last
--   | #  +-#--+   =======          |   frame thick, each with its frame's number
--   | #==|=#  |  =      =          |
--   +------------------------------+
local program, request, script, number_at, output = ...
local celspan = require "celspan"

local LONG, LEAST = 1920, 16 -- pixels of the longer side, and of the shorter one at least
local MARGIN = 0.04 -- of the longer side, around the rectangles
local INK, FIRST, LAST = "#3a4a55", "#1f8a4c", "#c8321e"

local w, h = script.size[1], script.size[2]

--- Where a frame is seen: the middle and half of the width and height, and its turn.
local function view_of(number)
  local camera = program.camera(script, number)
  if not camera then return nil end
  local half = (camera.width or w) / 2
  return { number = number, x = camera.x or w / 2, y = camera.y or h / 2, w = half,
           h = half * h / w, turn = camera.turn }
end

--- The corners of a view, clockwise from the upper left one.
local function corners(view)
  local list, cos, sin = {}, math.cos(view.turn), math.sin(view.turn)
  for i, side in ipairs { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } } do
    local x, y = side[1] * view.w, side[2] * view.h
    list[i] = { view.x + x * cos - y * sin, view.y + x * sin + y * cos }
  end
  return list
end

local function is_same(a, b)
  return a.x == b.x and a.y == b.y and a.w == b.w and a.turn == b.turn
end

--- The views at each second, and of the first and the last frame, each place once in a row.
local function views_of(numbers)
  local list, step = {}, math.max(1, math.floor(script.fps + 0.5))
  for i = 1, #numbers do
    local view = ((i - 1) % step == 0 or i == #numbers) and view_of(numbers[i])
    if view and not (list[1] and is_same(list[#list], view)) then list[#list + 1] = view end
  end
  if #list == 0 then
    program.fail("input", "%s: its frames have no camera: give rostrums one, such as camera = { "
      .. "centre = { 80, 45 }, width = 160 }", request[1])
  end
  return list
end

--- The box around all views, with a margin: x, y, width, height.
local function bounds(views)
  local low, high = { math.huge, math.huge }, { -math.huge, -math.huge }
  for _, view in ipairs(views) do
    for _, corner in ipairs(corners(view)) do
      for i = 1, 2 do
        low[i], high[i] = math.min(low[i], corner[i]), math.max(high[i], corner[i])
      end
    end
  end
  local margin = math.max(high[1] - low[1], high[2] - low[2]) * MARGIN
  return low[1] - margin, low[2] - margin, high[1] - low[1] + 2 * margin,
    high[2] - low[2] + 2 * margin
end

--- The first frame with a camera that sees the box, as an image of this size in pixels.
local function background(number, x, y, width, height, size)
  local seen = math.max(width, height * w / h) -- the camera has the proportions of the film
  local scale = size[1] / width
  local whole = { math.ceil(seen * scale), math.ceil(seen * h / w * scale) }
  script:build(number)
  script:use_camera(celspan.rostrum { camera = { centre = { x + width / 2, y + height / 2 },
    width = seen } })
  local crop = { (whole[1] - size[1]) // 2, (whole[2] - size[2]) // 2, size[1], size[2] }
  local pixels = program.check(celspan.pixels(program.still(script, script:exposures()),
    { size = whole, crop = crop, workers = math.tointeger(request.workers) }))
  return celspan.image { x = 0, y = 0, w = size[1], h = size[2], size = size, format = "rgba16",
    pixels = pixels:bytes { depth = 16, colour = "srgb", alpha = "straight" } }
end

local function add_view(objects, view, place, look)
  local d, list = {}, corners(view)
  for i, corner in ipairs(list) do
    list[i] = { place(corner[1], corner[2]) }
    d[i] = ("%s%.3f %.3f"):format(i == 1 and "M" or "L", list[i][1], list[i][2])
  end
  d = table.concat(d) .. "Z"
  for _, line in ipairs { { look.width + 2, "#ffffffb0" }, { look.width, look.ink } } do
    objects[#objects + 1] = celspan.stroke { d = d, width = line[1], texture = line[2] }
  end
  local text = tostring(view.number)
  local wide, degrees = #text * 9 + 5, math.deg(view.turn)
  local label = celspan.union { celspan.rect { 0, 0, wide, 20, texture = "#ffffffd8" },
                                number_at(text, 4, 4) }
  objects[#objects + 1] = label:translate(5, 5):rotate(degrees)
    :translate(list[1][1], list[1][2])
end

--- The line of the camera's middle, from view to view.
local function add_line(objects, views, place)
  local d = {}
  for i, view in ipairs(views) do
    local x, y = place(view.x, view.y)
    d[i] = ("%s%.3f %.3f"):format(i == 1 and "M" or "L", x, y)
    objects[#objects + 1] = celspan.circle { centre = { x, y }, radius = 3, texture = LAST }
  end
  if #views > 1 then
    objects[#objects + 1] = celspan.stroke { d = table.concat(d), width = 1.5, texture = LAST }
  end
end

local numbers = script:numbers()
local views = views_of(numbers)
local x, y, width, height = bounds(views)
local scale = LONG / math.max(width, height)
local size = { math.max(LEAST, math.floor(width * scale + 0.5)),
               math.max(LEAST, math.floor(height * scale + 0.5)) }
local function place(px, py) return (px - x) * scale, (py - y) * scale end

local objects = { celspan.rect { 0, 0, size[1], size[2], texture = "#fff" },
                  background(numbers[1], x, y, width, height, size) }
add_line(objects, views, place)
for i, view in ipairs(views) do
  local is_first, is_last = i == 1, i == #views
  add_view(objects, view, place, { width = (is_first or is_last) and 4 or 1.5,
    ink = is_first and FIRST or is_last and LAST or INK })
end
program.check(celspan.render(celspan.rostrum { celspan.cel(objects) }, output, { size = size,
  workers = math.tointeger(request.workers) }))
