-- A globe of glass is shaken; it snows inside, upwards, on a diver of tin.
local window = require "town.window"
local cut = require "town.cutout"
local diver = require "town.diver"
local mood = require("stage.moods").snow

local SKIN, WOOD = "#e8b994", "#6b4630"

local ROOM = rect { 0, 0, 450, 600, fill = mood.sky[1] } | rect { 0, 520, 450, 90, fill = mood.far }
  | cut.laid(cut.piece("M-10 508 L460 512 L460 534 L-10 532 Z", mood.ground))
local GLASS = cut.disc(225, 272, 168, mood.near)
local DRIFT = cut.piece("M92 372 C140 352 180 380 230 366 C280 354 320 372 358 370 C330 420 "
  .. "282 438 225 438 C168 438 122 420 92 372 Z", mood.ground)
local GLEAM = cut.piece("M108 214 C120 168 150 140 186 128 C156 156 136 186 128 222 Z", mood.sky[3])
local FOOT = cut.piece("M128 424 C180 446 270 446 322 424 L344 506 L106 506 Z", WOOD)
  | cut.piece("M150 462 L300 462 L296 486 L154 486 Z", mood.light)
local DIVER = diver:scale(1.5):translate(225, 276)
local HAND = cut.piece("M-12 610 L-8 500 C-4 452 40 436 96 452 C128 454 132 476 108 482 C128 484 "
  .. "130 504 106 506 C118 514 110 528 94 526 C74 532 64 540 62 560 L66 610 Z", SKIN)
local CUFF = cut.piece("M-30 548 L80 540 L84 620 L-30 620 Z", mood.accent)
local SLEEVES = HAND | CUFF
SLEEVES = SLEEVES:translate(44, 0) | SLEEVES:scale(-1, 1):translate(406, 0)

--- Flakes that rise, step of 12.
local function snow(step)
  local flakes = {}
  for i = 0, 15 do
    local x, y = 98 + 254 * (i * 7 % 16) / 15, 380 - (i * 5 % 16 * 19 + 304 * step / 12) % 304
    local size = 7 + i % 3
    if (x - 225) ^ 2 + (y - 272) ^ 2 < 150 ^ 2 then
      flakes[#flakes + 1] = polygon { { x - size, y }, { x, y - size }, { x + size, y },
        { x, y + size } }
    end
  end
  return union(flakes):paint(cut.WHITE)
end

return window.film { title = "The globe", by = "cp", seconds = 2, pane = "plain",
  drawing = function(_, number)
    local step = number // 2
    local shake = step < 5 and (step % 2 == 0 and 1 or -1) or 0
    local globe = union { cut.laid(GLASS), snow(step), DIVER:translate(-8 * shake, 0), DRIFT, GLEAM,
      cut.laid(FOOT | SLEEVES) }
    return { ROOM, globe:translate(18 * shake, -6 * math.abs(shake)) }
  end }
