-- Filters of drawings: each primitive against its formula, in the numbers that the drawing names.
-- One list, as long as the list of primitives.
local celspan = require "celspan"
local images = require "tests.support.images"
local present = require "tests.support.present"
local svg = require "celspan.svg"
local workbench = require "tests.support.workbench"

local SIDE = 100
local HEAD = '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">'
local bench, count = workbench.new(), 0

local function read(content)
  count = count + 1
  local path = bench:write(("drawing-%d.svg"):format(count), HEAD .. content .. "</svg>")
  return assert(svg.read(path))
end

local function pixels(object)
  local rostrum = celspan.rostrum { celspan.cel { object } }
  return assert(celspan.pixels(celspan.film { size = { SIDE, SIDE }, frames = 1, space = "srgb",
                                              frame = function() return rostrum end }))
end

--- The codes of red, green, blue and alpha in the middle of a pixel, not premultiplied.
local function at(art, x, y)
  local from = 4 * (y * SIDE + x) + 1
  return { pixels(art.object):bytes { depth = 8 }:byte(from, from + 3) }
end

local function told(art)
  local list = {}
  for i, entry in ipairs(art.skipped) do list[i] = entry.line .. " " .. entry.what end
  return table.concat(list, ", ")
end

--- A drawing of a rectangle from (20, 20) to (60, 60) with a filter of these primitives.
local function filtered(primitives, attributes, fill)
  return read(('<filter id="f" %s>%s</filter><rect x="20" y="20" width="40" height="40" fill="%s" '
    .. 'filter="url(#f)"/>'):format(attributes or "", primitives, fill or "#40c080"))
end

local CODES = 'color-interpolation-filters="sRGB"'

local function assert_near(expected, given, tolerance, message)
  for c = 1, 4 do
    assert.is_true(math.abs(expected[c] - given[c]) <= (tolerance or 1),
      ("%s: %s instead of %s"):format(message or "", table.concat(given, " "),
        table.concat(expected, " ")))
  end
end

local function decode(code)
  local v = code / 255
  return v <= 0.04045 and v / 12.92 or ((v + 0.055) / 1.055) ^ 2.4
end
local function encode(light)
  return 255 * (light <= 0.0031308 and 12.92 * light or 1.055 * light ^ (1 / 2.4) - 0.055)
end

local it = present.type() and it or pending

teardown(function() bench:remove() end)

describe("the region of a filter", function()
  it("is a tenth larger than the box on each side", function()
    local art = filtered '<feFlood flood-color="#f00" flood-opacity="0.5"/>'
    assert_near({ 255, 0, 0, 128 }, at(art, 16, 63))
    assert_near({ 0, 0, 0, 0 }, at(art, 15, 40))
    assert_near({ 0, 0, 0, 0 }, at(art, 40, 64))
  end)

  it("is in user units or in shares, and so are those of primitives", function()
    local art = filtered('<feFlood x="0.5" y="0" width="0.25" height="1"/>',
      'x="10" y="10" width="80" height="30" filterUnits="userSpaceOnUse" '
      .. 'primitiveUnits="objectBoundingBox"')
    assert_near({ 0, 0, 0, 255 }, at(art, 40, 39))
    assert_near({ 0, 0, 0, 255 }, at(art, 49, 20))
    for _, place in ipairs { { 39, 30 }, { 50, 30 }, { 45, 19 }, { 45, 40 } } do
      assert_near({ 0, 0, 0, 0 }, at(art, place[1], place[2]))
    end
  end)

  it("cuts off the element", function()
    local art = filtered('<feOffset dx="30"/>', 'width="0.6" x="0" y="0" height="1"')
    assert_near({ 0, 0, 0, 0 }, at(art, 40, 40))
    art = filtered('<feOffset dx="30"/>', 'width="1.6" x="0.5" y="0" height="1"')
    assert_near({ 0, 0, 0, 0 }, at(art, 69, 40))
    assert_near({ 64, 192, 128, 255 }, at(art, 70, 40))
  end)

  it("follows the transforms of the element", function()
    local art = read('<filter id="f"><feFlood/></filter><g transform="translate(50) scale(.5)">'
      .. '<rect width="40" height="40" filter="url(#f)" transform="translate(20)"/></g>')
    assert_near({ 0, 0, 0, 255 }, at(art, 58, 20))
    assert_near({ 0, 0, 0, 0 }, at(art, 57, 20))
  end)
end)

