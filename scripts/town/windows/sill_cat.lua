-- A cat on the sill follows one flake of snow, pats the pane, and leaves a print that fades.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").snow
local wash, form, limb, line = gouache.wash, gouache.form, gouache.limb, gouache.line

local LIT, FUR, DEEP, PALE, SHADE = "#a98f7e", "#56545a", "#2b3746", "#fdf3e0", "#b9aca6"

local flake = gouache.track({ 0, { 330, 10 } }, { 4, { 384, 160 } }, { 8, { 240, 292 } },
  { 10, { 150, 352 } }, { 13, { 318, 424 } }, { 14, { 318, 436 } })
local gaze = gouache.track({ 0, { 5, -8 } }, { 4, { 9, -4 } }, { 6, { 7, 2 } }, { 8, { 0, 6 } },
  { 10, { -9, 6 } }, { 12, { 6, 8 } }, { 13, { 9, 8 } }, { 19, { 9, 8 } }, { 20, { 3, 0 } },
  { 22, { 4, -8 } })
local nod = gouache.track({ 0, { 4, -7 } }, { 4, { 8, -3 } }, { 8, { 0, 6 } }, { 10, { -9, 7 } },
  { 12, { 6, 5 } }, { 13, { 5, 0 } }, { 15, { 10, 9 } }, { 19, { 11, 10 } }, { 22, { 4, -7 } })
local paw = gouache.track({ 10, { 278, 552 } }, { 12, { 330, 486 } }, { 13, { 318, 434 },
  "outQuad" }, { 15, { 318, 438 } }, { 17, { 278, 552 } })
local tick = gouache.track({ 0, 0 }, { 4, 0 }, { 6, 1 }, { 10, 1 }, { 12, 0 }, { 16, 0 }, { 18, 1 },
  { 22, 1 }, { 24, 0 })

local room = union {
  gouache.wall(84, 200, 480, "#ffe9b4", "#e3a961", "#a8673f", "#7c4733"),
  form("#7a4531", "M300 600 V390 C300 330 330 316 372 318 C420 318 450 330 470 350 V600 Z"),
  form("#935739", "M300 600 V420 C320 350 380 372 470 380 V600 Z"),
  line("M84 600 V210", 9, "#6b3c2d"),
  form(wash(84, 120, 84, 250, "#ffdf9a", "#fff6dc"), "M48 128 H120 L150 250 H18 Z"),
  gouache.glow(84, 230, 190, mood.light, 0.5),
}

local body = gouache.edged(form(wash(130, 0, 350, 0, LIT, FUR, DEEP), "M146 590 "
  .. "C112 500 134 420 182 350 C210 310 270 310 296 350 C352 420 372 500 340 590 Z"),
  "#f0c890", "#27313f", 8, 4)
local bib = form(wash(190, 0, 300, 0, PALE, SHADE), "M184 356 C186 430 214 476 240 480 "
  .. "C268 474 292 430 294 356 Z")
local legs = limb(wash(170, 0, 300, 0, LIT, DEEP), { 206, 430, 56 }, { 204, 500, 50 },
  { 204, 560, 50 })
  | form(PALE, "M170 590 C164 552 180 538 204 538 C230 538 242 554 238 590 Z")
local sill = rect { 0, 572, 450, 28, fill = "#c98f5c" }

local function tail(swing)
  return limb(wash(320, 0, 420, 0, FUR, DEEP), { 320, 552, 40 }, { 372, 576, 42 },
    { 412 + 6 * swing, 520, 40 }, { 372 + 44 * swing, 470, 34 }, { 376 + 58 * swing, 430, 26 })
end

local function eye(x, look, lid)
  if lid == 0 then return line(("M%g -2 Q%g 12 %g -2"):format(x - 20, x, x + 20), 5, LIT) end
  local white = ellipse { x, 0, 23, 22 * lid, fill = "#ffe082" }
  local pupil = ellipse { x + look[1], look[2], 11, 17, fill = DEEP }
    | circle { x + look[1] - 4, look[2] - 8, 4, fill = PALE }
  return white | clip(pupil, white)
