--- Films made of films: shots one after another, with transitions between them.
--
--   return cut{ shot1, cut.dissolve(0.5), { film = shot2, from = 10, to = 60, name = "chase" } }
--
-- A frame of the new film is a frame of one shot, or a transition between those of two. Only these
-- frames are built. Nothing else of a shot is known here, so its lips, sheets and cameras move with
-- it; its sounds and marks are moved by name.
--
--   shot 1   |==================|               start 0, count 20
--   shot 2                 |=======...          start 20 - n: n frames of a transition
--
-- One file, because a transition is little more than its two halves, and needs the cut around it.
local celspan = require "celspan"
local core = require "celspan.core"
local fields = require "celspan.fields"
local keys = require "celspan.keys"
local ordered = require "celspan.ordered"

local cut = {}

local SMALL = 1e-9 -- of a frame: 3 frames at 0.1 of the speed are 30 and not 31
local MOST_PIECES = 10000 -- of a sound that is retimed

-- ---------------------------------------------------------------- films

local film_metatable = getmetatable(celspan.film { frame = function() end })

local function is_film(value) return getmetatable(value) == film_metatable and
  fields.kind(value) == "a film" end

--- What a frame function returns, as a list of { rostrum, weight }.
local function exposures_of(result)
  if type(result) ~= "table" then return { { result, 1 } } end
  local list = {}
  for i, exposure in ipairs(result) do list[i] = { exposure[1], exposure[2] or 1 } end
  return list
end

--- Adds the exposures of a result, with their weights multiplied; those of no weight show nothing.
local function expose(list, result, weight)
  for _, exposure in ipairs(exposures_of(result)) do
    if exposure[2] * weight > 0 then
      list[#list + 1] = { exposure[1], exposure[2] * weight }
    end
  end
end

local function total_of(exposures)
  local total = 0
  for _, exposure in ipairs(exposures) do total = total + exposure[2] end
  return total
end

-- ---------------------------------------------------------------- transitions

---@class celspan.cut.transition
---@field seconds number
local Transition = {}
Transition.__index = fields.reads("a transition", Transition,
  { pair = true, first = true, second = true, is_fade = true })
Transition.__name = "celspan.cut.transition"

--- A transition has `pair(a, b, u)`, or two halves that add up, because light does: what is seen of
--- a, first(a, u, size), and of b, second(b, u, size).
local function transition(noun, seconds, parts)
  if not fields.is_finite(seconds) or seconds <= 0 then
    core.refuse(("cut: %s takes seconds, a number above 0, got %s"):format(noun,
      fields.shown(seconds)))
  end
  local value = { seconds = seconds, noun = noun }
  for name, part in pairs(parts) do value[name] = part end
  return setmetatable(value, Transition)
end

--- A rostrum of one cel, antialiased like the shot that it shows.
local function show(shot, object, front)
  return celspan.rostrum { antialias = shot.antialias, celspan.cel { object, front = front } }
end

--- One shot becomes the other.
---@param seconds number
---@return celspan.cut.transition
function cut.dissolve(seconds)
  return transition("dissolve", seconds, {
    first = function(a, u) return { { a, 1 - u } } end,
    second = function(b, u) return { { b, u } } end,
  })
end

--- The first shot becomes a colour, and the colour the second. At the beginning or end of a film
--- only the half with a shot is seen.
---@param seconds number
---@param colour? celspan.surface Default black
---@return celspan.cut.transition
function cut.fade(seconds, colour)
  local texture = colour == nil and "#000" or colour
  local good, message = pcall(celspan.rect, { 0, 0, 1, 1, texture = texture })
  if not good then
    core.refuse("cut: fade: the colour: " .. tostring(message):gsub("^.-rect: ", ""))
  end
  local function ground(size)
    return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, size[1], size[2],
      texture = texture } } }
  end
  local function half(shot, share, size)
    if share <= 0 then return {} end
    return { { shot, share }, { ground(size), 1 - share } }
  end
  return transition("fade", seconds, {
    is_fade = true,
    first = function(a, u, size) return half(a, 1 - 2 * u, size) end,
    second = function(b, u, size)
      if u == 0.5 then return { { ground(size), 1 } } end
      return half(b, 2 * u - 1, size)
    end,
  })
