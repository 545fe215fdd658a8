-- Lights with a shape, and compositions inside others: values, messages, defocus.
local celspan = require "celspan"
local images = require "tests.support.images"
local raised = require("tests.support.raised").sentence
local workbench = require "tests.support.workbench"

local function art() return celspan.rect { 10, 10, 40, 30, texture = "#e0a040" } end
local function small(fields)
  local made = { size = { 80, 60 }, celspan.cel { art() } }
  for name, value in pairs(fields or {}) do made[name] = value end
  return celspan.rostrum(made)
end

local function pixels(rostrum, options)
  options = options or {}
  return assert(celspan.pixels(rostrum,
    { size = options.size or { 80, 60 }, film = options.film or { 80, 60 },
                                          antialias = options.antialias,
                                          workers = options.workers or 1 }))
end

describe("a rostrum with a size", function()
  it("is an object: it can be moved, rotated, faded, measured and probed", function()
    local object = small():scale(2):translate(10, 20):fade(0.5)
    assert.same({ 10, 20, 160, 120 }, { object:bounds() })
    assert.is_true(object:contains(10, 20))
    assert.is_false(object:contains(170, 20))
    assert.same({ 0, 0, 80, 60 }, { small():bounds() })
    assert.equal("rostrum{ 1 cel, brightness = 1, size = {80, 60} }", tostring(object))
  end)

  it("keeps its transform and fade through :with, and returns its fields", function()
    local object = small():translate(5, 0):fade(0.5)
    local wide = object:with { size = { 200, 60 } }
    assert.same({ 5, 0, 200, 60 }, { wide:bounds() })
    assert.same({ 80, 60 }, object.size)
    local r, g, b, a = celspan.probe(celspan.rostrum { celspan.cel { wide } }, 20, 20,
      { film = { 80, 60 } })
    local R, G, B = celspan.probe(small(), 15, 20, { film = { 80, 60 } })
    assert.near(R / 2, r, 1e-6)
    assert.near(G / 2, g, 1e-6)
    assert.near(B / 2, b, 1e-6)
    assert.near(0.5, a, 1e-6)
  end)

  it("can be an operand of booleans, by its frame", function()
    local disc = celspan.circle { centre = { 40, 30 }, radius = 20, texture = "#fff" }
    for _, case in ipairs {
      { small() | disc, 40, 30, true }, { small() & disc, 1, 1, false },
      { disc - small(), 40, 30, false },
      { small() - disc, 1, 1, true }, { small() ~ disc, 40, 30, false },
      { celspan.clip(disc, small():translate(60, 0)), 70, 30, false },
      { celspan.union { small(), disc }, 79, 59, true },
    } do
      assert.equal(case[4], case[1]:contains(case[2], case[3]))
    end
  end)

  it("is refused without a size if an object is needed", function()
    local bare = celspan.rostrum {}
    for _, call in ipairs {
      function() return celspan.cel { bare } end, function() return bare | art() end,
      function() return bare:scale(2) end, function() return celspan.union { art(), bare } end,
      function() return bare:bounds() end,
    } do
      assert.matches("size is missing; a rostrum that is used as an object needs one", raised(call),
        1, true)
    end
  end)

  it("is an object in a frame once it was moved", function()
    local moved, options = small():translate(1, 0), { size = { 8, 6 } }
    local meant = celspan.rostrum { celspan.cel { moved } }
    assert.are.equal(celspan.pixels(meant, options):bytes(), celspan.pixels(moved, options):bytes())
  end)

  it("is refused with an invalid size, and with a camera that sees nothing", function()
    assert.matches("rostrum: size.width is 0; it must be more than 0", raised(function()
      celspan.rostrum { size = { 0, 10 } } end), 1, true)
    assert.matches("rostrum: size%[2%] must be a number, got nil",
                   (raised(function() celspan.rostrum { size = { 5 } } end)))
    assert.matches("viewport and the camera together enlarge or reduce too far", raised(function()
      return celspan.cel { small { camera = { width = 1e-12 } } }
    end), 1, true)
  end)

  it("nests up to 128 levels, booleans counted, and no further", function()
    local value = small()
    for _ = 1, 127 do value = celspan.rostrum { size = { 80, 60 }, celspan.cel { value } } end
    local outer = celspan.cel { value }
    local r = celspan.probe(celspan.rostrum { outer }, 20, 20, { film = { 80, 60 } })
    assert.near(celspan.probe(small(), 20, 20, { film = { 80, 60 } }), r, 1e-6)
    assert.equal(0, images.difference(pixels(small()), pixels(celspan.rostrum { outer })))
    assert.matches("rostrum: nested 129 levels deep; the limit is 128", raised(function()
      return celspan.cel { celspan.rostrum { size = { 80, 60 }, outer } }
    end), 1, true)
  end)

  it("keeps its camera, viewports and lights inside, and is cut at its frame", function()
    local inner = small { back = "#ffffff",
      camera = { centre = { 30, 25 }, width = 40, rotate = 90 },
                          brightness = 0.5, front = "#ff0000" }
    local image = pixels(celspan.rostrum { celspan.cel { inner:translate(20, 10) } },
      { size = { 120, 90 },
                                                                                     film = { 120,
                                                                                       90 } })
    local alone = pixels(inner)
    for _, point in ipairs { { 0, 0 }, { 40, 30 }, { 79, 59 }, { 15, 50 } } do
      local x, y = point[1], point[2]
      local p, q = { alone:get(x, y) }, { image:get(x + 20, y + 10) }
      for c = 1, 4 do assert.near(p[c], q[c], 1e-5) end
    end
    assert.same({ 0, 0, 0, 0 }, { image:get(19, 40) })
    assert.same({ 0, 0, 0, 0 }, { image:get(100, 40) })
  end)

  it("is counted with all its contents", function()
    local file = os.tmpname()
    local out = assert(io.open(file, "w"))
    out:write [[local celspan = require "celspan"
      local inner = celspan.rostrum { size = { 9, 9 }, celspan.cel { celspan.rect { 0, 0, 3, 3 } },
        celspan.cel {} }
      return celspan.rostrum { celspan.cel { inner, inner, celspan.rect { 0, 0, 1, 1 } } }]]
    out:close()
    local pipe = assert(io.popen("'" .. workbench.binary .. "' info " .. file))
    local text = pipe:read "a"
    pipe:close()
    os.remove(file)
    assert.matches("5", text:match "cels[^\n]*")
    assert.matches("3", text:match "primitives[^\n]*")
  end)
end)

