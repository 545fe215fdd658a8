-- From values to pixels, spans, points and files, through the Lua interface.
local celspan = require "celspan"
local present = require "tests.support.present"
local raised = require "tests.support.raised"
local system = require "tests.support.system"

local red, blue = celspan.rgb(1, 0, 0), celspan.rgb(0, 0, 1)

--- A red square on [2, 6) x [1, 4) over a blue ground; a film of 8 x 5.
local function scene()
  return celspan.rostrum {
    celspan.cel { celspan.rect { 0, 0, 8, 5, texture = blue },
                  celspan.rect { 2, 1, 4, 3, texture = red } },
  }
end

local options = { size = { 8, 5 }, workers = 1 }

describe("pixels", function()
  it("are linear and premultiplied, counted from 0", function()
    local image = assert(celspan.pixels(scene(), options))
    assert.are.same({ 8, 5 }, { image.width, image.height })
    assert.are.same({ 0, 0, 1, 1 }, { image:get(0, 0) })
    assert.are.same({ 1, 0, 0, 1 }, { image:get(2, 1) })
    assert.are.same({ 0, 0, 1, 1 }, { image:get(6, 1) })
    raised.message(image.get, image, 8, 0)
    raised.message(image.get, image, 0, -1)
    raised.message(image.get, image, 0.5, 0)
  end)

  it("of a crop equal those of the whole", function()
    local whole = assert(celspan.pixels(scene(), options))
    local crop = assert(celspan.pixels(scene(), { size = { 8, 5 }, crop = { 1, 1, 3, 2 } }))
    assert.are.same({ 3, 2 }, { crop.width, crop.height })
    for y = 0, 1 do
      for x = 0, 2 do
        assert.are.same({ whole:get(x + 1, y + 1) }, { crop:get(x, y) })
      end
    end
  end)

  it("scale with the size if the film's size is given", function()
    local image = assert(celspan.pixels(scene(), { size = { 16, 10 }, film = { 8, 5 } }))
    assert.are.same({ 1, 0, 0, 1 }, { image:get(11, 7) })
    assert.are.same({ 0, 0, 1, 1 }, { image:get(12, 7) })
  end)

  -- A chain ends and another one begins at a height where rows of tiles meet (engine/sweep/cull.h).
  it("show shapes next to one whose outline steps at a whole height", function()
    local step = celspan.path { d = "M10 0H40V64H20V48H10Z", texture = "#f00" }
    local shapes = { celspan.rect { 0, 0, 64, 64, texture = "#fff" } }
    for k = 1, 8 do
      shapes[#shapes + 1] = celspan.rect { 44 + k, 30, 62, 62, texture = celspan.rgb(0, k / 8, 1) }
    end
    shapes[#shapes + 1] = step
    local rostrum = celspan.rostrum { celspan.cel(shapes) }
    local view = { film = { 64, 64 } } -- large enough for shapes to be culled
    local image = celspan.pixels(rostrum, { size = { 640, 640 }, film = view.film,
                                            antialias = "area" })
    for y = 440, 559 do
      for x = 5, 639, 10 do
        assert.same({ celspan.probe(rostrum, (x + 0.5) / 10, (y + 0.5) / 10, view) },
          { image:get(x, y) }, ("pixel %d, %d"):format(x, y))
      end
    end
  end)

  it("of several exposures add", function()
    local image = assert(celspan.pixels({ { scene(), 0.25 }, { celspan.rostrum {}, 1 } }, options))
    assert.are.same({ 0.25, 0, 0, 0.25 }, { image:get(2, 1) })
  end)

  it("return nil and a message when the frame is refused", function()
    local image, message = celspan.pixels(scene(), { size = { 8, 5 }, crop = { 8, 0, 9, 5 } })
    assert.is_nil(image)
    assert.matches("crop 8,0,9,5 has no pixel of the frame of 8 x 5", message, 1, true)
  end)
end)

describe("spans", function()
  it("cover each row without a gap", function()
    local rows = assert(celspan.spans(scene(), options))
    for y = 0, 4 do
      local at = 0
      for _, span in ipairs(rows[y]) do
        assert.are.equal(at, span.x0)
        at = span.x1
      end
      assert.are.equal(8, at)
    end
  end)

  it("are single if nothing varies", function()
    local rows = assert(celspan.spans(scene(), { size = { 8, 5 }, rows = { 2, 3 } }))
    assert.is_nil(rows[1])
    assert.is_nil(rows[4])
    assert.are.same({ { x0 = 0, x1 = 2, kind = "single", 0, 0, 1, 1 },
                      { x0 = 2, x1 = 6, kind = "single", 1, 0, 0, 1 },
                      { x0 = 6, x1 = 8, kind = "single", 0, 0, 1, 1 } }, rows[2])
  end)

  it("are gradients with the colours of the first and last pixel", function()
    local ramp = celspan.linear { from = { 0, 0 }, to = { 8, 0 }, { 0, "#000" }, { 1, "#fff" } }
    local rostrum = celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 8, 5, texture = ramp } } }
    local span = assert(celspan.spans(rostrum, options))[2][1]
    assert.are.equal("gradient", span.kind)
    assert.is_true(math.abs(span[1] - 1 / 16) < 1e-6 and math.abs(span[5] - 15 / 16) < 1e-6)
  end)
