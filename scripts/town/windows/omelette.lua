-- The omelette: while the cook looks at the ceiling, it looks out of the pan with its one yolk.
local window = require "town.window"
local cut = require "town.cutout"
local mood = require("stage.moods").noon
local kitchen = require "town.kitchen"(mood)

local WHITE, YOLK = "#fffdf4", "#f6b52e"
local FLAT = cut.piece("M-54 8 C-62 -8 -30 -14 0 -12 C34 -16 62 -8 54 8 Z", WHITE, mood.sky[1])
  | cut.piece("M-18 -8 C-14 -28 14 -28 18 -8 Z", YOLK)
local RISEN = cut.piece("M-44 12 C-58 -10 -46 -40 -52 -84 C-50 -134 48 -138 52 -84 C46 -40 60 -10 "
  .. "46 12 Z", WHITE, mood.sky[1]) | cut.disc(0, -78, 31, YOLK)

--- How far the cook looks up in each drawing; and how far the omelette is out, and where it looks.
local LOOK = { 8, 8, 8, 8, -8, -24, -24, -24, -24, -24, -24, -24, -24, -24, -24, -24, -24, -24,
  -24, -24, -8, 8, 8, 8 }
local EGG = { { 0 }, { 0 }, { 0 }, { 0 }, { 0 }, { 0 }, { 0.4, 0 }, { 1.1, -1 }, { 1, -1 },
  { 1, -1 }, { 1, -1 }, { 1, 1 }, { 1, 1 }, { 1, 1 }, { 1, 0 }, { 1, 0 }, { 1, 0, true }, { 1, 0 },
  { 1, 0 }, { 1.1, -1 }, { 0.3, -1 }, { 0 }, { 0 }, { 0 } }

local function egg(out, look, blink)
  if out == 0 then return FLAT end
  local pupil = blink and rect { -24, -81, 48, 6, fill = mood.ink }
    or circle { 13 * look, -78, 11, fill = mood.ink }
      | circle { 13 * look + 4, -82, 4, fill = WHITE }
  return (RISEN | pupil):scale(1.2 - 0.2 * out, out)
end

return window.film { title = "The omelette", by = "cp", seconds = 2, pane = "plain",
  drawing = function(_, number)
    local out, look, blink = table.unpack(EGG[number + 1])
    return { kitchen.room, kitchen.cook(LOOK[number + 1]),
      cut.laid(egg(out, look, blink):translate(330, 438)), kitchen.pan(448) }
  end }
