-- The juggler lets one go: it leaves by the ceiling, and after a while comes back from below.
local window = require "town.window"
local geometry = require "town.geometry"
local juggling = require "town.juggling"

-- For how many drawings: how high the ball is, above the ceiling nil; the hands; the hat; the head.
local sheet = {
  { 6, { 318, 0, 0, 0 } }, { 2, { 332, -14, 0, 0 } }, { 1, { 214, 40, 0, -14 } },
  { 1, { 60, 40, 30, -14 } }, { 7, { -60, 0, 0, -14 } }, { 5, { -60, 0, 0, 14 } },
  { 5, { -60, 0, 0, -14 } }, { 5, { -60, 0, 0, 0 } }, { 1, { 510, 0, 0, 0 } },
  { 1, { 300, 40, 30, -14 } }, { 3, { 206, 40, 30, -14 } }, { 2, { 332, -14, 0, 14 } },
  { 9, { 318, 0, 0, 0 } } }

return window.film { title = "The juggler waits", by = "ge", seconds = 4, pane = "plain",
  drawing = function(_, number)
    local high, raised, lift, turn = table.unpack(geometry.held(sheet, number), 1, 4)
    return { juggling.room, juggling.body(raised),
      juggling.head(juggling.x, juggling.y, turn), juggling.hat(lift),
      juggling.ball(4, juggling.x + 112, high) }
  end }
