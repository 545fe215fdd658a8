-- Stacks of hundreds of faint layers, dozens of which are visible at once: the fold by tree.
-- Compared with the oracle and with many pixel centres, and with the same bits by whatever path
-- sets of layers are reached.
--
-- CASE=n runs one random scene alone.
local celspan = require "celspan"
local cases = require "tests.support.cases"
local prng = require "tests.support.prng"
local rows = require "tests.support.rows"
local supersample = require "tests.support.supersample"

local COUNT = 15
local SIZE = { 48, 40 }
local CODE = 1 / 255

local function point(random) return { random:between(-8, 56), random:between(-8, 48) } end

local function paint(random, alpha)
  return celspan.rgb(random:between(0, 1), random:between(0, 1), random:between(0, 1), alpha)
end

local function triangle(random, alpha)
  return celspan.triangle { point(random), point(random), point(random),
                            texture = paint(random, alpha) }
end

--- One shape, or a few as a boolean.
local function object(random)
  local alpha = random:between(0.01, 0.2)
  local shape, kind = triangle(random, alpha), random:whole(1, 12)
  if kind == 1 then return shape | triangle(random, alpha) end
  if kind == 2 then return shape - celspan.circle { centre = point(random), radius = 9 } end
  return shape
end

--- Every third scene has an opaque background, every third one opaque shapes anywhere in the stack.
local function deep_scene(seed)
  local random = prng.new(seed)
  local objects, count = {}, random:whole(260, 700)
  for i = 1, count do
    local is_opaque = seed % 3 == 1 and random:whole(1, 60) == 1
    objects[i] = is_opaque and triangle(random, 1) or object(random)
  end
  if seed % 3 == 0 then
    table.insert(objects, 1, celspan.rect { -9, -9, 70, 70, texture = "#fff" })
  end
  return celspan.rostrum { back = { 0.2, 0.3, 0.4, 0.5 },
                           celspan.cel { front = { 1, 0.9, 0.8 }, table.unpack(objects) } }, random
end

local function each_scene(test)
  for _, case in cases.of(COUNT) do
    local rostrum, random = deep_scene(case)
    test(rostrum, random, "CASE=" .. case)
  end
end

local function spans(rostrum, antialias, fields)
  local options = { size = SIZE, film = SIZE, antialias = antialias, workers = 1 }
  for name, value in pairs(fields or {}) do options[name] = value end
  return assert(celspan.spans(rostrum, options))
end

--- Whether a colour is that of the scene at a point; near an edge, that of a point around it.
local function is_seen(rostrum, x, y, colour)
  for _, radius in ipairs { 0, 1e-6 } do
    for _, offset in ipairs { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } } do
      local truth = { celspan.probe(rostrum, x + radius * offset[1], y + radius * offset[2],
                                    { film = SIZE }) }
      local most = 0
      for c = 1, 4 do most = math.max(most, math.abs(truth[c] - colour[c])) end
      if most < 2 ^ -16 + 2e-5 then return true end
    end
  end
end

describe("deep stacks of faint layers", function()
  it("agree with the oracle at pixel centres", function()
    each_scene(function(rostrum, random, case)
      local list = spans(rostrum, "none")
      for _ = 1, 60 do
        local x, y = random:whole(0, SIZE[1] - 1), random:whole(0, SIZE[2] - 1)
        local colour = rows.colour(list[y], x)
        assert(is_seen(rostrum, x + 0.5, y + 0.5, colour), ("%s: pixel %d, %d"):format(case, x, y))
      end
    end)
  end)

  it("are the mean of many pixel centres under area", function()
    each_scene(function(rostrum, random, case)
      local crop = { random:whole(0, 32), random:whole(0, 32), 12, 4 }
      local image = assert(celspan.pixels(rostrum, { size = SIZE, film = SIZE, crop = crop,
                                                     antialias = "area", workers = 1 }))
      local means = supersample.means(rostrum, { size = SIZE, film = SIZE, crop = crop, k = 96 })
      local most, rms = supersample.errors(image, means)
      assert(most <= 2 * CODE, ("%s: greatest error %.3f of 255"):format(case, most * 255))
      assert(rms <= 0.1 * CODE, ("%s: rms error %.4f of 255"):format(case, rms * 255))
    end)
  end)

  it("are the same with any number of workers #workers", function()
    each_scene(function(rostrum, _, case)
      for _, antialias in ipairs { "none", "area" } do
        local one, three = spans(rostrum, antialias), spans(rostrum, antialias, { workers = 3 })
        local last = SIZE[2] - 1
        assert(rows.text(one, 0, last) == rows.text(three, 0, last), case .. " under " .. antialias)
      end
    end)
  end)

  it("are the same in every row rendered alone", function()
    each_scene(function(rostrum, random, case)
      local all = spans(rostrum, "none")
      for _ = 1, 6 do
        local y = random:whole(0, SIZE[2] - 1)
        local alone = spans(rostrum, "none", { crop = { 0, y, SIZE[1], 1 } })
        local is_same = rows.text({ [0] = all[y] }, 0, 0) == rows.text(alone, 0, 0)
        assert(is_same, ("%s: row %d"):format(case, y))
      end
    end)
  end)
end)
