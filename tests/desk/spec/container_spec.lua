-- celspan in a container: its processors, and its memory. The control group is one that the test
-- makes, where the machine lets it, else files like those of one.
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local PEAK = workbench.build .. "/tests/peak"
local LIMIT = 150 << 20

local bench

--- Files like those of a control group, with one processor.
local function pretend()
  os.execute(("mkdir -p '%s/group'"):format(bench.folder))
  bench:write("group/memory.max", LIMIT .. "\n")
  bench:write("group/memory.current", (8 << 20) .. "\n")
  bench:write("group/cpu.max", "100000 100000\n")
end

before_each(function()
  bench = workbench.new()
  pretend()
end)
after_each(function() bench:remove() end)

local function run(before, arguments)
  return bench:inside(("%s '%s' %s"):format(before, workbench.absolute, arguments))
end

describe("the number of threads", function()
  --- Those of the process when it builds the third of four frames.
  local function threads(before)
    bench:write("film.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 64, 64 }, frames = 4, frame = function(f)
  if f.number == 3 then
    io.stderr:write(io.open "/proc/self/status":read "a":match "Threads:%s+(%d+)")
  end
  return celspan.rostrum { celspan.cel { celspan.rect { 9, 9, 9, 9 } } }
end }
]])
    local code, _, err = run(before, "render film.lua --trust --hash --progress none")
    assert.equal(0, code, err)
    return tonumber(err)
  end

  it("is that of the processors that the process may run on", function()
    if not present.program "taskset" then return pending "there is no taskset" end
    assert.equal(1, threads "taskset -c 0")
  end)

  it("is not more than the quota of the control group, rounded up", function()
    assert.equal(1, threads "CELSPAN_CGROUP=group")
  end)
end)

-- ---------------------------------------------------------------- memory

local FILMS = {
  table = { 6, "the script needs more than", "local t = {} for i = 1, 1e9 do t[i] = { i } end" },
  text = { 6, "the script needs more than",
           "local t = {} for i = 1, 1e6 do t[i] = ('x'):rep(1e6 + i) end" },
  scene = { 6, "the script needs more than", [[
local list = {}
for i = 1, 200000 do
  list[i] = celspan.circle { centre = { i % 640, i % 360 }, radius = 5 }:blur(3)
end
return celspan.rostrum { celspan.cel(list) }]] },
  rendering = { 33, "script, scene and rendering together need more than", [[
local square, list = celspan.rect { 9, 9, 9, 9 }, {}
for i = 1, 500000 do list[i] = square end
local rostrum = celspan.rostrum { celspan.cel(list) }
return celspan.film { size = { 64, 64 }, frames = 1, frame = function() return rostrum end }]] },
}
local RENDER = "render film.lua --hash --progress none"

local function ends_well(name, code, out)
  local wanted, sentence = FILMS[name][1], FILMS[name][2]
  assert.equal(wanted, code, name .. ": " .. out)
  assert.truthy(out:find("celspan: error: .*" .. sentence), name .. ": " .. out)
end

local function write_film(name)
  bench:write("film.lua", 'local celspan = require "celspan"\n' .. FILMS[name][3] .. "\n")
end

--- A shell script that runs its arguments in a new control group below its own; code 99: it could
--- not be made. It prints the peak of the group, if it counts one.
local IN_GROUP = [[
group=/sys/fs/cgroup$(sed -n 's/^0:://p' /proc/self/cgroup)/celspan-test-$$
[ -e "${group%/*}/memory.max" ] && mkdir "$group" 2>/dev/null || exit 99
echo 157286400 2>/dev/null >"$group/memory.max" || { rmdir "$group"; exit 99; }
( echo 0 >"$group/cgroup.procs" && exec "$@" )
code=$?
cat "$group/memory.peak" 2>/dev/null
rmdir "$group"
exit "$code"
]]

