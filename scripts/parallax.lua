-- Parallax: a wood in the morning mist, five planes of trunks. One pan moves every plane by its own
-- depth, and each farther plane is paler, as if there were more air in front of it.
local shapes = require "demo.shapes"

--- {depth 0..1, trunks, width, colour at the top, colour at the foot}
local planes = {
  { 0.10, 15, 26, "#bcd3c4", "#e9ecd2" }, { 0.22, 12, 40, "#94b8ac", "#d3dfc6" },
  { 0.40, 9, 62, "#5f9088", "#a3bfa8" }, { 0.65, 7, 96, "#2f6263", "#5c8278" },
  { 1.0, 4, 150, "#12343b", "#1c3f41" },
}

local length = 2900

local function trunk(x, w, lean)
  return shapes.ribbon({ { x + lean, -60, w * 0.66 }, { x + lean * 0.5, 400, w * 0.8 },
                         { x, 820, w },
                         { x - w * 0.1, 1000, w * 1.35 }, { x - w * 0.2, 1120, w * 2.1 } })
end

--- A bough from the middle of the trunk at height y.
local function bough(x, y, w, lean, way)
  x = x + lean * (820 - y) / 860
  return shapes.ribbon({ { x, y, w * 0.3 }, { x + way * w * 0.9, y - w * 0.5, w * 0.2 },
                         { x + way * w * 2, y - w * 1.6, w * 0.03 } })
end

--- Trunks, boughs and the floor of one plane, all in one gradient of mist.
local function wood(n, plane)
  local _, count, w, top, foot = table.unpack(plane)
  local parts = {}
  for i = 0, count - 1 do
    local x = (i + 0.5 + 0.32 * math.sin(i * 2.7 + n)) * length / count - 100
    local lean = 50 * math.sin(i * 1.9 + n * 2)
    parts[#parts + 1] = trunk(x, w * (0.8 + 0.2 * math.sin(i * 5 + n)), lean)
    for k = 0, 2 do
      local y = 130 + (i * 97 + k * 233 + n * 61) % 470
      parts[#parts + 1] = bough(x, y, w, lean, (i + k) % 2 * 2 - 1)
    end
  end
  local crest = {}
  for i = 0, 12 do
    crest[i + 1] = { -100 + i * length / 11, 800 + n * 45 + 26 * math.sin(i * 1.3 + n * 2) }
  end
  parts[#parts + 1] = shapes.ridge(crest, 1160)
  local mist = rect { -200, -100, length + 400, 1300,
                      fill = shapes.down(100, 1040, { top, foot }) }
  return clip(mist, union(parts))
end

local woods = {}
for n, plane in ipairs(planes) do woods[n] = wood(n, plane) end

local glow = radial { centre = { 1180, 420 }, radius = 1150, { 0, "#fffbe6" },
                      { 0.25, "#fdeec2" },
                      { 0.6, "#dfe3c5" }, { 1, "#bfd2c4" } }
local air = rect { 0, 0, 1920, 1080, fill = glow }
local sun = circle { 1180, 420, 96, fill = "#fffdf2" }

return film { frames = 48, frame = function(f)
  local cels = { cel { air, sun } }
  for n, plane in ipairs(planes) do
    local travel = 560 * f.progress * plane[1]
    cels[n + 1] = cel { woods[n], viewport = { travel, 0, f.width, f.height } }
  end
  return rostrum(cels)
end }
