-- The moving picture of the first page: the close shot of Little One, from the words of the
-- lamplighter to his laugh. A circle closes on the lamp, and the dark rests before it begins again.
local close = require "film.shots.close"

local SIZE, FROM = { 1920, 1080 }, 14.8 -- FROM: in seconds of the film
local radius = keys { { 5.2, 1700 }, { 5.5, 225, "inOutCubic" }, { 5.72, 205, "inOutSine" },
                      { 5.94, 0, "inCubic" } }
local dark = rect { 0, 0, SIZE[1], SIZE[2], fill = "#0a0c20" }

local shot = film { size = SIZE, fps = 24, duration = 6,
  frame = function(f) return close.draw(FROM + f.time) end }

return cut { title = "Little One, round and round", shot, over = function(f)
  local open = radius:at(f.time)
  return cel { open > 0 and dark - circle { 1484, 396, open } or dark }
end }
