-- Nine mouths, one per shape of Rhubarb's alphabet: A-F spoken, G and H for f and l, X at rest.
-- Each is drawn around (0, 0), about 60 units wide.
local palette = require "demo.palette"
local shapes = require "demo.shapes"

local dark, teeth, tongue, lip = "#5b1624", "#fff3e2", "#dd5a58", "#a83b3f"

--- Closed lips: a line through the points.
local function line(...)
  return shapes.ribbon({ ... }, palette.ink)
end

--- An open mouth: half its width, its depth, and how far teeth and tongue reach into it.
local function open(half, depth, upper, lower)
  local dip = 7 + depth * 0.06
  local outline = path { fill = dark,
                         d = ("M%g -4Q0 %g %g -4C%g %g %g %g %g -4Z"):format(
    -half, dip, half, half * 1.06, depth * 1.4, -half * 1.06, depth * 1.4, -half) }
  local inside = union {
    ellipse { 0, depth * 1.1 - lower, half * 0.68, lower + 2,
              fill = tongue },
    path { fill = teeth, d = ("M%g -9H%gV%gQ0 %g %g %gZ"):format(
      -half * 0.86, half * 0.86, upper - 5, dip + upper, -half * 0.86, upper - 5) },
  }
  return union { outline, clip(inside, outline) }
end

return {
  A = line({ -25, -1, 2 }, { -12, 2, 5 }, { 0, 5, 6 }, { 12, 2, 5 }, { 25, -1, 2 }),
  B = open(28, 15, 9, 0),
  C = open(28, 27, 7, 9),
  D = open(31, 46, 9, 17),
  E = open(20, 34, 5, 10),
  F = union { ellipse { 0, 8, 15, 14, fill = lip },
              ellipse { 0, 8, 9, 8, fill = dark } },
  G = union { open(25, 14, 10, 0),
              shapes.ribbon({ { -20, 11, 3 }, { 0, 15, 9 }, { 20, 11, 3 } }, lip) },
  H = open(26, 36, 7, 26),
  X = line({ -27, -3, 2 }, { -14, 4, 4 }, { 0, 6, 5 }, { 14, 4, 4 }, { 27, -3, 2 }),
}
