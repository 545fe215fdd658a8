--- A side of celspan watch: what is known of a film that is watched, and its renderers.
--
--   saved, or other values --> build --> renderers --> facts, parameters | an error
--                                            \--nobody asks for pictures--> its frames are checked
local program, request = ...
local json = require "celspan.json"
local parameters = require "celspan.parameters"
local renderers = program.part("renderers.lua", program, request)

local QUIET = 0.5          -- seconds without requests before frames are checked
local CHECKED_MOST = 5000  -- frames that are checked
local ANNOUNCED = 1        -- seconds between two reports of the number of checked frames
local FAULTS_MOST = 200

local side = {}
side.__index = side

--- script: its path. files, places: of files.lua and places.lua. tell(): called when pages need
--- news. build: the number of saves. heard: the time of the last request.
function side.new(script, files, places, tell)
  local self = setmetatable({ script = script, files = files, places = places, tell = tell,
                              build_number = 0, errors = {}, began = 0, heard = 0 }, side)
  self.pool = renderers.new(script, function(paths)
    for _, one in ipairs(paths) do files:add(one[1], self, one[2]) end
  end)
  files:add(script, self, true)
  return self
end

function side:add_error(message, frame)
  for _, known in ipairs(self.errors) do
    if known.message == message then return end
  end
  if #self.errors == FAULTS_MOST then return end
  table.insert(self.errors, self.places:describe(message, frame, self))
  self.tell()
end

-- ---------------------------------------------------------------- building

--- The frames to check in a film that was built: the first `count`. ask: the next request.
local function checks_of(facts)
  local count = math.min(facts.frames, CHECKED_MOST)
  return { ask = { want = "check", number = facts.first }, first = facts.first, count = count,
           announced = program.clock() }
end

--- Stores the facts that the script has given.
function side:take(head)
  self.facts, self.errors, self.is_building = head.film, {}, false
  self.facts.marks = { list = self.facts.marks }
  self.parameters = head.parameters
  self.is_shown, self.checked, self.check_state = true, 0, checks_of(head.film)
  self.tell()
end

--- Forgets the value of a parameter that the saved script has no more, or that cannot have it any
--- more. Returns whether a message says that there is one.
function side:drop_lost(message)
  local name = message:match "the script has no parameter '([%w_]+)'"
    or message:match "set: ([%w_]+) is "
  local is_lost = name and self.pool.values[name] ~= nil
  if is_lost then self.pool.values[name] = nil end
  return is_lost
end

--- Begins again with the current script.
function side:build()
  self.pool:close("the film was saved again", 503)
  self.build_number, self.began = self.build_number + 1, program.clock()
  self.is_building = true
  local number = self.build_number
  self.tell()
  self.pool:ask {
    ask = { want = "film" }, is_patient = true,
    done = function(head) self:take(head) end,
    failed = function(message)
      if number ~= self.build_number then return end
      if self:drop_lost(message) then return self:build() end
      self.errors, self.is_building = { self.places:describe(message, nil, self) }, false
      self.is_shown, self.check_state = false, nil
      self.tell()
    end,
  }
end

--- Gives values to parameters, { name = "text" }, and forgets all earlier ones. A parameter keeps
--- its earlier value if it cannot have the new one. Returns the values that are given now, and
--- sentences about those that cannot be, both by name.
function side:give_values(given)
  local values, refused = {}, {}
  for _, one in ipairs(self.parameters or {}) do
    local name = one.name
    if given[name] then values[name], refused[name] = parameters.taken(name, one, given[name]) end
    if refused[name] then values[name] = self.pool.values[name] end
  end
  self.pool.values = values
  self:build()
  return values, refused
end

--- Ends the film's processes. The film can be built again.
function side:close(message)
  self.build_number = self.build_number + 1
  self.is_building, self.is_shown, self.check_state = false, false, nil
  self.pool:close(message, 503)
end

-- ---------------------------------------------------------------- checking

--- The subject of the next request after this answer; nil: there is none. First all frames in
--- order; then some in the other order; if one of these differs, all frames in the other order.
local function next_ask(at, head)
  local again = { want = "again", count = at.count, at = head.at or 1, all = at.ask.all }
  if at.ask.want == "check" then
    local is_over = head.number >= at.first + at.count
    return is_over and again or { want = "check", number = head.number }
  end
  for _, fault in ipairs(at.ask.all and {} or head.faults) do
    if fault.impure then
      again.all, again.at = true, 1
      return again
    end
  end
  return head.at and again
end

function side:take_checked(at, head)
  at.is_asked = false
  for _, fault in ipairs(head.faults) do self:add_error(fault.message, fault.frame) end
  if self.check_state ~= at then return end
  if at.ask.want == "check" then self.checked = math.min(head.number - at.first, at.count) end
  at.ask = next_ask(at, head)
  if not at.ask then self.check_state = nil end
  if not at.ask or program.clock() - at.announced > ANNOUNCED then
    at.announced = program.clock()
    self.tell()
  end
end

--- Lets some frames be checked while no picture is requested.
function side:check()
  local at = self.check_state
  if not at or at.is_asked or program.clock() - self.heard < QUIET or not self.pool:is_idle() then
    return
  end
  at.is_asked = true
  self.pool:ask {
    ask = at.ask, is_patient = true,
    done = function(head) self:take_checked(at, head) end,
    failed = function(message)
      if self.check_state ~= at then return end
      self.check_state = nil
      if self.is_shown then self:add_error(message, at.ask.number) end
    end,
  }
end

-- ---------------------------------------------------------------- what is known

--- The values of parameters that the command line has, by name.
local function values_at_start()
  local values = {}
  local stored = request.set_from and json.read(request.set_from)
  for name, value in pairs(type(stored) == "table" and stored or {}) do values[name] = value end
  for _, option in ipairs(request.given) do
    local name, value = (option.name == "--set" and option.value or ""):match "^(.-)=(.*)$"
    if name then values[name] = value end
  end
  return values
end

--- A value as --set takes it: a point is "120,80".
local function text_of(value)
  if type(value) ~= "table" then return tostring(value) end
  return table.concat(value.list or value, ",")
end

--- The parameters with their values: those of the page, otherwise `start`, those of the command
--- line or the defaults. source: how the script declares a parameter with this value.
function side:describe_parameters()
  local values, list = values_at_start(), {}
  for i, one in ipairs(self.parameters or {}) do
    local start = values[one.name]
    if start == nil then start = one.default end
    start = text_of(start)
    local value = self.pool.values[one.name] or start
    list[i] = { name = one.name, type = one.type, format = one.format, default = one.default,
                minimum = one.minimum, maximum = one.maximum, description = one.description,
                group = one.group, enum = one.enum, value = value, start = start,
                source = parameters.line(one.name, one, value) }
  end
  return { list = list }
end

function side:describe()
  return { build = self.build_number, building = self.is_building or false,
           seconds = self.is_building and program.clock() - self.began or 0,
           checked = self.checked, checking = self.check_state ~= nil,
           film = self.facts, shown = self.is_shown or false, errors = { list = self.errors },
           script = self.script, parameters = self:describe_parameters(),
           options = { list = renderers.options() }, arguments = { list = request.arguments } }
end

--- Asks the renderers. Calls give(head, bytes) or refuse(status, sentence). wish: the name by which
--- the request can be given up.
function side:ask(ask, give, refuse, wish)
  self.heard = program.clock()
  self.pool:ask {
    ask = ask, wish = wish,
    done = give,
    failed = function(message, status)
      if ask.number and status == 422 then self:add_error(message, ask.number) end
      refuse(status, message)
    end,
  }
end

return side
