-- Chess of two old men: when one nods off, the other turns the board round.
local window = require "town.window"
local club = require "town.chess_room"
local mood = require("stage.moods").candle

--- One man's turn of 24 drawings: degrees of his head, where his hand is, how far his eye is open.
local acting = keys { { 0, { 4, 52, -150, 1 } }, { 1, { 18, 54, -140, 0.5 } },
  { 2, { 10, 54, -140, 0.5 } }, { 3, { 30, 56, -100, 0 } }, { 4, { 42, 60, -84, 0 } },
  { 9, { 42, 60, -84, 0 } }, { 10, { -20, 40, -60, 1.5 } }, { 11, { 18, 54, -140, 1.3 } },
  { 12, { 14, 52, -150, 1 } }, { 13, { 14, 52, -150, 1 } }, { 14, { -4, 52, -150, 1 } },
  { 15, { 12, 70, -104, 1 } }, { 16, { 22, 60, 4, 1 } }, { 17, { 26, 110, -2, 1 } },
  { 18, { 26, 164, -6, 1 } }, { 19, { 26, 164, -6, 1 } }, { 20, { 10, 90, -90, 1 } },
  { 21, { -8, 52, -150, 0 } }, { 23, { -8, 52, -150, 0 } }, { 24, { 4, 52, -150, 1 } } }

local ARMY = { { -58, -42, 60 }, { -66, 4, 74 }, { -58, 44, 48 }, { -20, -30, 44 },
  { -22, 26, 38 }, { 62, 0, 46, true } }

local turned = keys { { 16, 0 }, { 17, 50 }, { 18, 130 }, { 19, 180 } }

return window.film { title = "Chess", by = "in", seconds = 4, drawing = function(_, number)
  local step = number // 2
  local thin, arm = club.man(club.thin, table.unpack(acting:at(step)))
  local stout, other_arm = club.man(club.stout, table.unpack(acting:at((step + 12) % 24)))
  local function left(object) return object:translate(96, 280) end
  local function right(object) return object:scale(-1, 1):translate(354, 280) end
  local degrees = step < 12 and turned:at(step + 12) or 180 + turned:at(step)
  return { club.wall, (left(thin) | right(stout) | club.furniture):paint(mood.ink),
    club.board(degrees + 14, ARMY), (left(arm) | right(other_arm)):paint(mood.ink) }
end }
