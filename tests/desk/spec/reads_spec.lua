-- celspan check --files: one film that reads a file of each kind, all of which are named.
local configuration = require "tests.support.configuration"
local present = require "tests.support.present"
local truetype = require "tests.support.truetype"
local workbench = require "tests.support.workbench"

local SCRIPT = [[
local celspan, csv = require "celspan", require "celspan.csv"
require "parts.hand"
celspan.parameters { radius = 10 }
csv.read "data.csv"
require "celspan.captions".read "read.srt"
local clip = celspan.footage { file = "clip.mp4" }
local plates = celspan.footage { file = "plate.####.png" }
local anim = require "celspan.lottie".load("art/anim.json", { fonts = { Block = "lottie.ttf" } })
local draw = require "celspan.svg".load("art/draw.svg", { fonts = { Block = "svg.ttf" } })
local graded = celspan.picture { file = "still.png", colour = "half" }
local function frame(f)
  return celspan.rostrum {
    celspan.cel { celspan.rect { 0, 0, 60, 40, texture = clip:at(f.time) } },
    celspan.cel { celspan.rect { 0, 0, 20, 20, texture = plates:frame(1 + f.index) } },
    celspan.cel { celspan.rect { 20, 0, 20, 20, texture = graded } },
    celspan.cel { draw.object, grade = { lut = "look.cube" } },
    celspan.cel { draw:at(f.time), opacity = 0.5 },
    celspan.cel { anim:at(f.time) },
    celspan.cel { celspan.text { "AB", font = "own.ttf", size = 8, at = { 2, 30 } } },
  }
end
local function film(sound)
  return celspan.film { size = { 60, 40 }, frames = 3, fps = 12, frame = frame, sound = sound }
end
local deep = film "deep.wav"
local shot = film { { deep, at = 0 }, { "shot.wav", at = 0 } }
return require "celspan.cut" { shot, shot }:with { captions = "talk.srt" }
]]

