--- Groups, modes, mattes, spaces and effects beside the same drawing flat; 60 groups beside Skia.
--- All with one thread. celspan makes each frame in a new process, Skia repeats it in one.
local Command = require("tests.bench.runner").command

local parts = {}

local script = "tests/bench/scripts/compositing.lua"

--- The programs print only the seconds of the frame.
local function seconds(lines)
  for _, line in ipairs(lines) do
    if line.seconds then
      return { wall = line.seconds, best_wall = line.seconds, processor = line.seconds,
               best_processor = line.seconds }
    end
  end
end

local function entry(scene, side, renderer, command)
  return { part = "compositing", scene = scene, side = side, output = "row", renderer = renderer,
           workers = 1, command = command, take = seconds }
end

local function celspan(runner, scene, side)
  return entry(scene, side, "celspan", Command(runner.celspan, "spans", script, "--size",
    ("%dx%d"):format(side, side * 9 // 16), "--frame", 5, "--stats", "--pixels", 8, "--workers", 1,
    "--", scene))
end

function parts.compositing(runner)
  local entries = {}
  for i, scene in ipairs { "flat", "group", "multiply", "srgb", "under circle", "matte circle",
                            "under gradient", "matte gradient", "shadow" } do
    entries[i] = celspan(runner, scene, 1920)
  end
  runner:measure(9, entries)
  for _, side in ipairs { 1920, 3840 } do
    local both = { celspan(runner, "groups", side) }
    if runner.skia then
      both[2] = entry("groups", side, "skia", runner.skia:gsub("skia%.js", "skia_groups.js")
        .. " " .. Command(side, 4))
    end
    runner:measure(3, both)
  end
end

return parts
