-- Footage that is damaged, lies, or has another form than its name says.

local movies = require "tests.support.movies"
local present = require "tests.support.present"
local prng = require "tests.support.prng"
local workbench = require "tests.support.workbench"

local HOSTILE = workbench.build .. "/tests/hostile_ffmpeg"

local W, FRAME = movies.W, movies.FRAME
local X264 = movies.x264()
local it_decodes = movies.are_made and it or pending

local function test(seconds) return movies.test(24, seconds) end

describe("footage that is not as it should be", function()
  local bench

  before_each(function() bench = movies.bench() end)
  after_each(function() bench:remove() end)

  local function fails(...) movies.fails(bench, ...) end
  local function checks(script)
    bench:write("checked.lua", script)
    local code, out, err = bench:celspan_inside "check --trust checked.lua"
    assert.equal(0, code, out .. err)
  end

  -- -------------------------------------------------------------- damage

  it_decodes("shows the same pictures of a damaged movie in any order, and all of them", function()
    for _, amount in ipairs { 200, 300, 3000 } do
      movies.make(bench, "bad.mp4", ("-f lavfi -i testsrc2=s=320x180:r=24:d=3,noise=alls=40:allf=t "
        .. "%s-bsf:v noise=amount=%d"):format(X264, amount))
      local forwards, said = movies.render(bench, "bad.mp4", "frame")
      local count, size = tonumber(said:match "^%d+ %d+ [%d.]+ (%d+)"), 320 * 180 * 4
      assert.equal(count * size, #forwards)
      local backwards = movies.render(bench, "bad.mp4", "back")
      for i = 0, count - 1 do
        assert(forwards:sub(i * size + 1, (i + 1) * size)
          == backwards:sub((count - 1 - i) * size + 1, (count - i) * size), "picture " .. i + 1)
      end
    end
  end)

  it_decodes("says in one line why no picture can be decoded", function()
    movies.make(bench, "a.mkv", test(1) .. "-c:v ffv1 -g 48 -bsf:v noise=amount=0:drop='not(n)'")
    local _, _, err = bench:celspan_inside "render film.lua -o f.%%04d.png -- a.mkv frame"
    assert.matches("the movie a.mkv: none of its pictures can be decoded: .*without valid keyframe",
      err)
    assert.equal(1, select(2, err:gsub("without valid keyframe", "")), err)
  end)

  -- A movie of each container with bytes changed: a picture or one sentence, and never a crash.
  -- CELSPAN_DAMAGES=100 tries as many of each container, for a longer run by hand.
  it_decodes("shows or refuses damaged containers", function()
    local kinds = { mp4 = X264, mov = "-c:v prores_ks ", mkv = X264, avi = "-c:v mjpeg ",
      ts = X264, mxf = "-c:v mpeg2video ", webm = "-c:v libvpx-vp9 ", y4m = "-pix_fmt yuv420p " }
    for kind, coding in pairs(kinds) do
      local name, random = "a." .. kind, prng.new(#kind * 7 + kind:byte())
      movies.make(bench, name, test(.5) .. coding)
      local whole = bench:read(name)
      for case = 1, tonumber(os.getenv "CELSPAN_DAMAGES") or present.sanitizer() and 2 or 4 do
        local bytes = { whole:byte(1, math.min(#whole, 60000)) }
        for _ = 1, (case - 1) % 8 * 8 + 8 do
          bytes[random:whole(13, #bytes)] = random:whole(0, 255)
        end
        local parts = {}
        for i = 1, #bytes, 4000 do
          parts[#parts + 1] = string.char(table.unpack(bytes, i, math.min(#bytes, i + 3999)))
        end
        bench:write(name, table.concat(parts) .. whole:sub(60001))
        local code, _, err = bench:celspan_inside(
          "render film.lua --limit picture-time=5 --frames 1-last:4 -o f.%%04d.png -- %s frame",
          name)
        assert(code == 0 or (code >= 2 and code <= 6) or code == 33, name .. case .. ": " .. err)
        assert.falsy(err:find("for 5 seconds", 1, true), err)
      end
    end
  end)

  -- -------------------------------------------------------------- limits

  it_decodes("is limited in what a picture takes, and in the number of pictures", function()
    movies.make(bench, "large.mkv", "-f lavfi -i color=s=6000x4000:r=1:d=1 -c:v ffv1 -pix_fmt gbrp")
    fails(6, "--memory 64 -- large.mkv frame",
      "a picture of 6000 x 4000 pixels takes 69 MiB, and the memory for pictures is 42 MiB")
  end)

  it_decodes("is listed within a time, and to a length", function()
    movies.run(bench, ("mkdir bin && cp '%s' bin/ffprobe"):format(HOSTILE))
    local function lists(word, pattern)
      bench:write("a.mp4", "\0\0\0\20ftyp" .. word)
      local code, _, err = bench:inside(("PATH=\"$PWD/bin:$PATH\" timeout 60 '%s' render film.lua "
        .. "--limit picture-time=%d -o f.%%04d.png -- a.mp4 frame"):format(workbench.binary,
        word == "trickle" and 1 or 20))
      assert.equal(6, code, err)
      assert.matches(pattern, err)
    end
    lists("trickle", "its list of pictures was not whole after 1.?%d* seconds")
    lists("flood", "it has more than 4000000 pictures")
  end)

  it_decodes("names the program that is missing", function()
    movies.make(bench, "a.mp4", test(1) .. X264)
    movies.run(bench, "mkdir bin && ln -s \"$(command -v ffmpeg)\" bin/ffmpeg")
    local code, _, err = bench:inside(("PATH=\"$PWD/bin\" '%s' render film.lua -o f.%%04d.png "
      .. "-- a.mp4 frame"):format(workbench.binary))
    assert.equal(5, code)
    assert.matches("ffprobe, which reads movies, is not in PATH: install the package ffmpeg", err)
  end)

  -- -------------------------------------------------------------- names and first bytes

  it_decodes("may have a name like that of numbered files", function()
    for _, name in ipairs { "take#3.mp4", "100%done.mp4" } do
      movies.make(bench, "a.mp4", test(1) .. X264)
      os.rename(bench.folder .. "/a.mp4", bench.folder .. "/" .. name)
      local codes = movies.render(bench, name, "frame")
      assert.equal(24 * FRAME, #codes)
      bench:write(name, "no movie")
      fails(4, "-- " .. name .. " frame", ("footage: the movie %s has none of the formats"):format(
        (name:gsub("%%", "%%%%"))))
    end
  end)

  it("is not a still picture that is packed like an mp4", function()
    for _, brand in ipairs { "avif", "avis", "heic", "mif1", "crx " } do
      bench:write("a.mp4", "\0\0\0\20ftyp" .. brand .. ("\0"):rep(200))
      local code, out, err = bench:celspan_inside "info a.mp4"
      assert.are_not.equal(0, code, out)
      assert.falsy(err:find("the movie", 1, true), err)
    end
  end)

  -- -------------------------------------------------------------- grey, and matrices

  it_decodes("has the grey and the alpha of grey movies, of 8 and 16 bits", function()
    for _, layout in ipairs { "ya8", "ya16be" } do
      movies.make(bench, "a.mov", test(.5) .. "-vf format=yuva444p,geq=lum='X*3+N':"
        .. "cb=128:cr=128:a='255-Y*5',format=" .. layout .. " -c:v png")
      local codes = movies.render(bench, "a.mov", "frame")
      local wanted, worst = movies.pixels(bench, "a.mov", "ya8"), 0
      for i = 0, #codes // 4 - 1, 5 do
        local grey, alpha = wanted:byte(2 * i + 1, 2 * i + 2)
        if alpha > 0 then
          for c = 1, 3 do worst = math.max(worst, math.abs(codes:byte(4 * i + c) - grey)) end
        end
        worst = math.max(worst, math.abs(codes:byte(4 * i + 4) - alpha))
      end
      assert(worst <= 2 and #codes == 12 * FRAME, layout .. ": " .. worst)
    end
  end)

  it_decodes("has the range that grey with alpha says", function()
    local function greys(range)
      movies.make(bench, "a.mkv", ("-f lavfi -i color=s=64x36:r=24:d=0.1 -vf "
        .. "format=gray,geq=lum='16+X*3.2',format=ya8 -c:v ffv1 -pix_fmt ya8 %s"):format(range))
      return movies.render(bench, "a.mkv", "frame"), movies.pixels(bench, "a.mkv", "ya8")
    end
    for range, scale in pairs { tv = 255 / 219, pc = 1, unknown = 1 } do
      local codes, stored = greys("-color_range " .. range)
      for x = 0, W - 1 do
        local wanted = (stored:byte(2 * x + 1) - (scale > 1 and 16 or 0)) * scale
        local got = codes:byte(4 * x + 1)
        assert(math.abs(got - math.max(0, math.min(wanted, 255))) <= 2,
          ("%s: %d at %d, not %.1f"):format(range, got, x, wanted))
      end
    end
  end)

  it_decodes("needs no matrix that is read where there are no colours to mix", function()
    for _, layout in ipairs { "gray", "gbrp" } do
      movies.make(bench, "a.mkv", test(.5) .. "-c:v ffv1 -pix_fmt " .. layout
        .. " -colorspace ycgco")
      assert.equal(12 * FRAME, #movies.render(bench, "a.mkv", "frame"))
    end
    movies.make(bench, "a.mkv", test(.5) .. "-c:v ffv1 -pix_fmt yuv444p -colorspace ycgco")
    fails(4, "-- a.mkv frame", "has colours by the matrix")
  end)

  it_decodes("of high dynamic range is refused, unless its codes are taken", function()
    movies.make(bench, "a.mkv", test(.5) .. X264 .. "-color_trc smpte2084")
    fails(3, "-- a.mkv frame", "is of high dynamic range %(PQ%), which is not read")
    movies.render(bench, "a.mkv", "frame", 24, "rec709")
  end)

  -- -------------------------------------------------------------- numbered files

  it("begins its loop again at its length, however this is rounded", function()
    for i = 1, 3 do bench:write(("p.%04d.ppm"):format(i), "P6 1 1 255 abc") end
    checks [[
      local celspan = require "celspan"
      local clip = celspan.footage { file = "p.####.ppm", fps = 10, loop = true }
      local shown = { clip:frame(1), clip:frame(2), clip:frame(3) }
      for i = 0, 600 do
        assert(clip:at(i * .1) == shown[i % 3 + 1], i)
        assert(clip:at(i / 3 * .3) == shown[i % 3 + 1], i)
      end
      return celspan.rostrum {}]]
  end)

  it("opens numbered files when they are seen, which have one size", function()
    bench:write("p.0001.ppm", "P6 1 1 255 abc")
    bench:write("p.0002.ppm", "P6 2 1 255 abcdef")
    bench:write("p.0003.ppm", "no picture")
    checks [[
      local celspan = require "celspan"
      local clip = celspan.footage { file = "p.####.ppm" }
      assert(clip.frames == 3)
      local shown = setmetatable({ clip:frame(1) }, { __mode = "v" })
      for i = 1, 500 do assert(#("x"):rep(1e6 + i) > 1e6) end -- collects what is not kept
      assert(shown[1] == clip:frame(1), "the first file was opened again")
      local is_open, message = pcall(clip.frame, clip, 2)
      assert(not is_open and tostring(message):find(
        "p.####.ppm: number 2 has 2 x 1 pixels, and the first one 1 x 1", 1, true), message)
      return celspan.rostrum {}]]
  end)
end)
