-- The paper theatre: two hands, a wolf and a moon on strings. He howls, and she hides.
local window = require "town.window"
local cut = require "town.cutout"
local mood = require("stage.moods").candle

local CURTAIN, LIT, SKIN = "#8c2f1d", "#e8a24c", "#e3b088"

local function fold(x, side)
  return cut.laid(cut.piece(("M%g 190 L%g 190 C%g 320 %g 420 %g 520 L%g 520 Z"):format(x,
    x + 62 * side, x + 60 * side, x + 10 * side, x + 30 * side, x), CURTAIN))
end

local ROOM = rect { 0, 0, 450, 600, fill = mood.sky[2] }
  | rect { 42, 180, 366, 350, fill = LIT }
  | cut.laid(cut.piece("M40 452 C110 410 170 414 236 452 C290 400 360 410 412 440 L412 530 "
    .. "L40 530 Z", "#c47a35"))
local HILL = cut.laid(cut.piece("M226 540 C252 450 286 404 326 402 C362 404 382 440 404 470 "
  .. "L404 540 Z", mood.near))
local FRONT = cut.laid(cut.piece("M34 498 L416 498 L416 585 L34 585 Z", mood.far))
for i = 0, 6 do
  FRONT = FRONT
    | cut.laid(cut.piece(("M%g 524 a18 18 0 0 1 36 0 Z"):format(57 + 50 * i), mood.light))
end
local STAGE = fold(38, 1) | fold(412, -1) | FRONT | cut.laid(cut.piece("M30 158 L420 158 L420 200 "
  .. ("q-32.5 50 -65 0 "):rep(6) .. "Z", mood.accent))

-- The wolf sits on the floor at y = 510; his neck is pinned at (150, 322).
local TAIL = cut.piece("M100 500 C72 500 58 480 58 444 C68 424 80 430 80 446 C82 466 96 474 "
  .. "114 478 Z", mood.ink)
local BODY = cut.piece("M178 304 C202 340 206 390 196 440 L202 494 L226 504 L226 512 L168 512 "
  .. "L168 450 C158 470 158 490 168 512 L88 512 C68 476 74 424 100 388 C120 358 124 330 126 304 Z",
  mood.ink)
local CHEST = cut.piece("M168 332 C186 344 192 372 190 396 L182 386 L178 404 L170 388 L162 400 "
  .. "C158 376 158 346 168 332 Z", mood.near)
local HEAD = cut.piece("M122 336 L114 286 L108 226 L136 254 L166 256 L204 278 L242 288 L240 302 "
  .. "L194 312 L172 342 Z", mood.ink)
local EAR = cut.piece("M142 264 L152 216 L174 262 Z", mood.ink)
local JAW = cut.piece("M170 304 L230 306 L220 320 L176 332 Z", CURTAIN)
local HAND = cut.piece("M-26 -84 L26 -84 L34 -36 L34 -4 q-9 16 -17 2 q-9 20 -17 2 q-9 18 -17 0 "
  .. "q-10 12 -17 -4 L-48 -22 q-8 -16 6 -18 L-34 -36 Z", SKIN)
local CUFF = cut.piece("M-34 -72 L34 -72 L42 -150 L-42 -150 Z", CURTAIN)
local STICK = cut.strip("M-70 -10 L70 -10", 9, mood.near)

local function thread(x, y, to_x, to_y)
  return stroke { points = { { x, y }, { to_x, to_y } }, width = 1.6, fill = cut.WHITE }
end

local function hand(x, y)
  return cut.laid(union { STICK, HAND, CUFF }:translate(x, y))
end

local function wolf(nod, jaw, tail)
  local function turned(part) return part:rotate(nod, 150, 322) end
  local eye = jaw > 8 and path { d = "M162 278 q9 8 20 3 l-1 5 q-12 4 -19 -8 Z" }:paint(mood.light)
    or path { d = "M160 284 L168 270 L184 284 Z" }:paint(mood.light) | circle { 172, 280, 3.5 }
  return union { cut.laid(TAIL:rotate(tail, 98, 490)), cut.laid(BODY), CHEST,
    cut.laid(turned(union { EAR, JAW:rotate(jaw, 176, 314), HEAD, eye })), cut.pin(150, 322) }
end

local MOON = cut.laid(cut.disc(0, 0, 40, "#fff3d6"))
local function moon(x, y, wide)
  local face = circle { -18, -6, 3 + 3 * wide } | circle { 8, -6, 3 + 3 * wide }
    | ellipse { -5, 14, 6 + 2 * wide, 1.6 + 8 * wide }
  return (MOON | face:paint(mood.near)):translate(x, y)
end

-- The wolf's head, jaw and tail, the height of the moon, and how far her mouth is open.
local acts = keys { { 4, { -10, 0, 0, 276, 0 } }, { 8, { 14, 0, -16, 276, 0 }, "outSine" }, { 10,
  { 14, 0, -16, 276, 0 } }, { 13, { -54, 28, 12, 276, 1 }, "inOutSine" }, { 20,
  { -54, 28, 12, 276, 1 } }, { 24, { -54, 27, 12, 480, 1 }, "inQuad" }, { 27,
  { 16, 0, 0, 480, 1 }, "outQuad" }, { 31, { 16, 0, 0, 480, 1 } }, { 33, { 16, 0, 0, 396, 0 } },
  { 38, { 16, 0, 0, 396, 0 } }, { 45, { -10, 0, 0, 276, 0 }, "inOutSine" } }

return window.film { title = "The paper theatre", by = "cp", seconds = 4, pane = "plain",
  drawing = function(_, number)
    local nod, jaw, tail, height, wide = table.unpack(acts:at(number - number % 2))
    if jaw > 26 then nod = nod + 6 * (number // 2 % 2) end
    local pull, low = -0.4 * math.min(0, nod), 0.16 * (height - 276)
    local turn = math.rad(nod)
    local nose_x = 150 + 66 * math.cos(turn) + 40 * math.sin(turn)
    local nose_y = 322 + 66 * math.sin(turn) - 40 * math.cos(turn)
    return { ROOM, thread(318, 100 + low, 318, height - 40), moon(318, height, wide), HILL,
      thread(94, 100 - pull, 94, 400), thread(190, 100 - pull, nose_x, nose_y),
      wolf(nod, jaw, tail), STAGE, hand(142, 110 - pull), hand(318, 104 + low) }
  end }
