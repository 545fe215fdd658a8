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

describe("a span of time", function()
  it("is 0 before, 1 after, and eased between", function()
    local found = {}
    for i, time in ipairs { 0, 2, 2.5, 4, 9 } do found[i] = motion.span(time, 2, 2) end
    assert.are.same({ 0, 0, 0.25, 1, 1 }, found)
    assert.are.equal(0.0625, motion.span(2.5, 2, 2, "inQuad"))
    assert.are.equal(0.5, motion.span(3, 2, 2, function(u) return u end))
    assert.are.same({ 0, 1 }, { motion.span(1.9, 2, 0), motion.span(2, 2, 0) })
  end)

  it("refuses what is no time", function()
    raised.each {
      ["motion: span: the length must be at least 0, got -1"] = function()
        motion.span(1, 2, -1)
      end,
      ["motion: span: length must be a finite number, got nil"] = function() motion.span(1, 2) end,
      ['ease: there is no curve "outBak"; did you mean'] = function()
        motion.span(1, 0, 2, "outBak")
      end,
    }
  end)
end)

describe("times", function()
  local t = motion.times { { "rise", 1 }, { 0.3 }, { "turn", 0.5 }, { "fall", 1 }, overlap = 0.25 }

  it("are one after another, with pauses and overlaps", function()
    near({ 0, 1, 1.3, 1.8, 1.55, 2.55, 2.55 }, t.rise.from, t.rise.to, t.turn.from, t.turn.to,
      t.fall.from, t.fall.to, t.length)
    near({ 0, 0.5, 1, 0.25 }, t.turn:at(1), t.turn:at(1.55), t.turn:at(3),
      t.turn:at(1.55, "inQuad"))
  end)

  it("are marks of a film", function()
    assert.are.same({ rise = { 1, 24 }, turn = { 32, 43 }, fall = { 38, 61 } }, t:marks(24))
    assert.are.same({ 101, 110 }, t:marks(10, 101).rise)
  end)

  it("refuse wrong items", function()
    raised.each {
      ["motion: times: item 2 cannot have the name 'rise', which another has"] = function()
        motion.times { { "rise", 1 }, { "rise", 2 } }
      end,
      ["motion: times: item 1 cannot have the name 'length', which the list of times needs"] =
        function() motion.times { { "length", 1 } } end,
      ["motion: times: item 1 needs its seconds, a finite number of at least 0, got nil"] =
        function() motion.times { { "rise" } } end,
      ["motion: times: item 1 must be { name, seconds }, or a pause { seconds }, got number"] =
        function() motion.times { 3 } end,
      ["motion: times: unknown field 'overlp'; did you mean 'overlap'?"] = function()
        motion.times { { "rise", 1 }, overlp = 1 }
      end,
      ["the list of times has no 'trun'; did you mean 'turn'?"] = function() return t.trun end,
      ["motion: times: at takes a time, a finite number, got nil"] = function() t.rise:at() end,
    }
  end)
end)
