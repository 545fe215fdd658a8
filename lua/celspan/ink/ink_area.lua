--- Areas between lines as painted paths: ink.area, ink.areas, ink.leak.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"
local charts = require "celspan.ink_chart"

local ink = {}

local function read(noun, options, names)
  local given = charts.check(noun, options, names)
  return given, charts.search(noun, given[1], given)
end

---@class celspan.ink.areas.options
---@field [1] celspan.object|table Lines: an object, or a drawing with a field `object`
---@field at? number[] Of `area` and `leak`: a point inside the area
---@field colours? table[] Of `areas`: { x, y, colour }, a point inside each area and its paint
---@field gap? number Openings up to this width are closed, in units, 0 to 1000000; default 8
---@field fill? celspan.texture|celspan.paint|string Of `area`; default black
---@field under? boolean Whether areas reach to the middle of the lines around them; default true
---@field fallback? celspan.object Is shown where there is no area, instead of an error
---@field scale? number Pixels for each unit at which areas are found; by default the longer side has 1024, up to 4096 for thin lines

--- The area around a point, between lines. An error says where it runs out, or that the point lies
--- on a line.
---@param options celspan.ink.areas.options
---@return celspan.object area A path
function ink.area(options)
  local noun = "ink: area"
  local given, search = read(noun, options, { "any", at = "table", fill = "any" })
  fields.numbers(noun, "at[%d]", given.at, 2, "{x, y}")
  local number, what = search:find(given.at)
  if number then
    return search:outline({ number }, given.under ~= false)[number]:with { fill = given.fill }
  end
  return given.fallback or native.refuse(noun .. ": " .. search:leak(given.at, what).message)
end

local function name_of(i) return ("colours[%d]"):format(i) end

local function have_one_colour(seed, other) return seed[3] == other[3] end

--- The places of the seeds, once they are checked.
local function check_colours(noun, colours)
  local keys = {}
  for i, seed in ipairs(colours) do
    fields.numbers(noun, name_of(i) .. "[%d]", seed, 2, "{x, y, colour}")
    fields.expect(seed[3] ~= nil, seed[3], "%s: %s must be {x, y, colour}", noun, name_of(i))
    keys[i] = i
  end
  return keys
end

--- Many areas at once, each in its colour. Errors are those of `area`, and two colours in one area.
---@param options celspan.ink.areas.options
---@return celspan.object art The areas in the order of their points
function ink.areas(options)
  local noun = "ink: areas"
  local given, search = read(noun, options, { "any", colours = "table" })
  local colours, first, list, shown = given.colours or {}, {}, {}, {}
  local numbers = search:seek(colours, check_colours(noun, colours), name_of, have_one_colour,
    given.fallback)
  for i in ipairs(colours) do
    local number = numbers[i]
    if number and not first[number] then first[number], list[#list + 1] = i, number end
  end
  local paths = search:outline(list, given.under ~= false)
  for i, seed in ipairs(colours) do
    local number = numbers[i]
    if not number then
      shown[#shown + 1] = given.fallback
    elseif first[number] == i then
      shown[#shown + 1] = paths[number]:with { fill = seed[3] }
    end
  end
  return celspan.union(shown)
end

---@class celspan.ink.leak
---@field message string
---@field at? number[] The middle of the opening through which it runs out
---@field width? number Of the opening, in units
---@field gap? number What closes it

--- Why there is no area at a point; nil if there is one.
---@param options celspan.ink.areas.options
---@return celspan.ink.leak?
function ink.leak(options)
  local noun = "ink: leak"
  local given, search = read(noun, options, { "any", at = "table" })
  fields.numbers(noun, "at[%d]", given.at, 2, "{x, y}")
  local number, what = search:find(given.at)
  return not number and search:leak(given.at, what) or nil
end

return ink
