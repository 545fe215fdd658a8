-- The street: he comes with the spark on his pole, reaches up to the last lamp, and it does not
-- burn.
local acting = require "film.acting"
local lamp = require "film.lamp"
local lamplighter = require "film.lamplighter"
local lens = require "film.lens"
local light = require "film.light"
local snow = require "film.snow"
local spark = require "film.spark"
local street = require "film.street"
local timing = require "film.timing"

local shot = {}

local LAMP = { 1236, 352 }
local SCALE, STAND, GROUND = 0.74, 972, 936
local HOUSES, SKY, BANK, BRANCH = 800, 2600, -260, -430

-- ---------------------------------------------------------------- his acting, by seconds

local at = timing
local lean = keys { { 9.1, 5 }, { 9.4, -3, "outQuad" }, { 9.75, 0, "inOutSine" }, { at.reach, 0 },
  { at.reach + 0.3, -7, "inOutSine" }, { at.reach + 0.55, 9, "outBack" }, { at.puff, 8 },
  { at.puff + 0.12, -6, "outQuad" }, { 11.4, 0, "inOutSine" }, { 12.0, 5, "inOutSine" },
  { at.caught, 7 }, { at.caught + 0.14, 4, "outQuad" }, { 13.2, 6, "inOutSine" } }
local squash = keys { { 9.15, 1 }, { 9.3, 0.965, "outQuad" }, { 9.55, 1.01, "inOutSine" },
  { 9.8, 1 }, { at.reach, 1 }, { at.reach + 0.32, 0.9, "inOutSine" },
  { at.reach + 0.55, 1.085, "outQuad" }, { at.reach + 0.75, 1.06, "inOutSine" }, { at.puff, 1.065 },
  { at.puff + 0.1, 0.93, "outQuad" }, { at.puff + 0.4, 1.01, "outBack" }, { 11.7, 1, "inOutSine" },
  { at.caught, 1.015, "inOutSine" }, { at.caught + 0.12, 0.955, "outQuad" },
  { at.caught + 0.45, 0.99, "inOutSine" }, { 13.2, 0.97, "inOutSine" } }
local head = keys { { 9.2, 0 }, { 9.35, 5, "outQuad" }, { 9.85, -13, "inOutSine" },
  { at.reach + 0.3, -4, "inOutSine" }, { at.reach + 0.55, -20, "outQuad" }, { at.puff, -19 },
  { at.puff + 0.1, -27, "outQuad" }, { at.puff + 0.42, -14, "inOutSine" },
  { 11.5, -9, "inOutSine" }, { at.caught, 8, "inOutSine" }, { at.caught + 0.12, 12, "outQuad" },
  { 12.8, 9, "inOutSine" }, { 13.4, 13, "inOutSine" } }
local gaze = keys { { 9.4, { 0, 0 } }, { 9.6, { 3, -8 }, "outQuad" }, { at.puff, { 4, -9 } },
  { 11.35, { 5, -6 }, "inOutSine" }, { at.caught, { 4, 7 }, "inOutSine" } }
local brows = keys { { 9.5, { 0, 0 } }, { 9.8, { -7, 0 }, "outQuad" }, { at.reach, { -6, 0 } },
  { at.reach + 0.3, { 5, -10 }, "inOutSine" }, { at.reach + 0.6, { -8, 4 }, "outQuad" },
  { at.puff, { -8, 4 } }, { at.puff + 0.1, { 8, -6 }, "outQuad" }, { 11.2, { -10, 12 }, "outQuad" },
  { at.caught, { -6, 12 }, "inOutSine" }, { 13, { 2, 22 }, "inOutSine" } }
local far = keys { { 9.2, { 362, 396 } }, { 9.45, { 366, 404 }, "outQuad" },
  { at.reach, { 364, 398 } }, { at.reach + 0.32, { 352, 440 }, "inOutSine" },
  { at.reach + 0.58, { 414, 178 }, "outBack" }, { at.puff, { 412, 184 } },
  { at.puff + 0.12, { 404, 206 }, "outQuad" }, { 11.1, { 402, 230 }, "inOutSine" },
  { 11.75, { 376, 408 }, "inOutCubic" }, { 12.1, { 374, 400 }, "inOutSine" } }
local staff = keys { { 9.1, 9 }, { 9.4, 2, "outQuad" }, { 9.7, 5, "inOutSine" }, { at.reach, 5 },
  { at.reach + 0.32, -4, "inOutSine" }, { at.reach + 0.58, 20, "outBack" }, { at.puff, 20 },
  { at.puff + 0.14, 26, "outQuad" }, { 11.1, 24, "inOutSine" }, { 11.8, 5, "inOutCubic" },
  { 12.2, 7, "inOutSine" } }
