-- The room of the animator of the town, over her shoulder: her table, her sheet on its pegs, and
-- herself, in colour or in pencil alone.
local pencil = require "town.pencil"

local studio = {}

--- Where the sheet is, 360 wide, and where the tip of her pencil draws the last pane on it.
studio.left, studio.top = 45, 300
local TIP = { 272.4, 359 }

--- Wall, pinned drawings, table and the light in it.
function studio.room(p, paper)
  local wall = radial { centre = { 235, 390 }, radius = 330, { 0, "#fff4d2" }, { 0.55, "#ecd3a0" },
    { 1, "#a98a63" } }
  return union { rect { 0, 0, 450, 600, fill = paper or wall },
    p.form({ 292, 142, 292, 142, 340, 138, 340, 138, 343, 196, 343, 196, 294, 198 },
      pencil.paper, 3),
    p.form({ 364, 150, 364, 150, 414, 146, 414, 146, 418, 206, 418, 206, 367, 208 },
      pencil.paper, 3),
    p.line({ 302, 180, 318, 158, 332, 182 }, 3), p.line({ 376, 166, 392, 190, 406, 170 }, 3),
    p.wash({ -10, 262, -10, 262, 470, 262, 470, 262, 470, 610, 470, 610, -10, 610, -10, 610 },
      "#8d6b4c"),
    p.line({ 262, 266, 340, 263, 440, 266 }, 4),
    p.wash({ 32, 274, 32, 274, 414, 274, 414, 274, 420, 520, 420, 520, 24, 520, 24, 520 },
      "#d9bd8c"), p.line({ 422, 290, 424, 400, 426, 520, 426, 525, 260, 527, 120, 526 }, 4),
    p.line({ 300, 556, 360, 548, 418, 552 }, 7, paper and pencil.ink or pencil.red) }
end

--- The sheet with what is drawn on it; lift: how far its lower left corner is flipped up, 0 to 1.
function studio.sheet(p, drawn, lift, paper)
  local parts = { rect { 45, 278, 360, 228, fill = paper or "#fffaf0" },
    p.line({ 45, 280, 44, 400, 46, 506, 46, 506, 200, 507, 406, 506 }, 3),
    p.line({ 46, 278, 200, 277, 406, 278, 406, 278, 405, 400, 406, 506 }, 2.5),
    ellipse { 225, 289, 6, 6, fill = pencil.ink }, rect { 106, 285, 26, 8, radius = 4,
      fill = pencil.ink }, rect { 318, 285, 26, 8, radius = 4, fill = pencil.ink },
    drawn:translate(studio.left, studio.top) }
  if lift > 0 then
    local x, y = 45 + 150 * lift, 506 - 70 * lift
    parts[#parts + 1] = polygon { { 45, y }, { 45, 507 }, { x, 507 }, fill = paper or "#f6ecd2" }
    parts[#parts + 1] = p.form({ 45, y, 45, y, 60 + 60 * lift, 500 - 44 * lift, 84 + 60 * lift,
      474 - 44 * lift, 84 + 60 * lift, 474 - 44 * lift, 90 + 80 * lift, 500 - 30 * lift, x, 507 },
      "#fffdf6", 3.5)
  end
  return union(parts)
end

--- Her head, bowed over the sheet, or, with look, turned to us.
local function head(p, look, paper)
  local hair = "#6f4030"
  local bun = p.form({ 104, 176, 84, 150, 98, 126, 124, 128, 136, 152, 122, 176 }, hair, 5)
    | p.line({ 96, 158, 108, 140, 124, 144 }, 3)
    | p.line({ 70, 130, 100, 148, 136, 168 }, 6, paper and pencil.ink or "#e0a52f")
  if look then
    return union { bun, p.form({ 130, 200, 138, 158, 176, 142, 212, 162, 214, 206, 188, 238, 156,
        236 }, pencil.skin, 4),
      p.form({ 120, 226, 108, 170, 140, 128, 190, 124, 222, 154, 222, 182, 222, 182, 196, 180, 164,
        172, 148, 194, 140, 232 }, hair, 5.5),
      p.line({ 124, 212, 132, 180, 156, 158, 188, 154 }, 3.5),
      p.line({ 118, 190, 130, 160, 152, 146 }, 3),
      p.dot(172, 197, 3.5), p.dot(203, 196, 3.5),
      circle { 171, 197, 12 }:stroke { width = 2.5, fill = pencil.ink },
      circle { 204, 196, 12 }:stroke { width = 2.5, fill = pencil.ink },
      p.line({ 183, 195, 188, 192, 192, 195 }, 2.5), p.line({ 186, 200, 192, 208, 185, 211 }, 3),
      p.line({ 170, 219, 184, 226, 200, 218 }, 4), p.line({ 158, 214, 166, 208 }, 3) }
  end
  return union { p.wash({ 170, 168, 204, 168, 212, 190, 224, 206, 212, 212, 208, 230, 184, 240, 150,
      244, 140, 200 }, pencil.skin),
    p.line({ 206, 178, 214, 194, 228, 212, 228, 212, 216, 217, 214, 234, 196, 244 }, 4.5),
    bun, p.form({ 142, 252, 108, 226, 100, 176, 132, 132, 180, 130, 210, 156, 214, 182, 214, 182,
      190, 178, 176, 196, 168, 226 }, hair, 6),
    p.line({ 130, 224, 136, 186, 160, 160, 190, 156 }, 3.5), p.line({ 116, 196, 128, 162, 150,
      146 }, 3),
    p.form({ 160, 200, 170, 192, 178, 202, 170, 218, 160, 214 }, pencil.blush, 3),
    p.line({ 200, 201, 208, 205, 215, 202 }, 4), p.line({ 172, 198, 198, 196, 214, 198 }, 2.5) }
