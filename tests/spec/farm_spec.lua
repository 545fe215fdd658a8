-- celspan farm: its script for Slurm is run as Slurm would run an array, and its template for Open
-- Job Description is compared with the specification (2023-09) and run with its parameters filled
-- in.
local json = require "celspan.json"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local FILM = [[
local celspan = require "celspan"
local radius = tonumber((...)) or 20
return celspan.film { size = { 60, 40 }, frames = 7, first = 3, frame = function(f)
  return celspan.rostrum { celspan.cel { celspan.circle { centre = { 5 * f.number, 20 },
    radius = radius, texture = "#c04030" } } }
end }
]]

local bench

before_each(function()
  bench = workbench.new()
  bench:write("film.lua", FILM)
end)
after_each(function() bench:remove() end)

local word = system.quote

--- In the folder of the bench.
local function shell(command)
  return bench:shell(("cd %s && CELSPAN=%s && export CELSPAN && %s"):format(word(bench.folder),
    word(workbench.absolute), command))
end

local function celspan(arguments) return shell('"$CELSPAN" ' .. arguments) end

local function done(arguments)
  local code, out, err = celspan(arguments)
  assert.equal(0, code, err)
  return out
end

local function refused(text, arguments)
  local code, out, err = celspan(arguments)
  assert.equal(2, code, err)
  assert.equal("", out)
  assert.is_truthy(err:find(text, 1, true), err)
end

--- The files of frames, without records.
local function frames_in(folder)
  local _, names = bench:shell("ls " .. word(bench.folder .. "/" .. folder))
  return (names:gsub("\n$", ""):gsub("\n", " "))
end

local function same(a, b) assert.equal(bench:read(a), bench:read(b), a .. " is not " .. b) end

-- ---------------------------------------------------------------- Slurm

local function slurm(arguments)
  bench:write("job.sh", done("farm film.lua --slurm " .. arguments))
  assert.equal(0, (shell "bash -n job.sh"))
  return bench:read "job.sh"
end

--- The exit status of a task's script. more: parts of the environment, such as the number of
--- requeues.
local function run_task(number, more, script)
  local place = word(bench.folder)
  return shell(("cd / && env SLURM_ARRAY_TASK_ID=%d SLURM_ARRAY_JOB_ID=7 SLURM_CPUS_ON_NODE=1 %s "
    .. 'PATH=%s:"$PATH" bash %s/job.sh %s'):format(number, more or "", place, place, script or ""))
end

