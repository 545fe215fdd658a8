-- The puddle: nobody is looking, so a child jumps, and the umbrella has other plans.
local score = require "sound.score"
local mood = require("stage.moods").fog

local set = parameters { grain = { 0.018, min = 0, max = 0.3 } }

local function none() return union {} end
local child = puppet.person { art = svg.load("../drawings/child.svg"):with { umbrella = none },
  switches = { "eye" }, bones = { { "scarf", from = "knot", to = "fold", parent = "body" },
    { "scarf end", from = "fold", to = "fringe" } } }
local gait = { stride = 128, pace = 2.2, bounce = 5 }
local GROUND, SIZE = 610, 1.25
local START, STOP = 0.6, 2.5 -- seconds: the film begins, and the child is there
local DRENCHED = 8.72 -- the umbrella turns back, with all the rain that it has caught

-- ---------------------------------------------------------------- the acting, in seconds

local SMOOTH, FAST, OVER = "inOutSine", "outCubic", "outBack"

--- Right and down of the whole, in pixels, after the walk.
local place = keys { { 5.2, { 0, 0 } }, { 5.75, { 225, -236 }, "outQuad" },
  { 6.4, { 268, -212 }, SMOOTH }, { 7.0, { 292, -238 }, SMOOTH }, { 7.16, { 296, -246 } },
  { 7.42, { 302, 0 }, "inQuad" }, { 10.06, { 302, 0 } }, { 10.26, { 308, -70 }, "outQuad" },
  { 10.46, { 314, 0 }, "inQuad" } }

--- Degrees of body and head, and how low the hips are.
local stance = keys { { 2.8, { 0, 0, 0 } }, { 3.1, { 15, 20, 6 }, SMOOTH }, { 3.7, { 15, 22, 6 } },
  { 3.85, { 0, -6, 0 }, SMOOTH }, { 4.55, { 0, -6, 0 } }, { 4.7, { 0, 4, 0 }, SMOOTH },
  { 5.05, { 26, -6, 42 }, SMOOTH }, { 5.2, { 28, -8, 45 } }, { 5.3, { 2, -16, -6 }, FAST },
  { 5.75, { -12, 10, 0 }, SMOOTH }, { 6.05, { 4, 30, 0 }, SMOOTH },
  { 6.35, { 4, 30, 0 } }, { 6.7, { -11, -26, 0 }, SMOOTH },
  { 7.0, { 6, -22, 0 } }, { 7.16, { -4, -24, -3 } }, { 7.42, { 4, 10, 0 } },
  { 7.5, { 20, 16, 48 }, FAST }, { 7.62, { 18, 12, 44 } }, { 8.0, { 0, 0, 0 }, SMOOTH },
  { 8.2, { -4, -24, 0 }, SMOOTH }, { 8.5, { -6, -26, 4 }, SMOOTH }, { 8.68, { -2, -20, -3 }, FAST },
  { 8.92, { 8, 22, 26 }, FAST }, { 9.4, { 9, 24, 24 }, SMOOTH }, { 9.8, { 0, -4, 0 }, SMOOTH },
  { 10.02, { 14, 8, 28 }, SMOOTH }, { 10.1, { 0, -8, -3 }, FAST }, { 10.46, { 2, 0, 0 } },
  { 10.54, { 15, 8, 34 }, FAST }, { 10.9, { -3, -14, 0 }, OVER } }

--- She shakes the water off: degrees of her head.
local shake = keys { { 9.3, 0 }, { 9.38, 17 }, { 9.46, -18 }, { 9.54, 17 }, { 9.63, -14 },
  { 9.71, 9 }, { 9.8, 0 } }

--- Where the ankles are beside their places below the hips: near, then far; in the air they kick.
local kick = keys { { 5.22, { 0, 0, 0, 0 } }, { 5.4, { -34, -4, -14, -2 }, FAST },
  { 5.75, { 34, -26, -20, -10 }, SMOOTH }, { 6.05, { -18, -10, 30, -26 }, SMOOTH },
  { 6.35, { 30, -26, -18, -10 }, SMOOTH }, { 6.65, { -16, -10, 26, -24 }, SMOOTH },
  { 6.95, { 6, -4, -4, -2 }, SMOOTH }, { 7.16, { 16, -3, -16, 0 }, OVER },
  { 7.4, { 14, -44, 24, -48 }, SMOOTH }, { 7.44, { 0, 0, 0, 0 } }, { 10.08, { 0, 0, 0, 0 } },
  { 10.26, { 22, -34, -14, -26 }, SMOOTH }, { 10.44, { 0, 0, 0, 0 } } }

