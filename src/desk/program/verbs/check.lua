--- celspan check SCRIPT: builds every frame and renders none.
--
--   frames of a part   1 2 3 ... n | n+1 ...        in parts, so that memory is bounded:
--
--   the film's sound and captions
--   first pass  -->   in order: frames that cannot be built, pictures that cannot be read
--   a sample    < - - in fresh films, last frame first: a frame whose scene now differs was not
--                     made by a pure function of its number. The films share the sample, because
--                     each Lua state draws another seed for its tables, on which a scene may depend
--   all again   <--   only if one of the sample differs, in the film in which it does
--
-- The first pass surveys the film, too (survey.lua): what viewers cannot read, and what they should
-- be spared, are warnings.
--
-- All faults are reported at the end, equal ones in one line with the frames that have them:
--
--   frames 3-17, 20: cel 2, primitive 5: night.png: cannot be opened: No such file or directory
--   frames 1, 3, 5, 7, 9, 11, 13, 15 and 4992 more up to 9999: shot.lua:7: ...
--
-- With --json they are a list on standard output instead.
--
-- Memory depends on the number of different sentences, not of frames: at most FAULTS_MOST sentences
-- are kept, each with at most RUNS_MOST runs of frames; the rest is counted.
local program, request = ...

local PART = 4096 -- frames of a part
local FAULTS_MOST, RUNS_MOST = 1000, 8
local SCRIPT = 3 -- the exit code
local STATES = 3 -- fresh films
local SLOW = 0.25 -- the least seconds to build a frame that are reported

-- ---------------------------------------------------------------- faults

local faults = { by_text = {}, met = 0, beyond = 0 }
local others = {} -- sentences about no particular frame that were already reported

local function touches(run, first, last) return first <= run.last + 1 and last >= run.first - 1 end

--- Joins a run with the run that it now touches.
local function join_runs(runs, run)
  for i, other in ipairs(runs) do
    if other ~= run and touches(run, other.first, other.last) then
      run.first, run.last = math.min(run.first, other.first), math.max(run.last, other.last)
      table.remove(runs, i)
      return
    end
  end
end

local function add_frame(fault, frame)
  for _, run in ipairs(fault.runs) do
    if frame >= run.first and frame <= run.last then return end
  end
  for _, run in ipairs(fault.runs) do
    if touches(run, frame, frame) then
      run.first, run.last = math.min(run.first, frame), math.max(run.last, frame)
      return join_runs(fault.runs, run)
    end
  end
  if #fault.runs < RUNS_MOST then
    table.insert(fault.runs, { first = frame, last = frame })
  else
    fault.greatest = math.max(fault.greatest or frame, frame)
    fault.beyond = fault.beyond + 1
  end
end

