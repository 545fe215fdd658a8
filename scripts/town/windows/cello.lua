-- A cellist by candlelight, the first part of a quartet: her head is late, one eye peeps at us.
local gouache = require "town.gouache"
local strings = require "town.strings"
local window = require "town.window"
local wash, form, line = gouache.wash, gouache.form, gouache.line

local GOWN = wash(110, 0, 350, 0, "#a8431f", "#6b2a18", "#3f1a12")
local SKIN = wash(140, 0, 300, 0, "#ffd3a0", "#dd9462", "#9a5636")
local HAIR = "#4d2413"

local room = union {
  gouache.wall(76, 230, 480, "#ffe2a0", "#e79a45", "#a8551f", "#6b3418"),
  form("#8a4420", "M0 540 H450 V600 H0 Z"),
  form("#7a3c1c", "M340 132 H412 V236 H340 Z"), form("#b5642a", "M347 139 H405 V229 H347 Z"),
  form("#6b3418", "M354 229 C354 204 366 204 370 196 C360 180 368 166 376 166 "
    .. "C386 166 394 180 384 196 C388 204 398 206 398 229 Z"),
  strings.desk(70),
}

local cello = (line("M0 120 V160", 5, "#54270f") | strings.instrument(1)):rotate(10)
  :translate(226, 466)

local chair = line("M300 420 V600 M120 470 V600", 14, "#54270f")
local torso = gouache.edged(form(GOWN, "M150 440 C152 372 128 330 158 296 "
  .. "C176 276 198 276 204 258 H236 C240 276 268 276 286 296 C312 326 288 384 290 440 Z"),
  "#f0a25c", "#2f120c", 5, 3)
local skirt = gouache.edged(form(GOWN, "M96 600 C84 520 104 446 156 424 "
  .. "C190 410 262 410 290 424 C344 448 364 520 354 600 Z"), "#f0a25c", "#2f120c", 6, 4)

local bun = form(HAIR, "M-54 6 C-62 -46 -34 -74 2 -74 C44 -74 62 -40 54 4 C52 30 44 40 36 44 "
  .. "L-40 40 C-48 34 -52 24 -54 6 Z") | ellipse { 40, -60, 26, 24, fill = "#5e2c15" }
local fringe = form("#5e2c15", "M-52 -2 C-60 -50 -30 -72 4 -72 C40 -72 60 -44 52 2 "
  .. "C46 -22 32 -38 8 -46 C-14 -44 -44 -32 -52 -2 Z")

local function bowing(share)
  local x = 66 + 106 * share
  local y = 436 + 0.176 * (x - 226) - 6 * math.sin(math.pi * share)
  local stick = strings.bow():rotate(10)
  local sleeve = gouache.arm { from = { 164, 312 }, to = { x + 2, y }, parts = { 84, 96 },
    side = -1, widths = { 50, 44, 28 }, fill = wash(40, 0, 190, 0, "#c4562a", "#8a3a1f") }
  return union { stick:translate(x, y), sleeve:translate(5, 4):paint("#3f1a12"), sleeve,
    ellipse { 0, 0, 17, 15 }:translate(x + 6, y + 2):paint(SKIN) }
end

local function fingering(x, y)
  local dark = wash(260, 0, 400, 0, "#7a3018", "#3f1a12")
  return union { gouache.taper(dark, { 276, 314 }, { 340, 376 }, 52, 44),
    gouache.taper(dark, { 340, 376 }, { x + 20, y + 4 }, 44, 26),
    form(nil, "M22 -8 C8 -20 -14 -14 -16 -4 C-18 10 2 20 26 12 Z"):translate(x, y):paint(SKIN) }
end

return window.film { title = "The cellist", by = "ga", seconds = 4, drawing = function(_, number)
  local n = number // 2
  local late = 106 * strings.phrase:at((n - 2) % 24) - 54
  local high = n >= 10 and n < 19
  local trill = n % 2 * (n >= 11 and n <= 17 and 5 or 2)
  local hx, hy = 214 + 0.14 * late, 210 + 0.03 * math.abs(late)
  local now, soon = strings.phrase:at(n), strings.phrase:at((n + 1) % 24)
  return { room, strings.flame(70, n % 2 * 2 - 1 + 30 * (now - soon)), chair, torso,
    form(nil, "M200 230 H238 L246 292 C226 304 206 300 194 290 Z"):paint(SKIN),
    gouache.head { x = hx, y = hy, face = { -8 + 0.08 * late, 6 - (high and 6 or 0) }, skin = SKIN,
      behind = bun, front = fringe, eyes = n >= 20 and n < 23 and { "shut", "open" } or "shut",
      brow = high and 5 or 0, mouth = n > 18 and "M-10 32 Q2 44 12 30" or nil },
    skirt, cello, fingering(high and 266 or 258, (high and 254 or 296) + trill), bowing(now) }
end }
