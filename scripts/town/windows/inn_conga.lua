-- The inn: a conga in paper hats goes through the room for ever, and the last one is a dog.
local window = require "town.window"
local cut = require "town.cutout"
local mood = require("stage.moods").harvest

local SKIN, WINE, CREAM, WALL = "#e2a878", "#8f2f2a", mood.light, mood.sky[2]

local ROOM = rect { 0, 0, 900, 600, fill = WALL } | rect { 0, 396, 900, 204, fill = mood.far }
  | rect { 0, 392, 900, 6, fill = CREAM } | rect { 0, 520, 900, 80, fill = mood.ground }
for i = 0, 8 do
  local x, y = 6 + 100 * i, 20
  ROOM = ROOM | cut.laid(cut.piece(("M%g %g l84 0 l-42 52 Z"):format(x, y),
    ({ WINE, CREAM, mood.accent })[i % 3 + 1]))
end
ROOM = ROOM | cut.laid(cut.piece("M330 396 C316 360 316 310 330 276 L430 276 C444 310 444 360 "
  .. "430 396 Z", mood.near)) | rect { 322, 300, 116, 8, fill = mood.ink }
  | rect { 322, 364, 116, 8, fill = mood.ink }

local function head(x, y, nose)
  return cut.piece(("M%g %g c28 0 40 16 42 34 l%g 10 l-16 8 c-2 20 -16 26 -30 26 c-26 0 -38 -18 "
    .. "-38 -38 c0 -24 18 -40 42 -40 Z"):format(x, y, nose), SKIN)
    | circle { x + 22, y + 32, 4, fill = mood.ink }
end

local function leg(fill)
  return cut.strip("M0 0 L0 92", 20, fill)
    | cut.piece("M-12 84 L10 84 L34 104 L34 112 L-12 112 Z", mood.ink)
end

--- Who dances: how far behind the first, how high the hips over the floor at 0, then body, head,
--- arm, hat and legs.
local DANCERS = {
  { 0, 108, cut.piece("M-18 -300 L30 -300 C70 -270 84 -190 66 -96 L-60 -96 C-66 -190 -50 -270 "
    .. "-18 -300 Z", WINE) | cut.piece("M34 -256 C72 -220 78 -150 62 -100 L0 -100 C14 -150 18 -210 "
    .. "34 -256 Z", CREAM), head(8, -372, 18), cut.strip("M-4 -262 L40 -210 L104 -262", 22, WINE)
    | cut.disc(110, -270, 17, SKIN), cut.piece("M-22 -358 L6 -446 L42 -360 Z", mood.accent),
    leg(mood.near) },
  { 216, 108, cut.piece("M-16 -252 L22 -252 C36 -210 46 -150 68 -72 L-76 -72 C-50 -150 -36 -210 "
    .. "-16 -252 Z", mood.accent), head(4, -322, 14) | cut.disc(-36, -300, 18, CREAM),
    cut.strip("M0 -222 L70 -206 L156 -242", 18, mood.accent) | cut.disc(160, -244, 14, SKIN),
    cut.piece("M-28 -312 L-34 -352 L-10 -334 L6 -366 L22 -334 L44 -350 L38 -312 Z", CREAM),
    leg(CREAM) },
  { 420, 108, cut.piece("M-20 -330 L22 -332 L40 -240 L40 -96 L-44 -96 L-40 -240 Z", mood.near)
    | cut.piece("M22 -322 L40 -240 L40 -200 L16 -300 Z", CREAM), head(4, -402, 26),
    cut.strip("M-2 -292 L80 -216 L150 -226", 18, mood.near) | cut.disc(158, -226, 14, SKIN),
    cut.piece("M-30 -388 L-20 -428 L32 -428 L40 -386 Z", WINE), leg(mood.ground) },
  { 600, 70, cut.piece("M-10 -190 C24 -186 40 -150 36 -60 L-40 -56 C-50 -110 -40 -170 -10 -190 Z",
    CREAM) | cut.strip("M-40 -70 C-74 -80 -84 -106 -80 -130", 13, CREAM),
    cut.piece("M-28 -252 L14 -262 L34 -234 L74 -220 L70 -200 L28 -190 C0 -176 -28 -190 -32 -216 Z",
    CREAM) | cut.piece("M-22 -250 C-48 -240 -54 -200 -44 -182 C-24 -190 -12 -222 -8 -248 Z",
    mood.ground) | circle { 22, -230, 4, fill = mood.ink }
    | circle { 70, -214, 7, fill = mood.ink },
    cut.strip("M6 -158 L60 -150 L124 -170", 16, CREAM),
    cut.piece("M-20 -248 L2 -312 L20 -256 Z", mood.accent), leg(CREAM):scale(1, 0.62) } }

--- A dancer with legs at two angles; heads go forward by peck, hats up by hop.
local function dancer(who, near, far, peck, hop)
  local _, hips, body, face, arm, hat, limb = table.unpack(who)
  return cut.laid(union { limb:rotate(far, 0, 0):translate(-16, -hips),
    limb:rotate(near, 0, 0):translate(18, -hips), body, face:translate(peck, 0),
    hat:translate(peck, -hop), arm })
end

-- The six drawings of a beat: how far it has gone, and how high they hop.
local GONE, HOP = { 0, 0, 0, 0, 0.5, 0.5 }, { 0, 0, 0, 0, 16, 16 }

return window.film { title = "The inn", by = "cp", seconds = 4, size = { 900, 600 },
  pane = "shop", drawing = function(_, number)
    local beat, part = number // 6, number % 6 + 1
    local list = { ROOM }
    for i = #DANCERS, 1, -1 do
      local step = beat + (part > 4 and 1 or 0)
      local side, kick = step % 2 == 0 and 1 or -1, step % 4 == 3
      local near, far = -20 * side, 20 * side
      if kick then near, far = -64, 0 end
      local shown = dancer(DANCERS[i], near, far, 5 * side, kick and 26 or 0)
      local x = 730 - DANCERS[i][1] + 150 * (beat + GONE[part])
      for place = x - 1200, x, 1200 do
        if place > -200 and place < 1050 then
          list[#list + 1] = shown:translate(place, 536 - HOP[part])
        end
      end
    end
    return list
  end }
