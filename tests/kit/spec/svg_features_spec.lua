-- Features of SVG and CSS, a small drawing for each: it is drawn like another drawing without the
-- feature, or the drawing says that it is left out. A feature that is neither is drawn wrongly
-- without a word, which this list is there to prevent. One list, as long as the list of features.
local celspan = require "celspan"
local svg = require "celspan.svg"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local SIDE = 100
local HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
  .. 'width="100" height="100"%s>\n'
local FONT = "../../../scripts/type/block.ttf" -- from this file
local bench, count = workbench.new(), 0

local function read(content, attributes)
  count = count + 1
  local path = bench:write(("drawing-%d.svg"):format(count),
    HEAD:format(attributes or "") .. content .. "</svg>")
  return assert(svg.read(path, { fonts = { default = FONT } }))
end

local function bytes(art)
  local rostrum = celspan.rostrum { celspan.cel { art.object } }
  return assert(celspan.pixels(rostrum, { film = { SIDE, SIDE }, size = { SIDE, SIDE } })):bytes()
end

local function told(art)
  local list = {}
  for i, entry in ipairs(art.skipped) do list[i] = entry.what end
  return table.concat(list, ", ")
end

local nothing = ("\0"):rep(4 * SIDE * SIDE)

--- Each is drawn like the second, of which nothing is left out.
local function drawn(cases)
  for _, case in ipairs(cases) do
    local first, second = read(case[1]), read(case[2])
    assert.is_true(bytes(second) ~= nothing, case[2])
    assert.is_true(bytes(first) == bytes(second), case[1] .. "\nis not\n" .. case[2])
    assert.are.equal("", told(first), case[1])
  end
end

--- Each says what is left out of it, once.
local function listed(cases)
  for _, case in ipairs(cases) do
    assert.are.equal(case[2], told(read(case[1], case.root)), case[1])
  end
end

--- Each leaves nothing out.
local function silent(cases)
  for _, case in ipairs(cases) do assert.are.equal("", told(read(case)), case) end
end

local function box(attributes)
  return ('<rect x="10" y="10" width="20" height="10" fill="red" %s/>'):format(attributes or "")
end
local function styled(style) return box(('style="%s"'):format(style)) end
local function text(content, attributes)
  return ('<text x="20" y="50" font-size="20" %s>%s</text>'):format(attributes or "", content)
end

local it = present.type() and it or pending

teardown(function() bench:remove() end)

