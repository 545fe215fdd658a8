-- Grades of groups, cels and rostrums, and tables of colours (.cube). The formulas themselves are
-- tested by unit/grade, random scenes by property/oracle.
local celspan = require "celspan"
local near = require("tests.support.images").near
local workbench = require "tests.support.workbench"

local function rect(x, y, w, h, texture) return celspan.rect { x, y, w, h, texture = texture } end
local function square(texture) return rect(0, 0, 1, 1, texture) end
local function encode(x) return x <= 0.0031308 and 12.92 * x or 1.055 * x ^ (1 / 2.4) - 0.055 end
local function decode(x) return x <= 0.04045 and x / 12.92 or ((x + 0.055) / 1.055) ^ 2.4 end

local function seen(rostrum, w, h)
  return assert(celspan.pixels(rostrum, { size = { w or 1, h or 1 } }))
end

local function of_object(object) return seen(celspan.rostrum { celspan.cel { object } }) end

--- Writes a file with this text, gives its name to a function, and removes it.
local function with_file(text, use)
  local name = os.tmpname()
  local file = assert(io.open(name, "wb"))
  file:write(text)
  file:close()
  local ok, message = pcall(use, name)
  os.remove(name)
  if not ok then error(message, 0) end
end

local grey = celspan.rgb(0.25, 0.25, 0.25)

