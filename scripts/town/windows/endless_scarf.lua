-- A grandmother knits a scarf that leaves the window, comes in again, and carries her.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").harvest
local wash, form, line = gouache.wash, gouache.form, gouache.line

local SKIN = wash(160, 0, 300, 0, "#ffe0b0", "#f0b884", "#cf8c5c")
local DRESS = wash(110, 0, 330, 0, "#c06a38", mood.near, mood.ground)
local DOWN = "M232 404 C214 452 160 474 118 452 C76 430 40 470 -60 540"
local SEAT = "M520 40 C410 400 330 500 225 500 C120 500 40 400 -70 40"

local room = union {
  gouache.wall(110, 190, 520, mood.light, mood.sky[2], mood.sky[3], mood.far),
  form("#c9792f", "M0 548 H450 V600 H0 Z"),
  form("#b56a2e", "M330 470 C330 452 440 452 440 470 L428 560 H342 Z"),
  line("M336 490 H436 M338 514 H432 M340 538 H430", 5, "#8f4c22"),
  circle { 362, 452, 26, fill = "#c8553d" }, circle { 408, 452, 26, fill = mood.light },
}

--- A part of the scarf, whose stripes go along it: a function of the drawing.
local function knitted(d, width)
  local way = motion.along(d)
  local band = stroke { d = d, width = width, fill = wash(60, 100, 300, 560, "#3b9499",
    mood.accent) }
  local function edge(length, side)
    local x, y, degrees = way:at(length / way.length)
    local turn = math.rad(degrees)
    return { x - side * width / 2 * math.sin(turn), y + side * width / 2 * math.cos(turn) }
  end
  return function(n)
    local scarf = band
    for from = 90 * n / 12 - 90, way.length - 18, 90 do
      scarf = scarf | polygon { edge(from, -1), edge(from + 18, -1), edge(from + 18, 1),
        edge(from, 1), fill = "#f3dcaa" }
    end
    return scarf
  end
end
local down, seat = knitted(DOWN, 62), knitted(SEAT, 74)

local body = gouache.edged(form(DRESS, "M132 506 C104 440 120 360 160 330 "
  .. "C184 312 266 312 290 330 C330 360 346 440 318 506 C280 526 170 526 132 506 Z"), "#ffd694",
  "#5a2a18", 6, 4)
local legs = line("M190 500 V544 M260 500 V544", 26, "#d9a066")
local collar = form(mood.light, "M176 324 C190 346 212 344 225 332 C238 344 260 346 274 324 "
  .. "L262 312 H188 Z")

local bun = circle { 0, -74, 27, fill = "#e6cfa4" } | form("#e6cfa4", "M-58 10 "
  .. "C-66 -46 -36 -72 0 -72 C36 -72 66 -46 58 10 C54 40 -54 40 -58 10 Z")
local fringe = form(wash(-50, 0, 50, 0, "#fffaf0", "#dcc197"), "M-54 2 C-62 -46 -34 -70 0 -70 "
  .. "C34 -70 62 -46 54 2 C48 -24 26 -34 0 -46 C-26 -34 -48 -24 -54 2 Z")
local glasses = circle { -20, 6, 18 }:stroke { width = 4, fill = "#6b3a22" }
  | circle { 20, 6, 18 }:stroke { width = 4, fill = "#6b3a22" }

local function shoe(x, y, flip)
  return form("#c8553d", "M-16 -12 C-6 -18 10 -18 14 -8 C28 -4 34 4 30 14 H-16 "
    .. "C-20 4 -20 -6 -16 -12 Z")
    :scale(flip, 1):translate(x, y)
end

local function hand(x, y, side, click)
  local sleeve = gouache.arm { from = { 225 + side * 74, 362 }, to = { x, y }, parts = { 62, 74 },
    side = side, widths = { 54, 48, 30 }, fill = DRESS }
  local needle = line(("M%g %g L%g %g"):format(side * 34, 22 + click, -side * 44, -30 - click), 6,
    side < 0 and mood.light or "#f0d49a")
  return union { sleeve:translate(-3 * side, 4):paint("#5a2a18"), sleeve, needle:translate(x, y),
    circle { 0, 0, 19 }:translate(x, y):paint(SKIN) }
end

return window.film { title = "The endless scarf", by = "ga", seconds = 2, drawing = function(_,
  number)
  local n = number // 2
  local sway = math.floor(9 * math.sin(math.pi * n / 6) + 0.5)
  local click = n % 2 == 0 and 7 or -5
  local glance = n >= 8 and n <= 10
  local kick = n < 6 and 5 or -5
  return { room, line(("M%g 436 C330 380 290 470 %g 412"):format(362, 262 + sway), 3.4, "#c8553d"),
    union { seat(n), legs, shoe(180, 546 - kick, -1), shoe(270, 546 + kick, 1), body,
      collar,
      form(wash(0, 480, 0, 530, "#2f858b", "#175860"), "M112 478 C140 508 180 516 225 516 "
        .. "C270 516 310 508 338 478 C332 520 280 538 225 538 C170 538 118 520 112 478 Z"),
      gouache.head { x = 225, y = 262 + (n % 2) * 2, face = { glance and 4 or -3,
        glance and 0 or 9 },
        skin = SKIN, behind = bun, front = fringe, eyes = glance and "open" or "shut",
        brows = "#dcc197", brow = glance and 8 or 2, spread = 20, mouth = "M-12 32 Q0 44 12 32" },
      glasses:translate(225 + (glance and 2 or -3), 262 + n % 2 * 2 + (glance and 10 or 12)),
      down(n), hand(188, 398 + click, -1, click), hand(262, 398 - click, 1, click) }
      :translate(sway, 0) }
end }
