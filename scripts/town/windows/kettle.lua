-- The kettle alone: its lid goes up and down, and the steam writes a curl.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").candle
local wash, form, line = gouache.wash, gouache.form, gouache.line

local room = union {
  gouache.wall(225, 540, 560, "#ffd890", "#e08f3e", "#9a4e22", "#5a2a15"),
  form("#7a3c1c", "M300 150 H433 V164 H300 Z"), form("#c9853f", "M330 150 V112 H366 V150 Z"),
  form("#8a4420", "M384 150 V96 H416 V150 Z"),
  form(wash(0, 520, 0, 600, "#54270f", "#3a190d"), "M17 520 H433 V600 H17 Z"),
  form("#ffb84a", "M130 520 C140 498 150 510 156 492 C166 510 172 494 182 508 "
    .. "C192 490 200 510 212 494 C222 510 232 490 242 508 C252 492 262 512 272 494 "
    .. "C282 510 292 498 302 508 C310 500 318 510 322 520 Z"),
}
local pot = gouache.edged(form(wash(100, 0, 350, 0, "#d9824a", mood.accent, "#8a3217"), "M112 "
  .. "500 C84 420 112 316 226 316 C340 316 368 420 340 500 Z")
  | form(wash(100, 0, 350, 0, "#d9824a", mood.accent,
  "#8a3217"),
  "M128 440 C80 440 74 380 44 344 L66 330 C100 350 110 400 140 400 Z"), "#ffdf9a", "#5a2110", 7, 4)
local handle = line("M142 330 C120 190 332 190 310 330", 18, "#43200f")
local face = union { ellipse { 190, 410, 8, 11, fill = "#43200f" },
  ellipse { 262, 410, 8, 11, fill = "#43200f" } }
local lid = form(wash(150, 0, 300, 0, "#f0a25c", "#b5532a"), "M158 326 C166 296 196 292 214 292 "
  .. "C210 270 242 270 238 292 C256 292 286 296 294 326 Z")

--- A curl of steam from the spout, which is written from 0 to 1 and then blown away.
local curl = "M52 326 C30 280 70 250 60 210 C54 172 96 150 120 176 C140 200 104 222 96 198 "
  .. "C88 168 140 140 190 158 C230 172 250 140 290 150"
local shares = { 0.12, 0.26, 0.42, 0.58, 0.76, 0.92, 1, 1, 1, 1, 0, 0 }
local from = { 0, 0, 0, 0, 0, 0, 0.06, 0.24, 0.5, 0.78, 0, 0 }

return window.film { title = "The kettle", by = "ga", seconds = 2, drawing = function(_, number)
  local n = number // 2 + 1
  local up = ({ 10, 0, 16, 2, 22, 4, 16, 2, 10, 0, 0, 4 })[n]
  local boils = n < 8
  local sings = boils and ellipse { 226, 446, 10, 9 + up / 3, fill = "#43200f" }
    or line("M212 446 Q226 456 240 446", 6, "#43200f")
  return { room, handle, lid:translate(0, -up), pot:translate(0, boils and n % 2 * -3 or 0),
    (face | sings):translate(0, boils and n % 2 * -3 or 0),
    stroke { d = curl, width = 20, cap = "round", taper = { 0, 90 }, profile = "round",
      from = from[n], to = math.max(shares[n], 0.01), fill = rgb("#fff3d6", 0.75) } }
end }
