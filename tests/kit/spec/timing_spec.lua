-- The pure functions of time: ease and keys.
local celspan = require "celspan"
local ease = require "celspan.ease"
local keys = require "celspan.keys"
local raised = require "tests.support.raised"

describe("ease", function()
  it("knows the names of flux, tween.lua and hump.timer", function()
    for u = 0, 1, 0.125 do
      local expected = ease "inOutQuad" (u)
      assert.are.equal(expected, ease "quadinout" (u))
      assert.are.equal(expected, ease "in-out-quad" (u))
    end
    assert.are.equal(ease "quad" (0.3), ease "inQuad" (0.3))
    assert.are.equal(ease "inOutQuad" (0.3), ease "easeInOutQuad" (0.3))
  end)

  it("knows the names of CSS, and holds", function()
    for name, points in pairs { ease = ".25,.1,.25,1", ["ease-in"] = ".42,0,1,1",
                                ["ease-out"] = "0,0,.58,1", ["ease-in-out"] = ".42,0,.58,1" } do
      assert.are.equal(ease("bezier:" .. points)(0.3), ease(name)(0.3))
    end
    assert.are.equal(ease "bezier:.4,0,.2,1" (0.3), ease "cubic-bezier(.4, 0, .2, 1)" (0.3))
    assert.are.equal(ease "steps:4" (0.3), ease "steps(4)" (0.3))
    assert.are.same({ 0, 0, 1 }, { ease "hold" (0), ease "hold" (0.999), ease "hold" (1) })
    assert.are.same({ 0, 0, 1 },
      { ease "step-end" (0), ease "step-end" (0.999), ease "step-end" (1) })
    assert.are.same({ 0, 1, 1 }, { ease "step-start" (0), ease "step-start" (0.001),
      ease "step-start" (1) })
  end)

  it("swings around 1 as a spring, from rest, less and less", function()
    local spring, most, crossed = ease "spring", 0, 0
    assert.is_true(math.abs(spring(1e-4)) < 1e-5)
    for i = 1, 1000 do
      local before, now = spring((i - 1) / 1000), spring(i / 1000)
      most = math.max(most, now)
      if (before - 1) * (now - 1) < 0 then crossed = crossed + 1 end
      if i > 500 then assert.is_true(math.abs(now - 1) < 0.06) end
    end
    assert.is_true(most > 1.1 and most < 1.25, tostring(most))
    assert.are.equal(4, crossed)
  end)

  it("starts at 0 and ends at 1, and is constant outside", function()
    for _, name in ipairs(ease.names) do
      local curve = ease(name)
      assert.are.same({ 0, 0, 1, 1 }, { curve(-1), curve(0), curve(1), curve(2) }, name)
    end
  end)

  it("joins halves without a jump", function()
    for _, name in ipairs(ease.names) do
      local curve = ease(name)
      assert.is_true(math.abs(curve(0.5 - 1e-9) - curve(0.5 + 1e-9)) < 1e-3, name)
    end
  end)

  it("follows the known formulas", function()
    assert.are.equal(0.25, ease "inQuad" (0.5))
    assert.are.equal(0.75, ease "outQuad" (0.5))
    assert.are.equal(0.125, ease "inCubic" (0.5))
    assert.is_true(ease "outBack" (0.7) > 1)
    assert.is_true(math.abs(ease "outBounce" (1 / 2.75) - 1) < 1e-12)
  end)

  it("steps", function()
    local on_fours = ease "steps:4"
    assert.are.same({ 0, 0.25, 0.25, 0.75, 1 },
      { on_fours(0.2), on_fours(0.25), on_fours(0.49), on_fours(0.99), on_fours(1) })
  end)

  it("accepts Bezier curves like CSS", function()
    local straight = ease "bezier:.25,.25,.75,.75"
    for u = 0, 1, 0.1 do assert.is_true(math.abs(straight(u) - u) < 1e-12) end
    assert.is_true(math.abs(ease "bezier:.42,0,.58,1" (0.5) - 0.5) < 1e-12)
  end)

  it("accepts functions", function()
    assert.are.equal(7, ease(function() return 7 end)(0))
  end)

  it("names the nearest curve", function()
    local message = raised.message(function() ease "inOutQad" end)
    assert.is_truthy(message:find('did you mean "inoutquad"?', 1, true))
    assert.is_truthy(message:find("timing_spec.lua:", 1, true))
    assert.matches('did you mean "inoutsine"?', raised.message(ease, "inout"), 1, true)
    raised.message(ease, "steps:0")
    raised.message(ease, "bezier:2,0,1,1")
  end)
end)

