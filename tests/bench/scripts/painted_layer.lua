-- One of nine layers for painted.lua: a plane of the demo film, with paint of every frequency on
-- it, so that neighbouring pixels differ, and clear where nothing is painted. Argument: its number,
-- 1 the farthest.
local celspan = require "celspan"
local demo = require "demo"

local number = tonumber((...))
local cels = { 1, 5, 7, 8, 9, 10, 11, 12, 16 }
local W, H = 1920, 1080

--- Grains from dark to light, the same in every run.
local function grain(seed)
  local bytes, state = {}, seed
  for i = 1, 256 * 256 do
    state = state * 16807 % 2147483647
    bytes[i] = string.char(160 + state % 96)
  end
  return celspan.picture { pixels = table.concat(bytes), size = { 256, 256 }, format = "grey8",
                           box = { 0, 0, 320, 320 }, wrap = "repeat", sampling = "bilinear" }
end

local plane = celspan.rostrum { demo:at(236)[1][1][cels[number]], size = { W, H } }
local paint = celspan.rect { 0, 0, W, H, texture = grain(number) }
local painted = celspan.group { plane, paint:blend "multiply" }

return celspan.film { size = { W, H }, frames = 1, frame = function()
  return celspan.rostrum { celspan.cel { celspan.matte(painted, plane) } }
end }
