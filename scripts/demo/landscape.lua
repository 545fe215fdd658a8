-- The valley, plane by plane. Built once: nothing in it moves by itself.
local palette = require "demo.palette"
local shapes = require "demo.shapes"

local landscape = {}

local bottom = 1100

--- Crest colour above, haze or shade below.
local function shaded(colours, top, low)
  return shapes.down(top, low, colours)
end

landscape.mountains = shapes.ridge({
  { -60, 560 }, { 120, 500 }, { 270, 430 }, { 380, 470 }, { 520, 545 }, { 650, 590 }, { 790, 560 },
  { 930, 480 }, { 1060, 415 }, { 1150, 395 }, { 1260, 450 }, { 1400, 525 }, { 1560, 500 },
  { 1720, 430 }, { 1900, 470 }, { 2120, 540 },
}, bottom, shaded(palette.mountains, 400, 690))

landscape.hills = shapes.ridge({
  { -60, 600 }, { 140, 585 }, { 330, 610 }, { 520, 650 }, { 760, 662 }, { 980, 630 }, { 1180, 590 },
  { 1380, 572 }, { 1600, 600 }, { 1850, 560 }, { 2240, 590 },
}, bottom, shaded(palette.hills, 560, 700))

--- Water: in the colour of the low sky, with long calm lines.
local function lake()
  local parts = { rect { -60, 668, 2500, 240, fill = shaded(palette.lake, 668, 800) } }
  local glints = { { 560, 684, 260, 3 }, { 500, 696, 420, 4 }, { 620, 712, 300, 5 },
                   { 900, 730, 380, 5 }, { 1280, 700, 300, 4 }, { 1500, 724, 420, 5 } }
  for _, g in ipairs(glints) do
    parts[#parts + 1] = rect { g[1], g[2], g[3], g[4], radius = g[4] / 2,
                               fill = palette.glint }
  end
  return union(parts)
end
landscape.lake = lake()

--- Land with furrows: ribbons across it, cut to its shape.
local function field(land, furrows, paint)
  local parts = {}
  for i, points in ipairs(furrows) do parts[i] = shapes.ribbon(points, paint) end
  return union { land, clip(union(parts), land) }
end

local function furrows(count, x, y, spread)
  local list = {}
  for i = 1, count do
    local w = 5 + i * 1.6
    list[i] = { { x - i * 14, y + i * 8, w }, { x + spread + i * 10, y + 34 + i * 16, w * 1.6 },
                { x + spread * 2.4 + i * 40, y + 108 + i * 20, w * 2 } }
  end
  return list
end

landscape.slope = field(shapes.ridge({
  { -80, 690 }, { 160, 672 }, { 360, 655 }, { 560, 665 }, { 760, 690 }, { 940, 726 }, { 1100, 760 },
  { 1300, 790 }, { 1600, 815 },
}, bottom, shaded(palette.village, 650, 800)), furrows(7, 760, 690, 130), palette.furrow)

local near = shapes.ridge({
  { -80, 800 }, { 180, 796 }, { 430, 830 }, { 700, 858 }, { 960, 842 }, { 1230, 790 },
  { 1500, 742 }, { 1800, 722 }, { 2140, 740 }, { 2500, 760 },
}, bottom, shaded(palette.near, 720, 980))

--- The path on which the lamplighter came.
landscape.near = field(near, {
  { { 560, 838, 8 }, { 640, 868, 16 }, { 800, 890, 26 }, { 900, 930, 44 }, { 860, 1000, 80 } },
}, palette.path)

--- A poplar: a flame on a short stem.
local function poplar(x, y, tall, colour)
  local w = tall * 0.17
  return shapes.blob({ { x, y - tall * 1.18 }, { x + w * 0.9, y - tall * 0.55 }, { x + w * 1.1, y },
                       { x, y + tall * 0.04 }, { x - w * 1.1, y },
                       { x - w * 0.9, y - tall * 0.55 } }, colour)
