-- Two exposures on one frame: light adds, alpha is clamped to 1.
local celspan = require "celspan"
return celspan.film { size = { 12, 4 }, frame = function()
  local function bar(x, texture)
    return celspan.rostrum { antialias = "none",
      celspan.cel { celspan.rect { x, 1, 6, 2, texture = texture } } }
  end
  return { { bar(1, "#f00"), 0.75 }, { bar(4, "#0ff"), 0.5 } }
end }
