-- Exact area antialiasing against many pixel centres, and its promise that abutting shapes never
-- leak.
--
-- CASE=n runs one random scene alone and prints it; tests/support/cases.lua determines which are
-- tried.
local celspan = require "celspan"
local cases = require "tests.support.cases"
local present = require "tests.support.present"
local prng = require "tests.support.prng"
local scenes = require "tests.support.scenes"
local supersample = require "tests.support.supersample"

local COUNT, ONLY = 100, cases.only
local KEPT = { 520, 13472, 17436 } -- light below 0, by a change of hue
local CODE = 1 / 255
local MOST = 2 * CODE -- the allowed error of a pixel
local RMS = 0.1 * CODE

local function area(exposures, size, film)
  return assert(celspan.pixels(exposures, { size = size, film = film, antialias = "area",
                                            workers = 1 }))
end

-- ---------------------------------------------------------------- random scenes

--- Wrong pixels of a random scene at a size where shapes are small: nil or a sentence. A coarse
--- reference finds suspicious ones, a fine one decides.
local function judge(case)
  local script, traits = scenes.script(case, { is_flat = true, is_single = true, has_rows = false })
  if ONLY then print(script) end
  local random = prng.new(-case)
  local size = { random:whole(4, 24), random:whole(4, 20) }
  local film = { traits.width, traits.height }
  local exposures = scenes.load(script):at(1)
  local image = area(exposures, size, film)
  local coarse = supersample.means(exposures, { size = size, film = film, k = 24 })
  local light = math.max(1, traits.light)
  local most, _, x, y = supersample.errors(image, coarse)
  if most <= 4 * CODE * light then return end
  local fine = supersample.means(exposures, { size = size, film = film, k = 512,
                                              crop = { x, y, 1, 1 } })
  local pixel, worst = { image:get(x, y) }, 0
  for c = 1, 4 do worst = math.max(worst, math.abs(pixel[c] - fine[c])) end
  if worst > MOST * light then
    return ("CASE=%d at %dx%d: pixel %d, %d is off by %.2f of 255: %s, should be %s"):format(
      case, size[1], size[2], x, y, worst * 255, table.concat(pixel, " "), table.concat(fine, " "))
  end
end

