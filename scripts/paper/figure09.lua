-- Figure 9: the span list of one NURBS primitive. The art in front makes a mask (1); only the part
-- of the primitive outside the mask is computed (2); its opaque part is added to the mask (3),
-- which is then used for the cels behind.
local diagram = require "diagram"

local COLUMNS, CELL, LEFT = 60, 14, 60
local SCAN = 8 -- the row of pixels that is shown, of the 22 rows of the drawing

local leaf = nurbs { closed = "periodic", fill = diagram.gold,
  points = { { 6, 16 }, { 10, -4 }, { 24, 2 }, { 29, 17 }, { 37, -2 }, { 56, 1 }, { 54, 22 },
    { 30, 13 } } }
local front = union {
  circle { 16, 11, 5, fill = diagram.teal },
  rect { 43, 3, 5, 16, radius = 2, fill = diagram.teal },
}

--- The row of an object at the scan line.
local function row(object)
  return diagram.row(rostrum { antialias = "none",
    cel { object:translate(0, -SCAN) } }, COLUMNS)
end

--- An object in one colour.
local function flat(object, colour)
  return clip(rect { 0, 0, COLUMNS, 22, fill = colour }, object)
end

--- A numbered list of spans with its description.
local function list(number, text, object, y)
  return union {
    diagram.label(number, LEFT - 14, y + 15, 22, "right"),
    diagram.spans(row(object), LEFT, y, CELL),
    diagram.label(text, LEFT + COLUMNS * CELL, y - 8, 17, "right", diagram.grey),
  }
end

local drawing = (leaf | front):scale(CELL):translate(LEFT, 34)
local scan = 34 + (SCAN + 0.5) * CELL

return diagram.film("Figure 9", 960, 560, {
  drawing,
  diagram.line({ { LEFT - 20, scan }, { LEFT + COLUMNS * CELL + 20, scan } }, 2, diagram.ink),
  list("1", "the mask of what is in front", flat(front, diagram.ink), 376),
  list("2", "what is left of the primitive", leaf - front, 446),
  list("3", "the mask for what is behind", flat(leaf | front, diagram.ink), 516),
})
