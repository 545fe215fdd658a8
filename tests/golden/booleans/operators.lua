-- The five operators on the same translucent pair, side by side.
local celspan = require "celspan"
local function pair(x)
  return celspan.rect { x, 1, 5, 4, texture = "#ff000080" },
    celspan.rect { x + 2, 3, 5, 4, texture = "#0000ff80" }
end
return celspan.film { size = { 42, 8 }, frame = function()
  local list = {}
  for i, combine in ipairs {
    function(a, b) return a | b end, function(a, b) return a & b end,
    function(a, b) return a - b end,
    function(a, b) return a ~ b end, celspan.clip,
  } do
    list[i] = combine(pair(8 * i - 7))
  end
  return celspan.rostrum { antialias = "none", celspan.cel(list) }
end }
