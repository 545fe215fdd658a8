-- Laws that hold for every scene: boolean algebra, hidden and clear cels, moves, scales, cuts.
local celspan = require "celspan"
local cases = require "tests.support.cases"
local prng = require "tests.support.prng"
local rows = require "tests.support.rows"
local scenes = require "tests.support.scenes"

local COUNT, ONLY = 50, cases.only
local AREA = 1e-5 -- the difference allowed between two orders of summing floats

local function each_case(test)
  for _, case in cases.of(COUNT) do test(case) end
end

local function shot(rostrum, size, film, antialias, crop)
  return assert(celspan.pixels(rostrum, { size = size, film = film or size, crop = crop,
                                          antialias = antialias, workers = 1 }))
end

--- Checks that pixel (x, y) of a is pixel (x + dx, y + dy) of b, wherever both exist.
local function assert_alike(a, b, tolerance, where, dx, dy)
  dx, dy = dx or 0, dy or 0
  for y = math.max(0, -dy), math.min(a.height, b.height - dy) - 1 do
    for x = math.max(0, -dx), math.min(a.width, b.width - dx) - 1 do
      local p, q = { a:get(x, y) }, { b:get(x + dx, y + dy) }
      for c = 1, 4 do
        if math.abs(p[c] - q[c]) > tolerance then
          error(("%s: pixel %d, %d: %s, but %s"):format(where, x, y, table.concat(p, " "),
                                                       table.concat(q, " ")), 2)
        end
      end
    end
  end
end

local function object(seed, options)
  local text, traits = scenes.object(seed, options)
  if ONLY then print(text) end
  return scenes.value(text), traits
end

-- ---------------------------------------------------------------- boolean algebra

--- The area of an object, in white.
local function presence(shape)
  local white = celspan.rect { -9, -9, 99, 99, texture = "#fff" }
  return celspan.rostrum { celspan.cel { celspan.clip(white, shape) } }
end

--- The laws of sets: pairs of objects that are present at the same places.
local laws = {
  { "A | A is A", function(a) return a | a, a end },
  { "A & A is A", function(a) return a & a, a end },
  { "A - A is nothing", function(a) return a - a, celspan.union {} end },
  { "A ~ A is nothing", function(a) return a ~ a, celspan.union {} end },
  { "A ~ B ~ B is A", function(a, b) return a ~ b ~ b, a end },
  { "(A ~ B) ~ B is A", function(a, b) return celspan.xor { celspan.xor { a, b }, b }, a end },
  { "A | B is B | A", function(a, b) return a | b, b | a end },
  { "A ~ B is (A | B) - (A & B)", function(a, b) return a ~ b, (a | b) - (a & b) end },
  { "A - B is A & (U - B)", function(a, b, _, u) return a - b, a & (u - b) end },
  { "U - (A | B) is (U - A) & (U - B)", function(a, b, _, u)
    return u - (a | b), (u - a) & (u - b)
  end },
  { "U - (A & B) is (U - A) | (U - B)", function(a, b, _, u)
    return u - (a & b), (u - a) | (u - b)
  end },
  { "A & (B | C) is (A & B) | (A & C)", function(a, b, c)
    return a & (b | c), (a & b) | (a & c)
  end },
  { "A | (B & C) is (A | B) & (A | C)", function(a, b, c)
    return a | (b & c), (a | b) & (a | c)
  end },
  { "A - B - C is A - (B | C)", function(a, b, c) return a - b - c, a - (b | c) end },
  { "clip(A, B) is A & B", function(a, b) return celspan.clip(a, b), a & b end },
}

describe("boolean algebra", function()
  for _, law in ipairs(laws) do
    it(law[1], function()
      each_case(function(case)
        local a, traits = object(3 * case)
        local b, c = object(3 * case + 1), object(3 * case + 2)
        local left, right = law[2](a, b, c, celspan.rect { -99, -99, 299, 299 })
        local film = { traits.width, traits.height }
        for antialias, tolerance in pairs { none = 0, area = AREA } do
          assert_alike(shot(presence(left), film, film, antialias),
                       shot(presence(right), film, film, antialias), tolerance,
                       ("CASE=%d under %s"):format(case, antialias))
        end
      end)
    end)
  end
end)

