--- The page of a run: lua5.4 tests/bench/report.lua FOLDER CELSPAN PAGE, from the top of the tree.
--- FOLDER holds bench.csv and machine.txt. Writes PAGE (docs/bench.md), its table beside it as
--- bench.csv, and its plots into pictures/ beside it, drawn by CELSPAN.
package.path = "./?.lua;" .. package.path
local targets = require "tests.bench.targets.list"
local films = require "tests.bench.report_film"
local machine = require "tests.bench.machine"
local Page = require "tests.bench.page"
local results = require "tests.bench.results"
local Runner = require "tests.bench.runner"
local shapes = require "tests.bench.report_shapes"

local folder, celspan, path = ...
assert(path, "usage: report.lua FOLDER CELSPAN PAGE")
local docs = path:match "^(.*)/[^/]*$"
local page = Page.new(folder, celspan, docs)
local run, time = page.run, targets.time

-- ---------------------------------------------------------------- the page's head

local function introduction()
  page:put "# How fast it is"
  page:put ""
  page:put [[
`./run bench` measures everything in one run and writes this page, its pictures (drawn by celspan)
and [the complete table](bench.csv). `./run bench --quick` measures a few points in four minutes
and does not change this page; `./run bench shapes png` measures only these parts, and `./run bench
film` prints the tables of films.
]]
  films.first(page)
  shapes.ratios(page)
  page:put "## This run"
  page:put ""
  page:head { "property", "value" }
  for _, line in ipairs(machine.read(folder .. "/machine.txt")) do page:cells(line) end
  local least, most = math.huge, 0
  for _, row in ipairs(run.rows) do
    least, most = math.min(least, row.load or least), math.max(most, row.load or 0)
  end
  page:cells { "load average while measuring", ("%.1f to %.1f"):format(least, most) }
  page:put ""
  page:put [[
How to read the tables:

- Each figure is the median of several runs. The renderers of a line take turns, each in its own
  process, which repeats the job for at least a fifth of a second. Jobs with one thread are given in
  processor time, on which other programs have little influence; files, films to files and jobs with
  two workers in wall-clock time. The complete table has both, and the best time.
- *To spans*: rows of colour spans are made and discarded. *To pixels*: 8-bit sRGB pixels in one row
  of memory that is reused; the peers draw into a band of 256 rows (64 from 30,000 pixels on) that
  is reused. celspan composes in linear light in floats, the peers blend 8-bit values.
- `~`: only a part of the rows was drawn, and the time was scaled up. `over`: stopped at this limit.
- *Blend2D* is not in Debian. It is measured if `BLEND2D_ROOT` names a folder with its include/ and
  lib/. *Blend2D, published*: its best published time on the same kind of machine, compared with
  celspan's best time of this run; on any other machine this is only a rough comparison. *Estimated
  from AGG*: Blend2D's time is estimated as AGG's time of this run divided by the published ratio of
  the two, so that the machine and its load cancel out.
- *Instructions*: of celspan, in user space, from the processor's counter; empty if the system has
  no such counter, as on many virtual machines. The complete table also has those of the peers.
- *Fill of the runs* is the time to write the picture's runs of one colour if they are already
  known: a lower limit, with everything except the pixels for free.
]]
end

