-- The files that celspan writes itself, PNG and Targa, as other programs read them.

local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local bench

local function read(path) return bench:read(path) end
local function shell(command) return bench:inside(command) end
local function celspan(arguments) return bench:celspan_inside("%s", arguments) end

local has_oiiotool = present.program "oiiotool"
local it_reads = has_oiiotool and it or pending

-- TIFF files need the picture module.
local it_reads_pictures = has_oiiotool and present.pictures() and it or pending

-- Flat shapes, a gradient and a clear part; with a back light, every pixel is opaque.
local SCENE = [[
local celspan = require "celspan"
local back = ...
return celspan.film{ size = {700, 900}, frames = 1, frame = function()
  local shapes = {}
  for i = 1, 40 do
    shapes[i] = celspan.circle{ centre = {i * 97 % 700, i * 61 % 900}, radius = 20 + i * 13 % 90,
      texture = celspan.rgb(i % 7 / 7, i % 5 / 5, i % 3 / 3, 0.3 + i % 4 / 5) }
  end
  shapes[41] = celspan.rect{ 100, 500, 500, 300, texture = celspan.gradient{
    { 100, 500, celspan.rgb(1, 0, 0) }, { 600, 500, celspan.rgb(0, 1, 0, 0.5) },
    { 100, 800, celspan.rgb(0, 0, 1) } } }
  return celspan.rostrum{ celspan.cel(shapes), back = back == "lit" and {1, 1, 1, 1} or nil }
end }
]]

local function render(out, lit, options)
  return celspan(("render scene.lua -o %s --progress none %s %s"):format(out, options or "",
    lit and "-- lit" or ""))
end

