-- A goose in the cellar goes off on tiptoe with a fox under its wing; the fox looks at us.
local window = require "town.window"
local thieves = require "town.fox_goose"
local mood = require("stage.moods").storm

--- From right to left, while the fox next door goes from left to right.
local way = keys { { 0, 215 }, { 4, 215 }, { 13, 645 }, { 14, -150 }, { 22, 215 } }

local NIGHT = rect { 0, 0, 450, 600, fill = mood.ink }
local CELLAR = thieves.cellar()

return window.film { title = "The goose in the cellar", by = "in", seconds = 4, pane = "plain",
  drawing = function(_, number)
    local step = number // 2
    local x = way:at(step)
    local walked = (x - 215) / 344 + 0.28
    local goose, wing = thieves.goose(walked, step < 4 or step == 23, step < 4)
    local fox, dark = thieves.carried_fox(step == 1 or step == 2)
    goose, wing = (goose | wing):translate(x, 560), wing:translate(x, 560)
    fox, dark = fox:translate(x + 6, 388), dark:translate(x + 6, 388)
    local shown = { CELLAR ~ goose, fox, wing & fox | dark }
    for i, colour in ipairs { mood.light, mood.accent, mood.ink } do
      shown[i] = shown[i]:scale(-1, 1):translate(450, 0):paint(colour)
    end
    return { NIGHT, table.unpack(shown) }
  end }
