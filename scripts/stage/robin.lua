local bird = path {
  d = "M0 0 C10 -40 60 -46 74 -14 C84 14 50 40 12 30 L-34 44 L-10 18 C-8 12 -4"
    .. " 6 0 0 Z",
  fill = "#4a8fc0" }
  | path { d = "M10 2 C26 -10 44 -4 48 8 C36 22 20 20 10 2 Z", fill = "#2f6c99" }
  | path { d = "M72 -20 L92 -12 L72 -6 Z", fill = "#f2a93b" }
  | circle { 58, -18, 4, fill = "#1d2a3a" }
  | path { d = "M22 30 C40 28 54 20 60 6 C66 22 48 40 22 30 Z", fill = "#f6efe0" }
local branch = stroke {
  points = { { -20, 176, 12 }, { 60, 182, 9 }, { 150, 168, 5 }, { 190, 172, 2 } },
  degree = 3, cap = "round", fill = "#8a5a3a" }

return { bird = bird, branch = branch }
