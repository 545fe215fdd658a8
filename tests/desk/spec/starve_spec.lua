-- A program without memory: whichever allocation of the whole process fails, alone or with all
-- after it, a render ends with the right frames or with 33 and a sentence, and leaves nothing
-- unfinished. CELSPAN_STARVE=1 tries every allocation; else some are selected at random, by
-- CELSPAN_SEED, and of these one in CELSPAN_FAULTS.
local paintings = require "tests.support.paintings"
local present = require "tests.support.present"
local prng = require "tests.support.prng"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local NO_LIBRARY = "the library that makes allocations fail is not built"
local LIBRARY = workbench.build .. "/tests/libstarve.so"
-- By its name, because a path in LD_PRELOAD ends at a space.
local PRELOADED = ("LD_LIBRARY_PATH='%s/tests' LD_PRELOAD=libstarve.so"):format(workbench.build)
local ALL = os.getenv "CELSPAN_STARVE"
local FAULTS = tonumber(os.getenv "CELSPAN_FAULTS") or 1
local SAMPLES = math.max(60 // FAULTS, 1)
-- Of the allocations while OpenImageIO is loaded, one after the other.
local LOADING_RUN = math.max(100 // FAULTS, 1)
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
    texture = celspan.linear { from = { 0, 0 }, to = { 40, 0 }, { 0, "#f00" }, { 1, "#00f" } } } }
      }]],
  procedures = [[
return celspan.rostrum { back = "#fff",
  celspan.cel { celspan.scanline { bounds = { 2, 2, 9, 3 }, spans = function() return { { 3, 9,
    "#0f0" } } end } },
  celspan.cel { celspan.stroke { points = { { 1, 1 }, { 30, 20 }, { 3, 25 } }, width = 3 },
                celspan.circle { centre = { 20, 15 }, radius = 5 } - celspan.rect { 18, 10, 9, 9 } }
                  }]],
}

local RENDER = "render film.lua --workers 1 --limit picture-time=%d --progress none -o out/f.##."
local JOIN = "join 'strips/#.png' -o out/f.01."

