-- The "filmed" walk of docs/cookbook.md: eight pictures that are used in place of those of a
-- camera.
--
--   celspan render scripts/pictures/walk.lua -o scripts/pictures/walk.####.jpg

local function limb(points, width, colour)
  return stroke { points = points, width = width, cap = "round", join = "round",
    fill = colour }
end

--- Hip, knee and foot of a leg at a moment of the walk, in turns.
local function leg(x, y, u)
  local swing, bend = 0.55 * math.sin(2 * math.pi * u), 0.5 + 0.5 * math.cos(2 * math.pi * u)
  local knee = { x + 34 * math.sin(swing), y + 34 * math.cos(swing) }
  local shin = swing - 0.9 * bend
  return { { x, y }, knee, { knee[1] + 34 * math.sin(shin), knee[2] + 34 * math.cos(shin) } }
end

local wall = linear { from = { 0, 0 }, to = { 320, 180 }, { 0, "#8d8a7c" },
  { 1, "#5f6560" } }
local room = cel { rect { 0, 0, 320, 180, fill = wall },
  rect { 0, 150, 320, 30, fill = "#4a4440" } }

return film { size = { 320, 180 }, frames = 8, fps = 12, frame = function(f)
  local u = f.index / 8
  local x, y, swing = 160, 92 + 2 * math.cos(4 * math.pi * u), math.sin(2 * math.pi * u)
  local arm = { { x, y - 46 }, { x - 22 * math.sin(0.5 * swing) - 6, y - 22 },
    { x - 34 * math.sin(0.7 * swing) + 6, y - 4 } }
  local shade = ellipse { x, 160, 44, 6, fill = "#2c2826" }
  local head = circle { x + 3, y - 72, 15, fill = "#b98f6f" }
  return { room, cel { shade, defocus = 4, opacity = 0.7 },
    cel { limb(leg(x, y, u + 0.5), 15, "#2f3540"), limb(leg(x, y, u), 16, "#3c4552"),
      limb({ { x, y }, { x, y - 44 } }, 30, "#7a3b35"), head, limb(arm, 10, "#8c4a41"),
      defocus = 1.2 } }
end }
