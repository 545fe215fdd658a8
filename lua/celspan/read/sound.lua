--- How loud a sound is at a moment, and when something begins in it, for drawings that follow it.
--
--   local voice = assert(sound.read "voice.wav")
--   local mouth = voice:loudness(f.time)      -- 0..1
--   local notes = voice:onsets()              -- seconds
--   local bars = voice:spectrum(f.time, 12)   -- 0..1 each, from low to high
--   local beats, tempo = voice:beats()        -- seconds, and beats per minute
--
-- Loudness is that of EBU R 128, momentary: of the last 0.4 seconds.
local native = require "celspan.native"
local fields = require "celspan.fields"
local spectrum = require "celspan.spectrum"

local sound = {}

-- The sums of src/kit/plugins/sound/loudness.h, one for each step.
local STEP = 0.01 -- seconds
local MOMENTS = 480 -- of a step
local WINDOW = 0.4 -- seconds
local QUIET = -60 -- LUFS that give loudness 0
local RISE = 6 -- dB in ONSET_STEPS: a sound that rises by this begins
local LEAST = -50 -- LUFS that it must reach
-- steps that are compared; least number of steps between two onsets
local ONSET_STEPS, APART = 3, 10

---@class celspan.sound.loudness
---@field seconds number How long it is
local Sound = {}

local BANDS, BANDS_MOST = 24, 96

--- Data that are hidden from scripts: the sums of a sound, 8 bytes each; the paths by which its
--- file is found; its levels by band, once they are asked for.
local sums_of = setmetatable({}, { __mode = "k" })
local paths_of = setmetatable({}, { __mode = "k" })
local levels_of = setmetatable({}, { __mode = "k" })

local read_field = fields.reads("a sound", Sound)
local metatable = {
  __name = "celspan.sound",
  __index = read_field,
  __newindex = function() native.refuse("sounds are immutable") end,
}

local function check(value, method)
  fields.self("sound", metatable, value, method)
end

--- The sum of all steps before step i, counted from 0; after the end the last sum.
local function sum_at(sums, i)
  local last = #sums // 8 - 1
  i = math.max(0, math.min(last, i))
  return (("<d"):unpack(sums, i * 8 + 1))
end

--- The sum of everything before a time; between two steps, in proportion.
local function sum_before(sums, seconds)
  local steps = math.max(0, math.min(#sums / 8 - 1, seconds / STEP))
  local i = math.floor(steps)
  local before, after = sum_at(sums, i), sum_at(sums, i + 1)
  return before + (after - before) * (steps - i)
end

--- LUFS of a mean square.
local function level(square)
  return square > 0 and -0.691 + 10 * math.log(square, 10) or -math.huge
end

local function check_seconds(seconds, method)
  fields.expect(fields.is_finite(seconds), seconds,
    "sound: %s takes seconds, a finite number", method)
end

--- The loudness of the 0.4 seconds before a time: 0 is -60 LUFS or less, 1 is 0 LUFS or more.
---@param seconds number Of the sound
---@return number loudness 0..1
function Sound:loudness(seconds)
  check(self, "loudness")
  check_seconds(seconds, "loudness")
  local sums = sums_of[self]
  local square = sum_before(sums, seconds) - sum_before(sums, seconds - WINDOW)
  local lufs = level(square / (WINDOW / STEP * MOMENTS))
  return math.max(0, math.min(1, 1 - lufs / QUIET))
end

--- The level of the ONSET_STEPS steps before step i.
local function level_before(sums, i)
  return level((sum_at(sums, i) - sum_at(sums, i - ONSET_STEPS)) / (ONSET_STEPS * MOMENTS))
end

--- The step with the steepest rise among the last ONSET_STEPS before i.
local function steepest(sums, i)
  local best, most = i - 1, -1
  for step = i - ONSET_STEPS, i - 1 do
    local rise = sum_at(sums, step + 1) - 2 * sum_at(sums, step) + sum_at(sums, step - 1)
    if step >= 0 and rise > most then best, most = step, rise end
  end
  return best
end

--- The times at which the sound suddenly becomes louder by 6 dB or more, such as beats and
--- syllables, to a hundredth of a second. They are at least a tenth of a second apart.
---@return number[] seconds
function Sound:onsets()
  check(self, "onsets")
  local sums, list, last = sums_of[self], {}, -APART
  for i = 1, #sums // 8 - 1 do
    local now, before = level_before(sums, i), level_before(sums, i - ONSET_STEPS)
    if now >= LEAST and now - before >= RISE then
      local step = steepest(sums, i)
      if step - last >= APART then
        list[#list + 1] = step * STEP
      end
      last = math.max(last, step)
    end
  end
  return list
end

--- The levels of a sound by band. The file is decoded again at the first call, and refused if it is
--- not there any more.
local function levels(self)
  if not levels_of[self] then
    local found, message = native.spectrum(table.unpack(paths_of[self]))
    levels_of[self] = found or native.refuse(message)
  end
  return levels_of[self]
end

--- How loud the sound is around a time, in bands from 40 Hz to 16 kHz whose frequencies have equal
--- ratios: 0 is -60 dB or less, 1 is a sine of full scale.
---@param seconds number Of the sound
---@param bands? integer How many, 1 to 96 (default 24)
---@return number[] levels 0..1 each, from low to high
function Sound:spectrum(seconds, bands)
  check(self, "spectrum")
  check_seconds(seconds, "spectrum")
  bands = bands == nil and BANDS or bands
  local count = math.type(bands) and math.tointeger(bands)
  fields.expect(count and count >= 1 and count <= BANDS_MOST, bands,
    "sound: spectrum takes a number of bands, 1 to %d", BANDS_MOST)
  return spectrum.at(levels(self), seconds, count)
end

--- The beats of music with an even pulse, to a hundredth of a second; none, and 0, where nothing
--- returns.
---@return number[] seconds
---@return number tempo Beats per minute
function Sound:beats()
  check(self, "beats")
  local beats, tempo = spectrum.beats(levels(self))
  if beats then return beats, tempo end
  native.refuse(("sound: the beats of at most %d hours are found, and this one has %.1f")
    :format(spectrum.LONGEST, self.seconds / 3600))
end

--- Reads a sound: WAV, FLAC, MP3, Ogg, Opus or M4A.
---@param file string Relative to the caller's file, else to the script; or an address data:...
---@return celspan.sound.loudness? sound
---@return string? message
function sound.read(file)
  fields.takes("sound: read", "string", "a file name", file)
  local paths = { native.is_data(file) and file or native.find(file) }
  local seconds, sums = native.hear(table.unpack(paths))
  if not seconds then return nil, sums end
  local value = setmetatable({ seconds = seconds }, metatable)
  sums_of[value], paths_of[value] = sums, paths
  return value
end

return fields.publish("sound", sound, Sound)
