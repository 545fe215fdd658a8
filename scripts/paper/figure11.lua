-- Figure 11: a list of 3 spans, 22 pixels long, filtered by a box into 5 spans: each step becomes
-- a ramp as long as the box is wide. Both lists are rendered; the graph is drawn from them.
local diagram = require "diagram"

local COLUMNS, CELL, LEFT = 22, 36, 84

local art = union {
  rect { 0, 0, 7, 1, fill = rgb(0.2, 0.2, 0.2) },
  rect { 7, 0, 8, 1, fill = rgb(0.9, 0.9, 0.9) },
  rect { 15, 0, 7, 1, fill = rgb(0.45, 0.45, 0.45) },
}
--- The row continues beyond its ends with the colours of the ends.
local wide = union { rect { -9, 0, 10, 1, fill = rgb(0.2, 0.2, 0.2) },
  rect { 21, 0, 10, 1, fill = rgb(0.45, 0.45, 0.45) }, art }
  :scale(1, 30, 0, 0.5)

local sharp = diagram.row(rostrum { antialias = "none", cel { wide } }, COLUMNS)
local soft = diagram.row(rostrum { antialias = "none",
  cel { wide, defocus = { radius = 2.5, kernel = "box" } } }, COLUMNS)

--- Light of each pixel of a row, from 1.
local function levels(row)
  local list = {}
  for _, span in ipairs(row) do
    local count = span.x1 - span.x0
    for i = 1, count do
      local from, to = span[1], span.kind == "gradient" and span[5] or span[1]
      if span.kind == "array" then from, to = span[4 * i - 3], span[4 * i - 3] end
      list[#list + 1] = from + (to - from) * (i - 1) / math.max(1, count - 1)
    end
  end
  return list
end

--- A graph of light over columns, as steps of a pixel each or through their centres.
local function graph(row, base, is_stepped)
  local points = {}
  for i, level in ipairs(levels(row)) do
    local y = base - 110 * level
    if is_stepped then
      points[#points + 1] = { LEFT + (i - 1) * CELL, y }
      points[#points + 1] = { LEFT + i * CELL, y }
    else
      points[#points + 1] = { LEFT + (i - 0.5) * CELL, y }
    end
  end
  return union { diagram.line({ { LEFT, base }, { LEFT + COLUMNS * CELL, base } }, 1.5,
    diagram.grey),
    diagram.line(points, 4, diagram.red) }
end

local function count(row) return #row .. " spans" end

return diagram.film("Figure 11", 960, 470, {
  diagram.label(count(sharp), LEFT, 36), graph(sharp, 160, true),
    diagram.spans(sharp, LEFT, 174, CELL),
  diagram.label(count(soft), LEFT, 262), graph(soft, 386, false),
    diagram.spans(soft, LEFT, 400, CELL),
})
