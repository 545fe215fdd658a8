--- The renderers of a film (celspan watch): processes that answer one request each at a time.
--
--   ask --> queue --> an idle renderer --> done(head, bytes) or failed(message, status)
--              \--nobody is idle for SOON seconds--> one more renderer, RENDERERS_MOST at most
--               \--nobody for LATE seconds--> failed
--
-- One renderer always stays; others end when they have nothing to do.
--
-- While the film plays, several frames are wanted at once. Then renderers draw whole frames side by
-- side and share the processors: building a frame, packing it and sending it use one processor
-- each, so that all processors for one frame after the other would often wait. A frame that is
-- wanted alone has all processors.
--
-- So a script that hangs or eats memory costs one renderer, which its limits end, and the others
-- answer meanwhile.
--
-- INVARIANT: each request that was asked is answered by exactly one call of done or failed.
local program, request = ...
local json = require "celspan.json"

local RENDERERS_MOST = 4
local SOON, LATE = 0.25, 1.5 -- seconds
local IDLE = 20              -- a renderer that is not needed ends after this many seconds
local TAIL = 2000            -- bytes of the last words that are kept
local REQUEST_MOST = 32700   -- the most bytes of a request to a renderer, without its workers
local FRAMES_WAITING = 2     -- frames that wait, for which another renderer is started

local renderers = {}
renderers.__index = renderers

--- Options for the page, not for the film.
local own = { ["--port"] = true, ["--open"] = true, ["--size"] = true, ["--editor"] = true,
              ["-o"] = true }
--- Those, and options whose values the page has as those of parameters.
local shown = setmetatable({ ["--set"] = true, ["--set-from"] = true }, { __index = own })

--- The options with which films are made, as words of a command, without values of parameters.
function renderers.options()
  return program.pass_on({}, { given = request.given, arguments = {} }, shown, {})
end

