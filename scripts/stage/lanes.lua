--- Three lanes of bars, one for each sound, and a ball that is heard on four drums.
local label = require "stage.label"
local mood = require("stage.moods").paper
local BLUE, RED, OCHRE = "#2f6f77", mood.accent, "#c98a2e"

local lanes = { {}, {}, {} }
for k = 0, 99 do
  -- a bar for each 25th of a second
  local t, hit = k / 25, (k / 25 + 0.5) % 1 -- hit: since the ball was heard
  local ducked = t > 0.5 and hit < 0.5 and 0.4 or 1
  local music = math.min(1, t / 0.5, 4 - t)
    * ducked
    * (0.5 + 0.5 * math.exp(-5 * (t % 0.375)))
  local wind = 0.5 + 0.25 * math.sin(1.7 * t + 1) + 0.25 * math.sin(37 * k)
  local ball = t < 0.5 and 0 or math.exp(-9 * hit)
  for lane, level in ipairs { music, wind, ball } do
    local y, high = 144 + 35 * lane - 14 * level - 1, 28 * level + 2
    lanes[lane][k + 1] = rect { 40 + 4 * k, y, 2.6, high, radius = 1.3 }
  end
end

local function hit(time) return (time + 0.5) % 1 end -- since the ball was heard

--- A drum of that width, its skin at 0, 0; `low` is how far the skin gives way.
local function drum(width, tall, tint, low)
  local w = width / 2
  local cords = { ("M%g 6"):format(-w) }
  for i = 1, 6 do
    cords[i + 1] = ("L%g %g"):format(-w + width * i / 6, i % 2 == 0 and 6 or tall - 4)
  end
  return union {
    path { d = ("M%g 0V%gQ0 %g %g %gV0Z"):format(-w, tall, tall + 14, w, tall), fill = tint },
    stroke { d = table.concat(cords), width = 2, fill = mood.sky[1] },
    path { d = ("M%g %gQ0 %g %g %gV%gQ0 %g %g %gZ"):format(-w, tall - 5, tall + 9, w, tall - 5,
      tall, tall + 14, -w, tall), fill = mood.ink },
    ellipse { 0, 0, w + 3, 9, fill = mood.ink },
    ellipse { 0, -1, w, 7, fill = mood.light },
    ellipse { 0, 1 + low, w * 0.7, 5 * (1 - low / 8), fill = "#ead9b4" } }
end

local drums = { { 64, 40, BLUE }, { 84, 58, OCHRE }, { 56, 30, "#7d8f5a" }, { 96, 48, BLUE } }

--- The height of the ball, between two drums.
local function height(time)
  local u, i = hit(time), math.floor(time + 0.5)
  local from, to = drums[i] or drums[2], drums[i + 1] or drums[2]
  return 124 - from[2] + (from[2] - to[2]) * u - 250 * u * (1 - u)
end

local disc = circle { 0, 0, 20, fill = RED }
local striped = disc | clip(union { rect { -12, -20, 7, 40 }, rect { 5, -20, 7, 40 } }
  :paint(mood.light), disc) | circle { 0, 0, 20 }:stroke { width = 2, fill = mood.ink }

--- The drums, and the ball, which falls onto one half a second after each full one.
local function scene(time)
  local u, art = hit(time), { rect { 0, 0, 480, 164, fill = linear { from = { 0, 0 },
    to = { 0, 164 }, table.unpack(mood.sky) } }, rect { 0, 150, 480, 14, fill = mood.far } }
  for i, at in ipairs(drums) do
    local since = time - i + 0.5
    local low = since >= 0 and 8 * math.exp(-7 * since) * math.cos(28 * since) or 0
    art[#art + 1] = drum(at[1], at[2], at[3], low):translate(100 * i - 10, 146 - at[2])
  end
  for k = 1, 6 do
    art[#art + 1] = disc:scale(0.8 - 0.1 * k):translate(40 + 100 * time - 4.5 * k,
      height(time - k / 22)):fade(0.32 - 0.04 * k)
  end
  local squash = math.max(0, 1 - 12 * math.min(u, 1 - u))
  art[#art + 1] = striped:rotate(200 * time):scale(1 + 0.3 * squash, 1 - 0.3 * squash)
    :translate(40 + 100 * time, height(time) + 8 * squash)
  return cel(art)
end

--- The lanes with their names, dark up to now.
local function heard(time)
  local x, art = 40 + 100 * time, {}
  for lane, name in ipairs { "music", "wind", "ball" } do
    local tint = ({ BLUE, OCHRE, RED })[lane]
    local bars = union(lanes[lane]):paint(tint)
    art[#art + 1] = bars:fade(0.3) | clip(bars, rect { 0, 0, x, 270 })
    art[#art + 1] = label(name, 460, 148 + 35 * lane, tint, 13)
  end
  return cel(art)
end

return { scene = scene, heard = heard }
