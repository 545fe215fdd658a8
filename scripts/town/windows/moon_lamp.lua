-- A girl, a book and a lamp like a moon; she has turned to the wall, and the book reads on.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").storm
local wash, form, line = gouache.wash, gouache.form, gouache.line

local room = union {
  gouache.wall(330, 192, 470, "#b9b48c", "#76816f", "#45565c", "#2b383d", "#1f292d"),
  circle { 330, 192, 62, fill = radial { "#fffbe0", "#f6e6a0", mood.accent } },
  circle { 310, 172, 13, fill = "#e9cf7a" }, circle { 346, 210, 17, fill = "#e0bf58" },
  circle { 352, 168, 7, fill = "#e9cf7a" }, line("M330 250 V296", 6, "#37464a"),
  form("#37464a", "M282 294 H450 V308 H282 Z"),
  form("#3a4a4c", "M0 310 C10 296 60 296 70 316 V600 H0 Z"),
}
local pillow = form(wash(40, 380, 230, 460, "#8d9a90", "#dfe6cf"), "M40 468 "
  .. "C30 410 60 376 130 382 C200 380 236 410 232 470 Z")
local hair = form(wash(80, 0, 200, 0, "#6b3a24", "#a3603a"), "M78 430 C70 372 110 346 146 352 "
  .. "C190 356 206 396 198 436 C214 452 206 486 178 482 C160 500 116 492 100 478 "
  .. "C80 474 70 452 78 430 Z")
  | line("M120 380 C104 410 108 440 124 470 M156 372 C150 410 156 440 172 466", 4, "#5a2f1e")
  | form("#c9553d", "M190 470 C206 460 222 474 212 486 C226 496 212 512 196 500 "
  .. "C186 506 176 480 190 470 Z")

local function blanket(breath)
  local y = 380 - breath
  return form(wash(150, 330, 330, 600, "#8fa39a", "#5a6f70", "#37464a"), "M0 600 V486 "
    .. "C60 470 120 490 168 470 C196 %g 250 %g 296 %g C340 %g 380 440 450 452 V600 Z", y + 40, y,
    y, y + 4)
    | line(("M186 %g C200 520 170 560 180 600 M300 %g C330 480 320 540 340 600"):format(y + 90,
      y + 26), 6, "#45595b")
end

local boat = form("#fffbe0", "M-30 0 H30 L18 18 H-18 Z M-3 -4 L-3 -40 L-26 -4 Z M3 -4 L3 -34 "
  .. "L22 -4 Z")
local sails = gouache.track({ 5, { 312, 376 } }, { 7, { 296, 340 } }, { 12, { 240, 366 } }, { 18, {
  130, 336 } },
  { 22, { -40, 400 } })

--- The book: its pages turn from right to left.
local function book(turn, y)
  local shown = form("#c9553d", "M-66 8 Q-30 -6 0 8 Q30 -6 66 8 L62 18 Q30 4 0 18 Q-30 4 -62 18 Z")
    | form("#fffbe0", "M-62 4 Q-30 -14 0 2 Q30 -14 62 4 L60 12 Q30 0 0 10 Q-30 0 -60 12 Z")
  if turn then
    shown = shown | form("#f3ecc4", "M0 6 C%g %g %g %g %g %g C%g %g %g %g 0 6 Z", 0.3 * turn, -34,
      0.7 * turn, -50,
      turn, -44 + math.abs(turn) / 4, 0.8 * turn, -30, 0.5 * turn, -14)
  end
  return shown:rotate(8):translate(330, 396 + y)
end

return window.film { title = "The book reads on", by = "ga", seconds = 4, drawing = function(_,
  number)
  local n = number // 2
  local breath = ({ 0, 0, 3, 6, 9, 11, 12, 11, 9, 6, 3, 0 })[n % 12 + 1]
  local turn = gouache.exposed(n, { 3, nil }, { 1, 44 }, { 1, 8 }, { 1, -40 }, { 9, nil }, { 1,
    44 }, { 1, 8 },
    { 1, -40 }, { 6, nil })
  local x, y = table.unpack(sails:at(n))
  local bed = union { pillow, hair:translate(0, -breath // 4),
    n >= 6 and n < 22 and boat:translate(x, y - n % 4 // 2 * 5) or union {}, blanket(breath),
    book(turn, -breath // 2) }
  return { room, bed:scale(1.25, 1.25, 225, 620) }
end }
