-- Span and plane files in programs built on OpenImageIO, which open them with plug-ins of ours.
local celspan = require "celspan"
local present = require "tests.support.present"
local scenes = require "tests.support.span_scenes"
local workbench = require "tests.support.workbench"

local it_opens = present.pictures() and present.program "oiiotool" and it or pending

local bench

local function done(arguments)
  local code, out, err = bench:celspan_inside("%s", arguments)
  assert.equal(0, code, err)
  return out
end

local function oiiotool(arguments)
  return bench:inside(("OIIO_LIBRARY_PATH='%s' oiiotool %s")
    :format(workbench.build .. "/src/kit/plugins/oiio/plugin", arguments))
end

local function opened(arguments)
  local code, out, err = oiiotool(arguments)
  assert.equal(0, code, out .. err)
  return out
end

--- Fails with an exit code, not a signal, and writes nothing.
local function refused(message, arguments)
  local code, out, err = oiiotool(arguments .. " -o never.exr")
  assert.is_true(code > 0 and code < 128, arguments .. ": " .. code)
  assert.matches(message, out .. err)
  assert.is_nil(bench:read "never.exr")
end

local SCENE, OPAQUE = scenes.clear, scenes.opaque

setup(function()
  bench = workbench.new()
  bench:write("scene.lua", SCENE)
  bench:write("opaque.lua", OPAQUE)
  for _, made in ipairs { "scene.lua -o scene.span", "scene.lua -o half.span --depth half",
    "scene.lua -o scene.plane", "opaque.lua -o opaque.span" } do
    done("render --progress none " .. made)
  end
end)

teardown(function() bench:remove() end)

describe("a span file in OpenImageIO #plain", function()
  it_opens("has the pixels of the file", function()
    done("render opaque.lua -o opaque.tif --progress none")
    done("render scene.lua -o scene.exr --progress none")
    done("render scene.lua -o scene.png --progress none")
    for _, pair in ipairs { "opaque.span opaque.tif", "half.span scene.exr" } do
      opened(pair .. " --diff")
    end
    opened("--iconfig oiio:UnassociatedAlpha 1 scene.span "
      .. "--iconfig oiio:UnassociatedAlpha 1 scene.png --diff")
  end)

  it_opens("is described", function()
    local out = opened("--info -v scene.span half.span")
    assert.truthy(out:find("300 x  200, 4 channel, uint8 span", 1, true), out)
    assert.truthy(out:find("300 x  200, 4 channel, half span", 1, true), out)
    assert.truthy(out:find('oiio:ColorSpace: "sRGB"', 1, true), out)
  end)

  it_opens("is read in any order of rows", function()
    opened("half.span --cut 300x1+0+150 -o row.exr half.span --flip --flop "
      .. "-o turned.exr row.exr half.span --cut 300x1+0+150 --diff")
  end)

  it_opens("is read in part where it is too large for memory", function()
    done("render opaque.lua -o large.span --size 1000000x1000000 --progress none")
    done("convert large.span part.span --crop 166700,499900,300,200")
    opened("large.span --cut 300x200+166700+499900 -o part.tif")
    done("compare part.span part.tif")
  end)

  it_opens("is refused if it is truncated", function()
    bench:write("cut.span", bench:read("scene.span"):sub(1, -2))
    refused("cut: there is no trailer at the end", "cut.span")
  end)
end)