describe("a primitive", function()
  it("moves", function()
    local art = filtered('<feOffset dx="10" dy="5"/>', 'x="0" y="0" width="2" height="2"')
    assert_near({ 64, 192, 128, 255 }, at(art, 69, 64))
    assert_near({ 0, 0, 0, 0 }, at(art, 29, 30))
  end)

  it("blurs, as an object is blurred", function()
    local art = filtered('<feGaussianBlur stdDeviation="4" ' .. CODES .. '/>',
      'x="-1" y="-1" width="3" height="3"')
    local object = celspan.rect { 20, 20, 40, 40, texture = "#40c080" }
    assert.is_true(images.difference(pixels(art.object), pixels(object:blur(8))) < 1e-5)
  end)

  it("blurs by different amounts along x and y", function()
    local region = 'x="-1" y="-1" width="3" height="3"'
    local art = filtered('<feGaussianBlur stdDeviation="6 1"/>', region)
    assert_near({ 64, 192, 128, 255 * 0.841 }, at(art, 26, 40), 16)
    assert_near({ 64, 192, 128, 255 * 0.5 }, at(art, 20, 40), 12)
    assert_near({ 64, 192, 128, 255 }, at(art, 40, 23), 2)
    art = filtered('<feGaussianBlur stdDeviation="0 6"/>', region)
    assert_near({ 64, 192, 128, 255 }, at(art, 40, 40), 2)
    assert.are.equal(0, at(art, 19, 40)[4])
    assert_near({ 64, 192, 128, 255 * 0.5 }, at(art, 40, 20), 12)
  end)

  it("lays results over each other, in light unless the file says otherwise", function()
    local merge = '<feFlood flood-color="#f00" flood-opacity="0.5" result="a"/><feMerge %s>'
      .. '<feMergeNode in="SourceGraphic"/><feMergeNode in="a"/></feMerge>'
    assert_near({ 160, 96, 64, 255 }, at(filtered(merge:format(CODES)), 40, 40))
    local light = { encode((1 + decode(64)) / 2), encode(decode(192) / 2), encode(decode(128) / 2),
                    255 }
    assert_near(light, at(filtered(merge:format ""), 40, 40))
  end)

  it("blends", function()
    local blend = '<feFlood flood-color="#80ff40" %s result="a"/>'
      .. '<feBlend mode="multiply" in="a" in2="SourceGraphic" %s/>'
    assert_near({ 64 * 128 / 255, 192, 128 * 64 / 255, 255 },
      at(filtered(blend:format("", CODES)), 40, 40))
    assert_near({ encode(decode(64) * decode(128)), 192, encode(decode(128) * decode(64)), 255 },
      at(filtered(blend:format("", "")), 40, 40))
  end)

  it("casts a shadow", function()
    local art = filtered('<feDropShadow dx="10" dy="10" stdDeviation="0" flood-color="#00f" '
      .. 'flood-opacity="0.5"/>', 'x="0" y="0" width="2" height="2"')
    assert_near({ 64, 192, 128, 255 }, at(art, 59, 59))
    assert_near({ 0, 0, 255, 128 }, at(art, 65, 65))
    assert_near({ 0, 0, 0, 0 }, at(art, 25, 65))
  end)

  it("repeats a part of its input", function()
    local art = filtered('<feFlood x="20" y="20" width="5" height="10" flood-color="#00f"/>'
      .. '<feOffset x="20" y="20" width="10" height="10"/><feTile/>')
    assert_near({ 0, 0, 255, 255 }, at(art, 43, 43))
    assert_near({ 0, 0, 0, 0 }, at(art, 47, 43))
    assert_near({ 0, 0, 255, 255 }, at(art, 60, 60))
  end)

  it("shows an element of the file", function()
    local art = filtered('<feImage href="#dot"/>') -- which is not there
    assert.are.equal("1 image #dot: No such file or directory", told(art))
    art = read('<defs><rect id="dot" x="30" y="30" width="9" height="9" fill="#f00"/></defs>'
      .. '<filter id="f"><feImage href="#dot"/></filter>'
      .. '<rect x="20" y="20" width="40" height="40" filter="url(#f)"/>')
    assert_near({ 255, 0, 0, 255 }, at(art, 38, 38))
    assert_near({ 0, 0, 0, 0 }, at(art, 40, 40))
  end)

  it("shows a picture, fitted into its box", function()
    local dot = "data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' width='2' height='2'"
      .. "%3E%3Crect width='1' height='2' fill='lime'/%3E%3C/svg%3E"
    local art = filtered(('<feImage href="%s" x="20" y="20" width="40" height="20"/>'):format(dot))
    assert_near({ 0, 255, 0, 255 }, at(art, 31, 21))
    assert_near({ 0, 0, 0, 0 }, at(art, 29, 21))
    assert_near({ 0, 0, 0, 0 }, at(art, 41, 21))
  end)
end)

