-- Blurred objects, shadows, glows and outlines, against formulas and against the same made by
-- hand.
local celspan = require "celspan"
local images = require "tests.support.images"
local raised = require("tests.support.raised").message
local workbench = require "tests.support.workbench"

local pixels, assert_alike = images.of, images.alike

local function rect(x, y, w, h, texture) return celspan.rect { x, y, w, h, texture = texture } end

--- The share of a Gaussian that lies below x, by Simpson's rule.
local function below(x)
  local steps, low = 200, -6
  if x <= low then return 0 end
  local h, sum = (x - low) / steps, 0
  for i = 0, steps do
    local weight = (i == 0 or i == steps) and 1 or i % 2 == 1 and 4 or 2
    sum = sum + weight * math.exp(-(low + i * h) ^ 2 / 2)
  end
  return sum * h / 3 / math.sqrt(2 * math.pi)
end

describe("a blurred object", function()
  it("is the convolution of its picture with a Gaussian of half the radius", function()
    local image, sigma = pixels({ rect(20, 18, 24, 20, "#fff"):blur(8) }, 64, 56), 4
    for y = 0, 55 do
      local v = below((38 - y - 0.5) / sigma) - below((18 - y - 0.5) / sigma)
      for x = 0, 63 do
        local u = below((44 - x - 0.5) / sigma) - below((20 - x - 0.5) / sigma)
        local _, _, _, a = image:get(x, y)
        assert.is_true(math.abs(a - u * v) < 3e-3,
          ("pixel %d, %d: %.5f instead of %.5f"):format(x, y, a, u * v))
      end
    end
  end)

  it("is blurred in its own units, and follows its transforms", function()
    local shape = rect(10, 12, 20, 14, "#38a"):blur(3)
    assert_alike(2e-3, pixels({ shape:scale(2) }, 80, 80),
      pixels({ rect(20, 24, 40, 28, "#38a"):blur(6) }, 80, 80))
    assert_alike(1e-3, pixels({ shape:rotate(90, 20, 20) }, 40, 40),
      pixels({ rect(10, 12, 20, 14, "#38a"):rotate(90, 20, 20):blur(3) }, 40, 40))
  end)

  it("has the same bits in a crop and on several workers", function()
    local random, list = celspan.random(7), {}
    for i = 1, 12 do
      list[i] = celspan.circle { centre = { random("x" .. i) * 96, random("y" .. i) * 64 },
        radius = 4 + 12 * random("r" .. i), texture = i % 2 == 0 and "#e24a33a0" or "#348abd" }
        :blur(1 + 9 * random("b" .. i))
    end
    local whole = pixels(list, 96, 64)
    assert_alike(0, whole, pixels(list, 96, 64, { workers = 3 }))
    local part = pixels(list, 96, 64, { crop = { 20, 10, 50, 40 } })
    for y = 0, 39 do
      for x = 0, 49 do
        local p, q = { part:get(x, y) }, { whole:get(x + 20, y + 10) }
        for c = 1, 4 do assert.is_true(math.abs(p[c] - q[c]) <= 1 / 65535) end
      end
    end
  end)

  it("with the kernel pixel is the mean over each pixel in the space around it", function()
    local random, list = celspan.random(11), {}
    for i = 1, 8 do
      local across = celspan.linear { from = { 0, 0 }, to = { 96, 64 }, { 0, "#fff" }, { 1,
        "#e4572e40" } }
      list[i] = celspan.ellipse { centre = { random("x" .. i) * 96, random("y" .. i) * 64 },
        radii = { 20, 9 }, texture = i % 2 == 0 and "#203040a0" or across }:rotate(40 * i, 48, 32)
    end
    list.space = "srgb"
    local art = celspan.clip(celspan.group(list), rect(0, 0, 96, 64))
    local alone = celspan.group { art:blur(2, { kernel = "pixel" }), space = "srgb" }
    local function bytes(object, space)
      local rostrum = celspan.rostrum { celspan.cel { object }, space = space }
      return assert(celspan.pixels(rostrum, { size = { 96, 64 }, film = { 96, 64 } }))
        :bytes { depth = 8, colour = "srgb", alpha = "premultiplied" }
    end
    local wanted, got, plain = bytes(art, "srgb"), bytes(alone), bytes(art)
    local differs = 0
    for i = 1, #wanted do
      assert.is_true(math.abs(wanted:byte(i) - got:byte(i)) <= 2, ("byte %d"):format(i))
      if math.abs(wanted:byte(i) - plain:byte(i)) > 6 then differs = differs + 1 end
    end
    assert.is_true(differs > 20, differs .. " bytes")
  end)

  --- Stripes. wider: what lies on the sides continues.
  local function stripes(wider)
    local list, more = {}, wider and 60 or 0
    for i = 0, 7 do
      local left = i == 0 and -more or 8 * i
      list[i + 1] = rect(left, -more, 8 * i + 8 - left + (i == 7 and more or 0), 48 + 2 * more,
        i % 3 == 0 and "#e4572e" or i % 3 == 1 and "#2a7f83" or "#f6ead2")
    end
    return celspan.group(list)
  end

  for _, kernel in ipairs { "gaussian", "box", "disc" } do
    it("continues beyond its bounds as it is there, with a kernel of " .. kernel, function()
      local wanted = pixels({ stripes(true):blur(9, { kernel = kernel }) }, 64, 48)
      assert_alike(1e-3, wanted,
        pixels({ stripes():blur(9, { kernel = kernel, edge = "extend" }) }, 64, 48))
      local x, y, w, h = stripes():blur(9, { edge = "extend" }):bounds()
      assert.same({ 0, 0, 64, 48 }, { x, y, w, h })
    end)
  end

  it("continues beyond the frame, wherever the cel and the camera are", function()
    local function film(art, edge, fields)
      local rostrum = { camera = fields.camera, celspan.cel { art, viewport = fields.viewport,
        defocus = { radius = fields.radius or 7, edge = edge } } }
      return assert(celspan.pixels(celspan.rostrum(rostrum), { size = { 64, 48 },
        film = { 64, 48 }, crop = fields.crop }))
    end
    local disc = celspan.circle { centre = { 32, 24 }, radius = 500, texture = "#3388aa" }
    for _, fields in ipairs { {}, { camera = { centre = { 30, 20 }, width = 40 } },
      { camera = { centre = { 30, 20 }, width = 50, rotate = 20 } },
      { viewport = { -8, -4, 80, 60 } }, { radius = 30 } } do
      local _, _, _, corner = film(rect(-200, -200, 500, 500, "#fff"), "extend", fields):get(0, 0)
      assert.is_true(corner > 1 - 1e-3)
      assert_alike(2e-3, film(disc, "clear", fields), film(disc, "extend", fields))
    end
    local art = stripes()
    assert_alike(1e-3, film(stripes(true), "clear", {}), film(art, "extend", {}))
    local whole, part = film(art, "extend", {}), film(art, "extend", { crop = { 5, 7, 20, 11 } })
    for y = 0, 10 do
      for x = 0, 19 do
        assert.same({ whole:get(x + 5, y + 7) }, { part:get(x, y) })
      end
    end
  end)

  it("continues however wide the blur is", function()
    local art = rect(0, 0, 16, 16, "#fff")
    for _, radius in ipairs { 1e5, 1e6 } do
      local film = celspan.rostrum { celspan.cel { art,
        defocus = { radius = radius, edge = "extend" } } }
      local shown = assert(celspan.pixels(film, { size = { 16, 16 }, film = { 16, 16 } }))
      assert.is_true(select(4, shown:get(8, 8)) > 1 - 1e-3)
      assert.is_true(
        select(4, pixels({ art:blur(radius, { edge = "extend" }) }, 16, 16):get(8, 8)) > 1 - 1e-3)
    end
  end)

  it("keeps its mode outermost, and its name", function()
    local ground = rect(0, 0, 40, 40, "#c80")
    local shape = celspan.circle { centre = { 20, 20 }, radius = 9, texture = "#88f" }:named "sun"
    local first, last = shape:blend("multiply"):blur(4), shape:blur(4):blend("multiply")
    assert.equal("multiply", first.mode)
    assert.equal("sun", first.name)
    assert_alike(0, pixels({ ground, first }, 40, 40), pixels({ ground, last }, 40, 40))
  end)

  it("has fields, and can be changed", function()
    local shape = rect(0, 0, 10, 10, "#fff"):blur(4, { kernel = "disc" })
    assert.same({ 4, "disc" }, { shape.radius, shape.kernel })
    assert_alike(0, pixels({ shape:with { radius = 2 } }, 20, 20),
      pixels({ rect(0, 0, 10, 10, "#fff"):blur(2, { kernel = "disc" }) }, 20, 20))
  end)

  it("is drawn sharp with a radius of 0, and empty where there is nothing", function()
    local disc = celspan.circle { centre = { 10, 10 }, radius = 7, texture = "#fff" }
    assert_alike(1e-6, pixels({ disc }, 20, 20), pixels({ disc:blur(0) }, 20, 20))
    assert_alike(0, pixels({}, 20, 20), pixels({ celspan.union {}:blur(5) }, 20, 20))
  end)

  it("is not seen by the oracle", function()
    local rostrum = celspan.rostrum { celspan.cel { rect(5, 5, 10, 10, "#fff"):blur(6) } }
    assert.same({ 1, 1, 1, 1 }, { celspan.probe(rostrum, 5.5, 5.5, { film = { 20, 20 } }) })
    assert.same({ 0, 0, 0, 0 }, { celspan.probe(rostrum, 4.5, 4.5, { film = { 20, 20 } }) })
  end)
end)