describe("defocus and compositions", function()
  local blurred = celspan.cel { art(), defocus = 4 }

  it("blurs inside one as it does outside", function()
    local flat = celspan.rostrum { blurred }
    local nested = celspan.rostrum { celspan.cel { flat:with { size = { 80, 60 } } } }
    assert.is_true(images.difference(pixels(flat), pixels(nested)) < 1e-4)
    -- Twice the film at half the size: half the radius.
    local big = celspan.rostrum { size = { 160, 120 }, blurred:with { defocus = 8 }:scale(2) }
    assert.is_true(images.difference(pixels(flat),
      pixels(celspan.rostrum { celspan.cel { big:scale(0.5) } })) < 1e-3)
  end)

  it("blurs one like its contents", function()
    local nested = celspan.rostrum { celspan.cel { small(), defocus = 4 } }
    assert.is_true(images.difference(pixels(celspan.rostrum { blurred }), pixels(nested)) < 2 / 255)
  end)

  it("blurs one that is blurred inside: the light is kept, with any number of threads", function()
    local inner = celspan.rostrum { size = { 80, 60 }, celspan.cel { art(), defocus = 3 } }
    local twice = celspan.rostrum { celspan.cel { inner, defocus = 3 } }
    local function light(image)
      local sum = 0
      for y = 0, image.height - 1 do
        for x = 0, image.width - 1 do sum = sum + (image:get(x, y)) end
      end
      return sum
    end
    local image = pixels(twice)
    assert.near(light(pixels(celspan.rostrum { celspan.cel { art() } })), light(image), 1)
    assert.equal(0, images.difference(image, pixels(twice, { workers = 3 })))
  end)

  it("blurs a gel that is blurred inside: its channels stay apart", function()
    local gel = celspan.rect { 10, 10, 60, 40, texture = celspan.gel(1, 0.25, 0.125) }
    local inner = celspan.rostrum { size = { 80, 60 }, celspan.cel { gel, defocus = 3 } }
    local image = pixels(celspan.rostrum { back = "#fff", celspan.cel { inner, defocus = 3 } })
    local r, g, b = image:get(40, 30)
    assert.near(1, r, 1e-3)
    assert.near(0.25, g, 1e-3)
    assert.near(0.125, b, 1e-3)
  end)
end)

