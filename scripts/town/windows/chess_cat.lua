-- Chess against a cat, who moves a piece off the table.
local window = require "town.window"
local club = require "town.chess_room"
local ink = require "town.silhouette"
local mood = require("stage.moods").candle

--- In 24 drawings, the man: degrees of his head, where his hand is, how far his eye is open.
local man = keys { { 0, { 16, 54, -150, 1 } }, { 9, { 16, 54, -150, 1 } },
  { 10, { -14, 50, -150, 1.5 } }, { 12, { -14, 50, -150, 1.5 } }, { 13, { 6, 54, -150, 0.6 } },
  { 15, { 6, 54, -150, 0.6 } }, { 16, { 40, 90, 10, 0.6 } }, { 17, { 56, 100, 40, 0.6 } },
  { 18, { 30, 104, -20, 1 } }, { 19, { 26, 126, -4, 1 } }, { 20, { 26, 126, -4, 1 } },
  { 21, { 18, 70, -110, 1 } }, { 22, { 16, 54, -150, 1 } }, { 24, { 16, 54, -150, 1 } } }
--- The cat: degrees of its head, how far its eyes are open, where they look, and its paw.
local cat = keys { { 0, { 4, 1, -1, 344, 440 } }, { 2, { 4, 1, -1, 344, 440 } },
  { 3, { -8, 0.7, -1, 306, 470 } }, { 4, { -8, 0.7, -1, 298, 484 } },
  { 5, { 8, 1.2, -1, 298, 484 } }, { 6, { 8, 1.2, -1, 298, 484 } },
  { 7, { -10, 0.7, -0.8, 282, 500 } }, { 8, { -14, 1.2, -0.6, 264, 506 } },
  { 9, { -16, 1.2, -0.6, 284, 500 } }, { 10, { 10, 0, 0, 344, 440 } },
  { 15, { 10, 0, 0, 344, 440 } }, { 16, { 4, 1, -1, 344, 440 } }, { 24, { 4, 1, -1, 344, 440 } } }
--- The piece: right, down, degrees; it is away until the man puts it back.
local piece = keys { { 2, { 268, 496, 0 } }, { 4, { 268, 496, 0 } }, { 5, { 262, 502, 0 } },
  { 6, { 262, 502, 0 } }, { 7, { 250, 514, -8 } }, { 8, { 236, 534, -40 } },
  { 9, { 204, 566, -120 } }, { 10, { 210, 700, 0 } }, { 18, { 210, 700, 0 } },
  { 19, { 262, 492, 0 } }, { 20, { 268, 496, 0 } } }

local PIECES = { { -66, 4, 60, true }, { -40, -38, 44, true }, { -50, 42, 40, true },
  { 62, -40, 52 }, { 66, 34, 44 } }
local BOARD = club.board(14, PIECES)
local BODY = path { d = "M384 300 C436 330 470 420 460 600 H300 C296 520 306 430 330 380 Z" }
local FACE = path { d = "M-69 3 C-78 -51 -39 -78 6 -78 C51 -78 81 -48 75 3 C69 48 36 66 6 66 "
    .. "C-30 66 -63 45 -69 3 Z" } | path { d = "M-66 -20 C-70 -70 -62 -100 -50 -122 L0 -60 Z" }
  | path { d = "M16 -66 L62 -120 C76 -90 80 -50 72 -10 Z" }

return window.film { title = "Chess with a cat", by = "in", seconds = 4,
  drawing = function(_, number)
    local step = number // 2
    local player, arm = club.man(club.thin, table.unpack(man:at(step)))
    local nod, open, look, x, y = table.unpack(cat:at(step))
    local face = FACE - (ink.eye(-24, -8, 17, open, look) | ink.eye(34, -8, 17, open, look)
      | path { d = "M-4 22 H12 L4 30 Z" })
    local paw = ink.limb({ 372, 400, 60 }, { 340, 410, 44 }, { x, y, 32 })
    local px, py, degrees = table.unpack(piece:at(step))
    return { club.wall, (player:translate(96, 280) | BODY | club.furniture
      | face:rotate(nod):translate(352, 290)):paint(mood.ink), BOARD,
      club.piece(66, 0, 0, "#fff4d8"):rotate(degrees):translate(px, py),
      (arm:translate(96, 280) | paw):paint(mood.ink) }
  end }
