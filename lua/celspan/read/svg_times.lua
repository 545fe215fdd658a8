--- When the animations of a drawing run: intervals from their begin and end, which may follow those
--- of other animations.
--
--   a: begin="0;c.end" dur="1"     a |--|     |--|        The next interval of each animation is
--   b: begin="a.end" dur="1"       b    |--|     |--|     known before it begins. Each change of it
--   c: begin="b.end" dur=".5"      c       |-|      |     moves those that wait for it, also back.
--
-- Timings: lists with one item for each animation, because a table for each of 100,000 animations
-- needs five times the memory:
--   rules          { simple = seconds of one round; math.huge: it has no end
--                    whole = seconds from the beginning, with all rounds; math.huge: for ever
--                    least, most = seconds of an interval
--                    restart = "always", "whennotactive" or "never" }, which many may share
--   begins, ends   lists of moments after the start of the document, which ascend; ends.is_open: an
--                  event or nothing at all ends it, if its other ends are over. They may be shared
--   first          the number of its first link; those of the next animation follow
-- and for each link, a moment after one of another animation:
--   which = "begins" or "ends", of = the number of the other one, event = its "from" or "till",
--   offset = seconds, owner = the number of the animation that waits
--
-- A run adds lists of its own: the interval that runs or comes next from `from` to `till`, the last
-- one that has begun from `begun` to `ended`, is_active, ... It continues from one time to a
-- later one, so that a film does not begin again at each frame.
--
-- Source: SMIL 3.0, 5.4, as far as no event of a user and no script takes part.
local ordered = require "celspan.ordered"

local times = {}

local huge = math.huge
local STEPS = 500000 -- the most beginnings, ends and messages between animations up to a time
local TRIES = 64 -- steps for each animation that are tried to find whether they ever end
local SCAN = 1 / 16 -- of a step: a moment that is looked at
--- How often an interval may change at one time: then it is part of a circle, and stays.
local CHANGES = 100

-- ---------------------------------------------------------------- events

--- The heap has the numbers of animations by the time of their next event. At the same time, ends
--- come first.
local function is_earlier(run, a, b)
  local one, other = run.time[a], run.time[b]
  if one ~= other then return one < other end
  if run.is_active[a] ~= run.is_active[b] then return run.is_active[a] end
  return a < b
end

