--- From timed cues to one mouth shape per frame: the step of lips.lua between reading and naming.
local mouths = {}

--- Shapes with the lips pressed together, as in m, b and p; and all closed shapes.
local pressed = { A = true, MBP = true }
local closed = { A = true, MBP = true, X = true, rest = true }

--- The longest recording that is read: a day at 24 frames per second.
local most_frames = 2500000

--- The cues sorted by their starts; cues with equal starts are in the order of the file.
local function in_order(list)
  local sorted, place = {}, {}
  for i, cue in ipairs(list) do sorted[i], place[cue] = cue, i end
  table.sort(sorted, function(a, b)
    if a[1] ~= b[1] then return a[1] < b[1] end
    return place[a] < place[b]
  end)
  return sorted
end

--- Cues in seconds -> the shape of each frame: that of the cue that covers most of the frame; of
--- two equal ones, the later.
function mouths.from_cues(given, fps)
  local list, stop = in_order(given), 0
  for _, cue in ipairs(list) do stop = math.max(stop, cue[2]) end
  local count = math.ceil(stop * fps - 1e-6)
  if count > most_frames then return nil, "the recording is longer than a day" end
  if count < 1 then return nil, "it ends before its first frame" end
  local shapes, best = {}, {}
  for i, cue in ipairs(list) do
    -- a cue ends where the next one starts, whether they overlap or leave a gap
    local ends = list[i + 1] and list[i + 1][1] or cue[2]
    for n = math.max(1, math.floor(cue[1] * fps) + 1), math.min(count, math.ceil(ends * fps)) do
      local cover = math.min(ends * fps, n) - math.max(cue[1] * fps, n - 1)
      -- pressed lips that cover a third of a frame get the whole frame
      if pressed[cue[3]] and cover >= 1 / 3 then cover = cover + 1 end
      if cover > 0 and cover >= (best[n] or 0) then shapes[n], best[n] = cue[3], cover end
    end
  end
  for n = 1, count do shapes[n] = shapes[n] or shapes[n - 1] or "X" end
  return shapes
end

--- Marks in frames -> shape of each frame; if a frame has several marks, the last one counts.
function mouths.from_marks(marks, count, scale)
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
  if last < 1 then return nil, "it ends before its first frame" end
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

--- Takes frames from neighbours that are long enough; otherwise the run becomes part of the run
--- before it, unless its mouth is closed.
local function lengthen(runs, i, hold)
  local run, after, at = runs[i], runs[i + 1], i - 1
  while at > 1 and runs[at].length == 0 do at = at - 1 end
  local before = runs[at]
  local missing = hold - run.length
  local function take(from)
    local taken = from and math.min(missing, math.max(0, from.length - hold)) or 0
    if taken > 0 then
      from.length, run.length, missing = from.length - taken, run.length + taken, missing - taken
    end
  end
  take(after)
  take(before)
  if missing > 0 and before and not closed[run.shape] then
    before.length, run.length = before.length + run.length, 0
  end
end

--- Lengthens or drops the shapes that last for fewer than `hold` frames.
function mouths.hold(shapes, hold)
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

-- ---------------------------------------------------------------- what was read

-- The mouths that were read last, by path, for `celspan watch`: at most KEPT_MOST.
local KEPT_MOST = 16
local kept = {}

--- shapes: for each frame of the film.
function mouths.keep(path, shapes)
  for i, one in ipairs(kept) do
    if one.path == path then
      table.remove(kept, i)
      break
    end
  end
  table.insert(kept, { path = path, shapes = shapes })
  if #kept > KEPT_MOST then table.remove(kept, 1) end
end

--- The path and the shapes of each, both ended by a zero. The shapes are lines, each with the frame
--- at which a shape begins and its name.
function mouths.kept_text()
  local parts = {}
  for _, one in ipairs(kept) do
    local lines = {}
    for n, shape in ipairs(one.shapes) do
      if shape ~= one.shapes[n - 1] then lines[#lines + 1] = ("%d %s\n"):format(n, shape) end
    end
    parts[#parts + 1] = ("%s\0%s\0"):format(one.path, table.concat(lines))
  end
  return table.concat(parts)
end

return mouths