local near = keys { { 9.2, { 172, 442 } }, { at.reach, { 170, 444 } },
  { at.reach + 0.32, { 196, 450 }, "inOutSine" }, { at.reach + 0.58, { 128, 414 }, "outBack" },
  { at.puff, { 130, 418 } }, { at.puff + 0.12, { 150, 380 }, "outQuad" },
  { 11.3, { 176, 440 }, "inOutSine" }, { 11.75, { 176, 446 } }, { 12.15, { 326, 392 }, "outBack" },
  { at.caught, { 330, 386 }, "inOutSine" }, { at.caught + 0.12, { 330, 404 }, "outQuad" },
  { at.caught + 0.5, { 328, 392 }, "inOutSine" }, { 13.3, { 318, 386 }, "inOutSine" } }
local palm = keys { { 11.7, 84 }, { 12.1, -12, "outQuad" } }

--- The movement while he stands: breath, and a scarf that comes to rest.
local function breath(time) return math.sin(time * 2.6) end

local stream = keys { { 9.0, 0.75 }, { 9.35, 0.95, "outQuad" }, { 10.0, 0.18, "inOutSine" },
  { at.reach + 0.4, 0.1 }, { at.reach + 0.7, 0.5, "outQuad" }, { at.puff + 0.1, 0.35 },
  { at.puff + 0.3, 0.7, "outQuad" }, { 11.8, 0.2, "inOutSine" }, { 13.5, 0.16 } }

--- The pose at a time, and his position.
local function pose_at(time)
  local pose, way = acting.at(time)
  local step = lamplighter.step(pose.step)
  local walks = time < 9.2
  pose.lean = lean:at(time) + (walks and 1.6 * step.swing or 0)
  pose.rise = step.bob + (walks and 0 or 1.6 * breath(time))
  pose.squash = squash:at(time)
  pose.head = head:at(time) - (walks and 0.3 * step.bob or 0) + 0.6 * breath(time - 0.3)
  pose.hat = (walks and -0.55 * lamplighter.step(acting.at(time - 0.09).step).bob or 0)
    + 0.9 * (lean:at(time - 0.09) - lean:at(time)) + 0.5 * (head:at(time - 0.1) - head:at(time))
  pose.gaze, pose.brows = gaze:at(time), brows:at(time)
  pose.far, pose.pole, pose.stream = far:at(time), staff:at(time), stream:at(time)
  pose.far_turn = -8 + 0.7 * (pose.pole - 6) - 0.12 * (396 - pose.far[2])
  local hand = near:at(time)
  pose.near = walks and { hand[1] - 44 * step.swing, hand[2] - 8 * math.abs(step.swing) } or hand
  pose.near_turn = palm:at(time) + (walks and 34 * step.swing or 0)
  if walks then pose.far = { pose.far[1] + 6 * step.swing, pose.far[2] + 0.7 * step.bob } end
  return pose, STAND - SCALE * (acting.far_way() - way)
end

-- ---------------------------------------------------------------- the spark

--- It falls like a leaf, from the lamp down into his mitten.
local fall = keys { { at.puff + 0.12, { LAMP[1], LAMP[2] + 60 } },
  { 11.4, { LAMP[1] - 92, LAMP[2] + 130 }, "inOutSine" },
  { 11.75, { LAMP[1] - 12, LAMP[2] + 232 }, "inOutSine" },
  { 12.08, { LAMP[1] - 118, LAMP[2] + 352 }, "inOutSine" }, { at.caught, { 0, 0 }, "inQuad" } }
local life = keys { { at.spark_in, 1 }, { at.puff, 1 }, { at.puff + 0.15, 0.75 },
  { at.caught, 0.4, "inOutSine" }, { 13.4, 0.28 } }

local function mixed(a, b, u) return { a[1] + (b[1] - a[1]) * u, a[2] + (b[2] - a[2]) * u } end

--- The position of the spark: on the pole, in the lamp, on its way down, in his mitten.
local function spark_at(time, tip, palm_at)
  if time < at.spark_in then return mixed(tip, LAMP,
    motion.span(time, at.spark_in - 0.12, 0.12)) end
  if time < at.puff + 0.12 then return { LAMP[1], LAMP[2] + 20 } end
  local place = fall:at(time)
  local u = motion.span(time, 12.08, at.caught - 12.08)
  if u == 0 then return place end
  return mixed(fall:at(12.08), palm_at, u * u)
