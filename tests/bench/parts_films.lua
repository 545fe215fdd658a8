--- Films as people make them, 1280 x 720: what a frame costs, to raw pixels and to a video.
---
---   raw      the pixels go nowhere
---   video    an mp4, whose ffmpeg is replaced by a program that reads and discards: the frames
---            and their coding, without the encoder
---   mp4      the same film with ffmpeg, beside Cairo in Python and Skia in Node
---   png      the simple film by screenshots of headless Chromium
---
--- Times are those of whole processes, shared among the frames. Instructions are counted by
--- valgrind's callgrind, with one worker: a run of several frames less a run of the first one. So
--- the load of the machine does not matter, and the start of the script is left out. CELSPAN_BEFORE
--- names another celspan, which then takes turns with this one.
local Command = require("tests.bench.runner").command
local frames = require "tests.bench.parts_frames"
local present = require "tests.support.present"

local parts = {}

local TIMED, TIMED_QUICK = 48, 12 -- frames whose time is measured
local COUNTED = 3                 -- frames after the first whose instructions are counted
local python = "/usr/bin/python3" -- Debian's, which sees Debian's modules

--- In film.lua each shot is another kind of work. All have frames for TIMED from `first` on.
parts.list = {
  { scene = "demo", script = "scripts/demo.lua", first = 100 },
  { scene = "film opening", script = "scripts/film.lua", first = 101 },
  { scene = "film street", script = "scripts/film.lua", first = 250 },
  { scene = "film close", script = "scripts/film.lua", first = 421 },
  { scene = "film town", script = "scripts/film.lua", first = 600 },
  { scene = "painted", script = "tests/bench/scripts/tale.lua", first = 12, has_paintings = true },
  { scene = "simple", script = "tests/bench/scripts/simple.lua", first = 60 },
  { scene = "flat discs", script = "tests/bench/scripts/discs.lua", first = 60 },
}

-- ---------------------------------------------------------------- commands

