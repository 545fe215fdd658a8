-- Scene values: immutable, readable, copied with changes, combined by operators.
local celspan = require "celspan"
local raised = require "tests.support.raised"

local function disc(x, radius)
  return celspan.circle { centre = { x or 0, 0 }, radius = radius or 10, texture = "#ff8800" }
end

describe("a value", function()
  it("refuses assignment and suggests what to do", function()
    local message = raised.message(function() disc().radius = 3 end)
    assert.is_truthy(message:find("circles are immutable; use :with{...}", 1, true))
    message = raised.message(function() celspan.cel {}.front = "#fff" end)
    assert.is_truthy(message:find("cels are immutable; use :with{...}", 1, true))
  end)

  it("can be read, presets included", function()
    local circle = disc(3, 4)
    assert.are.equal(4, circle.radius)
    assert.are.same({ 3, 0 }, circle.centre)
    assert.are.equal("#ff8800", circle.texture)
    local nurbs = celspan.nurbs { points = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1, 2 } } }
    assert.are.same({ 3, "periodic", "nonzero" }, { nurbs.degree, nurbs.closed, nurbs.rule })
    assert.are.equal(2, nurbs.points[4][3])
    assert.is_nil(nurbs.knots)
  end)

  it("returns copies of its tables", function()
    local circle = disc(3)
    circle.centre[1] = 99
    assert.are.same({ 3, 0 }, circle.centre)
  end)

  it("does not change with the table it was made from", function()
    local fields = { centre = { 1, 2 }, radius = 3 }
    local circle = celspan.circle(fields)
    fields.radius, fields.centre[1] = 50, 50
    assert.are.equal(3, circle.radius)
    assert.are.same({ 1, 2 }, circle.centre)
    assert.are.same({ -2, -1, 6, 6 }, { circle:bounds() })
  end)

  it("describes itself by kind and key numbers", function()
    assert.are.equal("circle{ centre = {3, 0}, radius = 4 }", tostring(disc(3, 4)))
    assert.are.equal("rect{ 1, 2, 3, 4, radius = 0 }", tostring(celspan.rect { 1, 2, 3, 4 }))
    assert.are.equal("union{ 2 objects }", tostring(disc() | disc()))
    assert.are.equal("cel{ 1 object, opacity = 1 }", tostring(celspan.cel { disc() }))
  end)
end)

describe("with", function()
  it("copies with changes and does not change the original", function()
    local small = disc(0, 5)
    local large = small:with { radius = 50 }
    assert.are.same({ 5, 50 }, { small.radius, large.radius })
    assert.are.equal("#ff8800", large.texture)
    assert.are.same({ -50, -50, 100, 100 }, { large:bounds() })
  end)

  it("keeps the transform", function()
    local moved = disc(0, 5):translate(100, 0):scale(2):with { radius = 10 }
    assert.are.same({ 180, -20, 40, 40 }, { moved:bounds() })
  end)

  it("replaces the list of a cel as a whole", function()
    local cel = celspan.cel { disc(), disc(), opacity = 0.5 }
    local other = cel:with { disc(7) }
    assert.is_nil(other[2])
    assert.are.same({ 7, 0 }, other[1].centre)
    assert.are.equal(0.5, other.opacity)
  end)

  it("changes the parts of a rectangle one by one", function()
    local wide = celspan.rect { 1, 2, 3, 4 }:with { [3] = 30 }
    assert.are.same({ 1, 2, 30, 4 }, { wide:bounds() })
  end)

  it("works for paints, textures, cels and rostrums", function()
    assert.are.equal(0.25, celspan.rgb(1, 0, 0):with { beta = 0.25 }.beta)
    local ramp = celspan.linear { from = { 0, 0 }, to = { 9, 0 }, { 0, "#000" }, { 1, "#fff" } }
    assert.are.same({ 5, 0 }, ramp:with { to = { 5, 0 } }.to)
    assert.are.equal(2, celspan.rostrum {}:with { brightness = 2 }.brightness)
  end)
end)

