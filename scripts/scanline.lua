-- The scan-line primitive: a procedure that describes, row by row, where there is paint. The moon's
-- path on the water consists of such rows; everything else in the picture is ordinary outlines.
local shapes = require "demo.shapes"

local horizon, cx = 560, 1160

--- A scattered number in 0..1, for the positions of the glints of a wave.
local function scatter(k) return math.sin(k * 12.9898) * 43758.5453 % 1 end

--- Wave after wave, taller when nearer; each carries lens-shaped glints that drift and flash.
local function glitter(time)
  return function(y)
    local near = (y - horizon) / (1080 - horizon)
    local phase = math.log((near + 0.05) / 0.05) * 19
    local wave, within = phase // 1, 2 * (phase % 1) - 1
    local lens = 1 - within * within
    local reach, spans, last = 60 + 300 * near, {}, 0
    local paint = rgb(1, 0.84, 0.6, 0.95 - 0.3 * near)
    for i = -2, 2 do
      local seed = wave * 7 + i
      local flash = 0.6 + 0.4 * math.sin(time * 6 + scatter(seed) * 40)
      local half = reach * (0.34 - 0.08 * math.abs(i)) * lens * flash * scatter(seed + 3)
      local place = i * 0.42 + 0.34 * (scatter(seed + 5) - 0.5)
      local x = cx + reach * place + 14 * near * math.sin(time * 3 + wave)
      local x0, x1 = math.max(x - half, last), x + half
      local is_there = scatter(seed + 3) * flash > 0.22 and x1 > x0
      if is_there then spans[#spans + 1], last = { x0, x1, paint }, x1 end
    end
    return spans
  end
end

local dusk = shapes.down(0, horizon, { "#0f1638", "#2c2a5c", "#6a4478", "#b9667a", "#f0a17c" })
local deep = shapes.down(horizon, 1080, { "#b87a7c", "#6f4a74", "#3a3468", "#1f2350", "#0d1230" })
local sky = rect { 0, 0, 1920, horizon, fill = dusk }
local water = rect { 0, horizon, 1920, 1080 - horizon, fill = deep }
local moon = circle { cx, 400, 128, fill = "#ffe9c2" }
local halo = shapes.glow(cx, 400, 460, 1, 0.7, 0.5, 0.34)
local island = shapes.ridge({ { -60, 562 }, { 120, 520 }, { 280, 440 }, { 380, 425 }, { 470, 470 },
                              { 600, 500 },
                              { 720, 545 }, { 800, 562 } }, 566, "#1c1a3c")
local boat = union {
  path { d = "M-90 0C-60 26 60 26 96 -4Q0 10 -90 0Z", fill = "#120f28" },
  path { d = "M2 -6L2 -176Q70 -100 84 -18Q40 -8 2 -6Z", fill = "#f3d6b0" },
  path { d = "M-6 -8L-6 -150Q-56 -90 -64 -16Q-30 -8 -6 -8Z", fill = "#d9a98f" },
}

return film { frames = 48, frame = function(f)
  local time = f.time
  local light = scanline { bounds = { cx - 520, horizon, 1040, 1080 - horizon },
                           spans = glitter(time) }
  local sailing = boat:rotate(3 * math.sin(time * 2.4)):scale(1.25)
    :translate(560 + 40 * time, 770 + 5 * math.sin(time * 3.1))
  return cel { sky, moon, halo, island, water, light, sailing }
end }
