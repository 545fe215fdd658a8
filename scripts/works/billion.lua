-- A billion beats: a mouse, a cat and an elephant have lives of very different lengths, and hearts
-- of very different speeds, and all have about a billion heartbeats. A data story in rectangles:
-- a life is as broad as its years and as high as its pulse, so its area is the number of beats.
--
-- Typical values at rest, rounded; the observation is that of H. J. Levine, Rest heart rate and
-- life expectancy, Journal of the American College of Cardiology 30 (1997).
local score = require "sound.score"

local FONT, W, H, FPS = "../type/poster.ttf", 1280, 720, 24
local PAPER, INK, RED = "#f9e3dc", "#1b1418", "#e5243f"
local MINUTES = 60 * 24 * 365

local lives = {
  { name = "Mouse", pulse = 600, years = 3, from = 0.4, colour = RED, label = { 152, 262 } },
  { name = "Cat", pulse = 140, years = 15, from = 1.8, colour = "#f0803c", label = { 152, 424 } },
  { name = "Elephant", pulse = 30, years = 65, from = 3.2, colour = "#7d4a7a",
    label = { 310, 548 } },
  { name = "You", pulse = 70, years = 80, from = 7.1, colour = INK },
}
local BILLION, YOURS = 5.2, 6.9 -- when rectangles become squares, and when you come
local FLOOR, LEFT, ACROSS, UP = 640, 92, 13.2, 0.9 -- units for a year, and for a beat a minute

--- The beats of a life, in billions.
local function beats_of(life) return life.pulse * life.years * MINUTES / 1e9 end

--- A line of type.
local function line(words, x, y, size, fill, align, wdth)
  return text { words, x, y, font = FONT, size = size, align = align, fill = fill,
    variations = { wdth = wdth or 100 } }
end

--- How far a heart is in its beat, as a swelling from 0 to 1: two knocks, then a rest.
local function beat(life, time)
  local u = time * life.pulse / 60 % 1
  local knock = math.exp(-((u - 0.1) / 0.07) ^ 2) + 0.6 * math.exp(-((u - 0.32) / 0.08) ^ 2)
  return knock
end

local SIDE, GAP = 220, 14 -- of the square of a billion; between squares

--- The left edge of the square that a life becomes.
local function place(i)
  local x = LEFT
  for k = 1, i - 1 do x = x + math.sqrt(beats_of(lives[k])) * SIDE + GAP end
  return x
end

--- A life at a time: a rectangle x, y, w, h, which becomes a square. All areas grow alike.
local function box_of(life, i, time)
  local long = motion.span(time, life.from + 0.25, 0.7, "outCubic")
  local high = motion.span(time, life.from, 0.45, "outBack")
  local broad, tall = life.years * ACROSS, life.pulse * UP
  local u = motion.span(time, BILLION + 0.12 * (i - 1), 0.8, "inOutCubic")
  local side = math.sqrt(beats_of(life)) * SIDE
  local w = math.max(6, broad * long) * (side / broad) ^ u
  local h = tall * high * (side / tall) ^ u
  return LEFT + (place(i) - LEFT) * u, FLOOR - h, w, h
end

--- You: a square that is nearly three times as large, and pushes the others to the left.
local function yours(life, time)
  local u = motion.span(time, life.from, 0.9, "outBack")
  local side = math.sqrt(beats_of(life)) * SIDE * u
  return W - 92 - side, FLOOR - side, side, side
end

