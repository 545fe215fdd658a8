-- The eight primitives, one per tile: rectangle, triangle, circle, ellipse, polygon, NURBS, path
-- and scan-line procedure. Each is one value, turned and scaled by methods that return new values.
local label = require "stage.label"

local ink, cream, coral, teal, gold = "#1f2a44", "#f6ead2", "#e4572e", "#2a7f83", "#f2b134"

--- A round star: every other corner pulled in.
local function star(corners, outer, inner)
  local points = { texture = coral }
  for i = 0, 2 * corners - 1 do
    local r, a = i % 2 == 0 and outer or inner, math.pi * i / corners
    points[#points + 1] = { r * math.sin(a), -r * math.cos(a) }
  end
  return polygon(points)
end

--- A disc of stripes, described row by row; the two paints at its ends make a gradient.
local function blinds(y)
  local half = math.sqrt(math.max(0, 150 * 150 - y * y))
  if y // 20 % 2 == 0 or half == 0 then return {} end
  return { { -half, half, rgb(0.77, 0.09, 0.03), rgb(0.014, 0.023, 0.058) } }
end

--- {ground, the shape around (0, 0), how far it turns in the loop, its name}
local tiles = {
  { cream, rect { -120, -120, 240, 240, radius = 46, fill = teal }, 90, "rect" },
  { gold, triangle { { 0, -150 }, { 140, 95 }, { -140, 95 }, fill = ink }, 120, "triangle" },
  { teal, circle { 0, 0, 140, fill = cream }, 0, "circle" },
  { ink, ellipse { 0, 0, 160, 84, fill = gold }, 180, "ellipse" },
  { ink, star(9, 165, 96), 40, "polygon" },
  { cream, nurbs { fill = ink, points = {
    { 0, -210 }, { 150, -160 }, { 40, 0 }, { 210, 90 }, { 20, 190 }, { -60, 90 }, { -220, 120 },
    { -110, -60 } } }, 360, "nurbs" },
  { coral, path { fill = cream,
                  d = "M0 160C-260 -20 -150 -170 0 -70C150 -170 260 -20 0 160Z" }, 0, "path" },
  { gold, scanline { bounds = { -150, -150, 300, 300 }, spans = blinds }, 0, "scanline" },
}

return film { size = { 1920, 960 }, frames = 48, frame = function(f)
  local u = f.index / f.count
  local beat = 1 + 0.07 * math.sin(2 * math.pi * u)
  local art = {}
  for i, tile in ipairs(tiles) do
    local x, y = (i - 1) % 4 * 480, (i - 1) // 4 * 480
    art[#art + 1] = rect { x, y, 480, 480, fill = tile[1] }
    art[#art + 1] = tile[2]:rotate(tile[3] * u):scale(tile[3] == 0 and i < 8 and beat or 1)
      :translate(x + 240, y + 215)
    art[#art + 1] = label(tile[4], x + 240, y + 450, tile[1] == ink and cream or ink, 44)
  end
  return cel(art)
end }
