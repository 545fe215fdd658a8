-- The short form of a film: what a frame may be, other spellings, and names without a prefix.
local celspan = require "celspan"
local own = require "tests.support.own"
local native = own "celspan.native"
local raised = require "tests.support.raised"

local dot = celspan.circle { 8, 8, 5, fill = "tomato" }:named "dot"
local sky = celspan.cel { celspan.rect { 0, 0, 16, 16, fill = "navy" } }:named "sky"

--- A film whose frames are `shown`.
local function film_of(shown, fields)
  local form = { size = { 16, 16 }, frames = 2, frame = function() return shown end }
  for name, value in pairs(fields or {}) do form[name] = value end
  return celspan.film(form)
end

local function pixels(what)
  return celspan.pixels(what, { size = { 16, 16 } }):bytes { depth = 8 }
end

--- The message of a frame, which must have the line of film_of.
local function refusal(shown, fields)
  local message = raised.message(function() film_of(shown, fields):at(2) end)
  assert.is_truthy(message:find("short_spec.lua:%d+: frame 2: "), message)
  return (message:gsub("^.-frame 2: ", ""):gsub(" %(called from.*", ""))
end

describe("a frame", function()
  it("may be an object, a cel or a list, which is a rostrum with a cel for each", function()
    local plain = celspan.rostrum { celspan.cel { dot } }
    local both = celspan.rostrum { sky, celspan.cel { dot } }
    for _, shown in ipairs { dot, celspan.cel { dot }, { dot }, { nil, false, { { dot } } } } do
      assert.is_true(pixels(film_of(shown)) == pixels(film_of(plain)))
      assert.is_true(pixels(shown) == pixels(plain))
    end
    local list = film_of { sky, false, { dot } }:at(1)
    assert.are.equal(2, #list)
    assert.are.same({ "sky", "dot", dot.origin }, { list[1].name, list[2].name, list[2].origin })
    assert.is_true(pixels(list) == pixels(both))
    assert.are.equal(0, #film_of({}):at(1))
  end)

  it("may be a list with the fields of a rostrum", function()
    local camera = { centre = { 8, 8 }, width = 8 }
    local shown = { sky, dot, camera = camera, back = "white" }
    local meant = celspan.rostrum { sky, celspan.cel { dot }, camera = camera, back = "#fff" }
    assert.is_true(pixels(film_of(shown)) == pixels(film_of(meant)))
    assert.are.equal(8, film_of(shown):at(1).camera.width)
  end)

  it("shows a rostrum with a size as an object in a list", function()
    local panel = celspan.rostrum { size = { 8, 8 }, celspan.cel { dot } }:named "panel"
    local made = film_of { sky, panel }:at(1)
    assert.are.equal("panel", made[2].name)
    assert.is_true(pixels(made) == pixels(celspan.rostrum { sky, celspan.cel { panel } }))
    assert.matches("size is missing", refusal { sky, celspan.rostrum {} })
  end)

  it("may be exposures of anything", function()
    local plain = celspan.rostrum { celspan.cel { dot } }
    local list = film_of { { { sky, dot }, 0.5 }, { dot, 0.25 }, { plain } }:at(1)
    assert.are.same({ 0.5, 0.25 }, { list[1][2], list[2][2], list[3][2] })
    assert.are.same({ 3, 2, 1, 1 }, { #list, #list[1][1], #list[2][1], #list[3][1] })
  end)

  it("says what is wrong in it, with its line", function()
    local wanted = " must be a rostrum, an object, a cel or a list of them, got "
    local name = "the frame function's result"
    assert.are.equal(name .. wanted .. "number", refusal(7))
    assert.are.equal(name .. wanted .. "nil", refusal(nil))
    assert.are.equal(name .. ": item 2: item 1" .. wanted .. "string", refusal { dot, { "#fff" } })
    assert.are.equal(name .. ": item 1: item 1" .. wanted .. "number", refusal { { 1, 1, 1 }, dot })
    assert.matches("item 2 has the field 'fill'; lights, a camera and other fields belong to the "
      .. "whole list", refusal { dot, { fill = "white", gain = 2 } }, 1, true)
    assert.matches("rostrum: unknown field 'camrea'; did you mean 'camera'?",
      refusal { dot, camrea = {} }, 1, true)
    assert.matches("exposure 1: its weight must be a number, got string",
      refusal { { celspan.rostrum {}, "x" } }, 1, true)
    local deep = { dot }
    for _ = 1, 20 do deep = { deep } end
    assert.matches("lists in lists that are too deep", refusal(deep))
    assert.matches("a list that is too long", refusal { [200000] = dot })
  end)

  it("is the same in a shot, a transition, a plane and a shutter", function()
    local cut, shutter = require "celspan.cut", require "celspan.shutter"
    local multiplane = require "celspan.multiplane"
    local plain = film_of(celspan.rostrum { sky, celspan.cel { dot } }, { fps = 2 })
    local short = film_of({ sky, dot }, { fps = 2 })
    local function joined(film) return cut { film, cut.dissolve(0.5), film } end
    for n = 1, 3 do
      assert.is_true(pixels(joined(plain):at(n)) == pixels(joined(short):at(n)))
    end
    local with = cut.with(function(a, b) return { a, b } end)
    local over = cut { plain, with(0.5), plain, over = function() return dot end }
    assert.are.equal(2, #over:at(2)[1][1])
    local planes = multiplane { film = { 16, 16 }, { { sky, dot }, z = 5 }, { dot }, over = dot }
    assert.are.equal(4, #planes)
    assert.matches("plane 1 must be", raised.message(multiplane, { film = { 1, 1 }, { 5 } }))
    local blurred = film_of(nil,
      { frame = shutter { samples = 2, frame = function() return dot end } })
    assert.are.same({ 0.5, 0.5 }, { blurred:at(1)[1][2], blurred:at(1)[2][2] })
  end)
end)

describe("a background", function()
  it("covers each frame behind everything, whatever the camera shows", function()
    local turned = { centre = { 50, 9 }, width = 40, rotate = 30 }
    for _, camera in ipairs { false, { width = 4 }, turned } do
      for _, kernel in ipairs { "area", { kernel = "gaussian" } } do
        local shown = { front = "black", antialias = kernel, camera = camera or nil }
        local film = film_of(shown, { background = "tomato" })
        assert.is_true(pixels(film) == pixels(celspan.rostrum { back = "tomato" }))
        assert.are.equal("background", film:at(1)[1].name)
      end
    end
  end)

  it("is a gradient, a colour or a picture, under each exposure", function()
    local blend = celspan.linear { from = { 0, 0 }, to = { 16, 0 }, { 0, "#000" }, { 1, "#fff" } }
    local sheet = celspan.rect { 0, 0, 16, 16, fill = blend }
    assert.is_true(pixels(film_of(dot, { background = blend })) == pixels { sheet, dot })
    local list = film_of({ { dot, 0.5 }, { sky, 0.5 } }, { background = "red" }):at(1)
    assert.are.same({ 2, 2, 0.5 }, { #list[1][1], #list[2][1], list[2][2] })
    assert.matches("field 'background' must be a paint, a texture or a colour",
      raised.message(film_of, dot, { background = dot }))
  end)
end)

describe("another spelling", function()
  it("of a field means the same, and is read and printed as celspan's", function()
    local short = celspan.circle { center = { 8, 8 }, radius = 5, fill = "#ff6347" }
    local long = celspan.circle { centre = { 8, 8 }, radius = 5, texture = "#ff6347" }
    assert.are.equal(tostring(long), tostring(short))
    assert.is_true(pixels(short) == pixels(long))
    assert.are.same({ long.centre, "#ff6347", "#ff6347" }, { short.center, short.fill, long.fill })
    assert.are.same({ short.centre, "#ff6347" }, { long.center, short.texture })
    assert.are.equal("gold", long:with { fill = "gold" }.texture)
    assert.are.same({ 1, 2 }, celspan.rostrum { camera = { center = { 1, 2 } } }.camera.center)
    local noise = celspan.noise { colors = { "red", "gray" } }
    assert.are.same({ "red", "gray" }, noise.colours)
  end)

  it("is known in the library, in modules and as a word", function()
    local cut, chart = require "celspan.cut", require "celspan.chart"
    assert.is_truthy(cut.iris { center = { 3, 4 } })
    assert.is_truthy(chart { kind = "pie", data = { 1, 2 }, box = { 0, 0, 9, 9 },
                             colors = { "red" } })
    assert.are.equal(require "celspan.colour", require "celspan.color")
    local box = { 0, 0, 40, 40 }
    assert.are.same({ celspan.align(dot, box, "centre"):bounds() },
      { celspan.align(dot, box, "center"):bounds() })
    assert.is_truthy(celspan.brush { d = "M0 0H9", fill = "red" })
    assert.are.same({ celspan.star { center = { 1, 2 }, outer = 4, inner = 2 }:bounds() },
      { celspan.star { 1, 2, 4, 2 }:bounds() })
    assert.is_nil(native.synonym("mark", true))
  end)

  it("may not be beside celspan's own", function()
    raised.each {
      ["circle: 'fill' and 'texture' are one field: give one of them"] = function()
        celspan.circle { centre = { 1, 2 }, radius = 3, fill = "red", texture = "red" }
      end,
      ["rostrum: camera: 'center' and 'centre' are one field"] = function()
        celspan.rostrum { camera = { center = { 1, 2 }, centre = { 1, 2 } } }
      end,
      ["chart: 'colors' and 'colours' are one field"] = function()
        (require "celspan.chart") { kind = "pie", colors = {}, colours = {} }
      end,
      ["rect: unknown field 'color'; did you mean 'fill'?"] = function()
        celspan.rect { 1, 2, 3, 4, color = "red" }
      end,
    }
  end)

  it("is not for words that a script chose", function()
    local film = film_of(dot, { marks = { center = 2 } })
    assert.are.same({ center = 2 }, film.marks)
  end)
end)

describe("a primitive", function()
  it("takes its place by numbers", function()
    local circle, ellipse = celspan.circle { 1, 2, 3, fill = "red" }, celspan.ellipse { 1, 2, 3, 4 }
    assert.are.equal("circle{ centre = {1, 2}, radius = 3 }", tostring(circle))
    assert.are.equal("ellipse{ centre = {1, 2}, radii = {3, 4} }", tostring(ellipse))
    assert.are.equal("circle{ centre = {5, 6}, radius = 7 }", tostring(circle:with { 5, 6, 7 }))
    assert.are.equal("red", circle:with { 5, 6, 7 }.fill)
  end)

  it("refuses other numbers of them, and a field given twice", function()
    raised.each {
      ["circle: takes {x, y, r}, got 2 values"] = function() celspan.circle { 1, 2 } end,
      ["ellipse: takes {x, y, rx, ry}, got 3 values"] = function() celspan.ellipse { 1, 2, 3 } end,
      ["text: takes {text, x, y}, got 2 values"] = function() celspan.text { "a", 1 } end,
      ["circle: field 'radius' is given by its place, too"] = function()
        celspan.circle { 1, 2, 3, radius = 3 }
      end,
      ["circle: centre[1] must be a number, got string"] = function()
        celspan.circle { "1", 2, 3 }
      end,
      ["star: takes {x, y, outer [, inner]} by place, got 2 values"] = function()
        celspan.star { 1, 2 }
      end,
      ["star: field 'outer' is given by its place, too"] = function()
        celspan.star { 1, 2, 3, outer = 4 }
      end,
    }
  end)
end)

describe("the name of a colour", function()
  it("is one of CSS, in any case of letters", function()
    for name, code in pairs { tomato = "#ff6347", RebeccaPurple = "#663399", Gray = "#808080" } do
      assert.are.same(celspan.rgb(code).pigment, celspan.rgb(name).pigment)
      assert.are.equal(code, native.hex(name))
    end
    assert.is_true(pixels(celspan.circle { 8, 8, 5, fill = "transparent" })
      == pixels(celspan.circle { 8, 8, 5, fill = celspan.clear }))
    assert.are.same(celspan.rgb("#0f0").pigment, celspan.mix("lime", "red", 0).pigment)
    assert.are.same({ 1, 0, 0 }, celspan.paint { pigment = "red" }.pigment)
  end)

  it("that nobody knows is refused with the nearest", function()
    raised.each {
      ['rect: field \'fill\' must be a paint, a texture or a colour like "#rrggbb", got "redd"; '
        .. 'did you mean "red"?'] = function() celspan.rect { 0, 0, 1, 1, fill = "redd" } end,
      ['rgb: takes numbers or a colour like "#rrggbb", got "tomatoe"; did you mean "tomato"?']
        = function() celspan.rgb "tomatoe" end,
      ['got "blu"; did you mean "blue"?'] = function() celspan.cel { front = "blu" } end,
      ['got "rde"; did you mean "red"?'] = function()
        celspan.linear { from = { 0, 0 }, to = { 1, 1 }, { 0, "rde" } }
      end,
      ['got "evenodd"; write rule = "evenodd"'] = function()
        celspan.path { d = "M0 0L1 1L2 0", fill = "evenodd" }
      end,
    }
  end)

  it("is a word among keys, and a colour in a parameter", function()
    local keys = require "celspan.keys"
    assert.are.equal("red", keys { { 0, "red" }, { 1, "tomato" } } :at(0.5))
  end)
end)

describe("celspan.names", function()
  local function run(text, globals)
    return load("local celspan = require 'celspan'\nlocal _ENV = celspan.names(_ENV)\n" .. text,
      nil, "t", setmetatable(globals or {}, { __index = _G }))
  end

  it("finds globals, then celspan's functions, then modules", function()
    assert.are.equal(celspan.circle, run("return circle")())
    assert.are.equal(require "celspan.ease", run("return ease")())
    assert.are.equal(require "celspan.colour", run("return color")())
    assert.are.equal(celspan.star, run("return star")())
    assert.are.equal(celspan, run("return celspan")())
    assert.are.equal(math, run("return math")())
    assert.are.equal(5, run("return circle", { circle = 5 })())
    assert.is_nil(run("return jit")())
    assert.is_nil(run("return sheet")()) -- a module that is for require
  end)

  it("leaves a global that the file assigns to the file", function()
    local globals = {}
    assert.are.equal(1, run("count = (count or 0) + 1 return count", globals)())
    assert.are.equal(1, globals.count)
    assert.is_nil(run("local function set() text = 1 end return text")())
  end)

  it("refuses what is no table", function()
    raised.each { ["names: takes the globals, celspan.names(_ENV), got nil"] = function()
      celspan.names()
    end }
  end)
end)
