--- celspan stage SCRIPT: a film that answers requests, for celspan watch, which runs several of
--- them (program/services/renderer_service.c).
--
--   standard input    { "want": "frame", "number": 3, ... }, read by services/stage_service.c
--   standard output   size, size of the head, { "good": true, ... }, bytes
--
-- Sizes have four bytes, the highest first. The answer for a frame says that it has `begun`. Its
-- picture, in whose head `picture` is the number of the request, comes by itself when it is drawn,
-- and may come before the answer that says so. All answers but pictures have in `files` the paths
-- that the script has asked for since the answer before, { path, whether it was let read there }.
-- What the script prints goes to standard error: while it is run, and for pictures. Frames that are
-- built for other reasons, such as checks of all of them, print nothing.
local program, request = ...
local json = require "celspan.json"
local texts = require "celspan.files"

local CHECK_SECONDS = 0.03 -- time to check frames, for one request
local SHEET_MOST = 10000   -- frames of a sheet
local SCRIPT_MOST = 1 << 20 -- bytes of a script in which parameters are looked for
local TREE_MOST = 2000     -- cels and objects of a frame's tree
local SKIN_MOST = 2048     -- pixels of a side of an onion skin

local requests = program.stage()
local script
local parts -- the shots of a cut; nil: the film is not a cut

