--- Templates of Open Job Description: compared with the specification (2023-09, with the extension
--- TASK_CHUNKING), and run as an engine would.
---
---   openjd.check(job)                 job: a template that was decoded; returns its fields
---   openjd.run(job, bench [, set])    set: values of parameters that somebody has changed
local assert = require "luassert"
local schema = require "tests.support.openjd_schema"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local openjd = {}

--- Compares a template with the specification, and with what celspan promises beyond it: every path
--- is absolute, and says what it is and which way it goes.
function openjd.check(job)
  local fields = schema.check(job)
  for _, one in ipairs(job.parameterDefinitions) do
    assert.is_truthy(one.default ~= nil, one.name)
    if one.type == "PATH" then
      assert.equal("/", one.default:sub(1, 1))
      assert.is_truthy(one.objectType and (one.dataFlow == "IN" or one.dataFlow == "OUT"), one.name)
    end
  end
  return fields
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