describe("a shadow", function()
  local disc = celspan.circle { centre = { 30, 28 }, radius = 14, texture = "#e24a33" }

  it("is the object's shape in a colour on a defocused cel behind it", function()
    local by_hand = celspan.rostrum {
      celspan.cel { disc:paint("#204080"):translate(5, 6), opacity = 0.6, defocus = 7 },
      celspan.cel { disc } }
    local shadowed = disc:shadow { offset = { 5, 6 }, blur = 7, colour = "#204080", opacity = 0.6 }
    assert_alike(2e-3, pixels({ shadowed }, 64, 64),
      assert(celspan.pixels(by_hand, { size = { 64, 64 }, film = { 64, 64 } })))
  end)

  it("is as soft as the object is", function()
    local soft = rect(10, 10, 30, 30, celspan.linear { from = { 10, 0 }, to = { 40, 0 },
      { 0, "#fff0" }, { 1, "#fff" } })
    local image = pixels({ soft:shadow { colour = "#f00", only = true } }, 50, 50)
    for x = 10, 39 do
      local r, g, _, a = image:get(x, 25)
      assert.is_true(math.abs(a - (x - 9.5) / 30) < 2e-3)
      assert.is_true(math.abs(r - a) < 1e-6 and g == 0)
    end
  end)

  it("stays within the object with `inside`, and is alone with `only`", function()
    local inside = pixels({ disc:shadow { offset = { 3, 4 }, blur = 6, inside = true } }, 64, 64)
    local plain = pixels({ disc }, 64, 64)
    for y = 0, 63 do
      for x = 0, 63 do
        local _, _, _, a = inside:get(x, y)
        local _, _, _, b = plain:get(x, y)
        assert.is_true(math.abs(a - b) < 1e-6)
      end
    end
    local top, middle = inside:get(30, 15), inside:get(30, 30)
    assert.is_true(top < 0.7 * middle)
    local only = pixels({ disc:shadow { offset = { 40, 0 }, only = true } }, 64, 64)
    assert.same({ 0, 0, 0, 0 }, { only:get(18, 28) })
  end)

  it("of a cel is that of all its objects, and keeps its lights and its place", function()
    local other = rect(40, 20, 10, 10, "#348abd")
    local options = { offset = { 2, 3 }, blur = 4 }
    local cel = celspan.cel { disc, other, front = { 1, 0.5, 0.25 } }:translate(1, 2)
    local by_hand = celspan.cel { celspan.group { disc, other }:shadow(options),
      front = { 1, 0.5, 0.25 } }:translate(1, 2)
    local function shown(c)
      return assert(celspan.pixels(celspan.rostrum { c }, { size = { 64, 64 }, film = { 64, 64 } }))
    end
    assert_alike(0, shown(by_hand), shown(cel:shadow(options)))
  end)
end)

