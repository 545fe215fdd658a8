--- Inverse kinematics: the angles of a chain of bones whose end is to reach a point.
--
--        p2
--       o----o  end        bone k is a vector, turned by all angles up to its own:
--      /                   end = base + sum of turn(angle 1 + ... + angle k, bone k)
--     o  base
--
--   reach.solve(chain)   -> angles, distance
--
-- chain: bones = { { x, y, low, high, angle }, ... }: the vector of the bone at angle 0, the limits
-- of its angle and the angle to start from, in radians; target = { x, y } from the base;
-- side: 1 or -1, the sign of the bend that is preferred, or nil: that of the bones; pole: { x, y }
-- from the base: the bend nearest to this point is preferred.
--
-- INVARIANT: angles lie within their limits. One bone and two bones are solved in closed form: no
-- other angles come nearer. More bones: the nearest end that damped Gauss-Newton steps find from
-- several starts; without limits in the way, a target out of reach gets a straight chain.
local fields = require "celspan.fields"

local reach = {}

local pi, cos, sin, sqrt, atan = math.pi, math.cos, math.sin, math.sqrt, math.atan

--- Shares of the chain's length: if two bends differ by less than SAME, they count as one; the
--- search ends at TINY.
local SAME, TINY = 1e-9, 1e-12

local function turn(angle, x, y)
  local c, s = cos(angle), sin(angle)
  return c * x - s * y, s * x + c * y
end

--- The angle in the range low..high that is nearest to `angle` on the circle.
local function limited(angle, low, high)
  local middle = (low + high) / 2
  local near = middle + (angle - middle + pi) % (2 * pi) - pi
  return math.max(low, math.min(high, near))
end

--- The end of the chain for a list of angles.
local function end_of(bones, angles)
  local x, y, sum = 0, 0, 0
  for k, bone in ipairs(bones) do
    sum = sum + angles[k]
    local dx, dy = turn(sum, bone[1], bone[2])
    x, y = x + dx, y + dy
  end
  return x, y
end

local function distance_of(chain, angles)
  local x, y = end_of(chain.bones, angles)
  local dx, dy = chain.target[1] - x, chain.target[2] - y
  return sqrt(dx * dx + dy * dy)
end

--- The angle by which a vector must be turned so that it points at the target; `angle` if the
--- vector or the target has no direction.
local function aim(x, y, target_x, target_y, angle)
  if (x == 0 and y == 0) or (target_x == 0 and target_y == 0) then return angle end
  return atan(target_y, target_x) - atan(y, x)
end

-- ---------------------------------------------------------------- one bone, two bones

local function solve_one(chain)
  local bone = chain.bones[1]
  return { limited(aim(bone[1], bone[2], chain.target[1], chain.target[2], bone[5]),
                   bone[3], bone[4]) }
end

--- The angles of two bones that bend to one side (the sign of the cross product of the bones), by
--- the law of cosines. A target out of reach is replaced by the nearest one that can be reached.
local function bent(chain, side)
  local one, two = chain.bones[1], chain.bones[2]
  local a, b = sqrt(one[1] ^ 2 + one[2] ^ 2), sqrt(two[1] ^ 2 + two[2] ^ 2)
  local x, y = chain.target[1], chain.target[2]
  local d = sqrt(x * x + y * y)
  local span = math.max(math.abs(a - b), math.min(a + b, d))
  local corner = 0
  if a > 0 and span > 0 then
    corner = math.acos(math.max(-1, math.min(1, (a * a + span * span - b * b) / (2 * a * span))))
  end
  local way = d > 0 and atan(y, x) or one[5] + atan(one[2], one[1])
  local first = way - side * corner
  local second = aim(1, 0, cos(way) * span - a * cos(first), sin(way) * span - a * sin(first),
                     first)
  local angle = first - atan(one[2], one[1])
  return angle, second - atan(two[2], two[1]) - angle
end

