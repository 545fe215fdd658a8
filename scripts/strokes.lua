-- Lines: a brush that feels pressure, a signature that draws itself, and a road whose dashes march.
local celspan = require "celspan"
local ease = require "celspan.ease"

local paper, ink, clay, sky = "#f6ead2", "#1f2a44", "#c8553d", "#2a7f83"

--- A brush: every point says how wide the line is there, and the spline goes through both alike.
local function brush(u)
  local points = {}
  for i = 0, 12 do
    local press = math.sin(math.pi * i / 12)
    points[#points + 1] = { 160 + 130 * i, 250 + 90 * math.sin(1.1 * i + 2 * math.pi * u), 6 + 66 * press }
  end
  return celspan.stroke { points = points, degree = 3, cap = "round", texture = ink }
end

--- A line that draws itself: `to` grows, and the taper keeps the tip fine wherever it is.
local function signature(u)
  return celspan.stroke {
    d = "M170 660 C 260 420 380 420 330 620 S 250 800 420 700 S 620 480 650 620 S 560 800 760 690 "
      .. "S 930 520 960 640 C 990 760 860 800 850 690 S 1100 560 1220 660 S 1480 740 1750 560",
    width = 26, taper = { 90, 260 }, cap = "round", join = "round", to = u, texture = clay }
end

--- Dashes march when their offset moves; a primitive's outline is a line as well.
local function road(f)
  local stone = celspan.ellipse { centre = { 960, 940 }, radii = { 760, 76 } }
  return { stone:stroke { width = 44, texture = "#d9c7a0" },
           stone:stroke { width = 8, dash = { 46, 30 }, dash_offset = -76 * f.index / 12,
                          cap = "round", texture = sky } }
end

return celspan.film { size = { 1920, 1080 }, frames = 48, frame = function(f)
  local u = f.index / f.count
  local track, dashes = table.unpack(road(f))
  return celspan.rostrum { back = paper, celspan.cel {
    track, dashes, brush(u), signature(ease("inOutSine")(f.progress)) } }
end }
