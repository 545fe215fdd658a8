-- Lottie animations: what each feature draws, the list of what is not drawn, bad files, and the
-- program without a script. Files are written by the tests; a sample of the material is compared
-- with pictures by other renderers.
local celspan = require "celspan"
local lottie = require "celspan.lottie"
local lotties = require "tests.support.lotties"
local present = require "tests.support.present"
local raised = require "tests.support.raised"
local workbench = require "tests.support.workbench"

local bench = workbench.new()
local try, write = lotties.reader(bench)
local still, keys, layer, box, document = lotties.still, lotties.keys, lotties.layer, lotties.box,
  lotties.document
local at = lotties.code

local function read(layers, fields, options) return assert(try(layers, fields, options)) end

local RED, NONE = "ff0000 255", "000000 0"
local function placed(x, y, fields)
  local ks = { p = still { x, y } }
  for name, value in pairs(fields or {}) do ks[name] = value end
  return { ks = ks }
end

--- Where a box that is 2 wide lies along y = 50: the middle of its bounds.
local function middle(art, frame)
  local x, _, w = art:at(frame):bounds()
  -- the bounds have a margin of the pixels on both sides
  return x + w / 2
end

teardown(function() bench:remove() end)

describe("an animation", function()
  it("has the facts of its file", function()
    local art = read({}, { ip = 5, op = 35, w = 200, markers = { { tm = 10, cm = "jump",
      dr = 5 } } })
    assert.same({ { 200, 100 }, 25, 5, 35 }, { art.size, art.fps, art.first, art.last })
    assert.same({ { "jump", 10, 15 } }, art.markers)
    assert.same({}, art.skipped)
    assert.same(NONE, at(art, 6, 50, 50))
  end)

  it("is averaged over pixels in sRGB codes, also in a film of light", function()
    local art = read { layer({ box(41, 40, { 1, 0.5, 0, 1 }) }, placed(50.5, 50)) }
    local image = celspan.pixels(celspan.rostrum { celspan.cel { art:at(0) } },
      { size = { 100, 100 }, film = { 100, 100 } })
    local bytes = image:bytes { depth = 8, colour = "srgb", alpha = "straight" }
    local function pixel(x, y) return { bytes:byte(4 * (100 * y + x) + 1,
      4 * (100 * y + x) + 4) } end
    assert.same({ 255, 128, 0, 255 }, pixel(50, 50))
    local over = read { layer({ box(20, 20, { 1, 1, 1, 1 }) }, placed(50.5, 50)),
                        layer({ box(40, 40, { 0, 0, 0, 1 }) }, placed(50, 50)) }
    image = celspan.pixels(celspan.rostrum { celspan.cel { over:at(0) } },
      { size = { 100, 100 }, film = { 100, 100 } })
    bytes = image:bytes { depth = 8, colour = "srgb", alpha = "straight" }
    assert.near(128, pixel(40, 50)[1], 1) -- half white over black; as light it would be 188
  end)

  it("is a film with the numbers of its own frames", function()
    local art = read({ layer({ box(10, 10) }, placed(50, 50)) }, { ip = 5, op = 9.5,
      markers = { { tm = 6, cm = "go", dr = 0 } } })
    local film = art:film()
    assert.same({ 5, 5, 25 }, { film.frames, film.first, film.fps })
    assert.same(6, film.marks.go)
    film = read({}, { markers = { { tm = 1, cm = "2:a\r" }, { tm = 2, cm = " b, c " } } }):film()
    assert.same({ 1, 2 }, { film.marks["m2_a"], film.marks["b_ c"] })
  end)

  it("refuses what is no number, and what is unknown", function()
    local art = read {}
    raised.each {
      ["lottie: at takes a frame, a finite number, got nan"] = function() art:at(0 / 0) end,
      ["lottie: read takes a file name, got number"] = function() lottie.read(7) end,
      ["lottie: read: unknown field 'font'; did you mean 'fonts'?"] =
        function() lottie.read("x.json", { font = 1 }) end,
      ["lottie: read: fonts are files by name, such as { default = \"sans.ttf\" }"] =
        function() lottie.read("x.json", { fonts = { 7 } }) end,
      ["no.json: No such file"] = function() lottie.load "no.json" end,
    }
  end)
end)

