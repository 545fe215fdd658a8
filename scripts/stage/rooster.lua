local stripes = {}
for i = 0, 11 do
  stripes[i + 1] = polygon {
    { 0, 0 }, { 420, -58 }, { 420, 58 },
    fill = i % 2 == 0 and "#e9c46a" or "#f4a261" }
    :rotate(30 * i)
    :translate(240, 150)
end
local rooster = union {
  path {
    d = "M150 200 C150 150 200 140 232 160 C246 120 250 96 272 92 C300 90 304"
      .. " 120 296 140 C300 190 262 222 214 222 C180 222 160 214 150 200 Z",
    fill = "#b5442e" },
  path {
    d = "M160 196 C120 190 96 150 112 104 C122 138 138 142 148 120 C150 150 172"
      .. " 160 196 158 Z",
    fill = "#264653" },
  path {
    d = "M262 94 C258 76 270 74 274 86 C278 70 290 74 288 88 C298 78 304 90 294"
      .. " 102 Z",
    fill = "#d62828" },
  path { d = "M298 112 L320 118 L297 126 Z", fill = "#f6bd60" },
  circle { 284, 112, 4, fill = "#1d1d1d" },
  stroke {
    d = "M212 221 V244 M236 219 V244 M202 246 H222 M226 246 H246",
    width = 5, fill = "#e09f3e" } }

return { stripes = stripes, rooster = rooster }
