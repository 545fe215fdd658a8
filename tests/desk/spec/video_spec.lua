-- Videos: what ffmpeg reads back from them, and failures of ffmpeg. One list of cases: formats,
-- options, sound and failures.

local present = require "tests.support.present"
local rendering = require "tests.support.rendering"
local workbench = require "tests.support.workbench"

local has_ffmpeg = present.program("ffmpeg", "ffprobe")
local it_reads = has_ffmpeg and it or pending

local FIELD = 32
local ENDINGS = { "mp4", "mov", "webm", "mkv" }
-- Neighbours differ little: 4:2:0 gives one colour to four pixels, and readers blend it at edges.
local COLOURS = {
  { 40, 60, 80 }, { 90, 110, 70 }, { 130, 90, 110 }, { 160, 160, 160 },
  { 16, 20, 24 }, { 60, 80, 100 }, { 100, 120, 140 }, { 200, 180, 190 },
}

-- The chart, behind a dot that moves on twos.
local CHART = [[
local celspan = require "celspan"
local sound, offset = ...
local fields = {}
for i, c in ipairs { %s } do
  local x, y = (i - 1) %% 4 * 32, (i - 1) // 4 * 32
  fields[i] = celspan.rect { x, y, x + 32, y + 32,
    texture = celspan.rgb(("#%%02x%%02x%%02x"):format(c[1], c[2], c[3])) }
end
return celspan.film { size = { 128, 80 }, fps = 24, frames = 12, sound = sound,
  sound_offset = tonumber(offset), frame = function(f)
    local dot = celspan.circle { centre = { 20 + 4 * f:on(2), 72 }, radius = 6,
      texture = celspan.rgb(1, 0.5, 0) }
    return celspan.rostrum { celspan.cel(fields), celspan.cel { dot } }
  end }
]]

--- Half of the frame is a translucent red, the rest is clear.
local GLASS = [[
local celspan = require "celspan"
return celspan.film { size = { 32, 16 }, fps = 24, frames = 3, frame = function(f)
  return celspan.rostrum { celspan.cel {
    celspan.rect { 0, 0, 16, 16, texture = celspan.rgb(1, 0, 0, 0.5) },
    celspan.rect { 0, 0, 1 + f.index, 1, texture = celspan.rgb(0, 0, 1) } } }
end }
]]

local function chart_script()
  local list = {}
  for i, colour in ipairs(COLOURS) do list[i] = "{" .. table.concat(colour, ",") .. "}" end
  return CHART:format(table.concat(list, ", "))
end

