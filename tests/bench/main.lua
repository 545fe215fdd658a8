--- The benchmark: measures everything and writes a table. From the top of the tree:
---   lua5.4 tests/bench/main.lua BUILD FOLDER [--quick] [--skia MODULES] [PART...]
--- BUILD was configured with -Dbench=true; drawings, pictures and the table are written to FOLDER.
--- If parts are named, only those are measured.
package.path = "./?.lua;" .. package.path
local Runner = require "tests.bench.runner"
local scenes = require "tests.bench.scenes"
local machine = require "tests.bench.machine"
local Page = require "tests.bench.page"
local films = require "tests.bench.report_film"

local accuracy = require "tests.bench.parts_accuracy"
local beside = require "tests.bench.parts_beside"
local compositing = require "tests.bench.parts_compositing"
local files = require "tests.bench.parts_files"
local film = require "tests.bench.parts_film"
local everyday = require "tests.bench.parts_films"
local footage = require "tests.bench.parts_footage"
local frames = require "tests.bench.parts_frames"
local lottie = require "tests.bench.parts_lottie"
local lottie_out = require "tests.bench.parts_lottie_out"
local planes = require "tests.bench.parts_planes"
local pictures = require "tests.bench.parts_pictures"
local shapes = require "tests.bench.parts_shapes"

local parts = {
  { "accuracy", "how exact it is", accuracy.accuracy },
  { "agreement", "whether all draw the same picture", shapes.agreement },
  { "shapes", "10, 100 and 1000 random shapes", shapes.shapes },
  { "hard", "scenes that are hard for spans", shapes.hard },
  { "gradients", "the random shapes, each with a gradient", shapes.gradients },
  { "artwork", "real artwork", shapes.artwork },
  { "large", "to spans, a hundred thousand and a million pixels a side", shapes.large },
  { "whole", "whole images, and without antialiasing", shapes.whole },
  { "workers", "one worker and two", shapes.workers },
  { "png", "100 shapes to PNG", files.png },
  { "span", "100 shapes, a million pixels a side, to a span file", files.span_file },
  { "cut", "a cut out of the terapixel frame", files.cut },
  { "raster", "a picture over a picture", pictures.raster },
  { "figure14", "the paper's figure 14", pictures.figure14 },
  { "multiplane", "a frame of twelve painted planes", pictures.multiplane },
  { "defocus", "defocus of 100 shapes", pictures.defocus },
  { "figure11", "the paper's figure 11", pictures.figure11 },
  { "compositing", "groups, modes, mattes and effects", compositing.compositing },
  { "start", "from exec to the first row", film.start },
  { "film_png", "a frame of the demo film to PNG", film.film_png },
  { "demo", "the demo film to PNG", film.demo },
  { "footage", "a clip under a title, beside ffmpeg's overlay", footage.footage },
  { "film", "films, frame by frame", frames.film },
  { "films", "films as people make them, raw and to video", everyday.films },
  { "planes", "plane files beside frames", planes.planes },
  { "lottie", "heavy Lottie animations", lottie.lottie },
  { "lottie_out", "films as Lottie animations, in other players", lottie_out.lottie_out },
  { "beside", "one film, made by what people would pick instead", beside.beside },
}

local function read_arguments(words)
  local options = { build = words[1], folder = words[2], only = {} }
  assert(options.folder, "usage: main.lua BUILD FOLDER [--quick] [--skia MODULES] [PART...]")
  local i = 3
  while words[i] do
    if words[i] == "--quick" then options.is_quick = true
    elseif words[i] == "--skia" then
      i = i + 1
      options.skia = words[i]
    else options.only[words[i]] = true end
    i = i + 1
  end
  return options
end

--- A part that is misspelt would measure nothing.
local function check_names(wanted)
  local names = {}
  for i, part in ipairs(parts) do names[i] = part[1] end
  for name in pairs(wanted) do
    if not (" " .. table.concat(names, " ") .. " "):find(" " .. name .. " ", 1, true) then
      io.stderr:write(("no part '%s' of the benchmark; there are %s\n"):format(name,
        table.concat(names, ", ")))
      os.exit(2)
    end
  end
end

local options = read_arguments { ... }
check_names(options.only)
local runner = Runner.new { programs = options.build .. "/tests/bench",
                            seconds = options.is_quick and 0.05 or 0.2,
                            share = options.is_quick and 0 or 1 }
local pipe = assert(io.popen "pwd")
runner.root = pipe:read "l"
pipe:close()
runner.folder, runner.celspan = options.folder, options.build .. "/celspan"
runner.modules = options.skia
runner.skia = options.skia and Runner.command("node", "tests/bench/skia.js", options.skia)

runner.has_material = scenes.write(options.folder)
local began = os.time()
for _, part in ipairs(parts) do
  local name, title, run = table.unpack(part)
  if next(options.only) == nil or options.only[name] then
    print(("== %s (after %d s)"):format(title, os.time() - began))
    run(runner, options.folder, options.is_quick)
  end
end

if not runner:has_counter() then
  runner:note "this system has no instruction counter: that column of the table is empty"
end
local csv = options.folder .. "/bench.csv"
runner:write(csv)
local page = Page.new(options.folder)
films.tables(page)
print(table.concat(page.out, "\n"))
machine.write(options.folder .. "/bench.txt", { began = began, ended = os.time(),
  notes = runner.notes, has_material = runner.has_material,
  is_quick = options.is_quick })
print(("== %d measurements in %s, after %d seconds"):format(#runner.rows, csv, os.time() - began))
