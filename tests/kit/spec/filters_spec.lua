-- Filters from Lua: antialiasing kernels.
local celspan = require "celspan"
local raised = require "tests.support.raised"

local SIZE = { 24, 16 }

local function edge(antialias, x)
  return celspan.rostrum {
    celspan.cel { celspan.rect { x or 12, -50, 100, 200, texture = "#ffffff" } },
    antialias = antialias,
  }
end

local function pixels(rostrum, options)
  options = options or {}
  options.size = SIZE
  return assert(celspan.pixels(rostrum, options))
end

local function sentence(call)
  return (raised.sentence(call))
end

describe("antialiasing kernels", function()
  it("can be a function of the script", function()
    local tent = { kernel = function(x) return 1 - math.abs(x) end, radius = 1 }
    local image = pixels(edge(tent, 12.25))
    for p = 0, 23 do
      local d = p + 0.5 - 12.25 -- the tent's integral: two parabolas
      local want = d <= -1 and 0 or d >= 1 and 1 or d < 0 and (1 + d) ^ 2 / 2 or 1 - (1 - d) ^ 2 / 2
      assert.is_near(want, (image:get(p, 7)), 0.002)
    end
  end)

  it("are called only while the rostrum is made", function()
    local calls = 0
    local rostrum = edge { kernel = function() calls = calls + 1 return 1 end, radius = 1 }
    local made = calls
    assert.is_true(made > 0)
    pixels(rostrum)
    assert.are.equal(made, calls)
  end)

  it("replace the rostrum's own in a render", function()
    local image = pixels(edge("none", 12.25), { antialias = { kernel = "box", radius = 1 } })
    assert.is_near(0.625, (image:get(12, 3)), 0.002)
    image = pixels(edge({ kernel = "gaussian" }, 12.25), { antialias = "none" })
    assert.are.equal(1, (image:get(12, 3)))
  end)

  it("do not filter at radius 0", function()
    local none, zero = pixels(edge("none", 12.3)),
      pixels(edge({ kernel = "box", radius = 0 }, 12.3))
    for p = 0, 23 do assert.are.equal((none:get(p, 5)), (zero:get(p, 5))) end
  end)

  it("clamp a ringing kernel to the range of the colours under it", function()
    local image = pixels(edge { kernel = "lanczos" })
    for p = 0, 23 do
      local r, _, _, a = image:get(p, 5)
      assert.is_true(r >= 0 and r <= 1 and a >= 0 and a <= 1)
    end
  end)

  it("make the same rows with any number of workers", function()
    local rostrum = celspan.rostrum {
      celspan.cel { celspan.circle { centre = { 11, 8 }, radius = 6, texture = "#ff8040c0" } },
      antialias = { kernel = "mitchell", radius = 2.5 },
    }
    local one, four = pixels(rostrum, { workers = 1 }), pixels(rostrum, { workers = 4 })
    local part = pixels(rostrum, { crop = { 5, 3, 9, 8 } })
    for y = 0, 15 do
      for x = 0, 23 do
        assert.are.same({ one:get(x, y) }, { four:get(x, y) })
        if x >= 5 and x < 14 and y >= 3 and y < 11 then
          assert.are.same({ one:get(x, y) }, { part:get(x - 5, y - 3) })
        end
      end
    end
  end)

  it("are refused with a sentence", function()
    local cases = {
      { "rostrum: antialias: radius is -2; it must be between 0 and 256",
        { kernel = "box", radius = -2 } },
      { "rostrum: antialias: field 'radius' must be a finite number, got nan",
        { kernel = "box", radius = 0 / 0 } },
      { "rostrum: antialias: field 'radius' must be a finite number, got inf",
        { kernel = function() return 1 end, radius = math.huge } },
      { "rostrum: antialias: radius is missing; a kernel given as a function needs one",
        { kernel = function() return 1 end } },
      { "rostrum: antialias: the kernel sums to nothing within its radius of 2",
        { kernel = function(x) return x end, radius = 2 } },
      { "rostrum: antialias: the kernel's value at -0.9995117 must be a finite number, got inf",
        { kernel = function() return 1 / 0 end, radius = 1 } },
      { "rostrum: antialias: the kernel function must return a number, got nil at "
        .. "x = -0.99951171875", { kernel = function() end, radius = 1 } },
      { "rostrum: antialias: rows is 0; it must be between 1 and 256",
        { kernel = "box", rows = 0 } },
      { "rostrum: antialias: rows is 1000; it must be between 1 and 256",
        { kernel = "box", rows = 1000 } },
    }
    for _, case in ipairs(cases) do
      assert.are.equal(case[1], sentence(function() edge(case[2]) end))
    end
    assert.are.equal("out of ink",
      sentence(function() edge { kernel = function() error "out of ink" end, radius = 1 } end))
  end)
end)