local function put(head, bytes)
  head.files = {}
  for mark, path in (script and script:files() or ""):gmatch "([+-])(%Z+)%z" do
    head.files[#head.files + 1] = { path, mark == "+" }
  end
  local text = program.json(head)
  bytes = bytes or ""
  -- one write, because other threads write pictures
  io.stdout:write(string.pack(">I4s4", 4 + #text + #bytes, text) .. bytes)
  io.stdout:flush()
end

local function refuse(message, code) put { good = false, message = message, code = code } end

-- ---------------------------------------------------------------- answers

local answers = {}

--- Where a parameter is declared in the text of the script, in bytes; names that are not found come
--- last.
local function place_of(text, name)
  local call = text:find "parameters%s*[({]" or 1
  return text:find("%f[%w_]" .. name .. "%s*=[^=]", call)
    or text:find("%[%s*[\"']" .. name .. "[\"']%s*%]%s*=[^=]", call) or math.huge
end

--- The parameters of the film in the order of the script, each described as in JSON Schema.
local function parameters()
  local list, places = {}, {}
  local described = script:kept("celspan.parameters", "schema", "")
  if described == "" then return { list = {} } end
  local text = texts.read(request[1], SCRIPT_MOST) or ""
  local schema = assert(json.decode(described))
  for name, one in pairs(schema.properties) do
    one.name, places[name] = name, place_of(text, name)
    if type(one.default) == "table" then one.default = { list = one.default } end
    one.enum = one.enum and { list = one.enum }
    list[#list + 1] = one
  end
  table.sort(list, function(a, b)
    local first, second = places[a.name], places[b.name]
    if first ~= second then return first < second end
    return a.name < b.name
  end)
  return { list = list }
end

function answers.film()
  local facts = { frames = script.frames, first = script.first, poster = script.poster,
                  fps = script.fps, size = script.size, title = script.title,
                  marks = { list = script.marks }, sound = script.has_sound }
  facts.shots = parts and { list = parts }
  put { good = true, film = facts, parameters = parameters() }
end

--- Builds a frame. by: the frame whose camera is used, or nil.
local function build_seen(number, by)
  if not by then return script:try(number) end
  local good, message, code = script:try(by)
  if good then script:hold_camera() end
  if good then good, message, code = script:try(number) end
  if good then return script:use_camera() end
  return good, message, code
end

--- The letters of cels by name, from a list { { name, letters }, ... }.
local function letters_of(list)
  local letters = {}
  for _, one in ipairs(list) do letters[one[1]] = one[2] end
  return letters
end

--- Labels, each between two ends of lines.
local function lines_of(labels)
  return "\n" .. (#labels > 0 and table.concat(labels, "\n") .. "\n" or "")
end

--- Builds a frame with the skins of ask.onion, { before, after }, of the cels with the labels that
--- ask.skins lists, or of all that are no ground; but not of those that ask.cels hides.
local function build_onion(ask)
  local w, h = table.unpack(ask.size)
  local shrunk, hidden = math.min(1, SKIN_MOST / math.max(w, h)), {}
  for _, one in ipairs(ask.cels or {}) do
    if one[2]:find "h" then hidden[#hidden + 1] = one[1] end
  end
  local labels = lines_of(ask.skins) .. lines_of(hidden)
  return script:onion(ask.number, ask.onion[1], ask.onion[2], math.max(1, math.floor(shrunk * w)),
    math.max(1, math.floor(shrunk * h)), labels)
end

--- Calls a function while `celspan.shots` does something, which ends also after an error in it.
local function during(what, value, ending, call, ...)
  script:ask("celspan.shots", what, value)
  local results = table.pack(pcall(call, ...))
  local is_ended, fault = pcall(script.ask, script, "celspan.shots", what, ending)
  if not results[1] then error(results[2], 0) end
  if not is_ended then error(fault, 0) end
  return table.unpack(results, 2, results.n)
end

--- Builds a frame with a function; in a cut its shots are marked. Returns what the function does.
local function marked(build_it, ...)
  if not parts then return build_it(...) end
  return during("mark", "on", "off", build_it, ...)
end

local points = {}  -- the points that a frame has read, such as ",sun,lamp,", by its number
local before = "," -- files that the script has read before any frame

--- Those and the points that the script has read since this was asked for last.
local function with_points(known)
  for name in script:kept("celspan.parameters", "reads", ""):gmatch "[^,]+," do
    if not known:find("," .. name, 1, true) then known = known .. name end
  end
  return known
end

--- Notes what was read for a request in ask.points. It is the frame's own, and kept, unless other
--- frames were built for it, too.
local function note_points(ask)
  ask.points = with_points(ask.points or points[ask.number] or before)
  if not ask.onion and not ask.camera then points[ask.number] = ask.points end
end

--- Builds a frame, with its cels changed as ask.cels says. false: refused.
local function build(ask)
  local good, message, code
  with_points(before) -- what others have read is not of this frame
  if ask.onion then
    good, message, code = marked(build_onion, ask)
  else
    good, message, code = marked(build_seen, ask.number, ask.camera)
  end
  if good and ask.cels then
    good, message = script:alter(letters_of(ask.cels), parts ~= nil)
  end
  if not good then refuse(message, code) end
  note_points(ask)
  return good
end

--- Calls a method of the film with the size and the crop that were asked for.
local function of_view(ask, method, ...)
  local w, h = table.unpack(ask.size)
  local x, y, width, height = table.unpack(ask.crop)
  return script[method](script, w, h, x, y, width, height, ...)
end

--- ask.made: { file, line [, name [, label]] }: only what this line made is shown, of that name and
--- in the cel of that label. ask.workers: the threads that may draw it; nil: those of the command
--- line.
function answers.frame(ask)
  local began = program.clock()
  if not build(ask) then return end
  local head = { good = true, begun = true, camera = script:camera() }
  if ask.made then script:keep_line(table.unpack(ask.made)) end
  head.seconds = program.clock() - began
  local is_begun, message = of_view(ask, "draw", ask.what, ask.workers, requests)
  if not is_begun then return refuse(("frame %d: %s"):format(ask.number, message)) end
  note_points(ask) -- procedures read points while they draw
  head.points = ask.points
  put(head)
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
  for i = 1, math.min(script.frames, SHEET_MOST) do
    local number, last = script.first + i - 1, runs.list[#runs.list]
    if script:try(number) and script:keep_line(ask.file, ask.line) then
      if last and last[2] == number - 1 then
        last[2] = number
      else
        table.insert(runs.list, { number, number })
      end
    end
  end
  put { good = true, runs = runs }
end

--- The objects and cels at a point, from front to back; in a transition only of the shot that is
--- seen more come first. And a message, if they are not all.
local function hits_of(x, y)
  local hits, places = {}, {}
  local message = script:hits(x, y, function(hit)
    hits[#hits + 1], places[hit] = hit, #hits
  end, parts ~= nil)
  table.sort(hits, function(a, b)
    if a.share ~= b.share then return a.share > b.share end
    return places[a] < places[b]
  end)
  return hits, message
end

function answers.at(ask)
  script:keep_callers(true)
  local is_built = build(ask)
  script:keep_callers(false)
  if not is_built then return end
  local hits, message = hits_of(ask.x, ask.y)
  if message then return refuse(message) end
  put { good = true, hits = hits }
end

--- The tree of the cels of the frame that was built last, and of the objects in them that have a
--- name, the nearest first. A cel that is in several exposures, as of a shutter, is there
--- once.
local function tree_of()
  local tree, exposures, shot = {}, {}, nil
  script:tree(TREE_MOST, parts ~= nil, function(depth, kind, name, source, line, own, label,
                                              exposure)
    if depth == 0 then shot = own ~= "" and own or nil end
    if label and shot then label = shot .. "/" .. label end
    if label and (exposures[label] or exposure) < exposure then return false end
    if label then exposures[label] = exposure end
    tree[#tree + 1] = { depth = depth, kind = kind, name = name, file = source,
                        line = source and line, label = label, shot = shot }
    return true
  end)
  return tree
end

function answers.tree(ask)
  if build(ask) then put { good = true, tree = { list = tree_of() } } end
end

--- The exposure sheet of the frames `from` to `to`, of which the first is 1; nil: refused.
local function sheet_of(from, to)
  local numbers = {}
  for number = from or 1, to or math.min(script.frames, SHEET_MOST) do
    numbers[#numbers + 1] = script.first + number - 1
  end
  local good, made = pcall(require "celspan.sheet".of, script, { frames = numbers })
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

--- The labels of the cels of frames, as keys, and those of the cels in which parts are, by the
--- names of these. They are found as they are needed.
local function new_labels()
  return setmetatable({}, { __index = function(frames, number)
    local labels, owners, cel = {}, {}, nil
    for _, one in ipairs(marked(script.try, script, number) and tree_of() or {}) do
      if one.label or one.depth == 0 then cel = one.label end
      if one.label then labels[cel] = true end
      if one.name and not one.label then owners[one.name] = owners[one.name] or cel end
    end
    frames[number] = { labels = labels, owners = owners }
    return frames[number]
  end })
end

--- The label of the cel in whose first drawing a layer of the sheet is, or else nil and the label
--- of the cel that it is a part of; nil: it is neither.
local function label_of(labels, name, cells, shot)
  for _, cell in ipairs(cells.list) do
    if cell[2] ~= "" then
      local known, longer = labels[script.first + cell[1] - 1], shot and shot.name .. "/" .. name
      if known.labels[longer or ""] then return longer end
      if known.labels[name] then return name end
      return nil, known.owners[name:match "[^/]*$"]
    end
  end
end

--- Adds the rows of the frames from..to. cells: { first frame, drawing } in order, with the drawing
--- "" where there is none. moved: the frames on which only the placement changes. false: refused.
local function add_rows(rows, from, to)
  local sheet = sheet_of(from, to)
  for i = sheet and #sheet.layers or 0, 1, -1 do
    local row = { name = sheet.layers[i], cells = { list = {} }, moved = { list = {} } }
    for j, change in ipairs(sheet:changes(i)) do
      row.cells.list[j] = { from - 1 + change.frame, change.drawing or "" }
    end
    for frame = 1, sheet.frames do
      if sheet:marks(i, frame).moved then table.insert(row.moved.list, from - 1 + frame) end
    end
    rows[#rows + 1] = row
  end
  return sheet ~= nil
end

--- Adds the rows of a shot, which are named by it: "evening / nell / mouth".
local function add_shot(rows, shot, last)
  local begin, labels = #rows + 1, new_labels()
  local is_added = marked(add_rows, rows, shot.from, math.min(shot.to, last))
  for i = begin, #rows do
    local row, own = rows[i], shot.name .. "/"
    local name = row.name:sub(1, #own) == own and row.name:sub(#own + 1) or row.name
    row.cel, row.of = label_of(labels, name, row.cells, shot)
    row.shot, row.name = shot.name, shot.name .. " / " .. name:gsub("/", " / ")
    if shot.to < last then table.insert(row.cells.list, { shot.to + 1, "" }) end
  end
  return is_added
end

--- A row for each layer, the nearest first; in a cut those of a shot together. cel: the label of
--- the cel that the layer is; of: that of the cel that it is a part of.
function answers.rows()
  local rows, last = {}, math.min(script.frames, SHEET_MOST)
  for place, shot in ipairs(parts or {}) do
    -- in its transitions the cels of other shots are left out
    local alone = ("%d %d"):format(script.frames, place)
    if shot.from <= last and not during("isolate", alone, "", add_shot, rows, shot, last) then
      return
    end
  end
  if not parts then
    local labels = new_labels()
    if not add_rows(rows, 1, last) then return end
    for _, row in ipairs(rows) do row.cel, row.of = label_of(labels, row.name, row.cells) end
  end
  put({ good = true }, program.json { rows = { list = rows }, frames = last })
end

--- The first `count` shapes of the mouths that the film has read, as rows.
local function lips_of(count)
  local rows = { list = {} }
  for path, shapes in script:kept("celspan.mouths", "kept_text", ""):gmatch "(%Z*)%z(%Z*)%z" do
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
  local bytes, message = script:sound(ask.first, ask.count)
  if not bytes then return refuse(message) end
  put({ good = true }, bytes)
end

--- The amplitude of the sound, in columns over the first SHEET_MOST frames, and the shapes of the
--- mouths.
function answers.wave(ask)
  local count, columns = math.min(script.frames, SHEET_MOST), {}
  if script.has_sound then
    local bytes, message = script:wave(script.first, count, ask.columns)
    if not bytes then return refuse(message) end
    for i = 1, #bytes do columns[i] = bytes:byte(i) end
  end
  put({ good = true }, program.json { columns = { list = columns }, lips = lips_of(count) })
end

local scenes = {} -- scenes of the frames that were checked, by number

--- Adds the faults of the sound and the script.
local function add_whole(faults)
  if script:check_tracks() ~= 0 then faults[1] = { message = program.reported() } end
  for _, message in ipairs(program.part("dropped.lua", program).of_script(request[1])) do
    faults[#faults + 1] = { message = message }
  end
end

--- Checks at least one frame, and then more until the time is over. With the first frame, also
--- checks the sound and the script.
function answers.check(ask)
  local faults, number, began = {}, ask.number, program.clock()
  local last = script.first + script.frames - 1
  if number == script.first then add_whole(faults) end
  script:drop_warnings()
  repeat
    local good, message = script:try(number)
    local function add(where, text)
      local message_of = where == "" and text or where .. ": " .. text
      faults[#faults + 1] = { frame = number, message = message_of }
    end
    if good then script:faults(add) else add("", message) end
    scenes[number] = good and script:scene()
    number = number + 1
  until number > last or program.clock() - began > CHECK_SECONDS
  put { good = true, number = number, faults = faults }
end

local again -- the film of the script after it was run again

--- Why there is no film of a second run; nil: there is one.
local function open_again()
  local is_open, fresh
  if again then return nil end
  is_open, fresh = pcall(program.script, nil, true)
  if not is_open then return program.reported() or tostring(fresh) end
  again = fresh
  again:keep_callers(false)
  if fresh.first ~= script.first or fresh.frames ~= script.frames then
    return program.other_frames(fresh, script)
  end
end

--- Whether a frame is the same in both films; true, too, if they cannot be compared.
local function is_pure(number)
  local scene = scenes[number]
  -- another process has checked it
  if scene == nil then scene = script:try(number) and script:scene() end
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
    local number = script.first + places[at] - 1
    if not is_pure(number) then
      faults[#faults + 1] = { frame = number, impure = true,
                              message = ("frame %d: %s"):format(number, program.impure) }
    end
    at = at + 1
  until at > #places or program.clock() - began > CHECK_SECONDS
  put { good = true, at = at <= #places and at or nil, faults = faults }
end

-- ---------------------------------------------------------------- requests

local good, made = pcall(program.script, request[1])
if good then
  script = made
  script:keep_callers(false)
  local text = script:kept("celspan.shots", "text", tostring(script.frames))
  parts = text ~= "" and json.decode(text) or nil
  before = with_points(before)
end

local function answer(text)
  local ask = assert(json.decode(text))
  if not script then return refuse(program.reported() or tostring(made), program.outcome()) end
  script:silence(ask.want ~= "frame")
  local is_answered, fault = pcall(answers[ask.want], ask)
  if not is_answered then refuse(program.reported() or tostring(fault)) end
end

for text in requests.next, requests do answer(text) end
