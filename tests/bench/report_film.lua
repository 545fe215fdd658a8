--- The parts of the page about films: the first table of the page, and the tables of films, which
--- `./run bench film` prints. Each function adds to a page (page.lua) and leaves out figures that
--- were not measured. Times of films are the least of several runs.
local targets = require "tests.bench.targets.list"
local frames = require "tests.bench.parts_frames"
local results = require "tests.bench.results"
local scenes = require "tests.bench.scenes"

local report = {}

local sides = { 1024, 2048, 4096 }
local short = { [1024] = "1k", [2048] = "2k", [4096] = "4k" }

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
  page:put [[
The time of the fastest of Skia, AGG, Qt and Cairo divided by celspan's, and its name; antialiased,
to 8-bit pixels, one thread. Above 1, celspan is the fastest.

- *A film's frame*: the [film](#films) of a sheet of drawings, or of the drawing `house`, and of two
  drawings in front of it.
- *A drawing again*: the sheet or `house` alone, in a later frame of a film that has shown it
  before.
- *A new drawing*: it alone, in the first frame of a film that shows it.
]]
  page:head { "drawing", "side", "a film's frame", "a drawing again", "a new drawing" }
  for _, scene in ipairs(scenes.backs) do
    for _, side in ipairs(sides) do
      local line = { scene, short[side], film_ratio(page.run, scene, side),
                     drawing_ratio(page.run, scene, side, "again"),
                     drawing_ratio(page.run, scene, side, "first") }
      if line[3] .. line[4] .. line[5] ~= "" then page:cells(line) end
    end
  end
  page:put ""
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
                 shown(run:film_row(scene, side, "celspan", "first")),
                 shown(run:film_row(scene, side, "blend2d", "area")) }
  for _, peer in ipairs(results.peers) do
    line[#line + 1] = shown(run:film_row(scene, side, peer[1], "area"))
  end
  local best, name = run:best_film_peer(scene, side)
  local blend2d = run:film_seconds(scene, side, "blend2d", "area")
  line[#line + 1] = times(blend2d and blend2d / mine.best_processor)
  line[#line + 1] = best and ("%s, %s"):format(times(best / mine.best_processor), name) or ""
  line[#line + 1] = greatest_difference(run, scene, side)
  return line
end

local function drawings(page)
  if #page.run:all { part = "film" } == 0 then return end
  page:put [[
48 frames of a sheet of drawings, or of `house`, under a pan and a zoom, with `skaters` and
`mosquito` in front of it, each on a way of its own; `three sheets`: `emoji` and `twemoji` in front
of `clipart`. The peers
build their paths once and fill them under a matrix in each frame, into a picture of the whole
frame; celspan moves its cels and writes pixels into a row that is reused, or into a *whole
picture*. *With its maps*: the film is shown for the first time, and its
[maps](how-it-works.md#maps) are made within this time; otherwise they are kept from a showing
before. Processor time for each frame, the least of several showings. *Differ by*: the peers'
pictures of the middle frame from celspan's, at most, in means of 64 x 64 cells.
]]
  page:head { "film", "side", "celspan", "whole picture", "with its maps", "Blend2D", "Skia", "AGG",
              "Qt", "Cairo", "ahead of Blend2D", "ahead of the best peer", "differ by" }
  for _, film in ipairs(scenes.films) do
    for _, side in ipairs(sides) do
      local mine = page.run:film_row(film[1], side, "celspan", "again")
      if mine then page:cells(film_line(page.run, film[1], side, mine)) end
    end
  end
  page:put ""
end

-- ---------------------------------------------------------------- from the script to raw pixels

local names = { demo = "the demo film", film = "`scripts/film.lua`",
                painted = "nine painted layers" }

local function raw(page)
  if #page.run:all { part = "raw" } == 0 then return end
  page:put [[
From the script to raw pixels at 1280 x 720, all frames in order: processor time of the whole
process for each frame, the least of several. The nine painted layers, four of them blurred, move
under a pan; OpenCV reads the same files and warps, blurs and blends codes in floats, while celspan
works in linear light. *Differs by*: frame 40, where celspan blends codes, too.
]]
  page:head { "film", "celspan", "OpenCV", "ahead of OpenCV", "differs by" }
  for _, scene in ipairs { "demo", "film", "painted" } do
    local mine = page.run:one { part = "raw", scene = scene, renderer = "celspan" }
    local other = page.run:one { part = "raw", scene = scene, renderer = "opencv" }
    if mine then
      page:cells { names[scene], shown(mine), shown(other),
                   times(other and other.best_processor / mine.best_processor),
                   other and other.rms and ("%.2f of 255"):format(other.rms) or "" }
    end
  end
  page:put ""
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
  if #lines == 0 then return end
  page:put [[
A sheet of 64 SVG files of the sample material with their gradients, strokes and groups, under a
pan: what a later frame costs, from the script to raw pixels.
]]
  page:head { "files", "side", "a later frame" }
  for _, line in ipairs(lines) do page:cells(line) end
  page:put ""
end

function report.tables(page)
  if #page.run:all { part = "film" } + #page.run:all { part = "raw" } == 0 then return end
  page:put "## Films"
  page:put ""
  drawings(page)
  files(page)
  raw(page)
end

return report
