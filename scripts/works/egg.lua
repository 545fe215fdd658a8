-- An egg, three ways: soft, fried, and one that has other plans. A story for a telephone, upright:
-- three cards of large shapes, each in two colours and a yolk, with a word that bears the joke.
local score = require "sound.score"

local FONT, W, H, FPS = "../type/poster.ttf", 1080, 1920, 24
local SHELL, SHADE, YOLK, GLOW, CRISP = "#fff7ea", "#eadbc4", "#ffb400", "#ffd15c", "#e3b878"
local DARK, LEG = "#2a1a1f", "#f2622e"
local CARD = 3.2 -- seconds of a card; the last one is longer

local cards = {
  { from = 0, back = "#3f7d58", ink = "#fff7ea", word = "SOFT" },
  { from = CARD, back = "#f25c54", ink = DARK, word = "FRIED" },
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
    local u = motion.span(time, 0.07 * i - 0.2, 0.5, "outBack")
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
local toast = rect { -62, -480, 124, 480, radius = 30, fill = "#a8602c" }
  | rect { -44, -462, 88, 444, radius = 20, fill = "#eab676" }
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

--- The white of a fried egg, with a crisp rim; it spreads, and sizzles.
local function white(time, splat, fill)
  local points, wobble = {}, motion.noise "white"
  for i = 0, 11 do
    local angle = i / 12 * 2 * math.pi
    local sizzle = 12 * wobble(i * 3.1, 4 * time)
    local r = (250 + 80 * wobble(i * 1.7)) * (0.4 + 0.6 * splat) + sizzle
    points[#points + 1] = { 1.12 * r * math.cos(angle), r * math.sin(angle) }
  end
  local shape = nurbs { points = points, fill = CRISP }
  return shape | shape:scale(0.93, { 0, 0 }):paint(fill)
end

--- The egg in the pan, from the splat at 0.7 on: the halves of its shell fly off behind it, and
--- later it is tossed.
local function in_pan(time)
  local splat = motion.span(time, 0.7, 0.5, "outElastic")
  local flip = motion.span(time, 1.85, 0.75)
  local art, u = {}, motion.span(time, 0.72, 0.7)
  for i, away in ipairs { -1, 1 } do
    local half = i == 1 and above(shell(480), 0) or below(shell(480), 0)
    art[#art + 1] = half:rotate(200 + 260 * u * away)
      :translate(away * (190 + 1000 * u), -560 * u + 1300 * u * u)
  end
  local yolk = circle { 20, -10, 140, fill = YOLK } | circle { -30, -66, 26, fill = GLOW }
  local turn = math.cos(2 * math.pi * flip)
  local fried_egg = white(time, splat, turn > 0 and SHELL or SHADE)
  if turn <= 0 then fried_egg = fried_egg | circle { 20, -10, 128, fill = "#d9c9a4" } end
  if turn > 0 then
    fried_egg = fried_egg | yolk:scale(1 + 0.25 * (1 - splat), 1 - 0.25 * (1 - splat), 20, -10)
  end
  art[#art + 1] = fried_egg:scale(1, turn):rotate(-16):translate(0, -1250 * flip * (1 - flip))
  return union(art)
end

--- Fried: the egg falls, breaks in the pan, and is tossed once.
local function fried(time)
  local falls = motion.span(time, 0.1, 0.6, "inQuad")
  local pan = circle { 0, 0, 450, fill = DARK } | rect { -66, 380, 132, 620, radius = 60,
    fill = DARK } | circle { 0, 0, 392, fill = "#46303a" }
  local fallen = falls < 1 and shell(560):rotate(200 * falls):translate(0, -1500 + 1500 * falls)
    or in_pan(time)
  local tossed = keys { { 0.66, 0 }, { 0.74, 26, "outQuad" }, { 1.1, 0, "outBack" },
    { 1.5, 0 }, { 1.75, 60, "inOutSine" }, { 1.87, -60, "inQuad" }, { 2.2, 0, "inOutSine" },
    { 2.58, 0 }, { 2.66, 30, "outQuad" }, { 2.95, 0, "outBack" } }
  return union { pan, fallen }:rotate(16):translate(W / 2, 1160 + tossed:at(time))
end

local hat = above(shell(900), 10):scale(0.46)
local HAT_OFF, HAT_LANDS = 4.3, 4.8 -- it stays behind

--- The hat alone: it flies up, turns over once, and rocks on the ground until it is still.
local function lost(time)
  local u, since = motion.span(time, HAT_OFF, HAT_LANDS - HAT_OFF), math.max(0, time - HAT_LANDS)
  local rocks = 15 * math.sin(22 * since) * math.exp(-7 * since)
  return hat:rotate(rocks - 360 * u):translate(50 - 90 * u, -410 + 840 * u - 1500 * u * (1 - u))
end

--- A chick with a piece of its shell for a hat; aside: how far it has turned to the right.
local function chick(time, aside)
  local blink = (time < 3.9 and time % 1.5 > 1.38) and 0.1 or 1
  local chirp = motion.span(time, 2.5, 0.15) - motion.span(time, 2.8, 0.15)
    + motion.span(time, 4, 0.12) - motion.span(time, 4.5, 0.2)
  local beak = path { d = "M-48 0 L0 -40 L48 0 Z", fill = LEG }:translate(0, -26 * chirp)
    | path { d = "M-40 4 L0 40 L40 4 Z", fill = "#d94a1e" }:translate(0, 16 * chirp)
  local eyes = {}
  for i, x in ipairs { -92, 92 } do
    eyes[i] = circle { x, -60, 30, fill = DARK } | circle { x + 9, -72, 10, fill = SHELL }
    eyes[i] = eyes[i]:scale(1, blink, x, -60)
  end
  local face = (union(eyes) | beak):scale(1 - 0.35 * aside, 1):translate(130 * aside, 0)
  local head = ellipse { 0, 0, 262, 260, fill = YOLK } | face
  if time >= HAT_OFF then return head end
  return head | hat:rotate(18 - 30 * aside):translate(74 - 60 * aside, -208)
end

--- Two legs from the shell down to the ground, which step when it runs; out: how far they are out.
local function legs(out, run)
  local art = {}
  for i, x in ipairs { -80, 80 } do
    local swing = math.sin(26 * run + i * math.pi)
    local lift = run > 0 and 46 * math.max(0, math.cos(26 * run + i * math.pi)) or 0
    local foot, ground = x + (run > 0 and 110 * swing or 0), 380 + 180 * out - lift
    art[i] = stroke { width = 30, cap = "round", join = "round", fill = LEG, points = {
      { x, 370 }, { foot, ground - 16 } } }
      | stroke { width = 26, cap = "round", join = "round", fill = LEG, points = {
        { foot - 46, ground }, { foot, ground - 22 }, { foot + 56, ground } } }
  end
  return union(art)
end

--- Two hops of joy, and then off, to the right.
local up_and_down = keys { { 3.02, 0 }, { 3.14, 30, "outQuad" }, { 3.3, -110, "outQuad" },
  { 3.46, 0, "inQuad" }, { 3.54, 34, "outQuad" }, { 3.72, -140, "outQuad" },
  { 3.9, 0, "inQuad" }, { 3.97, 26, "outQuad" }, { 4.1, 0, "inOutSine" } }
local to_the_right = keys { { 3.95, 0 }, { 4.15, -70, "outQuad" }, { 4.65, 1250, "inQuad" } }

--- What is left when the lid is off: a shell with a chick, with two legs.
local function hatched(time)
  local whole, line = shell(900), 10
  local up = motion.span(time, 2.15, 0.6, "outBack")
  local out = motion.span(time, 2.85, 0.25, "outBack")
  local aside = motion.span(time, 3.5, 0.35, "inOutSine")
  local run = math.max(0, time - 4.15)
  local height = up_and_down:at(time) - 24 * math.abs(math.sin(26 * run))
  local pressed = math.max(0, height) / 300
  local body = union { clip(ellipse { 0, line, 345, 90, fill = SHADE }, egg(900)),
    chick(time, aside):translate(0, 60 - 150 * up), below(whole, line) }
  local lean = 12 * motion.span(time, 4.12, 0.2) - 8 * motion.span(time, 3.95, 0.15)
    + (run > 0 and 3 * math.sin(26 * run) or 0)
  local stands = body:scale(1 + pressed, 1 - pressed, 0, 450):rotate(lean, 0, 450)
    :translate(0, -110 * out + math.max(0, height))
  local chick_and_shell = (legs(out, run):translate(0, -110 * out) | stands)
    :translate(to_the_right:at(time), math.min(0, height))
  return time < HAT_OFF and chick_and_shell or chick_and_shell | lost(time)
end

--- Free: the egg rocks, cracks, throws off its lid, and goes its way.
local function free(time)
  local lands = motion.span(time, 0.1, 0.5, "outBack")
  local rock = 9 * math.sin(13 * (time - 0.9)) * math.exp(-((time - 1.2) / 0.28) ^ 2)
    + 13 * math.sin(15 * (time - 1.7)) * math.exp(-((time - 1.95) / 0.2) ^ 2)
  local whole, line = shell(900), 10
  if time < 2.15 then
    local crack = stroke { width = 12, join = "round", fill = cards[3].ink,
      points = { { -350, line }, { -300, line + 26 }, { -200, line - 26 }, { -100, line + 26 },
        { 0, line - 26 }, { 100, line + 26 } }, to = motion.span(time, 1.7, 0.3) }
    local art = time < 1.7 and whole or whole | crack
    return art:rotate(rock, 0, 450):scale(lands, { 0, 450 }):translate(W / 2, 1376)
  end
  local u = motion.span(time, 2.15, 0.8)
  local lid = above(whole, line):rotate(-150 * u, 0, -200)
    :translate(-1150 * u, -820 * u + 1500 * u * u)
  return union { hatched(time), lid }:translate(W / 2, 1376)
end

-- ---------------------------------------------------------------- the film

local scenes = { soft, fried, free }

local function card_of(i, time)
  local card = cards[i]
  local local_time = time - card.from
  return union { rect { 0, 0, W, H, fill = card.back }, word(card, local_time, 560),
    scenes[i](local_time) }
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
  local sound = score(11.6)
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
  for _, time in ipairs { 2.5, 2.65, 4, 4.12, 4.24 } do
    sound:add(2 * CARD + time, score.slide(2300, 3100, 0.09), 0.3)
  end
  sound:add(2 * CARD + 2.85, score.slide(500, 900, 0.14), 0.3)
  for _, time in ipairs { 3.14, 3.56 } do -- hops, and landings
    sound:add(2 * CARD + time, score.slide(300, 760, 0.18), 0.28)
    sound:add(2 * CARD + time + 0.32, score.thump(130, 0.14), 0.5)
  end
  for step = 0, 5 do
    sound:add(2 * CARD + 4.2 + 0.08 * step, score.click(0.9, 0.05), 0.4, 0.18 * step)
  end
  sound:add(2 * CARD + HAT_OFF, score.slide(700, 320, 0.4), 0.16)
  for bump = 0, 2 do
    sound:add(2 * CARD + HAT_LANDS + 0.13 * bump, score.thump(190, 0.1), 0.5 * 0.6 ^ bump)
  end
  pluck(2 * CARD + 4.45, { 392, 494, 587, 784, 988 })
  return sound:address()
end

return film { title = "An egg, three ways", size = { W, H }, fps = FPS, duration = 11.6,
  sound = foley(), frame = frame }
