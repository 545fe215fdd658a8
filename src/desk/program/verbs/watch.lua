--- celspan watch SCRIPT [SCRIPT]: a page that shows a film, or two, while it is being written.
--
--   browser <--http--> this verb <--requests, pictures--> renderers (watch/renderers.lua)
--                        ^  |
--         inotify: saved-'  '--> the renderers are ended, others begin with the new script
--
-- Nothing of the script runs in this process. Pages ask for /state.json?since=N, which is answered
-- when there is something newer than state N. One file, because all answers read or change the one
-- state.
local program, request = ...

local ease = require "celspan.ease"
local json = require "celspan.json"

local function part(name) return program.part(name, program, request) end
local guard, watched, choices = part "guard.lua", part "watched.lua", part "choices.lua"
local programs, joining = part "programs.lua", part "joining.lua"

local HELD = 20            -- seconds for which a request waits for news, or for a film
local SOON = 5             -- and for values that are sent with it
local SIDE_MOST = 1048576  -- pixels
local PIXELS_MOST = 1 << 25 -- of a picture
local ONION_MOST = 16       -- frames before, and after
local COLUMNS_MOST = 10000  -- of a wave
local CURVE_STEPS = 48      -- of the picture of an ease
local UNITS_MOST = 1 << 30  -- the greatest distance of a point, on either side

-- The texts of the page.
local pages = { ["/"] = "page.html", ["/again.html"] = "again.html", ["/page.css"] = "page.css",
                ["/page.js"] = "page.js",
                ["/icon.svg"] = "icon.svg", ["/favicon.ico"] = "icon.svg" }

for _, script in ipairs(request) do
  local file, why = io.open(script, "rb")
  if not file then program.fail("input", "%s", why) end
  file:close()
end

local folder = request.output and request.output:gsub("/*$", "/") -- of the files of renders
if folder and not program.entries(folder) then
  program.fail("output", "-o %s: there is no such folder, or it cannot be read", request.output)
end
folder = folder or request[1]:match "^.*/" or ""

local web = program.web(math.tointeger(request.port) or 0)
local door = guard.new(web.port, pages)
local files = part "files.lua".new()
local places = part "places.lua".new(files)

-- ---------------------------------------------------------------- the films

-- news: the number of changes that pages must know. here: the line that an editor has named.
local state = { news = 1 }
local held = {}    -- requests for news: id, over
local waiting = {} -- requests for a film that is built later: id, wish, answer(), side, build, over

local function tell() state.news = state.news + 1 end

-- The film, and the second film beside it, which requests name with side=2: of the second script,
-- or of the same script with other values. sides: those that are shown.
local first = watched.new(request[1], files, places, tell)
local second = watched.new(request[2] or request[1], files, places, tell)
local sides = { first }
local renders = part "renders.lua".new(first, folder, tell)

--- Shows or hides the second film.
local function set_comparing(is_on)
  if is_on == (sides[2] ~= nil) then return end
  sides[2] = is_on and second or nil
  if is_on then second:build() else second:close "the second film is not shown any more" end
  tell()
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

--- Calls a function that answers a request. An error in it ends only that request.
local function attempt(id, call, ...)
  local is_good, fault = pcall(call, ...)
  if not is_good then refuse(id, 500, "the answer could not be made: " .. tostring(fault)) end
end

local function give_json(id, value, status)
  answer(id, status or 200, "application/json", program.json(value) .. "\n")
end

local function describe_state()
  local said = first:describe()
  said.news, said.here, said.editor = state.news, state.here, request.editor ~= nil
  said.alone, said.second = request.is_alone or false, sides[2] and second:describe()
  said.has_two, said.render, said.folder = #request == 2, renders.said, folder
  return said
end

--- Asks the renderers, and sends their answer.
local function pass_on(id, side, ask, give, wish)
  side:ask(ask, function(...) attempt(id, give, ...) end,
    function(status, message) refuse(id, status, message) end, wish)
end

