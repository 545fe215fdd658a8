--- Made line drawings of which all areas are known, with gaps in their lines, for tests of ink.
--
--     .---------.-------.--.     wavy lines across, and walls between them that meet them at right
--     |    |       |       |     angles; gaps are cut out of lines and walls, or part a wall from a
--     '----'  -----'-------'     line. A door is a gap between two stubs inside of an area.
local celspan = require "celspan"
local prng = require "tests.support.prng"

local inked = { width = 400, height = 300 }

local ROWS, COLUMNS = 3, 4
local LEFT, RIGHT, TOP, BOTTOM = 30, 370, 30, 270
local CLEAR = 24 -- from gaps to the places where walls meet lines

local function lerp(a, b, t) return a + (b - a) * t end

--- A line across: its height and slope at x.
local function wave(random, y)
  local one, other = random() * 6, random() * 6
  return function(x)
    return y + 5 * math.sin(x / 60 + one) + 3 * math.sin(x / 33 + other),
      5 / 60 * math.cos(x / 60 + one) + 3 / 33 * math.cos(x / 33 + other)
  end
end

--- A wall from one wave at x0 to the next at x1: points, upright to both at its ends.
local function wall(upper, lower, x0, x1)
  local y0, s0 = upper(x0)
  local y1, s1 = lower(x1)
  local pull, points = (y1 - y0) / 3, {}
  for i = 0, 160 do
    local t = i / 160
    local u = 1 - t
    points[i + 1] = {
      u * u * u * x0 + 3 * u * u * t * (x0 - s0 * pull) + 3 * u * t * t * (x1 + s1 * pull)
        + t * t * t * x1,
      u * u * u * y0 + 3 * u * u * t * (y0 + pull) + 3 * u * t * t * (y1 - pull) + t * t * t * y1 }
  end
  return points
end

local function across(curve, x0, x1)
  local points, steps = {}, math.max(1, math.ceil(math.abs(x1 - x0)))
  for i = 0, steps do
    local x = lerp(x0, x1, i / steps)
    points[i + 1] = { x, (curve(x)) }
  end
  return points
end

local function length_of(points)
  local sum = 0
  for i = 2, #points do
    local p, q = points[i - 1], points[i]
    sum = sum + ((q[1] - p[1]) ^ 2 + (q[2] - p[2]) ^ 2) ^ 0.5
  end
  return sum
end

