-- A teacher writes on the blackboard; behind the back comes a paper plane, and lands in her hair.
local pencil, window = require "town.pencil", require "town.window"

local HAIR, DRESS, CHALK = "#5a3b2e", "#7d6a86", "#f3efe2"
local still = pencil.hand()

local room = union { rect { 0, 0, 450, 600, fill = "#e4d3a6" },
  still.form({ 40, 140, 40, 140, 42, 400, 42, 400, 412, 402, 412, 402, 414, 138, 414, 138 },
    "#3d5a4c", 7),
  still.line({ 36, 408, 220, 404, 420, 410 }, 9, "#a8743f"),
  rect { 0, 560, 450, 50, fill = "#a3845a" } }

--- The sum on the board, 2 + 2 =, in four parts, and as many of them as are written.
local two = still.line({ 70, 190, 82, 174, 98, 184, 90, 206, 70, 226, 70, 226, 102, 224 }, 6,
  CHALK, true)
local parts = { two, still.line({ 118, 204, 144, 203 }, 6, CHALK, true) |
  still.line({ 131, 190, 130, 218 }, 6, CHALK, true), two:translate(86, 0),
  still.line({ 206, 197, 230, 196 }, 6, CHALK, true) | still.line({ 206, 211, 230, 210 }, 6, CHALK,
    true) }

local function sum(count)
  return union { circle { 0, 0, 0 }, table.unpack(parts, 1, count) }
end

--- The teacher: from behind, or, with looks, with her face to us.
local function teacher(p, hand, looks)
  local arm, hx, hy = p.limb(290, 336, hand, 92, -1, { 46, 28 }, "#6b5975")
  local head = p.form({ 292, 300, 268, 270, 268, 222, 300, 198, 336, 200, 362, 226, 360, 272, 338,
    300 },
    looks and pencil.skin or HAIR, 6)
  if looks then
    head = head | p.form({ 266, 262, 262, 214, 300, 190, 342, 194, 368, 224, 362, 262, 348, 226,
      316, 222, 284, 228 }, HAIR, 5) | p.dot(300, 254, 4.5) | p.dot(332, 254, 4.5)
      | p.line({ 302, 282, 316, 279, 330, 283 }, 4) | p.line({ 316, 258, 320, 268, 314, 270 }, 3)
  end
  return union { p.form({ 292, 208, 282, 180, 296, 154, 326, 150, 346, 168, 342, 196, 330, 206 },
    HAIR, 5.5),
    p.form({ 236, 620, 250, 460, 252, 360, 278, 312, 316, 302, 356, 314, 378, 360, 380, 460, 396,
      620 },
      DRESS, 6.5), looks and circle { 0, 0, 0 } or p.line({ 316, 330, 318, 400, 316, 480 }, 3.5),
        head,
    p.line({ 288, 308, 316, 318, 344, 308 }, 8, pencil.red), arm,
    circle { hx, hy, 14, fill = pencil.skin }, p.line({ hx - 4, hy - 4, hx - 18, hy - 12 }, 8,
      CHALK) }
end

local plane = still.form({ -40, -14, -40, -14, 34, 4, 34, 4, -30, 14, -30, 14, -20, 2, -20, 2 },
  "#fffdf4",
  4) | still.line({ -22, 2, 0, 4, 30, 4 }, 3)

--- Strokes on the board, the hand, where the plane is and how it is turned.
local poses = { a = { 0, { 250, 236 } }, b = { 1, { 110, 226 } }, c = { 2, { 146, 222 } },
  d = { 3, { 196, 226 } }, e = { 4, { 236, 214 } }, f = { 4, { 236, 214 }, { -20, 300, -24 } },
  g = { 4, { 236, 214 }, { 80, 210, -14 } }, h = { 4, { 236, 214 }, { 200, 160, 6 } },
  i = { 4, { 236, 214 }, { 300, 152, 26 } }, j = { 4, { 250, 420 }, { 306, 146, 20 }, true },
  k = { 4, { 160, 226 }, { 306, 146, 20 } }, l = { 0, { 110, 226 }, { 306, 146, 20 } } }

return window.film { title = "Two and two", by = "pw", seconds = 4, drawing = function(_, number)
  local pose, p = pencil.exposed(poses, "jjJJjkllabbccddeefghiiij", 2, number)
  local at = pose[3]
  return { room, sum(pose[1]), teacher(p, pose[2], pose[4]),
    at and plane:rotate(at[3]):translate(at[1], at[2]) or circle { 0, 0, 0 } }
end }
