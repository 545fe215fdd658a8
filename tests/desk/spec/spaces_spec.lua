-- Spaces and views of an OpenColorIO configuration: what celspan writes in them is what ocioconvert
-- makes of its light, and what it reads in them is that light.
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local it_writes = present.spaces() and it or pending
local it_agrees = present.spaces() and present.pictures()
  and present.program("ocioconvert", "idiff") and it or pending
local it_reads = present.spaces() and present.pictures() and it or pending

-- From ACES2065-1 to the primaries of BT.709, and from ACEScg to ACES2065-1.
local TO_BT709 = "[2.5216861867, -1.1341309882, -0.3875551985, 0, -0.2764799142, 1.3727190877, "
  .. "-0.0962391734, 0, -0.015378065, -0.1529753359, 1.1683534008, 0, 0, 0, 0, 1]"
local FROM_ACESCG = "[0.6954522414, 0.1406786965, 0.1638690622, 0, 0.0447945634, 0.8596711185, "
  .. "0.0955343182, 0, -0.0055258826, 0.0040252103, 1.0015006723, 0, 0, 0, 0, 1]"

--- A configuration whose scene_linear is not light in the primaries of BT.709.
local CONFIGURATION = ([[ocio_profile_version: 2
roles:
  default: coded
  scene_linear: acescg
  aces_interchange: aces
displays:
  screen:
    - !<View> {name: film, colorspace: filmic}
    - !<View> {name: raw, colorspace: acescg}
  wall:
    - !<View> {name: film, colorspace: acescg}
  sRGB wall:
    - !<View> {name: film, colorspace: coded}
  cinema (P3-D65):
    - !<View> {name: film, colorspace: filmic}
colorspaces:
  - !<ColorSpace>
    name: aces
    description: ACES2065-1
  - !<ColorSpace>
    name: acescg
    description: ACEScg
    to_reference: !<MatrixTransform> {matrix: $FROM_ACESCG}
  - !<ColorSpace>
    name: coded
    from_reference: !<GroupTransform>
      children:
        - !<MatrixTransform> {matrix: $TO_BT709}
        - !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}
  - !<ColorSpace>
    name: logarithmic
    from_reference: !<LogAffineTransform> {base: 10, log_side_slope: 0.25, log_side_offset: 0.4,
      lin_side_slope: 1, lin_side_offset: 0.01}
  - !<ColorSpace>
    name: wide
    from_reference: !<GroupTransform>
      children:
        - !<MatrixTransform> {matrix: $TO_BT709}
        - !<MatrixTransform> {matrix: [0.822461969, 0.177538031, 0, 0, 0.033194199, 0.966805801, 0,
            0, 0.017082631, 0.072397431, 0.910519938, 0, 0, 0, 0, 1]}
        - !<ExponentTransform> {value: 2.2, direction: inverse}
  - !<ColorSpace>
    name: numbers
    isdata: true
  - !<ColorSpace>
    name: filmic
    from_reference: !<GroupTransform>
      children:
        - !<CDLTransform> {slope: [0.9, 1, 1.1], power: [1.1, 1.1, 1.1], sat: 0.9}
        - !<ExponentTransform> {value: 2.2, direction: inverse}
]]):gsub("%$([A-Z0-9_]+)", { TO_BT709 = TO_BT709, FROM_ACESCG = FROM_ACESCG })

--- The same with a space for celspan's light.
local NAMED = CONFIGURATION .. ([[
  - !<ColorSpace>
    name: light
    aliases: [lin_rec709]
    from_reference: !<MatrixTransform> {matrix: %s}
]]):format(TO_BT709)

local RAMP = [[
local celspan = require "celspan"
local function bar(y, from, to)
  return celspan.rect { 0, y, 256, 16, texture = celspan.linear { from = { 0, 0 }, to = { 256, 0 },
    { 0, from }, { 1, to } } }
end
return celspan.rostrum { size = { 256, 48 }, celspan.cel { bar(0, "#000", "#fff"),
  bar(16, "#f00", "#08f"), bar(32, "#0f08", "#fc4") } }
]]

local bench

--- The leak checker reads the memory of a process from another one, which --strict does not allow.
local function render(script, arguments)
  local leaks = arguments:find "%-%-strict" and "ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 " or ""
  return bench:inside(("%s'%s' render %s --size 256x48 --progress none %s"):format(leaks,
    workbench.absolute, script, arguments))
