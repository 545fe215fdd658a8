-- The double bass of the quartet: a small man behind a huge belly of wood, who wants to be seen.
local gouache = require "town.gouache"
local strings = require "town.strings"
local window = require "town.window"
local wash, form, line = gouache.wash, gouache.form, gouache.line

local SKIN = wash(60, 0, 200, 0, "#ffd3a0", "#d98f5c")
local COAT = wash(20, 0, 260, 0, "#8a4f33", "#54270f")

local room = union {
  gouache.wall(40, 250, 500, "#ffe2a0", "#e79a45", "#a8551f", "#6b3418"),
  form("#8a4420", "M0 548 H450 V600 H0 Z"), form("#7a3c1c", "M54 540 H142 V600 H54 Z"),
  form("#93481f", "M384 150 H450 V420 H384 Z"), line("M384 220 H450 M384 300 H450", 8, "#6b3418"),
}
local bass = (line("M0 120 V160", 5, "#54270f") | strings.instrument(1)):scale(1.46):rotate(5)
  :translate(270, 432)
local stick = strings.bow():scale(1.15):rotate(5)
local bald = form("#5e2c15", "M-46 -6 C-66 -10 -66 26 -50 34 Z M46 -6 C66 -10 66 26 50 34 Z")
local rise = gouache.track({ 0, 0 }, { 9, 6 }, { 10, 0 }, { 12, -58, "outQuad" }, { 16.5, -62 },
  { 18, 14, "inQuad" }, { 20, 0 }, { 24, 0 })

return window.film { title = "The double bass", by = "ga", seconds = 4, drawing = function(_,
  number)
  local drawing = number // 3
  local n = 1.5 * drawing
  local share, up = strings.phrase:at(n), math.floor(rise:at(n))
  local proud = n >= 12 and n < 17
  local hx, hy = 60 + 80 * share, 424 + 7 * share
  local function sleeve(from, to, side, widths)
    return gouache.arm { from = from, to = to, parts = { 84, 84 }, side = side, widths = widths,
      fill = COAT }
  end
  return { room, form(COAT, "M70 600 C62 480 60 %g 96 %g C130 %g 200 %g 240 %g V600 Z", 400 + up,
    356 + up,
      330 + up, 330 + up, 360 + up),
    gouache.head { x = 134, y = 272 + up, scale = 1.08, skin = SKIN, face = { proud and 2 or 10,
      proud and -4
      or 2 }, behind = bald, eyes = proud and "happy" or "open", brow = proud and 8 or 4,
      nose = "#c9653f", mouth = proud and "M-14 32 Q0 46 14 32" or "M-4 36 Q0 34 6 36" },
    bass, sleeve({ 92, 386 + up }, { hx, hy }, 1, { 52, 46, 28 }), stick:translate(hx, hy),
    circle { 0, 0, 18 }:translate(hx, hy):paint(SKIN),
    ellipse { 0, 0, 17, 24 }:translate(286,
      (proud and 232 or 196) + drawing % 2 * 5):paint("#c9855a") }
end }
