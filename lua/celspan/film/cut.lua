--- Films made of films: shots one after another, with transitions between them.
--
--   return cut{ shot1, cut.dissolve(0.5), { film = shot2, from = 10, to = 60, name = "chase" } }
--
-- A frame of the new film is a frame of one shot, or a transition between those of two. Only these
-- frames are built. Nothing else of a shot is known here, so its lips, sheets and cameras move with
-- it; its sounds, captions and marks are moved by name.
--
--   shot 1   |==================|               start 0, count 20
--   shot 2                 |=======...          start 20 - n: n frames of a transition
local carried = require "celspan.carried"
local celspan = require "celspan"
local native = require "celspan.native"
local ease = require "celspan.ease"
local edges = require "celspan.edges"
local edits = require "celspan.edits"
local fields = require "celspan.fields"
local keys = require "celspan.keys"
local ordered = require "celspan.ordered"
local shots_of = require "celspan.shots"

local cut = {}

--- The result of a frame function, or of the function of cut.with, as a list of { rostrum, weight
--- }.
local function exposures_of(result)
  local list = native.exposures("cut: what a transition shows", result)
  for i, exposure in ipairs(list) do
    local weight = exposure[2]
    fields.expect(fields.is_finite(weight) and weight >= 0, weight,
      "cut: exposure %d: its weight must be a finite number of 0 or more", i)
  end
  return list
end

