--- celspan farm --openjd: a template of Open Job Description, 2023-09, in JSON.
--
-- What a farm copies to its machines, or maps, is a parameter of type PATH; what people change from
-- job to job is a parameter too: the frames, the size of a task, what the script declares.
--
--   Celspan Script Folder Output    the program; the script and its folder; where frames go
--   Log                             the folder of the logs of --log
--   Frames Chunk                    which frames, and how many a task makes
--   Table Ocio OcioFolder           of --table and --ocio, and the folder with its tables
--   Set_NAME                        of the script's parameter NAME
--   File1 ... Allow1 ...            files outside of the script's folder; folders of --allow
--   Text1 ...                       arguments that a template cannot contain as they are
--
-- Sources: "Template Schemas, 2023-09" of the specification; the numbers below are its sections.
local program, opened, job, names = ...
local json = require "celspan.json"

local MOST_PARAMETERS, MOST_TEXT, MOST_NAME = 50, 1024, 128 -- 1.1, 2.5, 1.1.1
local MOST_FILE = 255 -- bytes of the name of a file
local MOST_ABOUT, MOST_LABEL, MOST_IDENTIFIER = 2048, 64, 64 -- 7.2, 2.6, 7.1

local counts_frames = not job.strips and not job.rows -- or it counts strips, or parts of rows

local function split(path) return path:match "^(.*)/([^/]*)$" end

local function absolute(path) return names.absolute(path, job.folder) end

--- A text without control characters, cut to this number of characters.
local function short(text, most)
  local line = names.plain(text)
  local cut = utf8.len(line) and utf8.offset(line, most + 1)
  return cut and line:sub(1, cut - 1) or line
end

-- ---------------------------------------------------------------- parameters

--- The parameters of the job; each is added when it is needed.
local parameters = { list = {}, counts = {}, texts = {} }

