-- The town on a sheet of paper, 360 by 202.5: in pencil, as its animator draws it, and in colour,
-- flat, as the last sheet has it.
local houses, panes = require "town.houses", require "town.panes"
local moods, window = require "stage.moods", require "town.window"
local storm, snow, candle = moods.storm, moods.snow, moods.candle

local sheet = {}

local YOURS = "A4a" -- the pane of the attic
local outlines = houses.outlines()

--- From units of the film of 1920 to those of the sheet.
local function on_sheet(parts)
  return clip(union(parts):scale(0.1875), rect { 0, 0, 360, 202.5 })
end

local function polygon_of(points, fill)
  local fields = table.move(points, 1, #points, 1, { fill = fill })
  return polygon(fields)
end

--- Adds the panes of a tier to parts, as draw makes them of a box.
local function add_panes(parts, tier, draw)
  for _, box in ipairs(panes.boxes) do
    if box.box:sub(1, 1) == tier and box.box ~= YOURS then parts[#parts + 1] = draw(box) end
  end
end

--- The town in pencil: houses as outlines with tiny boxes, one of them yellow.
function sheet.pencil(ink)
  local paper = moods.paper.light
  local function line(points, width)
    return stroke { points = points, width = width, fill = ink }
  end
  local function pane(box)
    local x, y, w, h = box.x, box.y, box.width, box.height
    return rect { x - 1, y - 1, w + 2, h + 2, fill = ink }
      | rect { x + 1, y + 1, w - 2, h - 2, fill = paper }
  end
  local parts = { line({ { 1252, 426 }, { 1252, 252 }, { 1276, 112 }, { 1300, 252 },
    { 1300, 426 } }, 3.5), line({ { 1246, 252 }, { 1306, 252 } }, 3.5),
    line({ { 1261, 92 }, { 1291, 92 } }, 2), line({ { 1276, 76 }, { 1276, 106 } }, 2) }
  add_panes(parts, "K", pane)
  local width = { A = 3, B = 3.5, C = 4, D = 4.5, E = 6 }
  for i, house in ipairs(outlines) do
    parts[#parts + 1] = polygon_of(house.wall, paper)
    parts[#parts + 1] = line(house.wall, width[house.tier])
    local following = outlines[i + 1]
    if not following or following.tier ~= house.tier then add_panes(parts, house.tier, pane) end
  end
  parts[#parts + 1] = line({ { 390, 884 }, { 900, 876 }, { 1664, 886 } }, 5)
  parts[#parts + 1] = rect { 1190.4, 297, 25.2, 31.6, fill = ink }
  parts[#parts + 1] = rect { 1193.4, 300, 19.2, 25.6, fill = storm.accent }
  return on_sheet(parts)
end

--- Snow on a roof, as a flat bank.
local function bank(roof, colour)
  local deep = 0.07 * (roof[#roof][1] - roof[1][1])
  local points = table.move(roof, 1, #roof, 1, {})
  for i = #roof, 1, -1 do points[#points + 1] = { roof[i][1], roof[i][2] - deep } end
  return polygon_of(points, colour)
end

local function pane(box)
  local x, y, w, h = box.x, box.y, box.width, box.height
  if w == h then return circle { x + w / 2, y + h / 2, w / 2, fill = box.above } end
  local whole = rect { x, y, w, h, fill = box.above }
  return h < 40 and whole or whole | rect { x, y + 0.64 * h, w, 0.36 * h, fill = box.below }
end

--- What lies before a tier: the hill, and the lane to the church.
local before = {
  A = path { fill = "#8b9b9f", d = "M0 640C300 600 620 440 900 414C1100 404 1300 406 1480 416"
      .. "C1660 436 1780 500 1920 520V1080H0Z" }
    | polygon { { 1252, 426 }, { 1252, 250 }, { 1300, 250 }, { 1300, 426 }, fill = "#58696c" }
    | polygon { { 1244, 254 }, { 1276, 112 }, { 1308, 254 }, fill = "#46565a" }
    | polygon { { 1244, 254 }, { 1276, 112 }, { 1268, 254 }, fill = "#a9b9bd" }
    | polygon { { 1288, 146 }, { 1299, 150 }, { 1304, 168 }, { 1290, 160 }, fill = snow.accent },
  B = path { fill = "#93a6ae", d = "M0 660C180 600 380 530 560 520C900 508 1300 508 1640 520"
      .. "C1760 530 1860 560 1920 580V1080H0Z" }
    | path { fill = "#d3e0e9", d = "M980 660C1050 600 1030 540 1024 510C1060 470 1120 450 1190 426"
      .. "L1206 428C1130 462 1080 490 1058 520C1074 560 1080 600 1046 660Z" },
  C = path { fill = "#a5bac5", d = "M0 690C140 660 300 652 420 650C800 640 1400 640 1840 652"
      .. "L1920 664V1080H0Z" }
    | path { fill = "#d3e0e9", d = "M905 870C905 760 925 690 992 642H1052C1006 700 1002 760 1004 "
      .. "870Z" },
  D = path { fill = snow.sky[1], d = "M0 856C500 846 1400 846 1920 858V1080H0Z" }
    | rect { 904, 764, 102, 84, radius = 9, fill = "#2a3b40" },
  E = path { fill = snow.sky[2], d = "M0 884C500 872 1400 872 1920 884V1080H0Z" }
    | path { fill = snow.sky[3], d = "M0 962C500 940 1400 960 1920 950V1080H0Z" }
    | path { fill = "#c9d9e4", d = "M0 1040C500 1010 1400 1030 1920 1020V1080H0Z" }
    | rect { 592, 774, 116, 18, fill = snow.accent },
}

--- The lamps of the street, and the lamplighter at one of them.
local function street()
  local parts = {}
  for i, x in ipairs { 554, 745, 890, 1236, 1520, 1624 } do
    parts[i] = rect { x - 2, 850, 4, 76, fill = storm.ink }
      | circle { x, 848, 8, fill = candle.light }
  end
  return union(parts) | path { fill = storm.ink, d = "M1250 940l6 -52q9 -26 18 0l6 52z" }
    | circle { 1265, 868, 9, fill = storm.ink } | rect { 1256, 874, 19, 7, fill = snow.accent }
    | polygon { { 1262, 890 }, { 1242, 850 }, { 1245, 849 }, { 1266, 888 }, fill = storm.ink }
end

--- The town in colour: a small flat picture of the whole film, whose attic is yours.
function sheet.town()
  local parts = { rect { 0, 0, 1920, 1080, fill = linear { from = { 0, 0 }, to = { 0, 430 },
    { 0, storm.ink }, { 0.3, storm.sky[1] }, { 0.66, storm.sky[2] }, { 1, "#93a5ae" } } },
    star { 1276, 92, 14, 4, points = 4, fill = snow.light } }
  local last
  for i, house in ipairs(outlines) do
    local tier = houses.tiers[house.tier]
    if house.tier ~= last then parts[#parts + 1] = before[house.tier] end
    if house.tier == "E" and last == "D" then parts[#parts + 1] = street() end
    last = house.tier
    parts[#parts + 1] = polygon_of(house.wall, tier.wall)
    parts[#parts + 1] = bank(house.roof, tier.snow)
    local following = outlines[i + 1]
    if not following or following.tier ~= last then add_panes(parts, last, pane) end
  end
  add_panes(parts, "K", pane)
  add_panes(parts, "S", pane)
  parts[#parts + 1] = rect { 1193.4, 300, 19.2, 25.6, fill = storm.accent }
  parts[#parts + 1] = text { "your\nwindow", at = { 1203, 311 }, size = 5.4, align = "centre",
    font = window.font, fill = storm.ink }
  return on_sheet(parts)
end

return sheet
