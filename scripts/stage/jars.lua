local chance = random "pen"
--- Pen strokes across a shape, at an angle and a distance.
local function hatch(shape, degrees, gap, width, colour)
  local x, y, w, h = shape:bounds()
  local reach, lines = (w + h) / 2, {}
  for i = -math.floor(reach / gap), math.floor(reach / gap) do
    local a, b = chance(i, -12, 12) / 8, chance(i + 0.5, -12, 12) / 8
    local points = { { -reach, i * gap + a, width }, { 0, i * gap + b, width * 1.6 },
      { reach, i * gap - a, width / 2 } }
    lines[#lines + 1] = stroke { points = points, degree = 2, fill = colour or "#2d3142" }
      :rotate(degrees):translate(x + w / 2, y + h / 2)
  end
  return clip(union(lines), shape)
end

local function jar(x, base, width, height, colour)
  local body = path {
    d = "M-35 0 C-92 -50 -50 -84 -22 -100 H22 C50 -84 92 -50 35 0 Z",
    fill = colour }
    :scale(width / 100, height / 100)
    :translate(x, base)
  local function side(at, size)
    -- the part of the jar that is away from the light
    return body
      & ellipse { x + at * width, base - 0.4 * height, size * width, size * height }
  end
  return body
    | hatch(side(0.75, 0.8), 52, 6, 1)
    | hatch(side(0.95, 0.7), -38, 6, 1)
    | body:stroke { width = 2, join = "round", fill = "#2d3142" }
end
local wall = rect { 0, 0, 480, 190 }
local shelf = rect { 0, 190, 480, 80, fill = "#e9d8b4" }

return { jar = jar, wall = wall, shelf = shelf }
