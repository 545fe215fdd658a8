-- The messages for a script's author: the line, the field, the given value.
local celspan = require "celspan"
local raised = require "tests.support.raised"

local function sentence(call)
  return (raised.sentence(call))
end

describe("the interpreter", function()
  it("is Lua 5.4", function()
    assert.are.equal("Lua 5.4", _VERSION)
  end)
end)

describe("a mistyped name", function()
  it("is reported with the nearest known one", function()
    assert.are.equal("circle: unknown field 'raduis'; did you mean 'radius'?", sentence(function()
      celspan.circle { centre = { 0, 0 }, raduis = 3 }
    end))
  end)

  it("is reported with the field that has such values", function()
    assert.are.equal("path: unknown field 'winding'; write rule = \"evenodd\"", sentence(function()
      celspan.path { d = "M0 0 L1 1 L2 0", winding = "evenodd" }
    end))
  end)

  it("is reported before wrong types", function()
    assert.are.equal("circle: unknown field 'raduis'; did you mean 'radius'?", sentence(function()
      celspan.circle { centre = "here", raduis = "big" }
    end))
  end)

  it("is reported with all names if none is near", function()
    assert.are.equal("rect: unknown field 'sparkle'; the fields are radius, fill",
      sentence(function() celspan.rect { 0, 0, 1, 1, sparkle = true } end))
  end)

  it("is reported if there are no names at all", function()
    assert.are.equal("union: unknown field 'sparkle'; there are no named fields",
      sentence(function() celspan.union { sparkle = true } end))
  end)

  it("is found in tables inside", function()
    assert.are.equal("rostrum: camera: unknown field 'widht'; did you mean 'width'?",
      sentence(function() celspan.rostrum { camera = { widht = 3 } } end))
    assert.are.equal("cel: front: unknown field 'gian'; did you mean 'gain'?", sentence(function()
      celspan.cel { front = { texture = "#fff", gian = 2 } }
    end))
    assert.are.equal("cel: defocus: unknown field 'radus'; did you mean 'radius'?",
      sentence(function() celspan.cel { defocus = { radus = 3 } } end))
  end)

  it("is found in the changes of with", function()
    local circle = celspan.circle { centre = { 0, 0 }, radius = 3 }
    assert.are.equal("circle: unknown field 'radios'; did you mean 'radius'?",
      sentence(function() circle:with { radios = 4 } end))
  end)

  it("is found in options", function()
    assert.are.equal("pixels: unknown field 'sise'; did you mean 'size'?",
      sentence(function() celspan.pixels(celspan.rostrum {}, { sise = { 1, 1 } }) end))
  end)
end)

describe("an error", function()
  it("has the line of the call", function()
    local expected = debug.getinfo(1, "l").currentline + 2
    local _, line = raised.sentence(function()
      celspan.circle { radius = "3", centre = { 0, 0 } }
    end)
    assert.are.equal(expected, line)
  end)

  it("has the line of a method and of an operator", function()
    local circle = celspan.circle { radius = 3, centre = { 0, 0 } }
    local here = debug.getinfo(1, "l").currentline
    local _, of_method = raised.sentence(function() circle:translate("left", 1) end)
    local _, of_operator = raised.sentence(function() return circle | 1 end)
    local _, of_with = raised.sentence(function() circle:with { radius = "x" } end)
    assert.are.same({ here + 1, here + 2, here + 3 }, { of_method, of_operator, of_with })
  end)
end)

describe("a long text, or one with control characters", function()
  it("is shown in part, and without them", function()
    assert.are.equal(('circle: field \'texture\' must be a paint, a texture or a colour like '
      .. '"#rrggbb", got "%s..."'):format(("x"):rep(60)),
      sentence(function()
        celspan.circle { centre = { 0, 0 }, radius = 1, texture = ("x"):rep(1 << 20) }
      end))
    assert.are.equal('rgb: takes numbers or a colour like "#rrggbb", got "?[31m?"',
      sentence(function() celspan.rgb "\27[31m\n" end))
    assert.are.equal(('rgb: takes numbers or a colour like "#rrggbb", got "%s..."')
      :format(("x"):rep(59)),
      sentence(function() celspan.rgb(("x"):rep(59) .. "é") end))
  end)
end)

