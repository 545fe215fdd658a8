-- The cat and the moon: whoever pats the moon may get the day. Everything is one expression, `moon
-- ~ town`: where the moon is behind the town, black and white change places.
local score = require "sound.score"

-- ---------------------------------------------------------------- how she acts, in seconds

local SMOOTH, FAST, OVER = "inOutSine", "outCubic", "outBack"

--- Her head: right, down, degrees clockwise.
local head = keys { { 0.8, { 0, 0, 0 } }, { 1.1, { 6, -6, 12 }, SMOOTH }, { 1.9, { 6, -6, 12 } },
  { 2.25, { -12, 8, 4 }, SMOOTH }, { 2.45, { -12, 8, 4 } }, { 2.6, { 14, -2, 8 }, FAST },
  { 3.0, { 8, -8, 14 }, SMOOTH }, { 3.5, { -4, -12, -14 }, SMOOTH }, { 4.0, { 4, -6, 4 }, SMOOTH },
  { 4.5, { -19, 7, -8 }, SMOOTH }, { 4.8, { -20, 8, -10 } }, { 4.95, { 30, -6, 6 }, FAST },
  { 5.4, { 16, -14, 18 }, SMOOTH }, { 6.1, { 4, -18, -6 }, SMOOTH }, { 7.0, { 4, -18, -6 } },
  { 7.12, { -10, 10, 2 }, FAST }, { 7.4, { -2, -2, 0 }, SMOOTH }, { 8.3, { -2, -2, 0 } },
  { 8.6, { 4, 14, 8 }, SMOOTH },
  { 9.3, { 66, 66, 4 }, SMOOTH } }

--- Her body: degrees that she leans, and her height.
local body = keys { { 1.9, { 0, 1 } }, { 2.25, { -6, 0.95 }, SMOOTH }, { 2.45, { -6, 0.95 } },
  { 2.6, { 9, 1.06 }, FAST }, { 3.1, { 0, 1 }, SMOOTH }, { 4.0, { 0, 1 } },
  { 4.5, { -10, 0.88 }, SMOOTH }, { 4.8, { -11, 0.87 } }, { 4.95, { 14, 1.12 }, FAST },
  { 5.5, { 0, 1 }, SMOOTH }, { 7.0, { 0, 1.03 } }, { 7.12, { 0, 0.86 }, FAST },
  { 7.4, { 0, 1.02 }, SMOOTH }, { 7.7, { 0, 1 }, SMOOTH }, { 8.3, { 0, 1 } },
  { 9.3, { 3, 0.66 }, SMOOTH } }

--- Where her paw is; on the ground at { 62, -8 }.
local paw = keys { { 1.9, { 62, -8 } }, { 2.2, { 108, -104 }, SMOOTH }, { 2.45, { 104, -112 } },
  { 2.58, { 156, -122 }, FAST }, { 2.75, { 148, -100 }, SMOOTH }, { 3.1, { 62, -8 }, SMOOTH },
  { 4.0, { 62, -8 } }, { 4.45, { 112, -170 }, SMOOTH }, { 4.8, { 104, -180 } },
  { 4.92, { 178, -122 }, FAST }, { 5.15, { 158, -80 }, SMOOTH }, { 5.5, { 62, -8 }, SMOOTH },
  { 8.3, { 62, -8 } }, { 9.1, { 92, -8 }, SMOOTH } }

--- How far her eyes are open, and how high her ears are.
local lids = keys { { 0.3, 1 }, { 0.4, 0 }, { 0.5, 1 }, { 1.1, 1 }, { 1.2, 1.25 }, { 2.2, 1.25 },
  { 2.3, 0.7 }, { 2.6, 1.2 }, { 4.4, 1 }, { 4.6, 0.55 }, { 4.95, 1.3 }, { 6.9, 1.2 }, { 7.05, 0 },
  { 7.5, 0 }, { 7.7, 0.6 }, { 8.1, 0.6 }, { 8.4, 0 } }
local blink = keys { { 10.1, 0 }, { 10.2, 1, FAST } }
local ears = keys { { 1.0, 1 }, { 1.15, 1.14, OVER }, { 2.0, 1.1 }, { 2.3, 0.8 }, { 2.6, 1.12 },
  { 4.4, 1 }, { 4.6, 0.85 }, { 5.0, 1.14, OVER }, { 6.9, 1.1 }, { 7.05, 0.5 }, { 7.5, 1, OVER },
  { 8.3, 1 }, { 9.2, 0.7, SMOOTH }, { 9.95, 0.7 }, { 10.1, 1, OVER } }

--- The moon hangs from far above: degrees of its swing, and its radius.
local swing = keys { { 0, 0 }, { 2.56, 0 }, { 3.2, -9, "outSine" }, { 3.95, 10, SMOOTH },
  { 4.75, -1.4, SMOOTH }, { 4.88, -1.4 }, { 5.6, -42, "outQuad" }, { 5.7, -42 },
  { 6.9, 3, "inQuad" } }
