local wall, bricks = rect { 0, 0, 480, 270, fill = "#4a2f3d" }, {}
for i = 0, 131 do
  local row, column = i // 11, i % 11
  local shade = mix("#5b3846", "#6d4450", random("brick")(i))
  bricks[i + 1] = rect {
    46 * column - 23 * (row % 2),
    23 * row, 43, 20, radius = 2, fill = shade }
end

return { wall = wall, bricks = bricks }
