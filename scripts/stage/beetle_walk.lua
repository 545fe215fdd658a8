--- A beetle at a moment of its walk, in a cell of 120 by 90.
local function walker(u)
  local turn = 2 * math.pi * u
  local parts = union {}
  for i = 0, 2 do
    local swing = 9 * math.cos(turn + 2 * i)
    local lift = 7 * math.max(0, math.sin(turn + 2 * i))
    local x = 42 + 18 * i
    parts = parts
      | stroke {
        points = { { x, 54 }, { x + swing / 2 - 4, 62 - lift / 2 },
          { x + swing, 76 - lift } },
        width = 4, join = "round", cap = "round", fill = "#3b2f2f" }
  end
  local bob = 1.5 * math.sin(2 * turn)
  local shell = path { d = "M24 56 C24 22 84 18 90 56 Z", fill = "#5aa36a" }
    | stroke { d = "M56 30 L54 56", width = 2, fill = "#3c7a4c" }
    | circle { 42, 44, 4, fill = "#f4d35e" }
    | circle { 68, 40, 5, fill = "#f4d35e" }
  local head = circle { 95, 50, 11, fill = "#3b2f2f" }
    | circle { 99, 47, 3, fill = "#fff" }
    | stroke { d = "M98 41 C102 30 108 30 112 34", width = 2, cap = "round",
      fill = "#3b2f2f" }
  return parts | (shell | head):translate(0, bob)
end

return walker
