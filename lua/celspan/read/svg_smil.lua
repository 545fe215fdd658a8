--- The elements of a drawing that animate: animate, set, animateTransform and animateMotion. When
--- they run, and where each is in its list of values at a time.
--
-- mover: what reads the document and mixes its values (src/kit/lua/module/mover.c).
local easings = require "celspan.svg_easing"
local keys = require "celspan.keys"
local times = require "celspan.svg_times"
local words = require "celspan.svg_words"

local smil = {}

local huge = math.huge

-- ---------------------------------------------------------------- times

local units = { ms = 0.001, s = 1, min = 60, h = 3600 }

--- "1.5s", "200ms", "2min", "1h", "01:02:03.5", "02:03": seconds, and the place behind them.
local function take_clock(text, at)
  if text:find("^[+-]", at) then return nil end
  local value, behind = words.number(text, at)
  for _ = 1, 2 do
    if not value or not text:find("^:", behind) then break end
    local next, after = words.number(text, behind + 1)
    if not next or next < 0 or next >= 60 then return nil end
    value, behind = value * 60 + next, after
  end
  if not value then return nil end
  local unit, after = words.choice(text, behind, units)
  return unit and value * unit or value, unit and after or behind
end

--- The whole of an attribute as a number above 0, read by `take`; math.huge: indefinite. nil: it
--- does not count.
local function whole(text, take)
  if not text then return nil end
  if words.is(text, "indefinite") or words.is(text, "media") then return huge end
  local value, behind = take(text, words.skip_space(text, 1))
  return value and value > 0 and words.is_blank(text, behind) and value or nil
end

--- Source: SMIL 3.0, 5.4.5: the active duration.
local function rule_of(dur, repeat_count, repeat_dur, min, max, restart, fill)
  local count, limit = whole(repeat_count, words.number), whole(repeat_dur, take_clock)
  local simple, least, most = whole(dur, take_clock) or huge, whole(min, take_clock),
    whole(max, take_clock) or huge
  local all = count and simple < huge and simple * count or not (count or limit) and simple or huge
  least = least and least < huge and least or 0
  if least > most then least, most = 0, huge end
  return { simple = simple, whole = math.min(all, limit or huge), least = least, most = most,
           restart = words.is(restart, "never") and "never"
             or words.is(restart, "whennotactive") and "whennotactive" or "always",
           freezes = words.is(fill, "freeze") }
end

--- [+|-] time, or nothing; nil: the text from `at` on is something else.
local function offset_in(text, at)
  local sign, from = text:match("^%s*([+-]?)%s*()", at)
  if sign == "" and from > #text then return 0 end
  local value, behind = take_clock(text, from)
  if not value or not words.is_blank(text, behind) then return nil end
  return sign == "-" and -value or value
end

--- "id.begin+1s": the id, the event, and the place behind it.
local function follower(text)
  for _, event in ipairs { "begin", "end" } do
    local id, behind = (text .. " "):match("^(..-)%." .. event .. "()[%s+-]")
    if id then return id, event, behind end
  end
end

