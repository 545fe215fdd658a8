-- celspan.composite, the operators of Porter and Duff; and celspan.dissolve.
local celspan = require "celspan"
local images = require "tests.support.images"

local function square(r, g, b, a)
  return celspan.rect { 0, 0, 1, 1, texture = celspan.rgb(r, g, b, a) }
end

local function seen(object)
  local rostrum = celspan.rostrum { celspan.cel { object } }
  local image = assert(celspan.pixels(rostrum, { size = { 1, 1 } }))
  images.near({ celspan.probe(rostrum, 0.5, 0.5, { film = { 1, 1 } }) }, image, 0, 0)
  return image
end

describe("two objects are composited", function()
  it("and the modes of other programs' nodes are those that messages name", function()
    local a, b = square(0.75, 0.75, 0.75), square(0.5, 0.5, 0.5)
    for node, value in pairs { minus = 0.25, from = 0, plus = 1.25, max = 0.75, min = 0.5 } do
      local _, message = pcall(celspan.composite, a, b, node)
      local advice = message:match "write (.*)$"
      local front = load("local a, b = ... return " .. advice)(a, b)
      local rear = advice:sub(1, 1) == "a" and b or a
      images.near({ value, value, value, 1 }, seen(celspan.group { rear, front }), 0, 0)
    end
  end)

  -- how much of the source and of the backdrop stays, by the alphas of both: Porter and Duff, 1984
  local shares = {
    over = function(a) return 1, 1 - a end,
    ["in"] = function(_, b) return b, 0 end,
    out = function(_, b) return 1 - b, 0 end,
    atop = function(a, b) return b, 1 - a end,
    xor = function(a, b) return 1 - b, 1 - a end,
  }
  for operator, share in pairs(shares) do
    it(("by %q"):format(operator), function()
      for _, alphas in ipairs { { 1, 1 }, { 0.25, 0.75 }, { 1, 0.25 }, { 0.75, 1 } } do
        local a, b = alphas[1], alphas[2]
        local of_a, of_b = share(a, b)
        local source, backdrop = square(1, 0.5, 0, a), square(0, 0.25, 1, b)
        local image = seen(celspan.composite(source, backdrop, operator))
        images.near({ of_a * a, 0.5 * of_a * a + 0.25 * of_b * b, of_b * b, of_a * a + of_b * b },
          image, 0, 0)
      end
    end)
  end

  it("inside each other, apart from the backdrop of the whole", function()
    local ring = celspan.composite(square(1, 1, 1, 0.5), square(0, 0, 0, 0.5), "xor")
    local image = seen(celspan.group { square(0, 0, 1), celspan.composite(ring, square(1, 0, 0),
      "in") })
    images.near({ 0.25, 0.25, 0.75, 1 }, image, 0, 0)
  end)

  it("and nodes of other compositors lead to what is written here", function()
    for node, advice in pairs { erode = "grow = %-1", keymix = "celspan.matte%(a, mask%)",
        multiply = 'a:blend "multiply"', premult = 'alpha = "straight"',
        over = "celspan.composite", chromakey = "celspan.key" } do
      assert.error_matches(function() return celspan[node] end,
        ("celspan has no '%s'; write .*%s"):format(node, advice))
    end
    local a, mask = square(1, 1, 1), square(1, 1, 1, 0.5)
    for _, node in ipairs { "keymix", "hold-out", "matte" } do
      local _, message = pcall(celspan.composite, a, a, node)
      local value = load("local celspan, a, b, mask = ... return " .. message:match "write (.*)$")
      assert.equal("number", math.type(seen(value(celspan, a, a, mask)):get(0, 0)) and "number")
    end
  end)

  it("and other operators are refused with what to write", function()
    local a = square(1, 1, 1)
    assert.error_matches(function() celspan.composite(a, a, "stencil") end,
      'got "stencil"; write celspan.composite%(b, a, "out"%)')
    assert.error_matches(function() celspan.composite(a, a, "dilate") end,
      'got "dilate"; write celspan.matte%(art, by, { grow = 1 }%)')
    assert.error_matches(function() celspan.composite(a, a) end, '"in".*got nil')
    assert.error_matches(function() celspan.composite(a, 3, "in") end, "argument 2 must be")
    assert.error_matches(function() celspan.composite(nil, a, "in") end, "argument 1 must be")
  end)
end)

-- ---------------------------------------------------------------- dissolving

--- A hash of a square of the film, 0 to 1, from its definition (docs/lua-objects.md).
local function number_of(x, y, seed)
  local z = seed << 8 -- SplitMix64
  z = z + 0x9e3779b97f4a7c15
  z = (z ~ z >> 30) * 0xbf58476d1ce4e5b9
  z = (z ~ z >> 27) * 0x94d049bb133111eb
  z = z ~ z >> 31
  local h = (x * 0x9e3779b1 ~ y * 0x85ebca77 ~ z) & 0xffffffff
  h = (h ~ h >> 16) * 0x7feb352d & 0xffffffff
  h = (h ~ h >> 15) * 0x846ca68b & 0xffffffff
  h = h ~ h >> 16
  return ((h ~ 0x80000000) + 0.0) / 2 ^ 32
end

local SIDE = 40

