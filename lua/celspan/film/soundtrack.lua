--- The sounds of a film as one flat list, for the mix (src/kit/plugins/sound/mix.h).
--
--   film A: voice.wav at 1 s                     voice.wav: start 5 - 2 + 1, heard from 5 to 8
--   film B: { A, at = 5, from = 2, to = 5 }  --> (the passage of A in B), and in A's own passages
--
-- A sound of a film that is a sound of another one is moved, and heard at another speed, with all
-- that lies around it.
local native = require "celspan.native"

---@class celspan.soundtrack.sound
---@field path string
---@field tried string? Another path that does not exist either
---@field number integer Of the sound in its own film
---@field start number Second of the film at which the file begins, if all of it is heard
---@field speed number
---@field from number Seconds of the file that are left out
---@field left number
---@field right number
---@field passages number[][] { begin, end, fade in, fade out }
---@field stem string The file of `celspan sound --stems` that has it
---@field names table<string, true> Its own, and those of the films that it is in
---@field duckers celspan.soundtrack.ducker[]

---@class celspan.soundtrack.ducker
---@field sound celspan.soundtrack.sound
---@field place? integer Of the sound in the list of all
---@field gain number
---@field attack number
---@field release number

local soundtrack = {}

local MOST = 10000 -- sounds
local DEEPEST = 1000 -- nested films: each level takes time for all its sounds
local UNNAMED = "rest" -- the stem of sounds without a name
local SLOWEST, FASTEST = 0.01, 100 -- of the original speed

--- Constant power: the squares of both factors add up to 2, and both are 1 in the middle.
local function pan(value)
  local angle = (value + 1) * math.pi / 4
  return math.sqrt(2) * math.cos(angle), math.sqrt(2) * math.sin(angle)
end

local function gain_of(sound)
  if sound.pan == 0 then return sound.gain, sound.gain end
  local left, right = pan(sound.pan)
  return sound.gain * left, sound.gain * right
end

--- The single sound of a file.
local function of_file(sound)
  local start = sound.at - sound.from / sound.speed
  local left, right = gain_of(sound)
  return { {
    path = sound.path, tried = sound.tried, number = sound.number, start = start,
    speed = sound.speed, from = sound.from, left = left, right = right, duckers = {}, names = {},
    stem = UNNAMED,
    passages = { { sound.at, sound.to and start + sound.to / sound.speed or math.huge,
      sound.fade_in, sound.fade_out } },
  } }
end

--- Whether there is a time at which all passages are open.
local function is_heard(passages)
  local first, last = -math.huge, math.huge
  for _, passage in ipairs(passages) do
    first, last = math.max(first, passage[1]), math.min(last, passage[2])
  end
  return first < last
end

local flatten

--- The sounds of a film that is itself a sound of another film.
local function of_film(sound, depth)
  local film, list = sound[1], {}
  local to = math.min(sound.to or math.huge, film.duration)
  local function moved(seconds) return sound.at + (seconds - sound.from) / sound.speed end
  local left, right = gain_of(sound)
  for _, inner in ipairs(flatten(film, depth + 1)) do
    for i, passage in ipairs(inner.passages) do
      inner.passages[i] = { moved(passage[1]), moved(passage[2]), passage[3] / sound.speed,
        passage[4] / sound.speed }
    end
    for _, ducker in ipairs(inner.duckers) do
      ducker.attack, ducker.release = ducker.attack / sound.speed, ducker.release / sound.speed
    end
    table.insert(inner.passages, { sound.at, moved(to), sound.fade_in, sound.fade_out })
    inner.start, inner.speed = moved(inner.start), inner.speed * sound.speed
    if inner.speed < SLOWEST or inner.speed > FASTEST then
      error(("film: sound %d: %s: it is heard at %.4g times its speed, in films that are sounds of "
        .. "films; 0.01 to 100 times is possible"):format(sound.number,
        native.is_data(inner.path) and "data:..." or inner.path, inner.speed), 0)
    end
    inner.left, inner.right = inner.left * left, inner.right * right
    if is_heard(inner.passages) then list[#list + 1] = inner end
  end
  return list
end

--- Lowers the sounds of one list while sounds of another list are heard, with the settings of an
--- item.
local function add_duckers(lower, higher, item)
  local sound = item.sound
  for _, one in ipairs(lower) do
    for _, other in ipairs(higher) do
      table.insert(one.duckers, { sound = other, gain = 10 ^ (-sound.duck_depth / 20),
                                  attack = sound.duck_attack, release = sound.duck_release })
    end
  end
end

--- The sounds of all other items that have a name, or belong to a film with this name.
local function named(items, item, name)
  local found = {}
  for _, other in ipairs(name and items or {}) do
    for _, one in ipairs(other ~= item and other.list or {}) do
      if one.names[name] then found[#found + 1] = one end
    end
  end
  return found
end

--- For each item, notes which sounds make its sounds lower.
local function duck_items(items)
  for _, item in ipairs(items) do
    add_duckers(named(items, item, item.sound.duck), item.list, item)
    add_duckers(item.list, named(items, item, item.sound.under), item)
  end
end

--- Returns new tables at each call. depth: the number of films around this one, each of which uses
--- the next one as a sound.
function flatten(film, depth)
  if depth > DEEPEST then
    error(("the film has sounds that are films more than %d deep, which is the limit")
      :format(DEEPEST), 0)
  end
  local items, all = {}, {}
  for i, sound in ipairs(native.sounds(film)) do
    sound.at = sound.at + film.sound_offset
    local list = sound.path and of_file(sound) or of_film(sound, depth)
    items[i] = { sound = sound, list = list }
    for _, one in ipairs(sound.name and list or {}) do
      one.names[sound.name], one.stem = true, sound.name
    end
    table.move(list, 1, #list, #all + 1, all)
    if #all > MOST then
      error(("the film has more than %d sounds, which is the limit"):format(MOST), 0)
    end
  end
  duck_items(items)
  return all
end

--- The sounds of a film, with the places of their duckers in the list.
---@param film celspan.film
---@return celspan.soundtrack.sound[]
function soundtrack.of(film)
  local list, places = flatten(film, 0), {}
  for i, sound in ipairs(list) do places[sound] = i end
  for _, sound in ipairs(list) do
    local found = {}
    for _, ducker in ipairs(sound.duckers) do
      ducker.place = places[ducker.sound]
      if ducker.place then found[#found + 1] = ducker end
    end
    sound.duckers = found
  end
  return list
end

return require "celspan.fields".seal("soundtrack", soundtrack)
