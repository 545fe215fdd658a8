-- Paints town.ora, the layered painting of the town on its hill:
--
--   LUA_CPATH=build/?.so lua5.4 scripts/film/paint.lua      from the root of the tree
--
-- Every layer is a separate picture, made with brushes: strokes with a width that swells and
-- tapers.
package.path = "./?.lua;./scripts/?.lua;" .. package.path
local draw = require "scripts.paintings.draw"
local paintings = require "tests.support.paintings"
local plan = require "film.plan"
local shapes = require "demo.shapes"

local LEFT, TOP, W, H = plan.LEFT, plan.TOP, plan.WIDTH, plan.HEIGHT
local SNOW, SHADE = "#dde3fb", "#98a3dc"
local BOTTOM = TOP + H
-- Pixels per unit: the painting is enlarged a little in the film, as a scan of paper would be.
local FINE = 0.68

--- A brush stroke from (x, y), `long` and `wide`, bent by `bow`.
local function brush(x, y, long, wide, turn, bow, colour, alpha)
  local a = math.rad(turn)
  local dx, dy = long * math.cos(a), long * math.sin(a)
  local px, py = -dy / long * bow, dx / long * bow
  return stroke { degree = 3, cap = "round", fill = rgb(colour, alpha),
    points = {
    { x, y, 0 }, { x + 0.2 * dx + px, y + 0.2 * dy + py, wide * 1.3 },
    { x + 0.6 * dx + px, y + 0.6 * dy + py, wide }, { x + dx, y + dy, 0 } } }
end