--- Degrees of the near upper arm and forearm, and of the umbrella's pole.
local arm = keys { { 0, { -30, -112, 8 } }, { 2.8, { -30, -112, 8 } },
  { 3.1, { -34, -104, 18 }, OVER },
  { 4.7, { -30, -112, 6 } }, { 5.05, { -4, -120, -26 }, SMOOTH }, { 5.2, { -2, -120, -28 } },
  { 5.4, { -98, -62, 12 }, FAST }, { 5.9, { -88, -46, -10 }, SMOOTH },
  { 6.4, { -92, -42, 7 }, SMOOTH }, { 6.6, { -106, -56, 9 }, SMOOTH },
  { 7.0, { -108, -54, -6 }, SMOOTH }, { 7.5, { -96, -70, 12 } }, { 8.0, { -64, -92, -6 }, SMOOTH },
  { 8.55, { -52, -98, -12 }, SMOOTH },
  { 8.68, { -76, -84, -16 }, FAST }, { 8.92, { -58, -96, -8 }, SMOOTH },
  { 9.4, { -58, -98, -4 } }, { 10.02, { -40, -108, -4 }, SMOOTH }, { 10.2, { -98, -62, 8 }, FAST },
  { 10.46, { -96, -64, -8 }, SMOOTH }, { 10.56, { -60, -92, 10 }, FAST },
  { 10.9, { -74, -88, -2 }, OVER } }

--- Which way the child looks: it turns round between 1 and -1, and is never thinner than a child.
local facing = keys { { 3.8, 1 }, { 3.86, 0.6 }, { 3.87, -0.6 }, { 3.96, -1 }, { 4.5, -1 },
  { 4.56, -0.6 }, { 4.57, 0.6 }, { 4.66, 1 } }
local shut = { { 1.2, 1.3 }, { 3.4, 3.5 }, { 4.2, 4.3 }, { 6.2, 6.3 },
  { 7.44, 7.75 }, { DRENCHED + 0.1, 9.76 }, { 10.46, 10.6 } }
local inside_out = keys { { 6.98, 0 }, { 7.02, -0.15 }, { 7.12, 1, OVER },
  { DRENCHED - 0.06, 1.1 }, { DRENCHED + 0.06, 0, OVER } }
--- How much rain the umbrella has caught.
local caught = keys { { 7.6, 0 }, { 8.6, 1, SMOOTH }, { DRENCHED - 0.04, 1 }, { DRENCHED, 0 } }

--- The camera draws back while the umbrella is high.
local camera = keys { { 5.0, { 360, 1280 } }, { 5.8, { 250, 1560 }, SMOOTH },
  { 7.1, { 246, 1570 }, SMOOTH }, { 7.6, { 360, 1280 }, SMOOTH } }

local function below(t) return 3 * select(2, table.unpack(place:at(t - 0.08))) / 20 end
local flutter = motion.spring(below, { frequency = 1.8, damping = 0.25 })

local function pose_at(t)
  local walking = puppet.walk(child, math.min(t, STOP), gait)
  local lean, nod, low = table.unpack(stance:at(t))
  local nx, ny, fx, fy = table.unpack(kick:at(t))
  local stand = { at = { 0, low }, body = lean, head = nod + shake:at(t), reach = {
    ["ankle near"] = { 160 + nx, 316 + ny, pole = { 400, 280 }, loose = true },
    ["ankle far"] = { 140 + fx, 316 + fy, pole = { 400, 280 }, loose = true } } }
  local pose = t < STOP and walking or stand
  local upper, fore, pole = table.unpack(arm:at(t))
  pose["upper arm near"], pose["lower arm near"] = upper, fore
  pose["upper arm far"] = 10 + 0.8 * lean
  pose.scarf = 20 + flutter:at(t) - 2 * shake:at(t - 0.08)
  pose["scarf end"] = 24 + 1.5 * flutter:at(t - 0.08)
  pose.eye = "open"
  for _, span in ipairs(shut) do if t >= span[1] and t < span[2] then pose.eye = "shut" end end
  return pose, pole
end

-- ---------------------------------------------------------------- the umbrella and the water

