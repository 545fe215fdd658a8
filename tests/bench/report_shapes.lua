--- The parts of the page about drawings: celspan compared with the peers. Each function adds to a
--- page (page.lua) and leaves out figures that were not measured.
local targets = require "tests.bench.targets.list"
local published = require "tests.bench.published"
local results = require "tests.bench.results"
local scenes = require "tests.bench.scenes"

local report = {}
local seconds, time = results.seconds, targets.time

local short = { [1024] = "1k", [2048] = "2k", [4096] = "4k", [30000] = "30k", [100000] = "100k",
                [1000000] = "1M" }
local pixel_sides = { 1024, 2048, 4096, 30000 }

local function shown(row)
  if not row then return "" end
  return results.mark(row) .. time(seconds(row))
end

local function count(value) return value and ("%.3g million"):format(value / 1e6) or "" end

-- ---------------------------------------------------------------- ratios

--- "1.2 AGG", and Blend2D's ratio if it was measured.
local function ratio_cell(run, scene, side)
  local mine = run:pixel_row(scene, side, "celspan", "area")
  local best, name = run:best_peer(scene, side)
  if not (mine and best) then return "" end
  local cell = ("%s%.2f %s"):format(mine.is_over and "under " or "", best / seconds(mine), name)
  local blend2d = run:pixel_row(scene, side, "blend2d", "area")
  return blend2d and ("%s, %.2f Blend2D"):format(cell, seconds(blend2d) / seconds(mine)) or cell
end