describe("two results are composited", function()
  local A, B = { 64, 192, 128, 255 * 0.75 }, { 255, 0, 0, 255 * 0.5 }

  --- By a formula for a premultiplied channel.
  local function composited(operator, formula)
    local art = filtered(('<feFlood flood-color="#40c080" flood-opacity="0.75" result="a"/>'
      .. '<feFlood flood-color="#f00" flood-opacity="0.5" result="b"/>'
      .. '<feComposite in="a" in2="b" %s %s/>'):format(operator, CODES))
    local expected = { 0, 0, 0, 255 * math.min(1, formula(0.75, 0.5, 0.75, 0.5)) }
    for c = 1, 3 do
      local value = formula(A[c] / 255 * 0.75, B[c] / 255 * 0.5, 0.75, 0.5)
      expected[c] = expected[4] > 0 and 255 * math.min(1, value * 255 / expected[4]) or 0
    end
    assert_near(expected, at(art, 40, 40), 1.5, operator)
    assert.are.equal("", told(art))
  end

  it("by every operator", function()
    composited('operator="over"', function(a, b, as) return a + b * (1 - as) end)
    composited('operator="in"', function(a, _, _, bs) return a * bs end)
    composited('operator="out"', function(a, _, _, bs) return a * (1 - bs) end)
    composited('operator="atop"', function(a, b, as, bs) return a * bs + b * (1 - as) end)
    composited('operator="xor"', function(a, b, as, bs) return a * (1 - bs) + b * (1 - as) end)
    composited('operator="lighter"', function(a, b) return a + b end)
    composited('operator="nonsense"', function(a, b, as) return a + b * (1 - as) end)
  end)

  it("by sums", function()
    composited('operator="arithmetic" k2="0.3" k3="0.6"', function(a, b)
      return 0.3 * a + 0.6 * b
    end)
    composited('operator="arithmetic" k2="0.25" k3="1.2" k4="0.1"', function(a, b)
      return 0.25 * a + 1.2 * b + 0.1
    end)
    composited('operator="arithmetic"', function() return 0 end)
    composited('operator="arithmetic" k1="1"', function(a, b) return a * b end)
    composited('operator="arithmetic" k1="1.5" k2="0.2" k3="0.1" k4="0.05"', function(a, b)
      return 1.5 * a * b + 0.2 * a + 0.1 * b + 0.05
    end)
    for _, inputs in ipairs { 'in2="SourceGraphic"', 'in="SourceGraphic" in2="a"' } do
      local art = filtered('<feFlood flood-color="#80ff40" flood-opacity="0.5" result="a"/>'
        .. '<feComposite operator="arithmetic" k1="1" ' .. inputs .. '/>')
      assert_near({ encode(decode(64) * decode(128)), 192, encode(decode(128) * decode(64)), 128 },
        at(art, 40, 40))
    end
  end)
end)

