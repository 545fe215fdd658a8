-- Films and the f of their frame functions.
local celspan = require "celspan"
local raised = require "tests.support.raised"

local empty = celspan.rostrum {}

--- The f of one frame of a film made of `fields`.
local function frame_of(number, fields)
  local seen
  fields.frame = function(f)
    seen = f
    return empty
  end
  celspan.film(fields):at(number)
  return seen
end

describe("a film", function()
  it("has presets", function()
    local film = celspan.film { frame = function() return empty end }
    assert.are.same({ 1920, 1080 }, film.size)
    assert.are.same({ 24, 1, 1, 0 }, { film.fps, film.frames, film.first, film.sound_offset })
  end)

  it("accepts a duration instead of a number of frames", function()
    local film = celspan.film { fps = 12, duration = 2, frame = function() return empty end }
    assert.are.equal(24, film.frames)
    assert.are.equal(5, film:with { frames = 60 }.duration)
    assert.are.equal(12, film:with { duration = 1 }.frames)
    assert.are.equal(6, film:with { fps = 6, frames = 6 }.frames)
  end)

  it("refuses fractional numbers of frames, and sizes of 0", function()
    local function refuses(fields)
      fields.frame = print
      raised.message(celspan.film, fields)
    end
    refuses { frames = 2.5 }
    refuses { frames = 0 }
    refuses { size = { 0, 10 } }
    refuses { fps = 0 }
    refuses { duration = -1 }
  end)

  it("has a poster, which is one of its frames", function()
    local function film_with(poster)
      return { frames = 48, first = 11, poster = poster, frame = print }
    end
    for _, poster in ipairs { 11, 58, "0s", "1.99s" } do
      assert.equal(poster, celspan.film(film_with(poster)).poster)
    end
    for _, poster in ipairs { 10, 59, 11.5, 0 / 0, "2s", "bell", "11", true, {} } do
      local message = raised.message(celspan.film, film_with(poster))
      assert.is_truthy(message:find('field \'poster\' must be a frame of the film, 11 to 58, or a '
        .. 'time in it, such as "2s", got ', 1, true), message)
    end
    raised.message(function() celspan.film(film_with(58)):with { frames = 9 } end)
  end)

  it("names the line and the frame of an error", function()
    local line = debug.getinfo(1, "l").currentline + 2
    local film = celspan.film { frames = 9, frame = function()
      return celspan.circle { raduis = 3 }
    end }
    local message = raised.message(film.at, film, 7)
    assert.is_truthy(message:find(("film_spec.lua:%d: frame 7: circle: unknown field"):format(line),
      1, true), message)
  end)

  it("reports what a frame function must return", function()
    local film = celspan.film { frame = function() return "cel" end }
    local line = debug.getinfo(1, "l").currentline - 1
    local message = raised.message(film.at, film, 1)
    assert.is_truthy(message:find(("film_spec.lua:%d: frame 1: the frame function's result "
      .. "must be a rostrum, an object"):format(line), 1, true), message)
  end)

  it("finds a line for an error without one", function()
    local film = celspan.film { frame = function() error({}) end }
    local line = debug.getinfo(1, "l").currentline - 1
    local message = raised.message(film.at, film, 1)
    assert.is_truthy(message:find(("film_spec.lua:%d: frame 1: the error is not a message"):format(
      line), 1, true), message)
  end)

  it("accepts several exposures", function()
    local film = celspan.film { frame = function() return { { empty, 0.25 }, { empty, 0.75 } } end }
    assert.are.equal(0.75, film:at(1)[2][2])
  end)
end)

describe("f", function()
  it("knows where it is", function()
    local f = frame_of(13, { size = { 640, 360 }, fps = 24, frames = 25, first = 1 })
    assert.are.same({ 13, 12, 25, 24, 640, 360 },
      { f.number, f.index, f.count, f.fps, f.width, f.height })
    assert.are.equal(0.5, f.time)
    assert.are.equal(12.5 / 24, f.middle)
    assert.are.equal(0.5, f.progress)
  end)

  it("counts from first", function()
    local f = frame_of(101, { frames = 10, first = 100 })
    assert.are.same({ 101, 1 }, { f.number, f.index })
  end)

  it("has no progress in a film of one frame", function()
    assert.are.equal(0, frame_of(1, {}).progress)
  end)

  it("holds on twos and threes", function()
    local held = {}
    for number = 1, 7 do held[number] = frame_of(number, { frames = 7 }):on(3) end
    assert.are.same({ 0, 0, 0, 3, 3, 3, 6 }, held)
    assert.are.equal(2, frame_of(4, { frames = 7 }):on(4 / 2))
    local frame = frame_of(6, { frames = 7, fps = 10 })
    assert.are.same({ 0.4, 0.3 }, { frame:twos(), frame:threes() })
    raised.message(frame_of(4, { frames = 7 }).on, frame_of(4, { frames = 7 }), 1.5)
  end)

  it("cannot be changed", function()
    local f = frame_of(1, {})
    local message = raised.message(function() f.number = 3 end)
    assert.is_truthy(message:find("frames are immutable", 1, true))
  end)
end)

describe("f:random", function()
  local function fields() return { frames = 100, title = "one" } end

  it("is a pure function of film, frame and label", function()
    assert.are.equal(frame_of(5, fields()):random "rain", frame_of(5, fields()):random "rain")
    assert.are_not.equal(frame_of(5, fields()):random "rain", frame_of(6, fields()):random "rain")
    assert.are_not.equal(frame_of(5, fields()):random "rain", frame_of(5, fields()):random "snow")
    assert.are_not.equal(frame_of(5, fields()):random "rain",
      frame_of(5, { frames = 100, title = "two" }):random "rain")
  end)

  it("fills its range evenly", function()
    local f, sum, seen = frame_of(5, fields()), 0, {}
    for i = 1, 6000 do
      local x = f:random(i)
      assert.is_true(x >= 0 and x < 1)
      sum = sum + x
      local die = f:random(i, 6)
      seen[die] = (seen[die] or 0) + 1
    end
    assert.is_true(math.abs(sum / 6000 - 0.5) < 0.02)
    assert.are.equal(6, #seen)
    for side = 1, 6 do assert.is_true(math.abs(seen[side] - 1000) < 150) end
  end)

  it("accepts any range of whole numbers", function()
    local f = frame_of(5, fields())
    for i = 1, 50 do
      local x = f:random(i, -2, 2)
      assert.is_true(math.type(x) == "integer" and x >= -2 and x <= 2)
    end
    assert.are.equal(3, f:random("x", 3, 3))
    assert.are.equal("integer", math.type(f:random("x", math.mininteger, math.maxinteger)))
    raised.message(f.random, f, "x", 2, 1)
  end)
end)
