--- Palettes of painting programs, and drawings in the colours of another one.
local celspan = require "celspan"
local colour = require "celspan.colour"
local ink = require "celspan.ink"
local layers = require "celspan.layers"
local paintings = require "tests.support.paintings"

local day = { skin = "#f2c6a0", hair = "#5a3424", shirt = "#c8402e", line = "#1c1420",
              sky = "#9bd1ff", white = "#ffffff" }
local night = { skin = "#8a6a90", hair = "#221a3a", shirt = "#5c2450", line = "#0a0814",
                sky = "#101a33", white = "#a8b0d8" }

local folder

--- An archive of members { name, text }.
local function zip(...)
  local members = {}
  for i, one in ipairs { ... } do members[i] = { name = one[1], data = one[2] } end
  return paintings.zip(members)
end

local function path(name) return folder .. "/" .. name end

local function write(name, bytes)
  local file = assert(io.open(path(name), "wb"))
  file:write(bytes)
  file:close()
  return path(name)
end

setup(function()
  folder = os.tmpname()
  os.remove(folder)
  assert(os.execute("mkdir " .. folder))
end)
teardown(function() os.execute("rm -rf " .. folder) end)

-- ---------------------------------------------------------------- palettes

local function utf16(text)
  local units = {}
  for _, point in utf8.codes(text) do
    if point < 0x10000 then
      units[#units + 1] = (">I2"):pack(point)
    else
      point = point - 0x10000
      units[#units + 1] = (">I2I2"):pack(0xd800 + point // 1024, 0xdc00 + point % 1024)
    end
  end
  return table.concat(units) .. "\0\0"
end

local function ase_colour(name, model, ...)
  local text = utf16(name)
  local body = (">I2"):pack(#text // 2) .. text .. model .. (">" .. ("f"):rep(select("#", ...)))
    :pack(...) .. "\0\2"
  return (">I2I4"):pack(1, #body) .. body
end

local function ase(...)
  return "ASEF" .. (">I2I2I4"):pack(1, 0, select("#", ...)) .. table.concat { ... }
end

local function ase_group(name)
  local text = utf16(name)
  local body = (">I2"):pack(#text // 2) .. text
  return (">I2I4"):pack(0xc001, #body) .. body
end

--- Colours are { name, space, four numbers }.
local function aco(colours)
  local first, second = { (">I2I2"):pack(1, #colours) }, { (">I2I2"):pack(2, #colours) }
  for i, c in ipairs(colours) do
    local numbers, text = (">I2I2I2I2I2"):pack(table.unpack(c, 2)), utf16(c[1])
    first[i + 1], second[i + 1] = numbers, numbers .. (">I4"):pack(#text // 2) .. text
  end
  return table.concat(first), table.concat(second)
end

local function entry(name, colour_element)
  return ('<ColorSetEntry name="%s" id="" bitdepth="U8" spot="false">%s<Position row="0" '
    .. 'column="0"/></ColorSetEntry>'):format(name, colour_element)
end

local function kpl(entries)
  return zip({ "mimetype", "application/x-krita-palette" },
    { "colorset.xml", '<ColorSet version="2.0" name="hero" columns="8" rows="1">' .. entries
      .. "</ColorSet>\n" }, { "profiles.xml", "<Profiles/>" })
end

local function tpl(styles)
  return '<palette name="hero">\n  <version>\n    71 0 \n  </version>\n  <styles>\n' .. styles
    .. "  </styles>\n  <stylepages>\n    <page>\n      <name>\n        colors \n      </name>\n"
    .. "      <indices>\n        0 1 \n      </indices>\n    </page>\n  </stylepages>\n</palette>\n"
end

local function style(text) return "    <style>\n      " .. text .. " \n    </style>\n" end

describe("palettes of files", function()
  local wanted = { skin = "#f2c6a0", ["dark hair"] = "#5a3424", ["été & 𝄞"] = "#010203" }

  it("are read from each format", function()
    assert.same(wanted, colour.palette(write("a.gpl", "GIMP Palette\r\nName: hero\r\nColumns: 4\r\n"
      .. "# by hand\r\n242 198 160\tskin\r\n 90  52  36 dark hair \r\n\r\n1 2 3\tété & 𝄞\r\n")))
    assert.same(wanted, colour.palette(write("a.kpl", kpl(
      entry("skin", '<sRGB r="0.949020" g="0.776471" b="0.627451"/>')
      .. entry("dark hair",
        '<RGB space="sRGB-elle-V2-srgbtrc.icc" b="0.141176" r="0.352941" g="0.203922"/>')
      .. '<Group name="more" rows="2">'
      .. entry("&#xe9;té &amp; 𝄞", '<sRGB r="0.003922" g="0.007843" b="0.011765"/>')
      .. "</Group>"))))
    assert.same(wanted, colour.palette(write("a.ase", ase(ase_group "hero",
      ase_colour("skin", "RGB ", 242 / 255, 198 / 255, 160 / 255),
      ase_colour("dark hair", "RGB ", 90 / 255, 52 / 255, 36 / 255),
      ase_colour("été & 𝄞", "RGB ", 1 / 255, 2 / 255, 3 / 255), (">I2I4"):pack(0xc002, 0)))))
    local first, second = aco { { "skin", 0, 242 * 257, 198 * 257, 160 * 257, 0 },
      { "dark hair", 0, 90 * 257, 52 * 257, 36 * 257, 0 }, { "été & 𝄞", 0, 257, 514, 771, 0 } }
    assert.same(wanted, colour.palette(write("a.aco", first .. second)))
    assert.same({ ["#f2c6a0"] = "#f2c6a0", ["#5a3424"] = "#5a3424", ["#010203"] = "#010203" },
      colour.palette(write("old.aco", first)))
    assert.same(wanted, colour.palette(write("a.tpl", tpl(style "color_0 3 255 255 255 0"
      .. style "skin 3 242 198 160 255"
      .. style '_1 "|+1-2 hair" "@hair" "dark hair" 3 90 52 36 255'
      .. style "chalk 1100 1 2 3" .. style '"été & 𝄞" 3 1 2 3 255'))))
    assert.same(wanted, colour.palette(write("a.json",
      '{ "skin": "#f2c6a0", "dark hair": "#5a3424", "été & 𝄞": "#010203" }')))
  end)

  it("in CMYK, Lab and grey become sRGB", function()
    assert.same({ c = "#80bf00", l = "#ffffff", m = "#777777", red = "#ff0000", g = "#404040" },
      colour.palette(write("b.ase", ase(ase_colour("c", "CMYK", 0.5, 0.25, 1, 0),
        ase_colour("l", "LAB ", 1, 0, 0), ase_colour("m", "LAB ", 0.5, 0, 0),
        ase_colour("red", "LAB ", 0.5429, 80.805, 69.891), ase_colour("g", "Gray", 0.25)))))
    local _, named = aco { { "c", 2, 32768, 49151, 0, 65535 }, { "w", 9, 5000, 2500, 10000, 0 },
      { "m", 7, 5000, 0, 0, 0 }, { "red", 7, 5429, 8081, 6989, 0 }, { "g", 8, 7500, 0, 0, 0 } }
    assert.same({ c = "#80bf00", w = "#80bf00", m = "#777777", red = "#ff0000", g = "#404040" },
      colour.palette(write("b.aco", named)))
    assert.same({ c = "#80bf00", g = "#404040", l = "#bcbcbc" }, colour.palette(write("b.kpl", kpl(
      entry("c", '<CMYK c="0.5" m="0.25" y="1" k="0" space="any.icc"/>')
      .. entry("g", '<Gray g="0.25"/>')
      .. entry("l", '<RGB r="0.5" g="0.5" b="0.5" space="sRGB-elle-V2-g10.icc"/>')))))
  end)

  it("are sets of one palette", function()
    write("day.json", '{ "sky": "#ffffff" }')
    local palette = colour.palette { day = path "day.json", night = { sky = "#000000" } }
    assert.equal("#ffffff", palette:at "day".sky)
    assert.equal("#ffffff", colour.palette(path "day.json").sky)
  end)

  it("may have ten thousand colours", function()
    local lines = { "GIMP Palette" }
    for i = 0, 9999 do lines[i + 2] = ("%d %d %d c%d"):format(i % 256, i // 256, 7, i) end
    local palette = colour.palette(write("c.gpl", table.concat(lines, "\n")))
    assert.equal("#0f2707", palette.c9999)
    local new = {}
    for name in pairs(palette) do new[name] = "#123456" end
    assert.is_truthy(ink.recolour(celspan.circle { 9, 9, 5, texture = "#0f2707" }, palette, new))
  end)

  it("that are wrong are refused with the place", function()
    local whole = aco { { "a", 0, 1, 2, 3, 0 } }
    local named = select(2, aco { { "a", 0, 1, 2, 3, 0 }, { "b", 14, 1, 2, 3, 0 } })
    local bad = {
      ["no.gpl"] = { "GIMP\n", "does not begin with 'GIMP Palette'" },
      ["line.gpl"] = { "GIMP Palette\n1 2 3 a\n1 2 256 b\n", "line 3 is no colour" },
      ["twice.gpl"] = { "GIMP Palette\n1 2 3 a\n1 2 4 a\n",
                        "the name 'a' is there twice, for #010203 and for #010204" },
      ["empty.gpl"] = { "GIMP Palette\n", "the palette has no colours" },
      ["a.pal"] = { "", "a palette is a %.gpl, %.kpl" },
      ["zip.kpl"] = { "PK", "zip.kpl" },
      ["none.kpl"] = { zip { "a", "b" }, "has no 'colorset.xml'" },
      ["cut.kpl"] = { zip { "colorset.xml", "<ColorSet><ColorSetEntry" },
                      "no whole colour set" },
      ["lab.kpl"] = { kpl(entry("a", '<Lab L="1" a="0" b="0" space="Lab"/>')),
                      "the colour 'a' is Lab of the space 'Lab'; make it an sRGB colour" },
      ["wide.kpl"] = { kpl(entry("a", '<RGB r="1" g="0" b="0" space="Rec2020"/>')),
                       "is RGB of the space 'Rec2020'" },
      ["number.kpl"] = { kpl(entry("a", '<sRGB r="1" g="0"/>')), "'a' has no number 'b'" },
      ["no.ase"] = { "ASEG" .. ("\0"):rep(20), "begin with 'ASEF'" },
      ["cut.ase"] = { ase(ase_colour("a", "RGB ", 0, 0, 0)):sub(1, -9), "ends after" },
      ["model.ase"] = { ase(ase_colour("a", "HSB ", 0, 0, 0)),
                        "block 1, 'a', has an unknown model" },
      ["nan.ase"] = { ase(ase_colour("a", "RGB ", 0 / 0, 0, 0)), "not finite" },
      ["cut.aco"] = { whole:sub(1, -3), "ends after" },
      ["space.aco"] = { named, "colour 2, 'b', has the unknown space 14" },
      ["version.aco"] = { "\0\9\0\0", "version 1 or 2" },
      ["cut.tpl"] = { tpl(style "a 3 1 2 3 255"):sub(1, -12), "no whole palette of Toonz" },
      ["quote.tpl"] = { tpl(style '"a 3 1 2 3 255'), "a name of a style does not end" },
      ["kind.tpl"] = { tpl(style "a"), "the style 'a' has no kind" },
      ["number.tpl"] = { tpl(style "a 3 1 2"), "the style 'a' is no colour" },
      ["twice.json"] = { '{ "a": "#fff", "a": "#000" }', "the name 'a' is there twice" },
      ["list.json"] = { '["#fff"]', "'1' must be a colour" },
      ["word.json"] = { '{ "a": "skin" }', "'a' must be a colour" },
      ["cut.json"] = { '{ "a": ', "cut.json" },
    }
    for name, case in pairs(bad) do
      local good, message = pcall(colour.palette, write(name, case[1]))
      assert.is_false(good, name)
      assert.matches(case[2], message, 1, false, name)
      assert.matches(name, message, 1, true)
    end
    assert.error_matches(function() colour.palette "missing.gpl" end, "missing.gpl")
  end)
end)

-- ---------------------------------------------------------------- recolouring

--- A little character; with three places where three colours meet if it has a sky.
local function hero(p, has_sky)
  return { has_sky and celspan.rect { 0, 0, 120, 120, texture = p.sky },
    celspan.path { d = "M24 120 C30 84 90 84 96 120 Z", texture = p.shirt },
    celspan.circle { 60, 50.3, 30, texture = p.skin },
    celspan.ellipse { 50, 53, 5, 7, texture = p.white },
    celspan.circle { 50.7, 54, 2.4, texture = p.line },
    celspan.stroke { d = "M48 66 Q60 74 70 65", width = 0.7, texture = p.line },
    celspan.stroke { d = "M8 8 L 112 15", width = 1, texture = p.line },
    celspan.rect { 10.37, 90, 5, 20, texture = p.hair } }
end

local function film(objects)
  return celspan.film { size = { 120, 120 }, space = "srgb",
    frame = function() return celspan.rostrum { celspan.cel(objects) } end }
end

local function picture(name, objects, depth)
  assert(celspan.render(film(objects), path(name), { depth = depth }))
  return celspan.image { file = path(name) }
end

local function codes(objects, depth)
  return assert(celspan.pixels(film(objects), { frame = 1 })):bytes { depth = depth,
    colour = "srgb", alpha = "straight" }
end

--- The greatest difference of two pictures, and how many pixels differ by more than a code; of
--- faint pixels by what is seen of it.
local function difference(a, b, depth)
  local format = depth == 8 and "BBBB" or "<I2I2I2I2"
  local worst, many, at, other = 0, 0, 1, 1
  while at <= #a do
    local p, q = { format:unpack(a, at) }, { format:unpack(b, other) }
    at, other = p[5], q[5]
    local most = math.abs(p[4] - q[4])
    for c = 1, 3 do
      most = math.max(most, math.abs(p[c] - q[c]) * q[4] / (depth == 8 and 255 or 65535))
    end
    worst, many = math.max(worst, most), many + (most > 1 and 1 or 0)
  end
  return worst, many
end

describe("recolouring", function()
  for _, depth in ipairs { 8, 16 } do
    for _, has_sky in ipairs { true, false } do
      it(("is the drawing in the other palette, %d bits, %s"):format(depth,
        has_sky and "opaque" or "alpha"), function()
          local name = ("%d%s"):format(depth, has_sky and "s" or "")
          local old = picture(name .. "day.png", hero(day, has_sky), depth)
          local new = picture(name .. "night.png", hero(night, has_sky), depth)
          local made, strange = ink.recolour(old, day, night, { strict = true })
          local worst, many = difference(codes({ made }, depth), codes({ new }, depth), depth)
          assert.same({}, strange)
          assert.is_true(many <= 2 and worst <= (depth == 8 and 2 or 300),
            ("%d pixels, by up to %g"):format(many, worst))
        end)
    end
  end

  it("reaches all that is painted", function()
    local blob = celspan.circle { 60, 60, 20, texture = "#f2c6a0" }
    local function all(c, d)
      local disc = celspan.circle { 60, 60, 20, texture = c }
      return celspan.rostrum { size = { 120, 120 }, celspan.cel {
        disc:blur(3):fade(0.5), disc:shadow { 3, 4, blur = 2 }:rotate(20),
        celspan.rect { 0, 0, 40, 40, texture = celspan.linear { from = { 0, 0 }, to = { 40, 0 },
          spread = "repeat", { 0, c }, { 0.3, d } } },
        celspan.rect { 0, 60, 40, 40, texture = celspan.pattern { art = celspan.circle { 4, 4, 3,
          texture = d }, box = { 0, 0, 8, 8 } } },
        celspan.stroke { d = "M10 100 C50 20 70 150 110 60", width = 5, dash = { 9, 4 },
                         texture = c },
        celspan.difference { disc:translate(30, 0), blob },
        celspan.matte(disc, blob, { from = "luma" }),
        celspan.clip(celspan.rect { 70, 70, 30, 30, texture = d }, blob),
      } }
    end
    local function drawn(rostrum)
      return assert(celspan.pixels(rostrum, { size = { 120, 120 } })):bytes { depth = 16 }
    end
    local made = ink.recolour(all("#f2c6a0", "#5a342480"), day, night)
    assert.equal(drawn(all("#8a6a90", "#221a3a80")), drawn(made))
  end)

  it("reaches the layers of a painting", function()
    local function tree_of(name, p)
      assert(os.execute("mkdir " .. path(name)))
      picture(name .. "/1.png", { celspan.circle { 60, 60, 30, texture = p.skin } }, 8)
      picture(name .. "/2.png", { celspan.circle { 70, 60, 20, texture = p.hair } }, 8)
      return assert(layers.read(path(name)))
    end
    local old, new = tree_of("old", day), tree_of("new", night)
    local made = ink.recolour(old, day, night)
    assert.equal("2", made:find "2".name)
    for _, both in ipairs { { made.object, new.object }, { made[1].object, new[1].object } } do
      assert.is_true(difference(codes({ both[1] }, 8), codes({ both[2] }, 8), 8) <= 1)
    end
    assert.equal(2, #made:cels())
  end)

  it("keeps what has no colour of the table", function()
    local disc = celspan.circle { 20, 20, 10, texture = "#123456" }:named "hat"
    local made, strange = ink.recolour({ disc, n = 3 }, { ["#000"] = "#fff" }, { strict = true })
    assert.equal(3, made.n)
    assert.equal(1, #strange)
    assert.same({ "#123456", 1, nil }, { strange[1].colour, strange[1].count, strange[1].x })
    assert.matches("'hat' %(.*palettes_spec.lua:%d+%)", strange[1].place)
  end)

  it("changes the part of an edge beside another colour", function()
    local function art(c)
      return { celspan.rect { 0, 0, 120, 120, texture = "#204060" },
               celspan.circle { 60, 60, 30.4, texture = c } }
    end
    local old = picture("edge.png", art "#f2c6a0", 8)
    local made, strange = ink.recolour(old, "#f2c6a0", "#8a6a90", { strict = true })
    local new = picture("edgenew.png", art "#8a6a90", 8)
    assert.is_true(difference(codes({ made }, 8), codes({ new }, 8), 8) <= 1)
    assert.same({ "#204060", 0, 0 }, { strange[1].colour, strange[1].x, strange[1].y })
    assert.equal(1, #strange)
  end)

  it("mixes light in the linear space", function()
    local function art(c, d)
      return celspan.film { size = { 60, 60 }, frame = function()
        return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 60, 60, texture = c },
          celspan.circle { 30, 30, 20.3, texture = d } } }
      end }
    end
    local function pixels(value)
      return assert(celspan.pixels(value, { frame = 1 })):bytes { depth = 16, colour = "srgb" }
    end
    assert(celspan.render(art("#f2c6a0", "#c8402e"), path "light.png", { depth = 16 }))
    local made = ink.recolour(celspan.image { file = path "light.png" }, day, night,
      { space = "linear" })
    local shown = celspan.film { size = { 60, 60 }, frame = function()
      return celspan.rostrum { celspan.cel { made } }
    end }
    assert.is_true(difference(pixels(shown), pixels(art("#8a6a90", "#5c2450")), 16) <= 2)
  end)

  it("refuses palettes that do not say what becomes of a colour", function()
    local disc = celspan.circle { 20, 20, 10 }
    local wrong = {
      ["only the first palette has 'a'"] = { { a = "#fff" }, { b = "#fff" } },
      ["only the second palette has 'b'"] = { { a = "#fff" }, { a = "#fff", b = "#000" } },
      ["'a' and 'b' are one colour, and become two"] = { { a = "#fff", b = "#ffffff" },
                                                         { a = "#000", b = "#111" } },
      ["only the first palette has 'line'"] = { { line = "#fff" }, {} },
      ["takes two palettes, two colours, or a table of new colours by old ones, got nil"] = {
        "#fff" },
      ["there are no colours"] = { {} },
      ["'a' must be a colour, such as \"#f2c6a0\", got \"skin\""] = { { a = "skin" },
                                                                      { a = "#fff" } },
      ["the new colour of 'a' must have an alpha of 1, got 0"] = { { a = "#fff" },
                                                                   { a = "#0000" } },
      ["space must be \"linear\" or \"srgb\", got \"oklab\""] = { { ["#fff"] = "#000" }, nil,
                                                                { space = "oklab" } },
    }
    for message, case in pairs(wrong) do
      local good, got = pcall(ink.recolour, disc, table.unpack(case, 1, 3))
      assert.is_false(good, message)
      assert.matches(message, got, 1, true)
    end
    assert.error_matches(function() ink.recolour(7, day, night) end, "takes objects, cels")
    local twice = { disc }
    assert.equal(2, #ink.recolour({ twice, twice }, { ["#000"] = "#fff" }, {}))
    twice[2] = { twice }
    assert.error_matches(function() ink.recolour(twice, day, night) end, "a table contains itself")
    assert.error_matches(function() return ink.recoat end, "has no 'recoat'")
  end)
end)
