-- The audience of the paper theatre: eight dolls, who are afraid of the wolf, and clap for the
-- moon. One sleeps.
local window = require "town.window"
local cut = require "town.cutout"
local mood = require("stage.moods").candle

local SKIN, PINK, RED, OLIVE = "#e9bd92", "#c96a5a", "#8c2f1d", "#7d7a3c"

local ROOM = rect { 0, 0, 450, 600, fill = mood.sky[3] }
  | cut.laid(cut.piece("M-10 0 L92 0 C104 120 70 240 96 380 L-10 400 Z", RED))
  | cut.laid(cut.piece("M460 0 L358 0 C346 120 380 240 354 380 L460 400 Z", RED))
local function bench(y)
  return cut.laid(cut.piece(("M-10 %g C140 %g 310 %g 460 %g L460 620 L-10 620 Z"):format(y, y + 26,
    y + 26, y), mood.far))
end
local BENCHES = { bench(344), bench(500) }

local HEAD = cut.disc(0, 0, 43, SKIN)
local function body(fill)
  return cut.piece("M-26 34 L26 34 C52 60 60 110 62 160 L-62 160 C-60 110 -52 60 -26 34 Z", fill)
end
local HAIR = {
  cut.piece("M-46 10 C-60 -66 60 -66 46 10 L34 -14 L-34 -14 Z", mood.ink),
  cut.piece("M-44 -12 L0 -92 L44 -12 Z", mood.accent),
  cut.piece("M-48 30 C-66 -74 66 -74 48 30 L32 26 C40 -10 20 -24 0 -24 C-20 -24 -40 -10 -32 26 Z",
    mood.light),
  cut.piece("M-58 -18 L-34 -20 L-30 -62 L30 -62 L34 -20 L58 -18 L58 -8 L-58 -8 Z", mood.ink) }
-- Each doll: its place, its hair, and its clothes; those behind come first.
local DOLLS = { { 86, 226, 2, RED }, { 178, 240, 1, mood.accent }, { 272, 240, 4, OLIVE },
  { 364, 226, 3, PINK }, { 72, 390, 3, OLIVE }, { 174, 406, 4, PINK }, { 276, 406, 2, RED },
  { 378, 390, 1, mood.light } }
local SLEEPER = 6
for _, doll in ipairs(DOLLS) do doll.body = body(doll[4]) | HEAD | HAIR[doll[3]] end

local FACES = {
  calm = circle { -15, 2, 4.5 } | circle { 15, 2, 4.5 }
    | stroke { points = { { -7, 20 }, { 7, 20 } }, width = 4 },
  afraid = circle { -15, 0, 8 } | circle { 15, 0, 8 } | ellipse { 0, 23, 6, 9 },
  glad = stroke { d = "M-22 4 q8 -10 15 0 M7 4 q8 -10 15 0", width = 4.5 }
    | path { d = "M-13 16 L13 16 C10 32 -10 32 -13 16 Z" },
  asleep = stroke { d = "M-23 2 q8 8 16 0 M7 2 q8 8 16 0", width = 4.5 } | circle { 0, 21, 4 } }
for name, face in pairs(FACES) do FACES[name] = face:paint(mood.ink) end
local MITTEN = cut.disc(0, 0, 15, SKIN)

--- A doll; hands: how far they are apart when it claps, or nil.
local function doll(i, face, hands)
  local one = DOLLS[i]
  local up = face == "afraid" and i ~= SLEEPER and -8 or 0
  local art = one.body | FACES[i == SLEEPER and "asleep" or face]
  if hands and i ~= SLEEPER then
    art = art | MITTEN:translate(-15 - hands, 72) | MITTEN:translate(15 + hands, 72)
  end
  return cut.laid(art):translate(one[1], one[2] + up)
end

return window.film { title = "The audience", by = "cp", seconds = 4, pane = "plain",
  drawing = function(_, number)
    local face = number < 12 and "calm" or number < 30 and "afraid" or number < 34 and "calm"
      or "glad"
    local list = { ROOM }
    for i = 1, #DOLLS do
      if i == 5 then list[#list + 1] = BENCHES[1] end
      local hands = face == "glad" and ((number // 2 + i) % 2 == 0 and 0 or 20) or nil
      list[#list + 1] = doll(i, face, hands)
    end
    list[#list + 1] = BENCHES[2]
    return list
  end }