describe("a glow", function()
  it("is the object's shape, brighter and blurred, added behind it", function()
    local ground = rect(0, 0, 64, 64, "#402030")
    local bar = rect(20, 28, 24, 8, "#fff")
    local by_hand = rect(20, 28, 24, 8, "#f46"):blur(9)
    local image = pixels({ ground, bar:glow { radius = 9, colour = "#f46", gain = 3 } }, 64, 64)
    local light, back = pixels({ by_hand }, 64, 64), pixels({ ground }, 64, 64)
    for y = 0, 27 do
      for x = 0, 63 do
        local got, glow, behind = { image:get(x, y) }, { light:get(x, y) }, { back:get(x, y) }
        for c = 1, 3 do
          assert.is_true(math.abs(got[c] - behind[c] - 3 * glow[c]) < 2e-3)
        end
      end
    end
    assert.same({ 1, 1, 1, 1 }, { image:get(30, 31) })
  end)
end)

describe("an outline", function()
  local random = celspan.random(28)
  local disc = celspan.circle { centre = { 30, 30 }, radius = 14, texture = "#e24a33" }
  local bar = rect(34, 22, 28, 12, "#348abd")
  local alone = { width = 5, texture = "#fff", only = true }

  --- The least distance from a point to those points of a fine grid that a shape contains.
  local function distance(shape, x, y, reach)
    local least = math.huge
    for v = y - reach, y + reach, 0.5 do
      for u = x - reach, x + reach, 0.5 do
        local d = math.sqrt((u - x) ^ 2 + (v - y) ^ 2)
        if d < least and shape:contains(u, v) then least = d end
      end
    end
    return least
  end

  --- Asserts that probe shows the outline of a shape where, and only where, it is within the width.
  local function assert_within(shape, options, most)
    local grown = shape:outline(options)
    local rostrum, seen = celspan.rostrum { celspan.cel { grown } }, {}
    for i = 1, most do
      local x, y = 72 * random(i .. "x"), 60 * random(i .. "y")
      local d = distance(shape, x, y, options.width + 1)
      local _, _, _, a = celspan.probe(rostrum, x, y, { film = { 72, 60 } })
      if math.abs(d - options.width) > 0.6 then
        assert.equal(d < options.width and 1 or 0, a, ("at %g, %g: %g away"):format(x, y, d))
        seen[a] = true
      end
    end
    assert.same({ [0] = true, [1] = true }, seen)
  end

  it("reaches as far as its width from shapes of every kind, and no further", function()
    local hole = celspan.path { d = "M10 10 H50 V50 H10 Z M22 22 H38 V38 H22 Z", rule = "evenodd" }
    local line = celspan.stroke { points = { { 12, 40, 2 }, { 30, 12, 9 }, { 58, 40, 3 } },
      cap = "round", join = "round" }
    local both = celspan.group { disc, bar }
    for _, shape in ipairs { disc, bar, hole, line, disc | bar, disc ~ bar, both,
      (disc | bar):rotate(30, 30, 30):scale(1.2, 0.7), hole - rect(24, 0, 10, 16),
      rect(10, 14, 40, 30, celspan.pattern { art = disc, box = { 0, 0, 8, 8 } }),
      (disc ~ bar) | rect(10, 50, 40, 6) } do
      assert_within(shape, alone, 60)
    end
  end)

  it("has corners where the sides of an intersection or a difference meet", function()
    local function alpha(shape, x, y)
      local grown = shape:outline { width = 4, texture = "#fff", only = true }
      return select(4, celspan.probe(celspan.rostrum { celspan.cel { grown } }, x, y,
        { film = { 60, 60 } }))
    end
    local square = rect(10, 10, 30, 60) & rect(-10, 10, 90, 30)
    assert.same({ 1, 0, 0 },
      { alpha(square, 43.5, 42), alpha(square, 44.5, 20), alpha(square, 20, 44.5) })
    local notch = rect(10, 10, 40, 40) - rect(25, 0, 10, 30)
    assert.same({ 1, 0, 1, 1 }, { alpha(notch, 28.5, 20), alpha(notch, 30, 20),
      alpha(notch, 31.5, 20), alpha(notch, 30, 26.5) })
  end)

  it("is as wide in the object's units, and follows its transforms", function()
    local outlined = (disc | bar):outline { width = 3, texture = "#fd0" }
    local large = disc:scale(2) | bar:scale(2)
    assert_alike(1e-6, pixels({ outlined:scale(2) }, 140, 120),
      pixels({ large:outline { width = 6, texture = "#fd0" } }, 140, 120))
  end)

  it("around an outline is one of the shape, by both widths", function()
    local shape = (disc | bar):scale(0.5):translate(4, 4)
    for _, join in ipairs { "round", "miter", "bevel" } do
      local once = { width = 7, texture = "#fd0", join = join, only = true }
      local twice = shape:outline { width = 1.5, texture = "#00f", join = join }:scale(2)
        :outline { width = 4, texture = "#fd0", join = join, only = true }
      assert_alike(1e-6, pixels({ shape:scale(2):outline(once) }, 72, 60),
        pixels({ twice }, 72, 60))
    end
    assert_within(disc:outline { width = 2 }:blend "screen":outline { width = 2, join = "miter" },
      { width = 3, texture = "#fff" }, 40)
    assert_within(bar:outline { width = 2, join = "miter" }:rotate(9):scale(1, 0.8),
      { width = 3, texture = "#fff" }, 40)
  end)

  it("is behind the object, in a texture, faded, with the joins that are asked for", function()
    local square = rect(20, 20, 20, 20, "#f00")
    local by_hand = celspan.group { rect(16, 16, 28, 28, "#00f"):fade(0.5), square }
    assert_alike(1e-6, pixels({ by_hand }, 60, 60), pixels({ square:outline { width = 4,
      texture = "#00f", join = "miter", opacity = 0.5 } }, 60, 60))
    local round = rect(16, 16, 28, 28):with { radius = 4, texture = "#00f" }
    assert_alike(4e-3, pixels({ celspan.group { round, square } }, 60, 60),
      pixels({ square:outline { width = 4, texture = "#00f" } }, 60, 60))
  end)

  it("is soft with a blur", function()
    local only = disc:outline { width = 4, texture = "#0f0", blur = 5, only = true }
    local wide = celspan.circle { centre = { 30, 30 }, radius = 18, texture = "#0f0" }
    assert_alike(2e-3, pixels({ wide:blur(5) }, 60, 60), pixels({ only }, 60, 60))
  end)

  -- Of a square, what lies left of 30: by a matte and by a key.
  local half = celspan.linear { from = { 30, 0 }, to = { 30.01, 0 }, { 0, "#fff" }, { 1, "#fff0" } }
  local dark = celspan.linear { from = { 30, 0 }, to = { 30.01, 0 }, { 0, "#f00" }, { 1, "#000" } }
  local cuts = { celspan.matte(rect(10, 10, 40, 40, "#f00"), rect(10, 10, 40, 40, half)),
    celspan.key { rect(10, 10, 40, 40, dark), luma = true, from = 0.1, to = 0.2 } }

  it("spreads the alpha of pictures, compositions, mattes and keys", function()
    local image
    for _, cut in ipairs(cuts) do
      image = pixels({ cut:outline { width = 8, texture = "#00f" } }, 60, 60)
      local function blue(x) return (select(3, image:get(x, 30))) end
      assert.same({ 0, 0 }, { blue(1), blue(39) })
      for x = 31, 35 do assert.is_true(blue(x) > 0.999, "pixel " .. x) end
      assert.is_true(blue(37) > 0 and blue(37) < 1)
    end
    local nested = celspan.rostrum { size = { 20, 20 }, celspan.cel {
      celspan.circle { centre = { 10, 10 }, radius = 6, texture = "#fff" } } }
    image = pixels({ nested:translate(20, 20):outline { width = 4, texture = "#00f" } }, 60, 60)
    local _, _, _, side = image:get(30, 38)
    local _, _, _, corner = image:get(22, 22)
    assert.same({ 1, 0 }, { side, corner })
  end)

  it("that is spread is seen by probe where the object is, 32 times as strong", function()
    for _, cut in ipairs(cuts) do
      local faint = celspan.rostrum { celspan.cel { cut:fade(1 / 64):outline(alone) } }
      for x, alpha in pairs { [8] = 0, [20] = 0.5, [33] = 0 } do
        local _, _, _, a = celspan.probe(faint, x, 30, { film = { 60, 60 } })
        assert.is_true(math.abs(a - alpha) < 1e-9, ("at %g: %g"):format(x, a))
      end
    end
  end)

  it("of a cel is that of all its objects", function()
    local cel = celspan.cel { disc, bar, front = { 1, 0.5, 0.25 } }
    local by_hand = celspan.cel { celspan.group { disc, bar }:outline(alone),
      front = { 1, 0.5, 0.25 } }
    local function shown(c)
      return assert(celspan.pixels(celspan.rostrum { c }, { size = { 64, 64 }, film = { 64, 64 } }))
    end
    assert_alike(0, shown(by_hand), shown(cel:outline(alone)))
  end)

  it("of a width of 0 is the shape, and of nothing is nothing", function()
    assert_alike(1e-6, pixels({ disc:paint("#fff") }, 60, 60),
      pixels({ disc:outline { width = 0, texture = "#fff", only = true } }, 60, 60))
    assert_alike(0, pixels({}, 20, 20),
      pixels({ celspan.union {}:outline(alone), rect(3, 3, 0, 9):outline(alone) }, 20, 20))
  end)

  it("keeps a mode outermost, and nests xors in bounded time", function()
    assert.equal("multiply", disc:blend("multiply"):outline(alone).mode)
    local nested = disc
    for i = 1, 10 do nested = celspan.group { nested ~ rect(i, i, 40, 40) } end
    assert_within(nested, { width = 3, texture = "#fff", only = true }, 20)
  end)
end)

