--- Templates of Open Job Description: compared with the specification (2023-09, with the extension
--- TASK_CHUNKING), and run as an engine would. The numbers are sections of "Template Schemas".
---
---   openjd.check(job)                 job: a template that was decoded
---   openjd.run(job, bench [, set])    set: values of parameters that somebody has changed
local assert = require "luassert"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local openjd = {}

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
function openjd.check(job)
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
function openjd.tasks_of(task, values)
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
function openjd.commands_of(job, step, set)
  local values, commands = {}, {}
  for _, parameter in ipairs(job.parameterDefinitions) do
    local value = set and set[parameter.name] or parameter.default
    values["Param." .. parameter.name] = tostring(value)
  end
  values["Param.Celspan"] = workbench.absolute
  local task = step.parameterSpace and step.parameterSpace.taskParameterDefinitions[1]
  for i, value in ipairs(openjd.tasks_of(task, values)) do
    if task then values["Task.Param." .. task.name] = value end
    local action, words = step.script.actions.onRun, {}
    for _, text in ipairs { action.command, table.unpack(action.args) } do
      words[#words + 1] = system.quote(text:gsub("{{(.-)}}", values))
    end
    commands[i] = "cd / && " .. table.concat(words, " ")
  end
  return commands
end

function openjd.run(job, bench, set)
  for _, step in ipairs(job.steps) do
    for _, command in ipairs(openjd.commands_of(job, step, set)) do
      local code, out, err = bench:shell(command)
      assert.equal(0, code, err)
      assert.is_truthy(step.name == "Join" or out:find("openjd_progress: 100", 1, true), out)
    end
  end
end

return openjd
