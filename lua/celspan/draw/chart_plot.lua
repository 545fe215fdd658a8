--- The plot of a chart with axes: where its rows and values lie, its axes, and the names of its
--- series.
--
--     +------------------------------- box      The plot is what labels leave of the box: the
--     |  legend                                 numbers of the values at its left, the names of
--     |  20 |---------------.                   the rows below it, and at its right the names of
--     |  10 |-----.plot.----| name              lines at their ends.
--     |   0 |_______________|
--     |      2000 2010 2020
local celspan = require "celspan"
local native = require "celspan.native"
local data = require "celspan.chart_data"
local fields = require "celspan.fields"
local labels = require "celspan.labels"
local ticks = require "celspan.ticks"

local plots = {}

local FAINT, FIRM, HAIR = 0.16, 0.6, 0.07 -- of the lines of axes: their fade, their width in ems
local FEWEST, MOST = 3, 8                 -- numbers of an axis
local CLOSE = 0.5                         -- lines of values that are closer to each other than to 0

-- ---------------------------------------------------------------- values

--- The least and the greatest number of the axis of values. Bars and areas begin at 0; lines do,
--- unless their values are far from it.
local function range_of(chart)
  local low, high, is_whole = data.range(chart.data)
  for _, value in ipairs(chart.sums and chart.sums[#chart.sums] or {}) do
    high = math.max(high, value)
  end
  local least = math.min(math.abs(low), math.abs(high))
  local is_far = chart.kind == "line" and low * high > 0 and low < high
    and high - low < CLOSE * (least + high - low)
  if not is_far then low, high = math.min(0, low), math.max(0, high) end
  return low, high, is_whole
end

--- The ticks of the values: { list =, texts =, low =, high =, width = }.
local function values_axis(chart, height)
  local low, high, is_whole = range_of(chart)
  high = math.max(high, chart.most or high)
  local most = math.floor(height / (3 * chart.style.size))
  local list, decimals, first, last = ticks.between(low, high,
    math.max(FEWEST, math.min(MOST, most)), is_whole)
  if chart.most == high then
    last = high
    while #list > 1 and list[#list] > last do list[#list] = nil end
  end
  local axis = { list = list, texts = {}, low = first, high = last, width = 0 }
  for i, value in ipairs(chart.has_numbers and list or {}) do
    axis.texts[i] = chart.written(value, decimals)
    axis.width = math.max(axis.width, labels.width(axis.texts[i], chart.style))
  end
  return axis
end

-- ---------------------------------------------------------------- the names of series

--- How the series are named: "ends" at the ends of lines and areas, "row" above the plot, or nil.
local function naming_of(chart)
  local total, size = #chart.data.series, chart.style.size
  if not chart.style.font or chart.legend == false or chart.legend == nil and total == 1 then
    return nil
  end
  local has_room = total * 1.25 * size <= chart.box[4] / 2
  return chart.legend == nil and chart.kind ~= "bar" and has_room and "ends" or "row"
end

--- The names above the plot, each with its colour, in as many lines as they need, and their height.
local function name_row(chart)
  local size, x, y, objects = chart.style.size, 0, 0, {}
  for k, one in ipairs(chart.data.series) do
    local width = labels.width(one.name, chart.style) + 3 * size
    if x > 0 and x + width - 1.4 * size > chart.box[3] then x, y = 0, y + 1.6 * size end
    local left, top = chart.box[1] + x, chart.box[2] + y
    objects[#objects + 1] = celspan.rect { left, top + (size - chart.cap) / 2, chart.cap, chart.cap,
      radius = chart.cap / 4, texture = chart.colour(k) }
    objects[#objects + 1] = labels.text(one.name, chart.style,
      { left + chart.cap + size / 2, top + (size + chart.cap) / 2 })
    x = x + width
  end
  return objects, y + 2 * size
end

--- The last value of a series, and of an area the middle of it.
local function end_of(chart, k)
  local values = chart.data.series[k].values
  local last = #values
  while last > 1 and not values[last] do last = last - 1 end
  local value = values[last] or 0
  return chart.sums and chart.sums[k][last] - value / 2 or value
end

--- The names at the ends of lines, as near to them as they can be.
local function name_ends(chart, plot)
  local order, wanted, objects, size = {}, {}, {}, chart.style.size
  for k = 1, #chart.data.series do order[k] = { k = k, y = plot.up(end_of(chart, k)) } end
  table.sort(order, function(a, b) return a.y < b.y or a.y == b.y and a.k < b.k end)
  for i, one in ipairs(order) do wanted[i] = one.y end
  local places = labels.spread(wanted, 1.25 * size, plot.y, plot.y + plot.h) or {}
  for i, y in ipairs(places) do
    local name = chart.data.series[order[i].k].name
    objects[i] = labels.text(name, { font = chart.style.font, size = size,
      texture = chart.colour(order[i].k) }, { plot.x + plot.w + 0.8 * size, y + chart.cap / 2 })
      :fade(math.max(0, math.min(1, 5 * chart.progress - 4)))
  end
  return objects
end

-- ---------------------------------------------------------------- rows

--- The names of rows that can be written without colliding: { at = row, text =, width = } each.
local function thinned(chart, distance)
  local size, all, kept, widths = chart.style.size, {}, {}, {}
  local every = labels.every({ size }, distance, size)
  for i = 1, chart.data.count, every do
    local text = chart.data.name(i)
    widths[#widths + 1] = labels.width(text, chart.style)
    all[#all + 1] = { at = i, text = text, width = widths[#widths] }
  end
  for n = 1, #all, labels.every(widths, distance * every, size) do kept[#kept + 1] = all[n] end
  return kept
end

local LEAST, TURN = 0.7, 50 -- of the size of the names of bars; degrees by which they are turned
local SINE = math.sin(math.rad(TURN))

--- Whether the names of bars have room beside each other.
local function names_fit(chart, slot)
  local before
  if slot < chart.style.size then return false end
  for i = 1, chart.data.count do
    local width = labels.width(chart.data.name(i), chart.style)
    if before and (before + width) / 2 + chart.style.size / 2 > slot then return false end
    before = width
  end
  return true
end

--- How all names of bars are written where they have no room beside each other: smaller, or in
--- several lines, or turned: { scale =, width =, turn =, height = }; nil: not even then.
local function names_of(chart, slot)
  local size, widest, word_widest, height = chart.style.size, 0, 0, 0
  local room = slot - size / 2
  if slot * SINE < LEAST * size then return nil end
  for i = 1, chart.data.count do
    widest = math.max(widest, labels.width(chart.data.name(i), chart.style))
    for word in chart.data.name(i):gmatch "%S+" do
      word_widest = math.max(word_widest, labels.width(word, chart.style))
    end
  end
  if room >= LEAST * widest then return { scale = math.min(1, room / widest), height = size } end
  if room >= LEAST * word_widest then
    local way = { scale = math.min(1, room / word_widest), width = room }
    for i = 1, chart.data.count do
      local text = celspan.text { chart.data.name(i), font = chart.style.font,
        size = way.scale * size, width = room }
      height = math.max(height, text:metrics().height)
    end
    way.height = height
    return way
  end
  local scale = math.min(1, slot * SINE / size)
  return { scale = scale, turn = TURN, height = scale * (widest * SINE + size) }
end

--- The name of a bar below it, as names_of says.
local function bar_name(chart, way, i, x, y)
  local style = { chart.data.name(i), font = chart.style.font, size = way.scale * chart.style.size,
                  texture = chart.style.texture, valign = "cap" }
  if way.turn then
    style.align = "right"
    return celspan.text(style):rotate(-way.turn):translate(x, y)
  end
  style.align, style.width = "centre", way.width
  style.at = { x - (way.width or 0) / 2, y }
  return celspan.text(style)
end

--- The least distance between two rows in a width.
local function least_distance(chart, width)
  local xs, least = chart.data.xs, math.huge
  if chart.kind == "bar" then return width / chart.data.count end
  if not xs or #xs < 2 then return width / math.max(1, chart.data.count - 1) end
  for i = 2, #xs do least = math.min(least, xs[i] - xs[i - 1]) end
  return width * least / (xs[#xs] - xs[1])
end

--- Round numbers instead of the rows' own, where these are too many: { x =, text =, width = } each.
local function round_numbers(chart, width)
  local xs, size, is_whole, widest = chart.data.xs, chart.style.size, true, 0
  for _, x in ipairs(xs) do is_whole = is_whole and x == math.floor(x) end
  for _, x in ipairs { xs[1], xs[#xs] } do
    widest = math.max(widest, labels.width(data.written(x, chart.language, 1), chart.style))
  end
  local most = math.max(FEWEST, math.floor(width / (widest + 2 * size)))
  local list, decimals = ticks.between(xs[1], xs[#xs], most, is_whole, true)
  for i, x in ipairs(list) do
    local text = data.written(x, chart.language, decimals)
    list[i] = { x = x, text = text, width = labels.width(text, chart.style) }
  end
  return list
end

--- What is written below the plot: { { at = row | x = number, text =, width = }, ... }.
local function rows_axis(chart, width)
  if not chart.has_names then return {} end
  local distance = least_distance(chart, width)
  local kept = thinned(chart, chart.kind == "bar" and names_fit(chart, distance) and math.huge
    or distance)
  if chart.kind == "bar" and #kept < chart.data.count then
    native.warn(("chart: %d of %d names have no room: make the box wider, or lie = true")
      :format(chart.data.count - #kept, chart.data.count))
  end
  if chart.kind ~= "bar" and chart.data.xs and #kept < chart.data.count then
    return round_numbers(chart, width)
  end
  return kept
end

-- ---------------------------------------------------------------- the plot

--- The functions that place rows and values.
local function add_places(plot, chart, axis)
  local total, xs = chart.data.count, chart.data.xs
  plot.slot = plot.w / total
  function plot.up(value)
    return plot.y + plot.h * (axis.high - value) / (axis.high - axis.low)
  end
  function plot.along(x) return plot.x + plot.w * (x - xs[1]) / (xs[#xs] - xs[1]) end
  function plot.at(i)
    if chart.kind == "bar" or total == 1 then return plot.x + plot.slot * (i - 0.5) end
    if xs then return plot.along(xs[i]) end
    return plot.x + plot.w * (i - 1) / (total - 1)
  end
end

--- How far the name of a row may stick out of the plot, at most.
local function beyond(chart, i)
  if not chart.has_names then return 0 end
  local slot = chart.kind == "bar" and chart.box[3] / chart.data.count or 0
  return math.max(0, labels.width(chart.data.name(i), chart.style) / 2 - slot / 4)
end

--- The room that labels need at the left and at the right.
local function sides_of(chart, axis, naming)
  local size, right = chart.style.size, beyond(chart, chart.data.count)
  for _, one in ipairs(naming == "ends" and chart.data.series or {}) do
    right = math.max(right, labels.width(one.name, chart.style) + size)
  end
  return math.max(beyond(chart, 1), axis.width > 0 and axis.width + 0.8 * size or 0), right
end

--- The plot in a box that labels make smaller. plot.below: the room for values of bars below 0.
local function place(chart, axis, naming, above)
  local size, box = chart.style.size, chart.box
  local left, right = sides_of(chart, axis, naming)
  local ways
  if chart.kind == "bar" and chart.has_names
    and not names_fit(chart, (box[3] - left - right) / chart.data.count) then
    local beside = axis.width > 0 and axis.width + 0.8 * size or 0
    ways = names_of(chart, (box[3] - beside) / chart.data.count)
    if ways then left, right = beside, 0 end
  end
  local top = above + (chart.values and 1.4 * size or chart.has_numbers and size / 2 or 0)
  local below = chart.values and axis.low < 0 and 1.4 * size or 0
  local bottom = below + (chart.has_names and size + (ways and ways.height or size) or 0)
  local plot = { ways = ways, x = box[1] + left, y = box[2] + top, w = box[3] - left - right,
                 h = box[4] - top - bottom, below = below }
  if plot.w <= 0 or plot.h <= 0 then
    native.refuse(("chart: a box of %.4g x %.4g has no room beside its labels: make it larger, or "
      .. "field 'size' smaller"):format(box[3], box[4]))
  end
  add_places(plot, chart, axis)
  return plot
end

local function add_axes(objects, chart, plot, axis)
  local size = chart.style.size
  for i, value in ipairs(chart.axes and axis.list or {}) do
    local y, thick = plot.up(value), HAIR * size
    objects[#objects + 1] = celspan.rect { plot.x, y - thick / 2, plot.w, thick,
      texture = chart.style.texture }:fade(value == 0 and FIRM or FAINT)
    objects[#objects + 1] = axis.texts[i] and labels.text(axis.texts[i], chart.style,
      { plot.x - 0.8 * size, y + chart.cap / 2 }, "right")
  end
  local box, y = chart.box, plot.y + plot.h + plot.below + 0.9 * size + chart.cap
  for i = 1, plot.ways and chart.data.count or 0 do
    objects[#objects + 1] = bar_name(chart, plot.ways, i, plot.at(i), y - chart.cap)
  end
  if plot.ways then return end
  for _, row in ipairs(rows_axis(chart, plot.w)) do
    local x, half = row.at and plot.at(row.at) or plot.along(row.x), row.width / 2
    local has_room = x - half >= box[1] and x + half <= box[1] + box[3]
    objects[#objects + 1] = has_room and labels.text(row.text, chart.style, { x, y }, "centre")
      or nil
  end
end

--- A chart with axes; draw: what makes its marks.
---@return celspan.object
function plots.make(chart, draw)
  local naming, objects, above = naming_of(chart), {}, 0
  if naming == "row" then objects, above = name_row(chart) end
  local axis = values_axis(chart, chart.box[4] - above)
  local plot = place(chart, axis, naming, above)
  add_axes(objects, chart, plot, axis)
  for _, object in ipairs(draw(chart, plot)) do objects[#objects + 1] = object end
  if naming == "ends" then
    for _, object in ipairs(name_ends(chart, plot)) do objects[#objects + 1] = object end
  end
  return celspan.union(objects)
end

--- The same with bars that lie: each name is beside its bar.
---@return celspan.object
function plots.lying(chart, draw)
  local objects, above, size, box = {}, 0, chart.style.size, chart.box
  if naming_of(chart) then objects, above = name_row(chart) end
  local axis, widest, total = values_axis(chart, box[3]), 0, chart.data.count
  for i = 1, chart.has_names and total or 0 do
    widest = math.max(widest, labels.width(chart.data.name(i), chart.style))
  end
  local slot = (box[4] - above - (chart.has_numbers and 2 * size or 0)) / total
  local scale = math.min(1, 0.4 * box[3] / math.max(widest, 1), slot / (1.1 * size))
  local x = box[1] + (chart.has_names and widest * scale + 0.8 * size or 0)
  local right = math.max(axis.width / 2, chart.values and size + math.max(axis.width,
    labels.width(chart.written(axis.high, 0), chart.style)) or 0)
  local plot = { slot = slot, lies = true }
  function plot.at(i) return box[2] + above + slot * (i - 0.5) end
  function plot.up(value)
    return x + (box[1] + box[3] - right - x) * (value - axis.low) / (axis.high - axis.low)
  end
  local style = { font = chart.style.font, size = scale * size, texture = chart.style.texture }
  for i, value in ipairs(chart.axes and axis.list or {}) do
    local thick, bottom = HAIR * size, box[2] + above + slot * total
    objects[#objects + 1] = celspan.rect { plot.up(value) - thick / 2, box[2] + above, thick,
      slot * total, texture = style.texture }:fade(value == 0 and FIRM or FAINT)
    objects[#objects + 1] = axis.texts[i] and labels.text(axis.texts[i], chart.style,
      { plot.up(value), bottom + 0.9 * size + chart.cap }, "centre")
  end
  for i = 1, chart.has_names and total or 0 do
    objects[#objects + 1] = labels.text(chart.data.name(i), style,
      { x - 0.8 * size, plot.at(i) + scale * chart.cap / 2 }, "right")
  end
  for _, object in ipairs(draw(chart, plot)) do objects[#objects + 1] = object end
  return celspan.union(objects)
end

return fields.seal("chart_plot", plots)
