--- Pies: slices clockwise from the top, with gaps of even width, and their names beside them.
--
--        .-""-.--. Sun 41%     A name lies on the side of its slice, as near to its height as the
--       /  \  |   \            others on that side let it. A thin line leads to it.
--      |    \_|____|-. Rain 34%
--       \         /
--  Snow -`-.___.-'
local celspan = require "celspan"
local native = require "celspan.native"
local count = require "celspan.count"
local ease = require "celspan.ease"
local fields = require "celspan.fields"
local labels = require "celspan.labels"

local pies = {}

local pi, sin, cos = math.pi, math.sin, math.cos

local open_ease = ease "inOutCubic"
local GAP = 0.025                        -- between slices, of the radius
local STEM, ARM = 0.8, 0.9               -- of the line to a name, in ems: away from the pie, aside
local LINE, LEADING = 0.07, 1.5          -- its width, and from name to name, in ems
local LEAST = 1e-9                       -- a slice that is a smaller share is not drawn
local FAR = 2.2                          -- of the radius: chords of a third of a circle are outside

local function refuse(text, ...) native.refuse("chart: " .. text:format(...)) end

--- The slices: { name =, k =, from =, to =, share = }, angles clockwise from the top.
local function slices_of(chart)
  local values, sum, from, slices = chart.data.series[1].values, 0, 0, {}
  if #chart.data.series > 1 then
    refuse("a pie shows one field of the rows, got %d in 'y'", #chart.data.series)
  end
  for i, value in ipairs(values) do
    if value and value < 0 then
      refuse("a pie has no slice for a value below 0, got %s in row %d", fields.shown(value), i)
    end
    sum = sum + (value or 0)
  end
  for i, value in ipairs(values) do
    local share = sum > 0 and (value or 0) / sum or 0
    if share > LEAST then
      slices[#slices + 1] = { name = chart.data.name(i), k = i, share = share, value = value,
                              from = 2 * pi * from, to = 2 * pi * (from + share) }
      from = from + share
    end
  end
  return slices
end

--- What is written at a slice.
local function text_of(chart, slice)
  if chart.has_format then return slice.name .. "  " .. chart.written(slice.value) end
  return ("%s  %s%%"):format(slice.name, count.written(100 * slice.share,
    { language = chart.language }))
end

-- ---------------------------------------------------------------- slices

local function point(pie, angle, radius)
  return pie.x + radius * sin(angle), pie.y - radius * cos(angle)
end

--- The triangles from the middle that cover a part of the circle, as one polygon.
local function wedge(pie, from, to, texture)
  local pieces = math.max(1, math.ceil((to - from) / (2 * pi / 3)))
  local corners = { { pie.x, pie.y }, texture = texture }
  for i = 0, pieces do
    corners[i + 2] = { point(pie, from + (to - from) * i / pieces, FAR * pie.radius) }
  end
  return celspan.polygon(corners)
end

--- The circle, with its hole.
local function ring(pie)
  local function circle(radius)
    return celspan.circle { centre = { pie.x, pie.y }, radius = radius }
  end
  local whole = circle(pie.radius)
  return pie.hole > 0 and whole - circle(pie.radius * pie.hole) or whole
end

--- The gap at the beginning of a slice, from the middle outwards.
local function gap_at(pie, angle)
  local w = GAP * pie.radius
  return celspan.rect { pie.x - w / 2, pie.y - 1.1 * pie.radius, w, 1.1 * pie.radius }
    :rotate(math.deg(angle), pie.x, pie.y)
end

--- The slices as far as they are open, without the gaps between them.
local function drawn(chart, pie, slices, open)
  local wedges, parts = {}, {}
  for _, slice in ipairs(slices) do
    if slice.from < open then
      wedges[#wedges + 1] = wedge(pie, slice.from, math.min(slice.to, open),
        chart.colour(slice.k))
    end
  end
  parts[1] = celspan.clip(celspan.union(wedges), ring(pie))
  for _, slice in ipairs(#slices > 1 and slices or {}) do
    parts[#parts + 1] = gap_at(pie, slice.from)
  end
  return celspan.difference(parts)
end

-- ---------------------------------------------------------------- names

--- The slices whose middle is at the right, or at the left, from the top down.
local function side_of(slices, is_right)
  local side = {}
  for i = 1, #slices do
    local slice = slices[is_right and i or #slices + 1 - i]
    slice.middle = (slice.from + slice.to) / 2
    if (slice.middle <= pi) == is_right then side[#side + 1] = slice end
  end
  return side
end

--- The largest slices of a side for which there is room.
local function largest(side, room)
  local by_share, kept, list = table.move(side, 1, #side, 1, {}), {}, {}
  table.sort(by_share, function(a, b)
    return a.share > b.share or a.share == b.share and a.k < b.k
  end)
  for i = 1, math.min(room, #by_share) do kept[by_share[i]] = true end
  for _, slice in ipairs(side) do
    if kept[slice] then list[#list + 1] = slice end
  end
  return list
end

--- A name in as many lines as the room needs.
local function wrapped(pie, words, at, align)
  return celspan.text { words, font = pie.style.font, size = pie.style.size, align = align, at = at,
    texture = pie.style.texture, width = pie.room, valign = "middle" }
end

--- A name, and the line that leads to it from its slice.
local function add_name(objects, chart, pie, slice, y, way)
  local size, texture = chart.style.size, chart.style.texture
  local align = way > 0 and "left" or "right"
  local x0, y0 = point(pie, slice.middle, pie.radius * 1.03)
  local x1 = pie.x + way * (pie.radius + STEM * size)
  local x2 = x1 + way * ARM * size
  local shown = math.max(0, math.min(1, (pie.open - slice.from) / (slice.to - slice.from)))
  objects[#objects + 1] = celspan.stroke { points = { { x0, y0 }, { x1, y }, { x2, y } },
    width = LINE * size, texture = texture }:fade(0.5 * shown)
  local x, words = x2 + way * 0.4 * size, text_of(chart, slice)
  local text = pie.room and wrapped(pie, words, { way > 0 and x or x - pie.room, y }, align)
    or labels.text(words, pie.style, { x, y + pie.scale * chart.cap / 2 }, align)
  objects[#objects + 1] = text:fade(shown)
end

local function add_names(objects, chart, pie, slices)
  local box, gap = chart.box, LEADING * chart.style.size
  for _, slice in ipairs(pie.room and slices or {}) do
    local height = wrapped(pie, text_of(chart, slice), { 0, 0 }):metrics().height
    gap = math.max(gap, height + pie.style.size / 4)
  end
  local low, high = box[2] + chart.style.size / 2, box[2] + box[4] - chart.style.size / 2
  for way = -1, 1, 2 do
    local side, wanted = largest(side_of(slices, way > 0), (high - low) // gap + 1), {}
    for i, slice in ipairs(side) do
      local _, y = point(pie, slice.middle, pie.radius + STEM * chart.style.size)
      wanted[i] = y
    end
    for i, y in ipairs(labels.spread(wanted, gap, low, high) or {}) do
      add_name(objects, chart, pie, side[i], y, way)
    end
  end
end

local SMALLEST, LEAST_SIZE = 0.28, 0.7 -- of the box, what long names leave; of their size

--- How names are written that would leave the pie less: smaller, or else also in several lines.
local function fitted(chart, widest)
  local box, style = chart.box, chart.style
  local room = box[3] / 2 - (STEM + ARM + 0.4) * style.size - SMALLEST * math.min(box[3], box[4])
  local scale = math.max(LEAST_SIZE, math.min(1, room / widest))
  if scale == 1 or room <= 0 then return { style = style, scale = 1, width = widest } end
  return { scale = scale, width = math.min(room, scale * widest),
    room = scale * widest > room and room or nil,
    style = { font = style.font, size = scale * style.size, texture = style.texture } }
end

--- The circle: as large as the names on both sides let it.
local function place(chart, slices, has_names)
  local box, size, widest = chart.box, chart.style.size, 0
  for _, slice in ipairs(has_names and slices or {}) do
    widest = math.max(widest, labels.width(text_of(chart, slice), chart.style))
  end
  local pie = fitted(chart, widest)
  local aside = has_names and pie.width + (STEM + ARM + 0.4) * size or 0
  local radius = math.min(box[4] / 2 - (has_names and size / 2 or 0), box[3] / 2 - aside)
  if radius <= 0 then
    refuse("a box of %.4g x %.4g has no room beside its names: make it larger, or field 'size' "
      .. "smaller", box[3], box[4])
  end
  pie.x, pie.y, pie.radius, pie.hole = box[1] + box[3] / 2, box[2] + box[4] / 2, radius, chart.hole
  pie.open = 2 * pi * open_ease(chart.progress)
  return pie
end

---@return celspan.object
function pies.make(chart)
  local slices, has_names = slices_of(chart), chart.style.font ~= nil and chart.legend ~= false
  local pie = place(chart, slices, has_names)
  local objects = { drawn(chart, pie, slices, pie.open) }
  if has_names then add_names(objects, chart, pie, slices) end
  return celspan.union(objects)
end

return fields.seal("chart_pie", pies)