describe("colours", function()
  local function becomes(expected, primitive, fill)
    local art = filtered(primitive:gsub("/?>", " " .. CODES .. "%0", 1), nil, fill)
    assert.are.equal("", told(art))
    assert_near(expected, at(art, 40, 40), 1, primitive)
  end

  it("go through matrices", function()
    becomes({ 192, 128, 64, 128 }, '<feColorMatrix values="0 1 0 0 0 0 0 1 0 0 1 0 0 0 0 '
      .. '0 0 0 0.5 0"/>')
    becomes({ 255, 0, 128, 255 }, '<feColorMatrix values="4 0 0 0 0.5 0 -1 0 0 0 0 0 1 0 0 '
      .. '0 0 0 1 0"/>')
    local grey = 0.2126 * 64 + 0.7152 * 192 + 0.0722 * 128
    becomes({ grey, grey, grey, 255 }, '<feColorMatrix type="saturate" values="0"/>')
    becomes({ 0, 0, 0, grey }, '<feColorMatrix type="luminanceToAlpha"/>')
    becomes({ 64, 192, 128, 255 }, '<feColorMatrix type="hueRotate" values="360"/>')
    becomes({ 255, 2 * grey - 192, 2 * grey - 128, 255 },
      '<feColorMatrix type="hueRotate" values="180"/>')
    becomes({ 64, 192, 128, 255 }, '<feColorMatrix values="1 2 3"/>')
  end)

  it("go through functions", function()
    local function with(channel, text, alpha)
      return ('<feComponentTransfer><feFunc%s %s/>%s</feComponentTransfer>'):format(channel, text,
        alpha or "")
    end
    becomes({ 64, 255 - 192, 128, 255 }, with("G", 'type="table" tableValues="1 0"'))
    becomes({ 64, 192, 128, 255 }, with("G", 'type="identity"'))
    -- 64/255 is a quarter of the way, so halfway between the first and the second of three
    becomes({ 255 * (0.2 + 128 / 255 * 0.6), 192, 128, 255 },
      with("R", 'type="table" tableValues="0.2,0.8,0"'))
    becomes({ 64, 192, 255 * 0.7, 255 }, with("B", 'type="discrete" tableValues="0.1 0.7 0.2"'))
    becomes({ 64, 192, 255 * 0.7, 255 }, with("B", 'type="discrete" tableValues="0.1 0.7"'))
    becomes({ 2 * 64 + 51, 192, 128, 255 }, with("R", 'type="linear" slope="2" intercept="0.2"'))
    becomes({ 64, 255, 128, 255 }, with("G", 'type="linear" slope="2"'))
    becomes({ 255 * (0.5 * (64 / 255) ^ 2 + 0.1), 192, 128, 255 },
      with("R", 'type="gamma" amplitude="0.5" exponent="2" offset="0.1"'))
    becomes({ 255 * (64 / 255) ^ 0.4, 192, 128, 255 }, with("R", 'type="gamma" exponent="0.4"'))
    becomes({ 64, 192, 128, 255 * 0.4 }, with("A", 'type="linear" slope="0.4"'))
    becomes({ 191, 192, 128, 255 * 0.4 }, with("R", 'type="table" tableValues="1 0"',
      '<feFuncA type="table" tableValues="0 0.4"/>'))
  end)

  it("are those of light where nothing is said", function()
    local art = filtered '<feColorMatrix values=".5 0 0 0 0 0 .5 0 0 0 0 0 .5 0 0 0 0 0 1 0"/>'
    assert_near({ encode(decode(64) / 2), encode(decode(192) / 2), encode(decode(128) / 2), 255 },
      at(art, 40, 40))
  end)
end)

describe("a filtered part", function()
  it("is filtered again when it is changed", function()
    local art = read('<filter id="f"><feColorMatrix type="saturate" values="0"/></filter>'
      .. '<g filter="url(#f)"><rect id="a" width="50" height="50" fill="red"/></g>')
    local white = celspan.rect { 0, 0, 50, 50, texture = "#fff" }
    local other = art:with { a = function() return white end }
    assert_near({ 255, 255, 255, 255 }, at(other, 20, 20))
    local red = encode(0.2126)
    assert_near({ red, red, red, 255 }, at(art, 20, 20))
  end)

  it("is filtered before it is clipped, masked and faded", function()
    local art = read('<filter id="f" x="0" y="0" width="2" height="2"><feOffset dx="20"/></filter>'
      .. '<clipPath id="c"><rect width="40" height="100"/></clipPath>'
      .. '<rect width="30" height="30" filter="url(#f)" clip-path="url(#c)" opacity="0.5"/>')
    assert_near({ 0, 0, 0, 128 }, at(art, 39, 10))
    assert_near({ 0, 0, 0, 0 }, at(art, 41, 10))
  end)

  it("is not seen where its filter is empty, or its region has no size", function()
    assert_near({ 0, 0, 0, 0 }, at(filtered "", 40, 40))
    assert_near({ 0, 0, 0, 0 }, at(filtered("<feOffset/>", 'width="0"'), 40, 40))
  end)

  it("does not let the modes inside act on the background", function()
    local art = read('<filter id="f"><feOffset/></filter><rect width="50" height="50" fill="red"/>'
      .. '<g filter="url(#f)"><rect width="50" height="50" fill="lime" '
      .. 'style="mix-blend-mode:multiply"/></g>')
    assert_near({ 0, 255, 0, 255 }, at(art, 20, 20))
  end)
end)

