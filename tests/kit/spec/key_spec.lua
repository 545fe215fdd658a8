-- Keys and mattes: screens that are made here, whose matte is known; shapes that grow, against the
-- same made by hand. The formulas are tested by unit/key, random scenes by property/oracle.
local celspan = require "celspan"
local images = require "tests.support.images"
local raised = require("tests.support.raised").message
local workbench = require "tests.support.workbench"

local W, H = 160, 120

local function rect(x, y, w, h, texture) return celspan.rect { x, y, w, h, texture = texture } end
local function encode(x) return x <= 0.0031308 and 12.92 * x or 1.055 * x ^ (1 / 2.4) - 0.055 end

--- The image of an object in a film of its own, and the film.
local function seen(object, w, h, space)
  local film = celspan.film { size = { w or 1, h or 1 }, space = space, frame = function()
    return celspan.rostrum { celspan.cel { object } }
  end }
  return assert(celspan.pixels(film)), film
end

-- ---------------------------------------------------------------- green screens

local SCREEN = "#2fb457"
local uneven = celspan.radial { centre = { 50, 40 }, radius = 150, { 0, "#36c862" },
  { 1, "#289a4a" } }

local function body()
  return celspan.union {
    celspan.path { d = "M52 120 C48 60 112 60 108 120 Z", texture = "#a03c3c" },
    celspan.circle { centre = { 80, 48 }, radius = 24, texture = "#b4503c" } }
end

--- Fine strokes, thinner than a pixel at their tips.
local function hair()
  local random, list = celspan.random(3), {}
  for i = 1, 60 do
    local angle = -2.8 + 2.5 * random("a" .. i)
    local x, y = 80 + 22 * math.cos(angle), 48 + 22 * math.sin(angle)
    local long = 10 + 16 * random("l" .. i)
    list[i] = celspan.stroke { points = { { x, y }, { x + long * math.cos(angle + 0.3),
      y + long * math.sin(angle + 0.3) } }, width = 1.2, taper = { 0, long }, texture = "#a03c3c" }
  end
  return celspan.union(list)
end

--- The mean of the object in 12 places on its way, which is in the space of the group around it.
local function moving(object)
  local places = {}
  for i = 1, 12 do places[i] = object:translate(2 * i - 13, 0):fade(1 / i) end
  return celspan.group(places)
end

local takes, bench = 0, nil

--- The codes of green beyond the other channels, and the alpha.
local function green(image, x, y)
  local r, g, b, a = image:get(x, y)
  return a > 0 and math.max(0, encode(g / a) - encode(math.max(r, b) / a)) or 0, a
end

--- The picture of a figure before a screen, as a file of 8 bits; all are different files, because a
--- file is read once.
local function take_of(figure, screen, space)
  takes = takes + 1
  local name = ("%s/take%d.png"):format(bench.folder, takes)
  local take = celspan.group { rect(-20, -20, W + 40, H + 40, screen), figure }
  assert(seen(take, W, H, space):write(name))
  return celspan.image { file = name }
end

--- The mean difference of a key's matte from the known one, over pixels that are neither clear nor
--- whole; and the mean of their green beyond the other channels, before and after.
local function measure(figure, screen, space, key)
  local known, take = seen(figure, W, H, space), take_of(figure, screen, space)
  key[1] = take
  local made, plain = seen(celspan.key(key), W, H), seen(take, W, H)
  local found, weight = { difference = 0, count = 0, before = 0, after = 0 }, 0
  for i = 0, W * H - 1 do
    local x, y = i % W, i // W
    local _, _, _, alpha = known:get(x, y)
    if alpha > 1 / 255 and alpha < 254 / 255 then
      local left, stays = green(made, x, y)
      found.count = found.count + 1
      found.difference = found.difference + math.abs(stays - alpha)
      found.after = found.after + stays * left
      found.before = found.before + stays * green(plain, x, y)
      weight = weight + stays
    end
  end
  found.difference = found.difference / found.count
  found.before, found.after = found.before / weight, found.after / weight
  return found
