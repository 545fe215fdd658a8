-- Figure 7: compositing of span lists, here the intersection. Where two spans overlap, the colour
-- is one paint over the other; a gradient over a single colour is a gradient (Table 1).
local diagram = require "diagram"

local COLUMNS, CELL, LEFT = 30, 26, 150

local glass = paint { pigment = "#c4472f", medium = { 1, 0.45, 0.35 }, beta = 0.45 }
local a = union {
  rect { 2, 0, 11, 1, fill = diagram.teal },
  rect { 17, 0, 10, 1, fill = linear { from = { 17, 0 }, to = { 27, 0 },
    { 0, "#f3d27a" }, { 1, "#2f5d8a" } } },
}
local b = union {
  rect { 0, 0, 5, 1, fill = glass },
  rect { 8, 0, 13, 1, fill = glass },
  rect { 24, 0, 6, 1, fill = glass },
}

--- The row of an object, in white light in front of a white ground.
local function row(object)
  return diagram.row(rostrum { antialias = "none",
    cel { object, back = { 1, 1, 1, 0 } } }, COLUMNS)
end

--- Only the part that the object covers: without a matte, light shows where the row is empty.
local function drawn(object, y)
  local art = {}
  for _, span in ipairs(row(object)) do
    if span[4] > 0 then
      for i = 4, #span, 4 do span[i] = 1 end
      art[#art + 1] = span
    end
  end
  return diagram.spans(art, LEFT, y, CELL)
end

return diagram.film("Figure 7", 960, 250, {
  diagram.label("A", 132, 60, 26, "right"), drawn(a, 34),
  diagram.label("B", 132, 130, 26, "right"), drawn(b, 104),
  diagram.label("A and B", 132, 200, 26, "right"), drawn(a & b, 174),
})
