-- Endless stairs: four flights of 3, 1, 1 and 3 steps. What two of them are longer is, in the
-- picture, just what all rise, so that the eighth step is the first one.
local geometry = require "town.geometry"

local stairs = {}

local STEP, RISE, WIDE, DEEP = 88, 22, 58, 420
local X, Y = 72, 410 -- the middle of the lowest landing

-- The way to the next step: along x or y, and its sign.
local ways = { { 1, 0 }, { 1, 0 }, { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 }, { 0, -1 }, { 0, -1 } }
local landings = { [0] = { 0, 0 } }
for i, way in ipairs(ways) do
  local before = landings[i - 1]
  landings[i] = { before[1] + STEP * way[1], before[2] + STEP * way[2] }
end

--- A place on the stairs in the picture, after a number of steps that need not be whole.
function stairs.place(steps, climbed)
  local whole = steps // 1 % 8
  local from, to, part = landings[whole], landings[whole + 1], steps % 1
  local x, y = geometry.at(from[1] + (to[1] - from[1]) * part, from[2] + (to[2] - from[2]) * part,
    RISE * (whole + (climbed or part)))
  return X + x, Y + y
end

--- The step n, 0 to 7: its corner, and how far it reaches along and away. The landings at the
--- corners, of which each is where the way turns, are narrower than the steps between them.
local function is_corner(n) return ways[(n - 1) % 8 + 1][1] ~= ways[n % 8 + 1][1] end
local function stair(n)
  local reach = { -WIDE / 2, -WIDE / 2, WIDE / 2, WIDE / 2 }
  for _, side in ipairs { { n - 1, -1 }, { n, 1 } } do
    local way, other = ways[side[1] % 8 + 1], is_corner((n + side[2]) % 8)
    local far = is_corner(n) == other and STEP / 2 or other and STEP - WIDE / 2 or WIDE / 2
    local axis = way[1] ~= 0 and 1 or 2
    local sign = way[axis] * side[2]
    reach[sign > 0 and axis + 2 or axis] = sign * far
  end
  local at = landings[n]
  return at[1] + reach[1], at[2] + reach[2], reach[3] - reach[1], reach[4] - reach[2]
end

--- Whether one who goes up from step n turns to the left, and whether one is seen from behind.
function stairs.way(n)
  local way = ways[n % 8 + 1]
  return way[1] < 0 or way[2] < 0, way[1] < 0 or way[2] > 0
end

--- All steps, those behind first; tones: of their tops, left and right sides; and that of doors.
function stairs.house(tones, dark)
  local parts = {}
  local arch = (rect { -13, 0, 26, 52 } | circle { 0, 0, 13 }):paint(dark)
  for _, n in ipairs { 5, 4, 6, 7, 0, 1, 2, 3 } do
    local x, y, along, away = stair(n)
    parts[#parts + 1] = geometry.box(x, y, RISE * n - DEEP, along, away, DEEP, tones)
  end
  for n = 0, 2 do
    for floor = 0, 1 do
      parts[#parts + 1] = geometry.on_left(arch, STEP * n + 6, -WIDE / 2,
        RISE * n - 62 - 104 * floor)
    end
  end
  return union(parts):translate(X, Y)
end

return stairs
