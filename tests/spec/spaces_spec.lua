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
    refused('config.ocio: has no display "tv"; it has "screen", "wall"',
      "--ocio config.ocio --display tv")
    refused('config.ocio: has no view "raw"; it has "film"',
      "--ocio config.ocio --display wall --view raw")
    refused("--colour and --view both say", "--ocio config.ocio --view film --colour srgb")
    refused("none is named by --ocio or OCIO", "--colour coded")
    refused("--layers are in linear light: leave --display and --view out",
      "--ocio config.ocio --view film --layers cels --format openexr")
    refused("name one with --ocio or OCIO", "--view film")
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
