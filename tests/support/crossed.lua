--- The films of the table of all outputs: a row is a frame of 48 x 32.
local celspan = require "celspan"

local W, H = 48, 32
local rect, circle = celspan.rect, celspan.circle

local function cel(...) return celspan.cel { ... } end
local function over(back, ...) return celspan.rostrum { back = back, ... } end
local function still(texture) return over(nil, cel(rect { 0, 0, W, H, texture = texture })) end

local function disc(x, y, radius, texture)
  return circle { centre = { x, y }, radius = radius, texture = texture }
end

--- Exposures of the same weight.
local function sum(...)
  local list = { ... }
  for i, rostrum in ipairs(list) do list[i] = { rostrum, 1 / #list } end
  return list
end

local function shapes(x)
  return rect { 4, 4, 20, 24, texture = "#c03010" }, disc(x, 16, 9, "#1040c0")
end

local function photo(alpha)
  local texels = {}
  for i = 0, 11 do texels[i + 1] = string.char(20 * i, 255 - 20 * i, i % 4 * 60, alpha) end
  return celspan.image { x = 8, y = 4, w = 32, h = 24, size = { 4, 3 }, sampling = "nearest",
    pixels = table.concat(texels) }
end

local function noise() return celspan.noise { size = 9, colours = { "#808080", "#e0a040" } } end

local function filtered(kernel, grain)
  return celspan.rostrum { back = "#e0e0e0", antialias = { kernel = kernel }, grain = grain,
    cel(shapes(30)) }
end

local function keyed()
  return celspan.key { celspan.group { rect { 6, 4, 36, 24, texture = "#2fb457" },
    disc(24, 16, 8, "#a06050") }, colour = "#2fb457", tolerance = 0.06, softness = 0.15 }
end

local function camera() return { centre = { 22, 16 }, width = 40, rotate = 20 } end

local crossed = {}

--- { name, the frame }; and what the frame has: bright lights, noise, a picture, a sum of
--- exposures, grain of the whole, a kernel with negative weights, gradients under a mode; or
--- whether what it has is smaller than a pixel.
crossed.rows = {
  { "opaque shapes", function() return over("#fff", cel(shapes(32))) end },
  { "shapes over nothing", function() return over(nil, cel(shapes(32))) end },
  { "gradients", function()
    return over("#fff", cel(rect { 0, 0, W, H, texture = celspan.linear { from = { 0, 0 },
      to = { W, 0 }, { 0, "#203060" }, { 1, "#f0e0a0" } } }, disc(30, 16, 12, celspan.radial {
        centre = { 30, 16 }, radius = 12, { 0, "#c0b090" }, { 1, "#a03020" } })))
  end, has_gradients = true },
  { "a translucent frame", function()
    return over(nil, cel(rect { 0, 0, W, H, texture = "#80402060" },
      disc(24, 16, 10, "#2060c0a0")))
  end },
  { "a translucent ground", function() return over({ 0.2, 0.3, 0.4, 0.5 }, cel(shapes(32))) end },
  { "light from behind above 1", function()
    return over({ 2, 1.5, 1.2 }, cel(shapes(32)))
  end, is_bright = true },
  { "light in front above 1", function()
    return celspan.rostrum { front = { 2, 1.5, 1.2 }, back = "#202020", cel(shapes(32)) }
  end, is_bright = true },
  { "two exposures", function()
    return sum(over("#fff", cel(shapes(28))), over("#fff", cel(shapes(36))))
  end, is_sum = true },
  { "two equal exposures", function()
    return sum(still "#808080", still "#808080")
  end, is_sum = true },
  { "two full exposures", function()
    return sum(still "#ff0000", still "#0000ff")
  end, is_sum = true },
  { "exposures of bands", function()
    local function bands(y)
      return over("#fff", cel(rect { 0, 0, W, y, texture = "#4080c0" },
        rect { 0, y, W, H - y, texture = "#204010" }))
    end
    return sum(bands(20), bands(20))
  end, is_sum = true },
  { "exposures of a small disc", function()
    local function dot(x) return over(nil, cel(disc(x, 16.93, 0.3, "#000"))) end
    return sum(dot(20.4), dot(20.6))
  end, is_sum = true, is_small = true },
  { "grain of a cel", function()
    return over("#fff", celspan.cel { grain = { amount = 0.05 }, shapes(32) })
  end, has_noise = true },
  { "grain of a rostrum", function()
    return celspan.rostrum { back = "#fff", grain = { amount = 0.05 }, cel(shapes(32)) }
  end, has_noise = true, has_grain = true },
  { "a gaussian kernel", function() return filtered "gaussian" end },
  { "a mitchell kernel", function() return filtered "mitchell" end, is_signed = true },
  { "a lanczos kernel", function() return filtered "lanczos" end, is_signed = true },
  { "grain and a gaussian kernel", function()
    return filtered("gaussian", { amount = 0.05 })
  end, has_noise = true, has_grain = true },
  { "a picture", function() return over("#fff", cel(photo(255))) end, has_picture = true },
  { "a translucent picture", function()
    return over("#fff", cel(photo(128)))
  end, has_picture = true },
  { "a picture as the frame", function()
    return over(nil, cel(photo(255):translate(-8, -4):scale(W / 32, H / 24)))
  end, has_picture = true },
  { "a key", function() return over("#fff", cel(keyed())) end },
  { "a camera", function()
    return celspan.rostrum { camera = camera(), back = "#fff", cel(shapes(32)) }
  end },
  { "noise", function() return still(noise()) end, has_noise = true },
  { "a blur", function() return over("#fff", cel(disc(24, 16, 8, "#a02010"):blur(5))) end },
  { "a blend mode", function()
    return over("#fff", cel(rect { 0, 0, W, 16, texture = "#c0a060" }),
      celspan.cel { blend = "multiply", disc(24, 16, 10, "#60a0e0") })
  end, is_multiplied = true },
  -- several at once
  { "exposures, grain and a lanczos kernel", function()
    return sum(filtered("lanczos", { amount = 0.05 }), filtered("lanczos", { amount = 0.05 }))
  end, is_sum = true, has_noise = true },
  { "exposures of a picture and a camera", function()
    local rostrum = celspan.rostrum { camera = camera(), back = "#fff", cel(photo(255)) }
    return sum(rostrum, over("#fff", cel(photo(255))))
  end, is_sum = true, has_picture = true },
  { "noise, a translucent ground and light above 1", function()
    return celspan.rostrum { front = { 2, 1.5, 1.2 }, back = { 0.2, 0.3, 0.4, 0.5 },
      cel(rect { 8, 4, 30, 20, texture = noise() }) }
  end, is_bright = true, has_noise = true },
  { "a key over a blur, with a camera", function()
    return celspan.rostrum { camera = camera(), back = "#fff",
      cel(disc(24, 16, 8, "#a02010"):blur(5)), cel(keyed()) }
  end, is_mixed = true },
}

--- A film of rows. grain: of the film.
function crossed.film(space, grain)
  return celspan.film { size = { W, H }, frames = #crossed.rows, space = space, fps = 24,
    grain = grain and { amount = 0.05 } or nil,
    frame = function(f) return crossed.rows[f.number][2]() end }
end

return crossed