describe("a grade", function()
  it("of a group changes its colours and not its alpha", function()
    local art = square(celspan.rgb(0.1, 0.2, 0.4, 0.5))
    near({ 0.1, 0.2, 0.4, 0.5 }, of_object(celspan.group { art, grade = { exposure = 1 } }), 0, 0)
    local group = celspan.group { art, grade = { contrast = 2 } }
    near({ 0.5 * 0.02, 0.5 * 0.22, 0.5 * 0.62, 0.5 }, of_object(group), 0, 0)
  end)

  it("is of the whole: parts are composited first", function()
    local parts = { square(celspan.rgb(0.2, 0.2, 0.2)), square(celspan.rgb(0.6, 0.6, 0.6, 0.5)) }
    local group = celspan.group { parts[1], parts[2], grade = { gamma = 2 } }
    near({ 0.4 ^ 0.5, 0.4 ^ 0.5, 0.4 ^ 0.5, 1 }, of_object(group), 0, 0)
  end)

  it("of a cel acts on it as it is lit, of a group before", function()
    local function lit(fields)
      fields.front = { 0.5, 0.5, 0.5 }
      return seen(celspan.rostrum { celspan.cel(fields) })
    end
    local grade = { gamma = 2 }
    near({ 0.125 ^ 0.5, 0.125 ^ 0.5, 0.125 ^ 0.5, 1 }, lit { square(grey), grade = grade }, 0, 0)
    local group = celspan.group { square(grey), grade = grade }
    near({ 0.25, 0.25, 0.25, 1 }, lit { group }, 0, 0)
  end)

  it("of a cel goes with its fade, its mode and its light's shape", function()
    local cel = celspan.cel { square(grey), grade = { gamma = 2 }, opacity = 0.5 }
    near({ 0.25, 0.25, 0.25, 0.5 }, seen(celspan.rostrum { cel }), 0, 0)
    local ground = celspan.cel { square(celspan.rgb(0.5, 0.5, 0.5)) }
    cel = celspan.cel { square(grey), grade = { gamma = 2 }, blend = "multiply" }
    near({ 0.25, 0.25, 0.25, 1 }, seen(celspan.rostrum { ground, cel }), 0, 0)
    local light = celspan.linear { from = { 0, 0 }, to = { 2, 0 }, { 0, "#000" }, { 1, "#fff" } }
    cel = celspan.cel { square(grey), grade = { gamma = 2 }, front = light }
    near({ 0.0625 ^ 0.5, 0.0625 ^ 0.5, 0.0625 ^ 0.5, 1 }, seen(celspan.rostrum { cel }), 0, 0)
  end)

  it("of a rostrum acts on its lights too, in a film and in an object", function()
    local fields = { celspan.cel { square(celspan.rgb(1, 1, 1, 0.5)) }, size = { 1, 1 },
      back = { 0.28, 0.28, 0.28 }, grade = { exposure = -1, saturation = 0 } }
    near({ 0.32, 0.32, 0.32, 1 }, seen(celspan.rostrum(fields)), 0, 0)
    near({ 0.32, 0.32, 0.32, 1 }, of_object(celspan.rostrum(fields)), 0, 0)
    local outer = celspan.rostrum { celspan.cel { celspan.rostrum(fields), front = { 0.5, 1, 1 } } }
    near({ 0.16, 0.32, 0.32, 1 }, seen(outer), 0, 0)
  end)

  it("is made in the working space, before this is left", function()
    local group = celspan.group { square(grey), grade = { contrast = 0.5 }, space = "srgb" }
    local expected = decode((encode(0.25) - 0.46) * 0.5 + 0.46)
    near({ expected, expected, expected, 1 }, of_object(group), 0, 0)
    local film = celspan.film { size = { 1, 1 }, space = "srgb", frame = function()
      return celspan.rostrum { celspan.cel { square(grey) }, grade = { contrast = 0.5 } }
    end }
    near({ expected, expected, expected, 1 }, assert(celspan.pixels(film)), 0, 0)
    local rgba = { celspan.probe(film, 0.5, 0.5) }
    assert.is_true(math.abs(rgba[1] - expected) < 1e-6)
  end)

  it("isolates: modes inside act inside", function()
    local dark = square(celspan.rgb(0.5, 0.5, 0.5)):blend "multiply"
    local ground = square(celspan.rgb(0.5, 0.5, 0.5))
    local group = celspan.group { dark, grade = { exposure = -1 } }
    near({ 0.25, 0.25, 0.25, 1 }, seen(celspan.rostrum { celspan.cel { ground, group } }), 0, 0)
    assert.error_matches(function() celspan.group { dark, grade = {}, isolate = false } end,
      "group: isolate is false, but a group with a grade always isolates")
    assert.equal(0.5, celspan.group { dark, grade = { exposure = 0.5 } }.grade.exposure)
  end)

  it("of gradients is exact along their runs", function()
    local ramp = celspan.linear { from = { 0, 0 }, to = { 256, 0 }, { 0, "#000" }, { 1, "#fff" } }
    local group = celspan.group { rect(0, 0, 256, 1, ramp),
      grade = { curve = { { 0, 0 }, { 0.2, 0.5 }, { 0.6, 0.6 }, { 1, 1 } }, gamma = 1.5 } }
    local rostrum = celspan.rostrum { celspan.cel { group } }
    local image = seen(rostrum, 256, 1)
    for x = 0, 255 do
      local r, g, b, a = celspan.probe(rostrum, x + 0.5, 0.5, { film = { 256, 1 } })
      near({ r, g, b, a }, image, x, 0, 1.5 / 1023)
    end
  end)

  it("leaves no seams between shapes that abut", function()
    local left, right = {}, {}
    for i = 0, 7 do
      local top, bottom = { 3.3 + i * 0.4, i }, { 3.7 + i * 0.4, i + 1 }
      left[i + 1] = celspan.polygon { { 0, i }, top, bottom, { 0, i + 1 }, texture = grey }
      right[i + 1] = celspan.polygon { { 8, i }, top, bottom, { 8, i + 1 }, texture = grey }
    end
    local group = celspan.group { celspan.union(left), celspan.union(right), grade = { gamma = 2 } }
    local image = seen(celspan.rostrum { celspan.cel { group }, back = "#f00" }, 8, 8)
    for y = 0, 7 do for x = 0, 7 do near({ 0.5, 0.5, 0.5, 1 }, image, x, y) end end
  end)
end)

