local function tree(size, leaves)
  local crown = union {}
  for i = 0, 6 do
    local x, y = 26 * math.cos(2.4 * i), 22 * math.sin(2.4 * i)
    crown = crown | circle { x, y - 92, 24 + 6 * (i % 3), fill = leaves[i % 2 + 1] }
  end
  return (path {
     d = "M-9 0 C-3 -30 -6 -60 -4 -90 L4 -90 C6 -60 4 -30 10 0 Z",
     fill = "#7a4b33" }
     | crown)
    :scale(size)
end

return tree
