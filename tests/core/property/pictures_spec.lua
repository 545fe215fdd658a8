-- Pictures in scenes: unchanged at their own size, never read when hidden, interpolated like the
-- oracle does when enlarged.
local celspan = require "celspan"
local cases = require "tests.support.cases"
local pieces = require "tests.support.pieces"
local prng = require "tests.support.prng"
local rows = require "tests.support.rows"

local COUNT = 30
local WIDTH, HEIGHT = 24, 18

local file, folder

setup(function() file, folder = pieces.draw({ WIDTH, HEIGHT }, 40) end)

teardown(function() pieces.remove(folder) end)

local function pixels(exposures, options) return assert(celspan.pixels(exposures, options)) end

local function show(...) return celspan.rostrum { celspan.cel { ... } } end

describe("a picture at its own size", function()
  for _, antialias in ipairs { "none", "area" } do
    it("is rendered unchanged, code by code, under " .. antialias, function()
      local out = folder .. "/again.png"
      local rostrum = show(celspan.image { file = file }):with { antialias = antialias }
      assert(celspan.render(rostrum, out, { size = { WIDTH, HEIGHT } }))
      local options = { size = { WIDTH, HEIGHT } }
      local before = pixels(show(celspan.image { file = file }), options)
      local after = pixels(show(celspan.image { file = out }), options)
      for y = 0, HEIGHT - 1 do
        for x = 0, WIDTH - 1 do assert.are.same({ before:get(x, y) }, { after:get(x, y) }) end
      end
    end)

    it("is unchanged when moved by whole pixels under " .. antialias, function()
      local options = { size = { WIDTH, HEIGHT }, antialias = antialias }
      local still = pixels(show(celspan.image { file = file }), options)
      local moved = pixels(show(celspan.image { file = file, x = 3, y = -2 }), options)
      for y = 0, HEIGHT - 3 do
        for x = 3, WIDTH - 1 do
          assert.are.same({ still:get(x - 3, y + 2) }, { moved:get(x, y) })
        end
      end
    end)
  end
end)

describe("a missing picture", function()
  local function missing() return celspan.image { file = folder .. "/none.png", w = 20, h = 10 } end
  local options = { size = { WIDTH, HEIGHT } }

  it("is never read if it is hidden", function()
    for _, antialias in ipairs { "none", "area" } do
      options.antialias = antialias
      local cover = celspan.cel { celspan.rect { 0, 0, WIDTH, HEIGHT, texture = "#123" } }
      pixels(celspan.rostrum { celspan.cel { missing() }, cover }, options)
      pixels(show(missing():translate(2 * WIDTH, 0)), options)
      pixels(show(missing() - celspan.rect { -1, -1, 99, 99 }), options)
      pixels(show(celspan.clip(celspan.rect { 0, 0, 9, 9 }, missing())), options)
      pixels(celspan.rostrum { celspan.cel { missing(), opacity = 0 } }, options)
    end
  end)

  it("is an error that names it if it is visible", function()
    for _, antialias in ipairs { "none", "area" } do
      options.antialias = antialias
      local image, message = celspan.pixels(show(missing()), options)
      assert.is_nil(image)
      assert.is_truthy(message:find("none.png", 1, true), message)
      image = celspan.spans(show(missing()), options)
      assert.is_nil(image)
      assert.is_nil((celspan.render(show(missing()), folder .. "/out.png", options)))
      assert.is_nil(io.open(folder .. "/out.png"))
    end
  end)

  it("is an error too if it is visible through a gel or a hole", function()
    local gel = celspan.cel { celspan.rect { 0, 0, WIDTH, HEIGHT, texture = celspan.gel(1, 0, 0) } }
    local hole = celspan.rect { 0, 0, WIDTH, HEIGHT, texture = "#fff" }
      - celspan.rect { 4, 4, 1, 1 }
    assert.is_nil((celspan.pixels(celspan.rostrum { celspan.cel { missing() }, gel }, options)))
    local behind = celspan.rostrum { celspan.cel { missing() }, celspan.cel { hole } }
    assert.is_nil((celspan.pixels(behind, options)))
  end)
end)

-- ---------------------------------------------------------------- against the oracle

--- A picture placed at random, enlarged, bilinear.
local function placed(random)
  local wrap = random:pick { "clear", "clamp", "repeat" }
  local use = random:pick { "paint", "paint", "gel" }
  local texture = { file = file, sampling = "bilinear", wrap = wrap, as = use }
  if random:once(2) then
    texture.box = { random:whole(-4, 8), random:whole(-4, 8), random:whole(26, 60),
      random:whole(20, 50) }
  end
  local shape = random:once(2)
    and celspan.rect { 2, 3, random:whole(26, 50), random:whole(20, 40),
      texture = celspan.picture(texture) }
    or celspan.polygon { { 1, 2 }, { 50, 8 }, { 40, 44 }, { 5, 30 },
      texture = celspan.picture(texture) }
  if random:once(2) then shape = shape:rotate(random:between(-180, 180), 25, 20) end
  if random:once(2) then shape = shape:scale(random:between(1, 2.5), random:between(1, 2.5)) end
  if random:once(3) then shape = shape:scale(random:between(2, 6)) end
  if random:once(4) then
    shape = shape:scale(2.5):quad({ { 0, 0 }, { 125, 0 }, { 125, 100 }, { 0, 100 } },
                                  { { -4, 2 }, { 130, -6 }, { 134, 110 }, { 3, 104 } })
  end
  return shape
end

