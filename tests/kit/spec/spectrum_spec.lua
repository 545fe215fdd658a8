-- The spectrum of a sound and its beats: sines and noise with known powers, and made music.
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

if not present.program "ffmpeg" then return pending "there is no ffmpeg" end

local RATE = 48000

local bench
before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

--- Writes a WAV file of 32-bit floats; sample(t) returns one for each channel.
local function write(seconds, channels, sample)
  local pieces = {}
  for i = 0, math.floor(seconds * RATE) - 1 do
    pieces[#pieces + 1] = ("<" .. ("f"):rep(channels)):pack(sample(i / RATE))
  end
  local data = table.concat(pieces)
  local form = "<c4I4c4c4I4I2I2I4I4I2I2c4I4"
  bench:write("tune.wav", form:pack("RIFF", 36 + #data, "WAVE", "fmt ", 16, 3, channels, RATE,
    RATE * 4 * channels, 4 * channels, 32, "data", #data) .. data)
end

--- What a script prints with this sound, as numbers, and all that it said.
local function printed(body, options)
  bench:write("film.lua", "local tune = assert(require 'celspan.sound'.read 'tune.wav')\n" .. body
    .. "\nreturn require 'celspan'.rostrum {}\n")
  local code, _, err = bench:inside(("'%s' probe film.lua 0 0 %s"):format(workbench.absolute,
    options or ""))
  local numbers = {}
  for line in err:gmatch "[^\n]+" do numbers[#numbers + 1] = tonumber(line) end
  return numbers, code, err
end

local function spectrum(seconds, bands)
  return (printed(("for _, level in ipairs(tune:spectrum(%s, %s)) do print(level) end")
    :format(seconds, bands)))
end

--- The band of a frequency, of `count`.
local function band_of(frequency, count)
  return 1 + math.floor(math.log(frequency / 40) / math.log(400) * count)
end

local function decibels(level) return 60 * level - 60 end

--- White noise from -1 to 1, the same each time.
local function noise()
  local chance = 7
  return function()
    chance = (chance * 1103515245 + 12345) & 0x7fffffff
    return chance / 2 ^ 30 - 1
  end
end

describe("the spectrum of a sound", function()
  it("has the powers of sines, in the bands of their frequencies", function()
    write(1, 1, function(t)
      return 0.5 * math.sin(2 * math.pi * 600 * t) + 0.1 * math.sin(2 * math.pi * 5000 * t)
    end)
    local found = spectrum(0.5, 12)
    local low, high = band_of(600, 12), band_of(5000, 12)
    for i = 1, 12 do
      local wanted = i == low and -6.02 or i == high and -20 or -60
      assert.is_true(math.abs(decibels(found[i]) - wanted) < 0.3, i .. " " .. found[i])
    end
    local whole = 10 * math.log(0.5 ^ 2 + 0.1 ^ 2, 10)
    assert.is_true(math.abs(decibels(spectrum(0.5, 1)[1]) - whole) < 0.3)
  end)

  it("is the mean of all channels, also of three", function()
    for _, channels in ipairs { 2, 3 } do
      write(0.5, channels, function(t) return math.sin(2 * math.pi * 1000 * t), 0, 0 end)
      local level = decibels(spectrum(0.25, 8)[band_of(1000, 8)])
      assert.is_true(math.abs(level + 10 * math.log(channels, 10)) < 0.3, level)
    end
  end)

  it("rises by 3 dB an octave in white noise, as its bands are as wide as they are high", function()
    write(3, 1, noise())
    local sums, count = {}, 96
    local levels = printed("for i = 5, 145 do for _, level in ipairs(tune:spectrum(i / 50, 96)) do "
      .. "print(level) end end")
    for i, level in ipairs(levels) do
      local band = (i - 1) % count + 1
      sums[band] = (sums[band] or 0) + 10 ^ (decibels(level) / 10)
    end
    -- A sine of full scale has twice the power 1/2; this noise has 1/3, evenly up to half the rate.
    for band = 1, count do
      local width = 40 * (400 ^ (band / count) - 400 ^ ((band - 1) / count))
      local wanted = 10 * math.log(2 / 3 * width / (RATE / 2), 10)
      local found = 10 * math.log(sums[band] * count / #levels, 10)
      assert.is_true(math.abs(found - wanted) < 2, ("%d: %g, not %g"):format(band, found, wanted))
    end
  end)

  it("is around its time, 0 beyond the ends, and even between two steps", function()
    write(1, 1, function(t) return t < 0.5 and 0 or math.sin(2 * math.pi * 1000 * t) end)
    local function level(t) return spectrum(t, 1)[1] end
    assert.same({ 0, 0, 0, 0 }, { level(-1), level(0.47), level(1.1), level(1e9) })
    assert.is_true(math.abs(decibels(level(0.6))) < 0.3)
    assert.is_true(math.abs(decibels(level(0.5)) + 3) < 0.5) -- half of the window
    local a, b, c = level(0.49), level(0.495), level(0.5)
    local function power(one) return 10 ^ (decibels(one) / 10) end
    assert.is_true(math.abs(power(b) - (power(a) + power(c)) / 2) < 1e-9)
  end)

  it("refuses what is no number of bands and no time, and a file that has gone", function()
    write(0.1, 1, function() return 0 end)
    for _, case in ipairs { { "0, 0", "a number of bands, 1 to 96, got 0" },
        { "0, 97", "1 to 96, got 97" }, { "0, 1.5", "1 to 96, got 1.5" },
        { "0, 'x'", "1 to 96, got" }, { "0/0", "spectrum takes seconds, a finite number" },
        { "", "spectrum takes seconds" } } do
      local _, code, err = printed(("tune:spectrum(%s)"):format(case[1]))
      assert.truthy(code ~= 0 and err:find(case[2], 1, true), err)
    end
    local _, code, err = printed("os.remove 'tune.wav'; tune:spectrum(0)", "--trust")
    assert.truthy(code ~= 0 and err:find("tune.wav", 1, true), err)
  end)
end)

--- Music: a drum on each beat, which is softer on every other one, a rattle between, and a chord
--- that changes every four beats. late: of beat i, in seconds.
local function music(tempo, seconds, late)
  local gap, hiss = 60 / tempo, noise()
  write(seconds, 1, function(t)
    local beat = math.floor(t / gap)
    local since = t - beat * gap - (late and late(beat) or 0)
    local drum = since >= 0 and (beat % 2 == 0 and 0.5 or 0.3) * math.exp(-since * 25) or 0
    local rattle = 0.06 * math.exp(-(t % (gap / 2)) * 60) * hiss()
    local chord = 0.08 * math.sin(2 * math.pi * (220 * 2 ^ (beat // 4 % 3 * 4 / 12)) * t)
    return drum * math.sin(2 * math.pi * 70 * since) + rattle + chord
  end)
end

local function beats()
  local numbers = printed("local beats, tempo = tune:beats(); print(tempo)\n"
    .. "for _, t in ipairs(beats) do print(t) end")
  return table.remove(numbers, 1), numbers
end

describe("the beats of a sound", function()
  it("are those of music, from slow to fast, with its tempo", function()
    for _, tempo in ipairs { 84, 97, 120, 140 } do
      music(tempo, 12)
      local found, list = beats()
      assert.is_true(math.abs(found / tempo - 1) < 0.01, ("%g, not %g"):format(found, tempo))
      assert.is_true(#list >= 12 * tempo / 60 - 3, #list)
      for _, time in ipairs(list) do
        local off = time - math.floor(time * tempo / 60 + 0.5) * 60 / tempo
        assert.is_true(math.abs(off) <= 0.025, ("%g: %g s off"):format(tempo, off))
      end
    end
  end)

  it("follow players who are not exact", function()
    local function late(beat) return 0.02 * math.sin(beat * 2.3) + 0.02 end
    music(110, 10, late)
    local _, list = beats()
    for _, time in ipairs(list) do
      local beat = math.floor(time * 110 / 60 + 0.3)
      assert.is_true(math.abs(time - beat * 60 / 110 - late(beat)) <= 0.03, time)
    end
  end)

  it("are not looked for in sounds of more than three hours", function()
    local long = setmetatable({}, { __len = function() return 96 * (100 * 3600 * 3 + 1) end })
    assert.is_nil(dofile "lua/celspan/read/spectrum.lua".beats(long))
  end)

  it("are missing in silence, in a tone and in a single blow", function()
    for _, sample in ipairs { function() return 0 end,
        function(t) return 0.5 * math.sin(2 * math.pi * 440 * t) end,
        function(t) return t > 1 and math.exp(-40 * (t - 1)) or 0 end } do
      write(3, 1, sample)
      local tempo, list = beats()
      assert.same({ 0, 0 }, { tempo, #list })
    end
    write(0, 1, function() return 0 end)
    assert.same({ 0 }, (printed "print(select(2, tune:beats()))"))
  end)
end)
