-- Scores that a script plays itself: notes and noises, as an address for the `sound` of a film.
--
--   sound = tones(8, { { 0.5, "pluck", 440 }, { 1, "noise", 0.6, gain = 0.3 } })
--
-- A note is { second, voice, frequency or seconds, gain = 1, to = frequency at its end }:
--   pluck   a music box; its number is a frequency in hertz, or the name of a tone such as "A4"
--   thump   something soft that is hit; a frequency
--   glide   a flute whose tone goes to `to` in `long` seconds
--   noise   rain, wind and paper; its number is how long it lasts, `low` how dull it is, 0..1, and
--           `rise` the share of the time in which it grows
local RATE, TAU = 16000, 2 * math.pi

local STEPS = { C = -9, D = -7, E = -5, F = -4, G = -2, A = 0, B = 2 }

--- Hertz of a number, or of a name such as "F#3".
local function hertz(tone)
  if type(tone) == "number" then return tone end
  local letter, sharp, octave = tone:match "^(%u)(#?)(%d)$"
  return 440 * 2 ^ ((STEPS[letter] + #sharp) / 12 + tonumber(octave) - 4)
end

--- Each voice: how long it lasts, and a function of the seconds since it began.
local voices = {}

function voices.pluck(note)
  local f = TAU * hertz(note[3])
  return 1.6, function(t)
    return math.exp(-3.2 * t) * (math.sin(f * t) + 0.35 * math.exp(-5 * t) * math.sin(3 * f * t)
      + 0.12 * math.exp(-20 * t) * math.sin(6.3 * f * t))
  end
end

function voices.thump(note)
  local f = TAU * hertz(note[3])
  return 0.5, function(t)
    return math.exp(-11 * t) * math.sin(f * t * (0.6 + 0.4 * math.exp(-14 * t)))
  end
end

function voices.glide(note)
  local from, to, long = hertz(note[3]), hertz(note.to), note.long or 0.5
  return long, function(t)
    local turns = from * t + (to - from) * t * t / (2 * long)
    local loud = math.max(0, math.sin(math.pi * t / long)) ^ 0.5
    return loud * (math.sin(TAU * turns) + 0.2 * math.sin(2 * TAU * turns))
  end
end

function voices.noise(note)
  local long, low, rise = note[3], note.low or 0.5, note.rise or 0.05
  local seed, value = 1234567, 0
  return long, function(t)
    seed = (1103515245 * seed + 12345) % 2147483648
    value = value + (1 - low) * (seed / 1073741824 - 1 - value)
    local u = t / long
    return value * (u < rise and u / rise or ((1 - u) / (1 - rise)) ^ 1.5)
  end
end

local LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"

--- Bytes, three at a time, as four letters; their number must be a multiple of three.
local function base64(bytes)
  local pairs_of = {} -- two letters for each 12 bits
  for i = 0, 4095 do
    local a, b = i // 64 + 1, i % 64 + 1
    pairs_of[i] = LETTERS:sub(a, a) .. LETTERS:sub(b, b)
  end
  local list = {}
  for i = 1, #bytes, 3 do
    local a, b, c = bytes:byte(i, i + 2)
    list[#list + 1] = pairs_of[a << 4 | b >> 4] .. pairs_of[(b & 15) << 8 | c]
  end
  return table.concat(list)
end

return function(seconds, notes)
  local count = seconds * RATE // 3 * 3 + 2 -- with the 44 bytes of the head a multiple of three
  local mix, samples = {}, {}
  for i = 1, count do mix[i] = 0 end
  for _, note in ipairs(notes) do
    local long, voice = voices[note[2]](note)
    local start, gain = math.floor(note[1] * RATE), 0.3 * (note.gain or 1)
    for i = 1, math.min(count - start, math.floor(long * RATE)) do
      mix[start + i] = mix[start + i] + gain * voice(i / RATE)
    end
  end
  for i = 1, count do
    samples[i] = ("<i2"):pack(math.floor(32000 * math.max(-1, math.min(1, mix[i]))))
  end
  local head = ("<c4I4c4c4I4I2I2I4I4I2I2c4I4"):pack("RIFF", 36 + 2 * count, "WAVE", "fmt ", 16,
    1, 1, RATE, 2 * RATE, 2, 16, "data", 2 * count)
  return "data:audio/wav;base64," .. base64(head .. table.concat(samples))
end
