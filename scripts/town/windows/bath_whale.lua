-- A whale in the bath of a flat that is much too small: its fountain lifts a shower cap.
local window = require "town.window"
local cut = require "town.cutout"
local mood = require("stage.moods").fog

local SKIN, BELLY, WATER, COPPER = "#3f6273", "#dfe3d6", "#a9cfd6", "#b0703e"

local ROOM = rect { 0, 0, 450, 600, fill = mood.sky[2] }
  | rect { 0, 330, 450, 270, fill = mood.far }
  | rect { 0, 326, 450, 6, fill = mood.light } | rect { 0, 536, 450, 70, fill = mood.ground }
  | cut.laid(cut.piece("M-10 0 L460 0 L460 62 L-10 66 Z", mood.sky[3]))
  | cut.laid(cut.piece("M30 240 L96 236 L92 330 L74 322 L60 334 L34 328 Z", "#d9b45a"))
  | cut.laid(cut.piece("M22 232 L106 230 L106 240 L22 242 Z", COPPER))
-- The wall to the next flat, and the hole that the tail has made.
local WALL = cut.laid(cut.piece("M404 0 L460 0 L460 610 L404 610 L404 440 L424 424 L412 404 "
  .. "L436 392 L420 366 L434 340 L410 330 L424 312 L404 300 Z", mood.near))
local WHALE = cut.piece("M38 400 C24 300 84 226 190 226 C304 226 344 312 400 340 C420 350 440 340 "
  .. "470 336 L470 404 C440 410 410 420 380 440 L360 520 L70 520 C52 480 42 440 38 400 Z", SKIN)
  | cut.piece("M35 380 C80 406 150 412 214 384 C232 440 216 490 190 524 L70 524 C50 480 38 440 "
    .. "35 380 Z", BELLY)
for i = 0, 2 do
  WHALE = WHALE | stroke { d = ("M%g %g C%g 440 %g 460 %g 500"):format(78 + 38 * i, 408 + 4 * i,
    84 + 36 * i, 90 + 34 * i, 96 + 30 * i), width = 3, fill = mood.far }
end
local FLIPPER = cut.piece("M0 0 C40 -6 76 20 88 66 C50 74 8 50 0 0 Z", "#33505f")

local TUB = cut.laid(cut.piece("M28 452 L422 452 C418 510 392 548 340 550 L110 550 C58 548 32 510 "
  .. "28 452 Z", mood.light))
  | cut.laid(cut.piece("M16 440 L434 440 L434 460 L16 460 Z", mood.sky[3]))
for _, x in ipairs { 96, 330 } do
  local claw = cut.piece("M0 0 C-14 20 -18 34 -22 44 L6 44 L26 0 Z", COPPER)
  TUB = cut.laid(claw:translate(x, 536)) | TUB
end
for _, foam in ipairs { { 236, 436, 22 }, { 274, 428, 28 }, { 314, 436, 20 }, { 346, 438, 14 } } do
  TUB = TUB | cut.laid(cut.disc(foam[1], foam[2], foam[3], "#fffdf4"))
end

local CAP = cut.piece("M-62 4 C-76 -46 -36 -72 0 -72 C36 -72 76 -46 62 4 q-10 14 -20 2 q-10 14 "
  .. "-22 2 q-10 12 -20 0 q-10 14 -22 0 q-10 12 -20 -2 q-10 8 -20 -6 Z", mood.accent)
  | circle { -28, -36, 7, fill = mood.light } | circle { 4, -50, 7, fill = mood.light }
  | circle { 32, -30, 7, fill = mood.light } | circle { -2, -20, 6, fill = mood.light }
local function spray(height)
  return cut.piece(("M-14 0 L-12 -%g C-20 -%g -52 -%g -58 -%g q-8 14 4 24 q-26 -8 -20 -36 C-70 -%g "
    .. "-20 -%g 0 -%g C20 -%g 70 -%g 74 -%g q8 26 -18 38 q10 -14 2 -26 C48 -%g 18 -%g 14 -%g "
    .. "L16 0 Z"):format(height - 40, height - 20, height - 16, height - 50, height + 4,
      height + 14, height - 4, height + 14, height + 2, height - 52, height - 16, height - 22,
      height - 40), WATER)
end
local FOUNTAINS = { spray(60), spray(112), spray(104):scale(-1, 1) }

-- For two drawings each: how high the whale is, which fountain, where the cap is and its
-- degrees, and the eye: open, squeezed or happy.
local ACTS = { { 0, 0, 0, 0, "open" }, { 2, 0, 0, 0, "open" }, { 0, 0, 0, 0, "open" },
  { -8, 0, -8, 3, "shut" }, { -14, 0, -14, -4, "shut" }, { -16, 0, -16, 4, "shut" },
  { 10, 1, -52, -10, "happy" }, { 12, 2, -104, 14, "happy" }, { 10, 3, -96, 4, "happy" },
  { 12, 2, -106, -12, "happy" }, { 10, 3, -98, -18, "happy" }, { 12, 2, -106, 0, "happy" },
  { 10, 3, -98, 14, "happy" }, { 12, 2, -106, 18, "happy" }, { 8, 1, -100, 6, "open" },
  { 2, 0, -70, -8, "open" }, { 4, 0, 12, 12, "shut" }, { 0, 0, -4, 12, "shut" },
  { 0, 0, 0, 12, "open" }, { 0, 0, 0, 12, "open" }, { 0, 0, 0, 12, "open" },
  { -4, 0, -6, 6, "shut" }, { 0, 0, 0, 0, "open" }, { 0, 0, 0, 0, "open" } }
local EYES = {
  open = circle { 122, 360, 8, fill = mood.light } | circle { 120, 361, 5, fill = mood.ink },
  shut = stroke { d = "M108 354 L124 362 L108 370", width = 5, fill = mood.light },
  happy = stroke { d = "M106 366 Q120 348 134 366", width = 5, cap = "round", fill = mood.light } }

return window.film { title = "A whale in a bath", by = "cp", seconds = 4, pane = "plain",
  drawing = function(_, number)
    local y, fountain, high, degrees, eye = table.unpack(ACTS[number // 2 + 1])
    local list = { ROOM }
    if fountain > 0 then list[2] = cut.laid(FOUNTAINS[fountain]):translate(176, 240 + y) end
    list[#list + 1] = cut.laid((WHALE | EYES[eye]):translate(0, y))
    list[#list + 1] = cut.laid(CAP:rotate(degrees, 0, 0):translate(176, 246 + high + 0.5 * y))
    list[#list + 1] = WALL
    local flipper = FLIPPER:rotate(fountain > 0 and -40 or 10, 0, 0)
    list[#list + 1] = cut.laid(flipper:translate(212, 386 + y))
    list[#list + 1] = TUB
    return list
  end }
