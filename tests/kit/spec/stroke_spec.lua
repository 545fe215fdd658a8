-- Strokes in scripts: their area, their fields and their faults.
local celspan = require "celspan"
local workbench = require "tests.support.workbench"

local function covers(stroke, points)
  for _, p in ipairs(points) do
    assert.are.equal(p[3], stroke:contains(p[1], p[2]), ("at %g, %g"):format(p[1], p[2]))
  end
end

local function fault(fields)
  local good, message = pcall(celspan.stroke, fields)
  assert.is_false(good)
  return message
end

describe("a stroke", function()
  it("has the given width and caps", function()
    local line = { points = { { 10, 10 }, { 30, 10 } }, width = 4 }
    for cap, ends in pairs { butt = { false, false }, round = { true, false },
      square = { true, true } } do
      line.cap = cap
      covers(celspan.stroke(line), {
        { 20, 11.9, true }, { 20, 12.1, false }, { 20, 8.1, true }, { 9, 10, ends[1] },
        { 31.9, 11.9, ends[2] }, { 7.9, 10, false }, { 10.1, 11.9, true } })
    end
  end)

  it("has the given joins", function()
    local corner = { points = { { 0, 0 }, { 20, 0 }, { 20, 20 } }, width = 4 }
    local inside = { miter = { true, true }, round = { true, false }, bevel = { false, false } }
    for join, points in pairs(inside) do
      corner.join = join
      covers(celspan.stroke(corner), { { 21.3, -1.3, points[1] }, { 21.9, -1.9, points[2] },
                                       { 20.9, -0.9, true } })
    end
    corner.join, corner.miter = "miter", 1.2
    covers(celspan.stroke(corner), { { 21.3, -1.3, false } })
  end)

  it("has perpendicular ends if it begins to taper where its curve has no speed", function()
    -- T after a straight line: the curve begins with no speed, and its radius with no change.
    local stroke = celspan.stroke {
      d = "M15.1988 17s-15.9512 12.9562-13.2265-1.6533L53.371 14.9859 51 19.7249T56.5 7.8141",
                                    width = 7, join = "bevel", taper = { 9.5995, 13.1366 } }
    covers(stroke,
      { { 48, 19, true }, { 48, 19.6, false }, { 49, 20.2, false }, { 51, 19.5, true } })
  end)

  it("can have a width at each point", function()
    local cone = celspan.stroke { points = { { 0, 0, 0 }, { 100, 0, 20 } } }
    covers(cone, { { 50, 4.9, true }, { 50, 5.1, false }, { 100, 9.9, true } })
    assert.is_true(celspan.stroke { points = { { 0, 0, 2 }, { 1, 0, 30 } },
      cap = "round" }:contains(1, 14))
  end)

  it("has dashes placed by its length", function()
    local line = celspan.stroke { d = "M0 0H100", width = 2, dash = { 10, 5 }, dash_offset = 3 }
    covers(line, { { 6.9, 0, true }, { 7.1, 0, false }, { 11.9, 0, false }, { 12.1, 0, true },
                   { 21.9, 0, true }, { 22.1, 0, false } })
    -- A quarter of a circle of radius 40 is 62.83 long: the second dash begins after 31.42 at 45
    -- degrees.
    local arc = celspan.stroke { d = "M40 0A40 40 0 0 1 0 40", width = 2,
                                 dash = { 10, math.pi * 10 - 10 } }
    local function at(length) return 40 * math.cos(length / 40), 40 * math.sin(length / 40) end
    for length, drawn in pairs { [9.99] = true, [10.01] = false, [31.40] = false, [31.43] = true,
                                 [41.40] = true, [41.43] = false } do
      local x, y = at(length)
      assert.are.equal(drawn, arc:contains(x, y), length)
    end
  end)

  it("can be drawn in part, with tapers", function()
    local line = celspan.stroke { points = { { 0, 0 }, { 50, 0 }, { 100, 0 } }, width = 10,
      from = 0.2, to = 0.6,
                                  taper = { 10, 20 } }
    -- The sides are tangents of the discs: 5 tan(asin(1/2)) = 2.887, 10 tan(asin(1/4)) = 2.582.
    covers(line, { { 19.9, 0, false }, { 25, 2.85, true }, { 25, 2.92, false }, { 35, 4.9, true },
                   { 50, 2.55, true }, { 50, 2.61, false }, { 60.1, 0, false } })
    assert.is_nil(celspan.stroke { d = "M0 0H9", from = 0.5, to = 0.5 }:bounds())
  end)

  it("goes around a primitive in its place", function()
    local ring = celspan.circle { centre = { 0, 0 }, radius = 10 }:scale(2):translate(50, 50)
      :fade(0.5)
      :stroke { width = 2, texture = "#ff0000" }
    covers(ring, { { 70, 50, true }, { 71.9, 50, true }, { 72.1, 50, false }, { 67.9, 50, false },
                   { 50, 50, false } })
    local x, y, w, h = ring:bounds()
    for i, pair in ipairs { { x, 28 }, { y, 28 }, { w, 44 }, { h, 44 } } do
      assert.is_near(pair[2], pair[1], 1e-5, i)
    end
    local _, _, _, a = celspan.probe(celspan.rostrum { celspan.cel { ring } }, 70, 50)
    assert.is_near(0.5, a, 1e-6)
    covers(ring:with { width = 4 }, { { 73.9, 50, true }, { 74.1, 50, false } })
  end)

  it("is a dot if its line has no length", function()
    for cap, inside in pairs { butt = { false, false }, round = { true, false },
      square = { true, true } } do
      for _, line in ipairs { { points = { { 5, 5 } } }, { d = "M5 5Z" }, { d = "M5 5L5 5" } } do
        line.width, line.cap = 4, cap
        covers(celspan.stroke(line), { { 5, 6, inside[1] }, { 6.9, 6.9, inside[2] } })
      end
    end
  end)

  it("is closed with a join, and its last dash continues in its first", function()
    local square = { d = "M0 0H40V40H0Z", width = 4 }
    covers(celspan.stroke(square), { { -1.9, -1.9, true }, { 20, 20, false } })
    square.d = "M0 0H40V40H0V0"
    covers(celspan.stroke(square), { { -1.9, -1.9, false } })
    square.d, square.dash, square.dash_offset = "M0 0H40V40H0Z", { 30, 10 }, 15
    covers(celspan.stroke(square), { { -1.9, -1.9, true } })
  end)

  it("is refused with the reason", function()
    local line = { { 0, 0 }, { 9, 0 } }
    for message, fields in pairs {
      ["give one of 'points', 'd', 'outline' and 'contours'"] = { width = 3 },
      ["give only one of 'points', 'd', 'outline' and 'contours'"] = { points = line, d = "M0 0" },
      ["width is %-1; it must be 0 or more"] = { points = line, width = -1 },
      ["points%[2%]%.width is %-4"] = { points = { { 0, 0 }, { 1, 1, -4 } } },
      ["'width' must be a finite number, got nan"] = { points = line, width = 0 / 0 },
      ["dash is empty"] = { points = line, dash = {} },
      ["the lengths of dash are all 0"] = { points = line, dash = { 0, 0 } },
      ["dash%[2%] is %-1"] = { points = line, dash = { 1, -1 } },
      ["dashes; at most 1000000 are allowed: make"] =
        { points = { { 0, 0 }, { 1e9, 0 } }, dash = { 1 } },
      ["field 'cap' must be"] = { points = line, cap = "flat" },
      ["miter is 0.5"] = { points = line, miter = 0.5 },
      ["degree is 16"] = { points = line, degree = 16 },
      ["taper%[2%] is %-3"] = { points = line, taper = { 0, -3 } },
      ["'closed' must be true or false"] = { points = line, closed = "yes" },
      ["path data ends at byte"] = { d = "M0 0L" },
      ["the outline must be that of a primitive; a boolean object has none"] =
        { outline = celspan.union { celspan.rect { 0, 0, 1, 1 } } },
      ["unknown field 'widht'"] = { points = line, widht = 3 },
    } do
      assert.matches(message, fault(fields))
    end
  end)

  it("of very many points is drawn, or refused with the limit", function()
    local points = {}
    for i = 1, 100001 do points[i] = { i, i % 7 } end
    assert.is_true(celspan.stroke { points = points, width = 2 }:contains(50000, 50000 % 7))
    assert.matches("there are 100001 points", fault { points = points, degree = 3 })
  end)
end)

