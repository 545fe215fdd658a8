-- The first violin of the quartet: on the high note he rises to his toes, and his hair with him.
local gouache = require "town.gouache"
local strings = require "town.strings"
local violinist = require "town.violinist"
local window = require "town.window"
local form = gouache.form

local room = union {
  gouache.wall(66, 230, 480, "#ffe2a0", "#e79a45", "#a8551f", "#6b3418"),
  form("#93481f", "M340 140 H450 V560 H340 Z"), form("#7a3c1c", "M352 150 H450 V550 H352 Z"),
  form("#8a4420", "M0 552 H450 V600 H0 Z"), strings.desk(66),
}
local lock = form("#43200f", "M-54 0 C-66 -50 -34 -76 6 -72 C46 -74 62 -34 52 8 "
  .. "C44 -14 40 -26 20 -36 C-6 -30 -34 -26 -54 0 Z")

--- The hair over his brow, which flies up when he drops, and falls over an eye.
local function quiff(up)
  return lock | form("#5e2c15", "M-30 -50 C-10 %g 40 %g 56 %g C50 -36 20 -34 -8 -42 Z",
    -84 - 16 * up,
    -104 - 16 * up, -50 - 46 * up)
end

local rise = gouache.track({ 0, 0 }, { 9, 0 }, { 10, -4 }, { 12, 22, "outQuad" }, { 17, 24 },
  { 18, -6, "inQuad" }, { 20, 0 }, { 24, 0 })

return window.film { title = "First violin", by = "ga", seconds = 4, drawing = function(_, number)
  local drawing = number // 3
  local n = 1.5 * drawing
  local high = n >= 11 and n < 18
  return { room, strings.flame(66, drawing % 2 * 2 - 1), violinist(n, { coat = "#6b2a18",
    shade = "#3f1a12",
    sleeve = "#a8431f", size = 0.52, rise = math.floor(rise:at(n)),
      finger = high and 40 - drawing % 2 * 6 or 8,
    head = { high and 4 or -2, high and -6 or 2 }, behind = ellipse { 0, -8, 56, 60,
      fill = "#43200f" },
    front = quiff(n == 18 and 1 or n == 19.5 and 0.4 or high and -0.3 or 0), eyes = "shut",
    brow = high and 7 or 0, mouth = high and "M-8 36 Q2 30 10 36" or nil }) }
end }
