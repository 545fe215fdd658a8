-- Deliveries: codecs, and what ffprobe and ffmpeg read back from them.

local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

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

describe("a delivery", function()
  local bench

  before_each(function()
    bench = workbench.new()
    bench:write("film.lua", FILM)
  end)
  after_each(function() bench:remove() end)

  local function celspan(arguments, ...)
    return bench:celspan_inside("render film.lua --progress none " .. arguments, ...)
  end
  local function render(arguments, ...)
    local code, _, err = celspan(arguments, ...)
    assert.equal(0, code, err)
  end
  local function refused(arguments, words)
    local code, _, err = celspan(arguments)
    assert.equal(2, code, err)
    assert.truthy(err:find(words, 1, true), err)
    for _, name in ipairs(bench:files()) do assert.falsy(name:find "^out%.", name) end
  end
  local function stream(name)
    local code, out, err = bench:inside("ffprobe -v error -select_streams v -count_frames "
      .. "-show_entries stream=codec_name,profile,pix_fmt,nb_read_frames -of default=nw=1 " .. name)
    assert.equal(0, code, err)
    local found = {}
    for key, value in out:gmatch "([%w_]+)=([^\n]*)" do found[key] = value end
    return found
  end
  --- The pixels of a frame from 0, as RGBA of 8 or 16 bits.
  local function pixels(name, frame, width, height, bits)
    local code, out, err = bench:inside(("ffmpeg -v error %s -i %s -vf "
      .. "scale=flags=accurate_rnd+full_chroma_int -f rawvideo -pix_fmt %s -"):format(
      name:find "webm$" and stream(name).codec_name == "vp9" and "-c:v libvpx-vp9" or "", name,
      bits == 16 and "rgba64le" or "rgba"))
    assert.equal(0, code, err)
    local size = width * height * (bits or 8) // 2
    return out:sub(frame * size + 1, (frame + 1) * size)
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
    { "mov", "h264", "h264", "yuv420p" }, { "webm", "av1", "av1", "yuv420p" },
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

  it("is refused with a codec that its file does not contain", function()
    refused("-o out.mp4 --codec prores", "out.mp4: --codec prores: mp4 contains h264, h265, av1")
    refused("-o out.gif --codec h264", "gif contains gif")
    refused("-o out.#.png --codec h264", "--codec is only for videos")
    refused("-o out.mp4 --crf 64", "a whole number from 0 to 63")
    refused("-o out.mp4 --crf 52", "--crf of h264 is a whole number from 0 to 51")
    refused("-o out.mov --crf 20", "prores has no --crf: leave it out, or give --quality")
    refused("-o out.mov --codec dnxhr --crf 20", "dnxhr has no --crf: leave it out")
    refused("-o out.mp4 --crf 20 --quality 20", "--crf and --quality exclude each other")
    refused("-o out.mov --codec dnxhr --size 254x120", "dnxhr needs at least 256 x 120")
    refused("-o out.mp4 --codec h265 --size 16x14", "h265 needs at least 16 x 16")
  end)
end)
