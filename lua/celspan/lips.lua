--- Mouth shapes frame by frame, from lip-sync files.
--
--   local track = assert(lips.read("line1.json", { fps = 24, hold = 2 }))
--   track:at(f.number)                      -- "A" .. "X", or what `map` makes of it
--
-- Frame n (from 1) shows the time from (n-1)/fps to n/fps: the shape that covers most of it. A shape
-- stays for at least `hold` frames, so that mouths do not flicker; closed mouths (A, MBP), which
-- are seen when they are missing, push others aside.
local core = require "celspan.core"
local cues = require "celspan.cues"

local lips = {}

local Track = {}
Track.__index = Track
Track.__name = "celspan.lips"

--- What stands in for a shape that a set of drawings lacks: Rhubarb's own rules.
local fallbacks = { G = "A", H = "C", X = "A" }

--- Shapes whose lips are closed.
local closed = { A = true, MBP = true, mbp = true }

local option_names = { "fps", "hold", "map", "set" }

local function check_options(options)
  local known = { fps = "number", hold = "number", map = "table", set = "table" }
  local names = {}
  for name in pairs(options) do names[#names + 1] = tostring(name) end
  table.sort(names)
  for _, name in ipairs(names) do
    if not known[name] then
      local hint = core.nearest(name, option_names)
      error(("lips: unknown field '%s'%s"):format(name,
        hint and ("; did you mean '%s'?"):format(hint) or ""), 3)
    end
  end
  for _, name in ipairs(option_names) do
    local value = options[name]
    if value ~= nil and type(value) ~= known[name] then
      error(("lips: field '%s' must be a %s, got %s"):format(name, known[name], type(value)), 3)
    end
  end
  local fps, hold = options.fps or 24, options.hold or 2
  if not (fps > 0 and fps <= 1000) then error("lips: field 'fps' must be above 0, at most 1000", 3) end
  if hold < 1 or hold ~= math.floor(hold) then
    error("lips: field 'hold' must be a whole number of frames, 1 or more", 3)
  end
end

--- The longest recording that is read: a day at 24 frames a second.
local most_frames = 2500000

--- Cues in seconds -> shape of each frame: the one that covers most of it, the later of equals.
local function from_cues(list, fps)
  local stop = 0
  for _, cue in ipairs(list) do stop = math.max(stop, cue[2]) end
  local count = math.ceil(stop * fps - 1e-6)
  if count > most_frames then return nil, "the recording is longer than a day" end
  local shapes, best = {}, {}
  for i, cue in ipairs(list) do
    -- cues may overlap: a cue ends where the next one starts
    local ends = list[i + 1] and math.min(cue[2], math.max(list[i + 1][1], cue[1])) or cue[2]
    for n = math.max(1, math.floor(cue[1] * fps) + 1), math.min(count, math.ceil(ends * fps)) do
      local cover = math.min(ends * fps, n) - math.max(cue[1] * fps, n - 1)
      -- a closed mouth that fills a third of a frame is worth the whole
      if closed[cue[3]] and cover >= 1 / 3 then cover = cover + 1 end
      if cover > 0 and cover >= (best[n] or 0) then shapes[n], best[n] = cue[3], cover end
    end
  end
  for n = 1, count do shapes[n] = shapes[n] or shapes[n - 1] or "X" end
  return shapes
end

--- Marks in frames -> shape of each frame; of marks on one frame the last counts.
local function from_marks(marks, count, scale)
  local sorted = {}
  for i, mark in ipairs(marks) do
    sorted[i] = { frame = math.floor((mark[1] - 1) * scale + 1e-6) + 1, order = i, shape = mark[2] }
  end
  table.sort(sorted, function(a, b)
    if a.frame ~= b.frame then return a.frame < b.frame end
    return a.order < b.order
  end)
  local last = math.max(sorted[#sorted].frame, count and math.floor(count * scale + 0.5) or 0)
  if last > most_frames then return nil, "the recording is longer than a day" end
  local shapes, at = {}, 1
  local shape = sorted[1].frame > 1 and "rest" or sorted[1].shape
  for n = 1, last do
    while sorted[at] and sorted[at].frame <= n do shape, at = sorted[at].shape, at + 1 end
    shapes[n] = shape
  end
  return shapes
end

--- Runs of equal shapes: { {first, length, shape}, ... }.
local function runs_of(shapes)
  local runs = {}
  for _, shape in ipairs(shapes) do
    local run = runs[#runs]
    if run and run.shape == shape then
      run.length = run.length + 1
    else
      runs[#runs + 1] = { length = 1, shape = shape }
    end
  end
  return runs
end

--- Takes frames from a neighbour that can spare them, else gives the run to the one before.
local function lengthen(runs, i, hold)
  local run, after, at = runs[i], runs[i + 1], i - 1
  while at > 1 and runs[at].length == 0 do at = at - 1 end
  local before = runs[at]
  local missing = hold - run.length
  local function take(from, spare)
    local taken = from and math.min(missing, math.max(0, from.length - spare)) or 0
    if taken > 0 then
      from.length, run.length, missing = from.length - taken, run.length + taken, missing - taken
    end
  end
  local spare = closed[run.shape] and 1 or hold
  take(after, spare)
  take(before, spare)
  if missing > 0 and before and not closed[run.shape] then
    before.length, run.length = before.length + run.length, 0
  end
end

local function hold_shapes(shapes, hold)
  local runs = runs_of(shapes)
  for i = 1, #runs do
    if runs[i].length > 0 and runs[i].length < hold then lengthen(runs, i, hold) end
  end
  local held = {}
  for _, run in ipairs(runs) do
    for _ = 1, run.length do held[#held + 1] = run.shape end
  end
  return held
end

--- The name under which a shape is drawn: fallbacks for what the set lacks, then the map.
local function namer(options)
  local has
  if options.set then
    has = {}
    for _, name in ipairs(options.set) do has[name] = true end
  end
  local map = options.map or {}
  return function(shape)
    if has and not has[shape] then shape = fallbacks[shape] or shape end
    local mapped = map[shape]
    return mapped == nil and shape or mapped
  end
end

--- The mouth shape at a frame from 1; the first and last hold outside.
function Track:at(frame)
  if type(frame) ~= "number" then
    error("lips: at takes a frame's number, got " .. type(frame), 2)
  end
  return self.shapes[math.max(1, math.min(#self.shapes, math.floor(frame)))]
end

function lips.read(path, options)
  if type(path) ~= "string" then error("lips: read takes a file name, got " .. type(path), 2) end
  options = options or {}
  if type(options) ~= "table" then
    error("lips: read takes a table of options, got " .. type(options), 2)
  end
  check_options(options)
  local file, message = io.open(core.resolve(path), "rb")
  local text = file and file:read "a"
  if file then file:close() end
  if not text then return nil, message or ("%s: cannot be read"):format(path) end
  local found, problem = cues.read(text)
  if not found then return nil, ("%s: %s"):format(path, problem) end
  local fps = options.fps or 24
  local shapes
  if found.cues then
    shapes, problem = from_cues(found.cues, fps)
  else
    shapes, problem = from_marks(found.marks, found.count, fps / (found.fps or fps))
  end
  if not shapes then return nil, ("%s: %s"):format(path, problem) end
  shapes = hold_shapes(shapes, options.hold or 2)
  local name = namer(options)
  for n, shape in ipairs(shapes) do shapes[n] = name(shape) end
  return setmetatable({ shapes = shapes, frames = #shapes, fps = fps }, Track)
end

return lips