local function ratio_lines(page, names)
  for _, scene in ipairs(names) do
    local line, is_measured = { scene }, false
    for _, side in ipairs(pixel_sides) do
      line[#line + 1] = ratio_cell(page.run, scene, side)
      is_measured = is_measured or line[#line] ~= ""
    end
    if is_measured then page:cells(line) end
  end
end

--- Every drawing compared with the best of the peers.
function report.ratios(page)
  page:put [[
Drawings to pixels, antialiased, one thread: the time of the fastest of Skia, AGG, Qt and Cairo
divided by celspan's, and its name. Above 1, celspan is the fastest.
]]
  page:head { "drawing", "1k", "2k", "4k", "30k" }
  for _, names in ipairs { scenes.artwork, scenes.random, scenes.hard, scenes.gradients } do
    ratio_lines(page, names)
  end
  page:put ""
end

-- ---------------------------------------------------------------- tables of drawings

--- One drawing at one side.
local function pixel_line(run, scene, side, mine)
  local known = (published.shapes[scene] or {})[side]
  local again = run:pixel_row(scene, side, "celspan", "again")
  local line = { scene, short[side], shown(mine), shown(run:pixel_row(scene, side, "celspan",
                 "swept")), shown(again), count(mine.instructions),
                 shown(run:pixel_row(scene, side, "blend2d", "area")),
                 known and time(known) or "" }
  for _, peer in ipairs(results.peers) do
    line[#line + 1] = shown(run:pixel_row(scene, side, peer[1], "area"))
  end
  line[#line + 1] = shown(run:pixel_row(scene, side, "fill of runs"))
  line[#line + 1] = shown(run:pixel_row(scene, side, "memset"))
  line[#line + 1] = known and ("%.2g times"):format(known / mine.best_processor) or ""
  local yardstick = targets.by_yardstick(run, scene, side)
  line[#line + 1] = yardstick and ("%.2g times"):format(yardstick) or ""
  local best = run:best_peer(scene, side)
  line[#line + 1] = best and ("%.2g times"):format(best / seconds(mine)) or ""
  return line
end

--- The table of drawings to pixels.
local function pixel_table(page, names)
  page:head { "drawing", "side", "celspan", "celspan, swept", "celspan, later frame",
              "instructions", "Blend2D", "Blend2D, published", "Skia", "AGG", "Qt", "Cairo",
              "fill of the runs", "memset",
              "ahead of Blend2D, published", "estimated from AGG", "ahead of the best peer" }
  for _, scene in ipairs(names) do
    for _, side in ipairs(pixel_sides) do
      local mine = page.run:pixel_row(scene, side, "celspan", "area")
      if mine then page:cells(pixel_line(page.run, scene, side, mine)) end
    end
  end
  page:put ""
end

local function power(run, wanted, sides)
  local exponent = run:exponent(wanted, sides)
  return exponent and ("%.2f"):format(exponent) or ""
end

--- The power of the side with which the time grows.
local function exponent_table(page, names)
  page:head { "drawing", "spans `none`, 4k to 1M", "spans `area`, 4k to 1M",
              "pixels `area`, 4k to 30k", "Skia", "AGG", "Qt", "Cairo" }
  for _, scene in ipairs(names) do
    local line = { scene }
    for _, antialias in ipairs { "none", "area" } do
      line[#line + 1] = power(page.run, { part = "shapes", scene = scene, output = "spans",
        antialias = antialias, renderer = "celspan" }, { 4096, 30000, 100000, 1000000 })
    end
    for _, name in ipairs { "celspan", "skia", "agg", "qt", "cairo" } do
      line[#line + 1] = power(page.run, { part = "shapes", scene = scene, output = "row",
        antialias = "area", renderer = name }, { 4096, 30000 })
    end
    page:cells(line)
  end
  page:put ""
end

local function span_line(row)
  return { row.scene, short[row.side], row.antialias, shown(row), count(row.instructions),
           ("%.0f"):format(row.spans), ("%.0f"):format(row.colours),
           ("%.1f"):format(1e9 * seconds(row) / row.spans),
           ("%.1f"):format(1e9 * seconds(row) / row.crossings),
           ("%.1f MiB"):format(row.peak_kib / 1024) }
end

local function span_table(page, names)
  page:head { "drawing", "side", "antialiasing", "time", "instructions", "spans",
              "colours composed", "ns per span", "ns per crossing", "peak memory" }
  for _, scene in ipairs(names) do
    for _, antialias in ipairs { "none", "area" } do
      for _, side in ipairs { 1024, 2048, 4096, 30000, 100000, 1000000 } do
        local row = page.run:one { part = "shapes", scene = scene, side = side, output = "spans",
                                   antialias = antialias, renderer = "celspan" }
        if row and row.spans then page:cells(span_line(row)) end
      end
    end
  end
  page:put ""
end

--- A title, words and the table of these drawings to pixels.
local function section(page, title, text, names)
  page:put("### ", title)
  page:put ""
  page:put(text)
  pixel_table(page, names)
end

--- The random shapes, the hard scenes, and artwork.
function report.tables(page)
  page:put "## Random shapes"
  page:put ""
  page:put [[
10, 100 and 1000 closed B-splines of random colour and alpha, antialiased, to pixels. *Ahead of*:
the other renderer's time divided by celspan's; below 1, the other renderer is faster. *Later
frame*: the drawing again in a film, where at least 64 shapes are drawn from their
[map](how-it-works.md#maps). *Swept*: without maps, whatever the rule says.]]
  page:plot("ratios", "ratios")
  for _, scene in ipairs(scenes.random) do page:plot("shapes-" .. scene, "shapes", scene) end
  pixel_table(page, scenes.random)
  page:put "### To spans"
  page:put ""
  page:put [[
A crossing is an edge that meets a row, whether it is hidden or not.
]]
  span_table(page, scenes.random)
  page:put "The time grows with this power of the side: 1 is linear, 2 is quadratic."
  page:put ""
  exponent_table(page, scenes.random)
  section(page, "Hard for spans", [[
`opaque`: the 1000 shapes without transparency. `small`: 10,000 shapes of a twentieth of the side.
`faint`: the 1000 shapes at alpha 0.02 to 0.08, so that about 60 layers are visible at each point.
]], scenes.hard)
  section(page, "Gradients", [[
The 100 and the 1000 shapes, each with a linear gradient from the left to the right of its box,
between its colour and another of the same alpha. All renderers blend coded values. celspan computes
the gradient in floats, as one span where nothing covers it; AGG and Qt use tables of 256 and 1024
colours.
]], scenes.gradients)
  section(page, "Artwork", [[
Drawings as filled paths, mostly opaque. Of the sample material: `mosquito`, `skaters` and `boating`
with 155 to 159 paths each; sheets of about 64 drawings each, `clipart` (2053 paths), `emoji` (983)
and `twemoji` (426). Drawn by code: `house` (220 paths).
]], scenes.artwork)
end

-- ---------------------------------------------------------------- whole images, agreement

function report.whole_images(page)
  if #page.run:all { part = "shapes", output = "whole" } == 0 then return end
  page:put "### Whole images, and without antialiasing"
  page:put ""
  page:head { "drawing", "side", "antialiasing", "to", "celspan", "Blend2D", "Skia", "AGG", "Qt",
              "Cairo" }
  for _, kind in ipairs { { "whole", "area" }, { "row", "none" } } do
    for _, scene in ipairs { "100", "1000" } do
      local line = { scene, "4k", kind[2], kind[1] == "whole" and "a whole image" or "pixels" }
      for _, name in ipairs { "celspan", "blend2d", "skia", "agg", "qt", "cairo" } do
        line[#line + 1] = shown(page.run:one { part = "shapes", scene = scene, side = 4096,
          output = kind[1], antialias = kind[2], renderer = name })
      end
      page:cells(line)
    end
  end
  page:put ""
end

function report.agreement(page)
  local rows = page.run:all { part = "agreement" }
  if #rows == 0 then return end
  page:put "## Do all renderers draw the same?"
  page:put ""
  page:put [[
Each drawing once at 1024 pixels per side, averaged over cells of 16 x 16 pixels: the root of the
mean square of the difference from celspan's picture, in units of 1/255. For this comparison celspan
blends coded values, as the others do. Cairo and Skia drop fractions of a value at each of 60 faint
layers.
]]
  page:head { "drawing", "Blend2D", "Skia", "AGG", "Qt", "Cairo" }
  local done = {}
  for _, row in ipairs(rows) do
    if not done[row.scene] then
      done[row.scene] = true
      local line = { row.scene }
      for _, name in ipairs { "blend2d", "skia", "agg", "qt", "cairo" } do
        local one = page.run:one { part = "agreement", scene = row.scene, renderer = name }
        line[#line + 1] = one and ("%.2f"):format(one.rms) or ""
      end
      page:cells(line)
    end
  end
  page:put ""
end

return report
