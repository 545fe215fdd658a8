-- An egg, three ways: soft, fried, and one that has other plans. A story for a telephone, upright:
-- three cards of large shapes, each in two colours and a yolk, with a word that bears the joke.
local score = require "sound.score"

local FONT, W, H, FPS = "../type/poster.ttf", 1080, 1920, 24
local SHELL, SHADE, YOLK, GLOW = "#fff7ea", "#eadbc4", "#ffb400", "#ffd15c"
local CARD = 3.2 -- seconds of a card; the last one is longer

local cards = {
  { from = 0, back = "#3f7d58", ink = "#fff7ea", word = "SOFT" },
  { from = CARD, back = "#f25c54", ink = "#2a1a1f", word = "FRIED" },
  { from = 2 * CARD, back = "#ffd9e0", ink = "#7a2b8f", word = "FREE" },
}

-- ---------------------------------------------------------------- shapes

--- An egg about its middle, `size` high, broad end down.
local function egg(size, fill)
  local d = "M0 -0.5 C0.26 -0.5 0.385 -0.1 0.385 0.13 C0.385 0.36 0.22 0.5 0 0.5 "
    .. "C-0.22 0.5 -0.385 0.36 -0.385 0.13 C-0.385 -0.1 -0.26 -0.5 0 -0.5 Z"
  return path { d = d, fill = fill }:scale(size)
end

--- The same with a shade on its right side.
local function shell(size)
  local moon = egg(size, SHADE) - egg(size * 1.06, SHADE):translate(-0.13 * size, -0.04 * size)
  return egg(size, SHELL) | moon
end

