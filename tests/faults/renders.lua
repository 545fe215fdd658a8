-- Small renders that together use everything that makes a frame: for tests/faults, which makes
-- every call in each of them fail. The chunk is called with the folder of the tree and with a
-- function that represents a host's procedure that may fail.
--
-- Returns a list of renders: name, film, size, and
--   sinks     what it is rendered into, in addition to "digest": see tests/faults/stage.h
--   is_cold   it reads files, which a context caches: every try has a new context
--   workers   1 by default
--   leaves_out   it leaves out missing files, and reports it
--   has_modules, has_type   it needs pictures, or art and type, which a build may lack
local root, visit = ...
local celspan = require "celspan"

local WIDTH, HEIGHT = 24, 18

local function linear(...)
  return celspan.linear { from = { 2, 2 }, to = { 22, 14 }, ... }
end

local ramp = linear({ 0, "#f04" }, { 0.4, celspan.gel(0.5, 1, 0.2) }, { 1, "#0044ff88" })
local ball = celspan.radial { centre = { 12, 9 }, radius = 10, { 0, "#fff" }, { 1, "#22000088" } }

local function shapes()
  local points = {}
  for i = 1, 7 do points[i] = { 12 + 10 * math.cos(i * 2.4), 9 + 8 * math.sin(i * 2.4) } end
  return celspan.rostrum { back = "#345", celspan.cel {
    celspan.rect { 1.5, 1, 20, 15, radius = 3, texture = "#c84" },
    celspan.nurbs { points = points, texture = ramp },
    celspan.polygon { { 3, 3 }, { 21, 5 }, { 8, 16 }, rule = "evenodd", texture = ball },
    celspan.ellipse { centre = { 12, 9 }, radii = { 7, 3 }, texture = celspan.gel(1, 0.6, 0.3) },
    celspan.path { d = "M2 16C8 2 16 2 22 16Q12 12 2 16Z", texture = "#4488cccc" },
    celspan.triangle { { 1, 1 }, { 9, 2 }, { 4, 8 }, texture = "#ffffff88" }:rotate(20, 4, 4) } }
end

local function booleans()
  local disc = celspan.circle { centre = { 9, 9 }, radius = 7, texture = ramp }
  local bar = celspan.rect { 4, 6, 18, 6, texture = "#00aa00cc" }
  local ring = disc - celspan.circle { centre = { 9, 9 }, radius = 4 }
  local many = {}
  for i = 1, 70 do many[i] = celspan.rect { i * 0.3, i % 16, 1.2, 1.2, texture = "#ffffff66" } end
  return celspan.rostrum { back = "#222", celspan.cel {
    celspan.xor { ring, bar }:fade(0.8), celspan.clip(disc, bar):translate(3, 3),
    (disc & bar) | celspan.circle { centre = { 18, 12 }, radius = 3, texture = "#f0f" },
    celspan.union(many) } }
end

local function light()
  return celspan.rostrum { front = { 0.7, 0.8, 1 }, brightness = 1.2,
    back = { texture = ramp, gain = 0.7 },
    celspan.cel { celspan.circle { centre = { 9, 9 }, radius = 6,
      texture = celspan.gel(1, 0.5, 0.2) },
      back = { 0.4, 0.3, 0.2, 0.5 } },
    celspan.cel { celspan.rect { 8, 4, 12, 12, texture = "#ffffffcc" }, opacity = 0.7,
      front = { texture = ball, gain = 1.4, on = "cel" } } }
end

--- Objects that show other points: what displaces, and a medium, need grids of their own.
local function shifted()
  local disc = celspan.circle { centre = { 9, 9 }, radius = 7, texture = ramp }
  local by = celspan.circle { centre = { 12, 9 }, radius = 8, texture = ball }
  return celspan.rostrum { back = "#345", celspan.cel {
    disc:displace { by = by, scale = 9 }, disc:blur(4, { angle = 30 }),
    by:blur(30, { spin = { 4, 4 } }):displace { by = disc, scale = -6, space = "linear" },
    disc:blur(50, { zoom = { 12, 9 }, edge = "extend" }):blend "screen" } }
end

