-- A juggler on her stage, without things that fly: the ring, her body, her head, and her hat.
local geometry = require "town.geometry"
local noon = require("stage.moods").noon

-- x, y: where her head belongs.
local juggling = { x = 225, y = 214, colours = { noon.accent, "#f6b93b", noon.ink, noon.near } }

local SKIN, PAPER, RED, INK, SUN = "#f4c7a4", noon.light, noon.accent, noon.ink, "#f6b93b"
local limb, sector = geometry.limb, geometry.sector
local X, Y = juggling.x, juggling.y

local room = { rect { 0, 0, 450, 600, fill = noon.sky[2] },
  circle { X, Y, 212, fill = noon.sky[3] } }
for i = 0, 11 do
  room[3 + i] = sector(X, 720, 320, -90 + 15 * i, -75 + 15 * i,
    i % 2 == 0 and noon.sky[1] or "#48b3d8")
end
for i = 0, 6 do
  local x = 33 + 64 * i
  room[#room + 1] = polygon { { x - 32, 17 }, { x + 32, 17 }, { x, 66 },
    fill = ({ RED, PAPER, SUN })[i % 3 + 1] }
end

juggling.room = union(room)

-- A leotard of quarters, on a stage.
local body = {
  rect { 95, 522, 260, 60, fill = RED }, rect { 85, 510, 280, 18, radius = 9, fill = PAPER },
  limb({ { 205, 420 }, { 198, 502 } }, 34, INK), limb({ { 245, 420 }, { 252, 502 } }, 34, INK),
  sector(190, 512, 26, -90, 90, RED), sector(260, 512, 26, -90, 90, RED),
  rect { 211, 236, 28, 50, fill = SKIN },
  path { fill = RED, d = "M176 276 Q225 262 274 276 L258 372 H192 Z" },
  sector(225, 376, 66, 90, 180, SUN), sector(225, 376, 66, 180, 270, PAPER),
  sector(225, 376, 40, -90, 90, RED),
  circle { 225, 312, 9, fill = PAPER }, circle { 225, 340, 9, fill = PAPER } }

--- Her body, with its hands raised by a number of units.
function juggling.body(raised)
  local parts = { table.unpack(body) }
  for side = -1, 1, 2 do
    local palm = { X + 112 * side, 346 - raised }
    parts[#parts + 1] = limb({ { X + 42 * side, 288 }, { X + 92 * side, 420 },
      { palm[1], palm[2] + 10 } }, 28, SKIN) | sector(palm[1], palm[2], 30, 90, 270, SKIN)
  end
  return union(parts)
end

--- Ball i, 1 to 4.
function juggling.ball(i, x, y)
  return circle { x, y, 28, fill = juggling.colours[i] }
    | sector(0, 0, 28, 90 * i, 90 * i + 90, PAPER):translate(x, y)
end

--- The head, turned by an angle.
function juggling.head(x, y, turn)
  return (circle { 0, 0, 42, fill = SKIN } | sector(0, -4, 45, -100, 100, INK)
    | circle { -40, -18, 17, fill = INK } | circle { 40, -18, 17, fill = INK }
    | circle { -15, 8, 5, fill = INK } | circle { 15, 8, 5, fill = INK })
    :rotate(turn):translate(x, y)
end

--- The hat waits, too; a head that comes in below lifts it.
function juggling.hat(lift)
  return (polygon { { -30, 0 }, { 30, 0 }, { 0, -66 }, fill = SUN }
    | circle { 0, -66, 12, fill = RED } | rect { -34, -6, 68, 12, radius = 6, fill = RED })
    :rotate(lift / 2):translate(X, Y - 40 - lift)
end

return juggling
