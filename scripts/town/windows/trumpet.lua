-- The trumpet: it gets longer with its tone, leaves by the left, and comes in again by the right.
local window = require "town.window"
local geometry = require "town.geometry"
local neon = require("stage.moods").neon

local CYAN, PINK, PAPER, INK = neon.light, neon.accent, "#fff1dc", neon.ink
local SKIN, GOLD, WINE = "#f4c7a4", "#ffc94d", "#8a1458"
local limb, sector = geometry.limb, geometry.sector
local Y = 262 -- of the trumpet

local room = union { rect { 0, 0, 450, 600, fill = neon.sky[2] },
  sector(225, 600, 420, -90, 90, neon.far), sector(225, 600, 320, -90, 90, neon.sky[3]) }

--- The end of the trumpet, its mouth at x.
local function bell(x)
  return path { fill = GOLD, d = ("M%g %g Q%g %g %g %g V%g Q%g %g %g %g Z"):format(x + 110, Y - 8,
    x + 36, Y - 12, x, Y - 58, Y + 58, x + 36, Y + 12, x + 110, Y + 8) }
    | ellipse { x, Y, 14, 58, fill = WINE }
end

--- All of it, which ends so far from the player; its part beyond the left comes in at the right.
local function trumpet(x)
  local left = math.max(x + 100, 0)
  local parts = { rect { left, Y - 8, 274 - left, 16, fill = GOLD } }
  parts[#parts + 1] = rect { 186, Y - 4, 76, 60, radius = 28, fill = GOLD }
    | rect { 200, Y + 10, 48, 32, radius = 16, fill = WINE }
  for i = 0, 2 do parts[#parts + 1] = rect { 200 + 20 * i, Y - 34, 9, 30, fill = PAPER } end
  if x > -130 then parts[#parts + 1] = bell(x) end
  if x < -130 then
    parts[#parts + 1] = rect { x + 650, Y - 8, 200, 16, fill = GOLD } | bell(x + 550)
  end
  return union(parts)
end

--- The player: how large the cheek is, whether the hat is on, how the eye is, and a nod.
local function player(cheek, hat, wide, nod)
  local fez = polygon { { -34, 0 }, { 34, 0 }, { 26, -52 }, { -26, -52 }, fill = CYAN }
    | rect { -3, -58, 6, 10, fill = PINK }
    | limb({ { 0, -54 }, { 30, -50 }, { 38, -24 } }, 7,
      PINK)
  local head = circle { 320, 238, 58, fill = SKIN } | sector(326, 232, 60, 10, 190, INK)
    | circle { 312, 238, 40, fill = SKIN } | circle { 290, 222, wide, fill = INK }
    | circle { 288, 258, cheek, fill = "#f09a86" }
  return path { fill = PINK,
    d = "M262 330 C236 400 236 500 240 600 H420 C426 480 408 380 372 320 Z" }
    | path { fill = PAPER, d = "M272 322 L300 600 H252 C250 480 256 380 272 322 Z" }
    | rect { 292, 280, 60, 60, radius = 20, fill = SKIN }
    | (head | fez:rotate(hat[3]):translate(hat[1], hat[2])):translate(0, nod)
end

local arm = limb({ { 366, 356 }, { 330, 440 }, { 232, Y + 66 } }, 40, WINE)
  | circle { 226, Y + 54, 24, fill = SKIN } | circle { 226, Y - 28, 20, fill = SKIN }

local ON, TIPPED, OFF = { 326, 192, 8 }, { 292, 176, -24 }, { 206, 132, -70 }

-- For how many drawings: where the trumpet ends, the cheek, the hat, the eye, a nod.
local sheet = {
  { 4, { 118, 16, ON, 6, 0 } }, { 2, { 140, 10, ON, 3, -8 } }, { 1, { 60, 30, ON, 3, 4 } },
  { 1, { -70, 38, ON, 3, 4 } }, { 1, { -131, 42, ON, 3, 4 } }, { 1, { -136, 42, ON, 3, 4 } },
  { 3, { -166, 42, ON, 3, 4 } }, { 1, { -172, 42, TIPPED, 9, 0 } }, { 4, { -172, 24, OFF, 10, 0 } },
  { 1, { -70, 16, OFF, 8, 0 } }, { 1, { 150, 12, { 270, 110, 60 }, 6, 0 } },
  { 1, { 110, 16, { 320, 150, 20 }, 6, -4 } }, { 3, { 118, 16, ON, 6, 0 } } }

return window.film { title = "The trumpet", by = "ge", seconds = 2,
  drawing = function(_, number)
    local x, cheek, hat, wide, nod = table.unpack(geometry.held(sheet, number), 1, 5)
    return { room, player(cheek, hat, wide, nod), trumpet(x), arm }
  end }
