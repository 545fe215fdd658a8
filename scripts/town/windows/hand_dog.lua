-- Hands throw a dog on the blind; then they go away, and the shadow barks without them.
local window = require "town.window"
local ink = require "town.silhouette"
local mood = require("stage.moods").candle

--- Both hands as a dog's head that looks to the left; the arms go down.
local SKULL = path { d = "M100 340 C104 270 92 210 112 140 C136 80 142 -40 56 -58 "
  .. "C14 -66 -16 -50 -34 -24 C-62 -18 -88 -22 -112 -34 C-146 -44 -154 -8 -132 0 "
  .. "C-146 12 -134 32 -112 32 L-30 36 C4 40 2 80 14 130 C24 200 -2 270 -10 340 Z" }
  - path { d = "M-6 -14 C4 -32 22 -32 34 -18 C22 -6 6 -4 -6 -14 Z" }
local FINGERS = stroke { d = "M-130 0 L-10 10 M80 -40 C96 10 84 60 50 90", width = 6,
  cap = "round" }
local EAR = path { d = "M30 -44 C40 -92 66 -128 82 -124 C98 -116 94 -70 98 -24 Z" }
local function dog(open, ears)
  local jaw = ink.limb({ 26, 58, 56 }, { -40, 66, 44 }, { -96, 52, 32 }):rotate(-open, 0, 56)
  return SKULL | jaw | EAR:rotate(ears, 70, -30) | EAR:rotate(ears * 1.4 + 36, 76, -24)
end

--- Twelve drawings of two frames: how far the jaw is open; the ears; the head to the left, down,
--- and its degrees; and where the hands are, 0 in the pose, 1 below.
local acting = keys { { 0, { 4, 0, 0, 0, 0, 0 } }, { 1, { 24, -6, 0, 0, 4, 0 } },
  { 2, { 4, 0, 0, 0, 0, 0 } }, { 3, { 24, -6, 0, 0, 4, 0 } }, { 4, { 4, 0, 0, 0, 0, 0.6 } },
  { 5, { 10, 16, 0, -10, 6, 1 } }, { 6, { 10, 16, 0, -10, 6, 1.04 } },
  { 7, { 46, -24, 6, 20, -8, 1.3 } }, { 8, { 8, 8, 0, 0, 0, 1.3 } },
  { 9, { 46, -24, 6, 20, -8, 1.5 } }, { 10, { 8, 8, 0, 0, 0, 1.5 } },
  { 11, { 4, 4, 0, 0, 0, 0.3 } } }

local BARK = stroke { d = "M34 374 L72 364 M42 398 L84 376 M72 430 L98 398", width = 10,
  cap = "round", fill = ink.shadow }
return window.film { title = "Dog of two hands", by = "in", seconds = 2, pane = "plain",
  drawing = function(_, number)
    local open, ears, left, down, degrees, below = table.unpack(acting:at(number // 2))
    local shadow = dog(open, ears):rotate(degrees, 60, 330):scale(1.1)
    local shown = { ink.blind(), shadow:translate(250 + left, 264 + down):paint(ink.shadow) }
    if open > 40 then shown[#shown + 1] = BARK end
    local low = 130 * below
    local hands = (dog(open, ears) - FINGERS):scale(0.5):translate(112, 474 + low)
    if below > 0.5 then
      hands = ink.hand():rotate(-14):translate(96, 440 + low)
        | ink.hand():scale(-1, 1):rotate(14):translate(200, 440 + low)
    end
    shown[#shown + 1] = hands:paint(mood.ink)
    return shown
  end }
