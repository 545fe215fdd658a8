-- The film in the pictures of docs/watch.md: that of `celspan init`, whose cat, town, tune and
-- times lie beside it, as a cut of four shots with more values.
local cat, town, when = require "cat", require "town", require "timing"

local p = parameters {
  coat = { colour = "#171130" },
  from = { 1150, 90, point = true, group = "Star", about = "Drag it on the picture" },
  shine = { 46, min = 10, max = 120, group = "Star" },
  fall = { ease = "outSine", group = "Star" },
}
local fall, waking = ease(p.fall), ease "inOutQuad"
local caught = { cat.reach[1], town.ridge + cat.reach[2] }
local spark = path { fill = "#fffbe0", d = [[M0 -34 Q3 -7 10 -5 Q24 -3 34 0 Q24 3 10 5
  Q3 7 0 34 Q-3 7 -10 5 Q-24 3 -34 0 Q-24 -3 -10 -5 Q-3 -7 0 -34 Z]] }

local function star(time, neck_x, neck_y)
  local function place(at)
    local left = 1 - fall((at - when.star) / (when.catch - when.star))
    return caught[1] + (p.from[1] - caught[1]) * left + 90 * left * math.sin(8 - 8 * left),
      caught[2] + (p.from[2] - caught[2]) * left
  end
  local x, y = place(time)
  local u, dust = fall((time - when.catch) / 0.3), {}
  for i = 1, time < when.catch and 14 or 0 do
    local dust_x, dust_y = place(time - 0.045 * i)
    dust[i] = circle { dust_x + 7 * math.sin(9 * i), dust_y + 7 * math.cos(7 * i),
      4.5 - 0.3 * i, fill = "#ffe9b0" }:fade(1 - i / 15)
  end
  local here = spark:rotate(90 * time):scale(1 - 0.5 * u)
    :translate(x + (neck_x - x) * u, y + (neck_y - y) * u)
  return union(dust):named "dust" | here:glow { radius = p.shine, colour = "#ffd98a", gain = 2 }
    :named "spark"
end

local function lit(windows, time, radius)
  local shining = {}
  for _, window in ipairs(windows) do
    local u = (time - when.lights - math.abs(window:bounds() - 700) / 460) / 0.3
    if u > 0 then shining[#shining + 1] = window:paint "#ffc766":fade(u) end
  end
  return union(shining):glow { radius = radius, colour = "#ffc766", gain = 0.9 }
end

--- The seconds of the story from `from` on, with the camera at a place.
local function shot(from, seconds, camera, marks)
  return film { size = { 1280, 720 }, fps = 24, duration = seconds, marks = marks,
    frame = function(f)
      local time, drawn = from + f.time, from + f:on(2) / f.fps
      local x, y = cat.neck(drawn)
      local warmth = waking((time - when.lights) / 1.6)
      return multiplane { film = { 1280, 720 }, fit = true, camera = camera(f.progress),
        { cel { town.sky(time, 110) }:named "sky", z = 5000 },
        { cel { town.hills }:named "hills", z = 2500 },
        { cel { town.far.houses:named "walls", lit(town.far.windows, time, 14):named "windows" }
          :named "far street", z = 1300 },
        { cel { town.near.houses:named "walls", lit(town.near.windows, time, 26):named "windows",
          front = { 1 + 1.1 * warmth, 1 + 0.5 * warmth, 1 } }:named "near street", z = 500 },
        { cel { town.roof:named "tiles", lit(town.panes, time, 30):named "skylights" }
          :named "roof" },
        { cel { cat.draw(drawn, p.coat, mix(clear, "#ffc766", 0.8 * warmth)):named "cat" }
          :translate(0, town.ridge):named "cat" },
        { cel { star(time, x, town.ridge + y) }:named "star" } }
    end }
end

return cut { title = "The cat and the star", sound = "tune.wav",
  { film = shot(0, 2, function(u) return { x = -40 + 40 * u, z = -60 + 60 * u } end),
    name = "dusk" }, cut.dissolve(0.5),
  { film = shot(1.5, 1, function(u) return { x = -330, y = 70, z = 420 + 20 * u } end,
    { crouch = 7 }), name = "crouch" },
  { film = shot(2.5, 1.5, function() return { x = 20 } end,
    { catch = 10, land = 19 }), name = "leap" }, cut.wipe {} (0.5),
  { film = shot(3.5, 2.5, function(u) return { x = 60, z = 50 * u } end, { lamps = 6 }),
    name = "lamps" } }
