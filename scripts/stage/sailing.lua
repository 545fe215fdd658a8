local sea = linear { from = { 0, 150 }, to = { 0, 270 }, { 0, "#7cc4c9" },
  { 1, "#2c7f94" } }
local boat = union {
  path {
    d = "M-60 0 H64 C56 26 40 34 20 34 H-24 C-44 34 -54 22 -60 0 Z",
    fill = "#c8553d" },
  rect { -3, -96, 5, 98, fill = "#6b4a34" },
  path { d = "M6 -92 C52 -66 56 -30 52 -10 H6 Z", fill = "#fff6e0" },
  path { d = "M-7 -84 C-34 -60 -40 -34 -40 -10 H-7 Z", fill = "#f4d58d" } }

local function wave(y, phase, colour)
  local points = { { -40, 300 } }
  for x = -40, 520, 20 do
    points[#points + 1] = { x, y + 6 * math.sin(x / 34 + phase) }
  end
  points[#points + 1], points.fill = { 520, 300 }, colour
  return polygon(points)
end

return { sea = sea, boat = boat, wave = wave }
