-- The janitor dances with his broom on a drawn blind, and dips it.
local window = require "town.window"
local dancers = require "town.dancers"
local ink = require "town.silhouette"
local mood = require("stage.moods").candle

--- Twelve drawings of two frames: hips; degrees of his lean and of his head; both feet; where the
--- broom is, and its degrees.
local dance = keys { { 0, { -40, -150, -4, 0, -84, 58, -20, 58, 62, 50, 4 } },
  { 1, { -24, -158, 2, -6, -84, 58, 14, 40, 72, 44, 10 } },
  { 2, { -6, -150, 8, -10, -60, 52, 36, 58, 84, 50, 14 } },
  { 3, { 0, -160, 4, -4, -14, 34, 36, 58, 86, 40, 4 } },
  { 4, { -14, -152, -4, 4, 2, 58, 20, 40, 76, 50, -8 } },
  { 5, { -34, -154, -10, 8, -34, 58, -58, 44, 58, 44, -14 } },
  { 6, { -46, -146, -6, 4, -100, 58, -20, 58, 60, 50, 0 } },
  { 7, { -50, -130, 16, 6, -116, 58, 20, 58, 6, 40, 26 } },
  { 8, { -66, -108, 42, 10, -136, 58, 10, 58, -56, 30, 46 } },
  { 10, { -66, -104, 46, 16, -136, 58, 10, 58, -60, 28, 50 } },
  { 11, { -44, -140, 8, 0, -110, 58, 0, 58, 40, 44, 18 } } }

local BROOM = rect { -6, -270, 12, 270 } | path { d = "M-14 -206 C-50 -240 -52 -320 -46 -344 "
  .. "L-30 -326 L-16 -348 L0 -328 L16 -348 L30 -326 L46 -344 C52 -320 50 -240 14 -206 Z" }
  | path { d = "M0 -198 L-30 -182 V-216 Z M0 -198 L30 -182 V-216 Z" }
local HEAD = path { d = "M-20 24 C-22 4 -36 -10 -32 -36 L34 -44 L60 -22 C56 -14 46 -14 38 -14 "
  .. "C54 -8 60 6 52 10 C44 2 36 2 30 4 C26 16 18 18 12 18 L14 26 Z" }
  | path { d = "M-36 -30 C-44 -68 16 -86 34 -52 L62 -52 C62 -42 50 -40 34 -40 Z" }

local function janitor(pose)
  local hx, hy, lean, nod, lx, ly, rx, ry, bx, by, degrees = table.unpack(pose)
  local c, s = math.cos(math.rad(degrees)), math.sin(math.rad(degrees))
  local function along(far) return bx + far * s, by - far * c end
  local shoulder_x = hx + 134 * math.sin(math.rad(lean))
  local shoulder_y = hy - 134 * math.cos(math.rad(lean))
  local function leg(x, y)
    return ink.limb({ hx, hy, 46 }, { (hx + x) / 2 + 22, (hy + y) / 2, 34 }, { x, y - 12, 24 })
      | path { d = "M-12 -20 H10 C22 -16 34 -10 34 0 H-12 Z" }:translate(x, y)
  end
  local function arm(far)
    local x, y = along(far)
    return ink.limb({ shoulder_x, shoulder_y + 8, 30 }, { (shoulder_x + x) / 2 - 10,
      (shoulder_y + y) / 2 + 44, 26 }, { x, y, 22 })
  end
  local coat = ink.limb({ shoulder_x, shoulder_y, 58 }, { (hx + shoulder_x) / 2 - 10,
    (hy + shoulder_y) / 2, 64 }, { hx, hy + 26, 74 })
  return BROOM:rotate(degrees):translate(bx, by) | leg(lx, ly) | leg(rx, ry) | coat | arm(120)
    | arm(190) | HEAD:rotate(lean * 0.7 + nod):translate(shoulder_x + 4, shoulder_y - 40)
end

local ROOM = dancers.room()

return window.film { title = "Waltz with a broom", by = "in", seconds = 2, pane = "plain",
  drawing = function(_, number)
    local n = number // 2
    local dip = (n > 6 and n < 11) and 1 or 0
    local both = janitor(dance:at(n)):translate(200, 516)
      | dancers.mouse(0, 0, dip, dip):translate(376, 574)
    return { ROOM, both:paint(mood.ink) }
  end }
