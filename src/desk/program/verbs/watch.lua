--- celspan watch SCRIPT [SCRIPT]: a page that shows a film, or two, while it is being written.
--
--   browser <--http--> this verb <--requests, pictures--> renderers (watch/renderers.lua)
--                        ^  |
--         inotify: saved-'  '--> the renderers are ended, others begin with the new script
--
-- Nothing of the script runs in this process. Pages ask for /state.json?since=N, which is answered
-- when there is something newer than state N. What is answered of a film is in watch/answers.lua.
local program, request = ...

local json = require "celspan.json"

local function part(name) return program.part(name, program, request) end
local guard, watched = part "guard.lua", part "watched.lua"
local programs, joining = part "programs.lua", part "joining.lua"

local HELD = 20 -- seconds for which a request waits for news, or for a film
local SOON = 5  -- and for values that are sent with it

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
local door = guard.new(web.port, pages, program.random())
local files = part "files.lua".new()
local places = part "places.lua".new(files)
local reply = program.part("reply.lua", program, web)
local refuse, give_json, attempt = reply.refuse, reply.json, reply.attempt

-- ---------------------------------------------------------------- the films

-- news: the number of changes that pages must know. here: the line that an editor has named.
local state = { news = 1 }
local held = {}    -- requests for news: id, over
local waiting = {} -- requests for a film that is built later: id, wish, answer(), side, build, over
local answers = program.part("answers.lua", program, request, reply, places, state)

local function tell() state.news = state.news + 1 end

-- The film, and the second film beside it, which requests name with side=2: of the second script,
-- or of the same script with other values. sides: those that are shown.
local first = watched.new(request[1], files, places, tell)
local second = watched.new(request[2] or request[1], files, places, tell)
local sides = { first }
local rendering = part "renders.lua"
local renders = rendering.new(first, folder, tell)

--- Shows or hides the second film.
local function set_comparing(is_on)
  if is_on == (sides[2] ~= nil) then return end
  sides[2] = is_on and second or nil
  if is_on then second:build() else second:close "the second film is not shown any more" end
  tell()
end

-- ---------------------------------------------------------------- answers

local function describe_state()
  local said = first:describe()
  said.news, said.here, said.editor = state.news, state.here, request.editor ~= nil
  said.alone, said.second = request.is_alone or false, sides[2] and second:describe()
  said.has_two, said.render, said.folder = #request == 2, renders.said, folder
  return said
end

local kinds = { html = "text/html; charset=utf-8", css = "text/css; charset=utf-8",
                js = "text/javascript; charset=utf-8", svg = "image/svg+xml" }

local made = {} -- the texts of the page as they are sent

local function give_text(id, name)
  made[name] = made[name]
    or joining.text(name, program.text):gsub('<select name="format">', "%0" .. rendering.options())
  reply.send(id, 200, kinds[name:match "%w+$"], made[name])
end

--- Requests that are answered even if no film can be asked.
local own = { ["/curve.json"] = answers.give_curve }

own["/counts.json"] = function(id) give_json(id, web:counts()) end

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
                answer = function() attempt(id, answers.give, id, side, path, fields) end }
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
  if not answers.is_ready(id, first) then return end
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
if request.open then programs.browse(address) end
while not program.is_stopped() do step() end
programs.close()
renders:close()
for _, side in ipairs(sides) do side:close "celspan has ended" end
