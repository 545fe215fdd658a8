--- What a chart shows of its values: bars, lines and areas.
--
-- A plot has a place for its rows and values: plot.x, y, w, h, the rectangle within the axes; slot,
-- the room of a row of bars; at(i), the x of a row; up(value), the y of a value.
local celspan = require "celspan"
local curves = require "celspan.curves"
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

--- A bar from the base to the value, with a round end, as a contour.
local function bar_of(x, width, base, top, radius)
  local r = math.min(radius, width / 2, math.abs(top - base))
  local back, right = top < base and r or -r, x + width
  local shoulder, near, far = top + back, back / 3, r / 3 -- of the control points of the corners
  return { x, base, x, base, x, shoulder, x, shoulder, x, top + near, x + far, top, x + r, top,
           x + r, top, right - r, top, right - r, top, right - far, top, right, top + near, right,
           shoulder, right, shoulder, right, base, right, base }
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

local PALE = 0.35 -- bars beside the one that is highlighted, on the paper
local SWAP = { 0, 1, 0, 1, 0, 0, 0, 0, 1 } -- of x and y, for bars that lie

--- Adds the bars of a series: those for which is_wanted(i) holds.
local function add_bars(objects, chart, plot, k, is_wanted)
  local contours, base = {}, plot.up(0)
  for i, value in ipairs(chart.data.series[k].values) do
    local share = grown(chart, i)
    if value and share > 0 and is_wanted(i) then
      local x, width = bar_place(chart, plot, i, k)
      contours[#contours + 1] = bar_of(x, width, base, plot.up(value * share),
        chart.style.size / 3)
    end
  end
  if not contours[1] then return nil end
  local bars = celspan.path { contours = contours, texture = chart.colour(k) }
  objects[#objects + 1] = plot.lies and bars:transform(SWAP) or bars
  return #objects
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
  if plot.lies then return distance > chart.style.size and text or nil end
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
        local y, align = plot.up(value * share), "centre"
        local at = { x + width / 2, y + (value < 0 and chart.cap + size / 2 or -size / 2) }
        if plot.lies then
          at = { y + (value < 0 and -size / 2 or size / 2), x + (width + chart.cap) / 2 }
          align = value < 0 and "right" or "left"
        end
        objects[#objects + 1] = labels.text(text(value * share), chart.style, at, align)
          :fade(math.min(1, 3 * share))
      end
    end
  end
end

function marks.bar(chart, plot)
  local objects = {}
  local row = chart.highlight
  for k = 1, #chart.data.series do
    local pale = row and add_bars(objects, chart, plot, k, function(i) return i ~= row end)
    if pale then
      local bars = objects[pale]
      objects[pale] = celspan.union { bars:paint(chart.paper), bars:fade(PALE) }
    end
    add_bars(objects, chart, plot, k, function(i) return not row or i == row end)
  end
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

--- The x up to which lines are drawn.
local function reached_of(chart, plot)
  return chart.progress > 0 and plot.x + plot.w * line_ease(chart.progress) or -math.huge
end

--- A line with round joins, and a dot at its end. A run of one point is a dot.
local function add_line(objects, chart, runs, k)
  local width, contours = chart.style.size / 4, {}
  for i, run in ipairs(runs) do
    contours[i] = curves.through(#run > 1 and run or { run[1], run[1] })
  end
  if #contours == 0 then return end
  local tip = runs[#runs][#runs[#runs]]
  objects[#objects + 1] = celspan.stroke { contours = contours, width = width, cap = "round",
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

--- The area between the two lines of a run.
local function area_of(run, texture)
  local corners = { texture = texture }
  for i, point in ipairs(run) do
    corners[i], corners[2 * #run + 1 - i] = { point[1], point[2] }, { point[1], point[3] }
  end
  return celspan.polygon(corners)
end

--- Areas on one another: values is a list of the sums of the series up to each.
function marks.area(chart, plot)
  local objects, reached, below = {}, reached_of(chart, plot), nil
  for k, sums in ipairs(chart.sums) do
    local under = below
    local runs = runs_of(plot, sums, reached, function(i) return plot.up(sums[i]) end,
      function(i) return plot.up(under and under[i] or 0) end)
    if runs[1] then
      local area = area_of(runs[1], chart.colour(k))
      objects[#objects + 1] = #chart.sums == 1 and area:fade(ALONE_FADE) or area
      if #chart.sums == 1 then add_line(objects, chart, runs, k) end
    end
    below = sums
  end
  return objects
end

return fields.seal("chart_marks", marks)