--- celspan with `count` frames of a film from its first one on; `place` has the paintings.
local function render(program, film, count, workers, out, place)
  local words = { program, "render", film.script, "--trust", "--limit", "time=0",
    "--size", "1280x720", "--workers", workers, "--progress", "none", "--frames",
    ("%d-%d"):format(film.first, film.first + count - 1), "-o", out }
  if film.has_paintings then
    words[#words + 1], words[#words + 2] = "--", place .. "/paintings"
  end
  return Command(table.unpack(words))
end

--- An ffmpeg that discards what it reads. It writes the beginning of an mp4, by which celspan
--- recognizes what it asked for.
local SUBSTITUTE = [[
#!/bin/sh
for out; do :; done
cat >/dev/null
printf '\000\000\000\030ftypmp42\000\000\000\000' >"${out#file:}"
]]

--- Puts it into a folder for PATH.
local function write_substitute(folder)
  assert(os.execute(Command("mkdir", "-p", folder)))
  local file = assert(io.open(folder .. "/ffmpeg", "w"))
  file:write(SUBSTITUTE)
  file:close()
  assert(os.execute(Command("chmod", "+x", folder .. "/ffmpeg")))
end

--- A shell command that renders to raw pixels or to a video for the substitute. `under` comes
--- before the program, as valgrind does.
local function shell(program, film, count, workers, output, place, under)
  under = under or ""
  local head = "export CELSPAN_PATH='scripts/?.lua'; "
  if output == "raw" then
    return head .. under .. render(program, film, count, workers, "-", place) .. " >/dev/null"
  end
  return head .. ("PATH=%s:$PATH; "):format(Command(place .. "/bin")) .. under
    .. render(program, film, count, workers, place .. "/film.mp4", place)
end

-- ---------------------------------------------------------------- instructions

local CALLGRIND = "valgrind --tool=callgrind --callgrind-out-file=/dev/null "

--- The instructions of a run. The encoder is another process, which is not counted.
local function count_run(program, film, count, output, place)
  local pipe = assert(io.popen("{ " .. shell(program, film, count, 1, output, place, CALLGRIND)
    .. "; } 2>&1"))
  local words = pipe:read "a"
  assert(pipe:close(), words)
  return tonumber(words:match "Collected : (%d+)")
end

--- The instructions of a frame after the first one.
local function instructions(program, film, output, place)
  local all = count_run(program, film, 1 + COUNTED, output, place)
  return (all - count_run(program, film, 1, output, place)) // COUNTED
end

-- ---------------------------------------------------------------- rows

--- The programs that are measured: their names and paths.
local function programs(runner)
  local list = { { "celspan", runner.celspan } }
  local before = os.getenv "CELSPAN_BEFORE"
  if before then list[2] = { "celspan before", before } end
  return list
end

local function entry(runner, scene, output, renderer, workers, count, command)
  return { part = "films", scene = scene, side = 1280, output = output, renderer = renderer,
           workers = workers, take = frames.per_frame(count), limit = 600,
           command = Command(runner:program "launch", "all", "sh", "-c", command) }
end

local function count_all(runner, film, place, first)
  for i = first, #runner.rows do
    local row = runner.rows[i]
    for _, program in ipairs(programs(runner)) do
      if row.renderer == program[1] and row.workers == 1 then
        row.instructions = instructions(program[2], film, row.output, place)
        print(("   %s, %s by %s: %.1f million instructions a frame"):format(row.scene, row.output,
          row.renderer, row.instructions / 1e6))
      end
    end
  end
end

local function measure(runner, film, place, count, is_quick)
  local entries, first = {}, #runner.rows + 1
  for _, output in ipairs { "raw", "video" } do
    for workers = 1, 2 do
      for _, program in ipairs(programs(runner)) do
        entries[#entries + 1] = entry(runner, film.scene, output, program[1], workers, count,
          shell(program[2], film, count, workers, output, place))
      end
    end
  end
  runner:measure(3, entries)
  if is_quick then runner:note "a quick run: no instructions of films are counted"
  elseif present.program "valgrind" then count_all(runner, film, place, first)
  else runner:note "valgrind is not installed: no instructions of films are counted" end
end

-- ---------------------------------------------------------------- beside

local ENCODER = " | ffmpeg -y -v error -f rawvideo -pix_fmt %s -s 1280x720 -r 25 -i pipe:0 "
  .. "-c:v libx264 -preset medium -tune animation -crf 18 -pix_fmt yuv420p "

--- What else makes the simple film: name, command of its raw pixels, their order.
local function peers(runner, count)
  local list, scripts = {}, "tests/bench/films/simple_"
  if os.execute(Command(python, "-c", "import cairo") .. " 2>/dev/null") then
    list[1] = { "Cairo in Python", Command(python, scripts .. "cairo.py", count), "bgra" }
  else runner:note "Cairo for Python is not installed: it is left out" end
  if runner.modules then
    list[#list + 1] = { "Skia in Node",
      Command("node", scripts .. "skia.js", runner.modules, count), "rgba" }
  end
  return list
end

--- All programs begin at the first frame of the film, because Chromium does.
local function beside(runner, place, count)
  local film = { script = "tests/bench/scripts/simple.lua", first = 1 }
  local raw, coded = {}, {}
  for _, program in ipairs(programs(runner)) do
    coded[#coded + 1] = entry(runner, "simple", "mp4", program[1], 1, count,
      render(program[2], film, count, 1, place .. "/film.mp4", place))
  end
  for _, peer in ipairs(peers(runner, count)) do
    local command = peer[2]
    raw[#raw + 1] = entry(runner, "simple", "raw", peer[1], 1, count, command .. " >/dev/null")
    coded[#coded + 1] = entry(runner, "simple", "mp4", peer[1], 1, count,
      command .. ENCODER:format(peer[3]) .. Command(place .. "/peer.mp4"))
  end
  runner:measure(3, raw)
  if present.program "ffmpeg" then runner:measure(3, coded)
  else runner:note "ffmpeg is not installed: no mp4 is made" end
  if present.program("chromium", "node") then
    runner:measure(1, { entry(runner, "simple", "png", "headless Chromium", 2, 150,
      Command("node", "tests/bench/beside/chromium.js", "-", place,
        "tests/bench/films/simple.html")) })
  else runner:note "Chromium is not installed: it is left out" end
end

function parts.films(runner, folder, is_quick)
  local place = runner.root .. "/" .. folder .. "/films"
  local count = is_quick and TIMED_QUICK or TIMED
  write_substitute(place .. "/bin")
  frames.write_layers(runner.celspan, runner.root, place .. "/paintings", "1600x900")
  for _, film in ipairs(parts.list) do measure(runner, film, place, count, is_quick) end
  beside(runner, place, count)
  os.execute(Command("rm", "-r", place))
end

return parts
