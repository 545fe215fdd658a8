-- A copy of the tree where mutants are built and tested, in out/mutate: the tree itself is never
-- touched.
--
-- Objects are made with self-checks and without debugging information, so that what differs in an
-- object differs in the program. A file of the copy is written only when its text changes: builds
-- stay incremental, and a run that was killed leaves nothing that the next one does not see.
local system = require "tests.support.system"

local workshop = {}
workshop.__index = workshop

local FOLDER = "out/mutate"
local COPY, LOG = FOLDER .. "/tree", FOLDER .. "/log"
local OPTIONS = "-Dchecks=true -Ddebug=false -Doptimization=1 "
  .. "'-Dc_args=-Werror=incompatible-pointer-types -Werror=int-conversion "
  .. "-Werror=aggressive-loop-optimizations'" -- a loop beyond an array: no test need look for it
-- What a mutant may take before it is stopped: KiB of memory, and blocks of 512 bytes in a file.
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

--- Paths of the files that the tree at `root` is made of.
local function files_of(root)
  return lines_of(("cd %s && find . \\( -name .git -o -path './build*' -o -path ./out \\) -prune "
    .. "-o -type f -print"):format(quote(root)))
end

--- Makes the copy as the tree is; the paths that differed.
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

--- What meson tells of the copy: "tests" or "targets", as JSON without escapes.
local function told_by_meson(what)
  return assert(output_of(("meson introspect --%s %s/build"):format(what, COPY)))
end

--- The programs of the unit tests and the examples.
local function programs()
  local list = {}
  for words, name in told_by_meson("tests"):gmatch '"cmd": (%b[]).-"name": "(.-)"' do
    local command = {}
    for word in words:gmatch '"(.-)"' do command[#command + 1] = quote(word) end
    name = name:gsub("^example ", "example/"):gsub("[ ,]", "")
    list[#list + 1] = {
      name = name:find "/" and name or "unit/" .. name,
      command = table.concat(command, " "),
      targets = { words:match "/tree/build/(.-)\"" },
    }
  end
  return list
end

--- The specs, a test for each file. Each needs the programs and modules that are built by default.
local function specs()
  local list, targets = {}, {}
  for file in told_by_meson("targets"):gmatch '/tree/build/([^"]+)"%], "build_by_default": true' do
    if not file:find "%.a$" and not file:find "fuzz_" and not file:find "^subprojects/" then
      targets[#targets + 1] = file
    end
  end
  for _, path in ipairs(lines_of "ls tests/*/*_spec.lua") do
    list[#list + 1] = {
      name = path:match "tests/(.*)_spec%.lua$",
      command = "tests/support/busted.sh build --no-keep-going " .. path,
      targets = targets,
    }
  end
  return list
end

--- Runs ninja for targets of the copy, so many at a time (1); whether that went well.
local function build(targets, jobs)
  write(FOLDER .. "/list", table.concat(targets, "\n"))
  local command = "xargs ninja -C %s/build -j%s <%s/list >%s 2>&1"
  return os.execute(command:format(COPY, jobs or 1, FOLDER, LOG)) == true
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
  local tests = programs()
  for _, spec in ipairs(specs()) do tests[#tests + 1] = spec end
  local self = { dependents = read_dependents(), digests = {}, times = {}, tests = tests }
  setmetatable(self, workshop)
  self:read_times(changed)
  return self
end

--- The processor time of the tests that passed without a mutant, in seconds. That of a test is
--- forgotten when its source changes, all of them when anything else does.
function workshop:read_times(changed)
  local is_forgotten = {}
  for _, path in ipairs(changed) do
    local test = path:match "^%./tests/unit/test_([%w_]+)%.c$"
    local name = test and "unit/" .. test or path:match "^%./tests/([%w_/]+)_spec%.lua$"
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

local function folder_of(path) return path:match "^src/(%w+)/" end

--- The objects that a source is part of, those of its own folder first.
function workshop:objects(path)
  local own, others = {}, {}
  for _, object in ipairs(self.dependents[path] or {}) do
    if object:find("^src/libcs_" .. folder_of(path) .. "[_.]") then
      own[#own + 1] = object
    elseif not object:find "^tests/" then
      others[#others + 1] = object
    end
  end
  return own, others
end

--- Notes what the objects of a source are without a mutant.
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

--- What a mutant that was set compiles to: "different", "equal" or "broken".
function workshop:compile(path)
  for _, objects in ipairs { self:objects(path) } do
    local is_different = self:is_different(objects)
    if is_different == nil then return "broken" end
    if is_different then return "different" end
  end
  return "equal"
end

--- Builds what tests need; whether that went well.
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

--- Seconds, of what `times` of the shell tells: `0m1.25s`.
local function seconds_of(minutes, seconds) return 60 * tonumber(minutes) + tonumber(seconds) end

--- Runs a test for at most so many seconds of processor time, and many more by the clock, because
--- others may use the machine: "passed", "failed" or "late", and the processor time it took.
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

--- Runs tests that were not yet run without a mutant, and notes how long they take; nil and a
--- message when one fails. The copy holds no mutant.
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
