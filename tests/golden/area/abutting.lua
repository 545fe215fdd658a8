-- Black wedges that meet, on white: inside the fan every pixel is black.
local celspan = require "celspan"
return celspan.film { size = { 12, 10 }, frame = function()
  local rim, wedges = { { 1, 1 }, { 6, 0.5 }, { 11, 2 }, { 11.5, 7 }, { 8, 9.5 }, { 1.5, 8 } }, {}
  for i, point in ipairs(rim) do
    wedges[i] = celspan.triangle { { 5.3, 4.7 }, point, rim[i % #rim + 1], texture = "#000" }
  end
  return celspan.rostrum { back = "#fff", celspan.cel(wedges) }
end }