-- ---------------------------------------------------------------- cels that are not seen

describe("a cel that cannot be seen", function()
  local function compare_with(make, case, options)
    local a, traits = object(2 * case, options)
    local b = object(2 * case + 1, options)
    local film = { traits.width, traits.height }
    -- Only the places where gradients are divided may differ.
    local tolerances = options.is_flat and { none = 0, area = AREA }
      or { none = 1 / 1023, area = 1 / 1023 }
    for antialias, tolerance in pairs(tolerances) do
      local with, without = make(celspan.cel { a }, celspan.cel { b })
      assert_alike(shot(with, film, film, antialias), shot(without, film, film, antialias),
        tolerance,
                   ("CASE=%d under %s"):format(case, antialias))
    end
  end

  -- The edges of scan-line primitives are sampled at heights that depend on the edges around them,
  -- so their scenes contain no other special parts.
  local function compare(make)
    each_case(function(case)
      compare_with(make, case, case % 2 == 0 and { is_flat = true, has_rows = false }
                                or { has_rows = true, is_plain = true })
      compare_with(make, case, { has_rows = false })
    end)
  end

  local cover = celspan.cel { celspan.rect { -99, -99, 299, 299, texture = "#9a4" } }

  it("changes nothing behind an opaque one", function()
    compare(function(a, b)
      return celspan.rostrum { b, cover, a }, celspan.rostrum { cover, a }
    end)
  end)

  it("changes nothing when it is clear", function()
    compare(function(a, b)
      return celspan.rostrum { a, b:with { opacity = 0 } }, celspan.rostrum { a }
    end)
    compare(function(a, b)
      local clear = celspan.cel { celspan.circle { centre = { 9, 9 }, radius = 7,
        texture = celspan.clear } }
      return celspan.rostrum { a, clear, b }, celspan.rostrum { a, b }
    end)
  end)

  it("changes nothing when it is empty or scaled to nothing", function()
    compare(function(a, b)
      return celspan.rostrum { a, b:scale(0) }, celspan.rostrum { a }
    end)
    compare(function(a, b)
      return celspan.rostrum { celspan.cel {}, a, b }, celspan.rostrum { a, b }
    end)
  end)
end)

-- ---------------------------------------------------------------- moves, scales, cuts

--- Shapes with coordinates of few bits, so that moves and doublings are exact.
local function dyadic_objects(seed)
  local random, list = prng.new(seed), {}
  local function coordinate() return random:whole(-10240, 51200) / 1024 end
  for i = 1, 6 do
    local paint = celspan.rgb(random:between(0, 1), random:between(0, 1), random:between(0, 1),
                              random:between(0.3, 1))
    local points = { texture = paint, rule = random:pick { "nonzero", "evenodd" } }
    for k = 1, random:whole(3, 7) do points[k] = { coordinate(), coordinate() } end
    list[i] = celspan.polygon(points)
  end
  return list
end

describe("a move by whole pixels", function()
  it("moves the pixels", function()
    each_case(function(case)
      local cel, random = celspan.cel(dyadic_objects(case)), prng.new(-case)
      local dx, dy, size = random:whole(-9, 9), random:whole(-9, 9), { 48, 40 }
      for antialias, tolerance in pairs { none = 0, area = AREA } do
        assert_alike(shot(celspan.rostrum { cel }, size, size, antialias),
                     shot(celspan.rostrum { cel:translate(dx, dy) }, size, size, antialias),
                     tolerance,
                     ("CASE=%d under %s"):format(case, antialias), dx, dy)
      end
    end)
  end)
end)

