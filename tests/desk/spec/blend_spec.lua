-- Groups, blend modes and mattes: what films show of them. The formulas themselves are tested by
-- unit/blend, random scenes by property/oracle.
local celspan = require "celspan"
local near = require("tests.support.images").near
local prng = require "tests.support.prng"
local workbench = require "tests.support.workbench"

local modes = { "normal", "multiply", "screen", "overlay", "darken", "lighten", "color-dodge",
                "color-burn", "hard-light", "soft-light", "difference", "exclusion", "hue",
                "saturation", "color", "luminosity", "add", "linear-dodge",
                "soft-light-photoshop", "linear-burn", "vivid-light", "linear-light", "pin-light",
                "hard-mix", "subtract", "divide", "darker-color", "lighter-color" }

local function rect(x, y, w, h, texture) return celspan.rect { x, y, w, h, texture = texture } end

--- The pixels of one cel on a film of this size, or of a rostrum.
local function pixels(what, w, h, antialias)
  if not tostring(what):find "^rostrum" then
    what = celspan.rostrum { celspan.cel { what }, antialias = antialias }
  end
  return assert(celspan.pixels(what, { size = { w, h }, film = { w, h } }))
end

--- A film that fills one pixel, seen by its probe and in the rendered floats.
local function check_rendered(list, count)
  local rostrum = celspan.rostrum { celspan.cel(list), antialias = "none" }
  local image = pixels(rostrum, count, 1)
  for x = 0, count - 1 do
    near({ celspan.probe(rostrum, x + 0.5, 0.5, { film = { count, 1 } }) }, image, x, 0, 1e-4)
  end
end

