-- From noon to night: the light is removed from a picture, which a script drew in place of a
-- photograph, and the rest is relit through the day. A photograph of yours, and its light, may be
-- given after --:
--   celspan render scripts/relight.lua -o dusk.mp4 -- photo.jpg "#fff4e0"
local photo = require "relight.photo"
local relight = require "celspan.relight"

local file, noon = ...
local picture = file and celspan.picture { file = file } or photo.take()
local bare = assert(relight.from { picture = picture,
  light = noon or file and "#fffaf0" or photo.light })
local frame = file and image { file = file }
  or rect { 0, 0, photo.width, photo.height }
local _, _, width, height = frame:bounds()
local street = rect { 0, 0, width, height, fill = bare }

--- The light of the sky, and that of sky and sun, by the progress of the film: at noon both are
-- white, in the evening the sun is red, and at night there is a lamp.
local sky = keys { { 0, { 0.56, 0.55, 0.52 } }, { 0.5, { 0.4, 0.35, 0.33 }, "inOutSine" },
  { 0.75, { 0.2, 0.18, 0.19 }, "inOutSine" }, { 1, { 0.035, 0.05, 0.06 }, "inOutSine" } }
local sun = keys { { 0, { 1.1, 1.05, 0.9 } }, { 0.5, { 1.55, 0.95, 0.5 }, "inOutSine" },
  { 0.75, { 0.5, 0.3, 0.22 }, "inOutSine" }, { 1, { 0.035, 0.05, 0.06 }, "inOutSine" } }
local lamp = keys { { 0.7, 0 }, { 0.9, 1, "inOutSine" } }

return film { title = "From noon to dusk", size = { width, height }, fps = 24, frames = 120,
  frame = function(f)
    local u = f.progress
    local sunny = cel { street, front = sun:at(u) }
    if file then return sunny end
    local shade = cel { clip(street, photo.shade(u)), front = sky:at(u), defocus = 1 }
    local night = rostrum { cel { street, front = { fill = radial(photo.lamp), gain = 1.6 } },
      cel { photo.lights } }
    return { { rostrum { sunny, shade }, 1 }, { night, lamp:at(u) } }
  end }
