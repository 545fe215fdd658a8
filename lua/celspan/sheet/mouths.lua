--- From timed cues to one mouth shape per frame: the step of lips.lua between reading and naming.
local ordered = require "celspan.ordered"
local values = require "celspan.values"

local mouths = {}

--- Shapes with the lips pressed together, as in m, b and p; and all closed shapes.
local pressed = { A = true, MBP = true }
local closed = { A = true, MBP = true, X = true, rest = true }

--- The longest recording that is read: a day at 24 frames per second.
local most_frames = 2500000

local function check_count(count)
  if count > most_frames then values.fail "the recording is longer than a day" end
  if count < 1 then values.fail "it ends before its first frame" end
  return count
end

--- Cues in seconds, sorted -> the shape of each frame: that of the cue that covers most of the
--- frame; of two equal ones, the later. A cue ends where the next one begins, whether they overlap
--- or leave a gap.
local function from_seconds(list, stop, fps)
  local count, shapes, best = check_count(math.ceil(stop * fps - 1e-6)), {}, {}
  for i, cue in ipairs(list) do
    local starts, ends = cue.at * fps, (list[i + 1] and list[i + 1].at or stop) * fps
    for n = math.max(1, math.floor(starts) + 1), math.min(count, math.ceil(ends)) do
      local cover = math.min(ends, n) - math.max(starts, n - 1)
      -- pressed lips that cover a third of a frame get the whole frame
      if pressed[cue.shape] and cover >= 1 / 3 then cover = cover + 1 end
      if cover > 0 and cover >= (best[n] or 0) then shapes[n], best[n] = cue.shape, cover end
    end
  end
  for n = 1, count do shapes[n] = shapes[n] or shapes[n - 1] or "X" end
  return shapes
end

--- Cues in frames, sorted -> the shape of each frame; of several cues in a frame the last counts.
local function from_frames(list, stop, scale)
  local function frame_of(cue) return math.floor((cue.at - 1) * scale + 1e-6) + 1 end
  local last = check_count(math.max(frame_of(list[#list]), math.floor((stop or 0) * scale + 0.5)))
  local shapes, at = {}, 1
  local shape = frame_of(list[1]) > 1 and "rest" or list[1].shape
  for n = 1, last do
    while list[at] and frame_of(list[at]) <= n do shape, at = list[at].shape, at + 1 end
    shapes[n] = shape
  end
  return shapes
end

--- The shape of each frame, from what celspan.cues has found. Raises { message = }.
function mouths.expose(found, fps)
  local list = ordered.sort(found.cues, "at")
  if found.is_timed then return from_seconds(list, found.stop, fps) end
  return from_frames(list, found.stop, fps / (found.fps or fps))
end

--- Runs of equal shapes: { { length =, shape = }, ... }.
local function runs_of(shapes)
  local runs = {}
  for n, shape in ipairs(shapes) do
    if shape ~= shapes[n - 1] then runs[#runs + 1] = { length = 0, shape = shape } end
    runs[#runs].length = runs[#runs].length + 1
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
  for i = #kept, 1, -1 do
    if kept[i].path == path then table.remove(kept, i) end
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
