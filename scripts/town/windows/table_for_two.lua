-- An old man lays the table for two, pours, and nods to the empty chair; the second cup steams.
local pencil, window = require "town.pencil", require "town.window"

local SHIRT, HAIR = "#41606a", "#fffdf6"

local function lamp(p)
  return union { path { fill = "#f8ecce", d = "M236 172L316 172L452 600L84 600Z" },
    p.line({ 276, 0, 277, 70, 276, 134 }, 3),
    p.form({ 222, 176, 222, 176, 244, 134, 308, 134, 330, 176, 330, 176 }, "#b98a4c", 5) }
end

--- The empty chair, with her shawl, and her picture above it.
local function chair(p)
  return union { p.wash({ 336, 420, 336, 420, 342, 262, 372, 246, 402, 262, 408, 420, 408, 420 },
      "#8a6a48"), p.line({ 404, 420, 400, 266, 372, 247, 344, 264, 338, 412 }, 6),
    p.form({ 330, 300, 340, 262, 372, 240, 406, 258, 414, 310, 414, 310, 400, 342, 386, 300, 372,
      350, 356, 300, 344, 338, 330, 300 }, pencil.red, 4),
    p.form({ 350, 186, 352, 152, 374, 138, 396, 154, 398, 186, 374, 206, 352, 192 }, pencil.paper,
      4), circle { 375, 166, 11, fill = "#a98d68" }, circle { 377, 155, 6, fill = "#a98d68" },
    path { fill = "#a98d68", d = "M358 196q2 -20 17 -20q15 0 17 20q-17 14 -34 0z" } }
end

local function cloth(p)
  return union { p.wash({ 84, 410, 84, 410, 426, 410, 426, 410, 440, 610, 440, 610, 70, 610, 70,
      610 }, "#fffaf0"), p.line({ 78, 412, 200, 408, 330, 409, 432, 412 }, 6),
    p.line({ 120, 430, 116, 480, 122, 560 }, 3, "#b9a98a"),
    p.line({ 250, 440, 256, 500, 250, 565 }, 3, "#b9a98a"),
    p.line({ 380, 426, 386, 490, 380, 560 }, 3, "#b9a98a") }
end

local function cup(p, x, y)
  return p.form({ x - 17, y - 24, x - 17, y - 24, x - 13, y - 4, x, y + 2, x + 13, y - 4, x + 17,
    y - 24, x + 17, y - 24 }, "#dfe8e6", 4)
end

local function teapot(p, x, y, tilt)
  return union { p.form({ x - 28, y - 30, x - 34, y - 10, x - 18, y + 2, x + 16, y + 2, x + 30,
      y - 10, x + 26, y - 28, x, y - 42, x - 28, y - 30 }, "#7f97a0", 4.5),
    p.line({ x + 28, y - 16, x + 40, y - 18, x + 48, y - 36 }, 8), circle { x - 1, y - 45, 5 },
    p.line({ x - 30, y - 30, x - 48, y - 28, x - 46, y - 8, x - 32, y - 8 }, 4) }
    :rotate(tilt, x, y - 16)
end

local function head(p, nod)
  return union { p.form({ 126, 262, 104, 226, 106, 178, 140, 150, 178, 158, 194, 182, 198, 194, 216,
      212, 206, 220, 204, 240, 184, 256, 160, 262 }, pencil.skin, 5),
    p.wash({ 120, 244, 96, 240, 96, 206, 106, 186, 120, 196, 124, 220 }, HAIR),
    p.line({ 118, 246, 97, 240, 96, 210, 106, 190 }, 4),
    p.form({ 176, 234, 188, 220, 206, 224, 222, 240, 200, 240, 186, 250, 174, 240 }, HAIR, 4),
    p.line({ 172, 184, 184, 178, 194, 184 }, 5), p.line({ 136, 206, 146, 196, 152, 208, 142, 220 },
      4),
    nod > 0 and p.line({ 174, 200, 182, 204, 190, 201 }, 4) or p.dot(184, 199, 4.5),
    circle { 176, 216, 9, fill = pencil.blush } }:translate(7.03125 * nod, 9.375 * nod)
end

--- hand: where his right hand is; lean, nod: how far he does; pot, tilt, own,
--- other: where these are.
local own, other, pot = { 234, 404 }, { 336, 404 }, { 284, 406 }
local poses = {
  a = { hand = { 216, 350 }, lean = 0, nod = 1, other = { 233, 352 } },
  b = { hand = { 318, 384 }, lean = 1, nod = 1, other = other },
  c = { hand = { 256, 384 }, lean = 0.25, nod = 0.5 },
  d = { hand = { 172, 322 }, lean = 0, nod = 1, pot = { 200, 338 }, tilt = 34, stream = 236 },
  e = { hand = { 272, 326 }, lean = 1, nod = 0.5, pot = { 300, 342 }, tilt = 34, stream = 337 },
  g = { hand = { 240, 292 }, lean = 0, nod = 0, own = { 258, 292 } },
  h = { hand = { 238, 306 }, lean = 0.25, nod = 2, own = { 256, 306 } },
  i = { hand = { 214, 386 }, lean = 0, nod = 0, steam = 0 },
  j = { hand = { 214, 386 }, lean = 0, nod = 0, steam = 1 },
  k = { hand = { 214, 386 }, lean = 0, nod = 1, steam = 2 } }

--- Steam over her cup, in three drawings.
local function steam(p, n)
  local list = {}
  for i = 0, 1 do
    local x, y, s = 330 + 14 * i, 372 - 22 * ((n + i) % 3), (n + i) % 2 * 2 - 1
    list[i + 1] = p.line({ x, y, x + 9 * s, y - 20, x - 8 * s, y - 44, x + 5 * s, y - 70 }, 5,
      "#9fb3b4")
  end
  return union(list)
end

local function man(p, pose)
  local arm, hx, hy = p.limb(130 + 28 * pose.lean, 305 + 9.4 * pose.lean, pose.hand, 96, 1, { 50,
    32 },
    "#35505a")
  local body = p.form({ 52, 470, 50, 350, 78, 282, 122, 256, 168, 262, 194, 306, 202, 440 }, SHIRT,
    6)
  return (body | p.line({ 150, 264, 166, 290, 172, 330 }, 4) | head(p, pose.nod))
    :translate(28.125 * pose.lean, 9.375 * pose.lean), arm | circle { hx + 4, hy, 15,
      fill = pencil.skin }
    | p.line({ hx - 6, hy + 14, hx + 12, hy + 14, hx + 18, hy }, 4)
end

local still = pencil.hand()
local room = union { rect { 0, 0, 450, 600, fill = "#d8c49a" }, lamp(still), chair(still) }
local before = cloth(still)

return window.film { title = "A table for two", by = "pw", seconds = 8, drawing = function(_, n)
  local pose, p = pencil.exposed(poses, "aAbBcddDeeEcghghhGijkIJKijkIJKbB", 3, n)
  local at, o, t = pose.own or own, pose.other or other, pose.pot or pot
  local body, arm = man(p, pose)
  return { room, body, before, pose.steam and steam(p, pose.steam) or circle { 0, 0, 0 },
    pose.stream and rect { pose.stream - 2, 330, 4, 60, fill = "#a5673a" } or circle { 0, 0, 0 },
    cup(p, o[1], o[2]), cup(p, at[1], at[2]), teapot(p, t[1], t[2], pose.tilt or 0), arm }
end }
