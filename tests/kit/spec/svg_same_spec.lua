-- Drawings from SVG that are written in two ways and are the same to the bit; what draws nothing;
-- what is left out and reported; and what is refused. One list, with a line for each case, as long
-- as there are ways of writing the same. tests/kit/spec/svg_spec.lua says what a drawing shows.
local celspan = require "celspan"
local svg = require "celspan.svg"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local SIDE = 100
local HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
  .. 'width="100" height="100">\n'
local FONT = "../../../scripts/type/block.ttf" -- from this file
local bench, count = workbench.new(), 0

--- The file of a drawing 100 by 100 with this in it.
local function write(content)
  count = count + 1
  return bench:write(("drawing-%d.svg"):format(count), HEAD .. content .. "</svg>")
end

local function read(content)
  return assert(svg.read(write(content), { fonts = { default = FONT } }))
end

local function bytes(object)
  local rostrum = celspan.rostrum { celspan.cel { object } }
  return assert(celspan.pixels(rostrum, { film = { SIDE, SIDE }, size = { SIDE, SIDE } })):bytes()
end

local nothing = ("\0"):rep(4 * SIDE * SIDE)

--- What was left out, as one text.
local function told(art)
  local list = {}
  for i, entry in ipairs(art.skipped) do list[i] = entry.what end
  return table.concat(list, ", ")
end

--- Each pair is the same, and shows something. note: what the first reports, if anything.
local function same(pairs_of)
  for _, pair in ipairs(pairs_of) do
    local first, second = read(pair[1]), read(pair[2])
    local shown = bytes(second.object)
    assert.are_not.equal(nothing, shown, pair[2])
    assert.is_true(bytes(first.object) == shown, pair[1] .. "\nis not\n" .. pair[2])
    assert.are.equal(pair.note or "", told(first), pair[1])
  end
end

--- Each shows nothing. One that reports something is a table of the drawing and the report.
local function empty(drawings)
  for _, case in ipairs(drawings) do
    local content, note = case, ""
    if type(case) == "table" then content, note = case[1], case.note end
    local art = read(content)
    assert.is_true(bytes(art.object) == nothing, content)
    assert.are.equal(note, told(art), content)
  end
end