function renderers.new(script, note_files)
  program.divide_memory(RENDERERS_MOST * #request) -- for the renderers of each film
  local workers = math.tointeger(request.workers) or 0
  return setmetatable({ script = script, list = {}, queue = {}, values = {},
                        note_files = note_files,
                        workers = workers > 0 and workers or program.processors() }, renderers)
end

--- job: want, and its data in `ask`; done, failed. is_patient: no other renderer is started for the
--- job, and it may wait for ever. wish: the name by which it can be given up, or nil.
function renderers:ask(job)
  job.since = program.clock()
  if #program.json(job.ask) > REQUEST_MOST then
    return job.failed("the request is too long", 400)
  end
  table.insert(self.queue, job)
end

local NOT_WANTED = "it is not wanted any more"

--- Gives up a job. A renderer that is working on it stops within a few rows.
function renderers:abandon(wish)
  for i, job in ipairs(self.queue) do
    if job.wish == wish then
      table.remove(self.queue, i)
      return job.failed(NOT_WANTED, 503)
    end
  end
  for _, one in ipairs(self.list) do
    if one.job and one.job.wish == wish and not one.job.is_abandoned then
      one.job.is_abandoned = true
      one.process:send(program.json { want = "abandon" })
    end
  end
end

function renderers:is_idle()
  if #self.queue > 0 then return false end
  for _, one in ipairs(self.list) do
    if not one.job then return true end
  end
  return false
end

-- ---------------------------------------------------------------- one renderer

--- Adds to the words of a process what the film was given: the options of the request, and the
--- values of parameters, which replace those of the command line.
function renderers:add_options(words)
  local settings = {}
  for name, value in pairs(self.values) do settings[#settings + 1] = { name, value } end
  return program.pass_on(words, request, own, settings)
end

function renderers:start()
  local process, message = program.renderer(self:add_options { "stage", self.script })
  if not process then return nil, message end
  local one = { process = process, tail = "", used = program.clock() }
  table.insert(self.list, one)
  return one
end

--- Shows the output of a renderer, and keeps the end of it.
local function hear(one)
  local words = one.process:words()
  if words == "" then return end
  program.show(words)
  one.tail = (one.tail .. words):sub(-TAIL)
end

--- Why a renderer has ended: the end of its output.
local function last_words(one)
  local code, signal = one.process:finish()
  local said = one.tail:match "celspan: error: ([^\n]*)\n*$"
  if said then return said end
  if code == 33 or signal == "Killed" then return "there was not enough memory for the film" end
  return code and ("the renderer ended with exit code %d"):format(code)
    or ("the renderer was ended by a signal: %s"):format(signal)
end

local function finish(one, ...)
  local job = one.job
  one.job = nil
  if job then job.failed(...) end
end

--- Hands the answer of a renderer to the job. A trusted script can write to the same pipe, so the
--- message may be anything; what is wrong with it is raised as an error.
function renderers:give(job, message)
  local text, at = (">s4"):unpack(message)
  local head = assert(json.decode(text))
  self.note_files(head.files)
  if head.good then
    job.done(head, message:sub(at))
  elseif job.is_abandoned then
    job.failed(NOT_WANTED, 503)
  else
    job.failed(head.message, 422)
  end
end

--- Reads what has arrived from a renderer. false: the renderer has ended.
function renderers:listen(one)
  hear(one)
  local message = one.process:take()
  if message == false then
    hear(one)
    finish(one, last_words(one), 500)
    return false
  end
  local job = one.job
  if not message or not job then return message == nil end
  one.job, one.used = nil, program.clock()
  local is_good = pcall(self.give, self, job, message)
  if not is_good then job.failed("the renderer's answer cannot be read", 500) end
  return is_good
end

-- ---------------------------------------------------------------- all of them

--- The next job for an idle renderer; patient jobs come last.
function renderers:next_job()
  for i, job in ipairs(self.queue) do
    if not job.is_patient then return table.remove(self.queue, i) end
  end
  return table.remove(self.queue, 1)
end

--- The workers of the next job: an equal share of the processors, for as many jobs as there are
--- for the renderers.
function renderers:share()
  local jobs = #self.queue
  for _, one in ipairs(self.list) do jobs = jobs + (one.job and 1 or 0) end
  return math.max(1, self.workers // math.min(jobs, #self.list))
end

function renderers:hand_out()
  for _, one in ipairs(self.list) do
    if #self.queue == 0 then return end
    if not one.job then
      local workers = self:share()
      one.job = self:next_job()
      one.job.ask.workers = workers
      if not one.process:send(program.json(one.job.ask)) then
        finish(one, "the renderer has ended", 500)
      end
    end
  end
end

--- Whether frames wait for which there are processors, but no renderers.
function renderers:has_room()
  local frames = 0
  for _, job in ipairs(self.queue) do frames = frames + (job.ask.want == "frame" and 1 or 0) end
  return frames >= FRAMES_WAITING and #self.list < self.workers
end

--- Gives up jobs that have waited too long, and starts a renderer if jobs wait.
function renderers:hurry()
  local now, waits = program.clock(), #self.list == 0 and #self.queue > 0 or self:has_room()
  for i = #self.queue, 1, -1 do
    local job = self.queue[i]
    if not job.is_patient and now - job.since > LATE and #self.list >= RENDERERS_MOST then
      table.remove(self.queue, i)
      job.failed("all renderers are at work: the film is slow, or does not end", 503)
    elseif not job.is_patient and now - job.since > SOON then
      waits = true
    end
  end
  if not waits or #self.list >= RENDERERS_MOST then return end
  local started, message = self:start()
  if started or #self.list > 0 then return end
  for _, job in ipairs(self.queue) do job.failed(message, 500) end
  self.queue = {}
end

--- Whether a renderer has ended, or is not needed any more.
function renderers:is_over(one)
  if not self:listen(one) then return true end
  return #self.list > 1 and not one.job and program.clock() - one.used > IDLE
end

function renderers:step()
  for i = #self.list, 1, -1 do
    if self:is_over(self.list[i]) then
      self.list[i].process:finish()
      table.remove(self.list, i)
    end
  end
  self:hand_out()
  self:hurry()
  self:hand_out()
end

--- Milliseconds until `step` must be called even without news; -1: never.
function renderers:wait() return #self.queue > 0 and 50 or -1 end

function renderers:add_descriptors(list)
  for _, one in ipairs(self.list) do
    for _, descriptor in ipairs { one.process:descriptors() } do list[#list + 1] = descriptor end
  end
end

--- Ends all renderers; their jobs fail.
function renderers:close(message, status)
  local list, queue = self.list, self.queue
  self.list, self.queue = {}, {}
  for _, one in ipairs(list) do
    hear(one)
    one.process:finish()
    finish(one, message, status)
  end
  for _, job in ipairs(queue) do job.failed(message, status) end
end

return renderers
