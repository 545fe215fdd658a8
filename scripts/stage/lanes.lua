--- Three lanes of bars, one for each sound, and the ball that is heard in one.
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
local neon = require("stage.moods").neon
local tints = { "#ffe14d", neon.light, neon.accent }
local sky = linear { from = { 0, 0 }, to = { 0, 160 }, table.unpack(neon.sky) }
local disc = circle { 0, 0, 18, fill = neon.accent }
local striped = disc | clip(rect { -6, -18, 12, 36, fill = "#fff3d6" }, disc)

local function height(u) return 132 - 420 * u * (1 - u) end

--- The ground, and a ball that touches it half a second after each full one.
local function scene(time)
  local u, x = (time + 0.5) % 1, 40 + 100 * time
  local squash = math.max(0, 1 - 12 * math.min(u, 1 - u))
  local ball = striped:rotate(200 * time):scale(1 + 0.3 * squash, 1 - 0.3 * squash)
    :translate(x, height(u) + 6 * squash)
  return cel {
    rect { 0, 0, 480, 162, fill = sky },
    rect { 0, 150, 480, 12, fill = neon.ink },
    ball }
end

--- The lanes, bright up to now, behind where the ball was just before.
local function heard(time)
  local u, x, art = (time + 0.5) % 1, 40 + 100 * time, {}
  for lane, tint in ipairs(tints) do
    local bars = union(lanes[lane]):paint(tint)
    art[lane] = bars:fade(0.3) | clip(bars, rect { 0, 0, x, 270 })
  end
  for k = 1, 9 do
    local before = (u - k / 36) % 1
    art[k + 3] = disc:scale(0.8 - 0.06 * k):translate(x - 2.8 * k, height(before))
      :fade(0.3)
  end
  return cel(art)
end

return { scene = scene, heard = heard }
