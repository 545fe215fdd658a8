--- A table by a wall, bottles of glass that light goes through, and a lantern in a hand.
local TABLE, FOOT = 268, 290 -- where the table begins, and where the bottles are
local wall = rect { 0, 0, 640, TABLE, fill = linear { from = { 0, 0 }, to = { 0, TABLE },
  { 0, "#a08a6c" }, { 1, "#d8c19a" } } }
local grain = {}
for i = 1, 7 do
  grain[i] = stroke { width = 1.2, fill = "#7d4c2c",
    d = ("M-10 %g C160 %g 420 %g 650 %g"):format(298 + 1.2 * i * i, 301 + 1.1 * i * i,
      295 + 1.3 * i * i, 300 + 1.2 * i * i) }
end
local board = rect { 0, TABLE, 640, 360 - TABLE, fill = linear { from = { 0, TABLE },
  to = { 0, 360 }, { 0, "#9a6740" }, { 1, "#7d4c2c" } } } | union(grain)
  | rect { 0, TABLE, 640, 3, fill = "#c99763" }

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
  return { x = x, light = { r, g, b }, shape = shape,
    glass = glass:translate(x, FOOT),
    gleam = (gleam | cork:translate(0, -height)):translate(x, FOOT),
    width = width, height = height }
end

--- The light that a bottle lets onto the table when the lamp is at x: away from it, wider and
-- fainter the farther it goes.
local function patch(glass, x)
  local w, h, away = glass.width / 2, glass.height, 0.62 * (glass.x - x)
  local r, g, b = table.unpack(glass.light)
  local pale = linear { from = { 0, 0 }, to = { 0, -h }, { 0, rgb(r, g, b, 0.95) },
    { 0.4, rgb(r, g, b, 0.6) }, { 0.78, rgb(r, g, b, 0) } }
  local far = FOOT + 92
  return glass.shape:paint(pale):quad({ { -w, 0 }, { w, 0 }, { w, -h }, { -w, -h } }, {
    { glass.x - w, FOOT }, { glass.x + w, FOOT }, { glass.x + away + 2.6 * w, far },
    { glass.x + away - 2.2 * w, far } })
end

local dark, skin = "#2c2119", "#d79a6c"
local arm = union {
  path { d = "M-34 -172C-28 -140 -24 -120 -17 -98H19C24 -122 30 -146 36 -172Z", fill = "#7f9a94" },
  path { d = "M-20 -106H22V-96H-20Z", fill = "#a9bdb4" },
  path { d = "M-14 -97C-17 -84 -15 -74 -10 -66H13C17 -76 18 -86 16 -97Z", fill = skin } }
local lantern = union { arm,
  path { d = "M-19 -30 H19 L14 -46 H-14 Z M-22 30 H22 V38 H-22 Z", fill = dark },
  stroke { d = "M-13 -46 C-16 -76 16 -76 13 -46", width = 3, fill = dark },
  stroke { d = "M-9 -74V-63M-2 -76V-61M5 -76V-61M11 -74V-64", width = 7.4, cap = "round",
    fill = skin },
  stroke { d = "M-5.5 -79V-60M1.5 -80V-59M8 -79V-60", width = 1.3, cap = "round",
    fill = "#a4683f" },
  rect { -17, -30, 34, 60, fill = "#ffd98c" },
  path { d = "M0 24 C-14 12 -6 2 0 -16 C6 2 14 12 0 24 Z", fill = "#fff8e0" },
  stroke { d = "M-17 -30 V30 M17 -30 V30", width = 3, fill = dark } }

return { wall = wall, board = board, lantern = lantern, patch = patch, bottles = {
  bottle("tall", 236, 0.1, 0.62, 0.2), bottle("round", 362, 0.95, 0.12, 0.05),
  bottle("square", 490, 0.07, 0.35, 1) } }
