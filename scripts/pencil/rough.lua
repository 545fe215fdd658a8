-- Makes the scans of pencil.lua: drawings in pencil on punched paper, as a scanner sees them, each
-- laid a little askew on its glass. No hand has drawn them. From the top of the tree:
--
--   LUA_CPATH='build/?.so' lua5.4 scripts/pencil/rough.lua scripts/pencil
local folder = arg[1]
package.path = folder .. "/?.lua;" .. package.path
local celspan = require "celspan"
local frog = require "frog"

local W, H, UNIT = 780, 561, 75 / 25.4 -- pixels, and pixels of a millimetre: 75 dpi
local BED, PAPER = "#181716", "#ece6d8"
local colours = { black = "#35322f", blue = "#8fb4d6" }

local function circle(x, y, r, fill)
  return celspan.circle { centre = { x, y }, radius = r, fill = fill }
end

--- A line of a pencil: not quite where it should be, and not pressed alike on its way; one with two
--- ends is thin there.
local function pencilled(line, random, name)
  local points, count = {}, #line.points
  local first, last = line.points[1], line.points[count]
  local is_closed = first[1] == last[1] and first[2] == last[2]
  local press, turn = line.pencil == "blue" and 1.3 or 2.3, 6.28 * random(name)
  for i, p in ipairs(line.points) do
    local u = (i - 1) / (count - 1)
    local shake = math.sin(9 * u + turn) * 0.35
    local hand = 0.86 + 0.24 * math.sin(12.566 * u + turn) + 0.16 * math.sin(31.416 * u - turn)
    local tip = is_closed and 1 or math.min(1, 0.66 + 4 * u, 4.66 - 4 * u)
    points[i] = { p[1] + shake, p[2] - shake,
      press * tip * (hand + 0.12 * random(name .. i // 3)) }
  end
  return celspan.stroke { points = points, cap = "round", join = "round",
    fill = colours[line.pencil] }
end

--- A sheet of 256 by 184 mm with the holes of ACME, 12 mm below its upper edge.
local function sheet(lines, random)
  local list = { celspan.rect { 12, 0, W - 24, H - 14, fill = PAPER } }
  for _, pencil in ipairs { "blue", "black" } do
    for i, line in ipairs(lines) do
      if line.pencil == pencil then list[#list + 1] = pencilled(line, random, pencil .. i) end
    end
  end
  local y = 12 * UNIT
  list[#list + 1] = circle(W / 2, y, 3.175 * UNIT, BED)
  for _, side in ipairs { -1, 1 } do
    list[#list + 1] = celspan.rect { W / 2 + (side * 101.6 - 6.35) * UNIT, y - 1.6 * UNIT,
      12.7 * UNIT, 3.2 * UNIT, fill = BED }
  end
  return celspan.union(list)
end

--- Where lines are, the paper's tooth shows through; elsewhere few fibres lie.
local function grained(bytes, random)
  local out, r, g, b = {}, 0xec, 0xe6, 0xd8
  local state = random "tooth" * 2 ^ 31 // 1 | 1
  for i = 1, #bytes, 4 do
    state = (state * 1103515245 + 12345) & 0x7fffffff
    local chance = (state >> 8 & 0xffff) / 0xffff
    local x, y, z = bytes:byte(i, i + 2)
    local across, down = (i // 4) % W, (i // 4) // W
    local is_inside = across > 40 and across < W - 40 and down > 56 and down < H - 30
    local is_line = is_inside and r - x + g - y > 6
    if is_line then
      local share = 0.4 * (chance * 3 // 1) / 2
      x, y, z = x + (r - x) * share, y + (g - y) * share, z + (b - z) * share
      x, y, z = x // 40 * 40, y // 40 * 40, z // 40 * 40
    elseif x > 200 and chance < 0.0003 then
      x, y, z = x - 8, y - 8, z - 8
    end
    out[#out + 1] = string.char(x // 1, y // 1, z // 1)
  end
  return table.concat(out)
end

local function write(level, number, lines)
  local random = celspan.random(level .. number)
  local turn, dx, dy = 3 * random "turn" - 1.5, 10 * random "x" - 5, 6 * random "y" + 4
  local page = sheet(lines, random):rotate(turn, W / 2, H / 2):translate(dx, dy)
  local film = celspan.rostrum { back = BED, space = "srgb", celspan.cel { page } }
  local image = assert(celspan.pixels(film, { size = { W, H }, film = { W, H } }))
  local scan = celspan.image { pixels = grained(image:bytes { dither = false }, random),
    size = { W, H }, format = "rgb8", x = 0, y = 0 }
  assert(celspan.render(celspan.rostrum { celspan.cel { scan } },
    ("%s/%s.%04d.png"):format(folder, level, number), { size = { W, H }, film = { W, H } }))
end

for i, pose in ipairs(frog.poses) do
  write("body", i, frog.body(pose))
  if pose.limbs then write("legs", i, frog.legs(pose)) end
end
for i, lines in ipairs(frog.mouths) do write("mouth", i, lines) end
