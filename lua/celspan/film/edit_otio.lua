--- Edits as OpenTimelineIO: JSON objects, each with the name and the version of its schema.
--
--   celspan     a |=========-----|                  a and b overlap in the n frames of a transition
--               b          |-----========|
--   .otio       a |===========|                     clips touch in its middle; in_offset and
--               b             |==========|          out_offset are how far they reach beyond
--
-- Times are numbers of frames at a rate. A time at another rate than that of the edit, which is the
-- first one of its pictures, is exact until it is rounded to a frame.
local json = require "celspan.json"
local timecode = require "celspan.timecode"
local values = require "celspan.values"

local edit_otio = {}

local MOST_TIME, MOST_RATE = 1e12, 1e6

local fail, skip, number_of = values.fail, values.skip, values.number
local table_of, text_of = values.table, values.text

-- ---------------------------------------------------------------- writing

--- An object of a schema with the members that all have.
local function object(schema, name, members)
  members.OTIO_SCHEMA, members.name, members.metadata = schema, name, members.metadata or {}
  return members
end

local function time(value, rate)
  return { OTIO_SCHEMA = "RationalTime.1", rate = rate + 0.0, value = value + 0.0 }
end

local function range(start, duration, rate)
  return { OTIO_SCHEMA = "TimeRange.1", start_time = time(start, rate),
           duration = time(duration, rate) }
end

--- What has a range, effects and markers.
local function item(schema, name, members)
  members.source_range = members.source_range or json.null
  members.effects = members.effects or { list = {} }
  members.markers, members.enabled = members.markers or { list = {} }, true
  return object(schema, name, members)
end

local function clip(part, start, duration, rate)
  local media = object(part.media and "ExternalReference.1" or "MissingReference.1", "", {
    available_range = part.length and range(0, part.length, rate) or json.null,
    available_image_bounds = json.null, target_url = part.media })
  return item("Clip.2", part.name, { source_range = range(start, duration, rate),
    media_references = { DEFAULT_MEDIA = media }, active_media_reference_key = "DEFAULT_MEDIA",
    effects = part.speed ~= 1 and { object("LinearTimeWarp.1", "",
      { effect_name = "LinearTimeWarp", time_scalar = part.speed + 0.0 }) } or nil })
end

--- The frames of a transition before and after the place where its clips touch.
local function offsets(parts, i)
  local frames = parts[i] and parts[i].frames or 0
  local before = not parts[i - 1] and 0 or not parts[i + 1] and frames or frames // 2
  return before, frames - before
end

local function child_of(parts, i, rate)
  local part, before, after = parts[i], offsets(parts, i)
  if not part.frames then
    local hidden, _, beyond = offsets(parts, i - 1), offsets(parts, i + 1)
    return clip(part, part.from + hidden * part.speed, part.count - hidden - beyond, rate)
  end
  return object("Transition.1", part.about.noun, { metadata = { celspan = part.about },
    transition_type = part.about.noun == "dissolve" and "SMPTE_Dissolve" or "Custom_Transition",
    in_offset = time(before, rate), out_offset = time(after, rate) })
end

local function track(name, kind, children)
  return item("Track.1", name, { kind = kind, children = { list = children } })
end

