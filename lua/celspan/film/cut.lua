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
--
-- One file, because a transition is little more than its two halves, and needs the cut around it.
local captions = require "celspan.captions"
local celspan = require "celspan"
local core = require "celspan.core"
local ease = require "celspan.ease"
local fields = require "celspan.fields"
local keys = require "celspan.keys"
local ordered = require "celspan.ordered"
local shots_of = require "celspan.shots"
local subtitles = require "celspan.subtitles"

local cut = {}

local SMALL = 1e-9 -- a share of a frame: 3 frames at 0.1 of the speed are 30 frames, not 31
local MOST_PIECES = 10000 -- the most pieces of a sound that is retimed

-- ---------------------------------------------------------------- films

local film_metatable = getmetatable(celspan.film { frame = function() end })
local rostrum_metatable = getmetatable(celspan.rostrum {})

local function is_film(value) return getmetatable(value) == film_metatable and
  fields.kind(value) == "a film" end

--- The weight of an exposure, checked in the same way as by the film.
local function weight_of(i, exposure)
  if type(exposure) ~= "table" then
    core.refuse(("cut: exposure %d must be {rostrum, weight}, got %s"):format(i,
      fields.kind(exposure)))
  end
  if getmetatable(exposure[1]) ~= rostrum_metatable then
    core.refuse(("cut: exposure %d must show a rostrum, got %s"):format(i,
      fields.kind(exposure[1])))
  end
  local weight = exposure[2] == nil and 1 or exposure[2]
  if not fields.is_finite(weight) or weight < 0 then
    core.refuse(("cut: exposure %d: its weight must be a finite number of 0 or more, got %s")
      :format(i, fields.shown(weight)))
  end
  return weight
end

--- The result of a frame function, or of the function of cut.with, as a list of { rostrum, weight
--- }.
local function exposures_of(result)
  if type(result) ~= "table" then result = { { result } } end
  local list = {}
  for i, exposure in ipairs(result) do list[i] = { exposure[1], weight_of(i, exposure) } end
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
local Transition = {}
Transition.__index = fields.reads("a transition", Transition,
  { parts = true, ease = true })
Transition.__name = "celspan.cut.transition"

--- A transition has `parts(a, b, u, size, step)`, which returns the exposures for two rostrums. One
--- rostrum may be nil at an end of the film. step: the change of u from frame to frame.
local function transition(noun, seconds, curve, parts)
  if not fields.is_finite(seconds) or seconds <= 0 then
    core.refuse(("cut: %s takes seconds, a number above 0, got %s"):format(noun,
      fields.shown(seconds)))
  end
  local good, eased = pcall(ease, curve or "linear")
  if not good then core.refuse(("cut: %s: %s"):format(noun, eased)) end
  return setmetatable({ seconds = seconds, noun = noun, ease = eased, parts = parts }, Transition)
end

--- Exposures of two shots with their shares; a shot may be nil.
local function shared(first, first_share, second, second_share)
  local list = {}
  if first then list[1] = { first, first_share } end
  if second then list[#list + 1] = { second, second_share } end
  return list
end

--- The exposures of the visible parts of two shots; one shot may be nil. The light of the parts
--- adds up, so one exposure is enough, but shots with different antialiasing need one exposure
--- each.
local function together(a, b, seen_of_a, seen_of_b)
  local function show(shot, art)
    return { celspan.rostrum { antialias = shot.antialias, celspan.cel { art } }, 1 }
  end
  if not (a and b) then return { show(a or b, seen_of_a or seen_of_b) } end
  if a.antialias ~= b.antialias then return { show(a, seen_of_a), show(b, seen_of_b) } end
  return { show(a, celspan.group { seen_of_a, seen_of_b:blend "add", isolate = true }) }
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
    core.refuse("cut: fade: the colour: " .. tostring(message):gsub("^.-rect: ", ""))
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
  end)
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

--- White with this alpha: the share of a shot that is visible at a place.
local function seen(share) return celspan.rgb("#fff", share) end

