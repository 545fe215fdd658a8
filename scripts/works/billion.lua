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
  { name = "Mouse", pulse = 600, years = 3, from = 0.4, colour = RED, label = { 150, 318 } },
  { name = "Cat", pulse = 140, years = 15, from = 1.4, colour = "#f0803c",
    label = { 312, 470 } },
  { name = "Elephant", pulse = 30, years = 65, from = 2.4, colour = "#7d4a7a",
    label = { 664, 548 } },
  { name = "You", pulse = 70, years = 80, from = 6.8, colour = INK },
}
local BILLION, YOURS = 4.2, 6.6 -- when rectangles become squares, and when you come
local FLOOR, LEFT, ACROSS, UP = 640, 92, 13.2, 0.7 -- units for a year, and for a beat a minute

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

local SIDE, GAP = 202, 20 -- of the square of a billion; between squares

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
  local figures = ("%d a minute × %d years"):format(life.pulse, life.years)
  art[#art + 1] = line(life.name, x, y, 64, life.colour):fade(shown)
  art[#art + 1] = line(figures, x, y + 44, 34, INK):fade(shown)
end

--- The name of a life in its square, with how many billions it has.
local function total(art, life, i, x, y, h, time)
  local shown = life.name == "You" and motion.span(time, life.from + 0.5, 0.3)
    or motion.span(time, BILLION + 0.5 + 0.12 * i, 0.3)
  if shown == 0 then return end
  local large = life.name == "You"
  art[#art + 1] = line(("%.1f"):format(beats_of(life)), x + 18, y + (large and 204 or 104),
    large and 250 or 108, PAPER):fade(shown)
  art[#art + 1] = line(life.name, x + 20, y + h - 22, large and 84 or 48, PAPER):fade(shown)
end

--- What makes an animal of the square x, y, w, h; out: how far it has popped.
local animals = {
  Mouse = function(x, y, w, h, out, time, colour)
    local art = {}
    for i, at in ipairs { 0.3, 0.78 } do
      local ear = circle { x + at * w, y - 16, 40, fill = colour }
        | circle { x + at * w, y - 18, 22, fill = "#f7a7a3" }
      art[i] = ear:scale(out, { x + at * w, y + 20 })
    end
    local wag = 10 * math.sin(9 * time)
    art[3] = stroke { width = 13, cap = "round", fill = colour, to = out,
      d = ("M%g %g C%g %g %g %g %g %g"):format(x + 8, y + h - 12, x - 66, y + h, x - 20, y + h - 90,
        x - 62, y + h - 118 + wag) }
    return union(art)
  end,
  Cat = function(x, y, w, _, out, time, colour)
    local art, twitch = {}, 10 * math.max(0, math.sin(2.4 * time)) ^ 20
    for i, side in ipairs { 1, -1 } do
      local corner = side == 1 and x or x + w
      local ear = polygon { { corner, y + 4 }, { corner + side * 12, y - 64 },
        { corner + side * 82, y + 4 }, fill = colour }
        | polygon { { corner + side * 17, y + 4 }, { corner + side * 22, y - 36 },
          { corner + side * 58, y + 4 }, fill = "#f9b98a" }
      art[i] = ear:rotate(i == 2 and twitch or 0, corner, y):scale(1, out, corner, y)
    end
    return union(art)
  end,
  Elephant = function(x, y, w, h, out, time, colour)
    local swing = 8 * math.sin(3 * time)
    local trunk = stroke { width = 42, cap = "round", fill = colour, to = out,
      d = ("M%g %g C%g %g %g %g %g %g S%g %g %g %g"):format(x + w - 26, y + 42, x + w + 56, y + 36,
        x + w + 24 + swing, y + 100, x + w + 24 + swing, y + h - 60, x + w + 42 + swing, y + h - 10,
        x + w + 56 + swing, y + h - 52) }
    local tusk = stroke { width = 16, cap = "round", fill = PAPER, to = out,
      d = ("M%g %g Q%g %g %g %g"):format(x + w - 48, y + 100, x + w - 22, y + 122, x + w + 2,
        y + 98) }
    local ear = ellipse { x + 62, y + 2, 62, 38, fill = colour }
      | ellipse { x + 60, y + 2, 44, 24, fill = "#a5709f" }
    ear = ear:rotate(-16 + 0.6 * swing, x + 90, y + 20):scale(out, { x + 90, y + 20 })
    return ear | trunk | tusk
  end,
}

--- A heart about 0, 0, as large as 1.
local heart = path { fill = RED, d = "M0 0.5 C-0.2 0.3 -0.55 0.1 -0.55 -0.18 "
  .. "C-0.55 -0.5 -0.12 -0.55 0 -0.24 C0.12 -0.55 0.55 -0.5 0.55 -0.18 C0.55 0.1 0.2 0.3 0 0.5 Z" }

--- An eye, which blinks.
local function eye_of(x, y, time)
  local open = (time % 1.7 > 1.58) and 0.15 or 1
  return ellipse { x, y, 10, 10 * open, fill = INK } | ellipse { x + 3, y - 3, 3, 3 * open,
    fill = PAPER }
end

--- What the square of a life becomes: an animal, one after another; yours gets a heart.
local function alive(art, life, i, x, y, w, h, time)
  local out = motion.span(time, BILLION + 0.75 + 0.17 * i, 0.4, "outBack")
  if i == 4 then
    local beats = beat(life, time - life.from)
    art[#art + 1] = heart:scale(motion.span(time, life.from + 0.6, 0.4, "outBack")
      * (88 + 16 * beats)):translate(x + w - 82, y + h - 74)
  elseif out > 0 then
    art[#art + 1] = animals[life.name](x, y, w, h, out, time, life.colour)
    local inwards = i < 3 and 26 or 14 -- the elephant has figures there
    art[#art + 1] = eye_of(x + w - inwards, y + 40, time + 0.4 * i):fade(math.min(1, out))
  end
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
      local words = set:translate(LEFT, 148 + 130 * (1 - comes) - 130 * goes)
      art[#art + 1] = clip(words, rect { 0, 40, W, 136 })
    end
  end
end

local function hearts()
  local sound = score(9.8)
  local notes = { { 180, 0.16, 0.07 }, { 92, 0.4, 0.16 }, { 46, 0.75, 0.4 }, { 62, 0.8, 0.3 } }
  for i, life in ipairs(lives) do
    local hertz, volume, length = table.unpack(notes[i])
    local stop = i == 3 and BILLION + 0.5 or i < 3 and lives[i + 1].from or 9.5
    for time = life.from, stop, 60 / life.pulse do
      sound:add(time, score.thump(hertz, length), volume)
      if i > 1 then sound:add(time + 13 / life.pulse, score.thump(hertz * 0.9, length),
        volume * 0.6) end
    end
  end
  for i, hertz in ipairs { 293.7, 370, 440 } do
    sound:add(BILLION + 0.55 + 0.12 * i, score.bell(hertz, 1.2), 0.2, 0.3 * (i - 2))
    sound:add(BILLION + 0.75 + 0.17 * i, score.slide(2 * hertz, 5 * hertz, 0.09), 0.2)
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
  art[#art + 1] = rect { LEFT, FLOOR, W - LEFT - 85, 5, fill = INK }
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
      -- Ten beats a second lie between the frames: so fast a heart shivers, on twos.
      local swell = i > 1 and 12 * beat(life, time - life.from) or 0
      local shiver = i == 1 and 3 * (-1) ^ (f.index // 2) or 0
      local aside = time > BILLION + 0.6 and swell / 2 or 0
      x, y, w, h = x + shiver - aside, y - swell, w + swell, h + swell
      art[#art + 1] = rect { x, y, w, h, fill = life.colour }
      alive(art, life, i, x, y, w, h, time)
      if i < 4 then label(art, life, time) end
      total(art, life, i, x, y, h, time)
    end
  end
  art[#art + 1] = line("Billions of heartbeats in a life, at rest", LEFT, FLOOR + 46, 32, INK)
    :fade(motion.span(time, BILLION + 0.6, 0.3))
  headline(art, time)
  return cel(art)
end

return film { title = "A billion beats", size = { W, H }, fps = FPS, duration = 9.8,
  sound = hearts(), frame = frame }
