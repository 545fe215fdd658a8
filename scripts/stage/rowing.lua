local fog = require("stage.moods").fog
local sky = linear { from = { 0, 0 }, to = { 0, 270 }, { 0, fog.sky[1] }, { 0.4, fog.sky[2] },
  { 0.56, fog.sky[3] }, { 0.561, fog.far }, { 1, fog.ground } }
local boat = union {
  path {
    d = "M-64 0 H66 C56 26 38 32 18 32 H-26 C-46 32 -56 20 -64 0 Z",
    fill = fog.ink },
  path {
    d = "M-24 4 C-26 -30 14 -34 16 4M-20 -36 L-24 -64 L-8 -52 H4 L18 -64 L15 -36"
      .. " C16 -14 -22 -14 -20 -36 Z",
    fill = fog.ink } }
local sun = clip(circle { 352, 128, 40, fill = fog.accent }, rect { 0, 0, 480, 151 })

--- An evening at the sea, on which a cat rows.
local function evening(time)
  local oar = stroke { d = "M-10 -14 L44 44", width = 5, cap = "round", fill = fog.ink }
    :rotate(24 * math.sin(6 * time), 0, -6)
  local rowing = (boat | oar):rotate(3 * math.sin(3 * time))
    :translate(170 + 34 * time, 140)
  local mirrored = rowing:scale(1, -0.5, 0, 168):fade(0.3)
  return cel { rect { 0, 0, 480, 270, fill = sky }, sun, rowing, mirrored }
end

return evening
