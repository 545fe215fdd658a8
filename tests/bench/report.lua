--- The page of a run: lua5.4 tests/bench/report.lua FOLDER CELSPAN PAGE, from the top of the tree.
--- FOLDER holds bench.csv and machine.txt. Writes PAGE (docs/bench.md), its table beside it as
--- bench.csv, and its plots into pictures/ beside it, drawn by CELSPAN.
package.path = "./?.lua;./lua/?.lua;" .. package.path
local asked = require "tests.bench.asked"
local machine = require "tests.bench.machine"
local Page = require "tests.bench.page"
local results = require "tests.bench.results"
local Runner = require "tests.bench.runner"
local shapes = require "tests.bench.report_shapes"

local folder, celspan, path = ...
assert(path, "usage: report.lua FOLDER CELSPAN PAGE")
local docs = path:match "^(.*)/[^/]*$"
local page = Page.new(folder, celspan, docs)
local run, time = page.run, asked.time

-- ---------------------------------------------------------------- the page's head

local function introduction()
  page:put "# How fast it is"
  page:put ""
  page:put [[
Made by `./run bench`, which measures all of this in one run and writes this page, its pictures
(drawn by celspan) and [the whole table](bench.csv). `./run bench --quick` measures a few points in
two minutes and writes nothing here; `./run bench shapes png` measures these parts alone.
]]
  shapes.ratios(page)
  page:put "## This run"
  page:put ""
  page:head { "of this run", "" }
  for _, line in ipairs(machine.read(folder .. "/machine.txt")) do page:cells(line) end
  local least, most = math.huge, 0
  for _, row in ipairs(run.rows) do
    least, most = math.min(least, row.load or least), math.max(most, row.load or 0)
  end
  page:cells { "load average while measuring", ("%.1f to %.1f"):format(least, most) }
  page:put ""
  page:put [[
Read the tables so:

- Each figure is the median of runs that took turns with all other renderers of its line, each in a
  process of its own, which repeats the job for at least a fifth of a second. One-threaded jobs are
  told in processor time, which other programs disturb little; files, films and jobs on two workers
  by the wall's clock. The table of the run has both, and the best.
- *To spans*: rows of colour spans are made and dropped. *To pixels*: 8-bit sRGB pixels in one row
  of memory that is used again; the peers draw into a band of 256 rows (64 from 30,000 pixels on)
  that is used again. celspan composes in linear light in floats, the peers blend 8-bit values.
- `~`: only a regular part of the rows was drawn, and the time scaled up. `over`: ended before it
  was done.
- *Blend2D* is in no Debian package. It is measured where `BLEND2D_ROOT` names a folder with its
  include/ and lib/. *Blend2D, published*: its best time on the same kind of machine, compared with
  celspan's best of this run; on any other machine it is a yardstick only. *By AGG's yardstick*:
  AGG's time of this run stands for Blend2D's, divided by how much faster Blend2D was where both
  were published, so that the machine and its load cancel out.
- *Instructions*: of celspan, in user space, by the processor's own counter; empty where the system
  lends none, as on many virtual machines. The table of the run has those of the peers too.
- *Fill of the runs* is what writing the picture's own runs of colour costs when they are known:
  what is left when everything but the pixels is free.
]]
end

