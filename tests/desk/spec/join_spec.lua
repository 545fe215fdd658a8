-- Strips of a frame, and celspan join: the same picture as the whole, and refusals.
local present = require "tests.support.present"
local stored = require "tests.support.stored"
local workbench = require "tests.support.workbench"

local it_compares = present.pictures() and it or pending -- pictures are read to compare them

local bench

before_each(function()
  bench = workbench.new()
  bench:write("film.lua", [[
local celspan = require "celspan"
local sky = celspan.linear { from = { 0, 0 }, to = { 0, 900 }, { 0, "#204060" }, { 1, "#f0d0a0" } }
local place = ...
-- Each pixel is half the one before: PNG's filter Average predicts that in a row without one above.
local codes = {}
for x = 0, 299 do codes[x + 1] = string.char(224 >> x % 8, 224 >> x % 8, 224 >> x % 8, 255) end
local halves = celspan.image { x = 0, y = 0, size = { 300, 1 }, format = "rgba8",
  sampling = "nearest", pixels = table.concat(codes) }
return celspan.film { size = { 300, 900 }, frames = 3, title = "strips", frame = function(f)
  local art = { celspan.circle { centre = { 150, 450 }, radius = 140 + f.number },
                celspan.polygon { { 3, 5 }, { 290, 300 }, { 40, 890 }, texture = "#40a06080" } }
  if place == "sky" then
    table.insert(art, 1, celspan.rect { 0, 0, 300, 900, texture = sky })
  elseif place == "halves" then
    art = { halves:scale(1, 900) }
  end
  return celspan.rostrum { celspan.cel(art) }
end }
]])
end)
after_each(function() bench:remove() end)

local function celspan(arguments, ...) return bench:celspan_inside(arguments, ...) end

local function done(arguments, ...)
  local code, out, err = celspan(arguments, ...)
  assert.equal(0, code, err)
  return out
end

local function refused(code, text, arguments, ...)
  local got, _, err = celspan(arguments, ...)
  assert.equal(code, got, err)
  assert.is_truthy(err:find(text, 1, true), err)
end

--- Checks the checksum of every chunk of a PNG file; returns how many hold image data.
local function check_chunks(bytes)
  local at, images = 9, 0
  while at < #bytes do
    local size, kind = (">I4c4"):unpack(bytes, at)
    local sum = (">I4"):unpack(bytes, at + 8 + size)
    assert.equal(stored.crc32(bytes:sub(at + 4, at + 7 + size)), sum, kind)
    images = images + (kind == "IDAT" and 1 or 0)
    at = at + 12 + size
  end
  return images
end

local function render(options, args)
  done("render film.lua --frames 1 --progress none %s%s", options, args and " -- " .. args or "")
end

local function render_strips(ending, count, options, args)
  for i = 1, count do
    render(("--strip %d/%d -o s/%d.%s %s"):format(i, count, i, ending, options or ""), args)
  end
end

