--- Files of a film: the demo film to PNG, compared with ffmpeg over the same layers; and the time
--- until the first row is available.
local Command = require("tests.bench.runner").command
local present = require "tests.support.present"

local parts = {}

local size = "3840x2160"

--- The cost of the whole process per frame.
local function render(runner, name, count, workers, ...)
  local words = { runner:program "launch", "all", runner.celspan, "render", "scripts/demo.lua",
    "--size", size, "--workers", workers, "--progress", "none", "--frames",
    ("1-240:%d"):format(240 // count), "-o", runner.folder .. "/film/demo.####.png" }
  table.move({ ... }, 1, select("#", ...), #words + 1, words)
  return { command = Command(table.unpack(words)), part = "demo", scene = count .. " frames",
           side = 3840, output = "png", renderer = name, workers = workers }
end

-- ---------------------------------------------------------------- ffmpeg

--- celspan with the script of the layers, which needs the film's own modules on its path.
local function layers(runner, verb, ...)
  return "CELSPAN_PATH='scripts/?.lua' " .. Command(runner.celspan, verb,
    runner.folder .. "/layers/layers.lua", "--trust", ...)
end

--- How many cels each exposure of the film has at its end.
local function layer_counts(runner)
  local pipe = assert(io.popen(layers(runner, "info") .. " 2>&1")) -- where a script prints
  local counts = {}
  for line in pipe:lines() do
    local count = line:match "^%d+\t(%d+)$"
    counts[#counts + 1] = tonumber(count)
  end
  pipe:close()
  return counts
end

local function write_layer(runner, exposure, cel, frames)
  local pattern = ("%s/layers/%d.%02d.####.png"):format(runner.folder, exposure, cel)
  assert(os.execute(layers(runner, "render", "--size", size, "--frames", frames, "--progress",
    "none", "-o", pattern, "--", exposure, cel)))
end

--- The first exposure's layers one over the other, the second's too, then their sum.
local function ffmpeg_command(runner, counts, first, last)
  local inputs, filters, number, sums = {}, {}, 0, {}
  for exposure, count in ipairs(counts) do
    local below
    for cel = 1, count do
      inputs[#inputs + 1] = ("-start_number %d -i '%s/layers/%d.%02d.%%04d.png'"):format(first,
        runner.folder, exposure, cel)
      local above = ("[%d:v]"):format(number)
      if below then
        local out = ("[e%dc%d]"):format(exposure, cel)
        filters[#filters + 1] = below .. above .. "overlay=format=rgb" .. out
        below = out
      else below = above end
      number = number + 1
    end
    sums[exposure] = below
  end
  if #sums == 2 then
    filters[#filters + 1] = sums[1] .. sums[2] .. "blend=all_mode=addition[whole]"
    sums[1] = "[whole]"
  end
  return ("ffmpeg -y -v error -threads 2 -filter_complex_threads 2 %s -filter_complex '%s'"
    .. " -map '%s' -frames:v %d '%s/film/ffmpeg.%%04d.png'"):format(table.concat(inputs, " "),
    table.concat(filters, ";"), sums[1], last - first + 1, runner.folder)
end

--- ffmpeg over the layers of the film's last frames, which show them all.
local function by_ffmpeg(runner, count)
  if not present.program "ffmpeg" then
    return runner:note "ffmpeg is not installed: its line of the film is left out"
  end
  local first, last = 240 - count + 1, 240
  os.execute(Command("mkdir", "-p", runner.folder .. "/layers"))
  os.execute(Command("cp", "tests/bench/scripts/layers.lua", runner.folder .. "/layers"))
  os.execute(Command("ln", "-sfn", runner.root .. "/scripts/demo", runner.folder .. "/layers/demo"))
  local counts = layer_counts(runner)
  for exposure, cels in ipairs(counts) do
    for cel = 1, cels do write_layer(runner, exposure, cel, ("%d-%d"):format(first, last)) end
  end
  local path = runner.folder .. "/ffmpeg.sh"
  local file = assert(io.open(path, "w"))
  file:write("exec ", ffmpeg_command(runner, counts, first, last), "\n")
  file:close()
  runner:measure(1, { { command = Command(runner:program "launch", "all", "sh", path),
    part = "demo", scene = count .. " frames", side = 3840, output = "png", renderer = "ffmpeg",
    workers = 2 } })
  os.execute(Command("rm", "-r", runner.folder .. "/layers"))
end

function parts.demo(runner, _, is_quick)
  local count = is_quick and 4 or 240
  os.execute(Command("mkdir", "-p", runner.folder .. "/film"))
  runner:measure(1, { render(runner, "celspan", count, 1), render(runner, "celspan", count, 2),
                      render(runner, "celspan keeping nothing", count, 2, "--memory", 0) })
  by_ffmpeg(runner, is_quick and 1 or 8)
  os.execute(Command("rm", "-r", runner.folder .. "/film"))
end

--- One frame of the film as PNG, and the same pixels written by OpenImageIO.
function parts.film_png(runner, folder)
  local png = folder .. "/frame.png"
  runner:measure(3, { { command = Command(runner:program "launch", "all", runner.celspan, "render",
    "scripts/demo.lua", "--size", size, "--workers", 1, "--progress", "none", "--frames", 236, "-o",
    png), part = "film png", scene = "frame 236", side = 3840, output = "png",
    renderer = "celspan", workers = 1 } })
  local row = runner.rows[#runner.rows]
  runner:measure(3, { { command = Command(runner:program "launch", "all", runner.celspan, "spans",
    "scripts/demo.lua", "--size", size, "--workers", 1, "--frame", 236, "--stats", "--pixels", 8),
    part = "film png", scene = "frame 236", side = 3840, output = "row", renderer = "celspan",
    workers = 1, take = function(lines)
      for _, told in ipairs(lines) do if told.wall then return told end end
    end } })
  local file = io.open(png, "rb")
  if file and row.part == "film png" then row.bytes = file:seek "end" end
  if file then file:close() end
  if not runner:has "oiio" then return end
  local other = folder .. "/oiio.png"
  runner:measure(2, { { command = Command(runner:program "oiio", "recode", png, 0, other),
    part = "film png", scene = "frame 236", side = 3840, output = "png",
    renderer = "OpenImageIO default", workers = 1 } })
  os.remove(other)
  os.remove(png)
end

function parts.start(runner)
  local entries = {}
  for _, name in ipairs { "tests/bench/scripts/small.lua", "scripts/demo.lua" } do
    entries[#entries + 1] = { command = Command(runner:program "launch", "first", runner.celspan,
      "render", name, "--frames", 1, "--progress", "none", "-o", "-"), part = "start",
      scene = name:match "(%w+)%.lua$", side = 1920, output = "first row", renderer = "celspan" }
  end
  runner:measure(15, entries)
end

return parts
