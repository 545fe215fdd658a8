-- A head that looks around, as a separate film; scripts/hat.lua puts a hat on it. Its pictures are
-- used in place of those of a camera:
--
--   celspan render scripts/hat/head.lua -o head/head.####.png
--   celspan track head/head.####.png --from 1 --at 240,135,160,165 -o scripts/hat/track.json
local random = celspan.random "head"

local head = { size = { 640, 360 }, frames = 72, fps = 24 }

local function disc(x, y, rx, ry, texture)
  return ellipse { x, y, rx, ry, fill = texture }
end

--- `count` copies of a thing, each moved by `place`.
local function scatter(count, place)
  local list = {}
  for i = 1, count do
    list[i] = place(function(label, m, n) return random(label .. i, m, n) end)
  end
  return union(list)
end

local browns = { "#5b2f22", "#6f3b27", "#7f482c", "#4a261e" }

--- Curls along the upper half of the head.
local curls = scatter(70, function(number)
  local angle = math.pi * (1.04 + 0.92 * number "angle")
  local far = 86 + 22 * number "far"
  return disc(far * math.cos(angle), 12 + 1.06 * far * math.sin(angle), 9 + 8 * number "rx",
    9 + 8 * number "ry", browns[number("brown", 1, #browns)])
end)

local freckles = scatter(46, function(number)
  local side = number "side" < 0.5 and -1 or 1
  return disc(side * (16 + 50 * number "x"), 16 + 34 * number "y", 1.2 + 1.6 * number "r",
    1.2 + 1.6 * number "r", "#b5714f")
end)

local skin = radial { centre = { -24, -26 }, radius = 150, { 0, "#fbd3ae" },
  { 1, "#d2936c" } }

local function eye(x)
  return union {
    disc(x, -6, 17, 13, "#fffaf0"), disc(x, -5, 9, 10, "#3f6f62"), disc(x, -5, 5, 6, "#1d1614"),
    disc(x - 3, -9, 3, 3, "#ffffff"),
    stroke { points = { { x - 19, -30 }, { x, -37 }, { x + 19, -30 } }, width = 6,
      degree = 2, cap = "round", taper = { 10, 10 }, fill = "#5b2f22" },
  }
end

local face = union {
  disc(-92, 8, 15, 22, "#d2936c"), disc(92, 8, 15, 22, "#d2936c"), disc(0, 4, 90, 104, skin),
  freckles, eye(-36), eye(36),
  stroke { points = { { -4, 2 }, { 9, 24 }, { -4, 30 } }, width = 5, degree = 2,
    cap = "round",
    fill = "#b5714f" },
  stroke { points = { { -32, 58 }, { 0, 78 }, { 32, 56 } }, width = 7, degree = 2,
    cap = "round",
    taper = { 14, 14 }, fill = "#a8413a" },
  curls,
}

--- The position of the head in a frame, counted from 0: {x, y, degrees, scale}.
local function motion(index)
  local t = 2 * math.pi * index / head.frames
  return { 320 + 66 * math.sin(t), 218 + 10 * math.cos(2 * t) - 10, 15 * math.sin(t + 0.5) - 7.2,
    0.86 + 0.08 * math.sin(t - 0.8) + 0.057 }
end

--- Moves art that is drawn about the head's middle to the position of the head.
function head.pose(object, index)
  local x, y, degrees, scale = table.unpack(motion(index))
  return object:scale(scale):rotate(degrees):translate(x, y)
end

--- The shoulders follow by half the distance.
local shirt = path { fill = "#2f6f86",
  d = "M-150 260C-150 150 -60 110 0 110S150 150 150 260Z" }
local neck = rect { -32, 70, 64, 70, radius = 24, fill = "#c58661" }

--- The cels of a frame.
function head.cels(index)
  local x = motion(index)[1]
  local wall = rect { 0, 0, 640, 360,
    fill = linear { from = { 0, 0 }, to = { 640, 360 },
    { 0, "#cfe0dc" }, { 1, "#8fb0b8" } } }
  return { cel { wall }:named "wall",
    cel { (shirt | neck):translate(320 + (x - 320) / 2, 186) }:named "shoulders",
    cel { head.pose(face, index) }:named "head" }
end

head.film = film { title = "A head", size = head.size, frames = head.frames, fps = head.fps,
  frame = function(f) return rostrum(head.cels(f.index)) end }

-- When run as a script, this returns the film; when required, the table.
if ... == "hat.head" then return head end
return head.film
