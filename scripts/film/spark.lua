-- The little one: a spark that lives at the tip of the lamplighter's pole.
local light = require "film.light"
local shapes = require "demo.shapes"

local spark = {}

--- Paint too thin to hide anything shows under a light as strong as this.
local BRIGHT = { 9, 9, 9 }

--- The spark at (x, y) of the frame, `size` units large, `life` 0..1, with the trail of its flight:
--- points {x, y}, the oldest first. Two cels: its glow and itself.
function spark.draw(time, x, y, size, life, trail)
  local breath = light.flicker(time)
  local glow = shapes.glow(x, y, size * 9 * (0.5 + 0.5 * life), 1, 0.46, 0.13, 0.09 * life * breath)
  local core = size * (0.55 + 0.45 * life) * breath
  local ember = mix("#7a2418", "#ffb048", life)
  local body = {
    circle { x, y, core, fill = radial {
      centre = { x, y }, radius = core, { 0, mix("#d0482a", "#fff6dc", life) },
      { 0.45, mix("#b03a22", "#ffe09a", life) }, { 1, ember } } },
  }
  if trail and #trail > 3 then
    local points = {}
    for i, p in ipairs(trail) do points[i] = { p[1], p[2], core * 1.5 * i / #trail } end
    table.insert(body, 1, stroke { points = points, degree = 3, cap = "round",
      fill = rgb("#ffab4a", 0.7 * life) })
  end
  return cel { glow, front = BRIGHT }:named "spark glow",
    cel { union(body), front = light.scaled({ 1.5, 1.35, 1.2 }, 0.6 + 0.6 * life) }
      :named "spark"
end

--- The trail of a spark at the fraction u of `way`, of the given length: the oldest point first.
function spark.trail(way, u, length)
  local points = {}
  for i = 0, 9 do points[i + 1] = { way:at(math.max(0, u - length * (1 - i / 9))) } end
  return points
end

--- Sparks that fly off: from (x, y) outwards, falling, gone after `lasts` seconds.
function spark.burst(age, x, y, reach, lasts)
  if age < 0 or age > lasts then return nil end
  local u, parts = age / lasts, {}
  local out = 1 - (1 - u) ^ 3
  for i = 1, 13 do
    local a = i * 2.39996
    local dx, dy = math.cos(a), 0.9 * math.sin(a)
    local far = reach * (0.4 + 0.6 * (i * 7 % 13) / 13) * out
    local tail = far - reach * 0.34 * (1 - u)
    local fall, wide = 130 * u * u, reach * (0.05 + 0.03 * (i % 3)) * (1 - u)
    parts[i] = stroke { cap = "round", fill = "#ffd48a", points = {
      { x + math.max(0, tail) * dx, y + math.max(0, tail) * dy + fall, 0.2 * wide },
      { x + far * dx, y + far * dy + fall, wide } } }
  end
  return cel { union(parts), front = { 2, 1.7, 1.3 } }:named "burst"
end

--- A puff of smoke that rises from (x, y), rolls up and thins out; `thick` is 1 by default.
function spark.puff(age, x, y, size, thick)
  if age < 0 or age > 1.5 then return nil end
  local u, parts, paint = age / 1.5, {}, thick or 1
  local out = 1 - (1 - u) ^ 2
  for i = 1, 6 do
    local a = i * 2.4
    local radius = size * (0.3 + 0.5 * out) * (0.7 + 0.3 * (i % 3))
    local px = x + size * (0.75 * math.cos(a) * out + 0.5 * u * math.sin(3 * u + i))
    local py = y - size * (2.3 * out * (0.6 + 0.1 * i)) + size * 0.4 * math.sin(a)
    parts[i] = circle { px, py, radius, fill = radial {
      centre = { px, py }, radius = radius, { 0, rgb("#c5c2e6", 0.5 * paint * (1 - u)) },
      { 0.6, rgb("#b4b1dc", 0.34 * paint * (1 - u)) }, { 1, rgb("#a9a6d6", 0) } } }
  end
  return cel { union(parts) }:named "puff"
end

return spark
