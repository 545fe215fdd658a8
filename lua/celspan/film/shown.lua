--- What a frame shows: what frame functions return, and whatever else shows a frame, as rostrums.
--
--   rostrum                             itself
--   object, cel                         a rostrum with it
--   { object, { cel, nil }, camera = }  a rostrum with a cel for each, and with the named fields
--   { { any of these, weight }, ... }   exposures
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"

local shown = {}

local MOST, DEEPEST = 100000, 16
local WANTED = " must be a rostrum, an object, a cel or a list of them, got "

local function kind_of(value) return type(value) == "userdata" and getmetatable(value) or nil end

local function refuse(text, ...) error { message = text:format(...) } end

--- The greatest whole number among the keys of a list, and its first named field.
local function ends_of(list, place)
  local last, name = 0, nil
  for key in next, list do
    if type(key) == "string" then name = name and name < key and name or key end
    if math.type(key) == "integer" and key > last then last = key end
  end
  if last > MOST then refuse("%s%sa list that is too long", place, WANTED) end
  return last, name
end

--- Adds the cels of a value. place: where it is, for messages.
local function add(cels, value, place, depth)
  local kind = kind_of(value)
  if kind == "celspan.cel" then
    cels[#cels + 1] = value
  elseif kind == "celspan.object" or kind == "celspan.rostrum" then
    cels[#cels + 1] = native.cel_of(value)
  elseif type(value) ~= "table" then
    refuse("%s%s%s", place, WANTED, fields.kind(value))
  elseif getmetatable(value) then
    refuse("%s%sa table with methods: a drawing has its 'object'", place, WANTED)
  else
    local last, name = ends_of(value, place)
    if depth > DEEPEST then refuse("%s%slists in lists that are too deep", place, WANTED) end
    if name and depth > 0 then
      refuse("%s has the field '%s'; lights, a camera and other fields belong to the whole list, "
        .. "{ a, b, %s = ... }", place, name, name)
    end
    for i = 1, last do
      if value[i] then add(cels, value[i], ("%s: item %d"):format(place, i), depth + 1) end
    end
  end
end

local function rostrum_of(name, value)
  if kind_of(value) == "celspan.rostrum" then return value end
  local cels = {}
  add(cels, value, name, 0)
  for key, field in next, type(value) == "table" and value or {} do
    if type(key) == "string" then cels[key] = field end
  end
  return celspan.rostrum(cels)
end

--- Whether an item is { rostrum [, weight] } or { what is shown, weight }.
local function is_exposure(item)
  if type(item) ~= "table" then return false end
  local second = item[2]
  local is_alone = not kind_of(second) and type(second) ~= "table" and type(second) ~= "boolean"
  return type(second) == "number" or kind_of(item[1]) == "celspan.rostrum" and is_alone
end

local function settle(name, value)
  local is_list = type(value) == "table" and not getmetatable(value)
  local count, list = is_list and ends_of(value, name) or 0, {}
  for i = 1, count do
    if not is_exposure(value[i]) then return rostrum_of(name, value) end
  end
  for i = 1, count do
    list[i] = { rostrum_of(("%s: exposure %d"):format(name, i), value[i][1]), value[i][2] }
  end
  return count > 0 and list or rostrum_of(name, value)
end

--- A rostrum, or a new list of { rostrum, weight }; or nil and a message. name: for messages.
function shown.settled(name, value) return fields.caught(settle, name, value) end

--- The same for modules, or an error, as a list in any case.
function shown.list(name, value)
  local made, message = shown.settled(name, value)
  if message then native.refuse(message) end
  if type(made) ~= "table" then return { { made, 1 } } end
  for _, exposure in ipairs(made) do exposure[2] = exposure[2] or 1 end
  return made
end

--- The cels of an object, a cel or a list of them; none of nil.
function shown.cels(name, value)
  local cels = {}
  local _, message = fields.caught(add, cels, value or {}, name, 0)
  return message and native.refuse(message) or cels
end

--- What shown.settled made, with each rostrum changed by a function.
function shown.each(made, change, ...)
  if type(made) ~= "table" then return change(made, ...) end
  local list = {}
  for i, exposure in ipairs(made) do list[i] = { change(exposure[1], ...), exposure[2] } end
  return list
end

return fields.seal("shown", shown)
