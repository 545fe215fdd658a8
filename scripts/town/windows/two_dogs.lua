-- Two dogs and one bone: the quarrel of two shadows once more, and the same end.
local window = require "town.window"
local ink = require "town.silhouette"
local mood = require("stage.moods").candle

--- In 24 drawings, each dog: how far to the other one, degrees of its body and of its head, the way
--- that its body and its head look, 1 to the other, and how its tail is.
local function acting(pull)
  return keys { { 0, { 8 * pull, -6 * pull, 6 * pull, 1, 1, 10 } },
    { 1, { -8 * pull, 6 * pull, -6 * pull, 1, 1, -10 } },
    { 2, { 8 * pull, -8 * pull, 8 * pull, 1, 1, 10 } },
    { 3, { -8 * pull, 8 * pull, -8 * pull, 1, 1, -10 } },
    { 4, { 8 * pull, -8 * pull, 8 * pull, 1, 1, 10 } }, { 5, { -26, -10, -30, 1, 1, 30 } },
    { 7, { -26, -10, -34, 1, 1, 30 } }, { 8, { -10, 0, 14, 1, 1, 0 } },
    { 9, { -30, 0, 24, -1, -1, -20 } }, { 12, { -30, 0, 24, -1, -1, -20 } },
    { 13, { -30, 0, pull > 0 and 4 or 24, -1, pull > 0 and 1 or -1, -10 } },
    { 14, { -30, 0, pull > 0 and 24 or 4, -1, pull > 0 and -1 or 1, -10 } },
    { 15, { 0, 0, 10, 1, 1, 0 } }, { 16, { 48, 8, 16, 1, 1, 20 } },
    { 17, { 52, 9, 18, 1, 1, -20 } }, { 18, { 52, 9, 18, 1, 1, 20 } },
    { 19, { 52, 9, 18, 1, 1, -20 } }, { 20, { 52, 9, 18, 1, 1, 20 } },
    { 21, { 40, 8, 24, 1, 1, 0 } }, { 22, { 10, 4, 36, 1, 1, 0 } },
    { 23, { 0, 0, 0, 1, 1, 10 } } }
end
local first, second = acting(1), acting(-1)

--- The bone: right, down, degrees.
local bone = keys { { 0, { 204, 344, 0 } }, { 1, { 246, 344, 0 } }, { 2, { 194, 344, 0 } },
  { 3, { 256, 344, 0 } }, { 4, { 194, 344, 0 } }, { 5, { 225, 220, -60 } },
  { 6, { 225, 150, -150 } }, { 7, { 225, 200, -240 } }, { 8, { 225, 544, -340 } },
  { 9, { 225, 544, -360 } }, { 21, { 225, 544, -360 } }, { 22, { 225, 470, -360 } },
  { 23, { 225, 350, -360 } } }

local BODY = path { d = "M-96 40 C-130 -60 -100 -150 -40 -196 C-10 -224 0 -250 16 -280 L84 -244 "
  .. "C92 -160 78 -80 84 40 Z" }
local HEADS = { path { d = "M-54 20 C-64 -34 -30 -64 8 -62 C34 -60 44 -46 54 -36 L110 -20 "
    .. "C122 -12 118 10 108 12 L44 28 C20 44 -30 50 -54 20 Z" }
  | path { d = "M-36 -48 C-76 -40 -84 20 -66 54 C-48 70 -24 40 -20 -10 Z" },
  path { d = "M-50 20 C-58 -30 -30 -58 0 -58 C26 -56 40 -44 52 -30 L112 -16 C122 -8 118 12 108 14 "
    .. "L44 30 C20 46 -30 48 -50 20 Z" }
  | path { d = "M-44 -20 C-60 -70 -50 -100 -40 -116 C-16 -100 0 -76 6 -44 Z" } }
local EYE = ellipse { 26, -22, 9, 7 }
local function bone_shape(grow)
  local knob = 13 + grow
  return rect { -40, -9 - grow, 80, 18 + 2 * grow } | circle { -42, -11, knob }
    | circle { -42, 11, knob } | circle { 42, -11, knob } | circle { 42, 11, knob }
end

local function dog(head, pose)
  local ahead, lean, nod, way, look, wag = table.unpack(pose)
  local tail = ink.limb({ -86, 0, 30 }, { -150, -10, 26 }, { -142 - wag, -90, 12 })
  if ahead < 40 then head = head - EYE end -- nearer, both shut their eyes
  return ((BODY | tail):scale(way, 1)
    | head:rotate(nod):scale(look, 1):translate(36 * way, -270)):rotate(lean):scale(0.9)
    :translate(84 + ahead, 580)
end

local WALL = ink.wall(450, 600, 225, 330, { "#fff4d8", mood.light, "#e0862b" })

return window.film { title = "Two dogs and a bone", by = "in", seconds = 4,
  drawing = function(_, number)
    local step = number // 2
    local x, y, degrees = table.unpack(bone:at(step))
    local dogs = dog(HEADS[1], first:at(step))
      | dog(HEADS[2], second:at(step)):scale(-1, 1):translate(450, 0)
    local shape = bone_shape(6):paint(mood.ink) | bone_shape(0):paint("#fff4d8")
    return { WALL, dogs:paint(mood.ink), shape:rotate(degrees):translate(x, y) }
  end }
