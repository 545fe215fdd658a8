--- How loud a sound is in bands of frequency at a moment, and its beats.
--
--   levels: a byte for each of 96 bands, each hundredth of a second (plugins/sound/spectrum.h)
--   levels --added up--> bands as wide as a drawing needs them
--   levels --what becomes louder--> onsets --the time after which they return--> beats
--
-- Beats are found as by D. Ellis, "Beat tracking by dynamic programming", Journal of New Music
-- Research 36 (2007): of all rows of moments, the one with the strongest onsets whose distances are
-- near the sound's own.
local spectrum = {}

local BANDS, RATE = 96, 100
local QUIET, QUARTER = 60, 4 -- dB below full scale that a byte 0 has; steps of a byte in a dB
local RISE = 3 -- steps over which a band becomes louder
local AROUND = 50 -- steps to either side: the usual rise, which is no onset
local SLOWEST, FASTEST = 200, 24 -- steps between beats: 30 and 250 beats per minute
local USUAL, OCTAVE = 50, 1 -- steps between beats, and by how many octaves they often differ
local TIGHT = 100 -- how much a beat at another distance costs
local LEAST = 0.5 -- of the usual size of onsets: before the first beat and after the last

spectrum.LONGEST = 3 -- hours of a sound whose beats are found: some seconds of work

-- The power of each byte, 1 at full scale.
local POWER = { [0] = 0 }
for byte = 1, QUIET * QUARTER do
  POWER[byte] = 10 ^ ((byte / QUARTER - QUIET) / 10)
end

--- The power from band `from` to band `to`, which may lie inside one, in step i.
local function power_between(levels, i, from, to)
  if i < 0 or i >= #levels // BANDS then return 0 end
  local sum = 0
  for band = math.floor(from), math.ceil(to) - 1 do
    local share = math.min(to, band + 1) - math.max(from, band)
    sum = sum + share * POWER[levels:byte(i * BANDS + band + 1)]
  end
  return sum
end

--- A list of `count` levels at a time, from low to high: 0 is -60 dB or less, 1 is full scale.
function spectrum.at(levels, seconds, count)
  local step = math.max(-1, math.min(#levels // BANDS, seconds * RATE))
  local i, list = math.floor(step), {}
  for k = 1, count do
    local from, to = (k - 1) * BANDS / count, k * BANDS / count
    local power = (1 - step + i) * power_between(levels, i, from, to)
      + (step - i) * power_between(levels, i + 1, from, to)
    local db = power > 0 and 10 * math.log(power, 10) or -QUIET
    list[k] = math.max(0, math.min(1, 1 + db / QUIET))
  end
  return list
end

-- ---------------------------------------------------------------- onsets

--- By how much the bands become louder, for each step from 0: a list from 1.
local function rises_of(levels)
  local rises, old = {}, {}
  for i = 0, #levels // BANDS - 1 do
    local now, before, sum = { levels:byte(i * BANDS + 1, (i + 1) * BANDS) }, old[i % RISE], 0
    for band = 1, before and BANDS or 0 do
      sum = sum + math.max(0, now[band] - before[band])
    end
    old[i % RISE], rises[i + 1] = now, sum
  end
  return rises
end

--- The rises without what is usual around them, in units of their standard deviation; nil: there
--- are none.
local function onsets_of(levels)
  local rises, sums, onsets, squares = rises_of(levels), { [0] = 0 }, {}, 0
  for i, rise in ipairs(rises) do sums[i] = sums[i - 1] + rise end
  for i, rise in ipairs(rises) do
    local from, to = math.max(0, i - AROUND), math.min(#rises, i + AROUND)
    onsets[i] = math.max(0, rise - (sums[to] - sums[from]) / (to - from))
    squares = squares + onsets[i] ^ 2
  end
  if squares == 0 then return nil end
  local scale = math.sqrt(#rises / squares)
  for i, onset in ipairs(onsets) do onsets[i] = onset * scale end
  return onsets
end

-- ---------------------------------------------------------------- tempo

--- How much the onsets are like themselves after `lag` steps.
local function likeness(onsets, lag)
  local sum = 0
  for i = 1, #onsets - lag do sum = sum + onsets[i] * onsets[i + lag] end
  return sum
end

--- The time after which the onsets return, in steps: the likeliest one, which is more likely near
--- the usual tempo.
local function period_of(onsets)
  local best, most = nil, 0
  for lag = FASTEST, math.min(SLOWEST, #onsets - 1) do
    local octaves = math.log(lag / USUAL, 2) / OCTAVE
    local score = likeness(onsets, lag) * math.exp(-octaves ^ 2 / 2)
    if score > most then best, most = lag, score end
  end
  return best
end

-- ---------------------------------------------------------------- beats

--- For each step, what the best row of beats that ends there is worth, and its beat before.
local function rows_of(onsets, period)
  local worth, before, costs = {}, {}, {}
  local near, far = math.floor(period / 2 + 0.5), 2 * period
  for k = near, far do costs[k] = TIGHT * math.log(k / period) ^ 2 end
  for i, onset in ipairs(onsets) do
    local best, from = 0, nil
    for k = near, math.min(far, i - 1) do
      local score = worth[i - k] - costs[k]
      if score > best then best, from = score, i - k end
    end
    worth[i], before[i] = onset + best, from
  end
  return worth, before
end

--- The greatest onset at or beside step i.
local function onset_at(onsets, i)
  return math.max(onsets[i - 1] or 0, onsets[i], onsets[i + 1] or 0)
end

--- The steps of the best row, first to last, without beats at the ends where nothing begins.
local function best_row(onsets, period)
  local worth, before = rows_of(onsets, period)
  local last, backwards, row = #onsets, {}, {}
  for i = math.max(1, #onsets - 2 * period), #onsets do
    if worth[i] > worth[last] then last = i end
  end
  while last and onset_at(onsets, last) < LEAST do last = before[last] end
  while last do
    backwards[#backwards + 1] = last
    last = before[last]
  end
  while #backwards > 0 and onset_at(onsets, backwards[#backwards]) < LEAST do
    backwards[#backwards] = nil
  end
  for i = #backwards, 1, -1 do row[#row + 1] = backwards[i] end
  return row
end

--- Beats per minute of a row: by the middle of its distances, which single beats do not change.
local function tempo_of(row)
  local distances = {}
  local across = math.min(8, #row - 1)
  for i = 1, #row - across do distances[i] = (row[i + across] - row[i]) / across end
  table.sort(distances)
  return 60 * RATE / distances[(#distances + 1) // 2]
end

--- The beats in seconds, and how many there are in a minute; none, and 0, where nothing returns;
--- nil for a sound that is too long.
function spectrum.beats(levels)
  if #levels // BANDS > spectrum.LONGEST * 3600 * RATE then return nil end
  local onsets = onsets_of(levels)
  local period = onsets and period_of(onsets)
  local row = period and best_row(onsets, period) or {}
  if #row < 2 then return {}, 0 end
  local beats = {}
  for i, step in ipairs(row) do beats[i] = (step - 1) / RATE end
  return beats, tempo_of(row)
end

return spectrum
