-- AVIF: what ffprobe, avifdec and a browser read back, and what is refused. One list of cases:
-- stills, films, and failures.

local browsing = require "tests.support.browsing"
local movies = require "tests.support.movies"
local present = require "tests.support.present"
local rendering = require "tests.support.rendering"
local workbench = require "tests.support.workbench"

if not present.avif() then return pending "celspan was built without libavif" end

local it_probes = present.program("ffmpeg", "ffprobe") and it or pending
local it_decodes = present.program("avifdec", "avifenc") and it or pending
local it_shows = present.program("chromium", "node", "base64") and it or pending

local W, H = 96, 64

--- Fields of one colour each, the last of them translucent, and a bar that grows with the frames.
local FILM = [[
local celspan = require "celspan"
local kind = ...
return celspan.film { size = { 96, 64 }, fps = 24, frames = 6, frame = function(f)
  local fields = {}
  for i, colour in ipairs { "#28506e", "#e01020", "#a0a0a0", "#c8b4be80" } do
    fields[i] = celspan.rect { (i - 1) * 24, 0, 24, 64,
      texture = celspan.rgb(kind == "opaque" and colour:sub(1, 7) or colour) }
  end
  fields[#fields + 1] = celspan.rect { 0, 0, 12 * (f.index + 1), 8, texture = celspan.rgb "#fff" }
  return celspan.rostrum { celspan.cel(fields) }
end }
]]

describe("AVIF", function()
  local bench

  before_each(function()
    bench = workbench.new()
    bench:write("film.lua", FILM)
  end)
  after_each(function() bench:remove() end)

  local function celspan(arguments, ...) return rendering.run(bench, arguments, ...) end
  local function render(arguments, ...) return rendering.done(bench, arguments, ...) end
  local function refused(arguments, words, exit)
    rendering.refused(bench, exit or 2, words, arguments)
  end
  --- The pixels that avifdec finds, as RGBA of 8 or 16 bits.
  local function decoded(name, bits)
    movies.run(bench, ("avifdec -d %d '%s' decoded.png"):format(bits or 8, name))
    return movies.pixels(bench, "decoded.png", bits == 16 and "rgba64le" or "rgba", "", "")
  end
  local function rendered(options, bits)
    render("-o plain.png --depth %d %s", bits or 8, options)
    return movies.pixels(bench, "plain.png", bits == 16 and "rgba64le" or "rgba", "", "")
  end
  local function said(name)
    return movies.run(bench, ("avifdec --info '%s'"):format(name))
  end

  -- ---- stills

  it_decodes("has the very pixels of a frame with --crf 0, with their alpha", function()
    for _, options in ipairs { "--frames 3", "--frames 3 -- opaque",
      "--frames 3 --colour rec709" } do
      render("-o still.avif --crf 0 --no-dither %s", options)
      local about = said "still.avif"
      assert.truthy(about:find(options:find "opaque" and "Alpha          : Absent"
        or "Alpha          : Not premultiplied", 1, true), about)
      assert.truthy(about:find("Format         : YUV444", 1, true), about)
      local wanted = options:find "rec709" and "Transfer Char. : 1" or "Transfer Char. : 13"
      assert.truthy(about:find(wanted, 1, true) and about:find("Color Primaries: 1\n", 1, true))
      assert.truthy(about:find("Matrix Coeffs. : 0", 1, true), about)
      assert.is_true(decoded "still.avif" == rendered(options), options)
    end
  end)

  --- The greatest difference between two rows of bytes.
  local function worst(one, other)
    assert.equal(#one, #other)
    local most = 0
    for i = 1, #one do most = math.max(most, math.abs(one:byte(i) - other:byte(i))) end
    return most
  end

  it_decodes("is about as good as --quality and --crf say", function()
    local plain, sizes = rendered "--frames 2", {}
    for i, options in ipairs { "--quality 20", "", "--quality 100", "--crf 2" } do
      render("-o still.avif --no-dither --frames 2 %s", options)
      sizes[i] = #bench:read "still.avif"
      assert.is_true(worst(decoded "still.avif", plain) <= ({ 40, 6, 3, 2 })[i], options)
      assert.is_true(i == 1 or sizes[i] > sizes[i - 1], options)
      assert.truthy(said "still.avif":find("Matrix Coeffs. : 1\n", 1, true))
    end
    render "-o still.##.avif --frames 2"
    render "-o still.avif --frames 2 --no-dither"
    assert.equal(bench:read "still.avif", bench:read "still.02.avif")
  end)

  it_decodes("has twelve bits with --depth 16", function()
    render "-o still.avif --frames 2 --depth 16 --crf 0"
    assert.truthy(said "still.avif":find("Bit Depth      : 12", 1, true))
    local plain, found = rendered("--frames 2", 16), decoded("still.avif", 16)
    for i = 1, #plain, 2 do
      local one, other = ("<I2"):unpack(plain, i), ("<I2"):unpack(found, i)
      assert.is_true(math.abs(one - other) <= 16, one .. " " .. other)
    end
    render "-o still.##.avif --frames 2 --colour linear --depth 16"
    assert.truthy(said "still.02.avif":find("Transfer Char. : 8\n", 1, true))
  end)

  -- ---- films

  it_probes("has the frames of a film, its rate, its colours and its alpha", function()
    local function streams(name)
      return movies.run(bench, "ffprobe -v error -count_frames -show_entries stream=codec_name,"
        .. "pix_fmt,r_frame_rate,color_range,color_space,color_transfer,color_primaries,"
        .. "nb_read_frames -of csv=p=0 " .. name)
    end
    local alpha = ",pc,unknown,unknown,unknown,"
    for _, case in ipairs { { "", "yuv444p", "gray", "24/1", 6 },
      { "--depth 16 --fps 30000/1001", "yuv444p12le", "gray12le", "30000/1001", 7 } } do
      render("-o film.avif --no-dither --crf 4 %s", case[1])
      assert.equal(("av1,%s,tv,bt709,iec61966-2-1,bt709,%s,%d\nav1,%s%s%s,%d\n"):format(case[2],
        case[4], case[5], case[3], alpha, case[4], case[5]), streams "film.avif")
    end
    render "-o film.avif --no-dither --crf 0"
    local plain = rendered "--frames 1"
    local all = movies.pixels(bench, "film.avif", "rgba", "", "")
    for i = 0, 5 do
      local bright = 0
      for x = 0, W - 1 do
        if all:byte(i * 4 * W * H + 4 * (4 * W + x) + 2) > 240 then bright = bright + 1 end
      end
      assert.equal(12 * (i + 1), bright)
    end
    local middle = 4 * W * 40
    for at = middle + 1, middle + 4 * 72 do
      assert.is_true(at % 4 == 0 or math.abs(plain:byte(at) - all:byte(at)) <= 3, at)
    end
    local mask = movies.run(bench, "ffmpeg -v error -i film.avif -map 0:v:1 -f rawvideo -")
    assert.same({ 255, 128 }, { mask:byte(40 * W + 11), mask:byte(40 * W + 91) })
    render "-o film.avif --background '#000'"
    assert.equal("av1,yuv444p,tv,bt709,iec61966-2-1,bt709,24/1,6\n", streams "film.avif")
  end)

  it("has the same bytes at any time, on any number of threads, from both modules", function()
    local first, raster = nil, workbench.build .. "/src/kit/plugins/raster/celspan-raster.so"
    local ways = { "", "taskset -c 0 " }
    if present.program(raster) then ways[3] = "CELSPAN_PICTURE_MODULE='" .. raster .. "' " end
    for _, way in ipairs(ways) do
      local code, _, err = bench:inside(("%s'%s' render film.lua -o film.avif --progress none")
        :format(way, workbench.absolute))
      assert.equal(0, code, err)
      first = first or bench:read "film.avif"
      assert.is_true(first == bench:read "film.avif", way)
      os.execute "sleep 1.1"
    end
    render "-o film.avif --strict"
    assert.is_true(first == bench:read "film.avif")
  end)

  it_shows("is shown by a browser, with its alpha", function()
    render "-o film.avif --crf 4"
    render "-o still.avif --crf 0 --frames 3"
    render "-o deep.avif --crf 4 --frames 3 --depth 16"
    local plain = rendered "--frames 3"
    for _, name in ipairs { "still", "deep", "film" } do
      bench:write("page.html", "<img src='data:image/avif;base64,"
        .. movies.run(bench, ("base64 -w0 %s.avif"):format(name)) .. "'>")
      local found = browsing.see("about:blank", ([=[
        await page.load("file://%s/page.html");
        await page.until("document.querySelector('img').complete");
        return page.get(`(() => {
          const picture = document.querySelector("img");
          const canvas = document.createElement("canvas");
          canvas.width = picture.naturalWidth; canvas.height = picture.naturalHeight;
          const drawing = canvas.getContext("2d");
          drawing.drawImage(picture, 0, 0);
          return [canvas.width, canvas.height, ...[[12, 40], [36, 40], [60, 40], [84, 40]]
            .flatMap(([x, y]) => [...drawing.getImageData(x, y, 1, 1).data])];
        })()`);]=]):format(bench.folder), 60)
      assert.same({ W, H }, { found[1], found[2] })
      for i, x in ipairs { 12, 36, 60, 84 } do
        for c = 1, 4 do
          local wanted = plain:byte((40 * W + x) * 4 + c)
          assert.is_true(math.abs(found[2 + (i - 1) * 4 + c] - wanted) <= 4, name .. i .. c)
        end
      end
    end
  end)

  -- ---- failures

  it("is refused with a reason where it cannot be made", function()
    refused("-o w.avif --size 65536x1", "65536 x 1 pixels: AVIF has at most 65535 a side")
    refused("-o w.avif --size 16385x16384", "AVIF has at most 268435456 together")
    refused("-o w.##.avif --size 65536x1", "at most 65535 a side", 6)
    refused("-o w.avif --depth half", "avif takes --depth 8 or 16, and not half")
    refused("-o w.##.avif --depth float", "AVIF files hold depth 8, 16, not float")
    refused("-o w.##.avif --colour cineon", "hold colours as srgb, rec709 or linear, not as cineon")
    refused("-o w.avif --alpha premultiplied", "films in AVIF hold straight alpha")
    refused("-o w.avif --crf 3 --quality 3", "exclude each other")
    refused("-o w.avif --max-size 1M", "leave it out, or write .mp4, .webm or .mkv")
    refused("-o w.avif --codec av1", "--codec av1: avif contains avif")
    render "-o film.avif --loop 0"
    local code, _, err = celspan "-o film.avif --loop 3"
    assert.truthy(code == 0 or err:find("older than 1.0 and cannot say how often", 1, true), err)
  end)

  it("leaves nothing where memory or the disk runs out", function()
    if present.sanitizer() then return pending "a sanitizer reserves memory" end
    for _, mebibytes in ipairs { 60, 120, 240 } do
      local code, _, err = bench:inside(("(ulimit -v %d; '%s' render film.lua -o film.avif "
        .. "--size 1920x1280 --progress none)"):format(mebibytes * 1024, workbench.absolute))
      assert.equal(33, code, err)
      assert.truthy(err:find "memory", err)
    end
    local code, _, err = bench:inside(("(ulimit -f 1; trap '' XFSZ; '%s' render film.lua "
      .. "-o film.avif --trust --progress none)"):format(workbench.absolute))
    assert.equal(5, code, err)
    assert.truthy(err:find("film.avif: cannot write: File too large", 1, true), err)
    for _, name in ipairs(bench:files()) do assert.falsy(name:find "avif", name) end
  end)
end)
