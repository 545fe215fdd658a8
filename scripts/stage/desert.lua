local sky = linear { from = { 0, 0 }, to = { 0, 150 }, { 0, "#e8763a" },
  { 1, "#ffd27a" } }
local sand = linear { from = { 0, 150 }, to = { 0, 270 }, { 0, "#d98a4a" },
  { 1, "#a3522f" } }
local rocks = "M-20 152 V118 L20 112 L30 92 H98 L110 120 L150 132 L160 152 Z M356 152"
  .. " L372 126 L392 122 L400 78 H440 L452 116 L500 124 V152 Z"
local land = union {
  rect { -20, -20, 520, 190, fill = sky },
  circle { 300, 112, 58, fill = "#fff3cf" },
  path { fill = "#a8483c", d = rocks },
  rect { -20, 148, 520, 142, fill = sand },
  path { d = "M237 148 H243 L330 290 H150 Z", fill = "#4d3a44" } }
for i = 0, 8 do
  -- the line of the road, and poles beside it
  local near, far = 0.8 ^ i, 0.8 ^ (i + 0.5)
  local y, end_y = 148 + 122 * near, 148 + 122 * far
  land = land
    | polygon { { 240 - 3 * near, y }, { 240 + 3 * near, y }, { 240 + 3 * far, end_y },
      { 240 - 3 * far, end_y }, fill = "#ffe3a8" }
    | path { fill = "#4d2b33", d = "M-3 0 V-190 H-24 V-198 H24 V-190 H3 V0 Z" }
      :scale(near):translate(240 - 250 * near, y)
end
local car = path { d = "M-20 0 V-16 L-14 -30 H14 L20 -16 V0 Z", fill = "#c9302c" }
  | path {
    d = "M-14 -17 L-11 -27 H11 L14 -17 Z M-18 -2 H-11 V4 H-18 Z M11 -2 H18 V4 H11 Z",
    fill = "#4b2530" }
for x = -14, 14, 28 do car = car | circle { x, -9, 4, fill = "#fffbe6" } end

return { land = land, car = car }
