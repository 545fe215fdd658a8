-- One cactus in a pot: a bud, much patience, and a flower that goes bang.
local window = require "town.window"
local cut = require "town.cutout"
local glasshouse = require "town.glasshouse"
local mood = require("stage.moods").noon

local PINK, GOLD = "#e44a7c", "#f1c84b"

local BODY = cut.piece("M-52 0 L-58 -150 C-60 -236 60 -236 58 -150 L52 0 Z", mood.near)
local ARMS = cut.piece("M-40 -70 C-110 -66 -116 -100 -112 -150 C-106 -166 -84 -164 -82 -148 "
  .. "C-84 -116 -80 -110 -40 -116 Z", mood.near)
  | cut.piece("M40 -100 C112 -96 120 -140 114 -186 C106 -202 86 -200 84 -184 C86 -150 80 -146 "
    .. "40 -146 Z", mood.near)
local thorns = {}
for i, place in ipairs { { -30, -40 }, { 34, -30 }, { 20, -70 }, { -98, -120 }, { 98, -150 },
  { -20, -186 }, { 36, -160 } } do
  thorns[i] = polygon { { place[1] - 7, place[2] - 8 }, { place[1], place[2] + 4 },
    { place[1] + 7, place[2] - 8 }, { place[1], place[2] - 2 }, fill = mood.light }
end
local CACTUS = ARMS | BODY | union(thorns)
local POT = cut.laid(glasshouse.pot:scale(1.5, 1.3))

local BUD = cut.piece("M-16 6 C-24 -20 -8 -40 0 -50 C8 -40 24 -20 16 6 Z", PINK)
local PETAL = cut.piece("M0 0 C-44 -30 -38 -92 0 -104 C38 -92 44 -30 0 0 Z", PINK)
local BANG = star { 0, 0, 132, 62, points = 11, fill = cut.WHITE }
  | star { 0, 0, 118, 54, points = 11, fill = GOLD }
local flower = {}
for i = 1, 7 do flower[i] = PETAL:rotate(360 / 7 * i + 12, 0, 0) end
local FLOWER = union(flower) | cut.disc(0, 0, 34, GOLD)

--- Its face: "asleep", "up", "shut" or "stunned".
local function face(look)
  local function eye(x)
    if look == "asleep" then
      return stroke { d = ("M%g -126 q11 9 22 0"):format(x - 11), width = 5 }
    elseif look == "shut" then
      return stroke { d = ("M%g -136 L%g -127 L%g -118"):format(x < 0 and x - 9 or x + 9,
        x < 0 and x + 9 or x - 9, x < 0 and x - 9 or x + 9), width = 5 }
    end
    return circle { x, look == "up" and -134 or -126, look == "stunned" and 11 or 7 }
  end
  return (eye(-24) | eye(24) | ellipse { 0, -98, look == "stunned" and 8 or 13,
    look == "stunned" and 11 or 2.5 }):paint(mood.ink):translate(0, 30)
end

-- Two drawings each: the face, how broad the cactus is, and what it wears: a bud of some size, the
-- bang, the flower, or the flower with a share of its petals.
local ACTS = { { "asleep", 1 }, { "asleep", 1 }, { "asleep", 1 }, { "up", 1, 0.5 },
  { "up", 1, 0.5 }, { "up", 1, 0.5 }, { "up", 1, 1 }, { "up", 1, 1 }, { "shut", 1.05, 1.3 },
  { "shut", 1.1, 1.5 }, { "shut", 1.05, 1.3 }, { "shut", 1.1, 1.5 }, { "stunned", 0.9, "bang" },
  { "stunned", 1, FLOWER }, { "stunned", 1, FLOWER }, { "stunned", 1, FLOWER },
  { "up", 1, FLOWER }, { "up", 1, FLOWER }, { "up", 1, FLOWER }, { "asleep", 1, FLOWER },
  { "asleep", 1, FLOWER }, { "asleep", 1, FLOWER }, { "asleep", 1, FLOWER, 150 },
  { "asleep", 1, FLOWER, 420 } }

return window.film { title = "The cactus", by = "cp", seconds = 4, drawing = function(_, number)
  local look, broad, worn, fallen = table.unpack(ACTS[number // 2 + 1])
  local body = (CACTUS | face(look)):scale(broad, 2 - broad):translate(225, 450)
  local top = 450 - 206 * (2 - broad)
  local list = { glasshouse.room, cut.laid(body) }
  list[3] = POT:translate(225, worn == "bang" and 552 or 562)
  if worn == "bang" then
    list[4] = cut.laid(BANG:translate(225, top - 20))
  elseif worn == FLOWER then
    fallen = fallen or 0
    list[4] = cut.laid(FLOWER:rotate(0.1 * fallen, 0, 0)
      :scale(0.86)
      :translate(225 + 0.5 * fallen, top - 40 + fallen))
  elseif worn then
    list[4] = cut.laid(BUD:scale(worn):translate(225, top))
  end
  return list
end }