describe("keyframes", function()
  local function moving(p) return read { layer({ box(2, 2) }, { ks = { p = p } }) } end

  it("are linear, held, or eased by their handles", function()
    local art = moving(keys { { 0, { 10, 50 } }, { 40, { 50, 50 }, h = true }, { 60, { 90, 50 } } })
    for frame, want in pairs { [0] = 10, [20] = 30, [10.5] = 20.5, [50] = 50, [60] = 90,
                               [70] = 90 } do
      assert.near(want, middle(art, frame), 1e-9)
    end
    local list = keys { { 0, { 0, 50 } }, { 10, { 100, 50 } } }
    list.k[1].o, list.k[1].i = { x = { 0.5 }, y = { 0 } }, { x = 0.5, y = 1 }
    assert.near(50, middle(moving(list), 5), 1e-6)
    assert.is_true(middle(moving(list), 2) < 12)
  end)

  it("may be many more than there are frames", function()
    local list = {}
    for i = 0, 120000 do
      list[i + 1] = ('{"t":%g,"s":[%d,50],"i":{"x":0.5,"y":1},"o":{"x":0.5,"y":0}}'):format(
        i / 1000, i % 100)
    end
    list[120001] = '{"t":120,"s":[70,50]}'
    local path = write(document({ layer({ box(2, 2) },
      { op = 200, ks = { p = { a = 1, k = "=[" .. table.concat(list, ",") .. "]" } } }) },
      { op = 200 }))
    local art = assert(lottie.read(path))
    assert.near(1, middle(art, 0.001), 1e-3)
    assert.near(70, middle(art, 120), 1e-3)
    -- at most 500 steps of Lua and 1 kB a key
    local code, _, err = bench:celspan("render %s --frames 50 --hash --progress none "
      .. "--limit steps=%d,memory=128M", path, 120000 * 500)
    assert.equal(0, code, err)
  end)

  it("are in the order of their times, however they are written", function()
    local list = keys { { 60, { 90, 50 } }, { 0, { 10, 50 } }, { 40, { 50, 50 } } }
    local art = moving(list)
    for frame, want in pairs { [0] = 10, [20] = 30, [50] = 70, [60] = 90, [99] = 90 } do
      assert.near(want, middle(art, frame), 1e-9)
    end
    list.k[2].s = nil -- the first one: it begins with no value
    assert.near(20, middle(moving { a = 1, k = { list.k[2], { t = 40, e = { 90, 50 },
      s = { 20, 50 } }, { t = 50 } } }, 40), 1e-9)
  end)

  it("of old files have their end in the same key", function()
    local art = moving { k = { { t = 0, s = { 10, 50 }, e = { 50, 50 } },
                               { t = 40, s = { 50, 50 }, e = { 90, 50 } }, { t = 60 } } }
    for frame, want in pairs { [0] = 10, [20] = 30, [50] = 70, [60] = 90, [80] = 90 } do
      assert.near(want, middle(art, frame), 1e-9)
    end
  end)

  it("go by what k holds, in any order", function()
    local art = moving { a = 0, k = { { t = 40, s = { 50, 50 } }, { t = 0, s = { 10, 50 } } } }
    assert.near(30, middle(art, 20), 1e-9)
  end)

  it("of a position go along a curve by its length", function()
    local list = keys { { 0, { 20, 20 } }, { 100, { 80, 20 } } }
    list.k[1].to, list.k[1].ti = { 0, 80 }, { 0, 80 }
    local art = moving(list)
    assert.near(50, middle(art, 50), 1e-3)
    local x, y, w, h = art:at(50):bounds()
    assert.near(80, y + h / 2, 1e-3)
    assert.near(0, w - h, 1e-6)
    local a, b = middle(art, 10) - 20, 80 - middle(art, 90)
    assert.near(a, b, 1e-3)
    assert.is_number(x)
  end)

  it("of a position may be one for each axis", function()
    local art = moving { s = true, x = keys { { 0, 10 }, { 10, 20 } }, y = still(50) }
    assert.near(15, middle(art, 5), 1e-9)
  end)

  it("mix outlines vertex by vertex", function()
    local function square(r)
      local none = { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } }
      return { c = true, i = none, o = none, v = { { -r, -r }, { r, -r }, { r, r }, { -r, r } } }
    end
    local path = { ty = "sh", ks = { a = 1, k = { { t = 0, s = { square(10) } },
                                                  { t = 10, s = { square(20) } } } } }
    local art = read { layer({ path, select(2, box(1, 1)) }, placed(50, 50)) }
    assert.same(RED, at(art, 5, 64, 50))
    assert.same(NONE, at(art, 5, 66, 50))
  end)
end)

