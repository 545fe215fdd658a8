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

--- How high the body is above its lowest place, where the legs are far apart.
local function rise(u) return 4 * math.abs(math.sin(2 * math.pi * u)) end

--- The walker in one drawing.
local function walker(u)
  local bob = -rise(u)
  local far = (u + 0.5) % 1
  local body = celspan.path { texture = coat,
    d = "M-13 -98 Q 0 -106 13 -98 L 24 -40 Q 0 -32 -24 -40 Z" }
  local head = celspan.circle { centre = { 3, -118 }, radius = 19, texture = "#f3bf98" }
    | celspan.ellipse { centre = { 9, -110 }, radii = { 5, 3.5 }, texture = "#ee9a7c" }
    | celspan.stroke { points = { { 12, -107.5 }, { 15.5, -105.5 }, { 18.5, -108 } }, degree = 2,
      width = 1.8,
                       cap = "round", texture = ink }
  local nose = celspan.ellipse { centre = { 22, -114 }, radii = { 6, 4.5 }, texture = "#e8a07c" }
  local hair = celspan.path { texture = "#6b3f2a",
    d = "M-18 -122 C -24 -112 -20 -102 -12 -100 C -10 -106 -8 -114 -4 -122 Z" }
  local hat = celspan.path { texture = "#3f7d8c",
    d = "M-20 -124 Q -6 -156 14 -146 Q 10 -136 22 -126 Q 32 -123 34 -120 Q 4 -130 -20 -124 Z" }
  local flutter = 6 * math.sin(4 * math.pi * u)
  local scarf = celspan.stroke {
    points = { { 15, -100 }, { -8, -98 }, { -24, -97, 9 }, { -40, -102 + flutter, 8 },
    { -58, -98 - flutter, 5 } }, degree = 2, width = 10, cap = "round", texture = "#f3c74f" }
  local pocket = celspan.stroke { points = { { 6, -58 }, { 16, -60 } }, width = 2.5, cap = "round",
                                  texture = "#a83c2b" }
  local top = arm(far, "#b4412f") | body | pocket | hair | head | nose | hat | scarf
    | arm(u, "#c94a36")
  return leg(far, "#2a2339") | leg(u, boot) | top:translate(0, bob)
end

--- The drawings by the names that the sheet uses: "1" to "8", one eighth of a stride each.
local walk = {}
for i = 1, 8 do walk[tostring(i)] = walker((i - 1) / 8):named("walk " .. i) end

local eyes = {
  open = celspan.ellipse { centre = { 11, -121 }, radii = { 2.6, 3.8 }, texture = ink },
  shut = celspan.stroke { points = { { 7, -120 }, { 11, -118 }, { 15, -120 } }, degree = 2,
    width = 2,
                          cap = "round", texture = ink },
}

-- ---------------------------------------------------------------- the country

local sky = celspan.cel { celspan.rect { 0, 0, 640, 360, texture = celspan.linear {
  from = { 0, 0 }, to = { 0, 290 }, { 0, "#4f9cc4" }, { 0.6, "#a9d6dd" }, { 1, "#f2eecf" } } },
  celspan.circle { centre = { 500, 92 }, radius = 56, texture = "#fff3cf40" },
  celspan.circle { centre = { 500, 92 }, radius = 34, texture = "#fff3cf" } }:named "sky"

--- A cloud: five discs on one line.
local function cloud(x, y, size)
  local discs = {}
  for i, radius in ipairs { 10, 17, 22, 16, 9 } do
    discs[i] = celspan.circle { centre = { x + (i - 3) * 17 * size, y - radius * size * 0.7 },
      radius = radius * size }
  end
  return celspan.clip(celspan.rect { x - 90, y - 90, 180, 90, texture = "#ffffffd0" },
    celspan.union(discs))
end
local sailing = {}
for x = -20, 1260, 320 do -- half a film's width apart
  sailing[#sailing + 1] = cloud(x, 84, 1.1) | cloud(x + 150, 140, 0.7)
end
local clouds = celspan.union(sailing)

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
  local crown = celspan.ellipse { centre = { 0, -68 }, radii = { 26, 36 }, texture = "#3f7d55" }
  local light = celspan.ellipse { centre = { 9, -76 }, radii = { 22, 32 }, texture = "#58a06a" }
  local trunk = celspan.stroke { points = { { 0, 0, 8 }, { 0, -60, 3 } }, texture = "#5b4636" }
  return (trunk | crown | celspan.clip(light, crown)):scale(size):translate(x, 302)
end

local far_hills = hills(236, 18, 2, "#9bb7a0")
local near_hills = hills(276, 10, 1, "#74a46f")
local trees = celspan.union { tree(-560, 1), tree(-300, 0.8), tree(80, 1), tree(340, 0.8),
  tree(720, 1),
                              tree(980, 0.8) }
local road = celspan.rect { -640, 304, 1920, 60, texture = "#d9b98a" } | hills(304, 2, 5, "#d9b98a")
local stones = {}
for i = 1, 30 do -- the same fifteen on either half
  local x, y = 10 + 620 * (i % 15 * 0.618 % 1) + (i > 15 and 640 or 0),
    318 + 34 * (i % 15 * 0.37 % 1)
  stones[i] = celspan.ellipse { centre = { x, y }, radii = { 2 + i % 3, 1.4 }, texture = "#b8935f" }
end
local ground = road | celspan.union(stones)

-- ---------------------------------------------------------------- the film

local exposure = assert(sheet.read "walk.txt")

return celspan.film {
  size = { 640, 360 }, fps = 24, frames = 48, title = "@NAME@",
  frame = function(f)
    -- the near country passes once in the film, which so loops
    local along = 640 * f.index / f.count
    local number = exposure:at("walker", f.number) -- "1" to "8"
    local eye = exposure:drawing("eyes", f, eyes):translate(0, -rise((number - 1) / 8))
    local figure = (exposure:drawing("walker", f, walk) | eye):scale(1.3):translate(290, 336)
    return celspan.rostrum {
      sky,
      celspan.cel { clouds:translate(-along / 2, 0) }:named "clouds",
      celspan.cel { far_hills:translate(-along / 2, 0) }:named "far hills",
      celspan.cel { near_hills:translate(-along, 0),
        trees:translate(-along, 0) }:named "near hills",
      celspan.cel { ground:translate(-along, 0) }:named "road",
      celspan.cel { celspan.ellipse { centre = { 292, 336 }, radii = { 52, 6 },
        texture = "#00000038" }, figure }
        :named "walker",
    }
  end,
}