--- The part of a line between two lengths.
local function part(points, from, to)
  local list, at = {}, 0
  for i = 2, #points do
    local p, q = points[i - 1], points[i]
    local length = ((q[1] - p[1]) ^ 2 + (q[2] - p[2]) ^ 2) ^ 0.5
    local s, t = math.max(0, (from - at) / length), math.min(1, (to - at) / length)
    if s < t then
      if #list == 0 then list[1] = { lerp(p[1], q[1], s), lerp(p[2], q[2], s) } end
      list[#list + 1] = { lerp(p[1], q[1], t), lerp(p[2], q[2], t) }
    end
    at = at + length
  end
  return list
end

--- Adds what is left of a line where gaps of the given middles and widths are cut out of it.
local function cut(drawing, points, gaps)
  local at, width = 0, drawing.line
  for _, gap in ipairs(gaps) do
    drawing.lines[#drawing.lines + 1] = part(points, at, gap[1] - (gap[2] + width) / 2)
    at = gap[1] + (gap[2] + width) / 2
  end
  drawing.lines[#drawing.lines + 1] = part(points, at, math.huge)
  drawing.whole[#drawing.whole + 1] = points
end

--- A line with perhaps a gap in each stretch between `joints`, which are lengths.
local function cut_some(drawing, random, points, joints)
  local gaps = {}
  for i = 2, #joints do
    local from, to = joints[i - 1] + CLEAR, joints[i] - CLEAR
    if to > from and random() < 0.5 then
      gaps[#gaps + 1] = { lerp(from, to, random()), 1 + random() * 11 }
    end
  end
  drawing.gaps = drawing.gaps + #gaps
  cut(drawing, points, gaps)
end

--- A wall, whole, or with a gap in it, or apart from the lines above or below it.
local function cut_wall(drawing, random, points)
  local length, choice, width = length_of(points), random(), drawing.line
  local gap = 1 + random() * 11
  drawing.gaps = drawing.gaps + (choice < 0.6 and 1 or 0)
  if choice < 0.2 then
    return cut(drawing, points, { { lerp(CLEAR, length - CLEAR, random()), gap } })
  end
  drawing.whole[#drawing.whole + 1] = points
  local from = choice < 0.4 and gap + width or 0
  local to = choice >= 0.4 and choice < 0.6 and length - gap - width or length
  drawing.lines[#drawing.lines + 1] = part(points, from, to)
end

local function reversed(points)
  local list = {}
  for i = #points, 1, -1 do list[#list + 1] = points[i] end
  return list
end

local function join(...)
  local outline = {}
  for _, points in ipairs { ... } do
    for _, p in ipairs(points) do outline[#outline + 1], outline[#outline + 2] = p[1], p[2] end
  end
  return outline
end

--- Two stubs inside of a cell that leave a passage.
local function add_door(drawing, random, x, y0, y1)
  local passage = 4 + random() * 7
  local middle, far = lerp(y0, y1, 0.5), (passage + drawing.line) / 2
  for _, ends in ipairs { { y0, middle - far }, { middle + far, y1 } } do
    local stub = { { x, ends[1] }, { x, ends[2] } }
    drawing.lines[#drawing.lines + 1], drawing.whole[#drawing.whole + 1] = stub, stub
  end
  drawing.doors = drawing.doors + 1
end

local function add_cells(drawing, random, walls, curves, row, has_doors)
  for column = 1, COLUMNS do
    local left, right = walls[column], walls[column + 1]
    local x0, x1 = left[1][1], right[1][1]
    local u0, u1 = left[#left][1], right[#right][1]
    local cell = { outline = join(across(curves[row], x0, x1), right,
      across(curves[row + 1], u1, u0), reversed(left)),
      x = (x0 + x1 + u0 + u1) / 4 - 12, y = (curves[row](x0) + curves[row + 1](u1)) / 2 }
    if has_doors and random() < 0.3 then
      local x = (x0 + x1 + u0 + u1) / 4 + 6
      add_door(drawing, random, x, (curves[row](x)), (curves[row + 1](x)))
      cell.has_door = true
    end
    drawing.cells[#drawing.cells + 1] = cell
  end
end

local function shifted_joints(row_walls, curve, at)
  local joints = {}
  for _, walls in ipairs(row_walls) do
    for _, points in ipairs(walls) do
      joints[#joints + 1] = length_of(across(curve, LEFT, points[at == "last" and #points or 1][1]))
    end
    at = "first"
  end
  table.sort(joints)
  return joints
end

--- A drawing: lines (with gaps), whole (without), line (their width), cells ({ outline, x, y,
--- has_door }, with a point inside), gaps and doors (how many there are).
function inked.make(seed, has_doors)
  local random = prng.new(seed)
  local function number() return random:between(0, 1) end
  local drawing = { lines = {}, whole = {}, cells = {}, gaps = 0, doors = 0,
    line = 2 + 3 * number() }
  local curves, rows = {}, {}
  for i = 0, ROWS do curves[i + 1] = wave(number, lerp(TOP, BOTTOM, i / ROWS)) end
  for row = 1, ROWS do
    rows[row] = {}
    for column = 0, COLUMNS do
      local is_rim = column == 0 or column == COLUMNS
      local x = lerp(LEFT, RIGHT, column / COLUMNS)
      local function place() return is_rim and x or x + (number() - 0.5) * 20 end
      rows[row][column + 1] = wall(curves[row], curves[row + 1], place(), place())
      cut_wall(drawing, number, rows[row][column + 1])
    end
    add_cells(drawing, number, rows[row], curves, row, has_doors)
  end
  for i, curve in ipairs(curves) do
    local meeting = { i > 1 and rows[i - 1] or rows[i], i > 1 and rows[i] or nil }
    cut_some(drawing, number, across(curve, LEFT, RIGHT),
      shifted_joints(meeting, curve, i > 1 and "last" or "first"))
  end
  return drawing
end

--- Lines as strokes of the drawing's width.
function inked.strokes(drawing, lines, fill)
  local list = {}
  for i, points in ipairs(lines) do
    list[i] = celspan.stroke { points = points, width = drawing.line, cap = "round", join = "round",
      fill = fill }
  end
  return celspan.union(list)
end

return inked
