--- Properties of Lottie, which may have keyframes: compiled once into functions of the frame.
--
--   keys   s  e        s  e        s        old: e, the end, in the same key; the last has none
--          |---ease----|---ease----|------  new: the end is the s of the next key
--          t           t           t
--
-- A property is a number, a list of numbers, or an outline (lottie_contour.lua), which is a list of
-- numbers, too. A file may have many more keys than a film has frames, so what a key holds is read
-- when a frame needs it.
local contours = require "celspan.lottie_contour"
local curves = require "celspan.curves"
local ease = require "celspan.ease"
local ordered = require "celspan.ordered"
local values = require "celspan.lottie_values"

local property = {}

-- ---------------------------------------------------------------- eases

--- The coordinate of a handle. One that has a list, a number for each dimension, has the first one
--- for all: so do the players that draw keyframes natively.
local function coordinate(handle, axis)
  local given = handle[axis]
  if values.table(given) then given = given[1] end
  return type(given) == "number" and given == given and given or nil
end

local function linear(u) return u end

--- The ease of a key; handles that are missing make it linear.
local function ease_of(key)
  local from, to = values.table(key.o), values.table(key.i)
  if not from or not to then return linear end
  local x1, y1, x2, y2 = coordinate(from, "x"), coordinate(from, "y"), coordinate(to, "x"),
    coordinate(to, "y")
  if not (x1 and y1 and x2 and y2) or (x1 == y1 and x2 == y2) then return linear end
  x1, x2 = math.max(0, math.min(1, x1)), math.max(0, math.min(1, x2))
  y1, y2 = values.number(y1, 0), values.number(y2, 0)
  return ease(("bezier:%.14g,%.14g,%.14g,%.14g"):format(x1, y1, x2, y2))
end

