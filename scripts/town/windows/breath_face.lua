-- In the tram a child draws a face into its breath on the pane; it fades, smiling.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").snow
local wash, form, line = gouache.wash, gouache.form, gouache.line

local SKIN = wash(200, 0, 420, 0, "#fbd9ad", "#eab184", "#b9795a")
local COAT = wash(120, 0, 460, 0, "#4a6a80", mood.ink, "#182838")

local room = union {
  gouache.wall(120, 130, 640, "#fff0c9", "#e8bd78", "#b07a4c", "#7a5040"),
  form("#8a5a44", "M0 60 H600 V84 H0 Z"), line("M140 84 V150 M330 84 V150", 10, "#6b4436"),
  circle { 140, 182, 32 }:stroke { width = 12, fill = "#c98f5c" },
  circle { 330, 182, 32 }:stroke { width = 12, fill = "#c98f5c" },
  form("#8a5a44", "M470 210 C480 180 600 180 600 210 V600 H470 Z"),
}
local body = gouache.edged(form(COAT, "M110 640 C110 520 150 440 230 424 H350 "
  .. "C430 440 470 520 474 640 Z"), "#8fb0c4",
  "#152433", 7, 4)
local scarf = form(mood.accent, "M208 420 C240 452 340 452 372 420 C384 440 384 462 372 474 "
  .. "C330 498 250 498 208 474 C196 462 196 440 208 420 Z") | form("#a81d30", "M330 470 "
  .. "L376 462 L392 560 L346 568 Z")
local cap = form(mood.accent, "M-58 -6 C-64 -60 -34 -78 0 -78 C34 -78 64 -60 58 -6 "
  .. "C30 -20 -30 -20 -58 -6 Z")
  | form("#fdf3e0", "M-62 -22 C-30 -36 30 -36 62 -22 C66 -8 64 4 60 8 C30 -6 -30 -6 -60 8 "
  .. "C-66 2 -66 -10 -62 -22 Z")
  | circle { 0, -84, 18, fill = "#fdf3e0" }

local mist = union { circle { 330, 300, 110 }, circle { 260, 330, 74 }, circle { 404, 330, 76 },
  circle { 300, 238, 66 },
  circle { 370, 244, 64 } }
--- Two eyes and a smile, drawn one after another.
local drawn = { "M292 250 V276", "M292 250 V276 M372 250 V276", "M292 250 V276 M372 250 V276 "
  .. "M276 320 Q300 352 332 356",
  "M292 250 V276 M372 250 V276 M276 320 Q332 388 388 320" }
local finger = gouache.track({ 4, { 440, 470 } }, { 5, { 292, 254 } }, { 6, { 292, 278 } },
  { 7, { 372, 278 } },
  { 8, { 276, 320 } }, { 9, { 332, 358 } }, { 10, { 388, 320 } }, { 12, { 440, 480 } })

return window.film { title = "A face of breath", by = "ga", seconds = 4, size = { 600, 600 },
  pane = "round",
  drawing = function(_, number)
    local n = number // 2
    local grown = gouache.exposed(n, { 1, 0.25 }, { 1, 0.6 }, { 1, 0.88 }, { 21, 1 })
    local shown = n < 12 and 0.85 or 0.85 * (11 - n // 2) / 6
    local lines = n >= 5 and drawn[math.max(1, math.min(4, n - 5))]
    local x, y = table.unpack(finger:at(n))
    local blows = n <= 2
    local done = n >= 11
    local sleeve = gouache.arm { from = { 420, 520 }, to = { x + 12, y + 40 },
      parts = { 150, 150 }, side = -1,
      widths = { 90, 80, 56 }, fill = wash(300, 0, 470, 0, "#3a566c", "#182838") }
    return { room, body, scarf,
      gouache.head { x = 290, y = 330, scale = 1.75, skin = SKIN, face = { done and 0
        or 5, blows and 2 or -4 },
        front = cap, eyes = done and n < 18 and "happy" or "open", brow = done and 6 or 0,
        mouth = blows and "M-7 34 Q0 26 7 34 Q0 44 -7 34" or done and "M-13 30 Q0 44 13 30"
          or nil },
      n < 22 and mist:scale(grown, grown, 330, 330):paint(rgb("#f3f6f6", shown)) or union {},
      lines and n < 22 and line(lines, 15, n < 12 and "#8a5a44" or rgb("#8a5a44",
        math.min(1, shown * 1.6)))
        or union {},
      n >= 4 and n < 12 and sleeve | form(mood.accent, "M-14 0 C-10 -10 10 -10 12 2 L22 30 "
        .. "C44 36 48 70 24 78 C-8 84 -24 60 -12 34 Z"):translate(x, y) or union {} }
  end }