end

setup(function() bench = workbench.new() end)
teardown(function() bench:remove() end)

--- The difference that the matte may have; and, in light, the tolerance and the softness.
local screens = {
  { "that is flat", function() return body():blur(2) end, SCREEN, 0.02, 0.02, 0.42 },
  { "that is lit unevenly", function() return body():blur(2) end, uneven, 0.03, 0.04, 0.39 },
  { "behind hair that moves", function() return moving(body() | hair()) end, uneven, 0.05, 0.04,
    0.39 },
}

describe("a key of a screen", function()
  for _, screen in ipairs(screens) do
    it(screen[1] .. " has nearly the known matte, and hardly any spill", function()
      for _, space in ipairs { "srgb", "linear" } do
        local is_linear = space == "linear"
        local found = measure(screen[2](), screen[3], space, { colour = SCREEN,
          tolerance = is_linear and screen[5] or 0, softness = is_linear and screen[6] or 0.44 })
        local said = ("%s: %.4f of %d pixels; spill %.4f instead of %.4f"):format(space,
          found.difference, found.count, found.after, found.before)
        assert.is_true(found.count > 1000 and found.difference <= screen[4], said)
        assert.is_true(found.before > 0.02 and found.after <= found.before / 3, said)
      end
    end)
  end

  it("is one colour where the art is one, whatever its alpha", function()
    local art = rect(0, 0, 1, 1, celspan.rgb("#a08070", 0.5))
    local shown = seen(celspan.key { art, tolerance = 0, softness = 1, spill = 0 })
    local whole = seen(celspan.key { rect(0, 0, 1, 1, "#a08070"), tolerance = 0, softness = 1,
      spill = 0 })
    local r, g, b, a = whole:get(0, 0)
    images.near({ r / 2, g / 2, b / 2, a / 2 }, shown, 0, 0)
    assert.is_true(a > 0.1 and a < 0.9)
  end)

  it("shows what lies behind it, also behind an opaque picture", function()
    local ground = rect(0, 0, 2, 1, "#f00")
    local take = celspan.union { rect(0, 0, 1, 1, "#0b0"), rect(1, 0, 1, 1, "#fff") }
    local shown = seen(celspan.group { ground, celspan.key { take } }, 2, 1)
    images.near({ 1, 0, 0, 1 }, shown, 0, 0)
    images.near({ 1, 1, 1, 1 }, shown, 1, 0)
  end)

  it("is seen by probe, in gradients, inside fades, modes and spaces", function()
    local ramp = celspan.linear { from = { 0, 0 }, to = { 64, 0 }, { 0, "#0b0" }, { 0.5, "#a97" },
      { 1, "#f00" } }
    local key = celspan.key { rect(0, 0, 64, 1, ramp):fade(0.7), softness = 0.4 }
    for _, object in ipairs { key, key:fade(0.5), key:blend "multiply", celspan.key { key },
        celspan.group { rect(0, 0, 64, 1, "#88f"), key, space = "srgb" },
        celspan.key { rect(0, 0, 64, 1, ramp), luma = true, from = 0.7, to = 0.2 } } do
      local shown, film = seen(celspan.group { rect(0, 0, 64, 1, "#224"), object }, 64, 1)
      for x = 0, 63 do
        images.near({ celspan.probe(film, x + 0.5, 0.5) }, shown, x, 0, 1.5 / 1023)
      end
    end
  end)

  it("by luma is a ramp of codes, in either direction", function()
    for code, expected in pairs { ["#404040"] = 0, ["#808080"] = 0.5, ["#c0c0c0"] = 1 } do
      local art = rect(0, 0, 1, 1, code)
      local low, high = 64 / 255, 192 / 255
      local _, _, _, up = seen(celspan.key { art, luma = true, from = low, to = high }):get(0, 0)
      local _, _, _, down = seen(celspan.key { art, luma = true, from = high, to = low }):get(0, 0)
      assert.is_true(math.abs(up - expected) < 1e-5 and math.abs(down - 1 + expected) < 1e-5)
    end
  end)

  it("refuses what cannot be a key, and says what to write", function()
    local art = rect(0, 0, 1, 1, "#0b0")
    local function message(fields)
      fields[1] = art
      return raised(celspan.key, fields)
    end
    assert.matches("colour is grey.*luma = true", message { colour = "#888" })
    assert.matches("colour must be one opaque colour", message { colour = celspan.clear })
    assert.matches("'tolerance' goes with 'colour'", message { luma = true, tolerance = 0.1 })
    assert.matches("give 'colour' or 'luma', not both", message { luma = true, colour = "#0f0" })
    assert.matches("'from' goes with 'luma'", message { from = 0.1 })
    assert.matches("spill is 2; it must be between 0 and 1", message { spill = 2 })
    assert.matches("tolerance is %-1; it must be 0 or more", message { tolerance = -1 })
    assert.matches("must be a finite number, got nan", message { softness = 0 / 0 })
    assert.matches("did you mean 'colour'", message { colur = "#0b0" })
    assert.matches("one object, got 2; make a group", raised(celspan.key, { art, art }))
    assert.matches("one object, got 0", raised(celspan.key, {}))
  end)

  it("may be of keys inside each other, as deep as objects go", function()
    local object = rect(0, 0, 1, 1, "#fff")
    for _ = 1, 120 do object = celspan.key { object } end
    images.near({ 1, 1, 1, 1 }, seen(object), 0, 0)
    assert.matches(" key: .*128", raised(function()
      for _ = 1, 20 do object = celspan.key { object } end
    end))
  end)
end)

