-- Working spaces: films, rostrums and groups in which sRGB codes are mixed instead of light. The
-- formulas themselves are tested by unit/space, random scenes by property/oracle.
local celspan = require "celspan"
local near = require("tests.support.images").near
local prng = require "tests.support.prng"

local function rect(x, y, w, h, texture) return celspan.rect { x, y, w, h, texture = texture } end

local function encode(x) return x <= 0.0031308 and 12.92 * x or 1.055 * x ^ (1 / 2.4) - 0.055 end
local function decode(x) return x <= 0.04045 and x / 12.92 or ((x + 0.055) / 1.055) ^ 2.4 end

local function film(space, rostrum, w, h)
  return celspan.film { size = { w or 4, h or 1 }, space = space,
                        frame = function() return rostrum end }
end

local function pixels(what, options) return assert(celspan.pixels(what, options)) end

--- The 8-bit codes of the first row.
local function codes(what, options) return { pixels(what, options):bytes { depth = 8 }:byte(1,
  -1) } end

local shade = celspan.rostrum { celspan.cel { rect(0, 0, 4, 1, "#fff"),
  rect(0, 0, 2, 1, celspan.rgb(0, 0, 0, 0.3)) } }

describe("a film in srgb", function()
  it("mixes codes as browsers do: 30 % black over white is 178", function()
    assert.same({ 178, 178, 178, 255 }, { table.unpack(codes(film("srgb", shade)), 1, 4) })
    assert.same({ 218, 218, 218, 255 }, { table.unpack(codes(film(nil, shade)), 1, 4) })
    assert.same({ 218, 218, 218, 255 }, { table.unpack(codes(film("linear", shade)), 1, 4) })
    near({ decode(0.7), decode(0.7), decode(0.7), 1 }, pixels(film("srgb", shade)), 0, 0)
  end)

  it("takes the codes of colours as they are, and white and black stay exactly", function()
    local shown = codes(film("srgb", celspan.rostrum { celspan.cel {
      rect(0, 0, 1, 1, "#ff8040"), rect(1, 0, 1, 1, "#fff"), rect(2, 0, 1, 1, "#000") } }))
    assert.same({ 255, 128, 64, 255, 255, 255, 255, 255, 0, 0, 0, 255 },
      { table.unpack(shown, 1, 12) })
    assert.equal(1, (pixels(film("srgb", celspan.rostrum { back = "#fff" })):get(0, 0)))
  end)

  it("averages codes over a pixel", function()
    local half = celspan.rostrum { celspan.cel { rect(0, 0, 0.5, 1, "#fff") }, back = "#000" }
    assert.equal(128, codes(film("srgb", half, 1))[1])
    assert.equal(188, codes(film("linear", half, 1))[1])
  end)

  it("mixes the stops of gradients as codes", function()
    local ramp = celspan.linear { from = { 0, 0 }, to = { 64, 0 }, { 0, "#000" }, { 1, "#fff" } }
    local image = pixels(film("srgb", celspan.rostrum { celspan.cel { rect(0, 0, 64, 1,
      ramp) } }, 64))
    for x = 0, 63 do near({ decode((x + 0.5) / 64), decode((x + 0.5) / 64),
      decode((x + 0.5) / 64), 1 },
      image, x, 0, 1 / 1023) end
    local corners = celspan.gradient { { 0, 0, "#000" }, { 64, 0, "#fff" }, { 0, 64, "#000" } }
    image = pixels(film("srgb", celspan.rostrum { celspan.cel { rect(0, 0, 64, 1, corners) } },
      64))
    near({ decode(0.5078125), decode(0.5078125), decode(0.5078125), 1 }, image, 32, 0, 1 / 1023)
  end)

  it("converts pigments and lights given as strings; those given as numbers are factors",
    function()
      local function first(fields)
        fields[1] = celspan.cel { rect(0, 0, 1, 1, celspan.rgb(0.5, 0.5, 0.5)) }
        return pixels(film("srgb", celspan.rostrum(fields), 1)):get(0, 0)
      end
      local function expect(code, fields)
        assert.is_true(math.abs(decode(code) - first(fields)) < 1e-6)
      end
      expect(encode(0.5), {})
      expect(encode(0.5) * 0.5, { front = { 0.5, 0.5, 0.5 } })
      expect(encode(0.5) * 0.5, { brightness = 0.5 })
      expect(encode(0.5) * (128 / 255), { front = "#808080" })
      expect(encode(0.5) * (128 / 255), { front = celspan.rgb("#808080") })
      expect(encode(0.5) * (128 / 255) * 0.5,
        { front = { texture = celspan.rgb("#808080"), gain = 0.5 } })
    end)

  it("does not convert media, beta and mattes", function()
    local image = pixels(film("srgb", celspan.rostrum { celspan.cel { rect(0, 0, 1, 1,
      celspan.gel(0.5, 0.25, 1)) },
      back = "#fff" }))
    near({ decode(0.5), decode(0.25), 1, 1 }, image, 0, 0)
    image = pixels(film("srgb", celspan.rostrum { back = { 0, 0, 0, 0.25 } }))
    near({ 0, 0, 0, 0.25 }, image, 0, 0)
  end)

  it("shows the codes of an 8-bit picture as they are", function()
    local bytes = string.char(10, 100, 200, 255, 90, 60, 30, 128)
    local picture = celspan.picture { pixels = bytes, size = { 2, 1 }, format = "rgba8" }
    local shown = codes(film("srgb", celspan.rostrum { celspan.cel { rect(0, 0, 2, 1,
      picture) } }, 2))
    assert.same({ bytes:byte(1, -1) }, shown)
    local image = pixels(film("srgb", celspan.rostrum { celspan.cel { rect(0, 0, 2, 1,
      picture) }, back = "#fff" }, 2))
    local mixed = decode(90 / 255 * 128 / 255 + 1 - 128 / 255)
    assert.is_true(math.abs(mixed - image:get(1, 0)) < 1e-5)
  end)

  it("adds light in its exposures", function()
    local white, black = celspan.rostrum { back = "#fff" }, celspan.rostrum { back = "#000" }
    local both = celspan.film { size = { 1, 1 }, space = "srgb",
      frame = function() return { { white, 0.5 }, { black, 0.5 } } end }
    near({ 0.5, 0.5, 0.5, 1 }, pixels(both), 0, 0)
    near({ 0.5, 0.5, 0.5, 1 }, { get = function() return celspan.probe(both, 0.5, 0.5) end }, 0, 0)
  end)

  it("gives its codes, premultiplied, to floats that are asked for in sRGB", function()
    local half = celspan.rostrum { celspan.cel { rect(0, 0, 1, 1, celspan.rgb("#ff8000", 0.5)) } }
    local dump = os.tmpname()
    assert(celspan.render(film("srgb", half, 1), dump .. ".exr", { colour = "srgb",
      depth = "float" }))
    local picture = celspan.picture { file = dump .. ".exr", colour = "linear" }
    local image = pixels(celspan.rostrum { celspan.cel { rect(0, 0, 1, 1, picture) } },
      { size = { 1, 1 } })
    near({ 0.5, 0.5 * 128 / 255, 0, 0.5 }, image, 0, 0)
    os.remove(dump)
    os.remove(dump .. ".exr")
  end)
end)

