-- The animator of the town at her light table: she draws its last window, and flips two sheets.
local pencil, sheet = require "town.pencil", require "town.sheet"
local studio, window = require "town.studio", require "town.window"

local still = pencil.hand()
local room, town = studio.room(still), sheet.pencil("#4a4540")

return window.film { title = "The animator", by = "pw", seconds = 4, drawing = function(_, number)
  local hand, lift, p = studio.acting(number)
  return { room, studio.sheet(still, town, lift), studio.animator(p, hand, lift) }
end }
