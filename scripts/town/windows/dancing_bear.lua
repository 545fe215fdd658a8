-- A bear in a tutu on a drawn blind: half as fast as the dancer, with twice the joy.
local window = require "town.window"
local dancers = require "town.dancers"
local mood = require("stage.moods").candle

--- Twelve poses: as in pirouette.lua, and how high the mouse is thrown.
local dance = keys { { 0, { 0, 40, 0, 0, 0, 0 } }, { 1, { 30, 0, 0, 0.6, 10, 0 } },
  { 2, { 85, -12, 0, 1, -12, 0 } }, { 3, { 145, -12, 0, 1, 12, 0 } },
  { 4, { 205, -12, 0, 1, -12, 0 } }, { 5, { 265, -12, 0, 1, 12, 0 } },
  { 6, { 320, 0, 0, 0.9, -10, 0 } }, { 7, { 360, 50, 0.2, 0.2, 10, 0 } },
  { 8, { 360, -70, 1, 0.6, -34, 0 } }, { 9, { 360, 60, 0.6, 0, 20, 46 } },
  { 10, { 360, 4, 1, 0.3, -22, 4 } }, { 11, { 360, 4, 1, 0.3, -22, 0 } },
  { 12, { 360, 40, 0, 0, 0, 0 } } }

local ROOM = dancers.room()

return window.film { title = "The dancing bear", by = "in", seconds = 4, pane = "plain",
  drawing = function(_, number)
    local turn, low, out, raised, tilt, thrown = table.unpack(dance:at(number // 2 / 2))
    local bear = dancers.bear(turn, low, out, raised, tilt):translate(216, 516 + math.min(0, low))
    local mouse = dancers.mouse(0, 0, thrown / 20, math.min(1, thrown)):translate(376, 574 - thrown)
    return { ROOM, (bear | mouse):paint(mood.ink) }
  end }