describe("joined strips", function()
  for _, ending in ipairs { "tga", "span" } do
    it("are the bytes of the whole in " .. ending, function()
      for _, args in ipairs { "flat", "sky" } do
        render("-o whole." .. ending, args)
        render_strips(ending, 4, nil, args)
        done("join s/#.%s -o joined.%s", ending, ending)
        assert.equal(bench:read("whole." .. ending), bench:read("joined." .. ending))
      end
    end)
  end

  for _, options in ipairs { "", "--depth 16", "--background '#102030'", "--dither",
                             "--workers 3" } do
    it_compares("look like the whole in PNG " .. options, function()
      for _, args in ipairs { "flat", "sky", "halves" } do
        render("-o whole.png " .. options, args)
        render_strips("png", 4, options, args)
        done("join s/#.png -o joined.png")
        done("compare whole.png joined.png")
      end
    end)
  end

  it_compares("have right checksums in PNG, also of strips with several chunks", function()
    render "--size 1200x900 -o whole.png"
    render_strips("png", 2, "--size 1200x900")
    done "join s/#.png -o joined.png"
    assert.is_true(check_chunks(bench:read "joined.png") > 2)
    done "compare whole.png joined.png"
  end)

  it("may be larger than the film, and there may be only one", function()
    render "--size 700x2000 -o whole.span"
    render "--size 700x2000 --strip 1/1 -o one.span"
    done "join one.span -o joined.span"
    assert.equal(bench:read "whole.span", bench:read "joined.span")
  end)

  it("are half floats in span files", function()
    render "--depth half -o whole.span"
    render_strips("span", 3, "--depth half")
    done "join s/1.span s/2.span s/3.span -o joined.span"
    assert.equal(bench:read "whole.span", bench:read "joined.span")
  end)

  it("have the bits of the whole, whatever is drawn", function()
    for _, name in ipairs { "strokes", "kernels", "rack_focus", "scanline" } do
      local script = ("%s/scripts/%s.lua"):format(os.getenv "PWD", name)
      local options = "--frames 1 --size 300x600 --depth half --progress none"
      done("render '%s' %s -o whole.span", script, options)
      for i = 1, 3 do done("render '%s' %s --strip %d/3 -o s/%d.span", script, options, i, i) end
      done "join s/#.span -o joined.span"
      assert.equal(bench:read "whole.span", bench:read "joined.span", name)
    end
  end)

  it_compares("are complete pictures; other pictures contain no position", function()
    render_strips("png", 2)
    render_strips("span", 2)
    render "--crop 0,0,300,512 -o top.png"
    render "--crop 0,0,300,512 -o top.span"
    done "compare s/1.png top.png"
    done "compare s/1.span top.span"
    assert.is_nil(bench:read "top.png":find("csST", 1, true))
  end)
end)

describe("the temporary file of a killed join", function()
  it("is removed by the next one, and no other file is", function()
    render_strips("tga", 2)
    for _, name in ipairs { ".joined.tga.00ff.part", ".other.tga.00ff.part",
      "joined.tga.00ff.part" } do
      bench:write(name, "half")
    end
    bench:write(".joined.tga.0001.part", "of a run that still works")
    local code, _, err =
      bench:shell(("cd '%s' && flock .joined.tga.0001.part '%s' join s/#.tga -o joined.tga")
      :format(bench.folder, workbench.absolute))
    assert.equal(0, code, err)
    local left = table.concat(bench:files(), " ")
    assert.is_nil(left:find(" .joined.tga.00ff", 1, true), left)
    for _, name in ipairs { ".joined.tga.0001.part", ".other.tga.00ff.part", "joined.tga.00ff.part",
      "joined.tga" } do
      assert.is_truthy(left:find(name, 1, true), name)
    end
  end)
end)