describe("defocus", function()
  local function frame(defocus, options)
    options = options or {}
    options.size, options.film = options.size or { 48, 32 }, { 24, 16 }
    return assert(celspan.pixels(celspan.rostrum {
      celspan.cel { celspan.rect { 10, -50, 4, 200, texture = "#ffffff" }, defocus = defocus },
    }, options))
  end

  it("spreads a bar by the kernel, in film units", function()
    local image = frame { radius = 2, kernel = "box" } -- four pixels on either side
    for p = 0, 47 do
      local d = math.abs((p + 0.5) / 2 - 12) -- a tent: a bar of 4 under a box of 4
      assert.is_near(math.max(0, 1 - d / 4), (image:get(p, 9)), 0.002)
    end
    local large = frame({ radius = 2, kernel = "box" }, { size = { 480, 320 } })
    for p = 0, 47 do
      assert.is_near((image:get(p, 9)), (large:get(p * 10 + 5, 99)), 0.02)
    end
  end)

  it("is a Gaussian of half its radius if only a radius is given", function()
    local image = frame(3)
    local function below(x) -- of a Gaussian with sigma 1.5, by Simpson's rule
      local sum, n = 0, 2000
      for i = 0, n - 1 do
        local t = -9 + (x + 9) * (i + 0.5) / n
        sum = sum + math.exp(-t * t / 4.5) * (x + 9) / n
      end
      return sum / math.sqrt(4.5 * math.pi)
    end
    for p = 0, 47 do
      local x = (p + 0.5) / 2
      assert.is_near(below(x - 10) - below(x - 14), (image:get(p, 9)), 0.002)
    end
  end)

  it("does not change distant pixels, and has no effect at radius 0", function()
    local sharp, none = frame(nil), frame(0)
    for p = 0, 47 do assert.are.equal((sharp:get(p, 3)), (none:get(p, 3))) end
    local image = frame { radius = 1, kernel = "disc" }
    assert.are.equal(1, (image:get(24, 3)))
    assert.are.equal(0, (image:get(40, 3)))
  end)

  it("filters a procedure, pictures of gels, and art outside the film", function()
    local bars = celspan.scanline { bounds = { -20, -20, 80, 80 },
      spans = function() return { { -20, 12, "#ffffff" } } end }
    local image = assert(celspan.pixels(celspan.rostrum {
      celspan.cel { bars, defocus = { radius = 4, kernel = "box" } } }, { size = { 24, 16 } }))
    assert.is_near(0.5 - 0.5 / 8, (image:get(12, 0)), 0.004)
    assert.is_near(1, (image:get(0, 15)), 1e-6)
    local gel = celspan.rect { -50, -50, 62, 200, texture = celspan.gel(1, 0, 0) }
    image = assert(celspan.pixels(celspan.rostrum {
      celspan.cel { gel, defocus = { radius = 4, kernel = "box" } }, back = "#fff" },
      { size = { 24, 16 } }))
    local r, g = image:get(12, 5)
    assert.is_near(1, r, 1e-6)
    assert.is_near(0.5 + 0.5 / 8, g, 0.004)
  end)

  it("makes the same rows with any number of workers and in a crop", function()
    for _, kernel in ipairs { "gaussian", "box", "disc" } do
      local defocus = { radius = 1.3, kernel = kernel }
      local one = frame(defocus, { workers = 1 })
      local four = frame(defocus, { workers = 4 })
      local part = frame(defocus, { crop = { 11, 5, 30, 20 } })
      for y = 0, 31 do
        for x = 0, 47 do
          assert.are.same({ one:get(x, y) }, { four:get(x, y) })
          if x >= 11 and x < 41 and y >= 5 and y < 25 then
            assert.are.same({ one:get(x, y) }, { part:get(x - 11, y - 5) })
          end
        end
      end
    end
  end)

  it("is refused with a sentence", function()
    for radius, words in pairs { [-1] = "is -1",
      [math.huge] = "must be a finite number, got inf" } do
      assert.truthy(sentence(function() celspan.cel { defocus = radius } end)
        :find("cel: defocus.radius " .. words, 1, true))
    end
  end)
end)
