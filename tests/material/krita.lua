--- Layered paintings with every blend mode and with groups, against Krita's pictures of them.
--
--   lua5.4 tests/material/krita.lua [FOLDER]     with LUA_PATH and LUA_CPATH as for specs
--
-- A painting in each format, written by tests/support/paintings.lua, opened and exported by Krita.
-- Over an opaque ground, each mode has a square of its own, where 16 colours of the ground meet 16
-- of the layer, opaque and half opaque; every second layer has an opacity. Then come squares of
-- groups. A line for each square that has pixels off by more than 2 of 255, with the share of those
-- that are not; and for each format the share in all. FOLDER keeps the paintings and the pictures.
-- Needs krita and xvfb-run (Debian's krita and xvfb).
local celspan = require "celspan"
local layers = require "celspan.layers"
local paintings = require "tests.support.paintings"
local prng = require "tests.support.prng"
local system = require "tests.support.system"

local SIDE, COLUMNS, NEAR = 64, 5, 2

-- The words of each format, in the order of W3C; then those of painting programs. What Krita reads
-- otherwise than its format says is left out: it does not know "svg:exclusion", reads "svg:plus" as
-- its own "add", passes modes through groups of OpenRaster that do not say "isolate", and drops the
-- opacity of Photoshop's groups.
local formats = {
  { name = "krita", file = "krita.kra", through = { attributes = ' passthrough="1"' },
    attributes = ' mime="application/x-kra" profile="sRGB-elle-V2-srgbtrc.icc"',
    modes = { "normal", "multiply", "screen", "overlay", "darken", "lighten", "dodge", "burn",
      "hard_light", "soft_light_svg", "diff", "exclusion", "hue", "saturation", "color", "luminize",
      "add", "linear_dodge", "soft_light" } },
  { name = "openraster", file = "openraster.ora", through = { isolation = "auto" },
    modes = { "svg:src-over", "svg:multiply", "svg:screen", "svg:overlay", "svg:darken",
      "svg:lighten", "svg:color-dodge", "svg:color-burn", "svg:hard-light", "svg:soft-light",
      "svg:difference", "krita:exclusion", "svg:hue", "svg:saturation", "svg:color",
      "svg:luminosity", "krita:linear_dodge", "krita:soft_light" } },
  { name = "psd", file = "photoshop.psd", through = { blend = "pass" }, has_no_faded_groups = true,
    modes = { "norm", "mul ", "scrn", "over", "dark", "lite", "div ", "idiv", "hLit", "diff",
      "smud", "hue ", "sat ", "colr", "lum ", "lddg", "sLit" } },
}

-- ---------------------------------------------------------------- paintings

--- 16 random opaque colours.
local function colours(seed)
  local random, list = prng.new(seed), {}
  local function code() return random:whole(0, 255) end
  for i = 0, 15 do list[i] = { code(), code(), code() } end
  return list
end

--- A layer of a square: rows of colours, with columns of two alphas.
local function layer_of(name, seed, blend, opacity)
  local list = colours(seed)
  return { name = name, x = 0, y = 0, w = SIDE, h = SIDE, blend = blend, opacity = opacity,
    pixel = function(x, y)
      local c = list[y * 16 // SIDE]
      return c[1], c[2], c[3], x % 4 < 2 and 255 or 128
    end }
end

--- A group of two layers, of which the second has a mode, and what is put around them.
local function group_of(name, format, fields)
  local group = { name = name, blend = format.modes[1], isolation = "isolate", layers = {
    layer_of("rear", 200, nil, 0.8), layer_of("front", 201, format.modes[2]) } }
  for field, value in pairs(fields) do group[field] = value end
  return group
end

--- What each square shows over the ground.
local function squares_of(format)
  local list = {}
  for i, mode in ipairs(format.modes) do
    list[i] = layer_of(mode, 100 + i, mode, i % 2 == 0 and 0.6 or 1)
  end
  list[#list + 1] = group_of("a group", format, {})
  list[#list + 1] = group_of("a group with a mode", format, { blend = format.modes[3] })
  list[#list + 1] = group_of("pass-through", format, format.through)
  if format.has_no_faded_groups then return list end
  list[#list + 1] = group_of("a faded group", format, { opacity = 0.6 })
  list[#list + 1] = group_of("a faded group with a mode", format, { blend = format.modes[11],
    opacity = 0.7 })
  return list
end

local function move(layer, x, y)
  if layer.layers then
    for _, inner in ipairs(layer.layers) do move(inner, x, y) end
  else
    layer.x, layer.y = x, y
  end
end

local function painting_of(format, squares)
  local w, h = COLUMNS * SIDE, (#squares + COLUMNS - 1) // COLUMNS * SIDE
  local list = colours(99)
  local all = { { name = "ground", x = 0, y = 0, w = w, h = h, pixel = function(x)
    local c = list[x % SIDE * 16 // SIDE]
    return c[1], c[2], c[3], 255
  end } }
  for i, square in ipairs(squares) do
    move(square, (i - 1) % COLUMNS * SIDE, (i - 1) // COLUMNS * SIDE)
    all[i + 1] = square
  end
  return paintings[format.name] { w = w, h = h, layers = all, attributes = format.attributes,
    are_groups_full = true }
end

-- ---------------------------------------------------------------- pictures

local function codes(object, w, h)
  local rostrum = celspan.rostrum { celspan.cel { object } }
  local film = celspan.film { size = { w, h }, frames = 1, space = "srgb",
                              frame = function() return rostrum end }
  return assert(celspan.pixels(film)):bytes { depth = 8 }
end

local function exported(path)
  local png = path .. ".png"
  os.execute(("timeout 120 xvfb-run -a krita --export --export-filename '%s' '%s' >'%s.log' 2>&1")
    :format(png, path, path))
  assert(system.read(png), "Krita did not export " .. path)
  return celspan.image { file = png, x = 0, y = 0, sampling = "nearest" }
end

--- How many pixels of square i are near, and by how much the worst is off.
local function compare(i, a, b, w)
  local near, worst = 0, 0
  local left, top = (i - 1) % COLUMNS * SIDE, (i - 1) // COLUMNS * SIDE
  for y = top, top + SIDE - 1 do
    for x = left, left + SIDE - 1 do
      local at, most = 4 * (y * w + x), 0
      for c = 1, 4 do most = math.max(most, math.abs(a:byte(at + c) - b:byte(at + c))) end
      near, worst = near + (most <= NEAR and 1 or 0), math.max(worst, most)
    end
  end
  return near, worst
end

local function try(format, folder)
  local path, squares = folder .. "/" .. format.file, squares_of(format)
  system.write(path, painting_of(format, squares))
  local tree, near, worst = layers.load(path), 0, 0
  for _, note in ipairs(tree.skipped) do print(("  %s: %s"):format(note.layer, note.what)) end
  local w, h = tree.width, tree.height
  local ours, theirs = codes(tree.object, w, h), codes(exported(path), w, h)
  for i, square in ipairs(squares) do
    local here, most = compare(i, ours, theirs, w)
    if most > NEAR then
      print(("  %s: %.2f %%, the worst off by %d"):format(square.name, 100 * here / SIDE ^ 2, most))
    end
    near, worst = near + here, math.max(worst, most)
  end
  print(("%s: %d squares, %.2f %% of the pixels within %d codes, the worst off by %d"):format(
    format.name, #squares, 100 * near / (#squares * SIDE ^ 2), NEAR, worst))
end

local folder = arg[1] or os.tmpname()
if not arg[1] then os.remove(folder) end
os.execute(("mkdir -p '%s'"):format(folder))
for _, format in ipairs(formats) do try(format, folder) end
if not arg[1] then os.execute(("rm -rf '%s'"):format(folder)) end
