--- What a chart shows of its values: bars, lines and areas.
--
-- A plot has a place for its rows and values: plot.x, y, w, h, the rectangle within the axes; slot,
-- the room of a row of bars; at(i), the x of a row; up(value), the y of a value.
local celspan = require "celspan"
local data = require "celspan.chart_data"
local ease = require "celspan.ease"
local fields = require "celspan.fields"
local labels = require "celspan.labels"
local motion = require "celspan.motion"

local marks = {}

local bar_ease, line_ease = ease "outCubic", ease "inOutQuad"
local OVERLAP = 0.8                      -- how far bars grow together
local ALONE, TOGETHER, SPARE = 0.66, 0.8, 0.06 -- shares of the slot; of a bar, between two

-- ---------------------------------------------------------------- bars

--- A bar from the base to the value, with a round end.
local function bar_data(x, width, base, top, radius)
  local r = math.min(radius, width / 2, math.abs(top - base))
  local back = top < base and r or -r
  return ("M%.7g %.7gV%.7gQ%.7g %.7g %.7g %.7gH%.7gQ%.7g %.7g %.7g %.7gV%.7gZ"):format(x, base,
    top + back, x, top, x + r, top, x + width - r, x + width, top, x + width, top + back, base)
end

--- How many series there are, and how far apart their bars are in the slot of a row.
local function pitch_of(chart, plot)
  local total = #chart.data.series
  return total, plot.slot * (total == 1 and ALONE or TOGETHER) / total
end

--- Where the bar of a series begins in the slot of a row, and its width.
local function bar_place(chart, plot, i, k)
  local total, pitch = pitch_of(chart, plot)
  local spare = total == 1 and 0 or SPARE * pitch
  return plot.at(i) + pitch * (k - 1 - total / 2) + spare / 2, pitch - spare
end

--- The share of its height that the bar of a row has.
local function grown(chart, i)
  return bar_ease(motion.stagger(chart.progress, i, chart.data.count, OVERLAP))
end

local function bars_of(chart, plot, k)
  local paths, base = {}, plot.up(0)
  for i, value in ipairs(chart.data.series[k].values) do
    local share = grown(chart, i)
    if value and share > 0 then
      local x, width = bar_place(chart, plot, i, k)
      paths[#paths + 1] = bar_data(x, width, base, plot.up(value * share), chart.style.size / 3)
    end
  end
  return paths[1] and celspan.path { d = table.concat(paths), texture = chart.colour(k) }
end

--- The values as they are written at the bars; nil where they would collide.
local function written(chart, plot)
  local decimals, widths = 0, {}
  for _, one in ipairs(chart.data.series) do
    for _, value in ipairs(one.values) do
      decimals = math.max(decimals, value and data.decimals(value) or 0)
    end
  end
  local function text(value) return chart.written(value, decimals) end
  for _, one in ipairs(chart.data.series) do
    for _, value in ipairs(one.values) do
      widths[#widths + 1] = labels.width(text(value or 0), chart.style)
    end
  end
  local total, pitch = pitch_of(chart, plot)
  local distance = total == 1 and plot.slot or pitch
  return labels.every(widths, distance, chart.style.size / 4) == 1 and text or nil
end

--- Adds the values at the ends of the bars; they count up while the bars grow.
local function add_values(objects, chart, plot)
  local text, size = written(chart, plot), chart.style.size
  for k, one in ipairs(text and chart.data.series or {}) do
    for i, value in ipairs(one.values) do
      local share = grown(chart, i)
      if value and share > 0 then
        local x, width = bar_place(chart, plot, i, k)
        local y = plot.up(value * share) + (value < 0 and chart.cap + size / 2 or -size / 2)
        objects[#objects + 1] = labels.text(text(value * share), chart.style,
          { x + width / 2, y }, "centre"):fade(math.min(1, 3 * share))
      end
    end
  end
end

function marks.bar(chart, plot)
  local objects = {}
  for k = 1, #chart.data.series do objects[#objects + 1] = bars_of(chart, plot, k) or nil end
  if chart.values then add_values(objects, chart, plot) end
  return objects
end

-- ---------------------------------------------------------------- lines

--- Runs of points { x, y, low } of rows that have values, up to the x that is reached: the last one
--- then ends there. low(i): a second y, for areas.
local function runs_of(plot, values, reached, high, low)
  local runs, run, last = {}, nil, nil
  for i = 1, #values do
    local x = plot.at(i)
    local point = values[i] and { x, high(i), low and low(i) }
    if point and x > reached then
      if run and last[1] < reached then
        local u = (reached - last[1]) / (x - last[1])
        for n, number in ipairs(point) do point[n] = last[n] + u * (number - last[n]) end
        run[#run + 1] = point
      end
      break
    end
    if point and not run then
      run = {}
      runs[#runs + 1] = run
    end
    if point then run[#run + 1] = point else run = nil end
    last = point
  end
  return runs
end

--- Path data through the points of a run, backwards with the second y if `is_low`.
local function line_data(run, is_low)
  local parts = {}
  for i, point in ipairs(run) do
    local at = is_low and #run + 1 - i or i
    parts[at] = ("%.7g %.7g"):format(point[1], is_low and point[3] or point[2])
  end
  return table.concat(parts, "L")
end

--- The x up to which lines are drawn.
local function reached_of(chart, plot)
  return chart.progress > 0 and plot.x + plot.w * line_ease(chart.progress) or -math.huge
end

--- A line with round joins, and a dot at its end. A run of one point is a dot.
local function add_line(objects, chart, runs, k)
  local width, paths = chart.style.size / 4, {}
  for i, run in ipairs(runs) do
    local line = line_data(run)
    paths[i] = "M" .. line .. (#run == 1 and "L" .. line or "")
  end
  if #paths == 0 then return end
  local tip = runs[#runs][#runs[#runs]]
  objects[#objects + 1] = celspan.stroke { d = table.concat(paths), width = width, cap = "round",
    join = "round", texture = chart.colour(k) }
  objects[#objects + 1] = celspan.circle { centre = { tip[1], tip[2] }, radius = 1.3 * width,
    texture = chart.colour(k) }
end

function marks.line(chart, plot)
  local objects, reached = {}, reached_of(chart, plot)
  for k, one in ipairs(chart.data.series) do
    add_line(objects, chart, runs_of(plot, one.values, reached,
      function(i) return plot.up(one.values[i]) end), k)
  end
  return objects
end

-- ---------------------------------------------------------------- areas

local ALONE_FADE = 0.25 -- of an area under its line

--- Areas on one another: values is a list of the sums of the series up to each.
function marks.area(chart, plot)
  local objects, reached, below = {}, reached_of(chart, plot), nil
  for k, sums in ipairs(chart.sums) do
    local under = below
    local runs = runs_of(plot, sums, reached, function(i) return plot.up(sums[i]) end,
      function(i) return plot.up(under and under[i] or 0) end)
    if runs[1] then
      local area = celspan.path { texture = chart.colour(k),
        d = "M" .. line_data(runs[1]) .. "L" .. line_data(runs[1], true) .. "Z" }
      objects[#objects + 1] = #chart.sums == 1 and area:fade(ALONE_FADE) or area
      if #chart.sums == 1 then add_line(objects, chart, runs, k) end
    end
    below = sums
  end
  return objects
end

return fields.seal("chart_marks", marks)