describe("a method of the animation library", function()
  local keys, motion = require "celspan.keys", require "celspan.motion"
  local sheet = require "celspan.sheet"

  it("is refused for a value of another kind", function()
    local s = sheet.new { layers = { "A" } }
    local cases = { { keys { { 0, 1 } }, "keys", "at" }, { motion.along "M0 0H9", "motion", "at" },
                    { motion.wiggle "x", "motion", "at" }, { s, "sheet", "at" },
                    { s, "sheet", "text" },
                    { s, "sheet", "notes_at" }, { s, "sheet", "drawing" } }
    for _, case in ipairs(cases) do
      local subject, noun, method = table.unpack(case)
      for _, other in ipairs { {}, 1, "x", celspan.rostrum {} } do
        local kind = type(other) == "userdata" and "a rostrum" or type(other)
        assert.are.equal(("%s: %s: call it as a method, value:%s(...), got %s")
          :format(noun, method, method, kind),
          sentence(function()
            local answer = subject[method](other, 1)
            return answer
          end))
      end
    end
  end)

  it("reports an ease that does not return a number", function()
    local track = keys { { 0, 1 }, { 1, 2, function() return "x" end } }
    assert.are.equal("keys: an ease must return a finite number, got string", sentence(function()
      local value = track:at(0.5)
      return value
    end))
  end)
end)

describe("a list with metamethods", function()
  it("is read without calling them", function()
    local keys, motion = require "celspan.keys", require "celspan.motion"
    local long = { __len = function() return 0 / 0 end }
    assert.are.equal(1, keys(setmetatable({ { 0, 1 } }, long)):at(0))
    assert.are.equal(3, motion.along(setmetatable({ { 0, 0 }, { 3, 0 } }, long)).length)
  end)
end)

describe("a wrong type", function()
  local cases = {
    { "circle: field 'radius' must be a number, got string",
      function() celspan.circle { centre = { 0, 0 }, radius = "3" } end },
    { "circle: field 'radius' must be a number, got nil",
      function() celspan.circle { centre = { 0, 0 } } end },
    { "circle: field 'centre' must be a point {x, y}, got nil",
      function() celspan.circle { radius = 1 } end },
    { "circle: field 'centre' must be a point {x, y}, got 3 values",
      function() celspan.circle { centre = { 0, 0, 0 }, radius = 1 } end },
    { "circle: takes a table, circle{ ... }, got number", function() celspan.circle(3) end },
    { "cel: item 1 must be an object, got a list; table.unpack(list) gives its objects",
      function() celspan.cel { { celspan.union {} } } end },
    { "rect: value 3 (width) must be a number, got string",
      function() celspan.rect { 0, 0, "1", 1 } end },
    { "rect: takes four numbers: x, y, width, height, got 5 values",
      function() celspan.rect { 0, 0, 1, 1, 1 } end },
    { "circle: takes {x, y, r}, got 1 value",
      function() celspan.circle { 3, centre = { 0, 0 }, radius = 1 } end },
    { "polygon: point 2 must be {x, y}, got number",
      function() celspan.polygon { { 0, 0 }, 3, { 1, 1 } } end },
    { 'polygon: field \'rule\' must be "nonzero" or "evenodd", got "odd"',
      function() celspan.polygon { { 0, 0 }, { 1, 0 }, { 1, 1 }, rule = "odd" } end },
    { 'rect: field \'texture\' must be a paint, a texture or a colour like "#rrggbb", got "redd"; '
      .. 'did you mean "red"?',
      function() celspan.rect { 0, 0, 1, 1, texture = "redd" } end },
    { "nurbs: field 'degree' must be a whole number, got 2.5",
      function() celspan.nurbs { points = { { 0, 0 } }, degree = 2.5 } end },
    { "union: item 2 must be an object, got a cel",
      function() celspan.union { celspan.union {}, celspan.cel {} } end },
    { "text: unknown field 'along'; celspan.letters(text, nil, { along = ... }) sets a text along "
        .. "a path", function() celspan.text { "a", along = "M0 0 H9" } end },
    { "rostrum: item 1 must be a cel, got a union: put it into celspan.cel { ... }",
      function() celspan.rostrum { celspan.union {} } end },
    { 'cel: field \'front\' must be a light {r, g, b}, {r, g, b, a} or "#rrggbb", got number',
      function() celspan.cel { front = 1 } end },
    { "linear: stop 2: its value 1 must be a number, got string",
      function()
        celspan.linear { from = { 0, 0 }, to = { 1, 0 }, { 0, "#000" }, { "end", "#fff" } }
      end },
    { "rgb: blue must be a number, got no value", function() celspan.rgb(1, 0) end },
    { "operator |: both sides must be objects, the right one is number",
      function() return celspan.union {} | 3 end },
    { "film: field 'frame' must be a function(f) that returns a rostrum, got nil",
      function() celspan.film { frames = 3 } end },
    { "film: give 'frames' or 'duration', not both",
      function() celspan.film { frames = 3, duration = 3, frame = print } end },
    { "pixels: argument 1 must be a rostrum, an object, a cel or a list of them, got a paint",
      function() celspan.pixels(celspan.clear) end },
    { "rostrum: antialias: radius is -1; it must be between 0 and 256",
      function() celspan.rostrum { antialias = { kernel = "gaussian", radius = -1 } } end },
  }
  for _, case in ipairs(cases) do
    it("is reported: " .. case[1], function()
      assert.are.equal(case[1], sentence(case[2]))
    end)
  end
end)

