-- A cellar without light: two eyes, four, six, that blink in turn; and two that see all others.
local window = require "town.window"
local thieves = require "town.fox_goose"
local mood = require("stage.moods").storm

local NIGHT = rect { 0, 0, 800, 400, fill = mood.ink }
local BEAK = path { d = "M474 150 L494 172 L474 194 L454 172 Z" }
local FOX = thieves.fox_head(true):scale(1.2):translate(140, 262)
  | path { d = "M60 400 C60 240 220 240 224 400 Z" }
local GOOSE = (circle { 474, 160, 54 } | path { d = "M448 190 H500 C506 260 520 330 540 400 H420 "
    .. "C438 340 448 270 448 190 Z" }) - BEAK
local MOUSE = path { d = "M620 400 C606 320 620 282 656 282 C692 282 706 320 692 400 Z" }
  | circle { 622, 278, 25 } | circle { 690, 278, 25 }

--- A pair of eyes about (x, y): how far apart, their radius, how far they are open, and how
--- wide the pupils are as a share of the radius.
local function pair(x, y, apart, radius, open, slit)
  local one = ellipse { x - apart / 2, y, radius, radius * open }
    - ellipse { x - apart / 2, y, radius * slit, radius * 0.8 * open }
  return one | one:translate(apart, 0)
end

--- Twelve drawings of two frames: how far they are open: the fox, the goose, the mouse, all others.
local opened = keys { { 0, { 1, 0, 0, 0 } }, { 1, { 1, 0.4, 0, 0 } }, { 2, { 0.1, 1, 0, 0 } },
  { 3, { 1, 1, 0.5, 0 } }, { 4, { 1, 0.1, 1, 0 } }, { 5, { 1, 1, 0.1, 0 } },
  { 6, { 1, 1, 1, 0.06 } }, { 7, { 1, 1, 1, 0.6 } }, { 8, { 1.3, 1.2, 1.4, 1 } },
  { 10, { 1.3, 1.2, 1.4, 1 } }, { 11, { 0.1, 0.1, 0.1, 0.06 } } }

return window.film { title = "Eyes in the cellar", by = "in", seconds = 2, size = { 800, 400 },
  pane = "plain", drawing = function(_, number)
    local fox, goose, mouse, all = table.unpack(opened:at((number // 2 + 8) % 12))
    local shown = { NIGHT }
    if all > 0 then
      shown[2] = (pair(400, 186, 340, 156, all, 0.3) - (FOX | GOOSE | MOUSE)):paint(mood.light)
    end
    local eyes = pair(140, 235, 70, 30, fox, 0.3)
    if goose > 0 then eyes = eyes | pair(474, 136, 58, 24, goose, 0.5) end
    if mouse > 0 then eyes = eyes | pair(656, 312, 36, 11, mouse, 0.5) end
    shown[#shown + 1] = eyes:paint(mood.accent)
    return shown
  end }
