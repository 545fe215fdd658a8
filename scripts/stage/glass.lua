--- Pieces of painted paper in a wedge: what a kaleidoscope mirrors.
local tints = { "#c8452f", "#f0a830", "#1f6f6b", "#f3d9a4", "#7d2f4f", "#3f8fa8", "#23304a" }
local chance = random "paper"

local function shape(kind, size)
  if kind == 0 then
    return path { d = ("M0 %g C%g %g %g %g 0 %g C%g %g %g %g 0 %g Z"):format(-size, size * 0.8,
      -size * 0.4, size * 0.8, size * 0.4, size, -size * 0.8, size * 0.4, -size * 0.8,
      -size * 0.4, -size) }
  elseif kind == 1 then
    return circle { 0, 0, size } - circle { 0, 0, size * 0.55 }
  end
  return polygon { { 0, -size }, { size * 0.6, size * 0.7 }, { -size * 0.6, size * 0.7 } }
end

--- The pieces at a share of the loop: each turns about itself, and wanders a little.
return function(u)
  local pieces, turn = { rect { -10, -10, 420, 420, fill = "#f3d9a4" } }, 2 * math.pi * u
  for i = 1, 30 do
    local size, colour = 9 + 17 * chance(i), tints[i % #tints + 1]
    local one = shape(i % 3, size):paint(colour)
    local core = shape((i + 1) % 3, size * 0.45):paint(tints[(i + 3) % #tints + 1])
    pieces[i + 1] = (one | core):rotate(360 * u * (i % 2 == 0 and 1 or -1) + 40 * i)
      :translate(140 * chance(2 * i) + 9 * math.sin(turn + i),
        80 * chance(3 * i) + 9 * math.cos(turn + 2 * i))
  end
  return union(pieces)
end
