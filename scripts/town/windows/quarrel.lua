-- Two shadows quarrel, turn away, and hold each other; only the last plate is not forgotten.
local window = require "town.window"
local ink = require "town.silhouette"
local mood = require("stage.moods").candle

--- 32 drawings of three frames: degrees of the body and of the head; the ways that both look, 1 to
--- the other one; where both hands are; how far forwards and how low; whether there is shouting.
local he = keys { { 0, { 8, 4, 1, 1, 108, -276, 60, -110, -6, 0, 1 } },
  { 1, { 10, 6, 1, 1, 112, -236, 60, -110, 0, 0, 1 } },
  { 2, { -5, -10, 1, 1, 90, -130, 60, -100, -6, 0, 0 } },
  { 3, { 14, 0, 1, 1, 86, -330, 100, -190, 4, 0, 1 } },
  { 4, { 10, 6, 1, 1, 92, -310, 104, -150, 4, 0, 1 } },
  { 5, { -4, -6, 1, 1, 80, -150, 90, -130, 0, 0, 0 } },
  { 6, { -6, -12, 1, 1, 90, -280, 120, -200, -4, 0, 0 } },
  { 7, { 6, 22, 1, 1, 30, -340, 80, -320, -6, 120, 0 } },
  { 8, { 6, 22, 1, 1, 30, -340, 80, -320, -6, 126, 0 } },
  { 9, { -4, -14, 1, -1, 70, -140, 70, -120, 0, 50, 0 } },
  { 10, { 0, 0, 1, 1, 100, -140, 70, -120, 0, 0, 1 } },
  { 11, { 0, 4, 0.4, 1, 80, -150, 70, -130, 0, 0, 0 } },
  { 12, { 4, 16, -1, -1, 60, -150, 70, -170, 24, 0, 0 } },
  { 17, { 4, 16, -1, -1, 60, -150, 70, -170, 24, 0, 0 } },
  { 18, { 2, 2, -1, 1, 60, -150, 70, -170, 24, 0, 0 } },
  { 19, { 6, 20, -1, -1, 60, -150, -40, -90, 24, 0, 0 } },
  { 20, { 6, 20, -1, -1, 60, -150, -94, -110, 24, 0, 0 } },
  { 22, { 6, 20, -1, -1, 60, -150, -94, -110, 24, 0, 0 } },
  { 23, { 2, 10, 0.4, 1, 60, -150, 120, -100, 0, 0, 0 } },
  { 24, { 4, 10, 1, 1, 76, -170, 84, -110, 14, 0, 0 } },
  { 25, { 6, 10, 1, 1, 130, -180, 150, -120, 40, 0, 0 } },
  { 28, { 8, 12, 1, 1, 140, -180, 160, -120, 48, 0, 0 } },
  { 29, { 8, 12, 1, 1, 140, -180, 160, -120, 48, 0, 0 } },
  { 30, { 3, 0, 1, -1, 140, -180, 150, -120, 40, 0, 0 } },
  { 31, { -6, -8, 1, 1, 130, -230, 110, -140, 0, 0, 1 } },
  { 32, { 8, 4, 1, 1, 108, -276, 60, -110, -6, 0, 1 } } }
local she = keys { { 0, { -4, -6, 1, 1, -50, -360, 90, -150, 0, 0, 0 } },
  { 1, { -4, -6, 1, 1, -50, -360, 90, -150, 0, 0, 0 } },
  { 2, { 12, 6, 1, 1, -40, -370, 140, -250, 8, 0, 1 } },
  { 3, { -4, -8, 1, 1, -56, -350, 80, -140, 0, 0, 0 } },
  { 4, { -5, -8, 1, 1, -56, -354, 80, -140, 0, 0, 0 } },
  { 5, { -7, -10, 1, 1, -66, -350, 116, -200, 22, 0, 1 } },
  { 6, { -10, -12, 1, 1, -70, -344, 116, -210, 22, 0, 1 } },
  { 7, { 12, 10, 1, 1, 150, -250, -60, -130, 6, 0, 1 } },
  { 8, { 8, 6, 1, 1, 136, -190, -60, -120, 4, 0, 0 } },
  { 9, { -4, -4, 1, 1, 50, -282, 40, -120, 0, 0, 0 } },
  { 10, { -4, -4, 1, 1, 50, -282, 40, -120, 0, 0, 0 } },
  { 11, { 0, 0, 0.4, 1, 40, -150, 70, -170, 0, 0, 0 } },
  { 12, { 4, -14, -1, -1, 60, -150, 70, -170, 18, 0, 0 } },
  { 14, { 4, -14, -1, -1, 60, -150, 70, -170, 18, 0, 0 } },
  { 15, { 2, 2, -1, 1, 60, -150, 70, -170, 18, 0, 0 } },
  { 16, { 5, 16, -1, -1, 60, -150, 70, -170, 18, 0, 0 } },
  { 20, { 5, 20, -1, -1, 60, -150, 70, -170, 18, 0, 0 } },
  { 21, { 2, 8, -1, 1, 60, -150, -94, -110, 18, 0, 0 } },
  { 22, { 2, 8, -1, 1, 60, -150, -94, -110, 18, 0, 0 } },
  { 23, { 2, 8, 0.4, 1, 60, -150, 120, -100, 0, 0, 0 } },
  { 24, { 4, 4, 1, 1, 80, -180, 84, -110, 14, 0, 0 } },
  { 25, { 6, 8, 1, 1, 120, -200, 130, -150, 40, 0, 0 } },
  { 28, { 8, 14, 1, 1, 130, -200, 140, -150, 48, 0, 0 } },
  { 29, { 8, 14, 1, 1, 184, -300, 140, -150, 48, 0, 0 } },
  { 30, { 7, 10, 1, 1, 180, -340, 140, -150, 44, 0, 0 } },
  { 31, { -4, -6, 1, 1, -40, -360, 90, -170, 0, 0, 0 } },
  { 32, { -4, -6, 1, 1, -50, -360, 90, -150, 0, 0, 0 } } }

