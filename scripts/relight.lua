-- From noon to dusk: the light is removed from a picture, which a script drew in place of a
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

--- The light of the sky, from the right, and that of the sun, from the left, by the progress of the
-- film: at noon both are white, in the evening the sun is red, and then only a blue sky is left.
local sky = keys { { 0, { 1, 1, 0.97 } }, { 0.35, { 0.8, 0.75, 0.72 }, "inOutSine" },
  { 0.7, { 0.26, 0.24, 0.42 }, "inOutSine" }, { 1, { 0.03, 0.05, 0.15 }, "inOutSine" } }
local sun = keys { { 0, { 1.1, 1.05, 0.9 } }, { 0.35, { 1.25, 0.9, 0.52 }, "inOutSine" },
  { 0.7, { 1.3, 0.44, 0.15 }, "inOutSine" }, { 1, { 0.06, 0.07, 0.19 }, "inOutSine" } }

--- Both as a light with a shape: a colour on the left that becomes another one on the right. Its
-- brightness is in the gain, because paints are at most 1.
local function daylight(u)
  local from, to, most = sun:at(u), sky:at(u), 0
  for c = 1, 3 do most = math.max(most, from[c], to[c]) end
  local function share(light)
    return rgb(light[1] / most, light[2] / most, light[3] / most)
  end
  return { gain = most, texture = linear { from = { 0, height }, to = { width, 0 },
    { 0, share(from) }, { 1, share(to) } } }
end

return film { title = "From noon to dusk", size = { width, height }, fps = 24, frames = 120,
  frame = function(f)
    return cel { front = daylight(f.progress),
      rect { 0, 0, width, height, fill = bare } }
  end }
