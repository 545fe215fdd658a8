-- Gouache for windows of the town: flat shapes with one soft wash of lamplight each.
local gouache = {}

--- A wash from one point to another, through two or three colours.
function gouache.wash(x, y, to_x, to_y, ...)
  return linear { from = { x, y }, to = { to_x, to_y }, ... }
end

--- A wall about a lamp at x, y, which reaches as far as `reach`.
function gouache.wall(x, y, reach, ...)
  return rect { 0, 0, 960, 600, fill = radial { centre = { x, y }, radius = reach, ... } }
end

--- Light in the air about x, y.
function gouache.glow(x, y, reach, colour, strength)
  return circle { x, y, reach, fill = radial { centre = { x, y }, radius = reach,
    rgb(colour, strength), rgb(colour, 0.35 * strength), rgb(colour, 0) } }
end

--- A smooth limb through points { x, y, width }, with round ends.
function gouache.limb(fill, ...)
  return stroke { points = { ... }, degree = 3, cap = "round", fill = fill }
end

--- A line of one width with round ends.
function gouache.line(d, width, fill)
  return stroke { d = d, width = width, cap = "round", join = "round", fill = fill }
end

--- A path.
function gouache.form(fill, d, ...)
  return path { d = d:format(...), fill = fill }
end

--- The shape with a light edge towards the lamp, `across` and `down` wide, and a dark one behind.
function gouache.edged(shape, light, dark, across, down)
  return union { shape, (shape - shape:translate(-1.5 * across, -1.5 * down)):paint(dark),
    (shape - shape:translate(across, down)):paint(light) }
end

--- Where the elbow of an arm is whose parts are `upper` and `lower` long; side 1 bends it to the
--- left of the way from the shoulder to the hand, -1 to the right.
local function elbow(from, to, upper, lower, side)
  local dx, dy = to[1] - from[1], to[2] - from[2]
  local reach = math.max(1, math.min(math.sqrt(dx * dx + dy * dy), upper + lower - 1))
  local along = (upper * upper - lower * lower + reach * reach) / (2 * reach)
  local out = side * math.sqrt(math.max(0, upper * upper - along * along))
  return { from[1] + (along * dx + out * dy) / reach, from[2] + (along * dy - out * dx) / reach }
end

--- The direction from one point to another, of length 1.
local function towards(from, to)
  local dx, dy = to[1] - from[1], to[2] - from[2]
  local length = math.max(1e-3, math.sqrt(dx * dx + dy * dy))
  return dx / length, dy / length
end

--- A point that lies `along` a direction and `aside` of it from another.
local function off(point, x, y, along, aside)
  return { point[1] + along * x - aside * y, point[2] + along * y + aside * x }
end

--- A path of letters and points in turn.
local function drawn(fill, ...)
  local parts = { ... }
  for i, part in ipairs(parts) do
    if type(part) == "table" then parts[i] = ("%.1f %.1f"):format(part[1], part[2]) end
  end
  return path { d = table.concat(parts, " "), fill = fill }
end

--- A part of a limb with two round ends, of four pieces: limbs that move are small in a plane.
function gouache.taper(fill, from, to, width, to_width)
  local x, y = towards(from, to)
  local w, v = 0.5 * width, 0.5 * to_width
  return drawn(fill, "M", off(from, x, y, 0, -w), "L", off(to, x, y, 0, -v), "C",
    off(to, x, y, 1.3 * v, -v), off(to, x, y, 1.3 * v, v), off(to, x, y, 0, v), "L",
    off(from, x, y, 0, w), "C", off(from, x, y, -1.3 * w, w), off(from, x, y, -1.3 * w, -w),
    off(from, x, y, 0, -w), "Z")
end

local function between(p, q, u) return { p[1] + u * (q[1] - p[1]), p[2] + u * (q[2] - p[2]) } end

