--- celspan compare A B: whether two pictures, or two films as numbered pictures, show the same.
local program, request = ...
local core = require "celspan.core"

local DIFFERENT = 1
local a, b, output = request[1], request[2], request.output
local outcome

--- Compares two files, and prints the answer after a label.
local function compare(label, one, other, difference)
  local found = program.compare(one, other, difference)
  local text
  if found.sizes then
    text = ("sizes_differ %dx%d %dx%d"):format(table.unpack(found.sizes))
  else
    local place = found.largest > 0
      and (" x %d y %d channel %s"):format(found.x, found.y, found.channel) or ""
    text = ("largest_difference %.9g%s pixels_differing %d pixels %d")
      :format(found.largest, place, found.differing, found.pixels)
  end
  print(label .. text)
  if found.sizes or found.differing > 0 then outcome = DIFFERENT end
end

local function numbers_of(pattern)
  local numbers = program.check(core.frames(pattern))
  if #numbers == 0 then program.fail("input", "%s: no file matches this pattern", pattern) end
  local has = {}
  for _, number in ipairs(numbers) do has[number] = true end
  return numbers, has
end

local function name_of(pattern, number)
  return pattern and program.check(core.frame_name(pattern, number))
end

--- Prints the frames that only one of the films has.
local function print_missing(numbers, has_other, pattern)
  for _, number in ipairs(numbers) do
    if not has_other[number] then
      print(("frame %d only_in %s"):format(number, pattern))
      outcome = DIFFERENT
    end
  end
end

local function compare_films()
  if output and not program.has_number(output) then
    program.usage("%s: the differences of several frames need a number in the name, such as "
      .. "difference.####.png", output)
  end
  local in_a, has_a = numbers_of(a)
  local in_b, has_b = numbers_of(b)
  for _, number in ipairs(in_a) do
    if has_b[number] then
      compare(("frame %d "):format(number), name_of(a, number), name_of(b, number),
        name_of(output, number))
    end
  end
  print_missing(in_a, has_b, a)
  print_missing(in_b, has_a, b)
end

if output then program.refuse_target(output) end
if program.has_number(a) and program.has_number(b) then
  compare_films()
else
  compare("", a, b, output)
end
return outcome
