local keys = {
  rect { 60, 214, 360, 90, radius = 22, fill = "#c8433c" },
  rect { 34, 196, 412, 26, radius = 13, fill = "#3a2f33" },
  rect { 88, 190, 304, 16, fill = "#5a4a4e" } }
for i = 0, 19 do
  local x, y = 110 + 28 * (i % 10) - 7 * (i // 10), 240 + 22 * (i // 10)
  keys[#keys + 1] = circle { x, y + 2, 9, fill = "#8f2b2a" }
  keys[#keys + 1] = circle { x, y, 8, fill = "#f6ecd9" }
end

return keys
