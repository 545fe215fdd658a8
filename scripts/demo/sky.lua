-- The sky: a gradient that turns from gold to dusk, a setting sun, clouds, and stars on cue.
local celspan = require "celspan"
local ease = require "celspan.ease"
local keys = require "celspan.keys"
local palette = require "demo.palette"
local shapes = require "demo.shapes"

local sky = {}

local width, height = 2200, 1080

function sky.air(time)
  local gradient = { from = { 0, 0 }, to = { 0, height } }
  for i, stop in ipairs(palette.sky) do gradient[i] = { stop[1], stop[2]:at(time) } end
  return celspan.cel { celspan.rect { 0, 0, width, height, texture = celspan.linear(gradient) } }
end

local sun_height = keys { { 0, 500 }, { 7, 760, "inOutSine" } }

--- The disc is painted; the rings round it are paint too thin to hide anything, under strong lights.
function sky.sun(time)
  local x, y = 690, sun_height:at(time)
  local disc = celspan.circle { centre = { x, y }, radius = 74, texture = palette.sun:at(time) }
  local rings = shapes.halo(x, y, 430, 5, celspan.rgb(1, 0.66, 0.3, 0.012))
  return celspan.cel { rings, front = { 6, 6, 6 } },
    celspan.cel { disc, front = { 1.15, 1.1, 1 } }
end

--- {x, y, length, thickness}: flat below, swelling above.
local banks = {
  { 180, 250, 520, 40 }, { 420, 282, 380, 26 }, { 1150, 190, 600, 44 }, { 1420, 226, 420, 30 },
  { 860, 372, 460, 26 }, { 60, 420, 300, 20 }, { 1640, 392, 440, 28 },
}

local function cloud(x, y, length, thickness, texture)
  local l, t = length, thickness
  return celspan.path { texture = texture, d = ("M%g %g c%g %g %g %g %g %g s%g %g %g %g s%g %g %g %g Z"):format(
    x, y, l * 0.10, -t * 0.9, l * 0.2, -t * 0.9, l * 0.3, -t * 0.6,
    l * 0.18, -t, l * 0.34, -t * 0.5, l * 0.24, t * 0.5, l * 0.36, t * 0.6) }
end

function sky.clouds(time)
  local paint = celspan.mix(celspan.clear, palette.cloud:at(time), 0.62)
  local parts = {}
  for i, bank in ipairs(banks) do
    parts[i] = cloud(bank[1] + time * (3 + i % 3 * 2), bank[2], bank[3], bank[4], paint)
  end
  return celspan.cel { celspan.union(parts) }
end

--- Stars lie on a spiral of golden angles, so that they look strewn and never crowd.
local function strew(count)
  local stars = {}
  for i = 1, count do
    local far, turn = math.sqrt(i / count), i * 2.39996
    local x, y = 1000 + 1120 * far * math.cos(turn), 130 + 380 * far * math.sin(turn)
    if y > 8 and x > 0 and x < width then
      stars[#stars + 1] = { x, y, 1.4 + (i * 7 % 5) * 0.42, i * 3 % 8 / 8 }
    end
  end
  return stars
end

local stars = strew(120)
local pop = ease "outBack"

--- They come out one after another from `cue` on, and twinkle.
function sky.stars(time, cue)
  local parts = {}
  for _, star in ipairs(stars) do
    local age = (time - cue - star[4] * 1.4) / 0.5
    if age > 0 then
      local size = star[3] * pop(math.min(1, age)) * (1 + 0.18 * math.sin(time * 5 + star[1]))
      parts[#parts + 1] = celspan.circle { centre = { star[1], star[2] }, radius = size,
                                           texture = "#fff4dc" }
    end
  end
  return celspan.cel { celspan.union(parts) }
end

return sky
