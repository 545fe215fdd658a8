-- A writer: three words, a pause; the sheet is crumpled and thrown on a heap that never grows.
local pencil, window = require "town.pencil", require "town.window"

local still = pencil.hand()

local function ball(x, y, r)
  return still.form({ x - r, y, x - 0.7 * r, y - 0.8 * r, x, y - r, x + 0.9 * r, y - 0.6 * r, x + r,
    y + 0.3 * r, x + 0.3 * r, y + r, x - 0.8 * r, y + 0.7 * r }, pencil.light, 4)
    | still.line({ x - 0.4 * r, y - 0.3 * r, x, y, x + 0.4 * r, y - 0.4 * r }, 3)
end

--- The lamp with its light, books on a shelf, the desk.
local room = union { rect { 0, 0, 450, 600, fill = "#cdb78c" },
  path { fill = "#f6e8c2", d = "M318 232L426 206L470 420L150 424Z" },
  still.line({ 8, 158, 90, 156, 196, 159 }, 6),
  still.wash({ 24, 152, 24, 152, 24, 108, 24, 108, 48, 108, 48, 108, 48, 152 }, "#4f7f80"),
  still.wash({ 58, 152, 58, 152, 58, 118, 58, 118, 78, 118, 78, 118, 78, 152 }, "#b98a4c"),
  still.line({ 372, 424, 400, 340, 388, 260, 366, 196 }, 6),
  still.form({ 306, 236, 306, 236, 338, 186, 392, 172, 430, 204, 430, 204 }, "#4f7f80", 6),
  still.wash({ 176, 420, 176, 420, 470, 420, 470, 420, 470, 446, 470, 446, 176, 446, 176, 446 },
    "#9a6b4a"), still.wash({ 330, 440, 330, 440, 356, 440, 356, 440, 350, 610, 350, 610, 330, 610,
    330, 610 }, "#7d553b"), still.line({ 168, 422, 300, 418, 440, 421 }, 6) }

local heap = union { ball(48, 488, 30), ball(108, 492, 27), ball(150, 528, 24), ball(20, 530, 30),
  ball(84, 534, 34), ball(46, 566, 26), ball(130, 566, 28), ball(184, 562, 22) }

--- His sheet on the desk; words: how many.
local function paper(p, words)
  local list = { p.form({ 262, 424, 262, 424, 296, 384, 296, 384, 378, 380, 378, 380, 352, 424, 352,
    424 }, pencil.light, 3.5) }
  for i = 1, words do
    local x, y = 324 - 12 * i, 382 + 10 * i
    list[i + 1] = p.line({ x, y, x + 10, y - 5, x + 18, y + 2, x + 28, y - 5, x + 38, y }, 3)
  end
  return union(list)
end

local function head(p, pose)
  local shut = pose.shut and p.line({ 214, 212, 222, 217, 232, 212 }, 4.5) or p.dot(224, 213, 4.5)
  return union { p.form({ 160, 276, 146, 230, 156, 180, 196, 164, 228, 180, 234, 206, 252, 226, 240,
      232, 238, 252, 216, 268, 192, 274 }, pencil.skin, 5),
    p.form({ 152, 252, 132, 226, 134, 190, 150, 150, 184, 138, 214, 146, 240, 134, 238, 160, 244,
      178, 226, 182, 204, 178, 186, 192, 184, 214, 168, 222, 164, 246 }, "#8a3f2a", 5.5),
    p.line({ 150, 206, 158, 178, 180, 158 }, 3), p.line({ 210, 196, 222, 192, 234, 197 }, 4), shut,
    p.line({ 222, 246, 230, 243, 238, 246 }, 4),
    p.line({ 172, 222, 166, 234, 172, 244 }, 4) }
    :translate(7.03125 * pose.nod, 9.375 * pose.nod)
end

--- hand: the right one; other: the left; words on the sheet; ball: where the crumpled one is.
local poses = {
  a = { hand = { 318, 384 }, other = { 270, 416 }, words = 0, nod = 1 },
  b = { hand = { 330, 392 }, other = { 270, 416 }, words = 1, nod = 1 },
  c = { hand = { 318, 402 }, other = { 270, 416 }, words = 2, nod = 1 },
  d = { hand = { 306, 410 }, other = { 270, 416 }, words = 3, nod = 1 },
  e = { hand = { 252, 290 }, other = { 270, 416 }, words = 3, nod = 0, shut = true },
  f = { hand = { 300, 376 }, other = { 280, 382 }, nod = 1, ball = { 302, 368, 24 }, shut = true },
  g = { hand = { 312, 356 }, other = { 284, 366 }, nod = 1, ball = { 306, 350, 18 }, shut = true },
  h = { hand = { 254, 200 }, other = { 270, 416 }, nod = 0, ball = { 262, 180, 18 }, shut = true },
  i = { hand = { 170, 150 }, other = { 270, 416 }, nod = 0, ball = { 108, 150, 18 }, shut = true },
  j = { hand = { 190, 170 }, other = { 270, 416 }, nod = 0, ball = { 60, 280, 18 } },
  k = { hand = { 300, 396 }, other = { 270, 416 }, nod = 0, ball = { 78, 440, 18 } },
  l = { hand = { 372, 392 }, other = { 270, 416 }, nod = 0, words = 0, ball = { 8, 470, 18 } } }

return window.film { title = "Three words", by = "pw", seconds = 4, drawing = function(_, number)
  local pose, p = pencil.exposed(poses, "aAbBbcCcdeeEEefgFhijkllL", 2, number)
  local near, hx, hy = p.limb(156, 306, pose.hand, 100, 1, { 50, 30 }, "#2f4650")
  local far, fx, fy = p.limb(196, 300, pose.other, 86, 1, { 44, 28 }, "#2f4650")
  local at = pose.ball or { -60, 0, 1 }
  local shown = { room, far, circle { fx, fy, 13, fill = pencil.skin },
    p.form({ 66, 620, 76, 460, 80, 360, 108, 296, 156, 272, 196, 284, 220, 330, 222, 420, 206, 480,
      196, 620 }, "#3d5a62", 6), p.line({ 182, 284, 196, 300, 204, 330 }, 4), head(p, pose),
    p.wash({ 154, 268, 154, 268, 196, 274, 204, 290, 170, 302, 144, 292 }, pencil.red),
    pose.words and paper(p, pose.words) or circle { 0, 0, 0 }, near,
    circle { hx, hy, 15, fill = pencil.skin }, p.line({ hx - 8, hy + 12, hx + 8, hy + 13, hx + 14,
      hy }, 4), ball(at[1], at[2], at[3]),
    heap }
  if pose.words then
    shown[#shown + 1] = p.line({ hx + 12, hy - 30, hx + 6, hy - 12, hx - 4, hy + 10 }, 5)
  end
  return shown
end }
