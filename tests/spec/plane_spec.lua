-- Planes in Lua and on the command line: made, written, read, drawn, compared and refused.
local celspan = require "celspan"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local it_compares = present.pictures() and it or pending -- pictures are read to compare them

local bench

before_each(function()
  bench = workbench.new()
  bench:write("film.lua", [[
local celspan = require "celspan"
local sky = celspan.linear { from = { 0, 0 }, to = { 0, 90 }, { 0, "#204060" }, { 1, "#f0d0a0" } }
return celspan.film { size = { 160, 90 }, frames = 3, frame = function(f)
  return celspan.rostrum { back = "#fff", celspan.cel {
    celspan.rect { 0, 0, 160, 60, texture = sky },
    celspan.circle { centre = { 40 + 20 * f.number, 50 }, radius = 30, texture = "#f26419c0" } } }
end }
]])
  bench:write("blurred.lua", [[
local celspan = require "celspan"
local disc = celspan.circle { centre = { 80, 45 }, radius = 30 }
return celspan.film { size = { 160, 90 }, frames = 1, frame = function()
  return celspan.rostrum { celspan.cel { disc, defocus = 3 } }
end }
]])
end)
after_each(function() bench:remove() end)

local function run(arguments, ...) return bench:celspan_inside(arguments, ...) end

local function done(arguments, ...)
  local code, out, err = run(arguments, ...)
  assert.equal(0, code, err)
  return out
end

local function refused(exit, message, arguments, ...)
  local code, _, err = run(arguments, ...)
  assert.equal(exit, code, err)
  assert.matches(message, err, 1, true)
end

local function disc(x)
  return celspan.rostrum { celspan.cel {
    celspan.circle { centre = { x, 45 }, radius = 30, texture = "#f26419" } } }
end