local function directives(text)
  local found = {}
  for line in text:gmatch "#SBATCH %-%-([^\n]*)" do found[#found + 1] = line end
  return found
end

local function count_of(text) return tonumber(text:match "array=1%-(%d+)") end

describe("the script for Slurm", function()
  it("makes every frame once, whatever the chunk", function()
    done "render film.lua -o whole/####.png --progress none"
    for chunk, tasks in pairs { [1] = 7, [2] = 4, [3] = 3, [7] = 1, [100] = 1 } do
      os.execute("rm -rf " .. bench.folder .. "/out")
      assert.equal(tasks, count_of(slurm("-o out/####.png --chunk " .. chunk)))
      for i = 1, tasks do
        local before = #bench:files "out"
        local code, _, err = run_task(i)
        assert.equal(0, code, err)
        assert.is_true(#bench:files "out" > before, "a task without frames")
      end
      assert.equal("0003.png 0004.png 0005.png 0006.png 0007.png 0008.png 0009.png",
        frames_in "out")
      for i = 3, 9 do same(("out/%04d.png"):format(i), ("whole/%04d.png"):format(i)) end
    end
  end)

  it("passes options and arguments on, with quotes where necessary", function()
    local odd = [[it's "a" $HOME `id` \ * é]] .. "\n  end \nof it"
    assert.equal(true, os.execute("mkdir " .. word(bench.folder .. "/" .. odd)))
    local arguments = ("-o %s --frames 5,3 --size 30x20 --scale 0.5"):format(word(odd .. "/#.png"))
    refused("--size and --scale", "farm film.lua --slurm " .. arguments)
    arguments = arguments:gsub(" %-%-scale 0.5", "") .. " --limit time=9,memory=64M --allow "
      .. word(odd) .. " --background=#102030 --antialias none -- 7.5 " .. word(odd)
    assert.equal(1, count_of(slurm(arguments)))
    assert.equal(0, (run_task(1)))
    assert.equal("3.png 5.png", frames_in(odd))
    done("render film.lua -o whole/#.png --frames 5,3 --size 30x20 --background '#102030'"
      .. " --antialias none -- 7.5")
    same(odd .. "/5.png", "whole/5.png")
  end)

  it("passes on the options for the script's rights", function()
    slurm "-o out/#.png --frames 3"
    bench:write("film.lua", "assert(os.execute)\n" .. FILM)
    assert.equal(3, (run_task(1)))
    slurm "-o out/#.png --frames 3 --trust"
    assert.equal(0, (run_task(1)))
  end)

  it("requests the given resources, and nothing else", function()
    assert.same({ "job-name=film", "array=1-1", "requeue", "open-mode=append" },
      directives(slurm "-o out/#.png"))
    local text = slurm("-o out/#.png --job-name 'a b\n;c' --job-memory 900 --job-time 45"
      .. " --workers 3 --logs 'some logs%'")
    assert.same({ "job-name=a-b--c", "array=1-1", "requeue", "open-mode=append", "cpus-per-task=3",
                  "mem=900M", "time=45",
                  ('output="%s/some logs%%%%/%%x-%%A_%%a.log"'):format(bench.folder) },
      directives(text))
    local memory = "\nexport CELSPAN_MEMORY=${CELSPAN_MEMORY:-900M} # as --mem\n"
    assert.is_truthy(text:find(memory, 1, true), text)
    assert.is_nil(slurm "-o out/#.png":find("CELSPAN_MEMORY", 1, true))
    refused("--logs: Slurm takes no name", "farm film.lua -o o/#.png --slurm --logs 'a\"b'")
    refused("--logs: Slurm takes no name", "farm film.lua -o o/#.png --slurm --logs 'a\nb'")
  end)

  it("resumes where a task was stopped", function()
    slurm "-o out/#.png --chunk 4"
    run_task(1)
    os.remove(bench.folder .. "/out/4.png")
    local code, _, err = run_task(1)
    assert.equal(0, code)
    assert.is_truthy(bench:read "out/4.png")
    assert.is_truthy(err:find("2 kept", 1, true), err)
  end)

  it("requests another try if one may help, but not endlessly", function()
    slurm "-o out/#.png"
    bench:write("scontrol", '#!/bin/sh\necho "$@" >> scontrol.log\n')
    bench:write("sleep", "#!/bin/sh\necho slept >> scontrol.log\n") -- until Slurm ends it
    bench:write("fake", '#!/bin/sh\nexit "${FAKE}"\n')
    shell "chmod +x scontrol sleep fake"
    local function tries(code, more)
      os.remove(bench.folder .. "/scontrol.log")
      local got = run_task(1, ("FAKE=%d CELSPAN=%s %s"):format(code, word(bench.folder .. "/fake"),
        more or ""))
      return got, bench:read "scontrol.log"
    end
    for _, code in ipairs { 5, 33, 137 } do
      local got, log = tries(code)
      assert.equal(code, got)
      assert.equal("requeue 7_1\nslept\n", log)
      assert.same({ code }, { tries(code, "SLURM_RESTART_COUNT=3") })
    end
    for _, code in ipairs { 0, 1, 2, 3, 4, 6, 70, 143 } do
      assert.same({ code }, { tries(code) })
    end
  end)

  it("submits itself to the queue", function()
    slurm "-o out/#.png --logs 'my logs'"
    bench:write("sbatch",
      '#!/bin/sh\nprintf "%s|" "$@" >> sbatch.log\necho >> sbatch.log\necho 42\n')
    local function queue()
      os.remove(bench.folder .. "/sbatch.log")
      assert.equal(0, (shell 'chmod +x sbatch && PATH=.:"$PATH" bash job.sh'))
      return bench:read "sbatch.log"
    end
    assert.equal("job.sh|\n", queue())
    assert.same({}, bench:files "my logs")
    assert.equal(0, (shell "test -d 'my logs'"))
    slurm "-o one.png --frames 3 --size 60x600 --strips 2"
    assert.equal("--parsable|job.sh|\n--array=1|--dependency=afterok:42|--kill-on-invalid-dep=yes|"
      .. "job.sh|join|\n", queue())
  end)

  it("makes strips of a frame, and joins them", function()
    for _, ending in ipairs { "png", "tga", "span" } do
      local odd = "a 'b'/shot.####." .. ending
      local text = slurm("-o " .. word(odd) .. " --frames 4 --size 70x1100 --strips 3")
      assert.equal(3, count_of(text))
      for i = 1, 3 do
        local code, _, err = run_task(i)
        assert.equal(0, code, err)
      end
      local code, _, err = run_task(1, "", "join")
      assert.equal(0, code, err)
      done("render film.lua -o whole." .. ending .. " --frames 4 --size 70x1100")
      local joined = "a 'b'/shot.0004." .. ending
      if ending == "png" then
        assert.is_truthy(bench:read(joined):find("IEND", 1, true))
      else
        same(joined, "whole." .. ending)
      end
      os.remove(bench.folder .. "/" .. joined)
      assert.equal(0, (shell "env -u SLURM_ARRAY_TASK_ID bash job.sh join")) -- by hand
      assert.is_truthy(bench:read(joined))
    end
  end)

  it("warns about arrays that Slurm may not accept", function()
    bench:write("long.lua", FILM:gsub("frames = 7", "frames = 5000"))
    local _, _, err = celspan "farm long.lua -o out/#.png --slurm --chunk 2"
    assert.is_truthy(err:find("2500 tasks: Slurm takes arrays of 1000", 1, true), err)
    _, _, err = celspan "farm long.lua -o out/#.png --slurm --chunk 5"
    assert.equal("", err)
  end)
end)

-- ---------------------------------------------------------------- Open Job Description

local function template(arguments)
  local text = done("farm film.lua --openjd " .. arguments)
  return assert(json.decode(text)), text
end

--- Whether a table has only these fields; a name that ends in ? may be missing.
local function check_fields(value, names, where)
  local allowed = {}
  for name in names:gmatch "%S+" do
    local bare = name:gsub("%?$", "")
    allowed[bare] = true
    assert.is_true(name ~= bare or value[bare] ~= nil, where .. " lacks " .. bare)
  end
  for name in pairs(value) do assert.is_truthy(allowed[name], where .. " has " .. name) end
end

local function check_text(text, most, where, takes_controls)
  assert.equal("string", type(text), where)
  local length = assert(utf8.len(text), where)
  assert.is_true(length >= 1 and length <= most, where)
  assert.is_true(takes_controls or not text:find "%c", where)
end

local function check_identifier(text)
  assert.is_truthy(text:find "^[A-Za-z_][A-Za-z0-9_]*$" and #text <= 64, text)
end

--- 2.3 and 2.4
local function check_number(parameter)
  local value = parameter.default
  assert.is_true(parameter.type == "FLOAT" or math.type(value) == "integer", parameter.name)
  assert.equal("number", type(value))
  assert.is_true(value >= (parameter.minValue or value) and value <= (parameter.maxValue or value))
end

--- 2.1 and 2.5
local function check_string(parameter)
  assert.equal("string", type(parameter.default))
  assert.is_true(assert(utf8.len(parameter.default)) <= 1024, parameter.name)
  local is_allowed = not parameter.allowedValues
  for _, value in ipairs(parameter.allowedValues or {}) do
    is_allowed = is_allowed or value == parameter.default
  end
  assert.is_true(is_allowed, parameter.name)
end

--- 2.2
local function check_path(parameter)
  check_string(parameter)
  assert.is_truthy(({ FILE = true, DIRECTORY = true })[parameter.objectType])
  assert.is_truthy(({ IN = true, OUT = true })[parameter.dataFlow])
  assert.equal("/", parameter.default:sub(1, 1))
end

local KINDS = {
  STRING = { fields = "allowedValues?", check = check_string },
  PATH = { fields = "objectType dataFlow", check = check_path },
  INT = { fields = "minValue? maxValue?", check = check_number },
  FLOAT = { fields = "minValue? maxValue?", check = check_number },
}

--- 2
local function check_parameter(parameter)
  local where, kind = parameter.name, assert(KINDS[parameter.type], parameter.type)
  check_identifier(where)
  check_fields(parameter, "name type default description? userInterface? " .. kind.fields, where)
  kind.check(parameter)
  if parameter.description then check_text(parameter.description, 2048, where) end
  if parameter.userInterface then
    check_fields(parameter.userInterface, "groupLabel", where)
    check_text(parameter.userInterface.groupLabel, 64, where)
  end
end

--- 7.3: every {{...}} names something that exists.
local function check_format(text, known, where)
  for name in text:gmatch "{{(.-)}}" do assert.is_true(known[name], where .. ": " .. name) end
  assert.is_nil(text:gsub("{{.-}}", ""):find("{{", 1, true), where)
end

--- 3.5 and 5
local function check_script(script, known)
  check_fields(script, "actions", "script")
  check_fields(script.actions, "onRun", "actions")
  local action = script.actions.onRun
  check_fields(action, "command args timeout? cancelation", "onRun")
  check_text(action.command, 1000, "command")
  check_format(action.command, known, "command")
  for i, argument in ipairs(action.args) do
    check_text(argument, 10000, "argument " .. i)
    check_format(argument, known, "argument " .. i)
  end
  assert.equal("integer", math.type(action.timeout or 1))
  assert.is_true((action.timeout or 1) > 0)
  check_fields(action.cancelation, "mode notifyPeriodInSeconds", "cancelation")
  assert.equal("NOTIFY_THEN_TERMINATE", action.cancelation.mode)
  assert.is_true(action.cancelation.notifyPeriodInSeconds <= 600)
end

--- 3.4.1.5
local function check_chunks(chunks, known)
  check_fields(chunks, "defaultTaskCount rangeConstraint", "chunks")
  check_format(chunks.defaultTaskCount, known, "chunks")
  assert.equal("NONCONTIGUOUS", chunks.rangeConstraint)
end

--- 3.4
local function check_space(space, known, extensions)
  check_fields(space, "taskParameterDefinitions", "parameterSpace")
  assert.equal(1, #space.taskParameterDefinitions)
  local task = space.taskParameterDefinitions[1]
  check_identifier(task.name)
  check_format(task.range, known, "range")
  if extensions.TASK_CHUNKING then
    assert.equal("CHUNK[INT]", task.type)
    check_fields(task, "name type range chunks", "task parameter")
    check_chunks(task.chunks, known)
  else
    assert.equal("INT", task.type)
    check_fields(task, "name type range", "task parameter")
    assert.is_truthy(task.range:find "^{{" or task.range == "1" or task.range:find "^1%-%d+$")
  end
  known["Task.Param." .. task.name] = true
end

--- 3.3
local function check_requirements(needs)
  check_fields(needs, "amounts", "hostRequirements")
  for _, amount in ipairs(needs.amounts) do
    check_fields(amount, "name min", "amount")
    assert.is_truthy(amount.name == "amount.worker.vcpu" or amount.name == "amount.worker.memory")
    assert.is_true(amount.min > 0)
  end
end

--- 1.1
local function check_template(job)
  check_fields(job, "specificationVersion extensions? name description parameterDefinitions steps",
    "template")
  assert.equal("jobtemplate-2023-09", job.specificationVersion)
  assert.same({ "TASK_CHUNKING" }, job.extensions or { "TASK_CHUNKING" })
  local extensions = { TASK_CHUNKING = job.extensions ~= nil }
  check_text(job.name, 128, "name")
  check_format(job.name, {}, "name")
  check_text(job.description, 2048, "description")
  assert.is_true(#job.parameterDefinitions <= 50)
  local known, steps = {}, {}
  for _, parameter in ipairs(job.parameterDefinitions) do
    check_parameter(parameter)
    assert.is_nil(known["Param." .. parameter.name])
    known["Param." .. parameter.name] = true
  end
  for _, step in ipairs(job.steps) do
    check_fields(step, "name dependencies? hostRequirements? parameterSpace? script", "step")
    check_text(step.name, 64, "step")
    local own = setmetatable({}, { __index = known })
    for _, on in ipairs(step.dependencies or {}) do
      check_fields(on, "dependsOn", "dependency")
      assert.is_true(steps[on.dependsOn])
    end
    if step.hostRequirements then check_requirements(step.hostRequirements) end
    if step.parameterSpace then check_space(step.parameterSpace, own, extensions) end
    check_script(step.script, own)
    steps[step.name] = true
  end
end

--- 3.4.1.1.1: the numbers of a range, in increasing order; ranges must not overlap.
local function numbers_of(range)
  local list, seen = {}, {}
  for element in range:gmatch "[^,]+" do
    local first, last, step = element:match "^(%-?%d+)%-(%-?%d+):?(%d*)$"
    if not first then first, last, step = element, element, "" end
    for number = tonumber(first), tonumber(last), tonumber(step) or 1 do
      assert.is_nil(seen[number], range)
      list[#list + 1], seen[number] = number, true
    end
  end
  table.sort(list)
  return list
end

--- What the parameter of the tasks is in each of them.
local function tasks_of(task, values)
  if not task then return { "" } end
  local numbers, list = numbers_of((task.range:gsub("{{(.-)}}", values))), {}
  local most = task.chunks and tonumber((task.chunks.defaultTaskCount:gsub("{{(.-)}}", values)))
  for i = 1, #numbers, most or 1 do
    list[#list + 1] = table.concat(numbers, ",", i, math.min(#numbers, i + (most or 1) - 1))
  end
  return list
end

--- The commands of a step, one per line, as an engine would run them. set: values of parameters of
--- the job that somebody has changed.
local function commands_of(job, step, set)
  local values, commands = {}, {}
  for _, parameter in ipairs(job.parameterDefinitions) do
    local value = set and set[parameter.name] or parameter.default
    values["Param." .. parameter.name] = tostring(value)
  end
  values["Param.Celspan"] = workbench.absolute
  local task = step.parameterSpace and step.parameterSpace.taskParameterDefinitions[1]
  for i, value in ipairs(tasks_of(task, values)) do
    if task then values["Task.Param." .. task.name] = value end
    local action, words = step.script.actions.onRun, {}
    for _, text in ipairs { action.command, table.unpack(action.args) } do
      words[#words + 1] = word(text:gsub("{{(.-)}}", values))
    end
    commands[i] = "cd / && " .. table.concat(words, " ")
  end
  return commands
end

local function run_job(job, set)
  for _, step in ipairs(job.steps) do
    for _, command in ipairs(commands_of(job, step, set)) do
      local code, out, err = bench:shell(command)
      assert.equal(0, code, err)
      assert.is_truthy(step.name == "Join" or out:find("openjd_progress: 100", 1, true), out)
    end
  end
end

describe("the template of Open Job Description", function()
  it("makes every frame once", function()
    done "render film.lua -o whole/####.png --progress none"
    for chunk, tasks in pairs { [1] = 7, [3] = 3, [50] = 1 } do
      os.execute("rm -rf " .. bench.folder .. "/out")
      local job = template("-o out/####.png --chunk " .. chunk)
      check_template(job)
      assert.equal(tasks, #commands_of(job, job.steps[1]))
      run_job(job)
      for i = 3, 9 do same(("out/%04d.png"):format(i), ("whole/%04d.png"):format(i)) end
    end
  end)

  it("makes strips of a frame, and then joins them", function()
    local job = template "-o 'a b/one.span' --frames 4 --size 70x1100 --strips 3"
    check_template(job)
    assert.same({ { dependsOn = "Render" } }, job.steps[2].dependencies)
    run_job(job)
    done "render film.lua -o whole.span --frames 4 --size 70x1100"
    same("a b/one.span", "whole.span")
  end)

  it("passes options and arguments on, unusual ones as parameters", function()
    local odd = [[it's "a" $HOME {{x}} \ é]] .. "\nend"
    assert.equal(true, os.execute("mkdir " .. word(bench.folder .. "/" .. odd)))
    local job, text = template(("-o %s --frames 5,3 --size 30x20 --allow %s --limit time=9 "
      .. "--background=#102030 --job-memory 900 --job-time 2 --workers 2 --job-name %s -- 7.5 %s")
      :format(word(odd .. "/{{y}}.#.png"), word(odd), word "a{{b}}\nc", word(odd)))
    check_template(job)
    assert.is_truthy(text:find('"Text1"', 1, true))
    assert.equal("a--b--?c", job.name)
    assert.equal(120, job.steps[1].script.actions.onRun.timeout)
    assert.same({ { name = "amount.worker.vcpu", min = 2 },
                  { name = "amount.worker.memory", min = 900 } },
      job.steps[1].hostRequirements.amounts)
    run_job(job)
    done("render film.lua -o whole/#.png --frames 5,3 --size 30x20 --background '#102030' -- 7.5")
    same(odd .. "/{{y}}.5.png", "whole/5.png")
  end)

  it("refuses values that a template cannot contain", function()
    refused("has more than 1024 characters",
      "farm film.lua --openjd -o o/#.png -- " .. word("\n" .. ("x"):rep(1024)))
    refused("the template is UTF-8", "farm film.lua --openjd -o o/#.png -- '\xff'")
    local many = {}
    for i = 1, 48 do many[i] = word("{{" .. i) end
    refused("at most 50", "farm film.lua --openjd -o o/#.png -- " .. table.concat(many, " "))
  end)

  it("names frames by ranges, and in chunks only where a task has several", function()
    local job = template "-o o/#.png --frames 9,3,4,5,7 --chunk 2"
    check_template(job)
    local step = job.steps[1]
    assert.same({ "3,4", "5,7", "9" }, tasks_of(step.parameterSpace.taskParameterDefinitions[1],
      { ["Param.Frames"] = "3-5,7-9:2", ["Param.Chunk"] = "2" }))
    local by_name = {}
    for _, one in ipairs(job.parameterDefinitions) do by_name[one.name] = one.default end
    assert.equal("3-5,7,9", by_name.Frames)
    assert.equal(2, by_name.Chunk)
    run_job(job)
    assert.equal("3.png 4.png 5.png 7.png 9.png", frames_in "o")
    job = template "-o p/#.png --chunk 1 --frames 3-9:3"
    check_template(job)
    assert.is_nil(job.extensions)
    run_job(job, { Frames = "4-6:2,8" }) -- as somebody has changed it
    assert.equal("4.png 6.png 8.png", frames_in "p")
  end)

  it("offers what the script declares, and gives it to the tasks", function()
    bench:write("set.lua", [[
      local celspan = require "celspan"
      local p = celspan.parameters {
        radius = { 10, min = 1, max = 30, about = "Of the\ndisc", group = "Disc" },
        loud = false, mood = { "calm", "wild" }, at = { 9, 20, point = true },
        title = "", big = 1e9, [("x"):rep(64)] = 1 }
      return celspan.film { size = { 60, 40 }, frames = 2, frame = function()
        return celspan.rostrum { celspan.cel { celspan.circle { centre = p.at, radius = p.radius,
          texture = p.mood == "wild" and "#f00" or p.loud and "#0f0" or "#00f" } } }
      end }]])
    local arguments = "farm set.lua --openjd -o o/#.png --chunk 1 "
    local job = assert(json.decode(done(arguments .. "--set radius=5 --set loud=yes --set at=30,2")))
    check_template(job)
    local by_name = {}
    for _, one in ipairs(job.parameterDefinitions) do by_name[one.name] = one end
    assert.equal(5, by_name.Set_radius.default)
    assert.equal("FLOAT", by_name.Set_radius.type)
    assert.equal(30, by_name.Set_radius.maxValue)
    assert.equal("Of the?disc", by_name.Set_radius.description)
    assert.equal("Disc", by_name.Set_radius.userInterface.groupLabel)
    assert.equal("30,2", by_name.Set_at.default)
    assert.same({ "calm", "wild" }, by_name.Set_mood.allowedValues)
    run_job(job, { Set_radius = "7.5", Set_mood = "wild" })
    done "render set.lua -o w/#.png --set radius=7.5 --set mood=wild --set at=30,2"
    for i = 1, 2 do same(("o/%d.png"):format(i), ("w/%d.png"):format(i)) end
    bench:write("values.json", '{ "radius": 6 }')
    job = assert(json.decode(done(arguments .. "--set-from values.json --set mood=wild")))
    check_template(job)
    run_job(job)
    done "render set.lua -o w/#.png --set radius=6 --set mood=wild"
    same("o/2.png", "w/2.png")
  end)

  it("names the script's folder, and files elsewhere", function()
    assert.equal(true, os.execute(("mkdir -p %s/scene %s/far"):format(word(bench.folder),
      word(bench.folder))))
    bench:write("far/part.lua", "return 7")
    bench:write("scene/near.lua", "return 8")
    bench:write("scene/film.lua", 'require "near" require "part"\n' .. FILM)
    local function paths(options)
      local text = done("farm scene/film.lua --openjd -o out/#.png " .. options)
      local job, list = assert(json.decode(text)), {}
      check_template(job)
      for _, one in ipairs(job.parameterDefinitions) do
        if one.dataFlow == "IN" then
          list[#list + 1] = one.name .. " " .. one.default:sub(#bench.folder + 2)
        end
      end
      return table.concat(list, ", ")
    end
    local code, out, err = shell("CELSPAN_PATH=" .. word(bench.folder .. "/far/?.lua")
      .. ' "$CELSPAN" farm scene/film.lua --openjd -o out/#.png')
    assert.equal(0, code, err)
    assert.is_truthy(out:find("far/part.lua", 1, true), out)
    bench:write("scene/film.lua", 'require "near"\n' .. FILM)
    assert.equal("Script scene/film.lua, Folder scene", paths "")
    assert.equal("Script scene/film.lua, Folder scene, Allow1 far", paths "--allow far")
  end)
end)

-- ---------------------------------------------------------------- tables

local TABLE = "name,radius\nred,5\nblue,12\n\"the 'big' one\",30\n"

describe("a job of a table", function()
  before_each(function()
    bench:write("set.lua", [[
      local celspan = require "celspan"
      local p = celspan.parameters { radius = 10 }
      return celspan.film { size = { 60, 40 }, frames = 2, frame = function(f)
        return celspan.rostrum { celspan.cel { celspan.circle { centre = { 20 * f.number, 20 },
          radius = p.radius, texture = "#c04030" } } }
      end }]])
    bench:write("night.csv", TABLE)
    done "render set.lua -o 'w/{name}/#.png' --table night.csv"
  end)

  local function check_films(folder)
    for _, name in ipairs { "red", "blue", "the 'big' one" } do
      for i = 1, 2 do
        same(("%s/%s/%d.png"):format(folder, name, i), ("w/%s/%d.png"):format(name, i))
      end
    end
  end

  local OPTIONS = "farm set.lua -o '%s/{name}/#.png' --table night.csv "

  it("makes every film once, by each way", function()
    bench:write("lines.sh", done(OPTIONS:format "a" .. "--commands"))
    assert.equal(3, select(2, bench:read "lines.sh":gsub("\n", "")))
    assert.equal(0, (shell "sh lines.sh"))
    check_films "a"
    bench:write("job.sh", done(OPTIONS:format "b" .. "--slurm --chunk 2"))
    assert.equal(2, count_of(bench:read "job.sh"))
    for i = 1, 2 do
      local before = #bench:files "b"
      local code, _, err = run_task(i)
      assert.equal(0, code, err)
      assert.is_true(#bench:files "b" > before)
    end
    check_films "b"
    local job = assert(json.decode(done(OPTIONS:format "c" .. "--openjd")))
    check_template(job)
    assert.equal("3 films of set.lua in 3 tasks", job.description:match "^(.-),")
    run_job(job)
    check_films "c"
  end)

  it("makes the rows of its task, and checks all", function()
    local function task(share)
      local _, _, err = celspan("render set.lua -o 'd/{name}.png' --frames 1 --table night.csv "
        .. "--task " .. share)
      return err
    end
    assert.is_truthy(task "1/3":find("1/1 d/red.png", 1, true))
    assert.is_truthy(task "2/2":find("2/2 d/the 'big' one.png", 1, true))
    assert.is_truthy(task "1/9":find("task 1 of 9 has no rows", 1, true))
    bench:write("night.csv", TABLE:gsub("30", "x"))
    assert.is_truthy(task "1/3":find("line 4", 1, true))
    refused("line 4", OPTIONS:format "a" .. "--commands")
  end)

  it("may make videos, and no strips", function()
    assert.is_truthy(done("farm set.lua -o '{name}.mp4' --table night.csv --commands --quality 9")
      :find("--table night.csv --quality 9", 1, true))
    refused("--table divides its rows", OPTIONS:format "a" .. "--commands --strips 2")
    bench:write("same.csv", "radius\n5\n12\n")
    refused("lines 2 and 3 would both make", "farm set.lua -o o.mp4 --table same.csv --slurm")
    local code, _, err = celspan "farm set.lua -o '{name}.mp4' --table no.csv --slurm"
    assert.equal(4, code)
    assert.is_truthy(err:find("no.csv", 1, true))
  end)
end)

-- ---------------------------------------------------------------- commands

describe("the commands of a job", function()
  it("make every frame once, on whatever runs lines", function()
    done "render film.lua -o all/#.png"
    local lines = done "farm film.lua -o o/#.png --commands --chunk 2 --workers 1"
    assert.equal(4, select(2, lines:gsub("\n", "")))
    bench:write("lines.sh", lines)
    assert.equal(0, (shell "sh lines.sh"))
    assert.equal(frames_in "all", frames_in "o")
    for name in frames_in("all"):gmatch "%S+" do same("all/" .. name, "o/" .. name) end
  end)

  it("make strips of a frame, and join them", function()
    local options = "film.lua --frames 3 --size 60x700 -- 7"
    done("render -o whole.tga " .. options)
    bench:write("lines.sh", done("farm -o one.tga --commands --strips 2 " .. options))
    assert.equal(0, (shell "sh lines.sh"))
    same("whole.tga", "one.tga")
  end)

  it("need one line each", function()
    refused("has control characters", "farm film.lua -o o/#.png --commands -- 'a\nb'")
  end)
end)

describe("celspan farm", function()
  it("refuses more options than a task accepts, and names that are too long", function()
    refused("--scale: there are more than 128 options",
      "farm film.lua --slurm -o out/####.png" .. (" --scale 1"):rep(129))
    refused("the name is too long", "farm film.lua --slurm -o " .. ("x/"):rep(2100) .. "####.png")
  end)

  it("ends with 4 in a folder that was deleted", function()
    local code, _, err =
      shell('mkdir gone && cd gone && rmdir ../gone && "$CELSPAN" farm ../film.lua --slurm -o '
      .. 'out/####.png')
    assert.equal(4, code)
    assert.is_truthy(err:find("the current folder has no name: No such file or directory", 1, true),
      err)
  end)

  it("refuses impossible options before it makes a job", function()
    refused("-o is missing", "farm film.lua --slurm")
    refused("for which farm?", "farm film.lua -o o/#.png")
    refused("for which farm?", "farm film.lua -o o/#.png --slurm --openjd")
    refused("give one of them", "farm film.lua -o o/#.png --slurm --chunk 2 --strips 2")
    refused("--chunk: '0'", "farm film.lua -o o/#.png --slurm --chunk 0")
    refused("a farm makes files", "farm film.lua -o - --slurm")
    refused("a farm makes files", "farm film.lua -o o.mp4 --slurm")
    refused("several frames (7) need a number", "farm film.lua -o o.png --slurm")
    refused("frame 99", "farm film.lua -o o/#.png --frames 99 --slurm")
    refused("there are 7", "farm film.lua -o o/#.png --strips 2 --slurm")
    refused("makes at most 3",
      "farm film.lua -o o.png --frames 3 --size 60x700 --strips 4 --slurm")
    refused("at most 1000 strips", "farm film.lua -o o.png --frames 3 --strips 1001 --slurm")
    refused("unknown option '--resume'", "farm film.lua -o o/#.png --slurm --resume")
    bench:write("bad.lua", "error 'bad'")
    assert.equal(3, (celspan "farm bad.lua -o o/#.png --slurm"))
    assert.equal(4, (celspan "farm none.lua -o o/#.png --slurm"))
  end)

  it("refuses formats whose strips cannot be joined", function()
    local code, _, err =
      celspan "farm film.lua -o o.exr --frames 3 --size 60x700 --strips 2 --slurm"
    assert.equal(2, code)
    assert.is_truthy(err:find("PNG, Targa or span", 1, true), err)
  end)
end)
