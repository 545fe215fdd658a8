-- The pancake: it is tossed, sticks to the ceiling for half of the loop, and falls into the pan.
local window = require "town.window"
local kitchen = require "town.kitchen"(require("stage.moods").harvest)

--- How far the cook looks up, and how high the pan is, in each drawing; then where the pancake is:
--- a place, degrees and how thin it is, or one of its shapes on the ceiling.
local LOOK = { 0, 4, 8, 8, -10, -20, -26, -30, -30, -30, -30, -30, -30, -22, -22, -22, -30, -30,
  -30, -22, -6, 8, 4, 0 }
local HIGH = { 0, 14, 22, 22, -70, -54, -30, -10, 0, 0, 0, 0, 0, 0, 0, 0, 0, -14, -14, -14, -6,
  26, 10, 0 }
local AIR = { [5] = { 330, 0 }, [6] = { 220, 70 }, [7] = { 124, 170 }, [19] = { 170, -8 },
  [20] = { 270, 8 }, [21] = { 380, 0 } }

local function cake(n, y)
  if AIR[n] then return kitchen.cake(330, AIR[n][1], AIR[n][2]) end
  if n > 7 and n < 19 then return kitchen.stuck(330, n < 12 and 1 or n < 17 and 2 or 3) end
  return kitchen.cake(330, y - 18, 0, n == 22 and 0.6 or 1)
end

return window.film { title = "The pancake", by = "cp", seconds = 2, pane = "plain",
  drawing = function(_, number)
    local n = number + 1
    local y = 448 + HIGH[n]
    return { kitchen.room, kitchen.cook(LOOK[n]), kitchen.pan(y), cake(n, y) }
  end }