--- Adds the exposures of a result, with their weights multiplied by `weight`. Exposures without
--- weight are left out, because they show nothing.
local function expose(list, result, weight)
  for _, exposure in ipairs(exposures_of(result)) do
    if exposure[2] * weight > 0 then
      list[#list + 1] = { exposure[1], exposure[2] * weight }
    end
  end
end

-- ---------------------------------------------------------------- transitions

---@class celspan.cut.transition
---@field seconds number
---@field about table Its noun and settings, for edit lists
local Transition = fields.class("celspan.cut.transition", "a transition",
  { parts = true, ease = true })

--- A transition has `parts(a, b, u, size, step)`, which returns the exposures for two rostrums. One
--- rostrum may be nil at an end of the film. step: the change of u from frame to frame. settings:
--- what the noun was called with.
local function transition(noun, seconds, curve, parts, settings)
  fields.expect(fields.is_finite(seconds) and seconds > 0, seconds,
    "cut: %s takes seconds, a number above 0", noun)
  local good, eased = pcall(ease, curve or "linear")
  if not good then native.refuse(("cut: %s: %s"):format(noun, eased)) end
  local about = { noun = noun, ease = type(curve) == "string" and curve or nil }
  for name, value in pairs(settings or {}) do about[name] = value end
  local made = { seconds = seconds, noun = noun, ease = eased, parts = parts, about = about }
  return setmetatable(made, Transition)
end

--- Exposures of two shots with their shares; a shot may be nil.
local function shared(first, first_share, second, second_share)
  local list = {}
  if first then list[1] = { first, first_share } end
  if second then list[#list + 1] = { second, second_share } end
  return list
end

--- One shot gradually becomes the other.
---@param seconds number
---@param curve? celspan.ease
---@return celspan.cut.transition
function cut.dissolve(seconds, curve)
  return transition("dissolve", seconds, curve, function(a, b, u)
    return shared(a, 1 - u, b, u)
  end)
end

--- The first shot fades to a colour, then the colour fades to the second shot. They are mixed in
--- codes, so that the steps from frame to frame are even to the eye. At the beginning or end of a
--- film there is only one shot, and only the half of the transition with this shot is seen.
---@param seconds number
---@param colour? celspan.surface Default black
---@param curve? celspan.ease
---@return celspan.cut.transition
function cut.fade(seconds, colour, curve)
  local texture = colour == nil and "#000" or colour
  local good, message = pcall(celspan.rect, { 0, 0, 1, 1, texture = texture })
  if not good then
    native.refuse("cut: fade: the colour: " .. tostring(message):gsub("^.-rect: ", ""))
  end
  return transition("fade", seconds, curve, function(a, b, u, size, step)
    if not a then u = 0.5 + u / 2 elseif not b then u = u / 2 end
    if not (a and b) then step = step / 2 end
    local shot, share = a, 1 - 2 * u - step
    if u >= 0.5 then shot, share = b, 2 * u - 1 - step end
    local ground = celspan.rect { 0, 0, size[1], size[2], texture = texture }
    if share <= 0 then return celspan.rostrum { celspan.cel { ground } } end
    return celspan.rostrum { antialias = shot.antialias, celspan.cel {
      celspan.group { shot, ground:fade(1 - share), space = "srgb" } } }
  end, { colour = type(colour) == "string" and colour or nil })
end

--- Checks the settings of a transition: named fields and their ranges { least, most }.
local function settings_of(noun, settings, known, ranges)
  settings = fields.check("cut: " .. noun, settings, known)
  for name, range in pairs(ranges) do
    local value = settings[name]
    fields.expect(not value or value >= range[1] and value <= range[2], value,
      "cut: %s: field '%s' must be %s..%s", noun, name, fields.shown(range[1]),
      fields.shown(range[2]))
  end
  return settings
end

--- An edge moves over the first shot; the second shot is behind the edge. angle: the direction of
--- the edge in degrees, 0 from left to right, clockwise; softness: the width of the edge, as a
--- share of its way.
---@param settings? { angle?: number, softness?: number }
---@return fun(seconds: number, curve?: celspan.ease): celspan.cut.transition
function cut.wipe(settings)
  settings = settings or {}
  settings_of("wipe", settings, { angle = "number", softness = "number" },
    { softness = { 0, 1 } })
  local angle, softness = math.rad((settings.angle or 0) % 360), settings.softness or 0
  local cos, sin = math.cos(angle), math.sin(angle)
  return function(seconds, curve)
    return transition("wipe", seconds, curve, function(a, b, u, size)
      local low, high = edges.wipe(cos, sin, softness, u, size)
      return edges.together(a, b, a and edges.beside(a, cos, sin, low, high, size, false),
        b and edges.beside(b, cos, sin, low, high, size, true))
    end, settings)
  end
end

--- The second shot is seen in a circle that grows. centre: default the middle of the film;
--- softness: the width of the edge, as a share of the greatest radius.
---@param settings? { centre?: celspan.point, softness?: number }
---@return fun(seconds: number, curve?: celspan.ease): celspan.cut.transition
function cut.iris(settings)
  settings = settings_of("iris", settings or {}, { centre = "table", softness = "number" },
    { softness = { 0, 1 } })
  if settings.centre then
    fields.numbers("cut", "iris: centre[%d]", settings.centre, 2, "a point {x, y}")
  end
  local given = settings.centre and { settings.centre[1], settings.centre[2] }
  local softness = settings.softness or 0
  return function(seconds, curve)
    return transition("iris", seconds, curve, function(a, b, u, size)
      local centre = given or { size[1] / 2, size[2] / 2 }
      local low, high = edges.iris(centre, softness, u, size)
      return edges.together(a, b, a and edges.around(a, centre, low, high, size, false),
        b and edges.around(b, centre, low, high, size, true))
    end, settings)
  end
end

local SIDES = { right = { 1, 0 }, left = { -1, 0 }, top = { 0, -1 }, bottom = { 0, 1 } }

--- The second shot pushes the first one out of the frame.
---@param settings? { from?: "right"|"left"|"top"|"bottom" }
---@return fun(seconds: number, curve?: celspan.ease): celspan.cut.transition
function cut.push(settings)
  settings = settings or {}
  settings_of("push", settings, { from = "string" }, {})
  local from = settings.from or "right"
  local side = SIDES[from]
  if not side then
    native.refuse(('cut: push: field \'from\' must be "right", "left", "top" or "bottom", got "%s"')
      :format(from))
  end
  local function moved(shot, share, size)
    return shot and shot:translate(side[1] * share * size[1], side[2] * share * size[2])
  end
  return function(seconds, curve)
    return transition("push", seconds, curve, function(a, b, u, size)
      return edges.together(a, b, moved(a, -u, size), moved(b, 1 - u, size))
    end, settings)
  end
end

--- A transition that the script defines.
---@param make fun(a: celspan.rostrum, b: celspan.rostrum, u: number): celspan.exposures
---@return fun(seconds: number, curve?: celspan.ease): celspan.cut.transition
function cut.with(make)
  fields.takes("cut: with", "function", "a function(a, b, u)", make)
  return function(seconds, curve)
    return transition("with", seconds, curve, function(a, b, u, size)
      local nothing = celspan.rostrum { size = size }
      return make(a or nothing, b or nothing, u)
    end)
  end
end

--- The exposures of a frame of a transition. a, b: results of frame functions, nil at an end of the
--- film.
local function join(between, a, b, u, step, size)
  local nothing = { { nil, 1 } }
  local first, second = a and exposures_of(a) or nothing, b and exposures_of(b) or nothing
  local list, eased = {}, between.ease(u)
  if not fields.is_finite(eased) then
    native.refuse(("cut: %s: its ease must return a finite number, but at %.6g it returned %s")
      :format(between.noun, u, fields.shown(eased)))
  end
  u = math.max(0, math.min(1, eased))
  for _, side in ipairs { first, second } do
    for _, exposure in ipairs(side) do
      exposure[1] = exposure[1] and exposure[1]:with { size = size }
    end
  end
  for _, one in ipairs(first) do
    for _, other in ipairs(second) do
      expose(list, between.parts(one[1], other[1], u, size, step),
        one[2] * other[2])
    end
  end
  return list
end

-- ---------------------------------------------------------------- parts

local part_fields = { film = "userdata", from = "number", to = "number", speed = "number",
  name = "string" }

local function complain(i, text, ...)
  native.refuse(("cut: part %d: "):format(i) .. text:format(...))
end

local function check_frame(i, part, name, film)
  local frame, last = part[name], film.first + film.frames - 1
  if frame and (frame ~= math.floor(frame) or frame < film.first or frame > last) then
    complain(i, "field '%s' must be a frame of the film, %d to %d, got %s", name, film.first, last,
      fields.shown(frame))
  end
end

local function read_shot(i, part, like)
  if carried.is_film(part) then part = { film = part } end
  fields.expect_kind(type(part) == "table", part,
    "cut: part %d: must be a film, { film = ... } or a transition", i)
  if carried.is_film(part[1]) then
    complain(i, "its film is the field 'film': { film = ..., from = ... }")
  end
  fields.check(("cut: part %d"):format(i), part, part_fields)
  local film = part.film
  fields.expect_kind(carried.is_film(film), film, "cut: part %d: field 'film' must be a film", i)
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
    local own, wanted = fields.shown(film.fps), fields.shown(like.fps)
    complain(i, "its fps is %s, and that of the first film %s: film:with { fps = %s }", own, wanted,
      wanted)
  end
  if film.size[1] ~= like.size[1] or film.size[2] ~= like.size[2] then
    complain(i, "its size is %dx%d, and that of the first film %dx%d", film.size[1], film.size[2],
      like.size[1], like.size[2])
  end
  if film.space ~= like.space then
    local own, wanted = film.space or "linear", like.space or "linear"
    complain(i, "its space is %q, and that of the first film %q: film:with { space = %q }", own,
      wanted, wanted)
  end
  local count = math.max(1, math.ceil((to - from + 1) / speed - carried.SMALL))
  return { place = i, film = film, from = from, to = to, speed = speed, name = part.name,
           count = count, before = 0, after = 0 }
end

--- Puts a transition over the two shots beside it; at an end of the film one of them is nil.
local function overlap(place, between, a, b, fps)
  local count = math.max(1, math.floor(between.seconds * fps + 0.5))
  if a then a.after = count end
  if b then b.before = count end
  for _, shot in ipairs { a or b, b or a } do
    if shot.before + shot.after > shot.count then
      complain(shot.place, "the shot has %d frames, and its transitions need %.14g: give it more "
        .. "frames, or make part %d shorter", shot.count, shot.before + shot.after, place)
    end
  end
  return count
end

local function check_names(shots)
  local names = {}
  for _, shot in ipairs(shots) do
    local known = shot.name and names[shot.name]
    if known then complain(shot.place, "has the name of part %d, %q", known, shot.name) end
    names[shot.name or false] = shot.place
  end
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
  if not last then native.refuse "cut: needs at least one film" end
  if pending then
    local count = overlap(pending.place, pending.between, last, nil, last.film.fps)
    add_segment { from = start - count, a = last, between = pending.between, count = count }
  end
  for _, shot in ipairs(shots) do
    add_segment { from = shot.start + shot.before, a = shot,
                  count = shot.count - shot.before - shot.after }
  end
  check_names(shots)
  table.sort(segments, function(one, other) return one.from < other.from end)
  return shots, segments, start
end

-- ---------------------------------------------------------------- films of films

--- The frame of a shot at an index of the cut. A failure names the shot after its frame.
local function frame_at(shot, index)
  local place = math.floor((index - shot.start) * shot.speed + carried.SMALL)
  local good, result = pcall(shot.film.at, shot.film, math.min(shot.from + place, shot.to))
  if good then return shots_of.marked(result, shot) end
  local name = shot.name and shot.name:gsub("%%", "%%%%")
  error(name and type(result) == "string"
    and result:gsub("frame (%d+): ", "frame %1 of '" .. name .. "': ", 1) or result, 0)
end

--- The segment that an index is in.
local function segment_at(segments, index)
  return segments[ordered.last(segments, index, "from")]
end

--- The exposures with cels over them: one, or a list of them.
local function lay_over(exposures, cels, f, size)
  local list, total = {}, 0
  cels = native.cels("cut: over", cels)
  for i, exposure in ipairs(exposures_of(exposures)) do
    local shot = exposure[1]
    total = total + exposure[2]
    list[i] = { celspan.rostrum { antialias = shot.antialias,
      celspan.cel { shot:with { size = size } }, table.unpack(cels) }, exposure[2] }
  end
  if #cels > 0 and math.abs(total - 1) > 1e-6 then
    native.refuse(("cut: over: frame %d is exposed with a weight of %g in all; it must be 1 (shots "
      .. "of different antialiasing are exposed each in a wipe, iris or push)"):format(f.number,
      total))
  end
  return list
end

--- The frame function of the cut without the pictures over it.
local function frames_of(segments, size)
  return function(f)
    local segment = segment_at(segments, f.index)
    local lone = segment.between and shots_of.lone(segment.a, segment.b)
    if lone or not segment.between then return frame_at(lone or segment.a, f.index) end
    local u = (f.index - segment.from + 0.5) / segment.count
    return join(segment.between, segment.a and frame_at(segment.a, f.index),
      segment.b and frame_at(segment.b, f.index), u, 1 / segment.count, size)
  end
end

local cut_fields = { "parts", title = "string", sound = "any", marks = "any", captions = "any",
                     over = "function" }

local function new(_, parts)
  fields.check("cut", parts, cut_fields)
  local given = {}
  for i = 1, rawlen(parts) do given[#given + 1] = parts[i] or nil end
  local shots, segments, count = lay_out(given)
  local size, over, pieces = shots[1].film.size, parts.over, {}
  for i, shot in ipairs(shots) do pieces[i] = carried.piece_of(shot) end
  local show = frames_of(segments, size)
  return shots_of.keep(celspan.film {
    size = size, fps = shots[1].film.fps, frames = count, title = parts.title,
    space = shots[1].film.space, sound = carried.sounds_of(shots, parts.sound),
    marks = carried.marks_of(shots, parts.marks),
    captions = carried.captions_of(pieces, parts.captions),
    frame = over and function(f) return lay_over(show(f), over(f), f, size) end or show,
  }, shots, segments)
end

-- ---------------------------------------------------------------- other times

local function check_keys(film, track)
  local last = film.first + film.frames
  for i, key in ipairs(track.keys) do
    if type(key.value) ~= "number" or key.value < film.first or key.value > last then
      native.refuse(("cut: retime: key %d must be a frame of the film, %d to %d, got %s"):format(i,
        film.first, last, fields.shown(key.value)))
    end
  end
end

--- The film at other times. The keys are { seconds of the new film, frame of the old film [, ease]
--- }, as for celspan.keys. Frames pass evenly between two keys. Two keys with the same frame hold
--- the frame, and a key with an earlier frame reverses the film. A key may name the frame after the
--- last one, which is the end. loop = "repeat" or "mirror" needs a duration.
---@param film celspan.film
---@param list table|celspan.keys.track
---@param duration? number Seconds; default: the time of the last key
---@return celspan.film
function cut.retime(film, list, duration)
  fields.expect_kind(carried.is_film(film), film, "cut: retime takes a film")
  local is_track = type(list) == "table" and type(rawget(list, "keys")) == "table"
  local track = is_track and list or keys(list)
  check_keys(film, track)
  if duration == nil and track.loop then
    native.refuse("cut: retime: keys with a loop need a duration, cut.retime(film, keys, 10)")
  end
  duration = duration == nil and track.keys[#track.keys].time or duration
  fields.expect(fields.is_finite(duration) and duration > 0, duration,
    "cut: retime: the duration must be above 0 seconds")
  local last = film.first + film.frames - 1
  local function number_at(index)
    local number = math.floor(track:at(index / film.fps) + carried.SMALL)
    return math.max(film.first, math.min(last, number))
  end
  local count = math.max(1, math.floor(duration * film.fps + 0.5))
  local pieces = carried.pieces_of(film, track, duration)
  return celspan.film {
    size = film.size, fps = film.fps, frames = count, title = film.title, space = film.space,
    sound = #carried.list_of(film.sound) > 0 and pieces or nil,
    captions = carried.captions_of(pieces),
    marks = carried.retimed_marks(film, count, number_at),
    frame = function(f) return film:at(number_at(f.index)) end,
  }
end

-- ---------------------------------------------------------------- edit lists

--- Reads an edit list, .otio or .edl, as a film of films; or the animatic of a .storyboarder.
---@param path string Relative to the caller's file, else to the script
---@param films? table<string, celspan.film> By the names of clips, files or reels
---@return celspan.film? film
---@return celspan.cut.shots|string shots In the order of the film; or a message
function cut.read(path, films) return edits.read(cut, path, films) end

---@class celspan.cut.shots
---@field [integer] celspan.cut.shot
---@field skipped string[] Sentences about what the film does not show as the file says

---@class celspan.cut.shot
---@field name string
---@field from number Seconds of the film; counted
---@field to number Not counted
---@field source { from: number, to: number } Seconds of its own film

---@class celspan.cut.part
---@field film celspan.film
---@field from? integer The number of its first frame
---@field to? integer The number of its last frame
---@field speed? number 0.01 to 100; default 1
---@field name? string A mark of the frames that show it

---@class celspan.cut.parts
---@field [integer] celspan.film|celspan.cut.part|celspan.cut.transition
---@field title? string
---@field sound? string|celspan.film.sound|celspan.film.sound[] In addition to the sounds of the films
---@field marks? table<string, integer|integer[]> In addition to those of the films
---@field captions? string|celspan.captions In addition to those of the films
---@field over? fun(f: celspan.film.frame): celspan.shown|nil What is over all shots

---@class celspan.cut
---@overload fun(parts: celspan.cut.parts): celspan.film
return fields.publish("cut", setmetatable(cut, { __call = native.entry(new) }))
