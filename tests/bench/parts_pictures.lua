--- Pictures and softness: raster compositing, the paper's figure 14, a multiplane, defocus.
local Command = require("tests.bench.runner").command
local present = require "tests.support.present"

local parts = {}

local function first_file(...)
  for _, path in ipairs { ... } do
    local file = io.open(path)
    if file then
      file:close()
      return path
    end
  end
end

-- ---------------------------------------------------------------- raster jobs

local function raster(job, name, output, command)
  return { command = command, part = "raster", scene = job, side = 3840, output = output,
           renderer = name, workers = 1 }
end

function parts.raster(runner, folder)
  local make = runner:program "pictures"
  assert(os.execute(Command(make, folder)))
  for _, job in ipairs { "affine", "perspective", "shift" } do
    local entries = {}
    for _, output in ipairs { "row", "whole" } do
      entries[#entries + 1] = raster(job, "celspan", output,
        Command(runner:program "celspan", "picture", job, folder, output))
    end
    for _, name in ipairs { "agg", "cairo", "qt" } do
      if runner:has(name) and not (name == "cairo" and job == "perspective") then
        entries[#entries + 1] = raster(job, name, "whole",
          Command(runner:program(name), "picture", job))
      end
    end
    for _, name in ipairs { "vips", "oiio" } do
      if runner:has(name) then
        entries[#entries + 1] = raster(job, name, "whole",
          Command(runner:program(name), "picture", job))
      else runner:note(name .. " is not installed: it is left out") end
    end
    if runner.skia and job ~= "perspective" then
      entries[#entries + 1] = raster(job, "skia", "whole",
        runner.skia .. " " .. Command("picture", job, folder))
    end
    local first = #runner.rows + 1
    runner:measure(2, entries)
    runner:compare(first)
  end
end

-- ---------------------------------------------------------------- figure 14, planes

--- Drawn shapes, or a picture of them, over a picture of 1000 x 1000.
local function backed(runner, folder, what, sampling, side, output)
  local front = what == "pictures" and "/foreground.png" or "/clovers.txt"
  return { command = Command(runner:program "celspan", "backed", folder .. "/background.png",
             sampling, side, output, folder .. front), part = "figure14",
           scene = what .. " " .. sampling, side = side, output = output, renderer = "celspan",
           workers = 1, limit = 60 }
end

local function make_figure14(runner, folder)
  local material = present.material or ""
  local photo = first_file(material .. "/photo/kodim23.png", "scripts/pictures/village.png")
  local celspan = runner:program "celspan"
  assert(runner:ask(Command(celspan, "backed", photo, "bilinear", 1000, "file", "-",
    folder .. "/background.png")))
  assert(runner:ask(Command(celspan, "backed", "-", "bilinear", 1000, "file",
    folder .. "/clovers.txt", folder .. "/foreground.png")))
end

