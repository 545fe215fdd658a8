-- The town at dusk. A spark comes, writes the title into the sky, and flies down into the streets.
local lens = require "film.lens"
local snow = require "film.snow"
local spark = require "film.spark"
local timing = require "film.timing"
local title = require "film.title"
local town = require "film.town"

local shot = {}

local rises = timing.title

local flakes = {
  far = snow.curtain("opening far", { count = 110, size = { 1, 2.2 }, fall = 38, drift = -12,
    sway = 10 }),
  middle = snow.curtain("opening middle",
    { count = 60, size = { 2, 4 }, fall = 72, drift = -24, sway = 18 }),
  near = snow.curtain("opening near", { count = 14, size = { 12, 30 }, fall = 150, drift = -60,
    sway = 40, soft = 0.65 }),
}

local zoom = keys { { 0, 0 }, { 6.25, 240, "inOutSine" } }
local tilt = keys { { 0, -150 }, { 4.3, -96, "inOutSine" }, { 6.25, 40, "inOutSine" } }

local start = title.hand(rises.from)
local stop = title.hand(rises.written)
local arrival = motion.along(("M-60 700C200 620 330 420 240 250C200 150 %g %g %g %g"):format(
  start[1] - 140, start[2] - 20, start[1], start[2]))
local dive = "M%g %gC%g %g 1800 120 1640 330C1500 520 1180 560 1010 700C900 800 800 860 700 900"
local departure = motion.along(dive:format(stop[1], stop[2], stop[1] + 120, stop[2] - 40))

--- The position of the spark on the frame, its size, and the trail behind it.
local function spark_at(time)
  if time < rises.from then
    local u = ease "inOutQuad"(motion.span(time, 0.1, rises.from - 0.1))
    local trail = spark.trail(arrival, u, 0.16)
    return trail[#trail], 13, trail
  elseif time < rises.written + 0.05 then
    return title.hand(time), 13
  end
  local u = ease "inOutCubic"(motion.span(time, rises.written + 0.05, 2.1))
  local trail = spark.trail(departure, u, 0.13)
  return trail[#trail], 13 - 8.5 * u, trail
end

function shot.draw(time)
  local place, size, trail = spark_at(time)
  local glow, ember = spark.draw(time, place[1], place[2], size, 1, trail)
  local writing, line = title.draw(time)
  local rise = tilt:at(time)
  local function fixed(cel) return cel:translate(0, rise) end
  local rostrum = town.shoot(time, { windows = timing.windows, sleep = timing.sleep, snow = flakes,
    camera = { x = 30 * math.sin(time / 5), y = 0, z = zoom:at(time) },
    over = { fixed(writing), fixed(line), fixed(glow), fixed(ember), fixed(lens.vignette) } })
  return rostrum:with { camera = { centre = { 960, 540 + rise } } }
end

return shot
