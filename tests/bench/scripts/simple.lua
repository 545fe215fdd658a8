-- The film that most people make: a background that does not move (a sky and five hills), thirty
-- balls that do, each with a gradient and a little clear, and a title. tests/bench/films has the
-- same film for other programs. 1280 x 720, 150 frames.
local celspan = require "celspan"

local colours = { "#e4572ee6", "#f3a712e6", "#2e86abe6" }
local W, H = 1280, 720

local function vertical(top, foot)
  return celspan.linear { from = { 0, 0 }, to = { 0, H }, { 0, top }, { 1, foot } }
end

local background = { celspan.rect { 0, 0, W, H, texture = vertical("#16202e", "#7a5c74") } }
for i = 0, 4 do
  local points = { { 0, H } }
  for x = 0, W, 16 do
    points[#points + 1] = { x, 420 + 60 * i + 40 * math.sin(x / (90 + 30 * i) + 2 * i) }
  end
  points[#points + 1] = { W, H }
  points.texture = vertical("#3d5a6c", "#16202e")
  background[#background + 1] = celspan.polygon(points)
end

local balls = {}
for i = 0, 29 do
  local radius = 30 + 3 * i
  balls[i] = celspan.circle { centre = { 0, 0 }, radius = radius, texture = celspan.radial {
    centre = { 0, 0 }, radius = radius, { 0, "#fff4d6e6" }, { 1, colours[i % 3 + 1] } } }
end
local title = celspan.cel { celspan.text { "Six seconds", size = 96, at = { 640, 160 },
  align = "centre", font = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf",
  texture = "#f6ead2" } }
local still = celspan.cel(background)

return celspan.film { size = { W, H }, fps = 25, frames = 150, frame = function(f)
  local u, moving = f.index / 149, {}
  for i = 0, 29 do
    moving[i + 1] = balls[i]:translate((1 - u) * (173 * i % W) + u * (311 * i % W),
      (1 - u) * (97 * i % H) + u * ((59 * i + 300) % H))
  end
  return celspan.rostrum { still, celspan.cel(moving), title }
end }
