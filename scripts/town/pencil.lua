-- The hand of pencil and wash: lines of swelling width on paper, flat colour beside its line, two
-- drawings for each hold.
--
--   local hand = pencil.hand()
--   hand.form({ 100, 300, 110, 200, 230, 200, 240, 330 }, pencil.blue, 6)
--
-- Places are lists of numbers: x, y, x, y, ... A place that is given twice is a corner.
local mood = require("stage.moods").paper

local pencil = { ink = mood.ink, paper = "#fbf3e0", light = mood.light, skin = "#f0c39c",
  blush = "#e39a7e", wood = "#c9a26e", dark = "#42545c", blue = "#93aeb8", mid = mood.far,
  wall = "#ecdfc0", red = mood.accent, teal = "#4f7f80" }

--- How far a second drawing is from the first one: steps right and down.
local STEP = { 450 / 256, 600 / 512 }

--- Path data of a smooth line through places.
local function through(p, is_closed)
  local count = #p // 2
  local function at(i)
    i = is_closed and (i - 1) % count + 1 or math.max(1, math.min(count, i))
    return p[2 * i - 1], p[2 * i]
  end
  local parts = { ("M%.1f %.1f"):format(at(1)) }
  for i = 1, is_closed and count or count - 1 do
    local ax, ay = at(i - 1)
    local bx, by = at(i)
    local cx, cy = at(i + 1)
    local dx, dy = at(i + 2)
    if bx ~= cx or by ~= cy then
      parts[#parts + 1] = ("C%.1f %.1f %.1f %.1f %.1f %.1f"):format(bx + (cx - ax) / 6,
        by + (cy - ay) / 6, cx - (dx - bx) / 6, cy - (dy - by) / 6, cx, cy)
    end
  end
  return table.concat(parts) .. (is_closed and "Z" or "")
end

--- The direction of a line at its place i, as a unit vector; both places of a corner have one.
local function direction(p, i)
  local x, y, before, after = p[2 * i - 1], p[2 * i], i, i
  repeat before = before - 1 until before < 1 or p[2 * before - 1] ~= x or p[2 * before] ~= y
  repeat after = after + 1 until 2 * after > #p or p[2 * after - 1] ~= x or p[2 * after] ~= y
  before, after = math.max(1, before), math.min(#p // 2, after)
  local dx, dy = p[2 * after - 1] - p[2 * before - 1], p[2 * after] - p[2 * before]
  local length = math.max(1e-6, math.sqrt(dx * dx + dy * dy))
  return dx / length, dy / length
end

--- The outline of a line that swells towards its middle, or is even.
local function ribbon(p, width, even)
  local count, sides, from = #p // 2, {}, 1
  for i = 1, count do
    local x, y = direction(p, i)
    if p[2 * i - 1] ~= p[2 * i - 3] or p[2 * i] ~= p[2 * i - 2] then from = i end
    local swell = math.sin(math.pi * (from - 0.8) / (count - 0.5)) ^ 0.7
    local half = width / 2 * (even and 1 or 0.22 + 0.78 * swell)
    sides[2 * i - 1], sides[2 * i] = p[2 * i - 1] - y * half, p[2 * i] + x * half
    local k = 4 * count - 2 * i + 1
    sides[k], sides[k + 1] = p[2 * i - 1] + y * half, p[2 * i] - x * half
  end
  return through(sides, true)
end

--- A hand that draws. second: whether this is the second of the two drawings of a hold,
--- whose places
--- differ a little. paper: if given, all washes have this colour, so that lines alone show.
function pencil.hand(second, paper)
  local hand = {}

  --- An object as this drawing has it: a little beside. Lines with as many places move together,
  --- and by whole steps of a plane file, which then needs few bytes for it.
  local function drawn(object, places)
    if not second then return object end
    local n = #places // 2
    return object:translate((n % 3 - 1) * STEP[1], (n % 2 - 0.5) * 2 * STEP[2])
  end

  --- A line, thin where the pencil comes and goes, if it is not even. Two places become three.
  function hand.line(p, width, colour, even)
    if #p == 4 then p = { p[1], p[2], (p[1] + p[3]) / 2, (p[2] + p[4]) / 2, p[3], p[4] } end
    return drawn(path { d = ribbon(p, width or 5, even), fill = colour or pencil.ink }, p)
  end

  --- A flat wash, a little beside its places.
  function hand.wash(p, colour)
    return drawn(path { d = through(p, true), fill = paper or colour }, p):translate(2 * STEP[1],
      3 * STEP[2])
  end

  --- A wash and its line, which does not quite close.
  function hand.form(p, colour, width)
    return hand.wash(p, colour) | hand.line(p, width)
  end

  --- A limb of two bones, each `long`, from x, y to a hand: wash and a line along its outer side.
  --- side: 1 or -1, where the elbow goes; w: widths at both ends. Returns the object, and where the
  --- hand is, which may be nearer than was asked.
  function hand.limb(x, y, to, long, side, w, colour)
    local dx, dy = to[1] - x, to[2] - y
    local far = math.max(1, math.sqrt(dx * dx + dy * dy))
    local reach = math.min(far, 1.98 * long)
    local ux, uy = dx / far, dy / far
    local out = side * math.sqrt(long * long - reach * reach / 4)
    local hx, hy = x + ux * reach, y + uy * reach
    local ex, ey = x + ux * reach / 2 - uy * out, y + uy * reach / 2 + ux * out
    local a, b, m = w[1] / 2, w[2] / 2, (w[1] + w[2]) / 4
    local vx, vy = -uy * side, ux * side -- towards the elbow
    local sx, sy = (ex - x) / long, (ey - y) / long -- along the upper arm
    local fx, fy = (hx - ex) / long, (hy - ey) / long -- along the lower one
    local lx, ly = -sy * side, sx * side -- sideways from both, outwards
    local gx, gy = -fy * side, fx * side
    local outer = { x + lx * a, y + ly * a, ex + vx * m, ey + vy * m, hx + gx * b, hy + gy * b }
    local all = table.move(outer, 1, #outer, 1, {})
    for _, n in ipairs { hx + fx * b, hy + fy * b, hx - gx * b, hy - gy * b,
      ex - vx * m * 0.8, ey - vy * m * 0.8, x - lx * a, y - ly * a, x - sx * a, y - sy * a } do
      all[#all + 1] = n
    end
    return drawn(path { d = through(all, true), fill = paper or colour }, all) | hand.line(outer,
      4.5),
      hx, hy
  end

  --- A dot: an eye, a button.
  function hand.dot(x, y, r, colour)
    return ellipse { x, y, r, 1.15 * r, fill = colour or pencil.ink }
  end

  return hand
end

--- The pose of a frame and the hand that draws it. row: a letter for each `step` frames; a capital
--- is the second drawing of the pose. poses: by small letters.
function pencil.exposed(poses, row, step, number, paper)
  local at = number // step % #row + 1
  local letter = row:sub(at, at)
  return poses[letter:lower()], pencil.hand(letter:lower() ~= letter, paper)
end

return pencil