describe("a blend mode", function()
  it("is shown as the oracle says for random colours and alphas", function()
    for number, mode in ipairs(modes) do
      local random, list = prng.new(number), {}
      local function paint()
        return celspan.rgb(random:between(0.01, 0.99), random:between(0, 0.9),
          random:between(0.1, 1), random:between(0.05, 1))
      end
      for x = 0, 199 do
        list[#list + 1] = rect(x, 0, 1, 1, paint())
        list[#list + 1] = rect(x, 0, 1, 1, paint()):blend(mode)
      end
      check_rendered(list, 200)
    end
  end)

  it("multiplies its backdrop, where that is present", function()
    local image = pixels(celspan.union { rect(0, 0, 2, 1, celspan.rgb(0.5, 1, 0.25)),
      rect(1, 0, 2, 1, celspan.rgb(0.5, 0.5, 0.5)):blend("multiply") }, 3, 1, "none")
    near({ 0.5, 1, 0.25, 1 }, image, 0, 0)
    near({ 0.25, 0.5, 0.125, 1 }, image, 1, 0)
    near({ 0.5, 0.5, 0.5, 1 }, image, 2, 0)
  end)

  it("acts on the ground of the frame and on the matte of its back light", function()
    local shape = celspan.cel { rect(0, 0, 1, 1, celspan.rgb(0.5, 0.5, 0.5)), blend = "multiply" }
    local image = pixels(celspan.rostrum { shape, back = { 0.5, 0.25, 1, 1 } }, 2, 1)
    near({ 0.25, 0.125, 0.5, 1 }, image, 0, 0)
    near({ 0.5, 0.25, 1, 1 }, image, 1, 0)
    image = pixels(celspan.rostrum { shape, back = { 0.5, 0.25, 1, 0 } }, 1, 1)
    near({ 0.5, 0.5, 0.5, 1 }, image, 0, 0) -- without a matte nothing is there to blend with
  end)

  it("acts on its backdrop as that is lit", function()
    local image = pixels(celspan.rostrum {
      celspan.cel { rect(0, 0, 1, 1, "#fff"), front = { 0.5, 0.5, 0.5 } },
      celspan.cel { rect(0, 0, 1, 1, "#fff"):blend("multiply"), front = { 0.5, 1, 0.25 } } }, 1, 1)
    near({ 0.25, 0.5, 0.125, 1 }, image, 0, 0)
  end)

  it("is lit by a light with a shape before it acts", function()
    local light = { texture = celspan.linear { from = { 0, 0 }, to = { 4, 0 },
      { 0, celspan.rgb(0, 0, 0) }, { 1, celspan.rgb(1, 1, 1) } }, on = "frame" }
    local image = pixels(celspan.rostrum { celspan.cel { rect(0, 0, 4, 1, "#fff"),
      rect(0, 0, 4, 1, "#fff"):blend("multiply"), front = light }, antialias = "none" }, 4, 1)
    for x = 0, 3 do
      local lit = (x + 0.5) / 4
      near({ lit * lit, lit * lit, lit * lit, 1 }, image, x, 0, 1 / 1023)
    end
  end)

  it("adds light beyond 1, but alpha only up to 1", function()
    local image = pixels(celspan.union { rect(0, 0, 1, 1, celspan.rgb(1, 0.5, 0, 0.75)),
      rect(0, 0, 1, 1, celspan.rgb(1, 1, 1, 0.75)):blend("add") }, 1, 1, "none")
    near({ 1.5, 1.125, 0.75, 1 }, image, 0, 0)
  end)

  it("follows a gradient pixel by pixel", function()
    local ramp = celspan.linear { from = { 0, 0 }, to = { 64, 0 }, { 0, celspan.rgb(0, 0, 1) },
      { 1, celspan.rgb(1, 0.5, 0) } }
    for _, mode in ipairs(modes) do
      local rostrum = celspan.rostrum { celspan.cel { rect(0, 0, 64, 1, celspan.rgb(0.6, 0.3, 0.7)),
        rect(8, 0, 50, 1, ramp):fade(0.9):blend(mode), rect(0, 0, 40, 1, ramp):fade(0.4) },
        antialias = "none" }
      local image = pixels(rostrum, 64, 1)
      for x = 0, 63 do
        near({ celspan.probe(rostrum, x + 0.5, 0.5, { film = { 64, 1 } }) }, image, x, 0, 1 / 1000)
      end
    end
  end)

  it("reads back as its word, and is kept by transforms, fades, names and :with", function()
    local shape = celspan.circle { centre = { 5, 5 }, radius = 2 }
    assert.equal("normal", shape.mode)
    local blended = shape:blend("screen")
    assert.equal("screen", blended:translate(1, 0):fade(0.5):named("glow").mode)
    assert.equal("screen", blended:with { radius = 3 }.mode)
    assert.equal(3, blended:with { radius = 3 }.radius)
    assert.equal("darken", blended:blend("darken").mode)
    assert.equal("normal", blended:blend("normal").mode)
    assert.equal("hue", celspan.group { shape, blend = "hue" }.mode)
    assert.equal("color", celspan.group { shape, blend = "hue" }:blend("color").mode)
    assert.equal("add", celspan.cel { shape, blend = "add" }.mode)
    assert.equal("add", celspan.cel { shape, blend = "add" }:rotate(9).mode)
  end)

  it("that does not exist is refused at its line, with all that do", function()
    local shape = celspan.circle { centre = { 5, 5 }, radius = 2 }
    assert.error_matches(function() shape:blend("plus") end,
      'blend: the mode must be one of "normal", .* or "lighter%-color", got "plus"; '
        .. 'did you mean "add"%?')
    assert.error_matches(function() celspan.group { shape, blend = "plus" } end,
      'got "plus"; did you mean "add"%?')
    assert.error_matches(function() celspan.group { shape, blend = 3 } end,
      "group: field 'blend' must be .*, got number")
    assert.error_matches(function() celspan.cel { shape, blend = "Multiply" } end,
      "cel: field 'blend' must be .*, got \"Multiply\"")
  end)

  it("is refused by relight.stack, since lights do not add up", function()
    local rostrum = celspan.rostrum { celspan.cel { rect(0, 0, 1, 1, "#fff"):blend("screen") } }
    local stack, message = require "celspan.relight".stack(rostrum, { size = { 4, 4 } })
    assert.is_nil(stack)
    assert.matches("a cel has a blend mode, a grade or grain, so its lights do not add up", message)
  end)

  it("of a thousand shapes over each other takes bounded memory and gives the right colour",
    function()
      local list = { rect(0, 0, 2, 2, "#fff") }
      for _ = 1, 1000 do
        list[#list + 1] = rect(0, 0, 2, 2, celspan.rgb(0.999, 0.998, 1)):blend("multiply")
      end
      near({ 0.999 ^ 1000, 0.998 ^ 1000, 1, 1 }, pixels(celspan.union(list), 2, 2), 1, 1, 1e-4)
    end)
end)

describe("a group", function()
  local back = rect(0, 0, 4, 1, celspan.rgb(0.5, 0.5, 0.5))
  local source = rect(0, 0, 4, 1, celspan.rgb(0.5, 1, 0.25)):blend("multiply")

  it("lets modes inside act on its own backdrop, unless it isolates", function()
    near({ 0.25, 0.5, 0.125, 1 }, pixels(celspan.union { back, celspan.group { source } }, 1, 1),
      0, 0)
    near({ 0.5, 1, 0.25, 1 },
      pixels(celspan.union { back, celspan.group { source, isolate = true } }, 1, 1), 0, 0)
    near({ 0.5, 0.75, 0.375, 1 },
      pixels(celspan.union { back, celspan.group { source, opacity = 0.5 } }, 1, 1), 0, 0)
  end)

  it("isolates inside a faded cel, a composition, and an object that fades", function()
    local inside = { celspan.union { source }:fade(0.5), celspan.rostrum {
      celspan.cel { source }, size = { 4, 1 } }:fade(0.5) }
    for _, object in ipairs(inside) do
      near({ 0.5, 0.75, 0.375, 1 }, pixels(celspan.union { back, object }, 1, 1), 0, 0)
    end
    near({ 0.5, 0.75, 0.375, 1 }, pixels(celspan.rostrum { celspan.cel { back },
      celspan.cel { source, opacity = 0.5 } }, 1, 1), 0, 0)
  end)

  it("may be empty, in a rostrum without cels as well", function()
    near({ 0, 0, 0, 0 }, pixels(celspan.group { blend = "multiply", opacity = 0.5 }, 1, 1), 0, 0)
    near({ 0, 0, 0, 0 }, pixels(celspan.rostrum {}, 1, 1), 0, 0)
    near({ 0, 0, 0, 0 }, pixels(celspan.matte(celspan.group {}, back), 1, 1), 0, 0)
  end)

  it("does not isolate as a boolean or as a clip", function()
    for _, object in ipairs { celspan.clip(source, back),
      rect(0, 0, 4, 1, celspan.clear) & source, source - rect(9, 9, 1, 1) } do
      near({ 0.25, 0.5, 0.125, 1 }, pixels(celspan.rostrum { celspan.cel { back },
        celspan.cel { object } }, 1, 1), 0, 0)
    end
  end)

  it("is faded as one", function()
    local image = pixels(celspan.group { rect(0, 0, 2, 1, "#f00"), rect(1, 0, 2, 1, "#0f0"),
      opacity = 0.5 }, 3, 1)
    near({ 0.5, 0, 0, 0.5 }, image, 0, 0)
    near({ 0, 0.5, 0, 0.5 }, image, 1, 0)
  end)

  it("refuses isolate = false where it must isolate", function()
    assert.error_matches(function() celspan.group { back, opacity = 0.5, isolate = false } end,
      "group: isolate is false, but a group with an opacity below 1 always isolates; leave isolate")
    assert.error_matches(function() celspan.group { back, blend = "hue", isolate = false } end,
      "a group with a blend mode always isolates")
    assert.has_no.errors(function() celspan.group { back, isolate = false } end)
  end)

  it("may be nested 128 deep, with a mode on each level", function()
    local object, deep = back, nil
    for _ = 1, 127 do
      object = celspan.group { object, blend = "multiply" }
    end
    near({ 0.5, 0.5, 0.5, 1 }, pixels(object, 1, 1), 0, 0)
    assert.error_matches(function() deep = celspan.group { celspan.group { object } } end,
      "nested 129 levels deep; the limit is 128")
    assert.is_nil(deep)
  end)
end)

describe("a matte", function()
  local art = rect(0, 0, 4, 1, celspan.rgb(1, 0.5, 0.25))

  it("fades by alpha, or by luma, or by the rest", function()
    local by = rect(0, 0, 3, 1, celspan.rgb(0.5, 0.25, 1, 0.5))
    local luma = 0.5 * (0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722)
    for _, case in ipairs { { 0.5, 0, { from = "alpha" } }, { luma, 0, { from = "luma" } },
      { 0.5, 1, { invert = true } }, { 1 - luma, 1, { from = "luma", invert = true } } } do
      local image = pixels(celspan.matte(art, by, case[3]), 4, 1)
      local inside, outside = case[1], case[2]
      near({ inside, 0.5 * inside, 0.25 * inside, inside }, image, 1, 0)
      near({ outside, 0.5 * outside, 0.25 * outside, outside }, image, 3, 0)
    end
  end)

  it("varies with a gradient and with a picture", function()
    local ramp = celspan.linear { from = { 0, 0 }, to = { 4, 0 }, { 0, celspan.clear },
      { 1, celspan.rgb(0, 0, 0) } }
    local dots = celspan.picture { pixels = "\255\0\255\0", size = { 4, 1 }, format = "grey8",
                                   box = { 0, 0, 4, 1 } }
    local image = pixels(celspan.matte(art, rect(0, 0, 4, 1, ramp)), 4, 1)
    local dotted = pixels(celspan.matte(art, rect(0, 0, 4, 1, dots), { from = "luma" }), 4, 1)
    for x = 0, 3 do
      local m = (x + 0.5) / 4
      near({ m, 0.5 * m, 0.25 * m, m }, image, x, 0, 1 / 1000)
      m = (x + 1) % 2
      near({ m, 0.5 * m, 0.25 * m, m }, dotted, x, 0, 1e-6)
    end
  end)

  it("of alpha by one gradient is as straight as the gradient", function()
    local bench = workbench.new()
    finally(function() bench:remove() end)
    --- How many colours are evaluated for a row of 400 pixels.
    local function evaluations(from)
      local path = bench:write("film.lua", ([[
        local celspan = require "celspan"
        local ramp = celspan.linear { from = { 0, 0 }, to = { 400, 0 }, { 0, "#fff0" },
                                      { 1, "#fff" } }
        local by = celspan.rect { 0, 0, 400, 1, texture = ramp }
        return celspan.film { size = { 400, 1 }, frames = 1, frame = function()
          return celspan.rostrum { celspan.cel { celspan.matte(celspan.rect { 0, 0, 400, 1,
            texture = "#248" }, by, { from = "%s" }) }, back = "#321" } end }]]):format(from))
      local _, out = bench:celspan("spans --stats --workers 1 %s", path)
      return tonumber(out:match "colour_evaluations (%d+)")
    end
    -- Luma is compared with a line at the quarters.
    assert.equal(evaluations "luma" - 3, evaluations "alpha")
  end)

  it("by many stops evaluates each column once", function()
    local bench = workbench.new()
    finally(function() bench:remove() end)
    local path = bench:write("film.lua", [[
      local celspan = require "celspan"
      -- A stop for each of 200 columns, where the next stretch of the ramp begins.
      local ramp = { from = { 0, 0 }, to = { 200, 0 } }
      for i = 0, 200 do ramp[i + 1] = { i / 200, i % 2 == 0 and "#fff8" or "#2488" } end
      local by = celspan.rect { 0, 0, 200, 1, texture = celspan.linear(ramp) }
      return celspan.film { size = { 200, 1 }, frames = 1, frame = function()
        return celspan.rostrum { celspan.cel { celspan.matte(celspan.rect { 0, 0, 200, 1,
          texture = "#248" }, by, { from = "luma" }) }, back = "#321" } end }]])
    local _, out = bench:celspan("spans --stats --workers 1 %s", path)
    local count = tonumber(out:match "colour_evaluations (%d+)")
    assert.is_true(count >= 200 and count < 220, out)
  end)

  it("is under white light whatever lights the art", function()
    local image = pixels(celspan.rostrum { celspan.cel { celspan.matte(art,
      rect(0, 0, 4, 1, "#fff"), { from = "luma" }), front = { 0.5, 0.5, 0 } } }, 1, 1)
    near({ 0.5, 0.25, 0, 1 }, image, 0, 0)
  end)

  it("has the shape of its art, in booleans and for bounds", function()
    local matte = celspan.matte(art, rect(2, 0, 9, 9, "#fff"))
    assert.same({ 0, 0, 4, 1 }, { matte:bounds() })
    assert.is_true(matte:contains(0.5, 0.5))
    assert.is_false(matte:contains(5, 0.5))
    local image = pixels(rect(0, 0, 6, 1, "#fff") - matte, 6, 1)
    near({ 0, 0, 0, 0 }, image, 1, 0)
    near({ 1, 1, 1, 1 }, image, 5, 0)
  end)

  it("refuses what is no object, and options that it does not have", function()
    assert.error_matches(function() celspan.matte(art) end,
      "matte: argument 2, what it is matted by, must be an object, got nil")
    assert.error_matches(function() celspan.matte(art, art, { from = "red" }) end,
      "matte: field 'from' must be \"alpha\", \"luma\" or \"dissolve\", got \"red\"")
    assert.error_matches(function() celspan.matte(art, art, { inverted = true }) end,
      "matte: unknown field 'inverted'; did you mean 'invert'")
  end)
end)

describe("exactness", function()
  --- A rectangle in two parts with a slanted seam.
  local function parts(texture)
    return celspan.polygon { { 0, 0 }, { 3.3, 0 }, { 11.9, 9 }, { 0, 9 }, texture = texture },
      celspan.polygon { { 3.3, 0 }, { 16, 0 }, { 16, 9 }, { 11.9, 9 }, texture = texture }
  end

  local function bytes(object, antialias)
    local image = pixels(celspan.rostrum { celspan.cel { rect(0, 0, 16, 9, "#3080c0") },
      celspan.cel { object }, antialias = antialias }, 16, 9)
    local list = {}
    for y = 0, 8 do
      for x = 0, 15 do list[#list + 1] = ("%a %a %a %a"):format(image:get(x, y)) end
    end
    return table.concat(list, "\n")
  end

  it("leaks nothing between abutting shapes in groups, modes and mattes", function()
    local paint = celspan.rgb(0.8, 0.4, 0.1, 0.7)
    local whole = rect(0, 0, 16, 9, paint)
    local ramp = rect(0, 0, 16, 9, celspan.rgb(0.3, 0.6, 0.2, 0.6))
    for _, make in ipairs {
      function(...) return celspan.group { opacity = 0.5, ... } end,
      function(...) return celspan.matte(celspan.union { ... }, ramp) end,
      function(...) return celspan.matte(ramp, celspan.union { ... }, { from = "luma" }) end } do
      local a, b = parts(paint)
      assert.equal(bytes(make(whole)), bytes(make(a, b)))
    end
    for _, mode in ipairs(modes) do
      local a, b = parts(paint)
      assert.equal(bytes(celspan.group { whole, blend = mode }),
        bytes(celspan.group { a, b, blend = mode }), mode)
      assert.equal(bytes(whole:blend(mode)), bytes(a:blend(mode) | b:blend(mode)), mode)
    end
  end)

  it("is the mean of the blended colours over a pixel, not the blend of the means", function()
    local image = pixels(celspan.union { rect(0, 0, 0.5, 1, "#fff"), rect(0.5, 0, 0.5, 1, "#000"),
      rect(0, 0, 0.5, 1, "#000"):blend("difference"),
      rect(0.5, 0, 0.5, 1, "#fff"):blend("difference") }, 1, 1)
    near({ 1, 1, 1, 1 }, image, 0, 0)
  end)
end)
