-- The ringer's boy, asleep on the knot of the rope, goes up and down with it; so does a pigeon.
local window = require "town.window"
local ink = require "town.silhouette"
local belfry = require "town.belfry"

--- The pigeon in 24 drawings, where it is on the wing: right and down.
local FLIGHT = { [10] = { 104, 470 }, [11] = { 120, 300 }, [22] = { 120, 300 },
  [23] = { 104, 470 } }

local HEAD = path { d = "M-58 -10 C-62 -90 62 -90 58 -10 C58 40 30 54 0 54 "
    .. "C-30 54 -58 40 -58 -10 Z" }
  | path { d = "M-58 -16 C-84 -60 -60 -100 0 -94 C20 -112 44 -104 40 -88 C70 -76 76 -50 58 -16 "
    .. "L40 -40 L20 -28 L0 -42 L-22 -26 L-38 -42 Z" }
local FACE = path { d = "M-38 0 Q-22 24 -6 0 Q-22 12 -38 0 Z M12 0 Q28 24 44 0 Q28 12 12 0 Z" }
  | circle { 4, 34, 6 }
local TRUNK = path { d = "M-40 -150 C-78 -120 -76 -40 -60 0 C-30 16 30 16 60 0 "
    .. "C76 -40 78 -120 40 -150 Z" }
local KNOT = path { d = "M-30 4 C-36 -16 36 -16 30 4 C40 30 18 44 0 44 C-18 44 -40 30 -30 4 Z "
  .. "M-5 36 L-18 96 L0 82 L18 96 L5 36 Z" }
local ROPE = rect { 222, 20, 6, 400 }

local function leg(side, sway)
  local x = 54 * side + 16 * sway
  return ink.limb({ 30 * side, -16, 50 }, { 84 * side, 2, 42 }, { x, 84, 28 })
    | path { d = "M-15 -14 H15 L18 12 C18 30 -18 30 -18 12 Z" }:translate(x, 92)
end

return window.film { title = "The ringer's boy", by = "in", seconds = 4, pane = "plain",
  drawing = function(_, number)
    local step = number // 2
    local n = step % 12
    local turn = 2 * math.pi * (n - 1) / 12
    local knot, sway = 396 + 54 * math.cos(turn), math.floor(math.sin(turn) + 0.5)
    local x, y = 100, belfry.floor
    if FLIGHT[step] then x, y = table.unpack(FLIGHT[step]) end
    if step > 11 and step < 22 then x, y = 244, knot - 236 end
    local body = TRUNK | KNOT | leg(-1, sway) | leg(1, sway)
    local shapes = belfry.arch | ROPE | body:scale(0.86):translate(225, knot)
    if n == 1 or n == 2 then shapes = shapes | belfry.sound(1, n - 1):translate(30, 0) end
    if n == 7 or n == 8 then shapes = shapes | belfry.sound(-1, n - 7):translate(20, 0) end
    local function front(object)
      return object:rotate(14):translate(14, -186):scale(0.86):translate(225, knot)
    end
    local arms = ink.limb({ -50, -118, 34 }, { -40, -50, 30 }, { 16, -76, 26 })
      | ink.limb({ 50, -124, 34 }, { 40, -60, 30 }, { -16, -108, 26 })
    local top = math.max(38, knot - 330)
    return { belfry.sky, shapes:paint(belfry.ink),
      rect { 217, top, 16, knot - 6 - top, radius = 8, fill = belfry.accent },
      (front(HEAD) | arms:scale(0.86):translate(225, knot) | belfry.pigeon:translate(x, y))
        :paint(belfry.ink), front(FACE):paint(belfry.light) }
  end }
