-- Geese: a wedge of birds, each of which beats its wings a little later than the one before.
local palette = require "demo.palette"

local flock = {}

local function goose(x, y, size, beat)
  local tip, bend = -size * 0.62 * beat, -size * 0.30 - size * 0.14 * beat
  local s = size
  local d = ("M%g %gQ%g %g %g 0Q%g %g %g %gQ%g %g %g %gQ%g %g %g %gZ"):format(
    -s, tip, -s * 0.45, bend, -s * 0.1, s * 0.45, bend, s, tip,
    s * 0.5, bend + s * 0.3, s * 0.1, s * 0.16, -s * 0.45, bend + s * 0.3, -s, tip)
  return path { d = d, fill = palette.goose }:translate(x, y)
end

--- The leader at (x, y), flying left to right.
function flock.draw(time, x, y)
  local birds = {}
  for i = -4, 4 do
    local back = math.abs(i)
    birds[#birds + 1] = goose(x - back * 46 - (i > 0 and 10 or 0), y + i * 15 - back * 4,
      24 - back * 0.8, math.sin(time * 9 - back * 0.9))
  end
  return cel { union(birds) }
end

return flock
