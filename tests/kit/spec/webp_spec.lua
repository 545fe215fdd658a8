-- Films in WebP: what the file says, the same bytes on any number of workers, alpha, and what is
-- refused. spec/faithful compares the frames of an opaque film with pictures.

local movies = require "tests.support.movies"
local present = require "tests.support.present"
local rendering = require "tests.support.rendering"
local workbench = require "tests.support.workbench"

local PYTHON = "/usr/bin/python3"

--- A disc that moves over nothing and fades, and rests at the end. With "bad" a frame fails.
local FILM = [[
local celspan = require "celspan"
local kind = ...
return celspan.film { size = { 96, 64 }, fps = 24, frames = 12, frame = function(f)
  if kind == "bad" and f.index == 7 then error "no such frame" end
  local i = math.min(f.index, 8)
  return celspan.rostrum { celspan.cel { celspan.circle { centre = { 20 + 5 * i, 32 }, radius = 14,
    texture = celspan.rgb(0.9, 0.3, 0.1, 1 - i / 12) } } }
end }
]]

--- Prints the times of the frames, and writes their pixels.
local READ = [[
import sys
from PIL import Image
film = Image.open(sys.argv[1])
with open("pixels.raw", "wb") as out:
    for i in range(film.n_frames):
        film.seek(i)
        out.write(film.convert("RGBA").tobytes())
        print(film.info["duration"], end=" ")
]]

describe("a film in WebP", function()
  local bench

  before_each(function()
    bench = workbench.new()
    bench:write("film.lua", FILM)
    bench:write("read.py", READ)
  end)
  after_each(function() bench:remove() end)

  local function render(arguments, ...) return rendering.done(bench, arguments, ...) end
  local function times(name)
    return movies.run(bench, PYTHON .. " read.py " .. name)
  end
  local function nothing_is_left()
    for _, name in ipairs(bench:files()) do assert.falsy(name:find "webp", name) end
  end

  it("has the same bytes on any number of workers, and from both modules", function()
    local raster = workbench.build .. "/src/kit/plugins/raster/celspan-raster.so"
    local ways, first = { "", "", "" }, nil
    if present.program(raster) then ways[4] = "CELSPAN_PICTURE_MODULE='" .. raster .. "' " end
    for i, way in ipairs(ways) do
      local code, _, err = bench:inside(("%s'%s' render film.lua -o film.webp --workers %d "
        .. "--progress none"):format(way, workbench.absolute, i))
      assert.equal(0, code, err)
      first = first or bench:read "film.webp"
      assert.is_true(first == bench:read "film.webp", way .. i)
    end
    assert.equal(#first - 8, (("<I4"):unpack(first, 5)))
  end)

  it("has times that do not drift, frames that last, and the pixels of alpha", function()
    if not present.program(PYTHON) or not os.execute(PYTHON .. " -c 'import PIL'") then
      return pending "no program decodes WebP"
    end
    render "-o film.webp --quality 100 --no-dither --fps 30000/1001"
    local list, sum = {}, 0
    for time in times "film.webp":gmatch "%S+" do
      list[#list + 1], sum = tonumber(time), sum + time
    end
    assert.equal(501, sum) -- 15 frames of 1001/30000 seconds
    for i = 1, #list - 1 do assert.is_true(list[i] % 33 <= 2, list[i]) end
    assert.is_true(list[#list] > 100) -- the disc rests
    render "-o film.webp --quality 100 --no-dither"
    assert.equal(9, select(2, times "film.webp":gsub("%S+", "")))
    local found = bench:read "pixels.raw"
    render "-o plain.##.png --frames 1-9"
    assert.is_true(found == movies.pixels(bench, "plain.%02d.png", "rgba", "-f image2"))
  end)

  it("is refused with a reason where it cannot be made", function()
    local function refused(arguments, words, exit)
      rendering.refused(bench, exit or 2, words, arguments)
    end
    refused("-o w.webp --size 16384x2", "16384 x 2 pixels: WebP has at most 16383 a side")
    refused("-o w.webp --alpha premultiplied", "films in WebP hold straight alpha")
    refused("-o w.webp --crf 3", "webp has no --crf: leave it out, or give --quality")
    refused("-o w.webp --depth 16", "webp holds 8 bits")
    local code, _, err = bench:inside(("CELSPAN_MEMORY=400M '%s' render film.lua -o w.webp "
      .. "--size 6000x4000 --progress none"):format(workbench.absolute))
    assert.equal(33, code, err)
    assert.truthy(err:find "memory", err)
    nothing_is_left()
  end)

  it("leaves nothing of a run in which a frame fails", function()
    local code, _, err = rendering.run(bench, "-o film.webp -- bad")
    assert.equal(3, code, err)
    assert.truthy(err:find("no such frame", 1, true), err)
    nothing_is_left()
  end)
end)
