--- The mode "dissolve" of painting programs: celspan.dissolve.
--
-- The film is cut into squares of one unit, which are the pixels of a film in its own size. Each
-- has a number from 0 to 1, a hash of its place and of the seed: white noise. An object is opaque
-- in the squares whose number is more than 1 less its alpha, and clear in the others.
local celspan = require "celspan"
local fields = require "celspan.fields"

local dissolve = {}

local MARGIN = 1   -- units around the bounds, for shapes that are drawn by their pixels
local LEAST = 2e-7 -- the number of no square is 0, so an opaque object has no holes

--- An object of which the alpha decides by chance whether a pixel of the film is opaque or clear.
---@param object celspan.shape
---@param seed? integer Another one chooses other pixels (0)
---@return celspan.object
function dissolve.by_chance(object, seed)
  fields.object("dissolve", object)
  fields.must(seed == nil or math.type(seed) == "integer", "dissolve: the seed", "a whole number",
    seed)
  local x, y, w, h = object:bounds()
  if not x then return object end
  local numbers = celspan.noise { kind = "white", size = 1, seed = seed, fade = false,
    colours = { celspan.rgb(LEAST, LEAST, LEAST), "#fff" } }
  return celspan.matte(object, celspan.rect { x - MARGIN, y - MARGIN, w + 2 * MARGIN,
    h + 2 * MARGIN, texture = numbers }, { from = "dissolve" })
end

return fields.seal("dissolve", dissolve)
