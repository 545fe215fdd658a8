--- Numbers on sheets of panels: strokes, so that no font is needed.
local celspan = require "celspan"

local DIGIT = 12 -- the height, in film units

--- Digits on a grid of 4 by 8, as strokes.
local strokes = {
  ["0"] = "M1 0 H3 L4 1 V7 L3 8 H1 L0 7 V1 Z",
  ["1"] = "M1 1.5 L2.5 0 V8",
  ["2"] = "M0 1.5 Q0 0 2 0 Q4 0 4 2 Q4 3.5 0 8 H4",
  ["3"] = "M0 0 H4 L1.8 3 Q4 3 4 5.5 Q4 8 2 8 Q0.5 8 0 6.8",
  ["4"] = "M3 8 V0 L0 5.5 H4",
  ["5"] = "M4 0 H0.5 L0.2 3.5 Q4 2.5 4 5.4 Q4 8 2 8 Q0.5 8 0 7",
  ["6"] = "M3.6 0 Q0 2 0 5.5 Q0 8 2 8 Q4 8 4 5.5 Q4 3.4 2 3.4 Q0.6 3.4 0 5",
  ["7"] = "M0 0 H4 L1.4 8",
  ["8"] = "M2 0 Q4 0 4 1.8 Q4 3.6 2 3.6 Q0 3.6 0 1.8 Q0 0 2 0 Z "
    .. "M2 3.6 Q4 3.6 4 5.8 Q4 8 2 8 Q0 8 0 5.8 Q0 3.6 2 3.6 Z",
  ["9"] = "M0.4 8 Q4 6 4 2.5 Q4 0 2 0 Q0 0 0 2.5 Q0 4.6 2 4.6 Q3.4 4.6 4 3",
  ["-"] = "M0.5 4 H3.5", ["."] = "M2 7.9 V8",
}

--- A number with its upper left corner at x, y.
return function(number, x, y)
  local parts, scale = {}, DIGIT / 8
  for i = 1, #number do
    local digit = celspan.stroke { d = strokes[number:sub(i, i)], width = 1, cap = "round",
      join = "round", texture = "#333" }
    parts[i] = digit:scale(scale):translate(x + (i - 1) * 6 * scale, y)
  end
  return celspan.union(parts)
end