describe("strokes that abut", function()
  --- The least alpha in a box that is covered, of a film 64 x 64.
  local function least(art, x0, y0, x1, y1)
    local image = assert(celspan.pixels(celspan.rostrum { celspan.cel(art) },
      { size = { 64, 64 } }))
    local found = 1
    for y = y0, y1 do
      for x = x0, x1 do found = math.min(found, (select(4, image:get(x, y)))) end
    end
    return found
  end

  it("leave no gap next to a fill with the same edge", function()
    local edge = { { -35.1, -80 }, { 80.1, 145 } }
    local a, b = edge[1], edge[2]
    local length = math.sqrt((b[1] - a[1]) ^ 2 + (b[2] - a[2]) ^ 2)
    local nx, ny = -(b[2] - a[2]) / length * 200, (b[1] - a[1]) / length * 200
    local art = {
      celspan.polygon { a, b, { b[1] + nx, b[2] + ny }, { a[1] + nx, a[2] + ny } },
      celspan.stroke { points = { { a[1] - nx / 2, a[2] - ny / 2 },
        { b[1] - nx / 2, b[2] - ny / 2 } }, width = 200 } }
    assert.is_true(least(art, 0, 0, 63, 63) > 1 - 1e-6)
  end)

  it("leave no gap between their own parts, nor in tight bends", function()
    local bend = celspan.stroke { d = "M-40 20 C 90 -10 90 80 10 44 S 10 20 80 60", width = 90,
      cap = "round", join = "round" }
    assert.are.equal(1, least({ bend }, 8, 8, 56, 56))
    local wave = {}
    for i = 0, 8 do wave[#wave + 1] = { -20 + 13 * i, 32 + (i % 2) * 9, 60 + 20 * (i % 3) } end
    assert.are.equal(1, least({ celspan.stroke { points = wave, degree = 2 } }, 10, 20, 54, 44))
  end)

  it("leave no gap around a centre of curvature, whatever the scale", function()
    local arc = celspan.stroke { d = "M0-10A10 10 0 0 1 10 0V30", width = 34 }
    for width = 20.5, 42, 1.5 do
      local disc = celspan.circle { centre = { 0, 0 }, radius = 10 }:stroke { width = width }
      for _, scale in ipairs { 1, 1.7, 20, 400 } do
        assert.equal(1, least({ disc:scale(scale):translate(32.3, 31.8) }, 31, 31, 33, 33))
      end
    end
    assert.equal(1, least({ arc:scale(3):translate(32, 32) }, 20, 32, 31, 44))
  end)

  --- Whether a stroke covers a pixel and a tenth of one around it, according to 100 x 100 points.
  local function holds(stroke, x, y)
    for i = 0, 99 do
      for k = 0, 99 do
        if not stroke:contains(x - 0.1 + 0.012 * (i + 0.5), y - 0.1 + 0.012 * (k + 0.5)) then
          return false
        end
      end
    end
    return true
  end

  it("are opaque inside within 3/100,000, however their sides overlap", function()
    local state = 1
    local function random(low, high)
      state = state * 6364136223846793005 + 1442695040888963407
      return low + (high - low) * (state >> 33 & 0x7fffffff) / 0x7fffffff
    end
    for case = 1, 120 do
      local points = {}
      for i = 1, 3 + math.floor(random(0, 6)) do
        local x, y = random(-10, 74), random(-10, 74)
        points[i] = { x, y, random(0, 1) < 0.2 and 0 or random(0, 90) }
      end
      local degree, closed = 1 + math.floor(random(0, 3.99)), random(0, 1) < 0.3
      local join = ({ "round", "miter", "bevel" })[1 + math.floor(random(0, 2.99))]
      local stroke = celspan.stroke { points = points, degree = degree, closed = closed,
        cap = "round", join = join }
      local image = assert(celspan.pixels(celspan.rostrum { celspan.cel { stroke } },
        { size = { 64, 64 } }))
      local where
      for y = 0, 63 do
        for x = 0, 63 do
          local alpha = select(4, image:get(x, y))
          if alpha > 0.99 and alpha < 1 - 3e-5 and holds(stroke, x, y) then
            where = ("stroke %d at %d, %d: %.7f"):format(case, x, y, alpha)
          end
        end
      end
      assert.is_nil(where)
    end
  end)
end)

describe("a stroke in a scene", function()
  local function film(objects, fields)
    fields = fields or {}
    fields[1] = celspan.union(objects)
    return celspan.rostrum { celspan.cel(fields) }
  end

  local function pixels(rostrum, options)
    options = options or {}
    options.size = options.size or { 64, 64 }
    return assert(celspan.pixels(rostrum, options))
  end

  --- The greatest difference between two pictures, in any channel.
  local function difference(a, b)
    local most = 0
    for y = 0, a.height - 1 do
      for x = 0, a.width - 1 do
        local one, other = { a:get(x, y) }, { b:get(x, y) }
        for i = 1, 4 do most = math.max(most, math.abs(one[i] - other[i])) end
      end
    end
    return most
  end

  local bar = { points = { { 8, 20 }, { 56, 40 } }, width = 12 }

  --- The same as a polygon.
  local function polygon(texture)
    local length = math.sqrt(48 ^ 2 + 20 ^ 2)
    local nx, ny = -20 / length * 6, 48 / length * 6
    return celspan.polygon { { 8 + nx, 20 + ny }, { 56 + nx, 40 + ny }, { 56 - nx, 40 - ny },
      { 8 - nx, 20 - ny },
                             texture = texture }
  end

  local function stroke(texture)
    return celspan.stroke { points = bar.points, width = bar.width, texture = texture }
  end

  it("shows gradients like a shape of the same outline", function()
    local texture = celspan.linear { from = { 8, 0 }, to = { 56, 0 }, { 0, "#ff0000" },
      { 1, "#0000ff80" } }
    assert.is_true(difference(pixels(film { stroke(texture) }), pixels(film { polygon(texture) }))
      < 2e-6)
    local red = { celspan.probe(film { stroke(texture) }, 10, 21) }
    assert.is_true(red[1] > 0.8 and red[3] < 0.1)
  end)

  it("is defocused like a shape of the same outline", function()
    for _, kernel in ipairs { "gaussian", "box", "disc" } do
      local soft = { radius = 5, kernel = kernel }
      assert.is_true(difference(pixels(film({ stroke "#40c020" }, { defocus = soft })),
        pixels(film({ polygon "#40c020" }, { defocus = soft }))) < 1e-5, kernel)
    end
  end)

  it("is an operand of booleans", function()
    local texture, disc = "#ff8000",
      celspan.circle { centre = { 32, 30 }, radius = 9, texture = "#ff8000" }
    for _, combine in ipairs { celspan.union, celspan.intersection, celspan.difference,
      celspan.xor } do
      assert.is_true(difference(pixels(film { combine { stroke(texture), disc } }),
        pixels(film { combine { polygon(texture), disc } })) < 2e-6)
    end
    local cut = celspan.difference { stroke(texture), disc }
    covers(cut, { { 32, 30, false }, { 12, 21, true }, { 32, 45, false } })
  end)

  it("hides the background if it is thick and opaque", function()
    local behind = {}
    for i = 1, 40 do
      behind[i] = celspan.circle { centre = { 256 + 5 * i, 256 }, radius = 200,
        texture = ("#%02x20%02x"):format(6 * i, 250 - 6 * i) }
    end
    local options = { size = { 512, 512 } }
    local line = { points = { { -100, 200 }, { 600, 300 } }, width = 900, texture = "#204060" }
    local alone = pixels(film { celspan.stroke(line) }, options)
    behind[#behind + 1] = celspan.stroke(line)
    assert.are.equal(0, difference(pixels(film(behind), options), alone))
    -- Where it ends, the background is visible.
    line.width = 100
    behind[#behind] = celspan.stroke(line)
    local picture = pixels(film(behind), options)
    assert.is_true(select(1, picture:get(400, 60)) > 0.5 and select(3, picture:get(300, 255)) > 0.1)
  end)

  it("saves the evaluation of hidden colours", function()
    --- How many colours are evaluated for 40 discs behind a line of that thickness.
    local function evaluations(width)
      local path = os.tmpname()
      local file = assert(io.open(path, "w"))
      file:write(([[
        local celspan = require "celspan"
        local art = {}
        for i = 1, 40 do
          art[i] = celspan.circle { centre = { 256 + 5 * i, 256 }, radius = 200, texture =
            ("#%%02x20ff"):format(6 * i) }
        end
        art[41] = celspan.stroke { points = { { -100, 200 }, { 600, 300 } }, width = %d, texture =
          "#204060" }
        return celspan.film { size = { 512, 512 }, frames = 1,
          frame = function() return celspan.rostrum { celspan.cel(art) } end }]]):format(width))
      file:close()
      local pipe = assert(io.popen(("'%s' spans --stats --workers 1 %s")
        :format(workbench.binary, path)))
      local out = pipe:read "a"
      pipe:close()
      os.remove(path)
      return tonumber(out:match "colour_evaluations (%d+)"), out
    end
    local hidden, out = evaluations(900)
    assert.is_true(hidden <= 100, out)
    assert.is_true(evaluations(2) >= 5 * hidden)
  end)

  it("is the same in a crop and in single rows as in the whole", function()
    local wave = {}
    for i = 0, 40 do
      wave[#wave + 1] = { -20 + 14 * i, 256 + (i % 3) * 90 - i % 7 * 40, 6 + 20 * (i % 3) }
    end
    local rostrum = film {
      celspan.stroke { points = wave, degree = 3, cap = "round", texture = "#c04020" },
      celspan.stroke { d = "M10 300C300 -900 500 1700 500 300S100 30 -1000 20000", width = 9,
        dash = { 5, 9 },
                       texture = "#204080" },
      celspan.stroke { d = "M10 300C300 -900 500 1700 500 300Z", width = 30,
        texture = "#20808080" } }
    for _, antialias in ipairs { "area", "none" } do
      local function spans(rows)
        return assert(celspan.spans(rostrum,
          { size = { 512, 512 }, antialias = antialias, rows = rows }))
      end
      local whole = spans()
      for first = 0, 448, 64 do
        local some = spans { first, first + 20 }
        for y = first, first + 20 do assert.are.same(whole[y], some[y], y) end
      end
    end
  end)
end)
