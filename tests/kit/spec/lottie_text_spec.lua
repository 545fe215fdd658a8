-- Lottie texts: what animators and ranges change, outlines that the file lacks, and texts on a
-- path.
local lotties = require "tests.support.lotties"
local workbench = require "tests.support.workbench"

local bench = workbench.new()
local try = lotties.reader(bench)
local still, at = lotties.still, lotties.code
local RED, NONE = "ff0000 255", "000000 0"

teardown(function() bench:remove() end)

--- A square of half the size beside the pen. Its outline is open, as some files have it.
local function square()
  local none = { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } }
  return { ty = "gr", it = { { ty = "sh", ks = { k = { c = false, i = none, o = none,
    v = { { 0, -50 }, { 50, -50 }, { 50, 0 }, { 0, 0 } } } } } } }
end
local with = { chars = { { ch = "I", fFamily = "F", style = "R", size = 10, w = 100,
                           data = { shapes = { square() } } } },
               fonts = { list = { { fName = "F-R", fFamily = "F", fStyle = "R" } } } }

--- A text of two letters, which are 20 apart; each is a red square of 10.
local function read(given, fields, options)
  local s = { s = 20, f = "F-R", t = "II", j = 0, fc = { 1, 0, 0 } }
  for name, value in pairs(given) do s[name] = value end
  fields = fields or {}
  local item = { ty = 5, ip = 0, op = 100, nm = "title", ks = fields.ks or { p = still { 50, 50 } },
                 masksProperties = fields.masks,
                 t = { d = { k = { { t = 0, s = s } } }, a = fields.a, p = fields.p,
                       m = fields.m } }
  return assert(try({ item }, with, options))
end

local function animated(a, s) return read({}, { a = { { a = a, s = s } } }) end

describe("animators", function()
  it("change the anchor, the opacity of fills and strokes, and the axis of skews", function()
    local art = animated { a = still { 10, 0 } }
    assert.same({ RED, NONE }, { at(art, 0, 45, 45), at(art, 0, 55, 45) })
    art = animated { fo = still(50) }
    assert.same("ff0000 128", at(art, 0, 55, 45))
    art = read({ sc = { 0, 0, 1 }, sw = 4, of = true }, { a = { { a = { so = still(0),
      fo = still(100) } } } })
    assert.same({ RED, NONE }, { at(art, 0, 51, 45), at(art, 0, 49, 45) })
    local plain, turned = animated { sk = still(45) }, animated { sk = still(45), sa = still(90) }
    assert.is_false(at(plain, 0, 57, 42) == at(turned, 0, 57, 42))
  end)

  it("list what they have and do not change", function()
    assert.same({ "layers[0].t.a[0] 'title': what the animator changes by 'bl', 'rx' is left out" },
      animated({ rx = still(1), bl = still { 1, 1 }, p = still { 0, 0 } }).skipped)
    assert.same({ "layers[0] 'title': the grouping of its anchors is left out; each letter turns "
      .. "about its middle" }, read({}, { m = { g = 2, a = still { 0, 0 } } }).skipped)
  end)

  it("end strokes of letters in corners, also where an outline is open", function()
    local art = read { sc = { 0, 0, 1 }, sw = 4 }
    assert.same("0000ff 255", at(art, 0, 49, 45))
    assert.same("0000ff 255", at(art, 0, 48.2, 38.2)) -- a round join would leave it clear
  end)
end)

describe("ranges", function()
  local function opacities(fields)
    local s = { s = still(0), e = still(50), a = still(100), b = 1, sh = 1, r = 1 }
    for name, value in pairs(fields) do s[name] = value end
    local art = animated({ o = still(0) }, s)
    return { at(art, 0, 55, 45), at(art, 0, 75, 45) }
  end

  it("of squares are smooth or sharp", function()
    assert.same({ NONE, "ff0000 128" }, opacities { e = still(75) })
    assert.same({ NONE, RED }, opacities { e = still(75), sm = still(0) })
    assert.same({ NONE, NONE }, opacities { e = still(80), sm = still(0) })
    assert.same({ NONE, "ff0000 158" }, opacities { e = still(72), sm = still(50) })
  end)

  it("are eased, and subtracted", function()
    assert.same({ "ff0000 191", "ff0000 64" }, opacities { e = still(100), sh = 2 })
    local soft = opacities { e = still(100), sh = 2, ne = still(100), xe = still(100) }
    assert.is_true(tonumber(soft[1]:match " (%d+)$") > 225)
    assert.same({ RED, NONE }, opacities { m = 2 })
  end)
end)

