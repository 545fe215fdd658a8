-- A painter: a stroke, a step back; he throws the brush, which sticks where the nose was missing.
local pencil, window = require "town.pencil", require "town.window"
local mood = require("stage.moods").harvest

local SMOCK, BERET, CARROT = "#1f6f78", "#8f3a2a", "#e8762c"
local still = pencil.hand()

local room = union { rect { 0, 0, 450, 600, fill = mood.sky[1] },
  path { fill = mood.light, d = "M120 -10H470V520L300 540Z" },
  rect { 0, 540, 450, 70, fill = mood.far }, still.line({ 10, 541, 220, 538, 440, 542 }, 5),
  still.line({ 330, 150, 262, 420, 244, 566 }, 10, mood.ground),
  still.line({ 336, 150, 404, 420, 420, 566 }, 10, mood.ground),
  still.wash({ 246, 428, 246, 428, 420, 428, 420, 428, 420, 442, 420, 442, 246, 442, 246, 442 },
    mood.ground),
  still.form({ 250, 180, 250, 180, 250, 424, 250, 424, 416, 426, 416, 426, 418, 178, 418, 178 },
    "#a9cbd6",
    6), path { fill = "#fffdf6", d = "M254 392Q330 372 422 396V430H254Z" },
  circle { 336, 364, 48, fill = "#fffdf6" }, circle { 336, 282, 37, fill = "#fffdf6" },
  still.line({ 374, 330, 390, 356, 376, 396, 350, 412 }, 4), still.line({ 360, 250, 376, 276, 366,
    306 }, 4),
  still.form({ 300, 256, 300, 256, 310, 210, 310, 210, 360, 206, 360, 206, 370, 250, 370, 250 },
    pencil.ink, 4),
  circle { 322, 274, 5 }, circle { 350, 274, 5 }, circle { 336, 346, 5 }, circle { 336, 372, 5 },
  still.line({ 318, 302, 336, 310, 354, 302 }, 4.5) }

local brush = rect { -4, -52, 9, 80, radius = 4, fill = mood.far }
  | path { fill = CARROT, d = "M-7 28H8Q8 46 0 58Q-8 46 -7 28Z" }
--- The brush in the canvas, foreshortened: the nose of the snowman.
local nose = still.form({ 328, 280, 336, 276, 344, 284, 340, 294, 318, 300, 292, 300 }, CARROT, 4)

--- nod: how far his head is to the right; back: steps back; hand; brush: at, turn; joy.
local poses = { a = { hand = { 268, 300 }, brush = { 280, 288, -70 } },
  b = { hand = { 278, 326 }, brush = { 290, 314, -70 } },
  c = { hand = { 196, 420 }, brush = { 208, 410, -60 }, back = 1, nod = -12 },
  d = { hand = { 196, 420 }, brush = { 208, 410, -60 }, back = 1, nod = 10 },
  e = { hand = { 80, 226 }, brush = { 66, 206, 30 }, back = 1, shut = true },
  f = { hand = { 226, 300 }, brush = { 262, 262, -80 }, back = 1, shut = true },
  g = { hand = { 214, 330 }, nose = 1, back = 1, wide = true },
  h = { hand = { 214, 330 }, nose = -1, back = 1, wide = true },
  i = { hand = { 236, 262 }, nose = 0, back = 1, nod = -8, shut = true },
  j = { hand = { 280, 300 }, nose = 0 } }

local function painter(p, pose)
  local arm, hx, hy = p.limb(126, 318, pose.hand, 96, pose.hand[2] < 240 and -1 or 1, { 52, 32 },
    "#175a62")
  local eye = pose.shut and p.line({ 172, 214, 180, 219, 190, 214 }, 4.5)
    or p.dot(182, 214, pose.wide and 7 or 4.5)
  local head = union { p.form({ 122, 286, 108, 246, 114, 196, 150, 174, 186, 184, 194, 208, 212,
    226, 200, 234, 196, 256, 176, 272, 152, 284 }, pencil.skin, 5),
    p.wash({ 116, 250, 104, 226, 110, 196, 126, 192, 128, 226 }, mood.ink),
    p.form({ 92, 196, 84, 168, 110, 144, 160, 140, 204, 160, 206, 186, 160, 188, 120, 200 }, BERET,
      5.5),
    p.line({ 150, 142, 152, 128 }, 7), eye, p.line({ 170, 200, 182, 194, 194, 200 }, 4.5),
    p.line({ 176, 240, 188, 236, 204, 242 }, 6), p.line({ 178, 254, 186, 256, 192, 252 }, 4) }
    :translate(0.5859375 * (pose.nod or 0), 0)
  return union { p.form({ 54, 620, 58, 470, 62, 370, 88, 304, 130, 280, 176, 290, 202, 340, 208,
    440, 226, 620 }, SMOCK, 6.5), p.line({ 160, 292, 172, 350, 174, 420 }, 3.5), head, arm,
    circle { hx, hy, 15, fill = pencil.skin } }:translate(-28.125 * (pose.back or 0), 0)
end

return window.film { title = "The nose", by = "pw", seconds = 4, drawing = function(_, number)
  local pose, p = pencil.exposed(poses, "iiijjaababcccdddeefghggi", 2, number)
  local shown, b = { room }, pose.brush
  if pose.nose then shown[2] = nose:rotate(6 * pose.nose, 336, 286) end
  if b then
    shown[#shown + 1] = brush:rotate(b[3]):translate(b[1] - (b[1] < 220 and 28 or 0), b[2])
  end
  shown[#shown + 1] = painter(p, pose)
  return shown
end }