local radius = keys { { 5.6, 128 }, { 6.5, 300, "inQuad" }, { 7.05, 1500, "inQuad" } }

-- ---------------------------------------------------------------- her shape, about her seat

local BACK = path { d = "M-84 4 C-112 -62 -66 -122 -22 -160 C6 -186 46 -176 50 -138 "
  .. "C58 -96 52 -52 54 4 Z" }
local HAUNCH = stroke { d = "M-12 -2 C26 -8 24 -66 -22 -70", width = 5, cap = "round",
  taper = { 0, 40 } }
local LEG = stroke { d = "M30 -2 C34 -30 34 -52 28 -74", width = 4, taper = { 0, 50 } }

local function eye(open)
  if open < 0.05 then return stroke { d = "M-12 -1 Q0 9 12 -1", width = 4, cap = "round" } end
  return path { d = "M-12 2 Q0 -14 12 2 Q0 12 -12 2 Z" }:scale(1, open)
    - ellipse { 2, 1, 2.4, 6 * open }
end

--- Her head. `peek`: how far one eye is open although both are shut.
local function skull(high, open, peek)
  local face = path { d = "M-46 2 C-52 -34 -26 -52 4 -52 C34 -52 54 -32 50 2 "
    .. "C46 32 24 44 4 44 C-20 44 -42 30 -46 2 Z" }
  local ear = path { d = "M-20 6 C-18 -18 -10 -40 2 -54 C14 -38 22 -14 22 8 Z" }:scale(1, high)
  local both = ear:rotate(-24, 0, 6):translate(-26, -34) | ear:rotate(20, 0, 6):translate(32, -36)
  local eyes = eye(open):translate(-12, -6) | eye(math.max(open, peek)):translate(30, -6)
  local nose = path { d = "M6 12 Q12 9 18 12 L12 19 Z" }
    | stroke { d = "M12 18 V25 M3 27 Q8 31 12 25 Q16 31 21 27", width = 2.6, cap = "round" }
  return (face | both) - (eyes | nose)
end

--- A line through points with widths, as her arm and her tail are.
local function limb(points) return stroke { points = points, degree = 3, cap = "round" } end

local function tail(t)
  local points = {}
  for i = 0, 6 do
    local u = i / 6
    local wave = math.sin(3.4 * t - 3.2 * u) * 42 * u
    points[i + 1] = { -58 - 88 * math.sin(2.1 * u) + wave * 0.5, -14 + 116 * u + wave * 0.25,
      30 - 14 * u }
  end
  return limb(points)
end

local TOES = stroke { d = "M3 -5 H16 M4 5 H16", width = 2.6, cap = "round" }:rotate(20)

local function cat(t)
  local hx, hy, degrees = table.unpack(head:at(t))
  local lean, high = table.unpack(body:at(t))
  local px, py = table.unpack(paw:at(t))
  high = high + 0.012 * math.sin(2.6 * t) -- she breathes
  local trunk = (BACK - HAUNCH - LEG) | limb { { 26, -116, 34 },
    { (px + 60) / 2, (py - 92) / 2, 25 }, { px - 12, py - 6, 21 }, { px, py, 33 } }
    - TOES:translate(px, py)
  -- Half as wide as it is low, so that she keeps her weight; her head goes with her neck.
  trunk = trunk:scale(high ^ -0.5, high)
  local x, y, asleep = 22 + hx, -184 * high + hy, motion.span(t, 8.5, 0.8)
  -- As she curls up, a line about her head keeps it free of her back.
  if asleep > 0 then trunk = trunk - ellipse { x, y - 4, 57 * asleep, 55 * asleep } end
  return tail(t) | (trunk | skull(ears:at(t), lids:at(t), blink:at(t)):rotate(degrees)
    :translate(x, y)):rotate(lean)
end

-- ---------------------------------------------------------------- the town

--- A function that returns another random number, 0..1, each time.
local function dice(label)
  local chance, throws = random(label), 0
  return function()
    throws = throws + 1
    return chance(throws)
  end
end

