--- The renderers of a film (celspan watch): processes that answer requests.
--
--   ask --> queue --> a free renderer --> building --> done(head, bytes) or failed(message, status)
--              |                              \--> drawing, with others --> the same
--              |--no renderer says anything for SOON seconds--> one more, RENDERERS_MOST at most
--              \--nobody for LATE seconds--> failed
--
-- A renderer builds one frame at a time and draws several side by side, so that it is free for the
-- next request as soon as it has built a frame. Frames that are drawn at the same time share the
-- processors; a frame that is wanted alone has all of them. One renderer always stays; others end
-- when they have nothing to do.
--
-- So a script that hangs or eats memory costs one renderer, which its limits end, and the others
-- answer meanwhile. Pictures that it was drawing are drawn by another one.
--
-- INVARIANT: each request that was asked is answered by exactly one call of done or failed.
local program, request = ...
local json = require "celspan.json"

local RENDERERS_MOST = 4
local SOON, LATE = 0.25, 1.5 -- seconds
local IDLE = 20              -- a renderer that is not needed ends after this many seconds
local TAIL = 2000            -- bytes of the last words that are kept
local REQUEST_MOST = 32700   -- the most bytes of a request to a renderer, without its workers
-- frames that a renderer draws: one for each of its threads (program/services/stage_service.c), and
-- one more
local DRAWN_MOST, DRAWN_AHEAD = 4, 1

local renderers = {}
renderers.__index = renderers

--- Options for the page, not for the film.
local own = { ["--port"] = true, ["--open"] = true, ["--size"] = true, ["--editor"] = true,
              ["-o"] = true }
--- Those, and options whose values the page has as parameters.
local shown = setmetatable({ ["--set"] = true, ["--set-from"] = true }, { __index = own })

--- The options with which films are made, as words of a command, without values of parameters.
function renderers.options()
  return program.pass_on({}, { given = request.given, arguments = {} }, shown, {})
end

