--- celspan compare A B: whether two pictures, or two films as numbered pictures, show the same.
local program, request = ...
local native = require "celspan.native"

local DIFFERENT = 1
local a, b, output = request[1], request[2], request.output
local facts = program.part("facts.lua", program, request)
local outcome

--- Compares two files: returns the result, and the same as a line.
local function compare(one, other, difference)
  local found = program.compare(one, other, difference)
  if found.sizes or found.differing > 0 then outcome = DIFFERENT end
  if found.sizes then
    return found, ("sizes_differ %dx%d %dx%d"):format(table.unpack(found.sizes))
  end
  local place = found.largest > 0
    and (" x %d y %d channel %s"):format(found.x, found.y, found.channel) or ""
  return found, ("largest_difference %.9g%s pixels_differing %d pixels %d"):format(found.largest,
    place, found.differing, found.pixels)
end

local function numbers_of(pattern)
  local numbers = program.check(native.frames(pattern))
  if #numbers == 0 then program.fail("input", "%s: no file matches this pattern", pattern) end
  local has = {}
  for _, number in ipairs(numbers) do has[number] = true end
  return numbers, has
end

local function name_of(pattern, number)
  return pattern and program.check(native.frame_name(pattern, number))
end

local function compare_frame(number)
  local found, line = compare(name_of(a, number), name_of(b, number), name_of(output, number))
  found.frame = number
  facts:item("frames", found, "frame %d %s", number, line)
end

--- Adds the frames that exist in only one of the films.
local function add_missing(numbers, has_other, pattern)
  for _, number in ipairs(numbers) do
    if not has_other[number] then
      facts:item("frames", { frame = number, only_in = pattern }, "frame %d only_in %s", number,
        pattern)
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
  facts:lists "frames"
  for _, number in ipairs(in_a) do
    if has_b[number] then compare_frame(number) end
  end
  add_missing(in_a, has_b, a)
  add_missing(in_b, has_a, b)
end

local function compare_pictures()
  local found, line = compare(a, b, output)
  for name, value in pairs(found) do facts:set(name, value) end
  facts:line("%s", line)
end

if output then program.refuse_target(output) end
if program.has_number(a) and program.has_number(b) then
  compare_films()
else
  compare_pictures()
end
facts:finish()
return outcome
