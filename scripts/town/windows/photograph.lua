-- An old woman, one cup, and a photograph that winks while she drinks.
local pencil, window = require "town.pencil", require "town.window"

local HAIR, DRESS = "#f4efe4", "#7b5a72"
local still = pencil.hand()

local room = union { rect { 0, 0, 450, 600, fill = "#d3c6a4" },
  path { fill = "#f3e7c6", d = "M60 140Q240 90 420 150L440 420L20 420Z" },
  still.form({ 262, 154, 262, 154, 264, 332, 264, 332, 416, 334, 416, 334, 418, 152, 418, 152 },
    "#a9743c",
    6), rect { 284, 172, 118, 146, fill = pencil.paper } }

--- The man in the photograph; wink: 0, 1, or 2 with a smile.
local function photograph(wink)
  return union { path { fill = "#5b6f78", d = "M290 318Q292 270 342 268Q394 270 398 318Z" },
    still.wash({ 312, 226, 314, 198, 342, 186, 370, 198, 372, 232, 358, 262, 340, 268, 324, 258 },
      "#d9b48c"), still.wash({ 306, 214, 308, 190, 342, 172, 376, 190, 376, 216, 364, 200, 322,
        200 },
      "#4b3a36"), still.dot(330, 224, 4), wink > 0 and still.line({ 350, 225, 357, 229, 365, 224 },
        5)
      or still.dot(358, 224, 4), still.form({ 322, 248, 330, 238, 344, 242, 358, 238, 366, 248, 344,
        252 },
      "#4b3a36", 2), wink > 1 and still.line({ 330, 258, 346, 265, 360, 256 }, 4) or
      still.line({ 336, 259, 344, 260, 352, 259 }, 3) }
end

local before = union { still.wash({ -10, 424, -10, 424, 470, 424, 470, 424, 470, 620, 470, 620, -10,
  620, -10, 620 }, "#fffaf0"), still.line({ 20, 426, 200, 422, 434, 426 }, 6),
  still.line({ 110, 446, 106, 500, 112, 570 }, 3, "#b9a98a"),
  still.line({ 330, 446, 334, 500, 328, 570 }, 3, "#b9a98a") }

local function cup(x, y, tilt)
  return (still.form({ -20, -28, -20, -28, -16, -6, 0, 0, 16, -6, 20, -28, 20, -28 }, "#dfe8e6",
    4.5)
    | still.line({ 18, -24, 32, -20, 16, -8 }, 4)):rotate(tilt, 0, -14):translate(x, y)
end

local function woman(p, up)
  local shut = p.line({ 164, 214, 172, 219, 182, 214 }, 4.5)
  return p.form({ 44, 470, 40, 380, 62, 310, 108, 284, 160, 288, 196, 330, 204, 470 }, DRESS, 6)
    | p.line({ 116, 296, 140, 318, 168, 298 }, 6, pencil.red)
    | union { p.form({ 118, 284, 106, 240, 116, 186, 156, 172, 184, 186, 192, 212, 206, 230, 194,
      236, 188, 256, 166, 270, 150, 288 }, pencil.skin, 5),
      p.form({ 114, 252, 96, 222, 104, 176, 144, 150, 182, 160, 192, 190, 164, 184, 142, 200, 136,
        232 },
        HAIR, 5.5), p.form({ 98, 186, 72, 176, 70, 146, 94, 134, 118, 146, 118, 164 }, HAIR, 5),
      circle { 164, 240, 9, fill = pencil.blush }, up and shut or p.dot(174, 214, 4.5),
      p.line({ 176, 250, 184, 253, 191, 248 }, 3.5) }:translate(0, up and -4.6875 or 0)
end

--- hand: where it is; the cup is in it, or on the table.
local poses = { a = { hand = { 214, 404 }, wink = 0 }, b = { hand = { 206, 330 }, wink = 0,
  held = 0 },
  c = { hand = { 192, 272 }, wink = 0, held = -30, up = true },
  d = { hand = { 192, 272 }, wink = 1, held = -30, up = true },
  e = { hand = { 192, 272 }, wink = 2, held = -30, up = true } }

return window.film { title = "The photograph", by = "pw", seconds = 8, drawing = function(_, number)
  local pose, p = pencil.exposed(poses, "aaaaaaaaabcccdddeeeedcbaaaaaaaaa", 3, number)
  local arm, hx, hy = p.limb(110, 326, pose.hand, 92, 1, { 48, 30 }, "#69495f")
  local at = pose.held and cup(hx + 22, hy + 12, pose.held) or cup(236, 420, 0)
  return { room, photograph(pose.wink), woman(p, pose.up), before, at, arm,
    circle { hx + 2, hy, 15, fill = pencil.skin } }
end }
