--- celspan watch SCRIPT: a page that shows a film while it is being written.
--
--   browser <--http--> this verb <--requests, pictures--> renderers (watch/renderers.lua)
--                        ^  |
--         inotify: saved-'  '--> the renderers are ended, others begin with the new script
--
-- Nothing of the script runs in this process. Pages ask for /state.json?since=N, which is answered
-- when there is something newer than state N.
local program, request = ...

local json = require "celspan.json"

local function part(name)
  return assert(load(program.text(name), "=" .. name, "t"))(program, request)
end
local guard, renderers = part "guard.lua", part "renderers.lua"

local HELD = 20            -- seconds that a request for news is held
local QUIET = 0.5          -- seconds without requests before frames are checked
local CHECKED_MOST = 5000  -- frames that are checked
local FAULTS_MOST = 200
local WATCHED_MOST = 10000 -- files
local PLACES_MOST = 10000  -- lines of the script that an editor may be asked for
local AROUND = 3           -- lines shown before and after that of an error
local LINES_MOST = 1 << 20 -- bytes of a script of which lines are shown
local SIDE_MOST = 1048576  -- pixels
local PIXELS_MOST = 1 << 25 -- of a picture
local COLUMNS_MOST = 10000  -- of a wave

local script = request[1]
local file, why = io.open(script, "rb")
if not file then program.fail("input", "%s", why) end
file:close()

local web = program.web(math.tointeger(request.port) or 0)
local watcher = program.watcher()
local door = guard.new(web.port)

-- ---------------------------------------------------------------- the state

-- news: counts what pages are to know. build: counts what was saved.
local state = { news = 1, build = 0, errors = {}, check = nil, began = 0 }
local held = {} -- requests for news: id, since, until
local heard = 0 -- when a request came last

local function tell() state.news = state.news + 1 end

-- ---------------------------------------------------------------- files

-- files[folder][name]: watched; folders[number of the watcher]: the names that the film has for
-- that folder, such as "" and "./"; missing[folder]: it cannot be watched, as it does not exist.
local files, folders, missing, watched = {}, {}, {}, 0

local function watch_folder(folder)
  local number = watcher:add(folder == "" and "." or folder)
  if number then
    folders[number] = folders[number] or {}
    folders[number][folder] = true
  end
  missing[folder] = not number or nil
  return number
end

local function watch(path)
  local folder, name = path:match "^(.-)([^/]+)$"
  if not folder or files[folder] and files[folder][name] or watched == WATCHED_MOST then return end
  if not files[folder] then
    files[folder] = {}
    watch_folder(folder)
  end
  files[folder][name], watched = true, watched + 1
end

local function note_files(paths)
  for _, path in ipairs(paths) do watch(path) end
end

--- A trusted script may read modules without asking: those beside it count too.
local function concerns(folder, name)
  return files[folder] and files[folder][name]
    or request.trust and name:match "%.lua$" and folder == (script:match "^.*/" or "")
end

--- Whether an event is about a file that the film has asked for. name "": the folder is gone.
local function is_change(number, name)
  local is_changed = number == -1
  for folder in pairs(folders[number] or {}) do
    if name == "" then missing[folder] = true end
    is_changed = is_changed or name == "" or concerns(folder, name)
  end
  if name == "" then folders[number] = nil end
  return is_changed
end

--- Whether a file that the film has asked for was changed since the last call.
local function has_changes()
  local events, is_changed = watcher:take(), false
  for i = 1, #events, 2 do is_changed = is_change(events[i], events[i + 1]) or is_changed end
  for folder in pairs(missing) do is_changed = watch_folder(folder) ~= nil or is_changed end
  return is_changed
end

-- ---------------------------------------------------------------- errors

