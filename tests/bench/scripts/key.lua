-- key.lua: a green screen of 1920 x 1080; its picture as it is, or keyed.
--   render: the figure before the screen.   spans: -- take|key FILE
local celspan = require "celspan"
local what, file = ...

local cloth = celspan.radial { centre = { 800, 400 }, radius = 1500, { 0, "#36c862" },
  { 1, "#289a4a" } }
local figure = celspan.union {
  celspan.path { d = "M500 1080 C480 400 1320 400 1300 1080 Z", texture = "#a03c3c" },
  celspan.circle { centre = { 900, 400 }, radius = 260, texture = "#b4503c" } }

local function shown()
  local ground = celspan.rect { 0, 0, 1920, 1080, texture = cloth }
  if not what then return celspan.group { ground, figure:blur(8) } end
  local take = celspan.image { file = file, w = 1920, h = 1080 }
  if what == "take" then return take end
  return celspan.key { take, colour = "#2fb457", tolerance = 0.02, softness = 0.2 }
end

return celspan.film { size = { 1920, 1080 }, frame = function()
  return celspan.rostrum { celspan.cel { shown() } }
end }
