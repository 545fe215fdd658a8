-- Path operators against closed forms, and what they refuse.
local celspan = require "celspan"
local native = require "tests.support.own" "celspan.native"
local json = require "celspan.json"
local raised = require "tests.support.raised"

local pi, sin, cos = math.pi, math.sin, math.cos

local function close(wanted, got, within) assert.near(wanted, got, within) end

local function all_close(wanted, got)
  assert.equal(#wanted, #got)
  for i, number in ipairs(wanted) do close(number, got[i], 1e-9) end
end

--- The contours of an object that is one outline, as cubics.
local function contours(object) return native.anatomy(object).contours end

--- The joints of the only contour.
local function joints(object)
  local list, contour = {}, contours(object)[1]
  for i = 1, #contour, 6 do list[#list + 1] = { contour[i], contour[i + 1] } end
  return list
end

local function point_on(c, i, t)
  local s, p = 1 - t, {}
  for k = 0, 1 do
    p[k + 1] = s * s * s * c[i + k] + 3 * s * s * t * c[i + 2 + k] + 3 * s * t * t * c[i + 4 + k]
      + t * t * t * c[i + 6 + k]
  end
  return p[1], p[2]
end

--- The length of a contour, by many chords and Richardson's rule.
local function length(contour)
  local function chords(n)
    local sum = 0
    for i = 1, #contour - 6, 6 do
      local x, y = contour[i], contour[i + 1]
      for k = 1, n do
        local u, v = point_on(contour, i, k / n)
        sum, x, y = sum + math.sqrt((u - x) ^ 2 + (v - y) ^ 2), u, v
      end
    end
    return sum
  end
  local coarse, fine = chords(400), chords(800)
  return fine + (fine - coarse) / 3
end

local function rect(x, y, w, h, texture) return celspan.rect { x, y, w, h, texture = texture } end

local function circle(radius, texture)
  return celspan.circle { centre = { 100, 100 }, radius = radius, texture = texture }
end

--- Checks that a shape is a disc about (100, 100) within a hundredth of a unit.
local function is_disc(object, radius)
  for i = 1, 90 do
    local x, y = cos(i * pi / 45), sin(i * pi / 45)
    assert.is_true(object:contains(100 + (radius - 0.01) * x, 100 + (radius - 0.01) * y))
    assert.is_false(object:contains(100 + (radius + 0.01) * x, 100 + (radius + 0.01) * y))
  end
end

local wave = "M10 20C40 -80 90 120 110 30S200 80 150 120"

describe("a trim", function()
  it("keeps the part of a circle between two angles", function()
    local ring = celspan.stroke { outline = circle(50), width = 2 }
    local first = joints(ring)[1]
    local begin = math.atan(first[2] - 100, first[1] - 100)
    for _, case in ipairs { { 0.1, 0.35, 0 }, { 0.35, 0.1, 0 }, { 0.7, 0.9, 0.25 },
                            { 0, 0.3, -7.1 } } do
      local list = joints(celspan.trim(ring, case[1], case[2], { offset = case[3] }))
      for i, share in ipairs { math.min(case[1], case[2]), math.max(case[1], case[2]) } do
        local angle = begin + 2 * pi * (share + case[3])
        local at = list[i == 1 and 1 or #list]
        close(100 + 50 * cos(angle), at[1], 1e-6)
        close(100 + 50 * sin(angle), at[2], 1e-6)
      end
    end
  end)

  it("has the lengths that it is asked for, within 1e-6", function()
    local line = celspan.stroke { d = wave, width = 3 }
    local whole = length(contours(line)[1])
    for _, case in ipairs { { 0, 0.5 }, { 0.21, 0.22 }, { 0.9, 0.1 }, { 0.3, 1 } } do
      local share = math.abs(case[2] - case[1])
      local trimmed = contours(celspan.trim(line, case[1], case[2]))
      assert.equal(1, #trimmed)
      close(share * whole, length(trimmed[1]), 1e-6 * whole)
    end
    local parts = contours(celspan.trim(line, 0.1, 0.4, { offset = 0.7 }))
    assert.equal(2, #parts)
    close(0.2 * whole, length(parts[1]), 1e-6 * whole)
    close(0.1 * whole, length(parts[2]), 1e-6 * whole)
  end)

  it("goes over the seam of a closed line, and keeps a whole one closed", function()
    local line = rect(0, 0, 40, 40):stroke { width = 2 }
    local parts = contours(celspan.trim(line, 0.8, 1, { offset = 0.1 }))
    assert.equal(1, #parts)
    close(32, length(parts[1]), 1e-9)
    local whole = celspan.trim(line, 0, 1, { offset = 0.4 })
    assert.is_true(contours(whole)[1].closed)
    assert.is_false(contours(celspan.trim(line, 0, 0.5))[1].closed)
  end)

  it("counts all contours together, in the order of the object", function()
    local both = celspan.union { celspan.stroke { d = "M0 0H30", width = 2 },
      celspan.stroke { d = "M0 9H10", width = 2 }:translate(5, 0) }
    local function lengths(...)
      local list = {}
      for i, node in ipairs(native.anatomy(celspan.trim(both, ...))) do
        list[i] = node.contours and node.contours[1] and length(node.contours[1]) or 0
      end
      return list
    end
    local together = lengths(0, 0.8, { together = true })
    close(30, together[1], 1e-9)
    close(2, together[2], 1e-9)
    local each = lengths(0, 0.8)
    close(24, each[1], 1e-9)
    close(8, each[2], 1e-9)
  end)

  it("closes a shape by its chord, and leaves dashes, names and fades as they are", function()
    local half = celspan.trim(circle(50, "#f00"), 0, 0.5)
    local _, _, w, h = half:bounds()
    close(50, math.min(w, h), 1e-6)
    close(100, math.max(w, h), 1e-6)
    local line = celspan.trim(celspan.stroke { d = "M0 5H100", width = 4, dash = { 10 } }
      :fade(0.5):named "road", 0.5, 1)
    assert.equal("road", line.name)
    assert.same({ true, false, true }, { line:contains(55, 5), line:contains(65, 5),
      line:contains(75, 5) })
  end)

  it("gives nothing for an empty part, and the object for the whole", function()
    assert.is_nil(celspan.trim(circle(9), 0.3, 0.3):bounds())
    assert.is_nil(celspan.trim(celspan.path { d = "" }, 0, 0.3):bounds())
    assert.same({ circle(9):bounds() }, { celspan.trim(circle(9), -1, 7):bounds() })
  end)
end)

describe("round corners", function()
  it("are arcs of circles in right angles", function()
    local plate = celspan.round_corners(rect(0, 0, 100, 60), 20)
    for i = 0, 20 do
      local x, y = cos(pi + i * pi / 40), sin(pi + i * pi / 40)
      assert.is_true(plate:contains(20 + 19.99 * x, 20 + 19.99 * y))
      assert.is_false(plate:contains(20 + 20.01 * x, 20 + 20.01 * y))
    end
  end)

  it("end at the middles of sides, and leave curves and straight joints", function()
    is_disc(celspan.round_corners(rect(50, 50, 100, 100), 1000), 50)
    is_disc(celspan.round_corners(circle(40), 30), 40)
    assert.equal(2, #joints(celspan.round_corners(celspan.stroke { d = "M0 0H50H90", width = 1 },
      9)) - 1)
  end)

  it("are round at the end of a needle, too", function()
    for _, height in ipairs { 1e-3, 1e-7, 1e-9 } do
      local needle = celspan.triangle { { 0, 0 }, { 100, 0 }, { 0, height } }
      local x, _, width = celspan.round_corners(needle, 1):bounds()
      close(0, x, 1e-9)
      close(99, width, 1e-3)
    end
  end)

  it("scale with the transform inside the object", function()
    local plate = celspan.round_corners(rect(0, 0, 10, 6):scale(10), 20)
    assert.is_true(plate:contains(6, 6))
    assert.is_false(plate:contains(5.8, 5.8))
  end)
end)

describe("a zigzag", function()
  it("has its ridges at equal shares, in turn on both sides", function()
    local line = celspan.stroke { d = "M0 0H100", width = 1 }
    local list = joints(celspan.zigzag(line, { size = 10, ridges = 3 }))
    assert.equal(5, #list)
    for i, at in ipairs(list) do
      close(25 * (i - 1), at[1], 1e-12)
      close(i % 2 == 1 and 10 or -10, at[2], 1e-12)
    end
    local smooth = contours(celspan.zigzag(line, { size = 10, ridges = 3, smooth = true }))[1]
    all_close({ 0, 10, 12.5, 10, 12.5, -10, 25, -10 }, { table.unpack(smooth, 1, 8) })
  end)

  it("returns to its first point, from the other side if need be", function()
    assert.equal(9, #joints(celspan.zigzag(rect(0, 0, 9, 9), { size = 2, ridges = 1 })))
    local triangle = celspan.triangle { { 0, 0 }, { 9, 0 }, { 0, 9 } }
    assert.equal(5, #joints(celspan.zigzag(triangle, { size = 2, ridges = 0 })))
  end)
end)

describe("a pucker", function()
  it("moves joints and control points by shares of their way to the middle", function()
    local c = contours(celspan.pucker(rect(0, 0, 100, 100), 0.5))[1]
    all_close({ 25, 25, -25, -25, 125, -25, 75, 25 }, { table.unpack(c, 1, 8) })
    local d = contours(celspan.pucker(rect(0, 0, 100, 100), -0.5))[1]
    all_close({ -25, -25, 25, 25, 75, 25, 125, -25 }, { table.unpack(d, 1, 8) })
  end)

  it("of 0 is the same curve", function()
    local line = celspan.stroke { d = wave, width = 1 }
    assert.same(contours(line), contours(celspan.pucker(line, 0)))
  end)
end)

describe("a twist", function()
  it("turns by its angle at the centre, and not at all at the farthest corner", function()
    local cross = celspan.union { rect(0, 0, 100, 100),
      celspan.stroke { d = "M50 50L90 50", width = 1 } }
    local nodes = native.anatomy(celspan.twist(cross, 90))
    local line = nodes[2].contours[1]
    local angle = pi / 2 * (1 - 40 / math.sqrt(5000))
    close(50, line[1], 1e-9)
    close(50 + 40 * cos(angle), line[#line - 1], 1e-9)
    close(50 + 40 * sin(angle), line[#line], 1e-9)
    close(0, nodes[1].contours[1][1], 1e-9)
    assert.equal(1, nodes[2].line.width)
  end)

  it("turns about a centre of its own, within a hundredth of a pixel", function()
    local line = celspan.stroke { d = "M20 0L80 0", width = 0 }
      | celspan.stroke { d = "M20 0L80 0", width = 2 }
    local x, y, w, h = line:bounds()
    local reach = math.sqrt(math.max(-x, x + w) ^ 2 + math.max(-y, y + h) ^ 2)
    local bent = celspan.twist(line, 200, { centre = { 0, 0 } })
    for r = 25, 75, 10 do
      local angle = math.rad(200) * (1 - r / reach)
      assert.is_true(bent:contains(r * cos(angle), r * sin(angle)))
    end
  end)
end)

describe("an offset", function()
  it("of a circle is a circle", function()
    is_disc(celspan.offset(circle(40), 13), 53)
    is_disc(celspan.offset(circle(40), -13), 27)
    assert.is_false(celspan.offset(circle(40), -41):contains(100, 100))
    for _, by in ipairs { -40.01, -44, -60, -100, -160 } do
      local image = assert(celspan.pixels(celspan.rostrum {
        celspan.cel { celspan.offset(circle(40), by) } }, { size = { 200, 200 } }))
      assert.is_nil(image:bytes():find "[^\0]")
    end
    local ring = celspan.offset(circle(40):stroke { width = 4 }, 10)
    for _, case in ipairs { { 47.99, false }, { 48.01, true }, { 51.99, true },
                            { 52.01, false } } do
      assert.equal(case[2], ring:contains(100 + case[1], 100))
    end
  end)

  it("has the corners of its join", function()
    local function holds(join, x, y)
      return celspan.offset(rect(0, 0, 50, 50), 10, { join = join }):contains(x, y)
    end
    assert.same({ true, false, false }, { holds("miter", -9.9, -9.9), holds("round", -7.2, -7.2),
      holds("bevel", -5.1, -5.1) })
    assert.same({ true, true }, { holds("round", -7, -7), holds("bevel", -4.9, -4.9) })
  end)

  --- How many of 100 by 100 pixels an object contains, once it is offset with sharp corners.
  local function offset_area(object, distance)
    local count = 0
    object = celspan.offset(object, distance, { join = "miter" })
    for y = 0, 99 do
      for x = 0, 99 do count = count + (object:contains(x + 0.5, y + 0.5) and 1 or 0) end
    end
    return count
  end

  it("moves what is taken away the other way", function()
    local ring = rect(10, 10, 80, 80) - rect(40, 40, 20, 20)
    assert.same({ 86 * 86 - 14 * 14, 74 * 74 - 26 * 26 }, { offset_area(ring, 3),
      offset_area(ring, -3) })
    local nested = rect(0, 0, 100, 100) - ring
    assert.same({ 100 * 100 - 74 * 74 + 26 * 26, 94 * 94 - 86 * 86 + 14 * 14 },
      { offset_area(nested, 3), offset_area(nested, -3) })
  end)

  it("of an exclusive or moves all its outlines, and paints each place once", function()
    local function both(texture)
      return celspan.xor { rect(10, 10, 40, 40, texture), rect(30, 30, 40, 40, texture) }
    end
    assert.same({ 2 * 46 * 46 - 26 * 26 - 14 * 14, 2 * (34 * 34 - 20 * 20) },
      { offset_area(both(), 3), offset_area(both(), -3) })
    local pale = celspan.offset(both(celspan.rgb(1, 0, 0, 0.5)), 3)
    for _, x in ipairs { 8, 20, 28, 32 } do
      close(0.5, select(4, celspan.probe(celspan.rostrum { celspan.cel { pale } }, x, 20,
        { film = { 80, 80 } })), 1e-6)
    end
  end)

  it("paints a translucent shape once", function()
    local shape = celspan.offset(rect(20, 20, 40, 40, celspan.rgb(1, 0, 0, 0.5)), 10)
    for _, x in ipairs { 12, 25, 40 } do
      close(0.5, select(4, celspan.probe(celspan.rostrum { celspan.cel { shape } }, x, 40,
        { film = { 80, 80 } })), 1e-6)
    end
  end)

  it("of dashes far from the origin is no larger than one beside it", function()
    local function grown(x)
      local line = celspan.stroke { d = ("M%d -10V10H%dV-10Z"):format(x + 15, x - 15), width = 2,
                                    cap = "round", join = "miter", dash = { 4, 2 } }
      local left, _, width = celspan.offset(line, 3):outline { width = 2 }:bounds()
      return left - x, width
    end
    local left, width = grown(0)
    for _, x in ipairs { 1e7, 1e11 } do
      local far_left, far_width = grown(x)
      assert.near(left, far_left, 2e-12 * x)
      assert.near(width, far_width, 4e-12 * x)
    end
  end)
end)

describe("a repeater", function()
  local dot = rect(0, 0, 10, 10, "#fff")

  it("moves, turns, scales and fades each copy further", function()
    local row = celspan.repeater(dot, { count = 4, translate = { 20, 0 }, opacity = { 1, 0.25 } })
    assert.same({ 0, 0, 70, 10 }, { row:bounds() })
    local function alpha(x)
      return select(4, celspan.probe(celspan.rostrum { celspan.cel { row } }, x, 5,
        { film = { 80, 10 } }))
    end
    assert.same({ 1, 0.75, 0.5, 0.25 }, { alpha(5), alpha(25), alpha(45), alpha(65) })
    all_close({ -40, -40, 40, 60 }, { celspan.repeater(dot, { count = 2, offset = 1,
      rotate = 90, scale = 2 }):bounds() })
  end)

  it("puts later copies in front or behind, and gives each to a function", function()
    local function top(order)
      local shown = celspan.repeater(dot, { count = 2, translate = { 5, 0 }, order = order,
        each = function(copy, i) return copy:paint(i == 0 and "#f00" or "#0f0") end })
      return (celspan.probe(celspan.rostrum { celspan.cel { shown } }, 7, 5,
        { film = { 20, 10 } }))
    end
    assert.equal(0, top "above")
    assert.equal(1, top "below")
    assert.is_nil(celspan.repeater(dot, { count = 3, each = function() end }):bounds())
    assert.is_nil(celspan.repeater(dot, { count = 0 }):bounds())
    assert.is_truthy(celspan.repeater(dot, { count = 10000, translate = { 1, 0 } }):bounds())
  end)
end)

describe("a star", function()
  it("has its points on two circles, one up", function()
    local list = joints(celspan.star { centre = { 10, 20 }, points = 5, outer = 50, inner = 20 })
    assert.equal(11, #list)
    for i = 0, 9 do
      local radius, angle = i % 2 == 0 and 50 or 20, (36 * i - 90) * pi / 180
      close(10 + radius * cos(angle), list[i + 1][1], 1e-12)
      close(20 + radius * sin(angle), list[i + 1][2], 1e-12)
    end
    assert.equal(7, #joints(celspan.star { centre = { 0, 0 }, points = 6, outer = 9 }))
  end)

  it("with a roundness of 1 has arms of a quarter of the way to the next point", function()
    local c = contours(celspan.star { centre = { 0, 0 }, points = 4, outer = 10,
      outer_round = 1 })[1]
    close(2 * pi * 10 / 16, c[3] - c[1], 1e-12)
    close(0, c[4] - c[2], 1e-12)
  end)
end)

describe("a rectangle with four radii", function()
  it("has a quarter of a circle at each corner, clockwise from the top left", function()
    local plate = celspan.rect { 0, 0, 100, 100, radius = { 10, 20, 30, 0 } }
    local function edge(cx, cy, r, dx, dy)
      local s = math.sqrt(0.5)
      assert.is_true(plate:contains(cx + (r - 0.01) * dx * s, cy + (r - 0.01) * dy * s))
      assert.is_false(plate:contains(cx + (r + 0.01) * dx * s, cy + (r + 0.01) * dy * s))
    end
    edge(10, 10, 10, -1, -1)
    edge(80, 20, 20, 1, -1)
    edge(70, 70, 30, 1, 1)
    assert.is_true(plate:contains(0.01, 99.99))
    assert.same({ 10, 20, 30, 0 }, plate.radius)
    assert.equal(5, plate:with { radius = 5 }.radius)
  end)

  it("makes radii less in proportion where they do not fit", function()
    is_disc(celspan.rect { 60, 60, 80, 80, radius = { 500, 500, 500, 500 } }, 40)
  end)
end)

describe("a merge", function()
  local function at(mode)
    local shape = celspan.merge({ rect(0, 0, 20, 20, "#f00"), rect(10, 0, 20, 20) },
      { mode = mode })
    return { shape:contains(5, 5), shape:contains(15, 5), shape:contains(25, 5) }
  end

  it("is one shape of several", function()
    assert.same({ true, true, true }, at())
    assert.same({ true, true, true }, at "add")
    assert.same({ true, false, false }, at "subtract")
    assert.same({ false, true, false }, at "intersect")
    assert.same({ true, false, true }, at "exclude")
    assert.equal("outline", native.anatomy(celspan.merge { circle(9), rect(0, 0, 9, 9) }).kind)
    assert.is_nil(celspan.merge({}):bounds())
  end)
end)

describe("a conic gradient", function()
  local present = require "tests.support.present"
  local browsing = require "tests.support.browsing"
  local in_browser = present.program "chromium" and it or pending
  local W, H = 600, 200
  local cases = {
    { css = "#f00, #ff0, #0f0, #0ff, #00f, #f0f, #f00", x = 100, y = 100, angle = 0,
      { 0, "#f00" }, { 1 / 6, "#ff0" }, { 2 / 6, "#0f0" }, { 3 / 6, "#0ff" }, { 4 / 6, "#00f" },
      { 5 / 6, "#f0f" }, { 1, "#f00" } },
    { css = "#000 0, #fff 30%, #e4572e 30%, #17bebb 80%", x = 40.5, y = 60.25, angle = 100,
      { 0, "#000" }, { 0.3, "#fff" }, { 0.3, "#e4572e" }, { 0.8, "#17bebb" } },
    { css = "#0000ff00 10%, #00f 60%, #ff000080", x = 150, y = 130, angle = -30,
      { 0.1, "#0000ff00" }, { 0.6, "#00f" }, { 1, "#ff000080" } },
  }

  --- The codes of the browser's picture.
  local function draw_in_browser(path)
    local boxes = {}
    for i, case in ipairs(cases) do
      boxes[i] = ("<div style='position:absolute;left:%dpx;top:0;width:200px;height:200px;"
        .. "background:conic-gradient(from %gdeg at %gpx %gpx, %s)'></div>"):format(200 * (i - 1),
        case.angle, case.x, case.y, case.css)
    end
    local script = "document.body.style.background = 'white'; document.body.innerHTML = "
      .. json.encode(table.concat(boxes))
    browsing.see("about:blank", ("await page.get(%s); await page.shot(%s); return true;"):format(
      json.encode(script), json.encode(path)))
    local image = celspan.image { file = path, x = 0, y = 0 }
    return assert(celspan.pixels(celspan.film { size = { W, H }, frame = function()
      return celspan.rostrum { celspan.cel { image } }
    end })):bytes()
  end

  local function draw()
    local objects = { rect(0, 0, W, H, "#fff") }
    for i, case in ipairs(cases) do
      local fields = { centre = { case.x + 200 * (i - 1), case.y }, angle = case.angle }
      table.move(case, 1, #case, 1, fields)
      objects[i + 1] = rect(200 * (i - 1), 0, 200, 200, celspan.conic(fields))
    end
    return assert(celspan.pixels(celspan.film { size = { W, H }, space = "srgb",
      frame = function() return celspan.rostrum { celspan.cel(objects) } end })):bytes()
  end

  --- Whether the neighbours of a code differ by less than a jump of the gradient, or the middle of
  --- it, where colours change within a pixel.
  local function is_smooth(codes, x, y)
    local here = 4 * (W * y + x)
    for c = 1, 3 do
      for _, step in ipairs { -4, 4, -4 * W, 4 * W, -4 * W - 4, 4 * W + 4 } do
        if math.abs(codes:byte(here + c) - codes:byte(here + step + c)) > 8 then return false end
      end
    end
    return true
  end

  in_browser("has the codes of Chromium's, within 2 away from edges", function()
    local path = os.tmpname()
    local theirs, ours, compared, worst = draw_in_browser(path), draw(), 0, 0
    os.remove(path)
    for y = 1, H - 2 do
      for x = 1, W - 2 do
        if is_smooth(theirs, x, y) then
          compared = compared + 1
          for c = 1, 3 do
            local at = 4 * (W * y + x) + c
            worst = math.max(worst, math.abs(theirs:byte(at) - ours:byte(at)))
          end
        end
      end
    end
    assert.is_true(compared > 0.9 * W * H, compared)
    assert.is_true(worst <= 2, worst)
  end)

  it("turns with its matrix, and has one colour of one stop", function()
    local function shown(fields, x, y)
      return (celspan.probe(celspan.rostrum { celspan.cel { rect(0, 0, 100, 100,
        celspan.conic(fields)) } }, x, y, { film = { 100, 100 } }))
    end
    local stops = { centre = { 50, 50 }, { 0, "#000" }, { 1, "#fff" } }
    close(0.25, shown(stops, 90, 50), 1e-6)
    stops.matrix = { 0, -1, 100, 1, 0, 0, 0, 0, 1 }
    close(0.25, shown(stops, 50, 90), 1e-6)
    assert.equal(1, shown({ centre = { 0, 0 }, { 0.5, "#fff" } }, 3, 3))
  end)
end)

describe("operators", function()
  it("work on text, drawings and parts, one after another", function()
    local text = celspan.text { "AB", font = "../../../scripts/type/block.ttf", size = 40,
                                at = { 0, 40 } }
    local drawing = celspan.union { text:named "word", celspan.group { circle(30):rotate(20) },
      celspan.stroke { d = wave, width = 4 }:scale(2, 0.5) }
    for _ = 1, 4 do
      drawing = celspan.pucker(celspan.round_corners(celspan.trim(drawing, 0.1, 0.9), 3), 0.1)
      drawing = celspan.twist(celspan.zigzag(drawing, { size = 1, ridges = 1 }), 5)
    end
    assert.is_truthy(drawing:bounds())
    assert.equal("word", native.anatomy(drawing)[1].name)
  end)

  it("refuse wrong arguments", function()
    local nan, dot = 0 / 0, circle(9)
    raised.each {
      ["trim: the first argument must be an object, got number"] = function()
        celspan.trim(3, 0, 1)
      end,
      ["trim: the second argument, from, must be a finite number, got nan"] = function()
        celspan.trim(dot, nan, 1)
      end,
      ["trim: the third argument, to, must be a finite number, got nil"] = function()
        celspan.trim(dot, 0)
      end,
      ["trim: offset is 1e308; it must be between -1e12 and 1e12"] = function()
        celspan.trim(dot, 0, 0.5, { offset = 1e308 })
      end,
      ["trim: unknown field 'ofset'; did you mean 'offset'?"] = function()
        celspan.trim(dot, 0, 0.5, { ofset = 1 })
      end,
      ["trim: a stroke whose width varies has no single line; change the line first, and then "
        .. "give it a width"] = function()
        celspan.trim(celspan.stroke { d = "M0 0H9", width = 2, taper = { 3, 3 } }, 0, 0.5)
      end,
      ["trim: a rostrum, or what is blurred, has a soft shadow or a glow, has no lines; change the "
        .. "objects that it is made of"] = function() celspan.trim(dot:blur(3), 0, 0.5) end,
      ["round_corners: radius is -1; it must be 0 or more"] = function()
        celspan.round_corners(dot, -1)
      end,
      ["zigzag: field 'ridges' must be a whole number from 0 to 10000, got 10001"] = function()
        celspan.zigzag(dot, { size = 3, ridges = 10001 })
      end,
      ["zigzag: needs the field 'size', a number"] = function()
        celspan.zigzag(dot, { ridges = 1 })
      end,
      ["zigzag: it would move a point beyond 1e12 units"] = function()
        celspan.zigzag(circle(1e12), { size = 1e12, ridges = 1 })
      end,
      ["pucker: amount is 2; it must be between -1 and 1"] = function() celspan.pucker(dot, 2) end,
      ["twist: the angle must be from -360000 to 360000 degrees, got 1e+308"] = function()
        celspan.twist(dot, 1e308)
      end,
      ["twist: centre[2] must be a number, got nil"] = function()
        celspan.twist(dot, 9, { centre = { 1 } })
      end,
      ["offset: field 'join' must be \"round\", \"miter\" or \"bevel\", got \"square\""] =
        function() celspan.offset(dot, 3, { join = "square" }) end,
      ["offset: the distance must be a number from -1e12 to 1e12, got 1e+308"] = function()
        celspan.offset(dot, 1e308)
      end,
      ["repeater: field 'count' must be a whole number from 0 to 10000, got 10001"] = function()
        celspan.repeater(dot, { count = 10001 })
      end,
      ["repeater: a scale below 0 goes with a whole offset alone: -1 to the power of 0.5 is no "
        .. "number"] = function()
        celspan.repeater(dot, { count = 2, scale = { 1, -1 }, offset = 0.5 })
      end,
      ["repeater: copy 40 would be moved or scaled by more than 1e12"] = function()
        celspan.repeater(dot, { count = 50, scale = 2 })
      end,
      ["offset: a line with 142858 dashes cannot be offset, bent, morphed, given an "
        .. "outline or grown as a matte; at most 100000 are possible there: make the dashes "
        .. "longer, or the line shorter"] = function()
        celspan.offset(celspan.stroke { d = "M0 50H3e6", width = 2, dash = { 10.5 } }, 2)
      end,
      ["star: field 'points' must be a whole number from 2 to 10000, got 1"] = function()
        celspan.star { points = 1, outer = 3 }
      end,
      ["star: needs the field 'outer', a radius"] = function() celspan.star {} end,
      ["rect: field 'radius' must be a number or four numbers, got 3"] = function()
        celspan.rect { 0, 0, 9, 9, radius = { 1, 2, 3 } }
      end,
      ["rect: radius[2] is -1; it must be 0 or more"] = function()
        celspan.rect { 0, 0, 9, 9, radius = { 1, -1, 3, 4 } }
      end,
      ["merge: field 'mode' must be \"merge\", \"add\", \"subtract\", \"intersect\" or "
        .. "\"exclude\", got \"union\""] = function()
        celspan.merge({ dot }, { mode = "union" })
      end,
      ["conic: stops[2].at is 0.1, less than 0.5 of the stop before; stops must ascend"] =
        function() celspan.conic { centre = { 0, 0 }, { 0.5, "#f00" }, { 0.1, "#000" } } end,
    }
  end)
end)
