-- Two commuters asleep in the tram: their heads nod apart and meet, and only the hats notice.
local window = require "town.window"
local mood = require("stage.moods").candle

--- In twelve drawings, degrees by which both lean towards each other.
local nod = keys { { 0, 6 }, { 1, -4 }, { 2, -12 }, { 3, -18 }, { 4, -20 }, { 6, -20 }, { 7, -12 },
  { 8, -4 }, { 9, 10 }, { 10, 24 }, { 11, 18 } }

local EYES = path { d = "M-42 -114 Q-27 -92 -12 -114 Q-27 -102 -42 -114 Z "
  .. "M12 -114 Q27 -92 42 -114 Q27 -102 12 -114 Z" }
local LONG = path { d = "M-30 40 C-34 0 -58 -40 -58 -100 C-60 -180 58 -180 58 -100 "
    .. "C58 -40 34 0 30 40 Z" }
local ROUND = path { d = "M-40 40 C-92 10 -84 -60 -72 -100 C-64 -176 64 -176 72 -100 "
    .. "C84 -60 92 10 40 40 Z" }
local MOUSTACHE = path { d = "M0 -74 C14 -86 44 -80 62 -50 C40 -58 16 -52 0 -60 "
  .. "C-16 -52 -40 -58 -62 -50 C-44 -80 -14 -86 0 -74 Z" }
local SMILE = path { d = "M-24 -52 Q0 -28 24 -52 Q0 -40 -24 -52 Z" }
local BOWLER = path { d = "M-98 0 C-80 -14 -66 -8 -62 -12 C-66 -90 66 -90 62 -12 "
  .. "C66 -8 80 -14 98 0 C60 16 -60 16 -98 0 Z" } - rect { -61, -26, 122, 9 }
local WOOL = (path { d = "M-72 10 C-74 -70 -30 -96 0 -98 C30 -96 74 -70 72 10 Z" }
  | circle { 0, -106, 24 }) - rect { -76, -22, 152, 8 }
local COATS = path { d = "M0 600 C10 470 60 420 150 410 H230 C280 412 300 440 300 470 "
  .. "C300 440 330 400 380 396 H460 C550 404 596 480 600 600 Z" }
local AMBER = "#e0862b"
local LIGHT = rect { 0, 0, 600, 600, fill = AMBER } | circle { 300, 236, 124, fill = "#fff4d8" }
local RAIL = rect { 0, 44, 600, 14 }
local STRAP = path { rule = "evenodd", d = "M-6 20 H6 V110 L30 150 H-30 L-6 110 Z "
  .. "M0 122 L-12 142 H12 Z" }

--- A head on its neck at (x, y), by degrees; and a hat on it.
local function on(object, x, y, degrees, up)
  return object:translate(0, up or 0):rotate(degrees):translate(x, y)
end

return window.film { title = "Asleep in the tram", by = "in", seconds = 4, size = { 600, 600 },
  pane = "round", drawing = function(_, number)
    local step = number // 2
    local n = step % 12
    local lean, swing = nod:at(n), 8 * math.sin(2 * math.pi * step / 6)
    local hats = (step + 1) // 12 % 2 == 0 and { BOWLER, WOOL } or { WOOL, BOWLER }
    local parts = { COATS, RAIL, on(LONG, 186, 410, lean), on(ROUND, 414, 410, -lean) }
    if n == 11 then -- both hats are in the air
      parts[5] = on(hats[1], 340, 130, 30) | on(hats[2], 250, 210, -24)
    else
      parts[5] = on(hats[1], 186, 410, lean, -146) | on(hats[2], 414, 410, -lean, -140)
    end
    for i = 0, 2 do parts[6 + i] = STRAP:translate(80 + 220 * i + swing, 0) end
    local faces = on(EYES | MOUSTACHE, 186, 410, lean) | on(EYES | SMILE, 414, 410, -lean)
    return { LIGHT, union(parts):paint(mood.ink), faces:paint(AMBER) }
  end }
