local chance, leaves = random "leaf", {}
for i = 1, 90 do
  local shade = mix("#7fb069", "#3f7d4f", chance(i))
  leaves[i] = path { d = "M0 0 C14 -14 40 -14 54 0 C40 14 14 14 0 0 Z", fill = shade }
    :rotate(360 * chance(-i)):translate(480 * chance(i + 0.3), 270 * chance(i + 0.6))
end
local dots = { { -5, -3 }, { -6, 4 }, { 5, -3 }, { 6, 4 } }
local beetle = circle { 0, 0, 10, fill = "#d62839" }
  | circle { 0, -9, 5, fill = "#222" }
  | stroke { d = "M0 -8 V10", width = 1, fill = "#222" }
  | stroke { d = "M-2 -13 L-6 -18 M2 -13 L6 -18", width = 0.9, cap = "round",
    fill = "#222" }
for _, dot in ipairs(dots) do
  beetle = beetle | circle { centre = dot, radius = 2.1, fill = "#222" }
end

return { leaves = leaves, beetle = beetle }
