-- What a script's author reads when something is wrong: the line, the field, what was given.
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
  it("is told with the nearest known one", function()
    assert.are.equal("circle: unknown field 'raduis'; did you mean 'radius'?", sentence(function()
      celspan.circle { centre = { 0, 0 }, raduis = 3 }
    end))
  end)

  it("comes before wrong types", function()
    assert.are.equal("circle: unknown field 'raduis'; did you mean 'radius'?", sentence(function()
      celspan.circle { centre = "here", raduis = "big" }
    end))
  end)

  it("is told with all names when none is near", function()
    assert.are.equal("rect: unknown field 'sparkle'; the fields are radius, texture",
      sentence(function() celspan.rect { 0, 0, 1, 1, sparkle = true } end))
  end)

  it("is told where there are no names at all", function()
    assert.are.equal("union: unknown field 'sparkle'; there are no named fields",
      sentence(function() celspan.union { sparkle = true } end))
  end)

  it("is found in tables inside", function()
    assert.are.equal("rostrum: camera: unknown field 'widht'; did you mean 'width'?",
      sentence(function() celspan.rostrum { camera = { widht = 3 } } end))
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
  it("stands at the line of the call", function()
    local expected = debug.getinfo(1, "l").currentline + 2
    local _, line = raised.sentence(function()
      celspan.circle { radius = "3", centre = { 0, 0 } }
    end)
    assert.are.equal(expected, line)
  end)

  it("stands at the line of a method and of an operator", function()
    local circle = celspan.circle { radius = 3, centre = { 0, 0 } }
    local here = debug.getinfo(1, "l").currentline
    local _, of_method = raised.sentence(function() circle:translate("left", 1) end)
    local _, of_operator = raised.sentence(function() return circle | 1 end)
    local _, of_with = raised.sentence(function() circle:with { radius = "x" } end)
    assert.are.same({ here + 1, here + 2, here + 3 }, { of_method, of_operator, of_with })
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
    { "circle: field 'centre' must be an array of 2 numbers, got a table of 3 values",
      function() celspan.circle { centre = { 0, 0, 0 }, radius = 1 } end },
    { "circle: takes a table, circle{ ... }, got number", function() celspan.circle(3) end },
    { "rect: value 3 (width) must be a number, got string",
      function() celspan.rect { 0, 0, "1", 1 } end },
    { "rect: takes four numbers: x, y, width, height, got 5 values",
      function() celspan.rect { 0, 0, 1, 1, 1 } end },
    { "circle: takes named fields only, but was given a value at place 1",
      function() celspan.circle { 3, centre = { 0, 0 }, radius = 1 } end },
    { "polygon: point 2 must be {x, y}, got number",
      function() celspan.polygon { { 0, 0 }, 3, { 1, 1 } } end },
    { 'polygon: field \'rule\' must be "nonzero" or "evenodd", got "odd"',
      function() celspan.polygon { { 0, 0 }, { 1, 0 }, { 1, 1 }, rule = "odd" } end },
    { 'rect: field \'texture\' must be a paint, a texture or a colour like "#rrggbb", got "red"',
      function() celspan.rect { 0, 0, 1, 1, texture = "red" } end },
    { "nurbs: field 'degree' must be a whole number, got 2.5",
      function() celspan.nurbs { points = { { 0, 0 } }, degree = 2.5 } end },
    { "union: item 2 must be an object, got a cel",
      function() celspan.union { celspan.union {}, celspan.cel {} } end },
    { "rostrum: item 1 must be a cel, got a union",
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
    { "pixels: argument 1 must be a rostrum or a list {{rostrum, weight}, ...}, got a cel",
      function() celspan.pixels(celspan.cel {}) end },
    { "rostrum: antialias: radius is -1; it must be between 0 and 256",
      function() celspan.rostrum { antialias = { kernel = "gaussian", radius = -1 } } end },
  }
  for _, case in ipairs(cases) do
    it("is told: " .. case[1], function()
      assert.are.equal(case[1], sentence(case[2]))
    end)
  end
end)

describe("a scan-line primitive that would not stand upright", function()
  local refusal = "a scan-line primitive can be moved and scaled, but not rotated, skewed or put in perspective"
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

  it("may be mirrored and turned by half", function()
    rows():rotate(180):scale(-1, 2):translate(4, 4)
  end)
end)

describe("a number that is refused", function()
  local cases = {
    { "circle: radius is -1; ", function() celspan.circle { centre = { 0, 0 }, radius = -1 } end },
    { "circle: radius is not a number",
      function() celspan.circle { centre = { 0, 0 }, radius = 0 / 0 } end },
    { "rgb: pigment[1] is 2; ", function() celspan.rgb(2, 0, 0) end },
    { "fade: ", function() celspan.union {}:fade(2) end },
    { "rect: ", function() celspan.rect { math.huge, 0, 1, 1 } end },
    { "translate: dx must be a number from -1e12 to 1e12, got 2000000000000",
      function() celspan.union {}:translate(2e12, 0) end },
    { "translate: dy must be a number from -1e12 to 1e12, got nan",
      function() celspan.union {}:translate(0, 0 / 0) end },
    { "rotate: the angle in degrees must be a number from -1e12 to 1e12, got inf",
      function() celspan.union {}:rotate(math.huge) end },
    { "film: field 'frames' must be a whole number from 1 to 1000000000, got 0",
      function() celspan.film { frames = 0, frame = print } end },
    { "pixels: field 'workers' must be 0 or more, got -1",
      function() celspan.pixels(celspan.rostrum {}, { size = { 1, 1 }, workers = -1 }) end },
    { "pixels: 0 x 1 pixels are asked for; each side must be at least 1",
      function() celspan.pixels(celspan.rostrum {}, { size = { 0, 1 } }) end },
  }
  for _, case in ipairs(cases) do
    it("is told by the name of the script's word: " .. case[1], function()
      local rest = sentence(case[2])
      assert.are.equal(case[1], rest:sub(1, #case[1]))
    end)
  end
end)