describe("a space", function()
  it("of a rostrum that is not the film's is left by converting each channel", function()
    local inner = celspan.rostrum { celspan.cel { rect(0, 0, 4, 1, "#fff"),
      rect(0, 0, 2, 1, celspan.rgb(0, 0, 0, 0.3)) }, space = "srgb", size = { 4, 1 } }
    near({ decode(0.7), decode(0.7), decode(0.7), 1 }, pixels(film(nil, inner)), 0, 0)
    near({ decode(0.7), decode(0.7), decode(0.7), 1 },
      pixels(film(nil, celspan.rostrum { celspan.cel { inner } })), 0, 0)
    near({ 0.7, 0.7, 0.7, 1 }, pixels(film("srgb", shade:with { space = "linear" })), 0, 0)
  end)

  it("of a rostrum alone is that of its film", function()
    local srgb = shade:with { space = "srgb" }
    assert.equal(178, codes(srgb, { size = { 4, 1 } })[1])
    assert.equal("srgb", srgb.space)
    assert.is_nil(shade.space)
    local half = celspan.rostrum { celspan.cel { rect(0, 0, 0.5, 1, "#fff") }, back = "#000",
      space = "srgb" }
    assert.equal(128, codes(half, { size = { 1, 1 } })[1])
  end)

  it("of a group is left with its alpha", function()
    for _, case in ipairs { { 1, 0.3 }, { 0.5, 0.3 }, { 0.25, 0.9 } } do
      local white, black = table.unpack(case)
      local s, t = (1 - black) * white, (1 - black) * (1 - white)
      local group = celspan.group { rect(0, 0, 1, 1, celspan.rgb(1, 1, 1, white)),
        rect(0, 0, 1, 1, celspan.rgb(0, 0, 0, black)), space = "srgb" }
      local expected = (1 - t) * decode(s / (1 - t))
      near({ expected, expected, expected, 1 - t },
        pixels(celspan.rostrum { celspan.cel { group } },
        { size = { 1, 1 } }), 0, 0)
      near({ 0.5 * expected, 0.5 * expected, 0.5 * expected, 0.5 * (1 - t) },
        pixels(celspan.rostrum {
        celspan.cel { group:fade(0.5) } }, { size = { 1, 1 } }), 0, 0)
    end
  end)

  it("of a group is lit as a whole by the light of its cel", function()
    local group = celspan.group { rect(0, 0, 1, 1, "#808080"), space = "srgb" }
    local light = decode(128 / 255)
    near({ light / 2, light / 4, light, 1 }, pixels(celspan.rostrum { celspan.cel { group,
      front = { 0.5, 0.25, 1 } } }, { size = { 1, 1 } }), 0, 0)
  end)

  it("of a group that is its surroundings' does not isolate", function()
    local function shown(space, inner)
      return pixels(film(space, celspan.rostrum { celspan.cel { rect(0, 0, 1, 1, "#ff0000"),
        celspan.group { rect(0, 0, 1, 1, "#00ff00"):blend("multiply"), space = inner } } }, 1))
    end
    for _, space in ipairs { "linear", "srgb" } do
      for _, inner in ipairs { "linear", "srgb" } do
        near(space == inner and { 0, 0, 0, 1 } or { 0, 1, 0, 1 }, shown(space, inner), 0, 0)
      end
    end
  end)

  it("of a group with a mode is left before it is blended", function()
    local grey = decode(128 / 255)
    near({ 0.5 * grey, 0.5 * grey, 0.5 * grey, 1 }, pixels(celspan.rostrum { celspan.cel {
      rect(0, 0, 1, 1, celspan.rgb(0.5, 0.5, 0.5)),
      celspan.group { rect(0, 0, 1, 1, "#fff"), rect(0, 0, 1, 1, celspan.rgb(0, 0, 0, 127 / 255)),
        space = "srgb", blend = "multiply" } } }, { size = { 1, 1 } }), 0, 0)
  end)

  it("is kept in a defocused cel, and blurs are of its numbers", function()
    local edge = { rect(-100, -100, 132, 200, "#fff"), rect(32, -100, 132, 200, "#000") }
    local function shown(space, list)
      return pixels(film(space, celspan.rostrum { celspan.cel(list) }, 64)):get(40, 0)
    end
    edge.defocus = 16
    local coded, linear = shown("srgb", edge), shown(nil, edge)
    assert.is_true(math.abs(encode(coded) - linear) < 2e-3)
    local group = { celspan.group { rect(0, 0, 64, 1, celspan.rgb(1, 1, 1, 0.5)),
      rect(0, 0, 64, 1, celspan.rgb(0, 0, 0, 0.5)), space = "srgb" }, defocus = 1 }
    local sharp = shown(nil, { group[1] })
    assert.is_true(math.abs(shown(nil, { group[1], rect(-999, -999, 1, 1) }) - sharp) < 1e-6)
  end)

  it("is the oracle's in random scenes of gradients, pictures, lights and modes", function()
    local random = prng.new(5)
    local function number(a, b) return random:between(a or 0, b or 1) end
    local function paint() return celspan.rgb(number(), number(), number(), number(0.05, 1)) end
    local function texture()
      local kind = math.floor(number(0, 4))
      if kind == 0 then return paint() end
      if kind == 1 then
        return celspan.linear { from = { number(0, 8), 0 }, to = { number(9, 20), 3 }, { 0,
          paint() }, { 1, paint() } }
      elseif kind == 2 then
        return celspan.radial { centre = { number(0, 16), 0 }, radius = number(2, 20), { 0,
          paint() }, { 1, paint() } }
      end
      return celspan.paint { pigment = { number(), number(), number() },
        medium = { number(), number(), number() }, beta = number(0.05, 1) }
    end
    local spaces = { "linear", "srgb" }
    local modes = { "multiply", "screen", "overlay", "difference", "luminosity", "add" }
    local function shapes(depth)
      local list = {}
      for i = 1, 3 do
        local item = rect(number(0, 8), -1, number(4, 16), 3, texture())
        if depth > 0 and number() < 0.7 then
          local inner = shapes(depth - 1)
          inner.space = spaces[math.floor(number(1, 3))]
          item = celspan.group(inner)
        end
        if number() < 0.3 then item = item:fade(number()) end
        if number() < 0.3 then item = item:blend(modes[math.floor(number(1, 7))]) end
        list[i] = item
      end
      return list
    end
    for _ = 1, 150 do
      local list = shapes(2)
      list.front = number() < 0.5 and { number(), number(), number() } or "#c08040"
      local rostrum = celspan.rostrum { celspan.cel(list),
        back = number() < 0.5 and "#336699" or nil,
        antialias = "none", space = spaces[math.floor(number(1, 4))] }
      local shot = film(spaces[math.floor(number(1, 3))], rostrum, 16)
      local image = pixels(shot)
      for x = 0, 15 do
        near({ celspan.probe(shot, x + 0.5, 0.5) }, image, x, 0, 2e-3)
      end
    end
  end)

  it("shows no seam between abutting shapes", function()
    for _, space in ipairs { "linear", "srgb" } do
      local group = celspan.group { rect(0, 0, 1.3, 1, "#c08040"), rect(1.3, 0, 2.7, 1, "#c08040"),
        space = space }
      local image = pixels(celspan.rostrum { celspan.cel { group }, back = "#fff" },
        { size = { 4, 1 } })
      for x = 1, 3 do
        assert.same({ image:get(0, 0) }, { image:get(x, 0) })
      end
    end
  end)

  it("that does not exist is refused at its line, with those that do", function()
    for noun, make in pairs { group = celspan.group, rostrum = celspan.rostrum } do
      assert.error_matches(function() make { space = "lab" } end,
        noun .. ": field 'space' must be \"linear\" or \"srgb\", got \"lab\"")
    end
    assert.error_matches(function() film(3, shade) end,
      "film: field 'space' must be .*, got number")
    assert.error_matches(function() celspan.group { space = "srgb", isolate = false } end,
      "isolate is false, but a group with a space of its own always isolates")
  end)
end)

