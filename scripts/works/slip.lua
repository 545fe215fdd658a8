-- Slip: twelve bars are piano keys, roofs and a prison, and one red dot gets away from all three.
-- The titles of a film that does not exist, cut to a walking bass: the dot lands on each of its
-- notes, and what plays them is the same list that moves it.
local score = require "sound.score"

local FONT, W, H, FPS = "../type/poster.ttf", 1280, 720, 24
local BEAT = 0.375
local BONE, INK, BLUE, RED = "#f1eadb", "#121216", "#2a48f5", "#ff4a1c"
local COUNT, RADIUS = 12, 40

-- ---------------------------------------------------------------- the title

local TITLE_Y = 490
local title = glyphs { "Slıp", 640, TITLE_Y, font = FONT, size = 620, align = "centre" }

--- The box of the stem of a letter of the title: left, top, width, bottom.
local function stem(i)
  local x, y, w, h = title[i].object:bounds()
  return { x, y, w, y + h }
end
local stem_l, stem_i = stem(2), stem(3)
local DOT_AT = { stem_i[1] + stem_i[3] / 2, stem_i[2] - RADIUS * 1.3 - 22 }

-- ---------------------------------------------------------------- the bars

local function place(i) return (i - 0.5) * W / COUNT end

--- A bar as left, top, width, bottom: as a key, as a roof, in the prison, and in the title.
local function as_key(i) return { place(i) - 45, 490, 90, 760 } end
local roofs = { 640, 570, 610, 520, 560, 470, 510, 420, 460, 370, 410, 330 }
local function as_roof(i) return { place(i) - 43, roofs[i], 86, 760 } end
local function in_prison(i) return { place(i) - 24, -40, 48, 760 } end
local function in_title(i)
  if i == 6 then return stem_l elseif i == 7 then return stem_i end
  return { place(i) + (i < 6 and -700 or 700), -40, 48, 760 }
end

local tracks = {}
for i = 1, COUNT do
  local late = 0.07 * math.abs(i - 6.5)
  local function at(beat) return beat * BEAT + late * 0.7 end
  tracks[i] = keys {
    { at(-1.6), { place(i) - 45, 800, 90, 860 } }, { at(-0.4), as_key(i), "outBack" },
    { at(6.9), as_key(i) }, { at(8.1), as_roof(i), "inOutBack" },
    { at(15), as_roof(i) }, { at(16), in_prison(i), "inOutCubic" },
    { at(22), in_prison(i) }, { at(23.4), in_title(i), "inOutCubic" } }
end

-- ---------------------------------------------------------------- the dot

-- Where the dot lands: beat, bar, or a point; and the note that is heard, in hertz.
local D, F, G, A, C = 73.4, 87.3, 98, 110, 130.8
local landings = {
  { 0, 1, D }, { 1, 3, F }, { 2, 4, G }, { 3, 6, A }, { 4, 8, C }, { 5, 9, A }, { 6, 11, G },
  { 6.66, { 1400, 300 }, F, is_cut = true },
  { 7.9, { -60, 420 } }, { 9, 1, D }, { 10, 3, F }, { 11, 5, A }, { 12, 7, G }, { 13, 9, C },
  { 14, 11, D * 2 }, { 15, { 1400, -60 }, A, is_cut = true },
  { 15.6, { 560, -160 } }, { 16.4, { 560, 600 }, D }, { 17.2, { 720, 600 }, F },
  { 18, { 560, 600 }, G }, { 19, { 640, 430 }, A }, { 21, { 640, 430 } },
  { 22, { 640, -140 }, D * 2, is_cut = true }, { 23.6, { DOT_AT[1], -160 } },
  { 24.4, DOT_AT, D } }

local function beat_of(time) return time / BEAT end

--- A bar at a time: pressed down by the dot that lands on it, and springing back.
local function bar_at(i, time)
  local box = tracks[i]:at(time)
  local sunk = 0
  for _, landing in ipairs(landings) do
    local since = time - landing[1] * BEAT
    if landing[2] == i and since >= 0 and since < 0.9 then
      sunk = sunk + 46 * math.exp(-5 * since) * math.cos(13 * since)
    end
  end
  return box[1], box[2] + sunk, box[3], box[4]
