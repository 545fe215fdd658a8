-- A pan: one long drawing, a row of houses on a canal, seen through a viewport that slides along.
-- The water shows the same drawing again, turned over and faded: values are shared, not redrawn.
local shapes = require "demo.shapes"

local walls = { "#b5523b", "#e0a458", "#2f4858", "#8c3f3c", "#d9c5a0", "#4f6d5a", "#c9733f" }
local quay = 700

--- A facade: brick, a gable in one of three styles, tall windows, a door.
local function house(i, x, w, h)
  local wall, top = walls[i * 3 % 7 + 1], quay - h
  local gable = ({
    ("M%g %gl%g %gl%g %gz"):format(x, top, w / 2, -w * 0.55, w / 2, w * 0.55),
    ("M%g %gv-24h%gv-30h%gv-30h%gv-20h%gv20h%gv30h%gv30h%gv24z"):format(
      x, top, w * .14, w * .14, w * .14, w * .16, w * .14, w * .14, w * .14),
    ("M%g %gc%g -10 %g -40 %g -96q%g -22 %g 0c%g 56 %g 86 %g 96z"):format(
      x, top, w * .22, w * .1, w * .3, w * .2, w * .4, w * .2, w * .08, w * .3),
  })[i % 3 + 1]
  local parts = { rect { x, top - 1, w, h + 1, fill = wall },
                  path { d = gable, fill = wall },
                  rect { x, top - 2, w, 7, fill = "#f3e6cd" } }
  local columns, rows = w > 130 and 3 or 2, math.floor(h / 96)
  for k = 0, columns * rows - 1 do
    local wx, wy = x + (k % columns + 0.5) * w / columns - 13, top + 30 + k // columns * 92
    local is_lit = (i * 5 + k * 3) % 7 < 2
    parts[#parts + 1] = rect { wx - 4, wy - 4, 34, 58, fill = "#f3e6cd" }
    parts[#parts + 1] = rect { wx, wy, 26, 50, fill = is_lit and "#ffd27a" or "#26343f" }
  end
  parts[#parts + 1] = circle { x + w / 2, top - 26, 11,
                               fill = "#26343f" }
  return union(parts)
end

local row, x = {}, -40
for i = 1, 26 do
  local w = 104 + i * 37 % 62
  row[i] = house(i, x, w, 260 + i * 53 % 170)
  x = x + w
end
local houses = union(row)
local street = rect { -100, quay, 4000, 26, fill = "#6b5b52" }
local water = shapes.down(quay, 1080, { "#59737c", "#1f3140" })
local sky = shapes.down(0, quay, { "#7fa3b5", "#c2bda9", "#efcfa3", "#f4b183" })

local reflection = houses:translate(0, -quay - 26):scale(1, -0.82):translate(0, quay + 26)

local ripples = {}
for i = 1, 60 do
  ripples[i] = rect { i * 389 % 3900 - 60, quay + 40 + i * i % 340, 90 + i * 31 % 160, 3,
                      radius = 1.5, fill = "#dbe6e066" }
end

return film { frames = 48, frame = function(f)
  local slide = 1500 * ease "inOutCubic" (f.progress)
  local window = { slide, 0, f.width, f.height }
  return {
    rect { 0, 0, 1920, 1080, fill = sky },
    cel { houses, street, viewport = window },
    rect { 0, quay + 26, 1920, 400, fill = water },
    cel { reflection, opacity = 0.34, viewport = window },
    cel { union(ripples):translate(-30 * f.time, 0), viewport = window },
  }
end }
