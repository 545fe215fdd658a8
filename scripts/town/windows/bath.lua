-- A bath: a nose, a knee and a duck; he blows, the duck sails to the tap, and comes back to his
-- nose.
local pencil, window, bath = require "town.pencil", require "town.window", require "town.bath"

local HAIR = "#3a3f40"

--- cheeks: how full they are, 0 to 2; eye: "dot", "shut" or "wide"; back: how far his head lies
--- back.
local function head(p, pose)
  local c = 8 * pose.cheeks
  local eyes = { dot = p.dot(146, 262, 5), shut = p.line({ 136, 262, 145, 267, 156, 262 }, 5),
    wide = circle { 148, 260, 11, fill = "#fffdf6" } | circle { 153, 263, 5 } }
  return union { p.form({ 84, 372, 66, 330, 58, 280, 80, 232, 124, 220, 156, 238, 164, 254, 196,
    250, 214, 266, 206, 284, 180, 288, 178 + c, 304, 168 + c, 326, 146, 348 + c / 2, 140, 372 },
      pencil.skin, 6),
    p.form({ 66, 316, 44, 280, 52, 230, 84, 200, 126, 196, 152, 214, 158, 236, 130, 238, 112, 250,
      104, 274, 86, 280, 80, 312 }, HAIR, 5.5), p.line({ 70, 250, 84, 226, 110, 216 }, 3.5,
        "#8a9694"),
    p.form({ 156, 300, 166, 288, 184, 288, 196 + c / 2, 300, 180, 304, 166, 310 }, HAIR, 4),
    circle { 150 + c / 2, 304, 9 + c * 0.7, fill = pencil.blush }, eyes[pose.eye],
    p.line({ 134, 246 - 6 * (pose.cheeks), 146, 240 - 3 * pose.cheeks, 158, 244 }, 5),
    pose.cheeks == 2 and p.line({ 190, 316, 204, 318, 218, 314 }, 3.5, "#fffdf6") or
      p.line({ 164, 318, 172, 321, 180, 316 }, 4) }
    :translate(-7.03125 * pose.back, -4.6875 * pose.back)
end

local still = pencil.hand()
local knee = still.form({ 262, 380, 262, 330, 280, 286, 306, 276, 326, 296, 334, 340, 336, 380 },
  pencil.skin, 6)
local arm = still.form({ 56, 330, 84, 318, 124, 330, 146, 352, 150, 392, 160, 420, 146, 432, 130,
  424, 126, 390, 112, 362, 72, 360 }, pencil.skin, 5.5) | still.line({ 138, 412, 142, 424, 146,
    430 }, 3)
local foam = bath.foam { 232, 352, 15, 252, 356, 12, 212, 358, 12, 350, 352, 14, 366, 356, 11 }

local poses = {
  a = { duck = 240, cheeks = 0, eye = "dot", back = 0 },
  b = { duck = 240, cheeks = 0, eye = "shut", back = 1 },
  c = { duck = 246, cheeks = 2, eye = "shut", back = 0 },
  d = { duck = 274, cheeks = 2, eye = "shut", back = 0 },
  e = { duck = 318, cheeks = 1, eye = "dot", back = 0 },
  f = { duck = 352, cheeks = 0, eye = "dot", back = 0, drop = 272 },
  g = { duck = 358, cheeks = 0, eye = "dot", back = 0, drop = 288 },
  h = { duck = 356, cheeks = 0, eye = "wide", back = 0, flat = 0.78 },
  i = { duck = 338, cheeks = 0, eye = "dot", back = 0 },
  j = { duck = 308, cheeks = 0, eye = "dot", back = 0 },
  k = { duck = 276, cheeks = 0, eye = "dot", back = 0 },
  l = { duck = 250, cheeks = 0, eye = "dot", back = 0 },
  m = { duck = 236, cheeks = 0, eye = "wide", back = 1 } }

return window.film { title = "The bath", by = "pw", seconds = 4, drawing = function(_, number)
  local pose, p = pencil.exposed(poses, "aAbBbccdeffgghhiijkkllmM", 2, number)
  local duck = bath.duck:scale(0.98, pose.flat or 1)
  return { bath.room, bath.steam(number // 12 % 2), bath.tap, knee, head(p, pose),
    pose.drop and ellipse { 378, pose.drop, 4, 7, fill = "#7fa8b8" } or circle { 0, 0, 0 },
    duck:translate(pose.duck, 350 + (pose.duck // 16 % 2)), bath.tub, foam, arm }
end }
