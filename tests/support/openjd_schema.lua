--- The objects of a job template of Open Job Description, as a table that was written from the
--- specification alone ("Template Schemas, 2023-09"), with all that the extension TASK_CHUNKING
--- adds. The numbers are its sections.
---
---   schema.check(job)     raises where a template that was decoded breaks a rule; returns the
---                         paths of all its fields, as keys: "steps.script.actions"
---
--- A rule is a function (value, place): place.path says where the value is, and place.names which
--- values a format string may name there. Members whose names end in ? may be missing.
local schema = {}

local function fail(place, ...) error(place.path .. ": " .. (...):format(select(2, ...)), 0) end

local function require_that(is_so, place, ...)
  if not is_so then fail(place, ...) end
end

-- ---------------------------------------------------------------- values

--- 9: C0, DEL and C1.
local function has_controls(text) return text:find "%c" or text:find "\xC2[\x80-\x9F]" end

--- least, most: characters; takes_controls: newlines and others may be in it.
local function text(least, most, takes_controls)
  return function(value, place)
    require_that(type(value) == "string", place, "is not a string")
    local length = utf8.len(value)
    require_that(length, place, "is not UTF-8")
    require_that(length >= least and length <= most, place, "has %d characters", length)
    require_that(takes_controls or not has_controls(value), place, "has control characters")
  end
end

--- 7.3: braces come in pairs, around the name of a value that is known there. The limit is held
--- against the text before values are put in.
local function format_string(least, most, takes_controls)
  local check = text(least, most, takes_controls)
  return function(value, place)
    check(value, place)
    local rest = value:gsub("{{ *(.-) *}}", function(name)
      require_that(place.names[name], place, "names %s, which is not there", name)
      return ""
    end)
    require_that(not rest:find "{{" and not rest:find "}}", place, "has unpaired braces")
  end
end

local function one_of(...)
  local allowed = {}
  for _, value in ipairs { ... } do allowed[value] = true end
  return function(value, place)
    require_that(allowed[value], place, "is %s", tostring(value))
  end
end

--- A number, or a text that is one; kind: "integer" or "number".
local function number(kind, least, most)
  return function(value, place)
    local read = math.tointeger(value) or tonumber(value)
    local is_read = read and (kind == "number" or math.type(read) == "integer")
    require_that(is_read, place, "is no %s", kind)
    require_that(read >= (least or read) and read <= (most or read), place, "is %s", value)
  end
end

--- A number, and no text: those of 3.3.1 and 5 are texts only with FEATURE_BUNDLE_1.
local function bare(kind, least, most)
  local check = number(kind, least, most)
  return function(value, place)
    require_that(type(value) == "number", place, "is a text")
    check(value, place)
  end
end

