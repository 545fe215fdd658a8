--- Range selectors of text animators: how much of an animator each letter gets.
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

--- A selector as a function of the letters, the number of one and the frame.
---@return fun(list: table[], i: integer, t: number): number
---@return boolean moves
function ranges.compile(scope, given)
  given = values.table(given) or {}
  local moves = false
  local function number(name, default)
    local get, is_moving = property.number(scope, given[name], "the range's " .. name, default)
    moves = moves or is_moving
    return get
  end
  local by_index = given.r == 2
  local first, last, offset = number("s", 0), number("e", by_index and 1e6 or 100), number("o", 0)
  local amount = number("a", 100)
  local shape = shapes[values.number(given.sh, 1)] or shapes[1]
  local based = values.number(given.b, 1)
  if given.rn == 1 then scope.note "the random order of the range is left out" end
  local of = setmetatable({}, { __mode = "k" })
  return function(list, i, t)
    if not of[list] then of[list] = { count(list, based) } end
    local numbers, n = of[list][1], of[list][2]
    local unit = by_index and 1 or n / 100
    local s, e = (first(t) + offset(t)) * unit, (last(t) + offset(t)) * unit
    if s > e then s, e = e, s end
    return shape(numbers[i], s, e) * amount(t) / 100
  end, moves
end

return require "celspan.fields".seal("lottie_ranges", ranges)