describe("a shape that is dilated", function()
  it("has an outline of the radii", function()
    local WIDE = 'x="-1" y="-1" width="3" height="3"'
    local art = filtered('<feMorphology in="SourceAlpha" operator="dilate" radius="5 10"/>', WIDE)
    assert.are.equal("", told(art))
    for _, place in ipairs { { 16, 40, 255 }, { 63, 40, 255 }, { 13, 40, 0 }, { 66, 40, 0 },
                             { 40, 12, 255 }, { 40, 67, 255 }, { 40, 8, 0 }, { 40, 71, 0 } } do
      local found = at(art, place[1], place[2])
      assert_near({ 0, 0, 0, place[3] }, found, 1, place[1] .. " " .. place[2])
    end
    -- an outline in a colour, as sticker lettering has it
    art = filtered('<feMorphology in="SourceAlpha" operator="dilate" radius="5" result="wide"/>'
      .. '<feFlood flood-color="#fff"/><feComposite in2="wide" operator="in"/>'
      .. '<feMerge><feMergeNode/><feMergeNode in="SourceGraphic"/></feMerge>', WIDE)
    assert_near({ 255, 255, 255, 255 }, at(art, 17, 40), 1)
    assert_near({ 64, 192, 128, 255 }, at(art, 40, 40), 1)
    assert.are.equal(0, at(filtered('<feMorphology in="SourceAlpha" operator="dilate" '
      .. 'radius="-1"/>', WIDE), 17, 40)[4])
  end)
end)

describe("shapes of one colour", function()
  local WIDE = 'x="-1" y="-1" width="3" height="3"'

  --- The sides of what a filter leaves along the middle: left, right, top, bottom.
  local function sides(art)
    local list, codes = {}, pixels(art.object):bytes { depth = 8 }
    local function is_there(x, y) return codes:byte(4 * (y * SIDE + x) + 4) > 100 end
    for i = 0, SIDE - 1 do
      if is_there(i, 25) then list[1], list[2] = list[1] or i, i + 1 end
      if is_there(25, i) then list[3], list[4] = list[3] or i, i + 1 end
    end
    return table.concat(list, " ")
  end

  it("grow and shrink by the rectangle of the radii", function()
    local function becomes(expected, attributes)
      local art = filtered(("<feMorphology %s/>"):format(attributes), WIDE)
      assert.are.equal("", told(art))
      assert.are.equal(expected, sides(art), attributes)
    end
    becomes("20 60 20 60", "")
    becomes("20 60 20 60", 'radius="0"')
    becomes("20 60 20 60", 'radius="-1" operator="dilate"')
    becomes("24 56 24 56", 'radius="4"')
    becomes("16 64 16 64", 'radius="4" operator="dilate"')
    becomes("22 58 24 56", 'radius="2 4" operator="erode"')
    becomes("20 60 23 57", 'radius="0 3" operator="erode"')
    becomes("", 'radius="21"')
    becomes("", 'radius="1e9"')
  end)

  it("keep their colour and their alpha, and the corners of the rectangle", function()
    for operator, inside in pairs { erode = 24, dilate = 16 } do
      local art = read(('<filter id="f" %s><feMorphology operator="%s" radius="4"/></filter><rect '
        .. 'x="20" y="20" width="40" height="40" fill="#40c080" fill-opacity="0.4" '
        .. 'filter="url(#f)"/>'):format(WIDE, operator))
      assert.are.equal("", told(art))
      assert_near({ 64, 192, 128, 102 }, at(art, 40, 40), 1)
      assert_near({ 64, 192, 128, 102 }, at(art, inside + 1, inside + 1), 1)
      assert_near({ 0, 0, 0, 0 }, at(art, inside - 1, 40))
    end
  end)

  it("are lines, texts, and what was made of them before", function()
    local art = read(('<filter id="f" %s><feMorphology radius="4"/><feOffset dx="10"/>'
      .. '<feMorphology operator="dilate" radius="4"/></filter><g color="red"><path '
      .. 'd="M10 30h60" stroke="currentColor" stroke-width="20" fill="none" filter="url(#f)"/></g>')
      :format('filterUnits="userSpaceOnUse" x="0" y="0" width="100" height="100"'))
    assert.are.equal("", told(art))
    assert_near({ 255, 0, 0, 255 }, at(art, 21, 21), 1)
    assert_near({ 0, 0, 0, 0 }, at(art, 18, 30))
    assert_near({ 0, 0, 0, 0 }, at(art, 30, 18))
    local several = '<filter id="f"><feMorphology radius="1"/></filter>%s'
    for _, content in ipairs {
      '<rect width="9" height="9" stroke="red" filter="url(#f)"/>',
      '<g filter="url(#f)"><rect width="9" height="9"/></g>',
      '<linearGradient id="a"><stop/></linearGradient><rect width="9" height="9" fill="url(#a)" '
        .. 'filter="url(#f)"/>',
    } do
      assert.is_truthy(told(read(several:format(content)))
        :find("feMorphology of several colours", 1, true), content)
    end
  end)
end)

