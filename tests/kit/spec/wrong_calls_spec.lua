-- Wrong calls, a line each: every one raises an error at the call that says what it got.
-- tests/kit/spec/errors_spec.lua has the complete sentences.
local celspan = require "celspan"
local present = require "tests.support.present"
local raised = require "tests.support.raised"

local FONT = "../../../scripts/type/block.ttf"
local circle = celspan.circle { centre = { 5, 5 }, radius = 3 }
local rostrum = celspan.rostrum { celspan.cel { circle } }
local one = { film = { 9, 9 }, size = { 9, 9 } }
local film = celspan.film { size = { 4, 4 }, frames = 3, frame = function() return rostrum end }

local function with(changes)
  local options = {}
  for name, value in pairs(one) do options[name] = value end
  for name, value in pairs(changes) do options[name] = value end
  return options
end

--- cases: { call, a part of its message as plain text }.
local function check(cases)
  for i, case in ipairs(cases) do
    local sentence = raised.sentence(case[1])
    assert.is_truthy(sentence:find(case[2], 1, true), i .. ": " .. sentence)
  end
end

describe("wrong calls", function()
  it("of options say which", function()
    check {
      { function()
        celspan.pixels(rostrum, with { antialias = 3 })
      end, "field 'antialias' must be" },
      { function()
        celspan.pixels(rostrum, with { antialias = { kernel = "tent" } })
      end, "kernel" },
      { function() celspan.pixels(rostrum, with { crop = { 0, 0, 1.5, 2 } }) end,
        "field 'crop' must hold whole numbers of pixels" },
      { function() celspan.pixels(rostrum, with { crop = { 0, 0, 1e300, 2 } }) end,
        "field 'crop' must hold whole numbers of pixels" },
      { function() celspan.pixels(rostrum, with { workers = 1.5 }) end, "workers" },
      { function() celspan.pixels(rostrum, with { workers = 1e10 }) end, "workers" },
      { function()
        celspan.pixels(rostrum, with { size = { 4, 0 } })
      end, "4 x 0 pixels are asked for" },
      { function() celspan.pixels(rostrum, with { size = { 4.5, 4 } }) end, "size" },
      { function() celspan.film { size = { 279.84, 200 }, frame = print } end,
        "got 279.84; math.ceil makes a number whole" },
      { function() celspan.pixels({ { rostrum } }, one):bytes { depth = 12 } end,
        "field 'depth' must be 8, 16" },
      { function() celspan.pixels({ { rostrum } }, one):bytes { depth = "many" } end,
        "field 'depth' must be 8, 16" },
      { function()
        celspan.pixels({ 3 }, one)
      end, "argument 1: item 1 must be a rostrum, an object" },
      { function() celspan.pixels({ { film } }, one) end,
        "item 1: item 1 must be a rostrum, an object, a cel or a list of them, got a film" },
      { function() celspan.pixels({ { rostrum, "x" } }, one) end, "exposure 1" },
      { function() celspan.pixels(3, one) end, "must be a rostrum, an object" },
      { function() celspan.render(film, 3) end, "render" },
      { function() celspan.render(3, "a.png") end, "argument 1 must be a film or a rostrum" },
      { function() celspan.render(film, "/tmp/celspan-none/#.png", { progress = 3 }) end,
        "field 'progress' must be a function, got number" },
      { function() celspan.render(film, "/tmp/celspan-none/#.png", { frames = {} }) end, "frames" },
      { function() celspan.spans(rostrum, with { rows = { 5, 2 } }) end, "rows" },
      { function() celspan.spans(rostrum, with { rows = { 9, 9 } }) end, "rows" },
      { function() celspan.spans(rostrum, with { rows = { -1, 2 } }) end,
        "field 'rows' must be {first, last} with 0 <= first <= last, first below 9, got {-1, 2}" },
    }
  end)

  it("of films say which", function()
    local function frame() return rostrum end
    check {
      { function() celspan.film { size = { 0, 4 }, frame = frame } end, "size" },
      { function() celspan.film { size = { 4, 4.5 }, frame = frame } end, "size" },
      { function() celspan.film { size = { 4, 4 }, duration = -1, frame = frame } end, "duration" },
      { function()
        celspan.film { size = { 4, 4 }, duration = 1e12, frame = frame }
      end, "duration" },
      { function() celspan.film { size = { 4, 4 }, sound = "", frame = frame } end,
        "field 'sound' must be the name of a file, got an empty text" },
      { function()
        celspan.film { size = { 4, 4 }, sound = "a.wav", sound_offset = 1e12, frame = frame }
      end, "sound_offset is 1e12; it must be between -1e09 and 1e09" },
      { function() film:at(9) end, "9" }, { function() film:at "x" end, "at" },
      { function() film:at(0) end, "0" },
    }
    for step, told in pairs { [0] = "0", [-2] = "-2", [1.5] = "1.5", [1e300] = "1e+300",
      two = "string" } do
      local held = film:with { frame = function(f) f:on(step) return rostrum end }
      check { { function()
        held:at(1)
      end, "on: takes a whole number of frames, 1 or more, f:on(2), got " .. told } }
    end
  end)

  it("of unknown names in celspan say so", function()
    check {
      { function() return celspan.circl end, "celspan has no 'circl'; did you mean 'circle'?" },
      { function() return celspan.xyzzyq end, "celspan has no 'xyzzyq'" },
    }
    assert.is_nil(celspan[1])
    assert.is_nil(celspan[film])
  end)

  it("of primitives say which", function()
    check {
      { function() celspan.circle { centre = { 5, 5 }, radius = 3, [true] = 1 } end,
        "a field's name must be a word, got boolean" },
      { function() celspan.circle(3) end, "takes a table" },
      { function() celspan.ellipse { centre = { 1, 2 } } end, "radii" },
      { function() celspan.polygon { { 0, 0 }, { 1, 1 }, [5] = { 2, 2 } } end, "place" },
      { function() celspan.nurbs { points = { { 0, 0 }, { 1, 1 }, { 2, 0 } }, degree = 0 } end,
        "nurbs: degree is 0; it must be between 1 and 15" },
      { function()
        celspan.nurbs { points = { { 0, 0 }, { 1, 1 }, { 2, 0 } }, degree = 1e10 }
      end, "degree" },
      { function() celspan.nurbs { points = { { 0, 0 }, { 1, 1 }, { 2, 0 } }, knots = 3 } end,
        "an array of numbers" },
      { function() celspan.scanline { spans = function() end } end,
        "field 'bounds' must be a box {x, y, w, h}, got nil" },
      { function() celspan.scanline { bounds = { 0, 0, 1, 1 }, spans = 3 } end,
        "field 'spans' must be a function(y, row), got number" },
      { function() celspan.stroke { points = 3 } end, "field 'points' must be an array of points" },
      { function()
        celspan.stroke { outline = 3 }
      end, "field 'outline' must be a primitive, got number" },
      { function() circle:stroke(3) end, "stroke: takes a table" },
      { function() circle:with(3) end, "with takes a table of changes" },
      { function() circle.translate(3, 1, 2) end, "call it as a method" },
      { function() circle:quad({ { 0, 0 }, { 1, 0 } }, { { 0, 0 } }) end, "quad" },
      { function()
        circle:quad({ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 } },
          { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } })
      end,
        "quad: no perspective takes" },
      { function() return circle | 3 end, "both sides must be objects, the right one is" },
      { function() return 3 - circle end, "both sides must be objects, the left one is" },
      { function() celspan.gradient { { 0, 0, "#fff" }, { 1, 0, "#000" } } end,
        "takes three corners {x, y, paint}, got 2" },
      { function()
        celspan.linear { from = { 0, 0 }, to = { 1, 0 }, { 0, "blurple" }, { 1, "#000" } }
      end,
        "blurple" },
      { function()
        celspan.cel { circle, defocus = "far" }
      end, "field 'defocus' must be a radius" },
      { function()
        celspan.picture { pixels = "abc", size = { 1, 1 }, format = "rgba8" }
      end, "bytes" },
      { function()
        celspan.picture { pixels = "abcd", size = { 1.5, 1 }, format = "rgba8" }
      end, "size" },
      { function() celspan.picture { pixels = "abcd", size = { 1, 0 }, format = "rgba8" } end,
        "size[2] must be a whole number from 1 to 1048576, got 0" },
      { function() celspan.picture { pixels = "abcd", size = { 1e9, 1 }, format = "rgba8" } end,
        "size[1] must be a whole number from 1 to 1048576, got 1000000000" },
    }
  end)

  it("of files name what is wrong with the name", function()
    local zero = "the name of a file must not hold a zero byte, got 'm.mp4\\0...'"
    check {
      { function() celspan.footage { file = "m.mp4\0.png" } end, zero },
      { function() celspan.read "m.mp4\0" end, zero },
      { function() require "celspan.svg".read "m.mp4\0" end, zero },
      { function() celspan.plane_read "m.mp4\0" end, zero },
      { function() require "celspan.oca".read "hero" end,
        "oca: read takes a folder and the name of a document in it, got string and nil" },
    }
  end)

  it("of texts say which", function()
    check {
      { function()
        celspan.text { "A", font = "a\0b" }
      end, "field 'font' must not hold a zero byte" },
      { function() celspan.text { "A", font = "a.ttf", features = 3 } end,
        "field 'features' must be a table by name, got number" },
      { function() celspan.text { "A", font = "a.ttf", features = { liga = -1 } } end, "liga" },
      { function() celspan.text { "A", font = "a.ttf", features = { liga = 1.5 } } end, "liga" },
      { function()
        celspan.text { "A", font = "a.ttf", features = { "liga" } }
      end, "liga = false" },
      { function() celspan.text { "A", font = "a.ttf", variations = { 700 } } end, "wght = 700" },
      { function()
        celspan.text { "A", font = "a.ttf", features = { liga = 65536 } }
      end, "from 0 to 65535, got 65536" },
      { function()
        celspan.text { "A", font = "a.ttf", features = { liga = "on" } }
      end, "from 0 to 65535, got on" },
      { function()
        celspan.text { "A", font = "a.ttf", variations = { wght = "bold" } }
      end, "wght must be a number, got string" },
    }
    if not present.type() then return pending "no fonts are read" end
    local many = {}
    for i = 1, 66 do many[("f%03d"):format(i)] = true end
    check { -- in the order of their names, whatever that of the table is
      { function()
        celspan.text { "A", font = FONT, features = many }
      end, "65 features; at most 64 are allowed" },
      { function()
        celspan.text { "A", font = FONT, features = { zzzzz = 1, mmmmm = 1, aaaaa = 1 } }
      end, 'got "aaaaa"' },
      { function()
        celspan.text { "A", font = FONT, variations = { zzzzz = 1, mmmmm = 1, aaaaa = 1 } }
      end, 'got "aaaaa"' },
    }
  end)

  it("of images, random numbers and other values say which", function()
    local image = assert(celspan.pixels(rostrum, one))
    local random = celspan.random(7)
    check {
      { function() image:get(9, 0) end, "must be a whole number from 0 to 8, got 9" },
      { function() image:get("x", 0) end, "must be a whole number from 0 to 8" },
      { function() image:get(0, -1) end, "from 0 to 8" },
      { function() image:get(0.5, 0) end, "from 0 to 8" },
      { function() image:write(3) end, "write" },
      { function() random("a", 1.5) end, "must be a whole number, got 1.5" },
      { function() random("a", "x") end, "must be a whole number, got string" },
      { function() celspan.random {} end, "random" },
      { function() celspan.cel { circle, front = {} } end, "front" },
    }
  end)

  it("of procedures say what they returned", function()
    local function frame(spans)
      local object = celspan.scanline { bounds = { 0, 0, 4, 4 }, spans = spans }
      return select(2, celspan.pixels(celspan.rostrum { celspan.cel { object } }, one))
    end
    for _, case in ipairs {
      { function() return 3 end, "spans must return a list of {x0, x1, paint}, got number" },
      { function() return { 3 } end, "1" },
      { function() return { { 0 / 0, 2, "#fff" } } end, "its value 1 must be a finite number" },
      { function() return { { 0, 0 / 0, "#fff" } } end, "its value 2 must be a finite number" },
      { function() return { { 2, 1, "#fff" } } end, "ends at 1, before it begins at 2" },
      { function() return { { 2, 3, "#fff" }, { 0, 1, "#fff" } } end, "span 2" },
      { function() error {} end, "the error is not a message: table" },
      { function() error "mine" end, "mine" },
    } do
      local message = frame(case[1])
      assert.is_string(message)
      assert.is_truthy(message:find(case[2], 1, true), message)
    end
  end)
end)
