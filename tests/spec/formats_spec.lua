-- The files that celspan writes itself: PNG and Targa, as other programs read them.

local BINARY = os.getenv("CELSPAN") or "build/celspan"

local folder

local function read(path)
  local file = assert(io.open(path, "rb"))
  local bytes = file:read("a")
  file:close()
  return bytes
end

-- Runs a shell command in the folder; answers its exit code, standard output and error.
local function shell(command)
  local _, _, code = os.execute(("cd '%s' && ( %s ) >stdout 2>stderr"):format(folder, command))
  return code, read(folder .. "/stdout"), read(folder .. "/stderr")
end

local binary = BINARY:sub(1, 1) == "/" and BINARY or os.getenv("PWD") .. "/" .. BINARY

local function celspan(arguments)
  return shell(binary .. " " .. arguments)
end

local has_oiiotool = os.execute("command -v oiiotool >/dev/null 2>&1")
local it_reads = has_oiiotool and it or pending

--- TIFF files need the picture module.
local function has_pictures()
  local answer = assert(io.popen(BINARY .. " convert no-such.png no-such-either.png 2>&1"))
  local text = answer:read("a")
  answer:close()
  return not text:find("celspan-picture.so", 1, true)
end
local it_reads_pictures = has_oiiotool and has_pictures() and it or pending

-- Flat shapes, a gradient and something clear; with a back light, every pixel is opaque.
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
    folder = os.tmpname()
    os.remove(folder)
    assert(os.execute("mkdir '" .. folder .. "'"))
    local file = assert(io.open(folder .. "/scene.lua", "wb"))
    file:write(SCENE)
    file:close()
  end)

  teardown(function()
    os.execute("rm -rf '" .. folder .. "'")
  end)

  it_reads("hold the same pixels", function()
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

  it_reads_pictures("hold 16 bits in PNG as in TIFF", function()
    render("c.tif", false, "--depth 16")
    render("c.png", false, "--depth 16")
    local code, out = shell("oiiotool c.png c.tif --fail 0.00004 --diff")
    assert.are.equal(0, code, out)
  end)

  it("have the same bytes however many workers there are, hashed or not", function()
    for _, lit in ipairs { false, true } do
      render("d1.png", lit, "--workers 1")
      for _, workers in ipairs { 2, 5 } do
        render("d2.png", lit, "--workers " .. workers)
        assert.is_true(read(folder .. "/d1.png") == read(folder .. "/d2.png"))
      end
      render("d2.png", lit, "--hash")
      assert.is_true(read(folder .. "/d1.png") == read(folder .. "/d2.png"))
    end
  end)

  it_reads("do not tell in which folder they were made", function()
    for _, ending in ipairs { "png", "tga", "span", "exr", "tif", "dpx", "jpg", "bmp", "hdr", "ppm" } do
      local path = folder .. "/where." .. ending
      local code, _, err = celspan(("render '%s/scripts/demo.lua' -o %s --size 64x36 --frames 1 --progress none")
        :format(os.getenv "PWD", path))
      assert.are.equal(0, code, err)
      assert.falsy(read(path):find(folder, 1, true), ending)
    end
  end)

  it_reads("may be as long and thin as a million pixels by one, as PNG", function()
    for _, size in ipairs { "1000000x1", "1x1000000" } do
      assert.are.same({ 0, "", "" }, { render("e.png", true, "--size " .. size) })
      local code, out = shell("oiiotool --stats e.png")
      assert.are.equal(0, code)
      assert.truthy(out:find(size:gsub("x", " x +") .. ","), out)
    end
  end)

  it_reads("are no larger than what OpenImageIO makes of the same pixels", function()
    local root = os.getenv("PWD")
    for _, frame in ipairs(os.getenv "CELSPAN_SCENES" and { 120 } or { 1, 120, 240 }) do
      local code, _, err = celspan(("render '%s/scripts/demo.lua' -o k.png --size 3840x2160 "
        .. "--frames %d --progress none"):format(root, frame))
      assert.are.equal(0, code, err)
      assert.are.equal(0, (shell("oiiotool k.png -o l.png")))
      assert.is_true(#read(folder .. "/k.png") < #read(folder .. "/l.png"), "frame " .. frame)
    end
  end)

  -- Builds with sanitizers, for which CELSPAN_SCENES is set, take a hundred times as long.
  local side = os.getenv "CELSPAN_SCENES" and 20000 or 1000000

  -- With the largest difference that the format's own numbers explain.
  local LONG = { span = 0, tif = 0, exr = 0.003, dpx = 0.004, bmp = 0.004, ppm = 0.004, hdr = 0.06 }
  it_reads_pictures("may be so long and thin in all formats that can hold them", function()
    for _, size in ipairs { side .. "x1", "1x" .. side } do
      assert.are.same({ 0, "", "" }, { render("g.png", true, "--size " .. size) })
      for format, difference in pairs(LONG) do
        assert.are.same({ 0, "", "" }, { render("g." .. format, true, "--size " .. size) })
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

  it("are refused where Targa has no numbers for the size", function()
    local code, _, err = render("f.tga", false, "--size 65536x2")
    assert.are_not.equal(0, code)
    assert.truthy(err:find("f.tga: the frame is 65536 x 2 pixels; targa files hold at most 65535 a side",
      1, true), err)
    assert.is_nil(io.open(folder .. "/f.tga"))
  end)
end)
