-- The viola of the quartet: she nods off, her bow does not, and she wakes for the last two notes.
local gouache = require "town.gouache"
local strings = require "town.strings"
local violinist = require "town.violinist"
local window = require "town.window"
local form = gouache.form

local room = union {
  gouache.wall(66, 230, 480, "#fff0c4", "#efb65e", "#b86a2c", "#7a4420"),
  form("#8a4420", "M0 552 H450 V600 H0 Z"), form("#9a5527", "M338 132 H424 V196 H338 Z"),
  form("#e9b064", "M346 140 H416 V188 H346 Z"), form("#9a5527", "M346 188 L374 158 L392 176 "
    .. "L400 166 L416 188 Z"), strings.desk(66),
}
local hair = form("#c9a878", "M-60 8 C-70 -44 -36 -70 0 -70 C36 -70 70 -44 60 8 "
  .. "C60 52 46 60 34 58 L-34 58 C-50 58 -58 46 -60 8 Z")
local fringe = form("#e6cfa4", "M-54 4 C-60 -46 -32 -66 4 -66 C38 -66 60 -42 54 4 "
  .. "C40 0 16 -12 6 -40 C-4 -14 -34 2 -54 4 Z")
local nod = gouache.track({ 0, { 0, 0 } }, { 3, { 0, 2 } }, { 9, { 6, 16 } }, { 10, { 4, 10 } },
  { 16, { 8, 24 } }, { 17.5, { -6, -12 }, "outQuad" }, { 21, { 0, 0 } }, { 24, { 0, 0 } })

return window.film { title = "The viola", by = "ga", seconds = 4, drawing = function(_, number)
  local drawing = number // 3
  local n = 1.5 * drawing
  local awake = n < 3 or n >= 17
  return { room, strings.flame(66, drawing % 2 * 2 - 1), violinist(n, { coat = "#7a5a2c",
    shade = "#4a3218", sleeve = "#a88440", size = 0.62, rise = 0, finger = 10 - drawing % 2 * 4,
    head = nod:at(n), behind = hair, front = fringe, eyes = awake and "open" or "shut",
    brow = n >= 17 and n < 21 and 9 or awake and 2 or -3, brows = "#a88454",
    mouth = awake and n > 3 and "M-6 36 Q0 30 6 36 Q0 42 -6 36"
      or not awake and "M-4 36 Q0 40 4 36" }) }
end }
