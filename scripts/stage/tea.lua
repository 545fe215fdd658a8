local folder = "/usr/share/fonts/truetype/noto/" -- Debian's fonts-noto-core
local shade = linear { from = { 0, 0 }, to = { 0, 96 }, { 0, rgb("#5b4a36", 0.5) },
  { 0.25, rgb("#5b4a36", 0) }, { 0.75, rgb("#5b4a36", 0) }, { 1, rgb("#5b4a36", 0.5) } }
local ground = radial { centre = { 240, 110 }, radius = 330, { 0, "#3f8f86" },
  { 1, "#1d4f55" } }
local label = text {
  "cups of tea, and still thirsty", 240, 234,
  font = folder .. "NotoSerif-Italic.ttf",
  size = 21, align = "centre", fill = "#f3ead6" }

return { shade = shade, ground = ground, label = label }
