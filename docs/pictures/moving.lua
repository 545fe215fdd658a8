-- The moving picture of the front page: frames of the demo film, from the folder of demo.####.png
-- in the argument. It begins with the last frame, held, which dissolves into the first, so that it
-- loops without a jump, and is still where it shows most.
local celspan = require "celspan"

local folder = ...
local FIRST, STEP, COUNT = 1, 2, 120 -- frames of the film that were rendered
local HOLD, DISSOLVE = 12, 12

local function exposure(index, weight)
  local name = ("%s/demo.%04d.png"):format(folder, FIRST + STEP * index)
  local picture = celspan.image { file = name, w = 640, h = 360 }
  return { celspan.rostrum { celspan.cel { picture } }, weight }
end

return celspan.film {
  title = "The lamplighter, round and round", size = { 640, 360 }, fps = 12, frames = HOLD + COUNT,
  frame = function(f)
    local index, last = f.index - HOLD, COUNT - 1
    if index < 0 then return { exposure(last, 1) } end
    local come = math.min(1, (index + 1) / (DISSOLVE + 1))
    if come == 1 then return { exposure(index, 1) } end
    return { exposure(index, come), exposure(last, 1 - come) }
  end,
}
