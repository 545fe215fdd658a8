local lines = {}
for i = 0, 8 do lines[i + 1] = rect { 0, 44 + 26 * i, 480, 1, fill = "#bcd3e6" } end
lines[10] = rect { 54, 0, 1.4, 270, fill = "#e8a3a3" }
local pen = union {
  path { d = "M0 0 L9 -22 L20 -17 Z", fill = "#e8c9a0" },
  path { d = "M0 0 L3.4 -8.4 L7.6 -6.4 Z", fill = "#26304a" },
  path { d = "M9 -22 L20 -17 L62 -112 L51 -117 Z", fill = "#e4572e" },
  path { d = "M14 -20 L20 -17 L62 -112 L56 -115 Z", fill = "#bf3f1d" },
  path { d = "M62 -112 L51 -117 L54 -124 C58 -130 68 -126 65 -119 Z", fill = "#f4a9a8" } }

return { lines = lines, pen = pen }