--- Each reports one thing that is left out, on its line.
local function left_out(cases)
  for _, case in ipairs(cases) do
    local art = read(case[1])
    assert.are.equal(1, #art.skipped, case[1])
    assert.are.equal(case[2], art.skipped[1].what, case[1])
    assert.are.equal(case.line or 2, art.skipped[1].line, case[1])
  end
end

local function refused(cases)
  for _, case in ipairs(cases) do
    local art, message = svg.read(write(case[1]), { fonts = { default = FONT } })
    assert.is_nil(art, case[1])
    assert.is_truthy(message:find(case[2], 1, true), message)
  end
end

local it = present.type() and it or pending

teardown(function() bench:remove() end)

local LIME = '<rect width="50" height="60" fill="lime"/>'

--- The rectangle of LIME, styled by a sheet or an attribute.
local function sheet(text, attributes)
  return ('<style><![CDATA[%s]]></style><rect id="r-1" class="a b" width="50" height="60" %s/>')
    :format(text, attributes or "")
end
local function filled(fill) return ('<rect width="50" height="60" fill="%s"/>'):format(fill) end
local function styled(style) return ('<rect width="50" height="60" style="%s"/>'):format(style) end

describe("style sheets", function()
  it("are read past comments, marks and anything that is not a rule", function()
    local texts = {
      "/* rect{fill:red} */rect{/* fill:red; */fill:lime}", "rect{fill:lime} /* it has no end",
      "<!-- rect{fill:lime} -->",
      "rect{fill:lime", "rect{fill:lime} circle", "rect{fill:lime}}", "rect{;fill:lime;;}",
      "rect{fill;stroke:;:red;fill:lime}",
      "rect{an-unheard-of-property-of-many-letters:1;fill:lime}",
      "rect{unheard:1;fill:lime;width:3}",
      "rect{font-family:'a;b\"}';fill:lime}", "rect{font-family:'a\n;fill:lime}",
      'rect{font-family:"a;b";fill:lime}', "rect{clip:rect(1;2);fill:lime}",
      "circle,rect{fill:lime}", "rect , circle{fill : lime }", "{fill:red} rect{fill:lime}",
    }
    for _, text in ipairs(texts) do
      local art = read(sheet(text))
      assert.is_true(bytes(art.object) == bytes(read(LIME).object), text)
    end
  end)

  it("are ordered by importance, specificity and position", function()
    same {
      { sheet "rect{fill:red} rect{fill:lime}", LIME },
      { sheet "rect{fill:lime!important} rect{fill:red}", LIME },
      { sheet "rect{fill:lime!Important} rect{fill:red}", LIME },
      { sheet "rect{fill:lime ! important} #r-1{fill:red}", LIME },
      { sheet ".a{fill:lime} rect{fill:red}", LIME },
      { sheet "#r-1{fill:lime} .a.b{fill:red}", LIME },
      { sheet "svg rect{fill:lime} rect{fill:red}", LIME },
      { sheet("rect{fill:lime!important}", 'style="fill:red"'), LIME },
      { sheet("rect{fill:red!important}", 'style="fill:lime!important"'), LIME },
      { sheet("*{fill:lime}", 'fill="red"'), LIME },
    }
  end)

  it("select by names, classes and attributes", function()
    for _, selector in ipairs { "*", "rect", "*.a", ".b", ".a.b", "rect#r-1", "svg > rect", "svg>*",
      "[id]", "[id=r-1]",
      "[ id = 'r-1' ]", '[id="r-1"]', "[class~=b]", "[id|=r]", "[id^=r]", "[id$='1']", "[id*=-]",
      "[class^='a b']",
      "rect[width='50'][height='60']", "style + rect, rect" } do
      local shown = bytes(read(sheet(selector .. "{fill:lime}")).object)
      assert.is_true(shown == bytes(read(LIME).object), selector)
    end
    for _, selector in ipairs { "g", ".c", "#r", "circle > rect", "rect > rect", "[rx]", "[id=r]",
      "[class~=c]", "[class~='']",
      "[id|=r-]", "[id^=s]", "[id$='2']", "[id$='longer than it']", "[id*=x]", "[id^='']",
      "[id*='']" } do
      local art = read(sheet(selector .. "{fill:lime}", 'fill="red"'))
      assert.is_true(bytes(art.object) == bytes(read(filled "red").object), selector)
    end
  end)

  it("ignore an invalid paint after a valid one", function()
    for _, value in ipairs { "color(display-p3 0 1 0)", "unknown", "", "#12", "red lime",
      "rgb(1,2" } do
      for _, text in ipairs { sheet("rect{fill:lime;fill:" .. value .. "}"),
        sheet("rect{fill:lime}rect{fill:" .. value .. "}"),
        sheet("rect{fill:lime!important;fill:" .. value .. "!important}"),
        sheet("rect{fill:" .. value .. "}", 'fill="lime"'),
        sheet("", 'style="fill:lime;fill:' .. value .. '"') } do
        assert.is_true(bytes(read(text).object) == bytes(read(LIME).object), value .. ": " .. text)
      end
    end
  end)

  it("report selectors and rules that are ignored", function()
    for _, selector in ipairs { "> rect", "rect:hover", "#a#b", "rect..a", "[of-no-meaning]",
      "[id='r", "[id", (".a"):rep(40), ("[id]"):rep(40),
      ("svg "):rep(40) .. "rect", ",", "@media print{rect{fill:red}} @import 'a.css'; @x" } do
      local art = read(sheet("rect{fill:lime} " .. selector .. "{fill:red}"))
      assert.is_true(bytes(art.object) == bytes(read(LIME).object), selector)
      local what = "style: selectors or at-rules that are not supported"
      assert.are.same({ { line = 2, what = what } },
        art.skipped, selector)
    end
  end)
end)

describe("paints", function()
  it("may be written in every notation of a colour", function()
    for _, text in ipairs { "#0f0", "#0F0F", "#00ff00", "#00FF00fF", "LIME", " lime ",
      "rgb(0,255,0)", "rgb( 0 255 0 )", "rgb(0%,100%,0%)",
      "rgb(0 255 0 / 1)", "rgba(0,255,0,1)", "rgba(0,255,0,100%)", "rgb(-9,999,0)",
      "hsl(120,100%,50%)",
      "hsl(480,100%,50%)",
      "hsl(-240deg,100%,50%)", "hsla(120,100%,50%,1)", "#0f0 icc-color(a, 1)", "url(#none) lime",
      "url(#none)#0f0" } do
      assert.is_true(bytes(read(filled(text)).object) == bytes(read(LIME).object), text)
    end
    same {
      { filled "#00ff0080",
        '<rect width="50" height="60" fill="lime" fill-opacity="0.50196078431372548"/>' },
      { filled "#0f08", '<rect width="50" height="60" fill="rgba(0,255,0,.53333333333333333)"/>' },
      { filled "rgb(0 255 0 / 25%)", styled "fill:lime;opacity:25%" },
      { filled "rgba(0,255,0,.25)", styled "fill:lime;fill-opacity:.25" },
    }
  end)

  it("that are invalid are ignored", function()
    for _, text in ipairs { "", "#", "#12", "#12345", "#1234567", "#123456789", "#xyz", "rgb(1,2",
      "rgb(1,2,)", "rgb 1,2,3", "hsl(1)",
      "hsl(x,1%,1%)", "hsl(1,x,1%)", "hsl(1,1%,x)", "rgb(1,2,3,x)", "rgba(1,2,3,.5", "blurple",
      "a-colour-with-a-very-long-name-indeed",
      "lime red", "#0f0 lime", "icc-color(a)" } do
      assert.is_true(bytes(read('<g fill="lime">' .. filled(text) .. "</g>").object)
        == bytes(read(LIME).object), text)
    end
    empty { filled "none", filled "transparent", filled "url(#none)", filled "url('#none') none",
      '<g fill="none">' .. filled "inherit" .. "</g>" }
  end)

  it("come from currentColor, from the parent and from the painted element", function()
    same {
      { '<g color="lime">' .. filled "currentColor" .. "</g>", LIME },
      {
        '<g color="red"><g color="currentColor"><rect width="50" height="60" color="lime" '
        .. 'fill="CurrentColor"/></g></g>',
        LIME },
      { '<g fill="lime">' .. filled "inherit" .. "</g>", LIME },
      { '<g fill="lime">' .. styled "" .. "</g>", LIME },
      { '<g color="lime" opacity="inherit">' .. filled "currentColor" .. "</g>", LIME },
      { '<g opacity=".5"><rect width="50" height="60" fill="lime" opacity="inherit"/></g>',
        '<rect width="50" height="60" fill="lime" opacity=".25"/>' },
      {
        '<rect width="50" height="60" fill="lime" fill-opacity="150%" opacity="2" '
        .. 'visibility="inherit"/>',
        LIME },
    }
    empty { filled "lime" :gsub("/>", ' fill-opacity="-1"/>'),
      filled "lime" :gsub("/>", ' visibility="collapse"/>') }
  end)
end)

local function gradient(kind, attributes, stops)
  return ('<%sGradient id="g" %s>%s</%sGradient>'):format(kind, attributes or "", stops or
    '<stop stop-color="red"/><stop offset="1" stop-color="blue"/>', kind) .. filled "url(#g)"
end

describe("gradients", function()
  it("may be written in several ways", function()
    local plain = gradient "linear"
    same {
      { gradient("linear", 'x1="0%" x2="100%" y1="0" y2="0%"'), plain },
      { gradient("linear", 'gradientTransform="scale(2)scale(.5)"'), plain },
      { gradient("linear", 'gradientUnits="userSpaceOnUse" x1="0" x2="50"'), plain },
      {
        gradient("linear", "",
          '<title/><stop offset="0%" stop-color="red"/><desc/><stop offset="100%" '
          .. 'stop-color="blue"/>'),
        plain },
      {
        gradient("linear", "",
          '<stop offset="-3" style="stop-color:red"/><stop offset="7" stop-color="blue"/>'),
        plain },
      {
        gradient("linear", "",
          '<stop offset="x" stop-color="red"/><stop offset="1" stop-color="blue"/>'),
        plain, note = 'offset "x"' },
      {
        gradient("linear", "",
          '<stop offset="5 5" stop-color="red"/><stop offset="1" color="blue" '
          .. 'stop-color="currentColor"/>'),
        plain, note = 'offset "5 5"' },
      {
        '<linearGradient id="t" xlink:href="#g"><stop stop-color="red"/><stop offset="1" '
        .. 'stop-color="blue"/></linearGradient>'
        .. gradient("linear", 'xlink:href="#t"', " "), plain },
      {
        '<radialGradient id="t"><stop stop-color="red"/><stop offset="1" '
        .. 'stop-color="blue"/></radialGradient>'
        .. gradient("linear", 'href="#t"', " "), plain },
      {
        gradient("linear", "",
          '<stop stop-color="red" stop-opacity="50%"/><stop offset="1" '
          .. 'stop-color="rgba(0,0,255,.5)"/>'),
        '<g opacity=".5">' .. plain .. "</g>" },
      { '<g stop-color="red">' .. gradient("linear", 'stop-color="inherit"',
        '<stop stop-color="inherit"/><stop offset="1" stop-color="blue"/>')
        .. "</g>", plain },
      { gradient("linear", 'spreadMethod="repeat" x2="2"'), gradient("linear", 'x2="2"') },
    }
  end)

  it("with one stop, or of no length, are one colour", function()
    same {
      { gradient("linear", "", '<stop stop-color="lime"/>'), LIME },
      { gradient("linear", 'x2="0"', '<stop/><stop offset="1" stop-color="lime"/>'), LIME },
      { gradient("radial", 'r="0"', '<stop/><stop offset="1" stop-color="lime"/>'), LIME },
    }
    empty { gradient("linear", "", " "), gradient("linear", 'gradientTransform="scale(0)"'),
      gradient("radial", 'r=".5" fr=".5"') }
  end)

  it("begin at the inner circle if it has the same centre", function()
    same {
      { gradient("radial", 'fr=".25"'),
        gradient("radial", "",
          '<stop offset=".5" stop-color="red"/><stop offset="1" stop-color="blue"/>') },
      { gradient("radial", 'fx=".5" fy=".5"'), gradient "radial" },
    }
  end)

  it("are replaced by the fallback if there is no box", function()
    local line = gradient "linear" .. '<path d="M0 50H80" stroke-width="20" stroke="%s"/>'
    same {
      { line:format "url(#g) lime", line:format "lime" },
      { line:format "url(#g)", gradient "linear" },
      { gradient "linear" .. '<text x="1e9" fill="url(#g)">A</text>', gradient "linear" },
    }
  end)

  it("report their parts that are not drawn", function()
    left_out {
      { gradient("radial", 'fr=".1" fx=".6"'), "radius of the focus of radialGradient" },
      { gradient("linear", 'x2="1e-6" spreadMethod="repeat"'), "spreadMethod, repeated too often" },
      {
        '<pattern id="p" width=".5" height=".5"><rect width="9" height="9" fill="url(#p)"/>'
        .. "</pattern>" .. filled "url(#p)", "pattern that is inside what it paints" },
    }
  end)
end)

local function cut(clip, content)
  return clip .. (content or '<rect width="80" height="60" clip-path="url(#c)" fill="lime"/>')
end
local function clip(content, attributes)
  return ('<clipPath id="c" %s>%s</clipPath>'):format(attributes or "", content)
end

describe("clip paths", function()
  it("may be written in several ways", function()
    local half = '<rect width="50" height="60" fill="lime"/>'
    same {
      { cut(clip '<rect width="50" height="99"/>'), half },
      { cut(clip '<path d="M0 0H50V99H0"/><circle r="9"/>'), half },
      {
        cut('<rect id="r" width="25" height="99" fill="none"/>'
        .. clip '<use href="#r"/><use href="#r" x="25"/>'),
        half },
      { cut(clip('<rect width="25" height="99"/>', 'transform="scale(2)"')), half },
      {
        cut(clip('<rect width="99" height="99"/>', 'clip-path="url(#d)"')
        .. '<clipPath id="d"><rect width="50" height="99"/></clipPath>'),
        half },
      {
        cut(clip('<g><rect width="9" height="9"/></g><rect width="50" height="99"/><use '
        .. 'href="#none"/><use/>')),
        half },
      {
        cut(clip('<rect width="99" height="99" display="none"/><rect width="99" height="99" '
        .. 'visibility="hidden"/><rect width="50" height="60"/>')),
        half },
      { cut(clip '<path d="M0 0H50V60H0ZM0 0H50V60H0Z" clip-rule="nonzero"/>'), half },
      { '<rect width="80" height="60" fill="lime" clip-path="none"/>',
        '<rect width="80" height="60" fill="lime"/>' },
      { '<g clip-path="url( \'#c\' )">' .. cut(clip '<rect width="50" height="99"/>') .. "</g>",
        half },
      {
        cut(clip '<rect width="50" height="99"/>',
          '<rect width="80" height="60" clip-path="url(#c )" fill="lime"/>'),
        half },
    }
  end)

  it("may be shapes of the element's box", function()
    local function shape(text)
      return ('<rect width="80" height="60" fill="lime" style="clip-path:%s"/>'):format(text)
    end
    same {
      { shape "inset(10)", '<rect x="10" y="10" width="60" height="40" fill="lime"/>' },
      { shape "inset(10px 20px)", '<rect x="20" y="10" width="40" height="40" fill="lime"/>' },
      { shape "inset(10 20 5)", '<rect x="20" y="10" width="40" height="45" fill="lime"/>' },
      { shape "inset(10 20 5 15)", '<rect x="15" y="10" width="45" height="45" fill="lime"/>' },
      { shape "inset(10% 25%)", '<rect x="20" y="6" width="40" height="48" fill="lime"/>' },
      { shape "polygon(0 0, 50% 0, 50% 100%, 0 100%)",
        '<rect width="40" height="60" fill="lime"/>' },
      { shape "polygon(nonzero, 0 0, 40 0, 40 60, 0 60)",
        '<rect width="40" height="60" fill="lime"/>' },
      { shape "circle(20)", '<circle cx="40" cy="30" r="20" fill="lime"/>' },
      { shape "circle(20 at 30 25)", '<circle cx="30" cy="25" r="20" fill="lime"/>' },
      { shape "ellipse(20 10 at 50% 50%)",
        '<ellipse cx="40" cy="30" rx="20" ry="10" fill="lime"/>' },
    }
    empty { shape "circle(0)", shape "inset(40)", shape "ellipse(0 5)" }
    for _, text in ipairs { "circle(x)", "circle(-1)", "circle(5 at 1)", "circle(5", "circle(5) x",
      "inset(x)", "inset(1 2 3 4 5)",
      "polygon(1)", "polygon(1 2,)", "polygon(evenodd 1 2)", "square(5)", "circle 5", "ellipse(1)",
      "ellipse(-1 1)" } do
      local art = read(shape(text))
      assert.is_true(bytes(art.object) == bytes(read(shape "none").object), text)
      assert.are.equal(1, #art.skipped, text)
    end
  end)

  it("hide everything if they are empty or have no size", function()
    empty {
      cut(clip ""), cut(clip('<rect width="9" height="9"/>', 'transform="scale(0)"')),
      { cut(clip('<rect width="9" height="9"/>', 'transform="x"')), note = 'transform "x"' },
      cut(clip('<rect width="1" height="1"/>', 'clipPathUnits="objectBoundingBox"'),
        '<path d="M0 9H9" stroke="red" clip-path="url(#c)"/>'),
    }
  end)

  it("that do not exist, or cut themselves, are reported", function()
    left_out {
      { cut "", "clip-path \"c\", which is not in the file" },
      { cut(clip('<rect width="9" height="9"/>', 'clip-path="url(#c)"')),
        "clipPath that clips itself" },
      { cut(clip '<rect width="9" height="9" clip-path="url(#c)"/>'),
        "clipPath that clips itself" },
    }
  end)
end)

local function masked(content, attributes, shown)
  return ('<mask id="m" %s>%s</mask>'):format(attributes or "", content)
    .. (shown or '<rect width="80" height="60" fill="lime" mask="url(#m)"/>')
end

describe("masks", function()
  it("may be written in several ways", function()
    local half = '<rect width="40" height="60" fill="lime"/>'
    same {
      { masked '<rect width="40" height="99" fill="white"/>', half },
      { masked('<rect width=".5" height="1" fill="white"/>',
        'maskContentUnits="objectBoundingBox"'),
        half },
      { masked('<rect width="40" height="99" fill="white"/>', "",
        '<rect width="80" height="60" fill="lime" style="-webkit-mask:url(#m)"/>'),
        half },
      { masked('<rect width="40" height="99"/>', 'mask-type="alpha"'), half },
      { masked('<rect width="40" height="99"/>', 'style="mask-type:alpha"'), half },
      { masked('<rect width="99" height="99" fill="white"/>', 'x="0" y="0" width=".5" height="1"'),
        half },
      { masked('<rect width="99" height="99" fill="white"/>',
        'maskUnits="userSpaceOnUse" x="0" y="0" width="40" height="60"'),
        half },
      { masked('<g color="white"><rect width="40" height="99" fill="currentColor"/><g/></g>'),
        half },
      {
        masked('<rect width="40" height="99" fill="white"/><rect width="80" height="99" '
        .. 'display="none"/><g visibility="hidden"><rect width="80" height="9"/></g>'),
        half },
      { masked '<title/><rect width="40" height="99" fill="white"/>', half },
      { masked('<rect width="40" height="99" fill="white"/>', "",
        '<g mask="url(#m)"><rect width="80" height="60" fill="lime"/></g>'),
        half },
      { masked '<g opacity=".5"><rect width="80" height="99" fill="white"/></g>',
        '<rect width="80" height="60" fill="lime" opacity=".5"/>' },
      {
        masked('<rect width="40" height="99" fill="white"/><rect x="40" width="40" height="99" '
        .. 'fill="white" opacity=".5"/>'),
        '<rect width="40" height="60" fill="lime"/><rect x="40" width="40" height="60" fill="lime" '
          .. 'opacity=".5"/>' },
    }
  end)

  it("hide everything if they are empty or have no size", function()
    empty {
      masked "", masked('<rect width="99" height="99" fill="white"/>', 'width="0"'),
      masked '<rect width="99" height="99" fill="black"/>',
      masked('<rect width="99" height="99" fill="white"/>', 'mask-type="alpha" height="0"'),
      masked('<rect width="9" height="9"/>', 'display="none"'),
      masked('<rect width="99" height="99" fill="white"/>', "",
        '<path d="M0 9H80" stroke="red" mask="url(#m)"/>'),
    }
  end)

  it("that do not exist or refer to themselves are reported", function()
    left_out {
      { masked('', "", "") .. filled "lime" :gsub("/>", ' mask="url(#n)"/>'),
        "mask that is not in the file" },
      { masked('<rect width="9" height="9" fill="white"/>', 'mask="url(#m)"'),
        "mask that masks itself" },
      { masked '<rect width="9" height="9" mask="url(#m)"/>', "mask that masks itself" },
    }
  end)

  it("are kept when parts are changed", function()
    local art = read(masked('<rect width="40" height="99" fill="white"/>', "",
      '<g id="all" mask="url(#m)"><rect id="one" width="80" height="60" fill="red"/></g>'))
    local changed = art:with { one = function(part) return part:translate(0, 20) end }
    assert.is_true(bytes(changed.object)
      == bytes(read '<rect y="20" width="40" height="46" fill="red"/>'.object))
    assert.is_true(bytes(changed:with({ one = function(part)
      return part:translate(0, -20)
    end }).object) == bytes(art.object))
  end)
end)

describe("lengths and transforms", function()
  it("may be written in several ways", function()
    for width, px in pairs { ["2em"] = 40, ["4ex"] = 40, ["2.5rem"] = 40, ["40vw"] = 40,
      ["40vh"] = 40, ["40vmin"] = 40, ["40vmax"] = 40,
      ["40%"] = 40, ["30pt"] = 40, ["2.5pc"] = 40, [".5in"] = 48, ["1.27cm"] = 48, ["12.7mm"] = 48,
      ["50.8Q"] = 48, ["40PX"] = 40, ["+4e1"] = 40 } do
      local art = read(('<rect font-size="20" width="%s" height="9"/>'):format(width))
      assert.is_true(bytes(art.object)
        == bytes(read(('<rect width="%d" height="9"/>'):format(px)).object), width)
    end
    for written, px in pairs { ["2rem"] = 32, ["1.5em"] = 60, ["20vw"] = 20, ["30vmax"] = 30 } do
      local art = read(('<g font-size="40"><rect width="9" height="9" style="offset-path:path(\''
        .. "M0 0H90\');offset-distance:%s\"/></g>"):format(written))
      local moved = ('<rect x="%d" width="9" height="9"/>'):format(px)
      assert.is_true(bytes(art.object) == bytes(read(moved).object), written)
      local text = '<g font-size="40"><text y="50" style="%s">ab</text></g>'
      for _, name in ipairs { "font-size:", "letter-spacing:" } do
        same { { text:format(name .. written), text:format(name .. px .. "px") } }
      end
    end
    local function moved(transform)
      return ('<rect width="20" height="10" transform="%s"/>'):format(transform)
    end
    same {
      { moved "translate(5)", '<rect x="5" width="20" height="10"/>' },
      { moved "translate( 5 , 6 )", '<rect x="5" y="6" width="20" height="10"/>' },
      { moved "matrix(2 0 0 3 4 5)", '<rect x="4" y="5" width="40" height="30"/>' },
      { moved "scale(2)", '<rect width="40" height="20"/>' },
      { moved "scale(2 3)", '<rect width="40" height="30"/>' },
      { moved "translate(5),translate(6)scale(2)", '<rect x="11" width="40" height="20"/>' },
      { moved "rotate(90 20 20)", '<rect x="30" width="10" height="20"/>' },
      { moved "skewX(45)", '<path d="M0 0H20L30 10H10Z"/>' },
      { moved "skewY(45)", '<path d="M0 0L20 20V30L0 10Z"/>' },
      { moved "none", moved "" }, { moved " ", moved "" },
      { '<rect width="20" height="10" style="transform:translate(5px,6px)rotate(0deg)"/>',
        moved "translate(5 6)" },
    }
    for _, text in ipairs { "x", "turn(5)", "translate 5", "translate(5", "translate()",
      "translate(1 2 3)", "scale(1 2 3)", "rotate(1 2)", "matrix(1 2 3)",
      "matrix(1 2 3 4 5 6 7)", "skewX(1 2)", "skewY()", "translate(5)x", "none x" } do
      assert.is_true(bytes(read(moved(text)).object) == bytes(read(moved "").object), text)
    end
    empty { moved "scale(0)", moved "matrix(1 2 2 4 0 0)" }
  end)

  it("have origins given by words, lengths and percentages", function()
    local function about(origin)
      return ('<rect width="20" height="10" transform="scale(.5)" transform-origin="%s"/>')
        :format(origin)
    end
    same {
      { about "100% 100%", '<rect x="50" y="50" width="10" height="5"/>' },
      { about "right bottom", about "100 100" }, { about "left top", about "0 0" },
      { about "top left", about "0 0" }, { about "bottom 20px", about "20px 100px" },
      { about "center", about "50 50" },
      { about "20", about "20 50%" }, { about "center top", about "50% 0" },
      { about "top", about "50% 0" },
      { about "x", about "center" },
    }
  end)

  it("that scale too far are refused", function()
    refused {
      { '<rect width="1" height="1" transform="1e13"/>', 'transform is "1e13"' },
      { '<g transform="scale(1e9)"><rect width="1" height="1" transform="scale(1e9)"/></g>',
        "the transforms so far go beyond 1e12" },
      { '<rect width="1e11%" height="1" x="9e11em"/>', "is \"" },
      { '<path d="M0 0H9" stroke="red" transform="-inf"/>', 'transform is "-inf"' },
      { '<polygon points="1 1 inf 2 3 3"/>', 'points is "' },
    }
  end)
end)

describe("shapes", function()
  it("may be written in several ways", function()
    same {
      { '<polyline points="0,0 50,0 50,60 0,60" fill="lime"/>', LIME },
       { '<rect width="50" height="60" rx="-1" ry="auto" fill="lime"/>', LIME },
      { '<rect width="50" height="60" rx="10" fill="lime"/>',
        '<rect width="50" height="60" ry="10" fill="lime"/>' },
      { '<rect width="50" height="60" rx="99" ry="99" fill="lime"/>',
        '<ellipse cx="25" cy="30" rx="25" ry="30" fill="lime"/>' },
      { '<rect width="50" height="60" rx="9" ry="0" fill="lime"/>', LIME },
      { '<ellipse cx="20" cy="20" rx="9"/>', '<circle cx="20" cy="20" r="9"/>' },
      { '<ellipse cx="20" cy="20" rx="auto" ry="9"/>', '<circle cx="20" cy="20" r="9"/>' },
      { '<line x2="40" y1="9" y2="9" stroke="red"/>', '<path d="M0 9H40" stroke="red"/>' },
    }
    empty { '<rect width="9"/>', '<rect width="-9" height="9"/>', "<circle/>", '<circle r="-1"/>',
      '<ellipse rx="0" ry="9"/>', "<polygon/>",
      '<polygon points=""/>', "<path/>", '<path d=""/>', '<path d="none"/>', '<line x2="9"/>' }
  end)

  it("are shown by use, symbols, switches and drawings in drawings", function()
    same {
      { '<defs>' .. LIME:gsub("<rect", '<rect id="r"') .. '</defs><use href="#r"/>', LIME },
      { '<symbol id="s">' .. LIME .. '</symbol><use href="#s" width="100" height="100"/>', LIME },
      {
        '<symbol id="s" viewBox="0 0 10 10" refX="left" refY="top"><rect width="5" height="6" '
        .. 'fill="lime"/></symbol><use href="#s"/>',
        LIME },
      { '<symbol id="s" overflow="auto" width="9" height="9">' .. LIME
        .. '</symbol><use href="#s" width="100%" height="100%"/>',
        LIME },
      { '<svg id="s" width="10" height="10" viewBox="0 0 100 100">' .. LIME .. '</svg>',
        LIME:gsub("50", "5"):gsub("60", "6") },
      { '<svg width="9" height="9" overflow="visible">' .. LIME .. "</svg>", LIME },
      { '<svg viewBox="0 0 0 9">' .. LIME .. "</svg>", LIME, note = 'viewBox "0 0 0 9"' },
      { '<svg viewBox="0 0 x 9">' .. LIME .. "</svg>", LIME, note = 'viewBox "0 0 x 9"' },
      { '<svg viewBox="0 0 9">' .. LIME .. "</svg>", LIME, note = 'viewBox "0 0 9"' },
      {
        '<svg viewBox="0 0 50 50" preserveAspectRatio="none" width="100" height="50"><rect '
        .. 'width="25" height="60" fill="lime"/></svg>',
        '<rect width="50" height="50" fill="lime"/>' },
      { '<switch>' .. LIME .. "</switch>", LIME },
      { '<switch><rect width="9" height="9" requiredExtensions="x"/>' .. LIME .. "</switch>",
        LIME },
      { '<switch><rect width="9" height="9" systemLanguage=""/>' .. LIME .. "</switch>", LIME },
      {
        '<switch><rect width="50" height="60" fill="lime" systemLanguage="de, en-GB"/><rect '
        .. 'width="9" height="9"/></switch>',
        LIME },
      {
        '<switch><rect width="50" height="60" fill="lime" requiredExtensions=" " '
        .. 'systemLanguage="en"/></switch>',
        LIME },
      { '<switch><rect width="9" height="9" systemLanguage="english,enx"/>' .. LIME .. "</switch>",
        LIME },
      { '<a href="x">' .. LIME .. "</a>", LIME }, { "<title>A</title><metadata/>" .. LIME, LIME },
      { "<use/>" .. LIME, LIME },
    }
    empty { '<svg width="0" height="9">' .. LIME .. "</svg>",
      '<symbol id="s">' .. LIME .. "</symbol>", "<use/>", "<switch/>",
      '<g display="none">' .. LIME .. "</g>" }
    left_out {
      { '<use href="#none"/>', "use of an element that is not in the file" },
      { "<blink/>", "blink" },
      { '<polygon points="0 0 50 0 50 60 7"/>', "polygon from a fault in its data on" },
      { '<path d="x"/>', "path from a fault in its data on" },
      { '<polygon points="x"/>', "polygon from a fault in its data on" },
      { '<polyline points="0 0 50 0 50 60 x 9 9"/>', "polyline from a fault in its data on" },
    }
  end)
end)

describe("strokes", function()
  local function line(attributes)
    return '<path d="M10 10H80L20 60" fill="none" stroke="red" stroke-width="8" ' .. attributes
      .. "/>"
  end
  it("may be written in several ways", function()
    same {
      { line 'stroke-linecap="butt"', line "" }, { line 'stroke-linecap="inherit"', line "" },
      { line 'stroke-linejoin="miter"', line "" },
      { line 'stroke-linejoin="miter-clip"', line "" }, { line 'stroke-linejoin="arcs"', line "" },
      { line 'stroke-linejoin="x"', line "", note = 'stroke-linejoin "x"' },
      { '<g stroke-linejoin="bevel">' .. line 'stroke-linejoin="miter"' .. "</g>", line "" },
      { line 'stroke-miterlimit="1"', line 'stroke-linejoin="bevel"' },
      { line 'stroke-miterlimit=".5"', line "" },
      { line 'stroke-miterlimit="2em"', line "", note = 'stroke-miterlimit "2em"' },
      { line 'stroke-miterlimit="x"', line "", note = 'stroke-miterlimit "x"' },
      { line 'stroke-dasharray="none"', line "" }, { line 'stroke-dasharray="0 0"', line "" },
      { line 'stroke-dasharray="-1 2"', line "" },
      { line 'stroke-dasharray="x"', line "", note = 'stroke-dasharray "x"' },
      { line 'stroke-dasharray="9"', line 'stroke-dasharray="9,9"' },
      { '<g stroke-dasharray="9">' .. line 'stroke-dasharray="inherit"' .. "</g>",
        line 'stroke-dasharray="9"' },
      { line 'stroke-dasharray="9" stroke-dashoffset="x"', line 'stroke-dasharray="9"',
        note = 'stroke-dashoffset "x"' },
      { line 'stroke-opacity="inherit" vector-effect="none"', line "" },
      { line 'paint-order="normal"', line "" },
      { line 'paint-order="stroke stroke x"', line "", note = 'paint-order "stroke stroke x"' },
      { line 'marker-end="none" marker-mid="x"', line "", note = 'marker-mid "x"' },
      { '<g paint-order="stroke">' .. line 'paint-order="inherit"' .. "</g>", line "" },
    }
    empty { line 'style="stroke-width:0"', line 'stroke-opacity="0"', line 'style="stroke:none"' }
  end)

  it("may have markers at their corners", function()
    local function marked(marker, path)
      return marker .. '<path d="' .. (path or "M10 10H80V60")
        .. '" fill="none" marker-end="url(#k)"/>'
    end
    local box = '<rect x="77" y="57" width="6" height="6"/>'
    same {
      {
        marked('<marker id="k" overflow="visible" markerUnits="userSpaceOnUse"><rect x="-3" y="-3" '
        .. 'width="6" height="6"/></marker>'),
        box },
      {
        marked('<marker id="k" markerWidth="6" markerHeight="6" refX="3" refY="3"><rect width="6" '
        .. 'height="6"/></marker>'),
        box },
      {
        marked('<marker id="k" markerWidth="6" markerHeight="6" refX="center" refY="center" '
        .. 'viewBox="0 0 6 6" orient="0"><rect width="6" height="6"/></marker>'),
        box },
      {
        marked('<marker id="k" markerWidth="6" markerHeight="6" refX="3" refY="3" orient="x"><rect '
        .. 'width="6" height="6"/></marker>'),
        box, note = 'orient "x"' },
      {
        marked('<marker id="k" overflow="visible" orient="auto"><rect x="-3" y="-3" width="6" '
        .. 'height="6"/></marker>', "M10 10H80V60V60"),
        box },
      { marked '<marker id="k"/>' .. box, box }, { marked '<g id="k"/>' .. box, box },
    }
    empty { marked '<marker id="k" markerWidth="0"><rect width="6" height="6"/></marker>',
      { marked '<marker id="k" viewBox="0 0 0 6"><rect width="6" height="6"/></marker>',
        note = 'viewBox "0 0 0 6"' } }
  end)
end)

describe("texts", function()
  local function text(content, attributes)
    return ('<text x="10" y="50" font-size="20" %s>%s</text>'):format(attributes or "", content)
  end
  it("may be written in several ways", function()
    same {
      { text " A  B ", text "A B" }, { text("A B", 'xml:space="default"'), text "A B" },
      { text "A<tspan> </tspan> B", text "A B" },
      { text "<tspan>A B</tspan>", text "A B" }, { text "<a>A B</a>", text "A B" },
      { text "<title>X</title>A B", text "A B" },
      { text("A B", 'text-anchor="start"'), text "A B" },
      { '<g text-anchor="end">' .. text("A B", 'text-anchor="inherit"') .. "</g>",
        text("A B", 'text-anchor="end"') },
      { text("A B", 'letter-spacing="normal" word-spacing="x"'), text "A B",
        note = 'word-spacing "x"' },
      { text("A B", 'letter-spacing="0"'), text "A B" },
      { text("A B", 'word-spacing="inherit" direction="ltr"'), text "A B" },
      { text("A B", 'direction="inherit"'), text "A B" },
      { text("A B", 'text-decoration="none" writing-mode="horizontal-tb" baseline-shift="0"'),
        text "A B" },
      { text("A B", 'font-weight="normal" font-style="normal"'), text "A B" },
      { text("A B", 'font-weight="400"'), text "A B" },
      { text("A B", "font-family=\"'Some Face', Other , x\" font-weight=\"x\" font-style=\"x\""),
        text "A B", note = 'font-weight "x", font-style "x"' },
      { text "A<tspan display=\"none\">X</tspan> B", text "A B" },
      { text "A B<tspan> </tspan>", text "A B" },
      { text("AB", 'textLength="-5"'), text "AB" }, { text("A", 'textLength="90"'), text "A" },
      { text("A", 'dx="5" dy="-2"'), '<text x="15" y="48" font-size="20">A</text>' },
      { text("A", 'rotate="0 45"'), text "A" },
      { text "A&#160;B", text "A B" },
        { text("A  B", 'xml:space="preserve"'), text "A&#160;&#160;B" },
      {
        '<path id="w" d="M10 50H99"/><text font-size="20"><textPath href="#w">A '
        .. 'B</textPath></text>',
        '<path d="M10 50H99"/>' .. text "A B" },
      {
        '<path id="w" d="M10 50H99"/><text font-size="20"><textPath href="#w" side="left" '
        .. 'startOffset="0%">A B </textPath></text>',
        text "A B" },
    }
    empty { text("A", 'font-size="0"'):gsub('font%-size="20" ', ""), text "", text " ",
      text "<tspan/>", text("A", 'visibility="hidden"'), text("A", 'display="none"') }
  end)

  it("use the faces selected by weight, slant and families", function()
    local fonts = { ["Face"] = FONT }
    for _, case in ipairs {
      { 'font-family="face"' }, { 'font-family="\'FACE\'"' }, { "font-family='none, \"Face\" ,x'" },
      { 'font-family=" Face "' },
      { 'font-family="Face" font-weight="bold"',
        "bold of text in Face, for which that font is not given",
        true },
      { 'font-family="Face" font-style="oblique 10deg"',
        "italic of text in Face, for which that font is not given",
        true },
      { 'font-family="Face" font-weight="600" font-style="italic"',
        "bold italic of text in Face, for which that font is not given",
        true },
      { 'font-family="Other"', "text in Other, for which no font is given" },
      { 'font-family=",,"', "text in ,,, for which no font is given" },
      { "", "text in no family, for which no font is given" },
      { 'font-family="inherit"', "text in no family, for which no font is given" },
    } do
      local art = assert(svg.read(write(text("A", case[1])), { fonts = fonts }))
      assert.are.equal(case[2], art.skipped[1] and art.skipped[1].what, case[1])
      assert.are.equal(case[2] ~= nil and not case[3], bytes(art.object) == nothing, case[1])
    end
  end)

  it("report their parts that are not drawn", function()
    left_out {
      { text("A", 'text-decoration="underline"'), 'text-decoration "underline"' },
      { '<g text-decoration="underline">' .. text "A" .. "</g>", 'text-decoration "underline"' },
      { text("A", 'writing-mode="tb"'), 'writing-mode "tb"' },
      { text "<blink>A</blink>", "blink" },
      { text "<g>A</g>", "g in text" },
      { text '<textPath href="#none">A</textPath>', "textPath without a path" },
      {
        '<path id="w" d="M10 50H99"/><text font-size="20"><textPath href="#w" '
        .. 'side="right">A</textPath></text>',
        "side of textPath" },
    }
    refused { { text("A", 'dx="nan"'), 'dx is "nan"' },
      { '<text x="1e13">A</text>', 'x is "1e13"' } }
  end)
end)

-- A picture of 2 x 2 pixels, red and blue.
local PICTURE =
  "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAMAAABFaP0WAAAABlBMVEX/"
  .. "AAAAAP9sof2OAAAADElEQVR42mNgYARCAAAMAAMVnhj8"
  .. "AAAAAElFTkSuQmCC"
local DRAWN = "data:image/svg+xml,"
  .. "%3Csvg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 2 1'%3E%3Crect width='1' height='1' "
  .. "fill='lime'/%3E%3C/svg%3E"

describe("images", function()
  local function image(href, attributes)
    return ('<image %s href="%s"/>'):format(attributes or "", href)
  end
  local half = '<rect width="20" height="20" fill="lime"/>'
  it("may be written in several ways", function()
    same {
      { image(DRAWN, 'width="40" height="20"'), half }, { image(DRAWN, 'width="40"'), half },
      { image(DRAWN, 'height="20"'), half },
      { image(DRAWN, 'width="40" height="20" preserveAspectRatio="none"'), half },
      { image(DRAWN, 'width="40" height="40" preserveAspectRatio="xMinYMin"'), half },
      { image(DRAWN, 'width="20" height="20" preserveAspectRatio="xMinYMin slice"'), half },
      { image(DRAWN:lower():gsub("viewbox", "viewBox"), 'width="40" height="20"'), half },
      { image(DRAWN:gsub(",", ",%%EF%%BB%%BF%%20%%0a", 1), 'width="40" height="20"'), half },
      { image("\n " .. DRAWN, 'width="40" height="20"'), half },
      { image(DRAWN:gsub(",", " ,", 1), 'width="40" height="20"'), half },
      { '<defs><g id="g">' .. image(DRAWN, 'width="40" height="20"')
        .. '</g></defs><use href="#g"/>', half },
      { image(PICTURE, 'width="40"'), image(PICTURE, 'width="40" height="40"') },
      { image(PICTURE:gsub("VR42", "VR4\n 2"), 'width="40"'), image(PICTURE, 'width="40"') },
      { image(PICTURE, 'transform="scale(20)"'), image(PICTURE, 'width="40"') },
      { image(PICTURE, 'width="40" opacity=".5"'),
        '<g opacity=".5">' .. image(PICTURE, 'width="40"') .. "</g>" },
    }
  end)

  it("draw nothing if they are empty, or have no size", function()
    empty { "<image/>", image "", image " ", image(DRAWN, 'width="0"'),
      image(DRAWN, 'width="9" height="0"'), image(PICTURE, 'transform="scale(0)"'),
      image(PICTURE, 'visibility="hidden"'), image(PICTURE, 'display="none"') }
  end)

  it("report their parts that are not drawn", function()
    for _, href in ipairs { "data:", "data:image/png;base64,", "data:image/png;base64,####",
      "data:,%", "data:,%4", "data:,%zz", "data:image/svg+xml,%3Csvg",
      "../a.png", "/a.png", "http://a/b.png", "none.png", "a/../b.png", ("a"):rep(5000), "a\\b.png",
      ".",
      "a//b.png" } do
      local art = read(image(href))
      assert.are.equal(1, #art.skipped, href)
      assert.is_true(bytes(art.object) == nothing, href)
    end
    local inner = DRAWN:gsub("%%3Crect", "%%3Cblink/%%3E%%3Crect", 1)
    assert.matches("blink", read(image(inner, 'width="9"')).skipped[1].what)
  end)
end)

describe("boxes", function()
  it("of use and of groups are those of their contents", function()
    local shares =
      '<clipPath id="c" clipPathUnits="objectBoundingBox"><rect width=".5" height="1"/></clipPath>'
    local whole = '<rect id="r" x="10" y="10" width="40" height="20" fill="lime"/>'
    local half = '<rect x="10" y="10" width="20" height="20" fill="lime"/>'
    same {
      { shares .. "<defs>" .. whole .. '</defs><g clip-path="url(#c)"><use href="#r"/></g>', half },
      { shares .. "<defs>" .. whole
        .. '</defs><g clip-path="url(#c)"><use href="#none" display="none"/><use/><use '
        .. 'href="#r"/></g>',
        half },
      {
        shares
        .. '<g clip-path="url(#c)"><g transform="translate(5 5)"><rect x="5" y="5" width="40" '
        .. 'height="20" fill="lime"/></g></g>',
        half },
      { shares .. '<g clip-path="url(#c)">' .. whole
        .. '<rect width="90" height="90" display="none"/></g>',
        half },
      { shares .. '<g clip-path="url(#c)">' .. whole .. '<path/><text/><title>A</title></g>',
        half },
      {
        shares
        .. '<g clip-path="url(#c)"><svg x="10" y="10" width="40" height="20"><rect width="40" '
        .. 'height="20" fill="lime"/></svg></g>',
        half },
      { shares .. '<g clip-path="url(#c)"><switch><g>' .. whole .. "</g></switch></g>", half },
      {
        shares
        .. '<g clip-path="url(#c)"><switch><g systemLanguage="xx"><rect width="90" '
        .. 'height="90"/></g>' .. whole
        .. '<rect width="90" height="90"/></switch><rect width="90" height="90" '
        .. 'systemLanguage="xx"/></g>',
        half },
      {
        shares
        .. '<svg clip-path="url(#c)" x="10" y="10" width="40" height="20" viewBox="0 0 4 2"><rect '
        .. 'width="4" height="2" fill="lime"/></svg>',
        half },
      {
        shares
        .. '<g clip-path="url(#c)"><svg width="0" height="90"><rect width="90" height="90"/></svg>'
        .. whole .. "</g>",
        half },
      { shares
        .. '<symbol id="s" viewBox="0 0 4 2"><rect width="4" height="2" fill="lime"/></symbol>'
        .. '<g clip-path="url(#c)"><symbol><rect width="90" height="90"/></symbol><use href="#s" '
        .. 'x="10" y="10" width="40" height="20"/></g>',
        half },
      {
        shares
        .. '<symbol id="s" viewBox="0 0 4 2" clip-path="url(#c)"><rect width="4" height="2" '
        .. 'fill="lime"/></symbol>'
        .. '<use href="#s" x="10" y="10" width="40" height="20"/>', half },
      {
        '<svg x="10" y="10" width="40" height="20" viewBox="0 0 4 2"><rect width="2" height="2" '
        .. 'fill="lime"/></svg>',
        half },
    }
  end)

  it("leave out what shows itself", function()
    local shares =
      '<clipPath id="c" clipPathUnits="objectBoundingBox"><rect width=".5" height="1"/></clipPath>'
    same { { shares .. '<g id="g" clip-path="url(#c)"><use href="#g"/>'
      .. '<rect width="80" height="60" fill="lime"/></g>',
      '<rect width="40" height="60" fill="lime"/>',
        note = "use that is inside the element that it shows" } }
  end)
end)

describe("gradients, too,", function()
  it("have a focus that stays inside, inner circles that repeat, and units of their own", function()
    local inner = '<stop offset=".2" stop-color="red"/><stop offset=".8" stop-color="blue"/>'
    local held = '<stop stop-color="red"/>' .. inner .. '<stop offset="1" stop-color="blue"/>'
    same {
      { gradient("radial", 'fx="5" fy=".5"'), gradient("radial", 'fx="9" fy=".5"') },
      { gradient("linear", 'gradientTransform="rotate(90)" transform-origin=".5 .5"'),
        gradient("linear", 'x1="0" y1="0" x2="0" y2="1"') },
      { [[<linearGradient id="g" gradientUnits="userSpaceOnUse" x1="10" y1="0" x2="90" y2="0"
          gradientTransform="translate(0 200)"><stop stop-color="red"/><stop offset="1"
          stop-color="blue"/></linearGradient>
          <path d="M10 30H90" stroke-width="9" stroke="url(#g)"/>]],
        [[<linearGradient id="g" gradientUnits="userSpaceOnUse" x1="10" y1="0" x2="90" y2="0">
          <stop stop-color="red"/><stop offset="1" stop-color="blue"/></linearGradient>
          <path d="M10 30H90" stroke-width="9" stroke="url(#g)"/>]] },
      { gradient("linear", 'gradientTransform="x"'), gradient "linear",
        note = 'gradientTransform "x"' },
      { gradient("radial", 'fr=".2" r=".4" spreadMethod="pad"'),
        gradient("radial", 'r=".4"',
          '<stop offset=".5" stop-color="red"/><stop offset="1" stop-color="blue"/>') },
      { gradient("linear", 'spreadMethod="x"'), gradient "linear", note = 'spreadMethod "x"' },
      { gradient("linear", 'x2=".5" spreadMethod="repeat"', inner),
        gradient("linear", 'x2=".5" spreadMethod="repeat"', held) },
      { gradient("radial", 'r=".2" spreadMethod="repeat"', inner),
        gradient("radial", 'r=".2" spreadMethod="repeat"', held) },
      { gradient("linear", 'x2=".5" spreadMethod="reflect"', inner),
        gradient("linear", 'x2=".5" spreadMethod="reflect"', held) },
      { gradient("linear", 'href="#none"'), gradient "linear" },
      { gradient("linear", 'href="#g"'), gradient "linear" },
      { LIME .. '<g id="t"/>' .. gradient("linear", 'href="#t"', " "), LIME },
    }
    local repeated = read(gradient("radial", 'fr=".1" r=".2" spreadMethod="repeat"'))
    assert.are.same({}, repeated.skipped)
    assert.are_not.equal(bytes(read(gradient("radial", 'fr=".1" r=".2"')).object),
      bytes(repeated.object))
  end)
end)

describe("documents", function()
  it("may contain elements of other kinds, anywhere", function()
    same {
      { '<x:y xmlns:x="urn:x"><rect width="9" height="9"/><x:y/></x:y>' .. LIME, LIME },
      { '<metadata><x:y xmlns:x="urn:x">text</x:y></metadata>' .. LIME, LIME },
      { '<style type="">rect{fill:lime}</style><rect width="50" height="60"/>', LIME },
      { '<style type="text/css">rect{fill:lime}</style><rect width="50" height="60"/>', LIME },
      { '<style type="text/other">rect{fill:red}</style>' .. LIME, LIME },
      { '<rect id="" width="50" height="60" fill="lime"/>', LIME },
      {
        '<rect xml:space="preserve" xmlns:q="urn:q" q:fill="red" width="50" height="60" '
        .. 'fill="lime"/>',
        LIME },
      {
        '<defs><rect id="r" width="50" height="60" fill="lime"/><rect id="r" width="9" '
        .. 'height="9"/></defs><use href="#r"/>',
        LIME },
      {
        '<defs><rect id="r" width="50" height="60" fill="lime"/></defs><use href="#r" '
        .. 'xlink:href="#none"/>',
        LIME },
    }
  end)
end)

describe("texts, too,", function()
  local function text(content, attributes)
    return ('<text x="10" y="50" font-size="20" %s>%s</text>'):format(attributes or "", content)
  end
  it("are spread, squeezed and placed letter by letter", function()
    same {
      { text("A<tspan textLength=\"40\">BC</tspan>D", ""),
        text 'A<tspan textLength="40" lengthAdjust="spacing">BC</tspan>D' },
      { text("AB", 'textLength="60" lengthAdjust="spacing"'), text("AB", 'textLength="60"') },
      { text("AB", 'letter-spacing="3"'), text("AB", 'letter-spacing="3px"') },
      { text("A B", 'word-spacing="1em"'), text("A B", 'word-spacing="20"') },
      { text "A<tspan>B<tspan>C</tspan></tspan>", text "ABC" },
      { text "A<tspan x=\"40\" y=\"60\">B</tspan>",
        text "A" .. '<text x="40" y="60" font-size="20">B</text>' },
      { '<text x="10 40" y="50 60" font-size="20">AB</text>',
        text "A" .. '<text x="40" y="60" font-size="20">B</text>' },
      { text("AB ", 'textLength="60"'), text("AB", 'textLength="60"') },
      { text 'AB<tspan textLength="9"> </tspan>', text "AB" },
      { text("A\226\128\168B"), text "A B" }, { text("A\194\133B"), text "A B" },
      { text("A\127B"), text "A B" },
    }
    assert.are_not.equal(bytes(read(text "AB").object),
      bytes(read(text("AB", 'textLength="60" lengthAdjust="spacingAndGlyphs"')).object))
  end)

  it("end at the end of the line that they run along", function()
    local path = '<path id="w" d="M10 50H60" fill="none"/>'
    same {
      { path .. '<text font-size="20"><textPath href="#w">A</textPath>B</text>',
        path .. '<text font-size="20"><textPath href="#w">A</textPath><tspan>B</tspan></text>' },
      { path .. '<text font-size="20"><textPath href="#w" startOffset="50%">A</textPath></text>',
        path .. '<text font-size="20"><textPath href="#w" startOffset="25">A</textPath></text>' },
      { path .. '<text font-size="20"><textPath href="#w"> A </textPath> </text>',
        path .. '<text font-size="20"><textPath href="#w">A</textPath></text>' },
    }
    empty {
      path .. '<text font-size="20"><textPath href="#w" startOffset="900">A</textPath></text>',
      path .. '<text font-size="20"><textPath href="#w" startOffset="-900">A</textPath></text>' }
  end)
end)