describe("effects of effects", function()
  local bench, script
  setup(function()
    bench = workbench.new()
    script = bench:write("nested.lua", [[
local celspan = require "celspan"
local kind, depth = ...
return celspan.film { size = { 16, 16 }, frame = function()
  local object = celspan.rect { 6, 12, 4, 3, texture = "#c33" }
  for i = 1, math.tointeger(tonumber(depth)) do
    object = kind == "outline" and object:outline { width = 0.5, texture = "#fff" }
      or kind == "glow" and object:glow { radius = 0.1, colour = "#f80" }
      or object:shadow { offset = { 0, 0.1 }, blur = 0.1 }
  end
  return celspan.rostrum { celspan.cel { object } }
end }
]])
  end)
  teardown(function() bench:remove() end)

  --- Allocations and the bytes that were taken at most.
  local function count(kind, depth)
    local code, out, err = bench:celspan("spans %s --rows 0-0 --stats -- %s %d", script, kind,
      depth)
    assert.are.equal(0, code, err)
    return tonumber(out:match "allocations (%d+)"), tonumber(out:match "peak_bytes (%d+)")
  end

  it("do not double with each level", function()
    for _, kind in ipairs { "outline", "glow", "shadow" } do
      local few, small = count(kind, 6)
      local many, large = count(kind, 12)
      assert.is_true(many < 6 * few, kind .. ": " .. few .. " and " .. many .. " allocations")
      assert.is_true(large < 6 * small, kind .. ": " .. small .. " and " .. large .. " bytes")
    end
  end)
end)

