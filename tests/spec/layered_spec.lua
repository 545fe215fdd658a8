-- The cels of a frame as layers of an OpenRaster file, and as PNG files: read back by celspan,
-- whose reader shares no code with the writers, by unzip and by OpenImageIO.
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local it_compares = present.pictures() and present.program "oiiotool" and it or pending
local it_unpacks = present.program "unzip" and it or pending

local HEAD = [[
local celspan = require "celspan"
local function box(x, y, w, h, texture) return celspan.rect { x, y, w, h, texture = texture } end
]]

--- Codes are mixed, and no two cels have an edge in the same pixel. with: more cels.
local function film(with)
  return HEAD .. ([[
return celspan.film { size = { 300, 200 }, frames = 2, space = "srgb", frame = function()
  return celspan.rostrum { back = { 0.1, 0.2, 0.3, 1 }, front = { 1, 0.9, 0.8 },
    celspan.cel { box(14, 14, 188, 156, "#844") }:named "wall",
    celspan.cel { box(18.5, 28.5, 140, 80, "#3a6c"), opacity = 0.7,
      celspan.circle { centre = { 250, 145 }, radius = 39.5, texture = "#fffa" } }:named "hand",
    celspan.cel { box(30.5, 40.5, 90, 30, "#f08a"), opacity = 0.3337 }:named [=[a.b/c & <"d">]=],
    %s celspan.cel { box(150.7, 5.7, 20, 15, "#fff3") } } end }
]]):format(with or "")
end

