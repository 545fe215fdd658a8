-- A cat walks asleep with a candle; the sleepwalker behind it in the same pose.
local window = require "town.window"
local asleep = require "town.sleepwalkers"
local mood = require("stage.moods").storm

local FLOOR, LOOP = 560, 800
local NIGHT = rect { 0, 0, 450, 600, fill = mood.ink }
--- What only its candle shows, a little above a cat: a mouse, who sleeps, too.
local MOUSE = path { d = "M-30 4 C-30 -30 30 -30 30 4 C28 30 12 44 0 50 C-12 44 -28 30 -30 4 Z" }
  | circle { -32, -24, 19 } | circle { 32, -24, 19 }
local LIDS = path { d = "M-20 4 q7 10 14 0 q-7 5 -14 0 Z M6 4 q7 10 14 0 q-7 5 -14 0 Z" }
local PORTRAIT = (rect { -62, -62, 124, 130 } - rect { -53, -53, 106, 112 } | MOUSE - LIDS)
  :scale(0.56):translate(240, 300)

return window.film { title = "The cat walks asleep", by = "in", seconds = 4, pane = "plain",
  drawing = function(_, number)
    local step = number // 2
    local sway = math.sin(2 * math.pi * step / 6)
    local function place(behind) return (310 + LOOP * step / 24 - behind + 230) % LOOP - 230 end
    local cat, flame, light = asleep.cat(step / 6, sway, true)
    local man = asleep.man(step / 6, sway, true)
    local x = place(0)
    local lit = circle { x + light[1], FLOOR + light[2], 120 }
    local moon = polygon { { 150, 130 }, { 330, 90 }, { 330, 400 }, { 150, 440 } }
    local figures = cat:translate(x, FLOOR) | man:translate(place(210), FLOOR)
    local shapes = moon ~ (lit - PORTRAIT) ~ figures
    return { NIGHT, shapes:scale(-1, 1):translate(450, 0):paint(mood.light),
      flame:translate(x, FLOOR):scale(-1, 1):translate(450, 0):paint(mood.accent) }
  end }
