--- Edits as CMX 3600: a text with a line for each event.
--
--   002  HALL     V     C        00:00:02:00 00:00:02:00 01:00:02:00 01:00:02:00
--   002  NELL     V     D    012 00:00:00:00 00:00:04:00 01:00:02:00 01:00:06:00
--   * FROM CLIP NAME: hall
--   * TO CLIP NAME: nell
--
-- The columns: event, reel, channels, kind of the transition and its frames, and codes of the
-- source and of the film, from and to. A dissolve has two lines: the first source continues during
-- its frames. Codes have no rate: it is that of the films.
local json = require "celspan.json"
local ordered = require "celspan.ordered"
local timecode = require "celspan.timecode"
local values = require "celspan.values"

local edit_edl = {}

local CHANNELS = { "A", "A2" } -- of the tracks of sounds
local FASTEST = 100 -- times the speed of the source

local fail, skip = values.fail, values.skip

--- The codes of a second at a rate; second, those left out in a minute with drop frames, or nil.
local function codes_at(fps)
  local _, codes = timecode.rate(fps)
  return codes or fail("an EDL has whole codes in a second, and the rate is %.14g: write .otio",
    fps), timecode.dropped(fps)
end

-- ---------------------------------------------------------------- writing

--- The reel of a clip: up to eight letters and digits, which no other clip has. Black is BL.
local function reel_of(state, name)
  if not name then return "BL" end
  if not state.reels[name] then
    local reel = name:upper():gsub("[^%w]", ""):sub(1, 8)
    if reel == "" or state.taken[reel] then reel = ("R%06d"):format(state.event) end
    state.reels[name], state.taken[reel] = reel, true
  end
  return state.reels[name]
end

local function code(state, frame)
  return timecode.text(math.floor(frame + 0.5), state.codes, state.dropped)
    or fail "an EDL has codes for a day, and the film is longer: write .otio"
end