--- Reads one of the moments of a list into it, or into the links. False: only an event or a script
--- gives it.
local function add_moment(text, which, list, plan, find)
  if text:find "^[+.%d-]" then
    local offset = offset_in(text, 1)
    list[#list + 1] = offset
    return offset ~= nil
  end
  local id, event, behind = follower(text)
  local offset = id and offset_in(text, behind)
  local of = offset and find(id)
  if of then
    local link = #plan.of + 1
    plan.which[link], plan.of[link], plan.offset[link] = which, of, offset
    plan.event[link], plan.owner[link] = event == "begin" and "from" or "till", #plan.rules
  end
  return of ~= nil
end

local NONE, AT_ONCE = {}, { 0 } -- of the many animations without written moments

--- The moments of begin or end. is_open: it has what is never, or what only an event gives.
local function moments(mover, name, text, which, plan, find)
  local list, is_noted = {}, false
  for _, part in ipairs(words.parts(text)) do
    if not add_moment(part, which, list, plan, find) then
      list.is_open = true
      local is_silent = is_noted or name == "end" and part:lower():find "^indefinite%f[^%a-]"
      if not is_silent then
        is_noted = true
        mover:skip(#plan.rules, ('%s "%s" is not run'):format(name, part:sub(1, 40)))
      end
    end
  end
  table.sort(list)
  return (list[1] or list.is_open) and list or NONE
end

--- Reads the times of the elements that animate: timings (celspan.svg_times) with `targets`, false:
--- it has no effect, `names` and `tags`.
local function read_times(mover)
  local plan = { rules = {}, begins = {}, ends = {}, first = {}, which = {}, of = {}, event = {},
                 offset = {}, owner = {}, targets = {}, names = {}, tags = {} }
  local numbers, known = nil, {}
  local function find(id)
    if not numbers then
      numbers = {}
      for i = #plan.tags, 1, -1 do numbers[mover:text(i, "id") or ""] = i end
    end
    return numbers[id]
  end
  local function rule(...)
    local key = words.key(...)
    known[key] = known[key] or rule_of(...)
    return known[key]
  end
  repeat
    local i = #plan.tags + 1
    plan.targets[i], plan.names[i], plan.tags[i] = mover:animation(i)
  until not plan.tags[i]
  for i = 1, #plan.tags do
    local begin, finish = mover:text(i, "begin", "end")
    plan.first[i] = #plan.of + 1
    plan.rules[i] = rule(mover:text(i, "dur", "repeatCount", "repeatDur", "min", "max", "restart",
      "fill"))
    plan.begins[i] = begin and moments(mover, "begin", begin, "begins", plan, find) or AT_ONCE
    plan.ends[i] = finish and moments(mover, "end", finish, "ends", plan, find) or NONE
  end
  plan.first[#plan.tags + 1] = #plan.of + 1
  return plan
end

-- ---------------------------------------------------------------- lists

--- A curve of keySplines; nil: the text is something else.
local function curve_of(text)
  local points, behind = words.numbers(text, 1, 4)
  if not points or not words.is_blank(text, behind) then return nil end
  if math.min(points[2], points[4]) < 0 or math.max(points[2], points[4]) > 1 then return nil end
  local easing = easings.curve(points)
  return easing and easing.at
end

--- The parts of a list, each read by `take`; nil: they are not `count`, or one is something else.
local function list_of(text, count, take)
  local list = words.parts(text or "")
  if #list ~= count then return nil end
  for k, part in ipairs(list) do
    list[k] = take(part)
    if not list[k] then return nil end
  end
  return list
end

--- The shares of the time at which values at these distances are; nil: there are no distances.
local function paces(distances)
  local list, all = { 0 }, 0
  for k, distance in ipairs(distances) do
    all = all + distance
    list[k + 1] = all
  end
  if all == 0 then return nil end
  for k, distance in ipairs(list) do list[k] = distance / all end
  return list
end

local function number_of(text)
  local value, behind = words.number(text, 1)
  return value and words.is_blank(text, behind) and value or nil
end

--- The track of the places of `count` values that are at these shares of the time, or evenly, and
--- between which there are curves: 1.5 is in the middle between the second and the third. nil: the
--- shares do not ascend from 0, to 1 unless they are discrete.
local function track_of(shares, curves, count, is_discrete)
  local list = {}
  for k = 1, count do
    local curve = curves and curves[k - 1] or nil
    list[k] = { shares and shares[k] or (k - 1) / (count - 1), k - 1, curve }
  end
  local last = list[count][1]
  if list[1][1] ~= 0 or last > 1 or last < 1 and not is_discrete then return nil end
  local is_good, track = pcall(keys, list)
  return is_good and track or nil
end

--- Where a share of the time is in a list of `count` values, by keyTimes and keySplines: a function
--- that returns the number of a value, counted from 0, and the share from it to the next one.
--- distances: between the values of a list that is paced; nil: it is not. nil: the lists of the
--- element lie.
local function placer(mover, i, mode, count, distances)
  local is_discrete, is_spline = words.is(mode, "discrete"), words.is(mode, "spline")
  local given, shares, curves, track = mover:text(i, "keyTimes"), nil, nil, nil
  if words.is(mode, "paced") then
    shares = distances and paces(distances)
    if distances and not shares then return function() return 0, 0 end end
  elseif given then
    shares = list_of(given, count, number_of)
    if not shares then return nil end
  end
  if is_spline and count > 1 then
    curves = list_of(mover:text(i, "keySplines"), count - 1, curve_of)
    if not curves then return nil end
  end
  if shares or curves then
    track = track_of(shares, curves, count, is_discrete)
    if not track then return nil end
  end
  local parts = is_discrete and count or math.max(1, count - 1)
  return function(at)
    local where = track and track:at(at) or at * parts
    local first = math.min(math.floor(where), parts - 1)
    return first, is_discrete and 0 or where - first
  end
end

-- ---------------------------------------------------------------- values

--- The kinds of a transform: the numbers that are missing; one of `scale` counts for both axes.
local transforms = {
  translate = { 0, 0, name = "translate" }, scale = { 1, 1, name = "scale" },
  rotate = { 0, 0, 0, name = "rotate" }, skewx = { 0, name = "skewX" },
  skewy = { 0, name = "skewY" },
}
local REPLACE, ADD = 0, 1 -- compositions

--- A value of animateTransform as a function of this kind.
local function transform(kind, text)
  local numbers, at = {}, 1
  for k, missing in ipairs(kind) do
    local value, behind = words.number(text, text:match("^[%a%%]*[%s,]*()", at))
    if k == 2 and kind.name == "scale" then missing = numbers[1] end
    numbers[k], at = value or missing, behind or #text + 1
  end
  for k, number in ipairs(numbers) do numbers[k] = ("%.17g"):format(number) end
  return ("%s(%s)"):format(kind.name, table.concat(numbers, " "))
end

--- The placer of a list of values; nil: the lists of the element lie. list: nil: from, to and by.
--- last: the last value: those that do not mix are discrete.
local function placer_of_values(mover, i, list, last)
  local mode, distances = mover:text(i, "calcMode") or "linear", nil
  if not mover:distance(i, last, last) then
    mode = "discrete"
  elseif words.is(mode, "paced") and list then
    distances = {}
    for k = 2, #list do distances[k - 1] = mover:distance(i, list[k - 1], list[k]) or 0 end
  end
  return placer(mover, i, mode, list and #list or 2, distances)
end

--- Moves an attribute by a list of values. sums: 1 or 0: how often each round adds the last value.
local function animate_list(mover, i, list, how, sums)
  local last = list[#list]
  local place = last and placer_of_values(mover, i, list, last)
  return place and function(by, at, round)
    local first, share = place(at)
    by:mix(i, nil, share, list[first + 1], how, list[first + 2] or last, how, false, last,
      round * sums)
  end
end

--- The same by from, to and by. kind: of a transform; nil: of another attribute.
local function animate_ends(mover, i, from, to, by, how, sums, kind)
  local place = (to or by) and placer_of_values(mover, i, nil, to or by)
  local is_only, last = not from, nil -- without a beginning
  if is_only and to then
    from, how, sums = kind and transform(kind, "") or nil, REPLACE, 0
  elseif is_only then
    from, how, last = kind and transform(kind, "0 0 0"), kind and ADD or REPLACE, by
  end
  return place and function(mover_then, at, round)
    local first, share = place(at)
    mover_then:mix(i, nil, first + share, from, how, to or by, how, not to, last, round * sums)
  end
end

local function animate(mover, i, tag)
  local values, from, to, by, kind = mover:text(i, "values", "from", "to", "by")
  if tag == "set" then
    return to and function(then_by) then_by:mix(i, nil, 0, to, REPLACE, to, REPLACE) end
  end
  if tag == "animateTransform" then
    local name = (mover:text(i, "type") or "translate"):match "^%s*(%a+)%s*$"
    kind = name and transforms[name:lower()]
    if not kind then return nil end
  end
  local additive, accumulate = mover:text(i, "additive", "accumulate")
  local how = words.is(additive, "sum") and ADD or REPLACE
  local sums = words.is(accumulate, "sum") and 1 or 0
  if not values then
    local function whole_of(text) return text and kind and transform(kind, text) or text end
    return animate_ends(mover, i, whole_of(from), whole_of(to), whole_of(by), how, sums,
      kind)
  end
  local list = words.parts(values)
  for k = 1, kind and #list or 0 do list[k] = transform(kind, list[k]) end
  return animate_list(mover, i, list, how, sums)
end

-- ---------------------------------------------------------------- ways

local function point(text) return (words.numbers(text, 1, 2)) end

--- The points of the list, or the two of from, to and by; nil: there are none.
local function read_points(mover, i)
  local values, from, to, by = mover:text(i, "values", "from", "to", "by")
  if values then
    local list = words.parts(values)
    for k, part in ipairs(list) do
      list[k] = point(part)
      if not list[k] then return nil end
    end
    return list[1] and list
  end
  local a, b = from and point(from) or not from and { 0, 0 } or nil, point(to or by or "")
  if not a or not b then return nil end
  return { a, to and b or { a[1] + b[1], a[2] + b[2] } }
end

--- A function of a share of the time: the place on the way between points and its direction, and
--- the end of the way. nil: there is none.
local function way_of_points(mover, i, mode)
  local points, distances = read_points(mover, i), nil
  if not points then return nil end
  if words.is(mode, "paced") then
    distances = {}
    for k = 2, #points do
      local dx, dy = points[k][1] - points[k - 1][1], points[k][2] - points[k - 1][2]
      distances[k - 1] = math.sqrt(dx * dx + dy * dy)
    end
  end
  local place, last = placer(mover, i, mode, #points, distances), points[#points]
  return place and function(at)
    local first, share = place(at)
    local a, b = points[first + 1], points[first + 2] or points[first + 1]
    local dx, dy = b[1] - a[1], b[2] - a[2]
    return a[1] + dx * share, a[2] + dy * share, math.deg(math.atan(dy, dx)), last[1], last[2]
  end
end

--- A function of a share of the time: the share of the line. nil: the lists of the element lie.
local function share_of_line(mover, i, mode)
  local points = mover:text(i, "keyPoints")
  if words.is(mode, "paced") or not points and not words.is(mode, "spline") then
    return function(at) return at end
  end
  local list = points and words.parts(points) or { "0", "1" }
  for k, part in ipairs(list) do
    list[k] = math.max(0, math.min(1, words.number(part, 1) or 1))
  end
  local place = list[1] and placer(mover, i, mode, #list)
  return place and function(at)
    local first, share = place(at)
    local from, to = list[first + 1], list[math.min(first + 2, #list)]
    return from + (to - from) * share
  end
end

--- The turn that `rotate` asks for, where the way has no direction, and how much of that is added.
local function turn_of(rotate)
  if not rotate then return 0, 0 end
  if words.is(rotate, "auto") then return 0, 1 end
  if words.is(rotate, "auto%-reverse") then return 180, 1 end
  return words.number(rotate, words.skip_space(rotate, 1)) or 0, 0
end

local function move(mover, i)
  local mode, rotate, accumulate, additive = mover:text(i, "calcMode", "rotate", "accumulate",
    "additive")
  mode = mode or "paced"
  local share_at, way = share_of_line(mover, i, mode), way_of_points(mover, i, mode)
  local turn, follows = turn_of(rotate)
  local values, from, to = mover:text(i, "values", "from", "to")
  local is_by, sums = not (values or from or to), words.is(accumulate, "sum")
  local is_added = words.is(additive, "sum")
  return function(by, at, round)
    local share = share_at and share_at(at)
    local has_line, x, y, degrees, far_x, far_y = by:spot(i, share or 0)
    if has_line and not share then return end
    if not has_line and way then x, y, degrees, far_x, far_y = way(at) end
    if not x then return end
    if sums then x, y = x + far_x * round, y + far_y * round end
    by:place(i, x, y, turn + follows * degrees, is_added or not has_line and is_by)
  end
end

-- ---------------------------------------------------------------- all of them

local function nothing() end

--- What an animation does at a share of its time, in a round: it is made once, unless its values
--- are those of other elements, which may move, so that they mix at one time and not at another.
local function act_of(mover, plan, i)
  if plan.acts[i] then return plan.acts[i] end
  local tag = plan.tags[i]
  local act = (tag == "animateMotion" and move or animate)(mover, i, tag) or nothing
  local texts = words.key(mover:text(i, "values", "from", "to", "by")):lower()
  if not texts:find("inherit", 1, true) and not texts:find("currentcolor", 1, true) then
    plan.acts[i] = act
  end
  return act
end

--- Rounding of the end of a frozen animation must not begin another round.
local SAME_TIME = 1e-9

--- The share of the round at a time, and how many rounds were completed; nil: there is no effect.
local function progress(run, i, seconds)
  local from, rule = run.begun[i], run.given.rules[i]
  if not from then return nil end
  -- the end of what it repeats, where `min` makes it longer
  local finish = math.min(run.ended[i], from + rule.whole)
  local is_running = run.is_active[i] and seconds < finish
  if not is_running and not rule.freezes then return nil end
  local at = is_running and seconds or finish
  local rounds = rule.simple < huge and (at - from) / rule.simple or 0
  local round = math.floor(rounds)
  local share = rounds - round
  if not is_running and round > 0 and share < SAME_TIME then return 1, round - 1 end
  return share, round
end

--- Sorts the numbers of animations by target and attribute. Of those that have begun, the later
--- ones win. They are mostly sorted.
local function sort(list, plan, begun)
  local targets, names = plan.targets, plan.names
  local function is_before(a, b)
    if targets[a] ~= targets[b] then return targets[a] < targets[b] end
    if names[a] ~= names[b] then return names[a] < names[b] end
    if begun and begun[a] ~= begun[b] then return begun[a] < begun[b] end
    return a < b
  end
  for k = 2, #list do
    if is_before(list[k], list[k - 1]) then
      table.sort(list, is_before)
      return
    end
  end
end

--- What the elements of a document say, read once: for `measure` and `move`.
function smil.read(mover)
  local plan = read_times(mover)
  plan.acts, plan.order = {}, {}
  for i, target in ipairs(plan.targets) do
    if target then plan.order[#plan.order + 1] = i end
  end
  sort(plan.order, plan)
  return plan
end

--- The end of the last animation and the longest period.
smil.measure = times.measure

--- Moves the document to a time.
function smil.move(mover, plan, seconds)
  local last = plan.run
  plan.run = nil -- an error, such as of a limit of steps, leaves a run in the middle
  local run, message = times.run(plan, seconds, last)
  if not run then mover:refuse(message) end
  plan.run = run
  local active, shares, rounds = {}, {}, {}
  for _, i in ipairs(plan.order) do
    local share, round = progress(run, i, seconds)
    if share then
      active[#active + 1] = i
      shares[i], rounds[i] = share, round
    end
  end
  sort(active, plan, run.begun)
  for _, i in ipairs(active) do act_of(mover, plan, i)(mover, shares[i], rounds[i]) end
end

return smil
