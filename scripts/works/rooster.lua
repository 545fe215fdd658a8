-- Cut-paper morning: a rooster of scraps calls for the sun until he falls to pieces, and the sun
-- keeps his face. All papers are drawn here, with scissors of numbers; poses are held for threes.
local papers = require "stage.papers"
local score = require "sound.score"

local fibres, printed, torn = papers.fibres, papers.printed, papers.torn

local set = parameters { grain = { 0.02, min = 0, max = 0.3 } }

local FONT = "../type/block.ttf"
local SMOOTH, FAST, OVER = "inOutSine", "outCubic", "outBack"

-- ---------------------------------------------------------------- papers

local function words(list, size, colour)
  local lines = {}
  for i, line in ipairs(list) do
    lines[i] = text { line, 3, (i - 0.15) * 1.3 * size, font = FONT, size = size, fill = colour }
  end
  return union(lines)
end

local NEWS = printed("#ece4d0", 168, 78, words({ "weather for today: a",
  "little night, then the", "sun, if somebody calls", "her. In the yard, fresh",
  "grain." }, 12, "#3a3630"), -8)
local STRIPES = printed("#f3e9d2", 22, 22, rect { 0, 0, 11, 22, fill = "#1f6f78" }, 24)
local DOTS = printed("#e9b23c", 26, 26, circle { 7, 7, 5, fill = "#fff6dc" }
  | circle { 20, 20, 5, fill = "#fff6dc" }, 10)
local GRAPH = printed("#eef3ee", 18, 18, rect { 0, 0, 18, 1.6, fill = "#7fb0b8" }
  | rect { 0, 0, 1.6, 18, fill = "#7fb0b8" }, 14)
local MUSIC = printed("#f4ead0", 120, 64, union { rect { 0, 6, 120, 1.5 }, rect { 0, 14, 120, 1.5 },
  rect { 0, 22, 120, 1.5 }, rect { 0, 30, 120, 1.5 }, rect { 0, 38, 120, 1.5 },
  ellipse { 26, 34, 6, 4.4 }:rotate(-20, 26, 34), rect { 30, 10, 2, 24 },
  ellipse { 66, 18, 6, 4.4 }:rotate(-20, 66, 18), rect { 70, -4, 2, 22 },
  ellipse { 98, 26, 6, 4.4 }:rotate(-20, 98, 26), rect { 102, 2, 2, 24 } }:paint("#2b2622"), -30)
local RED, ORANGE = fibres("#b3202c", "#e8503f"), fibres("#d9622b", "#f6a04d")
local YELLOW, NAVY = fibres("#e5a11e", "#fbd768"), fibres("#16243f", "#2c4470")
local KRAFT = fibres("#a67c4e", "#cba678", 30)
local MARBLE = noise { kind = "turbulence", size = 90, octaves = 4,
  colours = { "#f7e2c0", "#e2703a", "#7a2320" } }
local WHITE, BLACK = fibres("#efe6d2", "#fffaf0"), fibres("#15110f", "#38302b")

-- ---------------------------------------------------------------- the rooster, about his breast

local function d(data) return path { d = data } end
local SICKLE = "M0 0 C-30 -110 -110 -170 -214 -130 C-250 -116 -262 -84 -254 -60 C-214 -104 -120 "
  .. "-90 -44 46 Z"