describe("--layers cels", function()
  local bench

  before_each(function() bench = workbench.new() end)
  after_each(function() bench:remove() end)

  local function run(arguments) return bench:ran(arguments) end
  local function render(script, arguments) return bench:rendered(script, arguments) end
  --- Checks that two opaque pictures are alike within one code of 255, or of `codes`.
  local function check_alike(one, other, codes)
    local most = 1.02 / (codes or 255)
    local code, out, err = bench:inside(("oiiotool --fail %g --hardfail %g --warn 1 %s --ch R,G,B "
      .. "%s --ch R,G,B --diff")
      :format(most, most, one, other))
    assert.equal(0, code, out .. err)
  end
  local function layers(file)
    local code, err, out = run("info " .. file)
    assert.equal(0, code, err)
    local list = {}
    for mode, opacity, name in out:gmatch "blend (%S+) opacity (%S+) visible yes name ([^\n]*)" do
      list[#list + 1] = ("%s %s %s"):format(name, mode, opacity)
    end
    return list
  end

  it_compares("writes OpenRaster that is read back as the frame", function()
    assert.equal("", render(film(), "--frames 1 --layers cels -o x.ora"))
    assert.same({ "backlight normal 1", "wall normal 1", "hand normal 0.7",
      "a.b/c & <\"d\"> normal 0.3337", "cel_4 normal 1" }, layers "x.ora")
    render(film(), "--frames 1 -o frame.png")
    local code, err = run "render x.ora --progress none -o back.png"
    assert.equal(0, code, err)
    check_alike("back.png", "frame.png")
    render(film(), "--frames 1 --depth 16 --layers cels -o deep.ora")
    render(film(), "--frames 1 --depth 16 -o deep.png")
    code, err = run "render deep.ora --progress none --depth 16 -o deep_back.png"
    assert.equal(0, code, err)
    check_alike("deep_back.png", "deep.png", 4096)
  end)

  it_unpacks("writes the parts that OpenRaster asks for, in their order", function()
    render(film(), "--frames 1 --layers cels -o x.ora")
    local code, out = bench:inside "unzip -tq x.ora && unzip -Z1 x.ora"
    assert.equal(0, code, out)
    assert.equal("mimetype mergedimage.png data/1.png data/2.png data/3.png data/4.png data/5.png "
      .. "Thumbnails/thumbnail.png stack.xml ", out:gsub("^No errors[^\n]*\n", ""):gsub("\n", " "))
    assert.equal("PK\3\4", bench:read("x.ora"):sub(1, 4))
    assert.equal("mimetypeimage/openraster", bench:read("x.ora"):sub(31, 54))
    render(film(), "--frames 1 -o frame.png")
    bench:inside "unzip -qo x.ora"
    assert.equal((bench:read "frame.png"):sub(-400), (bench:read "mergedimage.png"):sub(-400))
    local width, height = (">I4I4"):unpack(bench:read "Thumbnails/thumbnail.png", 17)
    assert.same({ 256, 170 }, { width, height })
    render(film(), "--frames 1 --crop 10,20,120,90 --layers cels -o crop.ora")
    bench:inside "unzip -qo crop.ora"
    width, height = (">I4I4"):unpack(bench:read "data/3.png", 17)
    assert.same({ 120, 90 }, { width, height })
  end)

  it_compares("keeps every blend mode by its name in OpenRaster", function()
    local modes, lines = { "multiply", "screen", "overlay", "darken", "lighten", "color-dodge",
      "color-burn", "hard-light", "soft-light", "difference", "exclusion", "hue", "saturation",
      "color", "luminosity", "add", "linear-dodge", "soft-light-photoshop", "linear-burn",
      "vivid-light", "linear-light", "pin-light", "hard-mix", "subtract", "divide", "darker-color",
      "lighter-color" }, {}
    for i, mode in ipairs(modes) do
      lines[i] = ("celspan.cel { box(%d, 187, 8, 8, '#8a4'), blend = '%s' }:named '%s',")
        :format(10 * i, mode, mode)
    end
    assert.equal("", render(film(table.concat(lines, "\n")), "--frames 1 --layers cels -o x.ora"))
    local list = layers "x.ora"
    for i, mode in ipairs(modes) do
      assert.equal(("%s %s 1"):format(mode, mode), list[4 + i])
    end
    local code, err = run "render x.ora --progress none -o back.png"
    assert.equal(0, code, err)
    render(film(table.concat(lines, "\n")), "--frames 1 -o frame.png")
    check_alike("back.png", "frame.png")
  end)

  it_compares("writes a PNG file a cel, with its name before the number", function()
    assert.equal("", render(film(), "--layers cels -o out/x.####.png"))
    assert.same({ "x.0001.png", "x.0002.png", "x.a_b_c & <\"d\">.0001.png",
      "x.a_b_c & <\"d\">.0002.png", "x.backlight.0001.png", "x.backlight.0002.png",
      "x.cel_4.0001.png", "x.cel_4.0002.png", "x.hand.0001.png", "x.hand.0002.png",
      "x.wall.0001.png", "x.wall.0002.png" }, bench:files "out")
    render(film(), "--frames 2 -o frame.png")
    assert.equal(bench:read "frame.png", bench:read "out/x.0002.png")
    bench:write("over.lua", HEAD .. [[local function cel(name)
        return celspan.cel { celspan.image { file = "out/x." .. name .. ".0002.png" } } end
      return celspan.film { size = { 300, 200 }, space = "srgb", frame = function()
        return celspan.rostrum { cel "backlight", cel "wall", cel "hand", cel [=[a_b_c & <"d">]=],
          cel "cel_4" } end }]])
    local code, err = run "render over.lua --progress none -o over.png"
    assert.equal(0, code, err)
    check_alike("over.png", "frame.png")
    render(film(), "--frames 1 --layers cels -o one.png")
    assert.truthy(bench:read "one.wall.png")
    render(film(), "--frames 1 --layers cels --format png -o plain")
    assert.truthy(bench:read "plain.wall")
  end)

  it_compares("writes opaque frames whose layers are not", function()
    local opaque = film():gsub("back = {[^}]*}", 'back = "#345"')
    render(opaque, "--frames 1 --layers cels -o x.png")
    render(opaque, "--frames 1 --layers cels -o x.ora")
    assert.equal(6, (bench:read "x.hand.png"):byte(26))
    assert.equal(2, (bench:read "x.png"):byte(26))
  end)

  it("says what does not add up where codes are mixed", function()
    local light = film():gsub('space = "srgb", ', "")
    for _, file in ipairs { "x.ora", "x.png" } do
      assert.truthy(render(light, "--frames 1 --layers cels -o " .. file)
        :find "are not the frame: it mixes light, and programs mix the codes")
    end
    local blended = film "celspan.cel { box(1, 1, 5, 5, '#fff'), blend = 'screen' },"
    assert.truthy(render(blended, "--frames 1 --layers cels -o x.png"):find "has a blend mode")
    assert.equal("", render(blended, "--frames 1 --layers cels -o x.ora"))
  end)

  it("leaves nothing where a file cannot be made", function()
    bench:write("film.lua", film())
    for arguments, words in pairs {
      ["-o x.ora"] = 'the format "ora" cannot be written',
      ["--layers cels --strip 1/2 --frames 1 -o x.png"] = "the layers of strips are not joined",
      ["--layers cels --strip 1/2 --frames 1 -o x.ora"] = "--strip: a painting is written without",
      ["--layers cels --dither --frames 1 -o x.ora"] = "--dither: a painting is written without",
      ["--layers cels --depth half --frames 1 -o x.ora"] = "a painting has 8 or 16 bits",
      ["--layers cels --alpha premultiplied --frames 1 -o x.ora"] = "straight alpha",
      ["--layers cels --colour linear --frames 1 -o x.ora"] = "are in sRGB: leave --colour out",
      ["--layers cels -o x.ora"] = "several frames (2) need a number in the name",
      ["--layers cels --hash --frames 1 -o x.ora"] = "leave it or --layers out",
      ["--layers cels --frames 1 -o /dev/full/x.ora"] = "/dev/full",
    } do
      local code, err = run("render film.lua --progress none " .. arguments)
      assert.not_equal(0, code, arguments)
      assert.truthy(err:find(words, 1, true), arguments .. err)
      assert.same({ "film.lua", "stderr", "stdout" }, bench:files())
    end
    local long = ("n"):rep(240)
    local code, err = run(("render film.lua --frames 1 --layers cels -o %s.png"):format(long))
    assert.not_equal(0, code)
    assert.truthy(err:find("has no place for those of layers", 1, true), err)
    bench:write("broken.lua", HEAD .. [[return celspan.film { size = { 40, 40 },
      frame = function() return celspan.rostrum { celspan.cel { box(1, 1, 9, 9, "#fff") },
        celspan.cel { celspan.image { file = "no.png" } } } end }]])
    code = run "render broken.lua --progress none --layers cels -o x.ora"
    assert.not_equal(0, code)
    assert.same({ "broken.lua", "film.lua", "stderr", "stdout" }, bench:files())
  end)

  it("has a thumbnail of a crop at the last column, when both are rounded", function()
    render(HEAD .. [[return celspan.film { size = { 1001, 3001 }, space = "srgb",
      frame = function() return celspan.rostrum { celspan.cel { box(0, 0, 1001, 9, "#f80") } } end }
      ]], "--layers cels -o x.ora --crop 1000,0,1,3001")
    assert.truthy(bench:read "x.ora")
  end)

  it_compares("says where a picture is that cannot be read, as without layers", function()
    render(film(), "--frames 1 -o whole.png")
    bench:write("half.png", (bench:read "whole.png"):sub(1, -30))
    bench:write("film.lua", HEAD .. [[return celspan.film { size = { 300, 200 }, frame = function()
      return celspan.rostrum { celspan.cel { box(1, 1, 9, 9, "#fff") }, celspan.cel {
        celspan.image { file = "half.png" } }:named "photo" } end }]])
    local _, plain = run "render film.lua --progress none -o y.png"
    assert.truthy(plain:find("cel 2 'photo'", 1, true), plain)
    for _, file in ipairs { "x.ora", "x.png" } do
      local _, err = run("render film.lua --progress none --layers cels -o " .. file)
      assert.equal(plain, (err:gsub("[^\n]*its layers over each other[^\n]*\n", "")))
      assert.is_nil(bench:read(file))
    end
  end)

  it_compares("keeps files that --resume finds", function()
    for _, ending in ipairs { "ora", "png" } do
      local function kept(script)
        bench:write("film.lua", script)
        local code, err = run("render film.lua --layers cels --resume --progress lines -o x.#."
          .. ending)
        assert.equal(0, code, err)
        return err:match "(%d) kept"
      end
      assert.is_nil(kept(film()))
      assert.equal("2", kept(film()))
      assert.is_nil(kept((film():gsub('"wall"', '"brick"'))))
    end
    assert.equal("brick normal 1", layers("x.2.ora")[2])
    assert.truthy(bench:read "x.brick.2.png")
  end)

  it("can be farmed", function()
    bench:write("film.lua", film())
    for _, ending in ipairs { "ora", "png", "exr" } do
      local code, err, out = run(("farm film.lua --commands --layers cels -o 'x.#.%s'")
        :format(ending))
      assert.equal(0, code, err)
      assert.truthy(out:find("--layers cels", 1, true), out)
    end
    local code, err = run "farm film.lua --commands --layers cels -o 'x.#.tif'"
    assert.not_equal(0, code)
    assert.truthy(err:find("OpenEXR, PNG and OpenRaster files have layers", 1, true), err)
  end)
end)
