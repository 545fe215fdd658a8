-- The lamplighter: ten seconds in which evening falls, cel by cel.
--
-- A slow pan over planes at different depths; front lights that dim from gold to dusk; a figure
-- whose lips follow a recorded line; and a second exposure for everything that glows, and for
-- everything that the lantern lights.
local celspan = require "celspan"
local ease = require "celspan.ease"
local keys = require "celspan.keys"
local lips = require "celspan.lips"

local character = require "demo.character"
local flock = require "demo.flock"
local landscape = require "demo.landscape"
local palette = require "demo.palette"
local sky = require "demo.sky"
local title = require "demo.title"
local village = require "demo.village"

-- "Evening comes in layers. First the hills, then the houses ... and last of all, the stars."
local line = assert(lips.read("demo/line.tsv", { fps = 24 }))
local cue = { houses = 4.75, stars = 7.1, title = 7.9 }

local pan = ease "inOutSine"
local lamp = keys { { 3.2, 0 }, { 4.6, 1, "outQuad" } }

--- A neutral light of this strength.
local function grey(level) return { level, level, level } end

return celspan.film { title = "The lamplighter", frames = 240, frame = function(f)
  local time = f.middle
  local travel = 240 * pan(f.progress)
  local function window(depth) return { travel * depth, 0, f.width, f.height } end
  local function plane(name, depth, front, ...)
    return celspan.cel { celspan.union { ... }, front = front,
      viewport = window(depth) }:named(name)
  end
  local function light(distance) return palette.lights[distance]:at(time) end

  local figure, glass, frame, wick = character.draw(time, line:at(f.number))
  local function stand(art) return art:translate(1500, 946) end
  local flame = lamp:at(time)
  local name = title.write("celspan", (time - cue.title) / 1.5, "#ffeccb")
  local halo, disc = sky.sun(time)
  local meadow = celspan.union { landscape.meadow, landscape.branch }

  local painted = celspan.rostrum {
    sky.air(time):named "air", sky.stars(time, cue.stars):named "stars", halo:named "halo",
    disc:named "sun", sky.clouds(time):named "clouds",
    flock.draw(time, -150 + 330 * time, 330 - 22 * time):named "birds",
    plane("mountains", 0.1, light "far", landscape.mountains),
    plane("hills", 0.2, light "far", landscape.hills),
    plane("lake", 0.3, light "middle", landscape.lake),
    plane("village", 0.42, light "middle", landscape.poplars, landscape.slope, village.houses,
      village.panes),
    plane("oaks", 0.65, light "near", landscape.oaks, landscape.near),
    plane("ground", 1, light "near", landscape.ground),
    plane("lamplighter", 1, light "figure", stand(figure)),
    plane("flame", 1, grey(0.5 + flame), stand(glass)),
    plane("lantern", 1, light "figure", stand(frame)),
    plane("meadow", 1.5, light "near", meadow),
    celspan.cel { name:translate(330, 330), front = grey(1.2) }:named "title",
  }
  if flame == 0 then return painted end

  local gels, card, halos = village.light_box(time, cue.houses, window(0.42))
  local lantern = { texture = palette.lamplight(1500 + wick[1], 946 + wick[2], 900), on = "cel" }
  local function lamplit(label, gain, art)
    lantern.gain = gain * flame
    return plane(label, 1, lantern, art)
  end
  local lit = celspan.rostrum {
    gels:named "gels", card:named "card", halos:named "halos",
    lamplit("ground", 1.5, landscape.ground), lamplit("lamplighter", 1.7, stand(figure)),
    plane("flame", 1, grey(0), stand(glass)), lamplit("lantern", 1, stand(frame)),
    plane("meadow", 1.5, grey(0), meadow),
  }
  return { { painted, 1 }, { lit, 1 } }
end }
