--- Keyframes: values that change over time.
--
--   local x = keys{ {0, 10}, {1, 50, "outQuad"}, {2, 20} }
--   x:at(f.time)
--
-- A key is {time, value [, ease into it]}. Numbers, arrays of numbers, paints and colours such as
-- "#ff8800" are mixed; other strings and booleans hold until the next key. The first and the last
-- value hold beyond the ends, or the track repeats (loop = "repeat") or alternates its direction
-- (loop = "mirror").
local celspan = require "celspan"
local ease = require "celspan.ease"
local core = require "celspan.core"
local fields = require "celspan.fields"

---@class celspan.keys.track
local Track = {}
Track.__index = fields.reads("a track of keys", Track, { loop = true })
Track.__name = "celspan.keys"

local paint_metatable = getmetatable(celspan.clear)

local function is_paint(value)
  return getmetatable(value) == paint_metatable
end

--- The paint of a string such as "#rrggbb", or nil.
local function paint_of(text)
  local good, paint = pcall(celspan.rgb, text)
  return good and paint or nil
end

--- "number", "array", "paint", "colour" (a string), "held"; nil for invalid values.
local function kind_of(value)
  local type_of = type(value)
  if type_of == "number" then return fields.is_finite(value) and "number" or nil end
  if type_of == "string" and paint_of(value) then return "colour" end
  if type_of == "string" or type_of == "boolean" then return "held" end
  if is_paint(value) then return "paint" end
  if type_of ~= "table" then return nil end
  for i = 1, rawlen(value) do
    if not fields.is_finite(value[i]) then return nil end
  end
  return rawlen(value) > 0 and "array" or nil
end

local mixers = {}

function mixers.number(a, b, u)
  return a + (b - a) * u
end

function mixers.array(a, b, u)
  local mixed = {}
  for i = 1, #a do mixed[i] = a[i] + (b[i] - a[i]) * u end
  return mixed
end

-- Paints have no values outside 0..1, so curves that overshoot are limited here.
function mixers.paint(a, b, u)
  return celspan.mix(a, b, u)
end

function mixers.held(a, b, u)
  return u >= 1 and b or a
end

--- Raises an error at the line that made the keys.
local function complain(i, text, ...)
  error(("keys: key %d "):format(i) .. text:format(...), 5)
end

--- The fault of a key by itself, or nil.
local function problem_of(key)
  if type(key) ~= "table" then return "must be {time, value}, got " .. fields.kind(key) end
  if not fields.is_finite(key[1]) then
    return "must begin with a time, a finite number, got " .. fields.shown(key[1])
  end
  if not kind_of(key[2]) then
    return "must have a finite number, an array of them, a paint, a string or a boolean as value, "
      .. "got " .. fields.shown(key[2])
  end
  local good, curve = pcall(ease, key[3] or "linear")
  if not good then return "cannot have this ease: " .. curve:gsub("^ease: ", "") end
end

local function copy(value)
  return type(value) == "table" and { table.unpack(value, 1, rawlen(value)) } or value
end

--- How colour strings are read: as paints, unless any key is another string or a boolean; then as
--- words, which hold.
local function meaning_of_colours(list)
  for i = 1, rawlen(list) do
    if kind_of(list[i][2]) == "held" then return "held" end
  end
  return "paint"
end

local function read_keys(list)
  local keys, kind = {}, nil
  for i = 1, rawlen(list) do
    local problem = problem_of(list[i])
    if problem then complain(i, "%s", problem) end
  end
  local colours = meaning_of_colours(list)
  for i = 1, rawlen(list) do
    local found = kind_of(list[i][2])
    if found == "colour" then found = colours end
    kind = kind or found
    local time, value = list[i][1], copy(list[i][2])
    if found == "paint" and type(value) == "string" then value = paint_of(value) end
    if found ~= kind then
      complain(i, "is of another kind (%s) than the first (%s)", found, kind)
    end
    if kind == "array" and i > 1 and rawlen(value) ~= #keys[1].value then
      complain(i, "has %d numbers, the first has %d", rawlen(value), #keys[1].value)
    end
    if i > 1 and time < keys[i - 1].time then
      complain(i, "is at %s, before the key before it", tostring(time))
    end
    keys[i] = { time = time, value = value, ease = list[i][3] and ease(list[i][3]) }
  end
  return keys, kind
end

local loops = { ["repeat"] = true, mirror = true }

local function new(_, list)
  fields.check("keys", list, { "keys", loop = "string" }, 4)
  if rawlen(list) == 0 then error("keys: needs at least one key {time, value}", 3) end
  if list.loop ~= nil and not loops[list.loop] then
    error(('keys: loop must be "repeat" or "mirror", got %s'):format(tostring(list.loop)), 3)
  end
  local keys, kind = read_keys(list)
  return setmetatable({ keys = keys, kind = kind, loop = list.loop }, Track)
end

--- Maps a time into the track, by its loop.
local function fold(track, time)
  local first, last = track.keys[1].time, track.keys[#track.keys].time
  local length = last - first
  if not track.loop or length <= 0 then return time end
  local offset = (time - first) % length
  local turns = (time - first) // length
  if track.loop == "mirror" and turns % 2 == 1 then offset = length - offset end
  return first + offset
end

--- The index of the last key at or before a time; 0 if there is none.
local function place(keys, time)
  local low, high = 0, #keys
  while low < high do
    local middle = (low + high + 1) // 2
    if keys[middle].time <= time then low = middle else high = middle - 1 end
  end
  return low
end

--- The value at a time. Arrays are new at each call.
---@param time number
---@return any
function Track:at(time)
  fields.check_at("keys", Track, self, time, "a time")
  time = fold(self, time)
  local i = place(self.keys, time)
  local before, after = self.keys[i], self.keys[i + 1]
  if not before then return copy(after.value) end
  if not after then return copy(before.value) end
  local u = (time - before.time) / (after.time - before.time)
  if after.ease then
    u = after.ease(u)
    if not fields.is_finite(u) then
      error("keys: an ease must return a finite number, got " .. fields.shown(u), 2)
    end
  end
  return mixers[self.kind](before.value, after.value, u)
end

---@class celspan.keys
---@overload fun(list: table): celspan.keys.track
return fields.seal("keys", setmetatable({}, { __call = core.entry(new) }))
