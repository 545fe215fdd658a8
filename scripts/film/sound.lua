-- Makes the sound of the film, a WAV of its own length, in plain Lua:
--
--   lua5.4 scripts/film/sound.lua OUT.wav [LINE.wav LINE.wav]      from the root of the tree
--
-- Wind, steps in the snow, a music box, the spark and the lamp are computed here, at the times of
-- timing.lua and the steps of acting.txt. The two lines are the lamplighter's words, spoken by
-- espeak-ng; without them the film is silent where he speaks.
package.path = "./scripts/?.lua;" .. package.path
local timing = require "film.timing"

local out_path, first_line, second_line = ...
assert(out_path, "usage: lua5.4 scripts/film/sound.lua OUT.wav [LINE.wav LINE.wav]")

local RATE = 44100
local COUNT = math.floor(timing.seconds * RATE)
local TAU = 2 * math.pi

--- The dry sound, and the sound that goes through the room's echo.
local left, right, room = {}, {}, {}
for i = 1, COUNT do left[i], right[i], room[i] = 0, 0, 0 end

--- Deterministic noise, -1..1.
local seed = 12345
local function noise()
  seed = (1103515245 * seed + 12345) % 2147483648
  return seed / 1073741824 - 1
end

--- Adds `sample(t)`, t in seconds after `from`, for `length` seconds; `pan` -1..1, `wet` is the
--- part that goes into the room.
local function add(from, length, volume, pan, wet, sample)
  local start = math.floor(from * RATE)
  local l, r = volume * math.sqrt((1 - pan) / 2), volume * math.sqrt((1 + pan) / 2)
  for i = math.max(0, start), math.min(COUNT - 1, start + math.floor(length * RATE)) do
    local v = sample((i - start) / RATE)
    left[i + 1], right[i + 1] = left[i + 1] + l * v, right[i + 1] + r * v
    room[i + 1] = room[i + 1] + wet * volume * v
  end
end

--- An envelope 0..1..0 over a length, with rounded shoulders.
local function swell(t, length, rise, fall)
  return math.min(1, t / rise) * math.min(1, math.max(0, (length - t) / fall))
end

-- ---------------------------------------------------------------- weather and ground

local function wind()
  local low, mid = 0, 0
  add(0, timing.seconds, 0.9, 0, 0.1, function(t)
    local gust = 0.5 + 0.25 * math.sin(t * 0.9) + 0.25 * math.sin(t * 0.37 + 2)
    local cut = 0.012 + 0.03 * gust
    low = low + cut * (noise() - low)
    mid = mid + cut * (low - mid)
    return mid * (0.35 + 0.65 * gust) * swell(t, timing.seconds, 1.5, 1.6)
  end)
end

--- Snow that gives way under a boot: a crunch in two parts.
local function step(at, volume, pan)
  local band = 0
  add(at, 0.2, volume, pan, 0.12, function(t)
    local bite = math.exp(-((t - 0.02) / 0.018) ^ 2) + 0.7 * math.exp(-((t - 0.085) / 0.03) ^ 2)
    band = band + 0.34 * (noise() - band)
    return band * bite * (0.6 + 0.4 * noise())
  end)
end

--- The boots touch the ground on the drawings 1 and 5 of the sheet.
local function steps()
  for line in io.lines "scripts/film/acting.txt" do
    local frame, drawing = line:match "^%s+(%d+)%s+(%S+)"
    if drawing == "1" or drawing == "5" or drawing == "halt" then
      local at = (tonumber(frame) - 1) / timing.fps
      local is_near = at < timing.shots[3].from
      local u = is_near and (at - 5.75) / 3.5 or (at - timing.shots[4].from) / 5
      local gone = is_near and 1 or math.max(0, 1 - u)
      step(at, (is_near and 0.5 or 0.16) * gone,
        is_near and -0.7 + 0.7 * u or 0.2 + 0.5 * math.min(1, u))
    end
  end
end

-- ---------------------------------------------------------------- music

--- Semitones above A4, by name: "D5", "F#4".
local function pitch(name)
  local letter, sharp, octave = name:match "^(%a)(#?)(%d)$"
  local semitone = ({ C = -9, D = -7, E = -5, F = -4, G = -2, A = 0, B = 2 })[letter]
  return 440 * 2 ^ ((semitone + (sharp == "#" and 1 or 0)) / 12 + tonumber(octave) - 4)
end

--- A tooth of a music box.
local function tooth(at, name, volume, pan)
  local f = pitch(name)
  add(at, 2.4, volume, pan or 0, 0.55, function(t)
    local strike = math.min(1, t * 900)
    return strike * (math.sin(TAU * f * t) * math.exp(-2.1 * t)
      + 0.34 * math.sin(TAU * 2.003 * f * t) * math.exp(-4.5 * t)
      + 0.16 * math.sin(TAU * 4.1 * f * t) * math.exp(-11 * t))
  end)
