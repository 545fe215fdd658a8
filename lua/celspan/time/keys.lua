--- Keyframes: values that change over time.
--
--   local x = keys{ {0, 10}, {1, 50, "outQuad"}, {2, 20} }
--   x:at(f.time)
--
-- A key is {time, value [, ease into it]}. Numbers, arrays of numbers and of points, paints,
-- colours such as "#ff8800", path data with the same commands and poses are mixed; other strings
-- and booleans hold until the next key. The first and the last value hold beyond the ends, or the
-- track repeats (loop = "repeat") or alternates its direction (loop = "mirror").
local celspan = require "celspan"
local ease = require "celspan.ease"
local native = require "celspan.native"
local fields = require "celspan.fields"
local ordered = require "celspan.ordered"
local pathdata = require "celspan.pathdata"
local poses = require "celspan.poses"

---@class celspan.keys.track
local Track = fields.class("celspan.keys", "a track of keys", { loop = true })

local paint_metatable = getmetatable(celspan.clear)

local function is_paint(value)
  return getmetatable(value) == paint_metatable
end

--- The paint of a string such as "#rrggbb", or nil: the name of a colour is a word.
local function paint_of(text)
  local good, paint = pcall(celspan.rgb, text:sub(1, 1) == "#" and text)
  return good and paint or nil
end

--- The commands of a string that is path data, or nil.
local function path_of(text)
  return text:find "^%s*[Mm]%s*[%d.+-]" and pathdata.commands(text) or nil
end

local function is_array(value)
  for i = 1, rawlen(value) do
    if not fields.is_finite(value[i]) then return false end
  end
  return rawlen(value) > 0
end

local function is_points(value)
  for i = 1, rawlen(value) do
    if type(value[i]) ~= "table" or not is_array(value[i]) then return false end
  end
  return rawlen(value) > 0
end

local function text_kind(text)
  if paint_of(text) then return "colour" end
  return path_of(text) and "path" or "held"
end

--- Whether a table contains only numbers, strings, booleans and such tables, at most five levels
--- deep.
local function is_pose(value, depth)
  for _, part in next, value do
    local type_of = type(part)
    local is_good = fields.is_finite(part) or type_of == "string" or type_of == "boolean"
      or type_of == "table" and depth < 5 and is_pose(part, depth + 1)
    if not is_good then return false end
  end
  return next(value) ~= nil
end

local function table_kind(value)
  if rawlen(value) == 0 then return is_pose(value, 1) and "pose" or nil end
  return is_array(value) and "array" or is_points(value) and "points" or nil
end

--- "number", "array", "points", "pose", "paint", "colour" (a string), "path", "held"; nil for
--- invalid values.
local function kind_of(value)
  local type_of = type(value)
  if type_of == "number" then return fields.is_finite(value) and "number" or nil end
  if type_of == "string" then return text_kind(value) end
  if type_of == "boolean" then return "held" end
  if is_paint(value) then return "paint" end
  return type_of == "table" and table_kind(value) or nil
end

local mixers = {}

function mixers.number(a, b, u)
  return a + (b - a) * u
end

function mixers.array(a, b, u)
  local mixed = { closed = a.closed } -- of a contour
  for i = 1, #a do mixed[i] = a[i] + (b[i] - a[i]) * u end
  return mixed
end

function mixers.points(a, b, u)
  local mixed = {}
  for i = 1, #a do mixed[i] = mixers.array(a[i], b[i], u) end
  return mixed
end

function mixers.pose(a, b, u) return poses.mix(a, b, u) end

