-- The multiplane camera and the shutter.
local celspan = require "celspan"
local multiplane = require "celspan.multiplane"
local shutter = require "celspan.shutter"
local raised = require "tests.support.raised"

local function cel(texture)
  return celspan.cel { celspan.rect { 40, 20, 20, 10, texture = texture } }
end

local film = { 100, 50 }

local function box(rostrum, i)
  return { rostrum[i]:bounds() }
end

describe("multiplane", function()
  it("makes fitted planes fill the film at rest, and move apart in motion", function()
    local function bounds(camera, fits)
      local rostrum = multiplane { film = { 100, 50 }, focal = 500, camera = camera, fit = true,
        { celspan.cel { celspan.rect { 0, 0, 100, 50 } }, z = 500, fit = fits } }
      return { rostrum[1]:bounds() }
    end
    assert.are.same({ 0, 0, 100, 50 }, bounds(nil))
    assert.are.same({ -10, 0, 100, 50 }, bounds { x = 20 }) -- half as fast as a plane at z = 0
    assert.are.same({ 25, 12.5, 50, 25 }, bounds(nil, false))
  end)

  it("has planes of several cels, with or without a list of their own", function()
    local one, two = cel():named "one", cel():named "two"
    for _, plane in ipairs { { { one, two }, z = 9 }, { one, two, z = 9 } } do
      local rostrum = multiplane { film = film, plane }
      assert.are.same({ "one", "two" }, { rostrum[1].name, rostrum[2].name })
    end
  end)

  it("does not move the overlay", function()
    local caption = celspan.cel { celspan.rect { 1, 2, 3, 4 } }:named("caption")
    local rostrum = multiplane { film = film, camera = { x = 99, z = 50 }, over = { caption },
      { celspan.cel {}, z = 0 } }
    assert.are.equal("caption", rostrum[#rostrum].name)
    assert.are.same({ 1, 2, 3, 4 }, { rostrum[#rostrum]:bounds() })
  end)

  it("refuses planes that cannot fit and overlays that are not cels", function()
    local message = raised.message(function()
      multiplane { film = film, fit = true, { celspan.cel {}, z = -1000 } }
    end)
    assert.is_truthy(message:find("camera_spec.lua:%d+: multiplane: plane 1 lies at or behind"),
      message)
    message = raised.message(function() multiplane { film = film, over = { 7 } } end)
    assert.is_truthy(message:find "camera_spec.lua:%d+: multiplane: over: item 1 must be a rostrum",
      message)
  end)

  it("shows a plane at depth 0 unchanged", function()
    local rostrum = multiplane { film = film, { cel(), z = 0 } }
    assert.are.same({ 40, 20, 20, 10 }, box(rostrum, 1))
  end)

  it("shrinks far planes around the centre and pans them less", function()
    local rostrum = multiplane { film = film, focal = 1000, camera = { x = 10 },
      { cel(), z = 0 }, { cel(), z = 1000 } }
    assert.are.same({ 40, 22.5, 10, 5 }, box(rostrum, 1))
    assert.are.same({ 30, 20, 20, 10 }, box(rostrum, 2))
  end)

  it("puts farther planes first and keeps the order of equals", function()
    local rostrum = multiplane { film = film,
      { cel "#100", z = 0 }, { cel "#200", z = 500 }, { cel "#300", z = 500 }, { cel "#400" } }
    local textures = {}
    for i = 1, 4 do textures[i] = rostrum[i][1].texture end
    assert.are.same({ "#200", "#300", "#100", "#400" }, textures)
  end)

  it("leaves out planes behind the camera", function()
    local rostrum = multiplane { film = film, camera = { z = 1000 }, { cel(), z = 0 },
      { cel(), z = 1 } }
    assert.is_truthy(rostrum[1])
    assert.is_nil(rostrum[2])
  end)

  it("defocuses planes that are not at the focus distance", function()
    local rostrum = multiplane { film = film, focal = 1000, aperture = 12, focus = 1000,
      { cel(), z = 0 }, { cel(), z = 1000 } }
    assert.are.equal(6, rostrum[1].defocus.radius)
    assert.is_nil(rostrum[2].defocus)
  end)

  it("keeps a depth in focus while the camera moves", function()
    local rostrum = multiplane { film = film, focal = 1000, aperture = 12, focus_on = 200,
      camera = { z = 150 }, { cel(), z = 200 }, { cel(), z = 1250 } }
    assert.are.equal(12 * 1050 / 2100, rostrum[1].defocus.radius)
    assert.is_nil(rostrum[2].defocus)
    local message = raised.message(function()
      multiplane { film = film, focus = 1, focus_on = 1 }
    end)
    assert.is_truthy(message:find("camera_spec.lua:%d+: multiplane: 'focus' is a dist"), message)
  end)

  it("reports wrong arguments at the caller's line", function()
    local message = raised.message(function() multiplane { film = film, focl = 3 } end)
    assert.is_truthy(message:find("camera_spec.lua:%d+: multiplane: unknown field 'focl'"), message)
    message = raised.message(function() multiplane { film = film, { 3 } } end)
    assert.is_truthy(message:find("camera_spec.lua:%d+: multiplane: plane 1 must be"), message)
    message = raised.message(function()
      multiplane { film = film, { celspan.cel {}, Z = 3 } }
    end)
    assert.is_truthy(message:find(
      "camera_spec.lua:%d+: multiplane: plane 1: unknown field 'Z'; did you mean 'z'"), message)
    message = raised.message(function() multiplane { film = film, focal = 0 / 0 } end)
    assert.is_truthy(message:find(
      "camera_spec.lua:%d+: multiplane: field 'focal' must be a finite number"), message)
    raised.message(function() multiplane { { cel() } } end)
  end)
end)

describe("shutter", function()
  local function exposures_of(settings, number)
    local times = {}
    settings.frame = settings.frame or function(f)
      times[#times + 1] = f.time
      return celspan.rostrum {}
    end
    local result = celspan.film { fps = 10, frames = 5, frame = shutter(settings) }:at(number)
    return result, times
  end

  it("exposes at the middles of equal shares of the open time", function()
    local result, times = exposures_of({ angle = 180, samples = 2 }, 3)
    assert.are.equal(2, #result)
    assert.are.same({ 0.5, 0.5 }, { result[1][2], result[2][2] })
    assert.is_true(math.abs(times[1] - 0.2125) < 1e-12 and math.abs(times[2] - 0.2375) < 1e-12)
  end)

  it("keeps the weights of several exposures", function()
    local rostrum = celspan.rostrum {}
    local result = exposures_of({ samples = 4, frame = function()
      return { { rostrum, 0.25 }, { rostrum, 0.75 } }
    end }, 1)
    assert.are.equal(8, #result)
    assert.are.equal(0.75 / 4, result[2][2])
  end)

  it("passes on all other fields of f", function()
    local seen = {}
    exposures_of({ samples = 1, frame = function(f)
      seen = { f.number, f.index, f:on(2), f.width, f:random "x" == f:random "x" }
      return celspan.rostrum {}
    end }, 4)
    assert.are.same({ 4, 3, 2, 1920, true }, seen)
  end)

  it("refuses angles and samples that make no sense", function()
    raised.message(shutter, { angle = 400, frame = print })
    raised.message(shutter, { samples = 0, frame = print })
    raised.message(shutter, {})
  end)
end)
