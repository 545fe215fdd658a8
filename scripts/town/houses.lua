-- The houses of the town: five tiers of a hill, nearly black in front and pale at the top, each
-- with snow on its roof. Their windows are those of town/boxes.csv, which has to be kept in step.
local moods = require "stage.moods"

local storm, snow = moods.storm, moods.snow

-- Of a tier: the colour of its walls, of the snow on its roofs, and of the shade of that snow.
local tiers = {
  A = { wall = mix(storm.far, storm.sky[3], 0.22), snow = "#a9b9bd", shade = "#8d9ea2" },
  B = { wall = mix(storm.near, storm.far, 0.62), snow = "#b4c6cf", shade = "#869aa3" },
  C = { wall = mix(storm.ground, storm.near, 0.85), snow = "#c3d5de", shade = "#8ba4b2" },
  D = { wall = mix(storm.ink, storm.ground, 0.75), snow = snow.sky[2], shade = snow.near },
  E = { wall = storm.ink, snow = "#93abbb", shade = "#587083" },
}

-- Name, left, right, eaves, foot, kind of roof, its height, and where its chimney is, 0 to 1.
local plans = {
  { "A1", 878, 950, 352, 424, "gable", 36, 0.75 }, { "A2", 984, 1055, 347, 424, "step", 42 },
  { "A3", 1086, 1152, 354, 424, "hip", 26, 0.3 }, { "A4", 1174, 1232, 322, 424, "gable", 58, 0.82 },
  { "A5", 1322, 1382, 348, 424, "gable", 44 }, { "A6", 1424, 1492, 354, 426, "hip", 28, 0.7 },
  { "B1", 538, 634, 438, 526, "hip", 26, 0.24 }, { "B2", 662, 750, 436, 524, "gable", 36 },
  { "B3", 786, 884, 438, 522, "step", 32, 0.2 }, { "B4", 918, 1012, 434, 522, "gable", 34, 0.72 },
  { "B5", 1086, 1184, 438, 522, "hip", 24 }, { "B6", 1240, 1332, 436, 522, "gable", 34, 0.26 },
  { "B7", 1396, 1494, 438, 522, "hip", 28, 0.8 }, { "B8", 1550, 1642, 436, 526, "gable", 36 },
  { "C1", 412, 530, 544, 662, "gable", 38, 0.76 }, { "C2", 562, 682, 546, 656, "hip", 28, 0.2 },
  { "C3", 712, 830, 542, 654, "step", 38 }, { "C4", 852, 968, 546, 652, "gable", 36, 0.3 },
  { "C5", 1077, 1195, 544, 652, "gable", 38 }, { "C6", 1232, 1350, 546, 652, "hip", 28, 0.74 },
  { "C7", 1388, 1504, 542, 654, "gable", 38, 0.22 }, { "C8", 1542, 1660, 546, 656, "step", 34 },
  { "C9", 1720, 1842, 542, 664, "gable", 40, 0.3 },
  { "D1", 404, 546, 700, 862, "gable", 40, 0.78 }, { "D2", 562, 738, 698, 860, "hip", 34, 0.16 },
  { "D3", 752, 898, 702, 858, "step", 50, 0.8 }, { "D4", 1016, 1194, 700, 858, "hip", 34, 0.84 },
  { "D5", 1206, 1344, 698, 858, "gable", 42, 0.24 }, { "D6", 1354, 1516, 700, 858, "step", 36 },
  { "D7", 1526, 1656, 700, 862, "gable", 40, 0.3 },
  { "E1", -30, 384, 652, 1100, "gable", 152, 0.8 },
  { "E6", 1664, 1956, 762, 1100, "gable", 108, 0.3 },
}

-- Sheds without windows between the houses, in front of their neighbours or behind them.
local sheds = {
  { "A", 944, 990, 384, 424, "hip", 18 }, { "A", 1060, 1084, 376, 424, "gable", 22 },
  { "A", 1378, 1428, 388, 426, "gable", 20 }, { "B", 628, 668, 470, 524, "gable", 22 },
  { "B", 744, 790, 478, 524, "hip", 18 }, { "B", 880, 920, 466, 522, "gable", 24 },
  { "B", 1180, 1244, 474, 522, "hip", 20 }, { "B", 1328, 1400, 480, 522, "gable", 26 },
  { "B", 1490, 1554, 474, 524, "hip", 20 }, { "C", 524, 568, 590, 660, "hip", 20 },
  { "C", 678, 716, 582, 654, "gable", 28 }, { "C", 826, 858, 596, 654, "gable", 22 },
  { "C", 1190, 1236, 588, 652, "hip", 20 }, { "C", 1346, 1392, 600, 654, "gable", 26 },
  { "C", 1500, 1548, 592, 656, "hip", 22 }, { "C", 1654, 1724, 604, 662, "gable", 30 },
  { "D", 1190, 1212, 764, 858, "gable", 16 }, { "D", 1340, 1360, 742, 858, "gable", 14 },
}