local DOME = "M-98 0 C-90 -56 -40 -80 0 -82 C40 -80 90 -56 98 0 C78 -18 60 -16 34 -2 "
  .. "C20 -14 -20 -14 -34 -2 C-60 -16 -78 -18 -98 0 Z"
local CUP = "M-104 -112 C-84 -44 -36 -18 0 -16 C36 -18 84 -44 104 -112 C84 -90 62 -92 36 -108 "
  .. "C20 -94 -20 -94 -36 -108 C-62 -92 -84 -90 -104 -112 Z"
local PANEL = "M-34 -2 C-34 -40 -20 -70 0 -82 C20 -70 34 -40 34 -2 C20 -14 -20 -14 -34 -2 Z"
local INSIDE = "M-36 -108 C-30 -60 -16 -32 0 -16 C16 -32 30 -60 36 -108 C20 -94 -20 -94 -36 -108 Z"
local canopy, panel = keys { { 0, DOME }, { 1, CUP } }, keys { { 0, PANEL }, { 1, INSIDE } }

local function umbrella(open, full)
  return union { ellipse { 0, -214, 92 * full ^ 0.5, 12 * full, fill = mood.light },
    stroke { d = "M0 10 V-194 M0 10 q0 13 -11 11", width = 5.5, cap = "round", fill = "#5a4632" },
    path { d = canopy:at(open), fill = "#2f7f86" }:translate(0, -104),
    path { d = panel:at(open), fill = "#3f9aa0" }:translate(0, -104) }
end

local PUDDLE = nurbs { points = { { 420, 632 }, { 500, 590 }, { 660, 610 }, { 780, 580 },
  { 950, 606 }, { 900, 650 }, { 760, 640 }, { 640, 690 }, { 470, 664 } }, fill = mood.light }

--- Seven tongues of water that rise from a ring, and fall: `u` from 0 to 1.
local function crown(u, width, wider, height)
  local w, h = width + wider * u, height * math.sin(math.pi * u ^ 0.6)
  local d = { ("M%g 0"):format(-w) }
  for k, size in ipairs { 0.6, 1, 0.72, 1.12, 0.8, 0.94, 0.66 } do
    local x, tip = w * (k - 4) / 3.5, size * h
    d[k + 1] = ("Q%g %g %g %g Q%g %g %g %g"):format(x * 1.04 - 0.04 * w, -0.45 * tip, 1.3 * x, -tip,
      x * 1.04 + 0.05 * w, -0.45 * tip, w * (k - 3.5) / 3.5, k < 7 and -0.26 * h or 0)
  end
  return path { d = table.concat(d, " ") .. ("Q0 %g %g 0 Z"):format(0.16 * w, -w),
    fill = mood.light }:fade(math.max(0, 0.88 - 1.2 * u * u))
end