--- The tracks of sounds, with gaps between these.
local function add_sounds(tracks, edit)
  local lists, ends = {}, {}
  for _, sound in ipairs(edit.sounds) do
    local list, gap = lists[sound.track] or {}, sound.at - (ends[sound.track] or 0)
    if gap > 1e-6 then
      list[#list + 1] = item("Gap.1", "", { source_range = range(0, gap, edit.rate) })
    end
    list[#list + 1] = clip(sound, sound.from, sound.count, edit.rate)
    lists[sound.track], ends[sound.track] = list, sound.at + sound.count
  end
  for i, list in ipairs(lists) do tracks[#tracks + 1] = track("A" .. i, "Audio", list) end
end

--- Numbers that are read back as they are.
local function number_text(value)
  return math.type(value) == "float" and ("%.17g"):format(value):gsub("^%-?%d+$", "%0.0") or nil
end

--- The text of an edit.
function edit_otio.encode(edit)
  local children, markers = {}, {}
  for i = 1, #edit.parts do children[i] = child_of(edit.parts, i, edit.rate) end
  local tracks = { track("V1", "Video", children) }
  add_sounds(tracks, edit)
  for i, mark in ipairs(edit.marks) do
    markers[i] = object("Marker.2", mark.name, { color = "GREEN", comment = "",
      marked_range = range(mark.from, mark.to - mark.from, edit.rate) })
  end
  return json.encode(object("Timeline.1", edit.title, { global_start_time = json.null,
    tracks = item("Stack.1", "tracks", { children = tracks, markers = { list = markers } }) }),
    { plain = true, value = number_text }) .. "\n"
end

-- ---------------------------------------------------------------- reading

--- The name of an object's schema, without the version.
local function schema_of(value)
  local schema = type(value) == "table" and value.OTIO_SCHEMA
  return type(schema) == "string" and schema:match "^[^.]*" or nil
end

--- A time in frames of the edit, not rounded.
local function frames_of(state, value, what, least)
  if schema_of(value) ~= "RationalTime" then fail("%s is no RationalTime", what) end
  local number = number_of(value, what .. ": ", "value", least or -MOST_TIME, MOST_TIME)
  local own = timecode.rate(number_of(value, what .. ": ", "rate", 1e-6, MOST_RATE))
  state.rate = state.rate or own
  return own == state.rate and number or number * state.rate / own
end

--- The start and the duration of a range; nil if there is none.
local function range_of(state, value, what)
  if schema_of(value) ~= "TimeRange" then return nil end
  local duration = frames_of(state, value.duration, what .. ": the duration", 0)
  return frames_of(state, value.start_time, what .. ": the start_time"), duration
end

local function speed_of(state, child, what)
  local speed = 1
  for _, effect in ipairs(table_of(child.effects)) do
    local schema = schema_of(effect)
    if schema == "LinearTimeWarp" or schema == "FreezeFrame" then
      speed = speed * (schema == "FreezeFrame" and 0
        or number_of(effect, what .. ": ", "time_scalar", -100, 100))
    else
      skip(state, "%s: the effect %s is not known", what, schema or "without a schema")
    end
  end
  return speed
end

local function read_clip(state, child, what)
  local media = table_of(table_of(child.media_references)[text_of(child.active_media_reference_key)
    or "DEFAULT_MEDIA"] or child.media_reference)
  local base, whole = range_of(state, media.available_range, what)
  local start, count = range_of(state, child.source_range, what)
  if not (start or base) then fail("%s has neither a source_range nor an available_range", what) end
  if child.enabled == false or schema_of(media) == "GeneratorReference" then
    skip(state, "%s: it is black", what)
    return { count = count or whole }
  end
  local url = text_of(media.target_url)
  url = url and url:gsub("^file://[^/]*", ""):gsub("%%(%x%x)", function(code)
    return string.char(tonumber(code, 16))
  end)
  return { name = text_of(child.name) or url or what, media = url, origin = start or base,
           from = (start or base) - (base or 0), count = count or whole,
           speed = speed_of(state, child, what) }
end

--- An item of a track: a shot, black, or a transition.
local function read_item(state, child, what)
  local schema = schema_of(child)
  if schema == "Clip" then return read_clip(state, child, what) end
  if schema ~= "Transition" then
    local _, count = range_of(state, table_of(child).source_range, what)
    if schema == "Stack" or schema == "Track" then
      skip(state, "%s: what is nested in it is not read: it is black; flatten it", what)
    elseif schema ~= "Gap" then
      skip(state, "%s: %s is not known: it is shown as black", what,
        schema or "an object without a schema")
    end
    return { count = count or 0 }
  end
  local about, kind = table_of(table_of(child.metadata).celspan), text_of(child.transition_type)
  if not about.noun then about = { noun = kind == "SMPTE_Dissolve" and "dissolve" or kind } end
  return { before = frames_of(state, child.in_offset, what .. ": the in_offset", 0),
           after = frames_of(state, child.out_offset, what .. ": the out_offset", 0),
           about = about }
end

--- Markers of an item, or of a track. origin, speed: of the source at the frame `at` of the film.
local function add_markers(state, list, at, origin, speed)
  for _, marker in ipairs(table_of(list)) do
    local start, duration = range_of(state, table_of(marker).marked_range, "a marker")
    if start and speed ~= 0 then
      local from = math.floor(at + (start - origin) / speed + 0.5)
      state.marks[#state.marks + 1] = { name = text_of(marker.name) or "",
        from = from, to = from + math.floor(duration / math.abs(speed) + 0.5) }
    end
  end
end

--- The items of a track with the time `at` of each, in frames.
local function read_track(state, number, given)
  local list, at = {}, 0
  for i, child in ipairs(table_of(given.children)) do
    local name = text_of(table_of(child).name)
    local place = ("track %d, item %d"):format(number, i) .. (name and (" %q"):format(name) or "")
    local one = read_item(state, child, place)
    one.place, one.at, one.speed, list[i] = place, at, one.speed or 1, one
    at = at + (one.count or 0)
    add_markers(state, table_of(child).markers, one.at, one.origin or 0, one.speed)
  end
  add_markers(state, given.markers, 0, 0, 1)
  return list
end

local function round(value) return math.floor(value + 0.5) end

--- The whole frames of a transition before and after its middle; at an end of the film there is
--- nothing on one side.
local function halves(list, i)
  local one = list[i]
  if not one or not one.before then return 0, 0 end
  return list[i - 1] and round(one.before) or 0, list[i + 1] and round(one.after) or 0
end

--- The parts of an edit: clips reach beyond their middles into the transitions beside them.
local function parts_of(list)
  local parts = {}
  for i, one in ipairs(list) do
    local before, after = halves(list, i)
    if not one.before then
      local hidden, _, beyond = halves(list, i - 1), halves(list, i + 1)
      parts[#parts + 1] = { name = one.name, media = one.media, place = one.place,
        speed = one.speed, from = round((one.from or 0) - hidden * one.speed),
        count = round(one.at + one.count) - round(one.at) + hidden + beyond }
    elseif before + after > 0 then
      parts[#parts + 1] = { place = one.place, frames = before + after, about = one.about }
    end
  end
  return parts
end

--- The parts of the first track of pictures; all tracks of sounds are read too.
local function read_tracks(state, tracks)
  local list
  for number, one in ipairs(tracks) do
    local is_seen = schema_of(one) == "Track" and one.kind ~= "Audio"
    if is_seen and not list and one.enabled ~= false then
      list = read_track(state, number, one)
    elseif schema_of(one) ~= "Track" or is_seen or one.enabled == false then
      skip(state, "track %d is not read: only the first one of pictures and those of sounds are",
        number)
    end
  end
  if not state.rate then fail "has no track of pictures with items" end
  for number, one in ipairs(tracks) do
    if schema_of(one) == "Track" and one.kind == "Audio" and one.enabled ~= false then
      local heard = read_track(state, number, one)
      table.move(heard, 1, #heard, #state.sounds + 1, state.sounds)
    end
  end
  return parts_of(list)
end

--- The edit in a text.
function edit_otio.decode(text)
  local timeline, message = json.decode(text)
  if timeline == nil then fail("%s", message) end
  local stack = schema_of(timeline) == "Timeline" and table_of(timeline.tracks)
  if not stack then fail "has no OpenTimelineIO timeline: no object of the schema Timeline.1" end
  local edit = { title = text_of(timeline.name), skipped = {}, marks = {}, sounds = {} }
  edit.parts = read_tracks(edit, table_of(stack.children))
  add_markers(edit, stack.markers, 0, 0, 1)
  return edit
end

return require "celspan.fields".seal("edit_otio", edit_otio)
