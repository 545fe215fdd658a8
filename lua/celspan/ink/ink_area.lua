--- Areas between lines as painted paths: ink.area, ink.areas, ink.leak.
--
-- The lines are rendered as a picture; its areas are found there, and traced, all together, so that
-- two that touch share their border.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"

local ink = {}

local GAP = 8          -- units
local MARGIN = 8       -- pixels around the lines
local LEAST, MOST = 1024, 4096 -- pixels of the longer side
local FEW = 0.01       -- of lines may be thinner than three pixels
local BLACK = "#000000"

-- ---------------------------------------------------------------- the lines as a picture

local Chart = {}
Chart.__index = Chart

--- A chart of an object at a scale in pixels for each unit; nil and a message.
local function render(object, scale)
  local x, y, w, h = object:bounds()
  local chart = setmetatable({ scale = scale, x = x - MARGIN / scale, y = y - MARGIN / scale,
    width = math.ceil(w * scale) + 2 * MARGIN, height = math.ceil(h * scale) + 2 * MARGIN }, Chart)
  local placed = object:translate(-chart.x, -chart.y):scale(scale)
  local size = { chart.width, chart.height }
  local mask = celspan.matte(celspan.rect { 0, 0, size[1], size[2], texture = BLACK }, placed)
  local image, message = celspan.pixels(celspan.rostrum { antialias = "area",
    celspan.cel { mask } }, { size = size, film = size })
  if not image then return nil, message end
  chart.bytes = image:bytes()
  return chart
end

--- The areas where openings up to a gap, in units, are closed.
function Chart:divide(noun, gap)
  if self.gap ~= gap then
    local areas, thin = native.areas(self.bytes, self.width, self.height, gap * self.scale)
    if not areas then native.refuse(noun .. ": " .. thin) end
    self.gap, self.areas, self.thin = gap, areas, thin
  end
  return self.areas
end

function Chart:pixel(at) return (at[1] - self.x) * self.scale, (at[2] - self.y) * self.scale end

--- The number of the area at a point; nil and why there is none.
function Chart:find(noun, gap, at)
  local x, y = self:pixel(at)
  local number, is_line = native.areas_at(self:divide(noun, gap), x, y)
  if is_line then return nil, "line" end
  if number == 0 then return nil, "outside" end
  return number
end

--- The chart of an object, as fine as its thinnest lines need if no scale is given.
local function chart_of(noun, object, scale, gap)
  local _, _, w, h = object:bounds()
  if not w or math.max(w, h) <= 0 then return nil end
  local side = math.max(w, h)
  local most = (MOST - 2 * MARGIN - 1) / side
  if scale then
    fields.must(scale > 0 and scale <= most, noun .. ": field 'scale'", ("above 0, up to %.6g: "
      .. "the longer side of these lines may have %d pixels"):format(most, MOST), scale)
  end
  local pixels = scale or LEAST / side
  local chart, message
  repeat
    chart, message = render(object, pixels)
    if not chart then native.refuse(noun .. ": " .. message) end
    chart:divide(noun, gap)
    local is_fine = scale or chart.thin <= FEW or pixels == most
    pixels = math.min(2 * pixels, most)
  until is_fine
  return chart
end

local charts = setmetatable({}, { __mode = "k" })

--- The chart of lines, kept as long as they are; nil where there are none.
local function read_lines(noun, options, gap)
  local lines, scale = options[1], options.scale
  local object = fields.is_object(lines) and lines
    or type(lines) == "table" and fields.is_object(lines.object) and lines.object
  fields.expect_kind(object, lines, "%s: the first value must be lines: an object, or a drawing "
    .. "with an object", noun)
  local kept = charts[object]
  if not kept or kept.asked ~= scale then
    kept = { asked = scale, chart = chart_of(noun, object, scale, gap) }
    charts[object] = kept
  end
  return kept.chart
end

-- ---------------------------------------------------------------- where an area runs out

local function tenth(value) return ("%.14g"):format(math.floor(value * 10 + 0.5) / 10) end

local function place_text(at) return ("(%s, %s)"):format(tenth(at[1]), tenth(at[2])) end

--- The first gap, of some that are hardly wider than an opening, that makes `holds()` true.
local function wider(noun, chart, gap, width, holds)
  local step = width < 2 and 0.1 or 1
  local least = math.max(math.ceil(width / step - 1e-9) * step, gap)
  for _, more in ipairs { 0, step, 2 * step, math.ceil(least / 2) } do
    if least + more > gap and holds(least + more) then return least + more end
  end
  chart:divide(noun, gap)
end

--- The narrowest opening on the way from a point to another one, or out: `at`, `width`, `gap`, in
--- units, and `text`. holds: whether a gap closes it.
local function opening(noun, chart, gap, from, to, holds)
  local x, y = chart:pixel(from)
  local areas = chart:divide(noun, gap)
  local u, v, width
  if to then
    u, v, width = native.areas_way(areas, x, y, chart:pixel(to))
  else
    u, v, width = native.areas_way(areas, x, y)
  end
  if not u then native.refuse(noun .. ": " .. v) end
  local leak = { at = { u / chart.scale + chart.x, v / chart.scale + chart.y },
    width = width / chart.scale }
  leak.gap = wider(noun, chart, gap, leak.width, holds)
  leak.text = ("through an opening of %s at %s; %s"):format(tenth(leak.width), place_text(leak.at),
    leak.gap and ("gap = %s would close it"):format(tenth(leak.gap))
      or "no gap near that closes it: draw a line there")
  return leak
end

--- Whether lines go around a point as far as its picture shows: not if it is beside all of them.
local function is_within(chart, at)
  local x, y = chart:pixel(at)
  return x > MARGIN and y > MARGIN and x < chart.width - MARGIN and y < chart.height - MARGIN
