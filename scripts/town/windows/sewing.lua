-- A woman at a sewing machine: the curtain of her own window goes through it and becomes her dress.
local pencil, window = require "town.pencil", require "town.window"

local DOT, CLOTH, IRON = "#fbf3e0", pencil.red, "#2b3338"
local still = pencil.hand()

--- The way of the cloth, from the rail to the hem, and its width there.
local way = motion.along("M372 128C380 230 400 300 372 356S310 404 262 404"
  .. "S186 416 150 452S120 540 104 600")
local wide = keys { { 0, 112 }, { 0.22, 84 }, { 0.42, 40 }, { 0.52, 24 }, { 0.6, 24 },
  { 0.7, 90 }, { 0.8, 150 }, { 1, 196 } }

--- A place at a share of the way, and `aside` it in halves of the width.
local function place(share, aside)
  local x, y, degrees = way:at(share)
  local a, half = math.rad(degrees), wide:at(share) / 2
  return x - math.sin(a) * half * aside, y + math.cos(a) * half * aside
end

local function edge(from, to, aside)
  local list, step = {}, (to - from) / 9
  for i = 0, 9 do
    local k = #list
    list[k + 1], list[k + 2] = place(from + i * step, aside)
  end
  return list
end

local shape = edge(0, 1, 1)
local back = edge(1, 0, -1)
table.move(back, 1, #back, #shape + 1, shape)
local cloth = still.wash(shape, CLOTH):translate(-3.5, -3.5) | still.line(edge(0, 0.6, -1), 5)
  | still.line(edge(0, 0.55, 1), 5) | still.line(edge(0.6, 1, 1), 6)

--- Dots of the cloth that run along it: a period in a quarter of the way.
local function dots(u)
  local list = {}
  for i = 0, 17 do
    local share = (i + u) / 18
    local x, y = place(share, ({ -0.5, 0.5, 0 })[i % 3 + 1])
    list[#list + 1] = circle { x, y, 1 + 0.07 * wide:at(share), fill = DOT }
  end
  return union(list)
end

local room = union { rect { 0, 0, 450, 600, fill = "#dcc89c" },
  rect { 262, 140, 158, 158, fill = "#33464e" }, circle { 300, 184, 20, fill = "#ffe9b0" },
  still.line({ 258, 136, 257, 220, 259, 304, 259, 304, 340, 302, 424, 304 }, 5),
  still.line({ 262, 226, 420, 228 }, 4), still.line({ 240, 133, 330, 129, 434, 133 }, 7),
  still.wash({ 232, 412, 232, 412, 470, 412, 470, 412, 470, 434, 470, 434, 232, 434, 232, 434 },
    "#8d6548"), still.line({ 224, 412, 330, 409, 440, 412 }, 6),
  still.line({ 300, 436, 306, 500, 290, 575 }, 8, IRON),
  still.line({ 404, 436, 400, 500, 414, 575 }, 8, IRON),
  still.line({ 296, 500, 350, 480, 404, 500 }, 6, IRON) }

local machine = still.form({ 236, 410, 236, 410, 236, 398, 340, 396, 352, 380, 352, 336, 334, 322,
  290, 324, 284, 348, 276, 350, 276, 350, 270, 352, 262, 352, 260, 312, 274, 300, 350, 298, 376,
    308, 382, 340, 384, 396, 404, 400, 404, 410, 404, 410 }, IRON, 4) | still.form({ 392, 330, 402,
      312, 414, 330, 412, 352, 400, 362, 390, 350 }, "#b98a4c", 4)

local function woman(p, down)
  return union { p.wash({ 88, 470, 84, 380, 92, 312, 128, 274, 166, 276, 196, 310, 204, 370, 200,
      440 }, CLOTH), circle { 120, 330, 8, fill = DOT }, circle { 160, 320, 8, fill = DOT },
    circle { 138, 372, 9, fill = DOT }, circle { 178, 370, 8, fill = DOT },
    circle { 112, 412, 9, fill = DOT }, p.line({ 84, 480, 80, 380, 90, 312, 124, 276 }, 6),
    union { p.form({ 144, 290, 142, 240, 150, 186, 186, 170, 214, 186, 220, 206, 234, 226, 222, 232,
        218, 250, 198, 264, 176, 266, 172, 290 }, pencil.skin, 4.5),
      p.form({ 140, 254, 122, 224, 130, 176, 168, 146, 208, 158, 218, 184, 218, 184, 192, 188, 176,
        206, 172, 230, 158, 256 }, "#4b3a36", 5.5),
      p.form({ 130, 178, 104, 168, 100, 136, 126, 124, 150, 136, 152, 160 }, "#4b3a36", 5),
      p.line({ 200, 214, 208, 219, 217, 214 }, 4.5), p.line({ 204, 248, 211, 250, 217, 246 }, 4),
      circle { 194, 236, 9, fill = pencil.blush } }:translate(0, 9.375 * down) }
end

return window.film { title = "The curtain", by = "pw", seconds = 2, drawing = function(_, number)
  local n = number // 2
  local p = pencil.hand(n % 6 > 2)
  local up = n % 2 == 0
  local far, fx, fy = p.limb(188, 310, { 282, 388 + (up and 0 or 4) }, 76, 1, { 40, 24 }, "#b02f26")
  local near, nx, ny = p.limb(128, 312, { 242, 392 - (up and 0 or 4) }, 82, 1, { 48, 28 },
    "#b02f26")
  return { room, rect { 272, up and 350 or 368, 4, 34, fill = pencil.ink }, cloth,
    dots(n % 6 / 2 % 3), machine, far, circle { fx, fy, 11, fill = pencil.skin },
    woman(p, n % 6 < 3 and 0 or 0.5), near, circle { nx, ny, 14, fill = pencil.skin } }
end }
