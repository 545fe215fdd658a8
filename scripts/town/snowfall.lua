-- The snow over the town. Flakes fall along winding ways, and each way has a flake at equal steps:
-- when one has fallen a step it is where the next one was, so the loop has no seam.
local snowfall = {}

local W, H = 1920, 1080
local chance = celspan.random "snowfall"

-- Radius, number of ways, the step, how far a way winds, and the colour.
local sizes = {
  { 1.6, 9, 96, 26, rgb("#e8f0f5", 0.7) }, { 2.6, 11, 210, 38, rgb("#f2f6f8", 0.85) },
  { 4.4, 9, 366, 60, rgb("#ffffff", 0.9) },
}

local ways = {}
for s, size in ipairs(sizes) do
  for i = 1, size[2] do
    local name = s .. "." .. i
    ways[#ways + 1] = { size = size, x = W * (i - 0.8 + 0.6 * chance("x" .. name)) / size[2],
      from = size[3] * chance("from" .. name), phase = 6.283 * chance("phase" .. name),
      long = 260 + 500 * chance("long" .. name) }
  end
end

--- All flakes at a share of the loop.
function snowfall.at(share)
  local shown = {}
  for _, way in ipairs(ways) do
    local radius, _, step, wide, fill = table.unpack(way.size)
    for y = way.from + step * (share - 1), H + radius, step do
      local x = way.x + wide * math.sin(6.283 * y / way.long + way.phase)
      shown[#shown + 1] = circle { x, y, radius, fill = fill }
    end
  end
  return union(shown)
end

return snowfall