describe("the fields of a grade", function()
  local function fails(grade, message)
    assert.error_matches(function() celspan.cel { square(grey), grade = grade } end, message)
  end

  it("are refused by name, with what is allowed", function()
    fails(1, "cel: field 'grade' must be a table such as { exposure = 1 }, got number")
    fails({ exposur = 1 }, "cel: grade: unknown field 'exposur'.*exposure")
    fails({ exposure = 65 }, "exposure")
    fails({ gamma = 0 }, "gamma")
    fails({ temperature = 2 }, "temperature")
    fails({ saturation = -1 }, "saturation")
    fails({ matrix = { 1, 2, 3 } }, "matrix")
    fails({ matrix = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 } } }, "3 rows of 4 numbers, got 2 rows")
    fails({ matrix = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 1, 0 } } }, "matrix")
    fails({ curve = { { 0, 0 } } }, "2 to 1024 points, got 1")
    fails({ curve = { { 0, 0 }, { 0, 1 } } }, "curve%[2%] goes in at 0, after 0")
    fails({ curve = { { { 0, 0 }, { 1, 1 } }, { { 0, 0 }, { 1, 1 } } } }, "got 2 lists")
    fails({ curve = 3 }, "curve")
    fails({ slope = 2 }, "slope")
    fails({ power = { 1, 1, 0 } }, "power is 0; it must be")
    fails({ steps = 1 }, "steps")
    fails({ lut_space = "log" }, "lut_space.*linear.*srgb")
    fails({ lut = "nowhere.cube" }, "nowhere.cube: No such file or directory")
  end)

  it("take a curve for each channel, and a matrix", function()
    local group = celspan.group { square(grey), grade = {
      matrix = { { 0, 2, 0, 0 }, { 1, 0, 0, 0.25 }, { 0, 0, 0, 0.125 } },
      curve = { { { 0, 0 }, { 1, 0.5 } }, { { 0, 0 }, { 1, 1 } }, { { 0, 1 }, { 1, 0 } } } } }
    near({ 0.25, 0.5, 0.875, 1 }, of_object(group), 0, 0)
  end)
end)

describe("the ASC CDL", function()
  it("follows the exposure: slope, offset, then the power of positive numbers", function()
    local group = celspan.group { square(grey), grade = { exposure = 1, slope = { 0.5, 2, 1 },
      offset = { 0.25, 0, -0.75 }, power = { 2, 1, 1 } } }
    near({ 0.25, 1, 0, 1 }, of_object(group), 0, 0)
  end)
end)

describe("the steps of a grade", function()
  it("are levels of codes, in light and in codes", function()
    for _, space in ipairs { "linear", "srgb" } do
      local group = celspan.group { space = space, grade = { steps = 3 },
        square(celspan.rgb(decode(0.2), decode(0.4), decode(0.9))) }
      near({ 0, decode(0.5), 1, 1 }, of_object(group), 0, 0)
    end
  end)

  it("fall where the code of a gradient crosses them, alike in the probe", function()
    local ramp = celspan.linear { from = { 0, 0 }, to = { 90, 0 }, { 0, "#000" }, { 1, "#fff" } }
    local rostrum = celspan.rostrum { celspan.cel {
      celspan.group { rect(0, 0, 90, 1, ramp), space = "srgb", grade = { steps = 3 } } } }
    local image = seen(rostrum, 90, 1)
    for x = 0, 89 do
      local r, g, b, a = celspan.probe(rostrum, x + 0.5, 0.5, { film = { 90, 1 } })
      local code = (x + 0.5) / 90 -- the stops of a gradient are mixed in the space around them
      local level = code < 1 / 3 and 0 or code < 2 / 3 and decode(0.5) or 1
      near({ r, g, b, a }, image, x, 0)
      near({ level, level, level, 1 }, image, x, 0)
    end
  end)
end)