-- ---------------------------------------------------------------- mattes

describe("a matte", function()
  local art = rect(0, 0, 40, 40, "#fff")

  it("of a shape grows and is choked exactly", function()
    local circle = celspan.circle { centre = { 20, 20 }, radius = 10 }
    for _, grow in ipairs { 5, -4, 0.5, -10 } do
      local by = celspan.circle { centre = { 20, 20 }, radius = 10 + grow }
      images.alike(2e-3, seen(celspan.clip(art, by), 40, 40),
        seen(celspan.matte(art, circle, { grow = grow }), 40, 40))
    end
    local _, _, _, inside = seen(celspan.matte(art, circle, { grow = -11 }), 40, 40):get(20, 20)
    assert.is_true(inside < 0.03) -- a stroke this wide leaves a speck
  end)

  it("follows the cuts of a shape, and is inverted last", function()
    local by = rect(8, 8, 24, 24) - rect(16, 16, 8, 8)
    local choked = rect(10, 10, 20, 20) - celspan.rect { 14, 14, 12, 12, radius = 2 }
    images.alike(1e-3, seen(celspan.clip(art, choked), 40, 40),
      seen(celspan.matte(art, by, { grow = -2 }), 40, 40))
    images.alike(1e-3, seen(art - choked, 40, 40),
      seen(celspan.matte(art, by, { grow = -2, invert = true }), 40, 40))
  end)

  it("of what is soft, or of luma, grows and is choked where it is half", function()
    local soft = rect(12, -40, 16, 120, celspan.rgb(1, 1, 1, 0.9))
    for _, from in ipairs { "alpha", "luma" } do
      for _, grow in ipairs { 4, -4, -1 } do
        for _, space in ipairs { "linear", "srgb" } do
          local matte = celspan.matte(art, soft, { from = from, grow = grow })
          local shown, first = seen(celspan.group { matte, space = space }, 40, 40), nil
          for x = 19, 0, -1 do
            local _, _, _, a = shown:get(x, 20)
            if a > 0.5 then first = x end
          end
          assert.is_true(math.abs(first - (12 - grow)) <= 1, from .. " " .. grow .. " at " .. first)
          local _, _, _, inside = shown:get(20, 20)
          assert.is_true(math.abs(inside - (grow > 0 and 1 or 0.9)) < 1e-3, "inside " .. inside)
        end
      end
    end
  end)

  it("leaves softness that growing does not reach", function()
    local ramp = celspan.linear { from = { 0, 0 }, to = { 40, 0 }, { 0, celspan.clear },
      { 1, "#fff" } }
    local shown = seen(celspan.matte(art, rect(0, -40, 40, 120, ramp), { grow = -2 }), 40, 40)
    for x = 24, 36 do
      local share = (x + 0.5) / 40
      images.near({ share, share, share, share }, shown, x, 20, 0.01)
    end
    images.near({ 0, 0, 0, 0 }, shown, 20, 20, 0.01)
  end)

  it("is feathered as a blur is, after it has grown", function()
    local by = rect(12, 12, 16, 16)
    local grown = celspan.rect { 10, 10, 20, 20, radius = 2 }
    images.alike(1e-6, seen(celspan.matte(art, rect(12, 12, 16, 16):blur(4)), 40, 40),
      seen(celspan.matte(art, by, { feather = 4 }), 40, 40))
    images.alike(2e-3, seen(celspan.matte(art, grown:blur(4)), 40, 40),
      seen(celspan.matte(art, by, { grow = 2, feather = 4 }), 40, 40))
  end)

  it("is unchanged by 0, and may be empty", function()
    local by = celspan.circle { centre = { 20, 20 }, radius = 10, texture = "#88888880" }
    images.alike(0, seen(celspan.matte(art, by), 40, 40),
      seen(celspan.matte(art, by, { grow = 0, feather = 0 }), 40, 40))
    for _, from in ipairs { "alpha", "luma" } do
      for _, grow in ipairs { 3, -3 } do
        local shown = seen(celspan.matte(art, celspan.union {}, { from = from, grow = grow,
          feather = 2, invert = true }), 40, 40)
        images.near({ 1, 1, 1, 1 }, shown, 20, 20)
      end
    end
  end)

  it("refuses other numbers", function()
    for _, wrong in ipairs { 0 / 0, 1e7, -1e7 } do
      assert.matches("grow", raised(celspan.matte, art, art, { grow = wrong }))
      assert.matches("feather", raised(celspan.matte, art, art, { feather = wrong }))
    end
    assert.matches("feather", raised(celspan.matte, art, art, { feather = -1 }))
    assert.matches("grow =, feather =", raised(celspan.matte, art, art, 3))
  end)
end)

