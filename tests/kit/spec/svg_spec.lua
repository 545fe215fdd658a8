-- SVG drawings: rendering, named parts, changed parts, and what is refused and where. One file, a
-- case for each element and attribute, because they are all compared in one way.
local celspan = require "celspan"
local svg = require "celspan.svg"
local present = require "tests.support.present"
local raised = require "tests.support.raised"
local workbench = require "tests.support.workbench"

local HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
  .. 'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="100" height="100"'
local bench, count = workbench.new(), 0

--- A temporary file with this text.
local function write(text)
  count = count + 1
  return bench:write(("drawing-%d.svg"):format(count), text)
end

--- A drawing 100 by 100 with this in it.
local function drawing(content, attributes)
  return write(HEAD .. (attributes or "") .. ">" .. content .. "</svg>")
end

local function read(content, attributes) return assert(svg.read(drawing(content, attributes))) end

--- The colour at a point, as eight-bit codes with alpha: "00ff00 255".
local function at(object, x, y)
  local rostrum = celspan.rostrum { celspan.cel { object } }
  local r, g, b, a = celspan.probe(rostrum, x, y, { film = { 100, 100 } })
  local function code(c)
    c = a > 0 and c / a or 0
    c = c <= 0.0031308 and 12.92 * c or 1.055 * c ^ (1 / 2.4) - 0.055
    return math.floor(255 * math.min(1, math.max(0, c)) + 0.5)
  end
  return ("%02x%02x%02x %d"):format(code(r), code(g), code(b), math.floor(255 * a + 0.5))
end

local function refusal(text)
  local path = write(text)
  local art, message = svg.read(path)
  assert.is_nil(art)
  local place, sentence = message:match("^" .. path:gsub("%p", "%%%0") .. ":(%d*):? ?(.*)$")
  return tonumber(place), sentence or message
end

local function in_svg(content) return HEAD .. ">\n" .. content .. "</svg>" end

local it = present.type() and it or pending

teardown(function() bench:remove() end)

describe("a drawing", function()
  it("is one object of the file's size", function()
    local art = read '<rect width="50" height="100" fill="#0f0"/>'
    assert.are.same({ 100, 100 }, { art.width, art.height })
    assert.are.equal("00ff00 255", at(art.object, 25, 50))
    assert.are.equal("000000 0", at(art.object, 75, 50))
    assert.are.same({}, art.skipped)
  end)

  it("can have basic shapes, exact circles and paths", function()
    local art = read [[<circle cx="20" cy="20" r="10" fill="red"/>
      <ellipse cx="50" cy="20" rx="10" ry="5" fill="rgb(0,0,255)"/>
      <polygon points="70,10 90,10 80,30" fill="hsl(120, 100%, 50%)"/>
      <rect x="10" y="40" width="20" height="20" rx="10"/>
      <path d="M40 40 h20 v20 a10 10 0 0 1 -20 0 z" fill="white" fill-rule="evenodd"/>]]
    assert.are.equal("ff0000 255", at(art.object, 27, 27))
    assert.are.equal("000000 0", at(art.object, 27.1, 27.1))
    assert.are.equal("0000ff 255", at(art.object, 59, 21))
    assert.are.equal("00ff00 255", at(art.object, 80, 20))
    assert.are.equal("000000 0", at(art.object, 11, 41))
    assert.are.equal("000000 255", at(art.object, 20, 41))
    assert.are.equal("ffffff 255", at(art.object, 50, 69.9))
  end)

  it("is fitted by its view box", function()
    local art = read('<rect width="1" height="1"/>', ' viewBox="0 0 2 1"')
    assert.are.equal("000000 255", at(art.object, 49, 74))
    assert.are.equal("000000 0", at(art.object, 49, 76))
    art = read('<rect width="1" height="1"/>',
      ' viewBox="0 0 2 1" preserveAspectRatio="xMinYMin slice"')
    assert.are.equal("000000 255", at(art.object, 99, 99))
  end)

  it("has groups whose opacity applies to the group as a whole", function()
    local art = read [[<g opacity="0.5"><rect width="60" height="60" fill="red"/>
      <rect x="40" width="60" height="60" fill="blue"/></g>]]
    assert.are.equal("ff0000 128", at(art.object, 20, 20))
    assert.are.equal("0000ff 128", at(art.object, 50, 20))
  end)

  it("shows elements that use refers to, with the style inherited there", function()
    local art = read [[<defs><rect id="r" width="10" height="10"/>
      <symbol id="s" viewBox="0 0 1 1"><rect width="2" height="1" fill="lime"/></symbol></defs>
      <use xlink:href="#r" x="20" y="20" fill="red"/>
      <use href="#s" x="50" y="50" width="10" height="10"/>]]
    assert.are.equal("ff0000 255", at(art.object, 25, 25))
    assert.are.equal("00ff00 255", at(art.object, 55, 55))
    assert.are.equal("000000 0", at(art.object, 65, 55))
    assert.are.equal("000000 0", at(art.object, 5, 5))
  end)

  it("leaves out a use that is inside the element that it shows, and nothing else", function()
    local green = '<rect width="40" height="40" fill="#0f0"/>'
    for _, circle in ipairs { '<g id="a"><use xlink:href="#a"/></g>', '<use id="a" href="#a"/>',
      '<g id="a"><use href="#b"/></g><g id="b"><use href="#a"/></g>' } do
      local art = read(green .. circle)
      assert.are.equal("00ff00 255", at(art.object, 20, 20), circle)
      assert.are.equal("use that is inside the element that it shows", art.skipped[1].what, circle)
    end
  end)

  it("can have transforms of every kind, around any origin", function()
    local art = read [[<g transform="translate(50 50) rotate(90)">
      <rect width="40" height="10" transform="scale(0.5, 1) skewX(0)"/></g>
      <rect x="10" y="10" width="10" height="10" transform="scale(2)" transform-origin="10 10"/>]]
    assert.are.equal("000000 255", at(art.object, 45, 65))
    assert.are.equal("000000 0", at(art.object, 45, 75))
    assert.are.equal("000000 255", at(art.object, 29, 29))
  end)

  it("leaves out elements that are not displayed, hidden, or conditional", function()
    local art = read [[<rect width="10" height="10" display="none"/>
      <g visibility="hidden"><rect x="20" width="10" height="10"/>
      <rect x="40" width="10" height="10" visibility="visible"/></g>
      <switch><rect x="60" width="10" height="10" systemLanguage="de" fill="red"/>
      <rect x="60" width="10" height="10" fill="lime"/></switch>]]
    assert.are.equal("000000 0", at(art.object, 5, 5))
    assert.are.equal("000000 0", at(art.object, 25, 5))
    assert.are.equal("000000 255", at(art.object, 45, 5))
    assert.are.equal("00ff00 255", at(art.object, 65, 5))
    assert.are.same({}, art.skipped)
  end)
end)

describe("entities", function()
  it("stand for values and for elements", function()
    local art = assert(svg.read(write([[<!DOCTYPE svg [<!ENTITY red "#f00">
      <!ENTITY box "<rect width='9' height='9' fill='&#35;00f'/>"><!ENTITY ns
        "http://www.w3.org/2000/svg">]>
      <svg xmlns="&ns;" width="100" height="100"><rect width="50" height="50" fill="&red;"/>
      <g transform="translate(60 60)">&box;</g></svg>]])))
    assert.are.equal("ff0000 255", at(art.object, 25, 25))
    assert.are.equal("0000ff 255", at(art.object, 65, 65))
  end)
end)