describe("join refuses, naming the file and a remedy:", function()
  for _, ending in ipairs { "png", "tga", "span" } do
    it("a wrong order or number of strips, in " .. ending, function()
      render_strips(ending, 4)
      local function names(...)
        local list = {}
        for _, i in ipairs { ... } do list[#list + 1] = ("s/%d.%s"):format(i, ending) end
        return table.concat(list, " ") .. " -o joined." .. ending
      end
      refused(4, "s/3." .. ending .. ": begins at row 512, but the next row is 256", "join %s",
        names(1, 3, 2, 4))
      refused(4, "s/2." .. ending .. ": begins at row 256, but the next row is 0", "join %s",
        names(2, 3, 4))
      refused(4, "s/1." .. ending .. ": begins at row 0, but the next row is 256", "join %s",
        names(1, 1, 2))
      refused(4, "s/3." .. ending .. ": ends before row 768, but the picture has 900", "join %s",
        names(1, 2, 3))
      assert.is_nil(bench:read("joined." .. ending))
    end)

    it("strips of another picture, in " .. ending, function()
      render_strips(ending, 2)
      render(("--strip 2/2 --size 299x900 -o other.%s"):format(ending))
      refused(4, "other." .. ending .. ": is not of the same picture as s/1." .. ending,
        "join s/1.%s other.%s -o joined.%s", ending, ending, ending)
      render(("--strip 2/2 --size 300x901 -o other.%s"):format(ending))
      refused(4, "other." .. ending .. ": belongs to a picture of 901 rows",
        "join s/1.%s other.%s -o joined.%s", ending, ending, ending)
    end)

    it("pictures that are not strips, in " .. ending, function()
      render("-o whole." .. ending)
      refused(4, "whole." .. ending, "join whole.%s -o joined.%s", ending, ending)
      assert.is_nil(bench:read("joined." .. ending))
    end)

    it("truncated or damaged files, without leaving any file, in " .. ending, function()
      render_strips(ending, 2, nil, "sky")
      local whole = bench:read("s/2." .. ending)
      for _, share in ipairs { 0, 0.01, 0.3, 0.9, 0.999 } do
        bench:write("s/2." .. ending, whole:sub(1, math.floor(share * #whole)))
        refused(4, "s/2." .. ending, "join s/#.%s -o joined.%s", ending, ending)
      end
      bench:write("s/2." .. ending, whole .. "more")
      refused(4, "s/2." .. ending, "join s/#.%s -o joined.%s", ending, ending)
      assert.same({ "film.lua", "s", "stderr", "stdout" }, bench:files())
    end)
  end

  it("a changed byte, if the format has checksums", function()
    for _, ending in ipairs { "png", "span" } do
      render_strips(ending, 2)
      local whole = bench:read("s/1." .. ending)
      for at = 1, #whole, #whole // 97 do
        local other = string.char(whole:byte(at) ~ 0x41)
        bench:write("s/1." .. ending, whole:sub(1, at - 1) .. other .. whole:sub(at + 1))
        local code, _, err = celspan("join s/#.%s -o joined.%s", ending, ending)
        assert.equal(4, code, ("byte %d of %s: %s"):format(at, ending, err))
      end
    end
  end)

  it("declared sizes without the data", function()
    render_strips("png", 2)
    local whole = bench:read "s/1.png"
    local huge = ("\xff"):rep(4)
    bench:write("s/1.png", whole:sub(1, 8) .. huge .. whole:sub(13))
    refused(4, "there is no valid chunk", "join s/#.png -o joined.png")
    bench:write("s/1.png", whole:sub(1, 8) .. "\x7f\xff\xff\xff" .. whole:sub(13))
    refused(4, "is truncated", "join s/#.png -o joined.png")
    bench:write("s/1.png", whole:sub(1, 16) .. huge .. whole:sub(21))
    refused(4, "its size", "join s/#.png -o joined.png")
  end)

  --- The chunks of a PNG, { kind, data } each, changed and put together with their checksums.
  local function rebuilt(bytes, change)
    local chunks, at = {}, 9
    while at < #bytes do
      local size, kind = string.unpack(">I4c4", bytes, at)
      chunks[#chunks + 1] = { kind, bytes:sub(at + 8, at + 7 + size) }
      at = at + 12 + size
    end
    change(chunks)
    local out = { bytes:sub(1, 8) }
    for i, chunk in ipairs(chunks) do out[i + 1] = stored.chunk(chunk[1], chunk[2]) end
    return table.concat(out)
  end

  local function index_of(chunks, kind)
    for i, chunk in ipairs(chunks) do
      if chunk[1] == kind then return i end
    end
  end

  it("PNG files whose chunks are complete, but not those of a strip", function()
    render_strips("png", 2)
    local whole = bench:read "s/1.png"
    local function header(at, bytes)
      return function(chunks)
        chunks[1][2] = chunks[1][2]:sub(1, at - 1) .. bytes .. chunks[1][2]:sub(at + #bytes)
      end
    end
    local function data(bytes)
      return function(chunks)
        local first = index_of(chunks, "IDAT")
        while chunks[first + 1][1] == "IDAT" do table.remove(chunks, first + 1) end
        chunks[first][2] = bytes(chunks[first][2])
      end
    end
    local function place(bytes)
      return function(chunks)
        for _, chunk in ipairs(chunks) do
          if chunk[1] ~= "IHDR" and #chunk[2] == 8 and chunk[2] == string.pack(">I4I4", 0, 900) then
            chunk[2] = bytes
          end
        end
      end
    end
    local cases = {
      { function(chunks) table.remove(chunks, 1) end, "it does not begin with a header" },
      { function(chunks)
        chunks[1][2] = chunks[1][2] .. "x"
      end, "it does not begin with a header" },
      { header(1, "\0\0\0\0"), "its size" }, { header(5, "\0\0\0\0"), "its size" },
      { header(5, "\127\0\0\0"), "its size" },
      { header(9, "\4"), "its kind of pixels" }, { header(10, "\3"), "its kind of pixels" },
      { header(11, "\1"), "its kind of pixels" },
      { header(12, "\1"), "its kind of pixels" }, { header(13, "\1"), "its kind of pixels" },
      { place "\0\0\0\0", "its place" }, { place(("\255"):rep(8)), "its place" },
      { place(string.pack(">I4I4", 0, 1 << 30)), "its place" },
      { place(("\0"):rep(8)), "it does not say which rows it has" },
      { place(string.pack(">I4I4", 8, 900)), "declares a first row of 8" },
      { function(chunks)
        for i = #chunks, 1, -1 do
          if chunks[i][1] == "IDAT" then table.remove(chunks, i) end
        end
      end, "it has no image data" },
      { function(chunks)
        table.insert(chunks, #chunks, { "tEXt", "a\0b" })
      end, "what follows the image data" },
      { function(chunks) chunks[#chunks + 1] = { "IEND", "" } end, "what follows the image data" },
      { function(chunks) chunks[#chunks][2] = "x" end, "what follows the image data" },
      { data(function() return "" end), "how its image data is divided" },
      { data(function(bytes) return bytes:sub(1, 5) end), "how its image data" },
      { data(function(bytes) return "\8\29" .. bytes:sub(3) end), "how its image data begins" },
      { data(function(bytes) return bytes .. "x" end), "how its image data ends" },
    }
    for i, case in ipairs(cases) do
      bench:write("s/1.png", rebuilt(whole, case[1]))
      local code, _, err = celspan "join s/#.png -o joined.png"
      assert.equal(4, code, i .. ": " .. err)
      assert.is_truthy(err:find(case[2], 1, true), i .. ": " .. err)
    end
    bench:write("s/1.png", rebuilt(whole, function(chunks)
      -- the image data may be divided in any way
      local first = index_of(chunks, "IDAT")
      local bytes = chunks[first][2]
      chunks[first][2] = bytes:sub(1, 9)
      table.insert(chunks, first + 1, { "IDAT", bytes:sub(10) })
      table.insert(chunks, first + 1, { "IDAT", "" })
    end))
    done "join s/#.png -o joined.png"
  end)

  it("Targa files whose position or end is damaged", function()
    render_strips("tga", 2)
    local whole = bench:read "s/1.tga"
    local function with(at, bytes)
      return whole:sub(1, at - 1) .. bytes .. whole:sub(at + #bytes)
    end
    for _, case in ipairs {
      { with(23, "\255\255\255\0"), "Targa files have at most 65535" },
      { with(#whole - 25, "\0\0\0\0"), "more than 4 GiB of rows" },
      { with(#whole - 25, "\1\0\0\0"), "its footer declares 1 bytes of rows" },
      { with(#whole - 10, "x"), "it has no footer" },
      { with(1, "\9"), "is not a strip" }, { with(3, "\2"), "is not a strip" },
      { with(18, "\0"), "is not a strip" },
      { with(19, "x"), "is not a strip" },
    } do
      bench:write("s/1.tga", case[1])
      refused(4, case[2], "join s/#.tga -o joined.tga")
    end
  end)

  it("other kinds of files", function()
    render_strips("png", 2)
    bench:write("text.png", ("no picture "):rep(10))
    refused(4, "text.png: is not a strip", "join text.png -o joined.png")
    refused(4, "none.png: No such file", "join none.png -o joined.png")
    refused(4, ".: is not a file", "join . -o joined.png")
    refused(4, "no file matches this pattern", "join none.####.png -o joined.png")
    refused(2, "the name must end in .png", "join s/#.png -o joined.tga")
    refused(2, "s/1.png is one of the strips", "join s/#.png -o s/1.png")
    refused(2, "give -o", "join s/#.png")
    done "join s/#.png -o joined.png"
  end)

  it("an output that cannot be written, leaving an older one unchanged", function()
    render_strips("png", 2)
    bench:write("joined.png", "older")
    bench:write("s/2.png", bench:read "s/2.png":sub(1, -60))
    refused(4, "s/2.png", "join s/#.png -o joined.png")
    assert.equal("older", bench:read "joined.png")
    render_strips("png", 2)
    refused(5, "film.lua", "join s/#.png -o film.lua/joined.png")
  end)
end)

describe("render --strip", function()
  it("refuses outputs without strips", function()
    refused(2, "a frame of 900 rows makes at most 4",
      "render film.lua --frames 1 --strip 1/5 -o s.png")
    refused(2, "--strip: '0/4' is not", "render film.lua --frames 1 --strip 0/4 -o s.png")
    refused(2, "--strip: '5/4' is not", "render film.lua --frames 1 --strip 5/4 -o s.png")
    refused(2, "--strip and --crop",
      "render film.lua --frames 1 --strip 1/2 --crop 0,0,9,9 -o s.png")
    refused(2, "standard output takes no --strip", "render film.lua --frames 1 --strip 1/2 -o -")
    refused(2, "leave --strip out, or render", "render film.lua --strip 1/2 -o film.mp4")
  end)

  it("refuses formats whose strips cannot be joined", function()
    local code, _, err = celspan "render film.lua --frames 1 --strip 1/2 -o s.exr"
    assert.is_truthy(code == 2 or err:find("celspan-picture.so", 1, true), err)
    assert.is_truthy(err:find("only for pictures (png, tga, targa, span)", 1, true), err)
  end)

  it("resumes, and distinguishes a strip from a crop of the same rows", function()
    done "render film.lua --frames 1 --strip 1/2 -o s.png --resume"
    local _, _, err =
      celspan "render film.lua --frames 1 --strip 1/2 -o s.png --resume --progress lines"
    assert.is_truthy(err:find("kept", 1, true), err)
    done "render film.lua --frames 1 --crop 0,0,300,512 -o s.png --resume"
    assert.is_nil(bench:read "s.png":find("csST", 1, true))
  end)
end)

describe("render --task", function()
  local function frames_of(task, list)
    for _, name in ipairs(bench:files "o") do os.remove(bench.folder .. "/o/" .. name) end
    done("render film.lua --task %s -o o/#.png --size 30x90 %s --progress none", task, list or "")
    return table.concat(bench:files "o", " ")
  end

  it("makes its share of the frames, all of them once", function()
    assert.equal("1.png", frames_of "1/2")
    assert.equal("2.png 3.png", frames_of "2/2")
    assert.equal("1.png 2.png 3.png", frames_of "1/1")
    assert.equal("3.png", frames_of("1/2", "--frames 3,1"))
    assert.equal("1.png", frames_of("2/2", "--frames 3,1"))
  end)

  it("is numbered by the array of a farm", function()
    assert.equal(0, (bench:inside(("SGE_TASK_ID=2 SGE_TASK_FIRST=1 SGE_TASK_LAST=2 '%s' render "
      .. "film.lua --task env -o p/#.png --size 30x90"):format(workbench.absolute))))
    assert.equal("2.png 3.png", table.concat(bench:files "p", " "))
    refused(2, "in an indexed job of Kubernetes", "render film.lua --task env -o p/#.png")
  end)

  it("has nothing to do if the film has become shorter", function()
    local code, _, err = celspan "render film.lua --task 1/9 -o o/#.png"
    assert.equal(0, code, err)
    assert.is_truthy(err:find("task 1 of 9 has no frames", 1, true), err)
  end)

  it("needs files as output", function()
    refused(2, "standard output takes no --task", "render film.lua --task 1/2 -o -")
    refused(2, "leave --task out, or render shot.##", "render film.lua --task 1/2 -o film.mp4")
  end)
end)
