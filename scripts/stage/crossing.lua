--- Three wet crossings from above, at night, each in a tile, and the lights of their cars.
local label = require "stage.label"
local mood = require("stage.moods").storm
local W, H = 200, 336

local function line(d, width, tint)
  return stroke { d = d, width = width, fill = tint, cap = "round" }
end

--- An umbrella from above.
local function umbrella(x, y, tint)
  local ribs = {}
  for i = 1, 8 do ribs[i] = rect { 0, -0.5, 10, 1, fill = "#00000050" }:rotate(45 * i) end
  return union { circle { 3, 4, 10, fill = "#00000050" }, circle { 0, 0, 10, fill = tint },
    union(ribs), circle { 0, 0, 1.5, fill = mood.ink } }:translate(x, y)
end

local stripes = {}
for i = 0, 6 do
  stripes[#stripes + 1] = rect { 57 + 13 * i, 222, 7, 24, fill = "#6f7f80" }
  stripes[#stripes + 1] = rect { 57 + 13 * i, 84, 7, 24, fill = "#6f7f80" }
end
local corner = rect { 0, 0, 90, 160, radius = 26, fill = mood.near }
  | rect { 0, 0, 84, 154, radius = 22, fill = "#3d4d51" }
local roof = rect { 0, 0, 64, 130, radius = 4, fill = mood.ink }
  | rect { 0, 0, 60, 126, radius = 3, fill = "#2b383d" } | rect { 12, 84, 22, 16, fill = mood.ink }
local still = union {
  rect { 0, 0, W, H, fill = mood.ground },
  line("M100 -10V70M100 262V350", 1.6, mood.far), line("M-10 165H36M164 165H210", 1.6, mood.far),
  union(stripes), corner:translate(-42, -44), corner:translate(152, -44),
  corner:translate(-42, 214), corner:translate(152, 214), roof:translate(-34, -62),
  roof:translate(176, -70), roof:translate(-38, 252), roof:translate(170, 262),
  umbrella(54, 238, "#84918a"), umbrella(100, 232, mood.accent), umbrella(30, 88, mood.far),
  umbrella(168, 232, mood.far), umbrella(102, 98, "#84918a") }

local drops = {}
for i = 1, 70 do
  local random = celspan.random("drop" .. i)
  drops[i] = rect { W * random "x", H * random "y", 0.8, 5 + 8 * random "long",
    fill = rgb("#dfe6cf", 0.22) }
end

--- The ways of four cars, their starts in units, and how fast they are.
local cars = {
  { "M78 -160V440", 40, 330 }, { "M122 440V-200", 40, 260 },
  { "M-130 186C60 186 122 176 122 60V-200", 10, 300 }, { "M330 144H-200", -84, 340 } }
for _, car in ipairs(cars) do car.way = motion.along(car[1]) end

-- Each exposure adds its light, so the cars are lighter than the wet road.
local body = rect { 0, -11, 42, 22, radius = 7, fill = "#5d7a84" }
  | rect { 11, -8.5, 20, 17, radius = 4, fill = "#22343b" }

--- Two lights of a car, across its way.
local function pair(way, at, tint)
  local x, y, direction = way:at(at / way.length)
  local glow = circle { 0, 0, 10, fill = radial { centre = { 0, 0 }, radius = 10,
    { 0, rgb(tint, 0.3) }, { 1, rgb(tint, 0) } } } | ellipse { 0, 0, 8, 2.3, fill = tint }
  return (glow:translate(0, -8) | glow:translate(0, 8)):rotate(direction):translate(x, y)
end

local frame, tiles = rect { 0, 0, W, H, radius = 8 }, {}
for i, name in ipairs { "1", "4", "16" } do
  tiles[i] = (clip(still | union(drops), frame) | label(name, 24, 318, mood.light, 22))
    :translate(208 * i - 196, 12)
end

table.insert(tiles, 1, rect { 0, 0, 640, 360, fill = mood.ink })
return { streets = cel(tiles), lights = function(tile, time)
  local lights = {}
  for i, car in ipairs(cars) do
    local front = car[2] + car[3] * time
    local x, y, direction = car.way:at(front / car.way.length)
    lights[i] = body:fade(4 ^ (1 - tile)):rotate(direction):translate(x, y)
      | pair(car.way, front + 36, "#fff3c4") | pair(car.way, front, "#ff3b24")
  end
  return clip(union(lights), frame):translate(208 * tile - 196, 12)
end }
