--- Colours by lightness, chroma and hue, and palettes.
--
--   colour.oklch(0.7, 0.15, 50)               -- orange: lightness, chroma, hue in degrees
--   colour.lighten("#f26419", 0.1)            -- the same hue, lighter by 0.1
--   colour.mix("#f26419", "#1769aa", 0.5)     -- by way of Oklab, without a grey middle
--
--   local palette = colour.palette{ day = { sky = "#9bd1ff", roof = "#b5482f" },
--                                   night = { sky = "#101a33", roof = "#3c2430" } }
--   palette:at "day".sky      palette:between("day", "night", u).roof
--
--   local day = colour.palette "day.gpl"      -- a set of a file, { sky = "#9bd1ff", ... }
--   colour.palette{ day = day, night = "night.kpl" }
--
-- Oklab: Björn Ottosson, "A perceptual color space for image processing", 2020, from linear sRGB.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"

local colour = {}

local function refuse(text, ...) native.refuse("colour: " .. text:format(...)) end

-- ---------------------------------------------------------------- Oklab

local function root(x) return x < 0 and -(-x) ^ (1 / 3) or x ^ (1 / 3) end

local function to_oklab(r, g, b)
  local l = root(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b)
  local m = root(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b)
  local s = root(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b)
  return 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s
end

local function to_rgb(lightness, a, b)
  local l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ^ 3
  local m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ^ 3
  local s = (lightness - 0.0894841775 * a - 1.2914855480 * b) ^ 3
  return 4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s
end

local SLACK = 1e-7 -- the rounding error of a colour of sRGB

local function is_srgb(r, g, b)
  local least, most = math.min(r, g, b), math.max(r, g, b)
  return least >= -SLACK and most <= 1 + SLACK
end

--- The nearest colour of sRGB with this lightness and hue; its chroma is reduced. If the lightness
--- is outside of 0..1, it is black or white.
local function paint_of(lightness, a, b, alpha)
  lightness = math.max(0, math.min(1, lightness))
  local low, high = 0, 1
  if is_srgb(to_rgb(lightness, a, b)) then low = 1 end
  for _ = 1, low == 1 and 0 or 40 do
    local middle = (low + high) / 2
    if is_srgb(to_rgb(lightness, a * middle, b * middle)) then
      low = middle
    else
      high = middle
    end
  end
  if lightness == 0 then return celspan.rgb(0, 0, 0, alpha) end
  local red, green, blue = to_rgb(lightness, a * low, b * low)
  local function limited(x) return math.max(0, math.min(1, x)) end
  return celspan.rgb(limited(red), limited(green), limited(blue), alpha)
end

--- The Oklab of a colour, and its alpha.
local function read(noun, value)
  local paint = value
  if type(value) == "string" then
    local good, made = pcall(celspan.rgb, value)
    if not good then refuse("%s: %q is not a colour, such as \"#f26419\"", noun, value) end
    paint = made
  end
  local good, pigment, beta = pcall(function() return paint.pigment, paint.beta end)
  fields.expect_kind(good and type(pigment) == "table", value,
    "colour: %s takes colours, such as \"#f26419\"", noun)
  local lightness, a, b = to_oklab(pigment[1], pigment[2], pigment[3])
  return lightness, a, b, beta
end

local function check(noun, name, value)
  fields.expect(fields.is_finite(value), value,
    "colour: %s: its %s must be a finite number", noun, name)
  return value
end

--- A colour described by its appearance. A chroma that sRGB does not have at this lightness is
--- reduced.
---@param lightness number 0: black, 1: white
---@param chroma number 0: grey; the strongest colours of sRGB have about 0.3
---@param hue number Degrees: about 30 red, 110 yellow, 145 green, 265 blue
---@param alpha? number
---@return celspan.paint
function colour.oklch(lightness, chroma, hue, alpha)
  check("oklch", "lightness", lightness)
  check("oklch", "chroma", chroma)
  local angle = math.rad(check("oklch", "hue", hue) % 360)
  return paint_of(lightness, chroma * math.cos(angle), chroma * math.sin(angle), alpha)
end

