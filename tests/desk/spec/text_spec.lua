-- Text: its letters, their positions, text as a primitive, and refusals. The font is the project's
-- own, drawn by tests/support/block.lua, so that these tests run everywhere. One file, because the
-- same few letters are enough for all of them.
local celspan = require "celspan"
local block = require "tests.support.block"
local poster = require "tests.support.poster"
local present = require "tests.support.present"
local truetype = require "tests.support.truetype"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local FONT = "../../../scripts/type/block.ttf"
local PATH = "scripts/type/block.ttf"
local POSTER = "scripts/type/poster.ttf"

-- Built without the libraries for type, there is nothing to test except the font.
local it = present.type() and it or pending

local function read(path) return assert(system.read(path)) end

local function text(fields)
  fields.font = fields.font or FONT
  return celspan.text(fields)
end

local function glyphs(fields)
  fields.font = fields.font or FONT
  return celspan.glyphs(fields)
end

--- The texts of letters, joined by bars.
local function spelled(letters)
  local words = {}
  for i, letter in ipairs(letters) do words[i] = letter.text end
  return table.concat(words, "|")
end

--- The message of a call that must fail.
local function message_of(fields, constructor)
  local is_made, message = pcall(constructor or text, fields)
  assert.is_false(is_made)
  return tostring(message)
end

--- The lines of a text, as they were read.
local function lines_of(fields)
  local lines = {}
  for _, letter in ipairs(glyphs(fields)) do
    lines[letter.line] = (lines[letter.line] or "") .. letter.text
  end
  return table.concat(lines, "/")
end

local function same_pixels(a, b)
  local function bytes(object)
    return celspan.pixels(celspan.rostrum { celspan.cel { object } },
      { size = { 320, 120 }, film = { 640, 240 } }):bytes()
  end
  return bytes(a) == bytes(b)
end