--- What a rectangle is: a name, its pulse and its years.
local function label(art, life, time)
  local comes = motion.span(time, life.from + 0.4, 0.4, "outCubic")
  local shown = comes * (1 - motion.span(time, BILLION - 0.3, 0.3))
  if shown == 0 then return end
  local x, y = life.label[1] - 30 * (1 - comes), life.label[2]
  local name = line(life.name, x, y, 92, life.colour)
  local figures = ("%d a minute × %d years"):format(life.pulse, life.years)
  art[#art + 1] = name:fade(shown)
  art[#art + 1] = line(figures, x + name:metrics().width + 18, y, 40, INK):fade(shown)
end

--- The name of a life in its square, with how many billions it has.
local function total(art, life, i, x, y, h, time)
  local shown = life.name == "You" and motion.span(time, life.from + 0.5, 0.3)
    or motion.span(time, BILLION + 0.5 + 0.12 * i, 0.3)
  if shown == 0 then return end
  local large = life.name == "You"
  art[#art + 1] = line(("%.1f"):format(beats_of(life)), x + 18, y + (large and 204 or 118),
    large and 250 or 130, PAPER):fade(shown)
  art[#art + 1] = line(life.name, x + 20, y + h - 22, large and 84 or 48, PAPER):fade(shown)
end

--- The headline: a question, and then what is found.
local function headline(art, time)
  local lines = { { "How long is a life?", -0.4, BILLION - 0.2 },
    { "About a billion beats.", BILLION + 0.6, YOURS },
    { "You get nearly three.", YOURS + 0.4, 99 } }
  for _, one in ipairs(lines) do
    local comes = motion.span(time, one[2], 0.5, "outCubic")
    local goes = motion.span(time, one[3], 0.2, "inCubic")
    if comes > 0 and goes < 1 then
      local set = line(one[1], 0, 0, 132, INK)
      local words = set:translate(148 - 56 * motion.span(time, BILLION, 0.1),
        148 + 130 * (1 - comes) - 130 * goes)
      art[#art + 1] = clip(words, rect { 0, 40, W, 136 })
    end
  end
end

local function hearts()
  local sound = score(10)
  local notes = { { 180, 0.16, 0.07 }, { 92, 0.4, 0.16 }, { 46, 0.75, 0.4 }, { 62, 0.8, 0.3 } }
  for i, life in ipairs(lives) do
    local hertz, volume, length = table.unpack(notes[i])
    local stop = i < 4 and lives[i + 1].from + (i == 3 and -1.4 or 0) or 9.7
    for time = life.from, stop, 60 / life.pulse do
      sound:add(time, score.thump(hertz, length), volume)
      if i > 1 then sound:add(time + 13 / life.pulse, score.thump(hertz * 0.9, length),
        volume * 0.6) end
    end
  end
  for i, hertz in ipairs { 293.7, 370, 440 } do
    sound:add(BILLION + 0.55 + 0.12 * i, score.bell(hertz, 1.2), 0.2, 0.3 * (i - 2))
  end
  for i, hertz in ipairs { 146.8, 220, 293.7, 370, 587.3 } do
    sound:add(lives[4].from + 0.04 * i, score.bell(hertz, 2), 0.17, 0.2 * (i - 3))
  end
  return sound:address()
end

local function frame(f)
  local time = f.time
  local art = { rect { 0, 0, W, H, fill = PAPER } }
  local axes = 1 - motion.span(time, BILLION - 0.2, 0.3)
  art[#art + 1] = rect { LEFT, FLOOR, W - LEFT - 92, 5, fill = INK }
  for years = 0, 80, 20 do
    local words = years == 80 and "80 years" or tostring(years)
    art[#art + 1] = line(words, LEFT + years * ACROSS, FLOOR + 46, 32, INK,
      years == 80 and "right" or "left"):fade(axes * motion.span(time, years / 100, 0.3))
  end
  for i = #lives, 1, -1 do
    local life = lives[i]
    if time > life.from then
      local x, y, w, h = box_of(life, i, time)
      if i == 4 then x, y, w, h = yours(life, time) end
      local swell = 7 * beat(life, time - life.from)
      art[#art + 1] = rect { x, y - swell, w + swell, h + swell, fill = life.colour }
      if i < 4 then label(art, life, time) end
      total(art, life, i, x, y, h, time)
    end
  end
  art[#art + 1] = line("Billions of heartbeats in a life, at rest", LEFT, FLOOR + 46, 32, INK)
    :fade(motion.span(time, BILLION + 0.6, 0.3))
  headline(art, time)
  return cel(art)
end

return film { title = "A billion beats", size = { W, H }, fps = FPS, duration = 10,
  sound = hearts(), frame = frame }