describe("an enlarged picture", function()
  it("agrees with the oracle at pixel centres", function()
    for _, case in cases.of(COUNT) do
      local random = prng.new(case)
      local ground = celspan.rect { 0, 0, 60, 45, texture = "#4080c0" }
      local picture = celspan.cel { placed(random), opacity = 0.8 }
      local rostrum = celspan.rostrum { celspan.cel { ground }, picture }
      local size = { 60, 45 }
      local list = assert(celspan.spans(rostrum, { size = size, antialias = "none", workers = 1 }))
      for _ = 1, 200 do
        local x, y = random:whole(0, 59), random:whole(0, 44)
        local colour = rows.colour(list[y], x)
        local truth = { celspan.probe(rostrum, x + 0.5, y + 0.5, { film = size }) }
        for c = 1, 4 do
          if math.abs(colour[c] - truth[c]) > 2 / 1023 then
            error(("CASE=%d: pixel %d, %d is %s, the oracle says %s"):format(
              case, x, y, table.concat(colour, " "), table.concat(truth, " ")))
          end
        end
      end
    end
  end)
end)

-- ---------------------------------------------------------------- enlarged, upright

--- The picture over the whole of a frame `scale` times its size.
local function spread(sampling, scale, rest)
  local image = celspan.image { file = file, x = 0, y = 0, sampling = sampling,
    wrap = "clamp" }:scale(scale)
  local size = { math.floor(WIDTH * scale), math.floor(HEIGHT * scale) }
  local rostrum = celspan.rostrum { celspan.cel { image }, table.unpack(rest or {}) }
  return assert(celspan.spans(rostrum, { size = size, workers = 1 })), size, rostrum
end

local function count_kinds(list, size)
  local counts = { single = 0, gradient = 0, array = 0 }
  for y = 0, size[2] - 1 do
    for _, span in ipairs(list[y]) do counts[span.kind] = counts[span.kind] + 1 end
  end
  return counts
end

local function are_near(a, b)
  for c = 1, 4 do
    local is_near = math.abs(a[c] - b[c]) <= 1 / 1023
    if not is_near then return false end
  end
  return true
end

describe("a picture enlarged upright", function()
  for _, scale in ipairs { 4, 5.3, 17 } do
    it("is one span per texel without arrays, nearest, at " .. scale, function()
      local list, size = spread("nearest", scale)
      local counts = count_kinds(list, size)
      assert.are.equal(0, counts.array)
      assert.are.equal(0, counts.gradient)
      assert.is_true(counts.single <= WIDTH * size[2])
    end)

    it("is a gradient from texel to texel without arrays, bilinear, at " .. scale, function()
      local list, size, rostrum = spread("bilinear", scale)
      local counts = count_kinds(list, size)
      assert.are.equal(0, counts.array)
      assert.is_true(counts.single + counts.gradient <= (WIDTH + 1) * size[2])
      for y = 0, size[2] - 1, 3 do
        local is_near = true
        for x = 0, size[1] - 1 do
          local truth = { celspan.probe(rostrum, x + 0.5, y + 0.5, { film = size }) }
          is_near = is_near and are_near(rows.colour(list[y], x), truth)
        end
        assert.is_true(is_near, "row " .. y)
      end
    end)

    it("is the same as pixel by pixel, at " .. scale, function()
      for _, sampling in ipairs { "nearest", "bilinear" } do
        local list, size = spread(sampling, scale)
        -- A rotation too small to see keeps the picture from being upright.
        local turned = celspan.image { file = file, x = 0, y = 0, sampling = sampling,
          wrap = "clamp" }
          :scale(scale):rotate(1e-8)
        local arrays = assert(celspan.spans(show(turned), { size = size, workers = 1 }))
        for y = 2, size[2] - 3 do
          assert.are.equal("array", arrays[y][math.ceil(#arrays[y] / 2)].kind)
          local is_near = true
          for x = 2, size[1] - 3 do
            is_near = is_near and are_near(rows.colour(list[y], x), rows.colour(arrays[y], x))
          end
          assert.is_true(is_near, "row " .. y)
        end
      end
    end)
  end

  it("keeps its spans between the edges of shapes above it", function()
    local over = celspan.cel { celspan.circle { centre = { 60, 50 }, radius = 40,
      texture = "#10a0f080" } }
    for _, sampling in ipairs { "nearest", "bilinear" } do
      local list, size = spread(sampling, 8, { over })
      local count = 0
      for y = 0, size[2] - 1 do
        for _, span in ipairs(list[y]) do
          if span.kind == "array" then count = count + span.x1 - span.x0 end
        end
      end
      assert.is_true(count <= 10 * size[2], count .. " pixels in arrays")
    end
  end)
end)

describe("a picture shrunk to a few pixels", function()
  it("keeps its mean", function()
    local ground = celspan.rect { 0, 0, WIDTH, HEIGHT, texture = "#000" }
    local full = pixels(show(ground, celspan.image { file = file }), { size = { WIDTH, HEIGHT } })
    local small = pixels(show(ground, celspan.image { file = file }),
                         { size = { WIDTH // 6, HEIGHT // 6 }, film = { WIDTH, HEIGHT } })
    local function mean(image)
      local sum = { 0, 0, 0 }
      for y = 0, image.height - 1 do
        for x = 0, image.width - 1 do
          local pixel = { image:get(x, y) }
          for c = 1, 3 do sum[c] = sum[c] + pixel[c] end
        end
      end
      for c = 1, 3 do sum[c] = sum[c] / (image.width * image.height) end
      return sum
    end
    local a, b = mean(full), mean(small)
    for c = 1, 3 do assert.is_true(math.abs(a[c] - b[c]) < 0.02, a[c] .. " " .. b[c]) end
  end)
end)
