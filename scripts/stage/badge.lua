--- A round badge, and a loaf of bread that steams in its middle.
local function disc(radius, paint) return circle { 240, 135, radius, fill = paint } end
local teeth = {}
for i = 0, 35 do
  teeth[i + 1] = circle { 240, 10, 11, fill = "#b5482f" }:rotate(10 * i, 240, 135)
end
local badge = union { union(teeth), disc(125, "#b5482f"), disc(87, "#f3e3c3"),
  disc(82, "#2f4b4a") }

local crust = path { fill = "#d98e4a", d = [[M176 160 C170 118 206 104 240 104 C274 104 310 118
  304 160 Q302 172 290 172 H190 Q178 172 176 160 Z]] }
local cuts = stroke { width = 7, cap = "round", fill = "#f6d29b",
  d = "M204 134 Q212 122 222 118 M232 136 Q240 122 252 117 M262 140 Q270 128 282 124" }
local shade = crust - crust:translate(-5, -9)

--- The loaf, with three lines of steam that rise.
local function loaf(f)
  local steam = {}
  for i = -1, 1 do
    local sway = 5 * math.sin(2 * math.pi * f.progress + 2 * i)
    steam[i + 2] = stroke { width = 5, cap = "round", degree = 3, fill = "#f3e3c3",
      points = { { 240 + 26 * i, 96 }, { 234 + 26 * i + sway, 86 }, { 246 + 26 * i - sway, 76 },
        { 240 + 26 * i + sway, 66 } } }
  end
  return union { crust, shade:paint "#b96d35", clip(cuts, crust), union(steam) }
end

return { badge = badge, loaf = loaf }
