-- A girl looks through a telescope at the window two houses on, where somebody looks at hers.
local window = require "town.window"
local telescope = require "town.telescope"
local mood = require("stage.moods").storm

--- In 24 drawings: how long the tube is, how high she hops, and her wave, in degrees.
local acting = keys { { 0, { 170, 0 } }, { 3, { 170, 0 } }, { 4, { 200, 0 } }, { 5, { 190, 0 } },
  { 13, { 190, 0 } }, { 14, { 190, -26 } }, { 15, { 190, 0 } }, { 16, { 190, -26 } },
  { 17, { 190, 0 } }, { 18, { 190, -26 } }, { 19, { 190, 0 } }, { 21, { 190, 0 } },
  { 22, { 160, 0 } }, { 23, { 170, 0 } } }

local WALL = rect { 0, 0, 450, 600, fill = mood.accent }
  | circle { 250, 300, 190, fill = mood.light }

return window.film { title = "The girl with the telescope", by = "in", seconds = 4,
  drawing = function(_, number)
    local step = number // 2
    local long, hop = table.unpack(acting:at(step))
    local wave = nil
    if step > 5 and step < 13 then wave = step % 2 == 0 and -20 or 16 end
    return { WALL, telescope.watcher("girl", long, false, wave):translate(232, 320 + hop)
      :paint(mood.ink) }
  end }
