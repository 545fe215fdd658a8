-- Sharpened objects against the formula of an unsharp mask.
local celspan = require "celspan"
local cases = require "tests.support.cases"
local images = require "tests.support.images"
local prng = require "tests.support.prng"
local raised = require("tests.support.raised").message
local scenes = require "tests.support.scenes"

local pixels, assert_alike = images.of, images.alike

local function rect(x, y, w, h, texture) return celspan.rect { x, y, w, h, texture = texture } end

--- The share of a Gaussian of deviation 1 that lies below x, by Simpson's rule.
local function below(x)
  local steps, low, sum = 200, -6, 0
  if x <= low then return 0 end
  local h = (x - low) / steps
  for i = 0, steps do
    local weight = (i == 0 or i == steps) and 1 or i % 2 == 1 and 4 or 2
    sum = sum + weight * math.exp(-(low + i * h) ^ 2 / 2)
  end
  return sum * h / 3 / math.sqrt(2 * math.pi)
end

local dark, light = { 0.2, 0.1, 0.4 }, { 0.6, 0.9, 0.4 }

--- Two colours that meet at column 40 of 80.
local function halves()
  return celspan.union { rect(0, 0, 40, 60, celspan.rgb(table.unpack(dark))),
    rect(40, 0, 40, 60, celspan.rgb(table.unpack(light))) }
end

describe("a sharpened object", function()
  it("is itself and a multiple of its difference from a Gaussian of half the radius", function()
    for _, given in ipairs { { radius = 6, amount = 0.8 }, { radius = 10, amount = 2 },
      { radius = 3, amount = 0.5 } } do
      local image = pixels({ halves():sharpen(given) }, 80, 60)
      for x = 0, 79 do
        local found, share = { image:get(x, 30) }, below((x + 0.5 - 40) / (given.radius / 2))
        for c = 1, 3 do
          local own, soft = x < 40 and dark[c] or light[c], dark[c] + share * (light[c] - dark[c])
          local wanted = math.max(0, own + given.amount * (own - soft))
          assert.is_true(math.abs(found[c] - wanted) < 6e-3 * given.amount + 1e-3,
            ("radius %g, column %d: %g instead of %g"):format(given.radius, x, found[c], wanted))
        end
        assert.equal(1, found[4])
      end
    end
  end)

  it("keeps its shape, and what lies around it does not count", function()
    local shape = celspan.circle { centre = { 30, 30 }, radius = 22.3, texture = "#c84" }
    assert_alike(1e-5, pixels({ shape }, 60, 60), pixels({ shape:sharpen { amount = 5 } }, 60, 60))
    assert_alike(1e-5, pixels({ shape:fade(0.4) }, 60, 60),
      pixels({ shape:fade(0.4):sharpen { radius = 9, amount = 5 } }, 60, 60))
    local glass = rect(5, 5, 40, 40, celspan.gel("#f80", 0.7))
    local ground = rect(0, 0, 60, 60, "#48c")
    assert_alike(1e-5, pixels({ ground, glass }, 60, 60),
      pixels({ ground, glass:sharpen { radius = 4 } }, 60, 60))
    local x, y, w, h = shape:bounds()
    assert.same({ x - 6, y - 6, w + 12, h + 12 }, { shape:sharpen { radius = 3 }:bounds() })
  end)

  it("is sharpened in the numbers of the space around it", function()
    local object = halves():sharpen { radius = 8, amount = 1 }
    local image = pixels({ celspan.group { object, space = "srgb" } }, 80, 60)
    local function code(v) return v <= 0.0031308 and 12.92 * v or 1.055 * v ^ (1 / 2.4) - 0.055 end
    for x = 2, 79, 7 do
      local r, share = image:get(x, 30), below((x + 0.5 - 40) / 4)
      local own, a, b = code(x < 40 and dark[1] or light[1]), code(dark[1]), code(light[1])
      assert.is_true(math.abs(code(r) - (2 * own - a - share * (b - a))) < 8e-3)
    end
  end)

  it("follows its scale, and is made of the frame's pixels", function()
    local small = pixels({ halves():sharpen { radius = 8 } }, 80, 60)
    local large = pixels({ halves():sharpen { radius = 4 }:scale(2):translate(-40, 0) }, 80, 60)
    for x = 0, 79 do
      local a, b = small:get(x, 30), large:get(x, 30)
      assert.is_true(math.abs(a - b) < 2e-3)
    end
  end)

  it("keeps its mode outermost, and its name", function()
    local object = halves():blend("multiply"):named "wall"
    local sharp = object:sharpen { radius = 4 }
    assert.equal("multiply", sharp.mode)
    assert.equal("wall", sharp.name)
    local ground = rect(0, 0, 80, 60, "#9cf")
    assert_alike(1e-6, pixels({ ground, halves():sharpen { radius = 4 }:blend "multiply" }, 80, 60),
      pixels({ ground, sharp }, 80, 60))
  end)

  it("has the same pixels in a part of the frame, and with any number of workers", function()
    local film = celspan.film { size = { 80, 60 }, frame = function()
      return celspan.rostrum { celspan.cel { halves():rotate(20, 40, 30):sharpen { radius = 9 } } }
    end }
    local whole = assert(celspan.pixels(film, { workers = 1 }))
    assert.equal(whole:bytes { depth = "float" },
      assert(celspan.pixels(film, { workers = 2 })):bytes { depth = "float" })
    local part = assert(celspan.pixels(film, { crop = { 20, 10, 40, 30 } }))
    for x = 0, 39, 3 do
      local a, b = part:get(x, 15), whole:get(x + 20, 25)
      assert.is_true(math.abs(a - b) <= 1 / 65535)
    end
  end)

  it("is the object where nothing is to do, and nothing where there is nothing", function()
    local shape = halves()
    for _, given in ipairs { { radius = 0 }, { amount = 0 } } do
      assert_alike(0, pixels({ shape }, 80, 60), pixels({ shape:sharpen(given) }, 80, 60))
    end
    assert_alike(0, pixels({}, 20, 20), pixels({ celspan.union {}:sharpen() }, 20, 20))
    assert_alike(0, pixels({}, 20, 20), pixels({ rect(3, 3, 0, 9, "#fff"):sharpen() }, 20, 20))
  end)

  it("is refused with numbers that make no sense, and drawn at its limits", function()
    local shape = halves()
    for text, given in pairs { ["radius.* %-1"] = { radius = -1 },
      ["radius.* 1001"] = { radius = 1001 },
      ["amount.* %-2"] = { amount = -2 }, ["amount.* 101"] = { amount = 101 },
      ["radius.*number"] = { radius = "wide" }, ["amount"] = { amount = 0 / 0 },
      ["unknown field 'size'"] = { size = 4 } } do
      assert.matches("sharpen: .*" .. text, raised(function() return shape:sharpen(given) end))
    end
    assert.matches("sharpen: its options must be a table", raised(function()
      return shape:sharpen(2)
    end))
    local image = pixels({ shape:sharpen { radius = 1000, amount = 100 } }, 80, 60)
    local r = image:get(10, 10)
    assert.is_true(r >= 0 and r < 1e3)
    local nested = shape
    assert.matches("128", raised(function()
      for _ = 1, 200 do nested = nested:sharpen { radius = 1, amount = 0.01 } end
    end))
    assert.is_true(select(4, pixels({ nested }, 8, 8):get(4, 4)) > 0.99)
  end)
end)