--- more: members after the default. Returns the text that stands for the value.
function parameters:add(name, kind, default, more)
  local members = { { "name", name }, { "type", kind }, { "default", default } }
  table.move(more or {}, 1, #(more or {}), #members + 1, members)
  table.insert(self.list, members)
  if type(default) == "string" and (utf8.len(default) or 0) > MOST_TEXT then
    self.fault = ("%s has more than %d characters"):format(name, MOST_TEXT)
  end
  return ("{{Param.%s}}"):format(name)
end

--- The name of the next of several parameters of a kind: Allow1, Allow2.
function parameters:numbered(kind)
  self.counts[kind] = (self.counts[kind] or 0) + 1
  return kind .. self.counts[kind]
end

--- A file, or else a folder, that tasks read or write.
function parameters:add_path(name, path, object, flow)
  return self:add(name, "PATH", path, { { "objectType", object }, { "dataFlow", flow } })
end

--- A text as an argument, which may contain neither control characters nor pairs of braces, whether
--- they open or close.
function parameters:argument(text)
  if names.plain(text) == text and not text:find "{{" and not text:find "}}" then return text end
  self.texts[text] = self.texts[text] or self:add(self:numbered "Text", "STRING", text)
  return self.texts[text]
end

-- ---------------------------------------------------------------- what the script declares

local KINDS = { number = "FLOAT", boolean = "STRING", string = "STRING", array = "STRING" }

--- The value of a parameter as the type of the template has it: a text of --set, or the default.
local function value_of(one, value)
  if type(value) == "table" then return ("%.14g,%.14g"):format(value[1], value[2]) end
  return KINDS[one.type] == "FLOAT" and tonumber(value) or tostring(value)
end

--- The values that a text may have; nil: any.
local function choices_of(one)
  local list = one.type == "boolean" and { "true", "false" } or one.enum
  return list and { list = list }
end

--- Whether a value is one of the choices, all of which a template can contain. --set takes other
--- words for true.
local function is_among(choices, value)
  local is_there = false
  for _, choice in ipairs(choices and choices.list or {}) do
    if (utf8.len(choice) or MOST_TEXT + 1) > MOST_TEXT then return false end
    is_there = is_there or choice == value
  end
  return is_there
end

--- The members of the description of a parameter after its default; value: the default.
local function members_of(one, value)
  local members, interface, choices = {}, {}, choices_of(one)
  local function add(name, member)
    if member ~= nil then members[#members + 1] = { name, member } end
  end
  local about = one.description or ""
  add("description", about ~= "" and short(about, MOST_ABOUT) or nil)
  if is_among(choices, value) then add("allowedValues", choices) end
  if KINDS[one.type] ~= "STRING" then
    add("minValue", one.minimum)
    add("maxValue", one.maximum)
  end
  if one.group and one.group ~= "" then
    interface[1] = { "groupLabel", short(one.group, MOST_LABEL) }
    add("userInterface", interface)
  end
  return members
end

--- The values that --set gives, by the names of parameters; the last one counts.
local function given_values()
  local values = {}
  for _, option in ipairs(job.options) do
    if option.name == "--set" then
      local name, value = option.value:match "^(.-)=(.*)$"
      values[name] = value
    end
  end
  return values
end

--- Names of parameters: all of --set, and, if there is room for all and neither --set-from nor
--- --table gives values, the others too. files: how many other parameters there will be. Returns
--- them with what the script declares of each.
local function offered(given, files)
  local declared = json.decode(opened:ask("celspan.parameters", "schema", "")).properties
  local all, some = {}, {}
  for name in pairs(declared) do
    if #name + #"Set_" <= MOST_IDENTIFIER then
      all[#all + 1] = name
      if given[name] then some[#some + 1] = name end
    end
  end
  local room = MOST_PARAMETERS - #parameters.list - #job.options - #job.arguments
    - files
  local list = (job.has_values or #all > room) and some or all
  table.sort(list)
  return list, declared
end

--- Adds --set for the script's parameters, each of which is a parameter of the job.
local function add_settings(arguments, files)
  local given = given_values()
  local list, declared = offered(given, files)
  for _, name in ipairs(list) do
    local one, text = declared[name], given[name]
    local value = value_of(one, text or one.default)
    arguments[#arguments + 1] = "--set"
    arguments[#arguments + 1] = name .. "=" .. parameters:add("Set_" .. name, KINDS[one.type],
      value, members_of(one, value))
    given[name] = nil
  end
  for name, value in pairs(given) do -- names that are too long for the template
    table.move({ "--set", parameters:argument(name .. "=" .. value) }, 1, 2, #arguments + 1,
      arguments)
  end
end

-- ---------------------------------------------------------------- what tasks read

--- The folders that are parameters, by which files are copied or mapped.
local folders = {}

local function add_folder(name, path)
  folders[#folders + 1] = program.resolve(path) or path
  return parameters:add_path(name, path, "DIRECTORY", "IN")
end

local function is_in_folders(path)
  local real = program.resolve(path) or path
  for _, folder in ipairs(folders) do
    if program.is_within(folder, real) then return true end
  end
  return false
end

--- Builds the frames, so that the film says which files it reads. What fails is left to its task.
--- Of a table, which has videos, the film with the script's own values is read.
local function build()
  for i = 1, job.numbers and #job.numbers or opened.frames do
    if program.is_stopped() then return end
    local number = job.numbers and job.numbers[i] or opened.first + i - 1
    if opened:try(number) then opened:faults(function() end) end
  end
  if program.output(job.output) == "videos" then opened:check_tracks(true) end
end

--- The files that the film reads outside of the folders that are parameters.
local function find_files()
  program.until_stopped(build)
  local paths = {}
  for path in opened:files():gmatch "%+(%Z+)%z" do
    local full = absolute(path)
    if program.entries(full) == false and not paths[full] and not is_in_folders(full) then
      paths[full] = true
      paths[#paths + 1] = full
    end
  end
  table.sort(paths)
  return paths
end

local function add_files(paths)
  for _, path in ipairs(paths) do
    parameters:add_path(parameters:numbered "File", path, "FILE", "IN")
  end
end

-- ---------------------------------------------------------------- steps

--- Options that are parameters of the job, and are added by themselves.
local OWN = { ["--set"] = true, ["--table"] = true }

--- The configuration of --ocio, which names tables by their places in its folder. Some are built
--- into OpenColorIO, and an archive has its tables in it.
local function add_configuration(value)
  if value:find "^ocio://" then return parameters:argument(value) end
  local path = absolute(value)
  local text = parameters:add_path("Ocio", path, "FILE", "IN")
  if not path:find "%.ocioz$" and not is_in_folders(path) then
    add_folder("OcioFolder", split(path))
  end
  return text
end

--- How the values of options that name files become arguments.
local PATHS = {
  ["--ocio"] = add_configuration,
  ["--set-from"] = function(value)
    return parameters:add_path("SetFrom", absolute(value), "FILE", "IN")
  end,
  ["--allow"] = function(value)
    return add_folder(parameters:numbered "Allow", absolute(value))
  end,
}

local function add_options(arguments)
  for _, option in ipairs(job.options) do
    if not OWN[option.name] and not (option.name == "--frames" and counts_frames) then
      arguments[#arguments + 1] = option.name
      if option.value then
        local add = PATHS[option.name]
        arguments[#arguments + 1] = add and add(option.value)
          or parameters:argument(option.value)
      end
    end
  end
  local files = find_files()
  add_settings(arguments, #files)
  add_files(files)
  if #job.arguments > 0 then arguments[#arguments + 1] = "--" end
  for _, argument in ipairs(job.arguments) do
    arguments[#arguments + 1] = parameters:argument(argument)
  end
end

local function action(arguments, minutes)
  local members = { { "command", "{{Param.Celspan}}" }, { "args", { list = arguments } } }
  if minutes then members[#members + 1] = { "timeout", 60 * minutes } end
  members[#members + 1] = { "cancelation",
    { { "mode", "NOTIFY_THEN_TERMINATE" }, { "notifyPeriodInSeconds", 10 } } }
  return { { "actions", { { "onRun", members } } } }
end

local function requirements()
  local amounts = {}
  local function add(name, least) amounts[#amounts + 1] = { { "name", name }, { "min", least } } end
  if job.workers then add("amount.worker.vcpu", job.workers) end
  if job.memory then add("amount.worker.memory", job.memory) end
  return #amounts > 0 and { { "amounts", { list = amounts } } } or nil
end

--- Frames as ranges that do not overlap, in their order: "3-9", "1-9:2,20" (3.4.1.1.1).
local function ranges_of(numbers)
  local sorted, parts = table.move(numbers, 1, #numbers, 1, {}), {}
  table.sort(sorted)
  local first = 1
  while first <= #sorted do
    local last, step = first, (sorted[first + 1] or 0) - sorted[first]
    while sorted[last + 1] and sorted[last + 1] - sorted[last] == step do last = last + 1 end
    if last - first < 2 and step ~= 1 then last = first end
    local how = last == first and "%d" or step == 1 and "%d-%d" or "%d-%d:%d"
    parts[#parts + 1] = how:format(sorted[first], sorted[last], step)
    first = last + 1
  end
  return table.concat(parts, ",")
end

--- The definition of what differs from task to task, and its arguments.
local function task_of()
  if counts_frames then
    local frames = parameters:add("Frames", "STRING", ranges_of(job.numbers))
    local members = { { "name", "Frames" }, { "type", "INT" }, { "range", frames } }
    if job.chunk > 1 then
      local chunk = parameters:add("Chunk", "INT", job.chunk, { { "minValue", 1 } })
      members[2][2] = "CHUNK[INT]"
      members[4] = { "chunks", { { "defaultTaskCount", chunk },
                                 { "rangeConstraint", "NONCONTIGUOUS" } } }
    end
    return members, { "--frames", "{{Task.Param.Frames}}" }
  end
  local name = job.strips and "Strip" or "Task"
  local members = { { "name", name }, { "type", "INT" },
                    { "range", job.tasks == 1 and "1" or "1-" .. job.tasks } }
  return members, { job.strips and "--strip" or "--task",
    ("{{Task.Param.%s}}/%d"):format(name, job.tasks) }
end

local function strip_pattern(output, number)
  return names.strip_pattern(output, number, parameters:argument(names.ending_of(job.output)))
end

--- The log of a task, whose name has the number of the task, or its frames.
local function task_log()
  local folder, start = split(absolute(job.log.start))
  local most = #tostring(job.tasks)
  if counts_frames then
    local last = math.max(job.numbers[1], job.numbers[#job.numbers])
    most = math.min(#ranges_of(job.numbers), job.chunk * (#tostring(last) + 1))
  end
  if #start + most + #job.log.ending > MOST_FILE then
    parameters.fault = "--log: names of tasks have their frames, as 1-10, and become too long"
  end
  local place = parameters:add_path("Log", folder == "" and "/" or folder, "DIRECTORY", "OUT")
  local number = counts_frames and "Frames" or job.strips and "Strip" or "Task"
  return ("%s/%s{{Task.Param.%s}}%s"):format(place, parameters:argument(start), number,
    parameters:argument(job.log.ending))
end

--- output: in the form for the arguments of a task.
local function render_step(script, output)
  local task, words = task_of()
  local arguments = { "render", script, "-o",
    job.strips and strip_pattern(output, "{{Task.Param.Strip}}") or output }
  local function add(...) table.move({ ... }, 1, select("#", ...), #arguments + 1, arguments) end
  add(table.unpack(words))
  add("--resume", "--progress", "openjd")
  if job.log then add("--log", task_log()) end
  if job.workers then add("--workers", tostring(job.workers)) end
  if job.rows then
    add("--table", parameters:add_path("Table", absolute(job.table), "FILE", "IN"))
  end
  add_options(arguments)
  local step = { { "name", "Render" },
    { "parameterSpace", { { "taskParameterDefinitions", { list = { task } } } } },
    { "script", action(arguments, job.minutes) } }
  local needs = requirements()
  if needs then table.insert(step, 2, { "hostRequirements", needs }) end
  return step
end

local function join_step(output)
  local arguments = { "join" }
  for i = 1, job.tasks do arguments[#arguments + 1] = strip_pattern(output, i) end
  table.move({ "-o", output }, 1, 2, #arguments + 1, arguments)
  return { { "name", "Join" },
    { "dependencies", { list = { { { "dependsOn", "Render" } } } } },
    { "script", action(arguments) } }
end

-- ---------------------------------------------------------------- the template

--- Without control characters and braces, and not too long.
local function template_name()
  return (short(names.name_of(job):gsub("[{}]", "-"), MOST_NAME))
end

local function template_text(steps)
  local members = { { "specificationVersion", "jobtemplate-2023-09" } }
  if counts_frames and job.chunk > 1 then
    members[2] = { "extensions", { list = { "TASK_CHUNKING" } } }
  end
  local about = ("%s, written by celspan %s."):format(names.summary_of(job), job.version)
  table.move({ { "name", template_name() },
    { "description", short(about, MOST_ABOUT) },
    { "parameterDefinitions", { list = parameters.list } },
    { "steps", { list = steps } } }, 1, 4, #members + 1, members)
  return json.encode(members) .. "\n"
end

local function fault_of(text)
  if parameters.fault then return parameters.fault end
  if #parameters.list > MOST_PARAMETERS then
    return ("it needs %d parameters, and a template has at most %d: give fewer --allow, and keep "
      .. "files in the script's folder"):format(#parameters.list, MOST_PARAMETERS)
  end
  if not utf8.len(text) then return "the template is UTF-8, and a name or an argument is not" end
end

--- The folder of the output, and the rest of its name. The folders of films of a table have names
--- of their own.
local function place_of_output()
  local path, fixed = job.output, split(job.output)
  if job.rows then fixed = path:match "^([^{]*)/" end
  if not fixed then return job.folder, path end
  return absolute(fixed == "" and "/" or fixed), path:sub(#fixed + 2)
end

--- The script as an argument. Numbered pictures are no file that could be mapped: their folder is.
local function add_script()
  local path = absolute(job.script)
  local entries = program.entries(path)
  local script = entries ~= nil
    and parameters:add_path("Script", path, entries and "DIRECTORY" or "FILE", "IN")
  local folder, name = split(path)
  local place = add_folder("Folder", folder == "" and "/" or folder)
  return script or place .. "/" .. parameters:argument(name)
end

local folder, file = place_of_output()
if job.rows and folder:find "{[%w_]+}" then
  return nil, ("--table takes %s in the name of the folder %s for a column: run this elsewhere")
    :format(folder:match "{[%w_]+}", folder)
end
parameters:add("Celspan", "STRING", "celspan")
local script = add_script()
local place = parameters:add_path("Output", folder, "DIRECTORY", "OUT")
local output = place .. "/" .. parameters:argument(file)
local steps = { render_step(script, output) }
if job.strips then steps[2] = join_step(output) end
local text = template_text(steps)
local fault = fault_of(text)
if fault then return nil, "Open Job Description: " .. fault end
return text