--- Adds pairs of angles within the limits in which the first, or the second, is at one of its
--- limits.
local function add_limits(chain, candidates)
  local one, two = chain.bones[1], chain.bones[2]
  for side = 3, 4 do
    local angle = one[side]
    local x, y = turn(angle, one[1], one[2])
    local rx, ry = turn(-angle, chain.target[1] - x, chain.target[2] - y)
    candidates[#candidates + 1] = { angle,
      limited(aim(two[1], two[2], rx, ry, two[5]), two[3], two[4]) }
    local bx, by = turn(two[side], two[1], two[2])
    candidates[#candidates + 1] = {
      limited(aim(one[1] + bx, one[2] + by, chain.target[1], chain.target[2], one[5]),
              one[3], one[4]), two[side] }
  end
end

--- The side of the bend that the options of the chain demand.
local function side_of(chain)
  if chain.side then return chain.side end
  local one, two = chain.bones[1], chain.bones[2]
  local cross = one[1] * two[2] - one[2] * two[1]
  local size = sqrt((one[1] ^ 2 + one[2] ^ 2) * (two[1] ^ 2 + two[2] ^ 2))
  if math.abs(cross) > SAME * size then return cross > 0 and 1 or -1 end
  return two[3] + two[4] < 0 and -1 or 1
end

--- Which of the two sides has its joint nearer to the pole.
local function side_to(chain, pole)
  local best, least
  for side = -1, 1, 2 do
    local x, y = turn(bent(chain, side), chain.bones[1][1], chain.bones[1][2])
    local distance = (pole[1] - x) ^ 2 + (pole[2] - y) ^ 2
    if not least or distance < least then best, least = side, distance end
  end
  return best
end