end

--- How high the gables are at a beat: only the roofs have them.
local function gable_at(beat)
  return 38 * (motion.span(beat, 7.3, 0.8, "outBack") - motion.span(beat, 15, 0.5))
end

--- Where a landing is.
local function point_of(landing)
  if type(landing[2]) == "table" then return landing[2][1], landing[2][2] end
  local x, y, w = bar_at(landing[2], landing[1] * BEAT - 0.001)
  return x + w / 2, y - RADIUS - gable_at(landing[1])
end

--- The dot at a time: x, y, and how much it is stretched along its way.
local function dot_at(time)
  local beat, i = beat_of(time), 1
  while landings[i + 1] and beat >= landings[i + 1][1] do i = i + 1 end
  local from, to = landings[i], landings[i + 1]
  local x0, y0 = point_of(from)
  if not to or from.is_cut or beat < 0 then return x0, y0, 0 end
  local x1, y1 = point_of(to)
  local u = (beat - from[1]) / (to[1] - from[1])
  local is_held = from[1] == 19
  local is_fall = from[1] == 15.6 or from[1] == 23.6
  local hop = (is_held or is_fall) and 0 or from[1] == 18 and 60 or from[1] > 7 and 120 or 230
  local y = y0 + (y1 - y0) * (is_fall and u * u or u) - hop * 4 * u * (1 - u)
  return x0 + (x1 - x0) * u, y, is_held and 0 or 0.22 * math.abs(2 * u - 1) ^ 2
end

--- How far the bars beside the dot are pressed apart, and swing back when it is gone.
local function bow_at(time)
  local beat = beat_of(time)
  local pressed = motion.span(beat, 19, 2, "inOutCubic")
  local since = time - 21.2 * BEAT
  if since <= 0 then return 80 * pressed end
  return 80 * math.exp(-5 * since) * math.cos(24 * since) * (1 - motion.span(beat, 21.6, 0.4))
end

-- ---------------------------------------------------------------- the picture

