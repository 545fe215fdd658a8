--- What an edit list says of a film, in frames: the same table for all formats.
--
--   edit.parts     as those of celspan.cut: shots { name, media, from, count, speed, length },
--                  black { count } and transitions { frames, about }, in which shots overlap
--   edit.marks     { name, from, to }: to is not counted; a mark without an end has from = to
--   edit.sounds    { name, media, at, from, count, speed, track }: none overlaps on its track
--   edit.skipped   sentences about what the film does not show as the list says
--   edit.hour      frames of an hour, if sources have codes of tapes
--
-- Frames count from 0. `place` is where the list has a part, for messages.
local carried = require "celspan.carried"
local celspan = require "celspan"
local edit_edl = require "celspan.edit_edl"
local edit_otio = require "celspan.edit_otio"
local fields = require "celspan.fields"
local files = require "celspan.files"
local json = require "celspan.json"
local native = require "celspan.native"
local ordered = require "celspan.ordered"
local shots_of = require "celspan.shots"
local soundtrack = require "celspan.soundtrack"
local storyboard = require "celspan.storyboard"
local timecode = require "celspan.timecode"
local values = require "celspan.values"

local edits = {}

local MOST_BYTES = 64 * 1024 * 1024 -- of a list
local MOST_NAMES = 100 -- among which the nearest is looked for

local fail, skip = values.fail, values.skip

local function base_of(path) return path:match "[^/\\]*$" end

-- ---------------------------------------------------------------- of a film