end

--- Checks the settings of a transition: named fields and their ranges { least, most }.
local function settings_of(noun, settings, known, ranges)
  fields.check("cut: " .. noun, settings, known)
  for name, range in pairs(ranges) do
    local value = settings[name]
    if value and (value < range[1] or value > range[2]) then
      core.refuse(("cut: %s: field '%s' must be %s..%s, got %s"):format(noun, name,
        fields.shown(range[1]), fields.shown(range[2]), fields.shown(value)))
    end
  end
end

local function grey(value) return celspan.rgb(value, value, value) end

--- The area of the plane on one side of a line: where x cos + y sin is at most `place`, or at least
--- if the sign is -1. reach: longer than the frame's diagonal.
local function half_plane(cos, sin, place, sign, reach)
  local x, y = cos * place, sin * place
  local dx, dy, far = -sin * reach, cos * reach, sign * reach
  return celspan.polygon { { x + dx, y + dy }, { x - dx, y - dy },
    { x - dx - cos * far, y - dy - sin * far }, { x + dx - cos * far, y + dy - sin * far } }
end

--- The places of the edge of a wipe: all of b up to `low`, nothing of it from `high` on.
local function wipe_edge(cos, sin, softness, u, size)
  local least, most = math.huge, -math.huge
  for _, corner in ipairs { { 0, 0 }, { size[1], 0 }, { 0, size[2] }, size } do
    local place = corner[1] * cos + corner[2] * sin
    least, most = math.min(least, place), math.max(most, place)
  end
  local soft = softness * (most - least)
  local high = least + u * (most - least + soft)
  return high - soft, high
end

--- An edge moves over the first shot, and behind it is the second. angle: its direction in degrees,
--- 0 from left to right, clockwise; softness: the width of the edge, as a share of its way.
---@param settings? { angle?: number, softness?: number }
---@return fun(seconds: number): celspan.cut.transition
function cut.wipe(settings)
  settings = settings or {}
  settings_of("wipe", settings, { angle = "number", softness = "number" },
    { softness = { 0, 1 } })
  local angle, softness = math.rad((settings.angle or 0) % 360), settings.softness or 0
  local cos, sin = math.cos(angle), math.sin(angle)
  local function side(shot, u, size, is_second)
    local low, high = wipe_edge(cos, sin, softness, u, size)
    local reach = 4 * (size[1] + size[2])
    local shape = half_plane(cos, sin, is_second and high or low, is_second and 1 or -1, reach)
    local front = high > low and celspan.linear { from = { cos * low, sin * low },
      to = { cos * high, sin * high }, { 0, grey(is_second and 1 or 0) },
      { 1, grey(is_second and 0 or 1) } } or nil
    return { { show(shot, celspan.clip(shot, shape), front), 1 } }
  end
  return function(seconds)
    return transition("wipe", seconds, {
      first = function(a, u, size) return side(a, u, size, false) end,
      second = function(b, u, size) return side(b, u, size, true) end,
    })
  end
end

--- The radii of the edge of an iris, as those of wipe_edge.
local function iris_edge(centre, softness, u, size)
  local most = 0
  for _, corner in ipairs { { 0, 0 }, { size[1], 0 }, { 0, size[2] }, size } do
    local dx, dy = corner[1] - centre[1], corner[2] - centre[2]
    most = math.max(most, math.sqrt(dx * dx + dy * dy))
  end
  local soft = softness * most
  local high = u * (most + soft)
  return high - soft, high
end

--- The light of one of the shots around a soft circle.
local function iris_light(centre, low, high, is_second)
  local inner = math.min(1, high / (high - low))
  local function light(share) return grey(is_second and share or 1 - share) end
  return celspan.radial { centre = centre, radius = high, { 0, light(inner) },
    { math.max(0, low) / high, light(inner) }, { 1, light(0) } }
