--- Paintings of Krita that move: their drawings, opacities and sheets, as Krita shows them.
local celspan = require "celspan"
local ink = require "celspan.ink"
local json = require "celspan.json"
local layers = require "celspan.layers"
local paintings = require "tests.support.paintings"
local present = require "tests.support.present"
local sheet = require "celspan.sheet"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

-- from the folder of this file, as all names in scripts
local root = "../krita/"
local it_reads_archives = present.type() and it or pending

--- A layer that moves. keys: its channels; members: the pixels of its drawings.
local function layer_of(keys, fields)
  local layer = { name = "ink", x = 0, y = 0, w = 4, h = 4,
    pixel = function() return 255, 0, 0, 255 end,
    attributes = ' keyframes="FILE.keyframes.xml"', members = {
      [".keyframes.xml"] = '<?xml version="1.0"?>\n<keyframes xmlns="http://www.calligra.org/DTD/'
        .. 'krita-keyframes">' .. keys .. "</keyframes>" } }
  for number, colour in ipairs { { 0, 255, 0 }, { 0, 0, 255 } } do
    layer.members[".f" .. number] = paintings.krita_tiles { w = 4, h = 4, pixel = function()
      return colour[1], colour[2], colour[3], 255
    end }
  end
  for name, value in pairs(fields or {}) do layer[name] = value end
  return layer
end

local function painting_of(list)
  return paintings.krita { w = 4, h = 4, layers = list,
    inside = '<animation><framerate value="12"/><range from="2" to="9"/></animation>' }
end

local function moving(...) return painting_of { layer_of(...) } end

local function content(...)
  local list = {}
  for i, key in ipairs { ... } do
    list[i] = ('<keyframe time="%s" frame="%s" color-label="3"><offset x="%d" y="0"/></keyframe>')
      :format(key[1], key[2], key[3] or 0)
  end
  return '<channel name="content">' .. table.concat(list) .. "</channel>"
end

local function opacity(...)
  local list = {}
  for i, key in ipairs { ... } do
    list[i] = ('<keyframe time="%s" value="%s" interpolation="%s"><leftTangent x="%g" y="%g"/>'
      .. '<rightTangent x="%g" y="%g"/></keyframe>'):format(key[1], key[2], key[3] or "linear",
        key[4] or 0, key[5] or 0, key[6] or 0, key[7] or 0)
  end
  return '<channel name="opacity">' .. table.concat(list) .. "</channel>"
end

local bench, count = workbench.new(), 0

local function written(bytes)
  count = count + 1
  return bench:write(("painting-%d.kra"):format(count), bytes)
end

local function read(...) return assert(layers.read(written(moving(...)))) end

--- The name of the one drawing of "ink" that is visible; nil for none.
local function shown(tree)
  local found
  for _, drawing in ipairs(tree:get "ink".children) do
    if drawing.visible then
      assert.is_nil(found)
      found = drawing.name
    end
  end
  return found
end

local function codes(object, w, h)
  local rostrum = celspan.rostrum { celspan.cel { object } }
  local film = celspan.film { size = { w, h }, frames = 1, space = "srgb",
    frame = function() return rostrum end }
  return assert(celspan.pixels(film)):bytes { depth = 8 }
end

