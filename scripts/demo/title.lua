-- The name, written into the sky with a round pen: letters of arcs and lines on a grid of 100.
local celspan = require "celspan"
local ease = require "celspan.ease"
local shapes = require "demo.shapes"

local title = {}

local pen = 17

--- Points on a circle, degrees clockwise from the right.
local function arc(x, y, radius, from, to)
  local points, count = {}, math.max(2, math.ceil(math.abs(to - from) / 20))
  for i = 0, count do
    local a = math.rad(from + (to - from) * i / count)
    points[i + 1] = { x + radius * math.cos(a), y + radius * math.sin(a), pen }
  end
  return points
end

local function line(x0, y0, x1, y1)
  return { { x0, y0, pen }, { (x0 + x1) / 2, (y0 + y1) / 2, pen }, { x1, y1, pen } }
end

local function join(...)
  local points = {}
  for _, part in ipairs { ... } do table.move(part, 1, #part, #points + 1, points) end
  return points
end

--- letter -> its width and its strokes; the line stands on y = 0, small letters are 100 high.
local letters = {
  c = { 92, arc(50, -50, 50, -48, -312) },
  e = { 104, line(4, -50, 96, -50), arc(50, -50, 50, 0, -318) },
  l = { 26, line(10, -150, 10, 0) },
  s = { 74, join(arc(34, -74, 26, -30, -250), arc(34, -25, 25, -70, 150)) },
  p = { 104, line(0, -100, 0, 46), arc(50, -50, 50, 180, 540) },
  a = { 104, arc(50, -50, 50, 0, -360), line(100, -100, 100, 0) },
  n = { 84, line(0, 0, 0, -100),
        join(arc(38, -62, 38, -180, 0), { { 76, -30, pen }, { 76, 0, pen } }) },
}

--- The first part of a stroke, with round ends.
local function drawn(stroke, part, texture)
  local count = math.max(2, math.ceil(part * #stroke))
  local points = table.move(stroke, 1, count, 1, {})
  local first, last = points[1], points[count]
  return celspan.union {
    shapes.ribbon(points, texture),
    celspan.circle { centre = { first[1], first[2] }, radius = pen / 2, texture = texture },
    celspan.circle { centre = { last[1], last[2] }, radius = pen / 2, texture = texture },
  }
end

local flow = ease "inOutSine"

--- The word, `progress` from 0 to 1 written.
function title.write(word, progress, texture)
  local parts, x = {}, 0
  for i = 1, #word do
    local letter = letters[word:sub(i, i)]
    local part = flow(math.max(0, math.min(1, progress * (#word + 2) / 3 - (i - 1) / 3)))
    for k = 2, part > 0 and #letter or 0 do
      parts[#parts + 1] = drawn(letter[k], part, texture):translate(x, 0)
    end
    x = x + letter[1] + 34
  end
  return celspan.union(parts), x - 34
end

return title
