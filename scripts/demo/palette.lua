-- Every colour of the film, and how the evening changes them. Times are seconds.

local palette = {}

--- A colour that goes from gold to dusk.
local function turning(gold, dusk)
  return keys { { 0.5, mix(gold, gold, 0) },
                { 8.5, mix(dusk, dusk, 0), "inOutSine" } }
end

palette.sky = {
  { 0.00, turning("#4d7896", "#0e1533") },
  { 0.30, turning("#8fa9a8", "#242656") },
  { 0.48, turning("#dcb98d", "#4c3569") },
  { 0.60, turning("#f7b267", "#96506f") },
  { 0.68, turning("#f79d5c", "#e0825f") },
}
palette.goose = "#33263d"
palette.cloud = turning("#fbdcae", "#6d4672")
palette.sun = turning("#fff3c9", "#ff9a5e")

--- Front lights by distance: they dim and cool, and get hazier with the distance.
palette.lights = {
  far = keys { { 0.5, { 1, 1, 1 } }, { 8.5, { 0.26, 0.17, 0.42 }, "inOutSine" } },
  middle = keys { { 0.5, { 1, 1, 1 } }, { 8.5, { 0.17, 0.14, 0.36 }, "inOutSine" } },
  near = keys { { 0.5, { 1, 1, 1 } }, { 8.5, { 0.14, 0.13, 0.30 }, "inOutSine" } },
  figure = keys { { 0.5, { 1, 0.98, 0.94 } }, { 8.5, { 0.52, 0.40, 0.46 }, "inOutSine" } },
}

palette.mountains = { "#b98a86", "#ecb98c" }
palette.hills = { "#8d6f78", "#c99880" }
palette.lake = { "#f6be82", "#9c7f86" }
palette.glint = "#ffe6b380"
palette.furrow = "#8b8f6150"
palette.path = "#b9a273a0"
palette.village = { "#6d7358", "#54604f" }
palette.near = { "#55683f", "#3b4d3c" }
palette.ground = { "#4b5a33", "#27362b" }
palette.leaves = { "#7d8248", "#35492f" }
palette.silhouette = "#15201f"

palette.wall_shade = "#a9796a"
palette.walls = { "#efd7b4", "#e3b98f", "#d99f7d" }
palette.roofs = { "#b1543f", "#8e4a48", "#a3633f" }
palette.pane = "#3d4a58"
palette.gels = { { 1, 0.62, 0.22 }, { 1, 0.74, 0.36 }, { 1, 0.46, 0.20 } }

palette.skin = "#f3c39b"
palette.face = { "#ffd7ac", "#d9906f" }
palette.nose = "#d9906f"
palette.cheek = "#e8654f66"
palette.ink = "#2b1b2c"
palette.hair = "#4b2a33"
palette.coat = { "#2f7f86", "#17404f" }
palette.trim = { "#f6e3b8", "#b98f63" }
palette.button = "#f0d9a8"
palette.wool = { "#fbe9c6", "#c99f74" }
palette.scarf = { "#e9573f", "#b5343f" }
palette.hat = { "#e8a33d", "#b5672d" }
palette.boot = "#3b2430"
palette.tights = "#7a4450"
palette.brass = "#7a4b2a"

--- The light of a lamp at a point: warm, and falling off with the distance.
function palette.lamplight(x, y, radius)
  local light = { centre = { x, y }, radius = radius }
  for i = 0, 16 do
    local u = i / 16
    local strength = (1 - u) ^ 2 / (1 + 24 * u * u)
    light[#light + 1] = { u, rgb(strength, 0.6 * strength, 0.26 * strength) }
  end
  return radial(light)
end

return palette
