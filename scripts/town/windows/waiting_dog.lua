-- The lamplighter's kitchen while he is out: his dog knows the steps that go past the door.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").candle
local wash, form, line = gouache.wash, gouache.form, gouache.line

local FUR = wash(150, 0, 370, 0, "#6b3418", "#8a4722", "#c9773a")
local EDGE, DEEP, CREAM = "#ffc98a", "#45200f", wash(90, 0, 250, 0, "#d9a878", "#f6dcae")

local hat = gouache.track({ 3, -2, "linear" }, { 16, 164, "linear" })
local head = gouache.track({ 0, { 0, 6 } }, { 2, { -4, 2 } }, { 3, { -6, -10 } }, { 6, { -8,
  -12 } },
  { 10, { 2, -12 } }, { 14, { 10, -12 } }, { 17, { 6, -4 } }, { 19, { 0, 18 } }, { 22, { 0, 18 } },
  { 24, { 0, 6 } })

local room = union {
  gouache.wall(392, 430, 520, "#ffdf9a", "#e69a48", "#a8551f", "#6b3418"),
  form(wash(0, 0, 450, 0, "#4d2413", "#a35a2a"), "M0 540 H450 V600 H0 Z"),
  form("#43200f", "M10 142 H148 V548 H10 Z"), form(wash(17, 0, 140, 0, "#6b3418", "#8a4722"),
    "M17 150 H140 V540 H17 Z"),
  line("M58 290 V540 M100 290 V540", 3, "#54270f"), circle { 122, 440, 8, fill = "#e9b064" },
  line("M286 132 V160", 5, "#54270f"), form("#54270f", "M268 172 L276 160 H296 L304 172 V178 "
    .. "H268 Z"),
  form("#e9b064", "M272 178 H300 L296 226 H276 Z"), form("#54270f", "M270 226 H302 V236 H270 Z"),
}

local stove = union {
  form("#54270f", "M398 130 H424 V380 H398 Z"),
  gouache.edged(form(wash(330, 0, 450, 0, "#43200f", "#5a2a15"), "M340 384 H460 V560 H352 "
    .. "C344 540 340 520 340 500 Z"), "#8a4722", "#341409", 4, 4),
  path { d = "M368 440 C368 424 440 424 440 440 V508 H368 Z", fill = radial { centre = { 406, 500 },
    radius = 80, "#fff3c0", "#ffb84a", mood.accent } },
  line("M386 436 V506 M404 434 V506 M422 436 V506", 5, "#43200f"),
  form(wash(340, 0, 450, 0, "#8a4420", "#d9824a"), "M350 330 H440 C442 366 430 382 420 384 H370 "
    .. "C360 382 348 366 350 330 Z"),
}
local lid = form("#b5642a", "M346 332 C350 316 376 312 390 312 C390 300 402 300 402 312 "
  .. "C416 312 440 316 444 332 Z")
local boots = form(wash(330, 0, 440, 0, "#7a4022", "#b56a3c"), "M362 582 V512 H390 V546 "
  .. "C402 550 410 562 410 582 Z") | form(wash(330, 0, 440, 0, "#7a4022", "#b56a3c"), "M392 588 "
  .. "V520 H426 V552 C440 556 446 568 446 588 Z")

local wisp = form(nil, "M0 0 C-16 -14 16 -26 2 -46 C-8 -60 0 -70 4 -78 C2 -66 14 -58 14 -44 "
  .. "C18 -26 -6 -16 8 0 Z")

local function steam(x, y, phase)
  phase = phase % 8
  return wisp:translate(x, y - 8 * phase):paint(rgb("#fff0d0",
    0.5 * math.sin(math.pi * (phase + 1) / 9)))
end

local pane = path { d = "M40 176 H118 V268 H40 Z", fill = mood.light }

--- He goes past behind the glass of the door, and bobs at each of his steps.
local function passing(n)
  local x, y = hat:at(n), n % 4 < 2 and 0 or 6
  local man = form(nil, "M-34 60 C-34 34 -22 22 -20 10 L-30 10 C-36 2 -30 -4 -22 -4 L-20 -44 "
    .. "H20 L22 -4 C30 -4 36 2 30 10 L20 10 C22 22 34 34 34 60 Z")
  return union { form("#54270f", "M34 170 H124 V274 H34 Z"), pane,
    clip(man:translate(x, 226 + y):paint("#8a4722"), pane), line("M79 176 V268 M40 222 H118", 4,
      "#54270f") }
