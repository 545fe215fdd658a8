-- The film in the pictures of docs/watch.md: five shots, marks, a sound and parameters.
local celspan = require "celspan"
local cut = require "celspan.cut"
local p = celspan.parameters {
  title = "Little hours",
  sky = { colour = "#20305a", about = "The upper end of the sky" },
  sun = { 420, 150, point = true, group = "Light", about = "Drag it on the picture" },
  glow = { 46, min = 10, max = 120, group = "Light" },
  rise = { ease = "outBack", group = "Light" },
}
local rise = require "celspan.ease" (p.rise)

local function sky(colour)
  return celspan.rect { 0, 0, 640, 360, texture = celspan.linear { from = { 0, 0 }, to = { 0, 360 },
    { 0, p.sky }, { 1, colour } } }
end

--- A shot under a sky; place: how far the hills have moved.
local function shot(colour, place, seconds)
  return celspan.film { size = { 640, 360 }, fps = 24, frames = math.floor(24 * seconds),
    marks = place == 2 and { bell = 20, bird = 36 } or nil, frame = function(f)
      local sun = celspan.circle { centre = { p.sun[1], p.sun[2] + 60 * (1 - rise(f.progress)) },
                                   radius = p.glow, texture = "#ffe6a0" }
      local near = celspan.circle { centre = { 160 + 20 * place, 560 }, radius = 300,
                                    texture = "#2c4a3e" }
      local far = celspan.circle { centre = { 520, 620 }, radius = 340, texture = "#243c36" }
      local bird = celspan.circle { centre = { 640 * f.progress, 120 }, radius = 8,
                                    texture = "#101418" }
      return celspan.rostrum {
        celspan.cel { sky(colour) }:named "sky", celspan.cel { sun:named "disc" }:named "sun",
        celspan.cel { far:named "far", near:named "near" }:named "hills",
        celspan.cel { bird }:named "bird" }
    end }
end

return cut { title = p.title, sound = "tune.wav",
  { film = shot("#f0a070", 1, 3), name = "evening" }, cut.dissolve(0.5),
  { film = shot("#d07060", 2, 3), name = "bells" },
  { film = shot("#e8c080", 3, 2.5), name = "morning" }, cut.wipe {} (0.75),
  { film = shot("#90a0c0", 4, 2.5), name = "rain" },
  { film = shot("#704060", 5, 2), name = "night" } }
