local chance = random "wood"
local function stem(i, reach, foot)
  -- a trunk with a few branches
  local x = 60 * i - 74 + 34 * chance("x" .. i)
  local w = reach * (0.7 + 0.6 * chance("w" .. i))
  local lean = 26 * chance("l" .. i) - 13
  local parts = { path { d = ("M%g %g Q%g 150 %g -20 H%g Q%g 150 %g %g Z")
    :format(x - w, foot, x - w / 2, x + lean - w / 3, x + lean + w / 3, x + w / 2, x + w,
      foot) } }
  for k = 1, 4 do
    local y = 24 + 34 * k + 20 * chance(i + k / 9)
    local side = (k + i) % 2 * 2 - 1
    local at = x + lean * (1 - y / 250)
    local long = (26 + 30 * chance(i - k / 9)) * side
    parts[#parts + 1] = path { d = ("M%g %g Q%g %g %g %g Q%g %g %g %g Z")
      :format(at, y, at + long / 2, y - 6, at + long, y - 24, at + long / 2, y, at,
        y + w / 2) }
  end
  return union(parts)
end
local far, near = union {}, union {}
for i = 0, 9 do far = far | stem(i, 6, 228) end
for i = 20, 23 do
  near = near | stem(i, 15, 290):translate(126 * (i - 20) - 60 * i + 74, 0)
end
local ground = path { d = "M0 222 C120 204 330 236 480 214 V270 H0 Z", fill = "#3a2a3f" }

return { far = far, near = near, ground = ground }