end

--- A chord of soft strings.
local function pad(at, length, volume, rise, fall, names)
  for i, name in ipairs(names) do
    local f = pitch(name)
    add(at, length, volume / #names, (i - 1) / (#names - 1) - 0.5, 0.6, function(t)
      local slow = 1 + 0.0018 * math.sin(TAU * 4.6 * t + i)
      local tone = math.sin(TAU * f * slow * t) + 0.5 * math.sin(TAU * f * 1.003 * t)
        + 0.22 * math.sin(TAU * 2 * f * t) + 0.08 * math.sin(TAU * 3 * f * t)
      return tone * swell(t, length, rise, fall)
    end)
  end
end

--- Notes one after another; "-" is a rest.
local function play(from, every, volume, text)
  local at = from
  for name in text:gmatch "%S+" do
    if name ~= "-" then tooth(at, name, volume, 0.3 * math.sin(at * 3)) end
    at = at + every
  end
end

local BEAT = 0.3125

local function music()
  local titles, town = timing.title.from, timing.shots[4].from
  -- The spark writes: the chords of D, B minor, G and A, broken.
  play(titles, BEAT, 0.16, "D5 A5 F#5 D6  B4 F#5 D5 B5  G4 D5 B4 G5  A4 E5 A5 -")
  pad(0.2, 5.9, 0.10, 2, 1.6, { "D3", "A3", "F#4" })
  -- He walks: a little tune in step with him.
  play(6.083, 1 / 3, 0.12, "D5 - F#5 - E5 - D5 - B4 - A4")
  -- The lamp does not light.
  play(timing.puff + 0.55, 0.36, 0.13, "F5 D5 A#4 A4")
  pad(timing.caught, 4.3, 0.08, 1.2, 1.4, { "A#2", "F3", "D4" })
  -- The spark flies up, and the lamp burns.
  play(timing.rises + 0.35, 0.115, 0.10, "A4 D5 E5 F#5 A5 D6 E6 F#6 A6")
  pad(timing.catches + 0.05, 5.2, 0.30, 0.7, 2.2, { "D3", "A3", "D4", "F#4", "A4" })
  play(timing.catches + 0.15, 0.09, 0.15, "D5 F#5 A5 D6 F#6")
  -- The town answers.
  play(town + 0.5, BEAT, 0.17, "D5 A5 F#5 D6  B4 F#5 D5 B5  G4 D5 B5 G5  A4 E5 C#6 A5 "
    .. "D5 F#5 A5 D6 - A5 F#6 - D6")
  pad(town + 1.5, 4, 0.16, 1, 1.5, { "G2", "D3", "B3", "D4" })
  pad(timing.star - 0.2, 3.9, 0.2, 0.8, 2, { "D3", "A3", "F#4", "A4" })
end

-- ---------------------------------------------------------------- the spark and the lamp

