-- Trace: a picture, which a script drew in place of a scanned ink drawing, becomes shapes. Each is
-- coloured by a point inside it, the tail moves by itself, and the fish swims, sharp at every size.
local trace = require "celspan.trace"

local fish = assert(trace.picture("pictures/scan.png", { speckle = 30 }))

--- {a point of an area, its colour}
local colours = {
  { 110, 240, "#f6a13c" }, { 260, 160, "#f9d36b" }, { 390, 200, "#ef7d45" }, { 250, 60, "#e8563f" },
  { 510, 200, "#e8563f" }, { 285, 232, "#ef7d45" }, { 150, 160, "#ffffff" },
}

--- The colour of an area; nil: it is paper, and left out.
local function paint(shape)
  if shape.area > 60000 then return nil end
  for _, one in ipairs(colours) do
    if shape.object:contains(one[1], one[2]) then return one[3] end
  end
  return "#1c2233"
end

local body, tail = {}, {}
for _, shape in ipairs(fish.shapes) do
  local colour = paint(shape)
  local part = shape.object:bounds() > 420 and tail or body
  if colour then part[#part + 1] = shape.object:with { fill = colour } end
end
body, tail = union(body), union(tail):translate(-34, 0)

local sea = linear { from = { 0, 0 }, to = { 0, 720 }, { 0, "#8fd3e8" }, { 0.5, "#3a8fb7" },
  { 1, "#123a63" } }

local function bubbles(f)
  local list = {}
  for i = 1, 14 do
    local x, r = 90 + 1100 * f:random("x" .. i), 3 + 12 * f:random("r" .. i)
    local y = (900 * f:random("y" .. i) - f.time * (60 + 5 * r)) % 800 - 40
    list[i] = circle { x, y, r }:stroke { width = 2,
      fill = "#ffffffa0" }
  end
  return union(list)
end

return film { size = { 1280, 720 }, frames = 48, frame = function(f)
  local beat = math.sin(2 * math.pi * 2 * f.time)
  local swimming = union { tail:skew(0, 14 * beat, 412, 200)
    :scale(1 - 0.06 * beat, 1, 412, 200),
    body:skew(0, -2 * beat, 425, 200) }
  return {
    rect { 0, 0, 1280, 720, fill = sea },
    bubbles(f),
    swimming:scale(1.5):translate(330 - 260 * f.progress, 70 + 8 * beat),
  }
end }