--- The lines around one of a file that the film has asked for; nil: they cannot be read.
local function excerpt(path, line)
  local folder, name = path:match "^(.-)([^/]+)$"
  local opened = folder and concerns(folder, name) and io.open(path, "rb")
  if not opened then return nil end
  local text, number, lines = opened:read(LINES_MOST) or "", 0, {}
  opened:close()
  for one in (text:gsub("\n?$", "\n", 1)):gmatch "([^\n]*)\n" do
    number = number + 1
    if number > line + AROUND then break end
    if number >= line - AROUND then lines[#lines + 1] = { number, one:sub(1, 200) } end
  end
  return lines
end

-- Lines of files that the film has named, as keys such as "shot.lua:12".
local places, place_count = {}, 0

local function note_place(path, line)
  local key = path and line and ("%s:%d"):format(path, line)
  if not key or places[key] or place_count == PLACES_MOST then return end
  places[key], place_count = true, place_count + 1
end

--- The places in a text such as "from shot.lua:40, hand.lua:7", which are noted: { file, line }.
local function note_places(text)
  local list = {}
  for path, line in text:gmatch "([^%s:(),]+):(%d+)" do
    list[#list + 1] = { file = path, line = math.tointeger(line) }
    note_place(path, math.tointeger(line))
  end
  return { list = list }
end

--- An error as /errors.json lists it.
local function describe(message, frame)
  local path, line = program.place_of(message)
  note_place(path, line)
  frame = frame or math.tointeger(message:match "frame (%-?%d+): ")
  local callers = note_places(message:match " %(called from ([^()]*)%)" or "")
  return { message = message, frame = frame, file = path, line = line, callers = callers,
           lines = path and excerpt(path, line) }
end

local function add_error(message, frame)
  for _, known in ipairs(state.errors) do
    if known.message == message then return end
  end
  if #state.errors == FAULTS_MOST then return end
  table.insert(state.errors, describe(message, frame))
  tell()
end

-- ---------------------------------------------------------------- building

local pool = renderers.new(note_files)

--- Begins with the script as it is now.
local function build()
  pool:close("the film was saved again", 503)
  state.build, state.began, state.is_building = state.build + 1, program.clock(), true
  local number = state.build
  tell()
  pool:ask {
    ask = { want = "film" }, is_patient = true,
    done = function(head)
      state.film, state.errors, state.is_building = head.film, {}, false
      state.film.marks = { list = state.film.marks }
      state.parameters = head.parameters
      state.is_shown, state.check = true, { number = head.film.first }
      tell()
    end,
    failed = function(message)
      if number ~= state.build then return end
      state.errors, state.is_building, state.check = { describe(message) }, false, nil
      state.is_shown = false
      tell()
    end,
  }
end

--- Has some frames checked when nobody asks for pictures.
local function check()
  local at, film = state.check, state.film
  if not at or at.is_asked or program.clock() - heard < QUIET or not pool:is_idle() then return end
  at.is_asked = true
  pool:ask {
    ask = { want = "check", number = at.number }, is_patient = true,
    done = function(head)
      at.number, at.is_asked = head.number, false
      for _, fault in ipairs(head.faults) do add_error(fault.message, fault.frame) end
      local last = math.min(film.first + film.frames, film.first + CHECKED_MOST)
      if head.number >= last and state.check == at then state.check = nil end
    end,
    failed = function(message)
      if state.check == at then state.check = nil end
      if at.number and state.is_shown then add_error(message, at.number) end
    end,
  }
end

-- ---------------------------------------------------------------- answers

local POLICY = "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"

local function answer(id, status, kind, bytes, ...)
  web:answer(id, status, {
    "Content-Type", kind, "Content-Security-Policy", POLICY, "X-Content-Type-Options", "nosniff",
    "Cross-Origin-Resource-Policy", "same-origin", "Cross-Origin-Opener-Policy", "same-origin",
    "Referrer-Policy", "no-referrer", "Cache-Control", "no-store", ... }, bytes)
end

local function refuse(id, status, sentence)
  answer(id, status, "text/plain; charset=utf-8", sentence .. "\n")
end

local function give_json(id, value)
  answer(id, 200, "application/json", program.json(value) .. "\n")
end

--- The parameters with their values: of the page, else of the command line, else the defaults.
local function parameters()
  local values, list = {}, {}
  local stored = request.set_from and json.read(request.set_from)
  for name, value in pairs(type(stored) == "table" and stored or {}) do values[name] = value end
  for _, option in ipairs(request.given) do
    local name, value = (option.name == "--set" and option.value or ""):match "^(.-)=(.*)$"
    if name then values[name] = value end
  end
  for name, value in pairs(pool.values) do values[name] = value end
  for i, one in ipairs(state.parameters or {}) do
    local value = values[one.name]
    list[i] = { name = one.name, type = one.type, format = one.format, default = one.default,
                minimum = one.minimum, maximum = one.maximum, description = one.description,
                enum = one.enum, value = tostring(value == nil and one.default or value) }
  end
  return { list = list }
end

local function describe_state()
  return { news = state.news, build = state.build, building = state.is_building or false,
           seconds = state.is_building and program.clock() - state.began or 0,
           film = state.film, shown = state.is_shown or false, errors = { list = state.errors },
           script = script, alone = request.is_alone or false, parameters = parameters(),
           editor = request.editor ~= nil, here = state.here }
end

--- Asks the renderers, and answers with what they say.
local function pass_on(id, ask, give)
  heard = program.clock()
  pool:ask {
    ask = ask,
    done = give,
    failed = function(message, status)
      if ask.number and status == 422 then add_error(message, ask.number) end
      refuse(id, status, message)
    end,
  }
end

--- The numbers of a text such as "1,2,3" or "1280x720"; nil: it is no such text.
local function numbers(text, count)
  local all = {}
  for digits in (text or ""):gmatch "[^,x]+" do
    all[#all + 1] = digits:match "^%d%d?%d?%d?%d?%d?%d?$" and math.tointeger(digits)
  end
  return #all == count and all or nil
end

--- The frame that a request is about; nil: refused.
local function frame_of(id, text)
  local number, film = math.tointeger(text), state.film
  if not state.is_shown then
    refuse(id, 409, state.errors[1] and state.errors[1].message or "the film is not ready yet")
  elseif not number or number < film.first or number >= film.first + film.frames then
    local last = film.first + film.frames - 1
    refuse(id, 404, ("the film has frames %d to %d"):format(film.first, last))
  else
    return number
  end
end

--- Whether a crop is within a frame of a size, and not too large for one picture.
local function is_view(size, crop)
  local x, y, w, h = table.unpack(crop)
  return size[1] > 0 and size[2] > 0 and math.max(size[1], size[2]) <= SIDE_MOST
    and w > 0 and h > 0 and x + w <= size[1] and y + h <= size[2] and w * h <= PIXELS_MOST
end

--- What a request shows, in the words of the renderers: number, size, crop, cels; nil: refused.
local function view_of(id, text, fields)
  local number = frame_of(id, text)
  if not number then return nil end
  local size = numbers(fields.size or request.size, 2) or not fields.size and state.film.size
  local crop = size and (not fields.crop and { 0, 0, size[1], size[2] } or numbers(fields.crop, 4))
  if not crop or not is_view(size, crop) then
    return refuse(id, 400, "write size=WxH and crop=X,Y,W,H: at most 1048576 pixels a side, and "
      .. "33554432 in a crop that is within the frame")
  end
  local cels = fields.cels and json.decode(fields.cels)
  if fields.cels and type(cels) ~= "table" then
    return refuse(id, 400, "cels= must be a JSON object, such as {\"ground\": \"h\"}")
  end
  return { number = number, size = size, crop = crop, cels = cels }
end

--- What is shown instead of the frame's colours: "spans", or what a line made.
local function add_show(id, ask, fields)
  if fields.show == "made" then
    ask.made = { list = { fields.file or "", math.tointeger(fields.line) or 0 } }
  elseif fields.show == "spans" then
    ask.what = "spans"
  elseif fields.show then
    return refuse(id, 400, "show= is spans or made")
  end
  return true
end

local function give_frame(id, text, ending, fields)
  local ask = view_of(id, text, fields)
  if not ask then return end
  ask.want, ask.what = "frame", ending
  if not add_show(id, ask, fields) then return end
  if fields.show and ending ~= "rgba" then return refuse(id, 400, "show= needs /frame/N.rgba") end
  local kind = ending == "png" and "image/png" or "application/octet-stream"
  pass_on(id, ask,
    function(head, bytes)
      answer(id, 200, kind, bytes, "Celspan-Seconds", ("%.4f"):format(head.seconds))
    end)
end

local function give_costs(id, fields)
  local ask = view_of(id, fields.frame or state.film and state.film.first, fields)
  if not ask then return end
  ask.want = "costs"
  pass_on(id, ask, function(head)
    for _, one in ipairs(head.costs) do note_place(one.file, one.line) end
    give_json(id, { list = head.costs })
  end)
end

--- The frames with what the line made that an editor has named last.
local function give_made(id)
  if not state.is_shown then return frame_of(id) end
  if not state.here then return give_json(id, { list = {} }) end
  pass_on(id, { want = "made", file = state.here.file, line = state.here.line },
    function(head) give_json(id, { list = head.runs }) end)
end

--- The run of frames of a text such as "1-48"; without one, all of them; nil: refused.
local function run_of(id, text)
  local film = state.film
  local from, to = (text or ""):match "^(%-?%d+)%-(%-?%d+)$"
  if not text and film then from, to = film.first, film.first + film.frames - 1 end
  if not from and text then return refuse(id, 400, "write frames=A-B, such as 1-48") end
  local first = frame_of(id, from)
  local last = first and frame_of(id, to)
  if last and last < first then return refuse(id, 400, "frames=A-B: A is greater than B") end
  return last and first, last
end

local function give_sound(id, fields)
  local first, last = run_of(id, fields.frames)
  if not first then return end
  if not state.film.sound then return refuse(id, 404, "the film has no sound") end
  pass_on(id, { want = "sound", first = first, count = last - first + 1 },
    function(_, bytes) answer(id, 200, "audio/wav", bytes) end)
end

local function give_wave(id, fields)
  local columns = math.tointeger(fields.columns or 1000)
  if not state.is_shown then return frame_of(id) end
  if not columns or columns < 1 or columns > COLUMNS_MOST then
    return refuse(id, 400, ("write columns=N, from 1 to %d"):format(COLUMNS_MOST))
  end
  pass_on(id, { want = "wave", columns = columns },
    function(_, text) answer(id, 200, "application/json", text) end)
end

local function give_point(id, x, y, fields)
  local number = frame_of(id, fields.frame or state.film and state.film.first)
  x, y = tonumber(x), tonumber(y)
  if not number then return end
  if not x or not y then return refuse(id, 400, "write /at/X,Y.json, in units of the film") end
  pass_on(id, { want = "at", number = number, x = x, y = y },
    function(head)
      for _, hit in ipairs(head.hits) do
        note_place(hit.file, hit.line)
        hit.via, hit.callers = hit.callers, note_places(hit.callers)
      end
      give_json(id, { list = head.hits })
    end)
end

local kinds = { html = "text/html; charset=utf-8", css = "text/css; charset=utf-8",
                js = "text/javascript; charset=utf-8" }

--- A text of the page. Whoever may have it gets the cookie for the rest.
local function give_text(id, name)
  answer(id, 200, kinds[name:match "%w+$"], program.text(name), "Set-Cookie", door.cookie)
end

local pages = { ["/"] = "page.html", ["/page.css"] = "page.css", ["/page.js"] = "page.js",
                ["/sound.js"] = "sound.js", ["/runs.js"] = "runs.js", ["/cost.js"] = "cost.js" }

local gets = {
  ["/film.json"] = function(id)
    if not state.is_shown then return frame_of(id) end
    give_json(id, state.film)
  end,
  ["/errors.json"] = function(id) give_json(id, { list = state.errors }) end,
  ["/sheet.txt"] = function(id)
    if not state.is_shown then return frame_of(id) end
    pass_on(id, { want = "sheet" },
      function(_, text) answer(id, 200, "text/plain; charset=utf-8", text) end)
  end,
  ["/sheet.json"] = function(id)
    if not state.is_shown then return frame_of(id) end
    pass_on(id, { want = "rows" },
      function(_, text) answer(id, 200, "application/json", text) end)
  end,
  ["/sound.wav"] = give_sound,
  ["/wave.json"] = give_wave,
  ["/costs.json"] = give_costs,
  ["/made.json"] = give_made,
  ["/counts.json"] = function(id) give_json(id, web:counts()) end,
  ["/state.json"] = function(id, fields)
    local since = math.tointeger(fields.since) or 0
    if since ~= state.news then return give_json(id, describe_state()) end
    held[#held + 1] = { id = id, over = program.clock() + HELD }
  end,
}

local function route(id, path, fields)
  if pages[path] then return give_text(id, pages[path]) end
  if gets[path] then return gets[path](id, fields) end
  local number, ending = path:match "^/frame/(%-?%d+)%.(%l+)$"
  if number and (ending == "png" or ending == "rgba" or ending == "runs") then
    return give_frame(id, number, ending, fields)
  end
  local x, y = path:match "^/at/(%-?[%d.]+),(%-?[%d.]+)%.json$"
  if x then return give_point(id, x, y, fields) end
  refuse(id, 404, "there is no such address")
end

--- What may be changed, by POST with a JSON object.
local posts = {}

--- Values of parameters, { name = "text" }, in place of all that the page has given before.
posts["/parameters"] = function(id, given)
  local known = {}
  for _, one in ipairs(state.parameters or {}) do known[one.name] = true end
  for name, value in pairs(given) do
    if not known[name] or type(value) ~= "string" or value:find "%z" then
      return refuse(id, 400, ("the film has no parameter '%s' with such a value"):format(name))
    end
  end
  pool.values = given
  build()
  give_json(id, { build = state.build })
end

--- The path of a file as the film has it, for one that an editor may name from the root; nil: the
--- film does not read it.
local function path_of(name)
  for folder, list in pairs(files) do
    for own in pairs(list) do
      local path = folder .. own
      if name == path or name:sub(-#path - 1) == "/" .. path then return path end
    end
  end
  return nil
end

--- What this line made is outlined in the page, { file =, line = }.
posts["/here"] = function(id, given)
  local path, line = path_of(tostring(given.file)), math.tointeger(given.line)
  if not path or not line then return refuse(id, 404, "the film does not read this file") end
  state.here = { file = path, line = line, count = (state.here and state.here.count or 0) + 1 }
  tell()
  give_json(id, state.here)
end

local editors = {} -- processes

--- Opens a line that the film has named in the editor, { file =, line = }.
posts["/open"] = function(id, given)
  local line = math.tointeger(given.line)
  local key = type(given.file) == "string" and line and ("%s:%d"):format(given.file, line)
  if not key or not places[key] then return refuse(id, 404, "the film has not named this line") end
  if not request.editor then return refuse(id, 409, "give --editor to celspan watch") end
  local words = {}
  for word in request.editor:gmatch "%S+" do
    words[#words + 1] = word:gsub("{(%l+)}", { file = given.file, line = tostring(line) })
  end
  local process, message = program.launch(words)
  if not process then return refuse(id, 500, "--editor: " .. message) end
  editors[process] = true
  give_json(id, {})
end

local function take_post(asked, path)
  local given = json.decode(asked.body)
  if not posts[path] then return refuse(asked.id, 405, "nothing is changed by a POST there") end
  if type(given) ~= "table" then return refuse(asked.id, 400, "the body must be a JSON object") end
  posts[path](asked.id, given)
end

local function serve(asked)
  local path, fields, sentence = door:admit(asked)
  if not path then return refuse(asked.id, fields, sentence) end
  if asked.method == "POST" then return take_post(asked, path) end
  route(asked.id, path, fields)
end

--- Answers those who wait for news.
local announced = 0
local function give_news()
  local now, waiting = program.clock(), {}
  for _, one in ipairs(held) do
    if announced ~= state.news or now > one.over then
      give_json(one.id, describe_state())
    else
      waiting[#waiting + 1] = one
    end
  end
  held, announced = waiting, state.news
end

-- ---------------------------------------------------------------- the loop

--- Milliseconds until there is something to do; -1 counts as for ever.
local function soonest(...)
  local least = 1000
  for _, wait in ipairs { ... } do
    if wait >= 0 then least = math.min(least, wait) end
  end
  return least
end

local function step()
  web:run()
  for asked in web.take, web do serve(asked) end
  if has_changes() then build() end
  pool:step()
  check()
  give_news()
  for process in pairs(editors) do
    if program.has_ended(process) then editors[process] = nil end
  end
  local wait = soonest(web:run(), pool:wait(), state.check and 100 or -1)
  local sources = { web:descriptor(), watcher:descriptor() }
  pool:add_descriptors(sources)
  program.poll(wait, sources)
end

local function open_browser(address)
  if os.execute "command -v xdg-open >/dev/null 2>&1" then
    os.execute(("xdg-open '%s' >/dev/null 2>&1 &"):format(address))
  else
    program.note "there is no program xdg-open: open the address yourself"
  end
end

watch(script)
build()
local address = ("http://127.0.0.1:%d/?token=%s"):format(web.port, door.token)
print("watching " .. address)
io.stdout:flush()
if request.open then open_browser(address) end
while not program.is_stopped() do step() end
pool:close("celspan has ended", 503)
