--- A stroke font of straight lines, and polylines as celspan objects: celspan draws no text.
---
--- A glyph is polylines of points, two digits each: x from 0 to 4, y from 0 (the capitals' top)
--- over 6 (the baseline) to 8.
local celspan = require "celspan"

local strokes = {}

local glyphs = {
  ["0"] = "10 30 41 45 36 16 05 01 10", ["1"] = "11 20 26|16 36", ["2"] = "01 10 30 41 42 06 46",
  ["3"] = "01 10 30 41 42 33 44 45 36 16 05|13 33", ["4"] = "36 30 04 44",
  ["5"] = "40 00 03 33 44 45 36 06", ["6"] = "41 30 10 01 05 16 36 45 44 33 03",
  ["7"] = "00 40 16", ["8"] = "13 02 01 10 30 41 42 33 13 04 05 16 36 45 44 33",
  ["9"] = "05 16 36 45 41 30 10 01 02 13 43",
  ["."] = "26", [","] = "26 17", ["-"] = "14 34", ["/"] = "06 40", [":"] = "23|26", ["'"] = "20 22",
  ["("] = "30 21 25 36", [")"] = "10 21 25 16", ["="] = "13 43|15 45", ["+"] = "14 44|23 25",
  a = "12 32 43 46 16 05 14 44", b = "00 06 36 45 43 32 02", c = "42 12 03 05 16 46",
  d = "40 46 16 05 03 12 42", e = "04 44 43 32 12 03 05 16 46", f = "30 20 11 16|02 32",
  g = "42 12 03 05 16 46|42 47 38 08", h = "00 06|02 32 43 46", i = "22 26|20",
  j = "22 27 18 08|20", k = "00 06|42 04 46", l = "20 26", m = "06 02 12 23 26|23 32 43 46",
  n = "06 02 32 43 46", o = "12 32 43 45 36 16 05 03 12", p = "08 02 32 43 45 36 06",
  q = "48 42 12 03 05 16 46", r = "06 02|03 12 32", s = "42 12 03 14 34 45 36 06",
  t = "10 15 26 36|02 32", u = "02 05 16 46|42 46", v = "02 26 42", w = "02 16 23 36 42",
  x = "02 46|42 06", y = "02 25|42 17 08", z = "02 42 06 46",
  A = "06 20 46|14 34", B = "00 06 36 45 44 33 03|33 42 41 30 00", C = "41 30 10 01 05 16 36 45",
  D = "00 06 26 44 42 20 00", E = "40 00 06 46|03 33", F = "40 00 06|03 33",
  G = "41 30 10 01 05 16 36 45 43 23", H = "00 06|40 46|03 43", I = "20 26|10 30|16 36",
  J = "40 45 36 16 05", K = "00 06|40 03 46", L = "00 06 46", M = "06 00 23 40 46",
  N = "06 00 46 40", O = "10 30 41 45 36 16 05 01 10", P = "06 00 30 41 42 33 03",
  Q = "10 30 41 45 36 16 05 01 10|24 46", R = "06 00 30 41 42 33 03|23 46",
  S = "41 30 10 01 02 13 33 44 45 36 16 05", T = "00 40|20 26", U = "00 05 16 36 45 40",
  V = "00 26 40", W = "00 16 23 36 40", X = "00 46|40 06", Y = "00 23 40|23 26",
  Z = "00 40 06 46",
}

--- A line from point to point, round at its ends.
local function segment(list, a, b, width, texture)
  local dx, dy = b[1] - a[1], b[2] - a[2]
  local length = math.sqrt(dx * dx + dy * dy)
  if length == 0 then return end
  local nx, ny = -dy / length * width / 2, dx / length * width / 2
  list[#list + 1] = celspan.polygon { { a[1] + nx, a[2] + ny }, { b[1] + nx, b[2] + ny },
    { b[1] - nx, b[2] - ny }, { a[1] - nx, a[2] - ny }, texture = texture }
end

--- Adds a polyline to a list of objects. dash: its length and its gap's, or nothing.
function strokes.line(list, points, width, texture, dash)
  for i, point in ipairs(points) do
    local before = points[i - 1]
    if before and dash then
      local dx, dy = point[1] - before[1], point[2] - before[2]
      local length = math.sqrt(dx * dx + dy * dy)
      for at = 0, length, 2 * dash do
        local u, v = at / length, math.min(1, (at + dash) / length)
        segment(list, { before[1] + u * dx, before[2] + u * dy },
          { before[1] + v * dx, before[2] + v * dy }, width, texture)
      end
    elseif before then segment(list, before, point, width, texture) end
    if not dash then
      list[#list + 1] = celspan.circle { centre = point, radius = width / 2, texture = texture }
    end
  end
end

--- The polylines of a glyph, and the columns they take.
local function read(letter)
  local lines, least, most = {}, 4, 0
  for part in (glyphs[letter] or ""):gmatch "[^|]+" do
    local line = {}
    for x, y in part:gmatch "(%d)(%d)" do
      line[#line + 1] = { tonumber(x), tonumber(y) }
      least, most = math.min(least, tonumber(x)), math.max(most, tonumber(x))
    end
    lines[#lines + 1] = line
  end
  if #lines == 0 then return lines, 0, 1 end
  return lines, least, most
end

--- How wide a text is at this height of capitals.
function strokes.width(text, height)
  local columns = 0
  for letter in text:gmatch "." do
    local _, least, most = read(letter)
    columns = columns + most - least + 2
  end
  return math.max(0, columns - 2) * height / 6
end

--- Adds a text with its baseline at y, of capitals as tall as `height`. align: 0 begins at x, 1
--- ends there.
function strokes.text(list, text, x, y, height, texture, align)
  local unit = height / 6
  local at = x - (align or 0) * strokes.width(text, height)
  for letter in text:gmatch "." do
    local lines, least, most = read(letter)
    for _, line in ipairs(lines) do
      local points = {}
      for i, p in ipairs(line) do
        points[i] = { at + (p[1] - least) * unit, y + (p[2] - 6) * unit }
      end
      strokes.line(list, points, height * 0.13, texture)
    end
    at = at + (most - least + 2) * unit
  end
end

return strokes
