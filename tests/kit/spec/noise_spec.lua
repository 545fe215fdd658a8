-- Noise as a texture: frames beside the probe, its fields, and grain of films and cels. Closed
-- forms are in tests/core/unit/test_noise.c.
local celspan = require "celspan"
local images = require "tests.support.images"

local pixels, assert_alike = images.of, images.alike

local KINDS = { "perlin", "value", "fractal", "turbulence", "cells", "white" }

local function rect(w, h, texture) return celspan.rect { 0, 0, w, h, texture = texture } end

local function close(expected, given, tolerance, message)
  assert.is_true(math.abs(expected - given) <= tolerance,
    ("%s: %s instead of %s"):format(message or "", given, expected))
end

--- A still film of objects.
local function still(objects, fields)
  local all = { size = { 60, 40 }, frame = function()
    return celspan.rostrum { celspan.cel(objects) }
  end }
  for name, value in pairs(fields or {}) do all[name] = value end
  return celspan.film(all)
end

--- The codes of a film's frame: their means and their standard deviations, by channel.
local function measure(film, frame)
  local bytes = assert(celspan.pixels(film, { frame = frame })):bytes()
  local sums, squares, count = { 0, 0, 0, 0 }, { 0, 0, 0, 0 }, #bytes // 4
  for i = 1, #bytes do
    local c, code = (i - 1) % 4 + 1, bytes:byte(i) / 255
    sums[c], squares[c] = sums[c] + code, squares[c] + code * code
  end
  local deviations = {}
  for c = 1, 4 do
    sums[c] = sums[c] / count
    deviations[c] = math.max(0, squares[c] / count - sums[c] ^ 2) ^ 0.5
  end
  return sums, deviations, bytes
end