describe("compositions of the greatest depth", function()
  it("are lit by shapes and faded at every level", function()
    local lamp = celspan.linear { from = { 0, 0 }, to = { 80, 0 }, { 0, "#fff" }, { 1, "#fefefe" } }
    local rostrum = small()
    for _ = 2, 128 do
      rostrum = celspan.rostrum { size = { 80, 60 },
        celspan.cel { rostrum:fade(0.999), front = lamp, opacity = 0.999 } }
    end
    rostrum = celspan.rostrum { celspan.cel { rostrum:fade(0.99), front = lamp, opacity = 0.99 } }
    local p = { celspan.probe(rostrum, 40.5, 30.5, { film = { 80, 60 } }) }
    local q = { pixels(rostrum):get(40, 30) }
    for c = 1, 4 do assert.near(p[c], q[c], 1 / 1023) end
    assert.is_true(q[1] > 0.3)
  end)

  it("are blurred at every level, and the work does not double with it", function()
    local gel = celspan.rect { 10, 10, 60, 40, texture = celspan.gel(1, 0.5, 0.25) }
    local rostrum = celspan.rostrum { size = { 80, 60 }, celspan.cel { gel, defocus = 1 } }
    for _ = 2, 40 do
      rostrum = celspan.rostrum { size = { 80, 60 }, celspan.cel { rostrum, defocus = 1 } }
    end
    local r, g, b, a = pixels(celspan.rostrum { back = "#fff", celspan.cel { rostrum } })
      :get(40, 30)
    assert.near(1, r, 2e-3)
    assert.near(0.5, g, 2e-3)
    assert.near(0.25, b, 2e-3)
    assert.equal(1, a)
  end)
end)