end

--- The second shot is seen in a circle that grows. centre: default the middle of the film;
--- softness: the width of the edge, as a share of the greatest radius.
---@param settings? { centre?: celspan.point, softness?: number }
---@return fun(seconds: number): celspan.cut.transition
function cut.iris(settings)
  settings = settings or {}
  settings_of("iris", settings, { centre = "table", softness = "number" },
    { softness = { 0, 1 } })
  if settings.centre then
    fields.numbers("cut", "iris: centre[%d]", settings.centre, 2, "a point {x, y}")
  end
  local given = settings.centre and { settings.centre[1], settings.centre[2] }
  local softness = settings.softness or 0
  local function side(shot, u, size, is_second)
    local centre = given or { size[1] / 2, size[2] / 2 }
    local low, high = iris_edge(centre, softness, u, size)
    local art = celspan.clip(shot, celspan.circle { centre = centre, radius = high })
    if not is_second then
      art = low > 0 and celspan.difference { shot,
        celspan.circle { centre = centre, radius = low } } or shot
    end
    local front = softness > 0 and iris_light(centre, low, high, is_second) or nil
    return { { show(shot, art, front), 1 } }
  end
  return function(seconds)
    return transition("iris", seconds, {
      first = function(a, u, size) return side(a, u, size, false) end,
      second = function(b, u, size) return side(b, u, size, true) end,
    })
  end
end

local SIDES = { right = { 1, 0 }, left = { -1, 0 }, top = { 0, -1 }, bottom = { 0, 1 } }

--- The second shot pushes the first one out of the frame.
---@param settings? { from?: "right"|"left"|"top"|"bottom" }
---@return fun(seconds: number): celspan.cut.transition
function cut.push(settings)
  settings = settings or {}
  settings_of("push", settings, { from = "string" }, {})
  local from = settings.from or "right"
  local side = SIDES[from]
  if not side then
    core.refuse(('cut: push: field \'from\' must be "right", "left", "top" or "bottom", got "%s"')
      :format(from))
  end
  local function moved(shot, share, size)
    return { { show(shot, shot:translate(side[1] * share * size[1], side[2] * share * size[2])),
      1 } }
  end
  return function(seconds)
    return transition("push", seconds, {
      first = function(a, u, size) return moved(a, -u, size) end,
      second = function(b, u, size) return moved(b, 1 - u, size) end,
    })
  end
end

--- A transition of one's own.
---@param make fun(a: celspan.rostrum, b: celspan.rostrum, u: number): celspan.exposures
---@return fun(seconds: number): celspan.cut.transition
function cut.with(make)
  if type(make) ~= "function" then
    core.refuse("cut: with takes a function(a, b, u), got " .. fields.kind(make))
  end
  return function(seconds) return transition("with", seconds, { pair = make }) end
end

--- The exposures of a frame of a transition. a, b: results of frame functions, nil at an end of the
--- film.
local function join(between, a, b, u, size)
  local nothing = { { celspan.rostrum { size = size }, 1 } }
  local first, second = a and exposures_of(a) or nothing, b and exposures_of(b) or nothing
  local list = {}
  for _, side in ipairs { first, second } do
    for _, exposure in ipairs(side) do exposure[1] = exposure[1]:with { size = size } end
  end
  if between.is_fade and not (a and b) then u = a and u / 2 or 0.5 + u / 2 end
  if between.pair then
    for _, one in ipairs(first) do
      for _, other in ipairs(second) do
        expose(list, between.pair(one[1], other[1], u), one[2] * other[2])
      end
    end
    return list
  end
  local first_total, second_total = total_of(first), total_of(second)
  for _, one in ipairs(first) do
    expose(list, between.first(one[1], u, size), one[2] * second_total)
  end
  for _, other in ipairs(second) do
    expose(list, between.second(other[1], u, size), other[2] * first_total)
  end
  return list
end

-- ---------------------------------------------------------------- parts

local part_fields = { film = "userdata", from = "number", to = "number", speed = "number",
  name = "string" }