describe("keys", function()
  it("mix numbers, arrays and paints", function()
    assert.are.equal(15, keys { { 0, 10 }, { 2, 20 } }:at(1))
    assert.are.same({ 1.5, 3 }, keys { { 0, { 1, 2 } }, { 1, { 2, 4 } } }:at(0.5))
    local paint = keys { { 0, celspan.rgb(1, 0, 0) }, { 1, celspan.clear } }:at(0.5)
    assert.are.equal(0.5, paint.beta)
  end)

  it("mix colours given as strings, which become paints", function()
    local track = keys { { 0, "#f00" }, { 1, "#0000ff00" } }
    local paint = track:at(0.25)
    assert.are.equal(0.75, paint.beta)
    assert.are.same(celspan.rgb("#f00").pigment, track:at(-1).pigment)
    assert.are.same({ 1, 1, 1 }, keys { { 0, celspan.rgb(0, 0, 0) }, { 1, "#fff" } }:at(2).pigment)
    assert.are.same({ 0, 0, 0 }, keys { { 0, "#000" }, { 1, celspan.rgb(1, 1, 1) } }:at(0).pigment)
  end)

  it("are constant if colours are mixed with other strings", function()
    local track = keys { { 0, "#abc" }, { 1, "shut" }, { 2, "#fff" } }
    assert.are.same({ "#abc", "shut", "#fff" }, { track:at(0.9), track:at(1.9), track:at(2) })
  end)

  it("are constant outside, and do not mix strings and booleans", function()
    local x = keys { { 1, 10 }, { 2, 20 } }
    assert.are.same({ 10, 20 }, { x:at(0), x:at(5) })
    local mouth = keys { { 0, "open" }, { 1, "shut" }, { 2, "open" } }
    assert.are.same({ "open", "shut", "shut", "open" },
      { mouth:at(0.99), mouth:at(1), mouth:at(1.99), mouth:at(3) })
    assert.is_true(keys { { 0, true }, { 1, false } }:at(0.5))
  end)

  it("ease into a key", function()
    assert.are.equal(25, keys { { 0, 0 }, { 1, 100, "inQuad" } }:at(0.5))
    assert.are.equal(40, keys { { 0, 0 }, { 1, 100, function() return 0.4 end } }:at(0.5))
  end)

  it("repeat and mirror", function()
    local again = keys { { 0, 0 }, { 1, 10 }, loop = "repeat" }
    assert.are.same({ 2.5, 2.5, 2.5 }, { again:at(0.25), again:at(3.25), again:at(-0.75) })
    local back = keys { { 0, 0 }, { 1, 10 }, loop = "mirror" }
    assert.are.same({ 7.5, 7.5, 7.5, 2.5 },
      { back:at(0.75), back:at(1.25), back:at(-0.75), back:at(2.25) })
  end)

  it("jump where two keys share a time", function()
    local x = keys { { 0, 0 }, { 1, 10 }, { 1, 50 }, { 2, 60 } }
    assert.are.same({ 50, 55 }, { x:at(1), x:at(1.5) })
  end)

  it("do not change with the table they were made from", function()
    local list = { { 0, { 1 } }, { 1, { 2 } } }
    local x = keys(list)
    list[1][2][1] = 99
    assert.are.same({ 1 }, x:at(0))
    x:at(0)[1] = 99
    assert.are.same({ 1 }, x:at(0))
  end)

  it("report errors at the line that made them", function()
    local cases = {
      { 'keys: key 1 has an unknown field ease: a key is {time, value [, ease]}',
        { { 0, 1, ease = "hold" } } },
      { "keys: key 2 must be {time, value}, got number", { { 0, 1 }, 3 } },
      { "keys: key 2 is of another kind (held) than the first (number)", { { 0, 1 }, { 1, "x" } } },
      { "keys: key 2 is at 1, before the key before it", { { 2, 1 }, { 1, 2 } } },
      { "keys: key 2 has 1 numbers, the first has 2", { { 0, { 1, 2 } }, { 1, { 1 } } } },
      { "keys: needs at least one key {time, value}", {} },
      { "keys: unknown field 'lop'; did you mean 'loop'?", { { 0, 1 }, lop = "repeat" } },
      { 'keys: loop must be "repeat" or "mirror", got no', { { 0, 1 }, loop = "no" } },
      { 'keys: key 2 cannot have this ease: there is no curve "outQuat"; did you mean "outquad"?',
        { { 0, 1 }, { 1, 2, "outQuat" } } },
      { 'keys: key 2 cannot have this ease: there is no curve "easeInOutCubik"; did you mean '
        .. '"easeinoutcubic"?', { { 0, 1 }, { 1, 2, "easeInOutCubik" } } },
      { "keys: key 1 must begin with a time, a finite number, got inf", { { math.huge, 1 } } },
      { "keys: key 1 must have a finite number, an array of numbers or points, a pose, a paint, "
        .. "a string or a boolean as value, got inf", { { 0, math.huge } } },
    }
    for _, case in ipairs(cases) do
      local message = raised.message(function() keys(case[2]) end)
      assert.are.equal(case[1], message:match "timing_spec%.lua:%d+: (.*)$")
    end
  end)

  it("refuse a time that is not a number", function()
    local track = keys { { 0, 1 }, { 1, 2 } }
    for _, time in ipairs { 0 / 0, math.huge, "1" } do
      raised.message(track.at, track, time)
    end
  end)
end)

