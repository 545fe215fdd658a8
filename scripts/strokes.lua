-- Lines: a brush that feels pressure, loops that draw themselves, and a road whose dashes march.

local paper, ink, clay, sky = "#f6ead2", "#1f2a44", "#c8553d", "#2a7f83"

--- A brush: every point has a width, and the spline interpolates both positions and widths.
local function brush(u)
  local points = {}
  for i = 0, 12 do
    local press = math.sin(math.pi * i / 12)
    points[#points + 1] = { 160 + 130 * i, 250 + 90 * math.sin(1.1 * i + 2 * math.pi * u),
      6 + 66 * press }
  end
  return stroke { points = points, degree = 3, cap = "round", fill = ink }
end

--- Loops as in a warm-up exercise for the wrist, small at both ends, and a flourish.
local loops = {}
for i = 7, 103 do
  local t = i / 112
  local size, turn = 112 * math.sin(math.pi * t) ^ 0.7, 14 * math.pi * t
  local x, y = 200 + 1330 * t - size * math.sin(turn), 645 - size * math.cos(turn)
  loops[#loops + 1] = { x + 0.45 * (645 - y), y } -- they lean
end
table.move({ { 1600, 668 }, { 1680, 655 }, { 1760, 590 } }, 1, 3, #loops + 1, loops)

--- A line that draws itself: `to` grows, and the taper keeps the tip fine at every length.
local function written(u)
  return stroke { points = loops, degree = 3, width = 20, taper = { 120, 220 },
    cap = "round", to = u,
                  fill = clay }
end

--- Dashes move with their offset; the outline of a primitive can be a line, too.
local function road(f)
  local stone = ellipse { 960, 940, 760, 76 }
  return { stone:stroke { width = 44, fill = "#d9c7a0" },
           stone:stroke { width = 8, dash = { 46, 30 }, dash_offset = -76 * f.index / 12,
                          cap = "round", fill = sky } }
end

return film { size = { 1920, 1080 }, frames = 48, frame = function(f)
  local u = f.index / f.count
  local track, dashes = table.unpack(road(f))
  return { back = paper, cel {
    track, dashes, brush(u), written(ease "inOutSine"(math.min(1, f.progress / 0.85))) } }
end }
