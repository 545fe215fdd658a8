-- Films that are drawn from maps: the same bytes however a frame is asked for.
local workbench = require "tests.support.workbench"

local SCRIPT = [[
local celspan = require "celspan"
local frames, shapes = ...
frames = math.tointeger(tonumber(frames))
local disc = celspan.circle { centre = { 0, 0 }, radius = 20, texture = "#c03020a0" }
local star = celspan.polygon { { 0, 0 }, { 40, 10 }, { 5, 33 }, texture = "#2040c0" }
local parts = { celspan.rect { 0, 40, 128, 40, texture = "#308040" } }
-- Too small to be seen: cels of few shapes have no maps.
for i = 2, tonumber(shapes or 256) do
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

describe("a film that is drawn from maps", function()
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

  it("has no map of a bent gradient, whose hundreds of triangles are one shape", function()
    local bent = bench:write("bent.lua", [[
local celspan = require "celspan"
local box = celspan.rect { 10, 10, 80, 40, texture = celspan.linear { from = { 0, 0 },
  to = { 100, 0 }, { 0, "#a33" }, { 1, "#33a" } } }
return celspan.film { size = { 128, 80 }, frames = 2, frame = function(f)
  return celspan.rostrum { celspan.cel { box:warp { pieces = 2000, map = function(x, y)
    return x + 9 * math.sin(y / 20 + f.number), y + 9 * math.sin(x / 20) end } } }
end }]])
    local _, out = bench:celspan("spans %s --stats", bent)
    assert.are.equal("0", out:match " maps (%d+)")
  end)

  it("has cels of many shapes, whether it has one frame or more", function()
    assert.are.equal(3, counted("maps", 4))
    assert.are.equal(3, counted("maps_made", 4))
    assert.are.equal(3, counted("maps", 1))
    assert.are.equal(0, counted("maps", 4, "", 63))
    assert.is_true(counted("maps", 4, "", 64) > 0)
    assert.is_true(counted("maps", 4, "--size 4096x2560 --rows 0-9", 64) > 0)
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

  it("sweeps a defocused cel and a shaped light among maps, one of gels and a gradient", function()
    local mixed = bench:write("mixed.lua", [[
local celspan = require "celspan"
local frames, first = ...
frames = math.tointeger(tonumber(frames))
local grains = {}
for i = 1, 300 do
  grains[i] = celspan.circle { centre = { 9 * (i % 13), 7 * (i // 13) % 60 }, radius = 2,
    texture = celspan.rgb(i % 7 / 7, i % 5 / 5, i % 3 / 3) }
end
local crowd = celspan.union(grains)
local gel = celspan.rect { 10, 5, 60, 60, texture = celspan.paint { pigment = "#102030",
  medium = { 1, 0.6, 0.3 }, beta = 0.2 } }
local soft = celspan.circle { centre = { 60, 40 }, radius = 20, texture = "#30a050" }
local glow = celspan.linear { from = { 0, 0 }, to = { 128, 80 }, { 0, "#f80" }, { 1, "#08f" } }
local veil = celspan.rect { 90, 60, 30, 15, texture = glow }
return celspan.film { size = { 128, 80 }, frames = frames, frame = function(f)
  local t = 3.7 * (f.number + (tonumber(first) or 0))
  return celspan.rostrum {
    celspan.cel { crowd:translate(-t, 0) },
    celspan.cel { gel:translate(t, 0), veil },
    celspan.cel { crowd:translate(t, 20) },
    celspan.cel { soft:translate(t, 0), defocus = 4, back = "#123" },
    celspan.cel { crowd:scale(0.5):translate(30, t) },
    celspan.cel { soft:translate(-t, 10), front = { texture = glow } },
    back = "#fffbe0" }
end }
]])
    local function render(options, frames, first)
      local code, out, err = bench:celspan("render %s -o - --depth float %s -- %d %d", mixed,
        options, frames, first or 0)
      assert.are.equal(0, code, err)
      return out
    end
    local _, out = bench:celspan("spans %s --stats -- 4", mixed)
    assert.are.equal("4", out:match " maps (%d+)")
    assert.are.equal("2", out:match " swept (%d+)")
    local whole = render("", 4)
    local size = 128 * 80 * 16
    for k = 1, 4 do
      assert.are.equal(whole:sub((k - 1) * size + 1, k * size), render("--frames " .. k, 4))
      assert.are.equal(whole:sub((k - 1) * size + 1, k * size), render("", 1, k - 1))
    end
    assert.are.equal(whole, render("--workers 1", 4))
    assert.are.equal(whole, render("--workers 3 --memory 1", 4))
  end)

  it("counts no map of a cel that is then swept", function()
    local vast = bench:write("vast.lua", [[
local celspan = require "celspan"
local near, far = {}, {}
for i = 1, 80 do
  near[i] = celspan.circle { centre = { i, i }, radius = 9 }
  far[i] = celspan.circle { centre = { i * 1e6, 0 }, radius = 4e7 } -- its map would be too large
end
return celspan.film { size = { 320, 200 }, frames = 2, frame = function()
  return celspan.rostrum { celspan.cel { celspan.union(far):scale(0.01) },
                           celspan.cel { celspan.union(near) } }
end }
]])
    local _, out = bench:celspan("spans %s --stats --workers 1", vast)
    assert.matches(" maps 1 maps_made 1 swept 1 ", out, 1, true)
  end)

  it("may have groups, spaces, mattes, grades, and modes that act inside a cel", function()
    local parts = bench:write("parts.lua", [[
local celspan = require "celspan"
local frames, space = math.tointeger(tonumber((...))), select(2, ...)
local function disc(x, colour)
  return celspan.circle { centre = { x, 30 }, radius = 20, texture = colour }
end
local grains = {}
for i = 1, 256 do
  grains[i] = celspan.rect { 2 * (i % 16), 50 + i // 16, 1, 0.5, texture = "#203040" }
end
grains = celspan.union(grains)
local both = celspan.group { disc(30, "#c03020a0"), disc(50, "#2040c0a0"), space = "srgb" }
local graded = celspan.group { disc(40, "#808080a0"), grade = { exposure = 1, gamma = 2 } }
local inside = celspan.group { disc(40, "#60a080"), disc(52, "#d0c0a0"):blend "multiply",
  isolate = true }
local matte = celspan.matte(disc(60, "#904020"), disc(70, "#fff8"))
return celspan.film { size = { 128, 80 }, frames = frames, space = space, frame = function(f)
  return celspan.rostrum {
    celspan.cel { (grains | both):translate(3.7 * f.number, 20) },
    celspan.cel { (grains | graded):translate(60, 2 * f.number), front = { 1, 0.9, 0.5 } },
    celspan.cel { (grains | inside):translate(-2.5 * f.number, 10) },
    celspan.cel { (grains | matte):translate(1.5 * f.number, 0), opacity = 0.8,
      grade = { saturation = 0.5 } },
    back = "#fffbe0" }
end }
]])
    for _, space in ipairs { "linear", "srgb" } do
      local _, out = bench:celspan("spans %s --stats -- 4 %s", parts, space)
      assert.are.equal(4, tonumber(out:match " maps (%d+)"))
      local _, drawn = bench:celspan("render %s -o - --frames 1 -- 4 %s", parts, space)
      local _, still = bench:celspan("render %s -o - -- 1 %s", parts, space)
      assert.are.equal(still, drawn)
    end
  end)

  it("may turn, shear and lie in perspective, with one map for all angles", function()
    local turning = bench:write("turning.lua", [[
local celspan = require "celspan"
local frames = math.tointeger(tonumber((...)))
local grains = {}
for i = 1, 600 do
  grains[i] = celspan.rect { 5 * (i % 25), 4 * (i // 25), 5, 4,
    texture = celspan.rgb(i % 7 / 7, i % 5 / 5, i % 3 / 3) }
end
local field = celspan.union(grains)
local fading = celspan.linear { from = { -20, 0 }, to = { 20, 0 }, { 0, "#c03020" },
  { 1, "#2040c080" } }
local disc = celspan.union { field:scale(0.1), -- and something flat, larger than the gradient
  celspan.rect { -21, -21, 42, 42, texture = "#0000" },
  celspan.circle { centre = { 0, 0 }, radius = 20, texture = fading } }
return celspan.film { size = { 128, 100 }, frames = frames, frame = function(f)
  local turn = 11 * f.number
  return celspan.rostrum {
    celspan.cel { field:quad({ { 0, 0 }, { 127, 0 }, { 127, 100 }, { 0, 100 } },
      { { 30, 10 }, { 98, 10 }, { 120, 90 }, { 8, 90 } }) },
    celspan.cel { disc:rotate(turn):skew(10, 0):translate(40, 40), opacity = 0.8 },
    celspan.cel { disc:rotate(-turn):scale(-1, 1):translate(90, 60) },
    back = "#fffbe0" }
end }
]])
    local _, out = bench:celspan("spans %s --stats -- 4", turning)
    assert.are.equal(4, tonumber(out:match " maps (%d+)")) -- two parts of the nearest cel
    local function made(options, frames)
      local code, text, err = bench:celspan("render %s -o - %s -- %d", turning, options, frames)
      assert.are.equal(0, code, err)
      return text
    end
    local drawn = made("", 4)
    assert.are.equal(made("", 1), made("--frames 1", 4))
    assert.are.equal(drawn:sub(-128 * 100 * 4), made("--frames 4 --workers 3 --memory 1", 4))
  end)

  it("is swept where a mode acts on another cel, or on what is lit", function()
    local modes = bench:write("modes.lua", [[
local celspan = require "celspan"
local square = celspan.rect { 10, 10, 20, 20, texture = "#408060" }
local is_lit = (...) == "lit"
local grains = {}
for i = 1, 256 do grains[i] = celspan.rect { i % 16, i // 16, 1, 1, texture = "#203040" } end
local mode = celspan.group { celspan.union(grains), square, square:blend "screen",
  isolate = is_lit or nil }
return celspan.film { size = { 128, 80 }, frames = 4, frame = function()
  return celspan.rostrum { celspan.cel { mode, front = is_lit and { 0.5, 1, 1 } or nil } }
end }
]])
    for _, kind in ipairs { "lit", "open" } do
      local _, out = bench:celspan("spans %s --stats -- %s", modes, kind)
      assert.are.equal(0, tonumber(out:match " maps (%d+)"))
    end
  end)

  it("has the frames of stills", function()
    assert.are.equal(raw(1), raw(4, "--frames 1"))
  end)

  it("is swept where gradients are larger than all that is flat", function()
    local sky = bench:write("sky.lua", [[
local celspan = require "celspan"
local glow = celspan.linear { from = { 0, 0 }, to = { 128, 80 }, { 0, "#f80" }, { 1, "#08f" } }
local grains = { celspan.rect { 0, 0, 128, 80, texture = glow } }
local width, frames = ...
for i = 1, 300 do
  grains[i + 1] = celspan.rect { 8 * (i % 16), 4 * (i // 16), tonumber(width), 4, texture = "#234" }
end
return celspan.film { size = { 128, 80 }, frames = math.tointeger(tonumber(frames)),
  frame = function() return celspan.rostrum { celspan.cel(grains) } end }
]])
    for width, maps in pairs { [8] = "0", [9] = "1" } do
      for frames = 1, 2 do
        local _, out = bench:celspan("spans %s --stats -- %d %d", sky, width, frames)
        assert.are.equal(maps, out:match " maps (%d+)")
      end
    end
  end)

  it("is swept where shapes are high or let something through, a still like a film", function()
    local tiles = bench:write("tiles.lua", [[
local celspan = require "celspan"
local height, alpha, frames = ...
local grains = {}
for i = 1, 64 do
  grains[i] = celspan.rect { 2 * i, 5, 3, tonumber(height), texture = celspan.rgb(i / 64, 0, 0,
    tonumber(alpha)) }
end
return celspan.film { size = { 140, 300 }, frames = math.tointeger(tonumber(frames)),
  frame = function() return celspan.rostrum { celspan.cel(grains) } end }
]])
    for _, case in ipairs { { 210, 1, "1" }, { 211, 1, "0" }, { 210, 0.9, "0" } } do
      for frames = 1, 2 do
        local _, out = bench:celspan("spans %s --stats -- %g %g %d", tiles, case[1], case[2],
          frames)
        assert.are.equal(case[3], out:match " maps (%d+)")
      end
    end
  end)

  it("may have gradients and pictures", function()
    local dots = bench:write("dots.lua", [[
local celspan = require "celspan"
local dots = {}
for i = 0, 499 do
  dots[i + 1] = celspan.rect { 2 * (i % 25), 2 * (i // 25), 2, 2,
    texture = celspan.rgb(i * 7 % 25 / 25, i * 3 % 20 / 20, i % 5 / 5) }
end
return celspan.film { size = { 50, 40 }, frames = 1, frame = function()
  return celspan.rostrum { celspan.cel(dots) }
end }
]])
    assert.are.equal(0, (bench:celspan("render %s -o %s/dots.png", dots, bench.folder)))
    local varied = bench:write("varied.lua", [[
local celspan = require "celspan"
local frames, space = math.tointeger(tonumber((...))), select(2, ...)
local linear, radial = celspan.linear, celspan.radial
local clear = "#0000"
local hill = { -- with as much that is flat
  celspan.rect { 0, 0, 128, 80, texture = clear }, celspan.rect { 0, 0, 128, 80, texture = clear },
  celspan.rect { 0, 0, 128, 80, texture = linear { from = { 0, 0 }, to = { 128, 80 },
    { 0, "#204080" }, { 0.4, "#f0e0a0" }, { 1, "#c03020" } } },
  celspan.polygon { { 10, 70 }, { 64, 30.3 }, { 120, 75 }, texture = linear { from = { 10, 30 },
    to = { 120, 75 }, { 0, "#604020" }, { 1, "#e0d0c0" } } },
  celspan.rect { 60, 5, 50, 40, texture = celspan.picture { file = "dots.png" } },
  celspan.circle { centre = { 85, 25 }, radius = 12, texture = "#00000060" } }
for _ = 1, 766 do hill[#hill + 1] = celspan.rect { 20, 50, 1e-6, 1e-6, texture = "#fff" } end
hill = celspan.union(hill)
local star = celspan.rect { 0, 0, 41, 34, texture = clear } | celspan.polygon { { 0, 0 },
  { 40, 10 }, { 5, 33 }, texture = linear { from = { 0, 0 }, to = { 40, 20 }, { 0, "#2040c0" },
    { 1, "#20f0c0" } } }
local glow = celspan.rect { -21, -21, 42, 42, texture = clear } | celspan.circle {
  centre = { 0, 0 }, radius = 20, texture = radial { centre = { 0, 0 }, radius = 20,
    { 0, "#ffffff" }, { 1, "#ff800000" } } }
return celspan.film { size = { 128, 80 }, frames = frames, space = space, frame = function(f)
  return celspan.rostrum {
    celspan.cel { hill },
    celspan.cel { star:translate(3.7 * f.number, 20), opacity = 0.7, grade = { exposure = 0.5 } },
    celspan.cel { glow:translate(100 - 5.3 * f.number, 45), front = { 1, 0.9, 0.5 } },
    back = "#fffbe0", camera = { width = 128 - 3 * f.number } }
end }
]])
    for _, space in ipairs { "linear", "srgb" } do
      local _, out = bench:celspan("spans %s --stats --trust -- 4 %s", varied, space)
      assert.are.equal(3, tonumber(out:match " maps (%d+)"))
      assert.is_true(tonumber(out:match " colour_evaluations (%d+)") > 1000)
      local function made(frames, options)
        local code, text, err = bench:celspan("render %s -o - --trust %s -- %d %s", varied, options,
          frames, space)
        assert.are.equal(0, code, err)
        return text
      end
      local drawn = made(4, "--frames 1")
      assert.are.equal(made(1, ""), drawn)
      assert.are.equal(drawn, made(4, "--frames 1 --workers 3"))
      assert.are.equal(drawn, made(4, ""):sub(1, #drawn))
    end
  end)

  it("has spans of a gradient that is before and behind flat drawings, and no arrays", function()
    local layers = bench:write("layers.lua", [[
local celspan = require "celspan"
local function grains(count, alpha)
  local list = {}
  for i = 0, count - 1 do
    list[i + 1] = celspan.rect { 5 * (i % 16), 5 * (i // 16), 4, 4,
                                 texture = celspan.rgb(i % 5 / 4, i % 7 / 6, i % 3 / 2, alpha) }
  end
  return celspan.union(list)
end
local fog = celspan.rect { 0, 0, 80, 80, texture = celspan.linear { from = { 0, 0 }, to = { 80, 9 },
  { 0, "#f0f0ff20" }, { 0.3, "#80a0ffc0" }, { 1, "#ff804000" } } }
local behind, before = grains(256, 1), grains(60, 0.4)
local flat = celspan.rect { 0, 0, 81, 81, texture = "#0000" } -- larger than the gradient
return celspan.film { size = { 80, 80 }, frames = math.tointeger(tonumber((...))),
  frame = function(f)
    return celspan.rostrum { celspan.cel { behind },
      celspan.cel { flat, fog, opacity = 0.9, front = { 1, 0.8, 0.6 } },
      celspan.cel { before:translate(f.number, 2) }, back = "#203040" }
  end }
]])
    local _, out = bench:celspan("spans %s --stats -- 4", layers)
    local arrays, maps = out:match " array (%d+).* maps (%d+)"
    assert.are.equal("0 3", arrays .. " " .. maps)
    local function made(frames)
      local code, text, err = bench:celspan("render %s -o - --frames 1 -- %d", layers, frames)
      assert.are.equal(0, code, err)
      return text
    end
    assert.are.equal(made(1), made(4))
  end)
end)
