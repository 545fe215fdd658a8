-- Scene values: immutable, readable, copied with changes, combined by operators.
local celspan = require "celspan"
local raised = require "tests.support.raised"

local function disc(x, radius)
  return celspan.circle { centre = { x or 0, 0 }, radius = radius or 10, texture = "#ff8800" }
end

describe("a value", function()
  it("refuses assignment and says what to do", function()
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
    assert.is_nil(circle.nothing)
  end)

  it("gives copies of its tables", function()
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
  it("copies with changes and leaves the first as it was", function()
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

  it("make what their names make", function()
    assert.are.equal("union{ 2 objects }", tostring(a | b))
    assert.are.equal("intersection{ 2 objects }", tostring(a & b))
    assert.are.equal("difference{ 2 objects }", tostring(a - b))
    assert.are.equal("xor{ 2 objects }", tostring(a ~ b))
  end)

  it("do not flatten what was moved, or was named", function()
    assert.are.equal("union{ 2 objects }", tostring((a | b):translate(1, 0) | c))
    assert.are.equal("xor{ 2 objects }", tostring(celspan.xor { a, b } ~ c))
  end)

  it("bind as Lua binds them: - & ~ |", function()
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

  it("turn by quarters exactly, clockwise on screen", function()
    assert.are.same({ -20, 0, 20, 10 }, box(square:rotate(90)))
    assert.are.same({ -10, -20, 10, 20 }, box(square:rotate(180)))
    assert.are.same({ 0, -10, 20, 10 }, box(square:rotate(-90)))
    assert.are.same({ 0, 0, 10, 20 }, box(square:rotate(360)))
    assert.are.same(box(square:rotate(90)), box(square:rotate(-270)))
  end)

  it("turn about a centre", function()
    assert.are.same({ -5, 5, 20, 10 }, box(square:rotate(90, 5, 10)))
  end)

  it("take matrices row by row", function()
    assert.are.same({ 7, 8, 20, 60 }, box(square:transform { 2, 0, 7, 0, 3, 8, 0, 0, 1 }))
  end)

  it("take four points to four others", function()
    local from = { { 0, 0 }, { 10, 0 }, { 10, 20 }, { 0, 20 } }
    local to = { { 100, 0 }, { 120, 0 }, { 120, 40 }, { 100, 40 } }
    local x, y, w, h = square:quad(from, to):bounds()
    assert.is_true(math.abs(x - 100) + math.abs(y) + math.abs(w - 20) + math.abs(h - 40) < 1e-9)
  end)

  it("know what is inside", function()
    assert.is_true(square:translate(100, 0):contains(105, 5))
    assert.is_false(square:translate(100, 0):contains(5, 5))
  end)

  it("allow a scale of 0, which draws nothing", function()
    assert.is_nil(square:scale(0):bounds())
  end)
end)

describe("paints", function()
  it("are read as they were given", function()
    local paint = celspan.rgb(0.1, 0.2, 0.3, 0.4)
    assert.are.same({ 0.1, 0.2, 0.3 }, paint.pigment)
    assert.are.same({ 1, 1, 1 }, paint.medium)
    assert.are.equal(0.4, paint.beta)
    assert.are.equal(0, celspan.gel(1, 0, 0).beta)
    assert.are.equal(0, celspan.clear.beta)
  end)

  it("tell what was left out", function()
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