end

-- ---------------------------------------------------------------- the shot

local flakes = {
  far = snow.curtain("street far", { count = 120, size = { 1.2, 2.6 }, fall = 60, drift = -16,
    sway = 14 }),
  middle = snow.curtain("street middle", { count = 70, size = { 2.4, 4.6 }, fall = 105, drift = -30,
    sway = 24 }),
  near = snow.curtain("street near", { count = 16, size = { 14, 34 }, fall = 210, drift = -70,
    sway = 50, soft = 0.6 }),
}

-- Distances while the camera is at rest: planes in focus stay in focus when the camera comes
-- nearer.
local focus = keys { { 6.9, lens.FOCAL + BRANCH }, { 8.3, lens.FOCAL, "inOutCubic" } }
local camera_z = keys { { 5.75, 0 }, { 8.6, 24, "inOutSine" }, { 13.5, 250, "inOutSine" } }
local camera_y = keys { { 8.6, 0 }, { 13.5, 66, "inOutSine" } }
local camera_x = keys { { 5.75, -46 }, { 8.6, 20, "inOutSine" }, { 13.5, 132, "inOutSine" } }

--- The footprints that he has left so far, and the shadow under him.
local function traces(x, way)
  local parts = {}
  local last = math.floor((way - 30) / 72)
  for i = 0, last do
    local px = STAND - SCALE * (acting.far_way() - (i * 72 + 36)) - 8
    parts[#parts + 1] = street.footprint(px, GROUND + (i % 2 == 0 and 4 or -6))
  end
  parts[#parts + 1] = street.shadow(x, GROUND, 120, 0.62)
  parts[#parts + 1] = street.shadow(LAMP[1], LAMP[2] + 590, 70, 0.5)
  return union(parts)
end

--- The flash in the lamp that promises everything.
local function flash_at(time)
  local age = time - at.spark_in
  if age < 0 or time > at.puff then return 0 end
  return (0.55 + 0.45 * math.sin(age * 60)) * (1 - age / 0.5)
end

function shot.draw(time)
  local pose, x = pose_at(time)
  local _, way = acting.at(time)
  local figure, tip, hand = lamplighter.draw(pose)
  local function world(p) return { x + SCALE * p[1], GROUND + SCALE * p[2] } end
  local place = spark_at(time, world(tip), world(hand))
  local camera = { x = camera_x:at(time), y = camera_y:at(time), z = camera_z:at(time) }
  local sx, sy = lens.project(camera, 0, place[1], place[2])
  local alive, flash = life:at(time), flash_at(time)
  local strength = (0.34 * alive + 1.7 * flash) * light.flicker(time)
  local reach = 330 + 330 * flash
  local function front(distance, share)
    return light.about(sx, sy, reach, strength * share, light.at(distance, time))
  end
  local glass, glass_front = lamp.glass(flash * 0.9, light.at("near", time))
  local set = lens.stack(camera, { focus = focus:at(time) - camera.z, aperture = 17,
    over = { lens.vignette } })
  local function stand(object) return object:translate(LAMP[1], LAMP[2]) end
  local dusk = light.at("near", time)
  set:plane("sky", SKY, light.at("sky", time), street.sky)
  set:plane("far snow", 1500, light.at("far", time), flakes.far(time, 0, 0))
  set:plane("houses", HOUSES, front("middle", 0.6), street.houses)
  set:plane("ground", 0, front("near", 0.9), street.ground, traces(x, way))
  set:plane("post", 0, front("near", 0.8), stand(lamp.post))
  set:plane("glass", 0, glass_front, stand(glass))
  set:plane("lantern", 0, front("near", 0.8), stand(lamp.frame))
  set:plane("lamplighter", 0, front("near", 1), figure:scale(SCALE):translate(x, GROUND))
  set:add(0, spark.draw(time, place[1], place[2], 13, alive))
  set:add(0, spark.burst(time - at.spark_in, LAMP[1], LAMP[2], 120, 0.45))
  set:add(0, spark.puff(time - at.puff, LAMP[1], LAMP[2] - 20, 46))
  set:plane("snow", 0, front("near", 1.2), flakes.middle(time, 0, 0))
  set:plane("bank", BANK, light.scaled(dusk, 0.8), street.before)
  set:plane("branch", BRANCH, light.scaled(dusk, 0.86),
    street.branch:rotate(0.5 * math.sin(time * 1.1), -100, 0))
  set:plane("near snow", -500, dusk, flakes.near(time, 0, 0))
  return set:shoot()
end

return shot
