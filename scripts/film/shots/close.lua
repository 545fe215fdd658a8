-- Close: the spark in his mitten, his words to it, its second try, and the light on his face.
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

local LAMP, LAMP_SCALE = { 1452, 372 }, 2.5
local FEET, SCALE = { 600, 1322 }, 2.06
local at = timing

-- ---------------------------------------------------------------- his acting, by seconds

local head = keys { { 13.5, 12 }, { 14.2, 9, "inOutSine" }, { 14.45, 6, "inOutSine" },
  { 14.8, 11, "inOutSine" }, { 15.15, 7, "inOutSine" }, { 15.45, 11, "inOutSine" },
  { 15.9, 9, "inOutSine" }, { at.rises, 10 }, { at.rises + 0.25, 13, "inOutSine" },
  { 17.2, -10, "inOutSine" }, { at.enters, -13, "inOutSine" },
  { at.catches - 0.1, -11, "inOutSine" }, { at.catches + 0.05, -17, "outQuad" },
  { 18.6, -12, "inOutSine" }, { 18.95, -10, "inOutSine" }, { 19.1, -14, "outQuad" },
  { 19.6, -10, "inOutSine" }, { 20.5, -12, "inOutSine" } }
local lean = keys { { 13.5, 5 }, { 14.3, 6, "inOutSine" }, { 15.2, 8, "inOutSine" },
  { 16.2, 6, "inOutSine" }, { at.rises + 0.3, 7, "inOutSine" }, { 17.4, -2, "inOutSine" },
  { at.catches - 0.1, -1 }, { at.catches + 0.15, -5, "outQuad" }, { 18.8, -2, "inOutSine" },
  { 20.5, -1, "inOutSine" } }
local gaze = keys { { 13.5, { 4, 7 } }, { 14.2, { 4, 6 } }, { at.rises, { 4, 6 } },
  { at.rises + 0.2, { 5, 5 }, "outQuad" }, { 16.95, { 6, -3 }, "inOutSine" },
  { 17.25, { 5, -6 }, "inOutSine" }, { 17.6, { 6, -8 }, "outQuad" } }
local brows = keys { { 13.5, { 2, 22 } }, { 14.2, { 0, 22 } }, { 14.45, { -6, 18 }, "outQuad" },
  { 14.8, { -2, 20 }, "inOutSine" }, { 15.15, { -7, 16 }, "outQuad" },
  { 15.8, { -3, 18 }, "inOutSine" }, { at.rises + 0.1, { -3, 18 } },
  { at.rises + 0.4, { -12, 10 }, "outQuad" }, { at.enters, { -12, 10 } },
  { at.enters + 0.3, { -4, 18 }, "inOutSine" }, { at.catches, { -3, 16 } },
  { at.catches + 0.12, { -17, 6 }, "outQuad" }, { 18.7, { -9, 6 }, "inOutSine" },
  { 19.1, { -14, 8 }, "outQuad" }, { 19.8, { -9, 7 }, "inOutSine" } }
local near = keys { { 13.5, { 334, 396 } }, { 14.3, { 340, 388 }, "inOutSine" },
  { 15.2, { 348, 372 }, "inOutSine" }, { 16.0, { 346, 378 }, "inOutSine" },
  { at.rises, { 346, 384 }, "inOutSine" }, { at.rises + 0.16, { 346, 398 }, "outQuad" },
  { at.rises + 0.42, { 352, 350 }, "outBack" }, { 17.3, { 348, 372 }, "inOutSine" },
  { at.catches, { 344, 384 }, "inOutSine" }, { at.catches + 0.2, { 322, 366 }, "outQuad" },
  { 18.9, { 308, 392 }, "inOutSine" }, { 19.2, { 312, 380 }, "outQuad" },
  { 20, { 306, 392 }, "inOutSine" } }
local squash = keys { { 13.5, 1 }, { at.rises, 1 }, { at.catches - 0.05, 1 },
  { at.catches + 0.08, 1.025, "outQuad" }, { at.catches + 0.4, 0.992, "inOutSine" },
  { 18.9, 1, "inOutSine" } }
--- The hand behind him and the degrees of its pole, whose hook hangs between hat and lamp.
local staff = keys { { at.rises, { 292, 462, 25 } }, { 17.2, { 338, 462, 11 }, "inOutSine" } }

local function pose_at(time)
  local pose = acting.at(time)
  local breath = math.sin(time * 2.4)
  pose.step, pose.mitten = "stand", "open"
  pose.lean, pose.head = lean:at(time), head:at(time) + 0.7 * math.sin(time * 2.4 - 0.8)
  pose.hat = 0.8 * (head:at(time - 0.12) - head:at(time)) + 0.6
    * (lean:at(time - 0.12) - lean:at(time))
  pose.rise, pose.squash = 2.2 * breath, squash:at(time)
  pose.gaze, pose.brows = gaze:at(time), brows:at(time)
  pose.near, pose.near_turn = near:at(time), -10 + 2 * breath
  local x, y, turn = table.unpack(staff:at(time))
  pose.far, pose.far_turn, pose.pole, pose.pole_behind = { x, y }, 12, turn, true
  pose.stream = 0.16 + 0.05 * math.sin(time)
  return pose
end

-- ---------------------------------------------------------------- the spark

local up = ease "inOutSine"

--- Its path from his mitten up to the lamp: a loop of joy, then into the glass from below.
local function flight(from)
  local loop = "C%g %g 900 640 1010 690C1110 736 1190 640 1110 590C1020 540 1010 430 1180 440"
  return motion.along(("M%g %g" .. loop .. "C1300 446 1400 420 %g %g"):format(from[1], from[2],
    from[1], from[2] - 130, LAMP[1], LAMP[2] + 30))