local function solve_two(chain)
  local side = chain.pole and side_to(chain, chain.pole) or side_of(chain)
  local length = sqrt(chain.bones[1][1] ^ 2 + chain.bones[1][2] ^ 2)
    + sqrt(chain.bones[2][1] ^ 2 + chain.bones[2][2] ^ 2)
  local candidates = {}
  for _, one in ipairs { side, -side } do
    local angles = { bent(chain, one) }
    for k = 1, 2 do angles[k] = limited(angles[k], chain.bones[k][3], chain.bones[k][4]) end
    candidates[#candidates + 1] = angles
  end
  add_limits(chain, candidates)
  local best, least
  for _, angles in ipairs(candidates) do
    local distance = distance_of(chain, angles)
    if not least or distance < least - SAME * length then best, least = angles, distance end
  end
  return best
end

-- ---------------------------------------------------------------- more bones

--- The columns of the Jacobian, which say how the end moves with each angle; and the end.
local function slopes(bones, angles)
  local x, y, sum, joints = 0, 0, 0, {}
  for k, bone in ipairs(bones) do
    joints[k] = { x, y }
    sum = sum + angles[k]
    local dx, dy = turn(sum, bone[1], bone[2])
    x, y = x + dx, y + dy
  end
  for k, joint in ipairs(joints) do joints[k] = { joint[2] - y, x - joint[1] } end
  return joints, x, y
end

--- Whether a step would move an angle beyond its limit.
local function is_blocked(bone, angle, change)
  return change < 0 and angle <= bone[3] or change > 0 and angle >= bone[4]
end

--- A step J^T (J J^T + damping I)^-1 e of the angles that can still move.
local function step_of(bones, angles, columns, ex, ey, damping)
  local is_free, step = {}, {}
  for k = 1, #bones do is_free[k] = true end
  for _ = 1, #bones do
    local a, b, c = damping, 0, damping
    for k, column in ipairs(columns) do
      if is_free[k] then
        a, b, c = a + column[1] ^ 2, b + column[1] * column[2], c + column[2] ^ 2
      end
    end
    local determinant, is_new = a * c - b * b, false
    local ux, uy = (c * ex - b * ey) / determinant, (a * ey - b * ex) / determinant
    for k, column in ipairs(columns) do
      step[k] = is_free[k] and column[1] * ux + column[2] * uy or 0
      if is_free[k] and is_blocked(bones[k], angles[k], step[k]) then
        is_free[k], is_new = false, true
      end
    end
    if not is_new then break end
  end
  return step
end

local function moved(bones, angles, step)
  local result = {}
  for k, bone in ipairs(bones) do
    result[k] = math.max(bone[3], math.min(bone[4], angles[k] + step[k]))
  end
  return result
end

--- Levenberg-Marquardt steps from a start: the angles, and the remaining distance.
local function descend(chain, angles, length)
  local bones, damping = chain.bones, 0.01 * length * length
  local distance = distance_of(chain, angles)
  for _ = 1, 200 do
    if distance <= TINY * length or damping > 1e12 * length * length then break end
    local columns, x, y = slopes(bones, angles)
    local step = step_of(bones, angles, columns, chain.target[1] - x, chain.target[2] - y, damping)
    local other = moved(bones, angles, step)
    local left = distance_of(chain, other)
    if left < distance then
      angles, distance, damping = other, left, math.max(damping / 8, 1e-14 * length * length)
    else
      damping = damping * 4
    end
  end
  return angles, distance
end

--- The straight chain towards the target, if all limits allow it; otherwise nil.
local function straight(chain)
  local way, sum, angles = atan(chain.target[2], chain.target[1]), 0, {}
  for k, bone in ipairs(chain.bones) do
    local angle = way - atan(bone[2], bone[1]) - sum
    angles[k] = limited(angle, bone[3], bone[4])
    if math.abs((angles[k] - angle + pi) % (2 * pi) - pi) > SAME then return nil end
    sum = sum + angles[k]
  end
  return angles
end

--- Starts for the search: the given angles, bends to both sides, and angles between the limits.
local function starts_of(chain)
  local starts = { {} }
  for k, bone in ipairs(chain.bones) do starts[1][k] = limited(bone[5], bone[3], bone[4]) end
  local side = chain.side or 1
  for _, bend in ipairs { 0.2, -0.2, 0.8, -0.8, 1.6, -1.6 } do
    local angles = {}
    for k, bone in ipairs(chain.bones) do
      angles[k] = limited(k == 1 and bone[5] - side * bend * #chain.bones / 2 or side * bend,
                          bone[3], bone[4])
    end
    starts[#starts + 1] = angles
  end
  for share = 0, 4 do
    local even, other = {}, {}
    for k, bone in ipairs(chain.bones) do
      local low, high = math.max(bone[3], bone[5] - pi), math.min(bone[4], bone[5] + pi)
      local angle, opposite = low + (high - low) * share / 4, high + (low - high) * share / 4
      even[k] = limited(angle, bone[3], bone[4])
      other[k] = limited(k % 2 == 0 and opposite or angle, bone[3], bone[4])
    end
    starts[#starts + 1], starts[#starts + 2] = even, other
  end
  return starts
end

local function solve_many(chain)
  local length = 0
  for _, bone in ipairs(chain.bones) do length = length + sqrt(bone[1] ^ 2 + bone[2] ^ 2) end
  if sqrt(chain.target[1] ^ 2 + chain.target[2] ^ 2) >= length then
    local angles = straight(chain)
    if angles then return angles end
  end
  local best, least
  for _, start in ipairs(starts_of(chain)) do
    local angles, distance = descend(chain, start, length)
    if not least or distance < least - SAME * length then best, least = angles, distance end
    if least <= SAME * length then break end
  end
  return best
end

--- The angles that bring the end of a chain as near as possible to its target, and the remaining
--- distance.
---@param chain { bones: number[][], target: number[], side?: integer, pole?: number[] }
---@return number[] angles, number distance
function reach.solve(chain)
  local count = #chain.bones
  local angles = (count == 1 and solve_one or count == 2 and solve_two or solve_many)(chain)
  return angles, distance_of(chain, angles)
end

return fields.seal("reach", reach)
