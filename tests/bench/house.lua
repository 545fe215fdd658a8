--- A house of 220 paths, as illustrators draw: large shapes, then details in front of them, hardly
--- anything at right angles, nothing translucent.
---
---        roof, 54 tiles          sky, sun, clouds, hills, lawn
---        windows, door             tree: 16 leaves, 6 apples
---     wall, 72 bricks
---   ---- fence, 16 pickets ----    path, 8 stones
local prng = require "tests.support.prng"

local house = {}

local Sheet = {}
Sheet.__index = Sheet

--- Up to 0.0015 to either side, as a hand would draw.
function Sheet:near(value) return value + self.random:between(-0.0015, 0.0015) end

--- A colour near another.
function Sheet:shade(colour, spread)
  local change, out = self.random:whole(-spread, spread), {}
  for i = 1, 3 do out[i] = math.max(0, math.min(255, colour[i] + change)) end
  return out
end

function Sheet:add(colour, data)
  self[#self + 1] = ("path nonzero %d %d %d 255 %s"):format(colour[1], colour[2], colour[3], data)
end

--- points: x, y, x, y, ...
function Sheet:polygon(colour, points)
  local words = {}
  for i = 1, #points, 2 do
    words[#words + 1] = ("%s %.6f %.6f"):format(i == 1 and "M" or "L", points[i], points[i + 1])
  end
  self:add(colour, table.concat(words) .. "Z")
end

--- A rectangle by a steady hand: each corner is a little off.
function Sheet:board(colour, x0, y0, x1, y1)
  local points = { x0, y0, x1, y0, x1, y1, x0, y1 }
  for i, value in ipairs(points) do points[i] = self:near(value) end
  self:polygon(colour, points)
end

--- A closed curve around a point through `count` places, whose distances differ by a share.
function Sheet:blob(colour, x, y, rx, ry, count, share)
  local places = {}
  for i = 1, count do
    local angle, far = 2 * math.pi * i / count, 1 + self.random:between(-share, share)
    places[i] = { x + rx * far * math.cos(angle), y + ry * far * math.sin(angle) }
  end
  local function at(i) return places[(i - 1) % count + 1] end
  local words = { ("M %.6f %.6f"):format(at(1)[1], at(1)[2]) }
  for i = 1, count do -- a Catmull-Rom spline
    local before, from, to, after = at(i - 1), at(i), at(i + 1), at(i + 2)
    words[#words + 1] = ("C %.6f %.6f %.6f %.6f %.6f %.6f"):format(
      from[1] + (to[1] - before[1]) / 6, from[2] + (to[2] - before[2]) / 6,
      to[1] - (after[1] - from[1]) / 6, to[2] - (after[2] - from[2]) / 6, to[1], to[2])
  end
  self:add(colour, table.concat(words) .. "Z")
end

-- ---------------------------------------------------------------- parts of the picture

--- Eight paths.
local function landscape(sheet)
  sheet:polygon({ 150, 205, 240 }, { 0, 0, 1, 0, 1, 1, 0, 1 })
  sheet:blob({ 255, 214, 70 }, 0.13, 0.14, 0.065, 0.065, 12, 0.04)
  for _, cloud in ipairs { { 0.33, 0.12, 0.1 }, { 0.62, 0.07, 0.07 }, { 0.87, 0.16, 0.09 } } do
    sheet:blob({ 250, 250, 252 }, cloud[1], cloud[2], cloud[3], cloud[3] / 2.6, 9, 0.15)
  end
  sheet:blob({ 120, 165, 100 }, 0.12, 0.74, 0.4, 0.2, 9, 0.05)
  sheet:blob({ 104, 150, 92 }, 0.85, 0.76, 0.42, 0.22, 9, 0.05)
  sheet:blob({ 110, 180, 80 }, 0.5, 1.1, 1, 0.36, 9, 0.02)
end

--- A wall and its bricks, nine rows of eight: 73 paths.
local function wall(sheet)
  sheet:board({ 205, 190, 175 }, 0.2, 0.45, 0.66, 0.8)
  for row = 0, 8 do
    for column = 0, 7 do
      local x = 0.205 + (column + row % 2 / 2) * 0.0535
      local y = 0.455 + row * 0.038
      sheet:board(sheet:shade({ 180, 88, 66 }, 22), x, y, math.min(x + 0.049, 0.655), y + 0.033)
    end
  end
end

--- A roof, its tiles, six rows of nine, a ridge and a gutter: 57 paths.
local function roof(sheet)
  sheet:polygon({ 110, 45, 40 }, { 0.15, 0.47, 0.26, 0.22, 0.6, 0.22, 0.71, 0.47 })
  for row = 0, 5 do
    local y, left = 0.235 + row * 0.037, 0.25 - row * 0.0165
    local width = (0.86 - 2 * left) / 9
    for column = 0, 8 do
      sheet:blob(sheet:shade({ 176, 70, 54 }, 18), left + (column + 0.5) * width, y + 0.018,
        width / 2.15, 0.021, 6, 0.04)
    end
  end
  sheet:board({ 90, 36, 32 }, 0.255, 0.21, 0.605, 0.23)
  sheet:board({ 235, 235, 230 }, 0.145, 0.462, 0.715, 0.478)
end

--- A chimney, its bricks and smoke: 9 paths.
local function chimney(sheet)
  sheet:board({ 150, 75, 60 }, 0.5, 0.14, 0.55, 0.25)
  for i = 0, 3 do
    sheet:board(sheet:shade({ 185, 95, 72 }, 15), 0.503 + i % 2 * 0.024, 0.15 + i // 2 * 0.035,
      0.524 + i % 2 * 0.024, 0.178 + i // 2 * 0.035)
  end
  sheet:board({ 100, 50, 42 }, 0.492, 0.128, 0.558, 0.146)
  for i = 1, 3 do
    sheet:blob({ 225, 228, 232 }, 0.53 + 0.02 * i, 0.125 - 0.028 * i, 0.012 + 0.006 * i,
      0.01 + 0.004 * i, 8, 0.12)
  end
end

--- A frame, the panes, curtains, bars, a sill and flowers: 8 paths.
local function window(sheet, x, y)
  sheet:board({ 245, 242, 235 }, x, y, x + 0.11, y + 0.13)
  sheet:board({ 110, 160, 190 }, x + 0.008, y + 0.008, x + 0.102, y + 0.122)
  for side = 0, 1 do
    local near, far = x + 0.008 + side * 0.094, x + 0.035 + side * 0.04
    sheet:polygon({ 225, 120, 130 }, { near, y + 0.008, far, y + 0.008, near, y + 0.1 })
  end
  sheet:board({ 245, 242, 235 }, x + 0.051, y, x + 0.059, y + 0.13)
  sheet:board({ 245, 242, 235 }, x, y + 0.056, x + 0.11, y + 0.064)
  sheet:board({ 200, 195, 185 }, x - 0.008, y + 0.128, x + 0.118, y + 0.14)
  sheet:blob({ 240, 90, 110 }, x + 0.055, y + 0.124, 0.05, 0.012, 14, 0.25)
end

--- A frame, the door, four panels and a knob: 7 paths.
local function door(sheet)
  sheet:board({ 240, 236, 228 }, 0.385, 0.595, 0.485, 0.8)
  sheet:board({ 60, 100, 85 }, 0.393, 0.603, 0.477, 0.8)
  for i = 0, 3 do
    local x, y = 0.401 + i % 2 * 0.037, 0.615 + i // 2 * 0.09
    sheet:board({ 75, 122, 104 }, x, y, x + 0.031, y + 0.075)
  end
  sheet:blob({ 230, 195, 90 }, 0.468, 0.705, 0.006, 0.006, 8, 0.05)
end

--- A trunk, leaves and apples: 23 paths.
local function tree(sheet)
  sheet:add({ 112, 78, 50 },
    "M 0.8 0.83C 0.815 0.75 0.812 0.68 0.8 0.6L 0.85 0.6C 0.84 0.68 0.845 0.75 0.87 0.83Z")
  for i = 1, 16 do
    local angle, far = i * 2.4, 0.026 * math.sqrt(i)
    sheet:blob(sheet:shade({ 70, 140, 62 }, 28), 0.825 + far * math.cos(angle),
      0.51 + far * math.sin(angle), 0.062, 0.05, 11, 0.18)
  end
  for i = 1, 6 do
    local angle = i * 2.4
    sheet:blob({ 214, 50, 46 }, 0.825 + 0.09 * math.cos(angle), 0.52 + 0.07 * math.sin(angle),
      0.012, 0.012, 8, 0.05)
  end
end

--- A way to the door and its stones: 9 paths.
local function way(sheet)
  sheet:add({ 214, 200, 170 },
    "M 0.395 0.8L 0.475 0.8C 0.48 0.88 0.53 0.93 0.6 1L 0.4 1C 0.4 0.93 0.39 0.87 0.395 0.8Z")
  for i = 0, 7 do
    sheet:blob(sheet:shade({ 180, 170, 150 }, 16), 0.42 + i % 2 * 0.035 + 0.008 * i,
      0.82 + i * 0.022, 0.016 + 0.001 * i, 0.009, 7, 0.12)
  end
end

--- Two rails and pickets on both sides of the way: 18 paths.
local function fence(sheet)
  local white = { 248, 246, 240 }
  sheet:board(white, 0, 0.858, 0.39, 0.87)
  sheet:board(white, 0.56, 0.858, 1, 0.87)
  for i = 0, 15 do
    local x = i < 8 and 0.02 + i * 0.047 or 0.575 + (i - 8) * 0.053
    local points = { x, 0.9, x, 0.835, x + 0.012, 0.818, x + 0.024, 0.835, x + 0.024, 0.9 }
    for k, value in ipairs(points) do points[k] = sheet:near(value) end
    sheet:polygon(sheet:shade(white, 6), points)
  end
end

--- The path lines of the whole.
function house.lines()
  local sheet = setmetatable({ random = prng.new(24) }, Sheet)
  for _, part in ipairs { landscape, wall, chimney, roof } do part(sheet) end
  window(sheet, 0.235, 0.5)
  window(sheet, 0.52, 0.5)
  for _, part in ipairs { door, way, tree, fence } do part(sheet) end
  return table.move(sheet, 1, #sheet, 1, {})
end

return house