describe("a wrong effect", function()
  local disc = celspan.circle { centre = { 5, 5 }, radius = 3 }

  it("is refused with its field, what was given and what is allowed", function()
    assert.matches("effects_spec.lua:%d+: blur: .*radius.* 1e09.* 1000000",
      raised(function() return disc:blur(1e9) end))
    assert.matches("blur: .*radius.* nan", raised(function() return disc:blur(0 / 0) end))
    assert.matches("blur: .*radius.* %-1", raised(function() return disc:blur(-1) end))
    assert.matches("blur: .*radius.* a number", raised(function() return disc:blur("wide") end))
    assert.matches("blur: its options must be a table, got string",
      raised(function() return disc:blur(1, "disc") end))
    assert.matches("blur: .*kernel.*disk", raised(function()
      return disc:blur(1, { kernel = "disk" })
    end))
    assert.matches("shadow: unknown field 'colur'.*colour", raised(function()
      return disc:shadow { colur = "#fff" }
    end))
    assert.matches("shadow: .*blur.* 1e09", raised(function()
      return disc:shadow { blur = 1e9 }
    end))
    assert.matches("glow: .*colour", raised(function() return disc:glow { radius = 4 } end))
    assert.matches("glow: .*gain.* %-1", raised(function()
      return disc:glow { radius = 4, colour = "#fff", gain = -1 }
    end))
  end)

  it("is refused for an outline, too", function()
    assert.matches("outline: .*width", raised(function() return disc:outline {} end))
    assert.matches("outline: .*width.* 1e09.* 1000000",
      raised(function() return disc:outline { width = 1e9 } end))
    assert.matches("outline: .*join.*rond", raised(function()
      return disc:outline { width = 1, join = "rond" }
    end))
    local leaning = disc:transform { 1, 0, 0, 0, 1, 0, -0.2, 0, 1 }
    assert.matches("outline: the object reaches the horizon of its perspective; give it its",
      raised(function() return leaning:outline { width = 1 } end))
    local deep = disc
    for _ = 1, 60 do deep = celspan.group { deep ~ rect(0, 0, 9, 9) } end
    assert.matches("outline: .*16777216", raised(function() return deep:outline { width = 1 } end))
  end)

  it("is refused when it nests too deep, and drawn when it is very wide", function()
    local nested = disc
    local message = raised(function()
      for _ = 1, 200 do nested = nested:blur(0.01) end
    end)
    assert.matches("128", message)
    assert.is_true(select(4, pixels({ disc:blur(1e6) }, 8, 8):get(4, 4)) < 1e-6)
    assert.is_true(select(4, pixels({ nested }, 8, 8):get(4, 4)) > 0.99)
  end)
end)
