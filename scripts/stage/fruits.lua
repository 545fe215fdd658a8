local function disc(x, y, r) return circle { x, y, r } end
local pear = path {
  d = "M0 -84 C22 -84 26 -62 30 -40 C36 -12 66 4 66 40 C66 82 34 100 0 100C-34"
    .. " 100 -66 82 -66 40 C-66 4 -36 -12 -30 -40 C-26 -62 -22 -84 0 -84 Z" }
local fruits = {
  { (disc(-20, 20, 56) | disc(22, 20, 56)), "#e5483f", 96, 150 },
  { pear:scale(0.9), "#c9c24a", 236, 138 },
  { disc(0, 26, 60), "#7a4b9c", 376, 142 } }
local stem = stroke {
  points = { { 0, 0, 5 }, { 3, -20, 4 }, { 12, -36, 8 } },
  degree = 2, cap = "round", fill = "#5b3b28" }

return { fruits = fruits, stem = stem }
