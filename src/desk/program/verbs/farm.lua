--- celspan farm SCRIPT -o OUT --slurm|--openjd|--commands: a job for a farm, on standard output.
--
--   what render would refuse --> how many tasks --> the text of the job
--
-- The tasks of a job run `celspan render` with the options of the request as they were given, and a
-- part of the frames, or of the frame, each: all that can be known to fail on a farm fails here.
--
--   job.strips    whether tasks are strips of one frame, else parts of the frames
--   job.tasks     how many; job.frames: how many frames they make, or job.rows: films of --table
--   job.chunk     the most frames, or rows, of a task; nil: tasks are strips
--   job.numbers   of the frames; nil: of a table, whose films may differ
--   job.script, job.output, job.folder    as they were given, and the folder they were given in
--   job.options   of render, in their order: {name =, value =}; value nil: a flag
--   job.arguments of the script
--   job.name, job.logs, job.workers, job.memory (MiB), job.minutes    nil: not given
--   job.log       of --log: the start and the ending of the name of each task's log; nil: none
--   job.table     of --table; job.has_values: whether it or --set-from sets parameters
--   job.version   of celspan
local program, request = ...
local native = require "celspan.native"

local CHUNK, CHUNK_ROWS = 10, 1 -- frames of a task; films of a task with --table
local STRIPS_MOST = 1000 -- the most that one command can join
local OPTIONS_MOST = 128
local ARRAY_MOST = 1000 -- the most tasks of an array that Slurm accepts by default

-- ---------------------------------------------------------------- both engines