--- Lightness, chroma, hue and alpha of a colour.
---@param value celspan.colour
---@return number lightness, number chroma, number hue, number alpha
function colour.parts(value)
  local lightness, a, b, alpha = read("parts", value)
  return lightness, math.sqrt(a * a + b * b), math.deg(math.atan(b, a)) % 360, alpha
end

--- The same hue, lighter by an amount of lightness (0..1), or darker by a negative one.
---@param value celspan.colour
---@param amount number
---@return celspan.paint
function colour.lighten(value, amount)
  check("lighten", "amount", amount)
  local lightness, a, b, alpha = read("lighten", value)
  return paint_of(lightness + amount, a, b, alpha)
end

--- The colour between two others for the eye: mixed in Oklab.
---@param p celspan.colour
---@param q celspan.colour
---@param u number 0: p, 1: q
---@return celspan.paint
function colour.mix(p, q, u)
  u = math.max(0, math.min(1, check("mix", "share", u)))
  local l1, a1, b1, alpha1 = read("mix", p)
  local l2, a2, b2, alpha2 = read("mix", q)
  local function between(x, y) return x + (y - x) * u end
  return paint_of(between(l1, l2), between(a1, a2), between(b1, b2), between(alpha1, alpha2))
end

-- ---------------------------------------------------------------- palettes

---@class celspan.colour.palette
local Palette = { __name = "celspan.colour.palette" }
local methods = {}
Palette.__index = fields.reads("a palette", methods)

local function check_names(name, colours, names)
  for key, value in next, colours do
    if type(key) ~= "string" then
      refuse("palette '%s' must have its colours by name, got the key %s", name, fields.key(key))
    end
    read(("palette '%s': '%s'"):format(name, key), value)
  end
  for key in next, names do
    if colours[key] == nil then refuse("palette '%s' has no colour '%s'", name, key) end
  end
  for key in next, colours do
    if names[key] == nil then refuse("only palette '%s' has a colour '%s'", name, key) end
  end
end

local function set_of_file(path)
  local set, message = require "celspan.palette_files".read(path)
  return set or native.refuse("colour: palette: " .. message)
end

--- A copy of the sets, in which the names of files are replaced by the colours in them.
local function opened(sets)
  local copy = {}
  for name, set in next, sets do copy[name] = type(set) == "string" and set_of_file(set) or set end
  return copy
end

--- Sets of colours that can be exchanged: each has the same names. A set is a table of colours by
--- name, or the name of a file: .gpl, .kpl, .ase, .aco, .tpl or .json. A file alone is its set.
---@param sets string|table<string, string|table<string, celspan.colour>>
---@return celspan.colour.palette|table<string, string>
function colour.palette(sets)
  if type(sets) == "string" then return set_of_file(sets) end
  if type(sets) ~= "table" or next(sets) == nil then
    refuse("palette takes sets of colours by name, such as { day = { sky = \"#9bd1ff\" } }")
  end
  sets = opened(sets)
  local list, names = {}, nil
  for name in next, sets do list[#list + 1] = tostring(name) end
  table.sort(list)
  for _, name in ipairs(list) do
    fields.expect_kind(type(sets[name]) == "table", sets[name],
      "colour: palette '%s' must be a table of colours by name", name)
    names = names or sets[name]
    check_names(name, sets[name], names)
  end
  return setmetatable({ sets = sets, names = list }, Palette)
end

local function set_of(palette, name)
  local set = type(name) == "string" and palette.sets[name]
  if set then return set end
  refuse("there is no palette '%s'%s", fields.key(name), fields.choice(name, palette.names))
end

--- The colours of a set by name.
---@param name string
---@return table<string, celspan.colour>
function methods:at(name)
  fields.self("palette", Palette, self, "at")
  local copy = {}
  for key, value in next, set_of(self, name) do copy[key] = value end
  return copy
end

--- The colours between two sets.
---@param from string
---@param to string
---@param u number 0: from, 1: to
---@return table<string, celspan.paint>
function methods:between(from, to, u)
  fields.self("palette", Palette, self, "between")
  local first, second, mixed = set_of(self, from), set_of(self, to), {}
  for key, value in next, first do mixed[key] = colour.mix(value, second[key], u) end
  return mixed
end

return fields.seal("colour", colour)
