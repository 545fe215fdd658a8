-- The two of slow_dance forty years later: half the steps, the same turn.
local couple = require "town.couple"
local gouache = require "town.gouache"
local window = require "town.window"
local wash, form, line = gouache.wash, gouache.form, gouache.line

local room = union {
  gouache.wall(225, 260, 430, "#ffe6b0", "#d9984f", "#8f5230", "#54301f"),
  form("#6b4430", "M0 506 H450 V600 H0 Z"), ellipse { 225, 560, 190, 44, fill = "#96603a" },
  form("#7a4e34", "M324 160 H408 V262 H324 Z"), form("#c99a62", "M332 168 H400 V254 H332 Z"),
  ellipse { 356, 206, 13, 15, fill = "#5f3a26" }, ellipse { 378, 212, 12, 14, fill = "#8f4a28" },
  form("#5f3a26", "M338 254 C338 226 366 218 372 254 Z"), form("#c2562b", "M364 254 "
    .. "C364 232 392 228 394 254 Z"),
  form("#54301f", "M36 360 C36 330 110 330 110 360 V600 H36 Z"), form("#6b4430", "M26 452 H124 "
    .. "V478 H26 Z"),
}

local SKIN = wash(150, 200, 320, 320, "#ffdcb4", "#b97c55")
local he = { fill = wash(0, 230, 0, 560, "#7d6250", "#5f4434", "#432a1c"),
  body = form(nil, "M-22 -300 C-50 -296 -62 -270 -62 -236 C-64 -190 -54 -160 -52 -120 L-46 -14 "
    .. "C-46 2 -12 2 -8 -10 L0 -30 L8 -10 C12 2 46 2 46 -14 L52 -120 C54 -160 64 -190 62 -236 "
    .. "C62 -270 50 -296 22 -300 Z"),
  sleeve = "#604738", skin = SKIN, hair = "#efe0c6", shade = "#cdb698", nose = "#d98f5c",
    size = 0.8,
  head = 338, shoulder = 268, broad = 46, hold = 180, eyes = "shut" }
local she = { fill = wash(0, 280, 0, 560, "#c9673f", "#a84a2c", "#6f2c1c"),
  body = form(nil, "M-16 -248 C-42 -244 -50 -226 -48 -200 C-46 -172 -40 -160 -40 -140 "
    .. "C-46 -100 -66 -60 -74 -18 C-40 -6 40 -6 74 -18 C66 -60 46 -100 40 -140 "
    .. "C40 -160 46 -172 48 -200 C50 -226 42 -244 16 -248 Z"),
  sleeve = "#a04628", skin = SKIN, hair = "#f3e9d6", shade = "#cdb698", nose = "#d98f5c",
    size = 0.74,
  bun = true, head = 284, shoulder = 222, broad = 36, hold = 254, eyes = "shut", lift = 10 }

return window.film { title = "Forty years later", by = "ga", seconds = 8, drawing = function(_,
  number)
  local n = number // 6
  he.eyes = (n == 11 or n == 12) and "open" or "shut"
  local pair, shape = couple.draw(225, 560, n / 16, he, she)
  local lx = 225 + 34 * math.cos(-2 * math.pi * n / 16)
  return { room, shape:paint(rgb("#54301f", 0.45)):translate(-1.4 * (lx - 225), -14),
    line(("M225 0 L%g 100"):format(lx), 4, "#54301f"),
    form("#e9b87a", "M-14 -30 H14 L40 18 H-40 Z"):translate(lx, 126), pair }
end }
