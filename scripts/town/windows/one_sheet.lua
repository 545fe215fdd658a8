-- Two sleep under one sheet, which rises and falls; it is pulled to the left, and to the right.
local window = require "town.window"
local cut = require "town.cutout"
local mood = require("stage.moods").fog

local SKIN, WOOD = "#e3b391", "#8a5a3a"

local ROOM = rect { 0, 0, 450, 600, fill = mood.ground }
  | cut.laid(cut.piece("M30 72 C120 34 330 34 420 72 L426 600 L24 600 Z", WOOD))
  | cut.laid(cut.piece("M44 116 L406 116 L412 600 L38 600 Z", mood.sky[2]))
local PILLOW = cut.laid(cut.piece("M64 138 C110 128 170 130 210 140 L206 246 C160 254 110 254 "
  .. "66 246 Z", mood.light))
ROOM = ROOM | PILLOW | PILLOW:translate(176, 0)

-- Who sleeps, each in the middle of 0, their chin at 0.
local MAN = cut.piece("M-58 16 C-30 0 30 0 58 16 L66 190 L40 330 L6 330 L0 220 L-8 330 "
  .. "L-44 330 L-66 190 Z", mood.near)
local STRIPES = {}
for i = 1, 3 do STRIPES[i] = rect { 28 * i - 62, 0, 12, 340 } end
MAN = MAN | clip(union(STRIPES):paint(mood.sky[1]), MAN)
local WOMAN = cut.piece("M-52 16 C-26 0 26 0 52 16 L74 270 C40 286 -40 286 -74 270 Z", mood.accent)
  | cut.strip("M-22 280 L-22 318", 22, SKIN) | cut.strip("M22 280 L22 318", 22, SKIN)
local FACE = cut.disc(0, -40, 46, SKIN)
local CAP = cut.piece("M-50 -58 C-44 -104 44 -104 50 -58 L86 -6 L70 0 C60 -36 20 -66 -50 -58 Z",
  mood.near) | cut.disc(80, 4, 13, mood.light)
local CURLS = cut.disc(-38, -72, 17, WOOD) | cut.disc(38, -72, 17, WOOD)
  | cut.disc(-14, -88, 18, WOOD) | cut.disc(16, -88, 18, WOOD)
local BEARD = cut.piece("M-26 -22 C-14 -34 -4 -30 0 -26 C4 -30 14 -34 26 -22 C14 -14 -14 -14 "
  .. "-26 -22 Z", WOOD)

local SHEET = cut.piece("M52 286 C150 262 300 262 398 286 L406 610 L44 610 Z", mood.light)
  | cut.piece("M50 280 C150 256 300 256 400 280 L402 322 C300 302 150 302 48 322 Z", mood.sky[1])
local CAT = cut.piece("M190 470 C190 430 270 424 286 462 C300 496 264 516 232 514 C204 512 188 494 "
  .. "190 470 Z", mood.ink) | cut.piece("M196 470 L188 444 L208 452 L224 450 L240 438 L238 468 "
  .. "C232 486 202 486 196 470 Z", mood.ink)
  | cut.strip("M270 500 C240 520 216 510 206 498", 11, mood.ink)
local FISTS = cut.disc(-26, 276, 15, SKIN) | cut.disc(26, 276, 15, SKIN)

--- Eyes and mouth; state: "asleep", "cold" or "cross".
local function eyes(state)
  local function eye(x)
    if state == "asleep" then
      return stroke { d = ("M%g -42 q10 9 20 0"):format(x - 10), width = 4.5 }
    elseif state == "cold" then
      return circle { x, -42, 7 }
    end
    local brow = stroke { points = { { x * 1.7, -56 }, { x * 0.4, -48 } }, width = 5 }
    return circle { x, -38, 6 } | brow
  end
  return (eye(-17) | eye(17)):paint(mood.ink)
end

local function sleeper(x, body, head, state, shiver)
  return union { body, FACE, head, eyes(state) }:translate(x + shiver, 232)
end

-- Two drawings each: how far the sheet is pulled, how far it has risen, him and her.
local ZZ, COLD, PULL = "asleep", "cold", "cross"
local ACTS = { { 0, 0, ZZ, ZZ }, { 0, 0, ZZ, ZZ }, { 0, -6, ZZ, ZZ }, { 0, -6, ZZ, ZZ },
  { 0, 0, ZZ, ZZ }, { 0, 0, PULL, ZZ }, { -96, 4, PULL, ZZ }, { -104, 0, ZZ, ZZ },
  { -104, 0, ZZ, COLD }, { -104, 0, ZZ, COLD }, { -104, 0, ZZ, COLD }, { -104, 0, ZZ, COLD },
  { -104, 0, ZZ, PULL }, { 96, 4, ZZ, PULL }, { 104, 0, ZZ, ZZ }, { 104, 0, COLD, ZZ },
  { 104, 0, COLD, ZZ }, { 104, 0, COLD, ZZ }, { 104, 0, COLD, ZZ }, { 104, 0, PULL, ZZ },
  { 0, 0, PULL, PULL }, { 0, 0, PULL, PULL }, { 0, 0, PULL, PULL }, { 0, 0, ZZ, ZZ } }

return window.film { title = "One sheet", by = "cp", seconds = 4, pane = "plain",
  drawing = function(_, number)
    local step = number // 2
    local pulled, up, him, her = table.unpack(ACTS[step + 1])
    local shiver = step % 2 == 0 and 3 or -3
    local list = { ROOM, sleeper(138, MAN, CAP | BEARD, him, him == COLD and shiver or 0),
      sleeper(312, WOMAN, CURLS, her, her == COLD and shiver or 0),
      cut.laid(SHEET | CAT:translate(0, up)):translate(pulled, up) }
    local his, hers = math.max(138, 82 + pulled), math.min(312, 368 + pulled)
    if him == PULL then list[#list + 1] = cut.laid(FISTS:translate(his, 0)) end
    if her == PULL then list[#list + 1] = cut.laid(FISTS:translate(hers, 0)) end
    return list
  end }
