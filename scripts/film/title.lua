-- The title, written in light: strokes that a spark draws, one after another.
local timing = require "film.timing"

local title = {}

local X, Y, SCALE = 395, 306, 1.52

--- Letters as in joined handwriting; x to the right, y up from the baseline.
local LITTLE = { { 66, 120 }, { 80, 138 }, { 76, 156 }, { 58, 160 }, { 45, 142 }, { 42, 108 },
  { 40, 62 }, { 32, 22 },
  { 14, 4 }, { 0, 12 }, { 10, 24 }, { 40, 12 }, { 70, 0 }, { 96, 10 }, { 112, 34 }, { 124, 60 },
    { 122, 34 }, { 124, 8 },
  { 138, 2 }, { 154, 18 }, { 170, 56 }, { 190, 118 }, { 184, 70 }, { 182, 22 }, { 192, 2 },
    { 208, 12 }, { 224, 46 }, { 248, 118 },
  { 242, 70 }, { 240, 22 }, { 250, 2 }, { 266, 12 }, { 284, 46 }, { 308, 112 }, { 318, 148 },
    { 308, 162 }, { 298, 144 },
  { 297, 80 }, { 300, 22 }, { 312, 2 }, { 328, 10 }, { 344, 26 }, { 366, 42 }, { 376, 58 },
    { 364, 66 }, { 350, 50 }, { 350, 22 },
  { 364, 2 }, { 386, 6 }, { 412, 30 } }
local ONE = { { 552, 148 }, { 520, 150 }, { 486, 112 }, { 478, 54 }, { 500, 8 }, { 540, 2 },
  { 576, 42 }, { 584, 100 }, { 562, 142 },
  { 536, 136 }, { 540, 116 }, { 572, 116 }, { 606, 132 } }
local REST = { { 606, 34 }, { 622, 60 }, { 626, 34 }, { 624, 2 }, { 630, 34 }, { 648, 60 },
  { 664, 50 }, { 664, 18 }, { 676, 2 },
  { 694, 18 }, { 714, 42 }, { 724, 58 }, { 712, 66 }, { 698, 50 }, { 698, 22 }, { 712, 2 },
    { 738, 6 }, { 782, 36 } }
local CROSS = { { 162, 92 }, { 220, 98 }, { 276, 104 } }
local DOT = { { 126, 88 }, { 129, 92 } }

local function path_of(points)
  local d = { ("M%g %g"):format(points[1][1], -points[1][2]) }
  for i = 1, #points - 1 do
    local before, a = points[i - 1] or points[i], points[i]
    local b, after = points[i + 1], points[i + 2] or points[i + 1]
    d[#d + 1] = ("C%g %g %g %g %g %g"):format(a[1] + (b[1] - before[1]) / 6,
      -a[2] - (before[2] - b[2]) / -6,
      b[1] - (after[1] - a[1]) / 6, -b[2] + (after[2] - a[2]) / 6, b[1], -b[2])
  end
  return table.concat(d)
end

--- Strokes in the order in which they are written: the start and the duration of each.
local strokes = { { LITTLE, 0, 1.5 }, { CROSS, 1.58, 0.2 }, { DOT, 1.86, 0.06 },
  { ONE, 2.06, 0.42 }, { REST, 2.5, 0.5 } }
for i, s in ipairs(strokes) do
  local d = path_of(s[1])
  strokes[i] = { d = d, way = motion.along(d), from = s[2], length = s[3] }
end
local LENGTH = 3.0

local hand = ease "inOutSine"

--- The parts of each stroke that are written and erased at a time of the film.
local function state_of(s, time)
  local pace = (timing.title.written - timing.title.from) / LENGTH
  local age = (time - timing.title.from) / pace
  local gone = (time - timing.title.leaves) / 1.1 * LENGTH
  return hand(motion.span(age, s.from, s.length)),
    motion.span(gone, s.from, s.length), age
end

-- Lines over one another, {width, opacity of the paint}: together they fall off like a glow.
local halos = { { 58, 0.0022 }, { 46, 0.003 }, { 36, 0.004 }, { 28, 0.005 }, { 21, 0.0065 },
  { 15, 0.009 } }

--- The writing, as two cels: its glow and itself.
function title.draw(time)
  local lines, glow = {}, {}
  for _, s in ipairs(strokes) do
    local to, from = state_of(s, time)
    if to > from then
      local function line(width, texture)
        return stroke { d = s.d, width = width, cap = "round", join = "round", from = from,
          to = to,
          taper = { 5, 14 }, fill = texture }
      end
      for _, halo in ipairs(halos) do
        glow[#glow + 1] = line(halo[1], rgb(1, 0.44, 0.13, halo[2]))
      end
      lines[#lines + 1] = line(8.5, "#ffc566")
      lines[#lines + 1] = line(4.2, "#fff3d2")
    end
  end
  local function place(list) return union(list):scale(SCALE):translate(X, Y) end
  return cel { place(glow), front = { 9, 9, 9 } }:named "title glow",
    cel { place(lines), front = { 1.25, 1.15, 1 } }:named "title"
end

--- The position of the spark that writes it: on a stroke, or between two.
function title.hand(time)
  local last
  for i, s in ipairs(strokes) do
    local u, _, age = state_of(s, time)
    if u > 0 or i == 1 then
      local x, y = s.way:at(u)
      last = { x, y }
      local following = strokes[i + 1]
      if following and u == 1 then
        local stops = s.from + s.length
        local k = hand(math.max(0, math.min(1, (age - stops) / (following.from - stops))))
        local nx, ny = following.way:at(0)
        last = { x + (nx - x) * k, y + (ny - y) * k - 34 * math.sin(math.pi * k) }
      end
    end
  end
  return { X + SCALE * last[1], Y + SCALE * last[2] }
end

return title
