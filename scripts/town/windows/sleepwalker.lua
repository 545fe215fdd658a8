-- A sleepwalker goes through with a candle; the cat behind him, and who is behind it, do the same.
-- All turn black in the moonlight on the wall.
local window = require "town.window"
local asleep = require "town.sleepwalkers"
local mood = require("stage.moods").storm

local FLOOR, LOOP = 560, 800
local NIGHT = rect { 0, 0, 450, 600, fill = mood.ink }
--- What only his candle shows: a portrait that sleeps, too.
local FACE = path { d = "M0 -34 C24 -34 28 -14 24 6 C20 30 10 36 0 36 C-10 36 -20 30 -24 6 "
  .. "C-28 -14 -24 -34 0 -34 Z M-46 62 C-46 38 -20 40 0 40 C20 40 46 38 46 62 Z" }
--- The moon through the window, on the wall.
local MOON = polygon { { 226, 250 }, { 400, 210 }, { 400, 470 }, { 226, 510 } }
local LIDS = stroke { d = "M-16 -4 q6 7 12 0 M4 -4 q6 7 12 0", width = 3.5 }
local PORTRAIT = (rect { -60, -62, 120, 136 } - rect { -50, -52, 100, 116 } | FACE - LIDS)
  :translate(130, 172)

--- Who they are, how far each is behind the first, and the radius of its light.
local TRAIN = { { asleep.man, 0, 104 }, { asleep.cat, 290, 0 }, { asleep.mouse, 430, 44 } }

return window.film { title = "The sleepwalker", by = "in", seconds = 4, pane = "plain",
  drawing = function(_, number)
    local step = number // 2
    local sway = math.sin(2 * math.pi * step / 6)
    local figures, lights, flames = {}, {}, {}
    for _, one in ipairs(TRAIN) do
      local x = (180 + LOOP * step / 24 - one[2] + 230) % LOOP - 230
      local figure, flame, light = one[1](step / 6, sway)
      figures[#figures + 1] = figure:translate(x, FLOOR)
      if one[3] > 0 then
        lights[#lights + 1] = circle { x + light[1], FLOOR + light[2], one[3] }
        flames[#flames + 1] = flame:translate(x, FLOOR)
      end
    end
    local lit = union(lights)
    return { NIGHT, ((MOON | (lit - PORTRAIT)) ~ union(figures)):paint(mood.light),
      union(flames):paint(mood.accent) }
  end }