describe("layers", function()
  it("are seen from their first frame up to, not at, their last", function()
    local art = read { layer({ box(20, 20) }, { ip = 5, op = 35, ks = placed(50, 50).ks }) }
    assert.same({ NONE, RED, RED, NONE }, { at(art, 4.9, 50, 50), at(art, 5, 50, 50),
                                            at(art, 34.9, 50, 50), at(art, 35, 50, 50) })
  end)

  it("lie in front of those after them, and follow their parents", function()
    local art = read { layer({ box(20, 20) }, { ks = { p = still { 30, 0 } }, parent = 7 }),
                       layer({ box(60, 60, { 0, 0, 1, 1 }) }, placed(50, 50)),
                       { ty = 3, ind = 7, ip = 0, op = 1, ks = placed(20, 50).ks } }
    assert.same({ RED, "0000ff 255" }, { at(art, 50, 50, 50), at(art, 50, 70, 50) })
  end)

  it("have scale, rotation, skew, anchor and opacity", function()
    local art = read { layer({ box(20, 4) }, { ks = { p = still { 50, 50 }, a = still { -10, 0 },
      s = still { 200, 100 }, r = still(90), o = still(50) } }) }
    assert.same({ "ff0000 128", NONE }, { at(art, 0, 50, 85), at(art, 0, 85, 50) })
    art = read { layer({ box(20, 20) }, { ks = { p = still { 50, 50 }, sk = still(45) } }) }
    assert.same({ RED, NONE }, { at(art, 0, 56, 41), at(art, 0, 56, 59) })
  end)

  it("that are solids, nulls or hidden", function()
    local art = read { { ty = 1, ip = 0, op = 9, sw = 40, sh = 30, sc = "#00ff00", ks = {} },
                       layer({ box(100, 100) }, { hd = true, ks = placed(50, 50).ks }) }
    assert.same({ "00ff00 255", NONE }, { at(art, 0, 20, 20), at(art, 0, 60, 20) })
  end)

  it("that are compositions have a clock, a speed and a frame of their own", function()
    local inner = layer({ box(20, 200) }, { ks = { p = keys { { 0, { 0, 0 } }, { 100, { 100,
      0 } } } } })
    local function comp(fields)
      local item = { ty = 0, refId = "c", ip = 0, op = 100, w = 80, h = 40, ks = {} }
      for name, value in pairs(fields) do item[name] = value end
      return read({ item }, { assets = { { id = "c", layers = { inner } } } })
    end
    local art = comp { st = 20, sr = 2 }
    assert.same({ RED, NONE, NONE }, { at(art, 80, 30, 20), at(art, 80, 45, 20), at(art, 80, 30,
      45) })
    art = comp { tm = keys { { 0, 0 }, { 100, 1 } } } -- seconds, of 25 frames
    assert.same({ RED, NONE }, { at(art, 80, 20, 20), at(art, 80, 40, 20) })
  end)

  it("have mattes: the layer above, or one by its number", function()
    local function pair(tt, fields)
      local by = layer({ box(20, 20, { 1, 1, 1, 1 }) }, { td = 1, ks = placed(50, 50).ks })
      local art = { tt = tt, ks = placed(50, 50).ks }
      for name, value in pairs(fields or {}) do art[name] = value end
      return { by, layer({ box(60, 60) }, art) }
    end
    local art = read(pair(1))
    assert.same({ RED, NONE }, { at(art, 0, 50, 50), at(art, 0, 70, 50) })
    art = read(pair(2))
    assert.same({ NONE, RED }, { at(art, 0, 50, 50), at(art, 0, 70, 50) })
    art = read(pair(3))
    assert.same({ RED, NONE }, { at(art, 0, 50, 50), at(art, 0, 70, 50) })
    local list = pair(1, { tp = 9 })
    table.insert(list, layer({ box(4, 60) }, { ind = 9, ks = placed(65, 50).ks }))
    art = read(list)
    assert.same({ NONE, RED }, { at(art, 0, 50, 50), at(art, 0, 65, 50) })
  end)

  it("have modes", function()
    local art = read { layer({ box(40, 40, { 0, 1, 0, 1 }) }, { bm = 16, ks = placed(50, 50).ks }),
                       layer({ box(60, 60) }, placed(50, 50)) }
    assert.same({ "ffff00 255", RED }, { at(art, 0, 50, 50), at(art, 0, 75, 50) })
  end)
end)

describe("masks", function()
  local function rectangle(x0, y0, x1, y1)
    local none = { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } }
    return { c = true, i = none, o = none, v = { { x0, y0 }, { x1, y0 }, { x1, y1 }, { x0, y1 } } }
  end
  local function masked(list)
    local masks = {}
    for i, one in ipairs(list) do
      masks[i] = { mode = one[1], inv = one.inv or false, o = still(one.o or 100),
                   x = one.x and still(one.x) or nil, pt = still(one[2]) }
    end
    return read { layer({ { ty = "rc", p = { k = { 50, 50 } }, s = { k = { 100, 100 } } },
                          select(2, box(1, 1)) }, { masksProperties = masks }) }
  end
  local left, top = rectangle(0, 0, 50, 100), rectangle(0, 0, 100, 50)
  --- Which quarters are there: top left, top right, bottom left, bottom right.
  local function quarters(art)
    local text = ""
    for _, p in ipairs { { 25, 25 }, { 75, 25 }, { 25, 75 }, { 75, 75 } } do
      text = text .. (at(art, 0, p[1], p[2]) == RED and "#" or ".")
    end
    return text
  end

  it("add, subtract, intersect and differ", function()
    for want, list in pairs {
      ["#.#."] = { { "a", left } }, ["###."] = { { "a", left }, { "a", top } },
      [".#.#"] = { { "s", left } }, ["..#."] = { { "a", left }, { "s", top } },
      ["#..."] = { { "a", left }, { "i", top } }, [".##."] = { { "a", left }, { "f", top } },
      ["..##"] = { { "a", top, inv = true } },
    } do
      assert.same(want, quarters(masked(list)))
    end
  end)

  it("have opacity and expansion", function()
    assert.same("ff0000 128", at(masked { { "a", left, o = 50 } }, 0, 25, 25))
    local art = masked { { "a", left, x = 10 } }
    assert.same({ RED, NONE }, { at(art, 0, 58, 50), at(art, 0, 62, 50) })
    assert.same(NONE, at(masked { { "a", left, x = -10 } }, 0, 45, 50))
  end)
end)