describe("a function", function()
  local WIDE = 'x="-2" y="-2" width="5" height="5" '

  --- A drawing of the usual rectangle in a group with this value of the property.
  local function with(value, style)
    return read(('<g color="#00f" font-size="4" %s><rect x="20" y="20" width="40" height="40" '
      .. 'fill="#40c080"/></g>'):format((style and 'style="filter:%s"' or 'filter="%s"')
        :format(value)))
  end

  --- It does what these elements of a filter do in codes.
  local function equals(value, primitives)
    local found = with(value, true)
    assert.are.equal("", told(found))
    local by_hand = filtered(primitives, WIDE .. CODES)
    assert.are.equal("", told(by_hand))
    assert.is_true(images.difference(pixels(found.object), pixels(by_hand.object)) < 2e-4, value)
  end

  local function each(channel)
    return ("<feComponentTransfer><feFuncR %s/><feFuncG %s/><feFuncB %s/></feComponentTransfer>")
      :format(channel, channel, channel)
  end

  it("of colours is a primitive", function()
    equals("brightness(1.5)", each 'type="linear" slope="1.5"')
    equals("brightness(40%)", each 'type="linear" slope="0.4"')
    equals("contrast(2)", each 'type="linear" slope="2" intercept="-0.5"')
    equals("contrast(0)", each 'type="linear" slope="0" intercept="0.5"')
    equals("invert(0.25)", each 'type="table" tableValues="0.25 0.75"')
    equals("INVERT( )", each 'type="table" tableValues="1 0"')
    equals("invert(900%)", each 'type="table" tableValues="1 0"')
    equals("grayscale(0.75)", '<feColorMatrix type="saturate" values="0.25"/>')
    equals("grayscale()", '<feColorMatrix type="saturate" values="0"/>')
    equals("saturate(3)", '<feColorMatrix type="saturate" values="3"/>')
    equals("hue-rotate(0.25turn)", '<feColorMatrix type="hueRotate" values="90"/>')
    equals("hue-rotate(-100grad)", '<feColorMatrix type="hueRotate" values="-90"/>')
    equals("sepia(1)", '<feColorMatrix values="0.393 0.769 0.189 0 0 0.349 0.686 0.168 0 0 '
      .. '0.272 0.534 0.131 0 0 0 0 0 1 0"/>')
    equals("sepia(0.5)", '<feColorMatrix values="0.6965 0.3845 0.0945 0 0 0.1745 0.843 0.084 0 0 '
      .. '0.136 0.267 0.5655 0 0 0 0 0 1 0"/>')
    equals("opacity(0.3)", '<feComponentTransfer><feFuncA type="table" tableValues="0 0.3"/>'
      .. "</feComponentTransfer>")
  end)

  it("of places is a primitive, and nothing is cut off", function()
    equals("blur(4px)", '<feGaussianBlur stdDeviation="4"/>')
    equals("blur(1em)", '<feGaussianBlur stdDeviation="4"/>')
    equals("drop-shadow(10px 5px 3px #f00)",
      '<feDropShadow dx="10" dy="5" stdDeviation="3" flood-color="#f00"/>')
    equals("drop-shadow(rgb(255 0 0 / 50%) 0 -1em)",
      '<feDropShadow dx="0" dy="-4" stdDeviation="0" flood-color="#f00" flood-opacity="0.5"/>')
    for _, value in ipairs { "10px 10px", "currentColor 10px 10px", "10px 10px 0 currentColor" } do
      equals(("drop-shadow(%s)"):format(value),
        '<feDropShadow dx="10" dy="10" stdDeviation="0" flood-color="#00f"/>')
    end
  end)

  it("acts on what the one before made", function()
    equals("invert(1) brightness(0.5)blur(2px)  drop-shadow(8px 8px)",
      each 'type="table" tableValues="0.5 0"' .. '<feGaussianBlur stdDeviation="2"/>'
      .. '<feDropShadow dx="8" dy="8" stdDeviation="0" flood-color="#00f"/>')
    local art = read('<filter id="f"><feOffset dx="4"/></filter><filter id="g"/>'
      .. '<rect width="10" height="10" fill="#40c080" filter="invert(1) url(#f) url(#f)"/>'
      .. '<rect y="20" width="10" height="10" filter="url(#g) drop-shadow(1px 1px)"/>')
    assert.are.equal("", told(art))
    assert_near({ 0, 0, 0, 0 }, at(art, 3, 5))
    assert_near({ 191, 63, 127, 255 }, at(art, 10, 5))
    assert_near({ 0, 0, 0, 0 }, at(art, 11, 5)) -- cut off at the region of the references
    assert_near({ 0, 0, 0, 0 }, at(art, 5, 25))
  end)

  it("counts in the units of its element, in masks, and for changed parts", function()
    local art = read('<g transform="scale(2)"><rect width="9" height="9" '
      .. 'filter="drop-shadow(10px 0 red)"/></g><mask id="m"><rect width="50" height="100" '
      .. 'fill="#000" filter="invert(50%)"/></mask><rect y="50" width="90" height="9" '
      .. 'mask="url(#m)"/>')
    assert_near({ 255, 0, 0, 255 }, at(art, 37, 9))
    assert_near({ 0, 0, 0, 0 }, at(art, 38, 9))
    assert_near({ 0, 0, 0, 128 }, at(art, 40, 55))
    assert_near({ 0, 0, 0, 0 }, at(art, 60, 55))
    art = read '<g style="filter:invert(1)"><rect id="a" width="9" height="9"/></g>'
    local red = celspan.rect { 0, 0, 9, 9, texture = "#f00" }
    local other = art:with { a = function() return red end }
    assert_near({ 255, 255, 255, 255 }, at(art, 4, 4))
    assert_near({ 0, 255, 255, 255 }, at(other, 4, 4))
  end)

  it("that is invalid makes the whole value count as not given, and is listed", function()
    for _, value in ipairs { "blur(-1px)", "blur(2%)", "blur(2px", "blur 2px", "blur(2px 2px)",
                             "blur (2px)", "brightness(-1)", "brightness(1e99)", "glow(2px)",
                             "hue-rotate(90)", "drop-shadow()", "drop-shadow(2px)",
                             "drop-shadow(2px 2px -1px)", "drop-shadow(red 2px 2px red)",
                             "drop-shadow(1px 1px 1px 1px)", "invert(1), invert(1)",
                             "invert(1) none", "invert(calc(1 + 1))", "invert(1) url(#a", "(",
                             "," } do
      for style = 1, 2 do
        local art = with(value, style == 2)
        assert.are.equal(('1 filter "%s"'):format(value), told(art))
        assert_near({ 64, 192, 128, 255 }, at(art, 40, 40), 0, value)
      end
    end
    local art = read '<rect width="9" height="9" style="filter:invert(1);filter:blur(-1px)"/>'
    assert_near({ 255, 255, 255, 255 }, at(art, 4, 4))
  end)

  it("needs units of lengths in styles alone", function()
    assert.are.equal("", told(with "drop-shadow(10 10)"))
    assert_near({ 0, 0, 255, 255 }, at(with "drop-shadow(10 10)", 65, 65))
    assert.are.equal('1 filter "blur(2)"', told(with("blur(2)", true)))
    assert.are.equal("", told(with("blur(0)", true)))
  end)

  it("is not there where the value says so, and may be inherited and a variable", function()
    for _, value in ipairs { "none", "initial", "unset" } do
      local art = with(value, true)
      assert.are.equal("", told(art))
      assert_near({ 64, 192, 128, 255 }, at(art, 40, 40))
    end
    local art = read('<g style="--f:invert(1);filter:invert(1)"><rect width="9" height="9" '
      .. 'style="filter:inherit"/><rect x="20" width="9" height="9" style="filter:var(--f)"/></g>')
    assert_near({ 0, 0, 0, 255 }, at(art, 4, 4))
    assert_near({ 0, 0, 0, 255 }, at(art, 24, 4))
  end)

  it("does not take long, however many and however large they are", function()
    local art = with(("drop-shadow(1px 1px)"):rep(11, " "))
    assert.are.equal("1 filter of g: drop-shadow that repeats its input too often", told(art))
    assert.are.equal("", told(with(("drop-shadow(1px 1px)"):rep(4, " "))))
    assert.are.equal("", told(with "blur(1e12px) drop-shadow(-1e12px 1e12em 1e12px)"))
    assert_near({ 255, 255, 255, 255 }, at(with "brightness(1e12) contrast(1e12)", 40, 40))
    assert_near({ 64, 192, 128, 255 }, at(with "hue-rotate(36e10deg) saturate(1)", 40, 40))
    pixels(with("blur(1e12px) drop-shadow(-1e12px 1e12em 1e12px)").object)
  end)
end)