end

local life = keys { { 13.5, 0.3 }, { 14.72, 0.4, "inOutSine" }, { 15.05, 0.1, "inOutSine" },
  { 15.3, 0.36, "outQuad" }, { 15.5, 0.4, "inOutSine" }, { 16.0, 0.62, "inOutSine" },
  { at.rises, 0.8, "inOutSine" },
  { at.rises + 0.4, 1, "outQuad" }, { at.enters, 1 }, { at.enters + 0.2, 0.5, "inOutSine" },
  { at.catches, 0.4 } }

--- Its position, and the trail behind it while it flies.
local function spark_at(time, palm)
  local u = motion.span(time, at.rises + 0.3, at.enters - at.rises - 0.3)
  local hop = motion.span(time, at.rises, 0.3)
  if u == 0 then return { palm[1], palm[2] - 44 - 30 * math.sin(math.pi * hop) * hop } end
  local trail = spark.trail(flight { palm[1], palm[2] - 44 }, up(u), 0.2)
  return trail[#trail], u < 1 and trail or nil
end

--- The times at which his breath is visible in the cold.
local breaths = { 13.9, at.coaxing + 0.5, at.coaxing + 1.9, at.thanks + 0.3, at.thanks + 0.85 }

--- The brightness of the lamp: it flickers twice, and then catches.
local burning = keys { { at.enters, 0 }, { at.enters + 0.03, 0.22, "outQuad" },
  { at.enters + 0.18, 0.05, "inQuad" }, { at.enters + 0.3, 0.3, "outQuad" },
  { at.enters + 0.44, 0.03, "inQuad" }, { at.catches - 0.03, 0.06 },
  { at.catches + 0.1, 0.7, "outQuad" }, { at.catches + 0.2, 0.45, "inOutSine" },
  { at.catches + 0.75, 1, "inOutSine" } }

function shot.lamp_level(time) return burning:at(time) end

-- ---------------------------------------------------------------- the shot

local flakes = {
  far = snow.curtain("close far", { count = 60, size = { 2, 4 }, fall = 80, drift = -24,
    sway = 20 }),
  middle = snow.curtain("close middle", { count = 44, size = { 4, 8 }, fall = 140, drift = -40,
    sway = 34 }),
  near = snow.curtain("close near", { count = 5, size = { 18, 34 }, fall = 260, drift = -90,
    sway = 60, soft = 0.9 }),
}

local push = keys { { 13.5, 0 }, { 20.5, 70, "inOutSine" } }

--- The street far behind, larger than it was and out of focus.
local function behind(object) return object:scale(1.42, 1.42, 1160, 760):translate(-60, 70) end

local sky, houses = behind(street.sky), behind(street.houses | street.ground)

function shot.draw(time)
  local pose = pose_at(time)
  local figure, _, palm = lamplighter.draw(pose)
  local palm_at = { FEET[1] + SCALE * palm[1], FEET[2] + SCALE * palm[2] }
  local place, trail = spark_at(time, palm_at)
  local camera = { x = 0, y = 0, z = push:at(time) }
  local level, alive = burning:at(time), life:at(time)
  local breath = light.flicker(time)
  local lit = math.min(1, level * 3)
  local inside = motion.span(time, at.enters - 0.1, 0.1)
  local lx, ly = lens.project(camera, 0, place[1], place[2])
  local reach = 560 + 240 * alive + 1500 * level
  local strength = ((0.2 + 0.6 * alive) * (1 - inside) + 1.7 * level) * breath
  local function front(distance, share)
    return light.about(lx, ly, reach, strength * share,
      light.scaled(light.at(distance, time), 1 - 0.12 * lit))
  end
  local set = lens.stack(camera, { aperture = 20, focus = lens.FOCAL - camera.z,
    over = { lens.vignette } })
  local function hang(object) return lamp.place(object, LAMP[1], LAMP[2], LAMP_SCALE) end
  local glass, glass_front = lamp.glass(level * breath, light.at("near", time))
  local body = figure:scale(SCALE):translate(FEET[1], FEET[2])
  set:plane("sky", 2600, light.at("sky", time), sky)
  set:plane("far snow", 900, front("far", 0.8), flakes.far(time, 0, 0))
  set:plane("houses", 1400, front("middle", 0.8), houses)
  set:add(0, lamp.glow(LAMP[1], LAMP[2] + 14, 760, level * breath))
  set:plane("post", 0, front("near", 0.7), hang(lamp.post))
  set:plane("glass", 0, glass_front, hang(glass))
  set:plane("lantern", 0, front("near", 0.8), hang(lamp.frame))
  set:plane("lamplighter", 0, front("near", 1), body)
  if level > 0.05 then
    -- The edges that face the lamp catch more of its light than the rest of him.
    set:plane("rim", 0, light.about(lx, ly, reach, strength + 1.5 * level * breath,
      light.at("near", time)), body - body:translate(-9, 7))
  end
  if inside < 1 then set:add(0, spark.draw(time, place[1], place[2], 34, alive, trail)) end
  for _, spoken in ipairs(breaths) do
    local age = time - spoken
    set:add(0, spark.puff(age, 866 + 90 * age, 706 + 40 * age, 30, 0.7))
  end
  set:add(0, spark.burst(time - at.catches, LAMP[1], LAMP[2] + 10, 250, 0.6))
  set:plane("snow", 0, front("near", 1.2), flakes.middle(time, 0, 0))
  set:plane("near snow", -300, front("near", 0.8), flakes.near(time, 0, 0))
  return set:shoot()
end

return shot
