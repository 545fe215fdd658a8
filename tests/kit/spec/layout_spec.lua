-- Objects placed by their bounds or with their earlier moments, texts letter by letter, numbers and
-- frames as texts, and colours by how they look.
local celspan = require "celspan"
local colour = require "celspan.colour"
local present = require "tests.support.present"
local raised = require "tests.support.raised"
local typewriter = require "celspan.typewriter"

local with_art = present.type and it or pending
local FONT = "../../../scripts/type/block.ttf" -- beside this file

local function rect(x, y, w, h) return celspan.rect { x, y, w, h } end

local function bounds(object) return { object:bounds() } end

describe("layout", function()
  it("puts objects side by side and below one another", function()
    local list = { rect(7, 7, 10, 20), false, nil, celspan.union {}, rect(-5, 0, 30, 6), gap = 2 }
    local row = celspan.row(list)
    assert.are.same({ 0, 0, 42, 20 }, bounds(row))
    assert.is_true(row:contains(5, 19) and row:contains(40, 5) and not row:contains(40, 7))
    list.align = "bottom"
    assert.is_true(celspan.row(list):contains(40, 15))
    list.align = "right"
    local column = celspan.column(list)
    assert.are.same({ 0, 0, 30, 28 }, bounds(column))
    assert.is_true(column:contains(21, 10) and not column:contains(19, 10))
    assert.is_nil(celspan.row {}:bounds())
  end)

  it("puts objects into cells as wide as their column and as high as their row", function()
    local grid = celspan.grid { columns = 2, gap = 1, rect(0, 0, 10, 20), rect(0, 0, 30, 6),
                                rect(0, 0, 4, 4) }
    assert.are.same({ 0, 0, 41, 25 }, bounds(grid))
    assert.is_true(grid:contains(12, 10) and not grid:contains(12, 6)) -- in the middle
    assert.is_true(grid:contains(5, 23) and not grid:contains(2, 23))
  end)

  it("aligns in a box, and makes a box around an object", function()
    local box = { 100, 0, 50, 40 }
    assert.are.same({ 120, 15, 10, 10 }, bounds(celspan.align(rect(3, 4, 10, 10), box)))
    assert.are.same({ 140, 0, 10, 10 },
      bounds(celspan.align(rect(3, 4, 10, 10), box, "right", "top")))
    assert.are.same({ 1, 2, 14, 14 }, celspan.around(rect(3, 4, 10, 10), 2))
    assert.are.same({ 0, 3, 16, 12 }, celspan.around(rect(3, 4, 10, 10), { 3, 1 }))
    assert.are.same({ 0, 0, 0, 0 }, celspan.around(celspan.union {}))
  end)

  it("refuses what it cannot place", function()
    raised.each {
      ["row: item 2 must be an object, got number"] = function()
        celspan.row { rect(0, 0, 1, 1), 3 }
      end,
      ['row: align must be "bottom", "centre", "top", got "cente"; did you mean "centre"?'] =
        function() celspan.row { align = "cente" } end,
      ["column: unknown field 'gpa'; did you mean 'gap'?"] = function()
        celspan.column { gpa = 2 }
      end,
      ["grid: field 'columns' must be a whole number of at least 1, got nil"] = function()
        celspan.grid {}
      end,
      ['fit: the third argument must be "centre", "left", "right", got "cente"; did you mean '
        .. '"centre"?'] = function()
        celspan.fit(celspan.rect { 0, 0, 1, 1 }, { 0, 0, 9, 9 }, "cente")
      end,
      ["align: box[4] must be a number, got nil"] = function()
        celspan.align(rect(0, 0, 1, 1), { 1, 2, 3 })
      end,
      ["around: margin[1] must be a number, got string"] = function()
        celspan.around(rect(0, 0, 1, 1), "wide")
      end,
    }
  end)
end)

describe("fit", function()
  with_art("makes an object as large as the box allows", function()
    local fitted = celspan.fit(rect(5, 5, 20, 10), { 0, 0, 100, 100 })
    assert.are.same({ 0, 25, 100, 50 }, bounds(fitted))
    fitted = celspan.fit(rect(5, 5, 20, 10), { 0, 0, 100, 100 }, "right", "top", 1)
    assert.are.same({ 80, 0, 20, 10 }, bounds(fitted))
    fitted = celspan.fit(rect(0, 0, 400, 10), { 0, 0, 100, 100 }, "left", "bottom", 1)
    assert.are.same({ 0, 97.5, 100, 2.5 }, bounds(fitted))
    assert.is_nil(celspan.fit(celspan.union {}, { 0, 0, 9, 9 }):bounds())
    raised.each {
      ["fit: the box must have a width and a height above 0, got 0 by 5"] = function()
        celspan.fit(rect(0, 0, 1, 1), { 0, 0, 0, 5 })
      end,
      ["fit: the fifth argument, the greatest factor, must be a number above 0, got -1"] =
        function() celspan.fit(rect(0, 0, 1, 1), { 0, 0, 5, 5 }, "left", "top", -1) end,
    }
  end)
end)

