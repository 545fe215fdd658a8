-- A kitchen of cut paper, with a cook, a pan and a pancake, in the colours of a mood.
--
--   local kitchen = require "town.kitchen" (moods.harvest)
--   { kitchen.room, kitchen.cook(-20, 448), kitchen.pan(448) }
local cut = require "town.cutout"

local SKIN, CREAM, BATTER = "#e2a878", "#fff3cf", "#f0c260"

local FACE = cut.piece("M92 250 L160 250 L164 278 L184 290 L166 300 C164 322 150 334 128 334 "
  .. "C104 334 90 314 90 290 Z", SKIN)
local HAT = cut.piece("M94 256 L90 222 C58 214 62 168 96 170 C104 138 150 140 156 168 C192 168 "
  .. "194 212 162 222 L160 256 Z", CREAM)
local CAKE = cut.piece("M-58 0 C-50 -16 50 -16 58 0 C48 14 -48 14 -58 0 Z", BATTER)
local STUCK = {
  cut.piece("M-70 0 L70 0 C74 16 40 14 30 18 C10 26 -10 16 -30 20 C-50 22 -74 14 -70 0 Z", BATTER),
  cut.piece("M-64 0 L62 0 C70 26 44 18 32 26 C16 46 -8 44 -24 24 C-44 16 -70 24 -64 0 Z", BATTER),
  cut.piece("M-44 0 L40 0 C56 30 40 30 30 46 C14 78 -16 76 -28 44 C-44 24 -56 24 -44 0 Z", BATTER) }

--- Room and stove.
local function room(mood)
  local art = rect { 0, 0, 450, 600, fill = mood.far } | rect { 0, 420, 450, 180, fill = mood.near }
    | rect { 0, 414, 450, 6, fill = CREAM }
    | cut.laid(cut.piece("M0 0 L450 0 L450 78 L0 80 Z", CREAM))
  for _, spot in ipairs { { 110, 40 }, { 206, 24 }, { 408, 26 } } do -- earlier pancakes
    art = art | ellipse { spot[1], 66, spot[2], 8, fill = BATTER }
  end
  art = art | cut.laid(cut.piece("M236 486 L440 486 L440 600 L236 600 Z", mood.ink))
    | cut.laid(cut.piece("M262 512 L414 512 L414 590 L262 590 Z", mood.near))
  art = art | cut.laid(cut.strip("M262 178 L470 178", 7, mood.ink)) -- a rail with spoons
    | cut.laid(cut.strip("M286 178 L286 262", 7, mood.ink) | cut.disc(286, 270, 17, mood.ink))
    | cut.laid(cut.strip("M394 178 L394 250", 7, mood.near)
      | cut.piece("M372 246 L418 246 C418 290 372 290 372 246 Z", mood.near))
  for i = 0, 3 do
    art = art | polygon { { 282 + 22 * i, 486 }, { 289 + 22 * i, 470 }, { 296 + 22 * i, 486 },
      fill = mood.sky[1] }
  end
  return art
end

--- The cook, whose hips are behind the sill; look: how many degrees down; his hand is at the pan.
local function cook_of(mood)
  local body = cut.piece("M92 314 C130 296 164 308 180 346 C196 400 200 500 206 600 L36 600 "
    .. "C34 500 44 350 92 314 Z", CREAM)
    | cut.piece("M116 346 L164 350 C182 420 190 500 194 600 L112 600 Z", mood.accent)
  local head = FACE | circle { 148, 276, 4.5, fill = mood.ink }
    | cut.piece("M128 316 C142 296 154 296 162 304 C172 296 184 304 196 318 C180 314 170 320 "
      .. "162 314 C152 324 136 324 128 316 Z", mood.ink) | HAT
  return function(look)
    return (cut.laid(body | head:rotate(look, 118, 318)) | cut.pin(118, 324)):translate(22, 0)
  end
end

--- A pancake whose middle is at x, y; degrees and squash may be left out.
local function cake(x, y, degrees, squash)
  return cut.laid(CAKE:scale(1, squash or 1):rotate(degrees or 0, 0, 0):translate(x, y))
end

return function(mood)
  local iron = cut.piece("M-62 -14 L62 -14 L50 14 L-50 14 Z", mood.ink)
    | cut.strip("M-60 -4 L-128 -14", 11, mood.near)
  return { room = room(mood), cook = cook_of(mood), cake = cake,
    --- The pan at the height y, with the cook's arm or without.
    pan = function(y, alone)
      if alone then return cut.laid(iron:translate(330, y)) end
      local arm = cut.strip(("M180 350 L%g %g L%g %g"):format(190, y + 4, 214, y - 12), 26, CREAM)
        | cut.disc(216, y - 14, 17, SKIN)
      return cut.laid(iron:translate(330, y) | arm)
    end,
    --- A pancake on the ceiling at x, from flat, 1, to a large drop, 3.
    stuck = function(x, drop) return cut.laid(STUCK[drop]:translate(x, 77)) end }
end
