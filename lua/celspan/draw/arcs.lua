--- Arcs, for celspan.morph: a place that goes along the circle through three places.
--
--      . m .     A point goes from p to p + (q - p) w. On a straight way w is the share u, on an
--    p       q   arc it is a complex number. So what does not move stays, a limb turns about its
--                joint, and what only moves keeps its shape. Between places w goes by nearness.
local arcs = {}

--- The angle about the centre from p through m to q, with its sign; nil if no circle goes so.
function arcs.turn(p, m, q)
  local ax, ay, bx, by = m[1] - p[1], m[2] - p[2], q[1] - m[1], q[2] - m[2]
  local cross, dot = ax * by - ay * bx, ax * bx + ay * by
  if p[1] == q[1] and p[2] == q[2] or cross == 0 and dot <= 0 then return nil end
  return 2 * math.atan(cross, dot)
end

local function way(half, u)
  if math.abs(half) < 1e-6 then return u, 0 end
  local stretch, angle = math.sin(half * u) / math.sin(half), half * (u - 1)
  return stretch * math.cos(angle), stretch * math.sin(angle)
end

--- w at any point, as a function of its place in the first object.
--- places: { x, y, x, y, turn }, from where to where, and its angle.
function arcs.field(places, u)
  local list, is_bent = {}, false
  for _, place in ipairs(places) do
    if place[1] ~= place[3] or place[2] ~= place[4] then -- any w leaves a place that stays
      list[#list + 1] = { place[1], place[2], way(place[5] / 2, u) }
      is_bent = is_bent or place[5] ~= 0
    end
  end
  if not is_bent then return function() return u, 0 end end
  return function(x, y)
    local sum, real, imaginary = 0, 0, 0
    for _, at in ipairs(list) do
      local far = (x - at[1]) ^ 2 + (y - at[2]) ^ 2
      if far == 0 then return at[3], at[4] end
      sum, real, imaginary = sum + 1 / far, real + at[3] / far, imaginary + at[4] / far
    end
    return real / sum, imaginary / sum
  end
end

return arcs
