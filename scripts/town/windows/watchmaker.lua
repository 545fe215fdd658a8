-- The watchmaker: nine pendulums, and he looks up at the one moment when all of them agree.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").harvest
local wash, form, line = gouache.wash, gouache.form, gouache.line

local SKIN = wash(160, 0, 300, 0, "#ffe0b0", "#f0b884", "#c9855a")
local SHIRT = wash(90, 0, 360, 0, "#cf7a42", mood.near, mood.ground)
local WOOD = wash(0, 130, 0, 460, "#8a4826", "#5f2f1b")

--- Where a clock hangs, its swings in a loop, and the length of its pendulum.
local clocks = { { 62, 160, 1, 74 }, { 144, 166, 3, 58 }, { 225, 158, 2, 66 }, { 306, 166, 4, 58 },
  { 388, 160, 1, 74 }, { 54, 344, 2, 60 }, { 124, 330, 4, 46 }, { 330, 330, 3, 46 },
  { 398, 344, 2, 60 } }

local room = gouache.wall(100, 440, 560, mood.light, mood.sky[2], mood.sky[3], "#c9752f", mood.near)
for i, clock in ipairs(clocks) do
  local x, y = clock[1], clock[2]
  room = room | (i % 2 == 1 and form(WOOD, "M%g %g L%g %g L%g %g V%g H%g Z", x - 33, y - 12, x,
    y - 42,
      x + 33, y - 12, y + 36, x - 33)
    or form(WOOD, "M%g %g C%g %g %g %g %g %g V%g H%g Z", x - 30, y, x - 30, y - 44, x + 30, y - 44,
      x + 30,
      y, y + 34, x - 30))
    | circle { x, y, 22, fill = mood.light }
    | line(("M%g %g V%g M%g %g l%g %g"):format(x, y, y - 16, x, y, 10 - i, i - 4), 3.4, "#5f2f1b")
end

--- Drawing n of all pendulums: each is at the end of its swing at 0.
local function pendulums(n)
  local all = union {}
  for _, clock in ipairs(clocks) do
    local a = -0.42 * math.cos(2 * math.pi * clock[3] * n / 24)
    local x, y = clock[1], clock[2] + 36
    local bx, by = x + clock[4] * math.sin(a), y + clock[4] * math.cos(a)
    all = all | polygon { { x - 2, y }, { x + 2, y }, { bx + 2, by }, { bx - 2, by },
      fill = "#7a3b22" }
      | circle { 0, 0, 13, fill = "#7a3b22" }:translate(bx, by)
      | circle { -3, -3, 8, fill = "#f7cf78" }:translate(bx, by)
  end
  return all
end

local bench = union {
  form(wash(0, 0, 450, 0, "#b9662f", mood.ground), "M0 526 H450 V600 H0 Z"),
  form("#e0964e", "M0 520 H450 V530 H0 Z"),
  line("M44 522 L30 456 L70 404", 8, "#5f2f1b"),
  form(nil, "M46 384 L100 400 C106 424 96 438 84 444 L40 420 C34 404 38 392 46 384 Z")
    :paint(wash(40, 390, 100, 430, "#3b9499", mood.accent)),
  circle { 350, 516, 17, fill = "#cf8f38" }, circle { 350, 516, 12, fill = mood.light },
  circle { 390, 519, 12, fill = "#cf8f38" },
}

local body = gouache.edged(form(SHIRT, "M110 600 C104 500 112 446 168 428 "
  .. "C190 420 260 420 282 428 C338 446 346 500 340 600 Z"), "#ffd08a", "#4d2413", 6, 3)
  | form(wash(150, 0, 300, 0, "#3b9499", mood.accent, "#15484f"), "M170 428 "
  .. "C176 470 200 500 225 520 C250 500 274 470 280 428 C300 440 306 480 304 600 H146 "
  .. "C144 480 150 440 170 428 Z")
  | form(mood.light, "M196 418 L225 450 L254 418 L262 436 L232 462 H218 L188 436 Z")

local wisps = form("#fff3cf", "M-48 -8 C-78 -24 -78 14 -62 16 C-72 30 -54 42 -44 30 Z")
  | form("#cfa574", "M48 -8 C78 -24 78 14 62 16 C72 30 54 42 44 30 Z")
local moustache = form("#fff3cf", "M0 22 C14 14 34 22 42 40 C24 46 8 42 0 32 "
  .. "C-8 42 -24 46 -42 40 C-34 22 -14 14 0 22 Z")
local loupe = form("#5f2f1b", "M6 -14 H34 L30 14 H10 Z") | ellipse { 20, 12, 10, 5,
  fill = "#f7cf78" }

local function hands(n)
  local pick = gouache.exposed(n, { 4, 0 }, { 5, 6 }, { 3, 0 }, { 5, 6 }, { 3, 0 }, { 4, 6 })
  local function sleeve(x, to, y, side)
    local arm = gouache.arm { from = { x, 470 }, to = { to, y }, parts = { 66, 66 }, side = side,
      widths = { 60, 54, 34 }, fill = SHIRT }
    return arm:translate(-3 * side, -3):paint("#5f2f1b") | arm
      | circle { 0, 0, 18 }:translate(to, y):paint(SKIN)
  end
  return union { circle { 222, 522, 20, fill = "#cf8f38" }, circle { 222, 522, 14,
    fill = mood.light },
    sleeve(136, 188, 522, -1), sleeve(314, 262 - pick, 510 - pick, 1),
    line(("M%g %g L%g 522"):format(254 - pick, 510 - pick, 228), 4, "#5f2f1b") }
end

return window.film { title = "The watchmaker", by = "ga", seconds = 4, drawing = function(_, number)
  local n = number // 2
  local up = gouache.track({ 0, 1 }, { 2, 1 }, { 4, 0 }, { 21, 0 }, { 22, -0.2 }, { 24, 1,
    "outQuad" })
    :at(n)
  return { room, pendulums(n), body,
    gouache.head { x = 225, y = 362 - 8 * up, face = { -3 + 6 * up, 10 - 18 * up }, skin = SKIN,
      behind = wisps,
      eyes = up > 0.5 and "open" or { "shut", "open" }, brow = 9 * math.max(0,
        up),
      brows = "#fff3cf", nose = "#d98a5c", mouth = "M-6 44 Q0 48 6 44" },
    (loupe | moustache):translate(222 + 6 * up, 372 - 26 * up), bench, hands(n) }
end }
