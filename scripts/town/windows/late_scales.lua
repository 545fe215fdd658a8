-- A child at its scales is late; the metronome waits.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").harvest
local wash, form, line = gouache.wash, gouache.form, gouache.line

local SKIN = wash(90, 0, 230, 0, "#e0a06c", "#ffe0b0")
local SHIRT = wash(60, 0, 230, 0, "#15484f", mood.accent, "#3b9499")

local room = union {
  gouache.wall(380, 180, 540, mood.light, mood.sky[2], mood.sky[3], "#c9752f"),
  form("#c9792f", "M0 552 H450 V600 H0 Z"),
  form(wash(250, 0, 450, 0, "#5f2f1b", "#8a4826"), "M286 284 H450 V600 H286 Z"),
  form("#a9572b", "M272 268 H450 V288 H272 Z"),
  form("#5f2f1b", "M216 424 H300 V470 H224 Z"), form(mood.light, "M214 404 H300 V424 H214 Z"),
  line("M236 406 V423 M258 406 V423 M280 406 V423", 4, "#33180f"),
  form(mood.light, "M292 300 L352 310 L350 388 L294 384 Z"),
  line("M300 322 L344 328 M300 340 L344 346 M300 358 L344 362", 2.4, "#a9572b"),
}
local stool = form("#7a3b22", "M44 520 H196 V540 H44 Z M64 540 H84 V600 H64 Z M156 540 H176 "
  .. "V600 H156 Z")
local body = gouache.edged(form(SHIRT, "M76 524 C70 440 84 372 122 356 C160 346 186 372 184 420 "
  .. "C184 460 188 490 190 524 Z"), "#123a40", "#8fd0c8", 5, 3)
local legs = line("M130 512 H206 V566", 40, "#7a3b22")
  | form("#33180f", "M186 562 H226 C244 566 250 580 244 588 H186 Z")
local bob = form("#7a3b22", "M-58 20 C-68 -46 -34 -70 0 -70 C38 -70 64 -46 56 -4 "
  .. "C40 -24 20 -34 -6 -34 C-20 -20 -24 0 -22 34 C-36 46 -54 42 -58 20 Z")
local ribbon = form("#c8553d", "M-20 -66 C-50 -94 -52 -50 -20 -62 C8 -50 10 -94 -20 -66 Z")

--- The metronome; it leans, and looks at her while it waits.
local function metronome(angle, waits)
  local x, y = 366 + 92 * math.sin(math.rad(angle)), 250 - 92 * math.cos(math.rad(angle))
  local look = waits and -6 or 0
  return union { form(wash(320, 0, 410, 0, "#8a4826", "#c9752f"), "M344 146 H388 L412 268 H320 Z"),
    form("#5f2f1b", "M352 158 H380 L392 226 H340 Z"),
    gouache.taper(mood.ink, { 366, 250 }, { x, y }, 7, 6),
    circle { 0, 0, 11, fill = "#c8553d" }:translate(0.55 * (x - 366) + 366, 0.55 * (y - 250) + 250),
    circle { 350 + look, 240, 7, fill = mood.light }, circle { 382 + look, 240, 7,
      fill = mood.light } }
end

return window.film { title = "Late", by = "ga", seconds = 2, drawing = function(_, number)
  local n = number // 2
  local angle = gouache.exposed(n, { 1, 6 }, { 2, 24 }, { 1, 6 }, { 1, -18 }, { 1, -25 }, { 1,
    -23 },
    { 1, -25 }, { 1, -23 }, { 1, -25 }, { 1, -19 }, { 1, -8 })
  local waits = n >= 5 and n <= 9
  local low = n == 1 or n == 2 or n == 9 or n == 10
  local x, y = n < 4 and 268 or 246, low and 394 or 362
  local look = waits and n < 9 and { 22, -12 } or { 20, 8 }
  local sleeve = gouache.arm { from = { 138, 400 }, to = { x, y }, parts = { 80, 80 }, side = -1,
    widths = { 50, 42, 28 }, fill = SHIRT }
  return { room, metronome(angle, waits), stool, body, legs,
    gouache.head { x = 142, y = 284 + (low and 4 or 0), skin = SKIN, face = look,
      front = bob | ribbon,
      eyes = low and n > 5 and "happy" or "open", brow = waits and 9 or 2, brows = "#7a3b22",
      mouth = waits and n < 9 and "M-6 38 Q0 32 8 36" or nil },
    sleeve:translate(4, 4):paint("#123a40"), sleeve, circle { 0, 0, 17 }:translate(x,
      y):paint(SKIN) }
end }