--- A ridge line: waves and some roughness, {x, y} from left to right.
local function ridge(seed, level, waves, rough, step)
  local random, points = celspan.random(seed), {}
  for x = LEFT - 20, LEFT + W + 20, step do
    local y = level
    for _, wave in ipairs(waves) do y = y + wave[1] * math.sin(x / wave[2] + wave[3]) end
    points[#points + 1] = { x, y + rough * (random(x) - 0.5) }
  end
  return points
end

-- ---------------------------------------------------------------- layers

local function clouds()
  local random, parts = celspan.random "clouds", {}
  local banks = { { 150, 330, 1.1 }, { 640, 430, 0.8 }, { 1350, 380, 1.2 }, { 1900, 300, 1 },
    { 980, 210, 0.7 },
                  { 320, 60, 0.8 }, { 1620, 40, 0.9 } }
  for b, bank in ipairs(banks) do
    for i = 1, 9 do
      local label = b .. "." .. i
      local along = (random("a" .. label) - 0.5) * 520 * bank[3]
      local y = bank[2] + (random("y" .. label) - 0.5) * 60 * bank[3]
      parts[#parts + 1] = brush(bank[1] + along - 120, y,
        260 * bank[3] * (0.6 + random("l" .. label)),
        20 * bank[3] * (0.5 + random("w" .. label)), 2 - 4 * random("t" .. label), 6,
        i % 3 == 0 and "#c79ab8" or "#6f68ae", 0.22)
    end
  end
  return parts
end

--- Mountains whose flanks are brushed, light to the left and shade to the right.
local function peaks()
  local tops = { { -340, 640 }, { -180, 520 }, { -40, 590 }, { 150, 400 }, { 300, 540 },
    { 420, 470 }, { 640, 610 },
    { 860, 560 }, { 1120, 600 }, { 1350, 450 }, { 1480, 520 }, { 1660, 350 }, { 1850, 530 },
      { 2010, 460 }, { 2280, 640 } }
  local outline = { texture = shapes.down(380, 800, { "#7f7fc2", "#a093c6", "#b49ac4" }) }
  for i, p in ipairs(tops) do outline[i] = p end
  outline[#outline + 1] = { LEFT + W, BOTTOM }
  outline[#outline + 1] = { LEFT, BOTTOM }
  local land = polygon(outline)
  local random, marks = celspan.random "peaks", {}
  for i = 2, #tops - 1 do
    local top, before, after = tops[i], tops[i - 1], tops[i + 1]
    if top[2] < before[2] and top[2] < after[2] then
      for k = 1, 16 do
        local label = i .. "." .. k
        local u = random("u" .. label)
        local is_light = k % 2 == 0
        local x = top[1] + (is_light and -1 or 1) * u * 90
        local y = top[2] + u * 95 + 12 * random("y" .. label)
        marks[#marks + 1] = brush(x, y, 40 + 80 * u, 10 + 16 * random("w" .. label),
          is_light and 118 + 20 * random("t" .. label) or 44 + 24 * random("t" .. label), 5,
          is_light and "#e3def6" or "#5d5ba6", is_light and 0.5 or 0.4)
      end
    end
  end
  return { land, clip(union(marks), land) }
end

--- A fir with snow on its boughs.
local function fir(parts, x, foot, height, colour, snow)
  for i = 0, 5 do
    local y, w = foot - height + height * 0.15 * i, height * (0.07 + 0.045 * i)
    parts[#parts + 1] = path { fill = colour,
      d = ("M%g %gQ%g %g %g %gQ%g %g %g %gQ%g %g %g %gZ"):format(
      x, y - height * 0.04, x + w * 0.3, y + height * 0.1, x + w, y + height * 0.21, x + w * 0.4,
        y + height * 0.2,
      x, y + height * 0.19, x - w * 0.4, y + height * 0.2, x - w, y + height * 0.21) }
    parts[#parts + 1] = path { fill = snow,
      d = ("M%g %gQ%g %g %g %gQ%g %g %g %gZ"):format(
      x, y - height * 0.045, x - w * 0.3, y + height * 0.08, x - w * 0.98, y + height * 0.2,
      x - w * 0.3, y + height * 0.13, x + w * 0.1, y + height * 0.05) }
  end
end

local function wood()
  local points = ridge("wood", 690, { { 34, 210, 1 }, { 16, 83, 2 } }, 6, 40)
  local parts, random = {}, celspan.random "wood firs"
  for i = 1, 74 do
    local x = LEFT + W * (i - 0.5 + 0.6 * (random("x" .. i) - 0.5)) / 74
    local y = 690 + 34 * math.sin(x / 210 + 1) + 16 * math.sin(x / 83 + 2)
    fir(parts, x, y + 26 + 10 * random("y" .. i), 84 + 56 * random("h" .. i), "#5a60a4", "#9fa6dd")
  end
  parts[#parts + 1] = shapes.ridge(points, BOTTOM, shapes.down(650, 860, { "#7d83c4", "#8d90cc" }))
  return parts
end

--- Brushed snow on the ground of a row.
local function slope(r)
  local points = {}
  for x = LEFT - 20, LEFT + W + 20, 40 do points[#points + 1] = { x, plan.ground(r, x) } end
  local level = plan.ground(r, plan.MIDDLE)
  local land = shapes.ridge(points, BOTTOM,
    shapes.down(level - 10, level + 230, { "#bcc5f0", "#97a2da" }))
  local random, marks = celspan.random("slope" .. r), {}
  for i = 1, 46 do
    local x = LEFT + W * random("x" .. i)
    local y = plan.ground(r, x) + 150 * random("y" .. i) ^ 1.3
    marks[i] = brush(x, y, 50 + 90 * random("l" .. i), 3 + 7 * random("w" .. i),
      (x - plan.MIDDLE) / 60, 4,
      i % 2 == 0 and SNOW or SHADE, 0.5)
  end
  return { land, clip(union(marks), land) }
end

--- The road up the hill, between the houses of its rows.
local function road(from, to)
  local points = {}
  for i = 0, 8 do
    local r = from + (to - from) * i / 8
    local low, high = math.floor(r), math.ceil(r)
    local y = plan.ground(low, plan.MIDDLE) * (high - r) + plan.ground(high, plan.MIDDLE)
      * (low == high and 1 or r - low)
    points[#points + 1] = { plan.road(r), y + 6, 8 + 7 * (r - 1) }
  end
  return stroke { points = points, degree = 3, cap = "round", fill = "#cfd7f6" }
end

local function town()
  local parts, random = {}, celspan.random "town firs"
  for r = 1, 5 do
    for _, part in ipairs(slope(r)) do parts[#parts + 1] = part end
    if r > 1 then parts[#parts + 1] = road(r == 5 and 6 or r, r - 1) end
    if r > 1 and r < 5 then
      for i = 1, 7 do
        local x = plan.MIDDLE + (random("x" .. r .. i) - 0.5) * (700 + 500 * r)
        fir(parts, x, plan.ground(r, x) + 2, 44 + 20 * r, "#4c5298", "#b3bcec")
      end
    end
    for _, home in ipairs(plan.houses) do
      if home.row == r then parts[#parts + 1] = home.object end
    end
  end
  return parts
end

--- The near bank with firs on both sides, which frames the picture.
local function near()
  local parts, random = {}, celspan.random "near firs"
  local spots = { { -130, 1090, 560 }, { 40, 1120, 420 }, { 170, 1110, 300 }, { 2080, 1100, 600 },
    { 1930, 1130, 400 },
    { 1790, 1120, 270 }, { -260, 1100, 480 }, { 2210, 1110, 470 }, { 290, 1130, 190 } }
  for i, spot in ipairs(spots) do
    fir(parts, spot[1], spot[2], spot[3] * (0.95 + 0.1 * random(i)), "#343a7c", "#8792d2")
  end
  parts[#parts + 1] = shapes.ridge({ { LEFT, 1010 }, { 60, 1024 }, { 420, 1066 }, { 800, 1092 },
    { 1200, 1090 },
    { 1560, 1066 }, { 1840, 1030 }, { LEFT + W, 1006 } }, BOTTOM,
      shapes.down(1000, 1110, { "#9ca7e0", "#6d78bf" }))
  for i = 1, 30 do
    local x = LEFT + W * random("bx" .. i)
    parts[#parts + 1] = brush(x, 1075 + 90 * random("by" .. i), 90 + 120 * random("bl" .. i),
      5 + 8 * random("bw" .. i), 1, 5,
      i % 2 == 0 and "#b9c2ee" or "#5f6ab4", 0.45)
  end
  return parts
end

local layers = {
  { name = "clouds", union(clouds()) },
  { name = "peaks", table.unpack(peaks()) },
  { name = "wood", table.unpack(wood()) },
  { name = "town", table.unpack(town()) },
  { name = "near", table.unpack(near()) },
}

for _, layer in ipairs(layers) do
  local art = union(table.move(layer, 1, #layer, 1, {})):translate(-LEFT, -TOP)
  local picture = draw(art, W, H, FINE)
  layer.x, layer.y, layer.png = picture.x, picture.y, picture.png
end
local file = assert(io.open(arg[1] or "scripts/film/town.ora", "wb"))
assert(file:write(paintings.openraster { w = FINE * W // 1, h = FINE * H // 1, layers = layers }))
file:close()
