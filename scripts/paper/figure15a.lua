-- Figure 15(a): a thousand random NURBS shapes in one cel. Another number may be given:
--   celspan render scripts/paper/figure15a.lua -o a.png -- 100
local count = math.tointeger(tonumber(... or "1000"))
assert(count and count >= 1, "figure 15(a) takes a number of shapes, 1 or more")
return require "shapes".film("Figure 15(a)", count, "figure 15")
