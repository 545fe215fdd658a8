-- Moving along outlines, and wiggling.
local motion = require "celspan.motion"
local raised = require "tests.support.raised"

local function near(expected, ...)
  local found = { ... }
  for i = 1, #expected do
    assert.is_true(math.abs(found[i] - expected[i]) < 1e-3,
      ("value %d is %s, not %s"):format(i, found[i], expected[i]))
  end
end

describe("a path of motion", function()
  it("is followed at constant speed", function()
    local way = motion.along { { 0, 0 }, { 10, 0 }, { 10, 30 } }
    assert.are.equal(40, way.length)
    near({ 4, 0, 0 }, way:at(0.1))
    near({ 10, 10, 90 }, way:at(0.5))
  end)

  it("stops at its ends", function()
    local way = motion.along { { 1, 2 }, { 3, 2 } }
    near({ 1, 2, 0 }, way:at(-1))
    near({ 3, 2, 0 }, way:at(2))
    near({ 5, 6, 0 }, motion.along { { 5, 6 } }:at(0.5))
  end)

  it("follows path data, relative and absolute", function()
    near({ 10, 5, 90 }, motion.along "M0 0h10v10H0z":at(0.375))
    near({ 10, 5, 90 }, motion.along "m0,0 10,0 0,10 -10,0z":at(0.375))
    near({ 50, -100, 180 }, motion.along "M0 0V-1e2L100-100,0-100":at(250 / 300))
  end)

  it("follows curves and arcs", function()
    local circle = motion.along "M10 0A10 10 0 0 1-10 0 10 10 0 01 10 0"
    assert.is_true(math.abs(circle.length - 20 * math.pi) < 1e-9)
    local turns = 0 -- the direction of a curve has no steps
    for i = 1, 1000 do
      local before, after = select(3, circle:at((i - 1) / 1000)), select(3, circle:at(i / 1000))
      turns = math.max(turns, math.abs((after - before + 180) % 360 - 180))
    end
    assert.is_true(turns < 0.361, turns)
    local x, y = circle:at(0.125)
    near({ 10 * math.sqrt(0.5), 10 * math.sqrt(0.5) }, x, y)
    local curve = motion.along "M0 0C0 10 10 10 10 0S20-10 20 0"
    x, y = curve:at(0.5)
    near({ 10, 0 }, x, y)
    local parabola = motion.along "M0 0Q5 10 10 0T20 0"
    x, y = parabola:at(0.25)
    near({ 5, 5 }, x, y)
  end)

  it("reports errors at the caller's line", function()
    for _, outline in ipairs { "L0 0", "M0", "M0 0 X", "M0 0 z 3", 7, { 3 }, {} } do
      local message = raised.message(function() motion.along(outline) end)
      assert.is_truthy(message:find "motion_spec.lua:%d+: motion: ", message)
    end
  end)
end)

describe("wiggle", function()
  it("is the same for the same seed and never leaves its range", function()
    local a, b = motion.wiggle("camera", { amplitude = 5 }), motion.wiggle("camera",
      { amplitude = 5 })
    local other, differs, least, most = motion.wiggle "lamp", false, 0, 0
    for i = -200, 200 do
      local t = i / 7
      assert.are.equal(a:at(t), b:at(t))
      differs = differs or a:at(t) / 5 ~= other:at(t)
      least, most = math.min(least, a:at(t)), math.max(most, a:at(t))
    end
    assert.is_true(differs)
    assert.is_true(least >= -5 and most <= 5 and most - least > 5)
  end)

  it("has no jumps", function()
    local a = motion.wiggle(3, { frequency = 2 })
    for i = 0, 1000 do
      assert.is_true(math.abs(a:at(i / 100) - a:at((i + 1) / 100)) < 0.08)
    end
  end)
end)

it("a wiggle has a number at every time", function()
  local wiggle = require "celspan.motion".wiggle("x", { frequency = 1e10 })
  for _, time in ipairs { 1e300, -1e300, 2 ^ 60, 1e12, math.mininteger } do
    local value = wiggle:at(time)
    assert.is_true(value >= -1 and value <= 1, tostring(value))
  end
end)
