-- A line of one's own: a line curls up, wakes as a bird, and takes itself away from the paper; what
-- it leaves draws it again. Line and bird are one stroke, drawn again for each second frame.
local score = require "sound.score"
local mood = require("stage.moods").paper

local set = parameters { grain = { 0.025, min = 0, max = 0.3 } }

local SMOOTH, OVER = "inOutSine", "outBack"
local BEFORE = "M-60 522 C100 514 260 530 400 520 S500 520 560 520"
local WAY = BEFORE .. " C720 520 790 430 830 330 C880 220 1030 190 1080 290 C1130 400 920 470 870 "
  .. "350 C830 240 960 150 1180 190 S1500 40 2600 -300"
local way = motion.along(WAY)
local LENGTH = motion.along(BEFORE).length

-- ---------------------------------------------------------------- the shapes of the bird

--- Splines from the end of the line: tail, back, head, beak, breast and belly.
local flat = {}
for i = 1, 19 do flat[i] = { 3 * i - 3, 0 } end
local asleep = { { 0, 0 }, { 10, -2 }, { -30, -12 }, { -84, -20 }, { -84, -20 }, { -50, -50 },
  { 0, -92 }, { 60, -118 }, { 112, -112 }, { 146, -88 }, { 152, -58 }, { 186, -34 }, { 186, -34 },
  { 150, -34 }, { 170, -44 }, { 186, -24 }, { 160, 0 }, { 90, 3 }, { 4, 1 } }
local awake = { { 0, 0 }, { 20, -14 }, { -40, -40 }, { -112, -62 }, { -112, -62 }, { -26, -94 },
  { 24, -142 }, { 44, -222 }, { 88, -268 }, { 144, -258 }, { 160, -222 }, { 214, -204 },
  { 214, -204 }, { 156, -190 }, { 152, -146 }, { 182, -82 }, { 160, -10 }, { 92, 6 }, { 4, 0 } }
local aloft = { { 0, 0 }, { 16, -4 }, { -30, -14 }, { -74, -30 }, { -74, -30 }, { 0, -36 },
  { 60, -48 }, { 116, -62 }, { 148, -88 }, { 190, -84 }, { 208, -56 }, { 258, -46 }, { 258, -46 },
  { 206, -34 }, { 190, -6 }, { 140, 20 }, { 84, 26 }, { 40, 18 }, { 0, 0 } }

local shape = keys { { 1.5, flat }, { 2.3, asleep, OVER }, { 3.3, asleep }, { 3.75, awake, OVER },
  { 5.3, awake }, { 5.65, aloft, "outCubic" } }

--- How much she is squashed: below 1 she is low and wide.
local squash = keys { { 2.3, 1 }, { 2.7, 1.04, SMOOTH }, { 3.1, 0.97, SMOOTH }, { 3.3, 0.9 },
  { 3.5, 1.12 }, { 3.75, 1 }, { 4.7, 1 }, { 5.0, 0.7, SMOOTH }, { 5.25, 0.66, SMOOTH },
  { 5.4, 1.3, "outCubic" }, { 5.8, 1, SMOOTH } }

--- Her eye: right, down, and how far it is open.
local eye = keys { { 3.2, { 118, -84, 0 } }, { 3.3, { 118, -84, 1 } },
  { 3.75, { 118, -226, 1 }, OVER },
  { 4.05, { 118, -226, 1 } }, { 4.1, { 116, -226, 0.1 } }, { 4.2, { 134, -232, 1 } },
  { 4.8, { 134, -232, 1 } }, { 5.0, { 132, -218, 0.5 } }, { 5.3, { 128, -226, 1 } },
  { 5.65, { 174, -60, 1 }, "outCubic" } }

--- How much colour she has: it comes as she shakes herself.
local blush = keys { { 4.2, 0 }, { 4.7, 1, SMOOTH } }

--- How far along her way the end of the line is, in units.
local head = keys { { 5.3, LENGTH },
  { 5.7, LENGTH + 190, "inQuad" }, { 7.6, LENGTH + 1500 }, { 8.7, LENGTH + 2500 } }

-- ---------------------------------------------------------------- pencil, paint and paper

--- Graphite: noise whose pale grains are the paper's; another for each drawing.
local function graphite(number)
  return noise { size = 1.3, seed = number % 5, fade = false,
    colours = { mood.ink, mood.ink .. "f0", mood.ink .. "70" } }
end

