-- Parts of the diagrams in the paper's figures: labels, cells, brackets and arrows, on paper of one
-- colour.

local diagram = {}

diagram.paper, diagram.ink, diagram.grey = "#f8f3e9", "#26323d", "#8a8f8f"
diagram.red, diagram.gold, diagram.teal = "#c4472f", "#dba23a", "#2a7f86"

local FONT = "../type/block.ttf"

--- A line of text; `align` as of celspan.text.
function diagram.label(text, x, y, size, align, colour)
  return celspan.text { text, x, y, font = FONT, size = size or 22, align = align,
    fill = colour or diagram.ink }
end

--- A line through points {x, y}.
function diagram.line(points, width, colour)
  return stroke { points = points, width = width or 2, cap = "round", join = "round",
    fill = colour or diagram.ink }
end

--- The outline of a rectangle.
function diagram.box(x, y, w, h, width, colour)
  return rect { x, y, w, h }:stroke { width = width or 2, fill = colour or diagram.ink }
end

--- A line from one point to another with a head at its end.
function diagram.arrow(x0, y0, x1, y1, colour)
  local length = math.sqrt((x1 - x0) ^ 2 + (y1 - y0) ^ 2)
  local ux, uy = (x1 - x0) / length, (y1 - y0) / length
  local bx, by = x1 - 15 * ux, y1 - 15 * uy
  colour = colour or diagram.ink
  return union {
    diagram.line({ { x0, y0 }, { bx, by } }, 3, colour),
    triangle { { x1, y1 }, { bx - 7 * uy, by + 7 * ux }, { bx + 7 * uy, by - 7 * ux },
      fill = colour },
  }
end

--- A linear, premultiplied colour of a span, as a paint.
function diagram.paint(r, g, b, a)
  if a == 0 then return clear end
  local function straight(value) return math.min(1, value / a) end
  return rgb(straight(r), straight(g), straight(b), a)
end

--- Colours i, i + 1, ... of a span, as a paint.
local function colour_at(span, i)
  return diagram.paint(table.unpack(span, 4 * i - 3, 4 * i))
end

--- The texture of a span whose columns are `size` wide, drawn from `x`.
local function texture(span, x, size)
  if span.kind == "single" then return colour_at(span, 1) end
  local from, to = x + size / 2, x + (span.x1 - span.x0 - 0.5) * size
  return linear { from = { from, 0 }, to = { to, 0 },
    { 0, colour_at(span, 1) }, { 1, colour_at(span, 2) } }
end

--- The colour of pixel i, from 1, of a span.
local function pixel(span, i)
  if span.kind == "single" then return colour_at(span, 1) end
  if span.kind == "array" then return colour_at(span, i) end
  local u = (i - 1) / math.max(1, span.x1 - span.x0 - 1)
  return mix(colour_at(span, 1), colour_at(span, 2), u)
end

--- Whether a span is empty.
local function is_empty(span) return span.kind == "single" and span[4] == 0 end

--- A row of spans as one box for each pixel, `size` wide, from x, y.
function diagram.pixels(row, x, y, size)
  local parts = {}
  for _, span in ipairs(row) do
    for i = 1, span.x1 - span.x0 do
      local left = x + (span.x0 + i - 1) * size
      parts[#parts + 1] = rect { left, y, size, size, fill = pixel(span, i) }
      parts[#parts + 1] = diagram.box(left, y, size, size, 1, diagram.grey)
    end
  end
  return union(parts)
end

--- A row of spans as one box for each span that shows; an array keeps its pixels.
function diagram.spans(row, x, y, size)
  local parts = {}
  for _, span in ipairs(row) do
    if not is_empty(span) then
      local left, width = x + span.x0 * size, (span.x1 - span.x0) * size
      if span.kind == "array" then
        parts[#parts + 1] = diagram.pixels({ span }, x, y, size)
      else
        parts[#parts + 1] = rect { left, y, width, size,
          fill = texture(span, left, size) }
      end
      parts[#parts + 1] = diagram.box(left, y, width, size, 3)
    end
  end
  return union(parts)
end

--- Writes the contents of a span below its middle.
function diagram.kinds(row, x, y, size)
  local parts = {}
  for _, span in ipairs(row) do
    if not is_empty(span) then
      local middle = x + (span.x0 + span.x1) / 2 * size
      parts[#parts + 1] = diagram.label(span.kind, middle, y, 19, "centre", diagram.grey)
    end
  end
  return union(parts)
end

--- The one row of a frame `width` pixels wide and one high.
function diagram.row(rostrum, width)
  return assert(spans(rostrum, { size = { width, 1 }, film = { width, 1 } }))[0]
end

--- A film of one frame, `width` x `height`: art on paper.
function diagram.film(title, width, height, art)
  local ground = rect { 0, 0, width, height, fill = diagram.paper }
  return film { title = title, size = { width, height }, frames = 1, frame = function()
    return cel { ground, table.unpack(art) }
  end }
end

return diagram
