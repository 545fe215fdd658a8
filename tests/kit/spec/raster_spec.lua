-- The picture module for where OpenImageIO is missing, beside the one over OpenImageIO: what both
-- read and write is the same, and damaged files are refused.
local paintings = require "tests.support.paintings"
local present = require "tests.support.present"
local profile = require "tests.support.profile"
local stored = require "tests.support.stored"
local workbench = require "tests.support.workbench"

local RASTER = workbench.build .. "/src/kit/plugins/raster/celspan-raster.so"
local WITH = "CELSPAN_PICTURE_MODULE='" .. RASTER .. "' "

if not present.program(RASTER) then return pending "the raster module was not built" end

local FILM = [[
local celspan = require "celspan"
local sky = celspan.linear { from = { 0, 0 }, to = { 61, 37 }, { 0, "#123" }, { 1, "#f84" } }
return celspan.film { size = { 61, 37 }, frames = 1, frame = function()
  local card = celspan.rect { 3, 2, 50, 30, radius = 9, texture = sky }
  return celspan.rostrum { celspan.cel { card } }
end }
]]
local ALPHA = "--background '#fff'"

local bench

before_each(function()
  bench = workbench.new()
  bench:write("film.lua", FILM)
end)

after_each(function() bench:remove() end)

--- Runs celspan in the folder with one of the two modules.
local function run(with, format, ...)
  return bench:inside((with .. "'" .. workbench.absolute .. "' " .. format):format(...))
end

local function good(with, format, ...)
  local code, out, err = run(with, format, ...)
  assert.equal(0, code, err)
  return out
end

--- The pixels of a file as a PNG of 16 bits, by a module.
local function pixels(with, name)
  good(with, "convert %s seen.png --depth 16", name)
  return bench:read "seen.png"
end

local cases = { -- the file, and how it is written
  { "a.jpg", ALPHA }, { "a.webp", ALPHA }, { "a.tif", "" }, { "b.tif", "--depth 16" },
  { "c.tif", "--depth float" }, { "d.tif", "--alpha premultiplied" }, { "a.exr", "" },
  { "b.exr", "--depth float" }, { "c.exr", "--colour srgb" }, { "a.png", "" },
  { "b.png", "--depth 16" },
}

-- ---------------------------------------------------------------- every kind of PNG

local W, H = 9, 7 -- neither is a multiple of what interlacing divides by
local CHANNELS = { [0] = 1, [2] = 3, [3] = 1, [4] = 2, [6] = 4 }
local kinds = { -- the colour type and the depth
  { 0, 1 }, { 0, 2 }, { 0, 4 }, { 0, 8 }, { 0, 16 }, { 2, 8 }, { 2, 16 }, { 3, 1 }, { 3, 2 },
  { 3, 4 }, { 3, 8 }, { 4, 8 }, { 4, 16 }, { 6, 8 }, { 6, 16 },
}
-- The first column and row of each pass of interlacing, and the steps.
local passes = { { 0, 0, 8, 8 }, { 4, 0, 8, 8 }, { 0, 4, 4, 8 }, { 2, 0, 4, 4 }, { 0, 2, 2, 4 },
                 { 1, 0, 2, 2 }, { 0, 1, 1, 2 } }

local function sample(x, y, channel, depth)
  if channel % 2 == 1 or depth == 1 then return (3 * x + 5 * y) * 977 % (1 << depth) end
  return (1 << depth) - 1 - (x + 2 * y) % 5 * channel
end

