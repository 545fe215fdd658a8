-- The stuck lift: between two floors two heads play cards, and four feet above them wait; in the
-- end a shoe shows which card to play.
local window = require "town.window"
local geometry = require "town.geometry"
local neon = require("stage.moods").neon

local CYAN, PINK, PAPER, INK = neon.light, neon.accent, "#fff1dc", neon.ink
local SKIN, TEAL, WINE, GOLD = "#f4c7a4", "#149aa6", "#8a1458", "#ffc94d"
local limb, sector = geometry.limb, geometry.sector

local shaft = union { rect { 0, 0, 450, 600, fill = neon.sky[3] },
  circle { 225, 60, 200, fill = "#4a2589" },
  rect { 216, 0, 4, 280, fill = PAPER }, rect { 230, 0, 4, 280, fill = PAPER },
  rect { 206, 250, 38, 24, fill = WINE }, rect { 0, 272, 450, 34, fill = TEAL },
  rect { 0, 272, 450, 8, fill = CYAN }, rect { 0, 306, 450, 300, fill = INK },
  rect { 44, 306, 362, 260, fill = neon.far }, rect { 44, 516, 362, 60, fill = WINE },
  rect { 170, 470, 110, 100, fill = TEAL }, rect { 150, 456, 150, 18, radius = 9, fill = CYAN } }

--- A foot in a shoe on the floor above; its tip is lifted by some degrees, about the heel.
local function foot(x, side, leg, shoe, lift)
  local sole = (sector(0, 0, 34, -90, 90, shoe) | rect { -34, -3, 94 * 0.72, 9, fill = INK })
    :scale(side, 1)
  return limb({ { x, 0 }, { x, 246 } }, 30, leg)
    | sole:rotate(-lift * side, -30 * side, 0):translate(x + 18 * side, 266)
end

--- A card, its middle at 0, 0.
local function card(x, y, turn, fill)
  return (rect { -18, -26, 36, 52, radius = 5, fill = PAPER } | circle { 0, 0, 9, fill = fill })
    :rotate(turn):translate(x, y)
end

local function fan(x, y, side, count)
  local parts = {}
  for i = 1, count do
    parts[i] = card(x + 15 * (i - 2) * side, y + 5 * math.abs(i - 2), 16 * (i - 2) * side,
      i % 2 == 0 and INK or PINK)
  end
  return union(parts)
end

--- A head at the table, -1 on the left or 1 on the right, whose eyes look; and its fan of cards.
local function player(side, look, count)
  local x = 225 + 112 * side
  local hair = sector(x + 4, 396, 58, -70, 120, GOLD) | circle { x + 40, 350, 24, fill = GOLD }
  if side < 0 then
    hair = sector(x, 400, 56, -90, 90, PINK)
      | rect { x - 64, 394, 128, 13, radius = 6, fill = PINK }
  end
  return path { fill = side < 0 and CYAN or PINK,
    d = ("M%g 570 Q%g 460 %g 456 Q%g 460 %g 570 Z"):format(x - 74, x - 70, x, x + 70, x + 74) }
    | circle { x, 406, 54, fill = SKIN } | hair
    | circle { x - 24 * side + look[1], 414 + look[2], 6, fill = INK }
    | circle { x + 4 * side + look[1], 414 + look[2], 6, fill = INK }
    | fan(x - 40 * side, 486, side, count)
end

--- A card on its way from one of the fans to the table.
local paths = { { { 148, 450, -30 }, { 196, 436, 20 }, { 212, 446, 80 } },
  { { 300, 450, 30 }, { 256, 436, -20 }, { 240, 444, -70 } } }
local flight = { 1, 2, 3 }

local AHEAD, DOWN, UP = { 0, 0 }, { 0, 7 }, { 0, -10 }

-- For how many drawings: looks of the left and the right one, cards of both, the card that flies
-- (whose, and where), tips of the feet.
local sheet = {
  { 5, { AHEAD, DOWN, 3, 3, nil, 0, 0 } }, { 3, { AHEAD, DOWN, 3, 3, nil, 24, 0 } },
  { 1, { DOWN, DOWN, 2, 3, { 1, 1 }, 0, 0 } }, { 1, { DOWN, DOWN, 2, 3, { 1, 2 }, 0, 0 } },
  { 6, { AHEAD, DOWN, 2, 3, { 1, 3 }, 24, 0 } }, { 5, { AHEAD, UP, 2, 3, { 1, 3 }, 0, 0 } },
  { 3, { AHEAD, UP, 2, 3, { 1, 3 }, 0, 38 } }, { 7, { UP, DOWN, 2, 3, { 1, 3 }, 0, 38 } },
  { 1, { UP, DOWN, 2, 2, { 2, 1 }, 0, 0 } }, { 1, { DOWN, DOWN, 2, 2, { 2, 2 }, 0, 0 } },
  { 8, { UP, AHEAD, 2, 2, { 2, 3 }, 24, 0 } }, { 7, { DOWN, AHEAD, 3, 3, nil, 0, 24 } } }

return window.film { title = "The stuck lift", by = "ge", seconds = 4,
  drawing = function(_, number)
    local left, right, ours, theirs, played, first, last =
      table.unpack(geometry.held(sheet, number), 1, 7)
    local shown = { shaft, foot(84, -1, CYAN, INK, 0), foot(150, 1, CYAN, INK, first),
      foot(292, -1, SKIN, PINK, last), foot(352, 1, SKIN, PINK, 0), player(-1, left, ours),
      player(1, right, theirs) }
    if played then
      if played[1] == 2 then shown[#shown + 1] = card(212, 446, 80, PINK) end
      local at = paths[played[1]][flight[played[2]]]
      shown[#shown + 1] = card(at[1], at[2], at[3], played[1] == 2 and INK or PINK)
    end
    return shown
  end }