end)

describe("probe", function()
  it("is the colour at a point of the film", function()
    assert.are.same({ 1, 0, 0, 1 }, { celspan.probe(scene(), 3.5, 2, { film = { 8, 5 } }) })
    assert.are.same({ 0, 0, 1, 1 }, { celspan.probe(scene(), 7, 2, { film = { 8, 5 } }) })
  end)
end)

describe("scanline", function()
  local function procedure(spans)
    return celspan.rostrum {
      celspan.cel { celspan.scanline { bounds = { 0, 0, 8, 5 }, spans = spans } },
    }
  end

  it("paints what the function returns", function()
    local rostrum = procedure(function(y) return { { 1, 3, red }, { 4, 4 + y / 2, blue } } end)
    local image = assert(celspan.pixels(rostrum, { size = { 8, 5 }, antialias = "none" }))
    assert.are.same({ 0, 0, 0, 0 }, { image:get(0, 0) })
    assert.are.same({ 1, 0, 0, 1 }, { image:get(1, 0) })
    assert.are.same({ 0, 0, 1, 1 }, { image:get(5, 3) })
    assert.are.same({ 0, 0, 0, 0 }, { image:get(5, 0) })
  end)

  it("receives the range of visible columns", function()
    local seen
    local rostrum = procedure(function(_, row)
      seen = row
      return {}
    end)
    assert(celspan.pixels(rostrum, { size = { 8, 5 }, antialias = "none" }))
    assert.are.equal(1, seen.pixel)
    assert.is_true(seen.x0 <= 0 and seen.x1 >= 8)
  end)

  it("passes on errors of the function, with their line", function()
    local image, message = celspan.pixels(procedure(function() error "no rain today" end), options)
    assert.is_nil(image)
    assert.is_truthy(message:find "render_spec.lua:%d+: no rain today")
    image, message = celspan.pixels(procedure(function() return { { 1, "x", red } } end), options)
    assert.is_nil(image)
    assert.is_truthy(message:find("scanline: span 1: its value 2 must be a number", 1, true))
  end)

  it("lives as long as the object, not the value", function()
    local rostrum = procedure(function() return { { 0, 8, red } } end)
    collectgarbage()
    collectgarbage()
    assert.are.same({ 1, 0, 0, 1 }, { assert(celspan.pixels(rostrum, options)):get(3, 3) })
  end)
end)