function parts.figure14(runner, folder, is_quick)
  make_figure14(runner, folder)
  for _, side in ipairs(is_quick and { 1000, 4000 } or { 1000, 4000, 10000, 30000 }) do
    local entries = {}
    for _, what in ipairs { "pictures", "geometry" } do
      for _, sampling in ipairs { "nearest", "bilinear" } do
        for _, output in ipairs(side > 10000 and { "spans" } or { "spans", "row" }) do
          entries[#entries + 1] = backed(runner, folder, what, sampling, side, output)
        end
      end
    end
    runner:measure(side > 4000 and 1 or 2, entries)
  end
end

function parts.multiplane(runner)
  runner:measure(3, { { command = Command(runner:program "celspan", "planes", "scripts/pictures",
    "row"), part = "multiplane", scene = "twelve planes", side = 3840, output = "row",
    renderer = "celspan", workers = 1 } })
end

-- ---------------------------------------------------------------- defocus

local side = 4096

local function soft(runner, folder, radius, kernel, output)
  return { command = Command(runner:program "celspan", "soft", folder .. "/100.txt", side, radius,
             kernel, output), part = "defocus", scene = "100 radius " .. radius, side = side,
           output = output, antialias = kernel, renderer = "celspan", workers = 1 }
end

--- The Gaussian blurs of pixels, beside: of the frame as vips reads it, and as raw bytes.
local function blurs(runner, sharp, raw, scene, radius, entries)
  local shared = { part = "defocus", scene = scene, side = side, output = "whole",
                   antialias = "gaussian", workers = 1 }
  local function add(name, is_part, ...)
    local entry = { renderer = name, is_part = is_part, limit = 60,
                    command = Command(runner:program(name), "blur", ...) }
    for key, value in pairs(shared) do entry[key] = value end
    entries[#entries + 1] = entry
  end
  local rows = radius <= 5 and side or radius <= 50 and 1024 or 128
  if runner:has "opencv" then add("opencv", rows < side and 1 or nil, raw, radius, rows)
  else runner:note "OpenCV is not installed: it is left out" end
  if runner:has "vips" then add("vips", nil, sharp, radius) end
end

--- The sharp frame as PNG and as raw RGBA.
local function sharp_frame(runner, folder, name, make)
  local png, raw = folder .. "/" .. name .. ".png", folder .. "/" .. name .. ".raw"
  make(png)
  assert(os.execute(("%s > '%s'"):format(Command(runner.celspan, "render",
    "tests/bench/scripts/picture.lua", "--trust", "--size", ("%dx%d"):format(side, side),
    "--progress", "none", "-o", "-", "--", png), raw)))
  return png, raw
end

function parts.defocus(runner, folder, is_quick)
  local here = runner.root .. "/" .. folder
  local png, raw = sharp_frame(runner, here, "sharp", function(out)
    assert(runner:ask(Command(runner:program "celspan", "shapes", folder .. "/100.txt", side,
      "area", "file", 1, out)))
  end)
  for _, radius in ipairs(is_quick and { 5 } or { 5, 50, 500 }) do
    local entries = {}
    for _, kernel in ipairs { "gaussian", "box", "disc" } do
      for _, output in ipairs(kernel == "gaussian" and { "spans", "row" } or { "row" }) do
        entries[#entries + 1] = soft(runner, folder, radius, kernel, output)
      end
    end
    blurs(runner, png, raw, "100 radius " .. radius, radius, entries)
    runner:measure(1, entries)
  end
end

--- The statistics of `celspan spans --stats` are its line; what the process took is the other.
local function stats_line(lines)
  local line = {}
  for _, told in ipairs(lines) do
    for key, value in pairs(told) do
      if key == "seconds" then line.wall, line.best_wall = value, value
      elseif key == "colour_evaluations" then line.colours = value
      elseif not line[key] then line[key] = value end
    end
  end
  return line
end

--- An entry that renders a script's frame inside one process.
local function script(runner, part, scene, output, size, name, ...)
  local pixels = output == "row" and { "--pixels", "8" } or {}
  local words = { runner:program "launch", "all", runner.celspan, "spans", "tests/bench/scripts/"
    .. name .. ".lua", "--trust", "--stats", "--workers", "1", "--size", size }
  table.move(pixels, 1, #pixels, #words + 1, words)
  words[#words + 1] = "--"
  table.move({ ... }, 1, select("#", ...), #words + 1, words)
  return { command = Command(table.unpack(words)), part = part, scene = scene, side = side,
           output = output, renderer = "celspan", workers = 1, take = stats_line, limit = 40 }
end

local function still(runner, name, out, size, ...)
  assert(os.execute(Command(runner.celspan, "render", "tests/bench/scripts/" .. name .. ".lua",
    "--trust", "--progress", "none", "--size", size, "-o", out, "--", ...)))
end

--- Figure 11: three bands, radius a tenth of the width; the film is 22 wide.
function parts.figure11(runner, folder, is_quick)
  local here = runner.root .. "/" .. folder
  local png, raw = sharp_frame(runner, here, "bands", function(out)
    still(runner, "figure11", out, ("%dx%d"):format(side, side), "0", "box")
  end)
  for _, radius in ipairs(is_quick and { 5 } or { 5, 50, 500 }) do
    local units, entries = tostring(radius * 22 / side), {}
    local scene = "figure 11 radius " .. radius
    for _, kernel in ipairs { "gaussian", "box" } do
      for _, output in ipairs { "spans", "row" } do
        local entry = script(runner, "defocus", scene, output, ("%dx%d"):format(side, side),
          "figure11", units, kernel)
        entry.antialias = kernel
        entries[#entries + 1] = entry
      end
    end
    blurs(runner, png, raw, scene, radius, entries)
    runner:measure(1, entries)
  end
end

return parts
