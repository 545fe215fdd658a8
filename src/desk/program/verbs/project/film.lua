-- @NAME@: a cat, a falling star, and a town that wakes up.
--
--   celspan watch film.lua                     in the browser, while you change it
--   celspan render film.lua -o out/film.mp4    needs ffmpeg
--
-- Letters: text { "Hello", 100, 100, font = "type/block.ttf", size = 60 }
local cat = require "cat"
local town = require "town"
local when = require "timing"

local set = parameters { -- celspan render film.lua --set lamp=#9fe8ff
  lamp = { colour = "#ffc766", about = "the light of the windows" },
  coat = { colour = "#171130", about = "the cat" },
  stars = { 70, min = 0, max = 300, about = "how many stars are in the sky" },
}

-- ---------------------------------------------------------------- the star

local caught = { cat.reach[1], town.ridge + cat.reach[2] }
local spark = path { fill = "#fffbe0", d = [[M0 -34 Q3 -7 10 -5 Q24 -3 34 0 Q24 3 10 5
  Q3 7 0 34 Q-3 7 -10 5 Q-24 3 -34 0 Q-24 -3 -10 -5 Q-3 -7 0 -34 Z]] }
local burst = particles { rate = 900, from = when.catch, to = when.catch + 0.05, life = { 1, 0.5 },
  at = caught, velocity = { 0, -40, 330, 330 }, gravity = { 0, 420 }, drag = 2 }
local slower = ease "outSine"

--- The place of the star while it falls like a leaf.
local function falling(time)
  local left = 1 - slower((time - when.star) / (when.catch - when.star))
  return caught[1] + (460 + 90 * math.sin(8 - 8 * left)) * left, caught[2] - 230 * left
end

--- A grain of the star's dust.
local function dust(x, y, radius, share)
  return circle { x, y, radius, fill = "#ffe9b0" }:fade(share)
end

local function star(time, neck_x, neck_y)
  local grains = {}
  for i = 1, time < when.catch and 14 or 0 do -- behind it
    local x, y = falling(time - 0.045 * i)
    grains[i] = dust(x + 7 * math.sin(9 * i), y + 7 * math.cos(7 * i), 4.5 - 0.3 * i, 1 - i / 15)
  end
  for _, p in ipairs(burst:at(time)) do
    local near = math.min(1, 5 * p.age) -- when it is new, it would hide the cat's face
    grains[#grains + 1] = dust(p.x, p.y, (2 + 4 * p.size * (1 - p.age)) * near, 1 - p.age)
  end
  local x, y = falling(time)
  local u = slower((time - when.catch) / 0.3) -- after that, it hangs at the cat's neck
  local shine = spark:rotate(90 * time):scale(1 - 0.5 * u)
    :translate(x + (neck_x - x) * u, y + (neck_y - y) * u)
  return (union(grains) | shine):glow { radius = 34, colour = "#ffd98a", gain = 2 }
end

-- ---------------------------------------------------------------- the lamps

--- The lit windows: they light up one after another, from the cat outwards.
local function lit(windows, time, radius)
  local shining = {}
  for _, window in ipairs(windows) do
    local u = (time - when.lights - math.abs(window:bounds() - 700) / 460) / 0.3
    if u > 0 then shining[#shining + 1] = window:paint(set.lamp):fade(u) end
  end
  return union(shining):glow { radius = radius, colour = set.lamp, gain = 0.9 }
end

-- ---------------------------------------------------------------- the film

local glide, waking = ease "inOutSine", ease "inOutQuad"
local function frame_of(seconds) return math.floor(24 * seconds) + 1 end

return film { title = "@NAME@", size = { 1280, 720 }, fps = 24, duration = when.length,
  sound = "tune.wav", marks = { night = 1, crouch = frame_of(when.crouch),
    leap = frame_of(when.leap), catch = frame_of(when.catch), land = frame_of(when.land) },
  frame = function(f)
    local drawn = f:on(2) / f.fps -- the cat has a new drawing on every second frame
    local x, y = cat.neck(drawn)
    local warmth = waking((f.time - when.lights) / 1.6)
    local lamplight = mix(clear, set.lamp, 0.8 * warmth)
    local u = glide(f.progress)
    -- Each cel has its depth, and the camera glides: near cels move more.
    return multiplane { film = { f.width, f.height }, fit = true,
      camera = { x = 60 * u, z = 50 * u },
      { cel { town.sky(f.time, set.stars) }:named "sky", z = 5000 },
      { cel { town.hills }:named "hills", z = 2500 },
      { cel { town.far.houses }:named "far houses", z = 1300 },
      { cel { lit(town.far.windows, f.time, 14) }:named "far windows", z = 1300 },
      { cel { town.near.houses, front = { 1 + 1.1 * warmth, 1 + 0.5 * warmth, 1 } }
        :named "houses", z = 500 },
      { cel { lit(town.near.windows, f.time, 26) }:named "windows", z = 500 },
      { cel { town.roof, lit(town.panes, f.time, 30) }:named "roof" },
      { cel { cat.draw(drawn, set.coat, lamplight) }:translate(0, town.ridge):named "cat" },
      { cel { star(f.time, x, town.ridge + y) }:named "star" },
    }
  end }
