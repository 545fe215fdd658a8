-- The place: sky, hills, two streets, and the roof on which the cat sits.

local W, H = 1280, 720
local town = { ridge = 508 } -- the roof's y

--- A gradient from top to bottom. Distant things have the colour of the air, most at their foot.
local function fade(top, foot, ...)
  return linear { from = { 0, top }, to = { 0, foot }, ... }
end

-- ---------------------------------------------------------------- the sky

local dusk = rect { -W, -H, 3 * W, 3 * H, fill = fade(0, 560, { 0, "#121a4a" },
  { 0.4, "#483886" }, { 0.7, "#b0548c" }, { 0.88, "#ee866c" }, { 1, "#ffc17d" }) }
local halo = circle { 455, 262, 300, fill = radial {
  centre = { 455, 262 }, radius = 300, { 0.5, "#ff9f8c90" }, { 0.6, "#ff9f8c50" },
  { 0.75, "#ff9f8c18" }, { 1, "#ff9f8c00" } } }
local moon = circle { 455, 262, 150,
  fill = fade(120, 410, { 0, "#fff4d6" }, { 1, "#ffc898" }) }

function town.sky(time, count)
  local stars = {}
  for i = 1, count do -- steps by the golden section spread them evenly
    stars[i] = circle { -100 + 1480 * (i * 0.618 % 1), 440 * (i * 0.755 % 1) ^ 1.6,
      1 + i % 3 * 0.6, fill = "#fff3d6" }
      :fade(0.55 + 0.45 * math.sin(5 * time + 2.4 * i))
  end
  return union { dusk, union(stars), halo, moon }
end

-- ---------------------------------------------------------------- hills and houses

local edge = { { W + 300, H + 200 }, { -300, H + 200 },
  texture = fade(460, 600, { 0, "#7d4486" }, { 1, "#d07a86" }) }
for x = -300, W + 300, 20 do
  edge[#edge + 1] = { x, 500 - 30 * math.sin(x / 170) - 10 * math.sin(x / 63) }
end
town.hills = polygon(edge)

--- Houses side by side, from x on, and their windows.
local function street(x, ground, size, texture)
  local random = celspan.random(size)
  local houses, windows = {}, {}
  while x < W + 260 do
    local w, h = size * (0.8 + 0.7 * random("w" .. x)), size * (0.9 + 1.1 * random("h" .. x))
    local eaves, roof = ground - h, size * (0.4 + 0.4 * random("roof" .. x))
    houses[#houses + 1] = polygon { fill = texture, { x, H + 200 }, { x, eaves },
      { x - 6, eaves }, { x + w / 2, eaves - roof }, { x + w + 6, eaves }, { x + w, eaves },
      { x + w, H + 200 } }
    houses[#houses + 1] = rect { x + w * 0.68, eaves - roof * 0.9, w * 0.12, roof * 0.7,
      fill = texture }
    for n = 0, 9 do
      if random("window" .. x .. n) < 0.75 then
        windows[#windows + 1] = rect { x + w * (0.2 + 0.38 * (n % 2)),
          eaves + size * (0.1 + 0.36 * (n // 2)), w * 0.2, size * 0.22, radius = size * 0.03 }
      end
    end
    x = math.floor(x + w)
  end
  return { houses = union(houses), windows = windows }
end

town.far = street(-260, 580, 60, fade(440, 640, { 0, "#5d3a7c" }, { 1, "#b0628c" }))
town.near = street(770, 655, 118, fade(430, 760, { 0, "#2d2058" }, { 1, "#5a3478" }))

-- ---------------------------------------------------------------- the roof

local y = town.ridge
local slope = polygon { { -300, y }, { 850, y }, { 1010, H + 200 }, { -300, H + 200 },
  fill = fade(y, H + 60, { 0, "#1d1640" }, { 1, "#0d0a20" }) }
local tiles = {}
for row = 0, 6 do -- windows that are nearer are larger
  local size = 34 + 9 * row
  for n = -22, 26 do
    tiles[#tiles + 1] = ("M%g %g q%g %g %g 0"):format(400 + (n + row % 2 / 2) * size,
      y + row * (18 + 4 * row), size / 2, size * 0.62, size)
  end
end
town.roof = union {
  rect { -6, y - 92, 52, 120, fill = "#171130" },
  rect { -14, y - 104, 68, 18, radius = 3, fill = "#171130" },
  slope,
  clip(stroke { d = table.concat(tiles), width = 2, fill = "#3b2c66" }, slope),
  rect { -300, y - 3, 1156, 9, radius = 4, fill = "#3b2c66" },
}

town.panes = {} -- the panes of two skylights
for _, left in ipairs { 330, 560 } do
  for n = 0, 3 do
    town.panes[#town.panes + 1] = rect { left + n % 2 * 44, y + 60 + n // 2 * 38, 39, 33,
      radius = 3, fill = "#2a2152" }
  end
end
town.roof = town.roof | union(town.panes)

return town
