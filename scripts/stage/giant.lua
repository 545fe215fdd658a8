local noon, chance = require("stage.moods").noon, random "town"
local sky = linear { from = { 0, -60 }, to = { 0, 220 }, table.unpack(noon.sky) }
local town = {
  rect { -90, -90, 660, 320, fill = sky },
  circle { 110, 70, 34, fill = noon.light } }
for i = 0, 9 do
  local x, floors = 62 * i - 76, 2 + math.floor(4 * chance(i))
  town[#town + 1] = rect { x, 186 - 26 * floors, 58, 26 * floors + 30,
    fill = ({ noon.ground, "#e0a46c", "#f3e6c4" })[i % 3 + 1] }
  for k = 0, 2 * floors - 1 do
    town[#town + 1] = rect { x + 11 + 24 * (k % 2), 168 - 26 * (k // 2), 12, 15,
      fill = "#4f8fa3" }
  end
end
town[#town + 1] = rect { -90, 204, 660, 150, fill = "#5f7f86" }
  | rect { -90, 204, 660, 5, fill = "#d9e4dc" }
  | stroke { d = "M-90 250 H570", width = 4, dash = { 30, 22 }, fill = "#e8dcc0" }
local function car(x, y, paint, hop)
  return union {
    path { d = "M-38 0 V-14 L-22 -18 L-10 -32 H16 L28 -18 L40 -14 V0 Z", fill = paint },
    path { d = "M-14 -19 L-6 -28 H13 L21 -19 Z", fill = "#d8f0f4" },
    circle { -21, 0, 8 },
    circle { 23, 0, 8 } }
    :rotate(0.5 * hop)
    :translate(x, y - hop)
end
local foot = path {
  fill = linear { from = { -60, 0 }, to = { 80, 0 }, { 0, "#7fb069" }, { 1, "#3f7d58" } },
  d = "M-62 -420 H52 L48 -72 C74 -62 96 -34 94 0 H-74 C-80 -40 -66 -70 -62 -110 Z" }
for i = 0, 3 do
  foot = foot
    | path { d = "M-11 0 Q-13 -22 0 -26 Q13 -22 11 0 Z", fill = "#fff3d6" }
      :translate(80 - 44 * i, 2)
end

return { town = town, car = car, foot = foot }