describe("a drawing", function()
  local function drawn(text, options)
    local name = os.tmpname()
    local file = assert(io.open(name, "w"))
    file:write('<svg xmlns="http://www.w3.org/2000/svg" width="4" height="1">' .. text .. "</svg>")
    file:close()
    local art, message = require "celspan.svg".read(name, options)
    os.remove(name)
    return assert(art, message)
  end
  local function shown(object) return codes(celspan.rostrum { celspan.cel { object } },
    { size = { 4, 1 } }) end
  local white = '<rect width="4" height="1" fill="#fff"/>'
  local shaded = '<g id="shade">' .. white .. '<rect width="4" height="1" fill-opacity="0.3"/></g>'

  it("mixes codes as browsers do, and so does each of its parts", function()
    local art = drawn(white .. shaded)
    assert.equal(178, shown(art.object)[1])
    assert.equal(178, shown(art.parts.shade)[1])
    assert.equal(178, shown(art:elements({ id = "shade" })[1].object)[1])
    assert.equal(178, shown(art:with { shade = function(part) return part end }.object)[1])
  end)

  it("mixes light where the script says so", function()
    local art = drawn(shaded, { space = "linear" })
    assert.equal(218, shown(art.object)[1])
    assert.equal(218, shown(art.parts.shade)[1])
    assert.error_matches(function() drawn(shaded, { space = "lab" }) end,
      'svg: space must be "linear" or "srgb", got "lab"')
  end)

  it("has gradients between codes, by their own stops", function()
    local ramp = '<linearGradient id="g"><stop/><stop offset="1" stop-color="#fff"/>' ..
      '</linearGradient><rect width="4" height="1" fill="url(#g)"/>'
    local image = shown(drawn(ramp).object)
    for x = 0, 3 do assert.is_true(math.abs(image[4 * x + 1] - 255 * (x + 0.5) / 4) <= 1) end
  end)

  it("has masks by the luminance of codes, in both spaces", function()
    local mask = '<mask id="m"><rect width="4" height="1" fill="#808080"/></mask>' ..
      '<rect width="4" height="1" fill="#fff" mask="url(#m)"/>'
    assert.equal(128, shown(drawn(mask).object)[4])
    assert.equal(128, shown(drawn(mask, { space = "linear" }).object)[4])
  end)

  it("is the same in both spaces where nothing in it mixes", function()
    local flat = white .. '<circle id="c" cx="2" cy="0.5" r="0.4" fill="#a05020"/>'
    local both = {}
    for i, space in ipairs { "srgb", "linear" } do
      local rostrum = celspan.rostrum { celspan.cel { drawn(flat, { space = space }).object } }
      both[i] = pixels(rostrum, { size = { 64, 16 } }):bytes { depth = "float" }
    end
    assert.equal(both[1], both[2])
  end)

  it("keeps the modes of its parts outermost", function()
    local part = drawn('<g id="a" style="mix-blend-mode:multiply">' ..
      '<rect width="4" height="1" fill="#808080" fill-opacity="0.5"/>' ..
      '<rect width="4" height="1" fill="#404040" fill-opacity="0.5"/></g>').parts.a
    assert.equal("multiply", part.mode)
    local red = shown(celspan.group { rect(0, 0, 4, 1, "#f00"), part })
    assert.same({ 0, 0, 255 }, { red[2], red[3], red[4] })
  end)
end)

describe("a layered painting", function()
  local paintings = require "tests.support.paintings"

  it("mixes codes as painting programs do, unless the script says otherwise", function()
    local function layer(name, grey, alpha)
      return { name = name, x = 0, y = 0, w = 4, h = 1,
        pixel = function() return grey, grey, grey, alpha end }
    end
    local name = os.tmpname()
    local file = assert(io.open(name, "wb"))
    file:write(paintings.openraster { w = 4, h = 1, layers = { { name = "both", layers = {
      layer("white", 255, 255), layer("shade", 0, 77) } } } })
    file:close()
    local function shown(options, path)
      local tree = assert(require "celspan.layers".read(name, options))
      local object = path and tree:get(path).object or tree.object
      return codes(celspan.rostrum { celspan.cel { object } }, { size = { 4, 1 } })[1]
    end
    assert.equal(178, shown())
    assert.equal(178, shown(nil, "both"))
    assert.equal(218, shown { space = "linear" })
    assert.equal(218, shown({ space = "linear" }, "both"))
    assert.error_matches(function() shown { space = 1 } end, "layers: space must be")
    os.remove(name)
  end)
end)