end

--- Why there is no area at a point: a table with `message`, and of an opening where it is.
local function leak_of(noun, chart, gap, at, what)
  local place = place_text(at)
  if what == "line" then return { message = ("the point %s lies on a line"):format(place) } end
  local leak = chart and is_within(chart, at) and opening(noun, chart, gap, at, nil,
    function(more) return chart:find(noun, more, at) end)
  if not leak or leak.width == math.huge then
    return { message = ("the point %s is outside: no lines go around it"):format(place) }
  end
  leak.message, leak.text = ("the area at %s runs out %s"):format(place, leak.text), nil
  return leak
end

-- ---------------------------------------------------------------- paths

--- Paths around areas, by their numbers.
local function outline(noun, chart, numbers, is_under)
  local bytes, colours, x, y, w, h = native.areas_picture(chart.areas, numbers, is_under)
  local codes, seen, data, paths = {}, {}, {}, {}
  for _, number in ipairs(numbers) do
    local code = colours[number]
    if not seen[code] then seen[code], codes[#codes + 1] = true, code end
    data[number] = {}
  end
  local art, message = native.trace(celspan.picture { pixels = bytes, size = { w, h } },
    { colours = codes, smooth = 1, speckle = 0 })
  if not art then native.refuse(noun .. ": " .. message) end
  for _, shape in ipairs(art.shapes) do
    local number = native.areas_at(chart.areas, shape.x + x, shape.y + y)
    if data[number] then table.insert(data[number], shape.d) end
  end
  for _, number in ipairs(numbers) do
    if #data[number] == 0 then native.refuse(noun .. ": an area is too narrow to be outlined") end
    paths[number] = celspan.path { d = table.concat(data[number], " ") }:translate(x, y)
      :scale(1 / chart.scale):translate(chart.x, chart.y)
  end
  return paths
end

-- ---------------------------------------------------------------- the functions

local function known(more)
  local list = { "any", gap = "number", scale = "number" }
  for name, kind in pairs(more) do list[name] = kind end
  return list
end

local of_area = known { at = "table", fill = "any", under = "boolean", fallback = "any" }
local of_areas = known { colours = "table", under = "boolean", fallback = "any" }
local of_leak = known { at = "table" }

--- The checked options, the gap, and the chart of the lines.
local function read(noun, options, names)
  options = fields.check(noun, options, names)
  local gap, fallback = options.gap or GAP, options.fallback
  fields.must(gap >= 0 and gap <= 1e6, noun .. ": field 'gap'", "from 0 to 1000000", gap)
  fields.expect_kind(fallback == nil or fields.is_object(fallback), fallback,
    "%s: field 'fallback' must be an object", noun)
  local chart = read_lines(noun, options, gap)
  if chart then chart:divide(noun, gap) end
  return options, gap, chart
end

--- The number of the area at a point; nil and why there is none.
local function find(noun, chart, gap, at)
  if not chart then return nil, "outside" end
  return chart:find(noun, gap, at)
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
  local given, gap, chart = read(noun, options, of_area)
  fields.numbers(noun, "at[%d]", given.at, 2, "{x, y}")
  local number, what = find(noun, chart, gap, given.at)
  if number then
    return outline(noun, chart, { number }, given.under ~= false)[number]:with {
      fill = given.fill }
  end
  return given.fallback
    or native.refuse(noun .. ": " .. leak_of(noun, chart, gap, given.at, what).message)
end

local function check_colours(noun, colours)
  for i, seed in ipairs(colours) do
    local where = ("colours[%d]"):format(i)
    fields.numbers(noun, where .. "[%d]", seed, 2, "{x, y, colour}")
    fields.expect(seed[3] ~= nil, seed[3], "%s: %s must be {x, y, colour}", noun, where)
  end
end

--- Raises an error about two points of different colours in one area.
local function refuse_both(noun, chart, gap, colours, i, k)
  local leak = opening(noun, chart, gap, colours[i], colours[k], function(more)
    local one, other = chart:find(noun, more, colours[i]), chart:find(noun, more, colours[k])
    return one and other and one ~= other
  end)
  native.refuse(("%s: colours[%d] and colours[%d] are in one area, which runs from one to the "
    .. "other %s"):format(noun, i, k, leak.text))
end

--- Many areas at once, each in its colour. Errors are those of `area`, and two colours in one area.
---@param options celspan.ink.areas.options
---@return celspan.object art The areas in the order of their points
function ink.areas(options)
  local noun = "ink: areas"
  local given, gap, chart = read(noun, options, of_areas)
  local colours, shown, first, numbers = given.colours or {}, {}, {}, {}
  check_colours(noun, colours)
  for i, seed in ipairs(colours) do
    local number, what = find(noun, chart, gap, seed)
    local before = number and first[number]
    if not number then
      shown[i] = given.fallback or native.refuse(("%s: colours[%d]: %s"):format(noun, i,
        leak_of(noun, chart, gap, seed, what).message))
    elseif not before then
      first[number], numbers[#numbers + 1] = i, number
    elseif colours[before][3] ~= seed[3] then
      refuse_both(noun, chart, gap, colours, before, i)
    end
  end
  local paths = #numbers > 0 and outline(noun, chart, numbers, given.under ~= false)
  for _, number in ipairs(numbers) do
    local i = first[number]
    shown[i] = paths[number]:with { fill = colours[i][3] }
  end
  local list = {}
  for i in ipairs(colours) do list[#list + 1] = shown[i] end
  return celspan.union(list)
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
  local given, gap, chart = read(noun, options, of_leak)
  fields.numbers(noun, "at[%d]", given.at, 2, "{x, y}")
  local number, what = find(noun, chart, gap, given.at)
  return not number and leak_of(noun, chart, gap, given.at, what) or nil
end

return ink
