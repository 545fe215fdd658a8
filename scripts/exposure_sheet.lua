-- An exposure sheet beside the frame that it exposes: four drawings of a ball, each on its frames.
local sheet = require "celspan.sheet"

local exposure = sheet.new { name = "bounce", fps = 12, frames = 16, layers = { "shadow", "ball" },
  drawings = {
    ball = { [1] = "round", [4] = "fall", [7] = "flat", [9] = "rise", [12] = "round" },
    shadow = { [1] = "small", [4] = "large", [12] = "small" } } }

local ink, red, deep = "#3a3440", "#d8553a", "#a83a2a"

-- ---------------------------------------------------------------- the drawings

--- A ball of this shape, whose lowest point is 0, 0.
local function ball(rx, ry)
  local whole = ellipse { 0, -ry, rx, ry, fill = red }
  local shade = ellipse { -0.3 * rx, -1.3 * ry, rx, ry }
  local gleam = ellipse { -0.35 * rx, -1.45 * ry, 0.2 * rx, 0.14 * ry, fill = "#f6c1a8" }
  return whole | clip(rect { -rx, -2 * ry, 2 * rx, 2 * ry, fill = deep },
    whole - shade) | gleam
end

local balls = { round = ball(40, 40), fall = ball(34, 47), flat = ball(54, 28),
  rise = ball(35, 46) }
local shadows = {
  small = ellipse { 0, 4, 26, 4, fill = "#00000030" },
  large = ellipse { 0, 4, 46, 6, fill = "#00000048" },
}

-- ---------------------------------------------------------------- the sheet

local left, top, row, widths = 372, 52, 17, { 34, 96, 124 } -- columns: number, shadow, ball

local function write(text, x, y, size, texture, align)
  return celspan.text { text, x, y, font = "type/block.ttf", size = size, align = align,
    fill = texture }
end

local function line(x0, y0, x1, y1, width)
  return stroke { points = { { x0, y0 }, { x1, y1 } }, width = width, fill = "#b9b0a0" }
end

--- Names where a drawing changes, and a line down while it is held.
local function column(layer, x)
  local marks, bottom = { write(layer, x + 8, top - 9, 12, ink) }, top + row * exposure.frames
  local changes = exposure:changes(layer)
  for i, change in ipairs(changes) do
    local y = top + row * (change.frame - 1)
    local stop = changes[i + 1] and top + row * (changes[i + 1].frame - 1) or bottom
    marks[#marks + 1] = write(change.drawing, x + 8, y + 13, 11, ink)
    if stop - y > row then
      marks[#marks + 1] = stroke {
        points = { { x + 16, y + row + 2 }, { x + 16, stop - 4 } }, width = 1.5,
                                           cap = "round", fill = ink }
    end
  end
  return union(marks)
end

local width, height = widths[1] + widths[2] + widths[3], row * exposure.frames
local paper = rect { left, top - 28, width, height + 28, radius = 3, fill = "#fbf6e9" }
local lines, numbers = {}, {}
for n = 0, exposure.frames do
  lines[n + 1] = line(left, top + row * n, left + width, top + row * n, n % 4 == 0 and 1.6 or 0.7)
  if n > 0 then
    numbers[n] = write(tostring(n), left + 26, top + row * n - 4, 10, "#8a8070", "right")
  end
end
for _, x in ipairs { widths[1], widths[1] + widths[2] } do
  lines[#lines + 1] = line(left + x, top - 28, left + x, top + height, 1)
end
local drop = rect { left + 5, top - 22, width, height + 28, radius = 3,
  fill = "#00000028" }
local form = cel { drop, paper, union(lines), union(numbers),
  column("shadow", left + widths[1]), column("ball", left + widths[1] + widths[2]) }
local marker = rect { left, top, width, row, fill = "#ffc84a70" }

-- ---------------------------------------------------------------- the film

local stage = cel { rect { 0, 0, 640, 360, fill = "#5f7f86" },
  rect { 24, 24, 324, 300, radius = 3,
    fill = linear { from = { 0, 24 }, to = { 0, 324 }, { 0, "#f3e6cc" },
    { 1, "#e8cfa6" } } },
  rect { 24, 268, 324, 56, radius = 3, fill = "#c9a173" } }

--- The height of the ball: highest at frames 1 and 16, on the ground at 7 and 8.
local function height_at(n)
  local u = n <= 7 and (n - 1) / 6 or n <= 8 and 1 or (16 - n) / 8
  return 150 * (1 - math.max(0, math.min(1, u)) ^ 2)
end

return film { size = { 640, 360 }, fps = 12, frames = 16, frame = function(f)
  return { stage, form,
    marker:translate(0, row * f.index),
    cel { exposure:drawing("shadow", f, shadows):translate(186, 284),
      exposure:drawing("ball", f, balls):translate(186, 284 - height_at(f.number)) },
  }
end }