describe("count", function()
  it("writes numbers as languages do", function()
    for _, case in ipairs {
      { "48,250", 48250 }, { "0", 0 }, { "0", -0.2 }, { "\u{2212}1,000", -999.6 }, { "999", 999 },
      { "48.250,5", 48250.5, "de", 1 }, { "12,34,567.9", 1234567.891, "hi", 1 },
      { "1234", 1234, "es" }, { "12.345", 12345, "es" }, { "1\u{202f}234", 1234, "fr" },
      { "1\u{a0}234,00", 1234, "fi", 2 }, { "1’234", 1234, "de-CH" }, { "1.234", 1234, "pt-BR" },
      { "1,000,000", 1e6, "en-GB" },
    } do
      local written = celspan.count(case[2], { language = case[3], decimals = case[4] })
      assert.equal(case[1], written)
    end
    assert.equal("2026.5", celspan.count(2026.5, { decimals = 1, group = false }))
  end)

  it("refuses what it does not know", function()
    raised.each {
      ['count: there is no language "xx"; there are ar, '] = function()
        celspan.count(1, { language = "xx" })
      end,
      ["count: the first argument must be a finite number, got nil"] = function()
        celspan.count()
      end,
      ["count: decimals must be a whole number from 0 to 15, got 1.5"] = function()
        celspan.count(1, { decimals = 1.5 })
      end,
    }
  end)
end)

