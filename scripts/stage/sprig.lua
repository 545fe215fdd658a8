local lamps = {}
for i = 1, 84 do
  local x, y = 640 * (0.7549 * i % 1), 320 - 210 * (0.5698 * i % 1) ^ 2
  local colour = ({ "#ffb347", "#ff8a4a", "#ffd98a", "#ffb060", "#7fd0d8", "#f06a80" })[i
    * 7
    % 6
    + 1]
  lamps[i] = circle { x, y, 1.2 + 1.6 * (0.618 * i % 1), fill = colour }
end
local leaf = path {
  d = "M0 0 C 14 -18 44 -20 66 0 C 44 20 14 18 0 0 Z",
  fill = "#0f2d33" }
local sprig = { path {
  d = "M-10 330 C 150 300 300 200 420 40 L 424 42 C 306 206 154 306 -10 340 Z",
  fill = "#0a2026" } }
for i = 0, 9 do
  local u = i / 9
  sprig[#sprig + 1] = leaf:scale(1.3 - 0.6 * u)
    :rotate(i % 2 == 0 and -85 + 10 * u or 25 - 40 * u)
    :translate(20 + 390 * u, 326 - 90 * u - 180 * u * u)
end

return { lamps = lamps, sprig = sprig }
