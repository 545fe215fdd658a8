-- An old man looks through a telescope at the girl two houses on; then he turns it the right way.
local window = require "town.window"
local telescope = require "town.telescope"
local mood = require("stage.moods").storm

--- In 24 drawings: how long the tube is, and how high he hops.
local acting = keys { { 0, { 180, 0 } }, { 5, { 180, 0 } }, { 6, { 150, 6 } }, { 8, { 150, 6 } },
  { 9, { 40, 0 } }, { 10, { 190, 0 } }, { 11, { 196, -14 } }, { 12, { 196, 0 } },
  { 20, { 196, 0 } }, { 21, { 40, 0 } }, { 22, { 190, 0 } }, { 23, { 180, 0 } } }

local WALL = rect { 0, 0, 450, 600, fill = mood.accent }
  | circle { 200, 300, 190, fill = mood.light }

return window.film { title = "The old man with the telescope", by = "in", seconds = 4,
  drawing = function(_, number)
    local step = number // 2
    local long, hop = table.unpack(acting:at(step))
    local wrong, wave = step < 9 or step > 20, nil
    if step > 12 and step < 20 then wave = step % 2 == 0 and -20 or 16 end
    local man = telescope.watcher("man", long, wrong, wave):translate(196, 330 + hop)
    return { WALL, man:scale(-1, 1):translate(450, 0):paint(mood.ink) }
  end }
