-- Taking light off pictures: the result, in the original light and in others; files; and refusals.
-- One file, because all tests use the same picture in known lights.
local celspan = require "celspan"
local present = require "tests.support.present"
local prng = require "tests.support.prng"
local raised = require("tests.support.raised").sentence
local relight = require "celspan.relight"
local workbench = require "tests.support.workbench"

local it_reads = present.pictures() and it or pending -- files of pictures need their module

local bench

before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

local WIDTH, HEIGHT = 61, 37

--- A picture in memory, from a function that returns each pixel: r, g, b, a, premultiplied.
local function picture(at, w, h)
  w, h = w or WIDTH, h or HEIGHT
  local pixels = {}
  for y = 0, h - 1 do
    for x = 0, w - 1 do pixels[#pixels + 1] = string.pack("<ffff", at(x, y)) end
  end
  return celspan.picture { pixels = table.concat(pixels), size = { w, h }, format = "rgbaf" }
end

--- A texture on its own, pixel by pixel.
local function show(texture, lights, w, h)
  w, h = w or WIDTH, h or HEIGHT
  local cel = { celspan.rect { 0, 0, w, h, texture = texture } }
  for name, light in pairs(lights or {}) do cel[name] = light end
  return assert(celspan.pixels(celspan.rostrum { celspan.cel(cel) }, { size = { w, h } }))
end

--- The greatest difference of two images in r, g, b and a, relative to the value if that is above
--- 1.
local function difference(a, b)
  local worst = 0
  for y = 0, a.height - 1 do
    for x = 0, a.width - 1 do
      local p, q = { a:get(x, y) }, { b:get(x, y) }
      for c = 1, 4 do worst = math.max(worst, math.abs(p[c] - q[c]) / math.max(1, p[c])) end
    end
  end
  return worst
end

local random = celspan.random "relight"

--- A pigment at each pixel, with highlights far above 1; beta 1 or less.
local function pigment(x, y, c)
  local shine = (x - 20) ^ 2 + (y - 12) ^ 2 < 30 and 9 or 1
  return shine * (0.1 + 0.8 * random(("%d %d %d"):format(x, y, c)))
end

local function beta_at(x) return x < 8 and 0 or x < 20 and x / 20 or 1 end

local LAMP = { 1.4, 0.8, 0.35 }

local function lit(light, x, y)
  local beta = beta_at(x)
  return beta * pigment(x, y, 1) * light[1], beta * pigment(x, y, 2) * light[2],
    beta * pigment(x, y, 3) * light[3], beta
end

local function photograph(light) return picture(function(x, y) return lit(light, x, y) end) end

describe("relight.from a picture and its light", function()
  it("gives the picture back in that light, highlights included", function()
    local taken = photograph(LAMP)
    local texture, light = assert(relight.from { picture = taken, light = LAMP })
    assert.are.same(LAMP, light)
    local before = show(taken)
    assert.is_true(before:get(20, 12) > 5)
    assert.is_true(difference(before, show(texture, { front = light })) < 1 / 1023)
  end)

  it("shows it as it would be in another light", function()
    local dusk = { 0.2, 0.3, 0.9 }
    local texture = assert(relight.from { picture = photograph(LAMP), light = LAMP })
    assert.is_true(difference(show(photograph(dusk)), show(texture, { front = dusk })) < 1e-5)
  end)

  it("accepts colours as lights, and keeps the picture's sampling, wrap and box", function()
    local taken = picture(function() return 0.25, 0.25, 0.25, 1 end, 2, 2)
      :with { box = { 4, 4, 2, 2 }, wrap = "clear" }
    local texture = assert(relight.from { picture = taken, light = "#808080" })
    local image = show(texture, {}, 8, 8)
    local r = image:get(5, 5)
    assert.is_near(0.25 / 0.21586, r, 1e-3)
    assert.are.same({ 0, 0, 0, 0 }, { image:get(1, 1) })
  end)

  it("reports that a light of 0 or nearly 0 gives no information", function()
    local texture, message = relight.from { picture = photograph(LAMP), light = { 1, 0, 1 } }
    assert.is_nil(texture)
    assert.is_truthy(message:find("there is no green in the light", 1, true))
    texture, message = relight.from { picture = photograph(LAMP), light = { 1, 1, 2e-5 } }
    assert.is_nil(texture)
    assert.is_truthy(message:find("the light is too dim: at pixel", 1, true))
  end)
end)

--- A card of pigments S and media T, by the pixel.
local function card_s(x, y, c) return 0.6 * beta_at(x) * random(("s%d %d %d"):format(x, y, c)) end
local function card_t(x, y, c)
  return (1 - beta_at(x)) * (0.3 + 0.7 * random(("t%d %d %d"):format(x, y, c)))
end

--- The card lit from the front, in front of a background that sends light.
local function card(front, ground)
  return picture(function(x, y)
    local rgb = {}
    for c = 1, 3 do
      local behind = type(ground) == "function" and ground(x, y, c) or ground[c]
      rgb[c] = card_s(x, y, c) * front[c] + card_t(x, y, c) * behind
    end
    return rgb[1], rgb[2], rgb[3], 1
  end)
end

--- Compares the texture with the card in other lights, in front of a background.
local function check_card(texture)
  local front, ground = { 0.3, 1.2, 0.7 }, { 0.9, 0.1, 0.4 }
  local image = show(texture, { front = front, back = ground })
  assert.is_true(difference(show(card(front, ground)), image) < 1e-5)
  local _, _, _, alpha = show(texture):get(4, 4)
  assert.is_near(1 - (card_t(4, 4, 1) + card_t(4, 4, 2) + card_t(4, 4, 3)) / 3, alpha, 1e-5)
end

local BLACK = { 0, 0, 0 }

describe("relight.from two exposures", function()
  it("finds the scattered and the transmitted light", function()
    local texture, light = assert(relight.from {
      front = { picture = card(LAMP, BLACK), light = LAMP },
      back = { picture = card(BLACK, { 0.5, 0.6, 0.7 }), light = { 0.5, 0.6, 0.7 } } })
    assert.are.same(LAMP, light)
    check_card(texture)
  end)

  it("is the same by direct evaluation", function()
    local texture = assert(relight.from {
      front = { picture = card(LAMP, BLACK), light = LAMP },
      back = { picture = card(BLACK, { 1, 1, 1 }), light = { 1, 1, 1 } } })
    local rostrum = celspan.rostrum { celspan.cel {
      celspan.rect { 0, 0, 2 * WIDTH, 2 * HEIGHT, texture = texture }, front = { 1, 0.5, 0.2 },
      back = { 0.2, 0.3, 0.4, 0 } } }
    local size = { 2 * WIDTH, 2 * HEIGHT }
    local image = assert(celspan.pixels(rostrum, { size = size }))
    for _, at in ipairs { { 0, 0 }, { 31, 17 }, { 60, 44 }, { 121, 73 } } do
      local point = { celspan.probe(rostrum, at[1] + 0.5, at[2] + 0.5, { film = size }) }
      for c, value in ipairs { image:get(at[1], at[2]) } do
        assert.is_near(point[c], value, 1e-5)
      end
    end
  end)

  it("takes a few impossible values for glints", function()
    local function spotted(rows)
      local function ground(_, y) return y < rows and 9 or 0.4 end
      return relight.from { front = { picture = card(LAMP, BLACK), light = LAMP },
        back = { picture = card(BLACK, ground), light = { 0.4, 0.4, 0.4 } } }
    end
    -- The card lets light through in 20 of 61 columns of 37 rows: one row is less than 1 % of all.
    assert.is_truthy(spotted(1))
    local texture, message = spotted(4)
    assert.is_nil(texture)
    assert.is_truthy(message:find("values are impossible in this light", 1, true))
  end)

  it("refuses impossible pictures, with the values found", function()
    local shots = { front = { picture = card(LAMP, BLACK), light = LAMP },
      back = { picture = card(BLACK, { 1, 1, 1 }), light = { 0.4, 0.4, 0.4 } } }
    local texture, message = relight.from(shots)
    assert.is_nil(texture)
    assert.is_truthy(message:find "times as much %l+ comes through as fell on it")
    shots.back.picture = picture(function() return 0, 0, 0, 1 end, 5, 4)
    texture, message = relight.from(shots)
    assert.is_nil(texture)
    assert.is_truthy(message:find("61 x 37 pixels, and .* 5 x 4; they must lie pixel on pixel"))
  end)
end)

describe("relight.from two grounds", function()
  it("finds the same with two colours", function()
    local blue, sand = { 0.1, 0.2, 0.9 }, { 0.8, 0.7, 0.3 }
    check_card((assert(relight.from { light = LAMP, over = {
      { picture = card(LAMP, blue), ground = blue },
      { picture = card(LAMP, sand), ground = sand } } })))
  end)

  it("finds the same with two pictures", function()
    local function first(x, y, c) return 0.1 + 0.2 * ((x + y + c) % 3) end
    local function second(x, y, c) return first(x, y, c) + 0.3 end
    local function as_picture(ground)
      return picture(function(x, y) return ground(x, y, 1), ground(x, y, 2), ground(x, y, 3), 1 end)
    end
    check_card((assert(relight.from { light = LAMP, over = {
      { picture = card(LAMP, first), ground = as_picture(first) },
      { picture = card(LAMP, second), ground = as_picture(second) } } })))
  end)

  it("reports which channel of the grounds is the same", function()
    local texture, message = relight.from { over = {
      { picture = card(LAMP, BLACK), ground = "#000000" },
      { picture = card(LAMP, { 1, 1, 0 }), ground = { 1, 1, 0 } } } }
    assert.is_nil(texture)
    assert.is_truthy(message:find("both grounds have the same blue, 0 and 0", 1, true))
  end)
end)

--- A scene of patches whose pigments are grey on average, on a grey of 0.18, lit by a light.
local function scene(front)
  local parts = { celspan.rect { 0, 0, 160, 120, texture = celspan.rgb(0.18, 0.18, 0.18) } }
  for i = 0, 11 do
    for k = 0, 8 do
      local grey, turn = 0.06 + 0.24 * ((i * 5 + k * 7) % 11) / 10, (i + 2 * k) % 3
      local hue = { 1.3, 1, 0.7, 1.3, 1 }
      parts[#parts + 1] = celspan.circle { centre = { 7 + 13.3 * i, 7 + 13.3 * k }, radius = 6,
        texture = celspan.rgb(grey * hue[1 + turn], grey * hue[2 + turn], grey * hue[3 + turn]) }
    end
  end
  parts[#parts + 1] = celspan.rect { 70, 50, 20, 20, texture = celspan.rgb(0.4, 0.2, 0.3) }
  return celspan.rostrum { celspan.cel { front = front, table.unpack(parts) } }
end

local function photograph_of(rostrum)
  local image = assert(celspan.pixels(rostrum, { size = { 160, 120 } }))
  return celspan.picture { pixels = image:bytes { depth = "float" }, size = { 160, 120 },
    format = "rgbaf" }
end

describe("relight.from an estimate", function()
  local lamp = { 1.2, 0.9, 0.5 }

  it("finds the light of a rendered scene that is grey on average within 3 %", function()
    local _, light = assert(relight.from { picture = photograph_of(scene(lamp)),
      estimate = "grey" })
    for c = 1, 3 do assert.is_near(1, light[c] / lamp[c], 0.03) end
  end)

  it("finds it within 3 % from a patch of known colour", function()
    local texture, light = assert(relight.from { picture = photograph_of(scene(lamp)),
      estimate = { at = { 72, 52, 16, 16 }, colour = { 0.4, 0.2, 0.3 } } })
    for c = 1, 3 do assert.is_near(1, light[c] / lamp[c], 0.03) end
    local r, g, b = show(texture, {}, 160, 120):get(80, 60)
    assert.is_near(0.4, r, 0.012)
    assert.is_near(0.2, g, 0.006)
    assert.is_near(0.3, b, 0.009)
  end)

  --- A lamp that falls off towards a corner, as a light with a shape.
  local uneven = celspan.radial { centre = { -60, -50 }, radius = 300,
    { 0, celspan.rgb(1, 0.9, 0.7) },
    { 1, celspan.rgb(0.25, 0.2, 0.1) } }
  local lantern = { texture = uneven, gain = 1.5 }

  --- Compares a light with a shape with the true one at some points.
  local function check_shape(light)
    local white = celspan.rect { 0, 0, 160, 120, texture = "#ffffff" }
    local function sheet(front)
      return assert(celspan.pixels(celspan.rostrum { celspan.cel { white, front = front } },
        { size = { 160, 120 } }))
    end
    local truth, found = sheet(lantern), sheet(light)
    for _, at in ipairs { { 20, 20 }, { 80, 60 }, { 140, 20 }, { 20, 100 }, { 130, 100 } } do
      local r, g, b = truth:get(at[1], at[2])
      local fr, fg, fb = found:get(at[1], at[2])
      assert.is_near(1, fr / r, 0.03)
      assert.is_near(1, fg / g, 0.03)
      assert.is_near(1, fb / b, 0.03)
    end
  end

  it("finds uneven light from a white area, and from the picture itself", function()
    local taken = photograph_of(scene(lantern))
    local blank = photograph_of(celspan.rostrum { celspan.cel { front = lantern,
      celspan.rect { 0, 0, 160, 120, texture = celspan.rgb(0.9, 0.9, 0.9) } } })
    local known = { at = { 72, 52, 16, 16 }, colour = { 0.4, 0.2, 0.3 } }
    local texture, light = assert(relight.from { picture = taken, estimate = known,
      uneven = blank })
    check_shape(light)
    local shown = show(texture, { front = light }, 160, 120)
    assert.is_true(difference(show(taken, {}, 160, 120), shown) < 1 / 1023)
    local _, own = assert(relight.from { picture = taken, estimate = "grey", uneven = true })
    local even = assert(relight.from { picture = taken, estimate = "grey", uneven = true })
    assert.is_true(difference(show(taken, {}, 160, 120), show(even, { front = own }, 160, 120))
      < 1 / 1023)
  end)

  it("reports if there is nothing to estimate it from", function()
    local dark = picture(function(x) return 0, 0.1, x < 5 and 1 or 0, 1 end)
    local texture, message = relight.from { picture = dark, estimate = "grey" }
    assert.is_nil(texture)
    assert.is_truthy(message:find("there is no red in the picture", 1, true))
    texture, message = relight.from { picture = dark, estimate = { at = { 500, 0, 4, 4 } } }
    assert.is_nil(texture)
    assert.is_truthy(message:find("there is nothing in the patch", 1, true))
    texture, message = relight.from { picture = dark, light = { 1, 1, 1 }, uneven = true }
    assert.is_nil(texture)
    assert.is_truthy(message:find "only 0 of 1024 parts of the picture have any red")
    local burnt = celspan.picture { pixels = ("\xff\xff\xff"):rep(16), size = { 4, 4 },
      format = "rgb8" }
    texture, message = relight.from { picture = burnt, estimate = { at = { 0, 0, 4, 4 } } }
    assert.is_nil(texture)
    assert.is_truthy(message:find("100 % of the patch is as bright as the picture can be", 1, true))
  end)
end)

describe("a relit picture in a file", function()
  it_reads("is read back unchanged, with all seven channels", function()
    local texture = assert(relight.from {
      front = { picture = card(LAMP, BLACK), light = LAMP },
      back = { picture = card(BLACK, { 1, 1, 1 }), light = { 1, 1, 1 } } })
    local path = bench.folder .. "/card.exr"
    assert(relight.write(texture, path))
    local read = assert(relight.read(path))
    check_card(read)
    assert.are.equal(0, difference(show(texture, { back = "#ffffff" }),
      show(read, { back = "#ffffff" })))
    local _, out = bench:celspan("info %s", path)
    assert.is_truthy(out:find("medium", 1, true))
  end)

  it_reads("keeps highlights, and looks lit by white light in other programs", function()
    local texture = assert(relight.from { picture = photograph(LAMP), light = LAMP })
    local path = bench.folder .. "/lamp.exr"
    assert(relight.write(texture, path))
    local plain = show(celspan.picture { file = path })
    assert.is_true(plain:get(20, 12) > 4)
    assert.is_true(difference(show(texture), plain) < 1e-6)
    assert.is_true(difference(show(photograph(LAMP)), show((assert(relight.read(path))),
      { front = LAMP })) < 1 / 1023)
  end)

  it_reads("is distinguished from other pictures", function()
    assert(show(photograph(LAMP)):write(bench.folder .. "/plain.exr"))
    local texture, message = relight.read(bench.folder .. "/plain.exr")
    assert.is_nil(texture)
    assert.is_truthy(message:find("is not a relit picture", 1, true))
    texture, message = relight.read(bench.folder .. "/none.exr")
    assert.is_nil(texture)
    assert.is_truthy(message:find("none.exr", 1, true))
    local good
    good, message = relight.write(photograph(LAMP), bench.folder .. "/lamp.png")
    assert.is_nil(good)
    assert.is_truthy(message:find("must end in .exr", 1, true))
  end)
end)

describe("relight.stack", function()
  local function rostrum_of(lamp, ground)
    return celspan.rostrum { back = ground, brightness = 0.5,
      celspan.cel { celspan.circle { centre = { 12, 12 }, radius = 9, texture = "#c08040a0" },
        front = lamp }:named "lamp",
      celspan.cel { celspan.rect { 10.3, 8, 20, 9.5, texture = celspan.gel(0.3, 0.9, 0.5) } } }
  end
  local options = { size = { 40, 30 } }

  it("gives the frame in other lights, named by cel, by index, or as the rostrum's", function()
    local stack = assert(relight.stack(rostrum_of({ 1, 1, 1 }, "#ffffff"), options))
    assert.are.same({ 40, 30 }, { stack.width, stack.height })
    assert.is_true(stack.bytes > 40 * 30 * 16)
    local whole = assert(celspan.pixels(rostrum_of({ 2, 0.5, 0.1 }, { 0.3, 0.2, 0.9, 0.5 }),
      options))
    for _, key in ipairs { "lamp", 1 } do
      local image = assert(stack:light { [key] = { front = { 2, 0.5, 0.1 } },
        [0] = { back = { 0.3, 0.2, 0.9, 0.5 } } })
      assert.is_true(difference(whole, image) < 1 / 65535)
    end
    assert.is_true(difference(assert(celspan.pixels(rostrum_of({ 1, 1, 1 }, "#ffffff"), options)),
      assert(stack:light())) < 1 / 65535) -- it starts from the rostrum's lights each time
  end)

  it("sums codes in a film in srgb, and refuses a rostrum in another space", function()
    local function coded(lamp, ground)
      return rostrum_of(lamp, ground):with { space = "srgb" }
    end
    local stack = assert(relight.stack(coded({ 1, 1, 1 }, "#ffffff"), options))
    local image = assert(stack:light { lamp = { front = "#f26419" }, [0] = { back = "#36a" } })
    local whole = assert(celspan.pixels(coded("#f26419", "#3366aa"), options))
    assert.is_true(difference(whole, image) < 3 / 65535) -- light is steeper than codes
    image = assert(stack:light { lamp = { front = "tomato" } })
    whole = assert(celspan.pixels(coded("#ff6347", "#ffffff"), options))
    assert.is_true(difference(whole, image) < 3 / 65535)
    image = assert(stack:light { lamp = { front = { 0.5, 1, 0.2 } } })
    whole = assert(celspan.pixels(coded({ 0.5, 1, 0.2 }, "#ffffff"), options))
    assert.is_true(difference(whole, image) < 3 / 65535)
    local film = celspan.film { size = { 40, 30 }, frame = function()
      return coded({ 1, 1, 1 }, "#fff")
    end }
    local nothing, message = relight.stack(film)
    assert.is_nil(nothing)
    assert.is_truthy(message:find("the rostrum is in another space than the film", 1, true))
  end)

  it("gives the rostrum's front light to cels without one of their own", function()
    local function make(front)
      return celspan.rostrum { front = front, celspan.cel { front = { 0.5, 0.5, 0.5 },
        celspan.rect { 0, 0, 8, 8, texture = "#ffffff" } },
        celspan.cel { celspan.rect { 4, 0, 8, 8, texture = "#ffffff" } } }
    end
    local image = assert(assert(relight.stack(make { 1, 1, 1 }, { size = { 12, 8 } })):light {
      [0] = { front = { 0.2, 0.4, 0.6 } } })
    assert.is_true(difference(assert(celspan.pixels(make { 0.2, 0.4, 0.6 }, { size = { 12, 8 } })),
      image) < 1 / 65535)
  end)

  it("gives the same part of the whole with a crop, and can be written", function()
    local stack = assert(relight.stack(rostrum_of({ 1, 1, 1 }, "#fff"), { size = { 40, 30 },
      crop = { 5, 4, 20, 11 } }))
    assert.is_true(difference(assert(celspan.pixels(rostrum_of({ 1, 1, 1 }, "#fff"),
      { size = { 40, 30 }, crop = { 5, 4, 20, 11 } })), assert(stack:light {})) < 1 / 65535)
    assert(assert(stack:light()):write(bench.folder .. "/lit.png"))
  end)

  it("is as exact with many pictures over each other, using less memory than floats", function()
    local draw, cels, changes, relit = prng.new(40), {}, {}, {}
    for i = 1, 12 do
      local bytes = {}
      for k = 1, 4 * 150 * 20 do -- more and more opaque to the rear; one is rough
        bytes[k] = string.char(k % 4 == 0 and 220 - 15 * i
          or i == 6 and draw:whole(0, 255) or 20 * i - k // 64 % 20 + draw:whole(0, 1))
      end
      cels[i] = celspan.cel { celspan.image { pixels = table.concat(bytes), size = { 150, 20 },
        format = "rgba8", x = i, y = i % 4 } }
      changes[i] = { front = { draw:between(0, 2), draw:between(0, 2), 2 } }
      relit[i] = cels[i]:with(changes[i])
    end
    local coarse, fine = { size = { 170, 24 } }, { size = { 170, 24 }, tolerance = 2 ^ -18 }
    local function rostrum(of) return celspan.rostrum(of):with { brightness = 2 } end
    local stack = assert(relight.stack(rostrum(cels), coarse))
    for _, pair in ipairs { { cels, {} }, { relit, changes } } do
      local whole = assert(celspan.pixels(rostrum(pair[1]), fine))
      assert.is_true(difference(whole, assert(stack:light(pair[2]))) < 1 / 65535)
    end
    local floats = 12 * 150 * 20 * (3 + 1) -- of fronts, and of grey backs
    assert.is_true(stack.bytes < 0.9 * 4 * floats)
  end)

  it("refuses impossible scenes, with the reason", function()
    local shaped = celspan.rostrum {
      celspan.cel { celspan.rect { 0, 0, 9, 9 }, front = celspan.linear {
      from = { 0, 0 }, to = { 9, 0 }, { 0, "#000" }, { 1, "#fff" } } } }
    local stack, message = relight.stack(shaped, options)
    assert.is_nil(stack)
    assert.are.equal("stack: the front light of cel 1 is a texture; a stack takes flat lights",
      message)
    stack = assert(relight.stack(rostrum_of({ 1, 1, 1 }, "#fff"), options))
    local cases = {
      { { lmap = {} }, "light: there is no cel 'lmap'; did you mean 'lamp'?" },
      { { [3] = {} }, "light: there is no cel '3'" },
      { { [{}] = {}, [{ 1 }] = {} }, "light: there is no cel 'table'" },
      { { lamp = { front = "lamp" } },
        'light[1].front must be {r, g, b} or a colour like "#ffe0b0", got "lamp"' },
      { { lamp = { front = { 1, -1, 0 } } }, "light[1].front[2] must be 0 or more, got -1" },
      { { lamp = { back = { 1, 1, 0, 2 } } }, "light[1].back[4] must be from 0 to 1, got 2" },
      { { lamp = { fornt = "#fff" } }, "light: unknown field 'fornt'; did you mean 'front'?" },
    }
    for _, case in ipairs(cases) do
      assert.are.equal("relight: " .. case[2], (raised(function() stack:light(case[1]) end)))
    end
    assert.are.equal("relight: light: call it as a method, value:light(...), got table",
      (raised(function() stack.light({}) end)))
  end)
end)

describe("celspan relight", function()
  local function write_photograph(light)
    local path = bench.folder .. "/photo.exr"
    assert(show(photograph(light)):write(path, { depth = "float" }))
    return path
  end

  it_reads("shows a picture in another light, highlights included", function()
    local path, out = write_photograph(LAMP), bench.folder .. "/dusk.exr"
    assert.are.same({ 0, "", "" }, { bench:celspan(
      "relight %s -o %s --light 1.4,0.8,0.35 --to 0.2,0.3,0.9 --depth float", path, out) })
    assert.is_true(difference(show(photograph { 0.2, 0.3, 0.9 }),
      show(celspan.picture { file = out })) < 1 / 1023)
  end)

  it_reads("writes a file without the light, which it shows in any light", function()
    local path, bare = write_photograph(LAMP), bench.folder .. "/bare.exr"
    assert.are.equal(0, (bench:celspan("relight %s -o %s --light 1.4,0.8,0.35", path, bare)))
    local back = bench.folder .. "/back.exr"
    assert.are.equal(0, (bench:celspan("relight %s -o %s --to 1.4,0.8,0.35 --depth float", bare,
      back)))
    assert.is_true(difference(show(photograph(LAMP)), show(celspan.picture { file = back }))
      < 1 / 1023)
  end)

  it_reads("refuses missing and impossible arguments, with the documented exit codes", function()
    local path, bare = write_photograph(LAMP), bench.folder .. "/bare.exr"
    assert(relight.write((assert(relight.from { picture = photograph(LAMP), light = LAMP })), bare))
    local black = bench.folder .. "/black.png"
    assert(show("#000000"):write(black))
    local cases = {
      { 2, path .. " --light grey", "-o is missing" },
      { 2, path .. " -o x.exr", "--light is missing" },
      { 2, path .. " -o x.exr --light 1,0,1", "--light: '1,0,1' is not a colour" },
      { 2, path .. " -o x.exr --light warm", "--light: 'warm' is not a colour" },
      { 2, bare .. " -o x.exr", "--to is missing" },
      { 2, bare .. " -o x.png --light grey --to 1,1,1", "has been taken off already" },
      { 2, path .. " -o x.xyz --light grey --to 1,1,1", "xyz" },
      { 3, path .. " -o x.png --light grey", "must end in .exr" },
      { 3, black .. " -o x.exr --light grey", "there is no red in the picture" },
      { 4, bench.folder .. "/none.png -o x.exr --light grey", "none.png" },
      { 5, path .. " -o /proc/none/x.exr --light grey", "/proc/none" },
    }
    for _, case in ipairs(cases) do
      local code, out, err = bench:celspan("relight %s", case[2])
      assert.are.same({ case[1], "" }, { code, out }, err)
      assert.is_truthy(err:find(case[3], 1, true), err)
    end
  end)

  it("accepts colours and three channels as lights, and nothing else", function()
    local function refuses(option, text)
      local arguments = "relight none.png -o x.png --light grey --to 1,1,1 %s '%s'"
      local code, _, err = bench:celspan(arguments, option, text)
      if code == 4 then return false end -- there is no picture
      assert.are.equal(2, code)
      assert.is_truthy(err:find(("%s: '%s' is not a colour like #"):format(option, text), 1, true),
        err)
      return true
    end
    for _, text in ipairs { "1", "1,1", "1,1,1,1", "1,1,-1", "nan,1,1", "1,1,2e6", "1, 1,1",
      "#11223380", "1,,1",
                            "gray", "" } do
      assert.is_true(refuses("--light", text), text)
      assert.is_true(refuses("--to", text), text)
    end
    for _, text in ipairs { "0,1,1", "1,0,1", "1,1,0", "#00ffff", "0,1.5,1e6", "#000" } do
      assert.is_true(refuses("--light", text), text)
      assert.is_false(refuses("--to", text), text)
    end
    for _, text in ipairs { "grey", "1,2,3", "#123" } do
      assert.is_false(refuses("--light", text), text)
    end
  end)
end)

describe("relight.from", function()
  it("raises errors in its arguments at the caller's line", function()
    local taken = photograph(LAMP)
    local cases = {
      { {}, "it takes a picture, or front and back, or over" },
      { { pictur = taken }, "unknown field 'pictur'; did you mean 'picture'?" },
      { { picture = taken }, "a picture needs its light or an estimate of it, but not both" },
      { { picture = 3, light = LAMP },
        "picture must be a file's name or a celspan.picture, got number" },
      { { picture = taken, light = "lamp" },
        'light must be {r, g, b} or a colour like "#ffe0b0", got "lamp"' },
      { { picture = taken, light = { 1, -1, 0 } }, "light[2] must be 0 or more, got -1" },
      { { picture = taken, estimate = "green" },
        'estimate must be "grey" or { at = {x, y, w, h}, colour = ... }, got "green"' },
      { { picture = taken, estimate = true },
        'estimate must be "grey" or { at = {x, y, w, h}, colour = ... }, got boolean' },
      { { picture = taken, light = LAMP, over = {} }, "'over' cannot be combined with 'picture'" },
      { { front = { picture = taken, light = LAMP } },
        "two exposures are front = { picture =, light = } and back = { picture =, light = }" },
      { { over = { 1 } },
        "over must be two pictures, { { picture =, ground = }, { picture =, ground = } }" },
    }
    for _, case in ipairs(cases) do
      assert.are.equal("relight: " .. case[2], (raised(function() relight.from(case[1]) end)))
    end
  end)

  it("returns a texture that is a value like others", function()
    local texture = assert(relight.from { picture = photograph(LAMP), light = LAMP })
    assert.are.equal("house", texture:named("house").name)
    assert.is_truthy(raised(function() texture:with {} end):find "no fields")
  end)
end)