describe("keys of shapes", function()
  it("mix points, path data with the same commands, and poses", function()
    local points = keys { { 0, { { 0, 0 }, { 10, 0 } } }, { 1, { { 0, 10 }, { 20, 0 } } } }
    assert.are.same({ { 0, 5 }, { 15, 0 } }, points:at(0.5))
    local path = keys { { 0, "M0 0h10v10z" }, { 2, "M10,0 h20 v30z" } }
    assert.equal("M 5 0 h 15 v 20 z", path:at(1))
    assert.equal("M0 0h10v10z", path:at(-1))
    assert.equal("M0 0h10v10z", path:at(0))
    assert.equal("M10,0 h20 v30z", path:at(2))
    assert.equal("M 0 0 A 5 5 0 0 1 12 0",
      keys { { 0, "M0 0A5 5 0 0110 0" }, { 1, "M0 0A5 5 0 0114 0" } }:at(0.5))
    assert.are.same({ arm = 15, at = { 5, 0 } },
      keys { { 0, { arm = 10 } }, { 1, { arm = 20, at = { 10, 0 } } } }:at(0.5))
  end)

  it("that cannot be mixed are refused, and words stay words", function()
    for words, list in pairs {
      ["key 2 differs from the first at command 2"] = { { 0, "M0 0L1 1" }, { 1, "M0 0l1 1" } },
      ["key 2 differs from the first at command 3"] = { { 0, "M0 0L1 1" }, { 1, "M0 0L1 1Z" } },
      ["and the flags of arcs"] = { { 0, "M0 0A5 5 0 0110 0" }, { 1, "M0 0A5 5 0 1110 0" } },
      ["key 2 has 1 points, the first has 2"] =
        { { 0, { { 0, 0 }, { 1, 1 } } }, { 1, { { 0, 0 } } } },
      ["key 2 has 3 numbers in point 1, the first has 2"] =
        { { 0, { { 0, 0 } } }, { 1, { { 0, 0, 0 } } } },
      ["(array) than the first (pose)"] = { { 0, { arm = 1 } }, { 1, { 1 } } },
    } do
      local message = raised.message(function() keys(list) end)
      assert.is_truthy(message:find(words, 1, true), message)
    end
    local endless = {}
    endless.arm = endless
    for _, value in ipairs { endless, { arm = 0 / 0 }, { arm = print } } do
      assert.is_truthy(raised.message(function() keys { { 0, value } } end):find "got table")
    end
    assert.equal("M", keys { { 0, "M" }, { 1, "A" } }:at(0.5))
    assert.equal("M0 0", keys { { 0, "M0 0" }, { 1, "hidden" } }:at(0.5))
  end)

  it("are new at each call", function()
    local track = keys { { 0, { arm = { rotate = 1 } } } }
    track:at(0).arm.rotate = 9
    assert.equal(1, track:at(0).arm.rotate)
  end)
end)