describe("a list of numbers", function()
  local circle = celspan.circle { centre = { 0, 0 }, radius = 3 }
  local huge, nan = math.huge, 0 / 0
  local cases = {
    { "circle: centre[1] must be a number, got nil",
      function() celspan.circle { centre = { nil, 10 }, radius = 1 } end },
    { "circle: centre[2] must be a number, got nil",
      function() celspan.circle { centre = { 10 }, radius = 1 } end },
    { "circle: centre[2] must be a number, got string",
      function() celspan.circle { centre = { 10, "20" }, radius = 1 } end },
    { "circle: centre[1] must be a finite number, got nan",
      function() celspan.circle { centre = { nan, 10 }, radius = 1 } end },
    { "circle: field 'centre' must be a point {x, y}, got an empty table",
      function() celspan.circle { centre = {}, radius = 1 } end },
    { "circle: field 'centre' must be a point {x, y}, got string",
      function() celspan.circle { centre = "10,20", radius = 1 } end },
    { "circle: field 'centre' must be a point {x, y}: write {10, 20}, not {x = 10, y = 20}",
      function() celspan.circle { centre = { x = 10, y = 20 }, radius = 1 } end },
    { "circle: field 'centre' must be a point {x, y}: write {10, y}, not {x = 10}",
      function() celspan.circle { centre = { x = 10 }, radius = 1 } end },
    { "ellipse: radii[2] must be a finite number, got inf",
      function() celspan.ellipse { centre = { 0, 0 }, radii = { 1, huge } } end },
    { "cel: field 'viewport' must be a box {x, y, w, h}: write {0, 0, 8, 6}, "
      .. "not {x = 0, y = 0, width = 8, height = 6}",
      function() celspan.cel { viewport = { x = 0, y = 0, width = 8, height = 6 } } end },
    { "cel: viewport[4] must be a number, got nil",
      function() celspan.cel { viewport = { 0, 0, 8 } } end },
    { "cel: front[3] must be a number, got nil", function() celspan.cel { front = { 1, 1 } } end },
    { "cel: field 'front' must be a light {r, g, b, a}, got 5 values",
      function() celspan.cel { front = { 1, 1, 1, 1, 1 } } end },
    { "rostrum: field 'back' must be a light {r, g, b, a}: write {1, 0, 0, a}, "
      .. "not {r = 1, g = 0, b = 0}",
      function() celspan.rostrum { back = { r = 1, g = 0, b = 0 } } end },
    { "rostrum: camera: centre[1] must be a number, got boolean",
      function() celspan.rostrum { camera = { centre = { true, 1 } } } end },
    { "paint: pigment[2] must be a number, got nil",
      function() celspan.paint { pigment = { 1, nil, 1 } } end },
    { "polygon: point 2: its value 1 must be a number, got nil",
      function() celspan.polygon { { 0, 0 }, { nil, 1 }, { 1, 1 } } end },
    { "polygon: point 2 must be {x, y}: write {1, 2}, not {x = 1, y = 2}",
      function() celspan.polygon { { 0, 0 }, { x = 1, y = 2 } } end },
    { "triangle: point 3 must be {x, y}, got 3 values",
      function() celspan.triangle { { 0, 0 }, { 1, 0 }, { 1, 1, 1 } } end },
    { "nurbs: point 1: its value 3 must be a finite number, got nan",
      function() celspan.nurbs { points = { { 0, 0, nan } } } end },
    { "nurbs: knots[3] must be a number, got string", function()
      celspan.nurbs { points = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }, knots = { 0, 1, "2" } }
    end },
    { "linear: stop 1: its value 1 must be a finite number, got inf",
      function() celspan.linear { from = { 0, 0 }, to = { 1, 0 }, { huge, "#000" } } end },
    { "linear: stop 1 must be {at, paint}: write {0, paint}, not {at = 0, paint = ...}", function()
      celspan.linear { from = { 0, 0 }, to = { 1, 0 }, { at = 0, paint = "#000" } }
    end },
    { "gradient: corner 1: its value 2 must be a number, got string",
      function() celspan.gradient { { 0, "#fff" }, { 1, 0, "#fff" }, { 1, 1, "#fff" } } end },
    { "scanline: bounds[1] must be a number, got nil",
      function() celspan.scanline { bounds = { nil, 0, 1, 1 }, spans = print } end },
    { "film: size[2] must be a number, got nil",
      function() celspan.film { size = { 8 }, frame = print } end },
    { "pixels: crop[1] must be a number, got nil",
      function() celspan.pixels(celspan.rostrum {}, { crop = { nil, 0, 1, 1 } }) end },
    { "spans: field 'rows' must be rows {first, last}: write {1, 2}, not {first = 1, last = 2}",
      function() celspan.spans(celspan.rostrum {}, { rows = { first = 1, last = 2 } }) end },
    { "transform: value 9 of the matrix must be a number, got nil",
      function() circle:transform { 1, 0, 0, 0, 1, 0, 0, 0 } end },
    { "transform: the matrix must be {a,b,c, d,e,f, g,h,i}, got 10 values",
      function() circle:transform { 1, 0, 0, 0, 1, 0, 0, 0, 1, 1 } end },
    { "quad: point 2 of the other four: its value 1 must be a number, got nil", function()
      local corners = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }
      circle:quad(corners, { { 0, 0 }, { nil, 0 }, { 1, 1 }, { 0, 1 } })
    end },
    { "quad: the first four must be four points {{x, y}, {x, y}, {x, y}, {x, y}}, got 1 of them",
      function() circle:quad({ { 0, 0 } }, {}) end },
  }
  for _, case in ipairs(cases) do
    it("is refused with the position of the fault: " .. case[1], function()
      assert.are.equal(case[1], sentence(case[2]))
    end)
  end
