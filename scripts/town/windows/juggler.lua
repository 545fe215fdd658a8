-- The juggler: five things fly on one figure of eight, x = sin t, y = sin 2 t, over hands that only
-- wait. One of the five is the head, which is in its place twice in each round.
local window = require "town.window"
local juggling = require "town.juggling"
local noon = require("stage.moods").noon

--- Where a thing is on the eight after a share of its round.
local function eight(share)
  local t = 2 * math.pi * share
  return juggling.x + 158 * math.sin(t), juggling.y - 104 * math.sin(2 * t)
end

local trace = {}
for i = 0, 48 do trace[i + 1] = { eight(i / 48) } end
trace = stroke { points = trace, degree = 2, width = 3, fill = noon.sky[2] }

local body = juggling.body(0)

return window.film { title = "The juggler", by = "ge", seconds = 2, pane = "plain",
  drawing = function(share, number)
    local shown = { juggling.room, trace, body }
    for i in ipairs(juggling.colours) do
      shown[#shown + 1] = juggling.ball(i, eight(share + i / 5))
    end
    local x, y = eight(share)
    local half = number % 12
    shown[#shown + 1] = juggling.head(x, y, (number < 12 and 30 or -30) * half)
    shown[#shown + 1] = juggling.hat(({ [0] = 10, 22, 8 })[half] or 0)
    return shown
  end }
