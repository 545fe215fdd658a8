-- Bent objects against the oracle: a pixel of a random object that was bent by a map is what the
-- object itself is at the point that the map takes there.
--
-- A failure prints the number of its case; CASE=n runs that one alone. tests/support/cases.lua
-- determines which are tried.
local celspan = require "celspan"
local cases = require "tests.support.cases"
local prng = require "tests.support.prng"
local scenes = require "tests.support.scenes"

local COUNT = 4000
local POINTS = 24 -- of an object
local EDGE = 0.04 -- pixels: the polyline of the sweep is within 0.02 of the curve
local SURE = 0.2  -- the share of pixels that may lie at an edge

--- A map that folds nothing, and the map back.
local function make_map(random)
  local a, b = random:between(-4, 4), random:between(5, 20)
  local c, d = random:between(-4, 4), random:between(5, 20)
  local function there(x, y)
    x = x + a * math.sin(y / b)
    return x, y + c * math.sin(x / d)
  end
  local function back(x, y)
    y = y - c * math.sin(x / d)
    return x - a * math.sin(y / b), y
  end
  return there, back
end

local function is_near(p, q, tolerance)
  for k = 1, 4 do
    if math.abs(p[k] - q[k]) > tolerance then return false end
  end
  return true
end

--- Whether a pixel is what the object is at a point, or at one beside it. Whether it is the former.
local function is_shown(pixel, probe, back, x, y)
  if is_near(pixel, { probe(back(x, y)) }, 1e-4) then return true, true end
  for angle = 0, 7 do
    for _, share in ipairs { 1, 0.4 } do
      local dx = share * EDGE * math.cos(angle * math.pi / 4)
      local dy = share * EDGE * math.sin(angle * math.pi / 4)
      if is_near(pixel, { probe(back(x + dx, y + dy)) }, 1e-4) then return true, false end
    end
  end
  return false
end

--- A random object in one colour each, alone, as it is and bent; nil where it cannot be bent.
local function make(case, there)
  local text, traits = scenes.object(case, { is_flat = true, is_plain = true, has_rows = false,
                                             has_patterns = false })
  local object = scenes.value(text)
  local good, bent = pcall(function() return object:warp { map = there } end)
  if not good then
    assert(bent:find "reaches the horizon" or bent:find "too rough", bent)
    return nil
  end
  local size = { math.ceil(traits.width), math.ceil(traits.height) }
  local image = assert(celspan.pixels(celspan.rostrum { celspan.cel { bent } },
    { size = size, film = size, antialias = "none" }))
  return celspan.rostrum { celspan.cel { object } }, image, size
end

describe("a bent object", function()
  it("shows at each pixel what the oracle sees at the place that the map takes there", function()
    local tried, sure, bent = 0, 0, 0
    for _, case in cases.of(COUNT) do
      local random = prng.new(case)
      local there, back = make_map(random)
      local rostrum, image, size = make(case, there)
      bent = bent + (rostrum and 1 or 0)
      local function probe(x, y) return celspan.probe(rostrum, x, y, { film = size }) end
      for _ = 1, rostrum and POINTS or 0 do
        local x, y = random:whole(0, image.width - 1), random:whole(0, image.height - 1)
        local good, is_sure = is_shown({ image:get(x, y) }, probe, back, x + 0.5, y + 0.5)
        assert.is_true(good, ("CASE=%d: pixel %d, %d"):format(case, x, y))
        tried, sure = tried + 1, sure + (is_sure and 1 or 0)
      end
    end
    assert.is_true(bent > 0 and sure >= (1 - SURE) * tried, sure .. " of " .. tried)
  end)
end)
