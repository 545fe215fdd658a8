-- displace.lua: a picture of 1920 x 1080 as it is, displaced by another, or blurred along a line.
--   render: the picture, or (-- map) what displaces it.
--   spans: -- take|both|displace|blur FILE MAP   both: one picture seen through the other
local celspan = require "celspan"
local what, file, map = ...

local function noise(colours)
  return celspan.rect { 0, 0, 1920, 1080, texture = celspan.noise { kind = "fractal", size = 300,
    colours = colours } }
end

local function shown()
  if what == "map" then return noise { "#000", "#fff" } end
  if not what then return noise { "#204080", "#e0c080", "#802020", "#f0f0f0" } end
  local take = celspan.image { file = file, w = 1920, h = 1080 }
  if what == "take" then return take end
  if what == "blur" then return take:blur(20, { angle = 45 }) end
  local by = celspan.image { file = map, w = 1920, h = 1080 }
  if what == "both" then return celspan.group { by, take:fade(0.5) } end
  return take:displace { by = by, scale = 80 }
end

return celspan.film { size = { 1920, 1080 }, frame = function()
  return celspan.rostrum { celspan.cel { shown() } }
end }