--- The samples of a row from column x on, each `step` columns, as bytes; the last one is filled.
local function packed_row(x, y, step, colour, depth)
  local bits, count, out = 0, 0, {}
  for column = x, W - 1, step do
    for channel = 1, CHANNELS[colour] do
      bits, count = bits << depth | sample(column, y, channel, depth), count + depth
      while count >= 8 do
        count = count - 8
        out[#out + 1] = string.char(bits >> count & 255)
      end
    end
  end
  if count > 0 then out[#out + 1] = string.char(bits << 8 - count & 255) end
  return "\0" .. table.concat(out)
end

local function rows_of(colour, depth, is_interlaced)
  local rows = {}
  for _, pass in ipairs(is_interlaced and passes or { { 0, 0, 1, 1 } }) do
    for y = pass[2], pass[1] < W and H - 1 or -1, pass[4] do
      rows[#rows + 1] = packed_row(pass[1], y, pass[3], colour, depth)
    end
  end
  return table.concat(rows)
end

--- Entry i of the palette.
local function entry(i) return string.char(i, 255 - i, i * 7 % 256) end

local function palette(depth)
  local entries = {}
  for i = 0, (1 << depth) - 1 do entries[i + 1] = entry(i) end
  return stored.chunk("PLTE", table.concat(entries))
end

--- The same pixels as those of celspan.picture, in 16 bits.
local function plain_pixels(colour, depth)
  local out, most = {}, (1 << depth) - 1
  for y = 0, H - 1 do
    for x = 0, W - 1 do
      local s = {}
      for channel = 1, CHANNELS[colour] do
        s[channel] = sample(x, y, channel, depth) * 65535 // most
      end
      if colour == 3 then
        s = { entry(sample(x, y, 1, depth)):byte(1, 3) }
        for i = 1, 3 do s[i] = s[i] * 257 end
      end
      local alpha = colour == 4 and s[2] or s[4] or 65535
      if #s < 3 then s = { s[1], s[1], s[1] } end
      out[#out + 1] = string.pack("I2I2I2I2", s[1], s[2], s[3], alpha)
    end
  end
  return table.concat(out)
end

--- Three rows of pictures, a column for each kind: plain, interlaced, and as the pixels are meant.
local KINDS = [[
local celspan = require "celspan"
local shown = {}
for column = 0, 14 do
  for row, name in ipairs { "plain", "interlaced", "meant" } do
    local place = { x = 10 * column, y = 8 * row - 8, w = 9, h = 7 }
    if name == "meant" then
      place.size, place.format = { 9, 7 }, "rgba16"
      local file <close> = assert(io.open("meant" .. column, "rb"))
      place.pixels = file:read "a"
    else
      place.file = name .. column .. ".png"
    end
    shown[#shown + 1] = celspan.image(place)
  end
end
return celspan.film { size = { 150, 24 }, frame = function()
  return celspan.rostrum { antialias = "none", celspan.cel(shown) }
end }
]]

-- ---------------------------------------------------------------- every kind of OpenEXR

--- What oiiotool makes of a picture of red, green, blue and alpha, a file for each. It has 33 rows,
--- so that the last chunk has one row, where others have 16 or 32.
local exrs = {
  "--ch Y=R", "--ch Y=R,A=A", "--ch R=R,B=B", "--ch light.R=R,light.G=G,light.B=B,light.A=A",
  "--ch c1=R,c2=G,c3=B", "--ch Red=R,Green=G,Blue=B,Alpha=A", "--ch Z=R,V=A,light.R=G,light.G=B",
  "--ch R,G,B --fullsize 80x50-5-4", "--ch Y=R --fullsize 30x20+9+5", "-d R=float -d G=uint32",
  "--fullsize 30x50+9-5 --tile 16 16", "--attrib Orientation 6", "--ch R,G,B,A,u.R=B,u.G=R,u.B=G",
}
for _, packing in ipairs { "none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a" } do
  for _, form in ipairs { "half", "float --tile 16 16", "half --tile 32 8", "uint32" } do
    exrs[#exrs + 1] = ("-d %s --compression %s"):format(form, packing)
  end
end

--- All of these over a colour, which shows where they have no pixels.
local SHEET = [[
local celspan = require "celspan"
local shown = { celspan.rect { 0, 0, 630, 350, texture = "#48c" } }
for i = 0, COUNT - 1 do
  shown[i + 2] = celspan.image { x = i % 9 * 70, y = i // 9 * 70, w = 61, h = 61,
    file = ("%d.exr"):format(i + 1) }
end
return celspan.film { size = { 630, 350 }, frame = function()
  return celspan.rostrum { antialias = "none", celspan.cel(shown) }
end }
]]

describe("the picture module without OpenImageIO", function()
  it("reads PNG of every kind, plain and interlaced, as their pixels are meant", function()
    for column, kind in ipairs(kinds) do
      local colour, depth = kind[1], kind[2]
      for name, interlaced in pairs { plain = 0, interlaced = 1 } do
        bench:write(("%s%d.png"):format(name, column - 1), paintings.png_of(W, H, depth, colour,
          rows_of(colour, depth, interlaced == 1), colour == 3 and palette(depth), interlaced))
      end
      bench:write(("meant%d"):format(column - 1), plain_pixels(colour, depth))
    end
    bench:write("film.lua", KINDS)
    for _, with in ipairs { WITH, present.pictures() and "" or nil } do
      good(with, "render film.lua -o - --depth 16 --trust --progress none >kinds")
      local bytes, size = bench:read "kinds", 150 * 8 * 8
      assert.equal(3 * size, #bytes)
      assert.is_true(bytes:sub(1, size) == bytes:sub(size + 1, 2 * size), "interlaced " .. with)
      assert.is_true(bytes:sub(1, size) == bytes:sub(2 * size + 1), "meant " .. with)
    end
  end)

  local it_compares = present.pictures() and it or pending

  it_compares("reads what OpenImageIO writes, as OpenImageIO does", function()
    for _, case in ipairs(cases) do
      good("", "render film.lua -o %s --progress none %s", case[1], case[2])
      assert.is_true(pixels("", case[1]) == pixels(WITH, case[1]), case[1])
      local facts = "info " .. case[1]
      assert.equal(good("", facts):gsub("\n.*", ""), good(WITH, facts):gsub("\n.*", ""))
    end
  end)

  it_compares("writes what OpenImageIO reads as it was written", function()
    for _, case in ipairs(cases) do
      good(WITH, "render film.lua -o %s --progress none %s", case[1], case[2])
      local own = pixels("", case[1])
      assert.is_true(own == pixels(WITH, case[1]), case[1])
      good("", "render film.lua -o %s --progress none %s", case[1], case[2])
      assert.is_true(own == pixels("", case[1]), case[1])
    end
  end)

  local it_makes = present.program "oiiotool" and it_compares or pending
  it_makes("reads windows that cover a part, and planes that lie on their side", function()
    good("", "render film.lua -o a.exr --progress none %s", ALPHA)
    good("", "render film.lua -o a.tif --progress none %s", ALPHA)
    for name, command in pairs {
      ["cut.exr"] = "a.exr --ch R,G,B --fullsize 80x50-5-4",
      ["side.tif"] = "a.tif --attrib Orientation 6 --attrib planarconfig separate" } do
      local code, _, err = bench:inside(("oiiotool %s -o %s"):format(command, name))
      assert.equal(0, code, err)
      assert.is_true(pixels("", name) == pixels(WITH, name), name)
    end
  end)

  it_makes("reads OpenEXR of every packing, in tiles, layers and windows, as the other", function()
    good("", "render film.lua -o a.exr --progress none")
    local list = {}
    for i, how in ipairs(exrs) do
      list[i] = ("--pop --dup -d half --scanline %s -o %d.exr"):format(how, i)
    end
    local code, _, err = bench:inside("oiiotool a.exr --cut 61x33 --dup "
      .. table.concat(list, " "))
    assert.equal(0, code, err)
    bench:write("film.lua", (SHEET:gsub("COUNT", #exrs)))
    for name, with in pairs { other = "", own = WITH } do
      good(with, "render film.lua -o - --depth 16 --trust --progress none >%s", name)
    end
    assert.is_true(bench:read "other" == bench:read "own")
    for _, i in ipairs { 3, 4, 7, 8, 10, 12, 13, #exrs } do
      local facts = ("info %d.exr"):format(i)
      assert.equal(good("", facts), good(WITH, facts))
    end
  end)

  it_makes("reads parts of OpenEXR by number and by name", function()
    good("", "render film.lua -o a.exr --progress none")
    local code, _, err = bench:inside("oiiotool a.exr --ch Z=R --attrib oiio:subimagename depth "
      .. "a.exr --tile 16 16 --attrib oiio:subimagename light --siappend -o parts.exr")
    assert.equal(0, code, err)
    assert.equal(good("", "info parts.exr"), good(WITH, "info parts.exr"))
    bench:write("film.lua", [[
local celspan = require "celspan"
local shown = {}
for i, part in ipairs { {}, { subimage = 1 }, { layer = "light" } } do
  shown[i] = celspan.rect { 0, 40 * i - 40, 61, 38, texture = celspan.picture {
    file = "parts.exr", subimage = part.subimage, layer = part.layer, sampling = "nearest" } }
end
return celspan.film { size = { 61, 120 }, frame = function()
  return celspan.rostrum { antialias = "none", celspan.cel(shown) }
end }
]])
    for name, with in pairs { other = "", own = WITH } do
      good(with, "render film.lua -o - --depth 16 --trust --progress none >%s", name)
    end
    assert.is_true(bench:read "other" == bench:read "own")
  end)

  it_makes("refuses OpenEXR that it does not read, with the reason", function()
    good("", "render film.lua -o a.exr --progress none %s", ALPHA)
    local code, _, err = bench:inside("oiiotool a.exr --ch R --compression none -o plain.exr "
      .. "--compression dwaa -o dwa.exr")
    assert.equal(0, code, err)
    local plain = bench:read "plain.exr"
    local channel = plain:find("R\0\1\0\0\0", 1, true)
    local chunk = select(2, plain:find("\0\0\0\0" .. string.pack("<I4", 2 * 61), 1, true))
    for name, bytes in pairs {
      ["another size"] = plain:sub(1, channel + 9) .. string.char(61) .. plain:sub(channel + 11),
      ["is corrupt or truncated"] = plain:sub(1, chunk - 4) .. "\9" .. plain:sub(chunk - 2),
      ["needs OpenImageIO"] = bench:read "dwa.exr" } do -- later versions of OpenEXR read it
      bench:write("bad.exr", bytes)
      code, _, err = run(WITH, "convert bad.exr seen.png")
      assert.truthy(code == 4 and err:find(name, 1, true) or name == "needs OpenImageIO", err)
    end
  end)

  it("names profiles", function()
    local bytes = profile.of(profile.wide "wide \u{e9}", 4)
    for kind, add in pairs { png = profile.png, jpg = profile.jpeg } do
      good(WITH, "render film.lua -o a.%s %s", kind, ALPHA)
      bench:write("b." .. kind, add(bench:read("a." .. kind), bytes))
      local said = good(WITH, "info b.%s", kind)
      assert.truthy(said:find("\nprofile wide \u{e9}\nprimaries_taken bt709\n", 1, true), said)
    end
  end)

  it("refuses other formats with a sentence", function()
    local code, _, err = run(WITH, "render film.lua -o a.dpx")
    assert.equal(5, code)
    assert.truthy(err:find("the format dpx is written by OpenImageIO alone", 1, true), err)
    code, _, err = run(WITH, "render film.lua -o a.tif --size 20000x20000")
    assert.is_true(code > 0)
    assert.truthy(err:find("268435456 pixels are written without OpenImageIO", 1, true), err)
    bench:write("a.psd", "8BPS")
    code, _, err = run(WITH, "info a.psd")
    assert.equal(4, code)
    assert.truthy(err:find("(png, jpeg, webp, tiff, openexr)", 1, true) or err ~= "", err)
  end)

  it("refuses files that are cut off or damaged, and never crashes", function()
    local draw = 1
    for _, case in ipairs(cases) do
      good(WITH, "render film.lua -o %s --progress none %s", case[1], case[2])
      local whole = bench:read(case[1])
      for part = 1, 3 do
        local cut = whole:sub(1, #whole * part // 4)
        bench:write(case[1], cut)
        local code, _, err = run(WITH, "convert %s seen.png", case[1])
        assert.equal(4, code, ("%s of %d bytes: %s"):format(case[1], #cut, err))
        assert.falsy(err:find("signal", 1, true), err)
        draw = draw * 16807 % 2147483647
        local at = draw % #whole + 1
        bench:write(case[1], whole:sub(1, at - 1) .. string.char(draw // 256 % 256)
          .. whole:sub(at + 1))
        code, _, err = run(WITH, "convert %s seen.png", case[1])
        assert.truthy(code == 0 or code == 4 or code == 6, err)
        assert.falsy(err:find("signal", 1, true), err)
      end
    end
  end)

  it("is taken where the other one cannot be loaded", function()
    bench:inside(("mkdir -p bin lib/celspan && cp '%s' bin && cp '%s' lib/celspan && "
      .. "echo none >lib/celspan/celspan-picture.so"):format(workbench.absolute, RASTER))
    good("", "render film.lua -o a.tif --progress none")
    local code, out, err = bench:inside "bin/celspan info a.tif"
    assert.same({ 0, "" }, { code, err })
    assert.truthy(out:find("tiff", 1, true), out)
  end)
end)