describe("the memory of a control group #plain", function() -- sanitizers need more
  for name in pairs(FILMS) do
    it("is enough for script, scene and rendering together, or the run ends: " .. name, function()
      write_film(name)
      local code, out, err = run(("CELSPAN_CGROUP=group '%s' 60"):format(PEAK), RENDER)
      local words, bytes = err:match "^(.*)peak (%d+) processor [%d.]+\n$"
      ends_well(name, code, out .. words)
      assert.is_true(tonumber(bytes) < LIMIT, bytes)
    end)

    it("never has the kernel end the run: " .. name, function()
      bench:write("in_group", IN_GROUP)
      if run("sh in_group", "--version") == 99 then
        return pending "this machine lets no test make a control group"
      end
      write_film(name)
      local code, out, err = run("sh in_group", RENDER)
      ends_well(name, code, out .. err)
      local peak = tonumber(out:match "(%d+)%s*$")
      assert.is_true(not peak or peak < LIMIT, out)
    end)
  end

  it("is told to be full, whoever fills it, in place of a limit that allows more", function()
    write_film "rendering"
    bench:write("group/memory.current", LIMIT - (16 << 20) .. "\n")
    local code, _, err =
      run("CELSPAN_CGROUP=group", RENDER .. " --limit render-memory=1G,memory=1G")
    assert.is_true(code == 33 or code == 6, code)
    assert.truthy(err:find("the control group of this process, of 150 MiB, is full", 1, true), err)
  end)

  it("is not looked at by trusted scripts, or without a limit of rendering", function()
    bench:write("film.lua", [[
local celspan = require "celspan"
return celspan.rostrum { celspan.cel { celspan.rect { 9, 9, 9, 9 } } }
]])
    bench:write("group/memory.max", "4096\n")
    local words = "render film.lua --hash --size 9x9 --progress none"
    assert.equal(33, (run("CELSPAN_CGROUP=group", words)))
    assert.equal(0, (run("CELSPAN_CGROUP=group", words .. " --trust")))
    assert.equal(0, (run("CELSPAN_CGROUP=group", words .. " --limit render-memory=0,memory=0")))
  end)
end)

describe("CELSPAN_MEMORY", function()
  it("is the memory of the run", function()
    write_film "table"
    local code, _, err = run("CELSPAN_MEMORY=40M", RENDER)
    assert.equal(6, code)
    assert.truthy(err:find("the script needs more than 30 MiB", 1, true), err)
    code, _, err = run("CELSPAN_MEMORY=much", RENDER)
    assert.equal(2, code)
    assert.truthy(err:find("CELSPAN_MEMORY: 'much' is not a size of at least 1M", 1, true), err)
  end)

  it("is divided among the processes of a table", function()
    bench:write("film.lua", [[
local celspan = require "celspan"
local n = celspan.parameters { n = 0 }.n
local t = {} for i = 1, n > 0 and 1e9 or 0 do t[i] = { i } end
return celspan.film { size = { 9, 9 }, frames = 1, frame = function()
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 9, 9 } } } end }
]])
    bench:write("rows.csv", "n\n1\n2\n")
    local code, _, err = run("CELSPAN_MEMORY=80M",
      "render film.lua --table rows.csv -o {n}.#.png --workers 2 --progress none")
    assert.equal(6, code, err)
    assert.truthy(err:find("the script needs more than 30 MiB", 1, true), err)
  end)
end)

-- ---------------------------------------------------------------- time

describe("the limit of time", function()
  --- Stops a script for some seconds while it runs.
  local function pause(script, seconds, limit)
    bench:write("film.lua",
      "local celspan = require 'celspan'\nio.stderr:write 'begun\\n'\n" .. script)
    bench:write("pause", ([[
'%s' check film.lua --trust --limit time=%s >printed 2>&1 & run=$!
until grep -q begun printed || ! kill -0 $run; do sleep 0.01; done
kill -STOP $run; sleep %s; kill -CONT $run; wait $run; code=$?
cat printed; exit $code]]):format(workbench.absolute, limit, seconds))
    return bench:inside "sh pause"
  end

  it("is that of the processor: a busy machine ends no script", function()
    local code, out = pause("for i = 1, 4e6 do end return celspan.rostrum {}\n", 1.5, 1)
    assert.equal(0, code, out)
  end)

  it("is ten times as long by the clock: what waits ends, too", function()
    local code, out = pause("while true do end\n", 2.2, 0.2)
    assert.equal(6, code, out)
    assert.truthy(out:find("more than 2 seconds (ten times --limit time=SECONDS)", 1, true), out)
  end)
end)