local function pixels(format, size, count)
  local bytes = {}
  for i = 1, count do bytes[i] = string.char((i * 37 + i // 7) % 256) end
  return celspan.picture { pixels = table.concat(bytes), size = size, format = format,
                           box = { 2, 2, 20, 14 } }
end

local function pictures()
  local image = pixels("rgba8", { 40, 30 }, 4 * 40 * 30)
  local grey = pixels("grey8", { 5, 4 }, 20)
  return celspan.rostrum { back = "#000", celspan.cel {
    celspan.rect { 1, 1, 22, 16, texture = image },
    celspan.circle { centre = { 15, 9 }, radius = 6, texture = grey }:quad(
      { { 0, 0 }, { 24, 0 }, { 24, 18 }, { 0, 18 } },
      { { 2, 1 }, { 22, 4 }, { 20, 17 }, { 4, 14 } }) } }
end

local function files(large)
  return celspan.rostrum { back = "#123", celspan.cel {
    celspan.image { file = root .. large, w = 24 },
    celspan.rect { 2, 2, 12, 10, texture = celspan.picture { box = { 2, 2, 12, 10 },
      file = root .. "/tests/faults/pixels.png" } } } }
end

local function text()
  return celspan.rostrum { back = "#fff", celspan.cel {
    celspan.text { "Ag8 ->", font = root .. "/scripts/type/block.ttf", size = 9, at = { 2, 12 },
      texture = ramp } } }
end

local function drawing()
  local art = assert(require("celspan.svg").read(root .. "/tests/faults/drawing.svg"))
  return celspan.rostrum { back = "#fff", celspan.cel { art.object } }
end

local function painting()
  local tree = assert(require("celspan.layers").read(root .. "/tests/fuzz/corpus/psd/packbits8"))
  local cels = { back = "#fff",
    camera = { centre = { tree.width / 2, tree.height / 2 }, width = tree.width } }
  for _, cel in ipairs(tree:cels()) do cels[#cels + 1] = cel end
  return celspan.rostrum(cels)
end

local function strokes()
  return celspan.rostrum { back = "#fee", celspan.cel {
    celspan.stroke { points = { { 2, 2, 1 }, { 20, 5, 4 }, { 6, 15, 2 }, { 21, 15, 1 } }, width = 3,
      texture = ramp },
    celspan.stroke { d = "M3 9L20 9L20 15", width = 2, dash = { 3, 1.5 }, cap = "round",
      join = "round",
      texture = "#024" },
    celspan.circle { centre = { 12, 9 }, radius = 6 }:stroke { width = 1.5,
      texture = "#aa0000cc" } } }
end

local function defocus(kernel)
  local image = pixels("rgb8", { 16, 12 }, 3 * 16 * 12)
  return celspan.rostrum { back = "#224",
    celspan.cel { defocus = { radius = 2.5, kernel = kernel },
      celspan.rect { 3, 3, 12, 9, texture = image },
      celspan.circle { centre = { 16, 10 }, radius = 5, texture = ramp } },
    celspan.cel { defocus = { radius = 0.7, kernel = kernel }, opacity = 0.8,
      celspan.rect { 10, 2, 8, 13, texture = "#ffffffbb" } } }
end

local function neighbours()
  local art = assert(require("celspan.svg").read(root .. "/tests/faults/neighbours.svg"))
  return celspan.rostrum { back = "#fff", celspan.cel { art.object,
    celspan.circle { centre = { 16, 10 }, radius = 5, texture = ramp }:sharpen { radius = 3 } } }
end

local function kernels()
  local tent = { kernel = function(x) visit() return math.max(0, 1 - math.abs(x)) end, radius = 1 }
  local inner = shapes()
  return { { celspan.rostrum { celspan.cel { celspan.circle { centre = { 12, 9 }, radius = 7,
      texture = ball } }, back = "#fff", antialias = { kernel = "lanczos" } }, 0.5 },
    { celspan.rostrum { celspan.cel { celspan.rect { 3, 3, 15, 9, texture = ramp } },
      antialias = tent }, 0.25 },
    { inner, 0.25 } }
end

local function viewports()
  local inner = celspan.rostrum { size = { 20, 14 }, back = { 0.5, 0, 0, 0.5 },
    camera = { centre = { 10, 7 }, width = 24, rotate = 12 },
    celspan.cel { celspan.circle { centre = { 10, 7 }, radius = 6, texture = ramp },
      viewport = { 2, 2, 16, 10 } } }
  return celspan.rostrum { back = "#111", celspan.cel { inner:translate(3, 2),
    celspan.rect { 0, 14, 24, 2, texture = "#ffff0088" } },
    celspan.cel { inner:scale(0.5), viewport = { -4, -4, 32, 26 }, opacity = 0.6 } }
end

local function dense()
  local points, squares = { rule = "evenodd", texture = ramp }, {}
  for i = 1, 160 do points[i] = { (i * 7.31) % 24, (i * i * 3.77) % 18 } end
  for i = 1, 120 do
    squares[i] = celspan.rect { (i * 5.17) % 23, (i * 3.31) % 17, 0.7, 0.7,
      texture = celspan.rgb(i / 120, 0.5, 0.2, 0.6) }
  end
  return celspan.rostrum { celspan.cel { celspan.polygon(points) }, celspan.cel(squares) }
end

local function crowd()
  local lines = {}
  for i = 1, 60 do
    lines[i] = celspan.stroke { points = { { (i * 7.31) % 24, (i * 3.77) % 18 },
      { (i * 11.3) % 24, (i * 5.93) % 18 }, { (i * 2.17) % 24, (i * 9.71) % 18 } }, width = 0.3,
      texture = celspan.rgb(i / 60, 0.5, 0.2, 0.25) }
  end
  return celspan.rostrum { back = "#fff", celspan.cel(lines) }
end

local function procedures()
  return celspan.rostrum { back = "#fff", celspan.cel {
    celspan.scanline { bounds = { 2, 2, 20, 14 }, spans = function(y)
      visit()
      return { { 3 + 0.1 * y, 9, "#0f0" }, { 10, 18, "#f00", "#0000ff88" },
        { 19, 22, array = { "#fff", "#000", "#888" } } }
    end } } }
end

local makers = {
  { name = "shapes", make = shapes,
    sinks = { "rows", "sink", "float", "png", "png16", "tga", "span" } },
  { name = "booleans", make = booleans, sinks = { "probe" } },
  { name = "light", make = light, sinks = { "dither.png", "probe" } },
  { name = "pictures", make = pictures, sinks = { "png", "probe" } },
  { name = "files", make = function() return files "/scripts/pictures/scan.png" end, is_cold = true,
    sinks = { "png" }, has_modules = true },
  { name = "text", make = text, is_cold = true, sinks = {}, has_type = true },
  { name = "drawing", make = drawing, is_cold = true, leaves_out = true, sinks = {},
    has_type = true },
  { name = "painting", make = painting, is_cold = true, sinks = {} },
  { name = "strokes", make = strokes, sinks = { "span" } },
  { name = "gaussian", make = function() return defocus "gaussian" end, sinks = { "png" } },
  { name = "neighbours", make = neighbours, is_cold = true, sinks = {}, has_type = true },
  { name = "disc", make = function() return defocus "disc" end, sinks = {} },
  { name = "shifted", make = shifted, sinks = {} },
  { name = "kernels", make = kernels, sinks = { "sink" } },
  { name = "viewports", make = viewports, sinks = { "rows" } },
  { name = "dense", make = dense, sinks = { "tga" } },
  { name = "crowd", make = crowd, sinks = { "png" } },
  { name = "procedures", make = procedures, sinks = { "sink", "png", "rows", "probe" } },
  { name = "shapes by two", make = shapes, workers = 2, sinks = { "png", "tga", "span" } },
  { name = "files by two", make = function() return files "/tests/faults/pixels.png" end,
    workers = 2, is_cold = true, sinks = { "png" }, has_modules = true },
  { name = "gaussian by two", make = function() return defocus "gaussian" end, workers = 2,
    sinks = { "png16" } },
  { name = "encoders", make = shapes, has_modules = true,
    sinks = { "exr", "tiff", "jpg", "dpx", "webp", "avif", "bmp", "ppm", "hdr" } },
}

for _, one in ipairs(makers) do
  one.film = celspan.film { size = { WIDTH, HEIGHT }, frame = one.make }
end
return makers
