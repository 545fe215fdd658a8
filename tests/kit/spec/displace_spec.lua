-- Objects that show other points: displaced, and blurred along lines, rays and arcs. A second
-- implementation reads the sharp pixels of the same art here; `probe` sees displacement.
local celspan = require "celspan"
local raised = require("tests.support.raised").message

local W, H = 96, 72

local function encode(x) return x <= 0.0031308 and 12.92 * x or 1.055 * x ^ (1 / 2.4) - 0.055 end
local function unit(x) return math.max(0, math.min(1, x)) end

local function rostrum(object, space)
  return celspan.rostrum { space = space, celspan.cel { object } }
end

local function seen(object, options)
  options = options or {}
  options.size = options.size or { W, H }
  return assert(celspan.pixels(rostrum(object, options.space), { size = options.size,
    film = options.film, crop = options.crop, workers = options.workers }))
end

--- Art that varies, is clear in places, and ends inside the frame.
local function art()
  return celspan.group {
    celspan.rect { 8, 6, 80, 60, texture = celspan.linear { from = { 8, 6 }, to = { 88, 66 },
      { 0, "#e03010" }, { 0.5, "#f0e0c0" }, { 1, "#1040c0" } } },
    celspan.circle { centre = { 40, 36 }, radius = 14, texture = "#10a040" },
    celspan.circle { centre = { 70, 30 }, radius = 9, texture = "#ffffff80" } }
end

--- What displaces: both channels vary, and its alpha, too.
local function waves()
  return celspan.rect { 14, 10, 70, 52, texture = celspan.radial { centre = { 46, 34 }, radius = 48,
    { 0, "#f02000" }, { 0.6, "#40c080c0" }, { 1, "#1090f060" } } }
end

--- The pixel of an image, which is clear beyond it.
local function pixel(image, x, y)
  if x < 0 or y < 0 or x >= image.width or y >= image.height then return 0, 0, 0, 0 end
  return image:get(x, y)
end

--- The mix of four pixels around a point of the frame.
local function read(image, x, y)
  local i, j = math.floor(x - 0.5), math.floor(y - 0.5)
  local u, v, sum = x - 0.5 - i, y - 0.5 - j, {}
  local a, b = { pixel(image, i, j) }, { pixel(image, i + 1, j) }
  local c, d = { pixel(image, i, j + 1) }, { pixel(image, i + 1, j + 1) }
  for k = 1, 4 do
    sum[k] = (1 - v) * ((1 - u) * a[k] + u * b[k]) + v * ((1 - u) * c[k] + u * d[k])
  end
  return sum
end

--- Compares every third pixel of an image with want(x, y) at their centres.
local function compare(image, want, tolerance)
  local worst, where = 0, ""
  for y = 0, image.height - 1 do
    for x = y % 3, image.width - 1, 3 do
      local should = want(x + 0.5, y + 0.5)
      for c, value in ipairs { image:get(x, y) } do
        local off = math.abs(value - should[c])
        if off > worst then
          worst, where = off, ("pixel %d, %d, channel %d: %g, should be %g"):format(x, y, c, value,
            should[c])
        end
      end
    end
  end
  assert(worst <= tolerance, where)
end

-- ---------------------------------------------------------------- displacement

