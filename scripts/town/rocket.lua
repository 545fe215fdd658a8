-- A rocket: a box of cardboard with fins, art on its two sides, and a pyramid as its nose.
local geometry = require "town.geometry"

local rocket = {}

local SIDE, HIGH = 150, 180

--- The nose, the middle of its foot at 0, 0, in the colours of its left and its right side.
function rocket.nose(left, right)
  return polygon { { -130, 0 }, { 0, 75 }, { 0, -125 }, fill = left }
    | polygon { { 130, 0 }, { 0, 75 }, { 0, -125 }, fill = right }
end

--- The box, its left corner at 0, 0; its foot has its middle at 130, 0, its top at 130, -180.
--- tones: of top, left, right; fins: left, right; left, right: art about the middle of a side.
function rocket.box(fields)
  local fins = polygon { { 0, -100 }, { 0, 2 }, { -62, 34 }, { -62, -30 }, fill = fields.fins[1] }
    | polygon { { 260, -100 }, { 260, 2 }, { 322, 34 }, { 322, -30 }, fill = fields.fins[2] }
  return fins | geometry.box(0, 0, 0, SIDE, SIDE, HIGH, fields.tones)
    | geometry.on_left(fields.left, 75, 0, 92) | geometry.on_right(fields.right, SIDE, 75, 96)
end

return rocket
