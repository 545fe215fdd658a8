--- The page of a run: lua5.4 tests/bench/report.lua FOLDER CELSPAN PAGE, from the top of the tree.
--- FOLDER holds bench.csv, and bench.txt, which says what the run was made on. Writes PAGE
--- (docs/bench.md), both files beside it, and its plots, drawn by CELSPAN, into pictures/ there.
--- FOLDER may be the page's own: the page is then made again from its own figures.
package.path = "./?.lua;" .. package.path
local films = require "tests.bench.report_film"
local machine = require "tests.bench.machine"
local more = require "tests.bench.report_more"
local Page = require "tests.bench.page"
local Runner = require "tests.bench.runner"
local shapes = require "tests.bench.report_shapes"

local folder, celspan, path = ...
assert(path, "usage: report.lua FOLDER CELSPAN PAGE")
local docs = path:match "^(.*)/[^/]*$"
local page = Page.new(folder, celspan, docs)

local function introduction()
  page:put [[
# How fast it is

For people who choose a renderer. `./run bench` measures everything and writes this page and [the
complete table](bench.csv); each table names the part that measures it alone. [This run](#this-run)
says on which machine.
]]
end

local function drawings_and_films()
  page:put [[
## Drawings and films beside other renderers

Antialiased, to 8-bit pixels, one thread. A figure says how many times faster celspan is than the
best of Skia, AGG, Qt and Cairo, which is named; below 1, the other is faster. Blend2D is not one of
the four; its published times, from another machine, are at 1k several times shorter than celspan's:
see the [plots](#scaling-with-size). 1k is 1024 pixels a side, 1M a million.
]]
  films.first(page)
  shapes.ratios(page)
  films.tables(page)
end

--- The least and the most of the load average while the rows were measured.
local function load_averages()
  local least, most = math.huge, -math.huge
  for _, row in ipairs(page.run.rows) do
    least, most = math.min(least, row.load or least), math.max(most, row.load or most)
  end
  return least <= most and ("%.1f to %.1f"):format(least, most) or ""
end

local function this_run()
  local lines = machine.read(folder .. "/bench.txt")
  lines[#lines + 1] = { "load average while measuring", load_averages() }
  page:section { title = "## This run", lines = lines, text = [[
- A figure is the median of several runs, in which the renderers of a line take turns.
- Jobs with one thread are given in processor time; files and jobs with several workers in time on
  the clock.
- celspan composes in linear light in floats; the others blend 8-bit values.
- `~`: only a part of the rows was drawn, and the time was scaled up.
- Blend2D is measured if `BLEND2D_ROOT` names its folder.
]], names = { "property", "value" } }
end

local function losses()
  page:put [[
## Where others are faster

Cairo, AGG, Qt and Skia were run with every drawing; Cairo in Python, Skia in Node, headless
Chromium and Synfig with whole films; OpenCV, libvips, OpenImageIO and ffmpeg with pictures and
files; rlottie, Skia's Skottie and ThorVG with Lottie files. In front of celspan are:

- *New drawings of many edges at 1k*: sheets of clip art and emoji, `mosquito`, `small`, `faint`,
  `100`. Exact areas need the order of the edges in each row and where they intersect; the others
  add the cover of one shape after another, and let errors of up to seven codes remain (`faint`). An
  edge that is in few pixels costs more than these pixels. At 4k `small` and `faint` are left, at
  30k none.
- *Gradients in shapes that share pixels*, up to 4k for 100 of them, beside Qt: linear light is
  converted for each pixel of a gradient.
- *Lottie files*, beside rlottie, which adds 8-bit values; Skottie and ThorVG take longer.
- *A picture over a picture*, beside Qt, AGG and Cairo: four floats a pixel in place of four bytes.
- *Many groups with modes and blurs* at 1920, beside Skia, but not at 3840: blurs are of floats in
  linear light.
- *Defocus of a small radius*, beside OpenCV and libvips, which blur bytes that are there already.
- *A clip under a title*, beside ffmpeg, which leaves the pixels of the clip as they are coded.
]]
end

introduction()
more.beside(page)
drawings_and_films()
shapes.scaling(page)
shapes.memory(page)
shapes.exactness(page)
more.pictures(page)
more.files(page)
more.paper(page)
losses()
this_run()

page:write(path)
if folder ~= docs then
  assert(os.execute(Runner.command("cp", folder .. "/bench.csv", folder .. "/bench.txt", docs)))
end
