-- A bell ringer pulls, is lifted by the rope, hangs, comes down: the bell is louder than the man.
local window = require "town.window"
local ink = require "town.silhouette"
local belfry = require "town.belfry"

--- Twelve drawings of two frames, about the rope on the floor: the hands; the shoulders; the hips;
--- both feet; degrees of the head; and how high the hat is.
local acting = keys { { 0, { -196, -44, -176, -76, -92, -96, 0, -20, 0, 14, 0 } },
  { 1, { -150, -46, -140, -88, -60, -100, 0, -16, 0, 24, 0 } },
  { 2, { -176, -46, -156, -80, -76, -96, 0, -18, 0, 16, 0 } },
  { 3, { -270, -30, -206, -40, -112, -62, 0, -14, -6, -12, 0 } },
  { 4, { -350, -18, -254, -16, -156, -30, -50, -4, -44, -26, 0 } },
  { 5, { -410, -16, -316, -24, -220, -84, -150, 10, -124, -24, 0 } },
  { 6, { -436, -16, -344, -22, -250, -116, -196, 34, -170, -10, -6 } },
  { 7, { -444, -16, -352, -18, -258, -104, -186, 30, -164, 8, -52 } },
  { 8, { -434, -16, -340, -20, -246, -50, -140, 14, -140, 20, -36 } },
  { 9, { -380, -18, -284, -22, -188, -40, -84, 6, -82, 4, -12 } },
  { 10, { -300, -26, -218, -36, -122, -60, -14, -8, -20, -8, 0 } },
  { 11, { -246, -38, -204, -60, -112, -84, 0, -18, 0, 4, 0 } } }

local HEAD = path { d = "M-28 6 C-38 -20 -34 -44 -6 -46 C20 -46 26 -38 26 -30 L44 -18 "
  .. "C42 -10 34 -8 28 -8 C34 14 24 32 2 34 C-14 32 -24 20 -28 6 Z" }
  - stroke { d = "M4 -20 q7 7 14 0", width = 4, cap = "round" }
local HAT = path { d = "M-38 -34 C-38 -40 -30 -38 -28 -40 C-28 -74 20 -76 22 -42 L46 -40 "
  .. "C46 -34 38 -32 22 -32 Z" }

local function boot(x, y)
  return path { d = "M-14 -26 H10 V-14 C26 -12 32 -8 32 2 H-14 Z" }:translate(x, y)
end

local function ringer(n)
  local hand, sx, sy, px, py, lx, ly, rx, ry, nod, hat = table.unpack(acting:at(n))
  local function leg(x, y)
    return ink.limb({ px, py, 46 }, { (px + x) / 2 + 20, (py + y) / 2 - 8, 34 }, { x, y - 24, 24 })
      | boot(x, y)
  end
  local coat = ink.limb({ sx, sy, 62 }, { (sx + px) / 2 - 8, (sy + py) / 2, 84 }, { px, py, 70 })
  local arms = ink.limb({ sx, sy, 36 }, { sx + 26, (sy + hand) / 2 + 16, 28 }, { 0, hand, 22 })
    | ink.limb({ sx, sy, 36 }, { sx - 14, (sy + hand) / 2 + 26, 28 }, { 0, hand + 26, 22 })
  local head = HEAD:rotate(nod) | HAT:rotate(nod):translate(0, hat)
  return coat | arms | leg(lx, ly) | leg(rx, ry) | head:translate(sx - 6, sy - 40)
end

return window.film { title = "The bell ringer", by = "in", seconds = 2, pane = "plain",
  drawing = function(_, number)
    local n = number // 2
    local swing = -30 * math.cos(2 * math.pi * (n - 1) / 12)
    local hand, hop = acting:at(n)[1], ({ [1] = 20, [2] = 6, [7] = 34, [8] = 14 })[n] or 0
    local bell = belfry.bell(swing, 14 * math.cos(2 * math.pi * (n - 2) / 12))
    local shapes = belfry.arch | belfry.beam | belfry.pigeon:translate(100, belfry.floor - hop)
      | (bell ~ ringer(n):translate(326, belfry.floor))
    if n == 1 or n == 2 then shapes = shapes | belfry.sound(1, n - 1) end
    if n == 7 or n == 8 then shapes = shapes | belfry.sound(-1, n - 7) end
    return { belfry.sky, belfry.rope(belfry.floor + hand + 10), shapes:paint(belfry.ink) }
  end }