local function list(rule, least, most)
  return function(value, place)
    require_that(type(value) == "table", place, "is no list")
    local count = 0
    for _ in pairs(value) do count = count + 1 end
    require_that(count == #value, place, "is no list")
    require_that(count >= least and count <= (most or count), place, "has %d elements", count)
    for _, one in ipairs(value) do rule(one, place) end
  end
end

--- An object with these members and no others.
local function object(members)
  local rules, required = {}, {}
  for name, rule in pairs(members) do
    local bare_name = name:gsub("%?$", "")
    rules[bare_name], required[bare_name] = rule, name == bare_name or nil
  end
  return function(value, place)
    require_that(type(value) == "table", place, "is no object")
    local path = place.path
    for name in pairs(required) do require_that(value[name] ~= nil, place, "lacks %s", name) end
    for name, member in pairs(value) do
      require_that(rules[name], place, "has %s", tostring(name))
      place.path = path == "" and name or path .. "." .. name
      place.seen[place.path] = true
      rules[name](member, place)
    end
    place.path = path
  end
end

--- The object that a member says it is.
local function by_member(name, kinds)
  return function(value, place)
    local kind = type(value) == "table" and kinds[value[name]]
    require_that(kind, place, "has an unknown %s", name)
    kind(value, place)
  end
end

--- An object with a condition that holds between its members.
local function with(rule, condition)
  return function(value, place)
    rule(value, place)
    condition(value, place)
  end
end

-- ---------------------------------------------------------------- names and texts

--- 7.1
local function identifier(value, place)
  text(1, 64)(value, place)
  require_that(value:find "^[A-Za-z_][A-Za-z0-9_]*$", place, "is no identifier")
end

--- 7.2: of the control characters, only these three.
local function description(value, place)
  text(1, 2048, true)(value, place)
  require_that(not has_controls(value:gsub("[\n\r\t]", "")), place, "has control characters")
end

local value_text = text(0, 1024, true) -- 2.5
local label = text(1, 64)              -- 2.6
local step_name = text(1, 64)          -- 3.1

-- ---------------------------------------------------------------- 2: parameters of the job

--- Whether the default keeps the rules of its own parameter.
local function check_default(parameter, place)
  local value, is_allowed = parameter.default, not parameter.allowedValues
  if value == nil then return end
  for _, one in ipairs(parameter.allowedValues or {}) do is_allowed = is_allowed or one == value end
  require_that(is_allowed, place, "%s: its default is not allowed", parameter.name)
  local size = parameter.type == "INT" or parameter.type == "FLOAT"
  local measure = size and tonumber(value) or utf8.len(value)
  local least = parameter.minValue or parameter.minLength or measure
  local most = parameter.maxValue or parameter.maxLength or measure
  require_that(measure >= tonumber(least) and measure <= tonumber(most), place,
    "%s: its default is out of its range", parameter.name)
end

local function interface(controls, more)
  local members = { ["control?"] = one_of(table.unpack(controls)), ["label?"] = label,
                    ["groupLabel?"] = label }
  for name, rule in pairs(more or {}) do members[name] = rule end
  return object(members)
end

local function parameter(type_name, value, members)
  members.name, members.type, members["description?"] = identifier, one_of(type_name), description
  members["default?"], members["allowedValues?"] = value, list(value, 1)
  return with(object(members), check_default)
end

local whole, real = number "integer", number "number"

local file_filter = object { label = label, patterns = list(text(1, 20), 1) } -- 2.7

local job_parameter = by_member("type", {
  STRING = parameter("STRING", value_text, { -- 2.1
    ["minLength?"] = whole, ["maxLength?"] = whole,
    ["userInterface?"] = interface { "LINE_EDIT", "MULTILINE_EDIT", "DROPDOWN_LIST", "CHECK_BOX",
                                     "HIDDEN" } }),
  PATH = parameter("PATH", value_text, { -- 2.2
    ["minLength?"] = whole, ["maxLength?"] = whole,
    ["objectType?"] = one_of("FILE", "DIRECTORY"),
    ["dataFlow?"] = one_of("NONE", "IN", "OUT", "INOUT"),
    ["userInterface?"] = interface({ "CHOOSE_INPUT_FILE", "CHOOSE_OUTPUT_FILE",
                                     "CHOOSE_DIRECTORY", "DROPDOWN_LIST", "HIDDEN" },
      { ["fileFilters?"] = list(file_filter, 1, 20), ["fileFilterDefault?"] = file_filter }) }),
  INT = parameter("INT", whole, { -- 2.3
    ["minValue?"] = whole, ["maxValue?"] = whole,
    ["userInterface?"] = interface({ "SPIN_BOX", "DROPDOWN_LIST", "HIDDEN" },
      { ["singleStepDelta?"] = number("integer", 1) }) }),
  FLOAT = parameter("FLOAT", real, { -- 2.4
    ["minValue?"] = real, ["maxValue?"] = real,
    ["userInterface?"] = interface({ "SPIN_BOX", "DROPDOWN_LIST", "HIDDEN" },
      { ["decimals?"] = whole, ["singleStepDelta?"] = real }) }),
})

-- ---------------------------------------------------------------- 3: steps

--- 3.3.1: a dotted name, of which the first part after "amount." may be reserved.
local AMOUNTS = { ["amount.worker.vcpu"] = 1, ["amount.worker.memory"] = 0,
                  ["amount.worker.gpu"] = 0, ["amount.worker.gpu.memory"] = 0,
                  ["amount.worker.disk.scratch"] = 0 }

local amount = with(object { name = text(1, 100), ["min?"] = bare("number", 0),
                             ["max?"] = bare("number", 0) }, function(value, place)
  require_that(AMOUNTS[value.name], place, "%s is not defined", value.name)
  require_that(value.min or value.max, place, "has neither min nor max")
  require_that((value.min or 1) >= AMOUNTS[value.name], place, "%s is too small", value.name)
end)

local attribute = object { name = text(1, 100), ["anyOf?"] = list(format_string(1, 100), 1, 50),
                           ["allOf?"] = list(format_string(1, 100), 1, 50) } -- 3.3.2

local requirements = with(object { ["amounts?"] = list(amount, 0, 50),
                                   ["attributes?"] = list(attribute, 0, 50) }, -- 3.3
  function(value, place)
    local names = {}
    for _, one in ipairs(value.amounts or {}) do
      require_that(not names[one.name], place, "%s is there twice", one.name)
      names[one.name] = true
    end
    require_that(value.amounts or value.attributes, place, "has neither")
  end)

--- 3.4.1.1.1: a list of numbers and ranges, or a value that is known when the job is made.
local function range_expression(value, place)
  if type(value) == "table" then return list(whole, 1, 1024)(value, place) end
  format_string(1, math.huge)(value, place)
  if value:find "{{" then return end
  for element in (value .. ","):gmatch "([^,]*)," do
    local bare_element = element:gsub("[ \t]", "")
    require_that(bare_element:find "^%-?%d+$" or bare_element:find "^%-?%d+%-%-?%d+$"
      or bare_element:find "^%-?%d+%-%-?%d+:%-?%d+$", place, "'%s' is no range", element)
  end
end

--- 3.4.1.5
local function chunk_count(value, place)
  if type(value) == "string" and value:find "{{" then
    return format_string(1, 1024)(value, place)
  end
  number("integer", 1)(value, place)
end

local task_parameter = by_member("type", {
  INT = object { name = identifier, type = one_of "INT", range = range_expression }, -- 3.4.1.1
  ["CHUNK[INT]"] = with(object { name = identifier, type = one_of "CHUNK[INT]",
    range = range_expression,
    chunks = object { defaultTaskCount = chunk_count, ["targetRuntimeSeconds?"] = whole,
                      rangeConstraint = one_of("CONTIGUOUS", "NONCONTIGUOUS") } },
    function(_, place)
      require_that(place.extensions.TASK_CHUNKING, place, "needs TASK_CHUNKING")
    end),
})

local space = object { taskParameterDefinitions = list(task_parameter, 1, 16), -- 3.4
                       ["combination?"] = text(1, 1280) }

-- ---------------------------------------------------------------- 5: actions

local cancelation = by_member("mode", {
  TERMINATE = object { mode = one_of "TERMINATE" },
  NOTIFY_THEN_TERMINATE = object { mode = one_of "NOTIFY_THEN_TERMINATE",
                                   ["notifyPeriodInSeconds?"] = bare("integer", 1, 600) },
})

local action = object {
  command = format_string(1, math.huge),
  ["args?"] = list(format_string(0, math.huge), 0),
  ["timeout?"] = bare("integer", 1),
  ["cancelation?"] = cancelation,
}

local script = object { actions = object { onRun = action } } -- 3.5

--- On the host, all parameters have values; in the rest of the template, those of type PATH have
--- only their raw ones (7.3.1).
local function on_host(rule)
  return function(value, place)
    local names = place.names
    place.names = setmetatable({ ["Session.WorkingDirectory"] = true }, { __index = place.host })
    rule(value, place)
    place.names = names
  end
end

local step_members = {
  name = step_name,
  ["description?"] = description,
  ["dependencies?"] = list(object { dependsOn = step_name }, 1),
  ["hostRequirements?"] = requirements,
  ["parameterSpace?"] = space,
  script = on_host(script),
}

--- 3: the parameters of tasks are known in the script of their step.
local function step(value, place)
  local host = place.host
  place.host = setmetatable({}, { __index = host })
  local parameters = value.parameterSpace and value.parameterSpace.taskParameterDefinitions or {}
  for _, one in ipairs(parameters) do
    place.host["Task.Param." .. one.name], place.host["Task.RawParam." .. one.name] = true, true
  end
  object(step_members)(value, place)
  for _, one in ipairs(value.dependencies or {}) do
    require_that(place.steps[one.dependsOn], place, "depends on %s, which is not there",
      one.dependsOn)
  end
  require_that(not place.steps[value.name], place, "%s is there twice", value.name)
  place.steps[value.name], place.host = true, host
end

-- ---------------------------------------------------------------- 1: the template

local function extension(value, place)
  text(3, 128)(value, place)
  require_that(value:find "^[A-Z_0-9]+$", place, "is no name of an extension")
end

local template = object {
  specificationVersion = one_of "jobtemplate-2023-09",
  ["$schema?"] = text(0, math.huge),
  ["extensions?"] = list(extension, 1),
  name = format_string(1, 128),
  ["description?"] = description,
  ["parameterDefinitions?"] = list(job_parameter, 1, 50),
  steps = list(step, 1),
}

function schema.check(job)
  local place = { path = "", seen = {}, names = {}, host = {}, steps = {}, extensions = {} }
  for _, name in ipairs(job.extensions or {}) do place.extensions[name] = true end
  for _, one in ipairs(job.parameterDefinitions or {}) do
    require_that(not place.host["Param." .. one.name], place, "%s is there twice", one.name)
    place.names["RawParam." .. one.name], place.host["RawParam." .. one.name] = true, true
    place.names["Param." .. one.name] = one.type ~= "PATH" or nil
    place.host["Param." .. one.name] = true
  end
  template(job, place)
  return place.seen
end

return schema