describe("lights of many levels", function()
  it("multiply without limit, and stay finite", function()
    local bright = { 1e12, 1e12, 1e12 }
    local shape = celspan.linear { from = { 0, 0 }, to = { 80, 0 }, { 0, "#000" }, { 1, "#fff" } }
    local value = celspan.rostrum { size = { 80, 60 }, front = bright, celspan.cel { art() } }
    for level = 1, 6 do
      value = celspan.rostrum { size = { 80, 60 }, brightness = 1e12, celspan.cel { value,
        front = level % 2 == 0 and bright or { texture = shape, gain = 1e12 } } }
    end
    local image =
      pixels(celspan.rostrum {
        celspan.cel { value, celspan.rect { 0, 0, 20, 20, texture = "#000" } } })
    for _, point in ipairs { { 5, 5 }, { 15, 15 }, { 30, 30 }, { 70, 50 } } do
      for _, number in ipairs { image:get(point[1], point[2]) } do
        assert.is_true(number < math.huge)
      end
    end
    assert.same({ 0, 0, 0, 1 }, { image:get(15, 15) })
  end)

  it("hold any number of compositions in one list", function()
    local list = {}
    for i = 1, 3000 do list[i] = small() end
    assert.equal(3000, #celspan.union(list))
  end)
end)

describe("a light with a shape", function()
  local white = celspan.rect { 0, 0, 80, 60, texture = "#fff" }
  local slope = celspan.linear { from = { 0, 0 }, to = { 80, 0 }, { 0, celspan.rgb(0, 0, 0) },
    { 1, celspan.rgb(1, 0.5, 0) } }

  local function lit(light, cel)
    return celspan.rostrum { (cel or celspan.cel { white }):with { front = light } }
  end

  it("is gain times beta times pigment", function()
    local image = pixels(lit { texture = slope, gain = 3 })
    local r, g, b, a = image:get(39, 30)
    assert.near(3 * 39.5 / 80, r, 1e-3)
    assert.near(1.5 * 39.5 / 80, g, 1e-3)
    assert.equal(0, b)
    assert.equal(1, a)
    local half = celspan.linear { from = { 0, 0 }, to = { 80, 0 }, { 0, celspan.rgb(1, 1, 1, 0) },
      { 1, celspan.rgb(1, 1, 1, 1) } }
    assert.near(39.5 / 80, (pixels(lit(half)):get(39, 30)), 1e-3)
  end)

  it("makes gradient spans where it is linear", function()
    local rows = assert(celspan.spans(lit(slope), { size = { 80, 60 }, film = { 80, 60 } }))
    assert.equal(1, #rows[30])
    assert.equal("gradient", rows[30][1].kind)
  end)

  it("lies on the frame, or moves with its cel", function()
    local moved = celspan.cel { white }:translate(20, 0)
    assert.near(59.5 / 80, (pixels(lit(slope, moved)):get(59, 30)), 1e-3)
    assert.near(39.5 / 80, (pixels(lit({ texture = slope, on = "cel" }, moved)):get(59, 30)), 1e-3)
  end)

  it("of one paint is that colour everywhere", function()
    for _, light in ipairs { celspan.mix("#804020", "#804020", 0), { texture = "#804020" } } do
      assert.equal(0, images.difference(pixels(lit "#804020"), pixels(lit(light))))
    end
    assert.near(1.5, (pixels(lit { texture = celspan.rgb(1, 1, 1, 0.5), gain = 3 }):get(1, 1)),
      1e-6)
    assert.same({ 0, 0, 0, 1 }, { pixels(lit { texture = celspan.gel(1, 1, 1) }):get(1, 1) })
  end)

  it("can be a back light, with its beta as the matte, and dims nothing in its film", function()
    local beam = celspan.radial { centre = { 40, 30 }, radius = 20,
      { 0, celspan.rgb(1, 0.8, 0.6, 1) }, { 1, celspan.rgb(1, 0.8, 0.6, 0) } }
    local rear = { 0.25, 0.25, 0.25, 0 }
    local image = pixels(celspan.rostrum { back = rear,
      celspan.cel { back = { texture = beam, gain = 2 } } })
    local p = {
      celspan.probe(celspan.rostrum { back = rear,
        celspan.cel { back = { texture = beam, gain = 2 } } }, 50.5, 30.5,
                              { film = { 80, 60 } }) }
    local q = { image:get(50, 30) }
    for c = 1, 4 do assert.near(p[c], q[c], 2e-3) end
    local r, _, _, a = image:get(70, 30)
    assert.near(0.25, r, 1e-6)
    assert.near(0, a, 1e-6)
  end)

  it("may have a matte of its own, which multiplies its beta", function()
    local beam = celspan.linear { from = { 0, 0 }, to = { 80, 0 },
      { 0, celspan.rgb(1, 0.8, 0.6, 0) },
                                  { 1, celspan.rgb(1, 0.8, 0.6, 1) } }
    for _, texture in ipairs { beam, celspan.rgb(1, 0.8, 0.6, 0.5) } do
      for _, matte in ipairs { 0, 0.25, 1 } do
        local behind = celspan.cel {
          celspan.rect { 0, 0, 80, 60, texture = celspan.rgb(0.2, 0.2, 0.2, 0.5) } }
        local rostrum = celspan.rostrum { behind,
          celspan.cel { back = { texture = texture, gain = 2, matte = matte } } }
        local beta = texture == beam and 39.5 / 80 or 0.5
        local expected = { 0.1 + 2 * beta, 0.1 + 1.6 * beta, 0.1 + 1.2 * beta,
          1 - 0.5 * (1 - matte * beta) }
        local probed, shown = { celspan.probe(rostrum, 39.5, 30.5, { film = { 80, 60 } }) },
          { pixels(rostrum):get(39, 30) }
        for c = 1, 4 do
          assert.near(expected[c], probed[c], 1e-6)
          assert.near(expected[c], shown[c], 1e-3)
        end
      end
    end
    assert.matches("cel: back: matte is 2; it must be between 0 and 1", raised(function()
      return celspan.cel { back = { texture = beam, matte = 2 } }
    end), 1, true)
  end)

  it("of a rostrum lies on each cel without one of its own", function()
    local front = { texture = slope, on = "cel" }
    local rostrum = celspan.rostrum { front = front,
      celspan.cel { celspan.rect { 0, 0, 80, 30, texture = "#fff" } }:translate(10, 0),
                                      celspan.cel { celspan.rect { 0, 30, 80, 30,
                                        texture = "#fff" }, front = "#fff" } }
    local image = pixels(rostrum)
    assert.near(29.5 / 80, (image:get(39, 10)), 1e-3)
    assert.equal(1, (image:get(39, 40)))
  end)

  it("is refused with a sentence when it is invalid", function()
    local function message(light, field)
      return raised(function() return celspan.cel { [field or "front"] = light } end)
    end
    assert.matches("cel: front: gain is -1; it must be 0 or more",
      message { texture = slope, gain = -1 }, 1, true)
    assert.matches("cel: front: unknown field 'gian'; did you mean 'gain'?",
      message { texture = slope, gian = 1 }, 1, true)
    assert.matches("cel: front: field 'fill' must be a paint, a texture or a colour",
      message { gain = 1 }, 1, true)
    assert.matches("frame", message { texture = slope, on = "film" }, 1, true)
    for _, light in ipairs { { 1, 1, 1, texture = slope }, { 1, 1, 1, gain = 2 },
      { 1, 1, 1, on = "cel" } } do
      assert.matches("cel: front: takes named fields only, but was given a value at place 1",
        message(light), 1, true)
    end
    assert.matches("rostrum: back cannot be on a cel", raised(function()
      return celspan.rostrum { back = { texture = slope, on = "cel" } }
    end), 1, true)
  end)
end)

describe("a union of many", function()
  --- Clips of drawings, in rows of 20, which overlap their neighbours.
  local function many()
    local list = {}
    for i = 0, 299 do
      local x, y = 4 * (i % 20), 4 * (i // 20)
      local drawing = celspan.union { celspan.rect { x, y, 4, 3, texture = "#c33c" },
        celspan.circle { centre = { x + 3, y + 2 }, radius = 3, texture = "#36c8" } }
      list[i + 1] = celspan.clip(drawing, celspan.rect { x, y + 0.3, 5, 4, radius = 1 })
    end
    return list
  end

  it("is the same as its operands in a list", function()
    local list = many()
    for _, mode in ipairs { "none", "area" } do
      local options = { antialias = mode }
      images.alike(0, images.of(list, 80, 60, options),
        images.of({ celspan.union(list) }, 80, 60, options))
    end
  end)

  it("is in other booleans what the oracle sees", function()
    local union = celspan.union(many())
    local disc = celspan.circle { centre = { 40, 30 }, radius = 25, texture = "#fc0" }
    for _, object in ipairs { disc - union, union - disc, union ~ disc, union & disc,
                              celspan.clip(union, disc) } do
      local image = images.of({ object }, 80, 60, { antialias = "none" })
      local rostrum = celspan.rostrum { celspan.cel { object } }
      for i = 0, 799 do
        local x, y = i * 7 % 80, i * 11 % 60
        images.near({ celspan.probe(rostrum, x + 0.5, y + 0.5, { film = { 80, 60 } }) }, image, x,
          y, 1e-5)
      end
    end
  end)
end)
