-- Pixels with very many boundaries: their colours, and their cost.
local celspan = require "celspan"
local prng = require "tests.support.prng"
local workbench = require "tests.support.workbench"

local SIDE, FINE = 6, 32 -- pixels a side; and the scale of the exact picture

--- A polygon of `count` random points, which crosses itself everywhere.
local function scribble(count, seed)
  local random, points = prng.new(seed), { rule = "evenodd", texture = celspan.rgb(0.9, 0.5, 0.1) }
  for i = 1, count do points[i] = { SIDE * random:between(0, 1), SIDE * random:between(0, 1) } end
  return celspan.cel { celspan.polygon(points) }
end

local function squares(count, seed)
  local random, objects = prng.new(seed), {}
  for i = 1, count do
    objects[i] = celspan.rect { SIDE * random:between(0, 1), SIDE * random:between(0, 1), 0.7, 0.7,
                                texture = celspan.rgb(random:between(0, 1), random:between(0, 1),
                                  random:between(0, 1)) }
  end
  return celspan.cel(objects)
end

local function shot(rostrum, side, options)
  local all = { size = { side, side }, film = { SIDE, SIDE }, antialias = "area", workers = 1 }
  for key, value in pairs(options or {}) do all[key] = value end
  return assert(celspan.pixels(rostrum, all))
end

--- The means of FINE x FINE pixels of the fine picture: red, green, blue and alpha.
local function means(fine, x, y)
  local red, green, blue, alpha = 0, 0, 0, 0
  for j = 0, FINE - 1 do
    for i = 0, FINE - 1 do
      local r, g, b, a = fine:get(FINE * x + i, FINE * y + j)
      red, green, blue, alpha = red + r, green + g, blue + b, alpha + a
    end
  end
  local count = FINE ^ 2
  return { red / count, green / count, blue / count, alpha / count }
end

--- most: the error that one pixel may have, of 255, 5 by default; rms: the error of all, 1.
local function compare(rostrum, of, most, rms_most)
  local coarse, fine = shot(rostrum, SIDE), shot(rostrum, FINE * SIDE)
  local square, worst = 0, 0
  for y = 0, SIDE - 1 do
    for x = 0, SIDE - 1 do
      local expected = means(fine, x, y)
      for channel, light in ipairs { coarse:get(x, y) } do
        local off = math.abs(light - expected[channel])
        square, worst = square + off ^ 2, math.max(worst, off)
      end
    end
  end
  local rms = math.sqrt(square / (4 * SIDE ^ 2))
  assert.is_true(rms <= (rms_most or 1) / 255, ("%s: rms %.2f of 255"):format(of, 255 * rms))
  assert.is_true(worst <= (most or 5) / 255, ("%s: worst %.2f of 255"):format(of, 255 * worst))
end

