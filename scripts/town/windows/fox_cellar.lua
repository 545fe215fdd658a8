-- A fox in the cellar goes off on tiptoe with a goose under its arm; the goose looks at us.
local window = require "town.window"
local thieves = require "town.fox_goose"
local mood = require("stage.moods").storm

--- Where the fox is, in 24 drawings of two frames: it stands still in the light of the grating.
local way = keys { { 0, 215 }, { 4, 215 }, { 13, 645 }, { 14, -150 }, { 22, 215 } }

local NIGHT = rect { 0, 0, 450, 600, fill = mood.ink }
local CELLAR = thieves.cellar()

return window.film { title = "The fox in the cellar", by = "in", seconds = 4, pane = "plain",
  drawing = function(_, number)
    local step = number // 2
    local x = way:at(step)
    local walked = (x - 215) / 344 + 0.28
    local front, hush = step < 4 or step == 23, step < 4
    local fox, arm = thieves.fox(walked, front, hush, 6 * math.sin(math.pi * step / 3))
    local goose, dark = thieves.carried_goose(step < 14 or step > 20, step == 1 or step == 22)
    fox, arm = (fox | arm):translate(x, 560), arm:translate(x, 560)
    goose, dark = goose:translate(x + 6, 362), dark:translate(x + 6, 362)
    return { NIGHT, (CELLAR ~ fox):paint(mood.light), goose:paint(mood.accent),
      (arm & goose | dark):paint(mood.ink) }
  end }
