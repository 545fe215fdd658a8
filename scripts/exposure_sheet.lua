-- An exposure sheet beside the frame that it exposes: four drawings of a ball, each on its frames.
local celspan = require "celspan"
local sheet = require "celspan.sheet"

local exposure = sheet.new { name = "bounce", fps = 12, frames = 16, layers = { "shadow", "ball" },
  drawings = {
    ball = { [1] = "round", [4] = "fall", [7] = "flat", [9] = "rise", [12] = "round" },
    shadow = { [1] = "small", [4] = "large", [12] = "small" } } }

local ink, red, deep = "#3a3440", "#d8553a", "#a83a2a"

-- ---------------------------------------------------------------- the drawings

--- A ball of this shape, whose lowest point is 0, 0.
local function ball(rx, ry)
  local whole = celspan.ellipse { centre = { 0, -ry }, radii = { rx, ry }, texture = red }
  local shade = celspan.ellipse { centre = { -0.3 * rx, -1.3 * ry }, radii = { rx, ry } }
  local gleam = celspan.ellipse { centre = { -0.35 * rx, -1.45 * ry },
    radii = { 0.2 * rx, 0.14 * ry }, texture = "#f6c1a8" }
  return whole | celspan.clip(celspan.rect { -rx, -2 * ry, 2 * rx, 2 * ry, texture = deep },
    whole - shade) | gleam
end

local balls = { round = ball(40, 40), fall = ball(34, 47), flat = ball(54, 28),
  rise = ball(35, 46) }
local shadows = {
  small = celspan.ellipse { centre = { 0, 4 }, radii = { 26, 4 }, texture = "#00000030" },
  large = celspan.ellipse { centre = { 0, 4 }, radii = { 46, 6 }, texture = "#00000048" },
}

-- ---------------------------------------------------------------- the sheet

local left, top, row, widths = 372, 52, 17, { 34, 96, 124 } -- columns: number, shadow, ball

local function write(text, x, y, size, texture, align)
  return celspan.text { text, font = "type/block.ttf", size = size, at = { x, y }, align = align,
    texture = texture }
end

local function line(x0, y0, x1, y1, width)
  return celspan.stroke { points = { { x0, y0 }, { x1, y1 } }, width = width, texture = "#b9b0a0" }
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
      marks[#marks + 1] = celspan.stroke {
        points = { { x + 16, y + row + 2 }, { x + 16, stop - 4 } }, width = 1.5,
                                           cap = "round", texture = ink }
    end
  end
  return celspan.union(marks)
end

local width, height = widths[1] + widths[2] + widths[3], row * exposure.frames
local paper = celspan.rect { left, top - 28, width, height + 28, radius = 3, texture = "#fbf6e9" }
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
local drop = celspan.rect { left + 5, top - 22, width, height + 28, radius = 3,
  texture = "#00000028" }
local form = celspan.cel { drop, paper, celspan.union(lines), celspan.union(numbers),
  column("shadow", left + widths[1]), column("ball", left + widths[1] + widths[2]) }
local marker = celspan.rect { left, top, width, row, texture = "#ffc84a70" }

-- ---------------------------------------------------------------- the film

local stage = celspan.cel { celspan.rect { 0, 0, 640, 360, texture = "#5f7f86" },
  celspan.rect { 24, 24, 324, 300, radius = 3,
    texture = celspan.linear { from = { 0, 24 }, to = { 0, 324 }, { 0, "#f3e6cc" },
    { 1, "#e8cfa6" } } },
  celspan.rect { 24, 268, 324, 56, radius = 3, texture = "#c9a173" } }

--- The height of the ball: highest at frames 1 and 16, on the ground at 7 and 8.
local function height_at(n)
  local u = n <= 7 and (n - 1) / 6 or n <= 8 and 1 or (16 - n) / 8
  return 150 * (1 - math.max(0, math.min(1, u)) ^ 2)
end

return celspan.film { size = { 640, 360 }, fps = 12, frames = 16, frame = function(f)
  return celspan.rostrum { stage, form,
    celspan.cel { marker:translate(0, row * f.index) },
    celspan.cel { exposure:drawing("shadow", f, shadows):translate(186, 284),
      exposure:drawing("ball", f, balls):translate(186, 284 - height_at(f.number)) },
  }
end }
