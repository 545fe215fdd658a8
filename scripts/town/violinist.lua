-- One who plays the violin or the viola, upright, with the arm of the bow towards the candle.
local gouache = require "town.gouache"
local strings = require "town.strings"
local form, wash = gouache.form, gouache.wash

local SKIN = wash(130, 0, 320, 0, "#ffd3a0", "#dd9462", "#9a5636")

local stick = strings.bow():rotate(-52)

--- The player at drawing n of 24. fields: coat, shade: colours of the cloth; sleeve: of the arm of
--- the bow; rise; size of the instrument; head: { dx, dy }; behind, front, eyes, brow, mouth: as of
--- gouache.head; finger: how far the hand at the neck has moved.
return function(n, fields)
  local share, rise = strings.phrase:at(n), -fields.rise
  local cloth = wash(110, 0, 340, 0, fields.sleeve, fields.coat, fields.shade)
  local body = form(cloth, "M120 640 C126 520 116 420 132 366 C142 340 180 334 196 318 H246 "
    .. "C262 334 300 340 312 366 C328 420 316 520 324 640 Z"):translate(0, rise)
  local fiddle = strings.instrument(1):scale(fields.size):rotate(100):translate(272, 322 + rise)
  local hx, hy = 128 + 78 * share, 448 - 100 * share + rise
  local bowing = gouache.arm { from = { 146, 372 + rise }, to = { hx, hy }, parts = { 84, 84 },
    side = -1, widths = { 54, 46, 28 }, fill = wash(50, 0, 220, 0, fields.sleeve, fields.coat) }
  local neck = 272 + 232 * fields.size - fields.finger
  return union { gouache.edged(body, "#f0a25c", fields.shade, 5, 3),
    form(nil, "M192 240 H240 L250 330 C228 346 206 342 188 330 Z"):translate(0, rise):paint(SKIN),
    fiddle, gouache.taper(fields.shade, { 298, 384 + rise }, { 346, 454 + rise }, 52, 44),
    gouache.taper(fields.shade, { 346, 454 + rise }, { neck + 6, 374 + rise }, 44, 26),
    ellipse { 0, 0, 19, 17 }:translate(neck, 360 + rise):paint(SKIN),
    gouache.head { x = 206 + fields.head[1], y = 244 + fields.head[2] + rise, skin = SKIN,
      face = { 10 + fields.head[1], 8 + fields.head[2] }, behind = fields.behind,
      front = fields.front, eyes = fields.eyes, brow = fields.brow, mouth = fields.mouth,
      brows = fields.brows },
    stick:translate(hx, hy), bowing, circle { 0, 0, 17 }:translate(hx, hy):paint(SKIN) }
end
