-- A composition inside another: where nothing is between it and the camera, it looks as it does by
-- itself, multiplied by the front light around it. Its area is the mean of many probes.
--
-- CASE=n runs that case alone and prints it as a script.
local celspan = require "celspan"
local cases = require "tests.support.cases"
local scenes = require "tests.support.scenes"

local COUNT, ONLY = 300, cases.only
local ALIKE = 1 / 65535
local modes = { "none", "area", { kernel = "mitchell" } }

--- A random rostrum as in a film, its size, and the brightest light that can leave it.
local function random_rostrum(case, options)
  local script, traits = scenes.script(case, options)
  if ONLY then print(script) end
  return scenes.load(script):at(1), { traits.width, traits.height }, math.max(1, traits.light)
end

local function shot(rostrum, size, antialias, film)
  return assert(celspan.pixels(rostrum,
    { size = size, film = film or size, antialias = antialias, workers = 1 }))
end

--- Checks that every pixel of `nested` is that of `flat` times a light; `edge` pixels are left out
--- on all sides, because a kernel sees artwork beyond the frame of a film and an object has none
--- there.
local function assert_lit(flat, nested, light, tolerance, where, edge)
  for y = edge, flat.height - 1 - edge do
    for x = edge, flat.width - 1 - edge do
      local p, q = { flat:get(x, y) }, { nested:get(x, y) }
      for c = 1, 4 do
        if math.abs(p[c] * (light[c] or 1) - q[c]) > tolerance then
          error(("%s: pixel %d, %d: alone %s, nested %s"):format(where, x, y, table.concat(p, " "),
                                                               table.concat(q, " ")), 2)
        end
      end
    end
  end
end

local function each_case(check, options)
  options = options or { is_single = true }
  for _, case in cases.of(COUNT) do
    local antialias = modes[case % #modes + 1]
    local rostrum, size, brightest = random_rostrum(case, options)
    local edge = type(antialias) == "table" and 3 or 0
    check(rostrum:with { size = size, antialias = antialias }, size, antialias,
          ("CASE=%d"):format(case), brightest, edge)
  end
end

describe("a composition inside another", function()
  --- Under a kernel gradients may differ as far as spans may: where they are divided depends on the
  -- edges that are not certainly hidden, and fewer are known to be hidden inside an object.
  local function check_white(with_kernel)
    return function(inner, size, antialias, where, brightest, edge)
      local tolerance = edge > 0 and with_kernel or ALIKE
      assert_lit(shot(inner, size, antialias),
        shot(celspan.rostrum { celspan.cel { inner } }, size, antialias),
                 {}, tolerance * brightest, where, edge)
    end
  end

  it("looks under white light as it does by itself, with gels and bright lights", function()
    each_case(check_white(ALIKE), { is_single = true, is_flat = true, has_rows = false })
    each_case(check_white(1 / 1023))
  end)

  --- Inside two others: the lights multiply to 1.5, 1, 1.
  local function check_levels(tolerance)
    return function(inner, size, antialias, where, brightest, edge)
      local middle = celspan.rostrum { size = size, brightness = 2, front = { 0.5, 1, 0.25 },
                                       celspan.cel { inner } }
      local outer = celspan.rostrum { celspan.cel { middle, front = { 1.5, 0.5, 2 } } }
      assert_lit(shot(inner, size, antialias), shot(outer, size, antialias), { 1.5, 1, 1 },
                 tolerance * 1.5 * brightest, where, edge)
    end
  end

  it("is multiplied by the front light around it, level by level", function()
    each_case(check_levels(ALIKE), { is_single = true, is_flat = true, has_rows = false })
    each_case(check_levels(1 / 1023)) -- brighter gradients are divided at other places
  end)

  it("is the same in a film of twice the size, scaled to half", function()
    each_case(function(inner, size, _, where, brightest)
      local half = inner:scale(2):scale(0.5)
      assert_lit(shot(inner, size, "none"),
        shot(celspan.rostrum { celspan.cel { half } }, size, "none"),
                 {}, ALIKE * brightest, where, 0)
    end)
  end)
end)

-- ---------------------------------------------------------------- area antialiasing

local FILM, SCALE, PROBES = { 40, 30 }, 3, 16

local lamp = celspan.radial { centre = { 20, 15 }, radius = 60, { 0, celspan.rgb(1, 0.9, 0.7) },
                              { 1, celspan.rgb(0.1, 0.1, 0.3, 0.2) } }
local slope = celspan.linear { from = { 0, 0 }, to = { 40, 30 }, { 0, celspan.rgb(1, 0.2, 0, 0.9) },
                               { 1, celspan.rgb(0, 0.4, 1, 0.5) } }
local art = celspan.union { celspan.circle { centre = { 15, 15 }, radius = 11, texture = slope },
                            celspan.rect { 10, 8, 22, 14, texture = "#4080c0c0" } }

local function inside(fields)
  fields.size = FILM
  fields[1] = celspan.cel { celspan.rect { -5, -5, 50, 40, texture = "#80a040" }, opacity = 0.7 }
  fields[2] = celspan.cel { art, front = { texture = slope, gain = 1.2, on = "cel" }, opacity = 0.8,
                            back = { texture = lamp, gain = 0.5 } }:rotate(10, 20, 15)
  return celspan.rostrum(fields)
end

local function leaning(object)
  return object:quad({ { 0, 0 }, { 40, 0 }, { 40, 30 }, { 0, 30 } },
    { { 4, 3 }, { 37, 1 }, { 34, 28 }, { 1, 26 } })
end

local compositions = {
  ["in perspective, under lights with a shape at each level"] = celspan.rostrum { back = "#fff",
    celspan.cel { front = lamp,
      leaning(inside { front = { texture = lamp, gain = 1.2 }, back = slope,
                                                 camera = { rotate = 12, width = 35 } })
                                                   :fade(0.8) } },
  ["as operands, one of them faded"] = celspan.rostrum { back = { texture = lamp, gain = 0.5 },
    celspan.cel { front = { texture = slope, on = "cel" },
                  leaning(inside {}) ~ inside { back = { 0, 0, 0, 0.5 } }:translate(7, 5)
                    :fade(0.6) } },
}

--- The mean of probes over a pixel.
local function mean(rostrum, x, y)
  local sum = { 0, 0, 0, 0 }
  for i = 0, PROBES * PROBES - 1 do
    local px, py = x + (i % PROBES + 0.5) / PROBES, y + (i // PROBES + 0.5) / PROBES
    local colour = { celspan.probe(rostrum, px / SCALE, py / SCALE, { film = FILM }) }
    for c = 1, 4 do sum[c] = sum[c] + colour[c] / PROBES ^ 2 end
  end
  return sum
end

describe("the area of compositions inside others", function()
  for name, rostrum in pairs(compositions) do
    it("is the mean of many probes: " .. name, function()
      local size = { FILM[1] * SCALE, FILM[2] * SCALE }
      local image, square = shot(rostrum, size, "area", FILM), 0
      for i = 1, 400 do
        local x, y = i * 37 % size[1], (i * 53 + i // 7) % size[2]
        local expected, found = mean(rostrum, x, y), { image:get(x, y) }
        for c = 1, 4 do
          assert.near(expected[c], found[c], 2 / 255)
          square = square + (expected[c] - found[c]) ^ 2
        end
      end
      assert.is_true((square / 1600) ^ 0.5 < 0.1 / 255)
    end)
  end
end)
