--- Timing functions of styles: the share of a change at a share of its time.
--
--   local easing, behind = easings.take("steps(4, start) 2s", 1)
--   easing.at(0.3, false)       -- is_before: the time is before the beginning
--   easing.key                  -- the same for equal functions
local ease = require "celspan.ease"
local words = require "celspan.svg_words"

local easings = {}

local STEPS, STOPS = 1e6, 65536 -- the most

--- A cubic curve from 0, 0 to 1, 1; nil: it has other places in x.
function easings.curve(points)
  local x1, y1, x2, y2 = table.unpack(points)
  if x1 < 0 or x1 > 1 or x2 < 0 or x2 > 1 then return nil end
  local key = ("bezier:%.17g,%.17g,%.17g,%.17g"):format(x1, y1, x2, y2)
  return { key = key, at = ease(key) }
end

--- Source: CSS Easing Functions Level 1, 2.3.1. at_start, at_end: 1 where it jumps there, too.
local function steps(count, at_start, at_end)
  local jumps = count - 1 + at_start + at_end
  local function at(share, is_before)
    local place = share * count
    local done = math.floor(place)
    if is_before and place == done then done = done - 1 end
    return math.max(0, math.min(done + at_start, jumps)) / jumps
  end
  return jumps > 0 and { key = ("steps:%d,%d,%d"):format(count, at_start, at_end), at = at } or nil
end

-- ---------------------------------------------------------------- stops

--- A stop as written: a number `y`, and up to two places.
local function read_stop(part)
  local stop, at = {}, words.skip_space(part, 1)
  while at <= #part do
    local value, behind = words.number(part, at)
    if not value then return nil end
    local is_place = part:find("^%%", behind)
    if is_place then
      if #stop == 2 then return nil end
      stop[#stop + 1] = value / 100
    else
      if stop.y then return nil end
      stop.y = value
    end
    at = words.skip_space(part, is_place and behind + 1 or behind)
  end
  return stop.y and stop
end

--- Gives all stops a place: those without one lie evenly between those around them, and none lies
--- before another one.
local function set_places(list)
  list[1][1] = list[1][1] or 0
  list[#list][1] = list[#list][1] or 1
  local last, x = 1, math.max(list[1][1], list[1][2] or list[1][1])
  for i = 2, #list do
    if list[i][1] then
      local to = math.max(x, list[i][1])
      for k = last + 1, i - 1 do list[k][1] = x + (to - x) * (k - last) / (i - last) end
      list[i][1] = to
      last, x = i, math.max(to, list[i][2] or to)
    end
  end
end

--- Source: CSS Easing Functions Level 2, 2.2.1. Beyond the ends the outer lines continue.
local function stops(text)
  local list, points = {}, {}
  for part in (text .. ","):gmatch "([^,]*)," do
    local stop = read_stop(part)
    if not stop or #list == STOPS then return nil end
    list[#list + 1] = stop
  end
  if #list < 2 then return nil end
  set_places(list)
  for _, stop in ipairs(list) do
    points[#points + 1] = { stop[1], stop.y }
    if stop[2] then points[#points + 1] = { math.max(stop[1], stop[2]), stop.y } end
  end
  return { key = "linear:" .. text, at = function(share)
    local i = 2
    while points[i + 1] and points[i][1] <= share do i = i + 1 end
    local a, b = points[i - 1], points[i]
    if b[1] <= a[1] or share == b[1] then return b[2] end
    return a[2] + (b[2] - a[2]) * ((share - a[1]) / (b[1] - a[1]))
  end }
end

-- ---------------------------------------------------------------- texts

local functions = { linear = stops }

functions["cubic-bezier"] = function(text)
  local points, behind = words.numbers(text, 1, 4)
  return points and words.is_blank(text, behind) and easings.curve(points) or nil
end

local jumps = { start = { 1, 0 }, ["jump-start"] = { 1, 0 }, ["end"] = { 0, 1 },
                ["jump-end"] = { 0, 1 }, ["jump-none"] = { 0, 0 }, ["jump-both"] = { 1, 1 },
                [""] = { 0, 1 } }

function functions.steps(text)
  local count, word = text:match "^%s*%+?(%d+)%s*,?%s*([%a-]*)%s*$"
  local jump = count and jumps[word:lower()]
  count = tonumber(count)
  return jump and count >= 1 and count <= STEPS and steps(count, jump[1], jump[2]) or nil
end

local named = {
  linear = { key = easings.curve { 0, 0, 1, 1 }.key, at = ease "linear" },
  ease = easings.curve { 0.25, 0.1, 0.25, 1 },
  ["ease-in"] = easings.curve { 0.42, 0, 1, 1 }, ["ease-out"] = easings.curve { 0, 0, 0.58, 1 },
  ["ease-in-out"] = easings.curve { 0.42, 0, 0.58, 1 },
  ["step-start"] = steps(1, 1, 0), ["step-end"] = steps(1, 0, 1),
}
easings.ease = named.ease

--- The timing function at a place of a text, and the place behind it; nil: there is none.
function easings.take(text, at)
  at = words.skip_space(text, at)
  local make, behind = words.choice(text, at, functions)
  local inside, closed = text:match("^%(([^)]*)%)()", behind or #text + 1)
  if inside then return make(inside), closed end
  if make and text:find("^%(", behind) then return nil end
  return words.choice(text, at, named)
end

return easings
