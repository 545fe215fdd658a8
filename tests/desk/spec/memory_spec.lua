-- Pictures from memory: pixels in a string, the same as those pixels in a file, to the bit.
local celspan = require "celspan"
local present = require "tests.support.present"
local stored = require "tests.support.stored"
local prng = require "tests.support.prng"
local raised = require "tests.support.raised"
local workbench = require "tests.support.workbench"

local WIDTH, HEIGHT = 70, 67
local bench

setup(function() bench = workbench.new() end)
teardown(function() bench:remove() end)

-- ---------------------------------------------------------------- PNG, written here

local formats = {
  rgba8 = { size = 4, depth = 8, kind = 6 },
  rgb8 = { size = 3, depth = 8, kind = 2 },
  grey8 = { size = 1, depth = 8, kind = 0 },
  rgba16 = { size = 8, depth = 16, kind = 6 },
}

--- The bytes of a PNG of the pixels, uncompressed. Its codes of 16 bits have the high byte first.
local function png(pixels, format)
  local rows, row = {}, WIDTH * formats[format].size
  for y = 0, HEIGHT - 1 do
    local line = pixels:sub(y * row + 1, (y + 1) * row)
    if format == "rgba16" then
      line = line:gsub("..", function(code) return (">I2"):pack((("=I2"):unpack(code))) end)
    end
    rows[y + 1] = "\0" .. line
  end
  return "\x89PNG\r\n\x1a\n"
    .. stored.chunk("IHDR", (">I4I4BBBBB")
      :pack(WIDTH, HEIGHT, formats[format].depth, formats[format].kind, 0, 0, 0))
    .. stored.chunk("IDAT", stored.zlib(table.concat(rows))) .. stored.chunk("IEND", "")
end

local function noise(format, seed)
  local random, bytes = prng.new(seed), {}
  for i = 1, WIDTH * HEIGHT * formats[format].size do
    bytes[i] = string.char(random:whole(0, 255))
  end
  return table.concat(bytes)
end

-- ---------------------------------------------------------------- the same as a file

local function show(fields, place)
  return celspan.rostrum { back = "#345", celspan.cel { place(celspan.image(fields)) } }
end

local function merge(a, b)
  local both = {}
  for name, value in pairs(a) do both[name] = value end
  for name, value in pairs(b) do both[name] = value end
  return both
end

