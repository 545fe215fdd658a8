--- One film as people would make it with other programs: the scripts of tests/bench/beside, each in
--- a process of its own, from the script to PNG files. What is not installed is left out.
local Command = require("tests.bench.runner").command
local present = require "tests.support.present"

local parts = {}

local scripts = "tests/bench/beside/"
local frame_count = 150
-- Debian's, which sees Debian's modules.
local python = "/usr/bin/python3"

--- Lines of scripts that are neither empty nor a comment.
local function count_lines(names)
  local count = 0
  for _, name in ipairs(names) do
    for line in io.lines(scripts .. name) do
      if not line:find "^%s*$" and not line:find "^%s*%-%-" and not line:find "^%s*//"
        and not line:find "^%s*#" then count = count + 1 end
    end
  end
  return count
end

local function succeeds(...)
  return os.execute(Command(...) .. " >/dev/null 2>&1") == true
end

--- Each program: its name, the scripts a user writes, whether it is installed, and its command for
--- the drawing and the folder of the frames.
local function programs(runner)
  local film = runner.folder .. "/beside.sif"
  return {
    { name = "celspan", scripts = { "celspan.lua" }, has = true,
      command = function(drawing, folder)
        return Command(runner.celspan, "render", scripts .. "celspan.lua", "--allow",
          runner.root .. "/scripts/drawings", "--allow-system-fonts", "--progress", "none", "-o",
          folder .. "/####.png", "--", drawing)
      end },
    { name = "Skia canvas in Node", scripts = { "skia.js", "scene.js" },
      has = runner.modules ~= nil,
      command = function(drawing, folder)
        return Command("node", scripts .. "skia.js", runner.modules, drawing, folder)
      end },
    { name = "headless Chromium", scripts = { "chromium.js", "chromium.html", "scene.js" },
      has = present.program("chromium", "node"),
      command = function(drawing, folder)
        return Command("node", scripts .. "chromium.js", drawing, folder)
      end },
    { name = "Cairo in Python", scripts = { "cairo_film.py" },
      has = succeeds(python, "-c",
        "import cairo, gi; gi.require_version('Rsvg', '2.0'); gi.require_foreign('cairo')"),
      command = function(drawing, folder)
        return Command(python, scripts .. "cairo_film.py", drawing, folder)
      end },
    { name = "Synfig", scripts = {}, has = present.program "synfig", -- its films are drawn
      command = function(drawing, folder)
        assert(os.execute(Command("lua5.4", scripts .. "synfig.lua", drawing) .. " >" ..
          Command(film)))
        return Command("synfig", "-q", "-t", "png", "-o", folder .. "/film.png", film)
      end },
  }
end

--- How many frames a program wrote.
local function frames_in(folder)
  local pipe = assert(io.popen("ls " .. Command(folder)))
  local count = 0
  for name in pipe:lines() do count = count + (name:find "%.png$" and 1 or 0) end
  pipe:close()
  return count
end

--- The line of launch, which comes after what the command itself says.
local function measured(lines)
  for _, line in ipairs(lines) do
    if line.wall then return line end
  end
end

local function make(runner, program, drawing)
  local folder = runner.root .. "/" .. runner.folder .. "/beside"
  os.execute(Command("rm", "-rf", folder))
  assert(os.execute(Command("mkdir", "-p", folder)))
  local lines = count_lines(program.scripts)
  local before = #runner.rows
  runner:repeat_all(1, { { part = "beside", scene = frame_count .. " frames", side = 1280,
    output = "png", renderer = program.name, lines = lines > 0 and lines or nil, take = measured,
    limit = 600,
    command = Command(runner:program "launch", "all") .. " "
      .. program.command(drawing, folder) } })
  local written = frames_in(folder)
  if #runner.rows > before and written ~= frame_count then
    table.remove(runner.rows)
    runner:note(("%s wrote %d of %d frames: it is left out"):format(program.name, written,
      frame_count))
  end
  os.execute(Command("rm", "-rf", folder))
end

function parts.beside(runner, _, is_quick)
  if is_quick then return runner:note "a quick run: the film of other programs is left out" end
  local drawing = runner.root .. "/scripts/drawings/owl.svg"
  for _, program in ipairs(programs(runner)) do
    if program.has then make(runner, program, drawing)
    else runner:note(program.name .. " is not installed: its line of the film is left out") end
  end
end

return parts
