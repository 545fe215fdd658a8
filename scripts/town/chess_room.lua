-- A table under a lamp, with a board of chess, and the two old men who sit at it.
local ink = require "town.silhouette"
local mood = require("stage.moods").candle

local chess_room = {}

local PALE, TINT = "#fff4d8", "#b8541f"

chess_room.thin = path { d = "M-24 30 C-26 0 -46 -30 -44 -66 C-40 -104 -6 -118 24 -104 "
    .. "C40 -96 44 -84 43 -72 C60 -64 84 -42 78 -34 C72 -28 56 -32 46 -34 L47 -24 "
    .. "C42 -20 46 -12 42 -6 C36 2 24 0 14 0 L20 34 Z" }
  | path { d = "M-40 -84 C-66 -96 -78 -72 -64 -64 C-78 -58 -66 -40 -42 -48 Z" }
  | path { d = "M44 -36 C64 -34 70 -16 62 -2 C60 -16 48 -20 36 -22 Z" }
chess_room.stout = path { d = "M-34 34 C-34 10 -54 -20 -50 -60 L48 -64 C58 -58 72 -44 66 -34 "
    .. "C60 -28 52 -30 50 -30 C60 -6 70 20 50 48 C20 54 16 40 10 30 Z" }
  | path { d = "M-56 -52 C-66 -92 -40 -116 2 -112 C40 -110 46 -86 48 -74 L84 -66 "
    .. "C86 -58 74 -58 60 -58 Z" }
  | path { d = "M48 -24 L84 -14 L86 -34 L110 -34 C112 -8 104 0 84 -2 L46 -16 Z" }
local COAT = path { d = "M-96 220 C-104 60 -96 -6 -36 -20 C-6 -28 20 -22 34 10 "
  .. "C60 70 52 120 66 220 Z" }

--- A man whose neck is at (0, 0), looking to the right: one of the heads above, turned by degrees,
--- his hand at x, y, his eye open, 0 to 1. Returns him without his arm, and the arm.
function chess_room.man(head, turn, x, y, open)
  local thin = head == chess_room.thin
  local spectacles = thin and circle { 38, -66, 15 } - circle { 38, -66, 12 } or union {}
  local eye = ink.eye(34, thin and -66 or -50, 10, open, 0.6)
  local sunk = 0.3 * math.max(0, turn)
  local arm = ink.limb({ 0, 60, 44 }, { 60, 200 + y / 3, 40 }, { x + 20, y + 186, 34 })
  return COAT | ((head - eye) | spectacles):rotate(turn):translate(sunk, sunk), arm
end

--- A piece with its foot at (x, y).
function chess_room.piece(high, x, y, fill)
  local w, neck = 4 + high / 7, -0.6 * high
  return path { fill = fill, d = ("M%g %g l%g %g c%g %g %g %g %g 0 l%g %g Z"):format(x - w, y,
    w - 4, neck, -high / 3, -0.55 * high, high / 3 + 8, -0.55 * high, 8, w - 4, -neck) }
end

--- The board, turned by degrees, and its pieces, { x, y, height, whether it is black } from the
--- board's middle.
function chess_room.board(degrees, pieces)
  local c, s = math.cos(math.rad(degrees)), math.sin(math.rad(degrees))
  local function place(x, y) return 225 + x * c - y * s, 492 + 0.42 * (x * s + y * c) end
  local function field(x, y, w, h)
    return polygon { { place(x, y) }, { place(x + w, y) }, { place(x + w, y + h) },
      { place(x, y + h) } }
  end
  local dark, men = {}, {}
  for i = 0, 7 do
    dark[i + 1] = field(-88 + 44 * (i % 4), -64 + 64 * (i // 4) + 32 * (i % 2), 44, 32)
  end
  for i, one in ipairs(pieces) do
    local x, y = place(one[1], one[2])
    men[i] = { y, chess_room.piece(one[3], x, y + 4, one[4] and mood.ink or PALE) }
  end
  -- Who is farther away comes first.
  table.sort(men, function(one, other) return one[1] < other[1] end)
  for i, one in ipairs(men) do men[i] = one[2] end
  return union { field(-96, -72, 192, 144):paint(mood.light), union(dark):paint(TINT), union(men) }
end

chess_room.wall = ink.wall(450, 600, 225, 300, { PALE, mood.light, "#e0862b" })
local lamp = path {
  d = "M221 0 H229 V150 C262 156 284 184 290 214 H160 C166 184 188 156 221 150 Z" }
local slab = path { d = "M0 452 Q225 436 450 452 V600 H0 Z" }
--- The lamp and the table, as one shape.
chess_room.furniture = lamp | slab

return chess_room