describe("shapes", function()
  local fill = select(2, box(1, 1))
  local function line(fields)
    local item = { ty = "st", c = { k = { 1, 0, 0, 1 } }, o = { k = 100 }, w = { k = 4 }, lc = 1,
      lj = 1 }
    for name, value in pairs(fields or {}) do item[name] = value end
    return item
  end
  local function way(v, closed)
    local none = {}
    for i = 1, #v do none[i] = { 0, 0 } end
    return { ty = "sh", ks = { k = { c = closed or false, v = v, i = none, o = none } } }
  end
  local function drawn(...) return read { layer { ... } } end

  it("are rectangles, ellipses, polygons and stars", function()
    local art = drawn({ ty = "el", p = { k = { 50, 50 } }, s = { k = { 60, 20 } } }, fill)
    assert.same({ RED, NONE }, { at(art, 0, 75, 50), at(art, 0, 75, 58) })
    art = drawn({ ty = "rc", p = { k = { 50, 50 } }, s = { k = { 60, 60 } }, r = { k = 30 } }, fill)
    assert.same({ RED, NONE }, { at(art, 0, 78, 50), at(art, 0, 75, 25) })
    art = drawn({ ty = "sr", sy = 1, p = { k = { 50, 50 } }, pt = { k = 4 }, ["or"] = { k = 40 },
                  ir = { k = 10 }, r = { k = 0 } }, fill)
    assert.same({ RED, NONE }, { at(art, 0, 50, 14), at(art, 0, 65, 35) })
    art = drawn({ ty = "sr", sy = 2, p = { k = { 50, 50 } }, pt = { k = 4 }, ["or"] = { k = 40 } },
      fill)
    assert.same({ RED, NONE }, { at(art, 0, 65, 35), at(art, 0, 75, 25) })
  end)

  it("are painted by the styles below them, also those of groups", function()
    local group = { ty = "gr", it = { { ty = "rc", p = { k = { 0, 0 } }, s = { k = { 20, 20 } } },
                                      { ty = "tr", p = { k = { 30, 30 } }, o = { k = 100 } } } }
    local art = drawn(group, fill)
    assert.same({ RED, NONE }, { at(art, 0, 35, 35), at(art, 0, 5, 5) })
    art = drawn(fill, group)
    assert.same(NONE, at(art, 0, 35, 35))
  end)

  it("have even-odd fills, dashes and hidden items", function()
    local a = { ty = "rc", p = { k = { 50, 50 } }, s = { k = { 60, 60 } } }
    local b = { ty = "rc", p = { k = { 50, 50 } }, s = { k = { 20, 20 } } }
    local art = drawn(a, b, { ty = "fl", c = { k = { 1, 0, 0, 1 } }, o = { k = 100 }, r = 2 })
    assert.same({ NONE, RED }, { at(art, 0, 50, 50), at(art, 0, 30, 50) })
    art = drawn(way({ { 0, 50 }, { 100, 50 } }), line { d = { { n = "d", v = { k = 10 } },
      { n = "g", v = { k = 20 } }, { n = "o", v = { k = 5 } } } })
    assert.same({ RED, NONE, RED }, { at(art, 0, 2, 50), at(art, 0, 15, 50), at(art, 0, 30, 50) })
    fill.hd = true
    assert.same(NONE, at(drawn(a, fill), 0, 50, 50))
    fill.hd = nil
  end)

  it("are trimmed one by one or together", function()
    local one, two = way { { 0, 20 }, { 100, 20 } }, way { { 0, 80 }, { 100, 80 } }
    local function cut(m) return { ty = "tm", s = { k = 25 }, e = { k = 75 }, o = { k = 0 },
      m = m } end
    local art = drawn(one, two, cut(1), line())
    assert.same({ NONE, RED, RED, NONE }, { at(art, 0, 20, 20), at(art, 0, 30, 20),
                                            at(art, 0, 70, 80), at(art, 0, 80, 80) })
    art = drawn(one, two, cut(2), line())
    assert.same({ NONE, RED, RED, NONE }, { at(art, 0, 40, 20), at(art, 0, 60, 20),
                                            at(art, 0, 40, 80), at(art, 0, 60, 80) })
    local turned = cut(1)
    turned.o = { k = 180 }
    art = drawn(one, turned, line())
    assert.same({ RED, NONE, RED }, { at(art, 0, 10, 20), at(art, 0, 50, 20), at(art, 0, 90, 20) })
  end)

  it("are merged, rounded, puckered and repeated", function()
    local a = { ty = "rc", p = { k = { 40, 50 } }, s = { k = { 40, 40 } } }
    local b = { ty = "rc", p = { k = { 60, 50 } }, s = { k = { 40, 40 } } }
    for mode, want in pairs { [1] = "###", [2] = "###", [3] = "#..", [4] = ".#.", [5] = "#.#" } do
      local art, got = drawn(a, b, { ty = "mm", mm = mode }, fill), ""
      for _, x in ipairs { 30, 50, 70 } do got = got .. (at(art, 0, x,
        50) == RED and "#" or ".") end
      assert.same(want, got)
    end
    local art = drawn(a, { ty = "rd", r = { k = 20 } }, fill)
    assert.same({ RED, NONE }, { at(art, 0, 22, 50), at(art, 0, 22, 32) })
    art = drawn(a, { ty = "pb", a = { k = 50 } }, fill)
    assert.same(NONE, at(art, 0, 22, 32))
    local tr = { ty = "tr", p = { k = { 30, 0 } }, so = { k = 100 }, eo = { k = 0 } }
    art = drawn({ ty = "rc", p = { k = { 10, 50 } }, s = { k = { 10, 10 } } }, fill,
      { ty = "rp", c = { k = 2 }, o = { k = 0 }, m = 1, tr = tr })
    assert.same({ RED, "ff0000 128", NONE }, { at(art, 0, 10, 50), at(art, 0, 40, 50),
                                               at(art, 0, 70, 50) })
  end)

  it("have gradients, with stops of alpha", function()
    local function gradient(k, fields)
      local item = { ty = "gf", t = 1, o = { k = 100 }, s = { k = { 0, 0 } }, e = { k = { 100,
        0 } },
                     g = { p = 2, k = { k = k } } }
      for name, value in pairs(fields or {}) do item[name] = value end
      return drawn({ ty = "rc", p = { k = { 50, 50 } }, s = { k = { 100, 100 } } }, item)
    end
    local art = gradient { 0, 1, 0, 0, 1, 0, 0, 1 }
    assert.same("800080 255", at(art, 0, 50, 50))
    art = gradient { 0, 1, 0, 0, 1, 1, 0, 0, 0, 1, 1, 0 }
    assert.same("ff0000 128", at(art, 0, 50, 50))
    art = gradient({ 0, 1, 0, 0, 1, 0, 0, 1 }, { t = 2, s = { k = { 50, 50 } }, e = { k = { 100,
      50 } } })
    assert.same({ RED, "0000ff 255" }, { at(art, 0, 50, 50), at(art, 0, 50, 0) })
  end)

  it("of files of version 4.0 have colours up to 255", function()
    local art = drawn({ ty = "rc", p = { k = { 50, 50 } }, s = { k = { 60, 60 } } },
      { ty = "fl", c = { k = { 118, 196, 181, 255 } }, o = { k = 100 } })
    assert.same("76c4b5 255", at(art, 0, 50, 50))
  end)
end)

