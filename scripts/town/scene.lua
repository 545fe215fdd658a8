-- The town without its rooms: what is still, and what moves over it.
local moods = require "stage.moods"
local houses = require "town.houses"
local lamplighter = require "town.lamplighter"
local panes = require "town.panes"
local snowfall = require "town.snowfall"

local W, H = 1920, 1080
local storm, snow = moods.storm, moods.snow

-- ---------------------------------------------------------------- what never moves

local HORIZON = "#93a5ae"

local sky = rect { 0, 0, W, H, fill = linear { from = { 0, 0 }, to = { 0, 430 },
  { 0, storm.ink }, { 0.3, storm.sky[1] }, { 0.5, storm.sky[2] },
  { 0.75, mix(storm.sky[2], HORIZON, 0.4) }, { 1, HORIZON } } }

--- The hill from a line to the foot of the picture.
local function hill(line, fill) return path { d = line .. " V1080 H0 Z", fill = fill } end

local slopes = {
  A = hill("M0 640 C300 600 620 440 900 414 C1100 404 1300 406 1480 416 C1660 436 1780 500 "
    .. "1920 520", "#8b9b9f"),
  B = hill("M0 660 C180 600 380 530 560 520 C900 508 1300 508 1640 520 C1760 530 1860 560 1920 580",
    "#93a6ae"),
  C = hill("M0 690 C140 660 300 652 420 650 C800 640 1400 640 1840 652 L1920 664", "#a5bac5"),
  D = hill("M0 856 C500 846 1400 846 1920 858", snow.sky[1]),
}

--- A fir under snow, its foot at x, y.
local function fir(x, y, high, tier)
  local art = houses.tiers[tier]
  local parts = {}
  for i = 0, 2 do
    local top, wide = y - high * (1 - 0.26 * i), high * (0.15 + 0.09 * i)
    local foot = top + 0.44 * high
    parts[#parts + 1] = polygon { { x, top }, { x + wide, foot }, { x - wide, foot },
      fill = art.wall }
    parts[#parts + 1] = polygon { { x, top }, { x + 0.1 * wide, top + 0.2 * high },
      { x - 0.35 * wide, top + 0.3 * high }, { x - 0.9 * wide, foot - 0.03 * high },
      fill = art.snow }
  end
  return union(parts)
end

