-- Promises of docs/trust.md that no other file here tests, and the page itself: every test that it
-- names exists.
local markdown = require "tests.support.markdown"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local BUILD = workbench.build

local bench

before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

--- Runs celspan in the folder of the bench.
local function run(arguments, before)
  return bench:inside(("%s '%s' %s"):format(before or "", workbench.absolute, arguments))
end

local function done(arguments, before)
  local code, out, err = run(arguments, before)
  assert.are.equal(0, code, err)
  return out
end

local FILM = [[local celspan = require "celspan"
return celspan.film { size = { 320, 240 }, frames = 12, frame = function(f)
  local dots = {}
  for i = 1, 40 do
    dots[i] = celspan.circle { radius = 9.5,
      centre = { 160 + 150 * math.sin(i + f.number / 3), 6 * i },
      texture = celspan.rgb(i / 40, f.number / 12, 0.5, 0.7) }
  end
  return celspan.rostrum { back = "#123", celspan.cel(dots) } end }
]]

-- ---------------------------------------------------------------- files

describe("runs into one folder at the same time", function()
  it("succeed, with every frame complete, and leave no unfinished file", function()
    bench:write("film.lua", FILM)
    done "render film.lua -o whole/f.##.png --progress none"
    local one = "'" .. workbench.absolute .. "' render film.lua -o out/f.##.png --progress none "
    local code, _, err = bench:shell(([[cd '%s' && mkdir out
      for options in --resume --resume "" "--resume --workers 2"
      do %s $options & all="$all $!"; done; for one in $all; do wait $one || exit 1; done]])
      :format(bench.folder, one))
    assert.are.equal(0, code, err)
    assert.are.equal(13, #bench:files "out") -- and the record of --resume
    for i = 1, 12 do
      local name = ("f.%02d.png"):format(i)
      assert.is_true(bench:read("whole/" .. name) == bench:read("out/" .. name), name)
    end
  end)
end)

describe("a picture that is replaced during a run", function()
  -- --trust, so that the script itself can do it, before its second frame.
  local FRAMES = [[local celspan = require "celspan"
return celspan.film { size = { 60, 40 }, frames = 3, frame = function(f)
  if f.number == 2 then
    local new, file = io.open("new.png", "rb"):read "a", io.open("sky.png", "wb")
    file:write(new)
    file:close()
  end
  return celspan.rostrum { celspan.cel { celspan.image { file = "sky.png", w = 60, h = 40 } } } end
    }]]

  local function paint(name, colour)
    bench:write("one.lua", ([[local celspan = require "celspan"
return celspan.rostrum { size = { 600, 400 }, back = "%s", celspan.cel {
  celspan.circle { centre = { 300, 200 }, radius = 100, texture = "#fff" } } }]]):format(colour))
    done(("render one.lua -o %s --progress none"):format(name))
  end

  --- Renders into out; returns the exit code and standard error.
  local function render(options)
    paint("sky.png", "#a00")
    paint("new.png", "#00b")
    bench:write("film.lua", FRAMES)
    local code, _, err = run("render film.lua --trust --workers 1 --progress none -o out/#.png "
      .. options)
    if err:find("celspan-picture.so", 1, true) then return pending(err) end
    return code, err
  end

  it("is shown in its first version, as long as it is kept in memory", function()
    local code, err = render ""
    if not code then return end
    assert.are.equal(0, code, err)
    assert.is_true(bench:read "out/1.png" == bench:read "out/3.png")
  end)

  it("is an error if it is read again, never a mixture of both", function()
    local code, err = render "--memory 0"
    if not code then return end
    assert.are.equal(4, code, err)
    assert.is_truthy(err:find("frame 2: ", 1, true), err)
    assert.is_truthy(err:find("sky.png: changed while it was in use", 1, true), err)
    assert.are.same({ "1.png" }, bench:files "out")
  end)
end)

describe("a second run into a pyramid of tiles", function()
  it("fails because of the first one, and changes nothing", function()
    bench:write("film.lua", FILM)
    local tiles = "tiles film.lua --size 500x375 --progress none -o tiles"
    done(tiles)
    local log = system.lines(("ls '%s'/tiles/*.tiles"):format(bench.folder))[1]
    local sum = "cd '%s' && find tiles -type f | sort | xargs cat | md5sum >%s"
    assert.are.equal(0, (bench:shell(sum:format(bench.folder, "before"))))
    for _, options in ipairs { "", " --fresh" } do
      local code, _, err = run(tiles .. options, ("flock '%s' "):format(log))
      assert.are.equal(5, code, err)
      assert.is_truthy(err:find("another celspan is writing these tiles", 1, true), err)
    end
    bench:shell(sum:format(bench.folder, "after"))
    assert.are.equal(bench:read "before", bench:read "after")
  end)
end)

describe("a second signal", function()
  it("ends a program at once that ignores the first one", function()
    bench:write("film.lua", "('a'):rep(300000):find(('a-'):rep(8) .. 'b')")
    local words, code
    for _ = 1, 5 do -- the machine may be busy, and the time after the first signal over
      code, _, words = bench:shell(([[cd '%s' && { '%s' info film.lua --trust & pid=$!
        sleep 0.3; kill -TERM $pid
        sleep 0.55; kill -TERM $pid; wait $pid; exit $?; }]]):format(bench.folder,
          workbench.absolute))
      if not words:find "was killed" then break end
    end
    assert.are.equal(143, code)
    assert.is_nil(words:find("was killed", 1, true))
  end)
end)

describe("a span file of version 1", function()
  for _, depth in ipairs { "8", "half" } do
    it("is still read with the same result, at depth " .. depth, function()
      local kept = ("%s/tests/golden/files/version-1-%s."):format(os.getenv "PWD", depth)
      done(("convert '%sspan' now.tga"):format(kept))
      assert.is_true(bench:read(kept .. "tga") == bench:read "now.tga")
    end)
  end
end)

-- ---------------------------------------------------------------- the library

--- Objects of the library, without those of the program, of generators, and of units that are built
--- only with self-checks.
local OBJECTS = ("find '%s/src' '%s/subprojects' -name '*.o' ! -path '%s/*/tests/*' "
  .. "! -path '*embed*' ! -path '*headings*' ! -path '*make_*' ! -path '*compile.p*' "
  .. "! -path '*libprogram_*' ! -path '*/plugin/*' "
  .. "! -name '*base_self_check*'"):format(BUILD, BUILD, BUILD)

--- The names that objects import from other libraries.
local function wanted_by(objects)
  local names = {}
  for _, line in ipairs(system.lines(objects .. " -print0 | xargs -0 nm -u 2>/dev/null")) do
    local name = line:match "^%s+U ([%w_]+)"
    if name then names[name] = true end
  end
  return names
end

describe("the library", function()
  it("does not end, print, or change global state of the process #plain #uncounted", function()
    local names = wanted_by(OBJECTS .. " ! -path '*oiio*'")
    if not names.memcpy then return pending "nm, which lists calls, does not work" end
    for name in ([[exit _exit quick_exit abort __assert_fail raise kill atexit printf
      __printf_chk vprintf __vprintf_chk puts putchar perror fprintf __fprintf_chk stdout stderr
      signal sigaction sigprocmask setlocale setenv putenv chdir umask srand rand random system fork
      execv]]):gmatch "%S+" do
      assert.is_nil(names[name], name)
    end
  end)

  it("uses no mathematical functions except its own and exact ones", function()
    local names = wanted_by(OBJECTS .. " ! -path '*oiio*' ! -path '*sandbox*'")
    if not names.memcpy then return pending "nm, which lists calls, does not work" end
    for name in ([[sin cos sincos tan asin acos atan atan2 sinh cosh tanh exp exp2 expm1 log log2
      log10 log1p pow cbrt hypot erf]]):gmatch "%S+" do
      assert.is_nil(names[name], name)
      assert.is_nil(names[name .. "f"], name .. "f")
    end
  end)

  -- Except, for each thread, the script that runs there and its account (lua/sandbox/guard.c).
  local OF_THREADS = { account = true, entered = true }

  it("and the program's Lua use no functions of libm that differ #plain", function()
    local names = wanted_by(("find '%s'"):format(workbench.absolute))
    if not names.memcpy then return pending "nm, which lists calls, does not work" end
    for name in ("sin cos tan asin acos atan2 exp log log2 log10 pow"):gmatch "%w+" do
      assert.is_nil(names[name], name)
    end
  end)

  it("has no variables of its own #plain #uncounted", function()
    local seen = 0
    local module = system.lines(("find '%s' -name celspan.so"):format(BUILD))[1]
    for _, line in ipairs(system.lines(("nm -f sysv '%s' 2>/dev/null"):format(module))) do
      local name, section = line:match "^([^| ]+) *|.*|(%g+) *$"
      seen = seen + (name and 1 or 0)
      -- Added by the compiler: marks of beginning and end, and the features of the processor.
      local is_ours = name and not name:find "^__" and not name:find "^completed"
        and not (section == ".tbss" and OF_THREADS[name:gsub("%.%d+$", "")]) or false
      assert.is_false(is_ours and section:find "^%.t?[db][as][ts]a?$" ~= nil, line)
    end
    if seen == 0 then return pending "nm, which lists variables, does not work" end
  end)

  it("does not depend on the locale and the time zone of the system", function()
    bench:write("film.lua", FILM)
    local right = done "render film.lua --hash --frames 1-2"
    local made = os.execute(("cd '%s' && localedef -i de_DE -f UTF-8 ./de_DE.UTF-8 >/dev/null 2>&1")
      :format(bench.folder))
    local comma = "LOCPATH=. LC_ALL=de_DE.UTF-8 TZ=Asia/Kathmandu LANGUAGE=de"
    assert.are.equal(right, done("render film.lua --hash --frames 1-2", comma))
    if not made then return pending "the system has no locale with a decimal comma" end
    local shot = [[local celspan = require "celspan"
local path = celspan.path { d = "M 1.5 2.25 L 30.75 4e-1 L 2 20.5 Z", texture = "#fff" }
return celspan.pixels(celspan.rostrum { celspan.cel { path } }, { size = { 32, 24 } }):bytes {}]]
    bench:write("host.lua", [[assert(os.setlocale "de_DE.UTF-8" and ("%.1f"):format(1.5) == "1,5")
io.write((function() ]] .. shot .. " end)())")
    local host = ("cd '%s' && LUA_CPATH='%s' %%s '%s/tests/lua_host' host.lua"):format(bench.folder,
      package.cpath, BUILD)
    local code, out, err = bench:shell(host:format "LOCPATH=. LC_ALL=de_DE.UTF-8")
    assert.are.equal(0, code, err)
    assert.is_true(out == load(shot)())
  end)
end)

describe("time", function()
  it("is measured only by a clock that cannot be set", function()
    -- The log of --log shows the time of day.
    local objects = "find '%s/src' '%s/celspan.p' -name '*.o' ! -path '*oiio*' "
      .. "! -name '*_report_log.c.o'"
    local names = wanted_by(objects:format(BUILD, BUILD))
    if not names.memcpy then return pending "nm, which lists calls, does not work" end
    for name in ([[time gettimeofday ftime timespec_get clock localtime localtime_r gmtime gmtime_r
      mktime strftime]]):gmatch "%S+" do
      assert.is_nil(names[name], name)
    end
    local clocks = 0
    for _, line in ipairs(system.lines([[grep -rhoE --exclude=log.c ]]
      .. [['CLOCK_[A-Z]+[A-Z_]*,|[(]CLOCK_[A-Z_]+' src]])) do
      clocks = clocks + 1
      assert.is_truthy(line:find "CLOCK_MONOTONIC", line)
    end
    assert.is_true(clocks > 4)
    -- Without this, waiting would follow the wall clock.
    for _, file in ipairs(system.lines "grep -rl pthread_cond_timedwait src") do
      assert.is_truthy(markdown.read(file):find("pthread_condattr_setclock", 1, true), file)
    end
    assert.are.same({}, (system.lines [[grep -rnE 'os\.(time|date|clock)' lua]]))
  end)
end)

-- ---------------------------------------------------------------- the page

describe("docs/trust.md", function()
  local text = markdown.read "docs/trust.md"

  it("names existing tests, scripts and sources", function()
    local seen = 0
    for path in text:gmatch "`(%l+/[%w_./-]+)`" do
      if path:find "^tests/" or path:find "^src/" then
        seen = seen + 1
        local file = io.open(path)
        assert.is_truthy(file, path)
        file:close()
      end
    end
    assert.is_true(seen > 40)
  end)

  it("has a test for every promise", function()
    for number = 1, 12 do
      local promise = text:match("\n### P" .. number .. "%. (.-)\n##")
      assert.is_truthy(promise and promise:match "\nTests:[^\n].-`tests/[%w_/.]+`", "P" .. number)
    end
  end)

  it("refers to the list of exit codes instead of repeating it", function()
    assert.is_truthy(text:find("(command-line.md#exit-codes)", 1, true))
  end)
end)
