-- Objects between two others: their ends, what keeps its place, parts, and what is refused.
local celspan = require "celspan"
local raised = require "tests.support.raised"
local own = require "tests.support.own"
local native, outlines = own "celspan.native", own "celspan.outlines"

local function pixels(object)
  return assert(celspan.pixels(celspan.rostrum { celspan.cel { object } },
    { size = { 64, 64 }, film = { 64, 64 } }))
end

--- The largest difference of two objects' pixels, in light, premultiplied.
local function difference(a, b)
  local p, q, most = pixels(a), pixels(b), 0
  for y = 0, 63 do
    for x = 0, 63 do
      local one, other = { p:get(x, y) }, { q:get(x, y) }
      for k = 1, 4 do most = math.max(most, math.abs(one[k] - other[k])) end
    end
  end
  return most
end

--- How much the same curve may differ at a pixel, as different chords are drawn of it.
local FLAT = 1 / 255

local function star(corners, x, y, radius)
  local list = {}
  for i = 0, 2 * corners - 1 do
    local r, angle = i % 2 == 0 and radius or radius / 2, math.pi * i / corners
    list[i + 1] = ("%s%g %g"):format(i == 0 and "M" or "L", x + r * math.sin(angle),
      y - r * math.cos(angle))
  end
  return table.concat(list) .. "Z"
end

local square = celspan.rect { 10, 10, 40, 40, texture = "#1971c2" }
local disc = celspan.circle { centre = { 32, 32 }, radius = 20, texture = "#e03131" }
local five = celspan.path { d = star(5, 30, 34, 24), texture = "#e03131" }
local ring = celspan.path { d = "M32 8 a24 24 0 1 0 .01 0 Z M32 22 a10 10 0 1 1 -.01 0 Z",
                            rule = "evenodd", texture = "#00796b" }
local line = celspan.stroke { d = "M6 50 L30 10 L58 40", width = 3, texture = "#222222" }
local wave = celspan.stroke { d = "M4 20 C20 60 40 -20 60 30", width = 9, texture = "#cc2222" }

