-- The press: a machine makes every ball into a cube, until one ball will not. An isometric scene
-- with grain: each tone is a colour that dissolves into the one below it, dot by dot.
local score = require "sound.score"

local W, H, FPS = 1280, 720, 24
local PINK, ROSE, PLUM, CREAM = "#f6b8a6", "#e88f7f", "#5a1f3d", "#fff1dc"
local TEAL, DEEP, SEA = "#16837a", "#0b4f52", "#46b5a0"
local GOLD, AMBER, SUN = "#ffb627", "#d9641a", "#ffe08a"

-- ---------------------------------------------------------------- the room

--- Where a point of the room is in the picture: x goes along the belt, down to the right; y away
--- from us, up to the right; z upwards.
local function at(x, y, z) return 640 + 0.866 * (x + y), 400 + 0.5 * (x - y) - (z or 0) end

--- A face through points of the room.
local function face(points, fill)
  local list = { fill = fill }
  for i, p in ipairs(points) do list[i] = { at(p[1], p[2], p[3]) } end
  return polygon(list)
end

local DOT = 2.2 -- the side of a grain

--- A shape with a tone that dissolves into it, denser towards its dark side; from and to are shares
--- of its bounds.
local function grainy(shape, colour, from, to, most)
  local x, y, w, h = shape:bounds()
  if not x then return shape end
  local dark = linear { from = { x + from[1] * w, y + from[2] * h },
    to = { x + to[1] * w, y + to[2] * h }, { 0, rgb(colour, 0) }, { 1, rgb(colour, most or 0.8) } }
  local dots = dissolve(shape:paint(dark):scale(1 / DOT)):scale(DOT)
  return union { shape, dots }
end

--- A box with its lower corner nearest to the left at x, y, z.
local function box(x, y, z, along, away, high, tones)
  local x1, y1, z1 = x + along, y + away, z + high
  return union {
    face({ { x, y, z1 }, { x1, y, z1 }, { x1, y1, z1 }, { x, y1, z1 } }, tones[1]),
    grainy(face({ { x, y, z }, { x1, y, z }, { x1, y, z1 }, { x, y, z1 } }, tones[2]), tones[3],
      { 0.5, 0.1 }, { 0.4, 1 }, tones.most),
    grainy(face({ { x1, y, z }, { x1, y1, z }, { x1, y1, z1 }, { x1, y, z1 } }, tones[3]), PLUM,
      { 0.3, 0 }, { 0.6, 1 }, 0.55),
  }
end

-- ---------------------------------------------------------------- time

-- The press hits each ball once, and the third one again.
local HITS = { 0.83, 2.23, 4.23, 5.6 }
local SIDE, STUBBORN = 92, 3

--- How far down the press is, 0 to 1.
local press = keys { { 0.5, 0 }, { 0.72, -0.12, "outQuad" }, { 0.83, 1, "inQuart" }, { 1.05, 1 },
  { 1.4, 0, "inOutCubic" }, { 1.95, 0 }, { 2.13, -0.12, "outQuad" }, { 2.23, 1, "inQuart" },
  { 2.4, 1 }, { 2.75, 0, "inOutCubic" },
  { 3.9, 0 }, { 4.12, -0.12, "outQuad" }, { 4.23, 1.22, "inQuart" }, { 4.36, 1.25 },
  { 4.52, 0.2, "outCubic" }, { 4.8, 0.32, "inOutSine" }, { 5.25, -0.3, "inOutCubic" },
  { 5.5, -0.34 }, { 5.6, 1.36, "inQuart" }, { 6.15, 1.38 }, { 6.3, -0.4, "outBack" },
  { 7, -0.35, "inOutSine" }, { 8.5, -0.3, "inOutSine" } }