describe("texts", function()
  local square = { ty = "gr", it = { { ty = "sh", ks = { k = { c = true,
    v = { { 0, -100 }, { 50, -100 }, { 50, 0 }, { 0, 0 } }, i = { { 0, 0 }, { 0, 0 }, { 0, 0 },
      { 0, 0 } },
    o = { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } } } } } } }
  local with = { chars = { { ch = "I", fFamily = "F", style = "R", size = 10, w = 100,
                             data = { shapes = { square } } },
                           { ch = " ", fFamily = "F", style = "R", size = 10, w = 100,
                             data = {} } },
                 fonts = { list = { { fName = "F-R", fFamily = "F", fStyle = "R",
                   ascent = 75 } } } }
  local function words(given, fields)
    local s = { s = 20, f = "F-R", t = "II", j = 0, fc = { 1, 0, 0 } }
    for name, value in pairs(given) do s[name] = value end
    local t = { d = { k = { { t = 0, s = s } } }, a = fields and fields.a }
    return { ty = 5, ip = 0, op = 100, ks = placed(50, 50).ks, t = t, nm = "title" }
  end

  it("come from outlines in the file, justified, in lines", function()
    for j, xs in pairs { [0] = { 55, 75 }, { 15, 35 }, { 35, 55 } } do
      local art = read({ words { j = j } }, with)
      for _, x in ipairs(xs) do assert.same(RED, at(art, 0, x, 40)) end
      assert.same(NONE, at(art, 0, xs[2] + 12, 40))
    end
    local art = read({ words { t = "I\3I", lh = 30 } }, with)
    assert.same({ RED, RED, NONE }, { at(art, 0, 55, 40), at(art, 0, 55, 70), at(art, 0, 75, 40) })
    art = read({ words { t = "I I", sz = { 30, 90 }, ps = { -50, -50 } } }, with)
    assert.same({ RED, RED }, { at(art, 0, 5, 10), at(art, 0, 5, 30) })
  end)

  it("come from the fonts that are given; one that is missing is listed", function()
    local art = read({ words { t = "H" } }, nil,
      { fonts = { default = os.getenv "PWD" .. "/scripts/type/block.ttf" } })
    assert.same({}, art.skipped)
    assert.same(RED, at(art, 0, 52, 45))
    art = read({ words { t = "H" } })
    assert.same(NONE, at(art, 0, 52, 45))
    assert.matches("^layers%[0%] 'title': no font is given for 'F%-R'", art.skipped[1])
  end)

  it("have animators with ranges", function()
    local function animated(a, s)
      return read({ words({}, { a = { { a = a, s = s } } }) }, with)
    end
    local second = { s = still(50), e = still(100), a = still(100), b = 1, sh = 1, r = 1 }
    local art = animated({ p = still { 0, 40 } }, second)
    assert.same({ RED, NONE, RED }, { at(art, 0, 55, 40), at(art, 0, 75, 40), at(art, 0, 75, 80) })
    art = animated({ fc = still { 0, 0, 1 } }, second)
    assert.same({ RED, "0000ff 255" }, { at(art, 0, 55, 40), at(art, 0, 75, 40) })
    art = animated({ o = still(0) }, { s = still(0), e = still(100), a = still(50), sh = 1 })
    assert.same("ff0000 128", at(art, 0, 55, 40))
  end)
end)

describe("effects", function()
  local function layer_with(effects)
    return read { layer({ box(40, 40) }, { ks = placed(50, 50).ks, ef = effects }) }
  end
  local function values(...)
    local list = {}
    for i, value in ipairs { ... } do list[i] = { v = still(value) } end
    return list
  end

  it("are tint, fill, levels and drop shadow; others are listed", function()
    local art = layer_with { { ty = 21, ef = values(0, 0, { 0, 1, 0, 1 }, 0, 0, 0, 1) } }
    assert.same("00ff00 255", at(art, 0, 50, 50))
    art = layer_with { { ty = 20, ef = values({ 0, 0, 1, 1 }, { 0, 0, 1, 1 }, 100) } }
    assert.same("0000ff 255", at(art, 0, 50, 50))
    art = layer_with { { ty = 25, ef = values({ 0, 0, 1, 1 }, 255, 90, 25, 0, 0) } }
    assert.same({ RED, "0000ff 255" }, { at(art, 0, 50, 50), at(art, 0, 85, 50) })
    art = layer_with { { ty = 24, mn = "ADBE Easy Levels2", ef = values(1, 0, 0, 1, 1, 0, 0.5) } }
    assert.same("800000 255", at(art, 0, 50, 50))
    art = layer_with { { ty = 30, mn = "ADBE Twirl", nm = "swirl" } }
    assert.same({ "layers[0].ef[0] 'swirl': the effect ADBE Twirl is left out" }, art.skipped)
  end)
end)