end)

describe("named numbers that must be positional", function()
  local cases = {
    { "rect: write rect{ 1, 2, 3, 4 }, not rect{ x = 1, y = 2, w = 3, h = 4 }",
      function() celspan.rect { x = 1, y = 2, w = 3, h = 4 } end },
    { "rect: write rect{ x, y, 3, 4 }, not rect{ width = 3, height = 4 }",
      function() celspan.rect { width = 3, height = 4 } end },
    { "circle: unknown field 'x'; write centre = {10, 20}, not x = 10, y = 20",
      function() celspan.circle { x = 10, y = 20, radius = 3 } end },
    { "circle: unknown field 'cx'; write centre = {10, 20}, not cx = 10, cy = 20",
      function() celspan.circle { cx = 10, cy = 20, radius = 3 } end },
    { "ellipse: unknown field 'rx'; write radii = {3, 4}, not rx = 3, ry = 4",
      function() celspan.ellipse { centre = { 0, 0 }, rx = 3, ry = 4 } end },
    { "film: unknown field 'height'; write size = {8, 6}, not width = 8, height = 6",
      function() celspan.film { width = 8, height = 6, frame = print } end },
    { "polygon: unknown field 'points'; write the points into the table itself, "
      .. "polygon{ a, b, ... }, not polygon{ points = ... }",
      function() celspan.polygon { points = { { 0, 0 } } } end },
    { "cel: unknown field 'objects'; write the objects into the table itself, cel{ a, b, ... }, "
      .. "not cel{ objects = ... }", function() celspan.cel { objects = {} } end },
  }
  for _, case in ipairs(cases) do
    it("are reported with the correct form: " .. case[1], function()
      assert.are.equal(case[1], sentence(case[2]))
    end)
  end
end)