describe("what lies behind a key", function()
  it("is seen through it where many shapes hide each other", function()
    local shapes = {}
    for i = 1, 30 do
      shapes[i] = celspan.circle { centre = { 40 * i - 60, 270 + 150 * math.sin(i) },
        radius = 120 + 5 * i,
        texture = ("#%02x%02x%02x"):format(i * 37 % 256, i * 91 % 256, i * 53 % 256) }
    end
    local actor = celspan.circle { centre = { 480, 270 }, radius = 60, texture = "#c33" }
    local keyed = celspan.key { celspan.group { rect(0, 0, 960, 540, "#0b0"), actor },
      colour = "#0b0", tolerance = 0.2, softness = 0.2 }
    local rostrum = celspan.rostrum { celspan.cel(shapes), celspan.cel { keyed } }
    local size = { 960, 540 }
    local image = assert(celspan.pixels(rostrum, { size = size, film = size, antialias = "none" }))
    for y = 5, 535, 10 do
      for x = 5, 955, 10 do
        local r, g, b = image:get(x, y)
        local wanted = { celspan.probe(rostrum, x + 0.5, y + 0.5, { film = size }) }
        local off = math.abs(r - wanted[1]) + math.abs(g - wanted[2]) + math.abs(b - wanted[3])
        assert.is_true(off < 1e-3, ("%d, %d: %g"):format(x, y, off))
      end
    end
  end)
end)