end

--- A round tree: crown and trunk.
local function oak(x, y, size, colour)
  local function leaves(dx, dy, r)
    return circle { x + size * dx, y + size * dy, size * r,
                    fill = colour }
  end
  local trunk = rect { x - size * 0.06, y - size * 0.5, size * 0.12, size * 0.5,
                       fill = palette.boot }
  return union { trunk, leaves(0, -0.72, 0.42), leaves(0.3, -0.55, 0.3),
                 leaves(-0.3, -0.52, 0.28) }
end

local function grove(list, plant)
  local parts = {}
  for i, t in ipairs(list) do
    local x, y, size = table.unpack(t)
    parts[i] = plant(x, y, size, shapes.across(x - size * 0.3, x + size * 0.35, palette.leaves))
  end
  return union(parts)
end

landscape.poplars = grove({ { 96, 690, 120 }, { 132, 690, 150 }, { 170, 688, 126 },
                            { 792, 706, 110 }, { 826, 712, 138 }, { 862, 718, 100 } }, poplar)
landscape.oaks = grove({ { 1640, 742, 130 }, { 1790, 734, 170 }, { 1960, 740, 140 },
                         { 210, 806, 110 } }, oak)

landscape.ground = shapes.ridge({
  { -120, 985 }, { 260, 972 }, { 620, 985 }, { 960, 962 }, { 1260, 915 }, { 1520, 892 },
  { 1820, 905 }, { 2200, 950 }, { 2500, 970 },
}, bottom, shaded(palette.ground, 890, 1080))

--- A stalk through the points, as a silhouette.
local function stalk(...)
  return shapes.ribbon({ ... }, palette.silhouette)
end

--- A flower like a parasol: seven rays from (x, y), each with a floret.
local function umbel(x, y, size)
  local parts = { stalk({ x - 30, 1120, 9 }, { x - 12, (y + 1120) / 2, 7 }, { x, y, 4 }) }
  for k = -3, 3 do
    local px, py = x + k * size * 0.3, y - size * (0.62 - 0.045 * k * k)
    parts[#parts + 1] = stalk({ x, y, 4 }, { x + k * size * 0.18, y - size * 0.3, 3 },
                              { px, py, 2 })
    parts[#parts + 1] = ellipse { px, py - 3, size * 0.15, size * 0.085,
                                  fill = palette.silhouette }
  end
  return union(parts)
end

--- The foreground, between the camera and the stage.
local function meadow()
  local parts = { umbel(120, 700, 96), umbel(270, 810, 76), umbel(470, 880, 60) }
  for i = 0, 22 do
    local x, lean = -80 + i * 43 + i * 29 % 31, (i * 37 % 60) - 22
    local tall = 120 + i * 53 % 150 - i * 4
    parts[#parts + 1] = stalk({ x, 1120, 20 }, { x + lean * 0.4, 1120 - tall * 0.6, 12 },
                              { x + lean * 1.5, 1120 - tall * 1.1, 1 })
  end
  return union(parts)
end
landscape.meadow = meadow()

--- A branch that hangs into the picture from the right.
local function branch()
  local parts = { stalk({ 2420, -30, 26 }, { 2260, 40, 20 }, { 2090, 76, 13 }, { 1930, 84, 8 },
                        { 1800, 66, 3 }) }
  for i = 0, 15 do
    local x = 1800 + i * 37
    local y = 66 + 22 * math.sin((i + 1) / 5.2) - math.max(0, i - 10) * 17
    local turn = (i % 2 == 0 and 62 or -48) + i * 23 % 30
    parts[#parts + 1] = path { d = "M0 0C14 -26 52 -30 84 0C52 24 16 22 0 0Z",
                               fill = palette.silhouette }
      :scale(0.8 + i * 11 % 5 * 0.1):rotate(180 - turn):translate(x, y)
  end
  return union(parts)
end
landscape.branch = branch()

return landscape