describe("a painting of Krita that moves", function()
  teardown(function() bench:remove() end)

  it_reads_archives("is shown at each frame as Krita shows it", function()
    local truth = assert(json.decode(system.read "tests/kit/krita/krita_keys.json"))
    local tree = assert(layers.read(root .. "krita_keys.kra"))
    assert.are.same({ 12, 0, 14 }, { tree.fps, tree.from, tree.to })
    assert.are.same({}, tree.skipped)
    for frame, colours in ipairs(truth.frames) do
      local bytes = codes(tree:at(frame - 1).object, tree.width, tree.height)
      for i, point in ipairs(truth.points) do
        local place = 4 * (tree.width * point[2] + point[1])
        for c = 1, 4 do
          local code = bytes:byte(place + c)
          assert.is_true(math.abs(code - colours[i][c]) <= 1,
            ("frame %d, point %d, channel %d: %d, Krita has %d"):format(frame - 1, i, c, code,
              colours[i][c]))
        end
      end
    end
  end)

  it_reads_archives("is a sheet, too, whose drawings have the names of its layers", function()
    local path = root .. "krita_keys.kra"
    local s, tree = assert(sheet.read(path)), assert(layers.read(path))
    assert.are.same({ 15, 12, 48, 32 }, { s.frames, s.fps, s.width, s.height })
    assert.are.same({ "ball", "lamp", "ground" }, s.layers)
    for frame = 1, s.frames do
      for _, name in ipairs { "ball", "lamp" } do
        for _, drawing in ipairs(tree:at(frame - 1):get(name).children) do
          assert.are.equal(drawing.visible, s:at(name, frame) == drawing.name)
        end
      end
      assert.are.equal("1", s:at("ground", frame))
    end
  end)

  it_reads_archives("shows a drawing again where a key names it again, with its offset", function()
    local tree = read(content({ 3, "FILE.f1", 2 }, { 5, "FILE" }, { 6, "FILE.f1", 2 },
      { 8, "FILE.f2" }))
    local names = {}
    for frame = 2, 9 do names[#names + 1] = shown(tree:at(frame)) or "-" end
    assert.are.equal("- 1 1 2 1 1 3 3", table.concat(names, " "))
    assert.are.equal(3, #tree:get "ink".children)
    assert.are.equal(2, tree:get "ink/1".x)
    assert.are.equal(shown(tree:at(6)), shown(tree:at(6.9)))
  end)

  it_reads_archives("keeps what :with changes", function()
    local tree = read(content({ 2, "FILE" }, { 5, "FILE.f1" }))
    local moved = tree:with { ink = { pivot = { 1, 1 } } }
    assert.are.equal("2", shown(moved:at(7)))
    assert.are.same({ 12, 2, 9 }, { moved.fps, moved.from, moved.to })
  end)

  it_reads_archives("moves in other colours, too", function()
    local tree = read(content({ 4, "FILE" }, { 7, "FILE.f1" }))
    local night = ink.recolour(tree, "#00ff00", "#000000")
    assert.are.same({ 12, 2, 9 }, { night.fps, night.from, night.to })
    assert.are.equal("1", shown(night:at(6)))
    assert.are.equal("2", shown(night:at(7)))
    assert.are.equal("\0\0\0\255", codes(night:at(7).object, 4, 4):sub(1, 4))
  end)

  it_reads_archives("has drawings only in layers with pixels", function()
    local tree = read(content { 4, "FILE" } .. opacity({ 2, 0 }, { 6, 255 }),
      { kind = "adjustmentlayer" })
    assert.are.equal(0.5, tree:at(4):get "ink".opacity)
    assert.are.same({}, tree:at(4):get "ink".children or {})
  end)

  it_reads_archives("keeps the drawings and the keys of each layer", function()
    -- foremost first in the file: "layer2" is that of "ink"
    local stray = '<channel name="opacity"><leftTangent x="-2" y="-200"/></channel>'
    local tree = assert(layers.read(written(painting_of {
      layer_of(stray .. content({ 2, "layer2.f1" }, { 5, "layer2" }), { name = "hair" }),
      layer_of(content({ 2, "FILE" }, { 4, "FILE.f1" })
        .. opacity({ 2, 0, "bezier" }, { 6, 255, "bezier" })) })))
    assert.is_true(math.abs(tree:at(4):get "ink".opacity - 0.5) < 1e-9)
    assert.are.same({ 2, 2 }, { #tree:get "ink".children, #tree:get "hair".children })
    local hair = tree:at(2):get "hair".object
    assert.are.equal("\0\255\0\255", codes(hair, 4, 4):sub(1, 4))
  end)

  it_reads_archives("changes its opacity along lines, curves and steps", function()
    local function at(frame, ...) return read(opacity(...)):at(frame):get "ink".opacity end
    assert.are.equal(0.5, at(4, { 2, 0 }, { 6, 255 }))
    assert.are.equal(0, at(5, { 2, 0, "constant" }, { 6, 255 }))
    assert.are.equal(1, at(7, { 2, 0 }, { 6, 255 }))
    assert.are.equal(0.2, at(0, { 2, 51 }, { 6, 255 }))
    -- a symmetrical curve is halfway in the middle, and slow at its ends
    local curve = { { 2, 0, "bezier", 0, 0, 2, 0 }, { 6, 255, "bezier", -2, 0, 0, 0 } }
    assert.is_true(math.abs(at(4, table.unpack(curve)) - 0.5) < 1e-9)
    assert.is_true(at(3, table.unpack(curve)) < 0.2)
    -- between equal keys it may bulge: 3/4 of its handles in the middle
    local bulge = { { 2, 0, "bezier", 0, 0, 4 / 3, 102 }, { 6, 0, "bezier", -4 / 3, 102, 0, 0 } }
    assert.is_true(math.abs(at(4, table.unpack(bulge)) - 0.3) < 1e-9)
  end)

  for name, case in pairs {
    ["a key that names a drawing outside"] = { content { 0, "../secret" }, "must name a layer" },
    ["a key that points nowhere"] = { content { 0, "FILE.f9" }, "FILE%.f9" , "not in the archive" },
    ["keys out of order"] = { content({ 5, "FILE" }, { 5, "FILE.f1" }),
      "keyframes%.xml:2: the key of frame 5 follows that of frame 5" },
    ["keys out of order around another channel"] = { content { 5, "FILE" } .. opacity { 0, 9 }
      .. content { 4, "FILE.f1" }, "the key of frame 4 follows that of frame 5" },
    ["a frame that is no number"] = { content { "soon", "FILE" }, 'time is "soon"' },
    ["an opacity beyond its range"] = { opacity { 0, 300 }, 'value is "300"' },
    ["keys that are no XML"] = { "<channel", "keyframes%.xml" },
  } do
    it_reads_archives("is refused with " .. name, function()
      local tree, message = layers.read(written(moving(case[1])))
      assert.is_nil(tree)
      assert.matches(case[2]:gsub("FILE", "layer%%d+"), message)
      if case[3] then assert.matches(case[3], message) end
    end)
  end

  it_reads_archives("is refused where its range has no frames, or its keys are missing", function()
    local empty = paintings.krita { w = 4, h = 4, layers = {},
      inside = '<animation><range from="9" to="2"/></animation>' }
    local _, message = layers.read(written(empty))
    assert.matches("the range from 9 to 2 has no frames", message)
    _, message = layers.read(written(moving("", { members = {} })))
    assert.matches("keyframes is .* not in the archive", message)
  end)

  it_reads_archives("ignores what its file says of other channels", function()
    local tree = read '<channel name="transform"><keyframe time="0" value="9"/></channel>'
    assert.is_nil(tree:get "ink".children)
    assert.are.equal(tree, tree:at(5))
  end)

  it_reads_archives("takes the number of a frame", function()
    assert.has_error(function() read(content { 0, "FILE" }):at "two" end)
  end)
end)
