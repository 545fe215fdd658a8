--- What belongs on an old chart: a frame with degrees, a rose of the winds, and a ship.
local ink = "#5b4a2c"
local edge = {}
for i = 0, 23 do
  if i % 2 == 0 then
    edge[#edge + 1] = rect { 20 * i, 0, 20, 5, fill = ink } | rect { 20 * i + 20, 265, 20, 5,
      fill = ink }
  end
end
for i = 0, 13 do
  if i % 2 == 0 then
    edge[#edge + 1] = rect { 0, 20 * i + 5, 5, 20, fill = ink } | rect { 475, 20 * i + 5, 5, 20,
      fill = ink }
  end
end
local frame = union { union(edge), rect { 7, 7, 466, 256 }:stroke { width = 1, fill = ink } }

local function point(length, width, degrees)
  return (polygon { { 0, -length }, { width, -width }, { 0, 0 }, fill = ink }
    | polygon { { 0, -length }, { -width, -width }, { 0, 0 }, fill = "#fbf3dc" }
    | polygon { { 0, -length }, { width, -width }, { 0, 0 }, { -width, -width } }:stroke {
      width = 0.7, fill = ink }):rotate(degrees)
end
local winds = { circle { 0, 0, 17 }:stroke { width = 0.8, fill = ink },
  circle { 0, 0, 20 }:stroke { width = 0.8, fill = ink } }
for i = 0, 3 do winds[#winds + 1] = point(19, 4, 90 * i + 45) end
for i = 0, 3 do winds[#winds + 1] = point(31, 6, 90 * i) end
local rose = union(winds) | stroke { d = "M-4 -35 V-45 L4 -35 V-45", width = 1.6,
  fill = "#a8322c" }

local sail = path { d = "M-1 -34 C12 -30 14 -16 11 -9 L-1 -10 Z", fill = "#fbf3dc" }
  | path { d = "M-4 -30 C-12 -24 -13 -15 -11 -9 L-4 -10 Z", fill = "#fbf3dc" }
local ship = union {
  stroke { d = "M-2.5 -38 V-4", width = 2, fill = ink },
  sail:outline { width = 1.4, fill = ink },
  path { d = "M-2 -38 L9 -42 L-2 -45 Z", fill = "#a8322c" },
  path { d = "M-16 -6 Q0 -2 17 -8 L12 3 Q0 7 -11 3 Z", fill = "#7a4a2a" } }

--- A port: an anchor's ring on the coast.
local function port(at)
  return circle { at[1], at[2], 4.5, fill = "#a8322c" } | circle { at[1], at[2], 2,
    fill = "#fbf3dc" }
end

--- The lines of the sea around all coasts.
local function waves(coasts)
  local lines = {}
  for i, width in ipairs { 42, 40.4, 26, 24.6, 13, 11.8 } do
    for _, coast in ipairs(coasts) do
      lines[#lines + 1] = coast:stroke { width = width, fill = i % 2 == 1 and "#a98f5c"
        or "#e8d9b0" }
    end
  end
  return union(lines)
end

return { frame = frame, rose = rose:translate(70, 208), ship = ship:scale(0.85), port = port,
  waves = waves }
