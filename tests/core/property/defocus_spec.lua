-- Defocused cels of pictures and gradients, compared with sums of many probes of the same cel
-- without defocus: at every radius from a twentieth of a pixel up, rotated and enlarged.
local celspan = require "celspan"
local pieces = require "tests.support.pieces"

local SIDE, FILM = 40, { 44, 44 }
local file, folder

setup(function() file, folder = pieces.draw({ SIDE, SIDE }, 120) end)

teardown(function() pieces.remove(folder) end)

--- The kernel's weight at an offset.
local weights = {
  gaussian = function(x, y, r)
    local square = x * x + y * y
    return square <= 4 * r * r and math.exp(-2 * square / (r * r)) or 0
  end,
  box = function() return 1 end,
  disc = function(x, y, r) return x * x + y * y <= r * r and 1 or 0 end,
}

--- The mean of n by n probes under the kernel around a point of the film.
local function convolve(rostrum, kernel, radius, x, y, n)
  local reach = kernel == "gaussian" and 2 * radius or radius
  local sum, total = { 0, 0, 0, 0 }, 0
  for j = 0, n - 1 do
    for i = 0, n - 1 do
      local dx, dy = ((i + 0.5) * 2 / n - 1) * reach, ((j + 0.5) * 2 / n - 1) * reach
      local weight = weights[kernel](dx, dy, radius)
      if weight > 0 then
        local colour = { celspan.probe(rostrum, x + dx, y + dy, { film = FILM }) }
        for c = 1, 4 do sum[c] = sum[c] + weight * colour[c] end
        total = total + weight
      end
    end
  end
  for c = 1, 4 do sum[c] = sum[c] / total end
  return sum
end

local points = { { 20, 20 }, { 17, 23 }, { 24, 18 }, { 22, 25 }, { 19, 16 } }

--- Compares the pixels at `points` of a defocused cel; returns the difference from the sharp one.
local function compare(art, kernel, radius, antialias, n)
  local where = ("%s of radius %g under %s"):format(kernel, radius, antialias)
  local sharp = celspan.rostrum { celspan.cel { art }, antialias = antialias }
  local cel = celspan.cel { art, defocus = { radius = radius, kernel = kernel } }
  local soft = celspan.rostrum { cel, antialias = antialias }
  local image = assert(celspan.pixels(soft, { size = FILM }))
  local before = assert(celspan.pixels(sharp, { size = FILM }))
  -- Below a fifth of a pixel a kink of a hard picture may lie between the summed cells.
  local tolerance = radius < 0.2 and 0.008 or 0.004
  local change = 0
  for _, at in ipairs(points) do
    local want = convolve(sharp, kernel, radius, at[1] + 0.5, at[2] + 0.5, n)
    local got, was = { image:get(at[1], at[2]) }, { before:get(at[1], at[2]) }
    for c = 1, 4 do
      assert.is_true(math.abs(want[c] - got[c]) < tolerance,
                     ("%s, pixel %d, %d: channel %d is %.4f, should be %.4f"):format(
                       where, at[1], at[2], c, got[c], want[c]))
      change = math.max(change, math.abs(got[c] - was[c]))
    end
  end
  return change
end

describe("a defocused picture", function()
  local placements = {
    { "as it is", function(art) return art end },
    { "turned", function(art) return art:rotate(20, 22, 22) end },
    { "enlarged", function(art) return art:scale(1.7):translate(-14, -15) end },
  }
  for _, placement in ipairs(placements) do
    for _, kernel in ipairs { "gaussian", "box", "disc" } do
      it(("is the mean under the kernel: %s, %s"):format(kernel, placement[1]), function()
        local art = placement[2](celspan.image { file = file, x = 2.3, y = 1.6 })
        for _, radius in ipairs { 0.05, 0.2, 0.45, 1, 1.5, 2.4, 4 } do
          for _, antialias in ipairs { "none", "area" } do
            compare(art, kernel, radius, antialias, radius < 1 and 24 or 48)
          end
        end
      end)
    end
  end

  it("is visibly softer at a radius of one pixel", function()
    local art = celspan.image { file = file, x = 2, y = 2 }
    for _, kernel in ipairs { "gaussian", "box", "disc" } do
      assert.is_true(compare(art, kernel, 1, "area", 48) > 0.05)
    end
  end)
end)

describe("a defocused gradient", function()
  it("is the mean under the kernel", function()
    local ramp = celspan.linear { from = { 15, 12 }, to = { 25, 24 },
                                  { 0, "#f00" }, { 0.5, "#fff" }, { 1, "#0044ff80" } }
    local art = celspan.rect { 3, 2, 38, 38, texture = ramp }:rotate(10, 22, 22)
    for _, kernel in ipairs { "gaussian", "box", "disc" } do
      for _, radius in ipairs { 0.1, 0.6, 1, 1.9, 3.3 } do
        compare(art, kernel, radius, "none", 40)
        compare(art, kernel, radius, "area", 40)
      end
    end
  end)
end)
