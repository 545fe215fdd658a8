--- Films: what a frame costs, to raw pixels, where all frames are drawn in order.
---
---   film   the film of film.h with sheets of artwork, beside the peers, in one process each: the
---          paths, and the objects of celspan, are made before
---   raw    whole processes, from the script to raw pixels: the demo film, scripts/film.lua, sheets
---          of SVG files (scripts/sheet.lua), and nine painted layers (scripts/painted.lua), these
---          beside OpenCV
local Command = require("tests.bench.runner").command
local scenes = require "tests.bench.scenes"
local shapes = require "tests.bench.parts_shapes"
local present = require "tests.support.present"

--- sheet_frames: the frames of a film of SVG files.
local parts = { sheet_frames = 9 }

-- ---------------------------------------------------------------- drawings

--- The words that every program has after its verb: the drawings, the side, and which frames are
--- drawn, one in `step`.
local function film_words(folder, film, side, step)
  local words = { side, step }
  for i = 2, 4 do table.insert(words, i - 1, ("%s/%s.txt"):format(folder, film[i])) end
  return words
end

local function entry(film, side, output, antialias, renderer, command)
  return { part = "film", scene = film[1], side = side, output = output, antialias = antialias,
           renderer = renderer, workers = 1, command = command }
end

local function sheet_point(runner, folder, film, side, step)
  local words, entries = film_words(folder, film, side, step), {}
  local celspan = Command(runner:program "celspan", "film", table.unpack(words))
  for i, kind in ipairs { { "again", "row" }, { "again", "whole" }, { "first", "row" } } do
    entries[i] = entry(film, side, kind[2], kind[1], "celspan",
      celspan .. " " .. Command(table.unpack(kind)))
  end
  for _, name in ipairs(shapes.peers(runner)) do
    local program = name == "skia" and runner.skia or Command(runner:program(name))
    entries[#entries + 1] = entry(film, side, "whole", "area", name,
      program .. " " .. Command("film", table.unpack(words)))
  end
  local first = #runner.rows + 1
  runner:repeat_all((step > 1 or side > 2048) and 2 or 3, entries)
  runner:compare(first)
end

local function drawings(runner, folder, is_quick)
  if not runner.has_material then
    return runner:note "no CELSPAN_MATERIAL: the films of artwork are left out"
  end
  for _, film in ipairs(scenes.films) do
    for _, side in ipairs { 1024, 2048, 4096 } do
      sheet_point(runner, folder, film, side, is_quick and 12 or 1)
    end
  end
end

-- ---------------------------------------------------------------- from the script to raw pixels

local size = "1280x720"

--- The cost of a process, shared among its frames.
function parts.per_frame(count)
  return function(lines)
    local line = lines[1]
    for _, key in ipairs { "wall", "best_wall", "processor", "best_processor" } do
      if not line[key] then return nil end
      line[key] = line[key] / count
    end
    return line
  end
end

--- An entry for a command that writes raw pixels, which go nowhere.
local function raw(runner, scene, count, renderer, command)
  return { part = "raw", scene = scene, side = 1280, output = "raw", renderer = renderer,
           workers = 1, take = parts.per_frame(count),
           command = Command(runner:program "launch", "all", "sh", "-c",
             "exec " .. command .. " >/dev/null") }
end

--- celspan with a script, which may have arguments.
local function render(runner, pixels, script, first, last, ...)
  return Command(runner.celspan, "render", script, "--trust", "--size", pixels, "--workers", 1,
    "--progress", "none", "--frames", ("%d-%d"):format(first, last), "-o", "-", "--", ...)
end

--- Prints what the frame costs, from the finished scene to the last row.
local function show_statistics(runner, script, number, ...)
  print(("   frame %d of %s:"):format(number, script))
  io.stdout:flush()
  os.execute(Command(runner.celspan, "spans", script, "--trust", "--size", size, "--workers", 1,
    "--frame", number, "--stats", "--pixels", 8, "--", ...))
end