local function splash(t, from, strong)
  local drops = particles { seed = "splash " .. from, rate = 900 * strong, from = from,
    to = from + 0.09, life = { 0.9, 0.3 }, at = { 655, GROUND + 8, 70, 4 },
    velocity = { 0, -430 * strong ^ 0.5, 330, 260 }, gravity = { 0, 1250 } }
  local list = {}
  for _, p in ipairs(drops:at(t)) do
    if p.y < GROUND + 22 then
      list[#list + 1] = ellipse { 0, 0, 4 + 9 * p.size * (1 - p.age), 3 + 4 * p.size,
        fill = p.id % 3 == 0 and mood.light or "#8fb0b5" }
        :rotate(math.deg(math.atan(p.dy, p.dx))):translate(p.x, p.y)
    end
  end
  local u = (t - from) / 0.6
  if u > 0 and u < 1 then
    local root = strong ^ 0.5
    list[#list + 1] = crown(u, 120 * root, 200 * root, 215 * strong):translate(655, GROUND + 14)
  end
  return union(list)
end

--- The water that falls from the umbrella on the crown of her head, and off it.
local function drench(t, x, y)
  local fall, u = (t - DRENCHED) / 0.14, (t - DRENCHED - 0.12) / 0.5
  local off = particles { seed = "drench", rate = 420, from = DRENCHED + 0.12, to = DRENCHED + 0.42,
    life = { 0.7, 0.2 }, at = { x, y + 4, 40, 6 }, velocity = { 0, -190, 250, 160 },
    gravity = { 0, 1500 } }
  local shaken = particles { seed = "shake", rate = 110, from = 9.36, to = 9.72,
    life = { 0.5, 0.2 }, at = { x, y + 50, 40, 40 }, velocity = { 0, -150, 420, 160 },
    gravity = { 0, 900 } }
  local list = {}
  for _, drops in ipairs { off, shaken } do
    for _, p in ipairs(drops:at(t)) do
      list[#list + 1] = ellipse { p.x, p.y, 3 + 3 * p.size, 4 + 5 * p.size, fill = mood.light }
    end
  end
  if fall > 0 and fall < 1 then
    for i = -5, 5 do
      list[#list + 1] = ellipse { x + 12 * i, y - 60 + (70 + 26 * math.cos(2.3 * i)) * fall, 7,
        12 + 40 * fall, fill = i % 2 == 0 and mood.light or "#8fb0b5" }
    end
  end
  if u > 0 and u < 1 then
    list[#list + 1] = crown(u, 66, 60, 70):translate(x, y + 26)
  end
  return union(list)
end

local function rings(t)
  local list, chance = {}, random "rings"
  for i = 1, 26 do
    local age = (t * 1.1 + chance(i)) % 1
    local turn = (t * 1.1 + chance(i)) // 1
    local x, y = 450 + 470 * chance(i + 31 * turn + 0.5), 600 + 58 * chance(i + 17 * turn + 0.25)
    list[i] = ellipse { x, y, 4 + 34 * age, 1 + 8 * age }
      :stroke { width = 2.2 * (1 - age) + 0.2, fill = mood.near }:fade(0.8 * (1 - age))
  end
  for _, from in ipairs { 7.44, 7.6, 8.96, 10.46 } do
    local u = (t - from) / 1.1
    if u > 0 and u < 1 then
      list[#list + 1] = ellipse { 655, 628, 60 + 230 * u, 8 + 34 * u }
        :stroke { width = 7 * (1 - u), fill = mood.near }:fade(1 - u)
    end
  end
  return clip(union(list), PUDDLE)
end

-- ---------------------------------------------------------------- the park

local function trees(colour, base, count, size, seed)
  local chance, list = random(seed), {}
  for i = 1, count do
    local x, s = 1560 * (i - 0.7 + 0.6 * chance(i)) / count - 130, size * (0.7 + 0.6 * chance(-i))
    list[#list + 1] = stroke { points = { { x, base + 30, 0.16 * s },
      { x + 3, base - 0.6 * s, 0.1 * s }, { x - 4, base - 1.3 * s, 0.03 * s } },
      degree = 2, fill = colour }
    for k = 1, 9 do
      local a = 2.4 * k
      list[#list + 1] = ellipse { x + 0.34 * s * math.cos(a) * (k / 9) ^ 0.5,
        base - 1.25 * s + 0.46 * s * math.sin(a) * (k / 9) ^ 0.5, 0.24 * s, 0.2 * s, fill = colour }
    end
  end
  return union(list)
end

local LAMP = union { stroke { d = "M1090 620 V250 Q1090 214 1056 214", width = 9, cap = "round",
  fill = mood.ink }, path { d = "M1030 214 H1082 L1070 246 H1042 Z", fill = mood.ink },
  rect { 1078, 560, 24, 62, radius = 4, fill = mood.ink } }
local GLOW = circle { 1056, 254, 190, fill = radial { centre = { 1056, 254 }, radius = 190,
  { 0, "#fff3cfd0" }, { 0.16, "#fff0c870" }, { 1, "#fff0c800" } } }
local tufts = {} -- of grass, along the edge of the path
for i, x in ipairs { -40, 236, 700, 890, 1216 } do
  for k = -2, 2 do
    tufts[#tufts + 1] = stroke { points = { { x + 7 * k, 524, 7 },
      { x + 11 * k + 3, 506 - 3 * (i % 3) + 3 * k * k, 1 } }, cap = "round", fill = mood.near }
  end
end
local BACKDROP = union {
  rect { -200, -200, 1680, 920, fill = linear { from = { 0, -100 }, to = { 0, 560 },
    table.unpack(mood.sky) } },
  trees(mood.far, 500, 9, 190, "far"), trees("#b3c0ba", 530, 4, 250, "middle"),
  rect { -200, 520, 1680, 260, fill = linear { from = { 0, 520 }, to = { 0, 720 }, mood.near,
    mood.ground } }, union(tufts), GLOW,
  ellipse { 1104, 622, 58, 7, fill = mood.ink }:fade(0.3), LAMP,
  PUDDLE:with { fill = linear { from = { 0, 590 }, to = { 0, 670 }, "#a9bcbb", mood.sky[3] } } }

local drops = particles { seed = "rain", rate = 190, life = 1.05, at = { 760, -190, 960, 20 },
  velocity = { -90, 860, 10, 90 } }
local function rain(t)
  local list = {}
  for i, p in ipairs(drops:at(t)) do
    list[i] = stroke { points = { { p.x, p.y }, { p.x + 3.4, p.y - 34 } }, width = 2,
      cap = "round", fill = rgb("#ffffff", 0.22 + 0.42 * p.size) }
  end
  return union(list)
end

-- ---------------------------------------------------------------- the sound

--- Rain, boots, a waltz that stops in the air, and water.
local notes = { { START, score.wind(0.7, 10.4, 0.02), 0.048 },
  { 5.2, score.slide(260, 880, 0.55), 0.12 }, { 7.0, score.thump(300), 0.24 },
  { 7.16, score.slide(900, 200, 0.26), 0.15 },
  { 7.42, score.wind(0.55, 1.1, 0.03), 0.48 }, { 7.42, score.thump(80), 0.48 },
  { DRENCHED - 0.04, score.thump(300), 0.24 }, { DRENCHED, score.slide(700, 240, 0.14), 0.12 },
  { DRENCHED + 0.12, score.wind(0.6, 0.7, 0.03), 0.36 }, { 10.1, score.slide(300, 700, 0.3), 0.1 },
  { 10.46, score.wind(0.5, 0.6, 0.03), 0.33 }, { 10.46, score.thump(90), 0.39 },
  { 10.7, score.bell("G4", 1.6), 0.3 }, { 10.9, score.bell("C5", 1.6), 0.3 } }
for i = 2, 5 do notes[#notes + 1] = { 0.1 + i / 2.2, score.thump(120 + i % 2 * 25), 0.15 } end
for i, tone in ipairs { "C4", "E5", "E5", "G3", "D5", "D5", "C4", "E5", "G5" } do
  notes[#notes + 1] = { 0.27 * i + 0.35, score.bell(tone, 1.6), 0.135 }
end
for i, tone in ipairs { "A4", "B4", "C5", "B4", "C5", "D5" } do -- nobody looks
  notes[#notes + 1] = { 3 + 0.33 * i, score.bell(tone, 1.6), 0.105 }
end
for i = 0, 8 do -- the umbrella holds
  notes[#notes + 1] = { 5.75 + 0.15 * i, score.bell(i % 2 == 0 and "A5" or "G5", 1.6), 0.09 }
end
for i = 0, 4 do notes[#notes + 1] = { 9.36 + 0.08 * i, score.wind(0.6, 0.07, 0.05), 0.12 } end
for _, note in ipairs(notes) do note[1] = note[1] - START end

return film { title = "The puddle", size = { 1280, 720 }, fps = 24, frames = 258, poster = "5.9s",
  sound = score.play(10.75, notes),
  grain = { amount = set.grain, size = 1.6, frame = 0 },
  frame = function(f)
    local t = START + f:twos()
    local pose, pole = pose_at(t)
    local x, y = table.unpack(place:at(t))
    local high, wide = table.unpack(camera:at(t))
    local hx, hy = child:joint(pose, "hand near")
    local held = umbrella(inside_out:at(t), caught:at(t)):rotate(pole):translate(hx, hy)
    local right = -292 + x + SIZE * child:walked(math.min(t, STOP), gait)
    local figure = (held | child:pose(pose)):scale(facing:at(t), 1, 150, 0):scale(SIZE)
      :translate(right, y + GROUND - 334 * SIZE)
    local crown_x, crown_y = child:joint(pose, "crown")
    local mirrored = figure:scale(1, -0.6, 0, GROUND + 4)
    local shadow = ellipse { right + SIZE * 150, GROUND + 2, 66 + 0.12 * y, 9, fill = mood.ink }
      :fade(0.35 + 0.001 * y)
    return { BACKDROP, clip(mirrored:fade(0.34), PUDDLE), rings(t), shadow, figure,
      drench(t, right + SIZE * crown_x, y + GROUND + SIZE * (crown_y - 334)),
      splash(t, 7.42, 1), splash(t, 10.46, 0.5), rain(f.time),
      camera = { centre = { 640, high }, width = wide } }
  end }
