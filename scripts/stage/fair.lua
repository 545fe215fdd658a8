local neon = require("stage.moods").neon
local sky = linear { from = { 0, 0 }, to = { 0, 250 }, table.unpack(neon.sky) }
local ground = path {
  fill = neon.ink,
  d = "M-20 250 Q60 226 120 240 T240 236 T360 240 T500 228 V290 H-20 Z M176"
    .. " 246 L236 126 H244 L304 246 H292 L240 142 L188 246 Z" }
for i = 0, 11 do
  -- tents and their flags
  local x, h = 44 * i - 6, 16 + 14 * random "tent"(i)
  ground = ground
    | path { fill = neon.ink, d = ("M%g 250 V%g L%g %g V%g L%g %g L%g %g V250 Z")
      :format(x - 18, 250 - h, x - 1, 238 - 2 * h, 226 - 2 * h, x + 9, 230 - 2 * h, x + 1,
        234 - 2 * h, x + 18, 250 - h) }
end
local function ring(r) return circle { 0, 0, r, fill = "#fff4dc" } end
local wheel = (ring(104) - ring(101)) | (ring(94) - ring(92)) | (ring(32) - ring(30))
for i = 0, 11 do
  wheel = wheel
    | stroke { d = "M-5 0 L0 -104 L5 0", width = 1.4, fill = "#fff4dc" }:rotate(30 * i)
end
local cabin = path {
  d = "M0 0 L10 9 H-10 Z M-10 11 H10 V18 Q10 25 0 25 Q-10 25 -10 18 Z" }

return { sky = sky, ground = ground, wheel = wheel, cabin = cabin }