describe("operators", function()
  local a, b, c = disc(0), disc(5), disc(10)

  it("flatten chains in order", function()
    for _, chain in ipairs { a | b | c, a & b & c, a - b - c, a ~ b ~ c } do
      assert.are.same({ { 0, 0 }, { 5, 0 }, { 10, 0 } },
        { chain[1].centre, chain[2].centre, chain[3].centre })
      assert.is_nil(chain[4])
    end
  end)

  it("are equivalent to the named functions", function()
    assert.are.equal("union{ 2 objects }", tostring(a | b))
    assert.are.equal("intersection{ 2 objects }", tostring(a & b))
    assert.are.equal("difference{ 2 objects }", tostring(a - b))
    assert.are.equal("xor{ 2 objects }", tostring(a ~ b))
  end)

  it("do not flatten moved or named operands", function()
    assert.are.equal("union{ 2 objects }", tostring((a | b):translate(1, 0) | c))
    assert.are.equal("xor{ 2 objects }", tostring(celspan.xor { a, b } ~ c))
  end)

  it("branch from one beginning", function()
    local function parts(value)
      local list = {}
      while value[#list + 1] do list[#list + 1] = value[#list + 1] end
      return list
    end
    local base = a | b | c
    local one, other = base | a, base | b
    local moved = one:translate(1, 0)
    local longer = one | b
    assert.are.same({ 3, 4, 4, 4, 5 }, { #parts(base), #parts(one), #parts(other), #parts(moved),
                                         #parts(longer) })
    assert.are.equal(a, one[4])
    assert.are.equal(b, other[4])
    assert.is_nil(base[4])
    assert.is_nil(moved[5])
    assert.are.equal("union{ 3 objects }", tostring(base))
    assert.are.equal("union{ 4 objects }", tostring(one:with {}))
    assert.are.equal("union{ 2 objects }", tostring(longer:with { a, b }))
  end)

  it("need memory that grows linearly with the length of a chain", function()
    local function bytes(operate, count)
      collectgarbage()
      collectgarbage "stop"
      local before, chain = collectgarbage "count", a
      for _ = 2, count do chain = operate(chain, b) end
      local after = collectgarbage "count"
      collectgarbage "restart"
      assert.are.equal(b, chain[count])
      return after - before
    end
    for _, operate in ipairs { function(x, y) return x | y end, function(x, y) return x & y end,
                               function(x, y) return x - y end, function(x, y) return x ~ y end } do
      -- copying all operands at each step would take sixty times as much
      assert.is_true(bytes(operate, 8000) < 9 * bytes(operate, 1000))
    end
  end)

  it("have the precedence of Lua: - & ~ |", function()
    assert.are.equal("difference{ 2 objects }", tostring((a | b - c)[2]))
  end)
end)

describe("transforms", function()
  local square = celspan.rect { 0, 0, 10, 20 }

  local function box(value)
    return { value:bounds() }
  end

  it("return new values, applied in order", function()
    assert.are.same({ 3, 4, 10, 20 }, box(square:translate(3, 4)))
    assert.are.same({ 6, 8, 20, 40 }, box(square:translate(3, 4):scale(2)))
    assert.are.same({ 0, 0, 10, 20 }, box(square))
  end)

  it("rotate by quarters exactly, clockwise on screen", function()
    assert.are.same({ -20, 0, 20, 10 }, box(square:rotate(90)))
    assert.are.same({ -10, -20, 10, 20 }, box(square:rotate(180)))
    assert.are.same({ 0, -10, 20, 10 }, box(square:rotate(-90)))
    assert.are.same({ 0, 0, 10, 20 }, box(square:rotate(360)))
    assert.are.same(box(square:rotate(90)), box(square:rotate(-270)))
  end)

  it("rotate around a centre", function()
    assert.are.same({ -5, 5, 20, 10 }, box(square:rotate(90, 5, 10)))
  end)

  it("accept matrices row by row", function()
    assert.are.same({ 7, 8, 20, 60 }, box(square:transform { 2, 0, 7, 0, 3, 8, 0, 0, 1 }))
  end)

  it("map four points to four others", function()
    local from = { { 0, 0 }, { 10, 0 }, { 10, 20 }, { 0, 20 } }
    local to = { { 100, 0 }, { 120, 0 }, { 120, 40 }, { 100, 40 } }
    local x, y, w, h = square:quad(from, to):bounds()
    assert.is_true(math.abs(x - 100) + math.abs(y) + math.abs(w - 20) + math.abs(h - 40) < 1e-9)
  end)

  it("apply to :contains", function()
    assert.is_true(square:translate(100, 0):contains(105, 5))
    assert.is_false(square:translate(100, 0):contains(5, 5))
  end)

  it("allow a scale of 0, which draws nothing", function()
    assert.is_nil(square:scale(0):bounds())
  end)
end)

describe("paints", function()
  it("are read back unchanged", function()
    local paint = celspan.rgb(0.1, 0.2, 0.3, 0.4)
    assert.are.same({ 0.1, 0.2, 0.3 }, paint.pigment)
    assert.are.same({ 1, 1, 1 }, paint.medium)
    assert.are.equal(0.4, paint.beta)
    assert.are.equal(0, celspan.gel(1, 0, 0).beta)
    assert.are.equal(0, celspan.clear.beta)
  end)

  it("return defaults for omitted fields", function()
    local paint = celspan.paint {}
    assert.are.same({ { 0, 0, 0 }, { 1, 1, 1 }, 1 }, { paint.pigment, paint.medium, paint.beta })
    assert.are.same({ 1, 1, 1 }, paint:with { pigment = { 0, 1, 0 } }.medium)
    assert.are.equal("#000000", celspan.circle { centre = { 0, 0 }, radius = 1 }.texture)
  end)

  it("mix premultiplied", function()
    local half = celspan.mix(celspan.rgb(1, 0, 0), celspan.clear, 0.5)
    assert.are.same({ 1, 0, 0 }, half.pigment)
    assert.are.equal(0.5, half.beta)
  end)
end)

describe("the parts of a value", function()
  it("are counted, walked and unpacked", function()
    local a, b = disc(1), disc(2)
    local cases = {
      { celspan.union { a, b, a }, 3 }, { a - b - a, 3 }, { celspan.cel { a, b }, 2 },
      { celspan.rostrum { celspan.cel {} }, 1 }, { celspan.rect { 1, 2, 3, 4 }, 4 },
      { celspan.polygon { { 0, 0 }, { 1, 0 }, { 1, 1 } }, 3 }, { a, 0 }, { celspan.clip(a, b), 2 },
      { celspan.linear { from = { 0, 0 }, to = { 1, 0 }, { 0, "#000" }, { 1, "#fff" } }, 2 },
      { celspan.clear, 0 }, { celspan.union {}, 0 },
    }
    for i, case in ipairs(cases) do
      local value, count = case[1], case[2]
      assert.are.equal(count, #value, i)
      assert.are.equal(count, select("#", table.unpack(value)), i)
      local walked = 0
      for _ in ipairs(value) do walked = walked + 1 end
      assert.are.equal(count, walked, i)
    end
    assert.are.same({ 1, 2, 3, 4 }, { table.unpack(celspan.rect { 1, 2, 3, 4 }) })
    assert.are.equal(2, select(2, table.unpack(celspan.union { a, b })).centre[1])
  end)

  it("of a chain belong to it", function()
    local pair = disc(1) | disc(2)
    local three = pair | disc(3)
    assert.are.same({ 2, 3 }, { #pair, #three })
    assert.are.same({ 3, 2 }, { #(three:translate(1, 1)), #(pair:fade(0.5)) })
    assert.are.equal(1, #three:with { disc(9) })
  end)
end)

describe("a fade", function()
  -- The opacity at the middle of a white disc on black.
  local function shown(value)
    local cel = tostring(value):find "^cel" and value or celspan.cel { value }
    local r, _, _, a = assert(celspan.probe(celspan.rostrum { cel }, 50, 50,
      { film = { 100, 100 } }))
    assert.are.equal(r, a)
    return a
  end

  it("is kept by one :with and by the next, and multiplies", function()
    local circle = celspan.circle { centre = { 50, 50 }, radius = 9, texture = "#fff" }
    for _, value in ipairs { circle, circle | circle:translate(1, 0), celspan.cel { circle } } do
      local faded = value:fade(0.5)
      assert.are.equal(0.5, shown(faded))
      assert.are.equal(0.5, shown(faded:with {}))
      assert.are.equal(0.5, shown(faded:with {}:with {}))
      assert.are.equal(0.25, shown(faded:with {}:fade(0.5):with {}))
      assert.are.equal(0.25, shown(faded:fade(0.5):with {}))
    end
  end)

  it("and an opacity and a mix are limited to 0..1, because curves overshoot", function()
    local circle = celspan.circle { centre = { 50, 50 }, radius = 9, texture = "#fff" }
    for _, value in ipairs { circle, celspan.cel { circle } } do
      assert.are.equal(1, shown(value:fade(1.1)))
      assert.are.equal(0, shown(value:fade(-0.1)))
      assert.are.equal(0.5, shown(value:fade(1.1):with {}:fade(0.5):with {}))
    end
    assert.are.equal(1, shown(celspan.cel { circle, opacity = 1.02 }))
    assert.are.equal(0, shown(celspan.cel { circle, opacity = -0.01 }))
    assert.are.equal(1, celspan.mix("#000", "#fff", 1.02).pigment[1])
  end)
end)

describe("object:paint", function()
  local function at(object, x, y)
    return { assert(celspan.probe(celspan.rostrum { celspan.cel { object } }, x, y,
      { film = { 40, 40 } })) }
  end

  local fruit = (celspan.circle { centre = { 20, 20 }, radius = 9, texture = "#0f0" }
    | celspan.rect { 18, 4, 4, 10, texture = "#00f" }) - celspan.rect { 18, 18, 4, 4 }

  it("is the whole shape in one texture", function()
    local painted = fruit:paint "#f00"
    for _, place in ipairs { { 20, 28 }, { 20, 6 } } do
      assert.are.same({ 1, 0, 0, 1 }, at(painted, place[1], place[2]))
    end
    assert.are.same({ 0, 0, 0, 0 }, at(painted, 20, 20))
    assert.are.same({ 0, 0, 0, 0 }, at(painted, 2, 2))
    assert.are.same({ fruit:bounds() }, { painted:bounds() })
  end)

  it("keeps the fade and the name, and may be moved and painted again", function()
    local painted = fruit:fade(0.5):named("fruit"):paint "#f00"
    assert.are.equal("fruit", painted.name)
    assert.are.same({ 0.5, 0, 0, 0.5 }, at(painted, 20, 28))
    assert.are.same({ 0.5, 0.5, 0.5, 0.5 }, at(painted:paint("#fff"):translate(5, 0), 25, 28))
  end)

  it("puts the texture into the units around the object", function()
    local wash = celspan.linear { from = { 0, 0 }, to = { 40, 0 }, { 0, "#000" }, { 1, "#fff" } }
    local r = at(celspan.rect { 0, 0, 10, 10 }:translate(20, 20):paint(wash), 28, 25)[1]
    assert.is_true(math.abs(r - 0.7) < 1e-6)
  end)

  it("is nothing of nothing, and refuses what is no texture", function()
    assert.are.equal(0, #{ celspan.union {}:paint("#f00"):bounds() })
    for _, given in ipairs { { "redd" }, { 3 }, {} } do
      assert.is_truthy(raised.message(function() fruit:paint(given[1]) end):find(
        "' must be a paint, a texture or a colour", 1, true))
    end
    assert.is_truthy(raised.message(function() fruit:with { texture = "#f00" } end):find(
      "write object:paint(fill)", 1, true))
  end)
end)

describe("a colour as a string", function()
  it("makes the same paints as numbers", function()
    local orange = celspan.rgb("#ff8000").pigment
    assert.are.same(orange, celspan.paint { pigment = "#ff8000" }.pigment)
    assert.are.same(orange, celspan.gel("#ff8000").medium)
    assert.are.same(orange, celspan.paint { medium = "#ff8000" }.medium)
    assert.are.same({ 0, 0, 0 }, celspan.gel("#ff8000").pigment)
    assert.are.equal(0, celspan.gel("#ff8000").beta)
    assert.are.same({ 1, 1, 1 }, celspan.rgb("#ff8000").medium)
    assert.are.equal(0.5, celspan.paint { pigment = "#f80" }:with { beta = 0.5 }.beta)
  end)

  it("includes its alpha, unless one is given", function()
    assert.is_true(math.abs(celspan.rgb("#ff800080").beta - 128 / 255) < 1e-6)
    assert.are.equal(0.25, celspan.rgb("#ff800080", 0.25).beta)
    assert.are.equal(0.25, celspan.rgb("#ff8000", 0.25).beta)
    local half = celspan.gel("#00000080").medium
    assert.is_true(math.abs(half[1] - 127 / 255) < 1e-6)
  end)

  it("is refused if it is invalid, or has an alpha where none is possible", function()
    local function sentence(call, ...)
      local arguments = table.pack(...)
      return (raised.sentence(function() call(table.unpack(arguments)) end))
    end
    assert.are.equal('rgb: takes numbers or a colour like "#rrggbb", got "redd"; did you mean '
      .. '"red"?', sentence(celspan.rgb, "redd"))
    assert.are.equal('gel: takes numbers or a colour like "#rrggbb", got "#12"',
      sentence(celspan.gel, "#12"))
    assert.are.equal('paint: field \'pigment\' must be {r, g, b} or a colour like "#rrggbb", '
      .. 'got "#f008"',
      sentence(celspan.paint, { pigment = "#f008" }))
    assert.are.equal('paint: field \'medium\' must be {r, g, b} or a colour like "#rrggbb", got '
      .. '"#ff000080"',
      sentence(celspan.paint, { medium = "#ff000080" }))
  end)
end)

describe("a pivot", function()
  it("does not move", function()
    local square = celspan.rect { 10, 20, 4, 4 }
    assert.are.same({ 8, 18, 8, 8 }, { square:scale(2, nil, 12, 22):bounds() })
    assert.are.same({ 8, 20, 8, 4 }, { square:scale(2, 1, 12, 22):bounds() })
    assert.are.same({ 10, 20, 4, 4 }, { square:scale(-1, 1, 12, 22):bounds() })
    local x, y, w, h = square:skew(45, 0, 12, 22):bounds()
    assert.is_true(math.abs(x - 8) < 1e-9 and math.abs(w - 8) < 1e-9)
    assert.are.same({ 20, 4 }, { y, h })
    assert.are.equal("skew: the centre's y must be a number, got no value",
      (raised.sentence(function() square:skew(1, 2, 3) end)))
  end)
end)

describe("gels with an alpha", function()
  it("are mixed with clear, in any notation of the colour", function()
    local halfway = celspan.mix(celspan.gel(1, 0.5, 0), celspan.clear, 0.5)
    for _, gel in ipairs { celspan.gel(1, 0.5, 0, 0.5), celspan.gel("#ff000080", 1) } do
      assert.equal(0, gel.beta)
    end
    assert.same(halfway.medium, celspan.gel(1, 0.5, 0, 0.5).medium)
    assert.same({ 1, 0, 0 }, celspan.gel("#ff000080", 1).medium)
    assert.error_matches(function()
      return celspan.gel(1, 1, 1, 2)
    end, "gel: alpha is 2; it must be between 0 and 1", 1, true)
    assert.error_matches(function()
      return celspan.rgb("#fff", -1)
    end, "rgb: alpha is -1; it must be between 0 and 1", 1, true)
  end)
end)

describe("the inside of a value", function()
  local circle, image = disc(), celspan.pixels(celspan.rostrum {}, { size = { 2, 2 } })

  it("cannot be reached through its metatable", function()
    for _, value in ipairs { circle, image, celspan.cel {}, celspan.rostrum {}, celspan.clear } do
      assert.equal("string", type(getmetatable(value)))
    end
  end)

  it("is not accessed in values of another kind", function()
    local frame
    celspan.pixels(celspan.film { size = { 2, 2 }, frame = function(f)
      frame = f
      return celspan.rostrum {}
    end }, { size = { 2, 2 }, frame = 1 })
    local metatable = getmetatable(io.stdout)
    metatable.__celspan = true
    for _, other in ipairs { frame, io.stdout, image } do
      assert.error_matches(function() circle.with(other, {}) end, "call it as a method", 1, true)
      assert.has_error(function() circle.named(other, "hand") end)
    end
    metatable.__celspan = nil
  end)

  it("is protected by a sentence if a method of an image is given another value", function()
    for _, name in ipairs { "get", "bytes", "write" } do
      local sentence = raised.sentence(function()
        local answer = image[name](circle, 0, 0)
        return answer
      end)
      assert.are.equal(("%s: call it as a method, image:%s(...), got a circle"):format(name, name),
        sentence)
    end
  end)
end)
