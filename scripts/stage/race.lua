local function shape(texture, d) return path { d = d, fill = texture } end
local function disc(texture, x, y, radius)
  return circle { x, y, radius, fill = texture }
end
local street = union {}
local house = shape("#4d6a86",
  "M12 0 h12 v18 h-12 Z M32 0 h12 v18 h-12 Z M52 0 h12 v18 h-12 Z M72 0"
    .. " h12 v18 h-12 Z")
for i = 0, 15 do
  local h = 70 + 60 * random "house"(i % 4)
  local wall = ({ "#f2b36b", "#e57f6a", "#7fb7a8", "#f0dcb0" })[i % 4 + 1]
  street = street
    | (rect { 0, 190 - h, 92, h, fill = wall }
       | shape("#8a4b52", "M-4 0 L46 -30 L96 0 Z"):translate(0, 190 - h)
       | house:translate(0, 206 - h)
       | disc("#5c8f4e", 96, 150, 24)
       | rect { 92, 160, 8, 32, fill = "#6b4a35" })
      :translate(100 * i, 0)
end
local road = rect { 0, 190, 480, 80, fill = "#5a5566" }
  | rect { 0, 190, 480, 7, fill = "#c9c0b0" }
local line = stroke { d = "M0 246 H1600", width = 7, dash = { 50, 50 }, fill = "#f5ead0" }
local wheel = disc("#26222e", 0, 0, 27) | disc("#8c8794", 0, 0, 17)
for i = 0, 4 do
  wheel = wheel | shape("#fff6df", "M-3 0 L-5 -17 H5 L3 0 Z"):rotate(72 * i)
end
local car = union {
  shape("#3b4a7a", "M-36 -48 Q-34 -70 -18 -68 Q-8 -62 -8 -48 Z"),
  disc("#f0c39a", -20, -82, 15),
  shape("#ffc84a", "M-30 -80 C-60 -84 -66 -70 -88 -78 C-74 -64 -58 -66 -30 -70 Z"),
  shape("#7a4b33", "M-36 -82 A16 16 0 0 1 -4 -86 Z"),
  rect { -12, -87, 9, 8, radius = 3, fill = "#bfe3ea" },
  shape("#d7263d",
    "M-104 -14 C-108 -40 -84 -50 -52 -50 L-16 -52 C0 -60 10 -48 22 -46 C60"
      .. " -44 96 -36 108 -16 C108 -8 100 -6 90 -6 H-96 C-102 -6 -104 -8 -104 -14"
      .. " Z"),
  shape("#fff6df", "M-107 -30 C40 -36 80 -34 104 -20 L108 -16 C70 -26 30 -26 -105 -20 Z"),
  disc("#fff6df", -30, -27, 15),
  stroke { d = "M14 -47 L4 -66", width = 4, fill = "#bfe3ea" } }

return { street = street, road = road, line = line, wheel = wheel, car = car }