local function complain(i, text, ...)
  core.refuse(("cut: part %d: "):format(i) .. text:format(...))
end

local function check_frame(i, part, name, film)
  local frame, last = part[name], film.first + film.frames - 1
  if frame and (frame ~= math.floor(frame) or frame < film.first or frame > last) then
    complain(i, "field '%s' must be a frame of the film, %d to %d, got %s", name, film.first, last,
      fields.shown(frame))
  end
end

local function read_shot(i, part, like)
  if is_film(part) then part = { film = part } end
  if type(part) ~= "table" then
    complain(i, "must be a film, { film = ... } or a transition, got %s", fields.kind(part))
  end
  fields.check(("cut: part %d"):format(i), part, part_fields)
  local film = part.film
  if not is_film(film) then
    complain(i, "field 'film' must be a film, got %s", fields.kind(film))
  end
  check_frame(i, part, "from", film)
  check_frame(i, part, "to", film)
  local from, to = part.from or film.first, part.to or film.first + film.frames - 1
  if from > to then complain(i, "'from' is %d, which is after 'to', %d", from, to) end
  local speed = part.speed or 1
  if speed < 0.01 or speed > 100 then
    complain(i, "field 'speed' must be 0.01..100, got %s (cut.retime holds and reverses)",
      fields.shown(speed))
  end
  like = like or film
  if film.fps ~= like.fps then
    complain(i, "its fps is %s, and that of the first film %s", fields.shown(film.fps),
      fields.shown(like.fps))
  end
  if film.size[1] ~= like.size[1] or film.size[2] ~= like.size[2] then
    complain(i, "its size is %dx%d, and that of the first film %dx%d", film.size[1], film.size[2],
      like.size[1], like.size[2])
  end
  local count = math.max(1, math.ceil((to - from + 1) / speed - SMALL))
  return { place = i, film = film, from = from, to = to, speed = speed, name = part.name,
           count = count, before = 0, after = 0 }
end

--- Lays a transition over the shots beside it, nil at an end.
local function overlap(place, between, a, b, fps)
  local count = math.max(1, math.floor(between.seconds * fps + 0.5))
  if a then a.after = count end
  if b then b.before = count end
  for _, shot in ipairs { a or b, b or a } do
    if shot.before + shot.after > shot.count then
      complain(shot.place, "the shot has %d frames, and its transitions need %d: give it more "
        .. "frames, or make part %d shorter", shot.count, shot.before + shot.after, place)
    end
  end
  return count
end