describe("a plane file in OpenImageIO #plain", function()
  --- Compares, to the bit, with what celspan draws of the whole or of a crop.
  local function equals_drawn(read, size, crop)
    done(("convert scene.plane drawn.exr --depth float --size %s%s")
      :format(size, crop and " --crop " .. crop or ""))
    opened(read .. " drawn.exr --fail 0 --diff")
  end

  it_opens("has a pixel for each unit, or the size of the hints", function()
    equals_drawn("scene.plane", "300x200")
    equals_drawn("--iconfig plane:width 411 --iconfig plane:height 500 scene.plane", "411x500")
    equals_drawn("--iconfig plane:width 150 scene.plane", "150x100")
    equals_drawn("--iconfig plane:height 3 scene.plane", "5x3")
    equals_drawn("--iconfig plane:height 1 --iconfig plane:width 1 scene.plane", "1x1")
  end)

  it_opens("has at least one pixel where its frame is small", function()
    local disc = celspan.circle { centre = { 4, 0 }, radius = 3 }
    local thin = celspan.rostrum { celspan.cel { disc } }
    local plane = assert(celspan.plane(thin, { film = { 7.6, 0.2 } }))
    assert(plane:write(bench.folder .. "/thin.plane"))
    local out = opened("--info thin.plane")
    assert.truthy(out:find("8 x    1, 4 channel, float plane", 1, true), out)
  end)

  it_opens("has hints in its name", function()
    equals_drawn("'scene.plane?plane:width=411&plane:height=500'", "411x500")
    bench:write("odd.plane?plane:width=9", bench:read "scene.plane")
    equals_drawn("'odd.plane?plane:width=9'", "300x200")
  end)

  it_opens("is described", function()
    local out = opened("--info -v scene.plane")
    assert.truthy(out:find("300 x  200, 4 channel, float plane", 1, true), out)
    assert.truthy(out:find('oiio:ColorSpace: "Linear"', 1, true), out)
    assert.truthy(out:find("channel list: R, G, B, A", 1, true), out)
  end)

  it_opens("is recognised by its content", function()
    bench:write("named.bin", bench:read "scene.plane")
    equals_drawn("named.bin", "300x200")
  end)

  -- Pictures of more than 50 MB go through the cache, in strips of 64 rows, the last one first.
  it_opens("is drawn in any order of rows", function()
    equals_drawn("--autotile 64 --cache 1 'scene.plane?plane:width=2400' --flip -o turned.exr "
      .. "turned.exr --flip", "2400x1600")
    equals_drawn("--autotile 64 --cache 1 'scene.plane?plane:width=2400' --cut 1000x70+900+1300",
      "2400x1600", "900,1300,1000,70")
  end)

  it_opens("is drawn in part where it is too large for memory", function()
    local large, size = "'scene.plane?plane:width=999999' --cut ", "999999x666666"
    equals_drawn(large .. "700x600+665400+134000", size, "665400,134000,700,600")
    equals_drawn(large .. "600x300+999399+666366", size, "999399,666366,600,300")
    -- Two tiles that touch at a corner, where the disc has its edge.
    equals_drawn(large .. "200x200+665400+133900 " .. large .. "200x200+665610+134150", size,
      "665610,134150,200,200")
  end)

  it_opens("is refused at a size that is wrong or too large", function()
    local message = "plane:width must be 1 to 2147483647 pixels"
    for _, side in ipairs { "0", "-3", "x", "2.5" } do
      refused(message, ("--iconfig plane:width %s scene.plane"):format(side))
    end
    refused(message, "--iconfig plane:height 2147483647 scene.plane")
    for _, size in ipairs { "134217728 1", "12000000 12000000" } do
      local width, height = size:match "(%d+) (%d+)"
      refused(("%d x %d pixels are more than OpenImageIO supports"):format(width, height),
        ("--iconfig plane:width %d --iconfig plane:height %d scene.plane"):format(width, height))
    end
    opened "--info 'scene.plane?plane:width=11000000&plane:height=11000000'"
  end)

  it_opens("has frames, of which one is chosen", function()
    bench:write("film.lua", (OPAQUE:gsub("frames = 1", "frames = 3")
      :gsub("40.3", "10 * f.number")))
    done("render film.lua -o film.plane --progress none")
    for frame = 1, 3 do
      done(("convert film.plane frame.exr --size 120x90 --depth float --frame %d"):format(frame))
      opened(("'film.plane?plane:frame=%d' frame.exr --fail 0 --diff"):format(frame))
    end
    opened("film.plane 'film.plane?plane:frame=1' --fail 0 --diff")
    for _, frame in ipairs { "0", "-1", "4", "2147483647" } do
      refused("plane:frame must be the number of a frame in the file",
        ("--iconfig plane:frame %s film.plane"):format(frame))
    end
  end)

  it_opens("is refused if it is truncated or altered, with the byte and the reason", function()
    local whole = bench:read "scene.plane"
    for at = 1, #whole, #whole // 12 do
      bench:write("cut.plane", whole:sub(1, at))
      refused(at < 9 and "cut.plane" or "cut.plane\": byte %d+: the file", "cut.plane")
      bench:write("altered.plane", whole:sub(1, at - 1) .. string.char(whole:byte(at) ~ 4)
        .. whole:sub(at + 1))
      refused("altered.plane\": byte %d+: ", "altered.plane")
    end
  end)
end)