describe("letters", function()

  with_art("are changed one by one, by words and by lines", function()
    local function list(by)
      local texts = {}
      celspan.letters({ "He is\nin", font = FONT, size = 100 }, function(letter, i, n)
        texts[#texts + 1] = ("%d/%d %s %d"):format(i, n, letter.text, letter.line)
        assert.are.equal(letter.x + letter.advance / 2, letter.middle)
        return letter.object
      end, by and { by = by })
      return table.concat(texts, ", ")
    end
    assert.equal("1/6 H 1, 2/6 e 1, 3/6 i 1, 4/6 s 1, 5/6 i 2, 6/6 n 2", list())
    assert.equal("1/3 He 1, 2/3 is 1, 3/3 in 2", list "word")
    assert.equal("1/2 He is 1, 2/2 in 2", list "line")
  end)

  with_art("that are not changed are the text, and nil draws nothing", function()
    local fields = { "He is", font = FONT, size = 100 }
    local text = celspan.text(fields)
    local same = celspan.letters(fields, function(letter) return letter.object end)
    assert.are.same(bounds(text), bounds(same))
    assert.is_nil(celspan.letters(fields, function() end):bounds())
  end)

  --- The middle of each letter along a path: { x, y, degrees }.
  local function places(text, options)
    local found = {}
    celspan.letters(text, function(letter)
      assert.are.equal(letter.x, letter.middle)
      found[#found + 1] = { letter.x, letter.y, letter.degrees }
      return letter.object
    end, options)
    return found
  end

  with_art("run along a path, each with its middle on the line", function()
    local text = { "HH", font = FONT, size = 100, at = { 40, 7 } }
    local glyphs = celspan.glyphs(text)
    local straight = places(text, { along = "M10 20 H1010", start = 0.5 })
    local words = { "AB", font = FONT, size = 20, align = "center" }
    assert.are.same(places(words, { along = "M10 20 H1010", start = 0.5 }),
      places(words, { along = "M10 20 H1010" }))
    for i, glyph in ipairs(glyphs) do
      local middle = glyph.x - 40 + glyph.advance / 2
      assert.near(510 + middle, straight[i][1], 1e-9)
      assert.near(20, straight[i][2], 1e-9)
    end
    local by_place = places({ "HH", 40, 7, font = FONT, size = 100 }, { along = "M10 20 H1010",
      start = 0.5 })
    assert.are.same(straight, by_place)
    local x, y, w, h = celspan.letters(text, nil, { along = "M10 20 H1010", start = 0.5 }):bounds()
    local tx, ty, tw, th = celspan.text(text):bounds()
    assert.are.same({ 0, 0, 0, 0 }, { -- the same letters, moved
      math.floor(1e6 * (x - tx - 470) + 0.5), math.floor(1e6 * (y - ty - 20) + 0.5),
      math.floor(1e6 * (w - tw) + 0.5), math.floor(1e6 * (h - th) + 0.5) })
    assert.near(90, places(text, { along = "M10 20 V1020" })[1][3], 1e-9)
  end)

  with_art("leave an open path at its ends, and go round a closed one", function()
    local text = { "HHHH", font = FONT, size = 100 }
    local circle = "M0 0 A50 50 0 0 1 100 0 A50 50 0 0 1 0 0"
    assert.equal(0, #places(text, { along = "M0 0 H10" }))
    assert.is_true(#places(text, { along = circle, start = 0.5 }) < 4)
    local round = places(text, { along = circle .. " Z", start = 0.75 })
    assert.equal(4, #round)
    for _, place in ipairs(round) do
      assert.near(50, math.sqrt((place[1] - 50) ^ 2 + place[2] ^ 2), 1e-6)
    end
  end)

  with_art("refuse what is no function or no unit", function()
    local fields = { "He is", font = FONT }
    raised.each {
      ["letters: the second argument must be a function, got string"] = function()
        celspan.letters(fields, "word")
      end,
      ["letters: along must be path data, contours or a path, got boolean"] = function()
        celspan.letters(fields, nil, { along = true })
      end,
      ['letters: field \'by\' must be "letter", "word" or "line", got "words"'] = function()
        celspan.letters(fields, print, { by = "words" })
      end,
    }
  end)
end)

describe("colour", function()
  it("has the values of the paper on Oklab", function()
    -- XYZ of the paper's table in linear sRGB would be outside it; these are white and red
    local lightness, chroma = colour.parts "#ffffff"
    assert.is_true(math.abs(lightness - 1) < 1e-6 and chroma < 1e-6)
    local l, c, h, alpha = colour.parts "#ff0000"
    assert.is_true(math.abs(l - 0.627955) < 1e-5 and math.abs(c - 0.257683) < 1e-5
      and math.abs(h - 29.2339) < 1e-3 and alpha == 1)
  end)

  it("comes back from its parts, and keeps hue and lightness where sRGB ends", function()
    for _, text in ipairs { "#f26419", "#1769aa", "#000000", "#123456", "#00ff00" } do
      local l, c, h = colour.parts(text)
      local made, given = colour.oklch(l, c, h).pigment, celspan.rgb(text).pigment
      for i = 1, 3 do assert.is_true(math.abs(made[i] - given[i]) < 1e-6, text) end
    end
    local l, c, h = colour.parts(colour.oklch(0.7, 0.9, 50))
    assert.is_true(math.abs(l - 0.7) < 1e-6 and math.abs(h - 50) < 1e-3 and c > 0.15 and c < 0.2)
  end)

  it("is lightened, darkened and mixed without turning grey", function()
    local l, _, h = colour.parts "#f26419"
    local lighter, _, hue = colour.parts(colour.lighten("#f26419", 0.1))
    assert.is_true(math.abs(lighter - l - 0.1) < 1e-6 and math.abs(hue - h) < 1e-3)
    assert.are.same({ 0, 0, 0 }, colour.lighten("#f26419", -2).pigment)
    local middle = colour.mix("#f26419", celspan.rgb(0, 0, 1, 0.5), 0.5)
    assert.equal(0.75, middle.beta)
    local one = colour.mix("#f26419", "#1769aa", 0).pigment
    assert.is_true(math.abs(one[1] - celspan.rgb "#f26419".pigment[1]) < 1e-6)
  end)

  it("palettes are exchanged by name, and mixed", function()
    local palette = colour.palette { day = { sky = "#ffffff", roof = "#b5482f" },
                                     night = { sky = "#000000", roof = "#3c2430" } }
    assert.equal("#b5482f", palette:at "day".roof)
    local lightness = colour.parts(palette:between("day", "night", 0.5).sky)
    assert.is_true(math.abs(lightness - 0.5) < 1e-6)
  end)

  it("refuses what is no colour", function()
    raised.each {
      ["mix takes colours, such as \"#f26419\", got nil"] = function()
        colour.mix("#fff", nil, 0)
      end,
      ['lighten: "#12" is not a colour'] = function() colour.lighten("#12", 0) end,
      ["oklch: its hue must be a finite number, got nan"] = function()
        colour.oklch(0.5, 0.1, 0 / 0)
      end,
      ["palette 'night' has no colour 'sky'"] = function()
        colour.palette { day = { sky = "#fff" }, night = {} }
      end,
      ["only palette 'night' has a colour 'sea'"] = function()
        colour.palette { day = { sky = "#fff" }, night = { sky = "#000", sea = "#00f" } }
      end,
      ["there is no palette 'nigth'; did you mean 'night'?"] = function()
        colour.palette { day = { sky = "#fff" }, night = { sky = "#000" } }:at "nigth"
      end,
    }
  end)
end)

describe("an echo", function()
  it("has the object of now in front, and those before it fainter behind", function()
    local asked = {}
    local trail = celspan.echo(function(k)
      asked[#asked + 1] = k
      return rect(10 * k, 0, 9, 9)
    end, { count = 3, fade = 0.5 })
    assert.same({ 2, 1, 0 }, asked)
    assert.same({ 0, 0, 29, 9 }, bounds(trail))
    local function alpha_at(x)
      local _, _, _, alpha = celspan.probe(celspan.rostrum { celspan.cel { trail } }, x, 5,
        { film = { 30, 10 } })
      return alpha
    end
    assert.same({ 1, 0.5, 0.25 }, { alpha_at(5), alpha_at(15), alpha_at(25) })
    assert.is_nil(celspan.echo(function() end):bounds())
  end)

  it("refuses what has no echo", function()
    raised.each {
      ["echo: the first argument must be a function, got nil"] = function() celspan.echo() end,
      ["echo: the function must return an object or nil, got number for 4"] = function()
        celspan.echo(function(k) return k end)
      end,
      ["echo: field 'count' must be a whole number from 1 to 1000, got 0"] = function()
        celspan.echo(print, { count = 0 })
      end,
      ["echo: field 'fade' must be from 0 to 1, got 2"] = function()
        celspan.echo(print, { fade = 2 })
      end,
    }
  end)
end)

describe("a timecode", function()
  it("counts hours, minutes, seconds and frames", function()
    assert.equal("00:00:00:00", celspan.timecode(0, 24))
    assert.equal("01:02:03:04", celspan.timecode(((62 * 60) + 3) * 25 + 4, 25))
    assert.equal("00:00:01:00", celspan.timecode(24, 23.976))
    assert.equal("100:00:00:00", celspan.timecode(360000 * 24, 24))
  end)

  it("leaves out numbers so that it is right by the clock at 29.97 and 59.94", function()
    local cases = { [0] = "00:00:00;00", [1799] = "00:00:59;29", [1800] = "00:01:00;02",
                    [17981] = "00:09:59;29", [17982] = "00:10:00;00", [19781] = "00:10:59;29",
                    [19782] = "00:11:00;02", [107892] = "01:00:00;00" }
    for index, written in pairs(cases) do
      assert.equal(written, celspan.timecode(index, 30000 / 1001, { drop = true }))
    end
    assert.equal("00:01:00;04", celspan.timecode(3600, 60000 / 1001, { drop = true }))
  end)

  it("refuses what is no frame, and dropping at other rates", function()
    raised.each {
      ["timecode: the first argument, a frame, must be a whole number from 0 on, got -1"] =
        function() celspan.timecode(-1, 24) end,
      ["timecode: the second argument must be frames per second, 1 to 1000, got nil"] =
        function() celspan.timecode(1) end,
      ["timecode: drop is for 29.97 and 59.94 frames a second, got 25"] = function()
        celspan.timecode(1, 25, { drop = true })
      end,
    }
  end)
end)

describe("a typewriter", function()
  local words = { "He is.\nOh", font = FONT, size = 100 }

  with_art("types letters where they are in the whole text, and returns the next place", function()
    local object, x, y = typewriter(words, 0)
    assert.is_nil(object:bounds())
    assert.same({ 0, 0 }, { x, y })
    local first = celspan.glyphs(words)[1]
    object, x, y = typewriter(words, 1 / 7)
    assert.same(bounds(first.object), bounds(object))
    assert.same({ first.advance, 0 }, { x, y })
    assert.same(bounds(celspan.text(words)), bounds((typewriter(words, 1))))
    assert.equal(120, (select(3, typewriter(words, 1))))
    assert.same(bounds((typewriter(words, 2 / 7))),
      bounds((typewriter(words, 0.34, { by = "word" }))))
  end)

  it("refuses what is no share", function()
    raised.each { ["typewriter: the second argument must be a finite number, 0 to 1, got nil"] =
      function() typewriter(words) end }
  end)
end)
