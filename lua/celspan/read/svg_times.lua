--- When the animations of a drawing run: intervals from their begin and end, which may follow those
--- of other animations.
--
--   a: begin="0;c.end" dur="1"     a |--|     |--|        The next interval of each animation is
--   b: begin="a.end" dur="1"       b    |--|     |--|     known before it begins. Each change of it
--   c: begin="b.end" dur=".5"      c       |-|      |     moves those that wait for it, also back.
--
-- A timing:
--   simple         seconds of one round; math.huge: it has no end
--   whole          seconds from the beginning, with all rounds; math.huge: for ever
--   least, most    seconds of an interval
--   restart        "always", "whennotactive" or "never"
--   begins, ends   lists of moments after the start of the document, which ascend
--   links          those after moments of others: { which = "begins" or "ends", of = the number of
--                  the other animation, event = its "begin" or "end", offset = seconds }
--   end_is_open    an event or nothing at all ends it, if its other ends are over
-- A run adds its own fields to it: there may be many, and a table of its own for each would double
-- the memory.
--
-- Source: SMIL 3.0, 5.4, as far as no event of a user and no script takes part.
local ordered = require "celspan.ordered"

local times = {}

local huge = math.huge
local STEPS = 1000000 -- the most beginnings, ends and messages between animations up to a time
local TRIES = 64 -- steps for each animation that are tried to find whether they ever end
local SCAN = 1 / 16 -- of a step: a moment that is looked at
--- How often an interval may change at one time: then it is part of a circle, and stays.
local CHANGES = 100
local NONE = {}

-- ---------------------------------------------------------------- events

--- A state is in the heap by the time of its next event. At the same time, ends come first.
local function is_earlier(a, b)
  if a.time ~= b.time then return a.time < b.time end
  if a.is_active ~= b.is_active then return a.is_active end
  return a.number < b.number
end