--- A shot that is visible where a texture is opaque. The texture covers the whole frame, so both
--- shots have the same edges and add up to one.
local function softly(shot, size, shade)
  return celspan.matte(shot, celspan.rect { 0, 0, size[1], size[2], texture = shade })
end

--- The area of the plane on one side of a line: where x cos + y sin is at most `place`, or at least
--- `place` if the sign is -1. reach: longer than the frame's diagonal.
local function half_plane(cos, sin, place, sign, reach)
  local x, y = cos * place, sin * place
  local dx, dy, far = -sin * reach, cos * reach, sign * reach
  return celspan.polygon { { x + dx, y + dy }, { x - dx, y - dy },
    { x - dx - cos * far, y - dy - sin * far }, { x + dx - cos * far, y + dy - sin * far } }
end

--- The places `low` and `high` between which the edge of a wipe lies. Up to `low` only shot b is
--- visible, and from `high` on only shot a.
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
  local function side(shot, u, size, is_second)
    local low, high = wipe_edge(cos, sin, softness, u, size)
    if high <= low then
      local reach = 4 * (size[1] + size[2])
      return celspan.clip(shot, half_plane(cos, sin, low, is_second and 1 or -1, reach))
    end
    return softly(shot, size, celspan.linear {
      from = { cos * low, sin * low }, to = { cos * high, sin * high },
      { 0, seen(is_second and 1 or 0) }, { 1, seen(is_second and 0 or 1) } })
  end
  return function(seconds, curve)
    return transition("wipe", seconds, curve, function(a, b, u, size)
      return together(a, b, a and side(a, u, size, false), b and side(b, u, size, true))
    end)
  end
end

--- The radii of the edge of an iris, in the form of wipe_edge.
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

--- How much of one of the shots is visible around a soft circle.
local function iris_shade(centre, low, high, is_second)
  local inner = math.min(1, high / (high - low))
  local function shade(share) return seen(is_second and share or 1 - share) end
  return celspan.radial { centre = centre, radius = high, { 0, shade(inner) },
    { math.max(0, low) / high, shade(inner) }, { 1, shade(0) } }
end

--- The second shot is seen in a circle that grows. centre: default the middle of the film;
--- softness: the width of the edge, as a share of the greatest radius.
---@param settings? { centre?: celspan.point, softness?: number }
---@return fun(seconds: number, curve?: celspan.ease): celspan.cut.transition
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
    local disc = celspan.circle { centre = centre, radius = high }
    if softness > 0 then
      return softly(shot, size, iris_shade(centre, low, high, is_second))
    end
    return is_second and celspan.clip(shot, disc) or celspan.difference { shot, disc }
  end
  return function(seconds, curve)
    return transition("iris", seconds, curve, function(a, b, u, size)
      return together(a, b, a and side(a, u, size, false), b and side(b, u, size, true))
    end)
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
    core.refuse(('cut: push: field \'from\' must be "right", "left", "top" or "bottom", got "%s"')
      :format(from))
  end
  local function moved(shot, share, size)
    return shot and shot:translate(side[1] * share * size[1], side[2] * share * size[2])
  end
  return function(seconds, curve)
    return transition("push", seconds, curve, function(a, b, u, size)
      return together(a, b, moved(a, -u, size), moved(b, 1 - u, size))
    end)
  end
end