local MOUTH = polygon { { 74, -34 }, { 20, -20 }, { 70, 2 } }
local MAN = { path { d = "M-66 40 C-70 -60 -86 -200 -60 -234 C-36 -260 30 -262 52 -236 "
    .. "C76 -206 60 -60 60 40 Z" },
  path { d = "M-26 30 C-24 0 -50 -20 -48 -60 C-52 -104 -14 -112 4 -104 C20 -120 56 -112 56 -92 "
    .. "C50 -86 44 -80 42 -68 L66 -42 C64 -34 54 -34 45 -34 L48 -10 C44 10 24 8 16 8 L24 30 Z" } }
local WOMAN = { path { d = "M-100 40 C-80 -40 -34 -80 -30 -120 C-46 -170 -48 -216 -28 -236 "
    .. "C-10 -250 22 -250 34 -234 C56 -196 42 -170 30 -120 C40 -70 86 -30 106 40 Z" },
  path { d = "M-15 30 C-14 4 -42 -14 -42 -50 C-42 -92 -8 -104 18 -97 C40 -90 42 -66 40 -58 "
    .. "L56 -40 C54 -33 46 -33 41 -32 L41 -12 C38 4 22 4 12 4 L14 30 Z" }
    | circle { -46, -84, 24 } }
local PLATE = ellipse { 0, 0, 38, 11 }

local function arm(x, y, thick)
  local reach = math.sqrt((x - 6) ^ 2 + (y + 214) ^ 2)
  local slack = math.max(0, 190 - reach) * 0.5
  return ink.limb({ 6, -214, thick }, { x / 2, (y - 214) / 2 + slack, thick - 4 },
    { x, y, thick - 12 }) | circle { x, y, 0.46 * thick }
end

--- A figure that looks to the right, whose hips are at (0, 0).
local function person(parts, pose, plate)
  local lean, nod, way, look, x, y, u, v, ahead, low, shout = table.unpack(pose)
  local head = shout > 0.9 and parts[2] - MOUTH or parts[2]
  local thick = parts == MAN and 40 or 30
  local body = parts[1] | arm(x, y, thick) | arm(u, v, thick)
  if plate then body = body | PLATE:rotate(-20):translate(x + 8, y - 10) end
  return ((body:scale(way, 1) | head:rotate(nod):scale(look < 0 and -1 or 1, 1)
    :translate(0, -240)):rotate(lean * (way < 0 and -1 or 1))):translate(ahead, low)
end

--- The plate on its way, by its drawing: right, down, degrees.
local FLIGHT = { [7] = { 150, 270, -20 }, [8] = { 56, 240, 50 } }
local function shards(down)
  return union { polygon { { 20, 0 }, { 54, -18 }, { 46, 14 } }, polygon { { 60, 6 }, { 84, 0 },
    { 70, 26 } }, polygon { { 24, 30 }, { 50, 24 }, { 36, 50 } } }:translate(6, 150 + down)
end

local WALL = ink.wall(450, 600, 225, 250, { "#fff4d8", mood.light, "#e0862b" })

return window.film { title = "The quarrel", by = "in", seconds = 8, pane = "transom",
  drawing = function(_, number)
    local step = number // 3
    local both = person(MAN, he:at(step)):translate(110, 590)
      | person(WOMAN, she:at(step), step < 7 or step > 28):scale(-1, 1):translate(340, 590)
    local flying = FLIGHT[step]
    if flying then both = both | PLATE:rotate(flying[3]):translate(flying[1], flying[2]) end
    if step == 9 then both = both | shards(0) end
    if step == 10 then both = both | shards(120) end
    return { WALL, both:paint(mood.ink) }
  end }
