-- The animator as she drew herself: pencil alone on white paper; once she looks up.
local pencil, sheet = require "town.pencil", require "town.sheet"
local studio, window = require "town.studio", require "town.window"

local still = pencil.hand(false, pencil.light)
local room = studio.room(still, pencil.light)
local page = studio.sheet(still, sheet.pencil("#4a4540"), 0, pencil.light)

return window.film { title = "The animator, drawn", by = "pw", seconds = 4,
  drawing = function(_, number)
    local hand, lift, p = studio.acting(number, "aBaBaBaBaBrrRRrrRRrrRRaB", pencil.light)
    local looks = number >= 24 and number < 40
    return { room, page, studio.animator(p, hand, lift, looks, pencil.light) }
  end }
