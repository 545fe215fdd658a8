--- celspan render SCRIPT -o OUT: the frames of a film.
---
---   film --> numbers --> target (a row of outputs.c) --> kept? --> shoot --> report
---
--- Everything that can be refused is refused before the first frame is made. A frame that fails
--- ends the run, except under --keep-going; the frames before it are complete and stay.
local program, request = ...

local PARTIAL, OUTPUT, SIGNAL = 1, 5, 128 -- exit codes

local output = request.output
program.refuse_render()
program.is_stopped() -- from now on a signal ends no function, and the end is reported
local script = program.script()
local width, height = script:view_size()
script:lay_onion(width, height)
local w, h = table.unpack(script.size)
if request.size and not request.fit and math.abs(width * h - height * w) >= math.max(w, h) then
  program.note("the film, %gx%g, is stretched to %dx%d; --fit contain or --fit cover keeps its "
    .. "shape", w, h, width, height)
end
local numbers = script:numbers(output)
if #numbers == 0 then return program.note("task %d of %d has no frames", program.task()) end
if request.cel then program.part("cels.lua", program, request, script, numbers) end
if output then program.sweep(output) end
local target = script:target(output, #numbers)
local video = target.is_video and program.part("video.lua", program, request, script, target)
target.path, target.numbers = output, numbers
if video and request.fps then
  target.played, target.numbers = numbers, video.at_rate(numbers)
  numbers = target.numbers
end
local record = request.resume
  and program.part("record.lua", program, request, script, script:key(true))
local report = request.report and program.part("report.lua", program, request)

-- ---------------------------------------------------------------- reports

local failed, done = {}, { made = 0, copied = 0, kept = 0 }

local function count_done() return done.made + done.copied + done.kept end

--- Called for each frame: see services/shooting.c.
function target.finished(number, code, how, seconds, bytes, contents, digest)
  if code == 0 and record and how ~= "kept" and not target.holds_all then
    local good, message = record.add(number, bytes, contents, digest)
    code = good and 0 or program.failed_frame(number, message)
  end
  if code == 0 then
    done[how] = done[how] + 1
    if report then report.add(number, seconds) end
    return nil
  end
  if code == SIGNAL then return code end
  failed[#failed + 1] = number
  return request.keep_going and 0 or code
end

--- "2, 5-6": the frames that failed, in the order of the run; "2, 5-6, ..." if they are many.
local function list_failed()
  local runs, length, i = {}, 0, 1
  while i <= #failed do
    local last = i
    while failed[last + 1] == failed[last] + 1 do last = last + 1 end
    local run = failed[i] .. (last > i and "-" .. failed[last] or "")
    length, i = length + #run + 2, last + 1
    if length > 1000 then run, i = "...", #failed + 1 end
    runs[#runs + 1] = run
  end
  return table.concat(runs, ", ")
end

--- All messages come before the end is reported. Returns the exit code.
local function finish(code)
  local count, made = #numbers, count_done()
  if made < count and count > 1 and target.holds_all then
    program.note("%s was not made: the run ended after %d of %d frames", output, made, count)
  elseif made < count and count > 1 then
    program.note("%d of %d frames are finished", made, count)
  end
  if #failed > 0 and request.keep_going then
    program.error("%d of %d frames failed: %s", #failed, count, list_failed())
    code = code == 0 and PARTIAL or code
  end
  code = program.flush(code)
  if report then code = report.write(code, count, done, failed, target.runs_ffmpeg) end
  program.end_frames(failed, code)
  return code
end

-- ---------------------------------------------------------------- the run

local function make()
  if video then video.describe() end
  local code, bytes, contents = script:shoot(target)
  if code == 0 and record and target.holds_all then
    local good, message = record.add_whole(bytes, contents)
    if not good then
      program.error("%s", message)
      code = OUTPUT
    end
  end
  if code == 0 and video then code = video.write_poster() end
  return finish(code)
end

--- Whether the file that holds all frames would not change. They are built to find out. A frame
--- that fails is not reported here, but when the file is made: after the start of the run.
local function is_unchanged()
  if not record.knows_whole() then return false end
  record.begin_whole(numbers)
  local code = script:shoot { row = target.row, numbers = numbers,
    keep = function(_, _, ...) return record.add_to_whole(...) end }
  return code == 0 and (not video or video.has_poster()) and record.keeps_whole()
end

if not record then return make() end
if not target.holds_all then
  target.keep = record.keeps
  return make()
end
if is_unchanged() then
  program.count_frames(#numbers, true)
  for _, number in ipairs(numbers) do program.made_frame(number, output, "kept") end
  done.kept = #numbers
  return finish(0)
end
record.begin_whole(numbers)
function target.keep(_, _, ...) return not record.add_to_whole(...) end
return make()
