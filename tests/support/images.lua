-- Images compared: celspan.pixels returns them.
local assert = require "luassert"

local images = {}

--- The greatest difference of two images of one size, in any channel.
function images.difference(a, b)
  assert.same({ a.width, a.height }, { b.width, b.height })
  local most = 0
  for y = 0, a.height - 1 do
    for x = 0, a.width - 1 do
      local p, q = { a:get(x, y) }, { b:get(x, y) }
      for c = 1, 4 do most = math.max(most, math.abs(p[c] - q[c])) end
    end
  end
  return most
end

--- A pixel is these four numbers, within a tolerance (1e-6).
function images.near(expected, image, x, y, tolerance)
  local got = { image:get(x, y) }
  for c = 1, 4 do
    assert.is_true(math.abs(got[c] - expected[c]) <= (tolerance or 1e-6),
      ("pixel %d, %d: %.7f %.7f %.7f %.7f instead of %.7f %.7f %.7f %.7f"):format(x, y, got[1],
        got[2], got[3], got[4], table.unpack(expected)))
  end
end

return images
