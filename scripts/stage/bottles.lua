--- A table by a wall, and bottles of glass that light goes through.
local wall = rect { 0, 0, 640, 250, fill = linear { from = { 0, 0 }, to = { 0, 250 },
  { 0, "#8f8172" }, { 1, "#c9b59a" } } }
local grain = {}
for i = 1, 9 do
  grain[i] = stroke { width = 1.5, fill = "#5d3b26",
    d = ("M-10 %g C160 %g 420 %g 650 %g"):format(248 + 2 * i * i, 252 + 1.7 * i * i,
      243 + 2.2 * i * i, 250 + 1.9 * i * i) }
end
local board = rect { 0, 246, 640, 114, fill = "#9a6a45" } | union(grain)
  | rect { 0, 246, 640, 3, fill = "#c08a5c" }

local shapes = {
  tall = [[M-9 -196 H9 V-136 C9 -118 34 -112 34 -84 V-8 Q34 0 26 0 H-26 Q-34 0 -34 -8 V-84
    C-34 -112 -9 -118 -9 -136 Z]],
  round = [[M-10 -142 H10 V-100 C44 -92 58 -66 58 -46 C58 -18 38 0 24 0 H-24 C-38 0 -58 -18
    -58 -46 C-58 -66 -44 -92 -10 -100 Z]],
  square = [[M-11 -164 H11 V-132 C11 -124 40 -124 40 -108 V-7 Q40 0 33 0 H-33 Q-40 0 -40 -7
    V-108 C-40 -124 -11 -124 -11 -132 Z]],
}
local cork = path { d = "M-8 -11 H8 L9 3 H-9 Z", fill = "#b98a5a" }

--- Glass of a colour at x: what is seen, the shape of the light behind it, the middle.
local function bottle(kind, x, r, g, b)
  local shape = path { d = shapes[kind] }
  local _, _, width, height = shape:bounds()
  local rim = shape - shape:scale(0.86, 0.955, 0, -height / 2)
  local gleam = stroke { points = { { -0.34 * width, -0.14 * height },
    { -0.37 * width, -0.3 * height }, { -0.3 * width, -0.44 * height } }, degree = 2, width = 4,
    cap = "round", fill = "#ffffff90" }
  local function deep(c) return c ^ 1.8 end
  local glass = shape:paint(gel(r, g, b)) | rim:paint(gel(deep(r), deep(g), deep(b)))
  return { x = x, colour = rgb(r, g, b), shape = shape, glass = glass:translate(x, 286),
    gleam = (gleam | cork:translate(0, -height)):translate(x, 286) }
end

local lantern = union {
  path { d = "M-19 -30 H19 L14 -46 H-14 Z M-22 30 H22 V38 H-22 Z", fill = "#2c2119" },
  stroke { d = "M-11 -46 C-14 -76 14 -76 11 -46", width = 3, fill = "#2c2119" },
  rect { -17, -30, 34, 60, fill = "#ffd98c" },
  path { d = "M0 24 C-14 12 -6 2 0 -16 C6 2 14 12 0 24 Z", fill = "#fff8e0" },
  stroke { d = "M-17 -30 V30 M17 -30 V30", width = 3, fill = "#2c2119" } }

return { wall = wall, board = board, lantern = lantern, bottles = {
  bottle("tall", 158, 0.07, 0.62, 0.2), bottle("round", 318, 0.95, 0.2, 0.05),
  bottle("square", 486, 0.06, 0.32, 0.95) } }