--- Whether a coordinate of a handle is another one for a dimension that changes in a segment.
local function is_uneven(handle, axis, segment_of, i)
  local list = values.table(handle) and values.table(handle[axis])
  for n = 2, list and #list or 0 do
    if list[n] ~= list[1] then
      local from, to = segment_of(i).from, segment_of(i).to
      if n <= math.min(#from, #to) and from[n] ~= to[n] then return true end
    end
  end
  return false
end

-- ---------------------------------------------------------------- spatial curves

--- The way of a point between two keys, where its handles are not zero.
local function way_of(key, from, to)
  local out, into = values.table(key.to), values.table(key.ti)
  if not out or not into or #from < 2 then return nil end
  local o, i = values.list(out, { 0, 0 }, 2), values.list(into, { 0, 0 }, 2)
  if o[1] == 0 and o[2] == 0 and i[1] == 0 and i[2] == 0 then return nil end
  local curve = curves.of("lottie", { { from[1], from[2], from[1] + o[1], from[2] + o[2],
                                        to[1] + i[1], to[2] + i[2], to[1], to[2] } })
  return curve and curve.length > 0 and function(share) return curve:at(share * curve.length) end
    or nil
end

-- ---------------------------------------------------------------- keyframes

--- The keys of a list and their times, in the order of their times.
local function keys_of(list)
  local keys, times, order, is_sorted = {}, {}, {}, true
  for _, key in ipairs(list) do
    if values.table(key) and type(key.t) == "number" then
      local n = #order + 1
      keys[n], times[n], order[n] = key, values.frame(key.t, 0), n
      is_sorted = is_sorted and times[n] >= (times[n - 1] or times[n])
    end
  end
  if is_sorted then return keys, times end
  table.sort(order, function(a, b) return times[a] < times[b] or times[a] == times[b] and a < b end)
  local sorted, sorted_times = {}, {}
  for i, n in ipairs(order) do sorted[i], sorted_times[i] = keys[n], times[n] end
  return sorted, sorted_times
end

local function has_value(given)
  return given and (type(given) ~= "table" or values.table(given))
end

--- What every key begins and ends with, as the file has it; false: nothing.
local function ends_of(keys)
  local from, to = {}, {}
  for i, key in ipairs(keys) do
    local after = keys[i + 1]
    from[i] = has_value(key.s) and key.s or to[i - 1] or false
    to[i] = has_value(key.e) and key.e or after and has_value(after.s) and after.s or from[i]
  end
  return from, to
end

--- A function that makes the segment of a key, once. read: makes a value of what a key holds.
local function segments_of(keys, times, read)
  local from, to = ends_of(keys)
  local made = {}
  return function(i)
    if not made[i] then
      local key, a, b = keys[i], read(from[i] or nil), read(to[i] or nil)
      made[i] = { t = times[i], from = a, to = b, is_held = values.flag(key.h),
                  ease = ease_of(key), way = way_of(key, a, b) }
    end
    return made[i]
  end
end

--- Notes where the eases of the dimensions differ.
local function note_uneven(keys, segment_of, note)
  for i = 1, #keys - 1 do
    local o, into = keys[i].o, keys[i].i
    if is_uneven(o, "x", segment_of, i) or is_uneven(o, "y", segment_of, i)
      or is_uneven(into, "x", segment_of, i) or is_uneven(into, "y", segment_of, i) then
      return note "has an ease for each dimension; the first stands for all"
    end
  end
end

--- Mixes two lists; the shape of an outline is that of the first.
local function mix(from, to, u)
  if #from ~= #to then return from end
  local list = { closed = from.closed }
  for i = 1, #from do list[i] = from[i] + u * (to[i] - from[i]) end
  return list
end

local function within(segment, length, t)
  local u = segment.ease((t - segment.t) / length)
  local value = mix(segment.from, segment.to, u)
  if segment.way then value[1], value[2] = segment.way(u) end
  return value
end

--- The value at a frame.
local function value_at(times, segment_of, t)
  local place = math.max(1, ordered.last(times, t))
  local segment, after = segment_of(place), times[place + 1]
  if t <= segment.t or not after or segment.is_held then return segment.from end
  return within(segment, after - segment.t, t)
end

--- A function of the frame, which keeps its last value.
local function animate(times, segment_of)
  local last, value
  return function(t)
    if t ~= last then last, value = t, value_at(times, segment_of, t) end
    return value
  end
end

-- ---------------------------------------------------------------- properties

--- The property that a slot of the file names, or the one that is given.
local function resolve(scope, given, kind)
  return values.table(given) and scope.root.slot(given.sid, kind) or given
end

--- What a property holds: its keys, or a value without keys.
local function content_of(given)
  if not values.table(given) then return given end
  if given.k ~= nil then return given.k end
  return given[1] ~= nil and given or nil
end

local function has_keys(content)
  local first = values.table(content) and values.table(content[1])
  return first and first.t ~= nil
end

local function note_expression(scope, given, what)
  if values.table(given) and type(given.x) == "string" and given.x ~= "" then
    scope.note(what .. " has an expression, which is not run; the value without it is shown")
  end
end

--- The function of a property, and whether it moves. A key outside its times has the nearest value.
local function compile(scope, given, what, read, kind)
  given = resolve(scope, given, kind)
  note_expression(scope, given, what)
  local content = content_of(given)
  local keys, times = keys_of(has_keys(content) and content or {})
  if #keys > 1 then
    local segment_of = segments_of(keys, times, read)
    note_uneven(keys, segment_of, function(text) scope.note(("%s %s"):format(what, text)) end)
    return animate(times, segment_of), true
  end
  if keys[1] then content = has_value(keys[1].s) and keys[1].s or keys[1].e end
  local value = read(content)
  return function() return value end, false
end

--- A number.
---@return fun(t: number): number
---@return boolean moves
function property.number(scope, given, what, default)
  local get, moves = compile(scope, given, what,
    function(content) return { values.number(content, default) } end, "number")
  if moves then return function(t) return get(t)[1] end, true end
  local value = get(0)[1]
  return function() return value end, false
end

--- A list of numbers.
---@return fun(t: number): number[]
---@return boolean moves
function property.list(scope, given, what, default)
  local count = #default
  return compile(scope, given, what,
    function(content) return values.list(content, default, count) end, "list")
end

--- A list of as many numbers as there are: of a gradient.
function property.numbers(scope, given, what)
  return compile(scope, given, what, values.numbers, "gradient")
end

--- A colour: three numbers, 0..1. Files of version 4.0 have 0..255.
function property.colour(scope, given, what)
  return compile(scope, given, what, function(content)
    local list = values.list(content, { 0, 0, 0 }, 3)
    if math.max(list[1], list[2], list[3]) > 1.5 then
      for i = 1, 3 do list[i] = list[i] / 255 end
    end
    return list
  end, "colour")
end

--- A position, which may have a property for each axis.
function property.point(scope, given, what)
  given = resolve(scope, given, "list")
  if not (values.table(given) and values.table(given.x)) then
    return property.list(scope, given, what, { 0, 0 })
  end
  local x, moves_x = property.number(scope, given.x, what .. " x", 0)
  local y, moves_y = property.number(scope, given.y, what .. " y", 0)
  local at, beside, value
  return function(t)
    local u, v = x(t), y(t)
    if u ~= at or v ~= beside then at, beside, value = u, v, { u, v } end
    return value
  end, moves_x or moves_y
end

--- An outline. closed: what the shape says of it, in old files.
function property.outline(scope, given, what, closed)
  return compile(scope, given, what, function(content)
    if values.table(content) and values.table(content[1]) then content = content[1] end
    return contours.read(content, closed)
  end)
end

--- How to read several properties: a function that takes one of the functions above and what it
--- takes behind the scope, and another that says whether one of the properties so far moves.
function property.reader(scope)
  local moves = false
  return function(how, ...)
    local get, is_moving = how(scope, ...)
    moves = moves or is_moving
    return get
  end, function() return moves end
end

return require "celspan.fields".seal("lottie_property", property)
