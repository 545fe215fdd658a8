-- Places of a value in words, and pivots, for methods that turn, scale and move about them.
local celspan = require "celspan"
local layers = require "celspan.layers"
local svg = require "celspan.svg"
local present = require "tests.support.present"
local raised = require "tests.support.raised"
local workbench = require "tests.support.workbench"

local bench = workbench.new()
local card = celspan.rect { 10, 20, 40, 30, texture = "#f80" }
local type_it = present.type() and it or pending

local function box(value)
  local rounded = { value:bounds() }
  for i, number in ipairs(rounded) do rounded[i] = math.floor(number * 1000 + 0.5) / 1000 + 0.0 end
  return rounded
end

teardown(function() bench:remove() end)

describe("a place", function()
  it("is a word for a point of the bounds", function()
    local places = { ["top left"] = { 10, 20 }, top = { 30, 20 }, ["top right"] = { 50, 20 },
      left = { 10, 35 }, centre = { 30, 35 }, right = { 50, 35 }, ["bottom left"] = { 10, 50 },
      bottom = { 30, 50 }, ["bottom right"] = { 50, 50 } }
    for word, point in pairs(places) do
      local x, y = point[1], point[2]
      assert.are.same(box(card:rotate(30, x, y)), box(card:rotate(30, word)))
      assert.are.same(box(card:scale(2, 3, x, y)), box(card:scale(2, 3, word)))
      assert.are.same(box(card:scale(2, nil, x, y)), box(card:scale(2, word)))
      assert.are.same(box(card:skew(10, 20, x, y)), box(card:skew(10, 20, word)))
      assert.are.same(box(card:translate(7 - x, 9 - y)), box(card:move_to(7, 9, word)))
    end
    assert.are.same({ 80, 85, 40, 30 }, box(card:move_to(100, 100)))
  end)

  it("is one of the value as it is, of cels and of rostrums, too", function()
    local moved = card:translate(100, 0):rotate(90, "centre")
    assert.are.same({ 115, 15, 30, 40 }, box(moved))
    assert.are.same({ 115, -25, 30, 80 }, box(moved:scale(1, 2, "bottom")))
    local cel = celspan.cel { card }
    assert.are.same({ 10, -10, 80, 60 }, box(cel:scale(2, "bottom left")))
    assert.are.same(box(cel:scale(2, "centre")), box(cel:scale(2, "center")))
    local inset = celspan.rostrum { size = { 40, 30 }, cel }
    assert.are.same(box(inset:rotate(90, 20, 15)), box(inset:rotate(90, "centre")))
  end)

  it("may be a point", function()
    assert.are.same(box(card:rotate(30, 5, 6)), box(card:rotate(30, { 5, 6 })))
    assert.are.same(box(card:scale(2, 3, 5, 6)), box(card:scale(2, 3, { 5, 6 })))
    assert.are.same(box(card:scale(2, 2, 5, 6)), box(card:scale(2, { 5, 6 })))
    assert.are.same(box(card:skew(3, 4, 5, 6)), box(card:skew(3, 4, { 5, 6 })))
  end)

  it("changes nothing where there is nothing to paint", function()
    local none = celspan.union {}
    assert.are.equal(none, none:rotate(30, "centre"))
    assert.are.equal(none, none:scale(3, "top"))
    assert.are.equal(none, none:skew(3, 4, "top"))
    assert.are.equal(none, none:move_to(3, 4))
  end)

  it("with an unknown name is refused", function()
    raised.each {
      ['rotate: there is no place "botom"; did you mean "bottom"?'] = function()
        card:rotate(3, "botom")
      end,
      ['move_to: there is no place "over there"; the places are "top left", "top", '] = function()
        card:move_to(3, 4, "over there")
      end,
      ["scale: this rect has no pivot: give it one, value:with { pivot = { x, y } }"] = function()
        card:scale(2, "pivot")
      end,
      ["rotate: value 2 of the centre must be a number, got nil"] = function()
        card:rotate(3, { 5 })
      end,
      ["rotate: the centre's y must be a number, got no value"] = function() card:rotate(3, 5) end,
      ["with: the pivot must be a point {x, y} or a place such as \"bottom\", got number"] =
        function() card:with { pivot = 7 } end,
    }
  end)
end)

