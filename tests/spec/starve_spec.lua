-- A program without memory: whichever allocation of the whole process fails, alone or with all after
-- it, a render ends with the right frames or with 33 and a sentence, and leaves nothing unfinished.
-- CELSPAN_STARVE=1 tries every allocation; else some are drawn by lot, by CELSPAN_SEED.
local prng = require "tests.support.prng"
local workbench = require "tests.support.workbench"

local LIBRARY = workbench.build .. "/tests/libstarve.so"
local SAMPLES = 60
local bench, random

setup(function() random = prng.new(tonumber(os.getenv "CELSPAN_SEED") or 1) end)
before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

local scenes = {
  outlines = [[
local points = {}
for i = 1, 6 do points[i] = { 20 + 15 * math.cos(i * f.number), 15 + 12 * math.sin(i * 2) } end
return celspan.rostrum { back = "#fff", celspan.cel {
  celspan.nurbs { points = points, texture = "#f00" },
  celspan.circle { centre = { 20, 15 }, radius = 5,
    texture = celspan.linear { from = { 0, 0 }, to = { 40, 0 }, { 0, "#f00" }, { 1, "#00f" } } } } }]],
  procedures = [[
return celspan.rostrum { back = "#fff",
  celspan.cel { celspan.scanline { bounds = { 2, 2, 9, 3 }, spans = function() return { { 3, 9, "#0f0" } } end } },
  celspan.cel { celspan.stroke { points = { { 1, 1 }, { 30, 20 }, { 3, 25 } }, width = 3 },
                celspan.circle { centre = { 20, 15 }, radius = 5 } - celspan.rect { 18, 10, 9, 9 } } }]],
}

local RENDER = "render film.lua --workers 1 --progress none -o out/f.##."
local JOIN = "join 'strips/#.png' -o out/f.01."

--- forked: in the processes that were forked alone; nil: in all.
local function starve(at, lasts, ending, forked, command)
  return bench:shell(("cd '%s' && rm -rf out && STARVE_AT=%d STARVE_LASTING=%d STARVE_COUNT=count STARVE_FORKED=%d "
    .. "LD_PRELOAD=%s %s %s%s"):format(bench.folder, at, lasts and 1 or 0, forked and 1 or 0, LIBRARY,
    bench.absolute, command or RENDER, ending))
end

local function frames(ending)
  return { bench:read("out/f.01." .. ending), bench:read("out/f.02." .. ending) }
end

local function check(at, lasts, ending, right, forked, command)
  local code, _, err = starve(at, lasts, ending, forked, command)
  local where = ("allocation %d%s: %s"):format(at, lasts and " and all after it" or "", err)
  for _, name in ipairs(bench:files "out") do assert.truthy(name:find "^f%.", where .. " left " .. name) end
  if code == 0 then
    assert.are.same(right, frames(ending), where)
  else
    assert.are.equal(33, code, where)
    assert.truthy(err:find("memory", 1, true), where)
  end
end

local function sweep(scene, ending, lasts)
  local library = io.open(LIBRARY)
  if not library then return pending "the library that takes memory away is not built" end
  library:close()
  bench:write("film.lua", ([[local celspan = require "celspan"
return celspan.film { size = { 40, 30 }, frames = 2, frame = function(f)
%s
end }]]):format(scenes[scene]))
  assert.are.equal(0, (starve(0, false, ending)))
  local right, count = frames(ending), tonumber(bench:read "count")
  if os.getenv "CELSPAN_STARVE" then
    for at = 1, count do check(at, lasts, ending, right) end
  else
    for _ = 1, SAMPLES do check(random:whole(1, count), lasts, ending, right) end
  end
end

--- Allocations of the processes that write through OpenImageIO, which are too many to be counted: by
--- lot, each power of ten as often as the others; of those that load it, and of those that use it.
local function sweep_apart(lasts)
  local library = io.open(LIBRARY)
  if not library then return pending "the library that takes memory away is not built" end
  library:close()
  bench:write("film.lua", ([[local celspan = require "celspan"
return celspan.film { size = { 40, 30 }, frames = 2, frame = function(f)
%s
end }]]):format(scenes.outlines))
  local code, _, err = starve(0, false, "exr")
  if code == 5 and err:find "built without OpenImageIO" then return pending "there is no picture module" end
  assert.are.equal(0, code, err)
  local right = frames "exr"
  for _ = 1, os.getenv "CELSPAN_STARVE" and 1000 or SAMPLES / 6 do
    check(math.floor(10 ^ (2 + 3.1 * random:whole(0, 1000) / 1000)), lasts, "exr", right)
    check(math.floor(10 ^ (3.7 * random:whole(0, 1000) / 1000)), lasts, "exr", right, true)
  end
end

--- Joining makes few allocations: each of them fails.
local function sweep_join(lasts)
  local library = io.open(LIBRARY)
  if not library then return pending "the library that takes memory away is not built" end
  library:close()
  bench:write("film.lua", "local celspan, f = require 'celspan', { number = 1 }\n" .. scenes.outlines)
  for i = 1, 2 do
    local code, _, err = bench:shell(("cd '%s' && %s render film.lua --size 40x300 --strip %d/2 --progress none "
      .. "-o strips/%d.png"):format(bench.folder, bench.absolute, i, i))
    assert.are.equal(0, code, err)
  end
  assert.are.equal(0, (starve(0, false, "png", false, JOIN)))
  local right = frames "png"
  for at = 1, tonumber(bench:read "count") do check(at, lasts, "png", right, false, JOIN) end
end

describe("without memory", function()
  it("for once, strips are joined or not", function() sweep_join(false) end)
  it("for good, strips are joined or not", function() sweep_join(true) end)
  it("for once, what OpenImageIO writes ends well", function() sweep_apart(false) end)
  it("for good, what OpenImageIO writes ends well", function() sweep_apart(true) end)
  for scene, ending in pairs { outlines = "png", procedures = "span" } do
    it("for once, " .. scene .. " end well", function() sweep(scene, ending, false) end)
    it("for good, " .. scene .. " end well", function() sweep(scene, ending, true) end)
  end
end)
