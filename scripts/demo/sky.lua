-- The sky: a gradient that turns from gold to dusk, a setting sun, clouds, and stars on cue.
local palette = require "demo.palette"

local sky = {}

local width, height = 2200, 1080

function sky.air(time)
  local gradient = { from = { 0, 0 }, to = { 0, height } }
  for i, stop in ipairs(palette.sky) do gradient[i] = { stop[1], stop[2]:at(time) } end
  return cel { rect { 0, 0, width, height, fill = linear(gradient) } }
end

local sun_height = keys { { 0, 490 }, { 7.5, 790, "inOutSine" } }
local sun_strength = keys { { 2, 1 }, { 9, 0.2, "inOutSine" } }

--- The disc is painted; the rings around it are paint too thin to hide anything, strongly lit.
function sky.sun(time)
  local x, y = 690, sun_height:at(time)
  local strength = 6 * sun_strength:at(time)
  local rings = {}
  for i, radius in ipairs { 430, 318, 216, 132 } do
    rings[i] = circle { x, y, radius,
                        fill = rgb(1, 0.62, 0.28, 0.007 + 0.003 * i) }
  end
  local disc = circle { x, y, 74, fill = palette.sun:at(time) }
  return cel { union(rings), front = { strength, strength, strength } },
    cel { disc, front = { 1.15, 1.1, 1 } }
end

--- Banks of cloud: {x, y, size}, and the rounded bars {x, y, length} of a bank.
local banks = { { 130, 236, 1 }, { 1090, 176, 1.2 }, { 1660, 330, 0.9 }, { 840, 392, 0.62 },
                { -40, 402, 0.7 } }
local pills = { { 0, 0, 420 }, { 70, -26, 270 }, { 132, -52, 128 }, { 250, 24, 300 },
                { -90, 26, 190 } }

function sky.clouds(time)
  local parts = {}
  for i, bank in ipairs(banks) do
    local x, y, size = bank[1] + time * (3 + i % 3 * 2), bank[2], bank[3]
    for _, pill in ipairs(pills) do
      parts[#parts + 1] = rect {
        x + pill[1] * size, y + pill[2] * size, pill[3] * size, 26 * size, radius = 13 * size }
    end
  end
  local paint = mix(clear, palette.cloud:at(time), 0.55)
  return cel { clip(rect { -200, 0, width + 400, 640, fill = paint },
                    union(parts)) }
end

--- Stars lie on a spiral of golden angles, so they look scattered and never crowd.
local function strew(count)
  local stars = {}
  for i = 1, count do
    local far, turn = math.sqrt(i / count), i * 2.39996
    local x, y = 1000 + 1120 * far * math.cos(turn), 130 + 380 * far * math.sin(turn)
    if y > 8 and x > 0 and x < width then stars[#stars + 1] = { x, y, 1.4 + (i * 7 % 5) * 0.52 } end
  end
  return stars
end

local stars = strew(170)
local pop = ease "outBack"

--- They come out from `cue` on, in a ring that grows around a point, and twinkle.
function sky.stars(time, cue, from)
  local parts = {}
  for _, star in ipairs(stars) do
    local dx, dy = star[1] - from[1], star[2] - from[2]
    local age = (time - cue - math.sqrt(dx * dx + dy * dy) / 1000) / 0.4
    if age > 0 then
      local size = star[3] * pop(math.min(1, age)) * (1 + 0.18 * math.sin(time * 5 + star[1]))
      parts[#parts + 1] = circle { star[1], star[2], size,
                                   fill = "#fff4dc" }
    end
  end
  return cel { union(parts) }
end

return sky
