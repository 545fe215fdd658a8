--- A title, months, and lines at each ten thousand, behind the line of a chart.
local noto = require "stage.noto"
local pale = "#7a86ab"

local grid = {
  noto { "Visitors of the lighthouse", 24, 35, size = 18, weight = "Bold",
    fill = "#1b2559" },
  noto { "Thousands, each month of the first year", 24, 53, size = 11.5, fill = pale } }
for i, month in ipairs { "Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep",
  "Oct", "Nov", "Dec" } do
  grid[#grid + 1] = noto { month, 52 + 36 * (i - 1), 248, size = 10, align = "centre",
    fill = pale }
end
for i = 0, 40, 10 do
  grid[#grid + 1] = rect { 52, 228 - 3.4 * i, 404, 1, fill = "#e3e8f4" }
    | noto { i, 40, 231.5 - 3.4 * i, size = 10, align = "right", fill = pale }
end

return grid
