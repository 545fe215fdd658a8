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
local function add_durations(mover, i, timing)
  local function clock(name) return whole(mover:text(i, name), take_clock) end
  local count = whole(mover:text(i, "repeatCount"), words.number)
  local limit, least, most = clock "repeatDur", clock "min", clock "max"
  timing.simple = clock "dur" or huge
  timing.whole = not count and not limit and timing.simple or huge
  if count and timing.simple < huge then timing.whole = timing.simple * count end
  timing.whole = math.min(timing.whole, limit or huge)
  timing.least, timing.most = least and least < huge and least or 0, most or huge
  if timing.least > timing.most then timing.least, timing.most = 0, huge end
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

--- Adds one of the moments of a list. False: only an event or a script gives it.
local function add_moment(text, which, timing, find)
  if text:find "^[+.%d-]" then
    local list, offset = timing[which], offset_in(text, 1)
    list[#list + 1] = offset
    return offset ~= nil
  end
  local id, event, behind = follower(text)
  local offset = id and offset_in(text, behind)
  local of = offset and find(id)
  if of then
    if not timing.links[1] then timing.links = {} end
    table.insert(timing.links, { which = which, of = of, event = event, offset = offset })
  end
  return of ~= nil
end

--- Reads begin or end. Returns whether the list has what is never, or what only an event gives.
local function add_moments(mover, i, name, which, timing, find)
  local is_open, is_noted = false, false
  for _, text in ipairs(words.parts(mover:text(i, name) or "")) do
    if not add_moment(text, which, timing, find) then
      is_open = true
      local is_silent = is_noted or name == "end" and text:lower():find "^indefinite%f[^%a-]"
      if not is_silent then
        is_noted = true
        mover:skip(i, ('%s "%s" is not run'):format(name, text:sub(1, 40)))
      end
    end
  end
  table.sort(timing[which])
  return is_open
end

local NONE = {} -- of the many animations without an end

local function add_times(mover, it, find)
  local i = it.number
  local restart = mover:text(i, "restart")
  it.restart = words.is(restart, "never") and "never"
    or words.is(restart, "whennotactive") and "whennotactive" or "always"
  it.freezes = words.is(mover:text(i, "fill"), "freeze")
  it.begins, it.ends, it.links = {}, mover:text(i, "end") and {} or NONE, NONE
  add_durations(mover, i, it)
  add_moments(mover, i, "begin", "begins", it, find)
  it.end_is_open = add_moments(mover, i, "end", "ends", it, find)
  if not mover:text(i, "begin") then it.begins[1] = 0 end
end

local function read_all(mover)
  local list, numbers = {}, nil
  repeat
    local i = #list + 1
    local target, name, tag = mover:animation(i)
    list[i] = tag and { number = i, target = target, name = name, tag = tag }
  until not tag
  local function find(id)
    if not numbers then
      numbers = {}
      for i = #list, 1, -1 do numbers[mover:text(i, "id") or ""] = i end
    end
    return numbers[id]
  end
  for _, it in ipairs(list) do add_times(mover, it, find) end
  return list
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

--- The place of a share of the time among values that are at these shares, or evenly, and between
--- which there are curves: 1.5 is in the middle between the second and the third. nil: the shares
--- do not ascend from 0, to 1 unless they are discrete.
local function place_in(shares, curves, at, count, is_discrete)
  local list = {}
  for k = 1, count do
    local curve = curves and curves[k - 1] or nil
    list[k] = { shares and shares[k] or (k - 1) / (count - 1), k - 1, curve }
  end
  local last = list[count][1]
  if list[1][1] ~= 0 or last > 1 or last < 1 and not is_discrete then return nil end
  local is_good, track = pcall(keys, list)
  return is_good and track:at(at) or nil
end

--- Where a share of the time is in a list of `count` values, by keyTimes and keySplines: at a share
--- between value `first`, counted from 0, and the next one. distances: between the values of a list
--- that is paced; nil: it is not. nil: the lists of the element lie.
local function place(mover, i, mode, at, count, distances)
  local is_discrete = words.is(mode, "discrete")
  local given, shares, curves = mover:text(i, "keyTimes"), nil, nil
  if words.is(mode, "paced") then
    shares = distances and paces(distances)
    if distances and not shares then return 0, 0 end
  elseif given then
    shares = list_of(given, count, number_of)
    if not shares then return nil end
  end
  if words.is(mode, "spline") and count > 1 then
    curves = list_of(mover:text(i, "keySplines"), count - 1, curve_of)
    if not curves then return nil end
  end
  local parts = is_discrete and count or math.max(1, count - 1)
  local where = at * parts
  if shares or curves then where = place_in(shares, curves, at, count, is_discrete) end
  if not where then return nil end
  local first = math.min(math.floor(where), parts - 1)
  return first, is_discrete and 0 or where - first
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

--- Where a share of the time is in a list, from `first`, counted from 0, to the next value; nil:
--- the lists of the element lie. last: the last value: those that do not mix are discrete.
local function place_in_values(mover, i, list, last, at)
  local mode, distances = mover:text(i, "calcMode") or "linear", nil
  if not mover:distance(i, last, last) then
    mode = "discrete"
  elseif words.is(mode, "paced") and list then
    distances = {}
    for k = 2, #list do distances[k - 1] = mover:distance(i, list[k - 1], list[k]) or 0 end
  end
  return place(mover, i, mode, at, list and #list or 2, distances)
end

--- Moves an attribute by a list of values.
local function animate_list(mover, i, list, at, how, round)
  local last = list[#list]
  local first, share = nil, nil
  if last then first, share = place_in_values(mover, i, list, last, at) end
  if first then
    mover:mix(i, nil, share, list[first + 1], how, list[first + 2] or last, how, false, last, round)
  end
end

--- The same by from, to and by. kind: of a transform; nil: of another attribute.
local function animate_ends(mover, i, given, at, how, round, kind)
  local from, to, by = given "from", given "to", given "by"
  if not to and not by then return end
  local first, share = place_in_values(mover, i, nil, to or by, at)
  if not first then return end
  local is_only, last = not from, nil -- without a beginning
  if is_only and to then
    from, how, round = kind and transform(kind, "") or nil, REPLACE, 0
  elseif is_only then
    from, how, last = kind and transform(kind, "0 0 0"), kind and ADD or REPLACE, by
  end
  mover:mix(i, nil, first + share, from, how, to or by, how, not to, last, round)
end

local function animate(mover, it, at, round)
  local i, kind = it.number, nil
  if it.tag == "set" then
    local to = mover:text(i, "to")
    if to then mover:mix(i, nil, 0, to, REPLACE, to, REPLACE) end
    return
  end
  if it.tag == "animateTransform" then
    local name = (mover:text(i, "type") or "translate"):match "^%s*(%a+)%s*$"
    kind = name and transforms[name:lower()]
    if not kind then return end
  end
  local function given(name)
    local value = mover:text(i, name)
    return value and kind and transform(kind, value) or value
  end
  local how = words.is(mover:text(i, "additive"), "sum") and ADD or REPLACE
  if not words.is(mover:text(i, "accumulate"), "sum") then round = 0 end
  local values = mover:text(i, "values")
  if not values then
    animate_ends(mover, i, given, at, how, round, kind)
    return
  end
  local list = words.parts(values)
  for k = 1, kind and #list or 0 do list[k] = transform(kind, list[k]) end
  animate_list(mover, i, list, at, how, round)
end

-- ---------------------------------------------------------------- ways

local function point(text) return (words.numbers(text, 1, 2)) end

--- The points of the list, or the two of from, to and by; nil: there are none.
local function read_points(mover, i)
  local values, from = mover:text(i, "values"), mover:text(i, "from")
  local to, by = mover:text(i, "to"), mover:text(i, "by")
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

--- The place on the way between points and its direction, and the end of the way.
local function spot_on_points(mover, i, mode, at)
  local points, distances = read_points(mover, i), nil
  if not points then return nil end
  if words.is(mode, "paced") then
    distances = {}
    for k = 2, #points do
      local dx, dy = points[k][1] - points[k - 1][1], points[k][2] - points[k - 1][2]
      distances[k - 1] = math.sqrt(dx * dx + dy * dy)
    end
  end
  local first, share = place(mover, i, mode, at, #points, distances)
  if not first then return nil end
  local a, b, last = points[first + 1], points[first + 2] or points[first + 1], points[#points]
  local dx, dy = b[1] - a[1], b[2] - a[2]
  return a[1] + dx * share, a[2] + dy * share, math.deg(math.atan(dy, dx)), last[1], last[2]
end

local function key_point(text)
  return math.max(0, math.min(1, words.number(text, 1) or 1))
end

--- The share of the line at a share of the time; nil: the lists of the element lie.
local function share_of_line(mover, i, mode, at)
  local points = mover:text(i, "keyPoints")
  if words.is(mode, "paced") or not points and not words.is(mode, "spline") then return at end
  local list = points and words.parts(points) or { "0", "1" }
  local first, share = place(mover, i, mode, at, #list)
  if not first or #list == 0 then return nil end
  local from, to = key_point(list[first + 1]), key_point(list[math.min(first + 2, #list)])
  return from + (to - from) * share
end

--- The turn that `rotate` asks for, where the way has this direction.
local function turn(rotate, degrees)
  if not rotate then return 0 end
  if words.is(rotate, "auto") then return degrees end
  if words.is(rotate, "auto%-reverse") then return degrees + 180 end
  return words.number(rotate, words.skip_space(rotate, 1)) or 0
end

local function move(mover, it, at, round)
  local i = it.number
  local mode = mover:text(i, "calcMode") or "paced"
  local share = share_of_line(mover, i, mode, at)
  local has_line, x, y, degrees, far_x, far_y = mover:spot(i, share or 0)
  if has_line and not share then return end
  if not has_line then x, y, degrees, far_x, far_y = spot_on_points(mover, i, mode, at) end
  if not x then return end
  if words.is(mover:text(i, "accumulate"), "sum") then
    x, y = x + far_x * round, y + far_y * round
  end
  local adds = words.is(mover:text(i, "additive"), "sum") or not has_line
    and not (mover:text(i, "values") or mover:text(i, "from") or mover:text(i, "to"))
  mover:place(i, x, y, turn(mover:text(i, "rotate"), degrees), adds)
end

-- ---------------------------------------------------------------- all of them

--- Rounding of the end of a frozen animation must not begin another round.
local SAME_TIME = 1e-9

--- The share of the round at a time, and how many rounds were completed; nil: there is no effect.
local function progress(it, seconds)
  if not it.target or not it.from then return nil end
  -- the end of what it repeats, where `min` makes it longer
  local finish = math.min(it.to, it.from + it.whole)
  local is_running = it.is_active and seconds < finish
  if not is_running and not it.freezes then return nil end
  local at = is_running and seconds or finish
  local rounds = it.simple < huge and (at - it.from) / it.simple or 0
  local round = math.floor(rounds)
  local share = rounds - round
  if not is_running and round > 0 and share < SAME_TIME then return 1, round - 1 end
  return share, round
end

--- Those that began later win.
local function is_before(a, b)
  if a.target ~= b.target then return a.target < b.target end
  if a.name ~= b.name then return a.name < b.name end
  if a.from ~= b.from then return a.from < b.from end
  return a.number < b.number
end

--- Moves the document to a time; seconds: nil: it stays. Returns the end of the last animation and
--- the longest period, where it stays.
function smil.run(mover, seconds)
  local list, active = read_all(mover), {}
  if not seconds then return times.measure(list) end
  local is_whole, message = times.run(list, seconds)
  if not is_whole then mover:refuse(message) end
  for _, it in ipairs(list) do
    it.share, it.round = progress(it, seconds)
    if it.share then active[#active + 1] = it end
  end
  table.sort(active, is_before)
  for _, it in ipairs(active) do
    local act = it.tag == "animateMotion" and move or animate
    act(mover, it, it.share, it.round)
  end
end

return smil