--- Puts an animation into the heap, at a free place below which there is nothing, or above that.
local function put(run, i, place)
  local heap, places = run.heap, run.place
  while place > 1 and is_earlier(run, i, heap[place // 2]) do
    heap[place] = heap[place // 2]
    places[heap[place]] = place
    place = place // 2
  end
  heap[place], places[i] = i, place
end

local function remove(run, i)
  local heap, places, time = run.heap, run.place, run.time
  local place, last = places[i], table.remove(heap)
  places[i] = false
  if last == i then return end
  local below = 2 * place
  local a, b = heap[below], heap[below + 1]
  while a do
    if b and (time[b] < time[a] or time[b] == time[a] and is_earlier(run, b, a)) then
      a, below = b, below + 1
    end
    heap[place], places[a] = a, place
    place, below = below, 2 * below
    a, b = heap[below], heap[below + 1]
  end
  put(run, last, place)
end

--- Sets the time of the next event of an animation, which replaces the one before.
local function expect(run, i, time)
  run.steps = run.steps + 1
  if run.place[i] then remove(run, i) end
  if time == huge then return end
  run.time[i] = time
  put(run, i, #run.heap + 1)
end

local function is_spent(run) return run.steps > run.most end

-- ---------------------------------------------------------------- moments

--- The first moment of an animation from `from` on, or after it where is_later; math.huge: there is
--- none. which: "begins" or "ends".
local function first_moment(run, i, which, from, is_later)
  local written, given, best = run[which][i], run.given, huge
  local first, after, last = given.first[i], given.first[i + 1], written[#written]
  if not last and first == after then return huge end
  if last and last >= from then
    local k = ordered.last(written, from)
    if not is_later and written[k] == from then return from end
    best = written[k + 1] or huge
  end
  run.steps = run.steps + SCAN * (after - first)
  for link = first, after - 1 do
    local time = run.moment[link]
    if time < best and time >= from and given.which[link] == which
      and (time > from or not is_later) then
      best = time
    end
  end
  return best
end

--- Whether any end is known, over or not.
local function has_end(run, i)
  return run.ends[i][1] ~= nil or first_moment(run, i, "ends", -huge, false) < huge
end

--- Keeps the moment of a link, which does not change any more: the interval that gave it is over.
local function keep(run, link)
  local given, time = run.given, run.moment[link]
  local i, which = given.owner[link], given.which[link]
  run.moment[link] = huge
  if time == huge then return end
  local list = run[which][i]
  if list == given[which][i] then
    list = table.move(list, 1, #list, 1, { is_open = list.is_open })
    run[which][i] = list
  end
  table.insert(list, ordered.last(list, time) + 1, time)
end

-- ---------------------------------------------------------------- intervals

--- The end of an interval that begins at a time; false: all ends are over, there is no interval.
--- Source: SMIL 3.0, 5.4.5, with the end at which the animation begins again.
local function find_end(run, i, from)
  local rule, is_used = run.given.rules[i], run.was_empty[i] and from == run.after[i]
  local given = first_moment(run, i, "ends", from, is_used)
  local till = math.min(from + rule.whole, given)
  till = math.min(math.max(till, from + rule.least), from + rule.most)
  if rule.restart == "always" then
    till = math.min(till, first_moment(run, i, "begins", from, true))
  end
  return till, given < huge or run.ends[i].is_open or not has_end(run, i)
end

--- The interval after the last one. Source: SMIL 3.0, 5.4.3: one that is over at 0 does not count.
local function find_next(run, i)
  local after, is_later = run.after[i], false
  if after > -huge and run.given.rules[i].restart == "never" then return huge, huge end
  while not is_spent(run) do
    local from = first_moment(run, i, "begins", after, is_later)
    if from == huge then break end
    local till, is_there = find_end(run, i, from)
    if not is_there then break end
    if till > 0 or from == 0 and till == 0 then return from, till end
    is_later, after = till <= from, till
    run.steps = run.steps + 1
  end
  return huge, huge
end

local function enqueue(run, i)
  if run.is_queued[i] then return end
  run.is_queued[i] = true
  run.queue[#run.queue + 1] = i
end

--- Sets the moments of the animations that wait for this one.
local function inform(run, i)
  local given, link = run.given, run.follower[i]
  while link do
    local time = run[given.event[link]][i] + given.offset[link]
    run.steps = run.steps + 1
    if time ~= run.moment[link] then
      run.moment[link] = time
      enqueue(run, given.owner[link])
    end
    link = run.next[link]
  end
end

local function may_change(run, i)
  run.changes[i] = run.waves[i] == run.wave and run.changes[i] + 1 or 1
  run.waves[i] = run.wave
  return run.changes[i] <= CHANGES
end

--- Finds the interval that runs or comes next, which others may have changed.
local function resolve(run, i)
  local from, till = run.from[i]
  run.steps = run.steps + 1
  if run.is_active[i] then till = find_end(run, i, from) else from, till = find_next(run, i) end
  local is_same = from == run.from[i] and till == run.till[i]
  if is_same or not may_change(run, i) then return end
  run.from[i], run.till[i] = from, till
  if run.is_active[i] then run.ended[i] = till end
  inform(run, i)
  expect(run, i, run.is_active[i] and till or from)
end

--- Animations that are added to the queue meanwhile are resolved after all that are in it.
local function settle(run)
  local queue, at = run.queue, 1
  run.wave = run.wave + 1
  while queue[at] and not is_spent(run) do
    run.is_queued[queue[at]] = false
    resolve(run, queue[at])
    at = at + 1
  end
  for k = #queue, 1, -1 do queue[k] = nil end
end

local function begin(run, i)
  run.period[i] = run.begun[i] and run.from[i] - run.begun[i] or 0
  run.is_active[i] = true
  run.begun[i], run.ended[i] = run.from[i], run.till[i]
  expect(run, i, run.till[i])
end

local function finish(run, i)
  local link = run.follower[i]
  while link do
    run.steps = run.steps + 1
    keep(run, link)
    link = run.next[link]
  end
  run.is_active[i] = false
  run.last_end = math.max(run.last_end, run.till[i])
  run.after[i], run.was_empty[i] = run.till[i], run.from[i] == run.till[i]
  run.from[i], run.till[i] = huge, huge
  enqueue(run, i)
end

-- ---------------------------------------------------------------- the clock

--- Each list of a run, and its first value.
local columns = { time = huge, place = false, is_active = false, is_queued = false, from = huge,
                  till = huge, begun = false, ended = huge, after = -huge, was_empty = false,
                  period = 0, changes = 0, waves = 0, follower = false }

--- A run before its first time, of at most `most` steps, and `tries` for each animation and moment.
local function start(given, most, tries)
  local count, links = #given.rules, #given.of
  local run = { given = given, heap = {}, queue = {}, wave = 0, steps = 0, last_end = 0,
                most = most + tries * (count + links), moment = {}, next = {}, at = -huge }
  for name, first in next, columns do
    local list = {}
    for i = 1, count do list[i] = first end
    run[name] = list
  end
  run.begins = table.move(given.begins, 1, count, 1, {})
  run.ends = table.move(given.ends, 1, count, 1, {})
  for link = 1, links do run.moment[link], run.next[link] = huge, false end
  for link = links, 1, -1 do -- the first follower is informed first
    local of = given.of[link]
    run.next[link], run.follower[of] = run.follower[of], link
  end
  for i = 1, count do
    run.most = run.most + tries * (#given.begins[i] + #given.ends[i])
    if given.begins[i][1] then enqueue(run, i) end
  end
  return run
end

--- Lets time pass; false: that takes too many steps.
local function go_on(run, seconds)
  settle(run)
  while run.heap[1] and run.time[run.heap[1]] <= seconds and not is_spent(run) do
    local i = run.heap[1]
    remove(run, i)
    if run.is_active[i] then finish(run, i) else begin(run, i) end
    settle(run)
  end
  run.at = seconds
  return not is_spent(run)
end

--- The run of timings at a time. last: a run of an earlier time; nil: there is none. False,
--- message: they begin and end too often.
function times.run(given, seconds, last)
  local run = last and last.at <= seconds and last or start(given, STEPS, 1)
  if go_on(run, seconds) then return run end
  return false, ("the animations begin and end too often until %g s: they take more than %d "
    .. "steps"):format(seconds, STEPS)
end

--- How long they move: the end of the last interval that ends, and the longest period of what
--- repeats for ever; 0: none.
function times.measure(given)
  local run = start(given, TRIES, TRIES)
  local is_whole = go_on(run, huge)
  local last, period = is_whole and run.last_end or 0, 0
  for i, rule in ipairs(given.rules) do
    if run.is_active[i] and run.ended[i] == huge then
      if rule.simple < huge then period = math.max(period, rule.simple)
      else last = math.max(last, run.begun[i]) end
    end
    if not is_whole then period = math.max(period, run.period[i]) end
  end
  return last, period
end

return times
