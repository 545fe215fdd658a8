-- Objects that are bent: outlines as curves, pictures as meshes without seams.
local celspan = require "celspan"
local motion = require "celspan.motion"
local raised = require "tests.support.raised"
local workbench = require "tests.support.workbench"

local sin = math.sin

local function pixels(object, options)
  local film = celspan.film { size = { 64, 64 }, frame = function()
    return celspan.rostrum { celspan.cel { object } }
  end }
  return assert(celspan.pixels(film, options))
end

--- Texels of 64 x 64 colours, none of which is like another.
local function picture(alpha)
  local texels = {}
  for i = 0, 4095 do
    texels[i + 1] = string.char(i * 37 % 256, i * 91 % 256, i // 16, alpha)
  end
  return celspan.image { x = 0, y = 0, w = 64, h = 64, pixels = table.concat(texels),
                         size = { 64, 64 } }
end

local white = celspan.image { x = 8, y = 8, w = 48, h = 48, size = { 2, 2 },
                              pixels = ("\255"):rep(16) }

--- Waves on the right half; the left stays as it is.
local function half(x, y)
  local more = math.max(0, x - 32)
  return x, y + more * more * sin(x / 3) / 200
end

local function wave(x, y) return x + 3 * sin(y / 6), y + 4 * sin(x / 9) end

local function same(x, y) return x, y end

describe("a warp", function()
  it("leaves a picture as it is, to the bit, where the map does", function()
    local art = picture(255)
    local plain, bent = pixels(art):bytes(), pixels(art:warp { map = half }):bytes()
    for y = 0, 63 do
      local from = 4 * 64 * y
      assert.are.equal(plain:sub(from + 1, from + 4 * 27), bent:sub(from + 1, from + 4 * 27))
    end
    assert.are_not.equal(plain, bent)
    assert.are.equal(plain, pixels(art:warp { map = same }):bytes())
  end)

  it("makes a mesh of hundreds of pieces that does not leak", function()
    for _, pieces in ipairs { 20, 400, 2000 } do
      local bent = white:warp { map = wave, pieces = pieces }
      local codes = pixels(bent:scale(1.37, 1.21, 32, 32)):bytes { depth = 16 }
      local is_inside, count = {}, 0 -- the corners of pixels, by row
      for i = 0, 65 * 65 - 1 do
        local x, y = i % 65, i // 65
        is_inside[i] = bent:contains(32 + (x - 32) / 1.37, 32 + (y - 32) / 1.21)
      end
      for y = 0, 63 do
        for x = 0, 63 do
          local i = 65 * y + x
          if is_inside[i] and is_inside[i + 1] and is_inside[i + 65] and is_inside[i + 66] then
            local at = 8 * (64 * y + x)
            assert.are.equal(("\255"):rep(8), codes:sub(at + 1, at + 8), x .. ", " .. y)
            count = count + 1
          end
        end
      end
      assert.is_true(count > 2000)
    end
  end)

  it("keeps outlines within a hundredth of a pixel, at 1,024 and at 1,048,576 a side", function()
    local disc = celspan.circle { centre = { 32, 32 }, radius = 32 }
    local square = celspan.rect { 0, 0, 64, 64 }
    local function inside(object, x, y, dx, dy, side)
      local step = 0.01 * 64 / side
      return object:contains(x + step * dx, y + step * dy)
    end
    for _, side in ipairs { 1024, 1048576 } do
      local round, straight = disc:warp { map = wave }, square:warp { map = wave }
      for i = 1, 400 do
        local angle = i * 0.1
        local c, s = math.cos(angle), sin(angle)
        local x, y = wave(32 + 32 * c, 32 + 32 * s)
        -- across the image of the circle
        local tx = -s + 3 * math.cos((32 + 32 * s) / 6) * c / 6
        local ty = c - 4 * math.cos((32 + 32 * c) / 9) * s / 9
        local length = math.sqrt(tx * tx + ty * ty)
        assert.is_false(inside(round, x, y, ty / length, -tx / length, side))
        assert.is_true(inside(round, x, y, -ty / length, tx / length, side))
        x, y = wave(i * 0.15, 0)
        assert.is_false(inside(straight, x, y, 0, -1, side))
        assert.is_true(inside(straight, x, y, 0, 1, side))
      end
    end
  end)

  it("bends strokes, texts, groups and booleans, and keeps fades, modes and names", function()
    local line = celspan.stroke { points = { { 4, 32 }, { 60, 32 } }, width = 4 }
    local bent = line:warp { map = wave }
    for x = 8, 56, 4 do
      local u, v = wave(x, 32)
      assert.is_true(bent:contains(u, v))
      assert.is_false(bent:contains(u, v - 4))
    end
    local ring = celspan.circle { centre = { 32, 32 }, radius = 20, texture = "#f00" }:named "ring"
      - celspan.circle { centre = { 32, 32 }, radius = 10 }:translate(2, 0)
    local group = celspan.group { ring:fade(0.5), blend = "multiply" }:named "both"
    local made = group:warp { map = wave }
    assert.are.equal("multiply", made.mode)
    assert.are.equal("both", made.name)
    assert.is_false(made:contains(wave(34, 32)))
    assert.is_true(made:contains(wave(47, 32)))
    local _, _, _, a = celspan.probe(celspan.rostrum { celspan.cel { made } }, wave(47, 32))
    assert.are.equal(0.5, a)
    local hidden = celspan.matte(ring, ring, { invert = true }):warp { map = wave }
    assert.are.equal(0, (celspan.probe(celspan.rostrum { celspan.cel { hidden } }, wave(47, 32))))
    local light = celspan.group { ring, grade = { exposure = -1 } }:warp { map = wave }
    assert.are.equal(0.5, (celspan.probe(celspan.rostrum { celspan.cel { light } }, wave(47, 32))))
  end)

  it("bends each contour of an outline by itself", function()
    local path = celspan.path { rule = "evenodd",
      d = "M4 4H60V60H4ZM10 10H30V30H10ZM40 40H50V50H40Z" }
    local bent = path:warp { map = wave }
    for x = 7, 57, 2 do
      for y = 7, 57, 2 do
        assert.are.equal(path:contains(x, y), bent:contains(wave(x, y)), x .. ", " .. y)
      end
    end
  end)

  it("takes gradients along", function()
    local art = celspan.rect { 0, 0, 64, 64, texture = celspan.linear {
      from = { 0, 0 }, to = { 64, 0 }, { 0, "#000" }, { 1, "#fff" } } }
    local bent = celspan.rostrum { celspan.cel { art:warp { map = wave, pieces = 2000 } } }
    for x = 4, 60, 7 do
      for y = 4, 60, 7 do
        local u, v = wave(x, y)
        local red = celspan.probe(bent, u, v)
        assert.is_near(x / 64, red, 0.01)
      end
    end
  end)

  it("goes along a path, and on straight beyond its end", function()
    local bar = celspan.rect { 10, 20, 100, 4 }
    local bent = bar:warp { along = "M 0 50 A 50 50 0 0 1 100 50" }
    for i = 1, 99 do
      local angle = math.pi - i / 50
      assert.is_true(bent:contains(50 + 50 * math.cos(angle), 50 - 50 * sin(angle)))
      assert.is_false(bent:contains(50 + 47 * math.cos(angle), 50 - 47 * sin(angle)))
    end
    local whole = bar:warp { along = celspan.path { d = "M 0 0 H 60 V 0 H 80" }, stretch = true }
    assert.are.same({ 0, -2, 80, 4 }, { whole:bounds() })
    local late = bar:warp { along = "M 0 0 H 60", start = 0.5 }
    assert.are.same({ 30, -2, 100, 4 }, { late:bounds() })
  end)

  it("follows lattices, straight or smooth", function()
    local box = celspan.rect { 0, 0, 20, 20 }
    local function bent(smooth)
      return box:warp { lattice = { columns = 2, rows = 1, smooth = smooth, points = {
        { 0, 0 }, { 10, 8 }, { 20, 0 }, { 0, 20 }, { 10, 20 }, { 20, 20 } } } }
    end
    assert.is_true(bent(false):contains(5, 4.01) and not bent(false):contains(5, 3.99))
    assert.is_true(bent(true):contains(10, 8.01) and not bent(true):contains(10, 7.99))
    assert.is_false(bent(true):contains(5, 4.01))
    assert.are.same({ 0, 0, 20, 20 }, { box:warp { lattice = { columns = 1, rows = 1, points = {
      { 0, 0 }, { 20, 0 }, { 0, 20 }, { 20, 20 } } } }:bounds() })
  end)

  it("follows bones, each hanging on the one before it", function()
    local arm = celspan.rect { 0, -5, 120, 10 }
    local function bent(more)
      local lower = { "lower", from = { 60, 0 }, to = { 120, 0 }, rotate = 90 }
      for key, value in pairs(more or {}) do lower[key] = value end
      return arm:warp { bones = { { "upper", from = { 0, 0 }, to = { 60, 0 } }, lower } }
    end
    assert.is_true(bent():contains(10, 0) and bent():contains(60, 50))
    assert.is_false(bent():contains(110, 0))
    local x, y, w, h = bent({ scale = 2 }):bounds()
    assert.is_near(0, x, 1)
    assert.is_near(-5, y, 2)
    assert.is_true(w < 70 and h > 120)
    assert.is_true(bent({ parent = false, rotate = 0, at = { 60, 3 } }):contains(115, 7))
  end)

  it("follows bones by weights that are painted, and by distance where they are missing", function()
    local sheet = celspan.rect { 0, 0, 100, 100 }
    local function moved(weight, other)
      return sheet:warp { bones = {
        { from = { 0, 0 }, to = { 0, 10 }, parent = false, weight = other },
        { from = { 100, 0 }, to = { 100, 10 }, parent = false, at = { 100, 40 },
          weight = weight } } }
    end
    local function clear() return 0 end
    -- the paint grows from the top to the bottom, where all follows the second bone
    local paint = celspan.rect { 0, -50, 100, 200, texture = celspan.linear { from = { 0, 0 },
      to = { 0, 100 }, { 0, "#fff0" }, { 1, "#fff" } } }
    local x, y, w, h = moved(paint):bounds()
    assert.is_near(0, math.max(math.abs(x), math.abs(y), math.abs(w - 100)), 0.2)
    assert.is_near(140, h, 0.5) -- the end of the paint is smoothed
    -- half of the weight is painted; the other half belongs to the bone without a weight
    h = select(4, moved(function() return 0.5 end):bounds())
    assert.is_near(100, h, 1e-6)
    assert.is_near(20, select(2, moved(function() return 0.5 end):bounds()), 1e-6)
    -- weights above one are shares of their sum
    local three, one = function() return 3 end, function() return 1 end
    assert.is_near(30, select(2, moved(three, one):bounds()), 1e-6)
    -- where nothing is painted the nearest bone has the point
    assert.is_true(moved(clear, clear):contains(99, 41) and moved(clear, clear):contains(1, 1))
    assert.is_false(moved(clear, clear):contains(99, 30))
    -- an object without paint has no weight
    assert.are.same({ moved(celspan.union {}):bounds() }, { 0, 0, 100, 100 })
  end)

  it("puts pins where they must be, and turns what hangs on them", function()
    local cloth = celspan.rect { 0, 0, 40, 40 }
    local moved = cloth:warp { pins = { { from = { 0, 0 }, to = { 10, 5 } },
                                        { from = { 40, 0 }, to = { 50, 5 } } } }
    local x, y, w, h = moved:bounds()
    for i, number in ipairs { x - 10, y - 5, w - 40, h - 40 } do
      assert.is_near(0, number, 1e-9, i)
    end
    local held = cloth:warp { pins = { { from = { 0, 0 } }, { from = { 40, 0 } },
                                       { from = { 20, 40 }, to = { 30, 44 } } } }
    assert.is_true(held:contains(30, 43) and held:contains(0.1, 0.1))
  end)

  it("refuses maps that jump, fold or give no numbers, with their line", function()
    local box = celspan.rect { 0, 0, 20, 20 }
    raised.each {
      ["warp: the map jumps at the point 10, 0, from 10, 0 to 15, 0"] = function()
        box:warp { map = function(x, y) return x < 10 and x or x + 5, y end }
      end,
      ["warp: the map folds the object near the point"] = function()
        white:warp { map = function(x, y) return math.abs(x - 30), y end }
      end,
      ["two finite numbers, got nan and 0.0"] = function()
        box:warp { map = function(_, y) return 0 / 0, y end }
      end,
      ["two finite numbers, got 0.0 and nil"] = function()
        box:warp { map = function(x) return x end }
      end,
      ["arithmetic on a nil value"] = function()
        box:warp { map = function(x, y) return x + nil, y end } -- luacheck: ignore
      end,
      ["warp: the map is too rough"] = function()
        box:warp { map = function(x, y) return x, y + 1e-5 * sin(x * 1e6) end }
      end,
    }
  end)

  it("refuses what it cannot bend, and wrong fields", function()
    local box = celspan.rect { 0, 0, 20, 20 }
    raised.each {
      ["or what is blurred, has a soft shadow"] = function() box:blur(3):warp { map = same } end,
      ["a scan-line procedure cannot be bent"] = function()
        celspan.scanline { bounds = { 0, 0, 9, 9 }, spans = function() end }:warp { map = same }
      end,
      ["give one of along, bones, lattice, map and pins"] = function() box:warp {} end,
      ["along and map are given"] = function() box:warp { map = same, along = "M0 0" } end,
      ["did you mean 'lattice'"] = function() box:warp { latice = {} } end,
      ["pieces is 3"] = function() box:warp { map = same, pieces = 3 } end,
      ["within is -1"] = function() box:warp { map = same, within = -1 } end,
      ["have 6 points, got 1"] = function()
        box:warp { lattice = { columns = 2, rows = 1, points = { { 0, 0 } } } }
      end,
      ["bone 1: its length must be above 0"] = function()
        box:warp { bones = { { from = { 1, 1 }, to = { 1, 1 } } } }
      end,
      ["bone 1: its weight must be an object or a function(x, y), got number"] = function()
        box:warp { bones = { { from = { 1, 1 }, to = { 2, 1 }, weight = 1 } } }
      end,
      ["bone 1: its weight must be 0 or more everywhere, got -1 at"] = function()
        local function less() return -1 end
        box:warp { bones = { { from = { 1, 1 }, to = { 2, 1 }, weight = less } } }
      end,
      ["its parent must be false, or the number or name"] = function()
        box:warp { bones = { { from = { 1, 1 }, to = { 2, 1 }, parent = "x" } } }
      end,
      ["pins 1 and 2 are at one place"] = function()
        box:warp { pins = { { from = { 1, 1 } }, { from = { 1, 1 } } } }
      end,
      ["the path has no length"] = function() box:warp { along = "M 3 3" } end,
      ["reaches the horizon of its perspective"] = function()
        box:transform { 1, 0, 0, 0, 1, 0, -0.1, 0, 1 }:warp { map = same }
      end,
    }
    local empty = celspan.union {}
    assert.are.equal(empty, empty:warp { map = same })
  end)
end)

describe("a boil", function()
  local square = celspan.rect { 12, 12, 40, 40, texture = "#000000" }

  local function boiled(frame, fields)
    local options = { amount = 2, frame = frame, grain = 16 }
    for name, value in pairs(fields or {}) do options[name] = value end
    return pixels(square:boil(options)):bytes()
  end

  it("holds each drawing, and gives the same for the same seed", function()
    assert.equal(boiled(0), boiled(1))
    assert.equal(boiled(0), boiled(1.9))
    assert.not_equal(boiled(0), boiled(2))
    assert.equal(boiled(2), boiled(5, { every = 3 }))
    assert.not_equal(boiled(0), boiled(0, { seed = "other" }))
    assert.equal(boiled(4, { every = 4 }), boiled(7, { every = 4 }))
    assert.equal(pixels(square):bytes(), boiled(3, { amount = 0 }))
  end)

  it("moves no point by more than the amount", function()
    for frame = 0, 18, 2 do
      local x, y, w, h = square:boil { amount = 2, frame = frame }:bounds()
      assert.is_true(x >= 10 and y >= 10 and x + w <= 54 and y + h <= 54)
    end
  end)

  --- The same movement in Lua, by motion.noise.
  local function map_of(options)
    local grain, step = options.grain, options.frame // options.every
    local across = motion.noise(options.seed .. " across")
    local down = motion.noise(options.seed .. " down")
    local function at(i, j)
      return options.amount * across(i, j, step), options.amount * down(i, j, step)
    end
    local function eased(t) return t * t * t * (t * (6 * t - 15) + 10) end
    return function(x, y)
      local i, j = x // grain, y // grain
      local u, v = eased(x / grain - i), eased(y / grain - j)
      local ax, ay = at(i, j)
      local bx, by = at(i + 1, j)
      local cx, cy = at(i, j + 1)
      local dx, dy = at(i + 1, j + 1)
      local top, left = ax + (bx - ax) * u, ay + (by - ay) * u
      return x + top + (cx + (dx - cx) * u - top) * v, y + left + (cy + (dy - cy) * u - left) * v
    end
  end

  it("moves points as noise at whole numbers does, to the last bit", function()
    for i, frame in ipairs { 0, -7, 3.9, 2 ^ 54, 1e300 } do
      local options = { amount = 1 / 3 * i, frame = frame, every = 1 + 0.3 * i, grain = 1.4 * i,
                        seed = i == 1 and "0" or "s" .. i }
      for _, place in ipairs { -1e6 / 3, -20, 0.1, 3e6 } do
        local figure = celspan.path { d = "M0 0C9 3 20 30 40 11L7 50Z", texture = "#000" }
          :translate(place, -place / 7)
        local mapped = figure:warp { map = map_of(options) }
        assert.same({ mapped:bounds() }, { figure:boil(options):bounds() })
      end
    end
  end)

  it("counts its points as steps", function()
    local bench = workbench.new()
    local script = bench:write("boiled.lua", [[
      local celspan = require "celspan"
      local line = celspan.path { d = "M0 0" .. ("C9 3 20 30 40 11S3 9 0 0"):rep(100),
        texture = "#000" }
      return celspan.film { size = { 32, 32 }, frames = 1, frame = function()
        return celspan.rostrum { celspan.cel { line:boil { amount = 1, frame = 3 } } }
      end }]])
    local code, _, err = bench:celspan("check %s --limit steps=100000", script)
    assert.equal(6, code)
    assert.truthy(err:find("100000 steps", 1, true), err)
    assert.equal(0, (bench:celspan("check %s", script)))
    bench:remove()
  end)

  it("keeps together what touches", function()
    local left = celspan.rect { 8, 8, 24, 48, texture = "#000000" }
    local upper = celspan.rect { 32, 8, 24, 24, texture = "#000000" }
    local lower = celspan.rect { 32, 32, 24, 24, texture = "#000000" }
    for frame = 0, 6, 2 do
      local function boil(object) return object:boil { amount = 2, frame = frame, grain = 20 } end
      local image = pixels(celspan.union { boil(left), boil(upper), boil(lower) })
      for y = 12, 52 do
        for x = 12, 52 do
          local _, _, _, alpha = image:get(x, y)
          assert.is_true(alpha > 1 - 1 / 255) -- the same curve may have other chords
        end
      end
    end
  end)

  it("refuses what would fold, and what is missing", function()
    raised.each {
      ["boil: needs the field 'amount', a number"] = function() square:boil { frame = 1 } end,
      ["boil: needs the field 'frame', a number"] = function() square:boil { amount = 1 } end,
      ["boil: field 'grain' must be at least 4 times the amount, 8, or lines would fold, got 7"] =
        function() square:boil { amount = 2, frame = 1, grain = 7 } end,
      ["boil: field 'amount' must be 0 or more, got -1"] = function()
        square:boil { amount = -1, frame = 1 }
      end,
      ["boil: field 'every' must be 1 or more, got 0"] = function()
        square:boil { amount = 1, frame = 1, every = 0 }
      end,
      ["boil: unknown field 'amout'; did you mean 'amount'?"] = function()
        square:boil { amout = 1, frame = 1 }
      end,
    }
  end)
end)

describe("a brush", function()
  local function alpha(object, x, y)
    local _, _, _, a = pixels(object):get(x, y)
    return a
  end

  it("is as wide as its profile says", function()
    local function line(profile)
      return celspan.brush { d = "M8 32 H56", width = 16, profile = profile }
    end
    local x, y, w, h = line("even"):bounds()
    assert.near(8, x, 1e-6)
    assert.near(24, y, 1e-6)
    assert.near(48, w, 1e-6)
    assert.near(16, h, 1e-6)
    assert.equal(0, alpha(line "round", 8, 25)) -- beside the round end
    assert.equal(1, alpha(line "round", 9, 32))
    assert.equal(1, alpha(line "round", 17, 25))
    assert.equal(0, alpha(line "ink", 9, 28))
    assert.equal(1, alpha(line "ink", 32, 25))
    assert.equal(0, alpha(line(function(t) return t < 0.5 and 1 or 0.25 end), 50, 26))
    local flat = celspan.brush { d = "M8 32 H56", width = 16, profile = "chisel", nib = 0 }
    local _, _, _, thin = flat:bounds()
    assert.near(16 * 0.15, thin, 1e-6)
  end)

  it("has its texture along the line, wherever that goes", function()
    local along = celspan.linear { from = { 0, 0 }, to = { 1, 0 }, { 0, celspan.rgb(0, 0, 0) },
      { 1, celspan.rgb(1, 1, 1) } }
    local image = pixels(celspan.brush { d = "M8 16 H56 V60", width = 8, profile = "even",
      texture = along, to = 0.4 })
    for _, x in ipairs { 12, 24, 36 } do
      local r = image:get(x, 16)
      assert.near((x + 0.5 - 8) / 92, r, 2e-2)
    end
    local _, _, _, after = image:get(50, 16)
    assert.equal(0, after)
  end)

  it("has a picture along the line, of which it shows a part", function()
    local texels = ("\255\0\0\255"):rep(2) .. ("\0\255\0\255"):rep(2)
    local stripes = celspan.picture { pixels = texels, size = { 4, 1 }, box = { 0, -0.5, 1, 1 },
      sampling = "nearest" }
    local image = pixels(celspan.brush { d = "M8 32 H56", width = 16, profile = "even",
      texture = stripes, from = 0.25 })
    local _, _, _, before = image:get(14, 32)
    local red, green = image:get(24, 32)
    assert.same({ 0, 1, 0 }, { before, red, green })
    red, green = image:get(44, 32)
    assert.same({ 0, 1 }, { red, green })
  end)

  it("refuses what it cannot draw", function()
    raised.each {
      ["brush: needs the field 'd', the path of the line"] = function() celspan.brush {} end,
      ["brush: d must be path data, contours or a path, got number"] = function()
        celspan.brush { d = 7 }
      end,
      ["brush: field 'width' must be above 0, got 0"] = function()
        celspan.brush { d = "M0 0H9", width = 0 }
      end,
      ["or \"round\", got \"inc\"; did you mean \"ink\"?"] = function()
        celspan.brush { d = "M0 0H9", profile = "inc" }
      end,
      ["brush: the profile must return a number of 0 or more, got -1 at 0"] = function()
        celspan.brush { d = "M0 0H9", profile = function() return -1 end }
      end,
      ["brush: field 'to' must be from 0 to 1, got 2"] = function()
        celspan.brush { d = "M0 0H9", to = 2 }
      end,
    }
    local nothing = celspan.brush { d = "M0 0H9", from = 0.5, to = 0.5 }
    assert.is_nil((nothing:bounds()))
  end)
end)