local function pixels_of(fields, place)
  local image = assert(celspan.pixels(show(fields, place), { size = { 90, 80 } }))
  local values = {}
  for y = 0, 79 do
    for x = 0, 89 do
      for _, value in ipairs { image:get(x, y) } do values[#values + 1] = ("d"):pack(value) end
    end
  end
  return table.concat(values)
end

describe("pixels in a string", function()
  local places = {
    ["as they are"] = function(image) return image end,
    shrunk = function(image) return image:scale(0.21) end,
    enlarged = function(image) return image:scale(3.3):translate(-80, -60) end,
    turned = function(image) return image:rotate(33, 35, 35) end,
  }
  for name, place in pairs(places) do
    it("look like a PNG of them, " .. name, function()
      if not present.pictures() then return pending("no pictures") end
      for format in pairs(formats) do
        local pixels = noise(format, 5)
        local file = bench:write(("%s %s.png"):format(name, format), png(pixels, format))
        local memory = { pixels = pixels, size = { WIDTH, HEIGHT }, format = format }
        for _, words in ipairs { {}, { colour = "linear" }, { as = "gel", sampling = "bicubic" },
                                 { sampling = "nearest" } } do
          assert.is_true(pixels_of(merge(words, memory), place)
            == pixels_of(merge(words, { file = file }), place), format)
        end
      end
    end)
  end

  it("are coded as declared, whatever their depth", function()
    local function shown(format, pack, values, more)
      local image = assert(celspan.pixels(show(merge({ pixels = pack:pack(table.unpack(values)),
        size = { 1, 1 }, format = format, w = 1, h = 1 }, more or {}), function(v) return v end),
        { size = { 1, 1 }, film = { 1, 1 } }))
      local r, g, b, a = image:get(0, 0)
      return ("%.4f %.4f %.4f %.4f"):format(r, g, b, a)
    end
    local back = ((0x33 / 255 + 0.055) / 1.055) ^ 2.4 -- red of #345, in light
    assert.are.equal("1.0000 0.0000 0.2159 1.0000", shown("rgba8", "BBBB", { 255, 0, 128, 255 }))
    assert.are.equal("0.2159 0.2159 0.2159 1.0000", shown("grey8", "B", { 128 }))
    assert.are.equal("0.5020 0.5020 0.5020 1.0000",
      shown("grey8", "B", { 128 }, { colour = "linear" }))
    assert.are.equal("1.0000 0.0000 0.5000 1.0000",
      shown("rgba16", "=I2=I2=I2=I2", { 65535, 0, 32768, 65535 }, { colour = "linear" }))
    assert.are.equal("2.5000 0.2500 0.1250 1.0000",
      shown("rgbaf", "=ffff", { 2.5, 0.25, 0.125, 1 }))
    -- Premultiplied by default, so that a colour may exist without alpha; straight if it is
    -- declared so.
    assert.are.equal(("%.4f"):format(0.5 + back * 0.5),
      shown("rgbaf", "=ffff", { 0.5, 0, 0, 0.5 }):match "%S+")
    assert.are.equal(("%.4f"):format(0.25 + back * 0.5),
      shown("rgbaf", "=ffff", { 0.5, 0, 0, 0.5 }, { alpha = "straight" }):match "%S+")
    -- A colour that was coded and then multiplied by alpha.
    assert.are.equal(shown("rgba8", "BBBB", { 255, 0, 0, 51 }):match "%S+",
      shown("rgba8", "BBBB", { 51, 0, 0, 51 }, { alpha = "premultiplied" }):match "%S+")
    assert.are.equal("0.0000 65504.0000 0.0000 1.0000",
      shown("rgbaf", "=ffff", { 0 / 0, math.huge, -0.0, 1 }))
  end)

  it("wrap and are placed in a box like a file's", function()
    local pair = celspan.picture { pixels = "\xff\0\0\0\0\xff", size = { 2, 1 }, format = "rgb8",
                                   box = { 2, 0, 2, 1 }, sampling = "nearest", wrap = "repeat" }
    local image = assert(celspan.pixels(celspan.rostrum { celspan.cel {
      celspan.rect { 0, 0, 6, 1, texture = pair } } }, { size = { 6, 1 } }))
    for x = 0, 5 do
      local r, _, b = image:get(x, 0)
      assert.are.same({ x % 2 == 0 and 1 or 0, x % 2 }, { r, b })
    end
  end)

  it("give an image its size", function()
    local fields = { pixels = ("\0"):rep(24), size = { 4, 2 }, format = "rgb8" }
    assert.are.same({ 0, 0, 4, 2 }, { celspan.image(fields):bounds() })
    assert.are.same({ 0, 0, 10, 5 }, { celspan.image(merge(fields, { w = 10 })):bounds() })
    assert.are.same({ 0, 2.5, 10, 5 },
      { celspan.image(merge(fields, { w = 10, h = 10, fit = "contain" })):bounds() })
  end)
end)

-- ---------------------------------------------------------------- values

describe("a picture in memory", function()
  local pixels = ("\0\x40\x80\xff"):rep(100)

  it("can be read and changed", function()
    local picture = celspan.picture { pixels = pixels, size = { 10, 10 } }
    assert.are.same({ 10, 10 }, picture.size)
    assert.are.equal("rgba8", picture.format)
    assert.are.equal(pixels, picture.pixels)
    assert.is_nil(picture.file)
    assert.are.equal("picture{ size = {10, 10} }", tostring(picture))
    local nearest = picture:with { sampling = "nearest" }
    assert.are.same({ "nearest", "rgba8", pixels },
      { nearest.sampling, nearest.format, nearest.pixels })
    local file = picture:with { file = "a.png" }
    assert.are.equal("a.png", file.file)
    assert.are.same({}, { file.pixels, file.size, file.format })
    local again = file:with { pixels = pixels, size = { 20, 5 } }
    assert.are.same({ 20, 5 }, again.size)
    assert.is_nil(again.file)
    assert.are.equal("nearest", celspan.image { file = "a.png" , w = 1, h = 1 }:with {
      pixels = pixels, size = { 5, 20 }, sampling = "nearest" }.sampling)
  end)

  it("is refused when it is made, with the reason", function()
    local function refusal(fields, kind)
      return raised.sentence(function() return celspan[kind or "picture"](fields) end)
    end
    local refusals = {
      { "pixels holds 300 bytes, 10 x 10 rgba8 needs 400",
        { pixels = pixels:sub(1, 300), size = { 10, 10 } } },
      { "pixels holds 400 bytes, 10 x 10 rgb8 needs 300",
        { pixels = pixels, size = { 10, 10 }, format = "rgb8" } },
      { "pixels holds 400 bytes, 1048576 x 1048576 rgbaf needs 17592186044416",
        { pixels = pixels, size = { 1048576, 1048576 }, format = "rgbaf" } },
      { "field 'size' must be {width, height} of the pixels, got nil", { pixels = pixels } },
      { "size[1] must be a whole number from 1 to 1048576, got 0",
        { pixels = "", size = { 0, 10 } } },
      { "size[2] must be a whole number from 1 to 1048576, got 2.5; math.ceil makes a number whole",
        { pixels = "", size = { 1, 2.5 } } },
      { "field 'pixels' must be a string, got table", { pixels = {}, size = { 1, 1 } } },
      { [[field 'format' must be "rgba8", "rgb8", "grey8", "rgba16" or "rgbaf", got "bgra8"; ]]
          .. [[did you mean "rgba8"?]],
        { pixels = pixels, size = { 10, 10 }, format = "bgra8" } },
      { [[field 'alpha' must be "straight" or "premultiplied", got "none"]],
        { pixels = pixels, size = { 10, 10 }, alpha = "none" } },
      { "give 'file' or 'pixels', not both",
        { pixels = pixels, size = { 10, 10 }, file = "a.png" } },
      { "field 'size' goes with 'pixels', which is not given",
        { file = "a.png", size = { 10, 10 } } },
      { "subimage is given, but pixels in memory have no layers",
        { pixels = pixels, size = { 10, 10 }, subimage = 1 } },
      {
        [[colour is "ACEScg"; of pixels in memory it must be "srgb", "linear", "rec709" ]]
        .. [[or "cineon"]],
        { pixels = pixels, size = { 10, 10 }, colour = "ACEScg" } },
      { "unknown field 'pixel'; did you mean 'pixels'?", { pixel = pixels, size = { 10, 10 } } },
    }
    for _, case in ipairs(refusals) do
      for _, kind in ipairs { "picture", "image" } do
        assert.are.equal(kind .. ": " .. case[1], (refusal(case[2], kind)))
      end
    end
  end)

  it("is copied once, however many pictures show the string", function()
    local heavy = ("\x20\x40\x60\xff"):rep(1 << 19)
    local kept = {}
    local function resident()
      collectgarbage()
      local status = assert(io.open "/proc/self/statm")
      local pages = tonumber(status:read("a"):match "^%d+ (%d+)")
      status:close()
      return pages * 4096
    end
    kept[1] = celspan.picture { pixels = heavy, size = { 1 << 10, 1 << 9 } }
    local before = resident()
    for i = 2, 100 do
      kept[i] = i % 2 == 0 and kept[1]:with { sampling = "nearest" }
        or celspan.image { pixels = heavy, size = { 1 << 10, 1 << 9 }, x = i }
    end
    assert.is_true(resident() - before < 20 << 20, "99 copies of 2 MB each were made")
    assert.are.equal(100, #kept)
  end)

  it("is released with the values that show it", function()
    local function make(i)
      return celspan.image { pixels = ("\1"):rep(99) .. string.char(i % 256), size = { 10, 10 },
        format = "grey8" }
    end
    local last
    for i = 1, 2000 do last = make(i) end
    collectgarbage()
    local image = assert(celspan.pixels(celspan.rostrum { celspan.cel { last } },
      { size = { 10, 10 } }))
    assert.is_true(select(4, image:get(9, 9)) == 1)
  end)
end)

-- ---------------------------------------------------------------- the command line

local script = [[
local celspan = require "celspan"
local level = tonumber(... or "1")
local function still(i) return string.char(i * level, 40, 80):rep(64) end
return celspan.film{ size = {8, 8}, frames = 4, frame = function(f)
  return celspan.rostrum{ celspan.cel{ celspan.image{ pixels = still(f:on(2)), size = {8, 8}, format
    = "rgb8" } } }
end }
]]

describe("a film of pictures in memory", function()
  it("needs no picture module", function()
    bench:write("film.lua", script)
    local code, _, err =
      bench:shell(("LD_DEBUG=files CELSPAN_PICTURE_MODULE=/nonexistent.so '%s' render %s/film.lua "
      .. "-o %s/alone/f.#.png --progress none"):format(bench.binary, bench.folder, bench.folder))
    assert.are.equal(0, code, err)
    assert.is_truthy(err:find("libc.so", 1, true), "the dynamic linker prints nothing")
    assert.is_nil(err:find "OpenImageIO")
    assert.is_nil(err:find "picture%.so")
  end)

  it("is counted and checked without being read", function()
    bench:write("film.lua", script)
    local code, _, err = bench:celspan("check %s/film.lua", bench.folder)
    assert.are.equal(0, code, err)
    local informed, out = bench:celspan("info %s/film.lua", bench.folder)
    assert.are.equal(0, informed)
    assert.is_truthy(out:find("pictures 1", 1, true), out)
  end)

  it("names frames by content: equal ones are one, and changed ones are made again", function()
    bench:write("film.lua", script)
    local function digests(arguments)
      local code, out, err = bench:celspan("render %s/film.lua --hash --progress none %s",
        bench.folder, arguments)
      assert.are.equal(0, code, err)
      local list = {}
      for digest in out:gmatch "%d+ (%x+)" do list[#list + 1] = digest end
      return list
    end
    local one, many = digests "--workers 1", digests "--workers 4"
    assert.are.same(one, many)
    assert.are.equal(one[1], one[2])
    assert.are_not.equal(one[2], one[3])

    local function ways(level)
      local code, _, err =
        bench:celspan("render %s/film.lua -o %s/kept/f.#.png --resume --progress json -- %s",
        bench.folder, bench.folder, level)
      assert.are.equal(0, code, err)
      local list = {}
      for way in err:gmatch '"how":"(%a+)"' do list[#list + 1] = way end
      return table.concat(list, " ")
    end
    assert.are.equal("made copied made copied", ways(1))
    assert.are.equal("kept kept kept kept", ways(1))
    assert.are.equal("kept kept made copied", ways(2))
  end)
end)
