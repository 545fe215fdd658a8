--- Grain of films, rostrums and cels: noise in front of the art, added to its codes where it is.
--
-- The noise is a sum of three octaves, n, whose deviation is DEVIATION. The mode linear-light adds
-- 2 s - 1 to a code, so a source s = 1/2 + amount n / (2 DEVIATION) has the deviation of `amount`.
local celspan = require "celspan"
local native = require "celspan.native"

local grain = {}

local GAIN = 0.7
-- Turned, so that pixels lie everywhere in cells, not always at the same place of them.
local COS, SIN = 0.8253356149, 0.5646424734
local DEVIATION = (0.0930 * (1 + GAIN ^ 2 + GAIN ^ 4)) ^ 0.5 -- of an octave 0.0930, squared

--- The seed of a frame: a whole number of 31 bits.
local function seed_of(options, frame)
  return ((options.seed or 0) + 0x9e3779b1 * (options.frame or frame or 0)) % 0x7fffffff
end

local function grey(code)
  local light = native.light(code)
  return celspan.rgb(light, light, light)
end

--- The noise of a frame, in film units.
function grain.texture(options, frame)
  local most = (options.amount or 0.05) / (2 * DEVIATION)
  return celspan.noise { kind = "fractal", size = options.size or 1.5, octaves = 3,
    gain = GAIN, fade = false, seed = seed_of(options, frame),
    matrix = { COS, -SIN, 0, SIN, COS, 0, 0, 0, 1 },
    colours = { grey(0.5 - most), grey(0.5 + most) } }
end

--- The objects of a cel as one object with grain.
function grain.of_objects(options, frame, list)
  local art = celspan.group(list)
  local x, y, w, h = art:bounds()
  if not x then return art end
  local sheet = celspan.rect { x - 1, y - 1, w + 2, h + 2, texture = grain.texture(options, frame) }
  return celspan.group { art, native.blend_within(sheet, "linear-light"), isolate = true,
    space = "srgb" }
end

--- A rostrum with the grain of its film, unless it has its own.
function grain.of_rostrum(rostrum, film, frame)
  if rostrum.grain then return rostrum end
  local own = { frame = frame }
  for name, value in pairs(film.grain) do own[name] = value end
  return rostrum:with { grain = own, space = rostrum.space or film.space or "linear" }
end

return grain
