-- scripts/film.lua, the second film: the faults that a viewer would notice first.
package.path = "./scripts/?.lua;" .. package.path
local celspan = require "celspan"
require "celspan.spec"
setmetatable(_G, { __index = celspan.names {} }) -- as in scripts that the program runs

local is_there, film = pcall(dofile, "scripts/film.lua")
if not is_there then
  -- Built without the libraries for type and XML, celspan reads no drawings and paintings.
  pending("the second film, without celspan-type.so: " .. tostring(film))
  return
end

local lips = require "celspan.lips"
local acting = require "film.acting"
local close = require "film.shots.close"
local lamplighter = require "film.lamplighter"
local timing = require "film.timing"

local function frame_at(time) return math.floor(time * timing.fps + 0.5) + 1 end

--- The light at a point of a frame.
local function light_at(time, x, y)
  local r, g, b = assert(celspan.probe(film, x, y, { frame = frame_at(time) }))
  return r + g + b, r, b
end

--- The number of exposures of a frame, and the sum of their weights.
local function exposures(time)
  local list, sum = film:at(frame_at(time)), 0
  for _, exposure in ipairs(list) do sum = sum + exposure[2] end
  return #list, sum
end

describe("the second film", function()
  it("is 29.5 seconds of 24 frames, and has sound only if that is given", function()
    assert.are.same({ 1920, 1080 }, film.size)
    assert.are.equal(708, film.frames)
    assert.is_nil(film.sound)
    local sounding = assert(loadfile "scripts/film.lua")("out/sound.wav")
    assert.are.equal("out/sound.wav", sounding.sound)
  end)

  it("cuts and dissolves, and is as bright in a dissolve as outside", function()
    assert.are.equal(1, (exposures(3)))
    assert.are.equal(1, (exposures(timing.shots[3].from)))
    for i = 2, #timing.shots do
      local shot, before = timing.shots[i], timing.shots[i - 1]
      if shot.from < before.to then
        local count, sum = exposures((shot.from + before.to) / 2)
        assert.are.equal(2, count)
        assert.is_true(math.abs(sum - 1) < 1e-9)
      end
    end
  end)

  it("is never completely still while somebody is visible #full", function()
    for _, time in ipairs { 2, 8, 9.7, 12.9, 13.8, 16.2, 19.4, 23 } do
      local frame = frame_at(time)
      assert.is_not.frames(film, frame, frame + 2).look_alike()
    end
  end)
end)

describe("the lips", function()
  local voice = assert(lips.read("../../../scripts/film/voice.tsv", { fps = timing.fps }))

  it("follow the voice wherever the sheet says so", function()
    local shapes, count = {}, 0
    for frame = 1, film.frames do
      if acting.sheet:at("mouth", frame) == "voice" then
        local mouth = acting.at((frame - 1) / timing.fps).mouth
        assert.are.equal(voice:at(frame), mouth)
        if not shapes[mouth] then shapes[mouth], count = true, count + 1 end
      end
    end
    assert.is_true(count >= 6)
  end)

  it("rest in the pause and after the last word", function()
    assert.are.equal("X", acting.at(timing.coaxing + 0.9).mouth)
    assert.are.equal("smile", acting.at(timing.thanks + 1).mouth)
  end)

  it("are a different drawing for each sound", function()
    local pose = { eyes = "open" }
    local function mouth(name)
      local fields = { mouth = name }
      for key, value in pairs(pose) do fields[key] = value end
      return celspan.rostrum { celspan.cel { (lamplighter.draw(fields)):translate(960, 1000) } }
    end
    for _, name in ipairs { "A", "C", "D", "E", "F", "H", "smile" } do
      local film_of_two = celspan.film { frames = 2, frame = function(f)
        return mouth(f.number == 1 and "X" or name)
      end }
      assert.is_not.frames(film_of_two, 1, 2).look_alike()
    end
  end)
end)

describe("the walk", function()
  it("keeps the boot in place on the ground while he passes over it", function()
    for k = 1, 3 do
      local here, before = lamplighter.step(tostring(k + 1)), lamplighter.step(tostring(k))
      assert.are.equal(before.near[1], here.near[1] + here.advance)
      assert.are.equal(0, here.near[2])
    end
  end)

  it("brings him forward and never back, and ends at the lamp", function()
    local last = 0
    for time = 6, 10, 1 / 24 do
      local _, way = acting.at(time)
      assert.is_true(way >= last)
      last = way
    end
    assert.are.equal(acting.far_way(), last)
    assert.are.equal("stand", acting.at(timing.reach).step)
  end)
end)

describe("the lamp", function()
  it("is dark until the spark takes, and burns from then on", function()
    assert.are.equal(0, close.lamp_level(timing.rises))
    assert.is_true(close.lamp_level(timing.catches - 0.04) < 0.1)
    assert.is_true(close.lamp_level(timing.thanks) > 0.99)
  end)

  it("lights glass, face and street", function()
    for _, point in ipairs { { 1500, 400 }, { 560, 600 }, { 1700, 960 } } do
      local before = light_at(timing.rises, point[1], point[2])
      local after, red, blue = light_at(timing.thanks, point[1], point[2])
      assert.is_true(after > 1.5 * before, ("at %g, %g"):format(point[1], point[2]))
      assert.is_true(red > blue)
    end
  end)
end)

describe("the cels", function()
  it("appear under their names when it is their turn #full", function()
    for name, time in pairs { title = 3.5, lamplighter = 8, branch = 6.5, puff = 11.2, spark = 14,
      rim = 19, windows = 23, star = 26, credits = 26 } do
      assert.cel(film, frame_at(time), name).is_visible()
    end
  end)

  it("leave when it is over", function()
    assert.cel(film, frame_at(timing.shots[2].from - 0.1), "title").is_not.visible()
    assert.cel(film, frame_at(timing.windows - 0.3), "windows").is_not.visible()
  end)

  it("keep one window in the end", function()
    local town = require "film.town"
    local _, _, width = town.keeper.panes[1]:bounds()
    assert.is_true(width > 0)
    assert.cel(film, frame_at(28), "windows").is_visible()
    assert.cel(film, frame_at(28), "windows").is_not.covers(0.002)
  end)
end)
