--- Charts on logarithmic axes as rostrums: lines, and bars.
local celspan = require "celspan"
local strokes = require "tests.bench.strokes"

local chart = {}

local ink, pale, paper = "#22262b", "#d9dde2", "#ffffff"
local left, right, top, bottom = 86, 230, 52, 56

local function log10(v) return math.log(v, 10) end

--- The range of decades that contains all values.
local function range(values)
  local least, most = math.huge, -math.huge
  for _, value in ipairs(values) do least, most = math.min(least, value), math.max(most, value) end
  return math.floor(log10(least) + 1e-9), math.ceil(log10(most) - 1e-9)
end

local function rostrum(list)
  return celspan.rostrum { celspan.cel(list), back = paper }
end

--- "1 ms", "100 s".
local function seconds_name(exponent)
  local units = { { 0, "s" }, { -3, "ms" }, { -6, "us" } }
  for _, unit in ipairs(units) do
    if exponent >= unit[1] then return ("%d %s"):format(10 ^ (exponent - unit[1]) // 1, unit[2]) end
  end
  return ("%g s"):format(10.0 ^ exponent)
end

local function count_name(value)
  if value >= 1e6 then return ("%gM"):format(value / 1e6) end
  if value >= 1e3 then return ("%gk"):format(value / 1e3 // 1) end
  return ("%g"):format(value)
end

--- Labels at their heights, moved apart where they would touch.
local function spread(labels, gap)
  table.sort(labels, function(a, b) return a.y < b.y end)
  for i = 2, #labels do labels[i].y = math.max(labels[i].y, labels[i - 1].y + gap) end
end

--- Where a point of data lies, for the axes of a chart of lines.
local function placing(spec)
  local values = {}
  for _, series in ipairs(spec.series) do
    for _, point in ipairs(series.points) do values[#values + 1] = point[2] end
  end
  local x0, x1 = log10(spec.ticks[1]), log10(spec.ticks[#spec.ticks])
  local y0, y1 = range(values)
  local width, height = spec.width - left - right, spec.height - top - bottom
  local function place(point)
    return { left + (log10(point[1]) - x0) / (x1 - x0) * width,
             top + height - (log10(point[2]) - y0) / (y1 - y0) * height }
  end
  return place, width, height, y0, y1
end

local function draw_grid(list, spec, place, width, height, y0, y1)
  for _, tick in ipairs(spec.ticks) do
    local x = place { tick, 1 }[1]
    strokes.line(list, { { x, top }, { x, top + height } }, 1, pale)
    strokes.text(list, count_name(tick), x, top + height + 22, 11, ink, 0.5)
  end
  for exponent = y0, y1 do
    local y = place { spec.ticks[1], 10.0 ^ exponent }[2]
    strokes.line(list, { { left, y }, { left + width, y } }, 1, pale)
    strokes.text(list, seconds_name(exponent), left - 10, y + 5, 11, ink, 1)
  end
end

--- The curve of a series, dots where it was measured; returns its end.
local function draw_series(list, series, place)
  local points = {}
  for i, point in ipairs(series.points) do points[i] = place(point) end
  strokes.line(list, points, series.dash and 2 or 3, series.colour, series.dash and 7)
  if not series.dash then
    for _, point in ipairs(points) do
      list[#list + 1] = celspan.circle { centre = point, radius = 4.5, texture = series.colour }
    end
  end
  return points[#points]
end

--- The names of the series at the right, each with a thin line to its end.
local function draw_names(list, labels, x)
  spread(labels, 19)
  for _, label in ipairs(labels) do
    local colour = label.series.colour
    strokes.line(list, { { label.from[1] + 8, label.from[2] }, { x - 6, label.y } }, 1, colour)
    strokes.text(list, label.series.name, x, label.y + 5, 11, colour)
  end
end

--- series: { { name, colour, points = { { x, y }, ... }, dash = }, ... }; ticks: the values of x
--- with a label.
function chart.lines(spec)
  local list, labels = {}, {}
  local place, width, height, y0, y1 = placing(spec)
  draw_grid(list, spec, place, width, height, y0, y1)
  for i, series in ipairs(spec.series) do
    local last = draw_series(list, series, place)
    labels[i] = { y = last[2], from = last, series = series }
  end
  draw_names(list, labels, left + width + 26)
  strokes.text(list, spec.title, left, 30, 15, ink)
  strokes.text(list, spec.x, left + width / 2, spec.height - 12, 11, ink, 0.5)
  return rostrum(list)
end

--- Bars beside one another from x on, in `width`, and the group's names below `foot`.
local function draw_group(list, group, x, width, row, foot)
  local pitch = width / #group.bars
  for i, bar in ipairs(group.bars) do
    local upper, lower = math.min(row(bar.value), row(1)), math.max(row(bar.value), row(1))
    list[#list + 1] = celspan.rect { x + (i - 1) * pitch, upper, pitch * 0.9,
      math.max(1, lower - upper), texture = bar.colour }
  end
  for line, name in ipairs(group.names) do
    strokes.text(list, name, x + width / 2, foot + 4 + 18 * line, 11, ink, 0.5)
  end
end

local function draw_legend(list, kinds, x)
  for i, bar in ipairs(kinds) do
    local y = top + 20 + 22 * i
    list[#list + 1] = celspan.rect { x, y - 10, 14, 12, texture = bar.colour }
    strokes.text(list, bar.name, x + 24, y, 11, ink)
  end
end

--- groups: { { names = { line, ... }, bars = { { name, colour, value }, ... } }, ... }. Bars begin
--- at 1.
function chart.bars(spec)
  local list, values, kinds = {}, { 1 }, {}
  for _, group in ipairs(spec.groups) do
    for _, bar in ipairs(group.bars) do
      values[#values + 1] = bar.value
      if not kinds[bar.name] then
        kinds[bar.name] = true
        kinds[#kinds + 1] = bar
      end
    end
  end
  local y0, y1 = range(values)
  local width, height = spec.width - left - right, spec.height - top - bottom
  local function row(value) return top + height - (log10(value) - y0) / (y1 - y0) * height end
  for exponent = y0, y1 do
    local y = row(10.0 ^ exponent)
    strokes.line(list, { { left, y }, { left + width, y } }, exponent == 0 and 2 or 1,
      exponent == 0 and ink or pale)
    strokes.text(list, ("%g"):format(10.0 ^ exponent), left - 10, y + 5, 11, ink, 1)
  end
  local pitch = width / #spec.groups
  for i, group in ipairs(spec.groups) do
    draw_group(list, group, left + (i - 0.9) * pitch, 0.8 * pitch, row, top + height)
  end
  draw_legend(list, kinds, left + width + 26)
  strokes.text(list, spec.title, left, 30, 15, ink)
  return rostrum(list)
end

return chart