--- The line of a roof from eave to eave, as a list of points.
local function ridge(kind, left, right, eaves, rise)
  local middle, over = (left + right) / 2, 5
  if kind == "gable" then
    return { { left - over, eaves + 3 }, { middle, eaves - rise }, { right + over, eaves + 3 } }
  elseif kind == "hip" then
    local inset = 0.9 * rise
    return { { left - over, eaves + 2 }, { left + inset, eaves - rise },
      { right - inset, eaves - rise }, { right + over, eaves + 2 } }
  end
  local points, half = {}, (right - left) / 2
  for i = 0, 3 do
    local x, y = left + half * i / 4, eaves - rise * (i + 1) / 4
    points[#points + 1], points[#points + 2] = { x, y }, { x + half / 4, y }
  end
  for i = #points, 1, -1 do points[#points + 1] = { left + right - points[i][1], points[i][2] } end
  return points
end

--- Snow that lies on a line, thicker at its ridge, its light side to the left.
local function covered(points, deep, tier)
  local back, light = {}, {}
  for i, p in ipairs(points) do
    local is_end = i == 1 or i == #points
    back[i] = { p[1], p[2], deep * (is_end and 0.7 or 1.15) }
    light[i] = { p[1] - 0.12 * deep, p[2] - 0.22 * deep, 0.62 * back[i][3] }
  end
  return stroke { points = back, cap = "round", join = "round", fill = tier.shade }
    | stroke { points = light, cap = "round", join = "round", fill = tier.snow }
end

local function chimney(plan, tier)
  if not plan[8] then return union {} end
  local left, right, eaves, rise = plan[2], plan[3], plan[4], plan[7]
  local wide = 0.085 * (right - left)
  local x = left + plan[8] * (right - left)
  local top = eaves - rise - 0.7 * wide
  return rect { x, top, wide, rise + wide, fill = tier.wall }
    | rect { x - 0.15 * wide, top - 0.5 * wide, 1.3 * wide, 0.7 * wide, radius = 0.35 * wide,
      fill = tier.snow }
end

local function house(plan)
  local letter = plan[1]:sub(1, 1)
  local tier = tiers[letter]
  local left, right, eaves, foot = plan[2], plan[3], plan[4], plan[5]
  local points = ridge(plan[6], left, right, eaves, plan[7])
  local shift = letter == "E" and 0 or 0.3 * (left * 7 % 11 / 11)
  local wall = { { left, foot }, { left, eaves }, fill = mix(tier.wall, storm.sky[3], 0.5 * shift) }
  for _, p in ipairs(points) do wall[#wall + 1] = p end
  wall[#wall + 1], wall[#wall + 2] = { right, eaves }, { right, foot }
  local deep = math.max(4.5, 0.055 * (right - left))
  return chimney(plan, tier) | polygon(wall) | covered(points, deep, tier)
end

local houses = { tiers = tiers }

--- Outlines of the houses with windows, from the hill to the front: the letter of their tier, the
--- points of the roof from eave to eave, and those of the house with it.
function houses.outlines()
  local list = {}
  for i, plan in ipairs(plans) do
    local left, right, eaves, foot = plan[2], plan[3], plan[4], plan[5]
    local roof = ridge(plan[6], left, right, eaves, plan[7])
    local wall = { { left, foot }, { left, eaves } }
    table.move(roof, 1, #roof, 3, wall)
    wall[#wall + 1], wall[#wall + 2] = { right, eaves }, { right, foot }
    list[i] = { tier = plan[1]:sub(1, 1), roof = roof, wall = wall }
  end
  return list
end

--- All houses of a tier, "A" to "E".
function houses.of(tier)
  local list = {}
  for _, set in ipairs { sheds, plans } do
    for _, plan in ipairs(set) do
      if plan[1]:sub(1, 1) == tier then list[#list + 1] = house(plan) end
    end
  end
  return union(list)
end

--- Where smoke rises, and how large: the chimneys of five houses.
function houses.chimneys()
  local list = {}
  for _, plan in ipairs(plans) do
    if ("A4 B3 C6 C1 D3"):find(plan[1]) then
      local wide = 0.085 * (plan[3] - plan[2])
      list[#list + 1] = { plan[2] + plan[8] * (plan[3] - plan[2]) + wide / 2,
        plan[4] - plan[7] - 1.4 * wide, wide }
    end
  end
  return list
end

--- The church: its tower, its spire with a kite that hangs on it, and its nave.
function houses.church()
  local tier = tiers.A
  local wall = mix(tier.wall, storm.near, 0.35)
  return polygon { { 1296, 424 }, { 1296, 372 }, { 1306, 346 }, { 1362, 346 }, { 1374, 372 },
      { 1374, 424 }, fill = tier.wall }
    | covered({ { 1294, 374 }, { 1306, 346 }, { 1362, 346 }, { 1377, 375 } }, 6, tier)
    | polygon { { 1250, 426 }, { 1252, 250 }, { 1300, 250 }, { 1302, 426 }, fill = wall }
    | polygon { { 1244, 254 }, { 1276, 112 }, { 1308, 254 }, fill = mix(wall, storm.ink, 0.25) }
    | polygon { { 1244, 254 }, { 1276, 112 }, { 1279, 128 }, { 1264, 214 }, { 1270, 254 },
      fill = tier.snow }
    | rect { 1247, 250, 58, 6, fill = tier.snow } | rect { 1249, 318, 54, 4, fill = tier.shade }
    | stroke { width = 1, fill = storm.ink, points = { { 1280, 134 }, { 1290, 150 } } }
    | polygon { { 1288, 146 }, { 1299, 150 }, { 1304, 168 }, { 1290, 160 },
      fill = snow.accent }
    | stroke { width = 1, fill = snow.accent,
      d = "M1304 168 C1312 172 1304 180 1310 186 S1306 196 1312 200" }
end

return houses