--- plan: at, the number of the allocation; lasts: and all after it; forked: only in processes that
--- were forked; level: of the programs (starve.c); last: each from `at` on up to it fails in a
--- copy; may_die: by a signal, or by our timeout if it waits.
local function starve(plan, ending, command)
  local variables = { ("STARVE_AT=%d STARVE_COUNT=count STARVE_ENDINGS=endings"):format(plan.at) }
  for name, value in pairs { LASTING = plan.lasts and 1, FORKED = plan.forked and 1,
    LEVEL = plan.level or false, UNTIL = plan.last or false, PATH = plan.path or false } do
    if value then variables[#variables + 1] = ("STARVE_%s=%d"):format(name, value) end
  end
  return bench:shell(("cd '%s' && rm -rf out && %s %s %s '%s' %s%s"):format(bench.folder,
    table.concat(variables, " "), PRELOADED, plan.may_die and "timeout -s KILL 5" or "",
    bench.absolute,
    command or RENDER:format(plan.last and 0 or 1), ending))
end

local function write_film(scene)
  bench:write("film.lua", ([[local celspan = require "celspan"
return celspan.film { size = { 40, 30 }, frames = 2, frame = function(f)
%s
end }]]):format(scene))
end

--- The number of allocations, and the numbers before and after the last module was loaded.
local function counts()
  local made, loading, loaded = bench:read("count"):match "(%d+) (%d+) (%d+)"
  return tonumber(made), tonumber(loading), tonumber(loaded)
end

local function frames(ending)
  return { bench:read("out/f.01." .. ending), bench:read("out/f.02." .. ending) }
end

--- Returns the exit code.
local function check(plan, ending, right, command)
  local code, _, err = starve(plan, ending, command)
  local where = ("%s %d%s%s%s: %s")
    :format(plan.path and "path" or "allocation", plan.path or plan.at,
    plan.lasts and " and all after it" or "",
    plan.forked and ", forked" or "", plan.level and ", level " .. plan.level or "", err)
  for _, name in ipairs(bench:files "out") do
    assert.truthy(name:find "^f%.", where .. " left " .. name)
  end
  if code == 0 then
    assert.are.same(right, frames(ending), where)
  elseif plan.level == 1 and not plan.lasts and code == 5 then
    -- it was partly loaded, and crashed while writing
    assert.truthy(err:find("ended its decoder by signal", 1, true), where)
  elseif not (plan.may_die and code > 128) then
    assert.are.equal(33, code, where)
    assert.truthy(err:find("memory", 1, true), where)
  end
  return code
end

--- A plan for each of the allocations of the last run, or for some of them at random. GLib, which a
--- library of the type module needs, ends the process or waits for itself if memory runs out while
--- it is loaded: then no file may be left.
local function plans(lasts, samples)
  local list, count, loading, loaded = {}, counts()
  for i = 1, ALL and count or samples do
    local at = ALL and i or random:whole(1, count)
    list[i] = { at = at, lasts = lasts, may_die = at > loading and at <= loaded }
  end
  return list
end

local function sweep(scene, ending, lasts)
  write_film(scene)
  local code, _, err = starve({ at = 0 }, ending)
  assert.are.equal(0, code, err)
  local right = frames(ending)
  for _, plan in ipairs(plans(lasts, SAMPLES)) do check(plan, ending, right) end
end

--- Scenes that need the type module: libraries that continue without memory would draw something
--- else.
local art = {
  letters = [[
return celspan.rostrum { back = "#fff", celspan.cel {
  celspan.text { "HA " .. f.number, font = "font.ttf", size = 12, at = { 2, 20 } } } }]],
  drawings = [[
return celspan.rostrum { back = "#fff", celspan.cel { assert(require "celspan.svg".read
  "drawing.svg").object } }]],
}

local DRAWING = [[<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
  viewBox="0 0 40 30">
<style>.a { fill: #f80 }</style><defs><linearGradient id="g"><stop offset="0" stop-color="red"/>
  <stop offset="1"
stop-color="blue"/></linearGradient><mask id="m"><circle cx="12" cy="9" r="9" fill="#fff"/><path
  d="M20 20h9"
stroke="#888" stroke-width="4"/></mask></defs><rect class="a" x="2" y="2" width="30" height="20"
  mask="url(#m)"/>
<path d="M5 20C10 10 20 30 35 15" stroke="url(#g)" stroke-width="3" fill="none"/><use
  xlink:href="#c" x="3"/>
<circle id="c" cx="20" cy="20" r="5"/></svg>]]

local function sweep_art(scene, lasts)
  if not present.type() then return pending "there is no type module" end
  bench:write("font.ttf", system.read "scripts/type/block.ttf")
  bench:write("drawing.svg", DRAWING)
  sweep(art[scene], "png", lasts)
end

--- A painting whose colours are converted by a table, which another process makes.
local PAINTING = [[
local cels = assert(require "celspan.layers".read "painting.psd"):cels()
cels.back = "#fff"
return celspan.rostrum(cels)]]

local function sweep_profile(lasts)
  if not present.colour() then return pending "it was built without Little CMS" end
  local ink = { name = "ink", x = 3, y = 5, w = 30, h = 20 }
  function ink.pixel(x, y) return 8 * x, 9 * y, 99, 255 end
  bench:write("painting.psd", paintings.psd { w = 40, h = 30, layers = { ink },
    profile = paintings.profile { curve = 1.5 } })
  sweep(PAINTING, "png", lasts)
end

local function sweep_info(lasts)
  if not present.type() then return pending "there is no type module" end
  bench:write("drawing.svg", DRAWING)
  local code, right = starve({ at = 0 }, "drawing.svg", "info ")
  assert.are.equal(0, code)
  for _, plan in ipairs(plans(lasts, math.ceil(SAMPLES / 6))) do
    local ended, out, err = starve(plan, "drawing.svg", "info ")
    local is_told = ended == 0 and out == right or ended == 33 and err:find "memory"
    assert.truthy(is_told or plan.may_die and ended > 128,
      ("allocation %d: %d, %s"):format(plan.at, ended, err))
  end
end

--- Each path that a render resolves is not resolved once. Returns how many there are.
local function sweep_paths(options)
  write_film(scenes.outlines)
  local render = RENDER:format(1):gsub("^render", "%0" .. options)
  local code, _, err = starve({ at = 0 }, "png", render)
  assert.are.equal(0, code, err)
  local right, count = frames "png", tonumber(bench:read("count"):match " (%d+)\n")
  for path = 1, count do check({ at = 0, path = path }, "png", right, render) end
  return count
end

--- The endings of copies that the program treats as lack of memory
--- (plugins/isolate/worker_loop.c): an exit code, or killed or trapped.
local STARVED = { [33] = true, [127] = true, [128 + 9] = true, [128 + 5] = true }

--- The hundred thousand allocations while OpenImageIO is loaded, in the range from first to last:
--- in copies of the process that loads it. A copy that ends in another way may have continued with
--- a partly loaded library, or have reported that it cannot be loaded: a run of its own checks
--- whether that was right, for at most `samples` of these. Returns how many were tried.
local function sweep_loading(first, last, lasts, right, samples)
  local others, tried = {}, 0
  repeat
    os.remove(bench.folder .. "/endings")
    starve({ at = first, last = last, lasts = lasts, level = 1 }, "exr")
    local before = first
    for number, code in (bench:read "endings" or ""):gmatch "(%d+) (%-?%d+)\n" do
      if not STARVED[tonumber(code)] then others[#others + 1] = tonumber(number) end
      first, tried = tonumber(number) + 1, tried + 1
    end
  until first == before or first > last
  for i = #others, 2, -1 do
    local k = random:whole(1, i)
    others[i], others[k] = others[k], others[i]
  end
  for i = 1, math.min(math.ceil(samples), #others) do
    check({ at = others[i], lasts = lasts, level = 1 }, "exr", right)
  end
  return tried
end

--- Tries some of these allocations at random.
local function sample_loading(lasts, right)
  local most, tried = 120000, 0
  while tried == 0 do
    local first = random:whole(1, most)
    tried = sweep_loading(first, first + LOADING_RUN, lasts, right, SAMPLES / 20)
    most = first
  end
end

--- The processes that write are killed before they can report the number of their allocations.
local function sweep_writers(lasts, right)
  local at, in_vain = 0, 0
  repeat
    at = at + 1
    in_vain = check({ at = at, lasts = lasts, forked = true }, "exr", right) == 0 and in_vain + 1
      or 0
  until in_vain == 100
end

--- Files written through OpenImageIO: the program, the process that loads it, and those that this
--- forks to write.
local function sweep_apart(lasts)
  write_film(scenes.outlines)
  local code, _, err = starve({ at = 0, level = 0 }, "exr")
  if code == 5 and err:find "built without OpenImageIO" then
    return pending "there is no picture module"
  end
  assert.are.equal(0, code, err)
  local right = frames "exr"
  for _, plan in ipairs(plans(lasts, math.ceil(SAMPLES / 6))) do
    plan.level = 0
    check(plan, "exr", right)
  end
  if ALL then
    assert.truthy(sweep_loading(1, 1e9, lasts, right, math.huge) > 1000)
    return sweep_writers(lasts, right)
  end
  sample_loading(lasts, right)
  for _ = 1, math.ceil(SAMPLES / 6) do
    check({ at = math.floor(10 ^ (3.2 * random:whole(0, 1000) / 1000)), lasts = lasts,
      forked = true }, "exr", right)
  end
end

--- Joining makes few allocations: each of them fails, or one in CELSPAN_FAULTS.
local function sweep_join(lasts)
  bench:write("film.lua", "local celspan, f = require 'celspan', { number = 1 }\n"
    .. scenes.outlines)
  for i = 1, 2 do
    local code, _, err =
      bench:shell(("cd '%s' && '%s' render film.lua --size 40x300 --strip %d/2 --progress none "
      .. "-o strips/%d.png"):format(bench.folder, bench.absolute, i, i))
    assert.are.equal(0, code, err)
  end
  assert.are.equal(0, (starve({ at = 0 }, "png", JOIN)))
  local right = frames "png"
  for at = random:whole(1, FAULTS), (counts()), FAULTS do
    check({ at = at, lasts = lasts }, "png", right, JOIN)
  end
end

local function has_library() return system.read(LIBRARY) ~= nil end

--- Runs once with one allocation failing, once with all after it too.
local function both(name, work)
  for _, lasts in ipairs { false, true } do
    it((lasts and "for good, " or "for once, ") .. name, function()
      if not has_library() then return pending(NO_LIBRARY) end
      return work(lasts)
    end)
  end
end

describe("without memory #plain", function()
  both("strips are joined, or the failure is reported", sweep_join)
  it("every path is resolved, or its failure is reported", function()
    if not has_library() then return pending(NO_LIBRARY) end
    assert.truthy(sweep_paths "" > 2)
    assert.truthy(sweep_paths " --strict" > 2)
  end)
  both("a drawing is described, or the failure is reported", sweep_info)
  for scene in pairs(art) do
    both(scene .. " are right", function(lasts) return sweep_art(scene, lasts) end)
  end
  both("paintings with a colour profile are right", sweep_profile)
  both("files by OpenImageIO end well", sweep_apart)
  for scene, ending in pairs { outlines = "png", procedures = "span" } do
    both(scene .. " end well", function(lasts) return sweep(scenes[scene], ending, lasts) end)
  end
end)
