-- Pixels in which very many boundaries lie: what they show, and what they cost.
local celspan = require "celspan"
local prng = require "tests.support.prng"

local SIDE, FINE = 6, 32 -- pixels a side; and the factor of the exact picture

--- A polygon of so many random points, which crosses itself everywhere.
local function scribble(count, seed)
  local random, points = prng.new(seed), { rule = "evenodd", texture = celspan.rgb(0.9, 0.5, 0.1) }
  for i = 1, count do points[i] = { SIDE * random:between(0, 1), SIDE * random:between(0, 1) } end
  return celspan.cel { celspan.polygon(points) }
end

local function squares(count, seed)
  local random, objects = prng.new(seed), {}
  for i = 1, count do
    objects[i] = celspan.rect { SIDE * random:between(0, 1), SIDE * random:between(0, 1), 0.7, 0.7,
                                texture = celspan.rgb(random:between(0, 1), random:between(0, 1), random:between(0, 1)) }
  end
  return celspan.cel(objects)
end

local function shot(rostrum, side, options)
  local all = { size = { side, side }, film = { SIDE, SIDE }, antialias = "area", workers = 1 }
  for key, value in pairs(options or {}) do all[key] = value end
  return assert(celspan.pixels(rostrum, all))
end

--- The mean of FINE x FINE pixels of the fine picture.
local function mean(fine, x, y, channel)
  local sum = 0
  for j = 0, FINE - 1 do
    for i = 0, FINE - 1 do sum = sum + select(channel, fine:get(FINE * x + i, FINE * y + j)) end
  end
  return sum / FINE ^ 2
end

local function compare(rostrum, of)
  local coarse, fine = shot(rostrum, SIDE), shot(rostrum, FINE * SIDE)
  local square, worst = 0, 0
  for y = 0, SIDE - 1 do
    for x = 0, SIDE - 1 do
      for channel = 1, 4 do
        local off = math.abs(select(channel, coarse:get(x, y)) - mean(fine, x, y, channel))
        square, worst = square + off ^ 2, math.max(worst, off)
      end
    end
  end
  local rms = math.sqrt(square / (4 * SIDE ^ 2))
  assert.is_true(rms <= 1 / 255, ("%s: rms %.2f of 255"):format(of, 255 * rms))
  assert.is_true(worst <= 5 / 255, ("%s: worst %.2f of 255"):format(of, 255 * worst))
end

describe("dense pixels", function()
  it("show the mean of what lies in them", function()
    for seed = 1, 2 do
      compare(celspan.rostrum { back = "#fff", scribble(6500 + 1000 * seed, seed) }, "scribble")
      compare(celspan.rostrum { squares(9000 * seed, seed) }, "squares")
    end
  end)

  it("are the same in any crop", function()
    local rostrum = celspan.rostrum { scribble(9000, 7) }
    local whole = shot(rostrum, SIDE)
    local part = shot(rostrum, SIDE, { crop = { 2, 1, 3, 4 } })
    for y = 0, 3 do
      for x = 0, 2 do
        assert.are.same({ whole:get(x + 2, y + 1) }, { part:get(x, y) })
      end
    end
  end)

  it("leave no gap where all is covered", function()
    local random = prng.new(3)
    local objects = { celspan.rect { -1, -1, SIDE + 2, SIDE + 2, texture = "#000" } } -- behind all
    for i = 2, 40000 do
      local y = SIDE * random:between(0, 1)
      objects[i] = celspan.rect { -1, y, SIDE + 2, 0.4, texture = "#000" }
    end
    local image = shot(celspan.rostrum { back = "#fff", celspan.cel(objects) }, SIDE)
    for y = 0, SIDE - 1 do
      for x = 0, SIDE - 1 do assert.are.same({ 0, 0, 0, 1 }, { image:get(x, y) }) end
    end
  end)
end)
