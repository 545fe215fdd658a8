-- The lamplighter: ten seconds in which the evening comes, cel by cel.
--
-- A slow pan over nine planes; front lights that dim from gold to dusk; a figure whose lips follow a
-- recorded line; and a second exposure for everything that glows.
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
local black = { 0, 0, 0 }
local lamp = keys { { 3.2, 0 }, { 4.6, 1, "outQuad" } }

return celspan.film { title = "The lamplighter", frames = 240, frame = function(f)
  local time = f.middle
  local travel = 240 * pan(f.progress)
  local function window(depth) return { travel * depth, 0, f.width, f.height } end
  local function plane(depth, light, ...)
    return celspan.cel { celspan.union { ... }, front = palette.lights[light]:at(time),
                         viewport = window(depth) }
  end

  local figure, glass, frame, glow = character.draw(time, line:at(f.number))
  local function stand(v) return v:translate(1500, 946) end
  local glow_light = 7 * lamp:at(time)
  local name = title.write("celspan", (time - cue.title) / 1.5, "#ffeccb")

  local halo, disc = sky.sun(time)
  local near = {
    plane(0.65, "near", landscape.oaks, landscape.near),
    plane(1, "near", landscape.ground),
    plane(1, "figure", stand(figure), stand(frame)),
    plane(1.5, "near", landscape.meadow, landscape.branch),
  }
  local day = celspan.rostrum {
    sky.air(time), sky.stars(time, cue.stars), halo, disc, sky.clouds(time),
    flock.draw(time, -150 + 330 * time, 330 - 22 * time),
    plane(0.1, "far", landscape.mountains),
    plane(0.2, "far", landscape.hills),
    plane(0.3, "middle", landscape.lake),
    plane(0.42, "middle", landscape.poplars, landscape.slope, village.houses, village.panes),
    near[1], near[2], near[3],
    celspan.cel { stand(glass), front = { 0.5 + lamp:at(time), 0.5 + lamp:at(time), 0.5 + lamp:at(time) },
                  viewport = window(1) },
    near[4],
    celspan.cel { name:translate(330, 330), front = { 1.2, 1.2, 1.2 } },
  }
  local gels, card, halos = village.light_box(time, cue.houses, window(0.42))
  local night = celspan.rostrum {
    gels, card, halos,
    near[1]:with { front = black }, near[2]:with { front = black }, near[3]:with { front = black },
    celspan.cel { stand(glow), front = { glow_light, glow_light, glow_light }, viewport = window(1) },
    near[4]:with { front = black },
  }
  return { { day, 1 }, { night, 1 } }
end }