end

local function rendered(script, arguments)
  local code, _, err = render(script, arguments)
  assert.equal(0, code, err)
end

local function refused(sentence, arguments)
  local code, _, err = render("ramp.lua", "-o never.png " .. arguments)
  assert.equal(2, code, err)
  assert.is_truthy(err:find(sentence, 1, true), err)
  assert.is_nil(bench:read "never.png")
end

--- Every value of two pictures is alike within 1e-4.
local function alike(a, b)
  local code, out, err = bench:inside(("idiff -fail 1e-4 %s %s"):format(a, b))
  assert.equal(0, code, out .. err)
end

setup(function()
  bench = workbench.new()
  bench:write("config.ocio", CONFIGURATION)
  bench:write("named.ocio", NAMED)
  bench:write("ramp.lua", RAMP)
end)

teardown(function() bench:remove() end)

describe("a space of a configuration", function()
  it_agrees("has the numbers that ocioconvert makes of the light", function()
    bench:write("opaque.lua", (RAMP:gsub("#0f08", "#0f0")))
    rendered("opaque.lua", "--depth float -o light.exr")
    local judge = "OCIO=named.ocio ocioconvert "
    for _, space in ipairs { "acescg", "coded", "logarithmic" } do
      assert.equal(0, (bench:inside(judge .. "light.exr light judged.exr " .. space)))
      for _, configuration in ipairs { "config.ocio", "named.ocio" } do
        rendered("opaque.lua", ("--depth float --ocio %s --colour %s -o made.exr"):format(
          configuration, space))
        alike("made.exr", "judged.exr")
      end
    end
    assert.equal(0, (bench:inside(judge .. "--view light.exr light judged.exr screen film")))
    rendered("opaque.lua", "--depth float --ocio config.ocio --view film -o made.exr")
    alike("made.exr", "judged.exr")
  end)

  it_writes("is celspan's own where it has the same curve, whatever the alpha is", function()
    rendered("ramp.lua", "-o own.png")
    rendered("ramp.lua", "--ocio config.ocio --colour coded -o made.png")
    local code, out = bench:celspan_inside("%s", "compare own.png made.png --fail 0.004")
    assert.equal(0, code, out)
    rendered("ramp.lua", "--ocio config.ocio --colour srgb -o same.png")
    assert.equal(bench:read "own.png", bench:read "same.png")
  end)

  it_writes("is named in the file, and is the same under --strict", function()
    rendered("ramp.lua", "--ocio config.ocio --display wall -o made.png")
    assert.is_truthy(bench:read("made.png"):find("film on wall (config.ocio)", 1, true))
    assert.is_nil(bench:read("made.png"):find("sRGB", 1, true))
    rendered("ramp.lua", "--strict --ocio config.ocio --display wall -o strict.png")
    assert.equal(bench:read "made.png", bench:read "strict.png")
  end)

  it_writes("decides whether a frame is made again", function()
    rendered("ramp.lua", "--ocio config.ocio --colour coded --resume -o f.####.png")
    local first = bench:read "f.0001.png"
    bench:write("other.ocio", (CONFIGURATION:gsub("gamma: 2.4", "gamma: 2.0")))
    rendered("ramp.lua", "--ocio other.ocio --colour coded --resume -o f.####.png")
    assert.are_not.equal(first, bench:read "f.0001.png")
  end)

  it_reads("decides whether a frame that reads a picture in it is made again", function()
    rendered("ramp.lua", "--depth float --ocio config.ocio --colour logarithmic -o plate.exr")
    bench:write("plate.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 256, 48 }, frames = 1, frame = function()
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 256, 48, texture =
    celspan.picture { file = "plate.exr", colour = "logarithmic" } } } }