--- The part of the plane between a zigzag at y, from x0 to x1, and the height `to`.
local function jagged(x0, x1, y, to)
  local points, teeth = { { x0, to } }, 12
  for i = 0, teeth do
    points[#points + 1] = { x0 + (x1 - x0) * i / teeth, y + (i % 2 == 0 and -26 or 26) }
  end
  points[#points + 1] = { x1, to }
  return polygon(points)
end

local function above(art, y) return clip(art, jagged(-600, 600, y, -1200)) end
local function below(art, y) return clip(art, jagged(-600, 600, y, 1200)) end

--- The word of a card as broad as the page, its letters dropping in one after another.
local function word(card, time, y)
  local art = {}
  local set = glyphs { card.word, 0, 0, font = FONT, size = 520,
    variations = { wdth = #card.word == 5 and 75 or 100 } }
  local last = set[#set]
  local left = (W - last.x - last.advance) / 2
  for i, letter in ipairs(set) do
    local u = motion.span(time, 0.12 + 0.07 * i, 0.5, "outBack")
    if u > 0 then
      art[#art + 1] = letter.object:scale(1, u, "bottom"):translate(left, y):paint(card.ink)
    end
  end
  return union(art)
end

-- ---------------------------------------------------------------- the cards

local cup = path { fill = "#17352a", d = "M-330 60 H330 C320 300 190 380 70 400 L60 560 "
  .. "C160 580 220 600 240 650 H-240 C-220 600 -160 580 -60 560 L-70 400 "
  .. "C-190 380 -320 300 -330 60 Z" }
cup = (cup | clip(rect { -400, 160, 800, 66, fill = "#f7b2a4" }, cup)):scale(1.07, 1)
local spoon = ellipse { 0, 0, 70, 100, fill = "#f7b2a4" }
  | rect { -17, 80, 34, 560, radius = 17, fill = "#f7b2a4" }
local toast = rect { -62, -560, 124, 560, radius = 30, fill = "#a8602c" }
  | rect { -44, -542, 88, 524, radius = 20, fill = "#eab676" }
local knock = keys { { 0.6, 0 }, { 0.72, -0.2, "outQuad" }, { 0.95, 1, "inCubic" },
  { 1.15, 0.3, "outCubic" }, { 1.4, 1, "inCubic" }, { 1.6, 0.1, "outCubic" } }

--- The open egg: its inside, the yolk, a strip of toast that dips into it, the shell in front, and
--- the lid on its way.
local function opened(time)
  local whole, lid = shell(880), motion.span(time, 1.42, 1)
  local rises = 150 * (1 - motion.span(time, 1.5, 0.5, "outBack"))
  local dips = keys { { 2, -1500 }, { 2.4, -90, "outCubic" }, { 2.6, -190, "inOutSine" },
    { 2.8, -70, "inOutSine" } }:at(time)
  return union {
    clip(ellipse { 0, -150, 330, 120, fill = SHADE }, egg(880)),
    circle { 0, -130 + rises, 215, fill = YOLK }, circle { -80, -220 + rises, 44, fill = GLOW },
    toast:rotate(14):translate(30, dips),
    below(whole, -150),
    above(whole, -150):rotate(160 * lid, 0, -300)
      :translate(900 * lid, -900 * lid + 1500 * lid * lid),
  }
end

--- Soft: the egg sits in its cup; a spoon knocks twice, and the lid flies off.
local function soft(time)
  local lands = motion.span(time, 0.1, 0.55, "outBack")
  local hit = (time > 0.95 and time < 1.05 or time > 1.4 and time < 1.5) and 10 or 0
  local beside = 700 * (1 - motion.span(time, 0.3, 0.4, "outCubic")
    + motion.span(time, 1.7, 0.4, "inCubic"))
  local set = union { (time < 1.42 and shell(880) or opened(time)):translate(0, -70 + hit), cup }
  return union { set:scale(lands, { 0, 650 }),
    spoon:rotate(-8 - 43 * knock:at(time), 0, 640):translate(620 + beside, -660) }
    :translate(W / 2, 1190)
end

--- Fried: the egg falls, breaks in the pan, and is tossed once.
local function fried(time)
  local falls = motion.span(time, 0.1, 0.6, "inQuad")
  local splat = motion.span(time, 0.7, 0.5, "outElastic")
  local flip = motion.span(time, 1.85, 0.75)
  local pan = circle { 0, 0, 450, fill = cards[2].ink } | rect { -66, 380, 132, 620, radius = 60,
    fill = cards[2].ink } | circle { 0, 0, 392, fill = "#46303a" }
  local art = { pan }
  if falls < 1 then
    art[#art + 1] = shell(560):rotate(200 * falls):translate(0, -1500 + 1500 * falls)
  else
    local points, wobble = {}, motion.noise "white"
    for i = 0, 11 do
      local angle = i / 12 * 2 * math.pi
      local sizzle = 12 * wobble(i * 3.1, 4 * time)
      local r = (250 + 80 * wobble(i * 1.7)) * (0.4 + 0.6 * splat) + sizzle
      points[#points + 1] = { 1.12 * r * math.cos(angle), r * math.sin(angle) }
    end
    local yolk = circle { 20, -10, 140, fill = YOLK } | circle { -30, -66, 26, fill = GLOW }
    local turn = math.cos(2 * math.pi * flip)
    local whole = { nurbs { points = points, fill = turn > 0 and SHELL or SHADE },
      turn > 0 and yolk:scale(1 + 0.25 * (1 - splat), 1 - 0.25 * (1 - splat), 20, -10) }
    art[#art + 1] = union(whole):scale(1, turn):rotate(-16)
      :translate(0, -2300 * flip * (1 - flip))
    for i, away in ipairs { -1, 1 } do -- the halves of the shell fly off
      local u = motion.span(time, 0.7, 0.8)
      local half = i == 1 and above(shell(560), 0) or below(shell(560), 0)
      art[#art + 1] = half:rotate(200 + 260 * u * away)
        :translate(away * 1100 * u, -700 * u + 1300 * u * u)
    end
  end
  local tossed = keys { { 0.66, 0 }, { 0.74, 26, "outQuad" }, { 1.1, 0, "outBack" },
    { 1.5, 0 }, { 1.75, 60, "inOutSine" }, { 1.87, -60, "inQuad" }, { 2.2, 0, "inOutSine" },
    { 2.58, 0 }, { 2.66, 30, "outQuad" }, { 2.95, 0, "outBack" } }
  return union(art):rotate(16):translate(W / 2, 1160 + tossed:at(time))
end

local function chick(time)
  local blink = (time % 1.5 > 1.38) and 0.1 or 1
  local chirp = motion.span(time, 2.5, 0.15) - motion.span(time, 2.8, 0.15)
    + motion.span(time, 3.2, 0.15) - motion.span(time, 3.6, 0.2)
  local beak = path { d = "M-48 0 L0 -40 L48 0 Z", fill = "#f2622e" }:translate(0, -26 * chirp)
    | path { d = "M-40 4 L0 40 L40 4 Z", fill = "#d94a1e" }:translate(0, 16 * chirp)
  local tuft = stroke { d = "M0 -250 C-10 -320 -60 -330 -70 -310 M6 -250 C16 -340 76 -350 84 -320",
    width = 20, cap = "round", fill = YOLK }
  local eyes = {}
  for i, x in ipairs { -92, 92 } do
    eyes[i] = circle { x, -60, 30, fill = "#2a1a1f" } | circle { x + 9, -72, 10, fill = SHELL }
    eyes[i] = eyes[i]:scale(1, blink, x, -60)
  end
  return union { tuft, ellipse { 0, 0, 262, 260, fill = YOLK },
    ellipse { -150, 20, 46, 32, fill = "#ff8f5a" }, ellipse { 150, 20, 46, 32, fill = "#ff8f5a" },
    union(eyes), beak }
end

--- Free: the egg rocks, cracks, and lifts its own lid.
local function free(time)
  local lands = motion.span(time, 0.1, 0.5, "outBack")
  local rock = 9 * math.sin(13 * (time - 0.9)) * math.exp(-((time - 1.2) / 0.28) ^ 2)
    + 13 * math.sin(15 * (time - 1.7)) * math.exp(-((time - 1.95) / 0.2) ^ 2)
  local up = motion.span(time, 2.15, 0.6, "outBack")
  local lid = keys { { 2.15, 0 }, { 2.6, 1.5, "outCubic" }, { 3.05, 0.86, "outBounce" } }:at(time)
  local whole, line = shell(900), 10
  local art
  if time < 1.7 then
    art = { whole }
  elseif up == 0 then
    art = { whole, stroke { width = 12, join = "round", fill = cards[3].ink,
      points = { { -350, line }, { -300, line + 26 }, { -200, line - 26 }, { -100, line + 26 },
        { 0, line - 26 }, { 100, line + 26 } }, to = motion.span(time, 1.7, 0.3) } }
  else
    local tilt = 7 * math.sin(3 * (time - 2.15))
    local head = chick(time):translate(0, 60 - 150 * up)
    art = { clip(ellipse { 0, 10, 345, 90, fill = SHADE }, egg(900)), head, below(whole, line),
      above(whole, line):translate(0, -330 * lid):rotate(tilt, 0, -300) }
  end
  return union(art):rotate(rock, 0, 450):scale(lands, { 0, 450 }):translate(W / 2, 1290)
end

-- ---------------------------------------------------------------- the film

local scenes = { soft, fried, free }

--- The three bars at the top, as such stories have them.
local function bars(time, ink)
  local art = {}
  for i, card in ipairs(cards) do
    local x, w = 48 + (i - 1) * 332, 320
    local u = motion.span(time, card.from, i == 3 and 4.6 or CARD)
    art[#art + 1] = rect { x, 60, w, 12, radius = 6, fill = rgb(ink, 0.3) }
    art[#art + 1] = rect { x, 60, math.max(12, w * u), 12, radius = 6, fill = ink }
      :fade(u > 0 and 1 or 0)
  end
  return union(art)
end

local function card_of(i, time)
  local card = cards[i]
  local local_time = time - card.from
  return union { rect { 0, 0, W, H, fill = card.back }, word(card, local_time, 560),
    scenes[i](local_time), bars(time, card.ink) }
end

local function frame(f)
  local time, shown = f.time, 1
  for i, card in ipairs(cards) do if time >= card.from then shown = i end end
  local u = shown > 1 and motion.span(time, cards[shown].from, 0.35, "outCubic") or 1
  if u >= 1 then return cel { card_of(shown, time) } end
  -- The new card comes up over the old one, which goes a little way with it.
  return cel { card_of(shown - 1, time):translate(0, -300 * u),
    card_of(shown, time):translate(0, H * (1 - u)) }
end

local function foley()
  local sound = score(11)
  local function pluck(time, names)
    for i, hertz in ipairs(names) do
      sound:add(time + 0.07 * i, score.bell(hertz, 0.5), 0.2, 0.2 * (i - 2.5))
    end
  end
  pluck(0.1, { 392, 494, 587, 784 })
  for _, time in ipairs { 0.95, 1.4 } do
    sound:add(time, score.bell(2100, 0.12), 0.3)
    sound:add(time, score.click(0.9, 0.06), 0.4)
  end
  sound:add(1.45, score.slide(300, 1100, 0.5), 0.25)
  sound:add(2.3, score.thump(150, 0.12), 0.5)
  sound:add(2.75, score.thump(170, 0.12), 0.5)
  pluck(CARD + 0.1, { 349, 440, 523, 698, 880 })
  sound:add(CARD + 0.15, score.slide(1200, 300, 0.55), 0.2)
  sound:add(CARD + 0.7, score.thump(80, 0.3), 0.8)
  sound:add(CARD + 0.72, score.click(0.5, 2.4), 0.22)
  sound:add(CARD + 1.85, score.slide(240, 700, 0.35), 0.25)
  sound:add(CARD + 2.6, score.thump(90, 0.25), 0.7)
  pluck(2 * CARD + 0.1, { 330, 415, 494, 659 })
  for i = 0, 5 do sound:add(2 * CARD + 0.85 + 0.24 * i, score.thump(120, 0.1), 0.35) end
  sound:add(2 * CARD + 1.72, score.click(0.95, 0.25), 0.4)
  sound:add(2 * CARD + 2.15, score.slide(260, 900, 0.35), 0.3)
  for _, time in ipairs { 2.5, 2.65, 3.2, 3.36, 3.5 } do
    sound:add(2 * CARD + time, score.slide(2300, 3100, 0.09), 0.3)
  end
  pluck(2 * CARD + 3.7, { 392, 494, 587, 784, 988 })
  return sound:address()
end

return film { title = "An egg, three ways", size = { W, H }, fps = FPS, duration = 11,
  sound = foley(), frame = frame }