describe("a table of colours", function()
  local function graded(text, colour, space)
    local image
    with_file(text, function(name)
      image = of_object(celspan.group { square(colour),
        grade = { lut = name, lut_space = space or "linear" } })
    end)
    return image
  end

  it("of one dimension is interpolated, and clamps to its domain", function()
    local text = "# made by hand\r\nTITLE \"warm\"\r\nLUT_1D_SIZE 3\r\n" ..
      "DOMAIN_MAX 0.5 0.5 0.5\r\n0 0 0\r\n0.5 0.25 0.75\r\n1 1 0\r\n"
    near({ 0.25, 0.125, 0.375, 1 }, graded(text, celspan.rgb(0.125, 0.125, 0.125)), 0, 0)
    near({ 1, 1, 0, 1 }, graded(text, celspan.rgb(1, 1, 1)), 0, 0)
  end)

  it("holds codes of sRGB if it does not say otherwise", function()
    local text = "LUT_1D_SIZE 2\n1 0 0\n0 1 0.5\n"
    local c = celspan.rgb(decode(0.25), decode(0.5), decode(0.75))
    near({ decode(0.75), decode(0.5), decode(0.375), 1 }, graded(text, c, "srgb"), 0, 0)
    near({ 1 - decode(0.25), decode(0.5), decode(0.75) / 2, 1 }, graded(text, c), 0, 0)
  end)

  it("of three dimensions is trilinear; red changes first", function()
    local rows = { "LUT_3D_SIZE 2" }
    for b = 0, 1 do for g = 0, 1 do for r = 0, 1 do
      rows[#rows + 1] = ("%g %g %g"):format(r * g, b, r)
    end end end
    local text = table.concat(rows, "\n") -- without a last line end
    near({ 0.5 * 0.25, 0.75, 0.5, 1 }, graded(text, celspan.rgb(0.5, 0.25, 0.75)), 0, 0)
  end)

  it("is refused with its line where it is damaged", function()
    local cases = {
      { "LUT_3D_SIZE 2\n" .. ("0 0 0\n"):rep(7), ":8: the file ends after 7 of the 8 lines" },
      { "LUT_3D_SIZE 2\n" .. ("0 0 0\n"):rep(9), ":10: the table has more lines" },
      { "LUT_1D_SIZE 2\n0 0 0\n0 0", ":3: there must be three numbers here" },
      { "LUT_1D_SIZE 2\n0 0 0\n0 0 0 0", ":3: there are more numbers than belong here" },
      { "LUT_1D_SIZE 2\n0 0 0\n0 nan 0", ":3: there must be three numbers here" },
      { "LUT_1D_SIZE 2\n0 0 0\n0 1e13 0", ":3: a number is too large" },
      { "LUT_3D_SIZE 256\n0 0 0\n", ":1: the table must have 16777216 lines, but the file is too" },
      { "LUT_3D_SIZE 257\n", ":1: LUT_3D_SIZE must be a whole number from 2 to 256" },
      { "LUT_1D_SIZE 1.5\n", ":1: LUT_1D_SIZE must be a whole number from 2 to 65536" },
      { "LUT_1D_SIZE\n", ":1: there must be a number here" },
      { "LUT_1D_SIZE 2\n0 0 0\n1 1 1\nLUT_3D_SIZE 2\n", ":4: a second table begins here" },
      { "0 0 0\n", ":1: LUT_1D_SIZE or LUT_3D_SIZE must come before the table" },
      { "TITLE \"x\"\n", ":1: the file ends without LUT_1D_SIZE or LUT_3D_SIZE" },
      { "hello\n", ":1: this is no line of a .cube file" },
      { "LUT_1D_SIZE 2\nDOMAIN_MIN 1 1 1\n0 0 0\n1 1 1\n", "DOMAIN_MIN must be less than" },
    }
    for _, case in ipairs(cases) do
      assert.error_matches(function() graded(case[1], grey) end, (case[2]:gsub("[%-%.%%]", "%%%0")))
    end
  end)

  it("that is missing ends the program with exit status 4", function()
    local bench = workbench.new()
    bench:write("grade.lua", [[
      local celspan = require "celspan"
      return celspan.rostrum { grade = { lut = "none.cube" } }]])
    local status, _, message = bench:celspan("check '%s/grade.lua'", bench.folder)
    bench:remove()
    assert.equal(4, status)
    assert.is_truthy(message:find("none.cube: No such file or directory", 1, true))
  end)
end)
