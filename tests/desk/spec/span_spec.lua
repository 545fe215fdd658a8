-- Span files at the command line.

local present = require "tests.support.present"
local scenes = require "tests.support.span_scenes"
local workbench = require "tests.support.workbench"

local bench

local function write(name, text) return bench:write(name, text) end
local function read(name) return bench:read(name) end
local function shell(command) return bench:inside(command) end
local function celspan(arguments) return bench:celspan_inside("%s", arguments) end

local function done(arguments)
  local code, out, err = celspan(arguments)
  assert.equal(0, code, err)
  return out
end

-- Pictures that are not PNG or span files need the picture module.
local it_reads_pictures = present.pictures() and it or pending

local SCENE, OPAQUE = scenes.clear, scenes.opaque

-- Too much work for half a second.
local MANY = [[
local celspan = require "celspan"
local discs = {}
for i = 1, 400 do
  discs[i] = celspan.circle{ centre = {i * 37 % 100, i * 61 % 100}, radius = 3 + i % 17,
                             texture = celspan.rgb(i % 7 / 7, i % 5 / 5, i % 3 / 3, 0.5) }
end
return celspan.film{ size = {100, 100}, frames = 1, frame = function(f)
  return celspan.rostrum{ celspan.cel(discs) }
end }
]]

setup(function()
  bench = workbench.new()
  write("scene.lua", SCENE)
  write("opaque.lua", OPAQUE)
  done("render scene.lua -o scene.span --progress none")
  done("render scene.lua -o half.span --depth half --progress none")
  done("render scene.lua -o scene.png --progress none")
end)

teardown(function() bench:remove() end)

describe("a span file", function()
  it("has the same bytes with any number of workers, and so have its parts #workers", function()
    write("parts.lua", [[
local celspan = require "celspan"
local ramp = celspan.linear { from = { 0, 0 }, to = { 90, 70 }, { 0, "#f00" }, { 1, "#0000ff80" } }
return celspan.film { size = { 100, 100 }, frames = 1, frame = function()
  return celspan.rostrum { celspan.cel {
    celspan.circle { centre = { 40, 45 }, radius = 38, texture = "#ffcc0080" },
    celspan.rect { 20, 10, 60, 85, texture = ramp }:rotate(20, 50, 50) } }
end }]])
    for _, height in ipairs { 100, 256, 257, 900 } do
      local size = ("--progress none --size 300x%d"):format(height)
      done(("render parts.lua %s --workers 1 -o one.span"):format(size))
      local one = read "one.span"
      for _, workers in ipairs { 2, 3, 5 } do
        done(("render parts.lua %s --workers %d -o some.span"):format(size, workers))
        assert.is_true(one == read "some.span", ("%d rows, %d workers"):format(height, workers))
      end
    end
  end)

  it("contains the same pixels after conversion to another span file", function()
    for _, name in ipairs { "scene", "half" } do
      done(("convert %s.span again.span%s"):format(name, name == "half" and " --depth half" or ""))
      done(("compare %s.span again.span"):format(name))
    end
  end)

  it_reads_pictures("equals the same frame as PNG and as EXR", function()
    done("compare scene.span scene.png")
    done("render scene.lua -o scene.exr --progress none")
    done("compare half.span scene.exr")
    done("convert scene.png from-png.span")
    assert.equal(0, (celspan("compare from-png.span scene.span")))
  end)

  it("is described by info", function()
    local out = done("info scene.span")
    assert.truthy(out:find("format span\nsize 300x200\ndepth 8\n", 1, true), out)
    local rows = 0
    for count in out:gmatch("rows_%a+ (%d+)") do rows = rows + tonumber(count) end
    assert.equal(200, rows)
    assert.truthy(done("info half.span"):find("depth half", 1, true))
  end)

  it("is recognised by its content, not by its name", function()
    write("named.png", read "scene.span")
    done("compare named.png scene.span")
  end)

  it("is distinguished from another by compare", function()
    done("render opaque.lua -o opaque.span --progress none")
    assert.equal(1, (celspan("compare scene.span opaque.span")))
    done("render opaque.lua -o opaque-half.span --depth half --progress none")
    -- One is rounded to half a code of 8 bits, the other to 2^-12 of its value.
    done("compare opaque.span opaque-half.span --fail 0.0023")
    assert.equal(1, (celspan("compare opaque.span opaque-half.span")))
  end)

  it("can be read in any part", function()
    done("render scene.lua -o part.span --crop 100,30,90,140 --progress none")
    done("convert scene.span cropped.span --crop 100,30,90,140")
    done("compare part.span cropped.span")
  end)

  it_reads_pictures("is scaled like other pictures", function()
    done("render opaque.lua -o opaque.span --progress none")
    done("render opaque.lua -o opaque.png --progress none")
    for _, size in ipairs { "60x45", "53x41", "240x180", "50x300", "300x50", "120x50", "1x1" } do
      done("convert opaque.span a.span --size " .. size)
      done("convert opaque.png b.png --size " .. size)
      local code, out = celspan("compare a.span b.png --fail 0.005")
      assert.equal(0, code, size .. ": " .. out)
    end
  end)

  it("is refused if it is truncated or altered, with the byte and the reason", function()
    local whole = read "scene.span"
    write("cut.span", whole:sub(1, -2))
    local middle = #whole // 2
    write("altered.span", whole:sub(1, middle) .. string.char(whole:byte(middle + 1) ~ 1)
      .. whole:sub(middle + 2))
    for name, pattern in pairs { cut = "cut.span: byte %d+: cut",
      altered = "altered.span: byte %d+: row %d+: " } do
      for _, verb in ipairs { "info %s.span", "convert %s.span out.span",
        "compare %s.span scene.span" } do
        local code, _, err = celspan(verb:format(name))
        assert.equal(4, code, err)
        assert.truthy(err:match("^celspan: error: " .. pattern), err)
        assert.is_nil(read "out.span")
      end
    end
  end)

  it("can have two depths", function()
    local code, _, err = celspan("render scene.lua -o deep.span --depth 16 --progress none")
    assert.equal(2, code, err)
    assert.truthy(err:find("span files hold depth 8", 1, true), err)
    assert.is_nil(read "deep.span")
  end)

  it("leaves no file under its name if it cannot be finished", function()
    local function leaves_nothing() return #bench:files "out" == 0 end
    write("many.lua", MANY)
    assert(os.execute("mkdir '" .. bench.folder .. "/out'"))
    local arguments = "' render many.lua -o out/x.span --size 1000000x1000000 --progress none"
    local code, _, err = shell("ulimit -f 4; '" .. workbench.absolute .. arguments
      .. " --crop 0,0,1000000,9000")
    assert.equal(5, code, err)
    assert.truthy(err:find("out/x.span: cannot write", 1, true), err)
    assert.is_true(leaves_nothing())
    code = shell("timeout -s INT 0.5 '" .. workbench.absolute .. arguments)
    assert.equal(124, code)
    assert.is_true(leaves_nothing())
  end)

  it("may be a million pixels wide or high", function()
    for _, size in ipairs { "1000000x1", "1x1000000" } do
      done("render opaque.lua -o long.span --progress none --size " .. size)
      assert.truthy(done("info long.span"):find("size " .. size, 1, true))
    end
  end)
end)
