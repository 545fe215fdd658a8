--- The page of a run: lua5.4 tests/bench/report.lua FOLDER CELSPAN PAGE, from the top of the tree.
--- FOLDER holds bench.csv and machine.txt. Writes PAGE (docs/bench.md), its table beside it as
--- bench.csv, and its plots into pictures/ beside it, drawn by CELSPAN.
package.path = "./?.lua;" .. package.path
local asked = require "tests.bench.asked"
local machine = require "tests.bench.machine"
local published = require "tests.bench.published"
local results = require "tests.bench.results"
local Runner = require "tests.bench.runner"

local folder, celspan, page = ...
assert(page, "usage: report.lua FOLDER CELSPAN PAGE")
local docs = page:match "^(.*)/[^/]*$"
local run = results.read(folder .. "/bench.csv")
local out = {}

local function put(...) out[#out + 1] = table.concat { ... } end

local function cells(list) put("| ", table.concat(list, " | "), " |") end

local function head(list)
  cells(list)
  put("|", ("---|"):rep(#list))
end

local seconds, time = results.seconds, asked.time

local function shown(row)
  if not row then return "" end
  return results.mark(row) .. time(seconds(row))
end

local function plot(name, ...)
  local file = ("%s/pictures/bench-%s.png"):format(docs, name)
  assert(os.execute("CELSPAN_PATH='./?.lua' " .. Runner.command(celspan, "render",
    "tests/bench/scripts/plot.lua", "--progress", "none", "-o", file, "--", folder .. "/bench.csv",
    ...)))
  if out[#out] ~= "" then put "" end
  put("![](pictures/bench-", name, ".png)")
  put ""
end

-- ---------------------------------------------------------------- the page's head

local function introduction()
  put "# How fast it is"
  put ""
  put [[
Made by `./run bench`, which measures all of this in one run and writes this page, its pictures
(drawn by celspan) and [the whole table](bench.csv). `./run bench --quick` measures a few points in
two minutes and writes nothing here; `./run bench shapes png` measures these parts alone.
]]
  head { "of this run", "" }
  for _, line in ipairs(machine.read(folder .. "/machine.txt")) do cells(line) end
  local least, most = math.huge, 0
  for _, row in ipairs(run.rows) do
    least, most = math.min(least, row.load or least), math.max(most, row.load or 0)
  end
  cells { "load average while measuring", ("%.1f to %.1f"):format(least, most) }
  put ""
  put [[
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
- *Blend2D* is in no Debian package. Its column is its published best time on the same kind of
  machine, compared with celspan's best of this run; on any other machine it is a yardstick only.
  *By AGG's yardstick*: AGG's time of this run stands for Blend2D's, divided by how much faster
  Blend2D was where both were published, so that the machine and its load cancel out.
- *Fill of the runs* is what writing the picture's own runs of colour costs when they are known:
  what is left when everything but the pixels is free.
]]
end

local function asked_and_measured()
  put "## Asked and measured"
  put ""
  local lines = asked.lines(run)
  local met, missed = 0, 0
  for _, line in ipairs(lines) do
    if line.is_met then met = met + 1 elseif line.is_met == false then missed = missed + 1 end
  end
  put(("%d figures: %d met, %d not met, %d not measured in this run."):format(#lines, met, missed,
    #lines - met - missed))
  put ""
  head { "asked", "measured", "met" }
  for _, line in ipairs(lines) do
    cells { line.what, line.told, line.is_met == nil and "" or line.is_met and "yes" or "**no**" }
  end
  put ""
end

-- ---------------------------------------------------------------- shapes

local short = { [1024] = "1k", [4096] = "4k", [30000] = "30k", [100000] = "100k", [1000000] = "1M" }
local peers = { { "skia", "Skia" }, { "agg", "AGG" }, { "qt", "Qt" }, { "cairo", "Cairo" } }

local function pixel_row(scene, side, renderer, antialias)
  return run:one { part = "shapes", scene = scene, side = side, output = "row",
                   antialias = antialias, renderer = renderer }
end

--- The table of drawings to pixels.
local function pixel_table(names)
  head { "drawing", "side", "celspan", "Blend2D, published", "Skia", "AGG", "Qt", "Cairo",
         "fill of the runs", "memset", "ahead of Blend2D", "by AGG's yardstick",
         "ahead of the best here" }
  for _, scene in ipairs(names) do
    for _, side in ipairs { 1024, 4096, 30000 } do
      local mine = pixel_row(scene, side, "celspan", "area")
      if mine then
        local known = (published.shapes[scene] or {})[side]
        local line, best = { scene, short[side], shown(mine), known and time(known) or "" }, nil
        for _, peer in ipairs(peers) do
          local row = pixel_row(scene, side, peer[1], "area")
          line[#line + 1] = shown(row)
          if row then best = math.min(best or math.huge, seconds(row)) end
        end
        line[#line + 1] = shown(pixel_row(scene, side, "fill of runs"))
        line[#line + 1] = shown(pixel_row(scene, side, "memset"))
        line[#line + 1] = known and ("%.2g times"):format(known / mine.best_processor) or ""
        local yardstick = asked.by_yardstick(run, scene, side)
        line[#line + 1] = yardstick and ("%.2g times"):format(yardstick) or ""
        line[#line + 1] = best and ("%.2g times"):format(best / seconds(mine)) or ""
        cells(line)
      end
    end
  end
  put ""
end

local function power(wanted, sides)
  local exponent = run:exponent(wanted, sides)
  return exponent and ("%.2f"):format(exponent) or ""
end

--- By which power of the side the time grows.
local function exponent_table(names)
  head { "drawing", "spans `none`, 4k to 1M", "spans `area`, 4k to 1M", "pixels `area`, 4k to 30k",
         "Skia", "AGG", "Qt", "Cairo" }
  for _, scene in ipairs(names) do
    local line = { scene }
    for _, antialias in ipairs { "none", "area" } do
      line[#line + 1] = power({ part = "shapes", scene = scene, output = "spans",
        antialias = antialias, renderer = "celspan" }, { 4096, 30000, 100000, 1000000 })
    end
    for _, name in ipairs { "celspan", "skia", "agg", "qt", "cairo" } do
      line[#line + 1] = power({ part = "shapes", scene = scene, output = "row", antialias = "area",
        renderer = name }, { 4096, 30000 })
    end
    cells(line)
  end
  put ""
end

local function span_table(names)
  head { "drawing", "side", "antialiasing", "time", "spans", "colours composed", "ns a span",
         "ns a crossing", "peak memory" }
  for _, scene in ipairs(names) do
    for _, antialias in ipairs { "none", "area" } do
      for _, side in ipairs { 1024, 4096, 30000, 100000, 1000000 } do
        local row = run:one { part = "shapes", scene = scene, side = side, output = "spans",
                              antialias = antialias, renderer = "celspan" }
        if row then
          cells { scene, short[side], antialias, shown(row), ("%.0f"):format(row.spans),
                  ("%.0f"):format(row.colours), ("%.1f"):format(1e9 * seconds(row) / row.spans),
                  ("%.1f"):format(1e9 * seconds(row) / row.crossings),
                  ("%.1f MiB"):format(row.peak_kib / 1024) }
        end
      end
    end
  end
  put ""
end

local function shapes()
  put "## Random shapes"
  put ""
  put [[
10, 100 and 1000 closed B-splines of random colour and alpha, antialiased, to pixels. *Ahead*: how
many times celspan's time another takes; under 1 it is faster.]]
  plot("ratios", "ratios")
  for _, scene in ipairs { "10", "100", "1000" } do plot("shapes-" .. scene, "shapes", scene) end
  pixel_table { "10", "100", "1000" }
  put "### To spans"
  put ""
  put [[
A crossing is an edge that meets a row, whether or not it is hidden.
]]
  span_table { "10", "100", "1000" }
  put "The power of the side that the time follows: 1 is linear, 2 is square."
  put ""
  exponent_table { "10", "100", "1000" }
  put "### Hard for spans"
  put ""
  put [[
`opaque`: the 1000 shapes without transparency. `small`: 10,000 shapes of a twentieth of the side.
`faint`: the 1000 at alpha 0.02 to 0.08, where about 60 layers are seen at once.
]]
  pixel_table { "opaque", "small", "faint" }
  put "### Artwork"
  put ""
  put [[
Drawings of the material as filled paths, mostly opaque: `mosquito`, `skaters` and `boating` of 155
to 159 paths each; sheets of about 64 drawings each, `clipart` (2053 paths), `emoji` (983) and
`twemoji` (426).
]]
  pixel_table { "mosquito", "skaters", "boating", "clipart", "emoji", "twemoji" }
end

local function whole_images()
  local rows = run:all { part = "shapes", output = "whole" }
  if #rows == 0 then return end
  put "### Whole images, and without antialiasing"
  put ""
  head { "drawing", "side", "antialiasing", "to", "celspan", "Skia", "AGG", "Qt", "Cairo" }
  for _, kind in ipairs { { "whole", "area" }, { "row", "none" } } do
    for _, scene in ipairs { "100", "1000" } do
      local line = { scene, "4k", kind[2], kind[1] == "whole" and "a whole image" or "pixels" }
      for _, name in ipairs { "celspan", "skia", "agg", "qt", "cairo" } do
        line[#line + 1] = shown(run:one { part = "shapes", scene = scene, side = 4096,
          output = kind[1], antialias = kind[2], renderer = name })
      end
      cells(line)
    end
  end
  put ""
end

--- Rows of a part as they are: what, who, the time, and what else.
local function plain_table(part, title, text, more)
  local rows = run:all { part = part }
  if #rows == 0 then return end
  put("## ", title)
  put ""
  put(text)
  put ""
  head { "what", "side", "to", "kind", "by", "workers", "time", "processor", "peak memory",
         table.unpack(more and { more.title } or {}) }
  for _, row in ipairs(rows) do
    cells { row.scene, row.side, row.output or "", row.antialias or "", row.renderer,
            row.workers or "", results.mark(row) .. time(row.wall), time(row.processor),
            row.peak_kib > 0 and ("%.1f MiB"):format(row.peak_kib / 1024) or "",
            table.unpack(more and { more.of(row) } or {}) }
  end
  put ""
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

local function agreement()
  local rows = run:all { part = "agreement" }
  if #rows == 0 then return end
  put "## Do all draw the same?"
  put ""
  put [[
Each drawing once at 1024 pixels a side, in cells of 16 x 16 pixels: the root of the mean square of
how far they are from celspan's, of 255; for this celspan blends coded values as they are, as the
others do. Cairo and Skia drop fractions of a value at each of 60 faint layers.
]]
  head { "drawing", "Skia", "AGG", "Qt", "Cairo" }
  local done = {}
  for _, row in ipairs(rows) do
    if not done[row.scene] then
      done[row.scene] = true
      local line = { row.scene }
      for _, peer in ipairs(peers) do
        local one = run:one { part = "agreement", scene = row.scene, renderer = peer[1] }
        line[#line + 1] = one and ("%.2f"):format(one.rms) or ""
      end
      cells(line)
    end
  end
  put ""
end

introduction()
asked_and_measured()
shapes()
whole_images()
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
if run:one { part = "figure14" } then
  plain_table("figure14", "The paper's figure 14", [[
Drawn shapes before a photograph, both as pictures of 1000 x 1000 pixels, or the shapes as geometry.
The paper's machine took 2600 s and half of that at 30,000.]], { title = "spans", of = spans_of })
  plot("figure14", "figure14")
end
plain_table("multiplane", "Twelve painted planes",
  "Pictures, turned and clipped, under a multiplane camera.", { title = "spans", of = spans_of })
if run:one { part = "defocus" } then
  plain_table("defocus", "Defocus", [[
A hundred shapes, and the paper's figure 11 (three bands of colour), at 4096 x 4096; beside them the
sharp frame's pixels, blurred by OpenCV and libvips with the same Gaussian (sigma is half the
radius).]], { title = "spans", of = spans_of })
  plot("defocus", "defocus")
end
plain_table("start", "From exec to the first row", [[
The wall's clock from the fork to the first byte of raw pixels on a pipe, frame 1 at 1920 x 1080.]])
plain_table("film", "The demo film", [[
3840 x 2160 to PNG, by the wall's clock. ffmpeg is given each cel as a PNG file with alpha, lays one
over the other and adds the second exposure; the film's last frames, where all cels are seen.]],
  { title = "frames a second", of = rate_of })
agreement()

local file = assert(io.open(page, "w"))
file:write(table.concat(out, "\n"), "\n")
assert(file:close())
assert(os.execute(Runner.command("cp", folder .. "/bench.csv", docs .. "/bench.csv")))
