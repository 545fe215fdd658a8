local function box(x, y, w, h, texture) return rect { x, y, w, h, fill = texture } end
local function down(y0, y1, one, other)
  return linear { from = { 0, y0 }, to = { 0, y1 }, { 0, one }, { 1, other } }
end

local panes = box(0, 0, 18, 24)
  | box(22, 0, 18, 24)
  | box(0, 28, 18, 24)
  | box(22, 28, 18, 24)
local gable = circle { 320, 126, 15 } - box(318, 100, 4, 60)
local holes = union { panes:translate(242, 196), panes:translate(358, 196), gable }
local curtain = box(0, 0, 640, 360, gel(1, 0.55, 0.12))

local sky = box(0, 0, 640, 360, down(0, 300, "#5aaede", "#f7ecd0"))
local hills = path {
  d = "M0 262 C110 190 210 236 330 250 S560 186 640 226 V360 H0 Z",
  fill = down(200, 300, "#9fc7a0", "#7fb07f") }
local house = union {
  box(408, 74, 26, 70, "#a4584a"),
  box(222, 150, 196, 150, down(150, 300, "#f6e3c0", "#dba878")),
  box(304, 224, 34, 80, "#7a4a3c"),
  polygon { { 196, 162 }, { 320, 64 }, { 444, 162 }, { 420, 162 }, { 320, 86 },
    { 220, 162 }, fill = "#9c4438" },
  polygon { { 220, 162 }, { 320, 86 }, { 420, 162 }, fill = "#e8c69a" } }
local function tree(x, y, size)
  local crown = path {
    d = "M0 -150 C46 -120 52 -30 0 -22 C-52 -30 -46 -120 0 -150 Z",
    fill = linear { from = { -40, 0 }, to = { 40, 0 }, { 0, "#8fb84f" },
      { 1, "#3f7a48" } } }
  return (box(-5, -40, 10, 44, "#7a5238") | crown):scale(size):translate(x, y)
end
local meadow = ellipse { 320, 430, 520, 142, fill = down(290, 360, "#86b95a", "#4f8a4a") }
local trail = path {
  d = "M306 292 H336 C340 320 400 330 420 360 H300 C330 332 312 318 306 292 Z",
  fill = "#e6d2a4" }
local garden = union { tree(120, 316, 1.25), tree(176, 310, 0.8), meadow, trail,
  tree(520, 330, 1.5) }

return { holes = holes, curtain = curtain, sky = sky, hills = hills, house = house,
  garden = garden }
