--- Dunes by the sea at a time of the film: posts with a rope, and grass that the wind moves.
local mood = require("stage.moods").fog

local sky = rect { 0, 0, 480, 270, fill = linear { from = { 0, 0 }, to = { 0, 190 },
  table.unpack(mood.sky) } }
local function line(d, width, tint, taper)
  return stroke { d = d, width = width, cap = "round", fill = tint, taper = taper }
end

local posts = line("M-20 176Q70 196 120 172Q210 198 262 176Q350 198 404 170Q450 186 500 178", 2.4,
  "#8a7a5e")
for _, at in ipairs { { 120, 166, -3 }, { 262, 170, 4 }, { 404, 164, -2 } } do
  posts = posts | rect { -5, 0, 10, 66, radius = 3, fill = "#7d6d54" }:rotate(at[3])
    :translate(at[1], at[2])
end
local still = union { sky, rect { 0, 170, 480, 40, fill = "#9db3b1" },
  line("M0 184H90M150 190H300M340 180H460", 1.6, mood.light),
  path { d = "M0 206C80 182 150 196 240 204S400 188 480 198V270H0Z", fill = "#d9cda6" }, posts,
  path { d = "M0 232C120 222 300 226 480 230V270H0Z", fill = "#c9b98a" } }

--- Blades that lean with the wind, between two heights, at the depth of a foot.
local function grass(time, seed, count, foot, tall, tint)
  local blades = {}
  for i = 1, count do
    local x = 480 * (i + random(seed)(i)) / count - 10
    local h = tall * (0.6 + 0.5 * random(seed .. "tall")(i))
    local lean = h * (0.45 + 0.3 * math.sin(2 * math.pi * time / 1.5 - x / 70 + i % 3 * 0.3))
    blades[i] = line(("M%.1f %.1fQ%.1f %.1f %.1f %.1f"):format(x, foot, x, foot - 0.6 * h, x - lean,
      foot - h), 3.4, tint, { 0, h * 0.7 })
  end
  return union(blades)
end

return function(time)
  return still | grass(time, "far", 22, 234, 26, "#a8a873"),
    grass(time, "near", 34, 276, 40, "#7d8a5b")
end