--- A transition that the script defines.
---@param make fun(a: celspan.rostrum, b: celspan.rostrum, u: number): celspan.exposures
---@return fun(seconds: number, curve?: celspan.ease): celspan.cut.transition
function cut.with(make)
  if type(make) ~= "function" then
    core.refuse("cut: with takes a function(a, b, u), got " .. fields.kind(make))
  end
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
    core.refuse(("cut: %s: its ease must return a finite number, but at %.6g it returned %s")
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
  if is_film(part[1]) then
    complain(i, "its film is the field 'film': { film = ..., from = ... }")
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
  local count = math.max(1, math.ceil((to - from + 1) / speed - SMALL))
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

-- ---------------------------------------------------------------- sounds, captions, marks

--- The sound of a film as a list.
local function list_of(sound)
  if sound == nil then return {} end
  if type(sound) == "string" or type(sound) == "table" and
    (type(sound[1]) == "string" or is_film(sound[1])) then
    return { sound }
  end
  return sound
end

--- The piece of a film that a shot shows, as a sound. It fades in and out with the pictures.
local function piece_of(shot)
  local film, fps = shot.film, shot.film.fps
  return { film, at = shot.start / fps, from = (shot.from - film.first) / fps,
           to = (shot.to - film.first + 1) / fps, speed = shot.speed, name = shot.name,
           fade = { shot.before / fps, shot.after / fps } }
end

--- The sounds of the shots and the sounds of the cut.
local function sounds_of(shots, own)
  local sounds = {}
  for _, shot in ipairs(shots) do
    if #list_of(shot.film.sound) > 0 then sounds[#sounds + 1] = piece_of(shot) end
  end
  if type(own) ~= "nil" and type(own) ~= "string" and type(own) ~= "table" then return own end
  local list = list_of(own)
  for i = 1, #list do sounds[#sounds + 1] = list[i] end
  return #sounds > 0 and sounds or nil
end

--- Adds the captions of a piece. known: the captions of films that were read before.
local function add_captions(list, piece, known)
  local film = piece[1]
  known[film] = known[film] or subtitles.list(film)
  for _, one in ipairs(known[film]) do
    local from, to = math.max(one.from, piece.from), math.min(one.to, piece.to)
    if from < to then
      list[#list + 1] = { from = piece.at + (from - piece.from) / piece.speed,
                          to = piece.at + (to - piece.from) / piece.speed, text = one.text }
    end
  end
end

--- The captions of pieces of films, and those of the cut. If no piece has any, the film itself
--- reads the file of the cut.
local function captions_of(pieces, own)
  local list, known = {}, {}
  for _, piece in ipairs(pieces) do add_captions(list, piece, known) end
  if own == nil then return #list > 0 and list or nil end
  if #list == 0 or type(own) ~= "table" and type(own) ~= "string" then return own end
  if type(own) == "string" then
    local read, message = captions.read(own)
    own = read or core.refuse("cut: captions: " .. message)
  end
  return table.move(own, 1, #own, #list + 1, list)
end

--- The first frame of a mark, and its last one, if it has one.
local function range_of(mark)
  if type(mark) == "table" then return mark[1], mark[2] end
  return mark
end

--- Adds the marks of a shot, if its part of the film shows their frames.
local function add_marks(shot, marks)
  local function place_of(frame)
    return shot.start + math.ceil((frame - shot.from) / shot.speed - SMALL) + 1
  end
  for name, mark in pairs(shot.film.marks or {}) do
    local frame, last = range_of(mark)
    local place, known = place_of(frame), range_of(marks[name])
    if frame >= shot.from and frame <= shot.to and place <= shot.start + shot.count
      and not (known and known <= place) then
      marks[name] = last and { place, math.max(place,
        math.min(place_of(last + 1) - 1, shot.start + shot.count)) } or place
    end
  end
end

--- The marks of the shots, then the names of the parts, then the marks of the cut.
local function marks_of(shots, own)
  local marks, names = {}, {}
  for _, shot in ipairs(shots) do add_marks(shot, marks) end
  for _, shot in ipairs(shots) do
    if shot.name and names[shot.name] then
      complain(shot.place, "has the name of part %d, %q", names[shot.name], shot.name)
    end
    if shot.name then
      marks[shot.name], names[shot.name] = { shot.start + 1, shot.start + shot.count }, shot.place
    end
  end
  if own ~= nil and type(own) ~= "table" then return own end
  for name, frame in pairs(own or {}) do marks[name] = frame end
  return next(marks) ~= nil and marks or nil
end

-- ---------------------------------------------------------------- films of films

--- The frame of a shot at an index of the cut. A failure names the shot after its frame.
local function frame_at(shot, index)
  local place = math.floor((index - shot.start) * shot.speed + SMALL)
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
  if type(cels) ~= "table" then cels = { cels } end
  for i, exposure in ipairs(exposures_of(exposures)) do
    local shot = exposure[1]
    total = total + exposure[2]
    list[i] = { celspan.rostrum { antialias = shot.antialias,
      celspan.cel { shot:with { size = size } }, table.unpack(cels) }, exposure[2] }
  end
  if #cels > 0 and math.abs(total - 1) > 1e-6 then
    core.refuse(("cut: over: frame %d is exposed with a weight of %g in all; it must be 1 (shots "
      .. "of different antialiasing are exposed each in a wipe, iris or push)"):format(f.number,
      total))
  end
  return list
end

--- The frame function of the cut without the pictures over it.
local function frames_of(segments, size)
  return function(f)
    local segment = segment_at(segments, f.index)
    if not segment.between then return frame_at(segment.a, f.index) end
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
  for i, shot in ipairs(shots) do pieces[i] = piece_of(shot) end
  local show = frames_of(segments, size)
  return shots_of.keep(celspan.film {
    size = size, fps = shots[1].film.fps, frames = count, title = parts.title,
    space = shots[1].film.space, sound = sounds_of(shots, parts.sound),
    marks = marks_of(shots, parts.marks), captions = captions_of(pieces, parts.captions),
    frame = over and function(f) return lay_over(show(f), over(f), f, size) end or show,
  }, shots, segments)
end

-- ---------------------------------------------------------------- other times

--- Adds the piece between the keys `key` and `after`, if the film runs forwards at an even speed
--- between them. It begins at `at`.
local function add_piece(list, film, key, after, at)
  local seconds, frames = after.time - key.time, after.value - key.value
  local speed = seconds > 0 and frames / film.fps / seconds or 0
  if after.ease or speed < 0.01 or speed > 100 then return end
  list[#list + 1] = { film, at = at, from = (key.value - film.first) / film.fps,
                      to = (after.value - film.first) / film.fps, speed = speed }
end

--- The pieces of a film with new times that are heard and have captions: where the film is held,
--- reversed or eased, there are none.
local function pieces_of(film, track, duration)
  if #list_of(film.sound) == 0 and film.captions == nil then return {} end
  local list, first, last = {}, track.keys[1].time, track.keys[#track.keys].time
  local turns = track.loop and last > first and math.ceil((duration - first) / (last - first)) or 1
  if turns * #track.keys > MOST_PIECES then
    core.refuse(("cut: retime: the sound or the captions have more than %d pieces, which is the "
      .. "limit: give the film none, film:with{ sound = {}, captions = {} }"):format(MOST_PIECES))
  end
  for turn = 0, turns - 1 do
    for i = 1, track.loop == "mirror" and turn % 2 == 1 and 0 or #track.keys - 1 do
      local key = track.keys[i]
      add_piece(list, film, key, track.keys[i + 1], key.time + turn * (last - first))
    end
  end
  return list
end

--- The marks of a film, at the times when their frames are first reached.
local function retimed_marks(film, count, number_at)
  local marks = {}
  for name, mark in pairs(film.marks or {}) do
    local before, frame = number_at(0), range_of(mark)
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

--- The film at other times. The keys are { seconds of the new film, frame of the old film [, ease]
--- }, as for celspan.keys. Frames pass evenly between two keys. Two keys with the same frame hold
--- the frame, and a key with an earlier frame reverses the film. A key may name the frame after the
--- last one, which is the end. loop = "repeat" or "mirror" needs a duration.
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
  local pieces = pieces_of(film, track, duration)
  return celspan.film {
    size = film.size, fps = film.fps, frames = count, title = film.title, space = film.space,
    sound = #list_of(film.sound) > 0 and pieces or nil, captions = captions_of(pieces),
    marks = retimed_marks(film, count, number_at),
    frame = function(f) return film:at(number_at(f.index)) end,
  }
end

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
---@field over? fun(f: celspan.film.frame): celspan.cel|celspan.cel[]|nil What is over all shots

---@class celspan.cut
---@overload fun(parts: celspan.cut.parts): celspan.film
return fields.publish("cut", setmetatable(cut, { __call = core.entry(new) }))