--- Places around a pixel's centre that a mix of pixels there may read.
local around = {}
for i = -3, 3 do
  for j = -3, 3 do around[#around + 1] = { 0.7 * i, 0.7 * j } end
end

local function probe(what, x, y) return { celspan.probe(what, x, y, { film = { W, H } }) } end

--- Whether one colour is around a point.
local function is_even(what, x, y)
  local want = probe(what, x, y)
  for _, d in ipairs(around) do
    for c, value in ipairs(probe(what, x + d[1], y + d[2])) do
      if value ~= want[c] then return false end
    end
  end
  return true
end

local CHANNELS = { r = 1, g = 2, b = 3, a = 4 }

--- How far the point at the centre of a pixel of `by` is moved, in pixels.
local function moves(by, x, y, options)
  local colour = { pixel(by, x, y) }
  local alpha = colour[4]
  if alpha == 0 then return 0, 0 end
  local function move(name)
    local channel = CHANNELS[name]
    local code = channel == 4 and alpha or colour[channel] / alpha
    if channel < 4 and options.space ~= "linear" then code = encode(code) end
    return options.scale * (unit(code) - 0.5)
  end
  return move(options.x or "r"), move(options.y or "g")
end

describe("a displaced object", function()
  it("ends within a pixel as its art does", function()
    local small = celspan.rect { 20.3, 10.6, 40.5, 30.25, texture = "#fff" }
    local by = celspan.rect { 0, 0, W, H, texture = "#fff" }
    local moved, want = seen(small:displace { by = by, scale = 2 }), seen(small:translate(-1, -1))
    compare(moved, function(x, y) return { want:get(x - 0.5, y - 0.5) } end, 1e-6)
    assert.same({ 1, 1, 1, 1 }, probe(rostrum(small:displace { by = by, scale = 2 }), 19.4, 20))
    for _, along in ipairs { { angle = 0 }, { angle = 90 } } do -- no light is lost
      local function light(object)
        local image, sum = seen(object), 0
        for y = 0, H - 1 do for x = 0, W - 1 do sum = sum + image:get(x, y) end end
        return sum
      end
      assert.near(light(small), light(small:blur(2, along)), 0.01)
    end
  end)

  for _, options in ipairs { { scale = 20 }, { scale = -31, x = "b", y = "r" },
    { scale = 12, x = "a", y = "g" }, { scale = 25, space = "linear" } } do
    local name = ("by %s%s, %g, %s"):format(options.x or "r", options.y or "g", options.scale,
      options.space or "srgb")
    it("shows p + scale (code - 0.5), " .. name, function()
      local sharp, by = seen(art()), seen(waves())
      local displaced = art():displace { by = waves(), scale = options.scale, x = options.x,
        y = options.y, space = options.space }
      compare(seen(displaced), function(x, y)
        local dx, dy = moves(by, math.floor(x), math.floor(y), options)
        return read(sharp, x + dx, y + dy)
      end, 2e-3)
    end)
  end

  it("is clear where a blur along a line is wider than all numbers of pixels", function()
    for _, angle in ipairs { 0, 90, 30 } do
      local bar = celspan.rect { 10 / 3000, 4 / 3000, 20 / 3000, 8 / 3000, texture = "#ffffff" }
      local image = seen(bar:blur(1e6, { angle = angle }),
        { size = { 64, 16 }, film = { 64 / 3000, 16 / 3000 } })
      for x = 0, 63, 9 do
        for _, channel in ipairs { image:get(x, 8) } do
          assert.is_true(channel >= 0 and channel < 0.01)
        end
      end
    end
  end)

  it("is the object itself where nothing moves it", function()
    local plain = seen(art())
    local far = celspan.circle { centre = { 300, 20 }, radius = 9 }
    compare(seen(art():displace { by = far }), function(x, y)
      return { plain:get(x // 1 | 0, y // 1 | 0) }
    end, 1e-3)
    assert.are_equal(seen(art()):get(40, 30), (seen(art():displace { by = waves(), scale = 0 })
      :get(40, 30)))
  end)

  it("is seen in its last columns, wherever they are", function()
    for edge = 56, 72 do
      local row = celspan.rect { edge - 30, 3, 30, 4, texture = "#fff" }
      local function pair(object)
        return celspan.rostrum { back = "#000", celspan.cel { object },
          celspan.cel { celspan.rect { 0, 6, W, 3, texture = "#804020" } } }
      end
      local moved = pair(row:displace { by = celspan.rect { 0, 0, W, 9 }, scale = 1e-9 })
      local options = { size = { W, 9 } }
      local one, two = celspan.pixels(moved, options), celspan.pixels(pair(row), options)
      for x = 0, W - 1 do
        assert.near((two:get(x, 4)), (one:get(x, 4)), 1e-6, ("%d, column %d"):format(edge, x))
      end
    end
  end)

  it("follows transforms, with what displaces it", function()
    local whole = art():displace { by = waves(), scale = 16 }
    local sharp = seen(whole, { size = { 4 * W, 4 * H }, film = { W, H } })
    local turned = seen(whole:rotate(90, 36, 36))
    local sum, count = 0, 0
    for y = 12, 60, 3 do
      for x = 12, 60, 3 do
        local want = read(sharp, 4 * (y + 0.5), 4 * (72 - x - 0.5))
        local got = { turned:get(x, y) }
        for c = 1, 4 do sum, count = sum + math.abs(want[c] - got[c]), count + 1 end
      end
    end
    assert.is_true(sum / count < 0.01, sum / count) -- edges are sharper in the larger frame
  end)

  it("is seen by probe, which shares no code with it", function()
    local flat = celspan.group { celspan.rect { 8, 6, 40, 60, texture = "#e03010" },
      celspan.rect { 48, 6, 40, 60, texture = "#2050c0" } }
    local by = celspan.group { celspan.rect { 20, 10, 20, 50, texture = "#ff4000" },
      celspan.rect { 40, 10, 40, 50, texture = "#80c010a0" } }
    for _, place in ipairs { function(o) return o end, function(o) return o:rotate(25, 48, 36) end,
      function(o) return o:scale(0.7, 1.2, 48, 36) end } do
      local shown = place(flat:displace { by = by, scale = 18 })
      local image, compared = seen(shown), 0
      local bare, mover = rostrum(shown), rostrum(place(by))
      for y = 2, H - 3, 3 do
        for x = 2, W - 3, 3 do
          if is_even(bare, x + 0.5, y + 0.5) and is_even(mover, x + 0.5, y + 0.5) then
            compared = compared + 1
            local want = probe(bare, x + 0.5, y + 0.5)
            for c, value in ipairs { image:get(x, y) } do
              assert(math.abs(value - want[c]) < 1e-3,
                ("pixel %d, %d: %g, should be %g"):format(x, y, value, want[c]))
            end
          end
        end
      end
      assert.is_true(compared > 350, compared)
    end
  end)

  it("may be displaced by itself, by a rostrum, and again", function()
    local itself = art()
    local by = celspan.rostrum { size = { W, H }, back = { 1, 1, 1, 1 }, celspan.cel { waves() } }
    local again = itself:displace { by = itself }:displace { by = by, scale = 9 }
    assert.is_true(({ seen(again):get(40, 36) })[4] > 0.5)
  end)

  it("reads the last row of a grid of one band and a row", function()
    local tall = celspan.rect { 40, 60, 100, 61, texture = "#d8a060" }
    local moved = tall:displace { by = celspan.rect { 40, 60, 100, 61, texture = "#808080" },
      scale = 400 }
    local image = seen(moved, { size = { 200, 400 } })
    assert.is_true(select(4, image:get(90, 90)) > 0.9)
  end)

  it("is as large as its matrix says, also where the last number is not 1", function()
    local square = celspan.rect { 5, 5, 20, 20, texture = "#fff" }
    local by = celspan.rect { 0, 0, 90, 70, texture = "#fff" }
    local moved = square:displace { by = by, x = "r", y = "a", scale = 20 }
    local doubled = moved:transform { 2, 0, 0, 0, 2, 0, 0, 0, 2 }
    local image = seen(moved)
    compare(seen(doubled), function(x, y) return { image:get(x - 0.5, y - 0.5) } end, 1e-6)
  end)

  it("has bounds that it can reach", function()
    local box = { art():displace { by = waves(), scale = 20 }:bounds() }
    assert.are_same({ -2, -4, 100, 80 }, box)
  end)

  it("keeps its mode outermost", function()
    local back = celspan.rect { 0, 0, W, H, texture = "#808080" }
    local by = celspan.circle { centre = { 300, 20 }, radius = 9 }
    local function over(object) return seen(celspan.group { back, object }) end
    local plain = over(art():blend("multiply"))
    compare(over(art():blend("multiply"):displace { by = by }), function(x, y)
      return { plain:get(x // 1 | 0, y // 1 | 0) }
    end, 1e-3)
  end)
end)

-- ---------------------------------------------------------------- blurs with a direction

--- The mean of the sharp pixels on the way of a blur.
local function blurred(sharp, way)
  local COUNT = 64
  return function(x, y)
    local sum = { 0, 0, 0, 0 }
    for k = 1, COUNT do
      local qx, qy = way(x, y, (2 * k - 1) / COUNT - 1)
      local value = read(sharp, qx, qy)
      for c = 1, 4 do sum[c] = sum[c] + value[c] / COUNT end
    end
    return sum
  end
end

local blurs = {
  { "a line", 9, { angle = 0 }, function(x, y, t) return x + 9 * t, y end },
  { "a steep line", 7.3, { angle = 117 }, function(x, y, t)
    local a = math.rad(117)
    return x + 7.3 * t * math.cos(a), y + 7.3 * t * math.sin(a)
  end },
  { "rays", 20, { zoom = { 30, 40 } }, function(x, y, t)
    return 30 + (x - 30) * (1 + 0.2 * t), 40 + (y - 40) * (1 + 0.2 * t)
  end },
  { "arcs", 15, { spin = { 50, 30 } }, function(x, y, t)
    local c, s = math.cos(math.rad(15) * t), math.sin(math.rad(15) * t)
    return 50 + (x - 50) * c - (y - 30) * s, 30 + (x - 50) * s + (y - 30) * c
  end },
}

describe("an object that is blurred along", function()
  for _, blur in ipairs(blurs) do
    it(blur[1] .. " is the mean of what lies there", function()
      local sharp = seen(art())
      compare(seen(art():blur(blur[2], blur[3])), blurred(sharp, blur[4]), 0.03)
    end)
  end

  it("the same way follows its transforms", function()
    local a = seen(art():blur(6, { angle = 0 }):rotate(90, 36, 36))
    local b = seen(art():rotate(90, 36, 36):blur(6, { angle = 90 }))
    compare(a, function(x, y) return { b:get(x // 1 | 0, y // 1 | 0) } end, 2e-3)
  end)

  it("a line may continue at its edges", function()
    local plain = celspan.rect { 10, 10, 60, 40, texture = "#c08040" }
    local image = seen(plain:blur(12, { angle = 0, edge = "extend" }))
    compare(image, function(x, y)
      local inside = x > 10 and x < 70 and y > 10 and y < 50
      return inside and { seen(plain):get(30, 30) } or { 0, 0, 0, 0 }
    end, 2e-3)
    assert.are_same({ 10, 10, 60, 40 }, { plain:blur(12, { angle = 0, edge = "extend" }):bounds() })
  end)

  it("rays is drawn up to the horizon of a perspective", function()
    for _, way in ipairs { { 61, 28, -0.054, -0.03, -33, 93, 50 },
      { 82, 54, -0.039, -0.022, -20, 96, 18 }, { 93, 66, -0.039, -0.008, -28, 86, 16 } } do
      local high, radius, a, b, down, x, y = table.unpack(way)
      local rays = celspan.rect { 0, 0, 20, high, texture = "#fff" }
        :blur(radius, { zoom = { x, y } })
      local seen_rays = seen(rays:transform { 1, 0, 0, 0, 1, down, a, b, 2 - 21 * a },
        { size = { 36, 36 } })
      assert.is_true(select(4, seen_rays:get(4, 2)) <= 1)
    end
  end)

  it("any way has the bounds of what can be seen", function()
    local square = celspan.rect { 10, 10, 20, 20 }
    local function bounds(...)
      local box = { square:blur(...):bounds() }
      for i = 1, 4 do box[i] = math.floor(box[i] * 1000 + 0.5) / 1000 end
      return box
    end
    assert.are_same({ 5, 10, 30, 20 }, bounds(5, { angle = 180 }))
    assert.are_same({ 6.464, 6.464, 27.071, 27.071 }, bounds(5, { angle = 45 }))
    assert.are_same({ 0, 0, 40, 40 }, bounds(50, { zoom = { 20, 20 } }))
    assert.are_same({ 5.858, 5.858, 28.284, 28.284 }, bounds(50, { spin = { 20, 20 } }))
    assert.are_same({ 9.166, 9.166, 21.667, 21.667 }, bounds(5, { spin = { 20, 20 } }))
  end)
end)

-- ---------------------------------------------------------------- the same bits

describe("what is read elsewhere", function()
  local all = { art():displace { by = waves() }, art():blur(8, { angle = 20 }),
    art():blur(12, { zoom = { 10, 10 } }):displace { by = art() } }

  it("is the same in crops and with any number of workers", function()
    for _, object in ipairs(all) do
      local whole = seen(object, { workers = 1 })
      local part = seen(object, { crop = { 31, 17, 40, 30 }, workers = 3 })
      for y = 0, 29 do
        for x = 0, 39 do
          assert.are_same({ whole:get(x + 31, y + 17) }, { part:get(x, y) })
        end
      end
    end
  end)

  it("is an operand of its own size", function()
    local big = celspan.rect { 0, 0, 64, 64, texture = "#f00" }
    local moved = celspan.rect { 20, 20, 10, 20, texture = "#fff" }:blur(1, { angle = 0 })
    for _, object in ipairs { celspan.difference { big, moved },
      celspan.intersection { big, moved }, celspan.union { moved, big } } do
      local made = seen(object, { size = { 64, 64 }, film = { 64, 64 } })
      for x = 15, 33 do
        local want = probe(rostrum(object), x + 0.5, 30.5)[4]
        local _, _, _, got = made:get(x, 30)
        if want == 0 or want == 1 then assert.is_true(math.abs(got - want) < 0.02, x) end
      end
    end
  end)

  it("is kept in span files, and refused by planes, which have no pixels", function()
    for _, object in ipairs(all) do
      local rows = assert(celspan.spans(rostrum(object), { size = { W, H } }))
      local kinds = {}
      for _, span in ipairs(rows[H // 2]) do kinds[span.kind] = true end
      assert.is_true(kinds.array)
      local plane, message = celspan.plane(rostrum(object), { film = { W, H } })
      assert.is_nil(plane)
      assert(message:find("displaced, or blurred in a direction", 1, true), message)
    end
  end)
end)

-- ---------------------------------------------------------------- what is refused

describe("messages", function()
  local function refused(pattern, call)
    local message = raised(call)
    assert(message:find(pattern, 1, true), message)
  end

  it("say what is wrong with a displacement", function()
    refused("displace: field 'by' must be an object, got nil",
            function() return art():displace { scale = 3 } end)
    refused("displace: field 'by' must be an object, got string",
            function() return art():displace { by = "#fff" } end)
    refused("scale", function() return art():displace { by = art(), scale = 0 / 0 } end)
    refused("scale", function() return art():displace { by = art(), scale = 2e6 } end)
    refused("x", function() return art():displace { by = art(), x = "red" } end)
    refused("space", function() return art():displace { by = art(), space = "lab" } end)
  end)

  it("say what is wrong with a blur", function()
    refused("give only one of 'angle', 'zoom' and 'spin'",
            function() return art():blur(3, { angle = 3, spin = { 1, 1 } }) end)
    refused("'kernel' does not go with", function()
      return art():blur(3, { angle = 3, kernel = "disc" })
    end)
    refused("radius is 91; it must be between 0 and 90",
            function() return art():blur(91, { zoom = { 1, 1 } }) end)
    refused("radius is 181; it must be between 0 and 180",
            function() return art():blur(181, { spin = { 1, 1 } }) end)
    refused("angle", function() return art():blur(1, { angle = 1 / 0 }) end)
    refused("zoom", function() return art():blur(1, { zoom = { 1 } }) end)
  end)

  it("say that too much would be read", function()
    local wide = celspan.rect { -1e6, -1e6, 2e6, 2e6, texture = "#fff" }
    local image, message = celspan.pixels(rostrum(wide:displace { by = art(), scale = 1e5 }),
      { size = { W, H } })
    assert.is_nil(image)
    assert(message:find("pixels would be read for the frame", 1, true), message)
  end)

  it("end nesting at its limit", function()
    refused("nested", function()
      local object = art()
      for _ = 1, 130 do object = object:displace { by = celspan.rect { 0, 0, 9, 9 } } end
      return object
    end)
  end)
end)