--- Pieces in the order in which they are laid: shape, paper, the part that moves it, and where it
--- comes to lie on the sun: { right, down, degrees }; or where it grows on the meadow, as a plant.
local PIECES = {
  { d(SICKLE):rotate(34):translate(-112, -18), ORANGE, "tail",
    plant = { -384, 26 } },
  { d(SICKLE):scale(0.96):rotate(12):translate(-116, -6), MUSIC, "tail",
    plant = { -304, 78 } },
  { d(SICKLE):scale(0.86):rotate(-12):translate(-118, 8), RED, "tail",
    plant = { 498, 68 } },
  { d(SICKLE):scale(0.7):rotate(-38):translate(-112, 26), DOTS, "tail",
    plant = { 560, 128 } },
  { d "M-26 78 L-34 168 L-70 184 L-66 194 L-30 184 L-2 196 L2 186 L-16 170 L-2 80 Z", YELLOW },
  { d "M44 78 L44 168 L10 184 L14 194 L48 184 L78 194 L80 184 L62 168 L68 76 Z", YELLOW },
  { d("M-176 -52 C-150 50 -70 116 24 108 C122 98 168 14 152 -62 C142 -112 118 -150 112 -196 L34 "
    .. "-186 C30 -112 -60 -66 -176 -52 Z"), NEWS, "body" },
  { d("M-112 -30 C-60 -78 36 -64 72 -8 C64 8 40 8 34 4 C36 26 14 34 -4 24 C-8 44 -36 44 -46 28 C"
    .. "-76 24 -100 2 -112 -30 Z"), STRIPES, "wing" },
  { d("M30 -204 C8 -140 22 -84 44 -48 L64 -84 L84 -34 L104 -82 L126 -40 L142 -90 C140 -140 130 "
    .. "-176 116 -210 Z"), MARBLE, "neck" },
  { d("M40 -256 C28 -284 40 -306 54 -292 C58 -322 84 -322 84 -294 C98 -316 122 -304 112 -280 C126 "
    .. "-284 130 -266 116 -252 Z"), RED, "head", { 26, -186, 4 } },
  { circle { 76, -218, 48 }, KRAFT, "head" },
  { d "M116 -206 L170 -196 L120 -188 Z", fibres("#8a3f1a", "#b8632c"), "jaw", { 186, 44, 6 } },
  { d "M112 -238 L184 -212 L114 -202 Z", ORANGE, "head", { 196, 0, 0 } },
  { d "M104 -194 C86 -160 98 -134 114 -138 C130 -142 130 -170 118 -194 Z", RED, "head",
    { 122, 104, 0 } },
  { circle { 88, -230, 14 }, WHITE, "head", { 76, -50, 0 } },
  { circle { 91, -229, 6.5 }, BLACK, "head", { 80, -47, 0 } },
}
local chance = random "scraps"
for i, piece in ipairs(PIECES) do
  local x, y, w, h = piece[1]:bounds()
  piece.middle = { x + w / 2, y + h / 2 }
  piece.drawn = torn(piece[1], piece[2], i)
  piece.from = { -400 + 900 * chance(i), 150 + 60 * chance(-i), 360 * chance(i + 0.5) - 180 }
  piece.start = 0.35 + 0.11 * i + 0.1 * chance(i + 0.25)
  piece.burst = { 200 - 900 * chance(i + 0.1),
    -600 - 500 * chance(i + 0.2), 500 * chance(i + 0.3) - 250 }
end

-- ---------------------------------------------------------------- the acting, in seconds

local BURST = 6.55

--- Degrees of body, neck and head, wing and jaw; and his height.
local pose = keys { { 2.5, { 0, 0, 0, 0, 1 } }, { 2.75, { 6, 14, 0, 0, 0.92 }, SMOOTH },
  { 3.0, { 6, 16, -10, 0, 0.9 } }, { 3.12, { -8, -26, -34, 26, 1.1 }, FAST },
  { 3.6, { -6, -22, -28, 22, 1.07 } }, { 3.85, { 0, 0, 0, 0, 1 }, SMOOTH },
  { 4.3, { 0, 8, 0, 0, 1 }, SMOOTH }, { 4.75, { 0, -8, 0, 0, 1 }, SMOOTH },
  { 5.0, { 0, -8, 0, 0, 1 } }, { 5.5, { 14, 30, 22, 0, 0.78 }, SMOOTH },
  { 5.75, { 15, 32, 26, 0, 0.76 } }, { 5.85, { -14, -36, -70, 36, 1.12 }, FAST },
  { 6.5, { -17, -42, -86, 42, 1.16 } } }

--- How high the sun is, and the orange sheet of the morning before it.
local rise = keys { { 6.0, 0 }, { 6.2, 0.06 }, { 6.5, 0.02 }, { 7.0, 1.08, FAST },
  { 7.2, 1, SMOOTH } }

--- Where the sun looks, right and down: after the letters; and how far open the eye is.
local glance = keys { { 8.2, { 0, 0 } }, { 8.3, { 11, 13 } }, { 8.8, { 12, 13 } },
  { 8.95, { 0, 0 } }, { 9.6, { 0, 0 } }, { 9.7, { 8, -4 } } }
local open = keys { { 9.2, 1 }, { 9.25, 0.25 }, { 9.4, 0.25 }, { 9.5, 1.12 }, { 9.7, 1 } }

local NECK, TAIL, WING, JAW = { 74, -120 }, { -112, 0 }, { 50, -30 }, { 112, -204 }