describe("reading an unknown field", function()
  local circle = celspan.circle { centre = { 0, 0 }, radius = 3 }
  local image = celspan.pixels(celspan.rostrum {}, { size = { 1, 1 } })
  local keys = require "celspan.keys"
  local motion = require "celspan.motion"
  local way = motion.along { { 0, 0 }, { 1, 0 } }
  local function in_frame(read)
    return function()
      celspan.film { frame = function(f) return celspan.rostrum {}, read(f) end }:at(1)
    end
  end
  local cases = {
    { "celspan has no 'circl'; did you mean 'circle'?", function() return celspan.circl end },
    { "celspan has no 'nothing_like_it'", function() return celspan.nothing_like_it end },
    { "celspan has no 'keys'; it is a module: require \"celspan.keys\"",
      function() return celspan.keys end },
    { "circle: unknown field 'raduis'; did you mean 'radius'?",
      function() return circle.raduis end },
    { "circle: unknown field 'transalte'; did you mean 'translate'?",
      function() circle:transalte(1, 2) end },
    { "rect: unknown field 'color'; did you mean 'fill'?",
      function() return celspan.rect { 0, 0, 1, 1, color = "#fff" } end },
    { "picture: unknown field 'colou'; did you mean 'colour'?",
      function() return celspan.picture { file = "a.png", colou = "srgb" } end },
    { "circle: unknown field 'r'; did you mean 'radius'?",
      function() return celspan.circle { centre = { 0, 0 }, r = 3 } end },
    { "circle: unknown field 'cenrte'; did you mean 'centre'?",
      function() return celspan.circle { cenrte = { 0, 0 }, radius = 3 } end },
    { "paint: unknown field 'betta'; did you mean 'beta'?",
      function() return celspan.clear.betta end },
    { "film: unknown field 'farmes'; did you mean 'frames'?",
      function() return celspan.film { frame = print }.farmes end },
    { "frame 1: frame: unknown field 'tiem'; did you mean 'time'?",
      in_frame(function(f) return f.tiem end) },
    { "frame 1: frame: unknown field 'radnom'; did you mean 'random'?",
      in_frame(function(f) return f:radnom "a" end) },
    { "pixels: unknown field 'widht'; did you mean 'width'?", function() return image.widht end },
    { "probe: unknown field 'flim'; did you mean 'film'?",
      function() celspan.probe(celspan.rostrum {}, 0, 0, { flim = { 1, 1 } }) end },
    { "celspan.motion has no 'alogn'; did you mean 'along'?",
      function() return motion.alogn end },
    { "celspan.ease has no 'name'; did you mean 'names'?",
      function() return require "celspan.ease".name end },
    { "celspan.lips has no 'raed'; did you mean 'read'?",
      function() return require "celspan.lips".raed end },
    { "celspan.ease has no 'outBounce': write ease \"outBounce\"",
      function() return require "celspan.ease".outBounce end },
    { "ease: there is no curve \"outBounse\"; did you mean \"outbounce\"?",
      function() return require "celspan.ease".outBounse end },
    { "keys: key 1 must have a finite number, an array of numbers or points, a pose, a paint, a "
      .. "string or a boolean as value, got a linear: make it in the frame, of colours or numbers "
      .. "that have keys",
      function() keys { { 0, celspan.linear { "#f00", "#00f" } } } end },
    { "mix: argument 2 must be a paint or a colour like \"#rrggbb\", got a linear: mix the colours "
      .. "that it is made of", function()
        celspan.mix("#f00", celspan.linear { "#f00", "#00f" }, 0.5)
      end },
    { "celspan.keys has no 'foo'", function() return require "celspan.keys".foo end },
    { "a track of keys has no 'att'; did you mean 'at'?",
      function() return keys { { 0, 1 } }:att(0) end },
    { "a way has no 'lenght'; did you mean 'length'?", function() return way.lenght end },
    { "shutter: unknown field 'angel'; did you mean 'angle'?",
      function() require "celspan.shutter" { angel = 90 } end },
  }
  for _, case in ipairs(cases) do
    it("is refused with the nearest name: " .. case[1], function()
      assert.are.equal(case[1], (sentence(case[2]):gsub(" %(called from .*", "")))
    end)
  end

  it("is nil if the name is known but not set, and for indices", function()
    assert.is_nil(celspan.nurbs { points = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } } }.knots)
    assert.is_nil(celspan.union { circle }[2])
    assert.is_nil(circle[1])
    assert.is_nil(keys { { 0, 1 } }.loop)
  end)

  it("is possible without an error", function()
    assert.is_nil(rawget(celspan, "circl"))
    local count = 0
    for name in pairs(celspan) do count = count + #name end
    assert.is_true(count > 100)
  end)
