-- The wood of fox.lua: trunks in planes that pass by at their own speeds, light between them, and
-- leaves that fall.

local LONG = 1600 -- units after which a plane is repeated

--- A trunk that leans, dark on the side away from the light, down to `foot`.
local function trunk(x, width, lean, tint, foot)
  local dark = colour.lighten(tint, -0.12)
  local data = ("M%.1f %d C%.1f 360 %.1f 200 %.1f -10 H%.1f C%.1f 200 %.1f 380 %.1f %d Z"):format(
    x - width, foot, x - width * 0.4, x - width * 0.5 + lean, x - width * 0.4 + lean,
    x + width * 0.4 + lean, x + width * 0.5 + lean, x + width * 0.5, x + width, foot)
  return path { d = data, fill = linear { from = { x - width, 0 },
    to = { x + width, 0 }, { 0, tint }, { 0.35, tint }, { 1, dark } } }
end

local function plane(seed, count, width, tint, foot)
  local random, trunks = celspan.random(seed), {}
  for i = 1, count do
    local x = LONG * (i - 0.5 + 0.6 * (random("x" .. i) - 0.5)) / count
    trunks[i] = trunk(x, width * (0.7 + 0.6 * random("w" .. i)), 40 * (random("lean" .. i) - 0.5),
      tint, foot)
  end
  local row = union(trunks)
  return union { row, row:translate(LONG, 0) }
end

local light = rect { 0, 0, 960, 540, fill = linear { from = { 0, 0 },
  to = { 0, 500 }, { 0, "#e7b65c" }, { 0.55, "#f8e3a6" }, { 1, "#f3d79a" } } }
local planes = { { plane("far", 17, 15, "#d9b069", 490), 0.15 },
                 { plane("middle", 11, 22, "#b88649", 490), 0.35 },
                 { plane("near", 6, 36, "#8a5a36", 490), 0.65 } }

--- Bushes far away, which hide where the ground ends.
local function bushes(seed, y, tint)
  local random, row = celspan.random(seed), {}
  for i = 1, 40 do
    row[i] = ellipse { LONG * (i + random("x" .. i)) / 40, y, 24 + 40 * random("w" .. i),
      10 + 34 * random("h" .. i), fill = tint }
  end
  return union { union(row), union(row):translate(LONG, 0) }
end
table.insert(planes, 2, { bushes("thicket", 470, "#d6a455"), 0.24 })
table.insert(planes, 4, { bushes("hedge", 478, "#b67f38"), 0.48 })
local front = plane("front", 1, 62, "#3a2318", 600)
local ground = path { d = "M0 470 Q240 448 480 466 T960 462 V540 H0 Z",
  fill = linear { from = { 0, 455 }, to = { 0, 540 }, { 0, "#c9853a" },
    { 1, "#7d4520" } } }

local falling = particles { seed = "leaves", rate = 9, life = 5, at = { -200, -60, 2600, 40 },
                            velocity = { -20, 110, 30, 30 } }
local lying = {}
for i = 1, 260 do
  local random = celspan.random("leaf " .. i)
  local x, y = LONG * random "x", 470 + 66 * random "y" ^ 1.4
  lying[i] = ellipse { 0, 0, 9, 3.2, fill =
    colour.mix("#e8a13a", "#b2401e", random "hue") }:rotate(60 * random "turn" - 30):translate(x, y)
end
local carpet = union(lying)

--- Leaves in the air, which rock as they fall.
local function leaves(time, way)
  local list = {}
  for i, p in ipairs(falling:at(time + 8)) do
    local rock = math.sin(3 * p.age + p.id)
    list[i] = path { d = "M-11 0 Q0 -8 11 0 Q0 8 -11 0 Z",
      fill = colour.mix("#f0b13f", "#c4441e", p.id % 7 / 6) }
      :scale(1, 0.3 + 0.6 * math.abs(rock)):rotate(50 * rock)
      :translate((p.x + 30 * rock - 0.8 * way) % 1100 - 60, p.y)
  end
  return union(list)
end

return function(time, way, fox)
  local cels = { cel { light } }
  for _, at in ipairs(planes) do
    cels[#cels + 1] = cel { at[1]:translate(-at[2] * way % LONG - LONG, 0) }
  end
  local x = -way % LONG - LONG
  cels[#cels + 1] = cel { ground, carpet:translate(x, 0), carpet:translate(x + LONG, 0) }
  local shadow = fox:scale(1, -0.14, 0, 499):paint "#3c1c0a"
  cels[#cels + 1] = cel { shadow:translate(-way, 0), opacity = 0.5, defocus = 4 }
  cels[#cels + 1] = cel { fox:translate(-way, 0) }
  cels[#cels + 1] = cel { leaves(time, way) }
  cels[#cels + 1] = cel { front:translate(-1.6 * way % LONG - LONG, 0), defocus = 14 }
  cels.camera = { centre = { 476, 304 }, width = 836 }
  return rostrum(cels)
end
