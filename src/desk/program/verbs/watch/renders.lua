--- The render that a page has asked for (celspan watch): a run of celspan render beside the page.
--
--   begin --> running --events of --progress json--> done | failed
--                  \--cancel--> cancelled
--
-- INVARIANT: it writes into the folder of the script, or that of -o, or a folder in it, also where
-- links lead; it replaces a file only if the page has said so; and what it wrote is removed when it
-- fails or is cancelled. A name is one word of the command line behind -o, and never an option.
-- What the run prints may come from the script, so only finite numbers and short texts of it are
-- passed on.
local program = ...
local json = require "celspan.json"

local FILES_MOST = 100000 -- the most pictures of a render
local MARKS_MOST = 20     -- the most # of a name, as the renderer has them
local LINE_MOST = 16384   -- bytes of a line; of a longer one the end is kept
local TAIL = 2000         -- bytes of the last words that are kept
local SIDE_MOST = 65535   -- pixels
local NEWS = 0.25         -- seconds between two reports of the progress
local PATIENCE = 5        -- seconds for a run to end by itself; then it is killed
local CLOSING = 400       -- milliseconds for it when the page's server ends, which is in a hurry

local renders = {}
renders.__index = renders

-- Whether a format holds pictures alone; nil: it holds neither pictures nor videos.
local stills, offers = {}, {}
for _, output in ipairs(program.outputs()) do
  offers[#offers + 1] = output.offers
  for _, name in ipairs(output.names) do
    if output.kind == "videos" then
      stills[name] = false
    elseif output.kind == "pictures" and stills[name] == nil then
      stills[name] = true
    end
  end
end

--- folder: of the files, with a / at its end; "" for the working folder. tell(): called when pages
--- need news. number: of the renders that have begun.
function renders.new(side, folder, tell)
  return setmetatable({ side = side, folder = folder, tell = tell, said = { state = "idle" },
                        number = 0, reported = 0 }, renders)
end

--- The formats of the form, as options in HTML.
function renders.options()
  return (table.concat(offers):gsub("(%w+) ([^\n]+)\n", function(name, words)
    if stills[name] == nil then return "" end
    return ('<option value="%s"%s>%s</option>'):format(name, stills[name] and " data-still" or "",
      words)
  end))
end

-- ---------------------------------------------------------------- what is wanted

--- Why a name is no name of a file in a folder; nil: it is one.
local function fault_of_name(name, format)
  if type(name) ~= "string" or name == "" then return "write the name of a file" end
  if #name > 1000 or name:find "[%c\\]" then
    return "the name is too long, or has characters that no file should have"
  end
  if name:sub(1, 1) == "/" then
    return "the file must lie in the folder of the renders: no name from /"
  end
  for part in (name .. "/"):gmatch "([^/]*)/" do
    if part == "" or part:sub(1, 1) == "." then
      return "no part of the name may be empty or begin with a dot"
    end
    if part:sub(1, 1) == "-" then return "no part of the name may begin with -" end
    if #part > 255 then return "a part of the name is too long" end
  end
  if name:find "%%" then return "write #### for the number of a frame" end
  if name:match "%.(%w+)$" ~= format then
    return ("the name of the file must end with .%s"):format(format)
  end
end

--- The path of a name in the folder of the renders; nil and why it must not be written.
local function place_of(top, name)
  top = top == "" and "./" or top
  local path, folder = top .. name, program.resolve(top)
  local above = path:match "^.*/"
  local parent, target = program.resolve(above), program.resolve(path)
  local is_in = folder and parent and program.is_within(folder, parent)
  if not is_in or target and not program.is_within(folder, target) then
    return nil, "the file must lie in the folder of the renders, " .. top
  end
  if not program.entries(above) then return nil, "there is no such folder: make it first" end
  return path
end

--- The frames of a text, first and last; nil: it is no range of the film.
local function range_of(text, facts)
  local last_frame = facts.first + facts.frames - 1
  if text == nil or text == "" then return facts.first, last_frame end
  local from, to = text:match "^(%-?%d+)%-(%-?%d+)$"
  from, to = math.tointeger(from or text), math.tointeger(to or text)
  local is_good = from and to and facts.first <= from and from <= to and to <= last_frame
  if is_good then return from, to end
end

--- The files that a render makes. Only the last part of a path has a number.
local function files_of(path, from, to)
  local before, marks, after = path:match "^(.-)(#+)([^#/]*)$"
  if not marks then return { path } end
  local list = {}
  for number = from, to do
    local digits = ("%0" .. #marks .. "d"):format(number)
    list[#list + 1] = before .. digits .. after
  end
  return list
end

--- A whole description of what is wanted; nil and a sentence.
function renders:read(given)
  local facts, format = self.side.facts, given.format
  if stills[format] == nil then return nil, "there is no such format" end
  local fault = fault_of_name(given.file, format)
  if fault then return nil, fault end
  local path, why = place_of(self.folder, given.file)
  if not path then return nil, why end
  local from, to = range_of(given.frames, facts)
  if not from then return nil, "the film has no such frames" end
  local is_sequence = given.file:find "#" ~= nil
  if given.file:find "#.*[^#]+.*#" or given.file:find "#.*/" then
    return nil, "write one #### for the number of the frame, in the last part of the name"
  end
  if #(given.file:match "#+" or "") > MARKS_MOST then
    return nil, ("at most %d # for the number of the frame"):format(MARKS_MOST)
  end
  if is_sequence and not stills[format] then return nil, "a video has one file, without ####" end
  if stills[format] and not is_sequence and from ~= to then
    return nil, "write #### where each picture has its number, such as shot.####." .. format
  end
  if is_sequence and to - from >= FILES_MOST then
    return nil, ("at most %d pictures at once"):format(FILES_MOST)
  end
  local w, h = (given.size or ""):match "^(%d+)x(%d+)$"
  w, h = math.tointeger(w), math.tointeger(h)
  if (given.size or "") ~= "" and not (w and w > 0 and h > 0 and math.max(w, h) <= SIDE_MOST) then
    return nil, "write the size as 1280x720"
  end
  return { path = path, file = given.file, files = files_of(path, from, to), from = from, to = to,
           size = w and ("%dx%d"):format(w, h), draft = given.draft == true }
end

-- ---------------------------------------------------------------- the process

--- The words of the run: with the rights of this one, and the values that the page has given.
function renders:words(wanted)
  local range = ("%d-%d"):format(wanted.from, wanted.to)
  local words = { "render", self.side.script, "-o", wanted.path, "--frames", range,
                  "--progress", "json" }
  if wanted.size then table.move({ "--size", wanted.size }, 1, 2, #words + 1, words) end
  if wanted.draft then words[#words + 1] = "--draft" end
  return self.side.pool:add_options(words)
end

--- Notes which files the run will make. false: one is there already, whoever may read it.
local function note_made(wanted, may_replace)
  wanted.made = {}
  for _, path in ipairs(wanted.files) do
    local _, _, why = program.entries(path)
    if why == "missing" then
      wanted.made[#wanted.made + 1] = path
    elseif not may_replace then
      return false
    end
  end
  return true
end

--- Begins a render. given: what the form says. Returns a status; if it is refused also a sentence,
--- and whether the reason is that a file exists.
function renders:begin(given)
  if self.process then return 409, "a render is running: cancel it first" end
  for _, name in ipairs { "format", "file", "frames", "size" } do
    if type(given[name] or "") ~= "string" then return 400, name .. " is no text" end
  end
  local wanted, why = self:read(given)
  if not wanted then return 400, why end
  if not note_made(wanted, given.replace == true) then
    return 409, ("%s is there already"):format(wanted.file), true
  end
  local process, message = program.renderer(self:words(wanted))
  if not process then return 500, message end
  self.process, self.wanted, self.text, self.tail, self.message = process, wanted, "", "", nil
  self.number = self.number + 1
  self:say { state = "running", file = wanted.file }
  return 200
end

--- Stores the state for the pages. Progress is reported a few times a second, everything else at
--- once.
function renders:say(said, is_progress)
  self.said, self.is_behind, said.number = said, true, self.number
  if not is_progress then self.reported = 0 end
  self:report()
end

--- Reports what the pages do not know yet, if it is time.
function renders:report()
  if not self.is_behind or program.clock() - self.reported < NEWS then return end
  self.is_behind, self.reported = false, program.clock()
  self.tell()
end

-- ---------------------------------------------------------------- what the run prints

--- A finite number that is not below 0; nil: the value is something else.
local function number_of(value)
  return type(value) == "number" and value >= 0 and value < math.huge and value or nil
end

--- Takes a line that the run has printed.
function renders:hear(line)
  local event = line:find "^{" and json.decode(line)
  local kind = type(event) == "table" and event.event
  if kind == "frame" or kind == "start" then
    self:say({ state = "running", file = self.wanted.file, done = number_of(event.done) or 0,
               count = number_of(event.count), left = number_of(event.left) }, true)
  elseif kind == "error" and type(event.message) == "string" then
    self.message = self.message or event.message:sub(1, TAIL)
  elseif not kind then
    self.tail = (self.tail .. line .. "\n"):sub(-TAIL)
  end
end

--- Reads what the run has printed since the last time.
function renders:listen()
  local text, at = self.text .. self.process:words(), 1
  for stop in function() return text:find("\n", at, true) end do
    self:hear(text:sub(at, stop - 1))
    at = stop + 1
  end
  self.text = text:sub(math.max(at, #text - LINE_MOST + 1))
end

-- ---------------------------------------------------------------- the end

--- Removes what the run has made and was not there before, and what a run that was killed has left:
--- files whose names are as in output/sinks/file.h.
function renders:remove(was_killed)
  for _, path in ipairs(self.wanted.made) do os.remove(path) end
  local folder, begun = self.wanted.path:match "^.*/" or "./", {}
  for _, path in ipairs(was_killed and self.wanted.files or {}) do
    begun["." .. path:match "[^/]*$"] = true
  end
  for _, entry in ipairs(was_killed and program.entries(folder) or {}) do
    if begun[entry:match "^(.*)%.%x%x%x%x%.part$"] then os.remove(folder .. entry) end
  end
end

function renders:finish()
  local code, signal = self.process:finish()
  local is_cancelled, file = self.stopped ~= nil, self.wanted.file
  self.process, self.stopped = nil, nil
  if code == 0 and not is_cancelled then return self:say { state = "done", file = file } end
  self:remove(code == nil)
  if is_cancelled then return self:say { state = "cancelled", file = file } end
  local said = self.message or self.tail:match "([^\n]+)\n*$"
  self:say { state = "failed", file = file,
             message = said or signal or ("exit code %d"):format(code) }
end

--- Ends the run; what it has made is removed. milliseconds: to wait for it.
function renders:cancel(milliseconds)
  if not self.process or self.stopped then return end
  self.stopped = program.clock()
  self.process:stop(milliseconds or 0)
end

--- Reads what the run has said, and ends it if it does not end by itself.
function renders:step()
  self:report()
  if not self.process then return end
  self:listen()
  local is_over = self.process:take() == false
  if is_over then
    self:listen()
    self:hear(self.text)
  end
  if is_over or self.stopped and program.clock() - self.stopped > PATIENCE then self:finish() end
end

function renders:add_descriptors(list)
  if not self.process then return end
  for _, descriptor in ipairs { self.process:descriptors() } do list[#list + 1] = descriptor end
end

--- Ends the run when the page's server ends.
function renders:close()
  if not self.process then return end
  self.stopped = nil
  self:cancel(CLOSING)
  self:finish()
end

return renders
