-- The street: sky, a row of houses, the snow on the ground, and a branch in front of the lens. The
-- lamp and the lamplighter stand on the ground of this set; every plane is drawn as seen at rest.
local house = require "film.house"
local shapes = require "demo.shapes"

local street = {}

local WALLS = { { "#7d7bc0", "#4b4a92" }, { "#8a7cb8", "#544888" }, { "#6d7cc0", "#414a90" },
                { "#9080b4", "#5a4a86" } }

-- ---------------------------------------------------------------- the sky

local function stars()
  local random, parts = celspan.random "street stars", {}
  for i = 1, 46 do
    parts[i] = circle { -100 + 2120 * random("x" .. i), 460 * random("y" .. i) ^ 1.4,
      1 + 1.5 * random("r" .. i), fill = rgb("#f4edff", 0.35 + 0.5 * random("a" .. i)) }
  end
  return union(parts)
end

--- The roofs of the next street, in the haze, and the hill with its church behind them.
local function far_roofs()
  local random, parts = celspan.random "far roofs", {
    shapes.ridge({ { -300, 700 }, { 300, 660 }, { 760, 560 }, { 1160, 500 }, { 1560, 580 },
      { 2220, 690 } }, 860,
      shapes.down(500, 800, { "#5a5ca6", "#7f7cbe" })),
    polygon { { 1064, 540 }, { 1068, 420 }, { 1088, 330 }, { 1108, 420 }, { 1112, 540 },
      fill = "#4c4f9a" },
  }
  local x = -160
  while x < 2080 do
    local w = 120 + 70 * random("w" .. x)
    local top = 700 - 40 * random("h" .. x) - 80 * math.exp(-((x - 1100) / 360) ^ 2)
    local roof = 0.4 * w
    parts[#parts + 1] = polygon { { x, 860 }, { x, top }, { x + w / 2, top - roof },
      { x + w, top },
      { x + w, 860 }, fill = shapes.down(top - roof, 820, { "#54559c", "#8582c2" }) }
    parts[#parts + 1] = stroke { fill = "#7376b6", cap = "round", join = "round",
      points = {
      { x - 8, top + 6, 8 }, { x + w / 2, top - roof, 15 }, { x + w + 8, top + 6, 8 } } }
    x = x + w * 1.05
  end
  return union(parts)
end

street.sky = union {
  rect { -300, -200, 2520, 1100, fill = shapes.down(-60, 760, { "#0f1440", "#262a6c",
    "#4d4a96", "#8d7bb8" }) },
  stars(), far_roofs(),
}

-- ---------------------------------------------------------------- the houses

local row = {
  { -170, 812, 400, 380, wall = 1, rise = 190, lean = -1.5, chimney = 0.68, door = 0.66,
    rows = { { 0.3, 0.7, at = 0.86 }, { 0.26, 0.5, at = 0.42 } } },
  { 262, 806, 300, 300, wall = 2, rise = 210, lean = 1.2, chimney = 0.16,
    rows = { { 0.5, at = 1.12 }, { 0.28, 0.72, at = 0.62 } } },
  { 596, 804, 330, 390, wall = 3, rise = 170, lean = -0.8, door = 0.12, chimney = 0.72,
    rows = { { 0.28, 0.72, at = 0.92 }, { 0.66, at = 0.46 } } },
  { 1392, 806, 310, 330, wall = 4, rise = 200, lean = 1.6, chimney = 0.2, door = 0.66,
    rows = { { 0.5, at = 1.06 }, { 0.3, 0.74, at = 0.66 }, { 0.28, at = 0.32 } } },
  { 1730, 814, 420, 420, wall = 1, rise = 200, lean = -1, chimney = 0.5,
    rows = { { 0.28, 0.68, at = 0.9 }, { 0.2, 0.5, at = 0.45 } } },
}

local function houses()
  local parts = {}
  for i, h in ipairs(row) do
    parts[i] = house.draw("street" .. i, h[1], h[2], h[3], h[4],
      { wall = WALLS[h.wall], rise = h.rise,
      lean = h.lean, chimney = h.chimney, door = h.door, rows = h.rows, window = 0.16 })
  end
  -- Snow that the wind has blown against the walls.
  parts[#parts + 1] = shapes.ridge({ { -300, 800 }, { -60, 790 }, { 200, 804 }, { 480, 788 },
    { 760, 802 }, { 980, 806 }, { 1200, 792 }, { 1420, 800 }, { 1680, 790 }, { 1960, 802 },
    { 2220, 796 } }, 900, shapes.down(780, 880, { "#b9c1ee", "#9aa5e0" }))
  return union(parts)
