--- What was filmed. Of a real take: image { file = "take.####.png", frame = f.number }.
local function take(f)
  local lift = 14 * math.sin(4 * f.time)
  local cat = union {
    path { d = "M300 280 C290 134 414 134 404 280 Z", fill = "#6d7fae" },
    stroke {
      d = ("M310 210 C280 206 262 190 240 %g"):format(150 + lift),
      width = 20, fill = "#6d7fae" },
    circle { 238, 148 + lift, 13, fill = "#f3ece6" },
    path {
      d = "M306 122 L302 66 L334 92 Q352 86 370 92 L402 66 L398 122 C400 200 304"
        .. " 200 306 122 Z",
      fill = "#e58a5a" } }
  local face = union {
    ellipse { 352, 148, 26, 20, fill = "#f3ece6" },
    stroke {
      d = "M334 120 V124 M370 120 V124 M352 138 V139",
      width = 12, cap = "round", fill = "#2b2530" } }
  local cloth = radial { centre = { 300, 120 }, radius = 330, { 0, "#3ec45c" },
    { 1, "#27963f" } }
  -- the green light that the cloth throws on the cat
  local spill = cat:paint(rgb("#3ec45c", 0.12))
  return group { rect { 0, 0, 480, 270, fill = cloth }, cat, spill, face }:blur(0.8)
end

return take