local CONVERSIONS = [[
    to_reference: !<FileTransform> {src: half.cube}
    from_reference: !<FileTransform>
      src: "named here.cube" # and not there]]

local DRAWING = [[<svg xmlns="http://www.w3.org/2000/svg" width="60" height="40">
<filter id="f"><feImage href="in%20it/filter.png"/></filter>
<text x="5" y="20" font-family="Block" font-size="8">AB</text>
<rect width="9" height="9" filter="url(#f)"/><image href="shown.png"/><image href="none.png"/>
<image href="inner.svg"/><defs><image href="unused.png"/></defs></svg>]]

local INNER = [[<svg xmlns="http://www.w3.org/2000/svg" width="6" height="4">
<image href="inmost.png"><set attributeName="href" to="late.png" begin="0.1s"/></image></svg>]]

local ANIMATION = [[{"v": "5.7.0", "fr": 24, "ip": 0, "op": 24, "w": 60, "h": 40,
"fonts": {"list": [{"fName": "Block", "fFamily": "Block", "fStyle": "Regular"}]},
"assets": [{"id": "p", "w": 64, "h": 48, "u": "", "p": "two.png", "e": 0}],
"layers": [{"ty": 2, "refId": "p", "ind": 2, "ip": 0, "op": 24, "st": 0, "ks": {}},
{"ty": 5, "ind": 1, "ip": 0, "op": 24, "st": 0, "ks": {}, "t": {"d": {"k": [{"s": {"s": 10,
"f": "Block", "t": "A", "j": 0, "fc": [1, 0, 0]}, "t": 0}]}, "p": {}, "m": {"g": 1,
"a": {"a": 0, "k": [0, 0]}}, "a": []}}]}]]

local SQUARE = { { { 0, 0, true }, { 0, 700, true }, { 500, 700, true }, { 500, 0, true } } }
local FONT = { name = "Block", units = 1000, ascent = 800, descent = -200, glyphs = {
  { characters = {}, advance = 600, contours = SQUARE },
  { characters = { 65 }, advance = 600, contours = SQUARE },
  { characters = { 66 }, advance = 600, contours = SQUARE } } }
local CUBE = "LUT_3D_SIZE 2\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n"
local CAPTION = "1\n00:00:00,000 --> 00:00:00,200\nhello\n"

local bench

before_each(function()
  bench = workbench.new()
  assert.equal(0, (bench:inside "mkdir -p parts 'art/in it' luts more"))
  bench:write("film.lua", SCRIPT)
  bench:write("parts/hand.lua", "return {}")
  bench:write("data.csv", "a\n1\n")
  bench:write("values.json", '{"radius": 6}')
  bench:write("art/draw.svg", DRAWING)
  bench:write("art/inner.svg", INNER)
  bench:write("art/anim.json", ANIMATION)
  for _, name in ipairs { "talk.srt", "read.srt" } do bench:write(name, CAPTION) end
  for _, name in ipairs { "look.cube", "luts/half.cube", "more/named here.cube" } do
    bench:write(name, CUBE)
  end
end)
after_each(function() bench:remove() end)

--- Makes pictures, a movie, sounds and fonts.
local function make_media()
  for _, name in ipairs { "own", "lottie", "svg" } do
    bench:write(name .. ".ttf", truetype.build(FONT))
  end
  assert.equal(0, (bench:inside("ffmpeg -v error -f lavfi -i testsrc=size=64x48:rate=12 "
    .. "-pix_fmt yuv420p -t 0.5 clip.mp4 && ffmpeg -v error -i clip.mp4 -frames:v 3 plate.%04d.png "
    .. "&& ffmpeg -v error -f lavfi -i sine=440 -t 0.25 deep.wav && cp deep.wav shot.wav "
    .. "&& cp plate.0001.png still.png && cp still.png art/two.png "
    .. "&& for i in 'in it/filter' shown inmost late unused; "
    .. "do cp still.png \"art/$i.png\"; done")))
end

--- The kinds and the names of the files that celspan lists.
local function listed(options)
  local code, out, err = bench:celspan_inside("check film.lua --files --json " .. options)
  assert.equal(0, code, err)
  local lines = {}
  for i, one in ipairs(assert(require "celspan.json".decode(out))) do
    lines[i] = one.kind .. " " .. one.path:gsub("^%./", "")
  end
  table.sort(lines)
  return table.concat(lines, "\n")
end

local ALL = [[
data art/anim.json
data config.ocio
data data.csv
data look.cube
data luts/half.cube
data more/named here.cube
data read.srt
data talk.srt
data values.json
drawing art/draw.svg
drawing art/inner.svg
font lottie.ttf
font own.ttf
font svg.ttf
module parts/hand.lua
movie clip.mp4
picture art/in it/filter.png
picture art/inmost.png
picture art/late.png
picture art/shown.png
picture art/two.png
picture plate.0001.png
picture plate.0002.png
picture plate.0003.png
picture still.png
script film.lua
sound deep.wav
sound shot.wav]]

local it_reads = present.spaces() and present.pictures() and present.type()
  and present.program "ffmpeg" and it or pending

describe("check --files", function()
  it_reads("names a file of each kind", function()
    make_media()
    for _, path in ipairs { 'search_path: "luts:more"', "search_path:\n  - luts\n  - more" } do
      bench:write("config.ocio", configuration(path, CONVERSIONS))
      assert.equal(ALL, listed "--ocio config.ocio --set-from values.json")
    end
    local code, out, err = bench:inside(("OCIO=config.ocio '%s' check film.lua --files")
      :format(workbench.absolute))
    assert.equal(0, code, err)
    assert.equal(select(2, ALL:gsub("\n", "")), select(2, out:gsub("\n", "")))
  end)

  it("is about one film", function()
    bench:write("rows.csv", "radius\n1\n")
    local code, _, err = bench:celspan_inside "check film.lua --table rows.csv --files"
    assert.equal(2, code)
    assert.truthy(err:find("leave --files out", 1, true), err)
  end)

  it("reports captions that cannot be read, as it does sounds", function()
    bench:write("film.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 8, 8 }, frames = 1, captions = "none.srt", frame = function()
  return celspan.rostrum { back = "#fff" }
end }]])
    local code, _, err = bench:celspan_inside "check film.lua"
    assert.equal(3, code)
    assert.truthy(err:find("captions: none.srt: No such file", 1, true), err)
    assert.truthy(err:find("no faults except in the sound or the captions", 1, true), err)
  end)
end)
