-- Patterns: against the same art copied by hand, against the oracle, and what they cost.
local celspan = require "celspan"
local images = require "tests.support.images"
local workbench = require "tests.support.workbench"

local pixels, assert_alike = images.of, images.alike

local function rect(x, y, w, h, texture) return celspan.rect { x, y, w, h, texture = texture } end

--- Art that reaches beyond the box { 2, 1, 10, 8 }.
local art = celspan.union { rect(0, 0, 20, 3, "#246"),
  celspan.circle { centre = { 8, 5 }, radius = 4, texture = "#e24a33c0" } }
local BOX = { 2, 1, 10, 8 }

--- The art in its box, copied to the boxes (from, from) .. (to, to).
local function copies(from, to)
  local list, tile = {}, celspan.clip(art, rect(2, 1, 10, 8))
  for row = from, to do
    for column = from, to do list[#list + 1] = tile:translate(10 * column, 8 * row) end
  end
  return celspan.union(list)
end

local function made_of(texture) return rect(0, 0, 60, 50, texture) end

describe("a pattern", function()
  it("is the art in its box, again and again", function()
    local pattern = celspan.pattern { art = art, box = BOX }
    -- faded, because as many opaque copies would be drawn from a map, which is rounded otherwise
    assert_alike(1e-6, pixels({ made_of(pattern):fade(0.5) }, 60, 50),
      pixels({ celspan.clip(copies(-1, 6), made_of "#000"):fade(0.5) }, 60, 50))
  end)

  it("is moved by its matrix, and with what it is on", function()
    local turn = { 0.8, -0.6, 3, 0.6, 0.8, -4, 0, 0, 1 }
    local pattern = celspan.pattern { art = art, box = BOX, matrix = turn }
    assert_alike(1e-6, pixels({ made_of(pattern):rotate(7):translate(9, 2) }, 60, 50),
      pixels({ celspan.clip(copies(-7, 12):transform(turn), made_of "#000"):rotate(7)
        :translate(9, 2) }, 60, 50))
  end)

  it("fills every primitive, and lines", function()
    local pattern = celspan.pattern { art = art, box = BOX }
    local disc = celspan.circle { centre = { 30, 25 }, radius = 20, texture = pattern }
    local line = disc:stroke { width = 5, texture = pattern }
    local plain = celspan.circle { centre = { 30, 25 }, radius = 20 }
    assert_alike(1e-6, pixels({ disc:fade(0.5), line }, 60, 50),
      pixels({ celspan.clip(copies(-1, 6), plain):fade(0.5),
        celspan.clip(copies(-1, 6), plain:stroke { width = 5 }) }, 60, 50))
    assert.are.equal(pattern, disc.texture)
  end)

  it("is what the oracle sees", function()
    local pattern = celspan.pattern { art = art, box = BOX,
      matrix = { 1, 0.5, 0, -0.5, 1, 0, 0, 0, 1 } }
    local rostrum = celspan.rostrum { celspan.cel { made_of(pattern) } }
    local image = assert(celspan.pixels(rostrum, { size = { 600, 500 }, film = { 60, 50 },
      antialias = "none" }))
    local random, different = celspan.random(3), 0
    for i = 1, 300 do
      local x, y = math.floor(600 * random("x" .. i)), math.floor(500 * random("y" .. i))
      local red, _, _, alpha = celspan.probe(rostrum, (x + 0.5) / 10, (y + 0.5) / 10,
        { film = { 60, 50 } })
      local r, _, _, a = image:get(x, y)
      if math.abs(red - r) + math.abs(alpha - a) > 1e-4 then different = different + 1 end
    end
    assert.are.equal(0, different)
  end)

  it("is repeated as far as operators let its shape grow", function()
    local magenta = celspan.rgb(1, 0, 1)
    local pattern = celspan.pattern { art = rect(0, 0, 1, 1, magenta), box = { 0, 0, 1, 1 } }
    for name, change in pairs {
      offset = function(shape) return celspan.offset(shape, 12) end,
      ["offset, placed"] = function(shape)
        return celspan.offset(shape:scale(2):rotate(30):translate(-5, -40), 8)
      end,
      twist = function(shape) return celspan.twist(shape:scale(2, 0.5), 95) end,
      zigzag = function(shape) return celspan.zigzag(shape, { size = 9, ridges = 2 }) end,
    } do
      local function drawn(texture)
        return pixels({ change(rect(25, 20, 10, 9, texture)) }, 60, 50)
      end
      local good, message = pcall(assert_alike, 1e-6, drawn(magenta), drawn(pattern))
      assert.is_true(good, name .. ": " .. tostring(message))
    end
  end)

  it("of boxes smaller than pixels is the mean of the art", function()
    local half = celspan.union { rect(0, 0, 0.01, 0.02, "#fff") }
    local pattern = celspan.pattern { art = half, box = { 0, 0, 0.02, 0.02 } }
    local image = pixels({ rect(10, 10, 40, 30, pattern) }, 60, 50)
    for _, at in ipairs { { 11, 11 }, { 30, 25 }, { 49, 39 } } do
      local r, _, _, a = image:get(at[1], at[2])
      assert.is_true(math.abs(r - 0.5) < 2e-3 and math.abs(a - 0.5) < 2e-3, r .. " " .. a)
    end
    assert.are.equal(0, (select(4, image:get(5, 5))))
  end)

  it("of many boxes is that of few, drawn smaller", function()
    local pattern = celspan.pattern { art = art:scale(0.2), box = { 0.4, 0.2, 2, 1.6 } }
    local few = pixels({ made_of(pattern) }, 60, 50)
    local many = pixels({ rect(0, 0, 60 * 8, 50 * 8, pattern) }, 480, 400)
    for y = 2, 47, 5 do
      for x = 2, 57, 5 do
        local a, b = { few:get(x, y) }, { many:get(x, y) }
        for c = 1, 4 do
          assert.is_true(math.abs(a[c] - b[c]) < 0.03,
            ("%d %d: %.3f %.3f"):format(x, y, a[c], b[c]))
        end
      end
    end
  end)

  it("costs what is seen of it, however far it goes, and how small it is", function()
    local function shown(side, box)
      local pattern = celspan.pattern { art = art:scale(box / 10), box = { 0, 0, box, box } }
      return pixels({ rect(0, 0, side, side, pattern) }, 60, 50)
    end
    assert_alike(0, shown(60, 10), shown(1e9, 10))
    assert_alike(1e-6, shown(60, 1e-7), shown(1e9, 1e-7))
  end)

  it("has colours that light passes through, however small it is", function()
    local gel = celspan.pattern { art = rect(0, 0, 1, 1, celspan.gel(1, 0.25, 0)),
      box = { 0, 0, 0.3, 0.3 } }
    local image = pixels({ rect(0, 0, 60, 50, "#fff"), rect(0, 0, 60, 50, gel) }, 60, 50)
    local r, g, b = image:get(30, 20)
    assert.is_true(math.abs(r - 1) < 1e-3 and math.abs(g - 0.25) < 1e-3 and math.abs(b) < 1e-3,
      ("%.4f %.4f %.4f"):format(r, g, b))
  end)

  it("can be in a pattern, up to 128 levels deep", function()
    local function nest(levels)
      local object = rect(0, 0, 60, 50, "#fff")
      for _ = 2, levels do
        object = rect(0, 0, 60, 50, celspan.pattern { art = object, box = { 0, 0, 30, 25 } })
      end
      return object
    end
    local r, _, _, a = pixels({ nest(16) }, 60, 50):get(31, 26)
    assert.is_true(math.abs(r - 1) < 1e-3 and math.abs(a - 1) < 1e-3)
    assert.is_truthy(nest(128))
    local ok, message = pcall(nest, 130)
    assert.is_false(ok)
    assert.matches("pattern: nested 129 levels deep; the limit is 128", message, 1, true)
  end)

  it("has the same bits on several workers and in a crop", function()
    local small = celspan.pattern { art = art:scale(0.05), box = { 0.1, 0.05, 0.5, 0.4 } }
    local list = { made_of(small), celspan.circle { centre = { 30, 25 }, radius = 12,
      texture = celspan.pattern { art = art, box = BOX } } }
    local whole = pixels(list, 60, 50)
    assert_alike(0, whole, pixels(list, 60, 50, { workers = 3 }))
    local part = pixels(list, 60, 50, { crop = { 20, 10, 30, 20 } })
    for y = 0, 19 do
      for x = 0, 29 do
        local p, q = { part:get(x, y) }, { whole:get(x + 20, y + 10) }
        for c = 1, 4 do assert.is_true(math.abs(p[c] - q[c]) <= 1 / 65535) end
      end
    end
  end)

  it("is refused without a box, with a wrong matrix, and as a light", function()
    for _, case in ipairs {
      { { art = art, box = { 0, 0, 0, 5 } },
        "box is 0 x 5; its width and height must be greater than 0" },
      { { art = art, box = BOX, matrix = { 1, 0, 0, 0, 0, 0, 0, 0, 1 } }, "must not be singular" },
      { { art = art, box = BOX, matrix = { 1, 0, 0, 0, 1, 0, 0.1, 0, 1 } }, "perspective" },
      { { art = "red", box = BOX }, "field 'art' must be an object, got string" },
    } do
      local ok, message = pcall(celspan.pattern, case[1])
      assert.is_false(ok)
      assert.matches(case[2], message, 1, true)
    end
    local light = { texture = celspan.pattern { art = art, box = BOX } }
    local ok, message = pcall(celspan.cel, { art, front = light })
    assert.is_false(ok)
    assert.matches("is a pattern, which is no light", message, 1, true)
  end)
end)

describe("an SVG pattern", function()
  local svg = require "celspan.svg"

  local HEAD = '<svg xmlns="http://www.w3.org/2000/svg" width="60" height="50">'
  local bench, count = workbench.new(), 0

  local function read(text)
    count = count + 1
    return svg.read(bench:write(("pattern-%d.svg"):format(count), HEAD .. text .. "</svg>"))
  end
  local function drawn(text) return assert(read(text)) end

  it("is painted in its units, with its transform and its templates", function()
    local cell = '<rect width="6" height="5" fill="red"/><rect x="6" y="5" width="6" height="5"/>'
    local one = drawn('<pattern id="t" width="12" height="10" patternUnits="userSpaceOnUse">'
      .. cell .. '</pattern><pattern id="p" href="#t" patternTransform="translate(3 1)"/>'
      .. '<rect width="60" height="50" fill="url(#p)"/>')
    local same = celspan.pattern { box = { 0, 0, 12, 10 },
      art = celspan.union { rect(0, 0, 6, 5, "#f00"), rect(6, 5, 6, 5, "#000") },
      matrix = { 1, 0, 3, 0, 1, 1, 0, 0, 1 } }
    assert_alike(1e-6, pixels({ one.object }, 60, 50),
      pixels({ rect(0, 0, 60, 50, same) }, 60, 50))
    assert.are.same({}, one.skipped)
    local shares = drawn('<pattern id="p" width=".2" height=".2" x=".05" y=".02" '
      .. 'viewBox="0 0 12 10">' .. cell
      .. '</pattern><rect width="60" height="50" fill="url(#p)"/>')
    assert_alike(1e-6, pixels({ shares.object }, 60, 50), pixels({ one.object }, 60, 50))
  end)

  it("is refused with its line when it is nested too deep", function()
    local list = {}
    for i = 1, 140 do
      list[i] = ('<pattern id="p%d" width=".5" height=".5"><rect width="9" height="9" '
        .. 'fill="url(#p%d)"/></pattern>'):format(i, i + 1)
    end
    local art_of, message = read(table.concat(list)
      .. '<rect width="9" height="9" fill="url(#p1)"/>')
    assert.is_nil(art_of)
    assert.matches("nested more than 128 deep", message, 1, true)
  end)
end)
