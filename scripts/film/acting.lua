-- The lamplighter's acting at a frame of the film, from the exposure sheet and the voice.
local sheet = require "celspan.sheet"
local lamplighter = require "film.lamplighter"
local timing = require "film.timing"

local acting = {}

local exposed = assert(sheet.read "acting.txt")
local voice = assert(lips.read("voice.tsv", { fps = timing.fps }))
local way = lamplighter.way(exposed, "step")

acting.sheet, acting.voice = exposed, voice

--- The frame of the film, from 1, that shows this time.
function acting.frame_of(time)
  return math.max(1, math.min(exposed.frames, math.floor(time * timing.fps + 0.01) + 1))
end

--- The drawings of a frame, and the distance that he has walked, in his units. Where the sheet has
--- the mouth `voice`, the voice track selects it.
function acting.at(time)
  local frame = acting.frame_of(time)
  local mouth = exposed:at("mouth", frame)
  if mouth == "voice" then mouth = voice:at(frame) end
  return { step = exposed:at("step", frame) or "stand", eyes = exposed:at("eyes", frame),
    mouth = mouth,
    mitten = exposed:at("mitten", frame), time = time }, way[frame]
end

--- The distance that he has walked when he stops at the lamp.
function acting.far_way() return way[acting.frame_of(timing.reach)] end

return acting