describe("transforms in styles", function()
  local function moved(transform) return box(('transform="%s"'):format(transform)) end
  it("have units and all functions of the plane", function()
    drawn {
      { styled "transform:translateX(10px)", moved "translate(10)" },
      { styled "transform:translateY(1em)", moved "translate(0,16)" },
      { styled "transform:translate(10%, 50%)", moved "translate(10,50)" },
      { styled "transform:translate(60px, 60px) rotate(0.5turn)",
        moved "translate(60 60)rotate(180)" },
      { styled "transform:translate(60px) rotate(100grad)", moved "translate(60)rotate(90)" },
      { styled "transform:translate(40px,40px) rotate(1.5707963267948966rad)",
        moved "translate(40 40)rotate(90)" },
      { styled "transform:scaleX(2) scaleY(3)", moved "scale(2 3)" },
      { styled "transform:scale(200%, 3)", moved "scale(2 3)" },
      { styled "transform:skew(10deg)", moved "skewX(10)" },
      { styled "transform:skew(10deg, 5deg)",
        moved "matrix(1 .08748866352592401 .17632698 1 0 0)" },
      { styled "transform:matrix(2,0,0,2,5,5)", moved "translate(5 5)scale(2)" },
      { styled "transform:matrix3d(2,0,0,0,0,2,0,0,0,0,1,0,5,5,0,1)",
        moved "translate(5 5)scale(2)" },
      { styled "transform:translate3d(5px,5px,0) scale3d(2,2,1) rotateZ(0deg)",
        moved "translate(5 5)scale(2)" },
      { styled "transform:translate(40px) rotate3d(0,0,1,90deg)",
        moved "translate(40)rotate(90)" },
      { styled "TRANSFORM:TRANSLATEX(10PX)", moved "translate(10)" },
      { "<style>rect{transform:translateX(10px)}</style>" .. box(), moved "translate(10)" },
    }
  end)

  it("are also properties of their own", function()
    drawn {
      { styled "translate:10px 5px", moved "translate(10 5)" },
      { styled "translate:10px", moved "translate(10)" },
      { styled "scale:2", moved "scale(2)" }, { styled "scale:200% 3", moved "scale(2 3)" },
      { styled "translate:40px;rotate:90deg", moved "translate(40)rotate(90)" },
      { styled "translate:40px;rotate:z 90deg", moved "translate(40)rotate(90)" },
      { styled "translate:40px;rotate:0 0 1 90deg", moved "translate(40)rotate(90)" },
      { styled "translate:none;scale:none;rotate:none", box() },
      { styled "translate:40px;rotate:90deg;scale:2;transform:translate(1px)",
        moved "translate(40)rotate(90)scale(2)translate(1)" },
      { styled "rotate:90deg;transform-origin:20px 15px",
        box 'transform="rotate(90 20 15)"' },
    }
  end)

  it("that leave the plane are listed", function()
    listed {
      { styled "transform:rotate3d(1,1,0,45deg)", 'transform "rotate3d(1,1,0,45deg)"' },
      { styled "transform:rotateX(45deg)", 'transform "rotateX(45deg)"' },
      { styled "transform:perspective(5px)", 'transform "perspective(5px)"' },
      { styled "transform:translateZ(5px)", 'transform "translateZ(5px)"' },
      { styled "transform:matrix3d(1,0,0,.1,0,1,0,0,0,0,1,0,0,0,0,1)",
        'transform "matrix3d(1,0,0,.1,0,1,0,0,0,0,1,0,0,0,0,1)"' },
      { styled "transform:translateX(5parsec)", 'transform "translateX(5parsec)"' },
      { styled "rotate:x 45deg", 'rotate "x 45deg"' },
      { styled "rotate:1 0 0 45deg", 'rotate "1 0 0 45deg"' },
      { styled "translate:1px 2px 3px", 'translate "1px 2px 3px"' },
      { styled "transform-box:stroke-box", 'transform-box "stroke-box"' },
      { styled "offset-path:circle(9px)", 'offset-path "circle(9px)"' },
    }
  end)
end)

describe("places and sizes in styles", function()
  it("are those of the element", function()
    drawn {
      { '<rect style="x:10px;y:10px;width:20px;height:10px" fill="red"/>', box() },
      { '<rect x="1" width="1" fill="red" style="x:10px;y:10px;width:20px;height:10px"/>', box() },
      { "<style>rect{width:20px}</style>" .. box():gsub('width="20"', 'width="3"'), box() },
      { (box():gsub('width="20"', 'width="3" style="width:20px!important"')), box() },
      { styled "rx:5px", box 'rx="5"' }, { styled "rx:auto;ry:2px", box 'ry="2"' },
      { styled "width:20%;height:10%", box() },
      { '<circle style="cx:30px;cy:40px;r:20px"/>', '<circle cx="30" cy="40" r="20"/>' },
      { '<ellipse style="cx:30px;cy:40px;rx:20px;ry:1em"/>',
        '<ellipse cx="30" cy="40" rx="20" ry="16"/>' },
      { [[<path style="d:path('M0 0H50V50')"/>]], '<path d="M0 0H50V50"/>' },
      { [[<path d="M0 0H9V9" style='d:path("M0 0H50V50")'/>]], '<path d="M0 0H50V50"/>' },
      { '<svg style="width:50px;height:50px" viewBox="0 0 10 10"><rect width="10" height="10"/>'
        .. "</svg>",
        '<rect width="50" height="50"/>' },
      { '<style>g{width:5px}text{x:5px}</style><g>' .. text "A" .. "</g>", text "A" },
    }
  end)

  it("without a unit, or of a kind that is not read, are listed", function()
    listed {
      { styled "width:5", 'width "5"' }, { styled "width:min-content", 'width "min-content"' },
      { styled "width:calc(1px + 2px)", 'width "calc(1px + 2px)"' },
      { [[<path style="d:'M0 0'"/>]], "d \"'M0 0'\"" },
    }
  end)
end)

