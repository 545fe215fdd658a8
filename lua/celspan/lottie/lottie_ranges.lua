--- Range selectors of text animators: how much of an animator each letter gets.
local ease = require "celspan.ease"
local property = require "celspan.lottie_property"
local values = require "celspan.lottie_values"

local ranges = {}

local function held(x) return x < 0 and 0 or x > 1 and 1 or x end

--- Shapes of a range from s to e at the letter i, both in letters. All have 0..1.
local shapes = {
  function(i, s, e) -- square
    if i < math.floor(s) then return 0 end
    if i - s < 0 then return held(math.min(e, i + 1) - s) end
    return held(e - i)
  end,
  function(i, s, e) -- ramp up
    if e == s then return i >= e and 1 or 0 end
    return held((i + 0.5 - s) / (e - s))
  end,
  function(i, s, e) -- ramp down
    if e == s then return i >= e and 0 or 1 end
    return 1 - held((i + 0.5 - s) / (e - s))
  end,
  function(i, s, e) -- triangle
    if e == s then return 0 end
    local u = held((i + 0.5 - s) / (e - s))
    return u < 0.5 and 2 * u or 2 - 2 * u
  end,
  function(i, s, e) -- round
    if e == s then return 0 end
    local x = 2 * held((i + 0.5 - s) / (e - s)) - 1
    return math.sqrt(math.max(0, 1 - x * x))
  end,
  function(i, s, e) -- smooth
    if e == s then return 0 end
    return (1 - math.cos(2 * math.pi * held((i + 0.5 - s) / (e - s)))) / 2
  end,
}

--- The number of each letter, from 0, in the units of a selector; and how many there are.
--- based: 1 letters, 2 letters without spaces, 3 words, 4 lines
local function count(list, based)
  local numbers, n, is_in = {}, 0, false
  for i, letter in ipairs(list) do
    local is_space = letter.text:find "^%s*$" ~= nil
    if based == 1 then numbers[i], n = i - 1, i
    elseif based == 2 then
      numbers[i] = n
      if not is_space then n = n + 1 end
    elseif based == 4 then numbers[i], n = letter.line - 1, letter.line
    else
      local is_new = list[i - 1] and list[i - 1].line ~= letter.line
      if not is_space and (not is_in or is_new) then n = n + 1 end
      is_in, numbers[i] = not is_space, math.max(0, n - 1)
    end
  end
  return numbers, n
end

--- A square is as soft as its smoothness: at 50 % the middle half of a step is stretched to all of
--- it, at 0 % a letter is in it or not.
local function sharpened(x, smooth)
  return held((x - (0.5 - smooth / 2)) / math.max(smooth, 1e-9))
end

--- The ease of a range: how it leaves its least value and comes to its greatest, each from -1 to 1.
local function eased(x, low, high)
  if low == 0 and high == 0 or x <= 0 or x >= 1 then return x end
  return ease(("bezier:%.9g,%.9g,%.9g,%.9g"):format(math.max(0, low), math.max(0, -low),
    1 - math.max(0, high), 1 + math.min(0, high)))(x)
end

--- How the value of a shape is changed by the smoothness, the eases and the mode.
local function changes_of(scope, given, shape, number)
  local least, greatest = number("ne", 0), number("xe", 0)
  local smooth = shape == shapes[1] and given.sm ~= nil and number("sm", 100)
  local is_taken = values.number(given.m, 1) == 2 -- the others are for several ranges
  if given.rn == 1 then scope.note "the random order of the range is left out" end
  if given.t == 1 then scope.note "the range is an expression, which is not run" end
  local function share(get, t) return math.max(-1, math.min(1, get(t) / 100)) end
  return function(x, t)
    x = eased(x, share(least, t), share(greatest, t))
    if smooth then x = sharpened(x, math.max(0, math.min(1, smooth(t) / 100))) end
    return is_taken and 1 - x or x
  end
end

--- A selector as a function of the letters, the number of one and the frame.
---@return fun(list: table[], i: integer, t: number): number
---@return boolean moves
function ranges.compile(scope, given)
  given = values.table(given) or {}
  local read, moves = property.reader(scope)
  local function number(name, default)
    return read(property.number, given[name], "the range's " .. name, default)
  end
  local by_index = given.r == 2
  local first, last, offset = number("s", 0), number("e", by_index and 1e6 or 100), number("o", 0)
  local amount = number("a", 100)
  local shape = shapes[values.number(given.sh, 1)] or shapes[1]
  local based = values.number(given.b, 1)
  local change = changes_of(scope, given, shape, number)
  local of = setmetatable({}, { __mode = "k" })
  return function(list, i, t)
    if not of[list] then of[list] = { count(list, based) } end
    local numbers, n = of[list][1], of[list][2]
    local unit = by_index and 1 or n / 100
    local s, e = (first(t) + offset(t)) * unit, (last(t) + offset(t)) * unit
    if s > e then s, e = e, s end
    return change(shape(numbers[i], s, e), t) * amount(t) / 100
  end, moves()
end

return require "celspan.fields".seal("lottie_ranges", ranges)
