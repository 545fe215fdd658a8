-- Very many boundaries on few pixels: time and memory for N, 4 N and 16 N of them.
--
--   LUA_CPATH=build/?.so lua5.4 tests/bench/dense.lua [N]
--
-- Each scene is rendered at 64 x 48 pixels by one worker in a process of its own, which reports its
-- processor time and its peak memory, including the script's values, Lua and the picture. N is
-- 62500 by default for squares and polygons, so that 16 N is a million; for the points of a curve
-- it is a tenth of that (100000 at most), for arcs that overlap and translucent lines a fiftieth
-- (20000 at most).
local celspan = require "celspan"
local WIDTH, HEIGHT = 64, 48
local unpack = table.unpack

local function numbers()
  local state = 12345
  return function()
    state = (state * 1103515245 + 12345) % 2147483648
    return state / 2147483648
  end
end

local scenes = {}

function scenes.squares(count, random)
  local objects = {}
  for i = 1, count do
    objects[i] = celspan.rect { WIDTH * random(), HEIGHT * random(), 3, 3,
      texture = celspan.rgb(random(), random(), random()) }
  end
  return objects
end

function scenes.polygon(count, random)
  local fields = { rule = "evenodd", texture = celspan.rgb(1, 0.5, 0.2) }
  for i = 1, count do fields[i] = { WIDTH * random(), HEIGHT * random() } end
  return { celspan.polygon(fields) }
end

function scenes.nurbs(count, random)
  local points = {}
  for i = 1, count do points[i] = { WIDTH * random(), HEIGHT * random() } end
  return { celspan.nurbs { points = points, rule = "evenodd", texture = celspan.rgb(0.2, 0.5, 1) } }
end

function scenes.arcs(count, random)
  local objects = {}
  for i = 1, count do
    local x, y, r = WIDTH * random(), HEIGHT * random(), 4 + 8 * random()
    objects[i] = celspan.path { texture = celspan.rgb(random(), random(), random(), 0.5),
      d = ("M %g %g A %g %g 0 1 1 %g %g Z"):format(x, y, r, r, x + r * random(), y + r * random()) }
  end
  return objects
end

function scenes.lines(count, random)
  local objects = {}
  for i = 1, count do
    local points = {}
    for k = 1, 4 do points[k] = { WIDTH * random(), HEIGHT * random() } end
    objects[i] = celspan.stroke { points = points, width = 0.2,
      texture = celspan.rgb(random(), random(), random(), 0.25) }
  end
  return objects
end

local kind, count = arg[1], tonumber(arg[2])
if scenes[kind] then
  local rostrum = celspan.rostrum { celspan.cel(scenes[kind](count, numbers())) }
  assert(celspan.pixels(rostrum, { size = { WIDTH, HEIGHT }, workers = 1 }))
  local status = assert(io.open "/proc/self/status")
  print(os.clock(), tonumber(status:read("a"):match "VmHWM:%s*(%d+)") / 1024)
  status:close()
  return
end

local least = tonumber(arg[1] or 62500)
print(("%-10s %9s %10s %8s %12s"):format("", "N", "seconds", "MiB", "bytes each"))
for _, row in ipairs { { "squares", 1 }, { "polygon", 1 }, { "nurbs", 1 / 10 },
  { "arcs", 1 / 50 }, { "lines", 1 / 50 } } do
  local name, share = unpack(row)
  for factor = 0, 2 do
    local n = math.floor(least * share * 4 ^ factor)
    local child = assert(io.popen(("%s %s %s %d"):format(arg[-1], arg[0], name, n)))
    local seconds, size = child:read("n", "n")
    assert(child:close() and size, name)
    print(("%-10s %9d %10.2f %8.0f %12.0f"):format(name, n, seconds, size, size * 2 ^ 20 / n))
  end
end