describe("what is left out", function()
  it("is listed with its place in the file", function()
    local item = layer({ box(10, 10) }, { nm = "star", ks = { p = { k = { 50, 50 },
      x = "wiggle()" },
                                                              rx = still(30) } })
    local art = read { item, { ty = 13, ip = 0, op = 9, nm = "eye" },
                       { ty = 2, refId = "none", ip = 0, op = 9, ks = {} },
                       { ty = 0, refId = "none", ip = 0, op = 9, ks = {} } }
    assert.same({
      "layers[0] 'star': it is turned in 3D, which is shown flat, without perspective",
      "layers[0] 'star': the position has an expression, which is not run; the value without it "
        .. "is shown",
      "layers[1] 'eye': cameras are left out",
      "layers[2]: the picture 'none' is not in the file",
      "layers[3]: the composition 'none' is not in the file",
    }, art.skipped)
    assert.same(RED, at(art, 0, 50, 50))
  end)
end)

describe("slots", function()
  local slots = { tint = { p = still { 1, 0, 0 } }, wide = { p = still(40) } }
  local item = layer({ { ty = "rc", p = { k = { 0, 0 } }, s = { k = { 40, 40 } } },
                       { ty = "fl", c = { sid = "tint" }, o = { k = 100 } } }, placed(50, 50))

  it("are values from outside", function()
    local art = read({ item }, { slots = slots })
    assert.same({ kind = "colour", value = "#ff0000" }, art.slots.tint)
    assert.same({ kind = "number", value = 40 }, art.slots.wide)
    assert.same(RED, at(art, 0, 50, 50))
    art = read({ item }, { slots = slots }, { set = { tint = "#0f0" } })
    assert.same("00ff00 255", at(art, 0, 50, 50))
  end)

  it("that are unknown or wrong are refused", function()
    local path = write(document({ item }, { slots = slots }))
    for message, set in pairs { ["there is no slot 'tnt'; did you mean 'tint'?"] = { tnt = 1 },
                                ["the slot 'tint' takes a colour, such as \"#f80\""] = { tint = 7 },
    } do
      local _, got = lottie.read(path, { set = set })
      assert.same(path .. ": " .. message, got)
    end
  end)

  it("are set by themes of a dotLottie file", function()
    for version, folder in pairs { ["1"] = { "animations/", "themes/" }, ["2"] = { "a/", "t/" } } do
      local path = write(lotties.archive {
        { "manifest.json", lotties.json { version = version, animations = { { id = "m" } },
          themes = { { id = "dark" } }, stateMachines = { { id = "hover" } } } },
        { folder[1] .. "m.json", lotties.json(document({ item }, { slots = slots })) },
        { folder[2] .. "dark.json",
          lotties.json { rules = { { id = "tint", type = "Color", value = { 0, 0, 1 } } } } },
      }, "lottie")
      local art = assert(lottie.read(path, { theme = "dark" }))
      assert.same({ "0000ff 255", { "dark" }, { "hover" } }, { at(art, 0, 50, 50), art.themes,
        art.states })
      local _, message = lottie.read(path, { theme = "drk" })
      assert.same(path .. ": there is no theme 'drk'; did you mean 'dark'?", message)
    end
  end)
end)

