-- Contours as numbers: they draw what the same path data draw, go wherever path data go, and
-- mistakes in them are named by the contour and the number.
local celspan = require "celspan"
local keys = require "celspan.keys"
local motion = require "celspan.motion"
local raised = require "tests.support.raised"

--- The pixels of an object.
local function drawn(object)
  local image = celspan.pixels(celspan.rostrum { celspan.cel { object } },
    { size = { 64, 64 }, film = { 64, 64 } })
  return image:bytes { depth = 16, colour = "linear", alpha = "straight" }
end

local DATA = "M4 4C20 4 30 20 30 40L4 40ZM40 10L60 10C60 30 50 50 40 50"
local CLOSED = { 4, 4, 20, 4, 30, 20, 30, 40, 30, 40, 4, 40, 4, 40, closed = true }
local OPEN = { 40, 10, 40, 10, 60, 10, 60, 10, 60, 30, 50, 50, 40, 50 }
local BOTH = { CLOSED, OPEN }

describe("contours", function()
  it("are the area of the same path data", function()
    assert.equal(drawn(celspan.path { d = DATA }), drawn(celspan.path { contours = BOTH }))
    local circles = { { 30, 2, 70, 2, 70, 60, 30, 60, -10, 60, -10, 2, 30, 2 },
                      { 30, 20, 40, 20, 40, 40, 30, 40, 20, 40, 20, 20, 30, 20 } }
    local ring = celspan.path { contours = circles, rule = "evenodd" }
    assert.same({ true, false }, { ring:contains(30, 10), ring:contains(30, 30) })
    assert.is_nil(celspan.path { contours = {} }:bounds())
  end)

  it("are the lines of the same path data", function()
    local fields = { width = 5, join = "round", cap = "square", dash = { 9, 4 } }
    local text, numbers = { d = DATA }, { contours = BOTH }
    for name, value in pairs(fields) do text[name], numbers[name] = value, value end
    assert.equal(drawn(celspan.stroke(text)), drawn(celspan.stroke(numbers)))
  end)

  it("are read from a value as they were given, as a copy", function()
    local path = celspan.path { contours = BOTH }
    assert.same(BOTH, path.contours)
    path.contours[1][1] = 99
    assert.same(BOTH, path.contours)
    local other = path:with { d = "M0 0H9V9Z" }
    assert.same({ "M0 0H9V9Z", nil }, { other.d, other.contours })
    assert.equal(drawn(path), drawn(other:with { contours = BOTH }))
  end)

  it("can be a line to go along", function()
    local data, way = motion.along "M4 4C20 4 30 20 30 40L4 40Z", motion.along { CLOSED }
    assert.near(data.length, way.length, 1e-12)
    assert.same({ data:at(0.3) }, { way:at(0.3) })
    assert.same({ 4, 4, 0 }, { motion.along { { 4, 4, 4, 4, 4, 4, 4, 4 } }:at(0.5) })
    local bar, curve = celspan.rect { 0, -2, 20, 4 }, "M4 30C20 4 40 4 60 30"
    local bow = { 4, 30, 20, 4, 40, 4, 60, 30 }
    for _, along in ipairs { { bow }, celspan.path { contours = { bow } } } do
      assert.equal(drawn(bar:warp { along = curve }), drawn(bar:warp { along = along }))
    end
    assert.equal(drawn(celspan.brush { d = curve, width = 3 }),
      drawn(celspan.brush { d = { bow }, width = 3 }))
  end)

  it("are mixed by keys", function()
    local track = keys { { 0, { { 0, 0, 0, 0, 8, 8, 8, 8, closed = true } } },
                         { 1, { { 2, 4, 0, 0, 8, 8, 8, 8, closed = true } } } }
    assert.same({ { 1, 2, 0, 0, 8, 8, 8, 8, closed = true } }, track:at(0.5))
  end)

  it("are refused with the contour and the number", function()
    local function path(contours)
      return function() celspan.path { contours = contours } end
    end
    raised.each {
      ["path: give one of 'd' and 'contours'"] = function() celspan.path {} end,
      ["path: give 'd' or 'contours', not both"] = function()
        celspan.path { d = "M0 0", contours = {} }
      end,
      ["path: contours must be a list of contours { x, y, ... }, got string"] = path "M0 0",
      ["path: contours[1] must be a list of numbers, { x, y, ... }, got number"] = path { 0, 0 },
      ["path: contours[2] has 7 numbers; it must have 2, and 6 more for each piece"] =
        path { OPEN, { 1, 2, 3, 4, 5, 6, 7 } },
      ["path: contours[1] has 0 numbers; it must have 2"] = path { {} },
      ["path: contours[2][3] must be a number, got nil"] = path { OPEN, { 1, 2, [8] = 3 } },
      ["path: contours[1][2] must be a finite number, got nan"] = path { { 1, 0 / 0 } },
      ["path: contours[1][2] must be a number, got string"] = path { { 1, "2" } },
      ["path: contours[1][1] is 2e12; it must be between -1e12 and 1e12"] = path { { 2e12, 0 } },
      ["path: contours[1] has the field 'close'; beside its numbers it may only have 'closed'"] =
        path { { 1, 2, close = true, open = true } },
      ["path: contours[1].closed must be true or false, got number"] =
        path { { 1, 2, closed = 1 } },
      ["stroke: contours[2][2] must be a number, got boolean"] = function()
        celspan.stroke { contours = { OPEN, { 1, true } } }
      end,
      ["motion: contours[1] has 4 numbers"] = function() motion.along { { 1, 2, 3, 4 } } end,
      ["warp: contours[1] has 3 numbers"] = function()
        celspan.circle { centre = { 0, 0 }, radius = 9 }:warp { along = { { 1, 2, 3 } } }
      end,
    }
  end)
end)
