-- The neighbour of the drummer: a broom against the ceiling on each beat; at the last one it turns
-- in the air, for by now it is a part of the band.
local window = require "town.window"
local geometry = require "town.geometry"
local neon = require("stage.moods").neon

local CYAN, PINK, PAPER, INK = neon.light, neon.accent, "#fff1dc", neon.ink
local SKIN, GOLD, TEAL = "#f4c7a4", "#ffc94d", "#149aa6"
local limb, sector = geometry.limb, geometry.sector

local room = union { rect { 0, 0, 450, 600, fill = neon.sky[2] },
  circle { 225, 320, 205, fill = neon.sky[3] }, rect { 0, 17, 450, 50, fill = neon.far },
  rect { 0, 63, 450, 7, fill = CYAN }, rect { 0, 540, 450, 60, fill = neon.far },
  rect { 24, 430, 120, 110, radius = 12, fill = TEAL }, rect { 24, 470, 130, 70, fill = "#8a1458" },
  rect { 34, 418, 80, 44, radius = 20, fill = PAPER } }

--- The broom, the middle of its stick at 0, 0; its bristles are short where they hit.
local function broom(short)
  return rect { -6, -110, 12, 250, radius = 6, fill = PAPER }
    | polygon { { -22, -106 }, { 22, -106 }, { 46 + short, -166 + short },
      { -46 - short, -166 + short }, fill = GOLD } | rect { -24, -114, 48, 14, fill = PINK }
end

--- Flakes of the ceiling, some drawings after the blow.
local function flakes(late)
  local parts = {}
  for i, x in ipairs { 250, 290, 336, 372, 410 } do
    parts[i] = circle { x, 84 + (36 + 10 * (i % 2)) * late, 4 + i % 3 * 2, fill = CYAN }
  end
  return union(parts)
end

--- The man, who leans to a side, -1 or 1; the tassel of his cap is on the other one.
local function man(side, grip)
  local x = 214 + 7 * side
  local gown = path { fill = CYAN,
    d = "M188 270 C160 340 148 430 140 500 H290 C282 430 268 340 240 270 Z" }
  for i = 1, 2 do
    gown = gown | rect { 178 - 10 * i, 312 + 62 * i, 72 + 22 * i, 22, fill = PAPER }
  end
  local face = circle { x, 226, 50, fill = SKIN } | sector(x - 22, 246, 24, 90, 260, PAPER)
    | sector(x + 22, 246, 24, 100, 270, PAPER) | circle { x - 15, 222, 5, fill = INK }
    | circle { x + 19, 222, 5, fill = INK }
    | rect { x - 30, 204, 24, 7, fill = INK }:rotate(16, x - 18, 207)
    | rect { x + 8, 204, 24, 7, fill = INK }:rotate(-16, x + 20, 207)
  local cap = path { fill = PINK, d = ("M%g 200 Q%g 130 %g 150 Q%g 160 %g 200 Z"):format(x - 52,
    x - 40, x - 62 * side, x + 52 - 20 * side, x + 52) }
    | circle { x - 66 * side, 156, 17, fill = PAPER }
  return limb({ { 192, 490 }, { 188, 552 } }, 24, SKIN)
    | limb({ { 240, 490 }, { 246, side > 0 and 552 or 540 } }, 24, SKIN)
    | sector(178, 564, 30, -90, 90, PINK) | sector(256, side > 0 and 564 or 550, 30, -90, 90, PINK)
    | gown | face | cap
    | limb({ { 190, 292 }, { 226, 366 }, { 318, grip + 60 } }, 32, CYAN)
    | limb({ { 246, 288 }, { 284, 330 }, { 318, grip } }, 32, CYAN)
    | circle { 322, grip + 60, 19, fill = SKIN } | circle { 322, grip, 19, fill = SKIN }
end

-- For how many drawings: the side, how high the hands are, the broom, its turn, and flakes.
local hit, low = { 214, 22 }, { 282, 0 }
local sheet = {}
for beat = 0, 3 do
  local side = beat % 2 * 2 - 1
  sheet[#sheet + 1] = { 1, { side, hit, 0, 1 } }
  sheet[#sheet + 1] = { 1, { side, hit, 0, 2 } }
  if beat < 3 then sheet[#sheet + 1] = { 4, { side, low, 0 } } end
end
for turn = 1, 4 do sheet[#sheet + 1] = { 1, { 1, low, 90 * turn - 30 } } end

return window.film { title = "The broom", by = "ge", seconds = 2, pane = "plain",
  drawing = function(_, number)
    local side, hold, turn, late = table.unpack(geometry.held(sheet, number), 1, 4)
    local tool = broom(hold[2]):rotate(turn):translate(322, hold[1] + (turn > 0 and -20 or 0))
    return { room, man(side, hold[1]), tool, late and flakes(late) or nil }
  end }
