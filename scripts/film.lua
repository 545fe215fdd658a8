-- Little One: a lamplighter, a spark and the last lamp of a town, in half a minute.
--
-- ./run film also makes the sound, and renders it with
--
--   celspan render scripts/film.lua -o out/film.mp4 --allow FOLDER -- FOLDER/sound.wav
--
-- This script is the edit: when each shot is shown, and how it dissolves into the next. The action
-- of a shot is in film/shots/, with the set and the figure beside it, and film/timing.lua has the
-- times for all of them.
local timing = require "film.timing"

local sound = ...

local shots = {}
for _, shot in ipairs(timing.shots) do
  shots[#shots + 1] = { from = shot.from, to = shot.to, draw = require("film.shots."
    .. shot.name).draw }
end

local fading = ease "inOutSine"

--- The weight of a shot: less than 1 while it dissolves from the shot before it or into the shot
--- after it.
local function share_of(i, time)
  local before, shot, after = shots[i - 1], shots[i], shots[i + 1]
  local share = 1
  if before and time < before.to then
    share = fading(motion.span(time, shot.from, before.to - shot.from))
  end
  if after and time >= after.from then
    share = share * (1 - fading(motion.span(time, after.from, shot.to - after.from)))
  end
  return share
end

return film { title = "Little One", fps = timing.fps, duration = timing.seconds,
  sound = sound,
  frame = function(f)
    local exposures = {}
    for i, shot in ipairs(shots) do
      if f.time >= shot.from and f.time < shot.to then
        local share = share_of(i, f.time)
        if share > 0 then exposures[#exposures + 1] = { shot.draw(f.time), share } end
      end
    end
    return exposures
  end }