--- The numbers of a text such as "1,2,3" or "1280x720"; nil: the text has another form.
local function numbers(text, count)
  local all = {}
  for digits in (text or ""):gmatch "[^,x]+" do
    all[#all + 1] = digits:match "^%d%d?%d?%d?%d?%d?%d?$" and math.tointeger(digits)
  end
  return #all == count and all or nil
end

--- Whether a film can be asked; if not, the request is refused.
local function is_ready(id, side)
  if side.is_shown then return true end
  refuse(id, 409, side.errors[1] and side.errors[1].message or "the film is not ready yet")
end

--- The frame that a request is about; nil: refused.
local function frame_of(id, side, text)
  local number, facts = math.tointeger(text), side.facts
  if not is_ready(id, side) then return nil end
  if not number or number < facts.first or number >= facts.first + facts.frames then
    local last = facts.first + facts.frames - 1
    refuse(id, 404, ("the film has frames %d to %d"):format(facts.first, last))
  else
    return number
  end
end

--- Whether a crop lies within a frame of a size, and is not too large for one picture.
local function is_view(size, crop)
  local x, y, w, h = table.unpack(crop)
  return size[1] > 0 and size[2] > 0 and math.max(size[1], size[2]) <= SIDE_MOST
    and w > 0 and h > 0 and x + w <= size[1] and y + h <= size[2] and w * h <= PIXELS_MOST
end

--- The changes of cels that a request wants, { { name, letters }, ... }, from an object; nil: it is
--- not an object of texts.
local function cels_of(text)
  local list, given = {}, json.decode(text)
  if type(given) ~= "table" then return nil end
  for name, letters in pairs(given) do
    if type(name) ~= "string" or type(letters) ~= "string" or letters:find "[^hlf]" then
      return nil
    end
    list[#list + 1] = { name, letters }
  end
  return { list = list }
end

--- The labels of a JSON list; nil: it is no list of texts.
local function labels_of(text)
  local list = json.decode(text)
  if type(list) ~= "table" then return nil end
  for i, label in pairs(list) do
    local is_label = type(label) == "string" and not label:find "[%z\n]"
    if math.type(i) ~= "integer" or not is_label then return nil end
  end
  return list
end

--- Adds the onion skin that a request wants. nil: refused.
local function add_onion(id, ask, fields)
  if not fields.onion then return true end
  local counts, skins = numbers(fields.onion, 2), labels_of(fields.skins or "[]")
  if not counts or not skins or math.max(counts[1], counts[2]) > ONION_MOST then
    return refuse(id, 400, ("write onion=BEFORE,AFTER, at most %d each, and skins= as a JSON list "
      .. "of cels"):format(ONION_MOST))
  end
  ask.onion, ask.skins = { list = counts }, { list = skins }
  return true
end

--- The view that a request wants, in the words of the renderers: number, size, crop, cels; nil:
--- refused.
local function view_of(id, side, text, fields)
  local number = frame_of(id, side, text)
  if not number then return nil end
  local size = numbers(fields.size or request.size, 2) or not fields.size and side.facts.size
  local crop = size and (not fields.crop and { 0, 0, size[1], size[2] } or numbers(fields.crop, 4))
  if not crop or not is_view(size, crop) then
    return refuse(id, 400, "write size=WxH and crop=X,Y,W,H: at most 1048576 pixels a side, and "
      .. "33554432 in a crop that is within the frame")
  end
  local cels = fields.cels and cels_of(fields.cels)
  if fields.cels and not cels then
    return refuse(id, 400, "cels= must be a JSON object, such as {\"ground\": \"h\"}, with the "
      .. "letters h, l and f")
  end
  local camera = fields.camera and frame_of(id, side, fields.camera)
  if fields.camera and not camera then return nil end
  return { number = number, size = size, crop = crop, cels = cels, camera = camera }
end

--- Adds what is shown instead of the frame's colours: "spans", or only what a line made.
local function add_show(id, ask, fields)
  if fields.show == "made" then
    ask.made = { list = { fields.file or "", math.tointeger(fields.line) or 0, fields.name,
                          fields.cel } }
  elseif fields.show == "spans" then
    ask.what = "spans"
  elseif fields.show then
    return refuse(id, 400, "show= is spans or made")
  end
  return true
end

local function give_frame(id, side, text, fields, ending)
  local ask = view_of(id, side, text, fields)
  if not ask then return end
  ask.want, ask.what = "frame", ending
  if not add_show(id, ask, fields) or not add_onion(id, ask, fields) then return end
  if fields.show and ending ~= "rgba" then return refuse(id, 400, "show= needs /frame/N.rgba") end
  local kind = ending == "png" and "image/png" or "application/octet-stream"
  pass_on(id, side, ask,
    function(head, bytes)
      answer(id, 200, kind, bytes, "Celspan-Seconds", ("%.4f"):format(head.seconds),
        "Celspan-Camera", head.camera, "Celspan-Points", head.points)
    end, fields.wish)
end

local function give_costs(id, side, fields)
  local ask = view_of(id, side, fields.frame or side.facts and side.facts.first, fields)
  if not ask then return end
  ask.want = "costs"
  pass_on(id, side, ask, function(head)
    for _, one in ipairs(head.costs) do
      one.file = places:note(one.file, one.line, side)
    end
    give_json(id, { list = head.costs })
  end)
end

--- Sends the frames with something that the line made which an editor has named last.
local function give_made(id, side)
  if not is_ready(id, side) then return end
  if not state.here then return give_json(id, { list = {} }) end
  pass_on(id, side, { want = "made", file = state.here.file, line = state.here.line },
    function(head) give_json(id, { list = head.runs }) end)
end

--- The run of frames of a text such as "1-48"; without a text, all frames; nil: refused.
local function run_of(id, side, text)
  local facts = side.facts
  local from, to = (text or ""):match "^(%-?%d+)%-(%-?%d+)$"
  if not text and facts then from, to = facts.first, facts.first + facts.frames - 1 end
  if not from and text then return refuse(id, 400, "write frames=A-B, such as 1-48") end
  local begin = frame_of(id, side, from)
  local last = begin and frame_of(id, side, to)
  if last and last < begin then return refuse(id, 400, "frames=A-B: A is greater than B") end
  return last and begin, last
end

local function give_sound(id, side, fields)
  local begin, last = run_of(id, side, fields.frames)
  if not begin then return end
  if not side.facts.sound then return refuse(id, 404, "the film has no sound") end
  pass_on(id, side, { want = "sound", first = begin, count = last - begin + 1 },
    function(_, bytes) answer(id, 200, "audio/wav", bytes) end)
end

local function give_wave(id, side, fields)
  local columns = math.tointeger(fields.columns or 1000)
  if not is_ready(id, side) then return end
  if not columns or columns < 1 or columns > COLUMNS_MOST then
    return refuse(id, 400, ("write columns=N, from 1 to %d"):format(COLUMNS_MOST))
  end
  pass_on(id, side, { want = "wave", columns = columns },
    function(_, text) answer(id, 200, "application/json", text) end)
end

local function give_point(id, side, x, y, fields)
  local number = frame_of(id, side, fields.frame or side.facts and side.facts.first)
  x, y = tonumber(x), tonumber(y)
  if not number then return end
  if not x or not y or math.max(math.abs(x), math.abs(y)) > UNITS_MOST then
    return refuse(id, 400, "write /at/X,Y.json, in units of the film")
  end
  pass_on(id, side, { want = "at", number = number, x = x, y = y },
    function(head)
      for _, hit in ipairs(head.hits) do
        hit.file, hit.line = places:note(hit.file, hit.line, side)
        hit.via, hit.callers = hit.callers, places:of_text(hit.callers, side)
      end
      give_json(id, { list = head.hits })
    end)
end

--- Sends the tree of the cels and objects of a frame.
local function give_objects(id, side, fields)
  local number = frame_of(id, side, fields.frame or side.facts and side.facts.first)
  if not number then return end
  pass_on(id, side, { want = "tree", number = number }, function(head)
    for _, one in ipairs(head.tree) do
      one.file, one.line = places:note(one.file, one.line, side)
    end
    give_json(id, { list = head.tree })
  end)
end

local kinds = { html = "text/html; charset=utf-8", css = "text/css; charset=utf-8",
                js = "text/javascript; charset=utf-8", svg = "image/svg+xml" }

local made = {} -- the texts of the page as they are sent

--- The text of the page. Scripts and styles travel without comments and indentation, and styles
--- without most blanks: so they have two fifths fewer bytes. No text in a style may have a blank
--- after a colon or a comma.
local function made_text(name, ending)
  if ending == "js" then return joining.join(name, program.text) end
  local text = program.text(name)
  if ending == "html" then return text end
  text = joining.bare(text)
  if ending ~= "css" then return text end
  return (text:gsub("%s*([{};])%s*", "%1"):gsub("([:,]) ", "%1"))
end

local function give_text(id, name)
  local ending = name:match "%w+$"
  made[name] = made[name] or made_text(name, ending)
  answer(id, 200, kinds[ending], made[name])
end

--- Sends the files that a parameter may name. fields: parameter=NAME.
local function give_files(id, side, fields)
  for _, one in ipairs(side.parameters or {}) do
    if one.name == fields.parameter and one.format == "path" then
      return give_json(id, { list = choices.like(side.script, one.default) })
    end
  end
  refuse(id, 404, "the film has no parameter of this name that is a file")
end

--- A function for an address that sends data of a film as bytes of some kind.
local function giving(want, kind)
  return function(id, side)
    if not is_ready(id, side) then return end
    pass_on(id, side, { want = want }, function(_, text) answer(id, 200, kind, text) end)
  end
end

local gets = { -- of a film
  ["/film.json"] = function(id, side)
    if is_ready(id, side) then give_json(id, side.facts) end
  end,
  ["/errors.json"] = function(id, side) give_json(id, { list = side.errors }) end,
  ["/sheet.txt"] = giving("sheet", "text/plain; charset=utf-8"),
  ["/sheet.json"] = giving("rows", "application/json"),
  ["/sound.wav"] = give_sound,
  ["/wave.json"] = give_wave,
  ["/costs.json"] = give_costs,
  ["/files.json"] = give_files,
  ["/made.json"] = give_made,
  ["/objects.json"] = give_objects,
}

--- Requests that are answered even if no film can be asked.
local own = {}

own["/counts.json"] = function(id) give_json(id, web:counts()) end

--- The curve of an ease, at even steps from 0 to 1.
own["/curve.json"] = function(id, fields)
  local is_known, curve = pcall(ease, fields.name)
  if not is_known then return refuse(id, 404, "there is no such curve") end
  local list = {}
  for i = 0, CURVE_STEPS do list[i + 1] = curve(i / CURVE_STEPS) end
  give_json(id, { list = list })
end

own["/state.json"] = function(id, fields)
  local since = math.tointeger(fields.since) or 0
  if since ~= state.news then return give_json(id, describe_state()) end
  held[#held + 1] = { id = id, over = program.clock() + HELD }
end

--- The film that a request means: the second with side=2; nil: refused.
local function side_of(id, fields)
  local side = sides[math.tointeger(fields.side or 1) or 0]
  return side or refuse(id, 404, "there is no such film beside the first")
end

--- Answers a request for data of a film.
local function give_of(id, side, path, fields)
  if gets[path] then return gets[path](id, side, fields) end
  local number, ending = path:match "^/frame/(%-?%d+)%.(%l+)$"
  if number and (ending == "png" or ending == "rgba" or ending == "runs") then
    return give_frame(id, side, number, fields, ending)
  end
  local x, y = path:match "^/at/(%-?[%d.]+),(%-?[%d.]+)%.json$"
  if x then return give_point(id, side, x, y, fields) end
  refuse(id, 404, "there is no such address")
end

--- Whether a request is about a film that is built for the first time, or of values that have not
--- come yet.
local function is_awaited(one)
  local side = one.side
  return side.is_building and not side.is_shown or one.build > side.build_number
end

local function route(id, path, fields)
  if pages[path] then return give_text(id, pages[path]) end
  if own[path] then return own[path](id, fields) end
  local side = side_of(id, fields)
  if not side then return end
  local build = math.tointeger(fields.build) or 0
  local one = { id = id, wish = fields.wish, side = side, build = build,
                over = program.clock() + (build > side.build_number and SOON or HELD),
                answer = function() attempt(id, give_of, id, side, path, fields) end }
  if is_awaited(one) then waiting[#waiting + 1] = one else one.answer() end
end

--- Things that can be changed, by POST with a JSON object.
local posts = {}

--- Sets the values of parameters, { name = "text" }, and forgets all values that the page has given
--- before. Those that cannot be are refused, each by itself, and names that the film does not have
--- are left out: it may have lost them since the page has heard of them.
posts["/parameters"] = function(id, given, side)
  for name, value in pairs(given) do
    if type(value) ~= "string" or value:find "%z" then
      return refuse(id, 400, ("no parameter can have such a value as that of '%s'"):format(name))
    end
  end
  local values, refused = side:give_values(given)
  give_json(id, { build = side.build_number, values = values, refused = refused })
end

--- Gives up a request that waits for values.
local function forget(side, wish)
  for i = #waiting, 1, -1 do
    if waiting[i].side == side and waiting[i].wish == wish then
      refuse(table.remove(waiting, i).id, 503, "it is not wanted any more")
    end
  end
end

--- The picture that was requested with this `wish` is not wanted any more, { wish = }.
posts["/abandon"] = function(id, given, side)
  if type(given.wish) ~= "string" then return refuse(id, 400, "write { \"wish\": ... }") end
  side.pool:abandon(given.wish)
  forget(side, given.wish)
  give_json(id, {})
end

--- Sets whether the second film is shown beside the first, { on = }.
posts["/compare"] = function(id, given)
  set_comparing(given.on == true)
  give_json(id, { on = given.on == true })
end

--- Begins a render, or ends it with { cancel = true }.
posts["/render"] = function(id, given)
  if given.cancel == true then
    renders:cancel()
    return give_json(id, {})
  end
  if not is_ready(id, first) then return end
  local status, sentence, exists = renders:begin(given)
  if exists then
    return give_json(id, { exists = true, message = sentence }, status)
  elseif status ~= 200 then
    return refuse(id, status, sentence)
  end
  give_json(id, { number = renders.number })
end

--- Outlines in the page what this line made, { file =, line = }.
posts["/here"] = function(id, given)
  local path, line = files:path_of(tostring(given.file), first), math.tointeger(given.line)
  if not path or not line then return refuse(id, 404, "the film does not read this file") end
  state.here = { file = path, line = line, count = (state.here and state.here.count or 0) + 1 }
  tell()
  give_json(id, state.here)
end

--- Opens a line in the editor, { file =, line = }; the film must have named it.
posts["/open"] = function(id, given)
  local line = math.tointeger(given.line)
  local path = type(given.file) == "string" and line and places:find(given.file, line)
  if not path then
    return refuse(id, 404, "the film has not named this line of a file that it reads")
  end
  if not request.editor then return refuse(id, 409, "give --editor to celspan watch") end
  local is_open, message = programs.edit(path, line)
  if not is_open then return refuse(id, 500, "--editor: " .. message) end
  give_json(id, {})
end

local function take_post(asked, path, fields)
  local given = json.decode(asked.body)
  if not posts[path] then return refuse(asked.id, 405, "nothing is changed by a POST there") end
  if type(given) ~= "table" then return refuse(asked.id, 400, "the body must be a JSON object") end
  local side = side_of(asked.id, fields)
  if side then posts[path](asked.id, given, side) end
end

local function serve(asked)
  local path, fields, sentence = door:admit(asked)
  if not path then return refuse(asked.id, fields, sentence) end
  if asked.method == "POST" then return take_post(asked, path, fields) end
  route(asked.id, path, fields)
end

--- Answers requests that wait for news.
local announced = 0
local function give_news()
  local now, later = program.clock(), {}
  for _, one in ipairs(held) do
    if announced ~= state.news or now > one.over then
      attempt(one.id, function() give_json(one.id, describe_state()) end)
    else
      later[#later + 1] = one
    end
  end
  held, announced = later, state.news
end

--- Answers requests whose films can be asked now, or have failed. Where values did not come, the
--- picture would be of others.
local function give_films()
  local now, later = program.clock(), {}
  for _, one in ipairs(waiting) do
    if is_awaited(one) and now < one.over then
      later[#later + 1] = one
    elseif one.build > one.side.build_number then
      refuse(one.id, 503, "the values have not come")
    else
      one.answer()
    end
  end
  waiting = later
end

-- ---------------------------------------------------------------- the loop

--- Milliseconds until there is something to do; -1: for ever.
local function soonest(...)
  local least = 1000
  for _, wait in ipairs { ... } do
    if wait >= 0 then least = math.min(least, wait) end
  end
  return least
end

--- Lets every film do its work. Returns the milliseconds until there is more.
local function step_films()
  local changed, wait = files:take(sides), -1
  for _, side in ipairs(sides) do
    if changed[side] then side:build() end
    side.pool:step()
    side:check()
    wait = soonest(wait, side.pool:wait(), side.check_state and 100 or -1)
  end
  return wait
end

local function step()
  web:run()
  for asked in web.take, web do attempt(asked.id, serve, asked) end
  local wait = step_films()
  give_films()
  give_news()
  programs.step()
  renders:step()
  local sources = { web:descriptor(), files:descriptor() }
  for _, side in ipairs(sides) do side.pool:add_descriptors(sources) end
  renders:add_descriptors(sources)
  program.poll(soonest(web:run(), wait), sources)
end

first:build()
set_comparing(#request == 2)
local address = ("http://127.0.0.1:%d/?token=%s"):format(web.port, door.token)
print("watching " .. address)
io.stdout:flush()
if request.open then programs.browse(address, "celspan-" .. guard.random()) end
while not program.is_stopped() do step() end
programs.close()
renders:close()
for _, side in ipairs(sides) do side:close "celspan has ended" end
