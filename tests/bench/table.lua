-- How much faster the films of a table are made by two workers than by one:
--   lua5.4 tests/bench/table.lua [PROGRAM] [ROWS]
-- Measure it on a machine that does nothing else.
local program, rows = arg[1] or "build/celspan", tonumber(arg[2] or 100)
local folder = os.tmpname()
os.remove(folder)

local function run(command) assert(os.execute(command), command) end

local function write(name, text)
  local file = assert(io.open(folder .. "/" .. name, "wb"))
  file:write(text)
  file:close()
end

--- Seconds that a command takes.
local function seconds(command)
  local pipe = assert(io.popen(("bash -c 'TIMEFORMAT=%%R; time %s' 2>&1"):format(command)))
  local text = pipe:read "a"
  pipe:close()
  return assert(tonumber(text), text)
end

run("mkdir -p " .. folder)
write("title.lua", [[
local celspan = require "celspan"
local given = celspan.parameters { name = "none", turns = 1 }
return celspan.film { size = { 480, 270 }, frames = 24, frame = function(f)
  local art = {}
  for i = 1, 60 do
    art[i] = celspan.circle { centre = { 240 + 3 * i, 135 }, radius = 2 + i / 3,
      texture = celspan.rgb("#e4572e", 0.4) }:rotate(given.turns * (6 * i + 15 * f.index), 240, 135)
  end
  return celspan.rostrum { back = "#fbefd6", celspan.cel(art) }
end }
]])
local table_rows = { "name,turns" }
for i = 1, rows do table_rows[i + 1] = ("row%d,%d"):format(i, i % 100 + 1) end
write("rows.csv", table.concat(table_rows, "\n"))
local times = {}
for workers = 1, 2 do
  local options = ("--table %s/rows.csv --workers %d --progress none"):format(folder, workers)
  times[workers] = seconds(("%s render %s/title.lua %s -o %s/w%d/{name}.####.png"):format(program,
    folder, options, folder, workers))
  print(("%d rows, %d worker%s: %.2f s"):format(rows, workers, workers == 1 and "" or "s",
    times[workers]))
end
print(("%.2f times as fast"):format(times[1] / times[2]))
run(("diff -r %s/w1 %s/w2 && rm -r %s"):format(folder, folder, folder))
