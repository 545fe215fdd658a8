-- A star that crosses itself, filled by both rules.
local celspan = require "celspan"
local function star(x, rule)
  return celspan.polygon { { x + 6, 0 }, { x + 9, 11 }, { x, 4 }, { x + 12, 4 }, { x + 3, 11 },
    rule = rule }
end
return celspan.film { size = { 26, 12 }, frame = function()
  return celspan.rostrum { antialias = "none",
    celspan.cel { star(0, "nonzero"), star(13, "evenodd") } }
end }
