-- A street lamp. The middle of its glass is the origin, and its foot 590 units below.
local shapes = require "demo.shapes"

local lamp = {}

local IRON, EDGE, SNOW = "#3a3263", "#5a5090", "#dfe4fb"

local function rect(x, y, w, h, texture, radius)
  return celspan.rect { x, y, w, h, radius = radius or 0, fill = texture }
end

local function post()
  local iron = shapes.across(-16, 22, { "#2b254d", "#574d8c", "#322b59" })
  return union {
    stroke { fill = iron, points = { { 0, 590, 30 }, { 0, 430, 20 }, { 0, 90, 15 } } },
    rect(-32, 566, 64, 28, iron, 8), rect(-22, 520, 44, 16, iron, 7),
      rect(-17, 420, 34, 12, iron, 5),
    rect(-15, 150, 30, 12, iron, 5), rect(-13, 98, 26, 18, iron, 5),
    stroke { degree = 2, width = 8, cap = "round", fill = IRON, points = {
      { -64, 176 }, { -40, 190 }, { 0, 168 }, { 40, 190 }, { 64, 176 } } },
    path { fill = SNOW, d = "M-44 566C-34 550 -10 556 4 552C24 548 40 556 44 566Z" },
  }
end

local glass = path { d = "M-34 66L34 66L50 -52L-50 -52Z" }

local function frame()
  local parts = {
    path { fill = IRON, d = "M-40 64H40L30 98H-30Z" },
    stroke { points = { { -38, 66 }, { -53, -54 } }, width = 9, fill = IRON },
    stroke { points = { { 38, 66 }, { 53, -54 } }, width = 9, fill = IRON },
    stroke { points = { { 0, 66 }, { 0, -54 } }, width = 4, fill = IRON },
    path { fill = IRON, d = "M-66 -50L66 -50L40 -84Q20 -112 0 -112Q-20 -112 -40 -84Z" },
    path { fill = EDGE, d = "M-66 -50L66 -50L62 -58L-62 -58Z" },
    rect(-5, -132, 10, 24, IRON, 4),
    path { fill = SNOW,
      d = "M-58 -62C-50 -84 -34 -96 -24 -112C-12 -132 18 -130 26 -110C36 -92 54 -82 60 -64"
        .. "C50 -54 42 -68 30 -62C16 -54 4 -70 -10 -62C-26 -52 -44 -54 -58 -62Z" },
    path { fill = SNOW, d = "M-9 -130C-8 -142 8 -142 10 -130Q0 -124 -9 -130Z" },
  }
  return union(parts)
end

lamp.post, lamp.frame = post(), frame()

local dark = linear { from = { -50, -50 }, to = { 40, 60 }, { 0, "#5260a6" },
  { 0.35, "#2a3070" }, { 0.45, "#4a56a0" }, { 0.55, "#262b66" }, { 1, "#343d82" } }
--- The flame behind the glass: a low flame is a deep orange, a full one nearly white.
local function burning(level)
  local texture = { centre = { 0, 14 }, radius = 92 }
  for i, stop in ipairs { { 0, "#d8722c", "#fff8e4" }, { 0.35, "#a8481c", "#ffdf92" },
    { 1, "#4a2440", "#ffa640" } } do
    texture[i] = { stop[1], mix(stop[2], stop[3], level) }
  end
  return glass:with { fill = radial(texture) }
end

--- The glass, from dark to lit, and its front light.
function lamp.glass(level, ambient)
  local k = math.min(1, level)
  local front = {}
  for i = 1, 3 do front[i] = ambient[i] + (1.5 - ambient[i]) * math.min(1, 2 * k) end
  return union { glass:with { fill = dark }, burning(k):fade(math.min(1, 4 * k)) }, front
end

--- The glow in the air about it.
function lamp.glow(x, y, reach, level)
  return cel { shapes.glow(x, y, reach, 1, 0.48, 0.15, 0.042 * level),
    shapes.glow(x, y, reach * 0.36, 1, 0.6, 0.24, 0.05 * level), front = { 9, 9, 9 } }:named "glow"
end

--- A part of the lamp with the middle of the glass at (x, y).
function lamp.place(object, x, y, scale)
  return object:scale(scale):translate(x, y)
end
return lamp
