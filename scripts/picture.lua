-- Pictures as paint and as light: two postcards lie on a desk as opaque paint, under perspective;
-- the third is a slide, a picture of pure gel, that shines once the lamp behind it is lit.

local wide, high = 640, 360

local function card(file)
  return union {
    rect { -18, -18, wide + 36, high + 36, radius = 6, fill = "#f8efdc" },
    image { file = "pictures/" .. file, w = wide },
  }
end

local shade = rect { -6, -2, wide + 40, high + 44, radius = 10, fill = "#0a050c66" }

--- The corners on the desk, clockwise from the upper left.
local function lay(art, corners)
  return art:quad({ { 0, 0 }, { wide, 0 }, { wide, high }, { 0, high } }, corners)
end

local canal, wood = card "canal.png", card "wood.png"
local slide = image { file = "pictures/village.png", as = "gel", x = 520, y = 66, w = 880 }

local grain = {}
for i = 0, 13 do
  grain[i + 1] = rect { 0, i * 80, 1920, 78, fill = linear {
    from = { 0, 0 }, to = { 1920, 0 },
    { 0, "#3b2730" }, { 0.5 + 0.3 * math.sin(i * 2), "#5b3b3b" }, { 1, "#2c1d29" } } }
end
local desk = rect { 0, 0, 1920, 1080, fill = "#21161f" } | union(grain)
local mount = rect { 476, 22, 968, 583, radius = 26, fill = "#e9e2d4" }

return film { frames = 48, frame = function(f)
  local u = ease "inOutSine" (math.min(1, f.progress * 1.6))
  local lamp, room = 0.03 + 1.1 * u, 1 - 0.45 * u
  local left = { { 206, 640 }, { 792, 560 }, { 890, 912 }, { 150, 1010 } }
  local right = { { 1130, 590 }, { 1712, 640 }, { 1790, 1010 }, { 1060, 934 } }
  return { front = { room, room * (1 - 0.1 * u), room * (1 - 0.05 * u) },
    cel { slide, back = { lamp, lamp * 0.98, lamp * 0.92 } },
    cel {
      desk - rect { 520, 66, 880, 495 }, mount - rect { 520, 66, 880, 495 },
      lay(shade, left), lay(canal, left), lay(shade, right), lay(wood, right),
    },
  }
end }
