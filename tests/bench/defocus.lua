-- Flat art for the defocus benchmark: a hundred closed B-splines on one cel, out of focus.
-- Arguments: the radius in film units (the film is 1024 wide), the kernel.
local celspan = require "celspan"

local radius, kernel = ...
local state = 12345
local function random()
  state = (state * 1103515245 + 12345) % 2147483648
  return state / 2147483648
end

local art = { defocus = { radius = tonumber(radius) or 0, kernel = kernel or "gaussian" } }
for i = 1, 100 do
  local points = {}
  for k = 1, 4 do points[k] = { 1024 * random(), 1024 * random() } end
  local paint = celspan.rgb(random(), random(), random(), 0.2 + 0.8 * random())
  art[i] = celspan.nurbs { points = points, texture = paint }
end

return celspan.film { size = { 1024, 1024 }, frames = 1,
  frame = function() return celspan.rostrum { celspan.cel(art), back = "#fff" } end }
