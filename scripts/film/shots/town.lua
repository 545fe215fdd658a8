-- The town again, by night: the light goes from the lamp through all the streets; the lamplighter
-- trots home; one spark rises and stays as a star. Credits, and one window that keeps its light.
local acting = require "film.acting"
local credits = require "film.credits"
local lamplighter = require "film.lamplighter"
local lens = require "film.lens"
local light = require "film.light"
local plan = require "film.plan"
local shapes = require "demo.shapes"
local snow = require "film.snow"
local spark = require "film.spark"
local street = require "film.street"
local timing = require "film.timing"
local town = require "film.town"

local shot = {}

local at = timing
local LAMP = plan.lamps[1]
local SCALE = 0.17
local from_x = LAMP[1] + 46
local ROAD = 14

local flakes = {
  far = snow.curtain("town far", { count = 110, size = { 1, 2.2 }, fall = 38, drift = -12,
    sway = 10 }),
  middle = snow.curtain("town middle", { count = 60, size = { 2, 4 }, fall = 72, drift = -24,
    sway = 18 }),
  near = snow.curtain("town near", { count = 12, size = { 12, 28 }, fall = 150, drift = -60,
    sway = 40, soft = 0.65 }),
}

local zoom = keys { { 19.9, 330 }, { 23.2, 150, "inOutSine" }, { 29.5, 40, "inOutSine" } }
local tilt = keys { { 19.9, 60 }, { 21.9, 44, "inOutSine" }, { 24.7, -345, "inOutSine" },
  { 29.5, -375, "inOutSine" } }

local STAR = { 1390, -150 }

--- The path of the spark from the lamp to its place among the stars, on the frame before the tilt.
local loop = "M%g %gC%g 640 1120 520 1290 420C1420 340 1500 260 1420 120C1380 40 %g -60 %g %g"
local rising = motion.along(loop:format(LAMP[1], LAMP[2] - 110, LAMP[1] + 60, STAR[1] + 20, STAR[1],
  STAR[2]))

-- ---------------------------------------------------------------- he goes home

local function walker(time)
  local pose, way = acting.at(time)
  local _, before = acting.at(at.shots[4].from)
  local step = lamplighter.step(pose.step)
  local x = from_x + SCALE * (way - before)
  pose.eyes, pose.mouth, pose.mitten = "happy", "smile", "grip"
  pose.rise, pose.lean, pose.stream, pose.head = step.bob * 1.3, 5, 0.85, -0.5 * step.bob
  pose.near = { 172 - 46 * step.swing, 440 - 10 * math.abs(step.swing) }
  pose.near_turn, pose.pole, pose.far = 84 + 34 * step.swing, 16, { 366, 386 }
  local figure = lamplighter.draw(pose)
  local y = plan.ground(5, x) + ROAD
  local parts = {}
  for i = 0, (way - before) // 72 do
    local px = from_x + SCALE * (i * 72 - 20)
    parts[#parts + 1] = street.footprint(0, 0):scale(0.26):translate(px,
      plan.ground(5, px) + ROAD + i % 2 * 3)
  end
  parts[#parts + 1] = street.shadow(x, y, 26, 0.6)
  local lx = lens.project({ x = 0, y = 0, z = zoom:at(time) }, town.depths.town, LAMP[1], 0)
  local _, ly = lens.project({ x = 0, y = 0, z = zoom:at(time) }, town.depths.town, 0,
    LAMP[2] - 100)
  return celspan.cel { union(parts), figure:scale(SCALE):translate(x, y),
    front = light.about(lx, ly, 460, 0.9, light.at("near", time)) }:named "lamplighter"
end

-- ---------------------------------------------------------------- the star

--- The brightness of the frame: it goes dark at the end, except for a glimmer.
local function brightness_at(time)
  return 1 - 0.96 * ease "inOutSine"(motion.span(time, at.fade, at.seconds - at.fade - 0.1))
end

--- The star that the spark becomes: four rays that open and pulsate. It fades out last.
local function star(time)
  local age, kept = time - at.star, brightness_at(time) ^ -0.7
  if age < 0 then return celspan.cel {} end
  local open = ease "outBack"(math.min(1, age / 0.7)) * (0.86 + 0.14 * math.sin(time * 2.7))
  local rays = {}
  for i = 0, 3 do
    local long = (i % 2 == 0 and 46 or 30) * open
    rays[#rays + 1] = polygon { { 0, -long }, { 3.4, 0 }, { 0, 4 }, { -3.4, 0 },
      fill = "#fff2cf" }:rotate(90 * i)
  end
  rays[#rays + 1] = circle { 0, 0, 6 * open, fill = "#fffaf0" }
  local function place(object) return object:translate(STAR[1], STAR[2]) end
  return celspan.cel { place(union(rays)), front = light.scaled({ 1.3, 1.2, 1.05 }, kept) }
      :named "star",
    celspan.cel { place(shapes.glow(0, 0, 230 * open, 1, 0.56, 0.26, 0.02)),
      front = light.scaled({ 9, 9, 9 }, kept) }
      :named "star glow"
end

local function rising_spark(time)
  local u = ease "inOutSine"(motion.span(time, at.star_rises, at.star - at.star_rises))
  if u == 0 or u == 1 then return end
  local trail = spark.trail(rising, u, 0.14)
  local place = trail[#trail]
  return spark.draw(time, place[1], place[2], 5 + 5 * math.sin(math.pi * math.min(1, u * 1.2)), 1,
    trail)
end

function shot.draw(time)
  local rise = tilt:at(time)
  local over = {}
  local function add(...)
    for _, cel in ipairs { ... } do over[#over + 1] = cel end
  end
  add(rising_spark(time))
  add(star(time))
  local function fixed(cel) return cel:translate(0, rise) end
  for _, cel in ipairs(credits.draw(time)) do add(fixed(cel)) end
  add(fixed(lens.vignette))
  local rostrum = town.shoot(time, { windows = at.windows, sleep = at.sleep, snow = flakes,
    camera = { x = 0, y = 0, z = zoom:at(time) }, added = walker(time), over = over })
  return rostrum:with { camera = { centre = { 960, 540 + rise } },
    brightness = brightness_at(time) }
end

return shot
