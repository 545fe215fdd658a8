--- The parts of the page about films: what a drawing costs in a film, and the tables of films,
--- which `./run bench film` prints. Each function adds to a page (page.lua) and leaves out figures
--- that were not measured. Times of films are the least of several runs.
local targets = require "tests.bench.targets.list"
local frames = require "tests.bench.parts_frames"
local results = require "tests.bench.results"
local scenes = require "tests.bench.scenes"

local report = {}

local sides = { 1024, 4096 } -- the complete table has more
local short = { [1024] = "1k", [4096] = "4k" }

local function shown(row) return row and targets.time(row.best_processor) or "" end

local function times(value) return value and ("%.2f times"):format(value) or "" end

-- ---------------------------------------------------------------- the first table

--- "1.2 AGG", and Blend2D's ratio if it was measured.
local function ratio(mine, best, name, blend2d)
  if not (mine and best) then return "" end
  local cell = ("%.2f %s"):format(best / mine, name)
  return blend2d and ("%s, %.2f Blend2D"):format(cell, blend2d / mine) or cell
end

local function film_ratio(run, scene, side)
  local best, name = run:best_film_peer(scene, side)
  return ratio(run:film_seconds(scene, side, "celspan", "again"), best, name,
    run:film_seconds(scene, side, "blend2d", "area"))
end

--- antialias: "first" in the film's first frame with the drawing, "again" in a later one.
local function drawing_ratio(run, scene, side, antialias)
  local best, name = run:best_peer(scene, side)
  local function of(renderer, kind)
    return results.seconds(run:pixel_row(scene, side, renderer, kind))
  end
  return ratio(of("celspan", antialias), best, name, of("blend2d", "area"))
end

--- What a film costs, a drawing again and a new one, compared with the best of the peers.
function report.first(page)
  local lines = {}
  for _, scene in ipairs(scenes.backs) do
    for _, side in ipairs(sides) do
      lines[#lines + 1] = { scene, short[side], film_ratio(page.run, scene, side),
                            drawing_ratio(page.run, scene, side, "again"),
                            drawing_ratio(page.run, scene, side, "first") }
    end
  end
  page:section { fixed = 2, lines = lines, text = [[
A drawing in a film costs less after its first frame. *A film's frame*: the [film](#films) of a
drawing and of two others in front of it. *A drawing again*: it alone, in a later frame. *A new
drawing*: it alone, in the first frame that shows it (`./run bench film artwork`).
]], names = { "drawing", "side", "a film's frame", "a drawing again", "a new drawing" } }
end

-- ---------------------------------------------------------------- films of drawings

--- How far the peers' pictures are from celspan's, at most.
local function greatest_difference(run, scene, side)
  local most
  for _, row in ipairs(run:all { part = "film", scene = scene, side = side }) do
    if row.rms then most = math.max(most or 0, row.rms) end
  end
  return most and ("%.2f of 255"):format(most) or ""
end

local function film_line(run, scene, side, mine)
  local line = { scene, short[side], shown(mine),
                 shown(run:film_row(scene, side, "celspan", "again", "whole")),
                 shown(run:film_row(scene, side, "blend2d", "area")) }
  for _, peer in ipairs(results.peers) do
    line[#line + 1] = shown(run:film_row(scene, side, peer[1], "area"))
  end
  local blend2d = run:film_seconds(scene, side, "blend2d", "area")
  line[#line + 1] = times(blend2d and blend2d / mine.best_processor)
  line[#line + 1] = greatest_difference(run, scene, side)
  return line
end

local function drawings(page)
  local lines = {}
  for _, film in ipairs(scenes.films) do
    for _, side in ipairs(sides) do
      local mine = page.run:film_row(film[1], side, "celspan", "again")
      lines[#lines + 1] = mine and film_line(page.run, film[1], side, mine)
    end
  end
  page:section { fixed = 2, lines = lines, text = [[
Processor time for each of 48 frames, the least of several showings. The film shows a sheet of
drawings, or `house`, under a pan and a zoom, with `skaters` and `mosquito` in front of it; `three
sheets` shows `emoji` and `twemoji` in front of `clipart`. The others build their paths once, and
fill a whole picture in each frame; celspan writes a row that is reused, or a *whole picture*.
*Differ by*: the others' pictures from celspan's, at most, in means of 64 x 64 cells.
]], names = { "film", "side", "celspan", "whole picture", "Blend2D", "Skia", "AGG", "Qt", "Cairo",
              "ahead of Blend2D", "differ by" } }
end

-- ---------------------------------------------------------------- from the script to raw pixels

local names = { demo = "the demo film", film = "`scripts/film.lua`",
                painted = "nine painted layers" }

local function raw(page)
  local lines = {}
  for _, scene in ipairs { "demo", "film", "painted" } do
    local mine = page.run:one { part = "raw", scene = scene, renderer = "celspan" }
    local other = page.run:one { part = "raw", scene = scene, renderer = "opencv" }
    lines[#lines + 1] = mine and { names[scene], shown(mine), shown(other),
      times(other and other.best_processor / mine.best_processor),
      other and other.rms and ("%.2f of 255"):format(other.rms) or "" }
  end
  page:section { lines = lines, text = [[
From the script to raw pixels at 1280 x 720: processor time of the whole process for each frame. Of
the nine painted layers four are blurred; OpenCV warps, blurs and blends the same files.
]], names = { "film", "celspan", "OpenCV", "ahead of OpenCV", "differs by" } }
end

--- The seconds of one of the later frames of a film of SVG files.
function report.later_frame(run, scene, side)
  local function of(kind)
    local row = run:one { part = "raw", scene = scene, side = side, antialias = kind }
    return row and row.best_processor
  end
  local first, all = of "first", of "all"
  return first and all and (all - first) / (frames.sheet_frames - 1)
end

local function files(page)
  local lines = {}
  for _, sheet in ipairs(scenes.files) do
    for _, side in ipairs(sides) do
      local later = report.later_frame(page.run, sheet[1], side)
      lines[#lines + 1] = later and { sheet[1], short[side], targets.time(later) }
    end
  end
  page:section { fixed = 2, lines = lines, text = [[
A sheet of 64 SVG files under a pan, from the script to raw pixels:
]], names = { "files", "side", "a later frame" } }
end

function report.tables(page)
  if #page.run:all { part = "film" } + #page.run:all { part = "raw" } == 0 then return end
  page:put "### Films"
  page:put ""
  drawings(page)
  files(page)
  raw(page)
end

return report
