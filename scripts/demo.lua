-- draft
local celspan = require "celspan"
local ease = require "celspan.ease"
local palette = require "demo.palette"
local sky = require "demo.sky"
local landscape = require "demo.landscape"

local pan = ease "inOutSine"

return celspan.film { title = "The lamplighter", frames = 240, frame = function(f)
  local time = f.middle
  local travel = 240 * pan(f.progress)
  local function plane(depth, light, ...)
    return celspan.cel { celspan.union { ... }, front = light and palette.lights[light]:at(time),
                         viewport = { travel * depth, 0, f.width, f.height } }
  end
  local glow, disc = sky.sun(time)
  return celspan.rostrum {
    sky.air(time), sky.stars(time, 7.2), glow, disc, sky.clouds(time),
    plane(0.1, "far", landscape.mountains),
    plane(0.2, "far", landscape.hills),
    plane(0.3, "middle", landscape.lake),
    plane(0.42, "middle", landscape.poplars, landscape.slope),
    plane(0.65, "near", landscape.oaks, landscape.near),
    plane(1, "near", landscape.ground),
    plane(1.5, "near", landscape.meadow),
  }
end }
