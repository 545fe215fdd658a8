-- Figure 10: a picture on a primitive under a transform, and the output's pixels over it. Case 1,
-- near: one texel of the picture covers several pixels. Case 2, far: several texels lie in one
-- pixel.
local diagram = require "diagram"

local TEXELS, PIXEL = 16, 26

--- A chart of texels, each of one colour.
local function chart()
  local bytes = {}
  for y = 0, TEXELS - 1 do
    for x = 0, TEXELS - 1 do
      local u, v, dark = x / TEXELS, y / TEXELS, (x + y) % 2 == 0 and 0.78 or 1
      bytes[#bytes + 1] = string.char(math.floor((70 + 170 * u) * dark),
        math.floor((150 - 60 * u + 40 * v) * dark), math.floor((190 - 130 * v) * dark))
    end
  end
  return celspan.picture { pixels = table.concat(bytes), size = { TEXELS, TEXELS }, format = "rgb8",
    sampling = "nearest" }
end

local picture = rect { 0, 0, TEXELS, TEXELS, fill = chart() }
  :quad({ { 0, 0 }, { TEXELS, 0 }, { TEXELS, TEXELS }, { 0, TEXELS } },
        { { 398, 60 }, { 548, 66 }, { 900, 500 }, { 60, 470 } })

--- The pixels of the output as thin lines.
local function grid()
  local lines, colour = {}, "#26323d60"
  for x = 0, 960, PIXEL do lines[#lines + 1] = diagram.line({ { x, 0 }, { x, 540 } }, 1, colour) end
  for y = 0, 540, PIXEL do lines[#lines + 1] = diagram.line({ { 0, y }, { 960, y } }, 1, colour) end
  return union(lines)
end

--- An outlined pixel, with its case.
local function mark(column, row, text, x, y)
  local left, top = column * PIXEL, row * PIXEL
  return union {
    diagram.box(left, top, PIXEL, PIXEL, 4, diagram.red),
    diagram.line({ { left + PIXEL / 2, top + PIXEL / 2 }, { x, y } }, 2.5, diagram.red),
    rect { x - 62, y - 22, 124, 40, radius = 8, fill = diagram.red },
    diagram.label(text, x, y + 6, 22, "centre", "#ffffff"),
  }
end

return diagram.film("Figure 10", 960, 540, {
  picture, grid(), mark(8, 16, "case 1", 110, 250), mark(17, 3, "case 2", 720, 130) })