--- A piece on the living bird.
local function alive(piece, art, t)
  local body, neck, wing, jaw, high = table.unpack(pose:at(t))
  local part = piece[3]
  if part == "jaw" then art = art:rotate(jaw, JAW) end
  if part == "head" or part == "jaw" then art = art:rotate(0.5 * neck, 76, -190) end
  if part == "head" or part == "jaw" or part == "neck" then art = art:rotate(0.6 * neck, NECK) end
  if part == "tail" then art = art:rotate(-0.7 * body - 8 * (high - 1), TAIL) end
  if part == "wing" then art = art:rotate(wing, WING) end
  if part then art = art:rotate(body, 20, 90):scale(high ^ -0.4, high, 20, 190) end
  return art
end

for _, piece in ipairs(PIECES) do -- how far they are from home as they burst
  local x, y, w, h = alive(piece, piece[1], BURST):bounds()
  piece.last = { x + w / 2 - piece.middle[1], y + h / 2 - piece.middle[2] }
end

--- Turned about the middle of its piece, and moved.
local function laid(piece, art, right, down, degrees)
  return art:rotate(degrees, piece.middle):translate(right, down)
end

--- A piece at a time: on its way to the bird, on it, and after it.
local function scrap(piece, i, t)
  local jitter = 0.7 * (2 * chance(i + 100 * t) - 1)
  if t < piece.start + 0.5 then
    local u = motion.span(t, piece.start, 0.45, OVER)
    local x, y, degrees = table.unpack(piece.from)
    return laid(piece, piece.drawn, (1 - u) * (x - piece.middle[1]), (1 - u) * (y - piece.middle[2])
      - 190 * math.sin(math.pi * math.min(1, u)), (1 - u) * degrees + jitter)
  end
  local age = t - BURST
  if age <= 0 then return alive(piece, piece.drawn, t):rotate(jitter, piece.middle) end
  local art, goal, last = piece.drawn, piece[4], piece.last
  if goal then
    local u = motion.span(age, 0.5 + 0.05 * i, 0.5, OVER)
    local up = math.min(age, 0.5 + 0.05 * i)
    local look_x, look_y = 0, 0
    if i >= 15 then -- the white of the eye, and its pupil, which goes further
      local x, y = table.unpack(glance:at(t))
      look_x, look_y = x * (i - 14.5) * 1.2, y * (i - 14.5)
      local lid = open:at(t) -- shut, the pupil is a line
      art = art:scale(i == 16 and math.max(1, 2.6 - 1.6 * lid) or 1, lid, piece.middle)
    end
    return laid(piece, art:scale(1 + 0.6 * u, piece.middle),
      (1 - u) * (60 * up + last[1]) + u * (goal[1] + 120 - piece.middle[1]) + look_x,
      (1 - u) * (last[2] - 760 * up + 620 * up * up) + u * (goal[2] - 150 - piece.middle[2])
        + look_y,
      (1 - u) * 300 * up + u * goal[3] + jitter)
  end
  local x, y, spin = table.unpack(piece.burst)
  if not piece.plant then
    return laid(piece, art, last[1] + x * age, last[2] + y * age + 1500 * age * age, spin * age)
  end
  local right, degrees = table.unpack(piece.plant)
  local u = motion.span(age, 0, 0.9, "inOutSine")
  return laid(piece, art, (1 - u) * last[1] + u * (right - piece.middle[1]),
    (1 - u) * last[2] + u * (186 - piece.middle[2]) - 330 * math.sin(math.pi * u),
    u * (degrees + 4 * math.sin(2.4 * t + i)) + jitter)
end

-- ---------------------------------------------------------------- letters that were cut out

