-- Images compared: celspan.pixels returns them.
local assert = require "luassert"
local celspan = require "celspan"

local images = {}

--- Objects in one cel, in a film of w by h units and as many pixels. options: those of
--- celspan.pixels.
function images.of(objects, w, h, options)
  local all = { size = { w, h }, film = { w, h } }
  for name, value in pairs(options or {}) do all[name] = value end
  return assert(celspan.pixels(celspan.rostrum { celspan.cel(objects) }, all))
end

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

--- Two images differ by no more than a tolerance.
function images.alike(tolerance, a, b)
  local most = images.difference(a, b)
  assert.is_true(most <= tolerance, ("they differ by %.6f"):format(most))
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