local function asked_and_measured()
  page:put "## Asked and measured"
  page:put ""
  local lines = asked.lines(run)
  local met, missed = 0, 0
  for _, line in ipairs(lines) do
    if line.is_met then met = met + 1 elseif line.is_met == false then missed = missed + 1 end
  end
  page:put(("%d figures: %d met, %d not met, %d not measured in this run."):format(#lines, met,
    missed, #lines - met - missed))
  page:put ""
  page:head { "asked", "measured", "met" }
  for _, line in ipairs(lines) do
    local is_met = line.is_met == nil and "" or line.is_met and "yes" or "**no**"
    page:cells { line.what, line.told, is_met }
  end
  page:put ""
end

-- ---------------------------------------------------------------- parts as they are

--- Rows of a part as they are: what, who, the time, and what else.
local function plain_table(part, title, text, more)
  local rows = run:all { part = part }
  if #rows == 0 then return end
  page:put("## ", title)
  page:put ""
  page:put(text)
  page:put ""
  page:head { "what", "side", "to", "kind", "by", "workers", "time", "processor", "peak memory",
              table.unpack(more and { more.title } or {}) }
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
    text = ("%s, %.3g million spans a second"):format(text, row.spans / row.wall / 1e6)
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
Antialiasing by area against the mean of 512 x 512 pixel centres in each pixel, in linear light, of
255: the worst pixel, the root of the mean square over all pixels, and how many are more than 2 off;
`./run bench accuracy`. Between black shapes that abut, fans of 3 to 64 wedges and up to 300 bars at
random places and angles, nothing of the white behind them may be seen.
]]
  page:head { "drawing", "side", "worst", "rms", "pixels over 2", "pixels that leak" }
  for _, row in ipairs(rows) do
    page:cells { row.scene, row.side or "", ("%.3g"):format(row.worst),
                 row.rms and ("%.3f"):format(row.rms) or "", row.over_two or "",
                 row.leaking and ("%d of %d"):format(row.leaking, row.pixels) or "" }
  end
  page:put ""
end

introduction()
asked_and_measured()
shapes.tables(page)
shapes.whole_images(page)
accuracy()
plain_table("workers", "One worker and two", "The same frame to pixels.")
plain_table("files", "Files", [[
A hundred shapes into files; OpenImageIO is given the same pixels and only its writing is timed.]],
  { title = "bytes", of = bytes_of })
plain_table("cut", "Out of a terapixel frame", [[
A cut of 4096 x 4096 pixels to PNG out of span files of 1,000,000 x 1,000,000, of the 100 shapes and
of `scripts/terapixel.lua`; the making of the latter: whole processes.]])
plain_table("film png", "A frame of the demo film", [[
celspan: the whole process, with script and rendering, to PNG and to pixels that are dropped;
OpenImageIO: the writing of those pixels alone.]],
  { title = "bytes", of = bytes_of })
plain_table("raster", "A picture over a picture", [[
3840 x 2160 pixels, under a picture of 2048 x 1536 with a soft matte: turned by 7 degrees and shrunk
to 0.8, in perspective, and shifted by whole pixels; bilinear. celspan works in linear light and in
floats. Blend2D's published times: affine 8.8 ms, shift 1.8 ms.]],
  { title = "differs by", of = rms_of })
if run:one { part = "shapes", scene = "100", output = "spans" } then
  page:put "## The paper's figure 13"
  page:put ""
  page:put [[
10 and 100 NURBS shapes to spans. The paper's machine took 8.5 s at 30,000 pixels a side, and its
time followed the side.]]
  page:plot("figure13", "figure13")
end
if run:one { part = "figure14" } then
  plain_table("figure14", "The paper's figure 14", [[
Drawn shapes before a photograph, both as pictures of 1000 x 1000 pixels, or the shapes as geometry.
The paper's machine took 2600 s and half of that at 30,000.]], { title = "spans", of = spans_of })
  page:plot("figure14", "figure14")
end
plain_table("multiplane", "Twelve painted planes",
  "Pictures, turned and clipped, under a multiplane camera.", { title = "spans", of = spans_of })
if run:one { part = "defocus" } then
  plain_table("defocus", "Defocus", [[
A hundred shapes, and the paper's figure 11 (three bands of colour), at 4096 x 4096; beside them the
sharp frame's pixels, blurred by OpenCV and libvips with the same Gaussian (sigma is half the
radius).]], { title = "spans", of = spans_of })
  page:plot("defocus", "defocus")
end
plain_table("start", "From exec to the first row", [[
The wall's clock from the fork to the first byte of raw pixels on a pipe, frame 1 at 1920 x 1080.]])
plain_table("film", "The demo film", [[
3840 x 2160 to PNG, by the wall's clock. ffmpeg is given each cel as a PNG file with alpha, lays one
over the other and adds the second exposure; the film's last frames, where all cels are seen.]],
  { title = "frames a second", of = rate_of })
shapes.agreement(page)

page:write(path)
assert(os.execute(Runner.command("cp", folder .. "/bench.csv", docs .. "/bench.csv")))