end)

describe("film:at", function()
  local film = celspan.film { first = 10, frames = 3, frame = function()
    return celspan.rostrum {}
  end }
  local cases = {
    { "at: the frame's number must be a whole number from 10 to 12, got 9", 9 },
    { "at: the frame's number must be a whole number from 10 to 12, got 13", 13 },
    { "at: the frame's number must be a whole number from 10 to 12, got 10.5", 10.5 },
    { "at: the frame's number must be a number, got string", "10" },
    { "at: the frame's number must be a number, got no value" },
    { "at: the frame's number must be a finite number, got nan", 0 / 0 },
  }
  for _, case in ipairs(cases) do
    it("refuses: " .. case[1], function()
      assert.are.equal(case[1], sentence(function() film:at(table.unpack(case, 2)) end))
    end)
  end

  it("returns the film's frames", function()
    assert.is_truthy(film:at(10))
    assert.is_truthy(film:at(12.0))
  end)
end)

describe("the library", function()
  local motion = require "celspan.motion"
  local multiplane = require "celspan.multiplane"
  local cases = {
    { "motion: point 2: its value 1 must be a number, got nil",
      function() motion.along { { 0, 0 }, { nil, 1 } } end },
    { "motion: point 1: its value 2 must be a finite number, got nan",
      function() motion.along { { 0, 0 / 0 } } end },
    { "motion: point 1 must be {x, y}, got number", function() motion.along { 3 } end },
    { "motion: at takes a fraction of the length, a finite number, got nan",
      function() motion.along({ { 0, 0 } }):at(0 / 0) end },
    { "multiplane: film[2] must be a number, got nil", function() multiplane { film = { 8 } } end },
    { "multiplane: field 'film' must be {width, height}, the size of the film, got nil",
      function() multiplane {} end },
    { "multiplane: field 'aperture' must be 0 or more, got -1",
      function() multiplane { film = { 8, 8 }, aperture = -1 } end },
    { "multiplane: camera: takes named fields only, but was given a list",
      function() multiplane { film = { 8, 8 }, camera = { 1, 2 } } end },
    { "keys: takes a table, got a cel", function() require "celspan.keys" (celspan.cel {}) end },
    { 'keys: key 2 cannot have this ease: there is no curve "ot"; '
        .. "celspan help lua ease describes the names",
      function() require "celspan.keys" { { 0, 1 }, { 1, 1, "ot" } } end },
    { "motion: wiggle takes a seed, a string or a finite number, got nan",
      function() motion.wiggle(0 / 0) end },
    { "shutter: field 'angle' must be 0..360 degrees, got 361",
      function() require "celspan.shutter" { frame = print, angle = 361.0 } end },
    { "multiplane: plane 1 must be a rostrum, an object, a cel or a list of them, got string",
      function() multiplane { film = { 8, 8 }, { "rect" } } end },
    { "rostrum: field 'front' must be a light {r, g, b}, {r, g, b, a} or \"#rrggbb\", got number",
      function() multiplane { film = { 8, 8 }, front = 3 } end },
    { "lips: field 'fps' must be above 0 and at most 1000, got -3",
      function() require "celspan.lips".read("none", { fps = -3 }) end },
  }
  for _, case in ipairs(cases) do
    it("reports errors to the caller: " .. case[1], function()
      assert.are.equal(case[1], sentence(case[2]))
    end)
  end
end)

