local function fir(x, y, size, paint, snow)
  local tree = polygon { { -20, -14 }, { 0, -52 }, { 20, -14 } }
    | polygon { { -26, 8 }, { 0, -34 }, { 26, 8 } }
  local cap = polygon { { -9, -34 }, { 0, -52 }, { 9, -34 }, { 3, -37 }, { -2, -33 } }
  return (tree:paint(paint) | cap:paint(snow)):scale(size):translate(x, y)
end
local function window(top, low, sun, hill, far, roof, leaves, tip)
  local sky = linear { from = { 0, 0 }, to = { 0, 200 }, { 0, top }, { 1, low } }
  return union {
    rect { 0, 0, 480, 270, fill = sky },
    circle { 352, 74, 34, fill = sun },
    path { d = "M0 190 C80 120 150 150 230 178 S400 110 480 160 V270 H0 Z", fill = far },
    rect { 120, 142, 84, 70, fill = "#e9d3b0" },
    rect { 152, 162, 20, 24, fill = "#ffcf5c" },
    path { d = "M108 146 L162 100 L216 146 Z M184 96 H198 V132 L184 120 Z", fill = roof },
    path { d = "M0 214 C90 176 190 192 260 214 S430 192 480 202 V270 H0 Z", fill = hill },
    fir(64, 206, 1.2, leaves, tip),
    fir(262, 212, 1, leaves, tip),
    fir(420, 214, 1.5, leaves, tip) }
end
local summer = window("#5db7e8", "#dff3e4", "#ffe27a", "#8cc152", "#b9d98a", "#d9573f",
  "#3f8a55", "#3f8a55")
local winter = window("#6f7fb5", "#f3d9dc", "#fff6dc", "#f4f7fc", "#c9d6ea", "#f4f7fc",
  "#3d5f73", "#ffffff")

return { summer = summer, winter = winter }
