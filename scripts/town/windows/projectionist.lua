-- The projectionist: two reels turn, the beam flickers, and he drinks tea without looking away:
-- nor does he see where his biscuits come from.
local window = require "town.window"
local geometry = require "town.geometry"
local neon = require("stage.moods").neon

local CYAN, PINK, PAPER, INK = neon.light, neon.accent, "#fff1dc", neon.ink
local SKIN, TEAL, WINE = "#f4c7a4", "#149aa6", "#8a1458"
local limb, sector = geometry.limb, geometry.sector

local room = rect { 0, 0, 450, 600, fill = neon.sky[2] }
  | rect { 0, 520, 450, 80, fill = neon.far } | rect { 17, 250, 22, 150, fill = INK }

--- A reel with its four holes turned by some degrees, and the radius of its film; one may be lost.
local function reel(x, y, film, turn, lost)
  local parts = { circle { x, y, 68, fill = TEAL }, circle { x, y, film, fill = INK },
    circle { x, y, 20, fill = CYAN } }
  for i = 0, 3 do
    local a = math.rad(90 * i + turn)
    if i ~= lost then
      parts[#parts + 1] = circle { x + 43 * math.sin(a), y - 43 * math.cos(a), 13, fill = PAPER }
    end
  end
  return union(parts)
end

--- The machine, without reels: a box, a lens, a foot of three legs, and the loop of the film.
local machine = limb({ { 130, 420 }, { 84, 560 } }, 16, INK)
  | limb({ { 150, 420 }, { 150, 560 } }, 16, INK) | limb({ { 170, 420 }, { 216, 560 } }, 16, INK)
  | rect { 84, 282, 136, 146, radius = 14, fill = PINK } | rect { 84, 360, 136, 68, fill = WINE }
  | rect { 50, 296, 44, 56, fill = TEAL } | sector(50, 324, 34, 180, 360, CYAN)
  | circle { 152, 322, 26, fill = INK } | circle { 152, 322, 15, fill = "#ffe7a0" }

local body = path { fill = CYAN,
  d = "M292 330 C262 400 260 500 262 600 H430 V360 Q396 306 346 306 Z" }
  | rect { 318, 268, 50, 60, radius = 20, fill = SKIN } | circle { 336, 238, 56, fill = SKIN }
  | sector(342, 232, 58, 20, 200, INK) | rect { 272, 200, 80, 16, radius = 8, fill = PINK }
  | sector(338, 206, 56, -90, 90, PINK) | sector(294, 262, 26, 120, 280, PAPER)

--- The cup in its hand at a place, tilted; his eye follows the film up or down.
local function tea(x, y, tilt, look)
  local cup = (path { fill = PAPER, d = "M-32 -26 H32 Q30 26 0 30 Q-30 26 -32 -26 Z" }
    | circle { 34, -4, 13, fill = PAPER } | circle { 34, -4, 6, fill = neon.sky[2] }):rotate(tilt)
  return circle { 302, 234 + look, 6, fill = INK }
    | limb({ { 400, 380 }, { 366, 476 }, { x + 40, y + 6 } }, 42, TEAL)
    | cup:translate(x, y) | circle { x + 36, y + 2, 21, fill = SKIN }
end

-- For how many drawings: where the cup is, its tilt, and where the eye is.
local sheet = { { 2, { 272, 408, 0, 0 } }, { 2, { 272, 340, 0, 0 } }, { 8, { 272, 286, 28, -4 } },
  { 2, { 272, 340, 0, -4 } }, { 10, { 272, 408, 0, 0 } } }

-- A hole of the reel is a biscuit: where it falls from drawing 14 on, and then the tea splashes.
local falling = { [14] = { 236, 252 }, [16] = { 252, 300 }, [18] = { 262, 366 } }
local splash = { [20] = { 20, 34 }, [22] = { 34, 14 } }

local function biscuit(number)
  local at, drops = falling[number // 2 * 2], splash[number // 2 * 2]
  if at then return circle { at[1], at[2], 13, fill = PAPER } end
  if drops then
    return circle { 262 - drops[1], 374 - drops[2], 7, fill = "#d98a3a" }
      | circle { 270 + drops[1], 370 - drops[2], 9, fill = "#d98a3a" }
  end
end

return window.film { title = "The projectionist", by = "ge", seconds = 2, pane = "plain",
  drawing = function(_, number)
    local step = number // 2
    local beam = polygon { { 46, 300 }, { 46, 348 }, { 17, 392 }, { 17, 256 },
      fill = step % 2 == 0 and "#ffe7a0" or PAPER }
    local x, y, tilt, look = table.unpack(geometry.held(sheet, number), 1, 4)
    return { room, reel(94, 118, 58, 30 * step),
      reel(192, 214, 36, 30 * step + 15, number >= 14 and 3 or nil), machine, beam, body,
      tea(x, y, tilt, look), biscuit(number) }
  end }
