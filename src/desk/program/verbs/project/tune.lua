-- Computes the tune of the film, a WAV, in plain Lua:  lua5.4 tune.lua > tune.wav
local when = require "timing"

local RATE, TAU = 16000, 2 * math.pi
local samples = {}
for i = 1, when.length * RATE do samples[i] = 0 end

--- Adds sample(t), t in seconds after `from`.
local function add(from, length, volume, sample)
  local first = math.floor(from * RATE)
  for i = math.max(1, first), math.min(#samples, first + math.floor(length * RATE)) do
    samples[i] = samples[i] + volume * sample((i - first) / RATE)
  end
end

--- Hertz of a note, such as "F#5".
local function pitch(name)
  local letter, sharp, octave = name:match "^(%a)(#?)(%d)$"
  local step = ({ C = -9, D = -7, E = -5, F = -4, G = -2, A = 0, B = 2 })[letter] + #sharp
  return 440 * 2 ^ (step / 12 + octave - 4)
end

--- A bell: three partials, of which the higher ones fade sooner.
local function bell(at, name, volume)
  local w = TAU * pitch(name)
  add(at, 1.6, volume, function(t)
    return math.min(1, 400 * t) * (math.sin(w * t) * math.exp(-3 * t)
      + 0.3 * math.sin(2.01 * w * t) * math.exp(-6 * t)
      + 0.1 * math.sin(4.1 * w * t) * math.exp(-14 * t))
  end)
end

--- Bells one after another; "-" is a rest.
local function play(at, every, volume, names)
  for name in names:gmatch "%S+" do
    if name ~= "-" then bell(at, name, volume) end
    at = at + every
  end
end

--- A soft chord that swells and fades.
local function chord(at, length, volume, names)
  for name in names:gmatch "%S+" do
    local w = TAU * pitch(name)
    add(at, length, volume, function(t)
      return math.sin(math.pi * t / length) * (math.sin(w * t) + math.sin(1.004 * w * t))
    end)
  end
end

chord(0, 3.2, 0.035, "D3 A3 E4 F4") -- the night
play(0.1, 0.34, 0.09, "A6 - F6 E6 D6 - A5") -- the star falls
play(when.crouch + 0.35, 0.1, 0.12, "D4 E4 D4 E4") -- ready ...
local hiss, seed = 0, 1
add(when.leap, 0.5, 1.2, function(t) -- ... and up, with a rush of air
  seed = (1103515245 * seed + 12345) % 2147483648
  hiss = hiss + (0.05 + 0.5 * t) * (seed / 1073741824 - 1 - hiss)
  return hiss * 0.3 * math.sin(TAU * t) ^ 2
end)
play(when.catch, 0.03, 0.16, "D5 F#5 A5 D6") -- caught
add(when.land, 0.3, 0.4, function(t) -- four paws on the roof
  return math.sin(TAU * (90 - 90 * t) * t) * math.exp(-18 * t)
end)
chord(when.lights, 3, 0.04, "D3 A3 D4 F#4 A4") -- the lamps
play(when.lights + 0.25, 0.125, 0.11, "D5 A5 F#5 D6 A5 F#6 D6 A6 F#5 D6 A5 F#6")
play(5, 0.04, 0.1, "D5 A5 D6 F#6")

local bytes = {}
for i, v in ipairs(samples) do
  local ending = math.min(1, (#samples - i) / (0.4 * RATE))
  bytes[i] = ("<i2"):pack(math.floor(32767 * math.max(-1, math.min(1, v * ending))))
end
local data = table.concat(bytes)
io.write(("<c4I4c4c4I4I2I2I4I4I2I2c4I4"):pack("RIFF", 36 + #data, "WAVE", "fmt ", 16, 1, 1, RATE,
  2 * RATE, 2, 16, "data", #data), data)
