local dusk = linear { from = { 0, 0 }, to = { 0, 300 }, { 0, "#141a4a" },
  { 0.55, "#5a3f86" }, { 0.85, "#d0606a" }, { 1, "#f2a06a" } }
local street = rect { 0, 0, 640, 360, fill = dusk }
local lights = union {}

for i, height in ipairs { 92, 150, 74, 118, 176, 84, 134, 100 } do
  local x, top = 84 * i - 96, 290 - height
  street = street
    | rect { x, top, 84, height + 10, fill = i % 2 == 0 and "#231f55" or "#2d2563" }
    | triangle { { x - 6, top }, { x + 90, top }, { x + 42, top - 36 }, fill = "#1a1745" }
  for k = 0, height // 30 - 2 do
    if (i * 5 + k * 3) % 4 > 0 then
      lights = lights
        | rect {
          x + 16 + 34 * ((i + k) % 2),
          top + 14 + 30 * k, 16, 18, fill = "#ffb552" }
    end
  end
end

--- A glow that fades to nothing, so that it has no visible edge.
local function glow(x, y, radius, strength)
  local fall = { centre = { x, y }, radius = radius }
  for i = 0, 12 do
    fall[i + 1] = { i / 12, rgb(1, 0.5, 0.16, strength * (1 - i / 12) ^ 4) }
  end
  return circle { x, y, radius, fill = radial(fall) }
end

local posts = union {}
for i, x in ipairs { 84, 300, 566 } do
  local y, size = 226 - 26 * i, 0.7 + 0.3 * i
  posts = posts
    | rect { x - 3 * size, y, 6 * size, 284 - y + 22 * i, radius = 2, fill = "#0c0a26" }
    | path {
      d = "M-13 -22 L13 -22 L9 8 L-9 8 Z M-17 -22 L0 -36 L17 -22 Z",
      fill = "#0c0a26" }
      :scale(size)
      :translate(x, y)
  lights = lights
    | glow(x, y - 6, 130 * size, 0.5)
    | path { d = "M-10 -19 L10 -19 L7 5 L-7 5 Z", fill = "#fff3cf" }:scale(size)
      :translate(x, y)
end

local ground = rect { 0, 286, 640, 74 }

return { street = street, lights = lights, posts = posts, ground = ground }