--- A second of silence with a tone of a hundredth of a second in it, as a WAV file of 48,000
--- samples a second.
local function click(at)
  local samples = {}
  for i = 0, 47999 do
    local is_tone = i >= at * 48000 and i < (at + 0.01) * 48000
    samples[#samples + 1] = ("<i2"):pack(is_tone and (i // 24 % 2 * 2 - 1) * 20000 or 0)
  end
  local data = table.concat(samples)
  return ("<c4I4c4c4I4I2I2I4I4I2I2c4I4")
    :pack("RIFF", 36 + #data, "WAVE", "fmt ", 16, 1, 1, 48000, 96000, 2, 16,
    "data", #data) .. data
end

describe("a video", function()
  local bench

  before_each(function()
    bench = workbench.new()
    bench:write("film.lua", chart_script())
  end)
  after_each(function() bench:remove() end)

  local function run(command, ...) return bench:inside(command:format(...)) end
  local function celspan(arguments, ...) return rendering.run(bench, arguments, ...) end
  local function render(arguments, ...) return rendering.done(bench, arguments, ...) end
  local function probe(name, entries)
    local code, out, err =
      run("ffprobe -v error -select_streams v -count_frames -show_entries %s -of default=nw=1 %s",
      entries, name)
    assert.equal(0, code, err)
    local found = {}
    for key, value in out:gmatch "([%w_]+)=([^\n]*)" do found[key] = value end
    return found
  end
  --- The pixels of a frame from 0, as RGBA.
  local function pixels(name, frame, width, height)
    local decoder = name:find "webm$" and "-c:v libvpx-vp9" or ""
    local code, out, err =
      run("ffmpeg -v error %s -i %s -vf scale=flags=accurate_rnd+full_chroma_int "
      .. "-f rawvideo -pix_fmt rgba -", decoder, name)
    assert.equal(0, code, err)
    local size = width * height * 4
    return out:sub(frame * size + 1, (frame + 1) * size)
  end
  local function mean(bytes, width, x, y, side)
    local sums = { 0, 0, 0, 0 }
    for row = y, y + side - 1 do
      for column = x, x + side - 1 do
        local at = (row * width + column) * 4
        for i = 1, 4 do sums[i] = sums[i] + bytes:byte(at + i) end
      end
    end
    for i = 1, 4 do sums[i] = sums[i] / side ^ 2 end
    return sums
  end
  local function worst_field(name)
    local bytes, worst = pixels(name, 4, 128, 80), 0
    for i, colour in ipairs(COLOURS) do
      local found = mean(bytes, 128, (i - 1) % 4 * FIELD, (i - 1) // 4 * FIELD, FIELD)
      for channel = 1, 3 do worst = math.max(worst, math.abs(found[channel] - colour[channel])) end
    end
    return worst
  end
  --- The time, in seconds, at which the sound of a video becomes audible.
  local function onset(name)
    local code, out, err = run("ffmpeg -v error -i %s -f s16le -ac 1 -ar 48000 -", name)
    assert.equal(0, code, err)
    for i = 1, #out - 1, 2 do
      if math.abs((("<i2"):unpack(out, i))) > 4000 then return (i - 1) / 2 / 48000, #out / 96000 end
    end
    return nil, #out / 96000
  end
  --- A program called ffmpeg that comes first in PATH.
  local function fake(body)
    bench:write("bin-ffmpeg", "#!/bin/sh\n" .. body)
    assert(os.execute(("mkdir -p '%s/bin' && mv '%s/bin-ffmpeg' '%s/bin/ffmpeg' && chmod +x "
      .. "'%s/bin/ffmpeg'")
      :format(bench.folder, bench.folder, bench.folder, bench.folder)))
  end
  local function faked(arguments, ...)
    local path = os.getenv "PATH"
    return run(("PATH='%s/bin:%s' '%s' render film.lua --progress none "):format(bench.folder, path,
      workbench.absolute) .. arguments, ...)
  end
  local function nothing_is_left()
    for _, name in ipairs(bench:files()) do
      assert.falsy(name:find "%.part$" or name:find "^%.?out", name)
    end
  end

  describe("read back", function()
    for _, ending in ipairs(ENDINGS) do
      it_reads(ending .. " has its frames, length, colours and tags", function()
        render("-o out.%s", ending)
        local found = probe("out." .. ending,
          "stream=nb_read_frames,color_space,color_transfer,color_primaries,color_range,"
          .. "width,height:format=duration")
        assert.same({ "12", "128", "80" }, { found.nb_read_frames, found.width, found.height })
        assert.same({ "bt709", "iec61966-2-1", "bt709", "tv" },
          { found.color_space, found.color_transfer, found.color_primaries, found.color_range })
        assert.is_true(math.abs(tonumber(found.duration) - 0.5) < 0.002, found.duration)
        assert.is_true(worst_field("out." .. ending) <= 2, worst_field("out." .. ending))
      end)
    end

    it_reads("has the colours of a film that is mixed in sRGB codes", function()
      bench:write("film.lua", (chart_script():gsub("fps = 24", '%0, space = "srgb"')))
      for _, ending in ipairs { "mp4", "webm" } do
        render("-o out.%s", ending)
        assert.is_true(worst_field("out." .. ending) <= 2, worst_field("out." .. ending))
      end
    end)

    it_reads("gif has its frames, length and colours", function()
      render "-o out.gif"
      local found = probe("out.gif", "stream=nb_read_frames:format=duration")
      assert.equal("12", found.nb_read_frames)
      assert.is_true(math.abs(tonumber(found.duration) - 0.5) <= 0.01, found.duration)
      assert.is_true(worst_field "out.gif" <= 12)
    end)

    it_reads("webp has its frames and their times", function()
      render "-o out.webp"
      local bytes, frames, time, at = bench:read "out.webp", 0, 0, 13
      while at < #bytes do -- a list of chunks; ANMF is a frame, with its time in three bytes
        local name, size = ("<c4I4"):unpack(bytes, at)
        if name == "ANMF" then
          frames, time = frames + 1, time + ("<I3"):unpack(bytes, at + 8 + 12)
        end
        at = at + 8 + size + size % 2
      end
      assert.equal(6, frames) -- on twos: equal neighbours are one
      assert.is_true(math.abs(time - 500) <= 42, time)
    end)

    it_reads("apng has its frames, length, colours and alpha, without loss", function()
      render "-o out.apng --no-dither"
      local found = probe("out.apng", "stream=nb_read_frames,pix_fmt,r_frame_rate")
      assert.same({ "12", "rgba", "24/1" },
        { found.nb_read_frames, found.pix_fmt, found.r_frame_rate })
      assert.equal(0, worst_field "out.apng")
      render "-o frame.png --frames 5"
      assert.equal(pixels("frame.png", 0, 128, 80), pixels("out.apng", 4, 128, 80))
      render "-o out.apng --depth 16 --background '#fff'"
      assert.equal("rgb48be", probe("out.apng", "stream=pix_fmt").pix_fmt)
    end)

    it_reads("is played as often as --loop says", function()
      --- What a file says, at the bytes behind this text.
      local function number(name, text, skipped, format)
        local bytes = bench:read(name)
        local _, last = bytes:find(text, 1, true)
        return last and (format:unpack(bytes, last + 1 + skipped))
      end
      for loops, stored in pairs { [0] = { 0, 0, 0 }, [1] = { nil, 1, 1 }, [3] = { 2, 3, 3 } } do
        for _, ending in ipairs { "gif", "webp", "apng" } do
          render("-o out.%s --frames 1-4 --loop %d", ending, loops)
        end
        assert.equal(stored[1], number("out.gif", "NETSCAPE2.0", 2, "<I2"))
        assert.equal(stored[2], number("out.webp", "ANIM", 8, "<I2"))
        assert.equal(stored[3], number("out.apng", "acTL", 4, ">I4"))
      end
      local code, _, err = celspan "-o out.mp4 --loop 2"
      assert.equal(2, code)
      assert.truthy(err:find("mp4 takes no --loop: leave it out; it is only for", 1, true), err)
      code, _, err = celspan "-o out.#.png --loop 2"
      assert.equal(2, code)
      assert.truthy(err:find("png takes no --loop", 1, true), err)
      render "-o out.gif --frames 1-4 --resume"
      render "-o out.gif --frames 1-4 --resume --loop 4"
      assert.equal(3, number("out.gif", "NETSCAPE2.0", 2, "<I2"))
    end)

    it_reads("can be a part of the film, or coded in another way", function()
      render "-o whole.mkv"
      render "-o out.mkv --crop 32,32,64,40 --colour rec709 --dither"
      local found = probe("out.mkv", "stream=color_transfer,width,height")
      assert.same({ "bt709", "64", "40" }, { found.color_transfer, found.width, found.height })
      local part, whole = pixels("out.mkv", 4, 64, 40), pixels("whole.mkv", 4, 128, 80)
      -- The same light has lower codes in Rec. 709, except black and white.
      for i, value in ipairs(mean(part, 64, 36, 4, 24)) do
        local same = mean(whole, 128, 68, 36, 24)[i]
        assert.is_true(i == 4 and value == same or value < same - 2 and value > same - 30,
          ("%d: %g %g"):format(i, value, same))
      end
    end)

    it_reads("is one picture of one frame for gif and webp", function()
      if not present.pictures() then return pending "there is no picture module" end
      local code, _, err = celspan "-o out.webp --frames 2"
      assert.are.equal(0, code, err)
      assert.falsy(bench:read("out.webp"):find("ANMF", 1, true))
    end)

    it_reads("has exactly 23.976 frames per second", function()
      bench:write("film.lua", (chart_script():gsub("fps = 24", "fps = 24000/1001")))
      render "-o out.mp4"
      assert.equal("24000/1001", probe("out.mp4", "stream=r_frame_rate").r_frame_rate)
    end)

    it_reads("keeps the order of a list of frames", function()
      render "-o out.mkv --frames 12-1:-1"
      render "-o whole.mkv"
      local last, first = pixels("out.mkv", 0, 128, 80), pixels("whole.mkv", 11, 128, 80)
      local dot = mean(last, 128, 64, 66, 12)
      for i, value in ipairs(mean(first, 128, 64, 66, 12)) do
        assert.is_true(math.abs(value - dot[i]) < 2)
      end
    end)

    it_reads("has alpha if its format supports it", function()
      bench:write("film.lua", GLASS)
      for _, ending in ipairs { "mov", "webm" } do
        render("-o out.%s", ending)
        local bytes = pixels("out." .. ending, 1, 32, 16)
        local glass, clear = mean(bytes, 32, 4, 4, 8), mean(bytes, 32, 20, 4, 8)
        assert.is_true(math.abs(glass[4] - 127.5) <= 3 and math.abs(glass[1] - 255) <= 4,
          ending .. glass[4])
        assert.is_true(clear[4] <= 2, ending .. clear[4])
        render("-o out.%s --background '#00ff00'", ending)
        bytes = pixels("out." .. ending, 1, 32, 16)
        assert.equal(255, mean(bytes, 32, 20, 4, 8)[4])
      end
      render "-o out.gif"
      local bytes = pixels("out.gif", 1, 32, 16)
      assert.equal(0, mean(bytes, 32, 20, 4, 8)[4])
    end)

    it_reads("shows the frame over black without alpha", function()
      bench:write("film.lua", GLASS)
      render "-o out.mp4"
      local found = mean(pixels("out.mp4", 1, 32, 16), 32, 4, 4, 8)
      assert.is_true(math.abs(found[1] - 188) <= 3 and found[2] <= 2, found[1]) -- half of the light
    end)

    it_reads(
      "has ten bits with --depth 16, and any size but where the encoder "
      .. "wants even sides", function()
      render "-o out.mp4 --depth 16"
      assert.equal("yuv420p10le", probe("out.mp4", "stream=pix_fmt").pix_fmt)
      for _, ending in ipairs { "mov", "webm", "mkv", "gif" } do
        render("-o out.%s --size 63x41 --frames 1-3", ending)
        local found = probe("out." .. ending, "stream=width,height")
        assert.same({ "63", "41" }, { found.width, found.height })
      end
      local code, _, err = celspan "-o odd.mp4 --size 63x41"
      assert.equal(2, code)
      assert.truthy(err:find("odd.mp4: 63 x 41 pixels: h264 needs an even width and height in mp4: "
        .. "give --size 62x40, or write .webm or .mkv", 1, true), err)
    end)

    it_reads("is larger with more --quality", function()
      for _, ending in ipairs { "mp4", "mov", "webm", "mkv", "gif", "webp" } do
        local sizes = {}
        for i, quality in ipairs { 0, 100 } do
          render("-o out.%s --quality %d", ending, quality)
          sizes[i] = #bench:read("out." .. ending)
        end
        assert.is_true(sizes[1] < sizes[2], ending .. " " .. sizes[1] .. " " .. sizes[2])
      end
    end)

    it_reads(
      "is replaced, made in folders that are missing, and its name may be anything", function()
      for _, name in ipairs { "-x.mp4", "deep/er/file:a b;'$HOME.mp4", "http:x.mp4", "100%.mp4" } do
        local quoted = "'" .. name:gsub("'", "'\\''") .. "'"
        for _ = 1, 2 do render("-o " .. quoted:gsub("%%", "%%%%")) end
        assert.truthy(bench:read(name):find("ftyp", 1, true), name)
      end
      assert.same({ "file:a b;'$HOME.mp4" }, bench:files "deep/er")
    end)

    it_reads("prints digests that do not depend on the format", function()
      local _, digests = celspan "-o out.mp4 --hash --background '#fff'"
      local _, alone = celspan "--hash --dither --alpha premultiplied --background '#fff'"
      assert.equal(alone, digests)
      _, digests = celspan "-o out.mp4 --hash --no-dither --background '#fff'"
      _, alone = celspan "--hash --alpha premultiplied --background '#fff'"
      assert.equal(alone, digests)
      local code, _, err = celspan "-o out.mp4 --no-dither --dither"
      assert.equal(2, code)
      assert.truthy(err:find("exclude each other", 1, true), err)
    end)

    it_reads(
      "makes a frame once for its video and its digest, which equal neighbours share", function()
      bench:write("film.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 8, 8 }, frames = 2, frame = function(f)
  return celspan.rostrum { antialias = "none", celspan.cel { celspan.scanline { bounds = { 0, 0, 8,
    8 },
    spans = function(y) print("row " .. y) return {} end } } }
end }]])
      local function rows(ending)
        local code, out, err = celspan("-o out.%s --hash", ending)
        assert.equal(0, code, err)
        return select(2, (out .. err):gsub("row ", ""))
      end
      for _, ending in ipairs { "mkv", "mov" } do assert.equal(16, rows(ending)) end
      bench:write("film.lua", chart_script())
      local _, digests = celspan "-o out.mov --hash"
      local list = {}
      for digest in digests:gmatch "%d+ (%x+)\n" do list[#list + 1] = digest end
      assert.equal(12, #list)
      for i = 1, 12, 2 do
        assert.equal(list[i], list[i + 1]) -- on twos
        assert.is_true(i == 11 or list[i + 1] ~= list[i + 2])
      end
    end)

    it_reads("may have an odd number of pixels a side with subsampled colours", function()
      bench:write("film.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 33, 17 }, frames = 2, frame = function()
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 33, 17, texture = "#285a3c" } } }
end }]])
      render "-o out.webm --background '#000'"
      assert.equal("yuv420p", probe("out.webm", "stream=pix_fmt").pix_fmt)
      local bytes = pixels("out.webm", 1, 33, 17)
      for _, corner in ipairs { { 0, 0 }, { 31, 0 }, { 0, 15 }, { 31, 15 } } do
        local found = mean(bytes, 33, corner[1], corner[2], 2)
        for channel, wanted in ipairs { 0x28, 0x5a, 0x3c, 255 } do
          assert.is_true(math.abs(found[channel] - wanted) <= 2, channel .. ": " .. found[channel])
        end
      end
    end)
  end)

  describe("with sound", function()
    --- The time in the video of the click at 0.1 s of the sound.
    local cases = {
      { offset = 0, heard = 0.1 }, { offset = 0.25, heard = 0.35 },
      { offset = -0.05, heard = 0.05 },
      { offset = 0.25, frames = "--frames 7-12", heard = 0.1, length = 0.25 },
    }
    for _, ending in ipairs(ENDINGS) do
      it_reads(ending .. " has it in step", function()
        bench:write("click.wav", click(0.1))
        for _, case in ipairs(cases) do
          render("-o out.%s %s -- click.wav %g", ending, case.frames or "", case.offset)
          local heard, length = onset("out." .. ending)
          assert.is_true(math.abs(heard - case.heard) < 1 / 96, ending .. " " .. tostring(heard))
          assert.is_true(math.abs(length - (case.length or 0.5)) < 0.025, length)
        end
      end)
    end

    it_reads("looks for it next to the script, from any folder", function()
      assert(os.execute(("mkdir '%s/sub' && mv '%s/film.lua' '%s/sub/film.lua'")
        :format(bench.folder, bench.folder, bench.folder)))
      bench:write("sub/click.wav", click(0.1))
      local code, _, err =
        bench:celspan("render '%s/sub/film.lua' --progress none -o '%s/out.mkv' -- click.wav",
        bench.folder, bench.folder)
      assert.equal(0, code, err)
      assert.is_true(math.abs(onset "out.mkv" - 0.1) < 1 / 96)
    end)

    it("is looked for next to the file that makes the film, whoever makes its frames", function()
      assert(os.execute(("mkdir '%s/shots' '%s/scenes'"):format(bench.folder, bench.folder)))
      bench:write("scenes/scene.lua", "return function() return require 'celspan'.rostrum {} end\n")
      bench:write("shots/shot.lua",
        "return require 'celspan'.film { size = { 8, 8 }, frames = 2, sound = 'click.wav',\n"
        .. "frame = require 'scenes.scene' }\n")
      bench:write("film.lua", "return (require 'shots.shot'):with { frames = 3 }\n")
      bench:write("scenes/click.wav", "the wrong one")
      local function check() return bench:celspan_inside "check film.lua" end
      local code, _, err = check()
      assert.equal(4, code)
      assert.truthy(err:find("shots/click.wav cannot be opened: No such file", 1, true), err)
      assert.truthy(err:find("3 frames checked: no faults except in the sound or the captions", 1,
        true), err)
      bench:write("shots/click.wav", click(0.1))
      code, _, err = check()
      assert.equal(0, code, err)
      bench:write("film.lua", "return (require 'shots.shot'):with { sound = 'other.wav' }\n")
      bench:write("other.wav", click(0.1))
      assert.equal(0, (check()))
    end)

    it_reads("is decoded by check --deep, up to the end of the film", function()
      bench:write("noise.wav", "RIFF\0\0\0\0WAVE")
      bench:write("film.lua",
        "return require 'celspan'.film { size = { 8, 8 }, sound = 'noise.wav',\n"
        .. "frame = function() return require 'celspan'.rostrum {} end }\n")
      assert.equal(0, (bench:celspan("check %s/film.lua", bench.folder)))
      local code, _, err = bench:celspan("check %s/film.lua --deep", bench.folder)
      assert.equal(4, code)
      assert.truthy(err:find("noise.wav cannot be read: ffmpeg ended", 1, true), err)
      -- not decoded
      assert.equal(0, (run("PATH=/nowhere '%s' check film.lua --deep", workbench.absolute)))
    end)

    it_reads("is refused with a sentence if it is invalid", function()
      bench:write("click.wav", click(0.1))
      bench:write("noise.wav", "no sound at all")
      bench:write("torn.wav", "RIFF\0\0\0\0WAVE")
      fake ""
      local refusals = {
        { 4, "the sound nowhere.wav cannot be opened: No such file", "-o out.mp4 -- nowhere.wav" },
        { 4, "the sound ./bin cannot be opened: Is a directory", "-o out.mp4 -- ./bin" },
        { 4, "the sound noise.wav has none of the formats that are read",
          "-o out.mp4 -- noise.wav" },
        { 4, "the sound torn.wav cannot be read: ffmpeg ended", "-o out.mp4 -- torn.wav" },
        { 2, "goes with one run of frames", "-o out.mp4 --frames 1-7:2 -- click.wav" },
        { 0, "gif holds no sound", "-o out.gif -- click.wav" },
      }
      for _, refusal in ipairs(refusals) do
        local code, _, err = celspan(refusal[3])
        assert.equal(refusal[1], code, err)
        assert.truthy(err:find(refusal[2], 1, true), err)
      end
    end)

    it("is checked at the script's line", function()
      for field, sentence in pairs {
        ["sound = ''"] = "field 'sound' must be the name of a file",
        ["sound = 5"] = "field 'sound' must be the name of a file, { \"voice.wav\", at = 2 } or",
        ["sound_offset = 2e9"] = "sound_offset is 2e09; it must be between -1e09 and 1e09",
        ["sound_offset = 'late'"] = "field 'sound_offset' must be a number",
      } do
        bench:write("film.lua", "local celspan = require 'celspan'\nreturn celspan.film { " .. field
          .. ", frame = function() end }\n")
        local code, _, err = celspan "-o out.png"
        assert.equal(3, code)
        assert.truthy(err:find("film.lua:2: film: " .. sentence, 1, true), err)
      end
    end)
  end)

  it("refuses options that a video cannot have", function()
    for arguments, sentence in pairs {
      ["-o out.mp4 --keep-going"] = "leave --keep-going out, or render shot.####.png",
      ["-o out.####.mp4"] = "leave the frame's number out",
      ["-o out.mp4 --depth float"] = "takes --depth 8 or 16",
      ["-o out.mp4 --colour linear"] = "mp4 takes --colour srgb or rec709, or",
      ["-o out.webm --depth 16"] = "vp9 holds 8 bits where it has alpha",
      ["-o out.gif --depth 16"] = "gif holds 8 bits",
      ["-o out.mp4 --quality 101"] = "a whole number from 0 to 100",
      ["-o out.####.png --quality 50"] = "png takes no --quality",
      ["-o - --quality 50"] = "standard output takes no --quality",
      ["-o out.mp4 --size 20000x20"] = "a video has at most 16384 a side",
      ["-o out.mp4 --size 20x20000"] = "a video has at most 16384 a side",
      ["-o out.mp4 --size 1x7"] = "h264 needs an even width and height in mp4: give --size 2x6",
      ["-o out.mp4 --size 8x1"] = "give --size 8x2",
    } do
      local code, _, err = celspan(arguments)
      assert.equal(2, code, err)
      assert.truthy(err:find(sentence, 1, true), err)
    end
    bench:write("film.lua",
      "return require 'celspan'.film { fps = 101, frames = 2, frame = function() end }\n")
    local code, _, err = celspan "-o out.gif"
    assert.equal(2, code, err)
    assert.truthy(err:find("out.gif: 101 frames per second: gif holds at most 100", 1, true), err)
    nothing_is_left()
  end)

  describe("when ffmpeg", function()
    it("is missing, says which package has it", function()
      local code, _, err = run("PATH=/nowhere '%s' render film.lua --progress none -o out.mp4",
        workbench.absolute)
      assert.equal(5, code)
      assert.equal("celspan: error: out.mp4: ffmpeg, which makes videos, is not in PATH: install "
        .. "the package ffmpeg\n", err)
      nothing_is_left()
    end)

    it("cannot be started, says why", function()
      fake "exit 0\n"
      assert(os.execute(("chmod -x '%s/bin/ffmpeg'"):format(bench.folder)))
      local code, _, err = run("PATH='%s/bin' '%s' render film.lua --progress none -o out.mp4",
        bench.folder, workbench.absolute)
      assert.equal(5, code)
      assert.equal("celspan: error: out.mp4: ffmpeg cannot be started: Permission denied\n", err)
      nothing_is_left()
    end)

    local deaths = {
      { "dies with many words",
        "seq 20000 >&2; printf '\\n  no \\t such\\033\\n\\n encoder \\n\\n' >&2; exit 3\n",
        "19999 20000 no such encoder\n" },
      { "dies without a word", "printf '\\n  \\n' >&2; exit 4\n",
        "ffmpeg ended with exit code 4\n" },
      { "dies at once", "echo 'no such encoder' >&2; exit 3\n",
        "ffmpeg ended with exit code 3: no such encoder" },
      { "dies in the middle", "head -c 50000 >/dev/null; echo disk >&2; echo full >&2; exit 1\n",
        "ffmpeg ended with exit code 1: disk full" },
      { "is killed", "head -c 50000 >/dev/null; kill -9 $$\n", "ffmpeg was ended by signal 9" },
      { "ends too early", "head -c 50000 >/dev/null\n",
        "ffmpeg ended before it had read every frame" },
      { "dies at the end", "cat >/dev/null; echo trailer >&2; exit 1\n",
        "ffmpeg ended with exit code 1: trailer" },
      { "writes nothing", "cat >/dev/null\n", "the output of ffmpeg is not in the format mp4" },
      { "writes garbage", "cat >/dev/null; for last; do :; done; seq 1000 >\"${last#file:}\"\n",
        "the output of ffmpeg is not in the format mp4" },
      { "reads no more", "exec 0<&-; sleep 60\n",
        "ffmpeg stopped reading frames, but did not end" },
    }
    for _, death in ipairs(deaths) do
      it(death[1] .. ", says so and leaves nothing", function()
        bench:write("out.mp4", "the film of yesterday")
        fake(death[2])
        local code, _, err = faked "-o out.mp4 --size 512x320" -- 2.9 MB, of which a pipe holds 1
        assert.equal(5, code, err)
        assert.truthy(err:find(death[3], 1, true), err)
        assert.equal("the film of yesterday", bench:read "out.mp4")
        os.remove(bench.folder .. "/out.mp4")
        nothing_is_left()
      end)
    end

    it("hangs, a signal ends both and leaves nothing", function()
      fake("echo $$ >'" .. bench.folder .. "/id'; sleep 60 & wait\n")
      local code = faked "-o out.mp4 --size 1280x720 & other=$!; sleep 1; kill $other; wait $other"
      assert.equal(128 + 15, code)
      local id = assert(tonumber(bench:read "id"))
      assert.falsy(os.execute(("kill -0 %d 2>/dev/null"):format(id)))
      nothing_is_left()
    end)

    it("reads them, frames are the same from any number of workers and any memory", function()
      fake("for last; do :; done; cat >'" .. bench.folder
        .. "/read'; printf '\\0\\0\\0\\030ftypisom0000000' >\"${last#file:}\"\n")
      for _, arguments in ipairs { "-o out.mp4", "-o out.mp4 --hash", "-o out.mov --hash" } do
        local alone
        for workers = 1, 3 do
          for _, memory in ipairs { "", "--memory 0", "--memory 1 --size 640x400" } do
            local code, out, err = faked(("%s --workers %d %s"):format(arguments, workers, memory))
            assert.equal(0, code, err)
            alone = alone or {}
            local size = memory:match "%-%-size.*" or ""
            local made = out .. bench:read "read"
            assert.is_true(#made > 12 * 128 * 80)
            alone[size] = alone[size] or made
            assert.is_true(made == alone[size], ("%s %d %s"):format(arguments, workers, memory))
          end
        end
      end
    end)

    it("works, and a frame fails, nothing is left", function()
      fake "cat >/dev/null\n"
      bench:write("film.lua",
        "local celspan = require 'celspan'\nreturn celspan.film { size = { 8, 8 }, frames = 3,\n"
        .. "frame = function(f) if f.number == 2 then error 'torn' end\nreturn celspan.rostrum { "
        .. "celspan.cel {} } end }\n")
      local code, _, err = faked "-o out.mp4"
      assert.equal(3, code, err)
      assert.truthy(err:find("frame 2: torn", 1, true), err)
      assert.truthy(err:find("out.mp4 was not made: the run ended after 1 of 3 frames", 1, true),
        err)
      nothing_is_left()
    end)
  end)
end)