local function bar(i, time, fill)
  local x, y, w, low = bar_at(i, time)
  local share = ({ 1, 0.5, 0.2 })[math.abs(i - 6.5) // 1 + 1] or 0
  local bow = (i > 6 and 1 or -1) * share * bow_at(time)
  if math.abs(bow) < 0.5 then
    local box, high = rect { x, y, w, low - y, fill = fill }, gable_at(beat_of(time))
    if high <= 0 then return box end
    local window = rect { x + w / 2 - 9, y + 14, 18, 0.7 * high }
    return box - window
      | triangle { { x - 8, y }, { x + w / 2, y - high }, { x + w + 8, y }, fill = fill }
  end
  local d = "M%g -40 C%g 200 %g 230 %g 430 C%g 630 %g 660 %g 900 "
    .. "H%g C%g 660 %g 630 %g 430 C%g 230 %g 200 %g -40 Z"
  local bent, right = x + bow, x + w
  local far = bent + w
  return path { fill = fill, d = d:format(x, x, bent, bent, bent, x, x, right, right, far, far, far,
    right, right) }
end

--- The colours of a part of the film: of the ground, the bars and the dot.
local function colours_at(beat)
  if beat < 7.5 then return BLUE, BONE, RED end
  if beat < 15.5 then return INK, BLUE, RED end
  if beat < 22.6 then return RED, INK, BONE end
  return BONE, INK, RED
end

--- Two lines of a credit: the task, small, and the name; they slide in and out at their side.
local function credit(task, name, side, from, to, time)
  local beat = beat_of(time)
  local comes = motion.span(beat, from, 1, "outCubic")
  local goes = motion.span(beat, to, 0.7, "inCubic")
  if comes == 0 or goes == 1 then return nil end
  local out = 500 * (1 - comes) + 900 * goes
  local x = side == "left" and 64 - out or W - 64 + out
  return union { text { task, x, 98, font = FONT, size = 40, align = side, fill = BONE },
    text { name, x, 184, font = FONT, size = 96, align = side, fill = BONE } }
end

--- The letters S and p, which come up beside the two bars that stay.
local function letters(time, fill)
  local art = {}
  for k, i in ipairs { 1, 4 } do
    local u = motion.span(beat_of(time), 23 + 0.4 * k, 1.2, "outBack")
    if u > 0 then art[k] = title[i].object:translate(0, 620 * (1 - u)):paint(fill) end
  end
  return union { art[1], art[2] }
end

local function frame(f)
  local time, beat = f.time, beat_of(f.time)
  local ground, ink, red = colours_at(beat)
  local bars = {}
  for i = 1, COUNT do bars[i] = bar(i, time, ink) end
  local x, y, stretch = dot_at(time)
  local size = 1 + 0.55 * motion.span(beat, 19, 2, "inOutCubic") - 0.25 * motion.span(beat, 22, 1)
  local squashed = math.exp(-((beat - 24.45) / 0.12) ^ 2) * 0.3
  local next_x, next_y = dot_at(time + 0.01)
  local way = math.deg(math.atan(next_y - y, next_x - x))
  local dot = ellipse { 0, 0, RADIUS * size * (1 + stretch), RADIUS * size * (1 - stretch / 2),
    fill = red }:rotate(way):scale(1 + squashed, 1 - squashed):translate(x, y)
  local is_behind = beat > 15.5 and beat < 19
  local words = credit("a film by", "Nora Lindqvist", "left", -0.9, 6.8, time)
    or credit("with", "Ida Holm · Jo Park", "right", 8.1, 14.2, time)
  return cel { rect { 0, 0, W, H, fill = ground }, words, is_behind and dot, union(bars),
    beat > 23 and letters(time, ink), not is_behind and dot,
    beat > 25.5 and text { "in cinemas never", 640, 664, font = FONT, size = 60,
      align = "centre", tracking = 30, fill = "#d8370c" }:fade(motion.span(beat, 25.5, 1)) }
end

-- ---------------------------------------------------------------- the music

local function music()
  local sound = score(11.25)
  for _, landing in ipairs(landings) do
    if landing[3] then
      sound:add(landing[1] * BEAT, score.bass(landing[3], 0.5), 0.45, -0.1)
      sound:add(landing[1] * BEAT, score.thump(70, 0.12), 0.25)
    end
  end
  for beat = 0, 21 do -- brushes on two and four, and a ride that swings
    if beat % 2 == 1 then sound:add(beat * BEAT, score.click(0.6, 0.12), 0.22, 0.3) end
    sound:add(beat * BEAT, score.bell(5200, 0.09), 0.035, 0.4)
    if beat % 2 == 1 then sound:add((beat + 0.66) * BEAT, score.bell(5200, 0.07), 0.03, 0.4) end
  end
  local function chord(beat, length, names, volume)
    for i, hertz in ipairs(names) do
      sound:add(beat * BEAT + 0.012 * i, score.bell(hertz, length), volume, 0.25 * (i - 2.5))
    end
  end
  chord(0, 0.5, { 349.2, 440, 523.3, 659.3 }, 0.07)
  chord(3.66, 0.4, { 392, 466.2, 587.3, 698.5 }, 0.07)
  chord(7.66, 0.5, { 349.2, 440, 523.3, 659.3 }, 0.07)
  chord(12.66, 0.4, { 392, 493.9, 587.3, 698.5 }, 0.07)
  sound:add(19 * BEAT, score.slide(160, 420, 2 * BEAT), 0.16)
  sound:add(21.2 * BEAT, score.slide(900, 180, 0.3), 0.25)
  for i = 0, 5 do sound:add(21.2 * BEAT + 0.13 * i, score.bass(196, 0.12), 0.2 * 0.7 ^ i) end
  chord(24.4, 2.4, { 146.8, 349.2, 440, 493.9, 659.3 }, 0.13)
  return sound:address()
end

return film { title = "Slip", size = { W, H }, fps = FPS, duration = 11.25, sound = music(),
  frame = frame }