end

--- Strokes side by side, as pencils shade: `count` of them from x, y, each dx, dy long, `step`
--- apart.
local function hatch(p, x, y, dx, dy, count, step)
  local list = {}
  for i = 0, count - 1 do
    local u = i * step
    list[i + 1] = p.line({ x + u, y + 0.2 * u, x + u + 0.5 * dx - 2, y + 0.5 * dy + 0.2 * u,
      x + u + dx,
      y + dy + 0.2 * u }, 2.2)
  end
  return union(list)
end

--- Herself, on paper with lines alone if that is given. hand: how far her pencil is from the pane,
--- { right, down }; lift, look as above.
function studio.animator(p, hand, lift, look, paper)
  local wool = "#3f5c63"
  local x, y = TIP[1] + hand[1], TIP[2] + hand[2]
  local far, fx, fy = p.limb(226, 272, { x + 44, y - 22 }, 92, -1, { 56, 34 }, wool)
  local near, nx, ny = p.limb(52, 330, { 104 + 40 * lift, 500 - 40 * lift }, 108, 1, { 74, 40 },
    "#35505a")
  return union { far,
    paper and p.form({ x, y, x, y, x + 37, y - 34, x + 37, y - 34, x + 42, y - 28, x + 42, y - 28 },
      paper, 2.5) or path { fill = "#e0a52f",
      d = ("M%.1f %.1fL%.1f %.1fL%.1f %.1fZ"):format(x, y, x + 58, y - 48,
      x + 64, y - 41) }, polygon { { x, y }, { x + 9, y - 9 }, { x + 11, y - 6.5 },
      fill = pencil.ink },
    p.form({ fx + 14, fy - 14, fx - 6, fy - 15, fx - 20, fy - 4, fx - 22, fy + 7, fx - 8, fy + 14,
      fx + 12, fy + 10 }, pencil.skin, 3.5),
    p.wash({ -20, 620, -20, 330, 20, 282, 84, 252, 130, 232, 170, 236, 220, 248, 252, 276, 214, 296,
      150, 300, 100, 340, 78, 440, 30, 560, 30, 620 }, wool),
    p.line({ 8, 320, 28, 284, 84, 256, 126, 238 }, 7), p.line({ 178, 244, 222, 252, 250, 276 }, 6),
    p.line({ 130, 262, 160, 276, 196, 262 }, 4), p.line({ 222, 296, 150, 303, 104, 342, 82, 436, 84,
      452 }, 3.5), near,
    paper and union { hatch(p, 40, 310, -12, 44, 6, 9), hatch(p, 40, 400, -8, 40, 4, 8),
      hatch(p, 272, 240, -4, 15, 5, 9), hatch(p, 190, 258, -8, 18, 4, 9),
      hatch(p, 116, 150, -8, 40, 3, 8) } or circle { 0, 0, 0 },
    p.form({ nx - 12, ny - 16, nx + 12, ny - 18, nx + 28, ny - 6, nx + 24, ny + 8, nx + 4, ny + 14,
      nx - 14, ny + 10 }, pencil.skin, 4), head(p, look, paper) }
end

--- Her poses: the place of her hand, and the lift of the corner.
local poses = { a = { { 0, 0 }, 0 }, b = { { 1, 4 }, 0 }, c = { { 3, -1 }, 0 }, d = { { 2, 3 }, 0 },
  r = { { 26, -14 }, 0 }, h = { { 26, -14 }, 0.55 }, f = { { 26, -14 }, 1 } }

--- Her drawing of a frame, by a row of poses: she draws, flips twice, looks at it, and draws again.
--- Returns the place of her hand, the lift, and the hand that draws her.
function studio.acting(number, row, paper)
  local pose, p = pencil.exposed(poses, row or "aBcDaBcDaBrhFhrhFFhRRRcD", 2, number, paper)
  return pose[1], pose[2], p
end

return studio
