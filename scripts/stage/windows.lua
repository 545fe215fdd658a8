local sky = rect {
  0, 0, 480, 270,
  fill = linear { from = { 0, 0 }, to = { 0, 200 }, { 0, "#5fb0e6" }, { 1, "#f2ead6" } } }
local town, windows, chance = union {}, {}, random "town"
for i = 0, 11 do
  local x = 42 * i - 10
  local h = 50 + 70 * chance(i)
  local wall = ({ "#e8c39e", "#d98f6c", "#c9b79c", "#b56b57" })[i % 4 + 1]
  town = town
    | rect { x, 222 - h, 40, h + 60, fill = wall }
    | path { d = ("M%g %g l22 -20 l22 20 Z"):format(x - 2, 223 - h), fill = "#7b4b43" }
  for k = 0, h // 24 - 1 do
    for side = 0, 1 do
      local pane = rect { x + 8 + 16 * side, 230 - h + 22 * k, 9, 12, fill = "#ffd98a" }
      town = town | pane:with { fill = "#6f8aa0" }
      windows[#windows + 1] = { pane = pane, from = 18 + 2.5 * chance(x + k),
        to = 22 + 3 * chance(x - k) }
    end
  end
end

return { sky = sky, town = town, windows = windows }
