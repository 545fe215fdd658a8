-- Sky and land around the town, a thousand units per side.
local palette = require "demo.palette"
local shapes = require "demo.shapes"
local draw = require "terapixel.draw"
local Dice = require "terapixel.dice"

local land = {}

local time = 6.3 -- of the film's evening, in seconds

function land.air()
  local gradient = { from = { 0, 0 }, to = { 0, 980 } }
  for i, stop in ipairs(palette.sky) do gradient[i] = { stop[1], stop[2]:at(time) } end
  return draw.rect(0, 0, 1000, 1000, linear(gradient))
end

function land.sun()
  local rings = {}
  for i, radius in ipairs { 250, 184, 126, 78 } do
    rings[i] = draw.disc(262, 566, radius, rgb(1, 0.55, 0.26, 0.006 + 0.003 * i))
  end
  return union(rings), draw.disc(262, 566, 44, palette.sun:at(time))
end

--- Stars of eight rays, and now and then a smaller one beside it that is only visible in close-up.
function land.stars()
  local dice, parts = Dice.new "stars", {}
  for i = 1, 150 do
    local x, y = dice:between(0, 1000), dice:between(0, 1) ^ 1.4 * 420
    local size = dice:between(0.35, 1.5)
    local d = {}
    for k = 0, 15 do
      local a, r = math.rad(k * 22.5), k % 2 == 1 and 0.34 or k % 4 == 0 and 1 or 0.66
      d[k + 1] = ("%s%.4f %.4f"):format(k == 0 and "M" or "L", x + size * r * math.cos(a),
        y + size * r * math.sin(a))
    end
    parts[#parts + 1] = draw.path("#fff4dc", table.concat(d) .. "Z")
    if i % 4 == 0 then
      parts[#parts + 1] = draw.disc(x + size * 2, y - size, size * 0.06, "#ffb98a")
      parts[#parts + 1] = draw.disc(x + size * 2, y - size, size * 0.03, "#fff4dc")
    end
  end
  return union(parts)
end

local banks = { { 60, 190, 0.5 }, { 560, 120, 0.62 }, { 800, 262, 0.44 }, { 330, 330, 0.4 },
                { -90, 392, 0.36 }, { 640, 404, 0.3 } }
local pills = { { 0, 0, 420 }, { 70, -26, 270 }, { 132, -52, 128 }, { 250, 24, 300 },
                { -90, 26, 190 } }

function land.clouds()
  local parts = {}
  for _, bank in ipairs(banks) do
    for _, pill in ipairs(pills) do
      local s = bank[3]
      parts[#parts + 1] = rect { bank[1] + pill[1] * s, bank[2] + pill[2] * s, pill[3] * s,
                                 26 * s, radius = 13 * s }
    end
  end
  local paint = mix(clear, palette.cloud:at(time), 0.55)
  return clip(draw.rect(-100, 0, 1200, 640, paint), union(parts))
end

--- A crest that swings around a line, closed at the bottom.
local function ridge(name, y, swing, step, texture)
  local dice, points = Dice.new(name), {}
  for x = -step, 1000 + step, step do
    points[#points + 1] = { x, y + dice:between(-swing, swing) }
  end
  return shapes.ridge(points, 1010, texture)
end

land.mountains = union {
  ridge("far", 500, 60, 110, shapes.down(430, 640, palette.mountains)),
  ridge("hills", 590, 22, 130, shapes.down(560, 680, palette.hills)),
}
land.lake = draw.rect(0, 632, 1000, 80, shapes.down(632, 712, palette.lake))
land.glints = draw.rects(palette.glint, { { 60, 642, 120, 1.6 }, { 180, 650, 220, 2 },
  { 250, 662, 140, 2.4 }, { 90, 676, 200, 2.6 }, { 330, 690, 160, 2.4 } })

--- The hill that the town climbs; crest(x) is its height.
local crest_points = { { -60, 742 }, { 90, 724 }, { 220, 664 }, { 340, 576 }, { 450, 490 },
                       { 560, 446 }, { 680, 452 }, { 800, 520 }, { 920, 606 }, { 1060, 668 } }

function land.crest(x)
  for i = 1, #crest_points - 1 do
    local a, b = crest_points[i], crest_points[i + 1]
    if x <= b[1] then return a[2] + (b[2] - a[2]) * (x - a[1]) / (b[1] - a[1]) end
  end
  return 700
end

land.hill = shapes.ridge(crest_points, 1010, shapes.down(440, 900, palette.village))

--- The lane from the church down to the meadow: {x, y, width}.
local lane = { { 612, 450, 3 }, { 640, 494, 5 }, { 590, 552, 8 }, { 668, 632, 11 },
               { 690, 716, 15 }, { 612, 806, 20 }, { 660, 892, 28 }, { 560, 1020, 60 } }

--- The middle of the lane and half its width at a height.
function land.lane(y)
  for i = 1, #lane - 1 do
    local a, b = lane[i], lane[i + 1]
    if y >= a[2] and y <= b[2] then
      local u = (y - a[2]) / (b[2] - a[2])
      return a[1] + (b[1] - a[1]) * u, (a[3] + (b[3] - a[3]) * u) / 2
    end
  end
end

--- The lane with its cobbles, and tufts of grass on the slope.
function land.slope()
  local dice, stones, tufts = Dice.new "slope", {}, {}
  for _ = 1, 900 do
    local y = 456 + dice:between() ^ 0.8 * 540
    local x, half = land.lane(y)
    local s = half * dice:between(0.05, 0.12)
    x = x + dice:between(-0.82, 0.82) * half
    stones[#stones + 1] = ("M%.4f %.4fh%.4fl%.4f %.4fl%.4f %.4fh%.4fl%.4f %.4fZ"):format(
      x, y, s * 2, s, s * 0.6, -s, s * 0.6, -s * 2, -s, -s * 0.6)
  end
  for _ = 1, 900 do
    local x = dice:between(0, 1000)
    local y = land.crest(x) + (960 - land.crest(x)) * dice:between(0.02, 1)
    local s = (y - 400) / 400 * dice:between(1, 2.6)
    tufts[#tufts + 1] = ("M%.4f %.4fl%.4f %.4fl%.4f %.4fl%.4f %.4fl%.4f %.4fl%.4f %.4fZ"):format(
      x, y, -s * 0.7, -s * 1.3, s * 0.6, s * 0.6, s * 0.3, -s * 1.1, s * 0.3, s * 1.1, s * 0.7, -s)
  end
  return union { draw.path("#8a9464", table.concat(tufts)), shapes.ribbon(lane, "#b9a273"),
                 draw.path("#9c8762", table.concat(stones)) }
end

--- A lamp beside the lane: its post, its glass, its light.
function land.lamp(x, y, size)
  local post = union {
    draw.rect(x - size * 0.03, y - size, size * 0.06, size, palette.brass),
    draw.rect(x - size * 0.12, y - size * 0.04, size * 0.24, size * 0.04, palette.brass),
    draw.path(palette.brass, "M%g %gl%g %gl%g %gZ", x - size * 0.16, y - size * 1.24, size * 0.16,
      -size * 0.14, size * 0.16, size * 0.14),
  }
  local glass = draw.path("#ffdf9c", "M%g %gh%gl%g %gh%gZ", x - size * 0.13, y - size * 1.24,
    size * 0.26, -size * 0.05, size * 0.24, -size * 0.16)
  return post, glass, draw.halo(x, y - size * 1.12, size * 0.9, 1, 0.55, 0.18, 0.012)
end
land.ground = ridge("ground", 956, 7, 170, shapes.down(940, 1000, palette.ground))

--- A tree: a crown of discs with leaves on it.
function land.tree(x, y, size, dice)
  local colour = shapes.across(x - size * 0.3, x + size * 0.35, palette.leaves)
  local parts, leaves = { draw.rect(x - size * 0.05, y - size * 0.5, size * 0.1, size * 0.5,
                                    palette.boot) }, {}
  for _, c in ipairs { { 0, -0.72, 0.4 }, { 0.28, -0.55, 0.28 }, { -0.28, -0.52, 0.27 } } do
    parts[#parts + 1] = draw.disc(x + size * c[1], y + size * c[2], size * c[3], colour)
  end
  for _ = 1, 40 do
    local a, r = dice:between(0, 6.283), dice:between(0.06, 0.34) * size
    local lx, ly, s = x + r * math.cos(a), y - size * 0.66 + r * math.sin(a), size * 0.028
    leaves[#leaves + 1] = ("M%.4f %.4fq%.4f %.4f %.4f 0q%.4f %.4f %.4f 0Z"):format(
      lx, ly, s, -s, 2 * s, -s, s, -2 * s)
  end
  parts[#parts + 1] = draw.path("#a2a45a60", table.concat(leaves))
  return union(parts)
end

return land
