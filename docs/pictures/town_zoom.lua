-- The way into the town, shown in two seconds and without its sound, for the page about it.
local zoom = require "town.zoom"

return film { size = zoom.size, fps = 12, frames = 25, frame = function(f)
  return zoom:at(56 + 5 * f.index)
end }
