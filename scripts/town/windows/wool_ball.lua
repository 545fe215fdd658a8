-- The grandson at the other end of the endless scarf: he rolls the wool up as fast as she knits,
-- until the ball is so big that it rolls away; he has begun another.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").harvest
local wash, form, line = gouache.wash, gouache.form, gouache.line

local SKIN = wash(230, 0, 370, 0, "#ffe0b0", "#f0b884", "#cf8c5c")
local SHIRT = wash(210, 0, 420, 0, "#c8553d", "#a03a2a", "#6f2820")
local WOOL = wash(50, 330, 300, 600, "#3b9499", mood.accent, "#154a52")

local room = union {
  gouache.wall(110, 190, 520, mood.light, mood.sky[2], mood.sky[3], mood.far),
  form("#c9792f", "M0 520 H450 V600 H0 Z"), form("#b56a2e", "M330 140 H420 V250 H330 Z"),
  form("#f3d9a0", "M338 148 H412 V242 H338 Z"),
  line("M356 226 L372 176 L388 208 L398 190", 5, "#a9572b"), circle { 360, 170, 8,
    fill = "#c8553d" },
}

--- The scarf from above, whose lowest row is undone from the left and from the right in turn; its
--- yarn ends at to_x, to_y.
local function scarf(n, to_x, to_y)
  local stripes = rect { 46, -10, 96, 356, fill = wash(46, 0, 142, 0, "#3b9499", mood.accent) }
  for i = -1, 4 do
    stripes = stripes | rect { 46, 90 * i + 15 * (n % 6), 96, 18, fill = "#f3dcaa" }
  end
  local cut = path { d = "M40 -20 H150 V330 L118 340 L94 330 L70 340 L40 330 Z" }
  local x = ({ 56, 84, 112, 132, 104, 76 })[n % 6 + 1]
  return clip(stripes, cut)
    | line(("M%g 334 C%g 360 %g 350 %g 372 C%g 400 %g %g %g %g"):format(x, x - 16, x + 30,
      x + 10, x - 10, to_x - 30, to_y - 30, to_x, to_y), 5, mood.accent)
end

local turns = union {}
for i = 0, 2 do
  turns = turns | line("M-112 -30 C-60 -10 60 -10 112 -30 M-98 40 C-40 16 50 20 100 44", 4,
    "#8fd0c8")
    :rotate(60 * i)
end

--- The ball in twelve drawings: its radius, and how far it has rolled away.
local BALL = { [0] = { 54, 0 }, { 63, 0 }, { 72, 0 }, { 81, 0 }, { 90, 0 }, { 99, 0 }, { 107, 0 },
  { 113, 0 }, { 116, 6 }, { 116, 70 }, { 116, 230 }, { 44, 0 } }

local hair = form("#8a3d1c", "M-55 6 C-70 -40 -44 -60 -30 -58 C-30 -84 0 -78 4 -66 "
  .. "C20 -86 40 -66 34 -58 C62 -54 66 -20 55 6 C46 -14 40 -26 26 -34 C6 -22 -30 -24 -44 -30 "
  .. "C-50 -20 -52 -8 -55 6 Z")
local legs = line("M340 540 C320 480 270 520 276 576 M372 540 C400 500 420 540 410 580", 44,
  "#5f2f1b")

return window.film { title = "The ball of wool", by = "ga", seconds = 2, drawing = function(_,
  number)
  local n = (number // 2 + 6) % 12
  local bob = n % 3 == 0 and 4 or 0
  local lost = n > 7 and n < 11
  local radius, rolled = BALL[n][1], BALL[n][2]
  local x, y = 282 - radius - rolled, 588 - radius
  local ball = circle { x, y, radius }
  local function arm(from, a, side)
    local r = radius - 2
    local to = { 282 - radius + r * math.cos(a), y + r * math.sin(a) }
    local sleeve = gouache.arm { from = from, to = to, parts = { 74, 74 }, side = side,
      widths = { 50, 42, 30 }, fill = SHIRT }
    return sleeve:translate(4, 4):paint("#5f2019") | sleeve
      | circle { 0, 0, 18 }:translate(to[1], to[2]):paint(SKIN)
  end
  local reach = n % 6 / 6
  return { room, scarf(n, x - 0.1 * radius, y - 0.7 * radius), legs,
    gouache.edged(form(SHIRT, "M272 560 C262 480 262 420 296 388 C320 372 360 374 380 396 "
      .. "C410 430 404 500 396 560 Z"), "#f0a070", "#5f2019", 5, 3),
    arm({ 372, 424 }, -0.9 + 0.8 * ((reach + 0.5) % 1), 1), ball:paint(WOOL),
    clip(turns:scale(radius / 112):rotate(n % 2 * 30 - rolled / 2):translate(x, y), ball),
    gouache.head { x = 312, y = 320 + bob, skin = SKIN, face = { -18, lost and 2 or 8 },
      front = hair,
      eyes = n == 11 and "happy" or "open", brow = lost and 8 or 0,
      mouth = lost and "M-8 36 Q0 24 8 36 Q0 52 -8 36" or "M-12 34 Q0 44 12 34" },
    arm({ 292, 424 }, -1.3 + 0.9 * reach, 1) }
end }
