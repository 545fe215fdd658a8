--- The report of --report: what a run was, in one JSON object, for those who run many.
local program, request = ...

local SLOWEST = 10

local report, slowest, began = {}, {}, program.clock()

local function milliseconds(seconds) return math.floor(seconds * 1000 + 0.5) / 1000 end

--- Adds a frame and the seconds that it took.
function report.add(number, seconds)
  local at = #slowest
  while at > 0 and slowest[at].seconds < seconds do at = at - 1 end
  table.insert(slowest, at + 1, { frame = number, seconds = milliseconds(seconds) })
  slowest[SLOWEST + 1] = nil
end

--- Writes the file. A failure is reported. Returns the exit code of the run.
function report.write(code, count, done, failed, runs_ffmpeg)
  local facts, stopped_by = program.run_facts(), program.is_stopped()
  facts.ffmpeg = runs_ffmpeg and program.ffmpeg_version() or nil
  facts.seconds = milliseconds(program.clock() - began)
  facts.exit = stopped_by and 128 + stopped_by or code
  facts.frames, facts.made, facts.copied, facts.kept = count, done.made, done.copied, done.kept
  facts.failures, facts.failed, facts.slowest = #failed, { list = failed }, { list = slowest }
  facts.script, facts.output = request[1], request.output
  if pcall(program.save, request.report, program.json(facts) .. "\n") then return code end
  return code == 0 and program.outcome() or code
end

return report
