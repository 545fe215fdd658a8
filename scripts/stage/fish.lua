local fish = union {
  path { d = "M-46 0 C-20 -26 20 -22 44 0 C20 20 -20 24 -46 0 Z", fill = "#e8743b" },
  path { d = "M-40 0 L-70 -20 L-62 0 L-70 20 Z", fill = "#c4501f" },
  circle { 26, -5, 4, fill = "#22202a" } }
local sea = path {
  d = "M0 206 Q40 196 80 206 T160 206 T240 206 T320 206 T400 206 T480 206 V270"
    .. " H0 Z",
  fill = rgb("#2f7f9e", 0.85) }

return { fish = fish, sea = sea }
