-- The frog of scripts/pencil.lua in its leap, and the drawing of it in pencil, on punched paper.
local frog = require "pencil"

local scan = picture { file = "../../scripts/pencil/body.0005.png", box = { 0, 0, 780, 561 } }
-- Of the paper that is shown, in pixels of the scan.
local corners = { { 205, 14 }, { 585, 18 }, { 583, 450 }, { 203, 446 } }
local function sheet(fill, x, y)
  return polygon { fill = fill, table.unpack(corners) }:scale(1.22):rotate(6):translate(x, y)
end

local on_top = { sheet("#20343c", 582, 208):blur(14):fade(0.45), sheet(scan, 590, 196) }

return cut { frog, over = function() return on_top end }
