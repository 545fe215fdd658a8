-- The sound of the works: voices that are computed, and mixed into a WAV that a film takes as an
-- address, so that no file has to be made first.
--
--   local sound = score(8)                       -- seconds
--   sound:add(0.5, score.thump(90))              -- at a time; and how loud, and where
--   sound:add(1, score.bell(880, 1.5), 0.4, -0.3)
--   return film { sound = sound:address(), ... }
--
-- A voice is { length =, at = function(t) return -1..1 end }, with t in seconds from its start.

local RATE, TAU = 16000, 2 * math.pi
local sin, exp, floor = math.sin, math.exp, math.floor

local score = {}
score.__index = score

--- Adds a voice at a time; pan is -1 (left) to 1 (right).
function score:add(time, voice, volume, pan)
  local at, first = voice.at, floor(time * RATE)
  local right = (volume or 1) * math.sqrt((1 + (pan or 0)) / 2)
  local left = (volume or 1) * math.sqrt((1 - (pan or 0)) / 2)
  for i = 0, floor(voice.length * RATE) do
    local place = first + i
    if place >= self.count then break end
    local value = at(i / RATE)
    self.left[place] = self.left[place] + left * value
    self.right[place] = self.right[place] + right * value
  end
end

local STEPS = { C = -9, D = -7, E = -5, F = -4, G = -2, A = 0, B = 2 }

--- The frequency of a tone with a name, such as "F#3".
local function named(tone)
  local letter, sharp, octave = tone:match "^(%u)(#?)(%d)$"
  return 440 * 2 ^ ((STEPS[letter] + #sharp) / 12 + tonumber(octave) - 4)
end

--- Noise that is the same in every run.
local state = 1
local function hiss()
  state = (1103515245 * state + 12345) & 0x7fffffff
  return state / 0x40000000 - 1
end

-- ---------------------------------------------------------------- voices

--- A drum or a heavy step: a tone that falls.
function score.thump(hertz, length)
  length = length or 0.3
  local phase = 0
  return { length = length, at = function(t)
    phase = phase + TAU * hertz * (1 + 2.5 * exp(-50 * t)) / RATE
    return sin(phase) * exp(-7 * t / length)
  end }
end

--- A short noise, dull (0.05) to bright (1).
function score.click(brightness, length)
  local low = 0
  return { length = length, at = function(t)
    low = low + brightness * (hiss() - low)
    return low * exp(-6 * t / length)
  end }
end

--- Rain, wind, paper or water: noise that grows for a share of its length, and goes.
function score.wind(brightness, length, share)
  local low = 0
  return { length = length, at = function(t)
    local u = t / length
    low = low + brightness * (hiss() - low)
    return low * (u < share and u / share or (math.max(0, 1 - u) / (1 - share)) ^ 1.5)
  end }
end

--- A tone that is struck and rings; also by its name.
function score.bell(hertz, length)
  if type(hertz) == "string" then hertz = named(hertz) end
  return { length = length, at = function(t)
    return (sin(TAU * hertz * t) + 0.3 * sin(TAU * 2.76 * hertz * t) * exp(-9 * t))
      * exp(-5 * t / length) * math.min(1, 400 * t)
  end }
end

--- A plucked low string.
function score.bass(hertz, length)
  return { length = length, at = function(t)
    local turn = TAU * hertz * t
    return (sin(turn) + 0.5 * sin(2 * turn) * exp(-8 * t) + 0.25 * sin(3 * turn) * exp(-14 * t))
      * exp(-3 * t / length) * math.min(1, 200 * t) * math.min(1, 30 * (length - t))
  end }
end

--- A tone that slides from one pitch to another.
function score.slide(from, to, length)
  local phase = 0
  return { length = length, at = function(t)
    phase = phase + TAU * (from + (to - from) * t / length) / RATE
    return sin(phase) * sin(math.pi * t / length)
  end }
end

-- ---------------------------------------------------------------- the file

local LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"
local pair = {} -- of letters, for each twelve bits
for i = 0, 4095 do
  local high, low = (i >> 6) + 1, (i & 63) + 1
  pair[i] = LETTERS:sub(high, high) .. LETTERS:sub(low, low)
end

local function sample_of(value) return floor(32000 * math.max(-1, math.min(1, value))) end

--- The mix as the bytes of a WAV.
function score:wav()
  local size = 4 * self.count
  local bytes = { string.pack("<c4I4c4c4I4I2I2I4I4I2I2c4I4", "RIFF", size + 36, "WAVE", "fmt ", 16,
    1, 2, RATE, 4 * RATE, 4, 16, "data", size) }
  for i = 0, self.count - 1 do
    bytes[#bytes + 1] = string.pack("<i2i2", sample_of(self.left[i]), sample_of(self.right[i]))
  end
  return table.concat(bytes)
end

--- The mix as an address that a film's sound may be.
function score:address()
  local bytes, parts = self:wav(), {}
  bytes = bytes .. ("\0"):rep(-#bytes % 3)
  for i = 1, #bytes, 3 do
    local a, b, c = bytes:byte(i, i + 2)
    local bits = a << 16 | b << 8 | c
    parts[#parts + 1] = pair[bits >> 12] .. pair[bits & 4095]
  end
  return "data:audio/wav;base64," .. table.concat(parts)
end

--- The address of a score, whose notes are { time, voice, volume, pan }.
function score.play(seconds, notes)
  local mix = score(seconds)
  for _, note in ipairs(notes) do mix:add(table.unpack(note)) end
  return mix:address()
end

return setmetatable(score, { __call = function(_, seconds)
  local self = setmetatable({ count = floor(seconds * RATE), left = {}, right = {} }, score)
  for i = 0, self.count - 1 do self.left[i], self.right[i] = 0, 0 end
  return self
end })
