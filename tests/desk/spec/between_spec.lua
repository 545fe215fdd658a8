-- In-betweens of exposure sheets: where they lie on the way, arcs, pieces without names, and what
-- is refused.
local celspan = require "celspan"
local raised = require "tests.support.raised"
local sheet = require "celspan.sheet"
local workbench = require "tests.support.workbench"

--- A sheet of one layer "A": drawings and marks by frame.
local function sheet_of(drawings, marks)
  return sheet.new { layers = { "A", "B" }, frames = 12, drawings = { A = drawings },
    marks = { A = marks } }
end

local three = { [3] = "inbetween", [5] = "inbetween", [7] = "inbetween" }
local marked = sheet_of({ [1] = "A1", [9] = "A5" }, three)
local named = sheet_of({ "A1", "A2", "A3", "A4", "A5", "A4", "A3", "A2", "A1" })

local function box(x) return celspan.rect { x, 10, 20, 20, fill = "#a33" } end
local keys = { A1 = box(0), A5 = box(100) }

local function left(object) return (object:bounds()) end

--- The left sides of the drawings at frames.
local function lefts(s, frames, drawings, options)
  local list = {}
  for i, frame in ipairs(frames) do list[i] = left(s:drawing("A", frame, drawings, options)) end
  return list
end

local function near(wanted, found, most)
  for i, value in ipairs(wanted) do assert.near(value, found[i], most) end
end

