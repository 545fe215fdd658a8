-- A bath with nobody in it except the duck: a drop, rings, and the duck looks who that was.
local pencil, window, bath = require "town.pencil", require "town.window", require "town.bath"

local still = pencil.hand()
local foam = bath.foam { 70, 356, 13, 88, 360, 17, 110, 360, 12 }
local duck = bath.duck:scale(1.7)

--- How far the drop has fallen, twelve drawings; then rings.
local drop = { 0, 2, 5, 14, 34, 64 }

local function rings(n)
  local w = 10 + 9 * n
  return still.line({ 374 - w, 342, 374, 338 - n, 374 + w, 342 }, 4, "#fffdf6")
    | still.line({ 374 - w, 346, 374, 350 + n, 374 + w, 346 }, 4, "#fffdf6")
end

return window.film { title = "The duck", by = "pw", seconds = 2, drawing = function(_, number)
  local n = number // 2
  local turned = n >= 7 and n < 11
  local shown = { bath.room, bath.steam(n // 6), bath.tap }
  if n < 6 then
    shown[4] = ellipse { 378, 276 + drop[n + 1], 5, 8, fill = "#7fa8b8" }
  elseif n < 11 then
    shown[4] = rings(n - 6)
  end
  shown[#shown + 1] = duck:scale(turned and -1 or 1, 1):translate(210, 352 + n // 3 % 2 * 2.34375)
  shown[#shown + 1], shown[#shown + 2] = bath.tub, foam
  return shown
end }