--- A sleeve from the shoulder to the hand, of eight pieces. fields: from, to: points; parts: two
--- lengths; side: of the elbow; widths: at shoulder, elbow and hand; fill.
function gouache.arm(fields)
  local from, to, widths = fields.from, fields.to, fields.widths
  local bend = elbow(from, to, fields.parts[1], fields.parts[2], fields.side)
  local ux, uy = towards(from, bend)
  local vx, vy = towards(bend, to)
  local mx, my = towards({ 0, 0 }, { ux + vx, uy + vy })
  local corner = 0.5 * widths[2] / math.max(0.6, mx * ux + my * uy)
  local function side(sign)
    local shoulder = off(from, ux, uy, 0, sign * 0.5 * widths[1])
    local tip = off(bend, mx, my, 0, sign * corner)
    local hand = off(to, vx, vy, 0, sign * 0.5 * widths[3])
    return shoulder, between(tip, shoulder, 0.3), tip, between(tip, hand, 0.3), hand
  end
  local shoulder, upper, tip, lower, hand = side(1)
  local far_shoulder, far_upper, far_tip, far_lower, far_hand = side(-1)
  local back, on = -0.66 * widths[1], 0.66 * widths[3]
  return drawn(fields.fill, "M", shoulder, "L", upper, "Q", tip, lower, "L", hand, "C",
    off(hand, vx, vy, on, 0), off(far_hand, vx, vy, on, 0), far_hand, "L", far_lower, "Q",
    far_tip, far_upper, "L", far_shoulder, "C", off(far_shoulder, ux, uy, back, 0),
    off(shoulder, ux, uy, back, 0), shoulder, "Z")
end

local INK = "#3a1a12"

local eyes = {
  open = function() return ellipse { 0, 0, 4.6, 6.4, fill = INK } end,
  shut = function() return gouache.line("M-9 -1 Q0 7 9 -1", 3.4, INK) end,
  happy = function() return gouache.line("M-9 3 Q0 -7 9 3", 3.4, INK) end,
}

--- A head about x, y: an oval 100 by 112 in `skin`, a wash of the room. fields, all others may be
--- nil: behind, front: hair about the middle of the head, in its own colours; eyes: "open", "shut",
--- "happy", or one for each; face: how far the features have turned, { across, down }; mouth: path
--- data; brow: how far they are lifted; brows, nose: colours; spread: half the distance of
--- the eyes; scale.
function gouache.head(fields)
  local fx, fy = table.unpack(fields.face or { 0, 0 })
  local k, x, y = fields.scale or 1, fields.x, fields.y
  local function put(object, u)
    return object and object:translate(u * fx, u * fy):scale(k):translate(x, y) or union {}
  end
  local oval = path { d = "M-48 -14 C-48 -44 -28 -58 0 -58 "
    .. "C28 -58 48 -44 48 -14 C50 26 30 56 0 56 C-30 56 -50 26 -48 -14 Z" }
  local spread, brow = fields.spread or 19, -18 - (fields.brow or 0)
  local look = type(fields.eyes) == "table" and fields.eyes or { fields.eyes, fields.eyes }
  local cheek = rgb("#d9653f", 0.45)
  local features = union {
    circle { -28, 18, 11, fill = cheek }, circle { 28, 18, 11, fill = cheek },
    eyes[look[1]]():translate(-spread, 0), eyes[look[2]]():translate(spread, 0),
    gouache.line(("M%g %g q8 -6 17 -2 M%g %g q-8 -6 -17 -2"):format(-spread - 9, brow, spread + 9,
      brow), 4, fields.brows or INK),
    gouache.form(fields.nose or "#c9764a", "M-3 -2 C-4 8 -12 14 -8 20 C-4 25 8 24 9 17 "
      .. "C9 11 3 8 3 -2 Z"),
    gouache.line(fields.mouth or "M-9 33 Q0 39 10 32", 3.6, "#8a3524") }
  return union { put(fields.behind, -0.3), put(oval, 0):paint(fields.skin), put(features, 1),
    put(fields.front, 0.4) }
end

--- The value of an exposure sheet: { drawings, value }, ... in turn, at drawing number n from 0.
function gouache.exposed(n, ...)
  for _, held in ipairs { ... } do
    n = n - held[1]
    if n < 0 then return held[2] end
  end
end

--- A track over numbers of drawings: keys { number, value, ease } which are eased into.
function gouache.track(...)
  local list = { ... }
  for i, key in ipairs(list) do list[i] = { key[1], key[2], key[3] or "inOutSine" } end
  return keys(list)
end

return gouache
