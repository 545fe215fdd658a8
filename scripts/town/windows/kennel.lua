-- The kennel: a dog under a blanket, with a torch and a bone, which it reads from both sides.
local gouache = require "town.gouache"
local window = require "town.window"
local wash, form, line = gouache.wash, gouache.form, gouache.line

local SHADOW = wash(0, 250, 0, 600, "#a46c22", "#6b4520")
local DARK = "#5a3c1e"
local HILL = "M70 620 C84 500 100 360 190 262 C240 214 330 210 384 268 C460 360 504 500 528 620 Z"

local room = union {
  gouache.wall(300, 430, 480, "#7a6a45", "#4f4a38", "#33393a", "#232e32"),
  form("#2b2722", "M0 0 H600 V600 H560 V330 C560 120 440 60 300 60 C160 60 40 120 40 330 V600 "
    .. "H0 Z"),
  line("M0 150 H90 M0 300 H40 M0 450 H40 M510 150 H600 M560 300 H600 M560 450 H600", 6, "#45392c"),
  form("#6b4a2e", "M230 78 H370 V122 H230 Z"),
  form("#dfe6cf", "M272 92 C262 84 252 96 262 100 C252 104 262 116 272 108 H328 "
    .. "C338 116 348 104 338 100 C348 96 338 84 328 92 Z"),
}
local cloth = path { d = HILL, fill = radial { centre = { 340, 440 }, radius = 380, "#fff3b4",
  "#f4c430", "#b07a2c",
  "#5f5a3e", "#46544f" } }
local folds = union {
  form(rgb("#4c4a36", 0.5), "M250 232 C190 320 160 470 150 620 H116 C126 470 170 320 250 232 Z"),
  form(rgb("#4c4a36", 0.45), "M350 250 C410 330 440 470 456 620 H492 C470 460 430 330 350 250 Z"),
  form(rgb("#ffe58a", 0.55), "M190 262 C240 214 330 210 384 268 L394 284 "
    .. "C340 230 240 232 176 284 Z"),
}
local body = form(nil, "M140 620 C130 520 160 452 226 440 C280 440 300 480 310 530 "
  .. "C350 540 372 570 372 620 Z")
local skull = form(nil, "M-70 -6 C-72 -56 -36 -78 4 -74 C40 -70 58 -48 62 -22 L112 -10 "
  .. "C124 0 122 22 108 28 C80 40 50 44 24 48 C-20 60 -66 44 -70 -6 Z")
local ear = form(DARK, "M-40 -50 C-72 -60 -92 -10 -84 38 C-76 58 -54 54 -50 30 "
  .. "C-44 0 -34 -20 -40 -50 Z")
local bone = form(DARK, "M-46 -9 C-66 -30 -84 -6 -66 2 C-84 14 -64 36 -46 13 H46 "
  .. "C64 36 84 14 66 2 C84 -6 66 -30 46 -9 Z")
local torch = line("M-12 54 Q-2 24 6 6", 8, DARK) | line("M0 0 L26 20", 22, DARK) | form(DARK,
  "M18 30 L40 4 L60 16 L36 46 Z")

return window.film { title = "The kennel", by = "ga", seconds = 4, size = { 600, 600 },
  pane = "round",
  drawing = function(_, number)
    local n = number // 2
    local dx = ({ -6, -4, -1, 2, 5, 8, 8, 8 })[(n < 16 and n or 0) % 8 + 1]
    local gnaws = n >= 17 and n < 22
    local wag = gouache.exposed(n, { 8, 0 }, { 1, 30 }, { 1, -10 }, { 1, 30 }, { 1, -10 },
      { 5, 0 }, { 1, 40 },
      { 1, -20 }, { 1, 40 }, { 1, -20 }, { 1, 40 }, { 2, 0 })
    local flip = gouache.exposed(n, { 6, 1 }, { 1, 0.3 }, { 8, -1 }, { 1, -0.3 }, { 8, 1 })
    local hill = path { d = HILL }
    local bx, by = gnaws and 366 or 404, (gnaws and 428 or 470) + (gnaws and n % 2 * 8 or 0)
    local tail = stroke { degree = 3, cap = "round", fill = "#4a3826", points = { { 168, 620, 40 },
      { 122, 570, 36 }, { 116 - wag / 3, 510, 28 }, { 136 + wag, 452, 12 } } }
    return { room, cloth,
      clip(form(rgb("#fffbe0", 0.5), "M272 340 L292 318 L486 496 L344 520 Z"), hill),
        body:paint(SHADOW),
      (skull:translate(244 + dx, 392 + (gnaws and 8 or 0))):paint(SHADOW),
      ear:translate(244 + 0.6 * dx, 392 + (n % 8 == 6 and -8 or 0)),
        torch:translate(232 + dx, 306),
      bone:scale(1, flip):rotate(18):translate(bx, by),
      gouache.taper("#6b4520", { 300, 520 }, { bx - 34, by + 24 }, 44, 34), folds, tail }
  end }
