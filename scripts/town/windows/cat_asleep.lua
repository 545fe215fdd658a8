-- The cat asleep on the sill: it breathes, and an ear turns to each gust.
local gouache = require "town.gouache"
local window = require "town.window"
local wash, form, limb, line = gouache.wash, gouache.form, gouache.limb, gouache.line

local FUR = wash(90, 0, 400, 0, "#8d7f7a", "#464a54", "#2b3746")
local PALE = "#fdf3e0"

local room = union {
  gouache.wall(330, 220, 500, "#ffe9b4", "#e3a961", "#a8673f", "#7c4733"),
  line("M352 600 V220", 9, "#6b3c2d"),
  form(wash(352, 130, 352, 270, "#f4c878", "#fff6dc"), "M312 140 H392 L428 270 H276 Z"),
  form("#7a4531", "M0 600 V400 C40 330 150 330 170 400 V600 Z"),
  rect { 0, 560, 450, 40, fill = "#c98f5c" },
}
local flake = star { 0, 0, 12, 5, points = 6, outer_round = 0.6, fill = "#ffffff" }

local COAT = wash(60, 0, 290, 0, "#a98f7e", "#6b666a", "#4a505a")
local face = union {
  form(PALE, "M0 -12 C8 8 40 18 34 40 C26 58 -26 58 -34 40 C-40 18 -8 8 0 -12 Z"),
  form("#c9705f", "M-9 20 Q0 14 9 20 L0 30 Z"),
  line("M-14 38 Q-7 45 0 37 Q7 45 14 38", 3.4, "#6d5a58"),
  line("M-44 28 L-92 24 M-44 36 L-88 44 M44 28 L92 24 M44 36 L88 44", 2.4, PALE) }
local shut = line("M16 0 Q31 12 46 -2", 4.5, "#1f2a36")
local peeping = form("#ffe082", "M16 0 Q31 -12 46 -2 Q31 10 16 0 Z") | ellipse { 32, -2, 4, 6,
  fill = "#1f2a36" }

--- An ear upright, or turned aside, as an outline and its pale inside.
local function ear(turned)
  if turned then
    return form(nil, "M-20 -34 C-40 -62 -64 -76 -96 -72 C-94 -44 -80 -16 -58 4 Z"),
      form("#d99a84", "M-36 -34 C-48 -50 -64 -60 -82 -60 C-80 -44 -72 -26 -58 -12 Z")
  end
  return form(nil, "M-16 -44 C-28 -74 -46 -96 -66 -104 C-76 -70 -76 -30 -64 0 Z"),
    form("#d99a84", "M-32 -46 C-38 -62 -48 -76 -60 -84 C-66 -62 -64 -40 -58 -20 Z")
end

return window.film { title = "The cat asleep", by = "ga", seconds = 4, drawing = function(_, number)
  local n = number // 2
  local deep = math.floor(7 * (1 - math.cos(2 * math.pi * n / 12)) / 2 + 0.5)
  local gust = n >= 6 and n < 10 or n >= 17 and n < 20
  local body = form(nil, "M70 580 C56 %g 130 %g 226 %g C330 %g 404 %g 396 580 Z", 460 - deep,
    370 - 2 * deep,
    366 - 2 * deep, 366 - 2 * deep, 450 - deep)
  local left, pink = ear(gust)
  local right, rose = ear(n >= 8 and n < 11)
  local skull = form(nil, "M-74 8 C-80 -38 -46 -58 0 -58 C46 -58 80 -38 74 8 C70 50 36 60 0 60 "
    .. "C-36 60 -70 50 -74 8 Z") | left | right:scale(-1, 1)
  local function put(object) return object:scale(1.12):translate(176, 500 - deep) end
  local flakes = union {}
  for i = 0, 2 do
    local u = (n / 24 + i / 3) % 1
    flakes = flakes | flake:translate(60 + 150 * i + (gust and 26 or 0) + 20 * math.sin(6.28 * u),
      640 * u - 20)
  end
  return { room, gouache.edged(body:paint(FUR), "#27313f", "#f0c890", 5, 4),
    limb(FUR, { 386, 540, 44 }, { 340, 590, 46 }, { 230, 590, 42 }, { 196, 566, 30 }),
    put(skull):translate(7, 4):paint("#27313f"), put(skull):paint(COAT),
    put(pink | rose:scale(-1, 1) | face | shut:scale(-1,
      1) | (n >= 18 and n < 21 and peeping or shut)),
    flakes }
end }
