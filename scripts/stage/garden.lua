local field = rect {
  0, 0, 480, 270,
  fill = linear { from = { 0, 0 }, to = { 0, 270 }, { 0, "#9fd0e6" }, { 0.5, "#f2f0d2" },
    { 0.52, "#a9c46c" }, { 1, "#557f3f" } } }
local function hive(x, paint)
  return rect { x, 104, 70, 78, radius = 4, fill = paint }
    | rect { x - 6, 95, 82, 12, radius = 4, fill = "#7b5b41" }
    | rect { x, 140, 70, 3, fill = "#00000050" }
end
local keeper = union {
  path {
    d = "M236 290 C238 214 292 208 326 198 H372 C406 208 458 214 460 290 Z",
    fill = "#f3efe4" },
  path { d = "M326 198 L349 232 L372 198 V168 H326 Z", fill = "#c98d66" },
  path {
    d = "M304 118 C298 150 300 176 314 190 C330 160 370 160 384 190 C398 176 400"
      .. " 150 394 118 Z",
    fill = "#5b3826" },
  ellipse { 349, 140, 36, 45, fill = "#dea47b" },
  stroke { d = "M333 134 V138 M365 134 V138", width = 7, cap = "round",
    fill = "#3a2620" },
  stroke { d = "M332 158 Q349 174 366 158", width = 4, cap = "round", fill = "#a8493f" },
  ellipse { 349, 106, 92, 17, fill = "#d9b671" },
  path { d = "M303 104 C303 52 395 52 395 104 Q349 116 303 104 Z", fill = "#e8c985" } }

return { field = field, hive = hive, keeper = keeper }