--- where: the place in the scene, or "". After a signal to stop nothing is added, because this
--- signal makes frames fail.
local function add_fault(frame, where, message, code)
  if program.is_stopped() then return end
  local text = message:gsub(("frame %d: "):format(frame), "", 1) -- so that equal faults are joined
  local fault = faults.by_text[text]
  faults.met, faults.code = faults.met + 1, faults.code or code
  if not fault and #faults == FAULTS_MOST then
    faults.beyond = faults.beyond + 1
    return
  end
  if not fault then
    fault = { text = text, where = where, runs = {}, beyond = 0 }
    faults.by_text[text], faults[#faults + 1] = fault, fault
  end
  fault.is_everywhere = fault.is_everywhere or fault.where ~= where
  add_frame(fault, frame)
end

-- ---------------------------------------------------------------- the passes

local slowest = { seconds = 0, total = 0 }

--- Builds a frame, and adds the processor time that it needs.
local function try_timed(script, number)
  local began = os.clock()
  local good, message, code = script:try(number)
  local seconds = os.clock() - began
  slowest.total = slowest.total + seconds
  if seconds > slowest.seconds then slowest.seconds, slowest.number = seconds, number end
  return good, message, code
end

--- Adds what is seen of a frame that was built, and the faults in its pictures.
local function add_seen(script, survey, number)
  script:faults(function(...) add_fault(number, ...) end)
  survey.strange.see(number)
  survey:add(number)
end

local function first_pass(script, survey, numbers, scenes)
  for i, number in ipairs(numbers) do
    if program.is_stopped() then return i - 1 end
    local good, message, code = try_timed(script, number)
    if good then
      scenes[i] = script:scene()
      program.until_stopped(add_seen, script, survey, number)
    else
      add_fault(number, "", message, code)
    end
  end
  return #numbers
end

--- Whether a frame that is built again has a different scene. false if the scenes cannot be
--- compared.
local function differs(script, number, scene)
  return scene and not (script:try(number) and script:scene() == scene)
end

--- The first frame of the sample whose scene differs, and the film in which it does; nil: none.
local function first_that_differs(fresh, numbers, scenes)
  for i, places in ipairs(program.sample(#numbers, STATES)) do
    for _, place in ipairs(places) do
      if program.is_stopped() then return nil end
      if differs(fresh[i], numbers[place], scenes[place]) then return place, fresh[i] end
    end
  end
  return nil
end

local function check_again(fresh, numbers, scenes)
  local found, script = first_that_differs(fresh, numbers, scenes)
  for i = found and #numbers or 0, 1, -1 do
    if program.is_stopped() then return end
    if i == found or differs(script, numbers[i], scenes[i]) then
      add_fault(numbers[i], "", program.impure, SCRIPT)
    end
  end
end

--- The film of the script after running it again; nil and an exit code: reported.
local function fresh_film(script)
  local good, fresh = pcall(program.script, nil, true)
  if good and fresh.first == script.first and fresh.frames == script.frames then return fresh end
  if good then program.error("%s", program.other_frames(fresh, script)) end
  others[#others + 1] = program.reported()
  return nil, good and SCRIPT or program.outcome()
end

--- The films for the other passes; nil and an exit code: reported.
local function fresh_films(script)
  local films = {}
  for i = 1, STATES do
    local fresh, code = fresh_film(script)
    if not fresh then return nil, code end
    films[i] = fresh
  end
  return films
end

--- The numbers of the part that follows the first `done` frames.
local function part_of(script, listed, done, count)
  local numbers = {}
  for i = done + 1, math.min(done + PART, count) do
    numbers[#numbers + 1] = listed and listed[i] or script.first + i - 1
  end
  return numbers
end

--- Returns the number of frames that were built, and the exit code if something ended this early,
--- otherwise nil.
local function check_parts(script, survey, listed, count)
  local done, fresh = 0
  while done < count and not program.is_stopped() do
    local numbers, scenes = part_of(script, listed, done, count), {}
    done = done + first_pass(script, survey, numbers, scenes)
    if program.is_stopped() then break end
    if not fresh then
      local code
      fresh, code = fresh_films(script)
      if not fresh then return done, code end
    end
    program.until_stopped(check_again, fresh, numbers, scenes)
  end
  return done
end

-- ---------------------------------------------------------------- the report

--- "3", "3-17"
local function run_of(first, last)
  return last > first and ("%d-%d"):format(first, last) or tostring(first)
end

--- "frame 3", "frames 3-17, 20 and 5 more up to 99".
local function frames_of(fault)
  local runs, words = fault.runs, {}
  table.sort(runs, function(a, b) return a.first < b.first end)
  for i, run in ipairs(runs) do words[i] = run_of(run.first, run.last) end
  local is_one = #runs == 1 and runs[1].first == runs[1].last and fault.beyond == 0
  local more = fault.beyond > 0
    and (" and %d more up to %d"):format(fault.beyond, fault.greatest) or ""
  return (is_one and "frame " or "frames ") .. table.concat(words, ", ") .. more
end

--- The sentence of a fault without its frames.
local function sentence_of(fault)
  return ("%s%s%s%s"):format(fault.where, fault.is_everywhere and ", and elsewhere" or "",
    fault.where == "" and "" or ": ", fault.text)
end

--- A fault in the form for other programs, the same as in /errors.json of `celspan watch`.
local function describe(level, sentence, frame, frames)
  local file, line = program.place_of(sentence)
  return { level = level, message = sentence, frame = frame, frames = frames, file = file,
           line = line }
end

--- All faults and warnings as JSON, on standard output.
local function print_json(warnings)
  local list = {}
  for _, sentence in ipairs(others) do list[#list + 1] = describe("error", sentence) end
  for _, fault in ipairs(faults) do
    list[#list + 1] = describe("error", sentence_of(fault), fault.runs[1].first,
      frames_of(fault):match "%d.*")
  end
  for _, one in ipairs(warnings) do
    list[#list + 1] = describe("warning", one.message, one.first,
      one.first and run_of(one.first, one.last))
  end
  print(program.json { list = list })
end

--- The files that the film reads, on standard output.
local function print_files(list)
  if request.json then return print(program.json { list = list }) end
  for _, one in ipairs(list) do
    print(("%s %d %s %s"):format(one.kind, one.size, one.sha256, one.path))
  end
end

local function plural(count) return count == 1 and "" or "s" end

local function report_slowest(done)
  if slowest.seconds < SLOW then return end
  program.note("slowest to build: frame %d, %.1f s; %.1f s for a frame on average", slowest.number,
    slowest.seconds, slowest.total / done)
end

--- ended: an error that ended the checks, and was already reported.
local function report(done, count, ended, tracks, warnings)
  for _, fault in ipairs(request.json and {} or faults) do
    program.error("%s: %s", frames_of(fault), sentence_of(fault))
  end
  for _, one in ipairs(request.json and {} or warnings) do
    local frames = one.first and frames_of { runs = { one }, beyond = 0 } .. ": " or ""
    program.note("warning: %s%s", frames, one.message)
  end
  if faults.beyond > 0 then
    program.error("%d more faults with other sentences are not listed: check fewer frames at a "
      .. "time, with --frames", faults.beyond)
  end
  report_slowest(done)
  if done < count then program.note("stopped after %d of %d frames", done, count) end
  if faults.met > 0 then
    local more = faults.beyond > 0 and "more than " or ""
    program.note("%s%d fault%s, found %d time%s in %d frame%s", more, #faults, plural(#faults),
      faults.met, plural(faults.met), done, plural(done))
  elseif done == count and not ended then
    program.note("%d frame%s checked: no faults%s%s", done, plural(done),
      tracks == 0 and "" or " except in the sound or the captions",
      #warnings == 0 and "" or (", %d warning%s"):format(#warnings, plural(#warnings)))
  end
end

--- All warnings: about values that are not used, and about things that viewers see.
local function warnings_of(survey)
  local list = {}
  for i, sentence in ipairs(program.part("dropped.lua", program).of_script(request[1],
    request.script)) do
    list[i] = { message = sentence }
  end
  for _, seen in ipairs { survey:warnings(), survey.strange.warnings() } do
    table.move(seen, 1, #seen, #list + 1, list)
  end
  return list
end

--- The film of the script. If it cannot be opened, this is the only fault.
local function open()
  local good, script = pcall(program.script)
  if good then return script end
  others[1] = program.reported() or tostring(script)
  print_json {}
  return nil, program.outcome()
end

local script, failed
if request.json then
  script, failed = open()
  if not script then return failed end
else
  script = program.script()
end
local listed = request.frames and script:numbers()
local count = listed and #listed or script.frames
local tracks = script:check_tracks()
if tracks ~= 0 then others[1] = program.reported() end
local survey = program.part("survey.lua", program, script)
survey.strange = program.part("strange.lua", script)
local done, ended = check_parts(script, survey, listed, count)
local warnings = program.until_stopped(warnings_of, survey) or {}
if request.files then
  print_files(program.part("reads.lua", program, script, request))
elseif request.json then
  print_json(warnings)
end
report(done, count, ended, tracks, warnings)
return faults.code or ended or tracks