--- The shots with their starts, and the segments of the film in their order: { from =, a = shot,
--- b = shot or nil, between = transition or nil, count = of its frames }.
local function lay_out(parts)
  local shots, segments, pending = {}, {}, nil
  local start, last = 0, nil
  local function add_segment(segment)
    if segment.count > 0 then segments[#segments + 1] = segment end
  end
  for i = 1, #parts do
    local part = parts[i]
    if getmetatable(part) == Transition then
      if pending then complain(i, "is a transition after a transition; put a film between them") end
      pending = { place = i, between = part }
    else
      local shot = read_shot(i, part, shots[1] and shots[1].film)
      local count = 0
      if pending then count = overlap(pending.place, pending.between, last, shot, shot.film.fps) end
      shot.start = last and start - count or 0
      if pending then
        add_segment { from = shot.start, a = last, b = shot, between = pending.between,
                      count = count }
      end
      shots[#shots + 1], last, pending = shot, shot, nil
      start = shot.start + shot.count
    end
  end
  if not last then core.refuse "cut: needs at least one film" end
  if pending then
    local count = overlap(pending.place, pending.between, last, nil, last.film.fps)
    add_segment { from = start - count, a = last, between = pending.between, count = count }
  end
  for _, shot in ipairs(shots) do
    add_segment { from = shot.start + shot.before, a = shot,
                  count = shot.count - shot.before - shot.after }
  end
  table.sort(segments, function(one, other) return one.from < other.from end)
  return shots, segments, start
end

-- ---------------------------------------------------------------- sounds and marks

--- The sound of a film as a list.
local function list_of(sound)
  if sound == nil then return {} end
  if type(sound) == "string" or type(sound) == "table" and
    (type(sound[1]) == "string" or is_film(sound[1])) then
    return { sound }
  end
  return sound
end

--- The sounds of the shots, which fade in and out with the pictures, and those of the cut.
local function sounds_of(shots, own)
  local sounds = {}
  for _, shot in ipairs(shots) do
    local film, fps = shot.film, shot.film.fps
    if #list_of(film.sound) > 0 then
      sounds[#sounds + 1] = { film, at = shot.start / fps, from = (shot.from - film.first) / fps,
                              to = (shot.to - film.first + 1) / fps, speed = shot.speed,
                              name = shot.name,
                              fade = { shot.before / fps, shot.after / fps } }
    end
  end
  if type(own) ~= "nil" and type(own) ~= "string" and type(own) ~= "table" then return own end
  local list = list_of(own)
  for i = 1, #list do sounds[#sounds + 1] = list[i] end
  return #sounds > 0 and sounds or nil
end

--- Adds the marks of a shot, where it shows their frames.
local function add_marks(shot, marks)
  for name, frame in pairs(shot.film.marks or {}) do
    local place = shot.start + math.ceil((frame - shot.from) / shot.speed - SMALL) + 1
    if frame >= shot.from and frame <= shot.to and place <= shot.start + shot.count then
      marks[name] = math.min(marks[name] or place, place)
    end
  end
end

--- The marks of the shots, then the names of the parts, then those of the cut.
local function marks_of(shots, own)
  local marks, names = {}, {}
  for _, shot in ipairs(shots) do add_marks(shot, marks) end
  for _, shot in ipairs(shots) do
    if shot.name and names[shot.name] then
      complain(shot.place, "has the name of part %d, %q", names[shot.name], shot.name)
    end
    if shot.name then marks[shot.name], names[shot.name] = shot.start + 1, shot.place end
  end
  if own ~= nil and type(own) ~= "table" then return own end
  for name, frame in pairs(own or {}) do marks[name] = frame end
  return next(marks) ~= nil and marks or nil
end

-- ---------------------------------------------------------------- films of films

--- The frame of a shot at an index of the cut.
local function frame_at(shot, index)
  local place = math.floor((index - shot.start) * shot.speed + SMALL)
  return shot.film:at(math.min(shot.from + place, shot.to))
end

--- The segment that an index is in.
local function segment_at(segments, index)
  return segments[ordered.last(segments, index, "from")]
end

local cut_fields = { "parts", title = "string", sound = "any", marks = "any" }

local function new(_, parts)
  fields.check("cut", parts, cut_fields)
  local given = {}
  for i = 1, rawlen(parts) do given[#given + 1] = parts[i] or nil end
  local shots, segments, count = lay_out(given)
  local size = shots[1].film.size
  return celspan.film {
    size = size, fps = shots[1].film.fps, frames = count, title = parts.title,
    sound = sounds_of(shots, parts.sound), marks = marks_of(shots, parts.marks),
    frame = function(f)
      local segment = segment_at(segments, f.index)
      if not segment.between then return frame_at(segment.a, f.index) end
      local u = (f.index - segment.from + 0.5) / segment.count
      return join(segment.between, segment.a and frame_at(segment.a, f.index),
        segment.b and frame_at(segment.b, f.index), u, size)
    end,
  }
end

-- ---------------------------------------------------------------- other times

--- Adds the sound of the keys from i to i + 1, which begins at `at`, where it goes forwards evenly.
local function add_piece(list, film, key, after, at)
  local seconds, frames = after.time - key.time, after.value - key.value
  local speed = seconds > 0 and frames / film.fps / seconds or 0
  if after.ease or speed < 0.01 or speed > 100 then return end
  list[#list + 1] = { film, at = at, from = (key.value - film.first) / film.fps,
                      to = (after.value - film.first) / film.fps, speed = speed }
end

--- The sound of a film at other times. Where it is held, reversed or eased, it is silent.
local function retimed_sound(film, track, duration)
  if #list_of(film.sound) == 0 then return nil end
  local list, first, last = {}, track.keys[1].time, track.keys[#track.keys].time
  local turns = track.loop and last > first and math.ceil((duration - first) / (last - first)) or 1
  if turns * #track.keys > MOST_PIECES then
    core.refuse(("cut: retime: the sound has more than %d pieces, which is the limit: give the "
      .. "film no sound, film:with{ sound = {} }"):format(MOST_PIECES))
  end
  for turn = 0, turns - 1 do
    for i = 1, track.loop == "mirror" and turn % 2 == 1 and 0 or #track.keys - 1 do
      local key = track.keys[i]
      add_piece(list, film, key, track.keys[i + 1], key.time + turn * (last - first))
    end
  end
  return list
end

--- The marks of a film, where their frames are reached first.
local function retimed_marks(film, count, number_at)
  local marks = {}
  for name, frame in pairs(film.marks or {}) do
    local before = number_at(0)
    for index = 0, count - 1 do
      local number = number_at(index)
      if math.min(before, number) <= frame and frame <= math.max(before, number) then
        marks[name] = index + 1
        break
      end
      before = number
    end
  end
  return next(marks) ~= nil and marks or nil
end

local function check_keys(film, track)
  local last = film.first + film.frames
  for i, key in ipairs(track.keys) do
    if type(key.value) ~= "number" or key.value < film.first or key.value > last then
      core.refuse(("cut: retime: key %d must be a frame of the film, %d to %d, got %s"):format(i,
        film.first, last, fields.shown(key.value)))
    end
  end
end

--- The film at other times: { { seconds of the new film, frame of the old one [, ease] }, ... }, as
--- for celspan.keys. Between the keys frames are passed evenly; the same frame twice holds, and an
--- earlier one reverses. A key may be one frame after the last: the end. loop = "repeat" or
--- "mirror" needs a duration.
---@param film celspan.film
---@param list table|celspan.keys.track
---@param duration? number Seconds; default: the time of the last key
---@return celspan.film
function cut.retime(film, list, duration)
  if not is_film(film) then core.refuse("cut: retime takes a film, got " .. fields.kind(film)) end
  local is_track = type(list) == "table" and type(rawget(list, "keys")) == "table"
  local track = is_track and list or keys(list)
  check_keys(film, track)
  if duration == nil and track.loop then
    core.refuse("cut: retime: keys with a loop need a duration, cut.retime(film, keys, 10)")
  end
  duration = duration == nil and track.keys[#track.keys].time or duration
  if not fields.is_finite(duration) or duration <= 0 then
    core.refuse("cut: retime: the duration must be above 0 seconds, got " .. fields.shown(duration))
  end
  local last = film.first + film.frames - 1
  local function number_at(index)
    local number = math.floor(track:at(index / film.fps) + SMALL)
    return math.max(film.first, math.min(last, number))
  end
  local count = math.max(1, math.floor(duration * film.fps + 0.5))
  return celspan.film {
    size = film.size, fps = film.fps, frames = count, title = film.title,
    sound = retimed_sound(film, track, duration),
    marks = retimed_marks(film, count, number_at),
    frame = function(f) return film:at(number_at(f.index)) end,
  }
end

---@class celspan.cut.part
---@field film celspan.film
---@field from? integer The number of its first frame
---@field to? integer The number of its last frame
---@field speed? number 0.01 to 100; default 1
---@field name? string A mark at the first frame that shows it

---@class celspan.cut.parts
---@field [integer] celspan.film|celspan.cut.part|celspan.cut.transition
---@field title? string
---@field sound? string|celspan.film.sound|celspan.film.sound[] In addition to the sounds of the films
---@field marks? table<string, integer> In addition to those of the films

---@class celspan.cut
---@overload fun(parts: celspan.cut.parts): celspan.film
return fields.publish("cut", setmetatable(cut, { __call = core.entry(new) }))
