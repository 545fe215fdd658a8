--- Dots whose size follows a function of the place, 0..1, clipped to a shape.
local function halftone(shape, pitch, colour, tone)
  local x, y, w, h = shape:bounds()
  local dots = {}
  for row = 0, math.ceil(h / pitch * 2) do
    for column = 0, math.ceil(w / pitch) do
      local cx, cy = x + pitch * (column + row % 2 / 2), y + pitch * row / 2
      local radius = pitch * 0.56 * math.sqrt(math.max(0, math.min(1, tone(cx, cy))))
      dots[#dots + 1] = circle { cx, cy, radius, fill = colour }
    end
  end
  return clip(union(dots), shape)
end
local burst, corner = {}, random "burst"
for i = 0, 31 do
  local r = (i % 2 == 0 and 128 or 88) + 14 * corner(i)
  burst[i + 1] = {
    240 + 1.5 * r * math.cos(i * math.pi / 16),
    135 + 0.86 * r * math.sin(i * math.pi / 16) }
end
local star = polygon(burst)
local word = text { "POW!", 240, 172, font = "type/block.ttf", size = 104,
  align = "centre", variations = { wght = 900 } }
local hit = star:paint("#ffe14d")
  | halftone(star, 9, "#f59e1b", function(x, y)
    return math.sqrt((x - 240) ^ 2 + (y - 135) ^ 2) / 190 - 0.2
  end)
  | star:stroke { width = 5, join = "round", fill = "#20202a" }
  | word:stroke { width = 10, join = "round", fill = "#20202a" }:translate(4, 5)
  | word:with { fill = "#e5312b" }

return hit
