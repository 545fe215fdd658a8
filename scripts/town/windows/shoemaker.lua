-- A shoemaker: three taps, and a nail out of his mouth; eleven shoes keep time.
local pencil, window = require "town.pencil", require "town.window"
local mood = require("stage.moods").harvest

local LEATHER, SHIRT, APRON = "#8a4a28", "#1f6f78", "#5a3222"
local still = pencil.hand()

local function shoe(colour)
  return still.form({ -26, 0, -26, 0, -28, -20, -22, -38, -22, -38, -4, -38, -4, -38, 2, -24, 24,
    -16, 30, 0, 30, 0 }, colour, 3.5)
end
local shoes = { shoe "#a9572b", shoe "#7a3b22", shoe "#d98a3a" }

local room = union { rect { 0, 0, 450, 600, fill = mood.sky[1] },
  path { fill = mood.light, d = "M-10 140H300L240 460H-10Z" },
  rect { 240, 196, 200, 9, fill = APRON }, rect { 240, 272, 200, 9, fill = APRON },
  rect { 20, 126, 420, 8, fill = APRON },
  still.wash({ 250, 442, 250, 442, 400, 442, 400, 442, 400, 466, 400, 466, 250, 466, 250, 466 },
    LEATHER),
  still.line({ 244, 443, 330, 440, 404, 443 }, 6), still.line({ 280, 468, 284, 520, 270, 580 }, 11),
  still.line({ 376, 468, 372, 520, 388, 580 }, 11), rect { 318, 398, 16, 46, fill = pencil.ink },
  still.form({ 270, 398, 270, 398, 282, 374, 330, 372, 352, 350, 380, 350, 388, 372, 384, 398, 384,
    398 },
    mood.accent, 5) }

--- Shoes on the shelves: each second one hops on the tap.
local function row(beat)
  local list, places = {}, { { 270, 196 }, { 338, 196 }, { 406, 196 }, { 270, 272 }, { 338, 272 },
    { 406, 272 }, { 50, 126 }, { 200, 126 }, { 276, 126 }, { 346, 126 }, { 414, 126 } }
  for i, at in ipairs(places) do
    local up = (i + beat) % 2 == 0 and 0 or -9.375
    list[i] = shoes[i % 3 + 1]:translate(at[1], at[2] + up)
  end
  return union(list)
end

local function man(p, hammer, nail)
  local lean = hammer == 2 and 4.6875 or 0
  local near, hx, hy = p.limb(112, 316, ({ { 250, 250 }, { 262, 300 }, { 280, 360 } })[hammer + 1],
    96, 1,
    { 50, 30 }, "#1a5f67")
  if nail then near, hx, hy = p.limb(112, 316, { 204, 262 }, 96, 1, { 50, 30 }, "#1a5f67") end
  local far, fx, fy = p.limb(160, 318, { 262, 394 }, 78, 1, { 42, 26 }, "#1a5f67")
  local turn = ({ -62, -30, 6 })[hammer + 1]
  local tool = union { rect { -7, -64, 12, 74, fill = "#b9824c" }, rect { -26, -84, 56, 24,
    radius = 5,
    fill = pencil.ink } }:rotate(turn + 40):translate(hx, hy)
  return union { far, circle { fx, fy, 13, fill = pencil.skin },
    p.form({ 40, 620, 34, 480, 46, 360, 78, 300, 116, 280, 160, 288, 188, 330, 200, 430, 210, 500,
      280, 520, 300, 560, 280, 620 }, SHIRT, 6.5),
    p.wash({ 120, 620, 118, 400, 128, 330, 172, 330, 190, 420, 204, 500, 276, 526, 270, 620 },
      APRON),
    union { p.form({ 122, 290, 106, 250, 108, 196, 150, 172, 186, 184, 194, 208, 196, 218, 218, 232,
      206, 242, 200, 262, 172, 280 }, pencil.skin, 5),
      p.form({ 112, 234, 96, 220, 94, 190, 118, 164, 150, 158, 138, 176, 126, 200, 124, 232 },
        "#5a3222", 5),
      p.form({ 166, 250, 180, 240, 204, 246, 212, 256, 186, 258 }, "#5a3222", 4),
      p.line({ 168, 216, 176, 221, 186, 216 }, 4.5), p.line({ 164, 200, 176, 194, 188, 200 }, 5),
      not nail and p.line({ 206, 258, 222, 264 }, 5) or circle { 0, 0, 0 } }:translate(lean, lean),
    nail and p.line({ hx + 2, hy - 14, hx + 8, hy - 26 }, 5) or tool, near,
    circle { hx, hy, 15, fill = pencil.skin } }
end

--- Hammer up, halfway and down; then a nail.
local rows = { { 0 }, { 2 }, { 0 }, { 2 }, { 0 }, { 2 }, { 1 }, { 0, true }, { 0, true }, { 0,
  true },
  { 1 }, { 1 } }

return window.film { title = "Three taps", by = "pw", seconds = 2, drawing = function(_, number)
  local at = rows[number // 2 + 1]
  local beat = at[1] == 2 and 1 or 0
  return { room, row(beat), man(pencil.hand(), at[1], at[2]) }
end }