describe("noise", function()
  it("is in frames what the probe sees, also tilted and between whole `at`", function()
    for _, kind in ipairs(KINDS) do
      for i, at in ipairs { 0, 0.3, -7.75 } do
        local noise = celspan.noise { kind = kind, size = 90, seed = 3, at = at,
          octaves = (kind == "fractal" or kind == "turbulence") and 3 or nil,
          colours = { "#f00", "#00f8", "#fff" },
          matrix = i == 3 and { 1, 0.2, 3, -0.1, 1, 0, 0.001, 0, 1 } or nil }
        local rostrum = celspan.rostrum { celspan.cel { rect(60, 40, noise) } }
        local image = assert(celspan.pixels(rostrum, { size = { 60, 40 }, film = { 60, 40 } }))
        local floats = image:bytes { depth = "float", alpha = "premultiplied" }
        for y = 0, 39, 13 do
          for x = 0, 59, 7 do
            local seen = { celspan.probe(rostrum, x + 0.5, y + 0.5, { film = { 60, 40 } }) }
            for c = 1, 4 do
              close(seen[c], string.unpack("<f", floats, 16 * (60 * y + x) + 4 * c - 3), 2e-5, kind)
            end
          end
        end
      end
    end
  end)

  it("moves with its primitive and by its matrix", function()
    local noise = celspan.noise { kind = "cells", size = 30 }
    local moved = celspan.noise { kind = "cells", size = 30,
      matrix = { 1, 0, 12, 0, 1, 5, 0, 0, 1 } }
    assert_alike(1e-5, pixels({ rect(60, 40, moved) }, 60, 40),
      pixels({ celspan.rect { -12, -5, 60, 40, texture = noise }:translate(12, 5) }, 60, 40))
  end)

  it("of another seed is another noise, and of the same the same", function()
    local function shown(fields)
      return select(3, measure(still { rect(60, 40, celspan.noise(fields)) }))
    end
    assert.equal(shown { size = 9 }, shown { size = 9, seed = 0, at = 0 })
    assert.not_equal(shown { size = 9 }, shown { size = 9, seed = 1 })
    assert.not_equal(shown { size = 9 }, shown { size = 9, at = 0.5 })
    assert.not_equal(shown { size = 9 }, shown { size = 9, kind = "value" })
  end)

  it("of tiny cells is their mean, unless it does not fade", function()
    local noise = { kind = "perlin", size = 1e-9, colours = { "#000", "#fff" } }
    local means, deviations = measure(still({ rect(60, 40, celspan.noise(noise)) },
      { space = "srgb" }))
    close(0.5, means[1], 0.003)
    assert.equal(0, deviations[1])
    noise.fade = false
    means, deviations = measure(still({ rect(60, 40, celspan.noise(noise)) }, { space = "srgb" }))
    close(0.5, means[1], 0.02)
    assert.is_true(deviations[1] > 0.1)
  end)

  it("of huge cells is one colour", function()
    local _, deviations = measure(still { rect(60, 40, celspan.noise { size = 1e9 }) })
    assert.is_true(deviations[1] < 1e-3)
  end)

  it("is a light, too, and lies under grades, modes and defocus", function()
    local noise = celspan.noise { size = 30, colours = { "#0ff", "#0000" } }
    local film = still { rect(60, 40, "#888"), rect(50, 40, noise):blend "multiply":blur(3) }
    assert.is_true(select(2, measure(film))[1] > 0.01)
    local lit = celspan.film { size = { 60, 40 }, frame = function()
      return celspan.rostrum { celspan.cel { rect(60, 40, "#fff"), front = noise,
        defocus = 2, grade = { exposure = -1 } } }
    end }
    assert.is_true(select(2, measure(lit))[2] > 0.01)
  end)

  it("is refused in a plane", function()
    local film = still { rect(60, 40, celspan.noise {}) }
    local plane, message = celspan.plane(film)
    assert.is_nil(plane)
    assert.is_truthy(message:find("noise is in view", 1, true), message)
  end)

  it("refuses what is wrong", function()
    local cases = {
      ["noise: size is 0; it must be more than 0"] = { size = 0 },
      ["size"] = { size = 0 / 0 },
      ["noise: field 'octaves' needs the kind"] = { octaves = 3 },
      ["noise: field 'gain' needs the kind"] = { kind = "cells", gain = 0.5 },
      ["octaves"] = { kind = "fractal", octaves = 17 },
      ["noise: field 'colours' must be a list of 2 to 64 colours"] = { colours = { "#fff" } },
      ["noise: colour 2 must be a paint"] = { colours = { "#fff", "nothing" } },
      ["kind"] = { kind = "clouds" },
      ["'at'"] = { at = math.huge },
      ["seed"] = { seed = 0.5 },
    }
    for expected, fields in pairs(cases) do
      local done, message = pcall(celspan.noise, fields)
      assert.is_false(done, expected)
      assert.is_truthy(message:find(expected, 1, true), message .. " instead of " .. expected)
    end
  end)
end)

