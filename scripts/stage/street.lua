local function street(f)
  local parts = {
    rect { 0, 0, 320, 180, fill = "#1b2440" },
    rect { 0, 140, 320, 40, fill = "#0e1424" } }
  for i = 0, 6 do
    local x, high = 48 * i, 50 + i * 37 % 60
    parts[#parts + 1] = rect { x, 140 - high, 40, high, fill = "#263154" }
    local is_lit = (i * 5 + f.number // 12) % 3 > 0
    parts[#parts + 1] = rect {
      x + 12, 152 - high, 14, 10,
      fill = is_lit and "#ffd98a" or "#303c62" }
  end
  parts[#parts + 1] = circle { 250, 34, 13, fill = "#fff3d0" }
  return group(parts)
end

return street
