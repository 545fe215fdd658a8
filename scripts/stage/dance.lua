-- Head, back, far leg, near leg and arm, drawn over each second picture.
local drawn = {
  { { 244, 33 }, "M241 57 L240 141", "M240 141 L240 192 L200 224",
    "M240 141 L240 192 L240 243", "M241 72 L231 108 L249 135" },
  { { 245, 28 }, "M242 51 L240 135", "M240 135 L267 178 L272 229",
    "M240 135 L213 178 L170 206", "M240 66 L215 102 L216 129" },
  { { 244, 34 }, "M241 57 L240 141", "M240 141 L240 192 L240 243",
    "M240 141 L240 192 L200 224", "M240 72 L231 108 L249 135" },
  { { 246, 27 }, "M242 51 L240 135", "M240 135 L213 178 L170 206",
    "M240 135 L267 178 L272 229", "M240 66 L247 102 L282 129" } }
local function limb(d, width, colour)
  -- a line in ink, and the colour within it
  local line = stroke { d = d, width = width + 7, cap = "round", join = "round",
    fill = "#20243d" }
  return line | line:with { width = width, fill = colour }
end
local cap = path {
  d = "M-21 -2 C-22 -25 22 -25 21 -2 L34 0 Q36 5 28 6 H-21 Z",
  fill = "#3a7ca5" }
local face = union {
  circle { 0, 0, 21, fill = "#ffd9b0" }:outline { width = 3.5, fill = "#20243d" },
  stroke { d = "M10 2 V7", width = 4, cap = "round", fill = "#20243d" },
  stroke { d = "M6 13 Q12 15 16 11", width = 2.5, cap = "round", fill = "#20243d" },
  cap:translate(-1, -3):outline { width = 3, fill = "#20243d" } }

return { drawn = drawn, limb = limb, face = face }