end

local skull = form(nil, "M-92 14 C-98 -40 -60 -66 0 -66 C60 -66 98 -40 92 14 C86 58 44 76 0 76 "
  .. "C-44 76 -86 58 -92 14 Z")
local ear = form(nil, "M-86 -10 C-92 -60 -88 -92 -76 -112 C-52 -98 -30 -78 -18 -54 Z")
local inner = form("#d99a84", "M-76 -40 C-78 -66 -76 -80 -72 -92 C-58 -82 -46 -70 -38 -58 Z")

local function head(dx, dy, look, lid, cross, twitch)
  local x, y = 240 + 0.7 * dx, 276 + 0.7 * dy
  local left, right = ear:translate(0, twitch), ear:scale(-1, 1)
  local fur = (skull | left | right):translate(x, y):paint(wash(150, 0, 330, 0, LIT, FUR, DEEP))
  local l, r = { look[1] + cross, look[2] }, { look[1] - cross, look[2] }
  local face = union {
    form(SHADE, "M0 -20 C10 4 56 20 46 50 C36 76 -36 76 -46 50 C-56 20 -10 4 0 -20 Z"),
    form(PALE, "M-4 -12 C0 8 32 20 28 46 C22 70 -36 74 -45 50 C-54 22 -10 6 -4 -12 Z"),
    eye(-42, l, lid), eye(42, r, lid), form("#c9705f", "M-11 22 Q0 16 11 22 L0 34 Z"),
    line("M0 34 V42 M-16 44 Q-8 54 0 42 Q8 54 16 44", 4, "#6d5a58"),
    line("M-62 34 L-118 26 M-62 44 L-114 50 M62 34 L118 26 M62 44 L114 50", 2.4, PALE) }
  return union { gouache.edged(fur, "#f0c890", "#27313f", 6, 4),
    (inner:translate(0, twitch) | inner:scale(-1, 1)):translate(x, y),
    face:translate(x + dx, y + dy) }
end

local function print_at(x, y, shown)
  return union { ellipse { x, y + 8, 17, 14 }, ellipse { x - 22, y - 8, 7, 9 },
    ellipse { x - 8, y - 19, 7, 10 }, ellipse { x + 8, y - 19, 7, 10 },
    ellipse { x + 22, y - 8, 7, 9 } }:paint(rgb("#fffaf0", shown))
end

local function arm(n)
  local x, y = table.unpack(paw:at(n))
  local sleeve = gouache.edged(limb(wash(240, 0, 330, 0, FUR, DEEP), { 268, 430, 56 },
    { 276, (430 + y) / 2 + 10, 52 }, { x, y, 50 }), "#8d7f7a", "#27313f", 4, 0)
  local tip = ellipse { x, y + 4, 34, 30, fill = "#d6c8bc" }
  if n < 13 or n > 15 then return sleeve | tip end
  return sleeve | tip:scale(1.1, "centre") | print_at(x, y, 1):paint("#d98f86")
end

return window.film { title = "A cat on the sill", by = "ga", seconds = 4,
  drawing = function(_, number)
  local n = number // 2
  local dx, dy = table.unpack(nod:at(n))
  local lid = gouache.exposed(n, { 14, 1 }, { 1, 0.7 }, { 4, 1 }, { 1, 0 }, { 4, 1 })
  local x, y = table.unpack(flake:at(n))
  local shown = math.min(1, (24 - n) / 7)
  return { room, sill, tail(tick:at(n)), body, bib, legs,
    arm(n),
    line("M196 342 Q240 376 288 342", 15, mood.accent),
    head(dx, dy, gaze:at(n), lid, (n == 8 or n == 9) and 7 or 0, n == 18 and 16 or 0),
    n >= 16 and print_at(318, 438, 0.85 * shown) or union {},
    n < 13 and star { x, y, 15, 6, points = 6, outer_round = 0.6, fill = "#ffffff" }
      or union {} }
end }
