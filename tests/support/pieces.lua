-- A picture of random rectangles with hard edges, some of them translucent: a PNG in a folder of
-- its own.
local celspan = require "celspan"
local prng = require "tests.support.prng"

local pieces = {}

--- Draws `count` rectangles at `size`. Returns the file and its folder, for pieces.remove.
function pieces.draw(size, count)
  local folder = os.tmpname()
  os.remove(folder)
  assert(os.execute("mkdir " .. folder))
  local random, list, file = prng.new(5), {}, folder .. "/picture.png"
  for _ = 1, count do
    list[#list + 1] = celspan.rect {
      random:whole(-2, size[1]), random:whole(-2, size[2]), random:whole(1, 8), random:whole(1, 8),
      texture = ("#%06x%02x"):format(random:whole(0, 0xffffff), random:pick { 255, 255, 128 }) }
  end
  assert(celspan.render(celspan.rostrum { celspan.cel(list) }, file, { size = size }))
  return file, folder
end

function pieces.remove(folder) os.execute("rm -rf " .. folder) end

return pieces