function renderers.new(script, note_files)
  program.divide_memory(RENDERERS_MOST * #request) -- for the renderers of each film
  local workers = math.tointeger(request.workers) or 0
  return setmetatable({ script = script, list = {}, queue = {}, killed = {}, values = {},
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

local function give_up(one, job, wish)
  if job.wish ~= wish or job.is_abandoned then return end
  job.is_abandoned = true
  one.process:abandon(job.number)
end

--- Gives up a job. A renderer that is working on it stops within a few rows.
function renderers:abandon(wish)
  for i, job in ipairs(self.queue) do
    if job.wish == wish then
      table.remove(self.queue, i)
      return job.failed(NOT_WANTED, 503)
    end
  end
  for _, one in ipairs(self.list) do
    for _, job in ipairs(one.drawing) do give_up(one, job, wish) end
    if one.building then give_up(one, one.building, wish) end
  end
end

--- Whether a renderer has nothing to do.
local function is_idle(one) return not one.building and #one.drawing == 0 end

function renderers:is_idle()
  if #self.queue > 0 then return false end
  for _, one in ipairs(self.list) do
    if is_idle(one) then return true end
  end
  return false
end

-- ---------------------------------------------------------------- one renderer

--- Adds to the words of a process what the film was given: the options of the request, and the
--- values of parameters, which replace the command line's.
function renderers:add_options(words)
  local settings = {}
  for name, value in pairs(self.values) do settings[#settings + 1] = { name, value } end
  return program.pass_on(words, request, own, settings)
end

function renderers:start()
  local process, message = program.renderer(self:add_options { "stage", self.script })
  if not process then return nil, message end
  -- sent: the number of requests; used: when it has said or been sent something
  local one = { process = process, tail = "", used = program.clock(), sent = 0, drawing = {} }
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

--- Ends the jobs of a renderer.
local function finish(one, ...)
  local jobs = one.drawing
  jobs[#jobs + 1] = one.building
  one.building, one.drawing = nil, {}
  for _, job in ipairs(jobs) do job.failed(...) end
end

--- Ends a job with an answer.
local function settle(job, head, bytes)
  if head.good then
    local is_taken, fault = pcall(job.done, head, bytes)
    if is_taken then return end
    job.failed("the renderer's answer cannot be read", 500)
    error(fault, 0)
  elseif job.is_abandoned then
    job.failed(NOT_WANTED, 503)
  else
    job.failed(head.message, 422)
  end
end

--- Ends the job of a picture with what was said when it was begun and when it was drawn.
local function settle_picture(job, head, bytes)
  local whole = { camera = job.begun.camera, points = job.begun.points }
  whole.good, whole.message = head.message == nil, head.message
  whole.seconds = job.begun.seconds + head.seconds
  settle(job, whole, bytes)
end

--- Takes a picture. It may come before the renderer has said that it is begun, or after that was
--- refused.
local function take_picture(one, head, bytes)
  local building = one.building
  if building and building.number == head.picture then
    building.drawn = { head, bytes }
    return
  end
  for i, job in ipairs(one.drawing) do
    if job.number == head.picture then
      return settle_picture(table.remove(one.drawing, i), head, bytes)
    end
  end
end

--- Takes an answer of a renderer, and hands it to its job. A trusted script can write to the same
--- pipe, so the message may be anything; what is wrong with it is raised as an error.
function renderers:give(one, message)
  local text, at = (">s4"):unpack(message)
  local head, bytes = assert(json.decode(text)), message:sub(at)
  if head.picture then return take_picture(one, head, bytes) end
  self.note_files(head.files)
  local job = assert(one.building)
  one.building = nil
  if not head.begun then return settle(job, head, bytes) end
  job.begun = head
  if job.drawn then return settle_picture(job, table.unpack(job.drawn)) end
  table.insert(one.drawing, job)
end

--- Puts the pictures that a renderer was drawing when it ended back into the queue, once: the frame
--- that it was building may have ended it.
function renderers:save_pictures(one)
  for i = #one.drawing, 1, -1 do
    local job = one.drawing[i]
    if not job.is_again and not job.is_abandoned then
      job.is_again, job.since = true, program.clock()
      table.insert(self.queue, 1, table.remove(one.drawing, i))
    end
  end
end

--- Reads what has arrived from a renderer. false: the renderer has ended.
function renderers:listen(one)
  hear(one)
  for message in one.process.take, one.process do
    if not message then
      hear(one)
      self:save_pictures(one)
      finish(one, last_words(one), 500)
      return false
    end
    one.used = program.clock()
    if not pcall(self.give, self, one, message) then
      finish(one, "the renderer's answer cannot be read", 500)
      return false
    end
  end
  return true
end

-- ---------------------------------------------------------------- all of them

--- Takes the next job for a renderer from the queue; patient jobs come last. nil: it can take
--- none.
function renderers:next_job(one)
  local is_full = #one.drawing >= math.min(self.workers, DRAWN_MOST) + DRAWN_AHEAD
  local patient
  for i, job in ipairs(self.queue) do
    if job.is_patient then
      patient = patient or i
    elseif not is_full or job.ask.want ~= "frame" then
      return table.remove(self.queue, i)
    end
  end
  return patient and table.remove(self.queue, patient)
end

local function is_frame(job) return job and job.ask.want == "frame" end

--- The workers of a frame that is being built: an equal share of the processors, for as many frames
--- as are built or drawn, or wait.
function renderers:share()
  local frames = 0
  for _, job in ipairs(self.queue) do frames = frames + (is_frame(job) and 1 or 0) end
  for _, one in ipairs(self.list) do
    frames = frames + #one.drawing + (is_frame(one.building) and 1 or 0)
  end
  return self.workers // math.min(self.workers, math.max(1, frames))
end

--- Sends a job to a renderer.
function renderers:give_job(one, job)
  one.sent, one.used = one.sent + 1 & 0xffffff, program.clock()
  job.number = one.sent
  one.building = job
  job.ask.workers = self:share()
  one.process:send(program.json(job.ask)) -- if it has ended, `listen` reads its last words
end

function renderers:hand_out()
  for _, one in ipairs(self.list) do
    local job = not one.building and self:next_job(one)
    if job then self:give_job(one, job) end
  end
end

--- Whether no renderer has said anything for a while.
function renderers:is_silent(now)
  for _, one in ipairs(self.list) do
    if now - one.used <= SOON then return false end
  end
  return true
end

--- Gives up jobs that have waited too long, and starts a renderer if jobs wait.
function renderers:hurry()
  local now = program.clock()
  local waits, is_silent = #self.list == 0 and #self.queue > 0, self:is_silent(now)
  for i = #self.queue, 1, -1 do
    local job = self.queue[i]
    if not job.is_patient and now - job.since > LATE and #self.list >= RENDERERS_MOST then
      table.remove(self.queue, i)
      job.failed("all renderers are at work: the film is slow, or does not end", 503)
    elseif is_silent and not job.is_patient and now - job.since > SOON then
      waits = true
    end
  end
  if not waits or #self.list >= RENDERERS_MOST then return end
  local started, message = self:start()
  if started or #self.list > 0 then return end
  for _, job in ipairs(self.queue) do job.failed(message, 500) end
  self.queue = {}
end

--- Ends a renderer, and does not wait for that.
function renderers:kill(one)
  one.process:kill()
  table.insert(self.killed, one.process)
end

--- Whether a renderer has ended, or is not needed any more.
function renderers:is_over(one)
  if not self:listen(one) then return true end
  return #self.list > 1 and is_idle(one) and program.clock() - one.used > IDLE
end

function renderers:step()
  local list = self.list -- a job that has failed may close all of them, and then there is another
  for i = #list, 1, -1 do
    if self:is_over(list[i]) then self:kill(table.remove(list, i)) end
  end
  for i = #self.killed, 1, -1 do
    if self.killed[i]:is_gone() then table.remove(self.killed, i) end
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
    self:kill(one)
    finish(one, message, status)
  end
  for _, job in ipairs(queue) do job.failed(message, status) end
end

return renderers
