--- celspan stage SCRIPT: a film that answers requests, for celspan watch, which runs several of
--- them (program/renderer_service.c).
--
--   standard input    size, { "want": "frame", "number": 3, ... }
--   standard output   size, size of the head, { "good": true, ... }, bytes
--
-- Sizes have four bytes, the highest first. Every answer has in `files` the paths that the script
-- has asked for since the one before, { path, whether it was let read there }. What the script
-- prints goes to standard error: while it is run, and for pictures. Frames that are built for other
-- reasons, such as checks of all of them, print nothing.
local program, request = ...
local json = require "celspan.json"
local core = require "celspan.core"

local CHECK_SECONDS = 0.03 -- of checking frames, for one request
local SHEET_MOST = 10000   -- frames of a sheet

local film

local function put(head, bytes)
  head.files = {}
  for mark, path in (film and film:files() or ""):gmatch "([+-])(%Z+)%z" do
    head.files[#head.files + 1] = { path, mark == "+" }
  end
  local text = program.json(head)
  bytes = bytes or ""
  io.stdout:write(string.pack(">I4s4", 4 + #text + #bytes, text), bytes)
  io.stdout:flush()
end

local function refuse(message, code) put { good = false, message = message, code = code } end

-- ---------------------------------------------------------------- answers

local answers = {}

--- The parameters of the film, sorted by name, each described as in JSON Schema.
local function parameters()
  local list = {}
  local schema = assert(json.decode(film:ask("celspan.parameters", "schema", "")))
  for name, one in pairs(schema.properties) do
    one.name = name
    one.enum = one.enum and { list = one.enum }
    list[#list + 1] = one
  end
  table.sort(list, function(a, b) return a.name < b.name end)
  return { list = list }
end

function answers.film()
  local facts = { frames = film.frames, first = film.first, fps = film.fps, size = film.size,
                  title = film.title, marks = { list = film.marks }, sound = film.has_sound }
  put { good = true, film = facts, parameters = parameters() }
end

--- The previous request is not wanted any more. It has been answered already.
function answers.abandon() end

--- Builds a frame. by: the frame whose camera is used, or nil.
local function build_seen(number, by)
  if not by then return film:try(number) end
  local good, message, code = film:try(by)
  if good then film:hold_camera() end
  if good then good, message, code = film:try(number) end
  if good then return film:use_camera() end
  return good, message, code
end

--- The letters of cels by name, from a list { { name, letters }, ... }.
local function letters_of(list)
  local letters = {}
  for _, one in ipairs(list) do letters[one[1]] = one[2] end
  return letters
end

--- Builds a frame, with its cels changed as ask.cels says. false: refused.
local function build(ask)
  local good, message, code = build_seen(ask.number, ask.camera)
  if good and ask.cels then good, message = film:alter(letters_of(ask.cels)) end
  if not good then refuse(message, code) end
  return good
end

--- Calls a method of the film with the size and the crop that were asked for.
local function of_view(ask, method, ...)
  local w, h = table.unpack(ask.size)
  local x, y, width, height = table.unpack(ask.crop)
  return film[method](film, w, h, x, y, width, height, ...)
end

--- ask.made: { file, line }: only what this line made is shown.
function answers.frame(ask)
  local began = program.clock()
  if not build(ask) then return end
  local camera = film:camera()
  if ask.made then film:keep_line(ask.made[1], ask.made[2]) end
  local bytes, message = of_view(ask, "picture", ask.what)
  if not bytes then return refuse(("frame %d: %s"):format(ask.number, message)) end
  put({ good = true, seconds = program.clock() - began, camera = camera }, bytes)
end

--- The cost of the frame, which is the first of `costs`, and the cost of each of its cels alone.
function answers.costs(ask)
  if not build(ask) then return end
  local costs = { list = {} }
  local good, message = of_view(ask, "costs", function(one) table.insert(costs.list, one) end)
  if not good then return refuse(("frame %d: %s"):format(ask.number, message)) end
  put { good = true, costs = costs }
end

--- The frames, of the first SHEET_MOST, in which a line made something: `runs`, { first, last }.
function answers.made(ask)
  local runs = { list = {} }
  for i = 1, math.min(film.frames, SHEET_MOST) do
    local number, last = film.first + i - 1, runs.list[#runs.list]
    if film:try(number) and film:keep_line(ask.file, ask.line) then
      if last and last[2] == number - 1 then
        last[2] = number
      else
        table.insert(runs.list, { number, number })
      end
    end
  end
  put { good = true, runs = runs }
end

function answers.at(ask)
  film:keep_callers(true)
  local is_built = build(ask)
  film:keep_callers(false)
  if not is_built then return end
  local hits = {}
  local message = film:hits(ask.x, ask.y, function(kind, name, source, line, callers)
    hits[#hits + 1] = { kind = kind, name = name, file = source, line = source and line,
                        callers = callers }
  end)
  if message then return refuse(message) end
  put { good = true, hits = hits }
end

--- The exposure sheet of the film's first SHEET_MOST frames; nil: refused.
local function sheet_of()
  local numbers = {}
  for i = 1, math.min(film.frames, SHEET_MOST) do numbers[i] = film.first + i - 1 end
  local good, made = pcall(require "celspan.sheet".of, film, { frames = numbers })
  if good then return made end
  refuse(program.reported() or tostring(made))
end

function answers.sheet()
  local sheet = sheet_of()
  if not sheet then return end
  local text, message = sheet:text()
  if not text then return refuse(message) end
  put({ good = true }, text)
end

--- Whether a layer of the sheet is a cel in its first drawing.
local function is_cel(name, cells)
  for _, cell in ipairs(cells.list) do
    if cell[2] ~= "" then
      for _, part in ipairs(core.parts(film:at(film.first + cell[1] - 1))) do
        if part.kind == "cel" and part.name == name then return true end
      end
      return false
    end
  end
  return false
end

--- A row for each layer, the nearest first. cells: { first frame, drawing } in order, with the
--- drawing "" where there is none. moved: the frames on which only the placement changes. cel:
--- whether the layer is a cel.
function answers.rows()
  local sheet, rows = sheet_of(), {}
  if not sheet then return end
  for i = #sheet.layers, 1, -1 do
    local row = { name = sheet.layers[i], cells = { list = {} }, moved = { list = {} } }
    for j, change in ipairs(sheet:changes(i)) do
      row.cells.list[j] = { change.frame, change.drawing or "" }
    end
    for frame = 1, sheet.frames do
      if sheet:marks(i, frame).moved then table.insert(row.moved.list, frame) end
    end
    row.cel = is_cel(row.name, row.cells)
    rows[#rows + 1] = row
  end
  put({ good = true }, program.json { rows = { list = rows }, frames = sheet.frames })
end

--- The first `count` shapes of the mouths that the film has read, as rows.
local function lips_of(count)
  local rows = { list = {} }
  for path, shapes in film:ask("celspan.mouths", "kept_text", ""):gmatch "(%Z*)%z(%Z*)%z" do
    local row = { name = path:match "[^/]*$", cells = { list = {} } }
    for frame, shape in shapes:gmatch "(%d+) ([^\n]*)\n" do
      if math.tointeger(frame) > count then break end
      table.insert(row.cells.list, { math.tointeger(frame), shape })
    end
    table.insert(rows.list, row)
  end
  return rows
end

function answers.sound(ask)
  local bytes, message = film:sound(ask.first, ask.count)
  if not bytes then return refuse(message) end
  put({ good = true }, bytes)
end

--- The amplitude of the sound, in columns over the first SHEET_MOST frames, and the shapes of the
--- mouths.
function answers.wave(ask)
  local count, columns = math.min(film.frames, SHEET_MOST), {}
  if film.has_sound then
    local bytes, message = film:wave(film.first, count, ask.columns)
    if not bytes then return refuse(message) end
    for i = 1, #bytes do columns[i] = bytes:byte(i) end
  end
  put({ good = true }, program.json { columns = { list = columns }, lips = lips_of(count) })
end

local scenes = {} -- of the frames that were checked, by number

--- Adds the faults of the sound and the script.
local function add_whole(faults)
  if film:check_sound() ~= 0 then faults[1] = { message = program.reported() } end
  for _, message in ipairs(program.part("dropped.lua", program).of_script(request[1])) do
    faults[#faults + 1] = { message = message }
  end
end

--- Checks at least one frame, and then more until the time is over. With the first frame, also
--- checks the sound and the script.
function answers.check(ask)
  local faults, number, began = {}, ask.number, program.clock()
  local last = film.first + film.frames - 1
  if number == film.first then add_whole(faults) end
  film:drop_warnings()
  repeat
    local good, message = film:try(number)
    local function add(where, text)
      local message_of = where == "" and text or where .. ": " .. text
      faults[#faults + 1] = { frame = number, message = message_of }
    end
    if good then film:faults(add) else add("", message) end
    scenes[number] = good and film:scene()
    number = number + 1
  until number > last or program.clock() - began > CHECK_SECONDS
  put { good = true, number = number, faults = faults }
end

local again -- the film of the script after it was run again

--- Why there is no film of a second run; nil: there is one.
local function open_again()
  local is_open, fresh
  if again then return nil end
  is_open, fresh = pcall(program.film, nil, true)
  if not is_open then return program.reported() or tostring(fresh) end
  again = fresh
  again:keep_callers(false)
  if fresh.first ~= film.first or fresh.frames ~= film.frames then
    return program.other_frames(fresh, film)
  end
end

--- Whether a frame is the same in both films; true, too, if they cannot be compared.
local function is_pure(number)
  local scene = scenes[number]
  -- another process has checked it
  if scene == nil then scene = film:try(number) and film:scene() end
  return not scene or again:try(number) and again:scene() == scene
end

--- The places of the frames, among the first `count`, that are built again, the last one first.
local function places_again(ask)
  if not ask.all then return program.sample(ask.count, 1)[1] end
  local places = {}
  for i = 1, ask.count do places[i] = ask.count + 1 - i end
  return places
end

--- Builds at least one frame in the other order in another film, and then more until the time is
--- over. The frames are those of its list from `at` on. Returns where to continue as `at`; nil: all
--- have been built.
function answers.again(ask)
  local faults, at, began = {}, ask.at, program.clock()
  local message = open_again()
  if message then return put { good = true, faults = { { message = message } } } end
  local places = places_again(ask)
  repeat
    local number = film.first + places[at] - 1
    if not is_pure(number) then
      faults[#faults + 1] = { frame = number, impure = true,
                              message = ("frame %d: %s"):format(number, program.impure) }
    end
    at = at + 1
  until at > #places or program.clock() - began > CHECK_SECONDS
  put { good = true, at = at <= #places and at or nil, faults = faults }
end

-- ---------------------------------------------------------------- requests

--- A picture is given up when another request arrives, which `program/stage.c` finds out from the
--- pipe. Therefore no request may wait in a buffer of Lua.
io.stdin:setvbuf "no"

--- The next request; nil: no more will arrive.
local function take()
  local head = io.stdin:read(4)
  local size = head and #head == 4 and (">I4"):unpack(head)
  local text = size and io.stdin:read(size)
  return text and #text == size and json.decode(text) or nil
end

local good, made = pcall(program.film, request[1])
if good then
  film = made
  film:keep_callers(false)
end
for ask in take do
  if not film then
    refuse(program.reported() or tostring(made), program.outcome())
  else
    film:silence(ask.want ~= "frame")
    local is_answered, fault = pcall(answers[ask.want], ask)
    if not is_answered then refuse(program.reported() or tostring(fault)) end
  end
  if program.is_stopped() then break end
end
