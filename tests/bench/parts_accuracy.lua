--- How exact celspan is: over all pixels of every drawing, and between shapes that abut.
local scenes = require "tests.bench.scenes"

local Command = require("tests.bench.runner").command
local parts = {}

local LONGEST = 120 -- seconds for one drawing

--- The promised bounds, in 255ths of linear light.
parts.promise = { worst = 2, rms = 0.1, leak = 0 }

local function add(runner, entry, line)
  entry.part, entry.output, entry.renderer = "accuracy", "row", "celspan"
  for _, key in ipairs { "worst", "rms", "over_two", "leaking", "pixels", "wall" } do
    entry[key] = line[key]
  end
  runner.rows[#runner.rows + 1] = entry
end

--- way: swept, or mapped.
local function judge(runner, folder, scene, side, k, way)
  local path = ("%s/%s.txt"):format(folder, scene)
  local lines, message = runner:ask(Command(runner:program "accuracy", "drawing", path, side, k,
    way), LONGEST)
  local line = lines and lines[1]
  if not line or line.is_over then
    return runner:note(("the accuracy of %s at %d: %s"):format(scene, side,
      message or ("not known after %d seconds"):format(LONGEST)))
  end
  add(runner, { scene = scene, side = side, antialias = way }, line)
  local is_kept = line.worst <= parts.promise.worst and line.rms <= parts.promise.rms
  print(("   %-14s %5d %-6s worst %6.3f at %d, %d   rms %.4f   %d pixels over 2%s"):format(scene,
    side, way, line.worst, line.at_x, line.at_y, line.rms, line.over_two,
    is_kept and "" or "   NOT AS PROMISED"))
end

local function leaks(runner, cover, rounds)
  local line = assert(runner:ask(Command(runner:program "accuracy", cover, rounds)))[1]
  add(runner, { scene = "abutting " .. cover, antialias = "area" }, line)
  print(("   %d frames of %s: %d of %d pixels leak, at most %g%s"):format(line.frames, cover,
    line.leaking, line.pixels, line.worst,
    line.worst <= parts.promise.leak and "" or "   NOT AS PROMISED"))
end

--- Every drawing at film sizes. Of 255: the worst pixel and the rms of all, in linear light.
function parts.accuracy(runner, folder, is_quick)
  for _, cover in ipairs { "fans", "bars" } do leaks(runner, cover, is_quick and 4 or 40) end
  local names = {}
  local lists = is_quick and { { "100" } }
    or { scenes.random, scenes.hard, scenes.gradients,
         runner.has_material and scenes.artwork or {} }
  for _, list in ipairs(lists) do table.move(list, 1, #list, #names + 1, names) end
  for _, scene in ipairs(names) do
    for _, side in ipairs(is_quick and { 1024 } or { 1024, 2048 }) do
      for _, way in ipairs { "swept", "mapped" } do
        judge(runner, folder, scene, side, is_quick and 128 or 512, way)
      end
    end
  end
end

return parts