describe("a bad file", function()
  local function refused(what, ending)
    local path = write(what, ending)
    local art, message = lottie.read(path)
    assert.is_nil(art)
    return message:gsub("^" .. path:gsub("%p", "%%%0") .. ": ", "")
  end

  it("is refused with its place", function()
    assert.same("line 1: a value is missing or not JSON", (refused "{\"w\":NaN}"))
    assert.same("it is no Lottie animation: the JSON is no object", (refused "[1]"))
    assert.same("it is no Lottie animation: it has no list 'layers'", (refused "{\"w\":10}"))
    for message, fields in pairs {
      ["w must be a number, got string"] = { w = "x" },
      ["w is 1e+300; it must be from 1 to 1048576"] = { w = 1e300 },
      ["fr is 0; it must be from 0.001 to 1000"] = { fr = 0 },
      ["op is -35; it must be after ip, 0"] = { op = -35 },
    } do
      assert.same(message, (refused(document({}, fields))))
    end
  end)

  it("is refused if it is a damaged archive", function()
    local good = lotties.archive { { "manifest.json",
      lotties.json { animations = { { id = "m" } } } } }
    assert.matches("the archive has no 'a/m.json'$", (refused(good, "lottie")))
    assert.matches("the archive has no 'manifest.json'$",
      (refused(lotties.archive { { "x", "y" } }, "lottie")))
    assert.is_string((refused(good:sub(1, 50), "lottie")))
    assert.matches("manifest.json names no animation",
      (refused(lotties.archive { { "manifest.json", "{}" } }, "lottie")))
  end)

  it("is named as no animation if it is JSON, or has such a name, and not a script", function()
    for text, message in pairs { [""] = "it is empty", ["\239\187\191[1]"] = "JSON is no object",
      ["null"] = "JSON is no object", ["[[]]"] = "JSON is no object" } do
      local path = bench:write("none.json", text)
      local code, _, err = bench:celspan("info %s", path)
      assert.equal(3, code, err)
      assert.matches("it is no Lottie animation: .*" .. message, err)
    end
  end)

  it("that is too deep or too large is a fault of the input for each verb", function()
    local drawing = '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9">%s%s</svg>'
    local bomb = lotties.bomb()
    local files = {
      ["deep.json"] = '{"v":' .. ("["):rep(300) .. ("]"):rep(300) .. "}",
      ["many.json"] = lotties.json(document({ { ty = 0, refId = "c0" } }, { assets = (function()
        local assets = {}
        for i = 0, 18 do
          local one = { ty = 0, refId = "c" .. i + 1 }
          assets[i + 1] = { id = "c" .. i, layers = { one, one } }
        end
        return assets
      end)() })),
      ["deep.svg"] = drawing:format(("<g>"):rep(1000), ("</g>"):rep(1000)),
      ["bomb.lottie"] = lotties.archive { { "manifest.json",
        lotties.json { animations = { { id = "m" } } } }, { "a/m.json", bomb, 8 } },
      ["first.lottie"] = lotties.archive { { "manifest.json", bomb, 8 } },
    }
    for name, text in pairs(files) do
      local path = bench:write(name, text)
      for _, words in ipairs { "info %s", "render %s --hash --progress none" } do
        local code, _, err = bench:celspan(words, path)
        assert.equal(4, code, name .. ": " .. words .. ": " .. err)
      end
      os.remove(path)
    end
  end)

  it("names kinds that are no numbers or texts without an address", function()
    local art = read({ { ty = { 4 }, ip = 0, op = 9, ks = {} }, { ty = 2, refId = { 1 }, ks = {} },
      layer({ box(2, 2) }, { ef = { { ty = { 1 } } }, sy = { { ty = { 2 } } } }) })
    assert.same({ "layers[0]: layers of the kind table are left out",
      "layers[1]: the picture 'table' is not in the file",
      "layers[2].ef[0] 'art': the effect table is left out",
      "layers[2].sy[0] 'art': the layer style table is left out" }, art.skipped)
  end)

  it("has no pictures with a zero byte in their names", function()
    bench:write("ok.png", "x")
    local art = read({ { ty = 2, refId = "p", ip = 0, op = 9, ks = {} } },
      { assets = { { id = "p", p = "ok.png\0../x", u = "", w = 4, h = 4 } } })
    assert.matches("there is no file 'ok.png", art.skipped[1], 1, true)
  end)

  it("with compositions or parents in circles is drawn without them", function()
    local art = read({ { ty = 0, refId = "a", ip = 0, op = 9, w = 9, h = 9, ks = {} } },
      { assets = { { id = "a", layers = { { ty = 0, refId = "a", ip = 0, op = 9, w = 9, h = 9,
        ks = {} } } } } })
    assert.same(NONE, at(art, 0, 5, 5))
    assert.matches("the composition contains itself", art.skipped[1])
    art = read { layer({ box(10, 10) }, { ind = 1, parent = 2, ks = placed(25, 25).ks }),
                 layer({ box(10, 10) }, { ind = 2, parent = 1, ks = placed(25, 25).ks }) }
    assert.matches("its parents form a circle", art.skipped[1])
    art = read { layer({ box(10, 10) }, { ind = 1, tt = 1, tp = 2 }),
                 layer({ box(10, 10) }, { ind = 2, tt = 1, tp = 1 }) }
    assert.matches("its mattes form a circle", art.skipped[1])
    assert.is_truthy(at(art, 0, 5, 5))
  end)

  it("with compositions that double, or too many layers, is refused", function()
    local assets = {}
    for i = 0, 39 do
      local one = { ty = 0, refId = "c" .. i + 1, ip = 0, op = 9, w = 9, h = 9, ks = {} }
      assets[i + 1] = { id = "c" .. i, layers = { one, one } }
    end
    assets[41] = { id = "c40", layers = { layer { box(1, 1) } } }
    assert.same("layers: with all compositions unfolded there are more than 200000; that is the "
      .. "limit",
      (refused(document({ { ty = 0, refId = "c0", ip = 0, op = 9, w = 9, h = 9, ks = {} } },
        { assets = assets }))))
  end)

  it("with wrong or huge numbers is drawn as far as it goes", function()
    for _, k in ipairs { "=null", "=[null,null]", "=1e308", "=[1e308,-1e308]", "=\"x\"", "=[]",
      "={}",
                         "=[{\"t\":0}]", "=[{\"t\":\"x\",\"s\":[1]},{\"s\":null,\"t\":1e308}]",
                           "=true" } do
      local art = read { layer({ { ty = "rc", p = { k = k }, s = { k = k }, r = { k = k } },
        { ty = "sh", ks = { k = k } }, { ty = "el", p = { k = k }, s = k }, { ty = "sr",
          pt = { k = k } },
        { ty = "tm", s = { k = k }, e = { k = k }, o = { k = k } },
        { ty = "rp", c = { k = k }, o = { k = k }, tr = { p = { k = k }, s = { k = k } } },
        { ty = "fl", c = { k = k }, o = { k = k } }, { ty = "st", c = { k = k }, w = { k = k },
          o = {},
          d = { { n = "d", v = { k = k } } }, ml = k },
        { ty = "gf", g = { p = k, k = { k = k } }, s = { k = k }, e = { k = k } } },
        { ks = { p = { k = k }, a = { k = k }, s = { k = k }, r = { k = k }, o = k,
          sk = { k = k } },
          masksProperties = { { mode = "a", pt = { k = k }, o = { k = k }, x = { k = k },
            f = { k = k } } } }),
        { ty = 5, ip = 0, op = 9, ks = k, t = { d = { k = k }, a = { { a = { p = { k = k } },
          s = k } } } },
        { ty = k, tt = k, parent = k, bm = k, ind = k, ef = k, shapes = k } }
      assert.is_userdata(art:at(0))
      assert.is_userdata(art:at(7.5))
    end
  end)
end)

