-- The bakery: he kneads, and bows to his dough just when the loaves come by.
local baker = require "town.baker"
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").candle
local wash, form, line = gouache.wash, gouache.form, gouache.line

local loaf = baker.loaf

local room = union {
  gouache.wall(800, 300, 720, "#ffd890", "#e08f3e", "#9a4e22", "#5a2a15"),
  form("#7a3a1a", "M60 176 H300 V190 H60 Z"), form("#7a3a1a", "M60 290 H260 V304 H60 Z"),
  loaf:scale(0.8):translate(112, 158), loaf:scale(0.8):translate(204, 158),
  form("#8d4a22", "M110 290 C104 250 112 232 134 232 C156 232 164 250 158 290 Z"),
  form("#a85c2c", "M186 290 C176 256 196 236 214 236 C234 236 246 258 238 290 Z"),
  form(wash(690, 0, 930, 0, "#8d4522", "#6b3418"), "M670 420 V210 C690 120 910 120 930 210 V420 Z"),
  form("#4d2413", "M716 400 C706 250 740 206 800 206 C862 206 896 250 886 400 Z"),
  path { d = "M730 400 C722 264 752 222 800 222 C850 222 880 264 872 400 Z", fill = radial {
    centre = { 800, 390 }, radius = 170, "#fff3c0", "#ffb84a", mood.accent, "#8a3217" } },
}

local counter = union {
  form(wash(150, 0, 900, 0, "#8d4a26", "#d98f4a"), "M100 400 H860 L880 426 H80 Z"),
  form(wash(80, 0, 880, 0, "#4d2413", "#7a3a1a"), "M0 426 H960 V540 H0 Z"),
  loaf:translate(110, 474), loaf:translate(216, 474), loaf:translate(163, 440),
  form("#a85c2c", "M330 440 H610 L590 520 H350 Z"),
  line("M340 462 H600 M344 482 H596", 5, "#7a3a1a"),
  form(wash(0, 390, 0, 450, "#f2b35c", "#a3521d"), "M360 450 C350 420 380 414 392 434 "
    .. "C400 410 436 410 442 434 C452 408 490 410 496 434 C506 410 544 414 548 436 "
    .. "C566 420 592 430 582 450 Z"),
  loaf:translate(700, 474), loaf:translate(806, 474), loaf:translate(753, 440),
}

local apprentice = union {
  form("#b98058", "M-44 200 C-44 160 -24 146 0 146 C24 146 44 160 44 200 Z"),
  line("M-30 176 L-74 120 L-96 10 M34 176 L66 120 L58 10", 24, "#b98058"),
  form("#3f1a12", "M-420 -4 H84 V6 H-420 Z"),
  form("#6b3418", "M-560 2 C-560 -4 -430 -6 -410 0 V8 H-550 Z"),
  circle { -96, 2, 14, fill = "#e0a06c" }, circle { 56, 2, 14, fill = "#e0a06c" },
  loaf:scale(0.62):translate(-522, -14), loaf:scale(0.62):translate(-452, -14),
  loaf:scale(0.62):translate(-487, -38),
  form("#e0a06c", "M-38 110 C-40 80 -20 66 0 66 C20 66 40 80 38 110 C38 140 20 156 0 156 "
    .. "C-20 156 -38 140 -38 110 Z"),
  form("#e3b98a", "M-44 94 C-64 60 -36 36 -14 48 C-4 34 30 34 32 50 C54 42 62 70 44 94 "
    .. "C20 82 -20 82 -44 94 Z"),
  circle { -22, 112, 5, fill = "#3a1a12" }, circle { 6, 112, 5, fill = "#3a1a12" },
  form("#c9764a", "M-12 118 C-20 128 -10 134 -4 128 Z"), circle { -26, 128, 8,
    fill = rgb(mood.accent, 0.5) },
}

local function dough(bent)
  local w, h = 96 + 44 * bent, 40 - 20 * bent
  return form("#f6dcae", "M%g 406 C%g %g %g %g 434 %g C%g %g %g %g %g 406 Z", 434 - w, 424 - w,
    406 - h,
    434 - 0.7 * w, 404 - h, 404 - 0.8 * h, 434 + 0.7 * w, 404 - h, 444 + w, 406 - h, 434 + w)
end

local function flour(age)
  if age < 0 or age > 5 then return union {} end
  local cloud = union {}
  for side = -1, 1, 2 do
    local x = 434 + side * (104 + 12 * age)
    cloud = cloud | circle { x, 386 - 7 * age, 17 + 5 * age }
      | circle { x + side * (24 + 5 * age), 394 - 3 * age, 13 + 4 * age }
      | circle { x - side * 22, 394 - 4 * age, 13 + 3 * age }
  end
  return cloud:paint(rgb("#fff6e0", 0.62 - 0.12 * age))
end

local bend = gouache.track({ 0, 0 }, { 2, 0 }, { 3, -0.06 }, { 4, 0.9 }, { 5, 1 }, { 8, 0.94 },
  { 11, 0 })

return window.film { title = "The bakery", by = "ga", seconds = 2, size = { 960, 540 },
  pane = "shop",
  drawing = function(_, number)
    local n = number // 2
    local bent = bend:at(n)
    local reach = 360 + 24 * bent
    local left, right = { 392 - 20 * bent, reach }, { 476 + 20 * bent, reach }
    local man = baker.draw { x = 434, y = 244 + 88 * bent, left = left, right = right,
      face = { 10 - 8 * bent, 14 * bent }, eyes = bent > 0.6 and "happy" or "open",
      brow = 6 * (1 - bent) }
    return { room, apprentice:translate(1480 - 127 * n, 214 + n % 2 * 6), man, counter,
      dough(bent), baker.hand(434, left), baker.hand(434, right), flour(n - 5) }
  end }
