local sky = rect {
  0, -20, 480, 170,
  fill = linear { from = { 0, 0 }, to = { 0, 145 }, { 0, "#8fc7e8" }, { 1, "#fdf1d3" } } }
local house = union {
  rect { 0, -46, 60, 46, fill = "#d1574b" },
  path { d = "M-7 -44 L30 -78 L67 -44 Z", fill = "#5b3a3a" },
  rect { 12, -34, 13, 14, fill = "#fff4cf" },
  rect { 36, -34, 13, 34, fill = "#7a3d36" } }
local tree = rect { -3, -26, 6, 26, fill = "#6b4a34" }
  | ellipse { 0, -46, 19, 30, fill = "#5f9a5a" }
local shore = union {
  sky,
  circle { 380, 40, 22, fill = "#fffbe8" },
  path { d = "M-20 150 L60 62 L120 110 L190 40 L300 150 Z", fill = "#8fa3b8" },
  path { d = "M160 72 L190 40 L216 67 L200 62 L188 74 L176 64 Z", fill = "#fff" },
  path {
    d = "M-20 150 C80 112 180 134 260 128 S420 110 500 132 V150 Z",
    fill = "#86b46b" },
  house:translate(300, 136),
  tree:translate(270, 138),
  tree:scale(0.8):translate(392, 136),
  tree:scale(1.2):translate(90, 140) }

return shore
