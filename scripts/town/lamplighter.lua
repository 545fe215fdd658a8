-- The lamplighter in the street of the town, and his six lamps: he crosses it once in the loop, and
-- each lamp burns from his coming until shortly before he comes again.
local moods = require "stage.moods"

local snow, candle = moods.snow, moods.candle

local lamplighter = {}

local FROM, TO, FOOT = 350, 1700, 940 -- he begins and ends behind the houses in front
local LAMPS = { 554, 745, 890, 1236, 1521, 1626 }
local REACH = 26 -- from him to the end of his pole
local EARLY = 1.5 / 12 * (TO - FROM) -- a lamp goes out so long before he is there
local IRON = "#1d2629"

--- A lamp with its foot at x, dark or lit.
local function lamp(x, is_lit)
  local glass = polygon { { x - 6, 846 }, { x + 6, 846 }, { x + 4.4, 862 }, { x - 4.4, 862 },
    fill = is_lit and radial { centre = { x, 856 }, radius = 12, { 0, "#fff6dc" },
      { 1, candle.light } } or "#4a5d63" }
  local post = stroke { fill = IRON, points = { { x, 928, 5 }, { x, 900, 3 }, { x, 862, 2.4 } } }
  local iron = rect { x - 6, 924, 12, 4, radius = 1, fill = IRON }
    | polygon { { x - 8, 846 }, { x, 837 }, { x + 8, 846 }, fill = IRON }
    | path { fill = snow.sky[3], d = ("M%g 843 Q%g 831 %g 843 Z"):format(x - 8.5, x, x + 8.5) }
  return post | glass | iron
end

--- The light of a lamp: a glow in the air and a pool on the snow.
local function light(x)
  local warm = candle.light
  return circle { x, 932, 104, fill = radial { centre = { x, 932 }, radius = 104,
      { 0, rgb("#ffe2a0", 0.75) }, { 0.45, rgb("#ffe2a0", 0.34) }, { 1, rgb("#ffe2a0", 0) } } }
      :scale(1, 0.22, x, 932)
    | circle { x, 854, 62, fill = radial { centre = { x, 854 }, radius = 62,
      { 0, rgb(warm, 0.55) }, { 0.3, rgb(warm, 0.2) }, { 1, rgb(warm, 0) } } }
end

-- Of his eight drawings: the feet, forward of his middle and above the snow, and his height.
local steps = {
  { 18.8, 0, -18.8, 1, 0 }, { 9.4, 0, -14, 5, 1.4 }, { 0, 0, -3, 7, 2.4 }, { -9.4, 0, 9, 6, 1.2 },
  { -18.8, 1, 18.8, 0, 0 }, { -14, 5, 9.4, 0, 1.4 }, { -3, 7, 0, 0, 2.4 }, { 9, 6, -9.4, 0, 1.2 },
}

local function leg(hip, foot, lift, colour)
  local knee = (hip + foot) / 2 + 3 + 0.5 * lift
  return stroke { fill = colour, cap = "round", degree = 2, points = { { hip, -24, 8 },
      { knee, -14, 7 }, { foot, -4 - lift, 6 } } }
    | path { fill = IRON, d = ("M%g %g h7 q6 0 6 5 h-13 Z"):format(foot - 3, -5 - lift) }
end

--- He, with his feet at 0, 0, on drawing n; raised: how far he lifts the pole, 0 to 1.
local function figure(n, raised)
  local step = steps[n]
  local up = step[5]
  local swing = 3 * math.sin(n / 8 * 2 * math.pi)
  local coat = path { fill = "#2f5560", d = ("M-13 -20 C-15 -40 -12 -54 -5 -58 H6 C13 -54 15 -40 "
    .. "17 -20 Q%g -16 %g -19 T-13 -20 Z"):format(10 + swing, 2 + swing) }
  local rim = path { fill = "#4d7d86",
    d = "M6 -58 C13 -54 15 -40 17 -20 L12 -19 C11 -38 9 -52 3 -58 Z" }
  local head = circle { 3, -64, 7.5, fill = "#e2b08a" }
    | ellipse { 10, -63, 2.6, 2, fill = "#d48f70" }
    | path { fill = "#e9edf0", d = "M-3 -62 C-2 -52 6 -50 10 -57 C6 -58 2 -60 -3 -62 Z" }
  local hat = path { fill = "#1e3238", d = "M-9 -67 Q3 -73 14 -67 L9 -70 C9 -84 -4 -85 -5 -70 Z" }
  local scarf = stroke { fill = snow.accent, width = 6, cap = "round",
      points = { { -5, -57 }, { 9, -56 } } }
    | stroke { fill = snow.accent, cap = "round", degree = 2, points = { { -4, -56, 5 },
      { -14, -50 + 0.5 * swing, 6 }, { -24, -51 - swing, 6.5 } } }
  local hand = { 15 + 3 * raised, -42 - 18 * raised }
  local tip = { 24 + 6 * raised, -84 - 8 * raised }
  local foot = { hand[1] - 0.5 * (tip[1] - hand[1]), hand[2] - 0.6 * (tip[2] - hand[2]) }
  local pole = stroke { width = 2, fill = "#7a5a3c", points = { foot, tip } }
    | circle { tip[1], tip[2], 2.6, fill = candle.light }
  local arm = stroke { fill = "#27474f", cap = "round", degree = 2, points = { { 2, -52, 8 },
      { 9, -42 - 8 * raised, 7 }, { hand[1], hand[2], 6 } } }
    | circle { hand[1], hand[2], 4, fill = "#3f8f94" }
  local body = coat | rim | scarf | head | hat
  return ellipse { 2, 0, 20, 3, fill = rgb("#7e9bb0", 0.6) } | leg(-4, step[3], step[4], "#1d2f35")
    | leg(4, step[1], step[2], "#27404a") | (pole | body | arm):translate(0, -up)
end

--- All lamps, dark, and the stone at the foot of one.
function lamplighter.dark()
  local parts = { path { fill = "#9fb4c2", d = "M1228 932 C1236 906 1262 904 1270 932 Z" },
    path { fill = snow.sky[3],
      d = "M1234 922 C1240 904 1258 904 1264 922 C1252 914 1246 914 1234 922 Z" } }
  for _, place in ipairs(LAMPS) do parts[#parts + 1] = lamp(place, false) end
  return union(parts)
end

--- Where he is at drawing `index` of `count`.
local function place_of(index, count) return FROM + (TO - FROM) * index / count end

--- The lamps that burn at drawing `index` of `count`.
function lamplighter.lights(index, count)
  local x, parts = place_of(index, count), {}
  for _, place in ipairs(LAMPS) do
    if (place - REACH - x) % (TO - FROM) > EARLY then
      parts[#parts + 1], parts[#parts + 2] = light(place), lamp(place, true)
    end
  end
  return union(parts)
end

--- He himself, at drawing `index` of `count`; he lifts his pole where a lamp is.
function lamplighter.at(index, count)
  local x, raised = place_of(index, count), 0
  for _, place in ipairs(LAMPS) do
    raised = math.max(raised, 1 - math.abs(place - REACH - x) / 44)
  end
  return figure(index % 8 + 1, raised):translate(x, FOOT)
end

return lamplighter