end }
]])
    bench:write("mine.ocio", CONFIGURATION)
    local function digest(configuration)
      rendered("plate.lua", "--resume -o p.####.png --ocio " .. configuration)
      return bench:read "p.0001.png"
    end
    local first = digest "mine.ocio"
    bench:write("mine.ocio", (CONFIGURATION:gsub("log_side_slope: 0.25", "log_side_slope: 0.5")))
    local edited = digest "mine.ocio"
    assert.are_not.equal(first, edited)
    assert.equal(first, digest "config.ocio")
  end)

  it_writes("of data leaves the numbers of the light, whatever the configuration's light is",
    function()
      rendered("ramp.lua", "--depth float --alpha straight -o plain.tif")
      rendered("ramp.lua", "--depth float --alpha straight --colour numbers --ocio config.ocio "
        .. "-o data.tif")
      local code, out = bench:celspan_inside("%s", "compare plain.tif data.tif")
      assert.equal(0, code, out)
    end)

  it_writes("shows what is clear over black where the file has no alpha", function()
    bench:write("half.lua", (RAMP:gsub("bar%(0, .-%)", "bar(0, '#fff0', '#fff')", 1)))
    for _, depth in ipairs { "", "--depth 8" } do
      rendered("half.lua", "--ocio config.ocio --colour logarithmic -o clear.dpx " .. depth)
      rendered("half.lua", "--ocio config.ocio --colour logarithmic --background '#000' "
        .. "-o black.dpx " .. depth)
      assert.equal(bench:read("black.dpx"):sub(2049), bench:read("clear.dpx"):sub(2049))
    end
  end)

  it_writes("has a name in the file that ends with a whole character", function()
    local name = "a" .. ("ä"):rep(122) .. ".ocio"
    bench:write(name, CONFIGURATION)
    rendered("ramp.lua", ("--ocio '%s' --colour logarithmic -o named.png"):format(name))
    local text = bench:read("named.png"):match "colour%z%z%z%z%z?(logarithmic %(aä.-)....IDAT"
    assert.is_truthy(text)
    assert.is_truthy(utf8.len(text:match "^logarithmic %(a[\195\164]*"))
  end)

  it_writes("has displays and views that are compared one by one, whatever their case", function()
    rendered("ramp.lua", "--ocio config.ocio --display WALL --view Film -o other.png")
    assert.is_truthy(bench:read("other.png"):find("film on wall (config.ocio)", 1, true))
    refused('config.ocio: has no display "screen", "wall"; it has "screen"',
      [[--ocio config.ocio --display 'screen", "wall']])
  end)

  it("is named in the job of a farm, wherever the configuration is named", function()
    local farm = "farm ramp.lua -o f.####.png --slurm --colour coded"
    local code, given = bench:celspan_inside("%s", farm .. " --ocio config.ocio")
    assert.equal(present.spaces() and 0 or 4, code)
    assert.equal(present.spaces(), given:find("--colour coded --ocio config.ocio", 1, true) ~= nil)
    local inherited = select(2, bench:inside(("OCIO=config.ocio '%s' %s"):format(
      workbench.absolute, farm)))
    assert.equal(given, inherited)
    local plain = "OCIO='' '" .. workbench.absolute .. "' farm ramp.lua -o f.####.png --slurm"
    assert.is_nil(select(2, bench:inside(plain)):find("--ocio", 1, true))
  end)

  it_reads("is read as light, in the confined decoder, under --strict and without both", function()
    bench:write("opaque.lua", (RAMP:gsub("#0f08", "#0f0")))
    rendered("opaque.lua", "--depth float -o light.exr")
    rendered("opaque.lua", "--depth float --ocio config.ocio --colour logarithmic -o log.exr")
    bench:write("back.lua", [[
local celspan = require "celspan"
return celspan.rostrum { size = { 256, 48 }, celspan.cel { celspan.rect { 0, 0, 256, 48, texture =
  celspan.picture { file = "log.exr", colour = "logarithmic", sampling = "nearest" } } } }
]])
    for _, options in ipairs { "", "--strict", "--trust" } do
      rendered("back.lua", "--depth float --ocio config.ocio -o back.exr " .. options)
      local code, out = bench:celspan_inside("%s", "compare light.exr back.exr --fail 1e-4")
      assert.equal(0, code, out)
    end
    local code, _, err = render("back.lua", "-o never.png --ocio missing.ocio")
    assert.equal(3, code)
    assert.is_truthy(err:find("log.exr: missing.ocio: cannot be read", 1, true), err)
  end)

  it_writes("is refused with the file and what it has", function()
    bench:write("broken.ocio", "ocio_profile_version: 2\ncolorspaces: [")
    bench:write("bare.ocio", (CONFIGURATION:gsub("  aces_interchange: aces\n", "")))
    refused("missing.ocio: cannot be read as an OpenColorIO configuration",
      "--ocio missing.ocio --colour coded")
    refused("broken.ocio: cannot be read as an OpenColorIO configuration",
      "--ocio broken.ocio --colour coded")
    refused("bare.ocio: does not say which of its spaces is linear light in the primaries of "
      .. "BT.709", "--ocio bare.ocio --colour coded")
    refused('config.ocio: has no colour space "nowhere"', "--ocio config.ocio --colour nowhere")
    refused('config.ocio: has no display "tv"; it has "screen", "wall", "sRGB wall", '
      .. '"cinema (P3-D65)"', "--ocio config.ocio --display tv")
    refused('config.ocio: has no view "raw"; it has "film"',
      "--ocio config.ocio --display wall --view raw")
    refused("--colour and --view both say", "--ocio config.ocio --view film --colour srgb")
    refused("none is named by --ocio or OCIO", "--colour coded")
    refused("openexr with layers takes no --view",
      "--ocio config.ocio --view film --layers cels --format openexr")
    refused("name one with --ocio or OCIO", "--view film")
  end)

  --- A configuration of one linear space and one for screens, with these lines.
  local function plain(linear, screen)
    return ([[ocio_profile_version: 2
roles: {default: coded, scene_linear: linear}
displays:
  screen:
    - !<View> {name: film, colorspace: coded}
colorspaces:
  - !<ColorSpace> {name: linear, description: %q}
  - !<ColorSpace>
    name: coded
    aliases: [%s]
    from_reference: !<ExponentTransform> {value: 2.2, direction: inverse}
]]):format(linear, screen)
  end

  it_writes("takes scene_linear for BT.709 only where something says so", function()
    local arguments = "--ocio plain.ocio --colour coded -o %s.png"
    for i, case in ipairs { { "of the mp3 show, in the gamut: sRGB", "none" },
                            { "Rec.709 light", "none" }, { "light", "sRGB" } } do
      bench:write("plain.ocio", plain(case[1], case[2]))
      rendered("ramp.lua", arguments:format("plain" .. i))
    end
    for _, case in ipairs { { "", "none" }, { "ACEScg", "sRGB" }, { "P3 sRGB", "sRGB" },
                            { "Linear ARRI Wide Gamut 3 for sRGB", "none" } } do
      bench:write("plain.ocio", plain(case[1], case[2]))
      refused("plain.ocio: does not say which of its spaces is linear light",
        "--ocio plain.ocio --colour coded")
    end
    bench:write("plain.ocio", (plain("light", "sRGB"):gsub("!<ExponentTransform>[^\n]*",
      "!<MatrixTransform> {matrix: [.9, .1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}")))
    refused("plain.ocio: does not say which of its spaces is linear light",
      "--ocio plain.ocio --colour coded")
  end)

  it_reads("is made of its configuration once for all files of a film", function()
    local more = {}
    for i = 1, 1500 do
      more[i] = ("  - !<ColorSpace>\n    name: more%d\n    from_reference: !<ExponentTransform> "
        .. "{value: 2.2, direction: inverse}\n"):format(i)
    end
    bench:write("large.ocio", CONFIGURATION .. table.concat(more))
    rendered("ramp.lua", "--depth float --ocio config.ocio --colour logarithmic -o many.1.exr")
    for i = 2, 12 do bench:write(("many.%d.exr"):format(i), bench:read "many.1.exr") end
    bench:write("many.lua", [[
local celspan = require "celspan"
local count, cels = celspan.parameters { count = { 1, min = 1, max = 12 } }.count, {}
for i = 1, count do
  cels[i] = celspan.cel { celspan.rect { i * 8, 0, 8, 8, texture =
    celspan.picture { file = ("many.%d.exr"):format(i // 1), colour = "logarithmic" } } }
end
return celspan.rostrum { size = { 128, 8 }, table.unpack(cels) }
]])
    --- Seconds of the processor.
    local function cost(count)
      local code, out, err = bench:inside(("'%s' render many.lua --trust --workers 1 --progress "
        .. "none --ocio large.ocio -o many.png --set count=%d && times"):format(workbench.absolute,
        count))
      assert.equal(0, code, err)
      return tonumber(out:match "([%d.]+)s [%dm.]+s\n$")
    end
    assert.is_true(cost(12) < 2 * cost(1))
  end)

  it_reads("is not known where OCIO is empty", function()
    bench:write("log.lua", [[
local celspan = require "celspan"
return celspan.rostrum { size = { 256, 48 }, celspan.cel { celspan.rect { 0, 0, 256, 48, texture =
  celspan.picture { file = "log.exr", colour = "logarithmic" } } } }
]])
    local code, _, err = bench:inside(("OCIO= '%s' render log.lua -o never.png"):format(
      workbench.absolute))
    assert.equal(3, code)
    assert.is_truthy(err:find('colour is "logarithmic"; it must be "srgb"', 1, true), err)
  end)

  it("needs a module, which is missed only where a space is named", function()
    local function without(arguments)
      return bench:inside(("CELSPAN_SPACE_MODULE=/nowhere.so '%s' render ramp.lua --progress none "
        .. "--size 256x48 --ocio config.ocio %s"):format(workbench.absolute, arguments))
    end
    local code, _, err = without "--colour coded -o never.png"
    assert.equal(4, code, err)
    assert.is_truthy(err:find("celspan-space.so", 1, true), err)
    assert.equal(0, (without "--colour linear -o linear.png"))
  end)
end)

describe("a video", function()
  local it_tells = present.spaces() and present.program("ffmpeg", "ffprobe") and it or pending

  local function tags(arguments)
    rendered("ramp.lua", "-o out.mp4 --ocio config.ocio " .. arguments)
    local code, out = bench:inside("ffprobe -v error -select_streams v -show_entries "
      .. "stream=color_space,color_transfer,color_primaries -of csv=p=0 out.mp4")
    assert.equal(0, code)
    return out
  end

  it_tells("has tags that say what its numbers are", function()
    assert.equal("bt709,iec61966-2-1,bt709\n", tags "--colour coded")
    assert.equal("bt709,bt470m,smpte432\n", tags "--colour wide")
    assert.equal("bt709,bt709,bt709\n", tags "--display wall")
    assert.equal("bt709,iec61966-2-1,bt709\n", tags "--display 'sRGB wall'")
    assert.equal("bt709,iec61966-2-1,bt709\n", tags "--colour srgb")
  end)

  it_writes("is refused where no tags could say so", function()
    local function refused_video(sentence, file, arguments)
      local code, _, err = render("ramp.lua", ("-o %s --ocio config.ocio %s"):format(file,
        arguments))
      assert.equal(2, code, err)
      assert.is_truthy(err:find(sentence, 1, true), err)
      assert.is_nil(bench:read(file))
    end
    for _, space in ipairs { "acescg", "logarithmic", "filmic" } do
      refused_video(('never.mp4: the tags of a video cannot say what the colours of "%s" are')
        :format(space), "never.mp4", "--colour " .. space)
      refused_video(('never.apng: such a file has no tags that say what the colours of "%s" are')
        :format(space), "never.apng", "--colour " .. space .. " --frames 1,1")
    end
    refused_video('never.apng: such a file has no tags that say what the colours of "wide" are',
      "never.apng", "--colour wide --frames 1,1")
    refused_video("the view film on cinema (P3-D65) is for a display of other primaries",
      "never.mp4", "--display 'cinema (P3-D65)'")
  end)
end)

describe("what a file says of its colours", function()
  --- A film of a whole picture, read as the file says.
  local function show(file)
    bench:write("show.lua", ([[
local celspan = require "celspan"
return celspan.rostrum { size = { 256, 48 }, celspan.cel { celspan.rect { 0, 0, 256, 48, texture =
  celspan.picture { file = %q, sampling = "nearest" } } } }
]]):format(file))
    return "show.lua"
  end

  local function facts(file)
    local code, out, err = bench:celspan_inside("%s", "info " .. file)
    assert.equal(0, code, err)
    return out
  end

  it_reads("is its primaries, in OpenEXR, with another white", function()
    rendered("ramp.lua", "--depth float -o light.exr")
    rendered("ramp.lua", "--depth float --ocio config.ocio --colour acescg -o acescg.exr")
    assert.is_truthy(facts "light.exr":find("colour linear\ncolour_from file\nprimaries BT.709\n"
      .. "chromaticities 0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329\n", 1, true))
    assert.is_truthy(facts "acescg.exr":find("colour linear\ncolour_from format\n"
      .. "space acescg (config.ocio)\nprimaries ACES AP1\nchromaticities 0.713 0.293 0.165 0.83 "
      .. "0.128 0.044 0.32168 0.33767\n", 1, true))
    for _, rights in ipairs { "", "--trust" } do
      rendered(show "acescg.exr", "--depth float -o back.exr " .. rights)
      local code, out = bench:celspan_inside("%s", "compare light.exr back.exr --fail 1e-4")
      assert.equal(0, code, out)
    end
  end)

  --- A PNG with a text in it, as ImageMagick writes with -set.
  local function with_text(bytes, keyword, text)
    local body, crc = "tEXt" .. keyword .. "\0" .. text, 0xffffffff
    for i = 1, #body do
      crc = crc ~ body:byte(i)
      for _ = 1, 8 do crc = crc >> 1 ~ (crc & 1) * 0xedb88320 end
    end
    return bytes:sub(1, 33) .. (">I4"):pack(#body - 4) .. body
      .. (">I4"):pack(crc ~ 0xffffffff) .. bytes:sub(34)
  end

  it_reads("is named by a PNG of celspan alone, with both modules", function()
    rendered("ramp.lua", "--background '#000' --ocio config.ocio --colour wide -o wide.png")
    rendered("ramp.lua", "--background '#000' -o plain.png")
    local raster = workbench.build .. "/src/kit/plugins/raster/celspan-raster.so"
    local modules = { "" }
    if present.program(raster) then modules[2] = "CELSPAN_PICTURE_MODULE='" .. raster .. "' " end
    for _, module in ipairs(modules) do
      local function said(file)
        local code, out, err = bench:inside(("%s'%s' info %s"):format(module, workbench.absolute,
          file))
        assert.equal(0, code, err)
        return out
      end
      assert.is_truthy(said "wide.png":find("colour srgb\ncolour_from format\n"
        .. "space wide (config.ocio)\n", 1, true), said "wide.png")
      for _, other in ipairs { { "colour", "rec709" }, { "colour", "linear" }, { "colour", "srgb" },
        { "Colour", "RGB" } } do
        bench:write("other.png", with_text(bench:read "plain.png", table.unpack(other)))
        local same = said("plain.png"):gsub("bytes %d+", "")
        assert.equal(same, (said("other.png"):gsub("bytes %d+", "")))
      end
    end
  end)

  it_reads("is a space that can only be read with its configuration", function()
    rendered("ramp.lua", "--depth float --background '#000' -o light.exr")
    for _, file in ipairs { "log.exr", "log.dpx" } do
      rendered("ramp.lua", "--background '#000' --ocio config.ocio --colour logarithmic "
        .. (file == "log.exr" and "--depth float -o " or "-o ") .. file)
      assert.is_truthy(facts(file):find("colour other\ncolour_from file\n"
        .. "space logarithmic (config.ocio)\n", 1, true))
      local code, _, err = render(show(file), "-o never.png")
      assert.equal(4, code)
      assert.is_truthy(err:find(file .. ': its colours are in "logarithmic (config.ocio)"', 1,
        true), err)
      rendered(show(file), "--depth float --ocio config.ocio -o back.exr")
      local fail = file == "log.exr" and "1e-4" or "0.11" -- the curve is cut off near black
      local ok, out = bench:celspan_inside("%s", "compare light.exr back.exr --fail " .. fail)
      assert.equal(0, ok, out)
    end
  end)

  it_reads("is refused where it is no light", function()
    rendered("ramp.lua", "--depth float -o light.exr")
    local bytes = bench:read "light.exr"
    local at = select(2, bytes:find("chromaticities\0chromaticities\0\32\0\0\0", 1, true))
    bench:write("broken.exr", bytes:sub(1, at) .. ("\0"):rep(32) .. bytes:sub(at + 33))
    local code, _, err = render(show "broken.exr", "-o never.png")
    assert.equal(4, code)
    assert.is_truthy(err:find("broken.exr: its chromaticities are those of no light", 1, true), err)
    local _, _, checked = bench:celspan_inside "check show.lua"
    assert.is_truthy(checked:find("broken.exr: its chromaticities", 1, true), checked)
    assert.is_truthy(facts "broken.exr":find("\nprimaries none\nbytes", 1, true))
  end)
end)
