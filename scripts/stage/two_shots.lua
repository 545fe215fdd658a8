local W, H = 480, 270
local function sky(top, bottom)
  return rect {
    0, 0, W, H,
    fill = linear { from = { 0, 0 }, to = { 0, H }, { 0, top }, { 1, bottom } } }
end

local day = film { size = { W, H }, frames = 36, frame = function(f)
  local cloud = union {
    circle { 0, 0, 22 },
    circle { 28, -10, 30 },
    circle { 62, 0, 24 } }
    :paint "#fff"
  return {
    cel {
      sky("#7cc6ee", "#e6f5ef"),
      circle { 90, 70, 34, fill = "#ffe07a" },
      cloud:translate(220 + 80 * f.progress, 80) },
    path { d = "M0 200 C140 150 300 230 480 180 V270 H0 Z", fill = "#86b95c" } }
end }

local night = film { size = { W, H }, frames = 36, frame = function()
  local stars, chance = { sky("#101c3d", "#33406b") }, random "stars"
  for i = 1, 60 do
    stars[#stars + 1] = circle {
      W * chance("x" .. i), 190 * chance("y" .. i),
      0.6 + 1.2 * chance("r" .. i),
      fill = "#fff6d8" }
  end
  return { cel(stars), cel {
    circle { 390, 70, 28, fill = "#f6ecc9" },
    path { d = "M0 200 C140 150 300 230 480 180 V270 H0 Z", fill = "#1d3a33" } } }
end }

return { day = day, night = night }
