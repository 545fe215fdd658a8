-- A dog is bathed, and shakes itself: foam is on the pane, and slides down.
local pencil, window, bath = require "town.pencil", require "town.window", require "town.bath"

local FUR, EAR, FOAM = "#b98752", "#8a5f38", "#fffdf6"
local still = pencil.hand()
local hat = bath.foam { 168, 206, 20, 206, 196, 26, 240, 208, 18 }
local around = bath.foam { 86, 352, 18, 120, 358, 15, 300, 356, 20, 334, 352, 16, 370, 350, 12 }
local flying = bath.foam { 60, 200, 12, 100, 160, 9, 330, 180, 12, 372, 230, 9, 340, 270, 7 }
local sponge = still.form({ 470, 96, 380, 110, 300, 136, 262, 152, 262, 174, 290, 176, 380, 152,
  470, 140 }, pencil.skin, 5.5) | still.form({ 180, 150, 190, 132, 262, 138, 274, 158, 264, 182,
    192, 184 },
  "#e6bf5c", 5)

--- Ears: how far they fly, -1 to 1; shut: its eyes.
local function dog(p, ears, shut)
  local e = 34 * math.abs(ears)
  local eye = shut and p.line({ 166, 262, 176, 268, 186, 262 }, 5) | p.line({ 218, 262, 228, 268,
    238, 262 }, 5) or p.dot(176, 262, 6) | p.dot(228, 262, 6)
  return union { p.form({ 120, 400, 116, 350, 140, 310, 202, 300, 262, 312, 288, 350, 284, 400 },
    FUR, 6),
    p.form({ 144, 216, 120 - e, 230 - e, 104 - 1.4 * e, 290 - 1.8 * e, 118 - 1.2 * e, 330 - 2 * e,
      146 - e, 312 - 1.8 * e, 152, 264 }, EAR, 5.5),
    p.form({ 260, 216, 284 + e, 230 - e, 300 + 1.4 * e, 290 - 1.8 * e, 286 + 1.2 * e, 330 - 2 * e,
      258 + e, 312 - 1.8 * e, 252, 264 }, EAR, 5.5),
    p.form({ 140, 280, 138, 230, 166, 200, 202, 196, 238, 200, 266, 230, 264, 280, 240, 318, 202,
      328, 164, 318 }, FUR, 6), eye,
    p.wash({ 164, 300, 170, 276, 202, 268, 234, 276, 240, 300, 222, 322, 182, 322 }, "#ead2a8"),
    p.form({ 184, 282, 186, 270, 202, 268, 218, 270, 220, 282, 202, 294 }, pencil.ink, 4),
    p.line({ 178, 304, 192, 312, 202, 298, 212, 312, 226, 304 }, 4.5) }
    :translate(14.0625 * ears, 0)
end

--- Foam on the pane that slides down by `down`, and leaves a wet track.
local function blots(down)
  local list = {}
  for i, at in ipairs { { 70, 220, 14 }, { 330, 180, 18 }, { 120, 330, 11 }, { 396, 300, 11 } } do
    local x, y, r = at[1], at[2] + down * (0.6 + i % 3 * 0.3), at[3]
    list[i] = path { fill = rgb(FOAM, 0.6),
      d = ("M%g %gl-5 %gh10Z"):format(x, y - r - 0.4 * down, 0.4 * down + 1) } | path { fill = FOAM,
      d = ("M%g %gq0 %g %g %gq%g 0 %g %gq0 %g %g %gq%g 0 %g %gZ"):format(
      x - r, y, -r, r, -r, r, r, r, 1.7 * r, -r, 1.7 * r, -r, -r, -1.7 * r) }
  end
  return union(list)
end

local poses = { a = { 0 }, b = { 0, shut = true }, c = { -1, shut = true, fly = true },
  d = { 1, shut = true, fly = true }, e = { 0, down = 18.75 }, f = { 0, down = 75 },
  g = { 0, down = 168.75 }, h = { 0, down = 318.75 }, s = { 0, shut = true, sponge = true } }

return window.film { title = "The dog", by = "pw", seconds = 4, drawing = function(_, number)
  local pose, p = pencil.exposed(poses, "aaabbcdcdcdceeffgghhassa", 2, number)
  local n = number // 2
  local shown = { bath.room, bath.tap, dog(p, pose[1], pose.shut), bath.tub, around }
  if n < 5 or n > 21 then shown[#shown + 1] = hat end
  if pose.fly then shown[#shown + 1] = flying:scale(pose[1], 1):translate(pose[1] < 0 and 430 or 0,
    0) end
  if n > 7 and pose.fly then shown[#shown + 1] = blots(0) end
  if pose.down then shown[#shown + 1] = blots(pose.down) end
  if pose.sponge then shown[#shown + 1] = sponge end
  return shown
end }