describe("PNG and Targa files", function()
  setup(function()
    bench = workbench.new()
    bench:write("scene.lua", SCENE)
  end)

  teardown(function() bench:remove() end)

  it_reads("contain the same pixels", function()
    for _, lit in ipairs { false, true } do
      assert.are.same({ 0, "", "" }, { render("a.png", lit) })
      assert.are.same({ 0, "", "" }, { render("a.tga", lit) })
      local code, out = shell("oiiotool a.png a.tga --diff")
      assert.are.equal(0, code, out)
    end
  end)

  it_reads("leave out an alpha that is 1 everywhere", function()
    for _, name in ipairs { "b.png", "b.tga" } do
      render(name, true)
      local _, out = shell("oiiotool --info " .. name)
      assert.truthy(out:find("3 channel", 1, true), out)
      render(name, false)
      _, out = shell("oiiotool --info " .. name)
      assert.truthy(out:find("4 channel", 1, true), out)
    end
  end)

  it_reads_pictures("contain the same 16 bits in PNG as in TIFF", function()
    render("c.tif", false, "--depth 16")
    render("c.png", false, "--depth 16")
    local code, out = shell("oiiotool c.png c.tif --fail 0.00004 --diff")
    assert.are.equal(0, code, out)
  end)

  it("have the same bytes with any number of workers, hashed or not", function()
    for _, lit in ipairs { false, true } do
      render("d1.png", lit, "--workers 1")
      for _, workers in ipairs { 2, 5 } do
        render("d2.png", lit, "--workers " .. workers)
        assert.is_true(read "d1.png" == read "d2.png")
      end
      render("d2.png", lit, "--hash")
      assert.is_true(read "d1.png" == read "d2.png")
    end
  end)

  it_reads("do not contain the folder in which they were made", function()
    for _, ending in ipairs { "png", "tga", "span", "exr", "tif", "dpx", "jpg", "bmp", "hdr",
      "ppm" } do
      local path = bench.folder .. "/where." .. ending
      local code, _, err =
        celspan(("render '%s/scripts/demo.lua' -o %s --size 64x36 --frames 1 --progress none")
        :format(os.getenv "PWD", path))
      assert.are.equal(0, code, err)
      assert.falsy(read(path):find(bench.folder, 1, true), ending)
    end
  end)

  it_reads("may be as long and thin as a million pixels by one, as PNG", function()
    for _, size in ipairs { "1000000x1", "1x1000000" } do
      assert.are.same({ 0, "", "" }, { render("e.png", true, "--fit stretch --size " .. size) })
      local code, out = shell("oiiotool --stats e.png")
      assert.are.equal(0, code)
      assert.truthy(out:find(size:gsub("x", " x +") .. ","), out)
    end
  end)

  it_reads("are no larger than OpenImageIO's files of the same pixels", function()
    local root = os.getenv("PWD")
    for _, frame in ipairs(os.getenv "CELSPAN_SCENES" and { 120 } or { 1, 120, 240 }) do
      local code, _, err = celspan(("render '%s/scripts/demo.lua' -o k.png --size 3840x2160 "
        .. "--frames %d --progress none"):format(root, frame))
      assert.are.equal(0, code, err)
      assert.are.equal(0, (shell("oiiotool k.png -o l.png")))
      assert.is_true(#read "k.png" < #read "l.png", "frame " .. frame)
    end
  end)

  -- Builds with sanitizers, for which CELSPAN_SCENES is set, take a hundred times as long.
  local side = os.getenv "CELSPAN_SCENES" and 20000 or 1000000

  -- With the largest difference that the precision of the format explains.
  local LONG = { span = 0, tif = 0, exr = 0.003, dpx = 0.004, bmp = 0.004, ppm = 0.004, hdr = 0.06 }
  it_reads_pictures("may be as long and thin in all formats that allow it #full", function()
    for _, size in ipairs { side .. "x1", "1x" .. side } do
      assert.are.same({ 0, "", "" }, { render("g.png", true, "--fit stretch --size " .. size) })
      for format, difference in pairs(LONG) do
        assert.are.same({ 0, "", "" },
          { render("g." .. format, true, "--fit stretch --size " .. size) })
        local code, out, err = celspan(("compare g.png g.%s --fail %g"):format(format, difference))
        assert.are.equal(0, code, format .. " " .. size .. ": " .. out .. err)
      end
    end
    for _, format in ipairs { "tga", "jpg", "webp", "gif", "jp2" } do
      local code, _, err = render("h." .. format, true, "--size 1000000x1")
      assert.are.equal(6, code)
      assert.truthy(err:find("files hold at most", 1, true), err)
    end
  end)

  it("are refused if the size is too large for Targa", function()
    local code, _, err = render("f.tga", false, "--size 65536x2")
    assert.are_not.equal(0, code)
    assert.truthy(err:find("f.tga: the frame is 65536 x 2 pixels; Targa files hold at most "
      .. "65535 a side",
      1, true), err)
    assert.is_nil(io.open(bench.folder .. "/f.tga"))
  end)
end)

describe("what the numbers of a file mean", function()
  setup(function()
    bench = workbench.new()
    bench:write("codes.lua", [[
local celspan = require "celspan"
local rostrum = celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 4, 8, texture = "#40c080" },
  celspan.rect { 4, 0, 4, 8, texture = "#ff8000" } } }
return celspan.film { size = { 8, 8 }, frames = 1, space = "srgb", frame = function()
  return rostrum
end }]])
  end)

  teardown(function() bench:remove() end)

  it_reads_pictures("is in EXR and PNG files, and celspan reads it there", function()
    local function write(name, options)
      assert.are.same({ 0, "", "" },
        { celspan(("render codes.lua -o %s --progress none %s"):format(name, options)) })
    end
    write("plain.exr", "--depth float")
    for _, colour in ipairs { "srgb", "linear", "rec709" } do
      write(colour .. ".exr", "--depth float --colour " .. colour)
      local _, out = shell(("oiiotool --info -v %s.exr"):format(colour))
      assert.truthy(out:find(('celspan:colour: "%s"'):format(colour), 1, true), out)
      local code, told, err = celspan(("compare plain.exr %s.exr --fail 1e-4"):format(colour))
      assert.are.equal(0, code, colour .. " " .. told .. err)
    end
    write("light.png", "--depth 16 --colour linear")
    write("codes.png", "--depth 16")
    local code, told, err = celspan "compare light.png codes.png --fail 1e-3"
    assert.are.equal(0, code, told .. err)
  end)

  it_reads_pictures("has translucent colours read back, premultiplied, in every coding", function()
    for _, space in ipairs { "linear", "srgb" } do
      bench:write("veil.lua", ([[
local celspan = require "celspan"
local veil = celspan.linear { from = { 0, 0 }, to = { 8, 0 },
  { 0, "#ff800020" }, { 1, "#40c080e0" } }
return celspan.film { size = { 8, 8 }, frames = 1, space = %q, frame = function()
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 7, 8, texture = veil } } }
end }]]):format(space))
      local function write(name, options)
        assert.are.same({ 0, "", "" },
          { celspan(("render veil.lua -o %s --progress none %s"):format(name, options)) })
      end
      write("veil.exr", "--depth float")
      for name, options in pairs { ["srgb.exr"] = "--depth float --colour srgb",
        ["rec709.exr"] = "--depth float --colour rec709", ["half.exr"] = "--colour srgb",
        ["veil.tif"] = "--depth 16 --alpha premultiplied" } do
        write(name, options)
        local least = options:find "float" and "1e-6" or options:find "16" and "1e-4" or "1e-3"
        local code, told, err = celspan(("compare veil.exr %s --fail %s"):format(name, least))
        assert.are.equal(0, code, ("%s %s: %s%s"):format(space, name, told, err))
      end
    end
  end)
end)