describe("area antialiasing", function()
  it("is the mean of many pixel centres, in random scenes of small shapes", function()
    local failures = {}
    for _, case in cases.of(COUNT, KEPT) do failures[#failures + 1] = judge(case) end
    assert.are.equal("", table.concat(failures, "\n"))
  end)
end)

-- ---------------------------------------------------------------- pictures of triangles

--- Triangles in 64 x 64 on white.
local function triangles(count, alpha, seed)
  local random = prng.new(seed)
  local function coordinate() return random:between(-6, 70) end
  local objects = { celspan.rect { -1, -1, 70, 70, texture = "#fff" } }
  for _ = 1, count do
    objects[#objects + 1] = celspan.triangle {
      { coordinate(), coordinate() }, { coordinate(), coordinate() },
      { coordinate(), coordinate() },
      texture = celspan.rgb(random:between(0, 1), random:between(0, 1), random:between(0, 1),
        alpha),
    }
  end
  return celspan.rostrum { celspan.cel(objects) }
end

describe("area antialiasing of 40 triangles", function()
  for name, alpha in pairs { opaque = 1, translucent = 0.5 } do
    it("has an error of at most two codes if they are " .. name, function()
      local rostrum, size = triangles(40, alpha, 7), { 64, 64 }
      local means = supersample.means(rostrum, { size = size, k = 64 })
      local most, rms = supersample.errors(area(rostrum, size), means)
      assert.is_true(most <= MOST, ("greatest error %.3f of 255"):format(most * 255))
      assert.is_true(rms <= RMS, ("rms error %.4f of 255"):format(rms * 255))
    end)
  end
end)

-- ---------------------------------------------------------------- the benchmark's scenes

local function bench_scene(path, side)
  local objects = { celspan.rect { 0, 0, side, side, texture = "#fff" } }
  for line in io.lines(path) do
    local numbers = {}
    for word in line:gmatch "%S+" do numbers[#numbers + 1] = tonumber(word) end
    if #numbers == 12 then
      local points = {}
      for i = 5, 11, 2 do points[#points + 1] = { numbers[i] * side, numbers[i + 1] * side } end
      objects[#objects + 1] = celspan.nurbs {
        points = points, degree = 3, rule = "evenodd",
        texture = celspan.rgb(numbers[1] / 255, numbers[2] / 255, numbers[3] / 255,
          numbers[4] / 255),
      }
    end
  end
  return celspan.rostrum { celspan.cel(objects) }
end

describe("area antialiasing of random B-splines", function()
  local material = present.material
  for _, count in ipairs { 10, 100, 1000 } do
    it(("has an error of at most two codes with %d shapes"):format(count), function()
      if not material then return pending "CELSPAN_MATERIAL is not set" end
      local side = 1000
      local rostrum = bench_scene(("%s/bench-scenes/scene%d.txt"):format(material, count), side)
      local square, rows = 0, 0
      for y = 37, side - 1, 163 do
        local crop = { 300, y, 400, 1 }
        local options = { size = { side, side }, crop = crop, workers = 1 }
        local image = assert(celspan.pixels(rostrum, options))
        local means = supersample.means(rostrum, { size = { side, side }, crop = crop, k = 64 })
        local most, rms = supersample.errors(image, means)
        assert.is_true(most <= MOST, ("row %d: greatest error %.3f of 255"):format(y, most * 255))
        square, rows = square + rms ^ 2, rows + 1
      end
      local rms = (square / rows) ^ 0.5
      assert.is_true(rms <= RMS, ("rms error %.4f of 255"):format(rms * 255))
    end)
  end
end)

-- ---------------------------------------------------------------- very many boundaries

--- A polygon that goes up and down through a frame `count` times, from its first row to its last.
local function tangle(random, count, width, height, texture)
  local fields = { rule = "evenodd", texture = texture }
  for i = 1, count do
    local y = random:between(-0.5, 0.5)
    fields[i] = { random:between(0.3, width - 0.4), i % 2 == 0 and y or height + y }
  end
  return celspan.polygon(fields)
end

describe("area antialiasing of thousands of boundaries in a few pixels", function()
  it("is the mean of many pixel centres, over and under shapes, flat and with gradients", function()
    local random, width, height = prng.new(3), 3, 2
    local ramp = celspan.linear { from = { 0, 0 }, to = { width, 0 }, { 0, "#840" }, { 1, "#048" } }
    for _, texture in ipairs { celspan.rgb(1, 1, 1), ramp } do
      local rostrum = celspan.rostrum { celspan.cel {
        celspan.rect { -9, -9, 20, 20, texture = "#246" },
        celspan.circle { centre = { 0.7, 1.1 }, radius = 0.6, texture = "#fc0" },
        tangle(random, 2600, width, height, texture),
        celspan.circle { centre = { 2.1, 1 }, radius = 0.6, texture = "#3c6" } } }
      local size = { width, height }
      local means = supersample.means(rostrum, { size = size, film = size, k = 128 })
      local _, rms = supersample.errors(area(rostrum, size, size), means)
      assert.is_true(rms <= CODE, ("rms error %.3f of 255"):format(rms * 255))
    end
  end)
end)

-- ---------------------------------------------------------------- no leaks

--- Wedges of a wheel around (16, 16), each from one spoke to the next.
local function wedges(count, radius)
  local spokes, list = {}, {}
  for i = 0, count - 1 do
    local angle = (i + 0.3) * 2 * math.pi / count
    spokes[i] = { 16.123 + radius * math.cos(angle), 15.877 + radius * math.sin(angle) }
  end
  for i = 0, count - 1 do
    list[i + 1] = celspan.triangle { { 16.123, 15.877 }, spokes[i], spokes[(i + 1) % count],
                                     texture = "#000" }
  end
  return list
end

--- The distance from (16, 16) within which the centres of pixels are that lie wholly inside a fan
--- of 24 wedges and radius 14.
local function inside(size)
  return 14 * math.cos(math.pi / 24) - 0.18 - 0.75 * 32 / size
end

local white = celspan.cel { celspan.rect { -9, -9, 60, 60, texture = "#fff" } }
local black = { 0, 0, 0, 1 }

--- Every pixel of the rostrum whose centre is nearer than `radius` to (16, 16) is black.
local function assert_black(rostrum, radius, size)
  local scale = size / 32
  local image = area(rostrum, { size, size }, { 32, 32 })
  for y = 0, size - 1 do
    for x = 0, size - 1 do
      if ((x + 0.5) / scale - 16) ^ 2 + ((y + 0.5) / scale - 16) ^ 2 < radius ^ 2 then
        local pixel = { image:get(x, y) }
        for c = 1, 4 do
          if pixel[c] ~= black[c] then
            error(("size %d: pixel %d, %d is %s"):format(size, x, y, table.concat(pixel, " ")), 2)
          end
        end
      end
    end
  end
end

--- Both sides of a wavy seam through the disc, over the same pieces in opposite directions.
local function seam_halves()
  local top = "M-4 16 C 5 3, 9 29, 16 16 S 25 30, 36 15.5 L 36 -4 L -4 -4 Z"
  local foot = "M36 15.5 C 25 30, 23 3, 16 16 C 9 29, 5 3, -4 16 L -4 36 L 36 36 Z"
  return celspan.path { d = top, texture = "#000" }, celspan.path { d = foot, texture = "#000" }
end

describe("abutting shapes", function()
  local sizes = { 32, 7, 19, 101, 333 }

  it("do not leak: a fan of 24 triangles in one cel", function()
    for _, size in ipairs(sizes) do
      local fan = wedges(24, 14)
      assert_black(celspan.rostrum { white, celspan.cel(fan) }, inside(size), size)
    end
  end)

  it("do not leak: a fan of 24 triangles, each in a cel of its own", function()
    for _, size in ipairs(sizes) do
      local cels = { white }
      for _, wedge in ipairs(wedges(24, 14)) do cels[#cels + 1] = celspan.cel { wedge } end
      assert_black(celspan.rostrum(cels), inside(size), size)
    end
  end)

  it("do not leak: 300 needles through one pixel", function()
    for _, size in ipairs { 32, 5 } do
      assert_black(celspan.rostrum { white, celspan.cel(wedges(300, 40)) }, 30, size)
    end
  end)

  it("do not leak: a curved seam, its pieces reversed", function()
    local top, foot = seam_halves()
    for _, size in ipairs(sizes) do
      assert_black(celspan.rostrum { white, celspan.cel { top, foot } }, 16, size)
      assert_black(celspan.rostrum { white, celspan.cel { foot }, celspan.cel { top } }, 16, size)
    end
  end)

  it("do not leak: a shape and the ground without that shape", function()
    local points = { { 3, 4 }, { 29, 8, 3 }, { 20, 31 }, { 1, 20, 0.4 }, { 14, 12 } }
    local blob = celspan.nurbs { points = points, texture = "#000" }
    local ground = celspan.rect { -9, -9, 60, 60, texture = "#000" }
    for _, size in ipairs(sizes) do
      assert_black(celspan.rostrum { white, celspan.cel { ground - blob }, celspan.cel { blob } },
        16, size)
      assert_black(celspan.rostrum { white, celspan.cel { ground & blob, ground - blob } }, 16,
        size)
    end
  end)

  it("do not leak: rotated and in perspective", function()
    local fan = wedges(24, 40)
    local function turned(cel)
      return cel:rotate(17.3, 16, 16):quad({ { 0, 0 }, { 32, 0 }, { 32, 32 }, { 0, 32 } },
                                          { { 1, -2 }, { 30, 2 }, { 34, 30 }, { -3, 33 } })
    end
    for _, size in ipairs(sizes) do
      assert_black(celspan.rostrum { white, turned(celspan.cel(fan)) }, 16, size)
    end
  end)
end)

-- ---------------------------------------------------------------- known areas

describe("area antialiasing", function()
  local function alphas(object, width, height)
    local image = area(celspan.rostrum { celspan.cel { object } }, { width, height })
    local list = {}
    for y = 0, height - 1 do
      for x = 0, width - 1 do list[#list + 1] = select(4, image:get(x, y)) end
    end
    return list
  end

  local function assert_alphas(expected, object, width, height)
    local list = alphas(object, width, height)
    for i, alpha in ipairs(expected) do
      assert.is_true(math.abs(list[i] - alpha) < 1e-6,
                     ("pixel %d: alpha %.7f, should be %.7f"):format(i, list[i], alpha))
    end
  end

  it("gives rectangles at fractional positions their share of each pixel", function()
    assert_alphas({ 0.75 * 0.625, 0.75, 0.75 * 0.25, 0.625, 1, 0.25, 0.125 * 0.625, 0.125,
      0.125 * 0.25 },
                  celspan.rect { 0.375, 0.25, 1.875, 1.875 }, 3, 3)
  end)

  it("gives shapes that begin and end in one row their area", function()
    assert_alphas({ 0.125 }, celspan.triangle { { 0.5, 0.5 }, { 1, 0 }, { 0.5, 1 } }, 1, 1)
    assert_alphas({ 0.1875 }, celspan.triangle { { 1, 0 }, { 0.25, 1 }, { 1, 0.5 } }, 1, 1)
    assert_alphas({ 0.03125 }, celspan.triangle { { 0.75, 0 }, { 0.5, 0.75 }, { 0.5, 1 } }, 1, 1)
    assert_alphas({ 0.015625 }, celspan.rect { 0.3125, 0.6875, 0.25, 0.0625 }, 1, 1)
    local box = { { 0.5, 0.25 }, { 1.5, 0.25 }, { 1.5, 0.75 }, { 0.5, 0.75 } }
    assert_alphas({ 0.25, 0.25 }, celspan.polygon(box), 2, 1)
  end)

  it("draws nothing for shapes without area", function()
    assert_alphas({ 0 }, celspan.triangle { { 0, 0 }, { 0.25, 0.5 }, { 0.5, 1 } }, 1, 1)
    assert_alphas({ 0, 0 }, celspan.polygon { { 0, 0.5 }, { 2, 0.5 }, { 0.25, 0.5 } }, 2, 1)
  end)

  it("adds up 4096 tiny shapes in one pixel", function()
    local dots = {}
    for i = 0, 63 do
      for j = 0, 63 do
        dots[#dots + 1] = celspan.rect { 1 + i / 64 + 1 / 256, 1 + j / 64 + 1 / 256, 1 / 128,
          1 / 128 }
      end
    end
    assert_alphas({ 0, 0, 0, 0, 0.25, 0, 0, 0, 0 }, celspan.union(dots), 3, 3)
  end)

  it("keeps the position of a boundary that begins where another shape's do", function()
    local quad = celspan.path { d = "M17 20 L5 16 L-10 16 L0 6 Z" }
    local wedge = celspan.path { d = "M50 17 L5 16 L8 23 Z" }
    local rostrum = celspan.rostrum { celspan.cel { quad | wedge } }
    local means = supersample.means(rostrum, { size = { 16, 16 }, film = { 49, 19 }, k = 64 })
    local most = supersample.errors(area(rostrum, { 16, 16 }, { 49, 19 }), means)
    assert.is_true(most < 4 * CODE, most * 255 .. " of 255")
  end)

  it("treats coincident edges of many shapes as one", function()
    local copies = {}
    for i = 1, 50 do copies[i] = celspan.rect { 0.25, 0.5, 1, 0.25 } end
    assert_alphas({ 0.1875, 0.0625 }, celspan.union(copies), 2, 1)
    assert_alphas({ 0, 0 }, celspan.xor(copies), 2, 1)
  end)

  it("follows the even-odd rule through crossings inside a pixel", function()
    local bow = { { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 1 } }
    assert_alphas({ 0.5 }, celspan.polygon(bow), 1, 1)
    local star = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 0, 0 }, { 1, 0 }, { 1, 0.5 },
      { 0, 0.5 } }
    assert_alphas({ 1 }, celspan.polygon(star), 1, 1)
    star.rule = "evenodd"
    assert_alphas({ 0.5 }, celspan.polygon(star), 1, 1)
  end)

  it("is the mean of a larger frame if thousands of shapes lie in a row", function()
    local random, shapes = prng.new(31), {}
    for i = 1, 3000 do
      local x, y = random:between(0, 4), random:between(0, 4)
      local function near(at) return at + random:between(-0.3, 0.3) end
      shapes[i] = celspan.triangle { { near(x), near(y) }, { near(x), near(y) },
        { near(x), near(y) },
                                     texture = celspan.rgb(random:between(0, 1), 0.5, 0.2, 0.6) }
    end -- fainter ones would be a crowd: see dense_spec.lua
    local rostrum, k = celspan.rostrum { celspan.cel(shapes), back = "#fff" }, 32
    local small = area(rostrum, { 4, 4 }, { 4, 4 })
    local large = area(rostrum, { 4 * k, 4 * k }, { 4, 4 })
    for y = 0, 3 do
      for x = 0, 3 do
        local sum = 0
        for j = 0, k - 1 do
          for i = 0, k - 1 do sum = sum + large:get(x * k + i, y * k + j) end
        end
        assert.is_near(sum / (k * k), small:get(x, y), 1e-4)
      end
    end
  end)
end)