--- The path data themselves at the keys; between keys their numbers are mixed.
function mixers.path(a, b, u)
  if u == 0 then return a.text end
  if u == 1 then return b.text end
  local words = {}
  for i, from in ipairs(a.commands) do
    local to = b.commands[i]
    words[#words + 1] = from.command
    for j = 1, #from do
      words[#words + 1] = ("%.10g"):format(from[j] + (to[j] - from[j]) * u)
    end
  end
  return table.concat(words, " ")
end

-- Paints have no values outside 0..1, so the results of curves that overshoot are clamped here.
function mixers.paint(a, b, u)
  return celspan.mix(a, b, u)
end

function mixers.held(a, b, u)
  return u >= 1 and b or a
end

--- Raises an error at the line that made the keys.
local function complain(i, text, ...)
  native.refuse(("keys: key %d "):format(i) .. text:format(...))
end

--- The fault of a single key, or nil.
local function problem_of(key)
  if type(key) ~= "table" then return "must be {time, value}, got " .. fields.kind(key) end
  if not fields.is_finite(key[1]) then
    return "must begin with a time, a finite number, got " .. fields.shown(key[1])
  end
  if not kind_of(key[2]) then
    return "must have a finite number, an array of numbers or points, a pose, a paint, a string "
      .. "or a boolean as value, got " .. fields.shown(key[2])
      .. (fields.kind(key[2]):find "^a " and ": make it in the frame, of colours or numbers that "
        .. "have keys" or "")
  end
  for name in next, key do
    if name ~= 1 and name ~= 2 and name ~= 3 then
      return ("has an unknown field %s: a key is {time, value [, ease]}"):format(fields.key(name))
    end
  end
  local good, curve = pcall(ease, key[3] or "linear")
  if not good then return "cannot have this ease: " .. curve:gsub("^ease: ", "") end
end

local function copy(value)
  if type(value) ~= "table" then return value end
  local made = {}
  for name, part in next, value do made[name] = copy(part) end
  return made
end

--- The result of at() for the value of a key.
local function shown_value(value)
  if type(value) == "table" and value.commands then return value.text end
  return copy(value)
end

--- Why a value cannot be mixed with the first value of its track, or nil.
local function misfit(kind, value, first)
  if kind == "array" and #value ~= #first then
    return ("has %d numbers, the first has %d"):format(#value, #first)
  end
  if kind == "points" and #value ~= #first then
    return ("has %d points, the first has %d"):format(#value, #first)
  end
  for i = 1, kind == "points" and #value or 0 do
    if #value[i] ~= #first[i] then
      return ("has %d numbers in point %d, the first has %d"):format(#value[i], i, #first[i])
    end
  end
  for i = 1, kind == "path" and math.max(#value.commands, #first.commands) or 0 do
    local one, other = value.commands[i], first.commands[i]
    local is_same = one and other and one.command == other.command
    if not is_same or one.command:upper() == "A" and (one[4] ~= other[4] or one[5] ~= other[5]) then
      return ("differs from the first at command %d of its path data: the commands must be the "
        .. "same, and the flags of arcs"):format(i)
    end
  end
end

--- The value in the form in which its kind is stored.
local function kept_value(kind, value)
  if kind == "paint" and type(value) == "string" then return paint_of(value) end
  if kind == "path" then return { text = value, commands = path_of(value) } end
  return copy(value)
end

--- How strings are read that could be colours or path data: as such, unless the value of any key is
--- a different string or a boolean. In that case they are words, which are not mixed.
local function meanings_of(list)
  for i = 1, rawlen(list) do
    if kind_of(list[i][2]) == "held" then return { colour = "held", path = "held" } end
  end
  return { colour = "paint" }
end

local function read_keys(list)
  local keys, kind = {}, nil
  for i = 1, rawlen(list) do
    local problem = problem_of(list[i])
    if problem then complain(i, "%s", problem) end
  end
  local meanings = meanings_of(list)
  for i = 1, rawlen(list) do
    local found = kind_of(list[i][2])
    found = meanings[found] or found
    kind = kind or found
    if found ~= kind then
      complain(i, "is of another kind (%s) than the first (%s)", found, kind)
    end
    local time, value = list[i][1], kept_value(found, list[i][2])
    local problem = i > 1 and misfit(kind, value, keys[1].value)
    if problem then complain(i, "%s", problem) end
    if i > 1 and time < keys[i - 1].time then
      complain(i, "is at %s, before the key before it", tostring(time))
    end
    keys[i] = { time = time, value = value, ease = list[i][3] and ease(list[i][3]) }
  end
  return keys, kind
end

local loops = { ["repeat"] = true, mirror = true }

local function new(_, list)
  fields.check("keys", list, { "keys", loop = "string" })
  if rawlen(list) == 0 then native.refuse("keys: needs at least one key {time, value}") end
  if list.loop ~= nil and not loops[list.loop] then
    native.refuse(('keys: loop must be "repeat" or "mirror", got %s'):format(fields.key(list.loop)))
  end
  local keys, kind = read_keys(list)
  return setmetatable({ keys = keys, kind = kind, loop = list.loop }, Track)
end

--- Maps a time into the track, using its loop.
local function fold(track, time)
  local first, last = track.keys[1].time, track.keys[#track.keys].time
  local length = last - first
  if not track.loop or length <= 0 then return time end
  local offset = (time - first) % length
  local turns = (time - first) // length
  if track.loop == "mirror" and turns % 2 == 1 then offset = length - offset end
  return first + offset
end

--- The value at a time. Arrays are new at each call.
---@param time number
---@return any
function Track:at(time)
  fields.check_at("keys", Track, self, time, "a time")
  time = fold(self, time)
  local i = ordered.last(self.keys, time, "time")
  local before, after = self.keys[i], self.keys[i + 1]
  if not before then return shown_value(after.value) end
  if not after then return shown_value(before.value) end
  local u = (time - before.time) / (after.time - before.time)
  if after.ease then
    u = after.ease(u)
    fields.expect(fields.is_finite(u), u, "keys: an ease must return a finite number")
  end
  return mixers[self.kind](before.value, after.value, u)
end

---@class celspan.keys
---@overload fun(list: table): celspan.keys.track
return fields.publish("keys", setmetatable({}, { __call = native.entry(new) }), Track)