describe("characters that the outlines in the file lack", function()
  it("are left out and listed, or come from the font that is given", function()
    local art = read { t = "I.I" }
    assert.same({ RED, RED }, { at(art, 0, 55, 45), at(art, 0, 75, 45) })
    assert.same({ "layers[0] 'title': the file has no outlines of '.'; they are left out" },
      art.skipped)
    art = read({ t = "IHI" }, nil, { fonts = { default = os.getenv "PWD"
      .. "/scripts/type/block.ttf" } })
    assert.same({ RED, RED }, { at(art, 0, 55, 45), at(art, 0, 72, 45) })
    assert.matches("no outlines of 'H'; they are those of the font that is given", art.skipped[1])
  end)
end)

describe("a text on a path", function()
  local function line(v, closed)
    local none = {}
    for i = 1, #v do none[i] = { 0, 0 } end
    return { { mode = "n", pt = still { c = closed or false, v = v, i = none, o = none } } }
  end
  local down = line { { 20, 0 }, { 20, 80 } }
  local across = line { { 0, 60 }, { 80, 60 } }
  local function on(masks, p, given, ks)
    local path = { m = 0, p = still(1) }
    for name, value in pairs(p or {}) do path[name] = value end
    return read(given or {}, { masks = masks, p = path, ks = ks or {} })
  end

  it("turns with it, or is upright", function()
    local art = on(down)
    assert.same({ RED, RED, NONE }, { at(art, 0, 25, 5), at(art, 0, 25, 25), at(art, 0, 15, 5) })
    art = on(down, { p = still(0) })
    assert.same({ RED, RED, NONE }, { at(art, 0, 15, 5), at(art, 0, 15, 25), at(art, 0, 25, 5) })
    assert.same({}, art.skipped)
  end)

  it("has margins, and is justified between them", function()
    assert.same({ RED, NONE }, { at(on(across, { f = still(10) }), 0, 15, 55),
                                 at(on(across, { f = still(10) }), 0, 5, 55) })
    local art = on(across, { l = still(-20) }, { j = 1 })
    assert.same({ RED, RED, NONE }, { at(art, 0, 25, 55), at(art, 0, 45, 55), at(art, 0, 65, 55) })
    art = on(across, { f = still(20) }, { j = 2 })
    assert.same({ RED, RED }, { at(art, 0, 35, 55), at(art, 0, 55, 55) })
    art = on(across, { a = still(1) })
    assert.same({ RED, RED, NONE }, { at(art, 0, 5, 55), at(art, 0, 65, 55), at(art, 0, 25, 55) })
  end)

  it("goes the other way, round a closed one, and straight beyond an open one", function()
    local art = on(across, { r = still(1) })
    assert.same({ RED, NONE }, { at(art, 0, 75, 65), at(art, 0, 75, 55) })
    art = on(across, { f = still(70) })
    assert.same({ RED, RED }, { at(art, 0, 75, 55), at(art, 0, 95, 55) })
    local round = line({ { 20, 20 }, { 80, 20 }, { 80, 80 }, { 20, 80 } }, true)
    art = on(round, { f = still(60) })
    assert.same({ RED, RED }, { at(art, 0, 85, 25), at(art, 0, 85, 45) })
    assert.same(RED, at(on(round, { f = still(-20) }), 0, 15, 35))
  end)

  it("goes along curves by their length", function()
    local r, k = 40, 40 * 0.5519150244935106
    local masks = { { mode = "n", pt = still { c = false, v = { { 10, 50 }, { 50, 10 } },
      o = { { 0, -k }, { 0, 0 } }, i = { { 0, 0 }, { -k, 0 } } } } }
    local art = on(masks, { a = still(1) })
    local quarter = math.pi / 2 * r
    for _, s in ipairs { 10, quarter - 10 } do -- the middles of the letters; the squares end there
      local angle = math.pi + (s - 5) / r
      assert.same(RED, at(art, 0, 50 + (r + 5) * math.cos(angle), 50 + (r + 5) * math.sin(angle)))
    end
  end)

  it("that is missing or empty is as without it", function()
    local art = on(nil, nil, nil, { p = still { 50, 50 } })
    assert.same(RED, at(art, 0, 55, 45))
    assert.matches("the text's path, the mask 0, is not in the file", art.skipped[1])
    assert.same(RED, at(on(line {}, nil, nil, { p = still { 50, 50 } }), 0, 55, 45))
  end)
end)
