-- celspan info: what it prints about films, pictures and other files.

local PLAIN = require "tests.support.plain_film"
local profile = require "tests.support.profile"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local BINARY = workbench.binary
--- A limit of a program's memory; one with a sanitizer maps far more than it uses.
local BOUNDED = present.sanitizer() and "" or "ulimit -v 1000000; "

local bench, folder

local function read(path) return bench:read(path) end
local function write(name, text) return bench:write(name, text) end
local function shell(command) return bench:shell(command) end
local function celspan(arguments) return bench:shell("'" .. BINARY .. "' " .. arguments) end

local it_reads_pictures = present.pictures() and it or pending

describe("the verb info", function()
  local plain

  before_each(function()
    bench = workbench.new()
    folder = bench.folder
    plain = write("plain.lua", PLAIN)
  end)

  after_each(function() bench:remove() end)

  describe("of a film", function()
    it("prints a film in figures", function()
      local code, out, err = celspan("info " .. plain)
      assert.equal(0, code, err)
      assert.equal("title plain\nframes 12\nfirst 1\nlast 12\nfps 12\nseconds 1\nsize 8x4\n"
        .. "cels 1\nprimitives 2\npictures 0\ndifferent 12\n", out)
    end)
  end)

  describe("of other files than scripts", function()
    local function picture(name)
      local path = folder .. "/" .. name
      local code, _, err = celspan("render " .. plain .. " --progress none --frames 2 -o " .. path)
      assert.equal(0, code, err)
      return path, #read(path)
    end

    it_reads_pictures("prints the header of a picture, whatever its name", function()
      local path, bytes = picture "a.png"
      local expected = ("format png\nsize 8x4\nchannels 4\nalpha straight\ndepth 8\ncolour srgb\n"
        .. "colour_from format\n"
        .. "bytes %d\nsubimages 1\nsubimage 0 size 8x4 channels 4 depth 8\n"):format(bytes)
      assert.same({ 0, expected, "" }, { celspan("info " .. path) })
      assert.same({ 0, expected, "" }, { celspan("info " .. write("a.lua", read(path))) })
      local _, out = celspan("info " .. (picture "a.exr"))
      assert.truthy(out:find("format openexr\nsize 8x4\nchannels 4\nalpha "
        .. "premultiplied\ndepth half\n"
        .. "colour linear\n", 1, true), out)
    end)

    it_reads_pictures("names the profile of a picture, and says what is taken instead", function()
      local files = { png = read(picture "a.png"), jpg = read(picture "a.jpg") }
      local function named(kind, bytes)
        local add = profile[kind == "png" and "png" or "jpeg"]
        local _, out = celspan("info " .. write("a." .. kind, add(files[kind], bytes)))
        return out:match "colour srgb\ncolour_from format\nprofile (.-)\nprimaries_taken bt709\n"
      end
      local wide = "P3 \u{e9}\u{20ac}\u{1f3a8}\u{ffff}"
      for _, kind in ipairs { "png", "jpg" } do
        assert.equal("sRGB (flat)", named(kind, profile.of(profile.plain "sRGB (flat)", 2)))
        assert.equal(wide, named(kind, profile.of(profile.wide(wide), 4)))
        assert.equal("a?b", named(kind, profile.of(profile.plain "a\nb", 2)))
        assert.equal(("n"):rep(255), named(kind, profile.of(profile.plain(("n"):rep(400)), 2)))
      end
      local whole = profile.of(profile.wide "cut off", 4)
      for _, size in ipairs { 1, 130, 140, 150, #whole - 4 } do
        assert.equal("without a name", named("jpg", whole:sub(1, size)))
      end
    end)

    it_reads_pictures("recognises pictures that are text", function()
      local _, out = celspan("info " .. write("a.ppm", "P3\n# two\n2 1\n255\n1 2 3 4 5 6\n"))
      assert.truthy(out:find("format pnm\nsize 2x1\nchannels 3\nalpha none\n", 1, true), out)
    end)

    it_reads_pictures("names subimages and layers as `layer` accepts them", function()
      local material = present.material
      if not material then return pending "CELSPAN_MATERIAL is not set" end
      local _, out = celspan("info " .. material .. "/psd/2layers.psd")
      assert.truthy(out:find("subimages 3\nsubimage 0 size 101x55 channels 3 depth 8\n"
        .. "subimage 1 size 101x55 channels 3 depth 8 layer \u{424}\u{43e}\u{43d}\n"
        .. "subimage 2 size 85x46 channels 4 depth 8 layer \u{421}\u{43b}\u{43e}\u{439}\n", 1,
        true), out)
    end)

    describe("that contain artwork", function()
      local paintings = require "tests.support.paintings"
      local it_reads_artwork = present.type() and it or pending

      local function dot(x, y) return x * 80, y * 80, 0, 255 end

      it_reads_artwork("lists the layers of an archive, and what is skipped", function()
        local path = write("a.ora", paintings.openraster { w = 20, h = 10, layers = {
          { name = "ground", x = 0, y = 0, w = 3, h = 2, pixel = dot },
          { name = "far\tgroup", opacity = 0.5, visible = false, layers = {
            { name = "haze", x = 4, y = 5, w = 2, h = 2, blend = "svg:glow",
              pixel = dot } } } } })
        assert.same({ 0, "format painting\ncanvas 20x10\nlayers 2\ngroups 1\n"
          .. "layer size 3x2 at 0,0 blend normal opacity 1 visible yes name ground\n"
          .. "layer size 2x2 at 4,5 blend glow opacity 1 visible yes name far group/haze\n"
          .. "group blend normal opacity 0.5 visible no name far group\n"
          .. "skipped far group/haze: blend mode \"glow\": it is shown as normal\n", "" },
          { celspan("info " .. path) })
      end)

      it_reads_pictures("describes a Photoshop document as a picture and as a painting", function()
        local psd = paintings.psd { w = 20, h = 10, layers = {
          { name = "ink", x = 1, y = 2, w = 3, h = 2, pixel = dot, blend = "mul " } } }
        local code, out, err = celspan("info " .. write("a.psd", psd))
        assert.equal(0, code, err)
        assert.truthy(out:find("^format psd\nsize 20x10\n"), out)
        assert.truthy(out:find("\ncanvas 20x10\nlayers 1\ngroups 0\n"
          .. "layer size 3x2 at 1,2 blend multiply opacity 1 visible yes name ink\n$"), out)
        local material = present.material
        if not material then return pending "CELSPAN_MATERIAL is not set" end
        code, out, err = celspan("info " .. material .. "/psd/colormodes/4x4_8bit_cmyk.psd")
        assert.equal(0, code, err)
        assert.truthy(out:find("\nlayers unread: [^\n]*is a Photoshop document in CMYK "
          .. "colour[^\n]*\n$"), out)
      end)

      it_reads_artwork("lists the parts of a drawing", function()
        local svg = write("a.svg",
          '\n<svg xmlns="http://www.w3.org/2000/svg" width="40" height="30">'
          .. '<rect id="hat" x="3" y="4" width="10" height="5"/>\n<foreignObject width="4" '
          .. 'height="4"/></svg>')
        local code, out, err = celspan("info " .. svg)
        assert.equal(0, code, err)
        assert.truthy(out:find("^format svg\nsize 40x30\nparts %d\n"), out)
        assert.truthy(out:find("\npart size 10x5 at 3,4 name hat\n", 1, true), out)
        assert.truthy(out:find "\nskipped line 3: [^\n]+\n$", out)
      end)

      it_reads_artwork("reports what is wrong with it", function()
        local function refused(path, pattern)
          local code, out, err = celspan("info " .. path)
          assert.same({ 4, "" }, { code, out })
          assert.truthy(err:find(pattern), err)
        end
        refused(write("b.ora", "PK\3\4 and no more"), "b%.ora: ")
        refused(write("b.svg", "<svg"), "b%.svg")
        shell("mkdir -p " .. folder .. "/empty")
        refused(folder .. "/empty", "the folder holds no pictures")
      end)
    end)

    --- An OpenEXR file of one pixel, all 1 or with these bits, with these channels of half floats.
    local function exr(channels, bits)
      local function attribute(name, kind, value)
        return name .. "\0" .. kind .. "\0" .. string.pack("<s4", value)
      end
      local list, box = "", string.pack("<i4i4i4i4", 0, 0, 0, 0)
      for _, name in ipairs(channels) do
        list = list .. name .. "\0" .. string.pack("<i4I4i4i4", 1, 0, 1, 1)
      end
      local head = "\x76\x2f\x31\x01\2\0\0\0" .. attribute("channels", "chlist", list .. "\0")
        .. attribute("compression", "compression", "\0") .. attribute("dataWindow", "box2i", box)
        .. attribute("displayWindow", "box2i", box) .. attribute("lineOrder", "lineOrder", "\0")
        .. attribute("pixelAspectRatio", "float", string.pack("<f", 1))
        .. attribute("screenWindowCenter", "v2f", string.pack("<ff", 0, 0))
        .. attribute("screenWindowWidth", "float", string.pack("<f", 1)) .. "\0"
      return head .. string.pack("<I8", #head + 8)
        .. string.pack("<i4s4", 0, string.pack("<I2", bits or 0x3c00):rep(#channels))
    end

    it_reads_pictures(
      "shows light below 0, and above any display's range, in span files too", function()
      write("one.exr", exr { "B", "G", "R" })
      for bits, difference in pairs { [0xbc00] = 2, [0x7bff] = 106.104507, [0x7c00] = 106.104507,
        [0xfc00] = 108.104507, [0x8000] = 1,
        [0x0001] = 0.99999923 } do
        write("other.exr", exr({ "B", "G", "R" }, bits))
        assert.equal(0,
          (celspan(("convert %s/other.exr %s/other.span --depth half"):format(folder, folder))))
        for _, ending in ipairs { "exr", "span" } do
          local code, out, err = celspan(("compare %s/other.%s %s/one.exr")
            :format(folder, ending, folder))
          assert.equal(1, code, err)
          assert.equal(("largest_difference %.9g x 0 y 0 channel r pixels_differing 1 pixels 1\n")
            :format(difference), out)
        end
      end
    end)

    it_reads_pictures("names groups of channels as layers", function()
      local path = write("a.exr",
        exr { "B", "G", "R", "beauty.key.B", "beauty.key.G", "beauty.key.R",
        "depth.Z", "fog.A", "fog.Y" })
      local code, out, err = celspan("info " .. path)
      assert.equal(0, code, err)
      assert.truthy(out:find("channels 9\nalpha none\ndepth half\n", 1, true), out)
      assert.truthy(out:find("subimages 1\nsubimage 0 size 1x1 channels 9 depth half\n"
        .. "layer beauty.key channels 3\nlayer fog channels 2\n$"), out)
      for layer, expected in pairs { ["beauty.key"] = 0, fog = 0, depth = 4 } do
        local script = write("layer.lua", ([[
          local celspan = require "celspan"
          return celspan.rostrum{ celspan.cel{ celspan.image{ file = "a.exr", layer = %q } }
            }]]):format(layer))
        assert.equal(expected, (celspan("check --deep " .. script)), layer)
      end
    end)

    it_reads_pictures("reports other binary data as unknown", function()
      local code, out, err = celspan("info " .. write("a.bin", "none of\0these"))
      assert.same({ 4, "" }, { code, out })
      assert.truthy(err:find("a.bin: is not a picture of a known format", 1, true), err)
    end)

    it("lists names unless there are too many", function()
      local script = write("named.lua", [[
        local celspan = require "celspan"
        local cels = {}
        for i = 1, tonumber((...)) do cels[i] = celspan.cel{}:named("cel " .. i) end
        return celspan.rostrum(cels)]])
      local _, out = celspan("info " .. script .. " -- 1000")
      assert.equal(1000, select(2, out:gsub("named cel 1 cel %d+", "")))
      assert.falsy(out:find("named more", 1, true))
      _, out = celspan("info " .. script .. " -- 1001")
      assert.equal(1000, select(2, out:gsub("named cel 1 cel %d+", "")))
      assert.truthy(out:find("\nnamed more\n$"), out:sub(-100))
    end)

    it("is refused by the verbs that run a script", function()
      local path = write("a.lua", "\137PNG\r\n\26\n\0\0\0\rIHDR")
      for _, verb in ipairs { "render %s --hash", "check %s", "spans %s", "probe %s 1 2",
                              "tiles %s -o " .. folder .. "/t" } do
        local code, out, err = celspan(verb:format(path))
        assert.same({ 3, "" }, { code, out }, verb)
        assert.equal(("celspan: error: %s: is not a Lua script, a drawing, a painting or a movie, "
          .. "but a picture or other binary data, which is no film ('celspan info %s' describes "
          .. "it, 'celspan convert' makes pictures of it)\n"):format(path, path), err)
      end
    end)

    it("recognises text by its first words", function()
      local function is_script(text)
        local _, _, err = celspan("check " .. write("a.lua", text))
        return not err:find("is not a Lua script", 1, true)
      end
      for _, other in ipairs { "P1 2 2\n", "P3\n# four\n2 2", "P6\t1", "PF 1 1\n", "Pf\n1 1\n",
        "#?RADIANCE\n",
        "#?RGBE\n", "return 1 \127", "\0" } do
        assert.is_false(is_script(other), other)
      end
      for _, script in ipairs { "", "P", "P6", "P6 = 1", "P7 1 1", "P66 1", "#?RADIO", "#? RGBE",
        "#!/usr/bin/celspan\nreturn 1", "\v\f\r" } do
        assert.is_true(is_script(script), script)
      end
    end)

    it_reads_pictures("shows control characters in names of layers as blanks", function()
      local _, out = celspan("info "
        .. write("a.exr", exr { "B", "G", "R", "a\1b.B", "a\1b.G", "a\1b.R", "c\127.Y" }))
      assert.truthy(out:find("\nlayer a b channels 3\nlayer c  channels 1\n", 1, true), out)
    end)

    it("still runs scripts with odd beginnings or bytes, and from pipes", function()
      local script = "P1 = 3 -- \233\27\n" .. PLAIN
      assert.equal(0, (celspan("info " .. write("odd.lua", script))))
      assert.equal(0, (shell("cat " .. folder .. "/odd.lua | '" .. BINARY .. "' info /dev/stdin")))
    end)
  end)

  describe("of a very long film", function()
    it("distinguishes its scenes with bounded memory #plain", function()
      local script = write("long.lua", [[
        local celspan = require "celspan"
        return celspan.film{ size = {8, 4}, frames = 550000, frame = function(f)
          return celspan.rostrum{ brightness = f.number } end }]])
      local code, out, err = shell(BOUNDED .. "'" .. BINARY .. "' info " .. script)
      assert.equal(0, code, err)
      assert.truthy(out:find("\ndifferent_at_least 524288\n$"), out)
    end)
  end)
end)
