-- @NAME@: a walk over the hills, drawn by a few lines of Lua.
--
--   celspan render film.lua -o out/film.mp4
--   celspan contact film.lua -o out/contact.png
--   celspan test
local celspan = require "celspan"
local sheet = require "celspan.sheet"

local ink, coat, boot = "#2b2438", "#e0563f", "#3c3350"

-- ---------------------------------------------------------------- the walk, drawing by drawing

--- A leg of a step: u runs from 0 to 1 over one stride, on the ground first, then through the air.
local function leg(u, colour)
  local is_down = u < 0.5
  local x = is_down and 30 - 120 * u or 60 * (u - 0.5) * 2 - 30
  local lift = is_down and 0 or 18 * math.sin(2 * math.pi * (u - 0.5))
  local knee = { x / 2 + 9, -24 - lift / 2 }
  return celspan.stroke { points = { { 0, -46 }, knee, { x, -6 - lift } }, degree = 2, width = 11,
                          cap = "round", texture = colour }
    | celspan.ellipse { centre = { x + 6, -5 - lift }, radii = { 13, 7 }, texture = colour }
end

--- An arm swings against the leg of its side.
local function arm(u, colour)
  local swing = math.cos(2 * math.pi * u)
  return celspan.stroke { points = { { -2, -88 }, { -8 * swing - 2, -68 }, { -26 * swing, -54 } },
                          degree = 2, width = 10, cap = "round", texture = colour }
end

--- The walker in one drawing. The body is lowest when the legs are far apart.
local function walker(u)
  local bob = -4 * math.abs(math.sin(2 * math.pi * u))
  local far = (u + 0.5) % 1
  local body = celspan.path { texture = coat,
    d = "M-13 -98 Q 0 -106 13 -98 L 24 -40 Q 0 -32 -24 -40 Z" }
  local head = celspan.circle { centre = { 3, -118 }, radius = 19, texture = "#f6cfae" }
  local nose = celspan.ellipse { centre = { 22, -114 }, radii = { 6, 4.5 }, texture = "#f0b08e" }
  local hat = celspan.path { texture = "#3f7d8c",
    d = "M-20 -124 Q -6 -156 14 -146 Q 10 -136 22 -126 Q 32 -123 34 -120 Q 4 -130 -20 -124 Z" }
  local scarf = celspan.stroke { points = { { 14, -100 }, { -8, -99 }, { -22, -96 + bob },
    { -42, -100 - 2 * bob } }, degree = 2, width = 9, cap = "round", texture = "#f3c74f" }
  local top = arm(far, "#b4412f") | body | head | nose | hat | scarf | arm(u, "#c94a36")
  return leg(far, "#2a2339") | leg(u, boot) | top:translate(0, bob)
end

--- The drawings by the names that the sheet uses: "1" to "8", one eighth of a stride each.
local walk = {}
for i = 1, 8 do walk[tostring(i)] = walker((i - 1) / 8):named("walk " .. i) end

local eyes = {
  open = celspan.ellipse { centre = { 11, -121 }, radii = { 2.6, 3.8 }, texture = ink },
  shut = celspan.stroke { points = { { 7, -120 }, { 11, -118 }, { 15, -120 } }, degree = 2, width = 2,
                          cap = "round", texture = ink },
}

-- ---------------------------------------------------------------- the country

local sky = celspan.cel { celspan.rect { 0, 0, 640, 360, texture = celspan.linear {
  from = { 0, 0 }, to = { 0, 290 }, { 0, "#7fb7d6" }, { 0.65, "#f4dfc0" }, { 1, "#f7c9a0" } } },
  celspan.circle { centre = { 500, 92 }, radius = 34, texture = "#fff3cf" } }:named "sky"

--- Hills that repeat, so that the country has no end: as many waves as fit into a film's width.
local function hills(height, tall, waves, colour)
  local points = { { -640, 400 } }
  for x = -640, 1280, 20 do
    points[#points + 1] = { x, height - tall * math.sin(2 * math.pi * waves * x / 640) }
  end
  points[#points + 1] = { 1280, 400 }
  points.texture = colour
  return celspan.polygon(points)
end

local function tree(x, size)
  return celspan.stroke { points = { { x, 300, 7 * size }, { x, 262, 4 * size } }, texture = "#5b4636" }
    | celspan.ellipse { centre = { x, 300 - 68 * size }, radii = { 24 * size, 34 * size },
                        texture = "#4f8a5b" }
end

local far_hills = hills(236, 18, 2, "#9bb7a0")
local near_hills = hills(276, 10, 1, "#74a46f")
local trees = celspan.union { tree(-560, 1), tree(-300, 0.8), tree(80, 1), tree(340, 0.8), tree(720, 1),
                              tree(980, 0.8) }
local road = celspan.rect { -640, 300, 1920, 60, texture = "#d9b98a" }
  | hills(303, 2, 5, "#d9b98a")

-- ---------------------------------------------------------------- the film

local exposure = assert(sheet.read "walk.txt")

return celspan.film {
  size = { 640, 360 }, fps = 24, frames = 48, title = "@NAME@",
  frame = function(f)
    local along = 640 * f.index / f.count -- the near country passes once in the film, which so loops
    local figure = exposure:drawing("walker", f, walk)
    local eye = exposure:drawing("eyes", f, eyes)
    return celspan.rostrum {
      sky,
      celspan.cel { far_hills:translate(-along / 2, 0) }:named "far hills",
      celspan.cel { near_hills:translate(-along, 0), trees:translate(-along, 0) }:named "near hills",
      celspan.cel { road:translate(-along, 0) }:named "road",
      celspan.cel { celspan.ellipse { centre = { 300, 334 }, radii = { 44, 5 }, texture = "#00000038" },
        figure and figure:translate(300, 334), eye and eye:translate(300, 334) }:named "walker",
    }
  end,
}
