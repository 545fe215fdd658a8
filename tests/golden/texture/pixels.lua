-- Pixels in memory: copied at their own size, one span per texel where they are enlarged upright,
-- gradients between texels, a slide in front of a back light.
local celspan = require "celspan"
local function pixels(format, codes, fields)
  fields.pixels, fields.size, fields.format = codes, { 4, 2 }, format
  return celspan.picture(fields)
end
local grey = "\0\x40\x80\xff\xff\x80\x40\0"
local straight = "\xff\0\0\xff\xff\0\0\x80\0\xff\0\0\0\xff\0\xff"
return celspan.film { size = { 40, 8 }, frame = function()
  return celspan.rostrum { antialias = "none", back = { 0.25, 0.25, 0.5, 1 }, celspan.cel {
    celspan.rect { 1, 1, 4, 2, texture = pixels("grey8", grey, {}) },
    celspan.rect { 1, 4, 4, 2, texture = pixels("grey8", grey, { as = "gel", colour = "linear" }) },
    celspan.rect { 7, 0, 16, 8,
      texture = pixels("rgba8", straight:rep(2), { sampling = "nearest" }) },
    celspan.rect { 24, 0, 16, 8,
      texture = pixels("rgba8", straight:rep(2),
        { alpha = "premultiplied", sampling = "bilinear" }) },
  } }
end }