describe("a pivot", function()
  it("is kept, and moves with the value", function()
    local arm = card:with { pivot = { 10, 35 } }
    assert.are.same({ 10, 35 }, arm.pivot)
    assert.is_nil(card.pivot)
    assert.are.same({ 110, 45 }, arm:translate(100, 10).pivot)
    assert.are.same(box(card:rotate(30, 10, 35)), box(arm:rotate(30, "pivot")))
    local turned = arm:translate(100, 10):named "arm":fade(0.5):rotate(30, "pivot")
    for _, value in ipairs { turned, turned:with { texture = "#000" } } do
      local x, y = table.unpack(value.pivot)
      assert.is_true(math.abs(x - 110) + math.abs(y - 45) < 1e-12)
    end
    assert.are.same({ "#000", 30, 20 }, { arm:with { pivot = "top", texture = "#000" }.texture,
      table.unpack(arm:with { pivot = "top" }.pivot) })
    assert.are.same({ 1, 2 }, celspan.cel { card }:with { pivot = { 1, 2 } }.pivot)
  end)

  it("may be given to values that have no fields", function()
    local painted = card:paint "#00f":with { pivot = "bottom" }
    assert.are.same({ 30, 50 }, painted.pivot)
    assert.are.same({ 10, 20, 40, 30 }, box(painted))
  end)
end)

describe("a letter", function()
  type_it("has its baseline as its bottom, and the middle of it as its pivot", function()
    local letters = celspan.glyphs { "ag", 20, 200, font = "../../../scripts/type/block.ttf",
      size = 100 }
    for _, letter in ipairs(letters) do
      local x, _, w = letter.object:bounds()
      assert.are.equal(letter.x + letter.advance / 2, letter.middle)
      assert.are.same(box(letter.object:rotate(10, x + w / 2, 200)),
        box(letter.object:rotate(10, "bottom")))
      assert.are.same(box(letter.object:rotate(10, letter.middle, 200)),
        box(letter.object:rotate(10, "pivot")))
      local moved = letter.object:translate(0, 50):with { texture = "#f00" }
      assert.are.same(box(moved:scale(1, 2, 0, 250)), box(moved:scale(1, 2, "bottom")))
    end
  end)
end)

describe("a part", function()
  type_it("of a drawing keeps its pivot", function()
    local path = bench:write("bird.svg", [[<svg xmlns="http://www.w3.org/2000/svg" width="100"
      height="100"><g id="bird"><rect id="wing" x="20" y="30" width="40" height="10"/></g></svg>]])
    local bird = svg.load(path):with { wing = { pivot = { 20, 40 } } }
    local function turn(degrees)
      return function(wing) return wing:rotate(degrees, "pivot") end
    end
    assert.are.same({ 20, 40 }, bird.parts.wing.pivot)
    local turned = bird:with { wing = turn(90) }
    assert.are.same({ 20, 40, 10, 40 }, box(turned.object))
    local moved = turned:with { wing = function(wing) return wing:translate(5, 0) end }
    assert.are.same({ 25, 40 }, moved.parts.wing.pivot)
    assert.are.same({ 25, 30, 40, 10 }, box(moved:with { wing = turn(-90) }.object))
    assert.are.same({ 40, 30 }, bird:with { wing = { pivot = "top" } }.parts.wing.pivot)
    raised.each { ["svg: part 'wing': unknown field 'pivto'; did you mean 'pivot'?"] = function()
      bird:with { wing = { pivto = { 1, 2 } } }
    end }
  end)

  type_it("of a painting keeps its pivot", function()
    local fox = layers.load "../../../scripts/paintings/fox.ora"
    local name = fox[#fox].name
    local x, y, w, h = fox[#fox].object:bounds()
    local held = fox:with { [name] = { pivot = "bottom right" } }
    assert.are.same({ x + w, y + h }, held:get(name).object.pivot)
    local turned = held:with { [name] = function(layer) return layer:rotate(180, "pivot") end }
    assert.are.same({ x + w, y + h, w, h }, { turned:get(name).object:bounds() })
    assert.are.same({ x + w, y + h }, turned:get(name).object.pivot)
  end)
end)
