-- A floor of tiles in perspective, its horizon inside the frame.
local celspan = require "celspan"
return celspan.film { size = { 24, 14 }, frame = function()
  local tiles = {}
  for i = 0, 5 do
    for j = 0, 5 do
      tiles[#tiles + 1] = celspan.rect { 20 * i - 60, 4 + 10 * j, 20, 10,
                                         texture = (i + j) % 2 == 0 and "#222" or "#ddd" }
    end
  end
  local floor = celspan.union(tiles):transform { 1, 12, 0, 0, 4, 12, 0, 1, 1 }
  return celspan.rostrum { antialias = "none", celspan.cel { floor } }
end }
