-- The picture module for where OpenImageIO is missing, beside the one over OpenImageIO: what both
-- read and write is the same, and damaged files are refused.
local profile = require "tests.support.profile"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local RASTER = workbench.build .. "/src/plugins/raster/celspan-raster.so"
local WITH = "CELSPAN_PICTURE_MODULE='" .. RASTER .. "' "

if not present.program(RASTER) then return pending "the raster module was not built" end

local FILM = [[
local celspan = require "celspan"
local sky = celspan.linear { from = { 0, 0 }, to = { 61, 37 }, { 0, "#123" }, { 1, "#f84" } }
return celspan.film { size = { 61, 37 }, frames = 1, frame = function()
  local card = celspan.rect { 3, 2, 50, 30, radius = 9, texture = sky }
  return celspan.rostrum { celspan.cel { card } }
end }
]]
local ALPHA = "--background '#fff'"

local bench

before_each(function()
  bench = workbench.new()
  bench:write("film.lua", FILM)
end)

after_each(function() bench:remove() end)

--- Runs celspan in the folder with one of the two modules.
local function run(with, format, ...)
  return bench:inside((with .. "'" .. workbench.absolute .. "' " .. format):format(...))
end

local function good(with, format, ...)
  local code, out, err = run(with, format, ...)
  assert.equal(0, code, err)
  return out
end

--- The pixels of a file as a PNG of 16 bits, by a module.
local function pixels(with, name)
  good(with, "convert %s seen.png --depth 16", name)
  return bench:read "seen.png"
end

local cases = { -- the file, and how it is written
  { "a.jpg", ALPHA }, { "a.webp", ALPHA }, { "a.tif", "" }, { "b.tif", "--depth 16" },
  { "c.tif", "--depth float" }, { "d.tif", "--alpha premultiplied" }, { "a.exr", "" },
  { "b.exr", "--depth float" }, { "c.exr", "--colour srgb" }, { "a.png", "" },
  { "b.png", "--depth 16" },
}

describe("the picture module without OpenImageIO", function()
  local it_compares = present.pictures() and it or pending

  it_compares("reads what OpenImageIO writes, as OpenImageIO does", function()
    for _, case in ipairs(cases) do
      good("", "render film.lua -o %s --progress none %s", case[1], case[2])
      assert.is_true(pixels("", case[1]) == pixels(WITH, case[1]), case[1])
      local facts = "info " .. case[1]
      assert.equal(good("", facts):gsub("\n.*", ""), good(WITH, facts):gsub("\n.*", ""))
    end
  end)

  it_compares("writes what OpenImageIO reads as it was written", function()
    for _, case in ipairs(cases) do
      good(WITH, "render film.lua -o %s --progress none %s", case[1], case[2])
      local own = pixels("", case[1])
      assert.is_true(own == pixels(WITH, case[1]), case[1])
      good("", "render film.lua -o %s --progress none %s", case[1], case[2])
      assert.is_true(own == pixels("", case[1]), case[1])
    end
  end)

  local it_makes = present.program "oiiotool" and it_compares or pending
  it_makes("reads windows that cover a part, and planes that lie on their side", function()
    good("", "render film.lua -o a.exr --progress none %s", ALPHA)
    good("", "render film.lua -o a.tif --progress none %s", ALPHA)
    for name, command in pairs {
      ["cut.exr"] = "a.exr --ch R,G,B --fullsize 80x50-5-4",
      ["side.tif"] = "a.tif --attrib Orientation 6 --attrib planarconfig separate" } do
      local code, _, err = bench:inside(("oiiotool %s -o %s"):format(command, name))
      assert.equal(0, code, err)
      assert.is_true(pixels("", name) == pixels(WITH, name), name)
    end
  end)

  it("names profiles", function()
    local bytes = profile.of(profile.wide "wide \u{e9}", 4)
    for kind, add in pairs { png = profile.png, jpg = profile.jpeg } do
      good(WITH, "render film.lua -o a.%s %s", kind, ALPHA)
      bench:write("b." .. kind, add(bench:read("a." .. kind), bytes))
      local said = good(WITH, "info b.%s", kind)
      assert.truthy(said:find("\nprofile wide \u{e9}\nprimaries_taken bt709\n", 1, true), said)
    end
  end)

  it("refuses other formats with a sentence", function()
    local code, _, err = run(WITH, "render film.lua -o a.dpx")
    assert.equal(5, code)
    assert.truthy(err:find("the format dpx is written by OpenImageIO alone", 1, true), err)
    code, _, err = run(WITH, "render film.lua -o a.tif --size 20000x20000")
    assert.is_true(code > 0)
    assert.truthy(err:find("268435456 pixels are written without OpenImageIO", 1, true), err)
    bench:write("a.psd", "8BPS")
    code, _, err = run(WITH, "info a.psd")
    assert.equal(4, code)
    assert.truthy(err:find("(png, jpeg, webp, tiff, openexr)", 1, true) or err ~= "", err)
  end)

  it("refuses files that are cut off or damaged, and never crashes", function()
    local draw = 1
    for _, case in ipairs(cases) do
      good(WITH, "render film.lua -o %s --progress none %s", case[1], case[2])
      local whole = bench:read(case[1])
      for part = 1, 3 do
        local cut = whole:sub(1, #whole * part // 4)
        bench:write(case[1], cut)
        local code, _, err = run(WITH, "convert %s seen.png", case[1])
        assert.equal(4, code, ("%s of %d bytes: %s"):format(case[1], #cut, err))
        assert.falsy(err:find("signal", 1, true), err)
        draw = draw * 16807 % 2147483647
        local at = draw % #whole + 1
        bench:write(case[1], whole:sub(1, at - 1) .. string.char(draw // 256 % 256)
          .. whole:sub(at + 1))
        code, _, err = run(WITH, "convert %s seen.png", case[1])
        assert.truthy(code == 0 or code == 4 or code == 6, err)
        assert.falsy(err:find("signal", 1, true), err)
      end
    end
  end)

  it("is taken where the other one cannot be loaded", function()
    bench:inside(("mkdir -p bin lib/celspan && cp '%s' bin && cp '%s' lib/celspan && "
      .. "echo none >lib/celspan/celspan-picture.so"):format(workbench.absolute, RASTER))
    good("", "render film.lua -o a.tif --progress none")
    local code, out, err = bench:inside "bin/celspan info a.tif"
    assert.same({ 0, "" }, { code, err })
    assert.truthy(out:find("tiff", 1, true), out)
  end)
end)
