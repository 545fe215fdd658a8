--- The parts of the page about drawings: celspan compared with the peers, and how time and memory
--- grow with the size. Each function adds to a page (page.lua) and leaves out figures that were not
--- measured.
local targets = require "tests.bench.targets.list"
local results = require "tests.bench.results"
local scenes = require "tests.bench.scenes"

local report = {}
local seconds, time = results.seconds, targets.time

local short = { [1024] = "1k", [4096] = "4k", [30000] = "30k", [100000] = "100k", [1000000] = "1M" }
local all_scenes = { scenes.artwork, scenes.random, scenes.hard, scenes.gradients }

local function shown(row) return results.mark(row) .. time(seconds(row)) end

local function mebibytes(row)
  return row.peak_kib and row.peak_kib > 0 and ("%.1f MiB"):format(row.peak_kib / 1024) or ""
end

--- A column for each renderer, whose rows have these fields.
local function renderers(antialias)
  local columns = { { "celspan", { renderer = "celspan", antialias = antialias } },
                    { "Blend2D", { renderer = "blend2d", antialias = antialias } } }
  for _, peer in ipairs(results.peers) do
    columns[#columns + 1] = { peer[2], { renderer = peer[1], antialias = antialias } }
  end
  return columns
end

-- ---------------------------------------------------------------- beside the peers

--- "1.2 AGG", and Blend2D's ratio if it was measured.
local function ratio_cell(run, scene, side)
  local mine = run:pixel_row(scene, side, "celspan", "area")
  local best, name = run:best_peer(scene, side)
  if not (mine and best) then return "" end
  local cell = ("%s%.2f %s"):format(mine.is_over and "under " or "", best / seconds(mine), name)
  local blend2d = run:pixel_row(scene, side, "blend2d", "area")
  return blend2d and ("%s, %.2f Blend2D"):format(cell, seconds(blend2d) / seconds(mine)) or cell
end

--- Every drawing compared with the best of the peers.
function report.ratios(page)
  local lines = {}
  for _, names in ipairs(all_scenes) do
    for _, scene in ipairs(names) do
      local line = { scene }
      for _, side in ipairs { 1024, 4096, 30000 } do
        line[#line + 1] = ratio_cell(page.run, scene, side)
      end
      lines[#lines + 1] = line
    end
  end
  page:section { lines = lines, text = [[
A drawing once, at three sizes (`./run bench artwork shapes hard gradients`):

- `mosquito`, `skaters`, `boating`: drawings of 155 to 159 paths. `clipart`, `emoji` and `twemoji`:
  sheets of about 64 drawings. `house`: 220 paths, drawn by code.
- `10`, `100`, `1000`: closed B-splines of random colour and alpha. `opaque`: the 1000, opaque.
  `small`: 10,000 of a twentieth of the side. `faint`: about 60 faint layers at each point.
]], names = { "drawing", "1k", "4k", "30k" } }
end

-- ---------------------------------------------------------------- size and memory

local function power(run, wanted, sides)
  local exponent = run:exponent(wanted, sides)
  return exponent and ("%.2f"):format(exponent) or ""
end

--- The power of the side with which the time grows.
local function exponents(page)
  local lines = {}
  for i, scene in ipairs(scenes.random) do
    local line = { scene, power(page.run, { part = "shapes", scene = scene, output = "spans",
      antialias = "area", renderer = "celspan" }, { 4096, 30000, 100000, 1000000 }) }
    for _, column in ipairs(renderers "area") do
      line[#line + 1] = power(page.run, { part = "shapes", scene = scene, output = "row",
        antialias = "area", renderer = column[2].renderer }, { 4096, 30000 })
    end
    lines[i] = line
  end
  page:section { lines = lines, text = [[
The time grows with this power of the side; 1 is linear, 2 is quadratic. To spans from 4k to 1M, to
pixels from 4k to 30k.
]], names = page.names({ "shapes", "celspan, spans" }, renderers()) }
end

--- How the time grows with the side.
function report.scaling(page)
  local lines, columns = {}, {}
  for i, side in ipairs { 1024, 4096, 30000, 100000, 1000000 } do
    columns[i] = { short[side], { side = side } }
  end
  for _, scene in ipairs(scenes.random) do
    lines[#lines + 1] = page:line({ scene }, { part = "shapes", scene = scene, output = "spans",
      antialias = "area", renderer = "celspan" }, columns, shown)
  end
  page:section { title = "## Scaling with size", lines = lines, text = [[
celspan's time to colour spans of 10, 100 and 1000 random shapes (`./run bench shapes large`).
]], names = page.names({ "shapes" }, columns) }
  exponents(page)
  page:put [[
In the plots, *Blend2D, published* are its best published times, on another machine; *fill of the
runs* is the time to write a picture's runs of one colour where they are known, a lower limit.
]]
  page:plot("ratios", "how many times celspan's time others take", "ratios")
  page:plot("shapes-100", "100 shapes: time against side", "shapes", "100")
end

--- The peak of memory, of whole processes.
function report.memory(page)
  local columns, lines = renderers(), {}
  local function add(name, wanted) lines[#lines + 1] = page:line({ name }, wanted, columns,
    mebibytes) end
  local function shapes(name, side, output)
    add("1000 shapes, " .. name, { part = "shapes", scene = "1000", side = side, output = output,
      antialias = "area" })
  end
  shapes("4k, to a reused row or band", 4096, "row")
  shapes("4k, a whole picture", 4096, "whole")
  shapes("30k, to a reused row or band", 30000, "row")
  shapes("1M, to spans", 1000000, "spans")
  add("the demo film to PNG, 3840 x 2160", { part = "demo", scene = "240 frames", workers = 1 })
  page:section { title = "## Memory", lines = lines, text = [[
The most memory of the whole process (`./run bench shapes large whole demo`). The others draw into a
band of 256 rows (64 at 30k) that is reused.
]], names = page.names({ "job" }, columns) }
end

-- ---------------------------------------------------------------- exactness

local function worst_of(run, scene)
  local worst, rms
  for _, row in ipairs(run:all { part = "accuracy", scene = scene }) do
    worst = math.max(worst or 0, row.worst)
    rms = row.rms and math.max(rms or 0, row.rms)
  end
  return worst and ("%.2f"):format(worst) or "", rms and ("%.3f"):format(rms) or ""
end

--- How far celspan is from the truth, and the others from celspan.
function report.exactness(page)
  local columns, lines = renderers(), {}
  table.remove(columns, 1)
  for _, names in ipairs(all_scenes) do
    for _, scene in ipairs(names) do
      lines[#lines + 1] = page:line({ scene, worst_of(page.run, scene) }, { part = "agreement",
        scene = scene }, columns, function(row) return ("%.2f"):format(row.rms) end)
    end
  end
  page:section { title = "## How exact it is", lines = lines, text = [[
*Worst* and *rms*: the error of celspan's worst pixel, and the root of the mean square over all
pixels, in linear light, in units of 1/255; the truth is the mean of 512 x 512 samples in each pixel
(`./run bench accuracy`). The other columns say how far other renderers' pictures are from celspan's
in means of 16 x 16 pixels, all blending coded values (`./run bench agreement`).
]], names = page.names({ "drawing", "worst", "rms" }, columns) }
  local leaks = {}
  for _, cover in ipairs { "fans", "bars" } do
    local row = page.run:one { part = "accuracy", scene = "abutting " .. cover }
    if row then leaks[#leaks + 1] = ("%d of %d pixels of %s"):format(row.leaking, row.pixels, cover)
    end
  end
  if #leaks == 0 then return end
  page:put("Where black shapes meet, the white behind them shows in ",
    table.concat(leaks, "\nand "), ".\n")
end

return report