describe("grain", function()
  local function grey(grain, fields)
    local all = { size = { 200, 150 }, frames = 3, grain = grain, frame = function()
      return celspan.rostrum { back = "#808080" }
    end }
    for name, value in pairs(fields or {}) do all[name] = value end
    return celspan.film(all)
  end

  it("of a film has the deviation in codes, is grey, and keeps the mean", function()
    for _, space in ipairs { "linear", "srgb" } do
      for _, amount in ipairs { 0, 0.02, 0.05, 0.2 } do
        for _, size in ipairs { 0.5, 1.5, 6 } do
          local means, deviations = measure(grey({ amount = amount, size = size },
            { space = space }), 1)
          close(128 / 255, means[1], 0.004 + 0.02 * amount * size)
          close(amount, deviations[1], 0.001 + 0.06 * amount)
          assert.equal(means[1], means[3])
          assert.equal(1, means[4])
        end
      end
    end
  end)

  it("is another one in each frame and with each seed, and the same again", function()
    local function bytes(grain, frame) return select(3, measure(grey(grain), frame)) end
    assert.equal(bytes({}, 2), bytes({}, 2))
    assert.not_equal(bytes({}, 1), bytes({}, 2))
    assert.not_equal(bytes({}, 1), bytes({ seed = 1 }, 1))
  end)

  it("is where the art is, and leaves its alpha", function()
    local function film(of_cel, of_film)
      return celspan.film { size = { 60, 40 }, grain = of_film, frame = function()
        return celspan.rostrum { celspan.cel { grain = of_cel,
          celspan.circle { centre = { 25.3, 20.7 }, radius = 14, texture = "#c84" },
          celspan.circle { centre = { 44, 20 }, radius = 12, texture = "#48c8" } } }
      end }
    end
    local plain = select(3, measure(film(), 1))
    for _, grain in ipairs { film({ amount = 0.1 }), film(nil, { amount = 0.1 }) } do
      local bytes, differs = select(3, measure(grain, 1)), 0
      for i = 1, #plain, 4 do
        local alpha = plain:byte(i + 3)
        assert.is_true(math.abs(alpha - bytes:byte(i + 3)) <= 1)
        if plain:sub(i, i + 2) ~= bytes:sub(i, i + 2) then differs = differs + 1 end
      end
      assert.is_true(differs > 500)
    end
  end)

  it("of a cel is that of its frame, whatever else the frame asks for", function()
    local other = grey()
    local film = celspan.film { size = { 60, 40 }, frames = 2, frame = function()
      other:at(1)
      return celspan.rostrum { celspan.cel { grain = { amount = 0.1 }, rect(60, 40, "#888") } }
    end }
    local first, second = select(3, measure(film, 1)), select(3, measure(film, 2))
    assert.are_not.equal(first, second)
    assert.equal(first, (select(3, measure(film, 1))))
  end)

  it("of no amount leaves the picture as it is", function()
    local function shown(grain)
      return select(3, measure(celspan.film { size = { 60, 40 }, grain = grain, frame = function()
        return celspan.rostrum { back = "#345", front = "#fed",
          camera = { rotate = 0.2, centre = { 20, 10 }, width = 50 },
          celspan.cel { rect(30, 20, "#c84"), defocus = 3 } }
      end }, 1))
    end
    local plain, grainy, most = shown(), shown { amount = 0 }, 0
    for i = 1, #plain do most = math.max(most, math.abs(plain:byte(i) - grainy:byte(i))) end
    assert.is_true(most <= 1, most)
  end)

  it("reaches as far beyond the frame as filters read", function()
    local function shown(grain, kernel, crop, workers)
      local film = celspan.film { size = { 30, 20 }, grain = grain, frame = function()
        return celspan.rostrum { back = "#357", antialias = kernel,
          camera = { centre = { 14, 9 }, width = 26 },
          celspan.cel { celspan.circle { centre = { 1, 2 }, radius = 7, texture = "#fc8" } } }
      end }
      return assert(celspan.pixels(film, { crop = crop, workers = workers,
        size = { 40, 27 } })):bytes { depth = 16 }
    end
    for _, kernel in ipairs { { kernel = "gaussian" }, { kernel = "lanczos" },
      { kernel = "box", radius = 4 } } do
      local plain, bare, grainy = shown(nil, kernel), shown({ amount = 0 }, kernel),
        shown({ amount = 0.1 }, kernel)
      local most, alpha = 0, 65535
      for at = 1, #plain, 2 do
        local code = ("<I2"):unpack(bare, at)
        most = math.max(most, math.abs(code - ("<I2"):unpack(plain, at)))
        if at % 8 == 7 then alpha = math.min(alpha, (("<I2"):unpack(grainy, at))) end
      end
      assert.is_true(most <= 1, ("%s: %d"):format(kernel.kernel, most))
      assert.equal(65535, alpha, kernel.kernel)
      assert.equal(grainy, shown({ amount = 0.1 }, kernel, nil, 2))
      local part = shown({ amount = 0.1 }, kernel, { 33, 0, 7, 27 })
      for y = 0, 26 do
        assert.equal(grainy:sub(y * 320 + 265, y * 320 + 320), part:sub(y * 56 + 1, y * 56 + 56))
      end
    end
  end)

  it("is in all exposures of a frame", function()
    local film = grey({ amount = 0.05 }, { frame = function()
      local half = { celspan.rostrum { back = "#808080" }, 0.5 }
      return { half, half }
    end })
    close(0.05, select(2, measure(film, 1))[1], 0.004)
  end)

  --- A film whose rostrum has named cels, lights, a camera and a mode.
  local function named(fields, options)
    local all = { size = { 60, 40 }, frames = 2, frame = function()
      local parts = { back = "#345", front = "#fed",
        camera = { rotate = 20, centre = { 20, 10 }, width = 50 },
        celspan.cel { rect(30, 20, "#c84") }:named "ground",
        celspan.cel { rect(20, 60, "#48c"), blend = "multiply" }:named "shade" }
      for name, value in pairs(options or {}) do parts[name] = value end
      return celspan.rostrum(parts)
    end }
    for name, value in pairs(fields or {}) do all[name] = value end
    return celspan.film(all)
  end

  it("of a film leaves cels their names and places, and the camera does not move it", function()
    local film = named { grain = { amount = 0.1 } }
    local shown, names = film:at(2), {}
    for i, cel in ipairs(shown) do names[i] = cel.name end
    assert.same({ "ground", "shade" }, names)
    assert.same({ amount = 0.1, frame = 2 }, shown.grain)
    local fixed = celspan.film { size = { 60, 40 }, grain = { amount = 0.1 }, frame = function()
      return celspan.rostrum { back = "#345", camera = { width = 7, rotate = 30 } }
    end }
    local moved = fixed:with { frame = function() return celspan.rostrum { back = "#345" } end }
    assert.equal(select(3, measure(fixed, 1)), (select(3, measure(moved, 1))))
  end)

  it("of a rostrum is that of a film, also where the rostrum is an object", function()
    local of_film = select(3, measure(named { grain = { amount = 0.1 } }, 2))
    assert.equal(of_film, (select(3, measure(named({}, { grain = { amount = 0.1 } }), 2))))
    assert.equal(of_film, (select(3, measure(named({ grain = { seed = 9 } },
      { grain = { amount = 0.1, frame = 2 } }), 1))), "its own is first")
    local nested = celspan.film { size = { 60, 40 }, frame = function()
      local inner = named({}, { grain = { amount = 0.1, frame = 2 } }):at(1)
      return celspan.rostrum { celspan.cel { inner:with { size = { 60, 40 } } } }
    end }
    local far = 0
    for i, byte in ipairs { (select(3, measure(nested, 1))):byte(1, -1) } do
      far = math.max(far, math.abs(byte - of_film:byte(i)))
    end
    assert.is_true(far <= 1, far)
  end)

  it("is seen by probe", function()
    for _, space in ipairs { "linear", "srgb" } do
      local film = named { grain = { amount = 0.2, size = 8 }, space = space }
      local image = assert(celspan.pixels(film, { antialias = "none" }))
      for y = 1, 38, 3 do
        for x = 1, 58, 3 do
          images.near({ celspan.probe(film, x + 0.5, y + 0.5) }, image, x, y, 1e-4)
        end
      end
    end
  end)

  it("refuses what is wrong", function()
    for expected, grain in pairs { ["amount"] = { amount = 0.5 }, ["size"] = { size = 0 },
      ["must be {amount =, size =, seed =, frame =}, got number"] = 3,
      ["strength"] = { strength = 1 }, ["frame"] = { frame = 1.5 } } do
      for _, make in ipairs { celspan.cel, celspan.rostrum,
        function(fields) return grey(fields.grain) end } do
        local done, message = pcall(make, { grain = grain })
        assert.is_false(done)
        assert.is_truthy(message:find(expected, 1, true), message)
      end
    end
  end)
end)
