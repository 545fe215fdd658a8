--- The animations of styles: @keyframes, and the properties that begin with `animation`. Between
--- which frames each property is at a time.
--
-- mover: what reads the document and mixes its values (src/kit/lua/module/mover.c).
local easings = require "celspan.svg_easing"
local ordered = require "celspan.ordered"
local words = require "celspan.svg_words"

local styles = {}

local huge = math.huge
local MOST = 64 -- animations of one element

-- ---------------------------------------------------------------- lists of words

--- The first items between the commas outside of parentheses, and `all`, how many there are.
local function split(text)
  local list, from, at, depth = { all = 0 }, 1, 1, 0
  repeat
    local place = text:find("[(),]", at) or #text + 1
    local sign = text:sub(place, place)
    if sign == "(" then depth = depth + 1 elseif sign == ")" then depth = depth - 1 end
    if sign == "" or sign == "," and depth <= 0 then
      list.all = list.all + 1
      if list.all <= MOST then list[list.all] = text:sub(from, place - 1):match "^%s*(.*)$" end
      from = place + 1
    end
    at = place + 1
  until sign == ""
  return list
end

--- Whether a word may end at a place.
local function ends_at(text, at) return text:find("^%s", at) ~= nil or at > #text end

--- A taker of one of these words: "ease" is no part of the name "ease.2".
local function choice(values)
  return function(text, at)
    local value, behind = words.choice(text, at, values)
    if value ~= nil and ends_at(text, behind) then return value, behind end
  end
end

local units = { ms = 1000, s = 1 } -- in a second

