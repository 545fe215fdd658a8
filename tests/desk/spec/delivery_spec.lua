-- Deliveries: codecs, and what ffprobe and ffmpeg read back from them.

local movies = require "tests.support.movies"
local present = require "tests.support.present"
local rendering = require "tests.support.rendering"
local workbench = require "tests.support.workbench"

local HAS_ALL = (tonumber(os.getenv "CELSPAN_SCENES") or 300) >= 300
local it_reads = present.program("ffmpeg", "ffprobe") and it or pending

--- Four fields of one colour each, and a bar that grows with the frames. With "glass" half of the
--- frame is clear; with "confetti" it is full of small squares that change, which take many bytes.
local FILM = [[
local celspan = require "celspan"
local kind = ...
return celspan.film { size = { 256, 128 }, fps = 24, frames = 12, frame = function(f)
  local fields = {}
  for i, colour in ipairs { "#28506e", "#5a6e46", "#a0a0a0", "#c8b4be" } do
    local x = (i - 1) * 64
    if kind ~= "glass" or i < 3 then
      fields[i] = celspan.rect { x, 0, x + 64, 128, texture = celspan.rgb(colour) }
    end
  end
  for i = 1, kind == "confetti" and 800 or 0 do
    local x, y = i * 37 % 250, (i * 91 + f.index * 7) % 122
    fields[#fields + 1] = celspan.rect { x, y, x + 5, y + 5,
      texture = celspan.rgb(i % 7 / 7, i * f.index % 5 / 5, i % 3 / 3) }
  end
  fields[#fields + 1] = celspan.rect { 0, 0, 4 * f.index, 8, texture = celspan.rgb "#fff" }
  return celspan.rostrum { celspan.cel(fields) }
end }
]]
local COLOURS = { { 0x28, 0x50, 0x6e }, { 0x5a, 0x6e, 0x46 }, { 160, 160, 160 },
  { 0xc8, 0xb4, 0xbe } }

--- A WAV file of one channel with these samples of 16 bits, 48000 a second.
local function wave(samples)
  return ("<c4I4c4c4I4I2I2I4I4I2I2c4I4"):pack("RIFF", 36 + #samples, "WAVE", "fmt ", 16, 1, 1,
    48000, 96000, 2, 16, "data", #samples) .. samples
end

describe("a delivery", function()
  local bench

  before_each(function()
    bench = workbench.new()
    bench:write("film.lua", FILM)
  end)
  after_each(function() bench:remove() end)

  local function celspan(arguments, ...) return rendering.run(bench, arguments, ...) end
  local function render(arguments, ...) return rendering.done(bench, arguments, ...) end
  local function refused(arguments, words) rendering.refused(bench, 2, words, arguments) end
  local function stream(name) return movies.stream(bench, name) end
  --- The pixels of a frame from 0, as RGBA of 8 or 16 bits.
  local function pixels(name, frame, width, height, bits)
    local is_vp9 = name:find "webm$" and stream(name).codec_name == "vp9"
    local all = movies.pixels(bench, name, bits == 16 and "rgba64le" or "rgba",
      is_vp9 and "-c:v libvpx-vp9" or "", "-vf scale=flags=accurate_rnd+full_chroma_int")
    local size = width * height * (bits or 8) // 2
    return all:sub(frame * size + 1, (frame + 1) * size)
  end
  --- The greatest difference between a field's colour and the middle of the field in a picture.
  local function worst_field(bytes, count)
    local worst = 0
    for i = 1, count do
      local at = (64 * 256 + (i - 1) * 64 + 32) * 4
      for c = 1, 3 do worst = math.max(worst, math.abs(bytes:byte(at + c) - COLOURS[i][c])) end
    end
    return worst
  end

  local CODECS = { -- file, --codec, what ffprobe calls them, and their pixels
    { "mp4", "h264", "h264", "yuv420p" }, { "mp4", "h265", "hevc", "yuv420p" },
    { "mp4", "av1", "av1", "yuv420p" }, { "mkv", "h265", "hevc", "yuv444p" },
    { "mkv", "av1", "av1", "yuv444p" }, { "mkv", "vp9", "vp9", "yuv420p" },
    { "mov", "prores", "prores", "yuva444p12le" }, { "mov", "prores422", "prores", "yuv422p10le" },
    { "mov", "prores422hq", "prores", "yuv422p10le" }, { "mov", "dnxhr", "dnxhd", "yuv422p10le" },
    { "mov", "h264", "h264", "yuv420p" }, { "mov", "h265", "hevc", "yuv420p" },
    { "mkv", "h264", "h264", "yuv444p" }, { "webm", "vp9", "vp9", "yuv420p" },
    { "webm", "av1", "av1", "yuv420p" },
  }
  for _, case in ipairs(CODECS) do
    local ending, codec, name, layout = table.unpack(case)
    it_reads(("of %s in %s has its frames and its colours"):format(codec, ending), function()
      render("-o out.%s --codec %s --quality 90", ending, codec)
      local found = stream("out." .. ending)
      assert.same({ name, layout, "12" }, { found.codec_name, found.pix_fmt, found.nb_read_frames })
      assert.is_true(worst_field(pixels("out." .. ending, 5, 256, 128), 4) <= 3)
    end)
  end

  it_reads("of ffv1 has the very pixels of the frames, with their alpha", function()
    for _, kind in ipairs { "", "glass" } do
      for bits, layout in pairs { [8] = "bgra", [16] = "gbrap16le" } do
        render("-o out.mkv --codec ffv1 --no-dither --depth %d -- %s", bits, kind)
        assert.equal(layout, stream("out.mkv").pix_fmt)
        render("-o out.png --frames 6 --depth %d -- %s", bits, kind)
        local same = pixels("out.png", 0, 256, 128, bits) == pixels("out.mkv", 5, 256, 128, bits)
        assert.is_true(same, kind .. bits)
      end
    end
    render "-o out.mkv --codec ffv1 --background '#000'"
    assert.equal("bgr0", stream("out.mkv").pix_fmt)
  end)

  it_reads("has ten bits with --depth 16", function()
    for _, case in ipairs { { "mp4", "h265" }, { "mp4", "av1" }, { "webm", "av1" } } do
      render("-o out.%s --codec %s --depth 16 --frames 1-3", case[1], case[2])
      assert.equal("yuv420p10le", stream("out." .. case[1]).pix_fmt)
    end
  end)

  it_reads("is as --crf says, and is made again with --resume for another", function()
    local sizes = {}
    for i, crf in ipairs { 4, 40 } do
      render("-o out.mp4 --resume --crf %d -- confetti", crf)
      sizes[i] = #bench:read "out.mp4"
    end
    assert.is_true(sizes[1] > sizes[2], sizes[1] .. " " .. sizes[2])
    render "-o out.mp4 --resume --crf 40 --codec h265 -- confetti"
    assert.equal("hevc", stream("out.mp4").codec_name)
  end)

  --- The frame of the film that is seen in each frame of a video, by the bar that grows.
  local function frames_seen(name, width)
    local count, seen = tonumber(stream(name).nb_read_frames), {}
    for i = 0, count - 1 do
      local row, bright = pixels(name, i, width, 128):sub(1 + 4 * width, 8 * width), 0
      for x = 0, width - 1 do
        if row:byte(4 * x + 1) > 250 and row:byte(4 * x + 3) > 250 then bright = bright + 1 end
      end
      seen[i + 1] = bright // 4 + 1
    end
    return seen
  end

  it_reads("has another rate with --fps, the same length, and the sound of the film", function()
    render "-o out.mkv --codec ffv1 --no-dither --fps 12"
    assert.same({ 1, 3, 5, 7, 9, 11 }, frames_seen("out.mkv", 256))
    render "-o out.mkv --codec ffv1 --no-dither --fps 48 --frames 3-5"
    assert.same({ 3, 3, 4, 4, 5, 5 }, frames_seen("out.mkv", 256))
    render "-o out.mkv --codec ffv1 --no-dither --fps 30"
    assert.same({ 1, 1, 2, 3, 4, 5, 5, 6, 7, 8, 9, 9, 10, 11, 12 }, frames_seen("out.mkv", 256))
    bench:write("film.lua", (FILM:gsub("fps = 24", "%0, sound = 'tone.wav'")))
    local samples = string.rep(string.pack("<i2i2", 8000, -8000), 24000)
    bench:write("tone.wav", wave(samples))
    render "-o out.mkv --fps 30000/1001 --resume"
    local _, out = bench:inside("ffprobe -v error -show_entries "
      .. "stream=codec_type,r_frame_rate:format=duration -of csv=p=0 out.mkv")
    assert.truthy(out:find("video,30000/1001", 1, true), out)
    assert.truthy(out:find("audio", 1, true), out)
    assert.is_true(math.abs(tonumber(out:match "\n(%d+%.%d+)") - 0.5) < 0.02, out)
    local _, _, err = celspan "-o out.mkv --fps 12 --resume"
    assert.falsy(err:find("kept", 1, true), err)
    assert.equal("6", stream("out.mkv").nb_read_frames)
  end)

  it_reads("has at most --max-size bytes, and most of them where it can fill them", function()
    bench:write("film.lua", (FILM:gsub("fps = 24", "%0, sound = 'tone.wav'")))
    local samples = string.rep(string.pack("<i2i2", 8000, -8000), 12000)
    bench:write("tone.wav", wave(samples))
    for _, case in ipairs { { "mp4", "h264", 40 }, { "mp4", "h265", 30 }, { "webm", "vp9", 40 } } do
      local ending, codec, most = table.unpack(case)
      render("-o out.%s --codec %s --max-size %dk -- confetti", ending, codec, most)
      local bytes = #bench:read("out." .. ending)
      assert.is_true(bytes <= most * 1000 and bytes >= most * 850, codec .. bytes)
      local code, out = bench:inside("ffprobe -v error -count_frames -show_entries "
        .. "stream=codec_type,nb_read_frames,r_frame_rate -of csv=p=0 out." .. ending)
      assert.equal(0, code)
      assert.truthy(out:find("video,24/1,12", 1, true) and out:find("audio", 1, true), out)
    end
    for _, name in ipairs(bench:files(".", true)) do assert.falsy(name:find "%.part$", name) end
    render "-o out.mp4 --max-size 1G"
    local code, _, err = celspan "-o none.mp4 --max-size 10k --size 1024x512 -- confetti"
    assert.equal(5, code, err)
    assert.truthy(err:find "none.mp4: has %d+ bytes at the lowest quality, and may have 1", err)
    assert.is_nil(bench:read "none.mp4")
  end)

  --- Clouds with grain, of which a whole step of the factor changes the size by a fifth and more.
  local NOISE = [[
local celspan = require "celspan"
return celspan.film { size = { %d, %d }, fps = 24, frames = %d, grain = { amount = .02 },
  frame = function(f)
    local sky = celspan.noise { kind = "fractal", size = %d, octaves = 5, at = f.index / 12,
      colours = { "#123", "#fc8" } }
    return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, %d, %d, texture = sky } } }
  end }
]]
  local function filled(film, codec, most)
    bench:write("film.lua", film)
    render("-o out.mp4 --codec %s --max-size %d", codec, most)
    local bytes = #bench:read "out.mp4"
    assert.is_true(bytes <= most and bytes >= 0.85 * most, codec .. bytes)
  end
  it_reads("fills --max-size with noise, too", function()
    -- A whole step is 29025 or 23840 bytes of H.264, of which neither fills the limit of 28900.
    for _, case in ipairs { { "h264", 12000 }, { "h264", 28900 }, { "h265", 12000 } } do
      filled(NOISE:format(320, 180, 12, 40, 320, 180), case[1], case[2])
    end
  end)
  if HAS_ALL then
    it_reads("fills 2 MB with noise of 1080 lines #full", function()
      filled(NOISE:format(1920, 1080, 96, 240, 1920, 1080), "h264", 2e6)
    end)
  end

  --- Puts a program called ffmpeg first in PATH, which adds a line to the file `calls` and runs
  --- ffmpeg. Returns the setting of PATH.
  local function counted()
    local _, where = bench:shell "command -v ffmpeg"
    assert(os.execute(("mkdir -p '%s/bin'"):format(bench.folder)))
    bench:write("bin/ffmpeg", ("#!/bin/sh\necho >>'%s/calls'\nexec %s \"$@\"\n"):format(
      bench.folder, where:match "%S+"))
    assert(os.execute(("chmod +x '%s/bin/ffmpeg'"):format(bench.folder)))
    return ("PATH='%s/bin:%s'"):format(bench.folder, os.getenv "PATH")
  end

  it_reads("is found in a few tries where most bytes do not depend on the quality", function()
    bench:write("film.lua", (FILM:gsub("frames = 12", "frames = 900"):gsub("4 %* f.index", "9")))
    render "-o least.mp4 --crf 48"
    local path = counted()
    local code, _, err = bench:inside(("%s '%s' render film.lua --progress none -o out.mp4 "
      .. "--max-size %d"):format(path, workbench.absolute, #bench:read "least.mp4"))
    assert.equal(0, code, err)
    assert.is_true(#bench:read "calls" <= 11, #bench:read "calls")
    assert.is_true(#bench:read "out.mp4" <= #bench:read "least.mp4")
  end)

  it_reads("has the marks of the film as chapters", function()
    bench:write("film.lua", (FILM:gsub("fps = 24",
      "%0, marks = { ['Opening; a = b'] = 1, ['Caf\xc3\xa9'] = 5, End = 11 }")))
    for _, ending in ipairs { "mp4", "mkv", "mov", "webm" } do
      render("-o out.%s --frames 3-12 --fps 12", ending)
      local code, out, err = bench:inside("ffprobe -v error -show_chapters -of compact=nk=0 out."
        .. ending)
      assert.equal(0, code, err)
      local found = {}
      local line = "start_time=(%S-)|end=%d+|end_time=(%S-)|tag:title=([^\n]*)"
      for from, to, name in out:gmatch(line) do
        found[#found + 1] = ("%.3f %.3f %s"):format(from, to, name)
      end
      assert.same({ "0.000 0.083 Opening; a = b", "0.083 0.333 Caf\xc3\xa9", "0.333 0.417 End" },
        found)
    end
    render "-o out.gif"
    render "-o out.mp4 --frames 12-1:-1"
    assert.equal("12", stream("out.mp4").nb_read_frames)
  end)

  --- The captions that a video has, as SubRip without numbers.
  local function captions_of(name)
    local code, out, err = bench:inside("ffmpeg -v error -i " .. name .. " -map 0:s -f srt -")
    assert.equal(0, code, err)
    return (out:gsub("\r", ""):gsub("^%d+\n", ""):gsub("\n%d+\n", "\n"):gsub("%s+$", ""))
  end

  it_reads("has the captions of the film as subtitles", function()
    bench:write("said.vtt", "WEBVTT\n\n00:00.000 --> 00:00.200\n<i>Good</i> day\n\n"
      .. "00:00.250 --> 00:09.000\n<v Ann>Caf\xc3\xa9 &amp; more:\nso = 1; # \\\n")
    bench:write("film.lua", (FILM:gsub("fps = 24", "%0, captions = 'said.vtt', marks = { a = 1 }")))
    local kinds = { mp4 = "mov_text", mov = "mov_text", mkv = "subrip", webm = "webvtt" }
    for ending, kind in pairs(kinds) do
      render("-o out.%s", ending)
      local _, out = bench:inside("ffprobe -v error -select_streams s -show_entries "
        .. "stream=codec_name -of csv=p=0 out." .. ending)
      assert.equal(kind, out:match "[%w_]+", out)
      local text = captions_of("out." .. ending)
      assert.truthy(text:find("^00:00:00,000 %-%-> 00:00:00,200\nGood day"), text)
      assert.truthy(text:find("00:00:00,250 --> 00:00:00,500\nCaf\xc3\xa9 & more:\nso = 1; # \\", 1,
        true), text)
      assert.equal("12", stream("out." .. ending).nb_read_frames)
    end
    for _, name in ipairs(bench:files()) do assert.falsy(name:find "%.part$", name) end
    render "-o part.mp4 --frames 4-6 --max-size 50k"
    local text = captions_of "part.mp4"
    assert.truthy(text:find("^00:00:00,000 %-%-> 00:00:00,075\nGood day"), text)
    assert.is_nil(text:find("more", 1, true))
    local _, _, err = celspan "-o out.gif"
    assert.truthy(err:find("out.gif: gif holds no captions: they are left out", 1, true), err)
    _, _, err = celspan "-o part.mp4 --frames 1-12:2"
    assert.truthy(err:find("part.mp4: its captions are left out, because they go with one run", 1,
      true), err)
  end)

  --- The bytes of the captions in a video, as in a list of packets.
  local function cues_of(name)
    local code, out, err = bench:inside("ffprobe -v error -select_streams s -show_packets "
      .. "-show_data -show_entries packet=data " .. name)
    assert.equal(0, code, err)
    local bytes = {}
    for line in out:gmatch "\n%x+: (.-)  " do
      bytes[#bytes + 1] = line:gsub(" ", ""):gsub("%x%x",
        function(two) return string.char(tonumber(two, 16)) end)
    end
    return (table.concat(bytes):gsub("\r", ""))
  end

  it_reads("has captions whose signs are no markup", function()
    local text = "<Ann> a <b>c</b> &lt; &nbsp;& {\\x} {y:1} C:\\new <3\n"
      .. "00:01:00,000 --> 00:02:00,000"
    bench:write("film.lua", (FILM:gsub("fps = 24", function(fps)
      return ("%s, captions = { { from = 0, to = 1, text = %q } }"):format(fps, text)
    end)))
    local coded = text:gsub("[&<>]", { ["&"] = "&amp;", ["<"] = "&lt;", [">"] = "&gt;" })
    for _, ending in ipairs { "mp4", "mov", "mkv", "webm" } do
      render("-o out.%s", ending)
      local found = cues_of("out." .. ending):gsub("\u{2060}", "")
      assert.truthy(found:find(ending == "webm" and coded or text, 1, true), ending .. found)
      local back = captions_of("out." .. ending):gsub("\u{2060}", "")
      assert.truthy(ending == "webm" or back:find("^00:00:00,000 %-%-> 00:00:00,500\n"), back)
      assert.equal(text, ending == "webm" and text or back:match "\n(.*)", ending)
    end
  end)

  it_reads("has captions of a script, and is made again with --resume for others", function()
    local function with(list)
      bench:write("film.lua", (FILM:gsub("fps = 24", "%0, captions = " .. list:gsub("%%", "%%%%"))))
      return celspan "-o out.mkv --resume"
    end
    assert.equal(0, (with "{ { from = 0, to = 1, text = 'one\\n\\n \\ntwo' } }"))
    assert.equal("00:00:00,000 --> 00:00:00,500\none\ntwo", captions_of "out.mkv")
    assert.equal(0, (with "{ { from = 0, to = .3, text = 'other' } }"))
    assert.equal("00:00:00,000 --> 00:00:00,300\nother", captions_of "out.mkv")
    local overlaps = "{ { from = -1, to = .3, text = 'a' }, { from = 0.1, to = 9, text = 'c' }, "
      .. "{ from = -2, to = .3, text = 'b' } }"
    assert.equal(0, (with(overlaps)))
    celspan "-o out.mp4"
    for _, ending in ipairs { "mkv", "mp4" } do
      assert.equal("00:00:00,000 --> 00:00:00,100\na\nb\n\n00:00:00,100 --> 00:00:00,300\na\nb\nc"
        .. "\n\n00:00:00,300 --> 00:00:00,500\nc", captions_of("out." .. ending))
    end
    os.remove(bench.folder .. "/out.mkv")
    for list, words in pairs {
      ["{ { from = 0, text = 'a' } }"] = "film: captions: caption 1 must be { from = seconds",
      ["{ { from = 0, to = 0 / 0, text = 'a' } }"] = "caption 1 must be",
      ["{ { from = 0, to = 1, text = '\\xff' } }"] = "caption 1 must be",
      ["{ { from = 1, to = 1, text = 'a' } }"] = "caption 1 ends before it begins",
      ["'none.srt'"] = "none.srt",
      ["'film.lua'"] = "film.lua: line 1",
      ["7"] = "field 'captions' must be the name of a file, or captions as celspan.captions",
    } do
      local code, _, err = with(list)
      assert.equal(3, code, err)
      assert.truthy(err:find(words, 1, true), err)
      assert.is_nil(bench:read "out.mkv")
    end
  end)

  it_reads("has the poster of the film as an attached picture in mp4, and beside others", function()
    local function with(poster, more)
      bench:write("film.lua", (FILM:gsub("fps = 24", ("%%0, poster = %s%s"):format(poster,
        more or ""))))
    end
    bench:write("said.srt", "1\n00:00:00,000 --> 00:00:00,400\nhello\n")
    bench:write("tone.wav", wave(string.rep(string.pack("<i2i2", 8000, -8000), 12000)))
    render "-o poster.png --frames 8 -- glass"
    local expected = pixels("poster.png", 0, 256, 128)
    with("8", ", marks = { a = 1 }, captions = 'said.srt', sound = 'tone.wav'")
    for i, options in ipairs { "", "--codec h265", "--codec av1", "--max-size 80k" } do
      render("-o out.mp4 --frames 1-6 %s -- glass", options)
      local _, out = bench:inside("ffprobe -v error -show_entries "
        .. "stream=codec_type:stream_disposition=attached_pic -of csv=p=0 out.mp4")
      assert.truthy(out:find "^video,0\naudio,0\nsubtitle,0\n" and out:find "\nvideo,1", out)
      bench:inside "ffmpeg -v error -y -i out.mp4 -map 0:v:1 -c copy attached.png"
      assert.is_true(pixels("attached.png", 0, 256, 128) == expected, options)
      assert.is_true(i < 4 or #bench:read "out.mp4" <= 80000)
      assert.equal("00:00:00,000 --> 00:00:00,250\nhello", captions_of "out.mp4")
    end
    for _, name in ipairs(bench:files()) do assert.falsy(name:find "%.part$", name) end
    for _, ending in ipairs { "mov", "mkv", "webm" } do
      render("-o film.%s --resume -- glass", ending)
      assert.is_true(pixels("film.poster.png", 0, 256, 128) == expected)
      os.remove(bench.folder .. "/film.poster.png")
    end
    render "-o film.webm --resume -- glass"
    assert.is_true(pixels("film.poster.png", 0, 256, 128) == expected)
    local _, _, err = bench:celspan_inside("render film.lua -o film.webm --resume "
      .. "--progress lines -- glass")
    assert.truthy(err:find("kept", 1, true), err)
    with "4"
    render "-o film.webm --resume -- glass"
    assert.is_true(pixels("film.poster.png", 0, 256, 128) ~= expected)
    os.remove(bench.folder .. "/film.poster.png")
    render "-o film.gif"
    assert.is_nil(bench:read "film.poster.png")
    bench:write("film.lua", FILM)
    render "-o film.webm"
    assert.is_nil(bench:read "film.poster.png")
    with "5"
    bench:write("film.lua", (bench:read "film.lua":gsub("local fields = {}",
      "if f.number == 5 then error 'no' end %0")))
    for _, ending in ipairs { "mp4", "webm" } do
      local code, _, message = celspan("-o bad.%s --frames 1-3", ending)
      assert.equal(3, code)
      assert.truthy(message:find("frame 5", 1, true), message)
    end
    assert.is_nil(bench:read "bad.mp4" or bench:read "bad.poster.png")
  end)

  it_reads("is as loud as --loudness says, by EBU R 128", function()
    local samples = {}
    for i = 1, 4 * 48000 do
      local loud = i < 48000 and 8 or i < 96000 and 400 or 4000 -- the quiet part does not count
      samples[i] = ("<i2"):pack(math.floor((math.sin(i * .05) + math.sin(i * .31)) * loud))
    end
    bench:write("tone.wav", wave(table.concat(samples)))
    bench:write("film.lua", (FILM:gsub("frames = 12", "sound = 'tone.wav', frames = 96")))
    local function loudness(name)
      local code, _, err = bench:inside("ffmpeg -nostats -i " .. name
        .. " -af ebur128=framelog=verbose -f null -")
      assert.equal(0, code, err)
      return tonumber(err:match ".*I:%s+(-?[%d.]+) LUFS"), err
    end
    for _, lufs in ipairs { -14, -23.5, -30 } do
      for _, ending in ipairs { "mkv", "mp4", "webm" } do
        render("-o out.%s --loudness %g --frames 1-96", ending, lufs)
        local found, words = loudness("out." .. ending)
        assert.is_true(math.abs(found - lufs) <= 0.5, ending .. found .. words)
      end
      local code, _, err = bench:celspan_inside("sound film.lua -o out.wav --loudness %g", lufs)
      assert.equal(0, code, err)
      assert.is_true(math.abs(loudness "out.wav" - lufs) <= 0.1, loudness "out.wav")
    end
    local _, _, err = celspan "-o out.mkv --loudness 0"
    assert.truthy(err:find("film.lua: with %-%-loudness 0 the sound is up to %d+%.%d dB "
      .. "louder"), err)
    bench:write("tone.wav", wave(string.rep("\0", 8000)))
    _, _, err = celspan "-o out.mkv --loudness -14"
    assert.truthy(err:find("film.lua: the sound is silent", 1, true), err)
    bench:write("film.lua", FILM)
    refused("-o bad.mp4 --loudness -14", "the film has no sound: leave --loudness out")
    refused("-o bad.mp4 --loudness 3", "LUFS from -60 to 0, such as -14 or -23")
    refused("-o bad.#.png --loudness -14", "png takes no --loudness")
  end)

  --- The samples of a WAV file of floats.
  local function samples_of(name)
    local bytes, list = assert(bench:read(name), name), {}
    local at = assert(bytes:find("data", 1, true)) + 8
    for place = at, #bytes - 3, 4 do list[#list + 1] = string.unpack("<f", bytes, place) end
    return list
  end

  it_reads("has stems by the names of its sounds, which add up to its sound", function()
    bench:write("tone.wav", wave(string.rep(string.pack("<i2i2", 8000, -8000), 12000)))
    bench:write("low.wav", wave(string.rep(string.pack("<i2i2i2i2", 900, 700, -600, -900), 6000)))
    bench:write("film.lua", [[
local celspan, cut = require "celspan", require "celspan.cut"
local function film(sound)
  return celspan.film { size = { 8, 8 }, fps = 24, frames = 12, sound = sound,
    frame = function() return celspan.rostrum {} end }
end
local shot = film { { "tone.wav", at = 0.2, gain = 0.7, name = "voice" }, { "low.wav", pan = 0.5 },
  { "low.wav", name = "music", duck = "voice", gain = 2 } }
return ({ shot = shot, cut = cut { shot, { film = shot, name = "b" }, shot } })[...] ]])
    for kind, names in pairs { shot = { "music", "rest", "voice" },
                               cut = { "b", "music", "rest", "voice" } } do
      for _, more in ipairs { "", "--loudness -20" } do
        local function sound(arguments)
          local code, _, err = bench:celspan_inside("sound film.lua --depth float %s %s -- %s",
            arguments, more, kind)
          assert.equal(0, code, err)
        end
        sound "-o whole.wav"
        sound "--stems -o 's/mix.{name}.wav'"
        local files = bench:files "s"
        local sum, whole = {}, samples_of "whole.wav"
        for i, name in ipairs(names) do
          assert.equal(("mix.%s.wav"):format(name), files[i])
          local loudest = 0
          for k, value in ipairs(samples_of("s/" .. files[i])) do
            sum[k], loudest = (sum[k] or 0) + value, math.max(loudest, math.abs(value))
          end
          assert.is_true(loudest > 0.01, name)
        end
        assert.equal(#names, #files)
        for k = 1, #whole do assert.is_true(math.abs(whole[k] - sum[k]) < 1e-6) end
        os.execute(("rm -r '%s/s'"):format(bench.folder))
      end
    end
    for arguments, words in pairs {
      ["--stems -o mix.wav"] = "put {name} into the name, as in mix.{name}.wav",
      ["--stems --resume -o '{name}.wav'"] = "--stems and --resume exclude each other",
    } do
      local code, _, err = bench:celspan_inside("sound film.lua " .. arguments .. " -- shot")
      assert.equal(2, code)
      assert.truthy(err:find(words, 1, true), err)
    end
    bench:write("rows.csv", "kind\nshot\ncut\n")
    bench:write("both.lua", 'local kind = require "celspan".parameters { kind = "shot" }.kind\n'
      .. bench:read "film.lua":gsub("%[%.%.%.%]", "[kind]"))
    local good, _, fault = bench:celspan_inside("sound both.lua --table rows.csv --stems "
      .. "-o 's/{kind}.{name}.wav'")
    assert.equal(0, good, fault)
    assert.same({ "cut.b.wav", "cut.music.wav", "cut.rest.wav", "cut.voice.wav", "shot.music.wav",
      "shot.rest.wav", "shot.voice.wav" }, bench:files "s")
    bench:write("tone.wav", wave(("\0"):rep(48000)))
    bench:write("low.wav", wave(("\0"):rep(48000)))
    local _, _, told = bench:celspan_inside("sound film.lua -o 's/{name}.wav' --stems "
      .. "--loudness -20 -- shot")
    assert.equal(1, select(2, told:gsub("the sound is silent", "")), told) -- it is heard once
    bench:write("film.lua", (FILM:gsub("fps = 24", "%0, sound = { 'tone.wav', name = 'a/b' }")))
    local code, _, err = bench:celspan_inside "sound film.lua --stems -o '{name}.wav'"
    assert.truthy(code == 2 and err:find("the sound 'a/b' needs a name without /", 1, true), err)
  end)

  it_reads("leaves nothing where its first or second pass has no room", function()
    for most, options in pairs { [40] = "-o out.mp4 --max-size 100k", [20] = "-o out.gif" } do
      local code, _, err = bench:inside(("ulimit -f %d; '%s' render film.lua --progress none "
        .. "%s -- confetti"):format(most, workbench.absolute, options))
      assert.equal(5, code, err)
      assert.truthy(err:find(": ffmpeg ", 1, true) or err:find("not made", 1, true), err)
      for _, name in ipairs(bench:files()) do assert.falsy(name:find "^%.?out", name) end
    end
  end)

  --- The sizes of all palettes of a GIF, and the number of its frames.
  local function palettes_of(bytes)
    local list, at, frames = {}, 14, 0
    local function skip_table(flags)
      if flags & 0x80 == 0 then return end
      local size = 3 << (flags & 7) + 1
      list[#list + 1], at = size, at + size
    end
    local function skip_blocks()
      while bytes:byte(at) > 0 do at = at + bytes:byte(at) + 1 end
      at = at + 1
    end
    skip_table(bytes:byte(11))
    while bytes:byte(at) ~= 0x3b do
      if bytes:byte(at) == 0x21 then
        at = at + 2
      else
        frames, at = frames + 1, at + 10
        skip_table(bytes:byte(at - 1))
        at = at + 1
      end
      skip_blocks()
    end
    return list, frames
  end

  it_reads("has one palette in a GIF, of the colours of all its frames", function()
    for _, kind in ipairs { "confetti", "glass" } do
      render("-o out.gif -- %s", kind)
      local palettes, frames = palettes_of(bench:read "out.gif")
      assert.equal(12, frames)
      assert.is_true(#palettes <= 2, #palettes) -- of the file, and of its first frame
      assert.is_true(worst_field(pixels("out.gif", 5, 256, 128), kind == "glass" and 2 or 0) <= 3)
    end
    assert.equal(0, pixels("out.gif", 11, 256, 128):byte(-1))
    for _, name in ipairs(bench:files()) do assert.falsy(name:find "%.part$", name) end
  end)

  it_reads("contains the film between bars, or is covered by it, with --fit", function()
    render "-o whole.mkv --codec ffv1 --no-dither --frames 4"
    local whole = pixels("whole.mkv", 0, 256, 128)
    for _, workers in ipairs { 1, 3 } do
      render("-o out.mkv --codec ffv1 --no-dither --frames 4 --size 256x300 --fit contain "
        .. "--workers %d", workers)
      local bars = string.rep("\0", 256 * 86 * 4)
      assert.is_true(pixels("out.mkv", 0, 256, 300) == bars .. whole .. bars)
      render("-o out.mkv --codec ffv1 --no-dither --frames 4 --size 300x128 --fit contain "
        .. "--workers %d", workers)
      local rows = {}
      for y = 0, 127 do
        local bar = string.rep("\0", 22 * 4)
        rows[y + 1] = bar .. whole:sub(y * 1024 + 1, y * 1024 + 1024) .. bar
      end
      assert.is_true(pixels("out.mkv", 0, 300, 128) == table.concat(rows))
      render("-o out.mkv --codec ffv1 --no-dither --frames 4 --size 128x128 --fit cover "
        .. "--workers %d", workers)
      for y = 0, 127 do rows[y + 1] = whole:sub(y * 1024 + 257, y * 1024 + 768) end
      assert.is_true(pixels("out.mkv", 0, 128, 128) == table.concat(rows))
    end
    render "-o out.mp4 --size 256x300 --fit contain --frames 4 --background '#fff'"
    assert.equal("\0\0\0\xff", pixels("out.mp4", 0, 256, 300):sub(1, 4))
    refused("-o bad.mp4 --size 64x64 --fit contain --crop 1,1,4,4", "--fit makes whole frames")
    refused("-o bad.mp4 --size 64x1048576 --fit cover",
      "--fit cover: the film would have more than 1048576 pixels a side")
    refused("-o bad.mp4 --fit cover", "--fit is for a --size of another shape")
    refused("-o bad.mp4 --scale 2 --fit stretch", "--fit is for a --size of another shape")
  end)

  local function convert(arguments)
    local code, _, err = bench:celspan_inside("convert " .. arguments .. " --progress none")
    assert.equal(0, code, err)
  end

  --- Writes the frames f/f.0001.png to 12, and film.lua with a sound of half a second.
  local function write_frames()
    bench:write("film.lua", (FILM:gsub("fps = 24", "%0, sound = 'tone.wav'")))
    bench:write("tone.wav", wave(string.rep(string.pack("<i2i2", 8000, -8000), 12000)))
    assert(os.execute(("mkdir -p '%s/f'"):format(bench.folder)))
    render "-o f/f.####.png -- glass"
  end

  it_reads("is made of frames that are there, with the sound of a film", function()
    write_frames()
    convert "'f/f.####.png' out.mkv --codec ffv1 --fps 12 --sound film.lua"
    assert.equal("ffv1", stream("out.mkv").codec_name)
    for i = 0, 11 do
      local name = ("f/f.%04d.png"):format(i + 1)
      assert.is_true(pixels(name, 0, 256, 128) == pixels("out.mkv", i, 256, 128), name)
    end
    local _, out = bench:inside("ffprobe -v error -show_entries "
      .. "stream=codec_type,r_frame_rate:format=duration -of csv=p=0 out.mkv")
    assert.truthy(out:find("video,12/1", 1, true) and out:find("audio", 1, true), out)
    assert.is_true(math.abs(tonumber(out:match "\n(%d+%.%d+)") - 1) < 0.02, out)
    local code, told, err = bench:celspan_inside "info 'f/f.####.png' --json"
    assert.equal(0, code, err)
    assert.truthy(told:find('"frames": 12', 1, true), told)
    code, _, err = bench:celspan_inside "render 'f/f.####.png' --set fps=6 -o slow.gif"
    assert.equal(0, code, err)
    local long = ("n"):rep(246) .. ".mkv" -- the sound's own name is longer
    convert(("'f/f.####.png' %s --codec ffv1 --fps 12 --sound film.lua"):format(long))
  end)

  it_reads("takes the sound of a script that is trusted, and leaves no sound behind", function()
    write_frames()
    assert(os.execute(("mkdir '%s/show'"):format(bench.folder)))
    bench:write("show/film.lua", (FILM:gsub("fps = 24", "%0, sound = '../tone.wav'")))
    local code, _, err = bench:celspan_inside "convert 'f/f.####.png' a.mkv --sound show/film.lua"
    assert.is_true(code > 0, err)
    assert.is_nil(bench:read "a.mkv")
    convert "'f/f.####.png' out.mkv --fps 12 --sound show/film.lua --trust"
    local _, sounds = bench:inside("ffprobe -v error -show_entries stream=codec_name -of csv "
      .. "out.mkv")
    assert.truthy(sounds:find "flac", sounds)
    for _, name in ipairs(bench:files()) do assert.falsy(name:find "sound", name) end
  end)

  it_reads("is made of a movie, also with --trust", function()
    write_frames()
    convert "'f/f.####.png' out.mkv --codec ffv1 --sound tone.wav"
    convert "out.mkv again.mkv --codec ffv1 --size 128x64 --trust"
    assert.equal("12", stream("again.mkv").nb_read_frames)
    local _, sounds = bench:inside("ffprobe -v error -show_entries stream=codec_name -of csv "
      .. "again.mkv")
    assert.truthy(sounds:find "flac", sounds)
    convert "out.mkv one.png --frame 7"
    assert.is_true(pixels("one.png", 0, 256, 128) == pixels("out.mkv", 6, 256, 128))
    for _, command in ipairs { "contact out.mkv -o sheet.png", "check out.mkv" } do
      local code, _, err = bench:celspan_inside(command)
      assert.equal(0, code, err)
    end
    bench:write("short.mkv", bench:read "out.mkv":sub(1, 700))
    local code, _, err = bench:celspan_inside "render short.mkv -o bad.mp4"
    assert.is_true(code > 0 and err:find("short.mkv", 1, true) ~= nil, err)
  end)

  it_reads("is not made of frames that are missing, or of one picture", function()
    write_frames()
    convert "'f/f.####.png' out.mkv"
    assert.equal(0, (bench:celspan_inside "convert f/f.0007.png one.png"))
    assert.is_true(os.remove(bench.folder .. "/f/f.0003.png"))
    for i = 9, 10 do os.remove(("%s/f/f.%04d.png"):format(bench.folder, i)) end
    for command, words in pairs {
      ["'f/f.####.png' bad.mp4"] = "f.####.png: 3 files are missing: 3, 9-10",
      ["'g/f.####.png' bad.mp4"] = "g/f.####.png: No such file",
      ["'f/g.####.png' bad.mp4"] = "g.####.png: there are no such files",
      ["out.mkv bad.mkv --fps 3"] = "--fps is the rate of numbered pictures",
      ["one.png bad.png --sound film.lua"] = "--sound is for numbered pictures or a movie",
      ["one.png bad.png --max-size 1M"] = "--max-size is for numbered pictures or a movie",
      ["'f/f.####.png' 'f/f.####.png'"] = "would replace the pictures while they are read",
      ["out.mkv bad.png"] = "several frames (12) need a number",
      ["out.mkv bad.mkv --sound none.wav"] = "none.wav",
    } do
      local code, _, err = bench:celspan_inside("convert " .. command)
      local is_missing = words:find "files" or words:find "No such file"
      assert.equal(is_missing and 4 or code > 0 and code, code, err)
      assert.truthy(err:find(words, 1, true), err)
      assert.is_nil(bench:read "bad.mp4" or bench:read "bad.mkv" or bench:read "bad.png")
    end
  end)

  it_reads("has a limit of bytes with captions and a sound, also of each row of a table", function()
    bench:write("tone.wav", wave(string.rep(string.pack("<i2i2", 8000, -8000), 12000)))
    bench:write("said.srt", "1\n00:00:00,000 --> 00:00:00,400\nhello\n")
    bench:write("film.lua", 'require "celspan".parameters { tint = 1 }\n' .. FILM:gsub("fps = 24",
      "%0, sound = 'tone.wav', captions = 'said.srt'"))
    bench:write("rows.csv", "tint\n3\n4\n")
    render "--table rows.csv -o '{tint}.mkv' --max-size 60k"
    for _, name in ipairs { "3.mkv", "4.mkv" } do
      assert.is_true(#bench:read(name) <= 60000)
      local _, out = bench:inside("ffprobe -v error -show_entries stream=codec_type -of csv=p=0 "
        .. name)
      assert.equal("video\naudio\nsubtitle\n", out)
      assert.equal("00:00:00,000 --> 00:00:00,400\nhello", captions_of(name))
    end
  end)

  it("is refused with a codec that its file does not contain", function()
    refused("-o out.mp4 --codec prores", "out.mp4: --codec prores: mp4 contains h264, h265, av1")
    refused("-o out.gif --codec h264", "gif contains gif")
    refused("-o out.#.png --codec h264", "png takes no --codec")
    refused("-o out.#.png --fps 12", "png takes no --fps")
    refused("-o out.mp4 --fps 0", "frames per second from 0.01 to 1000")
    refused("-o out.mp4 --fps 30/0", "frames per second from 0.01 to 1000")
    refused("-o out.mp4 --max-size 8", "at least 10,000 bytes, such as 500k, 8M")
    refused("-o out.mp4 --max-size 8MM", "at least 10,000 bytes, such as 500k, 8M")
    refused("-o out.mp4 --max-size 10000kB", "at least 10,000 bytes, such as 500k, 8M")
    refused("-o out.gif --max-size 8000000", "leave it out, or write .mp4, .webm or .mkv")
    refused("-o out.mov --max-size 8000000", "leave it out, or give another --codec")
    refused("-o out.mov --codec h264 --size 255x128", "h264 needs an even width and height in mov: "
      .. "give --size 254x128, or write .webm or .mkv")
    refused("-o out.mkv --codec vp9 --depth 16", "vp9 holds 8 bits where it has alpha")
    refused("-o out.mp4 --max-size 8M --crf 20", "--max-size chooses the quality")
    refused("-o out.mov --max-size 8M", "--max-size is for h264, h265, av1 and vp9")
    refused("-o out.#.png --max-size 8M", "png takes no --max-size")
    refused("-o out.mp4 --crf 64", "a whole number from 0 to 63")
    refused("-o out.mp4 --crf 52", "--crf of h264 is a whole number from 0 to 51")
    refused("-o out.mov --crf 20", "prores has no --crf: leave it out, or give --quality")
    refused("-o out.mov --codec dnxhr --crf 20", "dnxhr has no --crf: leave it out")
    refused("-o out.mp4 --crf 20 --quality 20", "--crf and --quality exclude each other")
    refused("-o out.mov --codec dnxhr --size 254x120", "dnxhr needs at least 256 x 120")
    refused("-o out.mp4 --codec h265 --size 16x14", "h265 needs at least 16 x 16")
  end)
end)
