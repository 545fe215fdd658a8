-- A telescope that turns from the sky to us, and the eye behind its glass.
local ink = require "town.silhouette"

local telescope = {}

local function between(from, to, share) return from + (to - from) * share end

--- A tube on its pivot (x, y), in a round window of 600 units. degrees: where it points, clockwise
--- from the right; toward: 0 seen from its side, to 1, when its glass fills the window. Returns the
--- tube, and its glass with the glass's place and radius.
function telescope.tube(x, y, degrees, toward)
  local c, s = math.cos(math.rad(degrees)), math.sin(math.rad(degrees))
  local fx, fy = between(x + 190 * c, 300, toward), between(y + 190 * s, 296, toward)
  local bx, by = between(x - 140 * c, 300, toward), between(y - 140 * s, 300, toward)
  local wide, narrow = between(58, 250, toward ^ 1.4), between(24, 40, toward)
  local flat = math.max(0.2, math.sin(math.pi / 2 * toward))
  local function ring(radius)
    return ellipse { 0, 0, radius * flat, radius }:rotate(degrees):translate(fx, fy)
  end
  local tube = polygon { { bx + s * narrow, by - c * narrow }, { fx + s * wide, fy - c * wide },
    { fx - s * wide, fy + c * wide }, { bx - s * narrow, by + c * narrow } }
  local band = polygon { { between(fx, bx, 0.2) + s * wide, between(fy, by, 0.2) - c * wide },
    { between(fx, bx, 0.25) + s * wide, between(fy, by, 0.25) - c * wide },
    { between(fx, bx, 0.25) - s * wide, between(fy, by, 0.25) + c * wide },
    { between(fx, bx, 0.2) - s * wide, between(fy, by, 0.2) + c * wide } }
  return (tube - band) | ring(wide), ring(0.86 * wide)
end

--- An enormous eye about (300, 296): its white with the lashes, its iris, and its pupil. open: 0 to
--- 1 and more; look: -1..1 to the right; wide: how large the pupil is, about 1.
function telescope.eye(open, look, wide)
  local lid, low = -150 * open + 30, 130 * math.min(open, 1) + 20
  local almond = path { d = ("M110 300 C180 %g 240 %g 300 %g C360 %g 420 %g 490 300 C430 %g 370 %g "
    .. "300 %g C230 %g 170 %g 110 300 Z"):format(300 + lid * 0.9, 300 + lid, 300 + lid, 300 + lid,
    300 + lid * 0.9, 300 + low * 0.8, 300 + low, 300 + low, 300 + low, 300 + low * 0.8) }
  local lashes = {}
  for i = -2, 2 do
    local foot, tip = 300 + lid - 8 + 9 * i * i * open, open > 0.3 and -44 or 56
    if open <= 0.3 then foot = 340 - 7 * i * i end
    lashes[i + 3] = path { d = ("M%g %g L%g %g L%g %g Z"):format(300 + 62 * i - 9, foot,
      300 + 78 * i, foot + tip, 300 + 62 * i + 9, foot) }
  end
  local x = 300 + 84 * look
  local iris, pupil = circle { x, 296, 84 }, circle { x, 296, 40 * wide }
  local white = almond | union(lashes)
  if open < 0.3 then return white, union {}, union {} end
  return white, iris & almond, (pupil - circle { x + 26, 268, 15 }) & almond
end

local FACE = path { d = "M-60 70 C-66 20 -84 -10 -78 -60 C-72 -124 60 -130 72 -60 "
  .. "C74 -44 72 -30 72 -24 L104 4 C102 16 88 18 74 16 L76 40 C70 62 40 66 20 62 L26 90 Z" }
local BUST = path { d = "M-150 420 C-150 240 -130 120 -60 92 L30 84 C96 110 126 250 130 420 Z" }
local WEARS = {
  girl = path { d = "M-84 -40 C-92 -150 80 -150 82 -60 C40 -90 -20 -84 -40 -40 Z" }
    | path { d = "M-70 -70 C-120 -110 -180 -60 -170 20 C-150 0 -120 -10 -66 -30 Z" },
  man = path { d = "M-96 -40 C-60 -74 60 -84 104 -60 L70 -86 C60 -150 20 -210 -40 -240 "
    .. "C-30 -180 -60 -110 -70 -76 Z" } | path { d = "M6 40 C40 30 70 34 78 20 "
    .. "C96 60 70 130 20 150 C0 110 -10 70 6 40 Z" },
}

--- Somebody at a window who looks to the right through a telescope: "girl" or "man", the middle of
--- the head at (0, 0). long: of the tube; wrong: whether its wide end is at the eye; wave: degrees
--- of the other arm, which is not seen without.
function telescope.watcher(who, long, wrong, wave)
  local near, far = wrong and 38 or 17, wrong and 17 or 38
  local function piece(from, to, a, b)
    return polygon { { from, -a }, { to, -b }, { to, b }, { from, a } }
  end
  local third, step = long / 3, (far - near) / 3
  local tube = piece(0, third, near, near + step / 2)
    | piece(third - 4, 2 * third, near + step, near + 1.5 * step)
    | piece(2 * third - 4, long, near + 2 * step, far)
  local shape = BUST | FACE | WEARS[who] | tube:rotate(-8):translate(62, -16)
    | ink.limb({ 40, 160, 60 }, { 150, 190, 50 }, { 62 + 0.5 * long, 6 - 0.07 * long, 40 })
  if wave then
    local x, radians = -126 + 0.6 * wave, math.rad(wave)
    local elbow = { x - 100 * math.sin(radians), -60 + 100 * math.cos(radians), 46 }
    shape = shape | ink.hand():scale(0.9):rotate(wave):translate(x, -60)
      | ink.limb({ -104, 200, 70 }, { elbow[1] - 6, 110, 56 }, elbow)
  end
  return shape
end

return telescope