--- Moves a state of the heap to its place.
local function sift(heap, place)
  local state = heap[place]
  while place > 1 and is_earlier(state, heap[place // 2]) do
    heap[place] = heap[place // 2]
    heap[place].place = place
    place = place // 2
  end
  local below = 2 * place
  while heap[below] do
    if heap[below + 1] and is_earlier(heap[below + 1], heap[below]) then below = below + 1 end
    if not is_earlier(heap[below], state) then break end
    heap[place] = heap[below]
    heap[place].place = place
    place, below = below, 2 * below
  end
  heap[place] = state
  state.place = place
end

local function remove(heap, state)
  local place, last = state.place, table.remove(heap)
  state.place = nil
  if last == state then return end
  heap[place] = last
  sift(heap, place)
end

--- Sets the time of the next event of a state, which replaces the one before.
local function expect(run, state, time)
  run.steps = run.steps + 1
  if state.place then remove(run.heap, state) end
  if time == huge then return end
  state.time = time
  run.heap[#run.heap + 1] = state
  sift(run.heap, #run.heap)
end

local function is_spent(run) return run.steps > run.most end

-- ---------------------------------------------------------------- moments

--- The first moment of a state from `from` on, or after it where is_later; math.huge: there is
--- none. which: "begins" or "ends".
local function first_moment(run, state, which, from, is_later)
  local written, links, best = state[which], state.links, huge
  local last = written[#written]
  if last and last >= from then
    local i = ordered.last(written, from)
    if not is_later and written[i] == from then return from end
    best = written[i + 1] or huge
  end
  run.steps = run.steps + SCAN * #links
  for i = 1, #links do
    local link = links[i]
    local time = link.time
    if time < best and time >= from and link.which == which and (time > from or not is_later) then
      best = time
    end
  end
  return best
end

--- Whether any end is known, over or not.
local function has_end(run, state)
  if state.ends[1] then return true end
  run.steps = run.steps + SCAN * #state.links
  for _, link in ipairs(state.links) do
    if link.which == "ends" and link.time < huge then return true end
  end
  return false
end

--- Keeps the moment of a link, which does not change any more: the interval that gave it is over.
local function keep(link)
  local list, time = link.state[link.which], link.time
  if time < huge then
    local last = list[#list]
    if last and last > time then table.insert(list, ordered.last(list, time) + 1, time)
    else list[#list + 1] = time end
  end
  link.time = huge
end

-- ---------------------------------------------------------------- intervals

--- The end of an interval that begins at a time; false: all ends are over, there is no interval.
--- Source: SMIL 3.0, 5.4.5, with the end at which the animation begins again.
local function find_end(run, state, begin)
  local is_used = state.was_empty and begin == state.after
  local given = first_moment(run, state, "ends", begin, is_used)
  local finish = math.min(begin + state.whole, given)
  finish = math.min(math.max(finish, begin + state.least), begin + state.most)
  if state.restart == "always" then
    finish = math.min(finish, first_moment(run, state, "begins", begin, true))
  end
  return finish, given < huge or state.end_is_open or not has_end(run, state)
end

--- The interval after the last one. Source: SMIL 3.0, 5.4.3: one that is over at 0 does not count.
local function find_next(run, state)
  local from, is_later = state.after, false
  if from > -huge and state.restart == "never" then return huge, huge end
  while not is_spent(run) do
    local begin = first_moment(run, state, "begins", from, is_later)
    if begin == huge then break end
    local finish, is_there = find_end(run, state, begin)
    if not is_there then break end
    if finish > 0 or begin == 0 and finish == 0 then return begin, finish end
    is_later, from = finish <= begin, finish
    run.steps = run.steps + 1
  end
  return huge, huge
end

local function enqueue(run, state)
  if state.is_queued then return end
  state.is_queued = true
  run.queue[#run.queue + 1] = state
end

--- Sets the moments of the animations that wait for this one.
local function inform(run, state)
  for _, link in ipairs(state.followers or NONE) do
    local time = state[link.event] + link.offset
    run.steps = run.steps + 1
    if time ~= link.time then
      link.time = time
      enqueue(run, link.state)
    end
  end
end

local function may_change(run, state)
  state.changes = state.wave == run.wave and state.changes + 1 or 1
  state.wave = run.wave
  return state.changes <= CHANGES
end

--- Finds the interval that runs or comes next, which others may have changed.
local function resolve(run, state)
  local begin, finish
  run.steps = run.steps + 1
  if state.is_active then
    begin, finish = state.begin, (find_end(run, state, state.begin))
  else
    begin, finish = find_next(run, state)
  end
  local is_same = begin == state.begin and finish == state["end"]
  if is_same or not may_change(run, state) then return end
  state.begin, state["end"] = begin, finish
  if state.is_active then state.to = finish end
  inform(run, state)
  expect(run, state, state.is_active and finish or begin)
end

local function settle(run)
  run.wave = run.wave + 1
  while run.queue[1] and not is_spent(run) do
    local queue = run.queue
    run.queue = {}
    for _, state in ipairs(queue) do
      state.is_queued = false
      resolve(run, state)
    end
  end
end

local function begin(run, state)
  state.period = state.from and state.begin - state.from or 0
  state.is_active = true
  state.from, state.to = state.begin, state["end"]
  expect(run, state, state.to)
end

local function finish(run, state)
  for _, link in ipairs(state.followers or NONE) do
    run.steps = run.steps + 1
    keep(link)
  end
  state.is_active = false
  run.last_end = math.max(run.last_end, state["end"])
  state.after, state.was_empty = state["end"], state.begin == state["end"]
  state.begin, state["end"] = huge, huge
  enqueue(run, state)
end

-- ---------------------------------------------------------------- the clock

--- Adds what a run knows of an animation. followers: its links to those that it waits for.
local function start(run, state, number)
  state.number, state.is_active, state.period = number, false, 0
  state.after, state.begin, state["end"] = -huge, huge, huge
  for _, link in ipairs(state.links) do
    local other = run.states[link.of]
    link.state, link.time = state, huge
    other.followers = other.followers or {}
    table.insert(other.followers, link)
  end
  enqueue(run, state)
end

--- Runs the animations up to a time. Returns the run, and whether it is whole: false if it takes
--- more than `most` steps, and `tries` for each animation and moment.
local function run_to(timings, seconds, most, tries)
  local run = { states = timings, heap = {}, queue = {}, wave = 0, steps = 0,
                last_end = 0, most = most }
  for i, state in ipairs(timings) do
    start(run, state, i)
    run.most = run.most + tries * (1 + #state.begins + #state.ends + #state.links)
  end
  settle(run)
  while run.heap[1] and run.heap[1].time <= seconds and not is_spent(run) do
    local state = run.heap[1]
    remove(run.heap, state)
    if state.is_active then finish(run, state) else begin(run, state) end
    settle(run)
  end
  return run, not is_spent(run)
end

--- Gives each animation its last interval that has begun: `from`, nil where none has, `to`, and
--- is_active. False, message: they begin and end too often.
function times.run(timings, seconds)
  local _, is_whole = run_to(timings, seconds, STEPS, 1)
  return is_whole, ("the animations begin and end too often until %g s: they take more than %d "
    .. "steps"):format(seconds, STEPS)
end

--- How long they move: the end of the last interval that ends, and the longest period of what
--- repeats for ever; 0: none.
function times.measure(timings)
  local run, is_whole = run_to(timings, huge, TRIES, TRIES)
  local last, period = is_whole and run.last_end or 0, 0
  for _, state in ipairs(run.states) do
    if state.is_active and state.to == huge then
      if state.simple < huge then period = math.max(period, state.simple)
      else last = math.max(last, state.from) end
    end
    if not is_whole then period = math.max(period, state.period) end
  end
  return last, period
end

return times
