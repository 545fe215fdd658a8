-- Tracing compared with potrace: time, number of curves, and the error of edges, on the same
-- drawing.
--
--   LUA_CPATH=build/?.so lua5.4 tests/bench/trace.lua build/celspan [WIDTH]
--
-- The drawing is generated, so that its true edges are known: 400 lines of varying width in ink on
-- A4 paper, rasterised with antialiasing, 4960 pixels wide by default (600 dpi). celspan reads the
-- grey picture; potrace reads it thresholded, and enlarged and thresholded by its mkbitmap, which
-- its manual advises for grey pictures. Each result is drawn at the size of the picture and
-- compared with it in linear light: the sum of all differences divided by the number of pixels that
-- edges cross is the mean error of edges, in pixels; the worst is the largest difference of a
-- pixel. potrace is Debian's package of that name.
local celspan = require "celspan"
local system = require "tests.support.system"
local svg = require "celspan.svg"
local binary, width = arg[1] or "build/celspan", tonumber(arg[2] or 4960)
local height = math.floor(width * 877 / 620 + 0.5)

local function drawing()
  local random = celspan.random(5)
  local list = {}
  for i = 1, 400 do
    local x, y = random("x" .. i) * 600, random("y" .. i) * 860
    local points = {}
    for k = 1, 4 do
      points[k] = { x + (random(k .. "a" .. i) - 0.5) * 120,
        y + (random(k .. "b" .. i) - 0.5) * 120,
        0.5 + 2.5 * random(k .. "w" .. i) }
    end
    list[i] = celspan.stroke { points = points, degree = 3, cap = "round", texture = "#000000" }
  end
  return celspan.union(list):scale(width / 620)
end

local folder = os.tmpname()
os.remove(folder)
assert(os.execute("mkdir " .. folder))

local function rostrum(object)
  return celspan.rostrum { celspan.cel { object }, back = "#ffffff" }
end

--- How much ink each pixel has, 0..1.
local function ink(object)
  local image = celspan.pixels(rostrum(object), { size = { width, height } })
  return image:bytes { depth = 16, colour = "linear" }
end

local art = drawing()
local truth = ink(art)
assert(celspan.render(rostrum(art), folder .. "/art.png", { size = { width, height } }))
assert(celspan.render(celspan.rostrum { celspan.cel { art }, back = "#ffffff", antialias = "none" },
  folder .. "/whole.png", { size = { width, height } }))
-- The same for potrace, with 8 bits, in linear light because its programs threshold at one half.
do
  local file, row = assert(io.open(folder .. "/art.pgm", "wb")), {}
  file:write(("P5 %d %d 255\n"):format(width, height))
  for y = 0, height - 1 do
    for x = 1, width do
      row[x] = string.char((string.unpack("<I2", truth, 8 * (y * width + x) - 7)) // 257)
    end
    file:write(table.concat(row))
  end
  file:close()
end

local function errors(object)
  local got, sum, worst, mixed = ink(object), 0, 0, 0
  for at = 1, #truth, 8 do
    local a, b = string.unpack("<I2", truth, at), string.unpack("<I2", got, at)
    if a > 0 and a < 65535 then mixed = mixed + 1 end
    if a ~= b then
      local off = a < b and b - a or a - b
      sum, worst = sum + off, off > worst and off or worst
    end
  end
  return sum / 65535 / mixed, worst / 65535
end

--- Lines and cubics of path data with relative and repeated commands.
local function count_curves(text)
  local count = 0
  for d in text:gmatch " d=\"([^\"]*)\"" do
    for command, rest in d:gmatch "([%a])([^%a]*)" do
      local _, numbers = rest:gsub("%-?[%d.]+", "")
      local size = ({ C = 6, L = 2 })[command:upper()]
      count = count + (size and numbers // size or 0)
    end
  end
  return count
end

local function seconds_of(command)
  local text, ended_well = system.output(
    ("bash -c 'TIMEFORMAT=%%U+%%S; time { %s ; }' 2>&1"):format(command))
  assert(ended_well, text)
  local own, of_system = text:match "([%d.]+)%+([%d.]+)%s*$"
  return tonumber(own) + tonumber(of_system)
end

local function measure(name, command, output, is_ours)
  local seconds = seconds_of(command:gsub("FOLDER", folder))
  local text = assert(system.read(folder .. "/" .. output))
  if is_ours then -- the ink alone: the rest of the paper is ground
    text = text:gsub("<path [^>]*fill=\"#[f][^>]*/>\n", "")
    local file = assert(io.open(folder .. "/ink.svg", "wb"))
    file:write(text)
    file:close()
    output = "ink.svg"
  end
  local traced = assert(svg.read(folder .. "/" .. output))
  local mean, worst = errors(traced.object:scale(width / traced.width, height / traced.height))
  print(("%-24s %8.2f %9d %9d %10.4f %8.3f")
    :format(name, seconds, count_curves(text), #text, mean, worst))
end

print(("%d x %d pixels"):format(width, height))
print(("%-24s %8s %9s %9s %10s %8s"):format("", "cpu s", "curves", "bytes", "mean off", "worst"))
measure("celspan", binary .. " trace FOLDER/art.png -o FOLDER/a.svg --colours \"#ffffff,#000000\"",
  "a.svg", true)
measure("celspan, one bit", binary
  .. " trace FOLDER/whole.png -o FOLDER/d.svg --colours \"#ffffff,#000000\"", "d.svg", true)
measure("potrace",
  "mkbitmap -x -t 0.5 -o FOLDER/b.pbm FOLDER/art.pgm; potrace -s FOLDER/b.pbm -o FOLDER/b.svg",
  "b.svg")
measure("potrace, mkbitmap -s 2",
  "mkbitmap -x -s 2 -3 -t 0.5 -o FOLDER/c.pbm FOLDER/art.pgm; potrace -s FOLDER/c.pbm -o "
  .. "FOLDER/c.svg", "c.svg")
os.execute("rm -r " .. folder)
