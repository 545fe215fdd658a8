local W, H = 480, 270
local function ring(radius)
  return circle { W / 2, 122, radius }:stroke { width = 3, fill = "#3b372f" }
end
local marks = union {
  ring(104), ring(92),
  rect { 0, 120.5, W, 3, fill = "#3b372f" },
  rect { W / 2 - 1.5, 0, 3, H, fill = "#3b372f" } }
local paper = radial { centre = { W / 2, H / 2 }, radius = 300, { 0, "#e9e2cf" },
  { 0.6, "#d6ccb2" }, { 1, "#8d8467" } }

return { marks = marks, paper = paper }