-- ---------------------------------------------------------------- a second implementation

--- The pixels of a column or a row, mixed by a Gaussian; get(k): one of them.
local function softened(get, count, deviation)
  local out, reach = {}, math.ceil(4 * deviation)
  for at = 0, count - 1 do
    local sum, total = { 0, 0, 0, 0 }, 0
    for k = -reach, reach do
      local weight = math.exp(-(k / deviation) ^ 2 / 2)
      local pixel = get(at + k)
      for c = 1, 4 do sum[c] = sum[c] + (pixel and weight * pixel[c] or 0) end
      total = total + weight
    end
    for c = 1, 4 do sum[c] = sum[c] / total end
    out[at] = sum
  end
  return out
end

--- The Gaussian of an image: rows of columns of pixels, and the pixels themselves.
local function blurred(image, deviation)
  local w, h, own, rows, out = image.width, image.height, {}, {}, {}
  for y = 0, h - 1 do
    own[y] = {}
    for x = 0, w - 1 do own[y][x] = { image:get(x, y) } end
    rows[y] = softened(function(x) return own[y][x] end, w, deviation)
    out[y] = {}
  end
  for x = 0, w - 1 do
    local column = softened(function(y) return rows[y] and rows[y][x] end, h, deviation)
    for y = 0, h - 1 do out[y][x] = column[y] end
  end
  return out, own
end

describe("a random object, sharpened", function()
  local MARGIN, W, H = 24, 40, 30

  --- Below all, so that few objects have a single colour.
  local ground = rect(4, 4, 30, 20, celspan.linear { from = { 4, 4 }, to = { 30, 20 },
    { 0, "#104080" }, { 1, "#e0e0a080" } })

  --- The greatest difference from an unsharp mask of the pixels of the object, as a share of 1
  --- and of what may be exact: a Gaussian of points differs from one that is integrated.
  local function difference(object, radius, amount)
    local w, h = W + 2 * MARGIN, H + 2 * MARGIN
    local placed = object:translate(MARGIN, MARGIN)
    local soft, own = blurred(pixels({ placed }, w, h), radius / 2)
    local image, most = pixels({ placed:sharpen { radius = radius, amount = amount } }, w, h), 0
    for y = MARGIN, MARGIN + H - 1 do
      for x = MARGIN, MARGIN + W - 1 do
        local was, mean, found = own[y][x], soft[y][x], { image:get(x, y) }
        for c = 1, 4 do
          local share = mean[4] > 1e-6 and was[4] / mean[4] or 0
          local wanted = c == 4 and was[4]
            or math.max(0, was[c] + (share > 0 and amount * (was[c] - share * mean[c]) or 0))
          most = math.max(most, math.abs(wanted - found[c]) / (1 + was[c]))
        end
      end
    end
    return most
  end

  it("is an unsharp mask of its pixels", function()
    for _, case in cases.of(30) do
      local random = prng.new(case)
      local function object(seed)
        return scenes.value((scenes.object(seed, { has_modes = false, is_plain = true })))
      end
      local radius, amount = random:between(3, 6), random:between(0.5, 1.5)
      local most = difference(celspan.group { ground, object(case), object(case + 1000) }, radius,
        amount)
      assert.is_true(most < 0.006 * amount,
        ("case %d, radius %.2f, amount %.2f: %.4f"):format(case, radius, amount, most))
    end
  end)
end)
