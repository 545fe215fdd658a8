-- The cels of a frame as layers of an OpenRaster file or a Photoshop document, and as PNG files:
-- read back by celspan, whose reader shares no code with the writers, by unzip, OpenImageIO,
-- ImageMagick and psd-tools.
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local it_compares = present.pictures() and present.program "oiiotool" and it or pending
local it_unpacks = present.program "unzip" and it or pending
local has_psd_tools = present.program "/usr/bin/python3" and
  os.execute "/usr/bin/python3 -c 'import psd_tools' 2>/dev/null"
local it_asks = has_psd_tools and present.pictures() and present.program "oiiotool" and it
  or pending
local it_identifies = present.pictures() and present.program("oiiotool", "/usr/bin/convert") and it
  or pending

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

  it_compares("writes a Photoshop document that is read back as the frame", function()
    local names = { "backlight normal 1", "wall normal 1", "hand normal 0.701960784",
      "a.b/c & <\"d\"> normal 0.337254902", "cel_4 normal 1" }
    for depth, codes in pairs { [8] = 255, [16] = 16384 } do
      assert.equal("", render(film(), ("--frames 1 --depth %d --layers cels -o x.psd")
        :format(depth)))
      assert.same(names, layers "x.psd")
      render(film(), ("--frames 1 --depth %d -o frame.png"):format(depth))
      local code, err = run(("render x.psd --progress none --depth %d -o back.png"):format(depth))
      assert.equal(0, code, err)
      check_alike("back.png", "frame.png", codes)
    end
  end)

  -- Noise has no runs, and the boxes have runs of all lengths.
  it_compares("packs all pixels of Photoshop documents without loss", function()
    local boxes = {}
    for i = 1, 40 do
      boxes[i] = ("box(%d, %d, %d, 1, '#%x%x%x%x'),"):format(3 * i, 2 * i, i * i % 260, i % 16,
        (i + 5) % 16, (i + 9) % 16, 1 + i % 15)
    end
    local script = HEAD .. ([[local noise = celspan.noise { size = 2, fade = false,
        colours = { "#f80c", "#08f3" } }
      return celspan.film { size = { 431, 90 }, space = "srgb", frame = function()
      return celspan.rostrum { celspan.cel { %s }:named "runs",
        celspan.cel { celspan.rect { 1, 30, 429, 57, texture = noise } }:named "noise",
        celspan.cel { box(500, 1, 3, 3, "#fff") }:named "nothing" } end }]])
      :format(table.concat(boxes, " "))
    for _, depth in ipairs { 8, 16 } do
      for _, ending in ipairs { "psd", "ora" } do
        render(script, ("--depth %d --layers cels -o x.%s"):format(depth, ending))
        bench:write("alone.lua", HEAD .. ([[
          local tree = assert(require "celspan.layers".read "x.%s")
          return celspan.film { size = { 431, 90 }, frames = 2, space = "srgb",
          frame = function(f) return celspan.rostrum { tree:cels()[f.number] } end }
          ]]):format(ending))
        local code, err = run(("render alone.lua --progress none --depth %d -o %s.#.png")
          :format(depth, ending))
        assert.equal(0, code, err)
      end
      for n = 1, 2 do
        local same = bench:read(("ora.%d.png"):format(n)) == bench:read(("psd.%d.png"):format(n))
        assert.is_true(same, ("layer %d with %d bits differs"):format(n, depth))
      end
    end
  end)

  it_asks("writes Photoshop documents that psd-tools reads", function()
    bench:write("read.py", [[
import sys, numpy
from PIL import Image
from psd_tools import PSDImage
from psd_tools.composite import composite
psd = PSDImage.open(sys.argv[1])
for layer in psd:
    name = layer.name.encode("ascii", "replace").decode()
    print(layer.blend_mode.name, layer.opacity, layer.bbox, name)
psd.topil().save("merged.png")
colour = composite(psd, force=True)[0]
Image.fromarray(numpy.uint8(numpy.round(numpy.clip(colour, 0, 1) * 255))).save("composed.png")
]])
    render(film [[celspan.cel { box(220.5, 20.5, 60, 30, "#f08a"), blend = "screen" },
      celspan.cel { box(220, 60, 60, 30, "#f08a"), blend = "linear-burn" }:named "žluť",]],
      "--frames 1 --layers cels -o x.psd")
    bench:inside "cp film.lua frame.lua"
    local code, err = run "render frame.lua --frames 1 --progress none -o frame.png"
    assert.equal(0, code, err)
    local out
    code, out, err = bench:inside "/usr/bin/python3 read.py x.psd"
    assert.equal(0, code, err)
    assert.equal([[
NORMAL 255 (0, 0, 300, 200) backlight
NORMAL 255 (0, 0, 300, 200) wall
NORMAL 179 (0, 0, 300, 200) hand
NORMAL 86 (0, 0, 300, 200) a.b/c & <"d">
SCREEN 255 (0, 0, 300, 200) cel_4
LINEAR_BURN 255 (0, 0, 300, 200) ?lu?
NORMAL 255 (0, 0, 300, 200) cel_6
]], out)
    check_alike("merged.png", "frame.png", 1e6)
    check_alike("composed.png", "frame.png")
  end)

  it_identifies("writes Photoshop documents that ImageMagick reads", function()
    for _, depth in ipairs { 8, 16 } do
      local deep = ("--frames 1 --depth %d "):format(depth)
      render(film(), deep .. "--layers cels -o x.psd")
      render(film(), deep .. "-o frame.png")
      local code, out, err = bench:inside "/usr/bin/identify -format '%w %h %z %l\n' x.psd"
      assert.equal(0, code, err)
      local size = ("300 200 %d "):format(depth)
      assert.equal(size .. "\n" .. size .. "backlight\n" .. size .. "wall\n" .. size .. "hand\n"
        .. size .. "a.b/c & <\"d\">\n" .. size .. "cel_4\n", out)
      code, _, err = bench:inside "/usr/bin/convert 'x.psd[0]' merged.png"
      assert.equal(0, code, err)
      check_alike("merged.png", "frame.png", 1e6)
    end
    -- The merged picture of a frame that is not opaque lies over white.
    local function with_back(back) return (film():gsub("back = {[^}]*}", "back = " .. back)) end
    render(with_back '"#fff"', "--frames 1 -o white.png")
    render(with_back "{ 0, 0, 0, 0 }", "--frames 1 --layers cels -o x.psd")
    bench:inside "/usr/bin/convert -define psd:alpha-unblend=off 'x.psd[0]' -alpha off merged.png"
    check_alike("merged.png", "white.png")
    -- Light without a matte is brighter than its alpha says: over white nothing gets darker.
    render(with_back "{ 0.5, 0.5, 0.5, 0 }", "--frames 1 --layers cels -o x.psd")
    local _, out = bench:inside("/usr/bin/convert -define psd:alpha-unblend=off 'x.psd[0]' -alpha "
      .. "off white.png -fx 'u<v-0.005?1:0' -format '%[fx:maxima]' info:")
    assert.equal("0", out)
  end)

  it_compares("writes clear Photoshop documents of 16 bits that pictures are read from", function()
    local clear = film():gsub("back = {[^}]*}", "back = { 0, 0, 0, 0 }")
    render(clear, "--frames 1 --depth 16 --layers cels -o x.psd")
    render(clear, "--frames 1 --depth 16 -o frame.png")
    local code, err = run "compare x.psd frame.png --fail 0.006" -- of edges of little alpha
    assert.equal(0, code, err)
    run "convert x.psd converted.png --depth 16"
    render([[local celspan = require "celspan"
      return celspan.film { size = { 300, 200 }, space = "srgb", frame = function()
        return celspan.rostrum { celspan.cel { celspan.image { file = "x.psd" } } } end }]],
      "--frames 1 --depth 16 -o drawn.png")
    for _, name in ipairs { "converted.png", "drawn.png" } do
      code, err = run("compare frame.png --fail 0.006 " .. name)
      assert.equal(0, code, name .. err)
    end
    local _, _, facts = run "info x.psd"
    assert.matches("alpha straight", facts)
    assert.is_nil(facts:find "subimage 1")
  end)

  it("keeps names of any kind in Photoshop documents", function()
    local long = ("ž"):rep(127) .. "n"
    render(film(([[celspan.cel { box(1, 1, 5, 5, "#fff") }:named "猫 🐈",
      celspan.cel { box(1, 1, 5, 5, "#fff") }:named "wall",
      celspan.cel { box(1, 1, 5, 5, "#fff") }:named "%s",
      celspan.cel { box(1, 1, 5, 5, "#fff") }:named "abc",]]):format(long)),
      "--frames 1 --layers cels -o x.psd")
    local list = layers "x.psd"
    assert.same({ "猫 🐈 normal 1", "wall normal 1", long .. " normal 1", "abc normal 1" },
      { table.unpack(list, 5, 8) })
  end)

  it("writes frames of every kind as Photoshop documents", function()
    local cels = {}
    for i = 1, 100 do cels[i] = ("celspan.cel { box(%d, 1, 5, 5, '#fff') },"):format(i) end
    for size, inside in pairs { ["{ 1, 1 }"] = "celspan.cel { box(0, 0, 1, 1, '#f80') }",
      ["{ 8, 3 }"] = "", ["{ 3, 8 }"] = "celspan.cel {}",
      ["{ 120, 9 }"] = table.concat(cels) } do
      for _, depth in ipairs { 8, 16 } do
        render(HEAD .. ([[return celspan.film { size = %s, space = "srgb", frame = function()
          return celspan.rostrum { %s } end }]]):format(size, inside),
          ("--depth %d --layers cels -o x.psd"):format(depth))
        local _, count = inside:gsub("celspan.cel", "")
        assert.equal(count == 0 and 1 or count, #layers "x.psd", size)
        local code, err = run "render x.psd --progress none -o back.png"
        assert.equal(0, code, err)
      end
    end
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

  it_compares("keeps every blend mode by its name in OpenRaster and Photoshop files", function()
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
    local note = render(film(table.concat(lines, "\n")), "--frames 1 --layers cels -o x.psd")
    assert.truthy(note:find("cel 12 'soft-light' (film.lua:", 1, true), note)
    assert.truthy(note:find("has a blend mode that such files do not have", 1, true), note)
    local similar = { add = "linear-dodge", ["soft-light"] = "soft-light-photoshop" }
    list = layers "x.psd"
    for i, mode in ipairs(modes) do
      assert.equal(("%s %s 1"):format(mode, similar[mode] or mode), list[4 + i])
      lines[i] = not similar[mode] and lines[i] or ""
    end
    local without = film(table.concat(lines, "\n"))
    assert.equal("", render(without, "--frames 1 --layers cels -o x.psd"))
    code, err = run "render x.psd --progress none -o back.png"
    assert.equal(0, code, err)
    render(without, "--frames 1 -o frame.png")
    check_alike("back.png", "frame.png")
  end)

  it("says which light has no place in layers of straight alpha", function()
    local lit = film "celspan.cel { back = { 0.3, 0.3, 0.3, 0 } }:named 'lamp',"
    for _, name in ipairs { "x.psd", "x.ora", "x.png" } do
      local note = render(lit, "--frames 1 --layers cels -o " .. name)
      assert.truthy(note:find("cel 4 'lamp'", 1, true), note)
      assert.truthy(note:find("has a back light without a matte", 1, true), note)
    end
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
    render(opaque, "--frames 1 --layers cels -o x.psd")
    assert.equal(3, (bench:read "x.psd"):byte(14))
    assert.equal(6, (bench:read "x.hand.png"):byte(26))
    assert.equal(2, (bench:read "x.png"):byte(26))
  end)

  it("says what does not add up where codes are mixed", function()
    local light = film():gsub('space = "srgb", ', "")
    for _, file in ipairs { "x.ora", "x.psd", "x.png" } do
      assert.truthy(render(light, "--frames 1 --layers cels -o " .. file)
        :find "are not the frame: it mixes light, and programs mix the codes")
    end
    local png = "--frames 1 --layers cels -o x.png --colour "
    assert.equal("", render(light, png .. "linear"))
    assert.equal("", render(film(), png .. "srgb"))
    assert.truthy(render(film(), png .. "linear"):find("it mixes codes", 1, true))
    for _, script in ipairs { light, film() } do
      assert.truthy(render(script, png .. "rec709"):find("converts each layer by itself", 1, true))
    end
    local blended = film "celspan.cel { box(1, 1, 5, 5, '#fff'), blend = 'screen' },"
    assert.truthy(render(blended, "--frames 1 --layers cels -o x.png"):find "has a blend mode")
    assert.equal("", render(blended, "--frames 1 --layers cels -o x.ora"))
    assert.equal("", render(blended, "--frames 1 --layers cels -o x.psd"))
  end)

  it("leaves nothing where a file cannot be made", function()
    bench:write("film.lua", film())
    for arguments, words in pairs {
      ["-o x.ora"] = 'the format "ora" cannot be written without layers',
      ["--layers cels --strip 1/2 --frames 1 -o x.png"] = "png with layers takes no --strip",
      ["--layers cels --strip 1/2 --frames 1 -o x.ora"] = "ora with layers takes no --strip",
      ["--layers cels --dither --frames 1 -o x.ora"] = "ora with layers takes no --dither",
      ["--layers cels --depth half --frames 1 -o x.ora"] = "takes --depth 8 or 16, and not half",
      ["--layers cels --alpha premultiplied --frames 1 -o x.ora"] = "takes --alpha straight, and",
      ["--layers cels --colour linear --frames 1 -o x.ora"] = "takes --colour srgb, and not linear",
      ["--layers cels --depth float --frames 1 -o x.psd"] = "takes --depth 8 or 16, and not float",
      ["--layers cels --frames 1 --size 30001x20001 -o x.psd"] = "x.psd: the frame has 30001 x "
        .. "20001 pixels, and a Photoshop document at most 30000 a side",
      ["--layers cels --frames 1 -o /dev/full/x.psd"] = "/dev/full",
      ["--layers cels --cryptomatte cels --frames 1 -o x.psd"] = "takes no --cryptomatte",
      ["-o x.psd"] = 'the format "psd" cannot be written without layers',
      ["--layers cels -o x.ora"] = "several frames (2) need a number in the name",
      ["--layers cels --hash --frames 1 -o x.ora"] = "ora with layers takes no --hash",
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
    for _, ending in ipairs { "ora", "psd" } do
      code = run("render broken.lua --progress none --layers cels -o x." .. ending)
      assert.not_equal(0, code)
      assert.same({ "broken.lua", "film.lua", "stderr", "stdout" }, bench:files())
    end
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
    for _, file in ipairs { "x.ora", "x.psd", "x.png" } do
      local _, err = run("render film.lua --progress none --layers cels -o " .. file)
      assert.equal(plain, (err:gsub("[^\n]*its layers over each other[^\n]*\n", "")))
      assert.is_nil(bench:read(file))
    end
  end)

  it_compares("keeps files that --resume finds", function()
    for _, ending in ipairs { "ora", "psd", "png" } do
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
    assert.equal("brick normal 1", layers("x.2.psd")[2])
    assert.truthy(bench:read "x.brick.2.png")
  end)

  it("can be farmed", function()
    bench:write("film.lua", film())
    for _, ending in ipairs { "ora", "psd", "png", "exr" } do
      local code, err, out = run(("farm film.lua --commands --layers cels -o 'x.#.%s'")
        :format(ending))
      assert.equal(0, code, err)
      assert.truthy(out:find("--layers cels", 1, true), out)
    end
    local code, err = run "farm film.lua --commands --layers cels -o 'x.#.tif'"
    assert.not_equal(0, code)
    local words = "tif takes no --layers"
    assert.truthy(err:find(words, 1, true), err)
  end)
end)
