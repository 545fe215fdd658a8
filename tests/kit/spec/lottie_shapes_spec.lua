-- Lottie's shape layers: path operators one after another, styles after them, gradients with jumps,
-- eases of one dimension, frames with noise in their numbers, and files that are too much.
local lottie = require "celspan.lottie"
local lotties = require "tests.support.lotties"
local workbench = require "tests.support.workbench"

local bench, count = workbench.new(), 0
local still, keys, layer, box, document = lotties.still, lotties.keys, lotties.layer, lotties.box,
  lotties.document
local at = lotties.code
local RED, NONE = "ff0000 255", "000000 0"

local function read(layers, fields)
  count = count + 1
  return assert(lottie.read(bench:write(count .. ".json",
    lotties.json(document(layers, fields)))))
end

local function drawn(...) return read { layer { ... } } end

--- Which of points are there: "#..".
local function seen(art, points)
  local text = ""
  for _, p in ipairs(points) do text = text .. (at(art, 0, p[1], p[2]) == NONE and "." or "#") end
  return text
end

--- How far from y = 50 there is something at x, in whole units; -1: nothing is there.
local function reach(art, x)
  local far = -1
  for y = 0, 50 do
    if at(art, 0, x, 50 - y) ~= NONE or at(art, 0, x, 50 + y) ~= NONE then far = y end
  end
  return far
end

local fill = select(2, box(1, 1))
local function line(fields)
  local item = { ty = "st", c = { k = { 1, 0, 0, 1 } }, o = { k = 100 }, w = { k = 4 }, lc = 1,
                 lj = 1, ml = 10 }
  for name, value in pairs(fields or {}) do item[name] = value end
  return item
end

local function rect(x, y, w, h)
  return { ty = "rc", p = { k = { x, y } }, s = { k = { w, h } }, r = { k = 0 } }
end

local function way(v)
  local none = {}
  for i = 1, #v do none[i] = { 0, 0 } end
  return { ty = "sh", ks = { k = { c = false, v = v, i = none, o = none } } }
end