describe("dense pixels", function()
  it("show the mean of their area", function()
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

  it("leave no gap where shapes cover everything", function()
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

-- ---------------------------------------------------------------- what lies behind others

--- A shape with a paint: most of them small upright opaque rectangles, the others of all the kinds
--- that must not be mistaken for one.
local function shape(random, side)
  local x, y, kind = side * random:between(-0.2, 1), side * random:between(-0.2, 1),
    random:whole(1, 12)
  local paint = celspan.rgb(random:between(0, 1), random:between(0, 1), random:between(0, 1))
  if kind == 1 then return celspan.circle { centre = { x, y }, radius = 3, texture = paint } end
  if kind == 2 then return celspan.rect { x, y, 4, 4, radius = 2, texture = paint } end
  if kind == 3 then return celspan.rect { x, y, 4, 4, texture = paint }:rotate(30, x, y) end
  if kind == 4 then return celspan.rect { x, y, 4, 4, texture = paint }:fade(0.5) end
  if kind == 5 then return celspan.rect { x, y, 4, 4, texture = celspan.gel(0.5, 0.7, 1) } end
  if kind == 6 then
    return celspan.stroke { points = { { x, y }, { x + 5, y + 3 } }, width = 2, texture = paint }
  end
  if kind == 7 then
    return celspan.union { celspan.rect { x, y, 2, 3, texture = paint },
      celspan.rect { x + 2, y, 2, 2 } }
  end
  return celspan.rect { x, y, 3 * random:between(0, 2), 4, texture = paint }
end

--- The same objects in one cel, and in many cels that are too small for hidden objects to be
--- searched. With a grade both are swept.
local function both(count, seed, side, opacity, grade)
  local random, all, parts = prng.new(seed), {}, {}
  for i = 1, count do
    all[i] = shape(random, side)
    if i % 500 == 1 then parts[#parts + 1] = {} end
    table.insert(parts[#parts], all[i])
  end
  for i, part in ipairs(parts) do parts[i] = celspan.cel(part) end
  return celspan.rostrum { back = "#fff", grade = grade, celspan.cel(all):fade(opacity) },
    celspan.rostrum { back = "#fff", grade = grade, table.unpack(parts) }
end

local function assert_alike(a, b, side, tolerance)
  local where
  for y = 0, side - 1 do
    for x = 0, side - 1 do
      local one, other = { a:get(x, y) }, { b:get(x, y) }
      for channel = 1, 4 do
        local is_near = math.abs(one[channel] - other[channel]) <= tolerance
        if not is_near then
          where = where or ("%d, %d: %g and %g"):format(x, y, one[channel], other[channel])
        end
      end
    end
  end
  assert.is_nil(where)
end

describe("objects behind others", function()
  it("are left out without a visible difference", function()
    for seed, side in ipairs { 24, 57, 300 } do
      local one, many = both(2500, seed, side, 1, { exposure = -0.01 })
      for _, mode in ipairs { "none", "area", { kernel = "mitchell" } } do
        local options = { size = { side, side }, film = { side, side }, antialias = mode,
          workers = 1 }
        assert_alike(assert(celspan.pixels(one, options)), assert(celspan.pixels(many, options)),
          side,
          mode == "none" and 0 or 1e-4)
      end
    end
  end)

  it("hide each other completely in a cel that is faded", function()
    local faded, plain = both(2500, 4, 24, 0.25), both(2500, 4, 24, 1)
    local options = { size = { 24, 24 }, film = { 24, 24 }, antialias = "none", workers = 1 }
    local image, whole = assert(celspan.pixels(faded, options)),
      assert(celspan.pixels(plain, options))
    for y = 0, 23 do
      for x = 0, 23 do
        local seen, under = image:get(x, y), whole:get(x, y)
        assert.is_true(math.abs(seen - (0.25 * under + 0.75)) < 1e-5,
          ("%d, %d: %g, %g"):format(x, y, seen, under))
      end
    end
  end)
end)

-- ---------------------------------------------------------------- cost

--- The cost of one frame of a scene of `count` things, as counters, which are the same on any
--- machine.
local function counters(scene, count)
  local bench = workbench.new()
  bench:write("scene.lua", ([[
local celspan = require "celspan"
local random = celspan.random(7)
local function at(i, k) return 64 * random(i .. k), 48 * random(k .. i) end
local objects = {}
for i = 1, %d do %s end
return celspan.rostrum { size = { 64, 48 }, celspan.cel(%s) }
]]):format(count, scene.item, scene.cel))
  local code, out, err =
    bench:celspan("spans '%s/scene.lua' --workers 1 --stats", bench.folder)
  assert.are.equal(0, code, err)
  bench:remove()
  local found = {}
  for name, number in out:gmatch "([%a_]+) (%d+)" do found[name] = tonumber(number) end
  return found
end

-- ---------------------------------------------------------------- crowds of translucent edges

local function point(random)
  return { SIDE * random:between(-0.2, 1.2), SIDE * random:between(-0.2, 1.2) }
end

local crowds = {}

--- Lines whose legs and joints cross each other.
function crowds.strokes(random, texture)
  return celspan.stroke { points = { point(random), point(random), point(random) },
                          width = random:between(0.05, 0.6), texture = texture }
end

function crowds.hair(random, texture)
  local a, b, c = point(random), point(random), point(random)
  return celspan.stroke { d = ("M%g %gQ%g %g %g %g"):format(a[1], a[2], b[1], b[2], c[1], c[2]),
                          width = 0.15, cap = "round", texture = texture }
end

crowds["even-odd stars"] = function(random, texture)
  local fields = { rule = "evenodd", texture = texture }
  for i = 1, 5 do fields[i] = point(random) end
  return celspan.polygon(fields)
end

--- Their tops and feet lie within a row of pixels.
function crowds.bars(random, texture)
  local at = point(random)
  return celspan.polygon { texture = texture, at, { at[1] + 2, at[2] },
                           { at[1] + 2.3, at[2] + 0.3 }, { at[1] + 0.3, at[2] + 0.3 } }
end

--- Much smaller than a pixel.
function crowds.specks(random, texture)
  local at, fields = point(random), { texture = texture }
  for i = 1, 3 do
    fields[i] = { at[1] + random:between(-0.3, 0.3), at[2] + random:between(-0.3, 0.3) }
  end
  return celspan.polygon(fields)
end

--- Triangles from edge to edge of the picture, in part as upright as its pixels.
function crowds.threads(random, texture)
  local x, y, lean = SIDE * random:between(0, 1), random:between(0.1, 1), random:between(-2, 2)
  local points = { texture = texture, { x, -1 }, { x + lean, SIDE + 1 },
                   { x + lean + y, SIDE + 1 } }
  if random:whole(0, 1) == 1 then points[2], points[3] = points[3], points[2] end
  return celspan.polygon(points)
end

--- Triangles that cover the picture, `count` squares of two a side; is_mixed: one of the two turns
--- the other way.
local function mesh(count, alpha, is_mixed)
  local random, corners, objects = prng.new(9), {}, {}
  local size, texture = SIDE / count, celspan.rgb(0, 0.5, 0, alpha)
  for j = 0, count do
    corners[j] = {}
    for i = 0, count do
      local moves = i > 0 and j > 0 and i < count and j < count
      local function move() return moves and 0.3 * random:between(-1, 1) or 0 end
      corners[j][i] = { size * (i + move()), size * (j + move()) }
    end
  end
  for j = 1, count do
    for i = 1, count do
      local a, b, c, d = corners[j - 1][i - 1], corners[j - 1][i], corners[j][i - 1], corners[j][i]
      objects[#objects + 1] = celspan.polygon { a, b, d, texture = texture }
      objects[#objects + 1] = is_mixed and celspan.polygon { c, d, a, texture = texture }
        or celspan.polygon { a, d, c, texture = texture }
    end
  end
  return celspan.cel(objects)
end

--- A cel of shapes of one kind; paint: makes the paint of each.
local function crowd(kind, count, seed, paint)
  local random, objects = prng.new(seed), {}
  for i = 1, count do objects[i] = crowds[kind](random, paint(random)) end
  return celspan.cel(objects)
end

--- A paint that hides at most a share of the light.
local function faint(share)
  return function(random)
    return celspan.rgb(random:between(0, 1), random:between(0, 1), random:between(0, 1), share)
  end
end

--- A gel that dims each colour differently.
local function gel(random)
  return celspan.gel(random:between(0.75, 1), random:between(0.75, 1), random:between(0.75, 1))
end

describe("crowds of translucent edges", function()
  it("show the mean of their area to within 1/255", function()
    for kind in pairs(crowds) do
      for seed = 1, 2 do
        compare(celspan.rostrum { back = "#fff", crowd(kind, 80, seed, faint(0.25)) }, kind, 1)
        compare(celspan.rostrum { crowd(kind, 60, 10 + seed, faint(0.5)) }, kind .. ", half", 1)
      end
    end
    compare(celspan.rostrum { back = "#fff", crowd("strokes", 80, 3, gel) }, "gels", 1)
    compare(celspan.rostrum { back = "#fff", crowd("specks", 3000, 4, faint(0.4)) }, "specks", 1)
    compare(celspan.rostrum { back = "#fff", crowd("threads", 80, 5, faint(0.25)) }, "threads", 0.1,
      0.05)
    compare(celspan.rostrum { crowd("threads", 80, 6, gel) }, "threads that dim colours", 0.1, 0.05)
    compare(celspan.rostrum { crowd("even-odd stars", 80, 7, faint(0.1)) }, "faint stars", 0.1,
      0.05)
  end)

  -- Where two triangles of a mesh abut, what lies behind both is hidden as much as in the middle of
  -- each; in every second mesh, half of the triangles turn the other way.
  it("leave no gap between shapes that abut", function()
    for _, alpha in ipairs { 0.5, 0.25, 0.08 } do
      for turn = 0, 1 do
        local rostrum = celspan.rostrum { back = "#f00", mesh(8 * SIDE, alpha, turn == 1) }
        local image, worst = shot(rostrum, SIDE), 0
        for y = 0, SIDE - 1 do
          for x = 0, SIDE - 1 do
            worst = math.max(worst, math.abs((image:get(x, y)) - (1 - alpha)))
          end
        end
        assert.is_true(worst < 0.05 / 255, ("alpha %g: %.4f of 255"):format(alpha, 255 * worst))
      end
    end
  end)

  it("show what opaque shapes behind and between them cover", function()
    local behind = celspan.rect { 1.3, 0, 2.4, 2 * SIDE, texture = "#135" }
    local before = celspan.circle { centre = { 4, 3 }, radius = 1.2, texture = "#fa0" }
    compare(celspan.rostrum { back = "#fff", celspan.cel { behind },
                              crowd("strokes", 60, 4, faint(0.25)), celspan.cel { before },
                              crowd("hair", 40, 5, faint(0.25)) }, "opaque", 2)
  end)

  it("are the same in any crop, and from any number of workers", function()
    local rostrum = celspan.rostrum { back = "#fff", crowd("strokes", 90, 7, faint(0.25)) }
    local whole = shot(rostrum, SIDE)
    local shared = shot(rostrum, SIDE, { workers = 3 })
    local part = shot(rostrum, SIDE, { crop = { 2, 1, 3, 4 } })
    for y = 0, 3 do
      for x = 0, 2 do
        assert.are.same({ whole:get(x + 2, y + 1) }, { part:get(x, y) })
        assert.are.same({ whole:get(x + 2, y + 1) }, { shared:get(x + 2, y + 1) })
      end
    end
  end)

  it("cost as much for each line, however many there are", function()
    local line = { cel = "objects", item = [[objects[i] = celspan.stroke { width = 0.4,
      points = { { at(i, "a") }, { at(i, "b") }, { at(i, "c") } },
      texture = celspan.rgb(random(i), 0.5, 0.5, 0.25) }]] }
    local few, many = counters(line, 400), counters(line, 1600)
    for _, name in ipairs { "peak_bytes", "allocations", "colour_evaluations" } do
      assert.is_true(many[name] < 5 * few[name], ("%s: %g, %g for a quarter of the lines")
        :format(name, many[name], few[name]))
    end
    assert.is_true(many.colour_evaluations < 1600, many.colour_evaluations .. " colours")
  end)
end)

describe("the cost of very many things", function()
  local square = { cel = "objects", item = [[local x, y = at(i, "a")
    objects[i] = celspan.rect { x, y, 3, 3, texture = celspan.rgb(random(i), 0.5, 0.5) }]] }
  local polygon = { cel = "{ celspan.polygon(objects) }", item = "objects[i] = { at(i, \"a\") }" }
  local curve = { cel = "{ celspan.nurbs { points = objects } }", item = polygon.item }

  it("is small for each opaque square, and grows with the visible ones", function()
    local few, many = counters(square, 4000), counters(square, 16000)
    assert.is_true(many.peak_bytes / 16000 < 500, many.peak_bytes .. " bytes")
    assert.is_true(many.colour_evaluations < 2 * few.colour_evaluations, many.colour_evaluations
      .. " colours, " .. few.colour_evaluations .. " for a quarter of the squares")
  end)

  it("grows at most linearly, within a factor of two, for polygons and curves", function()
    for _, scene in ipairs { polygon, curve } do
      local few, many = counters(scene, 2000), counters(scene, 8000)
      for _, name in ipairs { "peak_bytes", "allocations", "colour_evaluations" } do
        assert.is_true(many[name] < 8 * few[name],
          ("%s: %g, %g for a quarter"):format(name, many[name], few[name]))
      end
    end
  end)

  it("is bounded for each point of a polygon, however many are in a row of pixels", function()
    local many = counters(polygon, 64000)
    assert.is_true(many.peak_bytes / 64000 < 1100, many.peak_bytes / 64000 .. " bytes a point")
  end)
end)