--- Glitter where the spark flies: grains of high tones.
local function glitter(from, to, volume)
  local scale = { "D6", "E6", "F#6", "A6", "B6", "D7", "F#7", "A7" }
  local at = from
  while at < to do
    local f = pitch(scale[1 + math.floor((noise() + 1) / 2 * #scale) % #scale])
    local fade = swell(at - from, to - from, 0.3, 0.4)
    add(at, 0.22, volume * fade * (0.4 + 0.6 * math.abs(noise())), noise() * 0.7, 0.8, function(t)
      return math.sin(TAU * f * t) * math.exp(-18 * t) * math.min(1, t * 500)
    end)
    at = at + 0.035 + 0.04 * math.abs(noise())
  end
end

--- A peep that goes from one pitch to another: the voice of the little one.
local function peep(at, low, high, length, volume)
  local phase = 0
  add(at, length, volume, 0.1, 0.5, function(t)
    local u = t / length
    phase = phase + TAU * (low + (high - low) * u * u + 18 * math.sin(TAU * 11 * t)) / RATE
    return math.sin(phase) * math.sin(math.pi * u) ^ 0.8
  end)
end

--- Fizz, and the breath of smoke after it.
local function puff()
  add(timing.spark_in, 0.34, 0.20, 0.25, 0.3, function(t)
    return noise() * math.exp(-6 * t) * (0.5 + 0.5 * math.sin(TAU * 38 * t))
  end)
  local low = 0
  add(timing.puff, 0.7, 0.75, 0.25, 0.4, function(t)
    low = low + 0.07 * (noise() - low)
    return low * math.exp(-((t - 0.09) / 0.13) ^ 2) * 2
  end)
  peep(timing.puff + 0.2, 1500, 700, 0.35, 0.07)
  peep(timing.caught - 0.02, 620, 520, 0.16, 0.06)
end

--- The lamp catches: a soft blow and a warm hum that lasts for a while.
local function kindle()
  for _, at in ipairs { timing.enters + 0.02, timing.enters + 0.3 } do
    add(at, 0.16, 0.16, 0.4, 0.3, function(t) return noise() * math.exp(-26 * t) end)
  end
  local low, slow = 0, 0
  add(timing.catches - 0.06, 1.6, 1.1, 0.3, 0.5, function(t)
    low = low + 0.05 * (noise() - low)
    slow = slow + 0.2 * (low - slow)
    return slow * math.min(1, t / 0.07) * math.exp(-2.6 * t) * 2.2
  end)
  add(timing.catches, 3.2, 0.05, 0.4, 0.2, function(t)
    return (math.sin(TAU * 146.8 * t) + 0.5 * math.sin(TAU * 293.7 * t)) * swell(t, 3.2, 0.4, 1.6)
  end)
end

local function sparks()
  glitter(0.15, timing.title.written + 0.2, 0.05)
  glitter(timing.title.leaves - 0.5, 6, 0.045)
  puff()
  for i = 0, 2 do peep(timing.coaxing + 1.5 + 0.42 * i, 780 + 90 * i, 980 + 140 * i, 0.14,
    0.022 + 0.012 * i) end
  peep(timing.rises + 0.05, 900, 1700, 0.26, 0.08)
  glitter(timing.rises + 0.3, timing.enters, 0.06)
  kindle()
  glitter(timing.catches, timing.catches + 0.9, 0.06)
  glitter(timing.windows + 0.2, timing.windows + 4, 0.022)
  glitter(timing.star_rises, timing.star, 0.045)
  tooth(timing.star + 0.02, "D7", 0.12, 0.3)
  tooth(timing.star + 0.1, "A6", 0.08, 0.3)
end

-- ---------------------------------------------------------------- the voice

--- The samples of a WAV of 16 bits and one channel, -1..1, and the sample rate.
local function read_wav(path)
  local file = assert(io.open(path, "rb"))
  local bytes = file:read "a"
  file:close()
  assert(bytes:sub(1, 4) == "RIFF" and bytes:sub(9, 12) == "WAVE", path .. ": not a WAV")
  local channels, rate, bits = bytes:match "fmt ....\1\0(..)(....)......(..)"
  assert(channels == "\1\0" and bits == "\16\0", path .. ": not 16 bits of one channel")
  local _, at = bytes:find("data....", 1)
  local samples = {}
  for i = at + 1, #bytes - 1, 2 do samples[#samples
    + 1] = string.unpack("<i2", bytes, i) / 32768 end
  return samples, string.unpack("<I4", rate)
end

local function say(path, at, volume)
  if not path then return end
  local samples, rate = read_wav(path)
  add(at, #samples / rate, volume, -0.2, 0.16, function(t)
    local place = t * rate + 1
    local i = math.floor(place)
    local a, b = samples[i] or 0, samples[i + 1] or 0
    return a + (b - a) * (place - i)
  end)
end

-- ---------------------------------------------------------------- the room, and the file

--- Echoes of a narrow street under snow, different on both sides: parallel comb filters.
local function echo(into, delays, volume)
  local damp = 0.35
  for _, delay in ipairs(delays) do
    local line, held, size = {}, 0, math.floor(delay * RATE)
    for i = 0, size - 1 do line[i] = 0 end
    for i = 1, COUNT do
      local k = i % size
      local heard = line[k]
      held = held + damp * (heard - held)
      line[k] = room[i] + 0.74 * held
      into[i] = into[i] + volume * heard
    end
  end
end

--- Normalises the volume, with soft clipping of the loudest samples.
local function write(path)
  local file = assert(io.open(path, "wb"))
  local bytes = COUNT * 4
  file:write(string.pack("<c4I4c4c4I4I2I2I4I4I2I2c4I4", "RIFF", 36 + bytes, "WAVE", "fmt ", 16, 1,
    2, RATE,
    RATE * 4, 4, 16, "data", bytes))
  local block = {}
  for i = 1, COUNT do
    local fade = math.min(1, (COUNT - i) / RATE / 0.8)
    local function coded(v)
      v = v * fade * 1.5
      return math.floor(32000 * v / (1 + math.abs(v) ^ 3) ^ (1 / 3))
    end
    block[#block + 1] = string.pack("<i2i2", coded(left[i]), coded(right[i]))
    if #block == 8192 or i == COUNT then
      assert(file:write(table.concat(block)))
      block = {}
    end
  end
  assert(file:close())
end

wind()
steps()
music()
sparks()
say(first_line, timing.coaxing, 0.95)
say(second_line, timing.thanks, 0.95)
echo(left, { 0.0297, 0.0411, 0.0533 }, 0.16)
echo(right, { 0.0317, 0.0389, 0.0571 }, 0.16)
write(out_path)