describe("variables", function()
  it("stand for values, with fallbacks", function()
    drawn {
      { styled "fill:var(--none, red)", box() },
      { '<g style="--a:red">' .. styled "fill:var(--a)" .. "</g>", box() },
      { '<g style="--a:red"><g style="--a:blue;--a:red">' .. styled "fill:var(--a, blue)"
        .. "</g></g>",
        box() },
      { "<style>:root{--a:red;--b:var(--a)}</style>" .. styled "fill:var( --b )", box() },
      { "<style>:root{--a:blue} rect{--a:red;fill:var(--a)}</style>" .. box 'class="a"', box() },
      { box('style="--a:red"'):gsub('fill="red"', 'fill="var(--a)"'), box() },
      { '<g style="--x:10px">' .. styled "transform:translate(var(--x), var(--y, 5px))" .. "</g>",
        box 'transform="translate(10 5)"' },
      { '<g style="--w:20px">' .. box():gsub('width="20"', 'style="width:var(--w)"') .. "</g>",
        box() },
      { '<defs><rect id="r" x="10" y="10" width="20" height="10" fill="var(--a)"/></defs>'
        .. '<use href="#r" style="--a:red"/>', box() },
      { styled "fill:var(--a, var(--b, red))", box() },
    }
  end)

  it("without a value, or in a circle, are listed, and the value is the inherited one", function()
    for _, style in ipairs { "fill:var(--a)", "--a:var(--b);--b:var(--a);fill:var(--a)",
      "--a:5px;fill:var(--a)", "fill:var(--a" } do
      local art = read(('<rect width="9" height="9" style="%s"/>'):format("fill:red;" .. style))
      assert.is_true(bytes(art) == bytes(read '<rect width="9" height="9"/>'), style)
      assert.are.equal(1, #art.skipped, style)
    end
    local long = {}
    for i = 1, 15 do long[i] = ("--a%d:%s"):format(i, ("var(--a%d)"):format(i + 1):rep(20)) end
    local art = read(styled(table.concat(long, ";") .. ";--a16:;fill:var(--a1)"))
    assert.are.equal('fill "var(--a1)"', told(art))
  end)
end)

describe("colours of other spaces", function()
  it("are drawn, cut off at sRGB", function()
    drawn {
      { styled "fill:hwb(0 0% 0%)", box() }, { styled "fill:hwb(0deg 0% 0% / 1)", box() },
      { styled "fill:hwb(90 50% 50%)", styled "fill:#808080" },
      { styled "fill:hwb(90 60% 60%)", styled "fill:#808080" },
      { styled "fill:color(srgb 1 0 0)", box() },
      { styled "fill:color(srgb-linear 1 0 0)", box() },
      { styled "fill:color(display-p3 1 0 0)", box() },
      { styled "fill:color(srgb 100% none 0 / 50%)", styled "fill:rgb(255 0 0 / .5)" },
      { styled "fill:oklch(0 0 0)", styled "fill:#000" },
      { styled "fill:oklab(100% 0 0)", styled "fill:#fff" },
      { styled "fill:lab(100 0 0)", styled "fill:#fff" },
      { styled "fill:lch(0% 0 none)", styled "fill:#000" },
      { styled "fill:hsl(0.5turn 100% 50%)", styled "fill:#0ff" },
    }
  end)

  it("are those of the specification's examples", function()
    for fill, wanted in pairs {
      ["oklch(62.796% 0.25768 29.23388)"] = { 1, 0, 0 }, -- red
      ["oklab(0.86644 -0.23389 0.1795)"] = { 0, 1, 0 }, -- lime
      ["lab(54.29 80.8198 69.8997)"] = { 1, 0, 0 },
      ["lch(29.5683 131.2042 301.364)"] = { 0, 0, 1 },
      ["lab(46.2775% -47.5621 48.5837)"] = { 0, 128 / 255, 0 }, -- green
      ["color(xyz 0.4124 0.2126 0.0193)"] = { 1, 0, 0 },
      ["color(xyz-d50 0.43607 0.22249 0.01392)"] = { 1, 0, 0 },
      ["color(display-p3 0.5 0.5 0.5)"] = { .5, .5, .5 },
      ["hsl(30,100%,50%)"] = { 1, .5, 0 },
      ["hsl(200 50% 40%)"] = { .2, 7 / 15, .6 },
      ["hwb(30 20% 20%)"] = { .8, .5, .2 },
    } do
      local rostrum = celspan.rostrum { celspan.cel { read(styled("fill:" .. fill)).object } }
      local found = { celspan.probe(rostrum, 15, 15, { film = { SIDE, SIDE } }) }
      for i = 1, 3 do
        local c = found[i]
        c = c <= 0.0031308 and 12.92 * c or 1.055 * c ^ (1 / 2.4) - 0.055
        assert.is_true(math.abs(c - wanted[i]) < 0.003, ("%s: %g, not %g"):format(fill, c,
          wanted[i]))
      end
    end
  end)

  it("that are not read are listed", function()
    listed {
      { styled "fill:color-mix(in srgb, red, blue)", 'fill "color-mix(in srgb, red, blue)"' },
      { styled "fill:color(rec2020 1 0 0)", 'fill "color(rec2020 1 0 0)"' },
      { styled "fill:light-dark(red, blue)", 'fill "light-dark(red, blue)"' },
      { styled "stroke:device-cmyk(0 0 0 1)", 'stroke "device-cmyk(0 0 0 1)"' },
      { styled "fill:lab(50 20)", 'fill "lab(50 20)"' },
      { styled "fill:hwb(0)", 'fill "hwb(0)"' },
      { box 'color-interpolation="linearRGB"', 'color-interpolation "linearRGB"' },
    }
  end)
end)

describe("baselines", function()
  it("lie where the text says", function()
    drawn {
      { text("A", 'dominant-baseline="auto"'), text "A" },
      { text("A", 'dominant-baseline="alphabetic"'), text "A" },
      { text("A", 'dominant-baseline=" MIDDLE "'), text("A", 'dy="5"') },
      { text("A", 'dominant-baseline="middle"'), text("A", 'dy="5"') },
      { '<g dominant-baseline="middle">' .. text "A" .. "</g>", text("A", 'dy="5"') },
      { '<g dominant-baseline="middle">' .. text("A", 'dominant-baseline="auto"') .. "</g>",
        text "A" },
      { text('<tspan alignment-baseline="middle">A</tspan>B'),
        text '<tspan dy="5">A</tspan><tspan dy="-5">B</tspan>' },
      { text('<tspan baseline-shift="5">A</tspan>B'),
        text '<tspan dy="-5">A</tspan><tspan dy="5">B</tspan>' },
      { text('<tspan baseline-shift="25%">A</tspan>B'),
        text '<tspan dy="-5">A</tspan><tspan dy="5">B</tspan>' },
      { text('<tspan baseline-shift="sub">A</tspan>B'),
        text '<tspan dy="4">A</tspan><tspan dy="-4">B</tspan>' },
      { text('<tspan baseline-shift="2"><tspan baseline-shift="3">A</tspan></tspan>'), text("A",
        'dy="-5"') },
      { '<g baseline-shift="9">' .. text("A", 'baseline-shift="9"') .. "</g>", text "A" },
    }
  end)

  it("are placed by the lines of the font, and shifted from there", function()
    local seen = {}
    for _, word in ipairs { "alphabetic", "middle", "central", "hanging", "mathematical",
      "text-bottom", "text-top" } do
      local art = read(text("A", ('dominant-baseline="%s"'):format(word)))
      local _, y = art.object:bounds()
      assert.is_nil(seen[y], word)
      seen[y] = word
      assert.are.equal("", told(art))
      local placed = ('dominant-baseline="%s"'):format(word)
      local shifted = read(text('<tspan baseline-shift="5">A</tspan>', placed))
      local _, higher = shifted.object:bounds()
      assert.is_true(math.abs(higher - (y - 5)) < 1e-9, word)
    end
  end)
end)

describe("texts", function()
  it("show the languages of their readers", function()
    drawn { { text '<tspan systemLanguage="de">B</tspan><tspan systemLanguage="en-GB">A</tspan>',
      text "A" } }
  end)

  it("have sizes in words", function()
    drawn {
      { text("A", 'style="font-size:xx-large"'), text("A", 'style="font-size:32px"') },
      { '<g font-size="20">' .. text("A", 'style="font-size:larger"') .. "</g>",
        text("A", 'style="font-size:24px"') },
    }
  end)

  it("begin again on every line that they run along", function()
    local lines = '<path id="a" d="M10 30H90" fill="none"/><path id="b" d="M10 60H90" fill="none"/>'
    local function along(content) return lines .. '<text font-size="20">' .. content
      .. "</text>" end
    drawn {
      { along '<textPath href="#a">AB</textPath><textPath href="#b">C</textPath>',
        along '<textPath href="#a">AB</textPath>' .. along '<textPath href="#b">C</textPath>' },
      { along '<textPath href="#a">AB</textPath><textPath href="#b" startOffset="10">C</textPath>',
        along '<textPath href="#a">AB</textPath>'
          .. along '<textPath href="#b" startOffset="10">C</textPath>' },
    }
  end)

  it("list what is not drawn, wherever it is inherited from", function()
    local function over(property, value) return { ('<g %s="%s">'):format(property, value)
      .. text "A" .. "</g>",
      ('%s "%s"'):format(property, value) } end
    listed { over("text-decoration", "underline"), over("writing-mode", "tb"),
      over("writing-mode", "vertical-rl"), over("font-variant", "small-caps"),
      over("font-stretch", "condensed"), over("glyph-orientation-vertical", "90"),
      over("unicode-bidi", "bidi-override") }
    local function with(style) return { text("A", ('style="%s"'):format(style)),
      (style:gsub(":(.*)", ' "%1"')) } end
    listed { with "font-variation-settings:'wght' 500", with "font-feature-settings:'smcp'",
      with "text-transform:uppercase", with "text-shadow:1px 1px red", with "inline-size:50px",
      with "text-decoration-line:underline", with "white-space:pre", with "font:12px sans-serif",
      with "font-size-adjust:.5", with "shape-inside:url(#s)", with "font-kerning:none",
      with "text-orientation:upright", with "font-variant-caps:small-caps",
      with "word-spacing:x", with "hyphenate-character:'-'" }
    listed { { '<path id="p" d="M0 50H90"/>'
      .. '<text><textPath href="#p" method="stretch">A</textPath></text>',
      'method "stretch"' } }
  end)
end)

describe("markers", function()
  local MARKER = '<marker id="k" markerWidth="6" markerHeight="6" refX="3" refY="3" %s>'
    .. '<rect width="6" height="6" fill="lime"/></marker>'
  local function marked(shape, attributes)
    return MARKER:format(attributes or "")
      .. "<g marker-start='url(#k)' marker-mid='url(#k)' marker-end='url(#k)'>"
      .. shape .. "</g>"
  end
  it("are drawn on all shapes", function()
    drawn {
      { marked '<rect x="20" y="20" width="40" height="30"/>',
        marked '<path d="M20 20H60V50H20Z"/>' },
      { marked '<rect x="20" y="20" width="40" height="30" rx="5"/>',
        marked('<path d="M25 20H55A5 5 0 0 1 60 25V45A5 5 0 0 1 55 50H25A5 5 0 0 1 20 45V25'
          .. 'A5 5 0 0 1 25 20Z"/>') },
      { marked '<circle cx="50" cy="50" r="30"/>',
        marked('<path d="M80 50A30 30 0 0 1 50 80A30 30 0 0 1 20 50A30 30 0 0 1 50 20'
          .. 'A30 30 0 0 1 80 50Z"/>') },
      { marked '<ellipse cx="50" cy="50" rx="30" ry="20"/>',
        marked('<path d="M80 50A30 20 0 0 1 50 70A30 20 0 0 1 20 50A30 20 0 0 1 50 30'
          .. 'A30 20 0 0 1 80 50Z"/>') },
    }
  end)

  it("inherit how they overflow if they say so", function()
    local large = '<g overflow="visible"><marker id="k" markerWidth="2" markerHeight="2" %s>'
      .. '<rect width="9" height="9" fill="lime"/></marker></g>'
      .. '<path d="M10 10H50" marker-end="url(#k)"/>'
    drawn { { large:format 'overflow="inherit"', large:format 'overflow="visible"' } }
    assert.is_true(
      bytes(read(large:format "")) ~= bytes(read(large:format 'overflow="inherit"')))
  end)

  it("and what use shows fit gradients to the element they belong to", function()
    local gradient = '<linearGradient id="g"><stop offset=".5" stop-color="red"/>'
      .. '<stop offset=".5" stop-color="blue"/></linearGradient>'
    drawn {
      { gradient .. '<defs><g id="u"><rect width="20" height="20" fill="context-fill"/>'
        .. '<rect x="60" width="20" height="20" fill="context-fill"/></g></defs>'
        .. '<use href="#u" fill="url(#g)"/>',
        '<rect width="20" height="20" fill="red"/>'
          .. '<rect x="60" width="20" height="20" fill="blue"/>' },
      { gradient
        .. '<marker id="m" markerUnits="userSpaceOnUse" markerWidth="10" markerHeight="10" '
        .. 'refX="5" refY="5"><rect width="10" height="10" fill="context-stroke"/></marker>'
        .. '<path d="M20 50L80 51" stroke="url(#g)" stroke-width="0" fill="none" '
        .. 'marker-start="url(#m)" marker-end="url(#m)"/>',
        '<rect x="15" y="45" width="10" height="10" fill="red"/>'
          .. '<rect x="75" y="46" width="10" height="10" fill="blue"/>' },
      { '<defs><rect id="u" width="20" height="20" fill="context-fill"/></defs>'
        .. '<use href="#u" fill="currentColor" color="red"/>',
        '<rect width="20" height="20" fill="red"/>' },
    }
  end)
end)

describe("invalid values", function()
  it("do not count, and are listed", function()
    local function same(first, second, note)
      local art = read(first)
      assert.is_true(bytes(art) == bytes(read(second)), first)
      assert.are.equal(note, told(art))
    end
    same(box 'opacity="0.1mm"', box(), 'opacity "0.1mm"')
    same(box 'stroke="blue" paint-order="stroke stroke"', box 'stroke="blue"',
      'paint-order "stroke stroke"')
    local plain = '<g fill="red"><rect width="9" height="9" fill="%s"/></g>'
    same(plain:format "rgba(0,50%,0,.5)", plain:format "red", 'fill "rgba(0,50%,0,.5)"')
    same(plain:format "rgb(0%,5,0%)", plain:format "red", 'fill "rgb(0%,5,0%)"')
    same(box 'stroke="blue" stroke-width="-3"', box 'stroke="blue"', 'stroke-width "-3"')
    same(styled "opacity:.5;opacity:x", styled "opacity:.5", 'opacity "x"')
    same(styled "stroke:blue;stroke-linejoin:round;stroke-linejoin:x",
      styled "stroke:blue;stroke-linejoin:round", 'stroke-linejoin "x"')
  end)

  it("are words that every property has", function()
    drawn {
      { '<g fill="blue">' .. styled "fill:initial" .. "</g>", styled "fill:black" },
      { '<g fill="blue" stroke="red">' .. styled "fill:unset;stroke:initial" .. "</g>",
        styled "fill:blue" },
      { '<g fill="blue">' .. styled "fill:inherit" .. "</g>", styled "fill:blue" },
      { styled "opacity:initial", box() }, { styled "transform:unset", box() },
      { '<g transform="translate(5)">' .. styled "transform:inherit" .. "</g>",
        box 'transform="translate(10)"' },
      { '<g display="inline">' .. styled "display:inherit" .. "</g>", box() },
    }
  end)
end)

describe("references", function()
  it("of no namespace win, in any order", function()
    local two = '<defs><rect id="r" width="9" height="9" fill="red"/>'
      .. '<rect id="g" width="9" height="9" fill="lime"/></defs>'
    local green = '<rect width="9" height="9" fill="lime"/>'
    drawn {
      { two .. '<use href="#g" xlink:href="#r"/>', green },
      { two .. '<use xlink:href="#r" href="#g"/>', green },
      { '<linearGradient id="a"><stop stop-color="red"/></linearGradient><linearGradient id="b">'
        .. '<stop stop-color="lime"/></linearGradient><linearGradient id="c" xlink:href="#a" '
        .. 'href="#b"/><rect width="9" height="9" fill="url(#c)"/>', green },
    }
  end)
end)

describe("gradients that are not level", function()
  local function gradient(attributes, stops)
    return ('<linearGradient id="g" gradientUnits="userSpaceOnUse" %s>%s</linearGradient>'
      .. '<rect width="100" height="100" fill="url(#g)"/>'):format(attributes, stops)
  end
  local function stop(offset, colour)
    return ('<stop offset="%g" stop-color="%s"/>'):format(offset, colour)
  end
  local once = stop(0, "red") .. stop(1, "blue")
  --- Four periods, from (10, 10) to (90, 50), as one.
  local function periods(is_reflected)
    local stops = {}
    for i = 0, 3 do
      local is_turned = is_reflected and i % 2 == 0 -- the second period is the gradient itself
      stops[#stops + 1] = stop(i / 4, is_turned and "blue" or "red")
      stops[#stops + 1] = stop((i + 1) / 4, is_turned and "red" or "blue")
    end
    return table.concat(stops)
  end

  it("are repeated and reflected along their own direction", function()
    for spread, is_reflected in pairs { ["repeat"] = false, reflect = true } do
      local first = read(gradient('x1="30" y1="20" x2="50" y2="30" spreadMethod="' .. spread .. '"',
        once))
      local second = read(gradient('x1="10" y1="10" x2="90" y2="50"', periods(is_reflected)))
      for _, point in ipairs { { 15, 20 }, { 35, 30 }, { 45, 18 }, { 60, 40 }, { 70, 33 } } do
        local colours = {}
        for i, art in ipairs { first, second } do
          local rostrum = celspan.rostrum { celspan.cel { art.object } }
          colours[i] = { celspan.probe(rostrum, point[1], point[2], { film = { SIDE, SIDE } }) }
        end
        for c = 1, 3 do
          assert.is_true(math.abs(colours[1][c] - colours[2][c]) < 0.01,
            ("%s at %g %g"):format(spread, point[1], point[2]))
        end
      end
    end
  end)
end)

describe("lengths that lines declare", function()
  it("are what their dashes are measured by", function()
    local function dashed(attributes)
      return ('<path d="M10 50H90" stroke="red" stroke-width="9" %s/>'):format(attributes)
    end
    drawn {
      { dashed 'stroke-dasharray="1" pathLength="4"', dashed 'stroke-dasharray="20"' },
      { dashed 'stroke-dasharray="1" stroke-dashoffset=".5" pathLength="4"',
        dashed 'stroke-dasharray="20" stroke-dashoffset="10"' },
      { dashed 'stroke-dasharray="20" pathLength="-4"', dashed 'stroke-dasharray="20"' },
      { dashed 'stroke-dasharray="20" pathLength="0"', dashed "" },
    }
  end)
end)

describe("drawings without a size", function()
  it("are empty", function()
    for _, size in ipairs { { -5, 10 }, { 10, 0 }, { 0, 0 } } do
      count = count + 1
      local path = bench:write(("drawing-%d.svg"):format(count),
        ('<svg xmlns="http://www.w3.org/2000/svg" width="%g" height="%g">%s</svg>')
          :format(size[1], size[2], box()))
      local art = assert(svg.read(path))
      assert.are.equal(0, math.min(art.width, art.height))
      assert.is_true(bytes(art) == nothing)
    end
  end)
end)

describe("whatever else a document names", function()
  it("is listed, once for each name", function()
    local BOX = box()
    listed {
      { '<rect width="9" height="9"><animate attributeName="x" to="5" begin="click"/></rect>',
        'animate: begin "click" is not run' },
      { '<rect width="9" height="9"><set attributeName="unheard" to="5"/></rect>',
        "set of unheard" },
      { "<blink/><g><blink/><blink/></g>", "blink" },
      { '<video xmlns="http://www.w3.org/1999/xhtml" src="a.mp4"/>', "video" },
      { "<video/>", "video" }, { "<solidcolor/>", "solidcolor" },
      { "<foreignObject/>", "foreignObject" },
      { BOX, 'background "#fff"', root = ' style="background:#fff"' },
      { BOX, 'background-color "red"', root = ' style="background-color:red"' },
      { styled "backdrop-filter:blur(2px)", 'backdrop-filter "blur(2px)"' },
      { styled "mask-image:url(#m)", 'mask-image "url(#m)"' },
      { styled "-webkit-mask-image:url(#m)", '-webkit-mask-image "url(#m)"' },
      { styled "mask:linear-gradient(red, blue)", 'mask "linear-gradient(red, blue)"' },
      { styled "image-rendering:pixelated", 'image-rendering "pixelated"' },
      { styled "clip:rect(0,1px,1px,0)", 'clip "rect(0,1px,1px,0)"' },
      { styled "zoom:2", 'zoom "2"' }, { styled "z-index:2", 'z-index "2"' },
      { styled "vector-effect:inherit", 'vector-effect "inherit"' },
      { styled "an-unheard-of-property:1" .. styled "an-unheard-of-property:2",
        'an-unheard-of-property "1"' },
      { box 'unheard="a"' .. box 'unheard="b"', 'unheard "a"' },
      { "<style>rect{fill:red;&amp;:hover{fill:blue}}</style>" .. BOX,
        "style: selectors or at-rules that are not supported" },
      { "<style>g{rect{fill:blue}}</style>" .. BOX,
        "style: selectors or at-rules that are not supported" },
    }
  end)

  it("leaves rules beside rules inside of rules as they are", function()
    local art = read("<style>rect{fill:red;&amp;:hover{fill:blue}stroke:lime}</style>" .. box())
    assert.is_true(bytes(art) == bytes(read(box 'stroke="lime"')))
  end)

  it("is no word where it changes nothing", function()
    silent {
      box 'data-x="1" aria-label="b" role="img" onclick="f()" tabindex="0" lang="en"',
      box 'xmlns:sodipodi="http://sodipodi" sodipodi:type="arc" xml:lang="en"',
      styled "cursor:pointer;pointer-events:none;-inkscape-font-specification:Sans",
      styled "enable-background:new;shape-rendering:auto;text-rendering:auto;font-variant:normal",
      styled "isolation:auto;mix-blend-mode:normal;color-interpolation:sRGB;solid-color:#000",
      '<title>A</title><desc>B</desc><metadata><a:b xmlns:a="urn:a"/></metadata>' .. box(),
      '<switch><blink/><g>' .. box() .. "</g></switch>",
      '<filter id="f"><feGaussianBlur stdDeviation="2"/></filter>' .. box(),
      '<style media="print">rect{unheard:1}</style>' .. box(),
      box 'space="preserve" label="a"',
      '<pattern id="p" patternUnits="userSpaceOnUse" patternTransform="scale(2)"/>' .. box(),
      '<a xlink:href="#b" xlink:title="c" target="_blank">' .. box() .. "</a>",
    }
  end)
end)