describe("render", function()
  local folder

  local function exists(name) return system.exists(folder .. name) end

  local function film(fields)
    fields = fields or {}
    fields.size, fields.frames = { 8, 5 }, fields.frames or 12
    fields.frame = fields.frame or scene
    return celspan.film(fields)
  end

  before_each(function()
    folder = os.tmpname()
    os.remove(folder)
    folder = folder .. "/"
  end)
  after_each(function() os.execute("rm -rf '" .. folder .. "'") end)

  it("writes the frames of a film", function()
    assert(celspan.render(film { frames = 3 }, folder .. "a.####.png"))
    assert.are.same({ true, true, true, false }, { exists "a.0001.png", exists "a.0002.png",
      exists "a.0003.png", exists "a.0004.png" })
  end)

  it("writes the requested frames, with file names as long as necessary", function()
    assert(celspan.render(film { first = 8 }, folder .. "b.%02d.png", { frames = "8-10:2" }))
    assert.are.same({ true, false, true }, { exists "b.08.png", exists "b.09.png",
      exists "b.10.png" })
    assert(celspan.render(film(), folder .. "c.#.png", { frames = 12 }))
    assert.is_true(exists "c.12.png")
  end)

  it("writes a rostrum as one picture", function()
    assert(celspan.render(scene(), folder .. "one.png", { size = { 8, 5 } }))
    assert.is_true(exists "one.png")
  end)

  it("refuses lists that overlap, leave the film or are not lists", function()
    local function message(frames, pattern)
      local done, text = celspan.render(film(), folder .. (pattern or "d.####.png"),
        { frames = frames })
      assert.is_nil(done)
      return text
    end
    assert.is_truthy(message("1-5,3"):find("frame 3 is listed twice", 1, true))
    assert.is_truthy(message("1-20:2,4-8:3"):find("frame 7 is listed twice", 1, true))
    assert.is_truthy(message("1-13"):find("frame 13 is outside the film", 1, true))
    assert.is_truthy(message("-3"):find("frame -3 is outside the film", 1, true))
    assert.is_truthy(message("1-3:0"):find("the step is 0", 1, true))
    assert.is_truthy(message("5-1"):find("needs a step below 0", 1, true))
    assert.is_truthy(message("1,,2"):find("a whole number is missing at character 3", 1, true))
    assert.is_truthy(message(""):find("a whole number is missing", 1, true))
    assert.is_truthy(message("1-2", "d.png"):find("no place for a frame number", 1, true))
  end)

  it("reports the line and the frame of an error", function()
    local bad = film { frame = function(f)
      return celspan.rostrum { f.number > 1 and 3 or nil }
    end }
    local done, message = celspan.render(bad, folder .. "e.####.png")
    assert.is_nil(done)
    assert.is_truthy(message:find(
      "render_spec.lua:%d+: frame 2: rostrum: item 1 must be a cel, got number"), message)
    assert.is_true(exists "e.0001.png")
  end)

  it("says what the argument of a frame function is where a number is expected", function()
    local bad = film { frame = function(t) return t * 2 end }
    local _, message = celspan.render(bad, folder .. "e.####.png")
    assert.is_truthy(message:find("(a frame function gets a table: write f.time, f.progress or "
      .. "f.number)", 1, true), message)
  end)

  it("says that a number of frames has no fields", function()
    local bad = film { frame = function(f) return f:on(2).time end }
    local _, message = celspan.render(bad, folder .. "e.####.png")
    assert.is_truthy(message:find("index a number value (a number has no fields: f:on(2), f:twos() "
      .. "and f.time are numbers themselves)", 1, true), message)
  end)

  it("reports its progress, and stops on request", function()
    local shares, last = {}, 0
    assert(celspan.render(film { frames = 2 }, folder .. "f.#.png", { workers = 1,
      progress = function(share, frame)
        assert.is_true(share >= last and share <= 1 and (frame == 1 or frame == 2))
        last = share
        shares[#shares + 1] = share
      end }))
    assert.is_true(#shares >= 2)
    local done = celspan.render(film(), folder .. "g.#.png",
      { progress = function() return false end })
    assert.is_nil(done)
    local _, message = celspan.render(film(), folder .. "h.#.png",
      { progress = function() error "enough" end })
    assert.is_truthy(message:find "enough")
  end)
end)

describe("a picture's wrap", function()
  local file = os.tmpname() .. ".png"
  -- Red, then blue; the colours of columns 0..5 of a row, with the picture in columns 2 and 3.
  local function row(fields)
    local pair = celspan.rect { 0, 0, 1, 1, texture = "#f00" }
      | celspan.rect { 1, 0, 1, 1, texture = "#00f" }
    assert(celspan.render(celspan.rostrum { celspan.cel { pair } }, file, { size = { 2, 1 } }))
    fields.file, fields.box, fields.sampling = file, { 2, 0, 2, 1 }, "nearest"
    local strip = celspan.rect { 0, 0, 6, 1, texture = celspan.picture(fields) }
    local image, message = celspan.pixels(celspan.rostrum { celspan.cel { strip }, back = "#fff" },
      { size = { 6, 1 } })
    os.remove(file)
    assert(image, message)
    local seen = {}
    for x = 0, 5 do
      local r, g, b = image:get(x, 0)
      seen[#seen + 1] = g > 0.5 and "." or r > 0.5 and "r" or b > 0.5 and "b" or "?"
    end
    return table.concat(seen)
  end

  it("determines the colours outside its box", function()
    if not present.pictures() then return pending "there is no picture module" end
    assert.are.equal("..rb..", row {})
    assert.are.equal("..rb..", row { wrap = "clear" })
    assert.are.equal("rrrbbb", row { wrap = "clamp" })
    assert.are.equal("rbrbrb", row { wrap = "repeat" })
  end)

  it("is opaque or not on any background: faded, it lets that share of it through", function()
    local behind = celspan.rect { 0, 0, 96, 40, texture = "#f00" }
    local greys = { rgb8 = "\128\128\128", rgba8 = "\128\128\128\255" }
    for _, wrap in ipairs { "clamp", "repeat", "clear" } do
      for format, texel in pairs(greys) do
        local antialias = wrap == "clamp" and "none" or "area"
        local grey = celspan.picture { pixels = texel:rep(64 * 64), size = { 64, 64 },
          format = format, box = { 0, 0, 64, 64 }, wrap = wrap }
        local sheet = celspan.rect { 0, 0, 64, 40, texture = grey }
        local function reddest(...)
          local image = assert(celspan.pixels(celspan.rostrum { antialias = antialias, ... },
            { size = { 96, 40 } }))
          local r, g = image:get(20, 20)
          return r - g
        end
        local back = celspan.cel { behind }
        assert.are.near(0, reddest(back, celspan.cel { sheet }), 1e-6)
        assert.are.near(0.25, reddest(back, celspan.cel { sheet:fade(0.75) }), 1e-6)
        assert.are.near(0.25, reddest(back, celspan.cel { sheet }:fade(0.75)), 1e-6)
        local pair = sheet:fade(0.5) | sheet:translate(70, 0)
        assert.are.near(0.5, reddest(back, celspan.cel { pair }), 1e-6)
      end
    end
  end)
end)

describe("a film, frame by frame", function()
  local film = celspan.film { size = { 8, 4 }, first = 5, frames = 3, frame = function(f)
    if f.number == 7 then error("no sky today") end
    return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, f.number, 4, texture = red } } }
  end }

  it("can be rendered by pixels, spans and probe", function()
    local image = assert(celspan.pixels(film, { frame = 6 }))
    assert.are.same({ 8, 4 }, { image.width, image.height })
    assert.are.same({ 1, 0, 0, 1, 0, 0, 0, 0 },
      table.move({ image:get(6, 0) }, 1, 4, 5, { image:get(5, 0) }))
    assert.are.equal(0, (assert(celspan.pixels(film)):get(5, 0)))
    assert.are.equal(10, assert(celspan.spans(film, { frame = 6, size = { 16, 8 } }))[0][1].x1 - 2)
    assert.are.same({ 1, 0 },
      { (celspan.probe(film, 5.5, 1, { frame = 6 })), (celspan.probe(film, 5.5, 1)) })
  end)

  it("reports what is wrong with a frame", function()
    for _, call in ipairs { celspan.pixels, celspan.spans,
                            function(...) return celspan.probe(film, 1, 1, select(2, ...)) end } do
      local nothing, message = call(film, { frame = 7 })
      assert.is_nil(nothing)
      assert.is_truthy(message:find("frame 7: no sky today", 1, true), message)
      message = raised.message(call, film, { frame = 8 })
      assert.is_truthy(message:find("frame 8 is not in the film, which has frames 5 to 7", 1, true),
        message)
    end
    local message = raised.message(celspan.pixels, scene(), { frame = 1 })
    assert.is_truthy(message:find("field 'frame' is for films", 1, true), message)
  end)
end)