--- The parts of a film: its shots and transitions, or the film as one shot with this name.
local function parts_of(film, name)
  local parts, kept = {}, shots_of.of(film) or { into = {}, shots = { { film = film, speed = 1,
    label = name, from = film.first, count = film.frames } } }
  local function add_transition(into)
    if into then parts[#parts + 1] = { frames = into.count, about = into.between.about } end
  end
  for _, shot in ipairs(kept.shots) do
    add_transition(kept.into[shot])
    parts[#parts + 1] = { name = shot.label, from = shot.from - shot.film.first, count = shot.count,
                          speed = shot.speed, length = shot.film.frames }
  end
  add_transition(kept.into[false])
  return parts
end

--- The marks of a film without those that are names of its shots.
local function marks_of(film, parts)
  local list, shots = {}, {}
  for _, part in ipairs(parts) do shots[part.name or false] = true end
  for name, mark in pairs(film.marks or {}) do
    local first, last = mark, nil
    if type(mark) == "table" then first, last = mark[1], mark[2] end
    if not (shots[name] and last) then
      list[#list + 1] = { name = name, from = first - film.first,
                          to = (last and last + 1 or first) - film.first }
    end
  end
  return ordered.sort(ordered.sort(list, "name"), "from")
end

--- The sounds of a film on tracks: each on the first one where it overlaps none before it.
local function sounds_of(film)
  local list, ends = {}, {}
  for _, sound in ipairs(soundtrack.of(film)) do
    local from, to = 0, film.duration
    for _, passage in ipairs(sound.passages) do
      from, to = math.max(from, passage[1]), math.min(to, passage[2])
    end
    local is_file = not native.is_data(sound.path)
    if from < to then
      list[#list + 1] = { name = is_file and base_of(sound.path) or "sound",
        media = is_file and sound.path or nil, at = from * film.fps, count = (to - from) * film.fps,
        from = (from - sound.start) * sound.speed * film.fps, speed = sound.speed }
    end
  end
  for _, sound in ipairs(ordered.sort(list, "at")) do
    sound.track = 1
    while (ends[sound.track] or 0) > sound.at + 1e-6 do sound.track = sound.track + 1 end
    ends[sound.track] = sound.at + sound.count
  end
  return list
end

local writers = { otio = edit_otio.encode, edl = edit_edl.encode }

--- For `celspan sheet`: "+" and the edit list of a film, or "-" and a message. wish: JSON of its
--- `form`, "otio" or "edl"; of `media`, the name of a shot's file with {name} for the name of the
--- shot; of `up`, the way from the folder of the list to the current one; and of `name`, the title
--- of a film that has none.
function edits.text(wish, film)
  wish = assert(json.decode(wish))
  local title = film.title or wish.name
  local parts, sounds = parts_of(film, title), sounds_of(film)
  for _, part in ipairs(parts) do
    part.media = wish.media and part.name and wish.media:gsub("{name}", { ["{name}"] = part.name })
  end
  for _, sound in ipairs(sounds) do
    sound.media = sound.media and (sound.media:find "^/" and "" or wish.up) .. sound.media
  end
  local text, message = fields.caught(writers[wish.form], { title = title,
    rate = timecode.rate(film.fps), parts = parts, marks = marks_of(film, parts), sounds = sounds })
  return text and "+" .. text or "-" .. message
end

-- ---------------------------------------------------------------- the film of an edit

--- The film of a shot, by the name of the clip, its file, or its reel; nil: there is none. A tape
--- often begins at a whole hour, which its film does not have.
local function find(state, part)
  local base, hour = base_of(part.media or ""), state.edit.hour
  local stem = base:match "^(.-)%.[^.]*$" or base
  for _, name in ipairs { part.name, base, stem, part.reel } do
    local film = rawget(state.films, name)
    if film and hour and part.from >= math.max(hour, film.frames) then
      part.from = part.from % hour
      skip(state.edit, "%s: the codes of its source are read without their hour", part.place)
    end
    if film then return film end
  end
end

local function missing(films, part)
  local names = {}
  for name in pairs(films) do
    if #names < MOST_NAMES then names[#names + 1] = tostring(name) end
  end
  table.sort(names)
  fail("there is no film '%s'%s", part.name, fields.choice(part.name, names))
end

--- Checks the films. Returns the first by its name, which gives size and rate.
local function check_films(films)
  local first
  for name, film in pairs(values.table(films)) do
    fields.expect_kind(carried.is_film(film), film, "cut: read: '%s' must be a film",
      fields.key(name))
    if type(name) == "string" and not (first and first < name) then first = name end
  end
  return first and films[first]
    or native.refuse 'cut: read: a list needs films by name: cut.read("a.otio", { hall = film })'
end

local function black(like, count)
  local w, h = table.unpack(like.size)
  return celspan.film { size = like.size, fps = like.fps, frames = count, space = like.space,
    frame = function() return celspan.rect { 0, 0, w, h, texture = "#000" } end }
end

--- A part of celspan.cut that shows a shot. A film at another speed gets times of its own, so that
--- it has exactly these frames.
local function shown(cut, part, film)
  local first, count, speed = film.first + part.from, part.count, part.speed
  if speed == 1 then return { film = film, from = first, to = first + count - 1 } end
  local stop = part.from + count * speed
  if stop < 0 or stop > film.frames then stop, count = stop - speed, count - 1 end
  local times = { { 0, first }, count > 0 and { count / film.fps, film.first + stop } or nil }
  return { film = cut.retime(film, times, part.count / film.fps) }
end

--- The transition of an edit; one that celspan lacks is a dissolve.
local function transition_of(cut, edit, part, fps)
  local about, seconds = part.about, part.frames / fps
  local curve = type(about.ease) == "string" and about.ease or nil
  local good, made = pcall(function()
    if about.noun == "fade" then return cut.fade(seconds, about.colour, curve) end
    if about.noun == "wipe" or about.noun == "iris" or about.noun == "push" then
      local settings = { angle = about.angle, softness = about.softness, centre = about.centre,
                         from = about.from }
      return cut[about.noun](settings)(seconds, curve)
    end
    return about.noun == "dissolve" and cut.dissolve(seconds, curve)
  end)
  if good and made then return made end
  skip(edit, "%s: '%s' is not known: it is shown as a dissolve", part.place, fields.key(about.noun))
  return cut.dissolve(seconds)
end

--- Whether a name can be that of a mark.
local function is_mark(name) return #name < 240 and name:find "^%a[^,:%c]*$" ~= nil end

--- A name for a part that no part before has; nil if it cannot be that of a mark.
local function free_name(taken, name)
  local free, i = name, 1
  while taken[free] do free, i = ("%s (%d)"):format(name, i + 1), i + 1 end
  taken[free] = true
  return is_mark(name) and free or nil
end

--- The part of celspan.cut for a shot or black; a shot is added to the list of shots.
local function part_of(state, part)
  local fps = state.like.fps
  if not part.name then return black(state.like, part.count) end
  local film = find(state, part) or missing(state.films, part)
  table.insert(state.shots, { name = part.name, from = state.at / fps,
    to = (state.at + part.count) / fps, source = { from = part.from / fps,
    to = (part.from + part.count * part.speed) / fps } })
  if state.edit.sounds[1] then
    state.mute[film] = state.mute[film] or film:with { sound = {} }
    film = state.mute[film]
  end
  local made = shown(state.cut, part, film)
  made.name = free_name(state.taken, part.name)
  return made
end

local function cut_marks(edit, count)
  local marks = {}
  for _, mark in ipairs(edit.marks) do
    if mark.from >= 0 and mark.from < count and is_mark(mark.name) and not marks[mark.name] then
      local last = mark.to > mark.from and math.min(mark.to, count)
      marks[mark.name] = last and { mark.from + 1, last } or mark.from + 1
    else
      skip(edit, "the mark '%s' is left out: it lies outside the film, another one has its name, "
        .. "or its name is not allowed", mark.name)
    end
  end
  return marks
end

--- The sounds that the list has beside its pictures: of films, or of files.
local function cut_sounds(state)
  local list, fps = {}, state.like.fps
  for _, sound in ipairs(state.edit.sounds) do
    local film, file = sound.name and find(state, sound), sound.media
    if file and not file:find "^/" then file = state.folder .. file end
    local can_be = sound.name and sound.from >= 0 and sound.speed >= 0.01 and sound.count > 0
    if can_be and (film or file) then
      table.insert(list, { film or file, at = sound.at / fps, from = sound.from / fps,
        speed = sound.speed, to = (sound.from + sound.count * sound.speed) / fps })
    elseif sound.name then
      skip(state.edit, "%s: the sound '%s' is not heard", sound.place, sound.name)
    end
  end
  return list[1] and list
end

--- The film of an edit and its shots. Faults are those of celspan.cut, with the place in the list.
local function film_of(state)
  local edit, places, parts = state.edit, {}, state.parts
  for i, part in ipairs(edit.parts) do
    if part.frames then
      parts[#parts + 1] = transition_of(state.cut, edit, part, state.like.fps)
      state.at = state.at - (i > 1 and edit.parts[i + 1] and part.frames or 0)
    elseif part.count > 0 then
      local good, made = pcall(part_of, state, part)
      if not good then
        fail("%s: %s", part.place, made.message or made:gsub("^.-cut: retime: ", ""))
      end
      parts[#parts + 1], state.at = made, state.at + part.count
    end
    places[#parts] = part.place
  end
  if not state.shots[1] then fail "shows no film" end
  parts.title, parts.marks, parts.sound = edit.title, cut_marks(edit, state.at), cut_sounds(state)
  local good, made = pcall(state.cut, parts)
  if not good then
    fail("%s", made:gsub("^.-cut: part (%d+)", function(i) return places[tonumber(i)] end))
  end
  return made, state.shots
end

local readers = { otio = edit_otio.decode, edl = edit_edl.decode }

--- The film and the shots of an edit list, or of a storyboard if there are no readers for it.
local function decode(cut, form, text, films, folder)
  if not readers[form] then return storyboard.read(text, folder) end
  local like = check_films(films)
  local edit, rate = readers[form](text, like.fps), timecode.rate(like.fps)
  if edit.rate ~= rate then
    fail("has %.14g frames a second, and the films %.14g: film:with { fps = %.14g }", edit.rate,
      rate, edit.rate)
  end
  return film_of { cut = cut, edit = edit, films = films, like = like, folder = folder, parts = {},
                   shots = { skipped = edit.skipped }, at = 0, taken = {}, mute = {} }
end

--- For cut.read.
function edits.read(cut, path, films)
  fields.takes("cut: read", "string", "the name of a file", path)
  local form, folder = (path:match "%.(%w+)$" or ""):lower(), ""
  if form ~= "storyboarder" and not readers[form] then
    native.refuse(("cut: read: %s must end in .otio, .edl or .storyboarder"):format(path))
  end
  local text, message = files.found(path, function(found)
    folder = found:match "^.*/" or ""
    return files.read(found, MOST_BYTES)
  end)
  if not text then return nil, message end
  return fields.caught_in(path, decode, cut, form, text, films, folder)
end

return fields.seal("edits", edits)
