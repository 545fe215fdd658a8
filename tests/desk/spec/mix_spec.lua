-- The sounds of a film: their mix is compared with a sum that is computed here in doubles, their
-- loudness with that of ffmpeg. One file, because all cases share that sum.

local present = require "tests.support.present"
local prng = require "tests.support.prng"
local workbench = require "tests.support.workbench"

local RATE = 48000
local STEP = 1 / 32768 -- of 16 bits

local has_ffmpeg = present.program "ffmpeg"
local it_mixes = has_ffmpeg and it or pending

-- ---------------------------------------------------------------- WAV files

--- A WAV file of 32-bit floats, or of 16 bits. moments: lists of a sample for each channel.
local function wav(moments, options)
  options = options or {}
  local rate, channels = options.rate or RATE, options.channels or moments[1] and #moments[1] or 1
  local is_short, parts = options.is_short, {}
  for i, moment in ipairs(moments) do
    parts[i] = is_short and ("<i2"):rep(channels):pack(table.unpack(moment))
      or ("<f"):rep(channels):pack(table.unpack(moment))
  end
  local data, size = table.concat(parts):rep(options.times or 1), is_short and 2 or 4
  return ("<c4I4c4c4I4I2I2I4I4I2I2c4I4"):pack("RIFF", 36 + #data, "WAVE", "fmt ", 16,
    is_short and 1 or 3, channels, rate, rate * channels * size, channels * size, 8 * size, "data",
    #data) .. data
end

--- Noise: no two samples are alike, so one that is moved is found.
local function noise(seconds, channels, seed)
  local random, moments = prng.new(seed), {}
  for i = 1, math.floor(seconds * RATE + 0.5) do
    local moment = {}
    for c = 1, channels do
      moment[c] = ("<f"):unpack(("<f"):pack(random:between(-0.25, 0.25)))
    end
    moments[i] = moment
  end
  return moments
end

--- Silence with short bursts at these times.
local function clicks(seconds, times, rate)
  local burst, data = ("<i2<i2"):pack(20000, -20000):rep(rate // 400), {}
  local silence, at = "\0\0", 0
  for _, time in ipairs(times) do
    local place = math.floor(time * rate + 0.5)
    data[#data + 1] = silence:rep(place - at) .. burst
    at = place + #burst // 2
  end
  data[#data + 1] = silence:rep(math.floor(seconds * rate + 0.5) - at)
  local bytes = table.concat(data)
  return ("<c4I4c4c4I4I2I2I4I4I2I2c4I4"):pack("RIFF", 36 + #bytes, "WAVE", "fmt ", 16, 1, 1, rate,
    rate * 2, 2, 16, "data", #bytes) .. bytes
end

--- left, right: lists of the samples of a file that celspan wrote.
local function read_wav(bytes)
  assert.are.equal("RIFF", bytes:sub(1, 4))
  assert.are.equal(#bytes - 8, (("<I4"):unpack(bytes, 5)))
  local code, channels, rate = ("<I2I2I4"):unpack(bytes, 21)
  assert.are.same({ 2, RATE }, { channels, rate })
  local _, at = bytes:find("data....", 37)
  assert.are.equal(#bytes - at, (("<I4"):unpack(bytes, at - 3)))
  local left, right = {}, {}
  local form, scale, size = "<i2i2", STEP, 4
  if code == 3 then form, scale, size = "<ff", 1, 8 end
  for place = at + 1, #bytes, size do
    local a, b = form:unpack(bytes, place)
    left[#left + 1], right[#right + 1] = a * scale, b * scale
  end
  return left, right
end

-- ---------------------------------------------------------------- the sum

--- The mix in doubles. sounds: { moments =, at =, from =, to =, gain =, fade =, pan =, ducked = {
--- { begin, end } } }
local function sum(sounds, seconds)
  local left, right = {}, {}
  for i = 1, math.floor(seconds * RATE + 0.5) do left[i], right[i] = 0, 0 end
  for _, s in ipairs(sounds) do
    local at, from = s.at or 0, s.from or 0
    local length = math.min(s.to or 1e9, #s.moments / RATE) - from
    local fade, pan = s.fade or { 0, 0 }, s.pan or 0
    local angle = (pan + 1) * math.pi / 4
    local sides = { math.sqrt(2) * math.cos(angle), math.sqrt(2) * math.sin(angle) }
    for i = math.max(0, math.floor(at * RATE + 0.5)),
            math.min(#left, math.floor((at + length) * RATE + 0.5)) - 1 do
      local time, gain = i / RATE, s.gain or 1
      if fade[1] > 0 then gain = gain * math.max(0, math.min(1, (time - at) / fade[1])) end
      if fade[2] > 0 then gain = gain * math.max(0, math.min(1, (at + length - time) / fade[2])) end
      local far = 1
      for _, duck in ipairs(s.ducked or {}) do
        local before, after = duck[1] - time, time - duck[2] + 1 / RATE
        local ramp = before > 0 and (duck.attack or 0.1) or duck.release or 0.1
        local up = math.min(1, math.max(0, before, after) / ramp)
        local low = 10 ^ (-(duck.depth or 12) / 20)
        far = math.min(far, low + (1 - low) * up)
      end
      gain = gain * far
      local moment = s.moments[i - math.floor((at - from) * RATE + 0.5) + 1]
      left[i + 1] = left[i + 1] + moment[1] * gain * sides[1]
      right[i + 1] = right[i + 1] + (moment[2] or moment[1]) * gain * sides[2]
    end
  end
  return left, right
end

local function worst(list, wanted)
  assert.are.equal(#wanted, #list)
  local most = 0
  for i = 1, #list do most = math.max(most, math.abs(list[i] - wanted[i])) end
  return most
end

-- ---------------------------------------------------------------- films

local FILM = [[
local celspan = require "celspan"
local cut = require "celspan.cut"
local function film(fields)
  fields.size = { 8, 8 }
  fields.frame = function() return celspan.rostrum {} end
  return celspan.film(fields)
end
]]

local bench

before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

local function run(arguments, ...) return bench:celspan_inside(arguments, ...) end

--- The mix of a script.
local function mix(script, arguments)
  bench:write("film.lua", FILM .. script)
  local code, _, err = run("sound film.lua -o mix.wav %s", arguments or "")
  assert.are.equal(0, code, err)
  local left, right = read_wav(bench:read "mix.wav")
  return left, right, err
end

local LIST = [[
return film { fps = 24, duration = 0.75, sound = {
  { "mono.wav", at = 0.25, from = 0.05, to = 0.3, gain = 0.5, fade = { 0.05, 0.1 }, pan = -0.5,
    duck = "music" },
  false,
  { "stereo.wav", at = -0.05, name = "music", fade = { 0, 0.2 } },
  { "mono.wav", at = 0.7, pan = 1, gain = 1.5, name = "voice" },
  "mono.wav",
} }
]]

describe("the mix of a film", function()
  local mono, stereo

  local function write_sounds()
    mono, stereo = noise(0.4, 1, 1), noise(0.75, 2, 2)
    bench:write("mono.wav", wav(mono))
    bench:write("stereo.wav", wav(stereo))
  end
  local function sum_list()
    return sum({
      { moments = mono, at = 0.25, from = 0.05, to = 0.3, gain = 0.5, fade = { 0.05, 0.1 },
        pan = -0.5 },
      { moments = stereo, at = -0.05, fade = { 0, 0.2 }, ducked = { { 0.25, 0.5 } } },
      { moments = mono, at = 0.7, pan = 1, gain = 1.5 },
      { moments = mono },
    }, 0.75)
  end

  it_mixes("is the sum of its sounds, within a step of 16 bits", function()
    write_sounds()
    local left, right = sum_list()
    for depth, step in pairs { ["16"] = STEP, float = 1e-6 } do
      local l, r = mix(LIST, "--depth " .. depth)
      assert.is_true(worst(l, left) <= step, depth .. worst(l, left))
      assert.is_true(worst(r, right) <= step, depth .. worst(r, right))
    end
  end)

  it_mixes("is the same wherever it begins", function()
    write_sounds()
    local left, right = mix(LIST, "--depth float")
    for _, frames in ipairs { { 5, 15 }, { 18, 18 } } do
      local l, r = mix(LIST, ("--depth float --frames %d-%d"):format(frames[1], frames[2]))
      local first = (frames[1] - 1) * 2000
      assert.are.equal((frames[2] - frames[1] + 1) * 2000, #l)
      for i = 1, #l do
        if l[i] ~= left[first + i] or r[i] ~= right[first + i] then
          error(("frames %d-%d differ at sample %d"):format(frames[1], frames[2], i))
        end
      end
    end
  end)

  it_mixes("is the sum of sounds that are too long to keep", function()
    local piece, moments = noise(0.25, 1, 3), {}
    for i = 1, 11.5 * RATE do moments[i] = piece[(i - 1) % #piece + 1] end
    bench:write("long.wav", wav(piece, { times = 46 }))
    local left, right = mix([[return film { fps = 24, duration = 0.5, sound = {
      { "long.wav", from = 11.23, at = 0.05, fade = { 0, 0.1 }, duck = "music" },
      { "long.wav", at = -10.6, to = 10.9, name = "music" } } }]], "--depth float")
    local l, r = sum({ { moments = moments, from = 11.23, at = 0.05, fade = { 0, 0.1 } },
      { moments = moments, at = -10.6, to = 10.9, ducked = { { 0.05, 0.32 } } } }, 0.5)
    assert.is_true(worst(left, l) <= 1e-6 and worst(right, r) <= 1e-6)
  end)

  it_mixes("decodes a file once for all sounds that need only its beginning", function()
    local piece = noise(0.25, 1, 4)
    bench:write("long.wav", wav(piece, { times = 46 }))
    local left = mix([[
local sounds = {}
for i = 1, 70 do sounds[i] = { "long.wav", gain = 1 / 128 } end
return film { fps = 24, duration = 0.25, sound = sounds }]], "--depth float")
    local wanted = {}
    for i, moment in ipairs(piece) do wanted[i] = 70 / 128 * moment[1] end
    assert.is_true(worst(left, wanted) <= 1e-6)
  end)

  it_mixes("makes way as deep and as fast as it says, for the strongest of the sounds", function()
    write_sounds()
    local left, right = mix([[return film { fps = 24, duration = 0.75, sound = {
      { "stereo.wav", name = "music" },
      { "mono.wav", at = 0.2, to = 0.1, duck = "music", duck_depth = 6, duck_attack = 0.15,
        duck_release = 0.3 },
      { "mono.wav", at = 0.4, to = 0.05, duck = "music", duck_depth = 20, duck_attack = 0.02,
        duck_release = 0.01 } } }]], "--depth float")
    local l, r = sum({ { moments = mono, at = 0.2, to = 0.1 },
      { moments = mono, at = 0.4, to = 0.05 },
      { moments = stereo, ducked = { { 0.2, 0.3, depth = 6, attack = 0.15, release = 0.3 },
        { 0.4, 0.45, depth = 20, attack = 0.02, release = 0.01 } } } }, 0.75)
    assert.is_true(worst(left, l) <= 1e-6 and worst(right, r) <= 1e-6)
  end)

  it_mixes("has music of a cut that makes way for the voices of its shots", function()
    write_sounds()
    for under, ducked in pairs { voice = { { 0.35, 0.45 } }, second = { { 0.25, 0.65 } } } do
      local left, right = mix([[
local cut = require "celspan.cut"
local shot = film { fps = 24, frames = 6 }
local talk = film { fps = 24, frames = 12, sound = { { "mono.wav", to = 0.4, pan = -1 },
  { "mono.wav", at = 0.1, to = 0.1, name = "voice" } } }
return cut { shot, { film = talk, name = "second" },
  sound = { "stereo.wav", under = "]] .. under .. [[" } }]], "--depth float")
      local l, r = sum({ { moments = mono, at = 0.25, to = 0.4, pan = -1 },
        { moments = mono, at = 0.35, to = 0.1 }, { moments = stereo, ducked = ducked } }, 0.75)
      assert.is_true(worst(left, l) <= 1e-6 and worst(right, r) <= 1e-6, under)
    end
  end)

  it_mixes("can be that of another film, in which everything moves", function()
    write_sounds()
    local left, right = mix([[
local inner = film { fps = 24, duration = 0.75, sound = { { "mono.wav", at = 0.1,
  fade = { 0.15, 0 }, duck = "m" }, { "stereo.wav", name = "m", pan = 0.5 } } }
return film { fps = 24, frames = 18, sound_offset = -0.1, sound = { inner, at = 0.25, from = 0.15,
  to = 0.55, gain = 0.7, fade = { 0.05, 0.1 }, pan = -1 } }]], "--depth float")
    local inner_left = sum({ { moments = mono, at = 0.1, fade = { 0.15, 0 } },
      { moments = stereo, pan = 0.5, ducked = { { 0.1, 0.5 } } } }, 0.75)
    for i = 0, #left - 1 do -- second 0 of both films is the same moment
      local time, wanted = i / RATE, 0
      if i >= 7200 and i < 26400 then
        local fade = math.min(1, (time - 0.15) / 0.05, (0.55 - time) / 0.1)
        wanted = inner_left[i + 1] * fade * 0.7 * math.sqrt(2)
      end
      if math.abs(left[i + 1] - wanted) > 1e-6 or math.abs(right[i + 1]) > 1e-9 then
        error(("%g s: %g, not %g"):format(time, left[i + 1], wanted))
      end
    end
  end)

  it_mixes("has one sound that was given as a name", function()
    write_sounds()
    local left, right = mix "return film { duration = .5, sound = 'mono.wav', sound_offset = .25 }"
    local l, r = sum({ { moments = mono, at = 0.25 } }, 0.5)
    assert.is_true(worst(left, l) <= STEP and worst(right, r) <= STEP)
  end)

  it_mixes("says where it is too loud for 16 bits", function()
    write_sounds()
    local _, _, err = mix "return film { duration = .5, sound = { 'mono.wav', gain = 8 } }"
    assert.truthy(err:find "mix.wav: the mix is up to 6.0 dB louder than full scale, and cut there",
      err)
    _, _, err = mix "return film { duration = .5, sound = { 'mono.wav', gain = 4 } }"
    assert.are.equal("", err)
  end)

  it_mixes("goes into videos", function()
    if not present.program "ffprobe" then return pending "there is no ffprobe" end
    write_sounds()
    local left = mix(LIST)
    local code, _, err = run "render film.lua -o film.mov --progress none"
    assert.are.equal(0, code, err)
    code, _, err = bench:inside "ffmpeg -v error -i film.mov -f s16le -ar 48000 -ac 2 - >raw"
    assert.are.equal(0, code, err)
    local raw = bench:read "raw"
    assert.are.equal(#left * 4, #raw)
    for i = 1, #left do
      local found = ("<i2"):unpack(raw, i * 4 - 3) * STEP
      if math.abs(found - left[i]) > STEP then error(("sample %d"):format(i)) end
    end
  end)
end)

describe("sound and pictures", function()
  local RATES = { ["24"] = 24, ["24000/1001"] = 24000 / 1001, ["30"] = 30, ["60"] = 60 }

  --- The time of the first loud sample.
  local function onset(list, rest)
    for i = rest or 1, #list do
      if math.abs(list[i]) > 0.1 then return (i - 1) / RATE, i end
    end
  end

  for text, fps in pairs(RATES) do
    it_mixes("are in step after ten minutes at " .. text, function()
      bench:write("click.wav", clicks(0.1, { 0 }, RATE))
      local last = math.floor(600 * fps)
      local script = ([[
local fps = %s
return film { fps = fps, frames = %d, sound = { { "click.wav", at = %d / fps },
  { "click.wav", at = 0.5 } } }]]):format(text, last, last - 12)
      local left = mix(script, ("--frames %d-%d"):format(last - 24, last))
      assert.are.equal(math.floor(25 / fps * RATE + 0.5), #left)
      assert.is_true(math.abs(onset(left) - 13 / fps) < 1e-3, onset(left))
    end)
  end

  it_mixes("are in step at other rates of the sound", function()
    for _, rate in ipairs { 8000, 44100, 96000 } do
      bench:write("click.wav", clicks(20, { 0.1, 19.75 }, rate))
      local script = "return film { duration = 20, sound = 'click.wav' }"
      local first, last = onset((mix(script, "--frames 1-6"))), onset((mix(script,
        "--frames 19.5s-20s")))
      assert.is_true(math.abs(first - 0.1) < 1e-3, ("%d: %g"):format(rate, first))
      assert.is_true(math.abs(last - 0.25) < 1e-3, ("%d: %g"):format(rate, last))
    end
  end)
end)

describe("a sound at another speed", function()
  it_mixes("keeps its pitch and is as long as its pictures", function()
    local moments = {}
    for i = 0, RATE - 1 do moments[i + 1] = { 0.5 * math.sin(2 * math.pi * 500 * i / RATE) } end
    bench:write("tone.wav", wav(moments))
    for _, speed in ipairs { 0.4, 3 } do
      local left = mix(([[
local shot = film { fps = 24, frames = 24, sound = "tone.wav" }
return cut { { film = shot, speed = %g } }]]):format(speed))
      assert.are.equal(math.ceil(24 / speed) * 2000, #left)
      local middle, crossings, last = #left // 2, 0, 0
      for i = middle - 6000, middle + 5999 do
        if left[i] < 0 and left[i + 1] >= 0 then crossings = crossings + 1 end
      end
      assert.is_true(math.abs(crossings - 125) <= 2, ("%g: %d"):format(speed, crossings))
      for i = 1, #left do if math.abs(left[i]) > 0.1 then last = i end end
      assert.is_true(math.abs(last / RATE - 1 / speed) < 0.05, ("%g: %g"):format(speed, last))
    end
  end)

  it_mixes("stays in step with its shot", function()
    bench:write("click.wav", clicks(8, { 0.5, 3, 7 }, RATE))
    local left = mix [[
local shot = film { fps = 24, frames = 192, sound = "click.wav" }
local lead = film { fps = 24, frames = 24 }
return cut { lead, { film = shot, from = 61, to = 180, speed = 2 } }]]
    -- The clicks at 3 s and 7 s of the sound. The sound begins after 1 s of the film, with its
    -- second 2.5, and is twice as fast.
    local seen, quiet = {}, -RATE
    for i = 1, #left do
      if math.abs(left[i]) > 0.1 then
        if i - quiet > RATE / 2 then seen[#seen + 1] = i / RATE end
        quiet = i
      end
    end
    assert.are.equal(2, #seen)
    assert.is_true(math.abs(seen[1] - 1.25) < 0.03, seen[1])
    assert.is_true(math.abs(seen[2] - 3.25) < 0.03, seen[2])
  end)
end)

describe("a sound that cannot be mixed", function()
  local function refuses(code, pattern, sound, command)
    pattern = pattern:gsub("%.", "%%.")
    bench:write("film.lua", FILM .. "return film { duration = 1, sound = " .. sound .. " }")
    local got, _, err = run(command or "sound film.lua -o mix.wav")
    assert.are.equal(code, got, err)
    assert.truthy(err:find(pattern), err)
    assert.falsy(bench:read "mix.wav", "a file was written")
  end

  it_mixes("is refused with its file, field and value", function()
    bench:write("short.wav", clicks(0.5, { 0 }, 8000))
    bench:write("empty.wav", clicks(0, {}, 8000))
    bench:write("text.wav", "no sound at all")
    local from = "film: sound 2: field 'from' must be below the length of short.wav, 0.5 seconds, "
      .. "got 0.75"
    refuses(4, from, "{ { 'short.wav' }, { 'short.wav', from = 0.75 } }")
    refuses(4, from, "{ { 'short.wav' }, { 'short.wav', from = 0.75 } }", "check --deep film.lua")
    refuses(4, "field 'from' must be below the length of empty.wav, 0 seconds, got 1",
      "{ 'empty.wav', from = 1 }")
    refuses(4, "film: sound 2: the sound nowhere.wav cannot be opened: No such file",
      "{ { 'short.wav' }, { 'nowhere.wav' } }")
    refuses(4, "film: sound 2: the sound nowhere.wav cannot be opened: No such file",
      "{ { 'short.wav' }, { 'nowhere.wav' } }", "check film.lua")
    refuses(4, "the sound text.wav has none of the formats", "{ 'text.wav' }")
  end)

  it_mixes("is heard as silence if it is silent, or has three samples in a second", function()
    bench:write("silent.wav", clicks(1, {}, RATE))
    bench:write("empty.wav", clicks(0, {}, RATE))
    bench:write("slow.wav", clicks(1, {}, 3))
    local left = mix [[return film { duration = .4, sound = { { "silent.wav" }, { "empty.wav" },
      { "slow.wav" } } }]]
    assert.are.equal(0, math.max(table.unpack(left, 1, 20000)))
    assert.are.equal(0, math.min(table.unpack(left, 1, 20000)))
  end)

  it_mixes("is refused if films in films make it too slow", function()
    bench:write("click.wav", clicks(0.5, { 0 }, 8000))
    bench:write("film.lua", FILM .. [[
local inner = film { duration = 1, sound = "click.wav" }
for _ = 1, 2 do inner = film { duration = 10, sound = { inner, speed = 0.02 } } end
return inner]])
    local code, _, err = run "sound film.lua -o mix.wav"
    assert.are.equal(3, code)
    assert.truthy(err:find("film: sound 1: click.wav: it is heard at 0.0004 times its speed", 1,
      true), err)
    bench:inside "sed -i \"s|click.wav|DATA:;base64,$(base64 -w 0 click.wav)|\" film.lua"
    code, _, err = run "sound film.lua -o mix.wav"
    assert.are.equal(3, code)
    assert.truthy(err:find("film: sound 1: data:...: it is heard at 0.0004 times", 1, true), err)
  end)

  it("is refused if films are sounds of films more than 1000 deep", function()
    bench:write("film.lua", FILM .. [[
local inner = film { duration = 1, sound = "click.wav" }
for _ = 1, 1001 do inner = film { duration = 1, sound = { { inner } } } end
return inner]])
    local code, _, err = run "sound film.lua -o mix.wav"
    assert.are.equal(3, code)
    assert.truthy(err:find("the film has sounds that are films more than 1000 deep, which is the "
      .. "limit", 1, true), err)
  end)

  it("is refused at the script's line if its fields are wrong", function()
    for sound, message in pairs {
      ["{ 'a.wav', gain = -1 }"] = "film: sound 1: gain is %-1; it must be between 0 and 1000",
      ["{ 'a.wav', pan = 2 }"] = "film: sound 1: pan is 2; it must be between %-1 and 1",
      ["{ 'a.wav', speed = 0 }"] = "film: sound 1: speed is 0; it must be between 0.01 and 100",
      ["{ 'a.wav', from = 2, to = 1 }"] = "film: sound 1: field 'to' must be above 'from', 2, ",
      ["{ 'a.wav', fade = { 1 } }"] = "film: sound 1: fade%[2%] must be a number, got nil",
      ["{ 'a.wav', fade = { 1, -1 } }"] = "film: sound 1: fade%[2%] must be 0 or more seconds",
      ["{ 'a.wav', volume = 1 }"] = "film: sound 1: unknown field 'volume'",
      ["{ { 'a.wav' }, { 'b.wav', duck = 'musik' } }"] = "film: sound 2: field 'duck' must be the "
        .. 'name of another sound of the film, got "musik", which none has',
      ["{ { 'a.wav' }, { 'b.wav', under = 'c' } }"] = "film: sound 2: field 'under' must be the",
      ["{ 'a.wav', duck_depth = -1 }"] = "film: sound 1: duck_depth is %-1; it must be "
        .. "between 0 and 200",
      ["{ { 'a.wav', name = 'x', duck = 'x' } }"] = "film: sound 1: field 'duck' must be the name",
      ["{ at = 1 }"] = 'film: sound 1: must be the name of a file or a film, { "voice.wav", at = 2 '
        .. "}, got nil",
      ["{ { '' } }"] = "film: sound 1: the name of the file is an empty text",
      ["{ { 'a.wav' }, 7 }"] = "film: sound 2: must be the name of a file, got number",
      ["{ 'a.wav', 'b.wav' }"] = "film: sound 1: takes one file",
      ["7"] = "film: field 'sound' must be the name of a file, { \"voice.wav\", at = 2 } or a list",
    } do
      bench:write("film.lua", "local celspan = require 'celspan'\nlocal film = celspan.film { "
        .. "sound =\n" .. sound .. ", frame = function() end }\nreturn film\n")
      local code, _, err = run "check film.lua"
      assert.are.equal(3, code, err)
      assert.truthy(err:find("film.lua:%d: " .. message), err)
    end
  end)

  it("is refused by the verb if there is none, or its name is no WAV file", function()
    bench:write("film.lua", FILM .. "return film { sound = {} }")
    for arguments, message in pairs {
      ["-o mix.wav"] = "film.lua: the film has no sound",
      [""] = "%-o is missing: the file to write, such as mix.wav",
      ["-o mix.mp3"] = "mix.mp3: a sound is written as WAV: give a name such as mix.wav",
      ["-o mix.wav --depth 8"] = "mix.wav: a sound takes %-%-depth 16 or float",
    } do
      local code, _, err = run("sound film.lua %s", arguments)
      assert.are.equal(2, code, err)
      assert.truthy(err:find(message), err)
    end
    bench:write("film.lua", FILM .. "return film { frames = 9, sound = { film {} } }")
    local code, _, err = run "sound film.lua -o mix.wav --frames 1-7:2"
    assert.are.equal(2, code, err)
    assert.truthy(err:find "goes with one run of frames", err)
  end)
end)

describe("the loudness of a sound", function()
  --- What a script prints with this sound, as numbers.
  local function printed(body)
    bench:write("film.lua", "local sound = require 'celspan.sound'\n"
      .. "local voice = assert(sound.read 'voice.wav')\n" .. body
      .. "\nreturn require 'celspan'.rostrum {}\n")
    local code, _, err = run "probe film.lua 0 0"
    assert.are.equal(0, code, err)
    local numbers = {}
    for line in err:gmatch "[^\n]+" do numbers[#numbers + 1] = tonumber(line) end
    return numbers
  end

  it_mixes("is that of ffmpeg, within 0.1 LU", function()
    for _, source in ipairs {
      "aevalsrc=0.3*sin(2*PI*(200+300*t)*t)*(0.2+0.8*mod(t\\,1)):d=3:s=44100",
      "anoisesrc=d=2:a=0.1:seed=1:r=48000,pan=stereo|c0=c0|c1=0.3*c0",
      "anoisesrc=d=2:a=0.1:seed=2:r=48000,pan=5.1|c0=0*c0|c3=c0|c4=c0|c5=0.5*c0",
    } do
      local code, _, err = bench:inside(("ffmpeg -v error -y -f lavfi -i '%s' voice.wav && ffmpeg "
        .. "-v error -i voice.wav -af ebur128=metadata=1,ametadata=print:key=lavfi.r128.M:file=- "
        .. "-f null - >meter"):format(source))
      assert.are.equal(0, code, err)
      local wanted = {}
      for level in bench:read("meter"):gmatch "r128.M=(%S+)" do
        wanted[#wanted + 1] = tonumber(level)
      end
      assert.is_true(#wanted >= 20)
      local found = printed(("for i = 1, %d do print(voice:loudness(i / 10)) end"):format(#wanted))
      for i = 4, #wanted do -- before, ffmpeg has heard less than 0.4 seconds
        local level = wanted[i]
        local lufs = found[i] * 60 - 60
        assert.is_true(level < -60 and lufs <= -59.9 or math.abs(lufs - level) <= 0.1,
          ("%s, %g s: %g, not %g"):format(source, i / 10, lufs, level))
      end
    end
  end)

  it_mixes("is 0 in silence and beyond the ends", function()
    bench:write("voice.wav", clicks(1, { 0.5 }, 8000))
    local numbers = printed("for _, t in ipairs { -5, 0, .4, .6, .95, 99 } do\n"
      .. "print(voice:loudness(t)) end\nprint(voice.seconds)")
    assert.are.same({ 0, 0, 0, 0, 0 }, { numbers[1], numbers[2], numbers[3], numbers[5],
      numbers[6] })
    assert.is_true(numbers[4] > 0.5 and numbers[7] == 1)
    bench:write("voice.wav", clicks(0, {}, 8000))
    assert.are.same({ 0, 0, 0 }, printed("print(voice:loudness(0))\nprint(#voice:onsets())\n"
      .. "print(voice.seconds)"))
  end)

  it_mixes("is that of an address, however it is written", function()
    bench:write("voice.wav", clicks(0.5, { 0.2 }, 8000))
    for _, word in ipairs { "data", "Data" } do
      bench:inside(("(printf '%s:;base64,'; base64 -w 0 voice.wav) >address"):format(word))
      local body = "voice = assert(sound.read [[%s]])\nprint(voice.seconds)"
      assert.are.same({ 0.5 }, printed(body:format(bench:read "address")))
    end
  end)

  it_mixes("has the times at which something begins", function()
    local times = { 0.25, 0.5, 1.003, 1.7, 1.9 }
    bench:write("voice.wav", clicks(3, times, RATE))
    local numbers = printed "for _, t in ipairs(voice:onsets()) do print(t) end"
    assert.are.equal(#times, #numbers)
    for i, time in ipairs(times) do
      assert.is_true(math.abs(numbers[i] - time) <= 0.01, numbers[i])
    end
    bench:inside "ffmpeg -v error -y -f lavfi -i 'sine=f=33:d=2,volume=4' voice.wav"
    assert.are.equal(1, #printed "for _, t in ipairs(voice:onsets()) do print(t) end")
  end)

  it_mixes("makes frames again when the sound changes", function()
    bench:write("film.lua", [[
local celspan = require "celspan"
local voice = assert(require "celspan.sound".read "voice.wav")
return celspan.film { size = { 8, 8 }, frames = 24, frame = function(f)
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 8, 8 * voice:loudness(f.time) } } }
end }]])
    local function render()
      local code, _, err = run "render film.lua -o out.####.png --resume --progress none"
      assert.are.equal(0, code, err)
      return bench:read "out.0020.png"
    end
    bench:write("voice.wav", clicks(1, { 0.5 }, 8000))
    local before = render()
    assert.are.equal(before, render())
    bench:write("voice.wav", clicks(1, { 0.2 }, 8000))
    assert.are_not.equal(before, render())
  end)

  it("is not there for a file that cannot be read", function()
    bench:write("film.lua", [[
print(require "celspan.sound".read "nowhere.wav")
print(select(2, pcall(require "celspan.sound".read, 7)))
return require "celspan".rostrum {}]])
    local code, _, err = run "probe film.lua 0 0"
    assert.are.equal(0, code, err)
    assert.truthy(err:find("nil\tthe sound nowhere.wav cannot be opened: No such file", 1, true),
      err)
    assert.truthy(err:find("sound: read takes a file name, got number", 1, true), err)
    bench:write("film.lua", 'require "celspan.sound".read "../secret.wav"')
    code, _, err = run "check film.lua"
    assert.are.equal(3, code)
    assert.truthy(err:find("scripts in the sandbox can read only", 1, true), err)
  end)

  it("is read by the program alone", function()
    local value, message = require "celspan.sound".read "voice.wav"
    assert.is_nil(value)
    assert.are.equal("sounds are read by the program celspan alone: run the script with it",
      message)
  end)
end)
