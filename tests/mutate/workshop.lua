-- A copy of the tree where mutants are built and tested, in out/mutate: the tree itself is never
-- changed.
--
-- Objects are made with self-checks and without debugging information, so that a difference in an
-- object is a difference in the program. A file of the copy is written only if its text changes:
-- builds stay incremental, and files left by a killed run are noticed by the next one.
local catalogue = require "tests.support.catalogue"
local system = require "tests.support.system"

local workshop = {}
workshop.__index = workshop

local FOLDER = "out/mutate"
local COPY, LOG = FOLDER .. "/tree", FOLDER .. "/log"
local OPTIONS = "-Dchecks=true -Ddebug=false -Doptimization=1 "
  .. "'-Dc_args=-Werror=incompatible-pointer-types -Werror=int-conversion "
  .. "-Werror=aggressive-loop-optimizations'" -- a loop beyond an array: no test needs to find it
-- The limits of a mutant before it is stopped: KiB of memory, and blocks of 512 bytes in a file.
local MOST_MEMORY, MOST_FILE = 8 << 20, 2 << 20

local quote, read, write = system.quote, system.read, system.write

local function output_of(command)
  local text, ended_well = system.output(command)
  return ended_well and text or nil
end

local function lines_of(command)
  local lines, ended_well = system.lines(command)
  return ended_well and lines or {}
end

--- Paths of the files of the tree at `root`.
local function files_of(root)
  return lines_of(("cd %s && find . \\( -name .git -o -path './build*' -o -path ./out \\) -prune "
    .. "-o -type f -print"):format(quote(root)))
end

