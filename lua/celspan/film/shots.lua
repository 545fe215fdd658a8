--- The shots of the films that celspan.cut made, for `celspan watch`, which shows them.
local fields = require "celspan.fields"
local json = require "celspan.json"
local scenes = require "celspan.scenes"

local shots = {}

local MOST = 100 -- films that are kept
local films = {} -- the last one made last: { film =, frames =, shots =, into = }
local is_marking = false
local lone -- the shot that is seen alone in its transitions; nil: none is

--- Keeps the shots of a film. Returns the film.
function shots.keep(film, list, segments)
  local into = {}
  for _, segment in ipairs(segments) do
    if segment.between then into[segment.b or false] = segment end
  end
  for i, shot in ipairs(list) do shot.label = shot.name or ("shot %d"):format(i) end
  if #films == MOST then table.remove(films, 1) end
  films[#films + 1] = { film = film, frames = film.frames, shots = list, into = into }
  return film
end

--- What is kept of a film: { shots =, into = }, where `into` has the segments of transitions by the
--- shot after them, or false for the end; nil: it was not cut.
function shots.of(film)
  for i = #films, 1, -1 do
    local one = films[i] -- a film that is changed by film:with has the same function
    if one.film.frame == film.frame and one.frames == film.frames then return one end
  end
end

--- Whether the frames of shots are marked from now on: "on" or "off".
function shots.mark(how)
  is_marking = how == "on"
  return ""
end

--- What a shot shows, a rostrum or a list of exposures. If frames are marked, the rostra have the
--- name of the shot.
function shots.marked(result, shot)
  if not is_marking then return result end
  if type(result) ~= "table" then return scenes.named(result, shot.label) end
  local list = {}
  for i, exposure in ipairs(result) do
    list[i] = { scenes.named(exposure[1], shot.label), exposure[2] }
  end
  return list
end

--- The film with this number of frames that was cut last; nil: no such film was cut.
local function film_of(frames)
  for i = #films, 1, -1 do
    if films[i].frames == math.tointeger(frames) then return films[i] end
  end
end

--- Has a shot be seen alone in its transitions from now on. place: the frames of the film and the
--- number of the shot, such as "84 2"; "": no shot is.
function shots.isolate(place)
  local frames, i = place:match "^(%d+) (%d+)$"
  local film = frames and film_of(frames)
  lone = film and film.shots[math.tointeger(i)]
  return ""
end

--- The one of two shots of a transition that is seen alone; nil: both are seen.
function shots.lone(a, b)
  if lone and (lone == a or lone == b) then return lone end
end

--- The shots of the film with this number of frames that was cut last, as JSON: name, the frames
--- `from` and `to`, the number of frames `before` and `after` that it shares in transitions, and
--- `into`, the kind of the transition before it; "": no such film was cut.
function shots.text(frames)
  local one, list = film_of(frames), {}
  for i, shot in ipairs(one and one.shots or {}) do
    local into = one.into[shot]
    list[i] = { { "name", shot.label }, { "from", shot.start + 1 },
                { "to", shot.start + shot.count }, { "before", shot.before },
                { "after", shot.after }, { "into", into and into.between.noun or "" } }
  end
  return one and json.encode { list = list } or ""
end

return fields.seal("shots", shots)
