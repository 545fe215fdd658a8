-- The moving picture of the front page: frames of Little One, from the folder of film.####.png in
-- the argument. The last ones dissolve into the first ones, so that it loops without a jump.

local folder = ...
local FIRST, STEP, COUNT = 397, 2, 96 -- frames of the film that were rendered
local DISSOLVE = 8

local function exposure(index, weight)
  local name = ("%s/film.%04d.png"):format(folder, FIRST + STEP * index)
  local picture = image { file = name, w = 640, h = 360 }
  return { rostrum { cel { picture } }, weight }
end

return film {
  title = "Little One, round and round", size = { 640, 360 }, fps = 12, frames = COUNT - DISSOLVE,
  frame = function(f)
    local index = f.index + DISSOLVE -- the first ones are seen at the end
    local left = COUNT - index
    if left > DISSOLVE then return { exposure(index, 1) } end
    local share = left / (DISSOLVE + 1)
    return { exposure(index, share), exposure(DISSOLVE - left, 1 - share) }
  end,
}
