-- Stands for a photograph in scripts/relight.lua: a corner of two streets at noon, as a picture of
-- floats in memory. Its light is known, because it is drawn here; so is where shadows fall later.

local photo = { width = 400, height = 600, light = { 1.1, 1.05, 0.9 } }
local WALL, SHUTTER, IRON, RED, CREAM = "#ecdcbc", "#3f7f78", "#2b2622", "#c0392b", "#fff6e2"

local function line(d, width, tint)
  return stroke { d = d, width = width, cap = "round", join = "round", fill = tint }
end

--- A window with shutters and a sill, 60 wide; its panes are returned, too.
local function window(x, y, height, flowers)
  local panes = rect { x + 18, y + 4, 11, height - 8 } | rect { x + 31, y + 4, 11, height - 8 }
  local slats = {}
  for i = 0, height // 8 - 1 do
    slats[#slats + 1] = rect { x + 1, y + 4 + 8 * i, 11, 2, fill = "#2c5f5a" }
    slats[#slats + 1] = rect { x + 48, y + 4 + 8 * i, 11, 2, fill = "#2c5f5a" }
  end
  local art = { rect { x + 15, y, 30, height, fill = CREAM }, panes:paint "#35494c",
    rect { x, y, 13, height, fill = SHUTTER }, rect { x + 47, y, 13, height, fill = SHUTTER },
    union(slats), rect { x + 10, y + height, 40, 5, fill = "#cdb98f" } }
  for i = 0, flowers and 7 or -1 do
    art[#art + 1] = circle { x + 14 + 4.6 * i, y + height - 5 + 3 * (i % 2), 4,
      fill = i % 3 == 0 and RED or "#4f7d3c" }
  end
  return union(art), panes
end

--- A wall with windows at the places, and what else is on it, mapped to four corners.
local function wall(width, places, art, corners)
  local parts, lit = { rect { 0, 0, width, 430, fill = WALL },
    rect { 0, 150, width, 4, fill = "#d8c498" }, rect { 0, 396, width, 34, fill = "#b49c76" } }, {}
  for i, at in ipairs(places) do
    parts[#parts + 1], lit[i] = window(at[1], at[2], 66, i % 2 == 0)
  end
  parts[#parts + 1] = art
  local flat = { { 0, 0 }, { width, 0 }, { width, 430 }, { 0, 430 } }
  return union(parts):quad(flat, corners), lit[2]:quad(flat, corners), lit[3]:quad(flat, corners)
end

local shop = union { rect { 34, 276, 124, 112, fill = SHUTTER }, rect { 40, 282, 112, 94,
  fill = "#35494c" }, rect { 194, 276, 62, 150, fill = SHUTTER }, rect { 202, 284, 46, 70,
  fill = "#35494c" }, circle { 206, 372, 3, fill = "#ead49a" } }
for i = 0, 6 do
  shop = shop | ellipse { 52 + 15 * i, 372, 8, 10,
    fill = ({ "#d98a3a", "#8fa04a", RED })[i % 3 + 1] }
end
local door = union { rect { 30, 262, 58, 168, fill = "#cdb98f" }, rect { 36, 268, 46, 162,
  fill = "#7a4a2c" }, rect { 42, 278, 34, 50, fill = "#633a22" }, rect { 42, 340, 34, 60,
  fill = "#633a22" } } | window(128, 290, 70, true)
local left, left_lit, left_warm = wall(300, { { 26, 56 }, { 120, 56 }, { 214, 56 }, { 26, 172 },
  { 120, 172 }, { 214, 172 } }, shop, { { 0, 212 }, { 236, 90 }, { 236, 520 }, { 0, 488 } })
local right, _, right_warm = wall(220, { { 26, 56 }, { 130, 56 }, { 26, 172 }, { 130, 172 } }, door,
  { { 236, 90 }, { 400, 196 }, { 400, 492 }, { 236, 520 } })

local awning = union {}
for i = 0, 10 do
  local a, b = i / 11, (i + 1) / 11
  local function top(u) return 2 + 220 * u, 384 - 27 * u end
  local function foot(u) return -64 + 246 * u, 432 - 28 * u end
  local x0, y0 = top(a)
  local x1, y1 = top(b)
  local x2, y2 = foot(b)
  local x3, y3 = foot(a)
  local tint = i % 2 == 0 and RED or CREAM
  awning = awning | polygon { { x0, y0 }, { x1, y1 }, { x2, y2 }, { x3, y3 }, fill = tint }
    | path { d = ("M%g %gQ%g %g %g %gZ"):format(x3, y3, (x2 + x3) / 2, y2 + 18, x2, y2),
      fill = colour.lighten(tint, -0.08) }
end

local bicycle = line("M-36 0m-26 0a26 26 0 1 0 52 0a26 26 0 1 0 -52 0M36 2m-26 0a26 26 0 1 0 52 0"
  .. "a26 26 0 1 0 -52 0", 3, IRON)
  | line("M-36 0L-20 -40L22 -38L-4 0L-36 0M-4 0L-22 -46M36 2L22 -38L19 -52", 4, RED)
  | line("M-32 -48H-14M19 -52Q30 -60 36 -50", 5, "#6b4428")
  | path { d = "M26 -40H50L46 -18H30Z", fill = "#c9a05c" }

local cat = path { fill = IRON,
  d = "M-14 0C-20 -22 -8 -34 -4 -40L-7 -58L0 -51H7L14 -58L12 -42C16 -34 14 -8 16 0Z" }
  | line("M-12 -2Q-34 2 -30 -20", 5, IRON)

local wash = union { line("M-10 96Q90 168 206 132", 1.6, IRON) }
for i, at in ipairs { { 8, 109, CREAM }, { 42, 127, "#d9893b" }, { 80, 140, CREAM },
  { 114, 145, SHUTTER }, { 150, 144, RED } } do
  wash = wash | path { fill = at[3], d = i % 2 == 1 and "M0 0L27 3L25 42Q14 38 2 42Z"
    or "M0 2L8 0H16L25 2L30 14L22 17L21 40H3L3 16L-5 13Z" }:translate(at[1], at[2])
end

local cobbles = {}
for row = 0, 8 do
  local y = 514 + row * (row + 9)
  for i = 0, 16 do
    cobbles[#cobbles + 1] = rect { i * (22 + 3 * row) - 30 - 11 * (row % 2) - 12 * row, y,
      19 + 3 * row, 7 + 1.6 * row, radius = 3 + row / 2,
      fill = ({ "#b7a58a", "#ab987b", "#c2b196" })[(3 * row + i * i) % 3 + 1] }
  end
end

local glass = path { d = "M-9 -12H9L6 12H-6Z" }:translate(262, 268)
local lamp = line("M238 232H258Q262 234 262 246M238 256Q252 254 256 234", 3.4, IRON)
  | path { d = "M-13 -12L0 -24L13 -12ZM-7 12H7L4 18H-4Z", fill = IRON }:translate(262, 268)
local scene = rostrum { front = photo.light, cel {
  rect { 0, 0, 400, 600, fill = linear { from = { 0, 0 }, to = { 0, 220 }, { 0, "#9fcfdf" },
    { 1, "#eef2e4" } } },
  rect { 338, 70, 40, 160, fill = "#d9c6a4" }, polygon { { 334, 72 }, { 358, 24 }, { 382, 72 },
    fill = "#b5563a" }, rect { 350, 88, 16, 26, radius = 8, fill = "#6f6653" },
  rect { 0, 470, 400, 130, fill = "#9a8a70" }, union(cobbles),
  polygon { { 0, 484 }, { 236, 514 }, { 400, 486 }, { 400, 504 }, { 236, 540 }, { 0, 506 },
    fill = "#d2c4a6" },
  left, right, polygon { { -6, 208 }, { 236, 78 }, { 406, 188 }, { 406, 202 }, { 236, 96 },
    { -6, 222 }, fill = "#b5563a" }, awning, wash, lamp, glass:paint(CREAM),
  bicycle:translate(160, 500), cat:translate(78, 562) } }

--- Where the sun does not reach: under the awning, and from the corner to the right in the evening,
-- when the shadows of what stands in the street are long. `u` is how late it is, 0 to 1.
function photo.shade(u)
  local long = math.min(1, 2 * u)
  local function between(a, b) return a + (b - a) * long end
  local shapes = { polygon { { between(0, 70), 384 }, { 226, 357 },
    { between(226, 236), between(424, 378) }, { between(0, 90), between(446, 398) } } - awning }
  for _, at in ipairs { { cat, 78, 562 }, { bicycle, 160, 526, 500 } } do
    shapes[#shapes + 1] = at[1]:translate(0, at[4] and at[4] - at[3] or 0)
      :scale(1, -0.1 - 0.3 * long):skew(72 * long, 0):translate(at[2], at[3])
  end
  if u == 0 then return union(shapes) end
  shapes[#shapes + 1] = polygon { { 236, 96 }, { between(236, 400), between(96, 200) },
    { between(240, 400), between(520, 586) }, { 236, 520 } }
  return union(shapes)
end

--- What shines in the night, and the light of the lamp at the corner.
photo.lights = union { glass:paint "#fff0c0", left_warm:paint "#ffc061", left_lit:paint "#ffb04a",
  right_warm:paint "#ffc061" }
photo.lamp = { centre = { 262, 268 }, radius = 330 }
for i = 0, 12 do
  local k = (1 - i / 12) ^ 2
  photo.lamp[i + 1] = { i / 12, rgb(k, 0.62 * k, 0.26 * k) }
end

--- The picture.
function photo.take()
  local size = { photo.width, photo.height }
  local image = assert(pixels(scene, { size = size }))
  return picture { pixels = image:bytes { depth = "float" }, size = size, format = "rgbaf" }
end

return photo