describe("a morph", function()
  it("begins and ends with its objects, without a jump", function()
    for _, pair in ipairs { { square, disc }, { disc, five }, { five, ring }, { line, wave },
      { square, wave }, { ring, line }, { square, square:rotate(30) } } do
      local a, b = pair[1], pair[2]
      for _, u in ipairs { 0, -1 } do assert.equal(0, difference(celspan.morph(a, b, u), a)) end
      for _, u in ipairs { 1, 7 } do assert.equal(0, difference(celspan.morph(a, b, u), b)) end
      assert.is_true(difference(celspan.morph(a, b, 1e-7), a) < FLAT)
      assert.is_true(difference(celspan.morph(a, b, 1 - 1e-7), b) < FLAT)
    end
  end)

  -- table.sort takes long lists apart by the clock, so what is alike would change its place.
  it("sorts the places at which outlines are cut without leaving two alike", function()
    local sort, orders = table.sort, {}
    rawset(table, "sort", function(list, before)
      orders[#orders + 1] = before
      sort(list, before)
    end)
    local lines = native.anatomy(line).contours
    outlines.match(lines, lines, { places = {} })
    rawset(table, "sort", sort)
    local before = orders[#orders]
    for _, pair in ipairs { { { 0.25, 0.5 }, { 0.5, 0.25 } }, { { 1, 1 }, { 1, 1 + 2 ^ -52 } } } do
      assert.is_true(before(pair[1], pair[2]))
      assert.is_false(before(pair[2], pair[1]))
    end
  end)

  it("keeps what both have in common", function()
    local moved = celspan.path { d = star(5, 34, 30, 24), texture = "#e03131" }
    local between = celspan.morph(five, moved, 0.5)
    assert.is_true(difference(between, five:translate(2, -2)) < 1e-4)
    local larger = celspan.rect { 10, 10, 20, 40, texture = "#1971c2" }
    assert.is_true(difference(celspan.morph(square, larger, 0.5),
      celspan.rect { 10, 10, 30, 40, texture = "#1971c2" }) < 1e-4)
    local thin, thick = line:with { width = 2 }, line:with { width = 6 }
    assert.is_true(difference(celspan.morph(thin, thick, 0.25), line:with { width = 3 }) < 1e-3)
  end)

  it("mixes paints as light", function()
    local r, _, b, a = pixels(celspan.morph(square, square:with { texture = "#e03131" }, 0.5))
      :get(30, 30)
    local mixed = celspan.mix(celspan.rgb "#1971c2", celspan.rgb "#e03131", 0.5)
    local wanted = { pixels(square:with { texture = mixed }):get(30, 30) }
    assert.near(wanted[1], r, 1e-6)
    assert.near(wanted[3], b, 1e-6)
    assert.near(1, a, 1e-6)
  end)

  it("opens a hole in its outline, wherever that is", function()
    local far = ring:translate(200, 0)
    local between = celspan.morph(disc, far, 0.25):translate(-50, 0)
    local _, _, _, middle = pixels(between):get(32, 32)
    local _, _, _, side = pixels(between):get(32, 18)
    assert.equal(0, middle)
    assert.equal(1, side)
  end)

  it("matches parts by their names, and the others in order", function()
    local function two(first, second, x)
      return celspan.union { celspan.rect { x, 10, 10, 10, texture = "#ff0000" }:named(first),
                             celspan.rect { x, 40, 10, 10, texture = "#0000ff" }:named(second) }
    end
    local same = celspan.morph(two("a", "b", 10), two("a", "b", 30), 0.5)
    assert.is_true(difference(same, two("a", "b", 20)) < 1e-4)
    local crossed = celspan.morph(two("a", "b", 10), two("b", "a", 30), 0.5)
    local _, _, _, alpha = pixels(crossed):get(25, 30) -- both are on their way here
    assert.is_true(alpha > 0.9)
    local given = celspan.morph(two("a", "b", 10), two("c", "d", 30), 0.5,
      { pairs = { { "a", "d" }, { "b", "c" } } })
    assert.is_true(difference(given, crossed) < 1e-4)
  end)

  it("goes where pairs of places say", function()
    local quarter = { { { 10, 10 }, { 50, 10 } }, { { 50, 10 }, { 50, 50 } },
                      { { 50, 50 }, { 10, 50 } }, { { 10, 50 }, { 10, 10 } } }
    local turned = celspan.morph(square, square, 0.5, { pairs = quarter })
    local x, _, width = turned:bounds() -- a quarter turn by straight ways: half as large an area
    assert.near(10, x, 1e-6)
    assert.near(40, width, 1e-6)
    assert.is_true(difference(turned, celspan.polygon { { 30, 10 }, { 50, 30 }, { 30, 50 },
      { 10, 30 } }:with { texture = "#1971c2" }) < 1e-3)
  end)

  it("grows from nothing, and stays in bounds on the way", function()
    assert.is_true(difference(celspan.morph(celspan.union {}, disc, 1e-6), celspan.union {}) < 1e-3)
    for _, u in ipairs { 0.2, 0.5, 0.8 } do
      local x, y, w, h = celspan.morph(square, five, u):bounds()
      assert.is_true(x > 4 and y > 8 and x + w < 56 and y + h < 60)
    end
  end)

  it("takes outlines of ten thousand points", function()
    local points = {}
    for i = 1, 10000 do
      local angle, radius = 2 * math.pi * i / 10000, 20 + i % 2
      points[i] = { 32 + radius * math.cos(angle), 32 + radius * math.sin(angle) }
    end
    local rough = celspan.polygon(points):with { texture = "#00796b" }
    local x, _, w = celspan.morph(rough, square, 0.5):bounds()
    assert.is_true(x > 9 and x + w < 55)
  end)

  it("refuses what is no object, no share and no pair", function()
    raised.each {
      ["morph: argument 1 must be an object, got nil"] = function()
        celspan.morph(nil, disc, 0.5)
      end,
      ["morph: argument 2 must be an object, got number"] = function()
        celspan.morph(disc, 7, 0.5)
      end,
      ["morph: takes a share from 0 to 1 as its third argument, got nan"] = function()
        celspan.morph(disc, square, 0 / 0)
      end,
      ["morph: unknown field 'pair'; did you mean 'pairs'?"] = function()
        celspan.morph(disc, square, 0.5, { pair = {} })
      end,
      ["morph: pair 1 must be two places"] = function()
        celspan.morph(disc, square, 0.5, { pairs = { { 1, 2 } } })
      end,
      ["morph: there is no part \"fin\""] = function()
        celspan.morph(disc, square, 0.5, { pairs = { { "fin", "wing" } } })
      end,
      ["morph: the pairs cross"] = function()
        celspan.morph(square, disc, 0.5, { pairs = { { { 10, 10 }, { 52, 32 } },
          { { 50, 10 }, { 32, 12 } }, { { 50, 50 }, { 32, 52 } } } })
      end,
    }
  end)
end)
