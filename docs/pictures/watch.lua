-- The film in the pictures of docs/watch.md: five shots, marks, a sound and parameters.
local p = parameters {
  title = "Little hours",
  sky = { colour = "#20305a", about = "The upper end of the sky" },
  sun = { 420, 150, point = true, group = "Light", about = "Drag it on the picture" },
  glow = { 46, min = 10, max = 120, group = "Light" },
  rise = { ease = "outBack", group = "Light" },
}
local rise = ease(p.rise)

local function sky(colour)
  return rect { 0, 0, 640, 360, fill = linear { from = { 0, 0 }, to = { 0, 360 },
    { 0, p.sky }, { 1, colour } } }
end

--- A shot under a sky; place: how far the hills have moved.
local function shot(colour, place, seconds)
  return film { size = { 640, 360 }, fps = 24, frames = math.floor(24 * seconds),
    marks = place == 2 and { bell = 20, bird = 36 } or nil, frame = function(f)
      local sun = circle { p.sun[1], p.sun[2] + 60 * (1 - rise(f.progress)), p.glow,
        fill = "#ffe6a0" }
      local near = circle { 160 + 20 * place, 560, 300, fill = "#2c4a3e" }
      local far = circle { 520, 620, 340, fill = "#243c36" }
      local bird = circle { 640 * f.progress, 120, 8, fill = "#101418" }
      return {
        cel { sky(colour) }:named "sky", cel { sun:named "disc" }:named "sun",
        cel { far:named "far", near:named "near" }:named "hills",
        cel { bird }:named "bird" }
    end }
end

return cut { title = p.title, sound = "tune.wav",
  { film = shot("#f0a070", 1, 3), name = "evening" }, cut.dissolve(0.5),
  { film = shot("#d07060", 2, 3), name = "bells" },
  { film = shot("#e8c080", 3, 2.5), name = "morning" }, cut.wipe {} (0.75),
  { film = shot("#90a0c0", 4, 2.5), name = "rain" },
  { film = shot("#704060", 5, 2), name = "night" } }
