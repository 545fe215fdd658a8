-- A couple dances slowly, her feet on his; the lamp and the shadow turn against them.
local couple = require "town.couple"
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").candle
local wash, form, line = gouache.wash, gouache.form, gouache.line

local room = union {
  gouache.wall(225, 220, 430, "#ffe2a0", "#e59a48", "#9a5023", "#5a2a15"),
  form("#6b3418", "M0 506 H450 V600 H0 Z"), ellipse { 225, 560, 190, 44, fill = "#a35a2a" },
  form("#4d2413", "M30 470 H122 V590 H30 Z"), form("#7a3c1c", "M24 456 H128 V474 H24 Z"),
  form(wash(40, 0, 130, 0, "#ffd27a", "#c07a35", "#7a3f1c"), "M70 456 C60 420 58 400 40 372 "
    .. "C30 340 60 300 108 306 C132 322 130 366 104 384 C88 398 88 424 92 456 Z"),
  ellipse { 84, 344, 40, 32, fill = "#6b3418" }:rotate(-24, 84, 344),
}

local SKIN = wash(150, 200, 320, 320, "#ffd3a0", "#b06a42")
local he = { fill = wash(0, 230, 0, 560, "#8a4f33", "#5f2f1c", "#43200f"), edge = "#e9a35c",
  body = form(nil, "M-22 -318 C-50 -312 -60 -290 -60 -250 C-58 -200 -50 -160 -50 -120 L-46 -14 "
    .. "C-46 2 -12 2 -8 -10 L0 -30 L8 -10 C12 2 46 2 46 -14 L50 -120 C50 -160 58 -200 60 -250 "
    .. "C60 -290 50 -312 22 -318 Z"),
  sleeve = "#5a2b19", skin = SKIN, hair = "#43200f", shade = "#341409", nose = "#d98f5c",
    size = 0.8,
  head = 356, shoulder = 284, broad = 46, hold = 190 }
local she = { fill = wash(0, 280, 0, 560, "#f0843f", mood.accent, "#9a3d1a"), edge = "#ffc98a",
  body = form(nil, "M-16 -262 C-40 -258 -46 -240 -44 -214 C-42 -186 -30 -176 -30 -156 "
    .. "C-34 -110 -62 -66 -72 -22 C-40 -6 40 -6 72 -22 C62 -66 34 -110 30 -156 "
    .. "C30 -176 42 -186 44 -214 C46 -240 40 -258 16 -262 Z") | form(nil, "M-30 -20 L-26 2 "
    .. "C-24 10 -8 10 -8 2 L-4 -14 L4 -14 L8 2 C8 10 24 10 26 2 L30 -20 Z"),
  sleeve = "#c45021", skin = SKIN, hair = "#8a3d1c", shade = "#6b2c14", nose = "#d98f5c",
    size = 0.74,
  bun = true, head = 298, shoulder = 236, broad = 34, hold = 270, eyes = "shut" }

return window.film { title = "A slow dance", by = "ga", seconds = 8, drawing = function(_, number)
  local n = number // 3
  local turn = n / 32
  local hop = gouache.exposed(n, { 22, 0 }, { 1, 10 }, { 9, 0 })
  she.lift = 12 + hop + 3 * (n % 4 // 2)
  he.lift = 3 * (n % 4 // 2)
  he.eyes = n >= 23 and n < 26 and "open" or "shut"
  he.brow = n >= 23 and n < 26 and 8 or 0
  local pair, shape = couple.draw(225, 556, turn, he, she)
  local swing = -2 * math.pi * turn
  local lx, ly = 225 + 34 * math.cos(swing), 124 + 6 * math.sin(swing)
  return { room, shape:paint(rgb("#6b3418", 0.5)):translate(-1.6 * (lx - 225), -18),
    line(("M225 0 L%g %g"):format(lx, ly - 30), 4, "#5a2a15"),
    form(wash(0, 90, 0, 146, "#c9702e", "#ffdf95"), "M-14 -30 H14 L40 18 H-40 Z"):translate(lx, ly),
    pair }
end }
