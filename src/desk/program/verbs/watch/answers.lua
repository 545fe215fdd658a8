--- What pages ask of a film: pictures, sounds, the objects at a point, and costs (celspan watch).
--
-- A request names a frame, a size, a crop; each is checked here, and the renderers are asked.
local program, request, reply, places, state = ...

local ease = require "celspan.ease"
local json = require "celspan.json"

local choices = program.part("choices.lua", program)
local answer, refuse, give_json, pass_on = reply.send, reply.refuse, reply.json, reply.ask

local SIDE_MOST = 1048576  -- pixels
local PIXELS_MOST = 1 << 25 -- of a picture
local ONION_MOST = 16       -- frames before, and after
local COLUMNS_MOST = 10000  -- of a wave
local CURVE_STEPS = 48      -- of the picture of an ease
local UNITS_MOST = 1 << 30  -- the greatest distance of a point, on either side

local answers = {}

--- The numbers of a text such as "1,2,3" or "1280x720"; nil: the text has another form.
local function numbers(text, count)
  local all = {}
  for digits in (text or ""):gmatch "[^,x]+" do
    all[#all + 1] = digits:match "^%d%d?%d?%d?%d?%d?%d?$" and math.tointeger(digits)
  end
  return #all == count and all or nil
end

--- Whether a film can be asked; if not, the request is refused.
function answers.is_ready(id, side)
  if side.is_shown then return true end
  refuse(id, 409, side.errors[1] and side.errors[1].message or "the film is not ready yet")
end

--- The frame that a request is about; nil: refused.
local function frame_of(id, side, text)
  local number, facts = math.tointeger(text), side.facts
  if not answers.is_ready(id, side) then return nil end
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
  if not answers.is_ready(id, side) then return end
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
  if not answers.is_ready(id, side) then return end
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
    if not answers.is_ready(id, side) then return end
    pass_on(id, side, { want = want }, function(_, text) answer(id, 200, kind, text) end)
  end
end

local gets = { -- of a film
  ["/film.json"] = function(id, side)
    if answers.is_ready(id, side) then give_json(id, side.facts) end
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

--- Answers a request for data of a film.
function answers.give(id, side, path, fields)
  if gets[path] then return gets[path](id, side, fields) end
  local number, ending = path:match "^/frame/(%-?%d+)%.(%l+)$"
  if number and (ending == "png" or ending == "rgba" or ending == "runs") then
    return give_frame(id, side, number, fields, ending)
  end
  local x, y = path:match "^/at/(%-?[%d.]+),(%-?[%d.]+)%.json$"
  if x then return give_point(id, side, x, y, fields) end
  refuse(id, 404, "there is no such address")
end

--- The curve of an ease, at even steps from 0 to 1.
function answers.give_curve(id, fields)
  local is_known, curve = pcall(ease, fields.name)
  if not is_known then return refuse(id, 404, "there is no such curve") end
  local list = {}
  for i = 0, CURVE_STEPS do list[i + 1] = curve(i / CURVE_STEPS) end
  give_json(id, { list = list })
end

return answers