local function script_film(runner, scene, script, count, rounds)
  runner:repeat_all(rounds, { raw(runner, scene, count, "celspan",
    render(runner, size, script, 1, count)) })
  show_statistics(runner, script, count // 2)
end

-- ---------------------------------------------------------------- SVG files

--- Two processes, of one frame and of several: the difference is what later frames cost.
local function sheet_of_files(runner, scene, folder, side, rounds)
  local script, entries = "tests/bench/scripts/sheet.lua", {}
  for i, count in ipairs { 1, parts.sheet_frames } do
    entries[i] = raw(runner, scene, 1, "celspan", render(runner, ("%dx%d"):format(side, side),
      script, 1, count, present.material .. "/" .. folder, parts.sheet_frames))
    entries[i].side, entries[i].antialias = side, count == 1 and "first" or "all"
  end
  runner:repeat_all(rounds, entries)
end

local function files(runner, is_quick)
  if not runner.has_material then return end
  for _, sheet in ipairs(scenes.files) do
    for _, side in ipairs(is_quick and { 1024 } or { 1024, 2048 }) do
      sheet_of_files(runner, sheet[1], sheet[2], side, is_quick and 1 or 3)
    end
  end
end

-- ---------------------------------------------------------------- painted layers

local layer_count, frame_count = 9, 48

--- The layers as PNG files with alpha, from the top of the tree, whose path is `root`.
function parts.write_layers(celspan, root, folder, pixels)
  os.execute(Command("mkdir", "-p", folder))
  os.execute(Command("cp", "tests/bench/scripts/painted_layer.lua", folder))
  os.execute(Command("ln", "-sfn", root .. "/scripts/demo", folder .. "/demo"))
  for i = 1, layer_count do
    assert(os.execute("CELSPAN_PATH='scripts/?.lua' " .. Command(celspan, "render",
      folder .. "/painted_layer.lua", "--trust", "--size", pixels, "--progress", "none", "-o",
      ("%s/%d.png"):format(folder, i), "--", i)))
  end
end

local function bytes_of(command)
  local pipe = assert(io.popen(command))
  local bytes = pipe:read "a"
  pipe:close()
  return bytes
end

--- The root of the mean square of the difference between two raw frames, of 255.
function parts.difference(a, b)
  assert(#a == #b and #a > 0, "the frames differ in size")
  local sum = 0
  for i = 1, #a do
    local difference = a:byte(i) - b:byte(i)
    sum = sum + difference * difference
  end
  return math.sqrt(sum / #a)
end

local function painted(runner, folder, rounds)
  local layers = runner.root .. "/" .. folder .. "/painted"
  parts.write_layers(runner.celspan, runner.root, layers, "1600x900")
  local script, program = "tests/bench/scripts/painted.lua", runner:program "opencv"
  local entries = { raw(runner, "painted", frame_count, "celspan",
    render(runner, size, script, 1, frame_count, layers)) }
  if runner:has "opencv" then
    entries[2] = raw(runner, "painted", frame_count, "opencv",
      Command(program, "layers", layers, 1, frame_count))
  else runner:note "OpenCV is not installed: it is left out" end
  runner:repeat_all(rounds, entries)
  local last = runner.rows[#runner.rows]
  if last.renderer == "opencv" then -- it blends codes, so celspan's picture is one of codes, too
    last.rms = parts.difference(bytes_of(render(runner, size, script, 40, 40, layers, "srgb")),
      bytes_of(Command(program, "layers", layers, 40, 40)))
  end
  show_statistics(runner, script, frame_count // 2, layers)
  os.execute(Command("rm", "-r", layers))
end

function parts.film(runner, folder, is_quick)
  drawings(runner, folder, is_quick)
  if is_quick then
    runner:note "a quick run: 4 of the 48 frames of the sheets, and 48 of scripts/film.lua"
  end
  script_film(runner, "demo", "scripts/demo.lua", 240, is_quick and 1 or 3)
  script_film(runner, "film", "scripts/film.lua", is_quick and 48 or 708, is_quick and 1 or 3)
  files(runner, is_quick)
  painted(runner, folder, is_quick and 1 or 3)
end

return parts
