-- Pictures of pixels for the figures that need photographs: from a given file, or drawn here and
-- converted to pixels, so that every figure can be rendered without any file.

local pixels = {}

local function coded(art, w, h, light, depth, colour)
  local rostrum = celspan.rostrum { cel { art, front = light } }
  local image = assert(celspan.pixels(rostrum, { size = { w, h }, film = { w, h } }))
  return { pixels = image:bytes { depth = depth, colour = colour, alpha = "straight" },
    size = { w, h }, format = "rgba" .. depth, colour = colour }
end

--- Art of `w` x `h` units as a picture of `w` x `h` pixels, with alpha.
function pixels.of(art, w, h, light) return coded(art, w, h, light, 8, "srgb") end

--- The same as film coded by its density: 16 bits, Cineon's curve.
function pixels.film(art, w, h, light) return coded(art, w, h, light, 16, "cineon") end

--- The fields of celspan.picture for a given file, or the result of `make`.
function pixels.given(file, make)
  if file and file ~= "" then return { file = file } end
  return make()
end

--- A texture of these fields and more.
function pixels.texture(fields, more)
  local all = {}
  for key, value in pairs(fields) do all[key] = value end
  for key, value in pairs(more or {}) do all[key] = value end
  return picture(all)
end

return pixels
