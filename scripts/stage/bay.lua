--- A day at the shore: a meadow at noon, a storm, and a beach in the evening; a child with a kite,
-- which is asleep later; a boat, a ball, a parasol.
local moods = require "stage.moods"
local noon, storm, harvest = moods.noon, moods.storm, moods.harvest
local W, H = 640, 360
local SKIN, HAIR, STRAW, RED = "#f0b48c", "#5b3420", "#f3cf7a", "#e8553d"

local function line(d, width, tint) -- with round ends
  return stroke { d = d, width = width, cap = "round", join = "round", fill = tint }
end

--- The upper edge of a band, which is wavy and drifts by `at`.
local function edge(y, height, step, at)
  local points = {}
  for x = -200, W + 200, 20 do
    points[#points + 1] = { x, y + height * math.sin((x + at) / step)
      + height / 3 * math.sin((x - at) / step * 2.7) }
  end
  return points
end

--- A band of the picture, down to below its lower edge, and a light line on it.
local function band(y, height, step, at, tint, crest)
  local points = edge(y, height, step, at)
  local top = crest and stroke { points = points, width = 2.5, fill = crest }
  points[#points + 1], points[#points + 2] = { W + 200, H + 60 }, { -200, H + 60 }
  points.fill = tint
  return union { polygon(points), top or union {} }
end

local function sky(mood)
  return rect { 0, 0, W, H, fill = linear { from = { 0, 0 }, to = { 0, 260 },
    table.unpack(mood.sky) } }
end

local function striped(shape, x, step, width, tint)
  local bars = {}
  for i = 0, 9 do bars[i + 1] = rect { x, step[1] + step[2] * i, 200, width, fill = tint } end
  return shape | clip(union(bars), shape)
end

local bay = {}

--- The child from behind; its hand, which holds the string, is at 264, 142.
local shirt = path { fill = "#fffbe8",
  d = "M164 206C176 196 206 196 218 206L214 280H167C164 254 160 226 164 206Z" }
bay.child = union {
  line("M178 296L174 348", 17, SKIN), line("M204 296L209 348", 17, SKIN),
  line("M164 358H178M204 358H220", 15, "#9c2f24"),
  path { d = "M166 270H215L221 312H194L190 296L186 312H159Z", fill = noon.ink },
  striped(shirt, 100, { 208, 14 }, 6, RED),
  line("M168 216L150 246L164 266", 13, SKIN), line("M212 214L244 188L263 146", 13, SKIN),
  line("M168 214L160 230M211 214L226 202", 18, "#fffbe8"),
  rect { 182, 186, 17, 18, fill = SKIN }, circle { 190, 172, 27, fill = HAIR },
  line("M175 188Q166 210 172 232M206 188Q216 208 209 232", 9, HAIR),
  line("M168 231H175M205 231H213", 7, RED),
  ellipse { 190, 163, 48, 10, fill = "#dcb04f" },
  path { d = "M162 162C162 118 218 118 218 162C206 170 174 170 162 162Z", fill = STRAW },
  path { d = "M161 158Q190 170 219 158V150Q190 161 161 150Z", fill = RED } }

bay.kite = polygon { { 0, -58 }, { 40, 0 }, { 0, 68 }, { -40, 0 }, fill = noon.accent }
  | polygon { { 0, -58 }, { 40, 0 }, { 0, 0 }, fill = "#ffb24a" }
  | polygon { { 0, 0 }, { 0, 68 }, { -40, 0 }, fill = "#ffb24a" }
  | line("M0 68Q-16 88 0 104T-6 142", 1.6, noon.ink)
  | line("M-14 84L0 92M-10 118L6 112M-14 142L2 140", 7, "#fffbe8")

local clouds = {}
for i, at in ipairs { { 90, 70, 1 }, { 560, 128, 0.7 }, { 300, 40, 0.5 } } do
  clouds[i] = path { d = "M-70 20C-80 -6 -44 -16 -34 -8C-26 -36 18 -36 24 -12C44 -22 76 -8 68 20Z",
    fill = "#fffbe8" }:scale(at[3]):translate(at[1], at[2])
end
bay.meadow = union { sky(noon), union(clouds), rect { 0, 214, W, 60, fill = "#2f8fbd" },
  band(238, 12, 90, 0, noon.far), band(276, 14, 70, 300, noon.near) }

--- Grass in front, which leans with the wind.
function bay.grass(time)
  local blades = {}
  for i = 1, 60 do
    local x, tall = 11 * i - 10 + 8 * random "x"(i), 22 + 26 * random "tall"(i)
    local lean = 10 + 6 * math.sin(3 * time - x / 60)
    blades[i] = line(("M%g 366Q%g %g %g %g"):format(x, x, 360 - tall / 2, x + lean, 360 - tall), 4,
      i % 3 == 0 and "#2f7350" or "#57a06b")
  end
  return union(blades)
end

bay.boat = line("M0 6L2 -150", 5, storm.ink)
  | path { d = "M6 -146C54 -104 66 -60 64 -14H6Z", fill = storm.light }
  | path { d = "M-4 -128C-14 -80 -34 -44 -62 -12H-4Z", fill = "#b9c4b4" }
  | path { d = "M2 -150L28 -156L22 -148L30 -142L2 -144Z", fill = RED }
  | path { d = "M-84 -4C-40 6 40 6 88 -10C78 20 60 34 40 36H-50C-70 32 -80 14 -84 -4Z",
    fill = storm.accent }
  | path { d = "M-84 -4C-40 6 40 6 88 -10L84 0C40 14 -40 14 -80 6Z", fill = storm.light }

--- The rough sea behind the boat, and before it; rain falls on all of it.
function bay.waves(time)
  local rain = {}
  for i = 1, 70 do
    local x = (900 * random "rain"(i) - 260 * time) % 760 - 40
    local y = (500 * random "drop"(i) + 700 * time) % 420 - 40
    rain[i] = line(("M%g %gl-7 19"):format(x, y), 1.2, rgb(storm.light, 0.35))
  end
  return union { sky(storm), band(212, 10, 44, 30 * time, storm.far, "#8d9b98") },
    union { band(254, 14, 58, -60 * time, storm.near, "#8d9b98"),
      band(308, 14, 70, 90 * time, storm.ground, storm.far), union(rain) }
end

--- The beach in the evening, with the sea drifting.
function bay.beach(time)
  return union { sky(harvest), circle { 150, 150, 44, fill = harvest.light },
    band(176, 3, 40, 20 * time, harvest.accent, "#5f9d97"),
    band(228, 6, 120, 100, "#f0d29a", harvest.light) }
end

local ball = circle { 0, 0, 24, fill = RED }
bay.ball = ball | clip(rect { -9, -24, 18, 48, fill = "#fffbe8" }, ball)

bay.parasol = line("M604 318L566 96", 6, harvest.ground)
  | path { d = "M442 152C460 92 520 62 560 62C612 60 664 84 690 128Z", fill = "#fffbe8" }
  | path { d = "M442 152C460 92 520 62 560 62C520 84 500 112 496 144ZM552 138C546 104 552 78 560 62"
    .. "C588 74 606 100 614 133ZM660 130C640 96 602 70 560 62C612 60 664 84 690 128Z", fill = RED }

--- The child asleep on a towel; `start` is how much it starts up, 0 to 1.
function bay.sleeper(start)
  local up = 16 * start
  local body = path { d = "M476 296C480 272 516 266 548 282V304H476Z", fill = "#fffbe8" }
  return union {
    path { d = "M404 308H614L600 318H390Z", fill = harvest.accent },
    line(("M482 296L448 %gL424 %g"):format(272 - up, 302 - 2 * up), 16, SKIN),
    line(("M424 %gL416 %g"):format(300 - 2 * up, 292 - 2 * up), 13, "#9c2f24"),
    path { d = "M470 300C470 284 480 278 494 276L500 306H474Z", fill = noon.ink },
    clip(body | striped(body:rotate(90, 512, 288), 420, { 240, 14 }, 6, RED)
      :rotate(-90, 512, 288), body),
    circle { 570, 286 - up / 2, 21, fill = SKIN }, path { fill = HAIR,
      d = "M556 300C570 310 592 304 592 284L598 304H560Z" },
    circle { 564, 276 - up / 2, 2.2 * start, fill = HAIR },
    circle { 577, 278 - up / 2, 2.2 * start, fill = HAIR },
    circle { 569, 287 - up / 2, 3.2 * start, fill = "#8a2f24" },
    line(("M540 288L528 %gL512 %g"):format(300 - 2 * up, 284 - 2 * up), 11, SKIN),
    union { ellipse { 562, 276, 34, 8, fill = "#dcb04f" },
      path { d = "M540 274C540 246 582 246 582 274Z", fill = STRAW },
      path { d = "M540 275H582V268H540Z", fill = RED } }
      :rotate(-24 - 30 * start, 562, 276):translate(10 * start, -50 * start) }
end

return bay