--- Updates the copy from the tree; returns the paths that differed.
local function refresh()
  local is_here, different = {}, {}
  for _, path in ipairs(files_of ".") do
    is_here[path] = true
    if read(path) ~= read(COPY .. "/" .. path) then different[#different + 1] = path end
  end
  if #different > 0 then
    write(FOLDER .. "/list", table.concat(different, "\n"))
    assert(os.execute(("xargs -d '\\n' cp --parents -t %s <%s/list"):format(COPY, FOLDER)))
  end
  for _, path in ipairs(files_of(COPY)) do
    if not is_here[path] then
      different[#different + 1] = path
      assert(os.remove(COPY .. "/" .. path))
    end
  end
  return different
end

--- Which objects are made from each source and header: the path of the tree to a list of targets.
local function read_dependents()
  local dependents, object = {}, nil
  for _, line in ipairs(lines_of(("ninja -C %s/build -t deps"):format(COPY))) do
    object = line:match "^(%S+%.o): " or object
    local path = line:match "^%s+%.%./(src/%S+)$"
    if path then
      dependents[path] = dependents[path] or {}
      table.insert(dependents[path], object)
    end
  end
  return dependents
end

--- The digests of objects that were built, by their targets.
local function digests_of(objects)
  local digests = {}
  write(FOLDER .. "/list", table.concat(objects, "\n"))
  for _, line in ipairs(lines_of(("cd %s/build && xargs md5sum <../../list"):format(COPY))) do
    local digest, object = line:match "^(%x+)%s+(%S+)$"
    digests[object] = digest
  end
  return digests
end

--- Runs ninja for targets of the copy, `jobs` at a time (1); returns whether it succeeded.
local function build(targets, jobs)
  write(FOLDER .. "/list", table.concat(targets, "\n"))
  local command = "xargs ninja -C %s/build -j%s <%s/list >%s 2>&1"
  return os.execute(command:format(COPY, jobs or 1, FOLDER, LOG)) == true
end

--- The tests that run what was built: those of the style read the sources alone.
local function tests_of_programs()
  local list = {}
  for _, test in ipairs(catalogue.of(COPY, "build", "--no-keep-going")) do
    if test.suite ~= "style" and test.name ~= "faults/soak" then list[#list + 1] = test end
  end
  return list
end

--- Opens the workshop: the copy is made and built, which takes minutes the first time.
function workshop.open()
  assert(os.execute("mkdir -p " .. COPY))
  local changed = refresh()
  if read(FOLDER .. "/options") ~= OPTIONS then
    local set_up = "cd %s && rm -rf build && "
      .. "CC='ccache gcc' CXX='ccache g++' meson setup build %s >../log 2>&1"
    if not os.execute(set_up:format(COPY, OPTIONS)) then
      return nil, "meson setup failed: see " .. LOG
    end
    write(FOLDER .. "/options", OPTIONS)
  end
  if not build({ "all", "meson-test-prereq" }, "$(nproc)") then
    return nil, "the build failed: see " .. LOG
  end
  local self = { dependents = read_dependents(), digests = {}, times = {},
    tests = tests_of_programs() }
  setmetatable(self, workshop)
  self:read_times(changed)
  return self
end

--- The processor time of the tests that passed without a mutant, in seconds. That of a test is
--- forgotten when its source changes, all of them when anything else does.
function workshop:read_times(changed)
  local is_forgotten = {}
  for _, path in ipairs(changed) do
    local test = path:match "^%./tests/%a+/unit/test_([%w_]+)%.c$"
    local name = test and "unit/" .. test or path:match "^%./tests/.-([%w_]+/[%w_]+)_spec%.lua$"
    local is_read = not (path:find "^%./tests/mutate/" or path:find "%.md$")
    if name then is_forgotten[name] = true elseif is_read then return end
  end
  for name, seconds in (read(FOLDER .. "/times") or ""):gmatch "(%S+) (%S+)\n" do
    if not is_forgotten[name] then self.times[name] = tonumber(seconds) end
  end
end

function workshop:write_times()
  local lines = {}
  for name, seconds in pairs(self.times) do
    lines[#lines + 1] = ("%s %.2f\n"):format(name, seconds)
  end
  table.sort(lines)
  write(FOLDER .. "/times", table.concat(lines))
end

--- The text of a source, as the tree has it.
function workshop.source(path) return assert(read(path)) end

--- Gives a source of the copy this text.
function workshop.set(path, text) write(COPY .. "/" .. path, text) end

--- The name of a source's folder, without that of its wing: area for src/core/engine/area/area.c.
local function folder_of(path)
  return path:match "^src/desk/program" and "program" or path:match "^src/%w+/(%w+)/"
    or path:match "^src/%w+/(%w+)$" or path:match "^src/(%w+)"
end

--- The objects that a source is part of, those of its own folder first.
function workshop:objects(path)
  local own, others = {}, {}
  for _, object in ipairs(self.dependents[path] or {}) do
    if object:find("^src/lib%l+_" .. folder_of(path) .. "[_.]") then
      own[#own + 1] = object
    elseif not object:find "^tests/" then
      others[#others + 1] = object
    end
  end
  return own, others
end

--- Records the objects of a source without a mutant.
function workshop:note(path)
  local own, others = self:objects(path)
  for _, list in ipairs { own, others } do
    if #list > 0 then
      assert(build(list), "the build failed: see " .. LOG)
      for object, digest in pairs(digests_of(list)) do self.digests[object] = digest end
    end
  end
end

--- Whether objects differ from those without a mutant; nil when they cannot be built.
function workshop:is_different(objects)
  if #objects == 0 then return false end
  if not build(objects) then return nil end
  for object, digest in pairs(digests_of(objects)) do
    if digest ~= self.digests[object] then return true end
  end
  return false
end

--- The result of compiling the current mutant: "different", "equal" or "broken".
function workshop:compile(path)
  for _, objects in ipairs { self:objects(path) } do
    local is_different = self:is_different(objects)
    if is_different == nil then return "broken" end
    if is_different then return "different" end
  end
  return "equal"
end

--- Builds what tests need; returns whether it succeeded.
function workshop.prepare(tests)
  local targets, is_listed = {}, {}
  for _, test in ipairs(tests) do
    for _, target in ipairs(test.targets) do
      if not is_listed[target] then targets[#targets + 1] = target end
      is_listed[target] = true
    end
  end
  return build(targets)
end

--- Seconds, from the output of the shell's `times`: `0m1.25s`.
local function seconds_of(minutes, seconds) return 60 * tonumber(minutes) + tonumber(seconds) end

--- Runs a test for at most `limit` seconds of processor time, and several times as many by the
--- clock, because others may use the machine: "passed", "failed" or "late", and the processor time
--- used.
function workshop.run(test, limit)
  local scratch = "../scratch"
  local command = ("cd %s && rm -rf %s && mkdir %s && export TMPDIR=$PWD/%s && "
    .. "ulimit -v %d && ulimit -f %d && ulimit -c 0 && ulimit -t %d && "
    .. "{ timeout -k 2 %d %s >../log 2>&1; echo $?; times; }")
    :format(COPY, scratch, scratch, scratch, MOST_MEMORY, MOST_FILE, math.ceil(limit),
      math.ceil(60 + 20 * limit), test.command)
  local status, own_minutes, own, system_minutes, of_system = output_of(command)
    :match "^(%d+)\n[^\n]*\n(%d+)m([%d.]+)s (%d+)m([%d.]+)s"
  local seconds = seconds_of(own_minutes, own) + seconds_of(system_minutes, of_system)
  if status == "0" then return "passed", seconds end
  return (status == "124" or seconds >= limit) and "late" or "failed", seconds
end

--- Runs tests that were not yet run without a mutant, and records their times; nil and a message
--- when one fails. The copy contains no mutant.
function workshop:learn(tests)
  local unknown = {}
  for _, test in ipairs(tests) do
    if not self.times[test.name] then unknown[#unknown + 1] = test end
  end
  if #unknown == 0 then return true end
  if not self.prepare(unknown) then return nil, "the build failed: see " .. LOG end
  for _, test in ipairs(unknown) do
    local how, seconds = self.run(test, 1200)
    if how ~= "passed" then
      local what = how == "late" and "is late" or "fails"
      return nil, ("%s %s without a mutant"):format(test.name, what)
    end
    self.times[test.name] = seconds
    self:write_times()
  end
  return true
end

--- Whether all of these were run without a mutant.
function workshop:knows(tests)
  for _, test in ipairs(tests) do
    if not self.times[test.name] then return false end
  end
  return true
end

return workshop