describe("an in-between", function()
  local inner = { 3, 5, 7 }

  it("lies where its chart says, within half a percent of the way", function()
    local cases = { { { 0.1, 0.5, 0.75 }, { 10, 50, 75 } }, { "even", { 25, 50, 75 } },
      { "slow in", { 43.75, 75, 93.75 } }, { "slow out", { 6.25, 25, 56.25 } },
      { "steps:2", { 0, 50, 50 } }, { function(u) return u * u end, { 6.25, 25, 56.25 } } }
    for _, case in ipairs(cases) do
      near(case[2], lefts(marked, inner, keys, { charts = { ["A1-A5"] = case[1] } }), 0.5)
    end
    near({ 25, 50, 75 }, lefts(marked, inner, keys, { between = true }), 0.5)
    near({ 0, 25, 25, 100, 100 }, lefts(marked, { 2, 3, 4, 9, 12 }, keys, { between = true }), 0.5)
  end)

  it("is a mark alone, or a name without a drawing, which is the same wherever it is", function()
    near({ 0, 20, 50, 60, 100, 60, 50, 20, 0 }, lefts(named, { 1, 2, 3, 4, 5, 6, 7, 8, 9 }, keys,
      { charts = { ["A1-A5"] = { 0.2, 0.5, 0.6 } } }), 0.5)
    assert.equal(0, left(marked:drawing("A", 3, keys)))
    assert.equal(0, left(marked:drawing("A", 3, keys, { between = false })))
  end)

  it("is replaced at once by a drawing, and its neighbours stay where the chart says", function()
    local clean = { A1 = keys.A1, A3 = box(77), A5 = keys.A5 }
    local options = { charts = { ["A1-A5"] = "even" } }
    near({ 0, 25, 77, 75, 100 }, lefts(named, { 1, 2, 3, 4, 5 }, clean, options), 0.5)
    near({ 38.5, 88.5 }, lefts(named, { 2, 4 }, clean, { between = true }), 0.5)
    local both = sheet_of({ [1] = "A1", [5] = "A3", [9] = "A5" },
      { [3] = "inbetween", [5] = "inbetween", [7] = "inbetween" })
    near({ 25, 77, 75 }, lefts(both, inner, clean, { between = true }), 0.5)
  end)

  it("comes from a function and is the same in any order of frames", function()
    local function text(order)
      local list = {}
      for _, frame in ipairs(order) do
        local found = celspan.pixels(celspan.rostrum { celspan.cel {
          marked:drawing("A", frame, function(name) return keys[name] end, { between = true }) } },
          { size = { 32, 8 }, film = { 128, 32 } })
        list[frame] = found:bytes { depth = 8 }
      end
      return list
    end
    assert.are.same(text { 1, 3, 5, 7, 9 }, text { 7, 9, 3, 5, 1 })
  end)

  it("is of its layer alone", function()
    local s = sheet.new { layers = { "A", "B" }, drawings = { A = { "A1" }, B = { "A1" } },
      frames = 4, marks = { B = { [2] = "inbetween" } } }
    assert.equal(0, left(s:drawing("A", 2, keys, { between = true })))
    assert.is_nil(s:drawing("A", 9, keys, { between = true }))
  end)

  it("goes along the circle through three places, within a percent", function()
    local function arm(angle)
      local x, y = 100 + 80 * math.sin(angle), 100 - 80 * math.cos(angle)
      return celspan.stroke { points = { { 100, 100 }, { x, y } }, degree = 1, width = 2,
        cap = "butt" }, { x, y }
    end
    local first, p = arm(-1.2)
    local last, q = arm(1)
    local _, m = arm(0.3)
    for i, share in ipairs { 0.25, 0.5, 0.75 } do
      local object = marked:drawing("A", inner[i], { A1 = first, A5 = last },
        { between = true, pairs = { { p, m, q } } })
      local x, y, w, h = object:bounds()
      local wanted = arm(-1.2 + 2.2 * share)
      near({ wanted:bounds() }, { x, y, w, h }, 0.8)
      assert.near(80, math.sqrt(w * w + h * h), 3)
      local plain = marked:drawing("A", inner[i], { A1 = first, A5 = last }, { between = true })
      local _, _, narrow, low = plain:bounds()
      assert.is_true(math.sqrt(narrow * narrow + low * low) < 75)
    end
  end)

  it("pairs pieces by place, length and direction, and lists what is not sure", function()
    local function line(x, y, dx, dy) return celspan.stroke { d = ("M%g %gl%g %g"):format(x, y, dx,
      dy), width = 2 } end
    local first = celspan.union { line(0, 0, 60, 0), line(0, 40, 0, 30), line(80, 40, 10, 10) }
    local last = celspan.union { line(84, 44, 10, 10), line(4, 44, 0, 30), line(4, 4, 60, 0) }
    local drawings = { A1 = first, A5 = last }
    local object = marked:drawing("A", 5, drawings, { between = true })
    near({ first:translate(2, 2):bounds() }, { object:bounds() }, 0.01)
    assert.are.same({}, marked:charts("A", drawings)[1].unsure)
    local hairs = celspan.union { line(0, 0, 60, 0), line(0, 6, 60, 0) }
    local other = celspan.union { line(0, -3, 60, 0), line(0, 3, 60, 0), line(0, 9, 60, 0) }
    drawings = { A1 = hairs, A5 = other }
    assert.are.same({ { { 30, 6 }, { 30, 3 } } },
      marked:charts("A", drawings)[1].unsure)
    assert.are.same({}, marked:charts("A", drawings, { pairs = { ["A1-A5"] = {
      { { 0, 0 }, { 0, 3 } }, { { 0, 6 }, { 0, 9 } } } } })[1].unsure)
  end)

  it("lists places that settle what is not sure, when they are given as pairs", function()
    -- Two bows, whose boxes have their middles on a third piece, inside a group.
    local function bow(y, dy) return celspan.stroke { width = 2,
      d = ("M0 %gQ40 %g 80 %g"):format(y, y + dy, y) } end
    local first = celspan.union { bow(0, 60), celspan.union { bow(6, 60), bow(7, 60) },
      celspan.stroke { d = "M20 15H60M20 18H60", width = 2 } }
    local last = celspan.union { bow(3, 60), celspan.union { bow(-3, 60), bow(-2, 60) },
      celspan.stroke { d = "M20 16H60M20 19H60", width = 2 } }
    local drawings = { A1 = first, A5 = last }
    local unsure = marked:charts("A", drawings)[1].unsure
    assert.is_true(#unsure > 0)
    for _, given in ipairs { unsure, { ["A1-A5"] = unsure } } do
      assert.are.same({}, marked:charts("A", drawings, { pairs = given })[1].unsure)
    end
  end)

  it("lets what is many times as long shrink, and what has become of it grow", function()
    local function two(d)
      return celspan.union { celspan.stroke { d = d, width = 2, cap = "butt" },
        celspan.rect { 40, 20, 20, 10 } }
    end
    local drawings = { A1 = two "M0 0H100", A5 = two "M45 0H55" }
    local object = marked:drawing("A", 5, drawings, { between = true })
    near({ 25, -0.5, 50, 30.5 }, { object:bounds() }, 0.01)
    object = marked:drawing("A", 5, drawings, { pairs = { { { 0, 0 }, { 45, 0 } } } })
    near({ 22.5, -1, 55, 31 }, { object:bounds() }, 0.01)
  end)

  it("is reported by check, where its name has no mark, or a key is empty", function()
    local bench = workbench.new()
    bench:write("film.lua", [[
local sheet = require "celspan.sheet"
local s = sheet.new { layers = { "A" }, frames = 4, drawings = { A = { "A1", "A2", "A3", "A4" } },
  marks = { A = { [2] = "inbetween" } } }
local keys = { A1 = rect { 0, 0, 9, 9 }, A4 = union {} }
return film { size = { 32, 18 }, frames = 4, frame = function(f)
  return { s:drawing("A", f.number, keys, { between = true }) }
end }
]])
    local _, out, err = bench:celspan_inside "check film.lua"
    local text = out .. err
    bench:remove()
    assert.matches('layer "A", A1%-A4: "A3" has no drawing and no mark i', text)
    assert.matches('layer "A", A1%-A4: the key "A4" is empty, and the other one is not', text)
    assert.is_nil(text:find('"A2" has no drawing', 1, true))
  end)

  it("refuses pairs that are on no line, or give one piece twice", function()
    local twice = celspan.union { celspan.stroke { d = "M0 0H60", width = 2 },
      celspan.stroke { d = "M0 40H60", width = 2 } }
    local drawings = { A1 = twice, A5 = twice }
    for message, given in pairs {
      ["pair 2: no line of the first drawing is near (0, 400); the nearest is 360 away"] =
        { { { 0, 0 }, { 0, 0 } }, { { 0, 400 }, { 0, 0 } } },
      ["pair 1: no line of the second drawing is near (-90, 0); the nearest is 90 away"] =
        { { { 0, 0 }, { -90, 0 } } },
      ["pair 2: the piece at (60, 0) has another partner already"] =
        { { { 0, 0 }, { 0, 0 } }, { { 60, 0 }, { 60, 40 } } },
    } do
      local _, text = pcall(marked.drawing, marked, "A", 5, drawings, { pairs = given })
      assert.is_truthy(tostring(text):find(message, 1, true), text)
    end
  end)
end)

describe("charts", function()
  it("list the runs of a layer, and print", function()
    local charts = marked:charts("A")
    assert.are.same({ "A1-A5", 1, 9 }, { charts[1].name, charts[1].from, charts[1].to })
    assert.are.same({ { 3, 5, 7 }, { 0.25, 0.5, 0.75 } }, { charts[1].frames, charts[1].shares })
    assert.equal("A1-A5, frames 1 to 9: 0.25 0.5 0.75", tostring(charts))
    assert.equal(0, #named:charts "A")
    charts = named:charts("A", keys, { charts = { ["A5-A1"] = { 0, 0.5, 1 } } })
    assert.equal("A1-A5 A5-A1", charts[1].name .. " " .. charts[2].name)
    assert.are.same({ 0, 0.5, 1 }, charts[2].shares)
  end)

  it("are refused where they do not add up", function()
    local function with(charts, s, drawings)
      return function()
        (s or marked):drawing("A", 3, drawings or keys, { between = true, charts = charts })
      end
    end
    raised.each {
      ['chart "A1-A5": it has 2 shares for 3 in-betweens'] = with { ["A1-A5"] = { 0.2, 0.4 } },
      ["share 3 must be from 0.6 to 1, as shares ascend, got 0.5"] =
        with { ["A1-A5"] = { 0.2, 0.6, 0.5 } },
      ["share 3 must be from 0.6 to 1, as shares ascend, got 1.5"] =
        with { ["A1-A5"] = { 0.2, 0.6, 1.5 } },
      ["of this name; did you mean 'A1-A5'?"] = with { ["A1-A6"] = "even" },
      ['did you mean \'slow in\'?'] = with { ["A1-A5"] = "slow im" },
      ['did you mean \'outquad\'?'] = with { ["A1-A5"] = "outquat" },
      ['chart "1": there are no in-betweens'] = with { "even" },
      ['"A1-A3" and "A1-A5" overlap'] = with({ ["A1-A3"] = "even", ["A1-A5"] = "even" }, named),
    }
  end)
end)

describe("keys", function()
  it("are missed where an in-between has none", function()
    local function at(frame, s, drawings)
      return function() s:drawing("A", frame, drawings or keys, { between = true }) end
    end
    local early = sheet_of({ [3] = "A1", [6] = false, [9] = "A5" }, { [1] = "inbetween",
      [5] = "inbetween", [11] = "inbetween" })
    local image = celspan.image { pixels = ("\0"):rep(4), size = { 1, 1 }, format = "rgba8" }
    raised.each {
      ["in-between at frame 1 has no key before it"] = at(1, early),
      ["in-between at frame 5 has no key after it"] = at(5, early),
      ["in-between at frame 11 has no key after it"] = at(11, early),
      ['shows "A9" at frame 3, which is missing from the table'] =
        at(3, sheet_of { [1] = "A1", [3] = "A9" }),
      ['the key "A1" is a picture, which has no in-betweens: trace it'] =
        at(3, marked, { A1 = image, A5 = image }),
      ['the key "A1" must be an object to be morphed, got string'] =
        at(3, marked, { A1 = "a", A5 = "b" }),
      ["no circle goes from its first place"] = function()
        marked:drawing("A", 3, keys, { pairs = { { { 0, 0 }, { 5, 5 }, { 0, 0 } } } })
      end,
    }
    assert.is_nil(early:drawing("A", 7, keys, { between = true }))
  end)

  it("that become each other without a sure pair are reported by check", function()
    local bench = workbench.new()
    bench:write("hairs.lua", [[
local celspan = require "celspan"
local s = require("celspan.sheet").new { layers = { "A" }, drawings = { A = { "1", [3] = "2" } },
  marks = { A = { [2] = "inbetween" } } }
local function lines(...)
  local list = {}
  for i, y in ipairs { ... } do list[i] = celspan.stroke { d = "M9 " .. y .. "h60", width = 2 } end
  return celspan.union(list)
end
local drawings = { lines(9, 15), lines(6, 12, 18) }
return celspan.film { size = { 99, 99 }, fps = 24, frames = 3, frame = function(f)
  return celspan.rostrum { celspan.cel { s:drawing("A", f, drawings, { between = true }) } }
end }]])
    local _, _, err = bench:celspan_inside "check hairs.lua"
    bench:remove()
    assert.is_truthy(err:find('the piece at (39, 15) may not be the one at (39, 12)', 1, true), err)
  end)
end)
