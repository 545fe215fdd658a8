-- An aquarium: a fish as large as the tank turns by folding in half; a diver of tin has one bubble.
local window = require "town.window"
local cut = require "town.cutout"
local diver = require "town.diver"
local mood = require("stage.moods").noon

local TANK = rect { 0, 0, 450, 600, fill = mood.sky[3] }
  | cut.laid(cut.piece("M-10 84 C60 66 100 96 170 82 C240 66 300 98 360 80 C400 70 430 84 460 78 "
    .. "L460 620 L-10 620 Z", mood.sky[2]))
for i, weed in ipairs { "M52 560 C20 500 80 450 46 390 C30 350 66 330 58 300",
  "M96 570 C120 520 76 490 98 440", "M404 560 C430 500 380 470 410 400 C424 360 396 350 "
  .. "402 330" } do
  TANK = TANK | cut.laid(cut.strip(weed, 24 - 4 * i, mood.near))
end
local SAND = cut.laid(cut.piece("M-10 522 C70 500 140 536 230 524 C310 512 380 540 460 516 "
  .. "L460 620 L-10 620 Z", mood.ground))

-- The two halves of the fish, which looks to the right; they meet at x = 0.
local TAIL = cut.piece("M0 -122 C-60 -120 -112 -62 -134 -22 L-188 -96 C-170 -30 -172 34 -190 98 "
  .. "L-132 26 C-104 74 -60 114 0 118 Z", mood.accent)
  | cut.piece("M-52 -108 C-34 -40 -34 40 -54 102 C-70 92 -84 78 -94 68 C-76 20 -76 -30 -92 -70 "
    .. "C-80 -86 -66 -100 -52 -108 Z", mood.light)
local HEAD = cut.piece("M0 -122 C70 -116 140 -64 172 -8 L144 6 L168 22 C140 74 70 114 0 118 Z",
  mood.accent)
  | cut.piece("M26 -117 L64 -102 C44 -40 44 40 66 98 L28 112 C8 40 8 -40 26 -117 Z", mood.light)
  | cut.disc(106, -34, 21, mood.light)
local FIN = cut.piece("M0 0 C-50 -16 -84 6 -92 48 C-54 56 -14 44 0 0 Z", "#c23a1e")
local CREASE = stroke { points = { { 0, -118 }, { 0, 116 } }, width = 3, dash = { 12, 9 },
  fill = "#c23a1e" }

--- The fish; head and tail: how broad either half is, from 1, unfolded, to -1, turned over; look:
--- where its eye is; fin: how far its fin is turned.
local function fish(head, tail, look, fin)
  local function half(art, share)
    return art:scale(share, 1):skew(0, 7 * (1 - math.abs(share)), 0, 0)
  end
  local front = half(HEAD | circle { 108, -34 + 7 * look, 9, fill = mood.ink }, head)
  local back = half(TAIL, tail)
  local whole = back | front
  if head * tail > 0 and math.abs(head) == 1 and math.abs(tail) == 1 then whole = whole | CREASE end
  if head * tail < 0 then return cut.laid(whole) end
  return cut.laid(whole | FIN:rotate(fin, 0, 0):scale(tail, 1):translate(14 * head, 20))
end

local BUBBLE = cut.piece("M0 -20 a20 20 0 0 1 0 40 a20 20 0 0 1 0 -40 Z", mood.sky[3])
  | circle { -6, -6, 4, fill = mood.light }

-- Both halves as they fold: the head comes over, then the tail goes out.
local FOLDS = { { 1, 1 }, { 0.45, 1 }, { -0.45, 1 }, { -1, 1 }, { -1, 0.45 }, { -1, -0.45 },
  { -1, -1 } }

return window.film { title = "The aquarium", by = "cp", seconds = 4, pane = "plain",
  drawing = function(_, number)
    local step = number // 2
    local fold = math.min(math.max(step - 2, 0), 6) - math.min(math.max(step - 16, 0), 6)
    local head, tail = FOLDS[fold + 1][1], FOLDS[fold + 1][2]
    local rise = math.max(0, step - 9)
    local look = step > 8 and step < 17 and 1 - (step - 9) / 3 or 0
    local fin = step % 4 < 2 and 0 or 22
    local list = { TANK, diver:translate(130, 440), SAND }
    list[4] = fish(head, tail, math.max(-1, look), fin):translate(225 + 20 * (1 - fold / 3), 268)
    if rise > 0 and rise < 12 then
      local bubble = rise == 11 and BUBBLE:scale(1.5, 0.3, 0, 0) or BUBBLE
      list[5] = bubble:translate(96 + 6 * (rise % 2), 410 - 31 * rise)
    end
    return list
  end }
