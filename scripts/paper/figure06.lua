-- Figure 6: a pixel array (above) represented as a list of spans (below). The row is rendered: the
-- spans are those of celspan.spans, and the pixels are made from them.
local diagram = require "diagram"

local COLUMNS, CELL, LEFT = 24, 36, 48

--- Nine pixels of a photograph: a sunset seen through branches.
local function photograph()
  local codes = { { 40, 44, 70 }, { 120, 70, 84 }, { 214, 120, 74 }, { 36, 30, 38 },
    { 246, 184, 96 }, { 252, 226, 150 }, { 58, 40, 44 }, { 226, 140, 84 }, { 92, 62, 88 } }
  local bytes = {}
  for i, code in ipairs(codes) do bytes[i] = string.char(table.unpack(code)) end
  return picture { pixels = table.concat(bytes), size = { #codes, 1 }, format = "rgb8",
    sampling = "nearest" }
end

local rostrum = celspan.rostrum { antialias = "none", cel {
  rect { 0, 0, 7, 1, fill = diagram.teal },
  rect { 7, 0, 8, 1, fill = linear { from = { 7, 0 }, to = { 15, 0 },
    { 0, diagram.gold }, { 1, diagram.red } } },
  rect { 15, 0, 9, 1, fill = photograph() },
} }
local row = diagram.row(rostrum, COLUMNS)

return diagram.film("Figure 6", 960, 260, {
  diagram.label("24 pixels", LEFT, 44),
  diagram.pixels(row, LEFT, 60, CELL),
  diagram.label("3 spans", LEFT, 148),
  diagram.spans(row, LEFT, 164, CELL),
  diagram.kinds(row, LEFT, 226, CELL),
})