--- How high the stubborn ball is: its whole shape, as a share, under the press and after it.
local squash = keys { { 4.215, 1 }, { 4.23, 0.45, "outQuad" }, { 4.36, 0.42 },
  { 4.52, 1.3, "outCubic" }, { 4.7, 0.85, "inOutSine" }, { 4.9, 1.12, "inOutSine" },
  { 5.08, 0.86, "inOutSine" }, { 5.24, 1.1, "inOutSine" }, { 5.4, 0.92, "inOutSine" },
  { 5.585, 1, "inOutSine" }, { 5.6, 0.12, "outQuad" }, { 6.15, 0.1 },
  { 6.3, 1.5, "outCubic" }, { 6.55, 0.8, "inOutSine" }, { 6.8, 1.1, "inOutSine" },
  { 7, 1, "inOutSine" } }

--- The belt goes in steps, and waits while the press is down; longest for the stubborn ball.
local belt = keys { { 0, 0 }, { 0.55, 1, "inOutCubic" }, { 1.22, 1 }, { 1.92, 2, "inOutCubic" },
  { 2.8, 2 }, { 3.8, 3, "inOutCubic" }, { 6.9, 3 }, { 8.1, 4, "inOutCubic" } }

-- ---------------------------------------------------------------- the things

local STEP = 230

--- A thing drawn at the middle of the room, moved along the belt; its grain goes with it.
local function moved(art, x) return art:translate(0.866 * x, 0.5 * x) end

--- A ball, or a pancake: seen from above, it is never thinner than a third of its breadth.
local function ball(high)
  local rx = 50 * math.min(1 / math.sqrt(math.max(high, 0.1)), 2.6)
  local ry = math.max(50 * high, 0.34 * rx)
  local px, floor = at(0, 60, 0)
  local py = floor - 50 * high + ry
  local shape = ellipse { px, py - ry, rx, ry, fill = GOLD }
  local shaded = grainy(shape, AMBER, { 0.35, 0.25 }, { 0.8, 1 }, 0.95)
  local shine = ellipse { px - 0.36 * rx, py - 1.42 * ry, 0.22 * rx, 0.13 * ry, fill = SUN }
    :rotate(-24, "centre")
  local shadow = ellipse { px + 10, py - 4, rx * 1.05, 24, fill = rgb(PLUM, 0.45) }
  return shadow | shaded | shine
end

local function cube()
  local px, py = at(0, 60, 0)
  return ellipse { px + 12, py, 92, 34, fill = rgb(PLUM, 0.35) }
    | box(-SIDE / 2, 60 - SIDE / 2, 0, SIDE, SIDE, SIDE - 14, { SUN, GOLD, AMBER })
end

local round, square = ball(1), cube()

--- Thing n from 1: a ball before it is pressed, a cube after.
local function thing(n, time)
  local x = (belt:at(time) - n) * STEP
  if x < -1000 or x > 1000 then return end
  if n == STUBBORN then return moved(ball(squash:at(time)), x) end
  if n < STUBBORN and time >= HITS[n] then return moved(square, x) end
  return moved(round, x)
end

-- ---------------------------------------------------------------- the machine

local steel = { SEA, TEAL, DEEP }

local function conveyor(time)
  local gone = belt:at(time) * STEP % 46
  local parts = { box(-1300, 0, -70, 2600, 120, 64, { PLUM, ROSE, PLUM, most = 0.45 }) }
  for i = -28, 28 do
    local x = i * 46 + gone
    parts[#parts + 1] = face({ { x, 0, -6 }, { x + 38, 0, -6 }, { x + 38, 120, -6 },
      { x, 120, -6 } }, CREAM)
  end
  return union(parts)
end

--- The post of the press, and the parts that come down.
local back = box(-70, 150, -70, 140, 60, 420, steel)
local plate = box(-62, -2, 191, 124, 124, 54, steel)