describe("a curve moved by whole pixels", function()
  it("moves its pixels, with an error of at most two codes", function()
    each_case(function(case)
      local random = prng.new(case)
      local function point() return { random:between(-5, 50), random:between(-5, 45) } end
      local points = { point(), point(), point(), point(), point() }
      local curve = celspan.nurbs { points = points, texture = "#08f" }
      local dx, dy, size = random:whole(-9, 9), random:whole(-9, 9), { 48, 40 }
      assert_alike(shot(celspan.rostrum { celspan.cel { curve } }, size, size, "area"),
                   shot(celspan.rostrum { celspan.cel { curve:translate(dx, dy) } }, size, size,
                     "area"),
                   2 / 255, "CASE=" .. case, dx, dy)
    end)
  end)
end)

describe("scene and view scaled by two", function()
  it("are the same picture, span by span", function()
    each_case(function(case)
      local cel, size = celspan.cel(dyadic_objects(case)), { 53, 37 }
      for _, antialias in ipairs { "none", "area" } do
        local function text(rostrum, film)
          local options = { size = size, film = film, antialias = antialias }
          return rows.text(assert(celspan.spans(rostrum, options)), 0, size[2] - 1)
        end
        local once = text(celspan.rostrum { cel }, size)
        local twice = celspan.rostrum { cel:scale(2) }
        assert(once == text(twice, { 106, 74 }), ("CASE=%d under %s"):format(case, antialias))
        local seen = celspan.rostrum { cel:scale(2):with { viewport = { 0, 0, 106, 74 } } }
        assert(once == text(seen, size), ("CASE=%d, viewport, under %s"):format(case, antialias))
      end
    end)
  end)
end)

describe("a viewport", function()
  it("shows that part of the whole, enlarged", function()
    each_case(function(case)
      local cel, random = celspan.cel(dyadic_objects(case)), prng.new(-case)
      local x, y = random:whole(0, 16), random:whole(0, 12)
      local cut = cel:with { viewport = { x, y, 16, 12 } }
      local camera = { centre = { x + 8, y + 6 }, width = 16 }
      for antialias, tolerance in pairs { none = 0, area = AREA } do
        local where = ("CASE=%d under %s"):format(case, antialias)
        local film, crop = { 32, 24 }, { 2 * x, 2 * y, 32, 24 }
        local whole = shot(celspan.rostrum { cel }, { 64, 48 }, film, antialias, crop)
        local panned = shot(celspan.rostrum { cut }, film, film, antialias)
        local filmed = shot(celspan.rostrum { cel, camera = camera }, film, film, antialias)
        assert_alike(panned, whole, tolerance, where)
        assert_alike(filmed, whole, tolerance, where .. ", camera")
      end
    end)
  end)
end)

describe("a gradient of one colour", function()
  it("is the flat paint", function()
    local paint = celspan.paint { pigment = { 0.2, 0.5, 1 }, medium = { 1, 0.5, 0.25 },
      beta = 0.625 }
    local textures = {
      celspan.gradient { { 0, 0, paint }, { 30, 3, paint }, { 5, 40, paint } },
      celspan.linear { from = { 0, 0 }, to = { 30, 9 }, { 0, paint }, { 0.5, paint },
        { 1, paint } },
      celspan.radial { centre = { 9, 9 }, radius = 20, { 0, paint }, { 1, paint } },
    }
    local ground = celspan.rect { 5, 5, 20, 20, texture = "#fa0" }
    local function picture(texture)
      local disc = celspan.circle { centre = { 16, 12 }, radius = 11, texture = texture }
      return celspan.rostrum { celspan.cel { ground, disc } }
    end
    for antialias in pairs { none = 0, area = 0 } do
      local flat = shot(picture(paint), { 32, 24 }, nil, antialias)
      for _, texture in ipairs(textures) do
        assert_alike(flat, shot(picture(texture), { 32, 24 }, nil, antialias), 1e-5, antialias)
      end
    end
  end)
end)