local function line(fields, f)
  fields.fill, fields.cap, fields.degree = graphite(f:on(2) // 2), "round", fields.points and 3
  return stroke(fields)
end

local PAPER = union {
  rect { 0, 0, 1280, 720, fill = linear(mood.sky) },
  rect { 0, 0, 1280, 720, fill = noise { kind = "fractal", size = 520, octaves = 7, gain = 0.62,
    colours = { mood.near .. "12", mood.near .. "00", mood.light .. "30" } } } }

local WASH = noise { kind = "fractal", size = 70, octaves = 5,
  colours = { "#d98f5c", mood.accent, "#e9b48a" } }

-- ---------------------------------------------------------------- the bird

--- A wing from her shoulder, `up` from -1 to 1.
local function wing(x, y, up, size)
  local h = 150 * up * size
  return { { x + 50, y }, { x + 62, y - 0.5 * h }, { x - 10 * size, y - h - 8 },
    { x - 88 * size, y - h }, { x - 88 * size, y - h }, { x - 72 * size, y - 0.55 * h + 18 },
    { x - 70 * size, y - 0.4 * h + 26 }, { x - 40, y - 0.1 * h + 20 }, { x - 10, y + 10 } }
end

local FOLDED = { { 50, -138 }, { 96, -120 }, { 100, -60 }, { 20, -44 }, { -50, -44 } }

local function bird(f, t)
  local outline, flies = shape:at(t), t >= 5.4
  local ex, ey, open = table.unpack(eye:at(t))
  local up = math.cos((t - 5.4) * 15)
  local parts = {}
  local function drawn(points, width, colour)
    local body = nurbs { points = points, closed = "clamped", fill = WASH }
    if colour > 0 then parts[#parts + 1] = body:translate(7, 5):fade(0.85 * colour) end
    parts[#parts + 1] = line({ points = points, width = width }, f)
  end
  if flies then drawn(wing(126, -48, 0.8 * up + 0.35, 1.25), 4.5, 0.5) end
  drawn(outline, 6.5, blush:at(t))
  if flies then drawn(wing(90, -40, up, 1.5), 6, 1) end
  if t > 3.6 and not flies then
    parts[#parts + 1] = line({ points = FOLDED, width = 5 }, f):fade(motion.span(t, 3.6, 0.2))
  end
  if t > 3.2 then
    parts[#parts + 1] = ellipse { ex, ey, 5.5, 1 + 6 * open, fill = mood.ink }
  elseif t > 2.2 then
    parts[#parts + 1] = line({ d = "M106 -84 Q116 -74 126 -84", width = 3.4 }, f)
  end
  local high = squash:at(t)
  return union(parts):scale(high ^ -0.6, high)
end

--- The line along her way, between two places in units. The pencil presses, and lets go.
local function thread(from, to, f)
  local points, count = {}, math.ceil((to - from) / 32)
  for i = 0, count do
    local s = from + (to - from) * i / count
    local x, y = way:at(s / way.length)
    points[i + 1] = { x, y, 5.8 + 1.8 * math.sin(s / 70) }
  end
  return line({ points = points }, f)
end

--- A feather that she loses, and that swings to the ground, until its quill is where the line was.
local FALL, LANDS, ERASED = 7.0, 9.3, 10.5
local from_x, from_y = way:at(head:at(FALL) / way.length)
local function feather(f, t)
  local u = motion.span(t, FALL, LANDS - FALL)
  local sway = math.cos(7.5 * u + 1.6) * (1 - u) ^ 0.6 * math.min(1, 4 * u)
  local quill = union {
    path { d = "M-34 0 Q-10 -20 40 -4 Q0 14 -34 0 Z", fill = WASH }:fade(0.85):translate(4, 3),
    line({ d = "M-52 2 Q0 -6 40 -4", width = 2.6 }, f),
    line({ d = "M-34 0 Q-10 -20 40 -4 Q0 14 -34 0", width = 3 }, f) }
  local writes = motion.span(t, LANDS + 0.1, 0.1) - motion.span(t, 10.4, 0.1)
  return quill:rotate(-34 * math.sin(7.5 * u) * (1 - u) + writes * 3 * math.sin(40 * t), -52, 2)
    :scale(1.5):translate(638 + (from_x - 638) * (1 - u) + 170 * sway,
      from_y + (517 - from_y) * u - 34 * sway ^ 2)
    :fade(1 - motion.span(t, ERASED, 0.25))
end

-- ---------------------------------------------------------------- the sound

--- She wakes, shakes herself, and goes up in thirds. The feather comes down: a pencil on paper.
local START = 1.35 -- in seconds of the acting: the film begins as it ends, with the line
local notes = { { LANDS + 0.1, score.wind(0.65, 1.2, 0.5), 0.105 },
  { 1.55, score.slide(220, 330, 0.6), 0.09 }, { 3.3, score.bell("G5", 1.6), 0.3 },
  { 3.55, score.bell("C5", 1.6), 0.3 },
  { 5.0, score.bell("G3", 1.6), 0.3 }, { 5.3, score.wind(0.4, 0.7, 0.05), 0.15 } }
for i = 0, 4 do notes[#notes + 1] = { 4.25 + 0.08 * i, score.wind(0.6, 0.07, 0.05), 0.15 } end
for i, tone in ipairs { "C4", "E4", "G4", "C5", "E5", "G5", "E5", "C5", "E5", "G5", "C6", "E6" } do
  notes[#notes + 1] = { 5.2 + 0.17 * i, score.bell(tone, 1.6), 0.18 }
end
for i, tone in ipairs { "E5", "D5", "C5", "A4", "G4", "E4" } do
  notes[#notes + 1] = { FALL + 0.36 * i, score.bell(tone, 1.6), 0.15 }
end
notes[#notes + 1] = { LANDS, score.bell("C4", 1.6), 0.21 }
for _, note in ipairs(notes) do note[1] = note[1] - START end

return film { title = "A line of one's own", size = { 1280, 720 }, fps = 24, frames = 228,
  poster = "4.5s", sound = score.play(9.5, notes),
  grain = { amount = set.grain, size = 2, frame = 0 },
  frame = function(f)
    local t = START + f:twos()
    local s = head:at(t)
    local x, y, degrees = way:at(s / way.length)
    local shaken = motion.span(t, 4.25, 0.1) - motion.span(t, 4.6, 0.15)
    local flies = motion.span(t, 5.3, 0.5)
    local drawn = motion.span(t, LANDS + 0.1, 1.1, SMOOTH)
    local drawing = union { s < way.length and thread(s - LENGTH, s, f),
      drawn > 0 and thread(LENGTH * (1 - drawn), LENGTH, f),
      t < 9 and bird(f, t):rotate(degrees * flies):translate(x, y) }
      :boil { amount = 1.5 + 4 * shaken, grain = 70, frame = f.index, seed = "line" }
    return { PAPER, drawing, t > FALL and feather(f, t):boil { amount = 1, frame = f.index } }
  end }
