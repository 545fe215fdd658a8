-- Planes in Lua and on the command line: made, written, read, drawn, compared and refused.
local celspan = require "celspan"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local it_compares = present.pictures() and it or pending -- pictures are read to compare them

local FILM = [[
local celspan = require "celspan"
local sky = celspan.linear { from = { 0, 0 }, to = { 0, 90 }, { 0, "#204060" }, { 1, "#f0d0a0" } }
return celspan.film { size = { 160, 90 }, frames = 3, frame = function(f)
  return celspan.rostrum { back = "#fff", celspan.cel {
    celspan.rect { 0, 0, 160, 60, texture = sky },
    celspan.circle { centre = { 40 + 20 * f.number, 50 }, radius = 30, texture = "#f26419c0" } } }
end }
]]

local bench

before_each(function()
  bench = workbench.new()
  bench:write("film.lua", FILM)
  bench:write("blurred.lua", [[
local celspan = require "celspan"
local disc = celspan.circle { centre = { 80, 45 }, radius = 30 }
return celspan.film { size = { 160, 90 }, frames = 1, frame = function()
  return celspan.rostrum { celspan.cel { disc, defocus = 3 }
    :transform { 1, 0, 0, 0, 1, 0, 0.001, 0, 1 } }
end }
]])
end)
after_each(function() bench:remove() end)

local function run(arguments, ...) return bench:celspan_inside(arguments, ...) end

local function done(arguments, ...)
  local code, out, err = run(arguments, ...)
  assert.equal(0, code, err)
  return out
end

local function refused(exit, message, arguments, ...)
  local code, _, err = run(arguments, ...)
  assert.equal(exit, code, err)
  assert.matches(message, err, 1, true)
end

local function disc(x)
  return celspan.rostrum { celspan.cel {
    celspan.circle { centre = { x, 45 }, radius = 30, texture = "#f26419" } } }
end

-- Two thousand shades of grey, which are 256 codes.
local function shades()
  local strips = {}
  for i = 0, 1999 do
    local grey = i / 2000
    strips[i + 1] = celspan.rect {
      0, 0, 160 - i * 0.08, 90, texture = celspan.rgb(grey, grey, grey) }
  end
  return celspan.rostrum { celspan.cel(strips) }
end

describe("8-bit colours of a plane", function()
  it("are codes, and what is equal is one", function()
    local film, view = { 160, 90 }, { size = { 320, 180 } }
    local fine = assert(celspan.plane(shades(), { film = film }))
    local coarse = assert(celspan.plane(shades(), { film = film, depth = 8 }))
    assert.is_true(coarse.bytes * 4 < fine.bytes)
    local a, b = assert(fine:pixels(view)), assert(coarse:pixels(view))
    local function code(light)
      return light <= 0.0031308 and light * 12.92 or 1.055 * light ^ (1 / 2.4) - 0.055
    end
    for x = 0, 319 do
      local one, other = a:get(x, 50), b:get(x, 50)
      assert.is_true(math.abs(code(one) - code(other)) <= 1 / 255)
    end
  end)

  it("are chosen for files and films, by 8 or 16", function()
    done "render film.lua -o sixteen.plane --depth 16"
    done "render film.lua -o plain.plane"
    done "render film.lua -o eight.plane --depth 8"
    done "render film.lua -o eight.###.plane --depth 8"
    assert.equal(bench:read "plain.plane", bench:read "sixteen.plane")
    assert.equal(8, bench:read("eight.001.plane"):byte(13) & 8)
    done "compare eight.plane sixteen.plane --fail 0.012"
    refused(2, "plane takes --depth 8 or 16, and not half",
      "render film.lua -o x.plane --depth half")
    assert.has_error(function() celspan.plane(disc(80), { depth = "half" }) end,
      "plane: field 'depth' must be 8 or 16")
  end)

  it("are not those of a sum", function()
    local film = celspan.film { size = { 160, 90 }, frames = 1, frame = function()
      return { { disc(70), 0.5 }, { disc(80), 0.5 } }
    end }
    local plane, message = celspan.plane(film, { depth = 8 })
    assert.is_nil(plane)
    assert.matches("a frame of 2 exposures is their sum", message, 1, true)
  end)
end)

