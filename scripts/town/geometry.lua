-- The hand of geometry for windows of the town: isometric boxes, sectors of circles, round limbs.
--
--   local geometry = require "town.geometry"
--   local crate = geometry.box(0, 0, 0, 80, 80, 60, { "#ffe08a", "#ffb627", "#d9641a" })
local geometry = {}

local ACROSS, DOWN = 0.866, 0.5

--- Where a point of the room is in the picture: x goes down to the right, y up to the right, z up.
function geometry.at(x, y, z) return ACROSS * (x + y), DOWN * (x - y) - (z or 0) end

--- A flat face through points { x, y, z } of the room.
function geometry.face(points, fill)
  local list = { fill = fill }
  for i, p in ipairs(points) do list[i] = { geometry.at(p[1], p[2], p[3]) } end
  return polygon(list)
end

--- A box from its corner x, y, z at the left; tones: of its top, its left and its right side.
function geometry.box(x, y, z, along, away, high, tones)
  local x1, y1, z1 = x + along, y + away, z + high
  local face = geometry.face
  return face({ { x, y, z1 }, { x1, y, z1 }, { x1, y1, z1 }, { x, y1, z1 } }, tones[1])
    | face({ { x, y, z }, { x1, y, z }, { x1, y, z1 }, { x, y, z1 } }, tones[2])
    | face({ { x1, y, z }, { x1, y1, z }, { x1, y1, z1 }, { x1, y, z1 } }, tones[3])
end

--- Flat art laid on the left side of a box, its origin at a point of the room.
function geometry.on_left(art, x, y, z)
  local px, py = geometry.at(x, y, z)
  return art:transform { ACROSS, 0, px, DOWN, 1, py, 0, 0, 1 }
end

--- The same on the right side.
function geometry.on_right(art, x, y, z)
  local px, py = geometry.at(x, y, z)
  return art:transform { ACROSS, 0, px, -DOWN, 1, py, 0, 0, 1 }
end

--- A sector of a disc from one angle to another, in degrees clockwise from up.
function geometry.sector(x, y, r, from, to, fill)
  if to - from >= 360 then return circle { x, y, r, fill = fill } end
  local a, b = math.rad(from), math.rad(to)
  return path { fill = fill, d = ("M%g %g L%g %g A%g %g 0 %d 1 %g %g Z"):format(x, y,
    x + r * math.sin(a), y - r * math.cos(a), r, r, to - from > 180 and 1 or 0,
    x + r * math.sin(b), y - r * math.cos(b)) }
end

--- An arm or a leg through points { x, y }, with round ends and a smooth bend.
function geometry.limb(points, width, fill)
  return stroke { points = points, degree = math.min(2, #points - 1), width = width, cap = "round",
    fill = fill }
end

--- The item of a list of { frames, item } that is shown at a number from 0.
function geometry.held(list, number)
  for _, hold in ipairs(list) do
    if number < hold[1] then return hold[2], number end
    number = number - hold[1]
  end
  return list[#list][2], 0
end

return geometry