describe("what a filter cannot do", function()
  it("is named at its line, and the element is drawn as it is", function()
    for primitive, what in pairs {
      ["<feBlend/><feMorphology radius='2'/>"] = "feMorphology of several colours",
      ['<feOffset in="BackgroundImage"/>'] = "feOffset with such an input",
      ['<feComposite operator="arithmetic" k1="1"/>'] = "feComposite with such a k1",
      ['<feComposite operator="arithmetic" k1="5"/>'] = "feComposite with such numbers",
      ['<feComposite operator="arithmetic" k2="-1"/>'] = "feComposite with such numbers",
      ['<feColorMatrix values="1 0 0 1 0 0 1 0 0 0 0 0 1 0 0 0 0 0 1 0"/>'] =
        "feColorMatrix with colours that depend on alpha",
      ['<feColorMatrix values="1 0 0 0 0 0 1 0 0 0 0 0 1 0 0 1 0 0 1 0"/>'] =
        "feColorMatrix with alpha that depends on colours",
    } do
      local art = filtered("\n" .. primitive)
      assert.are.equal("2 filter of rect: " .. what, told(art))
      assert_near({ 64, 192, 128, 255 }, at(art, 40, 40))
    end
  end)

  it("is named for references that lead nowhere, alone or in a list", function()
    for _, value in ipairs { "url(#none)", "invert() url(#none) blur(1px)", "url(other.svg#f)" } do
      local art = read(('<rect width="9" height="9" filter="%s"/>'):format(value))
      assert.are.equal("1 filter of rect", told(art))
      assert_near({ 0, 0, 0, 255 }, at(art, 4, 4))
    end
  end)

  it("is named where browsers draw something else", function()
    local blur = '<feGaussianBlur stdDeviation="4" %s/>'
    local art, plain = filtered(blur:format 'edgeMode="duplicate"'), filtered(blur:format "")
    assert.are.equal('1 edgeMode "duplicate"', told(art))
    assert.are.equal(0, images.difference(pixels(art.object), pixels(plain.object)))
    assert.are.equal("", told(filtered(blur:format 'edgeMode="none"')))
  end)

  it("is named where it would show itself or grow without end", function()
    local art = read('<filter id="f"><feImage href="#r"/></filter><g id="r" filter="url(#f)">'
      .. '<rect width="9" height="9"/></g>')
    assert.are.equal("1 filter of g: feImage of an element that it is inside of", told(art))
    art = read('<filter id="f"><feImage href="#r"/></filter>'
      .. '<rect id="r" width="9" height="9" filter="url(#f)"/>')
    assert.are.equal("1 filter of rect: feImage of an element that it is inside of", told(art))
    local double = '<feMerge><feMergeNode/><feMergeNode/></feMerge>'
    assert.are.equal("1 filter of rect: feMerge that repeats its input too often",
      told(filtered(double:rep(60))))
    assert.are.equal("", told(filtered(double:rep(4))))
  end)

  it("does not take long where numbers are large", function()
    local art = filtered('<feGaussianBlur stdDeviation="1e9 1"/><feOffset dx="1e9"/>',
      'x="-1e6" y="-1e6" width="2e6" height="2e6"')
    assert_near({ 0, 0, 0, 0 }, at(art, 40, 40))
  end)
end)
