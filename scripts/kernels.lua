-- The same edge through every kernel: straight and slanted, a curve, a hairline and a fan.
-- The frame is small: enlarged, its pixels show what a kernel does.

local KERNELS = {
  { name = "none", antialias = "none" },
  { name = "area", antialias = "area" },
  { name = "box, radius 1", antialias = { kernel = "box", radius = 1 } },
  { name = "gaussian", antialias = { kernel = "gaussian" } },
  { name = "mitchell", antialias = { kernel = "mitchell" } },
  { name = "lanczos", antialias = { kernel = "lanczos" } },
  { name = "a tent of one's own", -- any function of the distance from a pixel's centre
    antialias = { kernel = function(x) return 1 - math.abs(x) end, radius = 1 } },
}

local ink, teal = "#1f2a44", "#2a7f83"

local function fan(x, y, length)
  local rays = {}
  for i = 0, 11 do
    local ray = polygon { { 0, 0 }, { length, -0.6 }, { length, 0.6 }, fill = ink }
    rays[#rays + 1] = ray:rotate(i * 7.5):translate(x, y)
  end
  return union(rays)
end

local art = cel {
  rect { 6, -10, 14, 100, fill = teal }:rotate(8, 12, 20),
  circle { 38, 15, 9.3, fill = ink },
  circle { 40, 13, 4.1, fill = "#f2b134" },
  triangle { { 30, 39 }, { 47, 37 }, { 40, 27 }, fill = "#e4572e" },
  fan(52, 4, 34),
}

-- One still per kernel: --frames selects one.
return film {
  title = "Kernels", size = { 96, 40 }, fps = 1, frames = #KERNELS,
  frame = function(f)
    return { art, back = "#f6ebd3", antialias = KERNELS[f.index + 1].antialias }
  end,
}
