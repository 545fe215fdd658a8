-- Two who dance in a slow turn, seen all round: shapes that are the same from every side, faces
-- that go round with them, and arms that are sorted by how near they are.
local gouache = require "town.gouache"

local couple = {}

local INK = "#3a1a12"

local function face(eyes, brow)
  local function eye(x)
    if eyes == "open" then return ellipse { x, 0, 5.5, 7.5, fill = INK } end
    return gouache.line(("M%g 0 q9 8 18 0"):format(x - 9), 4, INK)
  end
  return union { eye(-19), eye(19), circle { -30, 18, 11, fill = rgb("#d9653f", 0.45) },
    circle { 30, 18, 11, fill = rgb("#d9653f", 0.45) },
    gouache.line(("M-28 %g q9 -6 18 -2 M28 %g q-9 -6 -18 -2"):format(-16 - brow, -16 - brow), 4,
      INK),
    gouache.line("M-10 32 Q0 41 10 32", 4, "#8a3524") }
end

--- A head at x, y that looks across (-1 to 1) and towards us (1) or away (-1).
local function head(who, x, y, across, near)
  local skull = ellipse { 0, 0, 47, 54 }
  local function put(object) return object:scale(who.size):translate(x, y) end
  local hair = who.hair
  local bun = circle { -48 * across, -26, 22, fill = near > 0 and hair or who.shade }
  local behind = ellipse { -10 * across, -10, 53, 54, fill = hair }
  local skin = put(skull):paint(who.skin)
  local over = {}
  if near > -0.75 then
    over[1] = clip(face(who.eyes, who.brow or 0):translate(34 * across, 4), skull)
    over[2] = circle { 47 * across, 12, 9, fill = who.nose }
    over[3] = gouache.form(hair, "M-51 4 C-60 -50 -30 -66 0 -66 C30 -66 60 -50 51 4 "
      .. "C46 -20 30 -34 0 -38 C-30 -34 -46 -20 -51 4 Z"):translate(-8 * across, 0)
    over[4] = math.abs(across) > 0.3 and ellipse { -40 * across, -8, 26, 46, fill = hair } or nil
  else
    over[1] = ellipse { -6 * across, -6, 52, 54, fill = hair }
  end
  if who.bun and near > 0 then behind = bun | behind
  elseif who.bun then over[#over + 1] = bun end
  return union { put(behind), skin, put(union(over)) }
end

--- The couple about x after a share of a turn, and their shape without arms. he, she: tables with
--- body, an object about its foot; fill, edge (or nil), sleeve, skin, hair, shade, nose: its
--- colours; size: of the head; head, shoulder, hold: heights above the foot; broad: half the width
--- of the shoulders; bun: whether there is one; eyes, brow; lift: how far the feet have risen.
function couple.draw(x, foot, turn, he, she)
  local angle = 2 * math.pi * turn
  local c, s = math.cos(angle), math.sin(angle)
  local items, shape = {}, union {}
  local function add(depth, object) items[#items + 1] = { depth, object, #items } end
  local function dancer(who, other, k)
    local px, lift = x - 32 * k * c, who.lift or 0
    local qx = x + 32 * k * c
    local body = who.body:translate(px, foot - lift + 5 * k * s)
    shape = shape | body | ellipse { px + 8 * k * c, foot - lift - who.head, 50 * who.size,
      56 * who.size }
    local edge = who.edge and (body - body:translate(4, 3)):paint(who.edge)
    add(k * s, body:paint(who.fill) | (edge or union {}))
    add(k * s + 0.02, head(who, px + 8 * k * c, foot - lift - who.head, k * c, -k * s))
    for side = -1, 1, 2 do
      local from = { px + side * s * who.broad, foot - lift - who.shoulder }
      local to = { qx + k * c * 18 + side * s * 20, foot - (other.lift or 0) - who.hold }
      local middle = { (from[1] + to[1]) / 2 + side * s * 34, (from[2] + to[2]) / 2 + 20 }
      local out = 0.7 * side * c * k
      add(k * s * 0.6 + out, gouache.taper(who.sleeve, from, middle, 38, 30))
      add(-k * s * 1.4 + out, union { gouache.taper(who.sleeve, middle, to, 30, 22),
        circle { 0, 0, 13 }:translate(to[1], to[2]):paint(who.skin) })
    end
  end
  dancer(he, she, 1)
  dancer(she, he, -1)
  table.sort(items, function(a, b) return a[1] < b[1] or a[1] == b[1] and a[3] < b[3] end)
  local all = union {}
  for _, item in ipairs(items) do all = all | item[2] end
  return all, shape
end

return couple
