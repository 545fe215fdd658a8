-- Films of flat cels, which are drawn from maps: the same bytes however a frame is asked for.
local workbench = require "tests.support.workbench"

local SCRIPT = [[
local celspan = require "celspan"
local frames, shapes = ...
frames = math.tointeger(tonumber(frames))
local disc = celspan.circle { centre = { 0, 0 }, radius = 20, texture = "#c03020a0" }
local star = celspan.polygon { { 0, 0 }, { 40, 10 }, { 5, 33 }, texture = "#2040c0" }
local parts = { celspan.rect { 0, 40, 128, 40, texture = "#308040" } }
-- Too small to be seen: cels of few shapes have no maps.
for i = 2, tonumber(shapes or 766) do
  parts[i] = celspan.rect { 20, 50, 1e-6, 1e-6, texture = "#fff" }
end
local hill = celspan.union(parts)
return celspan.film { size = { 128, 80 }, frames = frames, frame = function(f)
  return celspan.rostrum {
    celspan.cel { hill }:named "hill",
    celspan.cel { star:translate(3.7 * f.number, 20), opacity = 0.7 },
    celspan.cel { disc:translate(100 - 5.3 * f.number, 45), front = { 1, 0.9, 0.5 } },
    back = "#fffbe0", camera = { width = 128 - 3 * f.number } }
end }
]]

describe("a film of flat cels", function()
  local bench, script

  setup(function()
    bench = workbench.new()
    script = bench:write("film.lua", SCRIPT)
  end)
  teardown(function() bench:remove() end)

  --- Raw pixels of frames, and options.
  local function raw(frames, options)
    local code, out, err = bench:celspan("render %s -o - %s -- %d", script, options or "", frames)
    assert.are.equal(0, code, err)
    return out
  end

  --- What --stats counts for a frame.
  local function counted(name, frames, options, shapes)
    local code, out, err = bench:celspan("spans %s --stats %s -- %d %s", script, options or "",
      frames, shapes or "")
    assert.are.equal(0, code, err)
    return tonumber(out:match(" " .. name .. " (%d+)"))
  end

  it("is drawn from maps where it has several frames", function()
    assert.are.equal(3, counted("maps", 4))
    assert.are.equal(3, counted("maps_made", 4))
    assert.are.equal(0, counted("maps", 1))
    assert.are.equal(0, counted("maps", 4, "", 765))
    assert.are.equal(0, counted("maps", 4, "--antialias none"))
    assert.are.equal(0, counted("maps", 4, "--size 8200x80"))
  end)

  it("has the same bytes in any order, alone, with any number of workers and little memory",
    function()
      local whole = raw(4)
      assert.are.equal(4 * 128 * 80 * 4, #whole)
      local alone = {}
      for k = 1, 4 do alone[k] = raw(4, "--frames " .. k) end
      assert.are.equal(whole, table.concat(alone))
      assert.are.equal(whole, raw(4, "--workers 1"))
      assert.are.equal(whole, raw(4, "--workers 3 --memory 1"))
    end)

  it("looks as if it were swept", function()
    local swept, drawn = raw(1), raw(4, "--frames 1")
    local most = 0
    for i = 1, #swept do most = math.max(most, math.abs(swept:byte(i) - drawn:byte(i))) end
    assert.is_true(most <= 1, most .. " of 255")
  end)
end)
