--- The parts of two shots on the sides of an edge that moves over the frame, for the transitions of
--- celspan.cut.
--
--   first   |aaaaaaa/bbbb|   second      low, high: the places between which a soft edge lies;
--           |aaaaaa/bbbbb|               both shots add up to one there
local celspan = require "celspan"

local edges = {}

--- The exposures of the visible parts of two shots; one shot may be nil. The light of the parts
--- adds up, so one exposure is enough, but shots with different antialiasing need one exposure
--- each.
function edges.together(a, b, seen_of_a, seen_of_b)
  local function show(shot, art)
    return { celspan.rostrum { antialias = shot.antialias, celspan.cel { art } }, 1 }
  end
  if not (a and b) then return { show(a or b, seen_of_a or seen_of_b) } end
  if a.antialias ~= b.antialias then return { show(a, seen_of_a), show(b, seen_of_b) } end
  return { show(a, celspan.group { seen_of_a, seen_of_b:blend "add", isolate = true }) }
end

--- White with this alpha: the share of a shot that is visible at a place.
local function seen(share) return celspan.rgb("#fff", share) end

--- A shot that is visible where a texture is opaque. The texture covers the whole frame, so both
--- shots have the same edges and add up to one.
local function softly(shot, size, shade)
  return celspan.matte(shot, celspan.rect { 0, 0, size[1], size[2], texture = shade })
end

--- The area of the plane on one side of a line: where x cos + y sin is at most `place`, or at least
--- `place` if the sign is -1. reach: longer than the frame's diagonal.
local function half_plane(cos, sin, place, sign, reach)
  local x, y = cos * place, sin * place
  local dx, dy, far = -sin * reach, cos * reach, sign * reach
  return celspan.polygon { { x + dx, y + dy }, { x - dx, y - dy },
    { x - dx - cos * far, y - dy - sin * far }, { x + dx - cos * far, y + dy - sin * far } }
end

--- The places `low` and `high` between which the edge of a wipe lies. Up to `low` only shot b is
--- visible, and from `high` on only shot a.
function edges.wipe(cos, sin, softness, u, size)
  local least, most = math.huge, -math.huge
  for _, corner in ipairs { { 0, 0 }, { size[1], 0 }, { 0, size[2] }, size } do
    local place = corner[1] * cos + corner[2] * sin
    least, most = math.min(least, place), math.max(most, place)
  end
  local soft = softness * (most - least)
  local high = least + u * (most - least + soft)
  return high - soft, high
end

--- The part of a shot on its side of the edge of a wipe.
function edges.beside(shot, cos, sin, low, high, size, is_second)
  if high <= low then
    local reach = 4 * (size[1] + size[2])
    return celspan.clip(shot, half_plane(cos, sin, low, is_second and 1 or -1, reach))
  end
  return softly(shot, size, celspan.linear {
    from = { cos * low, sin * low }, to = { cos * high, sin * high },
    { 0, seen(is_second and 1 or 0) }, { 1, seen(is_second and 0 or 1) } })
end

--- The radii of the edge of an iris, in the form of edges.wipe.
function edges.iris(centre, softness, u, size)
  local most = 0
  for _, corner in ipairs { { 0, 0 }, { size[1], 0 }, { 0, size[2] }, size } do
    local dx, dy = corner[1] - centre[1], corner[2] - centre[2]
    most = math.max(most, math.sqrt(dx * dx + dy * dy))
  end
  local soft = softness * most
  local high = u * (most + soft)
  return high - soft, high
end

--- How much of one of the shots is visible around a soft circle.
local function iris_shade(centre, low, high, is_second)
  local inner = math.min(1, high / (high - low))
  local function shade(share) return seen(is_second and share or 1 - share) end
  return celspan.radial { centre = centre, radius = high, { 0, shade(inner) },
    { math.max(0, low) / high, shade(inner) }, { 1, shade(0) } }
end

--- The part of a shot on its side of the edge of an iris.
function edges.around(shot, centre, low, high, size, is_second)
  if high > low then return softly(shot, size, iris_shade(centre, low, high, is_second)) end
  local disc = celspan.circle { centre = centre, radius = high }
  return is_second and celspan.clip(shot, disc) or celspan.difference { shot, disc }
end

return require "celspan.fields".seal("edges", edges)
