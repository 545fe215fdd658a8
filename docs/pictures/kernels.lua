-- The frames of scripts/kernels.lua side by side, four times as large, each with its kernel and its
-- name; first the art itself. An argument names the folder with the frames, kernels.N.png, and
-- kernels.art.png.

local label = require "stage.label"

local folder = ...
local WIDTH, HEIGHT, GAP, LINE = 384, 160, 16, 24

local function sinc(x) return x == 0 and 1 or math.sin(math.pi * x) / (math.pi * x) end

local function mitchell(x)
  x = math.abs(x)
  return x < 1 and (7 * x ^ 3 - 12 * x ^ 2 + 16 / 3) / 6
    or x < 2 and (-7 / 3 * x ^ 3 + 12 * x ^ 2 - 20 * x + 32 / 3) / 6 or 0
end

local function box(radius)
  return function(x) return math.abs(x) <= radius and 0.5 / radius or 0 end
end

-- With their true heights, except for a single point, which is drawn as a line.
local KERNELS = {
  box(0.04), box(0.5), box(1),
  function(x) return math.abs(x) < 1.5 and math.exp(-2 * x * x) * 0.8 or 0 end,
  mitchell,
  function(x) return math.abs(x) < 3 and sinc(x) * sinc(x / 3) or 0 end,
  function(x) return math.max(0, 1 - math.abs(x)) end,
}

--- The kernel over three pixels to either side, with a base line.
local function profile(kernel)
  local outline = { { -38, 0 } }
  for x = -3, 3, 0.01 do
    outline[#outline + 1] = { 12 * x, -32 * math.min(1, kernel(x)) }
  end
  outline[#outline + 1] = { 38, 0 }
  outline.texture = "#e4572e"
  return polygon(outline) | rect { -38, -0.75, 76, 1.5, fill = "#1f2a44" }
end

local NAMES = { "none: a point", "area: a box of one pixel", "box, radius 1", "gaussian",
  "mitchell", "lanczos", "a tent of one's own" }

local function panel(name, words)
  local picture = image { file = folder .. "/kernels." .. name .. ".png", w = WIDTH, h = HEIGHT,
    sampling = "nearest" }
  return clip(picture, rect { 0, 0, WIDTH, HEIGHT, radius = 12 })
    | label(words, WIDTH / 2, HEIGHT + 24, "#f6ebd3", 19)
end

local panels = { panel("art", "the art") }
for i, kernel in ipairs(KERNELS) do
  panels[i + 1] = panel(i, NAMES[i]) | profile(kernel):translate(WIDTH - 50, HEIGHT - 20)
end
for i, object in ipairs(panels) do
  local column, row = (i - 1) % 2, (i - 1) // 2
  panels[i] = object:translate(GAP + column * (WIDTH + GAP), GAP + row * (HEIGHT + GAP + LINE))
end

return film {
  size = { 2 * WIDTH + 3 * GAP, 4 * (HEIGHT + LINE) + 5 * GAP }, frames = 1,
  frame = function() return { cel(panels), back = "#1f2a44" } end,
}