describe("styles", function()
  it("come from attributes, rules and style attributes, in that order", function()
    local art = read [[<style>
      rect { fill: red } .a { fill: lime } #one { fill: blue }
      g > .b, svg .never .c { fill: #abc } g .c { fill: #112233 }
      .i { fill: lime !important } </style>
      <rect width="10" height="10" fill="black"/>
      <rect x="20" width="10" height="10" class="x a"/>
      <rect x="40" width="10" height="10" class="a" id="one"/>
      <g><rect x="60" width="10" height="10" class="b"/><g><rect x="80" width="10" height="10"
        class="c"/></g></g>
      <rect y="20" width="10" height="10" class="b" style="fill:white"/>
      <rect y="20" x="20" width="10" height="10" class="i" style="fill:white"/>
      <g color="#00f"><rect y="20" x="40" width="10" height="10" style="fill:currentColor"/></g>]]
    local seen = {}
    for i, place in ipairs { { 5, 5 }, { 25, 5 }, { 45, 5 }, { 65, 5 }, { 85, 5 }, { 5, 25 },
                             { 25, 25 }, { 45, 25 } } do
      seen[i] = at(art.object, place[1], place[2]):sub(1, 6)
    end
    assert.are.same({ "ff0000", "00ff00", "0000ff", "aabbcc", "112233", "ffffff", "00ff00",
      "0000ff" },
      seen)
  end)

  it("may select by attributes", function()
    local art = read [[<style>[x]{fill:red} rect[y="50"]{fill:lime} [class~='b'][id^=q]{fill:blue}
      [id$="nd"]{fill:yellow}</style>
      <rect x="0" width="50" height="50"/><rect y="50" width="50" height="50"/>
      <rect x="50" width="50" height="50" class="a b" id="q1"/>
      <rect x="50" y="51" width="50" height="49" id="end"/>]]
    assert.are.equal("ff0000 255", at(art.object, 25, 25))
    assert.are.equal("00ff00 255", at(art.object, 25, 75))
    assert.are.equal("0000ff 255", at(art.object, 75, 25))
    assert.are.equal("ffff00 255", at(art.object, 75, 75))
    assert.are.equal(0, #art.skipped)
  end)

  it("may have lengths relative to the whole drawing", function()
    local art = read [[<rect width="50vw" height="25vmax" fill="red"/>]]
    assert.are.equal("ff0000 255", at(art.object, 48, 23))
    assert.are.equal("000000 0", at(art.object, 52, 23))
    assert.are.equal("000000 0", at(art.object, 48, 27))
  end)

  it("select by attributes with every operator, and no others", function()
    local function is_red(selector, attributes)
      local art = read(("<style>%s{fill:red}</style><rect width='9' height='9' %s/>")
        :format(selector, attributes or ""))
      return at(art.object, 5, 5) == "ff0000 255", #art.skipped
    end
    local with = { ["[id|=en]"] = { "en", "en-GB" }, ["[id^=en]"] = { "en", "end" },
      ["[id$=en]"] = { "en", "when" }, ["[id*=en]"] = { "send" },
      ["[class~=en]"] = { "", "en" }, ["[id=en][id]"] = { "en" }, ["[ id = 'en' ]"] = { "en" },
      ["rect#en"] = { "en" } }
    for selector, ids in pairs(with) do
      for _, id in ipairs(ids) do
        local name = selector:find "class" and "class='de en'" or ("id='%s'"):format(id)
        assert.are.same({ true, 0 }, { is_red(selector, name) }, selector .. id)
      end
      assert.are.same({ false, 0 }, { is_red(selector, "id='other' class='other'") }, selector)
      assert.are.same({ false, 0 }, { is_red(selector) }, selector)
    end
    assert.are.same({ false, 0 }, { is_red("[id|=en]", "id='end'") })
    for _, empty in ipairs { "[id^='']", "[id$='']", "[id*='']", "[class~='']" } do
      assert.are.same({ false, 0 }, { is_red(empty, "id='a' class='a'") }, empty)
    end
    for _, selector in ipairs { "[id~]", "[id|x]", "[id", "[id=en", "[unheard]", "[]", ".", "#",
      "#a#b", "rect.", "> rect", "rect:hover", "rect+rect",
      ("[id]"):rep(99), (".a"):rep(99), ("g "):rep(99) .. "rect" } do
      assert.are.same({ false, 1 }, { is_red(selector, "id='en'") }, selector)
    end
  end)

  it("leave out invalid declarations", function()
    local function seen(style, more)
      local art = read(("<style>%s</style><rect width='9' height='9' %s/>")
        :format(style, more or ""))
      return at(art.object, 5, 5)
    end
    for _, damaged in ipairs { ":red", "fill", "fill red", ("f"):rep(40) .. ":red", "unheard: red",
      "x: red", "fill:", "fill: no colour", "fill: red !imp",
      "fill: 'a;fill:red", "fill: context", "opacity: x", "opacity: .5 !x", "color: no colour",
      "fill-rule: x", "stroke-width: x", "font-size: x", "display: block", "filter: none",
      "mix-blend-mode: normal", "mask: none", "clip-path: none", "fill-opacity: y" } do
      assert.are.equal("0000ff 255", seen("rect { fill: blue; " .. damaged .. " }"), damaged)
    end
    assert.are.equal("ff0000 255", seen("rect { fill: red ! IMPORTANT } rect { fill: blue }"))
    assert.are.equal("ff0000 255", seen("rect { fill: red; } @media x { rect { fill: blue } }"))
    assert.are.equal("ff0000 255", seen("rect { fill: red; } @media x { rect { fill: blue }"))
    assert.are.equal("ff0000 255", seen("rect { fill: red; } rect"))
    assert.are.equal("ff0000 255", seen("rect { fill: red; } @x"))
    assert.are.equal("ff0000 255", seen("@x } rect { fill: red"))
    assert.are.equal("ff0000 128",
      seen("rect { opacity: inherit }", "fill='red' opacity='.5' style='opacity: 50%'"))
    assert.are.equal("ff0000 255", seen("", "fill='red' style='/* fill: blue */'"))
  end)

  it("of more than 65,536 rules are refused", function()
    local _, sentence = refusal(in_svg("<style>" .. ("a{}"):rep(65537) .. "</style>"))
    assert.is_truthy(sentence:find("the style sheets have more than 65536 rules", 1, true),
      sentence)
  end)

  it("report selectors that are ignored", function()
    local art =
      read '<style>rect:hover { fill: red } @import "x.css";</style><rect width="9" height="9"/>'
    assert.are.equal("000000 255", at(art.object, 5, 5))
    assert.are.equal(1, #art.skipped)
    assert.is_truthy(art.skipped[1].what:find("style", 1, true))
  end)

  it("of other files are not read", function()
    bench:write("red.css", "rect { fill: red }")
    for _, import in ipairs { '@import "red.css";', "@import url(red.css);" } do
      local art = read(("<style>%s rect { stroke: none }</style><rect width='9' height='9'/>")
        :format(import))
      assert.are.equal("000000 255", at(art.object, 5, 5))
      assert.are.equal("style: selectors or at-rules that are not supported", art.skipped[1].what)
    end
    local sheet = '<?xml-stylesheet href="red.css" type="text/css"?>'
    local art = assert(svg.read(write(sheet .. in_svg '<rect width="9" height="9"/>')))
    assert.are.equal("000000 255", at(art.object, 5, 5))
    assert.are.same({ { line = 1, what = "xml-stylesheet" } }, art.skipped)
  end)
end)

describe("clip paths and masks", function()
  it("may be written as shapes, in percentages of the box", function()
    local function inside(shape, x, y)
      local art = read(('<rect x="20" y="20" width="60" height="40" fill="red" clip-path="%s"/>')
        :format(shape))
      assert.are.equal(0, #art.skipped)
      return at(art.object, x, y) == "ff0000 255"
    end
    assert.is_true(inside("circle()", 69, 40))
    assert.is_false(inside("circle()", 71, 40))
    assert.is_true(inside("circle(10 at 0 50%)", 29, 40))
    assert.is_false(inside("circle(10 at 0 50%)", 31, 40))
    assert.is_true(inside("ellipse()", 79, 40))
    assert.is_false(inside("ellipse(10px 5px at 50% 50%)", 50, 46))
    assert.is_true(inside("inset(10 20 5 0)", 21, 54))
    assert.is_false(inside("inset(10 20 5 0)", 61, 54))
    assert.is_true(inside("polygon(0 0, 100% 0, 0 100%)", 30, 30))
    assert.is_false(inside("polygon(evenodd, 0 0, 100% 0, 0 100%)", 70, 50))
    local art = read '<rect width="9" height="9" clip-path="path(qwe)"/>'
    assert.are.equal('clip-path "path(qwe)"', art.skipped[1].what)
  end)

  it("cut by the union of their children, in either unit", function()
    local art = read [[<clipPath id="c"><circle cx="50" cy="50" r="20"/><rect width="10"
      height="10"/></clipPath>
      <clipPath id="b" clipPathUnits="objectBoundingBox"><rect width="0.5" height="1"/></clipPath>
      <rect width="100" height="60" clip-path="url(#c)"/>
      <g clip-path="url(#b)"><rect x="20" y="80" width="40" height="10"/></g>]]
    assert.are.equal("000000 255", at(art.object, 50, 50))
    assert.are.equal("000000 255", at(art.object, 5, 5))
    assert.are.equal("000000 0", at(art.object, 20, 20))
    assert.are.equal("000000 255", at(art.object, 39, 85))
    assert.are.equal("000000 0", at(art.object, 41, 85))
  end)

  it("use luminance", function()
    local art = read [[<mask id="m"><rect width="100" height="100" fill="white"/>
      <rect width="50" height="100" fill="#808080"/><rect width="100" height="10"/></mask>
      <rect width="100" height="100" fill="red" mask="url(#m)"/>]]
    assert.are.equal("ff0000 128", at(art.object, 25, 50))
    assert.are.equal("ff0000 255", at(art.object, 75, 50))
    assert.are.equal("000000 0", at(art.object, 75, 5))
  end)

  it("may contain strokes and use elements", function()
    local art = read [[<defs><rect id="r" width="20" height="20"/></defs>
      <mask id="m" maskUnits="userSpaceOnUse" x="0" y="0" width="100" height="100">
      <rect x="20" y="20" width="60" height="60" fill="#808080" stroke="white" stroke-width="10"/>
      <g fill="black"><use href="#r" x="40" y="40"/></g></mask>
      <rect width="100" height="100" fill="red" mask="url(#m)"/>]]
    assert.are.same({}, art.skipped)
    assert.are.equal("ff0000 255", at(art.object, 20, 50))
    assert.are.equal("ff0000 128", at(art.object, 30, 50))
    assert.are.equal("000000 0", at(art.object, 50, 50))
    assert.are.equal("000000 0", at(art.object, 10, 50))
  end)

  --- What a mask of these shapes, with these attributes, shows of a red drawing; or the report.
  local function masked(shapes, x, y, attributes, shown)
    local art = read(("<defs><filter id='f'/><marker id='k'/><rect id='r' width='9' height='9'/>"
      .. "<clipPath id='c'><rect width='50' height='100'/></clipPath><mask id='n'><rect width='9' "
      .. "height='9'/></mask></defs>"
      .. "<mask id='m' %s>%s</mask>%s"):format(attributes or "", shapes,
      shown or "<rect width='100' height='100' fill='red' mask='url(#m)'/>"))
    return art.skipped[1] and art.skipped[1].what or at(art.object, x, y)
  end

  it("are drawn with all that drawings have", function()
    local white = "<rect width='100' height='100' fill='white' %s/>"
    assert.are.equal("000000 0", masked(white:format "clip-path='url(#c)'", 60, 5))
    assert.are.equal("ff0000 255", masked(white:format "clip-path='url(#c)'", 40, 5))
    assert.are.equal("ff0000 128", masked(white:format "opacity='.5'", 5, 5))
    assert.are.equal("ff0000 128", masked("<g opacity='.5'>" .. white:format "" .. "</g>", 5, 5))
    local halves = "<rect width='60' height='100' fill='white' fill-opacity='.5'/><rect x='50' "
      .. "width='50' height='100' fill='white' fill-opacity='.5'/>"
    assert.are.equal("ff0000 128", masked(halves, 5, 5))
    assert.are.equal("ff0000 191", masked(halves, 55, 5))
    assert.are.equal("ff0000 64", masked("<g opacity='.5'>" .. halves .. "</g>", 5, 5))
    assert.are.equal("ff0000 255", masked("<path d='M0 50H100' stroke-width='100' stroke='white' "
      .. "marker-end='url(#k)'/>", 5, 5))
    assert.are.equal("ff0000 255",
      masked(("<rect width='1' height='1'/>"):rep(5000) .. white:format "", 5, 5))
    assert.are.equal("ff0000 188", masked("<g style='isolation:isolate'>" .. white:format ""
      .. "<rect width='99' height='99' fill='#bcbcbc' style='mix-blend-mode:multiply'/></g>", 5, 5))
  end)

  it("may be masked and clipped themselves", function()
    local white = "<rect width='100' height='100' fill='white' fill-opacity='.5' %s/>"
    assert.are.equal("ff0000 128", masked(white:format "", 40, 5, "clip-path='url(#c)'"))
    assert.are.equal("000000 0", masked(white:format "", 60, 5, "clip-path='url(#c)'"))
    local inner = "<mask id='o' maskUnits='userSpaceOnUse'>" .. white:format "x='50'" .. "</mask>"
    assert.are.equal("000000 0", masked(white:format "", 40, 5, "mask='url(#o)'",
      inner .. "<rect width='100' height='100' fill='red' mask='url(#m)'/>"))
    assert.are.equal("ff0000 64", masked(white:format "", 60, 5, "mask='url(#o)'",
      inner .. "<rect width='100' height='100' fill='red' mask='url(#m)'/>"))
    assert.are.equal("ff0000 64", masked(white:format "mask='url(#o)'", 60, 5, "",
      inner .. "<rect width='100' height='100' fill='red' mask='url(#m)'/>"))
  end)

  it("show only their displayed and visible contents", function()
    local white = "<rect width='100' height='100' fill='white'/>"
    for _, hidden in ipairs { "display='none'", "visibility='hidden'" } do
      assert.are.equal("000000 0", masked("<g " .. hidden .. ">" .. white .. "</g>", 5, 5), hidden)
    end
    assert.are.equal("000000 0", masked("<rect/><use/><desc/>", 5, 5))
    assert.are.equal("ff0000 255", masked("<a>" .. white .. "</a>", 5, 5))
    assert.are.equal("ff0000 128",
      masked("<rect width='100' height='100' fill='black' opacity='.5'/>", 5, 5,
        "mask-type='alpha'"))
    assert.are.equal("000000 0",
      masked("<rect width='100' height='100' fill='black'/>", 5, 5, "mask-type='luminance'"))
    assert.are.equal("mask that is not in the file",
      masked("", 5, 5, "", "<rect width='9' height='9' mask='url(#none)'/>"))
    assert.are.equal("mask that is not in the file",
      masked("", 5, 5, "", "<rect width='9' height='9' mask='url(#c)'/>"))
    assert.are.equal("ff0000 255",
      masked("", 5, 5, "", "<rect width='9' height='9' fill='red' mask='none'/>"))
  end)

  it("have the given region and units", function()
    local white, line = "<rect width='.5' height='1' fill='white'/>",
      "<path d='M0 50H100' stroke='red' stroke-width='9' mask='url(#m)'/>"
    assert.are.equal("ff0000 255",
      masked(white, 40, 50, "maskUnits='objectBoundingBox' maskContentUnits='objectBoundingBox'"))
    assert.are.equal("000000 0", masked(white, 60, 50, "maskContentUnits='objectBoundingBox'"))
    assert.are.equal("000000 0", masked(white, 40, 50, "maskContentUnits='userSpaceOnUse'"))
    assert.are.equal("000000 0",
      masked(white, 40, 50, "maskContentUnits='objectBoundingBox' width='0'"))
    assert.are.equal("000000 0",
      masked(white, 40, 50, "maskContentUnits='objectBoundingBox' height='-1'"))
    local whole = "<rect width='100' height='100' fill='white'/>"
    assert.are.equal("ff0000 255", masked(whole, 40, 50, "maskUnits='userSpaceOnUse'", line))
    assert.are.equal("000000 0", masked(whole, 40, 50, "", line))
    assert.are.equal("000000 0",
      masked(white, 40, 50, "maskUnits='userSpaceOnUse' maskContentUnits='objectBoundingBox'",
        line))
  end)

  it("refer to one another 128 deep, and no deeper", function()
    local function chain(first, step, links)
      local out = { first }
      for i = 1, links do out[#out + 1] = step:format(i, i - 1) end
      return "<defs>" .. table.concat(out) .. "</defs>"
    end
    local use = chain('<g id="a0"><rect width="9" height="9" fill="white"/></g>',
      '<g id="a%d"><use href="#a%d"/></g>', 200)
    local cases = {
      [use .. '<use href="#a200"/>'] = "elements shown by use are nested more than 128 deep",
      [use .. '<mask id="m"><use href="#a200"/></mask>'
        .. '<rect width="9" height="9" mask="url(#m)"/>'] =
        "elements shown by use are nested more than 128 deep",
      [chain('<mask id="a0"/>',
        '<mask id="a%d" mask="url(#a%d)"><rect width="9" height="9"/></mask>', 200)
        .. '<rect width="9" height="9" mask="url(#a200)"/>'] =
        "masks refer to one another more than 128 deep",
      [chain('<clipPath id="a0"/>',
        '<clipPath id="a%d" clip-path="url(#a%d)"><rect width="9" height="9"/></clipPath>', 200)
        .. '<rect width="9" height="9" clip-path="url(#a200)"/>'] =
        "clip paths refer to one another more than 128 deep",
    }
    for content, told in pairs(cases) do
      local _, sentence = refusal(in_svg(content))
      assert.is_truthy(sentence:find(told, 1, true), sentence)
      assert.are.same({}, read((content:gsub("a200", "a50"))).skipped)
    end
  end)

  it("are ignored where they contain themselves", function()
    local art = read [[<mask id="m"><g id="g"><use href="#g"/><rect width="5" height="9"
      fill="white"/></g></mask><rect width="9" height="9" mask="url(#m)"/>]]
    assert.are.equal("use that is inside the element that it shows", art.skipped[1].what)
    assert.are.equal(1, #art.skipped)
    assert.are.equal("000000 255", at(art.object, 4, 4))
    assert.are.equal("000000 0", at(art.object, 6, 4))
  end)

  it("fade by the luminance of gradients, as they are coded", function()
    local art = read [[<linearGradient id="g"><stop/><stop offset="1" stop-color="white"/>
      </linearGradient><mask id="m"><rect width="100" height="100" fill="url(#g)"/></mask>
      <rect width="100" height="100" fill="red" mask="url(#m)"/>]]
    assert.are.same({}, art.skipped)
    assert.are.equal("ff0000 128", at(art.object, 50, 50))
    assert.are.equal("ff0000 64", at(art.object, 25, 50))
  end)
end)

describe("blend modes", function()
  local red = "<rect width='100' height='100' fill='red'/>"
  local function blue(style)
    return ("<rect width='100' height='100' fill='blue' style='%s'/>"):format(style)
  end
  local function shown(content, x)
    local art = read(content)
    assert.are.same({}, art.skipped)
    return at(art.object, x or 50, 50)
  end

  it("act on the shapes below in the drawing", function()
    assert.are.equal("000000 255", shown(red .. blue "mix-blend-mode:multiply"))
    assert.are.equal("ff00ff 255", shown(red .. blue "mix-blend-mode:screen"))
    assert.are.equal("ff00ff 255", shown(red .. blue "mix-blend-mode:plus-lighter"))
    assert.are.equal("ff00ff 255",
      shown(red .. "<g style='mix-blend-mode:lighten'><g>" .. blue "" .. "</g></g>"))
    assert.are.equal("ff00ff 255", shown(red .. "<g>" .. blue "mix-blend-mode:lighten" .. "</g>"))
  end)

  it("do not act on the background of an element that isolates", function()
    local inner = blue "mix-blend-mode:screen"
    for _, group in ipairs { "style='isolation:isolate'", "clip-path='url(#c)'",
      "mask='url(#m)'" } do
      assert.are.equal("0000ff 255", shown("<clipPath id='c'><circle r='99'/></clipPath>"
        .. "<mask id='m'><circle r='99' fill='white'/></mask>" .. red .. "<g " .. group .. ">"
        .. inner .. "</g>"))
    end
    assert.are.equal(shown(red .. "<g opacity='.5'>" .. blue "" .. "</g>"),
      shown(red .. "<g opacity='.5'>" .. inner .. "</g>"))
  end)

  it("do not act on the background of the drawing", function()
    local art = read(blue "mix-blend-mode:screen")
    local behind = celspan.rect { 0, 0, 100, 100, texture = "#f00" }
    assert.are.equal("0000ff 255", at(behind | art.object, 50, 50))
    assert.are.equal("ff00ff 255", at(behind | art:elements()[1].object, 50, 50))
  end)

  it("stay when parts are changed", function()
    local art = read(red .. "<g id='g' style='mix-blend-mode:screen'><rect id='r' width='50' "
      .. "height='100' fill='blue'/></g>")
    local moved = art:with { r = function(part) return part:translate(50, 0) end }
    assert.are.equal("ff0000 255", at(moved.object, 25, 50))
    assert.are.equal("ff00ff 255", at(moved.object, 75, 50))
    assert.are.equal("ff00ff 255",
      at(art:with { g = function(part) return part:scale(2, 1) end }.object, 75, 50))
  end)
end)

describe("gradients", function()
  it("interpolate between their stops like a browser", function()
    local art = read [[<linearGradient id="g"><stop stop-color="#000"/><stop offset="1"
      stop-color="#fff"/>
      </linearGradient><rect width="100" height="100" fill="url(#g)"/>]]
    for x = 1, 99 do
      local shown = tonumber(at(art.object, x, 50):sub(1, 2), 16)
      assert.is_true(math.abs(shown - 2.55 * x) <= 1, x .. " " .. shown)
    end
  end)

  it("fade with straight alpha", function()
    local art = read [[<linearGradient id="g"><stop stop-color="#f00" stop-opacity="0"/>
      <stop offset="1" stop-color="#00f"/></linearGradient><rect width="100" height="100"
        fill="url(#g)"/>]]
    assert.are.equal("800080 128", at(art.object, 50, 50))
  end)

  it("extend from a focus with a radius, down to the centre", function()
    local gradient = [[<radialGradient id="g" gradientUnits="userSpaceOnUse" cx="0" cy="50" r="50"
      fr="20" spreadMethod="%s">%s</radialGradient>
      <rect width="100" height="100" fill="url(#g)"/>]]
    local hard =
      [[<stop stop-color="red"/><stop offset=".5" stop-color="red"/><stop offset=".5" ]]
      .. [[stop-color="blue"/><stop offset="1" stop-color="blue"/>]]
    local spreads = { ["repeat"] = function(t) return t % 1 end, reflect = function(t)
      return math.abs((t + 1) % 2 - 1)
    end }
    for spread, period in pairs(spreads) do
      local art = read(gradient:format(spread, hard))
      for x = 1.5, 96, 3 do
        local red = period((x - 20) / 30) < 0.5
        assert.are.equal(red and "ff0000 255" or "0000ff 255", at(art.object, x, 50), spread .. x)
      end
      art =
        read(gradient:format(spread,
          '<stop stop-color="#f00"/><stop offset="1" stop-color="#00f"/>'))
      for _, x in ipairs { 0.1, 0.3, 1, 4, 8, 14, 26, 44, 56, 70 } do
        local shown = tonumber(at(art.object, x, 50):sub(1, 2), 16)
        assert.is_true(math.abs(shown - 255 * (1 - period((x - 20) / 30))) <= 1,
          spread .. x .. " " .. shown)
      end
    end
  end)

  it("that are degenerate show their last colour, or nothing", function()
    local function seen(gradient, shape)
      local art = read(gradient .. (shape or '<rect width="9" height="9" fill="url(#g)"/>'))
      return at(art.object, 5, 5), art.skipped[1] and art.skipped[1].what
    end
    local stops = '<stop stop-color="red"/><stop offset="1" stop-color="lime"/>'
    local linear, radial = '<linearGradient id="g" %s>' .. stops .. "</linearGradient>",
      '<radialGradient id="g" %s>' .. stops .. "</radialGradient>"
    for _, one in ipairs { linear:format 'x1="0" x2="0"', radial:format 'r="0"',
      '<linearGradient id="g"><stop stop-color="lime"/></linearGradient>',
      linear:format 'x1="1" x2="1" spreadMethod="repeat"' } do
      assert.are.equal("00ff00 255", seen(one), one)
    end
    for _, one in ipairs { '<linearGradient id="g"/>', radial:format 'r="-1"',
      radial:format 'fr="1"', linear:format 'gradientTransform="scale(0)"',
      linear:format 'gradientTransform="scale(0)" spreadMethod="repeat"' } do
      assert.are.equal("000000 0", seen(one), one)
    end
    assert.are.equal("radius of the focus of radialGradient",
      select(2, seen(radial:format 'fr=".1" fy=".2"')))
    local flat = '<path d="M0 5H9" stroke="%s" stroke-width="4"/>'
    assert.are.equal("0000ff 255", seen(linear:format "", flat:format "url(#g) blue"))
    assert.are.equal("000000 0", seen(linear:format "", flat:format "url(#g)"))
    assert.are.equal("0000ff 255", seen('<pattern id="g"/>', flat:format "url(#g) blue"))
  end)

  it("can be spread, rotated, and inherited from templates", function()
    local art = read [[<linearGradient id="t"><stop stop-color="red"/><stop offset="0.5"
      stop-color="red"/>
      <stop offset="0.5" stop-color="lime"/></linearGradient>
      <linearGradient id="r" href="#t" gradientUnits="userSpaceOnUse" x1="0" x2="20"
        spreadMethod="repeat"/>
      <linearGradient id="f" href="#r" spreadMethod="reflect"/>
      <linearGradient id="u" href="#t" gradientTransform="rotate(90)"/>
      <radialGradient id="c" href="#t" gradientUnits="userSpaceOnUse" cx="50" cy="85" r="10"
        spreadMethod="repeat"/>
      <rect width="100" height="20" fill="url(#r)"/><rect y="20" width="100" height="20"
        fill="url(#f)"/>
      <rect y="40" width="100" height="20" fill="url(#u)"/><rect y="70" width="100" height="30"
        fill="url(#c)"/>]]
    local seen = {}
    for _, place in ipairs { { 5, 10 }, { 15, 10 }, { 85, 10 }, { 95, 10 }, { 25, 30 }, { 35, 30 },
      { 5, 45 },
                             { 95, 55 }, { 53, 85 }, { 57, 85 }, { 63, 85 }, { 67, 85 } } do
      seen[#seen + 1] = at(art.object, place[1], place[2]):sub(1, 6) == "ff0000" and "r" or "g"
    end
    assert.are.equal("rgrggrrgrgrg", table.concat(seen))
  end)
end)

--- Where a picture of 100 x 100 is not what the points of its scene are; nil: nowhere.
local function place_apart(image, rostrum)
  for y = 0, 99, 3 do
    for x = 0, 99 do
      local shown = { image:get(x, y) }
      local exact = { celspan.probe(rostrum, x + 0.5, y + 0.5, { film = { 100, 100 } }) }
      for c = 1, 4 do
        local is_near = math.abs(shown[c] - exact[c]) <= 1.1 / 1023
        if not is_near then
          return ("%d, %d: %s, but %s"):format(x, y, table.concat(shown, " "),
            table.concat(exact, " "))
        end
      end
    end
  end
end

describe("a radial gradient with a focus", function()
  local texture = celspan.radial { centre = { 50, 50 }, radius = 40, focus = { 26, 42 },
    { 0, celspan.rgb(1, 0, 0) }, { 0.3, celspan.rgb(0, 1, 0, 0.5) }, { 1, celspan.rgb(0, 0, 1) } }
  local scene = celspan.rostrum { antialias = "none",
    celspan.cel { celspan.rect { 0, 0, 100, 100, texture = texture } } }

  it("has circles that grow from the focus to the whole one", function()
    local function red(x, y)
      return (celspan.probe(scene, x, y, { film = { 100, 100 } }))
    end
    assert.is_true(red(26.0001, 42) > 0.999)
    for turn = 0, 350, 10 do -- of the circle at 0.15: half of the way from red to green
      local a = math.rad(turn)
      local x, y = 26 + 0.15 * 24 + 6 * math.cos(a), 42 + 0.15 * 8 + 6 * math.sin(a)
      assert.is_true(math.abs(red(x, y) - 0.5) < 1e-9, turn)
    end
  end)

  it("is rendered as it is defined", function()
    for _, turn in ipairs { 0, 33 } do
      local turned = celspan.rostrum { antialias = "none",
        celspan.cel { celspan.rect { 0, 0, 100, 100, texture = texture }:rotate(turn, 50, 50) } }
      local image = assert(celspan.pixels(turned, { size = { 100, 100 } }))
      assert.is_nil(place_apart(image, turned), turn)
    end
  end)
end)

describe("a gradient with a spread or a matrix", function()
  local stops = { { 0.2, celspan.rgb(1, 0, 0) }, { 0.5, celspan.rgb(0, 1, 0, 0.5) },
    { 0.9, celspan.rgb(0, 0, 1) } }
  local turn = { 0.8, -0.6, 20, 0.6, 0.8, -10, 0, 0, 1 }

  --- The position along the stops, between 0 and 1, after the spread.
  local function fold(spread, place)
    if spread == "hold" then return place end
    local period = math.floor(place)
    return spread == "reflect" and period % 2 == 1 and 1 - (place - period) or place - period
  end

  --- The share of red there, by the first two stops.
  local function red(place)
    if place <= 0.2 then return 1 end
    return place >= 0.5 and 0 or 1 - (place - 0.2) / 0.3
  end

  local function each(check)
    for _, spread in ipairs { "hold", "repeat", "reflect" } do
      for _, matrix in ipairs { false, turn } do check(spread, matrix or nil) end
    end
  end

  local function scene(texture, form)
    local rect = celspan.rect { 0, 0, 100, 100, texture = texture }
    return celspan.rostrum { antialias = "none", celspan.cel { form and form(rect) or rect } }
  end

  --- The point in the gradient's own units.
  local function back(matrix, x, y)
    if not matrix then return x, y end
    return 0.8 * (x - 20) + 0.6 * (y + 10), -0.6 * (x - 20) + 0.8 * (y + 10)
  end

  it("has the colours that its definition gives", function()
    each(function(spread, matrix)
      local linear = scene(celspan.linear { from = { 30, 0 }, to = { 50, 0 }, spread = spread,
        matrix = matrix, table.unpack(stops) })
      local radial = scene(celspan.radial { centre = { 50, 40 }, radius = 15, spread = spread,
        matrix = matrix, table.unpack(stops) })
      for x = 1.3, 99, 7 do
        for y = 2.1, 99, 9 do
          local u, v = back(matrix, x, y)
          local place = (u - 30) / 20
          assert.is_near(red(fold(spread, place)),
            (celspan.probe(linear, x, y, { film = { 100, 100 } })), 1e-6)
          place = math.sqrt((u - 50) ^ 2 + (v - 40) ^ 2) / 15
          assert.is_near(red(fold(spread, place)),
            (celspan.probe(radial, x, y, { film = { 100, 100 } })), 1e-6)
        end
      end
    end)
  end)

  it("is rendered as it is defined", function()
    each(function(spread, matrix)
      for _, texture in ipairs {
        celspan.linear { from = { 30, 10 }, to = { 50, 17 }, spread = spread, matrix = matrix,
          table.unpack(stops) },
        celspan.radial { centre = { 50, 40 }, radius = 15, focus = { 44, 38 }, spread = spread,
          matrix = matrix, table.unpack(stops) },
      } do
        local turned = scene(texture, function(rect) return rect:rotate(33, 50, 50) end)
        local image = assert(celspan.pixels(turned, { size = { 100, 100 } }))
        assert.is_nil(place_apart(image, turned))
      end
    end)
  end)

  it("may be a light", function()
    local lamp = celspan.linear { from = { 0, 0 }, to = { 20, 0 }, spread = "reflect",
      { 0, "#000" }, { 1, "#fff" } }
    local rostrum = celspan.rostrum {
      celspan.cel { celspan.rect { 0, 0, 100, 100, texture = "#fff" }, front = lamp } }
    for x = 1, 99, 7 do
      local place = x / 20 % 2
      assert.is_near(place > 1 and 2 - place or place,
        (celspan.probe(rostrum, x, 50, { film = { 100, 100 } })), 1e-6)
    end
  end)

  it("refuses other spreads, and too many periods", function()
    local function made(fields)
      fields.from, fields.to, fields[1], fields[2] = { 0, 0 }, { 1, 0 },
        { 0, celspan.rgb(0, 0, 0) }, { 1, celspan.rgb(1, 1, 1) }
      return function() return celspan.rect { 0, 0, 1e5, 9, texture = celspan.linear(fields) } end
    end
    assert.is_truthy(raised.message(made { spread = "pad" })
      :find('"hold", "repeat" or "reflect", got "pad"', 1, true))
    assert.is_truthy(raised.message(made { spread = "repeat" })
      :find("is repeated 100000 times where it is shown; with its stops, at most 1024 times are "
        .. "allowed", 1, true))
    assert.is_truthy(raised.message(made { matrix = { 1, 2, 3 } })
      :find("matrix[4] must be a number", 1, true))
    assert.is_truthy(raised.message(made { spread = "repeat",
      matrix = { 1, 0, 0, 0, 1, 0, 1, 0, 1 } }):find("horizon", 1, true))
    local clear = scene(celspan.linear { from = { 0, 0 }, to = { 9, 0 },
      matrix = { 0, 0, 0, 0, 0, 0, 0, 0, 1 }, table.unpack(stops) })
    assert.are.same({ 0, 0, 0, 0 }, { celspan.probe(clear, 5, 5, { film = { 100, 100 } }) })
  end)
end)

describe("strokes", function()
  --- Which of these points show red.
  local function red_at(art, points)
    local list = {}
    for i, p in ipairs(points) do
      if at(art.object, p[1], p[2]) == "ff0000 255" then list[#list + 1] = i end
    end
    return table.concat(list, " ")
  end

  it("have a width, caps and an opacity of their own", function()
    local art = read [[<g stroke="red" stroke-width="10"><line x1="20" y1="20" x2="80" y2="20"/>
      <path d="M20 50H80" stroke-linecap="square"/><path d="M20 80H80" stroke-linecap="round"/>
        </g>]]
    assert.are.equal("2 4 5 8",
      red_at(art, { { 18, 20 }, { 22, 24 }, { 22, 26 }, { 16, 46 }, { 18, 50 },
                                              { 14, 50 }, { 16, 76 }, { 16, 80 } }))
    art = read [[<rect x="20" y="20" width="60" height="60" fill="blue" stroke="red"
      stroke-width="10%"
      stroke-opacity=".5"/>]]
    assert.are.equal("ff0000 128", at(art.object, 16, 50))
    assert.are.equal("0000ff 255", at(art.object, 30, 50))
  end)

  it("have joins up to the limit of a miter", function()
    local function corner(attributes)
      return red_at(read(('<path d="M20 80V20H80" fill="none" stroke="red" stroke-width="20" %s/>')
        :format(attributes)), { { 11, 11 }, { 13.5, 13.5 }, { 16, 16 } })
    end
    assert.are.equal("1 2 3", corner "")
    assert.are.equal("3", corner 'stroke-linejoin="bevel"')
    assert.are.equal("2 3", corner 'stroke-linejoin="round"')
    assert.are.equal("3", corner 'stroke-miterlimit="1.4"')
    assert.are.equal("1 2 3", corner 'stroke-miterlimit="1.42"')
  end)

  it("have dashes, from an offset on", function()
    local function dashes(attributes)
      return red_at(read(('<path d="M0 50H100" stroke="red" stroke-width="10" %s/>')
        :format(attributes)),
        { { 5, 50 }, { 15, 50 }, { 25, 50 }, { 35, 50 }, { 45, 50 }, { 55, 50 } })
    end
    assert.are.equal("1 3 5", dashes 'stroke-dasharray="10"')
    assert.are.equal("1 2 4 5", dashes 'stroke-dasharray="20,10px"')
    assert.are.equal("1 3 4 6", dashes 'stroke-dasharray="20 10" stroke-dashoffset="10"')
    for _, none in ipairs { "none", "0 0", "10 -1", "ten" } do
      assert.are.equal("1 2 3 4 5 6", dashes(('stroke-dasharray="%s"'):format(none)))
    end
    assert.are.equal("1 2 4 5", dashes 'stroke-dasharray="20%,10%"')
  end)

  it("are painted in the requested order", function()
    local shape =
      '<rect x="20" y="20" width="60" height="60" fill="blue" stroke="red" stroke-width="20" %s/>'
    assert.are.equal("ff0000 255", at(read(shape:format "").object, 25, 50))
    assert.are.equal("0000ff 255", at(read(shape:format 'paint-order="stroke"').object, 25, 50))
    assert.are.equal("ff0000 255", at(read(shape:format 'paint-order="stroke red"').object, 25, 50))
  end)

  it("keep their width on request", function()
    local art = read [[<g transform="scale(4 1)" stroke="red" stroke-width="4"><path d="M5 0V100"/>
      <path d="M15 0V100" vector-effect="non-scaling-stroke"/></g>]]
    assert.are.equal("1 3",
      red_at(art, { { 13, 50 }, { 11, 50 }, { 59, 50 }, { 57, 50 }, { 63, 50 } }))
  end)

  it("have gradients, in units of the box without the stroke", function()
    local gradient = '<linearGradient id="a"><stop offset=".5" stop-color="red"/><stop offset=".5"'
      .. ' stop-color="lime"/></linearGradient>'
    local art =
      read(gradient .. [[<path d="M10 20H90V80" fill="none" stroke="url(#a)" stroke-width="20"/>]])
    assert.are.equal("ff0000 255", at(art.object, 48, 20))
    assert.are.equal("00ff00 255", at(art.object, 52, 20))
    assert.are.equal("000000 0", at(art.object, 52, 50))
    art = read(gradient .. [[<path d="M10 20H90" stroke="url(#a) blue" stroke-width="20"/>]])
    assert.are.equal("0000ff 255", at(art.object, 48, 20))
  end)

  it("have dashes if their list is valid, and are solid if not", function()
    local line =
      '<path d="M0 50H100" stroke="red" stroke-width="10" stroke-dasharray="%s" '
      .. 'stroke-dashoffset="%s"/>'
    local function dashed(list, offset, note)
      local art = read(line:format(list, offset or "0"))
      assert.are.equal(note, art.skipped[1] and art.skipped[1].what, list)
      return at(art.object, 5, 50) == "ff0000 255", at(art.object, 15, 50) == "ff0000 255"
    end
    assert.are.same({ true, false }, { dashed "10" })
    assert.are.same({ false, true }, { dashed("10", "10") })
    assert.are.same({ true, false }, { dashed("10", "1e12em") })
    for _, list in ipairs { "none", "10 -1", "0 0", "", "1e12 1e12", "inherit" } do
      assert.are.same({ true, true }, { dashed(list) }, list)
    end
    assert.are.same({ true, true }, { dashed("10 x", "0", 'stroke-dasharray "10 x"') })
  end)

  it("are not drawn if they have no width, no outline or no size", function()
    local gradient =
      '<linearGradient id="g"><stop stop-color="red"/><stop offset="1" '
      .. 'stop-color="red"/></linearGradient>'
    local function shown(style, path)
      local art = read(gradient .. ('<path d="%s" style="stroke: red; stroke-width: 10; %s"/>')
        :format(path or "M0 50L100 51", style))
      return at(art.object, 50, 50) == "ff0000 255"
    end
    for _, style in ipairs { "", "stroke: url(#g)", "vector-effect: non-scaling-stroke",
      "stroke-width: -5", "stroke: url(#none) red" } do
      assert.is_true(shown(style), style)
    end
    for _, style in ipairs { "stroke-width: 0", "stroke-width: 1e12em", "transform: scale(0)",
      "stroke: url(#g); transform: scale(0)",
      "stroke: none", "stroke: url(#none)", "stroke-opacity: 0" } do
      assert.is_false(shown(style), style)
    end
    for _, path in ipairs { "", "none", "M50 50", "x" } do
      assert.is_false(shown("", path), path)
    end
  end)

  it("may have more dashes than are drawn", function()
    local art = read [[<path d="M0 50H100" stroke="red" stroke-width="9" stroke-dasharray="1e-9"/>]]
    assert.are.equal("ff0000 255", at(art.object, 50, 50))
    assert.are.equal("stroke-dasharray of path", art.skipped[1].what)
  end)
end)

describe("markers", function()
  --- A marker that is red to the right of its middle and blue to the left of it.
  local function marker(attributes)
    return ('<marker id="m" markerWidth="10" markerHeight="10" refX="5" refY="5" %s>'
      .. '<rect width="5" height="10" fill="blue"/><rect x="5" width="5" height="10" '
      .. 'fill="red"/></marker>')
      :format(attributes)
  end

  it("are drawn at the ends and vertices, in the direction of the line", function()
    local art = read(marker 'orient="auto"' .. [[<path d="M20 20H80V80" fill="none"
      marker-start="url(#m)"
      marker-end="url(#m)"/>]])
    assert.are.equal("ff0000 255", at(art.object, 23, 20))
    assert.are.equal("0000ff 255", at(art.object, 17, 20))
    assert.are.equal("000000 0", at(art.object, 80, 20))
    assert.are.equal("ff0000 255", at(art.object, 80, 83))
    art = read(marker 'orient="auto"'
      .. [[<path d="M20 20H80V80" fill="none" marker-mid="url(#m)"/>]])
    assert.are.equal("ff0000 255", at(art.object, 82, 22)) -- half way between right and down
    assert.are.equal("0000ff 255", at(art.object, 78, 18))
  end)

  it("are rotated as given", function()
    local line = '<path d="M20 50H80" marker-start="url(#m)"/>'
    assert.are.equal("0000ff 255",
      at(read(marker 'orient="auto-start-reverse"' .. line).object, 23, 50))
    assert.are.equal("ff0000 255", at(read(marker 'orient="90"' .. line).object, 20, 53))
    assert.are.equal("ff0000 255", at(read(marker 'orient=".25turn"' .. line).object, 20, 53))
    assert.are.equal("ff0000 255", at(read(marker "" .. line).object, 23, 50))
  end)

  it("scale with the stroke, or with their units, and are clipped to their viewport", function()
    local line = '<path d="M20 50H80" stroke-width="2" marker-end="url(#m)"/>'
    assert.are.equal("ff0000 255", at(read(marker "" .. line).object, 89, 50))
    assert.are.equal("000000 0",
      at(read(marker 'markerUnits="userSpaceOnUse"' .. line).object, 89, 50))
    local boxed = marker 'viewBox="0 0 5 5" preserveAspectRatio="none" overflow="%s"' .. line
    assert.are.equal("000000 0", at(read(boxed:format "hidden").object, 88, 50))
    assert.are.equal("ff0000 255", at(read(boxed:format "visible").object, 88, 50))
  end)

  it("have their reference at a side or in the middle by a word", function()
    local line = '<path d="M50 50H80" stroke-width="1" fill="none" marker-start="url(#m)"/>'
    local function place(x, y)
      return ('<marker id="m" markerWidth="10" markerHeight="10" viewBox="-5 -5 10 10" '
        .. 'refX="%s" refY="%s">'
        .. '<rect x="-5" y="-5" width="10" height="10" fill="red"/></marker>%s'):format(x, y, line)
    end
    assert.are.equal("ff0000 255", at(read(place("center", "center")).object, 46, 46))
    assert.are.equal("000000 0", at(read(place("center", "center")).object, 46, 56))
    assert.are.equal("ff0000 255", at(read(place("left", "bottom")).object, 59, 41))
    assert.are.equal("ff0000 255", at(read(place("right", "top")).object, 41, 59))
    local symbol = '<symbol id="s" width="10" height="10" viewBox="0 0 1 1" refX="%s" refY="right">'
      .. '<rect width="1" height="1" fill="red"/></symbol><use href="#s" x="50" y="50"/>'
    assert.are.equal("ff0000 255", at(read(symbol:format "center").object, 46, 51))
    assert.are.equal("ff0000 255", at(read(symbol:format "1").object, 41, 51))
    assert.are.equal("000000 0", at(read(symbol:format "1").object, 51, 51))
  end)

  it("are drawn once at an arc's ends, and not inside of it", function()
    local art =
      read(marker "" .. [[<path d="M20 50A30 30 0 0 1 80 50" fill="none" marker-mid="url(#m)"/>]])
    assert.are.equal("000000 0", at(art.object, 53, 20))
  end)

  it("can use the colours of the line, and are never applied to themselves", function()
    local art = read [[<marker id="m" markerWidth="9" markerHeight="9" orient="auto"
      markerUnits="userSpaceOnUse">
      <path d="M0 0H9V9H0z" fill="context-stroke" marker-start="url(#m)"/></marker>
      <path d="M50 50H80" stroke="lime" marker-start="url(#m)"/>]]
    assert.are.equal("00ff00 255", at(art.object, 55, 55))
    assert.are.equal("marker inside of itself", art.skipped[1].what)
  end)

  it("can be set by their shorthand only in style sheets", function()
    local line = [[<path d="M20 50H80" fill="none" %s/>]]
    local art = read(marker "" .. line:format 'style="marker: url(#m)"')
    assert.are.equal("ff0000 255", at(art.object, 23, 50))
    art = read(marker "" .. line:format 'marker="url(#m)"')
    assert.are.equal("000000 0", at(art.object, 23, 50))
  end)
end)

describe("an unsupported part", function()
  it("is reported with its line, and the rest is drawn", function()
    local art = read [[
<filter id="f"><feOffset in="BackgroundImage"/></filter><pattern id="p"/>
<rect width="50" height="100" filter="url(#f)"/>
<rect x="50" width="50" height="100" fill="url(#p) red"/>
<text>hello</text>
<foreignObject/>]]
    local told = {}
    for i, entry in ipairs(art.skipped) do told[i] = entry.line .. " " .. entry.what end
    assert.are.same({ "1 filter of rect: feOffset with such an input",
      "4 text in no family, for which no font is given",
                      "5 foreignObject" }, told)
    assert.are.equal("000000 255", at(art.object, 25, 50))
    assert.are.equal("ff0000 255", at(art.object, 75, 50))
  end)
end)

describe("parts", function()
  local content = [[<g transform="translate(10 10)"><g id="arm" opacity="0.5"
    inkscape:label="left arm">
    <rect id="hand" width="10" height="10" fill="red"/></g>
    <rect inkscape:label="twice" width="1" height="1"/><rect inkscape:label="twice" width="1"
      height="1"/></g>
    <defs><circle id="dot" cx="0" cy="0" r="5"/></defs><use href="#dot" x="50" y="50"/><use
      href="#dot" x="80" y="50"/>]]

  it("have the drawing's units", function()
    local art = read(content)
    assert.are.same({ 10, 10, 10, 10 }, { art.parts.hand:bounds() })
    assert.are.equal("ff0000 128", at(art.parts["left arm"], 15, 15))
    assert.are.equal("ff0000 255", at(art.parts.hand, 15, 15))
    assert.is_nil(rawget(art.parts, "twice"))
    assert.are.same({ -5, -5, 10, 10 }, { art.parts.dot:bounds() })
    assert.are.equal("hand", art.parts.hand.name)
  end)

  it("are changed in place, inside their parents", function()
    local art = read(content)
    local other = art:with {
      hand = function(hand)
        assert.are.same({ 10, 10, 10, 10 }, { hand:bounds() })
        return hand:translate(0, 20)
      end }
    assert.are.equal("ff0000 128", at(other.object, 15, 35))
    assert.are.equal("000000 255", at(other.object, 10.5, 10.5)) -- what lies under it
    assert.are.equal("000000 0", at(other.object, 15, 15))
    assert.are.equal("ff0000 128", at(art.object, 15, 15))
    assert.are.same({ 10, 30, 10, 10 }, { other.parts.hand:bounds() })
  end)

  it("are changed wherever use shows them", function()
    local art = read(content):with { dot = function(dot) return dot:scale(2) end }
    assert.are.equal("000000 255", at(art.object, 59, 50))
    assert.are.equal("000000 255", at(art.object, 89, 50))
    assert.are.equal("000000 0", at(art.object, 5, 5))
  end)

  it("that were changed are wholes: their contents are not parts any more", function()
    local art = read(content):with { arm = function(arm) return arm:translate(40, 0) end }
    assert.is_nil(rawget(art.parts, "hand"))
    assert.is_truthy(raised.message(function()
      art:with { hand = function(hand) return hand end }
    end)
      :find("the drawing has no part 'hand'", 1, true))
    art = art:with { arm = function(arm) return arm:translate(0, 40) end }
    assert.are.equal("ff0000 128", at(art.object, 55, 55))
  end)

  it("with two names are changed by both, in the order of the names", function()
    local art = read(content):with { arm = function(arm) return arm:translate(40, 0) end,
                                     ["left arm"] = function(arm) return arm:translate(0, 40) end }
    assert.are.equal("ff0000 128", at(art.object, 55, 55))
  end)

  it("may replace one another, inner ones first", function()
    local order = {}
    local art = read(content):with {
      arm = function(arm)
        order[#order + 1] = "arm"
        return arm:translate(40, 0)
      end,
      hand = function()
        order[#order + 1] = "hand"
        return celspan.rect { 10, 10, 10, 10, texture = "#0f0" }
      end }
    assert.are.same({ "hand", "arm" }, order)
    assert.are.equal("00ff00 128", at(art.object, 55, 15))
  end)

  it("are named if they are missing", function()
    local art = read(content)
    assert.is_truthy(raised.message(function() art:with { hnad = function() end } end)
      :find("the drawing has no part 'hnad'; did you mean 'hand'?", 1, true))
    assert.is_truthy(raised.message(function() return art.parts.hnad end):find("'hand'", 1, true))
    assert.equal("a drawing has no 'rotate', but its object has: write .object:rotate(...)",
      raised.message(function() art:rotate(9) end):match "a drawing.*")
    local message = raised.message(function() art:with { hand = 3 } end)
    assert.is_truthy(message:find("must have a function", 1, true))
    assert.is_truthy(raised.message(function() art:with { hand = function() return 3 end } end)
      :find("the function of part 'hand' must return an object, got number", 1, true))
    assert.is_truthy(raised.message(function() art:with { hand = function() error "mine" end } end)
      :find("mine", 1, true))
    assert.is_truthy(raised.message(function()
      art.object:with { x = 1 }
    end):find("drawing", 1, true))
  end)
end)

describe("reading", function()
  it("gives the same drawing until the file changes", function()
    local path = drawing '<rect width="10" height="10"/>'
    local art = assert(svg.read(path))
    assert.are.equal(art, assert(svg.read(path)))
    local file = assert(io.open(path, "wb"))
    file:write(HEAD, '><rect width="30" height="10"/></svg>')
    file:close()
    assert.are.equal("000000 255", at(assert(svg.read(path)).object, 25, 5))
  end)

  it("reports what is wrong, with the line", function()
    local cases = {
      { "", 1, "no element found" },
      { "<html/>", 1, 'the document is "html"' },
      { in_svg "<g>", 2, "mismatched tag" },
      { in_svg "<rect width='nan' height='1'/>", 2, 'width is "nan"; it must be a finite number' },
      { in_svg "<rect width='1e13' height='1'/>", 2, 'width is "1e13"' },
      { in_svg "\n<g opacity='inf'/>", 3, 'opacity is "inf"' },
      { "<!DOCTYPE svg [<!ENTITY a 'b'><!ENTITY c '&a;&a;'>]>" .. in_svg "&c;", 1,
        'the entity "c" refers to other entities' },
      { "<!DOCTYPE svg [<!ENTITY a SYSTEM '/etc/passwd'>]>" .. in_svg "&a;", 1,
        'the entity "a" is in another file' },
      { in_svg(("<g>"):rep(10000) .. ("</g>"):rep(10000)), 2,
        "elements are nested more than 128 deep" },
    }
    for _, case in ipairs(cases) do
      local line, sentence = refusal(case[1])
      assert.are.equal(case[2], line, tostring(sentence))
      assert.is_truthy(sentence:find(case[3], 1, true), sentence)
    end
    assert.is_truthy(select(2, svg.read "no_such.svg"):find "no_such.svg: No such file")
    assert.is_truthy(select(2, svg.read "."):find "is not a file")
  end)

  local INNER = "<svg xmlns='http://www.w3.org/2000/svg' width='1' height='1'/>"
  local IMAGE = '<image href="data:image/svg+xml,'
    .. INNER:gsub("[<>]", { ["<"] = "%%3C", [">"] = "%%3E" }) .. '" %s/>'
  local CLIP =
    '<clipPath id="c" clipPathUnits="objectBoundingBox"><rect width="1" height="1"/></clipPath>'
  --- A drawing that shows an element with an attribute, and which attributes of it are numbers.
  local NUMBERS = {
    { "<rect %s/>", "x y width height rx ry" },
    { "<ellipse %s/>", "cx cy rx ry" },
    { "<circle %s/>", "cx cy r" },
    { '<line stroke="red" %s/>', "x1 y1 x2 y2" },
    { "<svg %s/>", "x y width height" },
    { '<rect id="r" width="1" height="1"/><use href="#r" %s/>', "x y" },
    { IMAGE, "x y width height" },
    { CLIP .. '<g clip-path="url(#c)">' .. IMAGE .. "</g>", "x y width height" },
    { "<text %s>A</text>", "x y dx dy rotate textLength" },
    { '<path id="p" d="M0 0H9" %s/><text><textPath href="#p">A</textPath></text>', "pathLength" },
    { '<path id="p" d="M0 0H9"/><text><textPath href="#p" %s>A</textPath></text>', "startOffset" },
    {
      '<linearGradient id="g" %s><stop/><stop offset="1"/></linearGradient><rect width="9" '
      .. 'height="9" fill="url(#g)"/>',
      "x1 y1 x2 y2" },
    {
      '<radialGradient id="g" %s><stop/><stop offset="1"/></radialGradient><rect width="9" '
      .. 'height="9" fill="url(#g)"/>',
      "cx cy r fx fy fr" },
    {
      '<clipPath id="c"><rect id="r" width="1" height="1"/><use href="#r" %s/></clipPath><rect '
      .. 'width="9" height="9" clip-path="url(#c)"/>',
      "x y" },
    { CLIP .. '<rect id="r" width="1" height="1"/><g clip-path="url(#c)"><use href="#r" %s/></g>',
      "x y" },
    { CLIP .. '<g clip-path="url(#c)"><svg %s><rect width="1" height="1"/></svg></g>',
      "x y width height" },
    {
      '<mask id="m" %s><rect width="1" height="1"/></mask><rect width="9" height="9" '
      .. 'mask="url(#m)"/>', "x y width height" },
    {
      '<mask id="m"><rect id="r" width="1" height="1"/><use href="#r" %s/></mask><rect width="9" '
      .. 'height="9" mask="url(#m)"/>', "x y" },
    {
      '<marker id="m" %s><rect width="1" height="1"/></marker><path d="M0 0H9" '
      .. 'marker-start="url(#m)"/>',
      "markerWidth markerHeight refX refY" },
    { '<symbol id="s" viewBox="0 0 9 9" %s><rect width="1" height="1"/></symbol><use href="#s"/>',
      "refX refY" },
    -- Contents of a mask or pattern are reported wherever it is used.
    {
      '<mask id="m"><g %s><rect width="1" height="1"/></g></mask><rect width="9" height="9" '
      .. 'mask="url(#m)"/>', "opacity" },
    {
      '<mask id="m"><rect width="1" height="1" %s/></mask><rect width="9" height="9" '
      .. 'mask="url(#m)"/>', "opacity" },
    {
      '<clipPath id="c"><rect width="1" height="1" %s/></clipPath><rect width="9" height="9" '
      .. 'clip-path="url(#c)"/>', "opacity" },
    { CLIP .. '<g clip-path="url(#c)"><g %s><rect width="1" height="1"/></g></g>', "opacity" },
    { "<text><tspan %s>A</tspan></text>", "opacity" },
    {
      '<marker id="m"><g %s><rect width="1" height="1"/></g></marker><path d="M0 0H9" '
      .. 'marker-start="url(#m)"/>', "opacity" },
    {
      '<linearGradient id="g"><stop %s/><stop offset="1"/></linearGradient><rect width="9" '
      .. 'height="9" fill="url(#g)"/>', "opacity" },
  }

  it("refuses a number that is invalid or too large, in any attribute", function()
    for _, case in ipairs(NUMBERS) do
      for name in case[2]:gmatch "%w+" do
        for _, number in ipairs { "nan", "-inf", "1e13" } do
          local content = case[1]:format(('%s="%s"'):format(name, number))
          local line, sentence = refusal(in_svg(content))
          assert.are.equal(2, line, content)
          assert.is_truthy(sentence:find(('%s is "%s"'):format(name, number), 1, true),
            content .. sentence)
        end
      end
    end
  end)

  it("refuses a file that is too large, and reports 10,000 things that it left out", function()
    local path = bench.folder .. "/large.svg"
    assert(os.execute(("truncate -s 300M '%s'"):format(path)))
    assert.matches("large%.svg: the file has 314572800 bytes; at most 268435456 are read",
      (select(2, svg.read(path))))
    local _, message = svg.read(drawing "<text>A</text>", { fonts = { default = path } })
    assert.matches("large%.svg: the font has 314572800 bytes; the limit is 268435456", message)
    assert.are.equal(10000, #read(("<foreignObject/>"):rep(10001)).skipped)
  end)

  it("ends when use grows without bound", function()
    local content = { '<g id="a0"><rect width="1" height="1"/></g>' }
    for i = 1, 30 do
      content[#content + 1] = ('<g id="a%d"><use href="#a%d"/><use href="#a%d"/></g>')
        :format(i, i - 1, i - 1)
    end
    local _, sentence =
      refusal(in_svg("<defs>" .. table.concat(content) .. "</defs><use href='#a30'/>"))
    assert.is_truthy(sentence:find("more than 1000000 elements are drawn", 1, true), sentence)
  end)

  it("accepts a path of many points and every truncation of a file", function()
    local text = in_svg("<path d='M0 0" .. (" l1 1"):rep(200000) .. "'/>")
    assert(svg.read(write(text)))
    text = in_svg [[<style>.a{fill:red}</style><g class="a" opacity=".5"><path d="M0 0L1 1z"/></g>]]
    for size = 0, #text - 1, 7 do
      local art, message = svg.read(write(text:sub(1, size)))
      assert.is_nil(art)
      assert.is_string(message)
    end
  end)

  it("draws a path up to a fault in its data", function()
    local art = read '<path d="M0 0h50v50h-50z M60 0 h40 v40 q"/>'
    assert.are.equal("000000 255", at(art.object, 25, 25))
    assert.are.same({ { line = 1, what = "path from a fault in its data on" } }, art.skipped)
  end)
end)

-- Contents from elsewhere in drawings: texts and images.
local FONT = "../../../scripts/type/block.ttf" -- from this file

describe("a text", function()
  local function letters(content, fonts)
    return assert(svg.read(drawing(content), { fonts = fonts or { default = FONT } }))
  end

  it("is drawn in the fonts that are given, and in no others", function()
    local art = letters '<text id="t" x="10" y="50" font-size="20">AB</text>'
    assert.are.same({}, art.skipped)
    assert.is_not_nil(art.parts.t)
    local left = letters('<text id="t" x="10" y="50" font-size="20">A</text>', { Other = FONT })
    assert.are.equal("text in no family, for which no font is given", left.skipped[1].what)
    assert.is_nil(rawget(left.parts, "t"))
  end)

  it("has the given anchor", function()
    for anchor, x in pairs { start = 50, middle = 40, ["end"] = 30 } do
      local one =
        letters(('<text x="50" y="50" font-size="20" letter-spacing="0" text-anchor="%s" '
        .. 'textLength="20">AB</text>')
        :format(anchor))
      local other = letters(('<text x="%g" y="50" font-size="20" textLength="20">AB</text>')
        :format(x))
      for px = 20, 80, 2 do assert.are.equal(at(other.object, px, 45), at(one.object, px, 45)) end
    end
  end)

  it("is stroked in its paint order", function()
    local function bounds(style)
      local art = letters('<text x="10" y="50" font-size="20" ' .. style .. '>I</text>')
      assert.are.same({}, art.skipped)
      return { art.object:bounds() }, art
    end
    local plain, wide = bounds 'fill="red"', bounds 'fill="red" stroke="blue" stroke-width="4"'
    for i, by in ipairs { -2, -2, 4, 4 } do assert.is_near(plain[i] + by, wide[i], 0.01) end
    local x, y = plain[1] + 0.5, plain[2] + plain[4] / 2 -- inside the letter, under the stroke
    local _, above = bounds 'fill="red" stroke="blue" stroke-width="4"'
    local _, below = bounds 'fill="red" stroke="blue" stroke-width="4" paint-order="stroke"'
    assert.are.equal("0000ff 255", at(above.object, x, y))
    assert.are.equal("ff0000 255", at(below.object, x, y))
  end)

  it("runs in both directions like other texts", function()
    local words = "AB שלום, CD"
    for direction, name in pairs { ltr = "ltr", rtl = "rtl" } do
      local art =
        letters(('<text x="10" y="50" font-size="16" direction="%s" text-anchor="%s">%s</text>')
        :format(direction, direction == "rtl" and "end" or "start", words))
      assert.are.same({}, art.skipped)
      local text = celspan.text { words, font = "../../../scripts/type/block.ttf", size = 16,
        at = { 10, 50 }, direction = name }
      local one, other = { art.object:bounds() }, { text:bounds() }
      for i = 1, 4 do assert.is_near(other[i], one[i], 1e-6) end
      for x = 10, 95, 3 do assert.are.equal(at(text, x, 46), at(art.object, x, 46)) end
    end
  end)

  it("has a box as high as its lines and as wide as its advances", function()
    local clip =
      '<clipPath id="c" clipPathUnits="objectBoundingBox"><rect width="%g" height="%g"/></clipPath>'
    local function width(share)
      local art = letters(clip:format(share, 1)
        .. '<text x="0" y="50" font-size="20" clip-path="url(#c)">MMMM</text>')
      assert.are.same({}, art.skipped)
      local x, _, w = art.object:bounds()
      return x + w
    end
    local glyphs = celspan.glyphs { "MMMM", font = "../../../scripts/type/block.ttf", size = 20 }
    local last = glyphs[#glyphs]
    assert.is_near(0.5 * (last.x + last.advance), width(0.5), 1e-6)
  end)

  it("may run along a line, its letters rotated with it", function()
    local square = '<path id="p" d="M20 20H80V80" fill="none"/>'
    local function along(attributes, words)
      local art =
        letters(square .. ('<text font-size="10"><textPath href="#p" %s>%s</textPath></text>')
        :format(attributes, words or "I"))
      assert.are.same({}, art.skipped)
      return { art.object:bounds() }
    end
    local plain = { assert(letters '<text font-size="10">I</text>').object:bounds() }
    local level, upright = along 'startOffset="10"', along 'startOffset="70"'
    assert.is_near(30 + plain[1], level[1], 1e-6)
    assert.is_near(20 + plain[2], level[2], 1e-6)
    -- turned by a right angle: the part above the line is now to the right of it
    assert.is_near(80 - plain[2] - plain[4], upright[1], 1e-6)
    assert.is_near(30 + plain[1], upright[2], 1e-6)
    assert.are.same(along 'startOffset="25%"', along 'startOffset="30"')
    square = square:gsub("/>", ' pathLength="1"/>')
    assert.are.same(along 'startOffset="25%"', along 'startOffset="0.25"')
    assert.are.same({}, along 'startOffset="119"')
  end)

  it("continues beyond the end of the line, and is not drawn without one", function()
    local line = '<path id="p" d="M20 20H80" fill="none" transform="translate(0 10)"/>'
    local art =
      letters(line
      .. '<text id="t" font-size="10"><textPath id="a" href="#p">I</textPath><tspan '
      .. 'id="b">I</tspan></text>')
    local x, y = art.parts.b:bounds()
    assert.is_true(x > 80 and x < 82 and y < 30 and y > 20)
    art = letters '<text><textPath href="#no">I</textPath></text>'
    assert.are.equal("textPath without a path", art.skipped[1].what)
    art = letters '<path id="p" d="M9 9"/><text><textPath href="#p">I</textPath></text>'
    assert.are.equal("textPath without a path", art.skipped[1].what)
  end)

  it("may be a clip path", function()
    local art = letters [[<clipPath id="c"><text x="10" y="90" font-size="100">I</text></clipPath>
      <rect width="100" height="100" fill="red" clip-path="url(#c)"/>]]
    assert.are.same({}, art.skipped)
    local plain = letters '<text x="10" y="90" font-size="100" fill="red">I</text>'
    for x = 0, 60, 2 do assert.are.equal(at(plain.object, x, 60), at(art.object, x, 60)) end
    local x = plain.object:bounds()
    assert.are.equal("ff0000 255", at(art.object, x + 2, 60))
  end)

  it("has elements with an opacity of their own, and reports their other effects", function()
    local art =
      letters([[<text x="10" y="90" font-size="100" fill="red"><tspan opacity=".5"><tspan ]]
      .. [[id="i">I</tspan></tspan></text>]])
    local x = art.object:bounds()
    assert.are.equal("ff0000 128", at(art.object, x + 2, 60))
    assert.are.equal("ff0000 255", at(art.parts.i, x + 2, 60))
    art =
      letters([[<filter id="f"/><text><tspan clip-path="url(#c)" mask="url(#m)" ]]
      .. [[filter="url(#f)">I</tspan></text>]])
    local told = {}
    for i, entry in ipairs(art.skipped) do told[i] = entry.what end
    assert.are.same({ "clip-path of tspan", "mask of tspan", "filter of tspan" }, told)
  end)

  it("has at most 64 lengths and 64 lines", function()
    local tspans = ('<tspan textLength="9">A</tspan>'):rep(64)
    assert.are.same({}, letters("<text>" .. tspans .. "</text>").skipped)
    assert.are.equal("textLength: a text has more than 64",
      letters("<text>" .. tspans .. '<tspan textLength="9">A</tspan></text>').skipped[1].what)
    local line, ways = '<path id="p" d="M0 0H99"/>', ('<textPath href="#p">A</textPath>'):rep(64)
    assert.are.same({}, letters(line .. "<text>" .. ways .. "</text>").skipped)
    assert.are.equal("textPath: a text has more than 64",
      letters(line .. "<text>" .. ways
      .. '<textPath href="#p">A</textPath></text>').skipped[1].what)
    assert.are.equal("side of textPath",
      letters(line .. '<text><textPath href="#p" side="right">A</textPath></text>').skipped[1].what)
    assert.are.same({},
      letters(line .. '<text><textPath href="#p" side="left">A</textPath></text>').skipped)
    assert.are.same({},
      letters(line
      .. '<text><textPath href="#p"></textPath><tspan textLength="9"></tspan></text>').skipped)
  end)

  it("is stretched to its length in its spaces, or with its glyphs", function()
    local function width(attributes, words)
      local x, _, w = letters('<text font-size="20" ' .. attributes .. ">" .. (words or "MM")
        .. "</text>").object:bounds()
      return x + w
    end
    local plain, wide = width "", width 'textLength="80"'
    assert.is_true(wide > plain + 10)
    assert.is_true(width 'textLength="80" lengthAdjust="spacing"' == wide)
    -- what is right of a glyph grows
    assert.is_true(width 'textLength="80" lengthAdjust="spacingAndGlyphs"' < wide)
    assert.are.equal(width("", "M"), width('textLength="80"', "M")) -- there is no space in it
    assert.is_true(width('textLength="80" lengthAdjust="spacingAndGlyphs"', "M")
      > 2 * width("", "M"))
    assert.are.equal(plain, width 'textLength="-1"')
    local art =
      letters('<text x="1e12" dx="1e12" font-size="20">M</text><text font-size="0">M</text><text '
      .. 'font-size="1e11">M</text>')
    assert.is_nil(art.object:bounds())
  end)

  it("of more than 100,000 characters is reported", function()
    local art = letters("<text>" .. ("A"):rep(100001) .. "</text>")
    assert.are.equal("text of more than 100000 characters", art.skipped[1].what)
  end)

  it("reports a font that is cut off", function()
    local file = assert(io.open("scripts/type/block.ttf", "rb"))
    local bytes = file:read "a"
    file:close()
    local art, message = svg.read(drawing '<text>A</text>',
      { fonts = { default = bench:write("cut.ttf", bytes:sub(1, #bytes // 2)) } })
    assert.is_nil(art)
    assert.is_truthy(message:find("cut.ttf", 1, true))
  end)
end)

local BASE64 = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"

local function base64(bytes)
  local out = {}
  for i = 1, #bytes, 3 do
    local a, b, c = bytes:byte(i, i + 2)
    local n = a << 16 | (b or 0) << 8 | (c or 0)
    for k = 0, 3 do
      local digit = n >> 18 - 6 * k & 63
      out[#out + 1] = k > 1 and i + k > #bytes + 1 and "=" or BASE64:sub(digit + 1, digit + 1)
    end
  end
  return table.concat(out)
end

--- The bytes of a picture, red on the left and blue on the right.
local function two_halves(format, w, h)
  local rostrum = celspan.rostrum { celspan.cel { celspan.rect { 0, 0, w / 2, h, texture = "#f00" },
                                                  celspan.rect { w / 2, 0, w / 2, h,
                                                    texture = "#00f" } } }
  local path = bench.folder .. "/halves." .. format
  assert(assert(celspan.pixels(rostrum, { size = { w, h }, film = { w, h } })):write(path))
  local file = assert(io.open(path, "rb"))
  local bytes = file:read "a"
  file:close()
  return bytes
end

local function embedded(bytes, attributes)
  return ('<image %s href="data:image/png;base64,%s"/>')
    :format(attributes or 'width="100" height="100"', base64(bytes))
end

describe("an image", function()
  it("may be a picture in the file itself, of any format with sRGB codes", function()
    local art = read(embedded(two_halves("png", 16, 16)))
    assert.are.same({}, art.skipped)
    assert.are.equal("ff0000 255", at(art.object, 25, 50))
    assert.are.equal("0000ff 255", at(art.object, 75, 50))
    for _, format in ipairs { "jpg", "tga", "tif" } do
      art = read(embedded(two_halves(format, 32, 32)))
      assert.are.same({}, art.skipped)
      local left, right = at(art.object, 20, 50), at(art.object, 80, 50)
      assert.is_truthy(left:find "^f[c-f]0[0-3]0[0-3] 255$", left)
      assert.is_truthy(right:find "^0[0-3]0[0-3]f[c-f] 255$", right)
    end
  end)

  it("may have codes of 16 bits, multiplied by alpha or not", function()
    for _, coding in ipairs { "straight", "premultiplied" } do
      local rostrum = celspan.rostrum {
        celspan.cel { celspan.rect { 0, 0, 20, 20, texture = celspan.rgb(1, 0, 0, 0.5) } } }
      local path = bench.folder .. "/deep.tif"
      assert(assert(celspan.pixels(rostrum, { size = { 20, 20 }, film = { 20, 20 } }))
        :write(path, { depth = 16, alpha = coding }))
      local art = read(embedded(assert(io.open(path, "rb")):read "a"))
      assert.are.same({}, art.skipped)
      assert.are.equal("ff0000 128", at(art.object, 50, 50), coding)
    end
  end)

  it("without codes of sRGB is reported, since it would be another picture", function()
    for _, format in ipairs { "exr", "dpx" } do
      local path = bench.folder .. "/light." .. format
      local image =
        assert(celspan.pixels(celspan.rostrum { celspan.cel {} , back = { 1, 0, 0, 1 } },
          { size = { 4, 4 } }))
      assert(image:write(path, { colour = "linear" }))
      local art = read(embedded(assert(io.open(path, "rb")):read "a"))
      assert.are.equal("image: its colours are not sRGB-coded; save it as a file beside the "
        .. "drawing",
        art.skipped[1].what, format)
    end
  end)

  it("has the given size, or derives the missing part from its own", function()
    local halves = two_halves("png", 40, 20)
    for attributes, box in pairs { [""] = { 0, 0, 40, 20 }, ['width="20"'] = { 0, 0, 20, 10 },
      ['height="5" x="3"'] = { 3, 0, 10, 5 } } do
      assert.are.same(box,
        { read(embedded(halves, attributes == "" and " " or attributes)).object:bounds() },
        attributes)
    end
    for _, attributes in ipairs { 'width="0"', 'width="9" height="0"', 'transform="scale(0)"',
      'visibility="hidden"', 'display="none"' } do
      local art = read(embedded(halves, attributes))
      assert.are.equal("000000 0", at(art.object, 5, 2), attributes)
      assert.are.same({}, art.skipped)
    end
    assert.are.same({}, read('<image/><image href=""/><image href="  "/>').skipped)
    local clip =
      '<clipPath id="c" clipPathUnits="objectBoundingBox"><rect width=".5" '
      .. 'height="1"/></clipPath><g clip-path="url(#c)">%s%s</g>'
    local whole = embedded(halves, 'width="40"')
    for _, none in ipairs { '<image/>', '<image href="data:,"/>',
      embedded(halves, 'x="90" width="0"') } do
      assert.are.equal("000000 0", at(read(clip:format(whole, none)).object, 25, 5), none)
      assert.are.equal("ff0000 255", at(read(clip:format(whole, none)).object, 15, 5), none)
    end
  end)

  it("may be a drawing that contains others, four deep", function()
    for depth = 1, 7 do
      bench:write(("deep-%d.svg"):format(depth),
        in_svg(depth == 1 and '<rect width="50" height="50" fill="red"/><foreignObject/>'
        or ('<image width="100" height="100" href="deep-%d.svg"/>'):format(depth - 1)))
    end
    local art = assert(svg.read(bench.folder .. "/deep-4.svg"))
    assert.are.equal("ff0000 255", at(art.object, 25, 25))
    assert.matches("foreignObject$", art.skipped[1].what)
    art = assert(svg.read(bench.folder .. "/deep-7.svg"))
    assert.are.equal("000000 0", at(art.object, 25, 25))
    assert.matches("drawings contain one another too deep$", art.skipped[1].what)
  end)

  it("may not be one of thousands of drawings inside drawings", function()
    local function write_images(name, shown)
      bench:write(name .. ".svg", in_svg(('<image width="9" height="9" href="%s.svg"/>')
        :format(shown):rep(40)))
    end
    bench:write("third.svg", in_svg('<rect width="5" height="5"/>'))
    write_images("second", "third")
    write_images("first", "second")
    write_images("zeroth", "first")
    assert(svg.read(bench.folder .. "/second.svg"))
    local art, message = svg.read(bench.folder .. "/zeroth.svg")
    assert.is_nil(art)
    assert.matches("zeroth.svg:%d+: more than 1000 drawings are read as images$", message)
  end)

  it("is reported if its name is too long, or its drawing has no size or is damaged", function()
    local function told(href)
      return (read(('<image width="9" height="9" href="%s"/>'):format(href)).skipped[1]
        or { what = "nothing" }).what
    end
    assert.matches("it is not a file name", told(("n"):rep(5000)))
    assert.matches("its name is too long", told(("n"):rep(4090)))
    assert.matches("File name too long", told(("n"):rep(400)))
    bench:write("inner.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="0" height="0"/>')
    assert.are.equal("nothing", told "inner.svg")
    bench:write("inner.svg", in_svg "<g>")
    assert.matches("mismatched tag", told "inner.svg")
    bench:write("inner.svg", "")
    assert.matches("^image: ", told "inner.svg")
    assert.are.equal("image no such.svg: No such file or directory", told "no such.svg")
    assert.matches("its data: address is damaged", told "data:image/png;base64")
    assert.matches("^image: ", told "data:image/png%20;base64,AAAA")
  end)

  it("is sliced or fitted to its place", function()
    local halves = two_halves("png", 40, 20)
    local art = read(embedded(halves, 'x="20" y="20" width="40" height="40"'))
    assert.are.same({ 20, 30, 40, 20 }, { art.object:bounds() })
    art =
      read(embedded(halves,
        'x="20" y="20" width="40" height="40" preserveAspectRatio="xMinYMid slice"'))
    assert.are.same({ 20, 20, 40, 40 }, { art.object:bounds() })
    assert.are.equal("ff0000 255", at(art.object, 58, 21))
    assert.are.equal("000000 0", at(art.object, 61, 40))
    art = read(embedded(halves, 'x="20" y="20" width="40" height="40" preserveAspectRatio="none"'))
    assert.are.equal("0000ff 255", at(art.object, 45, 21))
  end)

  it("has a box for clip paths and masks", function()
    local art =
      read('<clipPath id="c" clipPathUnits="objectBoundingBox"><rect width=".5" '
      .. 'height="1"/></clipPath>'
      .. embedded(two_halves("png", 8, 8),
        'x="20" y="20" width="40" height="40" clip-path="url(#c)"'))
    assert.are.equal("ff0000 255", at(art.object, 30, 40))
    assert.are.equal("000000 0", at(art.object, 50, 40))
  end)

  it("is read once, however often use shows it", function()
    local uses = {}
    for i = 1, 300 do uses[i] = ('<use href="#i" x="%d"/>'):format(i % 50) end
    -- 300 times 4 MiB would be more than all images of a drawing may have
    local art = read("<defs>" .. embedded(two_halves("png", 1024, 1024),
      'id="i" width="10" height="10"') .. "</defs>"
      .. table.concat(uses))
    assert.are.same({}, art.skipped)
    assert.are.equal("ff0000 255", at(art.object, 2, 5))
    assert.are.equal("0000ff 255", at(art.object, 58, 5))
    art = read('<defs><image id="i" href="data:,"/></defs><use href="#i"/><use href="#i"/>')
    assert.are.equal(1, #art.skipped)
  end)

  it("that is cut off, or invalid, is reported", function()
    for _, format in ipairs { "png", "jpg" } do
      local bytes = two_halves(format, 32, 32)
      for _, size in ipairs { 3, 20, 40, #bytes // 2 } do
        local art = read(embedded(bytes:sub(1, size)) .. '<rect width="9" height="9" fill="lime"/>')
        assert.are.equal(1, #art.skipped, format .. " " .. size)
        assert.is_truthy(art.skipped[1].what:find("^image: "), art.skipped[1].what)
        assert.is_nil(art.skipped[1].what:find("/proc", 1, true))
        assert.are.equal("00ff00 255", at(art.object, 5, 5))
      end
    end
    local art = read(('<image width="9" height="9" href="data:image/png;base64,%s"/>')
      :format(("QUFB"):rep(5000000)))
    assert.are.equal(1, #art.skipped)
    for _, data in ipairs { "iVBO$$$$", "iVBO%00", "iVBO%00Rw0K", "iVBOR", "iVBOR=" } do
      art = read(('<image width="9" height="9" href="data:image/png;base64,%s"/>'):format(data))
      assert.are.equal("image: its data: address is damaged", art.skipped[1].what, data)
    end
  end)

  it("is never read from outside the drawing's folder", function()
    local folder = bench.folder .. "/inside"
    assert(os.execute(("mkdir -p '%s/deep' && ln -sf /etc '%s/etc' && ln -sf ../secret.svg "
      .. "'%s/out.svg' && ln -sf deep/in.svg '%s/in.svg'")
      :format(folder, folder, folder, folder)))
    local secret =
      '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><rect width="9" height="9" '
      .. 'fill="red"/></svg>'
    bench:write("secret.svg", secret)
    bench:write("inside/deep/in.svg", secret)
    local tries = { "out.svg", "etc/hostname", "../secret.svg", "%2e%2e/secret.svg",
      "deep/../../secret.svg",
      "deep/%2E%2e/../secret.svg", "file:///etc/hostname", "//etc/hostname", "/etc/hostname",
      "https://a.b/c.png",
      "%00", "deep", "in.svg%00.png" }
    for i, href in ipairs(tries) do
      local path = bench:write("inside/try.svg",
        in_svg(('<image width="50" height="50" href="%s"/><!-- %d -->'):format(href, i)))
      local art = assert(svg.read(path))
      assert.are.equal(1, #art.skipped, href)
      assert.are.equal("000000 0", at(art.object, 5, 5))
    end
    for _, href in ipairs { "deep/in.svg", "in.svg", "./deep/in.svg" } do
      local path = bench:write("inside/try.svg",
        in_svg(('<image width="50" height="50" href="%s"/>'):format(href)))
      assert.are.equal("ff0000 255", at(assert(svg.read(path)).object, 5, 5), href)
    end
  end)

  it("may be a drawing in the file itself, in its place", function()
    local art =
      read([[<image x="20" width="40" height="40" href="data:image/svg+xml,%3Csvg ]]
      .. [[xmlns='http://www.w3.org/2000/svg' width='1' height='1'%3E%3Crect width='9' height='9' ]]
      .. [[fill='red'/%3E%3C/svg%3E"/>]])
    assert.are.same({}, art.skipped)
    assert.are.equal("ff0000 255", at(art.object, 50, 20))
    assert.are.equal("000000 0", at(art.object, 70, 20))
  end)

  it("is reported if it may not be read", function()
    local art = read [[<image href="../a.png"/><image href="/etc/passwd"/><image
      href="http://a.b/c.png"/>
<image href="data:image/png;base64,iVBORw0KGgo="/><image href="data:,"/>]]
    assert.are.equal(5, #art.skipped)
    assert.is_truthy(art.skipped[1].what:find("its name has ..", 1, true))
    assert.is_truthy(art.skipped[2].what:find("its name is absolute", 1, true))
    assert.is_truthy(art.skipped[3].what:find("it is an address", 1, true))
    assert.is_truthy(art.skipped[4].what:find("ends too early", 1, true))
  end)

  it("of the drawing itself is not drawn again", function()
    local path = bench:write("itself.svg",
      in_svg '<image width="50" height="50" href="itself.svg"/>')
    assert.are.equal("image: the drawing contains itself", assert(svg.read(path)).skipped[1].what)
  end)
end)
