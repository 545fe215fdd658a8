-- Gradients without points beside the same gradients with points written by hand.
local celspan = require "celspan"
local present = require "tests.support.present"
local raised = require "tests.support.raised"

local linear, radial = celspan.linear, celspan.radial
local type_it = present.type() and it or pending

local FILM = { 120, 90 }

--- All pixels of objects, and the probe at some of them.
local function seen(...)
  local rostrum = celspan.rostrum { celspan.cel { ... } }
  local found = { assert(celspan.pixels(rostrum, { size = FILM })):bytes { depth = 16 } }
  for i = 1, 5 do
    found[#found + 1] = { celspan.probe(rostrum, 20 * i + 0.3, 15 * i + 0.7, { film = FILM }) }
  end
  return found
end

--- An ellipse's gradient as a matrix: a circle of the box's width, as high as the box.
local function ellipse(x, y, w, h, ...)
  return radial { centre = { x + w / 2, y + h / 2 }, radius = w / 2, matrix = { 1, 0, 0,
    0, h / w, (y + h / 2) * (1 - h / w), 0, 0, 1 }, ... }
end

describe("a gradient without points", function()
  local box = { 20, 10, 80, 60 }

  local function rect(texture)
    return celspan.rect { box[1], box[2], box[3], box[4], texture = texture }
  end

  it("goes from the top to the bottom of what it paints", function()
    local given = linear { from = { 0, 10 }, to = { 0, 70 }, { 0, "#f00" }, { 1, "#00f8" } }
    assert.are.same(seen(rect(given)), seen(rect(linear { "#f00", "#00f8" })))
    assert.are.same(seen(rect(given)), seen(rect(linear { { 0, "#f00" }, { 1, "#00f8" } })))
    assert.are.same(seen(rect(given)), seen(rect(linear { to = "bottom", "#f00", "#00f8" })))
    assert.are.same(seen(rect(given)), seen(rect(linear { angle = 180, "#f00", "#00f8" })))
  end)

  it("goes to a side, to a corner or at an angle", function()
    local function by_hand(from, to)
      return seen(rect(linear { from = from, to = to, { 0, "#f00" }, { 0.5, "#0f0" },
        { 1, "#00f" } }))
    end
    local function to(side) return seen(rect(linear { to = side, "#f00", "#0f0", "#00f" })) end
    assert.are.same(by_hand({ 20, 0 }, { 100, 0 }), to "right")
    assert.are.same(by_hand({ 100, 0 }, { 20, 0 }), to "left")
    assert.are.same(by_hand({ 0, 70 }, { 0, 10 }), to "top")
    -- the line through the other corners is of the middle colour
    local corner = rect(linear { to = "top right", "#000", "#fff", "#000" })
    local rostrum = celspan.rostrum { celspan.cel { corner } }
    local function light(x, y) return (celspan.probe(rostrum, x, y, { film = FILM })) end
    for _, share in ipairs { 0.01, 0.25, 0.5, 0.99 } do
      assert.is_true(math.abs(light(20 + 80 * share, 10 + 60 * share) - 1) < 1e-6)
    end
    assert.is_true(light(20.001, 69.999) < 1e-3 and light(99.999, 10.001) < 1e-3)
    -- at 45 degrees the line is as long as the box is in this direction
    local half = (80 + 60) / 4
    assert.are.same(by_hand({ 60 - half, 40 + half }, { 60 + half, 40 - half }),
      seen(rect(linear { angle = 45, "#f00", "#0f0", "#00f" })))
  end)

  it("fits an ellipse as an ellipse", function()
    local shape = celspan.ellipse { centre = { 60, 40 }, radii = { 40, 30 } }
    assert.are.same(
      seen(shape:with { texture = ellipse(20, 10, 80, 60, { 0, "#fff" }, { 1, "#f008" }) }),
      seen(shape:with { texture = radial { "#fff", "#f008" } }))
    local disc = celspan.circle { centre = { 60, 40 }, radius = 30 }
    assert.are.same(seen(disc:with { texture = radial { centre = { 60, 40 }, radius = 30,
      { 0, "#fff" }, { 1, "#f00" } } }), seen(disc:with { texture = radial { "#fff", "#f00" } }))
  end)

  it("is fitted before the transform, again by with, and for each part of a union", function()
    local fit = linear { "#f00", "#00f" }
    local function hand(y, h)
      return linear { from = { 0, y }, to = { 0, y + h }, { 0, "#f00" }, { 1, "#00f" } }
    end
    assert.are.same(seen(rect(hand(10, 60)):rotate(30, "centre")),
      seen(rect(fit):rotate(30, "centre")))
    local disc = celspan.circle { centre = { 60, 40 }, radius = 10, texture = fit }
    assert.are.same(seen(disc:with { radius = 30, texture = hand(10, 60) }),
      seen(disc:with { radius = 30 }))
    local other = celspan.rect { 0, 60, 50, 20, texture = fit }
    assert.are.same(seen(disc:with { texture = hand(30, 20) } | other:with {
      texture = hand(60, 20) }), seen(disc | other))
    assert.are.same(seen((disc | other):paint(hand(30, 50))), seen((disc | other):paint(fit)))
  end)

  it("fits a stroke's whole line, without its dashes and parts", function()
    local line = { points = { { 20, 20 }, { 100, 20 }, { 100, 60 } }, width = 10, cap = "square" }
    local function stroke(more)
      local fields = more
      for name, value in pairs(line) do fields[name] = value end
      return celspan.stroke(fields)
    end
    local hand = linear { from = { 15, 0 }, to = { 105, 0 }, { 0, "#f00" }, { 1, "#00f" } }
    local fit = linear { to = "right", "#f00", "#00f" }
    assert.are.same(seen(stroke { texture = hand }), seen(stroke { texture = fit }))
    assert.are.same(seen(stroke { texture = hand, dash = { 9, 12 }, to = 0.7 }),
      seen(stroke { texture = fit, dash = { 9, 12 }, to = 0.7 }))
  end)

  type_it("fits the lines of a text, and stands still letter by letter", function()
    local fields = { "Hey\ngo", 10, 35, font = "../../../scripts/type/block.ttf", size = 30,
      leading = 1.3 }
    local text = celspan.text(fields)
    local m = text:metrics()
    local hand = linear { from = { 0, 35 - m.ascent }, to = { 0, 35 - m.ascent + m.height },
      { 0, "#f00" }, { 1, "#00f" } }
    local fit = linear { "#f00", "#00f" }
    assert.are.same(seen(text:with { texture = hand }), seen(text:with { texture = fit }))
    local function letter(texture)
      fields.texture = texture
      return celspan.glyphs(fields)[4].object
    end
    assert.are.same(seen(letter(hand)), seen(letter(fit)))
  end)

  it("fits the frame as a light", function()
    local function lit(texture, on)
      local rostrum = celspan.rostrum { front = { texture = texture, on = on },
        celspan.cel { celspan.rect { 0, 0, 120, 90, texture = "#fff" } } }
      local found = { assert(celspan.pixels(rostrum, { size = FILM })):bytes { depth = 16 } }
      found[2] = { celspan.probe(rostrum, 33.3, 44.4, { film = FILM }) }
      for i, value in ipairs(found[2]) do found[2][i] = math.floor(value * 1e9 + 0.5) end
      return found
    end
    assert.are.same(lit(linear { from = { 0, 0 }, to = { 0, 90 }, { 0, "#f00" }, { 1, "#00f" } }),
      lit(linear { "#f00", "#00f" }))
    assert.are.same(lit(ellipse(0, 0, 120, 90, { 0, "#fff" }, { 1, "#000" })),
      lit(radial { "#fff", "#000" }))
  end)

  it("is its first colour where there is no size", function()
    local line = celspan.stroke { points = { { 10, 45 }, { 110, 45 } }, width = 0,
      texture = linear { "#f00", "#00f" } }
    assert.are.same(seen(), seen(line))
    assert.are.same(seen(rect "#f00"), seen(rect(linear { "#f00" })))
  end)

  it("has a spread, too", function()
    assert.are.same(
      seen(rect(radial { centre = { 60, 40 }, radius = 40, spread = "reflect",
        matrix = { 1, 0, 0, 0, 0.75, 10, 0, 0, 1 }, { 0, "#f00" }, { 1, "#00f" } })),
      seen(rect(radial { spread = "reflect", "#f00", "#00f" })))
  end)

  it("refuses what does not go together", function()
    raised.each {
      ["linear: field 'to' must be \"top left\", \"top\", "] = function()
        linear { to = "up", "#f00", "#00f" }
      end,
      ["linear: field 'from' must be a point {x, y}, got nil"] = function()
        linear { to = { 1, 2 }, "#f00", "#00f" }
      end,
      ["linear: give 'to' or 'angle', not both"] = function()
        linear { to = "top", angle = 3, "#f00", "#00f" }
      end,
      ["linear: give 'angle', or 'from' and 'to', not both"] = function()
        linear { from = { 0, 0 }, to = { 3, 4 }, angle = 3, "#f00", "#00f" }
      end,
      ["linear: there is no stop; it needs one or more"] = function() linear {} end,
      ["radial: field 'centre' must be a point {x, y}, got nil"] = function()
        radial { radius = 3, "#f00", "#00f" }
      end,
      ["radial: field 'radius' must be a number, got nil"] = function()
        radial { centre = { 3, 4 }, "#f00", "#00f" }
      end,
      ["a gradient without points fits what it paints; give it points"] = function()
        linear { matrix = { 1, 0, 0, 0, 1, 0, 0, 0, 1 }, "#f00", "#00f" }
      end,
      ["linear: colour 2 must be a paint or a colour like \"#rrggbb\", got table"] = function()
        linear { "#f00", { 1, "#00f" } }
      end,
    }
  end)
end)
