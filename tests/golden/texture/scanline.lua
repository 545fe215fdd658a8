-- A procedure's spans: flat, from one paint to another, several; cut by a circle.
local celspan = require "celspan"
return celspan.film { size = { 24, 8 }, frame = function()
  local rows = celspan.scanline { bounds = { 0, 0, 24, 8 }, spans = function(y)
    return { { 1 + y / 2, 7, "#f00" }, { 8, 14, "#000", "#fff" },
      { 15, 23, array = { "#f00", "#0f0", "#00f" } } }
  end }
  return celspan.rostrum { antialias = "none",
    celspan.cel { rows - celspan.circle { centre = { 12, 4 }, radius = 2.3 } } }
end }
