-- Pictures that bend: a flag in the wind, by a map of the plane, and tentacles, by bones.

local flag = image { file = "pictures/flag.png", x = 0, y = 0, w = 150, h = 100 }
-- Only where the shape is may nothing fold, so it is no larger than what is painted.
local arm = polygon { { 0, -40 }, { 160, -22 }, { 320, -3 }, { 320, 3 }, { 160, 22 },
  { 0, 40 }, fill = picture { file = "pictures/tentacle.png",
    box = { 0, -40, 320, 80 } } }

--- Waves run along the cloth, higher away from the mast, and its end hangs.
local function wind(time)
  return flag:warp { map = function(x, y)
    local far = x / 150
    local wave = 12 * math.sin(x / 22 - 7 * time) + 2 * math.sin(x / 11 + y / 30 - 11 * time)
    return x * (1 - 0.06 * far) + 3 * far * math.sin(x / 22 - 7 * time + 1),
      y + far * wave + 14 * far * far
  end }
end

--- A tentacle of `count` bones that curls and feels its way.
local function tentacle(time, phase, curl)
  local bones, count = {}, 7
  for i = 1, count do
    local u = i / count
    bones[i] = { from = { 320 * (i - 1) / count, 0 }, to = { 320 * i / count, 0 },
                 radius = 46 * (1.1 - u) + 12,
                 rotate = curl * u * u + (6 + 13 * u) * math.sin(1.9 * time - 3.2 * u + phase) }
  end
  return arm:warp { bones = bones }
end

--- A crest of the sea from left to right, with foam along its edge.
local function wave(time, y, height, length, speed, above, below)
  local points = {}
  for i = 0, 60 do
    local x = 16 * i
    points[#points + 1] = ("%s%.2f %.2f"):format(i == 0 and "M" or "L", x,
      y + height * (math.sin(x / length - speed * time)
        + 0.4 * math.sin(x / length * 2.3 + speed * time)))
  end
  local line = table.concat(points, " ")
  return union { path { d = line .. " L960 600 L0 600 Z",
    fill = linear { from = { 0, y - height }, to = { 0, y + 170 }, { 0, above },
      { 1, below } } },
    stroke { d = line, width = 3, fill = "#dff0e8" }:fade(0.5) }
end

local sky = rect { 0, 0, 960, 540, fill = linear { from = { 0, 0 },
  to = { 0, 400 }, { 0, "#274b6d" }, { 0.6, "#8fb0b8" }, { 1, "#f2d7b0" } } }
local sun = circle { 250, 330, 46, fill = "#fbe9c4" }
local hull = union {
  path { fill = "#5a3524",
    d = "M-150 0 C-140 52 -110 74 -70 78 H80 C126 74 160 30 178 -22 C110 6 -60 14 -150 0 Z" },
  path { fill = "#8a5633",
    d = "M-150 0 C-60 14 110 6 178 -22 L176 -8 C110 20 -60 28 -148 14 Z" },
  rect { -6, -260, 12, 270, fill = "#4a2c1d" },
  path { d = "M-8 -236 C-90 -196 -104 -110 -92 -40 H-8 Z", fill = "#f0e4cc" },
  path { d = "M10 -206 C74 -180 92 -110 84 -44 H10 Z", fill = "#e2d3b6" } }

return film { size = { 960, 540 }, frames = 72, frame = function(f)
  local t = f.time
  local heave, roll = 7 * math.sin(1.7 * t), 3.5 * math.sin(1.3 * t + 0.6)
  local ship = union { hull, wind(t):translate(6, -258) }
  ship = ship:rotate(roll):translate(500, 366 + heave)
  local function rise(x, y, size, turn, phase, curl)
    local limb = tentacle(t, phase, curl):scale(size):rotate(turn)
    return limb:translate(x, y + 5 * math.sin(1.5 * t + phase))
  end
  return {
    cel { sky, sun },
    wave(t, 404, 7, 70, 1.1, "#7fa6a6", "#2d5f70"),
    cel { rise(215, 470, 1, -96, 0, 14), rise(760, 480, 1.1, -78, 2, -15) },
    ship,
    wave(t, 432, 10, 95, 1.6, "#4d8a90", "#1d4a5c"),
    rise(360, 520, 0.8, -80, 4, 17):scale(-1, 1, 330, 0),
    wave(t, 474, 13, 120, 2.1, "#2f6d7c", colour.lighten("#163a4c", -0.04)) }
end }
