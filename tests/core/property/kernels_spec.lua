-- Filter kernels: normalised, separable, seeing artwork beyond the crop; compared with sums of many
-- pixel centres under the kernel.
local celspan = require "celspan"
local cases = require "tests.support.cases"
local prng = require "tests.support.prng"
local scenes = require "tests.support.scenes"

local COUNT, ONLY = 20, cases.only
local kernels = {
  { kernel = "box" }, { kernel = "gaussian" }, { kernel = "mitchell" }, { kernel = "lanczos" },
  { kernel = "box", radius = 1.25 }, { kernel = "gaussian", radius = 0.8, rows = 32 },
  { kernel = function(x) return math.max(0, 1 - math.abs(x)) end, radius = 1 },
}

local function name_of(kernel)
  return ("%s of radius %s"):format(type(kernel.kernel) == "string" and kernel.kernel
    or "a function",
                                    kernel.radius or "default")
end

local function shot(exposures, size, film, antialias, more)
  local options = { size = size, film = film, antialias = antialias, workers = 1 }
  for name, value in pairs(more or {}) do options[name] = value end
  return assert(celspan.pixels(exposures, options))
end

local function assert_alike(a, b, tolerance, where, dx, dy)
  for y = 0, b.height - 1 do
    for x = 0, b.width - 1 do
      local p, q = { a:get(x + (dx or 0), y + (dy or 0)) }, { b:get(x, y) }
      for c = 1, 4 do
        if math.abs(p[c] - q[c]) > tolerance then
          error(("%s: pixel %d, %d: %s, but %s"):format(where, x, y, table.concat(p, " "),
                                                       table.concat(q, " ")), 2)
        end
      end
    end
  end
end

--- Calls test(exposures, traits, film, where, random) with random scenes, small.
local function each_scene(options, test)
  for _, case in cases.of(COUNT) do
    local script, traits = scenes.script(case, options)
    if ONLY then print(script) end
    test(scenes.load(script):at(1), traits, { traits.width, traits.height }, "CASE=" .. case,
      prng.new(case))
  end
end

describe("a kernel", function()
  for _, kernel in ipairs(kernels) do
    local name = name_of(kernel)

    it("leaves a constant unchanged: " .. name, function()
      local paint = celspan.paint { pigment = { 1, 0.5, 0.25 }, medium = { 0, 1, 1 }, beta = 0.75 }
      local ground = celspan.rect { -99, -99, 299, 299, texture = paint }
      local rostrum = celspan.rostrum { celspan.cel { ground }, back = { 0.5, 0.5, 0.25, 0.5 } }
      local expected = { celspan.probe(rostrum, 5, 5, { film = { 24, 18 } }) }
      local image = shot(rostrum, { 24, 18 }, nil, kernel)
      for y = 0, 17 do
        for x = 0, 23 do
          local pixel = { image:get(x, y) }
          for c = 1, 4 do assert.is_true(math.abs(pixel[c] - expected[c]) < 1e-5) end
        end
      end
    end)

    it("gives the same with any number of workers and in any crop: " .. name, function()
      each_scene({}, function(exposures, _, film, where, random)
        local whole = shot(exposures, film, film, kernel)
        assert_alike(whole, shot(exposures, film, film, kernel, { workers = 3 }), 0, where)
        local x, y = random:whole(0, film[1] - 1), random:whole(0, film[2] - 1)
        local crop = { x, y, random:whole(1, film[1] - x), random:whole(1, film[2] - y) }
        assert_alike(whole, shot(exposures, film, film, kernel, { crop = crop }), 1 / 65535, where,
          x, y)
      end)
    end)
  end
end)

describe("the box of one pixel", function()
  it("is nearly the exact area", function()
    each_scene({ is_flat = true, has_rows = false }, function(exposures, traits, film, where)
      -- 16 rows per pixel: each edge may be off by half a row.
      local box = { kernel = "box", rows = 64 }
      assert_alike(shot(exposures, film, film, "area"), shot(exposures, film, film, box),
                   math.max(1, traits.light) * 8 / 255, where)
    end)
  end)
end)

-- ---------------------------------------------------------------- against many centres

local function sinc(x) return x == 0 and 1 or math.sin(math.pi * x) / (math.pi * x) end

local function mitchell(x)
  x = math.abs(x)
  if x < 1 then return (21 * x ^ 3 - 36 * x ^ 2 + 16) / 18 end
  return x < 2 and (-7 * x ^ 3 + 36 * x ^ 2 - 60 * x + 32) / 18 or 0
end

local shapes = {
  { { kernel = "gaussian" }, 1.5, function(x) return math.exp(-0.5 * (x / 0.5) ^ 2) end },
  { { kernel = "box", radius = 1.25 }, 1.25, function() return 1 end },
  { { kernel = "mitchell" }, 2, mitchell },
  { { kernel = "lanczos" }, 3, function(x) return sinc(x) * sinc(x / 3) end },
  { kernels[7], 1, function(x) return 1 - math.abs(x) end },
}

--- Alpha of a pixel of the frame: the weighted mean of centres, k per pixel.
local function filtered(rostrum, film, px, py, radius, weight, k)
  local sum, total = 0, 0
  local reach = math.floor(radius * k)
  for j = -reach, reach - 1 do
    local dy = (j + 0.5) / k
    for i = -reach, reach - 1 do
      local dx = (i + 0.5) / k
      local w = weight(dx) * weight(dy)
      local _, _, _, a = celspan.probe(rostrum, px + 0.5 + dx, py + 0.5 + dy, { film = film })
      sum, total = sum + w * a, total + w
    end
  end
  return math.min(1, math.max(0, sum / total))
end

describe("a filtered picture", function()
  for _, shape in ipairs(shapes) do
    it("is the weighted mean under the kernel: " .. name_of(shape[1]), function()
      local film = { 12, 10 }
      local rostrum = celspan.rostrum { celspan.cel {
        celspan.polygon { { 2.3, 1.7 }, { 10.1, 3.2 }, { 6.4, 9.6 }, { 5.2, 5.1 } },
        celspan.rect { -2, 4.25, 4.4, 2.5, texture = "#ffffff80" } } }
      local image = shot(rostrum, film, film, shape[1])
      for _, at in ipairs { { 0, 4 }, { 2, 2 }, { 3, 3 }, { 5, 5 }, { 6, 8 }, { 9, 3 },
        { 6, 4 } } do
        local alpha = select(4, image:get(at[1], at[2]))
        local expected = filtered(rostrum, film, at[1], at[2], shape[2], shape[3], 24)
        assert.is_true(math.abs(alpha - expected) < 0.012,
                       ("pixel %d, %d: alpha %.4f, should be %.4f")
                       :format(at[1], at[2], alpha, expected))
      end
    end)
  end
end)