local function group(items, tr)
  local it = table.move(items, 1, #items, 1, {})
  tr = tr or {}
  tr.ty = "tr"
  it[#it + 1] = tr
  return { ty = "gr", it = it }
end

local function trim(from, to, m)
  return { ty = "tm", s = { k = from }, e = { k = to }, o = { k = 0 }, m = m or 1 }
end

teardown(function() bench:remove() end)

describe("path operators one after another", function()
  local zigzag = { ty = "zz", s = { k = 10 }, r = { k = 1 }, pt = { k = 1 } }

  it("are zig zag, twist and offset", function()
    -- one ridge in the middle of the line; its joints are moved, too
    local art = drawn(way { { 0, 50 }, { 100, 50 } }, zigzag, line())
    assert.is_true(reach(art, 50) >= 8)
    art = drawn(rect(50, 50, 40, 40), { ty = "op", a = { k = 10 }, lj = 1, ml = { k = 4 } }, fill)
    assert.same("#.", seen(art, { { 78, 78 }, { 82, 50 } }))
    art = drawn(rect(50, 50, 40, 8), { ty = "tw", a = { k = 90 }, c = { k = { 50, 50 } } }, fill)
    assert.same("#.", seen(art, { { 50, 52 }, { 60, 50 } }))
  end)

  it("do not undo each other", function()
    for name, change in pairs { zigzag = zigzag, twist = { ty = "tw", a = { k = 1 },
      c = { k = { 50, 50 } } } } do
      local plain = drawn(way { { 0, 50 }, { 100, 50 } }, change, line())
      local cut = drawn(way { { 0, 50 }, { 100, 50 } }, change, trim(0, 49), line())
      assert.same(reach(plain, 40), reach(cut, 40), name)
      assert.is_true(reach(plain, 60) >= 0, name)
      assert.same(-1, reach(cut, 60), name)
    end
    local corner = drawn(rect(50, 50, 40, 40), { ty = "op", a = { k = 10 }, lj = 1 },
      { ty = "rd", r = { k = 0 } }, fill)
    assert.same("#.", seen(corner, { { 78, 78 }, { 82, 50 } }))
    local merged = drawn(rect(30, 50, 40, 40), rect(50, 50, 40, 40), { ty = "mm", mm = 3 },
      { ty = "pb", a = { k = 0 } }, fill)
    assert.same("#.", seen(merged, { { 20, 50 }, { 50, 50 } }))
  end)

  it("are in the units of their group, and so in its scale", function()
    local wave = { ty = "zz", s = { k = 2 }, r = { k = 1 }, pt = { k = 1 } }
    local art = drawn(group({ way { { 0, 0 }, { 10, 0 } }, wave },
      { s = { k = { 500, 500 } }, p = { k = { 20, 50 } } }), line { w = { k = 1 } })
    assert.is_true(reach(art, 45) >= 8)
    art = drawn(group({ rect(0, 0, 10, 10), { ty = "op", a = { k = 2 }, lj = 1 } },
      { s = { k = { 500, 500 } }, p = { k = { 50, 50 } } }), fill)
    assert.same("#.", seen(art, { { 83, 50 }, { 87, 50 } }))
    art = drawn(group({ rect(0, 0, 10, 10), { ty = "op", a = { k = 2 }, lj = 1 } },
      { s = { k = { 500, 500 } }, p = { k = { 50, 50 } } }), line())
    assert.same(".#.", seen(art, { { 81, 50 }, { 85, 50 }, { 89, 50 } }))
  end)
end)

describe("lines of merged paths", function()
  local a, b = rect(40, 40, 40, 40), rect(60, 60, 40, 40)
  -- on the line of a inside b, of b inside a, of a outside b, of b outside a
  local points = { { 60, 50 }, { 50, 40 }, { 20, 30 }, { 80, 70 } }
  local function merged(mode, style)
    return drawn(a, b, { ty = "mm", mm = mode }, style or line())
  end

  it("go around the whole area", function()
    for mode, want in pairs { [1] = "####", [2] = "..##", [3] = ".##.", [4] = "##..",
                              [5] = "####" } do
      assert.same(want, seen(merged(mode), points))
    end
  end)

  it("with dashes go along each path", function()
    local art = merged(2, line { d = { { n = "d", v = { k = 1000 } } } })
    assert.same("####", seen(art, points))
  end)

  it("move with their group and keep their width", function()
    local art = drawn(group({ rect(-2, -2, 4, 4), rect(0, 0, 4, 4), { ty = "mm", mm = 2 } },
      { s = { k = { 1000, 1000 } }, p = { k = { 60, 60 } } }), line())
    assert.same(".##", seen(art, { { 60, 50 }, { 20, 30 }, { 80, 70 } }))
    assert.same(".", seen(art, { { 24, 30 } }))
  end)
end)

describe("a style", function()
  local copies = { ty = "rp", c = { k = 3 }, o = { k = 0 }, m = 1,
                   tr = { p = { k = { 30, 0 } }, so = { k = 100 }, eo = { k = 100 } } }

  it("after a repeater paints all its copies", function()
    local art = drawn(rect(10, 50, 10, 10), copies, fill)
    assert.same("###.", seen(art, { { 10, 50 }, { 40, 50 }, { 70, 50 }, { 25, 50 } }))
    art = drawn(rect(10, 50, 10, 10), { ty = "op", a = { k = 2 } }, copies, fill)
    assert.same("###.", seen(art, { { 16, 50 }, { 46, 50 }, { 76, 50 }, { 25, 50 } }))
  end)

  it("with a mode of its own is listed", function()
    local art = drawn(rect(50, 50, 10, 10), { ty = "fl", c = { k = { 1, 0, 0 } }, o = { k = 100 },
                                             bm = 3, nm = "tint" })
    assert.same({ "layers[0].shapes[1] 'tint': its mode 3 is shown as normal" }, art.skipped)
  end)

  it("of groups that are trimmed one after another is listed", function()
    local function two(m)
      return drawn(group { way { { 0, 20 }, { 100, 20 } }, line() },
        group { way { { 0, 80 }, { 100, 80 } }, line() }, trim(0, 50, m)).skipped
    end
    assert.same({}, two(1))
    assert.same({ "layers[0].shapes[2] 'art': it trims the paths of each group as one way, not "
      .. "those of all groups together" }, two(2))
    assert.same({}, drawn(way { { 0, 20 }, { 100, 20 } }, way { { 0, 80 }, { 100, 80 } },
      trim(0, 50, 2), line(), line()).skipped)
  end)
end)

describe("a gradient", function()
  local function gradient(count_of, k)
    return drawn(rect(50, 50, 100, 100), { ty = "gf", t = 1, o = { k = 100 }, s = { k = { 0, 0 } },
      e = { k = { 100, 0 } }, g = { p = count_of, k = { k = k } } })
  end

  it("jumps where two of its stops are at one place, also with stops of alpha", function()
    local art = gradient(4, { 0, 1, 0, 0, 0.5, 1, 0, 0, 0.5, 0, 0, 1, 1, 0, 0, 1, 0, 1, 1, 0.5 })
    assert.same("ff0000", at(art, 0, 49, 50):sub(1, 6))
    assert.same("0000ff", at(art, 0, 51, 50):sub(1, 6))
    art = gradient(2, { 0, 1, 0, 0, 1, 1, 0, 0, 0, 1, 0.5, 1, 0.5, 0, 1, 0 })
    assert.same({ RED, NONE }, { at(art, 0, 49, 50), at(art, 0, 51, 50) })
  end)

  it("mixes colours and alpha each on its own", function()
    local art = gradient(2, { 0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 1, 0 })
    local r, g, b, a = at(art, 0, 50, 50):match "(%x%x)(%x%x)(%x%x) (%d+)"
    assert.near(128, tonumber(r, 16), 3)
    assert.near(128, tonumber(b, 16), 3)
    assert.same({ "00", "128" }, { g, a })
  end)

  it("has a limit of stops of alpha, too", function()
    local k = { 0, 1, 0, 0, 1, 0, 0, 1 }
    for i = 0, 4000 do
      k[#k + 1], k[#k + 2] = i / 4000, i % 2
    end
    -- the 500th stop is at 0.125, its alpha 1
    assert.matches(" 255$", at(gradient(2, k), 0, 90, 50))
  end)
end)

describe("keyframes", function()
  it("with an ease for each dimension have the first one for all, which is listed", function()
    local function moving(to)
      local p = keys { { 0, { 0, 0 } }, { 100, to } }
      p.k[1].o, p.k[1].i = { x = { 0.5, 0 }, y = { 0, 0 } }, { x = { 0.5, 1 }, y = { 1, 1 } }
      return read { layer({ box(2, 2) }, { ks = { p = p } }) }
    end
    local art = moving { 100, 100 }
    local x, y, w, h = art:at(20):bounds()
    assert.near(x + w / 2, y + h / 2, 1e-9)
    assert.same({ "layers[0] 'art': the position has an ease for each dimension; the first stands "
      .. "for all" }, art.skipped)
    assert.same({}, moving({ 100, 0 }).skipped)
  end)

  it("that are held are at the frame that they mean", function()
    local p = keys { { 0, { 10, 50 }, h = true }, { 15.00000061, { 90, 50 }, h = true },
                     { 30, { 90, 50 } } }
    local art = read { layer({ box(4, 4) }, { ks = { p = p } }) }
    assert.same({ RED, RED }, { at(art, 14, 10, 50), at(art, 15, 90, 50) })
  end)
end)

describe("frames with noise in their numbers", function()
  it("are those that are meant", function()
    local art = read({ layer({ box(100, 100) }, { ip = 15.00000061, op = 90.0000036,
                                                  ks = { p = still { 50, 50 } } }) },
      { ip = 15.00000061, op = 90.0000036 })
    local film = art:film()
    assert.same({ 15, 90, 75, 15 }, { art.first, art.last, film.frames, film.first })
    assert.same({ RED, NONE }, { at(art, 15, 50, 50), at(art, 90, 50, 50) })
  end)
end)

describe("markers", function()
  it("are marks of the film, whatever their names are", function()
    local art = read({}, { markers = { { tm = 1, cm = "1", dr = 0 },
                                       { tm = 2, cm = "a,b:c", dr = 0 } } })
    assert.same({ "1", 1, 1 }, art.markers[1])
    local marks = art:film().marks
    assert.same({ 1, 2 }, { marks.m1, marks["a_b_c"] })
  end)
end)

describe("what does not change", function()
  it("keeps its object from frame to frame", function()
    local tr = { o = still(50), p = still { 50, 50 }, r = keys { { 0, 0 }, { 10, 90 } } }
    local inner = layer({ box(10, 10) }, { ks = tr, bm = 1, masksProperties = { { mode = "a",
      pt = still { c = true, v = { { -9, -9 }, { 9, -9 }, { 0, 9 } }, i = {}, o = {} } } } })
    local way_of = { ty = 0, refId = "c", ip = 0, op = 100, w = 90, h = 90, ks = tr }
    local art = read({ way_of, layer({ group({ rect(1, 2, 3, 4), fill }, tr) }, { ks = tr }) },
      { assets = { { id = "c", layers = { inner, inner } } } })
    assert.equal(art:at(20), art:at(30.5))
    assert.are_not.equal(art:at(2), art:at(3))
    assert.equal(art:at(30), art:at(99))
  end)
end)

describe("too much", function()
  it("of parents is cut, however they are ordered", function()
    for _, is_up in ipairs { true, false } do
      local list = {}
      for i = 1, 150 do
        list[i] = layer({ box(2, 2) }, { ind = i, ks = { p = still { 1, 0 } } })
        if is_up then list[i].parent = i < 150 and i + 1 or nil
        else list[i].parent = i > 1 and i - 1 or nil end
      end
      local art = read(list)
      assert.same(1, #art.skipped)
      assert.matches("its parents form a circle, or are too many; it has none", art.skipped[1])
    end
  end)

  it("of styles and changes is left out, and the rest is drawn", function()
    local list = { rect(50, 50, 100, 100), fill }
    for _ = 1, 700 do list[#list + 1] = fill end
    for _ = 1, 700 do list[#list + 1] = { ty = "rd", r = { k = 1 } } end
    local start = os.clock()
    local art = read { layer(list) }
    assert.same(RED, at(art, 0, 50, 50))
    assert.matches("it is left out, because the file has more than %d+ vertices to paint",
      art.skipped[1])
    assert.is_true(os.clock() - start < 20) -- 2.5 here; without a limit it grows as the square
  end)

  it("of dashes on a long line that is offset, is left out at once", function()
    local none = { { 0, 0 }, { 0, 0 } }
    local ground = { ty = "sh",
                   ks = { k = { c = false, v = { { 0, 50 }, { 1e7, 50 } }, i = none, o = none } } }
    local art = read { layer { ground, { ty = "op", a = still(10), lj = 1 },
      { ty = "st", c = { k = { 1, 0, 0 } }, o = { k = 100 }, w = { k = 4 },
        d = { { n = "d", v = { k = 10.5 } } } } } }
    local start = os.clock()
    assert.same(NONE, at(art, 0, 50, 50))
    assert.matches("it cannot be drawn at frame 0: .*a line with 476191 dashes cannot be offset",
      art.skipped[1])
    assert.is_true(os.clock() - start < 1)
  end)
end)
