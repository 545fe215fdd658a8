--- Plane files beside the frames that they replace: made, drawn at two sizes, a tile of them, and
--- the page that shows them.
local Command = require("tests.bench.runner").command
local scenes = require "tests.bench.scenes"

local parts = {}

local function path_of(folder, scene) return ("%s/%s.txt"):format(folder, scene) end

local function plane(runner, folder, scene, side, kind)
  return { part = "planes", scene = scene, side = side, output = kind, renderer = "celspan",
           workers = 1, command = Command(runner:program "celspan", "plane",
             path_of(folder, scene), side, kind) }
end

local function frame(runner, folder, scene, side)
  return { part = "planes", scene = scene, side = side, output = "frame", renderer = "celspan",
           workers = 1, command = Command(runner:program "celspan", "shapes",
             path_of(folder, scene), side, "area", "row", 1) }
end

--- The page with a drawing, of which its decoder draws 1920 x 1080 pixels in Node.
local function page(runner, folder, scene)
  local file, html = folder .. "/bench.plane", folder .. "/plane.html"
  assert(os.execute(Command(runner:program "celspan", "plane", path_of(folder, scene), 0, file)
    .. " >/dev/null"))
  if not os.execute(Command(runner.celspan, "plane", file, "-o", html) .. " 2>/dev/null") then
    return runner:note "celspan was built without the page of planes: it is left out"
  end
  runner:measure(3, { { part = "planes", scene = scene, side = 1920, output = "page",
                        renderer = "celspan", workers = 1,
                        command = Command("node", "tests/bench/plane.js", html, 1920, 1080) } })
end

--- The frame of 4096 pixels is measured beside the making, which has no size.
function parts.planes(runner, folder, is_quick)
  local list = { "10", "100", "1000", table.unpack(runner.has_material and scenes.sheets or {}) }
  for _, scene in ipairs(is_quick and { "1000" } or list) do
    runner:measure(3, { frame(runner, folder, scene, 4096),
                        plane(runner, folder, scene, 4096, "make") })
    for _, side in ipairs(is_quick and { 1024 } or { 1024, 30000 }) do
      runner:measure(3, { frame(runner, folder, scene, side),
                          plane(runner, folder, scene, side, "draw") })
    end
    runner:measure(3, { plane(runner, folder, scene, 1024, "tile"),
                        plane(runner, folder, scene, 1000000, "tile") })
    page(runner, folder, scene)
  end
end

return parts
