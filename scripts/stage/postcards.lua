--- Three views of 240 x 160 that move, each a function of the progress of its film: what is seen by
-- day, and the lamps that shine at night.
local moods = require "stage.moods"
local noon, snow, harvest = moods.noon, moods.snow, moods.harvest

local function sky(mood)
  return rect { 0, 0, 240, 160, fill = linear { from = { 0, 0 }, to = { 0, 130 },
    table.unpack(mood.sky) } }
end
local function line(d, width, tint)
  return stroke { d = d, width = width, cap = "round", join = "round", fill = tint }
end

--- A boat before an island with a lighthouse.
local sail = path { d = "M3 -62C26 -40 32 -22 31 -6H3Z", fill = harvest.light }
  | path { d = "M-2 -54C-8 -32 -18 -16 -26 -6H-2Z", fill = "#f0c98a" }
  | line("M0 0V-66", 2, harvest.ink)
  | path { d = "M-32 0H36C32 12 24 16 16 16H-18C-26 14 -30 8 -32 0Z", fill = harvest.accent }
local tower = path { d = "M-6 0L-4 -40H4L6 0Z", fill = harvest.light }
  | rect { -5.4, -26, 10.8, 9, fill = harvest.ground } | path { d = "M-5 -47L0 -54L5 -47Z",
    fill = harvest.ground }
local function sea(u)
  local sway = math.sin(4 * math.pi * u)
  local waves = {}
  for i = 0, 5 do
    local x, y = (57 * i + 280 * u * (i % 2 == 0 and 1 or -1)) % 280 - 40, 118 + 8 * i
    waves[i + 1] = line(("M%g %gq7 -4 14 0t14 0"):format(x, y), 2, "#ffd98f")
  end
  return union { sky(harvest), circle { 78, 70, 25, fill = harvest.light },
    path { d = "M140 108C158 92 176 90 190 92C208 90 226 98 240 108Z", fill = harvest.near },
    tower:translate(192, 94), rect { 0, 106, 240, 54, fill = "#c9742f" }, union(waves),
    sail:rotate(5 * sway):translate(96, 124 + 2 * sway) },
    rect { 188, 47, 8, 7, fill = "#fff0b0" }
end

--- A cable car above firs in the snow.
local fir = path { d = "M0 -54L9 -34H5L14 -16H8L18 4H-18L-8 -16H-14L-5 -34H-9Z", fill = "#35596a" }
  | path { d = "M0 -54L9 -34L0 -38L-9 -34ZM5 -34L14 -16L4 -22L-6 -18Z", fill = snow.ground }
local cabin = rect { -17, 12, 34, 24, radius = 4, fill = snow.accent }
  | line("M0 0V12", 2.4, snow.ink) | rect { -17, 30, 34, 3, fill = snow.ground }
local panes = rect { -13, 16, 11, 9, radius = 1 } | rect { 2, 16, 11, 9, radius = 1 }
local function peaks(u)
  local x, flakes = 140 + 60 * math.sin(2 * math.pi * u), {}
  local y = 62 - 0.2 * x
  for i = 1, 26 do
    flakes[i] = circle { 250 * random "x"(i) + 6 * math.sin(2 * math.pi * (u + random "s"(i))) - 5,
      170 * ((random "y"(i) + u * (1 + i % 2)) % 1) - 5, 1.5, fill = "#fff" }
  end
  return union { sky(snow),
    path { d = "M-10 160L58 46L92 92L150 24L250 150V160Z", fill = snow.near },
    path { d = "M150 24L178 60L166 56L152 68L142 52L128 58ZM58 46L74 68L62 64L52 72L46 66Z",
      fill = snow.ground },
    line("M-10 64L250 12", 1.4, snow.ink), cabin:translate(x, y),
    panes:translate(x, y):paint "#a9cbd8",
    path { d = "M0 160V128C60 106 150 112 240 132V160Z", fill = snow.ground },
    fir:translate(30, 134), fir:scale(0.7):translate(62, 126), fir:scale(1.15):translate(212, 142),
    union(flakes) }, panes:translate(x, y):paint "#ffd27a"
end

--- Houses at a canal, and a balloon.
local houses, lit = {}, {}
for i, at in ipairs { { 40, 74, "#f2c14e" }, { 34, 90, "#d9573b" }, { 44, 66, "#fff3dc" },
  { 36, 84, "#2f8f83" }, { 40, 72, "#f2a65a" }, { 48, 92, "#c9d8b6" } } do
  local x = 40 * i - 42
  local top = 128 - at[2]
  houses[i] = path { fill = at[3],
    d = ("M%g 128V%gL%g %gL%g %gV128Z"):format(x, top, x + 20, top - 16, x + 40, top) }
    | rect { x + 15, 110, 10, 18, fill = noon.ink }
  for k = 0, at[2] // 22 - 2 do
    local pane = rect { x + 8, top + 8 + 20 * k, 8, 11 } | rect { x + 24, top + 8 + 20 * k, 8, 11 }
    houses[i] = houses[i] | pane:paint(noon.ink)
    if (i + k) % 2 == 0 then lit[#lit + 1] = pane:paint "#ffd27a" end
  end
end
local balloon = path { d = "M0 -26C22 -26 22 2 4 14H-4C-22 2 -22 -26 0 -26Z", fill = noon.accent }
  | path { d = "M0 -26C9 -24 8 4 2 14H-2C-8 4 -9 -24 0 -26Z", fill = noon.light }
  | rect { -4, 19, 8, 6, fill = noon.ink } | line("M-4 14L-3 19M4 14L3 19", 0.8, noon.ink)
local row = union(houses)
local function canal(u)
  return union { sky(noon), balloon:translate(30 + 60 * u, 34 - 6 * math.sin(2 * math.pi * u)), row,
    rect { 0, 128, 240, 32, fill = "#2b7fa6" }, clip(row:scale(1, -0.5, 0, 131):fade(0.35),
      rect { 0, 131, 240, 30 }), rect { 0, 126, 240, 5, fill = "#8a6a4a" } }, union(lit)
end

return { sea, peaks, canal }