local function roofs()
  local chance, list, cuts = dice "roofs", {}, {}
  list[1] = path {
    d = "M-20 740 V560 L300 488 L500 600 L620 560 L780 640 L930 590 L1300 690 V740 Z" }
  list[2] = rect { 238, 412, 168, 130 } | rect { 226, 400, 192, 26 } -- her chimney
  list[3] = rect { 1000, 548, 46, 90 } | rect { 992, 540, 62, 14 }
  list[4] = stroke { d = "M846 622 V492 M806 514 H886 M816 534 H876 M826 554 H866", width = 5 }
  for row = 0, 5 do -- what is cut out of them: bricks and tiles
    for column = 0, 3 do
      local x = 238 + 48 * column - row % 2 * 24
      cuts[#cuts + 1] = stroke { d = ("M%g %g h%g"):format(math.max(244, x), 440 + 20 * row,
        30 + 8 * chance()), width = 3.5, taper = { 6, 10 } }
    end
  end
  for row = 0, 7 do
    for column = 0, 34 do
      if chance() < 0.22 + 0.05 * row then
        cuts[#cuts + 1] = stroke { d = ("M%g %g q10 13 26 1"):format(38 * column - row % 2 * 19,
          566 + 21 * row), width = 3.2, taper = { 6, 10 } }
      end
    end
  end
  for _, at in ipairs { { 640, 640 }, { 676, 640 }, { 1112, 676 } } do
    cuts[#cuts + 1] = rect { at[1], at[2], 24, 34 }
  end
  return union(list) - union(cuts)
end

local function stars()
  local chance, list = dice "stars", {}
  while #list < 22 do
    local x, y, size = 1280 * chance(), 440 * chance(), 2 + 5 * chance() ^ 3
    local away = ((x - 560) ^ 2 + (y + 900) ^ 2) ^ 0.5 - 1230 -- from the moon's way
    if math.abs(away) > 60 then
      list[#list + 1] = star { centre = { x, y }, points = 4, outer = 2.2 * size,
        inner = 0.5 * size }
    end
  end
  return union(list)
end

local TOWN, STARS = roofs(), stars()

--- Clouds are drawn with a pen, and seen where the moon is.
local function cloud(x, y, size)
  return stroke { d = "M0 0 C26 0 30 -34 64 -32 C84 -70 146 -62 152 -26 C180 -34 200 -14 204 0 "
    .. "M-46 16 H128", width = 7, cap = "round", taper = { 30, 30 } }:scale(size):translate(x, y)
end
local CLOUDS = cloud(980, 168, 1) | cloud(672, 92, 0.62)

--- A bird that comes by day, and sits down on the aerial.
local way = motion.along "M1330 250 C1180 330 1010 330 940 420 C915 450 895 495 866 508"
local function bird(t)
  local u = motion.span(t, 8.0, 1.3, "outSine")
  local x, y = way:at(u)
  local up = u < 1 and 26 * math.sin(25 * t) or 4
  local wing = path { d = ("M-4 -4 Q%g %g %g %g Q14 2 12 0 Z"):format(4, -up, 24, -1.3 * up) }
  local trunk = path {
    d = "M-22 -2 Q-12 -18 6 -10 L30 -2 L10 6 Q-14 10 -22 -2 Z M-18 -8 L-32 -3 L-18 0 Z" }
  return (trunk | (u < 1 and wing or union {})):scale(-1.5, 1.5):translate(x, y - 4)
end

-- ---------------------------------------------------------------- the sound

--- A music box in A minor by night, and in A major by day; what she does is heard with it.
local notes = { { 2.56, score.thump(150), 0.3 }, { 2.6, score.wind(0.07, 1.3, 0.4), 0.3 },
  { 4.88, score.thump(110), 0.42 }, { 4.9, score.wind(0.1, 0.8, 0.2), 0.3 },
  { 5.6, score.wind(0.1, 1.6, 0.88), 0.6 }, { 7.05, score.thump(70), 0.48 },
  { 10.15, score.bell("A3", 1.6), 0.3 }, { 10.3, score.bell("E5", 1.6), 0.18 } }
for i, tone in ipairs { "A4", "E5", "C5", "E5", "A4", "E5", "B4", "E5", "A4", "E5", "C5", "E5" } do
  notes[#notes + 1] = { 0.42 * i - 0.2, score.bell(tone, 1.6), 0.135 }
end
for i, tone in ipairs { "A3", "E4", "A4", "C#5", "E5", "A5" } do
  notes[#notes + 1] = { 7.05 + 0.06 * i, score.bell(tone, 1.6), 0.21 }
end
for i = 1, 5 do
  notes[#notes + 1] = { 8.05 + 0.21 * i + i % 2 * 0.05,
    score.slide(2400 + 200 * (i % 3), 3000, 0.09), 0.075 }
end

return film { title = "The cat and the moon", size = { 1280, 720 }, fps = 24, frames = 264,
  poster = "6.7s", background = "#000", sound = score.play(11, notes),
  frame = function(f)
    local t = f:twos()
    local moon = circle { 560, 330, radius:at(t) }:rotate(swing:at(t), 560, -900)
    local sky = STARS - moon | CLOUDS:translate(90 - 12 * t, 0) & moon
    local picture = moon ~ (TOWN | bird(t) | cat(t):scale(1.14):translate(322, 402) | sky)
    return picture:paint("#fff")
  end }