end
street.houses = houses()

-- ---------------------------------------------------------------- the ground

local function ground()
  local parts = {
    shapes.ridge({ { -300, 846 }, { 100, 836 }, { 520, 850 }, { 940, 842 }, { 1300, 834 },
      { 1700, 848 },
      { 2220, 838 } }, 1300, shapes.down(836, 1110, { "#a9b4e6", "#c9d2f6", "#dfe5fc" })),
  }
  local random = celspan.random "drifts"
  for i = 1, 26 do
    local x, y = -200 + 2200 * random("x" .. i), 870 + 200 * random("y" .. i)
    local long = 90 + 190 * random("l" .. i)
    parts[#parts + 1] = stroke { degree = 2, taper = { long * 0.4, long * 0.5 },
      width = 4 + 9 * random("w" .. i), fill = rgb(i % 3 == 0 and "#f2f5ff" or "#8f9bd6",
        0.4),
      points = { { x, y }, { x + long * 0.5, y - 7 }, { x + long, y + 3 } } }
  end
  return union(parts)
end
street.ground = ground()

--- A footprint, and a shadow on the ground of a given width and darkness.
function street.footprint(x, y)
  return union {
    ellipse { x, y, 19, 6, fill = "#7f8ccc" },
    ellipse { x + 1, y + 2, 17, 4, fill = "#96a2dc" },
  }
end

function street.shadow(x, y, width, dark)
  return circle { 0, 0, 1,
    fill = radial { centre = { 0, 0 },
    radius = 1, { 0, rgb("#23276a", dark) }, { 0.5, rgb("#23276a", dark * 0.6) },
    { 1, rgb("#23276a", 0) } } }:scale(width, width * 0.17):translate(x, y)
end

-- ---------------------------------------------------------------- before the lens

local BARK, SNOW, BERRY = "#2a2148", "#dfe5fb", "#d8413f"

local function twig(points, snow)
  local lifted = {}
  for i, p in ipairs(points) do lifted[i] = { p[1], p[2] - p[3] * 0.42, p[3] * snow } end
  return stroke { points = points, degree = 3, cap = "round", fill = BARK },
    stroke { points = lifted, degree = 3, cap = "round", fill = SNOW,
      taper = { 30, 60 } }
end

local function berries(parts, x, y, count)
  for i = 1, count do
    local a = i * 2.4
    local bx, by = x + 9 * math.sqrt(i) * math.cos(a), y + 26 + 9 * math.sqrt(i) * math.sin(a)
    parts[#parts + 1] = circle { bx, by, 12,
      fill = radial {
      centre = { bx - 4, by - 5 }, radius = 17, { 0, "#ff8a6a" }, { 0.5, BERRY },
        { 1, "#8e2038" } } }
  end
  parts[#parts + 1] = path { fill = SNOW,
    d = ("M%g %gq6 -26 32 -24q26 0 28 22q-14 10 -28 4q-18 8 -32 -2z")
    :format(x - 30, y + 14) }
end

local function branch()
  local parts = {}
  local twigs = {
    { { -160, 40, 54 }, { 120, 120, 44 }, { 330, 128, 32 }, { 560, 96, 20 }, { 720, 112, 9 } },
    { { 180, 124, 24 }, { 300, 210, 18 }, { 420, 250, 13 }, { 520, 252, 6 } },
    { { 420, 112, 18 }, { 520, 40, 14 }, { 640, 10, 8 } },
    { { -40, 70, 26 }, { 40, 210, 20 }, { 150, 300, 14 }, { 210, 380, 7 } },
  }
  for _, points in ipairs(twigs) do
    local wood, snow = twig(points, 0.72)
    parts[#parts + 1], parts[#parts + 2] = wood, snow
  end
  berries(parts, 520, 250, 7)
  berries(parts, 205, 372, 6)
  berries(parts, 700, 110, 4)
  return union(parts)
end

local bank = shapes.ridge({ { -300, 1010 }, { 0, 960 }, { 180, 990 }, { 420, 1052 }, { 760, 1074 },
  { 1200, 1084 }, { 1560, 1060 }, { 1780, 1004 }, { 1960, 980 }, { 2220, 1000 } }, 1400,
  shapes.down(960, 1100, { "#c3ccf4", "#8e9ad6" }))

street.before = bank
street.branch = branch()

return street