local function take_time(text, at)
  local value, behind = words.number(text, at)
  local unit, after = words.choice(text, behind or #text + 1, units)
  if unit then return value / unit, after end
end

local endless = choice { infinite = huge }

local function take_rounds(text, at)
  local value, behind = endless(text, at)
  if not value then value, behind = words.number(text, at) end
  if value and value >= 0 then return value, behind end
end

local function take_name(text, at)
  local quoted, behind = text:match("^[\"']([^\"']*)[\"']?()", at)
  if quoted then return quoted, behind end
  return text:match("^([^%s,]*)()", at)
end

local takers = {
  name = take_name, duration = take_time, delay = take_time, rounds = take_rounds,
  easing = easings.take,
  direction = choice { normal = {}, reverse = { is_backward = true },
                       alternate = { alternates = true },
                       ["alternate-reverse"] = { is_backward = true, alternates = true } },
  fill = choice { none = {}, forwards = { after = true }, backwards = { before = true },
                  both = { after = true, before = true } },
  state = choice { running = "running", paused = "paused" },
  composition = choice { replace = 0, add = 1, accumulate = 2 },
}
--- How often a value may be in the shorthand, in the order in which a word is tried.
local shorthand = { { "duration", 1 }, { "delay", 1 }, { "rounds", 1 }, { "easing", 1 },
                    { "fill", 1 }, { "direction", huge }, { "state", huge } }
--- The properties for one thing each, which win over the shorthand.
local properties = {
  name = "animation-name", duration = "animation-duration", delay = "animation-delay",
  rounds = "animation-iteration-count", direction = "animation-direction",
  fill = "animation-fill-mode", state = "animation-play-state",
  easing = "animation-timing-function", composition = "animation-composition",
}

-- ---------------------------------------------------------------- one animation

--- The first of the fields for which there is a value at a place of the shorthand, the value, and
--- the place behind it.
local function take_any(text, at, counts)
  for _, one in ipairs(shorthand) do
    local field, most = one[1], one[2]
    if (counts[field] or 0) < most then
      local value, behind = takers[field](text, at)
      if value ~= nil then return field, value, behind end
    end
  end
  return "name", take_name(text, at)
end

--- An item of `animation`: what is no other value is the name. With two names it is invalid.
local function take_all(text)
  local made, counts, at = {}, {}, 1
  while at <= #text do
    local field, value, behind = take_any(text, at, counts)
    counts[field] = (counts[field] or 0) + 1
    made[field] = value
    if field == "name" and counts.name > 1 then
      made.name = nil
      break
    end
    if not ends_at(text, behind) then break end -- not a list of words
    at = words.skip_space(text, behind)
  end
  return made
end

--- Item i of the text of a property, read; nil: there is none. Lists begin again after their end.
--- known: what was read, by property and text.
local function item(known, property, text, take, i)
  if not text then return nil end
  known[property] = known[property] or {}
  local list = known[property][text] or { items = split(text) }
  known[property][text] = list
  i = (i - 1) % #list.items + 1
  if list[i] == nil then list[i] = take(list.items[i], 1) or false end
  return list[i] or nil, list.items.all
end

--- Animation i of an element with these texts of properties.
local function read(known, texts, i)
  local made = { rounds = 1, duration = 0, delay = 0, easing = easings.ease, composition = 0,
                 direction = {}, fill = {} }
  local all = item(known, "animation", texts.animation, take_all, i)
  for field, value in next, all or {} do made[field] = value end
  for field, property in next, properties do
    local value = item(known, property, texts[property], takers[field], i)
    if value ~= nil then made[field] = value end
  end
  made.duration = math.max(0, made.duration)
  made.active = made.duration > 0 and made.duration * made.rounds or 0
  return made
end

-- ---------------------------------------------------------------- times

--- The share of the round at a time, as the direction has it, and whether the time is before the
--- beginning; nil: there is no effect. Source: Web Animations Level 1, 4.7 to 4.10.
local function share_at(it, seconds)
  local at = (it.state == "paused" and 0 or seconds) - it.delay
  local is_before, is_after = at < 0, at >= it.active
  if is_before and not it.fill.before then return nil end
  if not is_before and is_after and not it.fill.after then return nil end
  local whole = is_before and 0 or is_after and it.rounds or at / it.duration
  local round = whole < huge and math.floor(whole) or 0
  local share = whole < huge and whole - round or 1
  if share == 0 and is_after and not is_before and whole > 0 then share, round = 1, round - 1 end
  local is_odd = it.direction.alternates and math.fmod(round, 2) == 1
  local is_backward = (it.direction.is_backward or false) ~= (is_odd or false)
  if is_backward then share = 1 - share end
  if is_before then return share, not is_backward end
  return share, is_after and is_backward
end

-- ---------------------------------------------------------------- frames

local function is_frame_before(a, b)
  if a.at ~= b.at then return a.at < b.at end
  return a.number < b.number
end

--- The easing and the composition that a frame gives.
local function rules_of(frame)
  local easing, composition = nil, nil
  for k = 1, #frame, 2 do
    local name, text = frame[k], frame[k + 1]
    if name == "animation-timing-function" then easing = easings.take(text, 1) or easing end
    if name == "animation-composition" then
      composition = takers.composition(text, 1) or composition
    end
  end
  return easing, composition
end

--- The frames of a name: for each property the list of those that give it, and the properties in
--- the order of the file. False: there are none.
local function rule_of(mover, name)
  local frames, size = mover:frames(name)
  if not frames then return false end
  local names, lists = {}, {}
  for number, frame in ipairs(frames) do
    local easing, composition = rules_of(frame)
    for k = 1, #frame, 2 do
      local property = frame[k]
      local list = lists[property] or {}
      if not lists[property] and not property:find "^animation" then
        names[#names + 1], lists[property] = property, list
      end
      local is_again = list[1] and list[#list].number == number -- the last one counts
      list[is_again and #list or #list + 1] = { at = frame.at, number = number,
        text = frame[k + 1], easing = easing, composition = composition }
    end
  end
  for _, list in next, lists do table.sort(list, is_frame_before) end
  return { names = names, lists = lists, size = size }
end

--- Frames of an animation with one at 0 and one at 1. Of those at the same share with the same
--- easing and composition, the last one counts. Source: CSS Animations Level 2, 3.
local function complete(list, it)
  local made = {}
  local function add(at, text, easing, composition)
    local last = made[#made]
    local replaces = last and last.at == at and last.composition == composition
      and last.easing.key == easing.key
    made[replaces and #made or #made + 1] = { at = at, text = text, easing = easing,
                                              composition = composition }
  end
  if list[1].at ~= 0 then add(0, nil, it.easing, 0) end
  for _, one in ipairs(list) do
    add(one.at, one.text, one.easing or it.easing, one.composition or it.composition)
  end
  if made[#made].at ~= 1 then add(1, nil, it.easing, 0) end
  return made
end

--- Moves all properties that the frames of an animation give, each once.
local function move(mover, it, share, is_before)
  local rule = it.rule
  mover:count(rule.size * (1 + #rule.names))
  for k, name in ipairs(rule.names) do
    local list = it[k] or complete(rule.lists[name], it)
    it[k] = list
    local i = math.max(1, math.min(ordered.last(list, share, "at"), #list - 1))
    local low, high = list[i], list[i + 1] or list[i]
    local span = high.at - low.at
    local place = span > 0 and (share - low.at) / span or 1
    mover:mix(0, name, low.easing.at(place, is_before), low.text, low.composition, high.text,
      high.composition)
  end
end

-- ---------------------------------------------------------------- elements

local names = { "animation" } -- of all properties
for _, property in next, properties do names[#names + 1] = property end

--- The animations of elements with these texts of properties that have frames, and `all`, how many
--- they name.
local function list_of(mover, plan, ...)
  local texts, list = {}, {}
  for k, name in ipairs(names) do texts[name] = (select(k, ...)) end
  local _, all = item(plan.known, "animation-name", texts["animation-name"], take_name, 1)
  if not all then _, all = item(plan.known, "animation", texts.animation, take_all, 1) end
  list.all = all
  for i = 1, math.min(all, MOST) do
    local it = read(plan.known, texts, i)
    if it.name and plan.rules[it.name] == nil then
      plan.rules[it.name] = rule_of(mover, it.name)
    end
    it.rule = it.name and plan.rules[it.name]
    if it.rule then list[#list + 1] = it end
  end
  return list
end

--- Calls a function with the animations of each element that has some. plan: what was read before.
local function each(mover, plan, act)
  mover:visit(function()
    local key = words.key(mover:text(0, table.unpack(names)))
    local list = plan.lists[key] or list_of(mover, plan, mover:text(0, table.unpack(names)))
    plan.lists[key] = list
    act(list)
  end)
end

--- What the styles say: it is read when elements are visited, and then known.
function styles.read() return { known = {}, rules = {}, lists = {} } end

--- The end of the last animation that ends, and the longest period of the others.
function styles.measure(mover, plan)
  local finish, period = 0, 0
  each(mover, plan, function(list)
    if list.all > MOST then mover:skip(0, ("animations after the first %d"):format(MOST)) end
    for _, it in ipairs(list) do
      local whole = it.delay + it.active
      if it.state ~= "paused" and whole < huge then
        finish = math.max(finish, whole)
      elseif it.state ~= "paused" then
        period = math.max(period, it.duration * (it.direction.alternates and 2 or 1))
      end
    end
  end)
  return finish, period
end

--- Moves the document to a time.
function styles.move(mover, plan, seconds)
  each(mover, plan, function(list)
    for _, it in ipairs(list) do
      local share, is_before = share_at(it, seconds)
      if share then move(mover, it, share, is_before) end
    end
  end)
end

return styles
