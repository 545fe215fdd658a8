--- The parts of the page about what else a film needs: pictures, softness, groups, files, workers;
--- and what people would pick instead. Each function adds to a page (page.lua) and leaves out
--- figures that were not measured.
local targets = require "tests.bench.targets.list"
local results = require "tests.bench.results"

local report = {}
local time = targets.time

local function wall(row) return results.mark(row) .. time(row.wall) end

-- ---------------------------------------------------------------- what people would pick instead

--- One film, made by each program as a user would make it.
function report.beside(page)
  local lines = {}
  for i, row in ipairs(page.run:all { part = "beside" }) do
    lines[i] = { row.renderer, ("%.1f"):format(tonumber(row.scene:match "%d+") / row.wall),
                 ("%.1f s"):format(row.processor), ("%.0f MiB"):format(row.peak_kib / 1024),
                 row.lines and ("%d"):format(row.lines) or "" }
  end
  page:section { title = "## Beside what people would pick instead", lines = lines, text = [[
A film of 6 seconds, 1280 x 720, 25 frames a second, to PNG files: a gradient behind 30 moving
discs with gradients, a title, and a drawing from an SVG file. Each script of
[tests/bench/beside](../tests/bench/beside) is what a user would write first, with as many threads
as the program likes. *Processor* is that of all its processes, *memory* the peak of the largest
(`./run bench beside`).
]], names = { "program", "frames a second", "processor", "memory", "lines" } }
end

-- ---------------------------------------------------------------- pictures and softness

--- Columns of renderers: { name, renderer }, ...
local function columns_of(list, output)
  local columns = { { "celspan", { renderer = "celspan", output = output } } }
  for _, one in ipairs(list) do
    columns[#columns + 1] = { one[1], { renderer = one[2], output = "whole" } }
  end
  return columns
end

local function raster(page)
  local columns, lines = columns_of({ { "AGG", "agg" }, { "Cairo", "cairo" }, { "Qt", "qt" },
    { "Skia", "skia" }, { "libvips", "vips" }, { "OpenImageIO", "oiio" } }, "whole"), {}
  for i, scene in ipairs { "affine", "perspective", "shift" } do
    lines[i] = page:line({ scene }, { part = "raster", scene = scene }, columns, wall)
  end
  page:section { title = "### A picture over a picture", lines = lines, text = [[
A picture of 2048 x 1536 with a soft matte over one of 3840 x 2160, bilinear (`./run bench raster`).
]], names = page.names({ "job" }, columns) }
end

local function defocus(page)
  local columns, lines = columns_of({ { "OpenCV", "opencv" }, { "libvips", "vips" } }, "row"), {}
  for _, art in ipairs { "100", "figure 11" } do
    for _, radius in ipairs { 5, 50, 500 } do
      lines[#lines + 1] = page:line({ art == "100" and "100 shapes" or "three bands of colour",
        tostring(radius) }, { part = "defocus", scene = ("%s radius %d"):format(art, radius),
        antialias = "gaussian" }, columns, wall)
    end
  end
  page:section { title = "### Defocus", fixed = 2, lines = lines, text = [[
A frame of 4096 x 4096; the others blur the pixels of the sharp frame with the same Gaussian
(`./run bench defocus figure11`). `over`: stopped at this limit.
]], names = page.names({ "frame", "radius" }, columns) }
  if page.run:one { part = "defocus" } then
    page:plot("defocus", "time against radius", "defocus")
  end
end

local function groups(page)
  local columns, lines = columns_of({ { "Skia", "skia" } }, "row"), {}
  columns[2][2].output = "row"
  for _, job in ipairs { { "flat", "200 shapes before 60, flat" },
      { "group", "in an isolated group at half opacity" }, { "multiply", "with a blend mode" },
      { "matte circle", "in a soft matte" }, { "shadow", "a disc with a soft shadow" },
      { "groups", "60 groups with modes and blurs" } } do
    for _, side in ipairs { 1920, 3840 } do
      lines[#lines + 1] = page:line({ job[2], tostring(side) }, { part = "compositing",
        scene = job[1], side = side }, columns, wall)
    end
  end
  page:section { title = "### Groups, modes, mattes and effects", fixed = 2, lines = lines,
    text = [[
One frame, without the script (`./run bench compositing`).
]], names = page.names({ "frame", "width" }, columns) }
end

--- What else a frame is made of.
function report.pictures(page)
  page:put "## Pictures, softness and groups\n"
  raster(page)
  defocus(page)
  groups(page)
end

-- ---------------------------------------------------------------- files and workers

--- { what is measured, the fields of its row }.
local jobs = {
  { "100 shapes, 4k, to PNG", { part = "files", side = 4096, output = "png", antialias = "area",
                                workers = 1 } },
  { "100 shapes, 30k, to PNG", { part = "files", side = 30000, output = "png", antialias = "area",
                                 workers = 1 } },
  { "100 shapes, 1M, to a span file", { part = "files", side = 1000000, antialias = "area" } },
  { "4096 x 4096 out of that file", { part = "cut", scene = "100", output = "cut of 4096" } },
  { "a frame of the demo film, 3840 x 2160, to PNG", { part = "film png", output = "png" } },
  { "the demo film, 3840 x 2160, to PNG, one worker", { part = "demo", workers = 1 } },
  { "the same, two workers", { part = "demo", workers = 2 } },
  { "a small script, to its first row", { part = "start", scene = "small" } },
}

--- The time of a row; of a film, its frames a second.
local function speed(row)
  if row.part ~= "demo" then return wall(row) end
  return ("%.3g frames a second"):format(tonumber(row.scene:match "%d+") / row.wall)
end

--- The time until a file is written, or until something is seen.
function report.files(page)
  local columns, lines = { { "celspan", { renderer = "celspan" } } }, {}
  for _, name in ipairs { "OpenImageIO level 1", "OpenImageIO level 6", "OpenImageIO default",
                          "ffmpeg" } do
    columns[#columns + 1] = { name, { renderer = name } }
  end
  for i, job in ipairs(jobs) do
    lines[i] = page:line({ job[1] }, job[2], columns, speed)
  end
  page:section { title = "## Files", lines = lines, text = [[
Time on the clock, with the rendering (`./run bench png span cut film_png demo start`). OpenImageIO
gets celspan's pixels, and only its writing is timed. ffmpeg lays PNG files of the cels over each
other.

The first picture of a run takes longer: with OpenImageIO of Debian 12, a PNG file of 1920 x 1080
takes 0.26 s of processor time, and 0.1 s in ffmpeg. OpenImageIO's 280 libraries are loaded once a
run, for 0.12 s or 495 million instructions. They are opened one by one, each after those that it
needs: loaded at once they take 0.24 s or 1,075 million, because each looks up its names in all.
]], names = page.names({ "job" }, columns) }
end

-- ---------------------------------------------------------------- the paper

--- The plots that docs/paper.md shows.
function report.paper(page)
  if not page.run:one { part = "figure14" } then return end
  page:put "## The paper's figures\n"
  page:put [[
Figure 13: 10 and 100 shapes to spans. Figure 14: drawn shapes in front of a photograph, as pictures
or as geometry (`./run bench shapes figure14`).]]
  page:plot("figure13", "time against side", "figure13")
  page:plot("figure14", "time against side", "figure14")
end

return report
