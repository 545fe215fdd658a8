-- Footage: each picture is the one that ffmpeg has at the time, converted exactly; bad movies are
-- refused in one sentence, and numbered files begin anywhere.

local movies = require "tests.support.movies"
local present = require "tests.support.present"

local W, H = movies.W, movies.H
local TEST, X264 = movies.test, movies.x264
local it_decodes = movies.are_made and it or pending
local it_converts = present.spaces() and present.pictures() and it or pending

local run, make, render = movies.run, movies.make, movies.render

-- ---------------------------------------------------------------- what ffmpeg has

--- The times of the pictures, in seconds from the first one, and the tick.
local function times_of(bench, name)
  run(bench, ("ffmpeg -v error -y -copyts -i %s -map 0:V:0 -vsync passthrough -enc_time_base -1 "
    .. "-f framemd5 times.txt"):format(name))
  local text, times = bench:read "times.txt", {}
  local a, b = text:match "#tb 0: (%d+)/(%d+)"
  for pts in text:gmatch "\n0, *%-?%d+, *(%-?%d+)," do times[#times + 1] = pts * a / b end
  for i = #times, 1, -1 do times[i] = times[i] - times[1] end
  return times, a / b
end

--- The raw planes of all pictures.
local function planes_of(bench, name, form)
  return movies.pixels(bench, name, form.pixels, "-noautorotate " .. (form.decoder or ""),
    "-vsync passthrough")
end

local function floor_to(value, most) return math.max(0, math.min(most, value)) end

--- R'G'B' of a pixel of a picture, in codes from 0 to 1, by exact formulas.
local function exact(raw, form, picture, x, y)
  local bytes, most = form.bits > 8 and 2 or 1, (1 << form.bits) - 1
  local cw, ch = (W + form.across - 1) // form.across, (H + form.down - 1) // form.down
  local size = (W * H * (form.alpha and 2 or 1) + 2 * cw * ch) * bytes
  local function sample(start, width, sx, sy)
    return (("<I" .. bytes):unpack(raw, picture * size + (start + sy * width + sx) * bytes + 1))
  end
  local function colour(start)
    local px, py = x / form.across, form.down == 1 and y or (y - .5) / 2
    local x0, y0 = math.floor(px), math.floor(py)
    local function at(i, j)
      return sample(start, cw, floor_to(x0 + i, cw - 1), floor_to(y0 + j, ch - 1))
    end
    local u, v = px - x0, py - y0
    return (1 - v) * ((1 - u) * at(0, 0) + u * at(1, 0)) + v * ((1 - u) * at(0, 1) + u * at(1, 1))
  end
  local unit = 1 << (form.bits - 8)
  if form.rgb then
    local low, range = form.limited and 16 * unit or 0, form.limited and 219 * unit or most
    local function light(plane) return (sample(plane * W * H, W, x, y) - low) / range end
    return { light(2), light(0), light(1), 1 }
  end
  local black, light, chroma = 16 * unit, 219 * unit, 224 * unit
  if form.full then black, light, chroma = 0, most, most end
  local kr, kb = table.unpack(form.matrix or { .299, .114 })
  local l = (sample(0, W, x, y) - black) / light
  local cb = (colour(W * H) - 128 * unit) / chroma
  local cr = (colour(W * H + cw * ch) - 128 * unit) / chroma
  local r, b = l + 2 * (1 - kr) * cr, l + 2 * (1 - kb) * cb
  local alpha = form.alpha and sample(W * H + 2 * cw * ch, W, x, y) / most or 1
  return { r, (l - kr * r - kb * b) / (1 - kr - kb), b, alpha }
end

-- ---------------------------------------------------------------- comparing

--- The upright place of a stored pixel.
local function upright(form, x, y)
  if form.turns == 1 then return H - 1 - y, x, H end
  if form.turns == 3 then return y, W - 1 - x, H end
  return x, y, W
end

--- The largest difference, in 8-bit codes, between frame `shown` of the render and a picture.
local function difference(codes, shown, raw, form, picture)
  local worst = 0
  for i = 0, 119 do
    local x, y = i * 37 % W, i * 23 % H
    local wanted, ux, uy, width = exact(raw, form, picture, x, y), upright(form, x, y)
    local at = (shown * W * H + uy * width + ux) * 4
    for c = 1, wanted[4] > 0 and 4 or 0 do
      worst = math.max(worst, math.abs(codes:byte(at + c) - 255 * floor_to(wanted[c], 1)))
    end
  end
  return worst
end

local function check(bench, name, form)
  local raw, times, tick = planes_of(bench, name, form), times_of(bench, name)
  local codes = render(bench, name, "at", 50, form.colour)
  local slack = form.is_exact and 1e-6 or tick / 2
  local count = #codes // (W * H * 4)
  assert(count >= 20, name .. ": " .. count .. " frames")
  for shown = 0, count - 1, 7 do
    local place = 1
    while times[place + 1] and times[place + 1] <= shown / 50 + slack do place = place + 1 end
    local worst = difference(codes, shown, raw, form, place - 1)
    assert(worst <= 2, ("%s: frame %d differs from picture %d by %.1f"):format(name, shown, place,
      worst))
    local other = place < #times and place or place - 2
    assert(difference(codes, shown, raw, form, other) > 2, name .. ": its neighbour is equal")
  end
end

-- ---------------------------------------------------------------- clips

local P420 = { pixels = "yuv420p", across = 2, down = 2, bits = 8 }
local function like(form, fields)
  local copy = {}
  for key, value in pairs(form) do copy[key] = value end
  for key, value in pairs(fields) do copy[key] = value end
  return copy
end

local clips = {}
local function add(name, made, form) clips[#clips + 1] = { name, made, form or P420 } end

for _, rate in ipairs { "12", "24000/1001", "24", "25", "30", "60" } do
  add(("r%s.mp4"):format(rate:match "^%d+" .. (rate:find "/" and "n" or "")),
    TEST(rate, 1) .. X264 "yuv420p")
end
add("matroska.mkv", TEST(24, 1) .. X264 "yuv420p")
add("variable.mp4", TEST(30, 2)
  .. "-vf \"select='not(mod(n,5))+not(mod(n,7))',setpts=PTS\" -vsync vfr " .. X264 "yuv420p")
add("ten.mp4", TEST(24, 1) .. X264 "yuv420p10le",
  like(P420, { pixels = "yuv420p10le", bits = 10 }))
add("wide.mp4", TEST(24, 1) .. X264 "yuv422p",
  like(P420, { pixels = "yuv422p", down = 1 }))
add("full.mp4", TEST(24, 1) .. X264 "yuv444p" .. "-color_range pc -colorspace bt709",
  like(P420, { pixels = "yuvj444p", across = 1, down = 1, full = true, matrix = { .2126, .0722 } }))
add("broad.mp4", TEST(24, 1) .. X264 "yuv420p" .. "-colorspace bt2020nc",
  like(P420, { matrix = { .2627, .0593 } }))
add("alpha.webm", TEST(24, 1) .. "-vf format=yuva420p,colorchannelmixer=aa=0.5 "
  .. "-c:v libvpx-vp9 -pix_fmt yuva420p -b:v 500k",
  like(P420, { pixels = "yuva420p", alpha = true, decoder = "-c:v libvpx-vp9 " }))
add("alpha.mov", TEST(24, 1) .. "-vf format=yuva444p10le,colorchannelmixer=aa=0.5 "
  .. "-c:v prores_ks -pix_fmt yuva444p10le",
  { pixels = "yuva444p12le", across = 1, down = 1, bits = 12, alpha = true })

local PLAIN = like(P420, { pixels = "yuv444p", across = 1, down = 1, is_exact = true })
add("plain.y4m", TEST(24, 1) .. "-pix_fmt yuv444p", PLAIN)
add("plain.avi", TEST(24, 1) .. "-c:v ffv1 -pix_fmt yuv444p", PLAIN)
add("plain.mxf", TEST(24, 1) .. "-c:v mpeg2video -pix_fmt yuv422p -q:v 2",
  like(PLAIN, { pixels = "yuv422p", across = 2 }))
add("plain.ts", TEST(25, 1) .. X264 "yuv420p")
add("reorder.mkv", TEST(24, 1) .. "-c:v libx264 -pix_fmt yuv420p -g 48 -bf 8 -x264-params "
  .. "b-pyramid=normal:b-adapt=0")
add("limited.mkv", TEST(24, 1) .. "-c:v ffv1 -pix_fmt gbrp -color_range tv",
  { pixels = "gbrp", rgb = true, limited = true, across = 1, down = 1, bits = 8 })
add("rgb.mkv", TEST(24, 1) .. "-c:v ffv1 -pix_fmt gbrp10le",
  { pixels = "gbrp10le", rgb = true, across = 1, down = 1, bits = 10 })
add("pq.mkv", TEST(24, 1) .. X264 "yuv420p10le" .. "-colorspace bt2020nc "
  .. "-color_trc smpte2084 -color_primaries bt2020",
  like(P420, { pixels = "yuv420p10le", bits = 10, matrix = { .2627, .0593 }, colour = "srgb" }))

describe("footage", function()
  local bench

  before_each(function() bench = movies.bench() end)
  after_each(function() bench:remove() end)

  local function fails(name, pattern) movies.fails(bench, 4, "-- " .. name .. " frame", pattern) end

  for _, clip in ipairs(clips) do
    it_decodes("shows the pictures of " .. clip[1] .. " at their times", function()
      make(bench, clip[1], clip[2])
      check(bench, clip[1], clip[3])
    end)
  end

  it_decodes("follows an edit list, and turns a picture upright", function()
    make(bench, "whole.mp4", TEST(24, 2) .. X264 "yuv420p")
    make(bench, "edit.mp4", "-ss 0.7 -i whole.mp4 -c copy")
    check(bench, "edit.mp4", P420)
    make(bench, "right.mp4", "-i whole.mp4 -c copy -metadata:s:v rotate=270")
    check(bench, "right.mp4", like(P420, { turns = 1 }))
    make(bench, "left.mp4", "-i whole.mp4 -c copy -metadata:s:v rotate=90")
    check(bench, "left.mp4", like(P420, { turns = 3 }))
  end)

  it_decodes("shows the same pictures in any order", function()
    make(bench, "a.mp4", TEST(24, 2) .. X264 "yuv420p")
    local forwards, said = render(bench, "a.mp4", "frame")
    assert.matches("64 36 24%.0000 48 2%.000 false", said)
    local backwards, size = render(bench, "a.mp4", "back"), W * H * 4
    assert.are.equal(48 * size, #backwards)
    for i = 0, 47 do
      assert(forwards:sub(i * size + 1, (i + 1) * size)
        == backwards:sub((47 - i) * size + 1, (48 - i) * size), "picture " .. i + 1)
    end
  end)

  it_decodes("shows each picture in its frame, though the clock of a file is rounded", function()
    make(bench, "a.mkv", TEST(24, 2) .. X264 "yuv420p")
    local numbered, timed = render(bench, "a.mkv", "frame"), render(bench, "a.mkv", "at", 24)
    assert(#timed >= 46 * W * H * 4 and numbered:sub(1, #timed) == timed, #timed)
  end)

  local sounds = { mkv = X264 "yuv420p" .. "-c:a libvorbis", ts = X264 "yuv420p" .. "-c:a aac",
    mxf = "-r 25 -c:v mpeg2video -pix_fmt yuv422p -c:a pcm_s16le -ar 48000" }
  for kind, coding in pairs(sounds) do
    it_decodes("has a sound, which a film plays: " .. kind, function()
      make(bench, "a." .. kind, TEST(25, 1) .. "-f lavfi -i sine=d=1 " .. coding)
      bench:write("heard.lua", ([[
        local celspan = require "celspan"
        local clip = celspan.footage { file = "a.%s" }
        return celspan.film { size = clip.size, fps = 24, frames = 24, frame = function()
          return celspan.rostrum {}
        end, sound = clip.sound and "a.%s" or nil }]]):format(kind, kind))
      local code, _, err = bench:celspan_inside "sound heard.lua -o mix.wav"
      assert.are.equal(0, code, err)
      local mix = bench:read "mix.wav"
      assert(#mix > 48000 * 4 and mix:sub(100000, 100999):find "[^%z]", #mix)
    end)
  end

  it_decodes("makes pixels square", function()
    make(bench, "square.mp4", TEST(24, 1) .. X264 "yuv420p" .. "-vf setsar=4/3")
    local _, said = render(bench, "square.mp4", "frame")
    assert.matches("^85 36 ", said)
  end)

  it_decodes("shows the pictures of a movie that ends early or changes its size", function()
    make(bench, "whole.mkv", TEST(24, 2) .. X264 "yuv420p"
      .. "-cluster_time_limit 200")
    local whole = bench:read "whole.mkv"
    bench:write("early.mkv", whole:sub(1, #whole // 2))
    local codes, said = render(bench, "early.mkv", "frame")
    local count = tonumber(said:match "^%d+ %d+ [%d.]+ (%d+)")
    assert(count > 5 and count < 48 and #codes == count * W * H * 4, said)
    make(bench, "one.ts", TEST(25, 1) .. X264 "yuv420p")
    make(bench, "two.ts", "-f lavfi -i testsrc2=s=128x72:r=25:d=1 " .. X264 "yuv420p"
      .. "-output_ts_offset 1")
    bench:write("change.ts", bench:read "one.ts" .. bench:read "two.ts")
    codes, said = render(bench, "change.ts", "frame")
    assert.matches("^64 36 ", said)
    assert(#codes > 40 * W * H * 4, said)
  end)

  it_decodes("says how many pictures are missing where a container counts them", function()
    local function cut(name, share)
      local whole = bench:read(name)
      bench:write(name, whole:sub(1, math.floor(#whole * share)))
    end
    make(bench, "a.mp4", TEST(24, 2) .. X264 "yuv420p" .. "-movflags +faststart")
    make(bench, "a.avi", TEST(24, 2) .. "-c:v mjpeg")
    make(bench, "one.mp4", "-f lavfi -i testsrc=s=64x36:r=24:d=1 " .. X264 "yuv420p"
      .. "-movflags +faststart")
    local whole = bench:read "a.mp4"
    local at = assert(whole:find("elst", 1, true)) + 12
    bench:write("trimmed.mp4", whole:sub(1, at - 1) .. (">I4"):pack(1000) .. whole:sub(at + 4))
    local _, said = render(bench, "trimmed.mp4", "frame")
    assert.matches("^64 36 24%.0000 24 1%.000 ", said)
    cut("a.mp4", 0.7)
    cut("a.avi", 0.5)
    cut("one.mp4", 2 / 3)
    fails("a.mp4", "the movie a.mp4 ends early: it has %d+ of the 48 pictures that it counts; ")
    fails("a.avi", "the movie a.avi ends early: it has %d+ of the 48 pictures that it counts; ")
    for _, verb in ipairs { "info one.mp4", "check --trust film.lua -- one.mp4 frame" } do
      local code, _, err = bench:celspan_inside(verb)
      assert.equal(4, code, verb .. err)
      assert.matches("one.mp4 ends early: it has %d+ of the 24 pictures", err)
    end
  end)

  it_decodes("refuses what is not a movie with pictures, in one sentence", function()
    make(bench, "sound.mp4", "-f lavfi -i sine=d=1 -c:a aac")
    fails("sound.mp4", "the movie sound.mp4 has no moving pictures, only sound")
    bench:write("list.mp4", "#EXTM3U\nfile:///etc/passwd\n")
    fails("list.mp4", "has none of the formats that are read")
    bench:write("list.txt", "ffconcat version 1.0\nfile sound.mp4\n")
    fails("list.txt", "has none of the formats that are read")
    bench:write("empty.mp4", "")
    fails("empty.mp4", "has none of the formats that are read")
    bench:write("part.mp4", bench:read("sound.mp4"):sub(1, 600))
    fails("part.mp4", "the movie part.mp4 cannot be read: ffprobe ended with exit code 1")
    fails("none.mp4", "the movie none.mp4 cannot be opened: No such file or directory")
    fails(".", "the movie %. ")
  end)

  it_decodes("is described by info", function()
    make(bench, "a.webm", TEST(24, 1) .. "-c:v libvpx-vp9")
    local code, out = bench:celspan_inside "info a.webm"
    assert.are.equal(0, code)
    assert.matches("^format matroska\ncodec vp9\nsize 64x36\nfps 24\nframes 24\n", out)
  end)

  it_decodes("has colours of which info says how they are read", function()
    local function says(made, colour, said, taken)
      make(bench, "a.mkv", "-f lavfi -i testsrc2=" .. made)
      local code, out = bench:celspan_inside "info a.mkv"
      assert.are.equal(0, code)
      local primaries, transfer, matrix, range = said:match "(%S+) (%S+) (%S+) (%S+)"
      local matrix_taken, range_taken = taken:match "(%S+) (%S+)"
      local wanted = ("\ncolour %s\nprimaries %s\ntransfer %s\nmatrix %s\nrange %s\n"
        .. "primaries_taken bt709\nmatrix_taken %s\nrange_taken %s\n"):format(colour, primaries,
        transfer, matrix, range, matrix_taken, range_taken)
      assert(out:find(wanted, 1, true), out)
    end
    local ffv1 = ":r=24:d=0.1 -c:v ffv1 -pix_fmt "
    says("s=64x36" .. ffv1 .. "yuv420p", "srgb", "unknown unknown unknown unknown", "bt601 limited")
    says("s=64x720" .. ffv1 .. "yuv420p", "srgb", "unknown unknown unknown unknown",
      "bt709 limited")
    says("s=64x36" .. ffv1 .. "gbrp", "srgb", "unknown unknown gbr pc", "none full")
    says("s=64x36" .. ffv1 .. "gray -color_range pc", "srgb", "unknown unknown unknown pc",
      "none full")
    says("s=64x36" .. ffv1 .. "yuv420p10le -colorspace bt2020nc -color_trc smpte2084 "
      .. "-color_primaries bt2020 -color_range tv", "none", "bt2020 smpte2084 bt2020nc tv",
      "bt2020 limited")
  end)

  it("shows numbered files, which begin anywhere", function()
    bench:write("plates.lua", [[
      local celspan = require "celspan"
      return celspan.film { size = { 8, 8 }, frames = 6, frame = function(f)
        local grey = f.index / 10
        return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 8, 8,
          texture = celspan.rgb(grey, grey, grey) } } }
      end }]])
    bench:write("show.lua", [[
      local celspan = require "celspan"
      local clip = celspan.footage { file = "p.####.png", fps = 12, from = 1 / 12, to = .4 }
      print(clip.frames, clip.seconds, clip.size[1], clip.fps)
      return celspan.film { size = clip.size, fps = 12, frames = clip.frames, frame = function(f)
        return celspan.rostrum { celspan.cel {
          celspan.rect { 0, 0, 8, 8, texture = clip:at(f.time) } } }
      end }]])
    assert.are.equal(0, (bench:celspan_inside "render plates.lua -o 'p.####.png'"))
    for i = 6, 1, -1 do
      os.rename(("%s/p.%04d.png"):format(bench.folder, i),
        ("%s/p.%04d.png"):format(bench.folder, 1000 + i))
    end
    local code, _, err = bench:celspan_inside "render show.lua -o 's.####.png'"
    assert.are.equal(0, code)
    assert.matches("^4\t0%.31666", err)
    for i = 1, 4 do
      assert.are.equal(0, (bench:celspan_inside("compare s.%04d.png p.%04d.png", i, 1001 + i)))
    end
    os.remove(bench.folder .. "/p.1003.png")
    os.remove(bench.folder .. "/p.1005.png")
    code, _, err = bench:celspan_inside "render show.lua -o 's.####.png'"
    assert.are.equal(4, code) -- an input, and not the script
    assert.matches("footage: p.####.png: 2 files are missing: 1003, 1005", err, 1, true)
  end)

  local CONFIGURATION = [[
ocio_profile_version: 2
roles: {default: coded, scene_linear: light}
colorspaces:
  - !<ColorSpace> {name: light, aliases: [lin_rec709]}
  - !<ColorSpace>
    name: coded
    from_reference: !<ExponentTransform> {value: 3, direction: inverse}
]]

  --- Renders a clip and the same pictures one by one, both in the space "coded", and the clip as
  --- its file is. How many of the three frames are alike: with the pictures, and with the file.
  local function alike_in_space(clip, picture, plain)
    local shown = [[
      local celspan = require "celspan"
      local clip = celspan.footage { file = "%s", %s }
      return celspan.film { size = { 8, 8 }, fps = 24, frames = 3, frame = function(f)
        return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 8, 8, texture = %s } } }
      end }]]
    local with, without = 0, 0
    for name, fields in pairs { c = { 'colour = "coded"', "clip:frame(f.index + 1)" },
      d = { "", picture }, e = { plain, "clip:frame(f.index + 1)" } } do
      bench:write(name .. ".lua", shown:format(clip, fields[1], fields[2]))
      local code, _, err = bench:celspan_inside(
        "render %s.lua --depth float --ocio config.ocio -o '%s.####.exr'", name, name)
      assert.equal(0, code, err)
    end
    for i = 1, 3 do
      local same = bench:celspan_inside("compare c.%04d.exr d.%04d.exr", i, i)
      local other = bench:celspan_inside("compare c.%04d.exr e.%04d.exr --fail 1e-3", i, i)
      with, without = with + (same == 0 and 1 or 0), without + (other == 0 and 1 or 0)
    end
    return with, without
  end

  it_converts("shows numbered files in a space of a configuration as pictures are", function()
    bench:write("config.ocio", CONFIGURATION)
    bench:write("plates.lua", [[
      local celspan = require "celspan"
      return celspan.film { size = { 8, 8 }, frames = 3, frame = function(f)
        return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 8, 8,
          texture = celspan.rgb((f.index + 1) / 4, .5, .25) } } }
      end }]])
    for ending, depth in pairs { exr = "float", dpx = "16" } do
      local code, _, err = bench:celspan_inside("render plates.lua --depth %s -o 'q.####.%s'",
        depth, ending)
      assert.equal(0, code, err)
      for i = 3, 1, -1 do
        os.rename(("%s/q.%04d.%s"):format(bench.folder, i, ending),
          ("%s/q.%04d.%s"):format(bench.folder, 6 + i, ending))
      end
      local file = "q.####." .. ending
      local with, without = alike_in_space(file, ("celspan.picture { file = %q, frame = 7 + "
        .. "f.index, colour = 'coded' }"):format(file), "")
      assert.same({ 3, 0 }, { with, without }, ending)
    end
  end)

  it_decodes("refuses a movie in a space of a configuration, and says what to do", function()
    make(bench, "m.mov", TEST(24, 1) .. X264 "yuv420p")
    bench:write("m.lua", 'require "celspan".footage { file = "m.mov", colour = "coded" }')
    local code, _, err = bench:celspan_inside "check m.lua"
    assert.are_not.equal(0, code)
    assert.matches('m.mov: colour "coded" is for numbered pictures', err, 1, true)
  end)

  it("refuses wrong fields", function()
    local function refused(fields, message, wanted)
      bench:write("wrong.lua", "local celspan = require 'celspan'\ncelspan.footage " .. fields)
      local code, _, err = bench:celspan_inside "check wrong.lua"
      assert.are.equal(wanted or 3, code, err)
      assert.matches("wrong.lua:2: footage: " .. message, err)
    end
    refused("{}", "field 'file' must be a string, got nil")
    refused("{ file = 'a.mp4', alpha = 'none' }", "field 'alpha' must be")
    refused("{ file = 'a.mp4', form = 1 }", "unknown field 'form'; did you mean 'from'%?")
    refused("{ file = 'a.####.png' }", "a.####.png: there are no such files", 4)
  end)
end)