local function frame_of(object, options)
  options = options or {}
  return celspan.film { size = { SIDE, SIDE }, space = options.space, frame = function()
    return celspan.rostrum { celspan.cel { object, front = options.front } }
  end }
end

local function sheet(texture, x, y)
  return celspan.rect { x or 0, y or 0, SIDE, SIDE, texture = texture }
end

describe("an object dissolves", function()
  it("by the stated hash, each pixel whole or clear, as the probe sees it", function()
    for _, case in ipairs { { 0.3, 0 }, { 0.75, 0 }, { 0.75, 7, space = "srgb" } } do
      local alpha, seed = case[1], case[2]
      local film = frame_of(celspan.dissolve(sheet "#f80":fade(alpha), seed), case)
      local image, whole = assert(celspan.pixels(film)), 0
      local r, g, b = celspan.pixels(frame_of(sheet "#f80", case)):get(0, 0)
      for y = 0, SIDE - 1 do
        for x = 0, SIDE - 1 do
          local is_whole = number_of(x, y, seed) > 1 - alpha
          whole = whole + (is_whole and 1 or 0)
          images.near(is_whole and { r, g, b, 1 } or { 0, 0, 0, 0 }, image, x, y)
          if x % 7 == 0 then
            images.near({ celspan.probe(film, x + 0.5, y + 0.5) }, image, x, y)
          end
        end
      end
      assert.is_true(math.abs(whole / SIDE ^ 2 - alpha) < 3 * (alpha * (1 - alpha)) ^ 0.5 / SIDE)
    end
  end)

  it("by its alpha at each place, with its own colour, alone or in front of others", function()
    local fade = celspan.linear { from = { 0, 0 }, to = { SIDE, 0 }, { 0, "#00f0" }, { 1, "#00f" } }
    local image = celspan.pixels(frame_of(celspan.union { sheet "#fff",
      celspan.dissolve(sheet(fade)) }))
    local counts = { 0, 0 }
    for y = 0, SIDE - 1 do
      for x = 0, SIDE - 1 do
        local is_whole = number_of(x, y, 0) > 1 - (x + 0.5) / SIDE
        images.near(is_whole and { 0, 0, 1, 1 } or { 1, 1, 1, 1 }, image, x, y)
        local half = 2 * x // SIDE + 1
        counts[half] = counts[half] + (is_whole and 1 or 0)
      end
    end
    assert.is_true(counts[2] > 2 * counts[1])
  end)

  it("and what is opaque or clear stays as it is", function()
    local shape = celspan.circle { centre = { 20, 20 }, radius = 15, texture = "#2a6" }
    assert.equal(celspan.pixels(frame_of(shape)):bytes(),
      celspan.pixels(frame_of(celspan.dissolve(shape))):bytes())
    assert.equal(("\0"):rep(4 * SIDE * SIDE),
      celspan.pixels(frame_of(celspan.dissolve(shape:fade(0)))):bytes())
    assert.is_nil(celspan.dissolve(celspan.union {}):bounds())
  end)

  it("alike in every part of the frame", function()
    local art = celspan.dissolve(celspan.circle { centre = { 20, 20 }, radius = 18,
      texture = "#a4f" }:fade(0.6), 3)
    local whole = celspan.pixels(frame_of(art)):bytes()
    local parts = celspan.pixels(frame_of(celspan.group { celspan.matte(art, sheet("#fff", 0, 13)),
      celspan.matte(art, sheet("#fff", 0, 13 - SIDE)) })):bytes()
    assert.equal(whole, parts)
  end)

  it("in a matte by any light, inverted too", function()
    local art = sheet "#fff":fade(0.5)
    for _, case in ipairs { { 0.6, false, 1 }, { 0.4, false, 0 }, { 0.6, true, 0 },
      { 0.4, true, 1 } } do
      local by = sheet(celspan.rgb(case[1], case[1], case[1]))
      local matte = celspan.matte(art, by, { from = "dissolve", invert = case[2] })
      local film = frame_of(matte:fade(0.25), { front = { 1, 0.5, 0 } })
      local kept = case[3] / 4
      images.near({ kept, kept / 2, 0, kept }, celspan.pixels(film), 5, 5)
      images.near({ celspan.probe(film, 5.5, 5.5) }, celspan.pixels(film), 5, 5)
    end
    local beyond = celspan.matte(art, celspan.rect { 0, 0, 4, 4, texture = "#fff" },
      { from = "dissolve" })
    images.near({ 0, 0, 0, 0 }, celspan.pixels(frame_of(beyond)), 9, 9)
  end)

  it("and nothing else, and not where it cannot", function()
    assert.error_matches(function() celspan.dissolve(3) end, "dissolve: the first argument must be")
    assert.error_matches(function() celspan.dissolve(sheet "#fff", 0.5) end,
      "dissolve: the seed must be a whole number, got 0.5")
    assert.error_matches(function() celspan.dissolve(sheet "#fff", 1 << 40) end, "seed")
    assert.error_matches(function()
      celspan.matte(sheet "#fff", sheet "#fff", { from = "dissolve", grow = 1 })
    end, "matte: grow is not possible with from = dissolve; grow the art instead")
    assert.error_matches(function() sheet "#fff":blend "dissolve" end,
      'got "dissolve"; write celspan.dissolve%(object%)')
  end)
end)
