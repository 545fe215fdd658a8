local lamps = {}
for i = 1, 84 do
  local x, y = 640 * (0.7549 * i % 1), 320 - 210 * (0.5698 * i % 1) ^ 2
  local colour = ({ "#ffb347", "#ff8a4a", "#ffd98a", "#ffb060", "#7fd0d8", "#e0662b" })[i
    * 7
    % 6
    + 1]
  lamps[i] = circle { x, y, 1.2 + 1.6 * (0.618 * i % 1), fill = colour }
end
--- A leaf of a length, one half darker; `wide` is its breadth: a leaf that is turned is narrow.
local function leaf(length, wide, tint)
  local shape = path { d = ("M0 0C%g %g %g %g %g 0C%g %g %g %g 0 0Z"):format(length * 0.2,
    -wide, length * 0.66, -wide * 1.1, length, length * 0.6, wide * 0.8, length * 0.2, wide) }
  local under = path { d = ("M0 0Q%g 3 %g 0V%gH0Z"):format(length / 2, length, 2 * wide) }
  return union { shape:paint(tint), clip(under, shape):paint(colour.lighten(tint, -0.05)),
    stroke { d = ("M0 0Q%g 3 %g 0"):format(length / 2, length - 6), width = 1.4,
      taper = { 0, 30 }, fill = colour.lighten(tint, 0.08) } }
end

local DARK, PALE = "#16382f", "#2f5a41"
local sprig = { path {
  d = "M-10 330 C 150 300 300 200 420 40 L 424 42 C 306 206 154 306 -10 340 Z",
  fill = "#10261f" } }
for i, at in ipairs { { 96, 21, -84, DARK }, { 82, 15, 32, PALE }, { 104, 22, -66, DARK },
  { 60, 6, 4, PALE }, { 92, 19, -88, PALE }, { 84, 17, 22, DARK }, { 70, 14, -72, DARK },
  { 74, 15, 2, PALE }, { 52, 11, -96, DARK }, { 44, 9, -12, PALE } } do
  local u = (i - 1) / 9
  sprig[#sprig + 1] = leaf(at[1], at[2], at[4]):rotate(at[3])
    :translate(20 + 390 * u, 326 - 90 * u - 180 * u * u)
end

return { lamps = lamps, sprig = sprig }