describe("the program", function()
  it("reads an animation once, and again only for values that are set", function()
    if not present.program "strace" then return pending "there is no strace" end
    local slots = { tint = { p = still { 1, 0, 0 } } }
    local item = layer { { ty = "rc", p = { k = { 0, 0 } }, s = { k = { 40, 40 } } },
                         { ty = "fl", c = { sid = "tint" }, o = { k = 100 } } }
    bench:write("once.json", lotties.json(document({ item }, { slots = slots })))
    local function readings(options)
      local code, _, err = bench:inside(("ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 strace -f "
        .. "-o calls -e trace=openat '%s' probe once.json 1 1 %s"):format(
        workbench.absolute, options))
      assert.same(0, code, err)
      return select(2, bench:read("calls"):gsub("once%.json", ""))
    end
    local once = readings ""
    assert.same(once + 1, readings "--set tint=#00f")
  end)

  it("takes an animation without a script, with its slots as parameters", function()
    local slots = { tint = { p = still { 1, 0, 0 } }, ["bar width"] = { p = still(4) } }
    local item = layer({ { ty = "rc", p = { k = { 0, 0 } }, s = { k = { 40, 40 } } },
                         { ty = "fl", c = { sid = "tint" }, o = { k = 100 } },
                         { ty = "st", c = { k = { 0, 0, 0 } }, o = { k = 100 },
                           w = { sid = "bar width" } } },
      placed(50, 50))
    bench:write("logo.json", lotties.json(document({ item }, { slots = slots, ip = 10, op = 13 })))
    local code, out, err = bench:celspan("info %s/logo.json", bench.folder)
    assert.same({ 0, "" }, { code, err })
    assert.matches("parameter bar_width number 4", out)
    assert.matches("parameter tint colour #ff0000", out)
    assert.matches("\nframes 3\nfirst 10\n", out)
    assert.matches("\nformat lottie\n", out)
    code, out, err = bench:celspan("check %s/logo.json", bench.folder)
    assert.same({ 0, "", "celspan: 3 frames checked: no faults\n" }, { code, out, err })
    bench:write("rows.csv", "name,tint\na,#00f\nb,#0f0\n")
    code, out, err = bench:celspan("render %s/logo.json -o '%s/{name}.####.png' "
      .. "--table %s/rows.csv --progress none", bench.folder, bench.folder, bench.folder)
    assert.same({ 0, "" }, { code, err })
    assert.same("", out)
    local pictures = {}
    for _, name in ipairs(bench:files "") do
      if name:find "^[ab]%.%d+%.png$" then pictures[#pictures + 1] = name end
    end
    assert.same({ "a.0010.png", "a.0011.png", "a.0012.png", "b.0010.png", "b.0011.png",
                  "b.0012.png" }, pictures)
    code, out, err = bench:celspan("render %s/logo.json -o x.png --set tnt=1", bench.folder)
    assert.same({ 2, "" }, { code, out })
    assert.matches("has no parameter 'tnt'; did you mean 'tint'", err)
  end)
end)

describe("animations of the material", function()
  local pick = { "android-AndroidWave.json", "android-Tests-StartEndFrame.json",
                 "android-Mobilo-BlinkingCursor.json" }
  local it = present.material and it or pending

  it("look as other renderers draw them", function()
    local folder = present.material .. "/lottie-airbnb/"
    local rows = {}
    for line in io.lines(folder .. "lottie.tsv") do
      local cells = {}
      for cell in (line .. "\t"):gmatch "([^\t]*)\t" do cells[#cells + 1] = cell end
      rows[cells[1]] = cells
    end
    for _, name in ipairs(pick) do
      local art = assert(lottie.read(folder .. name))
      local w, h = rows[name][10]:match "(%d+)x(%d+)"
      w, h = math.tointeger(w), math.tointeger(h)
      local first, n = folder .. name:gsub("%.%w+$", ".skottie.png"), 0
      for frame in rows[name][9]:gmatch "%d+" do
        local picture = celspan.image { file = first, source = { n * w, 0, w, h } }
        local function bytes(object)
          return celspan.pixels(celspan.rostrum { back = "#fff", celspan.cel { object } },
            { size = { w, h }, film = { w, h } }):bytes { depth = 8, colour = "srgb",
              alpha = "straight" }
        end
        local a = bytes(art:at(tonumber(frame)):scale(w / art.size[1], h / art.size[2]))
        local b, off = bytes(picture), 0
        for i = 1, #a do
          if math.abs(a:byte(i) - b:byte(i)) > 24 then off = off + 1 end
        end
        assert.is_true(off / #a <= 0.01, ("%s at %s: %d codes differ"):format(name, frame, off))
        n = n + 1
      end
    end
  end)
end)
