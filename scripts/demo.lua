-- The lamplighter: a girl comes over the hill, and lights the lantern, the houses, and the sky.
--
-- Ten seconds in which evening falls: a slow pan over planes at different depths; front lights that
-- dim from gold to dusk; a figure that walks and leaps, and whose lips follow a recorded line; and
-- a second exposure for everything that glows, and for everything that the lantern lights.

local character = require "demo.character"
local flock = require "demo.flock"
local landscape = require "demo.landscape"
local palette = require "demo.palette"
local sky = require "demo.sky"
local spark = require "demo.spark"
local title = require "demo.title"
local village = require "demo.village"

-- "Evening comes in layers. First the hills, then the houses ... and last of all, the stars."
local line = assert(lips.read("demo/line.tsv", { fps = 24 }))
local cue = { houses = 4.75, throw = 7.08, stars = 7.72, title = 8 }

local pan = ease "inOutSine"
local lamp = keys { { 3.2, 0 }, { 4.6, 1, "outQuad" }, { cue.throw, 1 },
                    { cue.throw + 0.1, 0.35, "outQuad" }, { 9, 1, "inOutSine" } }
local BURST = { 745, 250 } -- where the spark ends, on the screen

local function travel_at(progress) return 240 * pan(progress) end

local thrown = { character.flame(cue.throw) }
thrown[1] = thrown[1] - travel_at(cue.throw / 10)

--- A neutral light of this strength.
local function grey(level) return { level, level, level } end

return film { title = "The lamplighter", frames = 240, frame = function(f)
  local time = f.middle
  local travel, flash = travel_at(f.progress), spark.flash(time - cue.stars)
  local function window(depth) return { travel * depth, 0, f.width, f.height } end
  local function plane(name, depth, front, ...)
    return cel { union { ... }, front = front,
      viewport = window(depth) }:named(name)
  end
  local function light(distance)
    local r, g, b = table.unpack(palette.lights[distance]:at(time))
    return { r + 0.5 * flash, g + 0.38 * flash, b + 0.26 * flash }
  end

  local figure, glass, frame = character.draw(time, line:at(f.number))
  local flame = lamp:at(time)
  local name = title.write("celspan", (time - cue.title) / 1.5, "#ffeccb")
  local halo, disc = sky.sun(time)
  local meadow = union { landscape.meadow, landscape.branch }

  local painted = rostrum {
    sky.air(time):named "air", sky.stars(time, cue.stars, BURST):named "stars",
    halo:named "halo", disc:named "sun", sky.clouds(time):named "clouds",
    flock.draw(time, -150 + 330 * time, 330 - 22 * time):named "birds",
    plane("mountains", 0.1, light "far", landscape.mountains),
    plane("hills", 0.2, light "far", landscape.hills),
    plane("lake", 0.3, light "middle", landscape.lake),
    plane("village", 0.42, light "middle", landscape.poplars, landscape.slope, village.houses,
      village.panes),
    plane("oaks", 0.65, light "near", landscape.oaks, landscape.near),
    plane("ground", 1, light "near", landscape.ground),
    plane("lamplighter", 1, light "figure", figure),
    plane("flame", 1, grey(0.5 + flame), glass),
    plane("lantern", 1, light "figure", frame),
    plane("meadow", 1.5, light "near", meadow),
    cel { name:translate(330, 330), front = grey(1.2) }:named "title",
  }
  if flame == 0 then return painted end

  local gels, card, halos = village.light_box(time, cue.houses, window(0.42))
  local x, y = character.flame(time)
  local lantern = { texture = palette.lamplight(x, y, 900), on = "cel" }
  local function lamplit(label, gain, art)
    lantern.gain = gain * flame
    return plane(label, 1, lantern, art)
  end
  local lit = rostrum {
    gels:named "gels", card:named "card", halos:named "halos",
    lamplit("ground", 1.5, landscape.ground), lamplit("lamplighter", 1.7, figure),
    plane("flame", 1, grey(0), glass), lamplit("lantern", 1, frame),
    plane("meadow", 1.5, grey(0), meadow),
    spark.draw(time, thrown, BURST, cue.throw, cue.stars),
  }
  return { { painted, 1 }, { lit, 1 } }
end }
