-- Pictures of many kinds are the same, with the same messages, whether they are decoded by a
-- process of their own or, with --trust, by the program itself: tiles, subimages and layers, film
-- codes.
local library = require "celspan"
local cases = require "tests.support.cases"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local it = present.pictures() and it or pending

local bench

before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

local function celspan(arguments) return bench:celspan_inside("%s", arguments) end

--- The program's results for a file: the exit code, the output, the error, a PNG's bytes.
local function told_and_made(file, options)
  local code, out, err = celspan(("info '%s' %s"):format(file, options))
  os.remove(bench.folder .. "/made.png")
  local made, _, made_err = celspan(("convert '%s' made.png %s"):format(file, options))
  return { code, out, err, made, made_err, bench:read "made.png" or "none" }
end

local function same_when_trusted(file)
  local apart = told_and_made(file, "")
  assert.are.same(apart, told_and_made(file, "--trust"), file)
  return apart
end

-- ---------------------------------------------------------------- TIFF

local function colour(x, y) return string.char((x * 13) % 256, (y * 29) % 256, (x * y) % 256) end

--- The pixels from x0, y0 on, w by h, with black outside the picture.
local function pixels(page, x0, y0, w, h)
  local out = {}
  for y = y0, y0 + h - 1 do
    for x = x0,
    x0 + w - 1 do
      out[#out + 1] = x < page.w and y < page.h and colour(x + page.shift, y) or "\0\0\0"
    end
  end
  return table.concat(out)
end

--- A TIFF of pages { w =, h =, shift =, name =, tile = }; tile: the side of its tiles, nil: one
--- strip.
local function tiff(pages)
  local out, link = "II*\0\0\0\0\0", 5
  local function append(bytes)
    local at = #out
    out = out .. bytes .. ("\0"):rep(#bytes % 2)
    return at
  end
  for _, page in ipairs(pages) do
    local offsets, counts, entries = {}, {}, {}
    local side = page.tile
    for y = 0, page.h - 1, side or page.h do
      for x = 0, page.w - 1, side or page.w do
        local bytes = pixels(page, x, y, side or page.w, side or page.h)
        offsets[#offsets + 1] = append(bytes)
        counts[#counts + 1] = #bytes
      end
    end
    local function entry(tag, kind, values)
      local format = kind == 3 and "<I2" or "<I4"
      local bytes = kind == 2 and values or ""
      for _, value in ipairs(kind ~= 2 and values or {}) do
        bytes = bytes .. string.pack(format, value)
      end
      local number = kind == 2 and #values or #values
      if #bytes > 4 then bytes = string.pack("<I4", append(bytes)) end
      entries[#entries + 1] = string.pack("<I2I2I4", tag, kind, number) .. bytes
        .. ("\0"):rep(4 - #bytes)
    end
    entry(256, 4, { page.w })
    entry(257, 4, { page.h })
    entry(258, 3, { 8, 8, 8 })
    entry(259, 3, { 1 })
    entry(262, 3, { 2 })
    if page.name then entry(270, 2, page.name .. "\0") end
    if not side then entry(273, 4, offsets) end
    entry(277, 3, { 3 })
    if side then
      entry(322, 4, { side })
      entry(323, 4, { side })
      entry(324, 4, offsets)
      entry(325, 4, counts)
    else
      entry(278, 4, { page.h })
      entry(279, 4, counts)
    end
    local at = append(string.pack("<I2", #entries) .. table.concat(entries) .. "\0\0\0\0")
    out = out:sub(1, link - 1) .. string.pack("<I4", at) .. out:sub(link + 4)
    link = at + 3 + 12 * #entries
  end
  return out
end

-- ---------------------------------------------------------------- OpenEXR

local function box(x0, y0, x1, y1) return string.pack("<i4i4i4i4", x0, y0, x1, y1) end

--- An OpenEXR file of 32-bit floats, uncompressed, 2 by 2: channels in the order of their names, of
--- which that of number i is i / 10 everywhere. data: its window, of the same size.
local function exr(channels, data)
  local x, y = table.unpack(data or { 0, 0 })
  local function attribute(name, kind, bytes)
    return ("%s\0%s\0"):format(name, kind) .. string.pack("<s4", bytes)
  end
  local list, row = {}, {}
  for i, name in ipairs(channels) do
    list[i] = name .. "\0" .. string.pack("<i4I4i4i4", 2, 0, 1, 1)
    row[i] = string.pack("<ff", i / 10, i / 10)
  end
  local head = "\x76\x2f\x31\x01\2\0\0\0"
    .. attribute("channels", "chlist", table.concat(list) .. "\0")
    .. attribute("compression", "compression", "\0")
    .. attribute("dataWindow", "box2i", box(x, y, x + 1, y + 1))
    .. attribute("displayWindow", "box2i", box(0, 0, 1, 1))
    .. attribute("lineOrder", "lineOrder", "\0")
    .. attribute("pixelAspectRatio", "float", string.pack("<f", 1))
    .. attribute("screenWindowCenter", "v2f", string.pack("<ff", 0, 0))
    .. attribute("screenWindowWidth", "float", string.pack("<f", 1)) .. "\0"
  local line = table.concat(row)
  local first = #head + 16
  return head .. string.pack("<I8I8", first, first + 8 + #line)
    .. string.pack("<i4s4", y, line) .. string.pack("<i4s4", y + 1, line)
end

-- ---------------------------------------------------------------- film

--- A film scan of Kodak's format, 2 by 2 in ten bits, with these three codes everywhere.
local function cineon(r, g, b)
  local word = string.pack(">I4", r << 22 | g << 12 | b << 2)
  local element = (">BBBBI4I4ffff"):pack(0, 0, 10, 0, 2, 2, 0, 0, 1023, 2.046)
  local head = (">I4I4I4I4I4I4c8c100c12c12c36")
    :pack(0x802a5fd7, 2048, 1024, 1024, 0, 2048 + 16, "V4.5", "", "", "", "")
    .. "\0\3\0\0" .. element:rep(8) .. ("\255"):rep(32) .. ("\0"):rep(228) .. "\0\5\0\0"
    .. ("\0"):rep(28)
  return head .. ("\0"):rep(2048 - #head) .. word:rep(4)
end

--- Pictures of the fuzz corpus that are refused.
local damaged = { ["cmyk-of-three-channels"] = true, ["long-colour-table"] = true,
  ["packed-rows"] = true,
  ["rgb-of-one-channel"] = true }

describe("a picture", function()
  it("of every format is the same with a decoder and with --trust", function()
    local list, names = assert(io.popen "ls tests/fuzz/corpus/picture-*/*"), {}
    for name in list:lines() do names[#names + 1] = name end
    list:close()
    assert.is_true(#names > 10)
    for _, number in cases.of(#names) do
      local name = names[number]
      bench:write("picture", assert(io.open(name, "rb")):read "a")
      local found = same_when_trusted "picture"
      assert.are.equal(damaged[name:match "[^/]+$"] and 4 or 0, found[1], name .. ": " .. found[3])
    end
  end)

  it("in tiles is the same as in strips", function()
    bench:write("strips.tif", tiff { { w = 70, h = 45, shift = 0 } })
    local strips = same_when_trusted "strips.tif"
    for _, side in ipairs(os.getenv "CELSPAN_PART" and { 32 } or { 16, 32, 64 }) do
      bench:write("tiles.tif", tiff { { w = 70, h = 45, shift = 0, tile = side } })
      local tiles = same_when_trusted "tiles.tif"
      assert.are.equal(0, tiles[4], tiles[5])
      assert.is_true(strips[6] == tiles[6])
    end
  end)

  it("may be one of several in a file, by number and by name", function()
    bench:write("pages.tif",
      tiff { { w = 20, h = 10, shift = 0, name = "back" },
        { w = 30, h = 15, shift = 40, name = "front", tile = 16 } })
    bench:write("front.tif", tiff { { w = 30, h = 15, shift = 40 } })
    local found = same_when_trusted "pages.tif"
    assert.matches("subimages 2\n", found[2])
    assert.matches("subimage 1 size 30x15", found[2])
    bench:write("show.lua", [[
local celspan = require "celspan"
local file, subimage, layer = ...
return celspan.rostrum { size = { 30, 15 }, celspan.cel { celspan.rect { 0, 0, 30, 15, texture =
  celspan.picture {
  file = file, subimage = tonumber(subimage), layer = layer, sampling = "nearest" } } } }
]])
    local function shown(arguments, options)
      local code, _,
      err = celspan(("render show.lua --size 30x15 -o shown.png --progress none %s -- %s")
        :format(options or "", arguments))
      return code, code == 0 and bench:read "shown.png" or err
    end
    for _, options in ipairs { "", "--trust" } do
      local _, alone = shown("front.tif", options)
      assert.are.same({ 0, alone }, { shown("pages.tif 1", options) })
      assert.are.same({ 0, alone }, { shown("pages.tif '' front", options) })
      local code, err = shown("pages.tif 2", options)
      assert.are.equal(4, code)
      assert.matches("subimage 2", err)
      code, err = shown("pages.tif '' middle", options)
      assert.are.equal(4, code)
      assert.matches('has no layer "middle"', err)
    end
  end)

  it("of film has the codes that its header names", function()
    local whole = assert(io.open("tests/fuzz/corpus/picture-dpx/rgba.dpx", "rb")):read "a"
    for transfer, coding in pairs { [1] = "cineon", [2] = "linear", [3] = "cineon", [5] = "rec709",
      [6] = "rec709", [7] = "rec709", [0] = "cineon" } do
      bench:write("film.dpx", whole:sub(1, 801) .. string.char(transfer) .. whole:sub(803))
      local found = same_when_trusted "film.dpx"
      assert.matches("\ncolour " .. coding .. "\n", found[2], transfer)
    end
  end)

  it("that is truncated gives the same error, with its name", function()
    local names = { "exr/rgba.exr", "tiff/rgba.tif", "jpeg/rgba.jpg", "psd/packbits8",
      "dpx/rgba.dpx", "gif/rgba.gif" }
    local shares = { 0.1, 0.5, 0.95 }
    for _, number in cases.of(#names * #shares) do
      local name, share = names[(number - 1) // #shares + 1], shares[(number - 1) % #shares + 1]
      local whole = assert(io.open("tests/fuzz/corpus/picture-" .. name, "rb")):read "a"
      bench:write("cut", whole:sub(1, math.floor(share * #whole)))
      local apart, trusted = told_and_made("cut", ""), told_and_made("cut", "--trust")
      assert.are.same({ apart[1], apart[2], apart[4], apart[6] },
        { trusted[1], trusted[2], trusted[4], trusted[6] }, name)
      assert.are.equal(trusted[5], apart[5])
      if apart[4] ~= 0 then assert.matches(" cut: ", apart[5]) end
    end
  end)

  local count = 0

  --- The colour in the middle of a picture, read in this process: red, green, blue and alpha, or
  --- nil and a message.
  local function middle(bytes, fields)
    fields = fields or {}
    count = count + 1
    fields.file = bench:write(("picture-%d.bin"):format(count), bytes)
    local image = library.rect { 0, 0, 2, 2, texture = library.picture(fields) }
    return library.probe(library.rostrum { library.cel { image } }, 0.7, 0.7, { film = { 2, 2 } })
  end

  local function refused(bytes, pattern, fields)
    local red, message = middle(bytes, fields)
    assert.is_nil(red)
    assert.matches("picture%-%d+%.bin: .*" .. pattern, message)
  end

  it("of OpenEXR has layers, and colours in channels of any name", function()
    local function near(expected, ...)
      for i, number in ipairs { ... } do assert.is_near(expected[i], number, 1e-6) end
      assert.are.equal(4, select("#", ...))
    end
    near({ 0.3, 0.2, 0.1, 1 }, middle(exr { "B", "G", "R" }))
    near({ 0.1, 0.1, 0.1, 1 }, middle(exr { "Y" }))
    near({ 0.1, 0.1, 0.1, 1 }, middle(exr { "Z" }))
    near({ 0.1, 0.2, 0.3, 1 }, middle(exr { "c1", "c2", "c3" }))
    near({ 0.4, 0.3, 0.2, 0.1 }, middle(exr { "A", "B", "G", "R" }))
    local layered = exr { "B", "G", "R", "deep.left.B", "deep.left.G", "deep.left.R", "depth.Z",
      "grey.Y", "half.R", "light.A", "light.B",
      "light.G", "light.R" }
    near({ 0.6, 0.5, 0.4, 1 }, middle(layered, { layer = "deep.left" }))
    near({ 0.8, 0.8, 0.8, 1 }, middle(layered, { layer = "grey" }))
    for _, none in ipairs { "depth", "half", "deep" } do
      refused(layered, 'has no layer "' .. none .. '"', { layer = none })
    end
    bench:write("layers.exr", layered)
    local _, out = celspan "info layers.exr --trust"
    local told = {}
    for name, channels in out:gmatch "layer (%S+) .-channels (%d+)" do
      told[#told + 1] = name .. " " .. channels
    end
    assert.are.same({ "deep.left 3", "grey 1", "light 4" }, told, out)
  end)

  it("of Kodak's film format has its codes", function()
    local bytes = cineon(685, 95, 400)
    local r, g, b, a = middle(bytes)
    assert.is_near(1, r, 0.01) -- the white of film
    assert.is_near(0, g, 0.01)
    assert.is_true(b > 0.05 and b < 0.5)
    assert.are.equal(1, a)
    bench:write("film.cin", bytes)
    local _, out = celspan "info film.cin --trust"
    assert.matches("format cineon\n", out)
    assert.matches("colour cineon\n", out)
    refused(bytes:sub(1, -2),
      "is truncated: it has 2063 of the 2064 bytes that its header declares")
  end)

  it("that is invalid, or too large, is reported with its name", function()
    refused("", "is empty")
    refused("GIF89a" .. string.pack("<I2I2", 0, 5) .. "\0\0\0", "is a picture without pixels")
    refused("\xff\x4f\xff\x51" .. ("\0"):rep(4) .. string.pack(">I4I4I4I4", 6, 5, 5, 9),
      "is a picture without pixels")
    refused(exr({ "Y" }, { 2000000000, 0 }), "data window")
    for _, form in ipairs { { 2, 24, 0, 1, 0 }, { 2, 24, 0, 0, 1 }, { 2, 24, 0x40, 1, 1 },
      { 9, 8, 0, 1, 1 }, { 4, 24, 0, 1, 1 }, { 2, 23, 0, 1, 1 }, { 2, 24, 0, 1, 1, 2 } } do
      local targa = string.pack("<BBBI2I2BI2I2I2I2BB", 0, form[6] or 0, form[1], 0, 0, 0, 0, 0,
        form[4], form[5], form[2], form[3])
      refused(targa .. ("\0"):rep(9), "is not a picture of a known format")
    end
    for head, name in pairs { ["\0\0\0\32ftypisom"] = "a movie", ["\x1a\x45\xdf\xa3"] = "a movie",
      ["RIFF\0\0\0\0AVI LIST"] = "a movie", ["\0\0\0\32ftypavif"] = "an AVIF picture" } do
      refused(head .. ("\0"):rep(40), "is " .. name .. ", which is not read"
        .. (name == "a movie" and "; 'ffmpeg %-i clip.mp4 clip" or ""))
    end
    local many = {}
    for i = 1, 1025 do many[i] = ("c%04d"):format(i) end
    refused(exr(many), "has 1025 channels; at most 1024 are read")
  end)

  it("in a space of OpenColorIO needs its configuration", function()
    bench:write("front.tif", tiff { { w = 30, h = 15, shift = 40 } })
    bench:write("show.lua", [[
local celspan = require "celspan"
return celspan.rostrum { size = { 30, 15 }, celspan.cel { celspan.rect { 0, 0, 30, 15, texture =
  celspan.picture {
  file = "front.tif", colour = "camera", sampling = "nearest" } } } }
]])
    bench:write("config.ocio", [[ocio_profile_version: 1
roles:
  default: light
  scene_linear: light
  lin_rec709: light
displays:
  screen:
    - !<View> {name: plain, colorspace: light}
colorspaces:
  - !<ColorSpace>
    name: light
  - !<ColorSpace>
    name: camera
    to_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0,
      1]}
]])
    local function shown(environment, options)
      local code, _,
      err =
      bench:shell(("cd '%s' && %s '%s' render show.lua --size 30x15 --depth half -o shown.exr "
      .. "--progress none %s"):format(
        bench.folder, environment, workbench.absolute, options))
      return code, err, code == 0 and bench:read "shown.exr" or nil
    end
    for _, options in ipairs { "", "--trust" } do
      local code, err = shown("", options)
      assert.are.equal(3, code, err)
      assert.matches("OCIO", err)
      local seen, said, made = shown("OCIO=config.ocio", options)
      assert.are.equal(0, seen, said)
      assert.is_string(made)
    end
    local _, _, apart = shown("OCIO=config.ocio", "")
    assert.is_true(apart == select(3, shown("OCIO=config.ocio", "--trust")))
  end)
end)
