-- A pianist plays; his cat walks over the keys, and he plays on between its feet.
local pencil, window, piano = require "town.pencil", require "town.window", require "town.piano"

local COAT, HAIR = "#4d6c78", "#3a2c27"

--- His head: from behind, or towards the cat, with turned from -1 to 1.
local function head(p, turned)
  if turned == 0 then
    return p.form({ 196, 286, 178, 250, 180, 206, 204, 184, 232, 180, 262, 196, 272, 232, 262, 270,
      250, 290 }, HAIR, 6) | circle { 272, 246, 10, fill = pencil.skin }
      | circle { 180, 246, 10, fill = pencil.skin }
  end
  local face = p.form({ 204, 290, 200, 250, 214, 196, 256, 190, 268, 214, 270, 228, 288, 242, 276,
    250, 272, 268, 250, 278, 244, 290 }, pencil.skin, 5)
    | p.form({ 200, 280, 180, 250, 178, 208, 204, 182, 244, 176, 268, 194, 272, 210, 272, 210, 246,
      212, 232, 226, 228, 246, 212, 260 }, HAIR, 6) | p.dot(262, 230, 4.5)
    | p.line({ 252, 218, 262, 214, 270, 218 }, 4) | p.line({ 258, 262, 268, 264, 274, 260 }, 4)
  return turned > 0 and face or face:scale(-1, 1):translate(450, 0)
end

--- The sides to which he looks, and how high his hands are, drawing by drawing.
local looks = { 0, 1, 1, 1, 1, 1, 0, 0, 0, -1, -1, -1, -1, -1, 0, 0 }
local left, right = { 0, 18, 0, 10 }, { 14, 0, 22, 0 }

local function player(p, n)
  local l, r = left[n % 4 + 1], right[n % 4 + 1]
  local one, ax, ay = p.limb(180, 326, { 104, 372 - l }, 82, -1, { 48, 28 }, COAT)
  local two, bx, by = p.limb(270, 326, { 346, 372 - r }, 82, 1, { 48, 28 }, COAT)
  return union { one, two, circle { ax, ay, 14, fill = pencil.skin },
    circle { bx, by, 14, fill = pencil.skin } }
end

local function back(p)
  return union { p.form({ 178, 500, 166, 420, 152, 340, 176, 302, 224, 290, 274, 302, 298, 340, 284,
    420, 272, 500 }, COAT, 6), p.wash({ 176, 470, 158, 540, 148, 590, 148, 590, 206, 590, 220, 520,
      220, 520, 236, 590, 300, 590, 300, 590, 290, 530, 272, 470 }, COAT),
    p.line({ 224, 330, 222, 420, 222, 520 }, 4), p.line({ 166, 500, 158, 545, 152, 576 }, 5),
    p.wash({ 200, 296, 200, 296, 224, 288, 252, 296, 252, 296, 246, 308, 206, 308 }, "#fffaf0") }
end

return window.film { title = "Four hands", by = "pw", seconds = 4, drawing = function(_, number)
  local n = (number // 3 + 4) % 16
  local p = pencil.hand(n % 4 > 1)
  return { piano.room, player(p, n),
    piano.cat(n):translate(42.1875 * (13 - n), 375), back(pencil.hand()),
    head(pencil.hand(), looks[n + 1]) }
end }
