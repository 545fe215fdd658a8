-- Cut paper for windows of the town: pieces with rough edges, a white edge of 2 and a hard shadow.
--
--   local fish = cut.piece("M0 0 C40 -60 120 -60 160 0 C120 60 40 60 0 0 Z", "#c8553d")
--   cut.laid(fish:rotate(8, 80, 0) | cut.pin(80, 0))
local cutout = { WHITE = "#f7efdd", SHADOW = "#0008", BRASS = "#d9a441" }

--- Of a row of points from first to last, those that scissors need to come within 1.3 of all.
local function cuts(points, first, last, list)
  local a, b = points[first], points[last]
  local x, y = b[1] - a[1], b[2] - a[2]
  local length, far, at = math.max(1e-9, (x * x + y * y) ^ 0.5), 1.3, nil
  for i = first + 1, last - 1 do
    local away = math.abs((points[i][1] - a[1]) * y - (points[i][2] - a[2]) * x) / length
    if away > far then far, at = away, i end
  end
  if at then
    cuts(points, first, at, list)
    cuts(points, at, last, list)
  else
    list[#list + 1] = a
  end
end

--- The corners of path data of one line, as scissors cut it: from its beginning to its half, and
--- on to its end.
local function corners(d)
  local line, points, list = motion.along(d), {}, {}
  local count = 2 * math.max(8, line.length // 4)
  for i = 0, count do
    local x, y = line:at(i / count)
    points[i + 1] = { x, y }
  end
  cuts(points, 1, count // 2 + 1, list)
  cuts(points, count // 2 + 1, count + 1, list)
  return list, points[count + 1]
end

--- Points moved outwards, each by at least least and at most most.
local function grown(points, least, most, chance)
  local area, moved = 0, {}
  for i, p in ipairs(points) do
    local q = points[i % #points + 1]
    area = area + p[1] * q[2] - q[1] * p[2]
  end
  local side = area > 0 and 1 or -1
  local function normal(p, q)
    local length = math.max(1e-9, ((q[1] - p[1]) ^ 2 + (q[2] - p[2]) ^ 2) ^ 0.5)
    return side * (q[2] - p[2]) / length, side * (p[1] - q[1]) / length
  end
  for i, p in ipairs(points) do
    local ax, ay = normal(points[(i - 2) % #points + 1], p)
    local bx, by = normal(p, points[i % #points + 1])
    local out = (least + (most - least) * chance(i)) / math.max(0.5, 1 + ax * bx + ay * by)
    moved[i] = { p[1] + out * (ax + bx), p[2] + out * (ay + by) }
  end
  return moved
end

--- A piece of paper in one colour, cut along closed path data, with its edge, white if not given.
function cutout.piece(d, fill, white)
  local chance = random(d)
  local points = grown(corners(d), -0.8, 0.8, chance)
  return polygon(grown(points, 1.4, 2.8, random(fill .. d))):paint(white or cutout.WHITE)
    | polygon(points):paint(fill)
end

--- A strip of paper along path data that may be open: limbs, tails, ropes.
function cutout.strip(d, width, fill)
  local list, last = corners(d)
  list[#list + 1] = last
  local function line(wide, colour)
    return stroke { points = list, width = wide, cap = "round", join = "round", fill = colour }
  end
  return line(width + 4, cutout.WHITE) | line(width, fill)
end

--- A disc, cut by hand.
function cutout.disc(x, y, radius, fill, white)
  return cutout.piece(("M%g %g a%g %g 0 1 1 0 %g a%g %g 0 1 1 0 %g Z"):format(x, y - radius, radius,
    radius, 2 * radius, radius, radius, -2 * radius), fill, white)
end

--- What lies on other paper: with the shadow that it throws.
function cutout.laid(art)
  return art:paint(cutout.SHADOW):translate(3, 3) | art
end

--- The pin of a joint.
function cutout.pin(x, y)
  return circle { x + 0.7, y + 0.9, 4, fill = "#0007" } | circle { x, y, 3.6, fill = cutout.BRASS }
end

--- A number of the drawing to which a pose belongs: poses are held for threes of 24 in twos of 12.
function cutout.held(number) return number - number % 3 % 2 end

return cutout
