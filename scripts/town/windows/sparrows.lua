-- The bird house: three sparrows under one scarf. One is pushed out, and gets in at the other end.
local window = require "town.window"
local cut = require "town.cutout"
local mood = require("stage.moods").harvest

local FLOOR, SPACE, DOWN = 492, 134, "#c98d55"

local ROOM = rect { 0, 0, 600, 600, fill = mood.near } | rect { 148, 0, 5, 600, fill = mood.ground }
  | rect { 298, 0, 5, 600, fill = mood.ground } | rect { 448, 0, 5, 600, fill = mood.ground }
  | cut.laid(cut.piece("M-10 470 L610 470 L610 610 L-10 610 Z", mood.ground))
local STRAW = cut.laid(cut.piece("M20 520 L70 486 L96 510 L150 478 L190 508 L250 482 L300 512 "
  .. "L352 480 L404 508 L452 480 L500 510 L548 484 L590 524 L590 610 L20 610 Z", mood.sky[2]))

local BALL = cut.piece("M0 -252 C52 -252 78 -214 82 -160 C88 -60 84 0 0 0 C-84 0 -88 -60 -82 -160 "
  .. "C-78 -214 -52 -252 0 -252 Z", DOWN)
local CAP = cut.piece("M0 -252 C50 -252 74 -224 80 -180 C56 -196 26 -204 0 -176 C-26 -204 -56 -196 "
  .. "-80 -180 C-74 -224 -50 -252 0 -252 Z", mood.ground)
local BEAK = cut.piece("M-15 -172 L15 -172 L0 -144 Z", mood.ink)
local WING = cut.piece("M0 0 C40 -20 96 -70 104 -124 C60 -120 8 -80 -14 -20 Z", mood.ground)

--- A sparrow on the floor; look: -1 to 1; open: whether its eyes are; lean: degrees; thin: how
--- broad it is when squeezed.
local function sparrow(x, look, open, lean, thin)
  local function eye(side)
    if not open then
      return stroke { points = { { side - 12, -172 }, { side, -166 }, { side + 12, -172 } },
        width = 5, fill = mood.ink }
    end
    return circle { side, -172, 9, fill = mood.ink }
      | circle { side + 3, -175, 3, fill = mood.light }
  end
  local face = (eye(-34) | eye(34) | BEAK):translate(12 * look, 0)
  return (BALL | CAP | face):scale(thin, 2 - thin):rotate(lean, 0, 0):translate(x, FLOOR)
end

--- The scarf from x to to, as high as the breasts; loose: how far its right end hangs down.
local function scarf(x, to, loose)
  local y = FLOOR - 128
  local wool = cut.piece(("M%g %g C%g %g %g %g %g %g L%g %g l-36 6 L%g %g C%g %g %g %g %g %g "
    .. "L%g %g l-38 -4 Z"):format(x, y, x + 80, y + 34, to - 80, y + 34, to, y, to + 8, y + loose,
      to - 34, y + 56, to - 100, y + 78, x + 100, y + 78, x + 34, y + 52, x + 30, y + 118),
    mood.accent)
  local bars = {}
  for i = 1, 3 do
    local place = x + (to - x) * i / 4
    bars[i] = rect { place - 9, y, 18, 90, fill = mood.light }
  end
  return cut.laid(wool | clip(union(bars), wool))
end

-- Two drawings each: the places of the three birds from the left (0 to 2), the squeeze, how they
-- look and lean, and whether the eyes are open; the third one is drawn behind the others.
local SIT = { { 0, 1, 2 }, 1, 0, 0, true }
local COLD = { { 0.04, 1, 1.96 }, 0.97, 0, -2, false }
local COLDER = { { 0.04, 1, 1.96 }, 0.97, 0, 2, false }
local AIM, PUSH = { { -0.1, 0.94, 2 }, 1, 1, -7, true }, { { 0.33, 1.25, 2.25 }, 0.88, 1, 9, false }
local COSY, CALL = { { 0.1, 1.06 }, 1.05, 0, 0, false }, { { 0.1, 1.06, -1.2 }, 1, -1, 0, true }
local ACTS = { SIT, SIT, COLD, COLDER, COLD, COLDER, AIM, AIM, PUSH,
  { { 0.3, 1.2, 2.7 }, 0.9, 1, 9, false }, { { 0.1, 1.08, 3.4 }, 1, 1, 0, true },
  { { 0.1, 1.08 }, 1, 1, 0, true }, COSY, COSY, COSY, COSY, CALL, CALL,
  { { 0.5, 1.4, -0.5 }, 0.9, -1, 9, false }, { { 1, 2, 0 }, 0.9, 0, 6, true }, SIT, SIT, SIT, SIT }

return window.film { title = "The bird house", by = "cp", seconds = 4, size = { 600, 600 },
  pane = "round", drawing = function(_, number)
    local places, thin, look, lean, open = table.unpack(ACTS[number // 2 + 1])
    local birds, least, most = {}, 9, -9
    for i = #places, 1, -1 do
      local place, eyes, glance = places[i], open, look
      local x = 300 + SPACE * (place - 1)
      if i == 3 and (place > 2.3 or place < -0.3) then
        eyes, glance = true, place > 0 and -1 or 1
        birds[#birds + 1] = WING:translate(x + 60, FLOOR - 110)
          | WING:scale(-1, 1):translate(x - 60, FLOOR - 110)
      else
        least, most = math.min(least, place), math.max(most, place)
      end
      birds[#birds + 1] = sparrow(x, glance, eyes, lean, thin)
    end
    local wool = scarf(210 + SPACE * (least - 1), 390 + SPACE * (most - 1),
      most < 1.5 and 132 or 96)
    local huddle = cut.laid(union(birds)) | wool
    return { ROOM, huddle:scale(1.12, 1.12, 300, FLOOR + 20), STRAW }
  end }
