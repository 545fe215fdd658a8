--- What moves with the pictures of a film into another one: its sounds, captions and marks, for
--- celspan.cut.
--
--   film       |--- sound ---|--- caption ---|      from, to: the piece that is shown, in seconds
--                   from ^           ^ to
--   new film        |----------------|              at its time `at`, at its speed
local captions = require "celspan.captions"
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"
local subtitles = require "celspan.subtitles"

local carried = {}

--- A share of a frame: 3 frames at 0.1 of the speed are 30 frames, not 31.
carried.SMALL = 1e-9
local MOST_PIECES = 10000 -- the most pieces of a sound that is retimed

local film_metatable = getmetatable(celspan.film { frame = function() end })

function carried.is_film(value)
  return getmetatable(value) == film_metatable and fields.kind(value) == "a film"
end

-- ---------------------------------------------------------------- of shots

--- The sound of a film as a list.
function carried.list_of(sound)
  if sound == nil then return {} end
  if type(sound) == "string" or type(sound) == "table" and
    (type(sound[1]) == "string" or carried.is_film(sound[1])) then
    return { sound }
  end
  return sound
end

--- The piece of a film that a shot shows, as a sound. It fades in and out with the pictures.
function carried.piece_of(shot)
  local film, fps = shot.film, shot.film.fps
  return { film, at = shot.start / fps, from = (shot.from - film.first) / fps,
           to = (shot.to - film.first + 1) / fps, speed = shot.speed, name = shot.name,
           fade = { shot.before / fps, shot.after / fps } }
end

--- The sounds of the shots and the sounds of the cut.
function carried.sounds_of(shots, own)
  local sounds = {}
  for _, shot in ipairs(shots) do
    if #carried.list_of(shot.film.sound) > 0 then sounds[#sounds + 1] = carried.piece_of(shot) end
  end
  if type(own) ~= "nil" and type(own) ~= "string" and type(own) ~= "table" then return own end
  local list = carried.list_of(own)
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
function carried.captions_of(pieces, own)
  local list, known = {}, {}
  for _, piece in ipairs(pieces) do add_captions(list, piece, known) end
  if own == nil then return #list > 0 and list or nil end
  if #list == 0 or type(own) ~= "table" and type(own) ~= "string" then return own end
  if type(own) == "string" then
    local read, message = captions.read(own)
    own = read or native.refuse("cut: captions: " .. message)
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
    return shot.start + math.ceil((frame - shot.from) / shot.speed - carried.SMALL) + 1
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
function carried.marks_of(shots, own)
  local marks = {}
  for _, shot in ipairs(shots) do add_marks(shot, marks) end
  for _, shot in ipairs(shots) do
    if shot.name then marks[shot.name] = { shot.start + 1, shot.start + shot.count } end
  end
  if own ~= nil and type(own) ~= "table" then return own end
  for name, frame in pairs(own or {}) do marks[name] = frame end
  return next(marks) ~= nil and marks or nil
end

-- ---------------------------------------------------------------- of a film at other times

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
function carried.pieces_of(film, track, duration)
  if #carried.list_of(film.sound) == 0 and film.captions == nil then return {} end
  local list, first, last = {}, track.keys[1].time, track.keys[#track.keys].time
  local turns = track.loop and last > first and math.ceil((duration - first) / (last - first)) or 1
  if turns * #track.keys > MOST_PIECES then
    native.refuse(("cut: retime: the sound or the captions have more than %d pieces, which is the "
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
function carried.retimed_marks(film, count, number_at)
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

return fields.seal("carried", carried)
