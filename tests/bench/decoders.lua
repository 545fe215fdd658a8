-- The cost of decoding pictures in processes of their own, compared with --trust, which decodes
-- them in the program. The film shows another picture in each of FRAMES frames (60), with
-- 1920 x 1080 and with 16 x 16 pixels.
--
--   lua5.4 tests/bench/decoders.lua build/celspan [ROUNDS [FRAMES]]
--
-- Both are run in turn, ROUNDS times (5). For each, the least processor time, including that of all
-- its processes, and the least wall time are printed in seconds.
local celspan, rounds = arg[1] or "build/celspan", tonumber(arg[2]) or 5
local FRAMES = tonumber(arg[3]) or 60

local folder = os.tmpname()
os.remove(folder)
assert(os.execute("mkdir '" .. folder .. "'"))

local function write(name, text)
  local file = assert(io.open(folder .. "/" .. name, "w"))
  file:write(text)
  file:close()
end

--- Processor time and wall time of a command, in seconds.
local function measure(command)
  local run =
    assert(io.popen(("bash -c \"TIMEFORMAT='%%U %%S %%R'; time %s >/dev/null 2>'%s/words'\" 2>&1")
    :format(command, folder)))
  local user, system, clock = run:read("n", "n", "n")
  run:close()
  return user + system, clock
end

local function render(name, ending, options)
  return ("'%s' render '%s/%s.lua' --progress none %s %s")
    :format(celspan, folder, name, ending, options or "")
end

--- Numbered pictures with gradients.
local function make_pictures(width, height)
  write("make.lua", ([[local celspan = require "celspan"
return celspan.film { size = { %d, %d }, frames = %d, frame = function(f)
  local row = {}
  for i = 1, %d do row[i] = celspan.rect { (i * 37 + f.number) %% %d, (i * 91) %% %d, 40, 9,
    texture = celspan.linear { from = { 0, i }, to = { 300, 40 * i }, { 0, "#f40" }, { 1, "#04" .. i
      %% 10 } } } end
  return celspan.rostrum { back = "#9ab", celspan.cel(row) } end }]])
    :format(width, height, FRAMES, 60, width, height))
  measure(render("make", ("-o '%s/%d.###.png'"):format(folder, width)))
end

local function tell(width, height)
  make_pictures(width, height)
  write("film.lua", ([[local celspan = require "celspan"
return celspan.film { size = { 1920, 1080 }, frames = %d, frame = function(f)
  return celspan.rostrum { celspan.cel { celspan.image { file = ("%d.%%03d.png"):format(f.number), w
    = 1920, h = 1080 } } }
end }]]):format(FRAMES, width))
  local least = { ["--trust"] = { 1e9, 1e9 }, [""] = { 1e9, 1e9 } }
  for _ = 1, rounds do
    for _, options in ipairs { "", "--trust" } do
      local best = least[options]
      local processor, clock = measure(render("film", "--hash", options))
      best[1], best[2] = math.min(best[1], processor), math.min(best[2], clock)
    end
  end
  local trusted, apart = least["--trust"], least[""]
  for i, kind in ipairs { "processor", "clock" } do
    print(("%d x %d  %-9s  --trust %.3f  apart %.3f  %+.2f %%")
      :format(width, height, kind, trusted[i], apart[i],
      100 * (apart[i] / trusted[i] - 1)))
  end
end

tell(1920, 1080)
tell(16, 16)
os.execute("rm -rf '" .. folder .. "'")
