local W, H = 480, 270
local function all(texture) return rect { 0, 0, W, H, fill = texture } end
local sky = all(linear { from = { 0, 0 }, to = { 0, H }, { 0, "#28527f" },
  { 0.7, "#9fc0d8" }, { 1, "#e9dcc8" } })

local marble = noise {
  kind = "turbulence", size = 70, octaves = 6, seed = 5,
  colours = { "#3a3440", "#c9b9b0", "#f3ece4", "#fff", "#fff" } }
local shade = radial { centre = { 372, 186 }, radius = 64, focus = { 350, 158 },
  { 0, "#ffffff50" }, { 0.25, "#ffffff00" }, { 0.6, "#20182a40" }, { 1, "#100818e0" } }
local ball = circle { 372, 186, 62, fill = marble }

return { sky = sky, shade = shade, ball = ball }
