-- A dancer on a drawn blind: one pirouette, then still. Under the blind somebody learns it.
local window = require "town.window"
local dancers = require "town.dancers"
local mood = require("stage.moods").candle

--- Twelve drawings of two frames: how she has turned, how low she is, how far her leg is out behind
--- (0 the toe at the knee, 1 an arabesque), how far her arms are raised, and how her skirt tilts.
local dance = keys { { 0, { 0, 34, 0, 0, 0 } }, { 1, { 30, -6, 0, 0.6, 8 } },
  { 2, { 85, -10, 0, 1, -10 } }, { 3, { 145, -10, 0, 1, 10 } }, { 4, { 205, -10, 0, 1, -10 } },
  { 5, { 265, -10, 0, 1, 10 } }, { 6, { 320, -8, 0, 0.9, -8 } }, { 7, { 360, 4, 0.5, 0.5, -16 } },
  { 8, { 360, -4, 1.06, 0.2, -30 } }, { 9, { 360, 0, 1, 0.24, -22 } },
  { 10, { 360, 0, 1, 0.24, -24 } }, { 11, { 360, 20, 0.4, 0.1, -8 } } }

local ROOM = dancers.room()

return window.film { title = "Pirouette", by = "in", seconds = 2, pane = "plain",
  drawing = function(_, number)
    local turn, low, out, raised, tilt = table.unpack(dance:at(number // 2))
    local both = dancers.girl(turn, low, out, raised, tilt):translate(216, 516)
      | dancers.mouse(turn, low, out, raised):translate(352, 574)
    return { ROOM, both:paint(mood.ink) }
  end }
