--- Charts of tables: bars, lines, areas and pies with axes and names, which grow with a progress.
--
--   local chart = require "celspan.chart"
--   local rows = assert(csv.read("harvest.csv", { types = { year = "number", tons = "number" } }))
--   chart { kind = "line", data = rows, x = "year", y = "tons", font = "sans.ttf",
--           box = { 40, 60, 400, 180 }, progress = f.progress }
--
-- The box has the labels inside it. They are as many as have room, so none covers another.
local native = require "celspan.native"
local colour = require "celspan.colour"
local count = require "celspan.count"
local data = require "celspan.chart_data"
local fields = require "celspan.fields"
local labels = require "celspan.labels"
local marks = require "celspan.chart_marks"
local pies = require "celspan.chart_pie"
local plots = require "celspan.chart_plot"

local function refuse(text, ...) native.refuse("chart: " .. text:format(...)) end

--- Of one lightness, and apart in hue, also for most who see few colours.
local COLOURS = { "#3b6fe0", "#f08c2e", "#1fa187", "#d6456f", "#8a63d2", "#e3b505", "#35a7c9",
                  "#8f6b4a" }
local INK = "#4a5168"
local SIZE = 1 / 56 -- of the width and the height of the box together

local kinds = { "area", "bar", "line", "pie" }
local most_rows = { area = 1000000, bar = 1000, line = 1000000, pie = 100 }

local known = { kind = "string", data = "table", x = "string", y = "any", box = "table",
                axes = "boolean", legend = "boolean", values = "boolean", hole = "number",
                colours = "table", ink = "any", font = "any", size = "number",
                language = "string", format = "function", progress = "number",
                lie = "boolean", most = "number", highlight = "any" }

local function check(given)
  given = fields.check("chart", given, known)
  for _, name in ipairs { "kind", "data", "box" } do
    if given[name] == nil then refuse("needs the field '%s'", name) end
  end
  if not most_rows[given.kind] then
    local hint = native.nearest(given.kind, kinds)
    refuse('field \'kind\' must be "area", "bar", "line" or "pie", got %q%s', given.kind,
      hint and ("; did you mean %q?"):format(hint) or "")
  end
  fields.numbers("chart", "box[%d]", given.box, 4, "{x, y, w, h}")
  if given.box[3] <= 0 or given.box[4] <= 0 then
    refuse("the box must have a width and a height above 0, got %s by %s",
      fields.shown(given.box[3]), fields.shown(given.box[4]))
  end
  local size, hole = given.size or 1, given.hole or 0
  fields.must(size > 0, "chart: field 'size'", "more than 0", size)
  fields.must(hole >= 0 and hole < 1, "chart: field 'hole'", "0 or more and less than 1", hole)
  for _, name in ipairs { "lie", "highlight" } do
    if given[name] and given.kind ~= "bar" then refuse("field '%s' is of bars", name) end
  end
  if given.colours and rawlen(given.colours) == 0 then
    refuse("field 'colours' must have at least one colour")
  end
  return given
end

--- The sums of the series up to each, for areas on one another.
local function sums_of(columns)
  local sums, below = {}, nil
  for k, one in ipairs(columns.series) do
    local list = {}
    for i, value in ipairs(one.values) do
      if value and value < 0 and #columns.series > 1 then
        refuse("areas on one another have no values below 0, got %s in row %d of '%s'",
          fields.shown(value), i, one.name)
      end
      list[i] = (below and below[i] or 0) + (value or 0)
    end
    sums[k], below = list, list
  end
  return sums
end

--- How a value is written: by the script's function, or as a number of the language.
local function writer(given)
  return function(value, decimals)
    if not given.format then
      return count.written(value, { language = given.language, decimals = decimals })
    end
    local text = given.format(value)
    if type(text) ~= "string" then
      refuse("field 'format' must return a string, got %s for %.14g", fields.kind(text), value)
    end
    return text
  end
end

--- The background on which an ink is seen.
local function paper_of(ink)
  local is_colour, lightness = pcall(colour.parts, ink)
  return is_colour and lightness > 0.65 and "#000" or "#fff"
end

--- The settings with their defaults. cap: the height of capitals; has_numbers, has_names: whether
--- the numbers of the axis of values and the names of the rows are written.
local function read(given)
  local colours, box = given.colours or COLOURS, given.box
  local style = { font = given.font, size = given.size or SIZE * (box[3] + box[4]),
                  texture = given.ink or INK }
  local axes = given.axes ~= false
  local columns = data.read(given, most_rows[given.kind])
  return {
    kind = given.kind, data = columns, box = box, axes = axes, legend = given.legend,
    values = given.values and given.font ~= nil and given.kind == "bar",
    hole = given.hole or 0, style = style,
    has_numbers = axes and given.font ~= nil, paper = paper_of(style.texture),
    has_names = given.font ~= nil and (axes or given.kind == "bar" and given.x ~= nil),
    language = given.language, written = writer(given), has_format = given.format ~= nil,
    progress = math.max(0, math.min(1, given.progress or 1)),
    sums = given.kind == "area" and sums_of(columns) or nil,
    lie = given.lie, most = given.most,
    highlight = given.highlight and data.row_of(columns, given.highlight),
    cap = given.font and labels.text("H", style, { 0, 0 }):metrics().cap_height or 0,
    colour = function(k) return colours[(k - 1) % #colours + 1] end,
  }
end

--- A chart of rows.
local function new(_, given)
  local chart = read(check(given))
  if chart.kind == "pie" then return pies.make(chart) end
  return (chart.lie and plots.lying or plots.make)(chart, marks[chart.kind])
end

---@class celspan.chart.settings
---@field kind "bar"|"line"|"area"|"pie"
---@field data table[]|number[] Rows with named fields, or the values themselves
---@field x? string The field that names a row, or its number along a line; default: 1, 2, ...
---@field y? string|string[] The fields that are drawn; of several, bars are beside each other and areas on one another
---@field box number[] {x, y, w, h}, with all labels
---@field font? string|string[] Without a font nothing is written
---@field size? number Of the letters; default: by the box
---@field ink? celspan.surface Of letters and axes
---@field colours? celspan.surface[] Of the series, or of the slices of a pie
---@field axes? boolean Default true; without them bars keep the names of `x`
---@field legend? boolean The names of series; default: where there are several
---@field values? boolean The values at bars; default false
---@field lie? boolean Of bars: they lie, and each name is beside its bar
---@field most? number The end of the axis of values, if no value is greater
---@field highlight? string|false Of bars: "max" or the name of one; the others are pale
---@field hole? number Of a pie: a share of its radius
---@field language? string Of the numbers, as for celspan.count
---@field format? fun(value: number): string How values are written, also those of a pie, which are shares without it
---@field progress? number 0 to 1 (1)

---@class celspan.chart
---@overload fun(settings: celspan.chart.settings): celspan.object
return fields.publish("chart", setmetatable({}, { __call = native.entry(new) }))
