-- The frog prince of pencil.lua, as lines of a pencil: a table of points for each line, in pixels
-- of a clean scan. Black is what is painted, and blue helps to construct. eyes.lua has pupils and
-- lids.
local frog = {}

--- Points on the way through some places, as of a hand that slows down at none of them.
local function through(places, is_closed)
  local points, count = {}, #places
  local function at(i)
    if is_closed then return places[(i - 1) % count + 1] end
    return places[math.max(1, math.min(count, i))]
  end
  for i = 1, is_closed and count or count - 1 do
    local a, b, c, d = at(i - 1), at(i), at(i + 1), at(i + 2)
    for step = 0, 7 do
      local u = step / 8
      local point = {}
      for k = 1, 2 do
        point[k] = 0.5 * (2 * b[k] + (c[k] - a[k]) * u + (2 * a[k] - 5 * b[k]
          + 4 * c[k] - d[k]) * u ^ 2
          + (3 * b[k] - a[k] - 3 * c[k] + d[k]) * u ^ 3)
      end
      points[#points + 1] = point
    end
  end
  points[#points + 1] = is_closed and points[1] or places[count]
  return points
end

local function ring(x, y, rx, ry, turn)
  local places, c, s = {}, math.cos(turn or 0), math.sin(turn or 0)
  for i = 0, 9 do
    local a = math.pi * i / 5
    local u, v = rx * math.cos(a), ry * math.sin(a)
    places[i + 1] = { x + c * u - s * v, y + s * u + c * v }
  end
  return through(places, true)
end

-- The outline of the right half, from below: shares of half the width and of the height; then the
-- bulge around an eye, by its angles.
local half = { { 0.5, -0.01 }, { 0.86, 0.05 }, { 1.02, 0.27 }, { 0.98, 0.5 } }
local around_eye, EYE, BULGE = { 0.05, 0.8, 1.57, 2.3, 2.95 }, { 0.56, 0.86 }, 31

--- The lines of an eye: a ring; or the arc of a smile, or two lines that meet, if it is shut.
local function eye(kind, x, y, r, side)
  if kind == "happy" then
    return through { { x - 17, y + 4 }, { x - 9, y - 5 }, { x + 1, y - 8 }, { x + 11, y - 5 },
      { x + 18, y + 4 } }
  elseif kind == "tight" then
    return { { x + 15 * side, y - 13 }, { x + 2 * side, y - 6 }, { x - 13 * side, y + 1 },
      { x + 2 * side, y + 7 }, { x + 15 * side, y + 13 } }
  end
  return ring(x, y, r * 0.9, r)
end

--- The lines of a pose: x, y between its feet, width, height, lean (how far its top is to the
--- right), bulge (how much wider it is below than above), cheeks, eyes ("open", "happy", "tight"),
--- the size of an eye, mouth, how high its belly is, and its limbs, relative to x, y.
function frog.body(pose)
  local list = {}
  local function place(u, v)
    local wide = 1 + (pose.bulge or 0) * (0.4 - v)
    return { pose.x + u * pose.width / 2 * wide + pose.lean * v * v, pose.y - v * pose.height }
  end
  local function add(pencil, points) list[#list + 1] = { pencil = pencil, points = points } end

  local places, size, cheeks = {}, pose.eye or 1, pose.cheeks or 0
  local function around(side, angle)
    local x, y = table.unpack(place(EYE[1] * side, EYE[2]))
    places[#places + 1] = { x + side * BULGE * size * math.cos(angle),
      y - BULGE * size * math.sin(angle) }
  end
  local function flank(side, i)
    local u, v = table.unpack(half[i])
    places[#places + 1] = place(side * (u + (i == #half and cheeks or 0)), v)
  end
  for i = 1, #half do flank(1, i) end
  for i = 1, #around_eye do around(1, around_eye[i]) end
  places[#places + 1] = place(0.1, 0.82)
  places[#places + 1] = place(-0.1, 0.82)
  for i = #around_eye, 1, -1 do around(-1, around_eye[i]) end
  for i = #half, 1, -1 do flank(-1, i) end
  add("black", through(places, true))

  for _, side in ipairs { -1, 1 } do
    local at = place(EYE[1] * side, EYE[2])
    add("black", eye(pose.eyes, at[1], at[2], size * 24, side))
  end

  local mouth = {}
  for i, m in ipairs(pose.mouth) do mouth[i] = place(m[1], m[2]) end
  add("black", through(mouth, pose.mouth.closed))
  -- The belly ends short of the outline: paint must not run out through these gaps.
  local low, high = 5.5 / pose.height, pose.belly or 0.38
  add("black", through { place(-0.6, low), place(-0.56, 0.53 * high), place(-0.3, 0.9 * high),
    place(0, high), place(0.3, 0.9 * high), place(0.56, 0.53 * high), place(0.6, low) })

  add("blue", ring(pose.x + pose.lean * 0.2, pose.y - 0.42 * pose.height, pose.width * 0.53,
    pose.height * 0.47))
  local foot, top = place(0, -0.1), place(0, 1.12)
  add("blue", { foot, place(0, 0.5), top })
  return list
end

-- ---------------------------------------------------------------- limbs

--- The lines of legs and arms, all closed: they lie behind the body.
function frog.legs(pose)
  local list = {}
  for i, limb in ipairs(pose.limbs) do
    local places = {}
    for k, p in ipairs(limb) do places[k] = { pose.x + p[1], pose.y + p[2] } end
    list[i] = { pencil = "black", points = through(places, true) }
  end
  return list
end

local function mirrored(limb)
  local other = {}
  for i, p in ipairs(limb) do other[i] = { -p[1], p[2] } end
  return other
end

--- A leg that is folded: thigh, knee and a foot of three toes.
local function folded(w, h)
  return { { 0.3 * w, -0.06 * h }, { 0.42 * w, -0.4 * h }, { 0.56 * w, -0.46 * h }, { 0.65 * w,
    -0.3 * h },
    { 0.6 * w, -0.1 * h }, { 0.68 * w, -7 }, { 0.78 * w, 0 }, { 0.73 * w, 6 }, { 0.67 * w, 4 },
    { 0.63 * w, 11 }, { 0.55 * w, 6 }, { 0.49 * w, 11 }, { 0.4 * w, 5 } }
end

--- A hand below the belly.
local function hand(w)
  return { { 0.08 * w, -22 }, { 0.24 * w, -22 }, { 0.27 * w, 2 }, { 0.24 * w, 14 }, { 0.2 * w, 8 },
    { 0.16 * w, 17 }, { 0.12 * w, 8 }, { 0.07 * w, 13 }, { 0.05 * w, 1 } }
end

--- A leg that hangs down by `long`, and a foot that points away.
local function hanging(w, long, out)
  return { { 0.14 * w, -24 }, { 0.36 * w, -26 }, { 0.4 * w, 0.3 * long },
    { 0.31 * w + out * 0.5, 0.68 * long },
    { 0.36 * w + out, 0.86 * long }, { 0.44 * w + out * 1.4, long }, { 0.34 * w + out * 1.3,
      1.02 * long },
    { 0.33 * w + out * 1.2, 1.14 * long }, { 0.27 * w + out, 1.05 * long },
    { 0.22 * w + out * 0.7, 1.12 * long }, { 0.2 * w + out * 0.5, 0.9 * long },
    { 0.18 * w + out * 0.3, 0.68 * long }, { 0.17 * w, 0.3 * long } }
end

--- An arm that is stretched to (x, y), from the shoulder at (sx, sy).
local function reaching(sx, sy, x, y)
  local dx, dy = x - sx, y - sy
  local l = math.sqrt(dx * dx + dy * dy)
  local nx, ny = -dy / l, dx / l
  local function at(u, v) return { sx + dx * u + nx * v, sy + dy * u + ny * v } end
  return { at(-0.1, -12), at(0.5, -9), at(0.8, -9), at(0.95, -15), at(1.06, -9), at(1.0, -5),
    at(1.18, 0), at(1.0, 5), at(1.06, 10), at(0.93, 14), at(0.8, 9), at(0.5, 9), at(-0.1, 12) }
end

local function pair(limb) return mirrored(limb), limb end

local function sitting(w, h)
  local a, b = pair(folded(w, h))
  local c, d = pair(hand(w))
  return { a, b, c, d }
end

-- ---------------------------------------------------------------- the poses

local smile = { { -0.62, 0.58 }, { -0.4, 0.49 }, { 0, 0.46 }, { 0.4, 0.49 }, { 0.62, 0.58 } }
local tight = { { -0.6, 0.5 }, { -0.3, 0.485 }, { 0, 0.48 }, { 0.3, 0.485 }, { 0.6, 0.5 } }
local gape = { { -0.46, 0.63 }, { 0, 0.68 }, { 0.46, 0.63 }, { 0.4, 0.5 }, { 0, 0.43 },
  { -0.4, 0.5 }, closed = true }
local smug = { { -0.2, 0.5 }, { -0.08, 0.475 }, { 0.06, 0.475 }, { 0.24, 0.53 } }
local flat = { { -0.3, 0.475 }, { -0.1, 0.49 }, { 0.1, 0.485 }, { 0.3, 0.46 } }

local purse = { { -0.26, 0.5 }, { -0.1, 0.525 }, { 0.08, 0.5 }, { 0.26, 0.53 } }
local doubt = { { -0.26, 0.485 }, { -0.08, 0.48 }, { 0.1, 0.48 }, { 0.28, 0.5 } }

local function legs(w, long, out, lift)
  local a, b = pair(hanging(w, long, out))
  return { a, b, reaching(-0.38 * w, -lift * 0.36, -0.78 * w, -lift * 0.72),
    reaching(0.38 * w, -lift * 0.42, 0.72 * w, -lift * 1.02) }
end

--- Legs that push off, and arms that stay behind.
local function pushing(w, long, h)
  local a, b = pair(hanging(w, long, 6))
  local c, d = pair(reaching(0.42 * w, -0.36 * h, 0.7 * w, -0.04 * h))
  return { a, b, c, d }
end

-- A pose without limbs is drawn for those of another one: paint.lua says which.
frog.poses = {
  { x = 330, y = 440, width = 196, height = 156, lean = 4, eyes = "open",
    mouth = smile, limbs = sitting(196, 156) },
  { x = 328, y = 442, width = 214, height = 134, lean = -4, eyes = "open", bulge = 0.1,
    mouth = tight, limbs = sitting(216, 138) },
  { x = 324, y = 443, width = 236, height = 112, lean = -10, eyes = "open", bulge = 0.16,
    mouth = tight, limbs = sitting(234, 118) },
  -- the leap: off the leaf, at the fly, and shut
  { x = 338, y = 388, width = 140, height = 236, lean = 36, eyes = "open", eye = 0.98, bulge = 0.06,
    mouth = tight, limbs = pushing(140, 50, 236) },
  { x = 350, y = 337, width = 152, height = 206, lean = 34, eyes = "open", eye = 1.08,
    bulge = -0.1, mouth = gape, limbs = legs(152, 96, -4, 172) },
  { x = 352, y = 336, width = 160, height = 186, lean = 26, eyes = "tight", bulge = -0.06,
    cheeks = 0.12, mouth = purse },
  -- a gulp, from the cheeks into the belly; the fall, and the landing
  { x = 386, y = 294, width = 180, height = 168, lean = 18, eyes = "happy", cheeks = 0.24,
    mouth = purse, belly = 0.3 },
  { x = 388, y = 292, width = 190, height = 160, lean = 14, eyes = "happy", bulge = 0.22,
    mouth = smile, belly = 0.41, limbs = legs(190, 66, 16, 150) },
  { x = 394, y = 364, width = 170, height = 186, lean = 8, eyes = "open", eye = 1.04, bulge = 0.2,
    mouth = flat, limbs = legs(170, 66, 12, 196) },
  { x = 396, y = 444, width = 244, height = 104, lean = 4, eyes = "happy", bulge = 0.16,
    mouth = tight, limbs = sitting(232, 112) },
  { x = 394, y = 440, width = 190, height = 174, lean = -8, eyes = "happy", belly = 0.33,
    mouth = smug, limbs = sitting(190, 160) },
  -- where is it?
  { x = 394, y = 441, width = 200, height = 158, lean = 0, eyes = "open", belly = 0.36,
    mouth = doubt },
  { x = 394, y = 441, width = 204, height = 146, lean = 8, eyes = "open", eye = 1.05, mouth = flat,
    limbs = sitting(204, 148) },
}

--- The mouths of the words, around the middle of that of pose 7: closed lines, and a tongue.
local function mouth(w, top, bottom, tongue)
  local x, y = 391, 348
  local list = { { pencil = "black", points = through({ { x - w, y - 0.6 * top }, { x - 0.5 * w,
    y - top },
    { x + 0.5 * w, y - top }, { x + w, y - 0.7 * top }, { x + 0.74 * w, y + 0.7 * bottom },
    { x, y + bottom }, { x - 0.74 * w, y + 0.7 * bottom } }, true) } }
  if tongue then
    list[2] = { pencil = "black", points = through { { x - 0.5 * w, y + 0.62 * bottom },
      { x - 0.2 * w, y + 0.25 * bottom }, { x + 0.25 * w, y + 0.25 * bottom },
      { x + 0.52 * w, y + 0.6 * bottom } } }
  end
  return list
end

frog.mouths = { mouth(36, 9, 14), mouth(44, 20, 27, true), mouth(25, 11, 20) }

return frog
