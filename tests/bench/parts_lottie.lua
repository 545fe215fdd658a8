--- The heavy Lottie animations of the material beside other renderers of Lottie.
local Command = require("tests.bench.runner").command
local present = require "tests.support.present"

local parts = {}

local FRAMES = 24

--- The rows of speed.tsv: files with their sizes at 512 and at 1080.
local function files()
  local list, folder = {}, present.material .. "/lottie-airbnb/"
  for line in io.lines(folder .. "speed.tsv") do
    local file, small, large = line:match "^(%S+%.json)\t.-\t(%d+x%d+)\t.-\t(%d+x%d+)\t"
    if file then
      list[#list + 1] = { name = file:gsub("%.json$", ""), path = folder .. file,
                          [512] = small, [1080] = large }
    end
  end
  return list
end

--- The command that each renderer draws a file with, by its name.
local function commands(runner, file, side)
  local width, height = file[side]:match "(%d+)x(%d+)"
  local function command(...)
    return Command(...) .. " " .. Command(file.path, width, height, FRAMES)
  end
  local list = { { "celspan", command("lua5.4", "tests/bench/lottie_frames.lua") } }
  if runner:has "rlottie" then list[2] = { "rlottie", command(runner:program "rlottie") } end
  for _, peer in ipairs(runner.modules and { "skottie", "thorvg" } or {}) do
    list[#list + 1] = { peer, command("node", "tests/bench/lottie.js", runner.modules, peer) }
  end
  return list
end

local function geometric_mean(list)
  local sum = 0
  for _, value in ipairs(list) do sum = sum + math.log(value) end
  return math.exp(sum / #list)
end

--- Prints the geometric mean of each renderer's times, and how it compares with celspan's.
local function summarize(runner, first, side)
  local times, names = {}, {}
  for i = first, #runner.rows do
    local row = runner.rows[i]
    if row.side == side then
      if not times[row.renderer] then
        times[row.renderer], names[#names + 1] = {}, row.renderer
      end
      table.insert(times[row.renderer], row.processor)
    end
  end
  for _, name in ipairs(names) do
    local mean = geometric_mean(times[name])
    print(("   %4d: %-8s %8.2f ms a frame, of %d files, %.2f of celspan's"):format(side, name,
      1e3 * mean, #times[name], mean / geometric_mean(times.celspan)))
  end
end

function parts.lottie(runner, _, is_quick)
  if not present.material then return runner:note "lottie: the material is missing: left out" end
  local first = #runner.rows + 1
  for _, side in ipairs { 512, 1080 } do
    for _, file in ipairs(files()) do
      local entries = {}
      for i, one in ipairs(commands(runner, file, side)) do
        entries[i] = { part = "lottie", scene = file.name, side = side, output = "frame",
                       renderer = one[1], workers = 1, command = one[2] }
      end
      runner:measure(is_quick and 1 or 3, entries)
    end
    summarize(runner, first, side)
  end
end

return parts
