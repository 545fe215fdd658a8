-- The paper's figure 11 at any size: three bands of colour, filtered. A film of 22 x 22 units, as
-- the paper's list has 22 pixels. Arguments: the radius in film units, the kernel.
local celspan = require "celspan"

local radius, kernel = ...
local bands = celspan.cel {
  defocus = { radius = tonumber(radius), kernel = kernel },
  celspan.rect { -200, -200, 207, 422, texture = "#c33" },
  celspan.rect { 7, -200, 9, 422, texture = "#3a3" },
  celspan.rect { 16, -200, 206, 422, texture = "#33c" },
}
return celspan.film { size = { 22, 22 }, frames = 1,
  frame = function() return celspan.rostrum { bands } end }