--- What comes down, and how far the blow shakes everything.
local function ram(time)
  local shaken = 0
  for _, hit in ipairs(HITS) do
    local since = time - hit
    if since >= 0 and since < 0.4 then
      shaken = 7 * math.sin(60 * since) * math.exp(-9 * since)
    end
  end
  local down = 113 * press:at(time)
  local shaft = box(-22, 38, 245 - down, 44, 44, 55 + down, { "#9fe0cf", SEA, TEAL })
  return (shaft | plate:translate(0, down)):translate(0, shaken), shaken
end
local head = box(-78, -6, 300, 156, 220, 110, steel)

--- The face of the machine: two lamps, which look at what lies under them.
local function face_of(time)
  local amazed = motion.span(time, 6.25, 0.2, "outBack")
  local look = 8 * math.sin(2 * math.min(time, 3.6)) * (1 - motion.span(time, 3.4, 0.3))
    + 14 * motion.span(time, 6.95, 0.8, "inOutCubic")
  -- While it waits, its lamps go up and down with the ball that will not be still.
  local follows = motion.span(time, 4.5, 0.1) - motion.span(time, 5.5, 0.1)
  local down = 9 - 4 * amazed - follows * math.max(-4, math.min(13, 60 * (squash:at(time) - 0.9)))
  local parts = {}
  for i, x in ipairs { -36, 36 } do
    local px, py = at(x, -6, 352)
    parts[#parts + 1] = circle { px, py, 24 + 7 * amazed, fill = CREAM }
    parts[#parts + 1] = circle { px + look * 0.5, py + down + 0.25 * look,
      11 - 4 * amazed, fill = PLUM }
    local frown = motion.span(time, 4.6, 0.3) - amazed
    if frown > 0 then
      parts[#parts + 1] = rect { px - 34, py - 44, 68, 22, fill = SEA }
        :rotate(30 + (i == 1 and 16 or -16) * frown, px, py - 20):translate(0, 10 * frown)
    end
  end
  return union(parts)
end

local function foley()
  local sound = score(8.5)
  for i, hit in ipairs(HITS) do
    sound:add(hit, score.thump(i == #HITS and 42 or 60, 0.5), 0.9)
    sound:add(hit, score.click(0.35, 0.2), 0.5)
    sound:add(hit - 0.3, score.slide(210, 150, 0.28), 0.12)
  end
  for i, start in ipairs { 0, 1.22, 2.8, 6.9 } do
    for tick = 0, ({ 4, 4, 6, 8 })[i] do
      sound:add(start + 0.14 * tick, score.click(0.8, 0.03), 0.12, 0.2)
    end
  end
  sound:add(4.38, score.slide(150, 620, 0.24), 0.35)
  sound:add(4.78, score.slide(200, 330, 0.12), 0.14)
  sound:add(5.1, score.slide(220, 360, 0.12), 0.14)
  sound:add(6.16, score.slide(110, 1000, 0.34), 0.45)
  for i, hertz in ipairs { 523, 659, 784, 1047 } do
    sound:add(6.7 + 0.12 * i, score.bell(hertz, 0.9), 0.16, 0.3 * (i - 2.5))
  end
  return sound:address()
end

local ground = grainy(rect { 0, 0, W, H, fill = PINK }, ROSE, { 0.9, 0.1 }, { 0.1, 1 }, 0.22)

local function frame(f)
  local time = f.time
  local pushed, shaken = ram(time)
  local art = { conveyor(time):translate(0, shaken * 0.5), back }
  for n = 8, 1, -1 do
    local one = thing(n, time)
    if one and (belt:at(time) - n) * STEP <= 30 then art[#art + 1] = one end
  end
  art[#art + 1] = pushed
  art[#art + 1] = head
  art[#art + 1] = face_of(time)
  for n = 8, 1, -1 do
    local one = thing(n, time)
    if one and (belt:at(time) - n) * STEP > 30 then art[#art + 1] = one end
  end
  return cel { ground, union(art):translate(-640, -400):scale(0.95):translate(724, 554) }
end

return film { title = "The press", size = { W, H }, fps = FPS, duration = 8.5, sound = foley(),
  frame = frame }