describe("a plane in Lua", function()
  it("is drawn as the rostrum is", function()
    local plane = assert(celspan.plane(disc(80), { film = { 160, 90 } }))
    assert.same({ 160, 90 }, { plane.width, plane.height })
    for _, mode in ipairs { "area", "none" } do
      local options = { size = { 320, 180 }, film = { 160, 90 }, antialias = mode }
      local drawn = assert(plane:pixels { size = { 320, 180 }, antialias = mode })
      local rendered = assert(celspan.pixels(disc(80), options))
      for y = 0, 179, 7 do
        for x = 0, 319 do
          local r = drawn:get(x, y)
          assert.near(rendered:get(x, y), r, 0.01)
        end
      end
    end
  end)

  it("has a pixel for each unit where no size is given, and crops", function()
    local plane = assert(celspan.plane(disc(80), { film = { 160, 90 } }))
    local whole, part = assert(plane:pixels()), assert(plane:pixels { crop = { 50, 20, 30, 40 } })
    assert.same({ 160, 90, 30, 40 }, { whole.width, whole.height, part.width, part.height })
    for y = 0, 39 do
      for x = 0, 29 do assert.same({ whole:get(50 + x, 20 + y) }, { part:get(x, y) }) end
    end
  end)

  it("is one of a film's frames", function()
    local film = celspan.film { size = { 160, 90 }, frames = 3, frame = function(f)
      return disc(40 * f.number)
    end }
    local second = assert(celspan.plane(film, { frame = 2 }))
    assert.equal(1, select(4, assert(second:pixels()):get(80, 45)))
    assert.equal(0, select(4, assert(second:pixels()):get(140, 45)))
    assert.error_matches(function() return celspan.plane(film, { frame = 4 }) end, "frame 4")
  end)

  it("is written, and read again as the same", function()
    local plane = assert(celspan.plane(disc(80), { film = { 160, 90 } }))
    assert.is_true(plane:write(bench.folder .. "/disc.plane"))
    local again = assert(celspan.plane_read(bench.folder .. "/disc.plane"))
    assert.equal(tostring(plane), tostring(again))
    assert.equal(plane:pixels():bytes(), again:pixels():bytes())
    assert.equal(#bench:read "disc.plane", plane.bytes)
  end)

  it("is not made of what it cannot keep, nor read from other files", function()
    local blurred = celspan.rostrum { celspan.cel {
      celspan.circle { centre = { 80, 45 }, radius = 30 }, defocus = 3 } }
    local plane, message = celspan.plane(blurred)
    assert.is_nil(plane)
    assert.matches("a blurred object is in view", message, 1, true)
    plane, message = celspan.plane { { disc(1), 0.5 }, { disc(9), 0.5 } }
    assert.is_nil(plane)
    assert.matches("several exposures", message, 1, true)
    plane, message = celspan.plane_read(bench.folder .. "/film.lua")
    assert.is_nil(plane)
    assert.matches("plane file", message, 1, true)
    assert.is_nil((celspan.plane_read(bench.folder .. "/none.plane")))
  end)

  it("refuses wrong calls", function()
    local plane = assert(celspan.plane(disc(80), { film = { 160, 90 } }))
    assert.error_matches(function() return plane.size end, "unknown field 'size'")
    assert.error_matches(function() plane:pixels { sice = 1 } end, "did you mean 'size'")
    assert.error_matches(function() plane:pixels { size = { 0, 3 } } end, "at least 1")
    assert.error_matches(function() plane.pixels {} end, "call it as a method")
    assert.error_matches(function() plane:write(3) end, "must be a file name")
    local image, message = plane:pixels { crop = { 150, 0, 20, 20 } }
    assert.is_nil(image)
    assert.matches("does not lie inside the frame", message, 1, true)
    assert.is_nil((plane:write(bench.folder .. "/film.lua/x.plane")))
  end)
end)

describe("a plane on the command line", function()
  it("is rendered, one for each frame", function()
    done("render film.lua -o a.##.plane")
    assert.equal("celplane", bench:read "a.02.plane":sub(1, 8))
    assert.matches("size 160x90\nalpha none\nbytes %d+\nbands 1\n", done "info a.02.plane")
    assert.matches("gradients %d+\n$", done "info a.02.plane")
    refused(2, "several frames (3) need a number", "render film.lua -o a.plane")
  end)

  it_compares("is converted to what the film's frame shows", function()
    done("render film.lua --frames 2 -o a.plane")
    for _, size in ipairs { "160x90", "500x300" } do
      done("render film.lua --frames 2 --size " .. size .. " -o a.png")
      done("convert a.plane b.png --size " .. size)
      done("compare a.png b.png --fail 0.01")
      done("compare a.plane a.png --fail 0.01")
    end
    done("convert a.plane c.png --size 500x300 --crop 100,90,50,40")
    done("convert b.png d.png --crop 100,90,50,40")
    done("compare c.png d.png")
  end)

  it("is printed as spans, and cut into tiles", function()
    done("render film.lua --frames 2 -o a.plane")
    local spans = done("spans a.plane --size 16x9 --rows 8-8")
    assert.equal("8 0 16 single 1 1 1 1\n", spans:match "^[^\n]*\n$")
    refused(2, "is a plane", "spans a.plane --stats")
    done("tiles a.plane -o tiles --size 1024x576")
    assert.is_truthy(bench:read "tiles/a.dzi")
  end)

  it("is not made where options ask for pixels", function()
    for _, option in ipairs { "--size 9x9", "--crop 0,0,9,9", "--depth 16", "--hash", "--draft" } do
      refused(2, "a plane has no pixels", "render film.lua --frames 1 -o a.plane " .. option)
    end
    refused(3, "a blurred object is in view", "render blurred.lua -o a.plane")
    assert.is_nil(bench:read "a.plane")
  end)

  it("is refused when it is damaged, with the place", function()
    done("render film.lua --frames 2 -o a.plane")
    local bytes = bench:read "a.plane"
    bench:write("b.plane", bytes:sub(1, 60) .. "x" .. bytes:sub(62))
    refused(4, "b.plane: byte 40: band 0: the checksum is wrong", "info b.plane")
    bench:write("c.plane", bytes:sub(1, -9))
    refused(4, "c.plane: byte", "convert c.plane c.png")
    refused(3, "('celspan info a.plane' describes it)", "render a.plane -o a.png")
  end)

  it_compares("is not made of a picture", function()
    done("render film.lua --frames 1 -o a.png")
    refused(2, "not of a picture", "convert a.png a.plane")
  end)
end)
