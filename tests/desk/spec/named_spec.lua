-- What files say of the film and of the program that made them, and what other runs leave beside
-- them.

local movies = require "tests.support.movies"
local present = require "tests.support.present"
local rendering = require "tests.support.rendering"
local workbench = require "tests.support.workbench"

local FILM = [[
local celspan = require "celspan"
return celspan.film { size = { 32, 16 }, fps = 24, frames = 8, first = 101,
  title = "Moons & <seas>", marks = { night = 101, day = 105, dusk = 108 }, poster = 103,
  captions = "said.srt", sound = "tone.wav", frame = function(f)
    return celspan.rostrum { celspan.cel { celspan.rect { f.index, 0, 16, 16,
      texture = celspan.rgb "#c06040" } } }
  end }
]]
local SAID = "1\n00:00:00,000 --> 00:00:00,200\nGood night\n"

describe("a file", function()
  local bench, version

  before_each(function()
    bench = workbench.new()
    local samples = ("\0\1"):rep(16000)
    bench:write("film.lua", FILM)
    bench:write("said.srt", SAID)
    bench:write("tone.wav", ("<c4I4c4c4I4I2I2I4I4I2I2c4I4"):pack("RIFF", 36 + #samples, "WAVE",
      "fmt ", 16, 1, 1, 48000, 96000, 2, 16, "data", #samples) .. samples)
    version = select(2, bench:celspan "--version"):match "^celspan %S+ %b()"
  end)
  after_each(function() bench:remove() end)

  local function render(arguments) return rendering.done(bench, arguments) end
  local function probe(name)
    return movies.run(bench, "ffprobe -v error -show_entries format_tags=title,comment:"
      .. "stream=codec_type:stream_disposition=attached_pic:chapter=start_time,end_time:"
      .. "chapter_tags=title -of compact=nk=1 " .. name)
  end

  for _, ending in ipairs { "mp4", "mov", "mkv", "webm" } do
    it("has the title, the version and no random bytes: " .. ending, function()
      if not movies.are_made then return pending "there is no ffmpeg" end
      render("-o film." .. ending)
      local first, about = bench:read("film." .. ending), probe("film." .. ending)
      assert.truthy(about:find("format|Moons & <seas>|" .. version, 1, true), about)
      if ending ~= "webm" and ending ~= "mkv" then return end
      render("-o film." .. ending)
      assert.is_true(first == bench:read("film." .. ending))
    end)
  end

  it("has the title, and where it is moving the version: WebP, AVIF, SVG and PDF", function()
    local endings = { "webp", "svg" }
    if present.avif() then endings[#endings + 1] = "avif" end
    if present.pdf() then endings[#endings + 1] = "pdf" end
    for _, ending in ipairs(endings) do
      render("-o film." .. ending .. (ending == "svg" and " --frames 101" or ""))
      local bytes, is_moving = bench:read("film." .. ending), ending == "webp" or ending == "avif"
      local title = ending == "pdf" and "(Moons & <seas>)" or "Moons &amp; &lt;seas>"
      assert.truthy(bytes:find(title, 1, true), ending)
      assert.equal(is_moving, bytes:find(version, 1, true) ~= nil, ending)
    end
  end)

  it("of a record has the version, and one without it is read as well", function()
    local record = ".f.###.png.frames"
    render "-o f.###.png --resume"
    local text = bench:read(record)
    assert.equal("celspan frames 1\nby " .. version .. "\n", text:match "^.-\n.-\n")
    for _, kept in ipairs { text, (text:gsub("\nby [^\n]*", "")) } do
      bench:write(record, kept)
      local _, _, err = bench:celspan_inside "render film.lua -o f.###.png --resume --progress json"
      assert.truthy(err:find "kept", err)
      assert.falsy(err:find "made", err)
    end
  end)

  it("of frames that are there becomes the same video as of the film", function()
    if not movies.are_made then return pending "there is no ffmpeg" end
    render "-o f.###.png"
    render "-o film.mp4"
    local code, _, err = bench:celspan_inside("convert f.###.png made.mp4 --fps 24 "
      .. "--sound film.lua --progress none")
    assert.equal(0, code, err)
    assert.equal(probe "film.mp4", probe "made.mp4")
    assert.truthy(probe "made.mp4":find "chapter|0.167000|0.292000|day", probe "made.mp4")
    for _, name in ipairs(bench:files()) do assert.falsy(name:find "captions", name) end
  end)

  it("that a killed run has left is removed by the next run, with --resume or without", function()
    local left = { [".f.101.png.1a2b.part"] = "-o f.###.png",
      [".f.svg.1a2b.part"] = "-o f.svg --frames 101" }
    for name, arguments in pairs(left) do
      bench:write(name, "unfinished")
      bench:write(".g.101.png.1a2b.part", "of another run")
      render(arguments)
      local found = table.concat(bench:files(), " ")
      assert.falsy(found:find(name, 1, true), found)
      assert.truthy(found:find(".g.101.png.1a2b.part", 1, true), found)
    end
    bench:write(".mix.rest.wav.1a2b.part", "unfinished")
    local code, _, err = bench:celspan_inside "sound film.lua --stems -o mix.{name}.wav"
    assert.equal(0, code, err)
    assert.falsy(table.concat(bench:files(), " "):find(".mix.rest.wav.1a2b.part", 1, true))
  end)
end)
