-- The laundry: washing in a warm wind. When it is calm, one of the sheets looks round and dances.
local window = require "town.window"
local cut = require "town.cutout"
local mood = require("stage.moods").fog

local ROPE = cut.strip("M-20 132 C200 164 400 164 620 132", 5, mood.ink)
local TUB = cut.laid(cut.piece("M24 452 L176 452 L162 572 L38 572 Z", "#a9673f"))
  | cut.laid(cut.piece("M14 438 L186 438 L184 462 L16 462 Z", "#c98a55"))
local BASKET = cut.laid(cut.piece("M448 500 L572 500 L560 574 L462 574 Z", "#b99a68"))
  | cut.laid(cut.piece("M440 488 L580 488 L580 508 L440 508 Z", "#d3b985"))
local ROOM = rect { 0, 0, 600, 600, fill = mood.near }
  | rect { 0, 420, 600, 180, fill = mood.ground }
  | rect { 0, 416, 600, 5, fill = mood.far } | rect { 0, 540, 600, 60, fill = mood.ink }
  | cut.laid(ROPE) | TUB | BASKET

local function peg(x, y)
  return cut.laid(cut.piece("M-6 -16 L6 -16 L5 16 L1 4 L-4 16 Z", "#b99a68"):translate(x, y))
end

local SHIRT = cut.piece("M66 150 L150 154 L154 300 L164 360 L146 344 L138 286 L140 390 L66 388 "
  .. "L70 284 L58 350 L40 362 L54 290 Z", mood.far)
  | cut.piece("M90 152 L128 154 L108 186 Z", mood.ground)
local JOHNS = cut.piece("M446 154 L540 148 L548 240 L554 372 L522 374 L504 262 L482 376 L448 372 "
  .. "L446 250 Z", mood.sky[2])
for i = 0, 2 do JOHNS = JOHNS | circle { 494, 176 + 24 * i, 4, fill = mood.ground } end

--- The sheet in the middle; blow: how far the wind lifts its hem to the right.
local function sheet(blow)
  local x, y = 84 * blow, 476 - 34 * math.abs(blow)
  return cut.piece(("M200 156 Q300 166 400 156 C%g 250 %g 350 %g %g q-26 %g -52 4 q-26 20 -52 2 "
    .. "q-26 -20 -52 -2 q-26 20 -%g 2 C%g 360 196 260 200 156 Z"):format(402 + 0.5 * x, 394 + x,
    402 + x, y, -20, 52, 190 + 0.9 * x), mood.light)
end
local SHEETS = {}
for i = 0, 6 do SHEETS[i - 3] = sheet((i - 3) / 3) end
local GHOST = cut.piece("M204 160 C230 150 230 92 300 90 C370 92 370 150 396 160 C402 260 412 380 "
  .. "424 470 q-22 -18 -42 0 q-20 18 -42 0 q-20 -18 -40 0 q-20 18 -40 0 q-20 -18 -42 0 "
  .. "q-20 18 -42 0 C188 380 198 260 204 160 Z", mood.light)
local SHOE = cut.piece("M-20 0 L-20 -34 L8 -36 C10 -20 44 -26 46 0 Z", mood.accent)
local LEG = cut.strip("M-6 -130 L-6 -30", 14, mood.ink)

--- One of two feet; side: -1 or 1; up: how far it is lifted.
local function foot(side, up)
  return cut.laid((LEG | SHOE):scale(side, 1):rotate(-26 * side * up)
    :translate(300 + (34 + 16 * up) * side, 552 - 34 * up))
end

--- Two holes for the eyes; look: -1 to the left, 1 to the right.
local function eyes(look, open)
  local function eye(x)
    return ellipse { x, 168, 15, 24 * open, fill = mood.ink }
      | circle { x + 7 * look, 168 + 6 * open, 5, fill = mood.light }
  end
  return (eye(272) | eye(328)):translate(8 * look, 0)
end

local function ghost(look, hop)
  return foot(-1, math.max(0, hop)) | foot(1, math.max(0, -hop))
    | cut.laid(GHOST | eyes(look, 1)):rotate(4 * hop, 300, 470)
      :translate(0, -14 * math.abs(hop))
end

-- The wind in each drawing, at first; then where the ghost looks, and which foot it lifts.
local WIND = { 1, 2, 3, 3, 3, 2, 2, 1, 0, -1, -1, 0 }
local LOOKS = { { -1, 0 }, { -1, 0 }, { 1, 0 }, { 1, 0 }, { 0, 1 }, { 0, 0 }, { 0, -1 }, { 0, 0 },
  { 0, 1 }, { 0, 0 }, { 0, -1 }, { -1, 0 } }

return window.film { title = "The laundry", by = "cp", seconds = 4, size = { 600, 600 },
  pane = "round", drawing = function(_, number)
    local step = number // 2
    local wind, late = WIND[step + 1] or 0, WIND[step] or 0
    local look = LOOKS[step - #WIND + 1]
    local middle = look and ghost(look[1], look[2])
      or foot(-1, 0) | foot(1, 0) | cut.laid(SHEETS[wind])
    if step == #WIND - 1 then middle = middle | eyes(1, 0.5):translate(0, 30) end
    local lift = look and -6 or 0
    return { ROOM, cut.laid(SHIRT:skew(-7 * wind, 0, 108, 150)), peg(80, 148), peg(136, 152),
      cut.laid(JOHNS:skew(-7 * late, 0, 494, 150)), peg(462, 152), peg(526, 146),
      middle, peg(214, 152 + lift), peg(386, 152 + lift) }
  end }
