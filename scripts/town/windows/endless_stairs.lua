-- Endless stairs: a woman in a red coat goes up four flights, and is where she began.
local window = require "town.window"
local geometry = require "town.geometry"
local stairs = require "town.stairs"
local harvest = require("stage.moods").harvest

local RED, WINE, SKIN, INK = "#d0232f", "#8f1526", "#f2c9a0", harvest.ink

--- The woman, her feet at 0, 0, going to the right: seen from before, or from behind; with a foot
--- that is lifted 0 to 1, and a hem that swings.
local function woman(lifted, is_behind, swing)
  local hem = 8 * swing
  local legs = geometry.limb({ { -9, -50 }, { -10 - 6 * lifted, -3 } }, 11, INK)
    | geometry.limb({ { 9, -50 }, { 14 + 10 * lifted, -26 * lifted - 3 * (1 - lifted) } }, 11, INK)
  local case = rect { -42 - hem, -78, 30, 42, radius = 5, fill = harvest.ground }
    | rect { -42 - hem, -66, 30, 5, fill = harvest.sky[2] }
  local coat = path { fill = RED, d = ("M-14 -128 C-26 -100 -34 -70 %g -34 Q0 -26 %g -36 "
    .. "C36 -70 28 -104 14 -128 Z"):format(-40 - hem, 38 - hem) }
  local shade = path { fill = WINE, d = ("M2 -130 L14 -128 C28 -104 36 -70 %g -36 Q20 -31 %g -30 "
    .. "C14 -60 12 -100 2 -130 Z"):format(38 - hem, 10 - hem) }
  local arm = geometry.limb({ { -10, -116 }, { -26, -96 }, { -27 - 0.6 * hem, -76 } }, 15, WINE)
  local scarf = geometry.limb({ { -10, -128 }, { 12, -128 } }, 14, harvest.accent)
    | geometry.limb({ { -10, -128 }, { -24, -126 }, { -38 - hem, -112 + 2 * hem } }, 10,
      harvest.accent)
  local head = circle { 3, -150, 19, fill = is_behind and INK or SKIN }
  if not is_behind then
    head = head | geometry.sector(-2, -150, 20, 180, 330, INK)
      | circle { 9, -147, 2.4, fill = INK } | circle { 19, -147, 2.4, fill = INK }
  end
  local hat = geometry.sector(2, -155, 22, -90, 90, WINE):rotate(-6, 2, -155)
    | rect { -26, -158, 58, 8, radius = 4, fill = RED }:rotate(-6, 2, -155)
  return legs | case | coat | shade | arm | scarf | head | hat
end

local sky = rect { 0, 0, 450, 600, fill = harvest.sky[3] }
local sun = circle { 262, 268, 190, fill = harvest.sky[2] }
  | circle { 262, 268, 130, fill = harvest.sky[1] }
local house = stairs.house({ harvest.light, harvest.sky[2], harvest.near }, harvest.ground)

-- Of the six drawings of a step she stands for four, and then goes up: how far she is, how high the
-- foot is lifted, and the swing of her coat.
local STAND = { 0, 0, 0 }
local phases = { STAND, STAND, STAND, STAND, { 0.35, 1, 0.3 }, { 0.85, 0.4, 1 } }

return window.film { title = "Endless stairs", by = "ge", seconds = 4, drawing = function(_, number)
  local n = number // 6
  local phase = phases[number % 6 + 1]
  local is_left, is_behind = stairs.way(n)
  local x, y = stairs.place(n + phase[1], math.min(1, 1.3 * phase[1]))
  local her = woman(phase[2], is_behind, phase[3]):scale(is_left and -1.2 or 1.2, 1.2)
  return { sky, sun, house, her:translate(x, y) }
end }