local function firs(tier, list)
  local parts = {}
  for _, tree in ipairs(list) do parts[#parts + 1] = fir(tree[1], tree[2], tree[3], tier) end
  return union(parts)
end

--- Snow that has drifted against the foot of a row of houses, up to x.
local function drift(to, y)
  local points = {}
  for i = 0, 16 do
    points[i + 1] = { 400 + (to - 400) * i / 16, y + 4 * math.sin(2.3 * i),
      10 + 4 * math.sin(1.7 * i) }
  end
  return stroke { points = points, degree = 2, cap = "round", fill = "#9db0ba" }
end

--- The tram that waits in the lane, behind its three windows.
local tram = path { fill = "#2a3b40", d = "M904 772 Q904 764 914 764 H996 Q1006 764 1006 772 V846"
    .. " H904 Z" }
  | path { fill = "#6f3a30", d = "M904 824 H1006 V846 H904 Z" }
  | rect { 904, 822, 102, 4, fill = "#c9a36a" } | rect { 900, 758, 110, 8, radius = 4,
    fill = snow.sky[2] }
  | circle { 955, 835, 5, fill = "#ffe9b0" }
  | rect { 934, 770, 42, 12, radius = 3, fill = "#ffe2a0" }
  | stroke { width = 2, fill = storm.ink, d = "M930 758 L955 736 L980 758 M880 734 H1030" }
  | rect { 916, 846, 22, 8, radius = 3, fill = storm.ink }
  | rect { 972, 846, 22, 8, radius = 3, fill = storm.ink }
  | stroke { width = 2.4, fill = "#8ba4b2", d = "M926 856 L916 884 M984 856 L994 884" }

local street = path { fill = snow.sky[2], d = "M0 884 C500 872 1400 872 1920 884 V1080 H0 Z" }
  | path { fill = snow.sky[3], d = "M0 962 C260 940 520 966 760 958 S1260 946 1480 960 1800 950 "
    .. "1920 956 V1080 H0 Z" }
  | path { fill = "#c9d9e4", d = "M0 1040 C340 1010 700 1044 1060 1026 S1640 1012 1920 1036 V1080 "
    .. "H0 Z" }

--- Prints of feet along the street, before and behind the lamps.
local function prints()
  local list = {}
  for i = 0, 34 do
    local x, side = 392 + 37.5 * i, i % 2
    list[#list + 1] = ellipse { x, 941 + 5 * side, 4.2, 1.6, fill = "#a9c0d0" }
  end
  return union(list)
end

local kennel = ellipse { 426, 979, 56, 7, fill = "#c9d9e4" }
  | polygon { { 388, 980 }, { 388, 926 }, { 422, 902 }, { 456, 926 }, { 456, 980 },
    fill = "#3a4a50" }
  | stroke { width = 11, cap = "round", join = "round", fill = "#9fb4c2",
    points = { { 382, 930 }, { 422, 902 }, { 462, 930 } } }
  | stroke { width = 9, cap = "round", join = "round", fill = snow.sky[3],
    points = { { 382, 928 }, { 422, 900 }, { 462, 928 } } }
local bird_house = rect { 1123, 914, 6, 66, fill = "#37464a" }
  | polygon { { 1114, 922 }, { 1114, 898 }, { 1126, 888 }, { 1138, 898 }, { 1138, 922 },
    fill = "#3f5158" }
  | stroke { width = 6, cap = "round", join = "round", fill = "#9fb4c2",
    points = { { 1111, 900 }, { 1126, 887 }, { 1141, 900 } } }
  | stroke { width = 4, cap = "round", join = "round", fill = snow.sky[3],
    points = { { 1111, 899 }, { 1126, 886 }, { 1141, 899 } } }

local awning = path { fill = snow.accent, d = "M592 774 H708 L718 790 a9.6 7 0 0 1 -19.1 0 "
  .. "a9.6 7 0 0 1 -19.2 0 a9.6 7 0 0 1 -19.1 0 a9.6 7 0 0 1 -19.2 0 a9.6 7 0 0 1 -19.1 0 "
  .. "a9.6 7 0 0 1 -19.2 0 a9.6 7 0 0 1 -19.1 0 Z" }

--- Signs that hang from an arm of iron: a pretzel, a mug, and a reel of film.
local signs = stroke { width = 2, fill = "#0b1012",
    d = "M1194 744 h18 M752 744 h-14 M1516 744 h20" }
  | stroke { width = 3, fill = "#d9a441", cap = "round", d = "M741 767 C729 771 727 752 736 752 "
    .. "C745 752 744 763 736 769 M741 767 C753 771 755 752 746 752 C737 752 738 763 746 769" }
  | path { fill = "#d9a441", d = "M1202 752 h13 v18 h-13 Z" }
  | stroke { width = 2.4, fill = "#d9a441", d = "M1215 756 q7 4 0 10" }
  | rect { 1200, 749, 17, 5, radius = 2.5, fill = "#f3f3ef" }
  | (circle { 1531, 760, 10, fill = "#d9a441" } - circle { 1531, 755, 2.6 }
    - circle { 1526, 763, 2.6 } - circle { 1536, 763, 2.6 })

--- The lane from the street to the church, trodden into the snow.
local lane = stroke { fill = "#d3e0e9", cap = "round", degree = 2, points = { { 955, 900, 104 },
  { 952, 800, 96 }, { 968, 700, 84 }, { 1036, 640, 58 }, { 1060, 560, 44 }, { 1040, 510, 34 },
  { 1120, 470, 26 }, { 1164, 430, 20 }, { 1200, 424, 12 } } }

--- Light that falls from a window on the snow before it.
local function spill(x, w, y, high)
  return polygon { { x, y }, { x + w, y }, { x + 1.35 * w, y + high }, { x - 0.35 * w, y + high },
    fill = linear { from = { 0, y }, to = { 0, y + high }, { 0, rgb("#ffd27a", 0.5) },
      { 1, rgb("#ffd27a", 0) } } }
end
local spills = spill(602, 96, 862, 46) | spill(1048, 72, 860, 40) | spill(1387, 96, 860, 46)

--- A door with its knob.
local function door(x, y, w, h)
  return path { fill = "#2f2420", d = ("M%g %g v%g a%g %g 0 0 1 %g 0 v%g Z"):format(x, y,
      -h + w / 2, w / 2, w / 2, w, h - w / 2) }
    | circle { x + 0.78 * w, y - 0.42 * h, 0.07 * w, fill = "#caa05a" }
end
local doors = union {}
for _, place in ipairs { { 462, 862, 24, 42 }, { 716, 860, 20, 42 }, { 854, 858, 20, 40 },
  { 1140, 858, 24, 44 }, { 1262, 858, 24, 40 }, { 1358, 858, 22, 44 }, { 1580, 862, 22, 40 } } do
  doors = doors | door(place[1], place[2], place[3], place[4])
end

--- A snowman and a fence, in the snow in front.
local snowman = ellipse { 804, 1030, 36, 5, fill = "#a9c0d0" }
  | circle { 800, 1004, 27, fill = "#b7cad8" }
  | circle { 797, 1002, 26, fill = snow.sky[3] }
  | circle { 800, 962, 19, fill = "#b7cad8" } | circle { 798, 960, 18, fill = snow.sky[3] }
  | polygon { { 812, 962 }, { 834, 968 }, { 811, 970 }, fill = "#d98a3a" }
  | circle { 806, 955, 2.6, fill = storm.ink } | circle { 793, 956, 2.6, fill = storm.ink }
  | path { fill = storm.ink, d = "M776 950 Q798 940 822 946 L812 943 L808 922 L784 926 L786 946 Z" }
  | stroke { width = 3, fill = storm.ink, points = { { 776, 990 }, { 752, 966 }, { 744, 968 } } }
  | stroke { width = 3, fill = storm.ink, points = { { 752, 966 }, { 750, 956 } } }
  | stroke { width = 3, fill = storm.ink, points = { { 824, 992 }, { 850, 974 }, { 858, 978 } } }
  | circle { 800, 986, 2, fill = storm.ink } | circle { 801, 996, 2, fill = storm.ink }

local function fence(from, to, y)
  local parts = {}
  for x = from, to, 34 do
    local top = y + 3 * math.sin(x / 40)
    parts[#parts + 1] = rect { x, top, 8, 60, fill = storm.near }
    parts[#parts + 1] = rect { x - 2, top - 4, 12, 7, radius = 3.5, fill = snow.sky[3] }
  end
  return stroke { width = 5, fill = storm.near, points = { { from, y + 22 }, { to + 10, y + 24 } } }
    | union(parts)
end
local front = fence(1230, 1660, 1006) | snowman:translate(20, 36)

-- ---------------------------------------------------------------- what moves

--- Smoke of eight drawings: soft shapes that rise, grow and thin.
local function smoke(place, number)
  local x, y, wide = place[1], place[2], place[3]
  local parts = {}
  for i = 0, 7 do
    local u = (i + number / 8) / 8
    parts[#parts + 1] = circle { x + wide * (0.5 * math.sin(4 * u) + 3.4 * u * u), y - 9 * wide * u,
      wide * (0.45 + 1.2 * u), fill = rgb("#c6d2d3", 0.3 * (1 - u) ^ 1.3) }
  end
  return union(parts)
end

local function star(number)
  local reach = ({ 12, 14, 11, 15, 13, 10 })[number // 4 % 6 + 1]
  return polygon { { 1276, 92 - reach }, { 1278.4, 89.6 }, { 1276 + 0.7 * reach, 92 },
    { 1278.4, 94.4 }, { 1276, 92 + reach }, { 1273.6, 94.4 }, { 1276 - 0.7 * reach, 92 },
    { 1273.6, 89.6 }, fill = snow.light }
end

local far = union {
  sky, slopes.A, lane, firs("A", { { 760, 452, 46 }, { 800, 442, 58 }, { 838, 436, 42 },
    { 1530, 432, 52 }, { 1572, 440, 40 }, { 1068, 420, 34 }, { 1640, 456, 46 } }),
  houses.of "A", houses.church(),
  slopes.B, clip(lane, slopes.B), firs("B", { { 420, 556, 60 }, { 462, 546, 78 }, { 504, 538, 56 },
    { 1690, 534, 74 }, { 1736, 546, 56 }, { 1780, 556, 66 } }),
  houses.of "B", drift(1630, 523),
  slopes.C, clip(lane, slopes.C), firs("C", { { 990, 652, 58 }, { 1878, 664, 90 },
    { 1690, 660, 60 } }),
  houses.of "C", drift(1850, 656),
  slopes.D, clip(lane, slopes.D), houses.of "D", doors, signs, tram, awning,
  street, spills, prints(), kennel, bird_house, front, lamplighter.dark(),
}

--- Shutters beside the window at x, y, open, with snow on their edges.
local function shutters(x, y)
  local parts = {}
  for _, left in ipairs { x - 34, x + 90 } do
    parts[#parts + 1] = rect { left, y, 28, 112, fill = "#223138" }
    for i = 0, 5 do
      parts[#parts + 1] = rect { left + 4, y + 8 + 17 * i, 20, 9, fill = "#182327" }
    end
    parts[#parts + 1] = rect { left - 1, y - 4, 30, 5, radius = 2.5, fill = "#93abbb" }
  end
  return union(parts)
end

local near = houses.of "E" | shutters(66, 668) | shutters(230, 668) | shutters(66, 850)
  | shutters(230, 850)
  | path { fill = "#5f7686", d = "M-10 1080 V1046 C60 1030 160 1052 250 1040 S360 1046 420 1080 Z" }
  | path { fill = "#5f7686", d = "M1600 1080 C1660 1050 1740 1040 1800 1046 S1890 1036 1930 1050"
    .. " V1080 Z" }
local chimneys = houses.chimneys()

--- The smoke of five chimneys, and the star: a loop of 24 drawings.
local function air(number)
  local shown = { star(number) }
  for i, place in ipairs(chimneys) do shown[#shown + 1] = smoke(place, (number + 3 * i) % 8) end
  return union(shown)
end

local BETWEEN = rect { 384, 0, 1280, H } - kennel - bird_house -- the street, between houses

-- The parts of the town are planes of their own in its page, so that what is still is loaded once.
return {
  still = function() return { far, panes.lit "ABCDSK", near, panes.lit "E" } end,
  lights = function(f)
    return { panes.dark(f.time), clip(lamplighter.lights(f.index, f.count), BETWEEN) }
  end,
  street = function(f)
    return { clip(lamplighter.at(f.index, f.count), BETWEEN) }
  end,
  air = function(f) return { air(f.index) } end,
  snow = function(f) return { snowfall.at(f.index / f.count) } end,
  all = function(f)
    return { far, air(f.index), panes.lit "ABCDSK", panes.dark(f.time),
      lamplighter.lights(f.index, f.count), clip(lamplighter.at(f.index, f.count), BETWEEN), near,
      panes.lit "E", snowfall.at(f.index % 24 / 24) }
  end,
}
