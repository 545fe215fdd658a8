-- A child draws on the wall, one line, which becomes a horse that looks at the child, and goes.
local pencil, window = require "town.pencil", require "town.window"

local PYJAMAS, STRIPE, HAIR = "#7fa0ae", "#56747f", "#513b34"
local still = pencil.hand()

--- The horse as one line from its jaw round to its throat; head: how its head and neck are moved.
local function horse(dx, dy)
  local x, y = dx, dy
  return { 238 + x, 282 + y, 212 + x, 292 + y, 192 + x, 286 + y, 190 + x, 266 + y, 212 + x, 232 + y,
    220 + x, 202 + y, 220 + x, 202 + y, 236 + x, 222 + y, 266 + x / 2, 240 + y / 2, 298, 276, 336,
      284, 372, 272, 400, 290, 418, 340, 408, 390, 408, 390, 400, 350, 388, 318, 390, 380, 384, 430,
        392, 486, 392, 486, 370, 486, 370, 486, 364, 430, 350, 388, 316, 392, 288, 388, 284, 430,
          280, 486, 280, 486, 258, 486, 258, 486, 260, 420, 254, 370, 244 + x / 8, 330 + y / 8,
          246 + x / 2,
        304 + y / 2,
      238 + x,
    282 + y }
end

--- The line from one of its 42 places to another one.
local function crayon(points, from, to)
  return still.line(table.move(points, 2 * from - 1, 2 * to, 1, {}), 7, pencil.red, true)
end

local room = union { rect { 0, 0, 450, 600, fill = "#f0e2bf" },
  rect { 0, 510, 450, 16, fill = "#c4a877" }, rect { 0, 526, 450, 80, fill = "#a3845a" },
  still.line({ 10, 509, 220, 512, 440, 508 }, 5),
  stroke { d = "M70 180a24 24 0 1 0 1 1M70 140v-10M96 152l8 -8M44 152l-8 -8M112 186h10M28 186h-10",
    width = 6, cap = "round", fill = "#d9a03a" },
  stroke { d = "M362 200q10 -34 26 -2q12 -36 28 4", width = 6, cap = "round", fill = "#5f93a8" } }

--- The child from behind; x: where it is; hand: where its right one is;
--- other: where its left one is, if it is lifted.
local function child(p, x, hand, other)
  local near, nx, ny = p.limb(36, 398, { hand[1] - x, hand[2] }, 96, 1, { 40, 28 }, PYJAMAS)
  local parts = { p.wash({ -64, 620, -62, 500, -52, 400, -30, 372, 0, 366, 32, 372, 50, 400, 58,
    500, 60, 620 },
      PYJAMAS), p.line({ -66, 600, -62, 480, -52, 402, -30, 376 }, 6),
    p.line({ 62, 600, 58, 490, 50, 420 }, 5) }
  if other then
    local far, fx, fy = p.limb(-34, 400, { other[1] - x, other[2] }, 88, -1, { 40, 28 }, PYJAMAS)
    table.move({ far, circle { fx, fy, 13, fill = pencil.skin } }, 1, 2, #parts + 1, parts)
  end
  for i = 0, 3 do
    parts[#parts + 1] = p.line({ -54 - 3 * i, 420 + 40 * i, 0, 428 + 40 * i, 50 + 3 * i,
      420 + 40 * i }, 7,
      STRIPE)
  end
  parts[#parts + 1] = circle { 55, 334, 12, fill = pencil.skin }
  parts[#parts + 1] = p.form({ -22, 384, -58, 352, -60, 300, -26, 268, -4, 256, -4, 256, 2, 266, 36,
    272, 60, 304, 54, 352, 22, 384 }, HAIR, 6)
  parts[#parts + 1] = p.line({ -30, 300, -4, 284, 20, 300 }, 3.5, "#8a6a58")
  parts[#parts + 1] = near
  parts[#parts + 1] = p.form({ nx - 14, ny + 4, nx - 10, ny - 12, nx + 8, ny - 12, nx + 13, ny + 4,
    nx,
    ny + 13 }, pencil.skin, 4)
  return union(parts):translate(x, 0), nx + x, ny
end

--- Places of the line, from and to; head: how far the horse's head is moved; x: where the child is.
local poses, all = {}, horse(0, 0)
local count = #all // 2
for i = 1, 9 do
  local to = math.ceil(i * count / 9)
  local x, y = all[2 * to - 1], all[2 * to]
  poses[("abcdefghi"):sub(i, i)] = { to = to, hand = { x + 4, y + 6 },
    x = 7.03125 * math.floor((x - 108) / 9) }
end
local there = { to = count, x = 77.34375 }
local function pose(fields) return setmetatable(fields, { __index = there }) end
poses.j = pose { hand = { 224, 262 }, eye = 1, x = 105.46875 }
poses.k = pose { hand = { 140, 470 }, eye = 1 }
poses.l = pose { hand = { 152, 290 }, other = { 4, 290 }, eye = 2, head = { -16, 14 } }
poses.m = pose { hand = { 200, 330 }, eye = 2, head = { -34, 42 } }
poses.n = pose { hand = { 210, 316 }, eye = 3, head = { -34, 42 } }
poses.o = pose { hand = { 150, 240 }, from = 15, head = { -10, -10 } }
poses.p = pose { hand = { 130, 220 }, from = 26 }
poses.q = pose { hand = { 160, 240 }, from = 37 }
poses.r = pose { hand = { 190, 330 }, from = count }

--- The eye: a dot, a dot with a light, or shut.
local function eye(kind, x, y)
  if kind == 3 then
    return stroke { d = ("M%g %gq7 6 13 0"):format(x - 8, y), width = 5, cap = "round",
      fill = pencil.red }
  end
  return circle { x, y, kind == 2 and 7 or 5, fill = pencil.red }
    | circle { x - 2, y - 2, kind == 2 and 2.5 or 0, fill = "#f0e2bf" }
end

return window.film { title = "One line", by = "pw", seconds = 4, drawing = function(_, number)
  local at, p = pencil.exposed(poses, "mnMmopqrRabcdefghijkKllm", 2, number)
  local head = at.head or { 0, 0 }
  local body, hx, hy = child(p, at.x, at.hand, at.other)
  local shown = { room, crayon(horse(head[1], head[2]), at.from or 1, at.to) }
  if at.eye then shown[3] = eye(at.eye, 222 + head[1], 248 + head[2]) end
  shown[#shown + 1] = body
  shown[#shown + 1] = p.line({ hx - 4, hy + 6, hx + 4, hy - 8, hx + 10, hy - 22 }, 8, pencil.red)
  return shown
end }