local made = {}
local function temporary(bytes)
  local path = os.tmpname()
  made[#made + 1] = path
  block.write(path, bytes)
  return path
end

teardown(function() for _, path in ipairs(made) do os.remove(path) end end)

-- ---------------------------------------------------------------- the font

describe("the font that ships", function()
  it("is what its program makes", function()
    assert.is_true(truetype.build(block.font()) == read(PATH))
    assert.is_true(truetype.build(poster.font()) == read(POSTER))
  end)

  it("has a display font beside it, in which no line goes back on itself", function()
    local seen = 0
    local function check(a, b, c, name)
      local x, y, u, v = b[1] - a[1], b[2] - a[2], c[1] - b[1], c[2] - b[2]
      assert.is_false(x * v == y * u and x * u + y * v < 0, name)
      seen = seen + 1
    end
    for _, glyph in ipairs(poster.font().glyphs) do
      for _, form in ipairs(glyph.components and {} or { "least", "contours", "most" }) do
        for _, contour in ipairs(glyph[form]) do
          local count = #contour
          for i = 1, count do
            check(contour[i], contour[i % count + 1], contour[(i + 1) % count + 1],
              ("U+%04X %s"):format(glyph.characters[1] or 0, form))
          end
        end
      end
    end
    assert.is_true(seen > 5000, seen)
  end)

  it("has a display font beside it, whose letters and accents become broader", function()
    local function width(words, wdth)
      local line = celspan.text { words, font = "../../../" .. POSTER, size = 1000,
        variations = { wdth = wdth } }
      local _, _, inked = line:bounds()
      return { line:metrics().width, inked }
    end
    assert.are.same({ 356, 296 }, width("H", 70))
    assert.are.same({ 1020, 960 }, width("H", 225))
    assert.are.equal(width("H", 225)[1], width("É", 225)[1] + 143)
  end)
end)

-- ---------------------------------------------------------------- letters

describe("letters", function()
  it("lie side by side by their advances", function()
    local letters = glyphs { "HI", size = 1000, at = { 100, 50 } }
    assert.are.equal("H|I", spelled(letters))
    assert.are.same({ 100, 620 }, { letters[1].x, letters[1].advance })
    assert.are.same({ 720, 180, 50 }, { letters[2].x, letters[2].advance, letters[2].y })
  end)

  it("have the outline of the font, upright", function()
    -- I: a pen of half 44 from (90, 44) to (90, 656), y up
    local x, y, w, h = text({ "I", size = 1000, at = { 0, 1000 } }):bounds()
    assert.are.same({ 46, 300, 88, 700 }, { x, y, w, h })
  end)

  it("are kerned, unless that is switched off", function()
    local function width(features)
      local letters = glyphs { "AV", size = 1000, features = features }
      return letters[2].x + letters[2].advance - letters[1].x
    end
    assert.are.equal(90, width { kern = false } - width {})
  end)

  it("can form ligatures, which are one letter", function()
    assert.are.equal("->|H", spelled(glyphs { "->H" }))
    assert.are.equal("-|>|H", spelled(glyphs { "->H", features = { liga = false } }))
    assert.are.equal("-|>|H", spelled(glyphs { "->H", features = { liga = 0 } }))
  end)

  it("keep their marks", function()
    local letters = glyphs { "Hb\u{301}H", size = 1000 }
    assert.are.equal("H|b\u{301}|H", spelled(letters))
    local _, y = letters[2].object:bounds()
    local _, bare = glyphs({ "b", size = 1000 })[1].object:bounds()
    assert.is_true(y < bare)
  end)

  it("may be made of other glyphs, at every weight", function()
    for _, weight in ipairs { 200, 400, 900 } do
      local function bounds(words)
        return { text({ words, size = 1000, variations = { wght = weight } }):bounds() }
      end
      local bare, marked = bounds "U", bounds "Ü"
      assert.are.same({ bare[1], bare[3] }, { marked[1], marked[3] })
      assert.are.equal(bare[4] + 165, marked[4])
      assert.are.same(marked, bounds "U\u{308}")
    end
    assert.are.equal("ÅßÇ€@%&", (spelled(glyphs { "ÅßÇ€@%&" }):gsub("|", "")))
  end)

  it("have the weight of the variation", function()
    local function width(weight)
      local _, _, w = text({ "I", size = 1000, variations = { wght = weight } }):bounds()
      return w
    end
    assert.are.same({ 44, 88, 148 }, { width(200), width(400), width(900) })
    assert.are.equal(118, width(650))
    assert.are.equal(148, width(5000)) -- clamped to the range of the axis
  end)

  it("that overlap themselves are filled completely", function()
    -- T: the middle of the crossing of its lines
    assert.is_true(text({ "T", size = 1000, at = { 0, 1000 } }):contains(320, 344))
    local b = text { "B", size = 1000, at = { 0, 1000 } }
    assert.is_false(b:contains(250, 800)) -- its counter
  end)

  it("look together like the text", function()
    local union = {}
    local fields = { "Hi there,\nAVE ->", size = 80, at = { 20, 80 }, tracking = 40,
      texture = celspan.linear { from = { 0, 0 }, to = { 600, 0 }, { 0, "#f00" }, { 1, "#00f" } } }
    for i, letter in ipairs(glyphs(fields)) do union[i] = letter.object end
    assert.is_true(same_pixels(text(fields), celspan.union(union)))
  end)

  it("can be changed one by one", function()
    local letters = glyphs { "AB", size = 100, texture = "#f00" }
    local blue = letters[2].object:with { texture = "#00f" }
    assert.are.equal("#00f", blue.texture)
    assert.are.equal(2, blue.index)
    assert.are.same({ letters[2].object:bounds() }, { blue:bounds() })
    assert.is_truthy(message_of({ "AB", index = 3 }, function()
      return letters[2].object:with { "A" }
    end):find("index", 1, true))
  end)

  it("come in the order of reading", function()
    local letters = glyphs { "ab שלו cd", size = 100 }
    assert.are.equal("a|b| |ש|ל|ו| |c|d", spelled(letters))
    assert.is_true(letters[4].x > letters[5].x and letters[5].x > letters[6].x)
    assert.is_true(letters[8].x > letters[4].x and letters[2].x < letters[6].x)
  end)
end)

-- ---------------------------------------------------------------- lines

describe("lines", function()
  it("end at line breaks, one under the other", function()
    local letters = glyphs { "A\n\nB\r\nC", size = 100, leading = 1.5, at = { 0, 10 } }
    assert.are.equal("A|B|C", spelled(letters))
    local places = {}
    for i, letter in ipairs(letters) do places[i] = { letter.line, letter.y } end
    assert.are.same({ { 1, 10 }, { 3, 310 }, { 4, 460 } }, places)
  end)

  it("are aligned at their position", function()
    local function ends(align, width, tracking)
      local letters = glyphs { "HH ", size = 1000, at = { 100, 0 }, align = align, width = width,
        tracking = tracking }
      return { letters[1].x, letters[2].x + letters[2].advance }
    end
    assert.are.same({ 100, 1340 }, ends "left")
    assert.are.same({ -520, 720 }, ends "centre")
    assert.are.same({ -1140, 100 }, ends "right")
    assert.are.same({ 100, 1340 }, ends("left", 2000))
    assert.are.same({ 480, 1720 }, ends("centre", 2000))
    assert.are.same({ 860, 2100 }, ends("right", 2000))
    assert.are.same({ -620, 720 },
      { ends("centre", nil, 100)[1] - 50, ends("centre", nil, 100)[2] - 50 })
  end)

  it("lie as `valign` says, by measures that scripts can ask for", function()
    local m = text { "Hx\nH", size = 50, leading = 2 }:scale(3):metrics()
    assert.are.equal(2, m.lines)
    assert.is_near(m.ascent + m.descent + 100, m.height, 1e-9)
    local function baseline(valign)
      return glyphs { "Hx\nH", size = 50, leading = 2, valign = valign }[1].y
    end
    assert.are.equal(0, baseline())
    for valign, y in pairs { top = m.ascent, cap = m.cap_height, bottom = -100 - m.descent,
                             middle = m.ascent - m.height / 2 } do
      assert.is_near(y, baseline(valign), 1e-9, valign)
    end
    assert.is_true(0 < m.x_height and m.x_height < m.cap_height and m.cap_height < m.ascent)
    local letter = glyphs { "H", size = 50 }[1]
    assert.is_near(text({ "H", size = 50 }):metrics().width, letter.advance, 1e-9)
    assert.are.same(text({ "2020", size = 50 }):metrics(), text({ 2020, size = 50 }):metrics())
    assert.has_error(function() celspan.circle { centre = { 0, 0 }, radius = 1 }:metrics() end,
      "metrics: only a text has them, not a circle")
    assert.truthy(message_of { "H", valign = "center" }:find('"cap", "middle"', 1, true))
  end)

  it("align left to the left in every script", function()
    local letters = glyphs { "שלום", size = 1000, at = { 100, 0 } }
    assert.are.equal(100, letters[4].x)
    letters = glyphs { "שלום", size = 1000, at = { 100, 0 }, align = "right" }
    assert.are.equal(100, letters[1].x + letters[1].advance)
  end)

  it("have the given direction if no letter determines one", function()
    local function first(direction, words)
      local letters = glyphs { words, size = 100, direction = direction }
      return letters[1].x
    end
    assert.are.equal(0, first("ltr", "A."))
    assert.is_true(first("rtl", ".A") > 0)
    assert.are.equal(0, first("auto", "A."))
    assert.are.equal(0, first(nil, ".A"))
  end)

  it("wrap before they are too long, where a break is allowed", function()
    local width = 62 + 52 + 2 * 62 -- of "HH HH" at size 100, without the gaps
    assert.are.equal("HH HH /HH", lines_of { "HH HH HH", size = 100, width = 5 * 62 })
    assert.are.equal("HH /HH /HH", lines_of { "HH HH HH", size = 100, width = width })
    assert.are.equal("HH HH HH", lines_of { "HH HH HH", size = 100, width = 1e6 })
    assert.are.equal("HHHH /H", lines_of { "HHHH H", size = 100, width = 70 })
    assert.are.equal("一/二/三。", lines_of { "一二三。", size = 100, width = 100 })
    assert.are.equal("H\u{a0}H /H", lines_of { "H\u{a0}H H", size = 100, width = 130 })
  end)

  it("that fit exactly are not wrapped", function()
    local letters = glyphs { "AVE THE HH", size = 37.7 }
    local width = letters[#letters].x + letters[#letters].advance
    assert.are.equal("AVE THE HH", lines_of { "AVE THE HH", size = 37.7, width = width })
    assert.are.equal("AVE THE /HH", lines_of { "AVE THE HH", size = 37.7, width = width - 0.01 })
  end)

  it("show a soft hyphen only if they end at it", function()
    local function right(width)
      local x, _, w = text({ "HH\u{ad}HH", size = 100, width = width }):bounds()
      return x + w
    end
    assert.is_true(right(200) > 140) -- two letters are 124 wide; the hyphen comes after them
    assert.are.equal("HH\u{ad}/HH", lines_of { "HH\u{ad}HH", size = 100, width = 200 })
    assert.is_true(math.abs(right(1000) - (3 * 62 + 57.4)) < 1e-9)
  end)

  it("are spaced by the tracking, in their direction", function()
    local letters = glyphs { "HH", size = 1000, tracking = 100 }
    assert.are.equal(720, letters[2].x - letters[1].x)
    assert.are.equal(620, letters[1].advance)
    local plain = glyphs { "של", size = 1000 }
    local spaced = glyphs { "של", size = 1000, tracking = 100 }
    assert.are.equal(100, (spaced[1].x - spaced[2].x) - (plain[1].x - plain[2].x))
  end)
end)

-- ---------------------------------------------------------------- fonts

describe("fonts", function()
  --- The font with only a few of its glyphs.
  local function part_of(characters)
    local font = block.font()
    for _, glyph in ipairs(font.glyphs) do
      local kept = {}
      for _, character in ipairs(glyph.characters) do
        if characters:find(utf8.char(character), 1, true) then kept[#kept + 1] = character end
      end
      glyph.characters = kept
    end
    font.units = 500 -- letters are twice as large
    return temporary(truetype.build(font))
  end

  it("replace one another, letter by letter", function()
    local large = part_of "AB "
    local letters = glyphs { "AHB", font = { large, FONT }, size = 100 }
    assert.are.equal("A|H|B", spelled(letters))
    assert.are.same({ 128, 62, 112 },
      { letters[1].advance, letters[2].advance, letters[3].advance })
    letters = glyphs { "אבג", font = { part_of "א", temporary(truetype.build((function()
      local font = block.font()
      font.glyphs[3].characters = { 0x5d1, 0x5d2 }
      return font
    end)())) }, size = 100 }
    assert.are.equal("א|ב|ג", spelled(letters))
    assert.is_true(letters[1].x > letters[2].x and letters[2].x > letters[3].x)
    letters = glyphs { "שול", font = { part_of "ל", FONT }, size = 100 }
    assert.are.equal("ש|ו|ל", spelled(letters))
    assert.are.same({ 62, 24, 96 }, { letters[1].advance, letters[2].advance, letters[3].advance })
  end)

  it("provide a letter and its marks together", function()
    local letters = glyphs { "Af\u{301}A", font = { part_of "Af", FONT }, size = 100 }
    assert.are.equal("A|f\u{301}|A", spelled(letters))
    assert.is_true(math.abs(letters[2].advance - 43.8) < 1e-9)
  end)

  it("that changed are read again", function()
    local path = part_of "AB"
    assert.are.equal(128, glyphs({ "A", font = path, size = 100 })[1].advance)
    block.write(path)
    assert.are.equal(64, glyphs({ "A", font = path, size = 100 })[1].advance)
  end)

  it("are searched next to the script that names them", function()
    local message = message_of { "A", font = "no-such.ttf" }
    assert.is_truthy(message:find("text: ", 1, true))
    assert.is_truthy(message:find("tests/desk/spec/no-such.ttf: No such file", 1, true), message)
  end)

  it("that are mistyped are refused with the nearest name in the folder", function()
    local near = message_of { "A", font = FONT:gsub("block%.ttf$", "blok.ttf") }
    assert.is_truthy(near:find('blok.ttf: No such file or directory; did you mean "block.ttf"? '
      .. "'celspan fonts' lists the fonts there are", 1, true), near)
    near = message_of { "A", font = FONT:gsub("type/block", "block") }
    assert.is_truthy(near:find('did you mean "type/block.ttf"?', 1, true), near)
  end)

  it("have letters whose methods are those of their objects", function()
    local letter = glyphs({ "A", font = FONT })[1]
    local _, message = pcall(function() letter:rotate(10) end)
    assert.is_truthy(message:find "a letter has no 'rotate': write letter.object:rotate%(...%)")
    assert.is_nil(letter.nothing)
    celspan.letters({ "A", font = FONT }, function(same)
      _, message = pcall(function() same:scale(2) end)
    end)
    assert.is_truthy(message:find "a letter has no 'scale': write letter.object:scale%(...%)")
  end)

  local bytes = read(PATH)
  local broken = {
    ["half of one"] = { bytes:sub(1, #bytes // 2), "the font is truncated" },
    ["its beginning"] = { bytes:sub(1, 200), "the font is truncated" },
    ["a few bytes"] = { bytes:sub(1, 8), "is not a TrueType or OpenType font" },
    ["nothing"] = { "", "is not a TrueType or OpenType font" },
    ["a picture"] = { "\137PNG\r\n\26\n" .. ("\0"):rep(100), "is not a TrueType or OpenType font" },
    ["one packed for the web"] = { "wOF2" .. ("\0"):rep(100), "convert it" },
    ["a collection of none"] = { "ttcf\0\1\0\0" .. ("\0"):rep(8), "is not a TrueType" },
    ["a collection that is cut"] = { "ttcf\0\1\0\0\0\0\0\1\0\0\1\0", "the font is truncated" },
  }
  for name, case in pairs(broken) do
    it("that are " .. name .. " are refused", function()
      local path = temporary(case[1])
      local message = message_of { "A", font = path }
      assert.is_truthy(message:find(path, 1, true), message)
      assert.is_truthy(message:find(case[2], 1, true), message)
    end)
  end

  it("of coloured glyphs, and without outlines, are refused", function()
    local tables = truetype.tables(block.font())
    tables.COLR = "\0\0\0\0"
    assert.is_truthy(message_of({ "A", font = temporary(truetype.join(tables)) })
      :find("coloured glyphs", 1, true))
    tables.COLR, tables.glyf = nil, nil
    assert.is_truthy(message_of({ "A", font = temporary(truetype.join(tables)) })
      :find("no outlines", 1, true))
  end)

  it("that are damaged inside are drawn as far as possible, or refused", function()
    local font = block.font()
    for seed = 1, 60 do
      local random = celspan.random(seed)
      local damaged = bytes
      for i = 1, 20 do
        local at = random("place" .. i, 400, #bytes)
        damaged = damaged:sub(1, at - 1) .. string.char(random("byte" .. i, 0, 255))
          .. damaged:sub(at + 1)
      end
      local path = temporary(damaged)
      local is_made, made_text = pcall(text, { "Hamburg -> שלום", font = path,
        variations = seed % 2 == 0 and { wght = 700 } or nil })
      assert.is_true(is_made or type(made_text) == "string")
    end
    assert.is_truthy(font)
  end)

  it("without an axis refuse its name", function()
    local message = message_of { "A", variations = { wdth = 80 } }
    assert.is_truthy(message:find('has no axis "wdth"', 1, true), message)
    assert.is_truthy(message:find("%S+%.%a+ has no axis"), message) -- the only font is named
  end)
end)

describe("languages and features", function()
  it("may have every digit in their names", function()
    for _, language in ipairs { "es-419", "x-0", "x-9" } do
      assert.has_no.errors(function() return text { "A", language = language } end)
    end
    for _, feature in ipairs { "cv01", "ss20", "cv99" } do
      assert.has_no.errors(function() return text { "A", features = { [feature] = true } } end)
    end
  end)
end)

-- ---------------------------------------------------------------- a primitive like any other

describe("text as a primitive", function()
  it("can be an operand of booleans, and is probed like it is drawn", function()
    local hole = celspan.rect { 0, 0, 640, 240, texture = "#fff" }
      - text { "HOLE", size = 200, at = { 20, 200 } }
    local rostrum = celspan.rostrum { celspan.cel { hole } }
    local image = celspan.pixels(rostrum:with { antialias = "none" }, { size = { 640, 240 } })
    local differing = 0
    for y = 3, 239, 7 do
      for x = 2, 639, 5 do
        local _, _, _, drawn = image:get(x, y)
        local _, _, _, probed = celspan.probe(rostrum, x + 0.5, y + 0.5, { film = { 640, 240 } })
        differing = differing + (drawn ~= probed and 1 or 0)
      end
    end
    assert.are.equal(0, differing)
  end)

  it("equals text with the same fields, and no other", function()
    local function name(fields)
      local rostrum = celspan.rostrum { celspan.cel { text(fields) } }
      return rostrum
    end
    assert.is_true(same_pixels(text { "A", at = { 50, 100 } }, text { "A", at = { 50, 100 } }))
    assert.is_false(same_pixels(text { "A", at = { 50, 100 } }, text { "B", at = { 50, 100 } }))
    assert.is_truthy(name { "A" })
  end)

  it("can be read and changed", function()
    local hello = text { "Hello", at = { 3, 4 } }
    assert.are.equal("Hello", hello[1])
    assert.are.same({ 48, "left", 1.2, 0 },
      { hello.size, hello.align, hello.leading, hello.tracking })
    assert.are.same({ 3, 4 }, hello.at)
    local other = hello:translate(10, 0):with { "Bye" }
    assert.are.equal("Bye", other[1])
    local x = other:bounds()
    local plain = text({ "Bye", at = { 13, 4 } }):bounds()
    assert.is_true(math.abs(x - plain) < 1e-9)
    assert.are.equal('text{ size = 48, at = {3, 4}, leading = 1.2, tracking = 0, face = 1 }',
      tostring(hello))
  end)

  it("may be empty: no letters, only spaces, no size", function()
    for _, fields in ipairs { { "" }, { "   " }, { "\n\n" }, { "A", size = 0 } } do
      local nothing = text(fields)
      assert.is_false(same_pixels(nothing | text { "I", at = { 9, 99 } }, nothing))
      local _, _, w, h = nothing:bounds()
      assert.are.same({ 0, 0 }, { w or 0, h or 0 })
    end
    assert.are.same({}, glyphs { "" })
    assert.are.equal(" |A", spelled(glyphs { " A", size = 0 }))
  end)
end)

-- ---------------------------------------------------------------- bad input

describe("bad text is refused:", function()
  local cases = {
    { "no text", {}, "takes one string, the text, got 0 values" },
    { "two texts", { "a", "b" }, "got 2 values" },
    { "a boolean", { true }, "value 1 must be a string, the text, got boolean" },
    { "a cut character", { "ab\xe2\x82" }, "the text is not UTF-8 at byte 3 (0xe2)" },
    { "a byte that begins none", { "\xff" }, "the text is not UTF-8 at byte 1 (0xff)" },
    { "an overlong one", { "a\xc0\x80" }, "not UTF-8 at byte 2 (0xc0)" },
    { "an overlong one of three bytes", { "\xe0\x81\x81" }, "not UTF-8 at byte 1 (0xe0)" },
    { "one beyond the last", { "\xf4\x90\x80\x80" }, "not UTF-8 at byte 1 (0xf4)" },
    { "a surrogate", { "\xed\xa0\x80" }, "not UTF-8 at byte 1 (0xed)" },
    { "a zero", { "a\0b" }, "control character U+0000 at byte 2" },
    { "a tab", { "a\tb" }, "control character U+0009 at byte 2" },
    { "a lone return", { "a\rb" }, "control character U+000D at byte 2" },
    { "a character that is nowhere", { "Aж" },
      'block.ttf has no glyph for "ж" (U+0436) at byte 2' },
    { "one that is in none of two fonts", { "Aж", font = { FONT, FONT } },
      'none of the fonts has a glyph for "ж" (U+0436) at byte 2' },
    { "a million characters", { ("a"):rep(1000000) }, "more than 100000 characters" },
    { "a size below 0", { "a", size = -1 }, "size is -1; it must be 0 or more" },
    { "a size that is no number", { "a", size = 0 / 0 }, "size" },
    { "an endless width", { "a", width = math.huge }, "width" },
    { "a width below 0", { "a", width = -5 }, "width is -5; it must be 0 or more" },
    { "a place of one number", { "a", at = { 1 } }, "at" },
    { "another align", { "a", align = "justify" }, '"left", "centre" or "right", got "justify"' },
    { "another direction", { "a", direction = "up" }, '"auto", "ltr" or "rtl", got "up"' },
    { "features in a list", { "a", features = { "liga" } }, "a table by name" },
    { "a feature's value", { "a", features = { liga = -1 } },
      "liga must be true, false or a whole" },
    { "a feature's name", { "a", features = { ligatures = true } }, 'got "ligatures"' },
    { "an axis's value", { "a", variations = { wght = "bold" } }, "wght must be a number" },
    { "an axis without a number", { "a", variations = { wght = 0 / 0 } }, "wght" },
    { "a language", { "a", language = "no such thing" }, "language is a tag such as" },
    { "a font that is a number", { "a", font = 3 }, "field 'font' must be the name of a file" },
    { "no fonts", { "a", font = {} }, "font is missing" },
    { "seventeen fonts", { "a", font = (function()
      local list = {}
      for i = 1, 17 do list[i] = FONT end
      return list
    end)() }, "17 fonts; at most 16 are allowed" },
    { "a folder", { "a", font = "../../../scripts" }, "is not a file; a font must be one" },
    { "an unknown field", { "a", sise = 3 }, "size" },
  }
  for _, case in ipairs(cases) do
    it(case[1], function()
      local message = message_of(case[2])
      assert.is_truthy(message:find(case[3], 1, true), message)
      assert.is_truthy(message:find("tests/desk/spec/text_spec.lua:", 1, true), message)
      local letters = message_of(case[2], glyphs)
      assert.is_truthy(letters:find(case[3], 1, true), letters)
    end)
  end

  it("no font", function()
    local _, message = pcall(celspan.text, { "a" })
    assert.is_truthy(tostring(message):find("field 'font' is missing", 1, true))
  end)

  it("and long lines are the same as short ones", function()
    local words = ("Hamburg AVE "):rep(1000) -- more than is shaped at once
    local letters, few = glyphs { words, size = 10 }, glyphs { "Hamburg AVE ", size = 10 }
    assert.are.equal(12000, #letters)
    local _, width = few[12].x, few[12].x + few[12].advance
    for i = 1, #letters, 1111 do
      local place = few[(i - 1) % 12 + 1].x + width * ((i - 1) // 12)
      assert.is_true(math.abs(letters[i].x - place) < 1e-6)
    end
    local one = glyphs { "b" .. ("\u{301}"):rep(9999), size = 10 }
    assert.is_true(#one >= 1 and #one[1].text > 100)
  end)

  it("and a hundred thousand characters are accepted", function()
    local words = ("Hamburg AVE "):rep(100000 // 12)
    local letters = lines_of { words, size = 10, width = 400 }
    assert.is_true(#letters > #words)
  end)
end)

-- ---------------------------------------------------------------- the command line

describe("the command line", function()
  local BINARY = workbench.binary
  -- the folder of the fonts, which is not the script's
  local folder = assert(io.popen "pwd"):read "l"

  --- The exit code and messages of a check of a script that sets this text.
  local function check(fields, environment)
    local script =
      temporary(('local celspan = require "celspan"\nreturn celspan.rostrum { celspan.cel { '
      .. "celspan.text { %s } } }"):format(fields))
    local pipe =
      assert(io.popen(("%s '%s' check '%s' --allow '%s' 2>&1")
        :format(environment or "", BINARY, script,
      folder)))
    local message = pipe:read "a"
    local _, _, code = pipe:close()
    return code or 0, message
  end

  local font = ("font = %q"):format(folder .. "/" .. PATH)

  it("ends with 4 without a font, and with 3 without a letter", function()
    assert.are.equal(0, (check('"A", ' .. font)))
    assert.are.equal(4, (check '"A", font = "no-such.ttf"'))
    assert.are.equal(3, (check('"ж", ' .. font)))
  end)

  it("reports which module is missing", function()
    local code, message = check('"A", ' .. font, "CELSPAN_TYPE_MODULE=/none/type.so")
    assert.are.equal(4, code)
    assert.is_truthy(message:find("setting type needs the module celspan-type.so", 1, true),
      message)
  end)

  it("does not load it for a film without text", function()
    local code = check('"A", ' .. font, "CELSPAN_TYPE_MODULE=/none/type.so")
    local script = temporary 'local celspan = require "celspan"\nreturn celspan.rostrum {}'
    assert.are.equal(4, code)
    assert.is_true(os.execute(("CELSPAN_TYPE_MODULE=/none/type.so '%s' check '%s' >/dev/null 2>&1")
      :format(BINARY, script)))
  end)
end)

describe("a collection of fonts", function()
  local it_sets_type = present.type() and it or pending

  --- The project's font, `count` times under one header; faces share its tables.
  local function collection(count)
    local file = assert(io.open("scripts/type/block.ttf", "rb"))
    local font = file:read "a"
    file:close()
    local head = 12 + 4 * count
    local tables = string.unpack(">I2", font, 5)
    local out = { font:sub(1, 12) }
    for i = 0, tables - 1 do
      local tag, sum, at, size = string.unpack(">c4I4I4I4", font, 13 + 16 * i)
      out[#out + 1] = string.pack(">c4I4I4I4", tag, sum, at + head, size)
    end
    return "ttcf" .. string.pack(">I4I4", 0x10000, count) .. string.pack(">I4", head):rep(count)
      .. table.concat(out) .. font:sub(13 + 16 * tables)
  end

  it_sets_type("provides the requested face, and names those that it has", function()
    local path = os.tmpname()
    local file = assert(io.open(path, "wb"))
    file:write(collection(2))
    file:close()
    local plain = { celspan.text { "Again", font = "../../../scripts/type/block.ttf" }:bounds() }
    for face = 1, 2 do
      assert.are.same(plain, { celspan.text { "Again", font = path, face = face }:bounds() })
    end
    local good, refusal = pcall(celspan.text, { "Again", font = path, face = 3 })
    assert.is_false(good)
    assert.matches("face 3 is not in the collection, which has 1 to 2", refusal, 1, true)
    good, refusal = pcall(celspan.text, { "Again", font = path, face = 0 })
    assert.is_false(good)
    assert.matches("text: face is 0; it must be 1 or more", refusal, 1, true)
    os.remove(path)
  end)
end)