end

local body = gouache.edged(form(FUR, "M176 330 C156 400 184 470 184 590 H372 "
  .. "C396 540 388 470 340 420 C308 388 280 372 266 320 Z"), DEEP, EDGE, 4, 3)
local chest = form(CREAM, "M174 352 C164 400 178 440 196 470 C214 440 224 400 222 372 Z")
local legs = line("M206 440 C202 490 208 530 206 572", 40, "#7a3f1e") | ellipse { 198, 580, 32, 14,
  fill = "#e9c08c" } | line("M372 560 C336 560 300 540 306 500 C310 474 330 462 346 462", 5, DEEP)
  | ellipse { 300, 582, 40, 14, fill = "#c98f5c" }

local ears = {
  down = form(nil, "M14 -44 C50 -50 62 -10 52 38 C44 62 22 56 18 32 C12 4 0 -20 14 -44 Z"),
  up = form(nil, "M4 -40 C10 -72 40 -88 74 -74 C76 -44 62 -22 44 -6 C24 -8 2 -16 4 -40 Z"),
}

local function dog(dx, dy, ear, mood_of)
  local x, y = 206 + dx, 306 + dy
  local function put(object, u) return object:translate(x + (u or 0) * dx, y + (u or 0) * dy) end
  local skull = form(nil, "M-58 -2 C-62 -40 -30 -60 2 -60 C40 -60 62 -32 60 6 C58 42 36 62 4 62 "
    .. "C-34 62 -56 36 -58 -2 Z")
  return union { gouache.edged(put(skull):paint(FUR), DEEP, EDGE, 4, 3),
    mood_of == "glad" and put(form("#d9583a", "M-74 38 C-78 72 -46 74 -44 42 Z"), 0.5) or union {},
    put(form(nil, "M-20 -26 C-40 -10 -92 -4 -100 18 C-104 44 -70 52 -28 46 C-6 38 -6 -2 -20 -26 "
      .. "Z"), 0.5)
      :paint(CREAM),
    put(union { ellipse { -92, 12, 15, 12, fill = "#3a1a12" },
      mood_of == "sad" and line("M-84 44 Q-62 34 -40 44", 4, "#7a3f1e")
        or line("M-86 36 Q-62 50 -36 34", 4, "#7a3f1e"),
      mood_of == "sad" and line("M-34 -14 q9 8 18 2", 4, "#3a1a12")
        or ellipse { -26, -14, 6, 9, fill = "#3a1a12" },
      line(mood_of == "sad" and "M-40 -26 Q-26 -38 -12 -32" or "M-40 -36 Q-26 -46 -12 -34", 5,
        "#45200f") },
      0.6),
    put(ears[ear]):translate(3, 5):paint(DEEP), put(ears[ear]):paint("#5a2a15") }
end

local function tail(wag)
  return stroke { degree = 3, cap = "round", fill = "#c9773a", points = { { 350, 566, 34 },
    { 400, 570, 32 }, { 424 + 6 * wag, 530 - 10 * wag, 28 }, { 414 + 22 * wag, 480 - 30 * wag,
      14 } } }
end

return window.film { title = "Waiting", by = "ga", seconds = 4, drawing = function(_, number)
  local n = number // 2
  local dx, dy = table.unpack(head:at(n))
  local feeling = gouache.exposed(n, { 4, "open" }, { 13, "glad" }, { 1, "open" }, { 5, "sad" },
    { 1, "open" })
  local wag = gouache.exposed(n, { 4, -0.8 }, { 1, 0 }, { 1, 1 }, { 2, -0.4 }, { 1, 1 }, { 1,
    -0.6 },
    { 1, 1 }, { 1, -0.6 }, { 1, 1 }, { 1, -0.6 }, { 1, 1 }, { 1, -0.4 }, { 1, 0.4 }, { 7, -0.8 })
  local rattle = (n == 2 or n == 20 or n == 22) and 5 or 0
  return { room, passing(n), steam(378, 318, n), steam(412, 318, n + 4), stove,
    lid:translate(0, -rattle), boots:translate(0, -18), steam(376, 494, n + 2), steam(414, 502,
      n + 6),
    union { tail(wag), body, chest, legs, dog(dx, dy, n >= 3 and n <= 16 and "up" or "down",
      feeling),
      form(mood.accent, "M176 372 C200 392 240 388 268 360 L262 344 C236 366 204 370 180 354 Z") }
      :scale(0.9, 0.9, 150, 590) }
end }