describe("what is done in other programs", function()
  local dot = celspan.circle { centre = { 0, 0 }, radius = 3 }
  local motion, multiplane = require "celspan.motion", require "celspan.multiplane"
  local cases = {
    { "objects are no numbers: a | b shows both, a - b cuts b out, and a:scale(2) makes it larger",
      function() return dot + dot end },
    { "a circle is no function: leave out the parentheses, as in art.object",
      function() return dot() end },
    { "cel: item 1 must be an object, got table; its field `object` is one: write .object after it",
      function() return celspan.cel { { object = dot } } end },
    { "a way is no function: write value:at(...)",
      function() dot:move_to(motion.along { { 0, 0 }, { 1, 0 } }(0.5)) end },
    { "circle: unknown field 'opacity'; did you mean 'fade'?", function() dot:opacity(0.5) end },
    { "circle: unknown field 'squash'; did you mean 'scale'?", function() dot:squash(0.5) end },
    { "circle: unknown field 'stroke'; value:stroke { width = 2, fill = ... } is the line along "
        .. "its edge",
      function() celspan.circle { 0, 0, 3, stroke = "red" } end },
    { "cel: unknown field 'z'; multiplane { film = f.size, { cel, z = ... } } has depths",
      function() celspan.cel { dot, z = 100 } end },
    { "glyphs: unknown field 'bold'; write variations = { wght = 700 }",
      function() celspan.glyphs { "A", font = "type/block.ttf", bold = true } end },
    { "multiplane: plane 1: write z = 1000 for its depth",
      function() multiplane { film = { 8, 8 }, { dot, 1000 } } end },
    { "celspan has no 'wiggle'; write motion.wiggle(seed):at(f.time)",
      function() return celspan.wiggle end },
  }
  for _, case in ipairs(cases) do
    it("is refused with what to write here: " .. case[1], function()
      assert.are.equal(case[1], sentence(case[2]))
    end)
  end
end)

describe("a scan-line primitive that would not stay upright", function()
  local refusal =
    "a scan-line primitive can be moved and scaled, but not rotated, skewed or put in perspective"
  local function rows()
    return celspan.scanline { bounds = { 0, 0, 9, 9 }, spans = function() end }
  end
  local cases = {
    { "rotate", function() rows():rotate(10) end },
    { "skew", function() (rows() | celspan.union {}):translate(3, 0):skew(5, 0) end },
    { "transform", function() rows():transform { 1, 0, 0, 0, 1, 0, 0, 0.1, 1 } end },
    { "rotate", function() celspan.cel { rows() - celspan.union {} }:rotate(-3) end },
  }
  for i, case in ipairs(cases) do
    it("is refused at the call: " .. case[1] .. " " .. i, function()
      assert.are.equal(case[1] .. ": " .. refusal, sentence(case[2]))
    end)
  end

  it("may be mirrored and rotated by 180 degrees", function()
    assert.is_truthy(rows():rotate(180):scale(-1, 2):translate(4, 4))
  end)
end)

describe("a number that is refused", function()
  local cases = {
    { "circle: radius is -1; ", function() celspan.circle { centre = { 0, 0 }, radius = -1 } end },
    { "circle: field 'radius' must be a finite number, got nan",
      function() celspan.circle { centre = { 0, 0 }, radius = 0 / 0 } end },
    { "rgb: pigment[1] is 2; ", function() celspan.rgb(2, 0, 0) end },
    { "fade: ", function() celspan.union {}:fade(0 / 0) end },
    { "rect: ", function() celspan.rect { math.huge, 0, 1, 1 } end },
    { "translate: dx must be between -1e12 and 1e12, got 2000000000000",
      function() celspan.union {}:translate(2e12, 0) end },
    { "translate: dy must be a finite number, got nan",
      function() celspan.union {}:translate(0, 0 / 0) end },
    { "rotate: the angle in degrees must be a finite number, got inf",
      function() celspan.union {}:rotate(math.huge) end },
    { "film: frames is 0; it must be between 1 and 1e09",
      function() celspan.film { frames = 0, frame = print } end },
    { "pixels: workers is -1; it must be 0 or more",
      function() celspan.pixels(celspan.rostrum {}, { size = { 1, 1 }, workers = -1 }) end },
    { "pixels: 1048576 x 1048576 pixels cannot be held in memory; render a crop, or into a file",
      function() celspan.pixels(celspan.rostrum {}, { size = { 1048576, 1048576 } }) end },
    { "get: x must be a whole number from 0 to 0, got 0.5",
      function() celspan.pixels(celspan.rostrum {}, { size = { 1, 1 } }):get(0.5, 0.0) end },
    { "pixels: 0 x 1 pixels are asked for; each side must be at least 1",
      function() celspan.pixels(celspan.rostrum {}, { size = { 0, 1 } }) end },
  }
  for _, case in ipairs(cases) do
    it("is reported by the name used in the script: " .. case[1], function()
      local rest = sentence(case[2])
      assert.are.equal(case[1], rest:sub(1, #case[1]))
    end)
  end
end)
