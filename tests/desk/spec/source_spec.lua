-- Parts of pictures: `source`, for a sheet of sprites.
local celspan = require "celspan"
local present = require "tests.support.present"
local raised = require "tests.support.raised"
local workbench = require "tests.support.workbench"

-- 150 x 90 pixels, so that parts cross the blocks in which pictures are stored; every pixel differs
-- from its neighbours, and some are clear.
local SHEET = [[
local celspan = require "celspan"
local random = celspan.random("sheet")
local shapes = {}
for y = 0, 89 do
  for x = 0, 149 do
    local label = x .. "," .. y
    if random(label .. "a") > 0.1 then
      shapes[#shapes + 1] = celspan.rect { x, y, 1, 1, texture = celspan.rgb(random(label .. "r"),
        random(label .. "g"), random(label .. "b"), random(label .. "o") > 0.5 and 1 or random(label
          .. "k")) }
    end
  end
end
return celspan.film { size = { 150, 90 }, frame = function()
  return celspan.rostrum { celspan.cel(shapes), antialias = "none" }
end }
]]

describe("the source of an image", function()
  local bench, sheet

  setup(function()
    bench = workbench.new()
    local code, _, err = bench:celspan("render %s -o %s", bench:write("sheet.lua", SHEET),
      bench.folder .. "/sheet.png")
    assert.are.equal(0, code, err)
    sheet = bench.folder .. "/sheet.png"
  end)
  teardown(function() bench:remove() end)

  --- The part as a file of its own.
  local function cut(x, y, w, h)
    local path = ("%s/cut-%d-%d-%d-%d.png"):format(bench.folder, x, y, w, h)
    local code, _, err = bench:celspan("convert %s %s --crop %d,%d,%d,%d", sheet, path, x, y, w, h)
    assert.are.equal(0, code, err)
    return path
  end

  local function bytes(object, workers)
    local rostrum = celspan.rostrum { celspan.cel { object } }
    local image = assert(celspan.pixels(rostrum, { size = { 97, 83 }, workers = workers }))
    return image:bytes { depth = "float" }
  end

  local PARTS = { { 0, 0, 150, 90 }, { 10, 5, 16, 16 }, { 60, 60, 70, 30 }, { 149, 89, 1, 1 },
                  { 63, 0, 2, 90 }, { 0, 64, 64, 26 } }

  local function each_part(test)
    if not present.pictures() then pending "there is no picture module" end
    for _, part in ipairs(PARTS) do test(part, cut(table.unpack(part))) end
  end

  it("is drawn like a file of its own, to the bit, however it is placed", function()
    each_part(function(part, file)
      local ways = {
        function(o) return o end,
        function(o) return o:translate(20, 30) end,
        function(o) return o:translate(0.3, 0.6) end,
        function(o) return o:scale(5.3):translate(-7, 2) end,
        function(o) return o:scale(0.3):translate(3, 3) end,
        function(o) return o:scale(0.05, 0.2):translate(40, 3) end,
        function(o) return o:rotate(90, 30, 30) end,
        function(o) return o:rotate(33, 30, 20):scale(1.4) end,
        function(o) return o:rotate(33, 30, 20):scale(0.35):translate(20, 20) end,
        function(o) return o:quad({ { 0, 0 }, { 90, 0 }, { 90, 80 }, { 0, 80 } },
                                  { { 5, 5 }, { 90, 15 }, { 80, 70 }, { 15, 80 } }) end,
      }
      for i, way in ipairs(ways) do
        for _, sampling in ipairs { "auto", "nearest", "bilinear", "bicubic" } do
          local ours = celspan.image { file = sheet, source = part, sampling = sampling }
          local theirs = celspan.image { file = file, sampling = sampling }
          assert.is_true(bytes(way(ours)) == bytes(way(theirs)),
            ("part %s, way %d, %s"):format(table.concat(part, ","), i, sampling))
        end
      end
    end)
  end)

  it("wraps, fits and lights like a file of its own", function()
    each_part(function(part, file)
      for _, fields in ipairs {
        { w = 60, h = 60, fit = "contain" }, { w = 60, h = 60, fit = "cover" }, { w = 40 },
        { w = 80, h = 70, fit = "contain", wrap = "repeat" }, { w = 50, h = 20, as = "gel" },
      } do
        fields.file, fields.source = file, nil
        local theirs = bytes(celspan.image(fields))
        fields.file, fields.source = sheet, part
        assert.is_true(bytes(celspan.image(fields)) == theirs)
      end
      for _, wrap in ipairs { "clear", "clamp", "repeat" } do
        local function textured(fields)
          fields.box, fields.wrap = { 20, 10, 30, 40 }, wrap
          return celspan.circle { centre = { 40, 40 }, radius = 38,
            texture = celspan.picture(fields) }
        end
        assert.is_true(bytes(textured { file = sheet, source = part }, 3)
          == bytes(textured { file = file }, 1))
      end
    end)
  end)

  it("is used by probe, too", function()
    each_part(function(part, file)
      local ours = celspan.rostrum {
        celspan.cel { celspan.image { file = sheet, source = part, w = 30, h = 30 } } }
      local theirs = celspan.rostrum {
        celspan.cel { celspan.image { file = file, w = 30, h = 30 } } }
      for _, at in ipairs { { 0.1, 0.1 }, { 29.9, 29.9 }, { 7.7, 21.3 } } do
        assert.are.same({ celspan.probe(theirs, at[1], at[2]) },
          { celspan.probe(ours, at[1], at[2]) })
      end
    end)
  end)

  it("determines the size, and can be read and changed", function()
    if not present.pictures() then pending "there is no picture module" end
    local image = celspan.image { file = sheet, source = { 10, 5, 16, 12 }, x = 3 }
    assert.are.same({ 3, 0, 16, 12 }, { image:bounds() })
    assert.are.same({ 10, 5, 16, 12 }, image.source)
    assert.are.same({ 3, 0, 20, 12 }, { image:with { source = { 0, 0, 20, 12 } }:bounds() })
  end)

  it("allows a sheet of sprites with any limit of memory", function()
    if not present.pictures() then pending "there is no picture module" end
    bench:write("walk.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 30, 30 }, frames = 9, frame = function(f)
  local sprite = celspan.image { file = "sheet.png", source = { 16 * f.index, 7, 16, 20 }, w = 30, h
    = 30 }
  return celspan.rostrum { celspan.cel { sprite } }
end }]])
    local function hashes(options)
      local code, out, err = bench:celspan("render %s/walk.lua --hash %s", bench.folder, options)
      assert.are.equal(0, code, err)
      return out
    end
    local plain = hashes ""
    assert.are.equal(plain, hashes "--memory 0 --workers 2")
    assert.are.equal(9, select(2, plain:gsub("\n", "")))
  end)

  it("selects from pixels in memory too", function()
    local bytes_of, whole, part = celspan.random("pixels"), {}, {}
    for y = 0, 69 do
      for x = 0, 79 do
        local pixel = {}
        for c = 1, 4 do pixel[c] = bytes_of(c .. "," .. x .. "," .. y, 0, 255) end
        whole[#whole + 1] = string.char(table.unpack(pixel))
        if x >= 60 and x < 75 and y >= 3 then part[#part + 1] = whole[#whole] end
      end
    end
    local ours = { pixels = table.concat(whole), size = { 80, 70 }, source = { 60, 3, 15, 67 } }
    local theirs = { pixels = table.concat(part), size = { 15, 67 } }
    for _, way in ipairs { function(o) return o end, function(o) return o:scale(0.3) end,
                           function(o) return o:rotate(20, 10, 10):scale(3) end } do
      assert.is_true(bytes(way(celspan.image(ours)), 2) == bytes(way(celspan.image(theirs))))
    end
    assert.are.equal("image: a picture in memory: source {60, 3, 21, 1} is not inside the "
      .. "picture, which is "
      .. "80 x 70 pixels", (raised.sentence(function()
        ours.source = { 60, 3, 21, 1 }
        celspan.image(ours)
      end)))
  end)

  it("is refused at its line when it is not inside the picture", function()
    if not present.pictures() then pending "there is no picture module" end
    local function refusal(source)
      return (raised.sentence(function() celspan.image { file = sheet, source = source } end))
    end
    assert.are.equal("image: " .. sheet
      .. ": source {140, 0, 11, 5} is not inside the picture, which is "
      .. "150 x 90 pixels", refusal { 140, 0, 11, 5 })
    assert.is_truthy(refusal({ 0, 89, 1, 2 }):find("is not inside the picture", 1, true))
    assert.are.equal("image: x of source is 0.5; it must be a whole number of pixels, 0 or more",
      refusal { 0.5, 0, 1, 1 })
    assert.are.equal("image: w of source is 0; it must be a whole number of pixels, 1 or more",
      refusal { 0, 0, 0, 1 })
    assert.are.equal("image: y of source is -1; it must be a whole number of pixels, 0 or more",
      refusal { 0, -1, 1, 1 })
    assert.is_truthy(refusal({ 1, 2 }):find("source", 1, true))
    local message = raised.message(celspan.image,
      { file = bench.folder .. "/none.png", source = { 0, 0, 1, 1 } })
    assert.is_truthy(message:find("none.png", 1, true), message)
  end)
end)