local function add_line(state, ...)
  state.lines[#state.lines + 1] = string.format(...):gsub("%c", " ")
end

--- Adds an event that shows `count` frames at frame `at` of the film. kind: of its transition.
local function add_event(state, part, channel, kind, from, at, count)
  local reel, first = reel_of(state, part.name), code(state, from)
  add_line(state, "%03d  %-8s %-5s %-8s %s %s %s %s", state.event, reel, channel, kind, first,
    code(state, math.max(0, from + count * part.speed)), code(state, state.first + at),
    code(state, state.first + at + count))
  if part.speed ~= 1 and count > 0 then
    add_line(state, "M2   %-8s %011.6f %s", reel, part.speed * state.codes, first)
  end
end

local function add_names(state, before, part)
  if before and before.name then add_line(state, "* FROM CLIP NAME: %s", before.name) end
  if part.name then add_line(state, "* %s CLIP NAME: %s", before and "TO" or "FROM", part.name) end
  if part.media then add_line(state, "* SOURCE FILE: %s", part.media) end
end

local function kind_of(between)
  local about, wipe = between.about, nil
  if about.noun == "wipe" then wipe = about.angle == 90 and "W002" or "W001" end
  return ("%-4s %03d"):format(about.noun == "iris" and "W119" or wipe or "D", between.frames)
end

--- Adds a shot at frame `at` of the film, which ends where a transition after it begins.
local function add_shot(state, parts, i, at)
  local part, between, after = parts[i], parts[i - 1], parts[i + 1]
  local count = part.count - (after and after.frames or 0)
  state.event = state.event + 1
  if not (between and between.frames) then
    add_event(state, part, "V", "C", part.from, at, count)
    return add_names(state, nil, part)
  end
  local out = parts[i - 2] or { from = 0, count = between.frames, speed = 1 }
  add_event(state, out, "V", "C", out.from + (out.count - between.frames) * out.speed, at, 0)
  add_event(state, part, "V", kind_of(between), part.from, at, count)
  add_names(state, out, part)
  add_line(state, "* CELSPAN: %s", json.encode(between.about, { plain = true, compact = true }))
end

--- Adds the shots. A transition at the end goes to black.
local function add_pictures(state, parts)
  local at, last = 0, parts[#parts]
  if last.frames then parts[#parts + 1] = { count = last.frames, from = 0, speed = 1 } end
  for i, part in ipairs(parts) do
    if part.frames then
      at = at - (i > 1 and part.frames or 0)
    else
      add_shot(state, parts, i, at)
      at = at + part.count
    end
  end
end

--- The text of an edit.
function edit_edl.encode(edit)
  local codes, dropped = codes_at(edit.rate)
  local state = { lines = {}, event = 0, codes = codes, dropped = dropped or 0, reels = {},
                  taken = { BL = true } }
  state.first = timecode.frame("01:00:00:00", codes, state.dropped)
  add_line(state, "TITLE: %s", edit.title)
  add_line(state, "FCM: %s", dropped and "DROP FRAME" or "NON-DROP FRAME")
  add_pictures(state, edit.parts)
  for _, sound in ipairs(edit.sounds) do
    state.event = state.event + 1
    local channel = CHANNELS[sound.track]
    if channel then
      add_event(state, sound, channel, "C", sound.from, sound.at, sound.count)
      add_names(state, nil, sound)
    else
      add_line(state, "* NO CHANNEL IS FREE FOR %s", sound.name)
    end
  end
  for _, mark in ipairs(edit.marks) do
    add_line(state, "* LOC: %s GREEN   %s", code(state, state.first + mark.from), mark.name)
  end
  return table.concat(state.lines, "\n") .. "\n"
end

-- ---------------------------------------------------------------- reading: lines

local function frame_of(state, text)
  local is_dropped = state.is_dropped or text:find ";"
  if is_dropped and not state.dropped then
    fail("line %d: an EDL with drop frames at a rate that has none: %.14g; set fps = 30000 "
      .. "/ 1001 in the films of its shots, or write FCM: NON-DROP FRAME", state.line, state.rate)
  end
  local frame, message = timecode.frame(text, state.codes, is_dropped and state.dropped or 0)
  return frame or fail("line %d: %s", state.line, message)
end

--- Reads a line such as 002  NELL  V  D 012 and its four codes.
local function read_event(state, words)
  local count, kind, times = #words, words[4] or "", {}
  local place = ("line %d: event %s"):format(state.line, words[1])
  local frames = kind == "C" and 0 or math.tointeger(tonumber(words[5]))
  if count < (kind == "C" and 8 or 9) or not kind:find "^[CDW]" or not frames or frames < 0
    or frames > 1e6 then
    fail("%s: after its number are a reel, channels, C or D 012 or W001 012, and four codes", place)
  end
  for i = 1, 4 do times[i] = frame_of(state, words[count - 4 + i]) end
  if times[2] < times[1] or times[4] < times[3] then fail("%s ends before it begins", place) end
  local channels = words[3]:upper()
  local is_both = channels == "B"
  state.event = { number = words[1], reel = words[2], kind = kind, frames = frames, place = place,
    is_seen = is_both or channels:find "V", is_heard = is_both or channels:find "A",
    from = times[1], to = times[2], at = times[3], stop = times[4] }
  state.events[#state.events + 1] = state.event
end

local NAMES = { ["FROM CLIP NAME"] = "from_name", ["TO CLIP NAME"] = "to_name",
                ["SOURCE FILE"] = "media" }

--- Reads what follows an asterisk.
local function read_comment(state, text)
  local event, name, value = state.event or {}, text:match "^%s*([%u ]-)%s*:%s*(.-)%s*$"
  if NAMES[name] then event[NAMES[name]] = value end
  if name == "CELSPAN" then event.about = json.decode(value) end
  local code_text, mark = (value or ""):match "^(%d%S+)%s+%S+%s+(.+)$"
  if name == "LOC" and code_text then
    table.insert(state.marks, { name = mark, from = frame_of(state, code_text) })
  end
end

--- Reads the speed of the event before.
local function read_speed(state, words)
  local speed = (tonumber(words[3]) or math.huge) / state.codes
  if not (state.event and math.abs(speed) <= FASTEST) then
    fail("line %d: M2 has an event before it, a reel, and frames in a second", state.line)
  end
  state.event.speed = speed
end

local function read_line(state, text)
  local words = {}
  for word in text:gmatch "%S+" do words[#words + 1] = word end
  local first = words[1] or "*"
  if first:find "^%*" then
    read_comment(state, text:gsub("^%s*%*?", ""))
  elseif first == "TITLE:" then
    state.title = text:match "TITLE:%s*(.-)%s*$"
  elseif first == "FCM:" then
    state.is_dropped = text:find "DROP" and not text:find "NON"
    if state.is_dropped then frame_of(state, "00:00:00;00") end
  elseif first == "M2" then
    read_speed(state, words)
  elseif first == "AUD" and state.event then
    state.event.is_heard = true
  elseif first:find "^%d+$" then
    read_event(state, words)
  else
    skip(state, "line %d: %s is not known", state.line, first)
  end
end

-- ---------------------------------------------------------------- reading: an edit

--- A shot, a sound, or black. Without M2 the codes of the source say how fast it is.
local function part_of(event, name, count)
  local length, source = event.stop - event.at, event.to - event.from
  local speed = event.speed or length > 0 and source > 0 and source / length or 1
  return { name = event.reel ~= "BL" and (name or event.media or event.reel) or nil, speed = speed,
    media = event.media, reel = event.reel, from = event.from, count = count, place = event.place }
end

local function about(state, event)
  if type(event.about) == "table" and event.about.noun then return event.about end
  if event.kind == "D" then return { noun = "dissolve" } end
  if event.kind == "W119" then return { noun = "iris" } end
  if event.kind ~= "W001" and event.kind ~= "W002" then
    skip(state, "%s: the wipe %s is not known: it is shown as one from left to right", event.place,
      event.kind)
  end
  return { noun = "wipe", angle = event.kind == "W002" and 90 or 0 }
end

--- Adds the frames of the source before a transition: of the last shot, or of another one. At the
--- beginning of the film, a transition from black needs none.
local function add_out(state, out, event)
  local last, name = state.parts[#state.parts], event.to_name and event.from_name
  local is_other = last and out
    and (last.reel ~= out.reel or name and last.name and last.name ~= name)
  if last and not is_other then
    last.count = last.count + event.frames
  elseif out and (out.reel ~= "BL" or last) then
    table.insert(state.parts, part_of(out, name, event.frames))
  end
end

--- Adds an event with pictures. out: the event of no length that has its number and is before it.
--- is_last: a transition to black needs no black after it.
local function add_seen(state, event, out, is_last)
  if event.at < state.at then fail("%s begins before the one before it ends", event.place) end
  if event.at > state.at then
    table.insert(state.parts, { count = event.at - state.at, reel = "BL", speed = 1, from = 0 })
  end
  local count, source = event.stop - event.at, event.to - event.from
  if not event.speed and count ~= source and source > 0 and event.reel ~= "BL" then
    skip(state, "%s: it has %d frames of its source for %d of the film, and no M2: it is shown at "
      .. "%.4g times its speed", event.place, source, count, source / count)
  end
  if event.frames > 0 then
    add_out(state, out, event)
    table.insert(state.parts, { frames = event.frames, place = event.place,
                                about = about(state, event) })
  end
  if not (is_last and event.reel == "BL" and count == event.frames) then
    table.insert(state.parts, part_of(event, event.to_name or event.from_name, count))
  end
  state.at = event.stop
end

--- Adds the events, first those that are heard, then those that are seen, in the order of the film.
local function add_parts(state, first)
  local seen, out = {}, nil
  for _, event in ipairs(state.events) do
    if event.is_seen then seen[#seen + 1] = event end
    if event.is_heard and event.stop > event.at then
      local sound = part_of(event, event.from_name, event.stop - event.at)
      sound.at = event.at - first
      table.insert(state.sounds, sound)
    end
  end
  for i, event in ipairs(ordered.sort(seen, "at")) do
    local is_empty = event.at == event.stop
    if not is_empty then
      add_seen(state, event, out and out.number == event.number and out or nil, i == #seen)
    end
    out = is_empty and event or nil
  end
end

--- The edit in a text. fps: of its films.
function edit_edl.decode(text, fps)
  local codes, dropped = codes_at(fps)
  local state = { rate = timecode.rate(fps), codes = codes, dropped = dropped, line = 0,
                  events = {}, marks = {}, sounds = {}, parts = {}, skipped = {} }
  for line in text:gsub("\r\n?", "\n"):gmatch "[^\n]*" do
    state.line = state.line + 1
    read_line(state, line)
  end
  local first = state.events[1] and state.events[1].at
    or fail "has no events, lines such as 001 HALL V C and four codes"
  for _, event in ipairs(state.events) do first = math.min(first, event.at) end
  state.at = first
  state.hour = timecode.frame("01:00:00:00", codes, state.is_dropped and dropped or 0)
  add_parts(state, first)
  for _, mark in ipairs(state.marks) do
    mark.from, mark.to = mark.from - first, mark.from - first
  end
  return state
end

return require "celspan.fields".seal("edit_edl", edit_edl)