--- Where two pictures differ by more than 0.01, in one of `rows` rows; nil: nowhere.
local function place_apart(one, other, rows)
  for y = 0, one.height - 1, rows do
    for x = 0, one.width - 1 do
      local p, q = { one:get(x, y) }, { other:get(x, y) }
      for c = 1, 4 do
        local is_near = math.abs(p[c] - q[c]) <= 0.01
        if not is_near then
          return ("%d, %d: %s, but %s"):format(x, y, table.concat(p, " "), table.concat(q, " "))
        end
      end
    end
  end
end

describe("a plane in Lua", function()
  it("is drawn as the rostrum is", function()
    local plane = assert(celspan.plane(disc(80), { film = { 160, 90 } }))
    assert.same({ 160, 90 }, { plane.width, plane.height })
    for _, mode in ipairs { "area", "none" } do
      local options = { size = { 320, 180 }, film = { 160, 90 }, antialias = mode }
      local drawn = assert(plane:pixels { size = { 320, 180 }, antialias = mode })
      local rendered = assert(celspan.pixels(disc(80), options))
      assert.is_nil(place_apart(drawn, rendered, 7))
    end
  end)

  it("has a pixel for each unit where no size is given, and crops", function()
    local plane = assert(celspan.plane(disc(80), { film = { 160, 90 } }))
    local whole, part = assert(plane:pixels()), assert(plane:pixels { crop = { 50, 20, 30, 40 } })
    assert.same({ 160, 90, 30, 40 }, { whole.width, whole.height, part.width, part.height })
    for y = 0, 39 do
      for x = 0, 29 do assert.same({ whole:get(50 + x, 20 + y) }, { part:get(x, y) }) end
    end
  end)

  it("is the sum of its exposures, as the frame is", function()
    local function sunset(x)
      local sky = celspan.linear { from = { 0, 0 }, to = { 0, 90 },
        { 0, "#204060" }, { 1, "#f0d0a0" } }
      return celspan.rostrum { back = "#3060a0", celspan.cel {
        celspan.rect { x, 10, 60, 70, texture = sky },
        celspan.circle { centre = { x + 40, 45 }, radius = 20, texture = "#f26419c0" } } }
    end
    local exposures = { { sunset(10), 0.25 }, { sunset(30), 0.45 }, { sunset(70), 0.3 } }
    local plane = assert(celspan.plane(exposures, { film = { 160, 90 } }))
    local drawn = assert(plane:pixels { size = { 320, 180 } })
    local rendered = assert(celspan.pixels(exposures, { size = { 320, 180 }, film = { 160, 90 } }))
    assert.is_nil(place_apart(drawn, rendered, 3))
  end)

  it("is one of a film's frames", function()
    local film = celspan.film { size = { 160, 90 }, frames = 3, frame = function(f)
      return disc(40 * f.number)
    end }
    local second = assert(celspan.plane(film, { frame = 2 }))
    assert.equal(1, select(4, assert(second:pixels()):get(80, 45)))
    assert.equal(0, select(4, assert(second:pixels()):get(140, 45)))
    assert.error_matches(function() return celspan.plane(film, { frame = 4 }) end, "frame 4")
  end)

  it("is written, and read again as the same", function()
    local plane = assert(celspan.plane(disc(80), { film = { 160, 90 } }))
    assert.is_true(plane:write(bench.folder .. "/disc.plane"))
    local again = assert(celspan.plane_read(bench.folder .. "/disc.plane"))
    assert.equal(tostring(plane), tostring(again))
    assert.equal(plane:pixels():bytes(), again:pixels():bytes())
    assert.equal(#bench:read "disc.plane", plane.bytes)
    assert.same({ 1, 0 }, { again.frames, again.fps })
  end)

  it("is any frame of a file with a film", function()
    done("render film.lua -o film.plane")
    local function read_third()
      local first = assert(celspan.plane_read(bench.folder .. "/film.plane"))
      assert.same({ 3, 24 }, { first.frames, first.fps })
      return assert(assert(first:frame(2)):frame(3))
    end
    local third = read_third()
    collectgarbage() -- the first one is gone, whose bytes are those of all
    done("render film.lua --frames 3 -o one.plane")
    local one = assert(celspan.plane_read(bench.folder .. "/one.plane"))
    assert.equal(one:pixels():bytes(), third:pixels():bytes())
    assert.error_matches(function() third:frame(4) end, "must be a whole number from 1 to 3, got 4")
    assert.error_matches(function() third:frame "a" end,
      "must be a whole number from 1 to 3, got string")
    assert.error_matches(function() third:frame(2.5) end, "from 1 to 3, got 2.5", 1, true)
    assert.is_true(third:write(bench.folder .. "/again.plane"))
    assert.equal(bench:read "film.plane", bench:read "again.plane")
  end)

  it("is not made of what it cannot keep, nor read from other files", function()
    local blurred = celspan.rostrum { celspan.cel {
      celspan.circle { centre = { 80, 45 }, radius = 30 }, defocus = 0.05 } }
    local plane, message = celspan.plane(blurred)
    assert.is_nil(plane)
    assert.matches("a blurred object is in view", message, 1, true)
    plane, message = celspan.plane_read(bench.folder .. "/film.lua")
    assert.is_nil(plane)
    assert.matches("plane file", message, 1, true)
    assert.is_nil((celspan.plane_read(bench.folder .. "/none.plane")))
  end)

  it("refuses wrong calls", function()
    local plane = assert(celspan.plane(disc(80), { film = { 160, 90 } }))
    assert.error_matches(function() return plane.size end, "unknown field 'size'")
    assert.error_matches(function() plane:pixels { sice = 1 } end, "did you mean 'size'")
    assert.error_matches(function() plane:pixels { size = { 0, 3 } } end, "at least 1")
    assert.error_matches(function() plane.pixels {} end, "call it as a method")
    assert.error_matches(function() plane:write(3) end, "must be a file name")
    local image, message = plane:pixels { crop = { 150, 0, 20, 20 } }
    assert.is_nil(image)
    assert.matches("does not lie inside the frame", message, 1, true)
    assert.is_nil((plane:write(bench.folder .. "/film.lua/x.plane")))
  end)
end)

describe("a plane on the command line", function()
  it("is rendered, one for each frame", function()
    done("render film.lua -o a.##.plane")
    assert.equal("celplane", bench:read "a.02.plane":sub(1, 8))
    assert.matches("size 160x90\nalpha none\nbytes %d+\nbands 1\n", done "info a.02.plane")
    assert.matches("gradients %d+\npictures 0\n$", done "info a.02.plane")
  end)

  it("has a picture once, and the grid of a defocused cel, whatever shows of them", function()
    bench:write("pictured.lua", [[
local celspan = require "celspan"
local noise, state = {}, 1
for i = 1, 4 * 60 * 60 do
  state = state * 48271 % 2147483647
  noise[i] = string.char(i % 4 == 0 and 255 or state % 256)
end
local noisy = celspan.picture { size = { 60, 60 }, pixels = table.concat(noise) }
return celspan.film { size = { 160, 90 }, frames = 3, frame = function(f)
  return celspan.rostrum {
    celspan.cel { celspan.circle { centre = { 40, 45 }, radius = 30 }, defocus = 4 },
    celspan.cel { celspan.rect { 20 * f.number, 20, 50, 50, texture = noisy } } }
end }
]])
    done("render pictured.lua -o film.plane")
    done("render pictured.lua --frames 3 -o one.plane")
    assert.is_true(#bench:read "one.plane" > 3 * 60 * 60)
    assert.is_true(#bench:read "film.plane" < 1.2 * #bench:read "one.plane")
    assert.matches("pictures 2\n$", done "info film.plane")
    -- Small frames are made of fewer nodes of a blur than the plane.
    for size, most in pairs { ["160x90"] = 8 / 255, ["640x360"] = 2.01 / 255 } do
      done("render pictured.lua --frames 3 --size %s --antialias area -o rendered.png", size)
      done("convert film.plane --frame 3 drawn.png --size %s", size)
      done("compare rendered.png drawn.png --fail %g", most)
    end
  end)

  it("is a film of all frames, each of which is the plane that it would be alone", function()
    done("render film.lua -o film.plane")
    assert.matches("\nframes 3\nfps 24\nseconds 0.125\n", done "info film.plane", 1, true)
    for frame = 1, 3 do
      done("render film.lua --frames %d -o one.plane", frame)
      done("convert one.plane one.span --size 320x180")
      done("convert film.plane frame.span --frame %d --size 320x180", frame)
      assert.equal(bench:read "one.span", bench:read "frame.span")
    end
    assert.equal(done("spans film.plane --rows 40-40"),
      done("spans film.plane --rows 40-40 --frame 1"))
    assert.not_equal(done("spans film.plane --rows 40-40"),
      done("spans film.plane --rows 40-40 --frame 3"))
    refused(2, "film.plane: there is no frame 4: it has frames 1 to 3",
      "convert film.plane a.png --frame 4")
    refused(2, "--frame 0: frames of a plane file are numbered from 1",
      "spans film.plane --frame 0")
    refused(2, "one.plane: there is no frame 2: it has only frame 1",
      "convert one.plane a.png --frame 2")
  end)

  it("is a film in which a frame that is held is there once", function()
    bench:write("held.lua", (FILM:gsub("frames = 3", "frames = 40")
      :gsub("f%.number", "(f.number // 20)")))
    done("render held.lua -o held.plane")
    done("render held.lua --frames 1 -o one.plane")
    assert.is_true(#bench:read "held.plane" < 3 * #bench:read "one.plane" + 40 * 8 + 200)
  end)

  it("takes few bytes where light changes and shapes remain", function()
    bench:write("dusk.lua", [[
local celspan = require "celspan"
local sky = celspan.linear { from = { 0, 0 }, to = { 0, 90 }, { 0, "#204060" }, { 1, "#f0d0a0" } }
return celspan.film { size = { 160, 90 }, frames = 9, frame = function(f)
  local light = 1 - f.progress / 2
  local balls = {}
  for i = 1, 40 do
    balls[i] = celspan.circle { centre = { 4 * i, 45 + i % 7 }, radius = 9, texture = sky }
  end
  return celspan.rostrum { back = "#fff",
    celspan.cel { celspan.union(balls), front = { light, light, light } } }
end }
]])
    local size = {}
    for _, frames in ipairs { "1-1", "1-9" } do
      done("render dusk.lua --depth 8 -o a.plane --frames " .. frames)
      size[#size + 1] = #bench:read "a.plane"
    end
    assert.is_true(size[2] - size[1] < 8 * 250, size[2] - size[1])
  end)

  it("takes at most 300 KiB for two seconds of the demo film", function()
    local code, _, err = bench:celspan(
      "render scripts/demo.lua --frames 1-48 --depth 8 -o %s/a.plane", bench.folder)
    assert.equal(0, code, err)
    assert.is_true(#bench:read "a.plane" <= 307200)
  end)

  it("is made whole, in one run", function()
    for _, option in ipairs { "--keep-going", "--task 1/2" } do
      refused(2, "shot.####.plane", "render film.lua -o a.plane " .. option)
    end
    bench:write("last.lua", (FILM:gsub("return celspan.rostrum",
      'if f.number == 3 then error "no" end return celspan.rostrum')))
    refused(3, "no", "render last.lua -o a.plane")
    assert.is_nil(bench:read "a.plane")
  end)

  it_compares("is, with 8-bit colours, what the film shows, exact at its pixels", function()
    bench:write("edges.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 1280, 90 }, frames = 4, frame = function(f)
  local art = {}
  for i = 0, 24 do
    art[i + 1] = celspan.rect { 50 * i + f.number, 3 + i, 31, 50, texture = "#fff" }
  end
  return celspan.rostrum { back = "#000", celspan.cel(art) }
end }
]])
    for name, limit in pairs { film = 0.012, edges = 0 } do
      done(("render %s.lua -o a.plane --depth 8"):format(name))
      for frame = 2, 3 do
        done(("convert a.plane a.png --frame %d"):format(frame))
        done(("render %s.lua --frames %d -o b.png"):format(name, frame))
        done(("compare a.png b.png --fail %g"):format(limit))
      end
    end
  end)

  it_compares("is converted to what the film's frame shows", function()
    done("render film.lua --frames 2 -o a.plane")
    for _, size in ipairs { "160x90", "500x300" } do
      done("render film.lua --frames 2 --size " .. size .. " -o a.png")
      done("convert a.plane b.png --size " .. size)
      done("compare a.png b.png --fail 0.01")
      done("compare a.plane a.png --fail 0.01")
    end
    done("convert a.plane c.png --size 500x300 --crop 100,90,50,40")
    done("convert b.png d.png --crop 100,90,50,40")
    done("compare c.png d.png")
  end)

  it("is printed as spans, and cut into tiles", function()
    done("render film.lua --frames 2 -o a.plane")
    local spans = done("spans a.plane --size 16x9 --rows 8-8")
    assert.equal("8 0 16 single 1 1 1 1\n", spans:match "^[^\n]*\n$")
    refused(2, "is a plane", "spans a.plane --stats")
    done("tiles a.plane -o tiles --size 1024x576")
    assert.is_truthy(bench:read "tiles/a.dzi")
  end)

  it("is not made where options ask for pixels", function()
    for _, option in ipairs { "--size 9x9", "--crop 0,0,9,9", "--hash", "--draft" } do
      refused(2, "a.plane: plane takes no " .. option:match "^%S+",
        "render film.lua --frames 1 -o a.plane " .. option)
    end
    refused(3, "a blurred object is in view", "render blurred.lua -o a.plane")
    assert.is_nil(bench:read "a.plane")
  end)

  it("is refused when it is damaged, with the place", function()
    done("render film.lua --frames 2 -o a.plane")
    local bytes = bench:read "a.plane"
    bench:write("b.plane", bytes:sub(1, 60) .. "x" .. bytes:sub(62))
    refused(4, "b.plane: byte 40: band 0: the checksum is wrong", "info b.plane")
    bench:write("c.plane", bytes:sub(1, -9))
    refused(4, "c.plane: byte", "convert c.plane c.png")
    refused(3, "'celspan info a.plane' describes it", "render a.plane -o a.png")
  end)

  it("is refused as a plane by its name when its beginning is damaged", function()
    done("render film.lua --frames 2 -o a.plane")
    bench:write("b.plane", "x" .. bench:read("a.plane"):sub(2))
    bench:write("c.plane", "")
    for _, words in ipairs { "info %s", "spans %s", "convert %s a.png", "tiles %s -o tiles",
                             "compare a.plane %s", "plane %s -o a.html" } do
      refused(4, "b.plane: byte 0: this is not a plane file", words:format "b.plane")
      refused(4, "c.plane: byte 0: the file is too short", words:format "c.plane")
    end
    refused(4, "d.plane: No such file or directory", "info d.plane")
    refused(4, "d.plane: No such file or directory", "convert d.plane new.png")
  end)

  it("is not replaced by what is made of it", function()
    done("render film.lua --frames 2 -o a.plane")
    local bytes = bench:read "a.plane"
    bench:write("a.html", bytes)
    bench:write("a.png", bytes)
    refused(2, "a.html: the output is the plane that is read", "plane a.html -o ./a.html")
    refused(2, "./a.png: the output is the plane that is read", "convert a.png ./a.png")
    assert.equal(bytes, bench:read "a.html")
    assert.equal(bytes, bench:read "a.png")
  end)

  it("is refused when a later frame is damaged, with the frame", function()
    done("render film.lua -o film.plane")
    local bytes = bench:read "film.plane"
    bench:write("damaged.plane", bytes:sub(1, -100) .. "x" .. bytes:sub(-98))
    done("convert damaged.plane a.png")
    for _, words in ipairs { "info damaged.plane", "plane damaged.plane -o a.html",
                             "convert damaged.plane a.png --frame 3" } do
      refused(4, "damaged.plane: frame 3: byte", words)
    end
    assert.is_nil(bench:read "a.html")
  end)

  it("is compared frame by frame", function()
    done("render film.lua -o film.plane")
    done("convert film.plane third.png --frame 3 --size 320x180")
    done("compare film.plane third.png --frame 3 --fail 0.002")
    assert.equal(1, (bench:celspan_inside "compare film.plane third.png --fail 0.002"))
    refused(2, "film.plane: there is no frame 4", "compare film.plane third.png --frame 4")
  end)

  it("is converted to one picture", function()
    done("render film.lua -o film.plane")
    refused(2, "f.####.png: one picture is written", "convert film.plane f.####.png")
  end)

  it_compares("is not made of a picture", function()
    done("render film.lua --frames 1 -o a.png")
    refused(2, "not of a picture", "convert a.png a.plane")
  end)
end)

describe("planes in a plane", function()
  local TABLE = "x,y,width,height,plane\n"

  --- CRC-32C.
  local function checksum(bytes)
    local sum = 0xffffffff
    for i = 1, #bytes do
      sum = sum ~ bytes:byte(i)
      for _ = 1, 8 do sum = sum >> 1 ~ (sum & 1) * 0x82f63b78 end
    end
    return sum ~ 0xffffffff
  end

  --- A plane with others in it, which no window shows, as the program does not write it.
  local function nest(...)
    local count = select("#", ...)
    local head = ("<c8I4I4I4"):pack("celnests", 1, count, 0)
    for i = 1, count do head = head .. ("<I8"):pack(#select(i, ...)) end
    return head .. ("<I4"):pack(checksum(head)) .. table.concat { ... }
  end

  before_each(function()
    done("render film.lua -o film.plane")
    done("render film.lua --frames 2 -o still.plane")
    bench:write("inner.csv", TABLE .. "10,20,80,45,still.plane\n")
    done("plane film.plane --windows inner.csv -o inner.plane")
    bench:write("outer.csv", TABLE .. "0,0,160,90,inner.plane\n0.1,0.2,1.6,0.9,still.plane\n"
      .. "150,85,10,5,./inner.plane\n")
    done("plane film.plane --windows outer.csv -o outer.plane")
  end)

  it("are in one file, which is read to its end, and else is the outer one", function()
    local told = done "info outer.plane"
    assert.matches("frames 3\n.*windows 3\nplanes 3\n$", told)
    assert.is_nil(done "info film.plane":match "windows")
    assert.matches('"windows": *3', (done "info outer.plane --json"))
    done("convert outer.plane a.png --frame 3")
    done("convert film.plane b.png --frame 3")
    assert.equal(bench:read "b.png", bench:read "a.png")
    assert.is_true(bench:read "outer.plane":find(bench:read "inner.plane", 1, true) ~= nil)
  end)

  it("are refused where one is damaged, with its place", function()
    local bytes = bench:read "outer.plane"
    local at = bytes:find(bench:read "still.plane", 1, true) + 60
    bench:write("a.plane", bytes:sub(1, at) .. "x" .. bytes:sub(at + 2))
    done("convert a.plane a.png --frame 1") -- the outer one is whole
    refused(4, "a.plane: plane 1: plane 1: frame 1: byte 40: band 0: the checksum is wrong",
      "info a.plane")
    refused(4, "a.plane: plane 1", "plane a.plane -o a.html")
    bench:write("b.plane", bytes .. "x")
    refused(4, "b.plane: byte 0: there is something after the nest", "info b.plane")
    bench:write("c.plane", bytes:sub(1, 30) .. "x" .. bytes:sub(32))
    refused(4, "c.plane: byte 0: the checksum of the head of the nest is wrong", "info c.plane")
  end)

  it("are at most sixteen in each other", function()
    bench:write("0.plane", bench:read "still.plane")
    for i = 1, 15 do
      bench:write("a.csv", ("%s0,0,80,45,%d.plane\n"):format(TABLE, i - 1))
      done("plane still.plane --windows a.csv -o %d.plane", i)
    end
    done("info 15.plane")
    bench:write("a.csv", TABLE .. "0,0,80,45,15.plane\n")
    refused(4, "15.plane: it has planes 16 deep; no reader goes deeper",
      "plane still.plane --windows a.csv -o 16.plane")
    bench:write("16.plane", nest(bench:read "still.plane", bench:read "15.plane"))
    refused(4, "more than 16 planes are in each other", "info 16.plane")
  end)

  it("are not made of tables that are wrong", function()
    for _, one in ipairs {
      { 4, "a.csv: row 1: the window 150,0,16,9 is not in the frame, which is 160 x 90",
        "150,0,16,9,still.plane" },
      { 4, "a.csv: row 1: the window -1,0,16,9 is not", "-1,0,16,9,still.plane" },
      { 4, "a.csv: row 1: the window 1,1,1e-05,1e-05 is not in the frame, which is 160 x 90, or "
        .. "too small (at least a 1048576th of each side)", "1,1,1e-5,1e-5,still.plane" },
      { 4, "a.csv: line 2: column 'x' is 'left'", "left,0,16,9,still.plane" },
      { 4, "a.csv: row 1: it has no 'plane'", "0,0,16,9," },
      { 4, "none.plane: No such file", "0,0,16,9,none.plane" },
      { 4, "film.lua: byte 0: this is not a plane file", "0,0,16,9,film.lua" },
      { 2, "the output is the plane that is read", "0,0,16,9,new.plane" },
    } do
      bench:write("new.plane", bench:read "still.plane")
      bench:write("a.csv", TABLE .. one[3] .. "\n")
      refused(one[1], one[2], "plane film.plane --windows a.csv -o new.plane")
      assert.equal(bench:read "still.plane", bench:read "new.plane")
    end
    refused(4, "outer.plane: this plane has windows already",
      "plane outer.plane --windows outer.csv -o a.plane")
    refused(2, "--windows: give a FILE", "plane film.plane --windows outer.csv -o a.html")
    refused(2, "--windows: give a FILE", "plane --windows outer.csv -o a.plane")
    refused(2, "--title: a plane has no title",
      "plane film.plane --windows outer.csv -o a.plane --title A")
    bench:write("table.plane", TABLE .. "0,0,16,9,still.plane\n")
    refused(2, "the output is the plane that is read",
      "plane film.plane --windows table.plane -o table.plane")
    bench:write("bare.plane", nest(bench:read "still.plane"))
    done("info bare.plane")
    refused(4, "bare.plane: this plane has windows already",
      "plane bare.plane --windows outer.csv -o a.plane")
    bench:write("a.csv", TABLE)
    refused(4, "a.csv: has no rows: give one for each window",
      "plane film.plane --windows a.csv -o a.plane")
    bench:write("a.csv", TABLE .. ("0,0,16,9,still.plane\n"):rep(1025))
    refused(4, "has 1025 rows; a plane has at most 1024 windows",
      "plane film.plane --windows a.csv -o a.plane")
  end)

  it("are at most 1023, so that a reader takes the file", function()
    local rows, still = {}, bench:read "still.plane"
    for i = 1, 1024 do
      bench:write(("%d.plane"):format(i), still)
      rows[i] = ("0,0,16,9,%d.plane\n"):format(i)
    end
    bench:write("a.csv", TABLE .. table.concat(rows))
    refused(4, "a.csv: names 1024 planes; a plane has at most 1023 in it",
      "plane film.plane --windows a.csv -o a.plane")
    bench:write("a.csv", TABLE .. table.concat(rows, "", 1, 1023) .. rows[1])
    done("plane film.plane --windows a.csv -o a.plane")
    assert.matches("windows 1024\nplanes 1023\n$", done "info a.plane")
  end)
end)
