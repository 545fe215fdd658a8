-- What whole pixels cannot show: drawings that no tracing restores within half a pixel.
--
--   LUA_PATH='?.lua;;' LUA_CPATH=build/?.so \
--     lua5.4 tests/bench/trace_limit.lua [LAST [FIRST [STEPS]]]
--
-- Examines those drawings of trace_edges.lua whose edges have an error of more than half a pixel
-- after tracing a picture without antialiasing. For each, it searches for two other drawings that
-- look the same without antialiasing, pixel by pixel: the corners of its shapes, their control
-- points or the ends of their radii are moved one by one, in STEPS random steps (400), as long as
-- all pixels stay as they are and the two get no nearer to each other; the traced drawing is one of
-- the candidates if it has the same pixels. Where an edge of one is more than a pixel from the same
-- edge of the other, any tracing is more than half a pixel off for one of the two. Distances are
-- computed at 16 x 16 places a pixel, and the possible error of that is subtracted: the result is a
-- proof for the drawings found, and says nothing about the others.
local celspan = require "celspan"
local prng = require "tests.support.prng"
local traced = require "tests.support.traced"
local last, first, steps = tonumber(arg[1] or 30), tonumber(arg[2] or 1), tonumber(arg[3] or 400)
local PLACES = 16

local function drawn(shapes, points, make)
  local list = { shapes[1] }
  for i = 2, #shapes do list[i] = make[i](points[i]) end
  return celspan.union(list)
end

--- A copy of the points in which one point of one shape is moved by at most `most` pixels.
local function varied(random, points, count, most)
  local copy, at = {}, random:whole(2, count)
  for i = 2, count do copy[i] = points[i] end
  local k = random:whole(1, #points[at])
  copy[at] = { texture = points[at].texture, table.unpack(points[at]) }
  copy[at][k] = { points[at][k][1] + random:between(-most, most),
    points[at][k][2] + random:between(-most, most) }
  return copy
end

--- Searches for two drawings with the same pixels as the random drawing number `case`. Returns a
--- lower bound of the distance between them.
local function farthest_apart(case)
  local shapes, w, h, points, make = traced.shapes(case)
  local truth, random = celspan.union(shapes), prng.new(case)
  local pair, far = { points, points }, 0
  for _ = 1, steps do
    local which = random:whole(1, 2)
    local tried = varied(random, pair[which], #shapes, random:pick { 0.1, 0.3, 0.6 })
    local object = drawn(shapes, tried, make)
    if traced.changed(truth, object, w, h) == 0 then
      local apart = traced.apart(object, drawn(shapes, pair[3 - which], make), w, h, 4)
      if apart >= far then pair[which], far = tried, apart end
    end
  end
  local one, other = drawn(shapes, pair[1], make), drawn(shapes, pair[2], make)
  assert(traced.changed(one, other, w, h) == 0)
  return traced.apart(one, other, w, h, PLACES) - 1.5 / PLACES
end

local all, beyond = 0, 0
for case = first, last do
  local off, art, w, h, original = traced.retrace(case, "none")
  if off > 0.5 then
    local far = farthest_apart(case)
    if traced.changed(original, art, w, h) == 0 then
      far = math.max(far, traced.apart(original, art, w, h, PLACES) - 1.5 / PLACES)
    end
    all, beyond = all + 1, beyond + (far > 1 and 1 or 0)
    print(("drawing %4d: off %.3f; two with its pixels are %.3f apart%s"):format(case, off, far,
      far > 1 and ": no tracing is within half a pixel of both" or ""))
    io.flush()
  end
end
print(("%d of %d drawings are farther off than half a pixel; for %d none could be nearer")
  :format(all,
  last - first + 1, beyond))
