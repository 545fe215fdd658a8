-- Stands for a photograph in scripts/relight.lua: a house on a hill at noon, with film grain, as a
-- picture of floats in memory. Its light is known, because it is drawn here.

local photo = { width = 640, height = 360, light = { 1.1, 1.05, 0.9 } }

local random = celspan.random "photo"

local function band(y, height, steps, from, to)
  local d = { ("M-10 380L-10 %.1f"):format(y) }
  for i = 0, steps do
    local x = -10 + i * 660 / steps
    d[#d + 1] = ("S%.1f %.1f %.1f %.1f")
      :format(x - 200 / steps, y - height * random("a" .. y .. i), x,
      y - height * random("b" .. y .. i))
  end
  return path { d = table.concat(d) .. "L650 380Z",
    fill = linear { from = { 0, y - height }, to = { 0, 370 }, { 0, from }, { 1, to } } }
end

local function tree(x, y, r, i)
  local parts = { rect { x - r / 9, y, r / 4.5, r * 1.1, fill = "#5a4632" } }
  for k = 1, 26 do
    local a, d = 2 * math.pi * random("t" .. i .. k), r * random("d" .. i .. k) ^ 0.5
    parts[#parts + 1] = circle {
      x + d * math.cos(a), y - r * 0.3 + d * math.sin(a), r * (0.22 + 0.2 * random("s" .. i .. k)),
      fill = rgb(0.05 + 0.1 * random("g" .. i .. k), 0.2 + 0.14 * random("h" .. i .. k),
        0.05) }
  end
  return union(parts)
end

local function house(x, y)
  local parts = {
    rect { x, y, 150, 84, fill = linear { from = { x, y }, to = { x + 150, y },
      { 0, "#f1e4cf" }, { 1, "#c9b490" } } },
    polygon { { x - 14, y + 2 }, { x + 30, y - 52 }, { x + 122, y - 52 },
      { x + 164, y + 2 },
      fill = "#a2492f" },
    rect { x + 104, y - 74, 18, 40, fill = "#8d5a45" },
    rect { x + 62, y + 34, 26, 50, radius = 3, fill = "#3d5a52" } }
  for _, at in ipairs { 16, 106 } do
    parts[#parts + 1] = rect { x + at, y + 26, 30, 30, fill = "#f8f4ea" }
    parts[#parts + 1] = rect { x + at + 3, y + 29, 24, 24, fill = "#5c7f92" }
    parts[#parts + 1] = rect { x + at + 14, y + 26, 2, 30, fill = "#f8f4ea" }
  end
  return union(parts)
end

local function grain()
  local parts = {}
  for i = 1, 1400 do
    local shade = random("n" .. i) < 0.5 and "#00000014" or "#ffffff12"
    parts[i] = rect { 640 * random("x" .. i), 360 * random("y" .. i), 2.2, 1.6,
      fill = shade }
  end
  return union(parts)
end

local sky = rect { 0, 0, 640, 360,
  fill = linear { from = { 0, 0 }, to = { 0, 230 },
  { 0, "#6fa4d8" }, { 1, "#dcebf2" } } }

--- The sun in the pond: brighter than anything white could be.
local glint = cel { front = { 9, 8.6, 7.5 }, union {
  ellipse { 118, 312, 20, 1.6, fill = "#ffffffb0" },
  ellipse { 132, 318, 30, 1.4, fill = "#ffffff80" } } }

local scene = rostrum { front = photo.light,
  cel { sky, band(190, 60, 5, "#9fb7bf", "#a9c0a8"), band(232, 40, 4, "#86a86a", "#5f8746"),
    tree(566, 196, 44, 1), tree(604, 226, 30, 2), house(330, 170), tree(300, 226, 26, 3),
    band(268, 16, 6, "#7fa653", "#41662c"),
    ellipse { 120, 314, 106, 24, fill = linear {
      from = { 0, 290 }, to = { 0, 338 }, { 0, "#8fb6d0" }, { 1, "#35607c" } } },
      tree(36, 262, 34, 4) },
  glint, cel { grain() } }

--- The picture.
function photo.take()
  local size = { photo.width, photo.height }
  local image = assert(pixels(scene, { size = size }))
  return picture { pixels = image:bytes { depth = "float" }, size = size, format = "rgbaf" }
end

return photo
