-- Triangle, linear and radial gradients; a translucent one over another is cut in parts.
local celspan = require "celspan"
return celspan.film { size = { 40, 8 }, frame = function()
  local ramp = celspan.gradient { { 0, 0, "#f00" }, { 12, 0, "#0f0" }, { 0, 8, "#00f" } }
  local fade = celspan.linear { from = { 13, 0 }, to = { 26, 0 }, { 0, "#ffffff00" },
    { 0.5, "#fff" },
                                { 0.5, "#000" }, { 1, "#00000000" } }
  local glow = celspan.radial { centre = { 33, 4 }, radius = 6, { 0, "#fff" }, { 1, "#ff800000" } }
  return celspan.rostrum { antialias = "none", back = { 0, 0, 0.25, 1 },
    celspan.cel { celspan.rect { 0, 0, 12, 8, texture = ramp },
      celspan.rect { 13, 1, 13, 6, texture = fade },
                  celspan.rect { 27, 0, 12, 8, texture = glow } },
    celspan.cel {
      celspan.rect { 6, 3, 28, 2, texture = celspan.linear { from = { 6, 0 }, to = { 34, 0 },
                                                                         { 0, "#00ff00" },
                                                                         { 1, "#00ff0000" } } } } }
end }
