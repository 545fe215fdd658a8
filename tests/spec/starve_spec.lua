-- A program without memory: whichever allocation of the whole process fails, alone or with all after
-- it, a render ends with the right frames or with 33 and a sentence, and leaves nothing unfinished.
-- CELSPAN_STARVE=1 tries every allocation; else some are drawn by lot, by CELSPAN_SEED.
local prng = require "tests.support.prng"
local workbench = require "tests.support.workbench"

local LIBRARY = (os.getenv "CELSPAN_BUILD" or "build") .. "/tests/libstarve.so"
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

local function starve(at, lasts, ending)
  return bench:shell(("cd '%s' && rm -rf out && STARVE_AT=%d STARVE_LASTING=%d STARVE_COUNT=count "
    .. "LD_PRELOAD=%s %s render film.lua -o out/f.##.%s --workers 1 --progress none")
    :format(bench.folder, at, lasts and 1 or 0, LIBRARY, bench.binary, ending))
end

local function frames(ending)
  return { bench:read("out/f.01." .. ending), bench:read("out/f.02." .. ending) }
end

local function check(at, lasts, ending, right)
  local code, _, err = starve(at, lasts, ending)
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

describe("without memory", function()
  for scene, ending in pairs { outlines = "png", procedures = "span" } do
    it("for once, " .. scene .. " end well", function() sweep(scene, ending, false) end)
    it("for good, " .. scene .. " end well", function() sweep(scene, ending, true) end)
  end
end)
