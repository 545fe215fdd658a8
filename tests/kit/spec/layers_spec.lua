-- Layered paintings: their contents, pixel by pixel, and refusals. One file, because all formats
-- are compared with the same pictures.
local celspan = require "celspan"
local layers = require "celspan.layers"
local merged = require "tests.support.merged"
local paintings = require "tests.support.paintings"
local present = require "tests.support.present"
local stored = require "tests.support.stored"
local raised = require "tests.support.raised"

local material = present.material

local paths = {}

--- A temporary file with these bytes.
local function write(bytes, ending)
  local path = os.tmpname() .. (ending or "")
  local file = assert(io.open(path, "wb"))
  file:write(bytes)
  file:close()
  paths[#paths + 1] = path
  return path
end

--- A temporary folder with these files.
local function write_folder(files)
  local folder = os.tmpname()
  os.remove(folder)
  os.execute(("mkdir -p '%s/sub'"):format(folder))
  for name, bytes in pairs(files) do
    local file = assert(io.open(folder .. "/" .. name, "wb"))
    file:write(bytes)
    file:close()
  end
  paths[#paths + 1] = folder
  return folder
end

after_each(function()
  for i = #paths, 1, -1 do
    os.execute(("rm -rf '%s' '%s'"):format(paths[i], paths[i]:match "^(/tmp/lua_%w+)" or paths[i]))
    paths[i] = nil
  end
end)

--- Codes that differ from pixel to pixel, with clear, translucent and opaque ones.
local function speckle(seed, most, alphas)
  most = most or 255
  alphas = alphas or { 0, 64, 128, 200, 255 }
  return function(x, y)
    local n = (x * 7 + y * 13 + seed * 29) % 256
    local a = alphas[(x + 2 * y + seed) % #alphas + 1]
    if most == 65535 then return n * 257, (n * 131) % 65536, (n * 71 + 5) % 65536, a * 257 end
    return n, (n * 3) % 256, (255 - n), a
  end
end

--- The codes of an object, "r g b a" at x, y; clear pixels are 0 0 0 0.
local function codes_of(object, w, h, depth)
  local image = celspan.pixels(celspan.rostrum { celspan.cel { object } }, { size = { w, h } })
  local bytes = image:bytes { depth = depth or 8, colour = "srgb", alpha = "straight" }
  local format = depth == 16 and "I2I2I2I2" or "BBBB"
  local size = string.packsize(format)
  return function(x, y)
    local r, g, b, a = string.unpack(format, bytes, (y * w + x) * size + 1)
    return ("%d %d %d %d"):format(r, g, b, a)
  end
end

--- Codes that LZF packs, with copies from near and far.
local function stripes(x, y)
  return x % 3 * 40, 255 - y // 2, (x * x + y) % 7, y % 9 == 0 and 0 or 255
end

local function expected(layer, x, y)
  local r, g, b, a = 0, 0, 0, 0
  if x >= layer.x and y >= layer.y and x < layer.x + layer.w and y < layer.y + layer.h then
    r, g, b, a = layer.pixel(x - layer.x, y - layer.y)
  end
  if a == 0 then return "0 0 0 0" end
  if layer.grey then return ("%d %d %d %d"):format(r, r, r, a) end
  return ("%d %d %d %d"):format(r, g, b, a)
end

--- Checks that every pixel of the entry is that of the layer.
local function check_pixels(entry, layer, w, h, depth)
  local shown = codes_of(entry.object, w, h, depth)
  for y = 0, h - 1 do
    for x = 0, w - 1 do
      local want = expected(layer, x, y)
      if shown(x, y) ~= want then
        error(("%s: pixel %d, %d is %s, not %s"):format(entry.name, x, y, shown(x, y), want), 2)
      end
    end
  end
end

local function layer_of(fields)
  local layer = { name = "layer", x = 3, y = 5, w = 30, h = 20, pixel = speckle(1) }
  for name, value in pairs(fields or {}) do layer[name] = value end
  return layer
end

if not present.type() then
  describe("layers", function()
    it("are read through the type module", function() pending "it was not built" end)
  end)
  return
end

-- ---------------------------------------------------------------- trees

--- The same painting in a format: what a tree of it must be.
local function forest(format)
  local words = format == "psd" and { multiply = "mul ", screen = "scrn", through = "pass" }
    or format == "krita" and { multiply = "multiply", screen = "screen" }
    or { multiply = "svg:multiply", screen = "svg:screen" }
  return { w = 48, h = 40, layers = {
    layer_of { name = "sky", x = 0, y = 0, w = 48, h = 40 },
    { name = "far", opacity = 0.4, layers = {
      layer_of { name = "hills", x = -6, y = 10, blend = words.multiply },
      { name = "trees", visible = false, layers = { layer_of { name = "oak", opacity = 0.6 } } },
    } },
    layer_of { name = "haze", blend = words.screen, visible = false },
  } }
end

local function shape_of(list)
  local out = {}
  for i, entry in ipairs(list) do
    out[i] = ("%s %g,%g %.2f %s%s%s"):format(entry.name, entry.x, entry.y, entry.opacity,
      entry.blend, entry.visible and "" or " hidden",
      entry.children and " [" .. shape_of(entry.children) .. "]" or "")
  end
  return table.concat(out, "; ")
end

describe("a tree of layers", function()
  for _, format in ipairs { "openraster", "krita", "psd" } do
    it("returns names, places, opacity, visibility and blend modes of " .. format, function()
      local tree = assert(layers.read(write(paintings[format](forest(format)))))
      local through = format == "psd" and "pass-through" or "normal"
      assert.are.equal(("sky 0,0 1.00 normal; far 0,0 0.40 %s [hills -6,10 1.00 multiply; "
        .. "trees 0,0 1.00 %s hidden [oak 3,5 0.60 normal]]; haze 3,5 1.00 screen hidden"):format(
          through, through), shape_of(tree))
      assert.are.same({ 48, 40 }, { tree.width, tree.height })
    end)

    it("finds layers of " .. format .. " by their paths", function()
      local tree = assert(layers.read(write(paintings[format](forest(format)))))
      assert.are.equal("oak", tree:find("far/trees/oak").name)
      assert.are.equal("far", tree:find("far").name)
      assert.is_nil(tree:find("oak"))
      assert.is_nil(tree:find("far/oak"))
    end)
  end

  it("raises an error for unknown fields and arguments", function()
    local tree = assert(layers.read(write(paintings.openraster(forest "openraster"))))
    assert.matches("a tree of layers has no 'finds'; did you mean 'find'%?",
      (raised.sentence(function() return tree.finds end)))
    assert.matches("a layer has no 'opacty'; did you mean 'opacity'%?",
      (raised.sentence(function() return tree[1].opacty end)))
    assert.is_nil(tree[1].children)
    assert.matches("layers: find takes a path like \"group/layer\", got number",
      (raised.sentence(function() tree:find(3) end)))
    assert.matches("none.ora: cannot be opened: No such file",
      raised.message(layers.load, "none.ora"))
    assert.are.equal(tree:find "far/trees/oak", tree:get "far/trees/oak")
    assert.matches('layers: there is no layer "far/trees/oka"; did you mean "far/trees/oak"%?',
      raised.message(tree.get, tree, "far/trees/oka"))
    assert.matches("layers: read takes the name of a file or folder, got nil",
      (raised.sentence(function() layers.read() end)))
    assert.matches("layers: cels: unknown field 'fron'; did you mean 'front'%?",
      (raised.sentence(function() tree:cels { fron = 1 } end)))
    assert.matches("layers: only%[2%] must be the path of a layer, got \"moon\"",
      (raised.sentence(function() tree:cels { only = { "sky", "moon" } } end)))
  end)
end)

-- ---------------------------------------------------------------- pixels

describe("the pixels of a layer", function()
  for _, deflate in ipairs { false, true } do
    it("of OpenRaster are those of its PNG, " .. (deflate and "deflated" or "stored"), function()
      local layer = layer_of { deflate = deflate }
      local tree = assert(layers.read(write(paintings.openraster { w = 40, h = 30,
        layers = { layer } })))
      check_pixels(tree[1], layer, 40, 30)
    end)
  end

  it("of OpenRaster may have 16 bits", function()
    local layer = layer_of { depth = 16, pixel = speckle(3, 65535) }
    local tree = assert(layers.read(write(paintings.openraster { w = 40, h = 30,
      layers = { layer } })))
    check_pixels(tree[1], layer, 40, 30, 16)
  end)

  it("of OpenRaster may be filtered, indexed, grey or keyed", function()
    -- Sub, Up, Average, Paeth over rows of three grey pixels with alpha
    local rows = "\0\10\255\20\255\30\255" .. "\1\10\255\10\0\10\0" .. "\2\1\0\2\0\3\0"
      .. "\3\6\128\10\64\10\64" .. "\4\1\0\1\0\1\0"
    local kinds = {
      { colour = 4, depth = 8, rows = rows, h = 5,
        want = { [0] = "10 10 10 255", "10 10 10 255", "11 11 11 255", "11 11 11 255",
          "12 12 12 255" } },
      { colour = 3, depth = 2, rows = "\0\x1b\0", h = 1, more = stored.chunk("PLTE",
        "\1\2\3\4\5\6\7\8\9\10\11\12") .. stored.chunk("tRNS", "\255\0\128"), w = 4,
        want = { [0] = "1 2 3 255" }, last = "10 11 12 255" },
      { colour = 0, depth = 4, rows = "\0\x3f\xf0", h = 1, more = stored.chunk("tRNS", "\0\15"),
        want = { [0] = "51 51 51 255" }, last = "0 0 0 0" },
      { colour = 2, depth = 8, rows = "\0\1\2\3\4\5\6\7\8\9", h = 1,
        more = stored.chunk("tEXt", "a\0b"), want = { [0] = "1 2 3 255" }, last = "7 8 9 255" },
    }
    for _, kind in ipairs(kinds) do
      local w = kind.w or 3
      local png = paintings.png_of(w, kind.h, kind.depth, kind.colour, kind.rows, kind.more)
      local tree = assert(layers.read(write(paintings.openraster { w = 8, h = 8,
        layers = { { name = "p", png = png } } })))
      local shown = codes_of(tree[1].object, 8, 8)
      for y = 0, kind.h - 1 do assert.are.equal(kind.want[y], shown(0, y)) end
      if kind.last then assert.are.equal(kind.last, shown(w - 1, 0)) end
    end
  end)

  for _, deflate in ipairs { false, true } do
    for _, lzf in ipairs { false, true } do
      it(("of Krita are those of its tiles, %s, %s"):format(lzf and "LZF" or "raw",
        deflate and "deflated" or "stored"), function()
        local layer = layer_of { w = 70, h = 66, x = -7, y = -70, tile_x = -64, tile_y = -128,
          deflate = deflate, lzf = lzf, pixel = stripes }
        local tree = assert(layers.read(write(paintings.krita { w = 80, h = 20,
          layers = { layer } })))
        assert.are.same({ -7, -70 }, { tree[1].x, tree[1].y })
        check_pixels({ name = "moved", object = tree[1].object:translate(10, 72) },
          layer_of { x = 3, y = 2, w = 70, h = 66, pixel = stripes }, 90, 80)
      end)
    end
  end

  for _, form in ipairs { { depth = 16 }, { grey = true }, { depth = 16, grey = true } } do
    it(("of Krita may have %d bits%s"):format(form.depth or 8, form.grey and ", grey" or ""),
      function()
        local layer = layer_of { depth = form.depth, grey = form.grey,
          pixel = speckle(2, form.depth and 65535) }
        local tree = assert(layers.read(write(paintings.krita { w = 40, h = 30,
          layers = { layer } })))
        check_pixels(tree[1], layer, 40, 30, form.depth)
      end)
  end

  it("of Krita are found in a folder with another name than the image's", function()
    for _, name in ipairs { "wood", "forest/x", "" } do
      local layer = layer_of {}
      local tree = assert(layers.read(write(paintings.krita { w = 40, h = 30, name = name,
        layers = { layer } })))
      check_pixels(tree[1], layer, 40, 30)
    end
  end)

  it("of Krita fill the painting where tiles are missing, if the layer says so", function()
    local layer = layer_of { x = 0, y = 0, w = 64, h = 64, beyond = "\30\20\10\255" }
    local tree = assert(layers.read(write(paintings.krita { w = 130, h = 70,
      layers = { layer } })))
    local shown = codes_of(tree[1].object, 130, 70)
    assert.are.equal("10 20 30 255", shown(129, 69))
    assert.are.equal(expected(layer, 5, 6), shown(5, 6))
    local right = layer_of { x = 100, y = 0, w = 20, h = 20, beyond = "\30\20\10\255" }
    tree = assert(layers.read(write(paintings.krita { w = 130, h = 70, layers = { right } })))
    assert.are.equal("10 20 30 255", codes_of(tree[1].object, 130, 70)(5, 6))
  end)

  for _, packing in ipairs { "raw", "packbits", "zip", "predicted" } do
    for _, depth in ipairs { 8, 16 } do
      for _, grey in ipairs { false, true } do
        it(("of Photoshop, %s, %d bits, %s"):format(packing, depth, grey and "grey" or "RGB"),
          function()
            local layer = layer_of { packing = packing, grey = grey,
              pixel = speckle(4, depth == 16 and 65535 or 255) }
            local tree = assert(layers.read(write(paintings.psd { w = 40, h = 30, depth = depth,
              grey = grey, layers = { layer } })))
            check_pixels(tree[1], layer, 40, 30, depth)
          end)
      end
    end
  end

  it("of Photoshop are multiplied by the mask, wherever it lies", function()
    local mask = { x = 10, y = -2, w = 12, h = 20, beyond = 0,
      value = function(x, y) return (x + y) % 2 == 0 and 255 or 0 end }
    local layer = layer_of { mask = mask, pixel = function(x, y) return x, y, 7, 255 end }
    local masked = layer_of { pixel = function(x, y)
      local mx, my = x + 3 - 10, y + 5 + 2
      local is_in = mx >= 0 and my >= 0 and mx < 12 and my < 20
      return x, y, 7, is_in and mask.value(mx, my) or 0
    end }
    local bytes = paintings.psd { w = 40, h = 30, layers = { layer } }
    check_pixels(assert(layers.read(write(bytes)))[1], masked, 40, 30)
    mask.off = true
    bytes = paintings.psd { w = 40, h = 30, layers = { layer } }
    check_pixels(assert(layers.read(write(bytes)))[1], layer_of { pixel = layer.pixel }, 40, 30)
  end)

  it("of a Photoshop document without layers are its merged picture", function()
    local rows = "\1\2\3\4" .. "\5\6\7\8" .. "\9\10\11\12"
    local tree = assert(layers.read(write(paintings.psd { w = 2, h = 2,
      merged = "\0\0" .. rows })))
    assert.are.equal("Background", tree[1].name)
    assert.are.equal("2 6 10 255", codes_of(tree[1].object, 2, 2)(1, 0))
    local packed = "\0\1" .. string.pack(">I2I2I2I2I2I2", 3, 3, 3, 3, 3, 3)
      .. "\1\1\2\1\3\4\1\5\6\1\7\8\1\9\10\1\11\12"
    tree = assert(layers.read(write(paintings.psd { w = 2, h = 2, merged = packed })))
    assert.are.equal("4 8 12 255", codes_of(tree[1].object, 2, 2)(1, 1))
  end)

  it("are the same with any number of workers, and with a small budget", function()
    local layer = layer_of { x = 0, y = 0, w = 300, h = 500 }
    local bytes = paintings.openraster { w = 300, h = 500, layers = { layer } }
    local tree = assert(layers.read(write(bytes)))
    local rostrum = celspan.rostrum(tree:cels())
    local one = celspan.pixels(rostrum, { size = { 300, 500 }, workers = 1 }):bytes {}
    for workers = 2, 5 do
      local again = assert(layers.read(write(bytes)))
      local cels = celspan.rostrum(again:cels())
      assert.is_true(one == celspan.pixels(cels,
        { size = { 300, 500 }, workers = workers }):bytes {})
    end
    local crop = celspan.pixels(rostrum, { size = { 300, 500 }, crop = { 10, 400, 5, 5 } })
    assert.are.equal(one:sub((400 * 300 + 10) * 4 + 1, (400 * 300 + 15) * 4),
      crop:bytes({}):sub(1, 20))
  end)

  it("are read only when they are visible", function()
    local path = write(paintings.psd { w = 40, h = 30, layers = { layer_of {} } })
    local tree = assert(layers.read(path))
    local file = assert(io.open(path, "ab"))
    file:write "more"
    file:close()
    local image, message = celspan.pixels(celspan.rostrum(tree:cels()), { size = { 40, 30 } })
    assert.is_nil(image)
    assert.matches("changed while it was in use", message)
  end)
end)

-- ---------------------------------------------------------------- cels

local function flat(r, g, b, a) return function() return r, g, b, a or 255 end end

local function linear(code)
  local c = code / 255
  return c <= 0.04045 and c / 12.92 or ((c + 0.055) / 1.055) ^ 2.4
end

local function probe(cels, x, y, space)
  local rostrum = celspan.rostrum(cels):with { space = space }
  return celspan.probe(rostrum, x, y, { film = { 40, 30 } })
end

local function near(want, ...)
  local got = { ... }
  for i, value in ipairs(want) do
    assert(math.abs(value - got[i]) < 1e-6, ("%d: %.9g is not %.9g"):format(i, got[i], value))
  end
end

local function ground_and(layer)
  local tree = assert(layers.read(write(paintings.openraster { w = 40, h = 30, layers = {
    { name = "ground", x = 0, y = 0, w = 40, h = 30, pixel = flat(200, 100, 50) }, layer } })))
  return tree
end

describe("the cels of a tree", function()
  it("are those of visible layers, rearmost first and named, each once", function()
    local tree = assert(layers.read(write(paintings.krita(forest "krita"))))
    local names = {}
    for i, cel in ipairs(tree:cels()) do names[i] = cel.name end
    assert.are.same({ "sky", "far" }, names) -- far has opacity: one cel
    names = {}
    for i, cel in ipairs(tree:cels { only = { "haze", "far/trees/oak" } }) do names[i] =
      cel.name end
    assert.are.same({ "oak", "haze" }, names)
  end)

  it("of a group without opacity are those of its layers", function()
    local painting = forest "psd"
    painting.layers[2].opacity = 1
    painting.layers[2].layers[2].visible = true
    local names = {}
    for i, cel in ipairs(assert(layers.read(write(paintings.psd(painting)))):cels()) do
      names[i] = cel.name
    end
    assert.are.same({ "sky", "hills", "oak" }, names)
  end)

  it("multiply over opaque ground, in linear light", function()
    local tree = ground_and { name = "shade", x = 0, y = 0, w = 40, h = 30, blend = "svg:multiply",
      opacity = 0.5, pixel = flat(128, 255, 64, 204) }
    local a = 0.5 * 0.8
    near({ linear(200) * (1 - a + a * linear(128)), linear(100),
      linear(50) * (1 - a + a * linear(64)), 1 }, probe(tree:cels(), 20, 15))
    assert.are.same({}, tree.skipped)
  end)

  it("add light", function()
    local tree = ground_and { name = "glow", x = 4, y = 4, w = 10, h = 10, blend = "svg:plus",
      opacity = 0.5, pixel = flat(128, 255, 64, 204) }
    local a = 0.5 * 0.8
    near({ linear(200) + a * linear(128), linear(100) + a, linear(50) + a * linear(64), 1 },
      probe(tree:cels(), 8, 8))
    near({ linear(200), linear(100), linear(50), 1 }, probe(tree:cels(), 20, 15))
    assert.are.same({}, tree.skipped)
    -- it moves with its cel
    local cels = tree:cels()
    cels[2] = cels[2]:translate(15, 0)
    near({ linear(200), linear(100), linear(50), 1 }, probe(cels, 8, 8))
    near({ linear(200) + a * linear(128), linear(100) + a, linear(50) + a * linear(64), 1 },
      probe(cels, 23, 8))
  end)

  it("add light and alpha to translucent art", function()
    local tree = assert(layers.read(write(paintings.openraster { w = 40, h = 30, layers = {
      { name = "ground", x = 0, y = 0, w = 20, h = 30, pixel = flat(200, 100, 50, 51) },
      { name = "glow", x = 0, y = 0, w = 40, h = 30, blend = "svg:plus",
        pixel = flat(128, 255, 64, 102) } } })))
    near({ 0.2 * linear(200) + 0.4 * linear(128), 0.2 * linear(100) + 0.4,
      0.2 * linear(50) + 0.4 * linear(64), 0.6 }, probe(tree:cels(), 10, 15))
    near({ 0.4 * linear(128), 0.4, 0.4 * linear(64), 0.4 }, probe(tree:cels(), 30, 15))
  end)

  --- Light and alpha of the whole tree, as an object and as cels.
  local function look(tree, x, y)
    local whole = { probe({ celspan.cel { tree.object } }, x, y) }
    near(whole, probe(tree:cels(), x, y, "srgb"))
    return table.unpack(whole)
  end

  local modes = { multiply = "multiply", screen = "screen", overlay = "overlay", darken = "darken",
    lighten = "lighten", ["color-dodge"] = "color-dodge", ["color-burn"] = "color-burn",
    ["hard-light"] = "hard-light", ["soft-light"] = "soft-light", difference = "difference",
    hue = "hue", saturation = "saturation", color = "color", luminosity = "luminosity",
    plus = "add" }

  it("have the mode that the file names", function()
    local function paint(r, g, b, a)
      local texture = celspan.rgb(linear(r), linear(g), linear(b), a)
      return celspan.rect { 0, 0, 40, 30, texture = texture }
    end
    for word, mode in pairs(modes) do
      local tree = ground_and { name = "top", x = 0, y = 0, w = 40, h = 30, blend = "svg:" .. word,
        pixel = flat(64, 180, 220, 204) }
      assert.are.same({}, tree.skipped)
      assert.are.equal(mode, tree[2].blend)
      local want = celspan.cel { paint(200, 100, 50, 1), paint(64, 180, 220, 0.8):blend(mode) }
      near({ probe({ want }, 20, 15, "srgb") }, look(tree, 20, 15))
    end
  end)

  it("in a group blend with that group alone, unless it is passed through", function()
    for isolation, want in pairs { isolate = linear(128), auto = linear(200 * 128 / 255) } do
      local tree = ground_and { name = "g", isolation = isolation, layers = {
        { name = "top", x = 0, y = 0, w = 40, h = 30, blend = "svg:multiply",
          pixel = flat(128, 128, 128) } } }
      near({ want }, look(tree, 20, 15))
      assert.are.same({}, tree.skipped)
    end
  end)

  --- A painting of Photoshop with a ground, half of which a layer hides, and one clipped to that.
  local function clipping(fields)
    local base = { name = "base", x = 0, y = 0, w = 20, h = 30, pixel = flat(0, 255, 0, 128) }
    for name, value in pairs(fields or {}) do base[name] = value end
    return assert(layers.read(write(paintings.psd { w = 40, h = 30, layers = {
      { name = "ground", x = 0, y = 0, w = 40, h = 30, pixel = flat(255, 255, 255) }, base,
      { name = "clipped", x = 0, y = 0, w = 40, h = 30, clipped = true,
        pixel = flat(255, 0, 0, 204) } } })))
  end

  it("clipped to another show where that does", function()
    local tree, a = clipping(), 128 / 255
    assert.are.same({}, tree.skipped)
    near({ linear(255 * (1 - a + a * 0.8)), linear(255 * (1 - a + a * 0.2)),
      linear(255 * (1 - a)), 1 }, look(tree, 10, 15))
    near({ 1, 1, 1, 1 }, look(tree, 30, 15))
    near({ 1, 1, 1, 1 }, look(clipping { visible = false }, 10, 15))
  end)

  it("of Krita that inherit alpha show where the layers below do", function()
    local tree = assert(layers.read(write(paintings.krita { w = 40, h = 30, layers = {
      { name = "ground", x = 0, y = 0, w = 20, h = 30, pixel = flat(0, 255, 0, 128) },
      { name = "top", x = 0, y = 0, w = 40, h = 30, pixel = flat(255, 0, 0, 204),
        attributes = ' channelflags="1110"' } } })))
    assert.are.same({}, tree.skipped)
    local a = 128 / 255
    near({ a * linear(0.8 * 255), a * linear(0.2 * 255), 0, a },
      probe({ celspan.cel { tree.object } }, 10, 15))
    near({ 0, 0, 0, 0 }, probe({ celspan.cel { tree.object } }, 30, 15))
  end)

  it("in a group with opacity are one picture, blended once", function()
    local group = { name = "both", opacity = 0.5, layers = {
      { name = "a", x = 0, y = 0, w = 40, h = 30, pixel = flat(255, 0, 0) },
      { name = "b", x = 0, y = 0, w = 40, h = 30, opacity = 0.25, pixel = flat(0, 0, 255) } } }
    local tree = ground_and(group)
    local red, blue = linear(0.75 * 255), linear(0.25 * 255)
    near({ 0.5 * linear(200) + 0.5 * red, 0.5 * linear(100), 0.5 * linear(50) + 0.5 * blue, 1 },
      probe(tree:cels(), 20, 15))
    near({ red, 0, blue, 1 }, probe({ celspan.cel { tree:find("both").object } }, 20, 15))
  end)

  it("accept lights, viewport, defocus and opacity", function()
    local tree = ground_and { name = "top", x = 0, y = 0, w = 20, h = 30, pixel = flat(0, 0, 0) }
    local cels = tree:cels { only = { "ground" }, front = { 0.5, 1, 2 }, opacity = 0.5,
      viewport = { 0, 0, 20, 15 }, defocus = 1 }
    assert.are.equal(1, #cels)
    assert.are.equal(0.5, cels[1].opacity)
    assert.are.equal(1, cels[1].defocus)
    near({ 0.25 * linear(200), 0.5 * linear(100), linear(50), 0.5 },
      probe(tree:cels { only = { "ground" }, front = { 0.5, 1, 2 }, opacity = 0.5 }, 20, 15))
  end)

  it("report what they do not show", function()
    local tree = ground_and { name = "g", opacity = 0.5, layers = {
      { name = "m", w = 2, h = 2, x = 0, y = 0, pixel = flat(1, 2, 3), blend = "svg:multiply" },
      { name = "p", w = 2, h = 2, x = 0, y = 0, pixel = flat(1, 2, 3), blend = "svg:plus" },
      { name = "s", w = 2, h = 2, x = 0, y = 0, pixel = flat(1, 2, 3),
        blend = "krita:hard mix" } } }
    local told = {}
    for i, one in ipairs(tree.skipped) do told[i] = one.layer .. ": " .. one.what end
    assert.are.same({ 'g/s: blend mode "hard-mix-krita": it is shown as normal' }, told)
  end)

  it("of Photoshop report effects that Photoshop computes", function()
    local tree = assert(layers.read(write(paintings.psd { w = 40, h = 30, layers = {
      layer_of { name = "clipped", clipped = true }, { name = "levels", tags =
        paintings.tag("levl", "\0\0\0\0") }, layer_of { name = "fx", tags =
        paintings.tag("lfx2", "\0\0\0\0") } } })))
    local told = {}
    for i, one in ipairs(tree.skipped) do told[i] = one.layer .. ": " .. one.what end
    assert.are.same({ "levels: an adjustment: it changes nothing here",
      "fx: layer effects: they are not drawn" }, told)
  end)

  it("of Krita report layers that Krita computes", function()
    local tree = assert(layers.read(write(paintings.krita { w = 40, h = 30, layers = {
      { name = "blur", kind = "adjustmentlayer" },
      layer_of { name = "inherits", attributes = ' channelflags="1110"' },
      layer_of { name = "masked", inside = '<masks><mask nodetype="transparencymask"/></masks>' },
      layer_of { name = "deep", space = "RGBAF32" } } })))
    local told = {}
    for i, one in ipairs(tree.skipped) do told[one.layer] = one.what; told[i] = true end
    assert.are.equal(3, #told)
    assert.are.equal('is a "adjustmentlayer": it is empty', told.blur)
    assert.matches('has a "transparencymask": it changes nothing here', told.masked)
    assert.matches("colour space RGBAF32: it is empty", told.deep)
  end)
end)

-- ---------------------------------------------------------------- colour profiles

describe("a colour profile", function()
  if not present.colour() then
    return it("is converted", function() pending "it was built without Little CMS" end)
  end
  local adobe = { { 0.60974, 0.31111, 0.01947 }, { 0.20528, 0.62567, 0.06087 },
    { 0.14919, 0.06322, 0.74457 } }
  local note = 'the colour profile "%s": its colours are taken as those of sRGB'

  --- A painting of one layer in the format, with the profile where that format has it.
  local function painting_with(format, profile)
    local fields = { name = "ink", profile = format == "openraster" and profile or nil }
    return paintings[format] { w = 40, h = 30, profile = profile, layers = { layer_of(fields) } }
  end

  local function told_of(bytes)
    local tree = assert(layers.read(write(bytes)))
    local told = {}
    for i, one in ipairs(tree.skipped) do told[i] = one.layer .. ": " .. one.what end
    return told, tree
  end

  --- Numbers of a profile, with 16 bits behind the point.
  local function numbers(...)
    local out = {}
    for i, number in ipairs { ... } do out[i] = string.pack(">i4",
      math.floor(number * 65536 + 0.5)) end
    return table.concat(out)
  end

  --- Codes as they are, shown as light.
  local function check_linear(tree)
    local image = celspan.pixels(celspan.rostrum { celspan.cel { tree[1].object } },
      { size = { 40, 30 } })
    local layer = layer_of {}
    for y = layer.y, layer.y + layer.h - 1 do
      local r, _, _, a = layer.pixel(4, y - layer.y)
      local shown, _, _, alpha = image:get(layer.x + 4, y)
      assert.is_true(math.abs(shown - r / 255 * a / 255) < 1e-3)
      assert.is_true(math.abs(alpha - a / 255) < 1e-3)
    end
  end

  --- Shows the layer and compares its light with that of its codes, 0 to 1 each.
  local function check_light(tree, light, tolerance)
    local image = celspan.pixels(celspan.rostrum { celspan.cel { tree[1].object } },
      { size = { 40, 30 } })
    local layer = layer_of {}
    for y = layer.y, layer.y + layer.h - 1 do
      for x = layer.x, layer.x + layer.w - 1, 3 do
        local r, g, b, a = layer.pixel(x - layer.x, y - layer.y)
        local want = { light(r / 255, g / 255, b / 255) }
        local shown = { image:get(x, y) }
        for c = 1, 3 do assert.is_near(want[c] * a / 255, shown[c], tolerance or 5e-4) end
        assert.is_near(a / 255, shown[4], 1e-6)
      end
    end
  end

  --- A place seen by D50 as light in the primaries of sRGB (Bradford's adaptation).
  local function light_of_xyz(x, y, z)
    return 3.1338561 * x - 1.6168667 * y - 0.4906146 * z, -0.9787684 * x + 1.9161415 * y
      + 0.0334540 * z,
      0.0719453 * x - 0.2289914 * y + 1.4052427 * z
  end

  local function power(exponent) return function(code) return code ^ exponent end end
  local function srgb_light(code)
    return code <= 0.04045 and code / 12.92 or ((code + 0.055) / 1.055) ^ 2.4
  end

  --- The light of codes in a profile of primaries, by default those of sRGB.
  local function light_of_places(places, curve)
    return function(...)
      local codes, xyz = { ... }, { 0, 0, 0 }
      for c = 1, 3 do
        codes[c] = curve(codes[c])
        for i = 1, 3 do xyz[i] = xyz[i] + codes[c] * (places or adobe)[c][i] end
      end
      if not places then return table.unpack(codes) end
      return light_of_xyz(table.unpack(xyz))
    end
  end

  --- A table of colours in which light mixes to less than its sum: the corners of a cube of squared
  --- codes, between which lie six tetrahedra.
  local function muddy(r, g, b)
    local most = math.max(r, g, b)
    return most * (0.3 * r + 0.2 * g) + 0.1 * b, most * (0.2 * r + 0.4 * g),
      most * 0.5 * b + 0.02 * r
  end
  local function muddy_light(...)
    local axes = { 1, 2, 3 }
    local shares = { ... }
    for i = 1, 3 do shares[i] = shares[i] ^ 2 end
    table.sort(axes, function(i, j) return shares[i] > shares[j] end)
    local corner, xyz = { 0, 0, 0 }, { muddy(0, 0, 0) }
    for _, axis in ipairs(axes) do
      local before = { muddy(table.unpack(corner)) }
      corner[axis] = 1
      for i, behind in ipairs { muddy(table.unpack(corner)) } do
        xyz[i] = xyz[i] + (behind - before[i]) * shares[axis]
      end
    end
    return light_of_xyz(table.unpack(xyz))
  end

  for _, format in ipairs { "openraster", "krita", "psd" } do
    it("of sRGB needs no note in " .. format, function()
      for _, profile in ipairs { { curve = "srgb" }, { curve = "formula" }, { wide = true },
        { curve = "para\0\0\0\0\0\4\0\0" .. numbers(2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92,
          0.04045, 0, 0) } } do
        local told, tree = told_of(painting_with(format, paintings.profile(profile)))
        assert.are.same({}, told)
        check_pixels(tree[1], layer_of {}, 40, 30)
      end
    end)

    it("of light is honoured in " .. format, function()
      for _, profile in ipairs { { curve = 1 }, { curve = "curv\0\0\0\0\0\0\0\0" },
        { curve = "para\0\0\0\0\0\0\0\0\0\1\0\0" }, { curve = 1, grey = true },
        { curve = "curv\0\0\0\0\0\0\0\2\0\0\255\255" } } do
        local told, tree = told_of(painting_with(format, paintings.profile(profile)))
        assert.are.same({}, told)
        check_linear(tree)
      end
    end)

    it("of another kind is honoured in " .. format, function()
      for _, profile in ipairs { { places = adobe, curve = 2.19921875, light = power(2.19921875) },
        { places = adobe, light = srgb_light }, { curve = 2.2, light = power(2.19921875) },
        { grey = true, curve = 1.8, light = power(1.80078125) },
        { wide = true, places = adobe, curve = 1, light = power(1) },
        { curve = "para\0\0\0\0\0\3\0\0" .. numbers(2.5, 1, 0, 1, 0), light = power(2.5) },
        { curve = "para\0\0\0\0\0\0\0\0" .. numbers(1.5), light = power(1.5) } } do
        local told, tree = told_of(painting_with(format, paintings.profile(profile)))
        assert.are.same({}, told)
        check_light(tree, light_of_places(profile.places, profile.light))
      end
    end)

    it("that is a table of colours is honoured in " .. format, function()
      local told, tree = told_of(painting_with(format, paintings.profile { lut = muddy }))
      assert.are.same({}, told)
      check_light(tree, muddy_light, 0.002)
    end)

    it("that cannot be used is noted by its name in " .. format, function()
      local path = format == "openraster" and "ink: " or ": "
      for _, curve in ipairs { "curv\0\0\0\0\0\0\9\9", "para\0\0\0\0\0\7\0\0",
        "mft2\0\0\0\0\0\0\0\0",
        "curv\0\0\0\0\0\9\0\3\0\0\0\9\255\255" } do
        local told, tree = told_of(painting_with(format,
          paintings.profile { curve = curve, name = "Wide (1998)" }))
        assert.are.same({ path .. note:format "Wide (1998)" }, told)
        check_pixels(tree[1], layer_of {}, 40, 30)
      end
    end)

    it("that is damaged is noted in " .. format, function()
      local whole = paintings.profile {}
      local path = format == "openraster" and "ink: " or ": "
      for size = 1, #whole - 1, 151 do
        local told = told_of(painting_with(format, whole:sub(1, size)))
        assert.are.equal(1, #told)
        assert.are.equal(path, told[1]:match "^.-: ")
      end
      for before, behind in pairs { acsp = "acsq", ["RGB "] = "CMYK",
        ["gXYZ" .. "....(....)"] = "gXYZ\0\0\0\0%1",
        ["XYZ (....)"] = "Lab %1", ["rTRC"] = "rTRD" } do
        local bytes, found = whole:gsub(before, behind, before == "XYZ (....)" and 9 or 1)
        assert.is_true(found > 0)
        assert.are.equal(1, #told_of(painting_with(format, bytes)), before)
      end
    end)
  end

  it("has a name whose characters are repaired, or no name", function()
    local function named(name, wide, mend)
      local bytes = paintings.profile { name = name, wide = wide }:gsub("RGB ", "CMYK", 1)
      local told = told_of(painting_with("psd", mend and bytes:gsub(mend[1], mend[2], 1) or bytes))
      return told[1]:match 'profile "(.-)"'
    end
    assert.are.equal("a?b?c", named "a\1b\200c")
    assert.are.equal("ab", named "ab\0c")
    assert.are.equal("ab", named("ab\0c", true))
    assert.are.equal("a?b", named("a\1b", true))
    assert.are.equal("?b", named("ab", true, { "\0a\0b", "\1a\0b" }))
    assert.are.equal("?b", named("ab", true, { "\0a\0b", "\1\0\0b" }))
    for _, wide in ipairs { false, true } do assert.are.equal(("n"):rep(63),
      named(("n"):rep(70), wide)) end
    assert.are.equal("without a name", named("ab", false, { "(desc....)\0\0\0\3", "%1\0\0\0\250" }))
    assert.are.equal("without a name", named("ab", true, { "(enUS)\0\0\0\4", "%1\0\0\0\250" }))
    assert.are.equal("without a name", named("ab", true, { "(enUS....)\0\0\0\28", "%1\0\0\9\28" }))
    assert.are.equal("without a name", named("ab", true, { "mluc", "mlux" }))
  end)

  it("of Krita may be named but missing, and may be that of a layer", function()
    local function told_with(image, layer, profile)
      return told_of(paintings.krita { w = 40, h = 30, attributes = image and
        (' profile="%s"'):format(image), layers = { layer_of { name = "ink", profile = profile,
          attributes = layer and (' profile="%s"'):format(layer) } } })
    end
    assert.are.same({}, told_with("sRGB-elle-V2-srgbtrc.icc", "sRGB built-in"))
    assert.are.same({}, told_with("Gray-D50-elle-V2-srgbtrc.icc"))
    assert.are.same({}, told_with("Gray-D50-elle-V2-g10.icc", "Gray-D50-elle-V2-g10.icc"))
    assert.are.same({}, told_with("sRGB linear", "sRGB linear"))
    assert.are.same({ ": " .. note:format "Gray-D50-elle-V2-rec709.icc" },
      (told_with("Gray-D50-elle-V2-rec709.icc", "Gray-D50-elle-V2-rec709.icc")))
    local told, tree = told_with("sRGB-elle-V2-srgbtrc.icc", "sRGB-elle-V2-g10.icc")
    assert.are.same({}, told)
    check_linear(tree)
    assert.are.same({ ": " .. note:format "Rec2020-elle-V4-rec709.icc" },
      (told_with("Rec2020-elle-V4-rec709.icc", "Rec2020-elle-V4-rec709.icc")))
    told, tree = told_with("sRGB built-in", "sRGB built-in", paintings.profile { places = adobe })
    assert.are.same({}, told)
    check_light(tree, light_of_places(adobe, srgb_light))
    assert.are.same({ "ink: " .. note:format "Ink" }, (told_with("sRGB built-in", "sRGB built-in",
      paintings.profile { name = "Ink" }:gsub("RGB ", "CMYK", 1))))
  end)

  it("of a PNG may be given by its other chunks", function()
    local function told_with(...)
      local text = {}
      for i, one in ipairs { ... } do text[i] = stored.chunk(one[1], one[2]) end
      return told_of(paintings.openraster { w = 40, h = 30, layers = { layer_of { name = "ink",
        chunks = table.concat(text) } } })
    end
    local function gamma(number) return { "gAMA", string.pack(">I4", number) } end
    local function places(red, white)
      return { "cHRM", string.pack(">I4I4I4I4I4I4I4I4", 31270, white or 32900, red, 33000, 30000,
        60000,
        15000, 6000) }
    end
    local function check_chunks(light, ...)
      local told, tree = told_with(...)
      assert.are.same({}, told)
      check_light(tree, light)
    end
    local srgb = light_of_places(nil, srgb_light)
    check_chunks(srgb, gamma(45455))
    check_chunks(srgb, gamma(45455), places(64000))
    check_chunks(srgb, gamma(50000), places(70000), { "sRGB", "\0" })
    check_chunks(light_of_places(nil, power(1)), gamma(100000))
    check_chunks(light_of_places(nil, power(2)), gamma(50000))
    -- Red at 0.7, 0.33 has light outside the primaries of sRGB: the products of both matrices, in
    -- D65.
    check_chunks(function(r, g, b)
      r, g, b = r ^ 2, g ^ 2, b ^ 2
      return r, 1.03414 * g - 0.03414 * r, 1.03382 * b - 0.03382 * r
    end, gamma(50000), places(70000))
    assert.are.same({ "ink: " .. note:format "gamma 2 with primaries" },
      (told_with(gamma(50000), places(64000, 0))))
    assert.are.same({ "ink: " .. note:format "without a name" },
      (told_with({ "iCCP", "bad\0\0no zlib" }, { "sRGB", "\0" })))
    assert.are.same({ "ink: " .. note:format "without a name" },
      (told_with { "iCCP", ("n"):rep(90) }))
    assert.are.same({}, (told_with(gamma(0), { "cHRM", "short" })))
    assert.are.same({}, told_with({ "gAMA", "longer" }))
    assert.are.same({}, told_with({ "sRGB", "\0" }, gamma(50000)))
    assert.are.same({ "ink: " .. note:format "without a name" }, (told_with { "iCCP", "" }))
  end)

  it("of a Photoshop document is searched only in its resources", function()
    for _, resources in ipairs { "no block at all", "8BIM\4\15\0\0" .. string.pack(">I4", 999999),
      "8BIM\4\15\255" } do
      local told, tree = told_of(paintings.psd { w = 40, h = 30, resources = resources,
        layers = { layer_of {} } })
      assert.are.same({}, told)
      check_pixels(tree[1], layer_of {}, 40, 30)
    end
  end)
end)

-- ---------------------------------------------------------------- folders

local function png(layer) return paintings.png(layer) end

local it_reads_pictures = present.pictures() and it or pending

describe("a folder of pictures", function()
  it_reads_pictures("is a list of them by their numbers", function()
    local dot = png { w = 2, h = 2, pixel = flat(10, 20, 30) }
    local folder = write_folder { ["b10.png"] = dot, ["b9.png"] = dot, ["a1.PNG"] = dot,
      ["notes.txt"] = "no" }
    local tree = assert(layers.read(folder))
    assert.are.equal("a1 0,0 1.00 normal; b9 0,0 1.00 normal; b10 0,0 1.00 normal", shape_of(tree))
    assert.are.equal("10 20 30 255", codes_of(tree[2].object, 3, 3)(1, 1))
    assert.are.same({ { layer = "notes.txt", what = "not a picture: it is left out" },
      { layer = "sub", what = "not a picture: it is left out" } }, tree.skipped)
  end)

  it_reads_pictures("is refused if it is empty, or one is damaged or a link to the outside",
    function()
    local _, message = layers.read(write_folder { ["notes.txt"] = "no" })
    assert.matches("the folder holds no pictures", message)
    _, message = layers.read(write_folder { ["a.png"] = "no picture" })
    assert.matches("a%.png", message)
    local folder = write_folder {}
    os.execute(("ln -s /etc/passwd '%s/a.png'"):format(folder))
    _, message = layers.read(folder)
    assert.matches("a%.png lies outside the folder", message)
  end)
end)

local function oca_folder(document, files)
  files = files or {}
  files["shot.oca"] = document
  files["sub/one.png"] = files["sub/one.png"] or png { w = 4, h = 4, pixel = flat(10, 20, 30) }
  files["sub/two.png"] = png { w = 4, h = 4, pixel = flat(40, 50, 60) }
  return write_folder(files)
end

local drawing = [[{"name": "%s", "fileName": "%s", "frameNumber": 0, "duration": 2,
  "position": [10, 12], "width": 4, "height": 4, "opacity": %g}]]

describe("an OCA folder", function()
  local document = ([[{"name": "shot", "width": 40, "height": 30,
    "backgroundColor": [1, 0, 0, 1], "layers": [
      {"name": "still", "type": "paintlayer", "blendingMode": "multiply", "opacity": 0.5,
       "frames": [%s, {"name": "_blank", "fileName": ""}]},
      {"name": "group", "type": "grouplayer", "visible": false, "passThrough": true, "childLayers":
        [
        {"name": "moves", "frames": [%s, %s], "blendingMode": "linear_dodge"}]},
      {"name": "guide", "reference": true, "frames": []}]}]]):format(
    drawing:format("s1", [[sub\\one.png]], 0.25), drawing:format("m1", "sub/one.png", 1),
    drawing:format("m2", "sub/two.png", 1))

  it_reads_pictures("is a tree in which a layer of several drawings is a group", function()
    local tree = assert(layers.read(oca_folder(document)))
    assert.are.equal("background 0,0 1.00 normal; still 8,10 0.12 multiply; "
      .. "group 0,0 1.00 pass-through hidden [moves 0,0 1.00 linear-dodge [m1 8,10 1.00 normal; "
      .. "m2 8,10 1.00 normal hidden]]; guide 0,0 1.00 normal hidden", shape_of(tree))
    assert.are.equal("40 50 60 255", codes_of(tree:find("group/moves/m2").object, 40, 30)(8, 10))
    assert.are.equal("255 0 0 255", codes_of(tree[1].object, 40, 30)(39, 29))
    assert.are.equal("group/moves", tree.skipped[1].layer)
    assert.matches("2 drawings: the first is visible", tree.skipped[1].what)
  end)

  it("may be named by its document", function()
    local folder = oca_folder(document)
    assert.are.equal(4, #assert(layers.read(folder .. "/shot.oca")))
  end)

  --- The tree of one layer with these fields of a layer and of its drawing.
  local function with_layer(layer, fields, root)
    return layers.read(oca_folder(([[{"name": "shot", "width": 40, "height": 30, %s "layers": [
      {"name": "ink", "type": "paintlayer", %s "frames": [{"name": "a", %s "duration":
        1}]}]}]]):format(
        root or "", layer, fields)))
  end
  local place = '"position": [10, 12], "width": 4, "height": 4, '
  local one = '"fileName": "sub/one.png", '

  it_reads_pictures("may mix both slashes in the names of its files", function()
    for _, name in ipairs { [[sub\\one.png]], "sub/one.png", [[.\\sub/one.png]],
      "./sub/one.png" } do
      local tree = assert(with_layer("", ('"fileName": "%s", '):format(name) .. place))
      assert.are.equal("10 20 30 255", codes_of(tree[1].object, 40, 30)(8, 10))
    end
  end)

  it_reads_pictures("has centres, which may be fractions of a pixel", function()
    local tree = assert(with_layer("",
      one .. '"position": [10.5, 12.25], "width": 4, "height": 4, '))
    assert.are.equal("ink 8.5,10.25 1.00 normal", shape_of(tree))
    tree = assert(with_layer("", one .. '"position": [1e1, 1.15e1], "width": 3, "height": 3.0, '))
    assert.are.equal("ink 8.5,10 1.00 normal", shape_of(tree))
  end)

  it_reads_pictures("without positions has drawings that fill it", function()
    local tree = assert(with_layer("", one))
    assert.are.equal("ink 0,0 1.00 normal", shape_of(tree))
    assert.are.equal("10 20 30 255", codes_of(tree[1].object, 40, 30)(39, 29))
  end)

  it_reads_pictures("may number frames from anywhere, and hold them for any time", function()
    for _, number in ipairs { -3, 0, 1, 1001 } do
      local tree = assert(with_layer("", one .. place .. ('"frameNumber": %d, '):format(number)))
      assert.are.equal("ink 8,10 1.00 normal", shape_of(tree))
    end
  end)

  it_reads_pictures("may name any depth and any program", function()
    for _, depth in ipairs { "U8", "U16", "F16", "F32", "toonz" } do
      local tree = assert(with_layer("", one .. place,
        ('"colorDepth": "%s", "originApp": "OpenToonz", "ocaVersion": "1.2.0",'):format(depth)))
      assert.are.equal("10 20 30 255", codes_of(tree[1].object, 40, 30)(8, 10))
    end
  end)

  it_reads_pictures("may omit default values, or write null", function()
    local tree = assert(with_layer('"opacity": null, "visible": null, "blendingMode": null, '
      .. '"childLayers": null, "label": -1, "animated": false, "fileType": "png", ', one .. place
      .. '"opacity": null, '))
    assert.are.equal("ink 8,10 1.00 normal", shape_of(tree))
    local empty = assert(layers.read(oca_folder '{"layers": [{"type": "grouplayer"}, {}]}'))
    assert.are.equal(" 0,0 1.00 normal []; \0320,0 1.00 normal", shape_of(empty))
    assert.are.equal(1920, empty.width)
    assert.are.equal(1080, empty.height)
  end)

  it_reads_pictures("counts an opacity once that is that of the layer and of its frames", function()
    local function opacity(version, layer, frame)
      local tree = assert(with_layer(('"opacity": %s, '):format(layer),
        one .. place .. ('"opacity": %s, '):format(frame),
        version and ('"ocaVersion": "%s",'):format(version)))
      return tree[1].opacity
    end
    assert.are.equal(0.5, opacity("1.1.1", 0.5, 0.5))
    assert.are.equal(0.5, opacity(nil, 0.5, 0.5))
    assert.are.equal(0.125, opacity("1.1.1", 0.5, 0.25))
    assert.are.equal(0.125, opacity(nil, 0.5, 0.25))
    assert.are.equal(0.25, opacity("1.1.0", 0.5, 0.25))
    assert.are.equal(0.25, opacity("1.0", 0.5, 0.25))
    assert.are.equal(0.5, opacity("1.1.0", 0.5, 1))
    assert.are.equal(0.25, opacity("1.1.0", 1, 0.25))
  end)

  it_reads_pictures("shows nothing of a layer whose first frame is empty", function()
    local blank = '{"name": "_blank", "fileName": "", "frameNumber": 0, "duration": 8}'
    for drawings, list in pairs { [drawing:format("a", "sub/one.png", 1)] = "a",
      [drawing:format("a", "sub/one.png", 1) .. "," .. drawing:format("b", "sub/two.png",
        1)] = "ab",
    } do
      local tree = assert(layers.read(oca_folder(
        ('{"layers": [{"name": "late", "frames": [%s, %s]}]}'):format(blank, drawings))))
      assert.are.equal(#list, #tree[1].children)
      for _, child in ipairs(tree[1].children) do assert.is_false(child.visible) end
      assert.are.same({ { layer = "late",
        what = ("%d drawings: the first frame is empty, and none is visible"):format(#list) } },
        tree.skipped)
      assert.are.same({}, { tree[1].object:bounds() })
    end
  end)

  it_reads_pictures("finds nil for a path that does not exist", function()
    local tree = assert(with_layer("", one .. place))
    assert.are.equal(1, select("#", tree:find "no/such"))
    assert.is_nil(tree:find "no/such")
  end)

  it_reads_pictures("has blank drawings that show nothing", function()
    for _, fields in ipairs { '"name": "_blank", ' .. one, '"fileName": "", ' } do
      local tree = assert(with_layer("", fields .. place))
      assert.are.equal("ink 0,0 1.00 normal", shape_of(tree))
      assert.are.same({}, { tree[1].object:bounds() })
    end
  end)

  it_reads_pictures("names blend modes as Krita does, and reports those that are not shown",
    function()
    local known = { normal = "normal", multiply = "multiply", add = "linear-dodge",
      linear_dodge = "linear-dodge", plus = "add", Multiply = "multiply", screen = "screen",
      soft_light = "soft-light-photoshop", soft_light_svg = "soft-light", dodge = "color-dodge",
      burn = "color-burn", diff = "difference", luminize = "luminosity",
      vivid_light = "vivid-light", ["darker color"] = "darker-color" }
    for word, blend in pairs(known) do
      local tree = assert(with_layer(('"blendingMode": "%s", '):format(word), one .. place,
        '"backgroundColor": [1, 1, 1, 1], '))
      assert.are.equal(blend, tree[2].blend)
      assert.are.same({}, tree.skipped)
    end
    for _, word in ipairs { "erase", "hue_hsl" } do
      local tree = assert(with_layer(('"blendingMode": "%s", '):format(word), one .. place))
      assert.are.same({ { layer = "ink", what = ('blend mode "%s": it is shown as normal'):format(
        (word:gsub("_", "-"))) } }, tree.skipped)
    end
    local tree = assert(with_layer('"inheritAlpha": true, ', one .. place))
    assert.matches("alpha is inherited", tree.skipped[1].what)
  end)

  it_reads_pictures("may have a document that ends in .json, beside others", function()
    local folder = write_folder { ["shot.json"] = '{"layers": [{"name": "ink"}]}',
      ["a_meta.json"] = "{}" }
    assert.are.equal("ink 0,0 1.00 normal", shape_of(assert(layers.read(folder))))
  end)

  local refusals = {
    ['fileName is "C:.*one%.png"; it must lie in the folder'] =
      ('{"layers": [{"frames": [%s]}]}'):format(drawing:format("x", [[C:\\one.png]], 1)),
    ['fileName is ".*one%.png"; it must lie in the folder'] =
      ('{"layers": [{"frames": [%s]}]}'):format(drawing:format("x", [[\\\\host\\one.png]], 1)),
    ["line 2: a comma or } is missing"] = '{"name": "a"\n"b": 1}',
    ["the document must be an object"] = "3",
    ["layer 1 must be an object, got number"] = '{"layers": [3]}',
    ["layers must be a list, got string"] = '{"layers": "x"}',
    ["width must be a number from 1 to 1048576, got 1e%+300"] = '{"width": 1e300}',
    ["layer 1: opacity must be a number from 0 to 1, got 2"] = '{"layers": [{"opacity": 2}]}',
    ["nested deeper than 100 levels"] = ('{"layers":[{"type":"grouplayer","childLayers":['):rep(60),
    ['fileName is "/etc/passwd"; it must lie in the folder'] =
      ('{"layers": [{"frames": [%s]}]}'):format(drawing:format("x", "/etc/passwd", 1)),
    ['fileName is "sub/%.%./%.%./x%.png"; it must lie in the folder'] =
      ('{"layers": [{"frames": [%s]}]}'):format(drawing:format("x", "sub/../../x.png", 1)),
    ['fileName is "sub/no%.png", which is not in the folder'] =
      ('{"layers": [{"frames": [%s]}]}'):format(drawing:format("x", "sub/no.png", 1)),
  }
  for pattern, text in pairs(refusals) do
    it("is refused: " .. pattern, function()
      local tree, message = layers.read(oca_folder(text))
      assert.is_nil(tree)
      assert.matches(pattern, message)
      assert.matches("shot%.oca: ", message)
    end)
  end
end)

-- ---------------------------------------------------------------- bad input

local function refused(bytes, pattern)
  local tree, message = layers.read(write(bytes))
  assert.is_nil(tree)
  assert.matches(pattern, message)
end

--- Reading succeeds, and showing it fails.
local function fails_when_seen(bytes, pattern, size)
  local tree = assert(layers.read(write(bytes)))
  local image, message = celspan.pixels(celspan.rostrum(tree:cels()), { size = size or { 40, 30 } })
  assert.is_nil(image)
  assert.matches(pattern, message)
end

local function ora_with(stack, more)
  local members = { { name = "stack.xml", data = stack } }
  for _, member in ipairs(more or {}) do members[#members + 1] = member end
  return paintings.zip(members)
end

describe("a file that is not a painting", function()
  it("is refused with its name and the reason", function()
    refused("", "is not a layered painting; OpenRaster, Krita and Photoshop files are read")
    refused("GIF89a", "is not a layered painting")
    refused(paintings.zip { { name = "a", data = "b" } }, "neither an OpenRaster file")
    local _, message = layers.read "there/is/none.kra"
    assert.matches("there/is/none%.kra: cannot be opened: No such file", message)
  end)
end)

describe("a damaged archive", function()
  local whole = paintings.openraster { w = 40, h = 30, layers = { layer_of {} } }

  it("is refused wherever it is cut off", function()
    for size = 4, #whole - 1, 97 do
      local tree, message = layers.read(write(whole:sub(1, size)))
      assert.is_nil(tree)
      assert.matches("^/tmp", message)
    end
  end)

  it("is refused for tables and members that lie outside", function()
    refused(whole:sub(1, -7) .. string.pack("<I4I2", 0x7FFFFFFF, 0),
      "byte %d+: the table of members lies outside")
    refused(paintings.zip { { name = "stack.xml", data = "x", at = 0x7FFFFFFF } },
      "byte %d+: a member lies outside the archive")
    refused(paintings.zip { { name = "stack.xml", data = "<image/>", packed = 50 } },
      "byte %d+: a member lies outside the archive") -- reaches into the table
    refused(paintings.zip { { name = "stack.xml", data = "<image/>", flags = 1 } },
      '"stack.xml" is encrypted')
    refused(paintings.zip { { name = "stack.xml", data = "<image/>", method = 12 } },
      "compressed by method 12; stored and deflated members are read")
    refused(paintings.zip { { name = "stack.xml", data = "<image/>", sum = 1 } },
      "its checksum is wrong")
  end)

  it("may contain a zip bomb: it is refused at the limit", function()
    local bomb = ("\0"):rep(17 * 1024 * 1024)
    refused(ora_with(bomb), '"stack.xml" unpacks to more than 16777216 bytes, which is the limit')
  end)
end)

describe("an OpenRaster file", function()
  local refusals = {
    ["stack.xml:2: "] = '<image w="4" h="4">\n<stack></image>',
    ["stack.xml:1: the entity \"a\" is in another file"] =
      '<!DOCTYPE x [<!ENTITY a SYSTEM "b">]><image w="4" h="4"/>',
    ["the painting has a size of 0 x 0 pixels"] = "<image/>",
    ["stack.xml:1: w is \"1e99\"; it must be a number"] = '<image w="1e99" h="4"/>',
    ["the painting has 1048576 x 1048576 pixels; at most 1048576 a side and 268435456 in all"] =
      '<image w="1048576" h="1048576"/>',
    ["stack.xml:1: does not declare the size of the painting"] = "<stack/>",
    ["stack.xml:1: a layer without src"] = '<image w="4" h="4"><stack><layer/></stack></image>',
    ['src is "%.%./x%.png"; it must lie in the archive'] =
      '<image w="4" h="4"><stack><layer src="../x.png"/></stack></image>',
    ['src is "/etc/x%.png"; it must lie in the archive'] =
      '<image w="4" h="4"><stack><layer src="/etc/x.png"/></stack></image>',
    ['src is "x%.png", which is not in the archive'] =
      '<image w="4" h="4"><stack><layer src="x.png"/></stack></image>',
    ["opacity is \"nan\"; it must be a number from 0 to 1"] =
      '<image w="4" h="4"><stack><layer src="a.png" opacity="nan"/></stack></image>',
    ["nested more than 103 deep"] = '<image w="4" h="4">' .. ("<stack>"):rep(10000),
    ["a%.png: is not a PNG picture"] =
      '<image w="4" h="4"><stack><layer src="a.png"/></stack></image>',
    ["b%.png: is an interlaced PNG"] =
      '<image w="4" h="4"><stack><layer src="b.png"/></stack></image>',
    ["c%.png has 1000000000 x 4 pixels"] =
      '<image w="4" h="4"><stack><layer src="c.png"/></stack></image>',
  }
  local more = { { name = "a.png", data = ("no picture"):rep(9) },
    { name = "b.png", data = paintings.png_of(4, 4, 8, 6, ("\0"):rep(68), nil, 1) },
    { name = "c.png", data = paintings.png_of(1000000000, 4, 8, 6, "") } }
  for pattern, stack in pairs(refusals) do
    it("is refused: " .. pattern, function() refused(ora_with(stack, more), pattern) end)
  end

  it("is refused for layers that all name one member of large unpacked size", function()
    local long = paintings.png_of(4, 4, 8, 6, ("\0"):rep(68),
      stored.chunk("tEXt", "a\0" .. ("b"):rep(1 << 20)))
    local stack = '<image w="4" h="4"><stack>' .. ('<layer src="a.png"/>'):rep(400)
      .. "</stack></image>"
    refused(ora_with(stack, { { name = "a.png", data = long, deflate = true } }),
      "stack.xml:1: the layers up to here unpack to more than 13%d+ bytes, which is the "
      .. "limit for a file")
  end)

  it("fails when a damaged picture is shown", function()
    local stack = '<image w="40" h="30"><stack><layer src="a.png"/></stack></image>'
    local function seen(data, pattern)
      fails_when_seen(ora_with(stack, { { name = "a.png", data = data } }), pattern)
    end
    seen(paintings.png_of(4, 4, 8, 6, ("\0"):rep(60)), "ends too early: 8 of 17 bytes are missing")
    seen(paintings.png_of(4, 4, 8, 6, ("\9"):rep(68)), "a row has an unknown filter")
    seen(paintings.png_of(4, 4, 8, 6, ("\0"):rep(68)):gsub("IDAT", "IEND"), "has no data")
  end)
end)

describe("an archive of many large layers", function()
  -- 14,000 pixels a side each: 43 of them are within the limit, 44 are not.
  local function archive(layer_count, member_count)
    local stack, members = {}, {}
    local large = paintings.png_of(14000, 14000, 8, 6, "")
    for i = 1, layer_count do
      stack[i] = ('<layer name="l" src="%d.png"/>'):format(i % member_count)
    end
    for i = 1, member_count do members[i] = { name = i % member_count .. ".png", data = large } end
    return ora_with(('<image w="9" h="9"><stack>%s</stack></image>')
      :format(table.concat(stack)), members)
  end

  it("is refused if all layers together have too many pixels", function()
    assert(layers.read(write(archive(43, 43))))
    refused(archive(100, 100),
      "its layers have 19600000000 pixels in all; at most 8589934592 are read")
  end)

  it("counts a member for each layer that shows it", function()
    refused(archive(5000, 1),
      "its layers have 980000000000 pixels in all; at most 8589934592 are read")
  end)
end)

describe("a Krita document", function()
  local function krita(xml)
    return paintings.zip { { name = "maindoc.xml", data = xml },
      { name = "f/layers/bad",
        data = "VERSION 2\nTILEWIDTH 32\nTILEHEIGHT 64\nPIXELSIZE 4\nDATA 1\n" },
      { name = "f/layers/size",
        data = "VERSION 2\nTILEWIDTH 64\nTILEHEIGHT 64\nPIXELSIZE 8\nDATA 1\n" },
      { name = "f/layers/far",
        data = "VERSION 2\nTILEWIDTH 64\nTILEHEIGHT 64\nPIXELSIZE 4\nDATA 2\n"
        .. "0,0,LZF,1\n\1" .. "640000,0,LZF,1\n\1" },
      { name = "f/layers/line",
        data = "VERSION 2\nTILEWIDTH 64\nTILEHEIGHT 64\nPIXELSIZE 4\nDATA 1\n"
        .. "0,0,ZIP,1\n\1" } }
  end
  local image = '<DOC><IMAGE name="f" width="40" height="30"><layers>%s</layers></IMAGE></DOC>'
  local layer = '<layer nodetype="paintlayer" filename="%s" name="a"/>'
  local refusals = {
    ["tiles of an unknown kind"] = image:format(layer:format "bad"),
    ["the pixels have another size"] = image:format(layer:format "size"),
    ["cover more than 131072 pixels a side"] = image:format(layer:format "far"),
    ["the line of a tile is damaged"] = image:format(layer:format "line"),
    ['filename is "%.%./bad"; it must name a layer'] = image:format(layer:format "../bad"),
    ['filename is "none", which is not in the archive'] = image:format(layer:format "none"),
    ["a layer comes before the image"] = "<DOC>" .. layer:format "bad" .. "</DOC>",
    ['lies in "a", which is not a group'] = image:format('<layer nodetype="filterlayer" name="a">'
      .. '<layer nodetype="filterlayer" name="b"/></layer>'),
    ["nested more than 216 deep"] = image:format(('<layer nodetype="grouplayer"><layers>'):rep(
      9999)),
    ["groups lie in one another more than 100 deep"] = image:format(
      ('<layer nodetype="grouplayer">'):rep(120) .. ("</layer>"):rep(120)),
  }
  for pattern, xml in pairs(refusals) do
    it("is refused: " .. pattern, function() refused(krita(xml), pattern) end)
  end

  it("fails when a damaged tile is shown", function()
    for _, tile in ipairs { "\2", "\0\0", "\1\0", "\1\0\5\32\9", "\1" .. ("\224\255\0"):rep(20),
      "\1\31\1" } do
      fails_when_seen(paintings.krita { w = 40, h = 30, layers = { layer_of {
        tiles = "VERSION 2\nTILEWIDTH 64\nTILEHEIGHT 64\nPIXELSIZE 4\nDATA 1\n0,0,LZF,"
          .. #tile .. "\n" .. tile } } }, "byte %d+: a tile is damaged")
    end
  end)
end)

describe("a Photoshop document", function()
  local whole = paintings.psd { w = 40, h = 30, layers = { layer_of { packing = "packbits" } } }

  it("is refused, or fails when it is shown, wherever it is cut off", function()
    local section = 34 + string.unpack(">I4", whole, 35) + 4
    for size = 4, section - 1, 61 do
      local tree, message = layers.read(write(whole:sub(1, size)))
      assert.is_nil(tree)
      assert.matches("byte %d+: ", message)
    end
  end)

  it("is refused for unsupported colours and depths", function()
    local modes = { [0] = "bitmap", [2] = "indexed", [4] = "CMYK", [8] = "duotone", [9] = "Lab" }
    for mode, name in pairs(modes) do
      refused(paintings.psd { w = 4, h = 4, mode = mode },
        "byte 24: is a Photoshop document in " .. name .. " colour; RGB and grey are read")
    end
    refused((whole:gsub("\0\8\0\3", "\0\32\0\3", 1)),
      "byte 22: is a Photoshop document of 32 bits per channel; 8 and 16 are read")
  end)

  it("is refused for layers of 2^31 pixels, unclosed groups and groups 10,000 deep", function()
    local function psd_with(list) return paintings.psd { w = 4, h = 4, layers = list } end
    local huge = psd_with { { name = "a", x = -2147483648, y = -2147483648, w = 4294967295,
      h = 4294967295 } }
    refused(huge, "a layer has 4294967295 x 4294967295 pixels; at most 1048576 a side")
    refused(psd_with { { name = "a", x = 2147483000, y = 0, w = 1, h = 1, pixel = flat(0, 0, 0) } },
      "a layer lies at 2147483000, 0; at most 1073741824 pixels from the painting's corner")
    refused(psd_with { { name = "x", divider = 3 } }, "a group does not end")
    refused(psd_with { { name = "x", divider = 1 } }, "a group ends that did not begin")
    local deep = {}
    for i = 1, 10000 do deep[i] = { name = "x", divider = 3 } end
    refused(psd_with(deep), "groups lie in one another more than 100 deep")
  end)

  it("fails when a damaged channel is shown", function()
    local function seen(alpha, pattern)
      fails_when_seen(paintings.psd { w = 40, h = 30, layers = { layer_of { w = 4, h = 2,
        alpha = alpha } } }, pattern)
    end
    seen("\0\1" .. string.pack(">I2I2", 999, 2) .. "\253\7\253\7",
      "byte %d+: a packed row is longer")
    seen("\0\1" .. string.pack(">I2I2", 2, 2) .. "\254\7\253\7", "a packed row has another length")
    seen("\0\1" .. string.pack(">I2I2", 2, 2) .. "\253\7\252\7", "a packed row has another length")
    seen("\0\1" .. string.pack(">I2I2", 2, 3) .. "\253\7\5\7\7", "a packed row has another length")
    seen("\0\1" .. string.pack(">I2I2", 2, 90) .. "\253\7", "a packed row ends too early")
    seen("\0\0\1\2\3\4\5", "a channel ends too early: 3 of 4 bytes are missing")
    seen("\0\2" .. stored.zlib "\1\2\3\4\5", "a channel ends too early")
    seen("\0\2no zlib", "^[^:]+: compressed data is damaged")
  end)
end)

-- ---------------------------------------------------------------- material

local function files_in(folder, ending)
  local list = {}
  local pipe = assert(io.popen(("find '%s' -name '*%s' | sort"):format(folder, ending)))
  for line in pipe:lines() do list[#list + 1] = line end
  pipe:close()
  return list
end

--- The layers blended as Photoshop does it: coded and straight, over white.
local function blended(list, w, h, into)
  for _, entry in ipairs(list) do
    if entry.visible and entry.children then
      blended(entry.children, w, h, into)
    elseif entry.visible then
      local bytes = celspan.pixels(celspan.rostrum { celspan.cel { entry.object } },
        { size = { w, h } }):bytes { depth = 8, colour = "srgb", alpha = "straight" }
      for k = 0, w * h - 1 do
        local r, g, b, a = bytes:byte(4 * k + 1, 4 * k + 4)
        a = a / 255 * entry.opacity
        for c, value in ipairs { r, g, b } do
          into[c][k] = into[c][k] + a * (value - into[c][k])
        end
      end
    end
  end
end

describe("Photoshop documents of the material", function()
  if not material then
    it("are read", function() pending "CELSPAN_MATERIAL names no folder" end)
    return
  end

  it("are read, or refused with the reason", function()
    local read, refusals = 0, 0
    for _, path in ipairs(files_in(material .. "/psd", ".psd")) do
      local tree, message = layers.read(path)
      if tree then
        read = read + 1
        assert(celspan.pixels(celspan.rostrum(tree:cels()), { size = { tree.width, tree.height } }))
      else
        refusals = refusals + 1
        assert.matches("byte 2[24]: is a Photoshop document", message)
      end
    end
    assert.are.same({ 27, 6 }, { read, refusals })
  end)

  it("of normal layers look as Photoshop merged them", function()
    for _, name in ipairs { "2layers", "blend-modes/normal", "colormodes/4x4_8bit_rgb", "group",
      "hidden-groups" } do
      local path = ("%s/psd/%s.psd"):format(material, name)
      local tree, reference = assert(layers.read(path)), merged.read(path)
      local w, h = reference.width, reference.height
      local into = { {}, {}, {} }
      for k = 0, w * h - 1 do
        for c = 1, 3 do into[c][k] = 255 end
      end
      blended(tree, w, h, into)
      for k = 0, w * h - 1 do
        for c = 1, 3 do
          assert(math.abs(into[c][k] - reference[c][k]) <= 2, ("%s: pixel %d"):format(name, k))
        end
      end
    end
  end)

  it("of layers with modes look as Photoshop merged them, over white", function()
    for _, mode in ipairs { "color-burn", "color", "hard-light", "hard-mix", "hue", "lighter-color",
      "linear-burn", "linear-light", "luminosity", "multiply", "saturation", "screen" } do
      local path = ("%s/psd/blend-modes/%s.psd"):format(material, mode)
      local tree, reference, list = assert(layers.read(path)), merged.read(path), { isolate = true }
      local w, h, alike = reference.width, reference.height, 0
      for i, layer in ipairs(tree) do
        assert.equal(mode, layer.blend)
        list[i] = layer.object:blend(mode):fade(layer.opacity)
      end
      local film = celspan.film { size = { w, h }, space = "srgb", frame = function()
        return celspan.rostrum { back = "#fff", celspan.cel { celspan.group(list) } }
      end }
      local bytes = celspan.pixels(film):bytes()
      for k = 0, w * h - 1 do
        local most = 0
        for c = 1, 3 do
          most = math.max(most, math.abs(bytes:byte(4 * k + c) - reference[c][k]))
        end
        alike = alike + (most <= 2 and 1 or 0)
      end
      assert.is_true(alike >= 0.99 * w * h, ("%s: %.4f are near"):format(mode, alike / w / h))
    end
  end)

  it("have layers that cover each other like those of a film", function()
    local path = material .. "/psd/2layers.psd"
    local tree, reference = assert(layers.read(path)), merged.read(path)
    local shown = codes_of(celspan.union { tree[1].object, tree[2].object }, 101, 55)
    local top = codes_of(tree[2].object, 101, 55)
    local same = 0
    for y = 0, 54 do
      for x = 0, 100 do
        local alpha = top(x, y):match "%d+$"
        local k = y * 101 + x
        if alpha == "0" or alpha == "255" then
          same = same + 1
          assert.are.equal(("%d %d %d 255"):format(reference[1][k], reference[2][k],
            reference[3][k]), shown(x, y))
        end
      end
    end
    assert.is_true(same > 4000)
  end)
end)

describe("folders of pictures of the material", function()
  if not material or not present.pictures() then
    it("are read", function() pending "CELSPAN_MATERIAL names no folder" end)
    return
  end

  it("are layers by name", function()
    local tree = assert(layers.read(material .. "/parallax-platformer/level/background"))
    local names = {}
    for i, entry in ipairs(tree) do names[i] = entry.name end
    assert.are.same({ "cloud_1", "cloud_2", "cloud_3", "distant_platforms_1",
      "distant_platforms_2", "sky" }, names)
    local image = assert(celspan.pixels(celspan.rostrum(tree:cels { only = { "sky" } }),
      { size = { 64, 64 } }))
    assert.are.equal(1, select(4, image:get(10, 10)))
  end)
end)