local function asked_and_measured()
  page:put "## Targets and results"
  page:put ""
  local lines = targets.lines(run)
  local met, missed = 0, 0
  for _, line in ipairs(lines) do
    if line.is_met then met = met + 1 elseif line.is_met == false then missed = missed + 1 end
  end
  page:put(("%d targets: %d met, %d not met, %d not measured in this run."):format(#lines, met,
    missed, #lines - met - missed))
  page:put ""
  page:head { "target", "measured", "met" }
  for _, line in ipairs(lines) do
    local is_met = line.is_met == nil and "" or line.is_met and "yes" or "**no**"
    page:cells { line.what, line.text, is_met }
  end
  page:put ""
end

-- ---------------------------------------------------------------- plain tables

--- The rows of a part without further computation: what, who, the time, and an optional column.
local function plain_table(part, title, text, more)
  local rows = run:all { part = part }
  if #rows == 0 then return end
  page:put("## ", title)
  page:put ""
  page:put(text)
  page:put ""
  page:head { "scene", "side", "output", "kind", "renderer", "workers", "wall time", "CPU time",
              "peak memory", table.unpack(more and { more.title } or {}) }
  for _, row in ipairs(rows) do
    page:cells { row.scene, row.side, row.output or "", row.antialias or "", row.renderer,
                 row.workers or "", results.mark(row) .. time(row.wall), time(row.processor),
                 row.peak_kib > 0 and ("%.1f MiB"):format(row.peak_kib / 1024) or "",
                 table.unpack(more and { more.of(row) } or {}) }
  end
  page:put ""
end

local function bytes_of(row)
  local text = row.bytes and ("%.0f bytes"):format(row.bytes) or ""
  if row.spans then
    text = ("%s, %.3g million spans per second"):format(text, row.spans / row.wall / 1e6)
  end
  return text
end

local function spans_of(row) return row.spans and ("%.0f"):format(row.spans) or "" end

local function rms_of(row) return row.rms and ("%.2f of 255"):format(row.rms) or "" end

local function rate_of(row) return ("%.2f"):format(tonumber(row.scene:match "%d+") / row.wall) end

local function accuracy()
  local rows = run:all { part = "accuracy" }
  if #rows == 0 then return end
  page:put "## How exact it is"
  page:put ""
  page:put [[
The antialiasing `area` compared with the mean of 512 x 512 samples in each pixel, in linear light,
in units of 1/255: the error of the worst pixel, the root of the mean square over all pixels, and
the number of pixels with an error above 2 (`./run bench accuracy`); of a sweep, and *again*, from
the map of the drawing where it has one. The abutting shapes are black,
fans of 3 to 64 wedges and up to 300 bars at random positions and angles; none of the white behind
them may be visible.
]]
  page:head { "drawing", "side", "way", "worst", "rms", "pixels over 2", "pixels that leak" }
  for _, row in ipairs(rows) do
    page:cells { row.scene, row.side or "", row.antialias or "", ("%.3g"):format(row.worst),
                 row.rms and ("%.3f"):format(row.rms) or "", row.over_two or "",
                 row.leaking and ("%d of %d"):format(row.leaking, row.pixels) or "" }
  end
  page:put ""
end

introduction()
asked_and_measured()
films.tables(page)
shapes.tables(page)
shapes.whole_images(page)
accuracy()
plain_table("workers", "One worker and two", "The same frame to pixels.")
plain_table("files", "Files", [[
A hundred shapes to files; OpenImageIO gets the same pixels, and only its writing is timed.]],
  { title = "bytes", of = bytes_of })
plain_table("cut", "Out of a terapixel frame", [[
A cut of 4096 x 4096 pixels from span files of 1,000,000 x 1,000,000 to PNG, of the 100 shapes and
of `scripts/terapixel.lua`, and the rendering of the latter file. Times of whole processes.]])
plain_table("film png", "A frame of the demo film", [[
celspan: the whole process, with script and rendering, to PNG and to pixels that are discarded;
OpenImageIO: only the writing of these pixels.]],
  { title = "bytes", of = bytes_of })
plain_table("raster", "A picture over a picture", [[
A picture of 3840 x 2160 pixels under one of 2048 x 1536 with a soft matte, which is turned by 7
degrees and scaled by 0.8, in perspective, or shifted by whole pixels; bilinear. celspan works in
linear light and in floats. Blend2D's published times: affine 8.8 ms, shift 1.8 ms.]],
  { title = "differs by", of = rms_of })
if run:one { part = "shapes", scene = "100", output = "spans" } then
  page:put "## The paper's figure 13"
  page:put ""
  page:put [[
10 and 100 NURBS shapes to spans. The paper's machine took 8.5 s at 30,000 pixels per side, and its
time was proportional to the side.]]
  page:plot("figure13", "figure13")
end
if run:one { part = "figure14" } then
  plain_table("figure14", "The paper's figure 14", [[
Drawn shapes in front of a photograph, both as pictures of 1000 x 1000 pixels, or the shapes as
geometry. The paper's machine took 2600 s for the pictures and half of that for the geometry at
30,000 pixels per side.]], { title = "spans", of = spans_of })
  page:plot("figure14", "figure14")
end
plain_table("multiplane", "Twelve painted planes",
  "Pictures, turned and clipped, under a multiplane camera.", { title = "spans", of = spans_of })
if run:one { part = "defocus" } then
  plain_table("defocus", "Defocus", [[
A hundred shapes, and the paper's figure 11 (three bands of colour), at 4096 x 4096, compared with
the pixels of the sharp frame, blurred by OpenCV and libvips with the same Gaussian (sigma is half
the radius).]], { title = "spans", of = spans_of })
  page:plot("defocus", "defocus")
end
plain_table("planes", "Plane files", [[
Drawings as planes ([the format](planefile.md)), which have no size: making one, beside a frame of
4096 x 4096; drawing all of it, beside a frame of that size; and a tile of 256 x 256 out of its
middle. The bytes are those of the file. Last, 1920 x 1080 pixels of it by the decoder of the page
that `celspan plane` writes, in Node, and the bytes of that decoder.]],
  { title = "bytes", of = bytes_of })
plain_table("compositing", "Groups, modes, mattes and effects", [[
200 shapes in front of 60 at 1920 x 1080: flat, in an isolated group at half opacity, with the mode
"multiply", in a film in "srgb", and in soft mattes, or under what is the matte; a disc with a soft
shadow of radius 16. Then 60 groups of twelve shapes, each with its opacity and one of the 16 modes,
a third of them blurred, in "srgb": Skia gets a canvas and a clip of the size of each group. Wall
time of one frame without the script, in both columns; the targets use the best. The flat drawing
becomes a map, which is made within this time; the drawing with a mode does not.]])
plain_table("start", "From exec to the first row", [[
Wall-clock time from the fork to the first byte of raw pixels on a pipe, frame 1 at 1920 x 1080.]])
plain_table("demo", "The demo film", [[
3840 x 2160 to PNG, in wall-clock time. ffmpeg gets each cel as a PNG file with alpha, lays one over
the other and adds the second exposure; it makes the last frames of the film, where all cels are
visible.]], { title = "frames per second", of = rate_of })
shapes.agreement(page)

page:write(path)
assert(os.execute(Runner.command("cp", folder .. "/bench.csv", docs .. "/bench.csv")))
