-- What the players of the quartet share: an instrument of strings, a bow, and the phrase that they
-- bow together, so that their windows are in time.
local gouache = require "town.gouache"
local mood = require("stage.moods").candle
local form, line, wash = gouache.form, gouache.line, gouache.wash

local strings = {}

--- Where the bow is at drawing 0 to 24, from 0, at its tip, to 1, at its frog.
strings.phrase = gouache.track({ 0, 1 }, { 9, 0 }, { 10, 0 }, { 17, 1 }, { 19, 0.58 }, { 21, 0.94 },
  { 22, 0.7 }, { 24, 1 })

local half = "M0 -152 C40 -152 68 -136 62 -98 C58 -74 42 -64 42 -40 C42 -20 78 -8 84 48 "
  .. "C88 104 44 124 0 124 Z"

--- An instrument whose bridge is at 0, 0, upright, 450 high; its light comes from the left, or from
--- the right if side is -1.
function strings.instrument(side)
  local wood = wash(-90 * side, 0, 90 * side, 0, "#f08a3c", mood.accent, "#9a3d1a")
  local box = (form(nil, half) | form(nil, half):scale(-1, 1)):paint(wood)
  return union { gouache.edged(box, "#ffc57a", "#742c14", 6 * side, 3),
    form("#3f1a12", "M-8 -40 L-7 -300 L7 -300 L10 -40 Z"),
    line("M0 -300 C-2 -330 26 -336 26 -316 C26 -304 12 -304 12 -314", 12, "#7a3217"),
    line("M-20 -318 H18", 7, "#54270f"),
    line("M-40 -20 C-28 -10 -44 20 -34 34 M40 -20 C28 -10 44 20 34 34", 5, "#742c14"),
    form("#54270f", "M-22 6 L-18 -6 H18 L22 6 Z"), form("#3f1a12", "M-9 50 H9 L5 112 H-5 Z"),
    line("M-4 -290 L-5 60 M4 -290 L5 60", 1.6, mood.light) }
end

--- A bow whose frog is at 0, 0 and whose tip is to the right.
function strings.bow()
  return form("#54270f", "M-4 -3 H240 V2 L-4 3 Z") | form(mood.light, "M-4 3 L240 2 V5 L0 8 Z")
end

--- A desk with music, whose foot is at x.
function strings.desk(x)
  return union { line("M0 600 V360 M0 560 L-34 600 M0 560 L34 600", 8, "#54270f"),
    form(wash(-50, 0, 60, 0, "#fff0c4", "#e9b064"), "M-52 268 L54 284 L50 366 L-52 354 Z"),
    line("M-38 290 L40 302 M-38 306 L40 318 M-38 322 L40 333 M-38 338 L40 348", 2, "#b87a3c"),
    form(wash(-18, 0, 6, 0, "#fff0c4", "#d98f45"), "M-16 268 V240 H4 V270 Z") }:translate(x, 0)
end

--- The flame of the candle on that desk.
function strings.flame(x, lean)
  return form("#fff3c8", "M%g 238 C%g 224 %g 206 %g 188 C%g 206 %g 222 %g 238 Z", x - 12, x - 22,
    x - 14 + lean, x - 6 + 2 * lean, x + 6 + lean, x + 8, x)
    | form("#f5b04a", "M-10 238 C-14 230 -8 222 -6 216 C-2 222 2 230 -2 238 Z"):translate(x, 0)
end

return strings