describe("an image", function()
  local half = celspan.rostrum {
    celspan.cel { celspan.rect { 0, 0, 2, 1, texture = "#ff800080" } } }

  it("is a string of bytes in any coding", function()
    local image = assert(celspan.pixels(half, { size = { 3, 1 } }))
    assert.are.same({ 255, 128, 0, 128, 255, 128, 0, 128, 0, 0, 0, 0 },
      { image:bytes():byte(1, -1) })
    assert.are.equal(24, #image:bytes { depth = 16 })
    assert.are.equal(24, #image:bytes { depth = "half" })
    local r, g, b, a = string.unpack("<ffff", image:bytes { depth = "float" })
    assert.are.same({ image:get(0, 0) }, { r, g, b, a })
    local premultiplied = image:bytes { alpha = "premultiplied", colour = "linear" }
    assert.are.equal(128, premultiplied:byte(1))
    assert.are.equal("bytes: unknown field 'dept'; did you mean 'depth'?",
      (raised.sentence(function() image:bytes { dept = 8 } end)))
  end)

  it("is written as render writes it", function()
    local image = assert(celspan.pixels(scene(), options))
    local ours, theirs = os.tmpname() .. ".png", os.tmpname() .. ".png"
    assert.is_true(image:write(ours))
    assert.is_true(celspan.render(scene(), theirs, options))
    local a, b = assert(io.open(ours, "rb")), assert(io.open(theirs, "rb"))
    assert.are.equal(b:read "a", a:read "a")
    a:close()
    b:close()
    os.remove(ours)
    os.remove(theirs)
  end)

  it("reports why it cannot be written", function()
    local image = assert(celspan.pixels(scene(), options))
    local nothing, message = image:write("a.nothing")
    assert.is_nil(nothing)
    assert.is_truthy(message:find('the format "nothing" cannot be written', 1, true), message)
    nothing, message = image:write("/proc/no/such/place.png")
    assert.is_nil(nothing)
    assert.is_string(message)
    raised.message(image.write, image)
  end)
end)

describe("random", function()
  it("is a function of seed and label", function()
    local random = celspan.random("snow")
    assert.are.equal(random("x"), celspan.random("snow")("x"))
    assert.are_not.equal(random("x"), random("y"))
    assert.are_not.equal(random("x"), celspan.random("rain")("x"))
    assert.are_not.equal(celspan.random("a")("b"), celspan.random("ab")(""))
    local seen = {}
    for i = 1, 400 do
      local x, die = random(i), random(i, 6)
      assert.is_true(x >= 0 and x < 1)
      seen[die] = true
      assert.is_true(random(i, -2, 2) >= -2 and random(i, -2, 2) <= 2)
    end
    assert.are.equal(6, #seen)
    assert.are.equal("random: the seed must be a string or a number, got no value",
      (raised.sentence(function() celspan.random() end)))
    assert.are.equal("random: the label must be a string or a number, got boolean",
      (raised.sentence(function() random(true) end)))
  end)
end)