local function letters(text_, from, x, y, step)
  local list, tiles = {}, { { YELLOW, "#3a1710" }, { WHITE, "#c0392b" }, { RED, "#fff6dc" },
    { NAVY, "#fbd768" } }
  for i = 1, #text_ do
    local letter = text_:sub(i, i)
    if letter ~= " " then
      local paper = tiles[1 + (i * 3 + #text_) % 4]
      local tile = torn(polygon { { -36, -40 }, { 34, -44 }, { 38, 38 }, { -32, 44 } }, paper[1], i)
      local glyph = text { letter, 0, 26, font = FONT, size = 72, align = "centre",
        variations = { wght = 900 }, fill = paper[2] }
      list[#list + 1] = { tile | glyph, x = x + step * i,
        y = y - 9 * i + 44 * (chance(i + x) - 0.5),
        degrees = 26 * (chance(i + y) - 0.5), from = from + 0.075 * i }
    end
  end
  return list
end
local FIRST = letters("COCK-A", 3.1, 690, 190, 82)
local SECOND = letters("DOODLE", 5.84, 700, 150, 84)
local THIRD = letters("DOO!", 6.0, 760, 270, 92)

local function called(list, t, until_)
  local seen = {}
  for i, one in ipairs(list) do
    local u = motion.span(t, one.from, 0.2, OVER)
    local fall = math.max(0, t - until_ - 0.05 * i)
    if u > 0 and fall < 1 then
      seen[#seen + 1] = one[1]:scale(u):rotate(one.degrees + 200 * fall)
        :translate(one.x, one.y + 1400 * fall * fall)
    end
  end
  return union(seen)
end

-- ---------------------------------------------------------------- the stage

local function strip(y, waves, seed)
  local points, rough = { { -60, 800 } }, random(seed)
  for i = 0, 16 do points[#points + 1] = { 90 * i - 80, y + waves * (rough(i) - 0.5) } end
  points[#points + 1] = { 1400, 800 }
  return polygon(points)
end
local NIGHT = rect { -20, -20, 1320, 760, fill = fibres("#1d2b4e", "#33507f", 240) }
local STARS = {}
for i = 1, 60 do -- those that do not shine through his feathers or his words
  local x, y = 1240 * chance(i + 0.7), 20 + 400 * chance(i + 0.8)
  if y < 70 and x < 620 or x > 640 and y > 330 then
    STARS[#STARS + 1] = torn(star { centre = { x, y }, points = 5, outer = 15, inner = 6,
      rotate = 70 * chance(i) }, WHITE, i)
  end
end
STARS = union(STARS)
local MORNING = torn(strip(0, 60, "morning"):translate(0, -70),
  fibres("#f08a3c", "#fbc25e", 260), 3)
local rays = {}
for i = 1, 14 do
  rays[i] = path { d = "M-20 -176 L0 -250 L20 -176 Z" }:rotate(360 / 14 * i)
end
local SUN = torn(union(rays), YELLOW, 7) | torn(circle { 0, 0, 172 }, YELLOW, 8)
local HILLS = torn(strip(520, 90, "far"), fibres("#2f6b58", "#4d8f6c", 80), 11)
  | torn(strip(596, 36, "near"), fibres("#1f4a3a", "#37705a", 60), 12)
local FLOOR = torn(strip(664, 30, "floor"), GRAPH, 13)

-- ---------------------------------------------------------------- the sound

--- Paper, letters on wooden keys, two crows, and a morning in F.
local notes = { { 3.1, score.slide(520, 700, 0.5), 0.15 },
  { 5.84, score.slide(480, 820, 0.3), 0.18 },
  { 6.14, score.slide(820, 700, 0.42), 0.21 },
  { BURST, score.wind(0.7, 0.8, 0.05), 0.36 }, { BURST, score.thump(70), 0.42 } }
for _, piece in ipairs(PIECES) do
  notes[#notes + 1] = { piece.start, score.wind(0.8, 0.14, 0.05), 0.15 }
  notes[#notes + 1] = { piece.start + 0.36, score.thump(260), 0.105 }
  if piece[4] then notes[#notes + 1] = { BURST + 1.35, score.thump(180), 0.09 } end
  if piece.plant then notes[#notes + 1] = { BURST + 0.88, score.thump(240), 0.09 } end
end
for k, list in ipairs { FIRST, SECOND, THIRD } do
  for i, one in ipairs(list) do
    notes[#notes + 1] = { one.from + 0.05, score.thump(330 + 40 * i + 60 * k), 0.15 }
  end
end
for i, tone in ipairs { "F3", "C4", "F4", "A4", "C5", "F5", "A5" } do
  notes[#notes + 1] = { BURST + 0.1 * i, score.bell(tone, 1.6), 0.18 }
end
for i, tone in ipairs { "C5", "A4", "F4" } do
  notes[#notes + 1] = { 7.65 + 0.65 * i, score.bell(tone, 1.6), 0.18 }
end

return film { title = "Cut-paper morning", size = { 1280, 720 }, fps = 24, frames = 240,
  poster = "6.3s",
  sound = score.play(10, notes),
  frame = function(f)
    local t, up = f:threes(), rise:at(f:threes())
    local list = {}
    for i, piece in ipairs(PIECES) do list[i] = scrap(piece, i, t) end
    return { NIGHT, STARS, MORNING:translate(0, 620 * (1 - up)),
      SUN:rotate(6 * t):translate(640, 800 - 530 * up), HILLS,
      union(list):translate(520, 420), FLOOR:translate(0, 30),
      called(FIRST, t, 3.8), called(SECOND, t, BURST + 0.4), called(THIRD, t, BURST + 0.5),
      grain = { amount = set.grain, size = 1.8, frame = 0 } }
  end }