--- A path without "." and ".." in it, because rules that map paths compare their beginnings. Where
--- a link leads ".." to another folder than the names say, the path stays as it is.
local function plain_path(path)
  local parts = {}
  for part in path:gmatch "[^/]+" do
    if part == ".." then table.remove(parts) elseif part ~= "." then parts[#parts + 1] = part end
  end
  local short = "/" .. table.concat(parts, "/") .. (path:match "[^/](/)$" or "")
  return program.resolve(path) == program.resolve(short) and short or path
end

local function absolute(path, folder)
  local full = path:sub(1, 1) == "/" and path or folder:gsub("/$", "") .. "/" .. path
  return (full .. "/"):find "/%.%.?/" and plain_path(full) or full
end

--- The ending of a strip's file, which its picture has, too.
local function ending_of(path) return path:match "%.([^./]*)$" or "" end

--- The name of a strip's file; ending: of the output, which may be a text that stands for it.
local function strip_pattern(output, number, ending)
  return ("%s.strips/%s.%s"):format(output, number, ending or ending_of(output))
end

--- A text for a comment: control characters, also those of Latin 1, are replaced, so that it stays
--- on its line.
local function plain(text) return (text:gsub("%c", "?"):gsub("\xC2[\x80-\x9F]", "?")) end

--- The name of the job, which is not empty: a script may be named ".lua".
local function name_of(job)
  return job.name or job.script:match "([^/]+)/*$":gsub("(.)%.lua$", "%1")
end

local function summary_of(job)
  if job.strips then return ("one frame of %s in %d strips"):format(job.script, job.tasks) end
  local count, what = job.rows or job.frames, job.rows and "film" or "frame"
  return ("%d %s%s of %s in %d task%s"):format(count, what, count == 1 and "" or "s", job.script,
    job.tasks, job.tasks == 1 and "" or "s")
end

--- What the template of Open Job Description has in common with the others.
local names = { absolute = absolute, strip_pattern = strip_pattern, ending_of = ending_of,
                name_of = name_of, summary_of = summary_of, plain = plain }

-- ---------------------------------------------------------------- Slurm

--- A word for any shell with any contents: between single quotes all characters stand for
--- themselves. zsh replaces a word that begins with =.
local function quoted(text)
  if text:find "^[%w%%+,./:=@_-]+$" and text:byte() ~= ("="):byte() then return text end
  return "'" .. text:gsub("'", [['\'']]) .. "'"
end

--- The arguments after the usual ones of render, with a space before each.
local function words_of(job)
  local words = { "" }
  for _, option in ipairs(job.options) do
    words[#words + 1] = option.name
    if option.value then words[#words + 1] = quoted(option.value) end
  end
  if #job.arguments > 0 then words[#words + 1] = "--" end
  for _, argument in ipairs(job.arguments) do words[#words + 1] = quoted(argument) end
  return table.concat(words, " ")
end

--- The log of a task as words of render, with a space before them. number: a text for the shell.
local function log_words(job, number)
  local log = job.log
  return log and (" --log %s%s%s"):format(quoted(log.start), number, quoted(log.ending)) or ""
end

local function directives_of(job)
  local lines = {}
  local function add(format, ...) lines[#lines + 1] = "#SBATCH --" .. format:format(...) end
  add("job-name=%s", name_of(job):gsub("[^%w._-]", "-"))
  add("array=1-%d", job.tasks)
  add("requeue")
  add("open-mode=append")
  if job.workers then add("cpus-per-task=%d", job.workers) end
  if job.memory then add("mem=%dM", job.memory) end
  if job.minutes then add("time=%d", job.minutes) end
  if job.logs then
    add('output="%s/%%x-%%A_%%a.log"', absolute(job.logs, job.folder):gsub("%%", "%%%%"))
  end
  return table.concat(lines, "\n")
end

local SLURM_HEAD = [[
#!/bin/bash
# @SUMMARY@, written by celspan @VERSION@.
#
#   bash THIS_FILE         puts it into the queue@AND_JOIN@
@HOW@
@DIRECTIVES@

celspan=${CELSPAN:-celspan}
tasks=@TASKS@
tries=3 # how often a task that may succeed another time is put back into the queue
@MEMORY@]]

--- Some installations of Slurm have no control groups that limit memory.
local MEMORY = "export CELSPAN_MEMORY=${CELSPAN_MEMORY:-%dM} # as --mem\n"

local CHUNK_HOW = "#   sbatch THIS_FILE       the same"
local STRIP_HOW = "#   bash THIS_FILE join    joins the strips, once they are all there"

local CHUNK_QUEUE = [[

if [ -z "${SLURM_ARRAY_TASK_ID:-}" ]; then@LOGS@
  exec sbatch "$0"
fi
]]

local STRIP_QUEUE = [[

if [ -z "${SLURM_ARRAY_TASK_ID:-}" ] && [ "${1:-}" != join ]; then@LOGS@
  job=$(sbatch --parsable "$0") || exit
  job=${job%%;*}
  echo "Submitted batch job $job"
  exec sbatch --array=1 --dependency="afterok:$job" --kill-on-invalid-dep=yes "$0" join
fi
]]

local CHUNK_RUN = [[

run() {
  "$celspan" render @SCRIPT@ -o @OUTPUT@ \
    --task "$SLURM_ARRAY_TASK_ID/$tasks" --resume --workers @WORKERS@@LOG@@WORDS@
}
]]

local STRIP_RUN = [[

strips=@STRIPS@

run() {
  if [ "${1:-}" = join ]; then
    local parts=() i
    for ((i = 1; i <= tasks; i++)); do parts+=("$strips/$i.@ENDING@"); done
    "$celspan" join "${parts[@]}" -o @OUTPUT@
  else
    "$celspan" render @SCRIPT@ -o "$strips/$SLURM_ARRAY_TASK_ID.@ENDING@" \
      --strip "$SLURM_ARRAY_TASK_ID/$tasks" --resume --workers @WORKERS@@LOG@@WORDS@
  fi
}
]]

local SLURM_TAIL = [[

cd -- @FOLDER@ || exit 5
run "$@"
code=$?
case $code in
  5 | 33 | 137) # the output could not be written, no memory, killed: another time it may be
    if [ -n "${SLURM_ARRAY_JOB_ID:-}" ] && [ "${SLURM_RESTART_COUNT:-0}" -lt "$tries" ] &&
      scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"; then
      sleep 600 # Slurm ends this script
    fi ;;
esac
exit "$code"
]]

local function slurm(job)
  local logs = job.logs and absolute(job.logs, job.folder)
  if logs and logs:find '[%c"\\]' then
    return nil, "--logs: Slurm takes no name with control characters, quotation marks or \\"
  end
  local values = {
    SUMMARY = plain(summary_of(job)), VERSION = job.version, TASKS = job.tasks,
    AND_JOIN = job.strips and ", and the join behind it" or "",
    HOW = job.strips and STRIP_HOW or CHUNK_HOW, DIRECTIVES = directives_of(job),
    LOGS = logs and "\n  mkdir -p " .. quoted(logs) .. " || exit" or "",
    SCRIPT = quoted(job.script), OUTPUT = quoted(job.output), FOLDER = quoted(job.folder),
    STRIPS = quoted(absolute(job.output, job.folder) .. ".strips"),
    ENDING = quoted(ending_of(job.output)), WORDS = words_of(job),
    LOG = log_words(job, '"$SLURM_ARRAY_TASK_ID"'),
    MEMORY = job.memory and MEMORY:format(job.memory) or "",
    WORKERS = job.workers or '"${SLURM_CPUS_ON_NODE:-1}"',
  }
  local body = job.strips and STRIP_QUEUE .. STRIP_RUN or CHUNK_QUEUE .. CHUNK_RUN
  return ((SLURM_HEAD .. body .. SLURM_TAIL):gsub("@([A-Z_]+)@", values))
end

-- ---------------------------------------------------------------- commands

--- A line for each task, for any shell and any program that runs lines, and one that joins strips.
local function commands(job)
  local lines, head = {}, ("cd -- %s && \"${CELSPAN:-celspan}\" "):format(quoted(job.folder))
  local words, parts = words_of(job), {}
  if (job.folder .. job.script .. job.output .. words .. log_words(job, "")):find "%c" then
    return nil, "--commands: a command is a line, and a name or an argument has control characters"
  end
  local workers = job.workers and " --workers " .. job.workers or ""
  for i = 1, job.tasks do
    parts[i] = job.strips and quoted(strip_pattern(job.output, i)) or quoted(job.output)
    lines[i] = ("%srender %s -o %s --%s %d/%d --resume%s%s%s"):format(head, quoted(job.script),
      parts[i], job.strips and "strip" or "task", i, job.tasks, workers, log_words(job, i), words)
  end
  if job.strips then
    lines[#lines + 1] = ("%sjoin %s -o %s"):format(head, table.concat(parts, " "),
      quoted(job.output))
  end
  return table.concat(lines, "\n") .. "\n"
end

-- ---------------------------------------------------------------- what is asked for

local own = { ["-o"] = true, ["--slurm"] = true, ["--openjd"] = true,
  ["--commands"] = true, ["--chunk"] = true,
  ["--strips"] = true, ["--job-name"] = true, ["--job-memory"] = true, ["--job-time"] = true,
  ["--logs"] = true, ["--log"] = true, ["--workers"] = true } -- these are not passed to the tasks

--- A log is added to, and its folder is not made: a task without it would fail.
local function refuse_log()
  local folder, name = absolute(request.log, program.working_folder()):match "^(.*/)([^/]*)$"
  if name == "" or not program.entries(folder) then
    program.usage("--log %s: give the name of a file in a folder that exists: each task adds its "
      .. "number to the name", request.log)
  end
end

--- run.log as the start "run." and the ending ".log", between which is the number of a task.
local function log_of(path)
  local start, ending = path:match "^(.*[^/])(%.[^./]*)$"
  return { start = (start or path) .. ".", ending = ending or "" }
end

--- Refuses what only `render` makes, or nobody.
local function refuse_name(output)
  if not program.output(output) then program.refuse_target(output) end
end

local function refuse()
  local output = request.output
  if not output then program.usage "-o is missing: give -o shot.####.png, as for render" end
  local kinds = (request.slurm and 1 or 0) + (request.openjd and 1 or 0)
    + (request.commands and 1 or 0)
  if kinds ~= 1 then
    program.usage "for which farm? give --slurm, --openjd or --commands, one of them"
  end
  if request.strips and (request.chunk or request.table) then
    program.usage("%s divides %s and --strips a frame: give one of them",
      request.table and "--table" or "--chunk", request.table and "its rows" or "a film")
  end
  if request.strips and math.tointeger(request.strips) > STRIPS_MOST then
    program.usage("--strips %s: at most %d strips can be joined at once", request.strips,
      STRIPS_MOST)
  end
  if output == "-" then program.usage "a farm makes files of frames: give -o shot.####.png" end
  if request.table == "-" then
    program.usage "--table -: each task reads the table, too: give the name of a file"
  end
  if not request.table then refuse_name(output) end
  if request.log then refuse_log() end
  if #output > program.path_most then program.usage("%.80s...: the name is too long", output) end
end

--- Frames per second as --fps takes them: 25, 30000/1001.
local function rate_of(script)
  local above = math.floor(script.fps * 1.001 + 0.5) * 1000
  return script.fps == above / 1001 and above .. "/1001" or ("%.14g"):format(script.fps)
end

--- Refuses a video, whose frames are made by several tasks, and says how it is made of them.
local function refuse_video(script, output)
  local frames = output:gsub("%.[^./]*$", "") .. ".####.png"
  program.usage("%s: a farm makes files of frames: give -o %s, and when all are there, make the "
    .. "video of them: celspan convert %s %s --fps %s%s", output, frames, quoted(frames),
    quoted(output), rate_of(script), script.has_sound and " --sound " .. quoted(request[1]) or "")
end

--- How many tasks have the most of `chunk`.
local function tasks_of(count, chunk) return (count + chunk - 1) // chunk end

--- Options of the job that are not for a row: the process of a row does not get them.
local not_of_rows = setmetatable({ ["--table"] = true, ["--keep-going"] = true }, { __index = own })

--- Refuses what `render` would refuse of a task, or of a row, with this output. division: --task or
--- --strip, with its value; nil: a row. Films of a table may differ in their size, unless it is
--- given.
local function refuse_run(script, output, division, value)
  local words = { request[1], "-o", output, "--resume", division, value }
  script:refuse(program.pass_on(words, request, division and own or not_of_rows, {}),
    division or request.size or request.fit)
end

--- Sets the numbers of films and tasks. Every row is checked, but no frame is counted: films may
--- differ in their length.
local function count_rows(job, script)
  local rows = program.part("rows.lua", program, request, script)
  for row in rows.next do
    refuse_name(row.output)
    refuse_run(script, row.output)
  end
  job.rows, job.output = rows.count, request.output
  job.chunk = math.tointeger(request.chunk) or CHUNK_ROWS
  job.tasks = tasks_of(job.rows, job.chunk)
end

--- Sets the numbers of frames and tasks, and the output of each task.
local function count_tasks(job, script)
  if program.output(request.output) == "videos" then refuse_video(script, request.output) end
  local numbers = script:numbers(request.output)
  job.frames, job.tasks, job.output = #numbers, math.tointeger(request.strips), request.output
  job.numbers = numbers
  if request.strips then
    if #numbers ~= 1 then
      program.usage("--strips divides one frame, and there are %d: name it with --frames", #numbers)
    end
    job.output = program.check(native.frame_name(request.output, numbers[1]))
    refuse_run(script, strip_pattern(job.output, 1), "--strip", job.tasks .. "/" .. job.tasks)
  else
    job.chunk = math.tointeger(request.chunk) or CHUNK
    job.tasks = tasks_of(#numbers, job.chunk)
    refuse_run(script, job.output, "--task", "1/" .. job.tasks)
  end
end

refuse()
local job = { strips = request.strips, script = request[1], folder = program.working_folder(),
  name = request.job_name, logs = request.logs, workers = math.tointeger(request.workers),
  memory = math.tointeger(request.job_memory), minutes = math.tointeger(request.job_time),
  arguments = request.arguments, options = {}, version = program.version, table = request.table,
  log = request.log and log_of(request.log), has_values = request.table or request.set_from }
for _, option in ipairs(request.given) do
  if not own[option.name] then table.insert(job.options, option) end
  if #job.options > OPTIONS_MOST then
    program.usage("%s: there are more than %d options", option.name, OPTIONS_MOST)
  end
end
-- The machines of a farm do not have this machine's environment.
local configuration = os.getenv "OCIO"
if configuration and configuration ~= "" and not request.ocio then
  table.insert(job.options, { name = "--ocio", value = configuration })
end
local script = program.script()
if request.table then count_rows(job, script) else count_tasks(job, script) end
local text, message
if request.openjd then
  text, message = program.part("openjd.lua", program, script, job, names)
else
  text, message = (request.slurm and slurm or commands)(job)
end
if not text then program.usage("%s", message) end
io.write(text)
if request.slurm and job.tasks > ARRAY_MOST then
  program.note("%d tasks: Slurm takes arrays of %d unless MaxArraySize is set higher; with --chunk "
    .. "there are fewer", job.tasks, ARRAY_MOST)
end
